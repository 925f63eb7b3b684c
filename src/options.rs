//! What a caller may ask of a run. Zero means "the default for the dimension";
//! [`crate::parameters`] resolves, documents the ranges and refuses what lies outside them.

/// What the run leaves behind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(i32)]
pub enum Output {
    /// [`Output::WellSpaced`] where something is asked for that a cage would break: an angle, a
    /// dihedral angle, a size, a distance ratio, or another extent than all. Otherwise
    /// [`Output::Hierarchical`].
    #[default]
    Auto = 0,
    /// The paper's NETMESH: a hierarchical mesh of O(n) vertices, whatever the spread.
    Hierarchical = 1,
    /// Then FINISHMESH (§6.6): a well-spaced mesh of one domain, of optimal size O(m).
    WellSpaced = 2,
}

/// Which algorithm runs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(i32)]
pub enum Algorithm {
    #[default]
    Netmesh = 0,
    /// Sparse Voronoi Refinement (§3), the baseline without cages.
    Svr = 1,
    /// The plain Delaunay triangulation of the input, without Steiner points.
    Delaunay = 2,
}

/// How far the result reaches.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(i32)]
pub enum Extent {
    /// [`Extent::Boundary`] where segments enclose something by [`Options::interior`], otherwise
    /// [`Extent::All`]. Curves that are not closed, where the rule asks for that, enclose nothing.
    #[default]
    Auto = 0,
    /// All of the mesh, to the cage round all inputs.
    All = 1,
    /// The convex hull of the inputs, in 2D.
    Hull = 2,
    /// The bounding box of the inputs, in 2D.
    Box = 3,
    /// What segments enclose, in 2D.
    Boundary = 4,
}

/// How a round of inputs is selected (§6.5).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(i32)]
pub enum NetOrdering {
    /// A seeded sample of each D-ball, whose halving is verified.
    #[default]
    SampledNet = 0,
    /// The net of each D-ball's inputs (Theorem 3), its property exact, its halving verified. No
    /// random number is used.
    DeterministicNet = 1,
}

/// The measure that `quality_bound` bounds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(i32)]
pub enum Criterion {
    /// The paper's tau: out-radius over in-radius of a Voronoi cell (§3).
    #[default]
    VoronoiAspect = 0,
    /// Circumradius over shortest edge of a simplex, TetGen's and Triangle's measure.
    RadiusEdge = 1,
}

/// What becomes of segments that cross where no input is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(i32)]
pub enum Crossings {
    /// They are refused.
    #[default]
    Refuse = 0,
    /// The double nearest to their crossing becomes a vertex of both.
    Split = 1,
}

/// Which of the regions that segments separate are inside, with [`Extent::Boundary`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(i32)]
pub enum Interior {
    /// [`Interior::Parity`] where the segments are those of a file of polygons (GeoJSON, WKT),
    /// [`Interior::Seeds`] otherwise. The result says which it was.
    #[default]
    Auto = 0,
    /// All that cannot be reached from outside without crossing a segment.
    Seeds = 1,
    /// Those into which a path from outside crosses an odd number of segments: the even-odd rule.
    /// Of a file of polygons only the sides of these count.
    Parity = 2,
    /// Those whose winding number is not 0: the segments that a path from outside crosses from
    /// their right to their left, less those from their left to their right. Of a file of polygons
    /// only the sides of these count.
    Winding = 3,
}

/// What gives way where `min_dihedral` and `quality_bound` cannot both be had.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(i32)]
pub enum GivesWay {
    /// The dihedral angle: some simplices stay below it,
    /// [`crate::Triangulation::below_min_dihedral`].
    #[default]
    Angle = 0,
    /// The bound: some cells or simplices go beyond it, [`crate::Triangulation::beyond_bound`].
    Bound = 1,
}

/// Options of a run. All doubles and `max_vertices`: 0 = the default for the dimension.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    pub output: Output,
    pub algorithm: Algorithm,
    pub ordering: NetOrdering,
    pub criterion: Criterion,
    /// 0 = all cores. The result does not depend on it. Of use in 2D and 3D with
    /// [`Algorithm::Netmesh`], from 524,288 distinct inputs on.
    pub threads: u32,
    pub quality_bound: f64,
    pub epsilon: f64,
    pub delta: f64,
    /// The cage's yield radius, relative to the distance to the nearest vertex.
    pub gamma: f64,
    /// The refinement's yield radius, relative to the D-ball's radius.
    pub yield_radius: f64,
    /// `outf`: cages are outer-encroached within `encroachment * r / epsilon`.
    pub encroachment: f64,
    /// Radius of the cage sphere relative to the domain's radius.
    pub cage_scale: f64,
    /// Radius of the root ball relative to the input's bounding ball.
    pub root_scale: f64,
    /// Of [`NetOrdering::SampledNet`]; without effect on [`NetOrdering::DeterministicNet`].
    pub seed: u64,
    pub max_vertices: u64,
    /// Measure the second part of [`crate::Stats`] too, which takes as long again or longer. The
    /// mesh is the same.
    pub instruments: bool,
    /// How far the cell of a vertex may reach, relative to the distance from the vertex to the
    /// nearest input, unless all of the cell has the same nearest input; 0: no matter how far.
    pub distance_ratio: f64,
    /// In 2D, the smallest angle in degrees, in place of `criterion` and `quality_bound`: the
    /// radius-edge ratio is bounded by `1 / (2 sin(min_angle))`.
    pub min_angle: f64,
    /// The least dihedral angle, in degrees, of simplices with all vertices in one domain; in 3D.
    pub min_dihedral: f64,
    /// How far the result reaches.
    pub extent: Extent,
    /// What becomes of segments that cross.
    pub crossings: Crossings,
    /// The length that no edge exceeds of simplices that meet the box of the inputs; 0: none. Not
    /// with [`Output::Hierarchical`].
    pub max_edge: f64,
    /// Of `min_dihedral` and the bound; without effect where no angle is asked for.
    pub gives_way: GivesWay,
    /// Which regions are inside; seeds may make holes of them. With [`Extent::Auto`] and
    /// [`Extent::Boundary`] only.
    pub interior: Interior,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            output: Output::default(),
            algorithm: Algorithm::default(),
            ordering: NetOrdering::default(),
            criterion: Criterion::default(),
            threads: 1,
            quality_bound: 0.0,
            epsilon: 0.0,
            delta: 0.0,
            gamma: 0.0,
            yield_radius: 0.0,
            encroachment: 0.0,
            cage_scale: 0.0,
            root_scale: 0.0,
            seed: 0,
            max_vertices: 0,
            instruments: false,
            distance_ratio: 0.0,
            min_angle: 0.0,
            min_dihedral: 0.0,
            extent: Extent::default(),
            crossings: Crossings::default(),
            max_edge: 0.0,
            gives_way: GivesWay::default(),
            interior: Interior::default(),
        }
    }
}

/// The stages of a run, as progress reports name them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum Phase {
    Prepare = 0,
    Insert = 1,
    Finish = 2,
    Export = 3,
}

/// A progress report.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    pub phase: Phase,
    /// Monotone in \[0, 1\]; -1 if unknown.
    pub fraction: f64,
    pub inputs_inserted: u64,
    pub vertices: u64,
    pub simplices: u64,
}

/// Called about every 30 ms, and where a round or a stage ends, on the thread that runs;
/// `false` cancels the run.
pub type ProgressFn<'a> = dyn FnMut(&Progress) -> bool + 'a;

/// The size that is asked for at a point, in the box of the inputs: a number above 0, infinite
/// where there is no bound. Any other answer ends the run. Called on the thread that runs.
pub type SizeFn<'a> = dyn Fn(&[f64]) -> f64 + 'a;
