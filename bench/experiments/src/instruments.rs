//! Where the core's instruments plug in: ply and the paper's constants of a run. Without them the
//! columns show "-" and the verdicts say that nothing was measured.

use netmesh::{Options, Stats};

#[derive(Clone, Copy, Debug, Default)]
pub struct Instruments {
    /// Most D-balls over one point (Theorem 16).
    pub max_ply: Option<f64>,
    pub mean_ply: Option<f64>,
    /// Most D-balls that one D-ball meets (Theorem 19).
    pub max_ball_intersections: Option<f64>,
    /// Vertices that closing the slits beside cages costs.
    pub closing_points: Option<u64>,
}

/// `options` with the instruments on.
pub fn on(options: &Options) -> Options {
    options.clone()
}

pub fn read(_stats: &Stats) -> Instruments {
    Instruments::default()
}

/// "-" for what was not measured.
pub fn cell<T>(value: Option<T>, show: impl Fn(T) -> String) -> String {
    value.map_or_else(|| "-".to_string(), show)
}
