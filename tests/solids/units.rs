//! Complexes of which corners are some units in the last place from each other, and others far.

use super::crossings::{split, surface};
use super::{Point, assert_holds, bounded};
use netmesh::error::ErrorKind;
use netmesh::options::{Extent, Options};

/// Returns the points that are so many units from another one on all axes.
fn points(origin: f64, unit: f64, steps: &[Point]) -> Vec<Point> {
    steps.iter().map(|own| own.map(|step| (origin + step) * unit)).collect()
}

fn assert_conforms(points: &[Point], triangles: &[[u32; 3]], segments: &[u32], options: &Options) {
    let mut mesh = surface(points, triangles);
    mesh.set_segments(segments, None).unwrap();
    mesh.run(options, None).unwrap_or_else(|error| panic!("{error}"));
    assert_holds(&mesh);
}

const TOP: f64 = 15_032_385_536.0;
const WIDE: f64 = 33_554_432.0;

/// Holds that facets which cross at small angles are split where they do, among subnormals as
/// elsewhere: products of these lose bits.
#[test]
fn crossings_among_the_least_doubles_are_where_they_are() {
    let steps = [
        [0.0, 6144.0, 0.0],
        [TOP, TOP, 6_442_450_944.0],
        [0.0, 0.0, WIDE],
        [WIDE; 3],
        [WIDE, WIDE, TOP],
        [0.0; 3],
    ];
    let triangles = [[5, 4, 0], [3, 4, 2], [4, 2, 1]];
    let options = split(Extent::All, f64::INFINITY);
    for (origin, unit) in [(5_889_287.0, f64::from_bits(1)), (2f64.powi(52), f64::EPSILON)] {
        assert_conforms(&points(origin, unit, &steps), &triangles, &[], &options);
    }
}

/// Holds that simplices with vertices on two parts of a facet are flat: the parts differ by what
/// shares their areas, and are in one plane.
#[test]
fn simplices_between_parts_of_a_facet_are_flat() {
    let steps = [
        [4.0, 49_152.0, 0.0],
        [0.0; 3],
        [-TOP; 3],
        [-TOP, -98_304.0, -TOP],
        [-WIDE; 3],
        [-WIDE, -WIDE, -TOP],
        [1024.0, 0.0, -4096.0],
        [-1_879_048_192.0, -25_165_824.0, 512.0],
        [-64.0, 2.0, 0.0],
        [0.0, 0.0, 4.0],
        [0.0, -1_073_741_824.0, -67_108_864.0],
        [-65_536.0, -16_777_216.0, 0.0],
    ];
    let points = points(-2f64.powi(52) - 6_151_431.0, f64::EPSILON, &steps);
    let triangles = [[1, 2, 0], [2, 0, 4], [0, 4, 8]];
    assert_conforms(&points, &triangles, &[0, 8, 4, 0], &split(Extent::All, f64::INFINITY));
}

/// Holds that the plane of a facet which is as steep along several axes is seen along one in which
/// all its subfacets have an area, though an edge is bent through an input near its end.
#[test]
fn facets_as_steep_along_all_axes_are_seen_along_any() {
    let steps = [
        [2048.0, 0.0, 0.0],
        [0.0; 3],
        [0.0, TOP, TOP],
        [TOP, TOP, 0.0],
        [WIDE; 3],
        [TOP, TOP, WIDE],
        [4.0, 0.0, 0.0],
    ];
    let points = points(2f64.powi(52), f64::EPSILON, &steps);
    let triangles = [[0, 1, 4], [1, 4, 5], [1, 2, 3]];
    assert_conforms(&points, &triangles, &[], &split(Extent::All, f64::INFINITY));
}

/// Holds that simplices which are left beyond the bound beside segments at a small angle, with no
/// vertex on these, are not called forced.
#[test]
fn simplices_left_beside_sharp_segments_are_not_forced() {
    let steps = [
        [6_442_450_944.0, 2_147_483_648.0, 6.0],
        [6.0; 3],
        [0.0, 4096.0, 1792.0],
        [0.0, 0.0, 2.0 * WIDE],
    ];
    let points = points(2f64.powi(52), f64::EPSILON, &steps);
    let options = Options { extent: Extent::All, ..bounded(3.0) };
    assert_conforms(&points, &[], &[1, 0, 2, 1, 0, 3], &options);
}

/// Holds that a triangle of some units keeps its area beside a corner that is alone: no rounding
/// explains the gap between them.
#[test]
fn small_facets_hold_no_corners_beside_them() {
    let steps = [
        [2.0, -6.0, -8.0],
        [-6.0, 0.0, 0.0],
        [0.0; 3],
        [-4.0, 8.0, 16.0],
        [-1_048_576.0, 0.0, 0.0],
    ];
    let points = points(2f64.powi(52), f64::EPSILON, &steps);
    let mut mesh = surface(&points, &[[2, 3, 0], [1, 4, 2]]);
    mesh.run(&split(Extent::All, f64::INFINITY), None).unwrap();
    assert_holds(&mesh);
    assert!(mesh.result().unwrap().boundary.subfacet_parents.contains(&0));
}

/// Holds that the certificate leads a chain through all vertices on it, not past some.
#[test]
fn chains_leave_out_no_vertex_on_them() {
    let steps = [
        [0.0, -4096.0, 0.0],
        [0.0, -6.0, 0.0],
        [0.0, 12.0, 0.0],
        [2.0, 0.0, 0.0],
        [8192.0, 0.0, 0.0],
        [-3.0, -8.0, 0.0],
        [0.0, 0.0, -1_048_576.0],
    ];
    let points = points(2f64.powi(52), f64::EPSILON, &steps);
    let triangles = [[0, 2, 1], [6, 3, 4], [4, 5, 0], [5, 0, 2], [3, 2, 4]];
    assert_conforms(&points, &triangles, &[], &split(Extent::All, f64::INFINITY));
}

/// Holds that of two sheets which are 16 units apart at their far ends the certificate takes the
/// one that is in the plane of a facet for its own.
#[test]
fn facets_borrow_from_those_in_their_plane() {
    let (low, high) = (1_048_576.0, 2f64.powi(40));
    let steps = [
        [16.0, 0.0, 0.0],
        [-2.0, 0.0, -8.0],
        [-1.0, 3.0, -6.0],
        [0.0, -4.0, low],
        [6.0, high, 0.0],
        [0.0, -3.0, high],
    ];
    let points = points(2f64.powi(52), f64::EPSILON, &steps);
    let triangles = [[2, 4, 0], [5, 4, 0], [4, 3, 5], [1, 0, 3], [3, 5, 4]];
    assert_conforms(&points, &triangles, &[], &split(Extent::All, f64::INFINITY));
}

/// Holds that the certificate takes of two chains that may be an edge's the one at the rim of its
/// facet's own subfacets, whether or not there is a subsegment straight from end to end.
#[test]
fn facets_end_at_the_rims_of_their_subfacets() {
    let high = 2f64.powi(40);
    let between_two = [
        [high, 0.0, 0.0],
        [4.0, -high, 2.0],
        [8192.0, 16.0, 16.0],
        [0.0; 3],
        [-3.0, -WIDE, 0.0],
        [6.0, 0.0, 0.0],
        [3.0, 4096.0, 0.0],
    ];
    let past_a_corner = [
        [0.0; 3],
        [0.0, 0.0, 2.0],
        [WIDE, 0.0, 0.0],
        [-4.0, 0.0, 0.0],
        [0.0, -3.0, -WIDE],
        [8.0, 4096.0, 2.0],
    ];
    for (steps, triangles) in [
        (&between_two[..], &[[2, 4, 6], [1, 0, 3]][..]),
        (&past_a_corner, &[[0, 4, 5], [4, 2, 0], [4, 2, 3]]),
    ] {
        let points = points(2f64.powi(52), f64::EPSILON, steps);
        assert_conforms(&points, triangles, &[], &split(Extent::All, f64::INFINITY));
    }
}

/// Holds that no edge is led through vertices beside it where a facet would be turned round, or two
/// edges meet beside their corner: the facet is as it is, or doubles have no room for it.
#[test]
fn edges_are_led_through_nothing_that_turns_a_facet() {
    let steps = [
        [-12.0, 8.0, -4096.0],
        [0.0, 0.0, 6.0],
        [2.0, 0.0, 0.0],
        [0.0; 3],
        [-12.0, 0.0, 0.0],
        [0.0, -2.0, 0.0],
        [-WIDE, 0.0, -3.0],
    ];
    let needles = points(2f64.powi(52), f64::EPSILON, &steps);
    let flat = [
        [2.0, 0.0, 0.0],
        [16.0, -8192.0, 1_048_576.0],
        [0.0, 0.0, -3.0],
        [0.0; 3],
        [-4.0, 4.0, 0.0],
    ];
    let flat = points(2f64.powi(52), f64::EPSILON, &flat);
    let corner = [[32_768.0, 0.0, 0.0], [0.0; 3], [TOP; 3], [2.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
    let corner = points(2f64.powi(52), f64::EPSILON, &corner);
    for options in [bounded(f64::INFINITY), split(Extent::All, f64::INFINITY)] {
        let options = Options { extent: Extent::All, ..options };
        for (points, triangles) in [
            (&corner, &[[2, 1, 0]][..]),
            (&flat, &[[2, 1, 3]]),
            (&needles, &[[3, 6, 5], [3, 1, 0]]),
        ] {
            let mut mesh = surface(points, triangles);
            match mesh.run(&options, None) {
                Ok(()) => assert_holds(&mesh),
                Err(error) => {
                    assert_eq!(error.kind(), ErrorKind::Limit, "{error}");
                    assert!(error.message().contains("doubles have no room for"), "{error}");
                }
            }
        }
    }
}

/// Holds that what is left of a triangle is refused where crossings were split and it is turned
/// round.
#[test]
fn triangles_that_bends_turn_round_have_no_room() {
    let steps = [
        [0.0, 0.0, -8192.0],
        [0.0; 3],
        [12.0, 0.0, 2f64.powi(50)],
        [1.0, 0.0, 0.0],
        [0.0, -2f64.powi(50), 0.0],
        [0.0, -8.0, -4096.0],
    ];
    let points = points(2f64.powi(52), f64::EPSILON, &steps);
    let mut mesh = surface(&points, &[[5, 3, 1], [0, 3, 2]]);
    let error = mesh.run(&split(Extent::All, f64::INFINITY), None).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Limit, "{error}");
    let expected = "doubles have no room for a triangle of facets near (";
    assert!(error.message().starts_with(expected), "{error}");
}

/// Holds that the certificate takes triangles for one facet that were split and bent into one
/// plane: no line between them shows in the mesh.
#[test]
fn facets_that_are_bent_into_one_plane_are_one() {
    let steps = [
        [0.0, 6144.0, 0.0],
        [TOP, TOP, 6_442_450_944.0],
        [TOP; 3],
        [0.0, 0.0, WIDE],
        [WIDE, WIDE, TOP],
        [0.0, -4.0, 1_073_741_824.0],
        [0.0, -49_152.0, 0.5 * WIDE],
    ];
    let points = points(5_889_287.0, f64::from_bits(1), &steps);
    let triangles = [[1, 2, 5], [4, 5, 3], [5, 3, 1], [3, 1, 6]];
    assert_conforms(&points, &triangles, &[], &split(Extent::All, f64::INFINITY));
}

/// Holds that an edge may have two ways within roundings, of which the certificate follows one: the
/// subsegments of the other are the edge's, too.
#[test]
fn subsegments_along_a_split_edge_are_its_own() {
    let steps = [
        [-16.0, 0.0, 0.0],
        [0.0, -1_048_576.0, 0.0],
        [0.0, -16.0, 0.0],
        [-1_048_576.0, 6.0, 0.0],
        [0.0; 3],
        [8.0, -1_048_576.0, -1.0],
        [3.0, -2f64.powi(40), -2f64.powi(50)],
        [-6.0, -1_048_576.0, 0.0],
        [1.0, 0.0, 0.0],
        [-4096.0, 0.0, -WIDE],
        [2.0, WIDE, 12.0],
    ];
    let points = points(2f64.powi(52), f64::EPSILON, &steps);
    let triangles = [[3, 5, 8], [3, 10, 9], [0, 3, 10], [1, 8, 3], [3, 5, 0]];
    assert_conforms(&points, &triangles, &[], &split(Extent::Box, f64::INFINITY));
}

/// Holds that needles of which edges are left out are left out, and what is on both sides of an
/// edge without them may be one facet.
#[test]
fn needles_that_share_an_edge_are_left_out_with_it() {
    let steps = [
        [0.0; 3],
        [-4.0, 0.0, 0.0],
        [0.0, 0.0, -1_048_576.0],
        [2.0, 1.0, -2.0],
        [0.0, 0.0, 2.0],
        [-8192.0, -2.0, 0.0],
    ];
    let points = points(2f64.powi(52), f64::EPSILON, &steps);
    let triangles = [[4, 0, 1], [2, 1, 0], [5, 0, 1], [3, 4, 0], [3, 0, 5]];
    assert_conforms(&points, &triangles, &[], &split(Extent::All, f64::INFINITY));
}

/// Holds that a needle without subfacets is left out where no subfacets of others tile it between
/// the chains of its edges.
#[test]
fn needles_that_nothing_tiles_are_left_out() {
    let (low, high) = (2f64.powi(40), 2f64.powi(50));
    let steps = [
        [-low, -1.0, 8192.0],
        [2.0, 3.0, 0.0],
        [0.0, high, -16.0],
        [0.0; 3],
        [0.0, 0.0, -6.0],
        [-high, -4096.0, -high],
    ];
    let points = points(2f64.powi(52), f64::EPSILON, &steps);
    let triangles = [[1, 0, 2], [2, 3, 5], [2, 0, 4], [1, 3, 5]];
    assert_conforms(&points, &triangles, &[], &split(Extent::Box, f64::INFINITY));
}

/// Holds that of two ways along an edge within roundings the certificate takes the one that ends
/// the facet's own subfacets, as far as these lead and in their direction; and that a triangle with
/// subfacets of its own is part of no other facet.
#[test]
fn subfacets_tell_where_split_facets_end() {
    let (low, high) = (2f64.powi(40), 2f64.powi(50));
    let a_corner_within_roundings = [
        [-4096.0, -2.0, 0.0],
        [0.0, 0.0, -2.0],
        [0.0, 0.0, -16.0],
        [0.0, -16.0, 8192.0],
        [0.0; 3],
        [-4.0, 0.0, 0.0],
    ];
    let two_chains = [
        [8192.0, 0.0, -8.0],
        [-8192.0, 0.0, 2.0],
        [0.0, low, 0.0],
        [0.0, 0.0, -8192.0],
        [-WIDE, -8192.0, 0.0],
        [0.0, -1.0, 0.0],
        [-low, 0.0, 3.0],
        [-16.0, 0.0, 0.0],
    ];
    let beside_another = [
        [-3.0, 0.0, -8192.0],
        [0.0, 0.0, high],
        [high, 0.0, 4.0],
        [0.0, -8192.0, -1_048_576.0],
        [1_048_576.0, 2.0, 0.0],
    ];
    let a_bent_edge = [
        [1.0, -4096.0, 6.0],
        [-4096.0, 0.0, 2.0],
        [-1.0, 0.0, 6.0],
        [0.0, 0.0, 4096.0],
        [12.0, 0.0, 0.0],
        [0.0; 3],
        [0.0, 0.0, 8.0],
    ];
    let a_rim_beside_an_edge = [
        [0.0; 3],
        [-8.0, 0.0, 0.0],
        [0.0, 0.0, -16.0],
        [-4.0, 0.0, -high],
        [0.0, -3.0, -8.0],
        [-low, 0.0, 0.0],
        [12.0, 0.0, 0.0],
    ];
    for (steps, triangles) in [
        (&a_corner_within_roundings[..], &[[4, 1, 2], [3, 0, 1], [5, 2, 1]][..]),
        (&a_rim_beside_an_edge, &[[1, 4, 5], [3, 0, 5], [5, 6, 1]]),
        (&a_bent_edge, &[[0, 4, 5], [5, 2, 1], [5, 1, 3], [5, 6, 0], [4, 0, 5]]),
        (&two_chains, &[[2, 1, 4], [6, 5, 2], [4, 2, 7], [4, 7, 5], [5, 6, 2]]),
        (&beside_another, &[[1, 0, 2], [0, 4, 1], [4, 3, 2], [0, 3, 4], [2, 4, 3]]),
    ] {
        let points = points(2f64.powi(52), f64::EPSILON, steps);
        assert_conforms(&points, triangles, &[], &split(Extent::All, f64::INFINITY));
    }
}

/// Holds that vertices of a facet may be as far from its plane as an input beside it, through which
/// it goes.
#[test]
fn facets_through_inputs_beside_them_are_bent_there() {
    let steps = [
        [0.0, WIDE, 0.0],
        [3.0, WIDE, 1_048_576.0],
        [-4096.0, 0.0, 0.0],
        [2.0, 0.0, 2f64.powi(50)],
        [0.0, 8.0, 12.0],
        [0.0, -2f64.powi(50), -2f64.powi(40)],
        [0.0, 1_048_576.0, 12.0],
    ];
    let points = points(2f64.powi(52), f64::EPSILON, &steps);
    let options = Options { extent: Extent::All, ..bounded(f64::INFINITY) };
    assert_conforms(&points, &[[5, 3, 0], [6, 2, 3]], &[], &options);
}

/// Holds that no facet keeps a line of which it has both sides, where a vertex is near one edge of
/// its corner and much nearer to the other: it is on neither, and doubles have no room beside it.
#[test]
fn vertices_beside_a_corner_are_on_no_edge_there() {
    let steps = [
        [0.0; 3],
        [0.0, 1_048_576.0, -3.0],
        [-8.0, -3.0, 3.0],
        [0.0, 1.0, 0.0],
        [-4.0, 0.0, 0.0],
        [-2f64.powi(40), 0.0, -WIDE],
        [-4096.0, -16.0, 0.0],
    ];
    let points = points(2f64.powi(52), f64::EPSILON, &steps);
    let mut mesh = surface(&points, &[[5, 0, 1], [0, 2, 6], [0, 1, 6]]);
    let options = Options { extent: Extent::All, ..bounded(f64::INFINITY) };
    let error = mesh.run(&options, None).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Limit, "{error}");
    assert!(error.message().contains("doubles have no room for"), "{error}");
}

/// Holds that the same is so of facets that are led through inputs beside them, where none are
/// split.
#[test]
fn subfacets_tell_where_bent_facets_end() {
    let past_two = [
        [0.0, -WIDE, -3.0],
        [0.0, -3.0, 0.0],
        [1_048_576.0, 16.0, -6.0],
        [0.0, 8.0, 2f64.powi(40)],
        [0.0; 3],
        [12.0, 0.0, 16.0],
        [0.0, 2.0, 2.0],
    ];
    let beside_a_corner = [
        [12.0, 8.0, 0.0],
        [1_048_576.0, 0.0, -8.0],
        [0.0; 3],
        [4.0, 0.0, -3.0],
        [0.0, 2f64.powi(50), 0.0],
        [0.0, -4096.0, 0.0],
        [8.0, -16.0, 0.0],
        [0.0, 0.0, 3.0],
    ];
    for (steps, triangles, extent) in [
        (&past_two[..], &[[6, 5, 0], [0, 2, 5]], Extent::Box),
        (&beside_a_corner, &[[2, 3, 1], [3, 5, 2]], Extent::All),
    ] {
        let points = points(2f64.powi(52), f64::EPSILON, steps);
        let options = Options { extent, ..bounded(f64::INFINITY) };
        assert_conforms(&points, triangles, &[], &options);
    }
}

/// Holds that a facet lends no area to another that ends at other vertices, though they are one in
/// the projection of both: the two are apart.
#[test]
fn sheets_that_end_at_vertices_side_by_side_share_nothing() {
    let steps = [[0.0, -2f64.powi(40), 0.0], [-1.0, 0.0, -4.0], [0.0, -12.0, -8192.0]];
    let points = points(2f64.powi(52), f64::EPSILON, &[&steps[..], &[[0.0, 0.0, -4.0]]].concat());
    let mut mesh = surface(&points, &[[2, 3, 0], [1, 0, 2]]);
    mesh.run(&split(Extent::All, f64::INFINITY), None).unwrap();
    assert_holds(&mesh);
    let parents = &mesh.result().unwrap().boundary.subfacet_parents;
    assert!([0, 1].iter().all(|facet| parents.contains(facet)));
}

/// Holds that an edge beside which rounding explains no gap is led through no input by crossings.
#[test]
fn short_edges_are_bent_through_no_inputs() {
    let beside_an_edge = [
        [-4096.0, -8192.0, 8.0],
        [0.0, 0.0, 8.0],
        [0.0; 3],
        [0.0, -2.0, 4.0],
        [12.0, -16.0, -8.0],
        [8192.0, 0.0, 0.0],
    ];
    let needle = [
        [0.0, 2.0, 0.0],
        [0.0, -2f64.powi(50), -1_048_576.0],
        [0.0, 0.0, WIDE],
        [0.0, -1.0, -4.0],
        [0.0, 0.0, 16.0],
    ];
    for (steps, triangles) in [
        (&beside_an_edge[..], &[[3, 2, 5], [0, 3, 5], [0, 1, 4]][..]),
        (&needle, &[[3, 4, 0], [2, 1, 0], [0, 3, 2], [2, 1, 3], [3, 4, 0]]),
    ] {
        let points = points(2f64.powi(52), f64::EPSILON, steps);
        let mut mesh = surface(&points, triangles);
        let error = mesh.run(&split(Extent::All, f64::INFINITY), None).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::InvalidArgument, "{error}");
        assert!(error.message().contains("some still meet after they were split"), "{error}");
    }
}
