//! Filtered complexes for programs that compute persistent homology.

use super::{Buffered, allocation_failed, io_error, replace};
use crate::error::{Error, Result, message};
use crate::memory::{AllocResult, TryGrow};
use crate::mesh::Inputs;
use crate::topology::{Faces, Filtration};
use std::io::{self, Write};
use std::path::Path;

/// Formats of filtered complexes. `docs/topology.md` describes them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FiltrationFormat {
    /// Text as GUDHI's `Simplex_tree` writes and reads it: a line for each face with its dimension,
    /// its vertices in descending order and its value. By ascending value, facets before what they
    /// are facets of. Vertices are numbered as [`Filtration::numbers`] says: in an alpha filtration
    /// as the caller's points.
    Gudhi,
    /// DIPHA's binary weighted boundary matrix, sorted by dimension.
    Dipha,
}

impl FiltrationFormat {
    /// Returns the format that a path's extension stands for: `.filtration` or `.dipha`.
    ///
    /// # Errors
    /// `InvalidArgument` for another one.
    pub fn from_path(path: &Path) -> Result<Self> {
        match path.extension().and_then(|extension| extension.to_str()) {
            Some("filtration") => Ok(Self::Gudhi),
            Some("dipha") => Ok(Self::Dipha),
            _ => Err(Error::invalid(message!(
                "{}: the extension names no format of filtrations; use .filtration or .dipha",
                path.display()
            ))),
        }
    }
}

/// Writes faces, from the vertices on, and their values. `inputs` are those of the mesh.
///
/// # Errors
/// `Io`: `out` fails, it is not called again; `OutOfMemory`.
pub fn write_filtration(
    inputs: &Inputs,
    faces: &Faces,
    filtration: &Filtration,
    format: FiltrationFormat,
    out: &mut dyn Write,
) -> Result<()> {
    let mut buffered = Buffered::new(1 << 16, out)?;
    let written = write(inputs, faces, filtration, format, &mut buffered);
    written.and_then(|()| buffered.flush()).map_err(|error| io_error("cannot write", &error))
}

/// Writes faces and their values into a file, which appears complete or not at all. A device or a
/// pipe is written into.
///
/// # Errors
/// Fails as [`write_filtration`] does.
pub fn write_filtration_file(
    inputs: &Inputs,
    faces: &Faces,
    filtration: &Filtration,
    format: FiltrationFormat,
    path: &Path,
) -> Result<()> {
    match replace::open_stream(path)? {
        Some(mut stream) => write_filtration(inputs, faces, filtration, format, &mut stream),
        None => replace::replace(&[(path, &|out| write(inputs, faces, filtration, format, out))]),
    }
}

fn write(
    inputs: &Inputs,
    faces: &Faces,
    filtration: &Filtration,
    format: FiltrationFormat,
    out: &mut dyn Write,
) -> io::Result<()> {
    match format {
        FiltrationFormat::Gudhi => {
            write_gudhi(filtration.vertex_numbers(inputs), faces, filtration, out)
        }
        FiltrationFormat::Dipha => write_dipha(faces, filtration, out),
    }
}

/// Writes faces and their values for GUDHI. `numbers` has the number of each vertex; without them
/// it is the vertex itself.
fn write_gudhi(
    numbers: Option<&[u32]>,
    faces: &Faces,
    filtration: &Filtration,
    out: &mut dyn Write,
) -> io::Result<()> {
    let number = |vertex: u32| numbers.map_or(vertex, |numbers| numbers[vertex as usize]);
    for (value, k, face) in by_value(faces, filtration).map_err(allocation_failed)? {
        write!(out, "{k} ")?;
        for &vertex in faces.of_dimension(k as usize).face(face as usize).iter().rev() {
            write!(out, "{} ", number(vertex))?;
        }
        writeln!(out, "{value}")?;
    }
    Ok(())
}

/// Returns value, dimension and id of each face, sorted in this order.
fn by_value(faces: &Faces, filtration: &Filtration) -> AllocResult<Vec<(f64, u32, u32)>> {
    let mut sorted = Vec::new();
    for (k, values) in (0u32..).zip(&filtration.values) {
        debug_assert_eq!(values.len(), faces.of_dimension(k as usize).count());
        for (face, &value) in (0u32..).zip(values) {
            sorted.try_push((value, k, face))?;
        }
    }
    sorted.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    Ok(sorted)
}

/// Number that begins DIPHA's files, and the type of this one.
const DIPHA: i64 = 8_067_171_840;
const WEIGHTED_BOUNDARY_MATRIX: i64 = 0;

fn write_dipha(faces: &Faces, filtration: &Filtration, out: &mut dyn Write) -> io::Result<()> {
    let levels = || (0..=faces.dim()).map(|k| (k as i64, faces.of_dimension(k)));
    let cells: i64 = levels().map(|(_, level)| level.count() as i64).sum();
    let mut number = |number: i64| out.write_all(&number.to_le_bytes());
    // 0: columns are boundaries.
    for header in [DIPHA, WEIGHTED_BOUNDARY_MATRIX, 0, cells, faces.dim() as i64] {
        number(header)?;
    }
    for (k, level) in levels() {
        (0..level.count()).try_for_each(|_| number(k))?;
    }
    for value in filtration.values.iter().flatten() {
        number(i64::from_le_bytes(value.to_le_bytes()))?;
    }
    let mut start = 0;
    for (k, level) in levels() {
        for _ in 0..level.count() {
            number(start)?;
            start += if k == 0 { 0 } else { k + 1 };
        }
    }
    number(start)?;
    let mut below = 0;
    for (k, level) in levels().skip(1) {
        level.boundary.iter().try_for_each(|&facet| number(below + i64::from(facet)))?;
        below += faces.of_dimension(k as usize - 1).count() as i64;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arrays::tests::{delaunay, meshed};
    use crate::mesh::Mesh;
    use crate::options::Options;
    use crate::query::Index;
    use crate::topology::{alpha, distances};

    const POINTS: [[f64; 2]; 3] = [[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]];

    fn written(points: &[[f64; 2]], format: FiltrationFormat) -> Vec<u8> {
        let made = Mesh::new(2, points.len(), points.as_flattened(), 0);
        let mut made = made.unwrap();
        made.run(&delaunay(), None).unwrap();
        let mesh = made.triangulation().unwrap();
        let faces = Faces::new(mesh, 0, 1).unwrap();
        let filtration = alpha(mesh, &faces, 1).unwrap();
        let mut out = Vec::new();
        write_filtration(made.inputs(), &faces, &filtration, format, &mut out).unwrap();
        out
    }

    /// Holds that a mesh of other vertices, too, has the numbers of its own vertices.
    #[test]
    fn files_have_the_numbers_of_inputs_where_all_vertices_are() {
        let [a, b, c] = POINTS;
        let points = [a, a, b, a, c, b];
        let expected = "0 0 0\n0 2 0\n0 4 0\n1 4 0 2.25\n1 2 0 4\n1 4 2 6.25\n2 4 2 0 6.25\n";
        let gudhi = FiltrationFormat::Gudhi;
        assert_eq!(String::from_utf8(written(&points, gudhi)).unwrap(), expected);
        let mut made = Mesh::new(2, 6, points.as_flattened(), 0).unwrap();
        made.run(&Options::default(), None).unwrap();
        let mesh = made.triangulation().unwrap();
        let (faces, index) = (Faces::new(mesh, 0, 1).unwrap(), Index::new(mesh).unwrap());
        let filtration = distances(mesh, &faces, &index, 1).unwrap();
        let mut out = Vec::new();
        write_filtration(made.inputs(), &faces, &filtration, gudhi, &mut out).unwrap();
        let text = String::from_utf8(out).unwrap();
        let vertices = text.lines().filter_map(|line| line.strip_prefix("0 "));
        let mut numbers: Vec<usize> =
            vertices.map(|line| line.split(' ').next().unwrap().parse().unwrap()).collect();
        numbers.sort_unstable();
        assert!(numbers.len() > 3 && numbers.into_iter().eq(0..mesh.vertex_count()));
    }

    #[test]
    fn gudhi_gets_a_line_for_each_face() {
        let expected = "0 0 0\n0 1 0\n0 2 0\n1 2 0 2.25\n1 1 0 4\n1 2 1 6.25\n2 2 1 0 6.25\n";
        assert_eq!(String::from_utf8(written(&POINTS, FiltrationFormat::Gudhi)).unwrap(), expected);
    }

    #[test]
    fn dipha_gets_a_boundary_matrix() {
        let [a, b, c] = POINTS;
        let bytes = written(&POINTS, FiltrationFormat::Dipha);
        // Cells have no numbers of vertices.
        assert_eq!(bytes, written(&[a, a, b, c], FiltrationFormat::Dipha));
        let numbers: Vec<i64> = bytes
            .chunks_exact(8)
            .map(|number| i64::from_le_bytes(number.try_into().unwrap()))
            .collect();
        assert_eq!(numbers[..5], [8_067_171_840, 0, 0, 7, 2]);
        assert_eq!(numbers[5..12], [0, 0, 0, 1, 1, 1, 2]);
        let values = numbers[12..19].iter().map(|&bits| f64::from_bits(bits as u64));
        assert!(values.eq([0.0, 0.0, 0.0, 4.0, 2.25, 6.25, 6.25]));
        assert_eq!(numbers[19..26], [0, 0, 0, 0, 2, 4, 6]);
        // Edges 01, 02, 12 are cells 3, 4, 5.
        assert_eq!(numbers[26..], [9, 1, 0, 2, 0, 2, 1, 5, 4, 3]);
    }

    #[test]
    fn a_file_is_there_as_a_whole() {
        let directory = std::env::temp_dir();
        let path = directory.join(format!("netmesh-{}.dipha", std::process::id()));
        let format = FiltrationFormat::from_path(&path).unwrap();
        let mesh = meshed(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], &delaunay()).unwrap();
        let inputs = Inputs::new(2, 3, &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0], 0).unwrap();
        let mesh = mesh.triangulation().unwrap();
        let faces = Faces::new(mesh, 0, 1).unwrap();
        let filtration = alpha(mesh, &faces, 1).unwrap();
        write_filtration_file(&inputs, &faces, &filtration, format, &path).unwrap();
        assert_eq!(std::fs::metadata(&path).unwrap().len(), 8 * (5 + 3 * 7 + 1 + 9));
        std::fs::remove_file(&path).unwrap();
        let error = FiltrationFormat::from_path(Path::new("a.vtu")).unwrap_err();
        assert!(error.message().contains(".filtration or .dipha"));
    }
}
