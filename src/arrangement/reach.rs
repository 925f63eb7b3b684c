//! Near incidence: which vertices count as on a segment, and their order along it.
//!
//! Points that programs compute on a slanted segment are off it by some units in the last place. A
//! mesh of the gap would need edges as short as that, for which doubles have no room. So a vertex
//! that is nearer to a segment than rounding explains counts as on it, and the segment bends
//! through it. This is the idea of iterated snap rounding (D. Halperin and E. Packer, "Iterated
//! snap rounding", 2002), with rectangles about vertices whose size is in units of the segment's
//! own coordinates.

use super::ranked::ordered_bits;
use crate::numerics::{crossing, offset_from_line, orientation, scale_of_differences};

/// Half the width of the rectangle about a vertex along each axis, in units in the last place of
/// the segment's larger coordinates. A vertex is on a segment if its rectangle meets the segment.
pub(super) const NEAR: f64 = 3.0;

/// Largest distance from the straight segment, in units in the last place, of a vertex that the
/// bent one goes through.
const FARTHEST: f64 = 12.0;

/// Largest distance from the straight segment, in units in the last place, of a vertex that the
/// bent one passes within a unit: where it returns from a vertex farther off to its end.
const OUTERMOST: f64 = 16.0;

/// Length, in units in the last place, from which on two lines that run beside each other, no
/// farther apart than a segment may be bent, share their vertices.
const PARALLEL: f64 = 65536.0;

/// Length, in units in the last place, below which a segment is taken as it is: rounding explains
/// no gap beside it.
const SHORTEST: f64 = 4096.0;

/// Segment with the distance up to which rounding explains a gap beside it, and with the order of
/// points along it.
#[derive(Clone, Copy)]
pub(super) struct Reach<const D: usize> {
    /// Ends of the straight segment.
    pub ends: [[f64; D]; 2],
    /// Unit in the last place of the larger coordinate of the ends, for each axis.
    units: [f64; D],
    /// Axis on which the ends are most units apart.
    axis: usize,
    falls: [bool; D],
    is_long: bool,
}

/// Position of a point along a segment, as a key: larger for points nearer to its second end.
pub(super) type Position<const D: usize> = [u64; D];

impl<const D: usize> Reach<D> {
    pub fn of([from, to]: [&[f64; D]; 2]) -> Self {
        let units = std::array::from_fn(|k| unit_in_last_place(from[k].abs().max(to[k].abs())));
        let falls = std::array::from_fn(|k| to[k] < from[k]);
        Self { ends: [*from, *to], units, axis: 0, falls, is_long: false }.measured()
    }

    /// Returns the reach of a segment whose points were computed with larger coordinates, of which
    /// these are the units in the last place.
    pub fn widened(mut self, units: &[f64; D]) -> Self {
        for (own, unit) in self.units.iter_mut().zip(units) {
            *own = own.max(*unit);
        }
        self.measured()
    }

    /// Finds the axis on which the ends are most units apart.
    fn measured(self) -> Self {
        let [from, to] = &self.ends;
        // Of infinite ways, which doubles do not have, all are as long.
        let steps = |k: usize| (to[k] - from[k]).abs().min(f64::MAX) / self.units[k];
        let axis = (1..D).fold(0, |axis, k| if steps(k) > steps(axis) { k } else { axis });
        Self { axis, is_long: steps(axis) >= SHORTEST, ..self }
    }

    /// Returns the position of a point along the segment: by the axis on which the segment is
    /// longest, and by the other axes where that is equal.
    pub fn position(&self, x: &[f64; D]) -> Position<D> {
        let bits = |k: usize| match self.falls[k] {
            true => !ordered_bits(x[k]),
            false => ordered_bits(x[k]),
        };
        std::array::from_fn(|at| match at {
            0 => bits(self.axis),
            _ if at <= self.axis => bits(at - 1),
            _ => bits(at),
        })
    }

    /// Returns a reach for which only vertices exactly on the segment bend it.
    pub fn exact(self) -> Self {
        Self { is_long: false, ..self }
    }

    /// Returns true if the segment is long enough for rounding to explain a gap beside it.
    pub fn is_long(&self) -> bool {
        self.is_long
    }

    /// Returns true if a vertex is near the piece between two points of the bent segment. The
    /// caller compares its position along the segment with those of the piece's ends.
    pub fn is_near(&self, piece: [&[f64; D]; 2], x: &[f64; D]) -> bool {
        self.is_long && self.offset(piece, x) <= NEAR && self.offset_from_segment(x) <= FARTHEST
    }

    /// Returns true if a vertex is no farther from the piece between two points of the bent segment
    /// than the segment may be bent.
    pub fn is_beside(&self, piece: [&[f64; D]; 2], x: &[f64; D]) -> bool {
        self.is_long && self.offset(piece, x).max(self.offset_from_segment(x)) <= FARTHEST
    }

    /// Returns true if the piece between two points of the bent segment passes a vertex as near as
    /// roundings of its own points are.
    pub fn passes(&self, piece: [&[f64; D]; 2], x: &[f64; D]) -> bool {
        self.offset(piece, x) <= 1.0 && self.offset_from_segment(x) <= OUTERMOST
    }

    /// Returns true if both ends of a line are beside the piece between two points of the bent
    /// segment, and the line is much longer than the gap between them.
    pub fn is_parallel(&self, piece: [&[f64; D]; 2], line: [&[f64; D]; 2]) -> bool {
        let [x, y] = line;
        let is_long = (0..D).any(|k| (x[k] - y[k]).abs() >= PARALLEL * self.units[k]);
        is_long && line.iter().all(|end| self.is_beside(piece, end))
    }

    /// Returns true if two points are so close that the segment, if it goes through one, goes
    /// through the other too.
    pub fn are_close(&self, x: &[f64; D], y: &[f64; D]) -> bool {
        self.is_long && (0..D).all(|k| (x[k] - y[k]).abs() <= NEAR * self.units[k])
    }

    /// Returns true if a point is near the straight segment and between its ends.
    pub fn holds(&self, x: &[f64; D]) -> bool {
        self.is_between(x) && self.is_near(self.ends.each_ref(), x)
    }

    /// Returns true if a point is no farther from the straight segment than a vertex that this is
    /// bent through.
    pub fn may_go_through(&self, x: &[f64; D]) -> bool {
        self.offset_from_segment(x) <= FARTHEST
    }

    /// Returns true if the position of a point is between those of the ends.
    pub fn is_between(&self, x: &[f64; D]) -> bool {
        let [from, position, to] = [&self.ends[0], x, &self.ends[1]].map(|x| self.position(x));
        from < position && position < to
    }

    /// Returns the distance of a point from the straight segment, in units in the last place.
    pub fn offset_from_segment(&self, x: &[f64; D]) -> f64 {
        self.offset(self.ends.each_ref(), x)
    }

    /// Returns the largest distance from the line through two points, in units in the last place,
    /// over the projections along the other axes.
    fn offset(&self, [a, b]: [&[f64; D]; 2], x: &[f64; D]) -> f64 {
        let mut offset = 0.0f64;
        for second in 1..D {
            for first in 0..second {
                let flat = |x: &[f64; D]| [x[first], x[second]];
                let (a, b, x) = (flat(a), flat(b), flat(x));
                if a != b {
                    let units = [self.units[first], self.units[second]];
                    offset = offset.max(offset_from_line(&a, &b, &x, units));
                }
            }
        }
        offset
    }

    /// Returns half the widths of a rectangle about a vertex. If another vertex is in it, doubles
    /// are finer there than the segment's roundings, which then explain nothing.
    pub fn grain(&self) -> [f64; D] {
        self.units.map(|unit| unit * f64::from_bits((1023 - 20) << 52))
    }

    /// Returns half the widths of a rectangle that contains all points near a point of the segment,
    /// with a margin for the roundings of a filter.
    pub fn margin(&self) -> [f64; D] {
        self.units.map(|unit| 32.0 * unit)
    }
}

impl Reach<2> {
    /// Returns the sine of the angle between two lines, measured in this segment's units.
    pub fn sine(&self, first: [&[f64; 2]; 2], second: [&[f64; 2]; 2]) -> f64 {
        let [u, v] = [first, second].map(|[a, b]| {
            let scale = scale_of_differences([a, b]);
            let mut way = [0, 1].map(|k| (scale * b[k] - scale * a[k]) / self.units[k]);
            // This segment is on an axis, where units are as small as doubles get.
            if way.iter().any(|step| step.is_infinite()) {
                way = way.map(|step| if step.is_infinite() { step.signum() } else { 0.0 });
            }
            let length = way[0].hypot(way[1]);
            way.map(|step| step / length)
        });
        (u[0] * v[1] - u[1] * v[0]).abs()
    }

    /// Returns the point where two straight segments cross, with each coordinate the nearest
    /// double; `None` unless the point is in the interior of both.
    pub fn crossing(&self, other: &Self) -> Option<[f64; 2]> {
        let parts = |one: &Self, other: &Self| {
            let [a, b] = &one.ends;
            let sides = other.ends.each_ref().map(|end| orientation(&[a, b, end]));
            (sides[0] * sides[1]).is_negative()
        };
        let cross = parts(self, other) && parts(other, self);
        cross.then(|| crossing([self.ends.each_ref(), other.ends.each_ref()])).flatten()
    }
}

/// Returns the gap between doubles at `x`, which must not be negative.
pub(super) fn unit_in_last_place(x: f64) -> f64 {
    match x.next_up() {
        above if above.is_finite() => above - x,
        _ => x - x.next_down(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_that_cross_an_axis_have_an_angle_with_it() {
        let (from, to) = ([0.0, 0.0], [10.0, 0.0]);
        let reach = Reach::of([&from, &to]);
        let across = [&[5.0, -5.0], &[5.0, 5.0]];
        assert_eq!(reach.sine([&from, &to], across), 1.0);
        assert_eq!(reach.sine(across, [&[0.0, -1e-3], &[10.0, 1e-3]]), 0.0);
        assert_eq!(reach.sine([&from, &to], [&to, &from]), 0.0);
    }
}
