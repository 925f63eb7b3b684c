//! A piece of a mesh as plain data that no id of another piece is needed for: it can be sent,
//! divided, and put together with others.

use crate::error::Result;
use crate::memory::{AllocResult, TryGrow, collected, filled, with_capacity};
use crate::netmesh::distributed::bisection::Bisection;
use crate::netmesh::distributed::names::{NOTHING, is_input};

/// Beyond a facet that is the boundary of the piece, but not of the mesh, a simplex is its own
/// neighbour.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Piece<const D: usize> {
    /// The inputs that wait for their insertion come first.
    pub(super) vertices: Vec<NamedVertex<D>>,
    /// Waiting input -> a simplex whose D-ball holds it.
    pub(super) waiting: Vec<u32>,
    /// D + 1 vertices each, positively oriented; the vertex at infinity is `u32::MAX`.
    pub(super) simplices: Vec<u32>,
    /// The simplex beyond the facet opposite each vertex.
    pub(super) neighbors: Vec<u32>,
    /// Simplex -> true if something is left to do there that this piece could not do.
    pub(super) is_unsettled: Vec<bool>,
    pub(super) domains: Vec<NamedDomain<D>>,
    /// Domains that were dissolved, and the domain that took their vertices.
    pub(super) released: Vec<[u64; 2]>,
    /// The facets, by the names of their vertices in rising order, where the piece meets partitions
    /// that it has not joined yet. Sorted.
    pub(super) outer: Vec<[u64; D]>,
    /// Inputs that encroach a domain around their cage, which had to stay as it is.
    pub(super) encroaching: Vec<u64>,
    /// Domains at which something is left to do, for which all pieces that have simplices at their
    /// centres and cages are needed. Sorted.
    pub(super) wanted: Vec<u64>,
    /// Vertices that came nearer to others in this piece, or in one that it was made of, and have
    /// simplices in other pieces, or at interfaces: those may have got bad.
    pub(super) nearer: Vec<u64>,
    /// The number of the partition that made it.
    pub(super) maker: u32,
}

/// A vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct NamedVertex<const D: usize> {
    pub name: u64,
    pub point: [f64; D],
    /// The distance to the nearest other vertex, as far as the piece knows.
    pub nearest: f64,
    /// The innermost domain; nothing for an input that waits.
    pub domain: u64,
    /// The domain whose cage it is part of, or nothing.
    pub cage: u64,
    pub is_precision_limited: bool,
}

/// A living domain.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct NamedDomain<const D: usize> {
    pub name: u64,
    pub parent: u64,
    pub point: [f64; D],
    pub radius: f64,
    pub outside: f64,
    pub center: u64,
    pub cage: Vec<u64>,
    /// Number of partitions that it has been in and that might change it: the highest version is
    /// the latest.
    pub version: u64,
}

impl<const D: usize> Piece<D> {
    pub(super) const PER_SIMPLEX: usize = D + 1;

    pub fn simplex_count(&self) -> usize {
        self.is_unsettled.len()
    }

    /// Returns the number of the partition that made it, or that it is the rest of: an order of
    /// pieces that does not depend on where they are.
    pub fn maker(&self) -> u32 {
        self.maker
    }

    /// Returns the vertices, and among them first the inputs that wait: names and points.
    pub fn vertices(&self) -> impl ExactSizeIterator<Item = (u64, [f64; D])> {
        self.vertices.iter().map(|vertex| (vertex.name, vertex.point))
    }

    /// Returns the number of inputs that wait for their insertion.
    pub fn waiting_count(&self) -> usize {
        self.waiting.len()
    }

    pub(super) fn vertices_of(&self, simplex: usize) -> &[u32] {
        &self.simplices[simplex * Self::PER_SIMPLEX..][..Self::PER_SIMPLEX]
    }

    pub(super) fn neighbors_of(&self, simplex: usize) -> &[u32] {
        &self.neighbors[simplex * Self::PER_SIMPLEX..][..Self::PER_SIMPLEX]
    }

    /// Returns the name of a vertex, which may be at infinity.
    pub(super) fn name(&self, vertex: u32) -> u64 {
        self.vertices.get(vertex as usize).map_or(NOTHING, |vertex| vertex.name)
    }

    /// Returns the names of the vertices of the facet of `simplex` opposite its vertex number
    /// `index`, in rising order.
    pub(super) fn facet(&self, simplex: usize, index: usize) -> [u64; D] {
        let vertices = self.vertices_of(simplex);
        let mut facet =
            std::array::from_fn(|at| self.name(vertices[at + usize::from(at >= index)]));
        facet.sort_unstable();
        facet
    }

    /// Returns the facets at which the piece ends, as simplices and the numbers of the opposite
    /// vertices.
    pub(super) fn interface_facets(&self) -> impl Iterator<Item = (usize, usize)> {
        let facets = self.neighbors.iter().enumerate();
        let own = facets.filter(|&(at, &neighbor)| at / Self::PER_SIMPLEX == neighbor as usize);
        own.map(|(at, _)| (at / Self::PER_SIMPLEX, at % Self::PER_SIMPLEX))
    }

    /// Returns the simplices for which `is_selected` says so, as a piece; inputs that wait for them
    /// come along.
    pub(super) fn select(
        &self,
        is_selected: &[bool],
        mut tick: impl FnMut() -> Result<()>,
    ) -> Result<Self> {
        let mut selected = Self { maker: self.maker, ..Self::default() };
        let mut simplex_ids = filled(self.simplex_count(), u32::MAX)?;
        let mut count = 0;
        for (id, _) in
            simplex_ids.iter_mut().zip(is_selected).filter(|(_, is_selected)| **is_selected)
        {
            *id = count;
            count += 1;
        }
        let mut vertex_ids = filled(self.vertices.len(), u32::MAX)?;
        let mut take = |selected: &mut Self, vertex: usize| -> AllocResult<u32> {
            if vertex_ids[vertex] == u32::MAX {
                vertex_ids[vertex] = selected.vertices.len() as u32;
                selected.vertices.try_push(self.vertices[vertex])?;
            }
            Ok(vertex_ids[vertex])
        };
        for (input, &simplex) in self.waiting.iter().enumerate() {
            tick()?;
            if is_selected[simplex as usize] {
                take(&mut selected, input)?;
                selected.waiting.try_push(simplex_ids[simplex as usize])?;
            }
        }
        selected.simplices = with_capacity(count as usize * Self::PER_SIMPLEX)?;
        selected.neighbors = with_capacity(count as usize * Self::PER_SIMPLEX)?;
        selected.is_unsettled = with_capacity(count as usize)?;
        for simplex in (0..self.simplex_count()).filter(|&simplex| is_selected[simplex]) {
            tick()?;
            for &vertex in self.vertices_of(simplex) {
                let id = match vertex {
                    u32::MAX => u32::MAX,
                    _ => take(&mut selected, vertex as usize)?,
                };
                selected.simplices.push(id);
            }
            for &neighbor in self.neighbors_of(simplex) {
                let id = simplex_ids[neighbor as usize];
                selected.neighbors.push(if id == u32::MAX { simplex_ids[simplex] } else { id });
            }
            selected.is_unsettled.push(self.is_unsettled[simplex]);
        }
        // Others may have vertices of the domains that were dissolved.
        let takers = self.released.iter().map(|&[_, taker]| taker);
        let is_around = self.domains_around(&selected.vertices, takers)?;
        let around = self.domains.iter().zip(is_around).filter(|(_, is_around)| *is_around);
        selected.domains = collected(around.map(|(domain, _)| domain.clone()))?;
        selected.released = collected(self.released.iter().copied())?;
        selected.outer = self.outer_of(&selected)?;
        selected.encroaching = selected.own_names(&self.encroaching)?;
        selected.nearer = selected.own_names(&self.nearer)?;
        let wanted = selected.domains.iter().map(|domain| domain.name);
        let wanted = wanted.filter(|name| self.wanted.binary_search(name).is_ok());
        selected.wanted = collected(wanted)?;
        selected.wanted.sort_unstable();
        Ok(selected)
    }

    /// Returns the infinite simplices, each with the finite one that it shares a facet of the hull
    /// with.
    pub(super) fn beyond_hull(&self) -> impl Iterator<Item = (usize, usize)> {
        (0..self.simplex_count()).filter_map(|simplex| {
            let infinite =
                self.vertices_of(simplex).iter().position(|&vertex| vertex == u32::MAX)?;
            Some((simplex, self.neighbors_of(simplex)[infinite] as usize))
        })
    }

    /// Returns the part of `cut` that the middle of every simplex is in; infinite ones go with the
    /// finite ones beside them.
    pub(super) fn parts(&self, cut: &Bisection<D>) -> Result<Vec<u32>> {
        let share = 1.0 / Self::PER_SIMPLEX as f64;
        let middle = |simplex: usize| {
            let mut middle = [0.0; D];
            for &vertex in self.vertices_of(simplex) {
                let named = self.vertices.get(vertex as usize);
                let point = named.map_or([0.0; D], |vertex| vertex.point);
                middle.iter_mut().zip(point).for_each(|(sum, x)| *sum += share * x);
            }
            middle
        };
        let mut parts =
            collected((0..self.simplex_count()).map(|simplex| cut.part_of(&middle(simplex))))?;
        self.beyond_hull().for_each(|(infinite, finite)| parts[infinite] = parts[finite]);
        Ok(parts)
    }

    /// Marks infinite simplices as the finite ones beside them, so that a facet of the hull is not
    /// at an interface: both if one of them is marked.
    pub(super) fn keep_hull_together(&self, is_marked: &mut [bool]) {
        for (infinite, finite) in self.beyond_hull() {
            is_marked[finite] |= is_marked[infinite];
        }
        for (infinite, finite) in self.beyond_hull() {
            is_marked[infinite] = is_marked[finite];
        }
    }

    /// Returns, for every domain, true if one of `vertices` is in it or in its cage, or one of the
    /// `others` is it, or either of a domain within it.
    fn domains_around<'a>(
        &self,
        vertices: impl IntoIterator<Item = &'a NamedVertex<D>>,
        others: impl Iterator<Item = u64>,
    ) -> AllocResult<Vec<bool>> {
        let mut places = collected(self.domains.iter().map(|domain| domain.name).zip(0usize..))?;
        places.sort_unstable();
        let place = |name: u64| {
            places.binary_search_by_key(&name, |&(name, _)| name).ok().map(|at| places[at].1)
        };
        let mut is_around = filled(self.domains.len(), false)?;
        let mut want = |name: u64| {
            let mut next = place(name);
            while let Some(at) = next.filter(|&at| !is_around[at]) {
                is_around[at] = true;
                next = place(self.domains[at].parent);
            }
        };
        let mut last = NOTHING;
        for vertex in vertices {
            if vertex.domain != last {
                want(vertex.domain);
                last = vertex.domain;
            }
            if vertex.cage != NOTHING {
                want(vertex.cage);
            }
        }
        others.for_each(want);
        Ok(is_around)
    }

    /// Returns those of `names` that are names of vertices of this piece.
    fn own_names(&self, names: &[u64]) -> AllocResult<Vec<u64>> {
        let mut wanted = collected(names.iter().copied())?;
        wanted.sort_unstable();
        let vertices = self.vertices.iter().map(|vertex| vertex.name);
        let mut own = Vec::new();
        if !wanted.is_empty() {
            for name in vertices.filter(|name| wanted.binary_search(name).is_ok()) {
                own.try_push(name)?;
            }
        }
        Ok(own)
    }

    /// Returns the outer facets of this piece that `selected` has.
    fn outer_of(&self, selected: &Self) -> AllocResult<Vec<[u64; D]>> {
        let mut outer = Vec::new();
        for (simplex, index) in selected.interface_facets() {
            let facet = selected.facet(simplex, index);
            if self.outer.binary_search(&facet).is_ok() {
                outer.try_push(facet)?;
            }
        }
        outer.sort_unstable();
        Ok(outer)
    }

    /// Makes all facets at which the piece ends outer ones: it is a partition that has just been
    /// cut out.
    pub(super) fn set_outer(&mut self) -> AllocResult<()> {
        let facets = self.interface_facets().map(|(simplex, index)| self.facet(simplex, index));
        self.outer = collected(facets)?;
        self.outer.sort_unstable();
        Ok(())
    }

    /// Adds inputs that wait for their insertion, given by name, point and a simplex whose D-ball
    /// holds them. The piece must have none.
    pub fn add_inputs(&mut self, inputs: &[(u64, [f64; D], u32)]) -> Result<()> {
        debug_assert!(self.waiting.is_empty() && inputs.iter().all(|input| is_input(input.0)));
        let mut vertices = with_capacity(inputs.len() + self.vertices.len())?;
        self.waiting = with_capacity(inputs.len())?;
        for &(name, point, simplex) in inputs {
            vertices.push(NamedVertex {
                name,
                point,
                nearest: f64::INFINITY,
                domain: NOTHING,
                cage: NOTHING,
                is_precision_limited: false,
            });
            self.waiting.push(simplex);
        }
        vertices.extend_from_slice(&self.vertices);
        self.vertices = vertices;
        let shift = inputs.len() as u32;
        for vertex in self.simplices.iter_mut().filter(|vertex| **vertex != u32::MAX) {
            *vertex += shift;
        }
        Ok(())
    }
}
