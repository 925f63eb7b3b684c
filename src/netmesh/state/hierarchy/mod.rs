//! The domain hierarchy (§4): a tree of balls, and for every vertex the innermost ball that holds
//! it. A released domain forwards to its parent (union-find), so no vertex is ever relabelled for
//! a release. Concentric chains of domains are legal.

pub(in crate::netmesh) mod partition;
pub(in crate::netmesh) mod spanned;

use crate::complex::VertexId;
use crate::memory::{AllocError, AllocResult, Array, Id, TryGrow, with_capacity};
use crate::numerics::distance;

/// A domain, by the order in which domains are created. None: the parent of the root, the domain of
/// a vertex that is not inserted.
pub(in crate::netmesh) type DomainId = Id<OfDomain>;

/// Kind of thing that a [`DomainId`] names.
pub(in crate::netmesh) enum OfDomain {}

/// The root domain.
pub(in crate::netmesh) const ROOT: DomainId = DomainId::new(0);

pub(in crate::netmesh) struct Node<const D: usize> {
    /// The vertex at the centre, and its coordinates.
    pub center: VertexId,
    pub point: [f64; D],
    pub radius: f64,
    /// The enclosing domain when this one lives, the one that took its vertices otherwise.
    parent: DomainId,
    pub alive: bool,
    /// Distance from the centre to the nearest vertex outside the ball.
    pub outside: f64,
    /// The cage C_Omega: the vertices near the cage sphere.
    pub cage: Vec<VertexId>,
}

#[derive(Clone, Copy)]
pub(super) struct Membership {
    /// A domain that [`Hierarchy::find`] resolves to the innermost one; none if not inserted.
    label: DomainId,
    /// The domain whose cage the vertex was made for.
    cage: DomainId,
}

impl Membership {
    const NOWHERE: Self = Self { label: DomainId::NONE, cage: DomainId::NONE };
}

pub(in crate::netmesh) struct Hierarchy<const D: usize> {
    nodes: Vec<Node<D>>,
    /// Vertex -> where it is.
    places: Array<Membership>,
    alive: usize,
}

impl<const D: usize> Hierarchy<D> {
    pub fn new(vertices: usize) -> AllocResult<Self> {
        Ok(Self {
            nodes: Vec::new(),
            places: Array::filled(vertices, Membership::NOWHERE)?,
            alive: 0,
        })
    }

    /// Reserves memory for `vertices` vertices if the system gives it.
    pub fn expect(&mut self, vertices: usize) {
        self.places.expect(vertices);
    }

    pub fn add_vertex(&mut self) -> AllocResult<()> {
        self.places.try_push(Membership::NOWHERE)
    }

    /// Returns the number of domains ever created; ids are below it.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Returns true if the root is the only domain, so that no cage separates anything.
    pub fn is_single(&self) -> bool {
        self.alive <= 1
    }

    #[inline]
    pub fn node(&self, domain: DomainId) -> &Node<D> {
        &self.nodes[domain]
    }

    pub fn node_mut(&mut self, domain: DomainId) -> &mut Node<D> {
        &mut self.nodes[domain]
    }

    /// Adds a domain in `parent` (none for the root), with memory for the vertices of its cage.
    pub fn create(
        &mut self,
        center: VertexId,
        point: [f64; D],
        radius: f64,
        parent: DomainId,
        cage_size: usize,
    ) -> AllocResult<DomainId> {
        let cage = with_capacity(cage_size)?;
        if self.nodes.len() >= DomainId::NONE.index() {
            return Err(AllocError::Ids);
        }
        self.nodes.try_push(Node {
            center,
            point,
            radius,
            parent,
            alive: true,
            outside: f64::INFINITY,
            cage,
        })?;
        self.alive += 1;
        Ok(DomainId::new(self.len() - 1))
    }

    /// Dissolves `domain` into its parent.
    pub fn release(&mut self, domain: DomainId) {
        debug_assert!(domain != ROOT && self.node(domain).alive);
        self.node_mut(domain).alive = false;
        self.alive -= 1;
    }

    /// Returns the living domain that `domain` is, or was dissolved into.
    #[inline]
    pub fn find(&mut self, domain: DomainId) -> DomainId {
        let mut current = domain;
        while !self.nodes[current].alive {
            let parent = self.nodes[current].parent;
            let next = &self.nodes[parent];
            if !next.alive {
                self.nodes[current].parent = next.parent;
            }
            current = parent;
        }
        current
    }

    /// Returns the living parent of a living domain; none for the root.
    pub fn parent(&mut self, domain: DomainId) -> DomainId {
        let parent = self.node(domain).parent;
        if !parent.is_valid() {
            return DomainId::NONE;
        }
        let living = self.find(parent);
        self.node_mut(domain).parent = living;
        living
    }

    pub fn set_parent(&mut self, domain: DomainId, parent: DomainId) {
        self.node_mut(domain).parent = parent;
    }

    /// Returns the innermost domain of an inserted vertex.
    #[inline]
    pub fn domain_of(&mut self, vertex: VertexId) -> DomainId {
        let domain = self.find(self.places[vertex].label);
        self.places[vertex].label = domain;
        domain
    }

    /// Returns true if inserted vertices are known to be of one domain, without a climb: all have
    /// the same label, or there is only one domain.
    #[inline]
    pub fn same_domain(&self, vertices: &[VertexId]) -> bool {
        self.is_single() || {
            let label = |vertex: VertexId| self.places[vertex].label;
            let first = label(vertices[0]);
            vertices[1..].iter().all(|&vertex| label(vertex) == first)
        }
    }

    pub fn set_domain(&mut self, vertex: VertexId, domain: DomainId) {
        self.places[vertex].label = domain;
    }

    /// Makes `vertex` part of the cage of `domain`.
    pub fn join_cage(&mut self, vertex: VertexId, domain: DomainId) -> AllocResult<()> {
        self.places[vertex].cage = domain;
        self.node_mut(domain).cage.try_push(vertex)
    }

    /// Makes `vertex`, which the cage of `domain` has, known as part of it.
    pub fn set_cage(&mut self, vertex: VertexId, domain: DomainId) {
        self.places[vertex].cage = domain;
    }

    /// Returns the living domain whose cage `vertex` is part of, if there is one.
    #[inline]
    pub fn cage_of(&self, vertex: VertexId) -> DomainId {
        match self.places[vertex].cage {
            cage if cage.is_valid() && self.node(cage).alive => cage,
            _ => DomainId::NONE,
        }
    }

    pub fn distance_to_center(&self, domain: DomainId, x: &[f64; D]) -> f64 {
        distance(x, &self.node(domain).point)
    }

    pub fn contains(&self, domain: DomainId, x: &[f64; D]) -> bool {
        domain == ROOT || self.distance_to_center(domain, x) < self.node(domain).radius
    }

    /// Returns the innermost domain on the way from `domain` to the root whose ball holds `x`.
    pub fn climb_to(&mut self, mut domain: DomainId, x: &[f64; D]) -> DomainId {
        while !self.contains(domain, x) {
            domain = self.parent(domain);
        }
        domain
    }

    /// Returns the child of `omega` that holds an inserted vertex; radii grow on the way up, so a
    /// vertex outside is recognised without a climb to the root.
    pub fn child_towards(&mut self, omega: DomainId, vertex: VertexId) -> Option<DomainId> {
        let mut domain = self.domain_of(vertex);
        while self.node(domain).radius < self.node(omega).radius {
            let parent = self.parent(domain);
            if parent == omega {
                return Some(domain);
            }
            domain = parent;
        }
        None
    }
}
