//! Signs and areas in the plane, as integers in units of a power of two: every double is one.

use dashu_int::IBig;

pub type Point = [f64; 2];

/// A double as an odd integer or 0, and the power of two that it is multiplied by.
fn parts(x: f64) -> (i64, i32) {
    let bits = x.to_bits();
    let (biased, fraction) = ((bits >> 52 & 0x7ff) as i32, (bits & ((1 << 52) - 1)) as i64);
    let mantissa = if biased == 0 { fraction } else { fraction | 1 << 52 };
    if mantissa == 0 {
        return (0, 0);
    }
    let zeros = mantissa.trailing_zeros();
    let odd = mantissa >> zeros;
    (if bits >> 63 == 1 { -odd } else { odd }, biased.max(1) - 1075 + zeros as i32)
}

/// The largest power of two that divides all coordinates.
pub fn unit<'a>(points: impl IntoIterator<Item = &'a Point>) -> i32 {
    let values = points.into_iter().flatten().filter(|&&x| x != 0.0);
    values.map(|&x| parts(x).1).min().unwrap_or(0)
}

pub fn in_units(x: f64, unit: i32) -> IBig {
    let (odd, exponent) = parts(x);
    if odd == 0 { IBig::ZERO } else { IBig::from(odd) << (exponent - unit) as usize }
}

/// Points as integers in a unit of their own.
fn integers<const N: usize>(points: [&Point; N]) -> [[IBig; 2]; N] {
    let unit = unit(points);
    points.map(|point| point.map(|x| in_units(x, unit)))
}

fn minus(a: &[IBig; 2], b: &[IBig; 2]) -> [IBig; 2] {
    [&a[0] - &b[0], &a[1] - &b[1]]
}

fn cross(a: &[IBig; 2], b: &[IBig; 2]) -> IBig {
    &a[0] * &b[1] - &a[1] * &b[0]
}

fn dot(a: &[IBig; 2], b: &[IBig; 2]) -> IBig {
    &a[0] * &b[0] + &a[1] * &b[1]
}

fn sign(x: &IBig) -> i32 {
    i32::from(*x > IBig::ZERO) - i32::from(*x < IBig::ZERO)
}

/// 1 if `c` is on the left of the way from `a` to `b`.
pub fn turn(a: &Point, b: &Point, c: &Point) -> i32 {
    let [a, b, c] = integers([a, b, c]);
    sign(&cross(&minus(&b, &a), &minus(&c, &a)))
}

/// The sign of (b - a) . (c - a).
pub fn way(a: &Point, b: &Point, c: &Point) -> i32 {
    let [a, b, c] = integers([a, b, c]);
    sign(&dot(&minus(&b, &a), &minus(&c, &a)))
}

/// 1 if `d` is in the circle through `a`, `b` and `c`, which turn to the left.
pub fn in_circle(a: &Point, b: &Point, c: &Point, d: &Point) -> i32 {
    let [a, b, c, d] = integers([a, b, c, d]);
    let [a, b, c] = [&a, &b, &c].map(|p| minus(p, &d));
    let [aa, bb, cc] = [&a, &b, &c].map(|p| dot(p, p));
    sign(&(aa * cross(&b, &c) + bb * cross(&c, &a) + cc * cross(&a, &b)))
}

/// Returns true if the line through `a` and `b` meets the rectangle with its middle at `p` that
/// reaches `half` from there on each axis.
pub fn meets(a: &Point, b: &Point, p: &Point, half: Point) -> bool {
    let [a, b, p, half] = integers([a, b, p, &half]);
    let corner = |x: i32, y: i32| [&p[0] + &half[0] * x, &p[1] + &half[1] * y];
    let side = |corner: [IBig; 2]| sign(&cross(&minus(&b, &a), &minus(&corner, &a)));
    let sides =
        [side(corner(1, 1)), side(corner(1, -1)), side(corner(-1, 1)), side(corner(-1, -1))];
    sides.iter().min() <= Some(&0) && sides.iter().max() >= Some(&0)
}

/// Twice the area of a polygon, in squares of the unit.
pub fn doubled_area(points: &[Point], unit: i32) -> IBig {
    let points: Vec<[IBig; 2]> = points.iter().map(|p| p.map(|x| in_units(x, unit))).collect();
    (0..points.len()).map(|i| cross(&points[i], &points[(i + 1) % points.len()])).sum()
}

/// Half the gap between `x` and the next double away from 0, exactly where that is one.
pub fn half_gap(x: f64) -> f64 {
    (0.5 * (x.abs().next_up() - x.abs())).max(f64::from_bits(1))
}
