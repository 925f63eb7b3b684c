//! A partition is cut out of the mesh, and refined.

use crate::complex::{GlobalToLocal, LocalToGlobal, SimplexId};
use crate::error::Result;
use crate::memory::{Array, TryGrow, copied, with_capacity};
use crate::mesh::Stats;
use crate::netmesh::partitions::partition::Partition;
use crate::netmesh::state::facets::Facets;
use crate::netmesh::state::interface::Interface;
use crate::netmesh::state::refine_list::RefineList;
use crate::netmesh::state::segments::SegmentState;
use crate::netmesh::state::workers::on_threads_with_ticks;
use crate::netmesh::state::{Mesher, Stage, State};
use crate::numerics::random_numbers;
use crate::parameters::Parameters;
use std::sync::{Mutex, PoisonError};

impl<const D: usize> Mesher<'_, '_, D> {
    /// Makes a partition of each of the `runs` of live simplices, with the inputs on their conflict
    /// lists, which are on no list of the global mesh from then on. No id is given in the global
    /// mesh before or afterwards.
    pub(super) fn extract(&mut self, runs: Vec<Array<SimplexId>>) -> Result<Vec<Partition<D>>> {
        let threads = self.state.threads();
        let Self { state, watch, .. } = self;
        state.hierarchy.compress(|| watch.poll_after(1))?;
        let bound = state.delaunay.complex().simplex_bound();
        let state = &*state;
        // One for each thread at work.
        let unused = Mutex::new(Vec::new());
        let take = || unused.lock().unwrap_or_else(PoisonError::into_inner).pop();
        let give_back = |ids| unused.lock().unwrap_or_else(PoisonError::into_inner).try_push(ids);
        let partitions =
            on_threads_with_ticks(threads, watch, runs.into_iter(), |simplices, tick| {
                let mut global_to_local = match take() {
                    Some(global_to_local) => global_to_local,
                    None => GlobalToLocal::new(bound, state.delaunay.point_count())?,
                };
                let partition = state.extract(simplices, &mut global_to_local, || tick(1))?;
                give_back(global_to_local)?;
                Ok(partition)
            })?;
        self.state.conflict_lists.empty_lists();
        Ok(partitions)
    }
}

impl<const D: usize> State<D> {
    /// Returns the live `simplices` as a partition.
    fn extract(
        &self,
        simplices: Array<SimplexId>,
        global_to_local: &mut GlobalToLocal,
        mut tick: impl FnMut() -> Result<()>,
    ) -> Result<Partition<D>> {
        let mut vertices = Array::new();
        for &simplex in &simplices {
            tick()?;
            for input in self.conflict_lists.entries(simplex) {
                vertices.try_push(input)?;
            }
        }
        // Local ids are in the same order of locality as global ones.
        vertices.sort_unstable();
        let inputs = vertices.len();
        let mut ids = global_to_local.number(LocalToGlobal { simplices, vertices });
        let delaunay = self.delaunay.partition(&mut ids, &mut tick)?;
        let conflict_lists = self.conflict_lists.partition(&ids, inputs)?;
        let shared = delaunay.interface_vertices()?;
        let (hierarchy, domains) = self.hierarchy.partition(&ids, &shared)?;
        let local_to_global = ids.forget_local();
        let mut cells = Array::with_capacity(local_to_global.vertices.len())?;
        let mut precision_limited = with_capacity(local_to_global.vertices.len())?;
        for &vertex in &local_to_global.vertices {
            cells.try_push(self.cells[vertex])?;
            precision_limited.push(self.precision_limited[vertex]);
        }
        // The vertices of other partitions count towards the limit as well. What they add is
        // counted when all have joined.
        let others = (self.delaunay.point_count() - local_to_global.vertices.len()) as u64;
        let parameters = Parameters {
            max_vertices: self.parameters.max_vertices.saturating_sub(others),
            instruments: false,
            ..self.parameters.clone()
        };
        let number = u64::from(local_to_global.simplices[0].number()) << 32
            | self.delaunay.point_count() as u64;
        let state = State {
            // A mesh with segments or facets has no partitions.
            segments: SegmentState::default(),
            facets: Facets::default(),
            interface: Interface::new(domains.non_owned()?)?,
            removed: Vec::new(),
            stage: Stage::of_insertion(parameters.loose_bound()),
            template: copied(&self.template)?,
            random: random_numbers(self.parameters.seed, number),
            stats: Stats::default(),
            refine_list: RefineList::new()?,
            delaunay,
            hierarchy,
            conflict_lists,
            cells,
            precision_limited,
            inputs,
            parameters,
        };
        Ok(Partition { local_to_global, domains, shared, state })
    }
}
