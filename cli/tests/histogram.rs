//! `--histogram`: tables for people, arrays for programs.

use crate::workbench::Workbench;
use netmesh::quality::{Measure, histogram};
use netmesh::{Mesh, Options};
use serde_json::Value;

/// Points on a spiral in space.
fn points() -> Vec<f64> {
    let point = |i: i32| {
        let turn = f64::from(i) * 0.7;
        [turn.cos() * turn, turn.sin() * turn, turn * 0.3]
    };
    (0..40).flat_map(point).collect()
}

fn bench(test: &str) -> Workbench {
    let bench = Workbench::new(test);
    let lines =
        points().chunks(3).map(|p| format!("{} {} {}\n", p[0], p[1], p[2])).collect::<String>();
    bench.write("points.xyz", &lines);
    bench
}

fn counts(value: &Value) -> Vec<u64> {
    let numbers = value.as_array().expect("a list").iter();
    numbers.map(|count| count.as_u64().expect("a count")).collect()
}

#[test]
fn the_record_has_what_the_library_counts() {
    let bench = bench("histogram_json");
    bench.run("points.xyz -q --json a.json --histogram").assert_success();
    let json: Value = serde_json::from_str(&bench.read("a.json")).expect("it is JSON");
    let mut mesh = Mesh::new(3, 40, &points(), 0).expect("good points");
    mesh.run(&Options::default(), None).expect("it is meshed");
    let result = mesh.triangulation().expect("a result");
    let measures = [
        ("dihedral_angle", Measure::DihedralAngle, 6 * result.simplex_count()),
        ("smallest_angle", Measure::SmallestAngle, result.simplex_count()),
        ("radius_edge", Measure::RadiusEdge, result.simplex_count()),
    ];
    for (name, measure, total) in measures {
        let table = &json["histograms"][name];
        let edges: Vec<f64> = table["edges"].as_array().expect("a list").iter().map(edge).collect();
        let of = |at_hull| histogram(result, measure, at_hull, &edges).expect("edges ascend");
        let (off_hull, all) = (of(false), of(true));
        assert_eq!(counts(&table["counts"]), off_hull.counts[1..edges.len()], "{name}");
        let at_hull = counts(&table["counts_at_hull"]);
        let sum = counts(&table["counts"]).iter().chain(&at_hull).sum::<u64>();
        assert_eq!(sum, total as u64, "{name}: no value is outside the edges");
        let both = counts(&table["counts"]).into_iter().zip(at_hull).map(|(a, b)| a + b);
        assert!(both.eq(all.counts[1..edges.len()].iter().copied()), "{name}");
        assert_eq!(table["least"], all.least);
        assert_eq!(table["largest"], all.largest);
    }
    let aspects = &json["histograms"]["aspect"];
    assert!(aspects["counts_at_hull"].is_null());
    assert_eq!(aspects["largest"], json["quality"]["worst_aspect_anywhere"]);
}

fn edge(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| {
        assert_eq!(value, "inf");
        f64::INFINITY
    })
}

#[test]
fn people_get_tables_where_they_ask_for_them() {
    let bench = bench("histogram_text");
    let with = bench.run("points.xyz --histogram --json a.json");
    with.assert_success();
    for title in [
        "\ndihedral angles in degrees: ",
        "\nsmallest dihedral angle of each simplex in degrees: ",
        "\nradius-edge ratios: ",
        "\naspects of cells off the hull: ",
        "#####\n",
    ] {
        assert!(with.stdout.contains(title), "{title}: {}", with.stdout);
    }
    let without = bench.run("points.xyz --json b.json");
    assert!(!without.stdout.contains("radius-edge ratios"), "{}", without.stdout);
    let json: Value = serde_json::from_str(&bench.read("b.json")).expect("it is JSON");
    assert!(json["histograms"].is_null());
}

#[test]
fn in_the_plane_angles_are_those_of_triangles() {
    let bench = Workbench::new("histogram_plane");
    bench.write("points.xyz", "0 0\n1 0\n0 1\n0.4 0.3\n");
    let outcome = bench.run("points.xyz --algorithm delaunay --histogram");
    outcome.assert_success();
    assert!(outcome.stdout.contains("\nangles in degrees: 9 values from "), "{}", outcome.stdout);
    assert!(outcome.stdout.contains("\naspects of cells off the hull: 1 value from "));
}
