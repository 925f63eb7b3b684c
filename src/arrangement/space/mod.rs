//! The caller's facets and segments in space, which must meet only in what they have in common,
//! exactly.
//!
//! - [`polygon`] splits a polygon facet into triangles between its vertices, by a triangulation
//!   that has its edges ([`planar`]) in a [`projection`] of its [`plane`]; [`pieces`] has the
//!   triangles of all facets, and the segments.
//! - [`meet`] tells exactly whether and how two of these meet, and [`intersections`] collects all
//!   that must not; [`crossed`] does that for the edges of one polygon. [`faults`] has the words
//!   for what is refused.
//! - [`isolated`] finds inputs on facets and segments that these do not have.
//! - [`split`] makes vertices and edges of crossings, and leaves areas that facets share to the
//!   first of them; [`duplicates`] has triangles that are there several times.
//! - [`merge`] makes one facet of triangles that [`bends`] shows to be in one plane; [`facets`]
//!   puts these and polygons into the arrangement, and [`lines`] the edges at which they end.
//!   [`turned`] refuses what bends have turned round.
//! - [`closed`] tells whether facets are closed surfaces, and whether they enclose something;
//!   [`sides`] has what meets at an edge. [`holes`] finds loops at which surfaces are open, and
//!   [`filling`] has triangles that close one.
//! - [`curvature`] has the sizes that edges should have where facets are round.
//! - [`triangulation`] has the triangles that polygons consist of.
//! - [`frame`] has the sides of a box or, by [`hull`], of the convex hull of the inputs; [`fit`]
//!   leads them through the inputs, facets and segments on them.

mod bends;
#[cfg(test)]
mod bent_tests;
mod closed;
mod crossed;
mod curvature;
mod duplicates;
mod facets;
mod faults;
#[cfg(test)]
mod file_tests;
mod filling;
mod fit;
mod frame;
mod holes;
mod hull;
mod intersections;
mod isolated;
mod lines;
mod meet;
#[cfg(test)]
mod meet_tests;
mod merge;
mod odd_edges;
mod off_plane;
#[cfg(test)]
mod oracle;
mod pieces;
mod planar;
mod plane;
mod polygon;
#[cfg(test)]
mod polygon_tests;
mod projection;
mod sides;
mod split;
#[cfg(test)]
mod tests;
mod triangulation;
mod turned;

pub use closed::{check_closed_in_space, encloses_in_space};
pub use curvature::CurvatureSizes;
pub use duplicates::count_duplicates;
pub use holes::fill_holes;
pub use odd_edges::find_odd_edges;
pub use triangulation::{bent_polygon, triangulate};

use super::poll::Poll;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow, collected, copied, with_capacity};
use crate::mesh::{Arrangement, Facets, Feature, Inputs, Intersection, Region, Segments};
use crate::numerics::coordinates;
use crate::options::{Crossings, Extent};
use facets::{add_frame, add_polygons, add_surface};
use faults::{no_hull_of_crossings, not_plane, refused};
use isolated::Isolated;
use pieces::Pieces;

/// Facets and segments in space to arrange, and the extent whose boundary they are in.
#[derive(Clone, Copy)]
pub struct TaskInSpace<'a> {
    pub inputs: &'a Inputs,
    pub facets: &'a Facets,
    pub segments: &'a Segments,
    pub regions: &'a [Region],
    /// Largest angle in degrees by which triangles of one facet bend; 0 for what rounding explains.
    pub coplanar: f64,
    /// A box or hull has facets of its own.
    pub extent: Extent,
    pub crossings: Crossings,
}

impl TaskInSpace<'_> {
    /// Returns the vertices of each of the caller's triangles; nothing for polygons.
    fn triangles(&self) -> impl Iterator<Item = [u32; 3]> {
        let own = if self.facets.are_triangles { &self.facets.inputs[..] } else { &[] };
        own.chunks_exact(3).map(|own| [0, 1, 2].map(|at| self.inputs.vertices()[own[at] as usize]))
    }
}

/// Returns the arrangement of facets and segments between inputs in space, and of the boundary of a
/// box or hull. Expected O((n + k) log n) for n triangles and segments, of which k pairs have
/// bounding boxes that meet. `poll` is told of the work of each step, and may end the operation.
///
/// # Errors
/// `InvalidArgument` (facets or segments that meet in more than vertices and edges of both, facets
/// that meet themselves, have no area or are not plane), `DegenerateInput` (a hull or box without
/// volume), `Limit`, `OutOfMemory`, and those of `poll`.
pub fn arrange_in_space(task: &TaskInSpace<'_>, poll: Poll<'_>) -> Result<Arrangement> {
    let TaskInSpace { inputs, facets, segments, .. } = *task;
    let mut points = points_of(inputs)?;
    let mut pieces = Pieces::new(&points, task, &Isolated::default(), poll)?;
    if let Some((facet, off)) = &pieces.off_plane {
        return Err(not_plane(inputs, *facet, off));
    }
    let found = intersections::all(&points, &pieces, poll)?;
    let mut arrangement = Arrangement { regions: copied(task.regions)?, ..Arrangement::default() };
    let meet = !found.is_empty();
    let is_split = task.crossings == Crossings::Split
        && pieces.untiled.is_empty()
        && (meet || split::is_split_by_rounding(&points, task, &pieces, poll)?);
    let split = if is_split { split::split(&mut points, task, &pieces, meet, poll)? } else { None };
    if let Some(split) = split {
        pieces = split;
        if task.extent == Extent::Hull {
            return Err(no_hull_of_crossings());
        }
    } else if let Some(first) = found.first() {
        return Err(refused(facets, first, found.len(), task.crossings));
    } else {
        // A split that came to no end has added vertices.
        points.truncate(inputs.distinct());
        if let Some((through, isolated)) = through_isolated(&points, task, &pieces, poll)? {
            pieces = through;
            isolated.offsets().for_each(|offset| arrangement.note_offset(offset));
        }
    }
    match facets.are_triangles {
        true => add_surface(&points, task, &mut pieces, &mut arrangement, poll)?,
        false => add_polygons(&pieces, &mut arrangement, poll)?,
    }
    if let Some(fitted) = fit::fitted(&mut points, task.extent, &pieces, poll)? {
        add_frame(&fitted, &mut arrangement)?;
    }
    arrangement.corners = copied(&points[inputs.distinct()..])?;
    let mut parts = with_capacity(segments.inputs.len())?;
    for piece in &pieces.all {
        if let (Feature::Segment(segment), &[from, to]) = (piece.feature, piece.vertices()) {
            parts.try_push(([from, to], segment))?;
        }
    }
    arrangement.subsegments = lines::lines(&arrangement.triangles, &parts, &pieces.lines, poll)?;
    arrangement.covered_segments = lines::covered(segments.count(), &arrangement.subsegments);
    Ok(arrangement)
}

/// Returns pieces that go through the inputs on them that they do not have, and these inputs;
/// `None` if there are none. Only inputs exactly on pieces count if pieces that bend through others
/// meet, are turned round, or bend through one beside a corner of theirs.
fn through_isolated(
    points: &[[f64; 3]],
    task: &TaskInSpace<'_>,
    pieces: &Pieces,
    poll: Poll<'_>,
) -> Result<Option<(Pieces, Isolated)>> {
    for is_exact in [false, true] {
        let isolated = Isolated::find(points, pieces, is_exact, poll)?;
        if isolated.is_empty() {
            return Ok(None);
        }
        let through = Pieces::new(points, task, &isolated, poll)?;
        let is_sound = is_exact
            || !isolated.is_beside_corner()? && turned::turn_as_given(points, task, &through)?;
        if is_sound && intersections::all(points, &through, poll)?.is_empty() {
            return Ok(Some((through, isolated)));
        }
    }
    Ok(None)
}

/// Returns all pairs of facets and segments that meet in more than vertices and edges of both, and
/// the facets that meet themselves or have no area. Facets come before segments, both in their
/// order; each pair comes once. Polygons that are not plane are seen as the triangles that they
/// consist of in a projection. O((n + k) log n), as for [`arrange_in_space`].
///
/// # Errors
/// `OutOfMemory`, and those of `poll`.
pub fn find_intersections(
    inputs: &Inputs,
    facets: &Facets,
    segments: &Segments,
    poll: Poll<'_>,
) -> Result<Vec<Intersection>> {
    let points = points_of(inputs)?;
    let pieces = pieces_as_given(&points, inputs, facets, segments, poll)?;
    intersections::all(&points, &pieces, poll)
}

/// Returns the pieces of facets and segments as they were given, of which nothing is merged, split
/// or led through other inputs.
fn pieces_as_given(
    points: &[[f64; 3]],
    inputs: &Inputs,
    facets: &Facets,
    segments: &Segments,
    poll: Poll<'_>,
) -> Result<Pieces> {
    Pieces::new(points, &as_given(inputs, facets, segments), &Isolated::default(), poll)
}

/// Returns the task of facets and segments as they were given.
fn as_given<'a>(inputs: &'a Inputs, facets: &'a Facets, segments: &'a Segments) -> TaskInSpace<'a> {
    let (regions, coplanar, extent) = (&[], 0.0, Extent::All);
    let crossings = Crossings::Refuse;
    TaskInSpace { inputs, facets, segments, regions, coplanar, extent, crossings }
}

fn points_of(inputs: &Inputs) -> AllocResult<Vec<[f64; 3]>> {
    let vertices = (0..inputs.distinct()).map(|vertex| inputs.distinct_point(vertex));
    collected(vertices.map(|point| *coordinates::<3>(point, 0)))
}
