//! Meshes made by hand, for the tests of the writers, and a reader that fails. A writer looks at no
//! geometry: the coordinates are there to be hard to write, not to make a mesh.

use crate::mesh::{Boundary, Inputs, Mesh, NONE, Stats, Triangulation, VertexKind};
use crate::options::{Algorithm, Options, Output};
use crate::parameters::Parameters;

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

/// Whose every read fails.
pub struct FailingReader;

impl std::io::Read for FailingReader {
    fn read(&mut self, _: &mut [u8]) -> std::io::Result<usize> {
        Err(std::io::Error::other("the disk is gone"))
    }
}

/// Makes two simplices that share a facet, with awkward coordinates and every kind of vertex.
pub fn mesh(dim: usize) -> Mesh {
    let vertices = dim as u32 + 2;
    // A stride that is prime to the length: every vertex starts elsewhere.
    let points = (0..vertices as usize * dim).map(|i| AWKWARD[i * 5 % AWKWARD.len()]).collect();
    let mut kinds = vec![VertexKind::Input; vertices as usize];
    kinds[dim] = VertexKind::Steiner;
    kinds[dim + 1] = VertexKind::Cage;
    assemble(dim, points, (0..=vertices - 2).chain(1..vertices).collect(), kinds)
}

/// Makes the unit square as two triangles.
pub fn square() -> Mesh {
    let kinds = vec![VertexKind::Input, VertexKind::Input, VertexKind::Steiner, VertexKind::Cage];
    assemble(2, vec![0., 0., 1., 0., 1., 1., 0., 1.], vec![0, 1, 2, 0, 2, 3], kinds)
}

/// Returns options for the triangulation of the inputs alone.
pub fn delaunay() -> Options {
    Options { algorithm: Algorithm::Delaunay, ..Options::default() }
}

/// Makes the square with its diagonal and a side as segments, and labels of its triangles.
pub fn square_with_segments() -> Mesh {
    let square = square();
    let mut triangulation = square.triangulation().unwrap().clone();
    triangulation.boundary = Boundary {
        subsegments: vec![[0, 2], [1, 0]],
        parents: vec![1, 0],
        simplex_regions: vec![7, -8],
        ..Boundary::default()
    };
    Mesh::from_parts(square.inputs().clone(), triangulation).with_markers(vec![6, -5])
}

/// Makes two tetrahedra with facets and segments, and labels: a side of the first has a marker, the
/// triangle between them another, and a side of the second belongs to no facet.
pub fn solid_with_facets() -> Mesh {
    let solid = mesh(3);
    let mut triangulation = solid.triangulation().unwrap().clone();
    triangulation.boundary = Boundary {
        subsegments: vec![[3, 1], [1, 2], [2, 3]],
        parents: vec![0, NONE, NONE],
        subfacets: vec![[1, 0, 2], [3, 1, 2], [4, 2, 3]],
        subfacet_parents: vec![0, 2, NONE],
        subfacet_simplices: vec![[NONE, 0], [0, 1], [1, NONE]],
        simplex_regions: vec![7, -8],
        flat: vec![1],
        forced: vec![0],
        ..Boundary::default()
    };
    let solid = Mesh::from_parts(solid.inputs().clone(), triangulation);
    solid.with_markers(vec![6]).with_facet_markers(vec![-5, 0, 9])
}

/// Makes a mesh of one domain by a run.
pub fn finished(dim: usize) -> Mesh {
    run(dim, &scattered(dim), &Options { output: Output::WellSpaced, ..Options::default() })
}

/// Makes a mesh by a run, with a cluster a million times smaller than what is around it: the domain
/// of the cluster is inside the root.
pub fn nested(dim: usize) -> Mesh {
    let around = scattered(dim);
    let cluster: Vec<f64> = around.iter().map(|x| 0.3 + 1e-6 * x).collect();
    run(dim, &[around, cluster].concat(), &Options::default())
}

/// Returns 20 points without a pattern.
fn scattered(dim: usize) -> Vec<f64> {
    let term = |i: usize| i as f64 * 0.754_877_666_246_692_7 + (i * i) as f64 * 0.569_840_290_998;
    (0..20 * dim).map(|i| term(i).fract()).collect()
}

fn run(dim: usize, points: &[f64], options: &Options) -> Mesh {
    let mut mesh = Mesh::new(dim, points.len() / dim, points, 0).unwrap();
    mesh.run(options, None).unwrap();
    mesh
}

/// Makes a mesh whose inputs are the first vertices, those of kind `Input`.
fn assemble(dim: usize, points: Vec<f64>, simplices: Vec<u32>, kinds: Vec<VertexKind>) -> Mesh {
    let inputs = kinds.iter().filter(|kind| **kind == VertexKind::Input).count();
    let vertices = kinds.len();
    let triangulation = Triangulation {
        dim,
        neighbors: neighbors(&simplices, dim),
        simplices,
        vertex_domains: (0..vertices as u32)
            .map(|v| if v == 0 { NONE } else { v * 70000 })
            .collect(),
        cage_of: vec![NONE; vertices],
        domains: Vec::new(),
        precision_limited: (0..vertices).map(|v| v == 1).collect(),
        below_min_dihedral: vec![0],
        boundary: Default::default(),
        sizes: Vec::new(),
        beyond_bound: vec![1],
        parameters: Parameters::resolve(dim, &Options::default()).unwrap(),
        stats: Stats::default(),
        kinds,
        points,
    };
    let inputs = Inputs::new(dim, inputs, &triangulation.points, 0).unwrap();
    Mesh::from_parts(inputs, triangulation)
}

/// Finds the neighbours: simplices that share all vertices but one are neighbours across these.
fn neighbors(simplices: &[u32], dim: usize) -> Vec<u32> {
    let all = || simplices.chunks_exact(dim + 1);
    let across = |simplex: &[u32], opposite: u32| {
        let facet = |v: &&u32| **v != opposite;
        all().position(|other| {
            !other.contains(&opposite) && simplex.iter().filter(facet).all(|v| other.contains(v))
        })
    };
    let number = |found: Option<usize>| found.map_or(NONE, |index| index as u32);
    all().flat_map(|simplex| simplex.iter().map(move |&v| number(across(simplex, v)))).collect()
}

/// Compares doubles as bits: -0.0 is not 0.0 here.
pub fn assert_same_bits(left: &[f64], right: &[f64]) {
    let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<u64>>();
    assert_eq!(bits(left), bits(right), "{left:?} and {right:?}");
}
