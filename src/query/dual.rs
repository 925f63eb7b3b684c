//! Contribution of a simplex to the volumes of Voronoi cells and of their faces.
//!
//! A Voronoi cell is the sum, with signs, of simplices between the circumcentres of a chain of
//! faces of ever higher dimension, from the vertex to a simplex of the mesh. Each step of a chain
//! is at right angles to those before: the volume is the product of the steps over dim factorial.

use super::unit::{Unit, largest, scaled};
use crate::mesh::MAX_DIM;
use crate::numerics::{Circumball, Sign, norm, orientation};

/// Sets of the vertices other than the base, as bits.
const SETS: usize = 1 << MAX_DIM;

/// Smallest ratio of a vertex's distance from a facet to the length of an edge for which its side
/// is certain.
const CLEAR: f64 = 1e-9;

/// The sums over all chains from a face, by the set of its vertices beside the base.
pub(crate) struct Chains {
    /// The step from a set to the same and one vertex more.
    steps: [[f64; MAX_DIM]; SETS],
    sums: [f64; SETS],
}

impl Default for Chains {
    fn default() -> Self {
        Self { steps: [[0.0; MAX_DIM]; SETS], sums: [0.0; SETS] }
    }
}

/// A circumcentre relative to a vertex of its simplex.
#[derive(Clone, Copy)]
pub(crate) struct Center<const D: usize> {
    /// The place of the vertex.
    pub anchor: usize,
    /// Offset of the circumcentre from the base, in units of 2^`exponent`. NaN or infinite where it
    /// cannot be used.
    pub offset: [f64; D],
    pub exponent: i32,
}

impl<const D: usize> From<Circumball<D>> for Center<D> {
    fn from(ball: Circumball<D>) -> Self {
        let exponent = i32::from(ball.exponent);
        Self { anchor: ball.anchor, offset: ball.center, exponent }
    }
}

/// A simplex seen from one of its vertices, in some unit.
struct Seen<'a, const D: usize> {
    points: &'a [&'a [f64; D]],
    base: usize,
    unit: Unit,
    /// Edges from the base to the other vertices.
    edges: [[f64; D]; D],
    /// Offset of the circumcentre from the base.
    center: [f64; D],
}

/// Unit vectors at right angles to each other that span a face, and its circumcentre.
#[derive(Clone, Copy)]
struct Frame<const D: usize> {
    vectors: [[f64; D]; D],
    count: usize,
    center: [f64; D],
}

impl Chains {
    /// Takes up a positively oriented simplex with its circumcentre. NaN or infinity come from one
    /// that cannot be used.
    pub fn of<const D: usize>(
        &mut self,
        points: &[&[f64; D]],
        base: usize,
        center: &Center<D>,
        unit: Unit,
    ) {
        let edge = |k: usize| unit.difference(points[k + usize::from(k >= base)], points[base]);
        let anchor = unit.difference(points[center.anchor], points[base]);
        let exponent = center.exponent - unit.exponent();
        let offset = center.offset.map(|x| scaled(x, exponent));
        let center = std::array::from_fn(|i| anchor[i] + offset[i]);
        let seen = Seen { points, base, unit, edges: std::array::from_fn(edge), center };
        let frame = Frame { vectors: [[0.0; D]; D], count: 0, center: [0.0; D] };
        self.measure(&seen, 0, frame);
        let full = (1 << D) - 1;
        self.sums[full] = 1.0;
        for set in (0..full).rev() {
            let others = (0..D).filter(|w| set >> w & 1 == 0);
            self.sums[set] = others.map(|w| self.steps[set][w] * self.sums[set | 1 << w]).sum();
        }
    }

    /// Returns dim factorial times the volume of the base's cell that is due to the simplex.
    pub fn of_cell(&self) -> f64 {
        self.sums[0]
    }

    /// Returns dim - 1 factorial times the volume, due to the simplex, of the facet between the
    /// cells of the base and of another vertex.
    pub fn of_facet<const D: usize>(&self, base: usize, vertex: usize) -> f64 {
        self.sums[1 << (vertex - usize::from(vertex > base))]
    }

    /// Measures the steps from a set, and from all sets that have members beyond its last one
    /// besides.
    fn measure<const D: usize>(&mut self, seen: &Seen<'_, D>, set: usize, frame: Frame<D>) {
        for w in (0..D).filter(|w| set >> w & 1 == 0) {
            let (start, edge) = seen.shortest_edge(set, w);
            if frame.count == D - 1 {
                let normal = seen.normal(&frame, w, &edge);
                let rest = std::array::from_fn(|i| seen.center[i] - frame.center[i]);
                self.steps[set][w] = dot(&rest, &normal);
                continue;
            }
            let rest = frame.without(edge);
            let length = norm(&rest);
            let center = std::array::from_fn(|i| frame.center[i] - start[i]);
            let step = (0.5 * dot(&edge, &edge) - dot(&edge, &center)) / length;
            self.steps[set][w] = step;
            if set >> w == 0 {
                self.measure(seen, set | 1 << w, frame.with(rest.map(|x| x / length), step));
            }
        }
    }
}

impl<const D: usize> Seen<'_, D> {
    /// Returns where the shortest edge to vertex `w`, of those other than the base, starts, and
    /// that edge. It starts at the base or a vertex of the set: what is left of such an edge
    /// without its part in the face is the same for all, and the shortest loses the least.
    fn shortest_edge(&self, set: usize, w: usize) -> ([f64; D], [f64; D]) {
        let point = |k: usize| self.points[k + usize::from(k >= self.base)];
        let mut shortest = ([0.0; D], self.edges[w]);
        for k in (0..D).filter(|k| set >> k & 1 == 1) {
            let edge = self.unit.difference(point(w), point(k));
            if largest(&edge) < largest(&shortest.1) {
                shortest = (self.edges[k], edge);
            }
        }
        shortest
    }

    /// Returns the unit normal of a facet on the side of vertex `w`, of those other than the base,
    /// where an `edge` from the facet ends.
    fn normal(&self, frame: &Frame<D>, w: usize, edge: &[f64; D]) -> [f64; D] {
        // The axis that is least in the facet's hyperplane.
        let within =
            |axis: usize| frame.vectors[..D - 1].iter().map(|v| v[axis] * v[axis]).sum::<f64>();
        let best =
            (1..D).fold(0, |best, axis| if within(axis) < within(best) { axis } else { best });
        let axis = std::array::from_fn(|i| f64::from(u8::from(i == best)));
        let rest = frame.without(frame.without(axis));
        let length = norm(&rest);
        let normal = rest.map(|x| x / length);
        let (side, length) = (dot(&normal, edge), norm(edge));
        let is_beyond =
            if side.abs() > CLEAR * length { side > 0.0 } else { self.is_beyond(&normal, w) };
        if is_beyond { normal } else { normal.map(|x| -x) }
    }

    /// Returns true if a nearly flat simplex has vertex `w` where the normal points: in its place,
    /// a point well beyond the facet makes a simplex of the same orientation.
    #[cold]
    fn is_beyond(&self, normal: &[f64; D], w: usize) -> bool {
        let longest = self.edges.iter().map(|edge| norm(edge)).fold(0.0, f64::max);
        let offset = self.unit.real(normal.map(|x| x * longest));
        let apex: [f64; D] = std::array::from_fn(|i| self.points[self.base][i] + offset[i]);
        let mut points = [self.points[0]; MAX_DIM + 1];
        points[..=D].copy_from_slice(self.points);
        points[w + usize::from(w >= self.base)] = &apex;
        apex.iter().all(|x| x.is_finite()) && orientation(&points[..=D]) == Sign::Positive
    }
}

impl<const D: usize> Frame<D> {
    /// Returns what is left of a vector without its part in the face.
    fn without(&self, vector: [f64; D]) -> [f64; D] {
        self.vectors[..self.count].iter().fold(vector, |rest, v| {
            let along = dot(&rest, v);
            std::array::from_fn(|i| rest[i] - along * v[i])
        })
    }

    fn with(mut self, vector: [f64; D], step: f64) -> Self {
        self.vectors[self.count] = vector;
        self.count += 1;
        self.center = std::array::from_fn(|i| self.center[i] + step * vector[i]);
        self
    }
}

#[inline]
pub(crate) fn dot<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    (0..D).fold(0.0, |sum, i| sum + a[i] * b[i])
}
