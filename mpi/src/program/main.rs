//! `netmesh-mpi`: each rank reads its part of a file of points, all write their parts of the mesh.

#![forbid(unsafe_code)]

mod arguments;
// The numbers and their meanings are those of the program for one process.
#[allow(dead_code)]
#[path = "../../../cli/src/exit_code.rs"]
mod exit_code;
mod session;
mod summary;
#[path = "../../../cli/src/whole.rs"]
mod whole;
#[allow(dead_code)]
#[path = "../../../cli/src/words.rs"]
mod words;

use arguments::Arguments;
use clap::Parser;
use exit_code::{ExitCode, Failure};
use netmesh::capi::shared::Environment;
use netmesh_mpi::comm::mpi::{Ranks, begin, end};
use netmesh_mpi::comm::{Collective, Communicator};
use std::io::Write;

fn main() -> std::process::ExitCode {
    let code = match begin().and_then(|()| Ranks::of_world()) {
        // What MPI has loaded may have set flush-to-zero.
        Ok(ranks) => Environment::DEFAULT
            .run(|| run(&Collective::in_words(ranks, words::in_options))),
        Err(error) => {
            let _ = writeln!(std::io::stderr(), "netmesh-mpi: {error}");
            ExitCode::Other as u8
        }
    };
    let _ = end();
    std::process::ExitCode::from(code)
}

/// Only rank 0 has anything to say.
fn run(comm: &dyn Communicator) -> u8 {
    let speaks = comm.rank() == 0;
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(refusal) => {
            if speaks {
                let _ = refusal.print();
            }
            return refusal.exit_code() as u8;
        }
    };
    match session::run(comm, &arguments) {
        Ok(()) => ExitCode::Success as u8,
        Err(Failure { code, message }) => {
            if speaks {
                let _ = writeln!(std::io::stderr(), "netmesh-mpi: {message}");
            }
            code as u8
        }
    }
}
