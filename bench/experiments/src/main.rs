//! The paper's theorems as measured curves, against SVR, the algorithm that it beats, and against
//! the meshers that people use. `run.sh` builds what this needs and calls it.

mod arguments;
mod degrees;
mod experiments;
mod inputs;
mod instruments;
mod peers;
mod random;
mod report;
mod runner;
mod simplicial;
mod table;
mod verdict;

use arguments::Arguments;
use experiments::{ALL, Context, Scale};
use report::{Report, Sections};
use std::path::Path;
use std::process::ExitCode;
use std::time::{Duration, Instant};
use table::Rows;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    if let [option, input, dim, n] = words.as_slice() {
        if option == "--memory-of" {
            return print_memory(input, dim, n);
        }
    }
    let arguments = match Arguments::parse(words.into_iter()) {
        Ok(arguments) => arguments,
        Err(message) => {
            eprintln!("{message}\n\n{}", arguments::USAGE);
            return ExitCode::from(2);
        }
    };
    let done = if arguments.from_csv { make_again(&arguments) } else { run(&arguments) };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// Prints the memory of a run; the experiment `dimensions` calls this program so, for a process of
/// its own.
fn print_memory(input: &str, dim: &str, n: &str) -> ExitCode {
    let (Ok(dim), Ok(n)) = (dim.parse(), n.parse()) else { return ExitCode::from(2) };
    match experiments::added_memory(input, dim, n) {
        Some(bytes) => {
            println!("{bytes}");
            ExitCode::SUCCESS
        }
        None => ExitCode::FAILURE,
    }
}

fn run(arguments: &Arguments) -> std::io::Result<()> {
    let context = context(arguments);
    for folder in [Some(&arguments.scratch), arguments.output.as_ref()].into_iter().flatten() {
        std::fs::create_dir_all(folder)?;
    }
    for name in &arguments.names {
        let experiment = ALL.iter().find(|e| e.name == *name).expect("names are those of ALL");
        let begun = Instant::now();
        let report = (experiment.run)(&context);
        // On standard error, so that the same figures give the same output.
        eprintln!("{name}: {:.0} s", begun.elapsed().as_secs_f64());
        println!("{}", report.section("."));
        write(arguments, &report)?;
    }
    Ok(())
}

/// Makes verdicts again from the tables that are there.
fn make_again(arguments: &Arguments) -> std::io::Result<()> {
    let Some(output) = &arguments.output else { return Ok(()) };
    for name in &arguments.names {
        let experiment = ALL.iter().find(|e| e.name == *name).expect("names are those of ALL");
        let path = output.join(format!("{name}.csv"));
        let rows = Rows::parse(&std::fs::read_to_string(&path)?).ok_or_else(|| {
            std::io::Error::other(format!("{}: the rows differ in length", path.display()))
        })?;
        if let Some(report) = experiment.again {
            write(arguments, &report(&rows))?;
        }
    }
    Ok(())
}

fn context(arguments: &Arguments) -> Context {
    for (missing, what) in [
        (arguments.peers.is_none(), "TetGen, CGAL (no --peers)"),
        (arguments.triangle.is_none(), "Triangle (no --triangle)"),
    ] {
        if missing {
            eprintln!("skipped: {what}");
        }
    }
    Context {
        scale: arguments.scale,
        jobs: arguments.jobs,
        peers: peers::Peers {
            program: arguments.peers.clone(),
            triangle: arguments.triangle.clone(),
            scratch: arguments.scratch.clone(),
            limit: Duration::from_secs(if arguments.scale == Scale::Tiny { 5 } else { 30 }),
        },
    }
}

/// After each experiment, so that one that fails does not take the others' figures with it.
fn write(arguments: &Arguments, report: &Report) -> std::io::Result<()> {
    let Some(output) = &arguments.output else { return Ok(()) };
    report.write_files(output)?;
    let Some(document) = &arguments.document else { return Ok(()) };
    let old = if document.exists() { std::fs::read_to_string(document)? } else { String::new() };
    let mut sections = Sections::of(&old);
    sections.replace(report.name, report.section(&link(output, document)));
    let names: Vec<&str> = ALL.iter().map(|experiment| experiment.name).collect();
    std::fs::write(document, sections.document(&introduction(arguments.scale), &names))
}

/// The path from the document to the folder of tables and pictures, which is the document's own
/// folder or one beside it.
fn link(output: &Path, document: &Path) -> String {
    if document.parent() == Some(output) {
        return ".".into();
    }
    output.file_name().map_or(".".into(), |name| name.to_string_lossy().into_owned())
}

fn introduction(scale: Scale) -> String {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let plural = if cores == 1 { "" } else { "s" };
    let quick = if scale == Scale::Full { "" } else { " --quick" };
    format!(
        "# Experiments\n\n\
         Written by `bench/experiments/run.sh --write{quick}`; do not edit. What the paper proves, \
         measured, with a verdict on each target that is computed from the figures.\n\n\
         n is the number of inputs and m that of the mesh's vertices, those of cages and of the \
         root's cage included. A touch is one uninserted input considered for one ball (the \
         paper's Definition 9). SVR is Sparse Voronoi Refinement, the algorithm that NETMESH \
         beats; the library has it as `NM_ALGORITHM_SVR`.\n\n\
         The machine: {cores} core{plural}, of which timed runs use one, one at a time, and the \
         others two. It has other work to do: seconds are the least of alternating runs where the \
         text does not say otherwise, and counts are exact.\n"
    )
}
