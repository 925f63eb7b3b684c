//! All experiments on inputs so small that they take seconds: the tables have their headers and
//! rows, the document names every picture, one experiment's section can be replaced alone, and the
//! verdicts can be made again from the tables.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

const HEADERS: [(&str, &str); 8] = [
    ("spread", "input,dim,method,log2 exponent,log2 gap,log2 spread,n,runs,m/n,touches/n"),
    (
        "growth",
        "input,dim,n,ordering,m/n,touches/(n log2 n),simplices made/m,exact signs/m,rounds,",
    ),
    ("finishing", "input,dim,pairs or exponent,n,m hierarchical,m finished,"),
    ("skew_lines", "method,n,vertices,tetrahedra,tetrahedra/n,(n/2 - 1)^2,seconds"),
    ("sizes", "input,dim,n,bound,mesher,m/n,inside/n,simplices,worst,note,seconds"),
    (
        "dimensions",
        "dim,input,n,m/n,simplices/vertex,seconds,points/s,MiB,KiB/input,certificate,certificate \
         seconds",
    ),
    ("cage_cells", "input,dim,n,m/n,counted,anywhere,in cage gaps,in gaps/n"),
    ("slivers", "input,n,degrees,slivers,left,m/n before,m/n,seconds,time,level"),
];

fn run(folder: &Path, options_and_names: &[&str]) {
    let output = Command::new(env!("CARGO_BIN_EXE_experiments"))
        .args(["--tiny", "--scratch"])
        .arg(folder.join("scratch"))
        .arg("--output")
        .arg(folder.join("results"))
        .arg("--document")
        .arg(folder.join("results.md"))
        .args(options_and_names)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

/// Returns the names of the pictures that a document shows, in its order.
fn pictures(document: &str) -> Vec<&str> {
    let images =
        document.split("![").skip(1).filter_map(|rest| rest.split_once("](")?.1.split_once(')'));
    images.filter_map(|(path, _)| path.rsplit('/').next()).collect()
}

#[test]
fn every_experiment_writes_its_tables_and_its_section() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("experiments");
    if folder.exists() {
        std::fs::remove_dir_all(&folder).unwrap();
    }
    std::fs::create_dir_all(&folder).unwrap();
    run(&folder, &[]);
    let results = folder.join("results");
    for (name, header) in HEADERS {
        let csv = std::fs::read_to_string(results.join(format!("{name}.csv"))).unwrap();
        assert!(csv.starts_with(header), "{name}: {}", csv.lines().next().unwrap());
        let columns = csv.lines().next().unwrap().split(',').count();
        assert!(csv.lines().count() > 2, "{name}");
        assert!(csv.lines().all(|line| line.split(',').count() >= columns), "{name}");
    }
    let document = std::fs::read_to_string(folder.join("results.md")).unwrap();
    // Its pictures are those of the document that is shipped, which a test of the Python package
    // draws.
    let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/reports/experiments.md");
    let shipped = std::fs::read_to_string(shipped).unwrap();
    assert_eq!(pictures(&document), pictures(&shipped));
    assert_eq!(pictures(&document).len(), 12);
    run(&folder, &["cage_cells"]);
    // Counts do not depend on the clock: the section is what it was, and so is the rest.
    assert_eq!(std::fs::read_to_string(folder.join("results.md")).unwrap(), document);

    run(&folder, &["--from-csv"]);
    let made_again = contents(&folder);
    // A figure made of rounded ones may differ in its last digit, but only once.
    run(&folder, &["--from-csv"]);
    assert!(contents(&folder) == made_again);
}

/// All files of the results, and the document.
fn contents(folder: &Path) -> BTreeMap<PathBuf, String> {
    let results = std::fs::read_dir(folder.join("results")).unwrap();
    let paths = results.map(|entry| entry.unwrap().path()).chain([folder.join("results.md")]);
    paths.map(|path| (path.clone(), std::fs::read_to_string(path).unwrap())).collect()
}
