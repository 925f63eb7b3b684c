//! Vertices at which the surface touches itself, and how it is made a manifold there.
//!
//! The surface is a manifold at a vertex if the simplices round it that are inside are connected
//! across facets which the vertex has, and so are those outside. (In space this holds for edges
//! as well: round an edge with two pieces on each side, a path that connects those inside is, on a
//! sphere about an end of the edge, a closed curve between those outside.)

use super::balls::Balls;
use crate::memory::{AllocResult, Lists, TryGrow, enqueue, filled};
use crate::mesh::NONE;
use std::collections::VecDeque;

/// Number of times that a simplex may become inside; afterwards it may leave, but not return, so
/// that there is an end.
const RETURNS: u8 = 2;

/// The work of making a surface a manifold.
struct Pinches<'a, const D: usize> {
    balls: &'a Balls<'a, D>,
    stars: &'a Lists,
    is_inside: &'a mut [bool],
    /// Simplex -> the number of times that it became inside.
    returns: Vec<u8>,
    waiting: VecDeque<u32>,
    is_waiting: Vec<bool>,
}

/// Simplices round a vertex that are on one side and connected.
#[derive(Default)]
struct Wedge {
    simplices: Vec<u32>,
    /// True if it goes on beyond the hull.
    is_open: bool,
}

/// Changes the sides of simplices until the surface is a manifold: at each vertex where it touches
/// itself, of the connected simplices there those whose change costs least ([`Balls::cost`]).
/// Returns true if there were changes.
pub fn unpinch<const D: usize>(
    balls: &Balls<'_, D>,
    stars: &Lists,
    is_inside: &mut [bool],
) -> AllocResult<bool> {
    let vertices = balls.view.mesh.vertex_count();
    let mut pinches = Pinches {
        balls,
        stars,
        returns: filled(is_inside.len(), 0u8)?,
        is_inside,
        waiting: VecDeque::new(),
        is_waiting: filled(vertices, false)?,
    };
    // Vertices near each other, one after the other.
    balls.view.mesh.simplices.iter().try_for_each(|&vertex| pinches.wait(vertex))?;
    let mut has_changed = false;
    while let Some(vertex) = pinches.waiting.pop_front() {
        pinches.is_waiting[vertex as usize] = false;
        if let Some(wedge) = pinches.cheapest_change(vertex)? {
            pinches.change(&wedge)?;
            has_changed = true;
        }
    }
    Ok(has_changed)
}

impl<const D: usize> Pinches<'_, D> {
    /// Puts a vertex last among those that are to be looked at, if it is not there.
    fn wait(&mut self, vertex: u32) -> AllocResult<()> {
        match std::mem::replace(&mut self.is_waiting[vertex as usize], true) {
            true => Ok(()),
            false => enqueue(&mut self.waiting, vertex),
        }
    }

    /// Returns what to change at a vertex; nothing where the surface is a manifold.
    fn cheapest_change(&self, vertex: u32) -> AllocResult<Option<Wedge>> {
        let star = self.stars.of(vertex as usize);
        if self.is_far(vertex, star) {
            return Ok(None);
        }
        let wedges = self.wedges(vertex, star)?;
        if wedges.len() <= 2 {
            return Ok(None);
        }
        let costs = |wedge: Wedge| (self.change_of_cost(&wedge), wedge);
        let may_change = wedges.into_iter().filter(|wedge| self.may_change(wedge));
        let cheapest = may_change.map(costs).min_by(|a, b| a.0.total_cmp(&b.0));
        Ok(cheapest.map(|(_, wedge)| wedge))
    }

    /// Returns true if all round the vertex is on one side.
    fn is_far(&self, vertex: u32, star: &[u32]) -> bool {
        let side = star.first().is_some_and(|&simplex| self.is_inside[simplex as usize]);
        let is_there = |&simplex: &u32| self.is_inside[simplex as usize] == side;
        star.iter().all(is_there) && (!side || !star.iter().any(|&s| self.reaches_out(s, vertex)))
    }

    /// Returns true if a simplex has a facet of the hull with the vertex.
    fn reaches_out(&self, simplex: u32, vertex: u32) -> bool {
        let view = self.balls.view;
        let corners = view.simplex(simplex).iter().zip(view.neighbors(simplex));
        corners.into_iter().any(|(&corner, &neighbor)| neighbor == NONE && corner != vertex)
    }

    /// Returns the wedges round a vertex. If it is on the hull, what is beyond is one or joins one.
    fn wedges(&self, vertex: u32, star: &[u32]) -> AllocResult<Vec<Wedge>> {
        let mut wedges: Vec<Wedge> = Vec::new();
        let mut is_taken = filled(star.len(), false)?;
        let mut stack = Vec::new();
        let mut is_on_hull = false;
        for from in 0..star.len() {
            if is_taken[from] {
                continue;
            }
            is_taken[from] = true;
            stack.try_push(star[from])?;
            let mut wedge = Wedge::default();
            while let Some(simplex) = stack.pop() {
                wedge.simplices.try_push(simplex)?;
                let side = self.is_inside[simplex as usize];
                let view = self.balls.view;
                for (k, &other) in view.neighbors(simplex).iter().enumerate() {
                    if view.simplex(simplex)[k] == vertex {
                        continue;
                    }
                    if other == NONE {
                        is_on_hull = true;
                        wedge.is_open |= !side;
                    } else if self.is_inside[other as usize] == side {
                        let at = star.binary_search(&other).expect("a simplex of the star");
                        if !is_taken[at] {
                            is_taken[at] = true;
                            stack.try_push(other)?;
                        }
                    }
                }
            }
            wedges.try_push(wedge)?;
        }
        if is_on_hull {
            // Wedges that go on beyond the hull are one there.
            wedges.retain(|wedge| !wedge.is_open);
            wedges.try_push(Wedge { simplices: Vec::new(), is_open: true })?;
        }
        Ok(wedges)
    }

    fn may_change(&self, wedge: &Wedge) -> bool {
        let may = |&simplex: &u32| {
            self.is_inside[simplex as usize] || self.returns[simplex as usize] < RETURNS
        };
        !wedge.is_open && wedge.simplices.iter().all(may)
    }

    /// Returns how much more the surface costs if a wedge changes sides.
    fn change_of_cost(&self, wedge: &Wedge) -> f64 {
        let view = self.balls.view;
        let mut change = 0.0;
        for &simplex in &wedge.simplices {
            for (corner, &other) in view.neighbors(simplex).iter().enumerate() {
                if wedge.simplices.contains(&other) {
                    continue;
                }
                let there = other != NONE && self.is_inside[other as usize];
                let is_on_surface = there != self.is_inside[simplex as usize];
                let cost = self.balls.cost(simplex, corner);
                change += if is_on_surface { -cost } else { cost };
            }
        }
        change
    }

    /// Changes the side of a wedge. All vertices of its simplices wait to be looked at again.
    fn change(&mut self, wedge: &Wedge) -> AllocResult<()> {
        for &simplex in &wedge.simplices {
            let is_inside = &mut self.is_inside[simplex as usize];
            *is_inside = !*is_inside;
            self.returns[simplex as usize] += u8::from(*is_inside);
            for &vertex in self.balls.view.simplex(simplex) {
                self.wait(vertex)?;
            }
        }
        Ok(())
    }
}
