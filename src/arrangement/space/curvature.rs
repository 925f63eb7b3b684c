//! Sizes from the curvature of facets: where they approximate a round surface, edges are short
//! enough to do so, too. A chord of length h of a circle with radius R has its middle at most e
//! from the circle if h^2 <= 4 e (2 R - e). From there sizes grow with the distance.

use super::points_of;
use super::projection::{normal, tangent_of_half};
use super::sides::{Side, Sides};
use crate::arrangement::poll::Poll;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow, collected, with_capacity};
use crate::mesh::{Arrangement, FacetTriangle, Inputs};
use crate::nearest::{Bounds, BoxTree, bounds_of, distance_to_box};
use crate::numerics::{coordinates, distance, distance_to_edge, distance_to_line, norm};

/// Largest angle in degrees by which facets of a round surface bend: those of an octagon bend by
/// 45. At larger ones there is a crease.
const MOST_BEND: f64 = 50.0;

/// Factor of the distance by which sizes grow. At 1 neighbours would hardly know of each other,
/// since simplices of good shape may grow as fast; smaller ones cost vertices away from the facets.
const GROWTH: f64 = 0.5;

/// Sizes that the curvature of facets asks for.
pub struct CurvatureSizes {
    edges: Vec<BentEdge>,
    tree: BoxTree<'static>,
    least: f64,
}

/// Edge at which two facets bend as those of a round surface do.
struct BentEdge {
    ends: [[f64; 3]; 2],
    size: f64,
}

/// Number of polls' units of work for one edge.
const WORK: u32 = 10;

impl CurvatureSizes {
    /// Returns the sizes with which edges have their middles no farther than `chord_error` from the
    /// round surface that the facets of an arrangement approximate, but no smaller ones than twice
    /// that. O(n log n) for n triangles, and the vertices of each facet for each of its bent edges
    /// at worst.
    ///
    /// # Errors
    /// `OutOfMemory`, and those of `poll`.
    pub fn new(
        inputs: &Inputs,
        arrangement: &Arrangement,
        chord_error: f64,
        poll: Poll<'_>,
    ) -> Result<Self> {
        let mut points = points_of(inputs)?;
        points.try_extend(&arrangement.corners)?;
        let facets = Facets::new(&points, &arrangement.triangles)?;
        let mut edges = Vec::new();
        let vertices = collected(arrangement.triangles.iter().map(|triangle| triangle.vertices))?;
        for sides in Sides::of_triangles(&vertices, poll)?.groups() {
            poll(WORK)?;
            let [one, other] = sides else { continue };
            if let Some(radius) = facets.radius_at(&vertices, [one, other]) {
                let ends = one.ends.map(|vertex| points[vertex as usize]);
                edges.try_push(BentEdge { ends, size: size_for(radius, chord_error) })?;
            }
        }
        let boxes: Vec<Bounds> = collected(edges.iter().map(|edge| bounds_of(edge.ends.iter())))?;
        let least = edges.iter().map(|edge| edge.size).fold(f64::INFINITY, f64::min);
        Ok(Self { edges, tree: BoxTree::new(boxes)?, least })
    }

    /// Returns the size at a point, infinite if nothing is round. O(log n) where bent edges are as
    /// far from each other as they are long.
    pub fn at(&self, x: &[f64]) -> f64 {
        let x = coordinates::<3>(x, 0);
        let grown = |size: f64, distance: f64| size + GROWTH * distance;
        self.tree.least(&|bounds| grown(self.least, distance_to_box(x, bounds)), &|edge| {
            let BentEdge { ends: [a, b], size } = &self.edges[edge as usize];
            grown(*size, distance_to_edge(x, [a, b]))
        })
    }
}

/// Returns the longest chord of a circle with a radius whose middle is at most `error` from the
/// circle. A circle that is not larger than the error needs none shorter than that allows.
fn size_for(radius: f64, error: f64) -> f64 {
    match radius > error {
        true => 2.0 * error.sqrt() * (2.0 * radius - error).sqrt(),
        false => 2.0 * error,
    }
}

/// Returns the area of a parallelogram, 0 or infinite where doubles have none for it.
fn area([a, b, c]: [&[f64; 3]; 3]) -> f64 {
    distance(a, b) * distance_to_line(c, [a, b])
}

/// Facets of an arrangement, as the sorted triangles that they consist of.
struct Facets<'a> {
    points: &'a [[f64; 3]],
    triangles: &'a [FacetTriangle],
    /// Facet -> its first triangle, and the end of the last facet.
    starts: Vec<u32>,
    /// Facet -> a normal, that of its largest triangle: slivers hardly have one.
    normals: Vec<[f64; 3]>,
}

impl<'a> Facets<'a> {
    fn new(points: &'a [[f64; 3]], triangles: &'a [FacetTriangle]) -> AllocResult<Self> {
        let count = triangles.last().map_or(0, |last| last.facet as usize + 1);
        let (mut starts, mut normals) = (with_capacity(count + 1)?, with_capacity(count)?);
        starts.push(0);
        for facet in 0..count {
            let start = starts[facet] as usize;
            let rest = &triangles[start..];
            let own = &rest[..rest.partition_point(|triangle| triangle.facet as usize == facet)];
            let corners = |of: &FacetTriangle| of.vertices.map(|vertex| &points[vertex as usize]);
            let largest = own.iter().max_by(|a, b| {
                let [a, b] = [a, b].map(|triangle| area(corners(triangle)));
                a.total_cmp(&b)
            });
            normals.push(largest.map_or([0.0; 3], |triangle| normal(corners(triangle))));
            starts.push((start + own.len()) as u32);
        }
        Ok(Self { points, triangles, starts, normals })
    }

    /// Returns the radius of the cylinder along an edge that facets approximate which are as wide
    /// as the narrower of the two there and bend by the same angle; `None` if they are one, or flat
    /// there, or have a crease.
    fn radius_at(&self, vertices: &[[u32; 3]], sides: [&Side; 2]) -> Option<f64> {
        let [one, other] = sides.map(|side| self.triangles[side.triangle as usize].facet as usize);
        if one == other {
            return None;
        }
        // Seen from one side, one triangle runs up the edge and the other down.
        let [up, down] = sides.map(|side| side.runs_up(vertices));
        let next = self.normals[other].map(|x| if up == down { -x } else { x });
        let tangent = tangent_of_half([&self.normals[one], &next]);
        // False where a facet has no normal in doubles.
        let is_round = tangent > 0.0 && tangent <= (0.5 * MOST_BEND).to_radians().tan();
        if !is_round {
            return None;
        }
        let ends = sides[0].ends;
        let width = self.width(other, ends, self.width(one, ends, f64::INFINITY));
        let sine = tangent / norm(&[1.0, tangent]);
        Some(0.5 * width / sine)
    }

    /// Returns the largest distance of a facet's vertices from the line of an edge, or `most` if
    /// that is less.
    fn width(&self, facet: usize, ends: [u32; 2], most: f64) -> f64 {
        let [a, b] = ends.map(|vertex| &self.points[vertex as usize]);
        let own = self.starts[facet] as usize..self.starts[facet + 1] as usize;
        let mut width = 0.0;
        for vertex in self.triangles[own].iter().flat_map(|triangle| triangle.vertices) {
            width = distance_to_line(&self.points[vertex as usize], [a, b]).max(width);
            if width >= most {
                return most;
            }
        }
        width
    }
}
