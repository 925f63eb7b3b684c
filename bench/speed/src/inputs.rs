//! The point sets, each a function of dimension and size alone. Defined as those of the experiments,
//! and kept apart from them: who improves an experiment must not move a speed.

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
        let mut random = Random { state: SEED };
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

/// SplitMix64 [Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014]: the
/// inputs depend on no library's version.
struct Random {
    state: u64,
}

impl Random {
    fn unit(&mut self) -> f64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn gaussian(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.unit()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.unit()).cos()
    }

    fn direction(&mut self, dim: usize) -> Vec<f64> {
        loop {
            let vector: Vec<f64> = (0..dim).map(|_| self.gaussian()).collect();
            let length = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
            if length > 1e-3 {
                return vector.into_iter().map(|x| x / length).collect();
            }
        }
    }
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
