//! Size and point location against the spread: the reason for NETMESH.

mod settings;
mod verdicts;

use super::Context;
use crate::inputs::Points;
use crate::peers::{self, Peer, PeerOutcome};
use crate::report::{Picture, Report};
use crate::row;
use crate::runner::{self, Outcome, in_parallel};
use crate::table::{Table, number};
use crate::verdict::mean;
use netmesh::{Options, Triangulation};
use settings::{Kind, Setting};
use std::time::{Duration, Instant};

pub const NAME: &str = "spread";
const DIMS: [usize; 3] = [2, 3, 4];

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
    method: Method,
    runs: usize,
    cells: Vec<Cell>,
}

/// SVR's meshes of pairs in 4D have hundreds of vertices per input: fewer inputs, and the same law.
fn inputs_of(context: &Context, kind: Kind, dim: usize, method: Method) -> usize {
    match (kind, dim, method) {
        (Kind::Pairs, 4, Method::Svr) => context.pick(40, 60, 100),
        _ => context.pick(40, 1000, 1000),
    }
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
        for dim in DIMS {
            let n = inputs_of(context, kind, dim, Method::Netmesh { seed: 1 });
            let settings: Vec<Setting> = kind
                .exponents(context, dim)
                .into_iter()
                .map(|exponent| kind.setting(dim, n, exponent))
                .collect();
            let averaged = average(&curves, kind, dim);
            add_rows(&mut table, context, kind, dim, &settings, &averaged);
            report.verdicts.extend(verdicts::verdicts(kind, dim, &settings, &averaged));
        }
        for (figure, words) in [("size", "vertices per input"), ("touches", "touches per input")] {
            report.pictures.push(Picture {
                name: format!("spread_{}_{figure}", kind.name()),
                title: format!("{}: {words}", kind.title()),
            });
        }
    }
    report.tables.push(table);
    report
}

fn text(context: &Context) -> String {
    format!(
        "Law: a hierarchical mesh has O(n) vertices, and each input is considered O(log n) times \
         by the point location, whatever the spread. SVR needs Theta(log spread) of both.\n\n\
         n = {n}. (a) 20 nested clusters about the origin, with the gap per level growing from 2 \
         to 2^90. (b) Close pairs in the unit cube. (c) One point a level, at 2^(-pacing i) from \
         the origin: there is no gap to save up to a pacing of 2^1.5, and the law is Theta(n + n \
         log pacing). NETMESH: mean over as many inputs as the column runs says, default bound; \
         SVR: one input, at most {svr:.0} s and {most} vertices a run ({few} inputs for pairs in \
         4D); a curve ends where these do.\n\n\
         The peers mesh one of the inputs in a box of three times its bounding box, to radius-edge \
         sqrt(2) in 2D and 2 in 3D, each run a process with {peer:.0} s to live. \"inputs merged: \
         k\" means that k inputs are not vertices of the mesh. They refine everything, as SVR does \
         and as NETMESH does not; \"bound missed\" gives the worst ratio.\n\n\
         The plateau starts at the first gap of at least 2^12; the hump is looked for between 2^2 \
         and 2^10. The gap of pairs is their typical spacing over their distance.",
        n = inputs_of(context, Kind::Clusters, 2, Method::Svr),
        few = inputs_of(context, Kind::Pairs, 4, Method::Svr),
        svr = svr_limit(context).as_secs_f64(),
        most = SVR_VERTICES,
        peer = context.peers.limit.as_secs_f64(),
    )
}

fn seeds(context: &Context, kind: Kind, dim: usize) -> u64 {
    match (kind, dim) {
        (Kind::Chain, 4) => context.pick(1, 1, 3),
        (Kind::Chain, _) => context.pick(1, 1, 8),
        (_, 2) => context.pick(1, 4, 8),
        (_, 3) => context.pick(1, 2, 4),
        _ => context.pick(1, 1, 4),
    }
}

const SVR_VERTICES: u64 = 500_000;

fn svr_limit(context: &Context) -> Duration {
    Duration::from_millis(context.pick(200, 4_000, 8_000))
}

/// The long ones first.
fn tasks(context: &Context) -> Vec<(Kind, usize, Method)> {
    let mut tasks = Vec::new();
    for dim in [4, 3, 2] {
        for kind in Kind::ALL {
            tasks.push((kind, dim, Method::Svr));
            tasks.extend(
                (1..=seeds(context, kind, dim)).map(|seed| (kind, dim, Method::Netmesh { seed })),
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
    let begun = Instant::now();
    for exponent in kind.exponents(context, dim) {
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
    let seconds = begun.elapsed().as_secs_f64();
    eprintln!("  {}, {dim}D, {}: {seconds:.1} s", kind.name(), method.name());
    Curve { kind, dim, method, cells }
}

fn cell(context: &Context, kind: Kind, dim: usize, method: Method, exponent: f64) -> Cell {
    let n = inputs_of(context, kind, dim, method);
    let points = |seed| kind.points(dim, n, exponent, seed);
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
            of_peer(&points(1), context.peers.mesh(peer, &points(1), bound), bound)
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

fn of_peer(points: &Points, outcome: PeerOutcome, bound: f64) -> Cell {
    match outcome {
        PeerOutcome::Done { mesh, .. } => match mesh.figures(points) {
            figures if figures.lost > 0 => Cell::Note(format!("inputs merged: {}", figures.lost)),
            figures if figures.worst_radius_edge > 1.01 * bound => {
                Cell::Note(format!("bound missed: {:.1e}", figures.worst_radius_edge))
            }
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
        method: ours[0].method,
        runs: ours.len(),
        cells: (0..ours[0].cells.len()).map(|i| mean_cell(&ours, i)).collect(),
    }];
    for curve in curves.iter().filter(of_this).filter(|curve| !is_ours(curve)) {
        all.push(Averaged {
            name: curve.method.name(),
            method: curve.method,
            runs: 1,
            cells: curve.cells.clone(),
        });
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
                inputs_of(context, kind, dim, curve.method),
                curve.runs,
                size,
                touches,
            ]);
        }
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
