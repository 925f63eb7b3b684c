//! The convex hull of points in space, with the signs of the certificate: triangles that see a
//! further point give way to those between it and their common border, until none sees any.

use crate::memory::{AllocResult, TryGrow, collected};
use crate::mesh::NONE;
use crate::validate::signs::{Robust, Signs};
use std::cmp::Ordering;

/// Triangle with its neighbours opposite each vertex and the points that it sees; empty `vertices`
/// stand for one that has given way.
struct Part {
    vertices: Option<[usize; 3]>,
    neighbors: [usize; 3],
    seen: Vec<usize>,
}

struct Maker<'a> {
    points: &'a [&'a [f64; 3]],
    parts: Vec<Part>,
    signs: Signs<Robust>,
}

/// Returns the triangles of the convex hull, counterclockwise from outside, by the numbers of their
/// points; none if all points are in one plane.
pub(super) fn hull(points: &[&[f64; 3]]) -> AllocResult<Vec<[usize; 3]>> {
    let mut maker = Maker { points, parts: Vec::new(), signs: Signs::default() };
    let Some(first) = maker.independent()? else { return Ok(Vec::new()) };
    maker.begin(first)?;
    let mut at = 0;
    while at < maker.parts.len() {
        if let Some(vertices) = maker.parts[at].vertices {
            if let Some(point) = maker.farthest(vertices, &maker.parts[at].seen) {
                maker.add(at, point)?;
            }
        }
        at += 1;
    }
    collected(maker.parts.iter().filter_map(|part| part.vertices))
}

impl Maker<'_> {
    fn sees(&mut self, [a, b, c]: [usize; 3], point: usize) -> AllocResult<Ordering> {
        self.signs.orientation(&[a, b, c, point].map(|at| self.points[at]))
    }

    /// Returns four points that are not in one plane.
    fn independent(&mut self) -> AllocResult<Option<[usize; 4]>> {
        let count = self.points.len();
        let Some(b) = (1..count).find(|&b| self.points[b] != self.points[0]) else {
            return Ok(None);
        };
        let mut third = None;
        for c in b + 1..count {
            for axes in [[0, 1], [1, 2], [2, 0]] {
                let [p, q, r] = [0, b, c].map(|at| axes.map(|axis: usize| self.points[at][axis]));
                if self.signs.orientation(&[&p, &q, &r])? != Ordering::Equal {
                    third = Some(c);
                }
            }
            if third.is_some() {
                break;
            }
        }
        let Some(c) = third else { return Ok(None) };
        for d in c + 1..count {
            match self.sees([0, b, c], d)? {
                Ordering::Less => return Ok(Some([0, b, c, d])),
                Ordering::Greater => return Ok(Some([b, 0, c, d])),
                Ordering::Equal => {}
            }
        }
        Ok(None)
    }

    /// Makes the first four triangles, of points of which the fourth is behind the others.
    fn begin(&mut self, [a, b, c, d]: [usize; 4]) -> AllocResult<()> {
        let opposite = |vertex: usize| [a, b, c, d].iter().position(|&own| own == vertex);
        // Each is opposite one of the points.
        for vertices in [[b, d, c], [a, c, d], [a, d, b], [a, b, c]] {
            let neighbors = vertices.map(|vertex| opposite(vertex).unwrap_or(0));
            self.parts.try_push(Part { vertices: Some(vertices), neighbors, seen: Vec::new() })?;
        }
        for point in 0..self.points.len() {
            if opposite(point).is_none() {
                self.put(point, 0)?;
            }
        }
        Ok(())
    }

    /// Puts a point on the list of the first triangle from `first` on that sees it.
    fn put(&mut self, point: usize, first: usize) -> AllocResult<()> {
        for at in first..self.parts.len() {
            let Some(vertices) = self.parts[at].vertices else { continue };
            if self.sees(vertices, point)? == Ordering::Greater {
                return self.parts[at].seen.try_push(point);
            }
        }
        Ok(())
    }

    /// Returns the point that is farthest before a triangle, but for roundings; any will do.
    fn farthest(&self, vertices: [usize; 3], seen: &[usize]) -> Option<usize> {
        let [a, b, c] = vertices.map(|at| self.points[at]);
        let size =
            |x: &[f64; 3]| (0..3).map(|k| (0.5 * x[k] - 0.5 * a[k]).abs()).fold(0.0, f64::max);
        let unit = size(b).max(size(c)).max(f64::MIN_POSITIVE);
        let way = |x: &[f64; 3]| [0, 1, 2].map(|k: usize| (0.5 * x[k] - 0.5 * a[k]) / unit);
        let (u, v) = (way(b), way(c));
        let height = |&at: &usize| {
            let w = way(self.points[at]);
            (0..3)
                .map(|k| (u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]) * w[k])
                .sum::<f64>()
        };
        seen.iter().copied().max_by(|x, y| height(x).total_cmp(&height(y)))
    }

    /// Makes a point a vertex, given a triangle that sees it.
    fn add(&mut self, start: usize, point: usize) -> AllocResult<()> {
        let (mut gone, mut border) = (Vec::new(), Vec::new());
        gone.try_push((start, self.parts[start].vertices.take()))?;
        let mut at = 0;
        while let Some(&(part, vertices)) = gone.get(at) {
            at += 1;
            let vertices = vertices.unwrap_or_default();
            for slot in 0..3 {
                let beyond = self.parts[part].neighbors[slot];
                let Some(others) = self.parts[beyond].vertices else { continue };
                if self.sees(others, point)? == Ordering::Greater {
                    gone.try_push((beyond, self.parts[beyond].vertices.take()))?;
                } else {
                    let [from, to] = [1, 2].map(|step| vertices[(slot + step) % 3]);
                    border.try_push((from, to, beyond))?;
                }
            }
        }
        border.sort_unstable();
        let first = self.parts.len();
        for &(from, to, beyond) in &border {
            let own = self.parts.len();
            let next = first + border.partition_point(|edge| edge.0 < to);
            let neighbors = [next, NONE as usize, beyond];
            let vertices = Some([from, to, point]);
            self.parts.try_push(Part { vertices, neighbors, seen: Vec::new() })?;
            let others = self.parts[beyond].vertices.unwrap_or_default();
            let slot = others.iter().position(|&other| other != from && other != to);
            self.parts[beyond].neighbors[slot.unwrap_or(0)] = own;
        }
        for own in first..self.parts.len() {
            let next = self.parts[own].neighbors[0];
            self.parts[next].neighbors[1] = own;
        }
        for (part, _) in gone {
            for other in std::mem::take(&mut self.parts[part].seen) {
                if other != point {
                    self.put(other, first)?;
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hulls_have_all_points_behind_them() {
        let mut random = crate::numerics::testing::Random(7);
        for count in [4, 5, 9, 40] {
            let mut points: Vec<[f64; 3]> =
                (0..count).map(|_| std::array::from_fn(|_| random.unit())).collect();
            // Some in common planes, and on common lines.
            points
                .extend((0..count).map(|_| std::array::from_fn(|_| (4.0 * random.unit()).floor())));
            let points: Vec<&[f64; 3]> = points.iter().collect();
            let triangles = hull(&points).unwrap();
            let mut signs = Signs::<Robust>::default();
            for triangle in &triangles {
                for &point in &points {
                    let [a, b, c] = triangle.map(|at| points[at]);
                    assert_ne!(signs.orientation(&[a, b, c, point]).unwrap(), Ordering::Greater);
                }
            }
            let mut edges: Vec<_> =
                triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
            edges.sort_unstable();
            let is_there = |&[a, b]: &[usize; 2]| edges.binary_search(&[b, a]).is_ok();
            assert!(!edges.is_empty() && edges.iter().all(is_there));
        }
    }

    #[test]
    fn points_in_a_plane_have_none() {
        let flat: Vec<[f64; 3]> =
            (0..9).map(|at| [f64::from(at % 3), f64::from(at / 3), 0.5]).collect();
        assert!(hull(&flat.iter().collect::<Vec<_>>()).unwrap().is_empty());
        let line = [[0.0; 3], [0.0; 3], [1.0; 3], [3.0; 3]];
        assert!(hull(&line.iter().collect::<Vec<_>>()).unwrap().is_empty());
    }
}
