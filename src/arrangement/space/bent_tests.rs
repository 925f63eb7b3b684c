//! Polygons that are not plane, as triangles: the axis along which they are seen.

use super::tests::Case;
use super::{bent_polygon, triangulate};
use crate::error::Result;
use crate::mesh::FacetTriangulation;
use crate::numerics::testing::Random;

fn triangulated(points: &[[f64; 3]], polygons: &[Vec<Vec<u32>>]) -> Result<FacetTriangulation> {
    let case = Case::polygons(points, polygons);
    triangulate(&case.inputs, &case.facets, &mut |_| Ok(()))
}

/// Loop of integers seen along an axis.
struct Seen(Vec<[i64; 2]>);

impl Seen {
    fn along(axis: usize, points: &[[f64; 3]]) -> Self {
        let image = |x: &[f64; 3]| [1, 2].map(|step| x[(axis + step) % 3] as i64);
        Self(points.iter().map(image).collect())
    }

    fn turn(&self, corners: [usize; 3]) -> i64 {
        let [a, b, c] = corners.map(|corner| self.0[corner]);
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    }

    /// Returns true if a point is on the edge between two others, ends included.
    fn is_on(&self, [a, b]: [usize; 2], x: usize) -> bool {
        let [p, q, r] = [a, b, x].map(|corner| self.0[corner]);
        let is_between = |k: usize| p[k].min(q[k]) <= r[k] && r[k] <= p[k].max(q[k]);
        self.turn([a, b, x]) == 0 && is_between(0) && is_between(1)
    }

    /// Returns true if no two edges of the loop have more in common than a vertex of both.
    fn is_simple(&self) -> bool {
        let count = self.0.len();
        let edge = |at: usize| [at, (at + 1) % count];
        (0..count).all(|i| {
            let [a, b] = edge(i);
            let others = (0..count).filter(|corner| ![a, b].contains(corner));
            let is_free = others.clone().all(|corner| !self.is_on([a, b], corner));
            let crosses = |j: usize| {
                let [c, d] = edge(j);
                let sides = |[p, q]: [usize; 2], [r, s]: [usize; 2]| {
                    self.turn([p, q, r]).signum() * self.turn([p, q, s]).signum()
                };
                sides([a, b], [c, d]) < 0 && sides([c, d], [a, b]) < 0
            };
            self.0[a] != self.0[b] && is_free && !(0..count).any(crosses)
        })
    }

    /// Returns true if triangles tile the loop.
    fn is_tiled_by(&self, triangles: &[[u32; 3]]) -> bool {
        let turns = triangles.iter().map(|own| self.turn(own.map(|corner| corner as usize)));
        let last = self.0.len() - 1;
        let area: i64 = (1..last).map(|at| self.turn([0, at, at + 1])).sum();
        let is_turned_alike = turns.clone().all(|turn| turn.signum() == area.signum());
        is_turned_alike && turns.sum::<i64>() == area
    }
}

/// Random loops become triangles exactly if they are simple seen along some axis, by brute force,
/// and the triangles tile them there.
#[test]
fn loops_are_seen_along_the_axis_that_shows_them_whole() {
    let mut random = Random(23);
    let (mut seen, mut refused) = ([0; 4], 0);
    for trial in 0..6000 {
        let count = 4 + trial % 4;
        let points: Vec<[f64; 3]> =
            (0..count).map(|_| [0; 3].map(|_: i32| random.integer(0, 5) as f64)).collect();
        let views: Vec<Seen> = (0..3).map(|axis| Seen::along(axis, &points)).collect();
        let loops = vec![vec![(0..count as u32).collect::<Vec<u32>>()]];
        let case = Case::polygons(&points, &loops);
        let is_bent = bent_polygon(&case.inputs, &case.facets, 0.0, &mut |_| Ok(())).unwrap();
        if is_bent.is_none() || case.inputs.duplicates() > 0 {
            continue;
        }
        let simple = views.iter().filter(|view| view.is_simple()).count();
        match triangulated(&points, &loops) {
            Ok(found) => {
                assert!(simple > 0, "{points:?}");
                assert_eq!((found.triangles.len(), found.without_area), (count - 2, 0));
                let is_tiled = |view: &Seen| view.is_simple() && view.is_tiled_by(&found.triangles);
                assert!(views.iter().any(is_tiled), "{points:?} {found:?}");
                seen[simple] += 1;
            }
            Err(error) => {
                assert_eq!(simple, 0, "{points:?}: {error}");
                let message = error.message();
                assert!(message.starts_with("facets[0] is not plane, and "), "{message}");
                assert!(message.contains(" itself seen along each axis, "), "{message}");
                refused += 1;
            }
        }
    }
    assert!(seen[1..].iter().all(|&count| count > 100) && refused > 100, "{seen:?} {refused}");
}

/// The outer loop of a polygon with a hole decides, whichever comes first and however they turn.
#[test]
fn the_largest_loop_decides() {
    // A plate that stands up at one corner, with a hole that is steeper than the plate.
    let plate = [[0.0, 0.0, 0.0], [8.0, 0.0, 0.0], [8.0, 8.0, 3.0], [0.0, 8.0, 0.0]];
    let hole = [[2.0, 2.0, 0.0], [3.0, 2.0, 0.0], [3.0, 3.0, 7.0], [2.0, 3.0, 7.0]];
    let points = [plate, hole].concat();
    let outer: Vec<u32> = vec![0, 1, 2, 3];
    for inner in [vec![4, 5, 6, 7], vec![7, 6, 5, 4]] {
        for loops in [vec![outer.clone(), inner.clone()], vec![inner.clone(), outer.clone()]] {
            let found = triangulated(&points, &[loops]).unwrap();
            let views = Seen::along(2, &points);
            let turns = found.triangles.iter().map(|own| views.turn(own.map(|v| v as usize)));
            assert_eq!((turns.sum::<i64>().abs(), found.triangles.len()), (2 * (64 - 1), 8));
        }
    }
}

/// Polygons without an area are triangles without one, with the numbers of their facets; a segment
/// within is refused, by the facet's name.
#[test]
fn polygons_without_an_area_are_triangles_without_one() {
    let points = [
        [0.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
        [2.0, 2.0, 0.5],
        [0.0, 2.0, 0.0],
        [1.0, 0.0, 0.0],
        [3.0, 3.0, 3.0],
    ];
    let bent = vec![vec![0, 1, 2, 3]];
    let (on_a_line, spike) = (vec![vec![0, 4, 1]], vec![vec![0, 1, 5, 1]]);
    let all = [on_a_line.clone(), bent.clone(), spike.clone(), bent.clone()];
    let found = triangulated(&points, &all).unwrap();
    assert_eq!(found.parents, [0, 1, 1, 2, 3, 3]);
    assert_eq!(found.without_area, 2);
    assert_eq!((found.triangles[0], found.triangles[3]), ([0, 4, 1], [0, 1, 1]));
    for (polygons, facet) in [
        ([bent.clone(), vec![vec![0, 4, 1], vec![0, 4]]], 1),
        ([vec![vec![0, 1, 2, 3], vec![0, 2]], bent.clone()], 0),
    ] {
        let message = triangulated(&points, &polygons).unwrap_err().message().to_owned();
        let rule = "has segments within, which triangles would not keep";
        assert_eq!(message, format!("facets[{facet}] {rule}"));
    }
}
