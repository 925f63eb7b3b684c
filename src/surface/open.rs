//! Open surfaces: facets about which the umbrellas of their vertices agree, and that are not large
//! beside the distances of points there. What is left between them where vertices do not agree is
//! filled, as long as the surface stays a manifold with a boundary.

use super::balls::{Balls, orthogonal, unit_vector};
use super::chosen::{Chosen, Link, vertices_of};
use super::pieces::LEAST_SUPPORT;
use super::umbrellas::Umbrellas;
use crate::memory::{AllocResult, Sets, TryGrow, collected, enqueue, filled};
use crate::mesh::NONE;
use crate::numerics::norm;
use crate::query::unit::Unit;
use crate::query::view::View;
use std::collections::VecDeque;

/// Largest circumradius of a facet in distances of points: what is larger is a hole.
const GAP: f64 = 5.0;

/// Largest circumradius in distances of points for a facet in space that not all its neighbours ask
/// for. Few facets of random points have a larger one, but what bridges the end of a tube has.
const BRIDGE: f64 = 3.0;

/// Most times that facets which do not fit yet are tried again.
const SWEEPS: usize = 16;

/// Sizes of facets beside the distances of points.
struct Sizes<'a, const D: usize> {
    view: View<'a, D>,
    unit: Unit,
    /// Vertex -> its distance to its third nearest neighbour across its umbrella, the nearest one
    /// in the plane; 0 without an umbrella.
    distances: Vec<f64>,
}

/// Returns the vertices of the facets of the open surface through the vertices of a Delaunay
/// triangulation, `facets x dim`. `depths` has for each facet, at the first of its places, how
/// deeply the balls beside it intersect. O(simplices) for surfaces that are sampled well.
pub fn facets<const D: usize>(
    balls: &Balls<'_, D>,
    depths: &[f64],
    umbrellas: &Umbrellas<'_, D>,
    agreements: &[f64],
) -> AllocResult<Vec<u32>> {
    let (view, unit) = (balls.view, balls.unit);
    let sizes = Sizes::new(view, unit, umbrellas)?;
    let mut chosen = Chosen::new(view, unit)?;
    let largest = if D == 2 { GAP } else { BRIDGE };
    let mut doubtful = Vec::new();
    for at in (0..depths.len()).filter(|&at| umbrellas.votes(at) > 0) {
        match umbrellas.votes(at) == D as u32 && sizes.of(at) <= largest {
            true => chosen.choose(at)?,
            false => doubtful.try_push(at)?,
        }
    }
    doubtful.sort_unstable_by(|&a, &b| {
        let votes = umbrellas.votes(b).cmp(&umbrellas.votes(a));
        votes.then(depths[a].total_cmp(&depths[b])).then(a.cmp(&b))
    });
    fill(&mut chosen, &mut doubtful, |at, ridges| ridges >= 1 && sizes.of(at) <= largest)?;
    if D == 3 {
        doubtful = missing(&chosen)?;
        doubtful.sort_unstable_by(|&a, &b| depths[a].total_cmp(&depths[b]).then(a.cmp(&b)));
        fill(&mut chosen, &mut doubtful, |at, ridges| ridges >= 2 && sizes.of(at) <= BRIDGE)?;
        fill(&mut chosen, &mut doubtful, |at, ridges| ridges == 3 && sizes.of(at) <= GAP)?;
    }
    prune(&mut chosen)?;
    supported(&chosen, agreements)
}

impl<'a, const D: usize> Sizes<'a, D> {
    fn new(view: View<'a, D>, unit: Unit, umbrellas: &Umbrellas<'a, D>) -> AllocResult<Self> {
        const NEAREST: usize = 3;
        let none = [(f64::INFINITY, NONE); NEAREST];
        let mut nearest = filled(view.mesh.vertex_count(), none)?;
        let mut sizes = Self { view, unit, distances: Vec::new() };
        umbrellas.for_each_member(|at, vertex| {
            for other in vertices_of(view, at).into_iter().filter(|&other| other != vertex) {
                let nearest = &mut nearest[vertex as usize];
                let length = norm(&unit.difference(view.point(vertex), view.point(other)));
                // In space two facets have the edge.
                let is_known = nearest.iter().any(|&(_, known)| known == other);
                if !is_known && length < nearest[NEAREST - 1].0 {
                    nearest[NEAREST - 1] = (length, other);
                    nearest.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
                }
            }
        });
        let rank = if D == 2 { 0 } else { NEAREST - 1 };
        let distance = |nearest: &[(f64, u32); NEAREST]| match nearest[rank].0 {
            distance if distance.is_finite() => distance,
            _ => 0.0,
        };
        sizes.distances = collected(nearest.iter().map(distance))?;
        Ok(sizes)
    }

    /// Returns the circumradius of a facet in distances of points.
    fn of(&self, at: usize) -> f64 {
        let vertices = vertices_of(self.view, at);
        let mut distances = vertices.map(|vertex| self.distances[vertex as usize]);
        // In space the one between: a vertex at a hole may have few neighbours that are near.
        distances.sort_unstable_by(f64::total_cmp);
        radius(self.view, self.unit, &vertices) / distances[1]
    }
}

/// Returns the circumradius of a facet in a unit: half an edge over the sine of the opposite angle.
pub fn radius<const D: usize>(view: View<'_, D>, unit: Unit, facet: &[u32]) -> f64 {
    let way = |k: usize| unit.difference(view.point(facet[k]), view.point(facet[D - 1]));
    if D == 2 {
        return 0.5 * norm(&way(0));
    }
    let edge = unit.difference(view.point(facet[0]), view.point(facet[1]));
    0.5 * norm(&edge) / norm(&orthogonal(&[unit_vector(way(0))], unit_vector(way(1))))
}

/// Chooses those of facets, the best first, that fit and that may go on from chosen ones across so
/// many ridges, until there are no more; the others stay in the list.
fn fill<const D: usize>(
    chosen: &mut Chosen<'_, D>,
    facets: &mut Vec<usize>,
    may: impl Fn(usize, usize) -> bool,
) -> AllocResult<()> {
    let mut link = Link::default();
    for _ in 0..SWEEPS {
        let mut waiting = Vec::new();
        for &at in &*facets {
            match chosen.fits(at, &mut link)? {
                Some(ridges) if may(at, ridges) => chosen.choose(at)?,
                _ => waiting.try_push(at)?,
            }
        }
        if waiting.len() == facets.len() {
            break;
        }
        *facets = waiting;
    }
    Ok(())
}

/// Returns the facets that are not chosen, all of whose vertices are where the surface ends.
fn missing<const D: usize>(chosen: &Chosen<'_, D>) -> AllocResult<Vec<usize>> {
    let view = chosen.view;
    let mut is_end = filled(view.mesh.vertex_count(), false)?;
    let mut link = Link::default();
    for vertex in 0..is_end.len() as u32 {
        chosen.read_link(vertex, &mut link)?;
        is_end[vertex as usize] = link.has_end();
    }
    let mut missing = Vec::new();
    for (at, &neighbor) in view.mesh.neighbors.iter().enumerate() {
        let is_first = ((at / (D + 1)) as u32) < neighbor;
        let ends = || vertices_of(view, at).iter().all(|&vertex| is_end[vertex as usize]);
        if is_first && !chosen.has(at) && ends() {
            missing.try_push(at)?;
        }
    }
    Ok(missing)
}

/// Keeps the largest fan of facets at each vertex, until there is one at each.
fn prune<const D: usize>(chosen: &mut Chosen<'_, D>) -> AllocResult<()> {
    let (mut link, mut fans) = (Link::default(), Vec::new());
    let mut waiting = VecDeque::new();
    (0..chosen.view.mesh.vertex_count() as u32).try_for_each(|v| enqueue(&mut waiting, v))?;
    while let Some(vertex) = waiting.pop_front() {
        chosen.read_link(vertex, &mut link)?;
        let count = link.fans(D == 2, &mut fans)?;
        let size = |fan: u32| fans.iter().filter(|&&other| other == fan).count();
        // Of fans of one size the first.
        let Some(largest) = (0..count).rev().max_by_key(|&fan| size(fan)) else { continue };
        for (&(rest, at), _) in link.facets.iter().zip(&fans).filter(|(_, fan)| **fan != largest) {
            chosen.give_up(at);
            let others = rest.into_iter().filter(|&other| other != NONE);
            others.into_iter().try_for_each(|other| enqueue(&mut waiting, other))?;
        }
    }
    Ok(())
}

/// Returns the vertices of the chosen facets, but for parts whose vertices do not agree about
/// their umbrellas: what is between outliers.
fn supported<const D: usize>(chosen: &Chosen<'_, D>, agreements: &[f64]) -> AllocResult<Vec<u32>> {
    let count = agreements.len();
    let mut parts = Sets::new(count)?;
    let mut is_used = filled(count, false)?;
    for at in chosen.places() {
        let vertices = vertices_of(chosen.view, at);
        for vertex in vertices {
            parts.join(vertices[0] as usize, vertex as usize);
            is_used[vertex as usize] = true;
        }
    }
    let (mut vertices, mut support) = (filled(count, 0u32)?, filled(count, 0.0)?);
    for vertex in (0..count).filter(|&vertex| is_used[vertex]) {
        let part = parts.find(vertex);
        vertices[part] += 1;
        support[part] += agreements[vertex];
    }
    let mut facets = Vec::new();
    for at in chosen.places() {
        let facet = vertices_of(chosen.view, at);
        let part = parts.find(facet[0] as usize);
        if support[part] >= LEAST_SUPPORT * f64::from(vertices[part]) {
            facets.try_extend(&facet)?;
        }
    }
    Ok(facets)
}
