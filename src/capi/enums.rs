//! Enums that only C has. Those of the core, such as the options' and the certificate's, are in the
//! header under the names that `cbindgen.toml` gives them. C passes any 32 bits: a parameter or
//! field that C fills is a `MaybeUninit` of its enum (cbindgen writes the enum itself) and goes
//! through [`super::decode`].

use crate::arrays::Placement;
use crate::error::ErrorKind;
use crate::mesh::VertexKind;
use crate::topology::FaceClass;

/// Status that every fallible function answers. Values are fixed; later versions only append.
/// Whatever is not NM_OK also sets the calling thread's message (nm_last_error), and leaves the
/// mesh and all buffers as they were unless the function's description says otherwise.
/// cbindgen:rename-all=none
#[allow(non_camel_case_types)]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum nm_status {
    /// Success.
    NM_OK = 0,
    /// A pointer that must not be NULL is NULL; the message names the argument.
    NM_NULL_ARGUMENT = 1,
    /// A value is out of its range; the message names the argument or field, the value and the
    /// range.
    NM_INVALID_ARGUMENT = 2,
    /// A coordinate is infinite or NaN; the message names the point and the coordinate.
    NM_NON_FINITE = 3,
    /// The dimension is not in NM_MIN_DIM..NM_MAX_DIM.
    NM_DIMENSION = 4,
    /// A buffer is too small (*needed has the size), or there are more points than 32-bit ids.
    NM_CAPACITY = 5,
    /// Fewer than two distinct points, or (NM_ALGORITHM_DELAUNAY) all points in a lower-dimensional
    /// affine subspace; the message names the rank.
    NM_DEGENERATE_INPUT = 6,
    /// The run needs more vertices than nm_options.max_vertices allows, or coordinates are so large
    /// that the root's cage leaves the range of double: above 3e306 with the default options.
    NM_LIMIT = 7,
    /// The progress callback cancelled the run.
    NM_CANCELLED = 8,
    /// Reading or writing failed, or the write callback stopped the export.
    NM_IO = 9,
    /// A file is not in its format; the message names the place.
    NM_FORMAT_ERROR = 10,
    /// The mesh is in no state for the call: it has no result yet, another call is changing it, or
    /// an earlier NM_PANIC poisoned it.
    NM_STATE = 11,
    /// An allocation failed.
    NM_OUT_OF_MEMORY = 12,
    /// A defect of the library: an internal check failed and was caught. The handle answers
    /// NM_STATE from then on and can only be freed.
    NM_PANIC = 13,
}

impl From<ErrorKind> for nm_status {
    fn from(kind: ErrorKind) -> Self {
        match kind {
            ErrorKind::NullArgument => Self::NM_NULL_ARGUMENT,
            ErrorKind::InvalidArgument => Self::NM_INVALID_ARGUMENT,
            ErrorKind::NonFinite => Self::NM_NON_FINITE,
            ErrorKind::Dimension => Self::NM_DIMENSION,
            ErrorKind::Capacity => Self::NM_CAPACITY,
            ErrorKind::DegenerateInput => Self::NM_DEGENERATE_INPUT,
            ErrorKind::Limit => Self::NM_LIMIT,
            ErrorKind::Cancelled => Self::NM_CANCELLED,
            ErrorKind::Io => Self::NM_IO,
            ErrorKind::Format => Self::NM_FORMAT_ERROR,
            ErrorKind::State => Self::NM_STATE,
            ErrorKind::OutOfMemory => Self::NM_OUT_OF_MEMORY,
            ErrorKind::Panic => Self::NM_PANIC,
        }
    }
}

/// Origin of a vertex: the values of the bytes that nm_mesh_get_vertex_kinds writes.
/// cbindgen:rename-all=none
#[allow(non_camel_case_types)]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum nm_vertex_kind {
    /// An input, with the caller's coordinates bit for bit.
    NM_VERTEX_INPUT = 0,
    /// A vertex added for quality.
    NM_VERTEX_STEINER = 1,
    /// A vertex of the cage around a domain.
    NM_VERTEX_CAGE = 2,
}

/// Returns the byte of `kind` at the boundary.
pub(super) fn vertex_kind_byte(kind: VertexKind) -> u8 {
    let value = match kind {
        VertexKind::Input => nm_vertex_kind::NM_VERTEX_INPUT,
        VertexKind::Steiner => nm_vertex_kind::NM_VERTEX_STEINER,
        VertexKind::Cage => nm_vertex_kind::NM_VERTEX_CAGE,
    };
    value as u8
}

/// Method by which nm_mesh_interpolate goes on between vertices, and its answer for points outside
/// the hull. All methods reproduce linear functions and are continuous.
/// cbindgen:rename-all=none
#[allow(non_camel_case_types)]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum nm_interpolation {
    /// Linear in each simplex. Outside the hull NaN.
    NM_INTERPOLATION_LINEAR = 0,
    /// Natural neighbours, with Sibson's weights: the volumes that a vertex at the point would
    /// take from the Voronoi cells of its neighbours. Linear on the hull, and next to it where
    /// rounding errors exceed 1e-6 of the weights. Outside the hull NaN. The work for a point grows
    /// with 2^dim.
    NM_INTERPOLATION_SIBSON = 1,
    /// Natural neighbours, with Laplace's (non-Sibsonian) weights: the areas of the facets that
    /// the point's cell would share with its neighbours', over the distances. Linear where Sibson's
    /// are. Outside the hull NaN.
    NM_INTERPOLATION_LAPLACE = 2,
    /// Linear in each simplex; outside the hull the values of the nearest vertex.
    NM_INTERPOLATION_LINEAR_OR_NEAREST = 16,
    /// NM_INTERPOLATION_SIBSON inside the hull; outside the hull the values of the nearest vertex.
    NM_INTERPOLATION_SIBSON_OR_NEAREST = 17,
    /// NM_INTERPOLATION_LAPLACE inside the hull; outside the hull the values of the nearest vertex.
    NM_INTERPOLATION_LAPLACE_OR_NEAREST = 18,
}

/// Surfaces that nm_mesh_surface and its like find through the inputs.
/// cbindgen:rename-all=none
#[allow(non_camel_case_types)]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum nm_surface_kind {
    /// Closed surfaces (in 2D closed curves), the boundary of what is inside.
    NM_SURFACE_CLOSED = 0,
    /// Surfaces (in 2D curves) that may end, or have one side alone.
    NM_SURFACE_OPEN = 1,
}

/// Values of the faces of a mesh, which nm_mesh_filtration writes.
/// cbindgen:rename-all=none
#[allow(non_camel_case_types)]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum nm_filtration {
    /// Alpha values: of each face of a Delaunay triangulation of the inputs alone the squared
    /// radius of its smallest circumscribing ball if no vertex is strictly in that, else the least
    /// value of the faces that have it as a facet. Squared radii, each the double nearest to the
    /// exact one.
    NM_FILTRATION_ALPHA = 0,
    /// Distances at which the Voronoi cells of a mesh with other vertices come near the inputs.
    /// Radii, not squared.
    NM_FILTRATION_MESH = 1,
}

/// Class of a face in an alpha shape: the values of the bytes of nm_mesh_get_alpha_shape_classes.
/// cbindgen:rename-all=none
#[allow(non_camel_case_types)]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum nm_face_class {
    /// Not in the shape.
    NM_FACE_CLASS_EXTERIOR = 0,
    /// In the shape, and in no larger face of it.
    NM_FACE_CLASS_SINGULAR = 1,
    /// On the boundary of the shape, and in a larger face of it.
    NM_FACE_CLASS_REGULAR = 2,
    /// In the interior of the shape: all simplices round it are in the shape.
    NM_FACE_CLASS_INTERIOR = 3,
}

/// Place of a simplex with respect to a region: the values of the bytes of nm_mesh_get_placements.
/// Exact.
/// cbindgen:rename-all=none
#[allow(non_camel_case_types)]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum nm_placement {
    /// All of it is in the region, whose boundary is part of it. No simplex is inside a region that
    /// lies in a hyperplane.
    NM_PLACEMENT_INSIDE = 0,
    /// Its interior meets the region, and some of it is outside.
    NM_PLACEMENT_ACROSS = 1,
    /// Its interior does not meet the region.
    NM_PLACEMENT_OUTSIDE = 2,
}

/// Kind of a feature that a mesh in space is given.
/// cbindgen:rename-all=none
#[allow(non_camel_case_types)]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum nm_feature {
    /// A facet of nm_mesh_set_facets, or a triangle of nm_mesh_set_triangles.
    NM_FEATURE_FACET = 0,
    /// A segment of nm_mesh_set_segments.
    NM_FEATURE_SEGMENT = 1,
}

/// Kind of an intersection of nm_mesh_get_intersections; of several places where two features meet
/// it is that of one.
/// cbindgen:rename-all=none
#[allow(non_camel_case_types)]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum nm_intersection_kind {
    /// The interior of one of the two goes through the other.
    NM_INTERSECTION_CROSS = 0,
    /// They meet on the boundary of one of them, and neither goes through the other.
    NM_INTERSECTION_TOUCH = 1,
    /// They share an area or a length: coplanar facets that overlap, collinear segments and edges,
    /// duplicates.
    NM_INTERSECTION_OVERLAP = 2,
    /// The facet, or a triangle of it, has no area; both features are that facet.
    NM_INTERSECTION_ZERO_AREA = 3,
}

/// Fault of an edge of nm_mesh_get_odd_edges.
/// cbindgen:rename-all=none
#[allow(non_camel_case_types)]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum nm_edge_fault {
    /// One facet ends there: the surface has a hole.
    NM_EDGE_OPEN = 0,
    /// Three or more facets meet there.
    NM_EDGE_CROWDED = 1,
    /// Two facets run through it in one direction: their normals point to different sides.
    NM_EDGE_TURNED = 2,
}

/// Returns the byte of a placement at the boundary.
pub(super) fn placement_byte(placement: Placement) -> u8 {
    let value = match placement {
        Placement::Inside => nm_placement::NM_PLACEMENT_INSIDE,
        Placement::Across => nm_placement::NM_PLACEMENT_ACROSS,
        Placement::Outside => nm_placement::NM_PLACEMENT_OUTSIDE,
    };
    value as u8
}

/// Returns the byte of a face's class at the boundary.
pub(super) fn class_byte(class: FaceClass) -> u8 {
    let value = match class {
        FaceClass::Exterior => nm_face_class::NM_FACE_CLASS_EXTERIOR,
        FaceClass::Singular => nm_face_class::NM_FACE_CLASS_SINGULAR,
        FaceClass::Regular => nm_face_class::NM_FACE_CLASS_REGULAR,
        FaceClass::Interior => nm_face_class::NM_FACE_CLASS_INTERIOR,
    };
    value as u8
}
