//! Conformity alone where much is near to the hull: the mesh ends there, so nothing of what
//! surrounds it while it is made may cost a vertex.

use super::{Point, Solid, bounded, cuboid, volume};
use netmesh::options::{Extent, Options};

fn alone(extent: Extent) -> Options {
    Options { extent, ..bounded(f64::INFINITY) }
}

/// Returns a box with four plates above and four below the saddle z = xy, which end at lines on it
/// but for a tenth (B. Chazelle, "Convex partitions of polyhedra", 1984).
fn chazelles_polyhedron() -> Solid {
    let mut solid = cuboid([0.0, 0.0, -25.0], [5.0, 5.0, 50.0]);
    let [low, high] = [0.25, 4.75];
    for x in [1.0, 2.0, 3.0, 4.0] {
        let above: [Point; 4] =
            [[x, low, x * low + 0.1], [x, high, x * high + 0.1], [x, high, 37.5], [x, low, 37.5]];
        let below: [Point; 4] =
            [[low, x, x * low - 0.1], [high, x, x * high - 0.1], [high, x, -12.5], [low, x, -12.5]];
        for plate in [above, below] {
            let first = solid.points.len() as u32;
            solid.points.extend(plate);
            solid.polygons.push((first..first + 4).collect());
        }
    }
    solid
}

/// Holds that it needs no more vertices of its own than the best that others needed, 283.
#[test]
fn chazelles_polyhedron_needs_few_vertices() {
    let made = chazelles_polyhedron().run(&alone(Extent::Boundary));
    assert!(made.vertex_count() <= 40 + 283, "{} vertices", made.vertex_count());
    assert!((volume(&made) - 1875.0).abs() < 1e-9);
}

/// Holds that a facet behind a side of the hull costs no vertex, however near it is: a ball through
/// the side's triangles that does not hold it reaches out by as much as the facet is near.
#[test]
fn facets_behind_the_hull_cost_no_vertices() {
    for exponent in [-3, -7, -10, -14, -18] {
        let z = 2f64.powi(exponent);
        let mut solid = cuboid([0.0; 3], [1.0; 3]);
        solid.points.extend([[0.25, 0.25, z], [0.75, 0.3, z], [0.7, 0.75, z], [0.3, 0.7, z]]);
        solid.polygons.push(vec![8, 9, 10, 11]);
        for extent in [Extent::Boundary, Extent::Hull, Extent::Box] {
            let made = solid.run(&alone(extent));
            assert_eq!(made.vertex_count(), 12, "2^{exponent}, {extent:?}");
        }
    }
}

/// Holds that what surrounds the mesh while it is made is nearer where doubles have no room for it.
#[test]
fn hulls_may_reach_to_the_largest_doubles() {
    for size in [1e300, 1e304, 1e306] {
        for extent in [Extent::Boundary, Extent::Hull, Extent::Box] {
            let made = cuboid([-size; 3], [size; 3]).run(&alone(extent));
            assert_eq!(made.vertex_count(), 8, "{size}, {extent:?}");
        }
    }
}

/// Holds that what surrounds the facets stays near where it is part of the mesh.
#[test]
fn what_surrounds_facets_is_near_where_it_is_part_of_the_mesh() {
    let made = cuboid([0.0; 3], [1.0; 3]).run(&alone(Extent::All));
    assert!(made.points.iter().all(|x| x.abs() < 10.0));
}
