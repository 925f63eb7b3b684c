//! Sizes from curvature: edges are chords of the round surface that facets approximate.

use super::{Point, Solid, assert_holds, bounded, cuboid, tilted};
use crate::random::Random;
use netmesh::options::{Extent, Options, Output};
use netmesh::{ErrorKind, Mesh, Triangulation};

/// Returns a prism over the regular polygon with so many sides in the circle of radius 1.
fn prism(sides: u32, height: f64) -> Solid {
    let angle = |side: u32| f64::from(side) * std::f64::consts::TAU / f64::from(sides);
    let ring = |z: f64| (0..sides).map(move |side| [angle(side).cos(), angle(side).sin(), z]);
    let around = (0..sides).map(|side| {
        let next = (side + 1) % sides;
        vec![side, next, next + sides, side + sides]
    });
    let caps = [(0..sides).rev().collect(), (sides..2 * sides).collect()];
    Solid {
        points: ring(0.0).chain(ring(height)).collect(),
        polygons: around.chain(caps).collect(),
        regions: Vec::new(),
    }
}

/// Returns the length of a chord of a circle whose middle is so far from it.
fn chord(radius: f64, error: f64) -> f64 {
    2.0 * (radius * radius - (radius - error) * (radius - error)).sqrt()
}

fn distance(p: &Point, q: &Point) -> f64 {
    p.iter().zip(q).map(|(p, q)| (p - q).powi(2)).sum::<f64>().sqrt()
}

/// Returns the distance from the edge between two points, by halving it.
fn distance_to_edge(x: &Point, mut ends: [Point; 2]) -> f64 {
    for _ in 0..60 {
        let middle = std::array::from_fn(|k| 0.5 * ends[0][k] + 0.5 * ends[1][k]);
        let farther = usize::from(distance(x, &ends[1]) > distance(x, &ends[0]));
        ends[farther] = middle;
    }
    distance(x, &ends[0])
}

fn with_error(size_from_curvature: f64) -> Options {
    Options { size_from_curvature, ..bounded(2.0) }
}

/// Returns the mesh of a run whose certificate holds.
fn run(mesh: &mut Mesh, options: &Options) -> Triangulation {
    mesh.run(options, None).unwrap_or_else(|error| panic!("{error}"));
    assert_holds(mesh);
    mesh.result().unwrap().clone()
}

/// Fails unless the size at each vertex is that of chords at the edges of a prism, and what it
/// grows to from there.
fn assert_sizes(made: &Triangulation, solid: &Solid, sides: usize, expected: f64) {
    let edges = (0..sides).map(|side| [solid.points[side], solid.points[side + sides]]);
    let edges: Vec<[Point; 2]> = edges.collect();
    let mut at_edges = 0;
    for (vertex, &size) in made.sizes.iter().enumerate() {
        let point: Point = made.point(vertex as u32).try_into().unwrap();
        let near = |ends: &[Point; 2]| distance_to_edge(&point, *ends);
        let nearest = edges.iter().map(near).fold(f64::INFINITY, f64::min);
        let grown = expected + 0.5 * nearest;
        assert!((size - grown).abs() < 1e-9 * grown, "{size} instead of {grown} at {point:?}");
        at_edges += usize::from(nearest < 1e-12);
    }
    assert!(at_edges > 4 * sides, "{at_edges} vertices");
}

#[test]
fn edges_of_a_cylinder_are_chords() {
    for (sides, error) in [(8, 0.05), (24, 0.01), (50, 0.004)] {
        let solid = prism(sides, 3.0).moved(tilted);
        let made = run(&mut solid.mesh(), &with_error(error));
        assert_sizes(&made, &solid, sides as usize, chord(1.0, error));
        // As long as chords: what is round is meshed as finely, and no more.
        let plain = run(&mut solid.mesh(), &bounded(2.0));
        assert!(made.vertex_count() > plain.vertex_count());
    }
}

/// Returns the triangles of a prism, with another vertex in the middle of the lid.
fn triangles_of(solid: &mut Solid, sides: u32) -> Vec<[u32; 3]> {
    let middle = solid.points.len() as u32;
    solid.points.push([0.0, 0.0, solid.points[sides as usize][2]]);
    let (lid, others) = solid.polygons.split_last().unwrap();
    let fan = |polygon: &Vec<u32>| -> Vec<[u32; 3]> {
        (2..polygon.len()).map(|k| [polygon[0], polygon[k - 1], polygon[k]]).collect()
    };
    let next = |at: usize| lid[(at + 1) % lid.len()];
    let of_lid = (0..lid.len()).map(|at| [middle, lid[at], next(at)]);
    others.iter().flat_map(fan).chain(of_lid).collect()
}

fn mesh_of_triangles(solid: &Solid, triangles: &[[u32; 3]]) -> Mesh {
    let mut mesh = Mesh::new(3, solid.points.len(), solid.points.as_flattened(), 0).unwrap();
    mesh.set_triangles(triangles.as_flattened(), None).unwrap();
    mesh
}

/// Triangles that are turned any way round bend as they do otherwise.
#[test]
fn triangles_may_be_turned_round() {
    let (sides, error) = (24, 0.01);
    let mut solid = prism(sides, 3.0);
    let triangles = triangles_of(&mut solid, sides);
    let solid = solid.moved(tilted);
    for some in [usize::MAX, 2, 3] {
        let turned = triangles.iter().zip(1..).map(|(&[a, b, c], at)| match at % some {
            0 => [a, c, b],
            _ => [a, b, c],
        });
        let turned: Vec<[u32; 3]> = turned.collect();
        let made = run(&mut mesh_of_triangles(&solid, &turned), &with_error(error));
        assert_sizes(&made, &solid, sides as usize, chord(1.0, error));
    }
}

/// Triangles with hardly any width are parts of the facets that they are in.
#[test]
fn needles_have_the_sizes_of_their_facets() {
    let (sides, error) = (24, 0.01);
    let mut solid = prism(sides, 3.0);
    let triangles = triangles_of(&mut solid, sides);
    // A vertex very near the end of an edge of the lid, and so of a side.
    let near = solid.points.len() as u32;
    let [p, q] = [solid.points[sides as usize], solid.points[sides as usize + 1]];
    solid.points.push(std::array::from_fn(|k| p[k] + 1e-7 * (q[k] - p[k])));
    let has_edge = |one: &[u32; 3]| one.contains(&sides) && one.contains(&(sides + 1));
    let (split, mut all): (Vec<_>, Vec<_>) = triangles.into_iter().partition(has_edge);
    assert_eq!(split.len(), 2);
    for triangle in split {
        for end in [sides, sides + 1] {
            all.push(triangle.map(|vertex| if vertex == end { near } else { vertex }));
        }
    }
    let solid = solid.moved(tilted);
    let options = Options { coplanar: 1e-3, ..with_error(error) };
    let made = run(&mut mesh_of_triangles(&solid, &all), &options);
    assert_sizes(&made, &solid, sides as usize, chord(1.0, error));
}

/// Holds that creases ask for nothing: the mesh is the one without the option.
#[test]
fn nothing_is_round_about_boxes_and_hexagons() {
    for solid in [cuboid([0.0; 3], [1.0, 2.0, 3.0]), prism(6, 3.0)] {
        let made = run(&mut solid.mesh(), &with_error(1e-3));
        let plain = run(&mut solid.mesh(), &bounded(2.0));
        assert_eq!((&made.points, &made.simplices), (&plain.points, &plain.simplices));
        assert!(made.sizes.iter().all(|size| *size == f64::INFINITY));
    }
}

/// Holds that what is rounder than the error asks for edges of twice the error, and that a smaller
/// size from elsewhere counts.
#[test]
fn no_size_is_below_twice_the_error() {
    let solid = prism(24, 30.0);
    let made = run(&mut solid.mesh(), &with_error(1.5));
    assert_sizes(&made, &solid, 24, 3.0);
    let mut mesh = solid.mesh();
    mesh.run_sized(&with_error(1.5), Some(&|_| 2.0), None).unwrap();
    assert_holds(&mesh);
    assert!(mesh.result().unwrap().sizes.iter().all(|size| *size == 2.0));
}

#[test]
fn sizes_are_those_of_the_scale() {
    for exponent in [-900, -1, 700] {
        let scale = 2f64.powi(exponent);
        let solid = prism(24, 3.0).moved(|x| x.map(|x| x * scale));
        let made = run(&mut solid.mesh(), &with_error(0.01 * scale));
        for vertex in 0..48 {
            let size = made.sizes[vertex] / scale;
            assert!((size - chord(1.0, 0.01)).abs() < 1e-12, "{size} at 2^{exponent}");
        }
    }
}

#[test]
fn a_hull_of_points_on_a_sphere_is_round() {
    let mut random = Random::new(3);
    let points: Vec<Point> = (0..400)
        .map(|_| {
            let way: Vec<f64> = (0..3).map(|_| random.unit() - 0.5).collect();
            let length = way.iter().map(|x| x * x).sum::<f64>().sqrt();
            [0, 1, 2].map(|k| way[k] / length)
        })
        .collect();
    let mut mesh = Mesh::new(3, points.len(), points.as_flattened(), 0).unwrap();
    let made = run(&mut mesh, &Options { extent: Extent::Hull, ..with_error(0.02) });
    // Triangles are chords of the sphere, too: of one radius but for their shapes. The narrower
    // one counts.
    let mut sizes: Vec<f64> = (0..400).map(|vertex| made.sizes[vertex]).collect();
    sizes.sort_by(f64::total_cmp);
    let median = sizes[200] / chord(1.0, 0.02);
    assert!((0.4..1.0).contains(&median), "{median}");
}

#[test]
fn what_has_no_facets_is_refused() {
    let refused = |mesh: &mut Mesh, options: &Options, words: &str| {
        let error = mesh.run(options, None).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::InvalidArgument);
        assert!(error.to_string().contains(words), "{error}");
        assert!(mesh.triangulation().is_none());
    };
    let points = Random::new(1).uniform(3, 20);
    let mut cloud = Mesh::new(3, 20, &points, 0).unwrap();
    let words = "size_from_curvature is 0.5; it needs facets; the mesh has none";
    refused(&mut cloud, &with_error(0.5), words);
    let mut plane = Mesh::new(2, 3, &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0], 0).unwrap();
    refused(&mut plane, &with_error(0.5), "size_from_curvature is 0.5; it must be 0 in 2D");
    let mut solid = prism(24, 3.0).mesh();
    for wrong in [-1.0, f64::NAN] {
        refused(&mut solid, &with_error(wrong), "size_from_curvature is ");
    }
    let options = Options { output: Output::Hierarchical, ..with_error(0.5) };
    refused(&mut solid, &options, "Hierarchical");
    refused(&mut cloud, &Options { extent: Extent::All, ..options }, "size_from_curvature is 0.5");
}
