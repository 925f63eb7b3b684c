//! Exact answers about points of the plane, in integers where doubles with a bound of their error
//! do not tell.

use crate::memory::{AllocResult, with_capacity};
use crate::quality::exact::{Integer, Number, Refusal, parts, unbounded};
use std::cmp::Ordering;

pub(super) type Point = [f64; 2];

/// Is less than zero where `c` is strictly inside the circle of which `a` and `b` are the ends of a
/// diameter: the sign of (a - c) . (b - c).
pub(super) fn side_of_diametral_circle(a: &Point, b: &Point, c: &Point) -> AllocResult<Ordering> {
    // Differences and products have a relative error of at most 3 roundings, and the sum one more,
    // but for what underflows.
    let product = |k: usize| (a[k] - c[k]) * (b[k] - c[k]);
    let (sum, magnitude) = (product(0) + product(1), product(0).abs() + product(1).abs());
    if magnitude.is_finite() && sum.abs() > 4.0 * f64::EPSILON * magnitude + 1e-300 {
        return Ok(if sum > 0.0 { Ordering::Greater } else { Ordering::Less });
    }
    in_integers(&[a[0], a[1], b[0], b[1], c[0], c[1]], circle::<i128>, circle::<Integer>)
}

fn circle<N: Number>(values: &[N]) -> Result<Ordering, Refusal> {
    let [ax, ay, bx, by, cx, cy] = values else { unreachable!("three points") };
    let x = ax.minus(cx)?.times(&bx.minus(cx)?)?;
    let y = ay.minus(cy)?.times(&by.minus(cy)?)?;
    Ok(x.plus(&y)?.sign())
}

/// Returns true if the line through `a` and `b` meets the box of these widths with its middle at
/// `p`: it does so if it does in each projection along an axis, since all edges of the box and of
/// its shadow along the line are along axes.
pub(super) fn meets<const D: usize>(
    a: &[f64; D],
    b: &[f64; D],
    p: &[f64; D],
    widths: [f64; D],
) -> AllocResult<bool> {
    for i in 0..D {
        for j in i + 1..D {
            let values = [a[i], a[j], b[i], b[j], p[i], p[j], widths[i], widths[j]];
            match in_doubles(values) {
                Some(true) => continue,
                Some(false) => return Ok(false),
                None => {}
            }
            if in_integers(&values, rectangle::<i128>, rectangle::<Integer>)? == Ordering::Greater {
                return Ok(false);
            }
        }
    }
    Ok(true)
}

/// Returns true if the line surely meets the rectangle, false if it surely does not, and `None` if
/// doubles do not tell.
fn in_doubles([ax, ay, bx, by, px, py, wx, wy]: [f64; 8]) -> Option<bool> {
    let (dx, dy, x, y) = (bx - ax, by - ay, px - ax, py - ay);
    let twice = 2.0 * (dx * y - dy * x).abs();
    let reach = dx.abs() * wy + dy.abs() * wx;
    // No term has a relative error of more than 4 roundings, but for what underflows.
    let error = 8.0 * f64::EPSILON * (2.0 * (dx * y).abs() + 2.0 * (dy * x).abs() + reach) + 1e-300;
    if !error.is_finite() || (twice - reach).abs() <= error {
        return None;
    }
    Some(twice < reach)
}

/// Returns the sign of 2 |(b - a) x (p - a)| - |b - a|_x w_y - |b - a|_y w_x: the line's distances
/// from two opposite corners of the rectangle have different signs if it is not positive.
fn rectangle<N: Number>(values: &[N]) -> Result<Ordering, Refusal> {
    let [ax, ay, bx, by, px, py, wx, wy] = values else { unreachable!("three points and widths") };
    let (dx, dy) = (bx.minus(ax)?, by.minus(ay)?);
    let cross = dx.times(&py.minus(ay)?)?.minus(&dy.times(&px.minus(ax)?)?)?;
    let reach = magnitude(&dx)?.times(wy)?.plus(&magnitude(&dy)?.times(wx)?)?;
    let distance = magnitude(&cross)?;
    Ok(distance.plus(&distance)?.minus(&reach)?.sign())
}

fn magnitude<N: Number>(number: &N) -> Result<N, Refusal> {
    let zero = N::shifted(0, 0)?;
    if number.sign() == Ordering::Less { zero.minus(number) } else { number.plus(&zero) }
}

/// Returns the answer of `narrow` or, where 128 bits do not suffice, of `wide`, about `values` in
/// units of the largest power of two that divides them all.
fn in_integers(
    values: &[f64],
    narrow: fn(&[i128]) -> Result<Ordering, Refusal>,
    wide: fn(&[Integer]) -> Result<Ordering, Refusal>,
) -> AllocResult<Ordering> {
    match integers(values).and_then(|values| narrow(&values)) {
        Err(Refusal::TooLarge) => {
            unbounded(integers(values).and_then(|values: Vec<Integer>| wide(&values)))
        }
        answer => unbounded(answer),
    }
}

fn integers<N: Number>(values: &[f64]) -> Result<Vec<N>, Refusal> {
    let exponents = values.iter().filter(|value| **value != 0.0).map(|&value| parts(value).1);
    let unit = exponents.min().unwrap_or(0);
    let mut integers = with_capacity(values.len())?;
    for &value in values {
        let (odd, exponent) = parts(value);
        integers.push(N::shifted(odd, if odd == 0 { 0 } else { (exponent - unit) as u32 })?);
    }
    Ok(integers)
}

/// Returns the gap between doubles of the magnitude of `x`.
pub(super) fn unit_in_last_place(x: f64) -> f64 {
    let magnitude = x.abs();
    match magnitude.next_up() {
        above if above.is_finite() => above - magnitude,
        _ => magnitude - magnitude.next_down(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Powers of two.
    const SCALES: [f64; 4] = [1.0, f64::MIN_POSITIVE, 5e-324, f64::from_bits(2042 << 52)];

    #[test]
    fn circles_are_told_exactly() {
        for scale in SCALES {
            let p = |x: f64, y: f64| [x * scale, y * scale];
            let side = |c| side_of_diametral_circle(&p(0.0, 0.0), &p(8.0, 6.0), &c).unwrap();
            assert_eq!(side(p(8.0, 0.0)), Ordering::Equal, "{scale}");
            assert_eq!(side(p(7.0, 1.0)), Ordering::Less, "{scale}");
            assert_eq!(side(p(9.0, 0.0)), Ordering::Greater, "{scale}");
        }
        let right = [8.0, 0.0f64.next_down()];
        let sides = [right, [8.0f64.next_down(), -0.0]]
            .map(|c| side_of_diametral_circle(&[0.0, 0.0], &[8.0, 6.0], &c).unwrap());
        assert_eq!(sides, [Ordering::Greater, Ordering::Less]);
    }

    #[test]
    fn rectangles_are_met_by_the_last_bit() {
        let (a, b) = ([0.0, 0.0], [3.0, 1.0]);
        let third = 1.0 / 3.0;
        // 1/3 is less than a third by a third of its unit.
        let unit = unit_in_last_place(third);
        let met = |width: f64| meets(&a, &b, &[1.0, third], [0.0, width]).unwrap();
        assert!(met(unit) && met(0.67 * unit) && !met(0.66 * unit));
        assert!(meets(&a, &b, &[1.0, third], [3.0 * 0.67 * unit, 0.0]).unwrap());
        assert!(!meets(&a, &b, &[1.0, third.next_up()], [0.0, unit]).unwrap());
        for scale in SCALES {
            let at = |x: f64, y: f64| [x * scale, y * scale];
            let (far, off) = (at(12.0, 4.0), at(6.0, 3.0));
            let met = |width: f64| meets(&a, &far, &off, [0.0, width * scale]).unwrap();
            assert!(met(2.0) && !met(1.0), "{scale}");
        }
    }

    #[test]
    fn units_in_the_last_place() {
        assert_eq!(unit_in_last_place(-1.0), f64::EPSILON);
        assert_eq!(unit_in_last_place(0.0), 5e-324);
        assert_eq!(unit_in_last_place(f64::MAX), 2f64.powi(971));
    }
}
