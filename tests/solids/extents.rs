//! Boxes and hulls in space: the volume is exactly theirs, and everything on their boundary
//! conforms.

use super::{Point, Solid, assert_holds, bounded, cuboid, tilted, volume};
use crate::random::Random;
use netmesh::error::ErrorKind;
use netmesh::numerics::orientation;
use netmesh::options::{Algorithm, Extent, Options};
use netmesh::{Mesh, NONE, Region, Triangulation, VertexKind};

const BOTH: [Extent; 2] = [Extent::Box, Extent::Hull];

fn within(extent: Extent, bound: f64) -> Options {
    Options { extent, ..bounded(bound) }
}

/// Returns the mesh of points alone, whose certificate holds.
fn run(points: &[Point], options: &Options) -> Triangulation {
    Solid { points: points.to_vec(), ..Solid::default() }.run(options)
}

fn random(count: usize, seed: u64) -> Vec<Point> {
    let coordinates = Random::new(seed).uniform(3, count);
    coordinates.chunks_exact(3).map(|x| [x[0], x[1], x[2]]).collect()
}

fn grid(n: u32) -> Vec<Point> {
    let all = (0..n).flat_map(|i| (0..n).flat_map(move |j| (0..n).map(move |k| [i, j, k])));
    all.map(|x| x.map(f64::from)).collect()
}

fn ends(points: &[Point]) -> [Point; 2] {
    let over = |of: fn(f64, f64) -> f64, first: f64| {
        points.iter().fold([first; 3], |all, x| std::array::from_fn(|k| of(all[k], x[k])))
    };
    [over(f64::min, f64::INFINITY), over(f64::max, f64::NEG_INFINITY)]
}

fn box_volume(points: &[Point]) -> f64 {
    let [low, high] = ends(points);
    (0..3).map(|k| high[k] - low[k]).product()
}

/// Returns the volume of the hull of points of which no four are in one plane: three are a side
/// where all others are behind them.
fn hull_volume(points: &[Point]) -> f64 {
    let count = points.len();
    let mut six = 0.0;
    let triples = (0..count).flat_map(|a| (0..count).map(move |b| (a, b)));
    for (a, b, c) in triples.flat_map(|(a, b)| (0..count).map(move |c| (a, b, c))) {
        if !(a < b && a < c && b != c) {
            continue;
        }
        let [p, q, r] = [a, b, c].map(|at| &points[at]);
        let mut others = (0..count).filter(|at| ![a, b, c].contains(at));
        if others.all(|d| orientation(&[p, q, r, &points[d]]).is_negative()) {
            let cross =
                |k: usize| q[(k + 1) % 3] * r[(k + 2) % 3] - q[(k + 2) % 3] * r[(k + 1) % 3];
            six += (0..3).map(|k| p[k] * cross(k)).sum::<f64>();
        }
    }
    six / 6.0
}

fn is_close(found: f64, expected: f64) -> bool {
    (found / expected - 1.0).abs() < 1e-12
}

/// Fails unless all vertices on the box are on subfacets, in whose planes they are exactly.
fn assert_on_sides(mesh: &Triangulation, [low, high]: [Point; 2]) {
    let mut is_on = vec![false; mesh.vertex_count()];
    for subfacet in &mesh.boundary.subfacets {
        let x = subfacet.map(|vertex| mesh.point(vertex));
        let has_side =
            |k: usize| [low[k], high[k]].iter().any(|end| x.iter().all(|x| x[k] == *end));
        assert!((0..3).any(has_side), "{x:?}");
        subfacet.iter().for_each(|&vertex| is_on[vertex as usize] = true);
    }
    for (vertex, is_on) in (0..).zip(is_on) {
        let x = mesh.point(vertex);
        let is_at_end = (0..3).any(|k| x[k] == low[k] || x[k] == high[k]);
        assert_eq!(is_on, is_at_end, "vertex {vertex} at {x:?}");
    }
}

#[test]
fn random_points_fill_their_box_and_their_hull() {
    for seed in 0..4 {
        let points = random(20 + 10 * seed as usize, seed);
        let mesh = run(&points, &within(Extent::Box, 2.0));
        assert!(is_close(volume(&mesh), box_volume(&points)));
        assert_on_sides(&mesh, ends(&points));
        assert!(mesh.boundary.forced.is_empty() && !mesh.precision_limited.contains(&true));
        assert_eq!(mesh.parameters.extent, Extent::Box);
        let hull = run(&points, &within(Extent::Hull, 2.0));
        assert!(is_close(volume(&hull), hull_volume(&points)));
        for mesh in [mesh, hull] {
            // Outside is before the sides.
            let sides = &mesh.boundary.subfacet_simplices;
            assert!(sides.iter().all(|&[before, behind]| before == NONE && behind != NONE));
            assert!(mesh.boundary.subfacet_parents.iter().all(|&parent| parent == NONE));
            assert!(mesh.boundary.parents.iter().all(|&parent| parent == NONE));
        }
    }
}

#[test]
fn a_box_has_corners_that_are_no_inputs() {
    // An octahedron touches the middles of the sides.
    let tips = (0..3).flat_map(|axis| [-1.0, 1.0].map(|x| (axis, x)));
    let points: Vec<Point> =
        tips.map(|(axis, x)| std::array::from_fn(|k| if k == axis { x } else { 0.0 })).collect();
    let mesh = run(&points, &within(Extent::Box, f64::INFINITY));
    assert_eq!(mesh.kinds.iter().filter(|&&kind| kind == VertexKind::Input).count(), 6);
    assert_eq!(mesh.vertex_count(), 14);
    assert!(is_close(volume(&mesh), 8.0));
    assert_on_sides(&mesh, [[-1.0; 3], [1.0; 3]]);
    // The outer cage surrounds the corners, of which some are far from all inputs.
    let turned: Vec<Point> = grid(5).into_iter().map(tilted).collect();
    let boxed = run(&turned, &within(Extent::Box, 2.0));
    assert!(is_close(volume(&boxed), box_volume(&turned)));
    let hull = run(&points, &within(Extent::Hull, 2.0));
    assert_eq!((hull.vertex_count(), hull.boundary.subfacets.len()), (6, 8));
    assert!(is_close(volume(&hull), 4.0 / 3.0));
}

#[test]
fn grids_need_no_vertices() {
    let points = grid(4);
    for extent in BOTH {
        let mesh = run(&points, &within(extent, 2.0));
        assert!(mesh.vertex_count() == 64 && is_close(volume(&mesh), 27.0));
        assert_on_sides(&mesh, [[0.0; 3], [3.0; 3]]);
        assert_eq!(mesh.boundary.subsegments.len(), 36);
    }
    // Points of planes that roundings make uneven are on six sides all the same.
    let turned: Vec<Point> = points.into_iter().map(tilted).collect();
    let mesh = run(&turned, &within(Extent::Hull, 2.0));
    assert!(mesh.vertex_count() == 64 && is_close(volume(&mesh), 27.0));
    assert_eq!(mesh.boundary.subsegments.len(), 36);
    assert_eq!(mesh.boundary.subfacets.len(), 108);
}

/// Returns points in a unit cube, most of them on its sides and edges, and its corners.
fn on_a_cube(count: usize, seed: u64) -> Vec<Point> {
    let mut points = random(count, seed);
    for (at, point) in points.iter_mut().enumerate().filter(|(at, _)| at % 4 > 0) {
        let end = |bit: usize| f64::from(u8::from(at >> bit & 1 == 1));
        point[at % 3] = end(3);
        if at % 4 == 1 {
            point[(at + 1) % 3] = end(4);
        }
    }
    points.extend(cuboid([0.0; 3], [1.0; 3]).points);
    points
}

#[test]
fn inputs_on_the_boundary_are_vertices_of_it() {
    for seed in 0..3 {
        let points = on_a_cube(40, seed);
        for extent in BOTH {
            let mesh = run(&points, &within(extent, 2.0));
            assert!(is_close(volume(&mesh), 1.0));
            assert_on_sides(&mesh, [[0.0; 3], [1.0; 3]]);
        }
    }
}

/// The sides of a hull are what the caller's own polygons would be.
#[test]
fn a_hull_is_meshed_as_its_sides_are() {
    for place in [|x: Point| x, tilted] {
        let mut points = on_a_cube(40, 5);
        points.rotate_right(8);
        let solid = Solid { points, ..cuboid([0.0; 3], [1.0; 3]) }.moved(place);
        let mut mesh = solid.mesh();
        mesh.run(&bounded(2.0), None).unwrap();
        let given = mesh.result().unwrap();
        let mut alone = Solid { polygons: Vec::new(), ..solid.clone() }.mesh();
        alone.run(&within(Extent::Hull, 2.0), None).unwrap();
        let hull = alone.result().unwrap();
        let bits =
            |mesh: &Triangulation| mesh.points.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(given), bits(hull));
        assert_eq!(given.simplices, hull.simplices);
    }
}

#[test]
fn points_within_roundings_of_a_side_are_on_it() {
    let mut points = on_a_cube(60, 9);
    for (at, point) in points.iter_mut().enumerate().filter(|(at, _)| at % 3 == 0) {
        let inwards =
            |x: f64| if x == 1.0 { x.next_down() } else { f64::from(at as u32 % 5) * 5e-324 };
        *point = point.map(|x| if x == 0.0 || x == 1.0 { inwards(x) } else { x });
    }
    points.truncate(60);
    points.extend(cuboid([0.0; 3], [1.0; 3]).points);
    for extent in BOTH {
        let mesh = run(&points, &within(extent, 2.0));
        assert!(is_close(volume(&mesh), 1.0));
        assert!(mesh.stats.near_inputs > 0 && mesh.vertex_count() < 2000);
    }
}

/// Near two edges a point is on neither, and stays inside.
#[test]
fn points_within_roundings_of_a_corner_stay_inside() {
    let ulp = f64::EPSILON;
    let mut points = cuboid([1.0; 3], [1.75; 3]).points;
    points.push([1.0 + ulp; 3]);
    points.push([1.5, 1.0 + ulp, 1.0 + ulp]);
    for extent in BOTH {
        let mesh = run(&points, &within(extent, f64::INFINITY));
        assert!(is_close(volume(&mesh), 0.75f64.powi(3)));
        assert_eq!(mesh.vertex_count(), 10);
        let on = mesh.boundary.subfacets.as_flattened();
        assert!(!on.contains(&8) && on.contains(&9));
    }
    // There is no room beside a point in a side.
    points.push([1.75 - ulp, 1.75 - ulp, 1.75]);
    for extent in BOTH {
        let (kind, message) = refusal(&points, &within(extent, f64::INFINITY));
        assert_eq!(kind, ErrorKind::Limit);
        let boundary = format!("the boundary of options.extent = Extent::{extent:?}");
        assert!(message.contains(&boundary), "{message}");
    }
}

#[test]
fn duplicates_count_once() {
    let mut points = on_a_cube(20, 3);
    let own = points.clone();
    points.extend(&own);
    points.push([-0.0; 3]);
    for extent in BOTH {
        let mesh = run(&points, &within(extent, 2.0));
        assert!(is_close(volume(&mesh), 1.0));
        assert_eq!(mesh.simplices, run(&own, &within(extent, 2.0)).simplices);
    }
}

#[test]
fn boxes_and_hulls_may_have_any_exponent() {
    for exponent in [-990, 990] {
        let scale = 2f64.powi(exponent);
        let points: Vec<Point> = random(6, 1).iter().map(|x| x.map(|x| x * scale)).collect();
        for extent in BOTH {
            let mesh = run(&points, &within(extent, f64::INFINITY));
            let unscaled = Triangulation {
                points: mesh.points.iter().map(|x| x / scale).collect(),
                ..mesh.clone()
            };
            let plain = random(6, 1);
            let expected = match extent {
                Extent::Box => box_volume(&plain),
                _ => hull_volume(&plain),
            };
            assert!(is_close(volume(&unscaled), expected), "2^{exponent}");
        }
    }
    // Axes of which each has its own.
    let apart = [1e-300, 1.0, 1e300];
    let points: Vec<Point> =
        random(6, 2).iter().map(|x| std::array::from_fn(|k| x[k] * apart[k])).collect();
    let mut mesh = Solid { points, ..Solid::default() }.mesh();
    for extent in BOTH {
        match mesh.run(&Options { max_vertices: 2000, ..within(extent, f64::INFINITY) }, None) {
            Ok(()) => assert_holds(&mesh),
            Err(error) => assert_eq!(error.kind(), ErrorKind::Limit),
        }
    }
}

/// Sides that are bent by less than counts at their longest edge may be bent by all that they are
/// high.
#[test]
fn hulls_of_points_of_several_scales_are_plane() {
    let points = [
        [-5e250, 3e-243, 1e-274],
        [-8e-175, -1.07e140, -2e-106],
        [1e-153, 1e-4, 2.75e141],
        [-1e11, -1.27e140, 0.0],
        [0.0; 3],
    ];
    run(&points, &within(Extent::Hull, f64::INFINITY));
}

/// Facets of the caller's within, on, and ending at the boundary.
#[test]
fn facets_of_the_caller_are_parts() {
    let outer = random(30, 4).into_iter().map(|x| x.map(|x| 4.0 * x - 2.0));
    let outer: Vec<Point> = outer.chain([[-2.0; 3], [2.0; 3]]).collect();
    let around = Solid { points: outer, ..Solid::default() };
    let cubes = [
        ("inside", [-0.5; 3], [0.5; 3], 0),
        ("on a side", [-0.5, -0.5, 1.0], [0.5, 0.5, 2.0], 1),
        ("at an edge", [1.0, -0.5, 1.0], [2.0, 0.5, 2.0], 2),
        ("in a corner", [1.0; 3], [2.0; 3], 3),
        ("from side to side", [-2.0, -0.5, -0.5], [2.0, 0.5, 0.5], 2),
        ("all of it", [-2.0; 3], [2.0; 3], 6),
    ];
    for (name, low, high, count) in cubes {
        let mut solid = cuboid(low, high).with(&around);
        let middle = std::array::from_fn(|k| 0.3 * low[k] + 0.7 * high[k]);
        solid.regions = vec![Region { seed: middle, label: 7, ..Region::default() }];
        let mesh = solid.run(&within(Extent::Box, 2.0));
        assert!(is_close(volume(&mesh), 64.0), "{name}");
        let of_facets = |facet: u32| {
            let parents =
                mesh.boundary.subfacet_parents.iter().zip(&mesh.boundary.subfacet_simplices);
            parents.filter(|(parent, _)| **parent == facet).any(|(_, sides)| sides.contains(&NONE))
        };
        assert_eq!((0..6).filter(|&facet| of_facets(facet)).count(), count, "{name}");
        let inner: f64 = (0..3).map(|k| high[k] - low[k]).product();
        let labelled = volume_of(&mesh, 7);
        assert!(is_close(labelled, inner), "{name}: {labelled}");
        // As a hole it is no part of the result.
        solid.regions[0].is_hole = true;
        if count < 6 {
            let mesh = solid.run(&within(Extent::Box, 2.0));
            assert!(is_close(volume(&mesh), 64.0 - inner), "{name}");
        }
    }
}

fn volume_of(mesh: &Triangulation, label: i32) -> f64 {
    let simplices = mesh.simplices.chunks_exact(4).zip(&mesh.boundary.simplex_regions);
    let own = simplices.filter(|(_, own)| **own == label).flat_map(|(simplex, _)| simplex);
    let part = Triangulation { simplices: own.copied().collect(), ..mesh.clone() };
    volume(&part)
}

#[test]
fn a_hull_has_facets_of_the_caller_on_its_sides() {
    // An L, whose hull has five of its eight sides' planes.
    let outline = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let points: Vec<Point> =
        [0.0, 1.0].iter().flat_map(|&z| outline.map(|[x, y]| [x, y, z])).collect();
    let mut polygons = vec![vec![5, 4, 3, 2, 1, 0], vec![6, 7, 8, 9, 10, 11]];
    polygons.extend((0..6).map(|at| vec![at, (at + 1) % 6, (at + 1) % 6 + 6, at + 6]));
    let solid = Solid { points, polygons, regions: Vec::new() };
    for place in [|x: Point| x, tilted] {
        let solid = solid.clone().moved(place);
        let mesh = solid.run(&within(Extent::Hull, 2.0));
        assert!(is_close(volume(&mesh), 3.5));
        let own = mesh.boundary.subfacet_parents.iter().filter(|&&parent| parent != NONE);
        assert!(own.count() >= 12 + 8);
        let boxed = solid.run(&within(Extent::Box, 3.0));
        assert!(is_close(volume(&boxed), box_volume(&solid.points)));
        // A surface of triangles is the same.
        let mut surface = Mesh::new(3, solid.points.len(), solid.points.as_flattened(), 0).unwrap();
        let fan = |polygon: &Vec<u32>| -> Vec<u32> {
            // The first vertex of each sees all of it.
            let mut own = polygon.clone();
            let tip = own.iter().position(|at| at % 6 == 3).unwrap_or(0);
            own.rotate_left(tip);
            (1..own.len() - 1).flat_map(|at| [own[0], own[at], own[at + 1]]).collect()
        };
        let triangles: Vec<u32> = solid.polygons.iter().flat_map(fan).collect();
        surface.set_triangles(&triangles, None).unwrap();
        surface.run(&within(Extent::Hull, 2.0), None).unwrap();
        assert_holds(&surface);
        assert!(is_close(volume(surface.result().unwrap()), 3.5));
    }
}

/// The ridge of a roof is no line where `coplanar` is larger than its angle: the facet is bent
/// there, and the domain has another volume than the hull, as much as that allows.
#[test]
fn facets_of_the_caller_on_a_hull_may_be_bent() {
    let mut points: Vec<Point> = (0..8)
        .map(|at| [f64::from(2 * (at & 1)), f64::from(at >> 1 & 1), f64::from(at >> 2)])
        .collect();
    points.extend([[0.93, 0.0, 1.01], [1.1, 1.0, 1.01]]);
    let hull = run(&points, &within(Extent::Hull, f64::INFINITY));
    let mut mesh = Mesh::new(3, points.len(), points.as_flattened(), 0).unwrap();
    mesh.set_triangles(hull.boundary.subfacets.as_flattened(), None).unwrap();
    let angles = [0.0, 5.0].map(|coplanar| {
        let options = Options { coplanar, max_edge: 0.3, ..within(Extent::Hull, 1.5) };
        mesh.run(&options, None).unwrap();
        assert_holds(&mesh);
        volume(mesh.triangulation().unwrap())
    });
    assert!(is_close(angles[0], volume(&hull)), "{angles:?}");
    assert!((1e-9..0.02).contains(&(angles[0] - angles[1]).abs()), "{angles:?}");
}

#[test]
fn walls_and_segments_end_at_the_boundary() {
    let mut solid = Solid { points: on_a_cube(30, 8), ..Solid::default() };
    let first = solid.points.len() as u32;
    solid.points.extend([[0.5, 0.0, 0.0], [0.5, 1.0, 0.0], [0.5, 1.0, 1.0], [0.5, 0.0, 1.0]]);
    solid.polygons = vec![(first..first + 4).collect()];
    let region = |x: f64, label| Region { seed: [x, 0.51, 0.52], label, ..Region::default() };
    solid.regions = vec![region(0.2, 1), region(0.8, 2)];
    for extent in BOTH {
        let mesh = solid.run(&within(extent, 2.0));
        assert!(is_close(volume(&mesh), 1.0));
        for label in [1, 2] {
            assert!(is_close(volume_of(&mesh, label), 0.5));
        }
    }
    // Along an edge, in a side, across from one to another, and within.
    solid.polygons.clear();
    solid.regions.clear();
    let segments = [first - 8, first, first, first + 2, first + 1, 0, first + 3, first - 4];
    let mut mesh = solid.mesh();
    mesh.set_segments(&segments, None).unwrap();
    for extent in BOTH {
        mesh.run(&within(extent, 2.0), None).unwrap();
        assert_holds(&mesh);
        let made = mesh.result().unwrap();
        assert!(is_close(volume(made), 1.0));
        for segment in 0..4 {
            assert!(made.boundary.parents.contains(&segment), "{segment}");
        }
    }
}

fn refusal(points: &[Point], options: &Options) -> (ErrorKind, String) {
    let error = Solid { points: points.to_vec(), ..Solid::default() }
        .mesh()
        .run(options, None)
        .unwrap_err();
    (error.kind(), error.message().to_owned())
}

#[test]
fn what_has_no_volume_is_refused() {
    let flat: Vec<Point> = grid(3).into_iter().map(|[x, y, _]| [x, y, 0.5]).collect();
    let line: Vec<Point> = (0..9).map(|at| [f64::from(at); 3]).collect();
    let turned: Vec<Point> = flat.iter().map(|&x| tilted(x)).collect();
    let none = [
        (Extent::Box, &flat),
        (Extent::Hull, &flat),
        (Extent::Hull, &line),
        (Extent::Hull, &turned),
    ];
    for (extent, points) in none {
        let (kind, message) = refusal(points, &within(extent, 2.0));
        assert_eq!(kind, ErrorKind::DegenerateInput);
        let rule = "has no volume: all inputs are in a plane, but for roundings";
        assert_eq!(message, format!("options.extent = Extent::{extent:?} {rule}"));
    }
    for points in [&line, &turned] {
        let mesh = run(points, &within(Extent::Box, f64::INFINITY));
        assert!(is_close(volume(&mesh), box_volume(points)));
    }
}

#[test]
fn what_does_not_go_with_an_extent_is_refused_by_name() {
    let points = random(8, 6);
    for extent in BOTH {
        let plain = within(extent, 0.0);
        let name = format!("options.extent = Extent::{extent:?}");
        let (_, ratio) = refusal(&points, &Options { distance_ratio: 0.5, ..plain.clone() });
        assert_eq!(ratio, format!("options.distance_ratio is 0.5; it must be 0 with {name}"));
        let aspect = Options { extent, quality_bound: 5.0, ..Options::default() };
        let (_, message) = refusal(&points, &aspect);
        assert!(message.contains(&format!("with {name} it must be 0, or go with")), "{message}");
        let svr = Options { algorithm: Algorithm::Svr, ..plain.clone() };
        assert!(refusal(&points, &svr).1.contains("hull or box"));
        let mut mesh = Solid { points: points.clone(), ..Solid::default() }.mesh();
        mesh.set_regions(&[Region { seed: [9.0; 3], ..Region::default() }]).unwrap();
        let message = mesh.run(&plain, None).unwrap_err().message().to_owned();
        assert!(message.contains("beyond the boundary"), "{message}");
        let mut space = Mesh::new(4, 2, &[0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0], 0).unwrap();
        let message = space.run(&plain, None).unwrap_err().message().to_owned();
        assert_eq!(message, format!("{name} is for 2D and 3D; the mesh has dimension 4"));
    }
}
