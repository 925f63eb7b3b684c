//! Cutting a part out of the mesh, and going on with it.

use super::super::instruments::Instruments;
use super::super::svr::Crowded;
use super::super::watch::Watch;
use super::super::{Mesher, Scratch};
use super::{Parameters, Part, RefineList, Rim};
use crate::complex::{Ids, Names};
use crate::error::Result;
use crate::memory::{Array, TryGrow, copied, with_room};
use crate::mesh::Stats;
use crate::options::Phase;
use rand_pcg::Pcg64Mcg;

impl<const D: usize> Mesher<'_, '_, D> {
    /// The live `simplices` as a part, with the inputs that are at home in them, which have no home in
    /// the whole from then on. No id is given before or afterwards.
    pub(super) fn cut(&mut self, simplices: Array<u32>, ids: &mut Ids) -> Result<Part<D>> {
        let mut vertices = Array::new();
        for &simplex in &simplices {
            self.watch.poll_after(1)?;
            for input in self.location.take_out(simplex) {
                vertices.try_push(input)?;
            }
        }
        // Ids are in an order of locality, here and there.
        vertices.sort_unstable();
        let inputs = vertices.len();
        let mut names = Names { simplices, vertices };
        ids.give(&names);
        let watch = &mut self.watch;
        let delaunay = self.delaunay.part(&mut names, ids, || watch.poll_after(1))?;
        self.watch.poll()?;
        let location = self.location.part(&names, &ids.simplices, inputs)?;
        let shared = delaunay.rim_vertices()?;
        self.watch.poll()?;
        let (hierarchy, domains) = self.hierarchy.part(&names.vertices, &shared, &ids.vertices)?;
        ids.take(&names);
        self.watch.poll()?;
        let mut cells = Array::with_room(names.vertices.len())?;
        let mut precision_limited = with_room(names.vertices.len())?;
        for &vertex in &names.vertices {
            cells.try_push(self.cells[vertex as usize])?;
            precision_limited.push(self.precision_limited[vertex as usize]);
        }
        // The vertices of other parts count against the limit as well; what they make of it is seen
        // when all have joined.
        let others = (self.delaunay.point_count() - names.vertices.len()) as u64;
        let parameters = Parameters {
            max_vertices: self.parameters.max_vertices.saturating_sub(others),
            instruments: false,
            ..self.parameters.clone()
        };
        let number = u64::from(names.simplices[0]) << 32 | self.delaunay.point_count() as u64;
        Ok(Part {
            rim: Rim::new(domains.foreign()?),
            template: copied(&self.template)?,
            stats: Stats::default(),
            refine: RefineList::new()?,
            names,
            domains,
            shared,
            delaunay,
            hierarchy,
            location,
            cells,
            precision_limited,
            parameters,
            number,
        })
    }
}

impl<const D: usize> Part<D> {
    /// Refines the part.
    pub fn refine(mut self, watch: Watch<'_, '_>) -> Result<Self> {
        let seed = u128::from(self.parameters.seed) << 64 | u128::from(self.number);
        let inputs = self.location.remaining();
        let mut mesher = Mesher {
            bound: self.parameters.loose_bound(),
            before_closing: self.delaunay.point_count(),
            reported: [0; 3],
            parameters: self.parameters,
            delaunay: self.delaunay,
            hierarchy: self.hierarchy,
            location: self.location,
            refine: self.refine,
            rim: self.rim,
            crowded: Crowded::default(),
            phase: Phase::Insert,
            closing: false,
            closed: 0.0,
            cells: self.cells,
            precision_limited: self.precision_limited,
            inputs,
            order: Vec::new(),
            template: self.template,
            random: Pcg64Mcg::new(seed),
            watch,
            stats: self.stats,
            instruments: Instruments::default(),
            scratch: Scratch::default(),
        };
        mesher.reported = mesher.progress_counts();
        mesher.refine_part()?;
        self.parameters = mesher.parameters;
        self.delaunay = mesher.delaunay;
        self.hierarchy = mesher.hierarchy;
        self.location = mesher.location;
        self.refine = mesher.refine;
        self.rim = mesher.rim;
        self.cells = mesher.cells;
        self.precision_limited = mesher.precision_limited;
        self.template = mesher.template;
        self.stats = mesher.stats;
        Ok(self)
    }
}
