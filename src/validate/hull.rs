//! Level 1: the hull is a closed connected manifold.

use super::report::{Findings, Violation, ViolationKind};
use crate::error::message;
use crate::memory::{AllocResult, Sets, TryGrow, filled, with_capacity};
use crate::mesh::NONE;
use crate::quality::view::View;

/// A hull facet: its vertices, and the simplex it bounds.
struct HullFacet<const D: usize> {
    vertices: [u32; D],
    simplex: u32,
}

/// A ridge by its sorted vertices (padded with [`NONE`]) and the hull facet it was met in.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Ridge<const D: usize> {
    vertices: [u32; D],
    facet: u32,
}

/// Checks the hull of a complex whose facets and neighbours hold.
pub(super) fn check<const D: usize>(view: View<'_, D>, findings: &mut Findings) -> AllocResult<()> {
    let facets = hull_facets(view)?;
    let exists = findings.check(!facets.is_empty(), || {
        Violation::new(ViolationKind::HullRidge, "the mesh has no hull facet")
    });
    if !exists {
        return Ok(());
    }
    let mut connected = Sets::new(facets.len())?;
    // Node (facet, position): that facet seen from its vertex at that position.
    let mut around = Sets::new(facets.len() * D)?;
    let mut closed = true;
    for pair in sorted_ridges(&facets)?.chunk_by(|a, b| a.vertices == b.vertices) {
        closed &= check_ridge(&facets, pair, findings);
        if let [a, b] = pair {
            connected.join(a.facet as usize, b.facet as usize);
            for &v in pair[0].vertices.iter().filter(|&&v| v != NONE) {
                around.join(node(&facets, a.facet, v), node(&facets, b.facet, v));
            }
        }
    }
    if closed {
        check_connected(&facets, &mut connected, findings);
        check_links(view, &facets, &mut around, findings)?;
    }
    Ok(())
}

fn hull_facets<const D: usize>(view: View<'_, D>) -> AllocResult<Vec<HullFacet<D>>> {
    let mut facets = Vec::new();
    for s in 0..view.simplex_count() {
        let simplex = view.simplex(s);
        for (apex, _) in view.neighbors(s).iter().enumerate().filter(|&(_, &n)| n == NONE) {
            let vertices = std::array::from_fn(|k| simplex[k + usize::from(k >= apex)]);
            facets.try_push(HullFacet { vertices, simplex: s as u32 })?;
        }
    }
    Ok(facets)
}

fn sorted_ridges<const D: usize>(facets: &[HullFacet<D>]) -> AllocResult<Vec<Ridge<D>>> {
    let mut ridges = with_capacity(facets.len() * D)?;
    for (f, facet) in facets.iter().enumerate() {
        for skipped in 0..D {
            let mut vertices = facet.vertices;
            vertices[skipped] = NONE;
            vertices.sort_unstable();
            ridges.push(Ridge { vertices, facet: f as u32 });
        }
    }
    ridges.sort_unstable();
    Ok(ridges)
}

fn node<const D: usize>(facets: &[HullFacet<D>], facet: u32, vertex: u32) -> usize {
    let vertices = &facets[facet as usize].vertices;
    facet as usize * D + vertices.iter().position(|&v| v == vertex).unwrap_or(0)
}

fn check_ridge<const D: usize>(
    facets: &[HullFacet<D>],
    group: &[Ridge<D>],
    findings: &mut Findings,
) -> bool {
    findings.check(group.len() == 2, || {
        let (ridge, count) = (&group[0].vertices[..D - 1], group.len());
        let message = message!("hull ridge {ridge:?} is in {count} hull facets instead of 2");
        let violation = Violation::new(ViolationKind::HullRidge, message);
        let simplex = facets[group[0].facet as usize].simplex;
        violation.simplex(simplex as usize).vertex(ridge[0] as usize)
    })
}

fn check_connected<const D: usize>(
    facets: &[HullFacet<D>],
    connected: &mut Sets,
    findings: &mut Findings,
) {
    let root = connected.find(0);
    let apart = (0..facets.len()).find(|&f| connected.find(f) != root);
    findings.check(apart.is_none(), || {
        let simplex = facets[apart.unwrap_or(0)].simplex as usize;
        let message = message!("the hull facet of simplex {simplex} is apart from the others");
        Violation::new(ViolationKind::HullDisconnected, message).simplex(simplex)
    });
}

/// Checks that the hull facets at each vertex are one cycle: one component round it.
fn check_links<const D: usize>(
    view: View<'_, D>,
    facets: &[HullFacet<D>],
    around: &mut Sets,
    findings: &mut Findings,
) -> AllocResult<()> {
    let mut components = filled(view.vertex_count(), NONE)?;
    for (f, facet) in facets.iter().enumerate() {
        for (k, &v) in facet.vertices.iter().enumerate() {
            let root = around.find(f * D + k) as u32;
            let known = &mut components[v as usize];
            if *known == NONE {
                *known = root;
            }
            findings.check(*known == root, || {
                let message = message!("the hull facets at vertex {v} are not connected there");
                let violation = Violation::new(ViolationKind::HullLink, message);
                violation.simplex(facet.simplex as usize).vertex(v as usize)
            });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Stats, Triangulation, VertexKind};
    use crate::options::Options;
    use crate::parameters::Parameters;

    /// Returns the first violation of the hull of a complex of which only the simplices matter.
    fn first_violation<const D: usize>(simplices: &[Vec<u32>]) -> Option<ViolationKind> {
        let shares = |a: &[u32], b: &[u32]| b.iter().filter(|v| a.contains(v)).count() == D;
        let neighbor = |s: &[u32], slot: usize| {
            let across = |t: &Vec<u32>| shares(s, t) && !t.contains(&s[slot]);
            simplices.iter().position(across).map_or(NONE, |t| t as u32)
        };
        let row = |s: &Vec<u32>| (0..=D).map(|slot| neighbor(s, slot)).collect::<Vec<_>>();
        let count = simplices.concat().into_iter().max().unwrap() as usize + 1;
        let mesh = Triangulation {
            dim: D,
            points: vec![0.0; count * D],
            simplices: simplices.concat(),
            neighbors: simplices.iter().flat_map(row).collect(),
            kinds: vec![VertexKind::Input; count],
            vertex_domains: vec![NONE; count],
            cage_of: vec![NONE; count],
            domains: Vec::new(),
            precision_limited: vec![false; count],
            below_min_dihedral: Vec::new(),
            boundary: Default::default(),
            sizes: Vec::new(),
            beyond_bound: Vec::new(),
            parameters: Parameters::resolve(D, &Options::default()).unwrap(),
            stats: Stats::default(),
        };
        let mut findings = Findings::default();
        check(View::<D> { mesh: &mesh }, &mut findings).unwrap();
        findings.first.map(|first| first.kind)
    }

    #[test]
    fn a_chain_of_simplices_has_a_closed_hull() {
        let chain: Vec<Vec<u32>> = (0..5).map(|k| (k..k + 4).collect()).collect();
        assert_eq!(first_violation::<3>(&chain), None);
        assert_eq!(first_violation::<2>(&[vec![0, 1, 2], vec![1, 2, 3]]), None);
    }

    #[test]
    fn a_bow_tie_has_an_overfull_ridge() {
        let bow = [vec![0, 1, 2], vec![0, 3, 4]];
        assert_eq!(first_violation::<2>(&bow), Some(ViolationKind::HullRidge));
    }

    #[test]
    fn a_closed_surface_has_no_hull() {
        let sphere = [vec![0, 1, 2], vec![0, 1, 3], vec![0, 2, 3], vec![1, 2, 3]];
        assert_eq!(first_violation::<2>(&sphere), Some(ViolationKind::HullRidge));
    }

    #[test]
    fn an_annulus_has_two_hulls() {
        let ring: Vec<Vec<u32>> = (0..4)
            .flat_map(|i| {
                let j = (i + 1) % 4;
                [vec![i, j, 4 + i], vec![j, 4 + j, 4 + i]]
            })
            .collect();
        assert_eq!(first_violation::<2>(&ring), Some(ViolationKind::HullDisconnected));
    }

    #[test]
    fn a_chain_that_touches_itself_is_pinched() {
        let mut chain: Vec<Vec<u32>> = (0..5).map(|k| (k..k + 4).collect()).collect();
        chain[4][3] = 0;
        assert_eq!(first_violation::<3>(&chain), Some(ViolationKind::HullLink));
    }
}
