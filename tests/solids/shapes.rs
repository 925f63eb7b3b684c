//! Shapes whose volumes are known.

use super::crossings;
use super::{Point, Solid, assert_holds, assert_none_excused, bounded, cuboid, tilted, volume};
use crate::random::Random;
use netmesh::options::{Crossings, Extent, Interior, Options};
use netmesh::{Mesh, NONE, Region};
use std::collections::BTreeSet;

#[test]
fn a_cube_needs_no_vertex_of_its_own() {
    let mesh = cuboid([0.0; 3], [1.0; 3]).run(&Options::default());
    assert_eq!(mesh.vertex_count(), 8);
    assert!((volume(&mesh) - 1.0).abs() < 1e-15);
    assert_eq!(mesh.parameters.extent, Extent::Boundary);
    assert_eq!((mesh.boundary.subfacets.len(), mesh.boundary.subsegments.len()), (12, 12));
    // Inside is behind the facets, whose normals point outside.
    assert!(
        mesh.boundary
            .subfacet_simplices
            .iter()
            .all(|&[front, back]| { front == NONE && (back as usize) < mesh.simplex_count() })
    );
}

#[test]
fn boxes_at_any_place_and_scale_keep_the_bound() {
    for scale in [1.0, 2f64.powi(-300), 2f64.powi(300)] {
        let solid = cuboid([0.0; 3], [3.0, 1.0, 0.3]).moved(tilted);
        let mesh = solid.moved(|x| x.map(|x| x * scale)).run(&bounded(2.0));
        let whole = 0.9 * scale.powi(3);
        // Volumes of the smallest scale are no normal numbers.
        assert!(scale < 1e-80 || (volume(&mesh) / whole - 1.0).abs() < 1e-12);
        assert_none_excused(&mesh);
    }
}

/// Holds that boxes of some units in the last place are what they are: there, rounding explains no
/// gap, and no edge is bent.
#[test]
fn boxes_of_a_few_units_are_boxes() {
    let far = 2f64.powi(52);
    let place =
        |steps: [i32; 3], unit: f64, origin: f64| steps.map(|step| origin + f64::from(step) * unit);
    for (unit, origin) in [(1.0, far), (f64::from_bits(1), 0.0), (1.0, 0.0)] {
        let at = |steps| place(steps, unit, origin);
        let (mut points, mut triangles) = crossings::cuboid([at([3, -1, -1]), at([6, 3, 3])], 0);
        let (more, others) = crossings::cuboid([at([-1, 3, 0]), at([0, 4, 1])], 8);
        points.extend(more);
        triangles.extend(others);
        let mesh = crossings::run(&points, &triangles, &bounded(f64::INFINITY));
        assert_eq!((mesh.vertex_count(), mesh.boundary.subsegments.len()), (16, 24));
        let sides: BTreeSet<u32> = mesh.boundary.subfacet_parents.iter().copied().collect();
        assert_eq!(sides.len(), 12, "two triangles of a side are one facet");
    }
}

#[test]
fn regions_have_labels_and_sizes() {
    let mut solid = cuboid([0.0; 3], [1.0; 3]).with(&cuboid([0.25; 3], [0.75; 3]));
    let region = |x: f64, label, max_edge| Region {
        seed: [x, 0.5, 0.5],
        label,
        max_edge,
        ..Region::default()
    };
    solid.regions = vec![region(0.1, 7, 0.0), region(0.5, -3, 0.125)];
    let mesh = solid.run(&Options { interior: Interior::Seeds, ..bounded(2.0) });
    assert!((volume(&mesh) - 1.0).abs() < 1e-14);
    let mut inner = 0.0;
    for (simplex, &label) in mesh.boundary.simplex_regions.iter().enumerate() {
        let ends = [0, 1, 2, 3].map(|at| mesh.point(mesh.simplex(simplex)[at]));
        let middle = [0, 1, 2].map(|k| ends.iter().map(|x| x[k]).sum::<f64>() / 4.0);
        let is_inner = middle.iter().all(|x| (0.25..0.75).contains(x));
        assert_eq!(label, if is_inner { -3 } else { 7 }, "{middle:?}");
        for (a, b) in (0..4).flat_map(|i| (0..i).map(move |j| (i, j))) {
            let square: f64 = (0..3).map(|k| (ends[a][k] - ends[b][k]).powi(2)).sum();
            assert!(!is_inner || square.sqrt() <= 0.125);
        }
        inner += f64::from(is_inner);
    }
    assert!(inner > 0.0);
}

#[test]
fn boxes_in_boxes_are_holes_by_parity_and_not_by_winding() {
    let solid = cuboid([0.0; 3], [1.0; 3]).with(&cuboid([0.25; 3], [0.75; 3]));
    let with = |interior| Options { interior, ..bounded(2.0) };
    for (interior, expected) in [(Interior::Parity, 0.875), (Interior::Winding, 1.0)] {
        let mesh = solid.run(&with(interior));
        assert!((volume(&mesh) - expected).abs() < 1e-14, "{interior:?}");
    }
    let mut turned = solid.clone();
    turned.polygons[6..].iter_mut().for_each(|polygon| polygon.reverse());
    let mesh = turned.run(&with(Interior::Winding));
    assert!((volume(&mesh) - 0.875).abs() < 1e-14);
}

#[test]
fn facets_end_in_the_domain_and_have_holes() {
    let mut solid = cuboid([0.0; 3], [4.0; 3]);
    solid.points.extend([[1.0, 1.0, 2.0], [3.0, 1.0, 2.0], [3.0, 3.0, 2.0], [1.0, 3.0, 2.5]]);
    solid.polygons.push(vec![8, 9, 10]);
    solid.points.truncate(11);
    let mesh = solid.run(&bounded(2.0));
    assert!((volume(&mesh) - 64.0).abs() < 1e-12);
    let area: usize = mesh.boundary.subfacet_parents.iter().filter(|&&parent| parent == 6).count();
    assert!(area > 0);
    assert_none_excused(&mesh);
}

#[test]
fn a_surface_of_triangles_is_joined_where_it_is_plane() {
    // A cube of 6 n^2 squares, each two triangles.
    let (n, mut points, mut triangles) = (4u32, Vec::<Point>::new(), Vec::<u32>::new());
    let mut input = |x: Point| {
        let known = points.iter().position(|&other| other == x);
        known.unwrap_or_else(|| {
            points.push(x);
            points.len() - 1
        }) as u32
    };
    for (axis, side) in (0..3).flat_map(|axis| [(axis, 0), (axis, n)]) {
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let mut at = |i: u32, j: u32| {
                let mut x = [0.0; 3];
                (x[axis], x[(axis + 1) % 3], x[(axis + 2) % 3]) = (side.into(), i.into(), j.into());
                input(tilted(x))
            };
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            let turned = if side == 0 { [a, c, b, a, d, c] } else { [a, b, c, a, c, d] };
            triangles.extend(turned);
        }
    }
    let mut mesh = netmesh::Mesh::new(3, points.len(), points.as_flattened(), 0).unwrap();
    mesh.set_triangles(&triangles, None).unwrap();
    mesh.run(&bounded(2.0), None).unwrap();
    super::assert_holds(&mesh);
    let made = mesh.result().unwrap();
    assert!((volume(made) / f64::from(n.pow(3)) - 1.0).abs() < 1e-12);
    let mut parents = made.boundary.subfacet_parents.clone();
    parents.dedup();
    assert_eq!(parents.len(), 6);
    // The twelve edges of the cube are split at inputs alone.
    assert_eq!(made.boundary.subsegments.len(), 12 * n as usize);
    assert_none_excused(made);
}

#[test]
fn the_same_comes_of_the_same() {
    let solid: Solid = cuboid([0.0; 3], [3.0, 1.0, 0.3]).moved(tilted);
    let [first, second] = [1, 2].map(|threads| solid.run(&Options { threads, ..bounded(1.5) }));
    let bits = |x: &f64| x.to_bits();
    assert!(first.points.iter().map(bits).eq(second.points.iter().map(bits)));
    assert_eq!(first.simplices, second.simplices);
    assert_eq!(first.boundary.subfacets, second.boundary.subfacets);
}

/// Inputs up to some units beside the sides of a solid are on them, or are not. Other vertices of a
/// side are in the plane that the caller's polygon has.
#[test]
fn sides_stay_plane_beside_inputs_that_are_nearly_on_them() {
    let mut random = Random::new(42);
    for units in [1.0, 8.0] {
        let mut solid = cuboid([0.0; 3], [1.0; 3]);
        for at in 0..40 {
            let mut x: Point = std::array::from_fn(|_| random.unit());
            let inside = units * random.unit() * f64::EPSILON;
            x[at % 3] = if at % 2 == 0 { inside } else { 1.0 - inside };
            solid.points.push(x);
        }
        solid.moved(tilted).run(&bounded(2.0));
    }
    // Beside an edge, and lower by x than its ends, from where planes are measured.
    let mut solid = cuboid([0.0; 3], [1.0; 3]);
    for _ in 0..20 {
        let beside = [random.unit(), random.unit()].map(|part| 2.5 * f64::EPSILON * part);
        solid.points.push([-beside[0], random.unit(), -beside[1]]);
    }
    let (sine, cosine) = 0.4f64.sin_cos();
    let turned = solid.moved(|[x, y, z]| [x, cosine * y - sine * z, sine * y + cosine * z]);
    turned.run(&bounded(2.0));
}

/// Sides of which a corner stands up by any height are triangles.
#[test]
fn polygons_that_are_bent_far_become_triangles() {
    for height in [1.5, 2.0, 2.5, 4.0, 30.0] {
        let mut solid = cuboid([0.0; 3], [1.0; 3]);
        solid.points[7][2] = height;
        let mut mesh = solid.mesh();
        assert_eq!(mesh.bent_polygon(0.0).unwrap(), Some(1));
        assert_eq!(mesh.triangulate_facets().unwrap(), 6);
        mesh.run(&bounded(f64::INFINITY), None).unwrap();
        assert_holds(&mesh);
        // Of the side with the corner either diagonal may be an edge.
        let upper = volume(mesh.result().unwrap());
        let expected = [1.0 + (height - 1.0) / 6.0, 1.0 + (height - 1.0) / 3.0];
        assert!(expected.iter().any(|x| (x - upper).abs() < 1e-9), "{height}: {upper}");
    }
}

/// A polygon without an area beside one that is not plane is a triangle without one, which a run
/// refuses or leaves out as any.
#[test]
fn polygons_without_an_area_are_left_to_the_run() {
    let mut solid = cuboid([0.0; 3], [1.0; 3]);
    solid.points[7] = [1.1, 1.2, 1.3];
    solid.points.push([0.5, 0.0, 0.0]);
    solid.polygons.push(vec![0, 8, 1]);
    let mut mesh = solid.mesh();
    let split = Options { crossings: Crossings::Split, ..bounded(2.0) };
    let error = mesh.run(&split, None).unwrap_err();
    assert!(error.to_string().contains("facets[1] is not plane"), "{error}");
    assert_eq!(mesh.triangulate_facets().unwrap(), 7);
    assert_eq!(mesh.given_facets().count(), 13);
    let error = mesh.run(&bounded(2.0), None).unwrap_err();
    assert!(error.to_string().contains("triangles[12] has no area near"), "{error}");
    mesh.run(&split, None).unwrap();
    assert_holds(&mesh);
    assert!(volume(mesh.result().unwrap()) > 1.0);
}

/// Polygons that are not plane are refused; as triangles, between the same inputs, they are not.
#[test]
fn polygons_become_triangles() {
    let mut solid = cuboid([0.0; 3], [1.0; 3]);
    solid.points[7] = [1.1, 1.2, 1.3];
    let mut mesh = solid.mesh();
    let error = mesh.run(&bounded(2.0), None).unwrap_err();
    assert!(error.to_string().contains("is not plane"), "{error}");
    assert_eq!(mesh.triangulate_facets().unwrap(), 6);
    assert_eq!((mesh.given_facets().count(), mesh.given_facets().are_triangles), (12, true));
    assert_eq!(mesh.triangulate_facets().unwrap(), 0);
    mesh.run(&bounded(2.0), None).unwrap();
    assert_holds(&mesh);
    // A facet with a hole has its area, and its marker.
    let points = cuboid([0.0; 3], [1.0; 3]).with(&cuboid([0.25, 0.25, 0.0], [0.75; 3])).points;
    let mut mesh = Mesh::new(3, 16, points.as_flattened(), 0).unwrap();
    let (loops, starts) = ([0, 2], [0, 4, 8]);
    mesh.set_facets(&loops, &starts, &[0, 1, 3, 2, 8, 10, 11, 9], Some(&[5])).unwrap();
    assert_eq!(mesh.triangulate_facets().unwrap(), 1);
    let facets = mesh.given_facets();
    assert_eq!(facets.markers, [5; 8]);
    let area: f64 = facets
        .inputs
        .chunks_exact(3)
        .map(|corners| {
            let [a, b, c] = [0, 1, 2].map(|at| points[corners[at] as usize]);
            0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
        })
        .sum();
    assert_eq!(area.abs(), 0.75);
    // What has no triangles is refused, and stays.
    let starts = [0, 4];
    mesh.set_facets(&[0, 1], &starts, &[0, 3, 1, 2], None).unwrap();
    let error = mesh.triangulate_facets().unwrap_err();
    assert!(error.to_string().contains("facets[0] crosses itself near"), "{error}");
    assert!(!mesh.given_facets().are_triangles);
}
