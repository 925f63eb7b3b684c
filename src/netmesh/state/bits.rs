//! Sets of numbers as bits of a word, which tell mostly that two sets, or a set and a number, have
//! nothing in common (B. H. Bloom, "Space/time trade-offs in hash coding with allowable errors",
//! 1970).

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

/// Returns the numbers of the bits of a set, the least first.
#[inline]
pub(in crate::netmesh) fn numbers_in(mut set: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let least = set.trailing_zeros();
        set &= set.checked_sub(1)?;
        Some(least as usize)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_those_of_the_bits() {
        assert!(numbers_in(0).next().is_none());
        assert!(numbers_in(0b1000_0110).eq([1, 2, 7]));
        assert!(numbers_in(u32::MAX).eq(0..32));
    }

    #[test]
    fn bits_of_two_and_of_three_sets_are_counted() {
        for sets in 0..16u64 {
            let four = std::array::from_fn(|at| sets >> at & 1);
            assert_eq!(in_two_of(four), u64::from(sets.count_ones() >= 2), "{sets:04b}");
            assert_eq!(in_three_of(four), u64::from(sets.count_ones() >= 3), "{sets:04b}");
        }
    }
}
