//! Every array compared with brute force, on points that have broken others.

use crate::mesh::{NONE, Triangulation};
use crate::numerics::testing::{
    FAMILIES, Family, Random, circumcenter_oracle, integer, is_close, points,
};
use crate::numerics::{Sign, orientation_exact};
use crate::{Algorithm, ErrorKind, Mesh, Options};
use dashu_int::IBig;
use std::collections::{BTreeMap, BTreeSet};

pub fn meshed<const D: usize>(points: &[[f64; D]], options: &Options) -> Option<Mesh> {
    let mut mesh = Mesh::new(D, points.len(), points.as_flattened(), 0).ok()?;
    mesh.run(options, None).ok()?;
    Some(mesh)
}

pub fn delaunay() -> Options {
    Options { algorithm: Algorithm::Delaunay, ..Options::default() }
}

/// Meshes every family of points, with cages and without, and calls `act` with each mesh.
pub fn each_mesh<const D: usize>(count: usize, act: impl Fn(&Mesh, Family)) {
    let mut made = 0;
    // Meshes with Steiner points are too large in 5D.
    let max_vertices = if D < 5 { 600 } else { 100 };
    for family in FAMILIES {
        // Their meshes are too large for brute force.
        let is_spread = matches!(family, Family::RawBits | Family::PowersOfTwo);
        let mut random = Random(family as u64 * 13 + D as u64);
        let points = points::<D>(family, if is_spread { 8 } else { count }, &mut random);
        for options in [Options { max_vertices, ..Options::default() }, delaunay()] {
            if let Some(mesh) = meshed(&points, &options) {
                made += 1;
                act(&mesh, family);
            }
        }
    }
    assert!(made >= FAMILIES.len(), "{made}");
}

fn without(vertices: &[u32], i: usize) -> Vec<u32> {
    let mut others = vertices.to_vec();
    others.remove(i);
    others
}

fn sorted(mut vertices: Vec<u32>) -> Vec<u32> {
    vertices.sort_unstable();
    vertices
}

fn faces_are_right<const D: usize>(count: usize) {
    each_mesh::<D>(count, |mesh, _| {
        let triangulation = mesh.triangulation().unwrap();
        let (mut edges, mut facets) = (BTreeSet::new(), BTreeMap::<_, Vec<u32>>::new());
        for (simplex, vertices) in triangulation.simplices.chunks_exact(D + 1).enumerate() {
            for i in 0..=D {
                let facet = sorted(without(vertices, i));
                facets.entry(facet).or_default().push(simplex as u32);
                let others = vertices.iter().filter(|&&other| other > vertices[i]);
                edges.extend(others.map(|&other| [vertices[i], other]));
            }
        }
        let expected: Vec<u32> = edges.iter().flatten().copied().collect();
        assert_eq!(mesh.edges().unwrap(), expected);
        let neighbors = mesh.vertex_neighbors().unwrap();
        for (vertex, list) in neighbors.iter().enumerate() {
            let vertex = vertex as u32;
            let of = |edge: &[u32; 2]| edge.contains(&vertex).then(|| edge[0] + edge[1] - vertex);
            assert_eq!(list, sorted(edges.iter().filter_map(of).collect()));
        }
        let stars = mesh.vertex_simplices().unwrap();
        for (vertex, list) in stars.iter().enumerate() {
            let has = |s: &usize| triangulation.simplex(*s).contains(&(vertex as u32));
            let expected = (0..triangulation.simplex_count()).filter(has).map(|s| s as u32);
            assert_eq!(list, expected.collect::<Vec<_>>());
        }
        let found = mesh.facets().unwrap();
        assert_eq!(found.vertices.len(), facets.len() * D);
        let mut once = BTreeSet::new();
        for (vertices, simplices) in
            found.vertices.chunks_exact(D).zip(found.simplices.chunks_exact(2))
        {
            let mut expected = facets[&sorted(vertices.to_vec())].clone();
            expected.resize(2, NONE);
            assert_eq!(simplices, expected);
            assert!(once.insert(sorted(vertices.to_vec())));
            points_outwards::<D>(triangulation, vertices, simplices[0]);
        }
        let hull = mesh.hull().unwrap();
        let on_hull = facets.values().filter(|simplices| simplices.len() == 1);
        assert_eq!(hull.simplices.len(), on_hull.count());
        for (vertices, &simplex) in hull.vertices.chunks_exact(D).zip(&hull.simplices) {
            assert_eq!(facets[&sorted(vertices.to_vec())], [simplex]);
            points_outwards::<D>(triangulation, vertices, simplex);
        }
    });
}

fn points_outwards<const D: usize>(mesh: &Triangulation, facet: &[u32], simplex: u32) {
    let inner = mesh.simplex(simplex as usize).iter().find(|v| !facet.contains(v)).unwrap();
    let ids = [inner].into_iter().chain(facet);
    let points: Vec<&[f64; D]> = ids.map(|&v| mesh.point(v).try_into().unwrap()).collect();
    assert_eq!(orientation_exact(&points), Sign::Positive);
}

#[test]
fn faces_are_those_of_brute_force() {
    faces_are_right::<2>(30);
    faces_are_right::<3>(15);
    faces_are_right::<4>(9);
    faces_are_right::<5>(7);
}

#[test]
fn the_hull_of_a_square_goes_counterclockwise() {
    let mesh = meshed(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], &delaunay()).unwrap();
    let hull = mesh.hull().unwrap();
    let mut edges: Vec<&[u32]> = hull.vertices.chunks_exact(2).collect();
    edges.sort_unstable();
    assert_eq!(edges, [[0, 1], [1, 2], [2, 3], [3, 0]]);
}

/// Returns true if `value` is, up to roundings, the root of the sum of the squares of the
/// quotients.
fn is_root(value: f64, numerators: &[IBig], denominator: &IBig) -> bool {
    let (unit, parts) = (IBig::from(10u64.pow(12)), |x: i64| IBig::from(10i64.pow(12) + x));
    let squares = numerators.iter().fold(IBig::ZERO, |sum, x| sum + x * x) * &unit * &unit;
    let scaled = |x: IBig, ulps: i64| {
        let x = (integer(value) + ulps) * x * denominator;
        &x * &x
    };
    scaled(parts(-2), -1) <= squares && squares <= scaled(parts(2), 1)
}

fn circumcenters_are_right<const D: usize>(count: usize) {
    each_mesh::<D>(count, |mesh, family| {
        let triangulation = mesh.triangulation().unwrap();
        let found = mesh.circumcenters().unwrap();
        for (simplex, radius) in found.radii.iter().enumerate().step_by(7).take(30) {
            let vertices = triangulation.simplex(simplex).iter();
            let points: Vec<&[f64; D]> =
                vertices.map(|&v| triangulation.point(v).try_into().unwrap()).collect();
            let (numerators, denominator) = circumcenter_oracle(&points, 0);
            if radius.is_finite() {
                assert!(is_root(*radius, &numerators, &denominator), "{family:?} {points:?}");
            }
            for axis in 0..D {
                let value = found.centers[simplex * D + axis];
                let exact = &numerators[axis] + integer(points[0][axis]) * &denominator;
                if value.is_infinite() {
                    let limit = integer(f64::MAX) * &denominator;
                    let exact = if value > 0.0 { exact } else { -exact };
                    assert!(if denominator > IBig::ZERO { exact > limit } else { exact < limit });
                } else if radius.is_finite() {
                    let bound = 2e-12 * radius + value.abs() * f64::EPSILON + f64::from_bits(2);
                    let is_close = is_close(value, bound, 0, (&exact, &denominator));
                    assert!(is_close, "{family:?} {points:?}");
                }
            }
        }
    });
}

#[test]
fn circumcentres_are_those_of_integers() {
    circumcenters_are_right::<2>(30);
    circumcenters_are_right::<3>(15);
    circumcenters_are_right::<4>(8);
    circumcenters_are_right::<5>(7);
}

#[test]
fn a_centre_is_finite_where_its_distance_is_not() {
    let m = f64::MAX;
    let near = meshed(&[[-m, 0.0], [m, 0.0], [0.0, m]], &delaunay()).unwrap();
    let found = near.circumcenters().unwrap();
    assert_eq!((&found.centers[..], &found.radii[..]), (&[0.0, 0.0][..], &[m][..]));
    let far = meshed(&[[-m, 0.0], [m, 0.0], [0.0, m / 1024.0]], &delaunay()).unwrap();
    let found = far.circumcenters().unwrap();
    assert_eq!((found.centers[1], found.radii[0]), (f64::NEG_INFINITY, f64::INFINITY));
}

/// Checks that cells' shares add up to the volume of the mesh, where volumes are neither too small
/// nor too large for doubles.
fn shares_add_up<const D: usize>(count: usize) {
    each_mesh::<D>(count, |mesh, family| {
        let (volumes, voronoi) = (mesh.volumes().unwrap(), mesh.voronoi().unwrap());
        let volume: f64 = volumes.iter().sum();
        let shared: f64 = voronoi.shares.iter().sum();
        let size: f64 = voronoi.shares.iter().map(|share| share.abs()).sum();
        let is_ordinary = (1e-280..1e280).contains(&volume) && size.is_finite();
        // Needles 2^60 times as long as wide have shares of which all digits cancel.
        if !is_ordinary || family == Family::MixedScales {
            return;
        }
        let error = (shared - volume).abs() / size;
        assert!(error <= 1e-9, "{family:?}: {shared} {volume} {size}");
        for (vertex, &bounded) in voronoi.is_bounded.iter().enumerate() {
            let share = voronoi.shares[vertex];
            assert_eq!(voronoi.volumes[vertex], if bounded { share } else { f64::INFINITY });
            assert!(!bounded || share > -1e-9 * size, "{family:?}: {share}");
        }
    });
}

#[test]
fn shares_of_the_mesh_add_up_to_its_volume() {
    shares_add_up::<2>(40);
    shares_add_up::<3>(20);
    shares_add_up::<4>(8);
    shares_add_up::<5>(8);
}

#[test]
fn cells_of_a_lattice_have_its_volume() {
    for scale in [1.0, 2f64.powi(300), 2f64.powi(-300)] {
        let at = |i: usize, axis: u32| (i / 4usize.pow(axis) % 4) as f64 * scale;
        let points: Vec<[f64; 3]> =
            (0..64).map(|i| std::array::from_fn(|axis| at(i, axis as u32))).collect();
        let mesh = meshed(&points, &delaunay()).unwrap();
        let voronoi = mesh.voronoi().unwrap();
        let cube = scale * scale * scale;
        let mut bounded = 0;
        for (vertex, &volume) in voronoi.volumes.iter().enumerate() {
            let inside = points[vertex].iter().all(|&x| 0.0 < x && x < 3.0 * scale);
            assert_eq!(voronoi.is_bounded[vertex], inside);
            bounded += usize::from(inside);
            assert!(!inside || (volume / cube - 1.0).abs() < 1e-12, "{volume}");
        }
        assert_eq!(bounded, 8);
        let (shares, volume) = (&voronoi.shares, 27.0 * cube);
        assert!((shares.iter().sum::<f64>() / volume - 1.0).abs() < 1e-12);
    }
}

/// Returns the circumcentres of some simplices.
fn corners<const D: usize>(centers: &[f64], simplices: &[u32]) -> Vec<[f64; D]> {
    let center = |&s: &u32| centers[s as usize * D..][..D].try_into().unwrap();
    simplices.iter().map(center).collect()
}

#[test]
fn cells_in_the_plane_are_polygons_in_counterclockwise_order() {
    let points = points::<2>(Family::Uniform, 80, &mut Random(2));
    for options in [Options::default(), delaunay()] {
        let mesh = meshed(&points, &options).unwrap();
        let (voronoi, centers) = (mesh.voronoi().unwrap(), mesh.circumcenters().unwrap().centers);
        let cells = voronoi.regions.iter().zip(&voronoi.volumes).zip(&voronoi.is_bounded);
        for ((region, volume), bounded) in cells {
            let corners = corners::<2>(&centers, region);
            let next = corners.iter().cycle().skip(1);
            let area: f64 =
                corners.iter().zip(next).map(|(p, q)| 0.5 * (p[0] * q[1] - p[1] * q[0])).sum();
            assert!(!bounded || (area - volume).abs() < 1e-9 * volume, "{area} {volume}");
            let mut once = region.to_vec();
            once.sort_unstable();
            once.dedup();
            assert_eq!(once.len(), region.len());
        }
    }
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3])
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[i] - b[i])
}

fn length(a: [f64; 3]) -> f64 {
    a.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The volume of a cell equals the sum of its pyramids on the ridges, whose areas need their
/// corners in order.
#[test]
fn ridges_in_space_are_polygons_in_order() {
    let points = points::<3>(Family::Uniform, 60, &mut Random(2));
    for options in [Options::default(), delaunay()] {
        let mesh = meshed(&points, &options).unwrap();
        let triangulation = mesh.triangulation().unwrap();
        let (voronoi, centers) = (mesh.voronoi().unwrap(), mesh.circumcenters().unwrap().centers);
        let mut sums = vec![0.0; triangulation.vertex_count()];
        for (at, ends) in voronoi.ridges.chunks_exact(2).enumerate() {
            for pair in voronoi.ridge_corners.of(at).windows(2) {
                assert!(triangulation.neighbors_of(pair[0] as usize).contains(&pair[1]));
            }
            if !voronoi.is_ridge_bounded[at] {
                sums[ends[0] as usize] = f64::INFINITY;
                sums[ends[1] as usize] = f64::INFINITY;
                continue;
            }
            let corners = corners::<3>(&centers, voronoi.ridge_corners.of(at));
            let mut twice = [0.0; 3];
            for pair in corners[1..].windows(2) {
                let part = cross(minus(pair[0], corners[0]), minus(pair[1], corners[0]));
                twice = std::array::from_fn(|i| twice[i] + part[i]);
            }
            let ends = ends.iter().map(|&v| (v, triangulation.point(v).try_into().unwrap()));
            let ends: Vec<(u32, [f64; 3])> = ends.collect();
            let pyramid = length(twice) * length(minus(ends[0].1, ends[1].1)) / 12.0;
            ends.iter().for_each(|(v, _)| sums[*v as usize] += pyramid);
        }
        for (vertex, sum) in sums.into_iter().enumerate() {
            assert_eq!(voronoi.is_bounded[vertex], sum.is_finite());
            let volume = voronoi.volumes[vertex];
            assert!(sum == volume || (sum - volume).abs() < 1e-9 * volume, "{sum} {volume}");
        }
    }
}

#[test]
fn there_are_no_arrays_before_a_run() {
    let mesh = Mesh::new(2, 3, &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0], 0).unwrap();
    assert_eq!(mesh.edges().unwrap_err().kind(), ErrorKind::State);
    assert_eq!(mesh.voronoi().unwrap_err().kind(), ErrorKind::State);
}
