//! The point sets, each a function of its size and a seed.

use crate::random::Random;

#[derive(Clone, Debug, PartialEq)]
pub struct Points {
    pub dim: usize,
    /// `len() x dim`.
    pub coordinates: Vec<f64>,
}

impl Points {
    pub fn len(&self) -> usize {
        self.coordinates.len() / self.dim
    }

    pub fn iter(&self) -> impl Iterator<Item = &[f64]> {
        self.coordinates.chunks_exact(self.dim)
    }

    /// Lowest and highest coordinate along each axis.
    pub fn bounding_box(&self) -> Vec<[f64; 2]> {
        (0..self.dim)
            .map(|axis| {
                self.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], point| {
                    [low.min(point[axis]), high.max(point[axis])]
                })
            })
            .collect()
    }
}

fn filled(dim: usize, n: usize, mut point: impl FnMut(usize) -> Vec<f64>) -> Points {
    Points { dim, coordinates: (0..n).flat_map(&mut point).collect() }
}

/// The names that [`named`] knows.
pub const NAMES: [&str; 4] = ["uniform", "gaussian", "clusters", "sphere"];

pub fn named(name: &str, dim: usize, n: usize, seed: u64) -> Points {
    match name {
        "uniform" => uniform(dim, n, seed),
        "gaussian" => gaussian(dim, n, seed),
        "clusters" => gaussian_clusters(dim, n, seed),
        "sphere" => sphere(dim, n, seed),
        _ => panic!("no input is called {name}"),
    }
}

/// In the unit cube.
pub fn uniform(dim: usize, n: usize, seed: u64) -> Points {
    let mut random = Random::new(seed);
    filled(dim, n, |_| (0..dim).map(|_| random.unit()).collect())
}

pub fn gaussian(dim: usize, n: usize, seed: u64) -> Points {
    let mut random = Random::new(seed);
    filled(dim, n, |_| (0..dim).map(|_| random.gaussian()).collect())
}

/// Normal distributions of 100 points about uniform centres, in turn. Their deviation is 2^-6 of
/// the centres' typical distance: larger n is more of the same.
pub fn gaussian_clusters(dim: usize, n: usize, seed: u64) -> Points {
    const POINTS: usize = 100;
    let clusters = n.div_ceil(POINTS);
    let deviation = 2f64.powi(-6) * (clusters as f64).powf(-1.0 / dim as f64);
    let centers = uniform(dim, clusters, seed ^ 0x5eed);
    let mut random = Random::new(seed);
    filled(dim, n, |i| {
        let center = &centers.coordinates[i % clusters * dim..][..dim];
        center.iter().map(|x| x + random.gaussian() * deviation).collect()
    })
}

pub fn sphere(dim: usize, n: usize, seed: u64) -> Points {
    let mut random = Random::new(seed);
    filled(dim, n, |_| random.direction(dim))
}

/// `pairs` uniform points, each with a second one at distance 2^`log_distance`.
pub fn close_pairs(dim: usize, pairs: usize, log_distance: i32, seed: u64) -> Points {
    let mut random = Random::new(seed);
    filled(dim, pairs, |_| {
        let mut point: Vec<f64> = (0..dim).map(|_| random.unit()).collect();
        let direction = random.direction(dim);
        for k in 0..dim {
            point.push(point[k] + direction[k] * 2f64.powi(log_distance));
        }
        point
    })
}

/// `levels` clusters of `per_level` points about the origin: the points of level i are within
/// \[1, 1.5) times 2^(-`log_gap` i) of it, all scaled so that level sizes are balanced about 1.
pub fn nested_clusters(
    dim: usize,
    levels: usize,
    per_level: usize,
    log_gap: f64,
    seed: u64,
) -> Points {
    let mut random = Random::new(seed);
    filled(dim, levels * per_level, |i| {
        let level = (i / per_level) as f64;
        let exponent = log_gap * ((levels - 1) as f64 / 2.0 - level);
        let whole = exponent.floor();
        let mantissa = (exponent - whole).exp2() * (1.0 + 0.5 * random.unit());
        let scale = 2f64.powi(whole as i32);
        random.direction(dim).into_iter().map(|x| x * mantissa * scale).collect()
    })
}

/// A grid of side^dim points whose coordinates, from 1 on, are each moved by up to half of
/// `spread`.
pub fn grid(dim: usize, side: usize, spread: f64, seed: u64) -> Points {
    let mut random = Random::new(seed);
    filled(dim, side.pow(dim as u32), |i| {
        let index = |axis: usize| i / side.pow(axis as u32) % side + 1;
        (0..dim).map(|axis| index(axis) as f64 + spread * (random.unit() - 0.5)).collect()
    })
}

/// Half on each of two lines that are a unit apart and cross at a right angle; 3D.
pub fn skew_lines(n: usize, seed: u64) -> Points {
    let mut random = Random::new(seed);
    filled(3, n, |i| {
        let along = 2.0 * random.unit() - 1.0;
        if i % 2 == 0 { vec![along, 0.0, 0.0] } else { vec![0.0, along, 1.0] }
    })
}

/// On a torus in R^4, R^5 or R^6: the cosines and sines of two angles and of their sum.
pub fn surface(dim: usize, n: usize, seed: u64) -> Points {
    let mut random = Random::new(seed);
    filled(dim, n, |_| {
        let (u, v) = (std::f64::consts::TAU * random.unit(), std::f64::consts::TAU * random.unit());
        let all = [u.cos(), u.sin(), v.cos(), v.sin(), (u + v).cos(), (u + v).sin()];
        all[..dim].to_vec()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn distance(a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).map(|(x, y)| (x - y).powi(2)).sum::<f64>().sqrt()
    }

    #[test]
    fn inputs_repeat_and_have_their_size() {
        for name in NAMES {
            let points = named(name, 3, 100, 7);
            assert_eq!(points, named(name, 3, 100, 7));
            assert_ne!(points, named(name, 3, 100, 8));
            assert_eq!(points.len(), 100);
        }
        assert_eq!(nested_clusters(2, 4, 5, 3.0, 1).len(), 20);
        assert_eq!(skew_lines(11, 1).len(), 11);
        assert_eq!(surface(6, 9, 1).coordinates.len(), 54);
    }

    #[test]
    fn pairs_keep_their_distance() {
        for log_distance in [-4, -20, -44] {
            let points = close_pairs(3, 50, log_distance, 1);
            let all: Vec<&[f64]> = points.iter().collect();
            assert_eq!(all.len(), 100);
            for pair in all.chunks(2) {
                let relative = distance(pair[0], pair[1]) * 2f64.powi(-log_distance);
                assert!((relative - 1.0).abs() < 0.02, "2^{log_distance}: {relative}");
            }
        }
    }

    #[test]
    fn clusters_keep_their_gaps() {
        for log_gap in [1.0, 48.0, 90.0] {
            let points = nested_clusters(3, 20, 50, log_gap, 1);
            let radii: Vec<f64> = points
                .iter()
                .map(|x| {
                    let largest = x.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
                    let unit: Vec<f64> = x.iter().map(|c| c / largest).collect();
                    (largest * distance(&unit, &[0.0; 3])).log2()
                })
                .collect();
            for (level, cluster) in radii.chunks(50).enumerate() {
                let expected = log_gap * (9.5 - level as f64);
                for radius in cluster {
                    let above = radius - expected;
                    assert!((-1e-9..1.5f64.log2() + 1e-9).contains(&above), "{level}: {above}");
                }
            }
        }
    }

    #[test]
    fn lines_are_skew() {
        let points = skew_lines(100, 1);
        assert!(points.iter().all(|p| (p[1], p[2]) == (0.0, 0.0) || (p[0], p[2]) == (0.0, 1.0)));
        assert_eq!(points.bounding_box()[2], [0.0, 1.0]);
    }
}
