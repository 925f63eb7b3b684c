//! Ply and the D-balls that meet, as the core's instruments measure them.

use netmesh::Stats;

#[derive(Clone, Copy, Debug)]
pub struct Instruments {
    /// Most D-balls over one point (Theorem 16).
    pub max_ply: f64,
    /// Most D-balls that one D-ball meets (Theorem 19).
    pub max_ball_intersections: f64,
}

impl Instruments {
    /// Returns the figures of a run with `Options::instruments`.
    pub fn of(stats: &Stats) -> Self {
        Self {
            max_ply: stats.max_ply as f64,
            max_ball_intersections: stats.max_ball_intersections as f64,
        }
    }
}
