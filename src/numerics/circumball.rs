//! The circumball of a simplex with a rigorous error bound: the filter of all conflict tests.

use super::exact::circumcenter_exact;
use super::length::{largest_magnitude, norm};
use super::power::{TINY, UNIT, biased_exponent, power_of_two, scale_by_power};
use super::solve::solve;

/// The circumball of a simplex, its centre relative to one of the vertices and scaled by a power
/// of two, so that tiny and huge simplices are told apart from their neighbours alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Circumball<const D: usize> {
    /// Index in the simplex of the vertex that `center` is relative to: an endpoint of the
    /// shortest edge in the sum norm (which is the Euclidean one within a factor sqrt(D)).
    pub anchor: u8,
    /// 2^-k, k in -1000..=1000: of scaled units, per real unit.
    pub scale: f64,
    /// (circumcentre - anchor point) * scale. The largest magnitude is in [1, 2) unless k had to be
    /// clamped.
    pub center: [f64; D],
    /// No component of `center` is further from the exact one than this, and it is at least 16
    /// units of roundoff of the largest component; infinite if the centre cannot be used.
    pub error: f64,
    /// The circumradius in real units, within 1e-8 relatively if `error` is finite; infinite if it
    /// exceeds `f64::MAX`.
    pub radius: f64,
}

/// A centre whose largest component is not known better than this, relatively, is recomputed in
/// integers.
const ACCEPTED: f64 = 1e-9;

/// The floor of `error` in terms of the largest component: pays for the roundings of
/// [`Circumball::side`].
const FLOOR: f64 = 16.0 * UNIT;

impl<const D: usize> Circumball<D> {
    /// The ball of a flat simplex, or of one with a radius out of range: decides nothing.
    pub const UNUSABLE: Self = Self {
        anchor: 0,
        scale: 1.0,
        center: [f64::NAN; D],
        error: f64::INFINITY,
        radius: f64::INFINITY,
    };

    /// The circumball of `D + 1` finite, affinely independent points. For flat simplices and those
    /// with a radius beyond 2^1030 the error and the radius are infinite and nothing is decided.
    ///
    /// No allocation and O(D^3) floating-point operations, except for nearly flat simplices and
    /// those at the ends of the exponent range, which cost microseconds.
    #[inline]
    pub fn new(points: &[&[f64; D]]) -> Self {
        const { assert!(D >= 2 && D <= 8) };
        let points = &points[..D + 1];
        let anchor = shortest_edge(points);
        match Self::in_floats(points, anchor) {
            Some(ball) => ball,
            None => Self::in_integers(points, anchor),
        }
    }

    /// The ball by floating-point arithmetic; `None` if that is too inaccurate.
    #[inline]
    fn in_floats(points: &[&[f64; D]], anchor: usize) -> Option<Self> {
        let mut rows = [[0.0; D]; D];
        let mut exponents = [0; D];
        for (r, row) in rows.iter_mut().enumerate() {
            let (p, origin) = (points[r + usize::from(r >= anchor)], points[anchor]);
            *row = std::array::from_fn(|i| p[i] - origin[i]);
            exponents[r] = biased_exponent(largest_magnitude(row));
        }
        let top = exponents.iter().fold(0, |m, e| m.max(*e));
        let bottom = exponents.iter().fold(2047, |m, e| m.min(*e));
        if bottom < 1 || top > 2045 || top - bottom > 900 {
            return None;
        }
        // 2 v.c = |v|^2 with v = row * 2^e and c = x * 2^top.
        let mut right = [0.0; D];
        for (r, row) in rows.iter_mut().enumerate() {
            let scale = power_of_two(1023 - exponents[r]);
            row.iter_mut().for_each(|x| *x *= scale);
            let square = row.iter().fold(0.0, |sum, x| sum + *x * *x);
            right[r] = square * power_of_two(exponents[r] - top - 1);
        }
        let (solution, error) = solve(&rows, &right);
        let size = largest_magnitude(&solution);
        let own = biased_exponent(size) - 1023;
        let k = own + top - 1023;
        // A NaN or an infinity anywhere fails one of the comparisons.
        let usable = error <= ACCEPTED * size && own.abs() <= 900 && k.abs() <= 1000;
        if !usable {
            return None;
        }
        let scale = power_of_two(-own);
        let center = solution.map(|x| x * scale);
        let square = center.iter().fold(0.0, |sum, x| sum + *x * *x);
        Some(Self {
            anchor: anchor as u8,
            scale: power_of_two(-k),
            center,
            error: (error.max(FLOOR * size)) * scale,
            radius: square.sqrt() * power_of_two(k),
        })
    }

    /// The ball from the exact rational centre.
    #[cold]
    #[inline(never)]
    fn in_integers(points: &[&[f64; D]], anchor: usize) -> Self {
        let Some(exact) = circumcenter_exact(points, anchor) else { return Self::UNUSABLE };
        if exact.exponent > 1030 {
            return Self::UNUSABLE;
        }
        let k = exact.exponent.clamp(-1000, 1000);
        let center = exact.center.map(|x| scale_by_power(x, exact.exponent - k));
        let size = largest_magnitude(&center);
        Self {
            anchor: anchor as u8,
            scale: power_of_two(-k as i32),
            center,
            error: FLOOR * size,
            radius: scale_by_power(norm(&exact.center), exact.exponent),
        }
    }

    /// Whether `q` is strictly inside the ball, as far as floating-point arithmetic with an error
    /// bound can tell: `Some(true)` strictly inside, `Some(false)` strictly outside, `None`
    /// undecided (ask [`in_ball`](super::in_ball)). `anchor_point` is the vertex that `anchor`
    /// names.
    ///
    /// With w = (q - anchor) * scale, inside is |w|^2 - 2 w.c < 0. All error terms are multiples of
    /// w, so points of a tiny cluster around the anchor are told apart even by a huge ball.
    #[inline]
    pub fn side(&self, anchor_point: &[f64; D], q: &[f64; D]) -> Option<bool> {
        let (mut square, mut product, mut sum) = (0.0, 0.0, 0.0);
        for i in 0..D {
            let w = (q[i] - anchor_point[i]) * self.scale;
            square += w * w;
            product += w * self.center[i];
            sum += w.abs();
        }
        let power = square - 2.0 * product;
        // Roundings: at most (D + 3)u |w|^2 and 2(D + 2)u |w|_1 |c|_max <= 1.25 error |w|_1, beside
        // the centre's own 2 error |w|_1; the constant pays for underflow. With overflow or an
        // unusable centre the bound is infinite or NaN and nothing is decided.
        let bound = 4.0 * self.error * sum + 16.0 * UNIT * square + TINY;
        if power > bound {
            Some(false)
        } else if power < -bound {
            Some(true)
        } else {
            self.is_far(anchor_point, q).then_some(false)
        }
    }

    /// Whether `q` is so far from the anchor that its square may have overflowed, which makes it
    /// an outside point: no usable scaled centre exceeds 2^31.
    #[cold]
    fn is_far(&self, anchor_point: &[f64; D], q: &[f64; D]) -> bool {
        const FAR: f64 = power_of_two(500);
        let is_far = |i: usize| ((q[i] - anchor_point[i]) * self.scale).abs() >= FAR;
        // Infinite differences of finite points are at least 2^1023: far unless the scale is tiny.
        self.error < 1.0 && self.scale > 1.0 / FAR && (0..D).any(is_far)
    }

    /// The circumcentre in real coordinates, rounded; not finite where it overflows or `error` is
    /// infinite, which the caller checks.
    #[inline]
    pub fn center_point(&self, anchor_point: &[f64; D]) -> [f64; D] {
        let real = 1.0 / self.scale;
        std::array::from_fn(|i| anchor_point[i] + self.center[i] * real)
    }
}

/// The first endpoint of the shortest edge in the sum norm, among lengths within 8 ulps the lowest.
/// The bits of positive doubles are ordered as they are: the index rides in the lowest three, and
/// the minimum needs no branch.
#[inline]
fn shortest_edge<const D: usize>(points: &[&[f64; D]]) -> usize {
    let mut shortest = u64::MAX;
    for i in 0..D {
        for j in i + 1..=D {
            let length = (0..D).fold(0.0, |sum, k| sum + (points[i][k] - points[j][k]).abs());
            shortest = shortest.min(length.to_bits() & !7 | i as u64);
        }
    }
    (shortest & 7) as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::*;
    use crate::numerics::{Sign, in_ball, orientation};

    /// A positively oriented simplex of the family, if this draw is not flat.
    fn simplex<const D: usize>(family: Family, random: &mut Random) -> Option<Vec<[f64; D]>> {
        let mut corners = points::<D>(family, D + 1, random);
        match orientation(&references(&corners)) {
            Sign::Positive => Some(corners),
            Sign::Negative => {
                corners.swap(0, 1);
                Some(corners)
            }
            Sign::Zero => None,
        }
    }

    /// Query points: of the family, a vertex moved by a few ulps, and a point almost on the sphere.
    fn queries<const D: usize>(
        family: Family,
        corners: &[[f64; D]],
        center: &[f64; D],
        random: &mut Random,
    ) -> Vec<[f64; D]> {
        let mut queries = points::<D>(family, 3, random);
        let corner = corners[random.integer(0, D as i64) as usize];
        queries.push(corner.map(|x| f64::from_bits(x.to_bits() ^ random.bits() & 3)));
        queries.push(corner.map(|x| x * (1.0 + random.unit() * 1e-9)));
        let turn = random.integer(0, D as i64 - 1) as usize;
        queries.push(std::array::from_fn(|i| {
            if i == turn { center[i] - (corner[i] - center[i]) } else { corner[i] }
        }));
        queries.retain(|q| q.iter().all(|x| x.is_finite()));
        queries
    }

    /// Compares decisions with exact signs; returns how many tests there were of a family, and how
    /// many of them the filter decided.
    fn decisions<const D: usize>(family: Family, trials: usize) -> (usize, usize) {
        let mut random = Random(family as u64 * 1000 + D as u64);
        let (mut tested, mut decided) = (0, 0);
        for _ in 0..trials {
            let Some(corners) = simplex::<D>(family, &mut random) else { continue };
            let simplex = references(&corners);
            let ball = Circumball::new(&simplex);
            let anchor = &corners[ball.anchor as usize];
            for q in queries(family, &corners, &ball.center_point(anchor), &mut random) {
                tested += 1;
                let Some(inside) = ball.side(anchor, &q) else { continue };
                decided += 1;
                let expected = if inside { Sign::Positive } else { Sign::Negative };
                assert_eq!(
                    in_ball(&simplex, &q),
                    expected,
                    "{family:?} {corners:?} {q:?} {ball:?}"
                );
            }
        }
        (tested, decided)
    }

    fn side_agrees_with_exact_signs<const D: usize>() {
        let mut total = 0;
        for family in FAMILIES {
            let (tested, decided) = decisions::<D>(family, 3600);
            total += tested;
            // The three queries of the family itself; those near the sphere may stay open.
            if matches!(family, Family::Uniform | Family::FarCluster | Family::MixedScales) {
                assert!(decided * 2 > tested, "{family:?} {decided} of {tested}");
            }
        }
        assert!(total >= 200_000, "{total}");
    }

    #[test]
    fn side_agrees_with_exact_signs_in_2d() {
        side_agrees_with_exact_signs::<2>();
    }

    #[test]
    fn side_agrees_with_exact_signs_in_3d() {
        side_agrees_with_exact_signs::<3>();
    }

    #[test]
    fn side_agrees_with_exact_signs_in_4d() {
        side_agrees_with_exact_signs::<4>();
    }

    #[test]
    fn side_agrees_with_exact_signs_in_5d() {
        side_agrees_with_exact_signs::<5>();
    }

    #[test]
    fn side_agrees_with_exact_signs_in_6d() {
        side_agrees_with_exact_signs::<6>();
    }

    fn error_bounds_hold<const D: usize>(trials: usize) {
        for family in FAMILIES {
            let mut random = Random(family as u64 * 1000 + 500 + D as u64);
            for _ in 0..trials {
                let Some(corners) = simplex::<D>(family, &mut random) else { continue };
                let simplex = references(&corners);
                let ball = Circumball::new(&simplex);
                if ball.error == f64::INFINITY {
                    assert_eq!(ball.radius, f64::INFINITY);
                    continue;
                }
                let size = largest_magnitude(&ball.center);
                assert!((16.0 * UNIT * size..=1e-9 * size).contains(&ball.error), "{ball:?}");
                let (numerators, denominator) = circumcenter_oracle(&simplex, ball.anchor as usize);
                let exponent = 1023 - i64::from(biased_exponent(ball.scale));
                for (value, numerator) in ball.center.iter().zip(&numerators) {
                    let quotient = (numerator, &denominator);
                    let close = is_close(*value, ball.error, exponent, quotient);
                    assert!(close, "{family:?} {corners:?} {ball:?}");
                }
                let length = scale_by_power(norm(&ball.center), exponent);
                let difference = (ball.radius - length).abs();
                assert!(ball.radius == length || difference <= 1e-15 * length, "{ball:?}");
            }
        }
    }

    #[test]
    fn centres_are_within_their_error_bounds() {
        error_bounds_hold::<2>(400);
        error_bounds_hold::<3>(300);
        error_bounds_hold::<4>(100);
        error_bounds_hold::<6>(10);
    }

    #[test]
    fn far_points_are_outside_and_limits_are_undecided() {
        let ball = Circumball::new(&[&[0.0, 0.0], &[1.0, 0.0], &[0.0, 1.0]]);
        let anchor = [0.0, 0.0];
        assert_eq!((ball.anchor, ball.radius), (0, 0.5f64.sqrt()));
        assert_eq!(ball.center_point(&anchor), [0.5, 0.5]);
        assert_eq!(ball.side(&anchor, &[1e200, 0.0]), Some(false));
        assert_eq!(ball.side(&anchor, &[-1e200, 0.0]), Some(false));
        assert_eq!(ball.side(&anchor, &[-f64::MAX, f64::MAX]), Some(false));
        assert_eq!(ball.side(&anchor, &[1.0, 1.0]), None);
        assert_eq!(ball.side(&anchor, &[1e-200, 1e-200]), Some(true));
        assert_eq!(ball.side(&anchor, &[1e-300, 1e-300]), None);
        let flat = Circumball::new(&[&[0.0, 0.0], &[1.0, 1.0], &[2.0, 2.0]]);
        assert!(flat.error == f64::INFINITY && flat.radius == f64::INFINITY);
        assert!(flat.center_point(&anchor)[0].is_nan());
        assert_eq!(flat.side(&anchor, &[5.0, 1.0]), None);
    }

    #[test]
    fn generic_simplices_need_no_integers() {
        fn check<const D: usize>() {
            let mut random = Random(D as u64);
            for _ in 0..100 {
                let corners = points::<D>(Family::Uniform, D + 1, &mut random);
                for scale in [1.0, 2f64.powi(-600), 2f64.powi(600)] {
                    let scaled: Vec<_> = corners.iter().map(|p| p.map(|x| x * scale)).collect();
                    let simplex = references(&scaled);
                    assert!(
                        (0..=D).all(|anchor| Circumball::in_floats(&simplex, anchor).is_some())
                    );
                }
            }
        }
        check::<2>();
        check::<3>();
        check::<5>();
        // An edge 2^850 times longer than another.
        let points = [[0.0, 0.0], [1.0, 0.0], [0.0, 2f64.powi(850)]];
        assert!(Circumball::in_floats(&references(&points), 0).is_some());
    }

    /// Centres that are wrong by all that `error` admits, and points that they are wrong about.
    #[test]
    fn what_the_error_leaves_open_is_undecided() {
        for sign in [1.0, -1.0] {
            for axis in 0..2 {
                let along = |x: f64| -> [f64; 2] {
                    std::array::from_fn(|k| if k == axis { sign * x } else { 0.0 })
                };
                let side = |error: f64, distance: f64| {
                    let center = along(1.0);
                    let ball = Circumball { anchor: 0, scale: 1.0, center, error, radius: 1.0 };
                    ball.side(&[0.0; 2], &along(distance))
                };
                let error = 2f64.powi(-20);
                // The true centre is at 1 - error or 1 + error: its sphere ends at twice that.
                for slip in [-1.9, 1.9] {
                    assert_eq!(side(error, 2.0 + slip * error), None);
                }
                assert_eq!(side(error, 2.0 - 9.0 * error), Some(true));
                assert_eq!(side(error, 2.0 + 9.0 * error), Some(false));
                // With the least error, what is allowed for roundings: 4 * 16 * 2 + 16 * 4 units.
                for slip in [-88.0, 88.0] {
                    assert_eq!(side(16.0 * UNIT, 2.0 + slip * UNIT), None);
                    assert!(side(16.0 * UNIT, 2.0 + 1.2 * slip * UNIT).is_some());
                }
            }
        }
    }

    #[test]
    fn the_anchor_is_on_the_shortest_edge() {
        fn check<const D: usize>() {
            let mut random = Random(D as u64);
            for _ in 0..200 {
                let corners = points::<D>(Family::Uniform, D + 1, &mut random);
                let length = |i: usize, j: usize| -> f64 {
                    (0..D).map(|k| (corners[i][k] - corners[j][k]).abs()).sum()
                };
                let edges = (0..D).flat_map(|i| (i + 1..=D).map(move |j| (i, j)));
                let shortest = edges.min_by(|a, b| length(a.0, a.1).total_cmp(&length(b.0, b.1)));
                let tiny: Vec<_> = corners.iter().map(|p| p.map(|x| x * 2f64.powi(-600))).collect();
                for corners in [&corners, &tiny] {
                    assert_eq!(shortest_edge(&references(corners)), shortest.expect("edges").0);
                }
            }
        }
        check::<2>();
        check::<3>();
        check::<8>();
    }

    #[test]
    fn scales_are_clamped_and_radii_limited() {
        let mut random = Random(3);
        for exponent in [-1015, -1005, -995, 995, 1005, 1015] {
            let scale = 2f64.powi(exponent);
            let corners = points::<2>(Family::Uniform, 3, &mut random);
            let unscaled = Circumball::new(&references(&corners));
            let scaled: Vec<_> = corners.iter().map(|p| p.map(|x| x * scale)).collect();
            let ball = Circumball::new(&references(&scaled));
            assert!((2f64.powi(-1000)..=2f64.powi(1000)).contains(&ball.scale));
            let expected = unscaled.radius * scale;
            assert!((ball.radius / expected - 1.0).abs() < 1e-8, "{exponent}");
        }
        // A radius of about 2^1500.
        let arc = [[0.0, 0.0], [2f64.powi(500), 0.0], [2f64.powi(501), 2f64.powi(-500)]];
        assert_eq!(Circumball::new(&references(&arc)).error, f64::INFINITY);
        // Of about 2^989, where the solution overflows in units of the longest edge, 2^-40.
        let (w, h) = (2f64.powi(-40), 2f64.powi(-1030) * 2f64.powi(-40));
        let ball = Circumball::new(&references(&[[0.0, 0.0], [w, h], [-w, h]]));
        assert!(ball.error < 1e-9 && (ball.radius / 2f64.powi(989) - 1.0).abs() < 1e-8);
    }

    #[test]
    fn huge_balls_at_the_end_of_the_range_are_sound() {
        let (a, b, c) = ([-f64::MAX, 0.0], [f64::MAX, 0.0], [0.0, f64::MAX]);
        let ball = Circumball::new(&[&a, &b, &c]);
        assert!((ball.radius / f64::MAX - 1.0).abs() < 1e-15);
        let anchor = [a, b, c][ball.anchor as usize];
        assert_eq!(ball.side(&anchor, &[0.0, -0.9 * f64::MAX]), Some(true));
        assert_ne!(ball.side(&anchor, &[f64::MAX, -f64::MAX]), Some(true));
    }
}
