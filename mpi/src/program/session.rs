//! A run of the program, from the file of points to that of the mesh.

use crate::arguments::Arguments;
use crate::exit_code::{ExitCode, Failure};
use crate::summary::{self, Times};
use netmesh_mpi::certificate::Report;
use netmesh_mpi::comm::Communicator;
use netmesh_mpi::{input, output, validate};
use std::path::Path;
use std::time::Instant;

/// Topology, geometry and the paper's promises.
const LEVEL: u32 = 3;

/// Collective: all ranks answer the same.
pub fn run(comm: &dyn Communicator, arguments: &Arguments) -> Result<(), Failure> {
    refuse_input_as_output(arguments)?;
    let mut times = Times::default();
    let start = Instant::now();
    let name = |path: &Path| path.display().to_string();
    let share = input::read(comm, &arguments.input, arguments.input_format())
        .map_err(|error| Failure::reading(&name(&arguments.input), &error))?;
    times.read = start.elapsed();
    let start = Instant::now();
    let mesh = netmesh_mpi::run(comm, share.dim, &share.points, &arguments.options(), None)?;
    drop(share);
    times.mesh = start.elapsed();
    if let Some(path) = &arguments.output {
        let start = Instant::now();
        output::write(comm, &mesh, path, arguments.output_format())
            .map_err(|error| Failure::writing(&name(path), &error))?;
        times.write = Some(start.elapsed());
    }
    if let Some(path) = &arguments.work {
        output::write_work(comm, &mesh, path)
            .map_err(|error| Failure::writing(&name(path), &error))?;
    }
    let mut report = None;
    if arguments.validate {
        let start = Instant::now();
        report = Some(validate(comm, &mesh, LEVEL)?);
        times.validate = Some(start.elapsed());
    }
    if !arguments.quiet {
        summary::print(comm, arguments, &mesh, report.as_ref(), &times)?;
    }
    report.as_ref().map_or(Ok(()), require)
}

/// Fails unless the certificate holds; names the first violation.
fn require(report: &Report) -> Result<(), Failure> {
    let Some(first) = &report.first else { return Ok(()) };
    let message = format!(
        "the certificate is violated: level {} of {LEVEL} holds, {} violations, the first: {} (rank {})",
        report.level, report.violations, first.message, first.rank
    );
    Err(Failure::new(ExitCode::CertificateViolated, message))
}

/// What is written for NAME.npy has other names.
fn refuse_input_as_output(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.work.as_ref() == Some(&arguments.input) {
        let message = format!("{}: the table would replace the input", arguments.input.display());
        return Err(Failure::new(ExitCode::Usage, message));
    }
    let Some(output) = &arguments.output else { return Ok(()) };
    let is_written = |extension: &str| output.with_extension(extension) == arguments.input;
    if is_written("points.npy") || is_written("simplices.npy") {
        let message = format!("{}: the output would replace the input", arguments.input.display());
        return Err(Failure::new(ExitCode::Usage, message));
    }
    Ok(())
}
