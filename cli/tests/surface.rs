//! The surface through the points, and the part inside it.

use crate::workbench::Workbench;

/// Points spread evenly over a unit sphere (a Fibonacci lattice), and one far from it.
fn sphere() -> String {
    let point = |i: usize| {
        let z: f64 = 1.0 - (2 * i + 1) as f64 / 300.0;
        let (sin, cos) = (2.399963229728653 * i as f64).sin_cos();
        let r = (1.0 - z * z).sqrt();
        format!("{} {} {z}\n", r * cos, r * sin)
    };
    (0..300).map(point).chain(["0 0 7\n".to_owned()]).collect()
}

#[test]
fn a_surface_is_written_and_told() {
    let bench = Workbench::new("surface");
    bench.write("scan.xyz", &sphere());
    let outcome = bench.run("scan.xyz --surface -o scan.off --json scan.json --validate");
    outcome.assert_success();
    // A sphere of v vertices has 2 v - 4 triangles.
    assert!(outcome.stdout.contains("596 triangles, 1 shell, 0 handles"), "{}", outcome.stdout);
    assert!(outcome.stdout.contains("1 point of 301 not on it"), "{}", outcome.stdout);
    assert!(bench.read("scan.off").starts_with("OFF\n300 596 0\n"));
    let json = bench.read("scan.json");
    for part in ["\"left_out\": 1", "\"points\": 301", "\"genus\": 0", "\"facets\": 596"] {
        assert!(json.contains(part), "{part}: {json}");
    }
    for name in ["scan.stl", "scan.obj", "scan.ply"] {
        bench.run(&format!("scan.xyz --surface -o {name} -q")).assert_success();
        let outcome = bench.run(&format!("{name} --min-dihedral 0 --validate"));
        outcome.assert_success();
    }
}

#[test]
fn what_it_encloses_is_meshed() {
    let bench = Workbench::new("surface_volume");
    bench.write("scan.xyz", &sphere());
    let outcome = bench.run("scan.xyz --surface --volume -o part.msh --validate");
    outcome.assert_success();
    assert!(outcome.stdout.contains("596 triangles, 1 shell, 0 handles"), "{}", outcome.stdout);
    assert!(outcome.stdout.contains("--min-dihedral 10"), "{}", outcome.stdout);
    assert!(bench.read("part.msh").contains("$MeshFormat"));
}

#[test]
fn an_open_surface_ends() {
    let bench = Workbench::new("surface_open");
    let upper = |line: &&str| line.split(' ').nth(2).is_some_and(|z| !z.starts_with('-'));
    let bowl: Vec<String> = sphere().lines().filter(upper).map(str::to_owned).collect();
    bench.write("bowl.xyz", &bowl.join("\n"));
    let outcome = bench.run("bowl.xyz --surface --open -o bowl.off --json bowl.json --validate");
    outcome.assert_success();
    assert!(
        outcome.stdout.contains(" triangles, 1 shell, 0 handles, 1 end\n"),
        "{}",
        outcome.stdout
    );
    let json = bench.read("bowl.json");
    for part in ["\"left_out\": 1", "\"ends\": 1", "\"is_one_sided\": false"] {
        assert!(json.contains(part), "{part}: {json}");
    }
    let closed = bench.run("bowl.xyz --surface");
    assert!(closed.stdout.contains("1 shell, 0 handles, volume 1.99"), "{}", closed.stdout);
    let outcome = bench.run("bowl.xyz --surface --open --volume");
    assert!(
        outcome.stderr.contains("'--open' cannot be used with '--volume'"),
        "{}",
        outcome.stderr
    );
    let arc = (0..40).map(|i| f64::from(i) * 0.08).map(|t| format!("{} {}\n", t.cos(), t.sin()));
    bench.write("arc.xyz", &arc.collect::<String>());
    let outcome = bench.run("arc.xyz --surface --open");
    assert!(outcome.stdout.contains("39 edges, 1 curve, 2 ends"), "{}", outcome.stdout);
}

#[test]
fn curves_close_in_the_plane() {
    let bench = Workbench::new("surface_plane");
    bench.write("square.xyz", "0 0\n1 0\n1 1\n0 1\n");
    let outcome = bench.run("square.xyz --surface -o square.obj");
    outcome.assert_success();
    assert!(outcome.stdout.contains("4 edges, 1 curve, area 1"), "{}", outcome.stdout);
    assert!(bench.read("square.obj").contains("v 0 0 0\n"));
    let outcome = bench.run("square.xyz --surface --volume --max-edge 0.5 --validate");
    outcome.assert_success();
}

#[test]
fn what_has_no_surface_is_refused_before_the_work() {
    let bench = Workbench::new("refused_surface");
    bench.write("points.xyz", "0 0\n4 0\n0 3\n");
    bench.write("four.xyz", "0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
    let lines = [
        ("points.xyz --surface -o a.vtu", "use .ply, .off, .stl or .obj"),
        ("points.xyz --surface -o -", "standard output has no name"),
        ("points.xyz --surface --algorithm svr", "leave --algorithm svr out"),
        ("points.xyz --volume", "--surface"),
        ("points.xyz --surface --alpha-shape 1", "--alpha-shape"),
        ("four.xyz --surface", "the input is 4D"),
    ];
    for (line, message) in lines {
        let outcome = bench.run(line);
        assert_eq!(outcome.code, 2, "{line}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(message), "{line}: {}", outcome.stderr);
    }
    let outcome = bench.run("points.xyz --surface -o a.stl");
    assert!(outcome.stderr.contains("STL has triangles in space"), "{}", outcome.stderr);
    assert_eq!(bench.files(), ["four.xyz", "points.xyz"]);
}
