//! The machine's C and C++ compilers, for the tests that need one.

use std::path::PathBuf;
use std::process::{Command, Output};

/// The languages of the two headers.
#[derive(Clone, Copy, Debug)]
pub enum Language {
    C99,
    Cpp17,
}

/// A strict compiler command, or why there is none.
pub fn strict_compiler(language: Language) -> Result<Command, String> {
    let host = host_triple();
    let tool = cc::Build::new()
        .cpp(matches!(language, Language::Cpp17))
        .opt_level(1)
        .host(&host)
        .target(&host)
        .cargo_metadata(false)
        .try_get_compiler()
        .map_err(|error| format!("no compiler for {language:?}: {error}"))?;
    if tool.is_like_msvc() {
        return Err("MSVC has other flags; cpp_tests builds with it".to_owned());
    }
    let mut command = tool.to_command();
    let version = tool.to_command().arg("--version").output();
    if !version.is_ok_and(|output| output.status.success()) {
        return Err(format!("no compiler for {language:?}: {command:?} does not run"));
    }
    command.args(match language {
        Language::C99 => ["-std=c99", "-x", "c"],
        Language::Cpp17 => ["-std=c++17", "-x", "c++"],
    });
    command.args(["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror"]);
    command.arg("-I").arg(root().join("include"));
    Ok(command)
}

/// The repository.
pub fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Runs `command` and shows what it printed if it failed.
pub fn run(command: &mut Command) -> Output {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let (out, err) = (text(&output.stdout), text(&output.stderr));
    assert!(output.status.success(), "{command:?}: {}\n{out}{err}", output.status);
    output
}

pub fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Says on the test's output why it does nothing.
pub fn skip(reason: &str) {
    println!("skipped: {reason}");
}

/// Outside build scripts, `cc` has to be told the triple.
fn host_triple() -> String {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let verbose = text(&run(Command::new(rustc).arg("-vV")).stdout);
    let host = verbose.lines().find_map(|line| line.strip_prefix("host: "));
    host.expect("rustc names its host").to_owned()
}
