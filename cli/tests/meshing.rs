//! Small runs from points to certified files.

use crate::workbench::Workbench;
use serde_json::Value;

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
fn every_format_is_written_by_extension_and_by_name() {
    let bench = bench_with_spiral("formats", 3);
    let formats = [
        ("vtu", "vtu"),
        ("msh", "gmsh"),
        ("mesh", "medit"),
        ("off", "off"),
        ("ply", "ply"),
        ("xyz", "xyz"),
        ("csv", "csv"),
        ("npy", "npy"),
        ("voronoi.json", "voronoi-json"),
        ("domains.json", "domains-json"),
        ("html", "html"),
        ("node", "tetgen"),
    ];
    for (extension, name) in formats {
        bench.run(&format!("points.xyz -q -o a.{extension}")).assert_success();
        let named = format!("points.xyz -q -o {name}.out --output-format {name}");
        bench.run(&named).assert_success();
        let (file, named) = (format!("a.{extension}"), format!("{name}.out"));
        assert!(bench.bytes(&file) == bench.bytes(&named), "{extension}");
    }
    assert_eq!(bench.bytes("a.ele"), bench.bytes("tetgen.out.ele"));
    assert_eq!(bench.files().len(), 2 * (formats.len() + 1) + 1);
    assert!(bench.read("a.msh").starts_with("$MeshFormat\n4.1 0 8\n"));
}

#[test]
fn a_mesh_is_meshed_again_from_every_format_that_has_its_points() {
    let bench = bench_with_spiral("read", 3);
    bench.run("points.xyz -q -o first.xyz").assert_success();
    bench.run("first.xyz -q -o expected.npy").assert_success();
    for extension in ["node", "msh", "mesh", "off", "ply", "csv", "npy"] {
        bench.run(&format!("points.xyz -q -o a.{extension}")).assert_success();
        // The faces of a PLY file are facets.
        let points = if extension == "ply" { " --points" } else { "" };
        bench.run(&format!("a.{extension} -q{points} -o again.npy")).assert_success();
        assert!(bench.bytes("again.npy") == bench.bytes("expected.npy"), "{extension}");
    }
    bench.run("a.vtu").assert_failure(2, &["VTU cannot be read", "TetGen, Gmsh"]);
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
        "passes",
        "off-centres",
        "ply at most",
        "feature size",
        "constants",
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

/// Returns the library's mesh of the spiral.
fn spiral_mesh(options: &netmesh::Options) -> netmesh::Mesh {
    let text = spiral(2);
    let numbers = text.split_whitespace().map(|word| word.parse().expect("a number"));
    let points: Vec<f64> = numbers.collect();
    let mut mesh = netmesh::Mesh::new(2, 21, &points, 0).expect("good points");
    mesh.run(options, None).expect("good options");
    mesh
}

#[test]
fn json_has_the_fields_of_the_structs() {
    let bench = bench_with_spiral("json", 2);
    bench.run("points.xyz -q --json a.json --validate --stats").assert_success();
    assert_eq!(bench.files(), ["a.json", "points.xyz"]);
    let json: Value = serde_json::from_str(&bench.read("a.json")).expect("it is JSON");
    assert_eq!(json["input"], "points.xyz");
    let options = netmesh::Options { instruments: true, ..netmesh::Options::default() };
    let mesh = spiral_mesh(&options);
    let result = mesh.triangulation().expect("a result");
    let stats = &result.stats;
    let counts = ["inputs", "duplicates", "vertices", "simplices", "domains", "dim"];
    let expected = [21, 1, result.vertex_count(), result.simplex_count(), result.domains.len(), 2];
    assert_eq!(counts.map(|name| json["counts"][name].as_u64()), expected.map(|n| Some(n as u64)));
    assert_eq!(json["report"]["level"], 3);
    assert_eq!(json["report"]["violations"], 0);
    assert_eq!(json["options"]["epsilon"], 0.5);
    assert_eq!(json["options"]["ordering"], "sampled");
    assert_eq!(json["options"]["instruments"], true);
    let quality = netmesh::quality::measure(result).expect("there is memory");
    assert_eq!(json["quality"]["worst_aspect"], quality.worst_aspect);
    assert_eq!(json["stats"]["off_centers"], stats.off_centers);
    assert_eq!(json["stats"]["max_ply"], stats.max_ply);
    assert_eq!(json["stats"]["insertion_constant_cage"], stats.insertion_constant_cage);
    assert!(stats.max_ply > 0 && stats.insertion_constant_cage > 0.0);
    // The header is the list of fields.
    let header = include_str!("../../include/netmesh.h");
    for (part, of) in [
        ("counts", "nm_counts"),
        ("options", "nm_options"),
        ("quality", "nm_quality"),
        ("stats", "nm_stats"),
    ] {
        let start = header.find(&format!("typedef struct {of} {{")).expect("the struct");
        let end = start + header[start..].find(&format!("}} {of};")).expect("its end");
        let fields = header[start..end].lines().filter(|line| !line.contains(" * "));
        let fields = fields.filter_map(|line| line.strip_suffix(';'));
        let mut names: Vec<_> =
            fields.filter_map(|line| line.split([' ', '*']).next_back()).collect();
        // Things that the caller gives to a run are no options of it.
        let calls = ["struct_size", "progress", "user_data", "size", "size_user_data"];
        names.retain(|name| !calls.contains(name) && !name.starts_with("reserved"));
        let mut written: Vec<_> = json[part].as_object().expect("an object").keys().collect();
        names.sort_unstable();
        written.sort_unstable();
        assert!(names.len() > 5 && written == names, "{part}: {written:?}, {names:?}");
    }
}

#[test]
fn json_takes_the_place_of_the_summary() {
    let bench = bench_with_spiral("json_stdout", 2);
    let outcome = bench.run("points.xyz --json - --ordering deterministic");
    outcome.assert_success();
    let json: Value = serde_json::from_str(&outcome.stdout).expect("nothing but JSON");
    assert_eq!(json["options"]["ordering"], "deterministic");
    assert!(json["report"].is_null());
    // Not measured without --stats.
    assert!(json["stats"]["max_ply"].is_null() && json["stats"]["feature_size_constant"].is_null());
    assert_eq!(bench.files(), ["points.xyz"]);
    let both = bench.run("points.xyz --json a.json --ordering deterministic");
    assert!(both.stdout.contains("deterministic nets"), "{}", both.stdout);
    assert_eq!(bench.files(), ["a.json", "points.xyz"]);
}

/// The recipe for maps: of a square of area 200 with a lake of area 4 the mesh has 196.
#[test]
fn lakes_of_maps_are_outside() {
    let bench = Workbench::new("lakes");
    let rings = "[[[0,0],[20,0],[20,10],[0,10],[0,0]],[[5,5],[7,5],[7,7],[5,7],[5,5]]]";
    let map = format!(
        r#"{{"type":"FeatureCollection","features":[{{"type":"Feature","properties":{{}},
            "geometry":{{"type":"Polygon","coordinates":{rings}}}}}]}}"#
    );
    bench.write("map.geojson", &map);
    let recipe =
        "map.geojson -o map.off --finish --min-angle 25 --extent boundary --crossings split";
    for (more, area, interior) in [("", 196.0, "parity"), (" --interior seeds", 200.0, "seeds")] {
        bench.run(&format!("{recipe} -q --validate --json map.json{more}")).assert_success();
        let json: Value = serde_json::from_str(&bench.read("map.json")).expect("it is JSON");
        assert_eq!(json["options"]["interior"], interior);
        let text = bench.read("map.off");
        let mut numbers = text.split_ascii_whitespace().skip(1).map(|word| word.parse::<f64>());
        let mut next = || numbers.next().expect("another number").expect("a number");
        let (vertices, triangles) = (next() as usize, next() as usize);
        next();
        let points: Vec<[f64; 2]> = (0..vertices).map(|_| ([next(), next()], next()).0).collect();
        let double_areas = (0..triangles).map(|_| {
            next();
            let [a, b, c] = [next(), next(), next()].map(|id| points[id as usize]);
            (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        });
        let found = double_areas.sum::<f64>() / 2.0;
        assert!((found - area).abs() < 1e-9, "{found}");
    }
}
