//! Conflict lists (§6.2): every uninserted input is on the list of one simplex whose D-ball holds
//! it.
//!
//! The paper keeps a point on the lists of all D-balls that hold it. One list suffices. Those balls
//! form the point's cavity, which its insertion searches anyway. When the simplex is destroyed one
//! of the new balls holds the point: a ball through the new vertex and the point, empty of all
//! others, lies in the destroyed ball, so the two would be Delaunay neighbours.

use crate::complex::{LocalToGlobal, PartitionIds, SimplexId, VertexId};
use crate::delaunay::{Cavity, Delaunay};
use crate::error::Result;
use crate::memory::{AllocResult, Array, TryGrow};
use crate::netmesh::state::watch::Watch;

#[derive(Clone, Copy)]
struct Entry {
    /// The next entry of the same list.
    next: VertexId,
    /// The number of entries from this one to the end of the list. With simplices, of which there
    /// are many more than inputs, it would take more memory.
    count: u32,
    /// The simplex whose list this is on; none once the input is inserted.
    simplex: SimplexId,
    /// Touches, as in Definition 9.
    touches: u32,
}

impl Entry {
    const UNASSIGNED: Self =
        Self { next: VertexId::NONE, count: 0, simplex: SimplexId::NONE, touches: 0 };
}

pub(in crate::netmesh) struct ConflictLists {
    /// Simplex -> the first entry of its list; none if that is empty.
    lists: Array<VertexId>,
    /// Input -> its entry.
    inputs: Array<Entry>,
    remaining: usize,
    /// The number of uninserted inputs that are suspended.
    suspended: usize,
}

/// The entries of one list.
pub(in crate::netmesh) struct Entries<'a> {
    inputs: &'a [Entry],
    current: VertexId,
}

impl Iterator for Entries<'_> {
    type Item = VertexId;

    fn next(&mut self) -> Option<VertexId> {
        if !self.current.is_valid() {
            return None;
        }
        let input = self.current;
        self.current = self.inputs[input].next;
        Some(input)
    }
}

impl ConflictLists {
    pub fn new(inputs: usize) -> AllocResult<Self> {
        Ok(Self {
            lists: Array::new(),
            inputs: Array::filled(inputs, Entry::UNASSIGNED)?,
            remaining: inputs,
            suspended: 0,
        })
    }

    /// Returns the number of uninserted inputs that are not suspended.
    pub fn remaining(&self) -> usize {
        self.remaining
    }

    /// Returns the number of uninserted inputs.
    pub fn uninserted(&self) -> usize {
        self.remaining + self.suspended
    }

    pub fn simplex_of(&self, input: VertexId) -> SimplexId {
        self.inputs[input].simplex
    }

    /// Returns the number of inputs on the list of `simplex`.
    pub fn count(&self, simplex: SimplexId) -> u32 {
        self.inputs.get(self.first(simplex).index()).map_or(0, |entry| entry.count)
    }

    pub fn entries(&self, simplex: SimplexId) -> Entries<'_> {
        Entries { inputs: &self.inputs, current: self.first(simplex) }
    }

    /// Returns the first entry of the list of `simplex`; none if that is empty.
    fn first(&self, simplex: SimplexId) -> VertexId {
        // Simplices made after the last input went in are not covered.
        self.lists.get(simplex.index()).copied().unwrap_or(VertexId::NONE)
    }

    /// Touches of `input` so far.
    pub fn touches_mut(&mut self, input: VertexId) -> &mut u32 {
        &mut self.inputs[input].touches
    }

    pub fn total_touches(&self) -> u64 {
        self.inputs.iter().map(|input| u64::from(input.touches)).sum()
    }

    pub fn max_touches(&self) -> u32 {
        self.inputs.iter().map(|input| input.touches).max().unwrap_or(0)
    }

    /// Makes empty lists for the simplices below `bound`.
    pub fn cover(&mut self, bound: usize) -> AllocResult<()> {
        self.lists.cover(bound, VertexId::NONE)
    }

    /// Reserves memory for the lists of `simplices` simplices if the system gives it.
    pub fn expect(&mut self, simplices: usize) {
        self.lists.expect(simplices);
    }

    /// Counts an input that was inserted before lists were made.
    pub fn dismiss_unassigned(&mut self) {
        self.remaining -= 1;
    }

    /// Puts `input`, which is on no list, on that of `simplex`.
    pub fn assign(&mut self, input: VertexId, simplex: SimplexId) {
        let next = std::mem::replace(&mut self.lists[simplex], input);
        let count = 1 + self.inputs.get(next.index()).map_or(0, |entry| entry.count);
        let entry = &mut self.inputs[input];
        (entry.next, entry.count, entry.simplex) = (next, count, simplex);
    }

    /// Frees the lists when all inputs are inserted.
    pub fn free_lists(&mut self) {
        debug_assert!(self.uninserted() == 0);
        self.lists = Array::new();
    }

    /// Suspends all uninserted inputs: from now on their simplices are not replaced, so they are
    /// not redistributed.
    pub fn suspend(&mut self) {
        self.suspended = std::mem::take(&mut self.remaining);
    }

    /// Ends the suspension.
    pub fn resume(&mut self) {
        self.remaining = std::mem::take(&mut self.suspended);
    }

    /// Empties all lists, whose entries are on none then.
    pub fn empty_lists(&mut self) {
        self.lists.fill(VertexId::NONE);
    }

    /// Splits the spare memory for lists: `reserves` has the number of simplices for each share.
    /// `None` if it is not enough.
    pub fn split_reserve(
        &mut self,
        reserves: &[usize],
        bound: usize,
    ) -> Option<Vec<Array<VertexId>>> {
        self.cover(bound).ok()?;
        self.lists.split_reserve(reserves)
    }

    /// Moves to `reserve`, which is empty.
    pub fn move_to(&mut self, reserve: Array<VertexId>) -> AllocResult<()> {
        self.lists.move_into(reserve)
    }

    /// Returns the conflict lists of a partition, which were emptied. Its `inputs` inputs are the
    /// first of its vertices.
    pub fn partition(&self, ids: &PartitionIds<'_>, inputs: usize) -> Result<Self> {
        let PartitionIds { local_to_global, global_to_local } = ids;
        let mut partition = Self::new(inputs)?;
        partition.cover(local_to_global.simplices.len())?;
        for (local, &input) in VertexId::below(inputs).zip(&local_to_global.vertices) {
            partition.assign(local, global_to_local.simplices[self.simplex_of(input)]);
        }
        Ok(partition)
    }

    /// Takes over the lists of a partition that has joined. Its simplices are the last of `bound`.
    pub fn join(
        &mut self,
        mut partition: Self,
        local_to_global: &LocalToGlobal,
        bound: usize,
    ) -> AllocResult<()> {
        partition.lists.fill(VertexId::NONE);
        partition.cover(local_to_global.simplices.len())?;
        self.cover(bound - local_to_global.simplices.len())?;
        self.lists.absorb(partition.lists)?;
        for (&input, entry) in local_to_global.vertices.iter().zip(&partition.inputs) {
            self.inputs[input].touches += entry.touches;
            if entry.simplex.is_valid() {
                self.assign(input, local_to_global.simplices[entry.simplex]);
            } else {
                self.inputs[input].simplex = SimplexId::NONE;
                self.remaining -= 1;
            }
        }
        Ok(())
    }

    /// Redistributes the inputs of the destroyed `cavity` to the lists of the `created` simplices.
    /// `inserted` leaves, if it was an input.
    pub fn redistribute<const D: usize>(
        &mut self,
        delaunay: &Delaunay<D>,
        cavity: &Cavity,
        created: &[SimplexId],
        inserted: VertexId,
        watch: &mut Watch<'_, '_>,
    ) -> Result<()> {
        if self.remaining == 0 {
            return Ok(());
        }
        self.cover(delaunay.complex().simplex_bound())?;
        for (at, &simplex) in cavity.simplices.iter().enumerate() {
            let mut input = std::mem::replace(&mut self.lists[simplex], VertexId::NONE);
            if !input.is_valid() {
                continue;
            }
            let own = cavity.starts[at] as usize..cavity.starts[at + 1] as usize;
            let mut guess = created[own.start.min(created.len() - 1)];
            while input.is_valid() {
                watch.poll_after(4)?;
                let next = self.inputs[input].next;
                if input == inserted {
                    self.inputs[input].simplex = SimplexId::NONE;
                    self.remaining -= 1;
                } else {
                    guess = self.find_ball(delaunay, inserted, created, guess, input);
                    self.assign(input, guess);
                }
                input = next;
            }
        }
        Ok(())
    }

    /// Returns a simplex of the star of `apex` whose D-ball holds `input`. `guess` is one of the
    /// star. The balls' centres are the corners of the Voronoi cell of `apex`, and the power of
    /// `input` to the balls is linear on it: a walk along the cell's edges on which it falls ends
    /// where it is least. Where rounding ends the walk before, or the cell is not bounded, all
    /// balls are tried.
    fn find_ball<const D: usize>(
        &mut self,
        delaunay: &Delaunay<D>,
        apex: VertexId,
        created: &[SimplexId],
        guess: SimplexId,
        input: VertexId,
    ) -> SimplexId {
        let q = delaunay.point(input);
        let touches = &mut self.inputs[input].touches;
        if holds(delaunay, guess, q, touches) {
            return guess;
        }
        let complex = delaunay.complex();
        let (mut previous, mut current) = (guess, guess);
        let mut power = delaunay.power(guess, q);
        'walk: loop {
            let across = complex.neighbors(current).iter().zip(complex.vertices(current));
            for (&neighbor, &opposite) in across {
                if opposite == apex || neighbor == previous {
                    continue;
                }
                if holds(delaunay, neighbor, q, touches) {
                    return neighbor;
                }
                let lower = delaunay.power(neighbor, q);
                if lower < power {
                    (previous, current, power) = (current, neighbor, lower);
                    continue 'walk;
                }
            }
            break;
        }
        let mut others = created.iter().copied();
        let found = others.find(|&simplex| holds(delaunay, simplex, q, touches));
        found.expect("a D-ball of the new vertex's star holds every input of the cavity")
    }
}

/// Returns true if the D-ball of a simplex holds a point, and counts the touch. As a closure it is
/// inlined or not as the compiler weighs, and costs a call if not.
#[inline(always)]
fn holds<const D: usize>(
    delaunay: &Delaunay<D>,
    simplex: SimplexId,
    q: &[f64; D],
    touches: &mut u32,
) -> bool {
    *touches += 1;
    delaunay.in_conflict(simplex, q)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::Random;

    /// Inserts the vertices of a large simplex and then `points` in their order, each from the
    /// simplex that it is assigned to. Returns the touches of all, and how often an input was
    /// redistributed.
    fn insert_all<const D: usize>(points: &[[f64; D]]) -> (u64, u64) {
        let inputs = || VertexId::below(points.len());
        let mut all = points.to_vec();
        all.push([-10.0; D]);
        for axis in 0..D {
            let mut corner = [-10.0; D];
            corner[axis] = 40.0 * D as f64;
            all.push(corner);
        }
        let corners: Vec<_> = VertexId::range(points.len()..all.len()).collect();
        let mut delaunay = Delaunay::new(Array::copied(&all).unwrap()).unwrap();
        delaunay.begin(&corners).unwrap();
        let mut conflict_lists = ConflictLists::new(points.len()).unwrap();
        conflict_lists.cover(delaunay.complex().simplex_bound()).unwrap();
        let first = delaunay.finite_near(delaunay.complex().incident(corners[0]));
        inputs().for_each(|input| conflict_lists.assign(input, first));
        let mut watch = Watch::new(None);
        let (mut cavity, mut created, mut moves) = (Cavity::default(), Vec::new(), 0);
        for input in inputs() {
            let q = *delaunay.point(input);
            delaunay.find_cavity(conflict_lists.simplex_of(input), &q, &mut cavity).unwrap();
            let lists: Vec<_> = inputs().map(|other| conflict_lists.simplex_of(other)).collect();
            delaunay.insert(input, &cavity, &mut created).unwrap();
            conflict_lists.redistribute(&delaunay, &cavity, &created, input, &mut watch).unwrap();
            for other in inputs().filter(|&other| other > input) {
                let list = conflict_lists.simplex_of(other);
                assert!(delaunay.complex().is_live(list));
                assert!(delaunay.in_conflict(list, delaunay.point(other)));
                moves += u64::from(cavity.simplices.contains(&lists[other]));
            }
        }
        assert_eq!(conflict_lists.remaining(), 0);
        (conflict_lists.total_touches(), moves)
    }

    fn check_walks<const D: usize>(most: f64) {
        let mut random = Random(5 + D as u64);
        let points: Vec<[f64; D]> =
            (0..400).map(|_| std::array::from_fn(|_| random.unit())).collect();
        let (touches, moves) = insert_all(&points);
        let tests = touches as f64 / moves as f64;
        assert!((1.0..most).contains(&tests), "{tests} D-balls tested for a list in {D}D");
    }

    #[test]
    fn conflict_lists_are_found_in_few_steps() {
        check_walks::<2>(1.6);
        check_walks::<3>(2.1);
        check_walks::<4>(2.8);
        check_walks::<5>(3.5);
    }

    #[test]
    fn conflict_lists_are_found_where_powers_overflow_or_vanish() {
        let mut random = Random(3);
        let mut nested = Vec::new();
        for level in 0..40 {
            let size = 2f64.powi(-25 * level);
            nested.push([size * random.unit(), size * random.unit(), size * random.unit()]);
        }
        insert_all(&nested);
    }
}
