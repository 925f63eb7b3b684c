//! Barycentric coordinates of a point in a face of a simplex.

use super::unit::{Unit, exponent, largest, scaled};
use crate::mesh::MAX_DIM;

/// A weight for each vertex of a simplex.
pub(super) type Weights = [f64; MAX_DIM + 1];

/// Returns the barycentric coordinates of `q` in the face `face` of the simplex `points`; those of
/// other vertices are zero. They sum to one up to a rounding, and combine the vertices to `q` up to
/// a few roundings of the longest edge, however flat the simplex is.
pub(super) fn coordinates_in<const D: usize>(
    points: &[&[f64; D]],
    face: u32,
    q: &[f64; D],
) -> Weights {
    let mut weights = [0.0; MAX_DIM + 1];
    if face.count_ones() == 1 {
        weights[face.trailing_zeros() as usize] = 1.0;
        return weights;
    }
    let magnitudes = points.iter().copied().chain([q]).map(largest);
    let unit = Unit::of_points(magnitudes.fold(0.0, f64::max));
    let base = nearest_vertex(points, face, q, unit);
    weights = combination(points, face, base, unit.difference(q, points[base]), unit);
    weights[base] += 1.0;
    weights
}

/// Returns the vertex of the face that is nearest to `q` in the maximum norm: differences from it
/// lose the least.
fn nearest_vertex<const D: usize>(
    points: &[&[f64; D]],
    face: u32,
    q: &[f64; D],
    unit: Unit,
) -> usize {
    let size = |i: usize| largest(&unit.difference(points[i], q));
    let of_face = (0..=D).filter(|i| face >> i & 1 == 1);
    of_face.min_by(|&i, &j| size(i).total_cmp(&size(j))).unwrap_or(0)
}

/// Returns weights that sum to zero and combine the vertices of the face to `target`, a vector in
/// its affine hull.
fn combination<const D: usize>(
    points: &[&[f64; D]],
    face: u32,
    base: usize,
    target: [f64; D],
    unit: Unit,
) -> Weights {
    let mut system = System { rows: [[0.0; D]; D], right: [0.0; D] };
    let mut vertices = [(0, 0); MAX_DIM];
    let mut count = 0;
    for i in (0..=D).filter(|&i| face >> i & 1 == 1 && i != base) {
        let (edge, exponent) = normalized(unit.difference(points[i], points[base]));
        (0..D).for_each(|row| system.rows[row][count] = edge[row]);
        vertices[count] = (i, exponent);
        count += 1;
    }
    let (right, top) = normalized(target);
    system.right = right;
    let solution = system.solve(count);
    let mut weights = [0.0; MAX_DIM + 1];
    for (&(i, exponent), x) in vertices[..count].iter().zip(solution) {
        weights[i] = scaled(x, top - exponent);
        weights[base] -= weights[i];
    }
    weights
}

/// System of `D` linear equations in at most as many unknowns, consistent if there are fewer.
pub(super) struct System<const D: usize> {
    pub rows: [[f64; D]; D],
    pub right: [f64; D],
}

impl<const D: usize> System<D> {
    /// Solves the system by Gaussian elimination with complete pivoting: residuals are small
    /// whatever the condition.
    pub fn solve(&mut self, unknowns: usize) -> [f64; D] {
        let mut order: [usize; D] = std::array::from_fn(|column| column);
        let mut rank = 0;
        while rank < unknowns && self.bring_pivot(rank, unknowns, &mut order) {
            let (pivot, right) = (self.rows[rank], self.right[rank]);
            for row in rank + 1..D {
                let factor = self.rows[row][order[rank]] / pivot[order[rank]];
                order[rank..unknowns].iter().for_each(|&column| {
                    self.rows[row][column] -= factor * pivot[column];
                });
                self.right[row] -= factor * right;
            }
            rank += 1;
        }
        let mut solution = [0.0; D];
        for row in (0..rank).rev() {
            let known = order[row + 1..rank].iter();
            let sum = known.fold(self.right[row], |sum, &column| {
                sum - self.rows[row][column] * solution[column]
            });
            solution[order[row]] = sum / self.rows[row][order[row]];
        }
        solution
    }

    /// Swaps the largest entry that is left to row and place `rank`; false if all are zero.
    fn bring_pivot(&mut self, rank: usize, unknowns: usize, order: &mut [usize; D]) -> bool {
        let (mut best, mut at) = (0.0, (rank, rank));
        for row in rank..D {
            for (place, &column) in order.iter().enumerate().take(unknowns).skip(rank) {
                let size = self.rows[row][column].abs();
                if size > best {
                    (best, at) = (size, (row, place));
                }
            }
        }
        self.rows.swap(rank, at.0);
        self.right.swap(rank, at.0);
        order.swap(rank, at.1);
        best > 0.0
    }
}

/// Returns the vector times 2^-e, with its largest component in [1, 2) unless it is zero, and the
/// exponent e.
fn normalized<const D: usize>(vector: [f64; D]) -> ([f64; D], i32) {
    let exponent = exponent(largest(&vector));
    (vector.map(|x| scaled(x, -exponent)), exponent)
}
