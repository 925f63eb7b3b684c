//! Where the uninserted inputs are (§6.2): each has one home, a simplex whose D-ball holds it.
//!
//! The paper keeps a point in every D-ball that holds it. One home suffices: those balls form the
//! point's cavity, which its insertion searches anyway, and when a home is destroyed one of the new
//! balls holds the point (a ball through the new vertex and the point, empty of all others, lies in
//! the destroyed ball, so the two would be Delaunay neighbours).

use super::watch::Watch;
use crate::delaunay::{Cavity, Delaunay};
use crate::error::Result;
use crate::memory::{Fallible, TryGrow, expect, filled};
use crate::mesh::NONE;

pub(super) struct Location {
    /// Simplex -> its first input.
    heads: Vec<u32>,
    /// Simplex -> number of its inputs.
    counts: Vec<u32>,
    /// Input -> the next one of the same home.
    next: Vec<u32>,
    /// Input -> home, [`NONE`] once inserted.
    homes: Vec<u32>,
    /// Definition 9, counted for every input.
    touches: Vec<u32>,
    remaining: usize,
}

/// The inputs of one simplex.
pub(super) struct Inhabitants<'a> {
    next: &'a [u32],
    current: u32,
}

impl Iterator for Inhabitants<'_> {
    type Item = u32;

    fn next(&mut self) -> Option<u32> {
        if self.current == NONE {
            return None;
        }
        let input = self.current;
        self.current = self.next[input as usize];
        Some(input)
    }
}

impl Location {
    pub fn new(inputs: usize) -> Fallible<Self> {
        Ok(Self {
            heads: Vec::new(),
            counts: Vec::new(),
            next: filled(inputs, NONE)?,
            homes: filled(inputs, NONE)?,
            touches: filled(inputs, 0)?,
            remaining: inputs,
        })
    }

    /// Number of uninserted inputs.
    pub fn remaining(&self) -> usize {
        self.remaining
    }

    pub fn home(&self, input: u32) -> u32 {
        self.homes[input as usize]
    }

    /// Number of inputs of `simplex`.
    pub fn count(&self, simplex: u32) -> u32 {
        // Simplices made after the last input went in are not covered.
        self.counts.get(simplex as usize).copied().unwrap_or(0)
    }

    pub fn inhabitants(&self, simplex: u32) -> Inhabitants<'_> {
        Inhabitants { next: &self.next, current: self.heads[simplex as usize] }
    }

    pub fn total_touches(&self) -> u64 {
        self.touches.iter().map(|&t| u64::from(t)).sum()
    }

    pub fn max_touches(&self) -> u32 {
        self.touches.iter().copied().max().unwrap_or(0)
    }

    /// Largest number of inputs in one home.
    pub fn max_count(&self) -> u32 {
        self.counts.iter().copied().max().unwrap_or(0)
    }

    /// Makes room for inputs in the simplices below `bound`.
    pub fn cover(&mut self, bound: usize) -> Fallible<()> {
        self.heads.cover(bound, NONE)?;
        self.counts.cover(bound, 0)
    }

    /// Makes room for so many simplices if the system gives it.
    pub fn expect(&mut self, simplices: usize) {
        expect(&mut self.heads, simplices);
        expect(&mut self.counts, simplices);
    }

    /// An input that was inserted before inputs got homes.
    pub fn dismiss_homeless(&mut self) {
        self.remaining -= 1;
    }

    /// Makes `simplex` the home of `input`, which has none.
    pub fn settle(&mut self, input: u32, simplex: u32) {
        let at = simplex as usize;
        self.next[input as usize] = self.heads[at];
        self.heads[at] = input;
        self.counts[at] += 1;
        self.homes[input as usize] = simplex;
    }

    /// Finds new homes for the inputs of the destroyed `cavity` among the `created` simplices;
    /// `inserted`, if it was an input, leaves.
    pub fn rehome<const D: usize>(
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
            let mut input = std::mem::replace(&mut self.heads[simplex as usize], NONE);
            if input == NONE {
                continue;
            }
            self.counts[simplex as usize] = 0;
            let own = cavity.starts[at] as usize..cavity.starts[at + 1] as usize;
            let mut guess = own.start.min(created.len() - 1);
            while input != NONE {
                watch.tick(4)?;
                let next = self.next[input as usize];
                if input == inserted {
                    self.homes[input as usize] = NONE;
                    self.remaining -= 1;
                } else {
                    guess = self.find_home(delaunay, created, guess, input);
                    self.settle(input, created[guess]);
                }
                input = next;
            }
        }
        Ok(())
    }

    /// Position in `created` of a D-ball that holds `input`, tried outward from `guess`.
    fn find_home<const D: usize>(
        &mut self,
        delaunay: &Delaunay<D>,
        created: &[u32],
        guess: usize,
        input: u32,
    ) -> usize {
        let q = delaunay.point(input);
        let (before, after) = created.split_at(guess);
        for (tried, &simplex) in after.iter().chain(before).enumerate() {
            if delaunay.in_conflict(simplex, q) {
                self.touches[input as usize] += tried as u32 + 1;
                return (guess + tried) % created.len();
            }
        }
        unreachable!("a D-ball of the new vertex's star holds every input of the cavity")
    }
}
