//! Slivers: tetrahedra with a small dihedral angle, which no bound of radii excludes. The last
//! phase moves Steiner points and inserts some, until no dihedral angle is smaller than asked for.
//!
//! `shape` says how bad a tetrahedron is; the objective is the sum over all. `queue` has those that
//! are bad, the worst first. For each, `moves` tries its vertices at other places, then those of
//! its neighbours; where nothing helps `insertions` finds a further point, which waits among the
//! `offers`. `relaxation` has points that are worth it only after their neighbours have moved, and
//! `removals` takes points out that others have made needless. What a place is worth is judged
//! without a change: the tetrahedra that a point would make are the `cone` over its cavity;
//! `vacancy` is the mesh without a vertex that may move. Changes that may not be worth it are in
//! the `journal` till that is known. `cells` has what the Voronoi aspect needs beside, `sizes` what
//! is asked for.
//!
//! Every change lets the objective fall by [`LEAST_GAIN`] or more, but that every point may be
//! removed once without; so the phase ends. No input moves, nor a vertex of a living cage or of the
//! hull. No simplex goes beyond the bound of the criterion, unless the caller lets the bound give
//! way where all else fails (`beyond`). Simplices with vertices of several domains are let alone.
//! What is left when all efforts fail stays a sliver.

mod beyond;
mod cells;
mod cone;
mod insertions;
mod journal;
mod left;
mod moves;
mod offers;
mod phase;
mod queue;
mod random;
mod relaxation;
mod removals;
mod shape;
mod sizes;
mod vacancy;

use crate::complex::{SimplexId, VertexId};
use crate::delaunay::Delaunay;
use crate::memory::{AllocResult, Array, TryGrow};
use crate::netmesh::cages::domains::Hierarchy;
use crate::netmesh::refinement::size::Sizes;
use crate::netmesh::{Cell, Mesher, State};
use cone::Cone;
use journal::Journal;
use offers::Offers;
use queue::{Queue, Sliver};
use shape::Measure;
use vacancy::Vacancy;

/// A change is worth at least so much; ...
const LEAST_GAIN: f64 = 0.001;

/// ... one for which the bound gives way, about a sliver.
const LEAST_GAIN_BEYOND: f64 = 0.999;

/// What the phase works on beside the mesh.
struct Slivers<const D: usize> {
    measure: Measure,
    /// What a change is worth at least.
    least_gain: f64,
    /// Simplex -> what it adds to the objective; stale for a dead one.
    penalties: Array<f32>,
    /// Vertex -> the number of simplices made when its star changed last.
    changed: Array<u64>,
    queue: Queue,
    offers: Offers<D>,
    /// The phase ends when the mesh has taken as many exact tests.
    most_exact: u64,
    vacancy: Vacancy<D>,
    cone: Cone,
    /// The simplices that filled a hole.
    filled: Vec<SimplexId>,
    /// Ids of vertices that were removed.
    free: Vec<VertexId>,
    /// Changes that may be undone, while there are such.
    journal: Option<Journal<D>>,
}

/// What judges a place looks at.
#[derive(Clone, Copy)]
struct View<'a, const D: usize> {
    delaunay: &'a Delaunay<D>,
    hierarchy: &'a Hierarchy<D>,
    cells: &'a [Cell],
    penalties: &'a [f32],
    measure: &'a Measure,
    sizes: Option<&'a Sizes<'a, D>>,
}

impl<'a, const D: usize> View<'a, D> {
    fn new(
        state: &'a State<D>,
        sizes: Option<&'a Sizes<'a, D>>,
        penalties: &'a [f32],
        measure: &'a Measure,
    ) -> Self {
        let State { delaunay, hierarchy, cells, .. } = state;
        Self { delaunay, hierarchy, cells, penalties, measure, sizes }
    }

    /// What live simplices add to the objective.
    fn sum(&self, simplices: &[SimplexId]) -> f64 {
        simplices.iter().map(|&simplex| f64::from(self.penalties[simplex])).sum()
    }
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// Whether the phase may move `vertex`, as far as that is known without its star.
    fn may_move(&self, vertex: VertexId) -> bool {
        !self.is_input(vertex) && !self.state.hierarchy.cage_of(vertex).is_valid()
    }

    /// Measures simplices that were made, and queues those that are slivers. Some may be dead
    /// again.
    fn weigh(&mut self, created: &[SimplexId], slivers: &mut Slivers<D>) -> AllocResult<()> {
        let bound = self.state.delaunay.complex().simplex_bound();
        slivers.penalties.cover(bound, 0.0)?;
        slivers.changed.cover(self.state.delaunay.point_count(), 0)?;
        self.state.refine_list.forget(created, bound)?;
        let now = self.now();
        for &simplex in created {
            let penalty = self.penalty(simplex, &slivers.measure);
            slivers.penalties[simplex] = penalty;
            self.note_corner(simplex);
            for &vertex in self.state.delaunay.complex().vertices(simplex) {
                if vertex.is_valid() {
                    slivers.changed[vertex] = now;
                }
            }
            if penalty > 0.0 {
                let sliver = self.sliver(simplex, penalty);
                match &mut slivers.journal {
                    Some(journal) => journal.fresh.try_push(sliver)?,
                    None => slivers.queue.push(sliver)?,
                }
            }
        }
        Ok(())
    }

    /// The number of simplices made so far.
    fn now(&self) -> u64 {
        self.state.delaunay.simplices_created()
    }

    /// The same for the simplices of a vertex that went in.
    fn weigh_cone(&mut self, slivers: &mut Slivers<D>) -> AllocResult<()> {
        let created = std::mem::take(&mut self.scratch.created);
        let weighed = self.weigh(&created, slivers);
        self.scratch.created = created;
        weighed
    }

    fn penalty(&self, simplex: SimplexId, measure: &Measure) -> f32 {
        let complex = self.state.delaunay.complex();
        let vertices = complex.vertices(simplex);
        let is_judged = complex.is_live(simplex)
            && !complex.is_infinite(simplex)
            && self.state.hierarchy.same_domain(vertices);
        match is_judged {
            true => measure.penalty(&shape::corners(&self.state.delaunay, vertices)) as f32,
            false => 0.0,
        }
    }

    fn sliver(&self, simplex: SimplexId, penalty: f32) -> Sliver {
        let vertices = self.state.delaunay.complex().vertices(simplex);
        let mut vertices: [VertexId; 4] = std::array::from_fn(|index| vertices[index]);
        vertices.sort_unstable();
        Sliver { penalty, simplex, vertices }
    }

    /// Whether `sliver` is still what it was when it was queued. Its id may be that of another
    /// simplex now; or of one with the same vertices, which have moved.
    fn is_current(&self, sliver: &Sliver, penalties: &[f32]) -> bool {
        let complex = self.state.delaunay.complex();
        let is_own = |vertex: &VertexId| sliver.vertices.contains(vertex);
        complex.is_live(sliver.simplex)
            && penalties[sliver.simplex] == sliver.penalty
            && complex.vertices(sliver.simplex).iter().all(is_own)
    }
}
