//! Corruptions of what is promised of sizes.

use super::meshes::{Case, random_points};
use super::{assert_sound, assert_violates};
use netmesh::options::{Criterion, Options, Output, SizeFn};
use netmesh::validate::ViolationKind as Kind;
use netmesh::{Inputs, Mesh};

fn sized<const D: usize>(max_edge: f64, size: Option<&SizeFn<'_>>) -> Case {
    let points = random_points::<D>(40, 3);
    let options = Options {
        output: Output::WellSpaced,
        criterion: Criterion::RadiusEdge,
        max_edge,
        ..Options::default()
    };
    let mut mesh = Mesh::new(D, points.len(), points.as_flattened(), 0).unwrap();
    mesh.run_sized(&options, size, None).unwrap();
    let inputs = Inputs::new(D, points.len(), points.as_flattened(), 0).unwrap();
    Case { inputs, mesh: mesh.triangulation().unwrap().clone() }
}

#[test]
fn edges_longer_than_the_largest() {
    fn check<const D: usize>() {
        let mut case = sized::<D>(0.3, None);
        assert_sound(&case);
        case.mesh.parameters.max_edge *= 0.99;
        assert_violates(&case, Kind::SimplexSize);
        // A cell that doubles limit is exempt.
        case.mesh.precision_limited.fill(true);
        assert_sound(&case);
    }
    check::<2>();
    check::<3>();
}

/// The size of one vertex was smaller than the simplices at it.
#[test]
fn sizes_smaller_than_simplices() {
    fn check<const D: usize>() {
        let case = sized::<D>(0.0, Some(&|x| 0.3 + 0.1 * x[0].abs()));
        assert_sound(&case);
        for vertex in (0..case.inputs.distinct()).step_by(7) {
            assert!(case.mesh.sizes[vertex] < f64::INFINITY);
            let mut other = case.clone();
            other.mesh.sizes[vertex] *= 0.01;
            assert_violates(&other, Kind::SimplexSize);
        }
    }
    check::<2>();
    check::<3>();
}

#[test]
fn sizes_that_are_none() {
    for size in [0.0, -1.0, f64::NAN] {
        let mut case = sized::<2>(0.0, Some(&|_| 0.5));
        case.mesh.sizes[3] = size;
        assert_violates(&case, Kind::ArrayLength);
    }
    let mut case = sized::<2>(0.0, Some(&|_| 0.5));
    case.mesh.sizes.pop();
    assert_violates(&case, Kind::ArrayLength);
}
