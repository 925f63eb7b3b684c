//! Lengths in a unit that is a power of two: nothing overflows on the way, nor underflows but what
//! counts for nothing.

/// Differences of points in a unit that is a power of two.
#[derive(Clone, Copy)]
pub(crate) struct Unit {
    /// Factor of coordinates before they are subtracted: 1, or a half where differences would
    /// overflow.
    half: f64,
    /// Factor of a difference of coordinates, after each has been multiplied by [`Self::half`].
    scale: f64,
}

impl Unit {
    /// Returns a unit in which points as large as `largest` have finite differences.
    pub fn of_points(largest: f64) -> Self {
        Self { half: if largest > power_of_two(1000) { 0.5 } else { 1.0 }, scale: 1.0 }
    }

    /// Returns a unit of about `length`, a difference in the present unit that is not zero.
    pub fn scaled_to(self, length: f64) -> Self {
        Self { scale: power_of_two((-exponent(length)).min(1000)), ..self }
    }

    /// Returns a - b in this unit.
    #[inline]
    pub fn difference<const D: usize>(self, a: &[f64; D], b: &[f64; D]) -> [f64; D] {
        std::array::from_fn(|i| (a[i] * self.half - b[i] * self.half) * self.scale)
    }

    /// Returns the exponent of the power of two that the unit is.
    pub fn exponent(self) -> i32 {
        i32::from(self.half != 1.0) - exponent(self.scale)
    }

    /// Returns a vector of this unit in real units.
    pub fn real<const D: usize>(self, x: [f64; D]) -> [f64; D] {
        x.map(|x| x / self.scale / self.half)
    }
}

pub(crate) fn largest<const D: usize>(vector: &[f64; D]) -> f64 {
    vector.iter().fold(0.0, |largest, x| if x.abs() > largest { x.abs() } else { largest })
}

/// Returns the exponent of a finite number that is not negative; 0 for zero.
pub(crate) fn exponent(x: f64) -> i32 {
    match x.to_bits() >> 52 {
        0 if x == 0.0 => 0,
        0 => x.to_bits().ilog2() as i32 - 1074,
        field => field as i32 - 1023,
    }
}

/// Returns `x + y * 2^exponent`, infinite only if that exceeds the doubles.
pub(crate) fn sum_of_scaled(x: f64, y: f64, exponent: i32) -> f64 {
    let offset = scaled(y, exponent);
    if offset.is_finite() { x + offset } else { 2.0 * (0.5 * x + scaled(y, exponent - 1)) }
}

/// Returns `x * 2^exponent`; exponents beyond 2000 count as 2000.
pub(crate) fn scaled(x: f64, exponent: i32) -> f64 {
    if (-1000..=1000).contains(&exponent) {
        return x * power_of_two(exponent);
    }
    let half = (exponent / 2).clamp(-1000, 1000);
    let rest = (exponent - half).clamp(-1000, 1000);
    x * power_of_two(half) * power_of_two(rest)
}

/// Returns 2^`exponent` for exponents from -1022 to 1023.
fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((exponent + 1023) as u64) << 52)
}
