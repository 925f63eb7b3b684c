//! The first simplices and conflict lists: the outer cage (§6.5, first lines of NETMESH), or for
//! the plain Delaunay triangulation the first affinely independent inputs.

use crate::complex::VertexId;
use crate::delaunay::Cavity;
use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::{AllocResult, collected, with_capacity};
use crate::netmesh::operations::template::{cage_points, cage_template};
use crate::netmesh::questions::cage_site::{REPRESENTABLE, spacing_near};
use crate::netmesh::state::hierarchy::{DomainId, ROOT};
use crate::netmesh::state::{Mesher, State, limit};
use crate::numerics::{affine_basis, distance};

/// The ball that the hull of the outer cage holds is at least this many times the inputs' ball.
const ROOM: f64 = 1.25;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Makes the outer cage, and puts all inputs on conflict lists.
    pub(in crate::netmesh) fn start_netmesh(&mut self, cavity: &mut Cavity) -> Result<()> {
        let center = self.start_outer_cage(&[], 1.0, cavity)?;
        self.assign_inputs(center)?;
        self.clean(cavity)
    }

    /// Makes the outer cage around all inputs, centred at the input nearest to the middle, so that
    /// the root domain has a vertex at its centre (Definition 3) without a Steiner point. It
    /// surrounds `further` points, too, and is `distance` times as far away as for points alone,
    /// unless doubles have no room for that. Returns that vertex.
    pub(in crate::netmesh) fn start_outer_cage(
        &mut self,
        further: &[[f64; D]],
        distance: f64,
        cavity: &mut Cavity,
    ) -> Result<VertexId> {
        let most = self.state.parameters.max_vertices;
        self.state.template =
            cage_template::<D>(self.state.parameters.delta, most, &mut self.watch)?;
        if self.state.template.len() as u64 > most {
            return Err(limit(most, self.state.template.len()));
        }
        let center = self.central_input()?;
        let point = *self.state.delaunay.point(center);
        let near = self.root_radius(&point, further)?;
        let (radius, sphere) = match self.outer_cage(&point, distance * near)? {
            Some(sphere) => (distance * near, sphere),
            None => (near, self.outer_cage(&point, near)?.ok_or_else(too_large)?),
        };
        self.state.hierarchy.create(center, point, radius, DomainId::NONE, sphere.len())?;
        self.state.stats.cages_created += 1;
        let mut vertices = with_capacity(1 + sphere.len())?;
        vertices.push(center);
        for x in sphere {
            vertices.push(self.state.add_vertex(x)?);
            self.state.stats.cage_points += 1;
        }
        let basis = affine_basis::<D>(vertices.len(), |i| *self.state.delaunay.point(vertices[i]));
        assert!(basis.len() == D + 1, "the template spans the space");
        let first = collected(basis.iter().map(|&i| vertices[i]))?;
        self.state.delaunay.begin(&first)?;
        for &vertex in &vertices[1..] {
            self.state.hierarchy.join_cage(vertex, ROOT)?;
        }
        for &vertex in &first {
            self.state.hierarchy.set_domain(vertex, ROOT);
            self.state.measure_nearest(vertex);
        }
        let mut near = first[0];
        for &vertex in &vertices {
            if !self.state.is_inserted(vertex) {
                self.insert_outer_cage_vertex(vertex, near, cavity)?;
                near = vertex;
            }
        }
        Ok(center)
    }

    fn insert_outer_cage_vertex(
        &mut self,
        vertex: VertexId,
        near: VertexId,
        cavity: &mut Cavity,
    ) -> Result<()> {
        let x = *self.state.delaunay.point(vertex);
        let start = self.state.delaunay.complex().incident(near);
        let start = self.state.delaunay.locate(start, &x).expect("cage vertices are distinct");
        self.state.delaunay.find_cavity(start, &x, cavity)?;
        self.state.hierarchy.set_domain(vertex, ROOT);
        self.insert_into_cavity(vertex, cavity)
    }

    /// Makes the first simplex of a plain Delaunay triangulation, of the first D + 1 affinely
    /// independent inputs.
    pub(in crate::netmesh) fn start_delaunay(&mut self) -> Result<()> {
        let basis =
            affine_basis::<D>(self.state.inputs, |i| *self.state.delaunay.point(VertexId::new(i)));
        if basis.len() < D + 1 {
            let message = message!(
                "the points have affine rank {}; a Delaunay triangulation in dimension {D} needs \
                 rank {D}",
                basis.len() - 1
            );
            return Err(Error::new(ErrorKind::DegenerateInput, message));
        }
        let first = collected(basis.iter().copied().map(VertexId::new))?;
        self.state.delaunay.begin(&first)?;
        self.assign_inputs(first[0])
    }

    /// Assigns every uninserted input to a conflict list, walking from the simplex of the input
    /// before.
    fn assign_inputs(&mut self, near: VertexId) -> Result<()> {
        self.state.conflict_lists.cover(self.state.delaunay.complex().simplex_bound())?;
        let mut start = self.state.delaunay.complex().incident(near);
        for input in VertexId::below(self.state.inputs) {
            self.watch.poll_after(4)?;
            if self.state.is_inserted(input) {
                self.state.conflict_lists.dismiss_unassigned();
            } else {
                let q = *self.state.delaunay.point(input);
                let touches = self.state.conflict_lists.touches_mut(input);
                let found = self.state.delaunay.locate_and_count(start, &q, touches);
                start = found.expect("inputs are distinct");
                self.state.conflict_lists.assign(input, start);
            }
        }
        Ok(())
    }

    /// Returns the vertices of an outer cage, unless it leaves the range of doubles.
    fn outer_cage(&self, center: &[f64; D], radius: f64) -> AllocResult<Option<Vec<[f64; D]>>> {
        let State { template, parameters, .. } = &self.state;
        let sphere = cage_points(template, center, radius * parameters.cage_scale)?;
        let is_in_range =
            (2.0 * radius).is_finite() && sphere.iter().flatten().all(|x| x.is_finite());
        Ok(is_in_range.then_some(sphere))
    }

    /// Returns the input nearest to the middle of the bounding box.
    fn central_input(&mut self) -> Result<VertexId> {
        let mut low = *self.state.delaunay.point(VertexId::new(0));
        let mut high = low;
        for input in VertexId::range(1..self.state.inputs) {
            self.watch.poll_after(1)?;
            for (axis, &x) in self.state.delaunay.point(input).iter().enumerate() {
                low[axis] = low[axis].min(x);
                high[axis] = high[axis].max(x);
            }
        }
        let middle: [f64; D] = std::array::from_fn(|axis| 0.5 * low[axis] + 0.5 * high[axis]);
        let (mut best, mut least) = (VertexId::new(0), f64::INFINITY);
        for input in VertexId::below(self.state.inputs) {
            self.watch.poll_after(1)?;
            let distance = distance(self.state.delaunay.point(input), &middle);
            if distance < least {
                (best, least) = (input, distance);
            }
        }
        Ok(best)
    }

    /// Returns `root_scale` times the inputs' radius about `center`, but so much that doubles can
    /// express the outer cage, and that its hull surrounds the inputs with room to spare.
    fn root_radius(&mut self, center: &[f64; D], further: &[[f64; D]]) -> Result<f64> {
        let mut radius = further.iter().map(|x| distance(x, center)).fold(0.0f64, f64::max);
        for input in VertexId::below(self.state.inputs) {
            self.watch.poll_after(1)?;
            radius = radius.max(distance(self.state.delaunay.point(input), center));
        }
        if let Some(sizes) = &self.sizes {
            radius = radius.max(sizes.reach(center));
        }
        let spacing = 4.0 * REPRESENTABLE * spacing_near(center);
        let hull = self.state.parameters.cage_scale * self.state.parameters.hull_radius();
        Ok((self.state.parameters.root_scale.max(ROOM / hull) * radius).max(spacing))
    }
}

fn too_large() -> Error {
    let message = "the coordinates are too large: the outer cage leaves the range of double";
    Error::new(ErrorKind::Limit, message)
}

#[cfg(test)]
mod tests {
    use crate::error::ErrorKind;
    use crate::mesh::Inputs;
    use crate::options::Options;

    /// No input is at a finite distance from the middle.
    #[test]
    fn inputs_too_far_from_each_other_are_refused() {
        let far = f64::MAX;
        let points = [far, far, -far, far, far, -far, -far, -far];
        let inputs = Inputs::new(2, 4, &points, 0).unwrap();
        let error = crate::netmesh::run(&inputs, None, &Options::default(), None).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Limit);
    }
}
