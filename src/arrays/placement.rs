//! Types that say how simplices and vertices lie with respect to a convex body, such as the
//! bounding box of the inputs.

/// Exact position of a simplex with respect to a closed convex body. No simplex is inside a body
/// that lies in a hyperplane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Placement {
    /// The simplex is contained in the body.
    Inside = 0,
    /// The interior of the simplex meets the body, but part of the simplex is outside.
    Across = 1,
    /// The interior of the simplex does not meet the body.
    Outside = 2,
}

/// Position of a vertex with respect to a closed convex body.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Spot {
    Outside,
    /// The vertex is in the body, perhaps on its boundary.
    Contained,
    /// The vertex is on the boundary of a hull, at this vertex of the hull's triangulation.
    Corner(u32),
    Interior,
}
