//! Numbers that are the same in every run, and the points that tests make of them.

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

pub struct Random(Pcg64Mcg);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(Pcg64Mcg::seed_from_u64(seed))
    }

    /// A double in \[0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Any finite double, by its bits.
    pub fn finite(&mut self) -> f64 {
        loop {
            let x = f64::from_bits(self.0.next_u64());
            if x.is_finite() {
                return x;
            }
        }
    }

    /// `n` points in the unit cube.
    pub fn uniform(&mut self, dim: usize, n: usize) -> Vec<f64> {
        (0..n * dim).map(|_| self.unit()).collect()
    }
}
