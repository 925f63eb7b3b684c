//! What is practical in each dimension.

use super::Context;
use crate::inputs::{self, Points};
use crate::report::Report;
use crate::row;
use crate::runner::{self, Outcome};
use crate::table::{Table, number};
use crate::verdict::Verdict;
use netmesh::{Mesh, Options, validate};
use std::time::Duration;

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
    /// Bytes that the run added to what the process held.
    memory: Option<u64>,
    /// Violations of the certificate's three levels.
    violations: u64,
}

pub fn run(context: &Context) -> Report {
    let entries: Vec<Entry> = cases(context)
        .into_iter()
        .map(|case| Entry { result: measure(context, &case), case })
        .collect();
    Report {
        name: NAME,
        title: "What is practical in each dimension",
        text: text(),
        verdicts: verdicts(&entries),
        tables: vec![table(&entries)],
        plots: Vec::new(),
    }
}

fn text() -> String {
    "Default options, hierarchical. Uniform inputs in the unit cube, and inputs on a surface: the torus \
     (cos u, sin u, cos v, sin v, cos(u + v), sin(u + v)), its first five coordinates in 5D. One run \
     each. Memory is what the run added to the process at its highest; the certificate is that of all \
     three levels."
        .to_string()
}

fn cases(context: &Context) -> Vec<Case> {
    let uniform = [
        (2, 10_000, 100_000),
        (3, 10_000, 100_000),
        (4, 3_000, 10_000),
        (5, 300, 1_000),
        (6, 100, 1_000),
    ];
    let mut cases: Vec<Case> = uniform
        .into_iter()
        .map(|(dim, quick, full)| Case { input: "uniform", dim, n: context.pick(40, quick, full) })
        .collect();
    for dim in [5, 6] {
        cases.push(Case { input: "surface", dim, n: context.pick(40, 300, 1_000) });
    }
    cases
}

impl Case {
    fn points(&self) -> Points {
        match self.input {
            "surface" => inputs::surface(self.dim, self.n, 1),
            name => inputs::named(name, self.dim, self.n, 1),
        }
    }
}

fn measure(context: &Context, case: &Case) -> Result<Figures, String> {
    runner::forget_peak();
    let before = runner::held_memory();
    let limit = Duration::from_secs(context.pick(20, 60, 240));
    let mesh = match runner::mesh(&case.points(), &Options::default(), limit) {
        Outcome::Done(mesh) => mesh,
        Outcome::Stopped(why) => return Err(why.to_string()),
    };
    let peak = runner::peak_memory();
    let result = mesh.triangulation().ok_or("-")?;
    eprintln!("  {}, {}D, {}: {:.2} s", case.input, case.dim, case.n, result.stats.seconds);
    Ok(Figures {
        vertices: result.vertex_count(),
        simplices: result.simplex_count(),
        seconds: result.stats.seconds,
        memory: peak.zip(before).map(|(peak, before)| peak.saturating_sub(before)),
        violations: violations(&mesh),
    })
}

fn violations(mesh: &Mesh) -> u64 {
    let result = mesh.triangulation().expect("a run that was done has a result");
    let report =
        validate::validate(mesh.inputs(), result, 3).unwrap_or_else(|error| panic!("{error}"));
    report.violations
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
            ],
            Err(why) => row![dim, input, n, "-", "-", why, "-", "-", "-", "-"],
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
