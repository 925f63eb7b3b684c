//! Refinement by size: simplices that meet the box of the inputs are no larger than the caller asks
//! for. Outside the box sizes grow as fast as the quality bound allows.
//!
//! A size is the length of an edge. It is asked for once at each vertex; for a vertex outside the
//! box the nearest point of the box counts, so that the caller knows where questions come from.
//! The least size of its vertices bounds a simplex: its circumradius is at most that of the
//! regular simplex with edges of that length. With `max_edge` no edge is longer than that, too.
//! What a field does between the vertices is not seen. But all points of a simplex are within the
//! diameter of its D-ball from its vertices: where a field changes by at most L times the
//! distance, its bound is kept at all points up to the factor 1 / (1 - 2 L c), where c is the
//! circumradius of the regular simplex with edges of length 1.
//!
//! It ends: a corner goes in that is farther from all vertices than half the size asked for, and
//! the caller answers finitely many sizes at vertices that are as far apart. Where doubles are too
//! coarse a simplex is precision-limited, and `max_vertices` ends what was asked for by mistake.

use crate::complex::{SimplexId, VertexId};
use crate::delaunay::{Cavity, Delaunay};
use crate::error::{Error, ErrorKind, Name, Result, say};
use crate::memory::{Array, TryGrow};
use crate::mesh::{Inputs, MAX_DIM};
use crate::netmesh::Mesher;
use crate::netmesh::cages::domains::ROOT;
use crate::numerics::{Circumball, distance};
use crate::options::SizeFn;
use crate::parameters::Parameters;
use std::cell::RefCell;

/// Circumradii stay this far below what was asked for: the certificate rounds otherwise.
const MARGIN: f64 = 1e-9;

/// Of a vertex at which no size was needed yet.
const UNKNOWN: f64 = f64::NAN;

/// What the caller asks for, where, and what was answered so far.
pub(in crate::netmesh) struct Sizes<'a, const D: usize> {
    function: Option<&'a SizeFn<'a>>,
    /// Infinite if there is none.
    max_edge: f64,
    /// The box of the inputs.
    low: [f64; D],
    high: [f64; D],
    /// Vertex -> what the function answered.
    answers: Array<f64>,
    /// An answer that was no size, while nobody could be told.
    refusal: RefCell<Option<Error>>,
}

impl<'a, const D: usize> Sizes<'a, D> {
    /// `None` if no size is asked for. `by_region`: whether regions have some.
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
        let (answers, refusal) = (Array::new(), RefCell::new(None));
        Some(Self { function, max_edge, low, high, answers, refusal })
    }

    /// The distance from a point to the farthest one of the box.
    pub fn reach(&self, from: &[f64; D]) -> f64 {
        let corner = std::array::from_fn(|axis| {
            // Halves, so that no difference overflows.
            let below = 0.5 * from[axis] - 0.5 * self.low[axis];
            let above = 0.5 * self.high[axis] - 0.5 * from[axis];
            if below > above { self.low[axis] } else { self.high[axis] }
        });
        distance(from, &corner)
    }

    /// What a vertex was answered, infinite if nobody asked; `None` without a function.
    pub fn answer(&self, vertex: VertexId) -> Option<f64> {
        self.function?;
        let answer = self.answers.get(vertex.index()).copied();
        Some(answer.filter(|answer| !answer.is_nan()).unwrap_or(f64::INFINITY))
    }

    /// By what factor a live simplex is larger than it may be; 0 where nothing is asked for.
    /// `max_edge`: that of its region.
    ///
    /// # Errors
    /// `InvalidArgument` if the function answers no size.
    fn excess(&mut self, delaunay: &Delaunay<D>, simplex: SimplexId, max_edge: f64) -> Result<f64> {
        let Some(ball) = delaunay.ball(simplex) else { return Ok(0.0) };
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
        Ok(excess_of(points, ball.radius(), size, max_edge.min(self.max_edge)))
    }

    /// Whether a simplex may be made that has these vertices, with the vertex number `apex` at `x`.
    /// Where the function answers no size it may not, and [`Self::refusal`] has that.
    pub fn allow(
        &self,
        delaunay: &Delaunay<D>,
        vertices: &[VertexId],
        apex: usize,
        x: &[f64; D],
    ) -> bool {
        let mut points = [x; MAX_DIM + 1];
        for (at, &vertex) in vertices.iter().enumerate().filter(|&(at, _)| at != apex) {
            points[at] = delaunay.point(vertex);
        }
        let points = &points[..=D];
        if !self.meets_box(points) {
            return true;
        }
        let mut size = f64::INFINITY;
        for (at, &vertex) in vertices.iter().enumerate() {
            let known = self.answers.get(vertex.index()).filter(|answer| !answer.is_nan());
            let answer = match (known, self.function) {
                _ if at == apex => self.answer_at(x),
                (Some(&known), _) => Ok(known),
                (None, _) => self.answer_at(points[at]),
            };
            match answer {
                Ok(answer) => size = size.min(answer),
                Err(error) => {
                    *self.refusal.borrow_mut() = Some(error);
                    return false;
                }
            }
        }
        excess_of(points, Circumball::new(points).radius(), size, self.max_edge) <= 1.0
    }

    /// Whether the box of a simplex meets that of the inputs.
    fn meets_box(&self, points: &[&[f64; D]]) -> bool {
        (0..D).all(|axis| {
            points.iter().any(|point| point[axis] >= self.low[axis])
                && points.iter().any(|point| point[axis] <= self.high[axis])
        })
    }

    /// The answer of the function for `vertex`, which is at `x`.
    fn ask(&mut self, vertex: VertexId, x: &[f64; D]) -> Result<f64> {
        if self.function.is_none() {
            return Ok(f64::INFINITY);
        }
        self.answers.cover(vertex.index() + 1, UNKNOWN)?;
        if self.answers[vertex].is_nan() {
            self.answers[vertex] = self.answer_at(x)?;
        }
        Ok(self.answers[vertex])
    }

    /// The answer of the function at `x`, or at the nearest point of the box.
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

/// By what factor a simplex is larger than its circumradius and edges may be, with the least answer
/// `size` at its vertices.
fn excess_of<const D: usize>(points: &[&[f64; D]], radius: f64, size: f64, max_edge: f64) -> f64 {
    let allowed = regular_circumradius(D) * size.min(max_edge);
    let of_radius = radius / ((1.0 - MARGIN) * allowed);
    // No edge is longer than the diameter.
    if of_radius > 1.0 || 2.0 * radius <= (1.0 - MARGIN) * max_edge {
        return of_radius;
    }
    of_radius.max(longest_distance(points) / max_edge)
}

/// The circumradius of the regular simplex with edges of length 1.
fn regular_circumradius(dim: usize) -> f64 {
    (dim as f64 / (2 * (dim + 1)) as f64).sqrt()
}

fn longest_distance<const D: usize>(points: &[&[f64; D]]) -> f64 {
    let pairs =
        points.iter().enumerate().flat_map(|(i, p)| points[..i].iter().map(move |q| (p, q)));
    pairs.map(|(p, q)| distance(p, q)).fold(0.0, f64::max)
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// Refines until no simplex is larger than what is asked for, and each cell keeps the bound.
    /// Each vertex is looked at once: what comes later has a later vertex. Returns whether any
    /// simplex was too large.
    pub(in crate::netmesh) fn refine_by_size(&mut self, cavity: &mut Cavity) -> Result<bool> {
        let mut any = false;
        let mut vertex = 0;
        while self.sizes.is_some() && vertex < self.state.delaunay.point_count() {
            self.watch.poll_after(1)?;
            match self.largest_at(VertexId::new(vertex))? {
                Some(simplex) => {
                    any = true;
                    self.destroy(simplex, cavity)?;
                    self.clean(cavity)?;
                }
                None => {
                    vertex += 1;
                    let count = self.state.delaunay.point_count();
                    self.state.stage.size_fraction = vertex as f64 / count as f64;
                    self.note_progress();
                }
            }
        }
        self.report_progress()?;
        Ok(any)
    }

    /// The simplex at `vertex` that is too large by the largest factor.
    fn largest_at(&mut self, vertex: VertexId) -> Result<Option<SimplexId>> {
        if !self.is_inserted(vertex) {
            return Ok(None);
        }
        self.state.delaunay.star(vertex, &mut self.scratch.star)?;
        let mut largest = (1.0, None);
        for at in 0..self.scratch.star.len() {
            let simplex = self.scratch.star[at];
            let excess = self.excess(simplex)?;
            if excess > largest.0 && !self.is_outside(simplex)? {
                largest = (excess, Some(simplex));
            }
        }
        Ok(largest.1)
    }

    /// By what factor a live simplex is larger than it may be; 0 where nothing is asked for, or
    /// nothing can be done.
    fn excess(&mut self, simplex: SimplexId) -> Result<f64> {
        if self.sizes.is_none() || self.state.refine_list.is_limited(simplex) {
            return Ok(0.0);
        }
        let max_edge = self.max_edge_of_region(simplex)?;
        match &mut self.sizes {
            Some(sizes) => sizes.excess(&self.state.delaunay, simplex, max_edge),
            None => Ok(0.0),
        }
    }

    /// After slivers were mended: the sizes at all vertices that count.
    pub(in crate::netmesh) fn ask_all_sizes(&mut self) -> Result<()> {
        if self.sizes.is_none() {
            return Ok(());
        }
        for simplex in self.state.delaunay.complex().simplices() {
            self.watch.poll_after(1)?;
            let Some(sizes) = &mut self.sizes else { return Ok(()) };
            if self.state.delaunay.complex().is_live(simplex) {
                sizes.excess(&self.state.delaunay, simplex, f64::INFINITY)?;
            }
        }
        Ok(())
    }

    /// After `vertex` came or moved: the size there.
    pub(in crate::netmesh) fn ask_size_again(&mut self, vertex: VertexId) -> Result<()> {
        let Some(sizes) = &mut self.sizes else { return Ok(()) };
        if let Some(answer) = sizes.answers.get_mut(vertex.index()) {
            *answer = UNKNOWN;
        }
        sizes.ask(vertex, self.state.delaunay.point(vertex)).map(drop)
    }

    /// Fails if an answer was no size since the last call.
    pub(in crate::netmesh) fn check_sizes(&self) -> Result<()> {
        let refusal = self.sizes.as_ref().and_then(|sizes| sizes.refusal.take());
        refusal.map_or(Ok(()), Err)
    }

    /// Inserts a point into the D-ball of `simplex`, or makes it precision-limited.
    fn destroy(&mut self, simplex: SimplexId, cavity: &mut Cavity) -> Result<()> {
        match self.is_well_inside(simplex, ROOT) {
            true => self.insert_corner(simplex, cavity),
            false => self.narrow_cage_gap(simplex, ROOT, cavity),
        }
    }
}
