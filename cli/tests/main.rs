//! Tests of the command line from outside, as one program: every program of its own is linked anew.

mod alpha_shape;
mod attributes;
mod documentation;
mod facets;
mod files;
mod filtration;
mod histogram;
mod meshing;
mod min_angle;
mod polygons;
mod refusals;
mod sample;
mod sizes;
mod surface;
mod terminal;
mod viewer;
mod workbench;

/// A file that nobody names is not compiled, and its tests pass unrun.
#[test]
fn every_file_is_a_module() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    for entry in std::fs::read_dir(folder).expect("the directory of the tests") {
        let path = entry.expect("an entry").path();
        let name = path.file_stem().and_then(|stem| stem.to_str()).expect("a name");
        let is_named = include_str!("main.rs").contains(&format!("mod {name};"));
        assert!(is_named || name == "main", "{} is in no test program", path.display());
    }
}
