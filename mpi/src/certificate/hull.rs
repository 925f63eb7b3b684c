//! Level 2: the hull is closed, and convex at every ridge. The two facets at a ridge may be of two
//! ranks, neither of which has the other: they meet at a keeper, which the ridge's vertices choose.

use super::complex::Complex;
use super::exchange::{Outbox, bits};
use super::report::{Findings, Violation};
use crate::comm::Communicator;
use crate::distributed::NO_ID;
use netmesh::Result;
use netmesh::validate::ViolationKind;
use netmesh::validate::parts::orientation;
use std::cmp::Ordering;

/// A ridge by its vertices, rising; the simplex; the vertices and the points of the facet, that of
/// the facet beyond the ridge first, so that the points and one inside are positively oriented or,
/// where the sign says so, negatively.
type Record = ([u64; 16], usize);

const RIDGE: usize = 2;
const SIMPLEX: usize = 2;
const IS_POSITIVE: usize = 3;
const VERTICES: usize = 4;
const POINTS: usize = 7;

/// Collective. Checks that the hull is convex and closed. Level 1 must hold, and all simplices be
/// positively oriented.
pub fn check<const D: usize>(
    comm: &dyn Communicator,
    complex: &Complex<'_>,
    findings: &mut Findings,
) -> Result<()> {
    let mesh = complex.mesh;
    let mut outbox = Outbox::new(comm.size())?;
    let open = mesh.neighbors.iter().enumerate().filter(|(_, neighbor)| **neighbor == NO_ID);
    for (at, _) in open {
        let (simplex, slot) = (at / (D + 1), at % (D + 1));
        let mut vertices = [0; 4];
        vertices[..=D].copy_from_slice(mesh.simplex(simplex));
        // The opposite vertex goes to the end: an odd permutation, or none.
        vertices.swap(slot, D);
        for apex in 0..D {
            let mut facet = vertices;
            facet.swap(0, apex);
            let is_positive = (slot != D) == (apex != 0);
            outbox.put_by_names(RIDGE, record::<D>(complex, simplex, &facet[..D], is_positive))?;
        }
    }
    for group in outbox.deliver(comm)?.chunk_by(|a, b| a.0[..RIDGE] == b.0[..RIDGE]) {
        let (first, rank) = &group[0];
        findings.check(group.len() == 2, || {
            let (id, count) = (first[SIMPLEX], group.len());
            let message = format!("a hull ridge of simplex {id} is in {count} hull facets, not 2");
            Violation::new(ViolationKind::HullRidge, *rank, message).simplex(id).vertex(first[0])
        });
        if let [a, b] = group {
            check_ridge::<D>(a, b, findings)?;
            check_ridge::<D>(b, a, findings)?;
        }
    }
    Ok(())
}

fn record<const D: usize>(
    complex: &Complex<'_>,
    simplex: usize,
    facet: &[u32],
    is_positive: bool,
) -> [u64; 16] {
    let mut record = [0; 16];
    for (at, &vertex) in facet.iter().enumerate() {
        record[VERTICES + at] = complex.mesh.vertex_ids[vertex as usize];
        record[POINTS + at * D..][..D].copy_from_slice(&bits(complex.mesh.point(vertex))[..D]);
    }
    let mut ridge = [NO_ID; RIDGE];
    ridge[..D - 1].copy_from_slice(&record[VERTICES + 1..VERTICES + D]);
    ridge.sort_unstable();
    record[..RIDGE].copy_from_slice(&ridge);
    record[SIMPLEX] = complex.id(simplex);
    record[IS_POSITIVE] = is_positive.into();
    record
}

/// Checks that the vertex of `b` that is not on the ridge is not beyond `a`.
fn check_ridge<const D: usize>(a: &Record, b: &Record, findings: &mut Findings) -> Result<()> {
    let point = |record: &Record, at: usize| -> [f64; D] {
        std::array::from_fn(|axis| f64::from_bits(record.0[POINTS + at * D + axis]))
    };
    let (facet, apex): ([_; D], _) = (std::array::from_fn(|at| point(a, at)), point(b, 0));
    let simplex: [&[f64; D]; 4] = std::array::from_fn(|at| facet.get(at).unwrap_or(&apex));
    let sign = orientation(&simplex[..=D])?;
    let inside = if a.0[IS_POSITIVE] == 1 { sign } else { sign.reverse() };
    findings.check(inside != Ordering::Less, || {
        let (id, simplex) = (b.0[VERTICES], a.0[SIMPLEX]);
        let message = format!("vertex {id} is beyond the hull facet of simplex {simplex}");
        Violation::new(ViolationKind::NonConvexHull, a.1, message).simplex(simplex).vertex(id)
    });
    Ok(())
}
