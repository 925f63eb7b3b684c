//! The caller's segments as pieces that meet only at their ends, exactly.
//!
//! - [`closed`] tells whether segments are closed curves, and whether they enclose something.
//! - [`extent`] makes segments of the boundary of a hull or box; [`inner`] finds inputs that are
//!   surely far from it, [`frame`] the vertices near its corners that it is not bent through.
//! - [`reach`] defines which vertices are near a segment, [`near`] finds them, and [`bend`] leads
//!   segments through them.
//! - [`sweep`] splits pieces at the vertices on them, joins those that overlap and finds their
//!   crossings; [`ranked`] has the vertices in the order of the sweep, [`status`] the lines that it
//!   meets.
//! - [`crossings`] chooses the crossings that become vertices, [`split`] splits pieces there.
//! - [`straighten`] removes vertices that are no crossings any more.
//!
//! A crossing becomes a vertex of both segments at the nearest doubles, which bends them: their
//! pieces may then come near other vertices than before, and cross other pieces. So all pieces are
//! bent and swept again, until a sweep finds no crossing, which proves that there is none.

mod bend;
mod closed;
mod crossings;
mod extent;
mod frame;
mod inner;
mod near;
#[cfg(test)]
mod near_tests;
mod poll;
mod ranked;
mod reach;
mod shared;
pub mod space;
mod split;
mod status;
mod straighten;
mod sweep;
#[cfg(test)]
mod tests;

pub use closed::{check_closed, encloses};
pub use extent::with_extent;
pub use poll::Poll;
pub use shared::SharedVertices;

use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::{AllocResult, Lists, TryGrow, collected, copied, filled, with_capacity};
use crate::mesh::{Arrangement, Inputs, NONE, Segments, Subsegment};
use crate::numerics::coordinates;
use crate::options::Crossings;
use bend::Bender;
use crossings::{Straight, accept};
use frame::Frame;
use ranked::RankedVertices;
use reach::{Position, Reach};
use split::split;
use straighten::straighten;
use sweep::{Handling, Swept, sweep};

/// Largest number of sweeps. Two or three are enough for all but contrived inputs.
const MOST_SWEEPS: usize = 100;

/// Segments to arrange, and the rules for their crossings.
#[derive(Clone, Copy)]
pub struct Task<'a> {
    pub inputs: &'a Inputs,
    pub segments: &'a Segments,
    /// Number of the caller's segments; those that follow are the boundary of an extent,
    /// counterclockwise.
    pub own: usize,
    /// Vertices that pieces passing within a unit in the last place must go through. Those that are
    /// no inputs are further vertices, which are treated as crossings of segments.
    pub shared: &'a SharedVertices,
    pub crossings: Crossings,
}

/// Returns the arrangement of segments between inputs in the plane. Pieces that overlap become one,
/// which belongs to the first of their segments and has the sum of their balances.
///
/// Expected O((n + k) log n) for n inputs and segments and k crossings, where segments do not pass
/// between many inputs. `poll` is told of the work of each step, and may end the operation.
///
/// # Errors
/// `InvalidArgument` (the caller's segments cross, where `crossings` refuses that), `Limit`,
/// `Capacity` (more vertices than 32-bit ids), `OutOfMemory`, and those of `poll`.
pub fn arrange(task: &Task<'_>, poll: Poll<'_>) -> Result<Arrangement> {
    let vertices = (0..task.inputs.distinct()).map(|vertex| task.inputs.distinct_point(vertex));
    let mut points = collected(vertices.map(|point| *coordinates::<2>(point, 0)))?;
    let mut are_inputs = filled(task.shared.points().len(), false)?;
    if !are_inputs.is_empty() {
        points.iter().filter_map(|x| task.shared.find(x)).for_each(|at| are_inputs[at] = true);
    }
    for (x, _) in task.shared.points().zip(are_inputs).filter(|(_, is_input)| !is_input) {
        points.try_push(*x)?;
    }
    let ends = |ends: &[u32; 2]| ends.map(|input| task.inputs.vertices()[input as usize]);
    let segments = task.segments.inputs.iter().zip(0u32..);
    let segments = segments.map(|(inputs, segment)| Subsegment {
        ends: ends(inputs),
        segment,
        balance: i64::from(task.segments.encloses(segment as usize)),
    });
    let segments = collected(segments)?;
    let straight = |segment: &Subsegment| segment.ends.map(|end| &points[end as usize]);
    let reaches = collected(segments.iter().map(|segment| Reach::of(straight(segment))))?;
    let bent = arrange_within(task, copied(&points)?, &segments, &reaches, poll)?;
    if let Some(arrangement) = bent {
        return Ok(arrangement);
    }
    // Bent, no segments crossed that must not. Crossings that straight ones have besides are at
    // vertices that count as on both, and none that the caller could mean.
    let task = &Task { crossings: Crossings::Split, ..*task };
    let exact = collected(reaches.into_iter().map(Reach::exact))?;
    arrange_within(task, points, &segments, &exact, poll)?.ok_or_else(|| {
        let message =
            message!("segments still cross after {MOST_SWEEPS} roundings of their crossings");
        Error::new(ErrorKind::Limit, message)
    })
}

/// Returns the arrangement of segments with these reaches. `None` if segments still cross after
/// [`MOST_SWEEPS`] sweeps, or if the pieces of one would not be in their order along it.
fn arrange_within(
    task: &Task<'_>,
    mut points: Vec<[f64; 2]>,
    segments: &[Subsegment],
    reaches: &[Reach<2>],
    poll: Poll<'_>,
) -> Result<Option<Arrangement>> {
    let inputs = task.inputs.distinct();
    let refuses = |[first, second]: [u32; 2]| {
        let is_refused =
            task.crossings == Crossings::Refuse && (first.max(second) as usize) < task.own;
        is_refused.then(|| reaches[first as usize].crossing(&reaches[second as usize])).flatten()
    };
    let frame = Frame::new(segments, task.own, reaches, points.len())?;
    let mut pieces = copied(segments)?;
    let mut arrangement = Arrangement::default();
    let mut has_split = false;
    for _ in 0..MOST_SWEEPS {
        let avoids = |part: &Subsegment, vertex: u32| {
            let is_own = (part.segment as usize) < task.own;
            let segment = if is_own { part.segment } else { NONE };
            task.shared.avoids(segment, &points[vertex as usize])
        };
        let passes = |part: &Subsegment, vertex: u32| {
            avoids(part, vertex) || frame.passes(&points, part, vertex)
        };
        let bent = |vertex: u32, segment: u32| {
            if (vertex as usize) < inputs {
                let point = &points[vertex as usize];
                arrangement.note_offset(reaches[segment as usize].offset_from_segment(point));
            }
        };
        let is_shared = |x: &[f64; 2]| task.shared.find(x).is_some();
        let mut bender = Bender::new(&points, reaches, &pieces)?;
        pieces = bender.bend(&pieces, poll, is_shared, passes, bent)?;
        let ranked = RankedVertices::new(&points)?;
        let snaps = |segments: [u32; 2]| {
            has_split && segments.iter().all(|&segment| !reaches[segment as usize].is_long())
        };
        let handling = Handling { refuses: &refuses, snaps: &snaps };
        let swept = sweep(&ranked, &pieces, handling, poll)?;
        if swept.found.is_empty() && swept.snapped.is_empty() {
            let Some(mut ordered) = in_order(&ranked, reaches, &swept)? else { return Ok(None) };
            if straighten(inputs, &mut points, &mut ordered)? {
                pieces = ordered;
                continue;
            }
            arrangement.covered_segments = covered(segments, &ordered)?;
            arrangement.subsegments = ordered;
            arrangement.crossings = copied(&points[inputs..])?;
            return Ok(Some(arrangement));
        }
        let line = |line: u32| {
            let Subsegment { ends, segment, .. } = pieces[line as usize];
            let ends = ends.map(|end| &points[end as usize]);
            Straight { ends, reach: &reaches[segment as usize] }
        };
        let is_accepted = accept(&swept.found, pieces.len(), line)?;
        let parts = swept.parts.len();
        pieces = split(&ranked, swept, &is_accepted, &mut points)?;
        // A vertex that is rounded to an end splits nothing.
        has_split = pieces.len() > parts;
    }
    Ok(None)
}

/// Returns the pieces sorted by segment and by their order along it, each in the segment's
/// direction; `None` if a piece begins before its predecessor ends.
fn in_order(
    ranked: &RankedVertices,
    reaches: &[Reach<2>],
    swept: &Swept,
) -> AllocResult<Option<Vec<Subsegment>>> {
    let along = |segment: u32, vertex: u32| -> Position<2> {
        reaches[segment as usize].position(ranked.point(ranked.ranks[vertex as usize]))
    };
    let parts = || swept.parts.iter().zip(0u32..).map(|(part, number)| (part.segment, number));
    let of_segments = Lists::of_pairs(reaches.len(), parts)?;
    let mut pieces = with_capacity(swept.parts.len())?;
    for segment in 0..reaches.len() as u32 {
        let first = pieces.len();
        pieces.extend(of_segments.of(segment as usize).iter().map(|&number| {
            let part = &swept.parts[number as usize];
            let [left, right] = part.ends.map(|rank| ranked.vertices[rank as usize]);
            match along(segment, left) < along(segment, right) {
                true => Subsegment { ends: [left, right], segment, balance: part.balance },
                false => Subsegment { ends: [right, left], segment, balance: -part.balance },
            }
        }));
        pieces[first..].sort_unstable_by_key(|piece| along(segment, piece.ends[0]));
    }
    let goes_back = |pair: &[Subsegment]| {
        let [last, next] = pair else { unreachable!("windows of two") };
        last.segment == next.segment
            && along(last.segment, last.ends[1]) > along(last.segment, next.ends[0])
    };
    Ok((!pieces.windows(2).any(goes_back)).then_some(pieces))
}

/// Returns the number of segments without a piece.
fn covered(segments: &[Subsegment], pieces: &[Subsegment]) -> AllocResult<u64> {
    let mut has_piece = filled(segments.len(), false)?;
    pieces.iter().for_each(|piece| has_piece[piece.segment as usize] = true);
    Ok(has_piece.iter().filter(|&&has_piece| !has_piece).count() as u64)
}
