//! Small angles of the input, and features that are near each other.

use super::crossings::run;
use super::{Point, Solid, assert_holds, assert_none_excused, bounded, cuboid, volume};
use netmesh::{Extent, Mesh, Options};
use std::collections::BTreeMap;

/// Returns the prism over a triangle with the given angle, in degrees.
pub fn wedge(degrees: f64) -> Solid {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    let triangle = |z: f64| [[0.0, 0.0, z], [1.0, 0.0, z], [cosine, sine, z]];
    Solid {
        points: [triangle(0.0), triangle(1.0)].concat(),
        polygons: vec![
            vec![0, 2, 1],
            vec![3, 4, 5],
            vec![0, 1, 4, 3],
            vec![1, 2, 5, 4],
            vec![2, 0, 3, 5],
        ],
        regions: Vec::new(),
    }
}

#[test]
fn wedges_of_any_angle_conform_with_their_inputs() {
    for degrees in [30.0, 5.0, 1.0, 0.1, 1e-3, 1e-5] {
        let mesh = wedge(degrees).run(&bounded(f64::INFINITY));
        assert_eq!((mesh.vertex_count(), mesh.simplex_count()), (6, 3), "{degrees}");
    }
}

#[test]
fn refinement_of_wedges_ends() {
    for degrees in [30.0, 5.0, 1.0, 0.1, 1e-3] {
        let mesh = wedge(degrees).run(&bounded(2.0));
        assert!(mesh.vertex_count() <= 100, "{degrees}: {} vertices", mesh.vertex_count());
        let whole = 0.5 * degrees.to_radians().sin();
        assert!((volume(&mesh) / whole - 1.0).abs() < 1e-9);
    }
}

/// Returns a tetrahedron with an edge of length 1 at which two sides meet at an angle in degrees;
/// their third corners are as far along the edge as `along` says.
fn fold(degrees: f64, along: [f64; 2]) -> Solid {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    Solid {
        points: vec![[0.0; 3], [1.0, 0.0, 0.0], [along[0], 1.0, 0.0], [along[1], cosine, sine]],
        polygons: vec![vec![0, 2, 1], vec![0, 1, 3], vec![1, 2, 3], vec![0, 3, 2]],
        regions: Vec::new(),
    }
}

/// Returns the number of vertices of a solid in a large box, with inputs beside one of its sides,
/// all of the box with a radius-edge ratio of 2.
fn vertices_in_box(mut solid: Solid) -> usize {
    solid.points.extend([[-6.0; 3], [8.0; 3]]);
    solid.points.extend((0..5).map(|at| {
        let at = f64::from(at);
        [0.3 + 0.08 * at, 2e-3 + 3e-3 * at, -5e-4 - 1e-4 * at]
    }));
    let mut mesh = solid.mesh();
    let limit = Options { extent: Extent::Box, max_vertices: 20_000, ..bounded(2.0) };
    mesh.run(&limit, None).unwrap_or_else(|error| panic!("{error}"));
    assert_holds(&mesh);
    mesh.result().unwrap().vertex_count()
}

/// Split at the centres of circles, the sides of a wedge were split for each other without an end.
#[test]
fn both_sides_of_a_wedge_are_split_alike() {
    for degrees in [30.0, 5.0, 1.0, 0.1, 1e-3] {
        let count = vertices_in_box(wedge(degrees));
        assert!(count <= 1000, "{degrees}: {count} vertices");
    }
}

/// The angle at an edge is that between the planes there, wherever the third corners are.
#[test]
fn sides_whose_corners_are_beyond_their_edge_meet_at_its_angle() {
    for (along, most) in [([0.5; 2], 1000), ([5.0; 2], 1000), ([3.0, -2.0], 6000)] {
        let count = vertices_in_box(fold(5.0, along));
        assert!(count <= most, "{along:?}: {count} vertices");
    }
}

/// A facet that reaches round another one is seen from where they meet at a small angle, though
/// none is there: no simplex is excused.
#[test]
fn facets_that_meet_at_a_vertex_have_the_angle_that_they_have_there() {
    let reaching = [
        [1.0, 0.0],
        [1.0, -1.0],
        [4.0, -1.0],
        [4.0, 3.0],
        [1.0, 3.0],
        [1.0, 2.0],
        [2.2, 2.6],
        [3.0, 2.0],
        [3.0, 0.0],
        [2.2, -0.6],
    ];
    let plane = reaching.into_iter().chain([[0.0, 0.0], [0.0, 2.0]]).map(|[x, y]| [x, y, 0.0]);
    let solid = Solid {
        points: plane.chain([[-4.0; 3], [8.0; 3]]).collect(),
        polygons: vec![(0..10).collect(), vec![10, 0, 5, 11]],
        regions: Vec::new(),
    };
    let mut mesh = solid.mesh();
    mesh.run(&Options { extent: Extent::Box, ..bounded(2.0) }, None).unwrap();
    assert_holds(&mesh);
    assert_none_excused(mesh.result().unwrap());
}

/// Returns three triangles that meet at a vertex, two of them also in an edge, 1 to 6 degrees from
/// each other.
fn fins() -> Solid {
    let (shared, beside) = ([0.8696, 0.4858, -0.088], [0.8669, 0.49, -0.072]);
    let tips = [[0.0, 0.999, -0.045], [0.0, 0.9949, -0.1005], [0.0, 1.0, 0.0]];
    Solid {
        points: [vec![[0.0; 3], shared, beside], tips.to_vec()].concat(),
        polygons: vec![vec![0, 3, 1], vec![0, 4, 1], vec![0, 5, 2]],
        regions: Vec::new(),
    }
}

/// Vertices in such facets, on no sphere about the vertex, asked for others ever nearer to it, down
/// to where doubles end.
#[test]
fn fins_are_not_split_down_to_the_vertex_where_they_meet() {
    for scale in [1.0, 2f64.powi(-300)] {
        let mut mesh = fins().moved(|x| x.map(|x| scale * x)).mesh();
        let limit = Options { extent: Extent::Box, max_vertices: 20_000, ..bounded(2.0) };
        mesh.run(&limit, None).unwrap_or_else(|error| panic!("{error}"));
        assert_holds(&mesh);
        let mesh = mesh.result().unwrap();
        let points = (0..mesh.vertex_count()).map(|vertex| mesh.point(vertex as u32));
        let lengths =
            points.map(|x| x.iter().map(|x| (x / scale) * (x / scale)).sum::<f64>().sqrt());
        let nearest = lengths.filter(|length| *length > 0.0).fold(f64::INFINITY, f64::min);
        assert!(nearest > 1e-3, "{nearest}");
        assert!(mesh.vertex_count() < 6000, "{} vertices", mesh.vertex_count());
    }
}

/// Needles from a small ring to a slanted one: at each vertex some are at a tiny angle that have
/// another between them. Vertices got balls for that, and there were 489 vertices instead of 279.
#[test]
fn needles_of_a_fan_are_no_fins() {
    const COUNT: u32 = 16;
    let ring = |at: u32, turn: f64| {
        let angle = std::f64::consts::TAU * (f64::from(at) + turn) / f64::from(COUNT);
        [angle.cos(), angle.sin()]
    };
    let bottom = (0..COUNT).map(|at| ring(at, 0.0)).map(|[c, s]| [0.02 * c, 0.02 * s, 0.0]);
    let top = (0..COUNT).map(|at| ring(at, 0.5));
    let top = top.map(|[c, s]| [1.0 + 0.3 * c, 0.3 * s, 3.0 + 0.1 * c]);
    let sides = (0..COUNT).flat_map(|at| {
        let next = (at + 1) % COUNT;
        [vec![at, next, COUNT + at], vec![next, COUNT + next, COUNT + at]]
    });
    let ends = [(0..COUNT).rev().collect(), (COUNT..2 * COUNT).collect()];
    let solid = Solid {
        points: bottom.chain(top).collect(),
        polygons: sides.chain(ends).collect(),
        regions: Vec::new(),
    };
    let mut mesh = solid.mesh();
    mesh.run(&bounded(2.0), None).unwrap();
    assert_holds(&mesh);
    let count = mesh.result().unwrap().vertex_count();
    assert!(count < 340, "{count} vertices");
}

/// Two such facets meet where a side of the box is near: a ball about the vertex that reached
/// beyond the side had arcs of facets split without an end.
#[test]
fn fins_beside_a_side_are_not_split_without_an_end() {
    let solid = Solid {
        points: vec![
            [0.0; 3],
            [1.125801098714316, -0.14427798042896908, -0.02912471254119858],
            [0.33224420451011594, 1.2481881222285993, -0.0371705340317025],
            [0.6503088160931044, 0.0710306158182703, 0.0020098168682896366],
            [0.2533925868289063, 1.2697945288829975, -0.019907295989656428],
        ],
        polygons: vec![vec![0, 1, 2], vec![0, 3, 4]],
        regions: Vec::new(),
    };
    let mut mesh = solid.mesh();
    let limit = Options { extent: Extent::Box, max_vertices: 5000, ..bounded(2.0) };
    mesh.run(&limit, None).unwrap_or_else(|error| panic!("{error}"));
    assert_holds(&mesh);
}

/// Returns an octahedron of which all triangles were divided into four so many times, with all
/// vertices on a sphere.
fn round_body(times: u32) -> (Vec<Point>, Vec<[u32; 3]>) {
    let (x, y, z) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    let mut points: Vec<Point> = [x, y, z].into_iter().flat_map(|x| [x, x.map(|x| -x)]).collect();
    let mut triangles: Vec<[u32; 3]> = Vec::new();
    for [i, j, k] in [[0, 2, 4], [1, 3, 4], [1, 2, 5], [0, 3, 5]] {
        triangles.extend([[i, j, k], [i ^ 1, k, j]]);
    }
    for _ in 0..times {
        let mut middles = BTreeMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                let [a, b] = [a, b].map(|end| points[end as usize]);
                let sum: Point = std::array::from_fn(|k| a[k] + b[k]);
                let length = sum.iter().map(|x| x * x).sum::<f64>().sqrt();
                points.push(sum.map(|x| x / length));
                points.len() as u32 - 1
            })
        };
        let divided = triangles.iter().flat_map(|&[a, b, c]| {
            let [d, e, f] = [middle(a, b), middle(b, c), middle(c, a)];
            [[a, d, f], [d, b, e], [f, e, c], [d, e, f]]
        });
        triangles = divided.collect();
    }
    (points, triangles)
}

/// The triangles of round bodies have angles of some 60 degrees, which force nothing.
#[test]
fn round_bodies_keep_the_bound() {
    let (points, triangles) = round_body(4);
    let mesh = run(&points, &triangles, &bounded(2.0));
    assert_none_excused(&mesh);
    assert!(mesh.vertex_count() < points.len() * 5 / 4, "{} vertices", mesh.vertex_count());
}

/// Roundings of a plane that is no axis' are some 1e-7 of the smallest gap.
#[test]
fn boxes_with_a_narrow_gap_stay_coarse() {
    for (gap, most) in [(1e-3, 60), (1e-6, 60), (1e-9, 1000)] {
        let other = cuboid([0.3, 0.3, 1.0 + gap], [0.7, 0.8, 1.6]);
        let both = cuboid([0.0; 3], [1.0; 3]).with(&other);
        for solid in [both.clone(), both.moved(super::tilted)] {
            let mesh = solid.run(&bounded(2.0));
            assert!(mesh.vertex_count() <= most, "{gap}: {} vertices", mesh.vertex_count());
        }
    }
}

/// Returns a unit cube with a further vertex beside an edge, `part` of the way along it, for a
/// needle of that height.
fn cube_with_needle(height: f64, part: f64) -> Solid {
    let mut solid = cuboid([0.0; 3], [1.0; 3]);
    let [x, y, z] = [part, -0.6 * height, 1.0 + 0.8 * height];
    solid.points.push([x, y, z]);
    let at = |place: [f64; 3]| solid.points.iter().position(|&x| x == place).unwrap() as u32;
    let corner = |x: u8, y: u8, z: u8| at([x, y, z].map(f64::from));
    let [a, b] = [corner(0, 0, 1), corner(1, 0, 1)];
    let [c, d] = [corner(1, 0, 0), corner(0, 0, 0)];
    let apex = 8;
    let is_front = |polygon: &Vec<u32>| [a, b, c, d].iter().all(|corner| polygon.contains(corner));
    solid.polygons.retain(|polygon| !is_front(polygon));
    let own = [[d, c, apex], [c, b, apex], [a, d, apex], [a, apex, b]];
    solid.polygons.extend(own.map(Vec::from));
    solid
}

#[test]
fn sides_of_needles_are_split_opposite_each_other() {
    for height in [1e-3, 1e-5, 1e-7] {
        for part in [0.8, 0.55, 0.3] {
            let mesh = cube_with_needle(height, part).run(&bounded(2.0));
            assert!(mesh.vertex_count() <= 20, "{height} {part}: {}", mesh.vertex_count());
        }
    }
}

#[test]
fn thin_slabs_conform_with_their_corners() {
    for thickness in [1e-3, 1e-6, 1e-9, 1e-12] {
        let mesh = cuboid([0.0; 3], [1.0, 1.0, thickness]).run(&bounded(f64::INFINITY));
        assert_eq!(mesh.vertex_count(), 8, "{thickness}");
    }
}

#[test]
fn facets_about_a_segment_meet_it_in_any_number() {
    for count in [3, 8, 64] {
        let mut solid = Solid::default();
        let place = |at: u32, z: f64| {
            let angle = std::f64::consts::TAU * f64::from(at) / f64::from(count);
            [angle.cos(), angle.sin(), z]
        };
        solid.points = vec![[0.0; 3], [0.0, 0.0, 1.0]];
        solid.points.extend((0..count).flat_map(|at| [place(at, 0.0), place(at, 1.0)]));
        for at in 0..count {
            let [low, next] = [at, (at + 1) % count].map(|at| 2 + 2 * at);
            solid.polygons.push(vec![0, low, low + 1, 1]);
            solid.polygons.push(vec![low, next, next + 1, low + 1]);
            solid.polygons.push(vec![0, next, low]);
            solid.polygons.push(vec![1, low + 1, next + 1]);
        }
        let mesh = solid.run(&bounded(f64::INFINITY));
        assert_eq!(mesh.vertex_count(), 2 + 2 * count as usize);
        solid.run(&bounded(2.0));
    }
}

/// Schönhardt's prism has no triangulation of its vertices.
#[test]
fn a_twisted_prism_gets_vertices() {
    for turn in [30.0f64, 1e-3] {
        let ring = |turn: f64, z: f64| {
            [0.0f64, 120.0, 240.0].map(|angle| {
                let (sine, cosine) = (angle + turn).to_radians().sin_cos();
                [cosine, sine, z]
            })
        };
        let points = [ring(0.0, 0.0), ring(60.0 - turn, 1.0)].concat();
        let polygons = vec![vec![0, 2, 1], vec![3, 4, 5]];
        let mut solid = Solid { points, polygons, regions: Vec::new() };
        for i in 0..3u32 {
            let j = (i + 1) % 3;
            solid.polygons.push(vec![i, j, 3 + i]);
            solid.polygons.push(vec![j, 3 + j, 3 + i]);
        }
        let mesh = solid.run(&bounded(f64::INFINITY));
        assert!(mesh.vertex_count() <= 20, "{turn}: {}", mesh.vertex_count());
    }
}

/// Tetrahedra all round an edge that they share, whose outer edges leave its ends at different
/// angles. A vertex on one of their sides is off the next one by almost half its distance from the
/// edge, and more from those behind; each of these has it where all have copies of all others'
/// vertices.
#[test]
fn sides_of_many_tetrahedra_about_an_edge_are_copies_of_each_other() {
    for (count, most) in [(13, 15), (14, 180), (24, 400)] {
        let corner = |k: usize| {
            let (sine, cosine) = (std::f64::consts::TAU * k as f64 / count as f64).sin_cos();
            [cosine, sine, [0.5, 0.8, 0.5, 0.2][k % 4]]
        };
        let ends = [[0.0; 3], [0.0, 0.0, 1.0]];
        let points = ends.into_iter().chain((0..count).map(corner)).collect();
        let polygons = (0..count as u32).flat_map(|k| {
            let [a, b] = [k, (k + 1) % count as u32].map(|k| 2 + k);
            [vec![0, 1, a], vec![0, b, a], vec![1, a, b]]
        });
        let solid = Solid { points, polygons: polygons.collect(), regions: Vec::new() };
        let limited = Options { max_vertices: 4_000, ..bounded(f64::INFINITY) };
        let mesh = solid.run(&limited);
        assert!(mesh.vertex_count() <= most, "{count}: {}", mesh.vertex_count());
    }
}

/// A domain that is far larger than what is in it costs no more at any scale.
#[test]
fn nested_boxes_conform_at_any_ratio() {
    let mut counts = Vec::new();
    for ratio in [2f64.powi(-10), 2f64.powi(-200), 2f64.powi(-900)] {
        let inner = cuboid([-ratio; 3], [ratio; 3]);
        let mesh = cuboid([-1.0; 3], [1.0; 3]).with(&inner).run(&bounded(f64::INFINITY));
        counts.push(mesh.vertex_count());
    }
    assert_eq!(counts, [16; 3]);
}

/// Two tetrahedra that meet at a vertex alone, with sides 4.6 degrees from each other there: what
/// each of these needs to be in the mesh asks the other for more, ever nearer to the vertex.
#[test]
fn sides_that_meet_at_a_vertex_alone_are_not_split_down_to_it() {
    let points = vec![
        [0.0, 0.0, 0.0],
        [1.0, -0.6, 0.0],
        [1.0, 0.6, 0.0],
        [1.0, 0.0, -0.5],
        [1.1073302252951198, -0.3569534691598735, 0.08002495237480871],
        [0.8337571970528939, 0.8114462048465763, 0.08002495237480871],
        [0.9315849077293784, 0.2181244226116362, 0.578421382688422],
    ];
    let tetrahedron = [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]];
    let at = |vertex: u32, first: u32| if vertex == 0 { 0 } else { vertex + first };
    let polygons = [0, 3]
        .iter()
        .flat_map(|&first| tetrahedron.map(|side| side.map(|vertex| at(vertex, first)).to_vec()));
    let solid = Solid { points, polygons: polygons.collect(), regions: Vec::new() };
    let mesh = solid.run(&Options { extent: Extent::Box, ..bounded(2.0) });
    assert!(mesh.vertex_count() < 1000, "{}", mesh.vertex_count());
}

/// The sides of a low cone are one facet that bends up to its apex. The base has vertices on the
/// plane of that, but not on it: simplices between both are forced, and not flat.
#[test]
fn simplices_between_a_bent_facet_and_a_plane_one_are_forced() {
    let rim = [[5.0, 0.0], [2.5, 4.25], [-2.5, 4.25], [-1.0, 0.0], [-1.25, -2.25], [1.0, -1.75]];
    for height in [1e-3, 1e-10, 2f64.powi(-42)] {
        let mut points: Vec<Point> = rim.map(|[x, y]| [x, y, 0.0]).to_vec();
        points.extend([[0.0; 3], [0.0, 0.0, height]]);
        let sides = (0..6u32).flat_map(|at| [[at, (at + 1) % 6, 7], [(at + 1) % 6, at, 6]]);
        let triangles: Vec<u32> = sides.flatten().collect();
        let mut mesh = Mesh::new(3, points.len(), points.as_flattened(), 0).unwrap();
        mesh.set_triangles(&triangles, None).unwrap();
        mesh.run(&Options { coplanar: 0.5, ..bounded(3.0) }, None).unwrap();
        assert_holds(&mesh);
        let boundary = &mesh.result().unwrap().boundary;
        assert_eq!((boundary.forced.len(), boundary.flat.len()), (6, 0), "{height}");
    }
}

/// Sizes ask for splits also where the guard of small angles lets none be: a run with sizes ends,
/// and keeps them.
#[test]
fn sizes_are_kept_beside_small_angles() {
    for degrees in [30.0, 12.0] {
        let mesh = wedge(degrees).run(&Options { max_edge: 0.15, ..bounded(2.0) });
        assert!(mesh.vertex_count() < 20_000, "{}", mesh.vertex_count());
        assert!(!mesh.precision_limited.contains(&true));
    }
}
