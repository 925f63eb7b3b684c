//! The final refinement, once all inputs are in: to the bound that the caller asked for, over all
//! corners of all cells.
//!
//! While inputs go in the bound is looser, and a cell answers only for its corners inside the hull
//! of its domain's cage (`quality`): refinement up to the cage would destroy the cage. That leaves
//! gaps between the vertices of coarse cages, through which cells look out. Now every corner counts
//! (`cage_gap`). Then Definition 4 holds as it stands, over all corners.
//!
//! It ends as Ruppert's refinement of a domain with a smooth boundary does ("A Delaunay refinement
//! algorithm for quality 2-dimensional mesh generation", 1995). Inputs keep away from the sphere
//! (Definition 2), and Steiner points do by `NEAR` times their insertion radius. A corner beyond
//! the sphere sees it through a cap that no vertex is in, so its projection is at least as far from
//! all vertices as the cap is high. That is as deep as the vertex inside lies. What this argument's
//! constants do not cover, `SPACING` ends; no run with default options came to that.

use crate::complex::SimplexId;
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::netmesh::questions::bad_simplex::Scan;
use crate::netmesh::state::{Mesher, State};
use crate::options::Phase;

/// The number of simplices of a tile, and of a mesh that is refined without tiles. What is refined
/// at a time stays in the cache, which halves the time of large meshes. The order by length is kept
/// within tiles only, which costs up to 0.6 % more vertices, and 3 % around close pairs
/// (docs/decisions.md).
const TILE: usize = 1 << 12;

const SMALL: usize = 1 << 17;

/// Tiles of a mesh with segments and a bound below `TIGHT`, where the order by length is worth 1.5
/// % of the vertices, and a quarter of the time.
const LARGE_TILE: usize = 1 << 15;

const TIGHT: f64 = 1.1;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Refines until no cell is bad over all its corners. Insertions examine what they change. But
    /// a cage's union cell may have corners at simplices without a vertex of the cage, which are
    /// not examined when its clearance falls. So all simplices that span domains are scanned until
    /// none is bad. Partitions have left little to do.
    pub(in crate::netmesh) fn refine_finally(&mut self, cavity: &mut Cavity) -> Result<()> {
        self.begin_final_refinement()?;
        let mut scan = Scan::All;
        if self.state.delaunay.complex().simplex_count() > SMALL
            && self.state.partition_count().is_none()
        {
            self.refine_tiles(cavity)?;
            scan = Scan::SpanningDomains;
        }
        while self.refine_scanned(scan, cavity)? || self.state.lower_guard_in_space()? {
            // What stays as it is beside facets depends on more than the simplices there.
            let is_done = self.state.facets.is_empty();
            scan = if is_done { Scan::SpanningDomains } else { Scan::All };
        }
        debug_assert!(
            !self.state.is_any_open(),
            "a simplex that spans no domains was examined when it changed"
        );
        self.state.stage.final_fraction = 1.0;
        self.report_progress()
    }

    /// Does the first scan of a partition. The global mesh finds what it leaves bad.
    pub(in crate::netmesh) fn refine_partition_finally(
        &mut self,
        cavity: &mut Cavity,
    ) -> Result<()> {
        self.begin_final_refinement()?;
        self.refine_tiles(cavity)
    }

    /// Does the scans that come after the first one, in a partition that no global mesh takes over.
    pub(in crate::netmesh) fn refine_spanning_domains(
        &mut self,
        cavity: &mut Cavity,
    ) -> Result<()> {
        while self.refine_scanned(Scan::SpanningDomains, cavity)? {}
        Ok(())
    }

    fn begin_final_refinement(&mut self) -> Result<()> {
        self.state.stage.bound = self.state.parameters.quality_bound;
        self.state.stage.is_final = true;
        self.state.stage.vertices_before_final = self.state.delaunay.point_count();
        self.state.stage.phase = Phase::Finish;
        self.report_progress()?;
        Ok(self.state.refine_list.sort_by_length()?)
    }

    /// Does the first scan, one tile after the other.
    fn refine_tiles(&mut self, cavity: &mut Cavity) -> Result<()> {
        let watch = &mut self.watch;
        let complex = self.state.delaunay.complex();
        let anchors = self.state.inputs.max(1);
        let order = complex.order_by_anchor(anchors, || watch.poll_after(1))?.order;
        let length = self.state.tile_length();
        for (at, tile) in order.chunks(length).enumerate() {
            self.refine_simplices(tile, cavity)?;
            self.state.stage.final_fraction = (at * length) as f64 / order.len() as f64;
            self.note_progress();
        }
        Ok(())
    }

    /// Mends the bad ones of some simplices, and all that becomes bad by it.
    fn refine_simplices(&mut self, simplices: &[SimplexId], cavity: &mut Cavity) -> Result<()> {
        for &simplex in simplices {
            self.watch.poll_after(1)?;
            if self.state.delaunay.complex().is_live(simplex) {
                self.state.examine(simplex)?;
            }
        }
        self.clean(cavity)
    }

    /// Mends the simplices that are found bad in a scan. Returns whether any was.
    fn refine_scanned(&mut self, scan: Scan, cavity: &mut Cavity) -> Result<bool> {
        for simplex in self.suspects(scan)?.into_iter().flatten() {
            self.watch.poll_after(2)?;
            // In space what is forced would be queued, and every scan would find it again.
            if !self.state.is_exempt(simplex) {
                self.state.examine_suspect(simplex)?;
            }
        }
        let was_bad = !self.state.refine_list.is_empty();
        self.clean(cavity)?;
        Ok(was_bad)
    }
}

impl<const D: usize> State<D> {
    fn tile_length(&self) -> usize {
        let is_tight = self.segments.is_active() && self.stage.bound < TIGHT;
        if is_tight { LARGE_TILE } else { TILE }
    }

    /// Lowers the guard of facets as [`State::lower_guard`] does.
    fn lower_guard_in_space(&mut self) -> Result<bool> {
        Ok(self.in_space().map_or(Ok(false), State::lower_guard)?)
    }

    fn is_any_open(&mut self) -> bool {
        let mut all = self.delaunay.complex().simplices();
        all.any(|simplex| {
            self.delaunay.complex().is_live(simplex)
                && self.open_domain(simplex).is_some()
                && !self.is_exempt(simplex)
        })
    }
}
