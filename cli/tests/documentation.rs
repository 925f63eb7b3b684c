//! The documents say what the code does.

use crate::workbench::Workbench;
use netmesh::{Criterion, Mesh, Options};
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn read(path: &str) -> String {
    fs::read_to_string(root().join(path)).expect("the document is there")
}

/// The second column of the table of options.
fn documented_default(option: &str) -> String {
    let document = read("docs/options.md");
    let row = document.lines().find(|line| line.starts_with(&format!("| {option} |")));
    let row = row.unwrap_or_else(|| panic!("no row for {option}"));
    row.split('|').nth(2).expect("a second column").trim().to_owned()
}

/// The parameters that a run in `dim` dimensions fills in.
fn parameters(dim: usize, criterion: Criterion) -> Vec<(&'static str, f64)> {
    let points = [[0.0; 5], [1.0; 5]].concat();
    let mut mesh = Mesh::new(dim, 2, &points, 5).expect("two points");
    mesh.run(&Options { criterion, ..Options::default() }, None).expect("defaults are valid");
    let parameters = &mesh.triangulation().expect("a result").parameters;
    let bound = match criterion {
        Criterion::VoronoiAspect => "`quality_bound` (aspect)",
        Criterion::RadiusEdge => "`quality_bound` (radius-edge)",
    };
    vec![
        (bound, parameters.quality_bound),
        ("`epsilon`", parameters.epsilon),
        ("`delta`", parameters.delta),
        ("`gamma`", parameters.gamma),
        ("`yield_radius`", parameters.yield_radius),
        ("`encroachment`", parameters.encroachment),
        ("`cage_scale`", parameters.cage_scale),
        ("`root_scale`", parameters.root_scale),
        ("`max_vertices`", parameters.max_vertices as f64),
    ]
}

/// Returns a row of the table: one value where all dimensions agree, otherwise four.
fn listed(values: [f64; 4]) -> String {
    let words = values.map(|value| value.to_string());
    if words.iter().all(|word| *word == words[0]) { words[0].clone() } else { words.join(", ") }
}

#[test]
fn documented_defaults_are_those_of_the_code() {
    for criterion in [Criterion::VoronoiAspect, Criterion::RadiusEdge] {
        let of_dimension = [2, 3, 4, 5].map(|dim| parameters(dim, criterion));
        for (row, &(option, _)) in of_dimension[0].iter().enumerate() {
            let values = of_dimension.each_ref().map(|parameters| parameters[row].1);
            assert_eq!(documented_default(option), listed(values), "{option}");
        }
    }
}

#[test]
fn every_exit_code_is_in_the_help_and_in_the_document() {
    let help = Command::new(env!("CARGO_BIN_EXE_netmesh")).arg("--help").output().expect("it runs");
    let help = String::from_utf8_lossy(&help.stdout).into_owned();
    let document = read("docs/command_line.md");
    for code in 0..=8 {
        assert!(help.contains(&format!("\n  {code}  ")), "{code} in --help");
        assert!(document.contains(&format!("\n| {code} | ")), "{code} in the document");
    }
}

#[test]
fn every_format_is_in_the_document() {
    let help = Command::new(env!("CARGO_BIN_EXE_netmesh")).arg("--help").output().expect("it runs");
    let help = String::from_utf8_lossy(&help.stdout).into_owned();
    // Formats that can be read, and those that can be written.
    let mut names: Vec<&str> = Vec::new();
    for (option, count) in [("--input-format <FORMAT>", 14), ("--output-format <FORMAT>", 14)] {
        let (_, formats) = help.split_once(option).expect("the option");
        let listed = formats
            .lines()
            .skip(1)
            .take_while(|line| !line.trim_start().starts_with("--"))
            .filter_map(|line| line.trim_start().strip_prefix("- ")?.split(':').next());
        let before = names.len();
        names.extend(listed);
        assert_eq!(names.len() - before, count, "{formats}");
    }
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), 19, "{names:?}");
    let (document, header) = (read("docs/formats.md"), read("include/netmesh.h"));
    for name in names {
        let row = document.lines().find(|line| line.contains(&format!("| `{name}` |")));
        let row = row.unwrap_or_else(|| panic!("no row for {name}"));
        let constant = row.split('`').find(|word| word.starts_with("NM_FORMAT_"));
        let constant = constant.unwrap_or_else(|| panic!("no constant in: {row}"));
        assert!(header.contains(&format!("    {constant} = ")), "{constant}");
    }
}

#[test]
fn the_c_example_in_the_readme_compiles() {
    let readme = read("README.md");
    let (_, rest) = readme.split_once("```c\n").expect("a C example");
    let (example, _) = rest.split_once("```").expect("its end");
    let mut compiler = Command::new("cc")
        .args(["-std=c99", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "-x", "c", "-"])
        .arg("-I")
        .arg(root().join("include"))
        .stdin(Stdio::piped())
        .spawn()
        .expect("cc starts");
    let mut input = compiler.stdin.take().expect("a pipe");
    input.write_all(example.as_bytes()).expect("cc reads");
    drop(input);
    assert!(compiler.wait().expect("cc ends").success());
}

/// The lines of a summary that are the same on every machine.
fn without_times(summary: &str) -> Vec<&str> {
    summary.lines().filter(|line| !line.starts_with("time ")).collect()
}

#[test]
fn the_figures_of_the_demo_are_those_that_it_prints() {
    let readme = read("README.md");
    let (_, rest) = readme.split_once("runs the command line, `netmesh ").expect("the command");
    let (command, rest) = rest.split_once('`').expect("its end");
    let printed = rest.lines().skip_while(|line| !line.starts_with("    ")).map(str::trim_end);
    let printed = printed.map_while(|line| line.strip_prefix("    ")).collect::<Vec<_>>();
    let bench = Workbench::new("demo");
    bench.write("samples/knot_3d.xyz", &read("samples/knot_3d.xyz"));
    bench.write("target/README", "the demo writes beside this file\n");
    let outcome = bench.run(command);
    outcome.assert_success();
    assert_eq!(without_times(&printed.join("\n")), without_times(&outcome.stdout));
    assert_eq!(printed.len(), 11);
}

#[test]
fn the_demo_runs_the_command_of_the_readme() {
    let demo = read("demo");
    let (_, arguments) = demo.split_once("netmesh-cli -- \\\n").expect("the arguments");
    let arguments = arguments.replace("--output", "-o").replace("\"$@\"", "");
    let command = arguments.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(read("README.md").contains(&format!("`netmesh {command}`")), "{command}");
}
