//! The mesh as its users see it: the inputs, and after a run the triangulation, both free of the
//! dimension as a type. A [`Triangulation`] is plain data: whoever holds one may read (and in tests
//! corrupt) every part of it.

pub(crate) mod attribute;
mod boundary;
mod boxed;
mod diagnosis;
mod facets;
mod holes;
mod inputs;
mod intersection;
mod left_out;
pub mod sizes;

pub use attribute::Attribute;
pub use boundary::{Arrangement, Boundary, Crowded, Region, Segments, Subsegment};
pub use boxed::Boxed;
pub use diagnosis::{Diagnosis, EdgeFault, OddEdge};
pub(crate) use facets::check_starts;
pub use facets::{ArrangedFacet, FacetTriangle, Facets};
pub use holes::{FacetTriangulation, HoleFilling};
pub use inputs::Inputs;
pub(crate) use inputs::check_finite;
pub use intersection::{Feature, Intersection, IntersectionKind};
pub use left_out::LeftOut;

use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::{AllocError, TryGrow, copied};
use crate::parameters::Parameters;
use sizes::GivenSizes;

/// Id of nothing: the neighbour across the hull, the parent of the root.
pub const NONE: u32 = u32::MAX;
pub const MIN_DIM: usize = 2;
pub const MAX_DIM: usize = 8;

/// Evaluates `body` with the dimension as the constant `D`, and `other` for a dimension that no
/// mesh has. Unit tests, and the build for the thread sanitizer (`netmesh_few_dimensions`), are
/// compiled for 2 to 5 dimensions only: to compile the others again takes longer than all of their
/// tests run. The tests in `tests` go up to 8.
macro_rules! in_dimension {
    ($dim:expr, $D:ident => $body:expr, _ => $other:expr) => {
        match $dim {
            2 => crate::mesh::in_dimension!(@2, $D, $body),
            3 => crate::mesh::in_dimension!(@3, $D, $body),
            4 => crate::mesh::in_dimension!(@4, $D, $body),
            5 => crate::mesh::in_dimension!(@5, $D, $body),
            #[cfg(any(test, netmesh_few_dimensions))]
            6..=8 => panic!("a unit test of more than 5 dimensions belongs in `tests`"),
            #[cfg(not(any(test, netmesh_few_dimensions)))]
            6 => crate::mesh::in_dimension!(@6, $D, $body),
            #[cfg(not(any(test, netmesh_few_dimensions)))]
            7 => crate::mesh::in_dimension!(@7, $D, $body),
            #[cfg(not(any(test, netmesh_few_dimensions)))]
            8 => crate::mesh::in_dimension!(@8, $D, $body),
            _ => $other,
        }
    };
    (@$value:literal, $D:ident, $body:expr) => {{
        const $D: usize = $value;
        $body
    }};
}
pub(crate) use in_dimension;

/// Origin of a vertex. The vertices of a cage are of kind `Cage` until it is released.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum VertexKind {
    Input = 0,
    Steiner = 1,
    Cage = 2,
}

/// Ball of the domain hierarchy (§4).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Domain {
    /// Vertex at the ball's centre.
    pub center: u32,
    /// Index of the enclosing domain, [`NONE`] for the root.
    pub parent: u32,
    pub radius: f64,
}

/// Counts and measures of the last run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stats {
    /// Number of rounds over the whole mesh, plus the largest number that one tile of inputs went
    /// through afterwards.
    pub rounds: u64,
    /// Number of touches, the work of point location (Definition 9): considerations of an
    /// uninserted input for one D-ball.
    pub touches: u64,
    /// Largest number of touches of one input.
    pub max_touches: u64,
    /// Number of vertices that are inputs.
    pub input_vertices: u64,
    /// Number of Steiner vertices in the result.
    pub steiner_vertices: u64,
    /// Number of vertices of cages in the result.
    pub cage_vertices: u64,
    /// Number of cages made in the whole run.
    pub cages_created: u64,
    /// Number of times that a cage was grown.
    pub cages_grown: u64,
    /// Number of cages released.
    pub cages_released: u64,
    /// Number of in-ball and orientation tests that the floating-point filters did not decide.
    pub exact_fallbacks: u64,
    /// Number of vertices whose cell cannot reach the bound in double precision.
    pub precision_limited: u64,
    /// Seconds that the run took, without the time that [`crate::Options::instruments`] takes.
    pub seconds: f64,
    /// Number of nets or samples taken in the rounds.
    pub passes: u64,
    /// Largest quotient, over the rounds, of the length of the longest conflict list after a round
    /// and before it.
    pub worst_halving: f64,
    /// Number of cage points inserted in the whole run, including those whose cage was released
    /// later.
    pub cage_points: u64,
    /// Number of Steiner points inserted at Voronoi corners: of bad cells, or of long conflict
    /// lists.
    pub far_corners: u64,
    /// Number of Steiner points inserted on the way to a Voronoi corner, or against slivers.
    pub off_centers: u64,
    /// Number of inputs inserted instead of a planned cage or Steiner point.
    pub yields: u64,
    /// Number of `cage_points` that the final refinement inserted in cage gaps.
    pub closing_points: u64,
    /// Number of probe points, which are Voronoi corners. This and the fields from `max_ply` to
    /// `insertion_constant_cage` are measured if [`crate::Options::instruments`] asks for it, and
    /// are 0 if not.
    pub ply_probes: u64,
    /// Largest number of D-balls that hold one probe point (Definition 1).
    pub max_ply: u64,
    /// Mean number of D-balls that hold a probe point.
    pub mean_ply: f64,
    /// Largest number of D-balls that meet one D-ball (Theorem 4).
    pub max_ball_intersections: u64,
    /// Mean number of D-balls that meet a D-ball.
    pub mean_ball_intersections: f64,
    /// Observed value of K in Definition 7.
    pub feature_size_constant: f64,
    /// Observed value of K'_I in Definition 8, for inputs.
    pub insertion_constant_input: f64,
    /// Observed value of K'_S in Definition 8, for Steiner points.
    pub insertion_constant_corner: f64,
    /// Observed value of K'_C in Definition 8, for cage vertices.
    pub insertion_constant_cage: f64,
    /// Number of simplices made in the whole run, including infinite ones and those that a later
    /// point destroyed. Always measured.
    pub simplices_created: u64,
    /// Number of points inserted on segments, where they are split or cross.
    pub segment_points: u64,
    /// Number of cases in which an input counts as on a segment, or on the boundary of an extent,
    /// without being exactly on it, because rounding may explain the gap.
    pub near_inputs: u64,
    /// Largest distance of such an input from the straight segment, in units in the last place of
    /// the segment's larger coordinates.
    pub farthest_near_input: f64,
}

impl Stats {
    /// Returns these with what instruments have measured in another run.
    pub(crate) fn with_instruments_of(self, other: &Self) -> Self {
        Self {
            ply_probes: other.ply_probes,
            max_ply: other.max_ply,
            mean_ply: other.mean_ply,
            max_ball_intersections: other.max_ball_intersections,
            mean_ball_intersections: other.mean_ball_intersections,
            feature_size_constant: other.feature_size_constant,
            insertion_constant_input: other.insertion_constant_input,
            insertion_constant_corner: other.insertion_constant_corner,
            insertion_constant_cage: other.insertion_constant_cage,
            ..self
        }
    }
}

/// Result of a run: a Delaunay triangulation, its domain hierarchy, and the parameters of the run.
#[derive(Clone, Debug)]
pub struct Triangulation {
    pub dim: usize,
    /// Coordinates of the vertices, `vertices x dim`.
    pub points: Vec<f64>,
    /// Vertex ids, `simplices x (dim + 1)`, positively oriented: det[v1-v0, ..., vd-v0] > 0.
    pub simplices: Vec<u32>,
    /// Simplex ids, `simplices x (dim + 1)`, the i-th opposite vertex i; [`NONE`] on the hull.
    pub neighbors: Vec<u32>,
    pub kinds: Vec<VertexKind>,
    /// Vertex -> index of the innermost domain that holds it; [`NONE`] if there are no domains.
    pub vertex_domains: Vec<u32>,
    /// Vertex of kind `Cage` -> the domain to whose cage it belongs; [`NONE`] for other vertices.
    /// An input that a cage yielded to belongs to a cage, but keeps the kind `Input`.
    pub cage_of: Vec<u32>,
    /// Domains: index 0 is the root, and parents come before their children. Empty for plain
    /// Delaunay.
    pub domains: Vec<Domain>,
    /// Vertex -> true if its cell cannot reach the bound because doubles are not fine enough there.
    pub precision_limited: Vec<bool>,
    /// Simplices that the run has left with a dihedral angle smaller than
    /// [`crate::Options::min_dihedral`], ascending; none with vertices of several domains.
    pub below_min_dihedral: Vec<u32>,
    pub boundary: Boundary,
    /// Vertex -> the size that was asked for there; infinite where there is no bound, and where
    /// none was needed. Empty without a function or values that give sizes.
    pub sizes: Vec<f64>,
    /// Vertices or simplices at which the bound gave way to the angle ([`crate::GivesWay::Bound`]),
    /// ascending: vertices with [`crate::Criterion::VoronoiAspect`], simplices with
    /// [`crate::Criterion::RadiusEdge`].
    pub beyond_bound: Vec<u32>,
    pub parameters: Parameters,
    pub stats: Stats,
}

impl Triangulation {
    pub fn vertex_count(&self) -> usize {
        self.kinds.len()
    }

    pub fn simplex_count(&self) -> usize {
        self.simplices.len() / (self.dim + 1)
    }

    pub fn point(&self, vertex: u32) -> &[f64] {
        &self.points[vertex as usize * self.dim..][..self.dim]
    }

    pub fn simplex(&self, simplex: usize) -> &[u32] {
        &self.simplices[simplex * (self.dim + 1)..][..self.dim + 1]
    }

    pub fn neighbors_of(&self, simplex: usize) -> &[u32] {
        &self.neighbors[simplex * (self.dim + 1)..][..self.dim + 1]
    }
}

/// Points, and after [`Mesh::run`] their mesh.
#[derive(Clone, Debug)]
pub struct Mesh {
    inputs: Inputs,
    triangulation: Option<Triangulation>,
    attributes: Vec<Attribute>,
    segments: Segments,
    facets: Facets,
    regions: Vec<Region>,
    given_sizes: GivenSizes,
    /// Segments that the result was made with, if the caller has set others since.
    earlier_segments: Option<Segments>,
    /// Facets that the result was made with, if the caller has set others since.
    earlier_facets: Option<Facets>,
    /// Regions that the result was made with, if the caller has set others since.
    earlier_regions: Option<Vec<Region>>,
    left_out: LeftOut,
}

impl Mesh {
    /// Makes a mesh of points without a result. Arguments and errors are those of [`Inputs::new`].
    pub fn new(dim: usize, n: usize, points: &[f64], stride: usize) -> Result<Self> {
        let inputs = Inputs::new(dim, n, points, stride)?;
        Ok(Self::of(inputs, None))
    }

    /// Makes a mesh with a result that no run made.
    pub(crate) fn from_parts(inputs: Inputs, triangulation: Triangulation) -> Self {
        Self::of(inputs, Some(triangulation))
    }

    /// Returns the mesh with these markers for the segments of its result.
    pub fn with_markers(self, markers: Vec<i32>) -> Self {
        let segments = Segments { markers, ..Segments::default() };
        Self { earlier_segments: Some(segments), ..self }
    }

    /// Returns the mesh with these markers for the facets of its result.
    pub fn with_facet_markers(self, markers: Vec<i32>) -> Self {
        let facets = Facets { markers, ..Facets::default() };
        Self { earlier_facets: Some(facets), ..self }
    }

    fn of(inputs: Inputs, triangulation: Option<Triangulation>) -> Self {
        Self {
            inputs,
            triangulation,
            attributes: Vec::new(),
            segments: Segments::default(),
            facets: Facets::default(),
            regions: Vec::new(),
            given_sizes: GivenSizes::default(),
            earlier_segments: None,
            earlier_facets: None,
            earlier_regions: None,
            left_out: LeftOut::default(),
        }
    }

    pub fn inputs(&self) -> &Inputs {
        &self.inputs
    }

    /// Sets values of the inputs (`inputs x components`, in the caller's order; of equal inputs the
    /// first counts), which writers put into columns of that name. They replace earlier values of
    /// the same name; no values at all (`components` 0) remove them. With `is_extended` other
    /// vertices get values by [`extend_values`](crate::prepared::extend_values), else NaN.
    ///
    /// # Errors
    /// `InvalidArgument` (`name` is not 1 to 64 ASCII letters, digits, `_`, `-` and `.`, or files
    /// use it for something else; a length), `OutOfMemory`.
    pub fn set_attribute(
        &mut self,
        name: &str,
        components: usize,
        values: &[f64],
        is_extended: bool,
    ) -> Result<()> {
        Attribute::check_name(name)?;
        let count = self.inputs.count();
        if Some(values.len()) != count.checked_mul(components) {
            let message = message!(
                "values has length {}; it must be inputs x components = {count} x {components}",
                values.len()
            );
            return Err(Error::new(ErrorKind::InvalidArgument, message));
        }
        let known = self.attributes.iter().position(|attribute| attribute.name == name);
        if components == 0 {
            known.map(|at| self.attributes.remove(at));
            return Ok(());
        }
        let mut own = String::new();
        own.try_reserve(name.len()).map_err(AllocError::from)?;
        own.push_str(name);
        let values = copied(values)?;
        let attribute = Attribute { name: own, components, values, is_extended };
        match known {
            Some(at) => self.attributes[at] = attribute,
            None => self.attributes.try_push(attribute)?,
        }
        Ok(())
    }

    /// Returns the values of the inputs, in the order in which their names were first set.
    pub fn attributes(&self) -> &[Attribute] {
        &self.attributes
    }

    /// Sets the segments that the next run keeps as chains of edges: two inputs for each, and a
    /// marker of the caller's (0 without `markers`). They replace earlier segments; the result of a
    /// run stays as it is.
    ///
    /// # Errors
    /// `InvalidArgument` (a mesh of more than three dimensions; an odd length of `ends`, an end
    /// that is no input, two ends that are the same point, the length of `markers`), `Capacity`,
    /// `OutOfMemory`.
    pub fn set_segments(&mut self, ends: &[u32], markers: Option<&[i32]>) -> Result<()> {
        let segments = Segments::new(&self.inputs, ends, markers)?;
        let earlier = std::mem::replace(&mut self.segments, segments);
        if self.triangulation.is_some() {
            self.earlier_segments.get_or_insert(earlier);
        }
        Ok(())
    }

    pub fn segments(&self) -> &Segments {
        &self.segments
    }

    /// Sets the facets in space that the next run keeps as triangles of its simplices, and a marker
    /// of the caller's for each (0 without `markers`). They replace earlier facets and triangles;
    /// the result of a run stays as it is.
    ///
    /// Facet `i` has the loops `loop_starts[i]` to `loop_starts[i + 1]`, and loop `j` the inputs
    /// `input_starts[j]` to `input_starts[j + 1]` of `inputs`; both arrays rise from 0 and have one
    /// element more than there are facets and loops. Three inputs or more are a polygon, two a
    /// segment in the facet, one a vertex in it; what an odd number of polygons surround is in the
    /// facet.
    ///
    /// # Errors
    /// `InvalidArgument` (a mesh that is not in space; starts that do not rise from 0 to the
    /// lengths; a number that is no input; a loop with one point twice in a row; a facet without a
    /// polygon; the length of `markers`), `Capacity`, `OutOfMemory`.
    pub fn set_facets(
        &mut self,
        loop_starts: &[u64],
        input_starts: &[u64],
        inputs: &[u32],
        markers: Option<&[i32]>,
    ) -> Result<()> {
        let starts = [loop_starts, input_starts];
        let facets = Facets::of_loops(&self.inputs, starts, inputs, markers)?;
        self.replace_facets(facets);
        Ok(())
    }

    /// Sets the triangles of a surface in space, which the next run keeps: three inputs for each,
    /// and a marker of the caller's (0 without `markers`). Triangles that share an edge, lie in one
    /// plane up to [`crate::Options::coplanar`] and have one marker are one facet. A triangle that
    /// has a point twice is one without an area. They replace earlier triangles and facets; the
    /// result of a run stays as it is.
    ///
    /// # Errors
    /// `InvalidArgument` (a mesh that is not in space; a length of `inputs` that is no multiple of
    /// 3; a number that is no input; the length of `markers`), `Capacity`, `OutOfMemory`.
    pub fn set_triangles(&mut self, inputs: &[u32], markers: Option<&[i32]>) -> Result<()> {
        let facets = Facets::of_triangles(&self.inputs, inputs, markers)?;
        self.replace_facets(facets);
        Ok(())
    }

    /// Replaces the facets that the next run keeps. The result of a run stays as it is.
    pub(crate) fn replace_facets(&mut self, facets: Facets) {
        let earlier = std::mem::replace(&mut self.facets, facets);
        if self.triangulation.is_some() {
            self.earlier_facets.get_or_insert(earlier);
        }
    }

    /// Returns the facets that the next run keeps.
    pub fn given_facets(&self) -> &Facets {
        &self.facets
    }

    /// Returns the facets that the result was made with, which [`Boundary::subfacet_parents`]
    /// refers to.
    pub fn facets_of_result(&self) -> &Facets {
        self.earlier_facets.as_ref().unwrap_or(&self.facets)
    }

    /// Returns the markers of the segments that the result was made with, which
    /// [`Boundary::parents`] refers to; the markers of facets are in [`Mesh::facets_of_result`].
    pub fn markers_of_result(&self) -> &[i32] {
        &self.outline_of_result().0.markers
    }

    /// Sets labels, holes and largest edges for regions between segments in the plane, or facets in
    /// space, for the next run. They replace earlier regions; the result of a run stays as it is.
    ///
    /// # Errors
    /// `InvalidArgument` (a mesh of more than three dimensions; a third coordinate in the plane; a
    /// negative or infinite `max_edge`), `NonFinite` (a seed), `OutOfMemory`.
    pub fn set_regions(&mut self, regions: &[Region]) -> Result<()> {
        let regions = boundary::checked_regions(&self.inputs, regions)?;
        let earlier = std::mem::replace(&mut self.regions, regions);
        if self.triangulation.is_some() {
            self.earlier_regions.get_or_insert(earlier);
        }
        Ok(())
    }

    pub fn regions(&self) -> &[Region] {
        &self.regions
    }

    /// Returns the sizes that were given by values.
    pub fn given_sizes(&self) -> &GivenSizes {
        &self.given_sizes
    }

    /// Returns the segments and regions that the result was made with.
    pub(crate) fn outline_of_result(&self) -> (&Segments, &[Region]) {
        let segments = self.earlier_segments.as_ref().unwrap_or(&self.segments);
        (segments, self.earlier_regions.as_ref().unwrap_or(&self.regions))
    }

    /// Replaces the result.
    pub(crate) fn set_triangulation(&mut self, triangulation: Triangulation) {
        (self.earlier_segments, self.earlier_regions) = (None, None);
        self.earlier_facets = None;
        self.triangulation = Some(triangulation);
    }

    /// Returns the result of the last successful run; `None` before one.
    pub fn triangulation(&self) -> Option<&Triangulation> {
        self.triangulation.as_ref()
    }

    /// Returns the result of the last successful run.
    ///
    /// # Errors
    /// `State` before a run.
    pub fn result(&self) -> Result<&Triangulation> {
        let rule = "the mesh has no result yet; run it first";
        self.triangulation().ok_or_else(|| Error::new(ErrorKind::State, rule))
    }
}
