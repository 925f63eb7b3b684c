//! Inputs in an order of locality: those near each other get ids near each other, so that a round,
//! which takes its inputs by id, stays in one part of memory for a while. The order is that of a
//! Z-order curve; where inputs share a cell of it, it goes on within their own box, so that
//! clusters are ordered at every scale. The caller's order does not count. The result depends on it
//! by ids only: no sign is decided here.

use crate::error::{Error, Result};
use crate::memory::{AllocError, AllocResult, Id, TryGrow, collected, filled, with_capacity};
use crate::mesh::Inputs;
use crate::netmesh::state::watch::Watch;
use crate::netmesh::state::workers::on_threads;
use std::cmp::Ordering;
use std::ops::Range;

/// A distinct input, in the caller's order. As a vertex it has its place in the order of locality
/// ([`VertexId`](crate::complex::VertexId)).
pub(in crate::netmesh) type InputId = Id<Input>;

/// Kind of thing that an [`InputId`] names.
pub(in crate::netmesh) enum Input {}

/// Bits of a key in all, and of one that buckets are made of.
const KEY_BITS: usize = 63;

const BUCKET_BITS: usize = 12;

/// Largest number of inputs that are sorted in one go; more would keep the caller's callback
/// waiting.
const MANY: usize = 1 << 15;

/// Largest number of inputs in a cell that may stay as they are.
const FEW: usize = 8;

/// Returns the distinct inputs in order, whatever the number of `threads` that make it. O(n log n),
/// since a box is at most 2^2100 times another one.
pub(in crate::netmesh) fn by_locality<const D: usize>(
    inputs: &Inputs,
    threads: usize,
    watch: &mut Watch<'_, '_>,
) -> Result<Vec<InputId>> {
    let mut order = collected(InputId::below(inputs.distinct()))?;
    let mut crowds = Vec::new();
    crowds.try_push(0..order.len())?;
    // Crowds of crowds come next, all of them on all threads.
    while !crowds.is_empty() {
        let mut small = Vec::new();
        let mut next = Vec::new();
        for crowd in crowds {
            if crowd.len() > MANY {
                sort_large_crowd::<D>(inputs, &mut order, crowd, &mut next, watch)?;
            } else {
                small.try_push(crowd)?;
            }
        }
        let pieces = Pieces { order: &mut order, begin: 0, crowds: &small };
        let sort = |(begin, own, crowds)| sort_crowds::<D>(inputs, begin, own, crowds);
        for crowd in on_threads(threads, watch, pieces, sort)?.into_iter().flatten() {
            next.try_push(crowd)?;
        }
        next.sort_unstable_by_key(|crowd: &Range<usize>| crowd.start);
        crowds = next;
    }
    Ok(order)
}

/// Inputs of one cell, by where they are in the order.
type Crowd = Range<usize>;

/// Runs of crowds, with the part of the order that they are in and where that begins.
struct Pieces<'a> {
    order: &'a mut [InputId],
    begin: usize,
    /// Crowds that are left, in their order.
    crowds: &'a [Crowd],
}

impl<'a> Iterator for Pieces<'a> {
    type Item = (usize, &'a mut [InputId], &'a [Crowd]);

    fn next(&mut self) -> Option<Self::Item> {
        let first = self.crowds.first()?;
        let fits = |crowd: &&Crowd| crowd.end - first.start <= MANY;
        let (own, rest) = self.crowds.split_at(self.crowds.iter().take_while(fits).count());
        let order = std::mem::take(&mut self.order);
        let (_, order) = order.split_at_mut(first.start - self.begin);
        let end = own.last()?.end;
        let (piece, order) = order.split_at_mut(end - first.start);
        (self.order, self.begin, self.crowds) = (order, end, rest);
        Some((first.start, piece, own))
    }
}

/// Sorts a crowd of many inputs into those of its cells, and adds the crowds among these to
/// `found`.
fn sort_large_crowd<const D: usize>(
    inputs: &Inputs,
    order: &mut [InputId],
    crowd: Crowd,
    found: &mut Vec<Crowd>,
    watch: &mut Watch<'_, '_>,
) -> Result<()> {
    let own = &mut order[crowd.clone()];
    let mut tick = || watch.poll_after(1);
    let cells = Cells::<D>::around::<Error>(inputs, own, &mut tick)?;
    let mut keyed = with_capacity(own.len())?;
    for &input in own.iter() {
        tick()?;
        keyed.push((cells.key(point(inputs, input)), input));
    }
    let starts = sort_into_buckets(&keyed, cells.bits() - BUCKET_BITS, own, tick)?;
    for bucket in starts.windows(2) {
        if (2..crowd.len()).contains(&(bucket[1] - bucket[0])) {
            found.try_push(crowd.start + bucket[0]..crowd.start + bucket[1])?;
        }
    }
    Ok(())
}

/// Sorts the inputs of each of the `crowds` in `own`, which begins at `begin` in the order. Returns
/// the crowds among them.
fn sort_crowds<const D: usize>(
    inputs: &Inputs,
    begin: usize,
    own: &mut [InputId],
    crowds: &[Crowd],
) -> AllocResult<Vec<Crowd>> {
    let mut keyed = Vec::new();
    let mut found = Vec::new();
    for crowd in crowds {
        let own = &mut own[crowd.start - begin..crowd.end - begin];
        let cells = Cells::<D>::around(inputs, own, || Ok::<_, AllocError>(()))?;
        keyed.clear();
        for &input in own.iter() {
            keyed.try_push((cells.key(point(inputs, input)), input))?;
        }
        keyed.sort_unstable_by(|a, b| a.0.cmp(&b.0).then_with(|| compare::<D>(inputs, a.1, b.1)));
        let mut at = crowd.start;
        for run in keyed.chunk_by(|a, b| a.0 == b.0) {
            if is_crowd(run.len(), crowd) {
                found.try_push(at..at + run.len())?;
            }
            at += run.len();
        }
        own.iter_mut().zip(&keyed).for_each(|(id, keyed)| *id = keyed.1);
    }
    Ok(found)
}

/// Returns true if so many inputs in one cell of `crowd` are to be ordered among themselves.
fn is_crowd(length: usize, crowd: &Crowd) -> bool {
    length > FEW && length < crowd.len()
}

/// Writes the ids by the bits of their keys from `shift` on to `sorted`; returns where buckets
/// begin.
fn sort_into_buckets(
    keyed: &[(u64, InputId)],
    shift: usize,
    sorted: &mut [InputId],
    mut tick: impl FnMut() -> Result<()>,
) -> Result<Vec<usize>> {
    let bucket = |key: u64| (key >> shift) as usize;
    let mut starts = filled((1 << BUCKET_BITS) + 1, 0)?;
    for &(key, _) in keyed {
        tick()?;
        starts[bucket(key) + 1] += 1;
    }
    for at in 1..starts.len() {
        starts[at] += starts[at - 1];
    }
    let mut next = collected(starts.iter().copied())?;
    for &(key, id) in keyed {
        tick()?;
        let at = &mut next[bucket(key)];
        sorted[*at] = id;
        *at += 1;
    }
    Ok(starts)
}

/// Compares inputs by their coordinates, which do not depend on the caller's order.
fn compare<const D: usize>(inputs: &Inputs, a: InputId, b: InputId) -> Ordering {
    point::<D>(inputs, a).partial_cmp(point::<D>(inputs, b)).expect("coordinates are finite")
}

fn point<const D: usize>(inputs: &Inputs, input: InputId) -> &[f64; D] {
    inputs.distinct_point(input.index()).try_into().expect("dim is D")
}

/// The cells of a cube.
struct Cells<const D: usize> {
    low: [f64; D],
    /// Cells per unit of length, of halved coordinates: differences of those do not overflow.
    scale: f64,
}

impl<const D: usize> Cells<D> {
    const AXIS_BITS: usize = KEY_BITS / D;

    /// A byte's bits D places apart.
    const SPREAD: [u64; 256] = spread(D);

    /// Returns the cells of the box of the named inputs. `tick` is called for each.
    fn around<E: From<AllocError>>(
        inputs: &Inputs,
        named: &[InputId],
        mut tick: impl FnMut() -> std::result::Result<(), E>,
    ) -> std::result::Result<Self, E> {
        let mut low = point::<D>(inputs, named[0]).map(|x| 0.5 * x);
        let mut high = low;
        for &input in named {
            tick()?;
            for (axis, &x) in point::<D>(inputs, input).iter().enumerate() {
                low[axis] = low[axis].min(0.5 * x);
                high[axis] = high[axis].max(0.5 * x);
            }
        }
        let size = (0..D).fold(0.0f64, |size, axis| size.max(high[axis] - low[axis]));
        let scale = (1u64 << Self::AXIS_BITS) as f64 / size;
        Ok(Self { low, scale })
    }

    /// Returns the number of bits of a key.
    const fn bits(&self) -> usize {
        D * Self::AXIS_BITS
    }

    /// Returns the place on the curve of the cell of `x`. A coordinate that overflows, or has no
    /// size, is in the last cell or the first one: a cast saturates.
    fn key(&self, x: &[f64; D]) -> u64 {
        let mut key = 0;
        for (axis, (&x, &low)) in x.iter().zip(&self.low).enumerate() {
            let cell = ((0.5 * x - low) * self.scale) as u64;
            let cell = cell.min((1 << Self::AXIS_BITS) - 1);
            let mut shift = axis;
            for byte in cell.to_le_bytes().into_iter().take(Self::AXIS_BITS.div_ceil(8)) {
                key |= Self::SPREAD[byte as usize] << shift;
                shift += 8 * D;
            }
        }
        key
    }
}

/// Returns the bits of each byte, so many places apart.
const fn spread(places: usize) -> [u64; 256] {
    let mut table = [0; 256];
    let mut byte = 0;
    while byte < table.len() {
        let mut bit = 0;
        while bit < 8 {
            table[byte] |= (byte as u64 >> bit & 1) << (bit * places);
            bit += 1;
        }
        byte += 1;
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_core::Rng;

    fn order<const D: usize>(points: &[[f64; D]]) -> Vec<InputId> {
        let inputs = Inputs::new(D, points.len(), points.as_flattened(), 0).unwrap();
        let order = |threads| by_locality::<D>(&inputs, threads, &mut Watch::new(None)).unwrap();
        let of_one = order(1);
        assert!(order(3) == of_one);
        of_one
    }

    /// Returns the average distance of consecutive points.
    fn step<const D: usize>(points: &[[f64; D]], order: &[InputId]) -> f64 {
        let distance = |pair: &[InputId]| {
            let [a, b] = [points[pair[0]], points[pair[1]]];
            crate::numerics::distance(&a, &b)
        };
        order.windows(2).map(distance).sum::<f64>() / order.len() as f64
    }

    fn scattered<const D: usize>(count: usize) -> Vec<[f64; D]> {
        let mut random = rand_pcg::Pcg64Mcg::new(7);
        let mut unit = || f64::from(random.next_u32()) / f64::from(u32::MAX);
        (0..count).map(|_| std::array::from_fn(|_| unit())).collect()
    }

    fn is_permutation(order: &[InputId]) -> bool {
        let mut sorted = order.to_vec();
        sorted.sort_unstable();
        sorted.into_iter().eq(InputId::below(order.len()))
    }

    #[test]
    fn a_grid_is_ordered_as_the_curve_goes() {
        let grid: Vec<[f64; 2]> = (0..16).map(|i| [f64::from(i % 4), f64::from(i / 4)]).collect();
        let expected = [0, 1, 4, 5, 2, 3, 6, 7, 8, 9, 12, 13, 10, 11, 14, 15];
        assert_eq!(order(&grid), expected.map(InputId::new));
    }

    /// Twins, triples and single points in cells of a large crowd and of small ones.
    #[test]
    fn the_order_of_inputs_does_not_count() {
        for count in [9, 700, MANY + 5000] {
            let mut points = scattered::<2>(count);
            for at in (0..count - 3).step_by(3) {
                points[at + 1] = points[at].map(|x| x + 1e-12);
                points[at + 2] = [points[at][0], points[at][1] + 1e-12];
            }
            let reversed: Vec<_> = points.iter().rev().copied().collect();
            let named = |points: &[[f64; 2]]| -> Vec<[f64; 2]> {
                order(points).into_iter().map(|input| points[input.index()]).collect()
            };
            assert_eq!(named(&points), named(&reversed));
        }
    }

    #[test]
    fn consecutive_inputs_are_near_each_other() {
        fn check<const D: usize>(count: usize) {
            let points = scattered::<D>(count);
            let order = order(&points);
            assert!(is_permutation(&order));
            let spacing = (count as f64).powf(-1.0 / D as f64);
            let step = step(&points, &order) / spacing;
            assert!(step < 4.0, "{D} {count} {step}");
        }
        check::<2>(1000);
        check::<2>(MANY + 1000);
        check::<3>(MANY + 1000);
        check::<4>(2000);
        check::<8>(2000);
    }

    /// A thousand points beyond the resolution of the keys of all are ordered among themselves.
    #[test]
    fn a_cluster_is_ordered_at_its_own_scale() {
        let mut points = scattered::<3>(1000);
        for point in &mut points {
            *point = point.map(|x| x * 1e-200);
        }
        points.push([1e200, 0.0, 0.0]);
        points.push([1.0, 1.0, 1.0]);
        let order = order(&points);
        assert!(is_permutation(&order));
        let inner: Vec<_> = order.iter().copied().filter(|id| id.index() < 1000).collect();
        assert!(step(&points, &inner) < 0.4e-200);
    }

    /// The grid has so many inputs that crowds of crowds are sorted in several pieces.
    #[test]
    fn a_large_grid_is_ordered_as_the_curve_goes() {
        const BITS: usize = 9;
        let side = 1 << BITS;
        let at = |i: usize| [(i % side) as f64, (i / side) as f64];
        let grid: Vec<[f64; 2]> = (0..side * side).map(at).collect();
        assert!(grid.len() > 4 * MANY);
        let bit = |place: usize, bit: usize| place >> bit & 1;
        let every_other =
            |place: usize| (0..BITS).fold(0, |all, at| all | bit(place, 2 * at) << at);
        let along_curve = |place: usize| every_other(place) + side * every_other(place >> 1);
        let expected = (0..grid.len()).map(along_curve).map(InputId::new);
        assert!(order(&grid).into_iter().eq(expected));
    }

    #[test]
    fn the_ends_of_the_range_do_no_harm() {
        let far = f64::MAX;
        let tiny = f64::from_bits(1);
        let mut points = vec![[far, far], [-far, far], [tiny, 0.0], [0.0, 0.0], [-tiny, tiny]];
        points.extend((0..20).map(|i| [f64::from(i) * tiny, 1.0]));
        assert!(is_permutation(&order(&points)));
        assert_eq!(order(&points[..2]), [1, 0].map(InputId::new));
    }
}
