//! A run of the program, from the file of points to that of the mesh.

use crate::arguments::Arguments;
use crate::exit_code::{ExitCode, Failure};
use crate::summary::{self, Times};
use netmesh::Error;
use netmesh_mpi::certificate::Report;
use netmesh_mpi::comm::{Communicator, agreed};
use netmesh_mpi::{input, output, validate};
use std::fs;
use std::path::Path;
use std::time::Instant;

/// Level of the certificate: topology, geometry and the paper's promises.
const LEVEL: u32 = 3;

/// Runs the program. Collective: all ranks answer the same.
pub fn run(comm: &dyn Communicator, arguments: &Arguments) -> Result<(), Failure> {
    agreed(comm, || require_distinct(comm.size(), arguments))?;
    let name = |path: &Path| path.display().to_string();
    require_outputs(comm, arguments)?;
    let mut times = Times::default();
    let start = Instant::now();
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
        "the certificate is violated: level {} of {LEVEL} holds, {} violations, the first: {} \
         (rank {})",
        report.level, report.violations, first.message, first.rank
    );
    Err(Failure::new(ExitCode::CertificateViolated, message))
}

/// Refuses outputs that cannot be written, before anything is read. Collective.
fn require_outputs(comm: &dyn Communicator, arguments: &Arguments) -> Result<(), Failure> {
    let failure = |path: &Path, error| Failure::writing(&path.display().to_string(), &error);
    if let Some(path) = &arguments.output {
        output::require_writable(comm, path, arguments.output_format())
            .map_err(|error| failure(path, error))?;
    }
    if let Some(path) = &arguments.work {
        output::require_writable_file(comm, path).map_err(|error| failure(path, error))?;
    }
    Ok(())
}

/// Refuses outputs that are the input or each other.
fn require_distinct(ranks: usize, arguments: &Arguments) -> netmesh::Result<()> {
    let refused = |path: &Path, why: &str| {
        let message = format!("{}: {why}", path.display());
        Err(Error::invalid(message))
    };
    let (input, work) = (&arguments.input, arguments.work.as_deref());
    let files = match &arguments.output {
        Some(output) => output::files(output, arguments.output_format(), ranks)?,
        None => Vec::new(),
    };
    if work.is_some_and(|work| are_same(work, input)) {
        return refused(input, "the table would replace the input");
    }
    if files.iter().any(|file| are_same(file, input)) {
        return refused(input, "the output would replace the input");
    }
    match work.filter(|work| files.iter().any(|file| are_same(file, work))) {
        Some(work) => refused(work, "both the table and the output would go here"),
        None => Ok(()),
    }
}

/// Returns true if the names, links too, are of one file, which need not be there yet.
fn are_same(a: &Path, b: &Path) -> bool {
    let place = |path: &Path| {
        let target = netmesh::io::follow_links(path).unwrap_or_else(|_| path.to_owned());
        let directory = target.parent().filter(|parent| *parent != Path::new(""));
        let directory = fs::canonicalize(directory.unwrap_or(Path::new("."))).ok();
        directory.zip(target.file_name().map(ToOwned::to_owned))
    };
    place(a).zip(place(b)).is_some_and(|(a, b)| a == b)
}
