//! Names the shared library by its ABI: a program that was linked with one ABI version never starts
//! with another. Other systems than those with ELF libraries get no name from here.

use std::path::Path;

fn main() {
    let header = Path::new(env!("CARGO_MANIFEST_DIR")).join("include/netmesh.h");
    println!("cargo:rerun-if-changed={}", header.display());
    let target = std::env::var("CARGO_CFG_TARGET_OS").unwrap_or_default();
    if matches!(target.as_str(), "linux" | "freebsd" | "netbsd" | "openbsd" | "dragonfly") {
        let abi = abi_version(&std::fs::read_to_string(&header).expect("the header can be read"));
        println!("cargo:rustc-cdylib-link-arg=-Wl,-soname,libnetmesh.so.{abi}");
    }
}

/// The header's `NM_ABI_VERSION`, which a test holds against the library's own.
fn abi_version(header: &str) -> u32 {
    let line = header.lines().find_map(|line| line.strip_prefix("#define NM_ABI_VERSION "));
    line.and_then(|value| value.trim().parse().ok()).expect("the header says its NM_ABI_VERSION")
}
