//! Search for the point of a k-d tree nearest to another. Lengths in doubles with a bound of their
//! error decide nearly all comparisons, exact signs the rest.

use super::tree::{Node, Tree};
use crate::mesh::NONE;
use crate::numerics::{Column, Edges, Sign, distance, norm};
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

/// Returns the relative difference of two computed distances, or squares of them, up to which the
/// order of the exact ones is undecided: a square carries D + 2 roundings, a length D + 4.
const fn slack(dim: usize) -> f64 {
    (4 * dim + 16) as f64 * f64::EPSILON
}

/// Least square that has lost no significant digits to underflow.
const SMALLEST_SQUARE: f64 = 1e-250;
/// Largest square that no intermediate result overflows.
const LARGEST_SQUARE: f64 = 1e250;

/// Largest difference of lengths that rounding to subnormal numbers may make.
const TINY: f64 = 1e-322;

/// Switch that ends a call before it is done; the default is never set.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stop<'a>(Cause<'a>);

#[derive(Clone, Copy, Debug, Default)]
enum Cause<'a> {
    #[default]
    Never,
    /// Another thread sets it.
    Switch(&'a AtomicBool),
    /// The questions that may still be asked.
    Questions(&'a AtomicU32),
}

impl<'a> Stop<'a> {
    /// Makes a switch that is set when the value becomes true.
    pub fn new(switch: &'a AtomicBool) -> Self {
        Self(Cause::Switch(switch))
    }

    /// Makes a switch that is set once the call has asked for it that often: calls ask after every
    /// few steps of their work. The value counts down, and is not zero if the call was not ended.
    pub fn after(questions: &'a AtomicU32) -> Self {
        Self(Cause::Questions(questions))
    }

    /// Returns true once the switch is set.
    #[inline]
    pub fn is_set(self) -> bool {
        match self.0 {
            Cause::Never => false,
            Cause::Switch(switch) => switch.load(Ordering::Relaxed),
            Cause::Questions(left) => is_last(left),
        }
    }
}

/// Counts a question; returns true for the last one, and ever after.
fn is_last(left: &AtomicU32) -> bool {
    let before = left.load(Ordering::Relaxed);
    // Threads that ask at the same time may count as one; none goes on for ever.
    left.store(before.saturating_sub(1), Ordering::Relaxed);
    before <= 1
}

/// Returns the nearest point and its distance. Of several at the same exact distance, the one with
/// the smallest id is returned; [`NONE`] and infinity if the tree is empty.
pub(crate) fn nearest<const D: usize>(tree: &Tree, q: &[f64; D]) -> (u32, f64) {
    nearest_until(Stop::default(), tree, q)
}

/// Returns the result of [`nearest`], unless `stop` is set: then gives up soon and returns any
/// point. If many points are equally near, the search visits them all.
pub(crate) fn nearest_until<const D: usize>(
    stop: Stop<'_>,
    tree: &Tree,
    q: &[f64; D],
) -> (u32, f64) {
    let best = f64::INFINITY;
    let mut search = Search { tree, q, best, id: NONE, point: *q, stop, measure: square };
    search.visit(1, &mut [0.0; D]);
    if !(SMALLEST_SQUARE..=LARGEST_SQUARE).contains(&search.best) && search.best != 0.0 {
        return nearest_by_length(stop, tree, q);
    }
    // Squares underflow to zero too.
    if search.best == 0.0 && search.point != *q {
        return nearest_by_length(stop, tree, q);
    }
    (search.id, distance(q, &search.point))
}

#[cold]
#[inline(never)]
fn nearest_by_length<const D: usize>(stop: Stop<'_>, tree: &Tree, q: &[f64; D]) -> (u32, f64) {
    let measure = |vector: &[f64; D]| norm(vector);
    let mut search = Search { tree, q, best: f64::INFINITY, id: NONE, point: *q, stop, measure };
    search.visit(1, &mut [0.0; D]);
    let length = if search.id == NONE { f64::INFINITY } else { distance(q, &search.point) };
    (search.id, length)
}

#[inline(always)]
fn square<const D: usize>(vector: &[f64; D]) -> f64 {
    vector[1..].iter().fold(vector[0] * vector[0], |sum, x| sum + x * x)
}

struct Search<'a, const D: usize, M> {
    tree: &'a Tree,
    q: &'a [f64; D],
    /// Measured distance of the nearest point found so far.
    best: f64,
    /// Id of the nearest point found so far.
    id: u32,
    /// Coordinates of the nearest point found so far.
    point: [f64; D],
    stop: Stop<'a>,
    measure: M,
}

impl<const D: usize, M: Fn(&[f64; D]) -> f64> Search<'_, D, M> {
    /// Visits the points below a node; `offsets` are the distances of the point to the node's
    /// region along each axis.
    fn visit(&mut self, node: usize, offsets: &mut [f64; D]) {
        let Some(Node { value, axis }) = self.tree.node(node) else {
            return self.visit_leaf(self.tree.leaf_at(node));
        };
        let axis = axis as usize;
        let beyond = self.q[axis] - value;
        let near = 2 * node + usize::from(beyond >= 0.0);
        self.visit(near, offsets);
        let kept = std::mem::replace(&mut offsets[axis], beyond.abs());
        if (self.measure)(offsets) <= self.limit() && !self.stop.is_set() {
            self.visit(near ^ 1, offsets);
        }
        offsets[axis] = kept;
    }

    /// Returns the measured distance above which a point is surely farther away than the nearest
    /// point found so far.
    fn limit(&self) -> f64 {
        self.best * (1.0 + slack(D)) + TINY
    }

    #[inline]
    fn visit_leaf(&mut self, leaf: usize) {
        let tree = self.tree;
        for (id, point) in tree.members::<D>(leaf) {
            let offset = std::array::from_fn(|axis| point[axis] - self.q[axis]);
            let measure = (self.measure)(&offset);
            if measure <= self.limit() && self.is_nearer(id, point, measure) {
                (self.best, self.id, self.point) = (measure, id, *point);
            }
        }
    }

    #[inline]
    fn is_nearer(&self, id: u32, point: &[f64; D], measure: f64) -> bool {
        if self.id == NONE || measure * (1.0 + slack(D)) + TINY < self.best {
            return true;
        }
        match compare(self.q, point, &self.point) {
            Sign::Negative => true,
            Sign::Zero => id < self.id,
            Sign::Positive => false,
        }
    }
}

/// Returns the exact sign of |a - q| - |b - q|.
#[cold]
#[inline(never)]
fn compare<const D: usize>(q: &[f64; D], a: &[f64; D], b: &[f64; D]) -> Sign {
    // The determinant of the rows (|a - q|^2, 1) and (|b - q|^2, 1).
    Edges::new(q, [a, b].into_iter()).sign_of_determinant(&[Column::Square, Column::Ones])
}
