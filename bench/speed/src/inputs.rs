//! The point sets, each a function of dimension and size alone. Defined as those of the
//! experiments, and kept apart from them: who improves an experiment must not move a speed. Only
//! the generator of numbers, which is a published one, serves both.

use crate::random::Random;

const SEED: u64 = 1;

/// Spread of the points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Distribution {
    /// In the unit cube.
    Uniform,
    Gaussian,
    /// Normal distributions of 100 points about uniform centres, in turn; their deviation is 2^-6
    /// of the centres' typical distance.
    Clusters,
    /// On the unit sphere.
    Sphere,
    /// The points with whole coordinates of the smallest cube that has enough of them, row by row:
    /// most signs are zero, and only exact arithmetic tells.
    Lattice,
}

impl Distribution {
    /// `n` points, as `n x dim` coordinates.
    pub fn points(self, dim: usize, n: usize) -> Vec<f64> {
        let mut random = Random::new(SEED);
        match self {
            Self::Uniform => (0..n * dim).map(|_| random.unit()).collect(),
            Self::Gaussian => (0..n * dim).map(|_| random.gaussian()).collect(),
            Self::Clusters => clusters(&mut random, dim, n),
            Self::Sphere => (0..n).flat_map(|_| random.direction(dim)).collect(),
            Self::Lattice => lattice(dim, n),
        }
    }
}

fn clusters(random: &mut Random, dim: usize, n: usize) -> Vec<f64> {
    let clusters = n.div_ceil(100);
    let deviation = 2f64.powi(-6) * (clusters as f64).powf(-1.0 / dim as f64);
    let centers: Vec<f64> = (0..clusters * dim).map(|_| random.unit()).collect();
    centers.iter().cycle().take(n * dim).map(|x| x + random.gaussian() * deviation).collect()
}

fn lattice(dim: usize, n: usize) -> Vec<f64> {
    let side = (1..).find(|side: &usize| side.pow(dim as u32) >= n).expect("a side");
    let coordinate = |point: usize, axis: usize| (point / side.pow(axis as u32) % side) as f64;
    (0..n).flat_map(|point| (0..dim).map(move |axis| coordinate(point, axis))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inputs_repeat_and_have_their_size() {
        use Distribution::{Clusters, Gaussian, Lattice, Sphere, Uniform};
        for distribution in [Uniform, Gaussian, Clusters, Sphere, Lattice] {
            let points = distribution.points(3, 250);
            assert_eq!(points.len(), 750);
            assert_eq!(points, distribution.points(3, 250));
        }
    }

    #[test]
    fn clusters_are_narrow() {
        let points = Distribution::Clusters.points(2, 250);
        let (first, same_cluster) = (&points[..2], &points[6..8]);
        assert!(first.iter().zip(same_cluster).all(|(a, b)| (a - b).abs() < 0.1));
    }

    #[test]
    fn lattices_have_whole_coordinates_and_no_point_twice() {
        let points = Distribution::Lattice.points(3, 20);
        assert_eq!(points[..9], [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2.0, 0.0, 0.0]);
        assert_eq!(points[57..], [1.0, 0.0, 2.0]);
        let bits = |point: &[f64]| point.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        let mut all: Vec<_> = points.chunks(3).map(bits).collect();
        all.sort_unstable();
        all.dedup();
        assert_eq!(all.len(), 20);
    }
}
