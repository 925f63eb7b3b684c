//! `--min-angle`, Triangle's `-q`.

mod workbench;

use serde_json::Value;
use workbench::Workbench;

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
