//! Points with segments, facets and regions from files, and from text that the package makes of
//! Python's objects.

use crate::errors::{detached, detached_on_file};
use netmesh::io::{Choice, Format, Outline, Table, read_table, read_table_file};
use netmesh::mesh::{Facets, LeftOut};
use numpy::prelude::*;
use numpy::{PyArray, PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;

/// Returns the content of a file by name.
#[pyfunction]
pub fn read_file(py: Python<'_>, path: PathBuf) -> PyResult<Bound<'_, PyDict>> {
    let choice = Choice::default();
    let table = detached_on_file(py, &path, || read_table_file(&path, Format::Auto, &choice))?;
    content(py, table)
}

/// Returns the content of GeoJSON by name.
#[pyfunction]
pub fn read_geojson(py: Python<'_>, text: String) -> PyResult<Bound<'_, PyDict>> {
    let read = || read_table(&mut text.as_bytes(), Format::Geojson, &Choice::default());
    content(py, detached(py, read)?)
}

/// Returns arrays of what has been read: points, segments with markers and sides, facets, regions,
/// and the numbers of edges, faces and cells that were left out.
fn content(py: Python<'_>, table: Table) -> PyResult<Bound<'_, PyDict>> {
    let Table { points, outline, left_out, .. } = table;
    let Outline { facets, segments, markers, sides, regions } = outline;
    let by_name = PyDict::new(py);
    by_name.set_item("points", rows(py, points.coordinates, points.dim)?)?;
    by_name.set_item("segments", rows(py, whole_numbers(segments.as_flattened()), 2)?)?;
    by_name.set_item("markers", PyArray1::from_vec(py, markers))?;
    by_name.set_item("sides", PyArray1::from_vec(py, sides))?;
    by_name.set_item("facets", (facets.count() > 0).then(|| facets_of(py, facets)))?;
    let region =
        |region: &netmesh::Region| (region.seed, region.label, region.max_edge, region.is_hole);
    by_name.set_item("regions", regions.iter().map(region).collect::<Vec<_>>())?;
    let LeftOut { edges, faces, cells } = left_out;
    by_name.set_item("left_out", (edges, faces, cells))?;
    Ok(by_name)
}

type NumbersOf<'py> = Bound<'py, PyArray1<i64>>;

/// Returns starts of loops and of the inputs of loops, the inputs, the markers, and whether all
/// facets are triangles.
fn facets_of(
    py: Python<'_>,
    facets: Facets,
) -> (NumbersOf<'_>, NumbersOf<'_>, NumbersOf<'_>, Bound<'_, PyArray1<i32>>, bool) {
    let Facets { loop_starts, input_starts, inputs, markers, are_triangles } = facets;
    let numbers = |ids: Vec<u32>| PyArray1::from_vec(py, whole_numbers(&ids));
    let markers = PyArray1::from_vec(py, markers);
    (numbers(loop_starts), numbers(input_starts), numbers(inputs), markers, are_triangles)
}

fn whole_numbers(ids: &[u32]) -> Vec<i64> {
    ids.iter().map(|&id| i64::from(id)).collect()
}

fn rows<T: numpy::Element>(
    py: Python<'_>,
    values: Vec<T>,
    columns: usize,
) -> PyResult<Bound<'_, PyArray2<T>>> {
    let shape = [values.len() / columns, columns];
    PyArray::from_vec(py, values).reshape(shape)
}
