//! Size and point location against the spread: the reason for NETMESH.

use super::Context;
use crate::inputs::{self, Points};
use crate::peers::{self, Peer, PeerOutcome};
use crate::plot::{Axis, Panel, Plot, Series};
use crate::report::Report;
use crate::row;
use crate::runner::{self, Outcome, in_parallel};
use crate::table::{Table, number};
use crate::verdict::{Verdict, fit_line, mean, median, variation};
use netmesh::{Options, Triangulation};
use std::time::Duration;

pub const NAME: &str = "spread";
const DIMS: [usize; 3] = [2, 3, 4];
const LEVELS: usize = 20;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Clusters,
    Pairs,
    Chain,
}

/// What is changed along a curve: the gap of a level, the pairs' distance, the pacing.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Setting {
    /// log2 of the gap per level, of 1 / distance, or of the pacing.
    exponent: f64,
    /// log2 of the empty space around a cluster or pair over its size; none in a chain.
    log_gap: Option<f64>,
    /// log2 of the spread, but for a constant.
    log_spread: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Method {
    Netmesh { seed: u64 },
    Svr,
    Peer(Peer),
}

/// One point of a curve.
#[derive(Clone, Debug)]
enum Cell {
    Size { per_input: f64, touches: Option<f64> },
    Note(String),
}

struct Curve {
    kind: Kind,
    dim: usize,
    method: Method,
    cells: Vec<Cell>,
}

/// Means over the seeds of NETMESH, or the one run of another method.
struct Averaged {
    name: &'static str,
    runs: usize,
    cells: Vec<Cell>,
}

impl Kind {
    const ALL: [Kind; 3] = [Kind::Clusters, Kind::Pairs, Kind::Chain];

    fn name(self) -> &'static str {
        match self {
            Kind::Clusters => "clusters",
            Kind::Pairs => "pairs",
            Kind::Chain => "chain",
        }
    }

    fn title(self) -> &'static str {
        match self {
            Kind::Clusters => "20 nested clusters of 50 points",
            Kind::Pairs => "500 close pairs",
            Kind::Chain => "One point a level",
        }
    }

    fn axis(self) -> Axis {
        match self {
            Kind::Clusters => Axis::log("log2 of the spread"),
            Kind::Pairs => Axis::log("log2 of 1 / the pairs' distance"),
            Kind::Chain => Axis::linear("log2 of the pacing"),
        }
    }

    fn exponents(self, context: &Context) -> Vec<f64> {
        let all: &[f64] = match self {
            Kind::Clusters => &[
                1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 10.0, 12.0, 16.0, 24.0, 32.0, 48.0, 64.0,
                90.0,
            ],
            Kind::Pairs => &[
                4.0, 6.0, 8.0, 10.0, 12.0, 14.0, 16.0, 18.0, 20.0, 24.0, 28.0, 32.0, 36.0, 40.0,
                44.0,
            ],
            Kind::Chain => &[0.02, 0.1, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75, 1.9],
        };
        let step = context.pick(4, 1, 1);
        all.iter().copied().step_by(step).collect()
    }

    fn setting(self, context: &Context, dim: usize, exponent: f64) -> Setting {
        let n = inputs_of(context) as f64;
        match self {
            Kind::Clusters => Setting {
                exponent,
                log_gap: Some(exponent),
                log_spread: exponent * (LEVELS - 1) as f64,
            },
            Kind::Pairs => {
                let spacing = (n / 2.0).log2() / dim as f64;
                Setting { exponent, log_gap: Some(exponent - spacing), log_spread: exponent }
            }
            Kind::Chain => Setting { exponent, log_gap: None, log_spread: exponent * (n - 1.0) },
        }
    }

    fn points(self, context: &Context, dim: usize, exponent: f64, seed: u64) -> Points {
        let n = inputs_of(context);
        match self {
            Kind::Clusters => inputs::nested_clusters(dim, LEVELS, n / LEVELS, exponent, seed),
            Kind::Pairs => inputs::close_pairs(dim, n / 2, -(exponent as i32), seed),
            Kind::Chain => inputs::nested_clusters(dim, n, 1, exponent, seed),
        }
    }
}

fn inputs_of(context: &Context) -> usize {
    context.pick(40, 1000, 1000)
}

impl Method {
    fn name(self) -> &'static str {
        match self {
            Method::Netmesh { .. } => "NETMESH",
            Method::Svr => "SVR",
            Method::Peer(peer) => peer.name(),
        }
    }
}

pub fn run(context: &Context) -> Report {
    let mut report = Report {
        name: NAME,
        title: "Size and point location do not grow with the spread (Theorems 9 and 30)",
        text: text(context),
        ..Report::default()
    };
    let curves = in_parallel(context.jobs, tasks(context), |(kind, dim, method)| {
        curve(context, kind, dim, method)
    });
    let mut table = Table::new(
        "spread",
        &[
            "input",
            "dim",
            "method",
            "log2 exponent",
            "log2 gap",
            "log2 spread",
            "n",
            "runs",
            "m/n",
            "touches/n",
        ],
    );
    for kind in Kind::ALL {
        let mut panels = [Vec::new(), Vec::new()];
        for dim in DIMS {
            let settings: Vec<Setting> = kind
                .exponents(context)
                .into_iter()
                .map(|exponent| kind.setting(context, dim, exponent))
                .collect();
            let averaged = average(&curves, kind, dim);
            add_rows(&mut table, context, kind, dim, &settings, &averaged);
            report.verdicts.extend(verdicts(kind, dim, &settings, &averaged));
            for (panels, touches) in panels.iter_mut().zip([false, true]) {
                panels.push(panel(kind, dim, &settings, &averaged, touches));
            }
        }
        let [sizes, touches] = panels;
        for (what, words, panels) in
            [("size", "vertices per input", sizes), ("touches", "touches per input", touches)]
        {
            let name = format!("spread_{}_{what}", kind.name());
            report.plots.push(Plot { name, title: format!("{}: {words}", kind.title()), panels });
        }
    }
    report.tables.push(table);
    report
}

fn text(context: &Context) -> String {
    format!(
        "Law: a hierarchical mesh has O(n) vertices, and each input is considered O(log n) times by the \
         point location, whatever the spread. SVR needs Theta(log spread) of both.\n\n\
         n = {n}. (a) 20 nested clusters about the origin, with the gap per level growing from 2 to 2^90. \
         (b) Close pairs in the unit cube. (c) One point a level, at 2^(-pacing i) from the origin: there \
         is no gap to save, and the law is Theta(n + n log pacing). NETMESH: mean over {seeds} inputs (2D) \
         or {others} (3D, 4D), default bound; SVR: one input, at most {svr:.0} s and {most} vertices a \
         run; a curve ends where these do.\n\n\
         The peers mesh one of the inputs in a box of three times its bounding box, to radius-edge \
         sqrt(2) in 2D and 2 in 3D, each run a process with {peer:.0} s to live. \"inputs merged: k\" \
         means that k inputs are not vertices of the mesh. They refine everything, as SVR does and as \
         NETMESH does not.\n\n\
         The plateau starts at the first gap of at least 2^12; the hump is looked for between 2^2 and \
         2^10. The gap of pairs is their typical spacing over their distance.",
        n = inputs_of(context),
        seeds = seeds(context, 2),
        others = seeds(context, 3),
        svr = svr_limit(context).as_secs_f64(),
        most = SVR_VERTICES,
        peer = context.peers.limit.as_secs_f64(),
    )
}

fn seeds(context: &Context, dim: usize) -> u64 {
    if dim == 2 { context.pick(1, 5, 8) } else { context.pick(1, 3, 4) }
}

const SVR_VERTICES: u64 = 500_000;

fn svr_limit(context: &Context) -> Duration {
    Duration::from_secs(context.pick(1, 4, 8))
}

/// The long ones first.
fn tasks(context: &Context) -> Vec<(Kind, usize, Method)> {
    let mut tasks = Vec::new();
    for dim in [4, 3, 2] {
        for kind in Kind::ALL {
            tasks.push((kind, dim, Method::Svr));
            tasks.extend(
                (1..=seeds(context, dim)).map(|seed| (kind, dim, Method::Netmesh { seed })),
            );
            let peers = peers::meshers(dim).iter().copied().filter(|&peer| context.peers.has(peer));
            tasks.extend(peers.map(|peer| (kind, dim, Method::Peer(peer))));
        }
    }
    tasks
}

/// After a run that took too long or grew too large, longer ones are not tried.
fn curve(context: &Context, kind: Kind, dim: usize, method: Method) -> Curve {
    let mut cells: Vec<Cell> = Vec::new();
    for exponent in kind.exponents(context) {
        let gave_up = cells.last().is_some_and(|cell| match cell {
            Cell::Note(note) => ["timeout", "too large", "not tried"].contains(&note.as_str()),
            Cell::Size { .. } => false,
        });
        cells.push(if gave_up {
            Cell::Note("not tried".to_string())
        } else {
            cell(context, kind, dim, method, exponent)
        });
    }
    Curve { kind, dim, method, cells }
}

fn cell(context: &Context, kind: Kind, dim: usize, method: Method, exponent: f64) -> Cell {
    let points = |seed| kind.points(context, dim, exponent, seed);
    match method {
        Method::Netmesh { seed } => {
            let limit = Duration::from_secs(120);
            of_run(&points(seed), runner::mesh(&points(seed), &Options::default(), limit))
        }
        Method::Svr => {
            let options = runner::svr(SVR_VERTICES);
            of_run(&points(1), runner::mesh(&points(1), &options, svr_limit(context)))
        }
        Method::Peer(peer) => {
            let bound = if dim == 2 { std::f64::consts::SQRT_2 } else { 2.0 };
            of_peer(&points(1), context.peers.mesh(peer, &points(1), bound))
        }
    }
}

fn of_run(points: &Points, outcome: Outcome) -> Cell {
    match &outcome {
        Outcome::Done(mesh) => {
            mesh.triangulation().map_or(Cell::Note("-".to_string()), |mesh| size(points, mesh))
        }
        Outcome::Stopped(why) => Cell::Note(why.to_string()),
    }
}

fn size(points: &Points, mesh: &Triangulation) -> Cell {
    let n = points.len() as f64;
    Cell::Size {
        per_input: mesh.vertex_count() as f64 / n,
        touches: Some(mesh.stats.touches as f64 / n),
    }
}

fn of_peer(points: &Points, outcome: PeerOutcome) -> Cell {
    match outcome {
        PeerOutcome::Done { mesh, .. } => match mesh.figures(points) {
            figures if figures.lost > 0 => Cell::Note(format!("inputs merged: {}", figures.lost)),
            figures => Cell::Size {
                per_input: figures.vertices as f64 / points.len() as f64,
                touches: None,
            },
        },
        PeerOutcome::Failed(why) => Cell::Note(why),
        PeerOutcome::Absent => Cell::Note("-".to_string()),
    }
}

fn average(curves: &[Curve], kind: Kind, dim: usize) -> Vec<Averaged> {
    let of_this = |curve: &&Curve| (curve.kind, curve.dim) == (kind, dim);
    let is_ours = |curve: &&Curve| matches!(curve.method, Method::Netmesh { .. });
    let ours: Vec<&Curve> = curves.iter().filter(of_this).filter(is_ours).collect();
    let mut all = vec![Averaged {
        name: "NETMESH",
        runs: ours.len(),
        cells: (0..ours[0].cells.len()).map(|i| mean_cell(&ours, i)).collect(),
    }];
    for curve in curves.iter().filter(of_this).filter(|curve| !is_ours(curve)) {
        all.push(Averaged { name: curve.method.name(), runs: 1, cells: curve.cells.clone() });
    }
    all
}

fn mean_cell(curves: &[&Curve], index: usize) -> Cell {
    let (mut sizes, mut touches) = (Vec::new(), Vec::new());
    for curve in curves {
        match &curve.cells[index] {
            Cell::Size { per_input, touches: count } => {
                sizes.push(*per_input);
                touches.extend(*count);
            }
            Cell::Note(note) => return Cell::Note(note.clone()),
        }
    }
    Cell::Size { per_input: mean(&sizes), touches: Some(mean(&touches)) }
}

fn add_rows(
    table: &mut Table,
    context: &Context,
    kind: Kind,
    dim: usize,
    settings: &[Setting],
    averaged: &[Averaged],
) {
    for curve in averaged {
        for (setting, cell) in settings.iter().zip(&curve.cells) {
            let (size, touches) = match cell {
                Cell::Size { per_input, touches } => {
                    (number(*per_input), touches.map_or("-".to_string(), number))
                }
                Cell::Note(note) => (note.clone(), "-".to_string()),
            };
            table.add(row![
                kind.name(),
                dim,
                curve.name,
                setting.exponent,
                setting.log_gap.map_or("-".to_string(), number),
                number(setting.log_spread),
                inputs_of(context),
                curve.runs,
                size,
                touches,
            ]);
        }
    }
}

fn panel(
    kind: Kind,
    dim: usize,
    settings: &[Setting],
    averaged: &[Averaged],
    touches: bool,
) -> Panel {
    let y_label = if touches { "touches / n" } else { "m / n" };
    let series = averaged.iter().filter_map(|curve| {
        let x = |setting: &Setting| match kind {
            Kind::Clusters => setting.log_spread,
            _ => setting.exponent,
        };
        let points: Vec<(f64, f64)> =
            values(settings, curve, touches).map(|(s, y)| (x(s), y)).collect();
        (!points.is_empty()).then(|| Series::new(curve.name, points))
    });
    Panel {
        caption: format!("{dim}D"),
        x: kind.axis(),
        y: if kind == Kind::Chain { Axis::linear(y_label) } else { Axis::log(y_label) },
        series: series.collect(),
    }
}

/// The settings with a figure, and the figure: size or touches per input.
fn values<'a>(
    settings: &'a [Setting],
    curve: &'a Averaged,
    of_touches: bool,
) -> impl Iterator<Item = (&'a Setting, f64)> {
    settings.iter().zip(&curve.cells).filter_map(move |(setting, cell)| match cell {
        Cell::Size { touches, .. } if of_touches => touches.map(|touches| (setting, touches)),
        Cell::Size { per_input, .. } => Some((setting, *per_input)),
        Cell::Note(_) => None,
    })
}

fn verdicts(kind: Kind, dim: usize, settings: &[Setting], averaged: &[Averaged]) -> Vec<Verdict> {
    let mut verdicts = Vec::new();
    for curve in averaged.iter().filter(|curve| curve.name == "NETMESH") {
        if kind == Kind::Chain {
            verdicts.extend(chain_verdicts(dim, settings, curve));
        } else {
            verdicts.extend(plateau_verdicts(kind, dim, settings, curve));
        }
    }
    for curve in averaged.iter().filter(|curve| curve.name == "SVR") {
        for (touches, words) in [(false, "vertices"), (true, "touches")] {
            let points: Vec<(f64, f64)> =
                values(settings, curve, touches).map(|(s, y)| (s.log_spread, y)).collect();
            let claim = format!(
                "{}, {dim}D: SVR's {words} are linear in log spread (R^2 of a line)",
                kind.name()
            );
            verdicts.push(Verdict::at_least(&claim, fit_line(&points).determination, 0.98));
        }
    }
    verdicts
}

fn plateau_verdicts(
    kind: Kind,
    dim: usize,
    settings: &[Setting],
    curve: &Averaged,
) -> Vec<Verdict> {
    const PLATEAU: f64 = 12.0;
    let mut verdicts = Vec::new();
    for (touches, words) in [(false, "m/n"), (true, "touches/n")] {
        let all: Vec<(f64, f64)> = values(settings, curve, touches)
            .filter_map(|(setting, y)| setting.log_gap.map(|gap| (gap, y)))
            .collect();
        let plateau: Vec<f64> = all.iter().filter(|p| p.0 >= PLATEAU).map(|p| p.1).collect();
        let ratio = match (plateau.first(), plateau.last()) {
            (Some(first), Some(last)) => last / first,
            _ => f64::NAN,
        };
        let place = format!("{}, {dim}D", kind.name());
        let claim = format!("{place}: {words} at the largest spread over the plateau's start");
        verdicts.push(Verdict::at_most(&claim, ratio, 1.15));
        if !touches {
            let hump = all.iter().filter(|p| (2.0..=10.0).contains(&p.0)).map(|p| p.1);
            let claim = format!("{place}: largest m/n between gap 2^2 and 2^10 over the plateau");
            verdicts.push(Verdict::at_most(
                &claim,
                hump.fold(0.0, f64::max) / median(&plateau),
                1.5,
            ));
        }
    }
    verdicts
}

fn chain_verdicts(dim: usize, settings: &[Setting], curve: &Averaged) -> Vec<Verdict> {
    let sizes: Vec<(f64, f64)> =
        values(settings, curve, false).map(|(s, y)| (s.exponent, y)).collect();
    let line = fit_line(&sizes);
    let claim = format!(
        "chain, {dim}D: m/n is a line in log pacing, {} + {} log2 pacing (R^2)",
        number(line.intercept),
        number(line.slope)
    );
    // Below a pacing of 2^(1/4) the input is one cluster rather than a chain.
    let touches: Vec<f64> =
        values(settings, curve, true).filter(|(s, _)| s.exponent >= 0.25).map(|(_, y)| y).collect();
    let claim_touches = format!("chain, {dim}D: touches/n, pacing 2^(1/4) to 2^1.9");
    let growth = match (touches.first(), touches.last()) {
        (Some(first), Some(last)) if touches.len() > 1 => last / first,
        _ => f64::NAN,
    };
    let mut flat = Verdict::at_most(&claim_touches, growth, 1.15);
    if !growth.is_nan() {
        flat.measured += &format!(" (extremes {:.0} % apart)", 100.0 * variation(&touches));
    }
    vec![Verdict::at_least(&claim, line.determination, 0.98), flat]
}
