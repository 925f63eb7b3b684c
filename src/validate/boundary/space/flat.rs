//! Level 3: the simplices that are flat in a facet are those with all vertices on one.

use super::faces::Faces;
use crate::error::message;
use crate::memory::{AllocResult, Lists, TryGrow, collected};
use crate::mesh::NONE;
use crate::quality::view::View;
use crate::validate::report::{Findings, Violation, ViolationKind};

/// Returns for each vertex the facets that it is on, ascending.
pub(super) fn facets_at(view: View<'_, 3>, faces: &Faces) -> AllocResult<Lists> {
    let subfacets = view.mesh.boundary.subfacets.iter().zip(&faces.facets);
    let pairs = |(vertices, &facet): (&[u32; 3], &u32)| vertices.map(|vertex| (vertex, facet));
    let mut pairs = collected(subfacets.flat_map(pairs))?;
    pairs.sort_unstable();
    pairs.dedup();
    Lists::of_pairs(view.vertex_count(), || pairs.iter().copied())
}

pub(super) fn check(view: View<'_, 3>, faces: &Faces, findings: &mut Findings) -> AllocResult<()> {
    let facets_at = facets_at(view, faces)?;
    let mut expected: Vec<u32> = Vec::new();
    for simplex in 0..view.simplex_count() {
        let vertices = view.simplex(simplex);
        let [first, others @ ..] = vertices else { continue };
        let has = |facet: &u32| {
            let of = |vertex: &u32| facets_at.of(*vertex as usize);
            others.iter().all(|vertex| of(vertex).binary_search(facet).is_ok())
        };
        if facets_at.of(*first as usize).iter().any(has) {
            expected.try_push(simplex as u32)?;
        }
    }
    let flat = &view.mesh.boundary.flat;
    let differs = flat.iter().zip(&expected).find(|(a, b)| a != b).map(|(&a, &b)| a.min(b));
    let at = flat.len().min(expected.len());
    let more = flat[at..].first().or(expected[at..].first()).copied();
    let wrong = differs.or(more);
    findings.check(wrong.is_none(), || {
        let simplex = wrong.unwrap_or(NONE);
        let message = match expected.binary_search(&simplex) {
            Ok(_) => {
                message!("simplex {simplex} has all vertices on a facet, and is not marked as flat")
            }
            Err(_) => {
                message!("simplex {simplex} is marked as flat, and no facet has all its vertices")
            }
        };
        Violation::new(ViolationKind::FlatSimplex, message).simplex(simplex as usize)
    });
    Ok(())
}
