//! A small hash table of the ridges round a cavity, which pairs the simplices of a new cone that
//! share a ridge: each ridge comes up twice. Pivoting round a ridge through the cavity needs no
//! table, but no processor can predict how many steps it takes.

use super::{SimplexId, VertexId};
use crate::memory::{AllocResult, TryGrow};

/// Largest dimension in which a ridge, which has D - 1 vertices, fits in a key of 128 bits.
pub(super) const MAX_TABLE_DIM: usize = 5;

/// Simplex at a ridge, and the number of its vertex that is neither on the ridge nor the apex.
#[derive(Clone, Copy, Debug)]
pub(super) struct RidgeSide {
    pub simplex: SimplexId,
    pub index: u32,
}

#[derive(Clone, Copy, Debug)]
struct Slot {
    ridge: u128,
    side: RidgeSide,
    /// Number of the cone that filled the slot; slots of earlier cones are free.
    cone: u32,
}

impl Slot {
    const FREE: Self =
        Self { ridge: 0, side: RidgeSide { simplex: SimplexId::NONE, index: 0 }, cone: 0 };
}

#[derive(Clone, Debug, Default)]
pub(super) struct Ridges {
    slots: Vec<Slot>,
    cone: u32,
    /// Number of slots in use less one, a mask for their indices.
    mask: usize,
    shift: u32,
}

impl Ridges {
    /// Reserves memory for the ridges of `facets` facets of dimension D - 1; these have D/2 ridges
    /// each.
    pub fn reserve<const D: usize>(&mut self, facets: usize) -> AllocResult<()> {
        self.slots.cover(slots(D, facets), Slot::FREE)
    }

    /// Empties the table for the ridges of `facets` facets, for which memory is reserved.
    pub fn begin<const D: usize>(&mut self, facets: usize) {
        if self.cone == u32::MAX {
            self.slots.fill(Slot::FREE);
            self.cone = 0;
        }
        self.cone += 1;
        let slots = slots(D, facets);
        self.mask = slots - 1;
        self.shift = 64 - slots.trailing_zeros();
    }

    /// Returns the side that came with `ridge` the first time; the first time itself records `side`
    /// and returns `None`.
    #[inline]
    pub fn pair(&mut self, ridge: u128, side: RidgeSide) -> Option<RidgeSide> {
        let mut at = (hash(ridge) >> self.shift) as usize;
        loop {
            let slot = &mut self.slots[at];
            if slot.cone != self.cone {
                *slot = Slot { ridge, side, cone: self.cone };
                return None;
            }
            if slot.ridge == ridge {
                return Some(slot.side);
            }
            at = (at + 1) & self.mask;
        }
    }
}

/// Returns the number of slots for the ridges of `facets` facets: at least twice as many as ridges.
fn slots(dim: usize, facets: usize) -> usize {
    (dim * facets).next_power_of_two().max(2)
}

#[inline]
fn hash(ridge: u128) -> u64 {
    let (high, low) = ((ridge >> 64) as u64, ridge as u64);
    (high.wrapping_mul(0xd6e8_feb8_6659_fd93) ^ low).wrapping_mul(0x9e37_79b9_7f4a_7c15)
}

/// Returns the ridges of the facet opposite the vertex `apex` of a simplex, each with the number of
/// the facet's vertex that it lacks. The order of the facet's vertices does not matter.
#[inline]
pub(super) fn ridges_of<const D: usize>(vertices: &[VertexId], apex: usize) -> [(u128, u32); D] {
    let mut facet: [u64; D] = std::array::from_fn(|i| {
        let index = if i == apex { D } else { i };
        u64::from(vertices[index].number()) << 32 | index as u64
    });
    for i in 0..D {
        for j in i + 1..D {
            (facet[i], facet[j]) = (facet[i].min(facet[j]), facet[i].max(facet[j]));
        }
    }
    std::array::from_fn(|lacking| {
        let others = (0..D).filter(|&i| i != lacking);
        let ridge = others.fold(0, |ridge, i| ridge << 32 | u128::from(facet[i] >> 32));
        (ridge, facet[lacking] as u32)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks that each ridge is met by two simplices of the cone of a vertex over the surface of a
    /// simplex, and has the same key in both, though their vertices are in different orders.
    fn ridges_come_in_pairs<const D: usize>() {
        let apex = VertexId::new(1000);
        let surface: Vec<VertexId> = (0..=D).map(|i| VertexId::new((7 * i + 3) % 11)).collect();
        let mut table = Ridges::default();
        table.reserve::<D>(D + 1).unwrap();
        for _ in 0..2 {
            table.begin::<D>(D + 1);
            let mut pairs = 0;
            for lacking in 0..=D {
                let mut vertices: Vec<VertexId> =
                    (0..=D).map(|i| if i == lacking { apex } else { surface[i] }).collect();
                vertices.rotate_left(lacking * 3 % (D + 1));
                vertices.swap(0, lacking);
                let at = vertices.iter().position(|&vertex| vertex == apex).unwrap();
                for (ridge, index) in ridges_of::<D>(&vertices, at) {
                    let side = RidgeSide { simplex: SimplexId::new(lacking), index };
                    let Some(other) = table.pair(ridge, side) else { continue };
                    pairs += 1;
                    // Each side lacks the vertex that the other simplex has not.
                    assert_eq!(vertices[index as usize], surface[other.simplex]);
                    assert!(other.simplex < side.simplex);
                }
            }
            assert_eq!(pairs, D * (D + 1) / 2);
        }
    }

    #[test]
    fn ridges_come_in_pairs_in_every_dimension() {
        ridges_come_in_pairs::<2>();
        ridges_come_in_pairs::<3>();
        ridges_come_in_pairs::<4>();
        ridges_come_in_pairs::<5>();
    }

    /// Ridges with equal hashes take slots one after the other.
    #[test]
    fn ridges_with_one_hash_are_told_apart() {
        let mut table = Ridges::default();
        table.reserve::<2>(64).unwrap();
        table.begin::<2>(64);
        table.shift = 63;
        for round in 0..2 {
            for simplex in SimplexId::below(60) {
                let ridge = u128::from(simplex.number()) << 32 | 5;
                let known = table.pair(ridge, RidgeSide { simplex, index: 1 });
                assert_eq!(known.map(|side| side.simplex), (round == 1).then_some(simplex));
            }
        }
    }

    /// Slots filled by earlier cones are free, also when the numbers of cones start again.
    #[test]
    fn every_cone_begins_with_an_empty_table() {
        let mut table = Ridges::default();
        table.reserve::<3>(4).unwrap();
        for cone in [0, u32::MAX, 1] {
            table.cone = cone;
            table.begin::<3>(4);
            for ridge in 0..6 {
                assert!(
                    table.pair(ridge, RidgeSide { simplex: SimplexId::new(1), index: 0 }).is_none()
                );
            }
        }
    }
}
