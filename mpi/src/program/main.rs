//! `netmesh-mpi`: each rank reads its part of a file of points, all write their parts of the mesh.

#![forbid(unsafe_code)]

mod arguments;
// The numbers and their meanings are those of the program for one process.
#[allow(dead_code)]
#[path = "../../../cli/src/exit_code.rs"]
mod exit_code;
// The page is made of the options as that of the other program.
#[cfg(test)]
#[path = "../../../cli/src/manual.rs"]
mod manual;
// The library's options are arguments of both programs.
#[path = "../../../cli/src/meshing.rs"]
mod meshing;
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
use netmesh::options::Row;
use netmesh_mpi::agreement::{Arguments as Compared, require_same};
use netmesh_mpi::comm::mpi::{Ranks, begin, end};
use netmesh_mpi::comm::{Collective, Communicator};
use std::io::Write;

fn main() -> std::process::ExitCode {
    let code = match begin().and_then(|()| Ranks::of_world()) {
        // What MPI has loaded may have set flush-to-zero.
        Ok(ranks) => {
            Environment::DEFAULT.run(|| run(&Collective::in_words(ranks, words::in_options)))
        }
        Err(error) => {
            let _ = writeln!(std::io::stderr(), "netmesh-mpi: {error}");
            ExitCode::Other as u8
        }
    };
    let _ = end();
    std::process::ExitCode::from(code)
}

/// Runs the program on a rank and returns its exit code. Only rank 0 has anything to say.
fn run(comm: &dyn Communicator) -> u8 {
    let parsed = Arguments::try_parse();
    let speaks = comm.rank() == 0;
    if let Err(error) = require_same(comm, "", || Ok(compared(&parsed))) {
        return fail(speaks, &Failure::new(ExitCode::Usage, error.message()));
    }
    match parsed {
        Ok(arguments) => match session::run(comm, &arguments) {
            Ok(()) => ExitCode::Success as u8,
            Err(failure) => fail(speaks, &failure),
        },
        // The same on all ranks.
        Err(refusal) => {
            if speaks {
                let _ = refusal.print();
            }
            refusal.exit_code() as u8
        }
    }
}

fn fail(speaks: bool, Failure { code, message }: &Failure) -> u8 {
    if speaks {
        let _ = writeln!(std::io::stderr(), "netmesh-mpi: {message}");
    }
    *code as u8
}

/// Returns all that the command lines of ranks must have in common: all but their threads.
fn compared(parsed: &Result<Arguments, clap::Error>) -> Compared {
    let own = Compared::of_call("netmesh-mpi");
    match parsed {
        Ok(arguments) => {
            let mut arguments = arguments.clone();
            arguments.meshing.options.threads = 1;
            let name = |field: &str| match field {
                "input" => "INPUT".to_owned(),
                "output" => "--output".to_owned(),
                field => match Row::named(field) {
                    Some(row) => format!("--{}", row.argument()),
                    None => format!("--{}", field.replace('_', "-")),
                },
            };
            own.and("the command line", "understood").and_fields(&arguments, name)
        }
        Err(refusal) if refusal.use_stderr() => {
            let text = refusal.render().to_string();
            let reason = text.lines().next().unwrap_or_default();
            let reason = reason.strip_prefix("error: ").unwrap_or(reason);
            own.and("the command line", format!("refused ({reason})"))
        }
        Err(_) => own.and("the command line", "a question (--help, --version)"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A difference in any option is one, but for threads.
    #[test]
    fn command_lines_are_compared_by_what_they_mean() {
        let of = |line: &str| compared(&Arguments::try_parse_from(line.split_whitespace()));
        let usual = of("netmesh-mpi a.npy -o b.npy --bound 4");
        assert_eq!(usual, of("netmesh-mpi --threads 3 --quality-bound 4.0 --output b.npy a.npy"));
        for other in [
            "netmesh-mpi c.npy -o b.npy --bound 4",
            "netmesh-mpi a.npy -o b.pvtu --bound 4",
            "netmesh-mpi a.npy -o b.npy --bound 4 --output-format pvtu",
            "netmesh-mpi a.npy -o b.npy --bound 4 --validate",
            "netmesh-mpi a.npy -o b.npy --bound 4 --quiet",
            "netmesh-mpi a.npy -o b.npy --bound 4 --work w",
            "netmesh-mpi a.npy -o b.npy --bound 4 --seed 1",
            "netmesh-mpi a.npy -o b.npy --bound 4 --nothing",
            "netmesh-mpi --help",
        ] {
            assert!(of(other) != usual, "{other}");
        }
    }
}
