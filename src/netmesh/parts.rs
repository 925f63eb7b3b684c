//! The last refinement of a large mesh in parts, on as many threads as the caller allows. The paper
//! refines in any order (§6.4). A part is a run of simplices in an order of locality, cut out as a mesh
//! of its own, which is refined as the whole would be, but for what would change simplices at its rim or
//! a cage: that is left to the whole. So parts do not know of each other, and when they are put back
//! in their order the mesh does not depend on the number of threads.

use super::domains::Hierarchy;
use super::instruments::Instruments;
use super::location::Location;
use super::refine::RefineList;
use super::svr::Crowded;
use super::watch::{INTERVAL, Watch};
use super::{Cell, Mesher, Parameters, Scratch, limit};
use crate::complex::{Cuts, Names};
use crate::delaunay::Delaunay;
use crate::error::{ErrorKind, Result};
use crate::memory::{Fallible, TryGrow, collected, filled, with_room};
use crate::mesh::{NONE, Stats};
use crate::options::Phase;
use rand_pcg::Pcg64Mcg;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;

/// Simplices of a part: the larger, the less is left at rims; the smaller, the less memory.
const PART: usize = 1 << 16;

/// Parts that are out at a time, whatever the threads: what is put back shows in those cut later.
const WAVE: usize = 8;

/// What threads read while parts are out.
struct Whole<'w, const D: usize> {
    parameters: &'w Parameters,
    delaunay: &'w Delaunay<D>,
    hierarchy: &'w Hierarchy<D>,
    cells: &'w [Cell],
    cuts: &'w Cuts<'w>,
}

/// A part when it is done.
struct Part<const D: usize> {
    names: Names,
    /// Its domain -> the whole's.
    domains: Vec<u32>,
    delaunay: Delaunay<D>,
    hierarchy: Hierarchy<D>,
    cells: Vec<Cell>,
    stats: Stats,
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// Mends what is bad away from cages and from the rims of parts.
    pub(super) fn close_parts(&mut self) -> Result<()> {
        let watch = &mut self.watch;
        self.hierarchy.resolve(|| watch.tick(1))?;
        let order = self.delaunay.complex().order_by_anchor(self.inputs, || watch.tick(1))?;
        let mut places = filled(self.delaunay.complex().simplex_bound(), NONE)?;
        for (place, &simplex) in order.iter().enumerate() {
            places[simplex as usize] = place as u32;
        }
        let cuts = Cuts { order: &order, places: &places };
        let mut next = 0;
        while next < order.len() {
            let mut runs = with_room(WAVE)?;
            while next < order.len() && runs.len() < WAVE {
                let end = order.len().min(next + PART);
                runs.push(next..end);
                next = end;
            }
            for part in self.close_wave(&cuts, &runs)? {
                self.put_back(part)?;
                self.watch.look()?;
            }
            self.closed = next as f64 / order.len() as f64;
            self.report_progress()?;
        }
        Ok(())
    }

    fn close_wave(&mut self, cuts: &Cuts<'_>, runs: &[Range<usize>]) -> Result<Vec<Part<D>>> {
        let whole = Whole {
            parameters: &self.parameters,
            delaunay: &self.delaunay,
            hierarchy: &self.hierarchy,
            cells: &self.cells,
            cuts,
        };
        let threads = threads(self.parameters.threads).min(runs.len());
        if threads > 1 {
            return whole.refine_on(threads, runs, &mut self.watch);
        }
        let mut ids = filled(self.delaunay.point_count(), NONE)?;
        let mut parts = with_room(runs.len())?;
        for run in runs {
            let watch = std::mem::replace(&mut self.watch, Watch::new(None));
            let (watch, part) = whole.refine(run.clone(), &mut ids, watch);
            self.watch = watch;
            parts.push(part?);
        }
        Ok(parts)
    }

    /// Puts a part in the place of what it was cut out of.
    fn put_back(&mut self, part: Part<D>) -> Result<()> {
        let Part { mut names, domains, delaunay, hierarchy, cells, stats } = part;
        let known = names.vertices.len();
        let count = self.delaunay.point_count() + delaunay.point_count() - known;
        if count as u64 > self.parameters.max_vertices {
            return Err(limit(self.parameters.max_vertices, count));
        }
        let is_shared = delaunay.vertices_at_rim(names.simplices.len() as u32, known)?;
        self.delaunay.put_back(&delaunay, &mut names)?;
        for (own, &vertex) in names.vertices.iter().enumerate() {
            let cell = cells[own];
            if own < known {
                let whole = &mut self.cells[vertex as usize];
                whole.nearest = whole.nearest.min(cell.nearest);
                let others = if is_shared[own] { whole.farthest } else { 0.0 };
                whole.farthest = cell.farthest.max(others);
            } else {
                self.hierarchy.add_vertex()?;
                self.hierarchy.set_domain(vertex, domains[hierarchy.label(own as u32) as usize]);
                self.cells.try_push(cell)?;
                self.precision_limited.try_push(false)?;
            }
        }
        names.simplices.retain(|&simplex| simplex != NONE);
        self.refine.forget(&names.simplices, self.delaunay.complex().simplex_bound())?;
        self.stats.far_corners += stats.far_corners;
        self.stats.off_centers += stats.off_centers;
        Ok(())
    }

    /// All that a part can mend by itself.
    fn close_part(&mut self) -> Result<()> {
        self.refine.sort_by_length()?;
        self.close_tiles(None)
    }

    /// Whether the insertion of `x`, whose conflicts are the scratch cavity, leaves a part's frozen
    /// simplices and all cages as they are.
    pub(super) fn stays_in_part(&mut self, x: &[f64; D]) -> bool {
        let conflicts = &self.scratch.cavity.simplices;
        if conflicts.iter().any(|&conflict| self.refine.is_frozen(conflict)) {
            return false;
        }
        // The vertices of one that is not frozen are of one domain; so are those of its neighbours.
        let vertex = self.delaunay.complex().vertices(conflicts[0])[0];
        let domain = self.hierarchy.domain_of(vertex);
        self.hierarchy.contains(domain, x)
    }

    /// Freezes the simplices at the rim, at the hull, and those with a vertex of a cage or vertices of
    /// several domains.
    fn freeze(&mut self) -> Fallible<()> {
        let complex = self.delaunay.complex();
        self.refine.forget(&[], complex.simplex_bound())?;
        for simplex in 0..complex.simplex_bound() as u32 {
            let vertices = complex.vertices(simplex);
            let is_frozen = complex.is_at_rim(simplex)
                || complex.is_infinite(simplex)
                || !self.hierarchy.is_alike(vertices)
                || vertices.iter().any(|&vertex| self.hierarchy.cage_of(vertex) != NONE);
            if is_frozen {
                self.refine.freeze(simplex);
            }
        }
        Ok(())
    }
}

impl<const D: usize> Whole<'_, D> {
    /// Cuts out the simplices of `run` and refines them. `ids`: see [`Delaunay::part`].
    fn refine<'a, 'b>(
        &self,
        run: Range<usize>,
        ids: &mut [u32],
        watch: Watch<'a, 'b>,
    ) -> (Watch<'a, 'b>, Result<Part<D>>) {
        let cut = self.cut(run, ids);
        let (mut mesher, names, domains) = match cut {
            Ok(cut) => cut,
            Err(shortage) => return (watch, Err(shortage.into())),
        };
        mesher.watch = watch;
        let closed = mesher.close_part().map_err(|error| match error.kind() {
            ErrorKind::Limit => limit(
                self.parameters.max_vertices,
                self.parameters.max_vertices as usize + 1,
            ),
            _ => error,
        });
        let Mesher { delaunay, hierarchy, cells, stats, watch, .. } = mesher;
        let part = closed.map(|()| Part { names, domains, delaunay, hierarchy, cells, stats });
        (watch, part)
    }

    #[allow(clippy::type_complexity)]
    fn cut<'a, 'b>(
        &self,
        run: Range<usize>,
        ids: &mut [u32],
    ) -> Fallible<(Mesher<'a, 'b, D>, Names, Vec<u32>)> {
        let (delaunay, names) = self.delaunay.part(self.cuts, run, ids)?;
        let (hierarchy, domains) = self.hierarchy.part(&names.vertices)?;
        let vertices = names.vertices.len();
        let others = (self.delaunay.point_count() - vertices) as u64;
        let parameters = Parameters {
            max_vertices: self.parameters.max_vertices - others,
            instruments: false,
            ..self.parameters.clone()
        };
        let mut mesher = Mesher {
            delaunay,
            hierarchy,
            location: Location::new(0)?,
            refine: RefineList::new()?,
            crowded: Crowded::default(),
            phase: Phase::Finish,
            bound: parameters.quality_bound,
            closing: true,
            is_part: true,
            closed: 0.0,
            before_closing: vertices,
            cells: collected(names.vertices.iter().map(|&vertex| self.cells[vertex as usize]))?,
            precision_limited: filled(vertices, false)?,
            inputs: 0,
            order: Vec::new(),
            template: Vec::new(),
            random: Pcg64Mcg::new(0),
            watch: Watch::new(None),
            stats: Stats::default(),
            instruments: Instruments::default(),
            scratch: Scratch::default(),
            parameters,
        };
        mesher.freeze()?;
        Ok((mesher, names, domains))
    }

    /// Refines all `runs`, each on one of several threads, while this one watches for the caller.
    fn refine_on(
        &self,
        threads: usize,
        runs: &[Range<usize>],
        watch: &mut Watch<'_, '_>,
    ) -> Result<Vec<Part<D>>> {
        let (stop, next) = (AtomicBool::new(false), AtomicUsize::new(0));
        let (sender, receiver) = mpsc::channel();
        let mut parts: Vec<Option<Result<Part<D>>>> = with_room(runs.len())?;
        parts.resize_with(runs.len(), || None);
        let watched = std::thread::scope(|scope| {
            for _ in 0..threads {
                let sender = sender.clone();
                let (stop, next) = (&stop, &next);
                scope.spawn(move || self.refine_next(runs, next, stop, &sender));
            }
            drop(sender);
            loop {
                match receiver.recv_timeout(INTERVAL) {
                    Ok((at, part)) => parts[at] = Some(part),
                    Err(mpsc::RecvTimeoutError::Timeout) => {
                        if let Err(error) = watch.look() {
                            stop.store(true, Ordering::Relaxed);
                            return Err(error);
                        }
                    }
                    Err(mpsc::RecvTimeoutError::Disconnected) => return Ok(()),
                }
            }
        });
        watched?;
        let mut done = with_room(parts.len())?;
        for part in parts {
            done.push(part.expect("every run is refined")?);
        }
        Ok(done)
    }

    /// Refines the next of the `runs` until there is none.
    fn refine_next(
        &self,
        runs: &[Range<usize>],
        next: &AtomicUsize,
        stop: &AtomicBool,
        sender: &mpsc::Sender<(usize, Result<Part<D>>)>,
    ) {
        let mut ids = match filled(self.delaunay.point_count(), NONE) {
            Ok(ids) => ids,
            Err(_) => Vec::new(),
        };
        loop {
            let at = next.fetch_add(1, Ordering::Relaxed);
            let Some(run) = runs.get(at) else { return };
            let part = match ids.is_empty() {
                true => Err(crate::memory::Shortage::Memory.into()),
                false => self.refine(run.clone(), &mut ids, Watch::until(stop)).1,
            };
            if sender.send((at, part)).is_err() {
                return;
            }
        }
    }
}

/// Threads that the caller allows.
fn threads(wanted: u32) -> usize {
    match wanted {
        0 => std::thread::available_parallelism().map_or(1, |count| count.get()),
        _ => wanted as usize,
    }
}
