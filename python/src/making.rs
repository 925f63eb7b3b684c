//! Making of a mesh: the run, of points, sizes and a boundary.

use crate::boundary::{Boundary, set_boundary};
use crate::core::{Core, Made, mesh_of};
use crate::errors::{exception_with, unlocked};
use crate::options::options;
use crate::progress::Reporter;
use crate::sizes::Sizes;
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::{Arc, Mutex};

#[pymethods]
impl Core {
    /// Makes a mesh of points, which are copied before other threads may change them.
    #[new]
    fn new(
        py: Python<'_>,
        points: PyReadonlyArray2<'_, f64>,
        progress: Option<Py<PyAny>>,
        given: &Bound<'_, PyDict>,
        boundary: Option<Boundary<'_>>,
    ) -> PyResult<Self> {
        let options = options(given)?;
        let mut mesh = mesh_of(py, &points)?;
        let sizes = Sizes::new(&mut mesh, given)?;
        if let Some(boundary) = boundary {
            set_boundary(py, &mut mesh, &boundary)?;
        }
        let mut reporter = Reporter::new(progress);
        let done = unlocked(py, || {
            let report = &mut |progress: &_| reporter.report(progress);
            sizes.with(|size| mesh.run_sized(&options, size, Some(report)))
        });
        match reporter.exception.or(sizes.exception()) {
            Some(exception) => Err(exception),
            None => {
                done.map_err(|error| exception_with(py, &error, mesh.regions()))?;
                Ok(Self { made: Arc::new(Made::new(mesh)), delaunay: Mutex::default() })
            }
        }
    }
}
