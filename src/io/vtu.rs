//! VTK's XML unstructured grid, with the arrays as appended raw binary: small, and exact.

use crate::error::{Error, ErrorKind, Result, message};
use crate::mesh::Triangulation;
use std::fmt;
use std::io::{self, Write};

const TRIANGLE: u8 = 5;
const TETRA: u8 = 10;

/// VTK has no cells beyond tetrahedra.
pub(super) fn check_dimension(dim: usize) -> Result<()> {
    match dim {
        2 | 3 => Ok(()),
        _ => Err(Error::new(
            ErrorKind::InvalidArgument,
            message!(
                "format Vtu holds meshes of dimension 2 and 3, not {dim}; use Off (nOFF) or TetgenNode"
            ),
        )),
    }
}

/// The XML that says where the arrays are, then the arrays.
///
/// The arrays follow in the reverse of the order in which the XML declares them. meshio (5.3) takes
/// them one after the other, looks each up by its offset and overwrites that with one of its own,
/// which may be the offset of another: it then finds the first of the two in the XML. In this order
/// that is always the right one.
pub(super) fn write(triangulation: &Triangulation, out: &mut dyn Write) -> io::Result<()> {
    let arrays = arrays(triangulation);
    let mut offset: u64 = arrays.iter().map(Array::size_with_length).sum();
    let declarations = arrays.each_ref().map(|array| {
        offset -= array.size_with_length();
        array.declaration(offset)
    });
    let [kind, domain, precision_limited, points, connectivity, offsets, types] = declarations;
    let (vertices, cells) = (triangulation.vertex_count(), triangulation.simplex_count());
    write!(
        out,
        r#"<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<UnstructuredGrid>
<Piece NumberOfPoints="{vertices}" NumberOfCells="{cells}">
<PointData Scalars="kind">
{kind}
{domain}
{precision_limited}
</PointData>
<Points>
{points}
</Points>
<Cells>
{connectivity}
{offsets}
{types}
</Cells>
</Piece>
</UnstructuredGrid>
<AppendedData encoding="raw">
_"#
    )?;
    for array in arrays.iter().rev() {
        out.write_all(&array.bytes().to_le_bytes())?;
        (array.write)(triangulation, out)?;
    }
    out.write_all(b"\n</AppendedData>\n</VTKFile>\n")
}

struct Array {
    name: &'static str,
    scalar: &'static str,
    scalar_size: u64,
    components: u64,
    tuples: usize,
    write: fn(&Triangulation, &mut dyn Write) -> io::Result<()>,
}

impl Array {
    fn bytes(&self) -> u64 {
        self.scalar_size * self.components * self.tuples as u64
    }

    /// Before each array stands its number of bytes, as the file's `header_type`.
    fn size_with_length(&self) -> u64 {
        8 + self.bytes()
    }

    fn declaration(&self, offset: u64) -> Declaration {
        let Self { name, scalar, components, .. } = *self;
        Declaration { name, scalar, components, offset }
    }
}

/// What the XML says of an array; written in place, without a string between.
struct Declaration {
    name: &'static str,
    scalar: &'static str,
    components: u64,
    offset: u64,
}

impl fmt::Display for Declaration {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, scalar, components, offset } = self;
        write!(
            f,
            r#"<DataArray type="{scalar}" Name="{name}" NumberOfComponents="{components}" format="appended" offset="{offset}"/>"#
        )
    }
}

/// The arrays in the order of the XML.
fn arrays(triangulation: &Triangulation) -> [Array; 7] {
    let (vertices, cells) = (triangulation.vertex_count(), triangulation.simplex_count());
    let corners = triangulation.simplices.len();
    let array = |name, scalar, scalar_size, tuples, write| Array {
        name,
        scalar,
        scalar_size,
        components: 1,
        tuples,
        write,
    };
    [
        array("kind", "UInt8", 1, vertices, |mesh, out| {
            mesh.kinds.iter().try_for_each(|kind| out.write_all(&[*kind as u8]))
        }),
        array("domain", "UInt32", 4, vertices, |mesh, out| {
            mesh.vertex_domains.iter().try_for_each(|domain| out.write_all(&domain.to_le_bytes()))
        }),
        array("precision_limited", "UInt8", 1, vertices, |mesh, out| {
            mesh.precision_limited
                .iter()
                .try_for_each(|limited| out.write_all(&[u8::from(*limited)]))
        }),
        Array { components: 3, ..array("Points", "Float64", 8, vertices, write_points) },
        array("connectivity", "Int64", 8, corners, |mesh, out| {
            mesh.simplices.iter().try_for_each(|v| out.write_all(&i64::from(*v).to_le_bytes()))
        }),
        array("offsets", "Int64", 8, cells, |mesh, out| {
            let corners = mesh.dim as i64 + 1;
            (1..=mesh.simplex_count() as i64)
                .try_for_each(|cell| out.write_all(&(cell * corners).to_le_bytes()))
        }),
        array("types", "UInt8", 1, cells, |mesh, out| {
            let cell_type = if mesh.dim == 2 { TRIANGLE } else { TETRA };
            (0..mesh.simplex_count()).try_for_each(|_| out.write_all(&[cell_type]))
        }),
    ]
}

/// VTK's points have three coordinates always.
fn write_points(triangulation: &Triangulation, out: &mut dyn Write) -> io::Result<()> {
    for point in triangulation.points.chunks_exact(triangulation.dim) {
        for axis in 0..3 {
            out.write_all(&point.get(axis).unwrap_or(&0.0).to_le_bytes())?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::{Format, samples, write};
    use super::*;

    /// The bytes of the array called `name`, found as a reader finds them.
    fn array_of<'a>(file: &'a [u8], name: &str) -> &'a [u8] {
        let end = file.windows(2).position(|pair| pair == b"\n_").unwrap();
        let xml = std::str::from_utf8(&file[..end]).unwrap();
        let declaration = xml.lines().find(|l| l.contains(&format!("Name=\"{name}\""))).unwrap();
        let offset = declaration.split("offset=\"").nth(1).unwrap().split('"').next().unwrap();
        let data = &file[end + 2 + offset.parse::<usize>().unwrap()..];
        let length = u64::from_le_bytes(data[..8].try_into().unwrap());
        &data[8..8 + length as usize]
    }

    fn doubles(bytes: &[u8]) -> Vec<f64> {
        bytes.chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().unwrap())).collect()
    }

    fn integers(bytes: &[u8]) -> Vec<i64> {
        bytes.chunks_exact(8).map(|b| i64::from_le_bytes(b.try_into().unwrap())).collect()
    }

    #[test]
    fn arrays_are_where_the_header_says() {
        for dim in [2, 3] {
            let mesh = samples::mesh(dim);
            let triangulation = mesh.triangulation().unwrap();
            let mut file = Vec::new();
            write(&mesh, Format::Vtu, &mut file).unwrap();

            let padded = |p: &[f64]| [p[0], p[1], p.get(2).copied().unwrap_or(0.0)];
            let points: Vec<f64> =
                triangulation.points.chunks_exact(dim).flat_map(padded).collect();
            samples::assert_same_bits(&doubles(array_of(&file, "Points")), &points);
            let corners: Vec<i64> = triangulation.simplices.iter().map(|&v| v.into()).collect();
            assert_eq!(integers(array_of(&file, "connectivity")), corners);
            let step = dim as i64 + 1;
            assert_eq!(integers(array_of(&file, "offsets")), [step, 2 * step]);
            assert_eq!(array_of(&file, "types"), if dim == 2 { [5, 5] } else { [10, 10] });
            let kinds: Vec<u8> = triangulation.kinds.iter().map(|kind| *kind as u8).collect();
            assert_eq!(array_of(&file, "kind"), kinds);
            let domains = triangulation.vertex_domains.iter().flat_map(|d| d.to_le_bytes());
            assert_eq!(array_of(&file, "domain"), domains.collect::<Vec<u8>>());
            let limited: Vec<u8> =
                triangulation.precision_limited.iter().map(|l| *l as u8).collect();
            assert_eq!(array_of(&file, "precision_limited"), limited);
            assert!(file.ends_with(b"\n</AppendedData>\n</VTKFile>\n"));
        }
    }

    #[test]
    fn names_the_formats_that_hold_higher_dimensions() {
        let error = write(&samples::mesh(4), Format::Vtu, &mut Vec::new()).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::InvalidArgument);
        assert!(error.message().contains("Off (nOFF) or TetgenNode"), "{error}");
    }
}
