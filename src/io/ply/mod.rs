//! Stanford's `.ply`: vertices and faces, and whatever else a header declares.

mod body;
mod header;

use super::attributes::Scalar;
use super::choice::AttributeColumns;
use super::polygons::Polygons;
use super::text::{Lines, Points};
use super::values::{Outline, Table, Values};
use crate::error::Result;
use crate::mesh::{Attribute, NONE, Triangulation};
use header::{Encoding, Header};
use std::io::{self, BufRead, Write};

pub(super) fn read(input: &mut dyn BufRead, attributes: &AttributeColumns) -> Result<Table> {
    let mut lines = Lines::new(input);
    let header = Header::read(&mut lines)?;
    let mut rows = Rows {
        points: Points::of_dimension(header.dim),
        values: header.values(attributes)?,
        face: Vec::new(),
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
        let Self { face, polygons, outline, .. } = self;
        polygons.add_face(face, 0, outline)?;
        face.clear();
        Ok(())
    }
}

pub(super) fn write(
    triangulation: &Triangulation,
    attributes: &[Attribute],
    out: &mut dyn Write,
) -> io::Result<()> {
    let faces = match triangulation.dim {
        2 => triangulation.simplex_count(),
        _ => triangulation.neighbors.iter().filter(|&&neighbor| neighbor == NONE).count(),
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
    writeln!(out, "element face {faces}\nproperty list uchar uint vertex_indices\nend_header")?;
    write_vertices(triangulation, attributes, out)?;
    match triangulation.dim {
        2 => triangulation.simplices.chunks_exact(3).try_for_each(|face| write_face(face, out)),
        _ => write_boundary(triangulation, out),
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

/// Writes the facets without a neighbour, counterclockwise as seen from outside.
fn write_boundary(triangulation: &Triangulation, out: &mut dyn Write) -> io::Result<()> {
    const FACETS: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];
    for simplex in 0..triangulation.simplex_count() {
        let vertices = triangulation.simplex(simplex);
        for (neighbor, facet) in triangulation.neighbors_of(simplex).iter().zip(FACETS) {
            if *neighbor == NONE {
                write_face(&facet.map(|index| vertices[index]), out)?;
            }
        }
    }
    Ok(())
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
