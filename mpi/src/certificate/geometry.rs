//! Level 2: exact signs on every simplex and every facet. At an interface both sides look.

use super::complex::{Complex, Facet};
use super::report::{Findings, Violation};
use netmesh::Result;
use netmesh::validate::ViolationKind;
use netmesh::validate::parts::{in_ball, orientation};
use std::cmp::Ordering;

/// Checks orientations, folds and local Delaunay-ness of own simplices; level 1 must hold.
pub fn check<const D: usize>(complex: &Complex<'_>, findings: &mut Findings) -> Result<()> {
    for simplex in 0..complex.own {
        check_orientation::<D>(complex, simplex, findings)?;
    }
    for group in complex.groups() {
        let [a, b] = group else { continue };
        // The sign seen from the other side is the same determinant: one is enough, of an own one.
        let (own, other) = if complex.belongs_to_rank(a) { (a, b) } else { (b, a) };
        if complex.belongs_to_rank(own) {
            check_fold(complex, own, other, findings);
            check_delaunay::<D>(complex, own, other, findings)?;
        }
    }
    Ok(())
}

fn sign<const D: usize>(complex: &Complex<'_>, simplex: usize) -> Result<Ordering> {
    orientation(&complex.points::<D>(simplex)[..=D])
}

fn check_orientation<const D: usize>(
    complex: &Complex<'_>,
    simplex: usize,
    findings: &mut Findings,
) -> Result<()> {
    let sign = sign::<D>(complex, simplex)?;
    findings.check(sign == Ordering::Greater, || {
        let (word, id) = match sign {
            Ordering::Equal => ("flat", complex.id(simplex)),
            _ => ("negatively oriented", complex.id(simplex)),
        };
        let message = format!("simplex {id} is {word}");
        Violation::new(ViolationKind::Orientation, complex.mesh.rank, message).simplex(id)
    });
    Ok(())
}

/// Checks that two positively oriented simplices lie on different sides of their facet: replacing
/// the apex of one by that of the other must give an odd permutation of the other. No coordinates
/// are needed.
fn check_fold(complex: &Complex<'_>, own: &Facet, other: &Facet, findings: &mut Findings) {
    let vertices = complex.simplex(own.simplex as usize);
    let replaced: [u32; 4] = std::array::from_fn(|at| match vertices.get(at) {
        Some(_) if at == own.slot as usize => complex.opposite(other),
        Some(&vertex) => vertex,
        None => u32::MAX,
    });
    let neighbor = complex.simplex(other.simplex as usize);
    let even = parity(&replaced[..vertices.len()]) == parity(neighbor);
    findings.check(!even, || {
        let [a, b] = [own, other].map(|facet| complex.id(facet.simplex as usize));
        let message = format!("neighbours {a} and {b} lie on the same side of their facet");
        Violation::new(ViolationKind::FoldedFacet, complex.mesh.rank, message).simplex(a)
    });
}

/// Returns true if the number of inversions is odd.
fn parity(ids: &[u32]) -> bool {
    let later = |(i, a): (usize, &u32)| ids[i + 1..].iter().filter(|&b| b < a).count();
    ids.iter().enumerate().map(later).sum::<usize>() % 2 == 1
}

fn check_delaunay<const D: usize>(
    complex: &Complex<'_>,
    own: &Facet,
    other: &Facet,
    findings: &mut Findings,
) -> Result<()> {
    let simplex = own.simplex as usize;
    if sign::<D>(complex, simplex)? != Ordering::Greater {
        return Ok(());
    }
    let vertex = complex.opposite(other);
    let side = in_ball(&complex.points::<D>(simplex)[..=D], complex.point(vertex))?;
    findings.check(side != Ordering::Greater, || {
        let [a, b] = [own, other].map(|facet| complex.id(facet.simplex as usize));
        let id = complex.mesh.vertex_ids[vertex as usize];
        let message = format!("vertex {id} of simplex {b} is inside the circumball of simplex {a}");
        Violation::new(ViolationKind::Delaunay, complex.mesh.rank, message).simplex(a).vertex(id)
    });
    Ok(())
}
