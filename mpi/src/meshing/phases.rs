//! Partitions, and the phases in which their seams are divided anew and joined.

use super::Watch;
use super::partitions::{SMALL, Share, owner};
use crate::comm::{Communicator, Operation, agreed};
use crate::words::{all_words, append, bytes_of, empty_messages, hash, words_of};
use crate::work::Step;
use netmesh::Result;
use netmesh::distributed::memory::{AllocResult, TryGrow, collected, filled, with_capacity};
use netmesh::distributed::{Bisection, Coarse, Maker, Piece, RINGS};

/// Number of rings about what is left at the end, when it is extracted first. Then there are twice
/// as many, then four times as many, and so on: in the end that is all.
const FIRST_RINGS: usize = 2;

/// Number of phases that have as many partitions as the first. Then what is left is so little that
/// fewer leave less: those of the next phase are half as many, and so on.
const WHOLE: u32 = 2;

/// Number of vertices of seams, for each partition, that say where the next planes are.
const SAMPLES: u64 = 512;

/// A vertex that a seam has takes this part of the time of an input that waits.
const WAITING: u64 = 8;

/// A partition by its number, and the pieces that it is made of.
type Joined<const D: usize> = (u32, Vec<Piece<D>>);

/// Collective. Makes all partitions, and what they leave. Returns the settled pieces of this rank.
///
/// A phase leaves simplices along its planes and those of the phases before, so there are fewer and
/// fewer of them and of the partitions that they make, until one partition has all.
pub fn make<const D: usize>(
    comm: &dyn Communicator,
    coarse: &Coarse<D>,
    share: Share<D>,
    watch: &mut Watch<'_, '_, '_>,
) -> Result<Vec<Piece<D>>> {
    let Share { pieces, first, mut count } = share;
    let maker = coarse.maker();
    let mut settled = Vec::new();
    let alone = (first as u32..).zip(pieces.into_iter().map(|piece| vec![piece]));
    let mut own = agreed(comm, || make_phase(maker, collected(alone)?, 0, 0, watch))?;
    let (mut made, mut phase) = (count as u32, 0);
    let mut loads = loads_of_all(count, comm.size())?;
    // If there is one partition, the first rank makes it.
    let mut owners = vec![0];
    while count > 1 {
        phase += 1;
        let most = if phase <= WHOLE { count } else { count / 2 };
        let seams = leave(comm, own, &mut settled)?;
        let bisection;
        (bisection, count) = bisection_of(comm, &seams, phase, most)?;
        let shared;
        (owners, shared) = exchange(comm, seams, &bisection, &mut loads, count)?;
        watch.notes.end(Step::Seams { phase }, 0, 0)?;
        own = agreed(comm, || make_phase(maker, shared, phase, made, watch))?;
        made += count as u32;
    }
    push_all(&mut settled, own)?;
    let settled = make_rest(comm, maker, settled, owners[0] as usize, made, watch)?;
    watch.notes.end(Step::Rest, 0, 0)?;
    Ok(settled)
}

/// Refines the partitions of a phase that this rank makes; `made` are those of the phases before.
fn make_phase<const D: usize>(
    maker: &Maker<D>,
    partitions: Vec<Joined<D>>,
    phase: u32,
    made: u32,
    watch: &mut Watch<'_, '_, '_>,
) -> Result<Vec<Piece<D>>> {
    let share = if phase == 0 { 0.5 } else { 0.2 / f64::from(phase * phase) };
    let part = share / partitions.len() as f64;
    let mut own = with_capacity(partitions.len())?;
    for (partition, pieces) in partitions {
        let sum =
            |count: fn(&Piece<D>) -> usize| pieces.iter().map(|piece| count(piece) as u64).sum();
        let (inputs, simplices) = (sum(Piece::waiting_count), sum(Piece::simplex_count));
        let number = made + 1 + partition;
        own.push(watch.next(part, |progress| maker.refine(pieces, number, Some(progress)))?);
        watch.notes.end(Step::Partition { phase, number: partition }, inputs, simplices)?;
    }
    Ok(own)
}

/// Collective. Returns the seams that the partitions `made` in a phase leave, with what they want
/// of the pieces that are settled. Those are then all the others.
fn leave<const D: usize>(
    comm: &dyn Communicator,
    made: Vec<Piece<D>>,
    settled: &mut Vec<Piece<D>>,
) -> Result<Vec<Piece<D>>> {
    let own = agreed(comm, || {
        let mut own = Vec::new();
        for piece in &made {
            own.try_extend(&piece.wanted_names()?)?;
        }
        Ok(own)
    })?;
    let wanted = all_names(comm, own)?;
    agreed(comm, || {
        let mut seams = Vec::new();
        for piece in std::mem::take(settled) {
            let (left, given) = piece.give(RINGS, &wanted)?;
            settled.try_push(left)?;
            push_all(&mut seams, given)?;
        }
        for piece in made {
            let (rest, seam) = piece.divide(RINGS, &wanted, || Ok(()))?;
            settled.try_push(rest)?;
            push_all(&mut seams, seam)?;
        }
        Ok(seams)
    })
}

/// Collective. Returns the planes by which the seams of all ranks are partitioned, and the number
/// of partitions. Vertices that their names choose say where.
fn bisection_of<const D: usize>(
    comm: &dyn Communicator,
    seams: &[Piece<D>],
    phase: u32,
    most: usize,
) -> Result<(Bisection<D>, usize)> {
    let sum = |count: fn(&Piece<D>) -> usize| -> u64 {
        seams.iter().map(|seam| count(seam) as u64).sum()
    };
    let mut counts = [sum(Piece::waiting_count), sum(|seam| seam.vertices().len())];
    comm.all_reduce_integers(&mut counts, Operation::Sum)?;
    let [waiting, vertices] = counts;
    let weight = waiting + (vertices - waiting) / WAITING;
    let count = most.min((weight / SMALL) as usize).max(1);
    let one_of = (weight / (SAMPLES * count as u64)).max(1);
    let message = agreed(comm, || {
        let mut message = Vec::new();
        for seam in seams {
            let waiting = seam.waiting_count();
            for (at, (name, point)) in seam.vertices().enumerate() {
                let one_of = if at < waiting { one_of } else { WAITING * one_of };
                if hash(&[name]) % one_of == 0 {
                    append(&mut message, &point.map(f64::to_bits))?;
                }
            }
        }
        Ok(message)
    })?;
    let all = comm.all_gather(&message)?;
    let bisection = agreed(comm, || {
        let words = all_words(&all)?;
        let point = |words: &[u64]| std::array::from_fn(|axis| f64::from_bits(words[axis]));
        Bisection::new(collected(words.chunks_exact(D).map(point))?, count, phase as usize)
    })?;
    Ok((bisection, count))
}

/// Collective. Partitions all seams, and brings the pieces to the ranks of their partitions.
/// Returns those ranks, and the partitions that this rank makes, with their pieces in the order in
/// which those were made. `loads` has by rank the number of partitions that it has made.
fn exchange<const D: usize>(
    comm: &dyn Communicator,
    seams: Vec<Piece<D>>,
    bisection: &Bisection<D>,
    loads: &mut [u32],
    count: usize,
) -> Result<(Vec<u32>, Vec<Joined<D>>)> {
    let mut kept: Vec<(u32, Piece<D>)> = Vec::new();
    let own = agreed(comm, || {
        let mut own = filled(count, 0u64)?;
        for seam in seams {
            for (partition, piece) in seam.partition(bisection)? {
                own[partition as usize] += piece.simplex_count() as u64;
                kept.try_push((partition, piece))?;
            }
        }
        bytes_of(&own)
    })?;
    let shares = comm.all_gather(&own)?;
    let (owners, messages) = agreed(comm, || {
        let owners = owners_of(&shares, loads, count)?;
        let mut messages = empty_messages(comm.size())?;
        for (partition, piece) in std::mem::take(&mut kept) {
            match owners[partition as usize] as usize {
                to if to == comm.rank() => kept.try_push((partition, piece))?,
                to => append_piece(&mut messages[to], partition, &piece)?,
            }
        }
        Ok((owners, messages))
    })?;
    let received = comm.all_to_all(messages)?;
    agreed(comm, || {
        for message in received {
            read_pieces(&message, |partition, piece| kept.try_push((partition, piece)))?;
        }
        kept.sort_by_key(|(partition, piece)| (*partition, piece.maker()));
        let mut shared: Vec<Joined<D>> = Vec::new();
        for (partition, piece) in kept {
            match shared.last_mut() {
                Some((last, pieces)) if *last == partition => pieces.try_push(piece)?,
                _ => shared.try_push((partition, vec![piece]))?,
            }
        }
        Ok((owners, shared))
    })
}

/// Returns the rank that makes each partition: one that has much of it, so that little is sent, of
/// those that have made the fewest until now. `shares` has by rank how much of each partition it
/// has. The mesh does not depend on it.
fn owners_of(shares: &[Vec<u8>], loads: &mut [u32], count: usize) -> Result<Vec<u32>> {
    let most = most_load(loads, count);
    let mut wishes = Vec::new();
    for (rank, share) in (0..).zip(shares) {
        for (partition, has) in words_of(share).enumerate() {
            wishes.try_push((u64::MAX - has, partition, rank))?;
        }
    }
    wishes.sort_unstable();
    let mut owners = filled(count, u32::MAX)?;
    for (_, partition, rank) in wishes {
        if owners[partition] == u32::MAX && loads[rank as usize] < most {
            owners[partition] = rank;
            loads[rank as usize] += 1;
        }
    }
    Ok(owners)
}

/// Returns the least load of the rank with most, if `count` more partitions are made.
fn most_load(loads: &[u32], count: usize) -> u32 {
    let room =
        |most: u32| loads.iter().map(|&load| most.saturating_sub(load) as usize).sum::<usize>();
    let mut most = 0;
    while room(most) < count {
        most += 1;
    }
    most
}

/// Returns by rank how many partitions of phase 0 it makes.
fn loads_of_all(count: usize, ranks: usize) -> Result<Vec<u32>> {
    let mut loads = filled(ranks, 0)?;
    (0..count).for_each(|partition| loads[owner(partition, count, ranks)] += 1);
    Ok(loads)
}

fn append_piece<const D: usize>(
    message: &mut Vec<u8>,
    partition: u32,
    piece: &Piece<D>,
) -> Result<()> {
    let bytes = piece.to_bytes()?;
    append(message, &[partition.into(), bytes.len() as u64])?;
    Ok(message.try_extend(&bytes)?)
}

fn read_pieces<const D: usize>(
    mut message: &[u8],
    mut take: impl FnMut(u32, Piece<D>) -> AllocResult<()>,
) -> Result<()> {
    while let Some((head, rest)) = message.split_at_checked(16) {
        let head: Vec<u64> = collected(words_of(head))?;
        let (bytes, rest) = rest.split_at((head[1] as usize).min(rest.len()));
        take(head[0] as u32, Piece::from_bytes(bytes)?)?;
        message = rest;
    }
    Ok(())
}

/// Collective. Extracts what the last piece on `rank` has left to do from the pieces of all ranks,
/// with so much around it that it can be done, and does it.
fn make_rest<const D: usize>(
    comm: &dyn Communicator,
    maker: &Maker<D>,
    mut settled: Vec<Piece<D>>,
    rank: usize,
    mut number: u32,
    watch: &mut Watch<'_, '_, '_>,
) -> Result<Vec<Piece<D>>> {
    let mut rings = FIRST_RINGS;
    loop {
        let left = agreed(comm, || match settled.last() {
            Some(last) if comm.rank() == rank && !maker.is_done(last)? => last.unsettled_names(),
            _ => Ok(Vec::new()),
        })?;
        let mut names = all_names(comm, left)?;
        if names.is_empty() {
            return Ok(settled);
        }
        rings *= 2;
        for _ in 0..rings {
            let beside = agreed(comm, || {
                let mut beside = Vec::new();
                for piece in &settled {
                    beside.try_extend(&piece.names_beside(&names)?)?;
                }
                Ok(beside)
            })?;
            names = all_names(comm, beside)?;
        }
        let (kept, messages) = agreed(comm, || take_out(comm, &mut settled, &names, rank))?;
        let received = comm.all_to_all(messages)?;
        number += 1;
        agreed(comm, || {
            let mut pieces = Vec::new();
            for (from, message) in received.iter().enumerate() {
                if from == rank {
                    continue;
                }
                read_pieces(message, |_, piece| pieces.try_push(piece))?;
            }
            if comm.rank() == rank {
                let mut all = kept;
                push_all(&mut all, pieces)?;
                // In the order in which the pieces were made, wherever that was.
                all.sort_by_key(Piece::maker);
                settled.try_push(
                    watch.next(0.1, |progress| maker.refine(all, number, Some(progress)))?,
                )?;
            }
            Ok(())
        })?;
    }
}

/// Takes the simplices beside vertices of these names out of all pieces: those that stay on this
/// rank, if it is that which goes on, and messages with the others.
fn take_out<const D: usize>(
    comm: &dyn Communicator,
    settled: &mut Vec<Piece<D>>,
    names: &[u64],
    rank: usize,
) -> Result<(Vec<Piece<D>>, Vec<Vec<u8>>)> {
    let mut messages = empty_messages(comm.size())?;
    let mut kept = Vec::new();
    for piece in std::mem::take(settled) {
        let (left, taken) = piece.give(0, names)?;
        settled.try_push(left)?;
        let Some(taken) = taken else { continue };
        match comm.rank() == rank {
            true => kept.try_push(taken)?,
            false => append_piece(&mut messages[rank], 0, &taken)?,
        }
    }
    Ok((kept, messages))
}

/// Collective. Returns the names of all ranks, rising.
fn all_names(comm: &dyn Communicator, mut own: Vec<u64>) -> Result<Vec<u64>> {
    own.sort_unstable();
    own.dedup();
    let mut all = all_words(&comm.all_gather(&bytes_of(&own)?)?)?;
    all.sort_unstable();
    all.dedup();
    Ok(all)
}

/// Appends pieces, which are not copied.
fn push_all<T>(list: &mut Vec<T>, pieces: impl IntoIterator<Item = T>) -> Result<()> {
    Ok(pieces.into_iter().try_for_each(|piece| list.try_push(piece))?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn partitions_are_made_where_most_of_them_is_and_by_all_ranks_alike() {
        let owners = |shares: &[&[u64]], count| {
            let mut loads = vec![1; shares.len()];
            let shares: Vec<Vec<u8>> =
                shares.iter().map(|share| bytes_of(share).unwrap()).collect();
            owners_of(&shares, &mut loads, count).unwrap()
        };
        assert_eq!(owners(&[&[5, 9], &[7, 8]], 2), [1, 0]);
        // The third has nothing of any, and takes what others have no room for.
        assert_eq!(owners(&[&[9, 8, 7], &[3, 2, 6], &[0, 0, 0]], 3), [0, 2, 1]);
        assert_eq!(owners(&[&[1, 2, 3, 4, 5], &[0; 5]], 5), [1, 1, 0, 0, 0]);
        assert_eq!(owners(&[&[4], &[4], &[5]], 1), [2]);
        // Those that have made fewer before come first, whatever they have.
        let shares = [[9, 9], [1, 2], [3, 0]].map(|share| bytes_of(&share).unwrap());
        let mut loads = [2, 1, 1];
        assert_eq!(owners_of(&shares, &mut loads, 2).unwrap(), [2, 1]);
        assert_eq!(loads, [2; 3]);
        assert_eq!(loads_of_all(5, 3).unwrap(), [2, 2, 1]);
    }
}
