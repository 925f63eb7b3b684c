//! Shells of open surfaces: which way their facets go, where they end, and their topology.

use super::forest::SignedForest;
use super::shells::Shell;
use crate::memory::{AllocResult, Sets, TryGrow, filled, with_capacity};
use crate::mesh::NONE;
use crate::query::dual::dot;
use crate::query::unit::Unit;
use crate::query::view::View;

/// A ridge of a facet.
struct Ridge {
    /// Its vertices, ascending; an edge in space, a vertex and [`NONE`] in the plane.
    vertices: [u32; 2],
    /// True if the facet has it the other way round than its vertices ascend.
    is_reversed: bool,
    facet: u32,
}

/// Sums over the facets of a shell.
#[derive(Clone, Default)]
struct Sums<const D: usize> {
    ridges: u64,
    ends: u64,
    is_one_sided: bool,
    area: Vector<D>,
    volume: f64,
}

#[derive(Clone)]
struct Vector<const D: usize>([f64; D]);

/// Turns facets so that those of each shell go on in one direction, unless it has one side alone,
/// and returns the shells in the order of their first vertices. A closed shell goes outwards. Of
/// any other the sum of the areas of its facets, as vectors, has a largest component above 0. Each
/// ridge has at most two facets, each vertex one fan. O(vertices + facets log facets).
pub fn oriented_shells<const D: usize>(
    view: View<'_, D>,
    unit: Unit,
    facets: &mut [u32],
) -> AllocResult<Vec<Shell>> {
    let ridges = ridges::<D>(facets)?;
    let count = facets.len() / D;
    let mut forest = SignedForest::new(count)?;
    // Facets are known by the root of their shell.
    let mut sums = filled(count, Sums::<D>::default())?;
    let mut twisted = Vec::new();
    for pair in ridges.chunk_by(|a, b| a.vertices == b.vertices).filter(|same| same.len() == 2) {
        let is_turned = pair[0].is_reversed == pair[1].is_reversed;
        if !forest.join(pair[0].facet, pair[1].facet, is_turned) {
            twisted.try_push(pair[0].facet)?;
        }
    }
    for facet in twisted {
        sums[forest.side(facet).0 as usize].is_one_sided = true;
    }
    for (facet, vertices) in (0..).zip(facets.chunks_exact_mut(D)) {
        let (root, is_turned) = forest.side(facet);
        if is_turned {
            vertices.swap(0, 1);
        }
        sums[root as usize].add(view, unit, vertices);
    }
    count_ridges(view.mesh.vertex_count(), &ridges, &mut forest, &mut sums)?;
    for (facet, vertices) in (0..).zip(facets.chunks_exact_mut(D)) {
        if sums[forest.side(facet).0 as usize].goes_inwards() {
            vertices.swap(0, 1);
        }
    }
    shells(view, facets, &mut forest, &sums)
}

/// Counts the ridges of each shell, and its ends: closed curves of ridges with one facet alone, in
/// the plane vertices.
fn count_ridges<const D: usize>(
    vertices: usize,
    ridges: &[Ridge],
    forest: &mut SignedForest,
    sums: &mut [Sums<D>],
) -> AllocResult<()> {
    let mut ends = Sets::new(vertices)?;
    let mut is_end = filled(vertices, false)?;
    let alone = || ridges.chunk_by(|a, b| a.vertices == b.vertices).filter(|same| same.len() == 1);
    for Ridge { vertices: [a, b], .. } in alone().flatten() {
        is_end[*a as usize] = true;
        if *b != NONE {
            is_end[*b as usize] = true;
            ends.join(*a as usize, *b as usize);
        }
    }
    for same in ridges.chunk_by(|a, b| a.vertices == b.vertices) {
        sums[forest.side(same[0].facet).0 as usize].ridges += 1;
    }
    for Ridge { vertices: [a, _], facet, .. } in alone().flatten() {
        // The first ridge met with an end counts it.
        let end = ends.find(*a as usize);
        if std::mem::replace(&mut is_end[end], false) {
            sums[forest.side(*facet).0 as usize].ends += 1;
        }
    }
    Ok(())
}

fn shells<const D: usize>(
    view: View<'_, D>,
    facets: &[u32],
    forest: &mut SignedForest,
    sums: &[Sums<D>],
) -> AllocResult<Vec<Shell>> {
    let mut root_of = filled(view.mesh.vertex_count(), NONE)?;
    for (facet, vertices) in (0..).zip(facets.chunks_exact(D)) {
        let (root, _) = forest.side(facet);
        vertices.iter().for_each(|&vertex| root_of[vertex as usize] = root);
    }
    let mut shell_of = filled(sums.len(), usize::MAX)?;
    let mut shells: Vec<Shell> = Vec::new();
    for root in root_of.into_iter().filter(|&root| root != NONE) {
        let shell = &mut shell_of[root as usize];
        if *shell == usize::MAX {
            *shell = shells.len();
            shells.try_push(Shell::default())?;
        }
        shells[*shell].vertices += 1;
    }
    for facet in 0..(facets.len() / D) as u32 {
        shells[shell_of[forest.side(facet).0 as usize]].facets += 1;
    }
    for (sums, shell) in sums.iter().zip(shell_of).filter(|(_, shell)| *shell != usize::MAX) {
        let shell = &mut shells[shell];
        shell.ends = sums.ends;
        shell.is_one_sided = sums.is_one_sided;
        if D == 3 {
            // Vertices less edges plus facets are two less the ends and two a handle.
            let missing =
                (2 + sums.ridges).saturating_sub(shell.vertices + shell.facets + sums.ends);
            shell.genus = if sums.is_one_sided { missing } else { missing / 2 };
        }
    }
    Ok(shells)
}

impl<const D: usize> Sums<D> {
    /// Adds a facet to the area and the volume, in a unit.
    fn add(&mut self, view: View<'_, D>, unit: Unit, vertices: &[u32]) {
        let first = view.point(vertices[0]);
        let way = |k: usize| unit.difference(view.point(vertices[k]), first);
        let (a, b) = (way(1), way(D - 1));
        let area: [f64; D] = match D {
            2 => std::array::from_fn(|i| if i == 0 { a[1] } else { -a[0] }),
            _ => std::array::from_fn(|i| {
                let (j, k) = ((i + 1) % D, (i + 2) % D);
                a[j] * b[k] - a[k] * b[j]
            }),
        };
        self.volume += dot(&area, &unit.difference(first, view.point(0)));
        self.area = Vector(std::array::from_fn(|i| self.area.0[i] + area[i]));
    }

    fn goes_inwards(&self) -> bool {
        let larger = |a: f64, b: f64| if b.abs() > a.abs() { b } else { a };
        match self.ends {
            0 => self.volume < 0.0,
            _ => self.area.0.into_iter().fold(0.0, larger) < 0.0,
        }
    }
}

impl<const D: usize> Default for Vector<D> {
    fn default() -> Self {
        Self([0.0; D])
    }
}

/// Returns the ridges of all facets, sorted.
fn ridges<const D: usize>(facets: &[u32]) -> AllocResult<Vec<Ridge>> {
    let mut ridges = with_capacity(facets.len())?;
    for (facet, vertices) in (0..).zip(facets.chunks_exact(D)) {
        for k in 0..D {
            let (a, b) = (vertices[k], vertices[(k + 1) % D]);
            let (vertices, is_reversed) = match D {
                2 => ([a, NONE], k == 0),
                _ => ([a.min(b), a.max(b)], b < a),
            };
            ridges.try_push(Ridge { vertices, is_reversed, facet })?;
        }
    }
    ridges.sort_unstable_by_key(|ridge| (ridge.vertices, ridge.facet));
    Ok(ridges)
}
