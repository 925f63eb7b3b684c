//! Surfaces through points (§10: "efficient surface reconstruction"; T. K. Dey, "Curve and Surface
//! Reconstruction", 2007): facets of a Delaunay triangulation, so they have no intersections, and
//! their vertices are points that were given.
//!
//! A closed surface is the boundary of a set of simplices, hence watertight. An open one is of the
//! facets about which their vertices agree.
//!
//! | | |
//! |---|---|
//! | `local` | the triangulation, in an order of locality |
//! | `balls` | Delaunay balls, and how deeply they intersect |
//! | `places` | where a simplex is in the star of a vertex |
//! | `poles` | the two far ends of each Voronoi cell |
//! | `umbrellas` | the facets of each vertex between its sides |
//! | `forest`, `sides` | which simplices are inside |
//! | `pieces` | interfaces that no points support |
//! | `pinches` | the boundary becomes a manifold |
//! | `shells` | its connected parts |
//! | `open`, `chosen`, `orient` | open surfaces: which facets, and their shells |
//! | `sampling` | where points are too sparse |

mod balls;
mod chosen;
mod forest;
mod local;
mod open;
#[cfg(test)]
mod open_tests;
mod orient;
mod pieces;
mod pinches;
mod places;
mod poles;
mod sampling;
mod shells;
mod sides;
#[cfg(test)]
mod tests;
mod umbrellas;

use crate::arrays::Part;
use crate::error::{Error, Result, message};
use crate::memory::{AllocResult, TryGrow, collected, copied, filled};
use crate::mesh::{Inputs, NONE, Triangulation};
use crate::query::unit::Unit;
use crate::query::view::View;
use crate::validate::{Promises, Report, validate_surface};
use balls::Balls;
use local::Local;
pub use shells::Shell;
use shells::shells;
use umbrellas::Umbrellas;

/// Surfaces that points may be on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SurfaceKind {
    /// Closed surfaces, the boundary of what is inside.
    #[default]
    Closed,
    /// Surfaces that may end, or have one side alone.
    Open,
}

/// A surface through vertices of a Delaunay triangulation; in the plane curves. It is a manifold,
/// an open one with a boundary, and has no intersections.
#[derive(Clone, Debug, Default)]
pub struct Surface {
    pub kind: SurfaceKind,
    /// Simplex -> true if it is inside; all false for an open surface.
    pub is_inside: Vec<bool>,
    /// Vertices of its facets, `facets x dim`. Those of a closed shell are oriented outwards.
    pub facets: Vec<u32>,
    /// The connected parts.
    pub shells: Vec<Shell>,
    /// Vertices of the triangulation that are not on the surface, ascending: outliers, and points
    /// that noise moved off it.
    pub left_out: Vec<u32>,
    /// Vertex -> the largest circumradius of its facets over the distance to the nearest pole of
    /// their vertices, which stands for the local feature size; NaN for one that is left out.
    pub sampling: Vec<f64>,
}

impl Surface {
    /// Finds the surface that goes through the vertices of a Delaunay triangulation in the plane or
    /// in space. A closed one has no facets if the vertices tell of no inside, as those of a plane.
    /// O(simplices log simplices).
    ///
    /// # Errors
    /// `InvalidArgument` (another dimension), `Limit` (more than 2^30 simplices), `OutOfMemory`.
    pub fn through(mesh: &Triangulation, kind: SurfaceKind) -> Result<Self> {
        match mesh.dim {
            2 => through::<2>(mesh, kind),
            3 => through::<3>(mesh, kind),
            dim => {
                let rule = "a surface goes through points in the plane or in space";
                Err(Error::invalid(message!("the mesh has {dim} dimensions; {rule}")))
            }
        }
    }

    /// Returns the surface of a solid, for each simplex whether it is inside. It is closed and
    /// oriented, and a manifold if it does not touch itself. Its sampling is not filled in.
    /// O(simplices).
    pub(crate) fn of_solid(mesh: &Triangulation, is_inside: Vec<bool>) -> Result<Self> {
        let facets = Part::of_chosen(mesh, copied(&is_inside)?)?.hull()?.vertices;
        let shells = shells(mesh.dim, mesh.vertex_count(), &facets)?;
        let left_out = left_out(mesh, &facets)?;
        Ok(Self { is_inside, facets, shells, left_out, ..Self::default() })
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

    /// Computes the volume inside (an area in the plane); 0 for an open surface. O(simplices).
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn volume(&self, mesh: &Triangulation) -> Result<f64> {
        Ok(Part::of_chosen(mesh, copied(&self.is_inside)?)?.volumes()?.iter().sum())
    }

    /// Checks the triangulation and that this surface of it is what it is said to be: see
    /// [`validate_surface`].
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn validate(&self, inputs: &Inputs, mesh: &Triangulation) -> Result<Report> {
        let promises = Promises {
            is_closed: self.kind == SurfaceKind::Closed,
            is_oriented: self.shells.iter().all(|shell| !shell.is_one_sided),
        };
        validate_surface(inputs, mesh, &self.facets, &self.left_out, promises)
    }

    /// Returns the number of vertices whose facets are larger than the local feature size: the
    /// surface there is a guess.
    pub fn sparse(&self) -> usize {
        self.sampling.iter().filter(|&&ratio| ratio > 1.0).count()
    }
}

fn through<const D: usize>(mesh: &Triangulation, kind: SurfaceKind) -> Result<Surface> {
    let local = Local::new::<D>(mesh)?;
    let balls = Balls::<D>::new(&local.mesh)?;
    let stars = Part::whole(&local.mesh)?.vertex_simplices()?;
    let poles = poles::poles(&balls)?;
    let depths = balls.depths()?;
    let umbrellas = Umbrellas::new(balls.view, &depths, &stars, &poles)?;
    let agreements = umbrellas.agreements()?;
    let mut surface = match kind {
        SurfaceKind::Open => {
            let mut facets = open::facets(&balls, &depths, &umbrellas, &agreements)?;
            rename(&mut facets, &local.vertices);
            opened(View::<D> { mesh }, balls.unit, facets)?
        }
        SurfaceKind::Closed => {
            drop(umbrellas);
            let mut is_inside = sides::sides::<D>(&local.mesh, &depths, &poles, &agreements)?;
            pieces::settle(&local.mesh, &stars, &poles, &agreements, &mut is_inside)?;
            if pinches::unpinch(&balls, &stars, &mut is_inside)? {
                pieces::settle(&local.mesh, &stars, &poles, &agreements, &mut is_inside)?;
            }
            Surface::of_solid(mesh, local.of_simplices(&is_inside, false)?)?
        }
    };
    let mut facets = copied(&surface.facets)?;
    rename(&mut facets, &local.numbers);
    let sampling = sampling::ratios(&balls, &poles, &facets)?;
    surface.sampling = local.of_vertices(&sampling, f64::NAN)?;
    Ok(surface)
}

/// Gives vertices the numbers that they have elsewhere.
fn rename(vertices: &mut [u32], numbers: &[u32]) {
    vertices.iter_mut().for_each(|vertex| *vertex = numbers[*vertex as usize]);
}

/// Returns the open surface of facets that are not oriented yet.
fn opened<const D: usize>(
    view: View<'_, D>,
    unit: Unit,
    mut facets: Vec<u32>,
) -> AllocResult<Surface> {
    let shells = orient::oriented_shells(view, unit, &mut facets)?;
    Ok(Surface {
        kind: SurfaceKind::Open,
        is_inside: filled(view.mesh.simplex_count(), false)?,
        left_out: left_out(view.mesh, &facets)?,
        facets,
        shells,
        sampling: Vec::new(),
    })
}

/// Returns the vertices that no facet has, ascending.
fn left_out(mesh: &Triangulation, facets: &[u32]) -> AllocResult<Vec<u32>> {
    let mut is_used = filled(mesh.vertex_count(), false)?;
    facets.iter().for_each(|&vertex| is_used[vertex as usize] = true);
    let others = (0..).zip(is_used).filter(|(_, is_used)| !is_used);
    collected(others.map(|(vertex, _)| vertex))
}
