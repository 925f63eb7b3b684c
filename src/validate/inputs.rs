//! Level 3: every distinct input is a vertex with its own bits, and kinds say what is an input.

use super::report::{Findings, Violation, ViolationKind};
use crate::error::message;
use crate::mesh::{Inputs, NONE, Triangulation, VertexKind};

/// Checks the vertices of the inputs and the kinds of all vertices.
pub(super) fn check(inputs: &Inputs, mesh: &Triangulation, findings: &mut Findings) {
    for v in 0..inputs.distinct() {
        check_bits(inputs, mesh, v, findings);
    }
    for i in 0..inputs.count() {
        check_input(inputs, mesh, i, findings);
    }
    for (v, &kind) in mesh.kinds.iter().enumerate() {
        let is_input = v < inputs.distinct();
        findings.check((kind == VertexKind::Input) == is_input, || {
            let count = inputs.distinct();
            let message =
                message!("vertex {v} is of kind {kind:?}, but the first {count} are the inputs");
            Violation::new(ViolationKind::VertexKind, message).vertex(v)
        });
    }
}

/// Checks that a plain Delaunay triangulation has the inputs for vertices, and no domains.
pub(super) fn check_plain(inputs: &Inputs, mesh: &Triangulation, findings: &mut Findings) {
    let (vertices, count) = (mesh.vertex_count(), inputs.distinct());
    findings.check(vertices == count, || {
        let message = message!("plain Delaunay of {count} distinct inputs has {vertices} vertices");
        Violation::new(ViolationKind::PlainDelaunay, message)
    });
    findings.check(mesh.domains.is_empty(), || {
        let message = message!("plain Delaunay has {} domains", mesh.domains.len());
        Violation::new(ViolationKind::PlainDelaunay, message)
    });
    for (v, (&label, &cage)) in mesh.vertex_domains.iter().zip(&mesh.cage_of).enumerate() {
        findings.check(label == NONE && cage == NONE, || {
            let message = message!("plain Delaunay labels vertex {v} with a domain or cage");
            Violation::new(ViolationKind::PlainDelaunay, message).vertex(v)
        });
    }
}

fn check_bits(inputs: &Inputs, mesh: &Triangulation, v: usize, findings: &mut Findings) {
    if v >= mesh.vertex_count() {
        findings.check(false, || {
            let input = inputs.first_input(v).unwrap_or(NONE);
            let message = message!("input {input} is no vertex");
            Violation::new(ViolationKind::InputVertex, message)
        });
        return;
    }
    let (given, found) = (inputs.distinct_point(v), mesh.point(v as u32));
    let differs = given.iter().zip(found).position(|(a, b)| a.to_bits() != b.to_bits());
    findings.check(differs.is_none(), || {
        let axis = differs.unwrap_or(0);
        let (a, b) = (given[axis], found[axis]);
        let message = message!("coordinate {axis} of vertex {v} is {b:e}, its input's is {a:e}");
        Violation::new(ViolationKind::InputBits, message).vertex(v)
    });
}

/// Duplicates are equal as numbers, so that -0.0 and 0.0 share a vertex.
fn check_input(inputs: &Inputs, mesh: &Triangulation, i: usize, findings: &mut Findings) {
    let v = inputs.vertices()[i];
    let exists = (v as usize) < inputs.distinct().min(mesh.vertex_count());
    findings.check(exists && inputs.point(i) == mesh.point(v), || {
        let message = message!("input {i} has vertex {v}, which has other coordinates or is none");
        let violation = Violation::new(ViolationKind::InputVertex, message);
        if exists { violation.vertex(v as usize) } else { violation }
    });
}
