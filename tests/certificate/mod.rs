//! The certificate holds for sound meshes, and names what is wrong with corrupted ones.

mod corruptions;
mod enclosed;
mod extents;
mod facets;
mod frames;
mod geometry;
mod histograms;
mod interiors;
mod left_out;
mod measures;
mod meshes;
mod paper;
mod segments;
mod shapes;
mod sizes;
mod solids;
mod subsegments;
mod tilings;

use meshes::{Case, brute_force, by_hand, pairs, random_points, run};
use netmesh::options::{Algorithm, Criterion, Options, Output};
use netmesh::quality::measure;
use netmesh::validate::{Report, ViolationKind, validate};

/// Checks all levels.
pub fn report(case: &Case) -> Report {
    validate(&case.inputs, &case.mesh, 3).unwrap()
}

/// Asserts that all three levels hold.
pub fn assert_sound(case: &Case) {
    let report = report(case);
    assert_eq!((report.level, report.violations, report.first), (3, 0, None));
    assert!(report.checked > 0);
}

/// Asserts that `kind` is the first violation and that the level is the one below it.
pub fn assert_violates(case: &Case, kind: ViolationKind) {
    let report = report(case);
    let first = report.first.as_ref().unwrap_or_else(|| panic!("{kind:?} went unseen"));
    assert_eq!(first.kind, kind, "{}", first.message);
    assert_eq!(report.level, kind.level() - 1);
    assert!(report.violations > 0);
    assert!(!first.message.is_empty() && first.message.len() < 160);
}

#[test]
fn plain_delaunay_triangulations_hold() {
    assert_sound(&brute_force(&random_points::<2>(14, 1)));
    assert_sound(&brute_force(&random_points::<3>(12, 2)));
    assert_sound(&brute_force(&random_points::<4>(10, 3)));
    assert_sound(&brute_force(&random_points::<5>(9, 4)));
    assert_sound(&brute_force(&random_points::<6>(9, 5)));
    assert_sound(&brute_force(&random_points::<8>(10, 6)));
}

#[test]
fn plain_delaunay_runs_hold() {
    let options = Options { algorithm: Algorithm::Delaunay, ..Options::default() };
    assert_sound(&run(&random_points::<2>(300, 1), &options));
    assert_sound(&run(&random_points::<3>(200, 1), &options));
    assert_sound(&run(&random_points::<4>(60, 1), &options));
    let grid: Vec<[f64; 3]> = (0..125).map(|i| [i % 5, i / 5 % 5, i / 25].map(f64::from)).collect();
    assert_sound(&run(&grid, &options));
}

/// Asserts that a run holds and that its measures are within the bound.
fn assert_bounded(case: &Case) {
    assert_sound(case);
    let (quality, bound) = (measure(&case.mesh).unwrap(), case.mesh.parameters.quality_bound);
    assert!(quality.worst_aspect <= bound && quality.worst_aspect > 1.0, "{quality:?}");
    assert!(quality.worst_cage_aspect <= bound, "{quality:?}");
    assert!(quality.mean_aspect <= quality.worst_aspect);
    assert!(quality.worst_aspect <= quality.worst_aspect_anywhere);
}

#[test]
fn hierarchical_runs_hold_and_measure_within_the_bound() {
    let options = Options::default();
    assert_bounded(&run(&random_points::<2>(60, 1), &options));
    assert_bounded(&run(&pairs::<2>(20, 1e-9, 2), &options));
    assert_bounded(&run(&random_points::<3>(200, 1), &options));
    assert_bounded(&run(&pairs::<3>(10, 1e-9, 2), &options));
}

#[test]
fn larger_hierarchical_runs_hold() {
    let options = Options::default();
    for seed in 0..10 {
        assert_bounded(&run(&random_points::<2>(500, seed), &options));
    }
    assert_bounded(&run(&random_points::<2>(20_000, 1), &options));
    assert_bounded(&run(&random_points::<3>(5_000, 1), &options));
}

#[test]
fn runs_in_higher_dimensions_hold() {
    assert_bounded(&run(&random_points::<4>(100, 1), &Options::default()));
    assert_bounded(&run(&random_points::<5>(20, 1), &Options::default()));
}

#[test]
fn finished_runs_hold() {
    let options = Options { output: Output::WellSpaced, ..Options::default() };
    assert_bounded(&run(&random_points::<2>(500, 1), &options));
    assert_bounded(&run(&pairs::<2>(20, 1e-3, 2), &options));
    assert_bounded(&run(&random_points::<3>(300, 1), &options));
    assert_bounded(&run(&pairs::<3>(10, 1e-3, 2), &options));
}

#[test]
fn runs_by_radius_edge_hold() {
    let options = Options { criterion: Criterion::RadiusEdge, ..Options::default() };
    assert_sound(&run(&random_points::<3>(200, 1), &options));
    assert_sound(&run(&pairs::<2>(20, 1e-9, 2), &options));
}

#[test]
fn larger_runs_by_radius_edge_hold() {
    let options = Options { criterion: Criterion::RadiusEdge, ..Options::default() };
    assert_sound(&run(&random_points::<2>(1000, 1), &options));
    assert_sound(&run(&random_points::<3>(2000, 1), &options));
}

#[test]
fn a_hierarchy_by_hand_holds() {
    assert_sound(&by_hand(&meshes::BY_HAND, &[]));
}

#[test]
fn lower_levels_stop_where_asked() {
    let mut case = brute_force(&random_points::<2>(14, 1));
    case.mesh.kinds[3] = netmesh::VertexKind::Steiner;
    for level in 1..=2 {
        let report = validate(&case.inputs, &case.mesh, level).unwrap();
        assert_eq!((report.level, report.violations), (level, 0));
    }
    assert_eq!(report(&case).level, 2);
    assert!(validate(&case.inputs, &case.mesh, 0).is_err());
    assert!(validate(&case.inputs, &case.mesh, 4).is_err());
}
