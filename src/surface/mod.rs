//! Surfaces through points: the facets between the simplices of a Delaunay triangulation that are
//! inside and those that are outside (§10: "efficient surface reconstruction"; T. K. Dey, "Curve
//! and Surface Reconstruction", 2007).
//!
//! The solid is a set of simplices, so its boundary is watertight, has no intersections, and its
//! vertices are points that were given.
//!
//! | | |
//! |---|---|
//! | `balls` | Delaunay balls, and how deeply they intersect |
//! | `poles` | the two far ends of each Voronoi cell |
//! | `forest`, `sides` | which simplices are inside |
//! | `pieces` | pieces that no points support |
//! | `pinches` | the boundary becomes a manifold |
//! | `shells` | its connected parts |

mod balls;
mod forest;
mod pieces;
mod pinches;
mod poles;
mod shells;
mod sides;
#[cfg(test)]
mod tests;

use crate::arrays::Part;
use crate::error::{Error, Result, message};
use crate::memory::{TryGrow, collected, copied, filled};
use crate::mesh::{NONE, Triangulation};
use balls::Balls;
pub use shells::Shell;
use shells::shells;

/// A closed surface through vertices of a Delaunay triangulation; in the plane closed curves. It is
/// a manifold, oriented, and has no intersections.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Simplex -> true if it is inside.
    pub is_inside: Vec<bool>,
    /// Vertices of its facets, `facets x dim`, oriented outwards.
    pub facets: Vec<u32>,
    /// The connected parts.
    pub shells: Vec<Shell>,
    /// Vertices of the triangulation that are not on the surface, ascending: outliers, and points
    /// that noise moved off it.
    pub left_out: Vec<u32>,
}

impl Surface {
    /// Finds the surface that goes through the vertices of a Delaunay triangulation in the plane or
    /// in space. No facets are left if the vertices tell of no inside, as those of a plane.
    /// O(simplices log simplices).
    ///
    /// # Errors
    /// `InvalidArgument` (another dimension), `Limit` (more than 2^30 simplices), `OutOfMemory`.
    pub fn through(mesh: &Triangulation) -> Result<Self> {
        let is_inside = match mesh.dim {
            2 => solid::<2>(mesh)?,
            3 => solid::<3>(mesh)?,
            dim => {
                let rule = "a surface goes through points in the plane or in space";
                return Err(Error::invalid(message!("the mesh has {dim} dimensions; {rule}")));
            }
        };
        Self::of_solid(mesh, is_inside)
    }

    /// Returns the surface of a solid, for each simplex whether it is inside. It is closed and
    /// oriented, and a manifold if it does not touch itself. O(simplices).
    pub(crate) fn of_solid(mesh: &Triangulation, is_inside: Vec<bool>) -> Result<Self> {
        let facets = Part::of_chosen(mesh, copied(&is_inside)?)?.hull()?.vertices;
        let shells = shells(mesh.dim, mesh.vertex_count(), &facets)?;
        let mut is_used = filled(mesh.vertex_count(), false)?;
        facets.iter().for_each(|&vertex| is_used[vertex as usize] = true);
        let others = (0..).zip(is_used).filter(|(_, is_used)| !is_used);
        let left_out = collected(others.map(|(vertex, _)| vertex))?;
        Ok(Self { is_inside, facets, shells, left_out })
    }

    /// Returns the coordinates of the vertices of the surface, `vertices x dim`, and its facets
    /// with numbers of these. O(vertices of the triangulation + facets).
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn apart(&self, mesh: &Triangulation) -> Result<(Vec<f64>, Vec<u32>)> {
        let mut numbers = filled(mesh.vertex_count(), 0u32)?;
        self.left_out.iter().for_each(|&vertex| numbers[vertex as usize] = NONE);
        let mut points = Vec::new();
        let on_surface = numbers.iter_mut().zip(mesh.points.chunks_exact(mesh.dim));
        for (next, (number, point)) in on_surface.filter(|(number, _)| **number != NONE).enumerate()
        {
            *number = next as u32;
            points.try_extend(point)?;
        }
        let facets = collected(self.facets.iter().map(|&vertex| numbers[vertex as usize]))?;
        Ok((points, facets))
    }

    /// Computes the volume inside (an area in the plane). O(simplices).
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn volume(&self, mesh: &Triangulation) -> Result<f64> {
        Ok(Part::of_chosen(mesh, copied(&self.is_inside)?)?.volumes()?.iter().sum())
    }
}

/// Returns for each simplex whether it is inside.
fn solid<const D: usize>(mesh: &Triangulation) -> Result<Vec<bool>> {
    let balls = Balls::<D>::new(mesh)?;
    let stars = Part::whole(mesh)?.vertex_simplices()?;
    let poles = poles::poles(&balls)?;
    let mut is_inside = sides::sides(&balls, &poles)?;
    pieces::settle(mesh, &stars, &poles, &mut is_inside)?;
    if pinches::unpinch(&balls, &stars, &mut is_inside)? {
        pieces::settle(mesh, &stars, &poles, &mut is_inside)?;
    }
    Ok(is_inside)
}
