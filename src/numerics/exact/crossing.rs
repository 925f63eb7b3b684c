//! The crossing of two lines of the plane, rounded once.

use super::natural::{Natural, Quotient, quotient};
use crate::numerics::power::{decompose, scale_by_power, unit_and_span};
use std::cmp::Ordering;

/// Number of words of a numerator: with coordinates below 2^2098 units it is below 2^6301.
const LIMBS: usize = 100;

/// Number of words of a numerator times a denominator, which is below 2^4201.
const LIMBS_OF_PRODUCTS: usize = 165;

/// Integer with a sign.
#[derive(Clone)]
struct Whole<const N: usize> {
    is_negative: bool,
    magnitude: Natural<N>,
}

impl<const N: usize> Whole<N> {
    /// Returns `value / 2^unit`, which must be an integer.
    fn new(value: f64, unit: i32) -> Self {
        let (mantissa, exponent) = decompose(value);
        let shift = if mantissa == 0 { 0 } else { (exponent - unit) as usize };
        let magnitude = Natural::shifted(mantissa.unsigned_abs(), shift);
        Self { is_negative: mantissa < 0, magnitude }
    }

    fn times(&self, other: &Self) -> Self {
        let is_negative = self.is_negative != other.is_negative;
        Self { is_negative, magnitude: self.magnitude.times(&other.magnitude) }
    }

    fn plus(mut self, mut other: Self) -> Self {
        if self.is_negative == other.is_negative {
            self.magnitude.add(&other.magnitude);
            return self;
        }
        if self.magnitude.is_at_least(&other.magnitude) {
            self.magnitude.subtract(&other.magnitude);
            return self;
        }
        other.magnitude.subtract(&self.magnitude);
        other
    }

    fn minus(self, mut other: Self) -> Self {
        other.is_negative = !other.is_negative;
        self.plus(other)
    }

    /// Returns the order of the integer and zero.
    fn order(&self) -> Ordering {
        match (self.magnitude.is_zero(), self.is_negative) {
            (true, _) => Ordering::Equal,
            (false, true) => Ordering::Less,
            (false, false) => Ordering::Greater,
        }
    }
}

/// Point where two lines cross: numerators and a positive denominator, in units of 2^unit.
struct Quotients<const N: usize> {
    tops: [Whole<N>; 2],
    bottom: Natural<N>,
}

/// Two lines, each given by two points.
pub(crate) type Lines<'a> = [[&'a [f64; 2]; 2]; 2];

impl<const N: usize> Quotients<N> {
    /// Returns the point where two lines cross; `None` for parallel lines.
    fn new([a, b]: Lines, unit: i32) -> Option<Self> {
        let vector = |to: &[f64; 2], from: &[f64; 2]| {
            [0, 1].map(|axis| Whole::new(to[axis], unit).minus(Whole::new(from[axis], unit)))
        };
        let [along, across, between] = [vector(a[1], a[0]), vector(b[1], b[0]), vector(b[0], a[0])];
        let determinant =
            |a: &[Whole<N>; 2], b: &[Whole<N>; 2]| a[0].times(&b[1]).minus(a[1].times(&b[0]));
        let bottom = determinant(&along, &across);
        if bottom.magnitude.is_zero() {
            return None;
        }
        // a0 + along * t with t the quotient of these.
        let share = determinant(&between, &across);
        let tops = [0, 1].map(|axis| {
            let start = Whole::new(a[0][axis], unit).times(&bottom);
            let mut top = start.plus(along[axis].times(&share));
            top.is_negative ^= bottom.is_negative;
            top
        });
        Some(Self { tops, bottom: bottom.magnitude })
    }
}

fn unit<'a>(points: impl Iterator<Item = &'a [f64; 2]>) -> i32 {
    unit_and_span(points.flatten()).map_or(0, |(unit, _)| unit)
}

/// Returns the point where two lines cross, with each coordinate the double nearest to the exact
/// one, and the even double if two are equally near; `None` for parallel lines. A zero is positive.
///
/// O(b^2) for coordinates that span b bits (at most 2098).
pub(crate) fn crossing(lines: Lines) -> Option<[f64; 2]> {
    let unit = unit(lines.into_iter().flatten());
    let Quotients { tops, bottom } = Quotients::<LIMBS>::new(lines, unit)?;
    Some(tops.map(|Whole { is_negative, magnitude }| {
        let size = nearest(magnitude, bottom.clone(), unit);
        if is_negative && size != 0.0 { -size } else { size }
    }))
}

/// Compares an exact coordinate of a crossing to a number.
///
/// # Panics
/// If the lines are parallel.
pub(crate) fn compare_to_crossing(lines: Lines, axis: usize, number: f64) -> Ordering {
    let point = [number; 2];
    let unit = unit(lines.into_iter().flatten().chain([&point]));
    let Quotients { tops, bottom } = Quotients::<LIMBS>::new(lines, unit).expect("a crossing");
    let other = Whole::new(number, unit);
    let other = Whole { is_negative: other.is_negative, magnitude: other.magnitude.times(&bottom) };
    tops[axis].clone().minus(other).order()
}

/// Compares an exact coordinate of two crossings.
///
/// # Panics
/// If lines are parallel.
pub(crate) fn compare_crossings(a: Lines, b: Lines, axis: usize) -> Ordering {
    let unit = unit([a, b].into_iter().flatten().flatten());
    let [a, b] = [a, b].map(|lines| Quotients::<LIMBS_OF_PRODUCTS>::new(lines, unit));
    let (a, b) = (a.expect("a crossing"), b.expect("a crossing"));
    let scaled = |top: &Whole<LIMBS_OF_PRODUCTS>, bottom| {
        let magnitude = top.magnitude.times(bottom);
        Whole { is_negative: top.is_negative, magnitude }
    };
    scaled(&a.tops[axis], &b.bottom).minus(scaled(&b.tops[axis], &a.bottom)).order()
}

/// Returns the double nearest to `top / bottom * 2^unit`; infinity if that is too large.
fn nearest(top: Natural<LIMBS>, bottom: Natural<LIMBS>, unit: i32) -> f64 {
    if top.is_zero() {
        return 0.0;
    }
    let Quotient { value, shift, is_exact } = quotient(top, bottom);
    // The exponent of the quotient's lowest bit, and how many of the bits a double does not have.
    let lowest = i64::from(unit) - shift;
    let bits = 128 - i64::from(value.leading_zeros());
    let dropped = (bits - 53).max(-1074 - lowest);
    if dropped > bits {
        return 0.0;
    }
    // Doubled, with a last bit that says whether anything is beyond: no tie is a false one.
    let doubled = value << 1 | u128::from(!is_exact);
    let kept = doubled >> (dropped + 1);
    let rest = doubled & ((1 << (dropped + 1)) - 1);
    let half = 1 << dropped;
    let is_up = rest > half || rest == half && kept & 1 == 1;
    scale_by_power((kept + u128::from(is_up)) as f64, lowest + dropped)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::{FAMILIES, Random, integer, points};
    use dashu_int::IBig;

    fn lines(p: &[[f64; 2]]) -> Lines<'_> {
        [[&p[0], &p[1]], [&p[2], &p[3]]]
    }

    /// Returns the exact coordinate in units of 2^-1074, as numerator and positive denominator.
    fn oracle(p: &[[f64; 2]], axis: usize) -> Option<(IBig, IBig)> {
        let [a0, a1, b0, b1] = [0, 1, 2, 3].map(|i| p[i].map(integer));
        let cross = |a: &[IBig; 2], b: &[IBig; 2]| &a[0] * &b[1] - &a[1] * &b[0];
        let line = |p: &[IBig; 2], q: &[IBig; 2]| [&p[1] - &q[1], &q[0] - &p[0], cross(p, q)];
        let (l, m) = (line(&a0, &a1), line(&b0, &b1));
        let bottom = &l[0] * &m[1] - &l[1] * &m[0];
        let top = match axis {
            0 => &l[1] * &m[2] - &l[2] * &m[1],
            _ => &l[2] * &m[0] - &l[0] * &m[2],
        };
        match bottom.cmp(&IBig::ZERO) {
            std::cmp::Ordering::Equal => None,
            std::cmp::Ordering::Less => Some((-top, -bottom)),
            std::cmp::Ordering::Greater => Some((top, bottom)),
        }
    }

    fn magnitude(value: IBig) -> IBig {
        if value < IBig::ZERO { -value } else { value }
    }

    /// Returns true if no neighbouring double is nearer, and `value` is even if one is equally
    /// near.
    fn is_nearest(value: f64, top: &IBig, bottom: &IBig) -> bool {
        let away = |x: f64| magnitude(integer(x) * bottom - top);
        let own = away(value);
        [value.next_up(), value.next_down()].iter().filter(|x| x.is_finite()).all(|&x| {
            let other = away(x);
            own < other || own == other && value.to_bits() & 1 == 0
        })
    }

    #[test]
    fn crossings_are_nearest_to_the_exact_ones() {
        let mut checked = 0;
        for family in FAMILIES {
            let mut random = Random(family as u64 + 900);
            for _ in 0..200 {
                let p = points::<2>(family, 4, &mut random);
                let found = crossing(lines(&p));
                for axis in 0..2 {
                    let Some((top, bottom)) = oracle(&p, axis) else {
                        assert_eq!(found, None, "{p:?}");
                        continue;
                    };
                    let value = found.unwrap()[axis];
                    let limit = (integer(f64::MAX) + (IBig::ONE << 2044)) * &bottom;
                    if magnitude(top.clone()) >= limit {
                        assert!(value.is_infinite());
                    } else {
                        assert!(is_nearest(value, &top, &bottom), "{family:?} {p:?} {value:e}");
                        checked += 1;
                    }
                }
            }
        }
        assert!(checked > 3000, "{checked}");
    }

    #[test]
    fn ties_go_to_the_even_double() {
        let (ulp, level) = (f64::EPSILON, [&[0.0, 1.0], &[4.0, 1.0]]);
        for k in 0..4 {
            let x = 1.0 + f64::from(k) * ulp;
            // From (x, 0) to (x + ulp, 2): at height 1 it is between the doubles x and x + ulp.
            let found = crossing([[&[x, 0.0], &[x + ulp, 2.0]], level]).unwrap();
            let even = if k % 2 == 0 { x } else { x + ulp };
            assert_eq!(found, [even, 1.0]);
            let tiny = f64::from_bits(k as u64);
            let next = tiny.next_up();
            let found = crossing([[&[tiny, 0.0], &[next, 2.0]], level]).unwrap();
            assert_eq!(found[0], if k % 2 == 0 { tiny } else { next });
        }
    }

    /// Crossings are rounded once: at height 1/2 + 2^-55, on a line from 0 to the least double, a
    /// crossing is just above the tie that rounding to 53 bits first would make of it.
    #[test]
    fn subnormal_coordinates_are_rounded_once() {
        let least = f64::from_bits(1);
        let steep = [&[0.0, 0.0], &[least, 1.0]];
        let crossing = |y: f64| crossing([steep, [&[-1.0, 0.5], &[3.0, y]]]).unwrap();
        assert_eq!(crossing(0.5 + f64::EPSILON / 2.0), [least, 0.5]);
        // And just below both ties.
        assert_eq!(crossing(0.5 - f64::EPSILON / 2.0), [0.0, 0.5f64.next_down()]);
    }

    #[test]
    fn exact_coordinates_are_ordered() {
        let mut seen = [0; 3];
        for family in FAMILIES {
            let mut random = Random(family as u64 + 950);
            for _ in 0..50 {
                let p = points::<2>(family, 8, &mut random);
                // Often the same crossing, by other lines.
                let other = if random.bits() & 1 == 0 {
                    [p[1], p[0], p[3], p[2]]
                } else {
                    [p[4], p[5], p[6], p[7]]
                };
                for axis in 0..2 {
                    let (Some((a, below_a)), Some((b, below_b))) =
                        (oracle(&p, axis), oracle(&other, axis))
                    else {
                        continue;
                    };
                    let order = (&a * &below_b).cmp(&(&b * &below_a));
                    seen[(order as i8 + 1) as usize] += 1;
                    assert_eq!(compare_crossings(lines(&p), lines(&other), axis), order, "{p:?}");
                    let near = crossing(lines(&p)).unwrap()[axis];
                    for number in [near, other[0][axis]].into_iter().filter(|x| x.is_finite()) {
                        let order = a.cmp(&(integer(number) * &below_a));
                        assert_eq!(compare_to_crossing(lines(&p), axis, number), order, "{p:?}");
                    }
                }
            }
        }
        assert!(seen.iter().all(|&count| count > 150), "{seen:?}");
    }
}
