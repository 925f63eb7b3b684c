//! Level 1: array lengths and ids. What holds here lets everything else index without a fear.

use super::report::{Findings, Violation, ViolationKind};
use crate::error::message;
use crate::memory::{AllocResult, filled};
use crate::mesh::{Inputs, NONE, Triangulation};

/// Checks lengths, coordinates and ids; returns whether arrays may be indexed by the ids in them.
pub(super) fn check(
    inputs: &Inputs,
    mesh: &Triangulation,
    findings: &mut Findings,
) -> AllocResult<bool> {
    if !check_lengths(inputs, mesh, findings) {
        return Ok(false);
    }
    check_coordinates(mesh, findings);
    let in_range = check_ids(mesh, findings);
    if in_range {
        check_use(mesh, findings)?;
    }
    Ok(in_range)
}

fn check_lengths(inputs: &Inputs, mesh: &Triangulation, findings: &mut Findings) -> bool {
    let vertices = mesh.kinds.len();
    let size = mesh.dim + 1;
    let rows = [
        ("dim", mesh.dim, inputs.dim()),
        ("points", mesh.points.len(), vertices * mesh.dim),
        ("vertex_domains", mesh.vertex_domains.len(), vertices),
        ("cage_of", mesh.cage_of.len(), vertices),
        ("precision_limited", mesh.precision_limited.len(), vertices),
        ("sizes", mesh.sizes.len(), if mesh.sizes.is_empty() { 0 } else { vertices }),
        (
            "sizes that are none",
            mesh.sizes.iter().filter(|size| size.is_nan() || **size <= 0.0).count(),
            0,
        ),
        ("neighbors", mesh.neighbors.len(), mesh.simplices.len()),
        ("simplices beyond a multiple of dim + 1", mesh.simplices.len() % size, 0),
        ("simplices == 0", usize::from(mesh.simplices.is_empty()), 0),
        ("vertices == NONE", usize::from(vertices >= NONE as usize), 0),
    ];
    let mut holds = true;
    for (what, found, needed) in rows {
        holds &= findings.check(found == needed, || {
            let message = message!("{what}: {found}, but {vertices} vertices need {needed}");
            Violation::new(ViolationKind::ArrayLength, message)
        });
    }
    holds
}

fn check_coordinates(mesh: &Triangulation, findings: &mut Findings) {
    for (i, x) in mesh.points.iter().enumerate() {
        findings.check(x.is_finite(), || {
            let (vertex, axis) = (i / mesh.dim, i % mesh.dim);
            let message = message!("coordinate {axis} of vertex {vertex} is {x}, not finite");
            Violation::new(ViolationKind::NonFinite, message).vertex(vertex)
        });
    }
}

fn check_ids(mesh: &Triangulation, findings: &mut Findings) -> bool {
    let (vertices, simplices) = (mesh.kinds.len(), mesh.simplex_count());
    let mut holds = true;
    for s in 0..simplices {
        for &v in mesh.simplex(s) {
            holds &= findings.check((v as usize) < vertices, || {
                let message = message!("simplex {s} names vertex {v} of {vertices}");
                Violation::new(ViolationKind::VertexOutOfRange, message).simplex(s)
            });
        }
        for &n in mesh.neighbors_of(s) {
            let exists = n == NONE || ((n as usize) < simplices && n as usize != s);
            holds &= findings.check(exists, || {
                let message = message!("simplex {s} names neighbour {n} of {simplices} simplices");
                Violation::new(ViolationKind::NeighborOutOfRange, message).simplex(s)
            });
        }
    }
    holds
}

/// Checks that no vertex is twice in a simplex, and none in no simplex.
fn check_use(mesh: &Triangulation, findings: &mut Findings) -> AllocResult<()> {
    let mut used = filled(mesh.kinds.len(), false)?;
    for s in 0..mesh.simplex_count() {
        let vertices = mesh.simplex(s);
        for (i, &v) in vertices.iter().enumerate() {
            used[v as usize] = true;
            findings.check(!vertices[..i].contains(&v), || {
                let message = message!("simplex {s} names vertex {v} twice");
                let violation = Violation::new(ViolationKind::RepeatedVertex, message);
                violation.simplex(s).vertex(v as usize)
            });
        }
    }
    for (v, &used) in used.iter().enumerate() {
        findings.check(used, || {
            let message = message!("vertex {v} is in no simplex");
            Violation::new(ViolationKind::UnusedVertex, message).vertex(v)
        });
    }
    Ok(())
}
