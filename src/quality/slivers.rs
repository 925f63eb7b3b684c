//! Simplices with a smaller dihedral angle than was asked for.

use super::angles::{angle, smallest_squared_tangent};
use super::view::View;
use crate::memory::AllocResult;

/// Calls `visit` for every simplex with a dihedral angle below `degrees` that is not flat in a
/// facet: its id, the angle in degrees and whether all its vertices are in one domain. Ids must be
/// in range. O(simplices).
pub(crate) fn survey<const D: usize>(
    view: View<'_, D>,
    degrees: f64,
    mut visit: impl FnMut(usize, f64, bool),
) -> AllocResult<()> {
    if degrees <= 0.0 {
        return Ok(());
    }
    for simplex in 0..view.simplex_count() {
        let vertices = view.simplex(simplex);
        let points = view.points_of(vertices);
        let tangent = smallest_squared_tangent(&points[..View::<D>::VERTICES])?;
        let is_flat = || view.mesh.boundary.flat.binary_search(&(simplex as u32)).is_ok();
        if is_below(tangent, degrees) && !is_flat() {
            let domain = |vertex: u32| view.mesh.vertex_domains[vertex as usize];
            let is_of_one = vertices.iter().all(|&vertex| domain(vertex) == domain(vertices[0]));
            visit(simplex, angle(tangent).to_degrees(), is_of_one);
        }
    }
    Ok(())
}

/// Returns true if the angle whose half has a tangent with this square is below `degrees`.
pub(super) fn is_below(squared_tangent: f64, degrees: f64) -> bool {
    degrees > 0.0 && angle(squared_tangent).to_degrees() < degrees
}
