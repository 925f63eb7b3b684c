//! Whatever is wrong with a call, the exit code says whose turn it is, the message names the place,
//! and nothing is left behind.

use crate::workbench::Workbench;

const SQUARE: &str = "0 0\n1 0\n0 1\n1 1\n0.5 0.25\n";

/// A workbench with `points.xyz` in it.
fn bench_with(test: &str, points: &str) -> Workbench {
    let bench = Workbench::new(test);
    bench.write("points.xyz", points);
    bench
}

#[test]
fn no_arguments_is_wrong_usage() {
    Workbench::new("no_arguments").run("").assert_failure(2, &["Usage: netmesh"]);
}

#[test]
fn unknown_option_is_wrong_usage() {
    let bench = bench_with("unknown_option", SQUARE);
    bench.run("points.xyz --quality 3").assert_failure(2, &["--quality"]);
}

#[test]
fn unknown_format_name_is_wrong_usage() {
    let bench = bench_with("unknown_format_name", SQUARE);
    let outcome = bench.run("points.xyz -o mesh.vtu --output-format gltf");
    outcome.assert_failure(2, &["gltf", "vtu"]);
}

#[test]
fn value_that_is_no_number_is_wrong_usage() {
    let bench = bench_with("no_number", SQUARE);
    bench.run("points.xyz --bound big").assert_failure(2, &["--bound", "big"]);
}

#[test]
fn unknown_extension_of_the_output_is_wrong_usage() {
    let bench = bench_with("unknown_extension", SQUARE);
    bench.run("points.xyz -o mesh.gltf").assert_failure(2, &["mesh.gltf"]);
    assert_eq!(bench.files(), ["points.xyz"]);
}

#[test]
fn unknown_extension_of_the_input_is_wrong_usage() {
    let bench = Workbench::new("unknown_input_extension");
    bench.write("points.what", SQUARE);
    let outcome = bench.run("points.what");
    outcome.assert_failure(2, &["points.what", "can be read", ".xyz"]);
    assert!(!outcome.stderr.contains(".vtu"), "{}", outcome.stderr);
    bench.run("points.what --input-format xyz --quiet").assert_success();
}

#[test]
fn value_out_of_range_names_the_range() {
    let bench = bench_with("out_of_range", SQUARE);
    bench.run("points.xyz --bound 1").assert_failure(2, &["--bound is 1", "[2.2, 100]"]);
    bench.run("points.xyz --bound -3").assert_failure(2, &["--bound is -3"]);
    bench.run("points.xyz --epsilon nan").assert_failure(2, &["--epsilon is NaN"]);
}

#[test]
fn missing_input_is_named() {
    let bench = Workbench::new("missing_input");
    bench.run("nowhere.xyz -o mesh.vtu").assert_failure(3, &["nowhere.xyz"]);
    assert!(bench.files().is_empty());
}

#[test]
fn ragged_input_names_the_line() {
    let bench = bench_with("ragged", "0 0 0\n1 0 0\n0 1\n");
    bench.run("points.xyz -o mesh.vtu").assert_failure(3, &["points.xyz", "line 3"]);
    assert_eq!(bench.files(), ["points.xyz"]);
}

#[test]
fn word_in_the_input_names_the_line() {
    let bench = bench_with("word", "0 0 0\n1 zero 0\n");
    bench.run("points.xyz -o mesh.vtu").assert_failure(3, &["points.xyz", "line 2", "zero"]);
}

#[test]
fn empty_input_is_malformed() {
    let bench = bench_with("empty", "");
    bench.run("points.xyz -o mesh.vtu").assert_failure(3, &["points.xyz"]);
}

#[test]
fn non_finite_coordinate_is_refused() {
    let bench = bench_with("non_finite", "0 0\n1 0\nnan 1\n");
    bench.run("points.xyz -o mesh.vtu").assert_failure(4, &["points.xyz", "line 3", "finite"]);
    assert_eq!(bench.files(), ["points.xyz"]);
}

#[test]
fn fewer_than_two_distinct_points_are_refused() {
    let bench = bench_with("one_point", "1 2 3\n1 2 3\n");
    bench.run("points.xyz -o mesh.vtu").assert_failure(4, &["points.xyz", "distinct"]);
    assert_eq!(bench.files(), ["points.xyz"]);
}

#[test]
fn dimension_one_and_nine_are_refused() {
    let bench = bench_with("dimension_one", "1\n2\n3\n");
    bench.run("points.xyz").assert_failure(4, &["points.xyz", "dim"]);
    let nine = bench_with("dimension_nine", "1 2 3 4 5 6 7 8 9\n9 8 7 6 5 4 3 2 1\n");
    nine.run("points.xyz").assert_failure(4, &["points.xyz", "dim"]);
}

#[test]
fn plain_delaunay_of_a_line_is_refused() {
    let bench = bench_with("line", "0 0\n1 1\n2 2\n");
    bench.run("points.xyz -o mesh.vtu --algorithm delaunay").assert_failure(4, &["rank"]);
    assert_eq!(bench.files(), ["points.xyz"]);
}

#[test]
fn too_many_vertices_is_a_limit() {
    let bench = bench_with("max_vertices", SQUARE);
    bench
        .run("points.xyz -o mesh.vtu --max-vertices 6")
        .assert_failure(5, &["--max-vertices is 6"]);
    assert_eq!(bench.files(), ["points.xyz"]);
}

#[test]
fn format_that_cannot_hold_the_dimension_is_refused_before_the_work() {
    let bench = bench_with("vtu_4d", "0 0 0 0\n1 0 0 0\n0 1 0 1\n");
    bench
        .run("points.xyz -o mesh.vtu --max-vertices 1")
        .assert_failure(2, &["mesh.vtu", "VTU", "TetGen"]);
    assert_eq!(bench.files(), ["points.xyz"]);
}

#[test]
fn output_in_a_missing_directory_leaves_nothing() {
    let bench = bench_with("missing_directory", SQUARE);
    bench.run("points.xyz -o nowhere/mesh.vtu").assert_failure(8, &["nowhere/mesh.vtu"]);
    assert_eq!(bench.files(), ["points.xyz"]);
}

#[test]
fn output_that_is_a_directory_is_refused() {
    let bench = bench_with("output_directory", SQUARE);
    bench.run("points.xyz -o .").assert_failure(8, &["directory"]);
    assert_eq!(bench.files(), ["points.xyz"]);
}

#[test]
fn json_where_no_file_can_be_is_refused_before_the_work() {
    let bench = bench_with("json_nowhere", SQUARE);
    bench
        .run("points.xyz -o mesh.off --json no/such/a.json")
        .assert_failure(8, &["no/such/a.json"]);
    bench.run("points.xyz -o mesh.off --json .").assert_failure(8, &["directory"]);
    assert_eq!(bench.files(), ["points.xyz"]);
}

/// The limit that docs/command_line.md tells: the cage's diameter is twice `root_scale` times the
/// distance.
#[test]
fn points_whose_cage_leaves_the_doubles_are_a_limit() {
    let far = bench_with("far_apart", "0 0\n3.7e307 0\n-3.7e307 0\n0 3.7e307\n");
    far.run("points.xyz -o mesh.vtu").assert_failure(5, &["too large", "outer cage"]);
    assert_eq!(far.files(), ["points.xyz"]);
    let near = bench_with("less_far_apart", "0 0\n3.5e307 0\n-3.5e307 0\n0 3.5e307\n");
    near.run("points.xyz --validate -q").assert_success();
}

#[test]
fn numbers_that_cannot_be_get_their_range() {
    let bench = bench_with("whole_numbers", SQUARE);
    let largest = "it must be a whole number from 0 to 18446744073709551615";
    bench.run("points.xyz --seed -5").assert_failure(2, &["'-5' for '--seed <N>'", largest]);
    bench.run("points.xyz --max-vertices -1").assert_failure(2, &["--max-vertices", largest]);
    bench.run("points.xyz --threads 1.5").assert_failure(2, &["--threads", "0 to 4294967295"]);
}

#[test]
fn what_has_no_effect_is_told() {
    let bench = bench_with("without_effect", SQUARE);
    let told = |options: &str| {
        let outcome = bench.run(&format!("points.xyz {options}"));
        outcome.assert_success();
        outcome.stdout
    };
    let plain = told("--algorithm delaunay --finish --min-angle 20");
    assert!(plain.contains("--finish, --min-angle have no effect on that"), "{plain}");
    assert!(told("--algorithm svr --finish").contains("--finish has no effect on that"));
    assert!(!told("--algorithm delaunay").contains("no effect"));
    assert!(!told("--finish --min-angle 20").contains("no effect"));
}

#[test]
fn messages_name_what_the_command_line_has() {
    let bench = bench_with("words", SQUARE);
    let domain = "4 2 0 0\n0 0 0\n1 1 0\n2 1 1\n3 0 1\n4 0\n0 0 1\n1 1 2\n2 2 3\n3 3 0\n\
                  2\n0 0.2 0.2\n1 0.5 0\n1\n0 0.7 0.7 5\n";
    bench.write("holes.poly", domain);
    bench.write("cross.poly", "4 2 0 0\n0 0 0\n1 1 0\n2 1 1\n3 0 1\n2 0\n0 0 2\n1 1 3\n0\n");
    bench.run("holes.poly").assert_failure(4, &["holes.poly: holes[1] is on segments[0];"]);
    bench.run("cross.poly").assert_failure(4, &["with --crossings split they are split there"]);
    for (options, words) in [
        ("--extent boundary", "--extent boundary needs segments"),
        ("--interior parity", "--interior parity needs segments"),
        ("--interior parity --extent hull", "--interior parity does not go with --extent hull"),
        ("--algorithm delaunay --extent box", "--algorithm delaunay goes neither with segments"),
        ("--alpha-shape 1 --extent box", "--alpha-shape goes neither with segments"),
    ] {
        bench.run(&format!("points.xyz {options}")).assert_failure(2, &[words]);
    }
}

/// Formats that are read only are no formats for an output.
#[test]
fn only_formats_that_can_be_written_are_offered() {
    let bench = bench_with("offered", SQUARE);
    let outcome = bench.run("points.xyz -o - --output-format poly");
    outcome.assert_failure(2, &["--output-format", "[possible values: vtu, tetgen"]);
    let outcome = bench.run("points.xyz -o mesh.gltf");
    outcome.assert_failure(2, &["mesh.gltf", "names no format that can be written"]);
    for outcome in [outcome, bench.run("points.xyz -o - --output-format gltf")] {
        for read_only in ["poly", "obj", "geojson", "wkt"] {
            assert!(!outcome.stderr.contains(read_only), "{}", outcome.stderr);
        }
    }
    for name in ["mesh.poly", "mesh.obj", "mesh.geojson", "mesh.wkt"] {
        bench.run(&format!("points.xyz -o {name}")).assert_failure(2, &[name, "only read"]);
    }
    let refusal = "mesh.stl: STL holds the boundary of meshes of dimension 3, not 2; use PLY";
    bench.run("points.xyz -o mesh.stl").assert_failure(2, &[refusal]);
    let attributes = bench.run("points.xyz --columns 1,2 --attributes 1 -o mesh.what");
    attributes.assert_failure(2, &["names no format that can be written"]);
    assert_eq!(bench.files(), ["points.xyz"]);
}

/// Content that no mesh can have is refused (4); a file that is none of its format is malformed
/// (3); an option that does not fit is wrong usage (2).
#[test]
fn the_code_says_whether_the_file_or_its_content_is_wrong() {
    let bench = Workbench::new("content");
    let points = "4 2\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n";
    let sides = "4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n";
    for (code, rest, more, words) in [
        (4, "1 0\n1 1 9\n0\n", "", "line 7, column 3: point id 9; ids are 1 to 4"),
        (4, "1 0\n1 2 2\n0\n", "", "line 7: the segment has one point as both ends"),
        (4, "1 1\n1 1 2 0.5\n0\n", "", "line 7, column 4: 0.5 is no marker"),
        (4, "2 0\n1 1 3\n2 2 4\n0\n", "", "a.poly: segments[0] and segments[1] cross near"),
        (0, "2 0\n1 1 3\n2 2 4\n0\n", "--crossings split", ""),
        (4, &format!("{sides}1\n1 0.5 0\n"), "--extent boundary", "a.poly: holes[0] is on"),
        (4, "3 0\n1 1 2\n2 2 3\n3 3 4\n0\n", "--extent boundary", "a.poly: segments enclose"),
        (3, "1 0\n1 1 x\n0\n", "", "line 7, column 3: \"x\" is no point id"),
        (3, "2 0\n1 1 2\n", "", "the file ends after line 7: 1 of 2 segments"),
        (3, "1 0\n1 1\n0\n", "", "line 7: 2 columns where 3 are expected"),
        (2, "0\n0\n", "--extent boundary", "--extent boundary needs segments"),
        (2, sides, "--min-angle 50", "--min-angle is 50"),
    ] {
        bench.write("a.poly", &format!("{points}{rest}"));
        let outcome = bench.run(&format!("a.poly -q {more}"));
        match code {
            0 => outcome.assert_success(),
            _ => outcome.assert_failure(code, &["netmesh: ", words]),
        }
    }
    let same = "3 2\n1 0 0\n2 -0.0 0\n3 1 1\n1 0\n1 1 2\n0\n";
    bench.write("a.poly", same);
    bench.run("a.poly").assert_failure(4, &["a.poly: segments[0]", "the same point"]);
    bench.write("a.poly", "4 3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n1 0\n");
    bench.run("a.poly").assert_failure(3, &["a.poly: the file ends after line 6: 0 of 1 facets"]);
    bench.write("a.wkt", "POLYGON((0 0,1 0,1 1,0 1))");
    bench.run("a.wkt").assert_failure(4, &["a.wkt", "its last position must be its first"]);
    bench.write("a.wkt", "POLYGON((0 0,1 0,1 1,0 0)");
    bench.run("a.wkt").assert_failure(3, &["a.wkt: the file ends"]);
    bench.write("a.geojson", r#"{"type":"LineString","coordinates":[[0,0]]}"#);
    bench.run("a.geojson").assert_failure(4, &["a line with fewer than 2 positions"]);
    bench.write("a.off", "OFF\n2 1 0\n0 0 0\n1 0 0\n2 0 2\n");
    bench.run("a.off").assert_failure(4, &["a.off: line 5, column 3: vertex id 2 of 2 vertices"]);
    bench.write("a.3mf", "PK");
    bench.run("a.3mf").assert_failure(4, &["a.3mf: a 3MF file is a surface"]);
    bench.write("a.stl", "solid\nfacet normal 0 0 1\nouter loop\n");
    bench.run("a.stl").assert_failure(3, &["a.stl: the file ends after line 3: the last facet"]);
    bench.write("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n");
    bench.run("a.obj").assert_failure(4, &["a.obj: line 3, column 4: vertex id 3 of 2 vertices"]);
    bench.write("a.pts", "version: 1\nn_points: 1\n{\n0 0\n}\n");
    bench.run("a.pts").assert_failure(3, &["begins a file of landmarks of an image"]);
    bench.write("a.csv", "x;y\n0;0\n1;1\n");
    bench.run("a.csv").assert_failure(3, &["a.csv: line 1: semicolons separate the fields"]);
    bench.write("a.pts", "1\n1 2 3 4 5\n");
    bench.run("a.pts").assert_failure(4, &["5 columns below a number of points", "--columns"]);
}
