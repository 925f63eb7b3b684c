//! The search for a cavity, without branches that a processor cannot predict ([`Array::push_if`]
//! tells why): a simplex is written where it may belong, and stays if it does.

use super::Delaunay;
use super::conflict::Conflicts;
use crate::complex::{Facet, Marking, SimplexId, VertexSet};
use crate::memory::{AllocResult, Array, TryGrow};

/// Simplices whose D-balls hold a point; the insertion of the point destroys them.
#[derive(Default)]
pub(crate) struct Cavity {
    pub simplices: Vec<SimplexId>,
    /// Facets round the cavity, grouped by `simplices`.
    pub boundary: Array<Facet>,
    /// Positions in `boundary`: the facets of `simplices[i]` are `boundary[starts[i]..starts[i +
    /// 1]]`.
    pub starts: Vec<u32>,
    /// Finite vertices of `simplices`: all of the first simplex, then of each further one the
    /// vertex opposite the facet through which the search reached it.
    pub vertices: VertexSet,
    /// False if simplices in conflict were left out. The facets to these are not in `boundary`.
    pub is_whole: bool,
    /// Simplices in conflict that the search has found.
    queue: Array<Found>,
}

/// Simplex in conflict, and the number of its facet through which the search reached it.
#[derive(Clone, Copy)]
struct Found {
    simplex: SimplexId,
    entry: u32,
}

impl Cavity {
    fn restart(&mut self) {
        self.is_whole = true;
        self.simplices.clear();
        self.boundary.clear();
        self.starts.clear();
        self.queue.clear();
    }

    /// Adds `simplex` to the cavity, and reserves memory for its facets.
    #[inline(always)]
    fn begin_simplex<const D: usize>(&mut self, simplex: SimplexId) -> AllocResult<()> {
        self.queue.reserve(D + 1)?;
        self.boundary.reserve(D + 1)?;
        self.starts.try_push(self.boundary.len() as u32)?;
        self.simplices.try_push(simplex)
    }
}

impl<const D: usize> Delaunay<D> {
    /// Collects into `cavity` all simplices in conflict with `q`, from `start`, which is one of
    /// them.
    // Where it is a part of several callers, its innermost loop is a call in all of them.
    #[inline(never)]
    pub fn find_cavity(
        &mut self,
        start: SimplexId,
        q: &[f64; D],
        cavity: &mut Cavity,
    ) -> AllocResult<()> {
        self.find_cavity_within(start, q, cavity, |_, _| true)
    }

    /// Collects the simplices in conflict with `q` that are connected with `start`, which is one of
    /// them, by others that `may_go` is true of, which is told how many were found before. Where
    /// some in conflict are beside these, the cavity is not whole.
    #[inline(always)]
    pub fn find_cavity_within(
        &mut self,
        start: SimplexId,
        q: &[f64; D],
        cavity: &mut Cavity,
        may_go: impl Fn(SimplexId, usize) -> bool,
    ) -> AllocResult<()> {
        let Self { complex, points, balls, exact_fallbacks, .. } = self;
        let mut search = Search {
            marking: complex.marking()?,
            conflicts: Conflicts { points, balls, exact_fallbacks },
            q,
        };
        cavity.restart();
        search.marking.mark_of(start).set_inside(true);
        cavity.begin_simplex::<D>(start)?;
        cavity.vertices.restart(points.len())?;
        for &vertex in search.marking.records().vertices(start) {
            cavity.vertices.insert_finite(vertex)?;
        }
        for index in 0..=D {
            let beyond = search.marking.records().neighbors(start)[index];
            search.cross(start, index, beyond, cavity);
        }
        let mut next = 0;
        while let Some(&Found { simplex, entry }) = cavity.queue.get(next) {
            next += 1;
            if !may_go(simplex, cavity.simplices.len()) {
                cavity.is_whole = false;
                continue;
            }
            if let Some(ahead) = cavity.queue.get(next) {
                search.prefetch_neighbors(ahead.simplex);
            }
            let entry = entry as usize;
            cavity.begin_simplex::<D>(simplex)?;
            cavity.vertices.insert_finite(search.marking.records().vertices(simplex)[entry])?;
            let neighbors = search.marking.records().neighbors(simplex);
            let others: [SimplexId; D] =
                std::array::from_fn(|i| neighbors[i + usize::from(i >= entry)]);
            // Two by name: the compiler does not unroll a loop as long as that.
            search.cross_on(simplex, entry, &others, 0, cavity);
            search.cross_on(simplex, entry, &others, 1, cavity);
            for at in 2..D {
                search.cross_on(simplex, entry, &others, at, cavity);
            }
        }
        search.clear_marks(start, cavity);
        cavity.starts.try_push(cavity.boundary.len() as u32)?;
        Ok(())
    }
}

struct Search<'a, const D: usize> {
    marking: Marking<'a, D>,
    conflicts: Conflicts<'a, D>,
    q: &'a [f64; D],
}

impl<const D: usize> Search<'_, D> {
    /// Crosses facet number `index` of the cavity's `simplex` to `beyond`. A simplex that was
    /// tested already is tested once more: that is faster than a branch which avoids it.
    #[inline(always)]
    fn cross(&mut self, simplex: SimplexId, index: usize, beyond: SimplexId, cavity: &mut Cavity) {
        let Self { marking, conflicts, q } = self;
        let records = marking.records();
        let mirror = records.position_of_neighbor(beyond, simplex);
        let mark = marking.mark_of(beyond);
        let side = conflicts.side(records, beyond, q);
        let is_found = !mark.is_inside()
            & side.unwrap_or_else(|| {
                !mark.is_inside() && conflicts.test_with_care(records, beyond, q)
            });
        let is_inside = is_found | mark.is_inside();
        mark.set_inside(is_inside);
        cavity.queue.push_if(is_found, Found { simplex: beyond, entry: mirror });
        let facet = Facet { simplex, index: index as u32, beyond, mirror };
        cavity.boundary.push_if(!is_inside, facet);
    }

    /// Crosses one of the facets of the cavity's `simplex` but that of its entry, to the neighbour
    /// with the same place in `others`. A closure in its stead is a call of its own or not by the
    /// mood of the compiler, which is a tenth of all time.
    #[inline(always)]
    fn cross_on(
        &mut self,
        simplex: SimplexId,
        entry: usize,
        others: &[SimplexId; D],
        at: usize,
        cavity: &mut Cavity,
    ) {
        self.cross(simplex, at + usize::from(at >= entry), others[at], cavity);
    }

    /// Clears the marks of the simplices in conflict that the search from `start` has found.
    #[inline(always)]
    fn clear_marks(&mut self, start: SimplexId, cavity: &Cavity) {
        self.marking.mark_of(start).set_inside(false);
        for found in &cavity.queue {
            self.marking.mark_of(found.simplex).set_inside(false);
        }
    }

    /// Prefetches the records and D-balls that a search will read next from `simplex`. In the plane
    /// a search is over before that helps.
    #[inline(always)]
    fn prefetch_neighbors(&self, simplex: SimplexId) {
        if D > 2 {
            for &neighbor in self.marking.records().neighbors(simplex) {
                self.marking.records().prefetch(neighbor);
                self.conflicts.prefetch(neighbor);
            }
        }
    }
}
