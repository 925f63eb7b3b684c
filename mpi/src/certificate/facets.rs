//! Level 1: the neighbours are those that share facets. Both sides of an interface have both of its
//! simplices, so each checks the name that it has of the other.

use super::complex::{Complex, Facet};
use super::report::{Findings, Violation};
use crate::distributed::NO_ID;
use netmesh::validate::ViolationKind;

/// Checks all facets of own simplices.
pub fn check(complex: &Complex<'_>, findings: &mut Findings) {
    for group in
        complex.groups().filter(|group| group.iter().any(|facet| complex.belongs_to_rank(facet)))
    {
        let fits = findings.check(group.len() <= 2, || {
            let id = complex.id(group[0].simplex as usize);
            let message = format!("a facet of simplex {id} is in {} simplices", group.len());
            Violation::new(ViolationKind::OverfullFacet, complex.mesh.rank, message).simplex(id)
        });
        match group {
            [facet] => check_name(complex, facet, NO_ID, findings),
            [a, b] if fits => {
                check_apart(complex, a, b, findings);
                for (one, other) in [(a, b), (b, a)] {
                    if complex.belongs_to_rank(one) {
                        let other = complex.id(other.simplex as usize);
                        check_name(complex, one, other, findings);
                    }
                }
            }
            _ => {}
        }
    }
}

fn check_apart(complex: &Complex<'_>, a: &Facet, b: &Facet, findings: &mut Findings) {
    findings.check(complex.opposite(a) != complex.opposite(b), || {
        let [a, b] = [a, b].map(|facet| complex.id(facet.simplex as usize));
        let message = format!("simplices {a} and {b} have the same vertices");
        Violation::new(ViolationKind::DuplicateSimplex, complex.mesh.rank, message).simplex(a)
    });
}

/// Checks what an own simplex says of the other side of a facet.
fn check_name(complex: &Complex<'_>, facet: &Facet, needed: u64, findings: &mut Findings) {
    let (simplex, slot) = (facet.simplex as usize, facet.slot as usize);
    let found = complex.mesh.neighbors[simplex * (complex.mesh.dim + 1) + slot];
    findings.check(found == needed, || {
        let id = complex.id(simplex);
        let say = |id: u64| if id == NO_ID { "none".to_owned() } else { id.to_string() };
        let kind = if found == NO_ID {
            ViolationKind::MissingNeighbor
        } else {
            ViolationKind::NeighborFacet
        };
        let message = format!(
            "simplex {id} names neighbour {} opposite vertex {slot}; its facet is that of {}",
            say(found),
            say(needed)
        );
        Violation::new(kind, complex.mesh.rank, message).simplex(id)
    });
}
