//! The mesh without one vertex, as far as it differs from that with it: where the vertex may go is
//! judged here, and nothing is changed.

use crate::complex::{Beside, SimplexId, VertexId};
use crate::delaunay::{Delaunay, Hole};
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow};
use crate::netmesh::slivers::cone::{Account, Cone};
use crate::netmesh::slivers::shape::{in_space, tetrahedron};
use crate::netmesh::slivers::view::View;
use crate::numerics::{Sign, distance, in_ball};

/// A vertex with more neighbours than this stays: its hole would take too long to fill.
const MOST_NEIGHBORS: usize = 128;

/// A cavity with more simplices than this outside the hole is not looked through.
const MOST_OUTSIDE: usize = 256;

#[derive(Default)]
pub(super) struct Vacancy {
    pub hole: Hole<3>,
    /// The distance of the nearest neighbour.
    pub nearest: f64,
    /// The middle of the neighbours.
    pub middle: Vec<f64>,
    /// Sum of the penalties of the simplices at the vertex.
    star: f64,
    /// Simplex of the filling -> what it adds to the objective.
    penalties: Vec<f64>,
    /// Facet of the hole's boundary -> the simplex of the filling there.
    fillings: Vec<u32>,
    /// Simplex of the filling -> true if its ball holds the place that is judged.
    is_inside: Vec<bool>,
    /// The simplices outside the hole whose balls do.
    outside: Vec<SimplexId>,
    seen: Seen,
    cone: Cone,
}

/// A place for the vertex.
#[derive(Clone, Copy)]
pub(super) struct Target {
    pub x: [f64; 3],
    pub gain: f64,
    /// A simplex of the filling whose ball holds it.
    pub near: usize,
    /// True if the move leaves no sliver at either place.
    pub is_clean: bool,
}

/// Marks of a search on the simplices of the mesh.
#[derive(Default)]
struct Seen {
    /// Simplex -> the number of the search that saw it last, and what it saw.
    marks: Vec<u32>,
    search: u32,
}

/// Marks of a search are its number and these.
const INSIDE: u32 = 0;

const OUTSIDE: u32 = 1;

const OF_STAR: u32 = 2;

impl Seen {
    fn begin(&mut self, star: &[SimplexId]) {
        if self.search >= u32::MAX - 2 * (OF_STAR + 1) {
            self.marks.fill(0);
            self.search = 0;
        }
        self.search += OF_STAR + 1;
        star.iter().for_each(|&simplex| self.mark(simplex, OF_STAR));
    }

    #[inline]
    fn mark(&mut self, simplex: SimplexId, mark: u32) {
        self.marks[simplex] = self.search + mark;
    }

    #[inline]
    fn is(&self, simplex: SimplexId, mark: u32) -> bool {
        self.marks[simplex] == self.search + mark
    }

    #[inline]
    fn is_new(&self, simplex: SimplexId) -> bool {
        self.marks[simplex] < self.search
    }
}

/// Finds the hole of `vertex`; false if the vertex must stay: it is at the hull, or its neighbours
/// are many.
pub(super) fn may_leave(
    delaunay: &mut Delaunay<3>,
    vertex: VertexId,
    hole: &mut Hole<3>,
) -> AllocResult<bool> {
    delaunay.find_small_hole(vertex, MOST_NEIGHBORS, hole)
}

impl Vacancy {
    /// Measures what is found by [`may_leave`].
    pub fn measure(&mut self, view: View<'_>, vertex: VertexId) -> AllocResult<()> {
        let count = self.hole.filling.len();
        self.penalties.clear();
        self.is_inside.cover(count, false)?;
        self.fillings.cover(self.hole.boundary.len(), 0)?;
        self.seen.marks.cover(view.delaunay.complex().simplex_bound(), 0)?;
        self.star = view.sum(&self.hole.star);
        for number in 0..count as u32 {
            for &beside in self.hole.filling.beside(number) {
                if let Beside::Boundary(at) = beside {
                    self.fillings[at as usize] = number;
                }
            }
        }
        for number in (0..count as u32).step_by(2) {
            let last = count as u32 - 1;
            let pair = [number, last.min(number + 1)]
                .map(|number| tetrahedron(view.delaunay, self.hole.filling.vertices(number)));
            let penalties = view.measure.penalties(pair.each_ref());
            self.penalties.try_extend(&penalties)?;
        }
        self.penalties.truncate(count);
        self.measure_neighbors(view, vertex)
    }

    fn measure_neighbors(&mut self, view: View<'_>, vertex: VertexId) -> AllocResult<()> {
        let neighbors = &self.hole.vertices.ids;
        let x = view.delaunay.point(vertex);
        self.nearest = f64::INFINITY;
        self.middle.clear();
        self.middle.try_extend(x)?;
        let share = 1.0 / neighbors.len() as f64;
        for &neighbor in neighbors.iter() {
            let other = view.delaunay.point(neighbor);
            self.nearest = self.nearest.min(distance(x, other));
            for axis in 0..3 {
                self.middle[axis] += share * (other[axis] - x[axis]);
            }
        }
        Ok(())
    }

    /// Returns the gain of removing the vertex, if that is more than `least`.
    pub fn judge_removal(&mut self, view: View<'_>, least: f64) -> Result<Option<f64>> {
        let gain = self.star - self.penalties.iter().sum::<f64>();
        self.is_inside[..self.hole.balls.len()].fill(false);
        let is_kept = gain > least
            && self.keeps_filling_cells(view, None)
            && self.keeps_filling_sizes(view)?;
        Ok(is_kept.then_some(gain))
    }

    /// Returns a simplex of the filling whose ball holds `x`.
    pub fn filling_at(&self, delaunay: &Delaunay<3>, x: &[f64; 3]) -> Option<usize> {
        (0..self.hole.filling.len()).find(|&number| {
            let vertices = self.hole.filling.vertices(number as u32);
            let points: [&[f64; 3]; 4] = std::array::from_fn(|i| delaunay.point(vertices[i]));
            in_ball(&points, x) == Sign::Positive
        })
    }

    /// Returns the gain of moving the vertex to `x`, if that is more than `least`.
    pub fn judge(&mut self, view: View<'_>, x: &[f64; 3], least: f64) -> Result<Option<Target>> {
        let Some((near, left)) = self.find_inside(view, x) else { return Ok(None) };
        let Some(lost) = self.find_outside(view, x)? else { return Ok(None) };
        let before = self.star + lost;
        let gain = before - left;
        if gain <= least {
            return Ok(None);
        }
        let mut account = Account::new(view.measure, gain, least);
        let apex_point = in_space(x);
        let is_worth = self.all_sides(view, |vertices, apex| {
            let mut tetrahedron = tetrahedron(view.delaunay, vertices);
            tetrahedron[apex] = apex_point;
            account.charge(tetrahedron)
        });
        let Some(gain) = account.rest().filter(|_| is_worth) else { return Ok(None) };
        if view.measure.half_aspect.is_some() || view.sizes.is_some() || view.has_boundary {
            self.find_cone(view)?;
            let is_kept = view.keeps_boundary(&self.outside, &self.cone)
                && self.keeps_filling_cells(view, Some(x))
                && self.cone.keeps_cells(view, x)
                && self.keeps_filling_sizes(view)?
                && self.cone.keeps_sizes(view, x, self.max_edge(view))?;
            if !is_kept {
                return Ok(None);
            }
        }
        Ok(Some(Target { x: *x, gain, near, is_clean: gain >= before }))
    }

    /// Returns a simplex of the filling whose ball holds `x`, and the penalties of those whose
    /// balls do not. `None` if there is none, or one that floating-point arithmetic cannot tell.
    fn find_inside(&mut self, view: View<'_>, x: &[f64; 3]) -> Option<(usize, f64)> {
        let (mut near, mut left) = (None, 0.0);
        for (number, ball) in self.hole.balls.iter().enumerate() {
            let vertices = self.hole.filling.vertices(number as u32);
            let anchor = view.delaunay.point(vertices[ball.anchor]);
            let is_inside = ball.side(anchor, x)?;
            self.is_inside[number] = is_inside;
            if is_inside {
                near = Some(number);
            } else {
                left += self.penalties[number];
            }
        }
        near.map(|near| (near, left))
    }

    /// Finds the simplices outside the hole whose balls hold `x`; returns what they add. `None` if
    /// one is beyond the hull or of another domain, or they are too many.
    fn find_outside(&mut self, view: View<'_>, x: &[f64; 3]) -> AllocResult<Option<f64>> {
        let complex = view.delaunay.complex();
        self.seen.begin(&self.hole.star);
        self.outside.clear();
        for facet in &self.hole.boundary {
            see(&mut self.seen, &mut self.outside, view, facet.beyond, x)?;
        }
        let mut lost = 0.0;
        let mut next = 0;
        while let Some(&simplex) = self.outside.get(next) {
            next += 1;
            let vertices = complex.vertices(simplex);
            let is_usual = view.delaunay.has_ball(simplex)
                && view.hierarchy.same_domain(vertices)
                && next <= MOST_OUTSIDE;
            if !is_usual {
                return Ok(None);
            }
            lost += f64::from(view.penalties[simplex]);
            for &beyond in complex.neighbors(simplex) {
                see(&mut self.seen, &mut self.outside, view, beyond, x)?;
            }
        }
        Ok(Some(lost))
    }

    /// Collects the cone over the boundary of what was found.
    fn find_cone(&mut self, view: View<'_>) -> AllocResult<()> {
        let mut cone = std::mem::take(&mut self.cone);
        cone.sides.clear();
        let mut pushed = Ok(());
        self.all_sides(view, |vertices, apex| {
            pushed = cone.push(vertices, apex);
            pushed.is_ok()
        });
        self.cone = cone;
        pushed
    }

    /// Returns true if `holds` is true of all sides of the cone over the boundary of the cavity
    /// that was found. Each side is given by the vertices of a simplex at it, and the number of the
    /// vertex that is not of the side.
    #[inline(always)]
    fn all_sides(&self, view: View<'_>, mut holds: impl FnMut(&[VertexId], usize) -> bool) -> bool {
        let Self { hole, is_inside, seen, .. } = self;
        for number in (0..hole.filling.len()).filter(|&number| is_inside[number]) {
            let vertices = hole.filling.vertices(number as u32);
            for (index, &beside) in hole.filling.beside(number as u32).iter().enumerate() {
                let goes_on = match beside {
                    Beside::Filling(other) => is_inside[other as usize],
                    Beside::Boundary(at) => seen.is(hole.boundary[at as usize].beyond, INSIDE),
                };
                if !goes_on && !holds(vertices, index) {
                    return false;
                }
            }
        }
        let complex = view.delaunay.complex();
        for &simplex in &self.outside {
            for (index, &beyond) in complex.neighbors(simplex).iter().enumerate() {
                if seen.is(beyond, OUTSIDE) && !holds(complex.vertices(simplex), index) {
                    return false;
                }
            }
        }
        hole.boundary.iter().zip(&self.fillings).all(|(facet, &number)| {
            !seen.is(facet.beyond, INSIDE)
                || is_inside[number as usize]
                || holds(complex.vertices(facet.beyond), facet.mirror as usize)
        })
    }

    /// Returns true if the simplices of the filling that would stay keep the bound of the Voronoi
    /// aspect, or another criterion is in force. `x` is the new place of the vertex, if it has one.
    fn keeps_filling_cells(&self, view: View<'_>, x: Option<&[f64; 3]>) -> bool {
        let Some(half_aspect) = view.measure.half_aspect else { return true };
        let is_good = |number: usize| {
            let radius = self.hole.balls[number].radius();
            let vertices = self.hole.filling.vertices(number as u32);
            vertices.iter().all(|&vertex| {
                let from_x = x.map_or(f64::INFINITY, |x| distance(x, view.delaunay.point(vertex)));
                view.hierarchy.cage_of(vertex).is_valid()
                    || radius <= half_aspect * view.cells[vertex].nearest.min(from_x)
            })
        };
        self.staying().all(|number| is_good(number as usize))
    }

    /// Returns true if the simplices of the filling that would stay are as small as the caller asks
    /// for.
    pub fn keeps_filling_sizes(&self, view: View<'_>) -> Result<bool> {
        let Some(sizes) = view.sizes else { return Ok(true) };
        for number in self.staying() {
            let vertices = self.hole.filling.vertices(number);
            let x = view.delaunay.point(vertices[0]);
            if !sizes.allow(view.delaunay, vertices, 0, x, self.max_edge(view))? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Returns the longest edge that simplices in the hole may have.
    fn max_edge(&self, view: View<'_>) -> f64 {
        view.max_edge_at(self.hole.star[0])
    }

    /// Returns the simplices of the filling whose balls do not hold the place that is judged.
    pub fn staying(&self) -> impl Iterator<Item = u32> {
        (0..self.hole.balls.len() as u32).filter(|&number| !self.is_inside[number as usize])
    }
}

/// Tests a simplex that the search comes to, unless it was tested before.
#[inline]
fn see(
    seen: &mut Seen,
    outside: &mut Vec<SimplexId>,
    view: View<'_>,
    simplex: SimplexId,
    x: &[f64; 3],
) -> AllocResult<()> {
    if seen.is_new(simplex) {
        let is_inside = view.delaunay.in_conflict(simplex, x);
        seen.mark(simplex, if is_inside { INSIDE } else { OUTSIDE });
        if is_inside {
            outside.try_push(simplex)?;
        }
    }
    Ok(())
}
