//! Stanford's `.ply`: vertices and faces, and whatever else a header declares.

mod body;
mod header;

use super::allocation_failed;
use super::attributes::Scalar;
use super::choice::AttributeColumns;
use super::outer::{marked_sides, outer_triangles};
use super::polygons::Polygons;
use super::text::{Lines, Points};
use super::values::{Outline, Table, Values};
use crate::error::Result;
use crate::mesh::{Attribute, Triangulation};
use header::{Encoding, Header};
use std::io::{self, BufRead, Write};

pub(super) fn read(input: &mut dyn BufRead, attributes: &AttributeColumns) -> Result<Table> {
    let mut lines = Lines::new(input);
    let header = Header::read(&mut lines)?;
    let mut rows = Rows {
        points: Points::of_dimension(header.dim),
        values: header.values(attributes)?,
        face: Vec::new(),
        marker: 0,
        polygons: Polygons::default(),
        outline: Outline::default(),
    };
    match header.encoding {
        Encoding::Text => body::read_text(&header, &mut lines, &mut rows)?,
        // `lines` has taken no byte beyond the header's last line.
        Encoding::Binary { big_endian } => {
            body::read_binary(&header, input, big_endian, &mut rows)?;
        }
    }
    let left_out = header.left_out();
    let outline = Outline { facets: rows.polygons.surface(), ..rows.outline };
    Ok(Table { left_out, outline, ..Table::new(rows.points.finish()?, rows.values.finish()) })
}

/// Content of the rows that were read.
struct Rows {
    /// Points of the vertices.
    points: Points,
    /// Attributes of the vertices.
    values: Values,
    /// Vertices of the face that is read.
    face: Vec<u32>,
    /// Marker of the face that is read; 0 if it has none.
    marker: i32,
    polygons: Polygons,
    /// Segments between the vertices.
    outline: Outline,
}

impl Rows {
    fn add_point(&mut self, point: &[f64]) -> Result<()> {
        point.iter().try_for_each(|value| self.points.push(*value))
    }

    /// Adds the face whose vertices have been read.
    fn add_face(&mut self) -> Result<()> {
        let Self { face, marker, polygons, outline, .. } = self;
        polygons.add_face(face, std::mem::take(marker), outline)?;
        face.clear();
        Ok(())
    }
}

/// Writes a mesh of the plane or the boundary of one in space. If that was given facets, whose
/// markers these are, each triangle of the boundary has that of its facet, or 0.
pub(super) fn write(
    triangulation: &Triangulation,
    markers: &[i32],
    attributes: &[Attribute],
    out: &mut dyn Write,
) -> io::Result<()> {
    let faces = match triangulation.dim {
        2 => triangulation.simplex_count(),
        _ => outer_triangles(triangulation).count(),
    };
    write!(
        out,
        "ply\nformat binary_little_endian 1.0\ncomment netmesh: {}\nelement vertex {}\n\
         property double x\nproperty double y\nproperty double z\n\
         property uchar kind\nproperty uint domain\n",
        if triangulation.dim == 2 { "all triangles" } else { "the boundary of the tetrahedra" },
        triangulation.vertex_count(),
    )?;
    for attribute in attributes {
        for k in 0..attribute.components {
            writeln!(out, "property double {}", Scalar(attribute, k))?;
        }
    }
    writeln!(out, "element face {faces}\nproperty list uchar uint vertex_indices")?;
    let has_markers = triangulation.dim == 3 && !markers.is_empty();
    out.write_all(if has_markers { b"property int marker\n" } else { b"" })?;
    writeln!(out, "end_header")?;
    write_vertices(triangulation, attributes, out)?;
    match triangulation.dim {
        2 => triangulation.simplices.chunks_exact(3).try_for_each(|face| write_face(face, out)),
        _ if has_markers => write_marked_boundary(triangulation, markers, out),
        _ => outer_triangles(triangulation).try_for_each(|(_, face)| write_face(&face, out)),
    }
}

fn write_vertices(
    triangulation: &Triangulation,
    attributes: &[Attribute],
    out: &mut dyn Write,
) -> io::Result<()> {
    let points = triangulation.points.chunks_exact(triangulation.dim);
    let labels = triangulation.kinds.iter().zip(&triangulation.vertex_domains);
    for (vertex, (point, (kind, domain))) in points.zip(labels).enumerate() {
        for axis in 0..3 {
            out.write_all(&point.get(axis).unwrap_or(&0.0).to_le_bytes())?;
        }
        out.write_all(&[*kind as u8])?;
        out.write_all(&domain.to_le_bytes())?;
        let mut values = attributes.iter().flat_map(|attribute| attribute.of(vertex));
        values.try_for_each(|value| out.write_all(&value.to_le_bytes()))?;
    }
    Ok(())
}

fn write_marked_boundary(
    triangulation: &Triangulation,
    markers: &[i32],
    out: &mut dyn Write,
) -> io::Result<()> {
    let marked = marked_sides(triangulation, markers).map_err(allocation_failed)?;
    outer_triangles(triangulation).try_for_each(|(side, face)| {
        let marker = marked.binary_search_by_key(&side, |own| own.0).map_or(0, |at| marked[at].1);
        write_face(&face, out)?;
        out.write_all(&marker.to_le_bytes())
    })
}

fn write_face(vertices: &[u32], out: &mut dyn Write) -> io::Result<()> {
    out.write_all(&[3])?;
    vertices.iter().try_for_each(|vertex| out.write_all(&vertex.to_le_bytes()))
}

#[cfg(test)]
mod tests {
    use super::super::{Choice, Format, PointCloud, Table, read, read_table, samples, write};
    use crate::error::{ErrorKind, Result};

    const VERTICES: &str = "property float x\nproperty double y\n";

    #[test]
    fn text_is_read_whatever_else_is_declared() {
        let expected = PointCloud { dim: 2, coordinates: vec![1.0, 2.0, -3.0, 4e9] };
        for (header, rows) in [
            (format!("element vertex 2\n{VERTICES}"), "1 2\n-3 4e9"),
            (format!("comment c\nobj_info # o\nelement vertex 2\n{VERTICES}"), "1 2\n-3 4e9\n"),
            (
                "element vertex 2\nproperty list uchar int more\nproperty double y\n\
                 property uchar red\nproperty float x\nelement face 1\n\
                 property list uchar int vertex_indices\n"
                    .to_string(),
                "0 2 9 1\n2 5 6 4e9 255 -3\n3 0 1 1\n",
            ),
            (
                format!(
                    "element a 1\nproperty char x\nelement vertex 2\n{VERTICES}element b 0\n\
                     property int c\n"
                ),
                "7\n1 2\n-3 4e9\n",
            ),
        ] {
            let text = format!("ply\r\nformat ascii 1.0\n{header}end_header\n{rows}");
            assert_eq!(read(&mut text.as_bytes(), Format::Ply).unwrap(), expected, "{text:?}");
        }
    }

    /// Reads a vertex with every type of number beside its coordinates, an element before it and
    /// one after.
    #[test]
    fn binary_of_both_orders_is_read() {
        let scalars = ["char", "uint8", "int16", "ushort", "int", "uint32", "float32", "double"];
        let others: String =
            scalars.iter().enumerate().map(|(i, kind)| format!("property {kind} p{i}\n")).collect();
        let header = |order: &str| {
            format!(
                "ply\nformat binary_{order}_endian 1.0\nelement edge 2\nproperty short a\n\
                 element vertex 2\nproperty float z\n{others}property list ushort int l\n\
                 property double x\nproperty short y\nelement face 1\n\
                 property list uchar int vertex_indices\nend_header\n"
            )
        };
        let rows = |big: bool| {
            let mut rows = Vec::new();
            let mut put = |bytes: &[u8]| {
                let bytes = bytes.iter().copied();
                if big { rows.extend(bytes.rev()) } else { rows.extend(bytes) }
            };
            put(&[1, 2]);
            put(&[3, 4]);
            for (x, y, z) in [(0.1f64, -5i16, 0.1f32), (f64::MAX, i16::MAX, -0.0)] {
                put(&z.to_le_bytes());
                [1, 1, 2, 2, 4, 4, 4, 8].iter().for_each(|size| put(&vec![0x7f; *size]));
                put(&2u16.to_le_bytes());
                put(&[1; 4]);
                put(&[2; 4]);
                put(&x.to_le_bytes());
                put(&y.to_le_bytes());
            }
            put(&[3]);
            [0i32, 1, 0].iter().for_each(|id| put(&id.to_le_bytes()));
            rows
        };
        let expected = [0.1, -5.0, f64::from(0.1f32), f64::MAX, 32767.0, -0.0];
        for (order, big) in [("little", false), ("big", true)] {
            let file = [header(order).into_bytes(), rows(big)].concat();
            let read = read(&mut file.as_slice(), Format::Ply).unwrap();
            assert_eq!(read.dim, 3);
            samples::assert_same_bits(&read.coordinates, &expected);
        }
    }

    fn table(file: &[u8]) -> Result<Table> {
        read_table(&mut &*file, Format::Ply, &Choice::default())
    }

    /// Returns a file of four vertices with these faces, of which `order` says how they are written
    /// and `item` the type of their vertices; the faces come before the vertices.
    fn tetrahedron(order: &str, item: &str, faces: &[&[i32]]) -> Vec<u8> {
        let count = faces.len();
        let mut file = format!(
            "ply\nformat {order} 1.0\nelement face {count}\nproperty uchar red\n\
             property list uchar {item} vertex_index\nelement vertex 4\nproperty float x\n\
             property float y\nproperty float z\nend_header\n"
        )
        .into_bytes();
        if order == "ascii" {
            for face in faces {
                let ids: Vec<String> = face.iter().map(|id| format!(" {id}")).collect();
                file.extend(format!("9 {}{}\n", face.len(), ids.concat()).bytes());
            }
            file.extend(b"0 0 0\n1 0 0\n0 1 0\n0 0 1\n");
            return file;
        }
        let mut put = |bytes: &[u8]| match order {
            "binary_big_endian" => file.extend(bytes.iter().rev()),
            _ => file.extend(bytes),
        };
        for face in faces {
            put(&[9]);
            put(&[face.len() as u8]);
            face.iter().for_each(|id| match item {
                "float" => put(&(*id as f32 / 2.0).to_le_bytes()),
                _ => put(&id.to_le_bytes()),
            });
        }
        let points = [[0f32, 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]];
        points.as_flattened().iter().for_each(|x| put(&x.to_le_bytes()));
        file
    }

    #[test]
    fn faces_are_triangles_or_facets() {
        let orders = ["ascii", "binary_little_endian", "binary_big_endian"];
        for order in orders {
            let read = |faces: &[&[i32]]| table(&tetrahedron(order, "int", faces)).unwrap();
            let Table { outline, left_out, .. } = read(&[&[0, 1, 2], &[3, 1], &[2], &[0, 3, 1]]);
            assert!(outline.facets.are_triangles && left_out.is_empty());
            assert_eq!(outline.facets.inputs, [0, 1, 2, 0, 3, 1]);
            assert_eq!(outline.segments, [[3, 1]]);
            let Table { outline, .. } = read(&[&[0, 1, 2, 3], &[0, 3, 1]]);
            assert!(!outline.facets.are_triangles);
            assert_eq!(outline.facets.loops(0).collect::<Vec<_>>(), [[0, 1, 2, 3]]);
        }
        // In the plane, and without a list of vertices, faces are left out.
        for (header, row) in [
            ("property float y\nelement face 1\nproperty list uchar int vertex_indices", "2 0 1"),
            ("property float y\nproperty float z\nelement face 1\nproperty uchar red", "7"),
        ] {
            let z = if header.contains('z') { " 0" } else { "" };
            let file = format!(
                "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\n{header}\nend_header\n\
                 0 0{z}\n1 0{z}\n{row}\n"
            );
            let Table { outline, left_out, .. } = table(file.as_bytes()).unwrap();
            assert_eq!((outline.facets.count(), left_out.faces), (0, 1));
        }
    }

    /// Markers are of a mesh with facets alone: of both tetrahedra, the first has one side with the
    /// marker -5, the second one on a side that belongs to no facet, and others have none.
    #[test]
    fn markers_of_facets_are_written_and_read_back() {
        let mut file = Vec::new();
        write(&samples::solid_with_facets(), Format::Ply, &mut file).unwrap();
        let table = table(&file).unwrap();
        let facets = &table.outline.facets;
        assert!(facets.are_triangles && facets.count() == 6);
        for facet in 0..6 {
            let mut corners = facets.loops(facet).next().unwrap().to_vec();
            corners.sort_unstable();
            let expected = if corners == [0, 1, 2] { -5 } else { 0 };
            assert_eq!(facets.markers[facet], expected, "{corners:?}");
        }
        let mut file = Vec::new();
        write(&samples::mesh(3), Format::Ply, &mut file).unwrap();
        assert!(!String::from_utf8_lossy(&file).contains("marker"));
    }

    #[test]
    fn markers_are_whole_numbers_of_faces() {
        let file = |order: &str, kind: &str, markers: [&str; 2]| {
            let header = format!(
                "ply\nformat {order} 1.0\nelement vertex 3\nproperty uchar x\nproperty uchar y\n\
                 property uchar z\nproperty {kind} marker\nelement face 2\n\
                 property {kind} marker\nproperty list uchar uchar vertex_indices\nend_header\n"
            );
            if order == "ascii" {
                let [a, b] = markers;
                let rows = format!("0 0 0 7\n1 0 0 7\n0 1 0 7\n{a} 3 0 1 2\n{b} 2 0 1\n");
                return (header + &rows).into_bytes();
            }
            let number = |text: &str| {
                let value: f64 = text.parse().unwrap();
                match kind {
                    "uint" => (value as u32).to_le_bytes().to_vec(),
                    "float" => (value as f32).to_le_bytes().to_vec(),
                    _ => (value as i16).to_le_bytes().to_vec(),
                }
            };
            let mut file = header.into_bytes();
            for point in [[0, 0, 0], [1, 0, 0], [0, 1, 0]] {
                file.extend(point);
                file.extend(number("7"));
            }
            file.extend([number(markers[0]), vec![3, 0, 1, 2]].concat());
            file.extend([number(markers[1]), vec![2, 0, 1]].concat());
            file
        };
        for order in ["ascii", "binary_little_endian"] {
            let read = |kind: &str, markers| table(&file(order, kind, markers));
            let outline = read("short", ["-300", "41"]).unwrap().outline;
            assert_eq!((&*outline.facets.markers, &*outline.markers), (&[-300][..], &[41][..]));
            let outline = read("uint", ["2147483647", "0"]).unwrap().outline;
            assert_eq!((&*outline.facets.markers, &*outline.markers), (&[i32::MAX][..], &[0][..]));
            // Numbers that need not be whole are no markers.
            let outline = read("float", ["5", "6"]).unwrap().outline;
            assert_eq!((&*outline.facets.markers, &*outline.markers), (&[0][..], &[0][..]));
            let error = read("uint", ["1", "2147483648"]).unwrap_err();
            let place = match order {
                "ascii" => "line 16, column 1",
                _ => "byte 30 after the header",
            };
            let rule = "2147483648 is no marker: a whole number of 32 bits";
            assert_eq!(error.message(), format!("{place}: {rule}"));
            assert!(error.is_of_content());
        }
    }

    #[test]
    fn what_is_wrong_with_a_face_is_named() {
        let orders = ["ascii", "binary_little_endian", "binary_big_endian"];
        let outside = [
            "line 12, column 5: vertex id 4 of 4 vertices",
            "byte 25 after the header: vertex id 4 of 4 vertices",
            "byte 25 after the header: vertex id 4 of 4 vertices",
        ];
        for (order, message) in orders.into_iter().zip(outside) {
            let error = table(&tetrahedron(order, "int", &[&[0, 1, 2], &[0, 1, 4]])).unwrap_err();
            assert_eq!(error.kind(), ErrorKind::Format);
            assert_eq!(error.message(), message);
            assert!(error.is_of_content());
        }
        let message = |file: &[u8]| table(file).unwrap_err().message().to_string();
        let negative = message(&tetrahedron(orders[1], "int", &[&[0, -1, 2]]));
        assert_eq!(negative, "byte 7 after the header: vertex id -1 of 4 vertices");
        let half = message(&tetrahedron(orders[2], "float", &[&[2, 4, 3]]));
        assert_eq!(half, "byte 11 after the header: vertex id 1.5 of 4 vertices");
        let negative = message(&tetrahedron(orders[0], "int", &[&[0, -1, 2]]));
        assert_eq!(negative, "line 11, column 4: \"-1\" is no vertex id");
        let mut short = tetrahedron(orders[1], "int", &[&[0, 1, 2]]);
        short.truncate(short.len() - 4 * 12 - 2);
        assert!(message(&short).ends_with("0 of 1 elements \"face\""), "{}", message(&short));
    }

    #[test]
    fn vertices_read_back_bit_by_bit() {
        for dim in [2, 3] {
            let mesh = samples::mesh(dim);
            let mut file = Vec::new();
            write(&mesh, Format::Ply, &mut file).unwrap();
            let read = read(&mut file.as_slice(), Format::Ply).unwrap();
            let points = mesh.triangulation().unwrap().points.chunks_exact(dim);
            let third = |p: &[f64]| p.get(2).copied().unwrap_or(0.0);
            let expected: Vec<f64> = points.flat_map(|p| [p[0], p[1], third(p)]).collect();
            assert_eq!(read.dim, 3);
            samples::assert_same_bits(&read.coordinates, &expected);
        }
    }

    /// Holds that all facets of one tetrahedron have normals away from the vertex that is left out.
    #[test]
    fn the_boundary_looks_outward() {
        let points = [0., 0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1.];
        let mut mesh = crate::Mesh::new(3, 4, &points, 0).unwrap();
        mesh.run(&samples::delaunay(), None).unwrap();
        let mut file = Vec::new();
        write(&mesh, Format::Ply, &mut file).unwrap();
        let faces = &file[file.len() - 4 * 13..];
        let point =
            |id: u32| <[f64; 3]>::try_from(mesh.triangulation().unwrap().point(id)).unwrap();
        let mut left_out = Vec::new();
        for face in faces.chunks_exact(13) {
            assert_eq!(face[0], 3);
            let ids: Vec<u32> = face[1..]
                .chunks_exact(4)
                .map(|b| u32::from_le_bytes(b.try_into().unwrap()))
                .collect();
            let opposite = (0..4).find(|id| !ids.contains(id)).unwrap();
            let from =
                |id: u32| std::array::from_fn::<f64, 3, _>(|k| point(id)[k] - point(ids[0])[k]);
            let (a, b, c) = (from(ids[1]), from(ids[2]), from(opposite));
            let volume = c[0] * (a[1] * b[2] - a[2] * b[1])
                + c[1] * (a[2] * b[0] - a[0] * b[2])
                + c[2] * (a[0] * b[1] - a[1] * b[0]);
            assert_eq!(volume, -1.0, "{ids:?}");
            left_out.push(opposite);
        }
        left_out.sort_unstable();
        assert_eq!(left_out, [0, 1, 2, 3]);
    }
}
