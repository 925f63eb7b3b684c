//! Level 2: every subsegment is an edge of the mesh, and every subfacet a face of it.

use super::super::edges::{at_vertices, between};
use super::super::walls::Walls;
use crate::error::message;
use crate::memory::{AllocResult, Lists, TryGrow, copied, filled, with_capacity};
use crate::mesh::NONE;
use crate::quality::view::View;
use crate::validate::report::{Findings, Violation, ViolationKind};

/// Subfacets and subsegments among the faces and edges of the simplices.
pub(super) struct Faces {
    pub walls: Walls,
    /// Vertex -> the subsegments that end there.
    pub at: Lists,
    /// Vertex -> the subfacets that have it.
    pub subfacets_at: Lists,
    /// Subfacet -> its facet: the parent, or for those of a hull or box a number beyond all
    /// parents, which those have in common that are connected without crossing a subsegment.
    pub facets: Vec<u32>,
}

impl Faces {
    /// Finds the subfacets among the faces. Ids must be in range. O(m log m) for m simplices.
    pub fn new(view: View<'_, 3>) -> AllocResult<Self> {
        let subfacets = view.mesh.boundary.subfacets.as_flattened();
        let subfacets_at = Lists::of_pairs(view.vertex_count(), || {
            subfacets.iter().enumerate().map(|(slot, &vertex)| (vertex, (slot / 3) as u32))
        })?;
        let (at, facets) = (at_vertices(view)?, copied(&view.mesh.boundary.subfacet_parents)?);
        let mut faces = Self { walls: walls(view)?, at, subfacets_at, facets };
        faces.number_parts(view)?;
        Ok(faces)
    }

    /// Gives subfacets without a parent the numbers of their facets.
    fn number_parts(&mut self, view: View<'_, 3>) -> AllocResult<()> {
        let own = self.facets.partition_point(|&parent| parent != NONE);
        let mut next = self.facets[..own].last().map_or(0, |&parent| parent + 1);
        let (mut waiting, mut beside) = (Vec::new(), Vec::new());
        for first in own..self.facets.len() {
            if self.facets[first] != NONE {
                continue;
            }
            self.facets[first] = next;
            waiting.try_push(first)?;
            while let Some(subfacet) = waiting.pop() {
                let [a, b, c] = view.mesh.boundary.subfacets[subfacet];
                for edge in [[a, b], [b, c], [c, a]] {
                    if self.subsegment(view, edge).is_some() {
                        continue;
                    }
                    beside.clear();
                    for other in self.beside(view, edge) {
                        beside.try_push(other as usize)?;
                    }
                    for &other in &beside {
                        if self.facets[other] == NONE {
                            self.facets[other] = next;
                            waiting.try_push(other)?;
                        }
                    }
                }
            }
            next += 1;
        }
        Ok(())
    }

    /// Returns the subsegment between two vertices.
    pub fn subsegment(&self, view: View<'_, 3>, ends: [u32; 2]) -> Option<u32> {
        between(&view.mesh.boundary.subsegments, &self.at, ends)
    }

    /// Returns true if subsegments at a vertex are not two, or if it is on a facet that none of
    /// them bounds, so that facets or segments cross there.
    pub fn is_crossing(&self, view: View<'_, 3>, vertex: u32) -> bool {
        let at = self.at.of(vertex as usize);
        let is_beside = |facet: u32| {
            at.iter().any(|&subsegment| {
                let mut beside =
                    self.beside(view, view.mesh.boundary.subsegments[subsegment as usize]);
                beside.any(|subfacet| self.facets[subfacet as usize] == facet)
            })
        };
        let mut facets = self.subfacets_at.of(vertex as usize).iter();
        !at.is_empty() && (at.len() != 2 || facets.any(|&at| !is_beside(self.facets[at as usize])))
    }

    /// Returns the subfacets that have an edge between two vertices.
    pub fn beside<'a>(
        &'a self,
        view: View<'a, 3>,
        [a, b]: [u32; 2],
    ) -> impl Iterator<Item = u32> + Clone + 'a {
        let [of_a, of_b] = [a, b].map(|vertex| self.subfacets_at.of(vertex as usize));
        let (shorter, other) = if of_a.len() < of_b.len() { (of_a, b) } else { (of_b, a) };
        let subfacets = &view.mesh.boundary.subfacets;
        let has = move |subfacet: &u32| subfacets[*subfacet as usize].contains(&other);
        shorter.iter().copied().filter(has)
    }
}

/// Finds the subfacets among the faces of the simplices. Of two subfacets with the same vertices
/// one is found.
pub(in super::super) fn walls(view: View<'_, 3>) -> AllocResult<Walls> {
    let subfacets = &view.mesh.boundary.subfacets;
    let mut on_facet = filled(view.vertex_count(), false)?;
    let mut keys = with_capacity(subfacets.len())?;
    for (subfacet, &vertices) in (0u32..).zip(subfacets) {
        vertices.iter().for_each(|&vertex| on_facet[vertex as usize] = true);
        keys.push((sorted(vertices), subfacet));
    }
    keys.sort_unstable();
    Walls::find(view, |face| {
        if !face.iter().all(|&vertex| on_facet[vertex as usize]) {
            return None;
        }
        let at = keys.binary_search_by_key(&sorted(*face), |&(key, _)| key).ok()?;
        let subfacet = keys[at].1;
        Some((subfacet, is_rotated(*face, subfacets[subfacet as usize])))
    })
}

fn sorted(mut vertices: [u32; 3]) -> [u32; 3] {
    vertices.sort_unstable();
    vertices
}

/// Returns true if two triangles with the same vertices have one orientation.
pub(super) fn is_rotated([a, b, c]: [u32; 3], other: [u32; 3]) -> bool {
    [[a, b, c], [b, c, a], [c, a, b]].contains(&other)
}

/// Returns for each subsegment true if it is an edge of one of the first `count` simplices. Of two
/// subsegments between the same vertices one counts.
pub(super) fn edges(view: View<'_, 3>, at: &Lists, count: usize) -> AllocResult<Vec<bool>> {
    let subsegments = &view.mesh.boundary.subsegments;
    let mut is_edge = filled(subsegments.len(), false)?;
    for simplex in 0..count {
        let vertices = view.simplex(simplex);
        for (slot, &a) in vertices.iter().enumerate() {
            for &b in &vertices[slot + 1..] {
                if let Some(found) = between(subsegments, at, [a, b]) {
                    is_edge[found as usize] = true;
                }
            }
        }
    }
    Ok(is_edge)
}

pub(super) fn check(view: View<'_, 3>, faces: &Faces, findings: &mut Findings) -> AllocResult<()> {
    let boundary = &view.mesh.boundary;
    let is_edge = edges(view, &faces.at, view.simplex_count())?;
    for (at, (&is_edge, [a, b])) in is_edge.iter().zip(&boundary.subsegments).enumerate() {
        findings.check(is_edge, || {
            let message = message!(
                "subsegment {at} from vertex {a} to {b} is no edge of the mesh, or is there twice"
            );
            Violation::new(ViolationKind::SubsegmentEdge, message).vertex(*a as usize)
        });
    }
    for (at, (&sides, vertices)) in faces.walls.sides.iter().zip(&boundary.subfacets).enumerate() {
        findings.check(sides != [NONE; 2], || {
            let message = message!(
                "subfacet {at} with the vertices {vertices:?} is no face of the mesh, or is there \
                 twice"
            );
            Violation::new(ViolationKind::SubfacetFace, message).vertex(vertices[0] as usize)
        });
    }
    Ok(())
}
