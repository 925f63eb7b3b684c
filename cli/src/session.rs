//! One call of the program: read, mesh, write, certify, report.

use crate::arguments::Arguments;
use crate::exit_code::{ExitCode, Failure};
use crate::progress::Bar;
use crate::summary::{Summary, Times};
use netmesh::validate::{Report, validate};
use netmesh::{Mesh, Triangulation, io, quality};
use std::io::Write;
use std::path::Path;
use std::time::Instant;

/// The whole certificate: topology, geometry, the paper.
const CERTIFICATE_LEVEL: u32 = 3;

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    if let Some(output) = &arguments.output {
        require_directory_of(output)?;
    }
    let mut times = Times::default();
    let mut mesh = timed(&mut times.read, || read(arguments))?;
    timed(&mut times.mesh, || make(&mut mesh, arguments))?;
    if let Some(output) = &arguments.output {
        timed(&mut times.write, || write(&mesh, output, arguments))?;
    }
    let report = match arguments.validate {
        true => Some(timed(&mut times.validate, || certify(&mesh))?),
        false => None,
    };
    if !arguments.quiet {
        let triangulation = triangulation_of(&mesh)?;
        let quality = timed(&mut times.measure, || quality::measure(triangulation));
        let summary = Summary {
            arguments,
            inputs: mesh.inputs(),
            triangulation,
            quality: &quality,
            report: report.as_ref(),
            times: &times,
        };
        print(&summary.text())?;
    }
    report.map_or(Ok(()), |report| require_clean(&report))
}

/// Fails before the work is done rather than after it.
fn require_directory_of(output: &Path) -> Result<(), Failure> {
    let refuse = |reason: &str| {
        let message = format!("{}: {reason}", output.display());
        Err(Failure::new(ExitCode::OutputNotWritable, message))
    };
    if output.is_dir() {
        return refuse("is a directory; the output must be a file");
    }
    match output.parent() {
        Some(parent) if parent != Path::new("") && !parent.is_dir() => {
            refuse("the directory for the output does not exist")
        }
        _ => Ok(()),
    }
}

fn read(arguments: &Arguments) -> Result<Mesh, Failure> {
    let path = &arguments.input;
    let reading = |error| Failure::reading(&path.display().to_string(), &error);
    let cloud = io::read_points(path, arguments.input_format()).map_err(reading)?;
    let count = cloud.coordinates.len().checked_div(cloud.dim).unwrap_or(0);
    Mesh::new(cloud.dim, count, &cloud.coordinates, 0).map_err(reading)
}

fn make(mesh: &mut Mesh, arguments: &Arguments) -> Result<(), Failure> {
    let bar = Bar::new(!arguments.quiet);
    let outcome = mesh.run(
        &arguments.options(),
        Some(&mut |progress| {
            bar.show(progress);
            true
        }),
    );
    bar.finish();
    Ok(outcome?)
}

fn write(mesh: &Mesh, output: &Path, arguments: &Arguments) -> Result<(), Failure> {
    io::write_file(mesh, output, arguments.output_format())
        .map_err(|error| Failure::writing(&output.display().to_string(), &error))
}

fn certify(mesh: &Mesh) -> Result<Report, Failure> {
    Ok(validate(mesh.inputs(), triangulation_of(mesh)?, CERTIFICATE_LEVEL)?)
}

fn triangulation_of(mesh: &Mesh) -> Result<&Triangulation, Failure> {
    mesh.triangulation()
        .ok_or_else(|| Failure::new(ExitCode::Other, "the run left no triangulation behind"))
}

fn require_clean(report: &Report) -> Result<(), Failure> {
    if report.violations == 0 && report.level == CERTIFICATE_LEVEL {
        return Ok(());
    }
    let first = report.first.as_ref().map_or("it names no violation", |first| &first.message);
    let message = format!(
        "the certificate is violated: level {} of {CERTIFICATE_LEVEL} holds, {} violations; first: {first}",
        report.level, report.violations
    );
    Err(Failure::new(ExitCode::CertificateViolated, message))
}

/// Prints to standard output; a reader that has gone away (`netmesh ... | head`) is no failure.
fn print(text: &str) -> Result<(), Failure> {
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Failure::new(ExitCode::Other, format!("standard output: {error}")))
        }
        _ => Ok(()),
    }
}

fn timed<T>(seconds: &mut f64, work: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let result = work();
    *seconds = start.elapsed().as_secs_f64();
    result
}
