//! Sizes of finished meshes beside those of the meshers that people use.

use super::Context;
use crate::inputs::{self, Points};
use crate::peers::{self, Peer, PeerOutcome};
use crate::report::{Picture, Report};
use crate::row;
use crate::runner::{self, in_parallel};
use crate::simplicial::{Figures, Simplicial};
use crate::table::{Table, number};
use crate::verdict::Verdict;
use netmesh::{Criterion, Options, Output};
use std::f64::consts::SQRT_2;
use std::time::Duration;

pub const NAME: &str = "sizes";

/// An input to be refined to a radius-edge bound.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Case {
    input: &'static str,
    dim: usize,
    n: usize,
    bound: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Mesher {
    Netmesh,
    Peer(Peer),
}

struct Entry {
    case: Case,
    mesher: Mesher,
    /// Figures and seconds, or why there are none.
    result: Result<(Figures, f64), String>,
}

impl Mesher {
    fn name(self) -> &'static str {
        match self {
            Mesher::Netmesh => "netmesh",
            Mesher::Peer(peer) => peer.name(),
        }
    }
}

impl Case {
    fn points(&self) -> Points {
        inputs::named(self.input, self.dim, self.n, 1)
    }

    fn bound_name(&self) -> &'static str {
        if self.bound == SQRT_2 { "1.414" } else { "2.0" }
    }
}

pub fn run(context: &Context) -> Report {
    let tasks: Vec<(Case, Mesher)> = cases(context)
        .into_iter()
        .flat_map(|case| {
            let peers = peers::meshers(case.dim).iter().map(|&peer| Mesher::Peer(peer));
            std::iter::once(Mesher::Netmesh).chain(peers).map(move |mesher| (case, mesher))
        })
        .collect();
    let entries = in_parallel(context.jobs, tasks, |(case, mesher)| Entry {
        case,
        mesher,
        result: measure(context, &case, mesher),
    });
    let mut verdicts = size_verdicts(&entries);
    verdicts.extend(bound_verdicts(&entries));
    verdicts.extend(hierarchical_verdicts(context));
    Report {
        name: NAME,
        title: "Finished meshes are as small as anybody's",
        text: text(),
        verdicts,
        tables: vec![table(&entries)],
        pictures: vec![Picture {
            name: NAME.to_string(),
            title: format!("Vertices per input of finished meshes, n = {}", largest(&entries)),
        }],
    }
}

fn text() -> String {
    "Every mesher refines the same inputs until every simplex has the bound on circumradius over \
     shortest edge: 2.0 and 1.414 in 3D, 1.414 (20.7 degrees) in 2D. TetGen 1.5 runs with \
     `pq2.0/0O0/0` and `pq1.414214/0O0/0`, Triangle with `pq20.7` (its published method, with \
     off-centres; through the PyPI module, which is not part of this project), CGAL's Mesh_2 with \
     its bound on the angle, all in a box of three times the inputs' bounding box; netmesh with \
     `NM_OUTPUT_WELL_SPACED` in its root ball. The domains are equivalent, not equal, so sizes are \
     compared in total and counting the vertices in the inputs' bounding box alone. \"worst\" is \
     the largest ratio of the simplices in that box. Seconds were taken with another run beside."
        .to_string()
}

fn cases(context: &Context) -> Vec<Case> {
    let sizes: &[usize] = context.pick(&[60], &[10_000], &[10_000, 100_000]);
    let mut cases = Vec::new();
    for &n in sizes.iter().rev() {
        for (dim, bound) in [(3, SQRT_2), (3, 2.0), (2, SQRT_2)] {
            cases.extend(inputs::NAMES.map(|input| Case { input, dim, n, bound }));
        }
    }
    cases
}

fn measure(context: &Context, case: &Case, mesher: Mesher) -> Result<(Figures, f64), String> {
    let points = case.points();
    match mesher {
        Mesher::Netmesh => {
            let options = Options {
                output: Output::WellSpaced,
                criterion: Criterion::RadiusEdge,
                quality_bound: case.bound,
                ..Options::default()
            };
            let outcome = runner::mesh(&points, &options, Duration::from_secs(300));
            let mesh = outcome.mesh().ok_or("timeout")?;
            Ok((Simplicial::from(mesh).figures(&points), mesh.stats.seconds))
        }
        Mesher::Peer(peer) => match context.peers.mesh(peer, &points, case.bound) {
            PeerOutcome::Done { mesh, seconds } => Ok((mesh.figures(&points), seconds)),
            PeerOutcome::Failed(why) => Err(why),
            PeerOutcome::Absent => Err("-".to_string()),
        },
    }
}

fn table(entries: &[Entry]) -> Table {
    let mut table = Table::new(
        "sizes",
        &[
            "input",
            "dim",
            "n",
            "bound",
            "mesher",
            "m/n",
            "inside/n",
            "simplices",
            "worst",
            "note",
            "seconds",
        ],
    );
    for Entry { case, mesher, result } in entries {
        let Case { input, dim, n, .. } = case;
        let (bound, name) = (case.bound_name(), mesher.name());
        table.add(match result {
            Ok((figures, seconds)) => row![
                input,
                dim,
                n,
                bound,
                name,
                number(figures.vertices as f64 / *n as f64),
                number(figures.inside as f64 / *n as f64),
                figures.simplices,
                number(figures.worst_radius_edge),
                if figures.lost == 0 {
                    "".to_string()
                } else {
                    format!("inputs merged: {}", figures.lost)
                },
                number(*seconds),
            ],
            Err(why) => row![input, dim, n, bound, name, "-", "-", "-", "-", why, "-"],
        });
    }
    table
}

fn find<'a>(entries: &'a [Entry], case: &Case, mesher: Mesher) -> Option<&'a Figures> {
    let entry = entries.iter().find(|entry| entry.case == *case && entry.mesher == mesher)?;
    entry.result.as_ref().ok().map(|(figures, _)| figures)
}

/// For each input, bound and peer: our size over the peer's, the worst of all n.
fn size_verdicts(entries: &[Entry]) -> Vec<Verdict> {
    let mut verdicts = Vec::new();
    let mut seen: Vec<(&str, usize, f64, Mesher)> = Vec::new();
    for entry in entries.iter().filter(|entry| entry.mesher != Mesher::Netmesh) {
        let Case { input, dim, bound, .. } = entry.case;
        let key = (input, dim, bound, entry.mesher);
        if seen.contains(&key) {
            continue;
        }
        seen.push(key);
        let (mut total, mut inside) = (f64::NAN, f64::NAN);
        for other in
            entries.iter().filter(|e| (e.case.input, e.case.dim, e.case.bound, e.mesher) == key)
        {
            let ours = find(entries, &other.case, Mesher::Netmesh);
            if let (Some(ours), Some(theirs)) = (ours, find(entries, &other.case, entry.mesher)) {
                total = total.max(ours.vertices as f64 / theirs.vertices as f64);
                inside = inside.max(ours.inside as f64 / theirs.inside as f64);
            }
        }
        let limit = if entry.mesher == Mesher::Peer(Peer::Triangle) { 1.05 } else { 1.0 };
        let claim = format!(
            "{input}, {dim}D, {}: m over that of {}",
            entry.case.bound_name(),
            entry.mesher.name()
        );
        let mut verdict = Verdict::at_most(&claim, total, limit);
        if !total.is_nan() {
            verdict.measured += &format!(" (inside: {})", number(inside));
        }
        verdicts.push(verdict);
    }
    verdicts
}

fn bound_verdicts(entries: &[Entry]) -> Vec<Verdict> {
    let of = |dim: usize, bound: f64| {
        let worst = entries
            .iter()
            .filter(|e| (e.case.dim, e.case.bound, e.mesher) == (dim, bound, Mesher::Netmesh))
            .filter_map(|e| {
                e.result.as_ref().ok().map(|(figures, _)| figures.worst_radius_edge / bound)
            })
            .fold(f64::NAN, f64::max);
        let name = if bound == SQRT_2 { "1.414" } else { "2.0" };
        let claim = format!("netmesh, {dim}D, {name}: largest ratio of any simplex over the bound");
        Verdict::at_most(&claim, worst, 1.000001)
    };
    vec![of(2, SQRT_2), of(3, SQRT_2), of(3, 2.0)]
}

/// The default criterion, hierarchical.
fn hierarchical_verdicts(context: &Context) -> Vec<Verdict> {
    let n = context.pick(200, 100_000, 100_000);
    in_parallel(context.jobs, vec![(2, 3.0), (3, 2.6)], |(dim, limit)| {
        let points = inputs::uniform(dim, n, 1);
        let outcome = runner::mesh(&points, &Options::default(), Duration::from_secs(120));
        let size = outcome.mesh().map_or(f64::NAN, |mesh| mesh.vertex_count() as f64 / n as f64);
        let claim = format!("uniform {n}, {dim}D, hierarchical, default aspect bound: m/n");
        Verdict::at_most(&claim, size, limit)
    })
}

fn largest(entries: &[Entry]) -> usize {
    entries.iter().map(|entry| entry.case.n).max().unwrap_or(0)
}
