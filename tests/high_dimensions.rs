//! Arrays and queries of meshes in 6 to 8 dimensions, which the unit tests leave out.

use crate::random::Random;
use netmesh::numerics::{Sign, distance, orientation_exact};
use netmesh::query::{Among, Index, Interpolation, Method, Outside, Values};
use netmesh::{Algorithm, Mesh, NONE, Options, Triangulation};

fn each_dimension(check: impl Fn(&Mesh, &mut Random)) {
    for (dim, n) in [(6, 12), (7, 12), (8, 12)] {
        let mut random = Random::new(dim as u64);
        let mut mesh = Mesh::new(dim, n, &random.uniform(dim, n), 0).unwrap();
        let options = Options { algorithm: Algorithm::Delaunay, ..Options::default() };
        mesh.run(&options, None).unwrap();
        check(&mesh, &mut random);
    }
}

#[test]
fn arrays_agree_with_each_other() {
    each_dimension(|mesh, _| {
        let dim = mesh.triangulation().unwrap().dim;
        assert_eq!(mesh.edges().unwrap().len() % 2, 0);
        let volume: f64 = mesh.volumes().unwrap().iter().sum();
        let shares: f64 = mesh.voronoi().unwrap().shares.iter().sum();
        assert!((volume - shares).abs() < 1e-9 * volume.abs(), "{volume} {shares}");
        let hull = mesh.hull().unwrap();
        assert_eq!(hull.vertices.len(), dim * hull.simplices.len());
    });
}

/// Returns true if `q` is in the simplex or on its boundary, by integers.
fn holds<const D: usize>(mesh: &Triangulation, simplex: usize, q: &[f64]) -> bool {
    let q: &[f64; D] = q.try_into().unwrap();
    let vertices = mesh.simplex(simplex).iter().map(|&v| mesh.point(v).try_into().unwrap());
    let points: Vec<&[f64; D]> = vertices.collect();
    (0..=D).all(|i| {
        let mut replaced = points.clone();
        replaced[i] = q;
        orientation_exact(&replaced) != Sign::Negative
    })
}

fn first_that_holds(mesh: &Triangulation, q: &[f64]) -> u32 {
    let holds = match mesh.dim {
        6 => holds::<6>,
        7 => holds::<7>,
        _ => holds::<8>,
    };
    (0..mesh.simplex_count()).find(|&simplex| holds(mesh, simplex, q)).map_or(NONE, |s| s as u32)
}

/// Points in the cube, the middles of some simplices, and vertices.
fn queries(mesh: &Triangulation, random: &mut Random) -> Vec<f64> {
    let mut points = random.uniform(mesh.dim, 8);
    for simplex in 0..mesh.simplex_count().min(20) {
        let sum = |axis: usize| mesh.simplex(simplex).iter().map(|&v| mesh.point(v)[axis]).sum();
        points.extend((0..mesh.dim).map(|axis| {
            let sum: f64 = sum(axis);
            sum / (mesh.dim + 1) as f64
        }));
    }
    points.extend(&mesh.points[..3 * mesh.dim]);
    points
}

#[test]
fn simplices_are_found() {
    each_dimension(|mesh, random| {
        let mesh = mesh.triangulation().unwrap();
        let points = queries(mesh, random);
        let mut found = vec![0; points.len() / mesh.dim];
        Index::new(mesh).unwrap().locate(mesh, &points, 1, &mut found).unwrap();
        for (q, &simplex) in points.chunks(mesh.dim).zip(&found) {
            assert_eq!(simplex, first_that_holds(mesh, q), "{}D {q:?}", mesh.dim);
        }
        assert!(found.iter().filter(|&&simplex| simplex != NONE).count() > 20);
    });
}

#[test]
fn nearest_vertices_are_found() {
    each_dimension(|mesh, random| {
        let mesh = mesh.triangulation().unwrap();
        let points = queries(mesh, random);
        let (mut vertices, mut lengths) =
            (vec![0; points.len() / mesh.dim], vec![0.0; points.len() / mesh.dim]);
        let index = Index::new(mesh).unwrap();
        index.nearest(mesh, Among::Vertices, &points, 1, &mut vertices, &mut lengths).unwrap();
        for ((q, &vertex), &length) in points.chunks(mesh.dim).zip(&vertices).zip(&lengths) {
            let to = |v: u32| match mesh.dim {
                6 => distance::<6>(q.try_into().unwrap(), mesh.point(v).try_into().unwrap()),
                7 => distance::<7>(q.try_into().unwrap(), mesh.point(v).try_into().unwrap()),
                _ => distance::<8>(q.try_into().unwrap(), mesh.point(v).try_into().unwrap()),
            };
            let least = (0..mesh.vertex_count() as u32).map(to).fold(f64::INFINITY, f64::min);
            assert_eq!((to(vertex), length), (least, least), "{}D {q:?}", mesh.dim);
        }
    });
}

#[test]
fn linear_functions_are_reproduced() {
    each_dimension(|mesh, random| {
        let mesh = mesh.triangulation().unwrap();
        let points = queries(mesh, random);
        let function =
            |p: &[f64]| p.iter().enumerate().fold(0.5, |sum, (i, x)| sum + x * (i as f64 - 0.7));
        let data: Vec<f64> = mesh.points.chunks(mesh.dim).map(function).collect();
        let values = Values { components: 1, values: &data };
        let mut out = vec![0.0; points.len() / mesh.dim];
        let method = Method { interpolation: Interpolation::Linear, outside: Outside::Nan };
        Index::new(mesh).unwrap().interpolate(mesh, method, values, &points, 1, &mut out).unwrap();
        for (q, &found) in points.chunks(mesh.dim).zip(&out) {
            let is_outside = first_that_holds(mesh, q) == NONE;
            assert_eq!(found.is_nan(), is_outside);
            assert!(is_outside || (found - function(q)).abs() < 1e-12, "{}D {q:?}", mesh.dim);
        }
    });
}
