//! The man page `cli/netmesh.1.in`, and in the same way `mpi/netmesh-mpi.1.in`, made of the
//! definition of the command line. It is checked in, so that who builds the program needs neither
//! clap_mangen nor to run it (the build may be for another machine); the build puts the version
//! in. After a change of the options,
//!
//!     NETMESH_WRITE_MANUAL=1 cargo test --package netmesh-cli manual
//!     NETMESH_WRITE_MANUAL=1 cargo test --package netmesh-mpi manual
//!
//! write them anew.

use crate::arguments::{Arguments, EXAMPLES};
use crate::exit_code;
use clap::CommandFactory;
use clap_mangen::Man;
use clap_mangen::roff::{Roff, bold, italic, roman};
use std::io::Write;
use std::path::Path;

/// Replaced by CMake.
const VERSION: &str = "@PROJECT_VERSION@";

fn manual() -> String {
    let command = Arguments::command().version(VERSION).after_help("");
    // A blank for the date, which would otherwise be left out and its place taken by the next.
    let man = Man::new(command).date(" ").manual("User Commands");
    [
        part(&man, Man::render_title),
        part(&man, Man::render_name_section),
        synopsis(),
        part(&man, Man::render_description_section),
        part(&man, Man::render_options_section),
        verbatim("EXAMPLES", EXAMPLES),
        verbatim("EXIT STATUS", exit_code::HELP),
    ]
    .concat()
}

fn part(man: &Man, render: fn(&Man, &mut dyn Write) -> std::io::Result<()>) -> String {
    let mut text = Vec::new();
    render(man, &mut text).expect("a vector takes everything");
    String::from_utf8(text).expect("the page is text")
}

/// Returns a short synopsis, where clap_mangen would list every option.
fn synopsis() -> String {
    let mut section = Roff::new();
    let name = Arguments::command().get_name().to_owned();
    let words = [bold(name), roman(" ["), italic("OPTIONS"), roman("] "), italic("INPUT")];
    section.control("SH", ["SYNOPSIS"]).text(words).to_roff()
}

/// Returns a part of `--help` as a section of its own; its first line is the heading there.
fn verbatim(heading: &str, help: &str) -> String {
    let mut section = Roff::new();
    section.control("SH", [heading]).control("nf", []);
    for line in help.lines().skip(1) {
        section.text([roman(line)]);
    }
    section.control("fi", []).to_roff()
}

#[test]
fn the_manual_is_what_the_arguments_make() {
    let name = format!("{}.1.in", Arguments::command().get_name());
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(&name);
    if std::env::var_os("NETMESH_WRITE_MANUAL").is_some() {
        std::fs::write(&path, manual()).expect("the page can be written");
    }
    let page = std::fs::read_to_string(&path).expect("the page is there").replace('\r', "");
    assert!(
        page == manual(),
        "{name} is not the page of these options; cli/src/manual.rs tells how"
    );
}
