//! `--min-angle`, Triangle's `-q`.

use crate::workbench::Workbench;
use serde_json::Value;

fn bench(test: &str) -> Workbench {
    let bench = Workbench::new(test);
    bench.write("points.xyz", "0 0\n1 0\n0 1\n0.4 0.3\n0.9 0.8\n");
    bench.write("space.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n");
    bench
}

#[test]
fn the_angle_becomes_a_bound_and_is_kept() {
    let bench = bench("min_angle");
    let outcome =
        bench.run("points.xyz --min-angle 33 --finish --validate --json a.json --histogram");
    outcome.assert_success();
    let task = "radius-edge ratio at most 0.918 (angles at least 33.00 degrees), seed 0";
    assert!(outcome.stdout.contains(task), "{}", outcome.stdout);
    let json: Value = serde_json::from_str(&bench.read("a.json")).expect("it is JSON");
    assert_eq!(json["options"]["criterion"], "radius-edge");
    assert!((json["options"]["min_angle"].as_f64().expect("a number") - 33.0).abs() < 1e-9);
    let least = json["histograms"]["smallest_angle"]["least"].as_f64().expect("a number");
    assert!((32.9999..40.0).contains(&least), "{least}");
}

#[test]
fn what_contradicts_it_is_named() {
    let bench = bench("min_angle_refused");
    bench
        .run("points.xyz --min-angle 33 --bound 1.5")
        .assert_failure(2, &["--min-angle <DEGREES>", "--bound <X>"]);
    bench
        .run("points.xyz --min-angle 33 --criterion aspect")
        .assert_failure(2, &["--min-angle <DEGREES>", "--criterion <CRITERION>"]);
    bench.run("points.xyz --min-angle 34").assert_failure(2, &["34", "[0.6, 33.7]"]);
    bench.run("space.xyz --min-angle 20").assert_failure(2, &["20", "must be 0 in 3D"]);
    assert_eq!(bench.files(), ["points.xyz", "space.xyz"]);
}

/// A square with a small square hole: `netmesh a.poly` meshes the domain, as Triangle does.
#[test]
fn a_poly_file_is_meshed_to_what_its_segments_enclose() {
    let bench = bench("min_angle_domain");
    bench.write(
        "a.poly",
        "8 2 0 0\n0 0 0\n1 100 0\n2 100 100\n3 0 100\n4 50 50\n5 50.1 50\n6 50.1 50.1\n7 50 50.1\n\
         8 0\n0 0 1\n1 1 2\n2 2 3\n3 3 0\n4 4 5\n5 5 6\n6 6 7\n7 7 4\n1\n0 50.05 50.05\n",
    );
    let outcome = bench.run("a.poly --min-angle 25 --validate --json a.json");
    outcome.assert_success();
    let task = "well-spaced mesh of what segments enclose, radius-edge ratio at most 1.1831";
    assert!(outcome.stdout.contains(task), "{}", outcome.stdout);
    let json: Value = serde_json::from_str(&bench.read("a.json")).expect("it is JSON");
    assert_eq!(
        (&json["options"]["output"], &json["options"]["extent"]),
        (&"well-spaced".into(), &"boundary".into())
    );
    let least = json["quality"]["min_angle_degrees"].as_f64().expect("a number");
    assert!(least >= 25.0 * (1.0 - 1e-9), "{least}");
    assert_eq!(json["quality"]["below_min_angle"], 0);
    let caged = bench.run("a.poly --min-angle 25 --hierarchical --json b.json");
    caged.assert_success();
    assert!(caged.stdout.contains("below 25.00 degrees that nothing forces"), "{}", caged.stdout);
    let json: Value = serde_json::from_str(&bench.read("b.json")).expect("it is JSON");
    assert!(json["quality"]["below_min_angle"].as_u64().expect("a number") > 0);
}
