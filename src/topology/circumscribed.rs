//! The smallest circumscribing ball of a face: the squared radius, and on which side of each facet
//! the centre is, seen in the face's affine hull. Doubles with a bound of their error decide nearly
//! all, integers the rest.
//!
//! Let `e_j` be the edges from the first vertex of a face of dimension `k`, `G` the matrix of their
//! products and `b` its diagonal. The centre is the first vertex plus the sum of `x_j e_j` with
//! `G x = b / 2`, so the `x_j` are its barycentric coordinates, and the squared radius is the
//! largest value of
//!
//! ```text
//!     Q(x) = sum of x_j b_j  -  |sum of x_j e_j|^2.
//! ```
//!
//! `x` comes from an elimination in doubles. Its error enters into `Q(x)` by its square only, so
//! that `Q` in 106 bits gives the radius to far more than 53.
//!
//! The bound of the error of `x`. The products of edges are computed within
//! `(D + 3) u |e_i| |e_j|`, `u` the unit roundoff; elimination is exact for a matrix off by another
//! `(3 k + 2) u |e_i| |e_j|` (N. J. Higham, "Accuracy and Stability of Numerical Algorithms",
//! Theorem 10.4, and Cauchy's inequality for the factors). Let `r_j` be `|e_j|` over the height of
//! vertex `j`, whose square is `|e_j|^2` times a diagonal entry of the inverse of `G`. By Cauchy's
//! inequality for that inverse,
//!
//! ```text
//!     |e_i| |error of x_i|  <=  r_i (sum of r_j) c u (sum of |e_j| |x_j| + longest edge),
//! ```
//!
//! with `c` the sum of the two factors. The squares of the `r_j`, computed, are exact up to a
//! factor of two if their sum is at most 2^24: larger ones are for integers.

use super::exact;
use super::radius::Radius;
use crate::memory::AllocResult;
use crate::numerics::DoubleDouble;
use crate::query::unit::{exponent, largest, scaled};

/// Largest sum of squared ratios of edge and height for which a face is not left to integers.
const LARGEST_RATIO: f64 = (1 << 24) as f64;

/// An edge shorter than this, where the longest is about 1, is for integers: squares of products
/// could underflow.
const SHORTEST_EDGE: f64 = 1e-90;

/// Smallest circumscribing ball of a face: its radius and the side of each facet on which its
/// centre is.
pub(super) struct Ball {
    /// The barycentric coordinates of the centre that are negative, as bits.
    pub negative: u16,
    /// Radius in the form that was wanted; NaN if none was.
    pub radius: f64,
}

/// Computes the ball of the `K + 1` points of a face; `None` if they are not independent.
pub(super) fn ball<const K: usize, const D: usize>(
    points: &[&[f64; D]],
    wanted: Radius,
) -> AllocResult<Option<Ball>> {
    let points = &points[..=K];
    let (mut negative, mut radius) = (None, None);
    if let Some(edges) = Edges::<K, D>::new(points) {
        if let Some(center) = edges.center() {
            negative = center.negative();
            radius = edges.radius(&center, wanted);
        }
    }
    if negative.is_none() {
        negative = exact::negative_coordinates(points)?;
    }
    if radius.is_none() {
        radius = exact::radius(points, wanted)?;
    }
    Ok(negative.zip(radius).map(|(negative, radius)| Ball { negative, radius }))
}

/// The edges from the first point, in a unit that is a power of two.
struct Edges<'a, const K: usize, const D: usize> {
    points: &'a [&'a [f64; D]],
    /// The products of the edges, in doubles.
    products: [[f64; K]; K],
    /// The unit is 2 to this power.
    exponent: i32,
}

/// The products of the edges as `L P L^T`, with a diagonal matrix `P` and ones on the diagonal of
/// `L`.
struct Factors<const K: usize> {
    lower: [[f64; K]; K],
    /// Inverses of the entries on the diagonal of `P`.
    inverse_pivots: [f64; K],
}

/// The barycentric coordinates of a centre but the first.
struct CenterCoordinates<const K: usize> {
    x: [f64; K],
    /// Bounds of the errors.
    errors: [f64; K],
    factors: Factors<K>,
    /// Bound of the longest edge and of the sum of `|e_j| |x_j|`.
    size: f64,
    /// Bound of the sum of `r_i r_j c u`, which a relative error of the system means for the sum of
    /// `x_j e_j`.
    growth: f64,
}

impl<'a, const K: usize, const D: usize> Edges<'a, K, D> {
    /// Computes the products of the edges; `None` if an edge is too long or too short for doubles.
    fn new(points: &'a [&'a [f64; D]]) -> Option<Self> {
        let mut edges = [[0.0; D]; K];
        let mut longest = 0.0f64;
        for (edge, end) in edges.iter_mut().zip(&points[1..]) {
            *edge = std::array::from_fn(|i| end[i] - points[0][i]);
            longest = longest.max(largest(edge));
        }
        if !(1e-280..=1e280).contains(&longest) {
            return None;
        }
        let exponent = exponent(longest);
        let power = scaled(1.0, -exponent);
        edges.iter_mut().flatten().for_each(|x| *x *= power);
        let product =
            |i: usize, j: usize| (0..D).map(|axis| edges[i][axis] * edges[j][axis]).sum::<f64>();
        // Below the diagonal and on it: what the elimination reads.
        let products = std::array::from_fn(|i| {
            std::array::from_fn(|j| if j <= i { product(i, j) } else { 0.0 })
        });
        let is_long = (0..K).all(|i: usize| product(i, i) > SHORTEST_EDGE * SHORTEST_EDGE);
        is_long.then_some(Self { points, products, exponent })
    }

    /// Returns the edge to vertex `j + 1`, exactly.
    #[inline]
    fn edge(&self, j: usize) -> [DoubleDouble; D] {
        let (start, end) = (self.points[0], self.points[j + 1]);
        let power = scaled(1.0, -self.exponent);
        std::array::from_fn(|i| DoubleDouble::difference(end[i], start[i]).scaled(power))
    }

    /// Computes the centre; `None` if the face is too flat for doubles.
    fn center(&self) -> Option<CenterCoordinates<K>> {
        let factors = Factors::new(&self.products)?;
        let square = |i: usize| self.products[i][i];
        let x = factors.solve(std::array::from_fn(|i| 0.5 * square(i)));
        let inverse = factors.diagonal_of_inverse();
        let ratio = (0..K).map(|i| square(i) * inverse[i]).sum::<f64>();
        // Not a number must fail, too.
        let is_good = ratio <= LARGEST_RATIO;
        if !is_good {
            return None;
        }
        // The sum of the ratios is no more than the root. A factor of two for each of them, one
        // more for what is rounded here.
        let root = (K as f64 * ratio).sqrt();
        let unit = 4.0 * (D + 3 * K + 8) as f64 * f64::EPSILON * root;
        let longest = (0..K).map(square).fold(0.0, f64::max).sqrt();
        let size = longest * (1.0 + x.iter().map(|x| x.abs()).sum::<f64>());
        let errors = inverse.map(|inverse| inverse.sqrt() * unit * size);
        Some(CenterCoordinates { x, errors, factors, size, growth: root * unit })
    }

    /// Computes the radius; `None` if doubles do not tell which one is the nearest.
    fn radius(&self, center: &CenterCoordinates<K>, wanted: Radius) -> Option<f64> {
        if wanted == Radius::Nothing {
            return Some(f64::NAN);
        }
        let (mut sum, mut offset) = (DoubleDouble::ZERO, [DoubleDouble::ZERO; D]);
        let mut terms = 0.0;
        for (j, &x) in center.x.iter().enumerate() {
            let mut square = DoubleDouble::ZERO;
            for (to, component) in offset.iter_mut().zip(self.edge(j)) {
                *to = *to + component * x;
                square = square + component * component;
            }
            sum = sum + square * x;
            terms += square.high * x.abs();
        }
        for component in offset {
            sum = sum - component * component;
        }
        // Each term of the two sums has at most 8 + 4 (D + K) of these errors, twice where squared.
        let unit = (64 + 16 * (D + K)) as f64 * SQUARE_UNIT;
        let rounding = unit * (terms + center.size * center.size);
        let error = center.growth * center.size;
        let square = nearest(sum, rounding + error * error).or_else(|| {
            let (rest, error) = self.rest(center, &offset, unit);
            nearest(sum + rest, rounding + error)
        })?;
        wanted.of_square(square, self.exponent)
    }

    /// Returns the contribution of the error of `x` to the squared radius, and a bound of its own
    /// error: with `r = b / 2 - G x` it is the product of `r` and the solution `y` of `G y = r`.
    /// `offset` is the sum of `x_j e_j` up to `unit` of the center's size.
    #[cold]
    fn rest(
        &self,
        center: &CenterCoordinates<K>,
        offset: &[DoubleDouble; D],
        unit: f64,
    ) -> (DoubleDouble, f64) {
        let residual: [f64; K] = std::array::from_fn(|j| {
            let edge = self.edge(j).into_iter().zip(offset);
            edge.fold(DoubleDouble::ZERO, |sum, (e, &o)| sum + e * (e * 0.5 - o)).high
        });
        let solution = center.factors.solve(residual);
        let product = |i: usize| DoubleDouble { high: residual[i], low: 0.0 } * solution[i];
        let rest = (0..K).fold(DoubleDouble::ZERO, |sum, i| sum + product(i));
        let lengths: [f64; K] = std::array::from_fn(|i| self.products[i][i].sqrt());
        let size: f64 = (0..K).map(|i| lengths[i] * solution[i].abs()).sum();
        // Of a residual over the length of its edge; the last rounding is to a double.
        let largest = (0..K).map(|i| residual[i].abs() / lengths[i]).fold(0.0, f64::max);
        let of_residual = 4.0 * unit * center.size + f64::EPSILON * largest;
        // `growth` has the unit of the products' errors, by which an error of the residual is less.
        let of_solution = center.growth * (size + of_residual / f64::EPSILON);
        (rest, largest * of_solution + size * of_residual)
    }
}

/// The square of the unit roundoff.
const SQUARE_UNIT: f64 = f64::EPSILON * f64::EPSILON / 4.0;

impl<const K: usize> Factors<K> {
    /// Factors a matrix of products; `None` unless all pivots are positive.
    fn new(products: &[[f64; K]; K]) -> Option<Self> {
        let (mut lower, mut pivots, mut inverse_pivots) = (*products, [0.0; K], [0.0; K]);
        for j in 0..K {
            let row: [f64; K] = std::array::from_fn(|m| lower[j][m] * pivots[m]);
            let dot = |line: &[f64; K]| (0..j).map(|m| line[m] * row[m]).sum::<f64>();
            pivots[j] = lower[j][j] - dot(&lower[j]);
            let is_positive = pivots[j] > 0.0;
            if !is_positive {
                return None;
            }
            inverse_pivots[j] = 1.0 / pivots[j];
            for line in &mut lower[j + 1..] {
                line[j] = (line[j] - dot(line)) * inverse_pivots[j];
            }
        }
        Some(Self { lower, inverse_pivots })
    }

    fn solve(&self, mut x: [f64; K]) -> [f64; K] {
        for i in 0..K {
            x[i] -= (0..i).map(|m| self.lower[i][m] * x[m]).sum::<f64>();
        }
        (0..K).for_each(|i| x[i] *= self.inverse_pivots[i]);
        for i in (0..K).rev() {
            x[i] -= (i + 1..K).map(|m| self.lower[m][i] * x[m]).sum::<f64>();
        }
        x
    }

    fn diagonal_of_inverse(&self) -> [f64; K] {
        std::array::from_fn(|j| {
            // Column j of the inverse of L.
            let mut column = [0.0; K];
            column[j] = 1.0;
            let mut square = self.inverse_pivots[j];
            for i in j + 1..K {
                column[i] = -(j..i).map(|m| self.lower[i][m] * column[m]).sum::<f64>();
                square += column[i] * column[i] * self.inverse_pivots[i];
            }
            square
        })
    }
}

impl<const K: usize> CenterCoordinates<K> {
    /// Returns the coordinates that are negative, as bits; `None` if one may be zero.
    fn negative(&self) -> Option<u16> {
        let first = 1.0 - self.x.iter().sum::<f64>();
        let magnitudes = self.x.iter().fold(1.0, |sum, x| sum + x.abs());
        let mut error_of_first = (K + 1) as f64 * f64::EPSILON * magnitudes;
        let (mut negative, mut is_known) = (u16::from(first < 0.0), true);
        for i in 0..K {
            negative |= u16::from(self.x[i] < 0.0) << (i + 1);
            is_known &= self.x[i].abs() > self.errors[i];
            error_of_first += self.errors[i];
        }
        is_known &= first.abs() > 2.0 * error_of_first;
        is_known.then_some(negative)
    }
}

/// Returns the double that is nearest to a number known up to `error`; `None` if it may be either
/// of two.
fn nearest(number: DoubleDouble, error: f64) -> Option<f64> {
    let ends = [number.low - error, number.low + error].map(|low| number.high + low);
    (ends[0] == ends[1]).then_some(ends[0])
}
