//! Sizes: no simplex that meets the box of the inputs is larger than was asked for, few are much
//! smaller, and what cannot be asked for is refused.

use crate::random::Random;
use netmesh::options::SizeFn;
use netmesh::validate::validate;
use netmesh::{Criterion, Error, ErrorKind, Mesh, NONE, Options, Output, Triangulation};
use std::cell::{Cell, RefCell};

fn well_spaced() -> Options {
    Options { output: Output::WellSpaced, criterion: Criterion::RadiusEdge, ..Options::default() }
}

/// Points in the unit cube, its corners first.
fn cube(dim: usize, count: usize, seed: u64) -> Vec<f64> {
    let corners =
        (0..1usize << dim).flat_map(|corner| (0..dim).map(move |k| (corner >> k & 1) as f64));
    corners.chain(Random::new(seed).uniform(dim, count)).collect()
}

fn run(dim: usize, points: &[f64], options: &Options, size: Option<&SizeFn<'_>>) -> Mesh {
    let mut mesh = Mesh::new(dim, points.len() / dim, points, 0).unwrap();
    mesh.run_sized(options, size, None).unwrap();
    assert_sound(&mesh);
    mesh
}

fn assert_sound(mesh: &Mesh) {
    let report = validate(mesh.inputs(), mesh.triangulation().unwrap(), 3).unwrap();
    assert_eq!((report.level, report.violations), (3, 0), "{report:?}");
}

fn refusal(dim: usize, options: &Options, size: Option<&SizeFn<'_>>) -> Error {
    let points = cube(dim, 30, 1);
    let mut mesh = Mesh::new(dim, points.len() / dim, &points, 0).unwrap();
    let error = mesh.run_sized(options, size, None).unwrap_err();
    assert!(mesh.triangulation().is_none());
    error
}

fn distance(p: &[f64], q: &[f64]) -> f64 {
    p.iter().zip(q).map(|(p, q)| (p - q).powi(2)).sum::<f64>().sqrt()
}

/// The radius of the ball through `dim + 1` points: Gaussian elimination with pivots.
fn circumradius(points: &[&[f64]]) -> f64 {
    let dim = points.len() - 1;
    let row = |point: &&[f64]| -> Vec<f64> {
        let offset = point.iter().zip(points[0]).map(|(x, origin)| x - origin);
        let mut row: Vec<f64> = offset.collect();
        row.push(0.5 * row.iter().map(|x| x * x).sum::<f64>());
        row
    };
    let mut rows: Vec<Vec<f64>> = points[1..].iter().map(row).collect();
    for column in 0..dim {
        let pivot = (column..dim)
            .max_by(|&a, &b| rows[a][column].abs().total_cmp(&rows[b][column].abs()))
            .unwrap();
        rows.swap(column, pivot);
        let own = rows[column].clone();
        for (at, row) in rows.iter_mut().enumerate().filter(|&(at, _)| at != column) {
            let factor = row[column] / own[column];
            row.iter_mut().zip(&own).for_each(|(x, own)| *x -= factor * own);
            assert!(row[column].abs() < 1e-6, "row {at}");
        }
    }
    (0..dim).map(|k| (rows[k][dim] / rows[k][k]).powi(2)).sum::<f64>().sqrt()
}

/// The circumradius of the regular simplex with edges of length 1.
fn regular(dim: usize) -> f64 {
    (dim as f64 / (2.0 * (dim as f64 + 1.0))).sqrt()
}

fn clamped(point: &[f64]) -> Vec<f64> {
    point.iter().map(|x| x.clamp(0.0, 1.0)).collect()
}

/// The least size at a vertex.
fn least(points: &[&[f64]], size: &dyn Fn(&[f64]) -> f64) -> f64 {
    points.iter().map(|point| size(&clamped(point))).fold(f64::INFINITY, f64::min)
}

/// Measures the simplices that meet the unit cube: the largest circumradius and edge over what the
/// field allows; of those in it, the mean of their edges over the field.
fn measured(mesh: &Triangulation, size: &dyn Fn(&[f64]) -> f64) -> [f64; 3] {
    let (mut radius, mut edge, mut sum, mut count) = (0.0f64, 0.0f64, 0.0, 0.0);
    for simplex in 0..mesh.simplex_count() {
        let points: Vec<&[f64]> = mesh.simplex(simplex).iter().map(|&v| mesh.point(v)).collect();
        let is_beside = (0..mesh.dim)
            .any(|k| points.iter().all(|p| p[k] < 0.0) || points.iter().all(|p| p[k] > 1.0));
        if is_beside {
            continue;
        }
        let allowed = least(&points, size);
        radius = radius.max(circumradius(&points) / (regular(mesh.dim) * allowed));
        let is_inside = points.iter().all(|p| p.iter().all(|x| (0.0..=1.0).contains(x)));
        for (i, p) in points.iter().enumerate() {
            for q in &points[..i] {
                edge = edge.max(distance(p, q) / allowed);
                if is_inside {
                    sum += distance(p, q) / (0.5 * (size(p) + size(q)));
                    count += 1.0;
                }
            }
        }
    }
    [radius, edge, sum / count]
}

/// A largest edge that makes some thousands of simplices.
fn largest(dim: usize) -> f64 {
    [0.04, 0.15, 0.45, 1.1][dim - 2]
}

#[test]
fn no_edge_is_longer_than_asked_for() {
    for dim in 2..=5 {
        let max_edge = largest(dim);
        let options = Options { max_edge, ..well_spaced() };
        let mesh = run(dim, &cube(dim, 20, 1), &options, None);
        let mesh = mesh.triangulation().unwrap();
        let [radius, edge, mean] = measured(mesh, &|_| max_edge);
        assert!(radius <= 1.0 && edge <= 1.0, "{dim}D: {radius}, {edge}");
        assert!((0.6..=1.0).contains(&mean), "{dim}D: mean {mean}");
        assert!(edge > 0.95, "{dim}D: {edge}");
        assert!(mesh.sizes.is_empty());
    }
}

/// A field that is smaller round a corner, and the bound of aspects too.
#[test]
fn no_circumradius_is_larger_than_asked_for() {
    for dim in 2..=5 {
        for criterion in [Criterion::RadiusEdge, Criterion::VoronoiAspect] {
            if (dim, criterion) == (5, Criterion::VoronoiAspect) {
                continue;
            }
            let size = |x: &[f64]| largest(dim) * (0.7 + 0.3 * distance(x, &vec![0.0; dim]));
            let options = Options { criterion, ..well_spaced() };
            let mesh = run(dim, &cube(dim, 20, 2), &options, Some(&size));
            let mesh = mesh.triangulation().unwrap();
            let [radius, edge, mean] = measured(mesh, &size);
            assert!(radius <= 1.0, "{dim}D: {radius}");
            assert!(radius > 0.98, "{dim}D: {radius}");
            assert!(edge <= 2.0 * regular(dim), "{dim}D: {edge}");
            assert!((0.6..=1.0).contains(&mean), "{dim}D: mean {mean}");
        }
    }
}

/// Size within the box only: outside, simplices are larger and larger.
#[test]
fn sizes_end_with_the_box() {
    let options = Options { max_edge: 0.02, ..well_spaced() };
    let mesh = run(2, &cube(2, 10, 3), &options, None);
    let mesh = mesh.triangulation().unwrap();
    let is_inside = |v: u32| mesh.point(v).iter().all(|x| (0.0..=1.0).contains(x));
    let count = mesh.vertex_count() as u32;
    let inside = (0..count).filter(|&v| is_inside(v)).count() as f64;
    // A triangle of the largest size: 5774 of them cover the square, with half as many vertices.
    assert!(inside > 2887.0 && inside < 2.5 * 2887.0, "{inside}");
    assert!(f64::from(count) < 1.2 * inside, "{count} vertices, {inside} in the box");
}

#[test]
fn questions_are_in_the_box_and_one_a_vertex() {
    for dim in [2, 3] {
        let caller = std::thread::current().id();
        let asked = RefCell::new(Vec::<Vec<f64>>::new());
        let size = |x: &[f64]| {
            assert_eq!((x.len(), std::thread::current().id()), (dim, caller));
            assert!(x.iter().all(|x| (0.0..=1.0).contains(x)), "{x:?}");
            asked.borrow_mut().push(x.to_vec());
            0.3 * largest(dim) * (1.0 + x[0] * x[1])
        };
        let mesh = run(dim, &cube(dim, 300, 4), &well_spaced(), Some(&size));
        let mesh = mesh.triangulation().unwrap();
        let questions = asked.borrow().len();
        assert!(questions <= mesh.vertex_count(), "{questions} questions");
        // Sizes that were answered are kept; at vertices far from the box nobody asked.
        assert_eq!(mesh.sizes.len(), mesh.vertex_count());
        let mut known = 0;
        for (v, &kept) in mesh.sizes.iter().enumerate() {
            if kept < f64::INFINITY {
                assert_eq!(kept, size(&clamped(mesh.point(v as u32))));
                known += 1;
            }
        }
        assert_eq!(known, questions);
        let at_box = (0..mesh.simplex_count()).filter(|&simplex| {
            mesh.simplex(simplex).iter().any(|&v| mesh.point(v) == clamped(mesh.point(v)))
        });
        at_box.flat_map(|s| mesh.simplex(s)).for_each(|&v| assert!(mesh.sizes[v as usize] < 1.0));
    }
}

#[test]
fn infinite_sizes_change_nothing_but_the_room() {
    let points = cube(3, 200, 5);
    let plain = run(3, &points, &well_spaced(), None);
    let sized = run(3, &points, &well_spaced(), Some(&|_| f64::INFINITY));
    let [plain, sized] = [&plain, &sized].map(|mesh| mesh.triangulation().unwrap());
    let ratio = sized.vertex_count() as f64 / plain.vertex_count() as f64;
    assert!((0.8..1.25).contains(&ratio), "{ratio}");
    assert!(sized.sizes.iter().all(|&size| size == f64::INFINITY));
    // One half has no bound: only the other half is refined.
    let half = |x: &[f64]| if x[0] < 0.5 { 0.05 } else { f64::INFINITY };
    let mesh = run(3, &points, &well_spaced(), Some(&half));
    let mesh = mesh.triangulation().unwrap();
    let left = (0..mesh.vertex_count() as u32).filter(|&v| mesh.point(v)[0] < 0.5).count();
    assert!(left > 5 * (mesh.vertex_count() - left), "{left} of {}", mesh.vertex_count());
}

#[test]
fn answers_that_are_no_sizes_end_the_run() {
    let points = cube(2, 50, 6);
    for answer in [f64::NAN, 0.0, -0.0, -1.0, f64::NEG_INFINITY] {
        for first in [0, 200] {
            let mut mesh = Mesh::new(2, points.len() / 2, &points, 0).unwrap();
            mesh.run(&well_spaced(), None).unwrap();
            let before = mesh.triangulation().unwrap().points.clone();
            let count = Cell::new(0);
            let last = RefCell::new(Vec::new());
            let size = |x: &[f64]| {
                count.set(count.get() + 1);
                *last.borrow_mut() = x.to_vec();
                if count.get() > first { answer } else { 0.05 }
            };
            let error = mesh.run_sized(&well_spaced(), Some(&size), None).unwrap_err();
            assert_eq!((error.kind(), count.get()), (ErrorKind::InvalidArgument, first + 1));
            let words = format!("size answers {answer} at {:?};", last.borrow());
            assert!(error.message().starts_with(&words), "{error}");
            assert_eq!(mesh.triangulation().unwrap().points, before);
        }
    }
}

#[test]
fn options_that_sizes_do_not_go_with_are_refused() {
    let sized = |options: Options| Options { max_edge: 0.1, ..options };
    let hierarchical = Options { output: Output::Hierarchical, ..Options::default() };
    for (options, words) in [
        (
            sized(hierarchical.clone()),
            "options.max_edge is 0.1; it does not go with options.output = Output::Hierarchical",
        ),
        (Options { max_edge: -1.0, ..well_spaced() }, "options.max_edge is -1; it must be 0"),
        (Options { max_edge: f64::NAN, ..well_spaced() }, "options.max_edge is NaN; it must be 0"),
    ] {
        let error = refusal(3, &options, None);
        assert_eq!(error.kind(), ErrorKind::InvalidArgument);
        assert!(error.message().starts_with(words), "{error}");
    }
    let error = refusal(3, &hierarchical, Some(&|_| panic!("nobody asks")));
    assert!(
        error.message()
            == "size is given; it does not go with options.output = Output::Hierarchical",
        "{error}"
    );
    let infinite = Options { max_edge: f64::INFINITY, ..well_spaced() };
    run(3, &cube(3, 30, 1), &infinite, None);
}

#[test]
fn the_phase_is_cancelled_and_limited_as_others_are() {
    let points = cube(3, 50, 7);
    let options = Options { max_edge: 0.05, ..well_spaced() };
    let mut mesh = Mesh::new(3, points.len() / 3, &points, 0).unwrap();
    let mut fractions = Vec::new();
    mesh.run(
        &options,
        Some(&mut |progress| {
            fractions.push(progress.fraction);
            true
        }),
    )
    .unwrap();
    assert!(fractions.is_sorted());
    // The phase begins at 0.2.
    assert!(fractions.iter().any(|fraction| (0.3..0.9).contains(fraction)), "{fractions:?}");
    let count = mesh.triangulation().unwrap().vertex_count() as u64;
    let mut other = Mesh::new(3, points.len() / 3, &points, 0).unwrap();
    let cancelled = other.run(&options, Some(&mut |progress| progress.fraction < 0.3));
    assert_eq!(cancelled.unwrap_err().kind(), ErrorKind::Cancelled);
    let few = Options { max_vertices: count / 2, ..options };
    assert_eq!(other.run(&few, None).unwrap_err().kind(), ErrorKind::Limit);
    assert!(other.triangulation().is_none());
}

/// A line along an axis and one across, two points, and points on a plane: the box of the inputs
/// may have no volume.
#[test]
fn flat_inputs_have_sizes() {
    let line = |step: [f64; 3]| -> Vec<f64> {
        (0..5).flat_map(|i| step.map(|x| f64::from(i) * x)).collect()
    };
    let inputs =
        [line([0.25, 0.0, 0.0]), line([0.2, 0.3, -0.1]), line([1.0, 1.0, 0.0])[..6].to_vec()];
    for points in inputs {
        let options = Options { max_edge: 0.05, ..well_spaced() };
        let mesh = run(3, &points, &options, None);
        assert!(mesh.triangulation().unwrap().vertex_count() > 50);
    }
}

/// Inputs at other powers of two, near the ends of the range too, make the same mesh.
#[test]
fn sizes_scale_with_the_inputs() {
    let count = |exponent: i32| {
        let scale = 2f64.powi(exponent);
        let points: Vec<f64> = cube(2, 50, 8).iter().map(|x| x * scale).collect();
        let size = |x: &[f64]| 0.04 * scale + 0.05 * x[0];
        let options = Options { max_edge: 0.05 * scale, ..well_spaced() };
        run(2, &points, &options, Some(&size)).triangulation().unwrap().vertex_count() as f64
    };
    let ordinary = count(0);
    for exponent in [-1000, -600, 600, 900] {
        let ratio = count(exponent) / ordinary;
        assert!((0.95..1.05).contains(&ratio), "2^{exponent}: {ratio}");
    }
}

/// Doubles near 1 are 2^-52 apart: smaller edges cannot be had, and the run ends.
#[test]
fn sizes_below_the_spacing_of_doubles_end() {
    let near: Vec<f64> = cube(2, 0, 1).iter().map(|x| 1.0 + x * 2f64.powi(-47)).collect();
    let options = Options { max_edge: 2f64.powi(-54), ..well_spaced() };
    let mesh = run(2, &near, &options, None);
    let mesh = mesh.triangulation().unwrap();
    assert!(mesh.stats.precision_limited > 0);
    assert!(mesh.vertex_count() < 3000);
}

/// With cells that reach no farther than a part of their distance from the inputs.
#[test]
fn distances_and_sizes_are_kept_together() {
    let points = cube(2, 5, 9);
    let options = Options { max_edge: 0.1, distance_ratio: 0.4, ..well_spaced() };
    let both = run(2, &points, &options, None);
    let distances = Options { max_edge: 0.0, ..options.clone() };
    let [both, alone] = [&both, &run(2, &points, &distances, None)]
        .map(|mesh| mesh.triangulation().unwrap().vertex_count());
    assert!(both > alone + 50, "{both}, {alone}");
}

#[test]
fn the_mesh_does_not_depend_on_threads() {
    let points = cube(3, 3000, 10);
    let meshes = [1, 2, 4].map(|threads| {
        let options = Options { threads, ..well_spaced() };
        let size = |x: &[f64]| 0.05 + 0.05 * x[2];
        run(3, &points, &options, Some(&size))
    });
    let [one, two, four] = meshes.each_ref().map(|mesh| mesh.triangulation().unwrap());
    for other in [two, four] {
        assert_eq!(one.points, other.points);
        assert_eq!((&one.simplices, &one.sizes), (&other.simplices, &other.sizes));
    }
    assert!(one.neighbors.contains(&NONE));
}

/// Slivers are mended after sizes, and keep them: with the radius-edge bound and with aspects.
#[test]
fn sizes_stay_when_slivers_are_mended() {
    let points = cube(3, 100, 11);
    let size = |x: &[f64]| 0.12 * (0.7 + 0.5 * x[0]);
    for criterion in [Criterion::RadiusEdge, Criterion::VoronoiAspect] {
        let with = |min_dihedral| {
            let options = Options { criterion, min_dihedral, max_edge: 0.2, ..well_spaced() };
            run(3, &points, &options, Some(&size))
        };
        let [plain, mended] = [0.0, 15.0].map(with);
        let [plain, mended] = [&plain, &mended].map(|mesh| mesh.triangulation().unwrap());
        let [radius, _, mean] = measured(mended, &size);
        assert!(radius <= 1.0 && (0.6..=1.0).contains(&mean), "{radius}, {mean}");
        assert!(measured(mended, &|_| 0.2)[1] <= 1.0);
        let slivers = |mesh: &Triangulation| {
            let mut mesh = mesh.clone();
            mesh.parameters.min_dihedral = 15.0;
            netmesh::quality::measure(&mesh).unwrap().below_min_dihedral
        };
        let counts = [slivers(plain), slivers(mended)];
        assert!(counts[0] > 100 && counts[1] <= counts[0] / 50, "{counts:?}");
        assert_eq!(counts[1], mended.below_min_dihedral.len() as u64);
        for (v, &kept) in mended.sizes.iter().enumerate() {
            let there = size(&clamped(mended.point(v as u32)));
            assert!(kept == there || kept == f64::INFINITY, "{v}: {kept}, {there}");
        }
    }
}

/// An answer that is no size ends the run in this phase, too.
#[test]
fn answers_at_places_for_vertices_are_checked() {
    let points = cube(3, 100, 11);
    let options = Options { min_dihedral: 15.0, ..well_spaced() };
    let count = Cell::new(0);
    let asked = |_: &[f64]| {
        count.set(count.get() + 1);
        0.15
    };
    run(3, &points, &Options { min_dihedral: 0.0, ..options.clone() }, Some(&asked));
    let before = count.replace(0);
    run(3, &points, &options, Some(&asked));
    assert!(count.get() > before + 100, "{before}, {}", count.get());
    count.set(0);
    let fails = |_: &[f64]| {
        count.set(count.get() + 1);
        // At a place that would not be taken, too.
        if count.get() == before + 50 { f64::NAN } else { 0.15 }
    };
    let error = refused_by(&points, &options, &fails);
    assert!(error.message().starts_with("size answers NaN at ["), "{error}");
}

fn refused_by(points: &[f64], options: &Options, size: &SizeFn<'_>) -> Error {
    let mut mesh = Mesh::new(3, points.len() / 3, points, 0).unwrap();
    mesh.run_sized(options, Some(size), None).unwrap_err()
}

/// At the inputs and on a background, linear between; the nearest input's where they are flat.
#[test]
fn sizes_by_values_are_linear_between() {
    let field = |x: &[f64]| 0.04 + 0.1 * x[0] + 0.05 * x[1];
    for dim in 2..=4 {
        let scale = [1.0, 2.0, 6.0][dim - 2];
        let size = |x: &[f64]| scale * field(x);
        let points = cube(dim, 30, 12);
        let by_function = run(dim, &points, &well_spaced(), Some(&size));
        let by_function = by_function.triangulation().unwrap();
        let mut mesh = Mesh::new(dim, points.len() / dim, &points, 0).unwrap();
        let values: Vec<f64> = points.chunks(dim).map(size).collect();
        mesh.set_sizes(&values).unwrap();
        mesh.run(&well_spaced(), None).unwrap();
        assert_sound(&mesh);
        let [radius, _, mean] = measured(mesh.triangulation().unwrap(), &size);
        assert!(radius < 1.0 + 1e-9 && (0.6..=1.0).contains(&mean), "{dim}D: {radius}, {mean}");
        let count = mesh.triangulation().unwrap().vertex_count() as f64;
        let ratio = count / by_function.vertex_count() as f64;
        assert!((0.95..1.05).contains(&ratio), "{dim}D: {ratio}");
        // A background of other vertices.
        let coarse = cube(dim, 8, 13);
        let mut background = Mesh::new(dim, coarse.len() / dim, &coarse, 0).unwrap();
        background.run(&Options { max_edge: 0.5 * scale, ..well_spaced() }, None).unwrap();
        let background = background.triangulation().unwrap();
        let at: Vec<f64> = background.points.chunks(dim).map(|x| size(x).max(0.01)).collect();
        let mut other = Mesh::new(dim, points.len() / dim, &points, 0).unwrap();
        other.set_background(Some((background, &at))).unwrap();
        other.run(&well_spaced(), None).unwrap();
        assert_sound(&other);
        let ratio = other.triangulation().unwrap().vertex_count() as f64 / count;
        assert!((0.95..1.1).contains(&ratio), "{dim}D: {ratio}");
    }
    let line: Vec<f64> = (0..11).flat_map(|i| [0.1 * f64::from(i); 3]).collect();
    let mut mesh = Mesh::new(3, 11, &line, 0).unwrap();
    let values: Vec<f64> = (0..11).map(|i| if i < 5 { 0.1 } else { f64::INFINITY }).collect();
    mesh.set_sizes(&values).unwrap();
    mesh.run(&well_spaced(), None).unwrap();
    assert_sound(&mesh);
    let mesh = mesh.triangulation().unwrap();
    let steiner = 11..mesh.vertex_count() as u32;
    let low = steiner.clone().filter(|&v| mesh.point(v).iter().sum::<f64>() < 1.35).count();
    assert!(low > 2 * (steiner.len() - low), "{low} of {}", steiner.len());
}

/// A domain as its own background: walks in it go round corners and past holes.
#[test]
fn a_domain_is_a_background() {
    let size = |x: &[f64]| 0.05 + 0.02 * x[0] + 0.01 * x[1];
    let comb = [[0.0, 0.0], [3.0, 0.0], [3.0, 2.0], [2.5, 2.0], [2.5, 0.5], [0.5, 0.5], [0.5, 2.0]];
    let points = [comb.concat(), vec![0.0, 2.0]].concat();
    let mut mesh = Mesh::new(2, 8, &points, 0).unwrap();
    let segments: Vec<u32> = (0..8).flat_map(|i| [i, (i + 1) % 8]).collect();
    mesh.set_segments(&segments, None).unwrap();
    let options = Options { extent: netmesh::Extent::Boundary, min_angle: 20.0, ..well_spaced() };
    mesh.run(&options, None).unwrap();
    let first = mesh.triangulation().unwrap();
    assert!(first.boundary.whole.is_some());
    let at: Vec<f64> = first.points.chunks(2).map(size).collect();
    mesh.set_own_background(&at).unwrap();
    mesh.run(&options, None).unwrap();
    assert_sound(&mesh);
    let second = mesh.triangulation().unwrap();
    assert!(second.vertex_count() > 3 * at.len());
    for (x, &asked) in second.points.chunks(2).zip(&second.sizes) {
        assert!((asked - size(x)).abs() < 1e-9, "{asked} at {x:?}");
    }
}

/// The corners of the box may be farther out than every input: the mesh reaches beyond them.
#[test]
fn the_box_is_in_the_mesh() {
    for dim in [3, 4] {
        let axis = |k: usize| (0..dim).map(move |at| if at == k { 1.0 } else { 0.0 });
        let ends = (0..dim).flat_map(|k| axis(k).chain(axis(k).map(|x: f64| -x)));
        let points: Vec<f64> = ends.chain(vec![0.0; dim]).collect();
        // A cage that is round, and no larger than it must be.
        let delta = if dim == 3 { 0.4 } else { 0.0 };
        let options = Options { delta, root_scale: 2.0, ..well_spaced() };
        let mesh = run(dim, &points, &options, Some(&|_| f64::INFINITY));
        let mesh = mesh.triangulation().unwrap();
        let corners: Vec<f64> = cube(dim, 0, 1).iter().map(|x| 2.0 * x - 1.0).collect();
        let mut found = vec![NONE; 1 << dim];
        let index = netmesh::query::Index::new(mesh).unwrap();
        index.locate(mesh, &corners, 1, &mut found).unwrap();
        assert!(!found.contains(&NONE), "{dim}D: {found:?}");
    }
}

/// The region that segments enclose, and no more, is refined by size, to its boundary.
#[test]
fn sizes_fill_a_domain_of_segments() {
    let points = cube(2, 20, 14);
    let mut mesh = Mesh::new(2, points.len() / 2, &points, 0).unwrap();
    mesh.set_segments(&[0, 1, 1, 3, 3, 2, 2, 0], None).unwrap();
    let options = Options { extent: netmesh::Extent::Boundary, max_edge: 0.09, ..well_spaced() };
    let size = |x: &[f64]| 0.04 + 0.06 * x[0];
    mesh.run_sized(&options, Some(&size), None).unwrap();
    let mesh = mesh.triangulation().unwrap();
    assert!(mesh.points.iter().all(|x| (0.0..=1.0).contains(x)));
    assert_eq!(mesh.sizes.len(), mesh.vertex_count());
    for (v, &kept) in mesh.sizes.iter().enumerate() {
        assert_eq!(kept, size(mesh.point(v as u32)));
    }
    let [radius, _, mean] = measured(mesh, &size);
    assert!(radius <= 1.0 && (0.6..=1.0).contains(&mean), "{radius}, {mean}");
    assert!(measured(mesh, &|_| 0.09)[1] <= 1.0);
}
