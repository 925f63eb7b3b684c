//! Level 3: every distinct input is a vertex with its own bits, whose id is that of the first of
//! the equal ones. Inputs and vertices meet at a keeper, which their coordinates choose.

use super::complex::Complex;
use super::exchange::{Outbox, bits};
use super::report::{Findings, Violation};
use crate::comm::Communicator;
use netmesh::Result;
use netmesh::validate::ViolationKind;

/// Point of an input or a vertex: coordinates, of which zeros compare equal; whether it is a
/// vertex; its id; the bits; and the rank that has it.
type Record = ([u64; 8], usize);

const WHERE: usize = 3;
const IS_VERTEX: usize = 3;
const ID: usize = 4;
const BITS: std::ops::Range<usize> = 5..8;

/// Collective. Checks that the vertex of each distinct input is there and has that input's bits.
pub fn check(
    comm: &dyn Communicator,
    complex: &Complex<'_>,
    findings: &mut Findings,
) -> Result<()> {
    let mesh = complex.mesh;
    let record = |point: &[f64], is_vertex: bool, id: u64| {
        // A negative zero plus zero is a positive one.
        let [x, y, z] = bits(point).map(|bits| (f64::from_bits(bits) + 0.0).to_bits());
        let [a, b, c] = bits(point);
        [x, y, z, is_vertex.into(), id, a, b, c]
    };
    let mut outbox = Outbox::new(comm.size())?;
    for (id, input) in (mesh.first_input..).zip(mesh.inputs.chunks_exact(mesh.dim)) {
        outbox.put_by_names(WHERE, record(input, false, id))?;
    }
    for vertex in (0..mesh.own_vertices).filter(|&vertex| complex.is_owned(vertex)) {
        let id = mesh.vertex_ids[vertex];
        if id < mesh.totals.inputs {
            outbox.put_by_names(WHERE, record(mesh.point(vertex as u32), true, id))?;
        }
    }
    for group in outbox.deliver(comm)?.chunk_by(|a, b| a.0[..WHERE] == b.0[..WHERE]) {
        let (inputs, vertices) =
            group.split_at(group.partition_point(|record| record.0[IS_VERTEX] == 0));
        check_group(inputs, vertices, findings);
    }
    Ok(())
}

/// Checks the inputs and vertices at one position, which are sorted by id.
fn check_group(inputs: &[Record], vertices: &[Record], findings: &mut Findings) {
    let id_of = |records: &[Record]| records.first().map(|record| record.0[ID]);
    let (input, vertex) = (id_of(inputs), id_of(vertices));
    let rank = inputs.first().or(vertices.first()).map_or(0, |record| record.1);
    let is_one = findings.check(input == vertex && vertices.len() == 1, || {
        let message = match (input, vertex) {
            (Some(input), None) => format!("input {input} is no vertex"),
            (None, Some(vertex)) => format!("vertex {vertex} is where no input is"),
            (Some(input), Some(vertex)) if input != vertex => {
                format!("input {input} is vertex {vertex}, not its own or that of the first equal")
            }
            (input, _) => format!("input {} is {} vertices", input.unwrap_or(0), vertices.len()),
        };
        let id = input.or(vertex).unwrap_or(0);
        Violation::new(ViolationKind::InputVertex, rank, message).vertex(id)
    });
    if let (true, Some(input), Some(vertex)) = (is_one, inputs.first(), vertices.first()) {
        findings.check(input.0[BITS] == vertex.0[BITS], || {
            let id = input.0[ID];
            let message = format!("vertex {id} has not the bits of the input");
            Violation::new(ViolationKind::InputBits, vertex.1, message).vertex(id)
        });
    }
}
