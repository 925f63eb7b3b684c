//! Intersections: pairs of facets and segments in space that meet in more than they share.

/// Facet or segment of the caller's. Facets come before segments in the order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Feature {
    /// Facet, by its number in [`super::Facets`].
    Facet(u32),
    /// Segment, by its number in [`super::Segments`].
    Segment(u32),
}

/// Kind of an intersection, with the numbers of C.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(i32)]
pub enum IntersectionKind {
    /// The interior of one goes through the other.
    Cross = 0,
    /// They meet at a point or along a line that is on the boundary of one of them, and neither
    /// goes through the other.
    Touch = 1,
    /// They share an area or, of two that meet along a line, a length without sharing it as an
    /// edge: coplanar facets that overlap, collinear segments, duplicates.
    Overlap = 2,
    /// The facet, or a triangle of it, has no area. Both features are the facet.
    ZeroArea = 3,
}

impl IntersectionKind {
    /// Returns a number that is larger for a kind that is told before others, where two features
    /// meet in several ways.
    pub(crate) fn rank(self) -> u8 {
        match self {
            Self::Touch => 0,
            Self::Cross => 1,
            Self::Overlap => 2,
            Self::ZeroArea => 3,
        }
    }
}

/// Pair of features that meet where they share neither a vertex nor an edge, or a facet that meets
/// itself; of several such places of one pair the first that was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intersection {
    /// The lesser of the two features.
    pub first: Feature,
    /// The greater of the two features; equal to the first where a facet meets itself.
    pub second: Feature,
    /// Kind of the intersection.
    pub kind: IntersectionKind,
    /// Point of the intersection, rounded to doubles.
    pub point: [f64; 3],
}
