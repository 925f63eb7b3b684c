//! Form of the radii that filtrations have.

use crate::query::unit::scaled;

/// Form of the radius that a caller wants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Radius {
    Nothing,
    /// The double nearest to its square.
    Square,
    /// The square root of that, without the square's overflow and underflow.
    Length,
}

impl Radius {
    /// Returns the radius for the double nearest to its square, in units of `2^(2 exponent)`;
    /// `None` if it is no normal number there, and so must be rounded in another unit.
    pub fn of_square(self, square: f64, exponent: i32) -> Option<f64> {
        match self {
            Self::Nothing => Some(f64::NAN),
            Self::Length => Some(scaled(square.sqrt(), exponent)),
            Self::Square => {
                Some(scaled(square, 2 * exponent)).filter(|&value| value >= f64::MIN_POSITIVE)
            }
        }
    }
}
