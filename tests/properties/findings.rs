//! Findings of the fuzz targets, each as a test of its own. The inputs are in the corpus too.

use crate::solids::assert_holds;
use netmesh::validate::{validate, validate_mesh};
use netmesh::{Criterion, Crossings, ErrorKind, Extent, Mesh, Options, Output};
use std::time::{Duration, Instant};

fn certify(dim: usize, points: &[f64], options: &Options) {
    let mut mesh = Mesh::new(dim, points.len() / dim, points, 0).unwrap();
    mesh.run(options, None).unwrap();
    let report = validate(mesh.inputs(), mesh.triangulation().unwrap(), 3).unwrap();
    assert_eq!((report.level, report.violations), (3, 0), "{:?}", report.first);
}

/// With `root_scale` 2 and `cage_scale` 0.3 the outer cage was smaller than the input.
#[test]
fn the_outer_cage_surrounds_the_input_whatever_the_scales() {
    for (cage_scale, root_scale, delta) in [(0.3, 2.0, 0.0), (0.9, 2.0, 1.0), (0.3, 3.0, 1.0)] {
        let options = Options { cage_scale, root_scale, delta, ..Options::default() };
        for dim in 2..=4 {
            let mut points = vec![0.0; 3 * dim];
            (points[dim], points[2 * dim + 1]) = (1.0, 0.5);
            certify(dim, &points, &options);
            points.iter_mut().for_each(|x| *x *= f64::from_bits(1 << 8));
            certify(dim, &points, &options);
        }
    }
}

/// Among subnormals the slack of a cage's radius rounded to nothing, and the input that the cage
/// was made for encroached it.
#[test]
fn a_cage_among_subnormals_is_not_encroached() {
    for gap in [1, 3, 40, 118, 183, 211, 255] {
        for epsilon in [0.05, 0.1255, 0.5, 0.6] {
            let units = |count: u64| f64::from_bits(count);
            let points = [0.0, 0.0, units(gap), 0.0, 1e-300, 0.0, 0.0, 1.0];
            certify(2, &points, &Options { epsilon, ..Options::default() });
        }
    }
}

/// The cage's template was made in full, minutes of work, before `max_vertices` was looked at.
#[test]
fn a_cage_beyond_the_limit_is_not_made() {
    let mut mesh = Mesh::new(4, 2, &[0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0], 0).unwrap();
    let options = Options { delta: 0.1, max_vertices: 100, ..Options::default() };
    let begun = Instant::now();
    assert_eq!(mesh.run(&options, None).unwrap_err().kind(), ErrorKind::Limit);
    assert!(begun.elapsed() < Duration::from_secs(20), "{:?}", begun.elapsed());
}

/// One coordinate of a segment's ends was 2^900 times as large as the other's, and vertices between
/// them were a unit in the last place off.
#[test]
fn segments_between_points_of_any_magnitude() {
    let points = [
        [-0.015445607457242105, -5.975201142731369e189],
        [5.148419548479106e164, -1.592162730303881e-53],
        [4.681493705582913e179, 4.3828606000982147e-237],
    ];
    let mut mesh = Mesh::new(2, 3, points.as_flattened(), 0).unwrap();
    mesh.set_segments(&[0, 1, 1, 2, 2, 0], None).unwrap();
    let (extent, output) = (Extent::Hull, Output::WellSpaced);
    let options = Options { extent, output, min_angle: 27.5, ..Options::default() };
    mesh.run(&options, None).unwrap();
    let report = validate_mesh(&mesh, 3).unwrap();
    assert_eq!((report.level, report.violations), (3, 0), "{:?}", report.first);
}

/// Sharp corners put vertices where one coordinate is half a unit in the last place from an end's,
/// but for 2^-54 of that. Sums in which that was lost took the tie to the other double.
#[test]
fn vertices_that_nearly_are_half_a_unit_from_an_end() {
    let points =
        [[0.0, -4.492201113413975e69], [0.0, -4.622951982840224e164], [5.996942416370306e177, 0.0]];
    let mut mesh = Mesh::new(2, 3, points.as_flattened(), 0).unwrap();
    mesh.set_segments(&[0, 2, 1, 2], None).unwrap();
    let options = Options { output: Output::WellSpaced, ..Options::default() };
    mesh.run(&options, None).unwrap();
    let report = validate_mesh(&mesh, 3).unwrap();
    assert_eq!((report.level, report.violations), (3, 0), "{:?}", report.first);
}

/// A corner of a box beside inputs a unit in the last place away, through which both sides go: the
/// certificate took the corner, from whose two edges one sees no side, for a vertex on one line.
#[test]
fn a_corner_of_a_box_beside_inputs() {
    let unit = f64::EPSILON;
    let (one, two, three) = (1.0 + unit, 1.0 + 2.0 * unit, 1.0 + 3.0 * unit);
    let (left, middle) = (-1.0 + 0.5 * unit, -1.0 + unit);
    let points = [
        [1.0, 1.0],
        [-1.0, 1.0],
        [one, one],
        [left, one],
        [two, two],
        [-1.0, two],
        [middle, two],
        [three, three],
        [left, two],
        [two, 0.0],
    ];
    let mut mesh = Mesh::new(2, points.len(), points.as_flattened(), 0).unwrap();
    mesh.set_segments(&[0, 8], None).unwrap();
    let (extent, crossings) = (Extent::Box, Crossings::Split);
    mesh.run(&Options { extent, crossings, min_angle: 33.0, ..Options::default() }, None).unwrap();
    let report = validate_mesh(&mesh, 3).unwrap();
    assert_eq!((report.level, report.violations), (3, 0), "{:?}", report.first);
}

fn certify_plane(points: &[[f64; 2]], segments: &[[u32; 2]], options: &Options) {
    let mut mesh = Mesh::new(2, points.len(), points.as_flattened(), 0).unwrap();
    mesh.set_segments(segments.as_flattened(), None).unwrap();
    mesh.run(options, None).unwrap();
    let report = validate_mesh(&mesh, 3).unwrap();
    assert_eq!((report.level, report.violations), (3, 0), "{:?}", report.first);
}

/// Parts of a side's length were too coarse for places where one of its coordinates comes to zero,
/// and the run was refused for lack of room.
#[test]
fn sides_with_vertices_where_a_coordinate_is_near_zero() {
    let points = [
        [6.436837897639998e-50, -6.552363284584419e197],
        [3.100734328550215e301, -1.2166986024289021e-207],
        [-6.858232218242886e133, 1.5674247274776808e305],
        [4.2691854705103113e-237, 1.3255e-319],
        [0.0, 0.0],
    ];
    let (extent, output) = (Extent::Hull, Output::Hierarchical);
    certify_plane(&points, &[], &Options { extent, output, min_angle: 5.0, ..Options::default() });
}

/// A segment of 2,000 subnormal units had a vertex of another where its own would have been, and
/// was refused, since so short a segment goes through nothing beside it.
#[test]
fn a_segment_among_subnormals_goes_through_what_it_meets() {
    let points =
        [[0.0, 0.0], [6.324e-321, 8.854e-321], [-8.696e-321, -1.219e-320], [5.28e-321, 7.396e-321]];
    let options = Options { min_angle: 5.0, crossings: Crossings::Split, ..Options::default() };
    certify_plane(&points, &[[0, 1], [2, 3]], &options);
}

/// The certificate took a chain for broken that goes back on its second axis for some units, where
/// it is level on its first.
#[test]
fn a_bent_chain_may_go_back_where_it_is_level() {
    let points = [
        [-1.7, -1.9],
        [1.2, -4.6],
        [1.1999999999999995, -4.6],
        [1.2000000000000006, -4.599999999999997],
        [1.200000000000001, -4.599999999999994],
        [1.2000000000000004, -4.599999999999995],
        [-1.3701960784313725, -2.2070588235294113],
        [1.2000000000000008, -4.599999999999997],
        [0.21999999999999964, -0.6099999999999999],
        [3.0199999999999996, -12.01],
        [1.3509803921568628, -5.21470588235294],
        [-3.5, 10.6],
    ];
    let segments = [[0, 1], [0, 3], [4, 5], [6, 7], [8, 9], [10, 11]];
    let options = Options {
        min_angle: 33.0,
        extent: Extent::Hull,
        crossings: Crossings::Split,
        output: Output::Hierarchical,
        seed: 119,
        ..Options::default()
    };
    certify_plane(&points, &segments, &options);
}

/// The boundary of a hull went back and forth between four inputs at a corner, and two of its edges
/// crossed what the others span there: it goes through fewer of them.
#[test]
fn a_hull_with_inputs_around_a_corner_goes_through_some() {
    let points = [
        [10.1, -10.5],
        [3.5, 5.5],
        [-5.1, 6.8],
        [-6.3, -10.2],
        [-8.3, 3.2],
        [3.5, 5.500000000000001],
        [3.500000000000001, 5.500000000000002],
        [26.61, 0.02999999999999936],
        [3.5000000000000004, 5.500000000000002],
    ];
    let (extent, crossings) = (Extent::Hull, Crossings::Split);
    for output in [Output::Hierarchical, Output::WellSpaced] {
        certify_plane(
            &points,
            &[[0, 1]],
            &Options { extent, crossings, output, ..Options::default() },
        );
    }
}

/// Three segments from one point to ends that are 2^200 times smaller share vertices on the way.
/// One was added at half of the rest for each run, and 64 runs were not enough.
#[test]
fn segments_from_far_away_share_vertices_up_to_their_ends() {
    let points =
        [[-9e63, -9e63], [84.0, 7.7e-53], [-98.0, 102.00000000000001], [0.0, -2.5], [12.0, 1.0]];
    let mut mesh = Mesh::new(2, points.len(), points.as_flattened(), 0).unwrap();
    mesh.set_segments(&[0, 1, 0, 2, 0, 3, 0, 4], None).unwrap();
    let options = Options { max_vertices: 1200, ..Options::default() };
    let error = mesh.run(&options, None).unwrap_err();
    // The gap between them is a fraction of 1e-12 of their length where doubles tell them apart.
    assert!(error.message().starts_with("options.max_vertices is 1200"), "{error}");
}

/// An edge of the triangle bends through an input that is two units beside its plane, and is split
/// between that and its end.
#[test]
fn edges_of_facets_bend_through_inputs_beside_their_plane() {
    let units = [
        [64, 402_653_184, 8192],
        [4_294_967_296, 262_144, 262_144],
        [1024, 50_331_648, 163_840],
        [224, 1_342_177_280, -8_388_608],
        [512, 64, -2],
        [0, 0, 0],
        [-4, 0, 1_073_741_824],
    ];
    let start = f64::from_bits(0x3ff9_d770_1900_0007);
    let points = units.map(|x: [i64; 3]| x.map(|steps| start + steps as f64 * f64::EPSILON));
    let mut mesh = Mesh::new(3, points.len(), points.as_flattened(), 0).unwrap();
    mesh.set_triangles(&[1, 2, 5], None).unwrap();
    let options = Options {
        criterion: Criterion::RadiusEdge,
        quality_bound: f64::INFINITY,
        max_vertices: 2000,
        seed: 159,
        ..Options::default()
    };
    mesh.run(&options, None).unwrap();
    let result = mesh.triangulation().unwrap();
    assert!(result.boundary.subsegments.len() > 4, "{}", result.boundary.subsegments.len());
    assert_holds(&mesh);
}

/// The sides of a cone that is 1e-12 high are plane but for roundings, so that they are one side of
/// the hull. The certificate asked for the volume of the exact hull.
#[test]
fn sides_that_roundings_make_one_leave_the_volume_between_them() {
    let points = [
        [4.984375, 0.0, 0.0],
        [2.4921875000000004, 4.316595371988061, 0.0],
        [-2.492187499999999, 4.316595371988062, 0.0],
        [-4.984375, 6.104098889500089e-16, 0.0],
        [-2.492187500000002, -4.31659537198806, 0.0],
        [1.5937500000000004, -2.760455974562898, 0.0],
        [0.0, 0.0, 0.0],
        [-0.0859375, 0.0, 1.8189894035458565e-12],
    ];
    let criterion = Criterion::RadiusEdge;
    for quality_bound in [2.0, f64::INFINITY] {
        let extent = Extent::Hull;
        let options = Options { criterion, quality_bound, extent, ..Options::default() };
        certify(3, points.as_flattened(), &options);
    }
}

/// Lines that end at a vertex with a shield are 2^1420 times as long as others there: ways along
/// them were divided by its radius, and places on its sphere were no numbers.
#[test]
fn lines_of_a_shield_may_have_any_length() {
    let points = [
        [-5.1170865907818884e250, 8.428252743585623e-306, 3.581505641715822e-273],
        [4.180608735579564e-178, 4.1806722779836574e-178, 4.1806722779836574e-178],
        [4.318037710294522e-178, 4.1806722779836574e-178, 3.1853175322251744e43],
        [2.2839091047096005e-299, 1.85754e-319, 0.0],
        [0.0, 0.0, 0.0],
    ];
    let options = Options {
        criterion: Criterion::RadiusEdge,
        quality_bound: f64::INFINITY,
        extent: Extent::Hull,
        max_vertices: 600,
        seed: 124,
        threads: 2,
        ..Options::default()
    };
    let mut mesh = Mesh::new(3, points.len(), points.as_flattened(), 0).unwrap();
    match mesh.run(&options, None) {
        Ok(()) => assert_eq!(validate_mesh(&mesh, 3).unwrap().violations, 0),
        Err(error) => assert_eq!(error.kind(), ErrorKind::Limit, "{error}"),
    }
}

/// A side of the hull goes through an input that is four units beside it, at the end of a strip
/// that is 40 times narrower than the side: its mean normal is turned by as much.
#[test]
fn strips_that_roundings_bend_are_of_their_side() {
    let units: [[u32; 3]; 14] = [
        [128, 50_331_648, 0],
        [196_608, 33_554_432, 256],
        [229_376, 6, 49_152],
        [0, 917_504, 10_240],
        [117_440_512, 1024, 64],
        [1792, 805_306_368, 0],
        [768, 0, 2],
        [24_576, 49_152, 4096],
        [1536, 1_048_576, 0],
        [20_480, 0, 160],
        [16_384, 67_108_864, 2048],
        [0, 6, 0],
        [268_435_456, 4096, 1024],
        [458_752, 16, 2_097_152],
    ];
    let points = units.map(|x| x.map(|steps| 1.0 + f64::from(steps) * f64::EPSILON));
    let mut mesh = Mesh::new(3, points.len(), points.as_flattened(), 0).unwrap();
    mesh.set_triangles(&[5, 4, 13, 4, 13, 2, 13, 2, 8], None).unwrap();
    mesh.set_segments(&[10, 8], None).unwrap();
    let options = Options {
        criterion: Criterion::RadiusEdge,
        quality_bound: f64::INFINITY,
        extent: Extent::Hull,
        coplanar: 5.0,
        seed: 238,
        ..Options::default()
    };
    mesh.run(&options, None).unwrap();
    assert_holds(&mesh);
}

/// The tip of a flat cone, whose sides are one facet, touches a side of the box: the certificate
/// knew no angle at a vertex without lines.
#[test]
fn tips_of_bent_facets_force_simplices() {
    let mut points: Vec<[f64; 3]> = (0..6)
        .map(|side| {
            let (sine, cosine) = (f64::from(side) * std::f64::consts::FRAC_PI_3).sin_cos();
            [cosine, sine, 0.0]
        })
        .collect();
    points.extend([[0.0; 3], [0.09375, 0.0, 2f64.powi(-9)]]);
    let side = |at: u32| [at, (at + 1) % 6, 7, (at + 1) % 6, at, 6];
    let triangles: Vec<u32> = (0..6).flat_map(side).collect();
    let mut mesh = Mesh::new(3, points.len(), points.as_flattened(), 0).unwrap();
    mesh.set_triangles(&triangles, None).unwrap();
    let (criterion, extent, coplanar) = (Criterion::RadiusEdge, Extent::Box, 5.0);
    let options = Options { criterion, extent, coplanar, quality_bound: 2.0, ..Options::default() };
    mesh.run(&options, None).unwrap();
    assert!(!mesh.triangulation().unwrap().boundary.forced.is_empty());
    assert_holds(&mesh);
}
