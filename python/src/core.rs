//! A mesh with its arrays.

use crate::arrays::{rows, shared, shared_ids, shared_ids_1, strided, unsigned};
use crate::errors::{exception, in_default_environment, invalid, raised};
use crate::options::by_keyword;
use netmesh::mesh::{Inputs, MAX_DIM, MIN_DIM};
use netmesh::prepared::Prepared;
use netmesh::{ErrorKind, Mesh, Triangulation};
use numpy::ndarray::ArrayView;
use numpy::prelude::*;
use numpy::{PyArray1, PyArray2, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::ops::Deref;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex};

/// The result of a run. Nothing changes it.
#[pyclass(frozen, module = "netmesh._netmesh")]
pub struct Core {
    /// Shared with what works on it still after a signal.
    pub made: Arc<Made>,
    /// The Delaunay triangulation of the inputs, if they have one; made when it is needed first.
    pub delaunay: Mutex<Option<Arc<Option<Mesh>>>>,
}

/// Part of a [`Core`] that knows nothing of Python: the mesh, and what queries have made.
pub struct Made {
    pub mesh: Mesh,
    pub prepared: Prepared,
    /// True as soon as `prepared` has made its index.
    pub has_index: AtomicBool,
}

impl Made {
    pub fn new(mesh: Mesh) -> Self {
        Self { mesh, prepared: Prepared::default(), has_index: AtomicBool::new(false) }
    }

    pub fn triangulation(&self) -> &Triangulation {
        self.mesh.triangulation().expect("a run made it")
    }
}

impl Deref for Core {
    type Target = Made;

    fn deref(&self) -> &Made {
        &self.made
    }
}

#[pymethods]
impl Core {
    #[getter]
    fn points<'py>(this: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let mesh = this.get().triangulation();
        // SAFETY: nothing changes a mesh.
        unsafe { shared(this.as_any(), &rows(&mesh.points, mesh.dim)) }
    }

    #[getter]
    fn simplices<'py>(this: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray2<i32>>> {
        let mesh = this.get().triangulation();
        // SAFETY: as above.
        unsafe { shared_ids(this.as_any(), &mesh.simplices, mesh.dim + 1, mesh.vertex_count()) }
    }

    #[getter]
    fn neighbors<'py>(this: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray2<i32>>> {
        let mesh = this.get().triangulation();
        // SAFETY: as above.
        unsafe { shared_ids(this.as_any(), &mesh.neighbors, mesh.dim + 1, mesh.simplex_count()) }
    }

    #[getter]
    fn kinds<'py>(this: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray1<u8>>> {
        let kinds = &this.get().triangulation().kinds;
        // SAFETY: the enum is represented by a u8.
        let kinds: &[u8] =
            unsafe { std::slice::from_raw_parts(kinds.as_ptr().cast(), kinds.len()) };
        // SAFETY: as above.
        unsafe { shared(this.as_any(), &ArrayView::from(kinds)) }
    }

    #[getter]
    fn vertex_domains<'py>(this: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray1<i32>>> {
        let mesh = this.get().triangulation();
        // SAFETY: as above.
        unsafe { shared_ids_1(this.as_any(), &mesh.vertex_domains, mesh.domains.len()) }
    }

    #[getter]
    fn precision_limited<'py>(this: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray1<bool>>> {
        let limited = &*this.get().triangulation().precision_limited;
        // SAFETY: as above.
        unsafe { shared(this.as_any(), &ArrayView::from(limited)) }
    }

    #[getter]
    fn input_vertices<'py>(this: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray1<i32>>> {
        let inputs = this.get().mesh.inputs();
        // SAFETY: as above.
        unsafe { shared_ids_1(this.as_any(), inputs.vertices(), inputs.count()) }
    }

    /// Returns the first input that each vertex is; a new array.
    fn vertex_inputs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<i32>>> {
        let (inputs, vertices) = (self.mesh.inputs(), self.triangulation().vertex_count());
        let found = crate::arrays::empty(py, [vertices])?;
        let mut out = found.readwrite();
        for (vertex, out) in unsigned(out.as_slice_mut()?).iter_mut().enumerate() {
            *out = inputs.first_input(vertex).unwrap_or(netmesh::NONE);
        }
        Ok(found)
    }

    #[getter]
    fn segments<'py>(this: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray2<i32>>> {
        let mesh = this.get().triangulation();
        let ends = mesh.boundary.subsegments.as_flattened();
        // SAFETY: as above.
        unsafe { shared_ids(this.as_any(), ends, 2, mesh.vertex_count()) }
    }

    #[getter]
    fn segment_parents<'py>(this: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray1<i32>>> {
        let core = this.get();
        let parents = &core.triangulation().boundary.parents;
        // SAFETY: as above.
        unsafe { shared_ids_1(this.as_any(), parents, core.mesh.segments().count()) }
    }

    #[getter]
    fn facet_triangles<'py>(this: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray2<i32>>> {
        let mesh = this.get().triangulation();
        let vertices = mesh.boundary.subfacets.as_flattened();
        // SAFETY: as above.
        unsafe { shared_ids(this.as_any(), vertices, 3, mesh.vertex_count()) }
    }

    #[getter]
    fn facet_parents<'py>(this: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray1<i32>>> {
        let core = this.get();
        let parents = &core.triangulation().boundary.subfacet_parents;
        // SAFETY: as above.
        unsafe { shared_ids_1(this.as_any(), parents, core.mesh.facets_of_result().count()) }
    }

    #[getter]
    fn facet_simplices<'py>(this: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray2<i32>>> {
        let mesh = this.get().triangulation();
        let simplices = mesh.boundary.subfacet_simplices.as_flattened();
        // SAFETY: as above.
        unsafe { shared_ids(this.as_any(), simplices, 2, mesh.simplex_count()) }
    }

    #[getter]
    fn flat_simplices<'py>(this: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray1<i32>>> {
        let mesh = this.get().triangulation();
        // SAFETY: as above.
        unsafe { shared_ids_1(this.as_any(), &mesh.boundary.flat, mesh.simplex_count()) }
    }

    #[getter]
    fn simplex_regions<'py>(this: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray1<i32>>> {
        let labels = &*this.get().triangulation().boundary.simplex_regions;
        // SAFETY: as above.
        unsafe { shared(this.as_any(), &ArrayView::from(labels)) }
    }

    #[getter]
    fn sizes<'py>(this: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let sizes = &*this.get().triangulation().sizes;
        // SAFETY: as above.
        unsafe { shared(this.as_any(), &ArrayView::from(sizes)) }
    }

    /// Returns the options of the run, with every default filled in.
    #[getter]
    fn parameters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        by_keyword(py, &self.triangulation().parameters.options())
    }

    /// Returns the centres, parents (-1 for none) and radii of the domains.
    #[getter]
    fn domains(&self) -> (Vec<u32>, Vec<i64>, Vec<f64>) {
        let domains = || self.triangulation().domains.iter();
        let parent = |parent| if parent == netmesh::NONE { -1 } else { i64::from(parent) };
        (
            domains().map(|domain| domain.center).collect(),
            domains().map(|domain| parent(domain.parent)).collect(),
            domains().map(|domain| domain.radius).collect(),
        )
    }

    /// Returns the points that were given, duplicates included.
    fn input_points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        points_of_inputs(py, self.mesh.inputs())
    }
}

/// Returns a mesh of points, which are copied.
pub fn mesh_of(py: Python<'_>, points: &PyReadonlyArray2<'_, f64>) -> PyResult<Mesh> {
    let (n, dim) = points.as_array().dim();
    if !(MIN_DIM..=MAX_DIM).contains(&dim) {
        let message = format!(
            "points has shape ({n}, {dim}); it must be (n, dim), dim from {MIN_DIM} to \
             {MAX_DIM}"
        );
        return Err(raised(py, ErrorKind::Dimension, message));
    }
    if n >= netmesh::NONE as usize {
        let most = netmesh::NONE - 1;
        let message = format!("points has shape ({n}, {dim}); at most {most} points have ids");
        return Err(raised(py, ErrorKind::Capacity, message));
    }
    let Some((coordinates, stride)) = strided(points) else {
        return Err(invalid(py, "points must stand one after the other in memory".into()));
    };
    let mesh = in_default_environment(|| Mesh::new(dim, n, coordinates, stride));
    mesh.map_err(|error| exception(py, &error))
}

/// Returns the points that were given, duplicates included; a new array.
pub fn points_of_inputs<'py>(
    py: Python<'py>,
    inputs: &Inputs,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let array = crate::arrays::empty(py, (inputs.count(), inputs.dim()))?;
    let mut out = array.readwrite();
    for (i, out) in out.as_slice_mut()?.chunks_exact_mut(inputs.dim()).enumerate() {
        out.copy_from_slice(inputs.point(i));
    }
    Ok(array)
}
