//! Keeps the header's version the package's, and names the shared library by its ABI: a program
//! that was linked with one ABI version never starts with another. Other systems than those with
//! ELF libraries get no name from here.

use std::io;
use std::path::{Path, PathBuf};

const VERSION_PARTS: [&str; 3] = ["MAJOR", "MINOR", "PATCH"];

fn main() {
    let path = Path::new(&variable("CARGO_MANIFEST_DIR")).join("include/netmesh.h");
    println!("cargo:rerun-if-changed={}", path.display());
    let mut header = std::fs::read_to_string(&path).expect("the header can be read");
    if set_version(&mut header) {
        replace(&path, &header);
    }
    let target = variable("CARGO_CFG_TARGET_OS");
    if matches!(target.as_str(), "linux" | "freebsd" | "netbsd" | "openbsd" | "dragonfly") {
        let abi = define(&header, "NM_ABI_VERSION");
        let name = format!("libnetmesh.so.{abi}");
        println!("cargo:rustc-cdylib-link-arg=-Wl,-soname,{name}");
        link_by_abi(&name);
    }
}

/// A link `name` beside the library in cargo's directories: a program that was linked there asks
/// for `name` when it starts. Where cargo's directories are laid out otherwise, or links cannot be
/// made, the library stands without it: docs/install.md says what to do then.
fn link_by_abi(name: &str) {
    let out = PathBuf::from(variable("OUT_DIR"));
    // <profile>/build/<package>/out
    let Some(profile) = out.ancestors().nth(3) else { return };
    if out.ancestors().nth(2).and_then(Path::file_name) != Some("build".as_ref()) {
        return;
    }
    for directory in [profile.to_owned(), profile.join("deps")] {
        if let Err(error) = make_link(&directory.join(name)) {
            println!("cargo:warning={}: no link {name}: {error}", directory.display());
        }
    }
}

#[cfg(unix)]
fn make_link(link: &Path) -> io::Result<()> {
    let target = Path::new("libnetmesh.so");
    let is_made = || std::fs::read_link(link).is_ok_and(|found| found == target);
    if is_made() {
        return Ok(());
    }
    match std::os::unix::fs::symlink(target, link) {
        // Another build of the same directory was faster.
        Err(_) if is_made() => Ok(()),
        result => result,
    }
}

#[cfg(not(unix))]
fn make_link(_: &Path) -> io::Result<()> {
    Ok(())
}

fn variable(name: &str) -> String {
    std::env::var(name).unwrap_or_else(|_| panic!("cargo sets {name}"))
}

/// Writes the package's version into the header's NM_VERSION_*, as cargo itself writes it into
/// Cargo.lock; says whether that changed anything, which it does only after Cargo.toml's version or
/// the header did.
fn set_version(header: &mut String) -> bool {
    let mut changed = false;
    for part in VERSION_PARTS {
        let name = format!("NM_VERSION_{part}");
        let value = variable(&format!("CARGO_PKG_VERSION_{part}"));
        let found = define(header, &name);
        if found != value {
            let line = format!("#define {name} ");
            *header = header.replacen(&format!("{line}{found}"), &format!("{line}{value}"), 1);
            changed = true;
        }
    }
    changed
}

/// What the header defines `name` as.
fn define(header: &str, name: &str) -> String {
    let start = format!("#define {name} ");
    let value = header.lines().find_map(|line| line.strip_prefix(&start));
    value.unwrap_or_else(|| panic!("the header defines {name}")).trim().to_owned()
}

/// At once, for a compiler that reads the header meanwhile.
fn replace(path: &Path, text: &str) {
    let beside = path.with_extension(format!("h.{}", std::process::id()));
    std::fs::write(&beside, text)
        .and_then(|()| std::fs::rename(&beside, path))
        .expect("the header can be written: its version must become the package's");
}
