//! Sets of numbers as 64 bits, which tell mostly that two sets, or a set and a number, have nothing
//! in common (B. H. Bloom, "Space/time trade-offs in hash coding with allowable errors", 1970).

/// Returns the bit that stands for a number, and for every 64th before and behind it.
#[inline]
pub(in crate::netmesh) fn bit_of(number: u32) -> u64 {
    1 << (number % u64::BITS)
}

/// Returns the bits that two or more of four sets have.
#[inline]
pub(in crate::netmesh) fn in_two_of([a, b, c, d]: [u64; 4]) -> u64 {
    a & b | c & d | (a | b) & (c | d)
}

/// Returns the bits that three or more of four sets have.
#[inline]
pub(in crate::netmesh) fn in_three_of([a, b, c, d]: [u64; 4]) -> u64 {
    a & b & (c | d) | c & d & (a | b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_of_two_and_of_three_sets_are_counted() {
        for sets in 0..16u64 {
            let four = std::array::from_fn(|at| sets >> at & 1);
            assert_eq!(in_two_of(four), u64::from(sets.count_ones() >= 2), "{sets:04b}");
            assert_eq!(in_three_of(four), u64::from(sets.count_ones() >= 3), "{sets:04b}");
        }
    }
}
