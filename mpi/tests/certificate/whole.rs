//! Meshes that are put together anew, of any simplices.

use netmesh_mpi::DistributedMesh;
use netmesh_mpi::distributed::{Ghost, InterfaceFacet, NO_ID};
use std::collections::{BTreeMap, BTreeSet};

/// Simplices and vertices of a whole mesh, by ids.
pub struct Whole {
    pub dim: usize,
    /// Coordinates, kinds and domains.
    pub vertices: BTreeMap<u64, (Vec<f64>, u8, u64)>,
    pub simplices: Vec<Vec<u64>>,
}

impl Whole {
    /// Makes a mesh without inputs and domains.
    pub fn new<const D: usize, const N: usize>(
        points: &[[f64; D]],
        simplices: &[[u64; N]],
    ) -> Self {
        let vertex = |(id, point): (u64, &[f64; D])| (id, (point.to_vec(), 2, NO_ID));
        Self {
            dim: D,
            vertices: (0..).zip(points).map(vertex).collect(),
            simplices: simplices.iter().map(|simplex| simplex.to_vec()).collect(),
        }
    }

    /// Makes the mesh that all ranks have together.
    pub fn of(parts: &[DistributedMesh]) -> Self {
        let dim = parts[0].dim;
        let mut whole = Self { dim, vertices: BTreeMap::new(), simplices: Vec::new() };
        for part in parts {
            let id = |v: &u32| part.vertex_ids[*v as usize];
            let own = part.simplices.chunks_exact(dim + 1);
            whole.simplices.extend(own.map(|s| s.iter().map(id).collect::<Vec<_>>()));
            for (v, &id) in part.vertex_ids.iter().enumerate() {
                let known = (part.point(v as u32).to_vec(), part.kinds[v], part.vertex_domains[v]);
                whole.vertices.insert(id, known);
            }
        }
        whole
    }

    /// Returns the parts of ranks whose simplices begin at these. Inputs and promises are those of
    /// `base`.
    pub fn parts(&self, begins: &[usize], base: &[DistributedMesh]) -> Vec<DistributedMesh> {
        (0..begins.len()).map(|rank| self.part(rank, begins, base[rank].clone())).collect()
    }

    /// Returns the parts of this number of ranks, without inputs.
    pub fn shared_out(&self, ranks: usize) -> Vec<DistributedMesh> {
        let count = self.simplices.len();
        let begins: Vec<usize> = (0..ranks).map(|rank| count * rank / ranks).collect();
        let mut base = DistributedMesh { dim: self.dim, ranks, ..DistributedMesh::default() };
        base.totals.vertices = self.vertices.len() as u64;
        base.totals.vertex_ids = self.vertices.len() as u64;
        base.totals.simplices = count as u64;
        let base: Vec<_> =
            (0..ranks).map(|rank| DistributedMesh { rank, ..base.clone() }).collect();
        self.parts(&begins, &base)
    }

    fn part(&self, rank: usize, begins: &[usize], base: DistributedMesh) -> DistributedMesh {
        let all = &self.simplices;
        let range = begins[rank]..*begins.get(rank + 1).unwrap_or(&all.len());
        let rank_of = |s: usize| begins.partition_point(|begin| *begin <= s) as u32 - 1;
        let own: BTreeSet<u64> = all[range.clone()].iter().flatten().copied().collect();
        let is_ghost = |s: &usize| !range.contains(s) && all[*s].iter().any(|v| own.contains(v));
        let ghosts: Vec<usize> = (0..all.len()).filter(is_ghost).collect();
        let of_ghosts: BTreeSet<u64> = ghosts.iter().flat_map(|s| all[*s].clone()).collect();
        let vertex_ids: Vec<u64> = own.iter().chain(of_ghosts.difference(&own)).copied().collect();
        let index: BTreeMap<u64, u32> = vertex_ids.iter().copied().zip(0..).collect();
        let owner = |v: &u64| rank_of(all.iter().position(|s| s.contains(v)).unwrap());
        let mut neighbors = Vec::new();
        let mut interface = Vec::new();
        for s in range.clone() {
            for slot in 0..=self.dim {
                let other = self.across(s, slot);
                neighbors.push(other.map_or(NO_ID, |other| other as u64));
                if let Some(Ok(ghost)) = other.map(|other| ghosts.binary_search(&other)) {
                    let (simplex, facet) = (s - range.start, slot as u32);
                    interface.push(InterfaceFacet { simplex, facet, ghost });
                }
            }
        }
        DistributedMesh {
            own_vertices: own.len(),
            points: vertex_ids.iter().flat_map(|v| self.vertices[v].0.clone()).collect(),
            kinds: vertex_ids.iter().map(|v| self.vertices[v].1).collect(),
            vertex_domains: vertex_ids.iter().map(|v| self.vertices[v].2).collect(),
            vertex_cages: vec![NO_ID; vertex_ids.len()],
            vertex_owners: vertex_ids.iter().map(owner).collect(),
            vertex_ids,
            first_simplex: range.start as u64,
            simplices: all[range].iter().flatten().map(|v| index[v]).collect(),
            ghosts: ghosts.iter().map(|s| Ghost { id: *s as u64, owner: rank_of(*s) }).collect(),
            ghost_simplices: ghosts.iter().flat_map(|s| &all[*s]).map(|v| index[v]).collect(),
            neighbors,
            interface,
            ..base
        }
    }

    /// Returns another simplex with the facet opposite a vertex.
    fn across(&self, simplex: usize, slot: usize) -> Option<usize> {
        let mut facet = self.simplices[simplex].clone();
        facet.remove(slot);
        let has_all = |other: &Vec<u64>| facet.iter().all(|v| other.contains(v));
        (0..self.simplices.len()).find(|at| *at != simplex && has_all(&self.simplices[*at]))
    }
}
