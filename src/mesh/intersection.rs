//! Places where facets and segments in space meet though they must not.

/// Facet or segment of the caller's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Feature {
    /// Facet, or triangle of a surface, by its number.
    Facet(u32),
    /// Segment, by its number.
    Segment(u32),
}

/// Manner in which two facets or segments meet. Facets may meet only in vertices and edges that
/// both have, by the number of the distinct input.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(i32)]
pub enum IntersectionKind {
    /// They go through each other: a point is in the interior of both.
    Cross = 0,
    /// They meet only where one of them ends, at a corner or along an edge.
    Touch = 1,
    /// They share a piece of positive length of their edges, or a piece of positive area.
    Overlap = 2,
    /// The facet has no area. Both features are this facet.
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

/// Two facets or segments that meet though they must not, or one facet that is at fault itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intersection {
    /// Feature that comes first: facets come before segments, both in the caller's order.
    pub first: Feature,
    /// Other feature; the same one for a facet that meets itself or has no area.
    pub second: Feature,
    pub kind: IntersectionKind,
    /// Point where they meet, but for roundings.
    pub point: [f64; 3],
}
