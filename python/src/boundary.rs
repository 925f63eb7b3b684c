//! Segments and regions from Python.

use crate::errors::{exception, invalid};
use netmesh::{Error, Mesh, Region};
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
    let region = |&(seed, label, max_edge, is_hole)| Region { seed, label, is_hole, max_edge };
    let regions: Vec<Region> = regions.iter().map(region).collect();
    let set = mesh.set_segments(&ends, markers.is_some().then_some(&*own_markers));
    let set =
        set.and_then(|()| if regions.is_empty() { Ok(()) } else { mesh.set_regions(&regions) });
    set.map_err(|error| exception(py, &named(&error, &regions)))
}

/// Returns the error with seeds named as Python's callers gave them: holes stand after the regions
/// in what the library gets, and have a list of their own here.
pub fn named(error: &Error, regions: &[Region]) -> Error {
    let first_hole = regions.iter().filter(|region| !region.is_hole).count();
    let mut parts = error.message().split("regions[");
    let mut message = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let seed = part.split_once("].seed").and_then(|(at, rest)| Some((at.parse().ok()?, rest)));
        message += &match seed {
            Some((at, rest)) if at < first_hole => format!("regions[{at}]{rest}"),
            Some((at, rest)) => format!("holes[{}]{rest}", at - first_hole),
            None => format!("regions[{part}"),
        };
    }
    Error::new(error.kind(), message)
}
