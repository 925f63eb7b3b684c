//! Facets in space, as the mesh knows them: each is a sheet of triangles, its *subfacets*, that are
//! to be faces of simplices.
//!
//! Subfacets of one facet that share an edge are neighbours there. At an edge that is a subsegment
//! a subfacet has the next one of its *pages* for a neighbour: all subfacets at a subsegment,
//! whatever their facets, stand in a circle.

pub(in crate::netmesh) mod bent;
pub(in crate::netmesh) mod faces;
pub(in crate::netmesh) mod features;
pub(in crate::netmesh) mod floors;
pub(in crate::netmesh) mod meetings;
pub(in crate::netmesh) mod near;
pub(in crate::netmesh) mod plane;
pub(in crate::netmesh) mod sheet;
pub(in crate::netmesh) mod shields;

use crate::complex::{SimplexId, VertexId, VertexSet};
use crate::error::Result;
use crate::memory::{
    AllocError, AllocResult, Array, Lists, TryGrow, filled, sorted_in_buckets, with_capacity,
};
use crate::mesh::NONE;
use crate::nearest::Bounds;
use crate::netmesh::state::bits::{bit_of, in_three_of, numbers_in};
use crate::netmesh::state::facets::bent::Bent;
use crate::netmesh::state::facets::faces::{FACES, Faces};
use crate::netmesh::state::facets::features::Features;
use crate::netmesh::state::facets::floors::Floors;
use crate::netmesh::state::facets::meetings::Meetings;
use crate::netmesh::state::facets::near::NearBoundary;
use crate::netmesh::state::facets::plane::Plane;
use crate::netmesh::state::facets::shields::Shields;
use crate::netmesh::state::segments::chain::Chains;
use crate::netmesh::state::watch::Watch;
use std::collections::BinaryHeap;

/// The sheets, and the subfacets that wait for a look.
#[derive(Default)]
pub(in crate::netmesh) struct Facets {
    pub facets: Vec<Facet>,
    /// Triangles of facets that are bent.
    bent: Vec<Bent>,
    /// Walls: sets of subfacets of one facet that are connected without crossing a subsegment.
    pub walls: Vec<Wall>,
    subfacets: Vec<Subfacet>,
    /// Subsegment -> one of its pages, [`NONE`] without any.
    pages: Vec<u32>,
    faces: Faces,
    /// Vertex -> the bits of the facets that it is on.
    on: Array<u64>,
    /// Vertex -> the facet that it is in between lines, [`NONE`] for others.
    inside: Array<u32>,
    /// First vertices -> the facets that they are on.
    at_first: Option<Lists>,
    /// Pairs of facets that meet at small angles.
    pub meetings: Meetings,
    /// Line -> true if facets or segments meet there at a small angle.
    is_sharp: Vec<bool>,
    /// Facet -> true if it has such a line.
    has_sharp: Vec<bool>,
    /// Facets -> the ends of such lines that are on them.
    sharp_ends: Option<Lists>,
    waiting: BinaryHeap<Waiting>,
    /// Simplex -> true if it stays although it is beyond the bound; those beyond do not.
    kept: Array<bool>,
    pub floors: Floors,
    pub shields: Shields,
    /// Made once shields need it.
    pub features: Option<Features>,
    /// Vertex -> the local feature size there, NaN where it is not known.
    feature_sizes: Array<f64>,
    /// Subsegments and subfacets near a point.
    pub near: NearBoundary,
    /// Subsegment -> its place among those near a point, for searches.
    pub places: Vec<u32>,
    /// Number of vertices of the boundary that are on top of others but for roundings.
    pub on_top: u32,
    /// Simplices at a vertex, for searches.
    pub star: Array<SimplexId>,
    /// Vertices of simplices at some vertices, for searches.
    pub around: VertexSet,
    /// Subfacets whose edges wait for a test, and others that a search has found.
    pub found: Vec<u32>,
}

/// Facet: a polygon of the caller's, or triangles that lie in one plane.
#[derive(Clone, Copy)]
pub(in crate::netmesh) struct Facet {
    /// The first of the caller's facets that it is made of.
    pub parent: u32,
    pub plane: Plane,
    /// Place of its triangles among those of bent facets, [`NONE`] for one that is flat.
    pub bent: u32,
    /// Radius of its smallest subfacet before any was split; infinite until that is known.
    pub first_radius: f64,
    /// Box of its corners, with a margin for roundings.
    pub bounds: Bounds,
}

/// Part of a facet between subsegments: it has one region on either side.
#[derive(Clone, Copy)]
pub(in crate::netmesh) struct Wall {
    pub facet: u32,
    /// Number by which the winding number behind it is larger than that before it.
    pub balance: i64,
}

/// Triangle of a sheet. Edge number i is opposite vertex number i.
#[derive(Clone, Copy)]
pub(in crate::netmesh) struct Subfacet {
    /// Counterclockwise where the normal of the facet points to the eye.
    pub vertices: [VertexId; 3],
    /// Subfacets beyond the edges: of the same facet, or at a subsegment the next page.
    pub neighbors: [u32; 3],
    /// Subsegments that the edges are, [`NONE`] for others.
    pub subsegments: [u32; 3],
    pub facet: u32,
    pub wall: u32,
    is_waiting: bool,
    /// Doubles are too coarse for a vertex in it.
    is_limited: bool,
}

/// Subfacet that waits, and the bits of its radius: the largest comes first, of equal ones the one
/// with the least number.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Waiting {
    radius: u64,
    subfacet: std::cmp::Reverse<u32>,
}

impl Subfacet {
    /// Returns the number of the edge between two vertices, in any direction.
    pub fn edge_between(&self, a: VertexId, b: VertexId) -> Option<usize> {
        (0..3).find(|&edge| {
            let ends = self.ends(edge);
            ends == [a, b] || ends == [b, a]
        })
    }

    /// Returns the ends of an edge, counterclockwise.
    pub fn ends(&self, edge: usize) -> [VertexId; 2] {
        [self.vertices[(edge + 1) % 3], self.vertices[(edge + 2) % 3]]
    }
}

/// Edge of a triangle: its lower end, its upper end, the triangle, and its number there.
type Side = (VertexId, VertexId, u32, u8);

impl Facets {
    /// Makes the sheets of `triangles`, each given with its vertices and facet. Edges that are
    /// lines of `chains`, all of one subsegment, are their subsegments.
    pub fn new(
        (facets, bent): (Vec<Facet>, Vec<Bent>),
        balances: &[i64],
        triangles: &[([VertexId; 3], u32)],
        chains: &Chains,
        vertices: usize,
        watch: &mut Watch<'_, '_>,
    ) -> Result<Self> {
        let mut sheets = Self { facets, bent, ..Self::default() };
        sheets.on = Array::filled(vertices, 0)?;
        sheets.pages = filled(chains.len(), NONE)?;
        sheets.subfacets = with_capacity(triangles.len())?;
        sheets.faces.reserve(triangles.len())?;
        for (number, &(vertices, facet)) in (0..).zip(triangles) {
            watch.poll_after(2)?;
            sheets.subfacets.push(Subfacet {
                vertices,
                neighbors: [NONE; 3],
                subsegments: [NONE; 3],
                facet,
                wall: NONE,
                is_waiting: false,
                is_limited: false,
            });
            vertices.iter().for_each(|&vertex| sheets.on[vertex] |= bit_of(facet));
            sheets.faces.insert(&vertices, number)?;
        }
        sheets.join_edges(chains, watch)?;
        sheets.at_first = Some(sheets.at_vertices(vertices)?);
        sheets.find_walls(balances, watch)?;
        Ok(sheets)
    }

    /// Finds what is beyond the edges of all subfacets.
    fn join_edges(&mut self, chains: &Chains, watch: &mut Watch<'_, '_>) -> Result<()> {
        let mut sides: Vec<Side> = with_capacity(3 * self.subfacets.len())?;
        for (number, subfacet) in (0u32..).zip(&self.subfacets) {
            watch.poll_after(1)?;
            for edge in 0..3 {
                let [a, b] = subfacet.ends(edge);
                sides.push((a.min(b), a.max(b), number, edge as u8));
            }
        }
        let sides =
            sorted_in_buckets(&sides, |side| side.0.number(), |work| watch.poll_after(work))?;
        for own in sides.chunk_by(|one, other| (one.0, one.1) == (other.0, other.1)) {
            watch.poll_after(1)?;
            let (a, b, ..) = own[0];
            match chains.edge_between(a, b) {
                Some(subsegment) => self.make_pages(own, subsegment),
                None => self.join_neighbors(own),
            }
        }
        Ok(())
    }

    /// Makes the subfacets at an edge the pages of `subsegment`.
    fn make_pages(&mut self, sides: &[Side], subsegment: u32) {
        for (at, &(_, _, subfacet, edge)) in sides.iter().enumerate() {
            let own = &mut self.subfacets[subfacet as usize];
            own.neighbors[edge as usize] = sides[(at + 1) % sides.len()].2;
            own.subsegments[edge as usize] = subsegment;
        }
        self.pages[subsegment as usize] = sides[0].2;
    }

    /// Makes those subfacets at an edge neighbours that are of one facet.
    fn join_neighbors(&mut self, sides: &[Side]) {
        for &(_, _, subfacet, edge) in sides {
            let facet = self.subfacets[subfacet as usize].facet;
            let other = sides
                .iter()
                .map(|side| side.2)
                .find(|&other| other != subfacet && self.subfacets[other as usize].facet == facet);
            debug_assert!(other.is_some(), "an edge of one triangle of a facet is a line");
            self.subfacets[subfacet as usize].neighbors[edge as usize] = other.unwrap_or(NONE);
        }
    }

    /// Sets which lines are sharp, and the ends of these.
    pub fn set_sharp(&mut self, is_sharp: Vec<bool>, ends: &[VertexId]) -> AllocResult<()> {
        self.has_sharp = filled(self.facets.len(), false)?;
        for own in &self.subfacets {
            let mut lines = own.subsegments.iter().filter(|&&line| line != NONE);
            self.has_sharp[own.facet as usize] |= lines.any(|&line| is_sharp[line as usize]);
        }
        let first = self.at_first.as_ref();
        let sharp = || {
            ends.iter().flat_map(|&end| {
                let own = first.map_or(&[][..], |first| first.of(end.index()));
                own.iter().map(move |&facet| (facet, end.number()))
            })
        };
        self.sharp_ends = Some(Lists::of_pairs(self.facets.len(), sharp)?);
        self.is_sharp = is_sharp;
        Ok(())
    }

    /// Returns true if facets or segments meet at a small angle at a line.
    pub fn is_sharp_line(&self, line: u32) -> bool {
        self.is_sharp.get(line as usize).copied().unwrap_or(false)
    }

    /// Returns the ends of sharp lines that are on a facet, some of them several times.
    pub fn sharp_ends(&self, facet: u32) -> &[u32] {
        self.sharp_ends.as_ref().map_or(&[], |ends| ends.of(facet as usize))
    }

    /// Returns true if a facet has a sharp line.
    pub fn is_sharp_facet(&self, facet: u32) -> bool {
        self.has_sharp.get(facet as usize).copied().unwrap_or(false)
    }

    /// Returns the facets that a vertex is on which is no inner one of a line.
    pub fn facets_at(&self, vertex: VertexId) -> &[u32] {
        let first = self.at_first.as_ref().filter(|first| vertex.index() < first.count());
        match (self.inside.get(vertex.index()), first) {
            (Some(facet), _) if *facet != NONE => std::slice::from_ref(facet),
            (_, Some(first)) => first.of(vertex.index()),
            _ => &[],
        }
    }

    /// Returns the subfacets at a subsegment.
    pub fn pages(&self, subsegment: u32) -> impl Iterator<Item = u32> {
        let first = self.page_of(subsegment);
        std::iter::successors(first, move |&page| {
            let own = self.get(page);
            let edge = own.subsegments.iter().position(|&other| other == subsegment)?;
            let next = own.neighbors[edge];
            (Some(next) != first).then_some(next)
        })
    }

    /// Finds which subfacets are connected without crossing a subsegment.
    fn find_walls(&mut self, balances: &[i64], watch: &mut Watch<'_, '_>) -> Result<()> {
        let mut reached = Vec::new();
        for first in 0..self.subfacets.len() as u32 {
            let Subfacet { facet, wall, .. } = self.subfacets[first as usize];
            if wall != NONE {
                continue;
            }
            let wall = self.walls.len() as u32;
            self.walls.try_push(Wall { facet, balance: balances[facet as usize] })?;
            self.subfacets[first as usize].wall = wall;
            reached.try_push(first)?;
            while let Some(subfacet) = reached.pop() {
                watch.poll_after(1)?;
                let Subfacet { neighbors, subsegments, .. } = self.subfacets[subfacet as usize];
                for (neighbor, subsegment) in neighbors.into_iter().zip(subsegments) {
                    if subsegment == NONE && self.subfacets[neighbor as usize].wall == NONE {
                        self.subfacets[neighbor as usize].wall = wall;
                        reached.try_push(neighbor)?;
                    }
                }
            }
        }
        Ok(())
    }

    pub fn is_empty(&self) -> bool {
        self.subfacets.is_empty()
    }

    /// Returns the number of subfacets.
    pub fn len(&self) -> usize {
        self.subfacets.len()
    }

    pub fn get(&self, subfacet: u32) -> &Subfacet {
        &self.subfacets[subfacet as usize]
    }

    pub fn plane_of(&self, subfacet: u32) -> &Plane {
        &self.facets[self.get(subfacet).facet as usize].plane
    }

    /// Returns the plane of a facet there where a point is in its projection: that of one of its
    /// triangles if the facet is bent.
    pub fn plane_at(&self, facet: u32, x: &[f64; 3]) -> &Plane {
        let Facet { plane, bent, .. } = &self.facets[facet as usize];
        let bent = self.bent.get(*bent as usize);
        bent.and_then(|bent| bent.plane_at(plane.image(x))).unwrap_or(plane)
    }

    /// Returns the first part of the caller's facet that a facet is a part of. All parts are in one
    /// plane; they differ by what is beside them. O(log n) for n facets.
    pub fn first_part(&self, facet: u32) -> u32 {
        match self.facets[facet as usize].parent {
            NONE => facet,
            parent => self.facets.partition_point(|other| other.parent < parent) as u32,
        }
    }

    /// Returns true if some corners of the caller's triangles are off the plane of a facet.
    pub fn is_bent(&self, facet: u32) -> bool {
        self.facets[facet as usize].bent != NONE
    }

    /// Returns the point of a facet that is at `x` in its projection, rounded.
    pub fn point_at(&self, facet: u32, x: &[f64; 3]) -> [f64; 3] {
        self.plane_at(facet, x).at(x)
    }

    /// Returns true if a point is in the box of a facet. Where subfacets are flat but for roundings
    /// the sheet may lead to places beyond.
    pub fn is_in_box(&self, facet: u32, x: &[f64; 3]) -> bool {
        let [low, high] = &self.facets[facet as usize].bounds;
        (0..3).all(|k| low[k] <= x[k] && x[k] <= high[k])
    }

    /// Returns a normal of a facet near `x`, about which its triangles are counterclockwise.
    pub fn normal_at(&self, facet: u32, x: &[f64; 3]) -> [f64; 3] {
        self.plane_at(facet, x).normal()
    }

    /// Returns a point of a facet near `x`: the nearest of the plane there, put on the facet.
    pub fn foot(&self, facet: u32, x: &[f64; 3]) -> [f64; 3] {
        let foot = self.plane_at(facet, x).foot(x);
        if self.is_bent(facet) { self.point_at(facet, &foot) } else { foot }
    }

    /// Notes the radius of a subfacet that was not split yet.
    pub fn note_first_radius(&mut self, subfacet: u32, radius: f64) {
        let own = &mut self.facets[self.subfacets[subfacet as usize].facet as usize];
        own.first_radius = own.first_radius.min(radius);
    }

    /// Returns true if `vertex` is on a facet.
    #[inline]
    pub fn holds(&self, vertex: VertexId) -> bool {
        self.bits(vertex) != 0
    }

    /// Returns the subfacet with these vertices, if there is one.
    #[inline]
    pub fn face(&self, vertices: &[VertexId; 3]) -> Option<u32> {
        match vertices.iter().fold(u64::MAX, |bits, &vertex| bits & self.bits(vertex)) {
            0 => None,
            _ => self.faces.get(vertices),
        }
    }

    /// Returns the subfacets that are faces of a simplex, each with the number of the vertex
    /// opposite, of which `is_wanted` is true.
    #[inline]
    pub fn faces_of(
        &self,
        vertices: &[VertexId],
        is_wanted: impl Fn(usize) -> bool,
    ) -> impl Iterator<Item = (usize, u32)> {
        let bits = self.bits_of(vertices);
        let may_be = FACES.iter().enumerate().fold(0, |all, (index, &[a, b, c])| {
            let has_common = bits[a] & bits[b] & bits[c] != 0;
            all | u32::from(has_common) << index
        });
        let wanted = numbers_in(may_be).filter(move |&index| is_wanted(index));
        wanted.filter_map(move |index| {
            let [a, b, c] = FACES[index];
            Some((index, self.faces.get(&[vertices[a], vertices[b], vertices[c]])?))
        })
    }

    /// Returns true if three vertices of a simplex may be on one facet.
    #[inline]
    pub fn may_have_face(&self, vertices: &[VertexId]) -> bool {
        in_three_of(self.bits_of(vertices)) != 0
    }

    #[inline]
    fn bits_of(&self, vertices: &[VertexId]) -> [u64; 4] {
        std::array::from_fn(|at| self.bits(vertices[at]))
    }

    /// Returns the bits of the facets that a vertex is on. Vertices of one facet have a bit in
    /// common.
    #[inline]
    fn bits(&self, vertex: VertexId) -> u64 {
        self.on.get(vertex.index()).copied().unwrap_or(0)
    }

    /// Returns a page of a subsegment, if it has any.
    pub fn page_of(&self, subsegment: u32) -> Option<u32> {
        self.pages.get(subsegment as usize).copied().filter(|&page| page != NONE)
    }

    /// Queues `subfacet`, whose circumradius is given, unless it waits or is limited.
    pub fn wait(&mut self, subfacet: u32, radius: f64) -> AllocResult<()> {
        let Subfacet { is_waiting, is_limited, .. } = &mut self.subfacets[subfacet as usize];
        if *is_waiting || *is_limited {
            return Ok(());
        }
        *is_waiting = true;
        self.waiting.try_reserve(1).map_err(AllocError::from)?;
        let subfacet = std::cmp::Reverse(subfacet);
        self.waiting.push(Waiting { radius: radius.to_bits(), subfacet });
        Ok(())
    }

    /// Returns the next subfacet to look at.
    pub fn next(&mut self) -> Option<u32> {
        let Waiting { subfacet, .. } = self.waiting.pop()?;
        self.subfacets[subfacet.0 as usize].is_waiting = false;
        Some(subfacet.0)
    }

    /// Marks a subfacet as one that is not split any more, since doubles are too coarse for a
    /// vertex in it.
    pub fn limit(&mut self, subfacet: u32) {
        self.subfacets[subfacet as usize].is_limited = true;
    }

    pub fn is_limited(&self, subfacet: u32) -> bool {
        self.get(subfacet).is_limited
    }

    /// Notes that a simplex stays as it is.
    pub fn keep(&mut self, simplex: SimplexId) -> AllocResult<()> {
        self.kept.cover(simplex.index() + 1, false)?;
        self.kept[simplex] = true;
        Ok(())
    }

    /// Forgets that a simplex stays as it is.
    pub fn release(&mut self, simplex: SimplexId) {
        self.kept[simplex] = false;
    }

    pub fn is_kept(&self, simplex: SimplexId) -> bool {
        self.kept.get(simplex.index()).copied().unwrap_or(false)
    }

    /// Forgets what was known of ids that new simplices have taken.
    #[inline]
    pub fn forget(&mut self, created: &[SimplexId]) {
        if self.kept.is_empty() {
            return;
        }
        for &simplex in created {
            if let Some(kept) = self.kept.get_mut(simplex.index()) {
                *kept = false;
            }
        }
    }

    /// Returns the facets of which each vertex is one, some of them several times.
    pub fn at_vertices(&self, count: usize) -> AllocResult<Lists> {
        let of = |own: &Subfacet| own.vertices.map(|vertex| (vertex.number(), own.facet));
        Lists::of_pairs(count, || self.subfacets.iter().flat_map(of))
    }

    /// Returns the same with the first part of each facet.
    pub fn first_parts_at_vertices(&self, count: usize) -> AllocResult<Lists> {
        let of = |own: &Subfacet| {
            let part = self.first_part(own.facet);
            own.vertices.map(|vertex| (vertex.number(), part))
        };
        Lists::of_pairs(count, || self.subfacets.iter().flat_map(of))
    }

    /// Returns the subfacets at each vertex.
    pub fn subfacets_at_vertices(&self, count: usize) -> AllocResult<Lists> {
        let of =
            |(number, own): (u32, &Subfacet)| own.vertices.map(|vertex| (vertex.number(), number));
        Lists::of_pairs(count, || (0u32..).zip(&self.subfacets).flat_map(of))
    }

    /// Returns true if a vertex was there before any line or facet was split.
    pub fn is_first(&self, vertex: VertexId) -> bool {
        self.at_first.as_ref().is_some_and(|first| vertex.index() < first.count())
    }

    /// Returns the local feature size at an end of lines, if it is known.
    pub fn feature_size(&self, end: VertexId) -> Option<f64> {
        self.feature_sizes.get(end.index()).copied().filter(|size| !size.is_nan())
    }

    pub fn set_feature_size(&mut self, end: VertexId, size: f64) -> AllocResult<()> {
        self.feature_sizes.cover(end.index() + 1, f64::NAN)?;
        self.feature_sizes[end] = size;
        Ok(())
    }

    /// Returns the number of subfacets that wait for a look.
    pub fn waiting_count(&self) -> usize {
        self.waiting.len()
    }
}
