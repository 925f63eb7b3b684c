//! Surfaces that cross themselves no farther than roundings: needles, spurs, fins, and zeros that
//! trigonometry leaves.

use super::crossings::{run, split, surface};
use super::{assert_holds, bounded};
use netmesh::error::ErrorKind;
use netmesh::options::{Extent, Options};

/// Meshes three triangles of a circuit in millimetres, in single precision: the second is a needle
/// 3e-8 wide, turned over onto the first.
#[test]
fn a_needle_turned_over_onto_its_neighbor_is_certified() {
    let points = [
        [-2.0, -3.1772758960723877, 2.0],
        [-1.600000023841858, -3.3071799278259277, 2.0],
        [-0.6000000238418579, -2.0, 2.0],
        [0.4000000059604645, -0.6928200125694275, 2.0],
        [0.6000000238418579, -0.8660249710083008, 2.0],
    ];
    let triangles = [[1, 4, 3], [1, 3, 2], [2, 0, 1]];
    let made = run(&points, &triangles, &split(Extent::Auto, 2.0));
    assert!(made.boundary.subfacets.len() > 100, "{}", made.boundary.subfacets.len());
}

/// Meshes a side of a part that is bent by 2e-5 at its end. A needle 3e-6 wide is turned over onto
/// it, and a triangle stands on the needle, with tiles that are nearer to the plane of the side
/// than some of the needle's are.
#[test]
fn a_triangle_that_stands_on_a_turned_needle_is_certified() {
    let points = [
        [9.0, 0.0, 6.0],
        [10.0, 0.0, 0.0],
        [17.0, 0.0, 0.0],
        [-8.0, 0.0, 0.0],
        [-8.0, 0.0, 0.0],
        [-12.0, 4.0, 0.0],
        [9.1, -0.05, 0.0],
        [-4.0, 4.0, 0.0],
        [17.0, 4.0, 0.0],
        [5.0, 0.0, 0.0],
        [0.0, -3e-6, 0.0],
        [-11.0, 3.9, 0.0],
        [-10.0, 3.0, 0.0],
        [-9.0, 3.0, 0.0],
        [-8.0, 2.0, 0.0],
        [-8.0, 1.0, 0.0],
        [-49.0, 7.9, 0.0],
        [-49.0, 8.0, 0.0],
        [-8.0, 8.0, 0.0],
        [-8.0, 8.0, 0.0],
        [-75.0, 8.0, -2e-5],
        [-53.0, 4.0, 0.0],
    ];
    let triangles = [
        [0, 6, 1],
        [10, 4, 7],
        [2, 9, 10],
        [7, 2, 10],
        [16, 17, 18],
        [16, 18, 5],
        [7, 3, 15],
        [7, 15, 14],
        [5, 19, 7],
        [11, 5, 7],
        [7, 14, 13],
        [12, 11, 7],
        [13, 12, 7],
        [8, 7, 19],
        [20, 17, 16],
        [20, 16, 21],
    ];
    let options = Options { coplanar: 0.1, ..split(Extent::Auto, f64::INFINITY) };
    run(&points, &triangles, &options);
}

/// Meshes sides of a camera, at z = -0.003, over each other: an edge of one has y = -3e-19 at an
/// end, where the other's are at 0. The corners there are no wider than roundings, and two edges of
/// one triangle lead along one line to each.
#[test]
fn corners_no_wider_than_roundings_are_spurs() {
    const Z: f64 = -0.0029700002633035183;
    const BELOW: f64 = -0.0030200001783668995;
    let points = [
        [-0.02369752712547779, -0.0001223865256179124, Z],
        [-0.02369752712547779, 0.0001223865256179124, Z],
        [-0.0169190876185894, -3.3034848459710015e-19, Z],
        [-0.023683717474341393, 0.0, Z],
        [-0.017024235799908638, 0.0, BELOW],
        [-0.016930455341935158, 0.0010106224799528718, BELOW],
        [-0.016930455341935158, -0.0010106224799528718, Z],
        [-0.023689555004239082, -0.0001223865256179124, Z],
        [-0.017024235799908638, 0.0, Z],
        [-0.023675745353102684, 0.0, Z],
        [-0.023689555004239082, 0.0001223865256179124, Z],
        [-0.016930455341935158, 0.0010106224799528718, Z],
    ];
    let triangles =
        [[1, 2, 3], [3, 2, 0], [8, 9, 7], [8, 10, 9], [8, 7, 6], [11, 10, 8], [5, 8, 4]];
    for coplanar in [0.0, 0.1] {
        run(&points, &triangles, &Options { coplanar, ..split(Extent::Box, f64::INFINITY) });
    }
}

/// Meshes two triangles that have a corner 10 units in the last place from each other: the edges of
/// one lead to its corner along a line that no other triangle has.
#[test]
fn spurs_that_nobody_else_has_are_lines() {
    let points = [
        [100.0000000000009, 1.5000000000009206, 0.5],
        [100.5, 1.5, 0.75],
        [100.75000000000014, 1.5, 0.75],
        [100.75, 1.0, 0.0],
        [100.75, 1.5, 0.75],
        [100.25, 1.5, 0.7500000000008598],
    ];
    run(&points, &[[0, 1, 2], [3, 4, 5]], &split(Extent::Box, f64::INFINITY));
}

/// Meshes two triangles of a robot's trunk at y = 42.5 and z = 560. One goes through a vertex of
/// the other as nearly as z is rounded, and not as y is.
#[test]
fn facets_go_through_vertices_within_roundings_of_their_coarsest_axis() {
    let points = [
        [45.63075256347656, 42.500301361083984, 554.7059326171875],
        [43.5981559753418, 42.50029754638672, 559.784912109375],
        [42.73825454711914, 42.50029754638672, 560.3169555664062],
        [43.528350830078125, 46.71749496459961, 559.626953125],
        [43.168155670166016, 42.50029754638672, 560.0509643554688],
    ];
    run(&points, &[[0, 1, 2], [2, 4, 3]], &split(Extent::Box, f64::INFINITY));
}

/// Meshes a triangle that is there twice. An edge of it goes through a vertex that is beyond its
/// end along two axes, and before it along the third, by 1e-290.
#[test]
fn vertices_near_zero_are_level_along_an_edge_within_roundings() {
    let points = [
        [1.0, 2.24735715465097e-23, 1.0],
        [1.0, 1.0, 0.9999999999999999],
        [1.0, 1.0000000000000002, 1.0],
        [1.0, 1.0, -8.039371558274012e-93],
        [0.0, 5.634155089066714e-241, -2.5653355008114852e-290],
        [-2.5653355008114852e-290; 3],
        [-2.5653355008114852e-290, -2.5653355008114852e-290, -1.390671161567e-309],
    ];
    let triangles = [[0, 2, 3], [3, 1, 4], [1, 4, 3]];
    run(&points, &triangles, &split(Extent::All, f64::INFINITY));
}

/// Meshes two triangles whose common edge is no longer than roundings of the rest. An edge of the
/// first goes through a vertex beside both, and another way leads along the next one.
#[test]
fn facets_with_a_second_way_along_an_edge_are_split() {
    let points = [
        [1.0, 0.9999999999999999, 2.2525162451587278e-23],
        [1.0, 1.0, -8.039371558274012e-93],
        [0.0, -5e-324, 5.623863052108616e-241],
        [-2.5653355008114852e-290, -1.1704190886730496e-97, -2.5653355008114852e-290],
        [-2.5653355008114852e-290; 3],
        [-2.5653355008114852e-290, -5e-324, 6.02479966275721e-182],
        [0.0, -5e-324, 0.0],
    ];
    run(&points, &[[1, 2, 4], [2, 4, 3]], &split(Extent::All, f64::INFINITY));
}

/// Meshes triangles along one edge, with a corner of two of them five units in the last place
/// beside it. The edge goes through that corner for the triangle on whose area it borders, and past
/// it for the first: so there are two chains along the edge.
#[test]
fn an_edge_of_a_facet_goes_through_a_corner_that_others_pass() {
    let places: [[i64; 3]; 5] =
        [[0, 0, 0], [1 << 24, 0, 0], [0, 0, 1 << 25], [1 << 25; 3], [1 << 10, -384, 3 << 31]];
    let triangles = [[0, 4, 1], [4, 1, 2], [1, 2, 4], [2, 4, 3], [4, 3, 0]];
    for start in [1.0f64, -1.0] {
        let place = |units: i64| f64::from_bits(start.to_bits().wrapping_add_signed(units));
        let points = places.map(|units| units.map(place));
        for extent in [Extent::All, Extent::Box] {
            run(&points, &triangles, &split(extent, f64::INFINITY));
        }
    }
}

/// Holds that a facet ends where its own subfacets do. Two edges of a triangle go through a vertex
/// a unit beside their corner, the hull's along the same ends past it: of either edge there is a
/// straight chain, and one that comes to the rim of the subfacets only behind that vertex.
#[test]
fn edges_of_a_facet_come_to_its_rim_behind_its_corner() {
    let steps = [
        [0.0; 3],
        [2f64.powi(21), 1.5 * 2f64.powi(32), 2f64.powi(20)],
        [2.0, 1.5 * 2f64.powi(28), 1.5 * 2f64.powi(24)],
        [1.0, 16.0, 0.0],
        [2f64.powi(31), 0.0, 2f64.powi(25)],
        [3.0, 1.0, 5.0 * 2f64.powi(21)],
        [0.0, 4.0, 1.75 * 2f64.powi(30)],
    ];
    let points = steps.map(|steps| steps.map(|step| 1.0 + step * f64::EPSILON));
    for triangle in [[0, 1, 2], [1, 0, 2]] {
        for options in [bounded(f64::INFINITY), split(Extent::Hull, f64::INFINITY)] {
            run(&points, &[triangle], &Options { extent: Extent::Hull, ..options });
        }
    }
}

/// Holds that two fins at an end on a facet's edge, at angles of less than a millionth from the
/// facet, end in a limit with a place, or in a mesh. A subfacet between opposite points of a sphere
/// about the end is flat but for roundings: the way to the middle of its arc is no number, and
/// vertices of its sheet would be at 1e307.
#[test]
fn fins_on_an_edge_end() {
    let cases = [
        [
            [-18.076514745853878, -5.758948218421862, 1.5627701748802671],
            [-14.52703524892689, 5.053351236163664, -13.343523170709073],
            [16.7504750615823, -11.331917897075154, -11.583237159213088],
            [-16.314052522388742, -0.39019785544669805, -5.838816152420987],
            [-2.885191851960222, -0.43207676898772224, -11.944434286678208],
            [-4.006314997630335, 1.0166645827518819, -13.525961902818517],
            [-8.08828036055679, -0.4477358333912683, -11.391458306813236],
            [-6.056121034236519, 1.9109809016008104, -14.715523476382332],
        ],
        [
            [19.034156753738714, 16.449382345340183, -2.4529761549274767],
            [8.124272578501142, -1.9165619771591516, -14.257415756098126],
            [19.745492787353598, -4.720348807496171, -16.284231688848134],
            [15.222529129370447, 10.032802700421671, -6.577138002230405],
            [13.892750147662444, 1.574708842587813, -13.600457829227638],
            [12.877635973993922, 0.6646013733840597, -12.720754592622857],
            [16.20129464315308, 3.4917292414483057, -10.811496043232156],
            [14.471712668495222, 0.7334661407775859, -11.061586688274653],
        ],
    ];
    for points in cases {
        let mut mesh = surface(&points, &[[0, 1, 2], [3, 4, 5], [3, 6, 7]]);
        match mesh.run(&split(Extent::Box, f64::INFINITY), None) {
            Ok(()) => assert_holds(&mesh),
            Err(error) => {
                assert_eq!(error.kind(), ErrorKind::Limit, "{}", error.message());
                assert!(error.message().contains("doubles have no room"), "{}", error.message());
            }
        }
    }
}
