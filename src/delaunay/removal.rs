//! Removal of a vertex, which may then be inserted elsewhere: the hole that its star leaves is
//! filled with the Delaunay simplices of the vertices round it.
//!
//! Every facet of the boundary has one such simplex on the side of the hole. Its apex is the vertex
//! whose sphere with the facet holds no other; that simplex has further facets, and so on until all
//! have met. Cospherical vertices have many Delaunay complexes, and the complex outside the hole
//! belongs to one of them: the [order](super::order) of the vertices tells which, so the filling
//! always fits.
//!
//! A vertex on the hull is not removed, nor is one at the interface of a partition.

#[cfg(test)]
mod tests;

use super::{Delaunay, MAX_SIMPLEX_VERTICES};
use crate::complex::{Beside, Facet, Filling, SimplexId, VertexId, VertexSet, position};
use crate::memory::{AllocResult, Array, TryGrow, reserve};
use crate::numerics::{Circumball, Sign, orientation};

/// Hole that the removal of a vertex would leave, with the simplices that fill it.
#[derive(Default)]
pub(crate) struct Hole<const D: usize> {
    /// All simplices at the vertex.
    pub star: Array<SimplexId>,
    /// Facets round the star: facet number i belongs to `star[i]`.
    pub boundary: Vec<Facet>,
    /// Vertices round the hole.
    pub vertices: VertexSet,
    /// Simplices that fill the hole.
    pub filling: Filling<D>,
    /// Simplex of the filling -> its circumball.
    pub balls: Vec<Circumball<D>>,
    /// Facets that have a simplex on one side only.
    open: Vec<Open<D>>,
}

/// Facet with a simplex on one side only, which is `beside` it, and the number of that simplex'
/// vertex opposite the facet.
#[derive(Clone, Copy)]
struct Open<const D: usize> {
    /// Ids of the facet's vertices, ascending.
    facet: [u32; D],
    beside: Beside,
    index: u32,
}

impl<const D: usize> Delaunay<D> {
    /// Finds the hole that the removal of `vertex` would leave, and the simplices that fill it.
    /// Returns false if the vertex is on the hull. O(s v) for s simplices of the filling and v
    /// vertices round it.
    pub fn find_hole(&mut self, vertex: VertexId, hole: &mut Hole<D>) -> AllocResult<bool> {
        self.find_small_hole(vertex, usize::MAX, hole)
    }

    /// Finds the hole as [`Self::find_hole`] does, and returns false as well if the vertex has more
    /// than `most` neighbours: before it looks for simplices.
    pub fn find_small_hole(
        &mut self,
        vertex: VertexId,
        most: usize,
        hole: &mut Hole<D>,
    ) -> AllocResult<bool> {
        self.complex.star(vertex, &mut hole.star)?;
        hole.boundary.clear();
        hole.filling.clear();
        hole.balls.clear();
        hole.open.clear();
        hole.vertices.restart(self.points.len())?;
        for at in 0..hole.star.len() {
            let simplex = hole.star[at];
            let vertices = self.complex.vertices(simplex);
            let index = position(vertices, vertex);
            let beyond = self.complex.neighbors(simplex)[index];
            if vertices.contains(&VertexId::INFINITE) || beyond == simplex {
                return Ok(false);
            }
            let mirror = position(self.complex.neighbors(beyond), simplex) as u32;
            hole.boundary.try_push(Facet { simplex, index: index as u32, beyond, mirror })?;
            let facet = facet_of::<D>(vertices, index);
            let beside = Beside::Boundary(at as u32);
            hole.open.try_push(Open { facet, beside, index: index as u32 })?;
            for &other in vertices.iter().filter(|&&other| other != vertex) {
                hole.vertices.insert(other)?;
            }
        }
        if hole.vertices.ids.len() > most {
            return Ok(false);
        }
        // Every simplex is one of the finitely many that the vertices round the hole have, and none
        // comes twice.
        while let Some(open) = hole.open.pop() {
            if !self.fill_at(&open, hole)? {
                debug_assert!(false, "the filling has a simplex at every facet");
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Adds the simplex on the open side of a facet to the filling; returns false if there is none.
    fn fill_at(&self, open: &Open<D>, hole: &mut Hole<D>) -> AllocResult<bool> {
        let mut vertices = [VertexId::NONE; MAX_SIMPLEX_VERTICES];
        let vertices = &mut vertices[..=D];
        let slot = open.index as usize;
        match open.beside {
            // On the same side of the facet as the vertex that goes.
            Beside::Boundary(at) => {
                vertices.copy_from_slice(self.complex.vertices(hole.star[at as usize]));
            }
            // On the other side, so the vertices turn the other way.
            Beside::Filling(number) => {
                vertices.copy_from_slice(hole.filling.vertices(number));
                vertices.swap((slot + 1) % (D + 1), (slot + 2) % (D + 1));
            }
        }
        let Some(ball) = self.find_apex(vertices, slot, &hole.vertices.ids) else {
            return Ok(false);
        };
        let number = hole.filling.push(vertices)?;
        hole.balls.try_push(ball)?;
        hole.filling.join(number, open.index, open.beside);
        if let Beside::Filling(other) = open.beside {
            // The vertices of the facet have changed places, that opposite it has not.
            hole.filling.join(other, open.index, Beside::Filling(number));
        }
        for index in (0..=D).filter(|&index| index != slot) {
            let (facet, index) = (facet_of::<D>(vertices, index), index as u32);
            match hole.open.iter().rposition(|other| other.facet == facet) {
                Some(at) => {
                    let other = hole.open.swap_remove(at);
                    hole.filling.join(number, index, other.beside);
                    if let Beside::Filling(neighbor) = other.beside {
                        hole.filling.join(neighbor, other.index, Beside::Filling(number));
                    }
                }
                None => {
                    hole.open.try_push(Open { facet, beside: Beside::Filling(number), index })?;
                }
            }
        }
        Ok(true)
    }

    /// Puts at `slot` the vertex of `around` that makes a Delaunay simplex with the others, on
    /// their positive side, and returns its ball. A vertex inside the sphere of one such simplex is
    /// on that side too: the simplex on the other side is Delaunay.
    fn find_apex(
        &self,
        vertices: &mut [VertexId],
        slot: usize,
        around: &[VertexId],
    ) -> Option<Circumball<D>> {
        let mut points = self.vertex_points(vertices);
        let mut ball: Option<Circumball<D>> = None;
        for &candidate in around {
            let q = self.point(candidate);
            let is_better = match &ball {
                // A vertex of the simplex is on the sphere, so doubles cannot tell its side.
                Some(ball) => ball.side(points[ball.anchor], q).unwrap_or_else(|| {
                    !vertices.contains(&candidate) && self.is_inside_with_care(vertices, candidate)
                }),
                None => {
                    let is_known = |(at, &v): (usize, &VertexId)| at != slot && v == candidate;
                    points[slot] = q;
                    !vertices.iter().enumerate().any(is_known)
                        && orientation(&points[..=D]) == Sign::Positive
                }
            };
            if is_better {
                vertices[slot] = candidate;
                points[slot] = q;
                ball = Some(Circumball::of(|i| points[i]));
            }
        }
        ball
    }

    /// Removes `vertex`, for which `hole` was found in the present complex. `created[i]` becomes
    /// simplex number i of the filling. The vertex keeps its id and may be inserted again. After an
    /// error the complex is unchanged.
    pub fn remove(
        &mut self,
        vertex: VertexId,
        hole: &Hole<D>,
        created: &mut Vec<SimplexId>,
    ) -> AllocResult<()> {
        let count = hole.filling.len();
        created.clear();
        reserve(created, count)?;
        self.complex.reserve(count, hole.star.len())?;
        self.balls.reserve(count)?;
        self.complex.fill(vertex, &hole.star, &hole.boundary, &hole.filling, created);
        self.cover_balls()?;
        self.simplices_created += count as u64;
        for pair in created.chunks(2) {
            self.compute_balls([pair[0], pair[pair.len() - 1]]);
        }
        Ok(())
    }
}

/// Returns the ids of a simplex' vertices except number `index`, ascending.
fn facet_of<const D: usize>(vertices: &[VertexId], index: usize) -> [u32; D] {
    let mut facet: [u32; D] =
        std::array::from_fn(|i| vertices[i + usize::from(i >= index)].number());
    facet.sort_unstable();
    facet
}
