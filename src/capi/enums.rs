//! The enums of the boundary. C passes any 32 bits: a parameter or field that C fills is a
//! `MaybeUninit` of its enum (cbindgen writes the enum itself) and goes through [`super::decode`].

use crate::arrays::Placement;
use crate::error::ErrorKind;
use crate::mesh::VertexKind;
use crate::options::Phase;
use crate::topology::FaceClass;

/// What every fallible function answers. Values are fixed; later versions only append. Whatever is
/// not NM_OK also sets the calling thread's message (nm_last_error), and leaves the mesh and all
/// buffers as they were unless the function's description says otherwise.
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

/// nm_options.output: what nm_run leaves behind.
#[allow(non_camel_case_types)]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum nm_output {
    /// NM_OUTPUT_WELL_SPACED where something is asked for that a cage would break: min_angle,
    /// min_dihedral, a size (max_edge, size, nm_mesh_set_sizes, nm_mesh_set_background, the
    /// max_edge of a region), distance_ratio, or an extent other than NM_EXTENT_ALL, also one that
    /// NM_EXTENT_AUTO has become. Otherwise NM_OUTPUT_HIERARCHICAL.
    NM_OUTPUT_AUTO = 0,
    /// A hierarchical mesh of O(n) vertices whatever the spread of the input (the paper's NETMESH):
    /// a tree of balls (domains), each surrounded by a cage, with quality inside each.
    NM_OUTPUT_HIERARCHICAL = 1,
    /// A well-spaced mesh of a single domain of optimal size O(m) (the paper's FINISHMESH). m is at
    /// most n times the logarithm of the spread.
    NM_OUTPUT_WELL_SPACED = 2,
}

/// nm_options.algorithm: how nm_run works.
#[allow(non_camel_case_types)]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum nm_algorithm {
    /// NETMESH: O(n log n) (plus the output for NM_OUTPUT_WELL_SPACED), whatever the spread.
    NM_ALGORITHM_NETMESH = 0,
    /// Sparse Voronoi Refinement: no cages, a well-spaced mesh of one domain whatever the output;
    /// O(n log spread + m). The baseline for comparisons.
    NM_ALGORITHM_SVR = 1,
    /// The plain Delaunay triangulation of the input, without Steiner points and without a bound on
    /// quality. Its size may be of order n^ceil(dim/2). Points in a lower-dimensional affine
    /// subspace answer NM_DEGENERATE_INPUT.
    NM_ALGORITHM_DELAUNAY = 2,
}

/// nm_options.ordering: how the inputs of a round are selected.
#[allow(non_camel_case_types)]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum nm_ordering {
    /// A sample driven by nm_options.seed, whose success is verified: the time bound is expected
    /// time.
    NM_ORDERING_SAMPLED_NET = 0,
    /// A deterministic net: the time bound is worst-case time. No random number is used, so
    /// nm_options.seed has no effect.
    NM_ORDERING_DETERMINISTIC_NET = 1,
}

/// nm_options.criterion: the measure that nm_options.quality_bound bounds.
#[allow(non_camel_case_types)]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum nm_criterion {
    /// The paper's tau: a Voronoi cell's out-radius (distance to its farthest corner) over its
    /// in-radius (half the distance to the nearest neighbour). The stronger measure: it bounds
    /// circumradius over shortest edge by tau/2.
    NM_CRITERION_VORONOI_ASPECT = 0,
    /// A simplex's circumradius over its shortest edge, the measure of TetGen and Triangle. 1.0 in
    /// 2D is a smallest angle of 30 degrees, sqrt(2) one of 20.7.
    NM_CRITERION_RADIUS_EDGE = 1,
}

/// nm_options.gives_way: what gives way where min_dihedral and quality_bound cannot both be had.
#[allow(non_camel_case_types)]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum nm_gives_way {
    /// The dihedral angle: the bound holds, and some simplices stay below the angle.
    NM_GIVES_WAY_ANGLE = 0,
    /// The bound: fewer simplices stay below the angle, and some cells
    /// (NM_CRITERION_VORONOI_ASPECT) or simplices (NM_CRITERION_RADIUS_EDGE) go beyond the bound.
    NM_GIVES_WAY_BOUND = 1,
}

/// nm_progress.phase: where a run stands. Later versions may append phases.
#[allow(non_camel_case_types)]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum nm_phase {
    /// Checks, scaling, the first simplices.
    NM_PHASE_PREPARE = 0,
    /// Inserting the inputs, with the refinement that their order asks for.
    NM_PHASE_INSERT = 1,
    /// Turning the hierarchy into a well-spaced mesh if asked for, and the refinement to the bound.
    NM_PHASE_FINISH = 2,
    /// Building the arrays that the getters read.
    NM_PHASE_EXPORT = 3,
}

impl From<Phase> for nm_phase {
    fn from(phase: Phase) -> Self {
        match phase {
            Phase::Prepare => Self::NM_PHASE_PREPARE,
            Phase::Insert => Self::NM_PHASE_INSERT,
            Phase::Finish => Self::NM_PHASE_FINISH,
            Phase::Export => Self::NM_PHASE_EXPORT,
        }
    }
}

/// Where a vertex comes from: the values of the bytes that nm_mesh_get_vertex_kinds writes.
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

/// The byte of `kind` at the boundary.
pub(super) fn vertex_kind_byte(kind: VertexKind) -> u8 {
    let value = match kind {
        VertexKind::Input => nm_vertex_kind::NM_VERTEX_INPUT,
        VertexKind::Steiner => nm_vertex_kind::NM_VERTEX_STEINER,
        VertexKind::Cage => nm_vertex_kind::NM_VERTEX_CAGE,
    };
    value as u8
}

/// How nm_mesh_interpolate goes on between vertices, and what it does with points outside the hull.
/// All methods reproduce linear functions and are continuous.
#[allow(non_camel_case_types)]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum nm_interpolation {
    /// Linear in each simplex. Outside the hull NaN.
    NM_INTERPOLATION_LINEAR = 0,
    /// By natural neighbours, with Sibson's weights: the volumes that a vertex at the point would
    /// take from the Voronoi cells of its neighbours. Linear on the hull, and next to it where
    /// rounding errors exceed 1e-6 of the weights. Outside the hull NaN. The work for a point grows
    /// with 2^dim.
    NM_INTERPOLATION_SIBSON = 1,
    /// By natural neighbours, with Laplace's (non-Sibsonian) weights: the areas of the facets that
    /// the point's cell would share with its neighbours', over the distances. Linear where Sibson's
    /// are. Outside the hull NaN.
    NM_INTERPOLATION_LAPLACE = 2,
    /// As NM_INTERPOLATION_LINEAR; outside the hull the values of the nearest vertex.
    NM_INTERPOLATION_LINEAR_OR_NEAREST = 16,
    /// As NM_INTERPOLATION_SIBSON; outside the hull the values of the nearest vertex.
    NM_INTERPOLATION_SIBSON_OR_NEAREST = 17,
    /// As NM_INTERPOLATION_LAPLACE; outside the hull the values of the nearest vertex.
    NM_INTERPOLATION_LAPLACE_OR_NEAREST = 18,
}

/// nm_selection.extent: a region, and which simplices are in it. nm_options.extent: how far the
/// result reaches.
#[allow(non_camel_case_types)]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum nm_extent {
    /// In nm_options NM_EXTENT_BOUNDARY where segments enclose something by nm_options.interior,
    /// otherwise NM_EXTENT_ALL; curves that are not closed, where that rule asks for closed ones,
    /// enclose nothing. Elsewhere NM_EXTENT_ALL.
    NM_EXTENT_AUTO = 0,
    /// Everywhere.
    NM_EXTENT_ALL = 1,
    /// The convex hull of the inputs.
    NM_EXTENT_HULL = 2,
    /// The least box that holds the inputs, its sides along the axes.
    NM_EXTENT_BOX = 3,
    /// What segments enclose, without holes: all that cannot be reached from the hull without
    /// crossing one. For nm_options alone; nm_mesh_set_segments comes first.
    NM_EXTENT_BOUNDARY = 4,
}

/// nm_options.crossings: what becomes of segments that cross where no input is.
#[allow(non_camel_case_types)]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum nm_crossings {
    /// The run answers NM_INVALID_ARGUMENT and names two of them.
    NM_CROSSINGS_REFUSE = 0,
    /// The double nearest to their crossing becomes a vertex of both.
    NM_CROSSINGS_SPLIT = 1,
}

/// nm_options.interior: which of the regions that segments separate are inside, with
/// NM_EXTENT_AUTO and NM_EXTENT_BOUNDARY. Seeds (nm_mesh_set_regions) may make holes of them.
#[allow(non_camel_case_types)]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum nm_interior {
    /// NM_INTERIOR_PARITY where the segments are those of a file of polygons (NM_FORMAT_GEOJSON,
    /// NM_FORMAT_WKT) that nm_mesh_create_from_file has read, NM_INTERIOR_SEEDS otherwise.
    NM_INTERIOR_AUTO = 0,
    /// All that cannot be reached from outside without crossing a segment.
    NM_INTERIOR_SEEDS = 1,
    /// Those into which a path from outside crosses an odd number of segments (the even-odd rule):
    /// rings within rings are alternately inside and outside. Every input must be an end of an even
    /// number of segments. Of a file of polygons only the sides of these count, not its lines.
    NM_INTERIOR_PARITY = 2,
    /// Those whose winding number is not 0 (the nonzero rule): the number of segments that a path
    /// from outside crosses from their right to their left, less that from their left to their
    /// right. Every input must be the first end of as many segments as it is the second end.
    /// Of a file of polygons only the sides of these count.
    NM_INTERIOR_WINDING = 3,
}

/// Values of the faces of a mesh, which nm_mesh_filtration writes.
#[allow(non_camel_case_types)]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum nm_filtration {
    /// Alpha values: of each face of a Delaunay triangulation of the inputs alone the squared
    /// radius of its smallest circumscribing ball if no vertex is strictly in that, else the least
    /// value of the faces that have it as a facet. Squared radii, each the double nearest to the
    /// exact one.
    NM_FILTRATION_ALPHA = 0,
    /// Of a mesh with other vertices: when its Voronoi cells come near the inputs. Radii, not
    /// squared.
    NM_FILTRATION_MESH = 1,
}

/// How a face lies in an alpha shape, as the bytes of nm_mesh_get_alpha_shape_classes.
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

/// Where a simplex lies with respect to a region, as the bytes of nm_mesh_get_placements. Exact.
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

/// File formats; docs/formats.md tells what each contains. Point formats (XYZ, CSV, NPY) can be
/// written before a run, the others answer NM_STATE. A format that cannot hold the mesh's dimension
/// answers NM_INVALID_ARGUMENT. VTU and the two JSON formats cannot be read. Of the others the
/// points are read.
#[allow(non_camel_case_types)]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum nm_format {
    /// By the extension of the path: .vtu, .node and .ele, .msh, .mesh, .off, .ply, .xyz (.txt,
    /// .xy, .pts), .csv, .npy, .poly, .geojson, .wkt, .voronoi.json, .domains.json.
    NM_FORMAT_AUTO = 0,
    /// VTK XML unstructured grid (.vtu), for ParaView and VTK, with arrays per point and per cell.
    /// Dimensions 2 and 3.
    NM_FORMAT_VTU = 1,
    /// TetGen and Triangle: points (.node) and simplices (.ele).
    NM_FORMAT_TETGEN_NODE = 2,
    /// Gmsh 4.1 as text (.msh); versions 4.1 and 2 are read, as text. Dimensions 2 and 3.
    NM_FORMAT_GMSH = 3,
    /// Medit as text (.mesh). Dimensions 2 and 3.
    NM_FORMAT_MEDIT = 4,
    /// Object file format (.off), nOFF from dimension 3 on.
    NM_FORMAT_OFF = 5,
    /// Polygon file format (.ply): the triangles of a planar mesh, the boundary of one in dimension
    /// 3.
    NM_FORMAT_PLY = 6,
    /// Points as text, one per line, separated by spaces (.xyz).
    NM_FORMAT_XYZ = 7,
    /// Points as text, one per line, separated by commas (.csv).
    NM_FORMAT_CSV = 8,
    /// Points as a NumPy array of shape points x dim (.npy).
    NM_FORMAT_NPY = 9,
    /// The Voronoi diagram of the vertices as JSON (.voronoi.json).
    NM_FORMAT_VORONOI_JSON = 10,
    /// The hierarchy of domains with their cages as JSON (.domains.json).
    NM_FORMAT_DOMAINS_JSON = 11,
    /// Triangle's points, segments, holes and regions of the plane, read only (.poly); the points
    /// may be in the .node file beside.
    NM_FORMAT_POLY = 12,
    /// GeoJSON (RFC 7946): points, lines and polygons of the plane, read only (.geojson). Lines and
    /// rings are segments; their marker is the number of the feature, from 1. A third coordinate
    /// must be 0.
    NM_FORMAT_GEOJSON = 13,
    /// Well-known text: geometries of the plane, one after another, read only (.wkt). As of
    /// NM_FORMAT_GEOJSON; the marker is the number of the geometry, from 1.
    NM_FORMAT_WKT = 14,
}

/// What nm_mesh_quality_histogram counts.
#[allow(non_camel_case_types)]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum nm_measure {
    /// The angles between any two facets of a simplex, in degrees: 3 angles of a triangle, 6
    /// dihedral angles of a tetrahedron, dim (dim + 1) / 2 of a simplex.
    NM_MEASURE_DIHEDRAL_ANGLE = 0,
    /// Circumradius over shortest edge, one for each simplex.
    NM_MEASURE_RADIUS_EDGE = 1,
    /// The aspect of Voronoi cells off the hull (nm_quality.worst_aspect_anywhere is the largest):
    /// one for each vertex in no cage and for each cage other than the root's, precision-limited
    /// ones included.
    NM_MEASURE_ASPECT = 2,
    /// The smallest of its NM_MEASURE_DIHEDRAL_ANGLE, one for each simplex.
    NM_MEASURE_SMALLEST_ANGLE = 3,
}

/// The byte of a placement at the boundary.
pub(super) fn placement_byte(placement: Placement) -> u8 {
    let value = match placement {
        Placement::Inside => nm_placement::NM_PLACEMENT_INSIDE,
        Placement::Across => nm_placement::NM_PLACEMENT_ACROSS,
        Placement::Outside => nm_placement::NM_PLACEMENT_OUTSIDE,
    };
    value as u8
}

/// The byte of a face's class at the boundary.
pub(super) fn class_byte(class: FaceClass) -> u8 {
    let value = match class {
        FaceClass::Exterior => nm_face_class::NM_FACE_CLASS_EXTERIOR,
        FaceClass::Singular => nm_face_class::NM_FACE_CLASS_SINGULAR,
        FaceClass::Regular => nm_face_class::NM_FACE_CLASS_REGULAR,
        FaceClass::Interior => nm_face_class::NM_FACE_CLASS_INTERIOR,
    };
    value as u8
}
