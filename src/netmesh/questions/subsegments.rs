//! Subsegments: the edges that they are, and the points that split them. That is the middle, but at
//! the ends of lines that make a sharp angle with others a point of concentric shells about that
//! end, whose radii are powers of two. So the subsegments of all these lines are as long as each
//! other there, and none encroaches another. In space a subsegment that another line runs beside is
//! split opposite a vertex of that.

use crate::complex::{VertexId, position};
use crate::memory::AllocResult;
use crate::netmesh::state::State;
use crate::netmesh::state::segments::chain::{Fraction, Line, Subsegment};
use crate::numerics::{distance, offset_from_line, point_at_level, point_between};

/// Angles below this, in degrees, are sharp: two lines at 60 degrees or more may be split in their
/// middles without an end (Ruppert); what rounding adds is far below the rest.
pub(in crate::netmesh) const SHARP: f64 = 61.0;

/// Squares of lengths between these, and products of two, neither overflow nor vanish.
const SAFE: std::ops::Range<f64> = 1e-100..1e100;

/// A subsegment that is not so many units in the last place long stays whole where it is an edge.
const SHORTEST: f64 = 64.0;

/// An edge stays whole, too, where the vertices that encroach it are no farther from its line than
/// so many units.
const NO_ROOM: f64 = 8.0;

/// Returns the gap between a double that is not negative and the next one below.
fn unit_below(x: f64) -> f64 {
    x - x.next_down()
}

/// Returns the place on its line at which a subsegment is to be split, if that is no place opposite
/// a vertex: on its shell, or in the middle.
fn splitting_place(subsegment: &Subsegment, shell: Option<(u8, f64)>) -> Fraction {
    let [first, second] = subsegment.fractions;
    match shell {
        Some((end, ratio)) => {
            let far = if end == 0 { second } else { first };
            Fraction::at(end, far.seen_from(end) * ratio)
        }
        None => first.middle(second),
    }
}

impl<const D: usize> State<D> {
    /// Returns the place on its line at which a subsegment is to be split, and the vertex there;
    /// one of its ends where doubles have none between.
    pub(in crate::netmesh) fn splitting_point(
        &mut self,
        subsegment: &Subsegment,
    ) -> AllocResult<(Fraction, [f64; D])> {
        let shell = self.shell_of(subsegment);
        let opposite = match self.in_space() {
            Some(state) => state.place_opposite(subsegment, shell.map(|(end, _)| end))?,
            None => None,
        };
        let place = splitting_place(subsegment, shell);
        let [a, b] = subsegment.ends.map(|end| self.delaunay.point(end));
        for place in opposite.into_iter().chain([place]) {
            let x = self.point_at(subsegment.line, place);
            let is_between =
                |k: usize| (a[k] < x[k] && x[k] < b[k]) || (b[k] < x[k] && x[k] < a[k]);
            if (0..D).any(is_between) {
                return Ok((place, x));
            }
        }
        // Parts of a line are too coarse where a coordinate comes to zero on the way: doubles are
        // finer there than at the line's ends.
        let units = |k: usize| (a[k] - b[k]).abs() / unit_below(a[k].abs().max(b[k].abs()));
        let axis = (1..D).fold(0, |axis, k| if units(k) > units(axis) { k } else { axis });
        let line = self.segments.chains.lines[subsegment.line as usize];
        let line = line.ends.map(|end| self.delaunay.point(end));
        Ok((place, point_at_level(line, axis, 0.5 * a[axis] + 0.5 * b[axis])))
    }

    /// Returns the end of the line, if just that end of the subsegment is a sharp one, and how far
    /// from it the shell is that comes nearest to the middle, relative to the length.
    fn shell_of(&self, subsegment: &Subsegment) -> Option<(u8, f64)> {
        let line = self.segments.chains.lines[subsegment.line as usize];
        let is_at = |end: usize| subsegment.ends[end] == line.ends[end] && line.is_sharp[end];
        let end = match [is_at(0), is_at(1)] {
            [true, false] => 0,
            [false, true] => 1,
            _ => return None,
        };
        let [a, b] = subsegment.ends.map(|end| self.delaunay.point(end));
        Some((end, ratio_of_shell(distance(a, b))))
    }

    /// Returns the vertex at `place` of a line.
    pub(in crate::netmesh) fn point_at(&self, line: u32, place: Fraction) -> [f64; D] {
        let Line { ends, .. } = self.segments.chains.lines[line as usize];
        let [from, to] = match place.end {
            0 => ends,
            _ => [ends[1], ends[0]],
        };
        let point = |vertex: VertexId| self.delaunay.point(vertex);
        point_between(point(from), point(to), place.of_line)
    }

    /// Returns true if the ways from `center` to two others make a sharp angle; `None` where
    /// squares of lengths overflow or vanish.
    pub(in crate::netmesh) fn is_sharp_between(
        &self,
        center: VertexId,
        others: [VertexId; 2],
    ) -> Option<bool> {
        let from = self.delaunay.point(center);
        let [u, v] = others.map(|other| {
            let to = self.delaunay.point(other);
            [to[0] - from[0], to[1] - from[1]]
        });
        let squares = [u, v].map(|way| way[0] * way[0] + way[1] * way[1]);
        let dot = u[0] * v[0] + u[1] * v[1];
        let cosine = SHARP.to_radians().cos();
        squares
            .iter()
            .all(|square| SAFE.contains(square))
            .then_some(dot > 0.0 && dot * dot > cosine * cosine * (squares[0] * squares[1]))
    }

    /// Returns true if the ways from `center` to two others make a sharp angle.
    pub(super) fn meet_sharply(&self, center: VertexId, others: [VertexId; 2]) -> bool {
        self.is_sharp_between(center, others).unwrap_or_else(|| {
            let [first, second] = others.map(|other| self.direction(center, other));
            let turn = (second - first).rem_euclid(360.0);
            turn.min(360.0 - turn) < SHARP
        })
    }

    /// Returns the direction of the way between two vertices, in degrees.
    pub(in crate::netmesh) fn direction(&self, from: VertexId, to: VertexId) -> f64 {
        let [from, to] = [from, to].map(|vertex| self.delaunay.point(vertex));
        let way = [0, 1].map(|axis| to[axis] - from[axis]);
        // Differences of subnormal numbers are exact, their halves are not.
        let [x, y] = match way.iter().all(|part| part.is_finite()) {
            true => way,
            false => [0, 1].map(|axis| 0.5 * to[axis] - 0.5 * from[axis]),
        };
        y.atan2(x).to_degrees()
    }

    /// Returns true if doubles are too coarse for vertices on `subsegment`: their roundings would
    /// be as large as the distances of segments at the same end.
    pub(in crate::netmesh) fn is_short(&self, subsegment: u32) -> bool {
        let [a, b] = self.segments.chains.get(subsegment).ends;
        let [a, b] = [a, b].map(|end| self.delaunay.point(end));
        let largest = a.iter().chain(b).fold(0.0f64, |largest, x| largest.max(x.abs()));
        a.iter().zip(b).all(|(x, y)| (x - y).abs() <= SHORTEST * unit_below(largest))
    }

    /// Returns true if a vertex is so far from the line through two others that doubles tell
    /// vertices on this line from those on a line through the vertex. In a sharper angle, vertices
    /// that are as far from its apex on both lines encroach each other by their roundings.
    pub(in crate::netmesh) fn is_apart(&self, line: [VertexId; 2], vertex: VertexId) -> bool {
        let flat = |vertex: VertexId| {
            let x = self.delaunay.point(vertex);
            [x[0], x[1]]
        };
        let [a, b] = line.map(flat);
        let units = [0, 1].map(|axis: usize| unit_below(a[axis].abs().max(b[axis].abs())));
        offset_from_line(&a, &b, &flat(vertex), units) > NO_ROOM
    }

    /// Returns the vertices opposite the edge between `a` and `b`, if there is one.
    pub(in crate::netmesh) fn apexes(&self, a: VertexId, b: VertexId) -> Option<[VertexId; 2]> {
        // The star of an end of many lines is large, that of a vertex between two is not.
        let chains = &self.segments.chains;
        let (center, other) = if chains.line_through(a).is_some() { (a, b) } else { (b, a) };
        let complex = self.delaunay.complex();
        let first = complex.incident(center);
        let mut simplex = first;
        loop {
            let vertices = complex.vertices(simplex);
            let own = position(vertices, center);
            let [next, last] = [(own + 1) % 3, (own + 2) % 3];
            if vertices[next] == other {
                let beyond = complex.vertices(complex.neighbors(simplex)[last]);
                let apex = beyond.iter().find(|&&vertex| vertex != a && vertex != b);
                return Some([vertices[last], *apex.expect("a triangle has three vertices")]);
            }
            // Counterclockwise.
            simplex = complex.neighbors(simplex)[next];
            if simplex == first {
                return None;
            }
        }
    }
}

/// Returns the power of two between a third and two thirds of `length`, relative to it.
fn ratio_of_shell(length: f64) -> f64 {
    // The significand of a normal number, in [1, 2).
    let significand = match length.is_normal() {
        true => f64::from_bits(length.to_bits() & ((1 << 52) - 1) | 1023 << 52),
        false => 1.0,
    };
    if significand < 1.5 { 0.5 / significand } else { 1.0 / significand }
}

#[cfg(test)]
mod tests {
    use super::ratio_of_shell;

    #[test]
    fn shells_are_powers_of_two_near_the_middle() {
        for length in [1.0, 1.4, 1.499, 1.5, 1.99, 2.0, 3e100, 7e-200] {
            let ratio = ratio_of_shell(length);
            assert!((1.0 / 3.0..=2.0 / 3.0).contains(&ratio), "{length}: {ratio}");
            let radius = length * ratio;
            let nearest = 2f64.powi(radius.log2().round() as i32);
            assert!((radius / nearest - 1.0).abs() < 1e-15, "{length}: {radius}");
        }
        assert_eq!(ratio_of_shell(0.25), 0.5);
    }
}
