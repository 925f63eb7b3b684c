//! VTK's XML unstructured grid, with the arrays as appended raw binary: small, and exact.

use super::allocation_failed;
use super::measures::Measures;
use crate::arrays::domains::domain_of;
use crate::mesh::{Attribute, Inputs, NONE, Triangulation};
use crate::options::Criterion;
use std::fmt;
use std::io::{self, Write};

const TRIANGLE: u8 = 5;
const TETRA: u8 = 10;

/// Data that the arrays are made of.
struct Source<'a> {
    inputs: &'a Inputs,
    mesh: &'a Triangulation,
    markers: &'a [i32],
    measures: Measures,
}

/// Writes the XML that says where the arrays are, then the arrays.
///
/// The arrays follow in the reverse of the order in which the XML declares them. meshio (5.3) takes
/// them one after the other, looks each up by its offset and overwrites that with one of its own,
/// which may be the offset of another: it then finds the first of the two in the XML. In this order
/// that is always the right one.
pub(super) fn write(
    inputs: &Inputs,
    mesh: &Triangulation,
    markers: &[i32],
    attributes: &[Attribute],
    out: &mut dyn Write,
) -> io::Result<()> {
    let measures = match mesh.dim {
        2 => Measures::new::<2>(mesh),
        _ => Measures::new::<3>(mesh),
    };
    let measures = measures.map_err(allocation_failed)?;
    let source = Source { inputs, mesh, markers, measures };
    let arrays = arrays(mesh);
    let added = |attribute: &Attribute| 8 + size_of_val(&*attribute.values) as u64;
    let is_in = |section| move |array: &&Array| array.is_there && array.section == section;
    let in_section = |section| arrays.iter().filter(is_in(section));
    let all = || SECTIONS.into_iter().map(|(section, _)| section);
    let sizes = all().flat_map(in_section).map(Array::size_with_length);
    let mut offset: u64 = sizes.chain(attributes.iter().map(added)).sum();
    writeln!(
        out,
        r#"<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<UnstructuredGrid>"#
    )?;
    for (section, name) in SECTIONS {
        if section == Section::Field && in_section(section).next().is_none() {
            continue;
        }
        write_begin(mesh, section, name, out)?;
        for array in in_section(section) {
            offset -= array.size_with_length();
            writeln!(out, "{}", array.declaration(offset))?;
        }
        for attribute in of_section(section, attributes) {
            offset -= added(attribute);
            let Attribute { name, components, .. } = attribute;
            let (scalar, components) = ("Float64", *components as u64);
            let declaration = Declaration { name, scalar, components, tuples: None, offset };
            writeln!(out, "{declaration}")?;
        }
        writeln!(out, "</{name}>")?;
    }
    out.write_all(b"</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_")?;
    for section in all().rev() {
        for attribute in of_section(section, attributes).iter().rev() {
            out.write_all(&(added(attribute) - 8).to_le_bytes())?;
            attribute.values.iter().try_for_each(|x| out.write_all(&x.to_le_bytes()))?;
        }
        for array in in_section(section).rev() {
            out.write_all(&array.bytes().to_le_bytes())?;
            (array.write)(&source, out)?;
        }
    }
    out.write_all(b"\n</AppendedData>\n</VTKFile>\n")
}

/// Writes the tag of a section; what follows [`Section::Field`] is of the only piece.
fn write_begin(
    mesh: &Triangulation,
    section: Section,
    name: &str,
    out: &mut dyn Write,
) -> io::Result<()> {
    if section != Section::Point {
        return writeln!(out, "<{name}>");
    }
    let (vertices, cells) = (mesh.vertex_count(), mesh.simplex_count());
    writeln!(
        out,
        r#"<Piece NumberOfPoints="{vertices}" NumberOfCells="{cells}">
<{name} Scalars="kind">"#
    )
}

/// Returns the attributes that are declared in a section.
fn of_section(section: Section, attributes: &[Attribute]) -> &[Attribute] {
    if section == Section::Point { attributes } else { &[] }
}

/// Section of the XML that declares an array.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Section {
    /// Data of neither points nor cells.
    Field,
    Point,
    Cell,
    Points,
    Cells,
}

/// Sections in the order of the XML, with their names there.
const SECTIONS: [(Section, &str); 5] = [
    (Section::Field, "FieldData"),
    (Section::Point, "PointData"),
    (Section::Cell, "CellData"),
    (Section::Points, "Points"),
    (Section::Cells, "Cells"),
];

struct Array {
    section: Section,
    name: &'static str,
    scalar: &'static str,
    scalar_size: u64,
    components: u64,
    tuples: usize,
    is_there: bool,
    write: fn(&Source<'_>, &mut dyn Write) -> io::Result<()>,
}

impl Array {
    fn bytes(&self) -> u64 {
        self.scalar_size * self.components * self.tuples as u64
    }

    /// Returns the number of bytes with the length before them, which is of the file's
    /// `header_type`.
    fn size_with_length(&self) -> u64 {
        8 + self.bytes()
    }

    fn declaration(&self, offset: u64) -> Declaration<'static> {
        let Self { name, scalar, components, .. } = *self;
        let tuples = (self.section == Section::Field).then_some(self.tuples);
        Declaration { name, scalar, components, tuples, offset }
    }
}

/// Declaration of an array in the XML; written in place, without a string between.
struct Declaration<'a> {
    name: &'a str,
    scalar: &'static str,
    components: u64,
    /// Number of tuples, where neither points nor cells say it.
    tuples: Option<usize>,
    offset: u64,
}

impl fmt::Display for Declaration<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, scalar, components, tuples, offset } = self;
        write!(f, r#"<DataArray type="{scalar}" Name="{name}" NumberOfComponents="{components}""#)?;
        if let Some(tuples) = tuples {
            write!(f, r#" NumberOfTuples="{tuples}""#)?;
        }
        write!(f, r#" format="appended" offset="{offset}"/>"#)
    }
}

/// Returns the arrays in the order of the XML, section by section.
fn arrays(mesh: &Triangulation) -> [Array; 16] {
    let (vertices, cells) = (mesh.vertex_count(), mesh.simplex_count());
    let segments = mesh.boundary.subsegments.len();
    // What goes beyond a bound is data of that which is bounded.
    let (bounded, marked) = match mesh.parameters.criterion {
        Criterion::VoronoiAspect => (Section::Point, vertices),
        Criterion::RadiusEdge => (Section::Cell, cells),
    };
    let array = |section, name, scalar, scalar_size, tuples, write| Array {
        section,
        name,
        scalar,
        scalar_size,
        components: 1,
        tuples,
        is_there: true,
        write,
    };
    let of_points =
        |name, scalar, size, write| array(Section::Point, name, scalar, size, vertices, write);
    let of_cells =
        |name, scalar, size, write| array(Section::Cell, name, scalar, size, cells, write);
    let of_segments = |name, scalar, size, write| Array {
        is_there: segments > 0,
        ..array(Section::Field, name, scalar, size, segments, write)
    };
    [
        Array { components: 2, ..of_segments("segments", "UInt32", 4, write_segments) },
        of_segments("segment_markers", "Int32", 4, write_markers),
        of_points("kind", "UInt8", 1, |source, out| {
            source.mesh.kinds.iter().try_for_each(|kind| out.write_all(&[*kind as u8]))
        }),
        of_points("domain", "UInt32", 4, |source, out| {
            let mut domains = source.mesh.vertex_domains.iter();
            domains.try_for_each(|domain| out.write_all(&domain.to_le_bytes()))
        }),
        of_points("input", "UInt32", 4, |source, out| {
            let first = |vertex| source.inputs.first_input(vertex).unwrap_or(NONE);
            let vertices = 0..source.mesh.vertex_count();
            vertices.map(first).try_for_each(|input| out.write_all(&input.to_le_bytes()))
        }),
        of_points("precision_limited", "UInt8", 1, |source, out| {
            let mut limited = source.mesh.precision_limited.iter();
            limited.try_for_each(|limited| out.write_all(&[u8::from(*limited)]))
        }),
        of_points("aspect", "Float64", 8, |source, out| {
            source.measures.aspect.iter().try_for_each(|x| out.write_all(&x.to_le_bytes()))
        }),
        // Not `domain`: viewers list the arrays of points and cells together.
        of_cells("cell_domain", "UInt32", 4, |source, out| {
            let mut simplices = source.mesh.simplices.chunks_exact(source.mesh.dim + 1);
            simplices.try_for_each(|simplex| {
                out.write_all(&domain_of(source.mesh, simplex).to_le_bytes())
            })
        }),
        of_cells("radius_edge", "Float64", 8, |source, out| {
            source.measures.radius_edge.iter().try_for_each(|x| out.write_all(&x.to_le_bytes()))
        }),
        of_cells("below_min_dihedral", "UInt8", 1, |source, out| {
            write_marks(&source.mesh.below_min_dihedral, source.mesh.simplex_count(), out)
        }),
        Array {
            is_there: !mesh.boundary.simplex_regions.is_empty(),
            ..of_cells("region", "Int32", 4, |source, out| {
                let mut labels = source.mesh.boundary.simplex_regions.iter();
                labels.try_for_each(|label| out.write_all(&label.to_le_bytes()))
            })
        },
        array(bounded, "beyond_bound", "UInt8", 1, marked, |source, out| {
            let count = match source.mesh.parameters.criterion {
                Criterion::VoronoiAspect => source.mesh.vertex_count(),
                Criterion::RadiusEdge => source.mesh.simplex_count(),
            };
            write_marks(&source.mesh.beyond_bound, count, out)
        }),
        Array {
            components: 3,
            ..array(Section::Points, "Points", "Float64", 8, vertices, write_points)
        },
        array(Section::Cells, "connectivity", "Int64", 8, mesh.simplices.len(), |source, out| {
            let mut ids = source.mesh.simplices.iter();
            ids.try_for_each(|v| out.write_all(&i64::from(*v).to_le_bytes()))
        }),
        array(Section::Cells, "offsets", "Int64", 8, cells, |source, out| {
            let size = source.mesh.dim as i64 + 1;
            (1..=source.mesh.simplex_count() as i64)
                .try_for_each(|cell| out.write_all(&(cell * size).to_le_bytes()))
        }),
        array(Section::Cells, "types", "UInt8", 1, cells, |source, out| {
            let cell_type = if source.mesh.dim == 2 { TRIANGLE } else { TETRA };
            (0..source.mesh.simplex_count()).try_for_each(|_| out.write_all(&[cell_type]))
        }),
    ]
}

/// Writes the two points of each edge that segments have become.
fn write_segments(source: &Source<'_>, out: &mut dyn Write) -> io::Result<()> {
    let mut ends = source.mesh.boundary.subsegments.as_flattened().iter();
    ends.try_for_each(|end| out.write_all(&end.to_le_bytes()))
}

fn write_markers(source: &Source<'_>, out: &mut dyn Write) -> io::Result<()> {
    let mut marked = source.mesh.boundary.marked(source.markers);
    marked.try_for_each(|(_, marker)| out.write_all(&marker.to_le_bytes()))
}

/// Writes 1 for each of `count` things that is among the `marked`, which rise, else 0.
fn write_marks(marked: &[u32], count: usize, out: &mut dyn Write) -> io::Result<()> {
    let mut marked = marked.iter().peekable();
    (0..count as u32).try_for_each(|id| {
        let is_marked = marked.next_if_eq(&&id).is_some();
        out.write_all(&[u8::from(is_marked)])
    })
}

/// Writes the points, which have three coordinates always in VTK.
fn write_points(source: &Source<'_>, out: &mut dyn Write) -> io::Result<()> {
    for point in source.mesh.points.chunks_exact(source.mesh.dim) {
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
    use crate::Mesh;
    use crate::error::ErrorKind;

    /// Returns the bytes of the array called `name`, found as a reader finds them; with `CellData/`
    /// before the name that of the cells.
    fn array_of<'a>(file: &'a [u8], name: &str) -> &'a [u8] {
        let end = file.windows(2).position(|pair| pair == b"\n_").unwrap();
        let mut xml = std::str::from_utf8(&file[..end]).unwrap();
        let (section, name) = name.split_once('/').unwrap_or(("Piece", name));
        xml = &xml[xml.find(&format!("<{section}")).unwrap()..];
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
            let ids: Vec<i64> = triangulation.simplices.iter().map(|&v| v.into()).collect();
            assert_eq!(integers(array_of(&file, "connectivity")), ids);
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
            let (inputs, vertices) = (mesh.inputs().distinct(), triangulation.vertex_count());
            let input = (0..vertices as u32).map(|v| if (v as usize) < inputs { v } else { NONE });
            let input: Vec<u8> = input.flat_map(u32::to_le_bytes).collect();
            assert_eq!(array_of(&file, "input"), input);
            assert!(file.ends_with(b"\n</AppendedData>\n</VTKFile>\n"));
        }
    }

    /// Holds that names are unique, since ParaView lists the arrays of points and cells together,
    /// and that each array has a number of components, since some readers take one without it as
    /// one of none.
    #[test]
    fn arrays_have_names_of_their_own_and_a_number_of_components() {
        let mut file = Vec::new();
        write(&samples::mesh(3), Format::Vtu, &mut file).unwrap();
        let text = String::from_utf8_lossy(&file);
        let declarations = text.lines().filter(|line| line.starts_with("<DataArray "));
        let mut names: Vec<&str> = declarations
            .map(|line| {
                let name = line.split("Name=\"").nth(1).unwrap().split('"').next().unwrap();
                let components = if name == "Points" { 3 } else { 1 };
                let expected = format!(" NumberOfComponents=\"{components}\" ");
                assert!(line.contains(&expected), "{line}");
                name
            })
            .collect();
        assert_eq!(names.len(), 13);
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), 13, "{names:?}");
        let mut left = vec![0; samples::mesh(3).triangulation().unwrap().simplex_count()];
        left[0] = 1;
        assert_eq!(array_of(&file, "below_min_dihedral"), left);
        for (section, first) in
            [("CellData", "cell_domain"), ("Points", "Points"), ("Cells", "connectivity")]
        {
            let (_, after) = text.split_once(&format!("<{section}>\n")).unwrap();
            let name = format!("Name=\"{first}\"");
            assert!(after.lines().next().unwrap().contains(&name), "{section}");
        }
    }

    /// Holds that what goes beyond a bound is data of that which is bounded.
    #[test]
    fn marks_beyond_the_bound_stand_with_what_is_bounded() {
        let count = |criterion, marked: Vec<u32>| {
            let mut mesh = samples::mesh(3).triangulation().unwrap().clone();
            mesh.parameters.criterion = criterion;
            mesh.beyond_bound = marked;
            let inputs = samples::mesh(3).inputs().clone();
            let mut file = Vec::new();
            write(&Mesh::from_parts(inputs, mesh), Format::Vtu, &mut file).unwrap();
            let text = String::from_utf8_lossy(&file);
            let end = text.find("</PointData>").unwrap();
            let is_of_points = text.find("Name=\"beyond_bound\"").unwrap() < end;
            (is_of_points, array_of(&file, "beyond_bound").to_vec())
        };
        let [vertices, simplices] = {
            let mesh = samples::mesh(3);
            let mesh = mesh.triangulation().unwrap();
            [mesh.vertex_count(), mesh.simplex_count()]
        };
        let marks = |at: usize, count| (0..count).map(|i| u8::from(i == at)).collect::<Vec<_>>();
        let of_vertices = count(Criterion::VoronoiAspect, vec![2]);
        assert_eq!(of_vertices, (true, marks(2, vertices)));
        let of_simplices = count(Criterion::RadiusEdge, vec![1]);
        assert_eq!(of_simplices, (false, marks(1, simplices)));
    }

    #[test]
    fn labels_are_data_of_cells_and_segments_of_the_whole() {
        let mut file = Vec::new();
        write(&samples::square_with_segments(), Format::Vtu, &mut file).unwrap();
        let numbers = |name| {
            let words = array_of(&file, name).chunks_exact(4);
            words.map(|b| i32::from_le_bytes(b.try_into().unwrap())).collect::<Vec<_>>()
        };
        assert_eq!(numbers("CellData/region"), [7, -8]);
        assert_eq!(numbers("FieldData/segments"), [0, 2, 1, 0]);
        assert_eq!(numbers("FieldData/segment_markers"), [-5, 6]);
        let text = String::from_utf8_lossy(&file);
        assert!(text.contains(r#" NumberOfComponents="2" NumberOfTuples="2" format="#));
        let mut file = Vec::new();
        write(&samples::square(), Format::Vtu, &mut file).unwrap();
        let text = String::from_utf8_lossy(&file);
        assert!(!text.contains("FieldData") && !text.contains("region"));
    }

    #[test]
    fn names_the_formats_that_hold_higher_dimensions() {
        let error = write(&samples::mesh(4), Format::Vtu, &mut Vec::new()).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::InvalidArgument);
        assert!(error.message().contains("use OFF (nOFF) or TetGen"), "{error}");
    }

    #[test]
    fn the_first_of_equal_inputs_is_named() {
        let mut mesh =
            crate::Mesh::new(2, 5, &[0., 0., 0., 0., 1., 0., -0., 0., 0., 1.], 0).unwrap();
        mesh.run(&samples::delaunay(), None).unwrap();
        let mut file = Vec::new();
        write(&mesh, Format::Vtu, &mut file).unwrap();
        let expected: Vec<u8> = [0u32, 2, 4].iter().flat_map(|i| i.to_le_bytes()).collect();
        assert_eq!(array_of(&file, "input"), expected);
        let none: Vec<u8> = NONE.to_le_bytes().to_vec();
        assert_eq!(array_of(&file, "CellData/cell_domain"), none);
        // The hypotenuse is twice the radius.
        assert_eq!(doubles(array_of(&file, "radius_edge")), [0.5f64.sqrt()]);
        assert!(doubles(array_of(&file, "aspect")).iter().all(|aspect| aspect.is_nan()));
    }

    #[test]
    fn cells_have_a_domain_and_measures() {
        for dim in [2, 3] {
            let mesh = samples::nested(dim);
            let triangulation = mesh.triangulation().unwrap();
            let mut file = Vec::new();
            write(&mesh, Format::Vtu, &mut file).unwrap();
            let domains = array_of(&file, "CellData/cell_domain").chunks_exact(4);
            let domains: Vec<u32> =
                domains.map(|b| u32::from_le_bytes(b.try_into().unwrap())).collect();
            let simplices = triangulation.simplices.chunks_exact(dim + 1);
            let expected: Vec<u32> = simplices.map(|s| domain_of(triangulation, s)).collect();
            assert_eq!(domains, expected);
            assert!(domains.contains(&0) && domains.contains(&1));
            let aspect = doubles(array_of(&file, "aspect"));
            let measures = match dim {
                2 => Measures::new::<2>(triangulation).unwrap(),
                _ => Measures::new::<3>(triangulation).unwrap(),
            };
            samples::assert_same_bits(&aspect, &measures.aspect);
            samples::assert_same_bits(
                &doubles(array_of(&file, "radius_edge")),
                &measures.radius_edge,
            );
        }
    }
}
