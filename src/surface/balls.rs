//! The Delaunay balls of the simplices, and how deeply two of them intersect.

use crate::arrays::center_within;
use crate::memory::{AllocResult, with_capacity};
use crate::mesh::{NONE, Triangulation};
use crate::numerics::norm;
use crate::query::dual::{Center, dot};
use crate::query::unit::{Unit, largest, scaled};
use crate::query::view::View;

/// Largest error of a circumcentre, relative to the radius: its direction is evidence, no sign.
const ACCEPTED: f64 = 1e-6;

/// The circumballs of the simplices of a Delaunay triangulation. Beyond a facet of the hull there
/// is a halfspace instead, the limit of balls.
pub struct Balls<'a, const D: usize> {
    pub view: View<'a, D>,
    centers: Vec<Center<D>>,
    radii: Vec<f64>,
    /// The unit of lengths and of areas of facets.
    pub unit: Unit,
}

/// A facet as its simplex sees it.
struct SeenFacet<const D: usize> {
    /// The unit vector at right angles to the facet, away from the simplex; zero if the simplex is
    /// flat within roundings.
    outward: [f64; D],
    /// The area of the parallelotope that the facet spans.
    area: f64,
}

impl<'a, const D: usize> Balls<'a, D> {
    /// Makes the balls. O(simplices).
    pub fn new(mesh: &'a Triangulation) -> AllocResult<Self> {
        let view = View::<D> { mesh };
        let count = mesh.simplex_count();
        let (mut centers, mut radii) = (with_capacity(count)?, with_capacity(count)?);
        for simplex in 0..count as u32 {
            let points = view.points_of(view.simplex(simplex));
            let center = center_within::<D>(ACCEPTED, &points[..=D]);
            radii.push(scaled(norm(&center.offset), center.exponent));
            centers.push(center);
        }
        Ok(Self { view, centers, radii, unit: unit_of(view) })
    }

    /// Returns the radius of a ball; infinite beyond the doubles.
    pub fn radius(&self, simplex: u32) -> f64 {
        self.radii[simplex as usize]
    }

    /// Returns the distance from a vertex to a circumcentre, in the unit of lengths.
    pub fn distance(&self, simplex: u32, vertex: u32) -> f64 {
        let exponent = self.centers[simplex as usize].exponent - self.unit.exponent();
        scaled(norm(&self.to_center(simplex, vertex)), exponent)
    }

    /// Returns the unit vector from a vertex of a simplex to its circumcentre.
    pub fn direction(&self, simplex: u32, vertex: u32) -> [f64; D] {
        unit_vector(self.to_center(simplex, vertex))
    }

    /// Returns the vector from a vertex to the circumcentre of a simplex, in a unit of the simplex.
    fn to_center(&self, simplex: u32, vertex: u32) -> [f64; D] {
        let center = &self.centers[simplex as usize];
        let anchor = self.view.point(self.view.simplex(simplex)[center.anchor]);
        let point = self.view.point(vertex);
        // Twice the radius in this unit is the largest difference.
        let factor = scaled(1.0, -center.exponent);
        let is_safe = (1e-290..1e290).contains(&factor);
        let from_anchor = |i: usize| match anchor[i] - point[i] {
            step if is_safe => step * factor,
            step if step.is_finite() => scaled(step, -center.exponent),
            _ => scaled(0.5 * anchor[i] - 0.5 * point[i], 1 - center.exponent),
        };
        std::array::from_fn(|i| from_anchor(i) + center.offset[i])
    }

    /// Returns the unit vector at right angles to a facet of the hull, outwards.
    pub fn outward(&self, simplex: u32, corner: usize) -> [f64; D] {
        self.facet(simplex, corner).outward
    }

    /// Returns how deeply the balls on both sides of a facet intersect: the cosine of the angle
    /// between their directions at a common point of their spheres. It is 1 for equal balls and -1
    /// for balls that touch from outside.
    pub fn depth(&self, simplex: u32, corner: usize) -> f64 {
        let vertices = self.view.simplex(simplex);
        let vertex = vertices[usize::from(corner == 0)];
        let here = self.direction(simplex, vertex);
        let there = match self.view.neighbors(simplex)[corner] {
            NONE => self.outward(simplex, corner),
            neighbor => self.direction(neighbor, vertex),
        };
        dot(&here, &there).clamp(-1.0, 1.0)
    }

    /// Returns the depth of each facet, at the first of its two places in `neighbors`; 0 at the
    /// other one. O(simplices).
    pub fn depths(&self) -> AllocResult<Vec<f64>> {
        let neighbors = &self.view.mesh.neighbors;
        let mut depths = with_capacity(neighbors.len())?;
        for (at, &neighbor) in neighbors.iter().enumerate() {
            let (simplex, corner) = ((at / (D + 1)) as u32, at % (D + 1));
            depths.push(if simplex < neighbor { self.depth(simplex, corner) } else { 0.0 });
        }
        Ok(depths)
    }

    /// Returns what it costs to have a facet on the surface: its area, in some unit, times a factor
    /// from 0, where the balls on its sides touch, to 1, where they are one.
    pub fn cost(&self, simplex: u32, corner: usize) -> f64 {
        self.facet(simplex, corner).area * (1.0 + self.depth(simplex, corner)) * 0.5
    }

    /// Looks at the facet opposite a corner: its edges and the way to the corner made orthogonal
    /// one after the other (Gram and Schmidt, twice for the roundings).
    fn facet(&self, simplex: u32, corner: usize) -> SeenFacet<D> {
        let vertices = self.view.simplex(simplex);
        let base = usize::from(corner == 0);
        let step = |k: usize| {
            self.unit.difference(self.view.point(vertices[k]), self.view.point(vertices[base]))
        };
        let others = (0..=D).filter(|&k| k != corner && k != base);
        let (mut frame, mut area) = ([[0.0; D]; D], 1.0);
        for (row, k) in others.enumerate() {
            let rest = orthogonal(&frame[..row], step(k));
            area *= norm(&rest);
            frame[row] = unit_vector(rest);
        }
        let inward = orthogonal(&frame[..D - 1], step(corner));
        SeenFacet { outward: unit_vector(inward).map(|x| -x), area }
    }
}

/// Returns a unit in which areas of facets neither overflow nor, unless they count for nothing,
/// underflow.
fn unit_of<const D: usize>(view: View<'_, D>) -> Unit {
    let coordinates = || view.mesh.points.chunks_exact(D);
    let bound = |i: usize, worse: fn(f64, f64) -> f64| {
        coordinates().map(|point| point[i]).reduce(worse).unwrap_or(0.0)
    };
    let low: [f64; D] = std::array::from_fn(|i| bound(i, f64::min));
    let high: [f64; D] = std::array::from_fn(|i| bound(i, f64::max));
    let unit = Unit::of_points(largest(&low).max(largest(&high)));
    match largest(&unit.difference(&high, &low)) {
        0.0 => unit,
        extent => unit.scaled_to(extent),
    }
}

/// Returns what is left of a vector at right angles to unit vectors.
pub fn orthogonal<const D: usize>(frame: &[[f64; D]], mut vector: [f64; D]) -> [f64; D] {
    for axis in frame.iter().chain(frame) {
        let along = dot(axis, &vector);
        vector = std::array::from_fn(|i| vector[i] - along * axis[i]);
    }
    vector
}

/// Returns the vector with length 1; zero for one without a direction.
pub fn unit_vector<const D: usize>(vector: [f64; D]) -> [f64; D] {
    let length = norm(&vector);
    if length > 0.0 && length.is_finite() { vector.map(|x| x / length) } else { [0.0; D] }
}
