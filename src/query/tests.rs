//! Every query against brute force, on points that have broken others.

use super::*;
use crate::numerics::testing::{FAMILIES, Family, Random, integer, points};
use crate::numerics::{Sign, distance, orientation_exact};
use crate::{Algorithm, ErrorKind, Mesh, NONE, Options, Triangulation, VertexKind};
use dashu_int::IBig;

/// Makes a mesh with these options; `None` for inputs that have no such mesh.
pub(super) fn meshed<const D: usize>(points: &[[f64; D]], options: &Options) -> Option<Mesh> {
    let mut mesh = Mesh::new(D, points.len(), points.as_flattened(), 0).ok()?;
    mesh.run(options, None).ok()?;
    Some(mesh)
}

pub(super) fn delaunay() -> Options {
    Options { algorithm: Algorithm::Delaunay, ..Options::default() }
}

/// Meshes of every family of points, with cages and plain.
pub(super) fn each_mesh<const D: usize>(count: usize, act: impl Fn(&Mesh, &[[f64; D]])) {
    let mut made = 0;
    // Meshes with Steiner points are too large in 5D.
    let max_vertices = if D < 5 { 600 } else { 100 };
    for family in FAMILIES {
        // Their meshes are too large to compare by brute force.
        let is_spread = matches!(family, Family::RawBits | Family::PowersOfTwo);
        let mut random = Random(family as u64 * 11 + D as u64);
        let points = points::<D>(family, if is_spread { 8 } else { count }, &mut random);
        for options in [Options { max_vertices, ..Options::default() }, delaunay()] {
            if let Some(mesh) = meshed(&points, &options) {
                made += 1;
                act(&mesh, &points);
            }
        }
    }
    assert!(made >= FAMILIES.len(), "{made}");
}

/// Returns points that are hard for a mesh: its vertices, middles of faces of every dimension,
/// points next to those, points beyond the hull.
pub(super) fn hard_points<const D: usize>(mesh: &Triangulation, count: usize) -> Vec<[f64; D]> {
    let mut random = Random(7);
    let mut pick = |bound: usize| random.integer(0, bound as i64 - 1) as usize;
    let mut found = Vec::new();
    for _ in 0..count {
        let simplex = mesh.simplex(pick(mesh.simplex_count()));
        let (size, first) = (1 + pick(D + 1), pick(D + 1));
        let mut middle = [0.0; D];
        for k in 0..size {
            let vertex = mesh.point(simplex[(first + k) % (D + 1)]);
            (0..D).for_each(|i| middle[i] += vertex[i] / size as f64);
        }
        let axis = pick(D);
        match pick(4) {
            0 => middle[axis] = middle[axis].next_up(),
            1 => middle[axis] = middle[axis].next_down(),
            2 if pick(4) == 0 => middle = middle.map(|x| (1.5 * x).clamp(-1.7e308, 1.7e308)),
            _ => (),
        }
        found.push(middle.map(|x| x.clamp(f64::MIN, f64::MAX)));
    }
    found
}

/// Returns the first simplex that holds `q`, and the face of it that does, by integers alone.
fn brute_place<const D: usize>(mesh: &Triangulation, q: &[f64; D]) -> Place {
    for simplex in 0..mesh.simplex_count() {
        let vertices = mesh.simplex(simplex).iter().map(|&v| mesh.point(v).try_into().unwrap());
        let mut points: Vec<&[f64; D]> = vertices.collect();
        let mut face = 0;
        let holds = (0..=D).all(|i| {
            let kept = std::mem::replace(&mut points[i], q);
            let sign = orientation_exact(&points);
            points[i] = kept;
            face |= u32::from(sign == Sign::Positive) << i;
            sign != Sign::Negative
        });
        if holds {
            return Place { simplex: simplex as u32, face };
        }
    }
    Place::OUTSIDE
}

fn places_are_right<const D: usize>(count: usize, queries: usize) {
    each_mesh::<D>(count, |mesh, inputs| {
        let mesh = mesh.triangulation().unwrap();
        let index = Index::new(mesh).unwrap();
        let mut points = hard_points::<D>(mesh, queries);
        points.extend(inputs.iter().take(10));
        let mut places = vec![Place::OUTSIDE; points.len()];
        index.places(mesh, points.as_flattened(), 1, &mut places).unwrap();
        for (q, place) in points.iter().zip(&places) {
            assert_eq!(*place, brute_place(mesh, q), "{q:?}");
        }
        let mut simplices = vec![0; points.len()];
        index.locate(mesh, points.as_flattened(), 1, &mut simplices).unwrap();
        assert!(simplices.iter().zip(&places).all(|(&simplex, place)| simplex == place.simplex));
    });
}

#[test]
fn places_are_those_of_brute_force() {
    places_are_right::<2>(30, 20);
    places_are_right::<3>(12, 10);
    places_are_right::<4>(8, 2);
    places_are_right::<5>(7, 1);
}

/// Returns |a - q|^2 in units of 2^-2148.
fn squared_distance<const D: usize>(a: &[f64], q: &[f64; D]) -> IBig {
    let square = |i: usize| {
        let x = integer(a[i]) - integer(q[i]);
        &x * &x
    };
    (0..D).map(square).fold(IBig::ZERO, |sum, x| sum + x)
}

fn nearest_are_right<const D: usize>(count: usize, queries: usize) {
    each_mesh::<D>(count, |mesh, inputs| {
        let mesh = mesh.triangulation().unwrap();
        let index = Index::new(mesh).unwrap();
        let mut points = hard_points::<D>(mesh, queries);
        points.extend(inputs.iter().take(10));
        for among in [Among::Vertices, Among::Inputs] {
            let (mut vertices, mut lengths) = (vec![0; points.len()], vec![0.0; points.len()]);
            let flat = points.as_flattened();
            index.nearest(mesh, among, flat, 1, &mut vertices, &mut lengths).unwrap();
            for (at, q) in points.iter().enumerate() {
                let counts = |v: &u32| {
                    among == Among::Vertices || mesh.kinds[*v as usize] == VertexKind::Input
                };
                let candidates = (0..mesh.vertex_count() as u32).filter(counts);
                let nearest =
                    candidates.min_by_key(|&v| (squared_distance(mesh.point(v), q), v)).unwrap();
                assert_eq!(vertices[at], nearest, "{q:?}");
                assert_eq!(lengths[at], distance(q, mesh.point(nearest).try_into().unwrap()));
            }
        }
    });
}

#[test]
fn nearest_vertices_are_those_of_brute_force() {
    nearest_are_right::<2>(30, 6);
    nearest_are_right::<3>(15, 3);
    nearest_are_right::<5>(7, 1);
}

fn lattice<const D: usize>(side: usize) -> Vec<[f64; D]> {
    let at = |i: usize, axis: u32| (i / side.pow(axis) % side) as f64;
    let point = |i| std::array::from_fn(|axis| at(i, axis as u32));
    (0..side.pow(D as u32)).map(point).collect()
}

/// Holds that all vertices of a lattice's cell are equally near to its middle, and that the least
/// id wins.
#[test]
fn ties_go_to_the_least_id() {
    let points = lattice::<3>(6);
    let mesh = meshed(&points, &delaunay()).unwrap();
    let mesh = mesh.triangulation().unwrap();
    let index = Index::new(mesh).unwrap();
    let middles: Vec<[f64; 3]> = lattice::<3>(5).iter().map(|p| p.map(|x| x + 0.5)).collect();
    let (mut vertices, mut lengths) = (vec![0; 125], vec![0.0; 125]);
    let flat = middles.as_flattened();
    index.nearest(mesh, Among::Vertices, flat, 1, &mut vertices, &mut lengths).unwrap();
    for (q, &vertex) in middles.iter().zip(&vertices) {
        assert_eq!(mesh.point(vertex), q.map(|x| x - 0.5));
    }
    assert!(lengths.iter().all(|&length| length == 0.75f64.sqrt()));
}

/// Returns points at random positions in a box about those given.
fn scattered<const D: usize>(points: &[[f64; D]], count: usize, widen: f64) -> Vec<[f64; D]> {
    let mut random = Random(3);
    let bound = |axis: usize| points.iter().fold(0.0f64, |most, p| most.max(p[axis].abs()));
    let bounds: [f64; D] = std::array::from_fn(bound);
    (0..count).map(|_| std::array::from_fn(|i| widen * random.unit() * bounds[i])).collect()
}

#[test]
fn answers_depend_on_neither_order_nor_threads() {
    let inputs = points::<3>(Family::Uniform, 300, &mut Random(5));
    let mesh = meshed(&inputs, &Options::default()).unwrap();
    let mesh = mesh.triangulation().unwrap();
    let index = Index::new(mesh).unwrap();
    let mut queries = scattered(&inputs, 2500, 1.5);
    queries.extend(hard_points::<3>(mesh, 1000));
    let data: Vec<f64> = mesh.points.iter().map(|x| x.sin()).collect();
    let answers = |queries: &[[f64; 3]], threads| {
        let (n, flat) = (queries.len(), queries.as_flattened());
        let mut places = vec![Place::OUTSIDE; n];
        index.places(mesh, flat, threads, &mut places).unwrap();
        let (mut near, mut lengths) = (vec![0; n], vec![0.0; n]);
        index.nearest(mesh, Among::Inputs, flat, threads, &mut near, &mut lengths).unwrap();
        let mut out = vec![0.0; 3 * n];
        let values = Values { components: 3, values: &data };
        let method = Method { interpolation: Interpolation::Sibson, outside: Outside::Nearest };
        index.interpolate(mesh, method, values, flat, threads, &mut out).unwrap();
        let rows = out.chunks_exact(3).map(|row| row.iter().map(|x| x.to_bits()).collect());
        let rows: Vec<Vec<u64>> = rows.collect();
        (0..n).map(|i| (places[i], near[i], rows[i].clone())).collect::<Vec<_>>()
    };
    let once = answers(&queries, 1);
    assert!(once.iter().any(|answer| answer.0 == Place::OUTSIDE));
    for threads in [0, 2, 7] {
        assert_eq!(answers(&queries, threads), once, "{threads} threads");
    }
    queries.reverse();
    let mut reversed = answers(&queries, 2);
    reversed.reverse();
    assert_eq!(reversed, once);
}

/// Returns the method that gives NaN outside.
fn method(interpolation: Interpolation) -> Method {
    Method { interpolation, outside: Outside::Nan }
}

/// Checks that linear functions are reproduced at all points in the hull, and that those outside
/// are NaN.
fn linear_functions_stay<const D: usize>(how: Interpolation, inputs: &[[f64; D]], queries: usize) {
    for options in [Options::default(), delaunay()] {
        let mesh = meshed(inputs, &options).unwrap();
        let mesh = mesh.triangulation().unwrap();
        let index = Index::new(mesh).unwrap();
        let mut points = scattered(inputs, queries, 1.1);
        points.extend(hard_points::<D>(mesh, queries / 2));
        let size = mesh.points.iter().fold(0.0f64, |most, x| most.max(x.abs()));
        let function = |p: &[f64]| (0..D).fold(0.5, |sum, i| sum + p[i] / size * (i as f64 - 0.7));
        let each = mesh.points.chunks_exact(D).flat_map(|p| [function(p), 1.0]);
        let data: Vec<f64> = each.collect();
        let values = Values { components: 2, values: &data };
        let mut out = vec![0.0; 2 * points.len()];
        let flat = points.as_flattened();
        index.interpolate(mesh, method(how), values, flat, 1, &mut out).unwrap();
        let mut simplices = vec![0; points.len()];
        index.locate(mesh, flat, 1, &mut simplices).unwrap();
        for (at, q) in points.iter().enumerate() {
            let (found, one) = (out[2 * at], out[2 * at + 1]);
            if simplices[at] == NONE {
                assert!(found.is_nan() && one.is_nan());
                continue;
            }
            let error = (found - function(q)).abs();
            assert!(error < 1e-12 && (one - 1.0).abs() < 1e-12, "{how:?} {q:?} {error:e} {one}");
        }
    }
}

#[test]
fn linear_functions_are_reproduced() {
    use Interpolation::{Laplace, Linear, Sibson};
    for how in [Linear, Sibson, Laplace] {
        for family in [Family::Uniform, Family::Cospherical, Family::FarCluster, Family::Grid] {
            let mut random = Random(family as u64);
            linear_functions_stay(how, &points::<2>(family, 60, &mut random), 200);
            linear_functions_stay(how, &points::<3>(family, 60, &mut random), 100);
        }
        linear_functions_stay(how, &lattice::<4>(3), 20);
        linear_functions_stay(how, &points::<5>(Family::Uniform, 12, &mut Random(2)), 4);
    }
}

/// Returns the weight of vertex `vertex` at each of the points.
fn weights<const D: usize>(
    mesh: &Triangulation,
    how: Interpolation,
    points: &[[f64; D]],
    vertex: usize,
) -> Vec<f64> {
    let mut data = vec![0.0; mesh.vertex_count()];
    data[vertex] = 1.0;
    let mut out = vec![0.0; points.len()];
    let values = Values { components: 1, values: &data };
    let index = Index::new(mesh).unwrap();
    index.interpolate(mesh, method(how), values, points.as_flattened(), 1, &mut out).unwrap();
    out
}

/// Returns the weights at `q` of the lattice's points `sites`.
fn lattice_weights<const D: usize>(
    how: Interpolation,
    q: [f64; D],
    sites: &[[f64; D]],
) -> Vec<f64> {
    let points = lattice::<D>(6);
    let mesh = meshed(&points, &delaunay()).unwrap();
    let vertex = |site: &[f64; D]| points.iter().position(|p| p == site).unwrap();
    let weight = |site| weights(mesh.triangulation().unwrap(), how, &[q], vertex(site))[0];
    sites.iter().map(weight).collect()
}

/// Compares with the volumes and facets that are known where the cells are unit cubes.
#[test]
fn weights_of_natural_neighbours_are_known_in_a_lattice() {
    use Interpolation::{Laplace, Sibson};
    let check = |found: Vec<f64>, expected: &[f64]| {
        let close = found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-13);
        assert!(close, "{found:?} {expected:?}");
    };
    check(lattice_weights(Sibson, [2.5, 2.5], &[[2.0, 2.0]]), &[0.25]);
    check(lattice_weights(Laplace, [2.5, 2.5], &[[3.0, 2.0]]), &[0.25]);
    // With t = x - 9/4 the left half of the new cell is |y - 2| <= (1 + t) / 2 for 0 <= t <= 1/4.
    let sites = [[2.0, 2.0], [3.0, 2.0], [2.0, 3.0], [3.0, 1.0]];
    let share = 1.0 / 36.0;
    check(lattice_weights(Sibson, [2.5, 2.0], &sites), &[16.0 * share, 16.0 * share, share, share]);
    check(lattice_weights(Laplace, [2.5, 2.0], &sites), &[0.4, 0.4, 0.05, 0.05]);
    // And in space |z - 2| <= (1 + t) / 2 and |y - 2| + |z - 2| <= 1 + t / 2: 121/192 in all.
    let sites = [[2.0, 2.0, 2.0], [3.0, 2.0, 2.0]];
    check(lattice_weights(Sibson, [2.5, 2.0, 2.0], &sites), &[48.0 / 121.0, 48.0 / 121.0]);
}

/// Computes Sibson's weight by counting which cells points nearest to `q` were in.
fn counted_weight<const D: usize>(points: &[[f64; D]], q: &[f64; D], vertex: usize) -> f64 {
    let (mut random, mut all, mut own) = (Random(1), 0, 0);
    for _ in 0..400_000 {
        let x: [f64; D] = std::array::from_fn(|i| q[i] + 0.6 * random.unit());
        let nearest = (0..points.len())
            .min_by(|&a, &b| distance(&points[a], &x).total_cmp(&distance(&points[b], &x)))
            .unwrap();
        if distance(q, &x) < distance(&points[nearest], &x) {
            all += 1;
            own += u32::from(nearest == vertex);
        }
    }
    f64::from(own) / f64::from(all)
}

#[test]
fn weights_of_sibson_are_stolen_volumes() {
    let inputs = points::<3>(Family::Uniform, 60, &mut Random(9));
    let mesh = meshed(&inputs, &delaunay()).unwrap();
    let mesh = mesh.triangulation().unwrap();
    let q = [0.05, -0.1, 0.02];
    let mut heaviest = 0.0f64;
    for vertex in 0..inputs.len() {
        let weight = weights(mesh, Interpolation::Sibson, &[q], vertex)[0];
        if weight > 0.1 {
            let counted = counted_weight(&inputs, &q, vertex);
            assert!((weight - counted).abs() < 1e-2, "{vertex}: {weight} {counted}");
        }
        heaviest = heaviest.max(weight);
    }
    assert!(heaviest > 0.15);
}

#[test]
fn values_of_inputs_reach_all_vertices() {
    let mut inputs = points::<2>(Family::Uniform, 50, &mut Random(4));
    inputs.push(inputs[3]);
    let mesh = meshed(&inputs, &Options::default()).unwrap();
    let plain = meshed(&inputs, &delaunay()).unwrap();
    let (mesh, inputs_of) = (mesh.triangulation().unwrap(), mesh.inputs());
    let data: Vec<f64> = inputs.iter().flat_map(|p| [p[0] + 2.0 * p[1], p[0]]).collect();
    let values = Values { components: 2, values: &data };
    let mut out = vec![0.0; 2 * mesh.vertex_count()];
    extend_values(inputs_of, plain.triangulation(), mesh, values, 1, &mut out).unwrap();
    let within = brute_inside(plain.triangulation().unwrap(), mesh);
    assert!(within.contains(&true) && within.contains(&false));
    let index = Index::new(mesh).unwrap();
    let (mut near, mut lengths) = (vec![0; within.len()], vec![0.0; within.len()]);
    index.nearest(mesh, Among::Inputs, &mesh.points, 1, &mut near, &mut lengths).unwrap();
    for (vertex, within) in within.into_iter().enumerate() {
        let p = mesh.point(vertex as u32);
        let p = if within { p } else { mesh.point(near[vertex]) };
        assert!((out[2 * vertex] - (p[0] + 2.0 * p[1])).abs() < 1e-14, "{vertex}");
        assert!((out[2 * vertex + 1] - p[0]).abs() < 1e-14, "{vertex}");
    }
    extend_values(inputs_of, None, mesh, values, 1, &mut out).unwrap();
    assert!(near.iter().enumerate().all(|(v, &n)| out[2 * v + 1] == mesh.point(n)[0]));
}

/// Returns for each vertex of `mesh` whether `hull` holds it.
fn brute_inside(hull: &Triangulation, mesh: &Triangulation) -> Vec<bool> {
    let points = mesh.points.chunks_exact(2).map(|p| [p[0], p[1]]);
    points.map(|p| brute_place(hull, &p) != Place::OUTSIDE).collect()
}

#[test]
fn wrong_arguments_are_named() {
    let inputs = points::<2>(Family::Uniform, 20, &mut Random(4));
    let mesh = meshed(&inputs, &delaunay()).unwrap();
    let mesh = mesh.triangulation().unwrap();
    let index = Index::new(mesh).unwrap();
    let error = index.locate(mesh, &[0.0, 0.0, 1.0], 1, &mut [0]).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::InvalidArgument);
    assert!(error.message().starts_with("points has length 3"), "{error}");
    let error = index.locate(mesh, &[0.0, 0.0, 1.0, f64::NAN], 1, &mut [0; 2]).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::NonFinite);
    assert!(error.message().starts_with("points[1] has a non-finite coordinate 1"), "{error}");
    let values = Values { components: 2, values: &[0.0; 39] };
    let method = method(Interpolation::Linear);
    let error = index.interpolate(mesh, method, values, &[0.0; 2], 1, &mut [0.0; 2]).unwrap_err();
    assert!(error.message().starts_with("values has length 39"), "{error}");
    let mut other = mesh.clone();
    other.simplices.truncate(3);
    assert_eq!(Index::new(&other).err().unwrap().kind(), ErrorKind::InvalidArgument);
    other.neighbors.truncate(3);
    other.neighbors[0] = 7;
    assert_eq!(Index::new(&other).err().unwrap().kind(), ErrorKind::InvalidArgument);
    let error = index.locate(&other, &[0.0; 2], 1, &mut [0]).unwrap_err();
    assert!(error.message().contains("another mesh"), "{error}");
    index.locate(mesh, &[], 3, &mut []).unwrap();
}

/// Holds that every query, also of points that are all equally near, ends soon after a stop.
#[test]
fn a_stop_ends_every_query() {
    use std::sync::atomic::AtomicBool;
    let inputs = points::<3>(Family::Uniform, 200, &mut Random(4));
    let mesh = meshed(&inputs, &delaunay()).unwrap();
    let mesh = mesh.triangulation().unwrap();
    let index = Index::new(mesh).unwrap();
    let queries = scattered(&inputs, 5000, 1.0);
    let (flat, n) = (queries.as_flattened(), queries.len());
    let switch = AtomicBool::new(true);
    for threads in [1, 3] {
        let work = Work { threads, stop: Stop::new(&switch) };
        let (mut ids, mut numbers) = (vec![7; n], vec![7.0; n]);
        let data = vec![0.0; mesh.vertex_count()];
        let values = Values { components: 1, values: &data };
        let mut answers = vec![index.locate(mesh, flat, work, &mut ids)];
        assert!(ids.iter().all(|&id| id == 7), "nothing was found");
        for interpolation in [Interpolation::Linear, Interpolation::Sibson, Interpolation::Laplace]
        {
            let method = Method { interpolation, outside: Outside::Nearest };
            answers.push(index.interpolate(mesh, method, values, flat, work, &mut numbers));
        }
        let among = Among::Vertices;
        answers.push(index.nearest(mesh, among, flat, work, &mut ids, &mut numbers));
        assert!(numbers.iter().all(|&number| number == 7.0), "nothing was made");
        for answer in answers {
            assert_eq!(answer.unwrap_err().kind(), ErrorKind::Cancelled);
        }
    }
    switch.store(false, std::sync::atomic::Ordering::Relaxed);
    let work = Work { threads: 1, stop: Stop::new(&switch) };
    index.locate(mesh, flat, work, &mut vec![7; n]).unwrap();
}

/// Holds that a query ends after so many questions, unless it needs fewer.
#[test]
fn a_stop_after_some_questions_ends_long_queries_alone() {
    use std::sync::atomic::{AtomicU32, Ordering};
    // All inputs are equally near to the middle.
    let circle = (0..2000).map(|at| (at as f64 * 0.003_141).sin_cos());
    let mut inputs: Vec<[f64; 2]> = circle.map(|(y, x)| [x, y]).collect();
    inputs.push([0.0, 3.0]);
    let tree = PointIndex::new(2, inputs.as_flattened()).unwrap();
    let answer = |q: [f64; 2], questions| {
        let (left, mut id, mut distance) = (AtomicU32::new(questions), [0], [0.0]);
        let work = Work { threads: 1, stop: Stop::after(&left) };
        let answer = tree.nearest(&q, work, &mut id, &mut distance);
        (answer.map(|()| id[0]).map_err(|error| error.kind()), left.load(Ordering::Relaxed))
    };
    assert_eq!(answer([0.0; 2], 100), (Err(ErrorKind::Cancelled), 0));
    let (found, left) = answer([0.0, 2.9], 100);
    assert_eq!(found, Ok(2000));
    assert!((1..100).contains(&left), "{left}");
    let (found, left) = answer([0.0; 2], 1 << 20);
    assert!(found.is_ok() && (1..1 << 20).contains(&left), "{left}");
    assert_eq!(answer([0.0, 2.9], 0), (Err(ErrorKind::Cancelled), 0));
}

#[test]
fn bytes_are_about_what_is_said() {
    let inputs = points::<3>(Family::Uniform, 2000, &mut Random(4));
    let mesh = meshed(&inputs, &delaunay()).unwrap();
    let index = Index::new(mesh.triangulation().unwrap()).unwrap();
    let a_vertex = index.bytes() as f64 / 2000.0;
    assert!((32.0..36.0).contains(&a_vertex), "{a_vertex}");
}
