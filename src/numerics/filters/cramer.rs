//! Twice the circumcentre by Cramer's rule with a bound of its error by Hadamard's inequality: a
//! few square roots instead of a permanent for each determinant. For edges of everyday lengths,
//! which need no scaling.

use super::f64x2::Real;
use crate::numerics::power::{UNIT, power_of_two};

/// Largest dimension that [`circumcenter`] supports.
pub(super) const MAX_CRAMER: usize = 4;

/// Centre of a sphere through an origin and D other points, relative to the origin.
pub(super) struct Center<const D: usize, R = f64> {
    /// Vector from the origin to the centre, times two.
    pub twice: [R; D],
    /// Diameter of the sphere, which is the length of `twice`.
    pub diameter: R,
    /// Largest distance of a component of `twice` from the exact one.
    pub error: R,
    /// Sum of the squared lengths of the edges.
    total: R,
    /// Product of the squared lengths of the edges.
    product: R,
    /// Product of the edges' lengths over the volume that they span.
    ratio: R,
}

/// Returns the exponent e such that edges with lengths from 2^-e to 2^e need no scaling.
/// [`Center::is_usable`] lets no length exceed that and no product of them fall below 2^(-D e):
/// each is then at least 2^-((2 D - 1) e), and its square at least 2^-900.
const fn max_exponent(dim: usize) -> i32 {
    450 / (2 * dim as i32 - 1)
}

/// Units of roundoff in a numerator, by dimension: see [`circumcenter`].
const NUMERATOR: [f64; MAX_CRAMER + 1] = [0.0, 0.0, 8.0, 13.0, 26.0];
/// Units of roundoff in the determinant, by dimension: see [`circumcenter`].
const DETERMINANT: [f64; MAX_CRAMER + 1] = [0.0, 0.0, 5.0, 12.0, 31.0];

impl<const D: usize, R: Real> Center<D, R> {
    /// Returns true if lengths are within [`max_exponent`], and the volume that the edges span is
    /// at least 1/`flatness` (which is at most 2^12) of that of a box with such edges.
    ///
    /// The distance of two ends of edges is then at least 1/`flatness` of both their distances to
    /// the origin, less roundoff: edges i and j span a volume with the others that is at most their
    /// difference times the length of i times those of the others, and the same for j.
    #[inline(always)]
    pub fn is_usable(&self, flatness: f64) -> bool {
        // Infinite squares, and the NaN that they lead to, fail the first comparison.
        self.total.is_at_most(R::of(power_of_two(2 * max_exponent(D))))
            && R::of(power_of_two(-2 * D as i32 * max_exponent(D))).is_at_most(self.product)
            && self.ratio.is_at_most(R::of(flatness))
    }
}

/// Solves v_i . x = |v_i|^2 for `edges` v_i that are rounded differences of finite points, in
/// dimension 2 to [`MAX_CRAMER`]. Nothing is known of the result where it is not
/// [usable](Center::is_usable).
///
/// Proof of the bound. Let r be the product of the lengths, d the determinant, u the roundoff. An
/// edge's component carries 1 rounding, its square length D + 2 (two components, a product, D - 1
/// sums). A product of the determinant carries 4, 8 or 12 roundings in dimension 2, 3 or 4, one of
/// a numerator 7, 12 or 17. Each counts in proportion to the sum of the absolute products, a
/// permanent of absolute values. P(n) = sqrt((n - 1)!) bounds it for n rows of length 1: expanded
/// along a row it is, by Cauchy's inequality, at most the root of the sum over k of the squared
/// minors without column k, which are at most P(n - 1)^2 (1 - b_k^2) for any one b of their rows,
/// in sum (n - 1) P(n - 1)^2. So the determinant is wrong by at most 4, 8 sqrt 2 or 12 sqrt 6 times
/// u r, and a numerator by 7, 12 or 17 sqrt 2 times u r and the sum of the lengths, which is at
/// most the root of D times the sum of their squares. d is known to 2^-35, since it is at least r /
/// 2^12, and (n + a)/(d + b) - n/d = (a - b (n + a)/(d + b))/d bounds the error of a quotient n/d,
/// whose own two roundings are the 2. The constants are rounded up by more than 3%, which pays for
/// terms of second order and for the roundings here. What underflows, at most 2^-1075 in a product,
/// has become at most 2^-700 in the end, where the bound is at least u r times a length, 2^-510.
/// Nothing overflows.
#[inline(always)]
pub(super) fn circumcenter<const D: usize, R: Real>(edges: &[[R; D]; D]) -> Center<D, R> {
    let squares: [R; D] = std::array::from_fn(|i| square(&edges[i]));
    let total = squares[1..].iter().fold(squares[0], |sum, &x| sum + x);
    let product = squares[1..].iter().fold(squares[0], |product, &x| product * x);
    let (numerators, determinant) = match D {
        2 => in_two(edges, &squares),
        3 => in_three(edges, &squares),
        _ => in_four(edges, &squares),
    };
    let inverse = R::of(1.0) / determinant;
    let ratio = product.sqrt() * inverse.abs();
    let twice = numerators.map(|x| x * inverse);
    let diameter = square(&twice).sqrt();
    let length = (R::of(D as f64) * total).sqrt();
    let from_numerator = ratio * R::of(UNIT * NUMERATOR[D]) * length;
    let from_determinant = ratio * R::of(UNIT * DETERMINANT[D]) + R::of(2.0 * UNIT);
    let error = from_numerator + from_determinant * diameter;
    Center { twice, diameter, error, total, product, ratio }
}

/// Returns the squared length.
#[inline(always)]
pub(super) fn square<const D: usize, R: Real>(v: &[R; D]) -> R {
    v[1..].iter().fold(v[0] * v[0], |sum, &x| sum + x * x)
}

/// Returns numerators and the determinant in the plane.
#[inline(always)]
fn in_two<const D: usize, R: Real>(a: &[[R; D]; D], b: &[R; D]) -> ([R; D], R) {
    let mut numerators = [R::of(0.0); D];
    numerators[0] = b[0] * a[1][1] - b[1] * a[0][1];
    numerators[1] = b[1] * a[0][0] - b[0] * a[1][0];
    (numerators, a[0][0] * a[1][1] - a[0][1] * a[1][0])
}

/// Returns numerators and the determinant in space, from the cross products of the rows.
#[inline(always)]
fn in_three<const D: usize, R: Real>(a: &[[R; D]; D], b: &[R; D]) -> ([R; D], R) {
    let (m0, m1, m2) = (cross(&a[1], &a[2]), cross(&a[2], &a[0]), cross(&a[0], &a[1]));
    let mut numerators = [R::of(0.0); D];
    for i in 0..3 {
        numerators[i] = b[0] * m0[i] + b[1] * m1[i] + b[2] * m2[i];
    }
    (numerators, a[0][0] * m0[0] + a[0][1] * m0[1] + a[0][2] * m0[2])
}

#[inline(always)]
fn cross<const D: usize, R: Real>(r: &[R; D], s: &[R; D]) -> [R; 3] {
    [r[1] * s[2] - r[2] * s[1], r[2] * s[0] - r[0] * s[2], r[0] * s[1] - r[1] * s[0]]
}

/// Returns numerators and the determinant in dimension 4, by Laplace expansion along the first two
/// rows: sums of minors of these times complementary minors of the other two. Where the right side
/// is a column of the matrix, the minors with it are the components of `u` and `v`.
#[inline(always)]
fn in_four<const D: usize, R: Real>(a: &[[R; D]; D], b: &[R; D]) -> ([R; D], R) {
    let [m01, m02, m03, m12, m13, m23] = minors(&a[0], &a[1]);
    let [n01, n02, n03, n12, n13, n23] = minors(&a[2], &a[3]);
    let u: [R; 4] = std::array::from_fn(|k| b[0] * a[1][k] - b[1] * a[0][k]);
    let v: [R; 4] = std::array::from_fn(|k| b[2] * a[3][k] - b[3] * a[2][k]);
    let mut x = [R::of(0.0); D];
    x[0] = (u[1] * n23 - u[2] * n13 + u[3] * n12) + (v[1] * m23 - v[2] * m13 + v[3] * m12);
    x[1] = (u[2] * n03 - u[0] * n23 - u[3] * n02) + (v[2] * m03 - v[0] * m23 - v[3] * m02);
    x[2] = (u[0] * n13 - u[1] * n03 + u[3] * n01) + (v[0] * m13 - v[1] * m03 + v[3] * m01);
    x[3] = (u[1] * n02 - u[0] * n12 - u[2] * n01) + (v[1] * m02 - v[0] * m12 - v[2] * m01);
    let determinant = (m01 * n23 - m02 * n13 + m03 * n12) + (m12 * n03 - m13 * n02 + m23 * n01);
    (x, determinant)
}

/// Returns the 2x2 minors of two rows by columns 01, 02, 03, 12, 13, 23.
#[inline(always)]
fn minors<const D: usize, R: Real>(r: &[R; D], s: &[R; D]) -> [R; 6] {
    let minor = |i: usize, j: usize| r[i] * s[j] - r[j] * s[i];
    [minor(0, 1), minor(0, 2), minor(0, 3), minor(1, 2), minor(1, 3), minor(2, 3)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::lengths::largest_magnitude;
    use crate::numerics::testing::{Random, determinant_oracle, integer, is_close};

    /// Returns edges of one scale, or each of its own, flat by about 2^-`depth`.
    fn draw<const D: usize>(depth: i32, random: &mut Random) -> [[f64; D]; D] {
        let limit = i64::from(max_exponent(D)) - 4;
        let scale = random.integer(-limit, limit);
        let is_mixed = random.bits() & 1 == 0;
        let mut row = || -> [f64; D] { std::array::from_fn(|_| random.unit()) };
        let (first, others) = (row(), [(); D].map(|()| row()));
        others.map(|other| {
            let power = if is_mixed { random.integer(-limit, limit) } else { scale };
            let unit = 2f64.powi(power as i32);
            std::array::from_fn(|k| (first[k] + other[k] * 2f64.powi(-depth)) * unit)
        })
    }

    /// Checks that the exact centre is within the bound of the computed one; returns how many were
    /// found.
    fn bounds_hold<const D: usize>(trials: usize, depth: i32) -> usize {
        let mut random = Random(D as u64 * 100 + depth as u64);
        let found = |_: &usize| {
            let edges = draw::<D>(depth, &mut random);
            let center = circumcenter(&edges);
            if !center.is_usable(4096.0) {
                return false;
            }
            let exact: Vec<_> = edges.iter().map(|row| row.map(integer).to_vec()).collect();
            let denominator = determinant_oracle(&exact);
            for k in 0..D {
                let mut replaced = exact.clone();
                for (entries, row) in replaced.iter_mut().zip(&exact) {
                    entries[k] = row.iter().map(|x| x * x).sum();
                }
                let quotient = (&determinant_oracle(&replaced), &denominator);
                assert!(is_close(center.twice[k], center.error, 0, quotient), "{edges:?}");
            }
            assert!(center.error <= 1e-9 * largest_magnitude(&center.twice), "{edges:?}");
            true
        };
        (0..trials).filter(found).count()
    }

    #[test]
    fn centres_are_within_their_bounds() {
        fn check<const D: usize>() {
            assert!(bounds_hold::<D>(200, 0) > 190);
            for depth in [2, 4, 6, 8, 12] {
                bounds_hold::<D>(200, depth);
            }
        }
        check::<2>();
        check::<3>();
        check::<4>();
    }

    /// The bound for the edges of a cube is what the proof allows.
    #[test]
    fn bounds_are_those_of_the_counted_roundings() {
        fn check<const D: usize>(numerator: f64, determinant: f64) {
            for size in [1.0, 8.0] {
                let edge = |i| std::array::from_fn(|k| if i == k { size } else { 0.0 });
                let center = circumcenter::<D, f64>(&std::array::from_fn(edge));
                let (length, diameter) = (D as f64 * size, (D as f64).sqrt() * size);
                let expected = UNIT * (numerator * length + (determinant + 2.0) * diameter);
                assert_eq!(center.twice, [size; D]);
                assert!((center.diameter / diameter - 1.0).abs() < 1e-15);
                assert!((center.error / expected - 1.0).abs() < 1e-14);
            }
        }
        check::<2>(8.0, 5.0);
        check::<3>(13.0, 12.0);
        check::<4>(26.0, 31.0);
        // 3% more than the roundings times the permanents of rows of length 1.
        let (two, six) = (2f64.sqrt(), 6f64.sqrt());
        let counted = [(7.0, 4.0), (12.0, 8.0 * two), (17.0 * two, 12.0 * six)];
        for (dim, (numerator, determinant)) in (2..).zip(counted) {
            assert!(NUMERATOR[dim] > 1.03 * numerator && DETERMINANT[dim] > 1.03 * determinant);
        }
    }

    /// Permanents of absolute values, of random rows of length 1 and of all ones, are within the
    /// bound.
    #[test]
    fn permanents_are_within_their_bound() {
        fn permanent(rows: &[Vec<f64>], used: u32) -> f64 {
            let Some((row, rest)) = rows.split_first() else { return 1.0 };
            let free = (0..row.len()).filter(|k| used >> k & 1 == 0);
            free.map(|k| row[k].abs() * permanent(rest, used | 1 << k)).sum()
        }
        let mut random = Random(8);
        // n! / n^(n/2) is the most (Carlen, Lieb, Loss 2006), of all ones; the proof allows sqrt((n
        // - 1)!).
        for (n, most, allowed) in
            [(2, 1.0, 1f64), (3, 6.0 / 27f64.sqrt(), 2f64.sqrt()), (4, 1.5, 6f64.sqrt())]
        {
            assert!(most <= allowed);
            for trial in 0..1000 {
                let mut entry = || if trial == 0 { 1.0 } else { random.unit() };
                let mut rows: Vec<Vec<f64>> =
                    (0..n).map(|_| (0..n).map(|_| entry()).collect()).collect();
                for row in &mut rows {
                    let length = row.iter().map(|x| x * x).sum::<f64>().sqrt();
                    row.iter_mut().for_each(|x| *x /= length);
                }
                let permanent = permanent(&rows, 0);
                assert!(permanent <= most * (1.0 + 1e-12));
                assert!(trial > 0 || permanent >= most * (1.0 - 1e-12));
            }
        }
    }

    #[test]
    fn flat_simplices_are_left_to_others() {
        // The volume is 1/sqrt(1 + t^2) of that of the box.
        for tangent in [3.0f64, 50.0, 1000.0] {
            let ratio = 1.0 + tangent * tangent;
            let found: Center<2> = circumcenter(&[[1.0, 0.0], [tangent, 1.0]]);
            assert!(found.is_usable(ratio.sqrt() * 1.001));
            assert!(!found.is_usable(ratio.sqrt() * 0.999));
        }
        assert!(!circumcenter(&[[1.0; 3], [2.0; 3], [3.0, 1.0, 1.0]]).is_usable(4096.0));
        assert!(!circumcenter(&[[0.0; 2], [1.0, 2.0]]).is_usable(4096.0));
    }

    #[test]
    fn lengths_out_of_range_are_left_to_others() {
        fn check<const D: usize>() {
            let cube = |exponents: [i32; D]| {
                let edge =
                    |i| std::array::from_fn(|k| if i == k { 2f64.powi(exponents[i]) } else { 0.0 });
                circumcenter::<D, f64>(&std::array::from_fn(edge)).is_usable(2.0)
            };
            let most = max_exponent(D);
            assert!(cube([most - 1; D]) && cube([-most; D]));
            assert!(!cube([most + 1; D]) && !cube([-most - 1; D]));
            let mut mixed = [most - 1; D];
            mixed[D - 1] = -most + 1;
            assert!(cube(mixed));
            mixed[0] = 1020;
            assert!(!cube(mixed));
            for wrong in [f64::INFINITY, f64::MAX, f64::NAN] {
                for (i, k) in [(0, 0), (0, 1), (D - 1, 0), (D - 1, D - 1)] {
                    let edge = |i| std::array::from_fn(|k| if i == k { 1.0 } else { 0.0 });
                    let mut edges: [[f64; D]; D] = std::array::from_fn(edge);
                    edges[i][k] = wrong;
                    assert!(!circumcenter(&edges).is_usable(4096.0));
                }
            }
        }
        check::<2>();
        check::<3>();
        check::<4>();
        // Every square is at least 2^-900 then.
        assert_eq!([max_exponent(2), max_exponent(3), max_exponent(4)], [150, 90, 64]);
    }
}
