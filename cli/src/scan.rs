//! The surface through the points in place of the mesh, and the part inside it.

use crate::alpha_shape::format;
use crate::exit_code::{ExitCode, Failure};
use netmesh::io::write_surface_file;
use netmesh::surface::{Surface, SurfaceKind};
use netmesh::{Algorithm, Mesh, Options, Triangulation};
use std::path::Path;

/// The surface, and how many points there were, for the summary and the record.
pub struct Found {
    pub surface: Surface,
    /// Number of distinct points.
    pub points: usize,
    /// Volume of what is inside; an area in the plane. 0 for an open surface.
    pub volume: f64,
}

/// Refuses points that no surface goes through.
pub fn require_dimension(mesh: &Mesh) -> Result<(), Failure> {
    match mesh.inputs().dim() {
        2 | 3 => Ok(()),
        dim => {
            let message = format!(
                "--surface goes through points in the plane or in space, and the input is {dim}D"
            );
            Err(Failure::new(ExitCode::Usage, message))
        }
    }
}

/// Finds the surface through the points of a plain Delaunay triangulation.
pub fn find(mesh: &Mesh, kind: SurfaceKind) -> Result<Found, Failure> {
    let triangulation = mesh.result()?;
    let surface = Surface::through(triangulation, kind)?;
    let volume = surface.volume(triangulation)?;
    Ok(Found { surface, points: mesh.inputs().distinct(), volume })
}

/// Writes the surface.
pub fn write(mesh: &Mesh, surface: &Surface, path: &Path) -> Result<(), Failure> {
    let triangulation = mesh.result()?;
    write_surface_file(mesh.inputs(), triangulation, &surface.facets, format(path)?, path)
        .map_err(|error| Failure::writing(&path.display().to_string(), &error))
}

/// Replaces points by their surface, whose inside is to be meshed.
pub fn replace(mesh: &mut Mesh, threads: u32) -> Result<Found, Failure> {
    let options = Options { algorithm: Algorithm::Delaunay, threads, ..Options::default() };
    mesh.run(&options, None)?;
    let found = find(mesh, SurfaceKind::Closed)?;
    if found.surface.facets.is_empty() {
        let message = "the points have no inside: no surface goes through them";
        return Err(Failure::new(ExitCode::InputRefused, message));
    }
    *mesh = part(mesh.result()?, &found.surface)?;
    Ok(found)
}

/// Makes a mesh, without a result, of the vertices and facets of a surface.
fn part(triangulation: &Triangulation, surface: &Surface) -> Result<Mesh, Failure> {
    let (points, facets) = surface.apart(triangulation)?;
    let dim = triangulation.dim;
    let mut mesh = Mesh::new(dim, points.len() / dim, &points, dim)?;
    match dim {
        2 => mesh.set_segments(&facets, None)?,
        _ => mesh.set_triangles(&facets, None)?,
    }
    Ok(mesh)
}
