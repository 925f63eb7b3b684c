//! The point sets, each a function of dimension and size alone. Defined as those of the experiments,
//! and kept apart from them: who improves an experiment must not move a speed. Only the generator of
//! numbers, which is a published one, serves both.

use crate::random::Random;

const SEED: u64 = 1;

/// How the points are spread.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Distribution {
    /// In the unit cube.
    Uniform,
    Gaussian,
    /// Normal distributions of 100 points about uniform centres, in turn; their deviation is 2^-6 of
    /// the centres' typical distance.
    Clusters,
    /// On the unit sphere.
    Sphere,
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
        }
    }
}

fn clusters(random: &mut Random, dim: usize, n: usize) -> Vec<f64> {
    let clusters = n.div_ceil(100);
    let deviation = 2f64.powi(-6) * (clusters as f64).powf(-1.0 / dim as f64);
    let centers: Vec<f64> = (0..clusters * dim).map(|_| random.unit()).collect();
    centers.iter().cycle().take(n * dim).map(|x| x + random.gaussian() * deviation).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inputs_repeat_and_have_their_size() {
        use Distribution::{Clusters, Gaussian, Sphere, Uniform};
        for distribution in [Uniform, Gaussian, Clusters, Sphere] {
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
}
