//! Sizes given by values, kept with a mesh until they are replaced: at its inputs, and at the
//! vertices of another mesh.

use super::{Boundary, Boxed, Mesh, Triangulation};
use crate::error::{Error, ErrorKind, Name, Result, message, say};
use crate::memory::{AllocResult, copied, filled};

/// Sizes given by values.
#[derive(Clone, Debug, Default)]
pub struct GivenSizes {
    /// Input -> size; empty if there are none.
    pub at_inputs: Vec<f64>,
    pub background: Option<Background>,
}

/// Mesh with a size at each vertex.
#[derive(Clone, Debug)]
pub struct Background {
    pub mesh: Triangulation,
    pub sizes: Vec<f64>,
}

impl GivenSizes {
    pub fn is_empty(&self) -> bool {
        self.at_inputs.is_empty() && self.background.is_none()
    }
}

impl Mesh {
    /// Sets sizes at the inputs for the runs that follow: one for each, in the caller's order (of
    /// equal inputs the first counts), or none. Between inputs sizes are linear in their Delaunay
    /// triangulation.
    ///
    /// # Errors
    /// `InvalidArgument` (the length; a size that is not above 0), `OutOfMemory`.
    pub fn set_sizes(&mut self, sizes: &[f64]) -> Result<()> {
        let count = self.inputs().count();
        if !sizes.is_empty() && sizes.len() != count {
            let given = sizes.len();
            let message = message!("count is {given}; it must be 0 or the {count} inputs");
            return Err(Error::new(ErrorKind::InvalidArgument, message));
        }
        check(sizes, Name::SizeAt)?;
        self.given_sizes.at_inputs = copied(sizes)?;
        Ok(())
    }

    /// Sets sizes at the vertices of `background` for the runs that follow; both are copied.
    /// Between vertices sizes are linear, and beyond the background they are those of its nearest
    /// vertex. `None` removes them.
    ///
    /// # Errors
    /// `Dimension` (another one), `InvalidArgument` (the length; a size that is not above 0),
    /// `OutOfMemory`.
    pub fn set_background(&mut self, background: Option<(&Triangulation, &[f64])>) -> Result<()> {
        let Some((mesh, sizes)) = background else {
            self.given_sizes.background = None;
            return Ok(());
        };
        self.given_sizes.background = Some(self.checked_background(mesh, sizes)?);
        Ok(())
    }

    /// Sets sizes at the vertices of the mesh's own result, for a run that adapts it: see
    /// [`Mesh::set_background`].
    ///
    /// # Errors
    /// `InvalidArgument` (the length; a size that is not above 0), `OutOfMemory`; `State` before a
    /// run.
    pub fn set_own_background(&mut self, sizes: &[f64]) -> Result<()> {
        let background = self.checked_background(self.result()?, sizes)?;
        self.given_sizes.background = Some(background);
        Ok(())
    }

    fn checked_background(&self, mesh: &Triangulation, sizes: &[f64]) -> Result<Background> {
        let (dim, own) = (mesh.dim, self.inputs().dim());
        if dim != own {
            let message = message!("background has {dim} dimensions, the mesh {own}");
            return Err(Error::new(ErrorKind::Dimension, message));
        }
        if sizes.len() != mesh.vertex_count() {
            let (given, vertices) = (sizes.len(), mesh.vertex_count());
            let message =
                message!("count is {given}; it must be the {vertices} vertices of the background");
            return Err(Error::new(ErrorKind::InvalidArgument, message));
        }
        check(sizes, Name::BackgroundSizeAt)?;
        Ok(Background { mesh: arrays_of(mesh)?, sizes: copied(sizes)? })
    }
}

/// Fails unless all are sizes; `name` makes the name of a size from its number.
fn check(sizes: &[f64], name: fn(usize) -> Name) -> Result<()> {
    match sizes.iter().position(|size| size.is_nan() || *size <= 0.0) {
        None => Ok(()),
        Some(at) => {
            let size = sizes[at];
            let message = say!(name(at), " is {size}; a size is above 0, or infinite for no bound");
            Err(Error::new(ErrorKind::InvalidArgument, message))
        }
    }
}

/// Returns a copy of the arrays that queries need, of a result and of the triangulation that it was
/// cropped from.
fn arrays_of(mesh: &Triangulation) -> AllocResult<Triangulation> {
    let vertices = mesh.vertex_count();
    let whole = mesh.boundary.whole.as_deref().map(arrays_of).transpose()?;
    Ok(Triangulation {
        dim: mesh.dim,
        points: copied(&mesh.points)?,
        simplices: copied(&mesh.simplices)?,
        neighbors: copied(&mesh.neighbors)?,
        kinds: filled(vertices, super::VertexKind::Input)?,
        vertex_domains: Vec::new(),
        cage_of: Vec::new(),
        domains: Vec::new(),
        precision_limited: Vec::new(),
        below_min_dihedral: Vec::new(),
        beyond_bound: Vec::new(),
        boundary: Boundary { whole: whole.map(Boxed::new).transpose()?, ..Boundary::default() },
        sizes: Vec::new(),
        parameters: mesh.parameters.clone(),
        stats: mesh.stats.clone(),
    })
}
