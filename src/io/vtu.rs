//! VTK's XML unstructured grid, with the arrays as appended raw binary: small, and exact.

use super::vtk::{
    DataArray, Grid, Numbers, Scalar, Section, write_numbers, write_points, write_types,
};
use super::{Data, Markers, allocation_failed};
use crate::arrays::domains::domain_of;
use crate::memory::{AllocResult, TryGrow, collected, with_capacity};
use crate::mesh::{Attribute, Inputs, NONE, Triangulation};
use crate::options::Criterion;
use crate::quality::Measures;
use std::io::{self, Write};

/// Data that the arrays are made of.
struct Source<'a> {
    inputs: &'a Inputs,
    mesh: &'a Triangulation,
    markers: Markers<'a>,
    measures: &'a Measures,
}

type Array<'a> = DataArray<'a, Source<'a>>;
type WriteNumbers<'a> = fn(&Source<'a>, &mut dyn Write) -> io::Result<()>;

pub(super) fn write(
    inputs: &Inputs,
    mesh: &Triangulation,
    markers: Markers<'_>,
    data: &Data<'_>,
    out: &mut dyn Write,
) -> io::Result<()> {
    let measures = data.measures_of(mesh)?;
    let source = Source { inputs, mesh, markers, measures: &measures };
    let own = arrays(mesh).map_err(allocation_failed)?;
    let added = collected(data.attributes.iter().map(array_of)).map_err(allocation_failed)?;
    let grid = Grid {
        points: mesh.vertex_count(),
        cells: cell_count(mesh),
        attributes: |section| if section == Section::Point { r#" Scalars="kind""# } else { "" },
        arrays: [&own, &added],
    };
    grid.write(&source, out)
}

/// Returns the array of an attribute.
fn array_of(attribute: &Attribute) -> Array<'_> {
    let Attribute { name, components, values, .. } = attribute;
    DataArray {
        section: Section::Point,
        name,
        scalar: Scalar::Float64,
        components: *components as u64,
        tuples: values.len() / components,
        is_global_id: false,
        numbers: Numbers::Values(values),
    }
}

/// Returns the arrays of the mesh, those of a section in the order of the XML.
fn arrays<'a>(mesh: &Triangulation) -> AllocResult<Vec<Array<'a>>> {
    let mut arrays = with_capacity(16)?;
    add_segments(mesh, &mut arrays)?;
    add_data(mesh, &mut arrays)?;
    add_cells(mesh, &mut arrays)?;
    Ok(arrays)
}

fn array<'a>(
    section: Section,
    name: &'static str,
    scalar: Scalar,
    tuples: usize,
    write: WriteNumbers<'a>,
) -> Array<'a> {
    let numbers = Numbers::Written(write);
    DataArray { section, name, scalar, components: 1, tuples, is_global_id: false, numbers }
}

fn add_segments<'a>(mesh: &Triangulation, arrays: &mut Vec<Array<'a>>) -> AllocResult<()> {
    let segments = mesh.boundary.subsegments.len();
    if segments == 0 {
        return Ok(());
    }
    let of_segments = |name, scalar, write| array(Section::Field, name, scalar, segments, write);
    let ends = of_segments("segments", Scalar::UInt32, write_segments);
    arrays.try_push(DataArray { components: 2, ..ends })?;
    arrays.try_push(of_segments("segment_markers", Scalar::Int32, write_markers))
}

/// Returns the number of cells: the simplices, and after them the triangles of facets.
fn cell_count(mesh: &Triangulation) -> usize {
    mesh.simplex_count() + mesh.boundary.subfacets.len()
}

fn add_data<'a>(mesh: &Triangulation, arrays: &mut Vec<Array<'a>>) -> AllocResult<()> {
    let (vertices, cells) = (mesh.vertex_count(), cell_count(mesh));
    let of_points = |name, scalar, write: WriteNumbers<'a>| {
        array(Section::Point, name, scalar, vertices, write)
    };
    let of_cells =
        |name, scalar, write: WriteNumbers<'a>| array(Section::Cell, name, scalar, cells, write);
    for array in [
        of_points("kind", Scalar::UInt8, |source, out| {
            write_numbers(source.mesh.kinds.iter().map(|kind| [*kind as u8]), out)
        }),
        of_points("domain", Scalar::UInt32, |source, out| {
            write_numbers(source.mesh.vertex_domains.iter().map(|id| id.to_le_bytes()), out)
        }),
        of_points("input", Scalar::UInt32, |source, out| {
            let first = |vertex| source.inputs.first_input(vertex).unwrap_or(NONE);
            let vertices = 0..source.mesh.vertex_count();
            write_numbers(vertices.map(first).map(u32::to_le_bytes), out)
        }),
        of_points("precision_limited", Scalar::UInt8, |source, out| {
            let limited = source.mesh.precision_limited.iter();
            write_numbers(limited.map(|limited| [u8::from(*limited)]), out)
        }),
        of_points("aspect", Scalar::Float64, |source, out| {
            write_numbers(source.measures.aspect.iter().map(|x| x.to_le_bytes()), out)
        }),
        // Not `domain`: viewers list the arrays of points and cells together.
        of_cells("cell_domain", Scalar::UInt32, |source, out| {
            let simplices = source.mesh.simplices.chunks_exact(source.mesh.dim + 1);
            let triangles = source.mesh.boundary.subfacets.iter().map(<[u32; 3]>::as_slice);
            let domain = |cell| domain_of(source.mesh, cell).to_le_bytes();
            write_numbers(simplices.chain(triangles).map(domain), out)
        }),
        of_cells("radius_edge", Scalar::Float64, |source, out| {
            let triangles = source.mesh.boundary.subfacets.iter().map(|_| &f64::NAN);
            let values = source.measures.radius_edge.iter().chain(triangles);
            write_numbers(values.map(|x| x.to_le_bytes()), out)
        }),
        of_cells("below_min_dihedral", Scalar::UInt8, |source, out| {
            write_marks(&source.mesh.below_min_dihedral, cell_count(source.mesh), out)
        }),
    ] {
        arrays.try_push(array)?;
    }
    if !mesh.boundary.simplex_regions.is_empty() {
        arrays.try_push(of_cells("region", Scalar::Int32, |source, out| {
            let triangles = source.mesh.boundary.subfacets.iter().map(|_| &0);
            let labels = source.mesh.boundary.simplex_regions.iter().chain(triangles);
            write_numbers(labels.map(|label| label.to_le_bytes()), out)
        }))?;
    }
    if !mesh.boundary.subfacets.is_empty() {
        arrays.try_push(of_cells("marker", Scalar::Int32, |source, out| {
            let simplices = (0..source.mesh.simplex_count()).map(|_| 0);
            let marked = source.mesh.boundary.marked_facets(source.markers.facets);
            let markers = simplices.chain(marked.map(|(_, marker)| marker));
            write_numbers(markers.map(i32::to_le_bytes), out)
        }))?;
        arrays.try_push(of_cells("facet", Scalar::UInt32, |source, out| {
            let simplices = (0..source.mesh.simplex_count()).map(|_| &NONE);
            let facets = simplices.chain(&source.mesh.boundary.subfacet_parents);
            write_numbers(facets.map(|facet| facet.to_le_bytes()), out)
        }))?;
        arrays.try_push(of_cells("flat", Scalar::UInt8, |source, out| {
            write_marks(&source.mesh.boundary.flat, cell_count(source.mesh), out)
        }))?;
        arrays.try_push(of_cells("forced", Scalar::UInt8, |source, out| {
            write_marks(&source.mesh.boundary.forced, cell_count(source.mesh), out)
        }))?;
    }
    // What goes beyond a bound is data of that which is bounded.
    let (section, bounded) = match mesh.parameters.criterion {
        Criterion::VoronoiAspect => (Section::Point, vertices),
        Criterion::RadiusEdge => (Section::Cell, cells),
    };
    arrays.try_push(array(section, "beyond_bound", Scalar::UInt8, bounded, |source, out| {
        let count = match source.mesh.parameters.criterion {
            Criterion::VoronoiAspect => source.mesh.vertex_count(),
            Criterion::RadiusEdge => cell_count(source.mesh),
        };
        write_marks(&source.mesh.beyond_bound, count, out)
    }))
}

fn add_cells<'a>(mesh: &Triangulation, arrays: &mut Vec<Array<'a>>) -> AllocResult<()> {
    let (vertices, cells) = (mesh.vertex_count(), cell_count(mesh));
    let points = array(Section::Points, "Points", Scalar::Float64, vertices, |source, out| {
        write_points(&source.mesh.points, source.mesh.dim, out)
    });
    arrays.try_push(DataArray { components: 3, ..points })?;
    let of_cells = |name, scalar, tuples, write| array(Section::Cells, name, scalar, tuples, write);
    let ends = mesh.simplices.len() + 3 * mesh.boundary.subfacets.len();
    arrays.try_push(of_cells("connectivity", Scalar::Int64, ends, |source, out| {
        let triangles = source.mesh.boundary.subfacets.as_flattened();
        let ids = source.mesh.simplices.iter().chain(triangles);
        write_numbers(ids.map(|v| i64::from(*v).to_le_bytes()), out)
    }))?;
    arrays.try_push(of_cells("offsets", Scalar::Int64, cells, |source, out| {
        let (size, simplices) = (source.mesh.dim as i64 + 1, source.mesh.simplex_count() as i64);
        let triangles = source.mesh.boundary.subfacets.len() as i64;
        let triangles = (1..=triangles).map(|cell| simplices * size + 3 * cell);
        let offsets = (1..=simplices).map(|cell| cell * size).chain(triangles);
        write_numbers(offsets.map(i64::to_le_bytes), out)
    }))?;
    arrays.try_push(of_cells("types", Scalar::UInt8, cells, |source, out| {
        write_types(source.mesh.dim, source.mesh.simplex_count(), out)?;
        write_types(2, source.mesh.boundary.subfacets.len(), out)
    }))
}

/// Writes the two points of each edge that segments have become.
fn write_segments(source: &Source<'_>, out: &mut dyn Write) -> io::Result<()> {
    let ends = source.mesh.boundary.subsegments.as_flattened().iter();
    write_numbers(ends.map(|end| end.to_le_bytes()), out)
}

fn write_markers(source: &Source<'_>, out: &mut dyn Write) -> io::Result<()> {
    let marked = source.mesh.boundary.marked(source.markers.segments);
    write_numbers(marked.map(|(_, marker)| marker.to_le_bytes()), out)
}

/// Writes 1 for each of `count` things that is among the `marked`, which rise, else 0.
fn write_marks(marked: &[u32], count: usize, out: &mut dyn Write) -> io::Result<()> {
    let mut marked = marked.iter().peekable();
    let mark = |id| [u8::from(marked.next_if_eq(&&id).is_some())];
    write_numbers((0..count as u32).map(mark), out)
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
    fn triangles_of_facets_are_cells_after_the_tetrahedra() {
        let mesh = samples::solid_with_facets();
        let mut file = Vec::new();
        write(&mesh, Format::Vtu, &mut file).unwrap();
        let numbers = |name| {
            let words = array_of(&file, name).chunks_exact(4);
            words.map(|b| i32::from_le_bytes(b.try_into().unwrap())).collect::<Vec<_>>()
        };
        let ids = [0, 1, 2, 3, 1, 2, 3, 4, 1, 0, 2, 3, 1, 2, 4, 2, 3];
        assert_eq!(integers(array_of(&file, "connectivity")), ids);
        assert_eq!(integers(array_of(&file, "offsets")), [4, 8, 11, 14, 17]);
        assert_eq!(array_of(&file, "types"), [10, 10, 5, 5, 5]);
        assert_eq!(numbers("CellData/region"), [7, -8, 0, 0, 0]);
        assert_eq!(numbers("CellData/marker"), [0, 0, -5, 9, 0]);
        assert_eq!(numbers("CellData/facet"), [-1, -1, 0, 2, -1]);
        assert_eq!(array_of(&file, "CellData/flat"), [0, 1, 0, 0, 0]);
        assert_eq!(array_of(&file, "CellData/forced"), [1, 0, 0, 0, 0]);
        assert_eq!(array_of(&file, "below_min_dihedral"), [1, 0, 0, 0, 0]);
        assert_eq!(numbers("FieldData/segments"), [3, 1, 1, 2, 2, 3]);
        assert_eq!(numbers("FieldData/segment_markers"), [6, 0, 0]);
        let radius_edge = doubles(array_of(&file, "radius_edge"));
        assert_eq!(radius_edge.len(), 5);
        assert!(radius_edge[2..].iter().all(|value| value.is_nan()));
        assert_eq!(numbers("CellData/cell_domain").len(), 5);
        let text = String::from_utf8_lossy(&file);
        assert!(text.contains(r#"NumberOfPoints="5" NumberOfCells="5""#));
        // Without facets there are simplices alone.
        let mut file = Vec::new();
        write(&samples::mesh(3), Format::Vtu, &mut file).unwrap();
        let text = String::from_utf8_lossy(&file);
        assert!(["\"marker\"", "\"facet\"", "\"flat\""].iter().all(|name| !text.contains(name)));
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
            let measures = Measures::of(triangulation).unwrap();
            samples::assert_same_bits(&aspect, &measures.aspect);
            samples::assert_same_bits(
                &doubles(array_of(&file, "radius_edge")),
                &measures.radius_edge,
            );
        }
    }
}
