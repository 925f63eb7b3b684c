//! Points of the picture: a spiral, in its middle a ring, in the ring's middle a handful of
//! points, each ten thousand times smaller than the one around it.

use std::f64::consts::TAU;

/// The radii of the three figures.
const SCALES: [f64; 3] = [1.0, 1e-4, 1e-8];
const ARMS: usize = 3;
const POINTS_PER_ARM: usize = 40;
const RING_POINTS: usize = 48;
const HANDFUL: usize = 24;

pub fn coordinates() -> Vec<f64> {
    let [spiral, ring, handful] = SCALES;
    let mut points = Vec::new();
    add_spiral(&mut points, spiral);
    add_ring(&mut points, ring);
    add_handful(&mut points, handful);
    points
}

fn add_spiral(points: &mut Vec<f64>, scale: f64) {
    for arm in 0..ARMS {
        for i in 0..POINTS_PER_ARM {
            let along = i as f64 / (POINTS_PER_ARM - 1) as f64;
            let radius = scale * (0.2 + 0.8 * along.powf(1.4));
            add_polar(points, radius, (arm as f64 / ARMS as f64 + 0.45 * along) * TAU);
        }
    }
}

/// A ring with waves.
fn add_ring(points: &mut Vec<f64>, scale: f64) {
    for i in 0..RING_POINTS {
        let turn = i as f64 / RING_POINTS as f64 * TAU;
        add_polar(points, scale * (0.8 + 0.2 * (5.0 * turn).sin()), turn);
    }
}

/// A sunflower's seeds.
fn add_handful(points: &mut Vec<f64>, scale: f64) {
    for i in 0..HANDFUL {
        let golden = TAU * (3.0 - 5.0_f64.sqrt()) / 2.0;
        add_polar(points, scale * ((i as f64 + 0.5) / HANDFUL as f64).sqrt(), i as f64 * golden);
    }
}

fn add_polar(points: &mut Vec<f64>, radius: f64, turn: f64) {
    points.extend([radius * turn.cos(), radius * turn.sin()]);
}
