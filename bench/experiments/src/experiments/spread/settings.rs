//! The inputs of the curves, and what changes along them.

use crate::experiments::Context;
use crate::inputs::{self, Points};

const LEVELS: usize = 20;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Clusters,
    Pairs,
    Chain,
}

/// Setting that is changed along a curve: the gap of a level, the pairs' distance, the pacing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    /// log2 of the gap per level, of 1 / distance, or of the pacing.
    pub exponent: f64,
    /// log2 of the empty space around a cluster or pair over its size; none in a chain.
    pub log_gap: Option<f64>,
    /// log2 of the spread, but for a constant.
    pub log_spread: f64,
}

impl Kind {
    pub const ALL: [Kind; 3] = [Kind::Clusters, Kind::Pairs, Kind::Chain];

    pub fn name(self) -> &'static str {
        match self {
            Kind::Clusters => "clusters",
            Kind::Pairs => "pairs",
            Kind::Chain => "chain",
        }
    }

    pub fn title(self) -> &'static str {
        match self {
            Kind::Clusters => "20 nested clusters of 50 points",
            Kind::Pairs => "500 close pairs",
            Kind::Chain => "One point a level",
        }
    }

    /// Fewer in 4D, where a run takes longer.
    pub fn exponents(self, context: &Context, dim: usize) -> Vec<f64> {
        let all: &[f64] = match (self, dim) {
            (Kind::Clusters, 4) => &[1.0, 2.0, 4.0, 6.0, 8.0, 10.0, 12.0, 24.0, 48.0, 90.0],
            (Kind::Clusters, _) => &[
                1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 10.0, 12.0, 16.0, 24.0, 32.0, 48.0, 64.0,
                90.0,
            ],
            (Kind::Pairs, 4) => &[4.0, 6.0, 8.0, 10.0, 12.0, 16.0, 24.0, 32.0, 44.0],
            (Kind::Pairs, _) => &[
                4.0, 6.0, 8.0, 10.0, 12.0, 14.0, 16.0, 18.0, 20.0, 24.0, 28.0, 32.0, 36.0, 40.0,
                44.0,
            ],
            (Kind::Chain, 4) => &[0.02, 0.25, 0.5, 1.0, 1.5],
            (Kind::Chain, _) => &[0.02, 0.1, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75, 1.9],
        };
        let step = context.pick(4, 1, 1);
        all.iter().copied().step_by(step).collect()
    }

    pub fn setting(self, dim: usize, n: usize, exponent: f64) -> Setting {
        let n = n as f64;
        match self {
            Kind::Clusters => Setting {
                exponent,
                log_gap: Some(exponent),
                log_spread: exponent * (LEVELS - 1) as f64,
            },
            Kind::Pairs => {
                let spacing = (n / 2.0).log2() / dim as f64;
                Setting { exponent, log_gap: Some(exponent - spacing), log_spread: exponent }
            }
            Kind::Chain => Setting { exponent, log_gap: None, log_spread: exponent * (n - 1.0) },
        }
    }

    pub fn points(self, dim: usize, n: usize, exponent: f64, seed: u64) -> Points {
        match self {
            Kind::Clusters => inputs::nested_clusters(dim, LEVELS, n / LEVELS, exponent, seed),
            Kind::Pairs => inputs::close_pairs(dim, n / 2, -(exponent as i32), seed),
            Kind::Chain => inputs::nested_clusters(dim, n, 1, exponent, seed),
        }
    }
}
