//! The distances that an insertion changes: those of vertices to their nearest neighbours, and the
//! clearances of cages.

use crate::complex::VertexId;
use crate::delaunay::Cavity;
use crate::memory::AllocResult;
use crate::netmesh::state::hierarchy::DomainId;
use crate::netmesh::state::{Cell, Mesher, State};
use crate::numerics::distance;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Updates nearest distances, clearances of cages and the quality of cells after `vertex` went
    /// in. Its neighbours are the vertices of its cavity: none is inside that, for all keep a star.
    pub(super) fn update_star(&mut self, vertex: VertexId, cavity: &Cavity) -> AllocResult<()> {
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

    /// Lowers clearances of cages, after `vertex` went in: it and its neighbours may be the nearest
    /// outside of each other's cages.
    fn update_clearances(&mut self, vertex: VertexId, neighbors: &[VertexId]) -> AllocResult<()> {
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
                self.state.separate(cage, outside);
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
}

impl<const D: usize> State<D> {
    /// Lowers the clearance of `cage` to `vertex` if that is outside.
    pub(in crate::netmesh) fn separate(&mut self, cage: DomainId, vertex: VertexId) {
        let distance = self.hierarchy.distance_to_center(cage, self.delaunay.point(vertex));
        let node = self.hierarchy.node_mut(cage);
        if distance >= node.radius && distance < node.outside {
            node.outside = distance;
            self.interface.want_non_owned(cage);
        }
    }

    /// Measures the nearest distance of a vertex of the first simplex; its farthest corner is not
    /// known.
    pub(in crate::netmesh) fn measure_nearest(&mut self, vertex: VertexId) {
        let simplex = self.delaunay.complex().incident(vertex);
        let x = self.delaunay.point(vertex);
        let nearest = self
            .delaunay
            .complex()
            .vertices(simplex)
            .iter()
            .filter(|&&other| other.is_valid() && other != vertex)
            .map(|&other| distance(x, self.delaunay.point(other)))
            .fold(f64::INFINITY, f64::min);
        self.cells[vertex].nearest = nearest;
        self.cells[vertex].farthest = f64::INFINITY;
    }
}
