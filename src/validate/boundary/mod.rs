//! The rules of boundaries in the plane: segments, regions, and the domain that is cropped.
//!
//! - Level 1, `arrays`: they fit each other and the mesh.
//! - Level 2: `edges`, every subsegment is a Gabriel edge; `lines`, vertices on segments are as
//!   near to them as doubles can be; `chains`, subsegments lead from end to end of every segment;
//!   `frame`, those of a hull or box go round the inputs.
//! - Level 3: `regions`, what segments separate, with the labels of seeds; `interior`, which of
//!   them closed curves enclose; `areas`, of the regions; `forced`, the triangles that small angles
//!   between segments excuse.
//!
//! `anchors` are the ends of lines; `exact` and `sum` are the arithmetic. What an edge is on both
//! sides of is found here from the triangles alone.

mod anchors;
mod areas;
mod arrays;
mod chains;
mod edges;
mod exact;
mod forced;
mod frame;
mod interior;
mod lines;
mod regions;
mod sum;
#[cfg(test)]
mod tests;

use super::report::Findings;
use crate::memory::AllocResult;
use crate::mesh::{Inputs, Region, Segments, Triangulation};
use crate::options::Extent;
use crate::quality::view::View;
use anchors::Anchors;
use edges::Edges;
use lines::Lines;

/// Segments and regions that the caller of a run gave beside the points.
#[derive(Clone, Copy, Debug)]
pub struct Outline<'a> {
    pub segments: &'a Segments,
    pub regions: &'a [Region],
}

/// The simplices that quality is promised for.
#[derive(Clone, Copy)]
pub(super) struct Promised<'a> {
    /// The number of simplices in the domain, which come first.
    count: usize,
    /// Others are cropped.
    is_cropped: bool,
    forced: &'a [u32],
}

impl<'a> Promised<'a> {
    pub fn of(result: &'a Triangulation) -> Self {
        let (count, boundary) = (result.simplex_count(), &result.boundary);
        Self { count, is_cropped: boundary.whole.is_some(), forced: &boundary.forced }
    }

    pub fn count(self) -> usize {
        self.count
    }

    pub fn includes(self, simplex: usize) -> bool {
        simplex < self.count && self.forced.binary_search(&(simplex as u32)).is_err()
    }
}

/// Checks level 1 of `result`, which is cropped from `whole` or equal to it.
pub(super) fn check_arrays<const D: usize>(
    outline: Option<Outline<'_>>,
    result: &Triangulation,
    whole: View<'_, D>,
    findings: &mut Findings,
) -> AllocResult<()> {
    arrays::check(outline, result, whole.mesh, findings);
    // Ids are in range only if nothing is wrong.
    if D == 2 && result.boundary.whole.is_some() && findings.clean() {
        arrays::check_kept(result, View { mesh: whole.mesh }, findings)?;
    }
    Ok(())
}

/// Checks level 2 of a mesh for which level 1 holds.
pub(super) fn check_geometry<const D: usize>(
    inputs: &Inputs,
    outline: Option<Outline<'_>>,
    whole: View<'_, D>,
    findings: &mut Findings,
) -> AllocResult<()> {
    let Some(view) = in_the_plane(outline, whole) else { return Ok(()) };
    let edges = Edges::new(view)?;
    edges::check(view, &edges, findings)?;
    if let Some(Outline { segments, .. }) = outline {
        chains::check(inputs, segments, view, &edges, findings)?;
    }
    frame::check(inputs, view, &edges, findings)?;
    let anchors = Anchors::new(view, inputs.distinct(), &edges);
    lines::check(view, &Lines::new(view.mesh, &anchors)?, findings)
}

/// Checks level 3 of a mesh for which level 1 holds.
pub(super) fn check_regions<const D: usize>(
    inputs: &Inputs,
    outline: Option<Outline<'_>>,
    whole: View<'_, D>,
    promised: Promised<'_>,
    findings: &mut Findings,
) -> AllocResult<()> {
    let Some(view) = in_the_plane(outline, whole) else { return Ok(()) };
    let edges = Edges::new(view)?;
    if !view.mesh.boundary.subsegments.is_empty() {
        regions::check(inputs, outline, view, &edges, promised, findings)?;
        areas::check(view, &edges, promised.count, findings)?;
    }
    let anchors = Anchors::new(view, inputs.distinct(), &edges);
    let lines = Lines::new(view.mesh, &anchors)?;
    forced::check(view, &edges, &lines, &anchors, findings)
}

/// Returns for each simplex the largest edge that the seed of its region asks for, or infinity;
/// empty if none does.
pub(super) fn largest_edges<const D: usize>(
    outline: Option<Outline<'_>>,
    whole: View<'_, D>,
) -> AllocResult<Vec<f64>> {
    let regions = outline.map_or(&[][..], |outline| outline.regions);
    match in_the_plane(outline, whole) {
        Some(view) if regions.iter().any(|region| region.max_edge > 0.0) => {
            regions::largest_edges(view, &Edges::new(view)?, regions)
        }
        _ => Ok(Vec::new()),
    }
}

/// Returns the mesh as one of the plane; `None` without segments or the boundary of an extent,
/// which only the plane has.
fn in_the_plane<'a, const D: usize>(
    outline: Option<Outline<'_>>,
    whole: View<'a, D>,
) -> Option<View<'a, 2>> {
    let has_boundary = !whole.mesh.boundary.subsegments.is_empty()
        || matches!(whole.mesh.parameters.extent, Extent::Hull | Extent::Box)
        || outline.is_some_and(|outline| outline.segments.count() > 0);
    (D == 2 && has_boundary).then_some(View { mesh: whole.mesh })
}
