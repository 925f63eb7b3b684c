//! Readers that others wrote, on files that this crate wrote. They need `python3` on the search
//! path, with `meshio`, `vtk`, `gmsh` and `numpy`; where one is missing its tests say so and pass.

mod attributes;
mod diagrams;
mod labels;
mod meshes;
mod points;

use super::{Format, write_file_with};
use crate::mesh::{Attribute, Mesh};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn python_has(module: &str) -> bool {
    let import = Command::new("python3").args(["-c", &format!("import {module}")]).output();
    let found = import.is_ok_and(|output| output.status.success());
    if !found {
        eprintln!("skipped: python3 cannot import {module}");
    }
    found
}

/// A fresh directory for one test, removed at its end.
struct Directory(PathBuf);

impl Directory {
    fn new(name: &str) -> Self {
        let name = format!("netmesh-{}-independent-{name}", std::process::id());
        let path = std::env::temp_dir().join(name);
        fs::create_dir(&path).unwrap();
        Self(path)
    }
}

impl Drop for Directory {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Returns what `script` finds in the file called `name` that `write_file` makes of `mesh`. Each
/// test has names of its own.
fn as_read_by(script: &str, mesh: &Mesh, name: &str, arguments: &[&str]) -> String {
    read_with_attributes(script, mesh, &[], name, arguments)
}

/// Returns what `script` finds in a file with attributes.
fn read_with_attributes(
    script: &str,
    mesh: &Mesh,
    attributes: &[Attribute],
    name: &str,
    arguments: &[&str],
) -> String {
    let directory = Directory::new(name);
    let path = directory.0.join(name);
    write_file_with(mesh, attributes, &path, Format::Auto).unwrap();
    run(script, &path, arguments)
}

fn run(script: &str, path: &Path, arguments: &[&str]) -> String {
    let mut python = Command::new("python3");
    let output = python.args(["-c", script]).arg(path).args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn bits<'a>(values: impl IntoIterator<Item = &'a f64>) -> Vec<u64> {
    values.into_iter().map(|value| value.to_bits()).collect()
}
