//! FINISHMESH: time per vertex of its output, while the output grows with the spread.

use super::Context;
use crate::inputs::{self, Points};
use crate::plot::{Axis, Panel, Plot, Series};
use crate::report::Report;
use crate::row;
use crate::runner::{self, least_seconds};
use crate::table::{Table, number};
use crate::verdict::{Verdict, exponent};
use netmesh::{Options, Output};
use std::time::Duration;

pub const NAME: &str = "finishing";
const DIMS: [usize; 2] = [2, 3];

/// A family of inputs whose finished meshes grow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Family {
    /// At 2^-24 in the unit cube, more and more of them: every pair has the same gap to fill.
    Pairs,
    /// As many as ever, at 2^-exponent: the gaps grow.
    CloserPairs,
}

struct Entry {
    family: Family,
    dim: usize,
    /// The number of pairs, or their exponent.
    parameter: i32,
    n: usize,
    hierarchical: usize,
    finished: usize,
    hierarchical_seconds: f64,
    finished_seconds: f64,
    exact_signs: u64,
}

impl Family {
    const ALL: [Family; 2] = [Family::Pairs, Family::CloserPairs];

    fn name(self) -> &'static str {
        match self {
            Family::Pairs => "pairs",
            Family::CloserPairs => "closer pairs",
        }
    }

    fn parameters(self, context: &Context, dim: usize) -> &'static [i32] {
        match (self, dim) {
            (Family::Pairs, 2) => {
                context.pick(&[3, 6], &[12, 120, 1200], &[12, 40, 120, 400, 1200, 4000])
            }
            (Family::Pairs, _) => context.pick(&[2, 4], &[5, 50, 300], &[15, 50, 150, 500, 1700]),
            (Family::CloserPairs, _) => {
                context.pick(&[8, 12], &[4, 8, 12, 24, 40], &[4, 6, 8, 10, 12, 16, 24, 32, 40])
            }
        }
    }

    fn points(self, context: &Context, dim: usize, parameter: i32) -> Points {
        match self {
            Family::Pairs => inputs::close_pairs(dim, parameter as usize, -24, 1),
            Family::CloserPairs => {
                let pairs = context.pick([10, 10], [500, 100], [500, 100])[dim - 2];
                inputs::close_pairs(dim, pairs, -parameter, 1)
            }
        }
    }
}

impl Entry {
    /// Microseconds of FINISHMESH per vertex of its output.
    fn finishing(&self) -> f64 {
        1e6 * (self.finished_seconds - self.hierarchical_seconds) / self.finished as f64
    }

    /// The same per vertex that it added.
    fn adding(&self) -> f64 {
        1e6 * (self.finished_seconds - self.hierarchical_seconds)
            / (self.finished - self.hierarchical) as f64
    }

    /// Whether FINISHMESH's part is more than the difference of two like times.
    fn is_finishing(&self) -> bool {
        self.finished >= 2 * self.hierarchical
    }

    fn whole(&self) -> f64 {
        1e6 * self.finished_seconds / self.finished as f64
    }
}

pub fn run(context: &Context) -> Report {
    let mut entries = Vec::new();
    for (family, dim) in curves() {
        let parameters = family.parameters(context, dim).iter();
        entries.extend(parameters.map(|&parameter| measure(context, family, dim, parameter)));
    }
    Report {
        name: NAME,
        title: "FINISHMESH takes O(m) time (Theorem 36)",
        text: text(),
        verdicts: curves().flat_map(|(family, dim)| verdicts(&entries, family, dim)).collect(),
        tables: vec![table(&entries)],
        plots: vec![plot(&entries)],
    }
}

fn text() -> String {
    "Law: after NETMESH, the well-spaced mesh of m vertices takes O(m) time. Close pairs in the unit \
     cube: more and more of them at 2^-24 (\"pairs\"), where m grows and what is built round each pair \
     stays the same; and 500 (in 3D 100) of them at 2^-exponent (\"closer pairs\"), where m grows with the \
     logarithm of the spread and the share of the shells round pairs, which are denser in simplices \
     than uniform inputs, grows from 0 to 1. Both outputs take turns, the least seconds count; FINISHMESH's time is \
     their difference, per vertex of the finished mesh (finishing) and per vertex that it added, where \
     the finished mesh is at least twice as large; \"whole\" is the time of both phases per vertex. Exact \
     signs are those that the floating-point filters left to integers."
        .to_string()
}

fn curves() -> impl Iterator<Item = (Family, usize)> {
    Family::ALL.into_iter().flat_map(|family| DIMS.map(|dim| (family, dim)))
}

fn measure(context: &Context, family: Family, dim: usize, parameter: i32) -> Entry {
    let points = family.points(context, dim, parameter);
    let run = |output: Output, vertices: &mut usize, exact_signs: &mut u64| {
        let options = Options { output, ..Options::default() };
        let outcome = runner::mesh(&points, &options, Duration::from_secs(120));
        let mesh = outcome.mesh();
        *vertices = mesh.map_or(0, |mesh| mesh.vertex_count());
        *exact_signs = mesh.map_or(0, |mesh| mesh.stats.exact_fallbacks);
        mesh.map_or(f64::NAN, |mesh| mesh.stats.seconds)
    };
    let (mut hierarchical, mut finished, mut unused, mut exact_signs) = (0, 0, 0, 0);
    let turns = context.pick(1, 3, if points.len() <= 250 { 15 } else { 3 });
    let seconds = least_seconds(
        turns,
        &mut [&mut || run(Output::Hierarchical, &mut hierarchical, &mut unused), &mut || {
            run(Output::WellSpaced, &mut finished, &mut exact_signs)
        }],
    );
    Entry {
        family,
        dim,
        parameter,
        n: points.len(),
        hierarchical,
        finished,
        hierarchical_seconds: seconds[0],
        finished_seconds: seconds[1],
        exact_signs,
    }
}

fn table(entries: &[Entry]) -> Table {
    let mut table = Table::new(
        "finishing",
        &[
            "input",
            "dim",
            "pairs or exponent",
            "n",
            "m hierarchical",
            "m finished",
            "seconds hierarchical",
            "seconds finished",
            "us/vertex finishing",
            "us/vertex added",
            "us/vertex whole",
            "exact signs/vertex",
        ],
    );
    for e in entries {
        table.add(row![
            e.family.name(),
            e.dim,
            e.parameter,
            e.n,
            e.hierarchical,
            e.finished,
            number(e.hierarchical_seconds),
            number(e.finished_seconds),
            number(e.finishing()),
            number(e.adding()),
            number(e.whole()),
            number(e.exact_signs as f64 / e.finished as f64),
        ]);
    }
    table
}

fn verdicts(entries: &[Entry], family: Family, dim: usize) -> Vec<Verdict> {
    let of: Vec<&Entry> = of_curve(entries, family, dim).collect();
    let growth = match (of.first(), of.last()) {
        (Some(first), Some(last)) => last.finished as f64 / first.finished as f64,
        _ => f64::NAN,
    };
    let added: Vec<f64> = of.iter().filter(|e| e.is_finishing()).map(|e| e.adding()).collect();
    let whole: Vec<f64> = of.iter().map(|e| e.whole()).collect();
    let seconds: Vec<(f64, f64)> =
        of.iter().map(|e| (e.finished as f64, e.finished_seconds)).collect();
    let claim = |what: &str| format!("{}, {dim}D: {what}", family.name());
    let mut verdicts = vec![
        Verdict::at_least(&claim("growth of m along the curve"), growth, 100.0),
        Verdict::at_most(
            &claim("exponent of m in the time of both phases"),
            exponent(&seconds),
            if family == Family::Pairs { 1.05 } else { 1.25 },
        ),
    ];
    if family == Family::Pairs {
        verdicts.extend([
            Verdict::flat(&claim("time of FINISHMESH per vertex added"), &added, 0.25),
            Verdict::flat(&claim("time of both phases per vertex"), &whole, 0.25),
        ]);
    }
    verdicts
}

fn of_curve(entries: &[Entry], family: Family, dim: usize) -> impl Iterator<Item = &Entry> {
    entries.iter().filter(move |e| (e.family, e.dim) == (family, dim))
}

fn plot(entries: &[Entry]) -> Plot {
    let panel = |dim: usize| {
        let series = Family::ALL.iter().flat_map(|&family| {
            let of = || of_curve(entries, family, dim);
            let whole = of().map(|e| (e.finished as f64, e.whole())).collect();
            let added = of().filter(|e| e.is_finishing() && e.adding() > 0.0);
            let added = added.map(|e| (e.finished as f64, e.adding())).collect();
            let name = |what: &str| format!("{}, {what}", family.name());
            [
                Series::new(name("both phases, per vertex"), whole),
                Series::new(name("FINISHMESH, per vertex added"), added),
            ]
        });
        Panel {
            caption: format!("{dim}D"),
            x: Axis::log("vertices of the finished mesh"),
            y: Axis::log("us / vertex"),
            series: series.collect(),
        }
    };
    Plot {
        name: "finishing".to_string(),
        title: "Time per vertex while m grows".to_string(),
        panels: DIMS.map(panel).to_vec(),
    }
}
