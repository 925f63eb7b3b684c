//! Segments, facets and regions from Python.

use crate::core::mesh_of;
use crate::errors::{abandonable, exception_with, in_default_environment, invalid};
use netmesh::mesh::{EdgeFault, Feature, IntersectionKind};
use netmesh::{Mesh, Region};
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

/// Ends and markers of segments; seeds, labels, largest edges and holes of regions; facets; which
/// segments are sides of polygons, if any are.
pub type Boundary<'py> = (
    PyReadonlyArray2<'py, i64>,
    Option<PyReadonlyArray1<'py, i64>>,
    Vec<([f64; 3], i32, f64, bool)>,
    Option<Facets<'py>>,
    Option<PyReadonlyArray1<'py, bool>>,
);

/// Starts of loops, none for triangles, and of the inputs of loops; inputs; markers.
type Facets<'py> = (
    Option<PyReadonlyArray1<'py, i64>>,
    Option<PyReadonlyArray1<'py, i64>>,
    PyReadonlyArray1<'py, i64>,
    Option<PyReadonlyArray1<'py, i64>>,
);

pub fn set_boundary(py: Python<'_>, mesh: &mut Mesh, boundary: &Boundary<'_>) -> PyResult<()> {
    let (segments, markers, regions, facets, sides) = boundary;
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
    let markers = numbers(py, "markers", markers.as_ref())?;
    let region = |&(seed, label, max_edge, is_hole)| Region { seed, label, is_hole, max_edge };
    let regions: Vec<Region> = regions.iter().map(region).collect();
    let sides = sides.as_ref().map(|sides| sides.as_array().to_vec());
    let set = in_default_environment(|| {
        if !ends.is_empty() {
            mesh.set_segments(&ends, markers.as_deref())?;
        }
        if let Some(sides) = &sides {
            mesh.set_sides(sides)?;
        }
        if regions.is_empty() { Ok(()) } else { mesh.set_regions(&regions) }
    });
    set.map_err(|error| exception_with(py, &error, &regions))?;
    facets.as_ref().map_or(Ok(()), |facets| set_facets(py, mesh, facets))
}

fn set_facets(py: Python<'_>, mesh: &mut Mesh, facets: &Facets<'_>) -> PyResult<()> {
    let (loop_starts, input_starts, inputs, markers) = facets;
    // The package makes them: they rise from 0.
    let starts = |starts: &Option<PyReadonlyArray1<'_, i64>>| -> Option<Vec<u64>> {
        let starts = starts.as_ref()?.as_array();
        Some(starts.iter().map(|&start| start as u64).collect())
    };
    let starts = starts(loop_starts).zip(starts(input_starts));
    let facet_of = |at: usize| match &starts {
        None => at / 3,
        Some((loops, inputs)) => {
            let of_loop = inputs.partition_point(|&start| start <= at as u64) as u64 - 1;
            loops.partition_point(|&start| start <= of_loop) - 1
        }
    };
    let mut members = Vec::new();
    for (at, &input) in inputs.as_array().iter().enumerate() {
        members.push(u32::try_from(input).map_err(|_| {
            let message = format!(
                "facets[{}] has the input {input}; it must be at least 0 and less than the number \
                 of points, {}",
                facet_of(at),
                mesh.inputs().count()
            );
            invalid(py, message)
        })?);
    }
    let markers = numbers(py, "facet_markers", markers.as_ref())?;
    let set = in_default_environment(|| match &starts {
        None => mesh.set_triangles(&members, markers.as_deref()),
        Some((loops, inputs)) => mesh.set_facets(loops, inputs, &members, markers.as_deref()),
    });
    set.map_err(|error| exception_with(py, &error, &[]))
}

/// Returns markers, which must be numbers of 32 bits.
fn numbers(
    py: Python<'_>,
    name: &str,
    markers: Option<&PyReadonlyArray1<'_, i64>>,
) -> PyResult<Option<Vec<i32>>> {
    let Some(markers) = markers else { return Ok(None) };
    let number = |(at, &marker): (usize, &i64)| {
        i32::try_from(marker).map_err(|_| {
            invalid(py, format!("{name}[{at}] is {marker}; it must be a number of 32 bits"))
        })
    };
    markers.as_array().iter().enumerate().map(number).collect::<PyResult<_>>().map(Some)
}

/// Returns the triangles that close holes of facets with at most so many edges, three inputs each.
#[pyfunction]
pub fn close_holes(
    py: Python<'_>,
    points: PyReadonlyArray2<'_, f64>,
    boundary: Boundary<'_>,
    max_edges: u32,
) -> PyResult<Vec<[u32; 3]>> {
    let mut mesh = mesh_of(py, &points)?;
    set_boundary(py, &mut mesh, &boundary)?;
    let found = abandonable(py, move || mesh.close_holes(max_edges as usize))?;
    Ok(found.triangles)
}

/// Returns the triangles that facets consist of, three inputs each, and the facet of each.
#[pyfunction]
pub fn triangulate_facets(
    py: Python<'_>,
    points: PyReadonlyArray2<'_, f64>,
    boundary: Boundary<'_>,
) -> PyResult<(Vec<[u32; 3]>, Vec<u32>)> {
    let mut mesh = mesh_of(py, &points)?;
    set_boundary(py, &mut mesh, &boundary)?;
    let found = abandonable(py, move || mesh.facet_triangulation())?;
    Ok((found.triangles, found.parents))
}

/// Returns coordinates with near points made equal, row by row, and how many were moved.
#[pyfunction]
pub fn merge_points(
    py: Python<'_>,
    points: PyReadonlyArray2<'_, f64>,
    ratio: f64,
) -> PyResult<(Vec<f64>, usize)> {
    let dim = points.as_array().ncols();
    let mut coordinates: Vec<f64> = points.as_array().iter().copied().collect();
    let moved = in_default_environment(|| netmesh::merge_points(dim, &mut coordinates, ratio))
        .map_err(|error| exception_with(py, &error, &[]))?;
    Ok((coordinates, moved))
}

/// Kind of a feature, and its number.
type Named = (&'static str, u32);

/// Kind of an intersection, both features, and a point.
type Told = (&'static str, Named, Named, [f64; 3]);

/// Returns the kind, both features and a point of each intersection.
#[pyfunction]
pub fn intersections(
    py: Python<'_>,
    points: PyReadonlyArray2<'_, f64>,
    boundary: Boundary<'_>,
) -> PyResult<Vec<Told>> {
    let mut mesh = mesh_of(py, &points)?;
    set_boundary(py, &mut mesh, &boundary)?;
    let found = abandonable(py, move || mesh.intersections())?;
    let feature = |feature| match feature {
        Feature::Facet(number) => ("facet", number),
        Feature::Segment(number) => ("segment", number),
    };
    let kind = |kind| match kind {
        IntersectionKind::Cross => "cross",
        IntersectionKind::Touch => "touch",
        IntersectionKind::Overlap => "overlap",
        IntersectionKind::ZeroArea => "zero_area",
    };
    let one = |one: &netmesh::Intersection| {
        (kind(one.kind), feature(one.first), feature(one.second), one.point)
    };
    Ok(found.iter().map(one).collect())
}

/// Fault of an edge, the inputs at its ends, and the number of facets that have it.
type ToldEdge = (&'static str, (u32, u32), u32);

/// Returns the fault, the ends and the number of facets of each edge that is not between two.
#[pyfunction]
pub fn odd_edges(
    py: Python<'_>,
    points: PyReadonlyArray2<'_, f64>,
    boundary: Boundary<'_>,
) -> PyResult<Vec<ToldEdge>> {
    let mut mesh = mesh_of(py, &points)?;
    set_boundary(py, &mut mesh, &boundary)?;
    let found = abandonable(py, move || mesh.odd_edges())?;
    let fault = |fault| match fault {
        EdgeFault::Open => "open",
        EdgeFault::Crowded => "crowded",
        EdgeFault::Turned => "turned",
    };
    Ok(found.iter().map(|edge| (fault(edge.fault), edge.inputs.into(), edge.facets)).collect())
}
