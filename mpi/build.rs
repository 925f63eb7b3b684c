//! Compiles the C layer with MPI's own compiler wrapper, and links what that would link.
//!
//! `MPICC` names another wrapper than `mpicc`. Of the wrappers only the answer to `-show` (Open
//! MPI's and MPICH's alike) is read: the command line that they would run.
//!
//! Without MPI the C layer is left out, with a warning: what only looks at the code (`cargo clippy
//! --workspace`) does without it, and what links fails.

use std::process::Command;

const SOURCES: [&str; 3] =
    ["src/comm/mpi/layer.c", "src/comm/mpi/files.c", "src/capi/nm_mpi_run.c"];

fn main() {
    println!("cargo:rerun-if-env-changed=MPICC");
    let wrapper = std::env::var("MPICC").unwrap_or_else(|_| "mpicc".into());
    let Some(shown) = command_of(&wrapper) else {
        println!(
            "cargo:warning=`{wrapper} -show` fails, and without MPI (Debian: libopenmpi-dev), or \
             MPICC, which names its compiler wrapper, nothing of netmesh-mpi can be linked"
        );
        // A file that is not there has this script run again, until there is an MPI.
        println!("cargo:rerun-if-changed=MPI");
        return;
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

/// Returns the command line that MPI's compiler wrapper would run; `None` if there is no such
/// wrapper.
fn command_of(wrapper: &str) -> Option<String> {
    let output = Command::new(wrapper).arg("-show").output().ok()?;
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).into_owned())
}

/// Returns true for words of the wrapper's command that name directories of headers, or macros.
fn is_for_the_compiler(word: &str) -> bool {
    ["-I", "-isystem", "-D"].iter().any(|start| word.starts_with(start))
}
