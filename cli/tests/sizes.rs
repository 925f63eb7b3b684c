//! `--max-edge` and `--sizes`.

mod workbench;

use serde_json::Value;
use workbench::Workbench;

fn bench(test: &str) -> Workbench {
    let bench = Workbench::new(test);
    bench.write("points.xyz", "0 0\n1 0\n0 1\n1 1\n0.4 0.3\n");
    bench
}

/// The vertices of a mesh that `arguments` make, and that has its certificate.
fn vertices(bench: &Workbench, arguments: &str) -> u64 {
    let line = format!("points.xyz --finish --validate --json made.json {arguments}");
    bench.run(&line).assert_success();
    let json: Value = serde_json::from_str(&bench.read("made.json")).expect("it is JSON");
    json["counts"]["vertices"].as_u64().expect("a count")
}

#[test]
fn edges_are_as_short_as_asked_for() {
    let bench = bench("sizes");
    bench.write("even.mtr", "# five points\n5 1\n0.05\n0.05\n0.05\n0.05\n0.05\n");
    bench.write("left.mtr", "5 1\n0.02\n0.2\n0.02\n0.2\n0.1\n");
    let plain = vertices(&bench, "");
    let [edges, even, left] =
        ["--max-edge 0.05", "--sizes even.mtr", "--sizes left.mtr"].map(|a| vertices(&bench, a));
    assert!(plain + 500 < left && left < even && even < edges, "{plain}, {even}, {edges}, {left}");
    assert_eq!(vertices(&bench, "--sizes even.mtr --max-edge 0.05"), edges);
}

#[test]
fn what_is_no_size_is_refused() {
    let bench = bench("sizes_refused");
    bench.write("four.mtr", "4 1\n1\n1\n1\n1\n");
    bench.write("zero.mtr", "5 1\n1\n0\n1\n1\n1\n");
    bench.run("points.xyz --finish --max-edge -1").assert_failure(2, &["-1", "must be 0 (none)"]);
    bench.run("points.xyz --max-edge 1").assert_failure(2, &["well-spaced output"]);
    let sized = |file: &str| bench.run(&format!("points.xyz --finish --sizes {file}"));
    sized("four.mtr").assert_failure(3, &["four.mtr", "4 sizes for 5 points"]);
    sized("zero.mtr").assert_failure(3, &["zero.mtr", "values[1] is 0"]);
    sized("none.mtr").assert_failure(3, &["none.mtr"]);
}
