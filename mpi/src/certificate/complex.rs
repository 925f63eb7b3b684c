//! Simplices that a rank knows, as one complex: its own, then the ghosts.

use crate::distributed::DistributedMesh;
use netmesh::Result;
use netmesh::distributed::memory::{filled, with_capacity};

/// A facet of a simplex.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Facet {
    /// Vertices of the facet, rising; in 2D the last is no vertex.
    pub vertices: [u32; 3],
    pub simplex: u32,
    /// Index of the simplex's vertex that the facet is opposite to.
    pub slot: u32,
}

pub struct Complex<'a> {
    pub mesh: &'a DistributedMesh,
    /// Number of own simplices.
    pub own: usize,
    /// All facets of all simplices, equal ones next to each other.
    facets: Vec<Facet>,
}

impl<'a> Complex<'a> {
    /// Makes the complex of a mesh whose arrays hold.
    pub fn new(mesh: &'a DistributedMesh) -> Result<Self> {
        let own = mesh.simplex_count();
        let mut complex = Self { mesh, own, facets: Vec::new() };
        let mut facets = with_capacity(complex.count() * (mesh.dim + 1))?;
        for simplex in 0..complex.count() {
            let all = complex.simplex(simplex);
            for slot in 0..all.len() {
                let mut vertices = [u32::MAX; 3];
                let others = all.iter().enumerate().filter(|(at, _)| *at != slot);
                vertices.iter_mut().zip(others).for_each(|(to, (_, from))| *to = *from);
                vertices.sort_unstable();
                facets.push(Facet { vertices, simplex: simplex as u32, slot: slot as u32 });
            }
        }
        facets.sort_unstable();
        complex.facets = facets;
        Ok(complex)
    }

    pub fn count(&self) -> usize {
        self.own + self.mesh.ghosts.len()
    }

    pub fn simplex(&self, simplex: usize) -> &'a [u32] {
        match simplex.checked_sub(self.own) {
            None => self.mesh.simplex(simplex),
            Some(ghost) => self.mesh.ghost(ghost),
        }
    }

    /// Returns the id of a simplex in the whole mesh.
    pub fn id(&self, simplex: usize) -> u64 {
        match simplex.checked_sub(self.own) {
            None => self.mesh.first_simplex + simplex as u64,
            Some(ghost) => self.mesh.ghosts[ghost].id,
        }
    }

    pub fn belongs_to_rank(&self, facet: &Facet) -> bool {
        (facet.simplex as usize) < self.own
    }

    /// Returns the vertex opposite a facet.
    pub fn opposite(&self, facet: &Facet) -> u32 {
        self.simplex(facet.simplex as usize)[facet.slot as usize]
    }

    /// Returns the facets in groups of equal vertices.
    pub fn groups(&self) -> impl Iterator<Item = &[Facet]> {
        self.facets.chunk_by(|a, b| a.vertices == b.vertices)
    }

    /// Returns true if the star of a vertex is all here, and this is the rank that speaks of it.
    pub fn is_owned(&self, vertex: usize) -> bool {
        vertex < self.mesh.own_vertices
            && self.mesh.vertex_owners[vertex] as usize == self.mesh.rank
    }

    /// Returns the index of a vertex of own simplices, if the rank has it.
    pub fn own_vertex(&self, id: u64) -> Option<usize> {
        self.mesh.vertex_ids[..self.mesh.own_vertices].binary_search(&id).ok()
    }

    /// Returns for each vertex the number of hull facets at it, which is right for those of own
    /// simplices.
    pub fn hull_facets(&self) -> Result<Vec<u32>> {
        let mut counts = filled(self.mesh.vertex_ids.len(), 0u32)?;
        for group in self.groups().filter(|group| group.len() == 1) {
            for &vertex in &group[0].vertices[..self.mesh.dim] {
                counts[vertex as usize] += 1;
            }
        }
        Ok(counts)
    }

    pub fn point<const D: usize>(&self, vertex: u32) -> &'a [f64; D] {
        self.mesh.point(vertex).try_into().expect("D coordinates")
    }

    /// Returns the points of a simplex; the rest of the array repeats the first.
    pub fn points<const D: usize>(&self, simplex: usize) -> [&'a [f64; D]; 4] {
        let vertices = self.simplex(simplex);
        std::array::from_fn(|at| self.point(*vertices.get(at).unwrap_or(&vertices[0])))
    }
}
