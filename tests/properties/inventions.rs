//! What proptest invents.

use super::checks::readers::FORMATS;
use super::checks::{c_api, mesh, readers, signs};
use super::for_all;
use netmesh::Options;
use proptest::array::uniform;
use proptest::collection::vec;
use proptest::num::f64::{NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
use proptest::prelude::*;

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

/// Text that is nearly a file: numbers, separators, keywords.
fn nearly_a_file() -> impl Strategy<Value = String> {
    let word = prop_oneof![
        6 => finite().prop_map(|x| format!("{x:e}")),
        6 => (0u32..9).prop_map(|count| count.to_string()),
        1 => Just("OFF".to_string()),
        1 => Just("nOFF".to_string()),
        1 => Just("x,y,kind".to_string()),
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
