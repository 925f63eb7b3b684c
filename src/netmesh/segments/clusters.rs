//! Clusters: sets of vertices that are concentrated, that is far from all others for their extent.
//! With hierarchical output each has a domain of its own, unless a segment or facet leads out of
//! it.
//!
//! The minimum spanning tree of points is part of their Delaunay triangulation. So when its edges
//! are taken by rising length, and join the groups of vertices at their ends, the next edge at a
//! group is as long as the way from it to all others. Edges are sorted by the powers of two below
//! their lengths: that is enough to tell large gaps, and O(n).

use crate::complex::VertexId;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow, collected, filled};
use crate::netmesh::questions::cage_site::CageSite;
use crate::netmesh::state::hierarchy::{DomainId, ROOT};
use crate::netmesh::state::{Mesher, State};
use crate::numerics::distance;
use crate::options::Output;
use crate::parameters::Parameters;

/// Returns how many times its radius a cluster's cage must have room for: then the vertices of a
/// cage are no more than those between scales that are so far apart. In space these are many.
const fn room<const D: usize>() -> f64 {
    if D == 2 { 4.0 } else { 1.0 }
}

/// Number that stands for no cluster, and for the end of a list.
const NONE: u32 = u32::MAX;

/// A vertex, or after those a cluster, by its number.
type Item = u32;

/// A set of vertices that edges have joined so far.
#[derive(Clone, Copy)]
struct Group<const D: usize> {
    low: [f64; D],
    high: [f64; D],
    /// First and last item of the list of its vertices and clusters that are in no cluster yet.
    first: Item,
    last: Item,
    /// True if the group has more vertices than one.
    is_many: bool,
}

struct Clusters<const D: usize> {
    /// Vertex -> one of its group, by which the group is found; the group's first points to itself.
    towards: Vec<u32>,
    /// Groups, each by the number of the vertex that it is found by.
    groups: Vec<Group<D>>,
    /// Item -> the next one of its group's list.
    next: Vec<Item>,
    /// Item -> the innermost cluster that it is in.
    cluster_of: Vec<u32>,
    sites: Vec<CageSite>,
}

/// An edge, and the biased exponent of its length.
struct Edge {
    ends: [VertexId; 2],
    exponent: u16,
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// Gives each cluster a domain, if cages are wanted. There are no domains yet. Without a bound
    /// a cage would have nothing to save.
    pub(in crate::netmesh) fn make_domains(&mut self) -> Result<()> {
        let Parameters { output, quality_bound, .. } = self.state.parameters;
        if output == Output::WellSpaced || quality_bound == f64::INFINITY {
            return Ok(());
        }
        let clusters = self.find_clusters()?;
        Ok(self.state.make_domains_of(&clusters)?)
    }

    /// Returns the clusters, inner ones before those around them.
    fn find_clusters(&mut self) -> Result<Clusters<D>> {
        let edges = self.edges_by_length()?;
        let mut clusters = self.state.single_groups()?;
        for Edge { ends, exponent } in edges {
            self.watch.poll_after(1)?;
            let [a, b] = ends.map(|end| clusters.group_of(end));
            if a != b {
                // No longer than the edge.
                let gap = f64::from_bits(u64::from(exponent) << 52);
                for group in [a, b] {
                    self.state.note_cluster(&mut clusters, group, gap)?;
                }
                clusters.join(a, b);
            }
        }
        Ok(clusters)
    }

    /// Returns all edges between vertices that are not of the outer cage, by the powers of two
    /// below their lengths.
    fn edges_by_length(&mut self) -> Result<Vec<Edge>> {
        const EXPONENTS: usize = 1 << 11;
        let mut edges = Vec::new();
        let mut starts = filled(EXPONENTS + 1, 0usize)?;
        let mut neighbors = Vec::new();
        for vertex in VertexId::below(self.state.delaunay.point_count()) {
            self.watch.poll_after(1)?;
            self.find_later_neighbors(vertex, &mut neighbors)?;
            for &other in &neighbors {
                let delaunay = &self.state.delaunay;
                let length = distance(delaunay.point(vertex), delaunay.point(other));
                let exponent = (length.to_bits() >> 52) as u16;
                starts[exponent as usize + 1] += 1;
                edges.try_push(Edge { ends: [vertex, other], exponent })?;
            }
        }
        for at in 1..starts.len() {
            starts[at] += starts[at - 1];
        }
        let mut order = filled(edges.len(), 0u32)?;
        for (number, edge) in (0..).zip(&edges) {
            let at = &mut starts[edge.exponent as usize];
            order[*at] = number;
            *at += 1;
        }
        let sorted = order.iter().map(|&number| {
            let Edge { ends, exponent } = edges[number as usize];
            Edge { ends, exponent }
        });
        Ok(collected(sorted)?)
    }

    /// Finds the neighbours of a vertex that are of later numbers. Those of the outer cage have
    /// none, and are none.
    fn find_later_neighbors(
        &mut self,
        vertex: VertexId,
        neighbors: &mut Vec<VertexId>,
    ) -> AllocResult<()> {
        neighbors.clear();
        let State { delaunay, hierarchy, .. } = &mut self.state;
        if hierarchy.cage_of(vertex).is_valid() {
            return Ok(());
        }
        delaunay.star(vertex, &mut self.scratch.star)?;
        for &simplex in &self.scratch.star {
            for &other in delaunay.complex().vertices(simplex) {
                if other.is_valid() && other > vertex && !hierarchy.cage_of(other).is_valid() {
                    neighbors.try_push(other)?;
                }
            }
        }
        neighbors.sort_unstable();
        neighbors.dedup();
        Ok(())
    }
}

impl<const D: usize> State<D> {
    /// Returns a group for each vertex.
    fn single_groups(&self) -> AllocResult<Clusters<D>> {
        let count = self.delaunay.point_count() as u32;
        let groups = (0..count).map(|vertex| {
            let x = *self.delaunay.point(VertexId::new(vertex as usize));
            Group { low: x, high: x, first: vertex, last: vertex, is_many: false }
        });
        Ok(Clusters {
            groups: collected(groups)?,
            towards: collected(0..count)?,
            next: filled(count as usize, NONE)?,
            cluster_of: filled(count as usize, NONE)?,
            sites: Vec::new(),
        })
    }

    /// Makes a group a cluster if it is concentrated, `gap` being as far as the others are.
    fn note_cluster(&self, clusters: &mut Clusters<D>, group: u32, gap: f64) -> AllocResult<()> {
        let Group { low, high, first, is_many, .. } = clusters.groups[group as usize];
        // Before all that takes longer: the cage is larger than the box, and the gap than the cage.
        if !is_many || (0..D).any(|axis| high[axis] - low[axis] > gap) {
            return Ok(());
        }
        let middle = std::array::from_fn(|axis| 0.5 * low[axis] + 0.5 * high[axis]);
        let (mut center, mut least) = (VertexId::NONE, f64::INFINITY);
        let mut item = first;
        while item != NONE {
            let vertex = clusters.vertex_of(item);
            let distance = distance(self.delaunay.point(vertex), &middle);
            if !center.is_valid() || distance < least {
                (center, least) = (vertex, distance);
            }
            item = clusters.next[item as usize];
        }
        let corner = self.delaunay.point(center);
        let farthest = std::array::from_fn(|axis| {
            let is_low = corner[axis] > middle[axis];
            if is_low { low[axis] } else { high[axis] }
        });
        let reach = distance(corner, &farthest);
        match self.concentrated_radius(center, reach, gap, room::<D>()) {
            Some(radius) => {
                clusters.add(group, CageSite { center, radius, parent: ROOT, inner: None })
            }
            None => Ok(()),
        }
    }

    /// Makes the domains of all clusters, outer ones first, and puts their vertices into them.
    fn make_domains_of(&mut self, clusters: &Clusters<D>) -> AllocResult<()> {
        let Clusters { sites, cluster_of, .. } = clusters;
        let vertices = cluster_of.len() - sites.len();
        let domain_of = |item: usize| match cluster_of[item] {
            NONE => ROOT,
            cluster => DomainId::new(sites.len() - cluster as usize),
        };
        for (number, site) in sites.iter().enumerate().rev() {
            let point = *self.delaunay.point(site.center);
            let size = self.template.len();
            let parent = domain_of(vertices + number);
            self.hierarchy.create(site.center, point, site.radius, parent, size)?;
            self.stats.cages_created += 1;
        }
        for vertex in VertexId::below(vertices).filter(|&vertex| domain_of(vertex.index()) != ROOT)
        {
            self.hierarchy.set_domain(vertex, domain_of(vertex.index()));
        }
        Ok(())
    }
}

impl<const D: usize> Clusters<D> {
    /// Returns the vertex that the group of `vertex` is found by.
    fn group_of(&mut self, vertex: VertexId) -> u32 {
        let mut at = vertex.index();
        while self.towards[at] as usize != at {
            let next = self.towards[at] as usize;
            self.towards[at] = self.towards[next];
            at = next;
        }
        at as u32
    }

    /// Joins two groups.
    fn join(&mut self, a: u32, b: u32) {
        let [into, from] = if a < b { [a, b] } else { [b, a] };
        let (own, other) = (self.groups[into as usize], self.groups[from as usize]);
        self.next[own.last as usize] = other.first;
        self.groups[into as usize] = Group {
            low: std::array::from_fn(|axis| own.low[axis].min(other.low[axis])),
            high: std::array::from_fn(|axis| own.high[axis].max(other.high[axis])),
            first: own.first,
            last: other.last,
            is_many: true,
        };
        self.towards[from as usize] = into;
    }

    /// Returns the vertex that an item is, or the centre of the cluster that it is.
    fn vertex_of(&self, item: Item) -> VertexId {
        match (item as usize).checked_sub(self.towards.len()) {
            None => VertexId::new(item as usize),
            Some(cluster) => self.sites[cluster].center,
        }
    }

    /// Makes a cluster of the items of a group; the group then has that cluster as its one item.
    fn add(&mut self, group: u32, site: CageSite) -> AllocResult<()> {
        let cluster = self.sites.len() as u32;
        let own = &mut self.groups[group as usize];
        let mut item = own.first;
        while item != NONE {
            self.cluster_of[item as usize] = cluster;
            item = self.next[item as usize];
        }
        let item = self.next.len() as u32;
        (own.first, own.last) = (item, item);
        self.next.try_push(NONE)?;
        self.cluster_of.try_push(NONE)?;
        self.sites.try_push(site)
    }
}
