//! The slivers that a mesh has left.

use crate::error::Result;
use crate::memory::TryGrow;
use crate::netmesh::slivers::shape::{Measure, in_space};
use crate::netmesh::state::Mesher;
use crate::options::Algorithm;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Returns the tetrahedra below the angle that was asked for, given the arrays of the result;
    /// those with vertices of several domains and `flat` ones are left out.
    pub(super) fn slivers_left(
        &mut self,
        points: &[f64],
        simplices: &[u32],
        domains: &[u32],
        flat: &[u32],
    ) -> Result<Vec<u32>> {
        let mut left = Vec::new();
        let degrees = self.state.parameters.min_dihedral;
        let is_mended = self.state.parameters.algorithm != Algorithm::Delaunay;
        if D != 3 || degrees == 0.0 || !is_mended {
            return Ok(left);
        }
        let measure = Measure::of_angles(degrees);
        for (simplex, vertices) in (0..).zip(simplices.chunks_exact(D + 1)) {
            self.watch.poll_after(1)?;
            let domain = |&vertex: &u32| domains[vertex as usize];
            let is_of_one = vertices.iter().all(|vertex| domain(vertex) == domain(&vertices[0]));
            let tetrahedron = std::array::from_fn(|index| {
                let at = vertices[index] as usize * D;
                let point: &[f64; D] = points[at..at + D].try_into().expect("D coordinates");
                in_space(point)
            });
            let is_flat = flat.binary_search(&simplex).is_ok();
            if is_of_one && !is_flat && measure.penalty(&tetrahedron) > 0.0 {
                left.try_push(simplex)?;
            }
        }
        Ok(left)
    }
}
