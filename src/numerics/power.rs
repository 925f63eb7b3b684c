//! Powers of two: scaling without rounding.

/// Unit roundoff of f64, 2^-53: a rounded result is the exact one times (1 + d), |d| <= u.
pub(super) const UNIT: f64 = f64::EPSILON / 2.0;

/// Allowance for gradual underflow, which loses at most 2^-1075 an operation, in expressions whose
/// other factors are at most a few thousand.
pub(super) const TINY: f64 = 1e-290;

/// Returns the exponent field of `value`, 0 (zero and subnormals) to 2047 (infinities and NaN).
#[inline]
pub(super) fn biased_exponent(value: f64) -> i32 {
    ((value.to_bits() >> 52) & 0x7ff) as i32
}

/// Returns 2^`exponent`, for -1022 to 1023.
#[inline]
pub(super) const fn power_of_two(exponent: i32) -> f64 {
    debug_assert!(-1022 <= exponent && exponent <= 1023);
    f64::from_bits(((exponent + 1023) as u64) << 52)
}

/// Returns `value * 2^exponent` for any exponent, rounded; within 2^-1074 where the result is
/// subnormal.
pub(crate) fn scale_by_power(value: f64, exponent: i64) -> f64 {
    // Finite doubles span 2^-1074 to 2^1024: beyond 2200 every nonzero value is over or under.
    let mut left = exponent.clamp(-2200, 2200) as i32;
    let mut scaled = value;
    while left != 0 {
        let step = left.clamp(-1000, 1000);
        scaled *= power_of_two(step);
        left -= step;
    }
    scaled
}

/// Returns `(m, e)` with `value = m * 2^e` and m odd; `(0, i32::MAX)` for zero.
pub(super) fn decompose(value: f64) -> (i64, i32) {
    if value == 0.0 {
        return (0, i32::MAX);
    }
    let field = biased_exponent(value);
    debug_assert!(field < 2047, "coordinates are finite");
    let fraction = (value.to_bits() & ((1 << 52) - 1)) as i64;
    let mantissa = if field == 0 { fraction } else { fraction | 1 << 52 };
    let zeros = mantissa.trailing_zeros();
    let odd = mantissa >> zeros;
    let exponent = field.max(1) - 1075 + zeros as i32;
    (if value < 0.0 { -odd } else { odd }, exponent)
}

/// Returns the exponent of the largest power of two that divides all coordinates, and the least
/// span such that they are smaller than 2^(unit + span); `None` if all are zero.
pub(super) fn unit_and_span<'a>(
    coordinates: impl Iterator<Item = &'a f64>,
) -> Option<(i32, usize)> {
    let (mut unit, mut top) = (i32::MAX, i32::MIN);
    for &x in coordinates {
        let (mantissa, exponent) = decompose(x);
        if mantissa != 0 {
            unit = unit.min(exponent);
            top = top.max(exponent + mantissa.unsigned_abs().ilog2() as i32 + 1);
        }
    }
    (unit <= top).then(|| (unit, (top - unit) as usize))
}

/// Returns the number of bits that a sum of `count` numbers may have more than the largest of them.
pub(super) fn bits_of(count: usize) -> usize {
    count.next_power_of_two().ilog2() as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decomposition_gives_the_value_back() {
        for value in [1.0, -0.75, 5e-324, -f64::MIN_POSITIVE / 3.0, f64::MAX, 1e-310, 3e200] {
            let (mantissa, exponent) = decompose(value);
            assert_eq!(mantissa & 1, 1);
            assert_eq!(scale_by_power(mantissa as f64, exponent as i64), value);
        }
        assert_eq!([decompose(0.0), decompose(-0.0)], [(0, i32::MAX); 2]);
        assert_eq!(decompose(-0.75), (-3, -2));
        assert_eq!(decompose(1.0 + f64::EPSILON), ((1 << 52) + 1, -52));
        assert_eq!(decompose(f64::from_bits(6)), (3, -1073));
    }

    #[test]
    fn spans_reach_from_the_last_bit_to_the_first() {
        let span = |coordinates: &[f64]| unit_and_span(coordinates.iter());
        assert_eq!(span(&[0.0, -0.0]), None);
        assert_eq!(span(&[6.0, 0.0]), Some((1, 2)));
        assert_eq!(span(&[-0.75, 4.0]), Some((-2, 5)));
        assert_eq!(span(&[f64::MAX, f64::from_bits(1)]), Some((-1074, 2098)));
        assert_eq!([1, 2, 3, 4, 5].map(bits_of), [0, 1, 2, 2, 3]);
    }

    #[test]
    fn the_unit_is_the_largest_that_rounds_away() {
        assert_eq!(1.0 + UNIT, 1.0);
        assert_eq!(1.0 + UNIT.next_up(), 1.0 + f64::EPSILON);
    }

    #[test]
    fn scaling_saturates() {
        assert_eq!(scale_by_power(5e-324, 2097), 2f64.powi(1023));
        assert_eq!(scale_by_power(1.0, i64::MAX), f64::INFINITY);
        assert_eq!(scale_by_power(-1.0, i64::MIN), 0.0);
        assert_eq!(scale_by_power(3.0, -1074), 1.5e-323);
        assert_eq!((power_of_two(-1022), power_of_two(1023)), (f64::MIN_POSITIVE, 2f64.powi(1023)));
    }
}
