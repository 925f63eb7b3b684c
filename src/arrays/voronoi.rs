//! The Voronoi diagram of the vertices: the dual of the mesh.

use super::circumcenters::accurate_center;
use super::{Lists, Part};
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow, collected, filled, with_capacity};
use crate::mesh::{NONE, Triangulation, in_dimension};
use crate::query::dual::Chains;
use crate::query::unit::{Unit, largest, scaled};
use crate::query::view::View;

/// Voronoi cells: regions, and the ridges between them. The corner that belongs to a simplex is its
/// circumcentre ([`Part::circumcenters`]); corners of cospherical simplices are one point.
#[derive(Clone, Debug, PartialEq)]
pub struct Voronoi {
    /// As [`Part::regions`].
    pub regions: Lists,
    /// As those of [`Cells`].
    pub is_bounded: Vec<bool>,
    pub volumes: Vec<f64>,
    pub shares: Vec<f64>,
    /// As the vertices, the corners and what is bounded in [`Ridges`].
    pub ridges: Vec<u32>,
    pub ridge_corners: Lists,
    pub is_ridge_bounded: Vec<bool>,
}

/// What the cell of each vertex is like.
#[derive(Clone, Debug, PartialEq)]
pub struct Cells {
    /// Whether the cell is bounded: the vertex has simplices, and is not on the hull.
    pub is_bounded: Vec<bool>,
    /// The volume of the cell, infinite if that is unbounded.
    pub volumes: Vec<f64>,
    /// What the cell adds to the volume of the mesh: that of the cell if it is bounded; else what
    /// the simplices at the vertex have of it, which may be negative next to obtuse simplices. All
    /// together are the volume of the mesh.
    pub shares: Vec<f64>,
}

/// The facets of cells, each between the cells of the two ends of an edge; in the order of
/// [`Part::edges`].
#[derive(Clone, Debug, PartialEq)]
pub struct Ridges {
    /// `ridges x 2` vertices: the edges.
    pub vertices: Vec<u32>,
    /// For each ridge the simplices whose corners it has: in 3D in their order round the ridge,
    /// from one end to the other where it is unbounded; else ascending.
    pub corners: Lists,
    /// For each ridge whether it is bounded: its edge is not on the hull.
    pub is_bounded: Vec<bool>,
}

impl Part<'_> {
    /// The Voronoi diagram: what the three functions below answer.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn voronoi(&self) -> Result<Voronoi> {
        let Cells { is_bounded, volumes, shares } = self.cells()?;
        let Ridges { vertices: ridges, corners, is_bounded: is_ridge_bounded } = self.ridges()?;
        let regions = self.regions()?;
        let ridge_corners = corners;
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

    /// For each vertex the simplices whose corners its Voronoi cell has: counterclockwise in 2D,
    /// from one end to the other where the cell is unbounded; else ascending. O(simplices).
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn regions(&self) -> Result<Lists> {
        let stars = self.vertex_simplices()?;
        Ok(if self.mesh.dim == 2 { self.in_order(&stars)? } else { stars })
    }

    /// Which cells are bounded, and their volumes. Of a part that is not all of the mesh, a cell is
    /// bounded if all simplices at its vertex are in the part.
    ///
    /// Volumes are computed in doubles from circumcentres, in a unit of each cell: no step
    /// overflows or underflows where the cell's volume does not. Shares of unbounded cells are sums
    /// that may cancel: next to needles 2^60 times as long as wide no digit is left. O(2^dim dim)
    /// for each simplex and vertex of it.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn cells(&self) -> Result<Cells> {
        let stars = self.vertex_simplices()?;
        let (is_bounded, _) = self.bounded_cells()?;
        let shares =
            in_dimension!(self.mesh.dim, D => shares::<D>(self, &stars), _ => Ok(Vec::new()))?;
        let mut volumes = with_capacity(shares.len())?;
        let of_cell = |(&share, &bounded)| if bounded { share } else { f64::INFINITY };
        volumes.extend(shares.iter().zip(&is_bounded).map(of_cell));
        Ok(Cells { is_bounded, volumes, shares })
    }

    /// The facets of the Voronoi cells. O(edges x simplices at a vertex).
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn ridges(&self) -> Result<Ridges> {
        let (_, hull) = self.bounded_cells()?;
        let vertices = self.edges()?;
        let (corners, is_bounded) =
            self.ridge_corners(&self.vertex_simplices()?, &vertices, &hull)?;
        Ok(Ridges { vertices, corners, is_bounded })
    }

    /// Vertex -> whether its cell is bounded; simplex -> the places of its vertices opposite the
    /// hull, as bits.
    fn bounded_cells(&self) -> AllocResult<(Vec<bool>, Vec<u16>)> {
        let mut is_bounded = filled(self.mesh.vertex_count(), false)?;
        let mut hull = filled(self.mesh.simplex_count(), 0u16)?;
        for simplex in self.simplices() {
            for (i, &vertex) in self.mesh.simplex(simplex as usize).iter().enumerate() {
                is_bounded[vertex as usize] = true;
                hull[simplex as usize] |= u16::from(self.neighbor(simplex, i) == NONE) << i;
            }
        }
        for simplex in self.simplices() {
            let opposite = hull[simplex as usize];
            for (i, &vertex) in self.mesh.simplex(simplex as usize).iter().enumerate() {
                // A facet on the hull that has the vertex: another one is opposite of it.
                if opposite & !(1 << i) != 0 {
                    is_bounded[vertex as usize] = false;
                }
            }
        }
        Ok((is_bounded, hull))
    }

    fn ridge_corners(
        &self,
        stars: &Lists,
        ridges: &[u32],
        hull: &[u16],
    ) -> AllocResult<(Lists, Vec<bool>)> {
        let count = ridges.len() / 2;
        let mut corners = Lists::with_capacity(count)?;
        let mut is_bounded = with_capacity(count)?;
        let (mut round, mut fans) = (Vec::new(), Fans::default());
        for ends in ridges.chunks_exact(2) {
            round.clear();
            let others = stars.of(ends[1] as usize);
            for &simplex in stars.of(ends[0] as usize) {
                if others.binary_search(&simplex).is_ok() {
                    round.try_push(simplex)?;
                }
            }
            is_bounded.push(!round.iter().any(|&simplex| {
                let vertices = self.mesh.simplex(simplex as usize).iter().enumerate();
                let off: u16 =
                    vertices.filter(|(_, v)| ends.contains(v)).map(|(i, _)| 1 << i).sum();
                hull[simplex as usize] & !off != 0
            }));
            match self.mesh.dim {
                3 => fans.go_round(self, ends, &round, &mut corners.ids)?,
                _ => corners.ids.try_extend(&round)?,
            }
            corners.end_list()?;
        }
        Ok((corners, is_bounded))
    }

    /// The triangles round each vertex in counterclockwise order.
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

/// The simplices round a face of codimension two, in order. In a part of a mesh they may be several
/// fans.
#[derive(Default)]
struct Fans {
    /// Which of the simplices are in order already.
    is_done: Vec<bool>,
}

/// A simplex, and the vertex that is left when going on across the facet opposite of it.
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
    /// The two vertices of a simplex that a face of codimension two does not have. Counterclockwise
    /// after the face in 2D.
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

    /// The next simplex round the face; [`NONE`] at the hull.
    fn across(&self, step: Step, face: &[u32]) -> Step {
        let (simplex, left) = step;
        let at = self.mesh.simplex(simplex as usize).iter().position(|&vertex| vertex == left);
        (self.neighbor(simplex, at.unwrap_or(0)), self.other(step, face))
    }
}

/// What the simplices at each vertex have of its cell.
fn shares<const D: usize>(part: &Part<'_>, stars: &Lists) -> AllocResult<Vec<f64>> {
    let view = View::<D> { mesh: part.mesh };
    let center = |simplex| accurate_center(&view.points_of(view.simplex(simplex))[..=D]);
    let centers = collected((0..part.mesh.simplex_count() as u32).map(center))?;
    let factorial = f64::from((1..=D as u32).product::<u32>());
    let mut chains = Chains::default();
    let mut shares = with_capacity(stars.count())?;
    for (vertex, star) in stars.iter().enumerate() {
        let unit = unit_of_star::<D>(part.mesh, vertex as u32, star);
        let mut sum = 0.0;
        for &simplex in star {
            let vertices = view.simplex(simplex);
            let base = vertices.iter().position(|&other| other == vertex as u32).unwrap_or(0);
            let points = view.points_of(vertices);
            chains.of(&points[..=D], base, &centers[simplex as usize], unit);
            sum += chains.of_cell();
        }
        shares.push(scaled(sum / factorial, D as i32 * unit.exponent()));
    }
    Ok(shares)
}

/// A unit in which the farthest vertex of the star is about 1 from its centre.
fn unit_of_star<const D: usize>(mesh: &Triangulation, center: u32, star: &[u32]) -> Unit {
    let view = View::<D> { mesh };
    let points = || star.iter().flat_map(|&simplex| view.simplex(simplex)).map(|&v| view.point(v));
    let unit = Unit::of_points(points().map(largest).fold(0.0, f64::max));
    let lengths = points().map(|p| largest(&unit.difference(p, view.point(center))));
    unit.scaled_to(lengths.fold(0.0, f64::max))
}
