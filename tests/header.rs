//! The checked-in headers: `netmesh.h` is what cbindgen makes of `src/capi`, its constants are the
//! crate's, and both headers compile by themselves without a warning.

#[path = "c/compiler.rs"]
mod compiler;

use compiler::{Language, root, run, skip, strict_compiler, text};
use std::path::PathBuf;
use std::process::Command;

/// The version that makes the checked-in header; another one may format it differently.
const CBINDGEN: &str = "cbindgen 0.29.0";

fn header() -> String {
    // A checkout may have changed the line ends.
    std::fs::read_to_string(root().join("include/netmesh.h")).unwrap().replace('\r', "")
}

/// A fresh directory for one test.
fn scratch(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("header-{name}"));
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).unwrap();
    path
}

#[test]
fn the_header_is_what_cbindgen_makes() {
    let version = Command::new("cbindgen").arg("--version").output();
    let version = version.map(|output| text(&output.stdout)).unwrap_or_default();
    if version.trim() != CBINDGEN {
        return skip(&format!("{CBINDGEN} is not on the PATH (found {:?})", version.trim()));
    }
    let made = scratch("drift").join("netmesh.h");
    run(Command::new("cbindgen")
        .current_dir(root())
        .args(["--quiet", "--config", "cbindgen.toml", "--output"])
        .arg(&made)
        .arg("."));
    let made = std::fs::read_to_string(made).unwrap();
    for (i, (is, should)) in header().lines().zip(made.lines()).enumerate() {
        assert_eq!(
            is,
            should,
            "include/netmesh.h line {}; cbindgen.toml says how to make it",
            i + 1
        );
    }
    assert!(header() == made, "include/netmesh.h has another length than what cbindgen makes");
}

#[test]
fn the_constants_are_the_crates() {
    let header = header();
    let constant = |name: &str| {
        let line = format!("#define {name} ");
        let value = header.lines().find_map(|text| text.strip_prefix(&line));
        value.unwrap_or_else(|| panic!("{name} is missing")).to_owned()
    };
    let version =
        ["MAJOR", "MINOR", "PATCH"].map(|part| constant(&format!("NM_VERSION_{part}"))).join(".");
    assert_eq!(version, env!("CARGO_PKG_VERSION"));
    let abi = netmesh::capi::nm_abi_version();
    assert_eq!(constant("NM_ABI_VERSION"), abi.to_string());
    assert_eq!(constant("NM_MIN_DIM"), netmesh::mesh::MIN_DIM.to_string());
    assert_eq!(constant("NM_MAX_DIM"), netmesh::mesh::MAX_DIM.to_string());
    assert_eq!(constant("NM_NONE"), format!("{:#X}u", netmesh::NONE));
}

/// The ranges and defaults that the manual gives are the ones that are enforced.
#[test]
fn the_manuals_ranges_are_the_enforced_ones() {
    use netmesh::Options;
    type Set = fn(&mut Options, f64);
    let fields: [(&str, Set); 7] = [
        ("epsilon", |options, value| options.epsilon = value),
        ("delta", |options, value| options.delta = value),
        ("gamma", |options, value| options.gamma = value),
        ("yield_radius", |options, value| options.yield_radius = value),
        ("encroachment", |options, value| options.encroachment = value),
        ("cage_scale", |options, value| options.cage_scale = value),
        ("root_scale", |options, value| options.root_scale = value),
    ];
    let header = header();
    for (field, set) in fields {
        let end = header.find(&format!("    double {field};")).unwrap();
        let start = header[..end].rfind("/**").unwrap();
        let manual = header[start..end].replace("\n     *", "").replace("  ", " ");
        let message = {
            let mut options = Options::default();
            set(&mut options, -1.0);
            netmesh::netmesh::parameters::Parameters::resolve(2, &options).unwrap_err().to_string()
        };
        let range = &message[message.find('[').unwrap()..];
        assert!(manual.contains(&format!("In {range}")), "{field}: {manual}: {message}");
        let default = message.split("default ").nth(1).unwrap().split(')').next().unwrap();
        assert!(manual.contains(&format!("default {default}")), "{field}: {manual}: {message}");
    }
}

/// Compiles `lines` as a translation unit of its own.
fn compiles(name: &str, language: Language, lines: &[&str]) {
    let mut command = match strict_compiler(language) {
        Ok(command) => command,
        Err(reason) => return skip(&reason),
    };
    let directory = scratch(name);
    let source = directory.join("unit");
    std::fs::write(&source, lines.join("\n") + "\n").unwrap();
    run(command.arg("-c").arg(source).arg("-o").arg(directory.join("unit.o")));
}

#[test]
fn the_c_header_compiles_as_c99() {
    compiles("c", Language::C99, &["#include \"netmesh.h\"", "typedef nm_status unit;"]);
}

#[test]
fn the_c_header_compiles_as_cpp17() {
    compiles("cpp", Language::Cpp17, &["#include \"netmesh.h\""]);
}

#[test]
fn the_c_header_may_be_included_twice() {
    let twice = ["#include \"netmesh.h\"", "#include \"netmesh.h\"", "typedef nm_status unit;"];
    compiles("c-twice", Language::C99, &twice);
    compiles("cpp-twice", Language::Cpp17, &twice);
}

#[test]
fn the_cpp_header_compiles_alone_and_twice() {
    compiles("hpp", Language::Cpp17, &["#include \"netmesh.hpp\""]);
    compiles("hpp-twice", Language::Cpp17, &["#include \"netmesh.hpp\""; 2]);
}

/// Sizes and places of fields are the ABI: what C sees is what they were fixed to be.
#[test]
fn the_layouts_are_fixed() {
    let lines = [
        "#include <stddef.h>",
        "#include \"netmesh.h\"",
        "#define CHECK(name, condition) typedef char name[(condition) ? 1 : -1]",
        "CHECK(progress, sizeof(nm_progress) == 40 && offsetof(nm_progress, fraction) == 8);",
        "CHECK(options, sizeof(nm_options) == 104 + 2 * sizeof(void *));",
        "CHECK(threads, offsetof(nm_options, threads) == 20);",
        "CHECK(quality_bound, offsetof(nm_options, quality_bound) == 24);",
        "CHECK(seed, offsetof(nm_options, seed) == 88);",
        "CHECK(callback, offsetof(nm_options, progress) == 104);",
        "CHECK(counts, sizeof(nm_counts) == 48 && offsetof(nm_counts, domains) == 40);",
        "CHECK(domain, sizeof(nm_domain) == 16 && offsetof(nm_domain, radius) == 8);",
        "CHECK(quality, sizeof(nm_quality) == 64 && offsetof(nm_quality, precision_limited) == 56);",
        "CHECK(stats, sizeof(nm_stats) == 104 && offsetof(nm_stats, seconds) == 96);",
        "CHECK(report, sizeof(nm_report) == 200 && offsetof(nm_report, message) == 40);",
        "CHECK(enums, sizeof(nm_status) == 4 && sizeof(nm_format) == 4 && NM_PANIC == 13);",
    ];
    compiles("layout-c", Language::C99, &lines);
    compiles("layout-cpp", Language::Cpp17, &lines);
}
