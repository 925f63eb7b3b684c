//! Names of vertices and domains. The partitions of a mesh number what they have as they like;
//! between them a vertex or a domain is known by its name, which does not depend on where it was
//! made.

/// An input's name is its number among the inputs of all processes; of equal inputs the least.
/// Other names have this bit.
pub const MADE: u64 = 1 << 63;

/// The name of the vertex at infinity, and of nothing.
pub(super) const NOTHING: u64 = u64::MAX;

/// The name of the root domain.
pub(super) const ROOT_NAME: u64 = made_by(0, 0);

/// Returns the name of the vertex, or the domain, that partition `maker` made as its number
/// `number`.
pub(super) const fn made_by(maker: u32, number: usize) -> u64 {
    MADE | (maker as u64) << 32 | number as u64
}

pub(super) fn is_input(name: u64) -> bool {
    name & MADE == 0
}
