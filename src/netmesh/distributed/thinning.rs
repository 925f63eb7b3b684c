//! The choice of the inputs of the sample that the coarse mesh is of. A cluster that is a small
//! part of a partition has one vertex there: its domains are made by the partition that has all of
//! it. If the coarse mesh had them, those at interfaces would belong to none, and the inputs that
//! their cages have to grow for would wait through all phases.

use crate::complex::VertexId;
use crate::error::Result;
use crate::memory::{TryGrow, collected, filled};
use crate::netmesh::state::State;
use crate::netmesh::state::hierarchy::{DomainId, ROOT};
use crate::numerics::distance;

impl<const D: usize> State<D> {
    /// Returns the inputs that are left, in their order, if each outermost domain with at most
    /// `most` of them keeps one; nothing if that are all. The inputs from which the outer cage
    /// follows are left as well.
    pub(super) fn thinned(&mut self, most: usize) -> Result<Option<Vec<VertexId>>> {
        let small = self.small_domains(most)?;
        let mut is_taken = filled(small.len(), false)?;
        let needed = self.needed_for_outer_cage()?;
        let mut left = Vec::new();
        for vertex in VertexId::below(self.inputs) {
            let domain = small[self.hierarchy.domain_of(vertex)];
            let is_left = !domain.is_valid() || !is_taken[domain] || needed[vertex];
            if domain.is_valid() {
                is_taken[domain] = true;
            }
            if is_left {
                left.try_push(vertex)?;
            }
        }
        Ok((left.len() < self.inputs).then_some(left))
    }

    /// Returns, for every living domain, the outermost domain around it, or itself, that has at
    /// most `most` inputs; none if it has more.
    fn small_domains(&mut self, most: usize) -> Result<Vec<DomainId>> {
        let hierarchy = &mut self.hierarchy;
        let mut inputs = filled(hierarchy.len(), 0)?;
        for vertex in VertexId::below(self.inputs) {
            inputs[hierarchy.domain_of(vertex)] += 1;
        }
        let living = (ROOT.index() + 1..hierarchy.len()).map(DomainId::new);
        let mut inner = collected(living.filter(|&domain| hierarchy.node(domain).alive))?;
        // A domain has a smaller radius than its parent.
        let radius = |domain: &DomainId| hierarchy.node(*domain).radius;
        inner.sort_unstable_by(|a, b| radius(a).total_cmp(&radius(b)));
        for &domain in &inner {
            inputs[hierarchy.parent(domain)] += inputs[domain];
        }
        let mut small = filled(hierarchy.len(), DomainId::NONE)?;
        for &domain in inner.iter().rev() {
            let around = small[hierarchy.parent(domain)];
            let is_small = inputs[domain] <= most;
            small[domain] = match is_small && !around.is_valid() {
                true => domain,
                false => around,
            };
        }
        Ok(small)
    }

    /// Returns, for every vertex, true if it is at an end of the inputs along an axis, at the
    /// centre of the outer cage, or farthest from that.
    fn needed_for_outer_cage(&self) -> Result<Vec<bool>> {
        let points = || VertexId::below(self.inputs).map(|v| self.delaunay.point(v));
        let center = self.hierarchy.node(ROOT).point;
        let ends: [[f64; 2]; D] = std::array::from_fn(|axis| {
            let xs = || points().map(|point| point[axis]);
            [xs().fold(f64::INFINITY, f64::min), xs().fold(f64::NEG_INFINITY, f64::max)]
        });
        let farthest = points().map(|point| distance(point, &center)).fold(0.0, f64::max);
        Ok(collected(points().map(|point| {
            let mut along = point.iter().zip(&ends);
            along.any(|(x, ends)| ends.contains(x))
                || *point == center
                || distance(point, &center) == farthest
        }))?)
    }
}

#[cfg(test)]
mod tests {
    use super::super::coarse::mesh;
    use crate::netmesh::state::watch::Watch;
    use crate::options::Options;
    use crate::parameters::Parameters;

    /// Returns the points that are left of `points`, if any go.
    fn left(points: &[[f64; 2]], most: usize) -> Option<Vec<[f64; 2]>> {
        let parameters = Parameters::resolve(2, &Options::default()).unwrap();
        let mut mesher = mesh(points, &parameters, Watch::new(None)).unwrap();
        let left = mesher.state.thinned(most).unwrap()?;
        Some(left.iter().map(|&vertex| *mesher.state.delaunay.point(vertex)).collect())
    }

    fn lattice() -> Vec<[f64; 2]> {
        (0..49).map(|at| [f64::from(at % 7), f64::from(at / 7)]).collect()
    }

    fn cluster(count: u32, [x, y]: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
        let step = move |at: u32| 1e-6 * f64::from(at);
        (0..count).map(move |at| [x - step(at), y + step(at * at % 7)])
    }

    #[test]
    fn a_cluster_that_is_not_too_large_keeps_one_point() {
        let mut points = lattice();
        points.extend(cluster(30, [1.5, 2.5]));
        points.extend(cluster(6, [4.5, 3.5]));
        let count =
            |left: &[[f64; 2]], x: f64| left.iter().filter(|p| (p[0] - x).abs() < 0.1).count();
        assert_eq!(left(&points, 0), None);
        let some = left(&points, 10).unwrap();
        assert_eq!([some.len(), count(&some, 1.5), count(&some, 4.5)], [80, 30, 1]);
        let few = left(&points, 30).unwrap();
        assert_eq!([few.len(), count(&few, 1.5), count(&few, 4.5)], [51, 1, 1]);
    }

    #[test]
    fn inputs_at_the_ends_are_left() {
        let mut points = lattice();
        points.extend(cluster(6, [-1.0, -1.0]));
        let left = left(&points, 10).unwrap();
        let own = || left.iter().filter(|point| point[0] < -0.5);
        assert!((2..4).contains(&own().count()), "{left:?}");
        let least = |axis: usize| points.iter().map(|point| point[axis]).fold(0.0, f64::min);
        for axis in 0..2 {
            assert!(own().any(|point| point[axis] == least(axis)));
        }
    }
}
