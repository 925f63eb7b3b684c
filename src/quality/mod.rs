//! quality

use crate::mesh::Triangulation;

/// The quality of a mesh; DESIGN section 4 has the conventions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Quality {
    /// Largest number of Delaunay neighbours of a vertex.
    pub max_degree: u32,
    /// Worst Voronoi aspect of a non-cage vertex's cell, corners restricted to its domain.
    pub worst_aspect: f64,
    /// Worst Voronoi aspect of all cells off the hull, unrestricted.
    pub worst_aspect_anywhere: f64,
    pub mean_aspect: f64,
    /// Worst aspect of the union cell of a cage.
    pub worst_cage_aspect: f64,
    pub worst_radius_edge: f64,
    /// Smallest angle (2D) or dihedral angle (3D and up).
    pub min_angle_degrees: f64,
    pub precision_limited: u64,
}

/// Measures `triangulation`.
pub fn measure(_triangulation: &Triangulation) -> Quality {
    Quality::default()
}
