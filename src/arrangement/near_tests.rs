//! Arrangements of points that programs compute on slanted segments, and of lines through nearly
//! one point.

use super::reach::{NEAR, Reach};
use super::*;
use crate::numerics::point_between;
use crate::numerics::testing::Random;

type Point = [f64; 2];

/// Returns a short decimal number with this many digits, as people write them.
fn decimal(random: &mut Random, digits: i32) -> f64 {
    random.integer(0, 10i64.pow(digits as u32 + 1)) as f64 / 10f64.powi(digits)
}

fn point(random: &mut Random) -> Point {
    [decimal(random, 1), decimal(random, 1)]
}

/// Returns a point of a segment as a program computes it in doubles, with all its roundings.
fn computed(a: &Point, b: &Point, part: f64) -> Point {
    [0, 1].map(|k| a[k] + part * (b[k] - a[k]))
}

fn arranged(points: &[Point], ends: &[[u32; 2]], crossings: Crossings) -> Result<Arrangement> {
    let inputs = Inputs::new(2, points.len(), points.as_flattened(), 0)?;
    let differ = |ends: &&[u32; 2]| points[ends[0] as usize] != points[ends[1] as usize];
    let ends: Vec<[u32; 2]> = ends.iter().filter(differ).copied().collect();
    let segments = Segments { markers: vec![0; ends.len()], inputs: ends, ..Segments::default() };
    let own = segments.count();
    let task = Task {
        inputs: &inputs,
        segments: &segments,
        own,
        shared: &SharedVertices::default(),
        crossings,
    };
    let arrangement = arrange(&task, &mut |_| Ok(()))?;
    check(&inputs, &segments, &arrangement);
    Ok(arrangement)
}

/// Checks that no vertex between the ends of a piece is near it, and that no end of a piece is
/// farther from its segment than twelve units.
fn check(inputs: &Inputs, segments: &Segments, arrangement: &Arrangement) {
    let mut vertices: Vec<Point> =
        (0..inputs.distinct()).map(|v| inputs.distinct_point(v).try_into().unwrap()).collect();
    vertices.extend(&arrangement.crossings);
    for piece in &arrangement.subsegments {
        let ends = segments.inputs[piece.segment as usize];
        let reach = Reach::of(ends.map(|end| &vertices[inputs.vertices()[end as usize] as usize]));
        let ends = piece.ends.map(|end| &vertices[end as usize]);
        for x in &vertices {
            let is_between = reach.position(ends[0]) < reach.position(x)
                && reach.position(x) < reach.position(ends[1]);
            assert!(!is_between || !reach.is_near(ends, x), "{x:?} is near {ends:?}");
        }
        assert!(ends.iter().all(|end| reach.offset_from_segment(end) <= 12.0));
    }
}

/// Returns true if the chain of the first segment goes through a vertex.
fn goes_through(arrangement: &Arrangement, vertex: u32) -> bool {
    let own = arrangement.subsegments.iter().filter(|piece| piece.segment == 0);
    own.into_iter().any(|piece| piece.ends.contains(&vertex))
}

#[test]
fn a_point_computed_on_a_segment_is_on_it() {
    let mut random = Random(40);
    let mut near = 0;
    for trial in 0..2000 {
        let (a, b) = (point(&mut random), point(&mut random));
        let x = computed(&a, &b, random.integer(1, 9) as f64 / 10.0);
        if [a, b].contains(&x) || a == b {
            continue;
        }
        let arrangement = arranged(&[a, b, x], &[[0, 1]], Crossings::Refuse).unwrap();
        assert!(goes_through(&arrangement, 2), "{trial}: {a:?} {b:?} {x:?}");
        near += arrangement.near_inputs;
        assert!(arrangement.farthest_near_input <= NEAR);
    }
    assert!(near > 500, "{near}");
}

/// Gaps that doubles have room for stay, as do those between short segments.
#[test]
fn a_gap_is_a_gap() {
    let (a, b) = ([1.0, 2.0], [4.0, 3.0]);
    let middle = point_between(&a, &b, 0.5);
    for steps in 0..40 {
        let x = [middle[0], (0..steps).fold(middle[1], |y, _| y.next_up())];
        let arrangement = arranged(&[a, b, x], &[[0, 1]], Crossings::Refuse).unwrap();
        // A unit of x is two of y, on a slope of a third: three units on both axes are five of y.
        assert_eq!(goes_through(&arrangement, 2), steps <= 5, "{steps}");
    }
    let ulp = f64::EPSILON;
    let lattice: Vec<Point> =
        (0..25).map(|i| [1.0 + f64::from(i % 5) * ulp, 1.0 + f64::from(i / 5) * ulp]).collect();
    let arrangement = arranged(&lattice, &[[0, 23], [4, 22]], Crossings::Refuse);
    assert!(arrangement.is_err_and(|error| error.message().contains("cross near")));
}

/// Vertices some units beside an upright or a level segment follow each other along it, though they
/// go back on the other axis, on which the segment is a few units long.
#[test]
fn vertices_follow_the_axis_on_which_a_segment_is_longest() {
    let unit = f64::EPSILON;
    let upright = [[1.0, 1.0], [1.0 + 2.0 * unit, 9.0], [1.0 + unit, 3.0], [1.0, 6.0]];
    for points in [upright, upright.map(|[x, y]| [y, x])] {
        for ends in [[0, 1], [1, 0]] {
            let arrangement = arranged(&points, &[ends], Crossings::Refuse).unwrap();
            let chain: Vec<[u32; 2]> =
                arrangement.subsegments.iter().map(|piece| piece.ends).collect();
            let mut expected = vec![[0, 2], [2, 3], [3, 1]];
            if ends == [1, 0] {
                expected.reverse();
                expected.iter_mut().for_each(|piece| piece.reverse());
            }
            assert_eq!(chain, expected, "{points:?}");
        }
    }
}

/// Segments that end some units beyond another segment or before it do not cross it, in both modes.
#[test]
fn junctions_are_no_crossings() {
    let mut random = Random(41);
    for _ in 0..500 {
        let (a, b) = (point(&mut random), point(&mut random));
        let mut points = vec![a, b];
        let mut ends = vec![[0, 1]];
        for quarter in 0..4 {
            let end = points.len() as u32;
            let part = (25 * quarter + random.integer(1, 24)) as f64 / 100.0;
            points.push(computed(&a, &b, part));
            let length = random.unit() + 2.0;
            let side = [b[1] - a[1], a[0] - b[0]].map(|step| step * length);
            points.push([points[end as usize][0] + side[0], points[end as usize][1] + side[1]]);
            ends.push([end, end + 1]);
        }
        if a != b {
            let arrangement = arranged(&points, &ends, Crossings::Refuse).unwrap();
            assert_eq!(arrangement.crossings, [] as [Point; 0]);
            assert!((2..10).step_by(2).all(|end| goes_through(&arrangement, end)));
        }
    }
}

/// Overlapping parts of one slanted line, each with its own ends, become one chain.
#[test]
fn overlaps_of_nearly_parallel_segments_are_one() {
    let mut random = Random(42);
    for _ in 0..500 {
        let (a, b) = (point(&mut random), point(&mut random));
        let count = random.integer(2, 7) as u32;
        let points: Vec<Point> =
            (0..2 * count).map(|_| computed(&a, &b, 0.5 + 0.5 * random.unit())).collect();
        let ends: Vec<_> = (0..count).map(|i| [2 * i, 2 * i + 1]).collect();
        if a != b {
            let arrangement = arranged(&points, &ends, Crossings::Refuse).unwrap();
            assert!(arrangement.subsegments.len() < points.len());
        }
    }
}

/// Three to eight lines through nearly one point have few vertices there.
#[test]
fn stars_have_few_vertices() {
    let mut random = Random(43);
    let (mut most, mut all) = (0, 0);
    for _ in 0..400 {
        let center = point(&mut random);
        let count = random.integer(3, 8) as u32;
        let points: Vec<Point> = (0..2 * count)
            .scan([0.0; 2], |way, i| {
                if i % 2 == 0 {
                    *way = [random.unit(), random.unit()];
                }
                let part = (random.unit() + 1.1) * if i % 2 == 0 { 1.0 } else { -1.0 };
                Some([0, 1].map(|k| center[k] + part * way[k]))
            })
            .collect();
        let ends: Vec<_> = (0..count).map(|i| [2 * i, 2 * i + 1]).collect();
        let crossings = arranged(&points, &ends, Crossings::Split).unwrap().crossings.len();
        (most, all) = (most.max(crossings), all + crossings);
    }
    assert!(most <= 2 && all <= 410, "{most} {all}");
}

#[test]
fn lines_go_through_the_vertex_that_their_crossings_were_refused_for() {
    // The second and the sixth cross each other 17 units away from (9.8, 3.6), and neither has an
    // accepted crossing with the other lines: those go through the vertex already.
    let points = [
        [6.775881577660504, 4.251865685005293],
        [12.167525421966062, 3.089666618358342],
        [10.283255820008428, 0.27296765361292685],
        [9.086914770202327, 8.509320337262267],
        [10.699862728974733, 0.5032821951833646],
        [8.878646405773923, 6.770674801725027],
        [12.48309020806749, 6.291817738418273],
        [7.891425956287834, 1.685217764761833],
        [9.386692851814958, 5.148922635194249],
        [11.089029794123636, -1.230807873334855],
        [8.912474038375477, 7.086584894116744],
        [10.518544357885709, 0.7772477512978906],
        [10.797656212901046, 5.283295662685081],
        [7.45095357100622, -0.3634290993618152],
        [9.660474772876384, -0.3001771640518016],
        [9.933214530586964, 7.323772975154061],
    ];
    let ends: Vec<_> = (0..8).map(|i| [2 * i, 2 * i + 1]).collect();
    let arrangement = arranged(&points, &ends, Crossings::Split).unwrap();
    assert_eq!(arrangement.crossings, [[9.8, 3.6]]);
}
