//! Umbrellas: the facets of a vertex between its simplices on the one side of the surface and those
//! on the other (T. K. Dey, "Curve and Surface Reconstruction", 2007, chapter 4).
//!
//! The two poles of a vertex are on different sides; simplices round it whose balls intersect
//! deeply are on one. So they are parted where balls intersect least on the way from pole to pole:
//! a watershed. Both sides are connected, hence in space an umbrella is one cycle of triangles, in
//! the plane two edges. Vertices of a surface that is sampled well agree about its facets, others
//! do not.

use super::places::Places;
use super::poles::Poles;
use crate::memory::{AllocResult, Lists, TryGrow, collected, filled};
use crate::mesh::NONE;
use crate::query::view::View;

/// The umbrellas of all vertices of a Delaunay triangulation.
pub struct Umbrellas<'a, const D: usize> {
    view: View<'a, D>,
    /// Place of a facet in `neighbors`, of its two places the first -> bit k is 1 if vertex k of
    /// the simplex has the facet in its umbrella.
    having: Vec<u8>,
}

/// Neighbours round a vertex, by their places in its star. What is beyond the hull comes after all
/// places.
struct Step {
    depth: f64,
    here: u32,
    there: u32,
}

/// The simplices round a vertex, and space to part them.
struct Watershed {
    places: Places,
    steps: Vec<Step>,
    /// Place in the star -> one above it in the tree of its set; a root is above itself.
    above: Vec<u32>,
}

impl<'a, const D: usize> Umbrellas<'a, D> {
    /// Parts the simplices round each vertex. `depths` has for each facet, at the first of its
    /// places, how deeply the balls beside it intersect. O(simplices).
    pub fn new(
        view: View<'a, D>,
        depths: &[f64],
        stars: &Lists,
        poles: &[Poles],
    ) -> AllocResult<Self> {
        // Simplex -> bit k is 1 if it is on the side of the second pole of its vertex k. What is
        // beyond the hull is on the side of first poles.
        let mut is_second = filled(view.mesh.simplex_count(), 0u8)?;
        let places = Places::new(view.mesh.simplex_count())?;
        let mut watershed = Watershed { places, steps: Vec::new(), above: Vec::new() };
        for (vertex, poles) in (0..).zip(poles).filter(|(_, poles)| poles.second != NONE) {
            let star = stars.of(vertex as usize);
            watershed.part_star(view, depths, vertex, star, poles)?;
            let second = watershed.root(watershed.places.of(poles.second));
            for (at, &simplex) in (0..).zip(star) {
                let bit = u8::from(watershed.root(at) == second);
                is_second[simplex as usize] |= bit << corner(view, simplex, vertex);
            }
        }
        let facets = 0..view.mesh.neighbors.len();
        let having = collected(facets.map(|at| parted(view, &is_second, at)))?;
        Ok(Self { view, having })
    }

    /// Returns the number of vertices that have a facet, given by its first place, in their
    /// umbrellas.
    pub fn votes(&self, at: usize) -> u32 {
        self.having[at].count_ones()
    }

    /// Calls a function with the first place of each facet that is in an umbrella, and with each
    /// vertex that has it there.
    pub fn for_each_member(&self, mut call: impl FnMut(usize, u32)) {
        for (at, having) in self.having.iter().enumerate().filter(|(_, having)| **having != 0) {
            let vertices = (0..).zip(self.view.simplex((at / (D + 1)) as u32));
            let having = vertices.filter(|(k, _)| having >> k & 1 == 1);
            having.for_each(|(_, &vertex)| call(at, vertex));
        }
    }

    /// Returns for each vertex how much of its umbrella, from 0 to 1, is of facets that all their
    /// vertices have in theirs; 0 for a vertex without poles. O(simplices).
    pub fn agreements(&self) -> AllocResult<Vec<f64>> {
        let count = self.view.mesh.vertex_count();
        let (mut all, mut agreed) = (filled(count, 0u32)?, filled(count, 0u32)?);
        self.for_each_member(|at, vertex| {
            all[vertex as usize] += 1;
            agreed[vertex as usize] += u32::from(self.votes(at) == D as u32);
        });
        let part = |(agreed, all): (u32, u32)| f64::from(agreed) / f64::from(all.max(1));
        collected(agreed.into_iter().zip(all).map(part))
    }
}

impl Watershed {
    /// Parts the star of a vertex: its simplices join, the deepest balls first, but for the sets of
    /// the two poles.
    fn part_star<const D: usize>(
        &mut self,
        view: View<'_, D>,
        depths: &[f64],
        vertex: u32,
        star: &[u32],
        poles: &Poles,
    ) -> AllocResult<()> {
        self.places.turn_to(star);
        self.add_steps(view, depths, vertex, star)?;
        self.steps.sort_unstable_by(|a, b| b.depth.total_cmp(&a.depth));
        self.above.clear();
        (0..=star.len() as u32).try_for_each(|at| self.above.try_push(at))?;
        let [first, second] = [poles.first, poles.second].map(|pole| self.places.of(pole));
        for step in 0..self.steps.len() {
            let Step { here, there, .. } = self.steps[step];
            let [here, there, first, second] = [here, there, first, second].map(|at| self.root(at));
            if [here, there] != [first, second] && [here, there] != [second, first] {
                self.above[here as usize] = there;
            }
        }
        Ok(())
    }

    /// Collects the steps between simplices of a star across facets that its vertex has.
    fn add_steps<const D: usize>(
        &mut self,
        view: View<'_, D>,
        depths: &[f64],
        vertex: u32,
        star: &[u32],
    ) -> AllocResult<()> {
        self.steps.clear();
        for (here, &simplex) in (0..).zip(star) {
            let neighbors = view.neighbors(simplex).iter().enumerate();
            for (k, &neighbor) in neighbors.filter(|(_, neighbor)| **neighbor > simplex) {
                if view.simplex(simplex)[k] != vertex {
                    let depth = depths[simplex as usize * (D + 1) + k];
                    self.steps.try_push(Step { depth, here, there: self.places.of(neighbor) })?;
                }
            }
        }
        Ok(())
    }

    fn root(&mut self, mut at: u32) -> u32 {
        while self.above[at as usize] != at {
            let above = self.above[at as usize];
            self.above[at as usize] = self.above[above as usize];
            at = above;
        }
        at
    }
}

/// Returns which vertex of a simplex a vertex is.
fn corner<const D: usize>(view: View<'_, D>, simplex: u32, vertex: u32) -> usize {
    let vertices = view.simplex(simplex);
    vertices.iter().position(|&other| other == vertex).expect("a vertex of the simplex")
}

/// Returns for the facet at a place, if it is the facet's first, which vertices of the simplex have
/// its two sides parted.
fn parted<const D: usize>(view: View<'_, D>, is_second: &[u8], at: usize) -> u8 {
    let (simplex, opposite, neighbor) =
        ((at / (D + 1)) as u32, at % (D + 1), view.mesh.neighbors[at]);
    if neighbor < simplex {
        return 0;
    }
    let here = is_second[simplex as usize];
    let there = |k: usize, vertex: u32| match neighbor {
        NONE => 0,
        _ => (is_second[neighbor as usize] >> corner(view, neighbor, vertex) & 1) << k,
    };
    let vertices = view.simplex(simplex).iter().enumerate().filter(|(k, _)| *k != opposite);
    vertices.map(|(k, &vertex)| (here & 1 << k) ^ there(k, vertex)).sum()
}
