//! Arrays that are made of the mesh's on request.

use crate::arrays::fits;
use crate::core::Core;
use crate::errors::{abandonable_until, detached, exception};
use crate::options::whole;
use crate::progress::Reporter;
use crate::selection::Given;
use netmesh::query::{Values, Work, extend_values};
use netmesh::{Algorithm, Error, ErrorKind, Mesh, Options, Result, arrays};
use numpy::prelude::*;
use numpy::{PyArray1, PyArray2, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::{Arc, PoisonError};

/// Starts and ids of lists, as SciPy's `indptr` and `indices`.
pub type Lists<'py> = (Bound<'py, PyArray1<i64>>, Bound<'py, PyArray1<i32>>);

/// Returns an array that owns the ids, which are below `count` or NONE.
pub fn ids(py: Python<'_>, ids: Vec<u32>, count: usize) -> PyResult<Bound<'_, PyArray1<i32>>> {
    fits(py, count)?;
    // In place: the same size and alignment. NONE becomes -1.
    Ok(PyArray1::from_vec(py, ids.into_iter().map(|id| id as i32).collect()))
}

pub fn lists(py: Python<'_>, lists: arrays::Lists, count: usize) -> PyResult<Lists<'_>> {
    let starts = lists.starts.into_iter().map(|start| start as i64).collect();
    Ok((PyArray1::from_vec(py, starts), ids(py, lists.ids, count)?))
}

/// Returns an empty vector with room for so many doubles.
fn reserved(count: usize) -> Result<Vec<f64>> {
    let mut doubles = Vec::new();
    let refused = |_| Error::new(ErrorKind::OutOfMemory, "an allocation failed");
    doubles.try_reserve_exact(count).map_err(refused)?;
    Ok(doubles)
}

impl Core {
    pub fn count_of_vertices(&self) -> usize {
        self.triangulation().vertex_count()
    }

    pub fn count_of_simplices(&self) -> usize {
        self.triangulation().simplex_count()
    }

    /// Returns the Delaunay triangulation of the inputs; `None` if they are in a hyperplane.
    fn delaunay(&self, py: Python<'_>) -> PyResult<Arc<Option<Mesh>>> {
        let made = self.delaunay.lock().unwrap_or_else(PoisonError::into_inner).clone();
        if let Some(made) = made {
            return Ok(made);
        }
        let inputs = self.mesh.inputs();
        let mut reporter = Reporter::new(None);
        let made = detached(py, || {
            let mut mesh =
                Mesh::new(inputs.dim(), inputs.distinct(), &inputs.distinct_points(), 0)?;
            let options = Options { algorithm: Algorithm::Delaunay, ..Options::default() };
            match mesh.run(&options, Some(&mut |progress| reporter.report(progress))) {
                Err(error) if error.kind() == ErrorKind::DegenerateInput => Ok(None),
                done => done.map(|()| Some(mesh)),
            }
        });
        let made = Arc::new(reporter.exception.map_or(made, Err)?);
        *self.delaunay.lock().unwrap_or_else(PoisonError::into_inner) = Some(Arc::clone(&made));
        Ok(made)
    }
}

#[pymethods]
impl Core {
    /// Returns the ids of the simplices of a part.
    fn part_simplices<'py>(
        &self,
        py: Python<'py>,
        selection: Given<'py>,
    ) -> PyResult<Bound<'py, PyArray1<i32>>> {
        let chosen = self.of_part(py, selection, |part| Ok(part.simplices().collect()))?;
        ids(py, chosen, self.count_of_simplices())
    }

    fn edges<'py>(
        &self,
        py: Python<'py>,
        selection: Given<'py>,
    ) -> PyResult<Bound<'py, PyArray2<i32>>> {
        let edges =
            ids(py, self.of_part(py, selection, |part| part.edges())?, self.count_of_vertices())?;
        edges.reshape([edges.len() / 2, 2])
    }

    /// Returns the vertices of facets, and their two simplices.
    fn facets<'py>(&self, py: Python<'py>, selection: Given<'py>) -> PyResult<FacetArrays<'py>> {
        let facets = self.of_part(py, selection, |part| part.facets())?;
        let dim = self.triangulation().dim;
        let vertices = ids(py, facets.vertices, self.count_of_vertices())?;
        let simplices = ids(py, facets.simplices, self.count_of_simplices())?;
        let count = simplices.len() / 2;
        Ok((vertices.reshape([count, dim])?, simplices.reshape([count, 2])?))
    }

    /// Returns the vertices of the hull's facets, and their simplices.
    fn hull<'py>(&self, py: Python<'py>, selection: Given<'py>) -> PyResult<HullArrays<'py>> {
        let hull = self.of_part(py, selection, |part| part.hull())?;
        let dim = self.triangulation().dim;
        let vertices = ids(py, hull.vertices, self.count_of_vertices())?;
        let count = vertices.len() / dim;
        Ok((vertices.reshape([count, dim])?, ids(py, hull.simplices, self.count_of_simplices())?))
    }

    fn vertex_simplices<'py>(
        &self,
        py: Python<'py>,
        selection: Given<'py>,
    ) -> PyResult<Lists<'py>> {
        let stars = self.of_part(py, selection, |part| part.vertex_simplices())?;
        lists(py, stars, self.count_of_simplices())
    }

    fn vertex_neighbors<'py>(
        &self,
        py: Python<'py>,
        selection: Given<'py>,
    ) -> PyResult<Lists<'py>> {
        let neighbors = self.of_part(py, selection, |part| part.vertex_neighbors())?;
        lists(py, neighbors, self.count_of_vertices())
    }

    /// Returns the centres and radii of the circumballs of simplices.
    fn circumcenters<'py>(
        &self,
        py: Python<'py>,
        selection: Given<'py>,
    ) -> PyResult<BallArrays<'py>> {
        let arrays::Circumcenters { centers, radii } =
            self.of_part(py, selection, |part| part.circumcenters())?;
        let shape = [radii.len(), self.triangulation().dim];
        Ok((PyArray1::from_vec(py, centers).reshape(shape)?, PyArray1::from_vec(py, radii)))
    }

    fn volumes<'py>(
        &self,
        py: Python<'py>,
        selection: Given<'py>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        Ok(PyArray1::from_vec(py, self.of_part(py, selection, |part| part.volumes())?))
    }

    /// Returns the Voronoi diagram by the names of its parts.
    fn voronoi<'py>(&self, py: Python<'py>, selection: Given<'py>) -> PyResult<Bound<'py, PyDict>> {
        let arrays::Voronoi {
            regions,
            is_bounded,
            volumes,
            shares,
            ridges,
            ridge_corners,
            is_ridge_bounded,
        } = self.of_part(py, selection, |part| part.voronoi())?;
        let parts = PyDict::new(py);
        let (vertices, simplices) = (self.count_of_vertices(), self.count_of_simplices());
        let ridges = ids(py, ridges, vertices)?;
        parts.set_item("regions", lists(py, regions, simplices)?)?;
        parts.set_item("is_bounded", PyArray1::from_vec(py, is_bounded))?;
        parts.set_item("volumes", PyArray1::from_vec(py, volumes))?;
        parts.set_item("shares", PyArray1::from_vec(py, shares))?;
        parts.set_item("ridges", ridges.reshape([ridges.len() / 2, 2])?)?;
        parts.set_item("ridge_corners", lists(py, ridge_corners, simplices)?)?;
        parts.set_item("is_ridge_bounded", PyArray1::from_vec(py, is_ridge_bounded))?;
        Ok(parts)
    }

    /// Returns values at all vertices that agree with those at the inputs.
    fn extend_values<'py>(
        &self,
        py: Python<'py>,
        values: PyReadonlyArray2<'py, f64>,
        threads: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let threads = whole("threads", threads, u32::MAX)?;
        let components = values.as_array().dim().1;
        let is_delaunay = self.triangulation().parameters.algorithm == Algorithm::Delaunay;
        let other = if is_delaunay { None } else { Some(self.delaunay(py)?) };
        // The index of the triangulation cannot be stopped: the work may outlive this call.
        let (made, given) = (Arc::clone(&self.made), reserved(values.as_slice()?.len()));
        let mut given = given.map_err(|error| exception(py, &error))?;
        given.extend_from_slice(values.as_slice()?);
        let found = abandonable_until(py, move |stop| {
            let mesh = made.triangulation();
            let delaunay = match &other {
                Some(other) => other.as_ref().as_ref().and_then(Mesh::triangulation),
                None => Some(mesh),
            };
            let mut out = reserved(mesh.vertex_count() * components)?;
            out.resize(mesh.vertex_count() * components, 0.0);
            let (values, work) = (Values { components, values: &given }, Work { threads, stop });
            extend_values(made.mesh.inputs(), delaunay, mesh, values, work, &mut out)?;
            Ok(out)
        })?;
        PyArray1::from_vec(py, found).reshape([self.count_of_vertices(), components])
    }
}

type FacetArrays<'py> = (Bound<'py, PyArray2<i32>>, Bound<'py, PyArray2<i32>>);
type HullArrays<'py> = (Bound<'py, PyArray2<i32>>, Bound<'py, PyArray1<i32>>);
type BallArrays<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<f64>>);
