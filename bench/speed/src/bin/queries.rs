//! Meshes points and asks about random ones on one thread; prints nanoseconds a question, and the
//! bytes of the index. Run it on an idle machine, or under a tool that counts what it does.
//!
//!     queries <dim> <n> <queries> <delaunay | finished | uniform | gaussian | clusters | sphere> \
//!             <locate | nearest | linear | sibson | laplace>

use netmesh::query::{Among, Index, Interpolation, Method, Outside, Values};
use netmesh::{NONE, Triangulation};
use netmesh_speed::cases::{Case, Kind};
use netmesh_speed::inputs::Distribution;
use std::process::ExitCode;
use std::time::Instant;

/// Points spread evenly in the unit cube, other ones than those that are meshed.
fn points(dim: usize, meshed: usize, count: usize) -> Vec<f64> {
    let mut points = Distribution::Uniform.points(dim, meshed + count);
    points.drain(..meshed * dim);
    points
}

/// Asks; returns how many of the points are in the mesh.
fn ask(mesh: &Triangulation, index: &Index, points: &[f64], what: &str) -> netmesh::Result<usize> {
    let count = points.len() / mesh.dim;
    let interpolation = match what {
        "locate" => {
            let mut simplices = vec![NONE; count];
            index.locate(mesh, points, 1, &mut simplices)?;
            return Ok(simplices.iter().filter(|&&simplex| simplex != NONE).count());
        }
        "nearest" => {
            let (mut vertices, mut distances) = (vec![NONE; count], vec![0.0; count]);
            index.nearest(mesh, Among::Vertices, points, 1, &mut vertices, &mut distances)?;
            return Ok(count);
        }
        "sibson" => Interpolation::Sibson,
        "laplace" => Interpolation::Laplace,
        _ => Interpolation::Linear,
    };
    let values: Vec<f64> = mesh.points.chunks_exact(mesh.dim).map(|point| point[0]).collect();
    let values = Values { components: 1, values: &values };
    let mut out = vec![0.0; count];
    let method = Method { interpolation, outside: Outside::Nan };
    index.interpolate(mesh, method, values, points, 1, &mut out)?;
    let inside = out.iter().zip(points.chunks_exact(mesh.dim)).filter(|(x, _)| !x.is_nan());
    for (x, point) in inside.clone() {
        assert!((x - point[0]).abs() < 1e-12, "{x} is not {}", point[0]);
    }
    Ok(inside.count())
}

fn measure(case: &Case, queries: usize, what: &str) -> netmesh::Result<()> {
    let mut mesh = case.mesh()?;
    mesh.run(&case.options(), None)?;
    let Some(mesh) = mesh.triangulation() else { return Ok(()) };
    let points = points(case.dim, case.n, queries);
    let start = Instant::now();
    let index = Index::new(mesh)?;
    let made = start.elapsed();
    let start = Instant::now();
    let inside = ask(mesh, &index, &points, what)?;
    let nanoseconds = start.elapsed().as_nanos() as f64 / queries as f64;
    println!(
        "{what}: {nanoseconds:.0} ns a point, {inside} of {queries} inside; index of {} vertices: \
         {:.1} ms, {} bytes",
        mesh.vertex_count(),
        made.as_secs_f64() * 1e3,
        index.bytes()
    );
    Ok(())
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let parsed = match &arguments[..] {
        [dim, n, queries, kind, what] => (|| {
            let case =
                Case { dim: dim.parse().ok()?, n: n.parse().ok()?, kind: Kind::named(kind)? };
            Some((case, queries.parse().ok()?, what))
        })(),
        _ => None,
    };
    let Some((case, queries, what)) = parsed else {
        eprintln!("usage: queries <dim> <n> <queries> <kind> <locate | nearest | linear | ...>");
        return ExitCode::from(2);
    };
    match measure(&case, queries, what) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}
