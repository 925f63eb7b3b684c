//! The convex hull of points in space, by C. B. Barber, D. P. Dobkin and H. Huhdanpaa, "The
//! quickhull algorithm for convex hulls", 1996: points beyond a triangle are on its list, and the
//! one that is farthest becomes a vertex, in front of all triangles that see it. Signs are exact,
//! so that the triangles are always those of a convex hull.
//!
//! Points that are beyond a triangle by no more than rounding explains may be left out: the sides
//! of a solid that was turned are plane then.

use super::plane::{Gauge, Plane, from_line, units_of};
use super::projection::Projection;
use crate::arrangement::poll::Poll;
use crate::arrangement::reach::Reach;
use crate::error::Result;
use crate::memory::{AllocResult, Lists, TryGrow, collected};
use crate::mesh::NONE;
use crate::numerics::{distance, orientation};

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
    /// Point -> its role; `None` for an exact hull.
    roles: Option<&'a [Role]>,
    all: Vec<HullTriangle>,
    /// Triangles that may have a point far enough beyond them.
    waiting: Vec<u32>,
    tests: u32,
}

/// Part that a point has in a hull up to rounding.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// It is a vertex where it is farther out than rounding explains.
    Free,
    /// It is a vertex wherever it is outside.
    Must,
    /// It is no vertex.
    Never,
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
/// `roles`, points that are beyond it by no more than rounding explains are left out. Expected
/// O(n log n).
pub(super) fn convex_hull(
    points: &[[f64; 3]],
    roles: Option<&[Role]>,
    poll: Poll<'_>,
) -> Result<Option<Hull>> {
    let mut maker = Maker { points, roles, all: Vec::new(), waiting: Vec::new(), tests: 0 };
    if !maker.make_simplex(poll)? {
        return Ok(None);
    }
    while let Some(triangle) = maker.waiting.pop() {
        if let Some(farthest) = maker.farthest(triangle)? {
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

/// Returns the vertices of a hull that are near the edge between two of their neighbours, at the
/// ends of which the side could end as well.
pub(super) fn within_edges(points: &[[f64; 3]], triangles: &[[u32; 3]]) -> AllocResult<Vec<u32>> {
    const MOST_NEIGHBORS: usize = 100;
    let point = |at: u32| &points[at as usize];
    let pairs = || triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
    let neighbors = Lists::of_pairs(points.len(), pairs)?;
    let mut found = Vec::new();
    for vertex in 0..points.len() as u32 {
        let own = neighbors.of(vertex as usize);
        let is_within = |[a, b]: [u32; 2]| Reach::of([a, b].map(point)).holds(point(vertex));
        let mut pairs =
            own.iter().enumerate().flat_map(|(at, &b)| own[..at].iter().map(move |&a| [a, b]));
        if own.len() <= MOST_NEIGHBORS && pairs.any(is_within) {
            found.try_push(vertex)?;
        }
    }
    Ok(found)
}

/// Returns four points far from each other; `None` if all are in one plane, up to rounding.
pub(super) fn corners_of_simplex(points: &[[f64; 3]]) -> AllocResult<Option<[u32; 4]>> {
    let all = collected(0..points.len() as u32)?;
    let Some(base) = far_triangle(points, &all) else { return Ok(None) };
    let corners = base.map(|at| &points[at as usize]);
    let gauge = Gauge::new(corners, units_of(corners.into_iter()));
    let height = |x: &[f64; 3]| gauge.height(x).abs();
    let is_far = |&at: &u32| {
        let x = &points[at as usize];
        let [a, b, c] = corners;
        !orientation(&[a, b, c, x]).is_zero() && exceeds_rounding(&gauge, x)
    };
    let farthest = outermost(points, &all, corners[0], height).filter(is_far);
    // Where doubles do not tell which is the farthest, any may be.
    let found = farthest.or_else(|| all.iter().copied().find(is_far));
    let [a, b, c] = base;
    Ok(found.map(|d| [a, b, c, d]))
}

/// Returns true if rounding does not explain the distance of a point from a plane, or where doubles
/// do not tell it.
fn exceeds_rounding(gauge: &Gauge<'_>, x: &[f64; 3]) -> bool {
    let is_explained = gauge.measure(x).0 <= 1.0;
    !is_explained
}

/// Returns three points far from each other; `None` if all are on one line.
fn far_triangle(points: &[[f64; 3]], all: &[u32]) -> Option<[u32; 3]> {
    let point = |at: u32| &points[at as usize];
    let start = point(*all.first()?);
    let a = outermost(points, all, start, |x| distance(start, x))?;
    let b = outermost(points, all, point(a), |x| distance(point(a), x))?;
    let c = outermost(points, all, point(a), |x| from_line([point(a), point(b)], x))?;
    match Projection::of_triangle([a, b, c].map(point)) {
        Some(_) => Some([a, b, c]),
        None => Some(Plane::of(points, all)?.base()),
    }
}

/// Returns the point of some that is farthest out; of those that are as far but for roundings the
/// one farthest from another point: so it is at the end of an edge or side, and not within. `None`
/// only if there are none.
fn outermost(
    points: &[[f64; 3]],
    some: &[u32],
    from: &[f64; 3],
    height: impl Fn(&[f64; 3]) -> f64,
) -> Option<u32> {
    const ALIKE: f64 = 1.0 - 1e-9;
    // No point is below the base: heights are negative by roundings only.
    let height = |x: &[f64; 3]| match height(x) {
        below if below < 0.0 => 0.0,
        height => height,
    };
    let mut best: Option<(u32, f64)> = None;
    let mut most = 0.0f64;
    for &at in some {
        most = most.max(height(&points[at as usize]));
    }
    for &at in some {
        let x = &points[at as usize];
        // NaN counts, too: any point will do then.
        let is_lower = height(x) < ALIKE * most;
        if !is_lower {
            let far = distance(from, x);
            if best.is_none_or(|(_, known)| far > known) {
                best = Some((at, far));
            }
        }
    }
    best.map(|(at, _)| at)
}

impl Maker<'_> {
    /// Makes the first four triangles, and their lists.
    fn make_simplex(&mut self, poll: Poll<'_>) -> Result<bool> {
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
        for point in 0..self.points.len() as u32 {
            let role = self.roles.map_or(Role::Free, |roles| roles[point as usize]);
            if role != Role::Never && !corners.contains(&point) {
                self.sort_in(point, 0..4, poll)?;
            }
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

    /// Returns the point on the list of a triangle that is farthest, or the first one that counts.
    fn farthest(&self, triangle: u32) -> AllocResult<Option<u32>> {
        let HullTriangle { vertices, beyond, is_live, .. } = &self.all[triangle as usize];
        if beyond.is_empty() || !is_live {
            return Ok(None);
        }
        let corners = vertices.map(|vertex| &self.points[vertex as usize]);
        let gauge = Gauge::new(corners, units_of(corners.into_iter()));
        let farthest = outermost(self.points, beyond, corners[0], |x| gauge.height(x));
        let Some(roles) = self.roles else { return Ok(farthest) };
        for &point in farthest.iter().chain(beyond) {
            if roles[point as usize] == Role::Must || self.is_far(triangle, point)? {
                return Ok(Some(point));
            }
        }
        Ok(None)
    }

    /// Returns true if a point is farther beyond some triangle than rounding explains, given one of
    /// those that it is beyond, which are connected.
    fn is_far(&self, triangle: u32, point: u32) -> AllocResult<bool> {
        let mut seen = Vec::new();
        seen.try_push(triangle)?;
        let mut at = 0;
        while let Some(&own) = seen.get(at) {
            at += 1;
            let HullTriangle { vertices, neighbors, .. } = &self.all[own as usize];
            let corners = vertices.map(|vertex| &self.points[vertex as usize]);
            let gauge = Gauge::new(corners, units_of(corners.into_iter()));
            if exceeds_rounding(&gauge, &self.points[point as usize]) {
                return Ok(true);
            }
            for &next in neighbors {
                if !seen.contains(&next) && self.is_beyond(self.all[next as usize].vertices, point)
                {
                    seen.try_push(next)?;
                }
            }
        }
        Ok(false)
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
        self.join_to_horizon(point, &mut horizon)?;
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
    fn join_to_horizon(&mut self, vertex: u32, horizon: &mut [([u32; 2], u32)]) -> AllocResult<()> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing;

    fn exact(points: &[[f64; 3]]) -> Option<Vec<[u32; 3]>> {
        let hull = convex_hull(points, None, &mut |_| Ok(())).unwrap()?;
        assert!(hull.outside.is_empty());
        for triangle in &hull.triangles {
            let [a, b, c] = triangle.map(|at| &points[at as usize]);
            assert!(points.iter().all(|x| !orientation(&[a, b, c, x]).is_positive()), "{points:?}");
        }
        Some(hull.triangles)
    }

    /// The origin is outside of the other four by so little that its height in doubles is negative.
    #[test]
    fn a_vertex_of_a_hull_may_be_lower_than_roundings() {
        let points = [
            [-1.9998561151304963, -7.495719343555121e-31, 8.435436762071315e264],
            [3.439829529116181e181, -3.105036554750705e231, 3.39537782945e-313],
            [4.0525751602025065e228, 4.6856554937365e-32, 4.523804806624566e-58],
            [2.4055026333848733e-83, 4.822578756255e-312, 0.0],
            [0.0; 3],
        ];
        assert_eq!(exact(&points).unwrap().len(), 6);
    }

    #[test]
    fn exact_hulls_leave_no_point_outside() {
        for family in testing::FAMILIES {
            let mut random = testing::Random(5);
            for _ in 0..200 {
                exact(&testing::points(family, 8, &mut random));
            }
        }
    }
}
