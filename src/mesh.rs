//! The mesh as its users see it: the inputs, and after a run the triangulation, both free of the
//! dimension as a type. Plain data: whoever holds a [`Triangulation`] may read (and in tests
//! corrupt) every part of it.

pub(crate) mod attribute;
mod boundary;
mod boxed;
mod left_out;
pub mod sizes;

pub use attribute::Attribute;
pub use boundary::{Arrangement, Boundary, Crowded, Region, Segments, Subsegment};
pub use boxed::Boxed;
pub use left_out::LeftOut;

use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::{AllocError, AllocResult, TryGrow, copied, filled, with_capacity};
use crate::parameters::Parameters;
use sizes::GivenSizes;

/// No id: a hull facet's missing neighbour, the root's missing parent.
pub const NONE: u32 = u32::MAX;
pub const MIN_DIM: usize = 2;
pub const MAX_DIM: usize = 8;

/// `body` with the dimension as the constant `D`, `other` for a dimension that no mesh has. The
/// program of the unit tests knows 2 to 5 dimensions: to compile the others again takes longer than
/// all its tests. Those in `tests` go up to 8.
macro_rules! in_dimension {
    ($dim:expr, $D:ident => $body:expr, _ => $other:expr) => {
        match $dim {
            2 => crate::mesh::in_dimension!(@2, $D, $body),
            3 => crate::mesh::in_dimension!(@3, $D, $body),
            4 => crate::mesh::in_dimension!(@4, $D, $body),
            5 => crate::mesh::in_dimension!(@5, $D, $body),
            #[cfg(test)]
            6..=8 => panic!("a unit test of more than 5 dimensions belongs in `tests`"),
            #[cfg(not(test))]
            6 => crate::mesh::in_dimension!(@6, $D, $body),
            #[cfg(not(test))]
            7 => crate::mesh::in_dimension!(@7, $D, $body),
            #[cfg(not(test))]
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

/// Where a vertex comes from. A released cage's vertices stay `Cage` only while their cage lives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum VertexKind {
    Input = 0,
    Steiner = 1,
    Cage = 2,
}

/// A ball of the domain hierarchy (§4).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Domain {
    /// The vertex at the ball's centre.
    pub center: u32,
    /// Index of the enclosing domain, [`NONE`] for the root.
    pub parent: u32,
    pub radius: f64,
}

/// What the last run did.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stats {
    /// Over the whole mesh, and the most that a tile of inputs went through afterwards.
    pub rounds: u64,
    /// Point location work (Definition 9): how often an uninserted input was considered for a ball.
    pub touches: u64,
    pub max_touches: u64,
    pub input_vertices: u64,
    pub steiner_vertices: u64,
    pub cage_vertices: u64,
    pub cages_created: u64,
    pub cages_grown: u64,
    pub cages_released: u64,
    /// In-ball and orientation tests that the floating-point filters did not decide.
    pub exact_fallbacks: u64,
    /// Vertices whose cell is out of reach of the bound in double precision.
    pub precision_limited: u64,
    /// Without the time that [`crate::Options::instruments`] takes.
    pub seconds: f64,
    /// Nets or samples taken in these rounds.
    pub passes: u64,
    /// The largest, over the rounds, of the longest conflict list after over before.
    pub worst_halving: f64,
    /// Points inserted over the whole run, those included whose cage was released later: of cages,
    /// ...
    pub cage_points: u64,
    /// ... Voronoi corners of bad cells or long conflict lists, ...
    pub far_corners: u64,
    /// ... and points on the way to such a corner, or against slivers.
    pub off_centers: u64,
    /// How often an input went in instead of such a point.
    pub yields: u64,
    /// Those of `cage_points` that the final refinement inserted in cage gaps.
    pub closing_points: u64,
    /// What follows is measured if [`crate::Options::instruments`] asks for it, and 0 if not. Probe
    /// points: Voronoi corners.
    pub ply_probes: u64,
    /// D-balls that hold one probe point (Definition 1).
    pub max_ply: u64,
    pub mean_ply: f64,
    /// D-balls that meet one D-ball (Theorem 4).
    pub max_ball_intersections: u64,
    pub mean_ball_intersections: f64,
    /// K of Definition 7 as observed.
    pub feature_size_constant: f64,
    /// K'_I, K'_S and K'_C of Definition 8 as observed: for inputs, Steiner points, cage vertices.
    pub insertion_constant_input: f64,
    pub insertion_constant_corner: f64,
    pub insertion_constant_cage: f64,
    /// Simplices made in the whole run, those that joined the hull to infinity included, whether or
    /// not a later point destroyed them. Measured always.
    pub simplices_created: u64,
    /// Points inserted on segments, where they are split or cross.
    pub segment_points: u64,
    /// How often an input that is not on a straight segment, or the boundary of an extent, is
    /// taken as on it, since it is nearer than rounding explains.
    pub near_inputs: u64,
    /// How far the farthest of these is from the straight segment, in units in the last place of
    /// the segment's larger coordinates.
    pub farthest_near_input: f64,
}

/// The caller's points: copied bits, exact duplicates counted once.
#[derive(Clone, Debug)]
pub struct Inputs {
    dim: usize,
    /// All n points, `n x dim`, with the caller's bits.
    coordinates: Vec<f64>,
    /// Input i -> vertex; the distinct inputs are vertices `0..distinct` in input order.
    vertices: Vec<u32>,
    /// Vertex v -> the first input that has its coordinates.
    first_input: Vec<u32>,
}

/// The result of a run: a Delaunay triangulation, its domain hierarchy and what made it.
#[derive(Clone, Debug)]
pub struct Triangulation {
    pub dim: usize,
    /// `vertices x dim`.
    pub points: Vec<f64>,
    /// `simplices x (dim + 1)` vertex ids, positively oriented: det[v1-v0, ..., vd-v0] > 0.
    pub simplices: Vec<u32>,
    /// `simplices x (dim + 1)` simplex ids, the i-th opposite vertex i; [`NONE`] on the hull.
    pub neighbors: Vec<u32>,
    pub kinds: Vec<VertexKind>,
    /// Vertex -> index of the innermost domain that holds it; [`NONE`] where there are no domains.
    pub vertex_domains: Vec<u32>,
    /// For a vertex of kind `Cage`: the domain whose cage it is part of; otherwise [`NONE`].
    /// An input that a cage yielded to is part of a cage and keeps the kind `Input`.
    pub cage_of: Vec<u32>,
    /// Index 0 is the root; a parent stands before its children. Empty for plain Delaunay.
    pub domains: Vec<Domain>,
    /// Cells that cannot reach the bound because doubles run out there.
    pub precision_limited: Vec<bool>,
    /// The simplices that the run has left with a smaller dihedral angle than
    /// [`crate::Options::min_dihedral`], by rising id; none with vertices of several domains.
    pub below_min_dihedral: Vec<u32>,
    pub boundary: Boundary,
    /// Vertex -> the size that was asked for there, infinite where there is no bound, and where
    /// none was needed; empty without a function or values that tell sizes.
    pub sizes: Vec<f64>,
    /// Where the bound gave way to the angle ([`crate::GivesWay::Bound`]), by rising id: with
    /// [`crate::Criterion::VoronoiAspect`] the vertices with cells beyond the bound, with
    /// [`crate::Criterion::RadiusEdge`] the simplices beyond it.
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

impl Inputs {
    /// Copies `n` points of `dim` coordinates that stand `stride` doubles apart (0 = `dim`).
    ///
    /// # Errors
    /// `Dimension`, `InvalidArgument` (stride, length), `NonFinite` (names point and coordinate),
    /// `Capacity` (2^32 - 2 points at most), `DegenerateInput` (fewer than two distinct points).
    pub fn new(dim: usize, n: usize, points: &[f64], stride: usize) -> Result<Self> {
        if !(MIN_DIM..=MAX_DIM).contains(&dim) {
            let message = message!("dim is {dim}; it must be {MIN_DIM} to {MAX_DIM}");
            return Err(Error::new(ErrorKind::Dimension, message));
        }
        let stride = if stride == 0 { dim } else { stride };
        if stride < dim {
            let message = message!("stride is {stride}; it must be 0 or at least dim = {dim}");
            return Err(Error::new(ErrorKind::InvalidArgument, message));
        }
        if n as u64 >= NONE as u64 {
            let message = message!("n is {n}; at most {} points fit 32-bit ids", NONE - 1);
            return Err(Error::new(ErrorKind::Capacity, message));
        }
        let needed = match n {
            0 => Some(0),
            _ => (n - 1).checked_mul(stride).and_then(|start| start.checked_add(dim)),
        };
        if needed.is_none_or(|needed| points.len() < needed) {
            let message = message!(
                "points holds {} doubles; n = {n} points with stride {stride} need more",
                points.len()
            );
            return Err(Error::new(ErrorKind::InvalidArgument, message));
        }
        let no_memory = |_| no_memory(n, dim);
        let mut coordinates = with_capacity(n * dim).map_err(no_memory)?;
        let mut vertices = with_capacity(n).map_err(no_memory)?;
        for i in 0..n {
            let point = &points[i * stride..][..dim];
            if let Some(axis) = point.iter().position(|x| !x.is_finite()) {
                let message = message!(
                    "points[{i}] has a non-finite coordinate {axis}: {}; every coordinate must be finite",
                    point[axis]
                );
                return Err(Error::new(ErrorKind::NonFinite, message));
            }
            coordinates.extend_from_slice(point);
        }
        let first_input = identify_duplicates(dim, &coordinates, &mut vertices)?;
        if first_input.len() < 2 {
            let message = message!(
                "{n} points, {} of them distinct; a mesh needs at least two distinct points",
                first_input.len()
            );
            return Err(Error::new(ErrorKind::DegenerateInput, message));
        }
        Ok(Self { dim, coordinates, vertices, first_input })
    }

    /// The inputs of a mesh that has only some of the vertices, ascending: the others have no
    /// vertex.
    pub(crate) fn of_vertices(&self, kept: &[u32]) -> AllocResult<Self> {
        let mut vertices = filled(self.count(), NONE)?;
        let mut first_input = Vec::new();
        for (new, &old) in
            kept.iter().enumerate().filter(|&(_, &old)| (old as usize) < self.distinct())
        {
            let first = self.first_input[old as usize];
            first_input.try_push(first)?;
            vertices[first as usize] = new as u32;
        }
        for input in 0..self.count() {
            vertices[input] = vertices[self.first_input[self.vertices[input] as usize] as usize];
        }
        Ok(Self { dim: self.dim, coordinates: copied(&self.coordinates)?, vertices, first_input })
    }

    pub fn dim(&self) -> usize {
        self.dim
    }

    /// Number of points given, duplicates included.
    pub fn count(&self) -> usize {
        self.vertices.len()
    }

    /// Number of distinct points: vertices `0..distinct()` of every mesh of these inputs.
    pub fn distinct(&self) -> usize {
        self.first_input.len()
    }

    pub fn duplicates(&self) -> usize {
        self.count() - self.distinct()
    }

    /// Returns the vertex of each input. Inputs that are equal share one.
    pub fn vertices(&self) -> &[u32] {
        &self.vertices
    }

    /// Returns the first input that each of the vertices `0..distinct()` is, ascending; other
    /// vertices are no inputs. This is the inverse of [`Inputs::vertices`] but for duplicates,
    /// which have the input that they repeat.
    pub fn first_inputs(&self) -> &[u32] {
        &self.first_input
    }

    /// Returns the first of the inputs that are `vertex`; `None` for a vertex that is no input.
    pub fn first_input(&self, vertex: usize) -> Option<u32> {
        self.first_input.get(vertex).copied()
    }

    /// The coordinates of input `i`, with the caller's bits.
    pub fn point(&self, i: usize) -> &[f64] {
        &self.coordinates[i * self.dim..][..self.dim]
    }

    /// The coordinates of distinct input (vertex) `v`.
    pub fn distinct_point(&self, v: usize) -> &[f64] {
        self.point(self.first_input[v] as usize)
    }

    /// The distinct points, `distinct x dim`.
    pub fn distinct_points(&self) -> Vec<f64> {
        (0..self.distinct()).flat_map(|v| self.distinct_point(v)).copied().collect()
    }
}

/// The refusal of a copy of the points; without numbers where there is no memory for those either.
fn no_memory(n: usize, dim: usize) -> Error {
    let bytes = n as u128 * dim as u128 * size_of::<f64>() as u128;
    let message = message!("cannot allocate a copy of the points: n = {n}, {bytes} bytes");
    if message.is_empty() {
        return AllocError::Memory.into();
    }
    Error::new(ErrorKind::OutOfMemory, message)
}

/// Fills `vertices`; returns the first input of each distinct point. Zeros of either sign are
/// equal. Expected O(n): an open hash table of ids, at most half full.
fn identify_duplicates(
    dim: usize,
    coordinates: &[f64],
    vertices: &mut Vec<u32>,
) -> Result<Vec<u32>> {
    let n = coordinates.len() / dim;
    let mut first_input = with_capacity(n)?;
    let mask = (2 * n).next_power_of_two() - 1;
    let mut table: Vec<u32> = filled(mask + 1, NONE)?;
    for (i, point) in coordinates.chunks_exact(dim).enumerate() {
        let mut slot = hash(point) & mask;
        let vertex = loop {
            match table[slot] {
                NONE => {
                    table[slot] = first_input.len() as u32;
                    first_input.push(i as u32);
                    break table[slot];
                }
                vertex
                    if coordinates[first_input[vertex as usize] as usize * dim..][..dim]
                        == *point =>
                {
                    break vertex;
                }
                _ => slot = (slot + 1) & mask,
            }
        };
        vertices.push(vertex);
    }
    Ok(first_input)
}

/// The hash of a point, all its bits mixed as by Steele, Lea and Flood, "Fast splittable
/// pseudorandom number generators", 2014. Adding zero makes a negative zero positive.
fn hash(point: &[f64]) -> usize {
    let mix = |hash: u64, x: &f64| {
        let mixed = hash ^ (x + 0.0).to_bits();
        let mixed = (mixed ^ mixed >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ mixed >> 31
    };
    point.iter().fold(0x9e37_79b9_7f4a_7c15, mix) as usize
}

/// Points, and after [`Mesh::run`] their mesh.
#[derive(Clone, Debug)]
pub struct Mesh {
    inputs: Inputs,
    triangulation: Option<Triangulation>,
    attributes: Vec<Attribute>,
    segments: Segments,
    regions: Vec<Region>,
    given_sizes: GivenSizes,
    /// What the result was made with, where the caller has set others since.
    earlier_segments: Option<Segments>,
    earlier_regions: Option<Vec<Region>>,
    left_out: LeftOut,
}

impl Mesh {
    /// See [`Inputs::new`].
    pub fn new(dim: usize, n: usize, points: &[f64], stride: usize) -> Result<Self> {
        let inputs = Inputs::new(dim, n, points, stride)?;
        Ok(Self::of(inputs, None))
    }

    /// A mesh with a result that no run made.
    pub(crate) fn from_parts(inputs: Inputs, triangulation: Triangulation) -> Self {
        Self::of(inputs, Some(triangulation))
    }

    /// A mesh whose result has segments with these markers.
    pub fn with_markers(self, markers: Vec<i32>) -> Self {
        let segments = Segments { markers, ..Segments::default() };
        Self { earlier_segments: Some(segments), ..self }
    }

    fn of(inputs: Inputs, triangulation: Option<Triangulation>) -> Self {
        Self {
            inputs,
            triangulation,
            attributes: Vec::new(),
            segments: Segments::default(),
            regions: Vec::new(),
            given_sizes: GivenSizes::default(),
            earlier_segments: None,
            earlier_regions: None,
            left_out: LeftOut::default(),
        }
    }

    pub fn inputs(&self) -> &Inputs {
        &self.inputs
    }

    /// Values of the inputs (`inputs x components`, in the caller's order; of equal inputs the
    /// first counts), which files get as columns of that name. They replace those of the same name;
    /// no values at all (`components` 0) remove them. `is_extended`: other vertices get values by
    /// [`extend_values`](crate::prepared::extend_values), else NaN.
    ///
    /// # Errors
    /// `InvalidArgument` (`name`: 1 to 64 ASCII letters, digits, `_`, `-` and `.`, and none that
    /// files have for something else; a length), `OutOfMemory`.
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

    /// The values of the inputs, in the order in which their names were set first.
    pub fn attributes(&self) -> &[Attribute] {
        &self.attributes
    }

    /// Segments that the next run keeps as chains of edges, two inputs a segment, with a number of
    /// the caller's for each (0 without `markers`). They replace those before; the result of a run
    /// stays as it is.
    ///
    /// # Errors
    /// `InvalidArgument` (a mesh that is not in the plane; an odd length of `ends`, an end that is
    /// no input, two ends that are the same point, the length of `markers`), `Capacity`,
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

    /// The markers of the segments that the result has, by [`Boundary::parents`].
    pub fn markers_of_result(&self) -> &[i32] {
        &self.outline_of_result().0.markers
    }

    /// What the next run makes of the regions between segments. They replace those before; the
    /// result of a run stays as it is.
    ///
    /// # Errors
    /// `InvalidArgument` (a mesh that is not in the plane; a negative or infinite `max_edge`),
    /// `NonFinite` (a seed), `OutOfMemory`.
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

    /// The sizes that were given by values.
    pub fn given_sizes(&self) -> &GivenSizes {
        &self.given_sizes
    }

    /// The segments and regions that the result was made with.
    pub(crate) fn outline_of_result(&self) -> (&Segments, &[Region]) {
        let segments = self.earlier_segments.as_ref().unwrap_or(&self.segments);
        (segments, self.earlier_regions.as_ref().unwrap_or(&self.regions))
    }

    /// Replaces the result.
    pub(crate) fn set_triangulation(&mut self, triangulation: Triangulation) {
        (self.earlier_segments, self.earlier_regions) = (None, None);
        self.triangulation = Some(triangulation);
    }

    /// The result of the last successful run.
    pub fn triangulation(&self) -> Option<&Triangulation> {
        self.triangulation.as_ref()
    }

    /// As [`Mesh::triangulation`], for what needs one.
    ///
    /// # Errors
    /// `State` before a run.
    pub fn result(&self) -> Result<&Triangulation> {
        let rule = "the mesh has no result yet; run it first";
        self.triangulation().ok_or_else(|| Error::new(ErrorKind::State, rule))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::Random;
    use std::collections::HashMap;

    /// Points of a lattice with a few values an axis, both zeros and neighbouring doubles among
    /// them.
    #[test]
    fn duplicates_are_those_that_compare_equal() {
        let values = [0.0, -0.0, 1.0, 1.0f64.next_up(), -1.0, 5e-324, 1e308];
        let mut random = Random(1);
        let mut draw = || values[random.integer(0, values.len() as i64 - 1) as usize];
        let points: Vec<f64> = (0..3 * 4000).map(|_| draw()).collect();
        let inputs = Inputs::new(3, 4000, &points, 0).unwrap();
        let mut known: HashMap<[u64; 3], u32> = HashMap::new();
        for (i, point) in points.chunks_exact(3).enumerate() {
            let key = std::array::from_fn(|axis| (point[axis] + 0.0).to_bits());
            let next = known.len() as u32;
            assert_eq!(inputs.vertices()[i], *known.entry(key).or_insert(next));
        }
        assert_eq!((inputs.distinct(), known.len()), (216, 216));
        for (vertex, &first) in inputs.first_input.iter().enumerate() {
            assert_eq!(inputs.vertices()[first as usize] as usize, vertex);
            assert!(!inputs.vertices()[..first as usize].contains(&(vertex as u32)));
        }
    }

    /// Regular inputs fill as many slots of a table as random ones: half full, (1 - exp(-1/2)) of
    /// it.
    #[test]
    fn hashes_of_lattices_are_spread() {
        for scale in [1.0, 2f64.powi(-1000), 0.1, 2f64.powi(900)] {
            let mut used = vec![false; 1 << 13];
            for i in 0..1 << 12 {
                let cell = [i % 16, i / 16 % 16, i / 256].map(|k| f64::from(k) * scale);
                used[hash(&cell) % (1 << 13)] = true;
            }
            let filled = used.iter().filter(|&&used| used).count() as f64 / (1 << 13) as f64;
            assert!((filled - 0.3935).abs() < 0.02, "{scale}: {filled}");
        }
    }
}
