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

/// While the outer cage is made, at most its centre is an input that is a vertex. When it is done
/// there are two simplices at each facet of its hull, far more than 2 V of them.
#[test]
fn an_outer_cage_of_many_points_is_no_progress_of_the_inputs() {
    let mut mesh = uniform_mesh(4, 20);
    let reports = reports_of(&mut mesh, &Options { delta: 0.3, ..Options::default() });
    let cage = mesh.triangulation().unwrap().stats.cage_vertices;
    let too_early =
        |report: &&Progress| report.inputs_inserted > 1 && report.simplices < 4 * cage - 8;
    assert_eq!(reports.iter().find(too_early), None);
}
