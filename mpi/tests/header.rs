//! The checked-in header is what cbindgen makes of `src/capi`, and compiles by itself.

use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn header() -> String {
    // A checkout may have changed the line ends.
    std::fs::read_to_string(root().join("include/netmesh_mpi.h")).unwrap().replace('\r', "")
}

#[test]
fn the_header_is_what_cbindgen_makes() {
    let config = cbindgen::Config::from_file(root().join("cbindgen.toml")).unwrap();
    // Sources by name: the functions of the C layer are declared elsewhere in the crate.
    let sources = ["structs", "run", "getters", "validate", "export"];
    let builder =
        sources.iter().fold(cbindgen::Builder::new().with_config(config), |builder, name| {
            builder.with_src(root().join(format!("src/capi/{name}.rs")))
        });
    let bindings = builder.generate().unwrap();
    let mut made = Vec::new();
    bindings.write(&mut made);
    let made = String::from_utf8(made).unwrap();
    if std::env::var_os("NETMESH_WRITE_HEADER").is_some() {
        std::fs::write(root().join("include/netmesh_mpi.h"), &made).unwrap();
    }
    for (i, (is, should)) in header().lines().zip(made.lines()).enumerate() {
        assert_eq!(
            is,
            should,
            "include/netmesh_mpi.h line {}; cbindgen.toml says how to make it",
            i + 1
        );
    }
    assert!(header() == made, "include/netmesh_mpi.h has another length than what cbindgen makes");
}

/// Holds that nothing is declared again by a program that includes the header twice.
#[test]
fn the_guard_is_around_all_that_is_declared() {
    let header = header();
    let (_, guarded) = header.split_once("#ifndef NETMESH_MPI_H\n#define NETMESH_MPI_H\n").unwrap();
    let (declared, after) = guarded.split_once("#endif  /* NETMESH_MPI_H */").unwrap();
    assert!(declared.contains("nm_status nm_mpi_run(MPI_Comm communicator"));
    assert_eq!(after.trim(), "");
}

/// Compiles a program with the compiler wrapper's flags.
fn compiles(name: &str, language: &[&str], text: &str) {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let source = directory.join(name);
    std::fs::write(&source, text).unwrap();
    let wrapper = std::env::var("MPICC").unwrap_or_else(|_| "mpicc".into());
    let include = root().join("include");
    let core = root().join("../include");
    let output = Command::new(wrapper)
        .args(language)
        .args(["-Wall", "-Wextra", "-Wredundant-decls", "-Werror", "-c", "-I"])
        .arg(include)
        .arg("-I")
        .arg(core)
        .arg(&source)
        .arg("-o")
        .arg(source.with_extension("o"))
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

const UNIT: &str = "#include \"netmesh_mpi.h\"
#include \"netmesh_mpi.h\"
#define CHECK(name, condition) typedef char name[(condition) ? 1 : -1]
CHECK(counts, sizeof(nm_mpi_counts) == 152 && offsetof(nm_mpi_counts, inputs) == 16);
CHECK(facet, sizeof(nm_mpi_facet) == 24 && offsetof(nm_mpi_facet, facet) == 16);
CHECK(domain, sizeof(nm_mpi_domain) == 56 && offsetof(nm_mpi_domain, position) == 32);
CHECK(report, sizeof(nm_mpi_report) == 208 && offsetof(nm_mpi_report, simplex) == 32);
CHECK(violation, sizeof(nm_violation) == 4 && NM_VIOLATION_MISSING_GHOST == 55);
CHECK(format, sizeof(nm_mpi_format) == 4 && NM_MPI_FORMAT_NPY == 2);
static const nm_mpi_counts counts_init = NM_MPI_COUNTS_INIT;
static const nm_mpi_report report_init = NM_MPI_REPORT_INIT;
extern int used;
int used = (int)(sizeof counts_init + sizeof report_init);
";

#[test]
fn the_header_compiles_as_c99() {
    compiles("header.c", &["-std=c99", "-Wpedantic"], UNIT);
}

/// Compiles without the bindings for C++ that Open MPI and MPICH have in their headers, with
/// warnings of their own.
#[test]
fn the_header_compiles_as_cpp17() {
    compiles(
        "header.cpp",
        &["-x", "c++", "-std=c++17", "-DOMPI_SKIP_MPICXX", "-DMPICH_SKIP_MPICXX"],
        UNIT,
    );
}
