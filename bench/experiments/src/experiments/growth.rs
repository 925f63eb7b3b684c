//! Work against n: point location, rounds, degrees and time, for both orderings.

use super::Context;
use crate::inputs::{self, Points};
use crate::instruments::Instruments;
use crate::plot::{Axis, Panel, Plot, Series};
use crate::report::Report;
use crate::row;
use crate::runner::{self, Outcome, least_seconds};
use crate::table::{Table, number};
use crate::verdict::{Verdict, exponent, fit_sum};
use netmesh::{Mesh, NetOrdering, Options, quality};
use std::time::Duration;

pub const NAME: &str = "growth";
const INPUTS: [&str; 2] = ["uniform", "clusters"];
const DIMS: [usize; 3] = [2, 3, 4];
/// Beyond, measuring degrees takes more time and memory than the mesh.
const MEASURED_SIMPLICES: usize = 4_000_000;

/// What a curve is: all its entries differ in n alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Curve {
    input: &'static str,
    dim: usize,
    ordering: NetOrdering,
}

struct Entry {
    curve: Curve,
    n: usize,
    vertices: usize,
    touches: u64,
    rounds: u64,
    max_degree: Option<u32>,
    instruments: Instruments,
    seconds: f64,
    turns: usize,
}

impl Entry {
    fn n_log_n(&self) -> f64 {
        self.n as f64 * (self.n as f64).log2()
    }

    fn size(&self) -> f64 {
        self.vertices as f64 / self.n as f64
    }

    fn touches(&self) -> f64 {
        self.touches as f64 / self.n_log_n()
    }

    /// Nanoseconds per unit of the law.
    fn time(&self) -> f64 {
        1e9 * self.seconds / (self.n_log_n() + self.vertices as f64)
    }
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
    Report {
        name: NAME,
        title: "O(n log n) work in O(log n) rounds (Theorems 5, 16, 17 and 30)",
        text: text(),
        verdicts: verdicts(&entries),
        tables: vec![table(&entries)],
        plots: vec![
            plot(&entries, "growth_touches", "touches / (n log2 n)", |e| Some(e.touches())),
            plot(&entries, "growth_time", "ns / (n log2 n + m)", |e| Some(e.time())),
            plot(&entries, "growth_degree", "largest degree", |e| e.max_degree.map(f64::from)),
        ],
    }
}

fn text() -> String {
    "Law: O(n log n) touches, O(log n) rounds, bounded degree and ply at all times, O(n log n + m) time. \
     Uniform inputs in the unit cube, and clusters: normal distributions of 100 points each, \
     2^-6 as wide as they are apart. Default options, hierarchical; \"sampled\" is the default ordering, \"deterministic\" the net of Theorem 3, \
     up to 100,000 inputs (10,000 in 4D). Runs take turns, one at a time; seconds are the least of \
     `turns` runs. Degrees are measured on meshes of up to 4 million simplices. \"Constant\" means here \
     that the power law through the curve has an exponent of at most 0.1. The time is held against the \
     law twice: with equal constants for both terms, where what is linear in m falls as log n grows, and with \
     the two constants that fit best."
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

fn turns(context: &Context, dim: usize, n: usize) -> usize {
    let work = n * [1, 4, 40][dim - 2];
    match work {
        _ if context.pick(true, false, false) => 1,
        0..=40_000 => 15,
        40_001..=150_000 => 7,
        150_001..=500_000 => 5,
        500_001..=1_000_000 => 3,
        _ => 1,
    }
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
    let orderings: &[NetOrdering] = if n <= [100_000, 100_000, 10_000][dim - 2] {
        &[NetOrdering::SampledNet, NetOrdering::DeterministicNet]
    } else {
        &[NetOrdering::SampledNet]
    };
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
        entries.extend(result.map(|mesh| entry(curve, &mesh, &points, seconds, turns)));
    }
    entries
}

/// The time for the instruments is not in the run's seconds.
fn options(ordering: NetOrdering) -> Options {
    Options { ordering, instruments: true, ..Options::default() }
}

fn entry(curve: Curve, mesh: &Mesh, points: &Points, seconds: f64, turns: usize) -> Entry {
    let result = mesh.triangulation().expect("a run that was done has a result");
    let is_measured = result.simplex_count() <= MEASURED_SIMPLICES;
    let quality = is_measured.then(|| quality::measure(result).ok()).flatten();
    Entry {
        curve,
        n: points.len(),
        vertices: result.vertex_count(),
        touches: result.stats.touches,
        rounds: result.stats.rounds,
        max_degree: quality.map(|quality| quality.max_degree),
        instruments: Instruments::of(&result.stats),
        seconds,
        turns,
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
            "rounds",
            "log2 n + 2",
            "max degree",
            "max ply",
            "max ball intersections",
            "seconds",
            "ns/(n log2 n + m)",
            "turns",
        ],
    );
    for e in entries {
        table.add(row![
            e.curve.input,
            e.curve.dim,
            e.n,
            ordering_name(e.curve.ordering),
            number(e.size()),
            number(e.touches()),
            e.rounds,
            number((e.n as f64).log2() + 2.0),
            e.max_degree.map_or("-".to_string(), |degree| degree.to_string()),
            number(e.instruments.max_ply),
            number(e.instruments.max_ball_intersections),
            number(e.seconds),
            number(e.time()),
            e.turns,
        ]);
    }
    table
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
        let touches: Vec<f64> = found.iter().map(|e| e.touches()).collect();
        verdicts.push(Verdict::flat(&claim("touches/(n log2 n)"), &touches, 0.25));
        let excess =
            found.iter().map(|e| e.rounds as f64 - (e.n as f64).log2()).fold(f64::MIN, f64::max);
        verdicts.push(Verdict::at_most(&claim("rounds - log2 n"), excess, 2.0));
        verdicts.push(constant(&claim("largest degree"), &found, |e| e.max_degree.map(f64::from)));
        verdicts.push(constant(&claim("largest ply"), &found, |e| Some(e.instruments.max_ply)));
        let times: Vec<f64> = found.iter().map(|e| e.time()).collect();
        verdicts.push(Verdict::flat(&claim("time/(n log2 n + m)"), &times, 0.35));
        verdicts.push(fitted_law(&claim, &found));
    }
    verdicts.extend(ordering_verdicts(entries));
    verdicts
}

/// The law with a constant for each of its terms, as the theorem has it: touching an input takes less
/// time than making a vertex.
fn fitted_law(claim: &dyn Fn(&str) -> String, entries: &[&Entry]) -> Verdict {
    let terms = |e: &Entry| (e.n_log_n(), e.vertices as f64, 1e9 * e.seconds);
    let (a, b) = fit_sum(&entries.iter().map(|e| terms(e)).collect::<Vec<_>>());
    let ratios: Vec<f64> = entries
        .iter()
        .map(|e| {
            let (n_log_n, m, time) = terms(e);
            time / (a * n_log_n + b * m)
        })
        .collect();
    let law = format!("time/({} ns n log2 n + {} ns m)", number(a), number(b));
    Verdict::flat(&claim(&law), &ratios, 0.35)
}

fn constant(claim: &str, entries: &[&Entry], value: impl Fn(&Entry) -> Option<f64>) -> Verdict {
    let points: Vec<(f64, f64)> =
        entries.iter().filter_map(|e| value(e).map(|y| (e.n as f64, y))).collect();
    let mut verdict = Verdict::at_most(&format!("{claim}, exponent of n"), exponent(&points), 0.1);
    if let (Some(first), Some(last)) = (points.first(), points.last()) {
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
                ("m/n", Entry::size as fn(&Entry) -> f64),
                ("touches", Entry::touches),
                ("time", Entry::time),
            ] {
                let claim = format!(
                    "{input}, {dim}D: {what} of the deterministic ordering, farthest from the sampled one's"
                );
                verdicts.push(Verdict::at_most(&claim, farthest(figure), 0.3));
            }
        }
    }
    verdicts
}

fn plot(entries: &[Entry], name: &str, y: &str, value: impl Fn(&Entry) -> Option<f64>) -> Plot {
    let panel = |dim: usize| Panel {
        caption: format!("{dim}D"),
        x: Axis::log("n"),
        y: Axis::log(y),
        series: curves(entries)
            .into_iter()
            .filter(|(curve, _)| curve.dim == dim)
            .map(|(curve, found)| {
                let points = found.iter().filter_map(|e| Some((e.n as f64, value(e)?))).collect();
                Series::new(format!("{}, {}", curve.input, ordering_name(curve.ordering)), points)
            })
            .collect(),
    };
    Plot {
        name: name.to_string(),
        title: format!("Against n: {y}"),
        panels: DIMS.map(panel).to_vec(),
    }
}
