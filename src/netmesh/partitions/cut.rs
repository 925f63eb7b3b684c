//! A partition is cut out of the mesh, and refined.

use super::Partition;
use super::interface::Interface;
use crate::complex::{GlobalToLocal, LocalToGlobal, SimplexId};
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::{Array, TryGrow, copied, with_capacity};
use crate::mesh::Stats;
use crate::netmesh::refinement::refine_list::RefineList;
use crate::netmesh::segments::Segments;
use crate::netmesh::watch::Watch;
use crate::netmesh::{Mesher, Stage, State};
use crate::parameters::Parameters;
use rand_pcg::Pcg64Mcg;

impl<const D: usize> Mesher<'_, '_, D> {
    /// The live `simplices` as a partition, with the inputs on their conflict lists, which are on
    /// no list of the global mesh from then on. No id is given in the global mesh before or
    /// afterwards.
    pub(super) fn cut(
        &mut self,
        simplices: Array<SimplexId>,
        global_to_local: &mut GlobalToLocal,
    ) -> Result<Partition<D>> {
        let mut vertices = Array::new();
        for &simplex in &simplices {
            self.watch.poll_after(1)?;
            for input in self.state.conflict_lists.take_entries(simplex) {
                vertices.try_push(input)?;
            }
        }
        // Local ids are in the same order of locality as global ones.
        vertices.sort_unstable();
        let inputs = vertices.len();
        let mut ids = global_to_local.number(LocalToGlobal { simplices, vertices });
        let watch = &mut self.watch;
        let delaunay = self.state.delaunay.partition(&mut ids, || watch.poll_after(1))?;
        self.watch.poll()?;
        let conflict_lists = self.state.conflict_lists.partition(&ids, inputs)?;
        let shared = delaunay.interface_vertices()?;
        self.watch.poll()?;
        let (hierarchy, domains) = self.state.hierarchy.partition(&ids, &shared)?;
        let local_to_global = ids.forget_local();
        self.watch.poll()?;
        let mut cells = Array::with_capacity(local_to_global.vertices.len())?;
        let mut precision_limited = with_capacity(local_to_global.vertices.len())?;
        for &vertex in &local_to_global.vertices {
            cells.try_push(self.state.cells[vertex])?;
            precision_limited.push(self.state.precision_limited[vertex]);
        }
        // The vertices of other partitions count towards the limit as well. What they add is
        // counted when all have joined.
        let others = (self.state.delaunay.point_count() - local_to_global.vertices.len()) as u64;
        let parameters = Parameters {
            max_vertices: self.state.parameters.max_vertices.saturating_sub(others),
            instruments: false,
            ..self.state.parameters.clone()
        };
        let number = u64::from(local_to_global.simplices[0].number()) << 32
            | self.state.delaunay.point_count() as u64;
        let seed = u128::from(parameters.seed) << 64 | u128::from(number);
        let state = State {
            // A mesh with segments has no partitions.
            segments: Segments::default(),
            interface: Interface::new(domains.non_owned()?),
            removed: Vec::new(),
            stage: Stage::of_insertion(parameters.loose_bound()),
            template: copied(&self.state.template)?,
            random: Pcg64Mcg::new(seed),
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

impl<const D: usize> Partition<D> {
    /// Goes through the rest of the rounds and of the refinement.
    pub fn refine(self, watch: Watch<'_, '_>) -> Result<Self> {
        let mut mesher = Mesher::resume(self.state, watch);
        mesher.state.stage.vertices_before_final = mesher.state.delaunay.point_count();
        mesher.reported = mesher.progress_counts();
        mesher.run_rounds(&mut Cavity::default())?;
        Ok(Self { state: mesher.state, ..self })
    }
}
