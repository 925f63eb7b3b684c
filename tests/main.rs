//! The tests from outside, as one program: every program of its own is linked anew and compiles
//! again what it uses of the library. `hostile_files.rs` is another one, since it counts what its
//! allocator is asked for.

mod architecture;
mod automatic;
mod c_api;
mod called_functions;
mod certificate;
mod damaged_features;
mod damaged_meshes;
mod determinism;
mod domains;
mod extremes;
mod final_refinement;
mod formats;
mod guarantees;
mod header;
mod high_dimensions;
mod instruments;
mod least_bounds;
mod lengths;
mod messages;
mod odd_files;
mod option_views;
mod pages;
mod polygons;
mod progress;
mod properties;
mod size_fields;
mod sizes;
mod slivers;
mod small_stacks;
mod solids;
mod spread_curve;
mod svr;
mod words;
mod written_files;

#[path = "c/compiler.rs"]
mod compiler;
#[path = "support/directory.rs"]
mod directory;
#[path = "support/random.rs"]
mod random;

/// A file that nobody names is not compiled, and its tests pass unrun.
#[test]
fn every_file_is_a_module() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let named = [include_str!("main.rs"), include_str!("../Cargo.toml")].concat();
    for entry in std::fs::read_dir(root.join("tests")).expect("the directory of the tests") {
        let path = entry.expect("an entry").path();
        let name = path.file_stem().and_then(|stem| stem.to_str()).expect("a name");
        let holds_tests = path.extension().is_some() || path.join("mod.rs").exists();
        let declarations = [format!("mod {name};"), format!("name = \"{name}\"")];
        let is_named = name == "main" || declarations.iter().any(|line| named.contains(line));
        assert!(is_named || !holds_tests, "{} is in no test program", path.display());
    }
}
