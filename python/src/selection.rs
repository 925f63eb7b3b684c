//! Some of the simplices of a mesh.

use crate::core::Core;
use crate::errors::abandonable;
use crate::options::{choice, whole};
use netmesh::Result;
use netmesh::arrays::{Part, Selection, SelectionExtent};
use numpy::PyArray1;
use pyo3::prelude::*;
use std::sync::Arc;

/// The extent by name, whether simplices across its boundary belong to it, and the domain. None for
/// all simplices.
pub type Given<'py> = Option<(Bound<'py, PyAny>, bool, Option<Bound<'py, PyAny>>)>;

const EXTENTS: [(&str, SelectionExtent); 3] =
    [("all", SelectionExtent::All), ("hull", SelectionExtent::Hull), ("box", SelectionExtent::Box)];

pub fn selected(given: Given<'_>) -> PyResult<Option<Selection>> {
    let Some((extent, across, domain)) = given else { return Ok(None) };
    let extent = choice("extent", &extent, &EXTENTS)?;
    let domain = match domain {
        Some(domain) => whole("domain", &domain, netmesh::NONE - 1)?,
        None => netmesh::NONE,
    };
    Ok(Some(Selection { extent, across, domain }))
}

impl Core {
    /// Returns what `make` makes of the selected simplices.
    pub fn of_part<T: Send + 'static>(
        &self,
        py: Python<'_>,
        given: Given<'_>,
        make: impl FnOnce(&Part<'_>) -> Result<T> + Send + 'static,
    ) -> PyResult<T> {
        let selection = selected(given)?.unwrap_or_default();
        let made = Arc::clone(&self.made);
        abandonable(py, move || make(&made.prepared.part(&made.mesh, &selection)?))
    }
}

#[pymethods]
impl Core {
    /// Returns the placement of each simplex: 0 inside, 1 across, 2 outside.
    fn placements<'py>(
        &self,
        py: Python<'py>,
        extent: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyArray1<u8>>> {
        let extent = choice("extent", extent, &EXTENTS[1..])?;
        let made = Arc::clone(&self.made);
        let placements = abandonable(py, move || {
            let placements = made.prepared.placements(&made.mesh, extent)?;
            Ok(placements.iter().map(|&placement| placement as u8).collect())
        })?;
        Ok(PyArray1::from_vec(py, placements))
    }
}
