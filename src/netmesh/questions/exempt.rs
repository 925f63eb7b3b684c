//! Simplices that refinement leaves alone: those outside of the domain, and those that a sharp
//! corner of the input forces. Two lines that meet at a small angle are split on the same shells
//! about their end, and the triangle between two vertices of a shell has an edge as short as the
//! angle makes it. To refine it would make the next shell, and so on; so it stays, as in G. L.
//! Miller, S. E. Pav and N. J. Walkington, "When and why Delaunay refinement algorithms work"
//! (2005).

use crate::complex::{SimplexId, VertexId};
use crate::error::Result;
use crate::netmesh::state::State;
use crate::numerics::{distance, shortest_distance};

/// Two distances from an end are those of one shell if they differ by no more than this, relative
/// to the larger.
const SAME_SHELL: f64 = 1e-3;

/// A ball of a smaller radius, in units in the last place of its centre, has no room for a vertex
/// of its own: roundings take more from the distances of vertices than refinement gives.
const SMALLEST_BALL: f64 = 32.0;

/// Returns the unit in the last place of the largest coordinate of a point.
pub(in crate::netmesh) fn unit_of<const D: usize>(x: &[f64; D]) -> f64 {
    let largest = x.iter().fold(0.0f64, |largest, x| largest.max(x.abs()));
    largest.next_up() - largest
}

impl<const D: usize> State<D> {
    /// Returns true if doubles are too coarse for a Steiner point at `x`, which is as far from
    /// vertices as `radius`. Beside segments refinement would go on for ever on roundings.
    pub(in crate::netmesh) fn is_too_coarse(&self, x: &[f64; D], radius: f64) -> bool {
        self.segments.is_active() && radius < SMALLEST_BALL * unit_of(x)
    }

    /// Returns true if a live simplex is known to be outside, or forced.
    pub(in crate::netmesh) fn is_exempt(&self, simplex: SimplexId) -> bool {
        self.segments.is_active() && (self.is_known_outside(simplex) || self.is_forced(simplex))
    }

    /// Returns true if a live simplex is known to be outside.
    pub(in crate::netmesh) fn is_known_outside(&self, simplex: SimplexId) -> bool {
        let regions = &self.segments.regions;
        self.segments.is_active()
            && regions.of(simplex).is_some_and(|region| !regions.is_inside[region as usize])
    }

    /// Returns true if a live simplex is outside, or forced. Finds the regions that are not known.
    /// All subsegments are recovered.
    pub(in crate::netmesh) fn is_left_alone(&mut self, simplex: SimplexId) -> Result<bool> {
        let is_known = self.segments.is_active() && self.segments.regions.is_known();
        Ok(is_known && (self.is_outside(simplex)? || self.is_forced(simplex)))
    }

    /// Returns true if segments leave a live simplex out of the domain. All subsegments are
    /// recovered.
    pub(in crate::netmesh) fn is_outside(&mut self, simplex: SimplexId) -> Result<bool> {
        if !self.segments.is_active() || !self.segments.regions.is_known() {
            return Ok(false);
        }
        let region = self.region_of(simplex)?;
        Ok(!self.segments.regions.is_inside[region as usize])
    }

    /// Returns the longest edge that the region of a live simplex may have, infinite for any.
    pub(in crate::netmesh) fn max_edge_of_region(&mut self, simplex: SimplexId) -> Result<f64> {
        if !self.segments.is_active() || !self.segments.regions.is_known() {
            return Ok(f64::INFINITY);
        }
        let region = self.region_of(simplex)?;
        Ok(self.segments.regions.max_edges[region as usize])
    }

    /// Returns true if a live simplex is forced: its shortest edge is between two lines that meet
    /// at a sharp end, on one shell about that.
    fn is_forced(&self, simplex: SimplexId) -> bool {
        if let Some(state) = self.as_space() {
            return state.is_kept(simplex);
        }
        let vertices = self.delaunay.complex().vertices(simplex);
        let chains = &self.segments.chains;
        let on_lines = vertices.iter().filter(|&&vertex| chains.line_through(vertex).is_some());
        if on_lines.count() < 2 || vertices.contains(&VertexId::INFINITE) {
            return false;
        }
        let points: [&[f64; D]; 3] =
            std::array::from_fn(|index| self.delaunay.point(vertices[index]));
        let (a, b, _) = shortest_distance(&points);
        self.is_on_shell(vertices[a], vertices[b])
    }

    /// Returns true if a live and finite simplex is beyond the bound, and stays because it is
    /// forced.
    pub(in crate::netmesh) fn is_bad_but_forced(&self, simplex: SimplexId) -> bool {
        let radius = self.delaunay.radius(simplex).unwrap_or(0.0);
        self.short_edge(simplex, radius).is_some()
            && match self.as_space() {
                Some(state) => !state.is_flat(simplex) && self.is_in_one_domain(simplex),
                None => self.is_forced(simplex),
            }
    }

    /// Returns true if a live simplex of the domain is beyond the bound though no small angle
    /// excuses it. The guard of facets leaves some so, near to many edges and crossings of
    /// surfaces, that would be split far below what there is; and changes for dihedral angles put
    /// such a one in the place of one that is excused.
    pub(in crate::netmesh) fn is_left_at_no_angle(&self, simplex: SimplexId) -> bool {
        let Some(state) = self.as_space() else { return false };
        if self.delaunay.complex().is_infinite(simplex) {
            return false;
        }
        let regions = &self.segments.regions;
        let is_inside = regions.of(simplex).is_some_and(|one| regions.is_inside[one as usize]);
        is_inside && self.is_bad_but_forced(simplex) && !state.has_small_angle(simplex)
    }

    /// Returns true if two vertices are on different lines that meet at a sharp angle, equally far
    /// from where they meet. A line may be sharp there with a third one only: what is between these
    /// two can be refined then.
    fn is_on_shell(&self, a: VertexId, b: VertexId) -> bool {
        let chains = &self.segments.chains;
        let (Some(first), Some(second)) = (chains.line_through(a), chains.line_through(b)) else {
            return false;
        };
        let [first, second] = [first, second].map(|line| chains.lines[line as usize]);
        let Some((center, others)) = first.corner_with(&second) else { return false };
        let middle = self.delaunay.point(center);
        let [near, far] = [a, b].map(|vertex| distance(middle, self.delaunay.point(vertex)));
        (near - far).abs() <= SAME_SHELL * near.max(far) && self.meet_sharply(center, others)
    }
}
