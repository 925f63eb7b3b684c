//! The rules of boundaries: segments, facets, regions, and the domain that is cropped. Those of the
//! plane are here, and what space has in common with them; those of facets in space are in
//! [`space`].
//!
//! - Level 1, `arrays`: they fit each other and the mesh.
//! - Level 2: `edges`, every subsegment is a Gabriel edge; `lines`, vertices on segments are as
//!   near to them as doubles can be; `chains`, subsegments lead from end to end of every segment;
//!   `frame`, those of a hull or box go round the inputs.
//! - Level 3: `regions`, what segments separate, with the labels of seeds; `interior`, which of
//!   them closed curves enclose; `labels`, the numbers of those without a seed; `areas`, of the
//!   regions; `forced`, the triangles that small angles between segments excuse.
//!
//! `anchors` are the ends of lines; `rims` tell several chains apart; `exact` and `sum` are the
//! arithmetic. Which simplices are on the sides of a subsegment or subfacet is found here from the
//! simplices alone (`walls`).

mod anchors;
mod areas;
mod arrays;
mod chains;
mod edges;
mod exact;
mod forced;
mod frame;
mod interior;
mod labels;
mod lines;
mod regions;
mod rims;
mod roundings;
mod space;
mod sum;
#[cfg(test)]
mod tests;
mod walls;

use super::report::Findings;
use crate::memory::AllocResult;
use crate::mesh::{Boundary, Facets, Inputs, Region, Segments, Triangulation};
use crate::options::Extent;
use crate::quality::view::View;
use anchors::Anchors;
use edges::Edges;
use lines::Lines;
use space::Reading;

/// Segments, facets and regions that the caller of a run gave beside the points.
#[derive(Clone, Copy, Debug)]
pub struct Outline<'a> {
    pub segments: &'a Segments,
    /// Facets in space; none in the plane.
    pub facets: &'a Facets,
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
    flat: &'a [u32],
}

impl<'a> Promised<'a> {
    pub fn of(result: &'a Triangulation) -> Self {
        let (count, boundary) = (result.simplex_count(), &result.boundary);
        let Boundary { whole, forced, flat, .. } = boundary;
        Self { count, is_cropped: whole.is_some(), forced, flat }
    }

    pub fn count(self) -> usize {
        self.count
    }

    pub fn includes(self, simplex: usize) -> bool {
        simplex < self.count
            && self.forced.binary_search(&(simplex as u32)).is_err()
            && !self.is_flat(simplex)
    }

    /// Returns true if all vertices of a simplex are on one facet, so that roundings make it.
    pub fn is_flat(self, simplex: usize) -> bool {
        self.flat.binary_search(&(simplex as u32)).is_ok()
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
    if !findings.clean() {
        return Ok(());
    }
    match D {
        2 if result.boundary.whole.is_some() => {
            arrays::check_kept(result, View { mesh: whole.mesh }, findings)
        }
        3 => space::check_arrays(result, View { mesh: whole.mesh }, findings),
        _ => Ok(()),
    }
}

/// Checks level 2 of a mesh for which level 1 holds. Returns how facets in space are read.
pub(super) fn check_geometry<const D: usize>(
    inputs: &Inputs,
    outline: Option<Outline<'_>>,
    whole: View<'_, D>,
    findings: &mut Findings,
) -> AllocResult<Option<Reading>> {
    if D == 3 {
        let whole = View { mesh: whole.mesh };
        return Ok(Some(space::check_geometry(inputs, outline, whole, findings)?));
    }
    let Some(view) = in_the_plane(outline, whole) else { return Ok(None) };
    let edges = Edges::new(view)?;
    edges::check(view, &edges, findings)?;
    if let Some(Outline { segments, .. }) = outline {
        chains::check(inputs, segments, view, &edges, findings)?;
    }
    frame::check(inputs, view, &edges, findings)?;
    let anchors = Anchors::new(view, inputs.distinct(), &edges);
    lines::check(view, &Lines::new(view.mesh, &anchors)?, findings)?;
    Ok(None)
}

/// Checks level 3 of a mesh for which level 1 holds, and that is read as level 2 does.
pub(super) fn check_regions<const D: usize>(
    inputs: &Inputs,
    outline: Option<Outline<'_>>,
    whole: View<'_, D>,
    (reading, promised): (Option<&Reading>, Promised<'_>),
    findings: &mut Findings,
) -> AllocResult<()> {
    if let (3, Some(reading)) = (D, reading) {
        return space::check_regions(
            inputs,
            outline,
            View { mesh: whole.mesh },
            (reading, promised),
            findings,
        );
    }
    let Some(view) = in_the_plane(outline, whole) else { return Ok(()) };
    let edges = Edges::new(view)?;
    if !view.mesh.boundary.subsegments.is_empty() {
        let steps = match outline {
            Some(Outline { segments, .. }) if interior::is_asked(view) => {
                Some(interior::steps(inputs, segments, view, &edges)?)
            }
            _ => None,
        };
        regions::check(outline, view, &edges.walls, steps, promised, findings)?;
        areas::check(view, &edges.walls, promised.count, findings)?;
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
    if !regions.iter().any(|region| region.max_edge > 0.0) {
        return Ok(Vec::new());
    }
    if D == 3 {
        let view = View::<3> { mesh: whole.mesh };
        return regions::largest_edges(view, &space::walls(view)?, regions);
    }
    match in_the_plane(outline, whole) {
        Some(view) => regions::largest_edges(view, &Edges::new(view)?.walls, regions),
        None => Ok(Vec::new()),
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
