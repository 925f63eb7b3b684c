//! INSERT, second half (§6.3): a vertex goes into the Voronoi diagram, and what that changes around
//! it is brought up to date: conflict lists, nearest distances, clearances of cages, and which
//! cells are bad.

use crate::complex::VertexId;
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::AllocResult;
use crate::netmesh::{Cell, Mesher};
use crate::numerics::distance;
use crate::options::Algorithm;

impl<const D: usize> Mesher<'_, '_, D> {
    /// INSERT, second half: adds `vertex`, whose domain is set, to the Voronoi diagram. Then
    /// updates conflict lists, nearest distances and the refine list.
    pub(in crate::netmesh) fn insert_into_cavity(
        &mut self,
        vertex: VertexId,
        cavity: &Cavity,
    ) -> Result<()> {
        if self.state.segments.is_active() {
            self.note_insertion_near_segments(vertex, cavity)?;
        }
        self.insert_noted(vertex, cavity)
    }

    /// The same for a vertex that encroaches no subsegment.
    pub(in crate::netmesh) fn insert_off_segments(
        &mut self,
        vertex: VertexId,
        cavity: &Cavity,
    ) -> Result<()> {
        if self.state.segments.is_active() {
            self.note_insertion_off_segments(cavity)?;
        }
        self.insert_noted(vertex, cavity)
    }

    fn insert_noted(&mut self, vertex: VertexId, cavity: &Cavity) -> Result<()> {
        let created = &mut self.scratch.created;
        let work = 4 * cavity.boundary.len() as u32;
        self.state.delaunay.insert(vertex, cavity, created)?;
        self.state.conflict_lists.redistribute(
            &self.state.delaunay,
            cavity,
            created,
            vertex,
            &mut self.watch,
        )?;
        self.state.refine_list.forget(created, self.state.delaunay.complex().simplex_bound())?;
        self.state.interface.forget(created);
        let bound = self.state.delaunay.complex().simplex_bound();
        self.state.segments.regions.note_created(created, bound)?;
        if self.state.parameters.algorithm != Algorithm::Delaunay {
            self.update_star(vertex, cavity)?;
            if self.state.parameters.instruments {
                self.observe_insertion(vertex)?;
            }
        }
        if self.state.parameters.algorithm == Algorithm::Svr {
            self.queue_crowded()?;
        }
        if self.watch.is_due(work) {
            self.report_progress()?;
        }
        Ok(())
    }

    /// Nearest distances, cages' clearances and the quality of cells after `vertex` went in. Its
    /// neighbours are the corners of its cavity: no vertex is inside that, for all keep a star.
    fn update_star(&mut self, vertex: VertexId, cavity: &Cavity) -> AllocResult<()> {
        let mut nearest = f64::INFINITY;
        let neighbors: &[VertexId] = &cavity.vertices.ids;
        let x = *self.state.delaunay.point(vertex);
        let mut nearer = std::mem::take(&mut self.scratch.nearer);
        nearer.clear();
        nearer.reserve(neighbors.len())?;
        let cells: &mut [Cell] = &mut self.state.cells;
        for &neighbor in neighbors {
            let distance = distance(&x, self.state.delaunay.point(neighbor));
            nearest = nearest.min(distance);
            let cell = &mut cells[neighbor];
            let is_nearer = distance < cell.nearest;
            cell.nearest = if is_nearer { distance } else { cell.nearest };
            nearer.push_if(is_nearer, neighbor);
        }
        cells[vertex].nearest = nearest;
        let in_same_domain = self.state.hierarchy.same_domain(neighbors)
            && self.state.hierarchy.same_domain(&[vertex, neighbors[0]]);
        if !in_same_domain {
            self.update_clearances(vertex, neighbors)?;
        }
        self.examine_created(in_same_domain)?;
        for &neighbor in &nearer {
            self.examine_cell(neighbor)?;
        }
        self.scratch.nearer = nearer;
        Ok(())
    }

    /// After `vertex` went in: it and its neighbours may be the nearest outside of each other's
    /// cages.
    pub(in crate::netmesh) fn update_clearances(
        &mut self,
        vertex: VertexId,
        neighbors: &[VertexId],
    ) -> AllocResult<()> {
        for &neighbor in neighbors {
            if self.state.hierarchy.same_domain(&[vertex, neighbor]) {
                continue;
            }
            let mut inner = self.state.hierarchy.domain_of(vertex);
            let mut other = self.state.hierarchy.domain_of(neighbor);
            while inner != other {
                let climb = self.state.hierarchy.node(inner).radius
                    < self.state.hierarchy.node(other).radius;
                let (cage, outside) = if climb { (inner, neighbor) } else { (other, vertex) };
                let before = self.state.hierarchy.node(cage).outside;
                self.separate(cage, outside);
                // An infinite clearance is that of a cage in the making.
                if self.state.hierarchy.node(cage).outside < before && before.is_finite() {
                    self.examine_union_cell(cage)?;
                }
                let parent = self.state.hierarchy.parent(cage);
                if climb { inner = parent } else { other = parent }
            }
        }
        Ok(())
    }

    /// Returns the uninserted input nearest to `x` within `max_distance`, among the conflict lists
    /// of
    /// `cavity`, which is that of `x`. An input at `x` itself is within any distance, also one that
    /// has become zero among subnormal numbers: no other vertex may take its place.
    pub(in crate::netmesh) fn input_near(
        &mut self,
        x: &[f64; D],
        max_distance: f64,
        cavity: &Cavity,
    ) -> Result<Option<VertexId>> {
        if self.state.conflict_lists.remaining() == 0 {
            return Ok(None);
        }
        let mut best = None;
        let mut least = max_distance;
        for at in 0..cavity.simplices.len() {
            let simplex = cavity.simplices[at];
            for input in self.state.conflict_lists.entries(simplex) {
                self.watch.poll_after(1)?;
                let distance = distance(x, self.state.delaunay.point(input));
                if distance < least || distance == 0.0 {
                    least = distance;
                    best = Some(input);
                }
            }
        }
        Ok(best)
    }

    /// The nearest distance of a corner of the first simplex; its farthest corner is not known.
    pub(in crate::netmesh) fn measure_nearest(&mut self, vertex: VertexId) {
        let simplex = self.state.delaunay.complex().incident(vertex);
        let x = self.state.delaunay.point(vertex);
        let nearest = self
            .state
            .delaunay
            .complex()
            .vertices(simplex)
            .iter()
            .filter(|&&other| other.is_valid() && other != vertex)
            .map(|&other| distance(x, self.state.delaunay.point(other)))
            .fold(f64::INFINITY, f64::min);
        self.state.cells[vertex].nearest = nearest;
        self.state.cells[vertex].farthest = f64::INFINITY;
    }
}
