//! The words for facets that are refused.

use super::plane::OffPlane;
use crate::error::{Error, ErrorKind, message};
use crate::mesh::{Facets, Feature, Inputs, Intersection, IntersectionKind};

/// Returns the error that a facet is not plane.
pub(super) fn not_plane(inputs: &Inputs, facet: u32, off: &OffPlane) -> Error {
    let input = inputs.first_input(off.vertex as usize).unwrap_or(0);
    let message = message!(
        "facets[{facet}] is not plane: its input {input} is {} from the plane of others; split it \
         into triangles, or allow more by options.coplanar",
        off.distance
    );
    Error::new(ErrorKind::InvalidArgument, message)
}

/// Returns the error that facets or segments meet though they must not.
pub(super) fn refused(facets: &Facets, first: &Intersection, count: usize) -> Error {
    let name = |feature: Feature| match feature {
        Feature::Facet(number) if facets.are_triangles => ("triangles", number),
        Feature::Facet(number) => ("facets", number),
        Feature::Segment(number) => ("segments", number),
    };
    let ((one, i), (other, j)) = (name(first.first), name(first.second));
    let [x, y, z] = first.point;
    let is_alone = first.first == first.second;
    let rule = "facets and segments may meet only in vertices and edges of both";
    let verb = match first.kind {
        IntersectionKind::Cross => "cross",
        IntersectionKind::Touch => "touch",
        IntersectionKind::Overlap => "overlap",
        IntersectionKind::ZeroArea => "no area",
    };
    let fault = match (first.kind, is_alone) {
        (IntersectionKind::ZeroArea, _) => message!("{one}[{i}] has {verb}"),
        (IntersectionKind::Overlap, true) => message!("{one}[{i}] {verb}s itself"),
        (_, true) => message!("{one}[{i}] {verb}es itself"),
        (_, false) => message!("{one}[{i}] and {other}[{j}] {verb}"),
    };
    let all = if count > 1 { message!("; {count} intersections in all") } else { String::new() };
    let message = message!("{fault} near ({x}, {y}, {z}); {rule}{all}");
    Error::new(ErrorKind::InvalidArgument, message)
}
