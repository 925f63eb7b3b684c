//! Interpolation in triangulations and among points that are arrays of Python's.

use crate::arrays::{empty, fits, given_ids, unsigned};
use crate::errors::{abandonable, invalid, stoppable};
use crate::options::whole;
use netmesh::query::{self, Convergence, Cubics, PointIndex, Triangles, Values, Work};
use numpy::prelude::*;
use numpy::{PyArray1, PyArray2, PyArray3, PyReadonlyArray1, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::prelude::*;

/// Points, and simplices and neighbours with -1 for none.
type Arrays<'py> =
    (PyReadonlyArray2<'py, f64>, PyReadonlyArray2<'py, i32>, PyReadonlyArray2<'py, i32>);

fn triangles<'a>((points, simplices, neighbors): &'a Arrays<'_>) -> PyResult<Triangles<'a>> {
    let columns = [points.as_array().ncols(), simplices.as_array().ncols()];
    if columns != [2, 3] || simplices.shape() != neighbors.shape() {
        let message = format!(
            "points, simplices and neighbors have the shapes {:?}, {:?} and {:?}; they must be (n, \
             2), (m, 3) and (m, 3)",
            points.shape(),
            simplices.shape(),
            neighbors.shape()
        );
        return Err(invalid(points.py(), message));
    }
    Ok(Triangles {
        points: points.as_slice()?,
        simplices: given_ids(simplices.as_slice()?),
        neighbors: given_ids(neighbors.as_slice()?),
    })
}

fn columns<'a>(values: &'a PyReadonlyArray2<'_, f64>) -> PyResult<Values<'a>> {
    Ok(Values { components: values.as_array().ncols(), values: values.as_slice()? })
}

/// Returns gradients at vertices (`vertices x components x 2`), and the number of components whose
/// gradients have not converged.
#[pyfunction]
pub fn estimate_gradients<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    values: PyReadonlyArray2<'py, f64>,
    tol: f64,
    maxiter: &Bound<'py, PyAny>,
) -> PyResult<(Bound<'py, PyArray3<f64>>, usize)> {
    let max_iterations = whole("maxiter", maxiter, u32::MAX)?;
    let (triangles, given) = (triangles(&arrays)?, columns(&values)?);
    if tol.is_nan() || tol < 0.0 {
        return Err(invalid(py, format!("tol is {tol}; it must be at least 0")));
    }
    let (vertices, components) = values.as_array().dim();
    let found = empty(py, (vertices, components, 2))?;
    let mut out = found.readwrite();
    let out = out.as_slice_mut()?;
    let convergence = Convergence { tolerance: tol, max_iterations };
    let missed = stoppable(py, out.len(), |stop| {
        let work = Work { threads: 1, stop };
        query::estimate_gradients(triangles, given, convergence, work, out)
    })?;
    Ok((found, missed))
}

/// Returns the values (`points x components`) at points in triangles, by their barycentric
/// coordinates; NaN where the triangle is -1.
#[pyfunction]
pub fn cubic<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    values: PyReadonlyArray2<'py, f64>,
    gradients: PyReadonlyArray3<'py, f64>,
    simplices: PyReadonlyArray1<'py, i32>,
    weights: PyReadonlyArray2<'py, f64>,
    threads: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let threads = whole("threads", threads, u32::MAX)?;
    let cubics = Cubics {
        triangles: triangles(&arrays)?,
        values: columns(&values)?,
        gradients: gradients.as_slice()?,
    };
    let found = empty(py, (simplices.len(), values.as_array().ncols()))?;
    let mut out = found.readwrite();
    let (out, weights) = (out.as_slice_mut()?, weights.as_slice()?);
    let simplices = given_ids(simplices.as_slice()?);
    stoppable(py, out.len(), |stop| {
        cubics.evaluate(simplices, weights, Work { threads, stop }, out)
    })?;
    Ok(found)
}

/// Returns for each point the one that stands for it.
#[pyfunction]
pub fn representatives<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    cutoff: f64,
) -> PyResult<Bound<'py, PyArray1<i32>>> {
    let (count, dim) = points.as_array().dim();
    fits(py, count)?;
    let found = empty(py, [count])?;
    let mut out = found.readwrite();
    let (points, out) = (points.as_slice()?, unsigned(out.as_slice_mut()?));
    stoppable(py, count, |stop| netmesh::representatives(dim, points, cutoff, stop, out))?;
    Ok(found)
}

/// Points, for the nearest of them. Nothing changes it.
#[pyclass(frozen, module = "netmesh._netmesh")]
pub struct PointIndexCore(PointIndex);

#[pymethods]
impl PointIndexCore {
    #[new]
    fn new(py: Python<'_>, points: PyReadonlyArray2<'_, f64>) -> PyResult<Self> {
        let dim = points.as_array().ncols();
        fits(py, points.as_array().nrows())?;
        let points: Vec<f64> = points.as_array().iter().copied().collect();
        abandonable(py, move || PointIndex::new(dim, &points)).map(Self)
    }

    /// Returns the nearest of the points for each of others, and its distance.
    fn nearest<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray2<'py, f64>,
        threads: &Bound<'py, PyAny>,
    ) -> PyResult<Nearest<'py>> {
        let threads = whole("threads", threads, u32::MAX)?;
        let count = points.as_array().nrows();
        let (found, distances) = (empty(py, [count])?, empty(py, [count])?);
        let (mut ids, mut lengths) = (found.readwrite(), distances.readwrite());
        let (ids, lengths) = (unsigned(ids.as_slice_mut()?), lengths.as_slice_mut()?);
        let points = points.as_slice()?;
        stoppable(py, count, |stop| self.0.nearest(points, Work { threads, stop }, ids, lengths))?;
        Ok((found, distances))
    }
}

type Nearest<'py> = (Bound<'py, PyArray1<i32>>, Bound<'py, PyArray1<f64>>);
