//! Surfaces: some facets of a mesh and their vertices.

use super::text::write_point;
use super::{Buffered, io_error, replace, stl};
use crate::error::{Error, Result, message};
use crate::memory::{collected, filled};
use crate::mesh::{Inputs, NONE, Triangulation};
use std::io::{self, Write};
use std::path::Path;

/// Formats of surfaces, with z = 0 in the plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurfaceFormat {
    /// Stanford's `.ply`, little-endian binary with doubles. Vertices have a property `input`: the
    /// first input that is this vertex, or [`NONE`]. Elements `face` in 3D, `edge` in the plane.
    Ply,
    /// Geomview's `OFF`. In the plane its faces have two vertices.
    Off,
    /// Binary `STL`, with single precision; in 3D.
    Stl,
    /// Wavefront's `OBJ`; lines in the plane.
    Obj,
}

impl SurfaceFormat {
    /// Returns the format that a path's extension stands for: `.ply`, `.off`, `.stl` or
    /// `.obj`.
    ///
    /// # Errors
    /// `InvalidArgument` for another one.
    pub fn from_path(path: &Path) -> Result<Self> {
        match path.extension().and_then(|extension| extension.to_str()) {
            Some("ply") => Ok(Self::Ply),
            Some("off") => Ok(Self::Off),
            Some("stl") => Ok(Self::Stl),
            Some("obj") => Ok(Self::Obj),
            _ => Err(Error::invalid(message!(
                "{}: the extension names no format of surfaces; use .ply, .off, .stl or .obj",
                path.display()
            ))),
        }
    }
}

/// Writes facets (`dim` vertices each) of a mesh in 2D or 3D, and the vertices that they have.
///
/// # Errors
/// `InvalidArgument` (another dimension; what STL cannot hold); `Io`: `out` fails, it is not called
/// again; `OutOfMemory`.
pub fn write_surface(
    inputs: &Inputs,
    mesh: &Triangulation,
    facets: &[u32],
    format: SurfaceFormat,
    out: &mut dyn Write,
) -> Result<()> {
    let surface = Surface::new(inputs, mesh, facets)?;
    surface.check(format)?;
    let mut buffered = Buffered::new(1 << 16, out)?;
    let written = surface.write(format, &mut buffered).and_then(|()| buffered.flush());
    written.map_err(|error| io_error("cannot write", &error))
}

/// Writes facets and their vertices into a file, which appears complete or not at all. A device or
/// a pipe is written into.
///
/// # Errors
/// Fails as [`write_surface`] does.
pub fn write_surface_file(
    inputs: &Inputs,
    mesh: &Triangulation,
    facets: &[u32],
    format: SurfaceFormat,
    path: &Path,
) -> Result<()> {
    match replace::open_stream(path)? {
        Some(mut stream) => write_surface(inputs, mesh, facets, format, &mut stream),
        None => {
            let surface = Surface::new(inputs, mesh, facets)?;
            surface.check(format)?;
            replace::replace(&[(path, &|out| surface.write(format, out))])
        }
    }
}

/// The facets with vertices that are numbered anew, in the same order.
struct Surface<'a> {
    inputs: &'a Inputs,
    mesh: &'a Triangulation,
    facets: &'a [u32],
    /// The vertices of facets, ascending.
    vertices: Vec<u32>,
    /// Vertex -> its new number.
    numbers: Vec<u32>,
}

impl<'a> Surface<'a> {
    fn new(inputs: &'a Inputs, mesh: &'a Triangulation, facets: &'a [u32]) -> Result<Self> {
        if !matches!(mesh.dim, 2 | 3) {
            let message = message!("surfaces are written in 2D and 3D; the mesh is {}D", mesh.dim);
            return Err(Error::invalid(message));
        }
        let mut numbers = filled(mesh.vertex_count(), NONE)?;
        facets.iter().for_each(|&vertex| numbers[vertex as usize] = 0);
        let is_used = |&vertex: &u32| numbers[vertex as usize] != NONE;
        let vertices = collected((0..mesh.vertex_count() as u32).filter(is_used))?;
        for (number, &vertex) in (0..).zip(&vertices) {
            numbers[vertex as usize] = number;
        }
        Ok(Self { inputs, mesh, facets, vertices, numbers })
    }

    fn write(&self, format: SurfaceFormat, out: &mut dyn Write) -> io::Result<()> {
        match format {
            SurfaceFormat::Ply => self.write_ply(out),
            SurfaceFormat::Off => self.write_off(out),
            SurfaceFormat::Stl => stl::write_triangles(self.mesh, self.triangles(), out),
            SurfaceFormat::Obj => self.write_obj(out),
        }
    }

    /// Fails if the format cannot hold the surface.
    fn check(&self, format: SurfaceFormat) -> Result<()> {
        match (format, self.mesh.dim) {
            (SurfaceFormat::Stl, 3) => stl::check_triangles(self.mesh, self.triangles()),
            (SurfaceFormat::Stl, dim) => {
                let message = message!("STL has triangles in space, and the mesh is {dim}D");
                Err(Error::invalid(message))
            }
            _ => Ok(()),
        }
    }

    /// Returns the facets of a mesh in space.
    fn triangles(&self) -> impl Iterator<Item = [u32; 3]> + Clone + '_ {
        self.facets.chunks_exact(3).map(|facet| [facet[0], facet[1], facet[2]])
    }

    /// Returns the new numbers of the vertices of each facet.
    fn rows(&self) -> impl ExactSizeIterator<Item = impl Iterator<Item = u32> + '_> + '_ {
        let number = |&vertex: &u32| self.numbers[vertex as usize];
        self.facets.chunks_exact(self.mesh.dim).map(move |facet| facet.iter().map(number))
    }

    fn write_ply(&self, out: &mut dyn Write) -> io::Result<()> {
        let (vertices, facets) = (self.vertices.len(), self.rows().len());
        write!(
            out,
            "ply\nformat binary_little_endian 1.0\ncomment netmesh: a surface\n\
             element vertex {vertices}\nproperty double x\nproperty double y\nproperty double z\n\
             property uint input\n"
        )?;
        match self.mesh.dim {
            2 => write!(
                out,
                "element edge {facets}\nproperty uint vertex1\nproperty uint vertex2\nend_header\n"
            )?,
            _ => write!(
                out,
                "element face {facets}\nproperty list uchar uint vertex_indices\nend_header\n"
            )?,
        }
        for &vertex in &self.vertices {
            let point = self.mesh.point(vertex);
            for axis in 0..3 {
                out.write_all(&point.get(axis).unwrap_or(&0.0).to_le_bytes())?;
            }
            let input = self.inputs.first_input(vertex as usize).unwrap_or(NONE);
            out.write_all(&input.to_le_bytes())?;
        }
        for mut row in self.rows() {
            if self.mesh.dim == 3 {
                out.write_all(&[3])?;
            }
            row.try_for_each(|number| out.write_all(&number.to_le_bytes()))?;
        }
        Ok(())
    }

    fn write_obj(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "# netmesh: a surface")?;
        for &vertex in &self.vertices {
            out.write_all(b"v ")?;
            write_point(out, self.mesh.point(vertex), " ")?;
            out.write_all(if self.mesh.dim == 2 { b" 0\n" } else { b"\n" })?;
        }
        for mut row in self.rows() {
            out.write_all(if self.mesh.dim == 2 { b"l" } else { b"f" })?;
            row.try_for_each(|number| write!(out, " {}", number + 1))?;
            out.write_all(b"\n")?;
        }
        Ok(())
    }

    fn write_off(&self, out: &mut dyn Write) -> io::Result<()> {
        let dim = self.mesh.dim;
        writeln!(out, "OFF\n{} {} 0", self.vertices.len(), self.rows().len())?;
        for &vertex in &self.vertices {
            write_point(out, self.mesh.point(vertex), " ")?;
            out.write_all(if dim == 2 { b" 0\n" } else { b"\n" })?;
        }
        for mut row in self.rows() {
            write!(out, "{dim}")?;
            row.try_for_each(|number| write!(out, " {number}"))?;
            out.write_all(b"\n")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Format, read, samples};
    use super::*;

    fn written(mesh: &crate::mesh::Mesh, facets: &[u32], format: SurfaceFormat) -> Vec<u8> {
        let mut out = Vec::new();
        let triangulation = mesh.triangulation().unwrap();
        write_surface(mesh.inputs(), triangulation, facets, format, &mut out).unwrap();
        out
    }

    #[test]
    fn vertices_without_a_facet_are_left_out() {
        // The second triangle of the square lacks vertex 1.
        let text = written(&samples::square(), &[0, 2, 2, 3, 3, 0], SurfaceFormat::Off);
        let expected = "OFF\n3 3 0\n0 0 0\n1 1 0\n0 1 0\n2 0 1\n2 1 2\n2 2 0\n";
        assert_eq!(String::from_utf8(text).unwrap(), expected);
        let text = written(&samples::mesh(3), &[0, 4, 1], SurfaceFormat::Off);
        let text = String::from_utf8(text).unwrap();
        assert!(text.starts_with("OFF\n3 1 0\n") && text.ends_with("\n3 0 2 1\n"), "{text}");
    }

    #[test]
    fn ply_has_the_inputs_and_reads_back() {
        for (dim, facets, element) in
            [(2, &[0, 2][..], "element edge 1\n"), (3, &[4, 1, 0], "element face 1\n")]
        {
            let mesh = samples::mesh(dim);
            let bytes = written(&mesh, facets, SurfaceFormat::Ply);
            let end = b"end_header\n";
            let header = bytes.windows(end.len()).position(|part| part == end).unwrap() + end.len();
            let text = std::str::from_utf8(&bytes[..header]).unwrap();
            assert!(text.contains(element), "{text}");
            let mut sorted = facets.to_vec();
            sorted.sort_unstable();
            let row = 3 * 8 + 4;
            for (at, &vertex) in sorted.iter().enumerate() {
                let input = &bytes[header + at * row + 24..][..4];
                let expected = mesh.inputs().first_input(vertex as usize).unwrap_or(NONE);
                assert_eq!(input, expected.to_le_bytes());
            }
            assert_eq!(bytes.len(), header + dim * row + dim * 4 + usize::from(dim == 3));
            let cloud = read(&mut bytes.as_slice(), Format::Ply).unwrap();
            let triangulation = mesh.triangulation().unwrap();
            let point = |&vertex: &u32| {
                let mut point = triangulation.point(vertex).to_vec();
                point.resize(3, 0.0);
                point
            };
            let expected: Vec<f64> = sorted.iter().flat_map(point).collect();
            samples::assert_same_bits(&cloud.coordinates, &expected);
        }
    }

    #[test]
    fn other_dimensions_and_names_are_refused() {
        let mesh = samples::mesh(4);
        let triangulation = mesh.triangulation().unwrap();
        let mut out = Vec::new();
        let written =
            write_surface(mesh.inputs(), triangulation, &[], SurfaceFormat::Off, &mut out);
        assert!(written.unwrap_err().message().contains("the mesh is 4D"));
        let error = SurfaceFormat::from_path(Path::new("a.vtu")).unwrap_err();
        assert!(error.message().contains("use .ply, .off, .stl or .obj"));
    }
}
