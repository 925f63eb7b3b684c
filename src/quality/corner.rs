//! Voronoi corners (circumcentres of simplices) and facet normals, in local scaled coordinates,
//! written apart from the builder's so that the certificate does not repeat the builder's mistakes.

use super::length::{Length, Offset, scale};
use super::rational::{self, Gradients};
use super::simplex::{Normals, Simplex};
use crate::memory::AllocResult;
use crate::mesh::MAX_DIM;

/// Below this ratio of pivots a solution in doubles is no longer good to 1e-10: go exact.
const WELL_CONDITIONED: f64 = 1e-5;

/// A Voronoi corner: the circumcentre of a simplex, relative to one of its vertices.
pub(crate) struct Corner<const D: usize> {
    /// The vertex (0..=D of the simplex) that `center` is relative to.
    pub base: usize,
    pub center: Offset<D>,
    pub radius: Length,
    pub shortest_edge: Length,
}

impl<const D: usize> Corner<D> {
    /// Computes the corner of the simplex `points` (`D + 1` of them), with a relative error of at
    /// most about 1e-10; `None` if the simplex is flat.
    pub fn new(points: &[&[f64; D]]) -> AllocResult<Option<Self>> {
        Simplex::new(points).corner()
    }

    /// Returns the distance of the corner from `point`; `points` are those given to
    /// [`Corner::new`].
    pub fn distance(&self, points: &[&[f64; D]], point: &[f64; D]) -> Length {
        let squared = self.squared_distance(points, point);
        match Length::SQUARES.contains(&squared) {
            true => Length::new(squared.sqrt()),
            false => Offset::between(points[self.base], point).plus(&self.center).length(),
        }
    }

    /// Returns the squared distance of the corner from `point` if it is in [`Length::SQUARES`] and
    /// simple to tell; what is not in there otherwise.
    #[inline]
    pub(super) fn squared_distance(&self, points: &[&[f64; D]], point: &[f64; D]) -> f64 {
        if self.center.exponent != 0 {
            return 0.0;
        }
        let base = points[self.base];
        let mut squared = 0.0;
        for axis in 0..D {
            let across = base[axis] - point[axis] + self.center.vector[axis];
            squared += across * across;
        }
        squared
    }
}

/// Returns the edges from `base` to the other vertices, in their order.
fn edges<const D: usize>(points: &[&[f64; D]], base: usize) -> [Offset<D>; D] {
    std::array::from_fn(|k| Offset::between(points[k + usize::from(k >= base)], points[base]))
}

/// Returns the circumcentre relative to the point at `base`; `None` if the simplex is flat.
pub(super) fn circumcenter<const D: usize>(
    points: &[&[f64; D]],
    base: usize,
) -> AllocResult<Option<Offset<D>>> {
    let edges = edges(points, base);
    let exponent = edges.iter().map(|edge| edge.exponent).max().unwrap_or(0);
    // e . c = |e|^2 / 2, each row in units of its own edge, c in units of the longest.
    let mut matrix = edges.map(|edge| edge.vector);
    let mut right = edges.map(|e| [scale(e.squared_mantissa() / 2.0, e.exponent - exponent)]);
    if solve(&mut matrix, &mut right) < WELL_CONDITIONED {
        return rational::circumcenter(points, base);
    }
    Ok(Some(Offset::normalized(right.map(|[x]| x), exponent)))
}

/// Returns the inward normals of the `D + 1` facets, the i-th opposite vertex i, each of magnitude
/// about one; `None` if the simplex is flat.
pub(super) fn normals<const D: usize>(
    points: &[&[f64; D]],
    base: usize,
) -> AllocResult<Option<Normals<D>>> {
    let Some(gradients) = gradients(points, base)? else {
        return Ok(None);
    };
    let mut normals = [[0.0; D]; MAX_DIM + 1];
    normals[base] = gradients[D].vector;
    for k in 0..D {
        normals[k + usize::from(k >= base)] = gradients[k].vector;
    }
    Ok(Some(normals))
}

/// Returns the gradients of the barycentric coordinates of the vertices other than `base`, and last
/// the gradient of that of `base`; `None` if the simplex is flat.
fn gradients<const D: usize>(
    points: &[&[f64; D]],
    base: usize,
) -> AllocResult<Option<Gradients<D>>> {
    let edges = edges(points, base);
    let mut matrix = edges.map(|edge| edge.vector);
    let mut right: [[f64; D]; D] =
        std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
    if solve(&mut matrix, &mut right) < WELL_CONDITIONED {
        return rational::gradients(points, base);
    }
    let column = |j: usize| Offset::normalized(right.map(|row| row[j]), -edges[j].exponent);
    let mut gradients = [Offset::ZERO; MAX_DIM + 1];
    (0..D).for_each(|k| gradients[k] = column(k));
    let sum = gradients[..D].iter().fold(Offset::ZERO, |sum, gradient| sum.plus(gradient));
    gradients[D] = Offset { vector: sum.vector.map(|x| -x), exponent: sum.exponent };
    Ok(Some(gradients))
}

/// Solves `matrix x = right` for each column of `right`, in place, by Gauss-Jordan elimination
/// with complete pivoting. Returns the smallest pivot over the largest, 0 where it gave up.
fn solve<const D: usize, const R: usize>(
    matrix: &mut [[f64; D]; D],
    right: &mut [[f64; R]; D],
) -> f64 {
    let mut unknown_of_row = [0; D];
    let (mut smallest, mut largest) = (f64::INFINITY, 0.0f64);
    for k in 0..D {
        let (row, column) = largest_entry(matrix, k, &unknown_of_row[..k]);
        matrix.swap(k, row);
        right.swap(k, row);
        unknown_of_row[k] = column;
        let pivot = matrix[k][column];
        smallest = smallest.min(pivot.abs());
        largest = largest.max(pivot.abs());
        if smallest <= largest * 1e-300 {
            return 0.0;
        }
        matrix[k] = matrix[k].map(|x| x / pivot);
        right[k] = right[k].map(|x| x / pivot);
        let (pivot_row, pivot_right) = (matrix[k], right[k]);
        for i in (0..D).filter(|&i| i != k) {
            let factor = matrix[i][column];
            for (entry, above) in matrix[i].iter_mut().zip(&pivot_row) {
                *entry -= factor * above;
            }
            for (entry, above) in right[i].iter_mut().zip(&pivot_right) {
                *entry -= factor * above;
            }
        }
    }
    let solved = *right;
    for (row, &unknown) in solved.iter().zip(&unknown_of_row) {
        right[unknown] = *row;
    }
    smallest / largest
}

/// Returns the position of the largest entry in rows `first..` and in columns not yet `taken`.
fn largest_entry<const D: usize>(
    matrix: &[[f64; D]; D],
    first: usize,
    taken: &[usize],
) -> (usize, usize) {
    let mut best = (first, 0);
    let mut size = -1.0;
    for (i, row) in matrix.iter().enumerate().skip(first) {
        for (j, entry) in row.iter().enumerate() {
            if entry.abs() > size && !taken.contains(&j) {
                best = (i, j);
                size = entry.abs();
            }
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check<const D: usize>(points: &[[f64; D]], center: [f64; D]) {
        let points: Vec<&[f64; D]> = points.iter().collect();
        let corner = Corner::new(&points).unwrap().expect("not flat");
        for point in &points {
            let ratio = corner.distance(&points, point).ratio(corner.radius);
            assert!((ratio - 1.0).abs() < 1e-9, "{ratio}");
        }
        let miss = corner.distance(&points, &center).ratio(corner.radius);
        assert!(miss < 1e-9, "missed by {miss}");
    }

    #[test]
    fn circumcentres_of_right_simplices() {
        check(&[[0.0, 0.0], [2.0, 0.0], [0.0, 4.0]], [1.0, 2.0]);
        check(&[[0.0; 3], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]], [1.0; 3]);
        check(&[[1e300, 0.0], [-1e300, 0.0], [0.0, 1e300]], [0.0, 0.0]);
        let t = 3e-310;
        check(&[[t, 0.0], [-t, 0.0], [0.0, t]], [0.0, 0.0]);
    }

    #[test]
    fn flat_simplices_have_no_corner() {
        let flat: [&[f64; 2]; 3] = [&[0.0, 0.0], &[1.0, 1.0], &[3.0, 3.0]];
        assert!(Corner::new(&flat).unwrap().is_none());
        assert!(normals(&flat, 0).unwrap().is_none());
    }

    #[test]
    fn ill_conditioned_simplices_go_exact() {
        // Three points of the unit circle within 1e-9 of each other.
        let y = 2f64.powi(-30);
        check(&[[0.0, 0.0], [y, y * y / 2.0], [-y, y * y / 2.0]], [0.0, 1.0 + y * y / 4.0]);
        // A pair at distance 1 from a pair, both 2^-200 wide.
        let w = 2f64.powi(-200);
        check(&[[w, 0.0, 0.0], [-w, 0.0, 0.0], [0.0, w, 1.0], [0.0, -w, 1.0]], [0.0, 0.0, 0.5]);
    }

    #[test]
    fn normals_point_inward_and_span_the_right_angles() {
        let points = [[0.0, 0.0, 0.0], [1e-200, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let points: Vec<&[f64; 3]> = points.iter().collect();
        let normals = normals(&points, 0).unwrap().unwrap();
        assert!(normals[1][0] > 0.0 && normals[1][1] == 0.0 && normals[1][2] == 0.0);
        assert!(normals[2][1] > 0.0 && normals[3][2] > 0.0);
        assert!(normals[0][0] < 0.0);
    }

    #[test]
    fn exact_and_rounded_solutions_agree() {
        let points = [[0.1, 0.2, -0.4], [1.3, 0.1, 0.2], [0.3, 1.7, 0.4], [0.2, 0.6, 2.1]];
        let points: Vec<&[f64; 3]> = points.iter().collect();
        let rounded = circumcenter(&points, 1).unwrap().unwrap();
        let exact = rational::circumcenter(&points, 1).unwrap().unwrap();
        let gradients = gradients(&points, 1).unwrap().unwrap();
        let exact_gradients = rational::gradients(&points, 1).unwrap().unwrap();
        for (a, b) in
            [(rounded, exact)].into_iter().chain(gradients.into_iter().zip(exact_gradients))
        {
            assert_eq!(a.exponent, b.exponent);
            for k in 0..3 {
                assert!((a.vector[k] - b.vector[k]).abs() < 1e-13);
            }
        }
    }
}
