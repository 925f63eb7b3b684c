//! Inputs, segments and facets outside of the domain that is meshed: holes have some, and so have
//! surfaces that enclose nothing.

use crate::numbers::counted_all;
use netmesh::mesh::{Boundary, NONE};
use netmesh::{Triangulation, VertexKind};

/// Numbers of things that no simplex of a mesh has, since its domain ends before them.
#[derive(Default)]
pub struct Outside {
    pub points: usize,
    pub subsegments: usize,
    pub subfacets: usize,
}

impl Outside {
    pub fn of(triangulation: &Triangulation) -> Self {
        let boundary = &triangulation.boundary;
        let Some(whole) = &boundary.whole else { return Self::default() };
        let mut is_in = vec![false; triangulation.vertex_count()];
        triangulation.simplices.iter().for_each(|&vertex| is_in[vertex as usize] = true);
        let inputs = triangulation.kinds.iter().zip(is_in);
        let subsegments = |of: &Boundary| given(&of.parents);
        let subfacets = |of: &Boundary| given(&of.subfacet_parents);
        Self {
            points: inputs.filter(|&(kind, is_in)| *kind == VertexKind::Input && !is_in).count(),
            subsegments: subsegments(&whole.boundary) - subsegments(boundary),
            subfacets: subfacets(&whole.boundary) - subfacets(boundary),
        }
    }

    /// Returns the line of the summary, if there is anything outside.
    pub fn told(&self) -> Option<String> {
        let parts = counted_all([
            (self.points as u64, "point", "points"),
            (self.subsegments as u64, "subsegment", "subsegments"),
            (self.subfacets as u64, "subfacet", "subfacets"),
        ]);
        (!parts.is_empty()).then(|| format!("{}; no simplex has them", parts.join(", ")))
    }
}

/// Returns the number of parts of what was given, and not of sides of a hull or box.
fn given(parents: &[u32]) -> usize {
    parents.iter().filter(|&&parent| parent != NONE).count()
}
