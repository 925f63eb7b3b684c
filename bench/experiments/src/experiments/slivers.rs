//! Slivers: what a least dihedral angle costs in vertices and in time, and what it leaves.

use super::Context;
use crate::inputs::{self, Points};
use crate::report::Report;
use crate::row;
use crate::runner;
use crate::table::{Table, number};
use crate::verdict::Verdict;
use netmesh::validate::validate;
use netmesh::{Criterion, Mesh, Options, Output, quality};
use std::time::{Duration, Instant};

pub const NAME: &str = "slivers";
const ANGLES: [f64; 2] = [15.0, 18.0];

/// The most vertices beside those without an angle.
const COST: f64 = 1.08;

struct Entry {
    input: &'static str,
    n: usize,
    angle: f64,
    slivers: u64,
    left: u64,
    /// m/n without the angle and with it.
    sizes: [f64; 2],
    seconds: [f64; 2],
    level: u32,
}

pub fn run(context: &Context) -> Report {
    let entries: Vec<Entry> = sets(context)
        .into_iter()
        .flat_map(|(input, points)| ANGLES.map(|angle| measure(input, &points, angle)))
        .flatten()
        .collect();
    Report {
        name: NAME,
        title: "Slivers",
        text: text(),
        verdicts: entries.iter().flat_map(verdicts).collect(),
        tables: vec![table(&entries)],
        pictures: Vec::new(),
    }
}

fn text() -> String {
    "Well-spaced meshes in 3D with a radius-edge ratio of at most 2, without and with a least \
     dihedral angle. \"slivers\" are the simplices below the angle before, \"left\" after, those \
     at the hull included; \"time\" is that of the phase over that of the run without it. \
     \"level\" is that of the certificate, which holds all inputs to their bits."
        .to_string()
}

fn sets(context: &Context) -> Vec<(&'static str, Points)> {
    let [few, some, many] = context.pick([60; 3], [2_000, 5_000, 10_000], [2_000, 10_000, 100_000]);
    let side = context.pick(4, 12, 20);
    vec![
        ("uniform", inputs::uniform(3, few, 1)),
        ("uniform", inputs::uniform(3, some, 1)),
        ("uniform", inputs::uniform(3, many, 1)),
        ("gaussian", inputs::gaussian(3, some, 1)),
        ("clusters", inputs::gaussian_clusters(3, some, 1)),
        ("sphere", inputs::sphere(3, few, 1)),
        ("grid", inputs::grid(3, side, 0.0, 1)),
        ("grid moved by 1e-3", inputs::grid(3, side, 1e-3, 1)),
        ("grid moved by ulps", inputs::grid(3, side, 4.0 * f64::EPSILON, 1)),
        ("skew lines", inputs::skew_lines(few, 1)),
        ("pairs at 2^-20", inputs::close_pairs(3, few / 20, -20, 1)),
    ]
}

fn meshed(points: &Points, min_dihedral: f64) -> Option<(Box<Mesh>, f64)> {
    let options = Options {
        criterion: Criterion::RadiusEdge,
        output: Output::WellSpaced,
        min_dihedral,
        ..Options::default()
    };
    let begun = Instant::now();
    match runner::mesh(points, &options, Duration::from_secs(600)) {
        runner::Outcome::Done(mesh) => Some((mesh, begun.elapsed().as_secs_f64())),
        runner::Outcome::Stopped(_) => None,
    }
}

fn measure(input: &'static str, points: &Points, angle: f64) -> Option<Entry> {
    let (before, seconds_before) = meshed(points, 0.0)?;
    let (after, seconds_after) = meshed(points, angle)?;
    // Without the angle in its parameters no simplex is below it.
    let mut plain = before.triangulation()?.clone();
    plain.parameters.min_dihedral = angle;
    let mesh = after.triangulation()?;
    let [slivers, left] = [&plain, mesh].map(|mesh| {
        quality::measure(mesh).unwrap_or_else(|error| panic!("{error}")).below_min_dihedral
    });
    let report = validate(after.inputs(), mesh, 3).unwrap_or_else(|error| panic!("{error}"));
    let size = |vertices: usize| vertices as f64 / points.len() as f64;
    Some(Entry {
        input,
        n: points.len(),
        angle,
        slivers,
        left,
        sizes: [size(plain.vertex_count()), size(mesh.vertex_count())],
        seconds: [seconds_before, seconds_after],
        level: report.level,
    })
}

fn verdicts(entry: &Entry) -> Vec<Verdict> {
    let claim =
        |what: &str| format!("{}, n = {}, {} degrees: {what}", entry.input, entry.n, entry.angle);
    let [before, after] = entry.sizes;
    let mut verdicts = vec![Verdict::at_most(&claim("slivers left"), entry.left as f64, 0.0)];
    if entry.angle == ANGLES[0] && !entry.input.starts_with("grid moved") {
        verdicts.push(Verdict::at_most(&claim("times the vertices"), after / before, COST));
    }
    verdicts
}

fn table(entries: &[Entry]) -> Table {
    let mut table = Table::new(
        "slivers",
        &[
            "input",
            "n",
            "degrees",
            "slivers",
            "left",
            "m/n before",
            "m/n",
            "seconds",
            "time",
            "level",
        ],
    );
    for e in entries {
        let [before, after] = e.seconds;
        table.add(row![
            e.input,
            e.n,
            e.angle,
            e.slivers,
            e.left,
            number(e.sizes[0]),
            number(e.sizes[1]),
            number(after),
            number((after - before) / before),
            e.level,
        ]);
    }
    table
}
