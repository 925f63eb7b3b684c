//! Inputs go to the ranks that make their partitions: those of the coarse simplices that they lie
//! in. This is a sample sort along the order of locality of the coarse mesh.

use super::Watch;
use super::sample::{Input, keep_distinct, one_of};
use crate::comm::{Communicator, agreed};
use crate::words::{all_words, append, empty_messages, words_of};
use netmesh::Result;
use netmesh::distributed::memory::{TryGrow, collected, with_capacity};
use netmesh::distributed::{Bisection, Coarse, Located, Piece};

/// The least number of inputs of a partition in a large mesh, and in a small one.
const LARGE: u64 = 1 << 19;
pub const SMALL: u64 = 1 << 9;

/// The least number of sampled inputs in a partition of a large mesh: with fewer, most of its
/// inputs would be near an interface, and wait.
const SAMPLED: u64 = 1 << 10;

/// A small mesh has at most so many partitions, and a large one a multiple of that, for equal
/// shares on the usual numbers of ranks.
const FEW: u64 = 8;

/// Returns the number of partitions of a mesh of so many inputs: this does not depend on the ranks.
fn partition_count(total: u64) -> usize {
    let large = LARGE.max(SAMPLED * one_of(total));
    match total / (FEW * large) {
        0 => (total / SMALL).clamp(1, FEW) as usize,
        several => (several * FEW) as usize,
    }
}

/// A cluster that has no more than this part of a partition is made by one partition.
const CLUSTER: usize = 8;

/// Returns the largest number of points of a sample that a cluster has which is one vertex of the
/// coarse mesh.
pub fn small_cluster(sample: usize, total: u64) -> usize {
    sample / (CLUSTER * partition_count(total))
}

/// The partitions, and which of them this rank makes.
pub struct Share<const D: usize> {
    /// Partitions of this rank, in order, each with inputs that wait.
    pub pieces: Vec<Piece<D>>,
    /// The first of them.
    pub first: usize,
    /// Number of partitions on all ranks.
    pub count: usize,
}

/// Returns the rank that makes a partition of phase 0.
pub fn owner(partition: usize, count: usize, ranks: usize) -> usize {
    partition * ranks / count
}

/// Collective. Partitions the coarse mesh of `sample`, and sends each input to where its partition
/// is made. `first` is the number of this rank's first point, `total` that of all points.
pub fn share<const D: usize>(
    comm: &dyn Communicator,
    coarse: &mut Coarse<D>,
    sample: &[Input<D>],
    points: &[[f64; D]],
    [first, total]: [u64; 2],
    watch: &mut Watch<'_, '_, '_>,
) -> Result<Share<D>> {
    let count = partition_count(total);
    let (Located { simplices: located, at_steiner_points }, partition_of) = agreed(comm, || {
        let located = watch.next(0.05, |progress| coarse.locate(points, Some(progress)))?;
        let sample = collected(sample.iter().map(|input| input.point))?;
        Ok((located, coarse.partitions(&Bisection::new(sample, count, 0)?)?))
    })?;
    yield_to(comm, coarse, &at_steiner_points, first)?;
    let coarse = &*coarse;
    let messages = agreed(comm, || {
        let mut messages = empty_messages(comm.size())?;
        for ((name, point), &simplex) in (first..).zip(points).zip(&located) {
            if let Some(&partition) = partition_of.get(simplex as usize) {
                let message = &mut messages[owner(partition as usize, count, comm.size())];
                append(message, &[name, u64::from(simplex)])?;
                append(message, &point.map(f64::to_bits))?;
            }
        }
        Ok(messages)
    })?;
    drop(located);
    let received = comm.all_to_all(messages)?;
    agreed(comm, || own_partitions(comm, coarse, &received, &partition_of, count))
}

/// Collective. Makes Steiner points of the coarse mesh that are where inputs are those inputs, on
/// all ranks; of equal inputs that with the least name.
fn yield_to<const D: usize>(
    comm: &dyn Communicator,
    coarse: &mut Coarse<D>,
    at_steiner_points: &[(usize, u32)],
    first: u64,
) -> Result<()> {
    let message = agreed(comm, || {
        let mut message = Vec::new();
        for &(at, vertex) in at_steiner_points {
            append(&mut message, &[u64::from(vertex), first + at as u64])?;
        }
        Ok(message)
    })?;
    let all = comm.all_gather(&message)?;
    agreed(comm, || {
        let words = all_words(&all)?;
        let mut inputs: Vec<(u32, u64)> =
            collected(words.chunks_exact(2).map(|pair| (pair[0] as u32, pair[1])))?;
        inputs.sort_unstable();
        inputs.dedup_by_key(|&mut (vertex, _)| vertex);
        coarse.yield_to(&inputs)
    })
}

fn own_partitions<const D: usize>(
    comm: &dyn Communicator,
    coarse: &Coarse<D>,
    received: &[Vec<u8>],
    partition_of: &[u32],
    count: usize,
) -> Result<Share<D>> {
    let own = |partition: &usize| owner(*partition, count, comm.size()) == comm.rank();
    let owned: Vec<usize> = collected((0..count).filter(own))?;
    let first = owned.first().copied().unwrap_or(0);
    let mut inputs: Vec<Vec<(Input<D>, u32)>> = collected(owned.iter().map(|_| Vec::new()))?;
    for message in received {
        let words: Vec<u64> = collected(words_of(message))?;
        for words in words.chunks_exact(2 + D) {
            let point = std::array::from_fn(|axis| f64::from_bits(words[2 + axis]));
            let simplex = words[1] as u32;
            let at = partition_of[simplex as usize] as usize - first;
            inputs[at].try_push((Input { name: words[0], point }, simplex))?;
        }
    }
    let mut pieces = with_capacity(owned.len())?;
    for (&partition, own) in owned.iter().zip(inputs) {
        let (mut piece, simplices) = coarse.extract(partition_of, partition as u32)?;
        let mut distinct = collected(own.iter().map(|(input, _)| *input))?;
        keep_distinct(&mut distinct);
        let mut located: Vec<(u64, u32)> =
            collected(own.iter().map(|&(input, simplex)| (input.name, simplex)))?;
        drop(own);
        located.sort_unstable();
        let simplex_of = |name: u64| {
            let at = located.partition_point(|&(other, _)| other < name);
            simplices.partition_point(|&simplex| simplex < located[at].1) as u32
        };
        let waiting: Vec<(u64, [f64; D], u32)> = collected(
            distinct.iter().map(|input| (input.name, input.point, simplex_of(input.name))),
        )?;
        piece.add_inputs(&waiting)?;
        pieces.push(piece);
    }
    Ok(Share { pieces, first, count })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn partitions_follow_from_the_inputs_and_every_rank_has_its_share() {
        let totals = [1, 900, 2000, 100_000, 10_000_000, 1_000_000_000];
        assert_eq!(totals.map(partition_count), [1, 1, 3, 8, 16, 1024]);
        for (count, ranks) in [(1, 3), (7, 3), (16, 16), (38, 8), (3, 5)] {
            let owners: Vec<usize> =
                (0..count).map(|partition| owner(partition, count, ranks)).collect();
            assert!(owners.is_sorted() && owners.iter().all(|&owner| owner < ranks));
            let most = (0..ranks).map(|rank| owners.iter().filter(|&&o| o == rank).count()).max();
            assert_eq!(most, Some(count.div_ceil(ranks)));
        }
    }
}
