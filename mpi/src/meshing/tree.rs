//! Partitions and the tree in which their seams join.

use super::Watch;
use super::partitions::{Share, owner};
use crate::comm::{Communicator, agreed};
use crate::memory::{TryGrow, collected, with_capacity};
use crate::words::{append, bytes_of, words_of};
use netmesh::Result;
use netmesh::distributed::{Coarse, Maker, Piece, RINGS};

/// What is left at the root is taken out with twice so many steps around it, then with four times as
/// many, and so on: in the end that is all.
const FIRST_RINGS: usize = 2;

/// A node of the tree: a run of partitions, whose seam is on one rank.
struct Node<const D: usize> {
    begin: usize,
    end: usize,
    rank: usize,
    /// On that rank: what it left, if anything.
    seam: Option<Piece<D>>,
}

/// Collective: makes all partitions, and what they leave. Answers the settled pieces of this rank.
pub fn make<const D: usize>(
    comm: &dyn Communicator,
    coarse: &Coarse<D>,
    share: Share<D>,
    watch: &mut Watch<'_, '_>,
) -> Result<Vec<Piece<D>>> {
    let Share { pieces, first, count } = share;
    let rank_of = |partition| owner(partition, count, comm.size());
    let mut nodes = with_capacity(count)?;
    for partition in 0..count {
        nodes.push(Node {
            begin: partition,
            end: partition + 1,
            rank: rank_of(partition),
            seam: None,
        });
    }
    let mut settled = Vec::new();
    agreed(comm, || {
        let part = 0.6 / pieces.len() as f64;
        for (partition, piece) in (first..).zip(pieces) {
            let (rest, seam) =
                refine(coarse.maker(), vec![piece], 1 + partition as u32, part, watch)?;
            settled.try_push_one(rest)?;
            nodes[partition].seam = seam;
        }
        Ok(())
    })?;
    let levels = f64::from(usize::BITS - (count - 1).leading_zeros()).max(1.0);
    let (mut number, mut level) = (count as u32, 0);
    while nodes.len() > 1 {
        let next = parents(&nodes, level, rank_of)?;
        let seams = exchange(comm, &mut nodes, &next)?;
        nodes = next;
        agreed(comm, || {
            for ((node, number), mut pieces) in nodes.iter_mut().zip(number + 1..).zip(seams) {
                if pieces.len() == 1 {
                    // Nothing has come to it.
                    node.seam = pieces.pop();
                } else if !pieces.is_empty() {
                    let part = 0.2 / levels;
                    let (rest, seam) = refine(coarse.maker(), pieces, number, part, watch)?;
                    settled.try_push_one(rest)?;
                    node.seam = seam;
                }
            }
            Ok(())
        })?;
        number += nodes.len() as u32;
        level += 1;
    }
    let root = nodes.pop().map(|root| (root.rank, root.seam));
    let (rank, seam) = root.unwrap_or((0, None));
    settled.try_push_all(seam)?;
    make_rest(comm, coarse.maker(), settled, rank, number, watch)
}

/// Refines what `pieces` are together. What is settled, and the seam.
fn refine<const D: usize>(
    maker: &Maker<D>,
    pieces: Vec<Piece<D>>,
    number: u32,
    part: f64,
    watch: &mut Watch<'_, '_>,
) -> Result<(Piece<D>, Option<Piece<D>>)> {
    let made = watch.next(part, |progress| maker.refine(pieces, number, Some(progress)))?;
    made.divide(RINGS, || Ok(()))
}

/// The nodes above, each of two, and the last of one if their number is odd. Their ranks change with
/// the level, so that no rank has more seams than others.
fn parents<const D: usize>(
    nodes: &[Node<D>],
    level: usize,
    rank_of: impl Fn(usize) -> usize,
) -> Result<Vec<Node<D>>> {
    collected(nodes.chunks(2).map(|pair| {
        let (begin, end) = (pair[0].begin, pair[pair.len() - 1].end);
        let rank = match pair {
            [only] => only.rank,
            _ => rank_of(begin + (end - begin) / 2 + level % 2 * ((end - begin) / 4)),
        };
        Node { begin, end, rank, seam: None }
    }))
}

/// Collective: brings the seams of each pair of nodes to the rank of their parent. The pieces that this
/// rank has for each parent.
fn exchange<const D: usize>(
    comm: &dyn Communicator,
    nodes: &mut [Node<D>],
    parents: &[Node<D>],
) -> Result<Vec<Vec<Piece<D>>>> {
    let mut kept: Vec<Option<Piece<D>>> = collected(nodes.iter().map(|_| None))?;
    let messages = agreed(comm, || {
        let mut messages: Vec<Vec<u8>> = collected((0..comm.size()).map(|_| Vec::new()))?;
        for (at, node) in nodes.iter_mut().enumerate() {
            let to = parents[at / 2].rank;
            match node.seam.take() {
                Some(seam) if to == comm.rank() => kept[at] = Some(seam),
                Some(seam) => append_piece(&mut messages[to], at, &seam)?,
                None => {}
            }
        }
        Ok(messages)
    })?;
    let received = comm.all_to_all(messages)?;
    agreed(comm, || {
        for message in &received {
            read_pieces(message, |at, piece| {
                kept[at] = Some(piece);
                Ok(())
            })?;
        }
        let mut pairs = kept.chunks_mut(2);
        let mut seams = with_capacity(parents.len())?;
        for _ in parents {
            let pair = pairs.next().into_iter().flatten();
            seams.push(collected(pair.filter_map(Option::take))?);
        }
        Ok(seams)
    })
}

fn append_piece<const D: usize>(message: &mut Vec<u8>, at: usize, piece: &Piece<D>) -> Result<()> {
    let bytes = piece.to_bytes()?;
    append(message, &[at as u64, bytes.len() as u64])?;
    message.try_extend(&bytes)
}

fn read_pieces<const D: usize>(
    mut message: &[u8],
    mut take: impl FnMut(usize, Piece<D>) -> Result<()>,
) -> Result<()> {
    while let Some((head, rest)) = message.split_at_checked(16) {
        let head: Vec<u64> = collected(words_of(head))?;
        let (bytes, rest) = rest.split_at((head[1] as usize).min(rest.len()));
        take(head[0] as usize, Piece::from_bytes(bytes)?)?;
        message = rest;
    }
    Ok(())
}

/// Collective: what the last piece on `rank` has left to do is taken out of the pieces of all ranks,
/// with so much around it that it can be done.
fn make_rest<const D: usize>(
    comm: &dyn Communicator,
    maker: &Maker<D>,
    mut settled: Vec<Piece<D>>,
    rank: usize,
    mut number: u32,
    watch: &mut Watch<'_, '_>,
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
                read_pieces(message, |_, piece| pieces.try_push_one(piece))?;
            }
            if comm.rank() == rank {
                let mut all = kept;
                all.try_push_all(pieces)?;
                // In the order in which the pieces were made, wherever that was.
                all.sort_by_key(Piece::maker);
                settled.try_push_one(
                    watch.next(0.1, |progress| maker.refine(all, number, Some(progress)))?,
                )?;
            }
            Ok(())
        })?;
    }
}

/// Takes the simplices beside vertices of these names out of all pieces: those that stay on this rank,
/// if it is that which goes on, and messages with the others.
fn take_out<const D: usize>(
    comm: &dyn Communicator,
    settled: &mut Vec<Piece<D>>,
    names: &[u64],
    rank: usize,
) -> Result<(Vec<Piece<D>>, Vec<Vec<u8>>)> {
    let mut messages: Vec<Vec<u8>> = collected((0..comm.size()).map(|_| Vec::new()))?;
    let mut kept = Vec::new();
    for (at, piece) in std::mem::take(settled).into_iter().enumerate() {
        let (left, taken) = piece.take_out(names)?;
        settled.try_push_one(left)?;
        if taken.simplex_count() == 0 {
            continue;
        }
        match comm.rank() == rank {
            true => kept.try_push_one(taken)?,
            false => append_piece(&mut messages[rank], at, &taken)?,
        }
    }
    Ok((kept, messages))
}

/// Collective: the names of all ranks, rising.
fn all_names(comm: &dyn Communicator, mut own: Vec<u64>) -> Result<Vec<u64>> {
    own.sort_unstable();
    own.dedup();
    let mut all = Vec::new();
    for bytes in comm.all_gather(&bytes_of(&own)?)? {
        let names: Vec<u64> = collected(words_of(&bytes))?;
        all.try_extend(&names)?;
    }
    all.sort_unstable();
    all.dedup();
    Ok(all)
}

/// Growth of lists of pieces, which are not copied.
trait Pieces<T> {
    fn try_push_one(&mut self, piece: T) -> Result<()>;
    fn try_push_all(&mut self, pieces: impl IntoIterator<Item = T>) -> Result<()>;
}

impl<T> Pieces<T> for Vec<T> {
    fn try_push_one(&mut self, piece: T) -> Result<()> {
        self.try_push(piece)
    }

    fn try_push_all(&mut self, pieces: impl IntoIterator<Item = T>) -> Result<()> {
        pieces.into_iter().try_for_each(|piece| self.try_push(piece))
    }
}
