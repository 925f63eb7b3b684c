//! Facets of files: what they become, what is left, and what is refused.

use crate::workbench::Workbench;

pub const CUBE: &str = "OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n\
                    4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";

const POINTS: &str = "5 3\n1 0 0 0\n2 4 0 0\n3 4 4 0\n4 0 4 0\n5 2 2 3\n";

pub fn pyramid() -> String {
    format!(
        "{POINTS}5 1\n1 0 9\n4 1 2 3 4\n1 0 2\n3 1 2 5\n1\n3 2 3 5\n1\n3 3 4 5\n1\n3 4 1 5\n0\n0\n"
    )
}

/// Asked for, the points are meshed alone, and the summary says what is left.
#[test]
fn points_are_meshed_alone_where_that_is_asked_for() {
    let bench = Workbench::new("facets_points");
    bench.write("cube.off", CUBE);
    bench.write("pyramid.poly", &pyramid());
    for (name, faces) in [("cube.off", 6), ("pyramid.poly", 5)] {
        let outcome = bench.run(&format!("{name} --points --json alone.json"));
        outcome.assert_success();
        let line = format!("left out    {faces} faces; --points asks for the points alone\n");
        assert!(outcome.stdout.contains(&line), "{}", outcome.stdout);
        assert!(!outcome.stdout.contains("facets      "), "{}", outcome.stdout);
        assert!(bench.read("alone.json").contains(&format!("\"faces\": {faces}")));
    }
}

/// A part is meshed as people mean it who give nothing else, and the summary says so.
#[test]
fn parts_have_defaults_of_their_own() {
    let bench = Workbench::new("facets_defaults");
    bench.write("cube.off", CUBE);
    for (line, coplanar, angle, told) in [
        (
            "",
            "0.1",
            "10",
            Some(" --coplanar 0.1, --min-dihedral 10 and --labels regions by default\n"),
        ),
        ("--coplanar 0", "0", "10", Some(" --min-dihedral 10 and --labels regions by default\n")),
        ("--min-dihedral 0", "0.1", "0", Some(" --coplanar 0.1 and --labels regions by default\n")),
        ("--labels seeds", "0.1", "10", Some(" --coplanar 0.1 and --min-dihedral 10 by default\n")),
        ("--coplanar 0.5 --min-dihedral 5 --labels regions", "0.5", "5", None),
        ("--hierarchical --coplanar 1 --labels seeds", "1", "0", None),
        ("--extent hull", "0", "0", None),
    ] {
        let outcome = bench.run(&format!("cube.off {line} --json cube.json"));
        outcome.assert_success();
        let record = bench.read("cube.json");
        for (name, value) in [("coplanar", coplanar), ("min_dihedral", angle)] {
            let member = |end: &str| format!("\"{name}\": {value}{end}");
            assert!(
                record.contains(&member(",")) || record.contains(&member(".0,")),
                "{line}: no {name} {value} in {record}"
            );
        }
        match told {
            Some(told) => assert!(outcome.stdout.contains(told), "{line}: {}", outcome.stdout),
            None => assert!(!outcome.stdout.contains(" by default"), "{}", outcome.stdout),
        }
    }
}

/// Faults of a surface are told, with the places, and written as cells.
#[test]
fn surfaces_are_diagnosed() {
    let bench = Workbench::new("facets_diagnosed");
    bench.write("cube.off", CUBE);
    // Two triangles that cross, a third on an edge of the first one turned round, one without an
    // area, another with an input twice, and one that is there twice.
    bench.write(
        "bad.off",
        "OFF\n10 7 0\n0 0 0\n4 0 0\n0 4 0\n1 1 -1\n1 1 1\n9 9 1\n2 0 3\n7 7 7\n8 8 8\n9 9 9\n\
         3 0 1 2\n3 3 4 5\n3 0 1 6\n3 7 8 9\n3 5 6 7\n3 5 6 7\n3 9 9 8\n",
    );
    bench.run("bad.off --diagnose bad.vtu").assert_success();
    let outcome = bench.run("bad.off --diagnose bad.vtu");
    for words in [
        "10 points, 7 triangles in bad.off\n",
        "edges       7 edges where one triangle ends and no other begins\n",
        "            4 edges of two triangles that are turned round\n",
        "faults      2 triangles without an area\n",
        "            1 pair that crosses",
        "            1 triangle with the vertices of an earlier one\n",
        "triangle 0 crosses triangle 1, at (1.5, 1.5, 0.0)",
        "triangle 3 has no area, at (7.0, 7.0, 7.0)\n",
    ] {
        assert!(outcome.stdout.contains(words), "no {words:?} in {}", outcome.stdout);
    }
    bench.write(
        "polygons.off",
        "OFF\n5 3 0\n0 0 0\n4 0 0\n4 4 0\n0 4 0\n4 0 0\n4 0 1 2 3\n4 2 4 0 3\n3 0 1 2\n",
    );
    let outcome = bench.run("polygons.off --diagnose POLYGONS.VTU");
    outcome.assert_success();
    let words = "            1 facet with the vertices of an earlier one\n";
    assert!(outcome.stdout.contains(words), "{}", outcome.stdout);
    let file = String::from_utf8_lossy(&bench.bytes("bad.vtu")).into_owned();
    assert!(file.contains(r#"<Piece NumberOfPoints="10" "#), "{file}");
    let outcome = bench.run("cube.off --diagnose none.vtu");
    outcome.assert_success();
    assert!(outcome.stdout.contains("edges       0 edges where one facet ends"));
    for (line, code, words) in [
        ("bad.off --diagnose -", 2, "--diagnose needs the name of a file"),
        ("bad.off --diagnose bad.off", 2, "bad.off: --diagnose writes VTU; the name of its file"),
        ("bad.off --diagnose faults", 2, "its file must end with .vtu"),
        ("bad.off --points --diagnose a.vtu", 2, "has no facets; --diagnose is for surfaces"),
    ] {
        bench.run(line).assert_failure(code, &[words]);
    }
    for option in [
        "--output <FILE>",
        "--output-format <FORMAT>",
        "--json <FILE>",
        "--validate",
        "--stats",
        "--histogram",
        "--filtration <KIND>",
        "--alpha-shape <ALPHA>",
        "--finish",
        "--sizes <FILE>",
        "--background <FILE>",
    ] {
        let given = option.replace("<FILE>", "b.vtu").replace("<FORMAT>", "off");
        let given = given.replace("<KIND>", "alpha").replace("<ALPHA>", "1");
        let refusal = format!("cannot be used with '{option}'");
        let reversed = format!("'{option}' cannot be used with '--diagnose <FILE>'");
        let outcome = bench.run(&format!("bad.off --diagnose a.vtu {given}"));
        assert_eq!(outcome.code, 2, "{given}: {}", outcome.stderr);
        let is_named = outcome.stderr.contains(&refusal) || outcome.stderr.contains(&reversed);
        assert!(is_named, "{given}: {}", outcome.stderr);
    }
    for option in ["--max-edge 1", "--crossings split", "--extent hull", "--threads 1", "--bound 2"]
    {
        let name = option.split(' ').next().unwrap();
        let rule = format!("netmesh: {name} is for a mesh; --diagnose makes none\n");
        bench.run(&format!("bad.off --diagnose a.vtu {option}")).assert_failure(2, &[&rule]);
    }
    assert!(!bench.files().iter().any(|name| name == "a.vtu"));
    bench.run("bad.off --diagnose a.vtu --coplanar 0").assert_success();
}

/// Holes are closed where that is asked for, in what is meshed and in what is diagnosed.
#[test]
fn holes_are_closed() {
    let bench = Workbench::new("facets_holes");
    let open = CUBE.replacen("8 6 0", "8 5 0", 1).replace("4 3 0 4 7\n", "");
    bench.write("open.off", &open);
    bench.write("points.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n");
    let closed = "1 hole closed with 2 triangles, 0 edges left open\n";
    let kept = "0 holes closed with 0 triangles, 4 edges left open\n";
    for (line, words) in [
        ("--close-holes 4", ["\nfacets      7 facets; ", closed, "of what facets enclose"]),
        ("--close-holes 3 --diagnose a.vtu", ["\nholes       ", kept, "edges       4 edges where"]),
        (
            "--close-holes 9 --diagnose a.vtu",
            [", 7 facets in ", closed, "edges       0 edges where"],
        ),
    ] {
        let outcome = bench.run(&format!("open.off {line}"));
        outcome.assert_success();
        for words in words {
            assert!(outcome.stdout.contains(words), "no {words:?} in {}", outcome.stdout);
        }
    }
    for (line, words) in [
        ("points.xyz --close-holes 4", "has no facets; --close-holes is for surfaces"),
        ("open.off --close-holes 2", "2 is not in 3..=1000"),
        ("open.off --close-holes 1001", "1001 is not in 3..=1000"),
    ] {
        bench.run(line).assert_failure(2, &[words]);
    }
}

/// Each loop of a ring that is missing is closed by itself: the lid of the outer one lies over that
/// of the inner one.
#[test]
fn both_loops_of_a_missing_ring_get_a_lid() {
    let bench = Workbench::new("facets_ring");
    // A tube of square walls, closed by a ring below and open above.
    let corners = "0 0 0\n4 0 0\n4 4 0\n0 4 0\n0 0 4\n4 0 4\n4 4 4\n0 4 4\n\
                   1 1 0\n3 1 0\n3 3 0\n1 3 0\n1 1 4\n3 1 4\n3 3 4\n1 3 4\n";
    let outer = "4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
    let inner = "4 8 12 13 9\n4 9 13 14 10\n4 10 14 15 11\n4 11 15 12 8\n";
    let ring = "4 0 8 9 1\n4 1 9 10 2\n4 2 10 11 3\n4 3 11 8 0\n";
    bench.write("tube.off", &format!("OFF\n16 12 0\n{corners}{outer}{inner}{ring}"));
    let outcome = bench.run("tube.off --close-holes 4 --diagnose tube.vtu");
    outcome.assert_success();
    for words in [
        "2 holes closed with 4 triangles, 0 edges left open\n",
        "edges       0 edges where one facet ends",
        "pairs that overlap\n",
        " (a triangle that closes a hole) overlaps ",
    ] {
        assert!(outcome.stdout.contains(words), "no {words:?} in {}", outcome.stdout);
    }
    let words = [" and a triangle that closes a hole touch near "];
    bench.run("tube.off --close-holes 4").assert_failure(4, &words);
    let outcome = bench.run("tube.off --close-holes 4 --triangulate --crossings split --validate");
    outcome.assert_success();
    for words in ["of what facets enclose", "holds at level 3"] {
        assert!(outcome.stdout.contains(words), "no {words:?} in {}", outcome.stdout);
    }
}

/// Corners that roundings have driven apart are one where that is asked for; otherwise a refusal
/// and a diagnosis tell that there are some.
#[test]
fn corners_are_merged() {
    let bench = Workbench::new("facets_merged");
    // Of the corner (1, 1, 1) two triangles have another one, which differs in the last places.
    bench.write(
        "cube.off",
        "OFF\n9 13 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n\
         1 1 1.0000000000000004\n3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n\
         3 1 2 8\n3 1 8 5\n3 2 3 7\n3 2 7 6\n3 3 0 4\n3 3 4 7\n3 6 8 5\n",
    );
    let hint = "1 corner is within 1e-9 of the diagonal from others; --merge 1e-9 makes them one";
    bench.run("cube.off --extent boundary").assert_failure(4, &[hint]);
    let outcome = bench.run("cube.off --diagnose cube.vtu");
    outcome.assert_success();
    assert!(outcome.stdout.contains(&format!("\npoints      {hint}\n")), "{}", outcome.stdout);
    let told = "1 corner merged with others within 1e-9 of the diagonal, 1 triangle left out\n";
    let outcome = bench.run("cube.off --merge 1e-9 --validate");
    outcome.assert_success();
    for words in [told, "of what facets enclose", "holds at level 3"] {
        assert!(outcome.stdout.contains(words), "no {words:?} in {}", outcome.stdout);
    }
    let outcome = bench.run("cube.off --merge 1e-9 --diagnose cube.vtu");
    outcome.assert_success();
    for words in [&format!("\nmerged      {told}"), "edges       0 edges where", "12 triangles in"]
    {
        assert!(outcome.stdout.contains(words), "no {words:?} in {}", outcome.stdout);
    }
    assert!(!outcome.stdout.contains("\npoints "), "{}", outcome.stdout);
    bench.write("points.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n");
    for (line, words) in [
        ("points.xyz --merge 1e-9", "has no facets; --merge is for surfaces"),
        ("cube.off --merge 0.01", "it must be a number from 0 to 0.001"),
        ("cube.off --merge nan", "it must be a number from 0 to 0.001"),
    ] {
        bench.run(line).assert_failure(2, &[words]);
    }
}

/// Files are meshed together: patches of a surface, which markers tell apart, and points inside.
#[test]
fn further_files_are_meshed_together_with_the_input() {
    let bench = Workbench::new("facets_further");
    let open = CUBE.replacen("8 6 0", "8 5 0", 1).replace("4 3 0 4 7\n", "");
    bench.write("open.off", &open);
    bench.write("lid.off", "OFF\n4 1 0\n0 1 0\n0 0 0\n0 0 1\n0 1 1\n4 0 1 2 3\n");
    bench.write("inside.xyz", "0.25 0.5 0.75\n0.5 0.5 0.5\n");
    bench.write("plane.xyz", "0 0\n1 0\n");
    let all = "open.off --with lid.off --with inside.xyz";
    let outcome = bench.run(&format!("{all} --min-dihedral 0 --validate -o cube.node"));
    outcome.assert_success();
    for words in [
        "input       open.off and 2 further files: 14 points in 3D, 4 duplicates\n",
        "with        lid.off: 4 points, 1 facet with the marker 1\n",
        "            inside.xyz: 2 points\n",
        "of what facets enclose",
        "holds at level 3",
    ] {
        assert!(outcome.stdout.contains(words), "no {words:?} in {}", outcome.stdout);
    }
    let face = bench.read("cube.face");
    let marked = |marker: &str| face.lines().filter(|line| line.ends_with(marker)).count();
    assert!(marked(" 1") >= 2 && marked(" 0") >= 10, "{face}");
    let outcome = bench.run("open.off --with lid.off --diagnose cube.vtu");
    outcome.assert_success();
    assert!(outcome.stdout.contains("edges       0 edges where one facet ends"));
    for (line, code, words) in [
        ("open.off --with none.off", 3, "none.off: "),
        ("open.off --with plane.xyz", 4, "plane.xyz: the points have 2 coordinates; they must"),
        ("open.off --with lid.off -o lid.off", 2, "lid.off: this is the input"),
        ("open.off --with lid.off --sizes a.mtr", 2, "cannot be used with"),
    ] {
        bench.run(line).assert_failure(code, &[words]);
    }
}

/// The record has what was meshed together, and what was repaired.
#[test]
fn the_record_has_further_files_and_repairs() {
    let bench = Workbench::new("facets_record");
    let open = CUBE.replacen("8 6 0", "8 4 0", 1).replace("4 2 3 7 6\n4 3 0 4 7\n", "");
    bench.write("open.off", &open);
    // The side has a corner of its own.
    bench.write("side.off", "OFF\n4 1 0\n1 1 0\n0 1 1e-17\n0 1 1\n1 1 1\n4 0 1 2 3\n");
    bench.write("inside.xyz", "0.25 0.5 0.75\n");
    let all = "open.off --with side.off --with inside.xyz --merge 1e-9 --close-holes 4";
    bench.run(&format!("{all} -q --json all.json")).assert_success();
    let record: serde_json::Value = serde_json::from_str(&bench.read("all.json")).unwrap();
    let none = serde_json::json!({ "count": 0, "markers": null });
    let side = serde_json::json!({ "count": 1, "markers": [1, 1] });
    let expected = serde_json::json!([
        { "input": "side.off", "points": 4, "facets": side, "segments": none },
        { "input": "inside.xyz", "points": 1, "facets": none, "segments": none },
    ]);
    assert_eq!(record["with"], expected);
    let expected = serde_json::json!({
        "merged": { "points": 1, "triangles": 0, "polygons": 0, "loops": 0 },
        "triangulated": null,
        "triangulated_without_area": null,
        "triangulated_since": null,
        "not_plane": null,
        "holes": { "closed": 1, "triangles": 2, "open_edges": 0 },
    });
    assert_eq!(record["repairs"], expected);
    bench.run("open.off -q --json alone.json").assert_success();
    let record: serde_json::Value = serde_json::from_str(&bench.read("alone.json")).unwrap();
    assert_eq!(record["with"], serde_json::json!([]));
    let repairs = record["repairs"].as_object().unwrap();
    assert!(repairs.len() == 6 && repairs.values().all(|value| value.is_null()), "{repairs:?}");
}

/// A domain is meshed to what its facets enclose, and every format has its parts.
#[test]
fn a_surface_is_meshed_to_what_it_encloses() {
    let bench = Workbench::new("facets_meshed");
    bench.write("cube.off", CUBE);
    bench.write("pyramid.poly", &pyramid());
    let outcome = bench.run("cube.off --validate --json cube.json");
    outcome.assert_success();
    for words in
        ["of what facets enclose", "\nfacets      6 facets; 12 subfacets, ", "holds at level 3"]
    {
        assert!(outcome.stdout.contains(words), "no {words:?} in {}", outcome.stdout);
    }
    assert!(bench.read("cube.json").contains("\"facet_triangles\": 12"));
    bench.run("pyramid.poly -q -o pyramid.node").assert_success();
    let face = bench.read("pyramid.face");
    assert!(face.starts_with("6 1\n"), "{face}");
    let of_base = face.lines().filter(|line| line.ends_with(" 9"));
    assert_eq!(of_base.count(), 2, "{face}");
    assert!(bench.read("pyramid.edge").starts_with("8 1\n"), "{}", bench.read("pyramid.edge"));
    assert_eq!(
        bench.files(),
        [
            "cube.json",
            "cube.off",
            "pyramid.edge",
            "pyramid.ele",
            "pyramid.face",
            "pyramid.node",
            "pyramid.poly"
        ]
    );
}

/// Options that do not go with the facets of a part are refused by name.
#[test]
fn options_that_do_not_go_with_facets_are_named() {
    let bench = Workbench::new("facets_options");
    bench.write("cube.off", CUBE);
    for (options, words) in [
        ("--algorithm delaunay", "--algorithm delaunay goes neither with facets nor with a hull"),
        ("--algorithm svr", "--algorithm svr goes neither with facets nor with a hull or box"),
        ("--alpha-shape 1", "--alpha-shape goes neither with facets nor with a hull or box"),
        ("--criterion aspect --bound inf", "--bound is inf; with facets it must be 0, or go with"),
        ("--distance-ratio 0.5 --min-dihedral 0", "is 0.5; it must be 0 with facets"),
    ] {
        bench.run(&format!("cube.off {options}")).assert_failure(2, &[words]);
    }
}

/// STL and PLY have the boundary of a part, PLY with the markers of its facets; both are surfaces
/// that are read again.
#[test]
fn boundaries_of_parts_are_surfaces_again() {
    let bench = Workbench::new("facets_surfaces");
    bench.write("pyramid.poly", &pyramid());
    for name in ["a.stl", "a.ply"] {
        bench.run(&format!("pyramid.poly -q -o {name}")).assert_success();
        let outcome = bench.run(&format!("{name} --diagnose faults.vtu"));
        outcome.assert_success();
        for words in [
            "5 points, 6 triangles in ",
            "edges       0 edges where one triangle ends",
            "0 edges of two triangles that are turned round",
            "0 triangles with the vertices of an earlier one",
        ] {
            assert!(outcome.stdout.contains(words), "{name}: {}", outcome.stdout);
        }
        bench.run(&format!("{name} -q -o again.node")).assert_success();
        let face = bench.read("again.face");
        let of_base = face.lines().filter(|line| line.ends_with(" 9")).count();
        assert_eq!(of_base, if name == "a.ply" { 2 } else { 0 }, "{face}");
    }
}

/// Faults of a file's content are told from a file that is none of its format.
#[test]
fn what_is_wrong_with_facets_is_named() {
    let bench = Workbench::new("facets_refused");
    let poly = |facets: &str| format!("{POINTS}{facets}");
    for (code, name, text, words) in [
        (3, "a.poly", poly("1\n1\n3 1 2\n"), "a.poly: the file ends after line 9: 2 of 3 points"),
        (3, "b.poly", poly("1\n1\n3 1 2 x\n"), "b.poly: line 9, column 4: \"x\" is no point id"),
        (
            4,
            "c.poly",
            poly("1\n1\n3 1 2 6\n0\n"),
            "c.poly: line 9, column 4: point id 6; ids are 1 to 5",
        ),
        (
            4,
            "d.poly",
            poly("1\n1 1\n3 1 2 3\n1 3 1 0\n0\n"),
            "line 10: the point of the hole is in the facet",
        ),
        (
            4,
            "e.smesh",
            poly("1\n3 1 1 2\n0\n"),
            "e.smesh: line 8, column 3: the polygon has point 1 twice",
        ),
        (
            3,
            "f.smesh",
            poly("1\n3 1 2 3 4\n0\n"),
            "f.smesh: line 8, column 5: more numbers than the 3",
        ),
        (
            4,
            "g.off",
            CUBE.replace("4 0 3 2 1", "3 0 3 8"),
            "g.off: line 11, column 4: vertex id 8 of 8",
        ),
        (
            4,
            "h.off",
            CUBE.replace("4 0 3 2 1", "4 0 3 3 1"),
            "h.off: facets[0] has input 3 twice in a row",
        ),
    ] {
        bench.write(name, &text);
        bench.run(name).assert_failure(code, &[words]);
    }
}

/// The parts of TetGen's format replace no input, and those that are not written stand in no way.
#[test]
fn parts_are_checked_before_the_work() {
    let bench = Workbench::new("facets_parts");
    bench.write("pyramid.poly", &pyramid());
    bench.write("pyramid.face/file", "");
    bench.run("pyramid.poly -o pyramid.node").assert_failure(8, &["pyramid.face"]);
    bench.write("square.poly", "3 2 0 0\n0 0 0\n1 1 0\n2 0 1\n1 0\n0 0 1\n0\n");
    bench
        .run("square.poly -o square.node")
        .assert_failure(2, &["square.poly: this is the input", "--force"]);
    bench.write("other.face/file", "");
    bench.run("square.poly -q -o other.node").assert_success();
}

/// A surface that encloses nothing, beside one that does, is told, and so is what is in holes.
#[test]
fn what_is_outside_of_the_domain_is_told() {
    let bench = Workbench::new("facets_outside");
    bench.write("cube.off", CUBE);
    bench.write("sheet.off", "OFF\n4 2 0\n3 0 0\n4 0 0\n4 1 0.5\n3 1 0\n3 0 1 2\n3 0 2 3\n");
    let outcome = bench.run("cube.off --with sheet.off --json both.json");
    outcome.assert_success();
    let line = "\noutside     4 points, 2 subfacets; no simplex has them\n";
    assert!(outcome.stdout.contains(line), "{}", outcome.stdout);
    let record = bench.read("both.json").replace(char::is_whitespace, "");
    let expected = "\"outside\":{\"points\":4,\"segment_edges\":0,\"facet_triangles\":2}";
    assert!(record.contains(expected), "{record}");
    let alone = bench.run("cube.off");
    assert!(!alone.stdout.contains("outside"), "{}", alone.stdout);

    let square = "4 2 0 0\n1 0 0\n2 9 0\n3 9 9\n4 0 9\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n";
    let with_hole = square.replace("4 2 0 0\n", "9 2 0 0\n").replace(
        "4 0 9\n4 0\n",
        "4 0 9\n5 3 3\n6 6 3\n7 6 6\n8 3 6\n9 4 5\n8 0\n5 5 6\n6 6 7\n7 7 8\n8 8 5\n",
    );
    bench.write("hole.poly", &with_hole.replace("\n0\n", "\n1\n1 4 4\n"));
    let outcome = bench.run("hole.poly");
    outcome.assert_success();
    let line = "\noutside     1 point; no simplex has them\n";
    assert!(outcome.stdout.contains(line), "{}", outcome.stdout);
}

/// A bound that is given alone is one of radius-edge ratios where no other goes: with facets,
/// segments, hulls and boxes.
#[test]
fn a_bound_alone_goes_with_facets_and_boxes() {
    let bench = Workbench::new("facets_bound");
    bench.write("points.xyz", "0 0 0\n1 0 0.2\n0.3 1 0\n0.4 0.3 1\n0.5 0.4 0.3\n");
    bench.write("square.poly", "4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n1 0\n1 1 3\n0\n");
    bench.write("cube.off", CUBE);
    for (line, bound) in [
        ("points.xyz --extent box --bound 3", "radius-edge ratio at most 3"),
        ("square.poly --bound 1.5", "radius-edge ratio at most 1.5"),
        ("cube.off --bound 2 --min-dihedral 0", "radius-edge ratio at most 2"),
        ("points.xyz --bound 3", "Voronoi aspect at most 3"),
    ] {
        let outcome = bench.run(&format!("{line} --validate"));
        outcome.assert_success();
        assert!(outcome.stdout.contains(bound), "no {bound:?} in {}", outcome.stdout);
    }
    let refused = bench.run("square.poly --criterion aspect --bound 2");
    let message = "--bound is 2; with segments it must be 0, or go with --criterion radius-edge";
    assert!(refused.stderr.contains(message), "{}", refused.stderr);
}

/// Points alone fill their box or hull; a box of what is flat is refused in the caller's words.
#[test]
fn boxes_and_hulls_of_points() {
    let bench = Workbench::new("facets_extents");
    bench.write("points.xyz", "0 0 0\n1 0 0.2\n0.3 1 0\n0.4 0.3 1\n0.5 0.4 0.3\n");
    bench.write("flat.xyz", "0 0 2\n1 0 2\n0 1 2\n1 1 2\n");
    for extent in ["box", "hull"] {
        let bound = "--criterion radius-edge --bound 3";
        let outcome = bench.run(&format!("points.xyz --extent {extent} {bound} --validate"));
        outcome.assert_success();
        let of = format!("mesh of the {extent}, radius-edge ratio at most 3");
        for words in [&*of, "holds at level 3"] {
            assert!(outcome.stdout.contains(words), "no {words:?} in {}", outcome.stdout);
        }
        let refused = bench.run(&format!("flat.xyz --extent {extent}"));
        assert!(
            refused.stderr.contains(&format!("--extent {extent} has no volume")),
            "{}",
            refused.stderr
        );
    }
}
