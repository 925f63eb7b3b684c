//! Polygons of files, and the triangles that they become.

use crate::facets::{CUBE, pyramid};
use crate::workbench::Workbench;
use serde_json::{Value, json};

/// A tetrahedron within the cube.
const TETRAHEDRON: &str = "OFF\n4 4 0\n0.25 0.25 0.25\n0.75 0.25 0.25\n0.25 0.75 0.25\n\
                           0.25 0.25 0.75\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

/// A polygon that crosses itself.
const CROSSED: &str = "OFF\n4 1 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n4 0 1 2 3\n";

/// The cube with a corner that stands up, and facets besides.
fn bent(more: &str) -> String {
    let count = 6 + more.lines().count();
    let cube = CUBE.replacen("8 6 0", &format!("9 {count} 0"), 1);
    cube.replacen("1 1 1\n0 1 1\n", "1 1 1.3\n0 1 1\n0.5 0 0\n", 1) + more
}

/// Returns what a record has about polygons that have become triangles: their number, that of those
/// without an area, the reason, and a facet that is not plane.
fn triangulated(record: &str) -> [Value; 4] {
    let record: Value = serde_json::from_str(record).unwrap();
    let names = ["triangulated", "triangulated_without_area", "triangulated_since", "not_plane"];
    names.map(|name| record["repairs"][name].clone())
}

/// Polygons are meshed as triangles where that is asked for, or where one is not plane.
#[test]
fn polygons_become_triangles() {
    let bench = Workbench::new("facets_triangulated");
    // One corner of the cube is off the planes of three sides.
    bench.write("bent.off", &CUBE.replacen("1 1 1\n", "1.1 1.2 1.3\n", 1));
    let bent = " 6 polygons split into triangles: facets[1] is not plane\n";
    let asked = " 6 polygons split into triangles\n";
    for (line, told) in [("bent.off", bent), ("bent.off --triangulate", asked)] {
        let outcome = bench.run(&format!("{line} --validate --json bent.json"));
        outcome.assert_success();
        for words in [told, "12 triangles; ", "holds at level 3"] {
            assert!(outcome.stdout.contains(words), "no {words:?} in {}", outcome.stdout);
        }
        let reason = if line.ends_with("triangulate") { "asked" } else { "not plane" };
        let facet = (reason == "not plane").then_some("facets[1]");
        let expected = [json!(6), json!(0), json!(reason), json!(facet)];
        assert_eq!(triangulated(&bench.read("bent.json")), expected);
        let outcome = bench.run(&format!("{line} --diagnose bent.vtu"));
        outcome.assert_success();
        for words in [told, "12 triangles in", "edges       0 edges where"] {
            assert!(outcome.stdout.contains(words), "no {words:?} in {}", outcome.stdout);
        }
    }
    // Of polygons that are plane, or that may be bent so far, all edges are kept.
    for line in ["cube.off", "slope.off --coplanar 10"] {
        bench.write("cube.off", CUBE);
        bench.write("slope.off", &CUBE.replacen("1 1 1\n", "1 1 1.05\n", 1));
        let outcome = bench.run(line);
        outcome.assert_success();
        assert!(!outcome.stdout.contains("split into"), "{line}: {}", outcome.stdout);
    }
    // A segment within a polygon would be lost.
    let base = pyramid().replacen("1 0 9\n4 1 2 3 4\n", "2 0 9\n4 1 2 3 4\n2 1 3\n", 1);
    bench.write("bent.poly", &base.replacen("3 4 4 0\n", "3 4 4 0.5\n", 1));
    let within = "bent.poly: facets[0] has segments within";
    let why = "polygons have to become triangles, since facets[0] is not plane";
    bench.run("bent.poly").assert_failure(4, &[within, why]);
    bench.run("bent.poly --triangulate").assert_failure(4, &[within]);
    for line in ["bent.poly", "bent.poly --triangulate"] {
        let outcome = bench.run(&format!("{line} --diagnose bent.vtu"));
        outcome.assert_success();
        let told = format!("split       nothing; {within}");
        assert!(outcome.stdout.contains(&told), "{}", outcome.stdout);
    }
    bench.write("points.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n");
    let none = "points.xyz: has no facets; --triangulate is for surfaces";
    bench.run("points.xyz --triangulate").assert_failure(2, &[none]);
    bench.write("tetrahedron.off", TETRAHEDRON);
    let outcome = bench.run("tetrahedron.off --triangulate --json triangles.json");
    outcome.assert_success();
    let told = "nothing, as all facets are triangles\n";
    assert!(outcome.stdout.contains(told), "{}", outcome.stdout);
    assert_eq!(
        triangulated(&bench.read("triangles.json")),
        [json!(0), json!(0), json!("asked"), Value::Null]
    );
    // Plane polygons are facets again; a facet keeps its marker.
    bench.write("pyramid.poly", &pyramid());
    bench.run("pyramid.poly --triangulate -q -o pyramid.node").assert_success();
    let face = bench.read("pyramid.face");
    assert_eq!(face.lines().filter(|line| line.ends_with(" 9")).count(), 2, "{face}");
}

/// Polygons of one file and triangles of another are triangles, whichever comes first.
#[test]
fn polygons_and_triangles_are_meshed_together() {
    let bench = Workbench::new("facets_mixed");
    bench.write("cube.off", CUBE);
    bench.write("inner.off", TETRAHEDRON);
    for line in ["cube.off --with inner.off", "inner.off --with cube.off"] {
        let outcome = bench.run(&format!("{line} --validate --json mixed.json"));
        outcome.assert_success();
        for words in [
            " 6 polygons split into triangles, as the other facets are\n",
            "16 triangles; ",
            "holds at level 3",
        ] {
            assert!(outcome.stdout.contains(words), "no {words:?} in {}", outcome.stdout);
        }
        let expected = [json!(6), json!(0), json!("other triangles"), Value::Null];
        assert_eq!(triangulated(&bench.read("mixed.json")), expected);
    }
    // Such polygons have no triangles.
    bench.write("crossed.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n4 0 1 2 3\n");
    let rule = "beside the triangles of other files, polygons have to become triangles";
    bench.run("inner.off --with crossed.off").assert_failure(4, &["crossed.off: ", rule]);
    bench.run("crossed.off --with inner.off").assert_failure(4, &["crossed.off: ", rule]);
}

/// A polygon that meets itself seen along every axis is refused, and the message says so.
#[test]
fn polygons_that_nobody_can_see_as_a_whole_are_refused() {
    let bench = Workbench::new("polygons_seen");
    bench.write("up.off", &CUBE.replacen("1 1 1\n", "1 1 3\n", 1));
    let outcome = bench.run("up.off --validate");
    outcome.assert_success();
    for words in
        [" 6 polygons split into triangles: facets[1]", "12 triangles; ", "holds at level 3"]
    {
        assert!(outcome.stdout.contains(words), "no {words:?} in {}", outcome.stdout);
    }
    // Edges cross seen along each axis, and nowhere in space.
    bench
        .write("knot.off", "OFF\n6 1 0\n0 1 1\n0 3 3\n1 1 2\n4 0 2\n0 4 0\n2 2 3\n6 0 1 2 3 4 5\n");
    let words = ["knot.off: facets[0] is not plane, and ", " itself seen along each axis, "];
    bench.run("knot.off").assert_failure(4, &words);
    let outcome = bench.run("knot.off --diagnose knot.vtu");
    outcome.assert_success();
    assert!(outcome.stdout.contains("split       nothing; knot.off: facets[0]"));
}

/// Polygons without an area stand in no way of those that are not plane: the run leaves them out,
/// or refuses them by the names that they have in the file.
#[test]
fn polygons_without_an_area_are_dropped_beside_bent_ones() {
    let bench = Workbench::new("polygons_flat");
    // On an edge, beside it, and there and back.
    bench.write("zero.off", &bent("3 0 8 1\n4 0 8 1 8\n4 8 6 8 1\n"));
    let outcome = bench.run("zero.off --crossings split --validate --json zero.json");
    outcome.assert_success();
    let told =
        " 9 polygons split into triangles, 3 of them without an area: facets[1] is not plane\n";
    for words in [told, "holds at level 3"] {
        assert!(outcome.stdout.contains(words), "no {words:?} in {}", outcome.stdout);
    }
    assert_eq!(triangulated(&bench.read("zero.json"))[1], 3);
    let refused = "zero.off: facets[6] has no area near (0.0, 0.0, 0.0); a facet must have one";
    bench.run("zero.off").assert_failure(4, &[refused]);
    let outcome = bench.run("zero.off --diagnose zero.vtu");
    outcome.assert_success();
    for words in
        ["15 triangles in", "3 triangles without an area", "triangle 12 (facets[6]) has no"]
    {
        assert!(outcome.stdout.contains(words), "no {words:?} in {}", outcome.stdout);
    }
}

/// Corners of polygons that become one with their neighbour go, and polygons of which fewer than
/// three stay are left out, with their number.
#[test]
fn corners_of_polygons_are_merged() {
    let bench = Workbench::new("polygons_merged");
    let cube = CUBE.replacen("8 6 0", "10 8 0", 1);
    let cube = cube.replacen("0 1 1\n", "0 1 1\n1 1 1.0000000000000004\n0 0 1e-15\n", 1);
    let cube = cube.replacen("4 4 5 6 7\n", "5 4 5 8 6 7\n", 1) + "3 0 9 3\n4 1 0 9 1\n";
    bench.write("twice.off", &cube.replacen("4 1 0 9 1\n", "4 2 1 0 9\n", 1));
    bench.write("cube.off", &cube);
    bench.run("cube.off").assert_failure(4, &["cube.off: facets[7] has input 1 twice in a row"]);
    let outcome = bench.run("cube.off --merge 1e-9 --validate --json cube.json");
    outcome.assert_success();
    let told = "2 corners merged with others within 1e-9 of the diagonal, 2 polygons left out\n";
    for words in [told, "\nfacets      6 facets; 12 subfacets, ", "holds at level 3"] {
        assert!(outcome.stdout.contains(words), "no {words:?} in {}", outcome.stdout);
    }
    let record: Value = serde_json::from_str(&bench.read("cube.json")).unwrap();
    let expected = json!({ "points": 2, "triangles": 0, "polygons": 2, "loops": 0 });
    assert_eq!(record["repairs"]["merged"], expected);
    // Names are those of the file, also after facets that were left out.
    let outcome = bench.run("twice.off --merge 1e-9 --diagnose twice.vtu");
    outcome.assert_success();
    let pair = "facet 0 (facets[0]) overlaps facet 6 (facets[7]), at ";
    assert!(outcome.stdout.contains(pair), "{}", outcome.stdout);
}

/// Messages name the file of a facet or segment, and its number there; counts are those of files.
#[test]
fn facets_of_several_files_are_named_by_their_file() {
    let bench = Workbench::new("polygons_named");
    bench.write("cube.off", CUBE);
    bench.write("inner.off", TETRAHEDRON);
    bench.write("bent.off", &CUBE.replacen("1 1 1\n", "1 1 1.3\n", 1));
    bench.write("wall.off", "OFF\n4 1 0\n0.5 0.3 0\n0.5 0.3 1\n0.5 2 1\n0.5 2 0\n4 0 1 2 3\n");
    let run = |line: &str, words: &[&str]| {
        let outcome = bench.run(line);
        outcome.assert_success();
        for words in words {
            assert!(outcome.stdout.contains(words), "no {words:?} in {}", outcome.stdout);
        }
    };
    // The count is that of the file, whichever file is split, and when.
    let points = "points.xyz: 1 point\n";
    bench.write("points.xyz", "0.5 0.5 0.5\n");
    run("inner.off --with points.xyz --with cube.off", &[points, "cube.off: 8 points, 6 facets "]);
    run(
        "points.xyz --with cube.off --with inner.off",
        &["cube.off: 8 points, 6 facets ", "4 facets "],
    );
    run("cube.off --with inner.off", &["inner.off: 4 points, 4 facets "]);
    let all = "cube.off --with inner.off --with wall.off";
    let cross = "triangles[3] of inner.off and facets[0] of wall.off cross near";
    let first = "files: facets[0] of cube.off and facets[0] of wall.off touch near";
    bench.run(all).assert_failure(4, &[first]);
    bench.write(
        "wall.off",
        "OFF\n4 1 0\n0.3 0.3 0.3\n0.3 0.3 0.9\n0.3 0.9 0.9\n0.3 0.9 0.3\n4 0 1 2 3\n",
    );
    bench.run(all).assert_failure(4, &[cross]);
    let pair =
        "triangle 15 (triangles[3] of inner.off) crosses triangle 16 (facets[0] of wall.off)";
    run(&format!("{all} --diagnose all.vtu"), &[pair]);
    run("cube.off --with bent.off --diagnose all.vtu", &[": facets[1] of bent.off is not plane\n"]);
    bench.write("twice.off", &CUBE.replacen("4 1 2 6 5", "4 1 2 2 5", 1));
    let twice = "facets[3] of twice.off has input 2 twice in a row in its loop 0";
    bench.run("cube.off --with twice.off").assert_failure(4, &[twice]);
    // Segments of the plane, too.
    bench.write("a.poly", "3 2\n1 0 0\n2 4 0\n3 0 4\n3 0\n1 1 2\n2 2 3\n3 3 1\n0\n");
    bench.write("b.poly", "2 2\n1 1 1\n2 9 9\n1 0\n1 1 2\n0\n");
    let cross = "segments[1] of a.poly and segments[0] of b.poly cross near (2.0, 2.0)";
    bench.run("a.poly --with b.poly").assert_failure(4, &[cross]);
}

/// A diagnosis has its report of the files together, also where polygons of one have no triangles.
#[test]
fn mixed_files_are_diagnosed_in_any_case() {
    let bench = Workbench::new("polygons_diagnosed");
    bench.write("crossed.off", CROSSED);
    let more = TETRAHEDRON.replacen("4 4 0", "4 5 0", 1) + "3 0 1 1\n";
    bench.write("inner.off", &more);
    bench.write("cube.off", CUBE);
    for line in [
        "inner.off --with crossed.off --with cube.off",
        "crossed.off --with inner.off --with cube.off",
        "cube.off --with inner.off --with crossed.off",
    ] {
        let outcome = bench.run(&format!("{line} --diagnose all.vtu"));
        outcome.assert_success();
        let is_split = line.starts_with("cube");
        let count = if is_split { 17 } else { 11 };
        let split = if is_split { "6 polygons split into triangles" } else { "nothing" };
        for words in [
            &*format!(
                "split       {split}; crossed.off: facets[0] crosses itself near (0.5, 0.5, 0.0); "
            ),
            "; 1 triangle with a corner twice left out\n",
            &format!("16 points, {count} facets in "),
            " (facets[0] of crossed.off) crosses facet ",
        ] {
            assert!(outcome.stdout.contains(words), "no {words:?} in {}", outcome.stdout);
        }
        bench.run(line).assert_failure(4, &["crossed.off: facets[0] crosses itself"]);
    }
}
