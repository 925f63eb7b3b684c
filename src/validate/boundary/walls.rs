//! Walls: the pieces of a boundary that separate simplices, subsegments in the plane and subfacets
//! in space, with the simplices on their sides.

use crate::memory::{AllocResult, filled};
use crate::mesh::{NONE, Triangulation};
use crate::quality::view::View;

/// Walls among the facets of the simplices.
pub(super) struct Walls {
    /// Simplex and slot -> the wall opposite the vertex there, or [`NONE`].
    of_slots: Vec<u32>,
    /// Wall -> the simplex whose boundary runs along it, and the one whose boundary runs against
    /// it, or [`NONE`]: in the plane the triangles on its left and on its right, in space the
    /// tetrahedra behind it and where its normal points to.
    pub sides: Vec<[u32; 2]>,
    per_simplex: usize,
}

impl Walls {
    /// Finds the walls among the facets of the simplices. `find` has the wall with the vertices of
    /// a facet, and whether both have one orientation.
    pub fn find<const D: usize>(
        view: View<'_, D>,
        find: impl Fn(&[u32; D]) -> Option<(u32, bool)>,
    ) -> AllocResult<Self> {
        let per_simplex = D + 1;
        let mut of_slots = filled(per_simplex * view.simplex_count(), NONE)?;
        let mut sides = filled(count::<D>(view.mesh), [NONE; 2])?;
        for simplex in 0..view.simplex_count() {
            for slot in 0..per_simplex {
                if let Some((wall, is_along)) = find(&facet(view, simplex, slot)) {
                    sides[wall as usize][usize::from(!is_along)] = simplex as u32;
                    of_slots[per_simplex * simplex + slot] = wall;
                }
            }
        }
        Ok(Self { of_slots, sides, per_simplex })
    }

    /// Returns the wall across which `simplex` has its neighbour at `slot`, or [`NONE`].
    pub fn across(&self, simplex: usize, slot: usize) -> u32 {
        self.of_slots[self.per_simplex * simplex + slot]
    }
}

/// Returns the facet opposite the vertex at `slot`, as the boundary of the simplex has it: in the
/// plane the simplex is on its left, in space its normal points out of the simplex.
pub(super) fn facet<const D: usize>(view: View<'_, D>, simplex: usize, slot: usize) -> [u32; D] {
    let vertices = view.simplex(simplex);
    let mut facet = std::array::from_fn(|at| vertices[at + usize::from(at >= slot)]);
    if slot % 2 == 1 {
        facet.swap(0, 1);
    }
    facet
}

/// Returns the number of walls.
fn count<const D: usize>(mesh: &Triangulation) -> usize {
    if D == 2 { mesh.boundary.subsegments.len() } else { mesh.boundary.subfacets.len() }
}

/// Returns the vertices of a wall.
pub(super) fn vertices<const D: usize>(mesh: &Triangulation, wall: usize) -> [u32; D] {
    let vertices = match D {
        2 => &mesh.boundary.subsegments[wall][..],
        _ => &mesh.boundary.subfacets[wall][..],
    };
    std::array::from_fn(|at| vertices[at])
}

/// Returns the word for a wall in messages.
pub(super) fn noun<const D: usize>() -> &'static str {
    if D == 2 { "subsegment" } else { "subfacet" }
}
