//! Inputs that proptest invents.

use super::checks::readers::FORMATS;
use super::checks::{c_api, facets, features, mesh, poly, readers, segments, signs, slivers};
use super::for_all;
use netmesh::io::write;
use netmesh::{Algorithm, Mesh, Options};
use proptest::array::uniform;
use proptest::collection::vec;
use proptest::num::f64::{NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
use proptest::prelude::*;
use proptest::sample::Index;

/// Any finite double, by its bits.
fn finite() -> impl Strategy<Value = f64> {
    POSITIVE | NEGATIVE | NORMAL | SUBNORMAL | ZERO
}

fn bytes(most: usize) -> impl Strategy<Value = Vec<u8>> {
    vec(any::<u8>(), 0..most)
}

fn signs_of_raw_bits<const D: usize>(cases: u32) {
    let points = vec(uniform::<_, D>(finite()), D + 2);
    for_all(cases, (points, 0..=D, 0..=D), |(points, a, b)| signs::check_points(&points, (a, b)));
}

#[test]
fn signs_of_raw_bit_patterns() {
    signs_of_raw_bits::<2>(1000);
    signs_of_raw_bits::<3>(500);
    signs_of_raw_bits::<4>(150);
    signs_of_raw_bits::<5>(40);
    signs_of_raw_bits::<6>(8);
}

#[test]
fn signs_of_structured_points() {
    for_all(2000, bytes(160), |data| signs::check(&data));
}

#[test]
fn meshes_of_any_bytes() {
    for_all(100, bytes(250), |data| mesh::check(&data));
}

#[test]
fn meshes_of_degenerate_points_without_slivers() {
    for_all(6, bytes(300), |data| slivers::check(&data));
}

#[test]
fn meshes_of_any_segments() {
    for_all(60, bytes(180), |data| segments::check(&data));
}

#[test]
fn meshes_of_any_facets() {
    for_all(60, bytes(120), |data| facets::check(&data));
}

#[test]
fn meshes_of_near_incidences() {
    for_all(150, bytes(120), |data| segments::check_near_incidences(&data));
}

/// Words of a `.poly` file in nearly their order.
#[test]
fn poly_files_that_are_nearly_right() {
    let number = prop_oneof![
        6 => (0u32..5).prop_map(|count| count.to_string()),
        2 => finite().prop_map(|x| format!("{x:e}")),
        1 => "[-+.0-9eExnaif#]{1,8}",
    ];
    let lines = vec((vec(number, 1..6), prop_oneof![9 => Just("\n"), 1 => Just("\n# \n\n")]), 0..9);
    for_all(3000, lines, |lines| {
        let text = lines.into_iter().map(|(words, end)| words.join(" ") + end);
        let square = "4 2\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n".to_owned();
        poly::check_text((square + &text.collect::<String>()).as_bytes());
    });
}

fn few_numbers() -> impl Strategy<Value = String> {
    prop_oneof![
        6 => (0u32..4).prop_map(|count| count.to_string()),
        2 => finite().prop_map(|x| format!("{x:e}")),
        1 => "[-+.0-9eExnaif]{1,8}",
    ]
}

/// Positions of a ring or a line, and lists around them.
#[test]
fn geojson_that_is_nearly_right() {
    let position = vec(few_numbers(), 2..3).prop_map(|numbers| format!("[{}]", numbers.join(",")));
    let ring = (vec(position, 2..6), any::<bool>()).prop_map(|(mut positions, is_closed)| {
        positions.extend(is_closed.then(|| positions[0].clone()));
        positions.join(",")
    });
    let name = "(Multi|)(Point|LineString|Polygon)|Feature|Geometry(Collection|)";
    let geometry = (name, vec(ring, 1..3), 0usize..5, 0..4u8, "[a-z\\[\\]{}:,\"\\\\]{0,4}");
    for_all(3000, geometry, |(name, rings, levels, order, noise)| {
        let lists = ["[".repeat(levels), "]".repeat(levels)];
        let coordinates = rings.join(&(lists[1].clone() + "," + &lists[0]));
        let coordinates = format!("\"coordinates\":{}{coordinates}{}", lists[0], lists[1]);
        let kind = format!("\"type\":\"{name}\"");
        let text = match order {
            0 => format!("{{{kind},{coordinates}}}"),
            1 => format!(
                "{{\"geometries\":[{{{coordinates},{kind}}}],\"type\":\"GeometryCollection\"}}"
            ),
            2 => format!("{{{coordinates},\"{noise}\":[],{kind}}}"),
            _ => format!("{{{coordinates}{noise},{kind}}}"),
        };
        features::check_text(text.as_bytes());
    });
}

#[test]
fn well_known_text_that_is_nearly_right() {
    let position = vec(few_numbers(), 1..4).prop_map(|numbers| numbers.join(" "));
    let word = prop_oneof![
        6 => position,
        4 => "[(),]{1,3}",
        4 => "(MULTI|)(POINT|LINESTRING|POLYGON)( |)(Z|M|EMPTY|)\\(",
        1 => Just("GEOMETRYCOLLECTION(".to_string()),
        1 => "(SRID=|)[0-9]{0,3};|#|\n",
    ];
    for_all(3000, vec(word, 0..12), |words| {
        features::check_text(words.concat().as_bytes());
    });
    let closed = vec((few_numbers(), few_numbers()), 1..6);
    for_all(1000, (closed, "POLYGON\\(|MULTILINESTRING\\(|LINESTRING"), |(points, begin)| {
        let positions = points.iter().chain(&points[..1]);
        let positions: Vec<String> = positions.map(|(x, y)| format!("{x} {y}")).collect();
        let end = if begin.ends_with('(') { "))" } else { ")" };
        features::check_text(format!("{begin}({}{end}", positions.join(",")).as_bytes());
    });
}

#[test]
fn meshes_of_raw_bit_patterns() {
    let sets = (2..=3usize).prop_flat_map(|dim| (Just(dim), vec(finite(), 2 * dim..=9 * dim)));
    for_all(40, sets, |(dim, mut coordinates)| {
        coordinates.truncate(coordinates.len() / dim * dim);
        let options = Options { max_vertices: 1500, ..Options::default() };
        let settings = super::checks::settings::Settings { options, valid: true };
        mesh::check_points(dim, &coordinates, &settings);
    });
}

#[test]
fn c_api_call_sequences() {
    for_all(250, bytes(300), |data| c_api::check(&data));
}

const PLY: &str = "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\n";

/// Text that is nearly a file: numbers, separators, keywords.
fn nearly_a_file() -> impl Strategy<Value = String> {
    let word = prop_oneof![
        6 => finite().prop_map(|x| format!("{x:e}")),
        6 => (0u32..9).prop_map(|count| count.to_string()),
        1 => Just("OFF".to_string()),
        1 => Just("nOFF".to_string()),
        1 => Just("x,y,kind".to_string()),
        2 => Just("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n".to_string()),
        2 => Just("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n".to_string()),
        1 => Just("$EndNodes".to_string()),
        2 => Just("MeshVersionFormatted 2\nDimension 2\nVertices\n".to_string()),
        2 => Just(format!("{PLY}end_header\n")),
        1 => Just(format!("{PLY}property list uchar int l\nelement face 1\nproperty int a\n\
                           end_header\n")),
        1 => "[-+.0-9eEnaif#]{1,12}",
    ];
    let separator = prop_oneof![
        5 => Just(" "),
        3 => Just("\n"),
        3 => Just(","),
        1 => Just("\r\n"),
        1 => Just("\t"),
    ];
    vec((word, separator), 0..30)
        .prop_map(|parts| parts.into_iter().map(|(word, end)| word + end).collect())
}

#[test]
fn files_of_any_bytes() {
    for_all(3000, bytes(200), |data| readers::check(&data));
}

#[test]
fn files_that_are_nearly_right() {
    for_all(3000, nearly_a_file(), |text| {
        for format in FORMATS {
            readers::check_text(format, text.as_bytes());
        }
    });
}

/// A file that a writer made, with some of its bytes changed, or cut off.
#[test]
fn files_with_a_few_wrong_bytes() {
    let mut mesh = Mesh::new(2, 4, &[0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1e-3], 0).unwrap();
    mesh.run(&Options { algorithm: Algorithm::Delaunay, ..Options::default() }, None).unwrap();
    for format in FORMATS {
        let mut file = Vec::new();
        write(&mesh, format, &mut file).unwrap();
        let changes = vec((any::<Index>(), any::<u8>()), 0..4);
        for_all(400, (changes, any::<Index>()), |(changes, end)| {
            let mut file = file.clone();
            for (place, byte) in changes {
                *place.get_mut(&mut file) = byte;
            }
            let end = (end.index(2 * file.len())).min(file.len());
            readers::check_text(format, &file[..end]);
        });
    }
}

#[test]
fn files_of_points() {
    let clouds = (2..=8usize)
        .prop_flat_map(|dim| vec(vec(finite(), dim), 1..12))
        .prop_flat_map(|points| (Just(points), any::<bool>()));
    for_all(500, clouds, |(points, commas)| {
        let (separator, format) = if commas { (",", FORMATS[3]) } else { (" ", FORMATS[2]) };
        let line = |point: &Vec<f64>| {
            let numbers: Vec<String> = point.iter().map(f64::to_string).collect();
            numbers.join(separator) + "\n"
        };
        let text: String = points.iter().map(line).collect();
        assert!(readers::check_text(format, text.as_bytes()), "refused {text:?}");
    });
}
