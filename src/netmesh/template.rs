//! The cage template T (§4): points on the unit sphere, no point of the sphere farther than delta
//! from them, made by greedy farthest-point insertion [Gon85] on a dense deterministic sample.

use crate::numerics::distance;
use rand_core::Rng;
use rand_pcg::Pcg64Mcg;

/// A delta-net of the unit sphere. In 2D the regular polygon, which is the smallest one.
pub(super) fn cage_template<const D: usize>(delta: f64) -> Vec<[f64; D]> {
    if D == 2 { polygon(delta) } else { greedy_net(delta) }
}

/// Every point of the circle is within 2 sin(pi / 2n) of the regular n-gon's corners.
fn polygon<const D: usize>(delta: f64) -> Vec<[f64; D]> {
    use std::f64::consts::{PI, TAU};
    let count = (PI / (2.0 * (delta / 2.0).asin())).ceil();
    // Turned a little, so that grids are not cocircular with the polygon.
    let corner = |i: f64| (i * TAU / count + 0.1).sin_cos();
    (0..count as u32)
        .map(|i| {
            let mut point = [0.0; D];
            (point[1], point[0]) = corner(f64::from(i));
            point
        })
        .collect()
}

fn greedy_net<const D: usize>(delta: f64) -> Vec<[f64; D]> {
    let sample = sphere_sample::<D>();
    let mut gaps = vec![f64::INFINITY; sample.len()];
    let mut net = Vec::new();
    let mut farthest = 0;
    loop {
        net.push(sample[farthest]);
        for (gap, point) in gaps.iter_mut().zip(&sample) {
            *gap = gap.min(distance(point, &sample[farthest]));
        }
        farthest = (0..sample.len()).fold(0, |best, i| if gaps[i] > gaps[best] { i } else { best });
        if gaps[farthest] <= delta {
            return net;
        }
    }
}

/// Points on the unit sphere, uniform: normalised vectors of the unit ball (rejection) in up to
/// four dimensions, normalised sums of uniforms above, where the ball fills too little of the cube.
fn sphere_sample<const D: usize>() -> Vec<[f64; D]> {
    let mut random = Pcg64Mcg::new(0x5eed);
    let count = 1000 << D.min(4);
    let mut sample = Vec::with_capacity(count);
    while sample.len() < count {
        let mut point = [0.0; D];
        for x in &mut point {
            let terms = if D <= 4 { 1 } else { 8 };
            *x = (0..terms).map(|_| uniform(&mut random)).sum();
        }
        let norm = point.iter().map(|x| x * x).sum::<f64>().sqrt();
        if norm > 0.1 && (D > 4 || norm < 1.0) {
            sample.push(point.map(|x| x / norm));
        }
    }
    sample
}

/// Uniform in [-1, 1).
fn uniform(random: &mut Pcg64Mcg) -> f64 {
    (random.next_u64() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}
