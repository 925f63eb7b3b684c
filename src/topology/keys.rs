//! Keys that sort faces: vertex ids packed into one number, whose order is the lexicographic one.

use crate::memory::{AllocResult, TryGrow};
use crate::mesh::MAX_DIM;

/// Vertices, each below `2^bits`, packed.
pub(super) trait Key: Copy + Ord + Default + Send {
    fn pack(vertices: &[u32], bits: u32) -> Self;
    /// Writes the vertices.
    fn unpack(self, bits: u32, vertices: &mut [u32]);
    /// Returns the key without vertex `i` of `count`.
    fn without(self, i: usize, count: usize, bits: u32) -> Self;
    /// Returns one of the bytes, from the least significant; `None` if there are none to sort by.
    fn byte(self, at: u32) -> Option<u8>;
}

/// Returns the number of bits that the ids below `count` take.
pub(super) fn bits_of_ids(count: usize) -> u32 {
    (usize::BITS - count.saturating_sub(1).leading_zeros()).max(1)
}

macro_rules! integer_key {
    ($integer:ty) => {
        impl Key for $integer {
            #[inline]
            fn pack(vertices: &[u32], bits: u32) -> Self {
                vertices.iter().fold(0, |key, &vertex| key << bits | Self::from(vertex))
            }

            #[inline]
            fn unpack(self, bits: u32, vertices: &mut [u32]) {
                let mask = (1 << bits) - 1;
                for (i, vertex) in vertices.iter_mut().rev().enumerate() {
                    *vertex = (self >> (bits * i as u32) & mask) as u32;
                }
            }

            #[inline]
            fn without(self, i: usize, count: usize, bits: u32) -> Self {
                let after = bits * (count - 1 - i) as u32;
                let low = self & ((1 << after) - 1);
                // In two steps: one may be by all bits.
                self >> after >> bits << after | low
            }

            #[inline]
            fn byte(self, at: u32) -> Option<u8> {
                Some((self >> (8 * at)) as u8)
            }
        }
    };
}
integer_key!(u64);
integer_key!(u128);

/// Key of more vertices than 128 bits hold.
impl Key for [u32; MAX_DIM] {
    fn pack(vertices: &[u32], _: u32) -> Self {
        std::array::from_fn(|i| vertices.get(i).copied().unwrap_or(0))
    }

    fn unpack(self, _: u32, vertices: &mut [u32]) {
        vertices.copy_from_slice(&self[..vertices.len()]);
    }

    fn without(mut self, i: usize, _: usize, _: u32) -> Self {
        self[i..].rotate_left(1);
        self[MAX_DIM - 1] = 0;
        self
    }

    fn byte(self, _: u32) -> Option<u8> {
        None
    }
}

/// A key and what it belongs to.
pub(super) type Entry<K> = (K, u32);

/// Shorter lists are sorted by comparisons.
const SHORT: usize = 512;

/// Sorts entries by their keys, which have `bits` bits. `spare` is scratch memory.
pub(super) fn sort<K: Key>(
    list: &mut [Entry<K>],
    bits: u32,
    spare: &mut Vec<Entry<K>>,
) -> AllocResult<()> {
    if list.len() < SHORT || K::default().byte(0).is_none() {
        list.sort_unstable();
        return Ok(());
    }
    spare.cover(list.len(), (K::default(), 0))?;
    for at in 0..bits.div_ceil(8) {
        let byte = |entry: &Entry<K>| usize::from(entry.0.byte(at).unwrap_or(0));
        let mut starts = [0usize; 257];
        list.iter().for_each(|entry| starts[byte(entry) + 1] += 1);
        (0..256).for_each(|byte| starts[byte + 1] += starts[byte]);
        for entry in &*list {
            let next = &mut starts[byte(entry)];
            spare[*next] = *entry;
            *next += 1;
        }
        list.copy_from_slice(&spare[..list.len()]);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn round_trip<K: Key>(bits: u32, faces: &[&[u32]]) {
        let keys: Vec<K> = faces.iter().map(|face| K::pack(face, bits)).collect();
        assert!(keys.is_sorted());
        let vertices = |key: K, count: usize| {
            let mut vertices = vec![0; count];
            key.unpack(bits, &mut vertices);
            vertices
        };
        for (&key, &face) in keys.iter().zip(faces) {
            assert_eq!(vertices(key, face.len()), face);
            for i in 0..face.len() {
                let mut others = face.to_vec();
                others.remove(i);
                assert_eq!(vertices(key.without(i, face.len(), bits), face.len() - 1), others);
            }
        }
    }

    #[test]
    fn keys_keep_vertices_and_their_order() {
        let top = (1 << 21) - 1;
        let faces: [&[u32]; 4] = [&[0, 1, 2], &[0, 1, top], &[0, 2, 3], &[top - 2, top - 1, top]];
        round_trip::<u64>(21, &faces);
        round_trip::<u128>(42, &faces);
        round_trip::<[u32; 8]>(21, &faces);
        round_trip::<u64>(32, &[&[0, 1], &[0, u32::MAX], &[5, 6]]);
        let bits = [1, 2, 3, 4, 5, 1 << 21, (1 << 21) + 1].map(bits_of_ids);
        assert_eq!(bits, [1, 1, 2, 2, 3, 21, 22]);
    }

    fn sorts<K: Key + std::fmt::Debug>(count: u64, bits: u32) {
        let key = |i: u64| {
            let random = i.wrapping_mul(0x9e37_79b9_7f4a_7c15);
            K::pack(&[(random >> 44) as u32 % 1000, (random >> 20) as u32 % 7], bits)
        };
        let mut list: Vec<Entry<K>> = (0..count).map(|i| (key(i), i as u32)).collect();
        let mut expected = list.clone();
        expected.sort();
        sort(&mut list, 2 * bits, &mut Vec::new()).unwrap();
        assert_eq!(list, expected);
    }

    #[test]
    fn long_and_short_lists_are_sorted() {
        for count in [0, 1, 100, 511, 512, 5000] {
            sorts::<u64>(count, 10);
            sorts::<u128>(count, 40);
            sorts::<[u32; 8]>(count, 30);
        }
    }
}
