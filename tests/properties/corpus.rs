//! Every file in `fuzz/corpus`: seeds, and whatever once broke something, under the name of what it
//! broke.

use super::checks::{c_api, facets, features, mesh, poly, readers, segments, signs};
use std::panic::catch_unwind;
use std::path::Path;

/// Checks all files of a target's corpus; names all that fail.
fn replay(target: &str, check: fn(&[u8])) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus").join(target);
    let mut files: Vec<_> = folder.read_dir().unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    assert!(files.len() >= 5, "only {} files in {}", files.len(), folder.display());
    let fails = |file: &&std::path::PathBuf| {
        let data = std::fs::read(file).unwrap();
        catch_unwind(|| check(&data)).is_err()
    };
    let failed: Vec<_> = files.iter().filter(fails).filter_map(|file| file.file_name()).collect();
    assert!(failed.is_empty(), "{failed:?} of {}", folder.display());
}

#[test]
fn the_corpus_of_signs() {
    replay("signs", signs::check);
}

#[test]
fn the_corpus_of_meshes() {
    replay("mesh", mesh::check);
}

#[test]
fn the_corpus_of_c_api_calls() {
    replay("c_api", c_api::check);
}

#[test]
fn the_corpus_of_files() {
    replay("readers", readers::check);
}

#[test]
fn the_corpus_of_segments() {
    replay("segments", segments::check);
}

#[test]
fn the_corpus_of_facets() {
    replay("facets", facets::check);
}

#[test]
fn the_corpus_of_poly_files() {
    replay("poly", poly::check);
}

#[test]
fn the_corpus_of_features() {
    replay("features", features::check);
}
