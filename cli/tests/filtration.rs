//! A filtration in place of the mesh.

use crate::workbench::Workbench;

const TRIANGLE: &str = "0 0\n4 0\n0 3\n";

fn bench_with(test: &str) -> Workbench {
    let bench = Workbench::new(test);
    bench.write("points.xyz", TRIANGLE);
    bench
}

#[test]
fn alpha_values_are_those_of_the_delaunay_triangulation() {
    let bench = bench_with("alpha_filtration");
    bench.run("points.xyz --filtration alpha -o a.filtration").assert_success();
    let expected = "0 0 0\n0 1 0\n0 2 0\n1 2 0 2.25\n1 1 0 4\n1 2 1 6.25\n2 2 1 0 6.25\n";
    assert_eq!(bench.read("a.filtration"), expected);
    bench.run("points.xyz --filtration alpha -o a.dipha -q --threads 2").assert_success();
    assert_eq!(bench.bytes("a.dipha").len(), 8 * (5 + 3 * 7 + 1 + 9));
}

#[test]
fn a_mesh_has_a_filtration_of_its_own() {
    let bench = bench_with("mesh_filtration");
    bench.run("points.xyz --filtration mesh --finish -o m.filtration").assert_success();
    let text = bench.read("m.filtration");
    assert!(text.starts_with("0 0 0\n0 1 0\n0 2 0\n"), "{text}");
    // Vertices that are no inputs come later.
    assert!(text.lines().filter(|line| line.starts_with("0 ")).count() > 3);
}

#[test]
fn what_makes_no_filtration_is_refused_before_the_work() {
    let bench = bench_with("refused_filtration");
    let lines = [
        ("--filtration alpha", "--output"),
        ("--filtration beta -o a.dipha", "alpha, mesh"),
        ("--filtration alpha -o a.vtu", "use .filtration or .dipha"),
        ("--filtration alpha -o -", "standard output has no name"),
        ("--filtration alpha --algorithm svr -o a.dipha", "leave --algorithm svr out"),
        ("--filtration alpha --output-format vtu -o a.dipha", "--output-format"),
    ];
    for (line, message) in lines {
        let outcome = bench.run(&format!("points.xyz {line}"));
        assert_eq!(outcome.code, 2, "{line}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(message), "{line}: {}", outcome.stderr);
    }
    assert_eq!(bench.files(), ["points.xyz"]);
}
