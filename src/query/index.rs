//! Search structures that are made once for a result.

use crate::error::{Error, Result};
use crate::memory::{AllocResult, collected, filled};
use crate::mesh::{Boxed, MAX_DIM, MIN_DIM, NONE, Triangulation, VertexKind, in_dimension};
use crate::nearest::Tree;

/// Set of vertices that a query is answered with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Among {
    Vertices,
    /// Vertices that are points of the caller. They are named as vertices all the same.
    Inputs,
}

/// Search structures that queries of one result need beside its arrays.
///
/// It takes 8 `dim` + 8 bytes a vertex and about 3 more, and as much but for 4 bytes again an
/// input of a result with other vertices; [`Index::bytes`] tells it exactly.
pub struct Index {
    pub(super) dim: usize,
    pub(super) simplices: usize,
    pub(super) vertices: usize,
    /// Tree of all vertices.
    pub(super) all: Tree,
    /// Tree of the inputs, if there are other vertices.
    inputs: Option<Tree>,
    /// Vertex -> the least simplex that has it; [`NONE`] if none has.
    pub(super) least_simplex: Vec<u32>,
    /// Index of the whole triangulation that the mesh is cropped from: walks go through that.
    pub(super) whole: Option<Boxed<Index>>,
}

impl Index {
    /// Builds the index of a result. O(simplices + vertices log vertices).
    ///
    /// # Errors
    /// `InvalidArgument` (arrays that do not fit together, or ids out of range), `OutOfMemory`.
    pub fn new(mesh: &Triangulation) -> Result<Self> {
        check_arrays(mesh)?;
        if let Some(whole) = &mesh.boundary.whole {
            check_whole(mesh, whole)?;
        }
        Ok(in_dimension!(mesh.dim, D => build::<D>(mesh), _ => return no_dimension())?)
    }

    /// Returns the number of bytes on the heap.
    pub fn bytes(&self) -> usize {
        let trees = self.all.bytes() + self.inputs.as_ref().map_or(0, Tree::bytes);
        let whole = self.whole.as_ref().map_or(0, |whole| whole.bytes());
        trees + size_of_val(&*self.least_simplex) + whole
    }

    pub(super) fn tree(&self, among: Among) -> &Tree {
        match among {
            Among::Vertices => &self.all,
            Among::Inputs => self.inputs.as_ref().unwrap_or(&self.all),
        }
    }
}

/// Fails unless every access to the arrays by the ids in them is in range.
pub(crate) fn check_arrays(mesh: &Triangulation) -> Result<()> {
    let refuse = |rule: &'static str| Err(Error::invalid(rule));
    let dim = mesh.dim;
    if !(MIN_DIM..=MAX_DIM).contains(&dim) {
        return no_dimension();
    }
    let (vertices, simplices) = (mesh.vertex_count(), mesh.simplices.len() / (dim + 1));
    let fits = mesh.points.len() == vertices * dim
        && mesh.simplices.len() == simplices * (dim + 1)
        && mesh.neighbors.len() == mesh.simplices.len()
        && simplices < NONE as usize
        && vertices < NONE as usize;
    if !fits {
        return refuse("the mesh's arrays do not fit together");
    }
    let mut neighbors = mesh.neighbors.iter();
    if mesh.simplices.iter().any(|&v| v as usize >= vertices)
        || neighbors.any(|&n| n as usize >= simplices && n != NONE)
    {
        return refuse("the mesh has an id out of range");
    }
    Ok(())
}

/// Fails unless `mesh` can be the first part of `whole`.
fn check_whole(mesh: &Triangulation, whole: &Triangulation) -> Result<()> {
    check_arrays(whole)?;
    let fits = whole.dim == mesh.dim
        && whole.vertex_count() >= mesh.vertex_count()
        && whole.simplices.starts_with(&mesh.simplices);
    match fits {
        true => Ok(()),
        false => {
            let rule = "the mesh is not the first part of the one that it was cut from";
            Err(Error::invalid(rule))
        }
    }
}

pub(super) fn no_dimension<T>() -> Result<T> {
    Err(Error::invalid("the mesh's dim is out of range"))
}

fn build<const D: usize>(mesh: &Triangulation) -> AllocResult<Index> {
    let mut least_simplex = filled(mesh.vertex_count(), NONE)?;
    for (at, &vertex) in mesh.simplices.iter().enumerate().rev() {
        least_simplex[vertex as usize] = (at / (D + 1)) as u32;
    }
    let is_input = |vertex: &u32| mesh.kinds[*vertex as usize] == VertexKind::Input;
    let vertices = 0..mesh.vertex_count() as u32;
    let inputs = match vertices.clone().all(|vertex| is_input(&vertex)) {
        true => None,
        false => Some(Tree::new::<D>(&mesh.points, collected(vertices.filter(is_input))?)?),
    };
    Ok(Index {
        dim: D,
        simplices: mesh.simplex_count(),
        vertices: mesh.vertex_count(),
        all: Tree::of_all::<D>(&mesh.points)?,
        inputs,
        least_simplex,
        whole: match &mesh.boundary.whole {
            Some(whole) => Some(Boxed::new(build::<D>(whole)?)?),
            None => None,
        },
    })
}
