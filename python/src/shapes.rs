//! Alpha shapes of a filtration by alpha values.

use crate::derived::ids;
use crate::errors::{detached, detached_on_file, in_default_environment, invalid};
use crate::options::{number, whole};
use crate::topology::FiltrationCore;
use netmesh::Result;
use netmesh::io::{SurfaceFormat, write_surface_file};
use netmesh::topology::{AlphaShape, FaceClass, connecting_alpha, optimal_alpha};
use numpy::prelude::*;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;

impl FiltrationCore {
    fn shape(&self, alpha: f64) -> Result<AlphaShape<'_>> {
        AlphaShape::new(&self.faces, &self.filtration, alpha)
    }
}

#[pymethods]
impl FiltrationCore {
    fn connecting_alpha(&self, py: Python<'_>) -> PyResult<f64> {
        detached(py, || connecting_alpha(&self.faces, &self.filtration))
    }

    fn optimal_alpha(&self, components: &Bound<'_, PyAny>) -> PyResult<f64> {
        let count = whole("components", components, u64::MAX)?;
        detached(components.py(), || optimal_alpha(&self.faces, &self.filtration, count))
    }

    /// Returns the value as a number, if it can be that of a shape.
    fn checked_alpha(&self, alpha: &Bound<'_, PyAny>) -> PyResult<f64> {
        let alpha_value = number("alpha", alpha)?;
        match in_default_environment(|| self.shape(alpha_value)) {
            Ok(shape) => Ok(shape.alpha()),
            Err(error) => Err(invalid(alpha.py(), error.message().into())),
        }
    }

    fn shape_measures<'py>(&self, py: Python<'py>, alpha: f64) -> PyResult<Bound<'py, PyDict>> {
        let (topology, volume) = detached(py, || {
            let shape = self.shape(alpha)?;
            Ok((shape.topology()?, shape.volume(self.made.triangulation())?))
        })?;
        let measures = PyDict::new(py);
        measures.set_item("volume", volume)?;
        measures.set_item("face_counts", topology.face_counts)?;
        measures.set_item("euler_characteristic", topology.euler_characteristic)?;
        measures.set_item("components", topology.components)?;
        measures.set_item("voids", topology.voids)?;
        measures.set_item("betti", topology.betti)?;
        Ok(measures)
    }

    fn shape_classes<'py>(
        &self,
        alpha: f64,
        k: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyArray1<u8>>> {
        let py = k.py();
        let k = self.dimension(k, 0, self.faces.dim())?;
        let classes = detached(py, || self.shape(alpha)?.classes(k))?;
        Ok(PyArray1::from_vec(py, classes.into_iter().map(class_byte).collect()))
    }

    /// Returns the simplices of the shape, by their ids in the mesh.
    fn shape_simplices<'py>(
        &self,
        py: Python<'py>,
        alpha: f64,
    ) -> PyResult<Bound<'py, PyArray1<i32>>> {
        let mesh = self.made.triangulation();
        let simplices = detached(py, || Ok(self.shape(alpha)?.solid(mesh)?.simplices().collect()))?;
        ids(py, simplices, mesh.simplex_count())
    }

    fn shape_boundary<'py>(
        &self,
        py: Python<'py>,
        alpha: f64,
    ) -> PyResult<Bound<'py, PyArray2<i32>>> {
        let (inputs, mesh) = (self.made.mesh.inputs(), self.made.triangulation());
        let facets = detached(py, || self.shape(alpha)?.boundary(inputs, mesh))?;
        let count = facets.len() / mesh.dim;
        ids(py, facets, inputs.count())?.reshape([count, mesh.dim])
    }

    /// Writes the shape's boundary to a file, in the format that its extension names.
    fn export_shape(&self, py: Python<'_>, alpha: f64, path: PathBuf) -> PyResult<()> {
        detached_on_file(py, &path, || {
            let format = SurfaceFormat::from_path(&path)?;
            let mesh = self.made.triangulation();
            let facets = self.shape(alpha)?.solid(mesh)?.hull()?.vertices;
            write_surface_file(self.made.mesh.inputs(), mesh, &facets, format, &path)
        })
    }
}

fn class_byte(class: FaceClass) -> u8 {
    match class {
        FaceClass::Exterior => 0,
        FaceClass::Singular => 1,
        FaceClass::Regular => 2,
        FaceClass::Interior => 3,
    }
}
