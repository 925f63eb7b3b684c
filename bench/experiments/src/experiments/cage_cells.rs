//! Cells beside cages: the bound holds over all corners, and what that costs.

use super::Context;
use crate::inputs::{self, Points};
use crate::report::Report;
use crate::row;
use crate::runner::{self, in_parallel};
use crate::table::{Table, number};
use crate::verdict::Verdict;
use netmesh::{Options, quality};
use std::time::Duration;

pub const NAME: &str = "cage_cells";
const INPUTS: [&str; 4] = ["uniform", "gaussian", "nested clusters", "pairs"];

struct Entry {
    input: &'static str,
    dim: usize,
    n: usize,
    vertices: usize,
    /// The worst aspect over all corners, over tau.
    anywhere: f64,
    /// The worst aspect over the corners that count, over tau.
    counted: f64,
    closing_points: u64,
}

pub fn run(context: &Context) -> Report {
    let tasks: Vec<(&'static str, usize)> =
        [4, 3, 2].into_iter().flat_map(|dim| INPUTS.map(|input| (input, dim))).collect();
    let mut entries: Vec<Entry> =
        in_parallel(context.jobs, tasks, |(input, dim)| measure(context, input, dim))
            .into_iter()
            .flatten()
            .collect();
    entries.sort_by_key(|entry| entry.dim);
    Report {
        name: NAME,
        title: "Cells beside cages",
        text: text(),
        verdicts: entries.iter().map(verdict).collect(),
        tables: vec![table(&entries)],
        pictures: Vec::new(),
    }
}

fn text() -> String {
    "The worst aspect over tau, of all cells off the hull over all their corners (\"anywhere\"), \
     and of the cells of vertices over the corners well inside the hull of their domain's cage \
     (\"counted\"). \"in cage gaps\" are the vertices that the final refinement inserted there. \
     Default options."
        .to_string()
}

fn points(context: &Context, input: &str, dim: usize) -> Points {
    let n = context.pick(60, [10_000, 10_000, 1_000][dim - 2], [100_000, 10_000, 3_000][dim - 2]);
    match input {
        "nested clusters" => inputs::nested_clusters(dim, 20, context.pick(3, 50, 50), 24.0, 1),
        "pairs" => inputs::close_pairs(dim, context.pick(20, 500, 500), -24, 1),
        name => inputs::named(name, dim, n, 1),
    }
}

fn measure(context: &Context, input: &'static str, dim: usize) -> Option<Entry> {
    let points = points(context, input, dim);
    let outcome = runner::mesh(&points, &Options::default(), Duration::from_secs(120));
    let mesh = outcome.mesh()?;
    let quality = quality::measure(mesh).unwrap_or_else(|error| panic!("{error}"));
    let tau = mesh.parameters.quality_bound;
    Some(Entry {
        input,
        dim,
        n: points.len(),
        vertices: mesh.vertex_count(),
        anywhere: quality.worst_aspect_anywhere / tau,
        counted: quality.worst_aspect / tau,
        closing_points: mesh.stats.closing_points,
    })
}

fn verdict(entry: &Entry) -> Verdict {
    let claim = format!("{}, {}D: worst aspect anywhere over tau", entry.input, entry.dim);
    Verdict::at_most(&claim, entry.anywhere, 2.0)
}

fn table(entries: &[Entry]) -> Table {
    let mut table = Table::new(
        "cage_cells",
        &["input", "dim", "n", "m/n", "counted", "anywhere", "in cage gaps", "in gaps/n"],
    );
    for e in entries {
        table.add(row![
            e.input,
            e.dim,
            e.n,
            number(e.vertices as f64 / e.n as f64),
            number(e.counted),
            number(e.anywhere),
            e.closing_points,
            number(e.closing_points as f64 / e.n as f64),
        ]);
    }
    table
}
