//! The cells and simplices of the result that are beyond the bound, where it gave way to the angle.

use crate::complex::VertexId;
use crate::error::Result;
use crate::memory::TryGrow;
use crate::mesh::NONE;
use crate::netmesh::state::{Mesher, State};
use crate::numerics::{Circumball, distance, shortest_distance};
use crate::options::{Criterion, GivesWay};

impl<const D: usize> State<D> {
    /// Returns true if the bound of this criterion may have given way to the angle somewhere.
    fn may_be_beyond(&self, criterion: Criterion) -> bool {
        let parameters = &self.parameters;
        D == 3
            && parameters.min_dihedral > 0.0
            && parameters.gives_way == GivesWay::Bound
            && parameters.criterion == criterion
    }
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// Returns the vertices in no cage with cells beyond the bound, if it is one of cells and may
    /// give way.
    pub(super) fn cells_beyond_bound(&mut self) -> Result<Vec<VertexId>> {
        let mut beyond = Vec::new();
        if !self.state.may_be_beyond(Criterion::VoronoiAspect) {
            return Ok(beyond);
        }
        let half_aspect = 0.5 * self.state.parameters.quality_bound;
        for vertex in VertexId::below(self.state.delaunay.point_count()) {
            self.watch.poll_after(1)?;
            let cell = self.state.cells[vertex];
            if self.state.is_inserted(vertex)
                && !self.state.hierarchy.cage_of(vertex).is_valid()
                && cell.farthest > half_aspect * cell.nearest
                && self.is_cell_beyond(vertex, half_aspect)?
            {
                beyond.try_push(vertex)?;
            }
        }
        Ok(beyond)
    }

    /// Returns true if the cell of `vertex` is beyond the bound by the corners and neighbours that
    /// it has now.
    fn is_cell_beyond(&mut self, vertex: VertexId, half_aspect: f64) -> Result<bool> {
        self.state.delaunay.star(vertex, &mut self.scratch.star)?;
        let (mut nearest, mut farthest) = (f64::INFINITY, 0.0f64);
        let x = self.state.delaunay.point(vertex);
        for &simplex in &self.scratch.star {
            let vertices = self.state.delaunay.complex().vertices(simplex);
            let others = vertices.iter().filter(|&&other| other.is_valid() && other != vertex);
            let distances = others.map(|&other| distance(x, self.state.delaunay.point(other)));
            nearest = distances.fold(nearest, f64::min);
            let ball = self.state.delaunay.circumball(simplex);
            farthest = farthest.max(ball.map_or(0.0, |ball| ball.radius()));
        }
        Ok(farthest > half_aspect * nearest)
    }

    /// Returns the simplices of the result's arrays, with all vertices in one domain, that are
    /// beyond the bound, if it is one of simplices and may give way.
    pub(super) fn simplices_beyond_bound(
        &mut self,
        points: &[f64],
        simplices: &[u32],
        domains: &[u32],
    ) -> Result<Vec<u32>> {
        let mut beyond = Vec::new();
        if !self.state.may_be_beyond(Criterion::RadiusEdge) {
            return Ok(beyond);
        }
        let bound = self.state.parameters.quality_bound;
        for (simplex, vertices) in (0..).zip(simplices.chunks_exact(D + 1)) {
            self.watch.poll_after(1)?;
            let tetrahedron: [&[f64; D]; 4] = std::array::from_fn(|index| {
                let at = vertices[index] as usize * D;
                points[at..at + D].try_into().expect("D coordinates")
            });
            let domain = domains[vertices[0] as usize];
            let is_of_one = vertices.iter().all(|&vertex| domains[vertex as usize] == domain);
            let radius = Circumball::of(|index| tetrahedron[index]).radius();
            if is_of_one && domain != NONE && radius > bound * shortest_distance(&tetrahedron).2 {
                beyond.try_push(simplex)?;
            }
        }
        Ok(beyond)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Inputs, Triangulation};
    use crate::netmesh::state::watch::Watch;
    use crate::numerics::testing::Random;
    use crate::options::{Options, Output};
    use crate::parameters::Parameters;
    use crate::quality::{Measure, histogram};

    fn options(quality_bound: f64, gives_way: GivesWay) -> Options {
        Options {
            criterion: Criterion::RadiusEdge,
            output: Output::WellSpaced,
            min_dihedral: 15.0,
            quality_bound,
            gives_way,
            ..Options::default()
        }
    }

    /// Returns the simplices of `mesh` that a run with other options would mark as beyond the
    /// bound.
    fn marked(inputs: &Inputs, options: &Options, mesh: &Triangulation) -> Vec<u32> {
        let parameters = Parameters::resolve(3, options).unwrap();
        let mut mesher = Mesher::<3>::new(inputs, parameters, Watch::new(None)).unwrap();
        mesher.simplices_beyond_bound(&mesh.points, &mesh.simplices, &mesh.vertex_domains).unwrap()
    }

    #[test]
    fn simplices_beyond_the_bound_are_marked_where_it_may_give_way() {
        let mut random = Random(3);
        let points: Vec<f64> = (0..3 * 300).map(|_| random.unit()).collect();
        let inputs = Inputs::new(3, 300, &points, 0).unwrap();
        let loose = options(2.0, GivesWay::Bound);
        let made = crate::netmesh::run(&inputs, None, &loose, None).unwrap();
        assert!(made.beyond_bound.is_empty());
        let tight = marked(&inputs, &options(1.5, GivesWay::Bound), &made);
        assert!(tight.is_sorted());
        let counts = histogram(&made, Measure::RadiusEdge, true, &[1.5]).unwrap().counts;
        assert!(counts[1] > 100, "{counts:?}");
        assert_eq!(tight.len() as u64, counts[1]);
        assert!(marked(&inputs, &options(1.5, GivesWay::Angle), &made).is_empty());
        // A simplex with a vertex of another domain promises nothing.
        let mut cut = made.clone();
        cut.vertex_domains[made.simplices[4 * tight[0] as usize] as usize] = 1;
        assert!(!marked(&inputs, &options(1.5, GivesWay::Bound), &cut).contains(&tight[0]));
    }
}
