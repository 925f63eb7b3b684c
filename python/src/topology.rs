//! Faces and filtrations.

use crate::arrays::{rows, shared, shared_ids};
use crate::core::{Core, Made, points_of_inputs};
use crate::derived::{Lists, ids, lists};
use crate::errors::{abandonable, detached, detached_on_file, invalid};
use crate::options::{choice, whole};
use netmesh::io::{FiltrationFormat, write_filtration_file};
use netmesh::topology::{Faces, Filtration, alpha, distances, has_inputs_alone};
use numpy::ndarray::ArrayView;
use numpy::prelude::*;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::Arc;

/// The faces of a mesh, and their values. Nothing changes it.
#[pyclass(frozen, module = "netmesh._netmesh")]
pub struct FiltrationCore {
    pub made: Arc<Made>,
    pub faces: Faces,
    pub filtration: Filtration,
}

#[pymethods]
impl Core {
    fn filtration(
        &self,
        py: Python<'_>,
        kind: &Bound<'_, PyAny>,
        threads: &Bound<'_, PyAny>,
    ) -> PyResult<FiltrationCore> {
        let is_of_mesh = choice("kind", kind, &[("alpha", false), ("mesh", true)])?;
        let threads = whole("threads", threads, u32::MAX)?;
        let mesh = self.triangulation();
        if !is_of_mesh && !has_inputs_alone(mesh) {
            let message = "kind is 'alpha', but the mesh has vertices that are no inputs; make it \
                           with algorithm='delaunay', or ask for kind='mesh'";
            return Err(invalid(py, message.into()));
        }
        let made = Arc::clone(&self.made);
        abandonable(py, move || {
            let mesh = made.triangulation();
            let faces = Faces::new(mesh, 0, threads)?;
            let filtration = match is_of_mesh {
                true => distances(mesh, &faces, made.prepared.index(&made.mesh)?, threads)?,
                false => alpha(mesh, &faces, threads)?,
            };
            Ok(FiltrationCore { made, faces, filtration })
        })
    }
}

impl FiltrationCore {
    /// Returns the number of each vertex; `None` where it is that of the vertex itself.
    fn vertex_numbers(&self) -> Option<&[u32]> {
        self.filtration.vertex_numbers(self.made.mesh.inputs())
    }

    /// Returns the dimension `k`, which is in `first..=last`.
    pub fn dimension(&self, k: &Bound<'_, PyAny>, first: u32, last: usize) -> PyResult<usize> {
        let given: u32 = whole("k", k, u32::MAX)?;
        if (first..=last as u32).contains(&given) {
            return Ok(given as usize);
        }
        Err(invalid(k.py(), format!("k is {given}; it must be {first} to {last}")))
    }
}

#[pymethods]
impl FiltrationCore {
    #[getter]
    fn dim(&self) -> usize {
        self.faces.dim()
    }

    #[getter]
    fn factor(&self) -> f64 {
        self.filtration.factor
    }

    /// Returns the points that the numbers of `faces` name.
    #[getter]
    fn points<'py>(this: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let core = this.get();
        if core.vertex_numbers().is_some() {
            return points_of_inputs(this.py(), core.made.mesh.inputs());
        }
        let mesh = core.made.triangulation();
        // SAFETY: nothing changes a mesh.
        unsafe { shared(this.as_any(), &rows(&mesh.points, mesh.dim)) }
    }

    /// Returns the faces of dimension `k`, their vertices numbered as those of the filtration.
    fn faces<'py>(
        this: &Bound<'py, Self>,
        k: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyArray2<i32>>> {
        let faces = &this.get().faces;
        let k = this.get().dimension(k, 0, faces.dim())?;
        let vertices = &faces.of_dimension(k).vertices;
        if let Some(numbers) = this.get().vertex_numbers() {
            let found = vertices.iter().map(|&vertex| numbers[vertex as usize]).collect();
            let count = this.get().made.mesh.inputs().count();
            return ids(this.py(), found, count)?.reshape([vertices.len() / (k + 1), k + 1]);
        }
        // SAFETY: nothing changes a filtration.
        unsafe { shared_ids(this.as_any(), vertices, k + 1, faces.of_dimension(0).count()) }
    }

    fn facets<'py>(
        this: &Bound<'py, Self>,
        k: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyArray2<i32>>> {
        let faces = &this.get().faces;
        let k = this.get().dimension(k, 1, faces.dim())?;
        let (boundary, count) =
            (&faces.of_dimension(k).boundary, faces.of_dimension(k - 1).count());
        // SAFETY: as above.
        unsafe { shared_ids(this.as_any(), boundary, k + 1, count) }
    }

    fn cofaces<'py>(&self, k: &Bound<'py, PyAny>) -> PyResult<Lists<'py>> {
        let py = k.py();
        let k = self.dimension(k, 0, self.faces.dim() - 1)?;
        let above = self.faces.of_dimension(k + 1);
        let count = self.faces.of_dimension(k).count();
        lists(py, detached(py, || above.coboundary(count))?, above.count())
    }

    /// Writes the filtration to a file, in the format that its extension names.
    fn export(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        detached_on_file(py, &path, || {
            let format = FiltrationFormat::from_path(&path)?;
            let inputs = self.made.mesh.inputs();
            write_filtration_file(inputs, &self.faces, &self.filtration, format, &path)
        })
    }

    fn values<'py>(
        this: &Bound<'py, Self>,
        k: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let k = this.get().dimension(k, 0, this.get().faces.dim())?;
        // SAFETY: as above.
        unsafe { shared(this.as_any(), &ArrayView::from(&this.get().filtration.values[k])) }
    }
}
