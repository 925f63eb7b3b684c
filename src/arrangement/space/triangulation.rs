//! The triangles between their inputs that polygons consist of.

use super::faults::{has_segments, meets_itself_from_everywhere, refused};
use super::pieces::{Pieces, Untiled};
use super::projection::Projection;
use super::{TaskInSpace, as_given, pieces_as_given, points_of};
use crate::arrangement::poll::Poll;
use crate::error::{Error, Result};
use crate::memory::TryGrow;
use crate::mesh::IntersectionKind::ZeroArea;
use crate::mesh::{FacetTriangulation, Facets, Feature, Inputs, Intersection, Segments};
use crate::options::Crossings;

/// Returns the first polygon that is not plane, and bent by more than `coplanar` degrees. O(n log
/// n) for n inputs of the facets.
///
/// # Errors
/// `OutOfMemory`, and those of `poll`.
pub fn bent_polygon(
    inputs: &Inputs,
    facets: &Facets,
    coplanar: f64,
    poll: Poll<'_>,
) -> Result<Option<u32>> {
    let (points, segments) = (points_of(inputs)?, &Segments::default());
    let task = TaskInSpace { coplanar, ..as_given(inputs, facets, segments) };
    Pieces::first_bent(&points, &task, poll)
}

/// Returns the triangles that facets consist of, seen along an axis. A facet without an area is one
/// triangle without one. O(n log n) for n inputs of the facets.
///
/// # Errors
/// `InvalidArgument` (a facet that meets itself or has segments within), `OutOfMemory`, and those
/// of `poll`.
pub fn triangulate(inputs: &Inputs, facets: &Facets, poll: Poll<'_>) -> Result<FacetTriangulation> {
    let points = points_of(inputs)?;
    let pieces = pieces_as_given(&points, inputs, facets, &Segments::default(), poll)?;
    let mut without_area = Vec::new();
    for fault in &pieces.faults {
        match fault.first {
            Feature::Facet(facet) if fault.kind == ZeroArea => without_area.try_push(facet)?,
            _ => return Err(meets_itself(facets, &pieces, fault)),
        }
    }
    let has_segment = |&&facet: &&u32| facets.loops(facet as usize).any(|own| own.len() == 2);
    let lined = without_area.iter().find(has_segment).copied();
    if let Some(facet) = lined.into_iter().chain(pieces.first_lined).min() {
        return Err(has_segments(facet));
    }
    let mut found = FacetTriangulation { without_area: without_area.len(), ..Default::default() };
    let mut without_area = without_area.into_iter().peekable();
    let mut parts =
        pieces.all.iter().filter_map(|own| Some((own.facet()?, own.triangle()?))).peekable();
    for facet in 0..facets.count() as u32 {
        if without_area.next_if_eq(&facet).is_some() {
            found.triangles.try_push(flat_triangle(&points, inputs, facets, facet))?;
            found.parents.try_push(facet)?;
        }
        while let Some((_, triangle)) = parts.next_if(|(parent, _)| *parent == facet) {
            let input = |vertex: u32| inputs.first_input(vertex as usize).unwrap_or(vertex);
            found.triangles.try_push(triangle.map(input))?;
            found.parents.try_push(facet)?;
        }
    }
    Ok(found)
}

/// Returns the error that a facet meets itself, as the first of those that do.
fn meets_itself(facets: &Facets, pieces: &Pieces, fault: &Intersection) -> Error {
    let is_fault = |untiled: &&Untiled| fault.first == Feature::Facet(untiled.facet);
    match pieces.untiled.iter().find(is_fault) {
        Some(untiled) if untiled.is_bent => meets_itself_from_everywhere(facets, fault),
        _ => refused(facets, fault, pieces.untiled.len(), Crossings::Refuse),
    }
}

/// Returns a triangle without an area between inputs of a facet that has none.
fn flat_triangle(points: &[[f64; 3]], inputs: &Inputs, facets: &Facets, facet: u32) -> [u32; 3] {
    let mut loops = facets.loops(facet as usize).filter(|own| own.len() >= 3);
    let Some(&[a, b, c, ..]) = loops.next() else { return [0; 3] };
    let corner = |input: u32| &points[inputs.vertices()[input as usize] as usize];
    match Projection::of_triangle([a, b, c].map(corner)) {
        None => [a, b, c],
        Some(_) => [a, b, b],
    }
}
