//! Arrangements in space: pairs that meet, polygons, surfaces, and what they enclose.

use super::oracle;
use super::*;
use crate::error::ErrorKind;
use crate::mesh::IntersectionKind::{self, Cross, Overlap, Touch, ZeroArea};
use crate::numerics::testing::Random;
use crate::options::Interior;

/// Inputs with facets and segments between them.
pub(super) struct Case {
    pub inputs: Inputs,
    pub facets: Facets,
    pub segments: Segments,
}

impl Case {
    pub fn surface(points: &[[f64; 3]], triangles: &[[u32; 3]]) -> Self {
        let loops: Vec<Vec<Vec<u32>>> = triangles.iter().map(|own| vec![own.to_vec()]).collect();
        let mut case = Self::polygons(points, &loops);
        case.facets.are_triangles = true;
        case
    }

    pub fn polygons(points: &[[f64; 3]], polygons: &[Vec<Vec<u32>>]) -> Self {
        let mut facets =
            Facets { loop_starts: vec![0], input_starts: vec![0], ..Facets::default() };
        for polygon in polygons {
            for own in polygon {
                facets.inputs.extend(own);
                facets.input_starts.push(facets.inputs.len() as u32);
            }
            facets.loop_starts.push(facets.input_starts.len() as u32 - 1);
            facets.markers.push(0);
        }
        let inputs = Inputs::new(3, points.len(), points.as_flattened(), 0).unwrap();
        Self { inputs, facets, segments: Segments::default() }
    }

    pub fn with_segments(mut self, segments: &[[u32; 2]]) -> Self {
        self.segments.inputs = segments.to_vec();
        self.segments.markers = vec![0; segments.len()];
        self
    }

    pub fn intersections(&self) -> Vec<Intersection> {
        find_intersections(&self.inputs, &self.facets, &self.segments, &mut |_| Ok(())).unwrap()
    }

    pub fn arranged(&self, coplanar: f64) -> Result<Arrangement> {
        let Self { inputs, facets, segments } = self;
        let task = TaskInSpace { inputs, facets, segments, regions: &[], coplanar };
        arrange_in_space(&task, &mut |_| Ok(()))
    }

    pub fn arrangement(&self) -> Arrangement {
        self.arranged(0.0).unwrap()
    }

    pub fn refusal(&self) -> String {
        let error = self.arranged(0.0).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::InvalidArgument);
        error.message().to_owned()
    }

    fn encloses(&self, interior: Interior) -> bool {
        encloses_in_space(&self.inputs, &self.arrangement(), interior).unwrap()
    }
}

fn pairs(found: &[Intersection]) -> Vec<(Feature, Feature, IntersectionKind)> {
    found.iter().map(|one| (one.first, one.second, one.kind)).collect()
}

fn facet(number: u32) -> Feature {
    Feature::Facet(number)
}

const CUBE: [[f64; 3]; 8] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [1.0, 1.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 1.0],
    [1.0, 1.0, 1.0],
    [0.0, 1.0, 1.0],
];

const SIDES_OF_CUBE: [[u32; 4]; 6] =
    [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];

fn quads() -> Vec<Vec<Vec<u32>>> {
    SIDES_OF_CUBE.iter().map(|side| vec![side.to_vec()]).collect()
}

fn halves() -> Vec<[u32; 3]> {
    SIDES_OF_CUBE.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect()
}

/// All pairs of random soups of triangles and segments between points of a small lattice, some of
/// them given twice, are those of brute force in exact fractions.
#[test]
fn pairs_of_soups_are_those_of_exact_fractions() {
    let mut random = Random(3);
    let mut seen = [0; 4];
    for trial in 0..1500 {
        let width = 1 + trial % 4;
        let points: Vec<[f64; 3]> =
            (0..9).map(|_| std::array::from_fn(|_| random.integer(0, width) as f64)).collect();
        if points.iter().all(|x| *x == points[0]) {
            continue;
        }
        let mut vertex = || random.integer(0, 8) as u32;
        let triangles: Vec<[u32; 3]> = (0..7).map(|_| [vertex(), vertex(), vertex()]).collect();
        let mut segments: Vec<[u32; 2]> = (0..4).map(|_| [vertex(), vertex()]).collect();
        segments.retain(|&[a, b]| points[a as usize] != points[b as usize]);
        let case = Case::surface(&points, &triangles).with_segments(&segments);
        let found = pairs(&case.intersections());
        let expected = pairs_of_fractions(&case);
        expected.iter().for_each(|&(_, _, kind)| seen[usize::from(kind.rank())] += 1);
        assert_eq!(found, expected, "{points:?} {triangles:?} {segments:?}");
    }
    assert!(seen.iter().all(|&count| count > 200), "{seen:?}");
}

fn pairs_of_fractions(case: &Case) -> Vec<(Feature, Feature, IntersectionKind)> {
    let points = points_of(&case.inputs).unwrap();
    let vertex = |input: &u32| case.inputs.vertices()[*input as usize];
    let triangles = case.facets.inputs.chunks(3).zip(0..).map(|(own, at)| (own, facet(at)));
    let segments = case.segments.inputs.iter().zip(0..);
    let segments = segments.map(|(own, at)| (&own[..], Feature::Segment(at)));
    let all: Vec<(Vec<u32>, Feature)> =
        triangles.chain(segments).map(|(own, at)| (own.iter().map(vertex).collect(), at)).collect();
    let is_flat = |own: &[u32]| own.len() == 3 && oracle::is_flat(&points, own);
    let mut found = Vec::new();
    for (at, (own, feature)) in all.iter().enumerate() {
        if is_flat(own) {
            found.push((*feature, *feature, ZeroArea));
            continue;
        }
        for (other, second) in all[at + 1..].iter().filter(|(other, _)| !is_flat(other)) {
            let kind = oracle::kind(&points, own, other);
            found.extend(kind.map(|kind| (*feature, *second, kind)));
        }
    }
    found.sort_by_key(|&(first, second, _)| (first, second));
    found
}

#[test]
fn a_cube_has_six_facets_and_twelve_lines_at_all_scales() {
    for scale in [1.0, 2f64.powi(-1074), 1e-300, 1e300, f64::MAX] {
        let points = CUBE.map(|x| x.map(|x| x * scale));
        let surface = Case::surface(&points, &halves()).arrangement();
        let polygons = Case::polygons(&points, &quads()).arrangement();
        for made in [&surface, &polygons] {
            assert_eq!((made.facets.len(), made.triangles.len()), (6, 12));
            assert_eq!(made.subsegments.len(), 12);
            assert!(made.triangles.is_sorted_by_key(|triangle| triangle.facet));
            assert!(made.facets.iter().all(|facet| facet.balance == 1));
        }
        let parents: Vec<u32> = surface.facets.iter().map(|facet| facet.parent).collect();
        assert_eq!(parents, [0, 2, 4, 6, 8, 10]);
        let parents: Vec<u32> = polygons.facets.iter().map(|facet| facet.parent).collect();
        assert_eq!(parents, [0, 1, 2, 3, 4, 5]);
        for interior in [Interior::Seeds, Interior::Parity, Interior::Winding] {
            assert!(Case::polygons(&points, &quads()).encloses(interior));
        }
    }
}

/// Triangles with other markers stay apart.
#[test]
fn markers_keep_triangles_apart() {
    let mut case = Case::surface(&CUBE, &halves());
    case.facets.markers[1] = 5;
    let made = case.arrangement();
    assert_eq!((made.facets.len(), made.subsegments.len()), (7, 13));
}

#[test]
fn triangles_of_polygons_turn_as_their_first_loops() {
    let made = Case::polygons(&CUBE, &quads()).arrangement();
    // The volume by the divergence theorem: positive as normals point outwards.
    let volume: f64 = made.triangles.iter().map(|own| signed_volume(own.vertices)).sum();
    assert_eq!(volume, 6.0);
    let mut turned = quads();
    turned.iter_mut().for_each(|polygon| polygon[0].reverse());
    let made = Case::polygons(&CUBE, &turned).arrangement();
    let volume: f64 = made.triangles.iter().map(|own| signed_volume(own.vertices)).sum();
    assert_eq!(volume, -6.0);
}

fn signed_volume(triangle: [u32; 3]) -> f64 {
    let [a, b, c] = triangle.map(|vertex| CUBE[vertex as usize]);
    let minor = |k: usize| b[(k + 1) % 3] * c[(k + 2) % 3] - b[(k + 2) % 3] * c[(k + 1) % 3];
    (0..3).map(|k| a[k] * minor(k)).sum()
}

/// A plate with a hole, an inner segment and an inner vertex, in a plane that no axis is parallel
/// to, where the hole holds an island.
#[test]
fn polygons_have_holes_islands_segments_and_vertices() {
    let plane: [[f64; 2]; 15] = [
        [0.0, 0.0],
        [8.0, 0.0],
        [8.0, 8.0],
        [0.0, 8.0],
        [2.0, 2.0],
        [6.0, 2.0],
        [6.0, 6.0],
        [2.0, 6.0],
        [3.0, 3.0],
        [5.0, 3.0],
        [5.0, 5.0],
        [3.0, 5.0],
        [1.0, 1.0],
        [7.0, 1.0],
        [7.0, 7.0],
    ];
    let tilts: [fn(f64, f64) -> [f64; 3]; 3] = [
        |x, y| [x, y, 2.0 * x - 3.0 * y],
        |x, y| [x + 4.0 * y, 8.0 * x - y, x],
        |x, y| [1.0 - x, 5.0, y],
    ];
    for tilt in tilts {
        let points = plane.map(|[x, y]| tilt(x, y));
        let plate =
            vec![vec![0, 1, 2, 3], vec![4, 5, 6, 7], vec![11, 10, 9, 8], vec![12, 13], vec![14]];
        let made = Case::polygons(&points, &[plate]).arrangement();
        let area = |own: &FacetTriangle| {
            let [a, b, c] = own.vertices.map(|vertex| plane[vertex as usize]);
            (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        };
        assert!(made.triangles.iter().all(|own| area(own) > 0.0));
        assert_eq!(made.triangles.iter().map(area).sum::<f64>(), 2.0 * (64.0 - 16.0 + 4.0));
        assert!(made.triangles.iter().any(|own| own.vertices.contains(&14)));
        let mut lines: Vec<[u32; 2]> = made.subsegments.iter().map(|line| line.ends).collect();
        let mut expected: Vec<[u32; 2]> = (0..3u32)
            .flat_map(|at| (0..4).map(move |k| [4 * at + k, 4 * at + (k + 1) % 4]))
            .chain([[12, 13]])
            .map(|[a, b]| [a.min(b), a.max(b)])
            .collect();
        lines.sort_unstable();
        expected.sort_unstable();
        assert_eq!(lines, expected);
        assert!(made.subsegments.iter().all(|line| line.segment == NONE));
    }
}

/// Random polygons that are stars about a point: the area of their triangles is that of the loop,
/// all edges of the loop are there, and no vertex is inside a triangle.
#[test]
fn triangles_tile_polygons() {
    let mut random = Random(11);
    for trial in 0..200 {
        let count = 3 + trial % 40;
        let mut angles: Vec<f64> =
            (0..count).map(|_| random.unit() * std::f64::consts::PI).collect();
        angles.sort_by(f64::total_cmp);
        angles.dedup();
        let widest = angles
            .windows(2)
            .map(|two| two[1] - two[0])
            .fold(2.0 * std::f64::consts::PI + angles[0] - angles[angles.len() - 1], f64::max);
        if angles.len() < 3 || widest > 3.0 {
            continue;
        }
        let scale = (1u64 << 40) as f64;
        let points: Vec<[f64; 3]> = angles
            .iter()
            .map(|angle| {
                let radius = 2.0 + random.unit();
                let [x, y] = [angle.cos(), angle.sin()].map(|x| (radius * x * scale).round());
                [x, x - y, y]
            })
            .collect();
        let own: Vec<u32> = (0..points.len() as u32).collect();
        let made = Case::polygons(&points, &[vec![own.clone()]]).arrangement();
        let area = |a: u32, b: u32, c: u32| {
            let [a, b, c] = [a, b, c].map(|v| points[v as usize].map(|x| x as i128));
            (b[0] - a[0]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[0] - a[0])
        };
        let mut total = 0;
        for FacetTriangle { vertices: [a, b, c], .. } in &made.triangles {
            assert!(area(*a, *b, *c) > 0);
            total += area(*a, *b, *c);
            let is_in =
                |v: &u32| area(*a, *b, *v) > 0 && area(*b, *c, *v) > 0 && area(*c, *a, *v) > 0;
            assert!(!own.iter().any(is_in));
        }
        let last = own.len() as u32 - 1;
        let expected: i128 = (1..last).map(|v| area(0, v, v + 1)).sum();
        assert_eq!(total, expected);
        assert_eq!(made.triangles.len(), own.len() - 2);
        assert_eq!(made.subsegments.len(), own.len());
    }
}

#[test]
fn loops_that_meet_are_refused() {
    let square = [[0.0, 0.0, 1.0], [4.0, 0.0, 1.0], [4.0, 4.0, 1.0], [0.0, 4.0, 1.0]];
    let with = |more: &[[f64; 3]]| [&square[..], more].concat();
    let bow = Case::polygons(&square, &[vec![vec![0, 2, 1, 3]]]);
    assert_eq!(pairs(&bow.intersections()), [(facet(0), facet(0), Cross)]);
    assert_eq!(bow.intersections()[0].point, [2.0, 2.0, 1.0]);
    assert_eq!(
        bow.refusal(),
        "facets[0] crosses itself near (2, 2, 1); facets and segments may meet only in vertices and \
         edges of both"
    );
    let touching = with(&[[2.0, 0.0, 1.0], [3.0, 1.0, 1.0], [1.0, 1.0, 1.0]]);
    let touching = Case::polygons(&touching, &[vec![vec![0, 1, 2, 3], vec![4, 5, 6]]]);
    assert_eq!(pairs(&touching.intersections()), [(facet(0), facet(0), Touch)]);
    assert_eq!(touching.intersections()[0].point, [2.0, 0.0, 1.0]);
    let along = with(&[[1.0, 0.0, 1.0], [3.0, 0.0, 1.0], [2.0, 1.0, 1.0]]);
    let along = Case::polygons(&along, &[vec![vec![0, 1, 2, 3], vec![4, 5, 6]]]);
    assert_eq!(pairs(&along.intersections()), [(facet(0), facet(0), Overlap)]);
    let vertex = with(&[[2.0, 0.0, 1.0]]);
    let vertex = Case::polygons(&vertex, &[vec![vec![0, 1, 2, 3], vec![4]]]);
    assert_eq!(pairs(&vertex.intersections()), [(facet(0), facet(0), Touch)]);
    assert_eq!(vertex.intersections()[0].point, [2.0, 0.0, 1.0]);
    let line = [[0.0; 3], [1.0, 2.0, 3.0], [2.0, 4.0, 6.0], [-1.0, -2.0, -3.0]];
    let line = Case::polygons(&line, &[vec![vec![0, 1, 2, 3]]]);
    assert_eq!(pairs(&line.intersections()), [(facet(0), facet(0), ZeroArea)]);
    assert!(line.refusal().starts_with("facets[0] has no area near (0, 0, 0);"));
}

/// A wall on the diagonal by which a side of the cube is split is a fault of the facets, whatever
/// the triangles of the side are, unless the side has the wall's edge.
#[test]
fn diagonals_of_a_facet_are_its_interior() {
    let mut points = CUBE.to_vec();
    points.extend([[0.0, 0.0, -1.0], [1.0, 1.0, -1.0], [0.5, 0.5, 2.0], [0.25, 0.25, -1.0]]);
    for first in 0..4 {
        let mut polygons = quads();
        polygons[0][0].rotate_left(first);
        let mut case = polygons.clone();
        // Through the plate, along a part of its diagonal.
        case.push(vec![vec![8, 9, 10]]);
        let found = pairs(&Case::polygons(&points, &case).intersections());
        assert!(found.contains(&(facet(0), facet(6), Cross)), "{found:?}");
        // Standing on the plate's diagonal, by number: the plate gets it as an edge.
        polygons.push(vec![vec![0, 2, 9, 8]]);
        let made = Case::polygons(&points, &polygons).arrangement();
        assert_eq!((made.triangles.len(), made.subsegments.len()), (14, 12 + 4));
    }
}

#[test]
fn segments_are_lines() {
    let mut points = CUBE.to_vec();
    points.extend([[0.25, 0.5, 0.5], [0.75, 0.5, 0.5]]);
    let segments = [[9, 8], [6, 5], [5, 6], [0, 2]];
    let made = Case::polygons(&points, &quads()).with_segments(&segments).arrangement();
    let own: Vec<_> = made.subsegments.iter().map(|line| (line.ends, line.segment)).collect();
    assert_eq!(own[..3], [([9, 8], 0), ([6, 5], 1), ([0, 2], 3)]);
    assert_eq!((own.len(), made.covered_segments), (14, 1));
    assert!(own[3..].iter().all(|&(_, segment)| segment == NONE));
    let through =
        Case::polygons(&points, &quads()).with_segments(&[[8, 0], [6, 8], [8, 4], [9, 4]]);
    assert_eq!(through.intersections(), []);
    let crossing = Case::polygons(&points, &quads()).with_segments(&[[0, 6], [1, 7]]);
    let found = crossing.intersections();
    let expected = (Feature::Segment(0), Feature::Segment(1), Cross);
    assert_eq!((pairs(&found), found[0].point), (vec![expected], [0.5; 3]));
    assert!(
        crossing.refusal().starts_with("segments[0] and segments[1] cross near (0.5, 0.5, 0.5);")
    );
}

/// A facet of two inputs is a segment.
#[test]
fn facets_of_two_inputs_are_lines() {
    let mut points = CUBE.to_vec();
    points.extend([[0.25, 0.5, 0.5], [0.75, 0.5, 0.5], [0.5, 0.5, 0.25], [0.5, 0.5, 0.75]]);
    let mut polygons = quads();
    polygons.push(vec![vec![8, 9]]);
    let made = Case::polygons(&points, &polygons).arrangement();
    assert!(made.subsegments.iter().any(|line| (line.ends, line.segment) == ([8, 9], NONE)));
    polygons[6].push(vec![10, 11]);
    let found = Case::polygons(&points, &polygons).intersections();
    assert_eq!(pairs(&found), [(facet(6), facet(6), Cross)]);
}

#[test]
fn polygons_off_a_plane_are_refused_by_name() {
    let mut points = CUBE;
    points[2][2] = 0.25;
    let case = Case::polygons(&points, &quads());
    let message = case.refusal();
    assert!(message.starts_with("facets[0] is not plane: its input "), "{message}");
    // The plane bends by more than 10 degrees and less than 40 there.
    assert!(case.arranged(10.0).is_err());
    assert_eq!(case.arranged(40.0).unwrap().facets.len(), 6);
    // Roundings are no fault.
    for ulps in [-3i64, -1, 1, 3] {
        let mut points = CUBE.map(|x| x.map(|x| x + 1.0));
        points[2][2] = f64::from_bits(points[2][2].to_bits().wrapping_add_signed(ulps));
        assert_eq!(Case::polygons(&points, &quads()).arrangement().facets.len(), 6);
    }
    let mut points = CUBE.map(|x| x.map(|x| x + 1.0));
    points[2][2] = f64::from_bits(points[2][2].to_bits() + 40);
    assert!(Case::polygons(&points, &quads()).refusal().contains("is not plane"));
}

#[test]
fn surfaces_enclose_what_they_divide() {
    let tetrahedron = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let mut points = vec![[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0]];
    let seeds = |triangles: &[[u32; 3]], points: &[[f64; 3]]| {
        Case::surface(points, triangles).encloses(Interior::Seeds)
    };
    assert!(seeds(&tetrahedron, &points));
    assert!(!seeds(&tetrahedron[..3], &points));
    // Three pages at an edge, and four, enclose nothing; nor does a wall beside a closed surface
    // change what that does.
    points.extend([[-4.0, -4.0, 1.0], [1.0, 1.0, -4.0], [4.0, 4.0, 4.0]]);
    assert!(!seeds(&[[0, 3, 1], [0, 3, 2], [0, 3, 4]], &points));
    assert!(!seeds(&[[0, 3, 1], [0, 3, 2], [0, 3, 4], [0, 3, 6]], &points));
    let with_wall = [&tetrahedron[..], &[[0, 3, 4]]].concat();
    assert!(seeds(&with_wall, &points));
    let open_with_wall = [&tetrahedron[..3], &[[0, 3, 4]]].concat();
    assert!(!seeds(&open_with_wall, &points));
    let case = Case::surface(&points, &with_wall);
    assert!(!case.encloses(Interior::Parity) && !case.encloses(Interior::Winding));
    let check = |case: &Case, interior| {
        check_closed_in_space(&case.inputs, &case.arrangement(), interior)
            .map_err(|error| error.message().to_owned())
    };
    assert_eq!(check(&case, Interior::Seeds), Ok(()));
    let parity = "the edge between inputs 0 and 3 is one of 3 triangles; with options.interior = \
                  Interior::Parity that number must be even at every edge, so that all surfaces are \
                  closed";
    assert_eq!(check(&case, Interior::Parity).unwrap_err(), parity);
    let winding = check(&case, Interior::Winding).unwrap_err();
    assert!(winding.starts_with("2 triangles run from input 0 to 3 and 1 back; with"), "{winding}");
    let closed = Case::surface(&points, &tetrahedron);
    for interior in [Interior::Parity, Interior::Winding] {
        assert_eq!(check(&closed, interior), Ok(()));
        assert!(closed.encloses(interior));
    }
    // A triangle that is turned spoils the winding alone.
    let turned = Case::surface(&points, &[[0, 1, 2], [0, 1, 3], [1, 2, 3], [2, 0, 3]]);
    assert!(turned.encloses(Interior::Parity) && !turned.encloses(Interior::Winding));
}

/// Two tetrahedra at a common edge or vertex, and one divided by a wall.
#[test]
fn surfaces_that_share_edges_enclose() {
    let points = [
        [0.0, 0.0, -1.0],
        [0.0, 0.0, 1.0],
        [2.0, 1.0, 0.0],
        [2.0, -1.0, 0.0],
        [-2.0, 1.0, 0.0],
        [-2.0, -1.0, 0.0],
    ];
    let right = [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]];
    let left = [[0, 1, 4], [0, 1, 5], [0, 4, 5], [1, 4, 5]];
    let both = [right, left].concat();
    for missing in 0..8 {
        let mut open = both.clone();
        open.remove(missing);
        assert!(Case::surface(&points, &open).encloses(Interior::Seeds));
        open.remove((missing + 4) % 8 - usize::from(missing < 4));
        assert!(!Case::surface(&points, &open).encloses(Interior::Seeds), "{open:?}");
    }
    assert!(Case::surface(&points, &both).encloses(Interior::Parity));
}

#[test]
fn a_poll_may_end_the_work() {
    let case = Case::surface(&CUBE, &halves());
    let Case { inputs, facets, segments } = &case;
    let task = TaskInSpace { inputs, facets, segments, regions: &[], coplanar: 0.0 };
    let mut polls = 0;
    arrange_in_space(&task, &mut |_| {
        polls += 1;
        Ok(())
    })
    .unwrap();
    for last in 0..polls {
        let mut left = last;
        let result = arrange_in_space(&task, &mut |_| {
            left -= 1;
            if left < 0 { Err(crate::Error::new(ErrorKind::Cancelled, "ended")) } else { Ok(()) }
        });
        assert_eq!(result.unwrap_err().kind(), ErrorKind::Cancelled);
    }
}
