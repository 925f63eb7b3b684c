//! The result of a run as one rank has it. Plain data.

use crate::work::Work;
use netmesh::{Criterion, Output, Parameters};

/// Value for no id: across the hull, no domain.
pub const NO_ID: u64 = u64::MAX;

/// Sizes of the whole mesh, equal on all ranks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Totals {
    /// Points that all ranks have given.
    pub inputs: u64,
    /// Number of inputs that are equal to one before.
    pub duplicates: u64,
    /// Number of vertices.
    pub vertices: u64,
    /// Ids of vertices are below this: all inputs, and the vertices that are none.
    pub vertex_ids: u64,
    pub simplices: u64,
    pub domains: u64,
    /// The parts that the mesh was made in.
    pub pieces: u64,
}

/// Bounds that the run promises for the quality of its cells, equal on all ranks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Promise {
    /// True if the mesh is well-spaced, of one domain.
    pub is_finished: bool,
    pub criterion: Criterion,
    /// Bound of the criterion; infinite where nothing is promised.
    pub quality_bound: f64,
    /// The parameters of cages, as in [`Parameters`].
    pub epsilon: f64,
    pub gamma: f64,
    pub encroachment: f64,
    pub cage_scale: f64,
}

impl Default for Promise {
    fn default() -> Self {
        Self {
            is_finished: false,
            criterion: Criterion::default(),
            quality_bound: f64::INFINITY,
            epsilon: f64::INFINITY,
            gamma: f64::INFINITY,
            encroachment: 0.0,
            cage_scale: 1.0,
        }
    }
}

impl Promise {
    pub fn of(parameters: &Parameters) -> Self {
        Self {
            is_finished: parameters.output == Output::WellSpaced,
            criterion: parameters.criterion,
            quality_bound: parameters.quality_bound,
            epsilon: parameters.epsilon,
            gamma: parameters.gamma,
            encroachment: parameters.encroachment,
            cage_scale: parameters.cage_scale,
        }
    }

    /// Returns true if cells answer for all of their corners in every domain: its cage surrounds
    /// its inputs.
    pub fn counts_all_corners(&self) -> bool {
        /// A cage surrounds inputs within this fraction of its sphere's radius.
        const SURROUNDED: f64 = 0.8;
        self.epsilon <= SURROUNDED * self.cage_scale
    }
}

/// A simplex of another rank's that shares a vertex with one of this rank.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ghost {
    pub id: u64,
    pub owner: u32,
}

/// A facet between a simplex of this rank and one of another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InterfaceFacet {
    /// Index of the own simplex.
    pub simplex: usize,
    /// The facet is opposite this one of its vertices.
    pub facet: u32,
    /// Index of the other simplex among the ghosts.
    pub ghost: usize,
}

/// A ball of the domain hierarchy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Domain {
    pub id: u64,
    /// The id of the enclosing domain, [`NO_ID`] for the root, which has id 0.
    pub parent: u64,
    /// The id of the vertex at the centre, which another rank may have.
    pub center: u64,
    pub radius: f64,
    /// The coordinates of the centre, in 2D the last 0.
    pub position: [f64; 3],
}

/// A rank's part of a mesh. Vertices and simplices have ids in the whole mesh. That of a vertex
/// that is an input is its index among the inputs of all ranks, of equal ones the least; the others
/// follow.
#[derive(Clone, Debug, Default)]
pub struct DistributedMesh {
    pub dim: usize,
    pub rank: usize,
    pub ranks: usize,
    pub totals: Totals,
    pub promise: Promise,
    /// The number of inputs of the ranks before, and this rank's own.
    pub first_input: u64,
    pub inputs: Vec<f64>,
    /// The vertices that this rank knows: first those of its own simplices, then those that only
    /// ghosts have. Rising ids in both.
    pub vertex_ids: Vec<u64>,
    /// Number of vertices of the own simplices, which come first.
    pub own_vertices: usize,
    /// The lowest rank that has a simplex with the vertex.
    pub vertex_owners: Vec<u32>,
    /// Coordinates of the vertices: `vertices x dim`.
    pub points: Vec<f64>,
    pub kinds: Vec<u8>,
    /// Ids of the innermost domains, [`NO_ID`] where there is none.
    pub vertex_domains: Vec<u64>,
    /// Ids of the domains whose cages they are part of, [`NO_ID`] where there is none.
    pub vertex_cages: Vec<u64>,
    /// The domains that hold a vertex that this rank knows, by rising id.
    pub domains: Vec<Domain>,
    /// The id of the first own simplex; the others follow.
    pub first_simplex: u64,
    /// Vertices of the own simplices: `simplices x (dim + 1)` indices, positively oriented.
    pub simplices: Vec<u32>,
    /// Neighbours of the own simplices: `simplices x (dim + 1)` ids, [`NO_ID`] across the hull.
    pub neighbors: Vec<u64>,
    /// Simplices of other ranks that share a vertex with own ones, sorted by id.
    pub ghosts: Vec<Ghost>,
    /// Vertices of the ghosts: `ghosts x (dim + 1)` indices.
    pub ghost_simplices: Vec<u32>,
    pub interface: Vec<InterfaceFacet>,
    /// Number of bytes that this rank has sent to others.
    pub bytes_sent: u64,
    /// Costs of the steps of the run on this rank, in their order.
    pub work: Vec<Work>,
}

impl DistributedMesh {
    pub fn simplex_count(&self) -> usize {
        self.simplices.len() / (self.dim + 1)
    }

    pub fn point(&self, vertex: u32) -> &[f64] {
        &self.points[vertex as usize * self.dim..][..self.dim]
    }

    pub fn simplex(&self, simplex: usize) -> &[u32] {
        &self.simplices[simplex * (self.dim + 1)..][..self.dim + 1]
    }

    pub fn ghost(&self, ghost: usize) -> &[u32] {
        &self.ghost_simplices[ghost * (self.dim + 1)..][..self.dim + 1]
    }
}
