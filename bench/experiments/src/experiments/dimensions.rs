//! Sizes that are practical in each dimension.

use super::Context;
use crate::inputs::{self, Points};
use crate::report::Report;
use crate::row;
use crate::runner::{self, Outcome, in_parallel};
use crate::table::{Table, number};
use crate::verdict::Verdict;
use netmesh::{Mesh, Options, validate};
use std::process::Command;
use std::time::{Duration, Instant};

pub const NAME: &str = "dimensions";

struct Case {
    input: &'static str,
    dim: usize,
    n: usize,
}

struct Entry {
    case: Case,
    result: Result<Figures, String>,
}

struct Figures {
    vertices: usize,
    simplices: usize,
    seconds: f64,
    memory: Option<u64>,
    certificate_seconds: f64,
    /// Violations of the certificate's three levels.
    violations: u64,
}

pub fn run(context: &Context) -> Report {
    let runs: Vec<(Case, Result<Run, String>)> = cases(context)
        .into_iter()
        .map(|case| {
            let run = measure(context, &case);
            (case, run)
        })
        .collect();
    // Certifying takes longer than the mesh from 4D on, and is not timed for its own sake.
    let entries =
        in_parallel(context.jobs, runs, |(case, run)| Entry { case, result: run.map(certified) });
    Report {
        name: NAME,
        title: "What is practical in each dimension",
        text: text(),
        verdicts: verdicts(&entries),
        tables: vec![table(&entries)],
        pictures: Vec::new(),
    }
}

fn text() -> String {
    "Default options, hierarchical. Uniform inputs in the unit cube, and inputs on a surface: the \
     torus (cos u, sin u, cos v, sin v, cos(u + v), sin(u + v)), its first five coordinates in 5D. \
     One run each. Memory is what the run added to the process at its highest; the certificate is \
     that of all three levels."
        .to_string()
}

fn cases(context: &Context) -> Vec<Case> {
    let uniform = [
        (2, 10_000, 100_000),
        (3, 10_000, 100_000),
        (4, 3_000, 10_000),
        (5, 300, 1_000),
        (6, 300, 1_000),
    ];
    let surface = [(5, 100, 500), (6, 50, 100)];
    let of = |input: &'static str| {
        move |(dim, quick, full)| Case { input, dim, n: context.pick(8, quick, full) }
    };
    let mut cases: Vec<Case> = uniform.into_iter().map(of("uniform")).collect();
    cases.extend(surface.into_iter().map(of("surface")));
    cases
}

impl Case {
    fn points(&self) -> Points {
        points(self.input, self.dim, self.n)
    }
}

fn points(input: &str, dim: usize, n: usize) -> Points {
    match input {
        "surface" => inputs::surface(dim, n, 1),
        name => inputs::named(name, dim, n, 1),
    }
}

struct Run {
    mesh: Box<Mesh>,
    /// Bytes that the run added to what the process held.
    memory: Option<u64>,
}

fn measure(context: &Context, case: &Case) -> Result<Run, String> {
    let limit = Duration::from_secs(context.pick(20, 60, 240));
    match runner::mesh(&case.points(), &Options::default(), limit) {
        Outcome::Done(mesh) => Ok(Run { mesh, memory: memory_of(case) }),
        Outcome::Stopped(why) => Err(why.to_string()),
    }
}

/// A process of its own says it: this one has memory left over from other runs.
fn memory_of(case: &Case) -> Option<u64> {
    let output = Command::new(std::env::current_exe().ok()?)
        .args(["--memory-of", case.input, &case.dim.to_string(), &case.n.to_string()])
        .output()
        .ok()?;
    String::from_utf8(output.stdout).ok()?.trim().parse().ok()
}

/// Returns the bytes that the run adds to what the process held, for `--memory-of`.
pub fn added_memory(input: &str, dim: usize, n: usize) -> Option<u64> {
    let points = points(input, dim, n);
    let before = runner::peak_memory()?;
    let outcome = runner::mesh(&points, &Options::default(), Duration::from_secs(300));
    outcome.mesh()?;
    Some(runner::peak_memory()?.saturating_sub(before))
}

fn certified(run: Run) -> Figures {
    let mesh = run.mesh.triangulation().expect("a run that was done has a result");
    let begun = Instant::now();
    let report = validate::validate(run.mesh.inputs(), mesh, 3).unwrap_or_else(|e| panic!("{e}"));
    let certificate_seconds = begun.elapsed().as_secs_f64();
    eprintln!(
        "  {}D, {} simplices: {:.2} s, certificate {certificate_seconds:.2} s",
        mesh.dim,
        mesh.simplex_count(),
        mesh.stats.seconds
    );
    Figures {
        vertices: mesh.vertex_count(),
        simplices: mesh.simplex_count(),
        seconds: mesh.stats.seconds,
        memory: run.memory,
        certificate_seconds,
        violations: report.violations,
    }
}

fn table(entries: &[Entry]) -> Table {
    let mut table = Table::new(
        "dimensions",
        &[
            "dim",
            "input",
            "n",
            "m/n",
            "simplices/vertex",
            "seconds",
            "points/s",
            "MiB",
            "KiB/input",
            "certificate",
            "certificate seconds",
        ],
    );
    for Entry { case, result } in entries {
        let Case { input, dim, n } = case;
        table.add(match result {
            Ok(figures) => row![
                dim,
                input,
                n,
                number(figures.vertices as f64 / *n as f64),
                number(figures.simplices as f64 / figures.vertices as f64),
                number(figures.seconds),
                number(*n as f64 / figures.seconds),
                figures.memory.map_or("-".to_string(), |bytes| number(bytes as f64 / 1048576.0)),
                figures
                    .memory
                    .map_or("-".to_string(), |bytes| number(bytes as f64 / 1024.0 / *n as f64)),
                if figures.violations == 0 {
                    "holds".to_string()
                } else {
                    format!("{} violations", figures.violations)
                },
                number(figures.certificate_seconds),
            ],
            Err(why) => row![dim, input, n, "-", "-", why, "-", "-", "-", "-", "-"],
        });
    }
    table
}

fn verdicts(entries: &[Entry]) -> Vec<Verdict> {
    entries
        .iter()
        .map(|Entry { case, result }| {
            let claim = format!(
                "{} {}, {}D: ends, and the certificate holds at level 3",
                case.input, case.n, case.dim
            );
            match result {
                Ok(figures) => {
                    let measured =
                        format!("{} s, {} violations", number(figures.seconds), figures.violations);
                    Verdict::holds(&claim, "no violation", measured, figures.violations == 0)
                }
                Err(why) => Verdict::holds(&claim, "no violation", why.clone(), false),
            }
        })
        .collect()
}
