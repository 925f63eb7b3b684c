//! Segments: the ball that has one for its diameter, and the doubles nearest to points on it.

use super::Sign;
use super::exact::{Edges, crossing, scalar_product_exact};
use super::filters::{determinant_filtered, orientation};
use super::power::{biased_exponent, scale_by_power};

/// Magnitudes of products of differences that neither overflowed nor lost bits.
const SAFE: std::ops::Range<f64> = 1e-250..1e250;

/// Returns the side of the ball with the diameter from `a` to `b` that `q` is on: positive strictly
/// inside, zero on the sphere, negative strictly outside. By the theorem of Thales, `q` is inside
/// if it sees the diameter at an obtuse angle. Right for all finite points.
#[inline]
pub fn in_diametral_ball<const D: usize>(a: &[f64; D], b: &[f64; D], q: &[f64; D]) -> Sign {
    let (mut sum, mut size) = (0.0, 0.0);
    for k in 0..D {
        let product = (a[k] - q[k]) * (b[k] - q[k]);
        sum += product;
        size += product.abs();
    }
    // A product is within 3 units of roundoff, a sum of D terms adds D - 1.
    let error = (D + 3) as f64 * f64::EPSILON * size;
    match SAFE.contains(&size) && sum.abs() > error {
        true => Sign::of(-sum),
        false => scalar_product_exact(a, b, q).flip(),
    }
}

/// Magnitude, relative to the largest number of a sum, above which products keep all their bits.
const SMALL: f64 = f64::from_bits((1023 - 400) << 52);

/// Returns the doubles nearest to the coordinates of `a + fraction (b - a)`, for a fraction in \[0,
/// 1\].
pub fn point_between<const D: usize>(a: &[f64; D], b: &[f64; D], fraction: f64) -> [f64; D] {
    std::array::from_fn(|k| coordinate_between(a[k], b[k], fraction))
}

fn coordinate_between(a: f64, b: f64, fraction: f64) -> f64 {
    let exponent = i64::from(biased_exponent(a).max(biased_exponent(b)).max(1)) - 1023;
    let [from, to] = [a, b].map(|x| scale_by_power(x, -exponent));
    let has_room = |x: f64, scaled: f64| x == 0.0 || scaled.abs() > SMALL;
    if has_room(a, from) && has_room(b, to) && has_room(fraction, fraction) {
        let sum = sum_between(from, to, fraction);
        let x = scale_by_power(sum, exponent);
        // A subnormal would be rounded twice.
        if sum == 0.0 || x.is_normal() {
            return x;
        }
    }
    // Where the line from (a, 0) to (b, 1) is at that height.
    let level = [&[0.0, fraction], &[1.0, fraction]];
    crossing([[&[a, 0.0], &[b, 1.0]], level]).map_or(a, |[x, _]| x)
}

/// Returns the doubles nearest to the point of the line through `a` and `b` whose coordinate along
/// `axis` is `level`. On that axis `a` and `b` must differ.
pub fn point_at_level<const D: usize>([a, b]: [&[f64; D]; 2], axis: usize, level: f64) -> [f64; D] {
    std::array::from_fn(|k| match k == axis {
        true => level,
        false if a[k] == b[k] => a[k],
        false => {
            let line = [&[a[k], a[axis]], &[b[k], b[axis]]];
            let level = [&[0.0, level], &[1.0, level]];
            crossing([line, level]).map_or(a[k], |[x, _]| x)
        }
    })
}

/// Largest relative error of a determinant in floating point that [`offset_from_line`] accepts.
const ACCEPTED: f64 = 1e-13;

/// Returns the distance of `x` from the line through `a` and `b`, as the factor by which a
/// rectangle of half the widths `units` about `x` must grow to meet the line. Relative error at
/// most 1e-12; infinite beyond `f64::MAX`. The units must be positive, and `a` and `b` differ.
pub fn offset_from_line(a: &[f64; 2], b: &[f64; 2], x: &[f64; 2], units: [f64; 2]) -> f64 {
    // Inputs often are on a line exactly, and a sign is cheap.
    if orientation(&[a, b, x]) == Sign::Zero {
        return 0.0;
    }
    let (area, exponent) = determinant_filtered(&[a, b, x], ACCEPTED)
        .unwrap_or_else(|| Edges::new(a, [b, x].into_iter()).determinant_of_components());
    let products = [0, 1].map(|axis| {
        let way = b[axis] - a[axis];
        let (way, doublings) =
            if way.is_finite() { (way, 0) } else { (0.5 * b[axis] - 0.5 * a[axis], 1) };
        let ((way, first), (unit, second)) = (normalized(way), normalized(units[1 - axis]));
        (way.abs() * unit, first + second + doublings)
    });
    let top = products[0].1.max(products[1].1);
    let reach: f64 = products.iter().map(|&(m, e)| scale_by_power(m, e - top)).sum();
    scale_by_power(area.abs() / reach, exponent - top)
}

/// Returns `(m, e)` with `value = m * 2^e`, where |m| is in [1, 2) for a normal number.
fn normalized(value: f64) -> (f64, i64) {
    let exponent = i64::from(biased_exponent(value).max(1)) - 1023;
    (scale_by_power(value, -exponent), exponent)
}

/// Returns the sum of `a`, and of `fraction` times the two parts of `b - a`, rounded once: all its
/// bits are in five numbers without a common one, by rising magnitude (J. R. Shewchuk, "Adaptive
/// Precision Floating-Point Arithmetic", 1997, theorem 10).
fn sum_between(a: f64, b: f64, fraction: f64) -> f64 {
    let (difference, rest) = sum_of(b, -a);
    let (high, low) = product_of(fraction, difference);
    let (rest_high, rest_low) = product_of(fraction, rest);
    let mut parts = [0.0; 5];
    for (count, term) in [rest_low, rest_high, low, high, a].into_iter().enumerate() {
        let mut carried = term;
        for part in &mut parts[..count] {
            (carried, *part) = sum_of(carried, *part);
        }
        parts[count] = carried;
    }
    rounded(parts)
}

/// Returns the double nearest to the sum of numbers without a common bit, by rising magnitude.
fn rounded(parts: [f64; 5]) -> f64 {
    let mut from_largest = parts.into_iter().rev();
    let (mut sum, mut lacking) = (0.0, 0.0);
    for part in from_largest.by_ref() {
        (sum, lacking) = sum_of(sum, part);
        if lacking != 0.0 {
            break;
        }
    }
    // The rest is less than any bit of these two: it tells only where the sum was a tie, which
    // went to the even double.
    let below = from_largest.find(|&part| part != 0.0).unwrap_or(0.0);
    let next = sum + 2.0 * lacking;
    let is_tie = next - sum == 2.0 * lacking;
    if is_tie && below * lacking.signum() > 0.0 { next } else { sum }
}

/// Returns the rounded sum and its rounding error.
fn sum_of(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

/// Returns the rounded product and its rounding error.
fn product_of(a: f64, b: f64) -> (f64, f64) {
    let halves = |x: f64| {
        let shifted = 134_217_729.0 * x;
        let high = shifted - (shifted - x);
        (high, x - high)
    };
    let (product, (a_high, a_low), (b_high, b_low)) = (a * b, halves(a), halves(b));
    (product, (a_high * b_high - product + a_high * b_low + a_low * b_high) + a_low * b_low)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::{FAMILIES, Random, points};
    use dashu_int::IBig;

    /// Returns a coordinate in units of 2^-1200, of which all coordinates are multiples after a
    /// division.
    fn whole(value: f64) -> IBig {
        let (mantissa, exponent) = crate::numerics::power::decompose(value);
        if mantissa == 0 { IBig::ZERO } else { IBig::from(mantissa) << (exponent + 1200) as usize }
    }

    #[test]
    fn diametral_balls_hold_what_sees_the_diameter_at_an_obtuse_angle() {
        for family in FAMILIES {
            let mut random = Random(family as u64);
            for _ in 0..500 {
                let p = points::<2>(family, 3, &mut random);
                let edge = |k: usize, end: &[f64; 2]| whole(end[k]) - whole(p[2][k]);
                let product: IBig = (0..2).map(|k| edge(k, &p[0]) * edge(k, &p[1])).sum();
                let expected = match product.cmp(&IBig::ZERO) {
                    std::cmp::Ordering::Less => Sign::Positive,
                    std::cmp::Ordering::Equal => Sign::Zero,
                    std::cmp::Ordering::Greater => Sign::Negative,
                };
                assert_eq!(in_diametral_ball(&p[0], &p[1], &p[2]), expected, "{p:?}");
            }
        }
        let right_angle = in_diametral_ball(&[0.0, 0.0], &[3.0, 4.0], &[0.0, 4.0]);
        assert_eq!(right_angle, Sign::Zero);
    }

    #[test]
    fn offsets_from_lines_are_those_of_integers() {
        for family in FAMILIES {
            let mut random = Random(300 + family as u64);
            for _ in 0..300 {
                let p = points::<2>(family, 3, &mut random);
                if p[0] == p[1] {
                    continue;
                }
                let units = [0, 1].map(|k| {
                    let largest = p[0][k].abs().max(p[1][k].abs());
                    largest - largest.next_down().max(0.0) + f64::from_bits(1)
                });
                let offset = offset_from_line(&p[0], &p[1], &p[2], units);
                if offset.is_infinite() {
                    continue;
                }
                let way = |q: usize, k: usize| whole(p[q][k]) - whole(p[0][k]);
                let size = |x: IBig| if x < IBig::ZERO { -x } else { x };
                let area = size(way(1, 0) * way(2, 1) - way(1, 1) * way(2, 0));
                let reach = size(way(1, 0)) * whole(units[1]) + size(way(1, 1)) * whole(units[0]);
                // In units of 2^-60, which 1e-12 is many of.
                let exact: IBig = (area << 60) / reach;
                let found = whole(offset) >> 1140;
                assert!(size(&found - &exact) <= (exact >> 39) + 1, "{family:?} {p:?} {offset}");
            }
        }
    }

    /// Points on segments are the nearest doubles: neighbouring ones are not nearer to the exact
    /// point, which is in units of 2^-2400.
    #[test]
    fn points_of_segments_are_rounded_once() {
        for family in FAMILIES {
            let mut random = Random(100 + family as u64);
            for _ in 0..300 {
                let [a, b] = points::<2>(family, 2, &mut random)[..] else { unreachable!() };
                let part = random.integer(0, 1 << 53) as f64 / (1u64 << 53) as f64;
                // The other half of them near the first end.
                let exponent = random.integer(-1000, 0).min(random.integer(-1000, 1000)) as i32;
                let fraction = part * 2f64.powi(if exponent % 2 == 0 { 0 } else { exponent });
                let exact = |k: usize| {
                    let (from, to, t) = (whole(a[k]), whole(b[k]), whole(fraction));
                    (from.clone() << 1200) + t * (to - from)
                };
                for (k, x) in point_between(&a, &b, fraction).into_iter().enumerate() {
                    let off = |x: f64| {
                        let difference = (whole(x) << 1200) - exact(k);
                        if difference < IBig::ZERO { -difference } else { difference }
                    };
                    let least = off(x);
                    for other in [x.next_up(), x.next_down()].into_iter().filter(|x| x.is_finite())
                    {
                        assert!(least <= off(other), "{family:?} {a:?} {b:?} {fraction} {k}");
                    }
                }
            }
        }
    }

    /// Ties of the largest part of the sum go to the even double unless the smaller parts say
    /// otherwise: products of fractions that are rounded nearly are powers of two.
    #[test]
    fn a_tie_is_no_tie_if_there_is_more() {
        let third = 2f64.powi(-52) / 3.0;
        let odd = 3.0 + 2f64.powi(-51);
        for sign in [1.0, -1.0] {
            // The nearest doubles to odd - 2^-52 (1 - 2^-54), and to what is beyond the tie.
            let end = odd - 3.0;
            assert_eq!(point_between(&[sign * odd], &[sign * end], third), [sign * odd]);
            let above = third.next_up();
            assert_eq!(point_between(&[sign * odd], &[sign * end], above), [sign * 3.0]);
            // An even double keeps the tie, and gives way beyond it.
            assert_eq!(point_between(&[sign * 3.0], &[0.0], third), [sign * 3.0]);
            let below = 3.0 - 2f64.powi(-51);
            assert_eq!(point_between(&[sign * 3.0], &[0.0], above), [sign * below]);
        }
    }

    #[test]
    fn ends_and_middles_are_exact() {
        let (a, b) = ([1.0, -f64::MAX], [3.0, f64::MAX]);
        assert_eq!(point_between(&a, &b, 0.0), a);
        assert_eq!(point_between(&a, &b, 1.0), b);
        assert_eq!(point_between(&a, &b, 0.5), [2.0, 0.0]);
        let tiny = f64::from_bits(2);
        assert_eq!(point_between(&[0.0, 0.0], &[tiny, 1.0], 0.5), [f64::from_bits(1), 0.5]);
    }
}
