//! What a run works on: one state, which a partition and the global mesh share, and beside it what
//! only the run itself needs.

use super::cages::domains::Hierarchy;
use super::instruments::observations::Instruments;
use super::partitions::interface::Interface;
use super::partitions::workers::usable_threads;
use super::refinement::refine_list::RefineList;
use super::refinement::size::Sizes;
use super::rounds::conflict_lists::ConflictLists;
use super::rounds::order::{InputId, by_locality};
use super::segments::Segments;
use super::watch::Watch;
use crate::complex::{SimplexId, VertexId, VertexSet};
use crate::delaunay::Delaunay;
use crate::error::{Error, ErrorKind, Name, Result, say};
use crate::memory::{Array, TryGrow, expect, filled};
use crate::mesh::{Inputs, Stats};
use crate::options::{Algorithm, Output, Phase};
use crate::parameters::Parameters;
use rand_pcg::Pcg64Mcg;
use std::cmp::Reverse;
use std::collections::VecDeque;

/// Inputs from which on growing arrays take more time than a progress callback may wait.
const MANY: usize = 1 << 16;

/// The mesh in the making. Vertices `0..inputs` are the distinct inputs in an order of locality,
/// inserted or not; Steiner and cage vertices follow in the order of their insertion.
pub(super) struct State<const D: usize> {
    pub parameters: Parameters,
    pub delaunay: Delaunay<D>,
    pub hierarchy: Hierarchy<D>,
    pub conflict_lists: ConflictLists,
    pub refine_list: RefineList,
    pub segments: Segments,
    /// What a partition must leave as it is. The global mesh has no interface.
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

/// How far a run has come, and which cells it refines.
pub(super) struct Stage {
    pub phase: Phase,
    /// The bound that refinement keeps at the time.
    pub bound: f64,
    /// Whether this is the final refinement, in which a cell answers for all its corners.
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
    /// While inputs go in, refinement keeps a loose bound.
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
pub(super) struct Mesher<'a, 'b, const D: usize> {
    pub state: State<D>,
    pub watch: Watch<'a, 'b>,
    /// Vertex -> distinct input. Empty in a partition.
    pub order: Vec<InputId>,
    /// Simplices that had inputs when they were queued, oldest first: the coarse ones come before
    /// those that replace them. Used by Sparse Voronoi Refinement only.
    pub crowded: VecDeque<SimplexId>,
    /// What a partition reported last.
    pub reported: [u64; 3],
    pub instruments: Instruments,
    pub scratch: Scratch,
    /// The sizes that are asked for, if there are any. A partition has none.
    pub sizes: Option<Sizes<'a, D>>,
}

/// The extent of a vertex's Voronoi cell.
#[derive(Clone, Copy)]
pub(super) struct Cell {
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
pub(super) struct Scratch {
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

pub(super) fn limit(max_vertices: u64, needed: usize) -> Error {
    let message = say!(Name::MaxVertices, " is {max_vertices}; the mesh needs {needed} or more");
    Error::new(ErrorKind::Limit, message)
}

impl<'a, 'b, const D: usize> Mesher<'a, 'b, D> {
    pub(super) fn new(
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
            random: Pcg64Mcg::new(0xcafe_f00d_d15e_a5e5 ^ u128::from(parameters.seed)),
            delaunay,
            hierarchy,
            conflict_lists,
            refine_list: RefineList::new()?,
            segments: Segments::default(),
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
            mesher.expect_usual_size();
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

    /// Reserves memory for the mesh of uniform inputs, so that the arrays of a large run do not
    /// move.
    pub(super) fn expect_usual_size(&mut self) {
        let (vertices, simplices) = match (self.state.parameters.algorithm, D) {
            (Algorithm::Delaunay, 2) => (self.state.inputs, 2),
            (Algorithm::Delaunay, 3) => (self.state.inputs, 7),
            (_, 2) => (3 * self.state.inputs, 2),
            (_, 3) => (3 * self.state.inputs, 7),
            // From 4D on sizes vary more than a reserve is worth.
            _ => return,
        };
        let simplices = simplices * vertices;
        self.state.delaunay.expect(simplices, vertices);
        self.state.conflict_lists.expect(simplices);
        self.state.refine_list.expect(simplices);
        self.state.hierarchy.expect(vertices);
        self.state.cells.expect(vertices);
        expect(&mut self.state.precision_limited, vertices);
    }

    pub(super) fn is_input(&self, vertex: VertexId) -> bool {
        vertex.index() < self.state.inputs
    }

    pub(super) fn is_inserted(&self, vertex: VertexId) -> bool {
        self.state.delaunay.complex().contains_vertex(vertex)
    }

    /// Gives a Steiner or cage point an id.
    ///
    /// # Errors
    /// `Limit` if the mesh may not grow.
    pub(super) fn add_vertex(&mut self, x: [f64; D]) -> Result<VertexId> {
        let count = self.state.delaunay.point_count();
        if count as u64 >= self.state.parameters.max_vertices {
            return Err(limit(self.state.parameters.max_vertices, count + 1));
        }
        self.state.hierarchy.add_vertex()?;
        self.state.cells.try_push(Cell::NEW)?;
        self.state.precision_limited.try_push(false)?;
        Ok(self.state.delaunay.add_point(x)?)
    }

    pub(super) fn report_progress(&mut self) -> Result<()> {
        self.note_progress();
        self.watch.report()
    }

    pub(super) fn note_progress(&mut self) {
        let counts = self.progress_counts();
        if self.state.interface.is_some() {
            self.watch.note_partition(&self.reported, &counts);
            self.reported = counts;
        } else {
            self.watch.note(self.state.stage.phase, self.done(), counts);
        }
    }

    /// Inputs inserted, vertices and simplices.
    pub(super) fn progress_counts(&self) -> [u64; 3] {
        let inserted = self.state.inputs - self.state.conflict_lists.uninserted();
        let vertices = self.state.delaunay.point_count()
            - self.state.conflict_lists.uninserted()
            - self.state.removed.len();
        let simplices = self.state.delaunay.complex().simplex_count();
        [inserted as u64, vertices as u64, simplices as u64]
    }

    /// The part of the run that is done: inputs inserted, then cages dissolved, then simplices that
    /// need no more refinement, by their usual shares of the time.
    pub(super) fn done(&self) -> f64 {
        let [insert, finish] = self.shares();
        let before = match self.state.stage.phase {
            Phase::Prepare | Phase::Insert => {
                let inserted = self.state.inputs - self.state.conflict_lists.remaining();
                insert * inserted as f64 / self.state.inputs as f64
            }
            Phase::Finish if self.state.stage.is_final => {
                insert
                    + finish
                    + (1.0 - insert - finish)
                        * self.state.stage.final_fraction.max(self.usual_final_fraction())
            }
            Phase::Finish => {
                let released = self.state.stats.cages_released as f64;
                insert + finish * released / self.state.hierarchy.len() as f64
            }
            Phase::Export => return 1.0,
        };
        let [sizes, slivers] = self.shares_of_options();
        let before = (1.0 - sizes) * before + sizes * self.state.stage.size_fraction;
        (1.0 - slivers) * before + slivers * self.state.stage.sliver_fraction
    }

    /// What insertion and FINISHMESH are of a run without options that take longer. The rest is the
    /// final refinement.
    fn shares(&self) -> [f64; 2] {
        match (self.state.parameters.algorithm, self.state.parameters.output) {
            (Algorithm::Delaunay, _) => [1.0, 0.0],
            (_, Output::Auto | Output::Hierarchical) => [0.6, 0.0],
            (_, Output::WellSpaced) => [0.3, 0.4],
        }
    }

    /// What sizes are of what is before the slivers, and slivers of the whole run.
    fn shares_of_options(&self) -> [f64; 2] {
        let sizes = if self.sizes.is_some() { 0.8 } else { 0.0 };
        let slivers = if self.state.parameters.min_dihedral > 0.0 { 0.6 } else { 0.0 };
        [sizes, slivers]
    }

    /// The part of the run that is done when partitions are.
    pub(super) fn share_of_partitions(&self) -> f64 {
        let [sizes, slivers] = self.shares_of_options();
        0.95 * (1.0 - sizes) * (1.0 - slivers)
    }

    /// What is bad in one place lets cells around it get bad, and most refinement may come at the
    /// first place. Of a mesh that is not finished yet it makes one twice as large, usually.
    pub(super) fn usual_final_fraction(&self) -> f64 {
        let vertices = self.state.delaunay.point_count() as f64;
        (vertices / self.state.stage.vertices_before_final as f64 - 1.0).min(0.9)
    }
}
