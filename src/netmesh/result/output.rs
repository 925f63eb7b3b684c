//! From the state of a run to plain data: finite simplices and living domains, renumbered.

use crate::complex::{SimplexId, VertexId};
use crate::error::Result;
use crate::memory::{AllocError, AllocResult, Array, TryGrow, collected, filled, with_capacity};
use crate::mesh::{Domain, MAX_DIM, NONE, Triangulation, VertexKind};
use crate::netmesh::result::boundary::crop;
use crate::netmesh::result::numbering::Numbering;
use crate::netmesh::state::hierarchy::{DomainId, ROOT};
use crate::netmesh::state::refine_list::RefineList;
use crate::netmesh::state::watch::Watch;
use crate::netmesh::state::workers::{PIECE, on_threads, pieces};
use crate::netmesh::state::{Mesher, Scratch, State};
use crate::options::{Algorithm, Phase};
use std::mem::take;
use std::time::Instant;

/// The number of pieces after which the simplices that are in the result are given back.
const GIVEN_BACK: usize = 32;

impl<'a, 'b, const D: usize> Mesher<'a, 'b, D> {
    pub(in crate::netmesh) fn into_triangulation(
        mut self,
        begun: Instant,
    ) -> Result<Triangulation> {
        self.state.stage.phase = Phase::Export;
        self.report_progress()?;
        let is_outside = self.outside_simplices()?;
        let precision_limited = self.limited_vertices()?;
        self.state.stats.exact_fallbacks = self.state.delaunay.exact_fallbacks();
        self.state.stats.simplices_created = self.state.delaunay.simplices_created();
        self.state.stats.touches = self.state.conflict_lists.total_touches();
        self.state.stats.max_touches = u64::from(self.state.conflict_lists.max_touches());
        let begun = begun + self.measure_instruments()?;
        let numbering = self.numbering(&is_outside)?;
        let boundary = self.boundary(&numbering, &precision_limited)?;
        let cells_beyond = self.cells_beyond_bound()?;
        self.free_what_is_done()?;
        let (simplices, neighbors) = self.finite_simplices(&numbering)?;
        let (domains, indices) = self.living_domains(&numbering)?;
        let asked = self.sizes.take();
        let mut sizes = Vec::new();
        for &vertex in asked.iter().flat_map(|_| &numbering.order) {
            self.watch.poll_after(1)?;
            if let Some(size) = asked.as_ref().and_then(|asked| asked.answer(vertex)) {
                sizes.try_push(size)?;
            }
        }
        let Vertices { points, kinds, domains: vertex_domains, cage_of, limited } =
            self.vertices(&numbering.order, &precision_limited, &indices)?;
        self.count_vertices(&kinds, &limited);
        let below_min_dihedral =
            self.slivers_left(&points, &simplices, &vertex_domains, &boundary.flat)?;
        let mut beyond_bound = self.simplices_beyond_bound(&points, &simplices, &vertex_domains)?;
        for vertex in cells_beyond {
            beyond_bound.try_push(numbering.vertices[vertex])?;
        }
        beyond_bound.sort_unstable();
        self.state.stats.seconds = begun.elapsed().as_secs_f64();
        let whole = Triangulation {
            dim: D,
            points: points.into_vec()?,
            simplices,
            neighbors,
            kinds: kinds.into_vec()?,
            vertex_domains: vertex_domains.into_vec()?,
            cage_of: cage_of.into_vec()?,
            domains,
            precision_limited: limited.into_vec()?,
            below_min_dihedral,
            boundary,
            sizes,
            beyond_bound,
            parameters: self.state.parameters.clone(),
            stats: self.state.stats.clone(),
        };
        crop(whole, &numbering, &mut self.freed()?)
    }

    /// Frees what is left of the run, a part at a time. Returns its watch.
    fn freed(self) -> Result<Watch<'a, 'b>> {
        let Self { state, mut watch, .. } = self;
        let State { delaunay, hierarchy, conflict_lists, segments, facets, .. } = state;
        drop(delaunay);
        watch.poll()?;
        drop((hierarchy, conflict_lists));
        watch.poll()?;
        drop(segments);
        watch.poll()?;
        drop(facets);
        watch.poll()?;
        Ok(watch)
    }

    /// Frees what the result is not made from, a piece at a time: giving memory back to the system
    /// takes a while, and the caller may want to cancel.
    fn free_what_is_done(&mut self) -> Result<()> {
        self.state.delaunay.forget_balls();
        self.report_progress()?;
        self.state.refine_list = RefineList::default();
        self.scratch = Scratch::default();
        self.state.cells = Array::new();
        Ok(())
    }

    /// Returns the vertices and neighbours of the finite simplices, and forgets all simplices as it
    /// goes: the result takes the memory that the mesh gives back. The last come first, for an
    /// array ends where it gives memory back.
    fn finite_simplices(&mut self, numbering: &Numbering) -> Result<(Vec<u32>, Vec<u32>)> {
        let Numbering { vertices, simplices: numbers, counts, .. } = numbering;
        let reserves = collected(counts.iter().map(|count| count * (D + 1)))?;
        let (mut simplices, mut neighbors) = (Array::new(), Array::new());
        let mut all = collected(
            shares(&mut simplices, &reserves)?.into_iter().zip(shares(&mut neighbors, &reserves)?),
        )?;
        // Each piece has a share for what is inside and one for what is outside.
        let (inside, outside) = all.split_at_mut(counts.len() / 2);
        let sides =
            inside.iter_mut().zip(outside).map(|(inside, outside)| [take(inside), take(outside)]);
        let mut shares = collected(pieces(numbers.len()).zip(sides))?;
        let mut filled = with_capacity(shares.len())?;
        let threads = self.state.threads();
        let first_outside = numbering.inside_simplices as u32;
        while !shares.is_empty() {
            let begin = shares.len().saturating_sub(GIVEN_BACK);
            let work = shares.drain(begin..);
            let Self { state, watch, .. } = self;
            let complex = state.delaunay.complex();
            filled.push(on_threads(threads, watch, work, |(piece, mut sides)| {
                let mut row = [NONE; MAX_DIM + 1];
                let row = &mut row[..=D];
                for simplex in piece.filter(|&simplex| numbers[simplex] != NONE) {
                    let own = &mut sides[usize::from(numbers[simplex] >= first_outside)];
                    for (number, &vertex) in row.iter_mut().zip(complex.vertices(simplex)) {
                        *number = vertices[vertex];
                    }
                    own.0.try_extend(row)?;
                    for (number, &neighbor) in row.iter_mut().zip(complex.neighbors(simplex)) {
                        *number = numbers[neighbor];
                    }
                    own.1.try_extend(row)?;
                }
                Ok(sides)
            })?);
            state.delaunay.forget_from(SimplexId::new(begin * PIECE));
        }
        for side in 0..2 {
            for of_piece in filled.iter_mut().rev().flatten() {
                let (own_simplices, own_neighbors) = take(&mut of_piece[side]);
                simplices.absorb(own_simplices)?;
                neighbors.absorb(own_neighbors)?;
            }
        }
        debug_assert!(!simplices.contains(&NONE));
        Ok((simplices.into_vec()?, neighbors.into_vec()?))
    }

    /// Returns the arrays of the vertices in `order`. `indices`: domain -> its index in the result.
    fn vertices(
        &mut self,
        order: &[VertexId],
        precision_limited: &[bool],
        indices: &[u32],
    ) -> Result<Vertices> {
        let threads = self.state.threads();
        let Self { state, watch, .. } = self;
        state.hierarchy.compress(|| watch.poll_after(1))?;
        let State { delaunay, hierarchy, inputs, .. } = &*state;
        let renumbered = |domain: DomainId| indices.get(domain.index()).copied().unwrap_or(NONE);
        let pieces = order.chunks(PIECE);
        let counts = collected(pieces.clone().map(<[VertexId]>::len))?;
        let coordinates = collected(counts.iter().map(|count| count * D))?;
        let mut all = Vertices::default();
        let shares = shares(&mut all.points, &coordinates)?
            .into_iter()
            .zip(shares(&mut all.kinds, &counts)?)
            .zip(shares(&mut all.domains, &counts)?)
            .zip(shares(&mut all.cage_of, &counts)?)
            .zip(shares(&mut all.limited, &counts)?)
            .map(|((((points, kinds), domains), cage_of), limited)| Vertices {
                points,
                kinds,
                domains,
                cage_of,
                limited,
            });
        let filled = on_threads(threads, watch, pieces.zip(shares), |(piece, mut own)| {
            for &vertex in piece {
                let cage = renumbered(hierarchy.cage_of(vertex));
                own.points.try_extend(delaunay.point(vertex))?;
                own.kinds.try_push(match vertex.index() < *inputs {
                    true => VertexKind::Input,
                    false if cage != NONE => VertexKind::Cage,
                    false => VertexKind::Steiner,
                })?;
                own.domains.try_push(match indices.is_empty() {
                    true => NONE,
                    false => renumbered(hierarchy.compressed_domain_of(vertex)),
                })?;
                own.cage_of.try_push(cage)?;
                own.limited.try_push(precision_limited[vertex])?;
            }
            Ok(own)
        })?;
        for own in filled {
            all.points.absorb(own.points)?;
            all.kinds.absorb(own.kinds)?;
            all.domains.absorb(own.domains)?;
            all.cage_of.absorb(own.cage_of)?;
            all.limited.absorb(own.limited)?;
        }
        Ok(all)
    }

    /// Returns the living domains, parents before children, and the map from ids to their indices.
    fn living_domains(&mut self, numbering: &Numbering) -> Result<(Vec<Domain>, Vec<u32>)> {
        let count = self.state.hierarchy.len();
        let is_alive = |&domain: &DomainId| self.state.hierarchy.node(domain).alive;
        let mut living = collected((0..count).map(DomainId::new).filter(is_alive))?;
        // A parent's ball contains its children's: by falling radius parents come first.
        living.sort_unstable_by(|&a, &b| {
            let radius = |domain: DomainId| self.state.hierarchy.node(domain).radius;
            radius(b).total_cmp(&radius(a)).then(a.cmp(&b))
        });
        debug_assert!(living.first().is_none_or(|&domain| domain == ROOT));
        let mut ids = filled(count, NONE)?;
        for (index, &domain) in living.iter().enumerate() {
            ids[domain.index()] = index as u32;
        }
        let mut domains = with_capacity(living.len())?;
        for &domain in &living {
            self.watch.poll_after(1)?;
            let parent = self.state.hierarchy.parent(domain);
            let parent = ids.get(parent.index()).copied().unwrap_or(NONE);
            let node = self.state.hierarchy.node(domain);
            let center = numbering.vertices[node.center];
            domains.push(Domain { center, parent, radius: node.radius });
        }
        Ok((domains, ids))
    }

    /// Returns, for every vertex, true if its cage could not be made, or a corner next to it could
    /// not be inserted, or it is so near to another that ratios of radii and distances drown in the
    /// rounding of subnormals, or the guard of facets leaves a simplex beside it as it is though no
    /// small angle excuses it. All regions are known.
    pub(in crate::netmesh) fn limited_vertices(&mut self) -> Result<Vec<bool>> {
        const SUBNORMAL: f64 = f64::from_bits(1 << 30);
        let mut limited = take(&mut self.state.precision_limited);
        for (limited, cell) in limited.iter_mut().zip(&self.state.cells) {
            *limited |= cell.nearest < SUBNORMAL;
        }
        for simplex in self.state.delaunay.complex().simplices() {
            self.watch.poll_after(1)?;
            if self.state.delaunay.complex().is_live(simplex)
                && (self.state.refine_list.is_limited(simplex)
                    || self.state.is_left_at_no_angle(simplex))
            {
                for &vertex in self.state.delaunay.complex().vertices(simplex) {
                    limited[vertex] = true;
                }
            }
        }
        Ok(limited)
    }

    fn count_vertices(&mut self, kinds: &[VertexKind], limited: &[bool]) {
        let count = |kind| kinds.iter().filter(|&&k| k == kind).count() as u64;
        self.state.stats.input_vertices = count(VertexKind::Input);
        self.state.stats.steiner_vertices = count(VertexKind::Steiner);
        self.state.stats.cage_vertices = count(VertexKind::Cage);
        self.state.stats.precision_limited = limited.iter().filter(|&&l| l).count() as u64;
        debug_assert!(
            self.state.parameters.algorithm != Algorithm::Delaunay
                || self.state.hierarchy.len() == 0
        );
    }
}

/// Arrays of the result with an entry for every vertex.
#[derive(Default)]
struct Vertices {
    points: Array<f64>,
    kinds: Array<VertexKind>,
    domains: Array<u32>,
    cage_of: Array<u32>,
    limited: Array<bool>,
}

/// Splits new memory for `array`, which is empty: `reserves` has the number of values for each
/// share.
fn shares<T: Copy>(array: &mut Array<T>, reserves: &[usize]) -> AllocResult<Vec<Array<T>>> {
    array.reserve(reserves.iter().sum())?;
    array.split_reserve(reserves).ok_or(AllocError::Memory)
}
