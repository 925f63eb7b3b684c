//! Boxes of space, in each of which one thread inserts.

use crate::memory::{AllocResult, TryGrow, with_capacity};

/// A box that is open above, or all of space.
#[derive(Clone, Copy, Debug)]
pub(super) struct Region {
    low: [f64; 3],
    high: [f64; 3],
    is_all: bool,
}

impl Region {
    pub const ALL: Self =
        Self { low: [f64::NEG_INFINITY; 3], high: [f64::INFINITY; 3], is_all: true };

    #[inline]
    pub fn is_all(&self) -> bool {
        self.is_all
    }

    #[inline]
    pub fn holds(&self, x: &[f64; 3]) -> bool {
        (0..3).all(|axis| self.low[axis] <= x[axis] && x[axis] < self.high[axis])
    }

    /// Splits at a plane across an axis.
    fn split(self, axis: usize, at: f64) -> [Self; 2] {
        let mut halves = [Self { is_all: false, ..self }; 2];
        halves[0].high[axis] = at;
        halves[1].low[axis] = at;
        halves
    }
}

/// A region and the points that are to go in there, in the order of locality.
pub(super) struct Part {
    pub region: Region,
    pub pending: Vec<u32>,
}

/// Splits `pending` into parts of some as many points each, `1 << levels` of them, first across
/// `axis`.
pub(super) fn parts(
    points: &[[f64; 3]],
    pending: Vec<u32>,
    axis: usize,
    levels: usize,
) -> AllocResult<Vec<Part>> {
    let mut parts = with_capacity(1)?;
    parts.push(Part { region: Region::ALL, pending });
    for level in 0..levels {
        let mut halves = with_capacity(2 * parts.len())?;
        for part in parts {
            halves.extend(halved(points, part, (axis + level) % 3)?);
        }
        parts = halves;
    }
    Ok(parts)
}

/// Halves a part across an axis.
fn halved(points: &[[f64; 3]], part: Part, axis: usize) -> AllocResult<[Part; 2]> {
    let at = median(points, &part.pending, axis)?;
    let [low, high] = part.region.split(axis, at);
    let (mut below, mut above) = (Vec::new(), Vec::new());
    for vertex in part.pending {
        let is_below = points[vertex as usize][axis] < at;
        (if is_below { &mut below } else { &mut above }).try_push(vertex)?;
    }
    Ok([Part { region: low, pending: below }, Part { region: high, pending: above }])
}

/// Returns the coordinate that a sample has in its middle.
fn median(points: &[[f64; 3]], pending: &[u32], axis: usize) -> AllocResult<f64> {
    const SAMPLE: usize = 1 << 14;
    let step = (pending.len() / SAMPLE).max(1);
    let mut sample = with_capacity(pending.len().div_ceil(step))?;
    sample.extend(pending.iter().step_by(step).map(|&vertex| points[vertex as usize][axis]));
    if sample.is_empty() {
        return Ok(0.0);
    }
    let middle = sample.len() / 2;
    Ok(*sample.select_nth_unstable_by(middle, f64::total_cmp).1)
}
