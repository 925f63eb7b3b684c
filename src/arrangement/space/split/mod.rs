//! Crossings of facets and segments in space as vertices and edges of all that meet there.
//!
//! The set that two pieces share has corners, of which those that are no vertices become some, at
//! the nearest doubles but for roundings. Edges go through the vertices on them, facets have those
//! in them, and the line between two corners is an edge of both facets. Since that bends edges and
//! facets, by roundings, they may then meet others: so all is done again, until nothing meets but
//! in what it has in common, which a last round proves. This is iterated snap rounding (D. Halperin
//! and E. Packer, "Iterated snap rounding", 2002) in space: a corner that rounding explains to be
//! at a vertex or on an edge is there.
//!
//! Facets that share an area get each other's edges there, until their triangles are within each
//! other or apart; then the first facet has the area, with the balances of all.
//!
//! - [`corners`] finds the corners of a round, [`finest`] their coordinates, [`candidates`] the
//!   vertices that they become, and [`places`] where these are; [`areas`] has what facets share
//!   that [`coplanar`] finds in one plane.
//! - [`needles`] finds triangles that are no wider than roundings: their edges go through their
//!   corners.
//! - [`roundings`] has the units of what counts as near.
//! - [`sound`] tells whether roundings left facets and edges what they were.
//! - [`owners`] tells of which edges the edges of pieces are parts.

mod areas;
mod candidates;
mod coplanar;
mod corners;
mod finest;
mod needles;
mod owners;
mod places;
mod roundings;
mod sound;
#[cfg(test)]
mod tests;

use super::TaskInSpace;
use super::isolated::Isolated;
use super::pieces::Pieces;
use crate::arrangement::poll::Poll;
use crate::error::Result;
use crate::memory::TryGrow;
use crate::mesh::{Intersection, IntersectionKind};
use areas::{are_lent_whole, leave_to_first};
use coplanar::Coplanar;
use corners::Corners;
use needles::needles;
use owners::Owners;
use sound::is_sound;

/// Largest number of rounds. Three or four are enough for all but contrived inputs.
const MOST_ROUNDS: usize = 24;

/// Largest number of corners of a later round, over that of the first. Roundings make few.
const MOST_AGAIN: usize = 4;

/// Returns true if facets are to be split that meet nowhere, exactly: some are needles or share an
/// area, up to roundings. O((n + k) log n), as a round of [`split`].
pub(super) fn is_split_by_rounding(
    points: &[[f64; 3]],
    task: &TaskInSpace<'_>,
    pieces: &Pieces,
    poll: Poll<'_>,
) -> Result<bool> {
    Ok(!needles(points, task, &Isolated::default())?.is_empty()
        || !Coplanar::find(points, pieces, poll)?.is_empty())
}

/// Returns pieces of facets and segments that meet only in vertices and edges of both, and appends
/// the vertices at crossings to `points`; `None` if some still meet after [`MOST_ROUNDS`], or meet
/// where no vertex makes a difference. Triangles without an area are left out, also those that have
/// none but for roundings: others have their vertices. Expected O((n + k) log n) for each round,
/// for n pieces and k pairs whose bounding boxes meet.
pub(super) fn split(
    points: &mut Vec<[f64; 3]>,
    task: &TaskInSpace<'_>,
    pieces: &Pieces,
    meets_exactly: bool,
    poll: Poll<'_>,
) -> Result<Option<Pieces>> {
    let coplanar = Coplanar::find(points, pieces, poll)?;
    let mut on = Isolated::find(points, pieces, false, poll)?;
    let mut most = usize::MAX;
    for _ in 0..MOST_ROUNDS {
        let mut pieces = Pieces::new(points, task, &on, poll)?;
        let owners = Owners::new(points, task, &on)?;
        let mut corners = Corners::find(points, &pieces, &owners, &coplanar, poll)?;
        let needles = needles(points, task, &on)?;
        let is_whole = pieces.faults.iter().all(has_no_area) && needles.is_empty();
        if corners.all.is_empty() && corners.areas.are_tiled() && is_whole {
            let is_sound = is_sound(points, task, &pieces, &owners, &on, meets_exactly, poll)?
                && are_lent_whole(&pieces, &corners.areas.pairs)?;
            if !is_sound {
                return Ok(None);
            }
            leave_to_first(points, &mut pieces, &corners.areas.pairs)?;
            return Ok(Some(pieces));
        }
        if corners.all.len() > most {
            return Ok(None);
        }
        if !corners.all.is_empty() {
            most = most.min(MOST_AGAIN * corners.all.len());
        }
        let mut added = corners.placed(points, task.inputs.distinct(), &pieces, &owners)?;
        added.on_edges.try_extend(&needles)?;
        let reach = |edge| owners.roundings.reach(points, edge);
        if !on.extend(points, &added, reach)? {
            return Ok(None);
        }
    }
    Ok(None)
}

/// Returns true if a fault is that a facet has no area.
fn has_no_area(fault: &Intersection) -> bool {
    fault.kind == IntersectionKind::ZeroArea
}
