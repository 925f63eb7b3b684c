//! Every test that docs/guarantees.md names is there.

use std::fs;
use std::path::{Path, PathBuf};

const DOCUMENT: &str = "docs/guarantees.md";
/// Folders of tests.
const PLACES: [&str; 6] =
    ["tests", "src", "cpp_tests", "fuzz/src", "fuzz/examples", "python/tests"];

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// The names and the texts of all files below, this one apart.
fn haystack() -> String {
    let mut directories: Vec<PathBuf> = PLACES.iter().map(|place| root().join(place)).collect();
    let (mut all, this) = (String::new(), Path::new(file!()).file_name());
    while let Some(directory) = directories.pop() {
        for entry in fs::read_dir(directory).expect("a directory") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                directories.push(path);
            } else if let (true, Ok(text)) = (path.file_name() != this, fs::read_to_string(&path)) {
                all += &format!("{}\n{text}\n", path.display());
            }
        }
    }
    all
}

/// The last cells of the tables' rows.
fn holders(document: &str) -> Vec<&str> {
    let rows =
        document.lines().filter(|line| line.starts_with("| ") && !line.ends_with("| Held by |"));
    rows.filter_map(|row| row.trim_end_matches('|').rsplit(" | ").next()).collect()
}

/// A test of ctest is registered under parts of its name: `spread.2d` as `spread.${dim}d`.
fn is_known(name: &str, haystack: &str) -> bool {
    let is_path = name.contains('/');
    let stem = name.trim_end_matches('*').trim_end_matches('.');
    let registered = stem.split('.').next().expect("a name");
    match is_path {
        true => root().join(name).exists(),
        false => haystack.contains(stem) || name.contains('.') && haystack.contains(registered),
    }
}

#[test]
fn every_test_that_is_named_is_there() {
    let document = fs::read_to_string(root().join(DOCUMENT)).expect("the document");
    let haystack = haystack();
    let holders = holders(&document);
    assert!(holders.len() > 40, "{} promises", holders.len());
    for holder in holders {
        let names: Vec<&str> = holder.split('`').skip(1).step_by(2).collect();
        let other = ["level ", "the tests of "].iter().any(|start| holder.starts_with(start));
        assert!(other || !names.is_empty(), "nothing holds this: {holder}");
        for name in names {
            assert!(is_known(name, &haystack), "{DOCUMENT} names {name}");
        }
    }
}
