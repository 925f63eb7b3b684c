//! The boundary of an alpha shape in place of the mesh.

use crate::workbench::Workbench;

/// The corners of a cube and of a smaller one far from it.
fn cubes() -> String {
    let corner = |at: usize, size: f64, shift: f64| {
        let [x, y, z] = [at & 1, at >> 1 & 1, at >> 2].map(|bit| bit as f64 * size + shift);
        format!("{x} {y} {z}\n")
    };
    (0..8).map(|at| corner(at, 2.0, 0.0)).chain((0..8).map(|at| corner(at, 1.0, 9.0))).collect()
}

#[test]
fn a_boundary_is_written_and_its_topology_told() {
    let bench = Workbench::new("alpha_shape");
    bench.write("points.xyz", &cubes());
    let outcome = bench.run("points.xyz --alpha-shape 3 -o shape.off --json shape.json");
    outcome.assert_success();
    assert!(outcome.stdout.contains("alpha 3.000: "), "{}", outcome.stdout);
    assert!(outcome.stdout.contains("volume 9"), "{}", outcome.stdout);
    assert!(outcome.stdout.contains("2 components, 0 tunnels, 0 cavities"), "{}", outcome.stdout);
    let text = bench.read("shape.off");
    // Six squares of two triangles each, twice.
    assert!(text.starts_with("OFF\n16 24 0\n0 0 0\n"), "{text}");
    let json = bench.read("shape.json");
    for part in ["\"alpha\": 3", "\"volume\": 9", "\"components\": 2", "\"tunnels\": 0"] {
        assert!(json.contains(part), "{part}: {json}");
    }
    bench.run("points.xyz --alpha-shape optimal -o shape.ply -q").assert_success();
    assert!(bench.bytes("shape.ply").starts_with(b"ply\n"));
    let outcome = bench.run("points.xyz --alpha-shape connected");
    // A quarter of the squared distance between the cubes.
    assert!(outcome.stdout.contains("alpha 36.75: "), "{}", outcome.stdout);
}

#[test]
fn other_dimensions_are_measured() {
    let bench = Workbench::new("alpha_shape_plane");
    bench.write("plane.xyz", "0 0\n1 0\n1 1\n0 1\n");
    let outcome = bench.run("plane.xyz --alpha-shape 0.25 -o shape.off");
    outcome.assert_success();
    assert!(outcome.stdout.contains("area 0"), "{}", outcome.stdout);
    assert!(outcome.stdout.contains("1 component, 1 hole"), "{}", outcome.stdout);
    bench.write("four.xyz", "0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
    let outcome = bench.run("four.xyz --alpha-shape 1");
    outcome.assert_success();
    assert!(outcome.stdout.contains("1 component, 0 voids"), "{}", outcome.stdout);
    let outcome = bench.run("four.xyz --alpha-shape 1 -o four.off");
    assert_eq!(outcome.code, 2, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("the input is 4D"), "{}", outcome.stderr);
}

#[test]
fn what_makes_no_shape_is_refused_before_the_work() {
    let bench = Workbench::new("refused_alpha_shape");
    bench.write("points.xyz", "0 0\n4 0\n0 3\n");
    let lines = [
        ("--alpha-shape -1 -o a.off", "squared radius of at least 0"),
        ("--alpha-shape nan", "squared radius of at least 0"),
        ("--alpha-shape best", "connected or optimal"),
        ("--alpha-shape 1 -o a.vtu", "use .ply, .off, .stl or .obj"),
        ("--alpha-shape 1 -o -", "standard output has no name"),
        ("--alpha-shape 1 --algorithm svr", "leave --algorithm svr out"),
        ("--alpha-shape 1 --finish", "--finish"),
        ("--alpha-shape 1 --filtration alpha -o a.dipha", "--filtration"),
    ];
    for (line, message) in lines {
        let outcome = bench.run(&format!("points.xyz {line}"));
        assert_eq!(outcome.code, 2, "{line}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(message), "{line}: {}", outcome.stderr);
    }
    assert_eq!(bench.files(), ["points.xyz"]);
}
