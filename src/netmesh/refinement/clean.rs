//! CLEAN (§6.4) and YIELDINGINSERT (§6.3): the far corner of a bad cell goes in, or the input
//! nearest to it in its D-ball instead.

use crate::complex::SimplexId;
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::AllocResult;
use crate::netmesh::Mesher;
use crate::netmesh::refinement::refine_list::Entry;
use crate::netmesh::refinement::steiner::SteinerPoint;

impl<const D: usize> Mesher<'_, '_, D> {
    /// CLEAN: refines until no cell is bad that doubles can mend.
    pub(in crate::netmesh) fn clean(&mut self, cavity: &mut Cavity) -> Result<()> {
        self.recover_segments(cavity)?;
        while let Some(entry) = self.state.refine_list.pop() {
            let simplex = entry.simplex;
            if !self.state.delaunay.complex().is_live(simplex) {
                continue;
            }
            if self.is_left_alone(simplex)? {
                continue;
            }
            if self.is_bad(simplex) {
                self.refine_corner(simplex, cavity)?;
            } else if let Some(domain) = self.open_domain(simplex) {
                self.narrow_cage_gap(simplex, domain, cavity)?;
            }
            self.recover_segments(cavity)?;
            self.queue_again(entry)?;
        }
        Ok(())
    }

    /// An input that was yielded to may lie on the D-ball within rounding, and a further cage
    /// vertex beyond it: they leave the simplex.
    fn queue_again(&mut self, entry: Entry) -> AllocResult<()> {
        if self.state.refine_list.is_current(entry)
            && self.state.delaunay.complex().is_live(entry.simplex)
        {
            self.examine(entry.simplex)?;
        }
        Ok(())
    }

    /// YIELDINGINSERT of the Steiner point for `simplex`.
    pub(in crate::netmesh) fn refine_corner(
        &mut self,
        simplex: SimplexId,
        cavity: &mut Cavity,
    ) -> Result<()> {
        let steiner = self.steiner_point(simplex);
        self.insert_steiner(simplex, steiner, cavity)
    }

    /// The same with the corner itself, which no bound asks for.
    pub(in crate::netmesh) fn insert_corner(
        &mut self,
        simplex: SimplexId,
        cavity: &mut Cavity,
    ) -> Result<()> {
        let corner = self.sound_corner(simplex);
        self.insert_steiner(simplex, corner, cavity)
    }

    fn insert_steiner(
        &mut self,
        simplex: SimplexId,
        steiner: Option<SteinerPoint<D>>,
        cavity: &mut Cavity,
    ) -> Result<()> {
        let steiner = steiner.filter(|steiner| !self.is_too_coarse(&steiner.point, steiner.radius));
        let Some(SteinerPoint { point: x, radius, is_corner }) = steiner else {
            self.state.refine_list.limit(simplex);
            return Ok(());
        };
        self.state.delaunay.find_cavity(simplex, &x, cavity)?;
        if !self.may_replace_cavity(cavity) {
            return Ok(self.block(simplex)?);
        }
        // With a yield radius above 1 - epsilon the input need not be medial: INSERTINPUT, not
        // the paper's INSERT, and with it the encroachment that an input may cause.
        if let Some(input) =
            self.input_near(&x, self.state.parameters.yield_radius * radius, cavity)?
        {
            self.state.stats.yields += 1;
            if !self.insert_input(input, cavity)? {
                self.block(simplex)?;
            }
            return Ok(());
        }
        match self.split_encroached(&x, cavity)? {
            Some(true) => return Ok(()),
            Some(false) => {
                self.state.refine_list.limit(simplex);
                return Ok(());
            }
            None => {}
        }
        if !self.may_insert(&x, cavity) {
            return Ok(self.block(simplex)?);
        }
        let domain = self.enter(&x, cavity)?;
        let vertex = self.add_vertex(x)?;
        match is_corner {
            true => self.state.stats.far_corners += 1,
            false => self.state.stats.off_centers += 1,
        }
        self.state.hierarchy.set_domain(vertex, domain);
        self.insert_off_segments(vertex, cavity)
    }
}
