//! The triangles between their inputs that polygons consist of.

use super::faults::refused;
use super::isolated::Isolated;
use super::pieces::Pieces;
use super::{TaskInSpace, as_given, pieces_as_given, points_of};
use crate::arrangement::poll::Poll;
use crate::error::{Error, Result};
use crate::memory::TryGrow;
use crate::mesh::{FacetTriangulation, Facets, Inputs, Segments};
use crate::options::Crossings;

/// Returns the first polygon that is not plane, and bent by more than `coplanar` degrees. O(n log
/// n) for n inputs of the facets.
///
/// # Errors
/// `OutOfMemory`, and those of `poll`.
pub fn bent_polygon(
    inputs: &Inputs,
    facets: &Facets,
    coplanar: f64,
    poll: Poll<'_>,
) -> Result<Option<u32>> {
    let (points, segments) = (points_of(inputs)?, &Segments::default());
    let task = TaskInSpace { coplanar, ..as_given(inputs, facets, segments) };
    let pieces = Pieces::new(&points, &task, &Isolated::default(), poll)?;
    Ok(pieces.off_plane.map(|(facet, _)| facet))
}

/// Returns the triangles that facets consist of, seen along an axis. O(n log n) for n inputs of the
/// facets.
///
/// # Errors
/// `InvalidArgument` (a facet that meets itself, has no area or has segments within),
/// `OutOfMemory`, and those of `poll`.
pub fn triangulate(inputs: &Inputs, facets: &Facets, poll: Poll<'_>) -> Result<FacetTriangulation> {
    let points = points_of(inputs)?;
    let pieces = pieces_as_given(&points, inputs, facets, &Segments::default(), poll)?;
    if let Some(first) = pieces.faults.first() {
        return Err(refused(facets, first, pieces.faults.len(), Crossings::Refuse));
    }
    if !pieces.lines.is_empty() {
        let message = "facets have segments within, which triangles would not keep";
        return Err(Error::invalid(message));
    }
    let mut found = FacetTriangulation::default();
    for piece in &pieces.all {
        let (Some(triangle), Some(facet)) = (piece.triangle(), piece.facet()) else { continue };
        let input = |vertex: u32| inputs.first_input(vertex as usize).unwrap_or(vertex);
        found.triangles.try_push(triangle.map(input))?;
        found.parents.try_push(facet)?;
    }
    Ok(found)
}
