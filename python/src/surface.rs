//! Surfaces through points.

use crate::core::{Core, Made};
use crate::derived::ids;
use crate::errors::{abandonable, detached, detached_on_file, invalid};
use netmesh::Triangulation;
use netmesh::io::{SurfaceFormat, write_surface_file};
use netmesh::surface::{Surface, SurfaceKind};
use netmesh::topology::has_inputs_alone;
use numpy::prelude::*;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::Arc;

/// The surface through the inputs of a mesh. Nothing changes it.
#[pyclass(frozen, module = "netmesh._netmesh")]
pub struct SurfaceCore {
    made: Arc<Made>,
    surface: Surface,
}

#[pymethods]
impl Core {
    fn surface(&self, py: Python<'_>, closed: bool) -> PyResult<SurfaceCore> {
        if !has_inputs_alone(self.triangulation()) {
            let message = "the mesh has vertices that are no inputs; make it with \
                           algorithm='delaunay'";
            return Err(invalid(py, message.into()));
        }
        let made = Arc::clone(&self.made);
        let kind = if closed { SurfaceKind::Closed } else { SurfaceKind::Open };
        abandonable(py, move || {
            let surface = Surface::through(made.triangulation(), kind)?;
            Ok(SurfaceCore { made, surface })
        })
    }
}

impl SurfaceCore {
    fn mesh(&self) -> &Triangulation {
        self.made.triangulation()
    }

    /// Returns inputs for vertices, of equal ones the first.
    fn inputs<'py>(&self, py: Python<'py>, of: &[u32]) -> PyResult<Bound<'py, PyArray1<i32>>> {
        let inputs = self.made.mesh.inputs();
        let first = |&vertex: &u32| inputs.first_input(vertex as usize).expect("an input's vertex");
        ids(py, of.iter().map(first).collect(), inputs.count())
    }
}

#[pymethods]
impl SurfaceCore {
    /// Returns the vertices of the surface, and its facets with numbers of these.
    #[allow(clippy::type_complexity)]
    fn apart<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<i32>>)> {
        let dim = self.mesh().dim;
        let (points, facets) = detached(py, || self.surface.apart(self.mesh()))?;
        let (rows, count) = (points.len() / dim, facets.len() / dim);
        let facets = ids(py, facets, rows)?.reshape([count, dim])?;
        Ok((PyArray1::from_vec(py, points).reshape([rows, dim])?, facets))
    }

    /// Returns the facets by the numbers of the caller's points.
    fn point_facets<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<i32>>> {
        let (facets, dim) = (&self.surface.facets, self.mesh().dim);
        self.inputs(py, facets)?.reshape([facets.len() / dim, dim])
    }

    fn left_out<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<i32>>> {
        self.inputs(py, &self.surface.left_out)
    }

    fn is_inside<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        PyArray1::from_slice(py, &self.surface.is_inside)
    }

    fn genera(&self) -> Vec<u64> {
        self.surface.shells.iter().map(|shell| shell.genus).collect()
    }

    /// Returns the number of ends of each shell, and whether it has one side alone.
    fn ends(&self) -> Vec<(u64, bool)> {
        self.surface.shells.iter().map(|shell| (shell.ends, shell.is_one_sided)).collect()
    }

    /// Returns the sampling of the vertices that are on the surface.
    fn sampling<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let all = self.surface.sampling.iter().copied();
        PyArray1::from_vec(py, all.filter(|ratio| !ratio.is_nan()).collect())
    }

    fn volume(&self, py: Python<'_>) -> PyResult<f64> {
        detached(py, || self.surface.volume(self.mesh()))
    }

    /// Returns the number of violations that the certificate finds, and the first in words.
    fn validate(&self, py: Python<'_>) -> PyResult<(u64, Option<String>)> {
        let inputs = self.made.mesh.inputs();
        let report = detached(py, || self.surface.validate(inputs, self.mesh()))?;
        Ok((report.violations, report.first.map(|first| first.message.into_owned())))
    }

    fn export(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        detached_on_file(py, &path, || {
            let format = SurfaceFormat::from_path(&path)?;
            let inputs = self.made.mesh.inputs();
            write_surface_file(inputs, self.mesh(), &self.surface.facets, format, &path)
        })
    }
}
