//! The convex hull of points in space, by C. B. Barber, D. P. Dobkin and H. Huhdanpaa, "The
//! quickhull algorithm for convex hulls", 1996: points beyond a triangle are on its list, and the one
//! that is farthest becomes a vertex, in front of all triangles that see it. Signs are exact, so that
//! the triangles are always those of a convex hull.
//!
//! Points that are beyond a triangle by no more than rounding explains may be left out: the sides of
//! a solid that was turned are plane then.

use super::plane::{Gauge, Plane, units_of};
use crate::arrangement::poll::Poll;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow, collected};
use crate::mesh::NONE;
use crate::numerics::orientation;

/// Number of tests for which a poll counts one unit of work.
const TESTS_OF_A_POLL: u32 = 16;

/// Triangle of the hull, counterclockwise from outside.
struct HullTriangle {
    vertices: [u32; 3],
    /// Triangles opposite each vertex.
    neighbors: [u32; 3],
    /// Points beyond the triangle.
    beyond: Vec<u32>,
    is_live: bool,
}

/// Convex hull in the making.
struct Maker<'a> {
    points: &'a [[f64; 3]],
    /// Point -> true if it becomes a vertex wherever it is beyond a triangle.
    must: Option<&'a [bool]>,
    all: Vec<HullTriangle>,
    /// Triangles that may have a point far enough beyond them.
    waiting: Vec<u32>,
    tests: u32,
}

/// Convex hull of some of the points.
#[derive(Default)]
pub(super) struct Hull {
    /// Vertices of the triangles, counterclockwise from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Points beyond triangles, by no more than rounding explains.
    pub outside: Vec<u32>,
}

/// Returns the convex hull of all points; `None` if they are in one plane, up to rounding. With
/// `must`, points that are beyond it by no more than rounding explains are left out, but for those
/// for which `must` is true. Expected O(n log n).
pub(super) fn convex_hull(
    points: &[[f64; 3]],
    must: Option<&[bool]>,
    poll: Poll<'_>,
) -> Result<Option<Hull>> {
    let mut maker = Maker { points, must, all: Vec::new(), waiting: Vec::new(), tests: 0 };
    if !maker.start(poll)? {
        return Ok(None);
    }
    while let Some(triangle) = maker.waiting.pop() {
        if let Some(farthest) = maker.farthest(triangle) {
            maker.add(triangle, farthest, poll)?;
        }
    }
    let mut hull = Hull::default();
    for triangle in maker.all.iter().filter(|triangle| triangle.is_live) {
        hull.triangles.try_push(triangle.vertices)?;
        hull.outside.try_extend(&triangle.beyond)?;
    }
    hull.outside.sort_unstable();
    hull.outside.dedup();
    Ok(Some(hull))
}

/// Returns four points far from each other; `None` if all are in one plane, up to rounding.
pub(super) fn corners_of_simplex(points: &[[f64; 3]]) -> AllocResult<Option<[u32; 4]>> {
    let all = collected(0..points.len() as u32)?;
    let Some(plane) = Plane::of(points, &all) else { return Ok(None) };
    let [a, b, c] = plane.base();
    let corners = [a, b, c].map(|at| &points[at as usize]);
    let gauge = Gauge::new(corners, units_of(corners.into_iter()));
    let height = |at: u32| gauge.height(&points[at as usize]).abs();
    let farthest = all.iter().copied().reduce(|x, y| if height(y) > height(x) { y } else { x });
    let is_far = |&at: &u32| {
        let x = &points[at as usize];
        let [a, b, c] = corners;
        !orientation(&[a, b, c, x]).is_zero() && gauge.measure(x).0 > 1.0
    };
    // Where doubles do not tell which is the farthest, any may be.
    let found = farthest.filter(is_far).or_else(|| all.iter().copied().find(is_far));
    Ok(found.map(|d| [a, b, c, d]))
}

impl Maker<'_> {
    /// Makes the first four triangles, and their lists.
    fn start(&mut self, poll: Poll<'_>) -> Result<bool> {
        let Some(mut corners) = corners_of_simplex(self.points)? else { return Ok(false) };
        if self.is_beyond([corners[0], corners[1], corners[2]], corners[3]) {
            corners.swap(0, 1);
        }
        let [a, b, c, d] = corners;
        // Each is opposite a corner, and so is its neighbour opposite another corner.
        let faces = [[b, d, c], [a, c, d], [a, d, b], [a, b, c]];
        for vertices in faces {
            let neighbors = vertices.map(|vertex| {
                corners.iter().position(|&corner| corner == vertex).unwrap_or(0) as u32
            });
            self.push(vertices, neighbors)?;
        }
        for point in (0..self.points.len() as u32).filter(|point| !corners.contains(point)) {
            self.sort_in(point, 0..4, poll)?;
        }
        Ok(true)
    }

    fn push(&mut self, vertices: [u32; 3], neighbors: [u32; 3]) -> AllocResult<u32> {
        let number = self.all.len() as u32;
        let (beyond, is_live) = (Vec::new(), true);
        self.all.try_push(HullTriangle { vertices, neighbors, beyond, is_live })?;
        self.waiting.try_push(number)?;
        Ok(number)
    }

    fn is_beyond(&self, vertices: [u32; 3], point: u32) -> bool {
        let [a, b, c] = vertices.map(|vertex| &self.points[vertex as usize]);
        orientation(&[a, b, c, &self.points[point as usize]]).is_positive()
    }

    /// Puts a point on the list of one of some triangles, if it is beyond one.
    fn sort_in(
        &mut self,
        point: u32,
        mut among: std::ops::Range<u32>,
        poll: Poll<'_>,
    ) -> Result<()> {
        self.tests += 1;
        if self.tests % TESTS_OF_A_POLL == 0 {
            poll(1)?;
        }
        let is_beyond = |&at: &u32| self.is_beyond(self.all[at as usize].vertices, point);
        if let Some(at) = among.find(is_beyond) {
            self.all[at as usize].beyond.try_push(point)?;
        }
        Ok(())
    }

    /// Returns the point beyond a triangle that is farthest, if that counts.
    fn farthest(&self, triangle: u32) -> Option<u32> {
        let HullTriangle { vertices, beyond, is_live, .. } = &self.all[triangle as usize];
        if beyond.is_empty() || !is_live {
            return None;
        }
        let corners = vertices.map(|vertex| &self.points[vertex as usize]);
        let gauge = Gauge::new(corners, units_of(corners.into_iter()));
        let height = |point: u32| gauge.height(&self.points[point as usize]);
        let farthest =
            beyond.iter().copied().reduce(|x, y| if height(y) > height(x) { y } else { x });
        let Some(must) = self.must else { return farthest };
        let counts = |&point: &u32| {
            must[point as usize] || gauge.measure(&self.points[point as usize]).0 > 1.0
        };
        farthest.filter(counts).or_else(|| beyond.iter().copied().find(counts))
    }

    /// Makes a point beyond a triangle a vertex.
    fn add(&mut self, triangle: u32, point: u32, poll: Poll<'_>) -> Result<()> {
        let (mut seen, mut horizon) = (Vec::new(), Vec::new());
        self.all[triangle as usize].is_live = false;
        seen.try_push(triangle)?;
        let mut at = 0;
        while let Some(&own) = seen.get(at) {
            at += 1;
            for k in 0..3 {
                let HullTriangle { vertices, neighbors, .. } = &self.all[own as usize];
                let (ends, next) = ([vertices[(k + 1) % 3], vertices[(k + 2) % 3]], neighbors[k]);
                if !self.all[next as usize].is_live {
                    continue;
                }
                if self.is_beyond(self.all[next as usize].vertices, point) {
                    self.all[next as usize].is_live = false;
                    seen.try_push(next)?;
                } else {
                    horizon.try_push((ends, next))?;
                }
            }
        }
        let first = self.all.len() as u32;
        self.cover(point, &mut horizon)?;
        for own in seen {
            for other in std::mem::take(&mut self.all[own as usize].beyond) {
                if other != point {
                    self.sort_in(other, first..self.all.len() as u32, poll)?;
                }
            }
        }
        Ok(())
    }

    /// Makes the triangles between a vertex and the edges of its horizon, each given with the
    /// triangle that stays there.
    fn cover(&mut self, vertex: u32, horizon: &mut [([u32; 2], u32)]) -> AllocResult<()> {
        let first = self.all.len() as u32;
        horizon.sort_unstable();
        for (at, &([from, to], beyond)) in (0u32..).zip(&*horizon) {
            let starting =
                |end: u32| horizon.partition_point(|&([own, _], _)| own < end) as u32 + first;
            let next = starting(to);
            let number = self.push([vertex, from, to], [beyond, next, NONE])?;
            debug_assert_eq!(number, first + at);
            let other = &mut self.all[beyond as usize];
            let edge = other.vertices.iter().position(|own| *own != from && *own != to);
            other.neighbors[edge.unwrap_or(0)] = number;
        }
        for number in first..self.all.len() as u32 {
            let next = self.all[number as usize].neighbors[1];
            self.all[next as usize].neighbors[2] = number;
        }
        Ok(())
    }
}
