//! The result: the chains and regions as arrays, without vertices that were removed, and cut to
//! the domain if the caller asked for that.
//!
//! What is outside stays with the result (`Triangulation::whole`) for those who need a
//! triangulation of all of the hull: location walks through it, and the certificate tests that it
//! is Delaunay. Its first simplices and vertices are those of the domain, so ids are the same.

use crate::complex::VertexId;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow, collected, copied, filled, with_capacity};
use crate::mesh::{self, Boundary, NONE, Triangulation, VertexKind};
use crate::netmesh::segments::Segments;
use crate::netmesh::{Mesher, State};
use crate::options::Extent;

/// What segments and regions are in the result.
pub(in crate::netmesh) struct Domain {
    boundary: Boundary,
    /// Simplex -> whether it is of the domain.
    is_inside: Vec<bool>,
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// Finite simplices are numbered by rising ids in the result, and vertices by `id`.
    pub(in crate::netmesh) fn domain_boundary(
        &mut self,
        id: impl Fn(VertexId) -> u32,
    ) -> Result<Option<Domain>> {
        if !self.state.segments.is_active() {
            return Ok(None);
        }
        let (mut boundary, mut all_inside) = (Boundary::default(), Vec::new());
        let chains = &self.state.segments.chains;
        boundary.subsegments = with_capacity(chains.len())?;
        boundary.parents = with_capacity(chains.len())?;
        for subsegment in chains.in_order() {
            self.watch.poll_after(1)?;
            boundary.subsegments.push(subsegment.ends.map(&id));
            let line = chains.lines[subsegment.line as usize];
            boundary.parents.push(line.segment);
        }
        for simplex in self.state.delaunay.complex().simplices() {
            self.watch.poll_after(1)?;
            let State { delaunay, segments, .. } = &mut self.state;
            let complex = delaunay.complex();
            if !complex.is_live(simplex) || complex.is_infinite(simplex) {
                continue;
            }
            let number = all_inside.len() as u32;
            let Segments { regions, chains, visited, .. } = segments;
            let region = regions.resolve(simplex, complex, chains, visited)? as usize;
            let is_refined = regions.is_refined[region];
            all_inside.try_push(is_refined)?;
            boundary.simplex_regions.try_push(regions.labels[region])?;
            if is_refined && self.is_bad_but_forced(simplex) {
                boundary.forced.try_push(number)?;
            }
        }
        Ok(Some(Domain { boundary, is_inside: all_inside }))
    }
}

impl Domain {
    /// Completes `whole`, which has no boundary yet.
    pub fn complete(self, mut whole: Triangulation, inputs: usize) -> Result<Triangulation> {
        let order = Order::new(&whole, &self.is_inside, inputs)?;
        let is_cut = order.inside_simplices < whole.simplex_count();
        whole.boundary = self.boundary;
        let mut whole = order.apply(whole)?;
        count_vertices(&mut whole);
        if !is_cut || whole.parameters.extent == Extent::All {
            return Ok(whole);
        }
        let mut result = order.cut(&whole)?;
        count_vertices(&mut result);
        result.boundary.whole = Some(Box::new(whole));
        Ok(result)
    }
}

/// The new numbers of simplices and vertices: those of the domain come first, each in the order in
/// which they were.
struct Order {
    /// New number -> old one.
    simplices: Vec<u32>,
    vertices: Vec<u32>,
    inside_simplices: usize,
    inside_vertices: usize,
}

impl Order {
    fn new(whole: &Triangulation, is_inside: &[bool], inputs: usize) -> AllocResult<Self> {
        let all = 0..whole.simplex_count() as u32;
        let inside = |&simplex: &u32| is_inside[simplex as usize];
        let mut simplices = collected(all.clone().filter(inside))?;
        let inside_simplices = simplices.len();
        for simplex in all.filter(|simplex| !inside(simplex)) {
            simplices.try_push(simplex)?;
        }
        // 0: of no simplex, 1: of one outside, 2: of the domain, as all inputs and centres are.
        let mut rank = filled(whole.vertex_count(), 0u8)?;
        rank[..inputs].fill(2);
        whole.domains.iter().for_each(|domain| rank[domain.center as usize] = 2);
        for (simplex, &is_inside) in is_inside.iter().enumerate() {
            for &vertex in whole.simplex(simplex) {
                let rank = &mut rank[vertex as usize];
                *rank = (*rank).max(1 + u8::from(is_inside));
            }
        }
        let of_rank = |wanted: u8| {
            rank.iter().zip(0u32..).filter(move |&(&rank, _)| rank == wanted).map(|(_, v)| v)
        };
        let mut vertices = collected(of_rank(2))?;
        let inside_vertices = vertices.len();
        for vertex in of_rank(1) {
            vertices.try_push(vertex)?;
        }
        Ok(Self { simplices, vertices, inside_simplices, inside_vertices })
    }

    /// `whole` by the new numbers.
    fn apply(&self, whole: Triangulation) -> AllocResult<Triangulation> {
        let corners = whole.dim + 1;
        let new_vertices = inverse(&self.vertices, whole.vertex_count())?;
        let new_simplices = inverse(&self.simplices, whole.simplex_count())?;
        let vertex = |old: u32| new_vertices[old as usize];
        let simplex = |old: u32| if old == NONE { NONE } else { new_simplices[old as usize] };
        let old = &whole.boundary;
        let mut boundary = Boundary {
            subsegments: collected(old.subsegments.iter().map(|ends| ends.map(vertex)))?,
            parents: copied(&old.parents)?,
            simplex_regions: gathered(&old.simplex_regions, &self.simplices, 1)?,
            forced: collected(old.forced.iter().map(|&old| simplex(old)))?,
            whole: None,
        };
        boundary.forced.sort_unstable();
        Ok(Triangulation {
            points: gathered(&whole.points, &self.vertices, whole.dim)?,
            simplices: collected(
                gathered(&whole.simplices, &self.simplices, corners)?.into_iter().map(vertex),
            )?,
            neighbors: collected(
                gathered(&whole.neighbors, &self.simplices, corners)?.into_iter().map(simplex),
            )?,
            kinds: gathered(&whole.kinds, &self.vertices, 1)?,
            vertex_domains: gathered(&whole.vertex_domains, &self.vertices, 1)?,
            cage_of: gathered(&whole.cage_of, &self.vertices, 1)?,
            precision_limited: gathered(&whole.precision_limited, &self.vertices, 1)?,
            domains: collected(
                whole
                    .domains
                    .iter()
                    .map(|&domain| mesh::Domain { center: vertex(domain.center), ..domain }),
            )?,
            boundary,
            sizes: match whole.sizes.is_empty() {
                true => Vec::new(),
                false => gathered(&whole.sizes, &self.vertices, 1)?,
            },
            ..whole
        })
    }

    /// The part of `whole`, which has the new numbers, that is the domain.
    fn cut(&self, whole: &Triangulation) -> AllocResult<Triangulation> {
        let (simplices, vertices) = (self.inside_simplices, self.inside_vertices);
        let corners = whole.dim + 1;
        let is_inside = |&simplex: &u32| (simplex as usize) < simplices;
        let neighbors = whole.neighbors[..simplices * corners].iter();
        // A subsegment of which neither side is inside is no edge of the domain.
        let kept = |&[a, b]: &[u32; 2]| (a.max(b) as usize) < vertices;
        let all = &whole.boundary;
        let pairs = || all.subsegments.iter().zip(&all.parents).filter(|(ends, _)| kept(ends));
        let boundary = Boundary {
            subsegments: collected(pairs().map(|(ends, _)| *ends))?,
            parents: collected(pairs().map(|(_, parent)| *parent))?,
            simplex_regions: copied(&all.simplex_regions[..simplices])?,
            forced: copied(&all.forced)?,
            whole: None,
        };
        Ok(Triangulation {
            dim: whole.dim,
            points: copied(&whole.points[..vertices * whole.dim])?,
            simplices: copied(&whole.simplices[..simplices * corners])?,
            neighbors: collected(neighbors.map(|id| if is_inside(id) { *id } else { NONE }))?,
            kinds: copied(&whole.kinds[..vertices])?,
            vertex_domains: copied(&whole.vertex_domains[..vertices])?,
            cage_of: copied(&whole.cage_of[..vertices])?,
            domains: copied(&whole.domains)?,
            precision_limited: copied(&whole.precision_limited[..vertices])?,
            below_min_dihedral: Vec::new(),
            beyond_bound: Vec::new(),
            boundary,
            sizes: copied(&whole.sizes[..vertices.min(whole.sizes.len())])?,
            parameters: whole.parameters.clone(),
            stats: whole.stats.clone(),
        })
    }
}

/// Old number -> new one, [`NONE`] for those that are gone.
fn inverse(old: &[u32], count: usize) -> AllocResult<Vec<u32>> {
    let mut inverse = filled(count, NONE)?;
    for (&old, new) in old.iter().zip(0..) {
        inverse[old as usize] = new;
    }
    Ok(inverse)
}

/// The rows of `width` values at `at`.
fn gathered<T: Copy>(values: &[T], at: &[u32], width: usize) -> AllocResult<Vec<T>> {
    let mut gathered = with_capacity(at.len() * width)?;
    for &row in at {
        gathered.extend_from_slice(&values[row as usize * width..][..width]);
    }
    Ok(gathered)
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
