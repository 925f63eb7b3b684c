//! One call of the program: read, mesh, write, certify, report.

use crate::alpha_shape;
use crate::arguments::{Arguments, Product};
use crate::certificate;
use crate::diagnosis;
use crate::exit_code::{ExitCode, Failure};
use crate::filtration;
use crate::histograms::Histograms;
use crate::input::{self, Input};
use crate::interruption;
use crate::merging;
use crate::origins::{InFiles, Origins};
use crate::output;
use crate::outside::Outside;
use crate::part;
use crate::progress::Display;
use crate::record;
use crate::repairs;
use crate::same_file;
use crate::scan;
use crate::sizes;
use crate::standard;
use crate::summary::{Summary, Times};
use crate::words::CommandLine;
use netmesh::io::Data;
use netmesh::prepared::Prepared;
use netmesh::quality::Measures;
use netmesh::surface::SurfaceKind;
use netmesh::{Extent, Mesh, Triangulation, quality};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    check_paths(arguments)?;
    let files = files_to_write(arguments)?;
    interruption::clean_up_after([&*files, &same_file::all_parts(arguments)?].concat());
    output::require_writable(&files)?;
    let display = Display::new(!arguments.quiet);
    let mut times = Times::default();
    let mut input = {
        let _stage = display.stage("reading");
        timed(&mut times.read, || input::read(arguments))?
    };
    if arguments.surface {
        scan::require_dimension(&input.mesh)?;
    }
    let repairs = repairs::repair(&mut input, arguments)?;
    let Input { mut mesh, further, origins, .. } = input;
    if let Some(path) = &arguments.diagnose {
        let _stage = display.stage("diagnosing");
        return print(&diagnosis::text(&mesh, &origins, &repairs, path, arguments)?);
    }
    if let Some(path) = &arguments.size_files.sizes {
        sizes::set(&mut mesh, path)?;
    }
    if let Some(path) = &arguments.size_files.background {
        sizes::set_background(&mut mesh, path)?;
    }
    if let Some(output) = &arguments.output {
        require_output_format(&mesh, output, arguments)?;
        require_parts(&mesh, arguments)?;
    }
    let scan = timed(&mut times.mesh, || make(&mut mesh, &origins, arguments, &display))?;
    let measures = timed(&mut times.measure, || measure(&mesh, arguments, &display))?;
    let alpha_shape = timed(&mut times.write, || {
        write(&mesh, scan.as_ref(), measures.as_ref(), arguments, &display)
    })?;
    let quality = measures.map(|measures| measures.quality);
    let report = match arguments.validate {
        true => Some({
            let _stage = display.stage("certifying");
            timed(&mut times.validate, || match &scan {
                Some(found) if arguments.product() == Product::Surface => {
                    certificate::check_surface(&mesh, &found.surface)
                }
                _ => certificate::check(&mesh),
            })?
        }),
        false => None,
    };
    if let Some(quality) = &quality {
        let triangulation = triangulation_of(&mesh)?;
        let histograms = match arguments.histogram {
            true => Some(Histograms::of(triangulation)?),
            false => None,
        };
        let summary = Summary {
            arguments,
            mesh: &mesh,
            inputs: mesh.inputs(),
            left_out: mesh.left_out(),
            outside: Outside::of(triangulation),
            further: &further,
            repairs: &repairs,
            attributes: mesh.attributes(),
            triangulation,
            quality,
            alpha_shape: alpha_shape.as_ref(),
            scan: scan.as_ref(),
            histograms: histograms.as_ref(),
            report: report.as_ref(),
            times: &times,
        };
        tell(&summary)?;
    }
    report.map_or(Ok(()), |report| certificate::require(&report))
}

/// Refuses what can be seen to be wrong before anything is read.
fn check_paths(arguments: &Arguments) -> Result<(), Failure> {
    input::require_format(arguments)?;
    let output = arguments.output.as_deref();
    match arguments.product() {
        Product::AlphaShape(_) => alpha_shape::require(arguments, "--alpha-shape", output)?,
        Product::Surface => alpha_shape::require(arguments, "--surface", output)?,
        _ if arguments.volume => alpha_shape::require(arguments, "--surface", None)?,
        _ => {}
    }
    if let Some(output) = &arguments.output {
        output::require_place(output)?;
        match arguments.product() {
            Product::Mesh => output::require_stream_format(output, arguments.output_format())?,
            Product::Filtration(_) => filtration::require(arguments, output)?,
            Product::AlphaShape(_) | Product::Surface => {}
        }
        if arguments.attributes.is_some() {
            output::require_attributes(output, arguments.output_format())?;
        }
    }
    for path in arguments.json.iter().chain(&arguments.diagnose) {
        output::require_place(path)?;
    }
    if let Some(path) = &arguments.diagnose {
        diagnosis::require(path, arguments)?;
    }
    same_file::require_distinct(arguments)
}

fn files_to_write(arguments: &Arguments) -> Result<Vec<PathBuf>, Failure> {
    let mut files = same_file::outputs(arguments)?;
    files.extend(arguments.json.iter().chain(&arguments.diagnose).cloned());
    files.retain(|path| !standard::is_meant(path));
    Ok(files)
}

/// Refuses the files that only segments and facets make, or a boundary like theirs, if they cannot
/// be written or are the input.
fn require_parts(mesh: &Mesh, arguments: &Arguments) -> Result<(), Failure> {
    let is_bounded = matches!(arguments.options().extent, Extent::Hull | Extent::Box);
    match mesh.segments().count() + mesh.given_facets().count() {
        0 if !is_bounded => Ok(()),
        _ => {
            let parts = same_file::parts(arguments, mesh.inputs().dim())?;
            same_file::require_distinct_parts(&parts, arguments)?;
            output::require_writable(&parts)
        }
    }
}

fn require_output_format(mesh: &Mesh, output: &Path, arguments: &Arguments) -> Result<(), Failure> {
    let required = match arguments.product() {
        Product::Mesh => output::require_format(mesh, output, arguments.output_format()),
        Product::Filtration(_) | Product::Surface => Ok(()),
        Product::AlphaShape(_) => alpha_shape::require_dimension(mesh, output),
    };
    required.map_err(|failure| match mesh.inputs().dim() {
        2 | 3 => failure,
        _ => input::with_hint(failure, arguments),
    })
}

/// Writes the summary for people, the record for programs, or both.
fn tell(summary: &Summary<'_>) -> Result<(), Failure> {
    match summary.arguments.json.as_deref() {
        Some(path) if standard::is_meant(path) => return print(&record::json(summary)),
        Some(path) => output::write_text(path, &record::json(summary))?,
        None => {}
    }
    match summary.arguments.output.as_deref() {
        _ if summary.arguments.quiet => Ok(()),
        // Standard output has the mesh.
        Some(path) if standard::is_meant(path) => {
            // Nobody is left to tell of a failure there.
            let _ = std::io::stderr().write_all(summary.text().as_bytes());
            Ok(())
        }
        _ => print(&summary.text()),
    }
}

/// Makes the mesh, and the surface if one is asked for.
fn make(
    mesh: &mut Mesh,
    origins: &Origins,
    arguments: &Arguments,
    display: &Display,
) -> Result<Option<scan::Found>, Failure> {
    let enclosed = match arguments.volume {
        true => {
            let _stage = display.stage("surface");
            Some(scan::replace(mesh, arguments.meshing.options.threads)?)
        }
        false => None,
    };
    make_mesh(mesh, origins, arguments, display)?;
    if arguments.product() == Product::Surface {
        let _stage = display.stage("surface");
        let kind = if arguments.open { SurfaceKind::Open } else { SurfaceKind::Closed };
        return scan::find(mesh, kind).map(Some);
    }
    Ok(enclosed)
}

fn make_mesh(
    mesh: &mut Mesh,
    origins: &Origins,
    arguments: &Arguments,
    display: &Display,
) -> Result<(), Failure> {
    let stage = display.meshing();
    let options = part::options(arguments, mesh);
    let outcome = mesh.run(
        &options,
        Some(&mut |progress| {
            stage.show(progress);
            true
        }),
    );
    let name = input::names(arguments);
    let words = CommandLine { regions: mesh.regions(), delaunay: arguments.delaunay_option() };
    let words = InFiles { words, origins };
    outcome.map_err(|error| {
        let failure = Failure::of_run(&name, &error, words);
        let is_refused = failure.code == ExitCode::InputRefused;
        match merging::suspicion(mesh, arguments).filter(|_| is_refused) {
            Some(more) => Failure::new(failure.code, format!("{}; {more}", failure.message)),
            None => failure,
        }
    })
}

/// Measures the mesh if a summary or a record is going to tell of it: before the file is written,
/// which may have the same measures.
fn measure(
    mesh: &Mesh,
    arguments: &Arguments,
    display: &Display,
) -> Result<Option<Measures>, Failure> {
    if arguments.quiet && arguments.json.is_none() {
        return Ok(None);
    }
    let _stage = display.stage("measuring");
    let triangulation = triangulation_of(mesh)?;
    Ok(Some(match output::needs_measures(arguments) {
        true => Measures::of(triangulation)?,
        false => Measures { quality: quality::measure(triangulation)?, ..Measures::default() },
    }))
}

/// Writes what was asked for.
fn write(
    mesh: &Mesh,
    scan: Option<&scan::Found>,
    measures: Option<&Measures>,
    arguments: &Arguments,
    display: &Display,
) -> Result<Option<alpha_shape::Measured>, Failure> {
    let (output, threads) = (arguments.output.as_deref(), arguments.meshing.options.threads);
    match (arguments.product(), output) {
        (Product::AlphaShape(choice), _) => {
            let _stage = display.stage("alpha shape");
            return alpha_shape::make(mesh, choice, output, threads).map(Some);
        }
        (Product::Filtration(kind), Some(output)) => {
            let _stage = display.stage("filtration");
            filtration::write(mesh, kind, output, arguments)?;
        }
        (Product::Surface, Some(output)) => {
            let _stage = display.stage("writing");
            scan.map_or(Ok(()), |found| scan::write(mesh, &found.surface, output))?;
        }
        (Product::Mesh, Some(output)) => write_mesh(mesh, measures, output, arguments, display)?,
        (_, None) => {}
    }
    Ok(None)
}

fn write_mesh(
    mesh: &Mesh,
    measures: Option<&Measures>,
    output: &Path,
    arguments: &Arguments,
    display: &Display,
) -> Result<(), Failure> {
    let prepared = Prepared::default();
    let attributes = {
        let _stage = (!mesh.attributes().is_empty()).then(|| display.stage("extending"));
        prepared.vertex_attributes(mesh)?
    };
    let _stage = display.stage("writing");
    let measures = measures.filter(|_| output::needs_measures(arguments));
    output::write(mesh, Data { attributes, measures }, output, arguments.output_format())
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
