//! Meshes to check and to corrupt: made by hand, by brute force, and by real runs.

use crate::random::Random;
use netmesh::numerics::{Sign, in_ball, orientation};
use netmesh::options::{Algorithm, Options};
use netmesh::{Domain, Inputs, Mesh, NONE, Stats, Triangulation, VertexKind};
use std::collections::HashMap;

/// Inputs and their mesh.
#[derive(Clone)]
pub struct Case {
    pub inputs: Inputs,
    pub mesh: Triangulation,
}

/// A plain triangulation of `points` by `simplices`, neighbours by shared facets.
pub fn plain<const D: usize>(points: &[[f64; D]], simplices: &[Vec<u32>]) -> Case {
    let options = Options { algorithm: Algorithm::Delaunay, ..Options::default() };
    let inputs = Inputs::new(D, points.len(), points.as_flattened(), 0).unwrap();
    assert_eq!(inputs.distinct(), points.len());
    let mesh = Triangulation {
        dim: D,
        points: points.as_flattened().to_vec(),
        simplices: simplices.concat(),
        neighbors: neighbors(simplices),
        kinds: vec![VertexKind::Input; points.len()],
        vertex_domains: vec![NONE; points.len()],
        cage_of: vec![NONE; points.len()],
        domains: Vec::new(),
        precision_limited: vec![false; points.len()],
        below_min_dihedral: Vec::new(),
        boundary: Default::default(),
        sizes: Vec::new(),
        beyond_bound: Vec::new(),
        parameters: run(&corner::<D>(), &options).mesh.parameters,
        stats: Stats::default(),
    };
    Case { inputs, mesh }
}

/// For facets in one or two simplices; more leave [`NONE`].
pub fn neighbors(simplices: &[Vec<u32>]) -> Vec<u32> {
    let mut facets: HashMap<Vec<u32>, Vec<u32>> = HashMap::new();
    let facet = |simplex: &[u32], apex: usize| {
        let mut key = simplex.to_vec();
        key.remove(apex);
        key.sort_unstable();
        key
    };
    for (s, simplex) in simplices.iter().enumerate() {
        for apex in 0..simplex.len() {
            facets.entry(facet(simplex, apex)).or_default().push(s as u32);
        }
    }
    let mut neighbors = Vec::new();
    for (s, simplex) in simplices.iter().enumerate() {
        for apex in 0..simplex.len() {
            neighbors.push(match facets[&facet(simplex, apex)][..] {
                [a, b] => a + b - s as u32,
                _ => NONE,
            });
        }
    }
    neighbors
}

/// The Delaunay triangulation of points in general position, trying every simplex.
pub fn brute_force<const D: usize>(points: &[[f64; D]]) -> Case {
    let mut simplices = Vec::new();
    let mut chosen: Vec<u32> = (0..=D as u32).collect();
    loop {
        let simplex: Vec<&[f64; D]> = chosen.iter().map(|&v| &points[v as usize]).collect();
        let mut vertices = chosen.clone();
        if orientation(&simplex) == Sign::Negative {
            vertices.swap(0, 1);
        }
        let simplex: Vec<&[f64; D]> = vertices.iter().map(|&v| &points[v as usize]).collect();
        assert_eq!(orientation(&simplex), Sign::Positive, "general position");
        if points.iter().all(|q| in_ball(&simplex, q) != Sign::Positive) {
            simplices.push(vertices);
        }
        let Some(at) = (0..=D).rev().find(|&i| (chosen[i] as usize) < points.len() - 1 - (D - i))
        else {
            return plain(points, &simplices);
        };
        chosen[at] += 1;
        for i in at + 1..=D {
            chosen[i] = chosen[i - 1] + 1;
        }
    }
}

pub fn random_points<const D: usize>(count: usize, seed: u64) -> Vec<[f64; D]> {
    let mut random = Random::new(seed);
    (0..count).map(|_| std::array::from_fn(|_| random.unit())).collect()
}

/// Pairs of points `gap` apart at random places.
pub fn pairs<const D: usize>(count: usize, gap: f64, seed: u64) -> Vec<[f64; D]> {
    let mut random = Random::new(seed);
    let mut points: Vec<[f64; D]> = Vec::new();
    for _ in 0..count {
        let first: [f64; D] = std::array::from_fn(|_| random.unit());
        points.push(first);
        points.push(first.map(|x| x + (random.unit() - 0.5) * gap));
    }
    points
}

/// The corner of the unit cube.
fn corner<const D: usize>() -> Vec<[f64; D]> {
    (0..=D).map(|i| std::array::from_fn(|k| f64::from(u8::from(i == k)))).collect()
}

/// A real run.
pub fn run<const D: usize>(points: &[[f64; D]], options: &Options) -> Case {
    let mut mesh = Mesh::new(D, points.len(), points.as_flattened(), 0).unwrap();
    mesh.run(options, None).unwrap();
    Case { inputs: mesh.inputs().clone(), mesh: mesh.triangulation().unwrap().clone() }
}

/// A hierarchical mesh by hand: a root of radius 2.5 with a cage of 12, and in it a domain of
/// radius 0.1 round the first input with a cage of 8. The bound on the quality is off. `inputs`
/// and `steiner` come with the domain they belong to.
pub fn by_hand(inputs: &[([f64; 2], u32)], steiner: &[([f64; 2], u32)]) -> Case {
    let center = inputs[0].0;
    let ring = |count: usize, radius: f64, at: [f64; 2]| {
        // Uneven angles and radii: general position.
        (0..count).map(move |i| {
            let angle =
                std::f64::consts::TAU * (i as f64 + 0.07 * (i * i % 5) as f64) / count as f64;
            let radius = radius * (1.0 + 0.003 * (i * i % 7) as f64);
            [at[0] + radius * angle.cos(), at[1] + radius * angle.sin()]
        })
    };
    let mut points: Vec<[f64; 2]> = inputs.iter().chain(steiner).map(|p| p.0).collect();
    let mut labels: Vec<u32> = inputs.iter().chain(steiner).map(|p| p.1).collect();
    let mut kinds = vec![VertexKind::Input; inputs.len()];
    kinds.resize(points.len(), VertexKind::Steiner);
    let mut cage_of = vec![NONE; points.len()];
    // A Steiner vertex at the root's centre.
    points.push([0.011, -0.52]);
    labels.push(0);
    kinds.push(VertexKind::Steiner);
    cage_of.push(NONE);
    let root_center = [0.011, -0.52];
    for (cage, vertices) in
        [ring(12, 2.0, root_center).collect::<Vec<_>>(), ring(8, 0.08, center).collect()]
            .into_iter()
            .enumerate()
    {
        for vertex in vertices {
            points.push(vertex);
            labels.push(cage as u32);
            kinds.push(VertexKind::Cage);
            cage_of.push(cage as u32);
        }
    }
    let mut case = brute_force(&points);
    let given: Vec<[f64; 2]> = inputs.iter().map(|p| p.0).collect();
    case.inputs = Inputs::new(2, given.len(), given.as_flattened(), 0).unwrap();
    case.mesh.domains = vec![
        Domain { center: (inputs.len() + steiner.len()) as u32, parent: NONE, radius: 2.5 },
        Domain { center: 0, parent: 0, radius: 0.1 },
    ];
    case.mesh.parameters = run(&corner::<2>(), &Options::default()).mesh.parameters;
    case.mesh.parameters.quality_bound = 1e9;
    Case { mesh: Triangulation { kinds, vertex_domains: labels, cage_of, ..case.mesh }, ..case }
}

/// The inputs that [`by_hand`] is usually given: a centre, one in its domain, two outside.
pub const BY_HAND: [([f64; 2], u32); 4] =
    [([0.0, 0.0], 1), ([0.03, 0.01], 1), ([0.9, 0.31], 0), ([-0.7, 0.55], 0)];
