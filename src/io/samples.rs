//! Meshes made by hand, for the tests of the writers. A writer looks at no geometry: the
//! coordinates are there to be hard to write, not to make a mesh.

use crate::mesh::{Inputs, Mesh, NONE, Stats, Triangulation, VertexKind};
use crate::netmesh::parameters::Parameters;
use crate::options::Options;

/// Doubles that careless writers and readers change: signs of zero, subnormals, the ends of the
/// range, ties, 17 digits, and the ends of the range that is written without an exponent.
pub const AWKWARD: [f64; 16] = [
    0.1,
    -0.0,
    5e-324,
    f64::MAX,
    -f64::MIN_POSITIVE,
    1.0 / 3.0,
    9007199254740993.0,
    1e16,
    9999999999999998.0,
    1e-5,
    0.000009999999999999999,
    2.225073858507201e-308,
    -1e21,
    0.30000000000000004,
    1e23,
    -8.98846567431158e307,
];

/// Two simplices that share a facet, with awkward coordinates and every kind of vertex.
pub fn mesh(dim: usize) -> Mesh {
    let vertices = dim as u32 + 2;
    // A stride that is prime to the length: every vertex starts elsewhere.
    let points = (0..vertices as usize * dim).map(|i| AWKWARD[i * 5 % AWKWARD.len()]).collect();
    let mut kinds = vec![VertexKind::Input; vertices as usize];
    kinds[dim] = VertexKind::Steiner;
    kinds[dim + 1] = VertexKind::Cage;
    assemble(dim, points, (0..=vertices - 2).chain(1..vertices).collect(), kinds)
}

/// The unit square as two triangles.
pub fn square() -> Mesh {
    let kinds = vec![VertexKind::Input, VertexKind::Input, VertexKind::Steiner, VertexKind::Cage];
    assemble(2, vec![0., 0., 1., 0., 1., 1., 0., 1.], vec![0, 1, 2, 0, 2, 3], kinds)
}

/// A mesh whose inputs are the first vertices, those of kind `Input`.
fn assemble(dim: usize, points: Vec<f64>, simplices: Vec<u32>, kinds: Vec<VertexKind>) -> Mesh {
    let inputs = kinds.iter().filter(|kind| **kind == VertexKind::Input).count();
    let vertices = kinds.len();
    let triangulation = Triangulation {
        dim,
        neighbors: vec![NONE; simplices.len()],
        simplices,
        vertex_domains: (0..vertices as u32)
            .map(|v| if v == 0 { NONE } else { v * 70000 })
            .collect(),
        cage_of: vec![NONE; vertices],
        domains: Vec::new(),
        precision_limited: (0..vertices).map(|v| v == 1).collect(),
        parameters: Parameters::resolve(dim, &Options::default()).unwrap(),
        stats: Stats::default(),
        kinds,
        points,
    };
    let inputs = Inputs::new(dim, inputs, &triangulation.points, 0).unwrap();
    Mesh::from_parts(inputs, triangulation)
}

/// Compares doubles as bits: -0.0 is not 0.0 here.
pub fn assert_same_bits(left: &[f64], right: &[f64]) {
    let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<u64>>();
    assert_eq!(bits(left), bits(right), "{left:?} and {right:?}");
}
