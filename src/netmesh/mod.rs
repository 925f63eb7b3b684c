//! The paper's algorithm (§6), one file per operation: `start` (the root cage and first homes),
//! `net` (SELECTROUND and NET), `round` (the main loop), `insert` (INSERTINPUT, INSERT), `cage` (NEWCAGE,
//! GROWCAGE, RELEASECAGE), `site` (MEDIALITY and the cages' radii),
//! `encroach` (INENCROACH, OUTENCROACH), `clean` (CLEAN, YIELDINGINSERT), `refine` (REFINELIST), `quality`
//! (Definition 4 as the refinement tests it), `finish` (FINISHMESH), `close` (the bound for all cells),
//! `order` (locality of inputs),
//! `steiner` (where a Steiner point goes), `svr` (§3, the baseline). `instruments` measures what the
//! theorems promise.

mod cage;
mod clean;
mod close;
mod domains;
mod encroach;
mod finish;
mod insert;
mod instruments;
mod location;
mod net;
mod order;
mod output;
mod parameters;
mod parts;
mod quality;
mod refine;
mod rim;
mod round;
mod sight;
mod site;
mod start;
mod steiner;
mod svr;
mod template;
mod threads;
mod watch;

use crate::complex::VertexSet;
use crate::delaunay::{Cavity, Delaunay};
use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::{Array, TryGrow, expect, filled};
use crate::mesh::{Inputs, NONE, Stats, Triangulation};
use crate::options::{Algorithm, Options, Output, Phase, ProgressFn};
use crate::parameters::Parameters;
use domains::Hierarchy;
use instruments::Instruments;
use location::Location;
use order::by_locality;
use rand_pcg::Pcg64Mcg;
use refine::RefineList;
use rim::Rim;
use std::cmp::Reverse;
use std::time::Instant;
use svr::Crowded;
use watch::Watch;

/// Inputs from which on growing arrays take more time than a progress callback may wait.
const MANY: usize = 1 << 16;

/// Meshes `inputs`. The one place that picks the monomorphisation for the dimension.
///
/// # Errors
/// `InvalidArgument`, `DegenerateInput`, `Limit`, `Cancelled`, `OutOfMemory`.
pub fn run(
    inputs: &Inputs,
    options: &Options,
    progress: Option<&mut ProgressFn<'_>>,
) -> Result<Triangulation> {
    let parameters = Parameters::resolve(inputs.dim(), options)?;
    match inputs.dim() {
        2 => mesh::<2>(inputs, parameters, progress),
        3 => mesh::<3>(inputs, parameters, progress),
        4 => mesh::<4>(inputs, parameters, progress),
        5 => mesh::<5>(inputs, parameters, progress),
        6 => mesh::<6>(inputs, parameters, progress),
        7 => mesh::<7>(inputs, parameters, progress),
        8 => mesh::<8>(inputs, parameters, progress),
        dim => unreachable!("inputs of dimension {dim} are refused when they are made"),
    }
}

fn mesh<const D: usize>(
    inputs: &Inputs,
    parameters: Parameters,
    progress: Option<&mut ProgressFn<'_>>,
) -> Result<Triangulation> {
    let begun = Instant::now();
    let mut watch = Watch::new(progress);
    // Also the shortest run can be watched and cancelled.
    watch.report()?;
    let mut mesher = Mesher::<D>::new(inputs, parameters, watch)?;
    if mesher.parameters.algorithm == Algorithm::Delaunay {
        mesher.start_delaunay()?;
        mesher.insert_rounds()?;
    } else {
        mesher.start_netmesh()?;
        match mesher.parameters.algorithm {
            Algorithm::Svr => mesher.insert_sparsely()?,
            _ => {
                mesher.insert_rounds_until(Mesher::is_ready_for_parts)?;
                mesher.insert_in_parts()?;
                mesher.insert_rounds()?;
            }
        }
        if mesher.parameters.output == Output::WellSpaced {
            mesher.finish_mesh()?;
        }
        mesher.close()?;
    }
    mesher.into_triangulation(begun)
}

/// The state of a run. Vertices `0..inputs` are the distinct inputs in an order of locality, inserted
/// or not; Steiner and cage vertices follow in the order of their insertion.
struct Mesher<'a, 'b, const D: usize> {
    parameters: Parameters,
    delaunay: Delaunay<D>,
    hierarchy: Hierarchy<D>,
    location: Location,
    refine: RefineList,
    rim: Rim,
    crowded: Crowded,
    phase: Phase,
    /// The bound that refinement keeps at the time.
    bound: f64,
    /// Whether cells answer for all their corners, and the part of the mesh where they do (`close`).
    closing: bool,
    closed: f64,
    /// Vertices when that began.
    before_closing: usize,
    /// What a part reported last.
    reported: [u64; 3],
    /// Vertex -> the extent of its Voronoi cell.
    cells: Array<Cell>,
    /// Vertices next to which doubles ran out when a cage was wanted.
    precision_limited: Vec<bool>,
    /// Number of distinct inputs.
    inputs: usize,
    /// Vertex -> distinct input.
    order: Vec<u32>,
    /// Directions of the cage's vertices from its centre.
    template: Vec<[f64; D]>,
    /// Not used by a deterministic ordering.
    random: Pcg64Mcg,
    watch: Watch<'a, 'b>,
    stats: Stats,
    instruments: Instruments,
    scratch: Scratch,
}

/// The extent of a vertex's Voronoi cell.
#[derive(Clone, Copy)]
struct Cell {
    /// The distance to the nearest neighbour in the mesh.
    nearest: f64,
    /// No smaller than the radius of any D-ball at the vertex, that is its farthest corner.
    farthest: f64,
}

impl Cell {
    const NEW: Self = Self { nearest: f64::INFINITY, farthest: 0.0 };
}

/// Buffers that every insertion uses again.
#[derive(Default)]
struct Scratch {
    cavity: Cavity,
    created: Vec<u32>,
    star: Array<u32>,
    /// Vertices whose nearest distance fell.
    nearer: Array<u32>,
    /// New simplices that may be bad.
    suspects: Array<u32>,
    /// The vertices next to a cage that is released.
    affected: VertexSet,
    /// Simplices, and their inputs' distances, near a cage that is wanted.
    near: Vec<u32>,
    gaps: Vec<Reverse<u64>>,
}

impl<'a, 'b, const D: usize> Mesher<'a, 'b, D> {
    fn new(inputs: &Inputs, parameters: Parameters, mut watch: Watch<'a, 'b>) -> Result<Self> {
        let count = inputs.distinct();
        if count as u64 > parameters.max_vertices {
            return Err(limit(parameters.max_vertices, count));
        }
        let order = by_locality::<D>(inputs, &mut watch)?;
        let mut points = Array::with_room(count)?;
        for &input in &order {
            watch.poll_after(1)?;
            points.try_push(inputs.distinct_point(input as usize).try_into().expect("dim is D"))?;
        }
        let delaunay = Delaunay::new(points)?;
        watch.poll()?;
        let hierarchy = Hierarchy::new(count)?;
        watch.poll()?;
        let location = Location::new(count)?;
        watch.poll()?;
        let mut mesher = Self {
            random: Pcg64Mcg::new(0xcafe_f00d_d15e_a5e5 ^ u128::from(parameters.seed)),
            delaunay,
            hierarchy,
            location,
            refine: RefineList::new()?,
            rim: Rim::default(),
            crowded: Crowded::default(),
            phase: Phase::Insert,
            bound: parameters.loose_bound(),
            closing: false,
            closed: 0.0,
            before_closing: 0,
            reported: [0; 3],
            cells: Array::filled(count, Cell::NEW)?,
            precision_limited: filled(count, false)?,
            inputs: count,
            order,
            template: Vec::new(),
            watch,
            stats: Stats::default(),
            instruments: Instruments::default(),
            scratch: Scratch::default(),
            parameters,
        };
        mesher.watch.poll()?;
        if count >= MANY {
            mesher.expect_usual_size();
        }
        Ok(mesher)
    }

    /// Makes room for the mesh of uniform inputs, so that the arrays of a large run do not move.
    fn expect_usual_size(&mut self) {
        let (vertices, simplices) = match (self.parameters.algorithm, D) {
            (Algorithm::Delaunay, 2) => (self.inputs, 2),
            (Algorithm::Delaunay, 3) => (self.inputs, 7),
            (_, 2) => (3 * self.inputs, 2),
            (_, 3) => (3 * self.inputs, 7),
            // From 4D on sizes vary more than room is worth.
            _ => return,
        };
        let simplices = simplices * vertices;
        self.delaunay.expect(simplices, vertices);
        self.location.expect(simplices);
        self.refine.expect(simplices);
        self.hierarchy.expect(vertices);
        self.cells.expect(vertices);
        expect(&mut self.precision_limited, vertices);
    }

    fn is_input(&self, vertex: u32) -> bool {
        (vertex as usize) < self.inputs
    }

    fn is_inserted(&self, vertex: u32) -> bool {
        self.delaunay.complex().contains_vertex(vertex)
    }

    /// Gives a Steiner or cage point an id.
    ///
    /// # Errors
    /// `Limit` if the mesh may not grow.
    fn add_vertex(&mut self, x: [f64; D]) -> Result<u32> {
        let count = self.delaunay.point_count();
        if count as u64 >= self.parameters.max_vertices {
            return Err(limit(self.parameters.max_vertices, count + 1));
        }
        self.hierarchy.add_vertex()?;
        self.cells.try_push(Cell::NEW)?;
        self.precision_limited.try_push(false)?;
        Ok(self.delaunay.add_point(x)?)
    }

    fn report_progress(&mut self) -> Result<()> {
        self.note_progress();
        self.watch.report()
    }

    fn note_progress(&mut self) {
        let counts = self.progress_counts();
        if self.rim.is_some() {
            self.watch.note_part(&self.reported, &counts);
            self.reported = counts;
        } else {
            self.watch.note(self.phase, self.done(), counts);
        }
    }

    /// Inputs inserted, vertices and simplices.
    fn progress_counts(&self) -> [u64; 3] {
        let inserted = self.inputs - self.location.uninserted();
        let vertices = self.delaunay.point_count() - self.location.uninserted();
        let simplices = self.delaunay.complex().simplex_count();
        [inserted as u64, vertices as u64, simplices as u64]
    }

    /// The part of the run that is done: inputs inserted, then cages dissolved, then simplices that
    /// need no more refinement, by their usual shares of the time.
    fn done(&self) -> f64 {
        let [insert, finish] = match (self.parameters.algorithm, self.parameters.output) {
            (Algorithm::Delaunay, _) => [1.0, 0.0],
            (_, Output::Hierarchical) => [0.6, 0.0],
            (_, Output::WellSpaced) => [0.3, 0.4],
        };
        match self.phase {
            Phase::Prepare | Phase::Insert => {
                let inserted = self.inputs - self.location.remaining();
                insert * inserted as f64 / self.inputs as f64
            }
            Phase::Finish if self.closing => {
                insert + finish + (1.0 - insert - finish) * self.closed.max(self.usually_closed())
            }
            Phase::Finish => {
                let released = self.stats.cages_released as f64;
                insert + finish * released / f64::from(self.hierarchy.len())
            }
            Phase::Export => 1.0,
        }
    }

    /// What is bad in one place lets cells around it get bad, and most refinement may come at the first
    /// place. Of a mesh that is not finished yet it makes one twice as large, usually.
    fn usually_closed(&self) -> f64 {
        let vertices = self.delaunay.point_count() as f64;
        (vertices / self.before_closing as f64 - 1.0).min(0.9)
    }
}

fn limit(max_vertices: u64, needed: usize) -> Error {
    let message =
        message!("options.max_vertices is {max_vertices}; the mesh needs {needed} or more");
    Error::new(ErrorKind::Limit, message)
}

/// Whether an id names something.
fn some(id: u32) -> Option<u32> {
    (id != NONE).then_some(id)
}
