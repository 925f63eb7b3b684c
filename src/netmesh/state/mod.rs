//! The state of a run. `State` is the mesh in the making, which a partition and the global mesh
//! both have; `Mesher` is a run: a state, the watch over it, and the buffers of its steps. All
//! other folders are methods of these two.
//!
//! - `hierarchy`: the tree of domains, and the domain of every vertex.
//! - `conflict_lists`: the uninserted inputs of every simplex.
//! - `refine_list`: REFINELIST, the simplices that are to be refined.
//! - `interface`: the simplices and domains that a partition must leave as they are.
//! - `segments`: the chains of edges that segments have become, and the regions between them.
//! - `facets`: the sheets of triangles that facets have become.
//! - `sizes`: the sizes that the caller asks for.
//! - `observations`: the memory of the instruments.
//! - `parameters`: the numbers that follow from the options.
//! - `order`: the order of locality, in which inputs are numbered.
//! - `watch` and `progress`: the clock, the caller's function, and the numbers that it gets.
//! - `workers`: work that threads share.
//! - `bits`: sets of numbers as 64 bits.
//!
//! A part of the state belongs here with the methods that need no other part.

pub(super) mod bits;
pub(super) mod conflict_lists;
pub(super) mod facets;
pub(super) mod hierarchy;
pub(super) mod interface;
pub(super) mod observations;
pub(super) mod order;
pub(super) mod parameters;
pub(super) mod progress;
pub(super) mod refine_list;
pub(super) mod segments;
pub(super) mod sizes;
pub(super) mod watch;
pub(super) mod workers;

use crate::complex::{SimplexId, VertexId, VertexSet};
use crate::delaunay::Delaunay;
use crate::error::{Error, ErrorKind, Name, Result, say};
use crate::memory::{Array, TryGrow, expect, filled};
use crate::mesh::{Inputs, Stats};
use crate::netmesh::state::conflict_lists::ConflictLists;
use crate::netmesh::state::facets::Facets;
use crate::netmesh::state::hierarchy::Hierarchy;
use crate::netmesh::state::interface::Interface;
use crate::netmesh::state::observations::Instruments;
use crate::netmesh::state::order::{InputId, by_locality};
use crate::netmesh::state::parameters::{partition_count, usable_threads};
use crate::netmesh::state::refine_list::RefineList;
use crate::netmesh::state::segments::SegmentState;
use crate::netmesh::state::sizes::Sizes;
use crate::netmesh::state::watch::Watch;
use crate::numerics::random_numbers;
use crate::options::{Algorithm, Phase};
use crate::parameters::Parameters;
use rand_pcg::Pcg64Mcg;
use std::any::Any;
use std::cmp::Reverse;
use std::collections::VecDeque;

/// Inputs from which on growing arrays take more time than a progress callback may wait.
const MANY: usize = 1 << 16;

/// The mesh in the making. Vertices `0..inputs` are the distinct inputs in an order of locality,
/// inserted or not; Steiner and cage vertices follow in the order of their insertion.
pub(in crate::netmesh) struct State<const D: usize> {
    pub parameters: Parameters,
    pub delaunay: Delaunay<D>,
    pub hierarchy: Hierarchy<D>,
    pub conflict_lists: ConflictLists,
    pub refine_list: RefineList,
    pub segments: SegmentState,
    pub facets: Facets,
    /// Simplices and domains that a partition must leave as they are. The global mesh has none.
    pub interface: Interface,
    pub stage: Stage,
    /// Vertex -> the extent of its Voronoi cell.
    pub cells: Array<Cell>,
    /// Vertices next to which doubles ran out when a cage was wanted.
    pub precision_limited: Vec<bool>,
    /// Number of distinct inputs.
    pub inputs: usize,
    /// Ids that are no vertices any more, in rising order.
    pub removed: Vec<VertexId>,
    /// Directions of the cage's vertices from its centre.
    pub template: Vec<[f64; D]>,
    /// Not used by a deterministic ordering.
    pub random: Pcg64Mcg,
    pub stats: Stats,
}

/// Stage of a run: the progress that it has made, and the cells that it refines.
pub(in crate::netmesh) struct Stage {
    pub phase: Phase,
    /// The bound that refinement keeps at the time.
    pub bound: f64,
    /// True in the final refinement, in which a cell answers for all its corners.
    pub is_final: bool,
    /// The fraction of the final refinement that is done.
    pub final_fraction: f64,
    /// The fraction of the refinement by size that is done.
    pub size_fraction: f64,
    /// The fraction of the work on slivers that is done.
    pub sliver_fraction: f64,
    /// The number of vertices when the final refinement began.
    pub vertices_before_final: usize,
}

impl Stage {
    /// Returns the stage of insertion, in which refinement keeps the loose `bound`.
    pub fn of_insertion(bound: f64) -> Self {
        Self {
            phase: Phase::Insert,
            bound,
            is_final: false,
            final_fraction: 0.0,
            size_fraction: 0.0,
            sliver_fraction: 0.0,
            vertices_before_final: 0,
        }
    }
}

/// A run: the state, the watch over it, and what a partition does without.
pub(in crate::netmesh) struct Mesher<'a, 'b, const D: usize> {
    pub state: State<D>,
    pub watch: Watch<'a, 'b>,
    /// Vertex -> distinct input. Empty in a partition.
    pub order: Vec<InputId>,
    /// Simplices that had inputs when they were queued, oldest first: the coarse ones come before
    /// those that replace them. Used by Sparse Voronoi Refinement only.
    pub crowded: VecDeque<SimplexId>,
    /// Counts that a partition reported last.
    pub reported: [u64; 3],
    pub instruments: Instruments,
    pub scratch: Scratch,
    /// The sizes that are asked for, if there are any. A partition has none.
    pub sizes: Option<Sizes<'a, D>>,
}

/// The extent of a vertex's Voronoi cell.
#[derive(Clone, Copy)]
pub(in crate::netmesh) struct Cell {
    /// The distance to the nearest neighbour in the mesh.
    pub nearest: f64,
    /// No smaller than the radius of any D-ball at the vertex, that is its farthest corner.
    pub farthest: f64,
}

impl Cell {
    pub const NEW: Self = Self { nearest: f64::INFINITY, farthest: 0.0 };
}

/// Buffers that every insertion uses again.
#[derive(Default)]
pub(in crate::netmesh) struct Scratch {
    pub created: Vec<SimplexId>,
    pub star: Array<SimplexId>,
    /// Vertices whose nearest distance fell.
    pub nearer: Array<VertexId>,
    /// New simplices that may be bad.
    pub suspects: Array<SimplexId>,
    /// The vertices next to a cage that is released.
    pub affected: VertexSet,
    /// Simplices, and their inputs' distances, near a cage that is wanted.
    pub near: Vec<SimplexId>,
    pub distances: Vec<Reverse<u64>>,
}

pub(in crate::netmesh) fn limit(max_vertices: u64, needed: usize) -> Error {
    let message = say!(Name::MaxVertices, " is {max_vertices}; the mesh needs {needed} or more");
    Error::new(ErrorKind::Limit, message)
}

impl<'a, 'b, const D: usize> Mesher<'a, 'b, D> {
    pub(in crate::netmesh) fn new(
        inputs: &Inputs,
        parameters: Parameters,
        mut watch: Watch<'a, 'b>,
    ) -> Result<Self> {
        let count = inputs.distinct();
        if count as u64 > parameters.max_vertices {
            return Err(limit(parameters.max_vertices, count));
        }
        let threads = usable_threads::<D>(&parameters, count);
        let order = by_locality::<D>(inputs, threads, &mut watch)?;
        let mut points = Array::with_capacity(count)?;
        for &input in &order {
            watch.poll_after(1)?;
            points.try_push(inputs.distinct_point(input.index()).try_into().expect("dim is D"))?;
        }
        let delaunay = Delaunay::new(points)?;
        watch.poll()?;
        let hierarchy = Hierarchy::new(count)?;
        watch.poll()?;
        let conflict_lists = ConflictLists::new(count)?;
        watch.poll()?;
        let state = State {
            random: random_numbers(parameters.seed, 0),
            delaunay,
            hierarchy,
            conflict_lists,
            refine_list: RefineList::new()?,
            segments: SegmentState::default(),
            facets: Facets::default(),
            interface: Interface::default(),
            stage: Stage::of_insertion(parameters.loose_bound()),
            cells: Array::filled(count, Cell::NEW)?,
            precision_limited: filled(count, false)?,
            inputs: count,
            removed: Vec::new(),
            template: Vec::new(),
            stats: Stats::default(),
            parameters,
        };
        let mut mesher = Self::resume(state, watch);
        mesher.order = order;
        mesher.watch.poll()?;
        if count >= MANY {
            mesher.state.expect_usual_size();
        }
        Ok(mesher)
    }

    /// Goes on from `state`.
    pub fn resume(state: State<D>, watch: Watch<'a, 'b>) -> Self {
        Self {
            state,
            watch,
            order: Vec::new(),
            crowded: VecDeque::new(),
            reported: [0; 3],
            instruments: Instruments::default(),
            scratch: Scratch::default(),
            sizes: None,
        }
    }
}

impl<const D: usize> State<D> {
    /// Returns the state as one of space, which alone has facets; `None` in other dimensions.
    pub(in crate::netmesh) fn in_space(&mut self) -> Option<&mut State<3>> {
        (self as &mut dyn Any).downcast_mut()
    }

    /// Returns the state as one of space; `None` in other dimensions.
    pub(in crate::netmesh) fn as_space(&self) -> Option<&State<3>> {
        (self as &dyn Any).downcast_ref()
    }

    /// Reserves memory for the mesh of uniform inputs, so that the arrays of a large run do not
    /// move.
    fn expect_usual_size(&mut self) {
        let (vertices, simplices) = match (self.parameters.algorithm, D) {
            (Algorithm::Delaunay, 2) => (self.inputs, 2),
            (Algorithm::Delaunay, 3) => (self.inputs, 7),
            (_, 2) => (3 * self.inputs, 2),
            (_, 3) => (3 * self.inputs, 7),
            // From 4D on sizes vary more than a reserve is worth.
            _ => return,
        };
        let simplices = simplices * vertices;
        self.delaunay.expect(simplices, vertices);
        self.conflict_lists.expect(simplices);
        self.refine_list.expect(simplices);
        self.hierarchy.expect(vertices);
        self.cells.expect(vertices);
        expect(&mut self.precision_limited, vertices);
    }

    pub(in crate::netmesh) fn is_input(&self, vertex: VertexId) -> bool {
        vertex.index() < self.inputs
    }

    pub(in crate::netmesh) fn is_inserted(&self, vertex: VertexId) -> bool {
        self.delaunay.complex().contains_vertex(vertex)
    }

    /// Gives a Steiner or cage point an id.
    ///
    /// # Errors
    /// `Limit` if the mesh may not grow.
    pub(in crate::netmesh) fn add_vertex(&mut self, x: [f64; D]) -> Result<VertexId> {
        let count = self.delaunay.point_count();
        if count as u64 >= self.parameters.max_vertices {
            return Err(limit(self.parameters.max_vertices, count + 1));
        }
        self.hierarchy.add_vertex()?;
        self.cells.try_push(Cell::NEW)?;
        self.precision_limited.try_push(false)?;
        Ok(self.delaunay.add_point(x)?)
    }

    /// Returns the number of threads for work that changes nothing ([`usable_threads`]).
    pub(in crate::netmesh) fn threads(&self) -> usize {
        usable_threads::<D>(&self.parameters, self.inputs)
    }

    /// Returns the number of partitions that the mesh is made in, if it is.
    pub(in crate::netmesh) fn partition_count(&self) -> Option<usize> {
        partition_count::<D>(&self.parameters, self.inputs)
    }
}
