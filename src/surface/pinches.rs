//! Vertices at which the surface touches itself, and how it is made a manifold there.
//!
//! The surface is a manifold at a vertex if the simplices round it that are inside are connected
//! across facets which the vertex has, and so are those outside. (In space this holds for edges
//! as well: round an edge with two pieces on each side, a path that connects those inside is, on a
//! sphere about an end of the edge, a closed curve between those outside.)

use super::balls::Balls;
use super::places::Places;
use crate::memory::{AllocResult, Lists, TryGrow, collected, enqueue, filled};
use crate::mesh::NONE;
use crate::query::view::View;
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
    wedges: Wedges,
}

/// The wedges round a vertex: simplices that are on one side and connected there.
struct Wedges {
    places: Places,
    /// Place in the star -> the wedge.
    of: Vec<u32>,
    /// Wedge -> true if it goes on beyond the hull.
    is_open: Vec<bool>,
    is_on_hull: bool,
    stack: Vec<u32>,
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
        wedges: Wedges::new(balls.view.mesh.simplex_count())?,
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
    fn cheapest_change(&mut self, vertex: u32) -> AllocResult<Option<Vec<u32>>> {
        let star = self.stars.of(vertex as usize);
        if self.is_far(vertex, star) {
            return Ok(None);
        }
        self.wedges.part_star(self.balls.view, self.is_inside, vertex, star)?;
        if self.wedges.count() <= 2 {
            return Ok(None);
        }
        let mut cheapest: Option<(f64, Vec<u32>)> = None;
        for wedge in self.wedges.closed() {
            let simplices = collected(self.wedges.simplices(star, wedge))?;
            let cost = self.change_of_cost(&simplices);
            let is_cheaper =
                cheapest.as_ref().is_none_or(|(least, _)| cost.total_cmp(least).is_lt());
            if is_cheaper && self.may_change(&simplices) {
                cheapest = Some((cost, simplices));
            }
        }
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

    fn may_change(&self, wedge: &[u32]) -> bool {
        let may = |&simplex: &u32| {
            self.is_inside[simplex as usize] || self.returns[simplex as usize] < RETURNS
        };
        wedge.iter().all(may)
    }

    /// Returns how much more the surface costs if a wedge changes sides.
    fn change_of_cost(&self, wedge: &[u32]) -> f64 {
        let view = self.balls.view;
        let mut change = 0.0;
        for &simplex in wedge {
            for (corner, &other) in view.neighbors(simplex).iter().enumerate() {
                if wedge.contains(&other) {
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
    fn change(&mut self, wedge: &[u32]) -> AllocResult<()> {
        for &simplex in wedge {
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

impl Wedges {
    /// Makes room for the wedges in a triangulation of so many simplices.
    fn new(simplices: usize) -> AllocResult<Self> {
        Ok(Self {
            places: Places::new(simplices)?,
            of: Vec::new(),
            is_open: Vec::new(),
            is_on_hull: false,
            stack: Vec::new(),
        })
    }

    /// Parts the simplices round a vertex.
    fn part_star<const D: usize>(
        &mut self,
        view: View<'_, D>,
        is_inside: &[bool],
        vertex: u32,
        star: &[u32],
    ) -> AllocResult<()> {
        self.places.turn_to(star);
        self.is_on_hull = false;
        self.is_open.clear();
        self.of.clear();
        star.iter().try_for_each(|_| self.of.try_push(NONE))?;
        for (at, &simplex) in star.iter().enumerate() {
            if self.of[at] == NONE {
                self.grow(view, is_inside, vertex, simplex)?;
            }
        }
        Ok(())
    }

    /// Makes a wedge of a simplex and all that are connected with it.
    fn grow<const D: usize>(
        &mut self,
        view: View<'_, D>,
        is_inside: &[bool],
        vertex: u32,
        first: u32,
    ) -> AllocResult<()> {
        let (wedge, side) = (self.is_open.len() as u32, is_inside[first as usize]);
        let mut is_open = false;
        self.begin(first, wedge)?;
        while let Some(simplex) = self.stack.pop() {
            let corners = view.simplex(simplex).iter().zip(view.neighbors(simplex));
            for (_, &other) in corners.filter(|(corner, _)| **corner != vertex) {
                if other == NONE {
                    self.is_on_hull = true;
                    is_open |= !side;
                } else if is_inside[other as usize] == side {
                    self.begin(other, wedge)?;
                }
            }
        }
        self.is_open.try_push(is_open)
    }

    /// Puts a simplex of the star into a wedge if it is in none.
    fn begin(&mut self, simplex: u32, wedge: u32) -> AllocResult<()> {
        match std::mem::replace(&mut self.of[self.places.of(simplex) as usize], wedge) {
            NONE => self.stack.try_push(simplex),
            _ => Ok(()),
        }
    }

    /// Returns the number of wedges. At a vertex of the hull those that go on beyond it are one, or
    /// what is beyond is one.
    fn count(&self) -> usize {
        self.closed().count() + usize::from(self.is_on_hull)
    }

    /// Returns the wedges that do not go on beyond the hull.
    fn closed(&self) -> impl Iterator<Item = u32> {
        (0..).zip(&self.is_open).filter(|(_, is_open)| !**is_open).map(|(wedge, _)| wedge)
    }

    /// Returns the simplices of a wedge of the star that was parted last, in its order.
    fn simplices<'a>(&'a self, star: &'a [u32], wedge: u32) -> impl Iterator<Item = u32> + 'a {
        let both = star.iter().zip(&self.of);
        both.filter(move |(_, of)| **of == wedge).map(|(&simplex, _)| simplex)
    }
}
