//! Random numbers of one sliver, which its vertices and the effort determine.

use crate::complex::VertexId;
use crate::netmesh::slivers::queue::Sliver;

/// SplitMix64 (Steele, Lea and Flood, 2014).
pub(super) struct Random(u64);

impl Random {
    pub fn of(sliver: &Sliver, effort: u32) -> Self {
        let mut random = Self(u64::from(effort));
        for vertex in sliver.vertices {
            random.0 ^= u64::from(vertex.number());
            random.0 = random.bits();
        }
        random
    }

    /// Returns the random numbers of one vertex.
    pub fn of_vertex(vertex: VertexId) -> Self {
        Self(u64::from(vertex.number()) << 32)
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(crate::numerics::SplitMix::STEP);
        crate::numerics::mixed(self.0)
    }

    /// Returns a number in [-1, 1).
    fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * f64::EPSILON - 1.0
    }

    /// Returns a number in [0, 1).
    pub fn fraction(&mut self) -> f64 {
        0.5 + 0.5 * self.unit()
    }

    /// Returns a point of the unit ball.
    pub fn in_ball(&mut self) -> [f64; 3] {
        loop {
            let x: [f64; 3] = std::array::from_fn(|_| self.unit());
            if x.iter().map(|x| x * x).sum::<f64>() <= 1.0 {
                return x;
            }
        }
    }
}
