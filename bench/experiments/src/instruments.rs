//! Ply and the D-balls that meet, as the core's instruments measure them.

use crate::inputs::Points;
use netmesh::{Mesh, Options};

#[derive(Clone, Copy, Debug, Default)]
pub struct Instruments {
    /// Most D-balls over one point (Theorem 16).
    pub max_ply: Option<f64>,
    /// Most D-balls that one D-ball meets (Theorem 19).
    pub max_ball_intersections: Option<f64>,
}

/// What the instruments say of the run with `options`: a run of its own, since they take time.
/// Nothing if it fails.
pub fn measure(points: &Points, options: &Options) -> Instruments {
    let options = Options { instruments: true, ..options.clone() };
    let run = || {
        let mut mesh = Mesh::new(points.dim, points.len(), &points.coordinates, 0).ok()?;
        mesh.run(&options, None).ok()?;
        let stats = &mesh.triangulation()?.stats;
        Some(Instruments {
            max_ply: Some(stats.max_ply as f64),
            max_ball_intersections: Some(stats.max_ball_intersections as f64),
        })
    };
    run().unwrap_or_default()
}

/// "-" for what was not measured.
pub fn cell<T>(value: Option<T>, show: impl Fn(T) -> String) -> String {
    value.map_or_else(|| "-".to_string(), show)
}
