//! Reports of a run while it works.

use netmesh::{ErrorKind, Extent, Mesh, Options, Output, Phase, Progress};
use rand_core::Rng;
use rand_pcg::Pcg64Mcg;
use std::time::{Duration, Instant};

fn uniform_mesh(dim: usize, n: usize) -> Mesh {
    let mut random = Pcg64Mcg::new(1);
    let points: Vec<f64> = (0..dim * n).map(|_| random.next_u64() as f64).collect();
    Mesh::new(dim, n, &points, 0).unwrap()
}

/// Reports that are consistent with each other: nothing falls, and it begins and ends as it should;
/// and when they came.
fn reports_of(mesh: &mut Mesh, options: &Options) -> (Vec<Progress>, Vec<Instant>) {
    let mut reports: Vec<Progress> = Vec::new();
    let mut times = Vec::new();
    let mut callback = |report: &Progress| {
        assert!((0.0..=1.0).contains(&report.fraction));
        if let Some(last) = reports.last() {
            assert!(last.fraction <= report.fraction, "{last:?} {report:?}");
            assert!(last.phase as u32 <= report.phase as u32, "{last:?} {report:?}");
            assert!(last.inputs_inserted <= report.inputs_inserted, "{last:?} {report:?}");
        }
        reports.push(*report);
        times.push(Instant::now());
        true
    };
    mesh.run(options, Some(&mut callback)).unwrap();
    let (first, last) = (&reports[0], reports.last().unwrap());
    assert_eq!((first.phase, first.fraction), (Phase::Prepare, 0.0));
    assert_eq!((last.phase, last.fraction), (Phase::Export, 1.0));
    (reports, times)
}

/// The shares of the run: insertion, in rounds that end with a report each, then FINISHMESH, and
/// then the last refinement, which begins and ends with one. In between the clock decides.
#[test]
fn progress_grows_with_the_inputs_and_then_with_the_refinement() {
    let runs = [(Output::Hierarchical, 0.6, 0.6), (Output::WellSpaced, 0.3, 0.7)];
    for (output, insert, close) in runs {
        let mut mesh = uniform_mesh(3, 20_000);
        let n = mesh.inputs().distinct() as f64;
        let (reports, times) = reports_of(&mut mesh, &Options { output, ..Options::default() });
        let rounds = mesh.triangulation().unwrap().stats.rounds;
        let of = |phase| (0..reports.len()).filter(|&at| reports[at].phase == phase).collect();
        let (inserting, finishing): (Vec<usize>, Vec<usize>) =
            (of(Phase::Insert), of(Phase::Finish));
        assert!(rounds > 2 && inserting.len() as u64 >= rounds, "{output:?}");
        for &at in &inserting {
            assert_eq!(reports[at].fraction, insert * reports[at].inputs_inserted as f64 / n);
        }
        let closing = finishing.iter().position(|&at| reports[at].fraction >= close).unwrap();
        let (first, last) = (finishing[closing], *finishing.last().unwrap());
        assert_eq!(reports[first].fraction, close, "{output:?}");
        assert!(reports[last].fraction > 1.0 - 1e-9, "{output:?}: {:?}", reports[last]);
        let growing = (first..last).filter(|&at| reports[at].fraction < reports[at + 1].fraction);
        assert!(
            times[last] - times[first] < Duration::from_millis(200) || growing.count() > 3,
            "{output:?}: silent while it refines"
        );
    }
}

/// While the outer cage is made, at most its centre is an input that is a vertex. When it is done
/// there are two simplices at each facet of its hull, far more than 2 V of them.
#[test]
fn an_outer_cage_of_many_points_is_no_progress_of_the_inputs() {
    let mut mesh = uniform_mesh(4, 20);
    let (reports, _) = reports_of(&mut mesh, &Options { delta: 0.3, ..Options::default() });
    let cage = mesh.triangulation().unwrap().stats.cage_vertices;
    let too_early =
        |report: &&Progress| report.inputs_inserted > 1 && report.simplices < 4 * cage - 8;
    assert_eq!(reports.iter().find(too_early), None);
}

/// The last two segments of many cross, which ends the run if nothing did before.
#[test]
fn segments_can_be_cancelled_before_they_are_arranged() {
    let count = 300_000;
    let mut random = Pcg64Mcg::new(2);
    let mut points = Vec::new();
    for x in 0..count {
        let y = (random.next_u64() >> 40) as f64;
        points.extend([f64::from(x), y, f64::from(x) + 0.5, y + 1.0]);
    }
    let end = f64::from(count);
    points.extend([end, 0.0, end + 1.0, 1.0, end, 1.0, end + 1.0, 0.0]);
    let ends: Vec<u32> = (0..points.len() as u32 / 2).collect();
    let mut mesh = Mesh::new(2, points.len() / 2, &points, 0).unwrap();
    mesh.set_segments(&ends, None).unwrap();
    let options = Options { extent: Extent::Hull, ..Options::default() };
    let mut calls = 0;
    let mut callback = |report: &Progress| {
        assert_eq!((report.phase, report.fraction), (Phase::Prepare, 0.0));
        calls += 1;
        false
    };
    let error = mesh.run(&options, Some(&mut callback)).unwrap_err();
    assert_eq!((error.kind(), calls), (ErrorKind::Cancelled, 1), "{error}");
    assert_eq!(mesh.run(&options, None).unwrap_err().kind(), ErrorKind::InvalidArgument);
    assert!(mesh.triangulation().is_none());
}
