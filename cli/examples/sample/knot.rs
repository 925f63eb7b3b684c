//! The points of `samples/knot_3d.xyz`: a tube round a trefoil knot, thick and sparse on one side,
//! thin and dense on the other, and at the knot's centre four clusters, each a thousand times
//! smaller than the one around it. Between the clusters there is nothing, so that meshing them
//! needs cages.

use std::f64::consts::TAU;
use std::fmt::Write;

const TUBE_POINTS: usize = 9_000;
const CLUSTERS: usize = 4;
const POINTS_PER_CLUSTER: usize = 250;
const SEED: u64 = 20_120_617;

type Point = [f64; 3];

/// The whole file.
pub fn text() -> String {
    let mut random = Random { state: SEED };
    let mut text = String::new();
    for _ in 0..TUBE_POINTS {
        add_line(&mut text, tube_point(&mut random));
    }
    for cluster in 0..CLUSTERS {
        let radius = 0.5 * 1e-3_f64.powi(cluster as i32);
        for _ in 0..POINTS_PER_CLUSTER {
            add_line(&mut text, point_in_ball(&mut random, radius));
        }
    }
    text
}

/// Six significant digits: the same text whatever the last bit of the platform's `sin`.
fn add_line(text: &mut String, point: Point) {
    let [x, y, z] = point.map(|x| format!("{x:.5e}").parse::<f64>().expect("a number"));
    let _ = writeln!(text, "{x} {y} {z}");
}

fn tube_point(random: &mut Random) -> Point {
    let turn = dense_near_zero(random.unit()) * TAU;
    let radius = 0.25 - 0.17 * turn.cos();
    let (sine, cosine) = (random.unit() * TAU).sin_cos();
    let tangent = unit(difference(knot(turn + 1e-3), knot(turn - 1e-3)));
    let normal = unit(cross(tangent, [0.0, 0.0, 1.0]));
    let binormal = cross(tangent, normal);
    let center = knot(turn);
    std::array::from_fn(|axis| {
        center[axis] + radius * (cosine * normal[axis] + sine * binormal[axis])
    })
}

/// The trefoil: twice round the torus the long way, three times the short way.
fn knot(turn: f64) -> Point {
    let distance = 3.0 + 1.2 * (3.0 * turn).cos();
    [distance * (2.0 * turn).cos(), distance * (2.0 * turn).sin(), 1.2 * (3.0 * turn).sin()]
}

/// Maps \[0, 1) onto itself; more values near the two ends, which meet on the knot.
fn dense_near_zero(x: f64) -> f64 {
    x - 0.12 * (TAU * x).sin()
}

fn point_in_ball(random: &mut Random, radius: f64) -> Point {
    loop {
        let point = [(); 3].map(|()| 2.0 * random.unit() - 1.0);
        if dot(point, point) <= 1.0 {
            return point.map(|x| radius * x);
        }
    }
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn difference(a: Point, b: Point) -> Point {
    std::array::from_fn(|axis| a[axis] - b[axis])
}

fn unit(a: Point) -> Point {
    let length = dot(a, a).sqrt();
    a.map(|x| x / length)
}

/// A Weyl sequence, mixed by folding two 128-bit products.
struct Random {
    state: u64,
}

impl Random {
    /// Uniform in \[0, 1), a multiple of 2^-53.
    fn unit(&mut self) -> f64 {
        self.state = self.state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let product = u128::from(self.state) * u128::from(0xD129_0F35_2B6A_4F4D_u64);
        let folded = (product >> 64) as u64 ^ product as u64;
        let product = u128::from(folded) * u128::from(0xA24B_AED4_963E_E407_u64);
        let mixed = (product >> 64) as u64 ^ product as u64;
        (mixed >> 11) as f64 / (1u64 << 53) as f64
    }
}
