//! `--max-edge`, `--sizes` and `--background`.

use crate::workbench::Workbench;
use serde_json::Value;

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

/// Points under TetGen's names, with an attribute, and in a file with names of columns make one
/// mesh.
#[test]
fn a_background_has_sizes() {
    let bench = bench("background");
    let corners = ["-1 -1", "2 -1", "2 2", "-1 2"];
    let rows = |separator: &str, sizes: bool| {
        let size = |at: usize| if at % 3 == 0 { "0.02" } else { "0.2" };
        let row = |(at, corner): (usize, &&str)| match sizes {
            true => format!("{}{separator}{}\n", corner.replace(' ', separator), size(at)),
            false => format!("{corner}\n"),
        };
        corners.iter().enumerate().map(row).collect::<String>()
    };
    let numbered = |text: &str| -> String {
        text.lines().enumerate().map(|(at, line)| format!("{at} {line}\n")).collect()
    };
    bench.write("tetgen.b.node", &format!("4 2 0 0\n{}", numbered(&rows(" ", false))));
    bench.write("tetgen.b.mtr", "4 1\n0.02\n0.2\n0.2\n0.02\n");
    bench.write("with.node", &format!("4 2 1 0\n{}", numbered(&rows(" ", true))));
    bench.write("named.csv", &format!("x,y,size\n{}", rows(",", true)));
    let [tetgen, attribute, named, plain] =
        ["--background tetgen.b.node", "--background with.node", "--background named.csv", ""]
            .map(|arguments| vertices(&bench, arguments));
    assert!(tetgen > plain + 100, "{tetgen}, {plain}");
    assert_eq!([attribute, named], [tetgen; 2]);
    let both = vertices(&bench, "--background named.csv --max-edge 0.05");
    assert!(both > tetgen, "{both}, {tetgen}");
}

#[test]
fn a_background_without_sizes_is_refused() {
    let bench = bench("background_refused");
    bench.write("plain.csv", "x,y\n0,0\n1,0\n0,1\n");
    bench.write("flat.csv", "x,y,size\n0,0,1\n1,0,1\n");
    bench.write("space.csv", "x,y,z,size\n0,0,0,1\n1,0,0,1\n0,1,0,1\n0,0,1,1\n");
    bench.write("zero.csv", "x,y,size\n0,0,1\n1,0,0\n0,1,1\n");
    bench.write("few.xyz", "0 0\n1 0\n0 1\n");
    bench.write("few.mtr", "2 1\n1\n1\n");
    bench.write("ragged.csv", "x,y,size\n0,0,1\n1,0\n");
    bench.write("tensors.xyz", "0 0\n1 0\n0 1\n");
    bench.write("tensors.mtr", "3 3\n1 0 1\n4 0 4\n1 0 1\n");
    // The file does not say which of several attributes is a size.
    bench.write("three.node", "3 2 3 0\n0 0 0 1 0 1\n1 1 0 4 0 4\n2 0 1 1 0 1\n");
    bench.write("none.node", "3 2 0 0\n0 0 0\n1 1 0\n2 0 1\n");
    bench.write("surface.3mf", "PK");
    for (code, file, word) in [
        (4, "plain.csv", "size"),
        (4, "flat.csv", "rank"),
        (4, "space.csv", "dimensions"),
        (4, "zero.csv", "sizes[1] is 0"),
        (4, "few.xyz", "2 sizes for 3 points"),
        (4, "tensors.xyz", "tensors.mtr: line 1: 3 values a point, as metric tensors have them"),
        (4, "three.node", "3 attributes a point, and no names for them"),
        (4, "none.node", "every column of the file is a coordinate"),
        (4, "surface.3mf", "a 3MF file is a surface"),
        (3, "ragged.csv", "line 3: 2 columns"),
        (3, "none.csv", "none.csv"),
        (2, "points.what", "names no format that can be read"),
    ] {
        let run = bench.run(&format!("points.xyz --finish --background {file}"));
        run.assert_failure(code, &[word]);
    }
    bench.run("points.xyz --background few.xyz").assert_failure(4, &["few.mtr"]);
}

#[test]
fn what_is_no_size_is_refused() {
    let bench = bench("sizes_refused");
    bench.write("four.mtr", "4 1\n1\n1\n1\n1\n");
    bench.write("zero.mtr", "5 1\n1\n0\n1\n1\n1\n");
    bench.run("points.xyz --finish --max-edge -1").assert_failure(2, &["-1", "must be 0 (none)"]);
    bench.run("points.xyz --max-edge 1").assert_success();
    bench.write("good.mtr", "5 1\n1\n1\n1\n1\n1\n");
    bench.write("few.csv", "x,y,size\n0,0,1\n1,0,1\n0,1,1\n");
    for (option, words) in [
        ("--hierarchical --max-edge 1", "--max-edge is 1; it does not go with --hierarchical"),
        ("--algorithm svr --max-edge 1", "--max-edge is 1; it does not go with --algorithm svr"),
        ("--hierarchical --sizes good.mtr", "--sizes is given; it does not go with --hierarchical"),
        (
            "--hierarchical --background few.csv",
            "--background is given; it does not go with --hierarchical",
        ),
        (
            "--hierarchical --distance-ratio 0.5",
            "--distance-ratio is 0.5; it does not go with --hierarchical",
        ),
    ] {
        bench.run(&format!("points.xyz {option}")).assert_failure(2, &[words]);
    }
    let sized = |file: &str| bench.run(&format!("points.xyz --finish --sizes {file}"));
    sized("four.mtr").assert_failure(4, &["four.mtr", "4 sizes for 5 points"]);
    sized("zero.mtr").assert_failure(4, &["zero.mtr", "sizes[1] is 0"]);
    sized("none.mtr").assert_failure(3, &["none.mtr"]);
    bench.write("tensors.mtr", "5 3\n1 0 1\n1 0 1\n1 0 1\n1 0 1\n1 0 1\n");
    sized("tensors.mtr").assert_failure(4, &["tensors.mtr: line 1: 3 values a point"]);
    bench.write("wide.mtr", "5 1\n1\n1 0 1\n1\n1\n1\n");
    sized("wide.mtr").assert_failure(3, &["wide.mtr: line 3: 1 0 1; a size is one number"]);
}
