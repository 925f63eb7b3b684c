//! Components of another scale stand in cages where output is hierarchical, and cost the same at
//! any scale. A facet or segment that leads out of one, or passes near it, leaves no cage.

use super::angles::wedge;
use super::{Point, Solid, assert_holds, assert_none_excused, bounded, cuboid, volume};
use netmesh::options::{Extent, Options, Output};
use netmesh::{NONE, Region, Triangulation, VertexKind};

/// Returns the options of a hierarchical mesh with a bound of the radius-edge ratio of 2.
fn hierarchical() -> Options {
    Options { output: Output::Hierarchical, ..bounded(2.0) }
}

/// Returns a cube whose sides are two long.
fn cube() -> Solid {
    cuboid([-1.0; 3], [1.0; 3])
}

/// Returns a cube about a place, as small as 2 to the power of `exponent`.
fn small(exponent: i32, place: Point) -> Solid {
    let scale = 2f64.powi(exponent);
    cube().moved(|x| std::array::from_fn(|axis| place[axis] + scale * x[axis]))
}

/// Returns an icosahedron about the centre, which is as round as a ball of 20 triangles can be.
fn icosahedron(scale: f64) -> Solid {
    let golden = 0.5 + 1.25f64.sqrt();
    let corner = |k: usize| {
        let (one, other) =
            (if k & 1 == 0 { 1.0 } else { -1.0 }, if k & 2 == 0 { golden } else { -golden });
        let mut x = [0.0; 3];
        (x[k / 4], x[(k / 4 + 1) % 3]) = (scale * one, scale * other);
        x
    };
    let points: Vec<Point> = (0..12).map(corner).collect();
    let is_edge = |a: usize, b: usize| {
        let square: f64 = (0..3).map(|k| ((points[a][k] - points[b][k]) / scale).powi(2)).sum();
        square < 4.5
    };
    let mut polygons = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            let sides = (b + 1..12).filter(|&c| is_edge(a, b) && is_edge(b, c) && is_edge(c, a));
            polygons.extend(sides.map(|c| [a, b, c].map(|at| at as u32).to_vec()));
        }
    }
    Solid { points, polygons, regions: Vec::new() }
}

/// Returns a cube with smaller ones about its centre.
fn nested(exponents: &[i32]) -> Solid {
    exponents.iter().fold(cube(), |solid, &exponent| solid.with(&small(exponent, [0.0; 3])))
}

/// Returns a square inside the cube, at a height.
fn wall(z: f64) -> Solid {
    Solid {
        points: vec![[-0.5, -0.5, z], [0.5, -0.5, z], [0.5, 0.5, z], [-0.5, 0.5, z]],
        polygons: vec![vec![0, 1, 2, 3]],
        regions: Vec::new(),
    }
}

/// Fails if a mesh is not the one without cages.
fn assert_as_without_cages(solid: &Solid) {
    let [hierarchical, plain] = [hierarchical(), bounded(2.0)].map(|options| solid.run(&options));
    assert_eq!(hierarchical.domains.len(), 1);
    assert_same(&hierarchical, &plain);
}

/// Fails if two meshes differ, and does not print them.
fn assert_same(one: &Triangulation, other: &Triangulation) {
    let counts = [one, other].map(Triangulation::vertex_count);
    assert!(one.points == other.points && one.simplices == other.simplices, "{counts:?} vertices");
}

fn count(mesh: &Triangulation, kind: VertexKind) -> usize {
    mesh.kinds.iter().filter(|&&own| own == kind).count()
}

#[test]
fn a_component_in_a_cage_costs_the_same_at_every_scale() {
    for exponent in [-6, -10, -20, -60, -200, -500, -900] {
        let mesh = nested(&[exponent]).run(&hierarchical());
        assert_eq!(mesh.domains.len(), 2, "2^{exponent}");
        assert!(mesh.vertex_count() <= 31, "2^{exponent}: {} vertices", mesh.vertex_count());
        assert_none_excused(&mesh);
        assert_eq!(volume(&mesh), 8.0);
    }
    for exponent in [-10, -60, -900] {
        let mesh = cube().with(&icosahedron(2f64.powi(exponent))).run(&hierarchical());
        assert_eq!(mesh.domains.len(), 2, "2^{exponent}");
        assert!(mesh.vertex_count() <= 48, "2^{exponent}: {} vertices", mesh.vertex_count());
        assert_none_excused(&mesh);
    }
    // Each power of two between costs some vertices without a cage.
    assert!(nested(&[-20]).run(&bounded(2.0)).vertex_count() > 200);
}

#[test]
fn components_in_components_have_cages_in_cages() {
    let parents = |exponents: &[i32]| {
        let mesh = nested(exponents).run(&hierarchical());
        assert_none_excused(&mesh);
        mesh.domains.iter().map(|domain| domain.parent).collect::<Vec<_>>()
    };
    assert_eq!(parents(&[-60, -20, -40]), [NONE, 0, 1, 2]);
    // There is too little room for a cage.
    assert_eq!(parents(&[-3]), [NONE]);
    let chain: Vec<i32> = (1..=30).map(|step| -30 * step).collect();
    let mesh = nested(&chain).run(&hierarchical());
    assert_eq!(mesh.domains.len(), 31);
    assert!(mesh.vertex_count() <= 31 * 31, "{} vertices", mesh.vertex_count());
}

#[test]
fn components_beside_each_other_have_cages_of_their_own() {
    let places = [[0.3, 0.2, 0.1], [-0.4, 0.5, -0.2], [0.1, -0.6, 0.4]];
    let exponents = [-20, -40, -30];
    let all = places.into_iter().zip(exponents);
    let solid = all.fold(cube(), |solid, (place, exponent)| solid.with(&small(exponent, place)));
    let mesh = solid.run(&hierarchical());
    assert_eq!(
        mesh.domains.iter().map(|domain| domain.parent).collect::<Vec<_>>(),
        [NONE, 0, 0, 0]
    );
    assert_none_excused(&mesh);
    assert!(mesh.vertex_count() < 150, "{} vertices", mesh.vertex_count());
    for threads in [2, 3] {
        let same = solid.run(&Options { threads, ..hierarchical() });
        assert_same(&same, &mesh);
        assert_eq!((&same.domains, &same.cage_of), (&mesh.domains, &mesh.cage_of));
    }
}

/// The points of a cluster have domains of their own, and those on a facet have none.
#[test]
fn clusters_of_points_have_cages_where_no_facet_holds_them() {
    let cluster = |height: f64, scale: f64| {
        let mut solid = cube();
        solid.points.extend((0..12).map(|k| {
            let at = f64::from(k);
            [0.2 + scale * at.sin(), 0.1 + scale * (2.0 * at).cos(), height]
        }));
        solid
    };
    let scale = 2f64.powi(-30);
    let inside = cluster(0.3, scale).run(&hierarchical());
    assert!(inside.domains.len() > 1 && inside.vertex_count() < 150);
    for times in [0.0, 1.0, 6.0] {
        assert_as_without_cages(&cluster(1.0 - times * scale, scale));
    }
}

#[test]
fn a_facet_out_of_a_component_leaves_no_cage() {
    let mut solid = nested(&[-20]);
    solid.polygons.push(vec![8, 0, 1]);
    assert_as_without_cages(&solid);
}

/// Returns the mesh of a cube and segments, whose certificate holds.
fn with_segments(solid: &Solid, segments: &[u32], options: &Options) -> Triangulation {
    let mut mesh = solid.mesh();
    mesh.set_segments(segments, None).unwrap();
    mesh.run(options, None).unwrap();
    assert_holds(&mesh);
    mesh.result().unwrap().clone()
}

#[test]
fn a_segment_out_of_a_component_leaves_no_cage() {
    let solid = nested(&[-20]);
    for (segment, domains) in [([8, 0], 1), ([3, 11], 1), ([8, 15], 2)] {
        let mesh = with_segments(&solid, &segment, &hierarchical());
        assert_eq!(mesh.domains.len(), domains, "{segment:?}");
    }
}

/// A segment that passes a component has its ends far from it.
#[test]
fn a_segment_that_passes_near_a_component_leaves_no_cage() {
    let scale = 2f64.powi(-20);
    for (times, has_cage) in [(3.0, false), (7.0, false), (9.0, false), (11.0, false), (64.0, true)]
    {
        for (axis, side) in [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0), (2, 1.0), (2, -1.0)] {
            let mut solid = nested(&[-20]);
            solid.points.extend([-0.6, 0.7].map(|along| {
                let mut x = [0.0; 3];
                (x[axis], x[(axis + 1) % 3]) = (side * times * scale, along);
                x
            }));
            let mesh = with_segments(&solid, &[16, 17], &hierarchical());
            assert_eq!(mesh.domains.len(), 1 + usize::from(has_cage), "{times} {axis} {side}");
            if !has_cage {
                let plain = with_segments(&solid, &[16, 17], &bounded(2.0));
                assert_same(&mesh, &plain);
            }
        }
    }
}

/// A facet that passes a component has its own vertices far from it.
#[test]
fn a_facet_that_passes_near_a_component_leaves_no_cage() {
    let scale = 2f64.powi(-20);
    let passed = |times: f64| nested(&[-20]).with(&wall(times * scale));
    for times in [1.5, 4.0, 9.0] {
        assert_as_without_cages(&passed(times));
    }
    let far = passed(1024.0);
    let (mesh, plain) = (far.run(&hierarchical()), far.run(&bounded(2.0)));
    assert_eq!(mesh.domains.len(), 2);
    assert!(mesh.vertex_count() < 3 * plain.vertex_count() / 4);
}

/// Vertices of the cage would be exactly in the plane of the facet.
#[test]
fn a_facet_in_the_plane_of_a_centre_leaves_no_cage() {
    let scale = 2f64.powi(-20);
    for level in [-scale, scale] {
        let beside = wall(level).moved(|[x, y, z]| [if x < 0.0 { 2.5 * scale } else { x }, y, z]);
        for turn in 0..3 {
            let turned = beside.clone().moved(|x| [0, 1, 2].map(|axis| x[(axis + turn) % 3]));
            assert_as_without_cages(&nested(&[-20]).with(&turned));
        }
    }
}

/// Regions are found through the gap between a cage and what is around it.
#[test]
fn regions_and_holes_are_those_between_facets() {
    let scale = 2f64.powi(-20);
    let region = |seed: Point, label: i32, is_hole: bool| Region {
        seed,
        label,
        is_hole,
        ..Region::default()
    };
    let solid = small(-20, [0.25, 0.0, 0.0]).with(&cube());
    for (is_hole, least) in [(false, 8.0), (true, 8.0 - 8.0 * scale.powi(3))] {
        let mut own = solid.clone();
        // One seed is between the component and its cage.
        own.regions = vec![
            region([0.25 + 1.5 * scale, 0.0, 0.0], 7, false),
            region([0.25, 0.5 * scale, 0.0], 3, is_hole),
        ];
        let mesh = own.run(&hierarchical());
        assert_eq!(mesh.domains.len(), 2);
        assert!((volume(&mesh) - least).abs() <= 1e-15);
        let labels = &mesh.boundary.simplex_regions;
        assert!(labels.iter().all(|&label| label == 7 || label == 3));
        assert_eq!(labels.contains(&3), !is_hole);
    }
    let mut inner = solid;
    inner.regions = vec![region([0.9; 3], 7, true)];
    assert_eq!(count(&inner.run(&hierarchical()), VertexKind::Cage), 0);
}

#[test]
fn cages_go_with_all_extents_and_dihedral_angles() {
    let solid = nested(&[-40]).moved(|[x, y, z]| [x, y + 0.125 * z, z]);
    for extent in [Extent::All, Extent::Hull, Extent::Box, Extent::Boundary] {
        let mesh = solid.run(&Options { extent, ..hierarchical() });
        assert_eq!(mesh.domains.len(), 2, "{extent:?}");
        assert!(mesh.vertex_count() < 100, "{extent:?}: {} vertices", mesh.vertex_count());
    }
    let mesh = solid.run(&Options { min_dihedral: 10.0, ..hierarchical() });
    assert_eq!(mesh.domains.len(), 2);
    // To the outer cage a mesh is hierarchical unless well-spaced is named.
    let all = solid.run(&Options { extent: Extent::All, ..bounded(2.0) });
    assert_eq!(all.domains.len(), 2);
}

/// Simplices that a small angle forces in a domain are marked, and those between a cage and its
/// surroundings are not.
#[test]
fn a_component_with_a_small_angle_has_forced_simplices() {
    let scale = 2f64.powi(-40);
    let mesh = cube().with(&wedge(5.0).moved(|x| x.map(|x| scale * x))).run(&hierarchical());
    assert_eq!(mesh.domains.len(), 2);
    assert!(!mesh.boundary.forced.is_empty());
    assert!(mesh.vertex_count() < 40, "{} vertices", mesh.vertex_count());
}

/// Without a bound nothing is refined between scales, so that a cage would cost more than none.
#[test]
fn conformity_alone_needs_no_cages() {
    let options = Options { output: Output::Hierarchical, ..bounded(f64::INFINITY) };
    let mesh = nested(&[-900]).run(&options);
    assert_eq!((mesh.domains.len(), mesh.vertex_count()), (1, 16));
    // A cage that does not surround its inputs could have vertices in their facets.
    let loose = Options { epsilon: 0.6, cage_scale: 0.5, ..hierarchical() };
    assert_eq!(nested(&[-20]).run(&loose).domains.len(), 1);
}
