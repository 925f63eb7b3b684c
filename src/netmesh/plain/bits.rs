//! Coordinates of so few bits, as those of voxels and pixels have, that determinants of them are
//! exact in doubles.

/// Numbers of magnitudes between these have products of five that neither overflow nor lose
/// anything that counts.
pub(super) const SMALL: f64 = 1e-57;
pub(super) const LARGE: f64 = 1e57;

/// Returns the number of bits of integers that the coordinates are in some unit; more than those of
/// a double if products of five may overflow or underflow.
pub(super) fn bits(coordinates: &[f64]) -> u32 {
    const MANY: u32 = u32::MAX / 8;
    let (mut lowest, mut highest) = (i32::MAX, i32::MIN);
    for x in coordinates.iter().map(|x| x.abs()).filter(|x| *x != 0.0) {
        if !(SMALL..LARGE).contains(&x) {
            return MANY;
        }
        let exponent = (x.to_bits() >> 52) as i32 - 1023;
        let fraction = x.to_bits() & ((1 << 52) - 1) | 1 << 52;
        lowest = lowest.min(exponent - 52 + fraction.trailing_zeros() as i32);
        highest = highest.max(exponent);
    }
    if lowest > highest { 0 } else { (highest - lowest + 1) as u32 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_those_of_integers() {
        assert_eq!(bits(&[]), 0);
        assert_eq!(bits(&[0.0, -1.0, 255.0]), 8);
        assert_eq!(bits(&[-256.0, 0.5]), 10);
        assert_eq!(bits(&[1.0 / 3.0]), 53);
        assert!([1e-300, 1e300, f64::MIN_POSITIVE / 4.0].iter().all(|&x| bits(&[x, 1.0]) > 1000));
    }
}
