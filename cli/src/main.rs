//! `netmesh`: points in, quality Delaunay mesh out.

#![forbid(unsafe_code)]

mod alpha_shape;
mod arguments;
mod certificate;
mod choices;
mod diagnosis;
mod exit_code;
mod filtration;
mod histograms;
mod holes;
mod input;
mod interruption;
#[cfg(test)]
mod manual;
mod merging;
mod meshing;
mod numbers;
mod origins;
mod output;
mod outside;
mod part;
mod progress;
mod record;
mod repairs;
mod same_file;
mod scan;
mod session;
mod sizes;
mod standard;
mod summary;
mod whole;
mod words;

use arguments::Arguments;
use exit_code::{ExitCode, Failure};
use std::io::Write;
use std::panic::catch_unwind;

fn main() -> std::process::ExitCode {
    let arguments = Arguments::of_command_line();
    let outcome = catch_unwind(|| session::run(&arguments)).unwrap_or_else(|_| {
        Err(Failure::new(ExitCode::Other, "the program failed; this is a defect, please report it"))
    });
    let code = match outcome {
        Ok(()) => ExitCode::Success,
        Err(failure) => {
            let _ = writeln!(std::io::stderr(), "netmesh: {}", failure.message);
            failure.code
        }
    };
    std::process::ExitCode::from(code as u8)
}
