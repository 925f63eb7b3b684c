//! Shields: balls about ends of lines that no vertex of the boundary goes into any more. All lines
//! that end there have a vertex on the sphere, and facets have arcs of such.

use crate::complex::VertexId;
use crate::memory::{AllocResult, TryGrow};

/// The shields of a mesh.
#[derive(Default)]
pub(in crate::netmesh) struct Shields {
    /// Sorted by centre.
    all: Vec<Shield>,
    /// A facet, and the centre of a shield on it; sorted.
    on_facets: Vec<(u32, VertexId)>,
}

/// Ball about an end of lines.
#[derive(Clone, Copy)]
pub(in crate::netmesh) struct Shield {
    pub center: VertexId,
    pub radius: f64,
}

impl Shields {
    /// Returns the shield about a vertex, if it has one.
    pub fn about(&self, center: VertexId) -> Option<Shield> {
        let at = self.all.binary_search_by_key(&center, |own| own.center).ok()?;
        Some(self.all[at])
    }

    /// Returns the shields whose centres are on a facet.
    pub fn on_facet(&self, facet: u32) -> impl Iterator<Item = Shield> {
        let first = self.on_facets.partition_point(|own| own.0 < facet);
        let own = self.on_facets[first..].iter().take_while(move |own| own.0 == facet);
        own.filter_map(|own| self.about(own.1))
    }

    /// Adds a shield about a vertex that has none, and is on these facets.
    pub fn raise(&mut self, shield: Shield, facets: &[u32]) -> AllocResult<()> {
        self.all.try_push(shield)?;
        self.all.sort_unstable_by_key(|own| own.center);
        facets.iter().try_for_each(|&facet| self.on_facets.try_push((facet, shield.center)))?;
        self.on_facets.sort_unstable();
        self.on_facets.dedup();
        Ok(())
    }

    /// Removes the shield about a vertex.
    pub fn lower(&mut self, center: VertexId) {
        self.all.retain(|own| own.center != center);
        self.on_facets.retain(|own| own.1 != center);
    }
}
