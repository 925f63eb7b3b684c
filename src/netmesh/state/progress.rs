//! The progress of a run: the fraction of it that is done, by the usual shares of its phases in the
//! time, and the counts that the caller is told.

use crate::error::Result;
use crate::netmesh::state::{Mesher, State};
use crate::options::{Algorithm, Output, Phase};

impl<const D: usize> Mesher<'_, '_, D> {
    pub(in crate::netmesh) fn report_progress(&mut self) -> Result<()> {
        self.note_progress();
        self.watch.report()
    }

    pub(in crate::netmesh) fn note_progress(&mut self) {
        let counts = self.state.progress_counts();
        if self.state.interface.is_some() {
            self.watch.note_partition(&self.reported, &counts);
            self.reported = counts;
        } else {
            self.watch.note(self.state.stage.phase, self.done(), counts);
        }
    }

    /// Returns the part of the run that is done: inputs inserted, then cages dissolved, then
    /// simplices that need no more refinement, by their usual shares of the time.
    fn done(&self) -> f64 {
        let [insert, finish] = self.state.shares();
        let before = match self.state.stage.phase {
            Phase::Prepare | Phase::Insert => {
                let inserted = self.state.inputs - self.state.conflict_lists.remaining();
                insert * inserted as f64 / self.state.inputs as f64
            }
            Phase::Finish if self.state.stage.is_final => {
                insert
                    + finish
                    + (1.0 - insert - finish)
                        * self.state.stage.final_fraction.max(self.state.usual_final_fraction())
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

    /// Returns the share that sizes have of the time before slivers, and that slivers have of the
    /// whole run.
    fn shares_of_options(&self) -> [f64; 2] {
        let sizes = if self.sizes.is_some() { 0.8 } else { 0.0 };
        let slivers = if self.state.parameters.min_dihedral > 0.0 { 0.6 } else { 0.0 };
        [sizes, slivers]
    }

    /// Returns the part of the run that is done when partitions are.
    pub(in crate::netmesh) fn share_of_partitions(&self) -> f64 {
        let [sizes, slivers] = self.shares_of_options();
        0.95 * (1.0 - sizes) * (1.0 - slivers)
    }
}

impl<const D: usize> State<D> {
    /// Returns the numbers of inputs inserted, of vertices and of simplices.
    pub(in crate::netmesh) fn progress_counts(&self) -> [u64; 3] {
        let inserted = self.inputs - self.conflict_lists.uninserted();
        let vertices =
            self.delaunay.point_count() - self.conflict_lists.uninserted() - self.removed.len();
        let simplices = self.delaunay.complex().simplex_count();
        [inserted as u64, vertices as u64, simplices as u64]
    }

    /// Returns the shares of insertion and of FINISHMESH in the time of a run without options that
    /// take longer. The rest is the final refinement.
    fn shares(&self) -> [f64; 2] {
        match (self.parameters.algorithm, self.parameters.output) {
            (Algorithm::Delaunay, _) => [1.0, 0.0],
            (_, Output::Auto | Output::Hierarchical) => [0.6, 0.0],
            (_, Output::WellSpaced) => [0.3, 0.4],
        }
    }

    /// Returns the fraction of the final refinement that is done by the number of vertices: a mesh
    /// that is not finished yet becomes twice as large by it, usually. Most refinement may come at
    /// the first place, for what is bad there lets cells around it get bad.
    fn usual_final_fraction(&self) -> f64 {
        let vertices = self.delaunay.point_count() as f64;
        (vertices / self.stage.vertices_before_final as f64 - 1.0).min(0.9)
    }
}
