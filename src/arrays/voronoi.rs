//! The Voronoi diagram of the vertices: the dual of the mesh.

use super::circumcenters::accurate_center;
use super::{Lists, Part};
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow, collected, filled, with_capacity};
use crate::mesh::{NONE, in_dimension};
use crate::query::dual::Chains;
use crate::query::unit::{Unit, largest, scaled};
use crate::query::view::View;

/// Voronoi diagram of the vertices: cells, and the ridges between them. Each simplex is a corner of
/// it, at the simplex's circumcentre ([`Part::circumcenters`]); corners of cospherical simplices
/// are one point.
#[derive(Clone, Debug, PartialEq)]
pub struct Voronoi {
    /// Corners of each cell: see [`Part::regions`].
    pub regions: Lists,
    /// Vertex -> true if its cell is bounded, as in [`Cells`].
    pub is_bounded: Vec<bool>,
    /// Volume of each cell, as in [`Cells`].
    pub volumes: Vec<f64>,
    /// Share of each cell in the volume of the mesh, as in [`Cells`].
    pub shares: Vec<f64>,
    /// Vertices of the edge of each ridge, as in [`Ridges`].
    pub ridges: Vec<u32>,
    /// Corners of each ridge, as in [`Ridges`].
    pub ridge_corners: Lists,
    /// Ridge -> true if it is bounded, as in [`Ridges`].
    pub is_ridge_bounded: Vec<bool>,
}

/// Voronoi cells of the vertices.
#[derive(Clone, Debug, PartialEq)]
pub struct Cells {
    /// Vertex -> true if its cell is bounded: the vertex has simplices, and is not on the hull.
    pub is_bounded: Vec<bool>,
    /// Volume of each cell, infinite if the cell is unbounded.
    pub volumes: Vec<f64>,
    /// Share of each cell in the volume of the mesh. The share of a bounded cell is its volume. The
    /// share of an unbounded cell is the sum of the signed shares of the simplices at the vertex,
    /// which may be negative next to obtuse simplices. The sum of all shares is the volume of the
    /// mesh.
    pub shares: Vec<f64>,
}

/// Facets of Voronoi cells, each between the cells of the two ends of an edge; in the order of
/// [`Part::edges`].
#[derive(Clone, Debug, PartialEq)]
pub struct Ridges {
    /// Vertices of the edge of each ridge, `ridges x 2`.
    pub vertices: Vec<u32>,
    /// Simplices at the corners of each ridge: in 3D in their order round the ridge, from one end
    /// to the other where it is unbounded; in other dimensions ascending.
    pub corners: Lists,
    /// Ridge -> true if it is bounded: its edge is not on the hull.
    pub is_bounded: Vec<bool>,
}

impl Part<'_> {
    /// Returns the Voronoi diagram: regions, cells and ridges, as [`Part::regions`],
    /// [`Part::cells`] and [`Part::ridges`] return them.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn voronoi(&self) -> Result<Voronoi> {
        let boundary = self.boundary()?;
        let stars = self.vertex_simplices()?;
        let Ridges { vertices: ridges, corners: ridge_corners, is_bounded: is_ridge_bounded } =
            self.ridges_of(&stars, &boundary)?;
        let regions = self.regions_of(stars)?;
        let Cells { is_bounded, volumes, shares } = self.cells_of(boundary)?;
        Ok(Voronoi {
            regions,
            is_bounded,
            volumes,
            shares,
            ridges,
            ridge_corners,
            is_ridge_bounded,
        })
    }

    /// Returns for each vertex the simplices at the corners of its Voronoi cell: counterclockwise
    /// in 2D, from one end to the other where the cell is unbounded; in other dimensions ascending.
    /// O(simplices).
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn regions(&self) -> Result<Lists> {
        Ok(self.regions_of(self.vertex_simplices()?)?)
    }

    /// Returns which cells are bounded, and their volumes. In a part that is not all of the mesh, a
    /// cell is bounded if all simplices at its vertex are in the part.
    ///
    /// Volumes are computed in doubles from circumcentres, in a unit of each cell: no step
    /// overflows or underflows where the cell's volume does not. Shares of unbounded cells are sums
    /// that may cancel: next to needles 2^60 times as long as wide no digit is left. O(2^dim dim)
    /// for each simplex and vertex of it.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn cells(&self) -> Result<Cells> {
        Ok(self.cells_of(self.boundary()?)?)
    }

    /// Returns the facets of the Voronoi cells. O(simplices at a vertex) for each edge.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn ridges(&self) -> Result<Ridges> {
        Ok(self.ridges_of(&self.vertex_simplices()?, &self.boundary()?)?)
    }

    fn boundary(&self) -> AllocResult<Boundary> {
        let mut is_cell_bounded = filled(self.mesh.vertex_count(), false)?;
        let mut opposite = filled(self.mesh.simplex_count(), 0u16)?;
        for simplex in self.simplices() {
            for (i, &vertex) in self.mesh.simplex(simplex as usize).iter().enumerate() {
                is_cell_bounded[vertex as usize] = true;
                opposite[simplex as usize] |= u16::from(self.neighbor(simplex, i) == NONE) << i;
            }
        }
        for simplex in self.simplices() {
            for (i, &vertex) in self.mesh.simplex(simplex as usize).iter().enumerate() {
                // A facet on the hull that has the vertex: another one is opposite of it.
                if opposite[simplex as usize] & !(1 << i) != 0 {
                    is_cell_bounded[vertex as usize] = false;
                }
            }
        }
        Ok(Boundary { is_cell_bounded, opposite })
    }

    fn regions_of(&self, stars: Lists) -> AllocResult<Lists> {
        if self.mesh.dim == 2 { self.in_order(&stars) } else { Ok(stars) }
    }

    fn cells_of(&self, boundary: Boundary) -> AllocResult<Cells> {
        let shares = in_dimension!(self.mesh.dim, D => shares::<D>(self), _ => Ok(Vec::new()))?;
        let is_bounded = boundary.is_cell_bounded;
        let mut volumes = with_capacity(shares.len())?;
        let of_cell = |(&share, &bounded)| if bounded { share } else { f64::INFINITY };
        volumes.extend(shares.iter().zip(&is_bounded).map(of_cell));
        Ok(Cells { is_bounded, volumes, shares })
    }

    fn ridges_of(&self, stars: &Lists, boundary: &Boundary) -> AllocResult<Ridges> {
        let (mut vertices, mut is_bounded) = (Vec::new(), Vec::new());
        let mut corners = Lists::with_capacity(0)?;
        let (mut pairs, mut round, mut fans) = (Vec::new(), Vec::new(), Fans::default());
        for vertex in 0..stars.count() as u32 {
            self.edges_up(vertex, stars.of(vertex as usize), &mut pairs)?;
            for ridge in pairs.chunk_by(|a, b| a.0 == b.0) {
                let ends = [vertex, ridge[0].0];
                round.clear();
                ridge.iter().try_for_each(|&(_, simplex)| round.try_push(simplex))?;
                match self.mesh.dim {
                    3 => fans.go_round(self, &ends, &round, &mut corners.ids)?,
                    _ => corners.ids.try_extend(&round)?,
                }
                corners.end_list()?;
                vertices.try_extend(&ends)?;
                let on_hull = |&simplex| boundary.has_on_hull(self, simplex, &ends);
                is_bounded.try_push(!round.iter().any(on_hull))?;
            }
        }
        Ok(Ridges { vertices, corners, is_bounded })
    }

    /// Fills `pairs` with the edges from a vertex to later ones, each once for every simplex that
    /// has it: the other end and the simplex, in ascending order.
    fn edges_up(&self, vertex: u32, star: &[u32], pairs: &mut Vec<(u32, u32)>) -> AllocResult<()> {
        pairs.clear();
        for &simplex in star {
            let vertices = self.mesh.simplex(simplex as usize).iter();
            for &other in vertices.filter(|&&other| other > vertex) {
                pairs.try_push((other, simplex))?;
            }
        }
        pairs.sort_unstable();
        Ok(())
    }

    /// Returns the triangles round each vertex in counterclockwise order.
    fn in_order(&self, regions: &Lists) -> AllocResult<Lists> {
        let mut ordered = Lists::with_capacity(regions.count())?;
        let mut fans = Fans::default();
        for (vertex, star) in regions.iter().enumerate() {
            fans.go_round(self, &[vertex as u32], star, &mut ordered.ids)?;
            ordered.end_list()?;
        }
        Ok(ordered)
    }
}

/// Hull of a part: the cells and the simplices at it.
struct Boundary {
    /// Vertex -> true if its cell is bounded.
    is_cell_bounded: Vec<bool>,
    /// Simplex -> the positions of its vertices opposite facets of the hull, as bits.
    opposite: Vec<u16>,
}

impl Boundary {
    /// Returns true if a simplex has a facet on the hull that has both ends of an edge.
    fn has_on_hull(&self, part: &Part<'_>, simplex: u32, ends: &[u32; 2]) -> bool {
        let opposite = self.opposite[simplex as usize];
        let vertices = part.mesh.simplex(simplex as usize).iter().enumerate();
        let mut others = vertices.filter(|(_, vertex)| !ends.contains(vertex));
        opposite != 0 && others.any(|(i, _)| opposite >> i & 1 == 1)
    }
}

/// Workspace that brings the simplices round a face of codimension two into order. In a part of a
/// mesh they may form several fans.
#[derive(Default)]
struct Fans {
    /// Position in the star -> true if that simplex is in order already.
    is_done: Vec<bool>,
}

/// Step round a face: a simplex, and its vertex opposite the facet that is crossed next.
type Step = (u32, u32);

impl Fans {
    /// Appends the simplices of `star`, which are ascending, in the order round the face, from one
    /// end of a fan to the other where it has ends.
    fn go_round(
        &mut self,
        part: &Part<'_>,
        face: &[u32],
        star: &[u32],
        ordered: &mut Vec<u32>,
    ) -> AllocResult<()> {
        self.is_done.clear();
        self.is_done.cover(star.len(), false)?;
        for first in 0..star.len() {
            if self.is_done[first] {
                continue;
            }
            // Back to the end of the fan, or once round the face.
            let mut step = (star[first], part.others(star[first], face)[1]);
            for _ in first..star.len() {
                match part.across(step, face) {
                    (NONE, _) => break,
                    before => step = before,
                }
            }
            step.1 = part.other(step, face);
            while let Ok(at) = star.binary_search(&step.0) {
                if std::mem::replace(&mut self.is_done[at], true) {
                    break;
                }
                ordered.try_push(step.0)?;
                step = part.across(step, face);
            }
        }
        Ok(())
    }
}

impl Part<'_> {
    /// Returns the two vertices of a simplex that are not on a face of codimension two; in 2D in
    /// counterclockwise order after the face.
    fn others(&self, simplex: u32, face: &[u32]) -> [u32; 2] {
        let vertices = self.mesh.simplex(simplex as usize);
        let mut others = vertices.iter().copied().filter(|vertex| !face.contains(vertex));
        let (a, b) = (others.next().unwrap_or(NONE), others.next().unwrap_or(NONE));
        // The other vertices of a triangle follow its second one in the other order.
        if vertices.len() == 3 && face.contains(&vertices[1]) { [b, a] } else { [a, b] }
    }

    fn other(&self, (simplex, left): Step, face: &[u32]) -> u32 {
        let [a, b] = self.others(simplex, face);
        if a == left { b } else { a }
    }

    /// Returns the next step round the face; its simplex is [`NONE`] at the hull.
    fn across(&self, step: Step, face: &[u32]) -> Step {
        let (simplex, left) = step;
        let at = self.mesh.simplex(simplex as usize).iter().position(|&vertex| vertex == left);
        (self.neighbor(simplex, at.unwrap_or(0)), self.other(step, face))
    }
}

/// Returns for each vertex the sum of the shares that the simplices at it have in its cell.
fn shares<const D: usize>(part: &Part<'_>) -> AllocResult<Vec<f64>> {
    let view = View::<D> { mesh: part.mesh };
    let units = units::<D>(part)?;
    let mut chains = Chains::default();
    let mut shares = filled(units.len(), 0.0)?;
    for simplex in part.simplices() {
        let vertices = view.simplex(simplex);
        let points = view.points_of(vertices);
        let center = accurate_center(&points[..=D]);
        for (base, &vertex) in vertices.iter().enumerate() {
            chains.of(&points[..=D], base, &center, units[vertex as usize]);
            shares[vertex as usize] += chains.of_cell();
        }
    }
    let factorial = f64::from((1..=D as u32).product::<u32>());
    for (share, unit) in shares.iter_mut().zip(&units) {
        *share = scaled(*share / factorial, D as i32 * unit.exponent());
    }
    Ok(shares)
}

/// Returns for each vertex a unit in which the farthest vertex of its star is at a distance of
/// about 1.
fn units<const D: usize>(part: &Part<'_>) -> AllocResult<Vec<Unit>> {
    let view = View::<D> { mesh: part.mesh };
    let mut sizes = filled(part.mesh.vertex_count(), 0.0f64)?;
    for vertices in part.simplices().map(|simplex| view.simplex(simplex)) {
        let size = vertices.iter().map(|&v| largest(view.point(v))).fold(0.0, f64::max);
        vertices.iter().for_each(|&v| sizes[v as usize] = sizes[v as usize].max(size));
    }
    let mut units = collected(sizes.iter().map(|&size| Unit::of_points(size)))?;
    sizes.fill(0.0);
    for vertices in part.simplices().map(|simplex| view.simplex(simplex)) {
        for &center in vertices {
            let (own, unit) = (&mut sizes[center as usize], units[center as usize]);
            for &v in vertices {
                *own = own.max(largest(&unit.difference(view.point(v), view.point(center))));
            }
        }
    }
    units.iter_mut().zip(&sizes).for_each(|(unit, &size)| *unit = unit.scaled_to(size));
    Ok(units)
}
