//! Where the uninserted inputs are (§6.2): each has one home, a simplex whose D-ball holds it.
//!
//! The paper keeps a point in every D-ball that holds it. One home suffices: those balls form the
//! point's cavity, which its insertion searches anyway, and when a home is destroyed one of the new
//! balls holds the point (a ball through the new vertex and the point, empty of all others, lies in
//! the destroyed ball, so the two would be Delaunay neighbours).

use crate::complex::LocalToGlobal;
use crate::delaunay::{Cavity, Delaunay};
use crate::error::Result;
use crate::memory::{AllocResult, Array, TryGrow};
use crate::mesh::NONE;
use crate::netmesh::watch::Watch;

/// What a simplex is as a home.
#[derive(Clone, Copy)]
pub(in crate::netmesh) struct Home {
    /// Its first input, and the number of its inputs.
    first: u32,
    count: u32,
}

impl Home {
    const EMPTY: Self = Self { first: NONE, count: 0 };
}

#[derive(Clone, Copy)]
struct Entry {
    /// The next input of the same home.
    next: u32,
    /// [`NONE`] once inserted.
    home: u32,
    /// Definition 9.
    touches: u32,
}

impl Entry {
    const UNASSIGNED: Self = Self { next: NONE, home: NONE, touches: 0 };
}

pub(in crate::netmesh) struct ConflictLists {
    /// By simplex.
    homes: Array<Home>,
    /// By input.
    inputs: Array<Entry>,
    remaining: usize,
    /// Uninserted inputs that rest.
    suspended: usize,
}

/// The inputs of one simplex.
pub(in crate::netmesh) struct Entries<'a> {
    inputs: &'a [Entry],
    current: u32,
}

impl Iterator for Entries<'_> {
    type Item = u32;

    fn next(&mut self) -> Option<u32> {
        if self.current == NONE {
            return None;
        }
        let input = self.current;
        self.current = self.inputs[input as usize].next;
        Some(input)
    }
}

impl ConflictLists {
    pub fn new(inputs: usize) -> AllocResult<Self> {
        Ok(Self {
            homes: Array::new(),
            inputs: Array::filled(inputs, Entry::UNASSIGNED)?,
            remaining: inputs,
            suspended: 0,
        })
    }

    /// Number of uninserted inputs that do not rest.
    pub fn remaining(&self) -> usize {
        self.remaining
    }

    /// Number of uninserted inputs.
    pub fn uninserted(&self) -> usize {
        self.remaining + self.suspended
    }

    pub fn simplex_of(&self, input: u32) -> u32 {
        self.inputs[input as usize].home
    }

    /// Number of inputs of `simplex`.
    pub fn count(&self, simplex: u32) -> u32 {
        // Simplices made after the last input went in are not covered.
        self.homes.get(simplex as usize).map_or(0, |home| home.count)
    }

    pub fn entries(&self, simplex: u32) -> Entries<'_> {
        Entries { inputs: &self.inputs, current: self.homes[simplex as usize].first }
    }

    /// Touches of `input` so far.
    pub fn touches_mut(&mut self, input: u32) -> &mut u32 {
        &mut self.inputs[input as usize].touches
    }

    pub fn total_touches(&self) -> u64 {
        self.inputs.iter().map(|input| u64::from(input.touches)).sum()
    }

    pub fn max_touches(&self) -> u32 {
        self.inputs.iter().map(|input| input.touches).max().unwrap_or(0)
    }

    /// Largest number of inputs in one home.
    pub fn max_count(&self) -> u32 {
        self.homes.iter().map(|home| home.count).max().unwrap_or(0)
    }

    /// Makes room for inputs in the simplices below `bound`.
    pub fn cover(&mut self, bound: usize) -> AllocResult<()> {
        self.homes.cover(bound, Home::EMPTY)
    }

    /// Makes room for so many simplices if the system gives it.
    pub fn expect(&mut self, simplices: usize) {
        self.homes.expect(simplices);
    }

    /// An input that was inserted before inputs got homes.
    pub fn dismiss_unassigned(&mut self) {
        self.remaining -= 1;
    }

    /// Makes `simplex` the home of `input`, which has none.
    pub fn assign(&mut self, input: u32, simplex: u32) {
        let home = &mut self.homes[simplex as usize];
        let inhabitant = &mut self.inputs[input as usize];
        (inhabitant.next, inhabitant.home) = (home.first, simplex);
        home.first = input;
        home.count += 1;
    }

    /// Frees the homes when all inputs are in.
    pub fn free_lists(&mut self) {
        debug_assert!(self.uninserted() == 0);
        self.homes = Array::new();
    }

    /// From now on no home is replaced, and no input inserted: nobody looks after them any more.
    pub fn suspend(&mut self) {
        self.suspended = std::mem::take(&mut self.remaining);
    }

    /// Ends the rest.
    pub fn resume(&mut self) {
        self.remaining = std::mem::take(&mut self.suspended);
    }

    /// Empties the home `simplex`: its inputs, which have none then.
    pub fn take_entries(&mut self, simplex: u32) -> Entries<'_> {
        let home = match self.homes.get_mut(simplex as usize) {
            Some(home) => std::mem::replace(home, Home::EMPTY),
            None => Home::EMPTY,
        };
        Entries { inputs: &self.inputs, current: home.first }
    }

    /// Divides the spare room for homes of simplices, so many for each; `None` if it is not enough.
    pub fn split_reserve(&mut self, reserves: &[usize], bound: usize) -> Option<Vec<Array<Home>>> {
        self.cover(bound).ok()?;
        self.homes.split_reserve(reserves)
    }

    /// Goes on in `room`, which is empty.
    pub fn move_to(&mut self, room: Array<Home>) -> AllocResult<()> {
        self.homes.move_into(room)
    }

    /// The homes of a part, whose simplices were emptied: each of its `inputs`, the first so many of its
    /// vertices, is in the simplex that it was in. `ids`: simplex -> its id in the part.
    pub fn partition(&self, names: &LocalToGlobal, ids: &[u32], inputs: usize) -> Result<Self> {
        let mut partition = Self::new(inputs)?;
        partition.cover(names.simplices.len())?;
        for (own, &input) in names.vertices[..inputs].iter().enumerate() {
            partition.assign(own as u32, ids[self.simplex_of(input) as usize]);
        }
        Ok(partition)
    }

    /// Takes over where the inputs of a part are that has joined: the last of `bound` simplices are its.
    pub fn join(
        &mut self,
        mut partition: Self,
        names: &LocalToGlobal,
        bound: usize,
    ) -> AllocResult<()> {
        partition.homes.fill(Home::EMPTY);
        partition.cover(names.simplices.len())?;
        self.cover(bound - names.simplices.len())?;
        self.homes.absorb(partition.homes)?;
        for (own, inhabitant) in partition.inputs.iter().enumerate() {
            let input = names.vertices[own];
            self.inputs[input as usize].touches += inhabitant.touches;
            match inhabitant.home {
                NONE => {
                    self.inputs[input as usize].home = NONE;
                    self.remaining -= 1;
                }
                home => self.assign(input, names.simplices[home as usize]),
            }
        }
        Ok(())
    }

    /// Finds new homes for the inputs of the destroyed `cavity` among the `created` simplices;
    /// `inserted`, if it was an input, leaves.
    pub fn redistribute<const D: usize>(
        &mut self,
        delaunay: &Delaunay<D>,
        cavity: &Cavity,
        created: &[u32],
        inserted: u32,
        watch: &mut Watch<'_, '_>,
    ) -> Result<()> {
        if self.remaining == 0 {
            return Ok(());
        }
        self.cover(delaunay.complex().simplex_bound())?;
        for (at, &simplex) in cavity.simplices.iter().enumerate() {
            let home = std::mem::replace(&mut self.homes[simplex as usize], Home::EMPTY);
            let mut input = home.first;
            if input == NONE {
                continue;
            }
            let own = cavity.starts[at] as usize..cavity.starts[at + 1] as usize;
            let mut guess = created[own.start.min(created.len() - 1)];
            while input != NONE {
                watch.poll_after(4)?;
                let next = self.inputs[input as usize].next;
                if input == inserted {
                    self.inputs[input as usize].home = NONE;
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

    /// The simplex of the star of `apex` whose D-ball holds `input`, from `guess`, one of them. Their
    /// centres are the corners of the Voronoi cell of `apex`, and the power of `input` to the balls is
    /// linear on it: a walk along the cell's edges on which it falls ends where it is least. Where
    /// rounding ends the walk before, or the cell is not bounded, all balls are tried.
    fn find_ball<const D: usize>(
        &mut self,
        delaunay: &Delaunay<D>,
        apex: u32,
        created: &[u32],
        guess: u32,
        input: u32,
    ) -> u32 {
        let q = delaunay.point(input);
        let touches = &mut self.inputs[input as usize].touches;
        let mut holds = |simplex| {
            *touches += 1;
            delaunay.in_conflict(simplex, q)
        };
        if holds(guess) {
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
                if holds(neighbor) {
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
        let found = created.iter().copied().find(|&simplex| holds(simplex));
        found.expect("a D-ball of the new vertex's star holds every input of the cavity")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::Random;

    /// Inserts the corners of a large simplex and then `points` in their order, each at its home.
    /// Returns the touches of all, and how often an input got a new home.
    fn insert_all<const D: usize>(points: &[[f64; D]]) -> (u64, u64) {
        let count = points.len() as u32;
        let mut all = points.to_vec();
        all.push([-10.0; D]);
        for axis in 0..D {
            let mut corner = [-10.0; D];
            corner[axis] = 40.0 * D as f64;
            all.push(corner);
        }
        let corners: Vec<u32> = (count..=count + D as u32).collect();
        let mut delaunay = Delaunay::new(Array::copied(&all).unwrap()).unwrap();
        delaunay.begin(&corners).unwrap();
        let mut conflict_lists = ConflictLists::new(points.len()).unwrap();
        conflict_lists.cover(delaunay.complex().simplex_bound()).unwrap();
        let first = delaunay.finite_near(delaunay.complex().incident(count));
        (0..count).for_each(|input| conflict_lists.assign(input, first));
        let mut watch = Watch::new(None);
        let (mut cavity, mut created, mut moves) = (Cavity::default(), Vec::new(), 0);
        for input in 0..count {
            let q = *delaunay.point(input);
            delaunay.find_cavity(conflict_lists.simplex_of(input), &q, &mut cavity).unwrap();
            let homes: Vec<u32> =
                (0..count).map(|other| conflict_lists.simplex_of(other)).collect();
            delaunay.insert(input, &cavity, &mut created).unwrap();
            conflict_lists.redistribute(&delaunay, &cavity, &created, input, &mut watch).unwrap();
            for other in input + 1..count {
                let home = conflict_lists.simplex_of(other);
                assert!(delaunay.complex().is_live(home));
                assert!(delaunay.in_conflict(home, delaunay.point(other)));
                moves += u64::from(cavity.simplices.contains(&homes[other as usize]));
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
        assert!((1.0..most).contains(&tests), "{tests} D-balls tested for a home in {D}D");
    }

    #[test]
    fn homes_are_found_in_few_steps() {
        check_walks::<2>(1.6);
        check_walks::<3>(2.1);
        check_walks::<4>(2.8);
        check_walks::<5>(3.5);
    }

    #[test]
    fn homes_are_found_where_powers_overflow_or_vanish() {
        let mut random = Random(3);
        let mut nested = Vec::new();
        for level in 0..40 {
            let size = 2f64.powi(-25 * level);
            nested.push([size * random.unit(), size * random.unit(), size * random.unit()]);
        }
        insert_all(&nested);
    }
}
