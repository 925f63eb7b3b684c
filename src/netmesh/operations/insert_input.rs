//! INSERTINPUT (§6.3): every insertion is medial in its domain, because the hierarchy is changed
//! first.

use crate::complex::VertexId;
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::AllocResult;
use crate::netmesh::questions::encroachment::LEVELS;
use crate::netmesh::state::hierarchy::ROOT;
use crate::netmesh::state::{Mesher, State};
use crate::options::Algorithm;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Inserts `input` after cages that it encroaches from inside have grown, and a new cage where
    /// it is not medial (INSERTINPUT). The paper makes the new cage first. When the nearest
    /// neighbour is itself a vertex of the encroached cage, the new cage would extend out of that
    /// one, release it from outside and leave nothing to grow. Returns false if the interface
    /// defers the input.
    pub(in crate::netmesh) fn insert_input(
        &mut self,
        input: VertexId,
        cavity: &mut Cavity,
    ) -> Result<bool> {
        if self.state.is_inserted(input) {
            return Ok(true);
        }
        self.state.find_cavity_of_input(input, cavity)?;
        match self.state.parameters.algorithm {
            Algorithm::Netmesh => {}
            Algorithm::Svr => {
                self.state.hierarchy.set_domain(input, ROOT);
                return self.insert_into_cavity(input, cavity).map(|()| true);
            }
            Algorithm::Delaunay => return self.insert_into_cavity(input, cavity).map(|()| true),
        }
        let x = *self.state.delaunay.point(input);
        if !self.state.may_insert(&x, cavity) {
            return Ok(false);
        }
        for _ in 0..LEVELS {
            let Some(domain) = self.state.inner_encroached(input, cavity) else { break };
            let start = self.state.conflict_lists.simplex_of(input);
            if !self.grow_cage_for(domain, &x, start, cavity)? {
                return Ok(false);
            }
            if !self.state.look_again(input, cavity)? {
                return Ok(true);
            }
        }
        if let Some(wanted) = self.wanted_cage(input, cavity)? {
            if !self.may_make_cage(&wanted)? {
                return Ok(false);
            }
            let start = self.state.conflict_lists.simplex_of(input);
            self.new_cage(wanted, start, cavity)?;
            if !self.state.look_again(input, cavity)? {
                return Ok(true);
            }
        }
        if !self.state.may_insert(&x, cavity) {
            return Ok(false);
        }
        let domain = self.enter(&x, cavity)?;
        self.state.hierarchy.set_domain(input, domain);
        self.insert_into_cavity(input, cavity)?;
        Ok(true)
    }
}

impl<const D: usize> State<D> {
    /// Finds the cavity of `input` anew after a cage operation, unless a cage took it in.
    fn look_again(&mut self, input: VertexId, cavity: &mut Cavity) -> AllocResult<bool> {
        if self.is_inserted(input) {
            return Ok(false);
        }
        self.find_cavity_of_input(input, cavity)?;
        Ok(true)
    }
}
