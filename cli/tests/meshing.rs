//! Small runs from points to certified files.

mod workbench;

use workbench::Workbench;

/// Twenty points on a spiral, and the last one twice.
fn spiral(dim: usize) -> String {
    let mut text = String::new();
    for i in 0..21 {
        let turn = f64::from(i.min(19)) * 0.7;
        let coordinates = [turn.cos() * turn, turn.sin() * turn, turn * 0.3, (turn * 2.0).sin()];
        let words: Vec<String> = coordinates[..dim].iter().map(f64::to_string).collect();
        text += &(words.join(" ") + "\n");
    }
    text
}

fn bench_with_spiral(test: &str, dim: usize) -> Workbench {
    let bench = Workbench::new(test);
    bench.write("points.xyz", &spiral(dim));
    bench
}

#[test]
fn meshes_are_certified_in_two_three_and_four_dimensions() {
    for dim in 2..=4 {
        let bench = bench_with_spiral(&format!("certified_{dim}d"), dim);
        let outcome = bench.run("points.xyz -o mesh.off --validate");
        outcome.assert_success();
        assert!(outcome.stdout.contains(&format!("21 points in {dim}D, 1 duplicate")));
        assert!(outcome.stdout.contains("holds at level 3"), "{}", outcome.stdout);
        assert_eq!(bench.files(), ["mesh.off", "points.xyz"]);
    }
}

#[test]
fn finished_meshes_are_certified() {
    let bench = bench_with_spiral("finished", 2);
    let outcome = bench.run("points.xyz --finish --validate --criterion radius-edge --bound 1.5");
    outcome.assert_success();
    assert!(outcome.stdout.contains("well-spaced mesh, radius-edge ratio at most 1.5"));
    assert!(outcome.stdout.contains("holds at level 3"), "{}", outcome.stdout);
    assert!(outcome.stdout.contains(", 1 domain\n"), "{}", outcome.stdout);
}

#[test]
fn plain_delaunay_has_the_inputs_alone() {
    let bench = bench_with_spiral("plain", 3);
    let outcome = bench.run("points.xyz --algorithm delaunay --validate");
    outcome.assert_success();
    assert!(outcome.stdout.contains("20 vertices = 20 input + 0 Steiner + 0 cage"));
}

#[test]
fn every_mesh_format_is_written() {
    let bench = bench_with_spiral("formats", 3);
    for (output, format) in [("a.vtu", ""), ("b.off", ""), ("c.out", "--output-format vtu")] {
        bench.run(&format!("points.xyz -q -o {output} {format}")).assert_success();
        assert!(bench.files().contains(&output.to_owned()), "{output}");
    }
    bench.run("points.xyz -q -o d.node").assert_success();
    assert_eq!(bench.files(), ["a.vtu", "b.off", "c.out", "d.ele", "d.node", "points.xyz"]);
    assert!(bench.read("a.vtu").contains("UnstructuredGrid"));
}

#[test]
fn quiet_prints_nothing() {
    let bench = bench_with_spiral("quiet", 2);
    let outcome = bench.run("points.xyz -o mesh.vtu --quiet");
    outcome.assert_success();
    assert_eq!(outcome.stdout, "");
}

#[test]
fn summary_tells_counts_quality_and_time() {
    let bench = bench_with_spiral("summary", 2);
    let outcome = bench.run("points.xyz --stats");
    outcome.assert_success();
    for word in [
        "input",
        "Steiner",
        "simplices",
        "domain",
        "Voronoi aspect worst",
        "radius-edge",
        "degrees",
        "degree",
        "double precision",
        "vertices/s",
        "rounds",
        "touches",
        "epsilon 0.5",
    ] {
        assert!(outcome.stdout.contains(word), "no '{word}' in: {}", outcome.stdout);
    }
    assert!(!outcome.stdout.contains("certificate"));
}

#[test]
fn the_same_seed_makes_the_same_mesh() {
    let bench = bench_with_spiral("seed", 3);
    bench.run("points.xyz -q -o a.off --seed 5").assert_success();
    bench.run("points.xyz -q -o b.off --seed 5 --threads 2").assert_success();
    assert_eq!(bench.read("a.off"), bench.read("b.off"));
}

#[test]
fn an_existing_output_is_replaced() {
    let bench = bench_with_spiral("replace", 2);
    bench.write("mesh.off", "old");
    bench.run("points.xyz -q -o mesh.off").assert_success();
    assert!(bench.read("mesh.off").starts_with("OFF"));
}
