//! Values of the inputs at all vertices of a mesh of theirs.

use super::{Among, Index, Interpolation, Method, Outside, Values, Work};
use crate::error::{Error, Result, message};
use crate::memory::{filled, with_capacity};
use crate::mesh::{Inputs, Triangulation};

/// Writes values at all vertices of `mesh` (`vertices x components`) that agree with `values` at
/// the inputs (`inputs x components`, in the caller's order; of equal inputs the first counts):
/// linear in `delaunay`, the Delaunay triangulation of the inputs, and those of the nearest input
/// beyond its hull. Without `delaunay`, for inputs in a hyperplane, those of the nearest input.
///
/// # Errors
/// `InvalidArgument` (a length; a triangulation of other inputs), `Cancelled` (by what stops the
/// work), `OutOfMemory`.
pub fn extend_values<'a>(
    inputs: &Inputs,
    delaunay: Option<&Triangulation>,
    mesh: &Triangulation,
    values: Values<'_>,
    work: impl Into<Work<'a>>,
    out: &mut [f64],
) -> Result<()> {
    let work = work.into();
    check_extension(inputs, mesh, values, out)?;
    let components = values.components;
    let is_of_inputs =
        |mesh: &Triangulation| mesh.dim == inputs.dim() && mesh.vertex_count() == inputs.distinct();
    if !delaunay.is_none_or(is_of_inputs) {
        return refuse(message!("the triangulation is not one of these inputs"));
    }
    let mut of_vertices = with_capacity(inputs.distinct() * components)?;
    for vertex in 0..inputs.distinct() {
        of_vertices.extend_from_slice(values.of(inputs.first_input(vertex).unwrap_or(0)));
    }
    let of_vertices = Values { components, values: &of_vertices };
    if let Some(delaunay) = delaunay {
        let method = Method { interpolation: Interpolation::Linear, outside: Outside::Nearest };
        let index = Index::new(delaunay)?;
        return index.interpolate(delaunay, method, of_vertices, &mesh.points, work, out);
    }
    let mut nearest = filled(mesh.vertex_count(), 0)?;
    let mut distances = filled(mesh.vertex_count(), 0.0)?;
    let index = Index::new(mesh)?;
    index.nearest(mesh, Among::Inputs, &mesh.points, work, &mut nearest, &mut distances)?;
    for (out, &vertex) in out.chunks_exact_mut(components).zip(&nearest) {
        out.copy_from_slice(of_vertices.of(vertex));
    }
    Ok(())
}

/// Fails unless `values` has the length of those of the inputs, and `out` that of the vertices'.
pub(crate) fn check_extension(
    inputs: &Inputs,
    mesh: &Triangulation,
    values: Values<'_>,
    out: &[f64],
) -> Result<()> {
    let components = values.components;
    if components == 0 {
        return refuse(message!("components is 0; it must be at least 1"));
    }
    values.check("input_values", inputs.count(), "inputs")?;
    if Some(out.len()) != mesh.vertex_count().checked_mul(components) {
        let (length, vertices) = (out.len(), mesh.vertex_count());
        return refuse(message!(
            "vertex_values has length {length}; it must be {vertices} vertices x {components}"
        ));
    }
    if mesh.dim != inputs.dim() || mesh.vertex_count() < inputs.distinct() {
        return refuse(message!("the mesh is not one of these inputs"));
    }
    Ok(())
}

fn refuse(message: String) -> Result<()> {
    Err(Error::invalid(message))
}
