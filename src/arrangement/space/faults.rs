//! The words for facets that are refused.

use super::plane::OffPlane;
use crate::error::{Choice, Error, Message, Name, say};
use crate::mesh::{Facets, Feature, Inputs, Intersection, IntersectionKind};
use crate::options::{Crossings, Extent};

/// Returns the error that a facet is not plane.
pub(super) fn not_plane(inputs: &Inputs, facet: u32, off: &OffPlane) -> Error {
    let (input, distance) = (inputs.first_input(off.vertex as usize).unwrap_or(0), off.distance);
    Error::invalid(say!(
        Name::Facet(facet as usize),
        " is not plane: its input ",
        Name::Input(input as usize),
        " is {distance} from the plane of others; split it into triangles, or allow more by ",
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

/// Returns the error that a polygon has no triangles that have its segments.
pub(super) fn has_segments(facet: u32) -> Error {
    let rule = "has segments within, which triangles would not keep";
    Error::invalid(Message::about(Name::Facet(facet as usize), format_args!(" {rule}")))
}

/// Returns the error that a polygon that is not plane meets itself in each projection in which it
/// could become triangles, the first of which shows the place.
pub(super) fn meets_itself_from_everywhere(facets: &Facets, first: &Intersection) -> Error {
    let mut message = Message::default();
    add_feature(&mut message, facets, first.first);
    let ([x, y, z], verb) = (first.point, verb(first.kind));
    message.add_text(format_args!(
        " is not plane, and {verb} itself seen along each axis, along the first near ({x:?}, \
         {y:?}, {z:?}); a polygon must be seen as a whole along one to become triangles"
    ));
    Error::invalid(message)
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
    match (first.kind, first.first == first.second) {
        (IntersectionKind::ZeroArea, _) => message.add_text(format_args!(" has no area")),
        (kind, true) => message.add_text(format_args!(" {} itself", verb(kind))),
        (kind, false) => {
            message.add_text(format_args!(" and "));
            add_feature(&mut message, facets, first.second);
            let both = match kind {
                IntersectionKind::Overlap => "overlap",
                IntersectionKind::Touch => "touch",
                _ => "cross",
            };
            message.add_text(format_args!(" {both}"));
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

/// Returns the verb for one that meets others.
fn verb(kind: IntersectionKind) -> &'static str {
    match kind {
        IntersectionKind::Cross => "crosses",
        IntersectionKind::Touch => "touches",
        IntersectionKind::Overlap => "overlaps",
        IntersectionKind::ZeroArea => "has no area in",
    }
}

/// Appends the caller's name of a feature.
fn add_feature(message: &mut Message, facets: &Facets, feature: Feature) {
    match feature {
        Feature::Facet(at) if facets.are_triangles => message.add_name(Name::Triangle(at as usize)),
        Feature::Facet(at) => message.add_name(Name::Facet(at as usize)),
        Feature::Segment(at) => message.add_name(Name::Segment(at as usize)),
    }
}
