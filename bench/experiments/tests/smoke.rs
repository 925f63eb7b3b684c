//! All experiments on inputs so small that they take seconds: the tables have their headers and
//! rows, the plots are well-formed, one experiment's section can be replaced alone, and the plots
//! can be made again from the tables.

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
        "dim,input,n,m/n,simplices/vertex,seconds,points/s,MiB,KiB/input,certificate,certificate seconds",
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

fn files(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let all = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    all.filter(|path| path.extension().is_some_and(|e| e == extension)).collect()
}

/// Where there is a Python, by its parser; the unit tests count tags in any case.
fn check_plots(plots: &[PathBuf]) {
    let script = "import sys, xml.dom.minidom as m\nfor f in sys.argv[1:]: m.parse(f)";
    match Command::new("python3").args(["-c", script]).args(plots).output() {
        Ok(output) => {
            assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        }
        Err(_) => eprintln!("no python3: the plots are not parsed"),
    }
}

#[test]
fn every_experiment_writes_its_tables_and_plots() {
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
    let plots = files(&results, "svg");
    assert!(plots.len() >= 12, "{plots:?}");
    check_plots(&plots);

    let document = std::fs::read_to_string(folder.join("results.md")).unwrap();
    for plot in &plots {
        let name = plot.file_name().unwrap().to_str().unwrap();
        assert!(document.contains(&format!("(results/{name})")), "{name} is not in the document");
    }
    run(&folder, &["cage_cells"]);
    // Counts do not depend on the clock: the section is what it was, and so is the rest.
    assert_eq!(std::fs::read_to_string(folder.join("results.md")).unwrap(), document);

    for plot in &plots {
        std::fs::remove_file(plot).unwrap();
    }
    run(&folder, &["--from-csv"]);
    let made_again = contents(&folder);
    for plot in &plots {
        assert!(made_again.contains_key(plot), "{} is not made again", plot.display());
    }
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
