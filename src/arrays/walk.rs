//! A walk from simplex to neighbour that finds the simplices of a mesh that meet a convex body.
//!
//! The simplices whose interior meets a solid body are connected by facets in whose interior the
//! body has interior points: a path between two points that avoids all smaller faces goes through
//! such simplices alone, if the union of the mesh is convex. So only the neighbours of simplices
//! that are known to meet it are tested, and the neighbours of those that turn out to. Simplices
//! that the walk does not reach are outside.

use super::cloud::{Cloud, bounds};
use super::placement::{Placement, Spot};
use super::plane::Plane;
use super::separation::Pair;
use super::solid::{HullCorner, Solid};
use crate::memory::{AllocResult, TryGrow, collected, enqueue};
use crate::mesh::{NONE, Triangulation};
use crate::query::view::View;
use std::collections::VecDeque;

pub(super) struct Walk<'a, const D: usize> {
    view: View<'a, D>,
    /// Vertex -> its position with respect to the body.
    spots: &'a [Spot],
    /// Points whose hull is the body.
    points: Cloud<D>,
    low: [f64; D],
    high: [f64; D],
    is_solid: bool,
    /// Triangulation that has the vertices of [`Spot::Corner`].
    pub solid: Option<&'a Solid>,
    /// Facets of the hull at the corner that was last looked at.
    at_corner: HullCorner<D>,
    /// Planes that separated the last simplices from the body; often one separates the next one,
    /// too.
    planes: Vec<Plane<D>>,
    /// Simplices from which the walk goes on, each with a corner nearby.
    queue: VecDeque<(u32, Option<u32>)>,
}

/// Largest number of separating planes that are kept, and tried at a simplex.
const RECENT: usize = 16;

/// Largest number of corners of the hull whose facets are tried.
const STEPS: usize = 6;

/// Number of facets at a corner above which trying them takes longer than a linear program.
const MANY: usize = 32;

impl<'a, const D: usize> Walk<'a, D> {
    /// Prepares a walk about the body that is the hull of the `corners`.
    pub fn new(
        mesh: &'a Triangulation,
        spots: &'a [Spot],
        corners: &[f64],
        is_solid: bool,
    ) -> AllocResult<Self> {
        let (low, high) = bounds(corners);
        Ok(Self {
            view: View { mesh },
            spots,
            points: Cloud::new(corners)?,
            low,
            high,
            is_solid,
            solid: None,
            at_corner: HullCorner::default(),
            planes: Vec::new(),
            queue: VecDeque::new(),
        })
    }

    /// Returns how each simplex lies with respect to the body.
    pub fn placements(mut self) -> AllocResult<Vec<Placement>> {
        let simplices = 0..self.view.mesh.simplex_count() as u32;
        let mut placements = collected(simplices.map(|simplex| self.at_once(simplex)))?;
        self.settle(&mut placements)?;
        collected(placements.into_iter().map(|placement| placement.unwrap_or(Placement::Outside)))
    }

    /// Returns the placement of a simplex if its vertices determine it, else `None`.
    fn at_once(&self, simplex: u32) -> Option<Placement> {
        let vertices = self.view.simplex(simplex);
        let spot = |vertex: &u32| self.spots[*vertex as usize];
        if vertices.iter().all(|vertex| spot(vertex) != Spot::Outside) {
            return Some(Placement::Inside);
        }
        if vertices.iter().any(|vertex| spot(vertex) == Spot::Interior) {
            return Some(Placement::Across);
        }
        let points = || vertices.iter().map(|&vertex| self.view.point(vertex));
        let is_beyond = (0..D).any(|axis| {
            points().all(|p| p[axis] >= self.high[axis])
                || points().all(|p| p[axis] <= self.low[axis])
        });
        is_beyond.then_some(Placement::Outside)
    }

    /// Finds the placements that are still unknown. Simplices outside a solid body that the walk
    /// does not reach stay unknown.
    fn settle(&mut self, placements: &mut [Option<Placement>]) -> AllocResult<()> {
        let simplices = 0..placements.len() as u32;
        let mut has_begun = false;
        for simplex in simplices.clone() {
            let known = placements[simplex as usize];
            if matches!(known, Some(Placement::Inside | Placement::Across)) {
                let corner = self.corner_of(simplex);
                enqueue(&mut self.queue, (simplex, corner))?;
                has_begun = true;
            }
        }
        self.go_on(placements)?;
        for simplex in simplices {
            if has_begun && self.is_solid {
                break;
            }
            if placements[simplex as usize].is_none() {
                has_begun |= self.visit(simplex, None, placements)?;
                self.go_on(placements)?;
            }
        }
        Ok(())
    }

    /// Visits the neighbours of the simplices in the queue until it is empty.
    fn go_on(&mut self, placements: &mut [Option<Placement>]) -> AllocResult<()> {
        while let Some((simplex, corner)) = self.queue.pop_front() {
            for &neighbor in self.view.neighbors(simplex) {
                if neighbor != NONE && placements[neighbor as usize].is_none() {
                    self.visit(neighbor, corner, placements)?;
                }
            }
        }
        Ok(())
    }

    /// Finds the placement of a simplex, and returns true if its interior meets the body. The walk
    /// goes on from the simplex if it meets the body, or if the body has no interior. `corner` is a
    /// corner of the hull nearby, if one is known.
    fn visit(
        &mut self,
        simplex: u32,
        corner: Option<u32>,
        placements: &mut [Option<Placement>],
    ) -> AllocResult<bool> {
        let corner = self.corner_of(simplex).or(corner);
        let meets = self.meets(simplex, corner)?;
        placements[simplex as usize] =
            Some(if meets { Placement::Across } else { Placement::Outside });
        if meets || !self.is_solid {
            enqueue(&mut self.queue, (simplex, corner))?;
        }
        Ok(meets)
    }

    /// Returns the vertex of the hull's triangulation that a simplex has, if any.
    fn corner_of(&self, simplex: u32) -> Option<u32> {
        let mut vertices = self.view.simplex(simplex).iter();
        vertices.find_map(|&vertex| match self.spots[vertex as usize] {
            Spot::Corner(corner) => Some(corner),
            _ => None,
        })
    }

    fn meets(&mut self, simplex: u32, corner: Option<u32>) -> AllocResult<bool> {
        let points = self.view.points_of(self.view.simplex(simplex));
        let points = &points[..=D];
        if let (Some(corner), Some(solid)) = (corner, self.solid) {
            if self.is_beyond_facet(points, corner, solid)? {
                return Ok(false);
            }
        }
        if self.planes.iter().rev().any(|plane| plane.separates(points)) {
            return Ok(false);
        }
        let plane = Pair { simplex: points, points: &self.points }.separation();
        let meets = plane.is_none();
        if self.planes.len() == RECENT && !meets {
            self.planes.remove(0);
        }
        plane.into_iter().try_for_each(|plane| self.planes.try_push(plane))?;
        Ok(meets)
    }

    /// Returns true if a facet of the hull separates a simplex from it. Facets are tried at a few
    /// corners, on the way to the corner that is nearest to the simplex.
    fn is_beyond_facet(
        &mut self,
        points: &[&[f64; D]],
        mut corner: u32,
        solid: &Solid,
    ) -> AllocResult<bool> {
        let middle: [f64; D] = std::array::from_fn(|axis| {
            points.iter().map(|point| point[axis] / (D + 1) as f64).sum()
        });
        let distance = |point: &[f64; D]| -> f64 {
            point.iter().zip(&middle).map(|(x, m)| (x - m) * (x - m)).sum()
        };
        for _ in 0..STEPS {
            solid.look_around(corner, &mut self.at_corner)?;
            if self.at_corner.facets.len() > MANY {
                break;
            }
            if self.at_corner.facets.iter().any(|facet| facet.separates(points)) {
                return Ok(true);
            }
            let neighbors = self.at_corner.neighbors.iter();
            let nearest = { neighbors }.min_by(|a, b| distance(&a.1).total_cmp(&distance(&b.1)));
            match nearest {
                Some(&(next, _)) if next != corner => corner = next,
                _ => break,
            }
        }
        Ok(false)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Mesh;
    use crate::arrays::tests::{delaunay, each_mesh, meshed};
    use crate::arrays::{ConvexHull, placements_in_box};
    use crate::mesh::Triangulation;
    use crate::numerics::{Sign, orientation};
    use crate::options::Options;
    use crate::query::Index;
    use std::cell::{Cell, RefCell};
    use std::collections::HashMap;

    /// Returns true if the interior of a simplex meets the hull of some points, by the linear
    /// programs of `separation` with the rule of the least index alone and over all points.
    fn meets_slowly<const D: usize>(simplex: &[&[f64; D]], points: &[[f64; D]]) -> bool {
        let vectors = D + 1 + points.len();
        let vector = |at: usize| if at <= D { simplex[at] } else { &points[at - D - 1] };
        let side = |at: usize| if at <= D { Sign::Negative } else { Sign::Positive };
        // The programs of a simplex go through the same bases.
        let turns = RefCell::<HashMap<Vec<usize>, Sign>>::default();
        let turn = |basis: &[usize]| -> Sign {
            let made = || orientation(&basis.iter().map(|&at| vector(at)).collect::<Vec<_>>());
            *turns.borrow_mut().entry(basis.to_vec()).or_insert_with(made)
        };
        // `whole` is the turn of the basis.
        let coordinate = |basis: &[usize], whole: Sign, row: usize, q: usize| {
            let mut replaced = basis.to_vec();
            replaced[row] = q;
            turn(&replaced) * whole * side(basis[row])
        };
        let is_sum = |i: usize| {
            let mut basis: Vec<usize> = (0..=D).collect();
            let whole = turn(&basis);
            let beyond = |&at: &usize| coordinate(&basis, whole, i, at) == Sign::Negative;
            let Some(first) = (D + 1..vectors).find(beyond) else { return false };
            basis[i] = first;
            loop {
                let whole = turn(&basis);
                let is_negative =
                    |&row: &usize| coordinate(&basis, whole, row, i) == Sign::Negative;
                let Some(row) = (0..=D).filter(is_negative).min_by_key(|&row| basis[row]) else {
                    return true;
                };
                let enters = |&at: &usize| {
                    at != i
                        && !basis.contains(&at)
                        && coordinate(&basis, whole, row, at) * side(at) == Sign::Negative
                };
                let Some(at) = (0..vectors).find(enters) else { return false };
                basis[row] = at;
            }
        };
        (0..=D).all(is_sum)
    }

    /// Returns the placement of each simplex, found for itself.
    fn one_by_one<const D: usize>(
        mesh: &Triangulation,
        points: &[[f64; D]],
        is_inside: impl Fn(u32) -> bool,
    ) -> Vec<Placement> {
        let view = View::<D> { mesh };
        let place = |simplex: u32| {
            let vertices = view.simplex(simplex);
            match () {
                () if vertices.iter().all(|&vertex| is_inside(vertex)) => Placement::Inside,
                () if meets_slowly(&view.points_of(vertices)[..=D], points) => Placement::Across,
                () => Placement::Outside,
            }
        };
        (0..mesh.simplex_count() as u32).map(place).collect()
    }

    fn check<const D: usize>(mesh: &Mesh, seen: &Cell<[usize; 3]>, name: &str) {
        let (result, inputs) = (mesh.triangulation().unwrap(), mesh.inputs().distinct_points());
        let points: Vec<[f64; D]> =
            inputs.chunks_exact(D).map(|point| point.try_into().unwrap()).collect();
        let solid = meshed(&points, &delaunay());
        let solid = solid.as_ref().and_then(Mesh::triangulation);
        let hull = match solid {
            Some(solid) => ConvexHull::of_triangulation(solid.clone()).unwrap(),
            None => ConvexHull::of_flat_points(D, inputs.to_vec()),
        };
        let mut simplices = vec![NONE; result.vertex_count()];
        if let Some(solid) = solid {
            let index = Index::new(solid).unwrap();
            index.locate(solid, &result.points, 1, &mut simplices).unwrap();
        }
        let found = hull.placements(result, 1).unwrap();
        let expected = one_by_one(result, &points, |vertex| simplices[vertex as usize] != NONE);
        assert!(found == expected, "{name}: the hull of {points:?}");
        found.iter().for_each(|&placement| {
            let mut counts = seen.get();
            counts[placement as usize] += 1;
            seen.set(counts);
        });
        let (low, high) = bounds::<D>(&inputs);
        let corner = |set: usize| -> [f64; D] {
            std::array::from_fn(|axis| if set >> axis & 1 == 1 { high[axis] } else { low[axis] })
        };
        let corners: Vec<[f64; D]> = (0..1 << D).map(corner).collect();
        let is_inside = |vertex: u32| {
            let point = result.point(vertex).iter().enumerate();
            { point }.all(|(axis, x)| (low[axis]..=high[axis]).contains(x))
        };
        let found = placements_in_box(result, &inputs).unwrap();
        assert!(found == one_by_one(result, &corners, is_inside), "{name}: the box of {points:?}");
    }

    fn placements_are_right<const D: usize>(count: usize) {
        let seen = Cell::default();
        each_mesh::<D>(count, |mesh, family| check::<D>(mesh, &seen, &format!("{family:?}")));
        assert!(seen.get().iter().all(|&count| count >= 10), "{:?}", seen.get());
    }

    #[test]
    fn placements_are_those_of_a_linear_program_for_each_simplex() {
        placements_are_right::<2>(30);
        placements_are_right::<3>(12);
        placements_are_right::<4>(7);
        placements_are_right::<5>(8);
    }

    /// Placements are right at hulls with many corners whose cone is a half-space, or nearly.
    #[test]
    fn placements_at_flat_and_round_hulls_are_right() {
        let seen = Cell::default();
        let lattice: Vec<[f64; 3]> =
            (0..64).map(|i| [i % 4, i / 4 % 4, i / 16].map(f64::from)).collect();
        let slab: Vec<[f64; 3]> = (0..50)
            .map(|i| [f64::from(i % 5), f64::from(i / 10), f64::from(i / 5 % 2) / 64.0])
            .collect();
        let golden = |i: u32| f64::from(i) * 2.399_963;
        let height = |i: u32| 1.0 - (f64::from(i) + 0.5) / 20.0;
        let sphere: Vec<[f64; 3]> = (0..40)
            .map(|i| {
                let (z, radius) = (height(i), (1.0 - height(i) * height(i)).sqrt());
                [radius * golden(i).cos(), radius * golden(i).sin(), z]
            })
            .collect();
        for (name, points) in [("lattice", lattice), ("slab", slab), ("sphere", sphere)] {
            let mesh = meshed(&points, &Options::default()).unwrap();
            check::<3>(&mesh, &seen, name);
        }
        assert!(seen.get().iter().all(|&count| count > 100), "{:?}", seen.get());
    }
}
