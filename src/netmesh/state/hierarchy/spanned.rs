//! The domains that a simplex spans: some of its vertices are inside, and some outside.

use crate::complex::VertexId;
use crate::mesh::MAX_DIM;
use crate::netmesh::state::hierarchy::{DomainId, Hierarchy, ROOT};

/// The domains that vertices are in, on a climb from the smallest up until they are in one.
pub(in crate::netmesh) struct Spanned {
    /// Living domains, each once.
    left: [DomainId; MAX_DIM + 1],
    count: usize,
}

impl Spanned {
    /// Returns the domains of vertices, given the innermost one of each.
    pub fn new(domains: impl Iterator<Item = DomainId>) -> Self {
        let mut spanned = Self { left: [DomainId::NONE; MAX_DIM + 1], count: 0 };
        for domain in domains {
            if !spanned.left[..spanned.count].contains(&domain) {
                spanned.left[spanned.count] = domain;
                spanned.count += 1;
            }
        }
        spanned
    }

    /// Returns the smallest domain that has some of the vertices only.
    pub fn smallest<const D: usize>(&self, hierarchy: &Hierarchy<D>) -> Option<DomainId> {
        if self.count <= 1 {
            return None;
        }
        let radius = |at: usize| hierarchy.node(self.left[at]).radius;
        let smallest = (1..self.count).fold(0, |a, b| if radius(b) < radius(a) { b } else { a });
        Some(self.left[smallest])
    }

    /// Goes on from `domain`, which is left, to its `parent`.
    pub fn climb(&mut self, domain: DomainId, parent: DomainId) {
        let left = &mut self.left[..self.count];
        let Some(at) = left.iter().position(|&other| other == domain) else { return };
        if left.contains(&parent) {
            left.copy_within(at + 1.., at);
            self.count -= 1;
        } else {
            left[at] = parent;
        }
    }
}

impl<const D: usize> Hierarchy<D> {
    /// Makes every dissolved domain forward to a living one, so that [`Self::spans`] takes no
    /// climbs. `tick` is called for every domain.
    pub fn compress<E>(&mut self, mut tick: impl FnMut() -> Result<(), E>) -> Result<(), E> {
        for domain in (ROOT.index()..self.len()).map(DomainId::new) {
            tick()?;
            self.parent(domain);
        }
        Ok(())
    }

    /// Returns true if inserted `vertices` span a domain that `accepts`. Changes nothing, so that
    /// all threads may ask; slow unless the hierarchy is compressed.
    pub fn spans(&self, vertices: &[VertexId], accepts: impl Fn(DomainId) -> bool) -> bool {
        let domains = vertices.iter().map(|&vertex| self.compressed_domain_of(vertex));
        let mut spanned = Spanned::new(domains);
        while let Some(domain) = spanned.smallest(self) {
            if accepts(domain) {
                return true;
            }
            spanned.climb(domain, self.compressed_parent(domain));
        }
        false
    }

    /// Returns the domain of `vertex` as [`Self::domain_of`] does, and changes nothing; fast if the
    /// hierarchy is compressed. None for a vertex that is not inserted.
    pub fn compressed_domain_of(&self, vertex: VertexId) -> DomainId {
        self.living(self.places[vertex].label)
    }

    /// Returns the parent of `domain` as [`Self::parent`] does, and changes nothing; fast if the
    /// hierarchy is compressed.
    pub fn compressed_parent(&self, domain: DomainId) -> DomainId {
        self.living(self.node(domain).parent)
    }

    /// Returns the living domain that `domain` is or was dissolved into, and leaves no short cut
    /// for the next time.
    fn living(&self, mut domain: DomainId) -> DomainId {
        while domain.is_valid() && !self.node(domain).alive {
            domain = self.node(domain).parent;
        }
        domain
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a chain of three domains, a fourth beside the inner two, and a vertex in each.
    fn hierarchy() -> Hierarchy<2> {
        let mut hierarchy = Hierarchy::new(4).unwrap();
        let parents = [DomainId::NONE, ROOT, DomainId::new(1), ROOT];
        for (at, (parent, radius)) in parents.into_iter().zip([8.0, 4.0, 1.0, 2.0]).enumerate() {
            let vertex = VertexId::new(at);
            let domain = hierarchy.create(vertex, [0.0; 2], radius, parent, 0).unwrap();
            hierarchy.set_domain(vertex, domain);
        }
        hierarchy
    }

    /// Returns the domains that the vertices of these numbers span, in the order of the climb.
    fn spanned(hierarchy: &Hierarchy<2>, vertices: &[usize]) -> Vec<usize> {
        let vertices: Vec<_> = vertices.iter().copied().map(VertexId::new).collect();
        let seen = std::cell::RefCell::new(Vec::new());
        let accepts = |domain: DomainId| {
            seen.borrow_mut().push(domain.index());
            false
        };
        assert!(!hierarchy.spans(&vertices, accepts));
        seen.into_inner()
    }

    #[test]
    fn domains_are_spanned_from_the_smallest_up() {
        let mut hierarchy = hierarchy();
        assert_eq!(spanned(&hierarchy, &[0, 2, 2]), [2, 1]);
        assert_eq!(spanned(&hierarchy, &[3, 1, 2]), [2, 3, 1]);
        assert_eq!(spanned(&hierarchy, &[2, 1, 1]), [2]);
        assert!(spanned(&hierarchy, &[3, 3, 3]).is_empty());
        assert!(hierarchy.spans(&[0, 2].map(VertexId::new), |domain| domain.index() == 1));
        hierarchy.release(DomainId::new(1));
        assert_eq!(spanned(&hierarchy, &[0, 1, 2]), [2]);
        let before = [vec![], spanned(&hierarchy, &[3, 1, 2])];
        hierarchy.compress(|| Ok::<(), ()>(())).unwrap();
        assert_eq!([spanned(&hierarchy, &[0, 1]), spanned(&hierarchy, &[3, 1, 2])], before);
    }

    #[test]
    fn domains_that_are_compressed_have_living_parents() {
        let mut hierarchy = hierarchy();
        hierarchy.create(VertexId::new(0), [0.0; 2], 0.5, DomainId::new(2), 0).unwrap();
        hierarchy.release(DomainId::new(2));
        hierarchy.release(DomainId::new(1));
        let mut ticks = 0;
        hierarchy
            .compress(|| {
                ticks += 1;
                Ok::<(), ()>(())
            })
            .unwrap();
        assert_eq!(ticks, 5);
        assert!((1..5).all(|at| hierarchy.nodes[at].parent == ROOT));
        assert!(hierarchy.compress(|| Err(())).is_err());
    }
}
