//! The result: the chains and regions as arrays, without vertices that were removed, and cut to
//! the domain if the caller asked for that.
//!
//! Everything outside stays with the result (`Triangulation::whole`) for those who need a
//! triangulation of all of the hull: location walks through it, and the certificate tests that it
//! is Delaunay. Its first simplices and vertices are those of the domain, so ids are the same.

use crate::complex::{SimplexId, VertexId};
use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::{Lists, TryGrow, collected, copied, filled, with_capacity};
use crate::mesh::{Boundary, Boxed, NONE, Triangulation, VertexKind};
use crate::netmesh::result::numbering::Numbering;
use crate::netmesh::state::segments::At;
use crate::netmesh::state::segments::walls::{Seen, Walls};
use crate::netmesh::state::watch::Watch;
use crate::netmesh::state::{Mesher, State};
use crate::numerics::coordinates;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Returns, for every simplex, true if it is outside of the domain; nothing for a mesh without
    /// segments.
    pub(super) fn outside_simplices(&mut self) -> Result<Vec<bool>> {
        if !self.state.segments.is_active() {
            return Ok(Vec::new());
        }
        let mut is_outside = with_capacity(self.state.delaunay.complex().simplex_bound())?;
        for simplex in self.state.delaunay.complex().simplices() {
            self.watch.poll_after(1)?;
            let complex = self.state.delaunay.complex();
            is_outside.push(match complex.is_live(simplex) && !complex.is_infinite(simplex) {
                true => {
                    let region = self.state.region_of(simplex)?;
                    !self.state.segments.regions.is_inside[region as usize]
                }
                false => false,
            });
        }
        Ok(is_outside)
    }

    /// Returns the subsegments, regions and forced simplices of the result. All regions are known.
    /// `limited`: vertex -> true if it is precision-limited.
    pub(super) fn boundary(&mut self, numbering: &Numbering, limited: &[bool]) -> Result<Boundary> {
        let mut boundary = Boundary::default();
        if !self.state.segments.is_active() {
            return Ok(boundary);
        }
        self.state.check_seeds()?;
        self.check_regions()?;
        let chains = &self.state.segments.chains;
        boundary.subsegments = with_capacity(chains.len())?;
        boundary.parents = with_capacity(chains.len())?;
        for subsegment in chains.in_order() {
            self.watch.poll_after(1)?;
            let number = |vertex: VertexId| numbering.vertices[vertex];
            boundary.subsegments.push(subsegment.ends.map(number));
            let line = chains.lines[subsegment.line as usize];
            boundary.parents.push(line.segment);
        }
        self.add_subfacets(&mut boundary, numbering)?;
        boundary.simplex_regions = filled(numbering.counts.iter().sum(), 0)?;
        for simplex in self.state.delaunay.complex().simplices() {
            self.watch.poll_after(1)?;
            let number = numbering.simplices[simplex];
            if number == NONE {
                continue;
            }
            let regions = &self.state.segments.regions;
            let region = regions.of(simplex).expect("all regions are known") as usize;
            boundary.simplex_regions[number as usize] = regions.labels[region];
            // Where doubles are too coarse, lengths are not known well enough to tell.
            let mut vertices = self.state.delaunay.complex().vertices(simplex).iter();
            let is_limited = vertices.any(|vertex| limited[vertex.index()]);
            if regions.is_inside[region] && !is_limited && self.state.is_bad_but_forced(simplex) {
                boundary.forced.try_push(number)?;
            }
        }
        boundary.forced.sort_unstable();
        Ok(boundary)
    }

    /// Adds the subfacets, by facets, and the simplices on both sides of them.
    fn add_subfacets(&mut self, boundary: &mut Boundary, numbering: &Numbering) -> Result<()> {
        let facets = &self.state.facets;
        if facets.is_empty() {
            return Ok(());
        }
        let count = facets.len();
        let facet = |subfacet: u32| facets.get(subfacet).facet;
        let by_facets = Lists::of_pairs(facets.facets.len(), || {
            (0..count as u32).map(|subfacet| (facet(subfacet), subfacet))
        })?;
        // Facets stand in the order of the caller's.
        debug_assert!(facets.facets.is_sorted_by_key(|facet| facet.parent));
        let mut simplices = filled(count, [NONE; 2])?;
        let complex = self.state.delaunay.complex();
        let chains = &self.state.segments.chains;
        for simplex in complex.simplices() {
            self.watch.poll_after(1)?;
            if !complex.is_live(simplex) || complex.is_infinite(simplex) {
                continue;
            }
            let vertices = complex.vertices(simplex);
            for (subfacet, side) in
                (Walls { chains, facets }).subfacets_of(vertices).into_iter().flatten()
            {
                simplices[subfacet as usize][side] = numbering.simplices[simplex];
            }
        }
        let point = |vertex: VertexId| self.state.delaunay.point(vertex);
        // Between vertices that are within roundings of a line a subfacet may have no area.
        let is_lost = |&subfacet: &u32| {
            let corners = facets.get(subfacet).vertices.map(|own| coordinates::<3>(point(own), 0));
            simplices[subfacet as usize] == [NONE; 2]
                || !facets.plane_of(subfacet).turn(corners).is_positive()
        };
        let lost = (0..count as u32).find(is_lost);
        if let Some((state, lost)) = self.state.as_space().zip(lost) {
            return Err(state.error_of_lost(lost));
        }
        for &subfacet in &by_facets.ids {
            self.watch.poll_after(2)?;
            let vertices = facets.get(subfacet).vertices.map(|vertex| numbering.vertices[vertex]);
            boundary.subfacets.try_push(vertices)?;
            boundary.subfacet_parents.try_push(facets.facets[facet(subfacet) as usize].parent)?;
            boundary.subfacet_simplices.try_push(simplices[subfacet as usize])?;
        }
        self.add_flat(boundary, numbering)
    }

    /// Adds the simplices with all vertices on one facet of the caller's, or on a side.
    fn add_flat(&mut self, boundary: &mut Boundary, numbering: &Numbering) -> Result<()> {
        let (complex, facets) = (self.state.delaunay.complex(), &self.state.facets);
        let facets_at = facets.first_parts_at_vertices(self.state.delaunay.point_count())?;
        for simplex in complex.simplices() {
            self.watch.poll_after(1)?;
            let number = numbering.simplices[simplex];
            let vertices = complex.vertices(simplex);
            if number == NONE || !vertices.iter().all(|&vertex| facets.holds(vertex)) {
                continue;
            }
            let [first, others @ ..] = vertices else { continue };
            let has = |vertex: &VertexId, facet| facets_at.of(vertex.index()).contains(&facet);
            let mut own = facets_at.of(first.index()).iter();
            if own.any(|&facet| others.iter().all(|vertex| has(vertex, facet))) {
                boundary.flat.try_push(number)?;
            }
        }
        boundary.flat.sort_unstable();
        Ok(())
    }

    /// Fails where regions meet without a segment between them. Vertices on segments are rounded,
    /// and where others are as near to a segment as that, they may come to its other side.
    fn check_regions(&mut self) -> Result<()> {
        for simplex in self.state.delaunay.complex().simplices() {
            self.watch.poll_after(1)?;
            let State { delaunay, segments, facets, .. } = &self.state;
            let (complex, regions) = (delaunay.complex(), &segments.regions);
            if !complex.is_live(simplex) || complex.is_infinite(simplex) {
                continue;
            }
            let vertices = complex.vertices(simplex);
            let sides = Walls { chains: &segments.chains, facets }.of(vertices);
            let leaks = |(side, &beyond): (Seen, &SimplexId)| {
                side.is_none()
                    && !complex.is_infinite(beyond)
                    && regions.of(beyond) != regions.of(simplex)
            };
            if sides.into_iter().zip(complex.neighbors(simplex)).any(leaks) {
                let message = message!(
                    "doubles have no room for the regions between segments near {}, which vertices \
                     are within roundings of",
                    At(delaunay.point(vertices[0]))
                );
                return Err(Error::new(ErrorKind::Limit, message));
            }
        }
        Ok(())
    }
}

/// Returns the part of `whole` that is the domain, with the whole of it if that is more.
pub(super) fn crop(
    whole: Triangulation,
    numbering: &Numbering,
    watch: &mut Watch<'_, '_>,
) -> Result<Triangulation> {
    if numbering.inside_simplices == whole.simplex_count() {
        return Ok(whole);
    }
    let mut result = part(&whole, numbering.inside_simplices, numbering.inside_vertices, watch)?;
    count_vertices(&mut result);
    result.boundary.whole = Some(Boxed::new(whole)?);
    Ok(result)
}

/// Returns the first simplices and vertices of `whole`.
fn part(
    whole: &Triangulation,
    simplices: usize,
    vertices: usize,
    watch: &mut Watch<'_, '_>,
) -> Result<Triangulation> {
    let ids = simplices * (whole.dim + 1);
    let is_inside = |&simplex: &u32| (simplex as usize) < simplices;
    let inside_of = |all: &[u32]| collected(all.iter().copied().filter(is_inside));
    let number = |simplex: u32| if is_inside(&simplex) { simplex } else { NONE };
    Ok(Triangulation {
        dim: whole.dim,
        boundary: part_of_boundary(whole, simplices, vertices, watch)?,
        points: watched(whole.points[..vertices * whole.dim].iter().copied(), watch)?,
        simplices: watched(whole.simplices[..ids].iter().copied(), watch)?,
        neighbors: watched(whole.neighbors[..ids].iter().map(|&id| number(id)), watch)?,
        kinds: watched(whole.kinds[..vertices].iter().copied(), watch)?,
        vertex_domains: watched(whole.vertex_domains[..vertices].iter().copied(), watch)?,
        cage_of: watched(whole.cage_of[..vertices].iter().copied(), watch)?,
        domains: copied(&whole.domains)?,
        precision_limited: watched(whole.precision_limited[..vertices].iter().copied(), watch)?,
        below_min_dihedral: inside_of(&whole.below_min_dihedral)?,
        // Of a domain only radius-edge ratios have a bound, and so these are simplices.
        beyond_bound: inside_of(&whole.beyond_bound)?,
        sizes: copied(&whole.sizes[..vertices.min(whole.sizes.len())])?,
        parameters: whole.parameters.clone(),
        stats: whole.stats.clone(),
    })
}

/// Returns the boundary of the first simplices and vertices of `whole`.
fn part_of_boundary(
    whole: &Triangulation,
    simplices: usize,
    vertices: usize,
    watch: &mut Watch<'_, '_>,
) -> Result<Boundary> {
    let all = &whole.boundary;
    let is_inside = |&simplex: &u32| (simplex as usize) < simplices;
    let number = |simplex: u32| if is_inside(&simplex) { simplex } else { NONE };
    // A subsegment of which neither side is inside is no edge of the domain.
    let per_simplex = whole.dim + 1;
    let inside = whole.simplices[..simplices * per_simplex].chunks_exact(per_simplex);
    let is_edge = all.edges_of(vertices, inside, |work| watch.poll_after(work))?;
    let kept = || (0..is_edge.len()).filter(|&at| is_edge[at]);
    let is_side = |&at: &usize| all.subfacet_simplices[at].iter().any(is_inside);
    let kept_facets = || (0..all.subfacets.len()).filter(is_side);
    let sides = kept_facets().map(|at| all.subfacet_simplices[at].map(number));
    Ok(Boundary {
        subsegments: watched(kept().map(|at| all.subsegments[at]), watch)?,
        parents: watched(kept().map(|at| all.parents[at]), watch)?,
        subfacets: watched(kept_facets().map(|at| all.subfacets[at]), watch)?,
        subfacet_parents: watched(kept_facets().map(|at| all.subfacet_parents[at]), watch)?,
        subfacet_simplices: watched(sides, watch)?,
        flat: collected(all.flat.iter().copied().filter(is_inside))?,
        simplex_regions: watched(all.simplex_regions[..simplices].iter().copied(), watch)?,
        forced: copied(&all.forced)?,
        whole: None,
    })
}

/// Returns the values of an iterator. The watch is polled meanwhile.
fn watched<T>(values: impl Iterator<Item = T>, watch: &mut Watch<'_, '_>) -> Result<Vec<T>> {
    let mut all = with_capacity(values.size_hint().0)?;
    for value in values {
        watch.poll_after(1)?;
        all.try_push(value)?;
    }
    Ok(all)
}

fn count_vertices(triangulation: &mut Triangulation) {
    let count = |kind| triangulation.kinds.iter().filter(|&&k| k == kind).count() as u64;
    let limited = triangulation.precision_limited.iter().filter(|&&limited| limited).count();
    let [inputs, steiner, cage] =
        [VertexKind::Input, VertexKind::Steiner, VertexKind::Cage].map(count);
    let stats = &mut triangulation.stats;
    (stats.input_vertices, stats.steiner_vertices) = (inputs, steiner);
    (stats.cage_vertices, stats.precision_limited) = (cage, limited as u64);
}
