//! Two skew lines: the Delaunay triangulation is quadratic, the mesh is linear.

use super::Context;
use crate::inputs;
use crate::peers::{Peer, PeerOutcome};
use crate::report::{Picture, Report};
use crate::row;
use crate::runner::{self, Outcome, in_parallel};
use crate::table::{Table, number};
use crate::verdict::{Verdict, exponent};
use netmesh::{Algorithm, Options};
use std::time::Duration;

pub const NAME: &str = "skew_lines";

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Method {
    Netmesh,
    Delaunay,
    Cgal,
}

struct Entry {
    method: Method,
    n: usize,
    /// Vertices, simplices and seconds.
    result: Result<(usize, usize, f64), String>,
}

impl Method {
    const ALL: [Method; 3] = [Method::Netmesh, Method::Delaunay, Method::Cgal];

    fn name(self) -> &'static str {
        match self {
            Method::Netmesh => "netmesh",
            Method::Delaunay => "plain Delaunay, netmesh",
            Method::Cgal => "plain Delaunay, CGAL",
        }
    }
}

pub fn run(context: &Context) -> Report {
    let sizes: &[usize] = context.pick(
        &[40, 80, 160],
        &[1_000, 2_000, 4_000, 10_000, 30_000],
        &[1_000, 2_000, 4_000, 10_000, 30_000, 100_000],
    );
    let curves =
        in_parallel(context.jobs, Method::ALL.to_vec(), |method| curve(context, method, sizes));
    let entries: Vec<Entry> = curves.into_iter().flatten().collect();
    Report {
        name: NAME,
        title: "Two skew lines: linear where Delaunay is quadratic",
        text: text(context),
        verdicts: verdicts(&entries),
        tables: vec![table(&entries)],
        pictures: vec![Picture::new(NAME, "n points on two skew lines")],
    }
}

fn text(context: &Context) -> String {
    format!(
        "Half of n points on each of two lines in space that are a unit apart and cross at a right \
         angle. Their Delaunay triangulation has (n/2 - 1)^2 tetrahedra; with Steiner points O(n) \
         are enough. A run of the plain triangulation may take {:.0} s; after one that does not \
         end, larger ones are not tried.",
        limit(context).as_secs_f64()
    )
}

fn limit(context: &Context) -> Duration {
    Duration::from_secs(context.pick(5, 10, 20))
}

fn curve(context: &Context, method: Method, sizes: &[usize]) -> Vec<Entry> {
    let mut entries: Vec<Entry> = Vec::new();
    for &n in sizes {
        let gave_up = entries.last().is_some_and(|entry| entry.result.is_err());
        let result =
            if gave_up { Err("not tried".to_string()) } else { measure(context, method, n) };
        entries.push(Entry { method, n, result });
    }
    entries
}

fn measure(context: &Context, method: Method, n: usize) -> Result<(usize, usize, f64), String> {
    let points = inputs::skew_lines(n, 1);
    let algorithm = match method {
        Method::Netmesh => Algorithm::Netmesh,
        Method::Delaunay => Algorithm::Delaunay,
        Method::Cgal => {
            return match context.peers.mesh(Peer::CgalDelaunay, &points, 2.0) {
                PeerOutcome::Done { mesh, seconds } if seconds <= limit(context).as_secs_f64() => {
                    let figures = mesh.figures(&points);
                    Ok((figures.vertices, figures.simplices, seconds))
                }
                PeerOutcome::Done { .. } => Err("timeout".to_string()),
                PeerOutcome::Failed(why) => Err(why),
                PeerOutcome::Absent => Err("-".to_string()),
            };
        }
    };
    let most = if method == Method::Netmesh { Duration::from_secs(120) } else { limit(context) };
    match runner::mesh(&points, &Options { algorithm, ..Options::default() }, most) {
        Outcome::Stopped(why) => Err(why.to_string()),
        outcome => {
            let mesh = outcome.mesh().ok_or("-")?;
            Ok((mesh.vertex_count(), mesh.simplex_count(), mesh.stats.seconds))
        }
    }
}

fn table(entries: &[Entry]) -> Table {
    let mut table = Table::new(
        "skew_lines",
        &["method", "n", "vertices", "tetrahedra", "tetrahedra/n", "(n/2 - 1)^2", "seconds"],
    );
    for Entry { method, n, result } in entries {
        let quadratic = (n / 2 - 1).pow(2);
        table.add(match result {
            Ok((vertices, simplices, seconds)) => row![
                method.name(),
                n,
                vertices,
                simplices,
                number(*simplices as f64 / *n as f64),
                quadratic,
                number(*seconds),
            ],
            Err(why) => row![method.name(), n, "-", why, "-", quadratic, "-"],
        });
    }
    table
}

fn cells(entries: &[Entry], method: Method) -> Vec<(f64, f64)> {
    let of = entries.iter().filter(|entry| entry.method == method);
    of.filter_map(|e| e.result.as_ref().ok().map(|r| (e.n as f64, r.1 as f64))).collect()
}

fn verdicts(entries: &[Entry]) -> Vec<Verdict> {
    let ours = cells(entries, Method::Netmesh);
    let per_input: Vec<f64> = ours.iter().map(|(n, cells)| cells / n).collect();
    let plain = cells(entries, Method::Delaunay);
    let exact = plain.iter().all(|(n, cells)| *cells == (n / 2.0 - 1.0).powi(2));
    vec![
        Verdict::flat("netmesh: tetrahedra per input", &per_input, 0.25),
        Verdict::at_most("netmesh: exponent of n in the tetrahedra", exponent(&ours), 1.05),
        Verdict::at_least(
            "plain Delaunay: exponent of n in the tetrahedra",
            exponent(&plain),
            1.95,
        ),
        Verdict::holds(
            "plain Delaunay: (n/2 - 1)^2 tetrahedra",
            "all",
            format!("{} sizes", plain.len()),
            exact && !plain.is_empty(),
        ),
    ]
}
