//! The domains of simplices.

use crate::mesh::{NONE, Triangulation};

/// Returns the innermost domain that contains all `vertices` of a simplex; [`NONE`] if the mesh has
/// no domains.
///
/// Parents are numbered before their children, so that the later of two domains is never an
/// ancestor of the other.
pub(crate) fn domain_of(triangulation: &Triangulation, vertices: &[u32]) -> u32 {
    let domains = vertices.iter().map(|&vertex| triangulation.vertex_domains[vertex as usize]);
    domains.reduce(|a, b| common_ancestor(triangulation, a, b)).unwrap_or(NONE)
}

/// Returns true if `domain` is `outer` or a descendant of it.
pub(super) fn is_within(triangulation: &Triangulation, mut domain: u32, outer: u32) -> bool {
    // A parent stands before its children.
    while domain != NONE && domain > outer {
        let parent = triangulation.domains.get(domain as usize).map_or(NONE, |own| own.parent);
        domain = if parent < domain { parent } else { NONE };
    }
    domain == outer
}

fn common_ancestor(triangulation: &Triangulation, mut a: u32, mut b: u32) -> u32 {
    while a != b {
        let later = a.max(b);
        match triangulation.domains.get(later as usize) {
            Some(domain) if domain.parent < later => (a, b) = (a.min(b), domain.parent),
            _ => return NONE,
        }
    }
    a
}

/// Returns all simplices with their domains, for file formats that need a number less than 2^31:
/// the domain is 0 where there are none.
pub(crate) fn simplices(triangulation: &Triangulation) -> impl Iterator<Item = (&[u32], u32)> {
    let domain = |vertices: &[u32]| match domain_of(triangulation, vertices) {
        NONE => 0,
        domain => domain,
    };
    let simplices = triangulation.simplices.chunks_exact(triangulation.dim + 1);
    simplices.map(move |vertices| (vertices, domain(vertices)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::samples;
    use crate::mesh::Domain;

    #[test]
    fn the_innermost_domain_that_holds_all_vertices() {
        let mut triangulation = samples::square().triangulation().unwrap().clone();
        let domain = |parent| Domain { center: 0, parent, radius: 1.0 };
        // 0 holds 1 and 2; 1 holds 3; 3 holds 4.
        triangulation.domains = [NONE, 0, 0, 1, 3].map(domain).to_vec();
        for (labels, expected) in [
            ([3, 3, 3, 3], 3),
            ([4, 3, 3, 1], 1),
            ([1, 4, 1, 3], 1),
            ([4, 2, 4, 4], 0),
            ([2, 1, 2, 1], 0),
            ([0, 4, 0, 0], 0),
            ([NONE, NONE, NONE, NONE], NONE),
        ] {
            triangulation.vertex_domains = labels.to_vec();
            assert_eq!(domain_of(&triangulation, &[0, 1, 2, 3]), expected, "{labels:?}");
        }
    }

    #[test]
    fn without_domains_the_number_is_zero() {
        let mesh = samples::finished(2);
        let mut triangulation = mesh.triangulation().unwrap().clone();
        triangulation.domains.clear();
        triangulation.vertex_domains.fill(NONE);
        assert!(simplices(&triangulation).all(|(_, domain)| domain == 0));
    }
}
