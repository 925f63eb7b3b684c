//! Compiles the C layer with MPI's own compiler wrapper, and links what that would link.
//!
//! `MPICC` names another wrapper than `mpicc`. Of the wrappers only the answer to `-show` (Open
//! MPI's and MPICH's alike) is read: the command line that they would run.

use std::process::Command;

const SOURCES: [&str; 3] =
    ["src/comm/mpi/layer.c", "src/comm/mpi/files.c", "src/capi/nm_mpi_run.c"];

fn main() {
    println!("cargo:rerun-if-env-changed=MPICC");
    let wrapper = std::env::var("MPICC").unwrap_or_else(|_| "mpicc".into());
    let shown = Command::new(&wrapper).arg("-show").output();
    let shown = match shown {
        Ok(output) if output.status.success() => {
            String::from_utf8_lossy(&output.stdout).into_owned()
        }
        _ => panic!(
            "`{wrapper} -show` fails: MPI is needed (Debian: libopenmpi-dev), or MPICC, which \
             names its compiler wrapper"
        ),
    };
    let mut build = cc::Build::new();
    for word in shown.split_ascii_whitespace().filter(|word| is_for_the_compiler(word)) {
        build.flag(word);
    }
    for source in SOURCES {
        println!("cargo:rerun-if-changed={source}");
        build.file(source);
    }
    for header in ["src/comm/mpi/layer.h", "../include/netmesh.h"] {
        println!("cargo:rerun-if-changed={header}");
    }
    build.include("../include").include("src/comm/mpi");
    build.std("c99").warnings(true).extra_warnings(true);
    build.compile("netmesh_mpi_layer");
    for word in shown.split_ascii_whitespace() {
        if let Some(directory) = word.strip_prefix("-L") {
            println!("cargo:rustc-link-search=native={directory}");
        } else if let Some(library) = word.strip_prefix("-l") {
            println!("cargo:rustc-link-lib=dylib={library}");
        }
    }
}

/// Returns true for words of the wrapper's command that name directories of headers, or macros.
fn is_for_the_compiler(word: &str) -> bool {
    ["-I", "-isystem", "-D"].iter().any(|start| word.starts_with(start))
}
