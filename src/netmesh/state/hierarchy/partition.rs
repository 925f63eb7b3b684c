//! The hierarchy of a partition has the domains that the vertices of the partition are in, and
//! those around them. A partition owns a domain if no other partition has simplices at its centre
//! or cage. Only those may it grow or release. Of the others it may lower the clearance and add to
//! the cage: the order in which partitions do that does not matter.

use crate::complex::{PartitionIds, VertexId};
use crate::error::Result;
use crate::memory::{AllocResult, Array, TryGrow, collected, filled, with_capacity};
use crate::netmesh::state::hierarchy::{DomainId, Hierarchy, Membership, Node, ROOT};

/// The domains of a partition in the global mesh.
#[derive(Default)]
pub(in crate::netmesh) struct DomainsToGlobal {
    /// Domain of the partition -> domain of the global mesh. The first is the root.
    local_to_global: Vec<DomainId>,
    /// Domain of the partition -> true if the partition owns it.
    owned: Vec<bool>,
}

impl DomainsToGlobal {
    /// Returns the global id of `domain`.
    pub fn global(&self, domain: DomainId) -> DomainId {
        self.local_to_global[domain]
    }

    /// Returns, for every domain of the partition, true if another partition owns it.
    pub fn non_owned(&self) -> AllocResult<Vec<bool>> {
        collected(self.owned.iter().map(|&owned| !owned))
    }
}

impl<const D: usize> Hierarchy<D> {
    /// Returns the hierarchy of the partition with the vertices of `ids`, inserted or not.
    /// `shared`: vertex of the partition -> true if other partitions have simplices at it. Of a
    /// hierarchy that is compressed.
    pub fn partition(
        &self,
        ids: &PartitionIds<'_>,
        shared: &[bool],
    ) -> Result<(Self, DomainsToGlobal)> {
        let vertices = &ids.local_to_global.vertices;
        let local_to_global = self.domains_at(vertices)?;
        let own = |vertex: VertexId| {
            let id = ids.global_to_local.vertices[vertex];
            (id.is_valid() && !shared[id]).then_some(id)
        };
        let mut nodes = with_capacity(local_to_global.len())?;
        let mut owned = with_capacity(local_to_global.len())?;
        for &domain in &local_to_global {
            let parent = self.compressed_parent(domain);
            let node = self.node(domain);
            let owns = domain != ROOT
                && own(node.center).is_some()
                && node.cage.iter().all(|&vertex| own(vertex).is_some());
            owned.push(owns);
            nodes.push(Node {
                center: own(node.center).unwrap_or(VertexId::NONE),
                point: node.point,
                radius: node.radius,
                parent: local(&local_to_global, parent),
                alive: true,
                outside: node.outside,
                cage: match owns {
                    true => collected(node.cage.iter().filter_map(|&vertex| own(vertex)))?,
                    false => Vec::new(),
                },
            });
        }
        let mut places = Array::with_capacity(vertices.len())?;
        for &vertex in vertices {
            let label = self.compressed_domain_of(vertex);
            let cage = self.cage_of(vertex);
            places.try_push(Membership {
                label: local(&local_to_global, label),
                cage: local(&local_to_global, cage),
            })?;
        }
        Ok((Self { alive: nodes.len(), nodes, places }, DomainsToGlobal { local_to_global, owned }))
    }

    /// Returns the domains of `vertices` and their cages, with all around them, in rising order.
    fn domains_at(&self, vertices: &[VertexId]) -> AllocResult<Vec<DomainId>> {
        let mut is_known = filled(self.nodes.len(), false)?;
        let mut local_to_global = Vec::new();
        local_to_global.try_push(ROOT)?;
        is_known[ROOT] = true;
        for &vertex in vertices {
            if !self.places[vertex].label.is_valid() {
                continue;
            }
            for mut domain in [self.compressed_domain_of(vertex), self.cage_of(vertex)] {
                while domain.is_valid() && !is_known[domain] {
                    is_known[domain] = true;
                    local_to_global.try_push(domain)?;
                    domain = self.compressed_parent(domain);
                }
            }
        }
        local_to_global.sort_unstable();
        Ok(local_to_global)
    }

    /// Takes over what a partition made of its domains and vertices; new domains get global ids.
    /// `vertices`: vertex of the partition -> vertex of the global mesh. Vertices beyond the end of
    /// `shared` are new and are added here.
    pub fn join(
        &mut self,
        partition: Self,
        domains: &mut DomainsToGlobal,
        vertices: &[VertexId],
        shared: &[bool],
    ) -> Result<()> {
        let Self { nodes, places, .. } = partition;
        let old = domains.local_to_global.len();
        for at in old..nodes.len() {
            domains.local_to_global.try_push(DomainId::new(self.nodes.len() + at - old))?;
        }
        let domain = |id: DomainId| if id.is_valid() { domains.local_to_global[id] } else { id };
        let vertex = |id: VertexId| if id.is_valid() { vertices[id] } else { id };
        for (at, mut node) in nodes.into_iter().enumerate() {
            if at < old && !domains.owned[at] {
                let known = &mut self.nodes[domains.local_to_global[at]];
                known.outside = known.outside.min(node.outside);
                node.cage.iter().try_for_each(|&id| known.cage.try_push(vertex(id)))?;
                continue;
            }
            node.center = vertex(node.center);
            node.parent = domain(node.parent);
            node.cage.iter_mut().for_each(|id| *id = vertex(*id));
            self.alive += usize::from(node.alive);
            if at < old {
                self.alive -= 1;
                self.nodes[domains.local_to_global[at]] = node;
            } else {
                self.nodes.try_push(node)?;
            }
        }
        for (local, &place) in places.iter().enumerate() {
            let is_shared = shared.get(local).copied();
            if is_shared.is_none() {
                self.add_vertex()?;
            }
            if place.label.is_valid() && is_shared != Some(true) {
                self.places[vertices[local]] =
                    Membership { label: domain(place.label), cage: domain(place.cage) };
            }
        }
        Ok(())
    }
}

/// Returns the local id of a domain, given its global id.
fn local(local_to_global: &[DomainId], global: DomainId) -> DomainId {
    match global.is_valid() {
        false => DomainId::NONE,
        true => DomainId::new(
            local_to_global.binary_search(&global).expect("a partition has all its domains"),
        ),
    }
}
