//! Sets of numbers as 64 bits, which tell mostly that two sets, or a set and a number, have nothing
//! in common (B. H. Bloom, "Space/time trade-offs in hash coding with allowable errors", 1970).

/// Returns the bit that stands for a number, and for every 64th before and behind it.
#[inline]
pub(in crate::netmesh) fn bit_of(number: u32) -> u64 {
    1 << (number % u64::BITS)
}
