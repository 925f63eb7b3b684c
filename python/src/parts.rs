//! Parts of a mesh as meshes of their own: their arrays, their measures, and points in them.

use crate::core::{Core, Made};
use crate::errors::abandonable;
use crate::selection::{Given, selected};
use netmesh::arrays::Selection;
use netmesh::query::{Index, Place, Work};
use netmesh::{Mesh, NONE, Result, Triangulation};
use numpy::PyArray1;
use pyo3::prelude::*;
use std::collections::HashSet;
use std::sync::{Arc, Mutex};

impl Made {
    /// Returns a mesh of the selected simplices and their vertices, numbered anew.
    fn part(&self, selection: &Selection) -> Result<Mesh> {
        let part = self.prepared.part(&self.mesh, selection)?;
        let (mesh, _) = part.to_mesh(self.mesh.inputs(), &[])?;
        let mesh = mesh.with_facet_markers(self.mesh.facets_of_result().markers.to_vec());
        Ok(mesh.with_markers(self.mesh.markers_of_result().to_vec()))
    }

    /// Measures the selected simplices; all of the mesh without a selection.
    pub fn measured<T>(
        &self,
        selection: Option<Selection>,
        measure: impl FnOnce(&Triangulation) -> Result<T>,
    ) -> Result<T> {
        match selection {
            None => measure(self.triangulation()),
            Some(selection) => {
                measure(&self.prepared.part(&self.mesh, &selection)?.for_measures()?)
            }
        }
    }

    /// Writes for each point the row of the selected simplex that holds it, among the selected
    /// ones; [`NONE`] outside of them. On a face that several share it is the least.
    pub fn locate_in_part(
        &self,
        index: &Index,
        selection: &Selection,
        points: &[f64],
        work: Work<'_>,
        rows: &mut [u32],
    ) -> Result<()> {
        let mesh = self.triangulation();
        let mut places = vec![Place::OUTSIDE; rows.len()];
        index.places(mesh, points, work, &mut places)?;
        let part = self.prepared.part(&self.mesh, selection)?;
        let mut row_of = vec![NONE; mesh.simplex_count()];
        part.simplices().zip(0..).for_each(|(simplex, row)| row_of[simplex as usize] = row);
        for (place, row) in places.into_iter().zip(rows) {
            if work.stop.is_set() {
                break;
            }
            *row = least_row(mesh, place, &row_of);
        }
        Ok(())
    }
}

/// Returns the least row of the simplices that have the face of a place; [`NONE`] if none has one.
fn least_row(mesh: &Triangulation, place: Place, row_of: &[u32]) -> u32 {
    let row = |simplex: u32| row_of.get(simplex as usize).copied().unwrap_or(NONE);
    let own = row(place.simplex);
    if own != NONE || place.simplex == NONE || place.dimension() == Some(mesh.dim as u32) {
        return own;
    }
    // The simplices round a face are neighbours of each other in the whole, which is convex.
    let whole = mesh.boundary.whole.as_deref().unwrap_or(mesh);
    let own = whole.simplex(place.simplex as usize).iter().enumerate();
    let face: Vec<u32> = own.filter(|(i, _)| place.face >> i & 1 == 1).map(|(_, &v)| v).collect();
    let (mut left, mut seen) = (vec![place.simplex], HashSet::from([place.simplex]));
    let mut least = NONE;
    while let Some(simplex) = left.pop() {
        least = least.min(row(simplex));
        let vertices = whole.simplex(simplex as usize).iter();
        for (vertex, &next) in vertices.zip(whole.neighbors_of(simplex as usize)) {
            if next != NONE && !face.contains(vertex) && seen.insert(next) {
                left.push(next);
            }
        }
    }
    least
}

#[pymethods]
impl Core {
    /// Makes a mesh of the selected simplices and their vertices, numbered anew.
    fn part(&self, py: Python<'_>, selection: Given<'_>) -> PyResult<Self> {
        let selection = selected(selection)?.unwrap_or_default();
        let made = Arc::clone(&self.made);
        let mesh = abandonable(py, move || made.part(&selection))?;
        Ok(Self { made: Arc::new(Made::new(mesh)), delaunay: Mutex::default() })
    }

    /// Returns the marker of the segment that each edge of one is a part of; a new array.
    fn segment_markers<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i32>> {
        let parents = &self.triangulation().boundary.parents;
        PyArray1::from_vec(py, markers_of(parents, self.mesh.markers_of_result()))
    }

    /// Returns the marker of the facet that each triangle of one is a part of; a new array.
    fn facet_markers<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i32>> {
        let parents = &self.triangulation().boundary.subfacet_parents;
        PyArray1::from_vec(py, markers_of(parents, &self.mesh.facets_of_result().markers))
    }
}

/// Returns the markers of parents, 0 for those that are none.
fn markers_of(parents: &[u32], markers: &[i32]) -> Vec<i32> {
    parents.iter().map(|&parent| markers.get(parent as usize).copied().unwrap_or(0)).collect()
}
