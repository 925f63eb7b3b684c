//! Columns of the input that become attributes of the points, and where the output has them.

use crate::workbench::Workbench;
use std::fs;
use std::path::Path;

/// Points with a temperature, a label and a second number; the last one is the first again.
const STATIONS: &str = "\
id,X,y,z,temp,label,flow-x
7,0,0,0,12.5,a,1
8,1,0,0.5,-3,b,2
9,0,1,0.25,4e300,,3
10,1,1,1,,c,4
11,0.5,0.25,2,0.1,c,5
12,0,0,0,99,a,6
";

fn bench_with(test: &str) -> Workbench {
    let bench = Workbench::new(test);
    bench.write("stations.csv", STATIONS);
    bench
}

/// A column of a CSV file by name.
fn column(bench: &Workbench, file: &str, name: &str) -> Vec<f64> {
    let text = bench.read(file);
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let at = header.iter().position(|other| *other == name);
    let at = at.unwrap_or_else(|| panic!("no column {name} in: {header:?}"));
    let value = |line: &str| line.split(',').nth(at).expect("a field").parse().expect("a number");
    lines.map(value).collect()
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| if value.is_nan() { u64::MAX } else { value.to_bits() }).collect()
}

/// Temperatures of the five distinct stations.
const TEMPERATURES: [f64; 5] = [12.5, -3.0, 4e300, f64::NAN, 0.1];

#[test]
fn columns_by_name_are_attributes_at_the_inputs() {
    let bench = bench_with("by_name");
    let outcome = bench.run("stations.csv --attributes TEMP,flow-x -o mesh.csv");
    outcome.assert_success();
    let expected = "attributes  temp, flow-x; of equal points those of the first\n";
    assert!(outcome.stdout.contains(expected), "{}", outcome.stdout);
    assert!(bench.read("mesh.csv").starts_with("x0,x1,x2,kind,temp,flow-x\n"));
    assert_eq!(bits(&column(&bench, "mesh.csv", "temp")[..5]), bits(&TEMPERATURES));
    assert_eq!(column(&bench, "mesh.csv", "flow-x")[..5], [1.0, 2.0, 3.0, 4.0, 5.0]);
    for (choice, names) in [
        ("--attributes 5,7", "temp,flow-x"),
        ("--columns x,y,z --attributes 5,heat=7,height=z", "temp,heat,height"),
        ("--columns 2-4 --attributes heat=temp", "heat"),
    ] {
        bench.run(&format!("stations.csv {choice} -q -o other.csv")).assert_success();
        let header = format!("x0,x1,x2,kind,{names}\n");
        assert!(bench.read("other.csv").starts_with(&header), "{choice}");
        let first = names.split(',').next().expect("a name");
        assert_eq!(bits(&column(&bench, "other.csv", first)[..5]), bits(&TEMPERATURES), "{choice}");
    }
}

/// The columns that a file of each format has are read from it again.
#[test]
fn every_format_that_holds_attributes_gives_them_back() {
    let bench = bench_with("every_format");
    let line = "stations.csv --attributes temp,flow-x -q -o";
    bench.run(&format!("{line} mesh.csv")).assert_success();
    let expected = ["temp", "flow-x"].map(|name| bits(&column(&bench, "mesh.csv", name)));
    for (file, names) in [
        ("mesh.csv", ["temp", "flow-x"]),
        ("mesh.ply", ["temp", "flow-x"]),
        ("mesh.npy", ["temp", "flow-x"]),
        ("mesh.node", ["attribute_1", "attribute_2"]),
    ] {
        bench.run(&format!("{line} {file}")).assert_success();
        bench.run(&format!("{file} --attributes all -q -o again.csv")).assert_success();
        let header = format!("x0,x1,x2,kind,{}\n", names.join(","));
        assert!(bench.read("again.csv").starts_with(&header), "{file}");
        for (name, expected) in names.iter().zip(&expected) {
            let found = bits(&column(&bench, "again.csv", name));
            assert_eq!(found[..expected.len()], expected[..], "{file} {name}");
        }
    }
    for (file, declaration) in [
        ("mesh.vtu", "type=\"Float64\" Name=\"temp\" NumberOfComponents=\"1\""),
        ("mesh.msh", "$NodeData\n1\n\"flow-x\"\n"),
    ] {
        bench.run(&format!("{line} {file}")).assert_success();
        assert!(bench.read(file).contains(declaration), "{file}");
    }
}

#[test]
fn added_vertices_have_linear_values_or_none() {
    let bench = Workbench::new("added_values");
    let mut text = String::from("x,y,h\n");
    for i in 0..60 {
        let (x, y) = (f64::from(i * 37 % 60) / 60.0, f64::from(i * i % 61) / 61.0);
        text += &format!("{x},{y},{}\n", 2.0 * x - 3.0 * y);
    }
    bench.write("plane.csv", &text);
    bench.run("plane.csv --attributes h -q -o linear.csv").assert_success();
    bench.run("plane.csv --attributes h --added-values nan -q -o nan.csv").assert_success();
    let get = |file: &str, name: &str| column(&bench, file, name);
    let kinds = get("nan.csv", "kind");
    for (kind, value) in kinds.iter().zip(get("nan.csv", "h")) {
        assert_eq!(*kind == 0.0, !value.is_nan());
    }
    let (x, y, h) = (get("linear.csv", "x0"), get("linear.csv", "x1"), get("linear.csv", "h"));
    assert_eq!(h[..60], get("nan.csv", "h")[..60]);
    let mut inside = 0;
    for (vertex, &value) in h.iter().enumerate().skip(60) {
        assert!((-3.0..=2.0).contains(&value), "{value}");
        let linear = (value - 2.0 * x[vertex] + 3.0 * y[vertex]).abs() < 1e-12;
        let well_inside = [x[vertex], y[vertex]].iter().all(|t| (0.3..0.7).contains(t));
        assert!(linear || !well_inside, "{vertex}");
        inside += usize::from(well_inside);
    }
    assert!(inside > 0 && kinds.contains(&2.0));
}

#[test]
fn without_names_columns_have_numbers_and_the_others_are_coordinates() {
    let bench = Workbench::new("by_number");
    let text = "0 0 9 1\n1 0 8 2\n0 1 7 3\n1 1 6 4\n0.5 0.25 5 5\n";
    bench.write("scan.xyz", text);
    bench.write("scan.csv", &text.replace(' ', ","));
    for file in ["scan.xyz", "scan.csv"] {
        for choice in ["--attributes 3-4", "--columns 1,2 --attributes all"] {
            bench.run(&format!("{file} {choice} -q -o mesh.csv")).assert_success();
            assert!(bench.read("mesh.csv").starts_with("x0,x1,kind,column_3,column_4\n"));
            assert_eq!(column(&bench, "mesh.csv", "column_3")[..5], [9.0, 8.0, 7.0, 6.0, 5.0]);
        }
        bench.run(&format!("{file} --attributes heat=4 -q -o mesh.csv")).assert_success();
        assert!(bench.read("mesh.csv").starts_with("x0,x1,x2,kind,heat\n"), "{file}");
    }
}

#[test]
fn tetgens_attributes_and_marker_are_columns() {
    let bench = Workbench::new("tetgen");
    bench.write("a.node", "4 2 2 1\n1 0 0 5 50 1\n2 1 0 6 60 2\n3 0 1 7 70 3\n4 1 1 8 80 4\n");
    bench.run("a.node --attributes heat=2,marker,1 -q -o a.csv").assert_success();
    assert!(bench.read("a.csv").starts_with("x0,x1,kind,heat,marker,attribute_1\n0,0,0,50,1,5\n"));
    bench.run("a.node --attributes all -q -o b.node --algorithm delaunay").assert_success();
    assert!(bench.read("b.node").starts_with("4 2 2 1\n0 0 0 5 50 0\n1 1 0 6 60 0\n"));
}

#[test]
fn an_output_that_holds_no_attributes_is_refused_before_the_input_is_read() {
    let bench = Workbench::new("no_attributes");
    for (file, format) in [
        ("a.off", "OFF"),
        ("a.mesh", "Medit"),
        ("a.xyz", "XYZ"),
        ("a.voronoi.json", "the Voronoi diagram"),
        ("a.domains.json", "the hierarchy of domains"),
    ] {
        let words =
            [file, format, "holds no attributes", "VTU, TetGen, Gmsh, PLY, CSV, NumPy or HTML"];
        bench.run(&format!("nowhere.xyz --attributes 3 -o {file}")).assert_failure(2, &words);
    }
    let line = "nowhere.xyz --attributes 3 -o - --output-format off";
    bench.run(line).assert_failure(2, &["standard output: OFF holds no attributes"]);
    bench.run("nowhere.xyz --attributes 3").assert_failure(2, &["--output <FILE>"]);
    bench.run("nowhere.xyz --added-values nan").assert_failure(2, &["--attributes <LIST>"]);
    assert!(bench.files().is_empty());
}

#[test]
fn wrong_attributes_name_the_option_the_column_and_the_rule() {
    let bench = bench_with("wrong_attributes");
    bench.write("scan.xyz", "0 0 0 7\n1 0 0 7\n0 1 0 word\n");
    bench.write("mesh.off", "OFF\n2 0 0\n0 0 0\n1 1 1\n");
    bench.write("a.node", "2 2 1 0\n0 0 0 7\n1 1 1 8\n");
    bench.write(
        "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n\
         property float nx\nproperty list uchar int near\nend_header\n0 0 1 0\n1 1 1 0\n",
    );
    bench.write("same.csv", "x,y,a b,h,H\n0,0,1,2,3\n1,1,1,2,3\n");
    for (line, words) in [
        (
            "stations.csv --attributes heat",
            &["stations.csv: --attributes: no column is called \"heat\"", r#""temp", "label""#][..],
        ),
        ("stations.csv --attributes 8", &["--attributes: there is no column 8", "has 7 columns"]),
        ("stations.csv --attributes 5-9", &["--attributes: there is no column 9"]),
        ("stations.csv --attributes temp,5", &["--attributes: column 5 is taken twice"]),
        ("stations.csv --attributes a=temp,a=7", &["two attributes are called \"a\""]),
        ("stations.csv --attributes z", &["column 4 is called \"z\"", "NAME=4"]),
        ("stations.csv --attributes kind=temp", &["'--attributes <LIST>'", "\"kind\" is no name"]),
        ("stations.csv --attributes a=5-6", &["one name to several columns"]),
        ("stations.csv --attributes temp,,7", &["'--attributes <LIST>'", "an entry is empty"]),
        ("stations.csv --attributes 0", &["they count from 1"]),
        ("same.csv --attributes h", &["two columns are called \"h\"; choose by number"]),
        ("same.csv --attributes all", &["column 3 is called \"a b\"", "NAME=3"]),
        ("scan.xyz --attributes heat", &["--attributes: \"heat\" is a name", "by number"]),
        ("scan.xyz --attributes all", &["every column of the file is a coordinate", "--columns"]),
        ("a.node --attributes heat", &["no column is called \"heat\"; there are \"attribute_1\""]),
        ("a.node --attributes 2", &["there is no column 2"]),
        ("a.ply --attributes near", &["--attributes: the property \"near\" is a list"]),
        ("mesh.off --attributes 1", &["--attributes: of OFF files no attributes are read"]),
    ] {
        bench.run(&format!("{line} -o out.csv")).assert_failure(2, words);
    }
    let words = ["scan.xyz: line 3, column 4: \"word\" is not a number", "attribute column_4"];
    bench.run("scan.xyz --attributes 4 -o out.csv").assert_failure(3, &words);
    let words = ["line 2, column 6: \"a\" is not a number", "attribute label"];
    bench.run("stations.csv --attributes all -o out.csv").assert_failure(3, &words);
    bench.write("huge.xyz", "0 0 1e999\n1 1 1\n");
    let words = ["line 1, column 3: \"1e999\" is too large for a double", "attribute column_3"];
    bench.run("huge.xyz --attributes 3 -o out.csv").assert_failure(3, &words);
    assert!(!bench.files().contains(&"out.csv".to_owned()));
}

/// A week of earthquakes: longitude, latitude, depth.
#[test]
fn depths_of_earthquakes_are_attributes_of_the_plane() {
    const NAME: &str = "usgs_quakes_week.xyz";
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/data");
    let directory = std::env::var_os("NETMESH_DATA").unwrap_or_else(|| beside.into());
    let Ok(text) = fs::read_to_string(Path::new(&directory).join(NAME)) else {
        println!("skipped: {NAME} is not in the data directory (set NETMESH_DATA to it)");
        return;
    };
    let bench = Workbench::new("earthquakes");
    bench.write("quakes.xyz", &text);
    let line = "quakes.xyz --columns 1,2 --attributes depth=3 -q -o";
    bench.run(&format!("{line} mesh.vtu")).assert_success();
    assert!(bench.read("mesh.vtu").contains("Name=\"depth\""));
    bench.run(&format!("{line} mesh.csv")).assert_success();
    let depths = column(&bench, "mesh.csv", "depth");
    let mut places: Vec<(&str, &str)> = Vec::new();
    for line in text.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        let [lon, lat, depth] = words[..] else { panic!("three columns: {line}") };
        if !places.contains(&(lon, lat)) {
            let depth: f64 = depth.parse().expect("a number");
            assert_eq!(depths[places.len()], depth, "{line}");
            places.push((lon, lat));
        }
    }
    assert!(places.len() > 1000 && depths.len() > places.len());
    let (least, most) = depths[..places.len()]
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &x| (a.min(x), b.max(x)));
    assert!(depths.iter().all(|depth| (least - 1e-9..=most + 1e-9).contains(depth)));
}
