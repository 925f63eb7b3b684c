//! Segments that meet at small angles, beside others at one end. The angle that is asked for is
//! there in all triangles but those that a small angle forces.

use super::check::check;
use super::run;
use super::seeds::assert_edges_listed;
use super::shapes::Domain;
use crate::random::Random;
use netmesh::ErrorKind;
use netmesh::options::{Crossings, Extent, Options, Output};
use netmesh::validate::validate_mesh;

const ANGLES: [f64; 8] = [0.0, 15.0, 20.7, 25.0, 27.615, 30.0, 32.0, 33.0];
const EXTENTS: [Extent; 4] = [Extent::All, Extent::Hull, Extent::Box, Extent::Boundary];

fn options(extent: Extent, min_angle: f64) -> Options {
    let (output, crossings) = (Output::WellSpaced, Crossings::Split);
    Options { extent, min_angle, output, crossings, max_vertices: 20_000, ..Options::default() }
}

/// Returns true if the domain has a mesh, which is as it should be.
fn has_sound_mesh(domain: &Domain, options: &Options) -> bool {
    match run(domain, options) {
        Ok(mesh) => {
            check(domain, &mesh, options.min_angle);
            assert_edges_listed(&mesh);
            true
        }
        Err(error) => {
            let kinds = [ErrorKind::InvalidArgument, ErrorKind::DegenerateInput];
            let has_nothing = options.extent != Extent::All || domain.segments.is_empty();
            let is_empty = kinds.contains(&error.kind()) && has_nothing;
            assert!(is_empty, "{error}: {options:?} of {:?}, {:?}", domain.points, domain.segments);
            false
        }
    }
}

/// One side of an angle of 63 degrees makes one of 27 with a third segment.
#[test]
fn an_angle_beside_a_small_one_forces_nothing() {
    let domain = Domain::new(&[[0.0, 2.0], [2.0, 1.0], [2.0, 4.0]], &[[0, 1], [2, 0]]);
    for step in 0..55 {
        let options = options(Extent::Box, 20.0 + 0.25 * f64::from(step));
        assert!(has_sound_mesh(&domain, &options));
    }
}

/// The bottom of the box goes through an input that is an ulp above it, in a step.
#[test]
fn a_side_with_a_step_has_no_corner_there() {
    let bottom = 1.3f64.next_up();
    let points = [[1.9, bottom], [1.0, 1.6], [2.0, 1.3]];
    for points in [points, points.map(|[x, y]| [y, x])] {
        let domain = Domain::new(&points, &[[1, 0]]);
        let mesh = run(&domain, &Options { extent: Extent::Box, ..Options::default() }).unwrap();
        let report = validate_mesh(&mesh, 3).unwrap();
        assert_eq!((report.level, report.violations), (3, 0), "{:?}", report.first);
    }
}

/// Between whole numbers nothing is nearly on a segment: every graph has a mesh. More of them if
/// NETMESH_SLOW is set.
#[test]
fn graphs_between_whole_numbers() {
    let count = if std::env::var_os("NETMESH_SLOW").is_some() { 4000 } else { 120 };
    let mut random = Random::new(40);
    let mut draw = |below: u32| (random.unit() * f64::from(below)) as u32;
    let (mut meshes, mut forced) = (0, 0);
    for trial in 0..count {
        let span = [5, 9, 30][trial % 3];
        let points: Vec<[f64; 2]> =
            (0..3 + draw(5)).map(|_| [draw(span), draw(span)].map(f64::from)).collect();
        let inputs = points.len() as u32;
        let segments: Vec<[u32; 2]> =
            (0..2 + draw(4))
                .map(|at| {
                    if trial % 2 == 0 {
                        [0, (1 + at) % inputs]
                    } else {
                        [draw(inputs), draw(inputs)]
                    }
                })
                .filter(|ends| points[ends[0] as usize] != points[ends[1] as usize])
                .collect();
        let domain = Domain::new(&points, &segments);
        let angle = ANGLES[draw(8) as usize];
        for extent in EXTENTS {
            let options = options(extent, angle);
            meshes += usize::from(has_sound_mesh(&domain, &options));
            forced += usize::from(
                run(&domain, &options)
                    .is_ok_and(|mesh| !mesh.result().unwrap().boundary.forced.is_empty()),
            );
        }
    }
    assert!(meshes > 2 * count && forced > count / 2, "{meshes} meshes, {forced} with forced");
}
