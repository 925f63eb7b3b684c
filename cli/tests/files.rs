//! Standard input and output, an output that is the input, and files with more columns than
//! coordinates.

use crate::workbench::Workbench;

const SQUARE: &str = "0 0\n1 0\n0 1\n1 1\n0.5 0.25\n";

fn bench_with(test: &str, name: &str, text: &str) -> Workbench {
    let bench = Workbench::new(test);
    bench.write(name, text);
    bench
}

#[test]
fn standard_input_and_output_are_files_too() {
    let bench = bench_with("streams", "points.xyz", SQUARE);
    bench.run("points.xyz -q -o mesh.off").assert_success();
    let line = "- --input-format xyz -o - --output-format off";
    let outcome = bench.run_with_input(line, SQUARE);
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    assert_eq!(outcome.stdout.as_bytes(), bench.bytes("mesh.off"));
    for word in ["standard input: 5 points in 2D", "written     standard output"] {
        assert!(outcome.stderr.contains(word), "no '{word}' in: {}", outcome.stderr);
    }
    let quiet = bench.run_with_input(&format!("{line} -q"), SQUARE);
    assert_eq!((quiet.stderr.as_str(), quiet.stdout), ("", outcome.stdout));
    assert_eq!(bench.files(), ["mesh.off", "points.xyz"]);
}

#[test]
fn streams_need_a_format_that_fits() {
    let bench = bench_with("stream_formats", "points.xyz", SQUARE);
    bench
        .run_with_input("-", SQUARE)
        .assert_failure(2, &["standard input has no name", "--input-format"]);
    bench.run("points.xyz -o -").assert_failure(2, &["standard output has", "--output-format"]);
    bench
        .run("points.xyz -o - --output-format tetgen")
        .assert_failure(2, &["a TetGen mesh is two files"]);
    bench
        .run("points.xyz -o - --output-format off --json -")
        .assert_failure(2, &["standard output", "--json"]);
    bench
        .run_with_input("- --input-format xyz", "0 0\n1 zero\n")
        .assert_failure(3, &["standard input: line 2, column 2"]);
    bench.run_with_input("- --input-format vtu", SQUARE).assert_failure(
        2,
        &[
            "--input-format",
            "tetgen, gmsh, medit, off, ply, xyz, csv, npy, poly, smesh, stl, obj, geojson, wkt]",
        ],
    );
}

#[test]
fn the_input_is_not_replaced_without_force() {
    let nodes = "3 2 0 0\n0 0 0\n1 1 0\n2 0 1\n";
    let bench = bench_with("same_file", "same.node", nodes);
    bench.write("square.xyz", SQUARE);
    for line in [
        "same.node -o same.node",
        "same.node -o ./same.node",
        "same.node -o same.ele",
        "same.ele -o same.node --validate",
        "square.xyz -o square.xyz",
        "square.xyz --json square.xyz",
    ] {
        bench.run(line).assert_failure(2, &["this is the input", "--force"]);
    }
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("square.xyz", bench.directory().join("link.xyz")).unwrap();
        bench.run("square.xyz -o link.xyz").assert_failure(2, &["link.xyz: this is the input"]);
        bench.run("link.xyz -o square.xyz").assert_failure(2, &["square.xyz: this is the input"]);
        std::fs::remove_file(bench.directory().join("link.xyz")).unwrap();
    }
    assert_eq!(bench.read("same.node"), nodes);
    assert_eq!(bench.read("square.xyz"), SQUARE);
    assert_eq!(bench.files(), ["same.node", "square.xyz"]);
    bench.run("same.node -q -o same.node --force").assert_success();
    assert!(bench.read("same.node") != nodes);
    assert_eq!(bench.files(), ["same.ele", "same.node", "square.xyz"]);
}

/// No input is there: who is told of the output has not waited for a mesh.
#[test]
#[cfg(target_os = "linux")]
fn an_output_that_cannot_be_written_is_refused_before_anything_is_read() {
    let bench = Workbench::new("refused_before");
    bench.write("file", "");
    bench.write("mesh.off/file", "");
    let long = "a".repeat(300);
    for output in ["/proc/a.off", "file/a.off", "mesh.off", "a.off/", &format!("{long}.off")] {
        let name = output.trim_end_matches('/');
        for line in ["-o", "--json", "--alpha-shape optimal -o"] {
            bench.run(&format!("missing.xyz {line} {output}")).assert_failure(8, &[name]);
        }
    }
    let line = "missing.xyz --filtration alpha -o /proc/a.filtration";
    bench.run(line).assert_failure(8, &["/proc/a.filtration"]);
    // Both parts of the pair, and where there are segments those of segments.
    bench.write("a.ele/file", "");
    bench.run("missing.xyz -o a.node").assert_failure(8, &["a.ele"]);
    bench.write("b.edge/file", "");
    bench.write("points.xyz", SQUARE);
    bench.write("square.poly", "3 2 0 0\n0 0 0\n1 1 0\n2 0 1\n1 0\n0 0 1\n0\n");
    bench.run("square.poly -o b.node").assert_failure(8, &["b.edge"]);
    bench.run("points.xyz -o b.node --extent hull").assert_failure(8, &["b.edge"]);
    bench.run("points.xyz -q -o b.node").assert_success();
    assert!(!bench.files().iter().any(|name| name.ends_with(".tmp")));
}

#[test]
#[cfg(unix)]
fn links_to_files_that_are_not_there_are_followed() {
    use std::os::unix::fs::symlink;
    let bench = bench_with("dangling_links", "points.xyz", SQUARE);
    bench.write("there/file", "");
    for (name, target) in
        [("a.off", "there/a.off"), ("a.json", "there/a.json"), ("b.json", "there/a.off")]
    {
        symlink(target, bench.directory().join(name)).unwrap();
    }
    bench.run("points.xyz -o a.off --json b.json").assert_failure(2, &["b.json", "--json"]);
    bench.run("points.xyz -q -o a.off --json a.json").assert_success();
    for name in ["a.off", "a.json"] {
        assert!(bench.directory().join(name).is_symlink(), "{name} was replaced");
        assert!(!bench.bytes(&format!("there/{name}")).is_empty());
    }
    assert!(bench.read("there/a.json").starts_with('{'));
}

#[test]
fn mesh_and_record_do_not_go_to_one_file() {
    let bench = bench_with("one_file", "points.xyz", SQUARE);
    let outcome = bench.run("points.xyz -o a.off --json a.off");
    outcome.assert_failure(2, &["a.off", "--json"]);
    assert_eq!(bench.files(), ["points.xyz"]);
}

/// The square with a height and a colour.
const SCAN: &str = "0 0 9 9 9\n1 0 8 9 9\n0 1 7 9 9\n1 1 6 9 9\n0.5 0.25 5 9 9\n";

#[test]
fn columns_choose_the_coordinates() {
    let bench = bench_with("columns", "scan.xyz", SCAN);
    bench.write("points.xyz", SQUARE);
    bench.write("scan.csv", &format!("X,Y,H,r,g\n{}", SCAN.replace(' ', ",")));
    bench.write("other.csv", &format!("e,n,h,r,g\n{}", SCAN.replace(' ', ",")));
    bench.run("points.xyz -q -o expected.off").assert_success();
    let expected = bench.read("expected.off");
    for line in [
        "scan.xyz --columns 1-2",
        "scan.xyz --columns 1,2",
        "scan.csv",
        "scan.csv --columns x,y",
        "other.csv --columns E,n",
    ] {
        bench.run(&format!("{line} -q -o mesh.off")).assert_success();
        assert_eq!(bench.read("mesh.off"), expected, "{line}");
    }
    let outcome = bench.run("scan.xyz --columns 1-3 --algorithm delaunay");
    assert!(outcome.stdout.contains("5 points in 3D"), "{}", outcome.stdout);
}

#[test]
fn wrong_columns_name_the_option_the_column_and_the_rule() {
    let bench = bench_with("wrong_columns", "scan.xyz", SCAN);
    bench.write("scan.csv", &format!("e,n,h,r,g\n{}", SCAN.replace(' ', ",")));
    bench.write("mesh.off", "OFF\n2 0 0\n0 0 0\n1 1 1\n");
    for (line, words) in [
        ("scan.xyz --columns 1-6", &["scan.xyz: --columns: there is no column 6", "5 columns"][..]),
        ("scan.xyz --columns x,y", &["--columns: \"x\" is a name"]),
        (
            "scan.csv --columns x,y",
            &["--columns: no column is called \"x\"", "\"e\", \"n\", \"h\""],
        ),
        ("scan.xyz --columns 0-2", &["--columns", "they count from 1"]),
        ("scan.xyz --columns -3", &["--columns", "no two ends"]),
        ("scan.xyz --columns 1", &["--columns", "2 to 8"]),
        ("mesh.off --columns 1-2", &["--columns: OFF files say themselves"]),
    ] {
        bench.run(line).assert_failure(2, words);
    }
}

#[test]
fn too_many_dimensions_hint_at_columns() {
    let bench = bench_with("hint", "scan.xyz", SCAN);
    bench.write("wide.csv", "1,2,3,4,5,6,7,8,9\n2,2,3,4,5,6,7,8,9\n");
    bench.run("scan.xyz -o a.vtu").assert_failure(2, &["VTU holds", "not 5", "--columns"]);
    bench.run("wide.csv").assert_failure(4, &["dimension 9; it must be 2 to 8", "--columns"]);
    let chosen = bench.run("scan.xyz -o a.vtu --columns 1-4");
    chosen.assert_failure(2, &["not 4"]);
    assert!(!chosen.stderr.contains("--columns"), "{}", chosen.stderr);
}

/// The points of a surface are read if that is asked for, those of a mesh always; the summary says
/// so.
#[test]
fn what_is_left_out_is_told() {
    let off = "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n3 0 2 3\n3 1 2 3\n";
    let bench = bench_with("left_out", "solid.off", off);
    let outcome = bench.run("solid.off --points -o solid.msh --json solid.json");
    outcome.assert_success();
    let line = "left out    4 faces; --points asks for the points alone\n";
    assert!(outcome.stdout.contains(line), "{}", outcome.stdout);
    assert!(bench.read("solid.json").contains("\"faces\": 4"), "{}", bench.read("solid.json"));
    let again = bench.run("solid.msh");
    assert!(again.stdout.contains("left out    ") && again.stdout.contains(" cells; of the mesh"));
    bench.run("solid.msh -o again.xyz").assert_success();
    let points = bench.run("again.xyz").stdout;
    assert!(!points.contains("left out"), "{points}");
}

/// A file of points that begins with their number, and one with numbers between quotes.
#[test]
fn no_point_is_lost_to_a_header() {
    let bench = bench_with("headers", "scan.pts", "4\n0 0 0 5\n1 0 0 6\n0 1 0 7\n0 0 1 8\n");
    bench.write("quoted.csv", "\"0\",\"0\"\n\"1\",\"0\"\n\"0\",\"1\"\n");
    for (line, words) in [
        ("scan.pts", "scan.pts: 4 points in 3D"),
        ("scan.pts --attributes intensity -o scan.vtu", "attributes  intensity"),
        ("quoted.csv", "quoted.csv: 3 points in 2D"),
    ] {
        let outcome = bench.run(line);
        outcome.assert_success();
        assert!(outcome.stdout.contains(words), "{}", outcome.stdout);
    }
}
