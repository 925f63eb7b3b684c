//! FINISHMESH: simplices made per vertex of its output, while the output grows with the spread.

use super::Context;
use crate::inputs::{self, Points};
use crate::report::{Picture, Report};
use crate::row;
use crate::runner::{self, least_seconds};
use crate::table::{Row, Rows, Table, number, number_or_dash};
use crate::verdict::{Verdict, exponent};
use netmesh::{Options, Output, Triangulation};
use std::time::Duration;

pub const NAME: &str = "finishing";
const DIMS: [usize; 2] = [2, 3];

/// A family of inputs whose finished meshes grow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Family {
    /// More and more pairs, at 2^-24 in the unit cube: every pair has the same gap to fill.
    Pairs,
    /// A constant number of pairs, at 2^-exponent: the gaps grow.
    CloserPairs,
}

struct Entry {
    family: Family,
    dim: usize,
    /// The number of pairs, or their exponent.
    parameter: i32,
    n: usize,
    hierarchical: Figures,
    finished: Figures,
}

/// A mesh and what it took to make it. NaN stands for what was not measured.
#[derive(Clone, Copy)]
struct Figures {
    vertices: f64,
    /// Simplices made in the whole run.
    created: f64,
    exact_signs: f64,
    seconds: f64,
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
    /// Simplices that FINISHMESH makes, per vertex that it adds.
    fn adding(&self) -> f64 {
        (self.finished.created - self.hierarchical.created)
            / (self.finished.vertices - self.hierarchical.vertices)
    }

    /// Returns true if FINISHMESH's share is more than the difference of two like meshes.
    fn is_finishing(&self) -> bool {
        self.finished.vertices >= 2.0 * self.hierarchical.vertices
    }

    /// Simplices that both phases make, per vertex of the finished mesh.
    fn whole(&self) -> f64 {
        self.finished.created / self.finished.vertices
    }
}

pub fn run(context: &Context) -> Report {
    let mut entries = Vec::new();
    for (family, dim) in curves() {
        let parameters = family.parameters(context, dim).iter();
        entries.extend(parameters.map(|&parameter| measure(context, family, dim, parameter)));
    }
    report(&entries)
}

/// The report on what an earlier run has measured.
pub fn again(rows: &Rows) -> Report {
    report(&rows.iter().filter_map(read).collect::<Vec<_>>())
}

fn report(entries: &[Entry]) -> Report {
    Report {
        name: NAME,
        title: "FINISHMESH takes O(m) time (Theorem 36)",
        text: text(),
        verdicts: curves().flat_map(|(family, dim)| verdicts(entries, family, dim)).collect(),
        tables: vec![table(entries)],
        pictures: vec![Picture::new(NAME, "Simplices made per vertex while m grows")],
    }
}

fn text() -> String {
    "Law: after NETMESH, the well-spaced mesh of m vertices takes O(m) time: FINISHMESH inserts \
     O(m) vertices, each of which makes and destroys a constant number of simplices. Close pairs \
     in the unit cube: more and more of them at 2^-24 (\"pairs\"), where m grows and what is built \
     round each pair stays the same; and 500 (in 3D 100) of them at 2^-exponent (\"closer \
     pairs\"), where m grows with the logarithm of the spread and the share of the shells round \
     pairs, which are denser in simplices than uniform inputs, grows from 0 to 1.\n\n\
     The verdicts rest on the simplices made, those included that were destroyed again: of \
     FINISHMESH per vertex that it added, where the finished mesh is at least twice as large \
     (\"made/vertex added\"), and of both phases per vertex (\"made/vertex\"). Exact signs are \
     those that the floating-point filters left to integers. Seconds stand beside them for \
     information."
        .to_string()
}

fn curves() -> impl Iterator<Item = (Family, usize)> {
    Family::ALL.into_iter().flat_map(|family| DIMS.map(|dim| (family, dim)))
}

fn measure(context: &Context, family: Family, dim: usize, parameter: i32) -> Entry {
    let points = family.points(context, dim, parameter);
    let run = |output: Output, figures: &mut Figures| {
        let options = Options { output, ..Options::default() };
        let outcome = runner::mesh(&points, &options, Duration::from_secs(600));
        *figures = outcome.mesh().map_or(Figures::NONE, Figures::of);
        figures.seconds
    };
    let (mut hierarchical, mut finished) = (Figures::NONE, Figures::NONE);
    let turns = if points.len() <= 250 { context.pick(1, 3, 3) } else { 1 };
    let seconds = least_seconds(
        turns,
        &mut [&mut || run(Output::Hierarchical, &mut hierarchical), &mut || {
            run(Output::WellSpaced, &mut finished)
        }],
    );
    hierarchical.seconds = seconds[0];
    finished.seconds = seconds[1];
    Entry { family, dim, parameter, n: points.len(), hierarchical, finished }
}

impl Figures {
    const NONE: Figures =
        Figures { vertices: f64::NAN, created: f64::NAN, exact_signs: f64::NAN, seconds: f64::NAN };

    fn of(mesh: &Triangulation) -> Self {
        Self {
            vertices: mesh.vertex_count() as f64,
            created: mesh.stats.simplices_created as f64,
            exact_signs: mesh.stats.exact_fallbacks as f64,
            seconds: mesh.stats.seconds,
        }
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
            "made hierarchical",
            "made finished",
            "made/vertex added",
            "made/vertex",
            "exact signs/vertex",
            "seconds hierarchical",
            "seconds finished",
            "us/vertex",
        ],
    );
    for e in entries {
        table.add(row![
            e.family.name(),
            e.dim,
            e.parameter,
            e.n,
            e.hierarchical.vertices,
            e.finished.vertices,
            e.hierarchical.created,
            e.finished.created,
            if e.is_finishing() { number_or_dash(e.adding()) } else { "-".to_string() },
            number_or_dash(e.whole()),
            number_or_dash(e.finished.exact_signs / e.finished.vertices),
            number(e.hierarchical.seconds),
            number(e.finished.seconds),
            number(1e6 * e.finished.seconds / e.finished.vertices),
        ]);
    }
    table
}

/// The entry that [`table`] made this row of.
fn read(row: Row) -> Option<Entry> {
    let vertices = row.number("m finished");
    Some(Entry {
        family: Family::ALL.into_iter().find(|family| family.name() == row.word("input"))?,
        dim: row.count("dim"),
        parameter: row.count("pairs or exponent") as i32,
        n: row.count("n"),
        hierarchical: Figures {
            vertices: row.number("m hierarchical"),
            created: row.number("made hierarchical"),
            exact_signs: f64::NAN,
            seconds: row.number("seconds hierarchical"),
        },
        finished: Figures {
            vertices,
            created: row.number("made finished"),
            exact_signs: row.number("exact signs/vertex") * vertices,
            seconds: row.number("seconds finished"),
        },
    })
}

fn verdicts(entries: &[Entry], family: Family, dim: usize) -> Vec<Verdict> {
    let of: Vec<&Entry> = of_curve(entries, family, dim).collect();
    let growth = match (of.first(), of.last()) {
        (Some(first), Some(last)) => last.finished.vertices / first.finished.vertices,
        _ => f64::NAN,
    };
    let is_measured = |figure: &f64| !figure.is_nan();
    let added = of.iter().filter(|e| e.is_finishing()).map(|e| e.adding()).filter(is_measured);
    let whole = of.iter().map(|e| e.whole()).filter(is_measured);
    let created: Vec<(f64, f64)> =
        of.iter().map(|e| (e.finished.vertices, e.finished.created)).collect();
    let claim = |what: &str| format!("{}, {dim}D: {what}", family.name());
    let mut verdicts = vec![
        Verdict::at_least(&claim("growth of m along the curve"), growth, 100.0),
        Verdict::at_most(
            &claim("exponent of m in the simplices made by both phases"),
            exponent(&created),
            if family == Family::Pairs { 1.05 } else { 1.25 },
        ),
    ];
    if family == Family::Pairs {
        let of_finishing = claim("simplices made by FINISHMESH per vertex added");
        let of_both = claim("simplices made by both phases per vertex");
        verdicts.extend([
            Verdict::flat(&of_finishing, &added.collect::<Vec<_>>(), 0.25),
            Verdict::flat(&of_both, &whole.collect::<Vec<_>>(), 0.25),
        ]);
    }
    verdicts
}

fn of_curve(entries: &[Entry], family: Family, dim: usize) -> impl Iterator<Item = &Entry> {
    entries.iter().filter(move |e| (e.family, e.dim) == (family, dim))
}
