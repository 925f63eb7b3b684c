//! The checked-in headers: `netmesh.h` is what cbindgen makes of `src/capi`, its constants are the
//! crate's, and both headers compile by themselves without a warning.

use crate::compiler::{Language, root, run, skip, strict_compiler, text};
use netmesh::options::{Kind, TABLE};
use netmesh::{Criterion, Mesh, Options};
use std::collections::HashMap;
use std::path::PathBuf;

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

/// The header as cbindgen makes it, with the package's version, which build.rs keeps in the
/// checked-in one.
fn made_header() -> String {
    let mut config = cbindgen::Config::from_file(root().join("cbindgen.toml")).unwrap();
    let enums = TABLE.iter().filter(|row| matches!(row.kind, Kind::Words(_)));
    let names = enums.map(|row| (row.type_name.to_owned(), format!("nm_{}", row.name)));
    config.export.rename.extend(names);
    let bindings = cbindgen::Builder::new()
        .with_config(config.clone())
        .with_only_target_dependencies(true)
        .with_crate(root())
        .generate()
        .unwrap();
    let mut made = Vec::new();
    bindings.write(&mut made);
    let made = in_c(&String::from_utf8(made).unwrap(), &config.export.rename);
    let defaults = defaults_of_options(&made);
    made.replace("OPTIONS_DEFAULTS", &defaults)
        .replace("CARGO_PKG_VERSION_MAJOR", env!("CARGO_PKG_VERSION_MAJOR"))
        .replace("CARGO_PKG_VERSION_MINOR", env!("CARGO_PKG_VERSION_MINOR"))
        .replace("CARGO_PKG_VERSION_PATCH", env!("CARGO_PKG_VERSION_PATCH"))
}

/// Returns the text with C's constants for links to values of the core's enums, and C's fields for
/// links to other fields.
fn in_c(text: &str, renamed: &HashMap<String, String>) -> String {
    let mut parts = text.split("[`");
    let mut result = parts.next().unwrap().to_owned();
    for part in parts {
        let (link, rest) = part.split_once("`]").unwrap();
        let (path, value) = link.rsplit_once("::").unwrap_or_else(|| panic!("a link to {link}"));
        let name = path.rsplit("::").next().unwrap();
        match renamed.get(name) {
            Some(name) => {
                result += &name.to_uppercase();
                for letter in value.chars() {
                    result += if letter.is_uppercase() { "_" } else { "" };
                    result.extend(letter.to_uppercase());
                }
            }
            None => result += &format!("nm_{}.{value}", name.to_lowercase()),
        }
        result += rest;
    }
    result
}

/// Returns the initial value of an nm_options: the defaults, in the order of its fields.
fn defaults_of_options(header: &str) -> String {
    let body = header.split_once("typedef struct nm_options {").unwrap().1;
    let fields = body.split_once("} nm_options;").unwrap().0.lines();
    let fields = fields.filter_map(|line| line.strip_suffix(';')?.trim().rsplit_once(' '));
    let value = |(kind, name): (&str, &str)| match name {
        "struct_size" => "sizeof(nm_options)".to_owned(),
        "threads" => Options::default().threads.to_string(),
        // The first value of an enum is the default.
        _ if kind.starts_with("nm_") && !kind.ends_with("_fn") => {
            let values = header.split_once(&format!("\nenum {kind}\n")).unwrap().1;
            let first = values.lines().find(|line| line.contains(" = 0,")).unwrap();
            first.trim().trim_end_matches(" = 0,").to_owned()
        }
        _ => "0".to_owned(),
    };
    let values: Vec<String> = fields.map(value).collect();
    let lines = values.chunks(4).map(|line| line.join(", "));
    format!("{{ {} }}", lines.collect::<Vec<_>>().join(", \\\n      "))
}

#[test]
fn the_header_is_what_cbindgen_makes() {
    let made = made_header();
    if std::env::var_os("NETMESH_WRITE_HEADER").is_some() {
        std::fs::write(root().join("include/netmesh.h"), &made).unwrap();
    }
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
    assert!(header.contains("\n#define NM_VERSION ("), "NM_VERSION is missing");
    let abi = netmesh::capi::nm_abi_version();
    assert_eq!(constant("NM_ABI_VERSION"), abi.to_string());
    assert_eq!(constant("NM_MIN_DIM"), netmesh::mesh::MIN_DIM.to_string());
    assert_eq!(constant("NM_MAX_DIM"), netmesh::mesh::MAX_DIM.to_string());
    assert_eq!(constant("NM_NONE"), format!("{:#X}u", netmesh::NONE));
}

/// Returns the words of a run about `options.<field>` out of its range, in each dimension that has
/// its own defaults (2, 3, 4 and more): the ranges and the defaults.
fn ranges(refuse: impl Fn(&mut Options)) -> (Vec<String>, Vec<String>) {
    let mut options = Options::default();
    refuse(&mut options);
    let message = |dim: usize| {
        let points: Vec<f64> = (0..2 * dim).map(|i| i as f64).collect();
        let mut mesh = Mesh::new(dim, 2, &points, 0).unwrap();
        mesh.run(&options, None).unwrap_err().to_string()
    };
    let messages: Vec<_> = (2..=5).map(message).collect();
    let after = |text: &str, start: &str, end: char| {
        let rest = &text[text.find(start).unwrap() + start.len()..];
        rest[..rest.find(end).unwrap()].to_owned()
    };
    let mut ranges: Vec<_> =
        messages.iter().map(|text| format!("[{}]", after(text, "[", ']'))).collect();
    let mut defaults: Vec<_> = messages.iter().map(|text| after(text, "default ", ')')).collect();
    for values in [&mut ranges, &mut defaults] {
        if values.iter().all(|value| *value == values[0]) {
            values.truncate(1);
        }
    }
    (ranges, defaults)
}

/// The ranges and defaults that the manual gives are the ones that are enforced.
#[test]
fn the_manuals_ranges_are_the_enforced_ones() {
    type Set = fn(&mut Options);
    let fields: [(&str, Set); 10] = [
        ("quality_bound", |options| options.quality_bound = -1.0),
        ("quality_bound", |options| {
            options.criterion = Criterion::RadiusEdge;
            options.quality_bound = -1.0;
        }),
        ("epsilon", |options| options.epsilon = -1.0),
        ("delta", |options| options.delta = -1.0),
        ("gamma", |options| options.gamma = -1.0),
        ("yield_radius", |options| options.yield_radius = -1.0),
        ("encroachment", |options| options.encroachment = -1.0),
        ("cage_scale", |options| options.cage_scale = -1.0),
        ("root_scale", |options| options.root_scale = -1.0),
        ("distance_ratio", |options| options.distance_ratio = -1.0),
    ];
    let header = header();
    for (field, refuse) in fields {
        let end = header.find(&format!("    double {field};")).unwrap();
        let start = header[..end].rfind("/**").unwrap();
        let manual = header[start..end].replace("\n     *", "");
        let (ranges, defaults) = ranges(refuse);
        let ranges = format!("n {}", ranges.join(", "));
        let defaults = format!("default {}", defaults.join(", "));
        for part in [ranges, defaults] {
            assert!(manual.contains(&part), "{field}: no '{part}' in {manual}");
        }
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

/// The initialisers set `struct_size` and nothing else, and no compiler has anything to say of
/// them, in a program whose own symbols are hidden too.
#[test]
fn the_initialisers_set_the_size_and_zero_the_rest() {
    let lines = [
        "#include <string.h>",
        "#include \"netmesh.h\"",
        "#if NM_VERSION != NM_VERSION_MAJOR * 10000 + NM_VERSION_MINOR * 100 + NM_VERSION_PATCH",
        "#error \"NM_VERSION is not the version\"",
        "#endif",
        "static int is_clear(const void *value, size_t size) {",
        "    const unsigned char *bytes = (const unsigned char *)value;",
        "    size_t i;",
        "    uint32_t set;",
        "    memcpy(&set, bytes, sizeof set);",
        "    for (i = sizeof set; i < size; ++i)",
        "        if (bytes[i] != 0) return 0;",
        "    return set == size;",
        "}",
        "int main(void) {",
        "    nm_counts counts = NM_COUNTS_INIT;",
        "    nm_quality quality = NM_QUALITY_INIT;",
        "    nm_stats stats = NM_STATS_INIT;",
        "    nm_report report = NM_REPORT_INIT;",
        "    nm_alpha_shape shape = NM_ALPHA_SHAPE_INIT;",
        "    nm_surface surface = NM_SURFACE_INIT;",
        "    nm_region region = NM_REGION_INIT;",
        "    nm_intersection meeting = NM_INTERSECTION_INIT;",
        "    nm_odd_edge edge = NM_ODD_EDGE_INIT;",
        "    nm_options options = NM_OPTIONS_INIT;",
        "    return !(is_clear(&counts, sizeof counts) && is_clear(&quality, sizeof quality) &&",
        "             is_clear(&stats, sizeof stats) && is_clear(&report, sizeof report) &&",
        "             is_clear(&surface, sizeof surface) &&",
        "             is_clear(&shape, sizeof shape) && is_clear(&region, sizeof region) &&",
        "             is_clear(&edge, sizeof edge) &&",
        "             meeting.struct_size == sizeof meeting && meeting.second == 0 &&",
        "             options.threads == 1 && (options.threads = 0, 1) &&",
        "             is_clear(&options, sizeof options));",
        "}",
    ];
    for language in [Language::C99, Language::Cpp17] {
        let mut command = match strict_compiler(language) {
            Ok(command) => command,
            Err(reason) => return skip(&reason),
        };
        let directory = scratch(&format!("initialisers-{language:?}"));
        let (source, program) = (directory.join("unit"), directory.join("program"));
        std::fs::write(&source, lines.join("\n") + "\n").unwrap();
        command.args(["-Wmissing-field-initializers", "-fvisibility=hidden"]);
        run(command.arg(source).arg("-o").arg(&program));
        run(&mut std::process::Command::new(program));
    }
}

/// Every function that answers a status warns where a program ignores it; no other does.
#[test]
fn an_ignored_status_is_a_warning() {
    let header = header();
    let functions = header.split("extern \"C\" {").nth(1).expect("the functions are C's");
    let declarations: Vec<_> =
        functions.split("*/\n").skip(1).filter(|text| text.contains("nm_")).collect();
    assert!(declarations.len() > 20, "{} functions", declarations.len());
    for declaration in declarations {
        let declaration = declaration.split(';').next().unwrap().replace('\n', " ");
        let status = declaration.starts_with("NM_NODISCARD NM_API nm_status nm_");
        assert!(status || declaration.starts_with("NM_API "), "{declaration}");
        assert!(status || !declaration.contains("nm_status nm_"), "{declaration}");
    }
    for language in [Language::C99, Language::Cpp17] {
        let ignoring = |call: &str| {
            let mut command = strict_compiler(language).ok()?;
            let directory = scratch(&format!("ignored-{language:?}"));
            let source = directory.join("unit");
            let unit = format!(
                "#include \"netmesh.h\"\nvoid f(nm_mesh *mesh);\n\
                 void f(nm_mesh *mesh) {{ {call}; }}\n"
            );
            std::fs::write(&source, unit).unwrap();
            command.arg("-c").arg(source).arg("-o").arg(directory.join("unit.o"));
            let output = command.output().unwrap();
            Some((output.status.success(), text(&output.stderr)))
        };
        let Some((compiled, message)) = ignoring("nm_run(mesh, NULL)") else {
            return skip(&format!("no compiler for {language:?}"));
        };
        assert!(!compiled && message.contains("unused-result"), "{message}");
        let (compiled, message) = ignoring("nm_mesh_free(mesh)").unwrap();
        assert!(compiled, "{message}");
    }
}

/// Sizes and places of fields are the ABI: what C sees is what they were fixed to be.
#[test]
fn the_layouts_are_fixed() {
    let lines = [
        "#include <stddef.h>",
        "#include \"netmesh.h\"",
        "#define CHECK(name, condition) typedef char name[(condition) ? 1 : -1]",
        "CHECK(progress, sizeof(nm_progress) == 40 && offsetof(nm_progress, fraction) == 8);",
        "CHECK(options, sizeof(nm_options) == 184 + 4 * sizeof(void *));",
        "CHECK(quality_bound, offsetof(nm_options, quality_bound) == 8);",
        "CHECK(extent, offsetof(nm_options, extent) == 36);",
        "CHECK(coplanar, offsetof(nm_options, coplanar) == 48);",
        "CHECK(labels, offsetof(nm_options, labels) == 56);",
        "CHECK(max_edge, offsetof(nm_options, max_edge) == 64);",
        "CHECK(size, offsetof(nm_options, size) == 88);",
        "CHECK(output, offsetof(nm_options, output) == 88 + 2 * sizeof(void *));",
        "CHECK(seed, offsetof(nm_options, seed) == 104 + 2 * sizeof(void *));",
        "CHECK(callback, offsetof(nm_options, progress) == 120 + 2 * sizeof(void *));",
        "CHECK(ordering, offsetof(nm_options, ordering) == 120 + 4 * sizeof(void *));",
        "CHECK(root_scale, offsetof(nm_options, root_scale) == 176 + 4 * sizeof(void *));",
        "CHECK(counts, sizeof(nm_counts) == 64 && offsetof(nm_counts, domains) == 40);",
        "CHECK(left_out, sizeof(nm_left_out) == 32 && offsetof(nm_left_out, edges) == 8);",
        "CHECK(domain, sizeof(nm_domain) == 16 && offsetof(nm_domain, radius) == 8);",
        "CHECK(quality, sizeof(nm_quality) == 120);",
        "CHECK(limited, offsetof(nm_quality, precision_limited) == 56);",
        "CHECK(stats, sizeof(nm_stats) == 248 && offsetof(nm_stats, seconds) == 96);",
        "CHECK(measured, offsetof(nm_stats, ply_probes) == 176);",
        "CHECK(insertion, offsetof(nm_stats, insertion_constant_cage) == 240);",
        "CHECK(report, sizeof(nm_report) == 200 && offsetof(nm_report, message) == 40);",
        "CHECK(shape, sizeof(nm_alpha_shape) == 136 && offsetof(nm_alpha_shape, betti) == 40);",
        "CHECK(surface, sizeof(nm_surface) == 80 && offsetof(nm_surface, facets) == 16);",
        "CHECK(region, sizeof(nm_region) == 48 && offsetof(nm_region, is_hole) == 40);",
        "CHECK(meeting, sizeof(nm_intersection) == 48 && offsetof(nm_intersection, point) == 24);",
        "CHECK(odd, sizeof(nm_odd_edge) == 20 && offsetof(nm_odd_edge, facets) == 16);",
        "CHECK(kind, sizeof(nm_violation) == 4 && offsetof(nm_report, kind) == 24);",
        "CHECK(enums, sizeof(nm_status) == 4 && sizeof(nm_format) == 4 && NM_PANIC == 13);",
    ];
    compiles("layout-c", Language::C99, &lines);
    compiles("layout-cpp", Language::Cpp17, &lines);
}
