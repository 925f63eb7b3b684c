//! Segments and regions from Python.

use crate::errors::{exception_with, in_default_environment, invalid};
use netmesh::{Mesh, Region};
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

/// Ends and markers of segments; seeds, labels, largest edges and holes of regions.
pub type Boundary<'py> = (
    PyReadonlyArray2<'py, i64>,
    Option<PyReadonlyArray1<'py, i64>>,
    Vec<([f64; 2], i32, f64, bool)>,
);

pub fn set_boundary(py: Python<'_>, mesh: &mut Mesh, boundary: &Boundary<'_>) -> PyResult<()> {
    let (segments, markers, regions) = boundary;
    let mut ends = Vec::new();
    for (at, &end) in segments.as_array().iter().enumerate() {
        ends.push(u32::try_from(end).map_err(|_| {
            let count = mesh.inputs().count();
            let message = format!(
                "segments[{}] has the end {end}; ends must be at least 0 and less than the number \
                 of points, {count}",
                at / 2
            );
            invalid(py, message)
        })?);
    }
    let mut own_markers = Vec::new();
    for (at, &marker) in markers.iter().flat_map(|markers| markers.as_array()).enumerate() {
        own_markers.push(i32::try_from(marker).map_err(|_| {
            invalid(py, format!("markers[{at}] is {marker}; it must be a number of 32 bits"))
        })?);
    }
    let region = |&([x, y], label, max_edge, is_hole)| Region {
        seed: [x, y, 0.0],
        label,
        is_hole,
        max_edge,
    };
    let regions: Vec<Region> = regions.iter().map(region).collect();
    let set = in_default_environment(|| {
        mesh.set_segments(&ends, markers.is_some().then_some(&*own_markers))?;
        if regions.is_empty() { Ok(()) } else { mesh.set_regions(&regions) }
    });
    set.map_err(|error| exception_with(py, &error, &regions))
}
