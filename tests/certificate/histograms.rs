//! Histograms beside counts of all values, by other formulas.

use super::measures::aspects_by_trying;
use super::meshes::{Case, brute_force, pairs, plain, random_points, run};
use netmesh::numerics::{Circumball, distance};
use netmesh::options::Options;
use netmesh::quality::{Measure, histogram, measure};
use netmesh::{Algorithm, NONE, Output};

fn point<const D: usize>(case: &Case, vertex: u32) -> &[f64; D] {
    case.mesh.point(vertex).try_into().unwrap()
}

fn dot<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn minus<const D: usize>(a: &[f64; D], b: &[f64; D], factor: f64) -> [f64; D] {
    std::array::from_fn(|k| a[k] - factor * b[k])
}

/// The angle in degrees at the ridge of all vertices but `i` and `j`: what is seen along the ridge.
fn angle_at_ridge<const D: usize>(points: &[&[f64; D]], i: usize, j: usize) -> f64 {
    let ridge: Vec<&[f64; D]> =
        (0..points.len()).filter(|&k| k != i && k != j).map(|k| points[k]).collect();
    let mut axes: Vec<[f64; D]> = Vec::new();
    let across = |vector: [f64; D], axes: &[[f64; D]]| {
        axes.iter()
            .fold(vector, |rest, axis| minus(&rest, axis, dot(&rest, axis) / dot(axis, axis)))
    };
    for other in &ridge[1..] {
        let axis = across(minus(other, ridge[0], 1.0), &axes);
        axes.push(axis);
    }
    let [a, b] = [i, j].map(|k| across(minus(points[k], ridge[0], 1.0), &axes));
    let cosine = dot(&a, &b) / (dot(&a, &a) * dot(&b, &b)).sqrt();
    cosine.clamp(-1.0, 1.0).acos().to_degrees()
}

fn angles<const D: usize>(points: &[&[f64; D]]) -> Vec<f64> {
    let pairs = (0..=D).flat_map(|i| (i + 1..=D).map(move |j| (i, j)));
    pairs.map(|(i, j)| angle_at_ridge(points, i, j)).collect()
}

fn radius_edge<const D: usize>(points: &[&[f64; D]]) -> f64 {
    let lengths = (0..=D).flat_map(|i| (0..i).map(move |j| distance(points[i], points[j])));
    Circumball::<D>::new(points).radius() / lengths.fold(f64::INFINITY, f64::min)
}

/// The points of each simplex, of all or of those off the hull.
fn simplices<const D: usize>(case: &Case, at_hull: bool) -> Vec<Vec<&[f64; D]>> {
    let mesh = &case.mesh;
    let facets = (0..mesh.simplex_count()).flat_map(|s| (0..=D).map(move |i| (s, i)));
    let hull: Vec<u32> = facets
        .filter(|&(s, i)| mesh.neighbors[s * (D + 1) + i] == NONE)
        .flat_map(|(s, i)| (0..=D).filter(move |&k| k != i).map(move |k| mesh.simplex(s)[k]))
        .collect();
    let all = (0..mesh.simplex_count()).map(|s| mesh.simplex(s));
    let wanted = all.filter(|simplex| at_hull || !simplex.iter().any(|v| hull.contains(v)));
    wanted.map(|simplex| simplex.iter().map(|&v| point(case, v)).collect()).collect()
}

/// Compares every count with that of `values`.
fn check(case: &Case, measure: Measure, at_hull: bool, values: &[f64], edges: &[f64]) {
    let found = histogram(&case.mesh, measure, at_hull, edges).unwrap();
    let ends = [f64::NEG_INFINITY, f64::INFINITY];
    let bounds: Vec<f64> = [&ends[..1], edges, &ends[1..]].concat();
    for (bin, bounds) in bounds.windows(2).enumerate() {
        let inside = values.iter().filter(|&&x| bounds[0] <= x && x < bounds[1]).count();
        assert_eq!(found.counts[bin], inside as u64, "{measure:?} {at_hull} in {bounds:?}");
    }
    let near = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-6, "{measure:?}: {a} and {b}");
    near(found.least, values.iter().copied().fold(f64::INFINITY, f64::min));
    near(found.largest, values.iter().copied().fold(0.0, f64::max));
}

fn check_simplices<const D: usize>(case: &Case) {
    let degrees: Vec<f64> = (0..12).map(|i| 0.123 + 15.0 * f64::from(i)).collect();
    let ratios = [0.6, 0.701, 0.83, 1.04, 1.37, 1.9, 4.1];
    for at_hull in [false, true] {
        let simplices = simplices::<D>(case, at_hull);
        let all: Vec<Vec<f64>> = simplices.iter().map(|points| angles(points)).collect();
        let least = |angles: &Vec<f64>| angles.iter().copied().fold(f64::INFINITY, f64::min);
        let smallest: Vec<f64> = all.iter().map(least).collect();
        let edges: Vec<f64> = simplices.iter().map(|points| radius_edge(points)).collect();
        check(case, Measure::DihedralAngle, at_hull, &all.concat(), &degrees);
        check(case, Measure::SmallestAngle, at_hull, &smallest, &degrees);
        check(case, Measure::RadiusEdge, at_hull, &edges, &ratios);
    }
}

#[test]
fn angles_and_ratios_are_those_of_all_simplices() {
    let options = Options::default();
    check_simplices::<2>(&run(&random_points::<2>(80, 1), &options));
    check_simplices::<3>(&run(&random_points::<3>(60, 2), &options));
    check_simplices::<4>(&run(&random_points::<4>(8, 3), &options));
    let finished = Options { output: Output::WellSpaced, ..options };
    check_simplices::<3>(&run(&pairs::<3>(4, 1e-3, 4), &finished));
}

#[test]
fn plain_triangulations_have_few_simplices_off_the_hull() {
    let case = brute_force(&random_points::<5>(9, 4));
    let all = simplices::<5>(&case, true);
    let values: Vec<f64> = all.iter().flat_map(|points| angles(points)).collect();
    assert_eq!(values.len(), 15 * case.mesh.simplex_count());
    check(&case, Measure::DihedralAngle, true, &values, &[0.0, 20.0, 90.0, 150.0, 180.0]);
    let off_hull = histogram(&case.mesh, Measure::DihedralAngle, false, &[0.0, 180.0]).unwrap();
    let extremes = (f64::INFINITY, f64::NEG_INFINITY);
    assert_eq!((off_hull.counts, off_hull.least), (vec![0, 0, 0], extremes.0));
    assert_eq!(off_hull.largest, extremes.1);
}

#[test]
fn aspects_are_those_of_all_cells() {
    let edges = [1.0, 1.51, 2.02, 2.53, 3.04, 3.55];
    for (at_hull, options) in [false, true].into_iter().zip([Options::default(), finished()]) {
        let case = run(&random_points::<2>(60, 1), &options);
        check(&case, Measure::Aspect, at_hull, &aspects_by_trying::<2>(&case), &edges);
        let case = run(&pairs::<3>(3, 1e-9, 2), &Options::default());
        assert!(case.mesh.domains.len() > 1);
        check(&case, Measure::Aspect, at_hull, &aspects_by_trying::<3>(&case), &edges);
    }
}

fn finished() -> Options {
    Options { output: Output::WellSpaced, ..Options::default() }
}

#[test]
fn extremes_are_the_figures_of_the_quality() {
    let case = run(&random_points::<3>(300, 5), &Options::default());
    let quality = measure(&case.mesh).unwrap();
    let of = |measure| histogram(&case.mesh, measure, false, &[0.0]).unwrap();
    assert_eq!(of(Measure::RadiusEdge).largest, quality.worst_radius_edge);
    assert_eq!(of(Measure::Aspect).largest, quality.worst_aspect_anywhere);
    assert_eq!(of(Measure::SmallestAngle).least, quality.min_angle_degrees);
    assert_eq!(of(Measure::DihedralAngle).least, quality.min_angle_degrees);
}

#[test]
fn known_simplices_count_where_they_belong() {
    let corner = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let case = plain(&corner, &[vec![0, 1, 2, 3]]);
    let counts =
        |measure, edges: &[f64]| histogram(&case.mesh, measure, true, edges).unwrap().counts;
    // Three right angles, and three of arctan(sqrt(2)).
    assert_eq!(counts(Measure::DihedralAngle, &[54.0, 55.0, 89.0, 91.0]), [0, 3, 0, 3, 0]);
    let ratio = 3f64.sqrt() / 2.0;
    assert_eq!(counts(Measure::RadiusEdge, &[0.0, ratio - 1e-12, ratio + 1e-12]), [0, 0, 1, 0]);
    assert_eq!(counts(Measure::Aspect, &[0.0]), [0, 0]);
}

#[test]
fn a_flat_simplex_has_angles_of_zero_and_no_finite_ratio() {
    let flat = [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]];
    let case = plain(&flat, &[vec![0, 1, 2]]);
    let of = |measure| histogram(&case.mesh, measure, true, &[0.0, 1e-300, 1e300]).unwrap();
    assert_eq!(of(Measure::DihedralAngle).counts, [0, 3, 0, 0]);
    assert_eq!(of(Measure::RadiusEdge).counts, [0, 0, 0, 1]);
    assert_eq!(of(Measure::RadiusEdge).largest, f64::INFINITY);
}

#[test]
fn meshes_that_do_not_fit_together_have_no_values() {
    let mut case = plain(&random_points::<2>(3, 1), &[vec![0, 1, 2]]);
    case.mesh.simplices[0] = 3;
    let counts = histogram(&case.mesh, Measure::RadiusEdge, true, &[0.0]).unwrap().counts;
    assert_eq!(counts, [0, 0]);
}

#[test]
fn a_delaunay_triangulation_of_inputs_has_aspects_off_its_hull() {
    let options = Options { algorithm: Algorithm::Delaunay, ..Options::default() };
    let grid: Vec<[f64; 2]> = (0..25).map(|i| [i % 5, i / 5].map(f64::from)).collect();
    let case = run(&grid, &options);
    let root = 2f64.sqrt();
    let found = histogram(&case.mesh, Measure::Aspect, true, &[root - 1e-9, root + 1e-9]).unwrap();
    assert_eq!(found.counts, [0, 9, 0]);
}
