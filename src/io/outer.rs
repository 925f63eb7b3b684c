//! Triangles at which a mesh in space ends.

use crate::memory::{AllocResult, TryGrow};
use crate::mesh::{NONE, Triangulation};

/// Side of a tetrahedron: its number, and which of its vertices the side does not have.
pub(super) type Side = (u32, u32);

/// Returns the sides of tetrahedra without a neighbour, each as a triangle that is counterclockwise
/// as seen from outside.
pub(super) fn outer_triangles(
    mesh: &Triangulation,
) -> impl Iterator<Item = (Side, [u32; 3])> + Clone {
    const SIDES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];
    let all = mesh.simplices.chunks_exact(4).zip(mesh.neighbors.chunks_exact(4)).zip(0u32..);
    all.flat_map(|((vertices, neighbors), simplex)| {
        let ends = neighbors.iter().zip(SIDES).zip(0u32..);
        let ends = ends.filter(|((neighbor, _), _)| **neighbor == NONE);
        ends.map(move |((_, side), at)| ((simplex, at), side.map(|index| vertices[index])))
    })
}

/// Returns the sides of tetrahedra at which the mesh ends and that are parts of facets, sorted,
/// with the markers of their facets. O(n log n) for n triangles of facets.
pub(super) fn marked_sides(mesh: &Triangulation, markers: &[i32]) -> AllocResult<Vec<(Side, i32)>> {
    let mut found = Vec::new();
    let marked = mesh.boundary.marked_facets(markers);
    for ((triangle, marker), simplices) in marked.zip(&mesh.boundary.subfacet_simplices) {
        let ([NONE, simplex] | [simplex, NONE]) = *simplices else { continue };
        let lacks = |vertex: &u32| !triangle.contains(vertex);
        if let Some(at) = mesh.simplex(simplex as usize).iter().position(lacks) {
            found.try_push(((simplex, at as u32), marker))?;
        }
    }
    found.sort_unstable();
    Ok(found)
}
