//! Damaged files of the formats that other programs make meshes in: each is refused, with a message
//! that names the place.

use netmesh::ErrorKind::{Dimension, Format as Broken, NonFinite};
use netmesh::io::{Format, PointCloud, read};
use netmesh::{Error, ErrorKind};

fn from_bytes(bytes: &[u8], format: Format) -> Result<PointCloud, Error> {
    let mut input = bytes;
    read(&mut input, format)
}

/// Damaged files: what follows a beginning, the kind of the error, and the beginning of its
/// message.
type Damaged = (&'static str, ErrorKind, &'static str);

fn assert_refused(format: Format, beginning: &str, table: &[Damaged]) {
    for (rest, kind, message) in table {
        let text = format!("{beginning}{rest}");
        assert_bytes_refused(format, text.as_bytes(), *kind, message);
    }
}

fn assert_bytes_refused(format: Format, bytes: &[u8], kind: ErrorKind, message: &str) {
    let text = bytes.escape_ascii();
    let error = from_bytes(bytes, format).expect_err(&text.to_string());
    assert_eq!(error.kind(), kind, "{format:?} {text}: {error}");
    assert!(error.message().starts_with(message), "{format:?} {text}: {error}");
}

#[test]
fn gmsh_refuses_damaged_files() {
    assert_refused(
        Format::Gmsh,
        "",
        &[
            ("", Broken, "no section $Nodes"),
            ("1 2 3\n", Broken, "line 1: \"1 2 3\" is outside of a section"),
            ("$EndNodes\n", Broken, "line 1: \"$EndNodes\" is outside of a section"),
            ("$Nodes\n1\n1 1 2 3\n$EndNodes\n", Broken, "line 1: $Nodes before $MeshFormat"),
            ("$MeshFormat\n", Broken, "the file ends after line 1: the section $MeshFormat"),
            ("$MeshFormat\n4 0 8\n", Broken, "line 2: version \"4\"; versions 4.1 and 2 are read"),
            ("$MeshFormat\n4.1 1 8\n", Broken, "line 2: a binary file; only text is read"),
            ("$MeshFormat\n2.2\n", Broken, "line 2: a binary file; only text is read"),
            ("$MeshFormat\n2.2 0 8\n3\n", Broken, "line 3: \"3\" where $EndMeshFormat is expected"),
            (
                "$MeshFormat\n2.2 0 8\n",
                Broken,
                "the file ends after line 2: the section $MeshFormat",
            ),
            (
                "$A\n1 2\n$EndB\n",
                Broken,
                "the file ends after line 3: the section \"A\" has no end",
            ),
        ],
    );
}

#[test]
fn gmsh_refuses_damaged_nodes() {
    assert_refused(
        Format::Gmsh,
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n",
        &[
            ("", Broken, "the file ends after line 4: the number of nodes is missing"),
            ("1 2\n", Broken, "line 5: 2 columns where 1 are expected"),
            ("0\n$EndNodes\n", Broken, "the file holds no points"),
            ("2\n1 1 2 3\n", Broken, "the file ends after line 6: 1 of 2 nodes"),
            ("2\n1 1 2 3\n$EndNodes\n", Broken, "line 7: 1 columns where 4 are expected"),
            ("1\n1 1 2 3\n2 4 5 6\n$EndNodes\n", Broken, "line 7: \"2 4 5 6\" where $EndNodes"),
            ("1\n1 1 2 3\n", Broken, "the file ends after line 6: the section $Nodes has no end"),
            ("1\n-1 1 2 3\n", Broken, "line 6, column 1: \"-1\" is no node id"),
            ("1\n1 1 2\n", Broken, "line 6: 3 columns where 4 are expected"),
            (
                "1\n1 1 2 3\n$EndNodes\n$Elements\n",
                Broken,
                "the file ends after line 8: the number of",
            ),
            (
                "1\n1 1 2 3\n$EndNodes\n$Elements\nx\n",
                Broken,
                "line 9, column 1: \"x\" is no number of elements",
            ),
            (
                "1\n1 1 2 3\n$EndNodes\n$Elements\n2\n1 15 0 1\n",
                Broken,
                "the file ends after line 10: 1 of 2 elements",
            ),
            (
                "1\n1 1 2 3\n$EndNodes\n$Elements\n1\n1\n$EndElements\n",
                Broken,
                "line 10: an element without a type",
            ),
            (
                "1\n1 1 2 3\n$EndNodes\n$Elements\n1\n1 -2 0 1\n$EndElements\n",
                Broken,
                "line 10, column 2: \"-2\" is no type of an element",
            ),
            (
                "1\n1 1 2 3\n$EndNodes\n$Elements\n1\n1 15 0 1\n2 15 0 1\n$EndElements\n",
                Broken,
                "line 11: \"2 15 0 1\" where $EndElements is expected",
            ),
            (
                "1\n1 1 2 3\n$EndNodes\n$Elements\n18446744073709551615\n1 15 0 1\n",
                Broken,
                "the file ends after line 10: 1 of 18446744073709551615 elements",
            ),
            (
                "1\n1 1 2 3\n$EndNodes\n$Nodes\n1\n1 1 2 3\n$EndNodes\n",
                Broken,
                "line 8: a second section $Nodes",
            ),
        ],
    );
    assert_refused(
        Format::Gmsh,
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n",
        &[
            ("", Broken, "the file ends after line 4: the numbers of blocks and nodes"),
            ("1 1 1\n", Broken, "line 5: 3 columns where 4 are expected"),
            ("1 x 1 1\n", Broken, "line 5, column 2: \"x\" is no number of nodes"),
            ("0 0 0 0\n$EndNodes\n", Broken, "the file holds no points"),
            ("0 1 1 1\n$EndNodes\n", Broken, "the blocks hold 0 of 1 nodes"),
            ("2 1 1 1\n2 1 0 0\n", Broken, "the file ends after line 6: 1 of 2 blocks of nodes"),
            ("1 1 1 1\n2 1 0\n", Broken, "line 6: 3 columns where 4 are expected"),
            ("1 1 1 1\n2 1 2 1\n", Broken, "line 6: a block of nodes begins with"),
            ("1 1 1 1\n4 1 0 1\n", Broken, "line 6: a block of nodes begins with"),
            ("1 1 1 1\n2 x 0 1\n", Broken, "line 6, column 2: \"x\" is not a number"),
            ("1 1 1 1\n2 1 0 2\n", Broken, "line 6: 2 nodes where 1 of 1 are left"),
            (
                "1 1 1 1\n2 1 0 18446744073709551615\n",
                Broken,
                "line 6: 18446744073709551615 nodes where 1 of 1 are left",
            ),
            ("1 2 1 2\n2 1 0 2\n1\n", Broken, "the file ends after line 7: 1 of 2 nodes"),
            ("1 1 1 1\n2 1 0 1\n1 2\n", Broken, "line 7: 2 columns where 1 are expected"),
            ("1 1 1 1\n2 1 0 1\n1\n1 2\n", Broken, "line 8: 2 columns where 3 are expected"),
            ("1 1 1 1\n2 1 1 1\n1\n1 2 3 4\n", Broken, "line 8: 4 columns where 5 are expected"),
            ("1 1 1 1\n2 1 1 1\n1\n1 2 3 4 x\n", Broken, "line 8, column 5: \"x\" is not a number"),
        ],
    );
    assert_refused(
        Format::Gmsh,
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 1 1 1\n2 1 0 1\n1\n1 2 3\n$EndNodes\n\
         $Elements\n",
        &[
            ("", Broken, "the file ends after line 10: the numbers of blocks and elements"),
            ("1 1 1\n", Broken, "line 11: 3 columns where 4 are expected"),
            ("1 1 1 1\n", Broken, "the file ends after line 11: 0 of 1 blocks of elements"),
            ("1 1 1 1\n4 1 2 1\n", Broken, "line 12: a block of elements begins with: dimension"),
            ("1 1 1 1\n2 x 2 1\n", Broken, "line 12, column 2: \"x\" is not a number"),
            ("1 1 1 1\n2 1 2 2\n", Broken, "line 12: 2 elements where 1 of 1 are left"),
            ("1 2 1 2\n2 1 2 2\n1 1 2 3\n", Broken, "the file ends after line 13: 1 of 2 elements"),
            ("1 2 1 2\n2 1 2 1\n1 1 2 3\n", Broken, "line 13: the blocks hold 1 of 2 elements"),
            ("0 0 0 0\n1 2\n", Broken, "line 12: \"1 2\" where $EndElements is expected"),
        ],
    );
}

#[test]
fn medit_refuses_damaged_files() {
    assert_refused(
        Format::Medit,
        "",
        &[
            ("", Broken, "the file ends after line 0: a Medit file begins with"),
            ("Dimension 2\n", Broken, "line 1: the file does not begin with MeshVersionFormatted"),
            ("1 2\n", Broken, "line 1: the file does not begin with MeshVersionFormatted"),
        ],
    );
    assert_refused(
        Format::Medit,
        "MeshVersionFormatted 2\n",
        &[
            ("", Broken, "no field Vertices"),
            ("Vertices 1\n1 2 0\n", Broken, "line 2: Vertices before Dimension"),
            ("Dimension\n", Broken, "the file ends after line 2: the dimension is missing"),
            ("Dimension 2 3\n", Broken, "line 2: more than the dimension beside the keyword"),
            ("Dimension -2\n", Broken, "line 2, column 2: \"-2\" is no dimension"),
            ("Dimension 4\n", Dimension, "line 2: points of dimension 4; a Medit file has 2 or 3"),
            ("Dimension\n1\n", Dimension, "line 3: points of dimension 1"),
            ("Dimension 2\nDimension 2\n", Broken, "line 3: a second Dimension"),
            (
                "Dimension 2\nVertices\n",
                Broken,
                "the file ends after line 3: the number of vertices",
            ),
            ("Dimension 2\nVertices\n1 2\n", Broken, "line 4: 2 columns where 1 are expected"),
            ("Dimension 2\nVertices 0\nEnd\n", Broken, "the file holds no points"),
            (
                "Dimension 2\nVertices 2\n1 2 0\n",
                Broken,
                "the file ends after line 4: 1 of 2 vertices",
            ),
            ("Dimension 2\nVertices 2\n1 2 0\nEnd\n", Broken, "line 5: 1 columns where 3"),
            ("Dimension 2\nVertices 1\n1 2\n", Broken, "line 4: 2 columns where 3 are expected"),
            ("Dimension 3\nVertices 1\n1 2 0\n", Broken, "line 4: 3 columns where 4 are expected"),
            ("Dimension 2\nVertices 1\n1 2 x\n", Broken, "line 4, column 3: \"x\" is not a number"),
            (
                "Dimension 2\nVertices 1\n1 2 0\nVertices 1\n1 2 0\n",
                Broken,
                "line 5: a second field Vertices",
            ),
            ("Dimension 2\nVertices 1\n1 2 0\nEnd\n7\n", Broken, "line 6: more data after End"),
            ("Edges\n", Broken, "the file ends after line 2: the number of elements is missing"),
            ("Edges x\n", Broken, "line 2, column 2: \"x\" is no number of elements"),
            (
                "Dimension 2\nVertices 1\n1 2 0\nTriangles 2\n1 1 1 0\nEnd\n",
                Broken,
                "line 7: the field Triangles has 4 numbers; 2 elements have 4 each",
            ),
            (
                "Edges 1\n1 1\nDimension 2\nVertices 1\n1 2 0\nEnd\n",
                Broken,
                "line 4: the field Edges has 2 numbers; 1 elements have 3 each",
            ),
            (
                "Dimension 2\nVertices 1\n1 2 0\nTetrahedra\n18446744073709551615\n1 1 1 1 0\n",
                Broken,
                "line 7: the field Tetrahedra has 5 numbers; 18446744073709551615 elements have",
            ),
        ],
    );
}

#[test]
fn ply_refuses_damaged_headers() {
    assert_refused(
        Format::Ply,
        "",
        &[
            ("", Broken, "the file ends after line 0: the header of a PLY file"),
            ("PLY\n", Broken, "line 1: the file does not begin with ply"),
            ("ply\nelement vertex 1\n", Broken, "line 2: \"element vertex 1\" where format"),
            ("ply\nformat ascii 2.0\n", Broken, "line 2: \"format ascii 2.0\" where format"),
            ("ply\nformat ascii 1.0 x\n", Broken, "line 2: \"format ascii 1.0 x\" where format"),
        ],
    );
    assert_refused(
        Format::Ply,
        "ply\nformat ascii 1.0\n",
        &[
            ("", Broken, "the file ends after line 2: the header of a PLY file"),
            ("end_header\n", Broken, "line 3: there is no element vertex"),
            ("vertices 3\n", Broken, "line 3: \"vertices 3\" in the header"),
            ("end_header x\n", Broken, "line 3: \"end_header x\" in the header"),
            ("property float x\n", Broken, "line 3: a property before the first element"),
            ("element vertex\n", Broken, "line 3: 2 columns where 3 are expected"),
            ("element vertex -1\n", Broken, "line 3, column 3: \"-1\" is no number of elements"),
            ("element a 1\nelement a 1\n", Broken, "line 4: a second element \"a\""),
            ("element a 1\nend_header\n", Broken, "line 4: the element \"a\" has no properties"),
            ("element a 1\nproperty x\n", Broken, "line 4: \"property x\" is no property"),
            ("element a 1\nproperty real x\n", Broken, "line 4: \"real\" is no type of numbers"),
            ("element a 1\nproperty list int x\n", Broken, "line 4: \"property list int x\" is no"),
            ("element a 1\nproperty list float int x\n", Broken, "line 4: the length of a list is"),
            ("element a 1\nproperty int x\nproperty int x\n", Broken, "line 5: a second property"),
            (
                "element vertex 1\nproperty list uchar float x\n",
                Broken,
                "line 4: a coordinate that is a list",
            ),
            (
                "element vertex 1\nproperty float x\nproperty float z\nend_header\n",
                Broken,
                "line 6: the element vertex has no x or no y",
            ),
        ],
    );
    let many = (0..1001).map(|i| format!("property char p{i}\n")).collect::<String>();
    let text = format!("ply\nformat ascii 1.0\nelement vertex 1\n{many}");
    let expected = "line 1003: more than 1000 elements and properties";
    assert_bytes_refused(Format::Ply, text.as_bytes(), Broken, expected);
}

const VERTICES: &str = "property float x\nproperty float y\n";
const FACES: &str = "property list char int vertex_indices\n";

#[test]
fn ply_refuses_damaged_rows() {
    let header = format!(
        "ply\nformat ascii 1.0\nelement vertex 2\n{VERTICES}element face 1\n{FACES}end_header\n"
    );
    assert_refused(
        Format::Ply,
        &header,
        &[
            ("", Broken, "the file ends after line 8: 0 of 2 elements \"vertex\""),
            ("1 2\n", Broken, "the file ends after line 9: 1 of 2 elements \"vertex\""),
            ("1 2\n3 4\n", Broken, "the file ends after line 10: 0 of 1 elements \"face\""),
            ("1 2\n3\n", Broken, "line 10: the line ends before its last property"),
            ("1 2 3\n", Broken, "line 9, column 3: more numbers than the element has properties"),
            ("1 2\n3 4\n3 0 1\n", Broken, "line 11: the line ends before its last property"),
            ("1 2\n3 4\n-1\n", Broken, "line 11, column 1: \"-1\" is no length of a list"),
            ("1 2\n3 4\n2 0 1 1\n", Broken, "line 11, column 4: more numbers"),
            ("1 2\n3 4\n1 red\n", Broken, "line 11, column 2: \"red\" is not a number"),
            ("1 2\n3 4\n0\n5\n", Broken, "line 12: more data after the elements of the header"),
        ],
    );
    let none = format!("ply\nformat ascii 1.0\nelement vertex 0\n{VERTICES}end_header\n");
    assert_bytes_refused(Format::Ply, none.as_bytes(), Broken, "the file holds no points");
}

#[test]
fn ply_refuses_damaged_binary_rows() {
    let header = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex 1\n{VERTICES}element face 1\n\
         {FACES}end_header\n"
    );
    let file = |x: f32, rest: &[u8]| {
        let point = [x.to_le_bytes(), 2f32.to_le_bytes()].concat();
        [header.as_bytes(), &point, rest].concat()
    };
    for (x, rest, kind, message) in [
        (
            1.0,
            &[][..],
            Broken,
            "the file ends after byte 8 after the header: 0 of 1 elements \"face\"",
        ),
        (1.0, &[1, 0, 0, 0], Broken, "the file ends after byte 12 after the header: 0 of 1"),
        (1.0, &[0xff], Broken, "byte 9 after the header: a list of -1 numbers"),
        (
            1.0,
            &[0, 7],
            Broken,
            "byte 10 after the header: more data after the elements of the header",
        ),
        (f32::NAN, &[0], NonFinite, "byte 1 after the header: vertex 0, x: NaN; every coordinate"),
        (f32::INFINITY, &[0], NonFinite, "byte 1 after the header: vertex 0, x: inf; every"),
    ] {
        assert_bytes_refused(Format::Ply, &file(x, rest), kind, message);
    }
}

fn npy(header: &str, data: &[u8]) -> Vec<u8> {
    let length = (header.len() as u16).to_le_bytes();
    [b"\x93NUMPY\x01\x00", &length[..], header.as_bytes(), data].concat()
}

#[test]
fn npy_refuses_damaged_headers() {
    for (bytes, message) in [
        (&b""[..], "the file ends after byte 0: the header of an .npy file is not complete"),
        (b"\x93NUMP", "the file ends after byte 5: the header"),
        (b"PK\x03\x04\0\0\0\0", "byte 1: the file does not begin as an .npy file does"),
        (b"\x93NUMPY\x04\0\0\0", "byte 7: version 4.0; versions 1.0, 2.0 and 3.0 are read"),
        (b"\x93NUMPY\x01\x01\0\0", "byte 7: version 1.1;"),
        (b"\x93NUMPY\x01\0\xff\xff{", "the file ends after byte 11: the header"),
        (
            b"\x93NUMPY\x02\0\xff\xff\xff\xff{",
            "byte 9: a header of 4294967295 bytes; at most 65536",
        ),
        (b"\x93NUMPY\x03\0\x01\0\x01\0{", "byte 9: a header of 65537 bytes; at most 65536"),
        (b"\x93NUMPY\x01\0\0\0", "in the header: \"\" where \"{\" is expected"),
    ] {
        assert_bytes_refused(Format::Npy, bytes, Broken, message);
    }
    let rest = "'fortran_order': False, 'shape': (1, 2)}";
    let descr = "'descr': '<f8', ";
    for (header, kind, message) in [
        ("{}".into(), Broken, "'descr', 'fortran_order' and 'shape' are needed"),
        (format!("{{{rest}"), Broken, "'descr', 'fortran_order' and 'shape' are needed"),
        (format!("{{{descr}{rest} x"), Broken, "more than a dictionary"),
        (format!("{{{descr}{descr}{rest}"), Broken, "the key \"descr\" twice"),
        (format!("{{{descr}'a': 1, {rest}"), Broken, "the unknown key \"a\""),
        (format!("{{'descr': '<i8', {rest}"), Broken, "numbers of type \"<i8\"; doubles"),
        (format!("{{'descr': '|O', {rest}"), Broken, "numbers of type \"|O\"; doubles"),
        (format!("{{'descr': '', {rest}"), Broken, "numbers of type \"\"; doubles"),
        (format!("{{'descr': '\u{e9}f8', {rest}"), Broken, "numbers of type \"\u{e9}f8\"; doubles"),
        (
            format!("{{'descr': [('x', '<f8')], {rest}"),
            Broken,
            "a shape of 2 lengths; (points,) is needed",
        ),
        (format!("{{'descr': [('x', '|O')], {rest}"), Broken, "the field \"x\" is of type \"|O\""),
        (format!("{{'descr': [('x', [('y', '<f8')])], {rest}"), Broken, "\"[('y', '<f8')])]"),
        (format!("{{'descr': [('x', '<f8', 3)], {rest}"), Broken, "\"3)], "),
        (
            format!("{{'descr': [('x', '<f8', (9, 2000))], {rest}"),
            Broken,
            "fields of more than 10000",
        ),
        ("{'descr': [('x', '<f8'".into(), Broken, "\"\" where \")\" is expected"),
        (format!("{{'descr': 1, {rest}"), Broken, "\"1, 'fortran_order': False"),
        ("{'descr: 1}".into(), Broken, "a string without an end"),
        (
            format!("{{{descr}'fortran_order': 0}}"),
            Broken,
            "\"0}\" where True or False is expected",
        ),
        (format!("{{{descr}'shape': (1, 2}}"), Broken, "\"}\" where \")\" is expected"),
        (format!("{{{descr}'shape': 2}}"), Broken, "\"2}\" where \"(\" is expected"),
        (format!("{{{descr}'shape': (-1, 2)}}"), Broken, "\"-1, 2)}\" where a number below 2^64"),
        (
            format!("{{{descr}'shape': (18446744073709551616, 2)}}"),
            Broken,
            "\"18446744073709551616, 2)}\" where a number below 2^64",
        ),
        (
            format!("{{{descr}'shape': (3,)}}"),
            Broken,
            "a shape of 1 lengths; (points, dim) is needed",
        ),
        (format!("{{{descr}'shape': (3, 2, 2)}}"), Broken, "a shape of 3 lengths"),
        (format!("{{{descr}'shape': ()}}"), Broken, "a shape of 0 lengths"),
        (
            format!("{{{descr}'shape': (1, 1)}}"),
            Dimension,
            "points of dimension 1; it must be 2 to 8",
        ),
        (format!("{{{descr}'shape': (1, 9)}}"), Dimension, "points of dimension 9"),
    ] {
        let error = from_bytes(&npy(&header, &[0; 16]), Format::Npy).expect_err(&header);
        assert_eq!(error.kind(), kind, "{header}: {error}");
        let after = error.message().strip_prefix("byte 11: ").unwrap_or_else(|| panic!("{error}"));
        let after = after.strip_prefix("in the header: ").unwrap_or(after);
        assert!(after.starts_with(message), "{header}: {error}");
    }
}

#[test]
fn npy_refuses_damaged_arrays() {
    let header = |order: &str, points: &str| {
        format!("{{'descr': '<f8', 'fortran_order': {order}, 'shape': ({points}, 2)}}")
    };
    let bytes = |values: &[f64]| values.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>();
    let two = header("False", "2");
    let start = npy(&two, &[]).len();
    for (values, kind, message) in [
        (
            &[1.0, 2.0, 3.0][..],
            Broken,
            format!("the file ends after byte {}: 1 of 2 points", start + 24),
        ),
        (&[1.0; 5], Broken, format!("byte {}: more data after the array", start + 33)),
        (
            &[1.0, f64::NAN, 1.0, 1.0],
            NonFinite,
            format!("byte {}: point 0, coordinate 1: NaN;", start + 9),
        ),
        (
            &[1.0, 1.0, -f64::INFINITY],
            NonFinite,
            format!("byte {}: point 1, coordinate 0: -inf;", start + 17),
        ),
    ] {
        assert_bytes_refused(Format::Npy, &npy(&two, &bytes(values)), kind, &message);
    }
    let fortran = header("True", "2");
    let cut = npy(&fortran, &bytes(&[1.0, 2.0, 3.0]));
    let message = format!("the file ends after byte {}: 1 of 2 points, coordinate 1", cut.len());
    assert_bytes_refused(Format::Npy, &cut, Broken, &message);
    let infinite = npy(&fortran, &bytes(&[1.0, 2.0, 3.0, f64::INFINITY]));
    let message = format!("byte {}: point 1, coordinate 1: inf;", infinite.len() - 7);
    assert_bytes_refused(Format::Npy, &infinite, NonFinite, &message);
    let none = npy(&header("False", "0"), &[]);
    assert_bytes_refused(Format::Npy, &none, Broken, "the file holds no points");
}

/// Cut off after any byte, a file is refused; or nothing of the points is gone.
#[test]
fn files_cut_off_anywhere_are_refused() {
    let gmsh = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 2 1 2\n2 1 0 2\n1\n2\n1 2 0\n\
                3 4 5\n$EndNodes\n\
                $Elements\n0 0 0 0\n$EndElements\n";
    let gmsh_2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n2\n1 1 2 0\n2 3 4 5\n$EndNodes\n";
    let medit = "MeshVersionFormatted 2\nDimension 2\nVertices 2\n1 2 0\n3 4 0\nTriangles\n1\n\
                 1 2 2 0\nEnd\n";
    let ply = format!(
        "ply\nformat ascii 1.0\nelement vertex 2\n{VERTICES}element face 1\n{FACES}end_header\n\
         1 2\n3 4\n2 0 1\n"
    );
    let binary = ply.replace("ascii", "binary_little_endian");
    let (binary, _) = binary.split_once("1 2\n").unwrap();
    let rows = [1f32, 2.0, 3.0, 4.0].map(f32::to_le_bytes).concat();
    let binary_ply = [binary.as_bytes(), &rows, &[1, 0, 0, 0, 0]].concat();
    let data: Vec<u8> = [1f64, 2.0, 3.0, 4.0].iter().flat_map(|x| x.to_le_bytes()).collect();
    let npy = npy("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2)}", &data);
    // Whole but for its last line end, after a section's end; after the last reference of the
    // vertices, where the name of the next field is not complete, and after that of the triangles.
    let medit_rest = "\nTriangle".len() + "\nEnd".len() + 2;
    for (format, bytes, accepted) in [
        (Format::Gmsh, gmsh.as_bytes(), 3),
        (Format::Gmsh, gmsh_2.as_bytes(), 1),
        (Format::Medit, medit.as_bytes(), medit_rest),
        (Format::Ply, ply.as_bytes(), 1),
        (Format::Ply, &binary_ply, 0),
        (Format::Npy, &npy, 0),
    ] {
        let whole = from_bytes(bytes, format).unwrap();
        assert_eq!(whole.coordinates.len(), 2 * whole.dim);
        let mut unseen = 0;
        for end in 0..bytes.len() {
            match from_bytes(&bytes[..end], format) {
                Ok(points) => {
                    assert_eq!(points, whole, "{format:?} cut after {end} bytes");
                    unseen += 1;
                }
                Err(error) => assert_eq!(error.kind(), Broken, "{format:?} {end}: {error}"),
            }
        }
        assert_eq!(unseen, accepted, "{format:?}");
    }
}
