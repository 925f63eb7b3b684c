//! The C ABI from outside: C and C++ programs linked with this crate's own library, and threads.

use crate::compiler::{Language, root, run, skip, strict_compiler, text};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Way in which a program gets the library.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Link {
    Static,
    Shared,
}

/// Returns the directory of what cargo builds for this test: that of the test itself.
fn built() -> PathBuf {
    std::env::current_exe().unwrap().parent().unwrap().to_owned()
}

/// The library, which cargo builds with the test; built now where some cargo does not.
fn library(link: Link) -> PathBuf {
    let name = match link {
        Link::Static => "libnetmesh.a".to_owned(),
        Link::Shared => format!("libnetmesh{}", std::env::consts::DLL_SUFFIX),
    };
    let path = built().join(&name);
    if path.exists() {
        return path;
    }
    let profile_directory = built().parent().unwrap().to_owned();
    let profile = match profile_directory.file_name().unwrap().to_str().unwrap() {
        "debug" => "dev".to_owned(),
        other => other.to_owned(),
    };
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    run(Command::new(cargo)
        .current_dir(root())
        .args(["build", "--package", "netmesh", "--lib", "--profile", &profile, "--target-dir"])
        .arg(profile_directory.parent().unwrap()));
    profile_directory.join(name)
}

/// Compiles `source` against the library, with nothing beside it but what cargo has left there: the
/// name that a program asks for when it starts is a link that build.rs makes. `None` where that
/// cannot be done here.
fn program(language: Language, source: &str, link: Link) -> Option<PathBuf> {
    if !cfg!(unix) {
        skip("the link line is a Unix one; cpp_tests links on other systems");
        return None;
    }
    let mut command = match strict_compiler(language) {
        Ok(command) => command,
        Err(reason) => {
            skip(&reason);
            return None;
        }
    };
    let library = library(link);
    let name = Path::new(source).file_stem().unwrap().to_str().unwrap();
    let made = directory(&format!("{name}-{language:?}-{link:?}")).join(name);
    command.arg(root().join(source)).args(["-x", "none"]).arg(&library);
    if link == Link::Shared {
        command.arg(format!("-Wl,-rpath,{}", library.parent().unwrap().display()));
    }
    if cfg!(target_os = "linux") {
        command.args(["-lpthread", "-ldl"]);
    }
    run(command.arg("-lm").arg("-o").arg(&made));
    Some(made)
}

/// A fresh directory.
fn directory(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("c-api-{name}"));
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).unwrap();
    path
}

/// Runs a test program, which gets a directory of its own and must print `last`.
fn passes(language: Language, source: &str, link: Link, last: &str) {
    let Some(program) = program(language, source, link) else { return };
    let output = run(Command::new(&program).arg(program.parent().unwrap()));
    assert_eq!(text(&output.stdout).lines().last(), Some(last));
    assert!(output.stderr.is_empty(), "the library prints nothing: {}", text(&output.stderr));
}

/// Runs an example and looks at what it wrote.
fn example(language: Language, source: &str, link: Link) {
    let Some(program) = program(language, source, link) else { return };
    let mesh = program.with_file_name("mesh.vtu");
    let output = text(&run(Command::new(&program).arg(&mesh)).stdout);
    assert!(output.contains("certificate: level 3 of 3"), "{output}");
    let written = std::fs::read(&mesh).unwrap();
    assert!(text(&written[..written.len().min(500)]).contains("UnstructuredGrid"));
}

#[test]
fn the_c_example_runs() {
    example(Language::C99, "examples/c/mesh_points.c", Link::Shared);
}

#[test]
fn the_c_example_runs_linked_statically() {
    example(Language::C99, "examples/c/mesh_points.c", Link::Static);
}

#[test]
fn the_cpp_example_runs() {
    example(Language::Cpp17, "examples/cpp/mesh_points.cpp", Link::Shared);
}

#[test]
fn misuse_is_refused() {
    passes(Language::C99, "tests/c/misuse.c", Link::Shared, "all misuse was refused");
}

#[test]
fn the_callers_environment_does_not_matter_and_is_restored() {
    let last = match cfg!(any(target_arch = "x86_64", target_arch = "aarch64")) {
        true => "every environment made the same",
        false => "every environment is left as it is on this processor",
    };
    passes(Language::C99, "tests/c/environment.c", Link::Shared, last);
}

#[test]
fn the_cpp_wrapper_holds() {
    passes(Language::Cpp17, "tests/c/wrapper.cpp", Link::Shared, "the wrapper holds");
}
