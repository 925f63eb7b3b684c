//! Times of the hot functions: `cargo test --release numerics::timing -- --ignored --nocapture`.

use super::testing::{Family, Random, points, references};
use super::{Circumball, in_ball, orientation};
use super::{circumcenter_exact, in_ball_exact, orientation_exact};
use std::hint::black_box;
use std::time::Instant;

/// Measures nanoseconds a call, the best of sixty passes over `count` items.
fn nanoseconds(count: usize, mut pass: impl FnMut()) -> f64 {
    let seconds = (0..60).map(|_| {
        let start = Instant::now();
        pass();
        start.elapsed().as_secs_f64()
    });
    seconds.fold(f64::INFINITY, f64::min) * 1e9 / count as f64
}

fn report<const D: usize>(family: Family) {
    const COUNT: usize = 2000;
    let mut random = Random(1);
    let clouds: Vec<_> = (0..COUNT).map(|_| points::<D>(family, D + 2, &mut random)).collect();
    let simplices: Vec<_> = clouds.iter().map(|cloud| references(&cloud[..=D])).collect();
    let balls: Vec<_> = simplices.iter().map(|simplex| Circumball::new(simplex)).collect();
    let new = nanoseconds(COUNT, || {
        for simplex in &simplices {
            black_box(Circumball::new(black_box(simplex)));
        }
    });
    let side = nanoseconds(COUNT, || {
        for (ball, cloud) in balls.iter().zip(&clouds) {
            black_box(ball.side(&cloud[ball.anchor], &cloud[D + 1]));
        }
    });
    let turn = nanoseconds(COUNT, || {
        for simplex in &simplices {
            black_box(orientation(black_box(simplex)));
        }
    });
    let exact = nanoseconds(COUNT, || {
        for (simplex, cloud) in simplices.iter().zip(&clouds) {
            black_box(in_ball(simplex, &cloud[D + 1]));
        }
    });
    println!(
        "{D} {family:?}: new {new:.1} side {side:.1} orientation {turn:.1} in_ball {exact:.0}"
    );
}

#[test]
#[ignore = "a measurement, not a check"]
fn hot_functions() {
    for family in [Family::Uniform, Family::Grid, Family::FarCluster, Family::NearlyFlat] {
        report::<2>(family);
        report::<3>(family);
        report::<4>(family);
    }
    report::<5>(Family::Uniform);
    report::<6>(Family::Uniform);
    report::<8>(Family::Uniform);
}

fn report_exact<const D: usize>(family: Family) {
    const COUNT: usize = 200;
    let mut random = Random(1);
    let clouds: Vec<_> = (0..COUNT).map(|_| points::<D>(family, D + 2, &mut random)).collect();
    let simplices: Vec<_> = clouds.iter().map(|cloud| references(&cloud[..=D])).collect();
    let turn = nanoseconds(COUNT, || {
        for simplex in &simplices {
            black_box(orientation_exact(black_box(simplex)));
        }
    });
    let side = nanoseconds(COUNT, || {
        for (simplex, cloud) in simplices.iter().zip(&clouds) {
            black_box(in_ball_exact(black_box(simplex), &cloud[D + 1]));
        }
    });
    let centre = nanoseconds(COUNT, || {
        for simplex in &simplices {
            black_box(circumcenter_exact(black_box(simplex), 0));
        }
    });
    println!("{D} {family:?}: exact orientation {turn:.0} in_ball {side:.0} centre {centre:.0}");
}

#[test]
#[ignore = "a measurement, not a check"]
fn exact_functions() {
    for family in [Family::Uniform, Family::Grid, Family::MixedScales, Family::RawBits] {
        report_exact::<2>(family);
        report_exact::<3>(family);
        report_exact::<4>(family);
        report_exact::<5>(family);
    }
}
