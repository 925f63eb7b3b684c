//! Arrangements compared with brute force by exact signs.

use super::*;
use crate::numerics::testing::{FAMILIES, Family, Random, points};
use crate::numerics::{Sign, crossing, orientation};
use std::collections::{BTreeMap, BTreeSet};

type Point = [f64; 2];

struct Case {
    inputs: Inputs,
    segments: Segments,
}

impl Case {
    /// Builds a case of points and segments between them; `None` if there are too few distinct
    /// points.
    fn new(points: &[Point], ends: &[[u32; 2]]) -> Option<Self> {
        let inputs = Inputs::new(2, points.len(), &points.concat(), 0).ok()?;
        let differ = |ends: &&[u32; 2]| {
            let [a, b] = ends.map(|end| inputs.vertices()[end as usize]);
            a != b
        };
        let ends: Vec<_> = ends.iter().filter(differ).copied().collect();
        let segments =
            Segments { markers: vec![0; ends.len()], inputs: ends, ..Segments::default() };
        Some(Self { inputs, segments })
    }

    fn random(family: Family, count: usize, segments: usize, random: &mut Random) -> Option<Self> {
        let points = points::<2>(family, count, random);
        let mut end = || random.integer(0, count as i64 - 1) as u32;
        let ends: Vec<_> = (0..segments).map(|_| [end(), end()]).collect();
        Self::new(&points, &ends)
    }

    fn vertices(&self) -> Vec<Point> {
        (0..self.inputs.distinct())
            .map(|v| self.inputs.distinct_point(v).try_into().unwrap())
            .collect()
    }

    fn ends(&self, segment: usize) -> [u32; 2] {
        self.segments.inputs[segment].map(|input| self.inputs.vertices()[input as usize])
    }

    fn run(&self, crossings: Crossings) -> Result<Arrangement> {
        self.arranged(crossings, &mut |_| Ok(()))
    }

    fn arranged(&self, crossings: Crossings, poll: Poll<'_>) -> Result<Arrangement> {
        let (inputs, segments) = (&self.inputs, &self.segments);
        let own = segments.count();
        arrange(
            &Task { inputs, segments, own, shared: &SharedVertices::default(), crossings },
            poll,
        )
    }
}

fn is_between(p: &Point, a: &Point, b: &Point) -> bool {
    let within = |k: usize| a[k].min(b[k]) <= p[k] && p[k] <= a[k].max(b[k]);
    within(0) && within(1)
}

/// Returns true if a point is strictly inside a segment.
fn is_on(p: &Point, a: &Point, b: &Point) -> bool {
    p != a && p != b && is_between(p, a, b) && orientation(&[a, b, p]) == Sign::Zero
}

fn do_cross(a: [&Point; 2], b: [&Point; 2]) -> bool {
    let sides = |p: [&Point; 2], q: [&Point; 2]| {
        orientation(&[p[0], p[1], q[0]]) * orientation(&[p[0], p[1], q[1]])
    };
    sides(a, b).is_negative() && sides(b, a).is_negative()
}

/// Returns the crossings of segments that are at no input, each rounded, after its two segments.
fn crossings_oracle(case: &Case) -> Vec<(usize, usize, Point)> {
    let vertices = case.vertices();
    let ends = |segment: usize| case.ends(segment).map(|v| &vertices[v as usize]);
    let mut found = Vec::new();
    for a in 0..case.segments.count() {
        for b in 0..a {
            let (p, q) = (ends(a), ends(b));
            let is_on_both = |v: &Point| is_on(v, p[0], p[1]) && is_on(v, q[0], q[1]);
            if do_cross(p, q) && !vertices.iter().any(is_on_both) {
                found.push((b, a, crossing([p, q]).unwrap()));
            }
        }
    }
    found
}

/// Returns the pieces of segments split at the inputs on them, from left to right, with the first
/// segment of each and its balance.
fn pieces_oracle(case: &Case) -> BTreeMap<[u32; 2], (u32, i64)> {
    let vertices = case.vertices();
    let mut pieces: BTreeMap<[u32; 2], (u32, i64)> = BTreeMap::new();
    for segment in (0..case.segments.count()).rev() {
        let [from, to] = case.ends(segment);
        let (a, b) = (&vertices[from as usize], &vertices[to as usize]);
        let mut on: Vec<u32> =
            (0..vertices.len() as u32).filter(|&v| is_on(&vertices[v as usize], a, b)).collect();
        on.extend([from, to]);
        on.sort_by(|&p, &q| vertices[p as usize].partial_cmp(&vertices[q as usize]).unwrap());
        for pair in on.windows(2) {
            let piece = pieces.entry([pair[0], pair[1]]).or_default();
            piece.0 = segment as u32;
            piece.1 += if on[0] == from { 1 } else { -1 };
        }
    }
    pieces
}

/// Checks that pieces meet only at their ends, and are in order.
fn check_is_arrangement(case: &Case, arrangement: &Arrangement) {
    let mut vertices = case.vertices();
    vertices.extend(&arrangement.crossings);
    let pieces = &arrangement.subsegments;
    let point = |v: u32| &vertices[v as usize];
    for (at, piece) in pieces.iter().enumerate() {
        let [a, b] = piece.ends.map(point);
        for v in &vertices {
            assert!(!is_on(v, a, b), "{v:?} is on {a:?} {b:?}");
        }
        for other in &pieces[..at] {
            let [c, d] = other.ends.map(point);
            assert!(!do_cross([a, b], [c, d]), "{a:?} {b:?} crosses {c:?} {d:?}");
            assert!([a, b] != [c, d] && [b, a] != [c, d], "{a:?} {b:?} is there twice");
        }
        let ends = case.ends(piece.segment as usize).map(point);
        let reach = Reach::of(ends);
        let place = |x: &Point| reach.position(x);
        assert!(
            place(ends[0]) <= place(a) && place(a) < place(b) && place(b) <= place(ends[1]),
            "{piece:?}: {a:?} {b:?}"
        );
        if at > 0 && pieces[at - 1].segment == piece.segment {
            let last = point(pieces[at - 1].ends[1]);
            assert!(place(last) <= place(a), "the order");
        }
        assert!(at == 0 || pieces[at - 1].segment <= piece.segment);
    }
    let distinct: BTreeSet<_> = vertices.iter().map(|p| p.map(|x| (x + 0.0).to_bits())).collect();
    assert_eq!(distinct.len(), vertices.len());
    for segment in 0..case.segments.count() {
        check_chain(case, arrangement, &vertices, segment);
    }
    check_balances(case, arrangement, vertices.len());
}

/// Checks balances: at each vertex the pieces that leave it, less those that reach it, are as many
/// as the segments that begin there, less those that end there.
fn check_balances(case: &Case, arrangement: &Arrangement, vertices: usize) {
    let mut left = vec![0; vertices];
    for &Subsegment { ends: [from, to], balance, .. } in &arrangement.subsegments {
        left[from as usize] += balance;
        left[to as usize] -= balance;
    }
    for segment in 0..case.segments.count() {
        let [from, to] = case.ends(segment);
        left[from as usize] -= 1;
        left[to as usize] += 1;
    }
    assert!(left.iter().all(|&left| left == 0), "{left:?}");
}

/// Checks that pieces in a segment's direction lead from its first end to its second.
fn check_chain(case: &Case, arrangement: &Arrangement, vertices: &[Point], segment: usize) {
    let ends = case.ends(segment);
    let [from, to] = ends.map(|v| &vertices[v as usize]);
    let reach = Reach::of([from, to]);
    let mut reached = BTreeSet::from([ends[0]]);
    loop {
        let before = reached.len();
        for piece in &arrangement.subsegments {
            for [a, b] in [piece.ends, [piece.ends[1], piece.ends[0]]] {
                let [p, q] = [a, b].map(|v| reach.position(&vertices[v as usize]));
                if reached.contains(&a) && p < q && q <= reach.position(to) {
                    reached.insert(b);
                }
            }
        }
        if reached.len() == before {
            break;
        }
    }
    assert!(reached.contains(&ends[1]), "segment {segment} has a gap");
}

#[test]
fn segments_without_crossings_are_cut_at_inputs_alone() {
    let (mut accepted, mut refused, mut near) = (0, 0, 0);
    for family in FAMILIES {
        let mut random = Random(family as u64 + 5000);
        for trial in 0..300 {
            let count = 3 + trial % 8;
            let Some(case) = Case::random(family, count, 1 + trial % 7, &mut random) else {
                continue;
            };
            let crossings = crossings_oracle(&case);
            match case.run(Crossings::Refuse) {
                Err(error) => {
                    refused += 1;
                    assert_eq!(error.kind(), ErrorKind::InvalidArgument);
                    let names = |&(a, b, [x, y]): &(usize, usize, Point)| {
                        let pair =
                            format!("segments[{a}] and segments[{b}] cross near ({x:?}, {y:?})");
                        error.message().starts_with(&pair)
                    };
                    assert!(crossings.iter().any(names), "{} {crossings:?}", error.message());
                }
                Ok(arrangement) => {
                    check_is_arrangement(&case, &arrangement);
                    if arrangement.near_inputs > 0 {
                        near += 1;
                        continue;
                    }
                    accepted += 1;
                    assert_eq!(crossings, [], "{family:?}");
                    let mut found = BTreeMap::new();
                    for &Subsegment { ends: [a, b], segment, balance } in &arrangement.subsegments {
                        let vertices = case.vertices();
                        match vertices[a as usize] < vertices[b as usize] {
                            true => found.insert([a, b], (segment, balance)),
                            false => found.insert([b, a], (segment, -balance)),
                        };
                    }
                    assert_eq!(found, pieces_oracle(&case), "{family:?}");
                    assert_eq!(found.len(), arrangement.subsegments.len());
                }
            }
        }
    }
    assert!(accepted > 1000 && refused > 500 && near < 400, "{accepted} {refused} {near}");
}

#[test]
fn crossings_become_vertices() {
    let mut split = 0;
    for family in FAMILIES {
        let mut random = Random(family as u64 + 6000);
        for trial in 0..120 {
            let count = 4 + trial % 12;
            let Some(case) = Case::random(family, count, 2 + trial % 11, &mut random) else {
                continue;
            };
            let arrangement = case.run(Crossings::Split).unwrap();
            check_is_arrangement(&case, &arrangement);
            let mut vertices = case.vertices();
            vertices.extend(&arrangement.crossings);
            for (a, b, point) in crossings_oracle(&case) {
                let reaches =
                    [a, b].map(|s| Reach::of(case.ends(s).map(|v| &vertices[v as usize])));
                // Segments that run along each other before they cross share vertices farther off.
                let goes_through = |reach: &Reach<2>, v: &Point| {
                    reach.ends.contains(v) || reach.is_beside(reach.ends.each_ref(), v)
                };
                let meet = |v: &Point| reaches.iter().all(|reach| goes_through(reach, v));
                split += usize::from(vertices.contains(&point));
                assert!(
                    vertices.contains(&point) || vertices.iter().any(meet),
                    "{family:?}: {a} and {b} cross at {point:?}"
                );
            }
        }
    }
    assert!(split > 2000, "{split}");
}

/// Overlapping segments on one line, and lattices of lines, are split at all of their ends.
#[test]
fn overlapping_segments_are_cut_at_all_ends() {
    let mut random = Random(17);
    for trial in 0..30 {
        let scale = 2f64.powi(random.integer(-1000, 1000) as i32);
        let side = 3 + trial % 3;
        let lattice: Vec<Point> = (0..side * side)
            .map(|i| [(i % side) as f64 * scale, (i / side) as f64 * scale])
            .collect();
        let mut end = || random.integer(0, lattice.len() as i64 - 1) as u32;
        let axis = |[a, b]: [u32; 2]| match trial % 2 {
            0 => a % side as u32 == b % side as u32 || a / side as u32 == b / side as u32,
            _ => true,
        };
        let count = if trial % 2 == 0 { 300 } else { 40 };
        let ends: Vec<_> = (0..count).map(|_| [end(), end()]).filter(|&ends| axis(ends)).collect();
        let case = Case::new(&lattice, &ends).unwrap();
        let arrangement = case.run(Crossings::Split).unwrap();
        check_is_arrangement(&case, &arrangement);
        if trial % 2 == 0 {
            assert_eq!(arrangement.subsegments.len(), pieces_oracle(&case).len());
            assert_eq!(arrangement.crossings, [] as [Point; 0]);
        }
    }
}

#[test]
fn counts_say_what_was_done() {
    // A square with both diagonals, one of them twice, and a segment on the other.
    let points = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [3.0, 3.0], [1.0, 1.0]];
    let ends = [[0, 2], [1, 3], [3, 1], [4, 5]];
    let case = Case::new(&points, &ends).unwrap();
    let message = case.run(Crossings::Refuse).unwrap_err().message().to_owned();
    let expected = "segments[0] and segments[1] cross near (2.0, 2.0), where no input is; \
                    with options.crossings = Crossings::Split they are split there";
    assert_eq!(message, expected);
    let arrangement = case.run(Crossings::Split).unwrap();
    assert_eq!(arrangement.crossings, [[2.0, 2.0]]);
    assert_eq!((arrangement.covered_segments, arrangement.near_inputs), (2, 0));
    let piece = |from, to, segment, balance| Subsegment { ends: [from, to], segment, balance };
    // Segments 2 and 3 run against those that they overlap.
    let first = [piece(0, 5, 0, 1), piece(5, 6, 0, 0), piece(6, 4, 0, 0), piece(4, 2, 0, 1)];
    assert_eq!(arrangement.subsegments[..4], first);
    assert_eq!(arrangement.subsegments[4..], [piece(1, 6, 1, 0), piece(6, 3, 1, 0)]);
}

/// Lines a few roundings apart are arranged: their crossings round onto each other and onto inputs.
#[test]
fn bundles_of_lines_end() {
    let mut random = Random(23);
    let ulp = f64::EPSILON;
    for trial in 0..40 {
        let count = 4 + trial % 16;
        let points: Vec<Point> = (0..2 * count)
            .map(|i| {
                let y = 1.0 + random.integer(-4, 4) as f64 * ulp;
                [if i % 2 == 0 { 1.0 } else { 1.0 + (1 << (trial % 5)) as f64 * ulp * 8.0 }, y]
            })
            .collect();
        let ends: Vec<_> = (0..count as u32).map(|i| [2 * i, 2 * i + 1]).collect();
        let case = Case::new(&points, &ends).unwrap();
        check_is_arrangement(&case, &case.run(Crossings::Split).unwrap());
    }
}

/// Chords of a circle, each of which crosses most others, poll for all their work.
#[test]
fn all_work_is_told_and_can_be_ended() {
    let count = 160;
    let angle = |i: usize| i as f64 * std::f64::consts::TAU / count as f64;
    let points: Vec<Point> = (0..count).map(|i| [angle(i).cos(), angle(i).sin()]).collect();
    let half = count as u32 / 2;
    let ends: Vec<_> = (0..half).map(|i| [i, i + half - 1 - i % 3]).collect();
    let case = Case::new(&points, &ends).unwrap();
    let arrange = |most: usize| {
        let (mut calls, mut work) = (0, 0);
        let mut poll = |done: u32| {
            (calls, work) = (calls + 1, work + done as usize);
            match calls < most {
                true => Ok(()),
                false => Err(Error::new(ErrorKind::Cancelled, "enough")),
            }
        };
        let result = case.arranged(Crossings::Split, &mut poll);
        (result, calls, work)
    };
    let (result, all, work) = arrange(usize::MAX);
    let crossings = result.unwrap().crossings.len();
    assert!(crossings > 2000 && all > crossings + count && work >= 8 * all, "{all} {work}");
    for most in [1, count / 2, count + 500, all] {
        let (result, calls, _) = arrange(most);
        assert_eq!((result.unwrap_err().kind(), calls), (ErrorKind::Cancelled, most));
    }
}
