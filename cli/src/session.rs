//! One call of the program: read, mesh, write, certify, report.

use crate::arguments::Arguments;
use crate::certificate;
use crate::exit_code::{ExitCode, Failure};
use crate::output;
use crate::progress::Bar;
use crate::record;
use crate::summary::{Summary, Times};
use netmesh::{Mesh, Triangulation, io, quality};
use std::io::Write;
use std::path::Path;
use std::time::Instant;

/// What stands for standard output where a file may be named.
const STANDARD_OUTPUT: &str = "-";

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    if let Some(output) = &arguments.output {
        output::require_place(output)?;
    }
    if let Some(json) = arguments.json.as_deref().filter(|&path| path != Path::new(STANDARD_OUTPUT))
    {
        output::require_place(json)?;
    }
    let mut times = Times::default();
    let mut mesh = timed(&mut times.read, || read(arguments))?;
    if let Some(output) = &arguments.output {
        output::require_format(&mesh, output, arguments.output_format())?;
    }
    timed(&mut times.mesh, || make(&mut mesh, arguments))?;
    if let Some(output) = &arguments.output {
        timed(&mut times.write, || output::write(&mesh, output, arguments.output_format()))?;
    }
    let report = match arguments.validate {
        true => Some(timed(&mut times.validate, || {
            certificate::check(mesh.inputs(), triangulation_of(&mesh)?)
        })?),
        false => None,
    };
    if !arguments.quiet || arguments.json.is_some() {
        let triangulation = triangulation_of(&mesh)?;
        let quality = timed(&mut times.measure, || quality::measure(triangulation))?;
        let summary = Summary {
            arguments,
            inputs: mesh.inputs(),
            triangulation,
            quality: &quality,
            report: report.as_ref(),
            times: &times,
        };
        tell(&summary)?;
    }
    report.map_or(Ok(()), |report| certificate::require(&report))
}

/// The summary for people, the record for programs, or both.
fn tell(summary: &Summary<'_>) -> Result<(), Failure> {
    match summary.arguments.json.as_deref() {
        Some(path) if path == Path::new(STANDARD_OUTPUT) => return print(&record::json(summary)),
        Some(path) => output::write_text(path, &record::json(summary))?,
        None => {}
    }
    if summary.arguments.quiet { Ok(()) } else { print(&summary.text()) }
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

fn triangulation_of(mesh: &Mesh) -> Result<&Triangulation, Failure> {
    mesh.triangulation()
        .ok_or_else(|| Failure::new(ExitCode::Other, "the run left no triangulation behind"))
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
