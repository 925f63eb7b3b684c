//! The words for facets that are refused.

use super::plane::OffPlane;
use crate::error::{Choice, Error, Message, Name, say};
use crate::mesh::{Facets, Feature, Inputs, Intersection, IntersectionKind};
use crate::options::{Crossings, Extent};

/// Returns the error that a facet is not plane.
pub(super) fn not_plane(inputs: &Inputs, facet: u32, off: &OffPlane) -> Error {
    let (input, distance) = (inputs.first_input(off.vertex as usize).unwrap_or(0), off.distance);
    Error::invalid(say!(
        "facets[{facet}] is not plane: its input {input} is {distance} from the plane of others; \
         split it into triangles, or allow more by ",
        Name::Coplanar
    ))
}

/// Returns the error that facets are split at crossings, which a hull is not led through.
pub(super) fn no_hull_of_crossings() -> Error {
    Error::invalid(say!(
        Choice::Extent(Extent::Hull),
        " does not go with facets that are split at their crossings, but with ",
        Choice::Extent(Extent::Box)
    ))
}

/// Returns the error that facets or segments meet though they must not: because they are not split,
/// or because doubles have no room for their crossings.
pub(super) fn refused(
    facets: &Facets,
    first: &Intersection,
    count: usize,
    crossings: Crossings,
) -> Error {
    let mut message = Message::default();
    add_feature(&mut message, facets, first.first);
    let verb = match first.kind {
        IntersectionKind::Cross => "cross",
        IntersectionKind::Touch => "touch",
        IntersectionKind::Overlap => "overlap",
        IntersectionKind::ZeroArea => "has no area",
    };
    match (first.kind, first.first == first.second) {
        (IntersectionKind::ZeroArea, _) => message.add_text(format_args!(" {verb}")),
        (IntersectionKind::Overlap, true) => message.add_text(format_args!(" {verb}s itself")),
        (_, true) => message.add_text(format_args!(" {verb}es itself")),
        (_, false) => {
            message.add_text(format_args!(" and "));
            add_feature(&mut message, facets, first.second);
            message.add_text(format_args!(" {verb}"));
        }
    }
    let [x, y, z] = first.point;
    let rule = match first.kind {
        IntersectionKind::ZeroArea => "a facet must have one",
        _ => "facets and segments may meet only in vertices and edges of both",
    };
    message.add_text(format_args!(" near ({x:?}, {y:?}, {z:?}); {rule}"));
    if count > 1 {
        message.add_text(format_args!("; {count} intersections in all"));
    }
    let has_no_area = first.kind == IntersectionKind::ZeroArea;
    let is_split = first.first != first.second;
    match crossings {
        Crossings::Refuse if has_no_area => {
            message.add_text(format_args!("; with "));
            message.add_name(Choice::Crossings(Crossings::Split).into());
            message.add_text(format_args!(" facets without an area are left out"));
        }
        Crossings::Refuse if is_split => {
            message.add_text(format_args!("; with "));
            message.add_name(Choice::Crossings(Crossings::Split).into());
            message.add_text(format_args!(" they are split there"));
        }
        Crossings::Split if is_split => message.add_text(format_args!(
            "; some still meet after they were split: doubles have no room there"
        )),
        _ => {}
    }
    Error::invalid(message)
}

/// Appends the caller's name of a feature.
fn add_feature(message: &mut Message, facets: &Facets, feature: Feature) {
    match feature {
        Feature::Facet(at) if facets.are_triangles => message.add_name(Name::Triangle(at as usize)),
        Feature::Facet(at) => message.add_text(format_args!("facets[{at}]")),
        Feature::Segment(at) => message.add_text(format_args!("segments[{at}]")),
    }
}
