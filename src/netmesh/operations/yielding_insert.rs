//! YIELDINGINSERT (§6.3): the Steiner point for a bad simplex goes in, or the input nearest to it
//! in its D-ball instead.

use crate::complex::SimplexId;
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow};
use crate::netmesh::operations::recover_boundary::Encroachment;
use crate::netmesh::questions::steiner_point::SteinerPoint;
use crate::netmesh::state::facets::floors::Purpose;
use crate::netmesh::state::{Mesher, State};

/// Number of conflicts from which on those in another region than the simplex' own do not count:
/// the walls on the way there are nearer, and are split first.
const MOST_BEYOND: usize = 64;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Inserts the Steiner point for `simplex`, or the input that it yields to (YIELDINGINSERT).
    pub(in crate::netmesh) fn refine_corner(
        &mut self,
        simplex: SimplexId,
        purpose: Purpose,
        cavity: &mut Cavity,
    ) -> Result<()> {
        let steiner = self.state.steiner_point(simplex);
        self.insert_steiner(simplex, steiner, purpose, cavity)
    }

    /// Inserts the corner of `simplex` itself, or the input that it yields to, though no bound asks
    /// for it.
    pub(in crate::netmesh) fn insert_corner(
        &mut self,
        simplex: SimplexId,
        cavity: &mut Cavity,
    ) -> Result<()> {
        let corner = self.state.sound_corner(simplex);
        self.insert_steiner(simplex, corner, Purpose::Size, cavity)
    }

    fn insert_steiner(
        &mut self,
        simplex: SimplexId,
        steiner: Option<SteinerPoint<D>>,
        purpose: Purpose,
        cavity: &mut Cavity,
    ) -> Result<()> {
        let steiner =
            steiner.filter(|steiner| !self.state.is_too_coarse(&steiner.point, steiner.radius));
        let Some(SteinerPoint { point: x, radius, is_corner }) = steiner else {
            self.state.refine_list.limit(simplex);
            return Ok(());
        };
        match self.state.as_space() {
            Some(_) => self.state.find_cavity_in_region(simplex, &x, MOST_BEYOND, cavity)?,
            None => self.state.delaunay.find_cavity(simplex, &x, cavity)?,
        }
        if !self.state.may_replace_cavity(cavity) {
            return Ok(self.state.block(simplex)?);
        }
        // With a yield radius above 1 - epsilon the input need not be medial: INSERTINPUT, not
        // the paper's INSERT, and with it the encroachment that an input may cause.
        if let Some(input) =
            self.input_near(&x, self.state.parameters.yield_radius * radius, cavity)?
        {
            self.state.stats.yields += 1;
            if !self.insert_input(input, cavity)? {
                self.state.block(simplex)?;
            }
            return Ok(());
        }
        match (self.split_encroached(simplex, &x, purpose, cavity)?, purpose) {
            (Encroachment::Split, _) => return Ok(()),
            (Encroachment::Refused, Purpose::Bound) => {
                return Ok(self.state.facets.keep(simplex)?);
            }
            (Encroachment::TooShort | Encroachment::Refused, _) => {
                self.state.refine_list.limit(simplex);
                return Ok(());
            }
            (Encroachment::None, _) => {}
        }
        if !self.state.may_insert(&x, cavity) {
            return Ok(self.state.block(simplex)?);
        }
        let domain = self.enter(&x, cavity)?;
        let vertex = self.state.add_vertex(x)?;
        match is_corner {
            true => self.state.stats.far_corners += 1,
            false => self.state.stats.off_centers += 1,
        }
        self.state.hierarchy.set_domain(vertex, domain);
        self.insert_off_segments(vertex, cavity)
    }
}

impl<const D: usize> State<D> {
    /// Leaves a bad simplex to those who may mend it.
    pub(super) fn block(&mut self, simplex: SimplexId) -> AllocResult<()> {
        self.refine_list.limit(simplex);
        match self.interface.is_some() {
            true => self.interface.blocked.try_push(simplex),
            false => Ok(()),
        }
    }
}
