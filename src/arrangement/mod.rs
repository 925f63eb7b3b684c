//! The caller's segments as pieces that meet only at their ends, exactly.
//!
//! - [`closed`] tells whether segments are closed curves.
//! - [`sweep`] cuts pieces at the vertices on them, joins those that overlap and finds where they
//!   cross; [`places`] are the points in its order, [`status`] the lines that it meets.
//! - [`split`] makes vertices of crossings.
//! - [`extent`] has the boundary of a hull or box, which [`frame`] leads through the inputs next to it;
//!   [`inner`] tells that most inputs are far from it.
//!
//! Where segments cross, the double nearest to the exact crossing becomes a vertex of both, and
//! bends them: the pieces may pass other vertices than before, and cross others. So all is swept
//! again, until a sweep finds no crossing; it proves by that that there is none. A piece that
//! crosses another only since it is bent goes through an end of that one if it passes within a
//! rounding: to make further vertices would make further crossings, of lines that nearly coincide
//! more each time.
//!
//! This ends: a crossing is rounded to a point in the bounding rectangles of both pieces, which can be
//! an end of one of them only. So a piece is split, and the two parts' rectangles have as many
//! doubles on their sides together as that of the piece.

mod closed;
mod extent;
mod frame;
mod inner;
mod places;
mod split;
mod status;
mod sweep;
#[cfg(test)]
mod tests;

pub use closed::check_closed;
pub use extent::with_extent;

use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::{AllocResult, Lists, collected, copied, filled, with_capacity};
use crate::mesh::{Arrangement, Inputs, Segments, Subsegment};
use crate::numerics::coordinates;
use crate::options::Crossings;
use places::{Places, key_along};
use split::split;
use sweep::{Handling, Swept, sweep};

/// What is told of work, in units of some 100 ns.
pub type Poll<'a> = &'a mut dyn FnMut(u32) -> Result<()>;

/// The most sweeps. All but inputs that are made for it need two or three.
const MOST_SWEEPS: usize = 200;

/// The arrangement of segments between inputs in the plane. Of pieces that overlap there is one,
/// the first segment's, with the balance of all.
///
/// Expected O((n + k) log n) for n inputs and segments and k crossings. `poll` is told of each piece
/// of work how long it was, and may end all of it.
///
/// # Errors
/// `InvalidArgument` (segments that cross, where `crossings` refuses them), `Limit`, `Capacity`
/// (more vertices than 32-bit ids), `OutOfMemory`, and those of `poll`.
pub fn arrange(
    inputs: &Inputs,
    segments: &Segments,
    crossings: Crossings,
    poll: Poll<'_>,
) -> Result<Arrangement> {
    let mut points = collected(
        (0..inputs.distinct()).map(|vertex| *coordinates::<2>(inputs.distinct_point(vertex), 0)),
    )?;
    let ends = |ends: &[u32; 2]| ends.map(|input| inputs.vertices()[input as usize]);
    let pieces = segments.inputs.iter().zip(0u32..);
    let pieces = pieces.map(|(inputs, segment)| Subsegment {
        ends: ends(inputs),
        segment,
        balance: i64::from(segments.encloses(segment as usize)),
    });
    let segments = collected(pieces)?;
    let mut pieces = copied(&segments)?;
    let mut arrangement = Arrangement::default();
    let mut handling = match crossings {
        Crossings::Refuse => Handling::Refuse,
        Crossings::Split => Handling::Round,
    };
    for count in 0..MOST_SWEEPS {
        let places = Places::new(&points)?;
        let swept = sweep(&places, &pieces, handling, poll)?;
        if count == 0 {
            arrangement.inputs_on_segments = swept.cuts;
        }
        if swept.found.is_empty() {
            arrangement.subsegments = in_order(&places, &segments, &swept)?;
            arrangement.covered_segments = covered(&segments, &arrangement.subsegments)?;
            arrangement.crossings = copied(&points[inputs.distinct()..])?;
            return Ok(arrangement);
        }
        let parts = swept.parts.len();
        pieces = split(&places, swept, &mut points)?;
        let has_split = pieces.len() > parts;
        handling = if has_split { Handling::Snap } else { Handling::Round };
    }
    let message = message!("segments still cross after {MOST_SWEEPS} roundings of their crossings");
    Err(Error::new(ErrorKind::Limit, message))
}

/// The parts by segments, along each in its direction.
fn in_order(
    places: &Places,
    segments: &[Subsegment],
    swept: &Swept,
) -> AllocResult<Vec<Subsegment>> {
    let point = |vertex: u32| places.point(places.ranks[vertex as usize]);
    let along = |segment: u32, vertex: u32| {
        let [from, to] = segments[segment as usize].ends.map(point);
        key_along(point(vertex), [0, 1].map(|axis| to[axis] < from[axis]))
    };
    let parts = || swept.parts.iter().zip(0u32..).map(|(part, number)| (part.segment, number));
    let of_segments = Lists::of_pairs(segments.len(), parts)?;
    let mut pieces = with_capacity(swept.parts.len())?;
    for segment in 0..segments.len() as u32 {
        let first = pieces.len();
        pieces.extend(of_segments.of(segment as usize).iter().map(|&number| {
            let part = &swept.parts[number as usize];
            let [left, right] = part.ends.map(|rank| places.vertices[rank as usize]);
            match along(segment, left) < along(segment, right) {
                true => Subsegment { ends: [left, right], segment, balance: part.balance },
                false => Subsegment { ends: [right, left], segment, balance: -part.balance },
            }
        }));
        pieces[first..].sort_unstable_by_key(|piece| along(segment, piece.ends[0]));
    }
    Ok(pieces)
}

/// The number of segments without a piece.
fn covered(segments: &[Subsegment], pieces: &[Subsegment]) -> AllocResult<u64> {
    let mut has_piece = filled(segments.len(), false)?;
    pieces.iter().for_each(|piece| has_piece[piece.segment as usize] = true);
    Ok(has_piece.iter().filter(|&&has_piece| !has_piece).count() as u64)
}
