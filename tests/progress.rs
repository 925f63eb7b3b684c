//! What a run reports while it works.

use netmesh::{Mesh, Options, Phase, Progress};
use rand_core::Rng;
use rand_pcg::Pcg64Mcg;

fn uniform_mesh(dim: usize, n: usize) -> Mesh {
    let mut random = Pcg64Mcg::new(1);
    let points: Vec<f64> = (0..dim * n).map(|_| random.next_u64() as f64).collect();
    Mesh::new(dim, n, &points, 0).unwrap()
}

/// Reports that are consistent with each other, of a hierarchical run of `n` inputs.
fn reports_of(mesh: &mut Mesh, options: &Options) -> Vec<Progress> {
    let n = mesh.inputs().distinct() as f64;
    let mut reports: Vec<Progress> = Vec::new();
    let mut callback = |report: &Progress| {
        assert_eq!(report.fraction, report.inputs_inserted as f64 / n);
        assert!(reports.last().is_none_or(|last| last.fraction <= report.fraction));
        reports.push(*report);
        true
    };
    mesh.run(options, Some(&mut callback)).unwrap();
    let (first, last) = (&reports[0], reports.last().unwrap());
    assert_eq!((first.phase, first.fraction), (Phase::Prepare, 0.0));
    assert_eq!((last.phase, last.fraction), (Phase::Export, 1.0));
    reports
}

#[test]
fn progress_grows_with_the_inputs_that_are_vertices() {
    let reports = reports_of(&mut uniform_mesh(2, 100_000), &Options::default());
    assert!(reports.iter().filter(|report| report.phase == Phase::Insert).count() > 2);
}

#[test]
fn an_outer_cage_of_many_points_is_no_progress_of_the_inputs() {
    let fine_cage = Options { delta: 0.1, ..Options::default() };
    let reports = reports_of(&mut uniform_mesh(3, 20), &fine_cage);
    let during_cage = reports.iter().filter(|report| report.phase == Phase::Insert);
    assert!(during_cage.take(2).all(|report| report.inputs_inserted <= 1), "{reports:?}");
}
