//! The search of a cavity. Which way it goes no processor can foresee, so it branches seldom: a simplex is
//! written where it may belong, and stays if it does.

use super::{Delaunay, MAX_CORNERS};
use crate::complex::Facet;
use crate::memory::{Array, Fallible, TryGrow, prefetch};

/// The simplices whose D-balls hold a point: what the point's insertion destroys.
#[derive(Default)]
pub(crate) struct Cavity {
    pub simplices: Vec<u32>,
    /// The facets round the cavity, grouped by `simplices`.
    pub boundary: Array<Facet>,
    /// `boundary[starts[i]..starts[i + 1]]` are the facets of `simplices[i]`.
    pub starts: Vec<u32>,
    /// Beside the corners of the first simplex, those of the others: one of each, opposite the facet where
    /// the search came in. A vertex may come more than once.
    pub apices: Vec<u32>,
    /// The search that marked `simplices`.
    pub(super) search: u32,
    /// What the search comes to.
    queue: Array<Found>,
}

/// A simplex in conflict, and the number of its facet where the search came in.
#[derive(Clone, Copy)]
struct Found {
    simplex: u32,
    entry: u32,
}

impl Cavity {
    fn restart(&mut self) {
        self.simplices.clear();
        self.boundary.clear();
        self.starts.clear();
        self.apices.clear();
        self.queue.clear();
    }
}

impl<const D: usize> Delaunay<D> {
    /// Collects into `cavity` all simplices in conflict with `q`, from `start`, which is one.
    pub fn find_cavity(&mut self, start: u32, q: &[f64; D], cavity: &mut Cavity) -> Fallible<()> {
        cavity.restart();
        cavity.search = self.complex.begin_marks();
        self.complex.mark_inside(start);
        // The search came to the first through no facet.
        cavity.queue.try_push(Found { simplex: start, entry: D as u32 + 1 })?;
        let mut next = 0;
        while let Some(&Found { simplex, entry }) = cavity.queue.get(next) {
            next += 1;
            if let Some(ahead) = cavity.queue.get(next) {
                self.prefetch_neighbors(ahead.simplex);
            }
            cavity.queue.make_room(D + 1)?;
            cavity.boundary.make_room(D + 1)?;
            cavity.starts.try_push(cavity.boundary.len() as u32)?;
            cavity.simplices.try_push(simplex)?;
            let entry = entry as usize;
            let mut facets = D + 1;
            if entry <= D {
                cavity.apices.try_push(self.complex.vertices(simplex)[entry])?;
                facets = D;
            }
            let mut neighbors = [0; MAX_CORNERS];
            neighbors[..=D].copy_from_slice(self.complex.neighbors(simplex));
            for index in (0..facets).map(|i| i + usize::from(i >= entry)) {
                let beyond = neighbors[index];
                if self.complex.is_inside(beyond) {
                    continue;
                }
                let mirror = self.complex.index_of_neighbor(beyond, simplex) as u32;
                let is_inside = !self.complex.is_marked(beyond) && self.in_conflict(beyond, q);
                self.complex.mark_either(beyond, is_inside);
                cavity.queue.push_if(is_inside, Found { simplex: beyond, entry: mirror });
                let facet = Facet { simplex, index: index as u32, beyond, mirror };
                cavity.boundary.push_if(!is_inside, facet);
            }
        }
        cavity.starts.try_push(cavity.boundary.len() as u32)?;
        Ok(())
    }

    /// Begins to load what a search that has come to `simplex` will look at next. In the plane a search
    /// is over before that helps.
    #[inline(always)]
    fn prefetch_neighbors(&self, simplex: u32) {
        if D > 2 {
            for &neighbor in self.complex.neighbors(simplex) {
                self.complex.prefetch(neighbor);
                prefetch(std::slice::from_ref(&self.balls[neighbor as usize]));
            }
        }
    }
}
