//! The structs of the boundary.

use super::memory::Versioned;
use crate::options::{
    Algorithm, Criterion, Crossings, Extent, GivesWay, Interior, Labels, NetOrdering, Output, Phase,
};
use crate::validate::ViolationKind;
use std::ffi::{c_char, c_void};
use std::mem::MaybeUninit;

/// Selection of simplices of a mesh: those that fulfil all conditions. Begin with
/// NM_SELECTION_INIT, which selects all.
#[allow(non_camel_case_types)]
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct nm_selection {
    /// sizeof(nm_selection) of the caller. Fields that a smaller struct lacks select all.
    pub struct_size: u32,
    /// The simplices inside this region (nm_placement); NM_EXTENT_AUTO is NM_EXTENT_ALL.
    pub extent: MaybeUninit<Extent>,
    /// Nonzero: those across the region's boundary, too.
    pub across: u32,
    /// The simplices of this domain and of the domains in it; NM_NONE for all. A simplex is of the
    /// innermost domain that holds all its vertices.
    pub domain: u32,
}

// SAFETY: repr(C), begins with a u32, no padding (checked below), and the enum and all numbers take
// any bits.
unsafe impl Versioned for nm_selection {
    const TYPE: &'static str = "nm_selection";

    fn ends_inside_field(size: usize) -> bool {
        size % size_of::<u32>() != 0
    }
}

const _: () = assert!(size_of::<nm_selection>() == 4 * 4);

/// Progress that nm_run reports while it works. The library fills it; it is valid during the
/// callback only.
#[allow(non_camel_case_types)]
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct nm_progress {
    /// sizeof(nm_progress) of the running library: read no field beyond it.
    pub struct_size: u32,
    /// The stage of the run; never falls.
    pub phase: Phase,
    /// The fraction of the run that is done. In [0, 1] and never falling; -1 if unknown.
    pub fraction: f64,
    /// Distinct inputs that are vertices by now.
    pub inputs_inserted: u64,
    /// Vertices by now, inputs included.
    pub vertices: u64,
    /// Simplices by now.
    pub simplices: u64,
}

/// Called by nm_run on the thread that called nm_run, about every 30 ms and where a round or a
/// stage ends. progress: valid during the call. user_data: nm_options.user_data. Nonzero cancels
/// the run, which then answers NM_CANCELLED and leaves the mesh as it was.
///
/// It must return: no exception, longjmp or thread exit may leave it. Any call on the mesh that is
/// being run answers NM_STATE; other meshes may be used, and this one must not be freed.
#[allow(non_camel_case_types)]
pub type nm_progress_fn =
    Option<unsafe extern "C" fn(progress: *const nm_progress, user_data: *mut c_void) -> i32>;

/// The size that is asked for at a point: the length of an edge, above 0, infinite where there is
/// no bound. x: dim doubles, valid during the call, in the box of the inputs (between the least
/// and the largest of their coordinates on each axis). user_data: nm_options.size_user_data.
/// Called on the thread that called nm_run, at most once a vertex, with nm_options.min_dihedral
/// also at places that are tried for vertices, in an order that depends on the inputs and the
/// options alone. Any other answer, NaN too, ends the run with NM_INVALID_ARGUMENT and a message
/// that has the point and the answer. During a call any use of the mesh being run answers
/// NM_STATE; other meshes may be used, and this one must not be freed.
#[allow(non_camel_case_types)]
pub type nm_size_fn = Option<unsafe extern "C" fn(x: *const f64, user_data: *mut c_void) -> f64>;

/// Options of a run. Begin with NM_OPTIONS_INIT or nm_options_init, then change what you need. The
/// fields stand in groups: quality, domain, sizes, algorithm, run, constants of the paper.
///
/// For each double and for max_vertices, 0 is the default for the dimension; anything else outside
/// the field's range, NaN included, answers NM_INVALID_ARGUMENT. "2D, 3D, 4D, more" are the values
/// by dimension.
#[allow(non_camel_case_types)]
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct nm_options {
    /// sizeof(nm_options) of the caller, set by NM_OPTIONS_INIT and nm_options_init. Fields that a
    /// smaller struct lacks have their defaults; a larger struct is accepted if what this version
    /// does not know is zero.
    pub struct_size: u32,
    /// Quality: the measure that quality_bound bounds. Default NM_CRITERION_VORONOI_ASPECT.
    pub criterion: MaybeUninit<Criterion>,
    /// Largest value of the criterion, smaller is better and costs more vertices; a ratio without
    /// unit. NM_CRITERION_VORONOI_ASPECT: default 3, 4, 5, 6 in 2D, 3D, 4D, more; in [2.2, 100],
    /// [2.5, 100], [3.5, 100], [4.5, 100]. NM_CRITERION_RADIUS_EDGE: default 1.5, 2, 2.5, 3; in
    /// [0.9, 50], [1.1, 50], [1.75, 50], [2.25, 50]. Below 1 in 2D and 1.25 in 3D the run usually
    /// ends; set max_vertices, too.
    pub quality_bound: f64,
    /// Smallest angle of the triangles, in degrees (Triangle's -q), in 2D only and in place of
    /// criterion and quality_bound. The radius-edge ratio is bounded by 1 / (2 sin(min_angle)).
    /// With quality_bound not 0, or in 3D and up, NM_INVALID_ARGUMENT. In [0.6, 33.7], default 0
    /// (criterion and quality_bound count). Above 30 degrees the run usually ends, set
    /// max_vertices, too; a few cells at the root's cage may then be given up (precision-limited).
    /// With NM_OUTPUT_HIERARCHICAL it holds for the triangles with all vertices in one domain, and
    /// nm_quality.below_min_angle counts the others.
    pub min_angle: f64,
    /// Least dihedral angle, in degrees, of tetrahedra with all vertices in one domain: Steiner
    /// points move and further ones come until none is smaller. Where quality_bound cannot be had
    /// too, gives_way says which of them holds; nm_quality.below_min_dihedral and beyond_bound
    /// count what is left. In 3D only, without distance_ratio, and without effect with
    /// NM_ALGORITHM_DELAUNAY. In [0, 22], default 0: none.
    pub min_dihedral: f64,
    /// Promise that gives way where min_dihedral and quality_bound cannot both be kept; without
    /// effect where min_dihedral is 0. Default NM_GIVES_WAY_ANGLE.
    pub gives_way: MaybeUninit<GivesWay>,
    /// Domain: the region that the result covers. What lies beyond is cut away, and the boundary is
    /// made of edges in 2D, and of triangles in 3D. Above 3D NM_EXTENT_AUTO or NM_EXTENT_ALL.
    /// Default NM_EXTENT_AUTO.
    pub extent: MaybeUninit<Extent>,
    /// Rule by which regions between segments, in 3D between facets, are inside, with
    /// NM_EXTENT_BOUNDARY and, where there are segments or facets, NM_EXTENT_AUTO; otherwise it
    /// must be neither NM_INTERIOR_PARITY nor NM_INTERIOR_WINDING. Seeds (nm_mesh_set_regions) may
    /// make holes of these regions. Default NM_INTERIOR_AUTO.
    pub interior: MaybeUninit<Interior>,
    /// Treatment of segments, in 3D of facets too, that cross where no input is. Default
    /// NM_CROSSINGS_REFUSE.
    pub crossings: MaybeUninit<Crossings>,
    /// Angle from flat, in degrees, up to which triangles of nm_mesh_set_triangles that share an
    /// edge and have one marker are one facet, and up to which the vertices of a facet may be off
    /// its plane. The more, the fewer edges of a surface with nearly flat ones must be edges of the
    /// mesh, and the fewer vertices it has. In 3D only. In [0, 10], default 0: exactly flat, or as
    /// far from it as roundings of the coordinates explain.
    pub coplanar: f64,
    /// Labels of the regions that segments, in 3D facets, separate (nm_mesh_get_simplex_regions).
    /// Default NM_LABELS_SEEDS.
    pub labels: MaybeUninit<Labels>,
    /// Zero.
    pub reserved_domain: u32,
    /// Sizes: the length that no edge exceeds of simplices that meet the box of the inputs (the
    /// least and largest of their coordinates on each axis); their circumradius is at most that of
    /// the regular simplex with such edges. Outside the box simplices grow as fast as quality_bound
    /// allows. For NM_ALGORITHM_NETMESH, not with NM_OUTPUT_HIERARCHICAL. Above 0, default 0: none.
    pub max_edge: f64,
    /// Largest distance of the middle of an edge from the round surface that facets approximate, in
    /// 3D: edges are chords of it. Facets that bend by at most 50 degrees have the radius R of a
    /// cylinder of facets that are as wide and bend as much; there the size is the length of the
    /// chord, the root of 4 * size_from_curvature * (2 * R - size_from_curvature), or twice
    /// size_from_curvature where R is less. From there sizes grow by half of the distance. Facets
    /// stay as they are: the vertices that come lie on them. On the same conditions as size, with
    /// which both count; needs facets (nm_mesh_set_facets, nm_mesh_set_triangles, or the extents
    /// hull and box). Above 0, default 0: none.
    pub size_from_curvature: f64,
    /// Largest reach of the cell of a vertex, relative to the distance from the vertex to the
    /// nearest input, unless that input is the nearest one everywhere in the cell; for filtrations
    /// (NM_FILTRATION_MESH, docs/topology.md), whose factor becomes at most the root of (1 +
    /// distance_ratio) / (1 - distance_ratio). For NM_ALGORITHM_NETMESH, not with
    /// NM_OUTPUT_HIERARCHICAL; root_scale then has the default 12. In [0.05, 1], default 0: cells
    /// may reach any distance.
    pub distance_ratio: f64,
    /// Function that tells the size at each point, on the same conditions as max_edge: no simplex
    /// that meets the box of the inputs has a larger circumradius than the regular simplex whose
    /// edges have the least of the sizes at its vertices (for a vertex outside the box: at the
    /// nearest point of it). Most edges have between 0.6 times the size and the size; none is
    /// longer than twice that circumradius, 1.16 times the size in 2D, 1.23 times in 3D, 1.34 times
    /// in 8D. The values of the function between vertices are not seen. With max_edge both count.
    /// nm_mesh_set_sizes and nm_mesh_set_background give sizes by values. Default NULL: none.
    pub size: nm_size_fn,
    /// Pointer that size gets as it is; the library never looks at it. Default NULL.
    pub size_user_data: *mut c_void,
    /// Algorithm: the kind of mesh that the run leaves behind. Default NM_OUTPUT_AUTO.
    pub output: MaybeUninit<Output>,
    /// Algorithm that makes the mesh. Default NM_ALGORITHM_NETMESH.
    pub algorithm: MaybeUninit<Algorithm>,
    /// Run: the number of threads, 0 = all cores. Default 1. The result does not depend on it. Of
    /// use in 2D and 3D with NM_ALGORITHM_NETMESH, from 524,288 distinct inputs on.
    pub threads: u32,
    /// 1: the run measures the fields of nm_stats from ply_probes on as well. That takes about as
    /// long again as the run, in 4D and more several times as long. The mesh is the same. Default
    /// 0.
    pub instruments: u32,
    /// Seed of the sampling; equal inputs, options and seeds give equal meshes. Without effect with
    /// NM_ORDERING_DETERMINISTIC_NET. Any value, default 0.
    pub seed: u64,
    /// Number of vertices, inputs included, beyond which the run answers NM_LIMIT. Default (0): as
    /// many as 32-bit ids allow.
    pub max_vertices: u64,
    /// Function that is called during the run; NULL for none. Default NULL.
    pub progress: nm_progress_fn,
    /// Pointer that progress gets as it is; the library never looks at it. Default NULL.
    pub user_data: *mut c_void,
    /// Constants of the paper: the choice of the inputs that a round inserts. Default
    /// NM_ORDERING_SAMPLED_NET.
    pub ordering: MaybeUninit<NetOrdering>,
    /// Zero.
    pub reserved: u32,
    /// Distance that makes a cluster a domain of its own: a pair at distance x gets one of radius x
    /// / epsilon if its surroundings are empty to encroachment * x / epsilon^2. Smaller makes fewer
    /// domains and more vertices between. In [0.05, 0.6], default 0.5.
    pub epsilon: f64,
    /// Spacing of a cage's vertices relative to the radius of its sphere: smaller makes better
    /// cells at the cage and more vertices. In [0.1, 1], default 0.8, 1, 1, 1 in 2D, 3D, 4D, more.
    pub delta: f64,
    /// Radius within which a new cage vertex yields to an input, as a fraction of its distance to
    /// the nearest vertex. In [0.01, 0.25], default 0.1.
    pub gamma: f64,
    /// Radius within which a Steiner point yields to an input, as a fraction of the radius of its
    /// empty ball. In [0.05, 1], default 1; with NM_ALGORITHM_SVR 0.6 in 2D, 0.9 above.
    pub yield_radius: f64,
    /// Distance from a domain's centre within which no outside vertex may be: encroachment * radius
    /// / epsilon. In [1, 4], default 1.
    pub encroachment: f64,
    /// Radius of the cage's sphere relative to its domain's radius. In [0.3, 0.9], default 0.8.
    pub cage_scale: f64,
    /// Radius of the root ball relative to the input's bounding ball; it is larger where the cage
    /// would not surround the input (a small cage_scale, a large delta), and 2^20 times as large
    /// where facets end a mesh without a bound: its cage is no part of that. In [2, 16], default
    /// 2.5, 2.5, 3, 4 in 2D, 3D, 4D, more.
    pub root_scale: f64,
}

// SAFETY: repr(C), begins with a u32, no padding (checked below), and enums, the function pointer
// (an Option) and all numbers take any bits.
unsafe impl Versioned for nm_options {
    const TYPE: &'static str = "nm_options";

    fn ends_inside_field(size: usize) -> bool {
        // Fields of four bytes stand in pairs.
        size % size_of::<u64>() != 0
    }
}

const _: () = assert!(size_of::<nm_options>() == 14 * 4 + 16 * 8 + 4 * size_of::<usize>());

/// Sizes of a mesh. Before nm_run: the distinct inputs as vertices, no simplices, no domains.
#[allow(non_camel_case_types)]
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct nm_counts {
    /// Set by the caller to sizeof(nm_counts).
    pub struct_size: u32,
    /// The dimension, NM_MIN_DIM..NM_MAX_DIM.
    pub dim: u32,
    /// Points given, duplicates included.
    pub inputs: u64,
    /// Points that equal an earlier one.
    pub duplicates: u64,
    /// Vertices: 0..inputs-duplicates-1 are the distinct inputs in input order, then Steiner and
    /// cage vertices.
    pub vertices: u64,
    /// Simplices (triangles, tetrahedra, ...).
    pub simplices: u64,
    /// Domains of the hierarchy, the root included; 0 for NM_ALGORITHM_DELAUNAY.
    pub domains: u64,
    /// Edges of nm_mesh_get_segments, which segments and, in 3D, the edges of facets have become.
    pub segment_edges: u64,
    /// Triangles of nm_mesh_get_facet_triangles, which facets have become.
    pub facet_triangles: u64,
}

// SAFETY: repr(C), begins with a u32, no padding (checked below), numbers only.
unsafe impl Versioned for nm_counts {
    const TYPE: &'static str = "nm_counts";
}

const _: () = assert!(size_of::<nm_counts>() == 2 * 4 + 7 * 8);

/// Numbers of elements that the file of a mesh or a surface has beside its points, and the nm_mesh
/// that was made of it has not. A mesh is made of the points.
#[allow(non_camel_case_types)]
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct nm_left_out {
    /// Set by the caller to sizeof(nm_left_out).
    pub struct_size: u32,
    /// Zero.
    pub reserved: u32,
    /// Elements with two ends.
    pub edges: u64,
    /// Triangles and other polygons.
    pub faces: u64,
    /// Tetrahedra and other elements of three dimensions or more.
    pub cells: u64,
}

// SAFETY: repr(C), begins with a u32, no padding (checked below), numbers only.
unsafe impl Versioned for nm_left_out {
    const TYPE: &'static str = "nm_left_out";
}

const _: () = assert!(size_of::<nm_left_out>() == 2 * 4 + 3 * 8);

/// A ball of the domain hierarchy; an element of the array that nm_mesh_get_domains fills (fixed in
/// size for this ABI version).
#[allow(non_camel_case_types)]
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct nm_domain {
    /// The vertex at the ball's centre.
    pub center: u32,
    /// Index of the enclosing domain, less than this one's; NM_NONE for the root (index 0).
    pub parent: u32,
    /// Radius, in the unit of the coordinates.
    pub radius: f64,
}

/// Measures of an alpha shape, from nm_mesh_alpha_shape.
#[allow(non_camel_case_types)]
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct nm_alpha_shape {
    /// Set by the caller to sizeof(nm_alpha_shape).
    pub struct_size: u32,
    /// Number of known elements of betti: 2 in 2D, 3 in 3D, 0 in other dimensions, whose homology
    /// takes a program that computes persistence (nm_export_filtration).
    pub betti_count: u32,
    /// The volume of its simplices (an area in 2D), in the unit of the coordinates to the power
    /// dim. Relative error at most 1e-12.
    pub volume: f64,
    /// The number of its faces of even dimension less that of those of odd dimension.
    pub euler_characteristic: i64,
    /// Number of pieces of the shape.
    pub components: u64,
    /// Number of bounded pieces of space that the shape leaves: holes in 2D, cavities in 3D.
    pub voids: u64,
    /// Its Betti numbers, from dimension 0 on: components and holes in 2D; components, tunnels and
    /// cavities in 3D. 0 beyond betti_count.
    pub betti: [u64; 3],
    /// The number of its faces of each dimension, from 0 on. 0 beyond dim.
    pub face_counts: [u64; 9],
}

// SAFETY: repr(C), begins with a u32, no padding (checked below), and the fields take any bits.
unsafe impl Versioned for nm_alpha_shape {
    const TYPE: &'static str = "nm_alpha_shape";
}

const _: () = assert!(size_of::<nm_alpha_shape>() == 2 * 4 + 4 * 8 + 12 * 8);

/// Quality of a mesh. "Corners" are those of Voronoi cells. The aspect of a Voronoi cell is the
/// distance from its vertex to its farthest corner over half the distance to the nearest other
/// vertex; it is at least 1. A figure over no cells at all is 0. Infinity stands for ratios beyond
/// the doubles.
#[allow(non_camel_case_types)]
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct nm_quality {
    /// Set by the caller to sizeof(nm_quality).
    pub struct_size: u32,
    /// Largest number of vertices that share an edge with one vertex.
    pub max_degree: u32,
    /// Worst aspect of the cells of vertices that are in no cage, not on the hull and not
    /// precision-limited, over the corners well inside the hull of their domain's cage: within
    /// min(0.85, 1 - delta^2 / 2) of the radius of the cage's sphere (all corners where there are
    /// no domains).
    pub worst_aspect: f64,
    /// Worst aspect, over all corners, of the cells of vertices in no cage and off the hull and of
    /// the cells of cages (see worst_cage_aspect), precision-limited ones included.
    /// NM_CRITERION_VORONOI_ASPECT bounds it, but for precision-limited cells. If epsilon > 0.8
    /// cage_scale, it bounds worst_aspect instead for the cells in inner domains. The cell of a
    /// single vertex of a cage has no bound: it reaches across the empty space that the cage stands
    /// for.
    pub worst_aspect_anywhere: f64,
    /// Mean of the aspects of which worst_aspect is the largest.
    pub mean_aspect: f64,
    /// Worst aspect of a cage other than the root's: the union of its vertices' cells, seen from
    /// the domain's centre, over the corners well inside the parent's cage.
    pub worst_cage_aspect: f64,
    /// Worst circumradius over shortest edge of the simplices without a vertex on the hull.
    /// NM_CRITERION_RADIUS_EDGE bounds this ratio for every simplex of a well-spaced mesh, those at
    /// the hull included, and in a hierarchical mesh for the simplices with all vertices in one
    /// domain. Of a domain that segments or facets bound and that is cut out, all simplices count
    /// but those that a small angle between them forces, and flat ones.
    pub worst_radius_edge: f64,
    /// Smallest angle (2D) or dihedral angle (3D and more), in degrees, of the simplices without a
    /// vertex on the hull.
    pub min_angle_degrees: f64,
    /// Vertices whose cells cannot be improved, because doubles are too coarse there. The quality
    /// bound does not hold for them; nm_mesh_get_precision_limited tells which they are.
    pub precision_limited: u64,
    /// Tetrahedra with a dihedral angle below nm_options.min_dihedral and all vertices in one
    /// domain, those at the hull included. 0 where no angle was asked for.
    pub below_min_dihedral: u64,
    /// Tetrahedra with a smaller dihedral angle and vertices of several domains, which fill the
    /// gaps beside cages: min_dihedral says nothing of them.
    pub below_min_dihedral_between_domains: u64,
    /// Cells with a larger aspect, or simplices with a larger ratio, than the bound, where it gave
    /// way to the angle (NM_GIVES_WAY_BOUND). The figures above have them.
    pub beyond_bound: u64,
    /// Simplices beyond the bound that a small angle between segments or facets forces; nothing can
    /// mend them, and worst_radius_edge and min_angle_degrees leave them out.
    pub forced: u64,
    /// Smallest angle (2D) or dihedral angle (3D) of the forced simplices, in degrees; 0 if there
    /// are none.
    pub least_forced_angle_degrees: f64,
    /// Triangles with an angle below nm_options.min_angle, or below what NM_CRITERION_RADIUS_EDGE
    /// promises in 2D, which nothing forces: beside cages in hierarchical meshes, which break the
    /// angle, and at precision-limited vertices. 0 where no angle was promised, and above 2D.
    pub below_min_angle: u64,
    /// Tetrahedra with all vertices on one facet, which are flat but for the roundings of vertices
    /// and, with nm_options.coplanar, for its bends: four of them on a circle may be one. They
    /// belong to the facet, and the figures above leave them out.
    pub flat: u64,
}

// SAFETY: repr(C), begins with a u32, no padding (checked below), numbers only.
unsafe impl Versioned for nm_quality {
    const TYPE: &'static str = "nm_quality";
}

const _: () = assert!(size_of::<nm_quality>() == 2 * 4 + 14 * 8);

/// Statistics of the last nm_run. "Definition" and "Theorem" are those of the paper.
#[allow(non_camel_case_types)]
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct nm_stats {
    /// Set by the caller to sizeof(nm_stats).
    pub struct_size: u32,
    /// Zero.
    pub reserved: u32,
    /// Rounds of insertion that came one after the other: those over the whole mesh, and the most
    /// that one tile of its inputs went through afterwards; O(log n).
    pub rounds: u64,
    /// Work of point location: how often an input that was not yet a vertex was considered for a
    /// ball. O(n log n).
    pub touches: u64,
    /// The largest number of touches of one input.
    pub max_touches: u64,
    /// Vertices that are inputs.
    pub input_vertices: u64,
    /// Vertices added for quality.
    pub steiner_vertices: u64,
    /// Vertices of cages that are alive at the end.
    pub cage_vertices: u64,
    /// Cages made during the run.
    pub cages_created: u64,
    /// Number of times that a cage grew during the run.
    pub cages_grown: u64,
    /// Cages released during the run.
    pub cages_released: u64,
    /// Geometric tests that needed exact arithmetic, because floating point could not decide them.
    pub exact_fallbacks: u64,
    /// Vertices that are precision-limited, as nm_quality.precision_limited.
    pub precision_limited: u64,
    /// Wall-clock time of the run, in seconds, without what nm_options.instruments takes. The only
    /// field that differs between equal runs. On another number of threads touches, max_touches,
    /// exact_fallbacks and passes of NM_ALGORITHM_DELAUNAY in 3D differ, too; no other field does,
    /// and no array.
    pub seconds: f64,
    /// Nets or samples taken in these rounds. A round takes one, and another each time that the
    /// last one has not halved every conflict list. (The conflict list of a simplex holds the
    /// inputs assigned to it that are no vertices yet.)
    pub passes: u64,
    /// The length of the longest conflict list after a round over that before the round, largest
    /// over all rounds. At most 1/2; 0 without such lists (NM_ALGORITHM_SVR, and
    /// NM_ALGORITHM_DELAUNAY in 2D and 3D, whose touches are steps of walks).
    pub worst_halving: f64,
    /// Points inserted for cages during the run, those of cages released later included.
    /// input_vertices, cage_points, far_corners and off_centers add up to the vertices.
    pub cage_points: u64,
    /// Steiner points inserted at a Voronoi corner (circumcentres).
    pub far_corners: u64,
    /// Steiner points inserted elsewhere: on the segment from a vertex to a Voronoi corner of its
    /// cell, or for nm_options.min_dihedral.
    pub off_centers: u64,
    /// Number of inputs that were inserted instead of a Steiner or cage point near them.
    pub yields: u64,
    /// Points inserted in cage gaps by the final refinement. cage_points includes them.
    pub closing_points: u64,
    /// Number of times that an input that is not on a straight segment, or on the boundary of an
    /// extent, counts as on it: it is within 3 units in the last place of the segment's larger
    /// coordinates, by axis.
    pub near_inputs: u64,
    /// Distance of the farthest of these inputs from its segment, in the same units.
    pub farthest_near_input: f64,
    /// Points at which the ply was counted: Voronoi corners, all of them if they are few. This
    /// field and those below are 0 unless nm_options.instruments is 1. They are maxima over samples
    /// (docs/limitations.md).
    pub ply_probes: u64,
    /// The largest number of D-balls (circumballs of simplices) that have one of these points
    /// strictly inside: k of Definition 1.
    pub max_ply: u64,
    /// The mean number of D-balls that have one of these points strictly inside.
    pub mean_ply: f64,
    /// The largest number of other D-balls that meet one D-ball (Theorem 4).
    pub max_ball_intersections: u64,
    /// The mean number of other D-balls that meet one D-ball.
    pub mean_ball_intersections: f64,
    /// K of Definition 7: the largest feature size of the inputs over that of the mesh, in the same
    /// domain and at a vertex of it. The feature size of a set at a point (Definition 5) is the
    /// distance to its second nearest member. Domains with fewer than two inputs do not count.
    /// 0 for NM_ALGORITHM_DELAUNAY.
    pub feature_size_constant: f64,
    /// K'_I of Definition 8, for inputs: the largest feature size of the inputs over that of the
    /// mesh, at a vertex that has just been inserted and with the inputs and the mesh of that
    /// moment. 0 for NM_ALGORITHM_DELAUNAY.
    pub insertion_constant_input: f64,
    /// K'_S of Definition 8: the same ratio for Steiner points. 0 for NM_ALGORITHM_DELAUNAY.
    pub insertion_constant_corner: f64,
    /// K'_C of Definition 8: the same ratio for vertices of cages, inputs that a cage point yielded
    /// to included. While a domain has no other vertex than its centre, the input that its cage is
    /// made for counts as inserted. 0 for NM_ALGORITHM_DELAUNAY.
    pub insertion_constant_cage: f64,
}

// SAFETY: repr(C), begins with a u32, no padding (checked below), numbers only.
unsafe impl Versioned for nm_stats {
    const TYPE: &'static str = "nm_stats";
}

const _: () = assert!(size_of::<nm_stats>() == 2 * 4 + 30 * 8);

/// Findings of nm_mesh_validate.
#[allow(non_camel_case_types)]
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct nm_report {
    /// Set by the caller to sizeof(nm_report).
    pub struct_size: u32,
    /// The highest level of which no rule is broken; 0 if one of level 1 is.
    pub level: u32,
    /// Violations found.
    pub violations: u64,
    /// Checks made.
    pub checked: u64,
    /// The first violation's kind; NM_VIOLATION_NONE if there is none.
    pub kind: ViolationKind,
    /// The first violation's simplex; NM_NONE if it concerns none.
    pub simplex: u32,
    /// The first violation's vertex; NM_NONE if it concerns none.
    pub vertex: u32,
    /// The first violation's domain; NM_NONE if it concerns none.
    pub domain: u32,
    /// The first violation in words: UTF-8 with its NUL, cut between characters; "" if there is
    /// none.
    pub message: [c_char; 160],
}

// SAFETY: repr(C), begins with a u32, no padding (checked below), numbers and an enum of four bytes
// that the library only writes.
unsafe impl Versioned for nm_report {
    const TYPE: &'static str = "nm_report";
}

const _: () = assert!(size_of::<nm_report>() == 2 * 4 + 2 * 8 + 4 * 4 + 160);
