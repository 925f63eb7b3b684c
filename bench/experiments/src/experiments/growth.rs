//! Work against n: point location, simplices, rounds and degrees, for both orderings.

use super::Context;
use crate::degrees::Degrees;
use crate::inputs::{self, Points};
use crate::instruments::Instruments;
use crate::report::{Picture, Report};
use crate::row;
use crate::runner::{self, Outcome, least_seconds};
use crate::table::{Row, Rows, Table, number, number_or_dash};
use crate::verdict::{Verdict, exponent};
use netmesh::{Mesh, NetOrdering, Options};
use std::time::Duration;

pub const NAME: &str = "growth";
const INPUTS: [&str; 2] = ["uniform", "clusters"];
const DIMS: [usize; 3] = [2, 3, 4];
const ORDERINGS: [NetOrdering; 2] = [NetOrdering::SampledNet, NetOrdering::DeterministicNet];

/// Name of a curve, whose entries differ in n alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Curve {
    input: &'static str,
    dim: usize,
    ordering: NetOrdering,
}

/// A row of the table. NaN stands for what was not measured.
struct Entry {
    curve: Curve,
    n: usize,
    /// Vertices per input.
    size: f64,
    /// Touches over n log2 n.
    touches: f64,
    /// Simplices made in the whole run, per vertex.
    created: f64,
    /// Signs that only integers decided, per vertex.
    exact_signs: f64,
    rounds: f64,
    degrees: Degrees,
    instruments: Instruments,
    seconds: f64,
}

impl Entry {
    fn n_log_n(&self) -> f64 {
        n_log_n(self.n)
    }

    /// Nanoseconds per unit of the law.
    fn time(&self) -> f64 {
        1e9 * self.seconds / (self.n_log_n() + self.size * self.n as f64)
    }
}

fn n_log_n(n: usize) -> f64 {
    n as f64 * (n as f64).log2()
}

pub fn run(context: &Context) -> Report {
    let mut entries = Vec::new();
    for dim in DIMS {
        for input in INPUTS {
            for n in sizes(context, dim) {
                entries.extend(measure(context, input, dim, n));
            }
        }
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
        title: "O(n log n) work in O(log n) rounds (Theorems 5, 16, 17 and 30)",
        text: text(),
        verdicts: verdicts(entries),
        tables: vec![table(entries)],
        pictures: vec![
            Picture::new("growth_touches", "Against n: touches / (n log2 n)"),
            Picture::new("growth_time", "Against n: ns / (n log2 n + m)"),
            Picture::new("growth_degree", "Against n: largest degree"),
        ],
    }
}

fn text() -> String {
    "Law: O(n log n) touches, O(m) simplices made and destroyed, O(log n) rounds, bounded degree \
     and ply at all times, and so O(n log n + m) time. Uniform inputs in the unit cube, and \
     clusters: normal distributions of 100 points each, 2^-6 as wide as they are apart. Default \
     options, hierarchical; \"sampled\" is the default ordering, \"deterministic\" the net of \
     Theorem 3, up to 100,000 inputs (10,000 in 4D).\n\n\
     The verdicts rest on counts, which no other work on the machine disturbs; seconds stand \
     beside them for information. \"simplices made/m\" counts the simplices that any insertion \
     made, most of which a later one destroyed. \"exact signs/m\" counts the signs that the \
     floating-point filters left to integers. \"degree 99.99 %\" is the degree that one vertex in \
     10,000 exceeds, from 10,000 vertices on. The largest degree is the largest of m, so it rises \
     slowly with m where the distribution of degrees stays the same: it has no verdict. \
     \"Constant\" means here that the power law through the curve has an exponent of at most 0.1. \
     A cell with - was not measured."
        .to_string()
}

fn sizes(context: &Context, dim: usize) -> Vec<usize> {
    let all = [1_000, 3_000, 10_000, 30_000, 100_000, 300_000, 1_000_000];
    let most = match dim {
        4 => context.pick(0, 10_000, 100_000),
        _ => context.pick(0, 100_000, 1_000_000),
    };
    let within: Vec<usize> = all.into_iter().filter(|&n| n <= most).collect();
    if within.is_empty() { vec![50, 100, 200] } else { within }
}

/// Seconds are information only: the least of three where that costs little.
fn turns(context: &Context, dim: usize, n: usize) -> usize {
    let work = n * [1, 4, 40][dim - 2];
    if work <= 150_000 { context.pick(1, 1, 3) } else { 1 }
}

/// Both orderings in turns; the deterministic one up to a size.
fn measure(context: &Context, input: &'static str, dim: usize, n: usize) -> Vec<Entry> {
    let points = inputs::named(input, dim, n, 1);
    let run = |ordering: NetOrdering, result: &mut Option<Box<Mesh>>| {
        // The old result first: two meshes of a million points are a lot of memory.
        *result = None;
        match runner::mesh(&points, &options(ordering), Duration::from_secs(300)) {
            Outcome::Done(mesh) => {
                let seconds = mesh.triangulation().map_or(f64::NAN, |mesh| mesh.stats.seconds);
                *result = Some(mesh);
                seconds
            }
            Outcome::Stopped(_) => f64::NAN,
        }
    };
    let orderings: &[NetOrdering] =
        if n <= [100_000, 100_000, 10_000][dim - 2] { &ORDERINGS } else { &ORDERINGS[..1] };
    let mut results: Vec<Option<Box<Mesh>>> = orderings.iter().map(|_| None).collect();
    let turns = turns(context, dim, n);
    let mut variants: Vec<_> = orderings
        .iter()
        .zip(&mut results)
        .map(|(&ordering, result)| {
            let run = &run;
            move || run(ordering, result)
        })
        .collect();
    let mut calls: Vec<&mut dyn FnMut() -> f64> =
        variants.iter_mut().map(|variant| variant as &mut dyn FnMut() -> f64).collect();
    let seconds = least_seconds(turns, &mut calls);
    drop(variants);
    eprintln!("  {input}, {dim}D, {n}: {:.2} s", seconds[0]);
    let mut entries = Vec::new();
    for ((&ordering, result), seconds) in orderings.iter().zip(results).zip(seconds) {
        let curve = Curve { input, dim, ordering };
        entries.extend(result.map(|mesh| entry(curve, &mesh, &points, seconds)));
    }
    entries
}

/// The time for the instruments is not in the run's seconds.
fn options(ordering: NetOrdering) -> Options {
    Options { ordering, instruments: true, ..Options::default() }
}

fn entry(curve: Curve, mesh: &Mesh, points: &Points, seconds: f64) -> Entry {
    let result = mesh.triangulation().expect("a run that was done has a result");
    let per_vertex = |count: u64| count as f64 / result.vertex_count() as f64;
    Entry {
        curve,
        n: points.len(),
        size: result.vertex_count() as f64 / points.len() as f64,
        touches: result.stats.touches as f64 / n_log_n(points.len()),
        created: per_vertex(result.stats.simplices_created),
        exact_signs: per_vertex(result.stats.exact_fallbacks),
        rounds: result.stats.rounds as f64,
        degrees: Degrees::of(result),
        instruments: Instruments::of(&result.stats),
        seconds,
    }
}

fn ordering_name(ordering: NetOrdering) -> &'static str {
    match ordering {
        NetOrdering::SampledNet => "sampled",
        NetOrdering::DeterministicNet => "deterministic",
    }
}

fn table(entries: &[Entry]) -> Table {
    let mut table = Table::new(
        "growth",
        &[
            "input",
            "dim",
            "n",
            "ordering",
            "m/n",
            "touches/(n log2 n)",
            "simplices made/m",
            "exact signs/m",
            "rounds",
            "log2 n + 2",
            "mean degree",
            "degree 99.99 %",
            "max degree",
            "max ply",
            "max ball intersections",
            "seconds",
            "ns/(n log2 n + m)",
        ],
    );
    for e in entries {
        table.add(row![
            e.curve.input,
            e.curve.dim,
            e.n,
            ordering_name(e.curve.ordering),
            number(e.size),
            number(e.touches),
            number_or_dash(e.created),
            number_or_dash(e.exact_signs),
            e.rounds,
            number((e.n as f64).log2() + 2.0),
            number_or_dash(e.degrees.mean),
            number_or_dash(e.degrees.high),
            number_or_dash(e.degrees.max),
            number(e.instruments.max_ply),
            number(e.instruments.max_ball_intersections),
            number(e.seconds),
            number(e.time()),
        ]);
    }
    table
}

/// The entry that [`table`] made this row of.
fn read(row: Row) -> Option<Entry> {
    let word = |column| row.word(column);
    Some(Entry {
        curve: Curve {
            input: INPUTS.into_iter().find(|&input| input == word("input"))?,
            dim: row.count("dim"),
            ordering: ORDERINGS.into_iter().find(|&o| ordering_name(o) == word("ordering"))?,
        },
        n: row.count("n"),
        size: row.number("m/n"),
        touches: row.number("touches/(n log2 n)"),
        created: row.number("simplices made/m"),
        exact_signs: row.number("exact signs/m"),
        rounds: row.number("rounds"),
        degrees: Degrees {
            mean: row.number("mean degree"),
            high: row.number("degree 99.99 %"),
            max: row.number("max degree"),
        },
        instruments: Instruments {
            max_ply: row.number("max ply"),
            max_ball_intersections: row.number("max ball intersections"),
        },
        seconds: row.number("seconds"),
    })
}

fn curves(entries: &[Entry]) -> Vec<(Curve, Vec<&Entry>)> {
    let mut curves: Vec<(Curve, Vec<&Entry>)> = Vec::new();
    for entry in entries {
        match curves.iter_mut().find(|(curve, _)| *curve == entry.curve) {
            Some((_, found)) => found.push(entry),
            None => curves.push((entry.curve, vec![entry])),
        }
    }
    curves
}

fn verdicts(entries: &[Entry]) -> Vec<Verdict> {
    let mut verdicts = Vec::new();
    for (curve, found) in curves(entries) {
        let claim = |what: &str| {
            format!("{}, {}D, {}: {what}", curve.input, curve.dim, ordering_name(curve.ordering))
        };
        let flat = |what: &str, figure: fn(&Entry) -> f64| {
            let figures: Vec<f64> =
                found.iter().map(|e| figure(e)).filter(|figure| !figure.is_nan()).collect();
            Verdict::flat(&claim(what), &figures, 0.25)
        };
        let constant =
            |what: &str, figure: fn(&Entry) -> f64| constant(&claim(what), &found, figure);
        let excess = found.iter().map(|e| e.rounds - (e.n as f64).log2()).fold(f64::MIN, f64::max);
        verdicts.extend([
            flat("touches/(n log2 n)", |e| e.touches),
            flat("simplices made/m", |e| e.created),
            Verdict::at_most(&claim("rounds - log2 n"), excess, 2.0),
            constant("mean degree", |e| e.degrees.mean),
            constant("degree 99.99 %", |e| e.degrees.high),
            constant("largest ply", |e| e.instruments.max_ply),
        ]);
    }
    verdicts.extend(ordering_verdicts(entries));
    verdicts
}

fn constant(claim: &str, entries: &[&Entry], figure: impl Fn(&Entry) -> f64) -> Verdict {
    let points: Vec<(f64, f64)> = entries
        .iter()
        .map(|e| (e.n as f64, figure(e)))
        .filter(|(_, figure)| !figure.is_nan())
        .collect();
    let mut verdict = Verdict::at_most(&format!("{claim}, exponent of n"), exponent(&points), 0.1);
    if let ([first, _, .., last], false) = (points.as_slice(), exponent(&points).is_nan()) {
        verdict.measured += &format!(" ({} to {})", number(first.1), number(last.1));
    }
    verdict
}

/// The deterministic ordering over the sampled one, where both were run.
fn ordering_verdicts(entries: &[Entry]) -> Vec<Verdict> {
    let mut verdicts = Vec::new();
    for dim in DIMS {
        for input in INPUTS {
            let of = |ordering| {
                entries.iter().filter(move |e| e.curve == Curve { input, dim, ordering })
            };
            let farthest = |figure: fn(&Entry) -> f64| {
                of(NetOrdering::DeterministicNet)
                    .filter_map(|e| {
                        let other = of(NetOrdering::SampledNet).find(|other| other.n == e.n)?;
                        Some((figure(e) / figure(other) - 1.0).abs())
                    })
                    .fold(f64::NAN, f64::max)
            };
            for (what, figure) in [
                ("m/n", (|e| e.size) as fn(&Entry) -> f64),
                ("touches", |e| e.touches),
                ("simplices made", |e| e.created * e.size),
            ] {
                let claim = format!(
                    "{input}, {dim}D: {what} of the deterministic ordering, farthest from the \
                     sampled one's"
                );
                verdicts.push(Verdict::at_most(&claim, farthest(figure), 0.3));
            }
        }
    }
    verdicts
}
