//! Arrangements in space: pairs that meet, polygons, surfaces, and what they enclose.

use super::oracle;
use super::*;
use crate::error::ErrorKind;
use crate::mesh::IntersectionKind::{self, Cross, ZeroArea};
use crate::mesh::NONE;
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
        self.arranged_with(coplanar, Crossings::Refuse)
    }

    pub fn arranged_with(&self, coplanar: f64, crossings: Crossings) -> Result<Arrangement> {
        let Self { inputs, facets, segments } = self;
        let (regions, extent) = (&[][..], Extent::Auto);
        let task = TaskInSpace { inputs, facets, segments, regions, coplanar, extent, crossings };
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
        encloses_in_space(&self.inputs, &self.arrangement(), interior, &mut |_| Ok(())).unwrap()
    }
}

pub(super) fn pairs(found: &[Intersection]) -> Vec<(Feature, Feature, IntersectionKind)> {
    found.iter().map(|one| (one.first, one.second, one.kind)).collect()
}

pub(super) fn facet(number: u32) -> Feature {
    Feature::Facet(number)
}

pub(super) const CUBE: [[f64; 3]; 8] = [
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

pub(super) fn quads() -> Vec<Vec<Vec<u32>>> {
    SIDES_OF_CUBE.iter().map(|side| vec![side.to_vec()]).collect()
}

fn halves() -> Vec<[u32; 3]> {
    SIDES_OF_CUBE.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect()
}

/// All pairs of random soups of triangles and segments between points of a small lattice, some of
/// them given twice, are those of brute force in exact fractions. 10,000 soups if NETMESH_SLOW is
/// set.
#[test]
fn pairs_of_soups_are_those_of_exact_fractions() {
    let mut random = Random(3);
    let mut seen = [0; 4];
    let count = if std::env::var_os("NETMESH_SLOW").is_some() { 10_000 } else { 1500 };
    for trial in 0..count {
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
    for scale in [1.0, f64::from_bits(1), 1e-300, 1e300, f64::MAX] {
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
    // The order of the triangles around an edge is not that of their numbers.
    assert!(seeds(&[&[[0, 3, 4]], &tetrahedron[..]].concat(), &points));
    let backwards: Vec<[u32; 3]> = tetrahedron.iter().rev().copied().collect();
    assert!(seeds(&[&[[0, 3, 4]], &backwards[..]].concat(), &points));
    let open_with_wall = [&tetrahedron[..3], &[[0, 3, 4]]].concat();
    assert!(!seeds(&open_with_wall, &points));
    let case = Case::surface(&points, &with_wall);
    assert!(!case.encloses(Interior::Parity) && !case.encloses(Interior::Winding));
    let check = |case: &Case, interior| {
        check_closed_in_space(&case.inputs, &case.arrangement(), interior, &mut |_| Ok(()))
            .map_err(|error| error.message().to_owned())
    };
    assert_eq!(check(&case, Interior::Seeds), Ok(()));
    let parity = "the edge between input 0 and input 3 is one of 3 triangles; with \
                  options.interior = Interior::Parity that number must be even at every edge, so \
                  that all surfaces are closed";
    assert_eq!(check(&case, Interior::Parity).unwrap_err(), parity);
    let winding = check(&case, Interior::Winding).unwrap_err();
    assert!(
        winding.starts_with("2 triangles run from input 0 to input 3 and 1 back; with"),
        "{winding}"
    );
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
    let (regions, extent) = (&[][..], Extent::Auto);
    let crossings = Crossings::Refuse;
    let task = TaskInSpace { inputs, facets, segments, regions, coplanar: 0.0, extent, crossings };
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

/// Inputs that no facet has are on edges and facets nevertheless: exactly, or up to roundings. The
/// edges and facets go through them, and those elsewhere change nothing.
#[test]
fn edges_and_facets_go_through_inputs_on_them() {
    let mut points = CUBE.map(|x| x.map(|x| x + 1.0)).to_vec();
    let above = 1.0 + f64::EPSILON;
    points.extend([
        [1.5, 1.0, 1.0],
        [1.25, 1.0, above],
        [1.5, 1.75, 1.0],
        [1.25, 1.5, 2.0 + 2.0 * f64::EPSILON],
        [1.5; 3],
        [1.5, 1.5, 2.0],
        [1.5, 1.25, 1.0 + 1e-9],
        [1.5, 3.0, 1.0],
    ]);
    let surface = Case::surface(&points, &halves());
    let polygons = Case::polygons(&points, &quads());
    for case in [surface, polygons] {
        let made = case.arrangement();
        assert_eq!((made.facets.len(), made.subsegments.len()), (6, 14));
        let lines: Vec<[u32; 2]> = made.subsegments.iter().map(|line| line.ends).collect();
        for line in [[0, 9], [8, 9], [1, 8]] {
            assert!(lines.contains(&line), "{lines:?}");
        }
        let with = |vertex: u32| -> Vec<u32> {
            let own = made.triangles.iter().filter(|one| one.vertices.contains(&vertex));
            let mut facets: Vec<u32> = own.map(|one| one.facet).collect();
            facets.dedup();
            facets
        };
        assert_eq!(
            [8, 9, 10, 11, 13].map(with),
            [vec![0, 2], vec![0, 2], vec![0], vec![1], vec![1]]
        );
        assert_eq!([12, 14, 15].map(with), [vec![], vec![], vec![]] as [Vec<u32>; 3]);
        // Two more triangles for each vertex in a facet, and one on each side of an edge.
        assert_eq!(made.triangles.len(), 12 + 3 * 2 + 2 * 2);
        assert_eq!((made.near_inputs, made.farthest_near_input > 0.0), (2, true));
        assert!(
            encloses_in_space(&case.inputs, &made, Interior::Winding, &mut |_| Ok(())).unwrap()
        );
    }
    let segments = Case::polygons(&points, &quads()).with_segments(&[[1, 0], [0, 1], [12, 14]]);
    let made = segments.arrangement();
    let own: Vec<_> = made.subsegments.iter().map(|line| (line.ends, line.segment)).collect();
    assert_eq!(own[..4], [([1, 8], 0), ([8, 9], 0), ([9, 0], 0), ([12, 14], 2)]);
    assert_eq!(made.covered_segments, 1);
}

/// A facet that touches another in one place and goes through it in another crosses it, as is told.
#[test]
fn the_worst_meeting_of_two_facets_is_told() {
    let mut points = CUBE.to_vec();
    let comb =
        [[0.1, 1.5], [0.2, 0.0], [0.3, 1.5], [0.6, 1.5], [0.7, -1.0], [0.8, 1.5], [0.8, 2.0]];
    points.extend(comb.iter().map(|&[x, z]| [x, 0.3, z]));
    let plate = vec![vec![0, 1, 2, 3]];
    let comb = vec![(8..15).collect()];
    let found = Case::polygons(&points, &[plate, comb]).intersections();
    assert_eq!(pairs(&found), [(facet(0), facet(1), Cross)]);
}

/// A strip that turns by 8 degrees at each edge is no one plane within 10 degrees.
#[test]
fn facets_do_not_bend_further_than_the_angle() {
    let mut points = Vec::new();
    for k in 0..=6 {
        let angle = f64::from(8 * k).to_radians();
        points.extend([0.0, 1.0].map(|z| [10.0 * angle.cos(), 10.0 * angle.sin(), z]));
    }
    let strip: Vec<[u32; 3]> = (0..6)
        .flat_map(|k| [[2 * k, 2 * k + 2, 2 * k + 3], [2 * k, 2 * k + 3, 2 * k + 1]])
        .collect();
    let case = Case::surface(&points, &strip);
    let facets = |degrees: f64| case.arranged(degrees).unwrap().facets.len();
    assert_eq!(facets(0.0), 6);
    assert_eq!(facets(7.0), 6);
    assert!((2..=3).contains(&facets(10.0)), "{}", facets(10.0));
    assert_eq!(facets(60.0), 1);
}
