//! Weights of natural neighbours: the vertices that a point would be joined to if it went in.

use super::Interpolation;
use super::barycentric::System;
use super::dual::{Chains, dot};
use super::locate::Place;
use super::marked_ids::MarkedIds;
use super::tetrahedron;
use super::unit::{Unit, largest};
use super::view::View;
use crate::memory::{AllocResult, TryGrow};
use crate::mesh::NONE;
use crate::nearest::Stop;
use crate::numerics::{Circumball, Sign, in_ball, norm, orientation};

/// A weight with a larger error than this is no weight.
const MAX_ERROR: f64 = 1e-6;

/// The weights of one point, and memory to find them.
#[derive(Default)]
pub(super) struct Natural {
    neighbors: MarkedIds,
    /// Weight of each of the neighbours.
    weights: Vec<f64>,
    chains: Chains,
}

impl Natural {
    pub fn weights(&self) -> impl Iterator<Item = (u32, f64)> + Clone {
        self.neighbors.members().iter().map(|member| member.id).zip(self.weights.iter().copied())
    }

    /// Finds the weights of `q`, whose place is in the mesh. False if it has none of its own: on a
    /// vertex, on the hull, and where rounding errors leave nothing of them: next to the hull,
    /// where circumcentres are far away. Linear interpolation is what they tend to on the hull.
    /// False, too, soon after `stop` is set.
    pub fn weigh<const D: usize>(
        &mut self,
        view: View<'_, D>,
        interpolation: Interpolation,
        place: Place,
        q: &[f64; D],
        cavity: &mut MarkedIds,
        stop: Stop<'_>,
    ) -> AllocResult<bool> {
        if place.dimension() == Some(0) {
            return Ok(false);
        }
        find_conflicts(view, place.simplex, q, cavity, stop)?;
        self.find_neighbors(view, cavity)?;
        let unit = unit_around(view, &self.neighbors, q);
        for at in 0..cavity.members().len() {
            if stop.is_set() {
                return Ok(false);
            }
            let member = cavity.members()[at];
            if !member.mark {
                continue;
            }
            let simplex = view.simplex(member.id);
            let mut points = view.points_of(simplex);
            if interpolation == Interpolation::Sibson {
                self.add_cells(simplex, &points[..=D], NONE, 1.0, unit);
            }
            for (i, &neighbor) in view.neighbors(member.id).iter().enumerate() {
                if cavity.mark(neighbor) == Some(true) {
                    continue;
                }
                let kept = std::mem::replace(&mut points[i], q);
                if neighbor == NONE && orientation(&points[..=D]) != Sign::Positive {
                    return Ok(false);
                }
                match interpolation {
                    Interpolation::Sibson => {
                        self.add_cells(simplex, &points[..=D], simplex[i], -1.0, unit);
                    }
                    _ => self.add_facets(simplex, &points[..=D], i, unit),
                }
                points[i] = kept;
            }
        }
        Ok(self.finish(view, q, unit))
    }

    /// Collects the vertices of the simplices in conflict, without weight.
    fn find_neighbors<const D: usize>(
        &mut self,
        view: View<'_, D>,
        cavity: &MarkedIds,
    ) -> AllocResult<()> {
        self.neighbors.clear();
        self.weights.clear();
        for member in cavity.members().iter().filter(|member| member.mark) {
            for &vertex in view.simplex(member.id) {
                if self.neighbors.position(vertex).is_none() {
                    self.neighbors.add(vertex, true)?;
                    self.weights.try_push(0.0)?;
                }
            }
        }
        Ok(())
    }

    /// Adds what the simplex contributes to the cells of its vertices, times `factor`, but for the
    /// vertex `left_out`, in whose place the point stands.
    fn add_cells<const D: usize>(
        &mut self,
        simplex: &[u32],
        points: &[&[f64; D]],
        left_out: u32,
        factor: f64,
        unit: Unit,
    ) {
        let center = Circumball::new(points).into();
        if D == 3 {
            if let Some(cells) = tetrahedron::cells(points, &center, unit) {
                let of_vertices = simplex.iter().zip(cells).filter(|&(&v, _)| v != left_out);
                of_vertices.for_each(|(&vertex, cell)| self.add(vertex, factor * cell));
                return;
            }
        }
        for (base, &vertex) in simplex.iter().enumerate().filter(|&(_, &v)| v != left_out) {
            self.chains.of(points, base, &center, unit);
            self.add(vertex, factor * self.chains.of_cell());
        }
    }

    /// Adds what a simplex of the point, number `base`, and a facet contributes to the facets of
    /// cells between the point and the facet's vertices, over their distances.
    fn add_facets<const D: usize>(
        &mut self,
        simplex: &[u32],
        points: &[&[f64; D]],
        base: usize,
        unit: Unit,
    ) {
        self.chains.of(points, base, &Circumball::new(points).into(), unit);
        for i in (0..=D).filter(|&i| i != base) {
            let distance = norm(&unit.difference(points[i], points[base]));
            self.add(simplex[i], self.chains.of_facet::<D>(base, i) / distance);
        }
    }

    fn add(&mut self, vertex: u32, weight: f64) {
        if let Some(at) = self.neighbors.position(vertex) {
            self.weights[at] += weight;
        }
    }

    /// Makes the weights sum to one and takes rounding errors away; false if those are too large.
    fn finish<const D: usize>(&mut self, view: View<'_, D>, q: &[f64; D], unit: Unit) -> bool {
        let sum: f64 = self.weights.iter().sum();
        if !(sum > 0.0 && sum.is_finite()) {
            return false;
        }
        self.weights.iter_mut().for_each(|weight| *weight /= sum);
        // A weight is a share: one below zero is the error of volumes that nearly cancel.
        if self.weights.iter().any(|&weight| weight < -MAX_ERROR) {
            return false;
        }
        self.correct(view, q, unit);
        self.correct(view, q, unit);
        self.weights.iter().all(|weight| weight.is_finite())
    }
}

impl Natural {
    /// Multiplies the weights by a function near one, linear in space, so that they combine the
    /// neighbours to the point itself: with offsets x and weights w, by 1 + b.x, where the sum of
    /// w x (1 + b.x) is zero.
    fn correct<const D: usize>(&mut self, view: View<'_, D>, q: &[f64; D], unit: Unit) {
        let mut system = System { rows: [[0.0; D]; D], right: [0.0; D] };
        for (vertex, weight) in self.weights() {
            let offset = unit.difference(view.point(vertex), q);
            for (i, row) in system.rows.iter_mut().enumerate() {
                system.right[i] -= weight * offset[i];
                (0..D).for_each(|j| row[j] += weight * offset[i] * offset[j]);
            }
        }
        let slope = system.solve(D);
        let mut sum = 0.0;
        for (member, weight) in self.neighbors.members().iter().zip(&mut self.weights) {
            *weight *= 1.0 + dot(&slope, &unit.difference(view.point(member.id), q));
            sum += *weight;
        }
        self.weights.iter_mut().for_each(|weight| *weight /= sum);
    }
}

/// Collects the simplices whose balls hold `q`, which are connected, with a mark, and others next
/// to them.
fn find_conflicts<const D: usize>(
    view: View<'_, D>,
    start: u32,
    q: &[f64; D],
    cavity: &mut MarkedIds,
    stop: Stop<'_>,
) -> AllocResult<()> {
    cavity.clear();
    cavity.add(start, true)?;
    let mut done = 0;
    while let Some(&member) = cavity.members().get(done).filter(|_| !stop.is_set()) {
        done += 1;
        if !member.mark {
            continue;
        }
        for &neighbor in view.neighbors(member.id) {
            if neighbor != NONE && cavity.mark(neighbor).is_none() {
                let points = view.points_of(view.simplex(neighbor));
                cavity.add(neighbor, in_ball(&points[..=D], q) == Sign::Positive)?;
            }
        }
    }
    Ok(())
}

/// Returns a unit in which the farthest of the vertices is about 1 from `q`.
fn unit_around<const D: usize>(view: View<'_, D>, vertices: &MarkedIds, q: &[f64; D]) -> Unit {
    let points = || vertices.members().iter().map(|member| view.point(member.id));
    let magnitude = points().chain([q]).map(largest).fold(0.0, f64::max);
    let unit = Unit::of_points(magnitude);
    let farthest = points().map(|point| largest(&unit.difference(point, q))).fold(0.0, f64::max);
    unit.scaled_to(farthest)
}
