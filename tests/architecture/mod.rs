//! ARCHITECTURE.md is what the sources are: its table of layers, its directories, its files.

mod entries;
mod files;
mod memory;
mod planted;
mod planted_files;
mod uses;

use files::Graph;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use uses::{Layers, Source, uses};

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn document() -> String {
    fs::read_to_string(root().join("ARCHITECTURE.md")).expect("the document is there")
}

/// The first cell's name and the other cells of the rows of the table below a heading.
fn table(heading: &str) -> Vec<(String, Vec<String>)> {
    let text = document();
    let (_, section) = text.split_once(&format!("## {heading}\n")).expect("the section");
    let section = section.split("\n## ").next().expect("its text");
    let rows = section.lines().filter(|line| line.starts_with("| `"));
    rows.map(|row| {
        let mut cells = row.trim_matches('|').split('|').map(|cell| cell.trim().to_owned());
        let name = cells.next().expect("a first cell");
        (quoted(&name).remove(0), cells.collect())
    })
    .collect()
}

/// Returns the texts between backticks.
fn quoted(text: &str) -> Vec<String> {
    text.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

fn layers() -> Layers {
    let row =
        |(name, cells): (String, Vec<String>)| (name, quoted(&cells[1]).into_iter().collect());
    table("Layers").into_iter().map(row).collect()
}

/// The source files: their paths below src, with slashes, and their text.
fn files() -> Vec<(String, String)> {
    let mut found = Vec::new();
    let mut directories = vec![root().join("src")];
    while let Some(directory) = directories.pop() {
        for entry in fs::read_dir(directory).expect("a directory") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                directories.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let text = fs::read_to_string(&path).expect("a source").replace('\r', "");
                found.push((below_src(&path), text));
            }
        }
    }
    found
}

fn below_src(path: &Path) -> String {
    let below = path.strip_prefix(root().join("src")).expect("a path below src");
    below.components().map(|part| part.as_os_str().to_string_lossy()).collect::<Vec<_>>().join("/")
}

/// Files and directories of modules that are only there for tests.
fn test_modules(files: &[(String, String)]) -> Vec<String> {
    let mut modules = Vec::new();
    for (path, text) in files {
        let directory = match path.strip_suffix("mod.rs") {
            Some(directory) => directory.to_owned(),
            None => format!("{}/", path.trim_end_matches(".rs")),
        };
        for (line, next) in text.lines().zip(text.lines().skip(1)) {
            let declared = next.trim_start_matches("pub(crate) ").strip_prefix("mod ");
            if let (true, Some(name)) = (line.starts_with("#[cfg(test)]"), declared) {
                if let Some(name) = name.strip_suffix(';') {
                    modules
                        .extend([format!("{directory}{name}.rs"), format!("{directory}{name}/")]);
                }
            }
        }
    }
    modules
}

/// The source files without those that are only there for tests, and their text.
fn library_files() -> Vec<(String, String)> {
    let mut files = files();
    let tests = test_modules(&files);
    let is_test = |path: &str| {
        tests.iter().any(|t| path == t || t.ends_with('/') && path.starts_with(t.as_str()))
    };
    files.retain(|(path, _)| !is_test(path));
    files
}

fn sources() -> Vec<Source> {
    library_files().iter().map(|(path, text)| Source::parse(path, text)).collect()
}

#[test]
fn modules_use_what_the_table_says_and_nothing_else() {
    let (allowed, uses) = (layers(), uses(&sources()));
    let names = |layers: &Layers| layers.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&allowed), names(&uses), "the modules of the table and those under src");
    for (module, used) in &uses {
        assert_eq!(used, &allowed[module], "what {module} uses, and what ARCHITECTURE.md says");
    }
}

/// Returns the graph of the files of `netmesh`, which is made once: that takes some seconds.
fn graph_of_netmesh() -> &'static Graph {
    static GRAPH: OnceLock<Graph> = OnceLock::new();
    GRAPH.get_or_init(|| Graph::of(&sources(), "netmesh"))
}

/// The folders of `netmesh`, from the lowest up.
fn folders_of_netmesh() -> Vec<String> {
    table("Inside netmesh").into_iter().map(|(name, _)| name).collect()
}

#[test]
fn files_of_netmesh_depend_downwards_and_in_no_circle() {
    let graph = graph_of_netmesh();
    let folders = folders_of_netmesh();
    let below: BTreeSet<&str> =
        graph.files.keys().filter_map(|path| path.split('/').nth(1)).collect();
    let named: BTreeSet<&str> = folders.iter().map(String::as_str).chain(["mod.rs"]).collect();
    assert_eq!(below, named, "the folders below src/netmesh, and those of ARCHITECTURE.md");
    let complaints = graph.complaints("netmesh", &folders);
    assert!(complaints.is_empty(), "{complaints:#?}");
}

/// NEWCAGE may take in inputs that encroach the domains around it, whose cages then grow.
#[test]
fn methods_of_netmesh_call_each_other_in_one_circle_only() {
    let circles = graph_of_netmesh().method_circles();
    let methods = ["grow_cage", "grow_cage_for", "make_room_outside", "new_cage"];
    assert_eq!(circles, [methods.map(|method| format!("Mesher::{method}"))]);
}

/// Whatever the table says: it must not be made to say that an arrow runs back.
#[test]
fn no_arrow_runs_back() {
    let line = ["numerics", "complex", "delaunay", "netmesh"];
    let readers = ["quality", "validate", "io"];
    let data = ["error", "memory", "options", "parameters", "mesh"];
    let allowed = layers();
    for (place, module) in line.iter().enumerate() {
        let above = line[place + 1..].iter().chain(&readers).chain(&["capi"]);
        for other in above {
            assert!(!allowed[*module].contains(*other), "{module} uses {other}");
        }
    }
    for module in readers {
        for maker in line.iter().chain(&["run"]) {
            assert!(!allowed[module].contains(*maker), "{module} uses {maker}");
        }
    }
    for module in data {
        for other in line.iter().chain(&readers).chain(&["run"]) {
            assert!(!allowed[module].contains(*other), "{module} uses {other}");
        }
    }
    for (module, used) in &allowed {
        assert!(!used.contains("capi"), "{module} uses capi");
    }
    assert!(allowed["numerics"].is_empty(), "numerics uses {:?}", allowed["numerics"]);
}

#[test]
fn every_directory_is_named() {
    let named: BTreeSet<String> =
        table("Directories under src").into_iter().map(|(name, _)| name).collect();
    let directories: BTreeSet<String> = files()
        .iter()
        .filter_map(|(path, _)| path.rsplit_once('/'))
        .map(|(directory, _)| directory.to_owned())
        .collect();
    assert_eq!(named, directories);
}

#[test]
fn every_file_that_is_named_is_there() {
    let files: Vec<String> = files().into_iter().map(|(path, _)| path).collect();
    let text = document();
    let names = quoted(&text);
    let rust: Vec<&String> = names.iter().filter(|name| name.ends_with(".rs")).collect();
    assert!(rust.len() > 20, "{rust:?}");
    for name in rust {
        let is_it = |file: &String| file == name || file.ends_with(&format!("/{name}"));
        assert!(files.iter().any(is_it) || root().join(name).exists(), "{name}");
    }
}
