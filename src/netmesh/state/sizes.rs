//! The sizes that the caller asks for: a function of the place, a longest edge, or both, and the
//! answers that the function has given so far. `refinement/size` refines to them.

use crate::complex::{SimplexId, VertexId};
use crate::delaunay::Delaunay;
use crate::error::{Error, ErrorKind, Name, Result, say};
use crate::memory::{Array, TryGrow};
use crate::mesh::{Inputs, MAX_DIM};
use crate::numerics::{Circumball, distance};
use crate::options::SizeFn;
use crate::parameters::Parameters;

/// Circumradii stay this far below what was asked for: the certificate rounds otherwise.
const MARGIN: f64 = 1e-9;

/// Answer at a vertex at which no size was needed yet.
pub(in crate::netmesh) const UNKNOWN: f64 = f64::NAN;

/// Sizes that the caller asks for, the box where they hold, and the answers so far.
pub(in crate::netmesh) struct Sizes<'a, const D: usize> {
    function: Option<&'a SizeFn<'a>>,
    /// Infinite if there is none.
    max_edge: f64,
    /// The box of the inputs.
    low: [f64; D],
    high: [f64; D],
    /// Vertex -> what the function answered.
    pub answers: Array<f64>,
}

impl<'a, const D: usize> Sizes<'a, D> {
    /// Returns the sizes, or `None` if no size is asked for. `by_region`: true if regions have
    /// some.
    pub fn new(
        inputs: &Inputs,
        parameters: &Parameters,
        function: Option<&'a SizeFn<'a>>,
        by_region: bool,
    ) -> Option<Self> {
        if parameters.max_edge == 0.0 && function.is_none() && !by_region {
            return None;
        }
        let mut low = [f64::INFINITY; D];
        let mut high = [f64::NEG_INFINITY; D];
        for vertex in 0..inputs.distinct() {
            for (axis, &x) in inputs.distinct_point(vertex).iter().enumerate() {
                low[axis] = low[axis].min(x);
                high[axis] = high[axis].max(x);
            }
        }
        let max_edge = if parameters.max_edge > 0.0 { parameters.max_edge } else { f64::INFINITY };
        Some(Self { function, max_edge, low, high, answers: Array::new() })
    }

    /// Returns the distance from a point to the farthest one of the box.
    pub fn reach(&self, from: &[f64; D]) -> f64 {
        let corner = std::array::from_fn(|axis| {
            // Halves, so that no difference overflows.
            let below = 0.5 * from[axis] - 0.5 * self.low[axis];
            let above = 0.5 * self.high[axis] - 0.5 * from[axis];
            if below > above { self.low[axis] } else { self.high[axis] }
        });
        distance(from, &corner)
    }

    /// Returns the answer at a vertex, infinite if nobody asked; `None` without a function.
    pub fn answer(&self, vertex: VertexId) -> Option<f64> {
        self.function?;
        let answer = self.answers.get(vertex.index()).copied();
        Some(answer.filter(|answer| !answer.is_nan()).unwrap_or(f64::INFINITY))
    }

    /// Returns the factor by which a live simplex is larger than it may be; 0 where nothing is
    /// asked for. `max_edge`: the longest edge that its region may have.
    ///
    /// # Errors
    /// `InvalidArgument` if the function answers no size.
    pub fn excess(
        &mut self,
        delaunay: &Delaunay<D>,
        simplex: SimplexId,
        max_edge: f64,
    ) -> Result<f64> {
        let Some(radius) = delaunay.radius(simplex) else { return Ok(0.0) };
        let vertices = delaunay.complex().vertices(simplex);
        let mut points = [delaunay.point(vertices[0]); MAX_DIM + 1];
        for (point, &vertex) in points.iter_mut().zip(vertices) {
            *point = delaunay.point(vertex);
        }
        let points = &points[..=D];
        if !self.meets_box(points) {
            return Ok(0.0);
        }
        let mut size = f64::INFINITY;
        for (&vertex, &point) in vertices.iter().zip(points) {
            size = size.min(self.ask(vertex, point)?);
        }
        Ok(excess_of(points, radius, size, max_edge.min(self.max_edge)))
    }

    /// Returns true if a simplex may be made that has these vertices, with the vertex number `apex`
    /// at `x`. `max_edge`: the longest edge that its region may have.
    ///
    /// # Errors
    /// `InvalidArgument` if the function answers no size.
    pub fn allow(
        &self,
        delaunay: &Delaunay<D>,
        vertices: &[VertexId],
        apex: usize,
        x: &[f64; D],
        max_edge: f64,
    ) -> Result<bool> {
        let mut points = [x; MAX_DIM + 1];
        for (at, &vertex) in vertices.iter().enumerate().filter(|&(at, _)| at != apex) {
            points[at] = delaunay.point(vertex);
        }
        let points = &points[..=D];
        if !self.meets_box(points) {
            return Ok(true);
        }
        let mut size = f64::INFINITY;
        for (at, &vertex) in vertices.iter().enumerate() {
            let known = self.answers.get(vertex.index()).filter(|answer| !answer.is_nan());
            let answer = match (known, self.function) {
                _ if at == apex => self.answer_at(x),
                (Some(&known), _) => Ok(known),
                (None, _) => self.answer_at(points[at]),
            };
            size = size.min(answer?);
        }
        let max_edge = max_edge.min(self.max_edge);
        Ok(excess_of(points, Circumball::new(points).radius(), size, max_edge) <= 1.0)
    }

    /// Returns true if the box of a simplex meets that of the inputs.
    fn meets_box(&self, points: &[&[f64; D]]) -> bool {
        (0..D).all(|axis| {
            points.iter().any(|point| point[axis] >= self.low[axis])
                && points.iter().any(|point| point[axis] <= self.high[axis])
        })
    }

    /// Returns the answer of the function for `vertex`, which is at `x`.
    pub fn ask(&mut self, vertex: VertexId, x: &[f64; D]) -> Result<f64> {
        if self.function.is_none() {
            return Ok(f64::INFINITY);
        }
        self.answers.cover(vertex.index() + 1, UNKNOWN)?;
        if self.answers[vertex].is_nan() {
            self.answers[vertex] = self.answer_at(x)?;
        }
        Ok(self.answers[vertex])
    }

    /// Returns the answer of the function at `x`, or at the nearest point of the box.
    fn answer_at(&self, x: &[f64; D]) -> Result<f64> {
        let Some(function) = self.function else { return Ok(f64::INFINITY) };
        let x: [f64; D] = std::array::from_fn(|k| x[k].clamp(self.low[k], self.high[k]));
        let answer = function(&x);
        // False if it is no number.
        if answer > 0.0 {
            return Ok(answer);
        }
        let message = say!(
            Name::Size,
            " answers {answer} at {x:?}; a size is above 0, or infinite for no bound"
        );
        Err(Error::new(ErrorKind::InvalidArgument, message))
    }
}

/// Returns the factor by which a simplex is larger than its circumradius and edges may be, with the
/// least answer `size` at its vertices.
fn excess_of<const D: usize>(points: &[&[f64; D]], radius: f64, size: f64, max_edge: f64) -> f64 {
    let allowed = regular_circumradius(D) * size.min(max_edge);
    let of_radius = radius / ((1.0 - MARGIN) * allowed);
    // No edge is longer than the diameter.
    if of_radius > 1.0 || 2.0 * radius <= (1.0 - MARGIN) * max_edge {
        return of_radius;
    }
    of_radius.max(longest_distance(points) / max_edge)
}

/// Returns the circumradius of the regular simplex with edges of length 1.
fn regular_circumradius(dim: usize) -> f64 {
    (dim as f64 / (2 * (dim + 1)) as f64).sqrt()
}

fn longest_distance<const D: usize>(points: &[&[f64; D]]) -> f64 {
    let pairs =
        points.iter().enumerate().flat_map(|(i, p)| points[..i].iter().map(move |q| (p, q)));
    pairs.map(|(p, q)| distance(p, q)).fold(0.0, f64::max)
}
