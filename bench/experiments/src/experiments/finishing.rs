//! FINISHMESH: time per vertex of its output, while the output grows with the spread.

use super::Context;
use crate::inputs;
use crate::plot::{Axis, Panel, Plot, Series};
use crate::report::Report;
use crate::row;
use crate::runner::{self, median_seconds};
use crate::table::{Table, number};
use crate::verdict::{Verdict, exponent};
use netmesh::{Options, Output};
use std::time::Duration;

pub const NAME: &str = "finishing";
const DIMS: [usize; 2] = [2, 3];

struct Entry {
    dim: usize,
    log_distance: i32,
    n: usize,
    hierarchical: usize,
    finished: usize,
    hierarchical_seconds: f64,
    finished_seconds: f64,
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

    fn whole(&self) -> f64 {
        1e6 * self.finished_seconds / self.finished as f64
    }
}

pub fn run(context: &Context) -> Report {
    let entries: Vec<Entry> = DIMS.iter().flat_map(|&dim| curve(context, dim)).collect();
    Report {
        name: NAME,
        title: "FINISHMESH takes O(m) time (Theorem 36)",
        text: text(),
        verdicts: DIMS.iter().flat_map(|&dim| verdicts(&entries, dim)).collect(),
        tables: vec![table(&entries)],
        plots: vec![plot(&entries)],
    }
}

fn text() -> String {
    "Law: after NETMESH, the well-spaced mesh of m vertices takes O(m) time. Close pairs in the unit \
     cube (500 in 2D, 100 in 3D): n is fixed and m grows with the logarithm of 1 / distance. Both \
     outputs take turns, medians; FINISHMESH's time is their difference, per vertex of the finished \
     mesh (finishing) and per vertex that it added; \"whole\" is the time of both phases per vertex."
        .to_string()
}

fn curve(context: &Context, dim: usize) -> Vec<Entry> {
    let pairs = context.pick(10, [500, 100][dim - 2], [500, 100][dim - 2]);
    let exponents: &[i32] =
        context.pick(&[8, 12], &[4, 6, 8, 12, 24, 40], &[4, 5, 6, 8, 10, 12, 16, 24, 32, 40, 44]);
    exponents.iter().map(|&exponent| measure(context, dim, pairs, -exponent)).collect()
}

fn measure(context: &Context, dim: usize, pairs: usize, log_distance: i32) -> Entry {
    let points = inputs::close_pairs(dim, pairs, log_distance, 1);
    let run = |output: Output, vertices: &mut usize| {
        let options = Options { output, ..Options::default() };
        let outcome = runner::mesh(&points, &options, Duration::from_secs(120));
        let mesh = outcome.mesh();
        *vertices = mesh.map_or(0, |mesh| mesh.vertex_count());
        mesh.map_or(f64::NAN, |mesh| mesh.stats.seconds)
    };
    let (mut hierarchical, mut finished) = (0, 0);
    let turns = context.pick(1, 3, if log_distance > -12 { 9 } else { 3 });
    let seconds = median_seconds(
        turns,
        &mut [&mut || run(Output::Hierarchical, &mut hierarchical), &mut || {
            run(Output::WellSpaced, &mut finished)
        }],
    );
    Entry {
        dim,
        log_distance,
        n: points.len(),
        hierarchical,
        finished,
        hierarchical_seconds: seconds[0],
        finished_seconds: seconds[1],
    }
}

fn table(entries: &[Entry]) -> Table {
    let mut table = Table::new(
        "finishing",
        &[
            "dim",
            "log2 distance",
            "n",
            "m hierarchical",
            "m finished",
            "seconds hierarchical",
            "seconds finished",
            "us/vertex finishing",
            "us/vertex added",
            "us/vertex whole",
        ],
    );
    for e in entries {
        table.add(row![
            e.dim,
            e.log_distance,
            e.n,
            e.hierarchical,
            e.finished,
            number(e.hierarchical_seconds),
            number(e.finished_seconds),
            number(e.finishing()),
            number(e.adding()),
            number(e.whole()),
        ]);
    }
    table
}

fn verdicts(entries: &[Entry], dim: usize) -> Vec<Verdict> {
    let of: Vec<&Entry> = entries.iter().filter(|e| e.dim == dim).collect();
    let ratio = match (of.first(), of.last()) {
        (Some(first), Some(last)) => last.finished as f64 / first.finished as f64,
        _ => f64::NAN,
    };
    let figures = |figure: fn(&Entry) -> f64| of.iter().map(|e| figure(e)).collect::<Vec<f64>>();
    let seconds: Vec<(f64, f64)> =
        of.iter().map(|e| (e.finished as f64, e.finished_seconds)).collect();
    vec![
        Verdict::at_least(&format!("{dim}D: growth of m along the curve"), ratio, 100.0),
        Verdict::flat(
            &format!("{dim}D: time of FINISHMESH per vertex added"),
            &figures(Entry::adding),
            0.25,
        ),
        Verdict::flat(
            &format!("{dim}D: time of both phases per vertex"),
            &figures(Entry::whole),
            0.25,
        ),
        Verdict::at_most(
            &format!("{dim}D: exponent of m in the time of both phases"),
            exponent(&seconds),
            1.05,
        ),
    ]
}

fn plot(entries: &[Entry]) -> Plot {
    let panel = |dim: usize| {
        let series = |name: &str, figure: fn(&Entry) -> f64| {
            let of = entries.iter().filter(|e| e.dim == dim && figure(e) > 0.0);
            Series::new(name, of.map(|e| (e.finished as f64, figure(e))).collect())
        };
        Panel {
            caption: format!("{dim}D"),
            x: Axis::log("vertices of the finished mesh"),
            y: Axis::log("us / vertex"),
            series: vec![
                series("both phases, per vertex", Entry::whole),
                series("FINISHMESH, per vertex added", Entry::adding),
            ],
        }
    };
    Plot {
        name: "finishing".to_string(),
        title: "Time per vertex while m grows and n does not".to_string(),
        panels: DIMS.map(panel).to_vec(),
    }
}
