//! The caller's facets and segments in space, which must meet only in what they have in common,
//! exactly.
//!
//! - [`polygon`] splits a polygon facet into triangles between its vertices, by a triangulation
//!   that has its edges ([`planar`]) in a [`projection`] of its [`plane`]; [`pieces`] has the
//!   triangles of all facets, and the segments.
//! - [`boxes`] finds pairs of these whose boxes meet, [`meet`] tells exactly whether and how two
//!   meet, and [`intersections`] collects all that must not; [`crossed`] does that for the edges of
//!   one polygon. [`faults`] has the words for what is refused.
//! - [`isolated`] finds inputs on facets and segments that these do not have.
//! - [`merge`] makes one facet of triangles that [`bends`] shows to be in one plane; [`lines`]
//!   has the edges at which facets end.
//! - [`closed`] tells whether facets are closed surfaces, and whether they enclose something;
//!   [`sides`] has what meets at an edge.
//! - [`frame`] has the sides of a box or, by [`hull`], of the convex hull of the inputs; [`fit`]
//!   leads them through the inputs, facets and segments on them.

mod bends;
mod boxes;
mod closed;
mod crossed;
mod duplicates;
mod faults;
#[cfg(test)]
mod file_tests;
mod fit;
mod frame;
mod hull;
mod intersections;
mod isolated;
mod lines;
mod meet;
#[cfg(test)]
mod meet_tests;
mod merge;
mod odd_edges;
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

pub use closed::{check_closed_in_space, encloses_in_space};
pub use duplicates::count_duplicates;
pub use odd_edges::find_odd_edges;

use super::poll::Poll;
use crate::error::Result;
use crate::memory::{AllocResult, Lists, TryGrow, collected, copied, filled, with_capacity};
use crate::mesh::{
    ArrangedFacet, Arrangement, FacetTriangle, Facets, Feature, Inputs, Intersection, NONE, Region,
    Segments,
};
use crate::numerics::coordinates;
use crate::options::{Crossings, Extent};
use faults::{no_hull_of_crossings, not_plane, refused};
use fit::Fitted;
use isolated::Isolated;
use pieces::{Piece, Pieces};

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
    if let Some(first) = found.first() {
        let split = match task.crossings {
            Crossings::Split if pieces.untiled.is_empty() => {
                split::split(&mut points, task, &pieces, poll)?
            }
            _ => None,
        };
        pieces = split.ok_or_else(|| refused(facets, first, found.len(), task.crossings))?;
        if task.extent == Extent::Hull {
            return Err(no_hull_of_crossings());
        }
    } else if let Some((through, isolated)) = through_isolated(&points, task, &pieces, poll)? {
        pieces = through;
        isolated.offsets().for_each(|offset| arrangement.note_offset(offset));
    }
    match facets.are_triangles {
        true => add_surface(&points, task, &pieces.all, &mut arrangement, poll)?,
        false => add_polygons(facets, &pieces.all, &mut arrangement)?,
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
    arrangement.subsegments = lines::lines(&arrangement.triangles, &parts, &pieces.lines)?;
    arrangement.covered_segments = lines::covered(segments.count(), &arrangement.subsegments);
    Ok(arrangement)
}

/// Returns pieces that go through the inputs on them that they do not have, and these inputs;
/// `None` if there are none. Only inputs exactly on pieces count if pieces that bend through others
/// meet.
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
        if intersections::all(points, &through, poll)?.is_empty() {
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
    let (regions, coplanar, extent) = (&[], 0.0, Extent::All);
    let crossings = Crossings::Refuse;
    let task = TaskInSpace { inputs, facets, segments, regions, coplanar, extent, crossings };
    let pieces = Pieces::new(&points, &task, &Isolated::default(), poll)?;
    intersections::all(&points, &pieces, poll)
}

fn points_of(inputs: &Inputs) -> AllocResult<Vec<[f64; 3]>> {
    let vertices = (0..inputs.distinct()).map(|vertex| inputs.distinct_point(vertex));
    collected(vertices.map(|point| *coordinates::<3>(point, 0)))
}

/// Fills an arrangement with the facets of a surface: its triangles, merged where they are plane.
fn add_surface(
    points: &[[f64; 3]],
    task: &TaskInSpace<'_>,
    pieces: &[Piece],
    arrangement: &mut Arrangement,
    poll: Poll<'_>,
) -> Result<()> {
    let triangles = collected(pieces.iter().filter_map(Piece::triangle))?;
    let own = pieces.iter().filter(|piece| piece.triangle().is_some());
    let of = collected(own.filter_map(Piece::facet))?;
    let balances = duplicates::balances(task)?;
    let balance = |facet: u32| balances[facet as usize].unwrap_or(1);
    let kind = |&facet: &u32| (task.facets.markers[facet as usize], balance(facet));
    let kinds = numbered(of.iter().map(kind))?;
    let firsts = merge::merged(points, &triangles, &kinds, &of, task.coplanar, poll)?;
    let mut numbers = filled(triangles.len(), NONE)?;
    for (triangle, &first) in firsts.iter().enumerate().filter(|&(at, &first)| at == first as usize)
    {
        numbers[triangle] = arrangement.facets.len() as u32;
        let parent = of[first as usize];
        arrangement.facets.try_push(ArrangedFacet { parent, balance: balance(parent) })?;
    }
    let numbered = || firsts.iter().map(|&first| numbers[first as usize]).zip(0u32..);
    let of_facets = Lists::of_pairs(arrangement.facets.len(), numbered)?;
    arrangement.triangles = with_capacity(triangles.len())?;
    for (facet, own) in (0u32..).zip(of_facets.iter()) {
        let made = own.iter().map(|&at| FacetTriangle { vertices: triangles[at as usize], facet });
        arrangement.triangles.extend(made);
    }
    Ok(())
}

/// Returns the place of each value among those that differ.
fn numbered<T: Copy + Ord>(values: impl Iterator<Item = T> + Clone) -> AllocResult<Vec<u32>> {
    let mut all = collected(values.clone())?;
    all.sort_unstable();
    all.dedup();
    collected(values.map(|value| all.partition_point(|other| *other < value) as u32))
}

/// Adds the sides of a box or hull, which are facets of none of the caller's.
fn add_frame(fitted: &Fitted, arrangement: &mut Arrangement) -> AllocResult<()> {
    fitted.offsets.iter().for_each(|&offset| arrangement.note_offset(offset));
    for own in fitted.triangles.chunk_by(|a, b| a.facet == b.facet) {
        let facet = arrangement.facets.len() as u32;
        arrangement.facets.try_push(ArrangedFacet { parent: NONE, balance: 1 })?;
        let made = own.iter().map(|triangle| FacetTriangle { facet, ..*triangle });
        arrangement.triangles.try_extend(&collected(made)?)?;
    }
    Ok(())
}

/// Fills an arrangement with polygon facets.
fn add_polygons(
    facets: &Facets,
    pieces: &[Piece],
    arrangement: &mut Arrangement,
) -> AllocResult<()> {
    arrangement.facets = with_capacity(facets.count())?;
    for piece in pieces {
        let (Some(parent), Some(vertices)) = (piece.facet(), piece.triangle()) else { continue };
        // Those without an area, if crossings are split, have no triangles.
        if arrangement.facets.last().is_none_or(|last| last.parent != parent) {
            arrangement.facets.try_push(ArrangedFacet { parent, balance: 1 })?;
        }
        let facet = arrangement.facets.len() as u32 - 1;
        arrangement.triangles.try_push(FacetTriangle { vertices, facet })?;
    }
    Ok(())
}
