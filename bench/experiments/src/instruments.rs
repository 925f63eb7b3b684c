//! Where the core's instruments plug in: ply and the paper's constants of a run. Without them the
//! columns show "-" and the verdicts say that nothing was measured.

use crate::inputs::Points;
use netmesh::{Options, Stats};

#[derive(Clone, Copy, Debug, Default)]
pub struct Instruments {
    /// Most D-balls over one point (Theorem 16).
    pub max_ply: Option<f64>,
    /// Most D-balls that one D-ball meets (Theorem 19).
    pub max_ball_intersections: Option<f64>,
}

/// What the instruments say of the run with `options`: a run of its own, since they take time.
pub fn measure(_points: &Points, _options: &Options) -> Instruments {
    Instruments::default()
}

/// Vertices that closing the slits beside cages costs.
pub fn closing_points(_stats: &Stats) -> Option<u64> {
    None
}

/// "-" for what was not measured.
pub fn cell<T>(value: Option<T>, show: impl Fn(T) -> String) -> String {
    value.map_or_else(|| "-".to_string(), show)
}
