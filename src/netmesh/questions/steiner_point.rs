//! The place of a Steiner point. The paper inserts the farthest corner of a bad cell. A point on
//! the way to the corner that is only as far from the vertices it serves as the bound asks for
//! mends the cell as well and leaves a larger empty ball behind: off-centres, as in Üngör,
//! "Off-centers: a new type of Steiner points for computing size-optimal quality-guaranteed
//! Delaunay triangulations", 2004.

use crate::complex::{SimplexId, VertexId};
use crate::netmesh::state::State;
use crate::numerics::distance;
use crate::options::Criterion;

/// A point for the mesh and the radius of a ball about it that no vertex is in.
pub(in crate::netmesh) struct SteinerPoint<const D: usize> {
    pub point: [f64; D],
    pub radius: f64,
    /// True if the point is the corner itself, and no off-centre.
    pub is_corner: bool,
}

/// Returns the distance of an off-centre from the vertex of a bad cell, relative to the distance
/// that the bound allows its corners (docs/decisions.md has the figures). Times half the bound it
/// is above 1: then no Steiner point is as near to a vertex as its nearest neighbour, and
/// refinement ends.
const fn cell_factor<const D: usize>() -> f64 {
    match D {
        2 => 1.2,
        3 => 1.05,
        _ => 0.9,
    }
}

/// Returns the distance of an off-centre from the middle of a short edge, relative to the apex of
/// the triangle on it whose radius-edge ratio is the bound. It is at least 1/2: then the point is
/// no nearer to any vertex than the bound times the edge.
const fn edge_factor<const D: usize>() -> f64 {
    if D == 2 { 0.97 } else { 0.6 }
}

/// Distance of an off-centre, as [`edge_factor`], for a simplex whose vertices are all on segments:
/// those are likely to need others between them, whatever comes now.
const FACTOR_BETWEEN_SEGMENTS: f64 = 0.8;

impl<const D: usize> State<D> {
    /// Returns the point to insert for `simplex`, which is bad or has inputs. `None` if rounding
    /// moved it out of the D-ball, or closer to a vertex than half the radius: then doubles are too
    /// coarse for a vertex there.
    pub(in crate::netmesh) fn steiner_point(
        &mut self,
        simplex: SimplexId,
    ) -> Option<SteinerPoint<D>> {
        let corner = self.sound_corner(simplex)?;
        let off_center = match self.parameters.criterion {
            Criterion::VoronoiAspect => self.off_center_of_cell(simplex, &corner),
            Criterion::RadiusEdge => self.off_center_of_edge(simplex, &corner),
        };
        Some(off_center.unwrap_or(corner))
    }

    /// Returns the corner of `simplex`. `None` if rounding moved it out of the D-ball, or closer to
    /// a vertex than half the radius.
    pub(in crate::netmesh) fn sound_corner(&self, simplex: SimplexId) -> Option<SteinerPoint<D>> {
        let radius = self.delaunay.radius(simplex)?;
        let point = self.delaunay.corner(simplex)?;
        let corner = SteinerPoint { point, radius, is_corner: true };
        let vertices = self.delaunay.complex().vertices(simplex);
        (self.is_sound(simplex, &corner)
            && vertices.iter().all(|&vertex| self.is_at_its_radius(&corner, vertex)))
        .then_some(corner)
    }

    fn is_sound(&self, simplex: SimplexId, steiner: &SteinerPoint<D>) -> bool {
        steiner.point.iter().all(|x| x.is_finite())
            && self.delaunay.in_conflict(simplex, &steiner.point)
    }

    fn is_at_its_radius(&self, steiner: &SteinerPoint<D>, vertex: VertexId) -> bool {
        let distance = distance(&steiner.point, self.delaunay.point(vertex));
        distance >= 0.5 * steiner.radius && distance <= 1.5 * steiner.radius
    }

    /// Returns the point on the way from v, the vertex of the worst cell that `corner` makes bad,
    /// to the corner, at the distance t that the bound allows, times [`cell_factor`]. The ball of
    /// radius t about it is inside the D-ball: no vertex is nearer to it than v.
    fn off_center_of_cell(
        &mut self,
        simplex: SimplexId,
        corner: &SteinerPoint<D>,
    ) -> Option<SteinerPoint<D>> {
        let vertex = self.worst_inner_cell(simplex, corner.radius)?;
        let allowed = 0.5 * self.stage.bound * self.cells[vertex].nearest;
        let radius = cell_factor::<D>() * allowed;
        let from = self.delaunay.point(vertex);
        let point = between(from, &corner.point, radius / corner.radius)?;
        let off_center = SteinerPoint { point, radius, is_corner: false };
        (self.is_sound(simplex, &off_center) && self.is_at_its_radius(&off_center, vertex))
            .then_some(off_center)
    }

    /// Returns the point on the way from the middle of the shortest edge to `corner` that makes a
    /// good triangle with the edge.
    fn off_center_of_edge(
        &mut self,
        simplex: SimplexId,
        corner: &SteinerPoint<D>,
    ) -> Option<SteinerPoint<D>> {
        let (a, b, length) = self.inner_short_edge(simplex, corner.radius)?;
        let (p, q) = (self.delaunay.point(a), self.delaunay.point(b));
        let middle = std::array::from_fn(|axis| p[axis] + 0.5 * (q[axis] - p[axis]));
        let bound = self.stage.bound;
        let apex = length * (bound + (bound * bound - 0.25).sqrt());
        let height = self.factor_in(simplex) * apex;
        let point = between(&middle, &corner.point, height / distance(&middle, &corner.point))?;
        let radius = distance(&point, p);
        let off_center = SteinerPoint { point, radius, is_corner: false };
        (self.is_sound(simplex, &off_center) && self.is_at_its_radius(&off_center, b))
            .then_some(off_center)
    }

    fn factor_in(&self, simplex: SimplexId) -> f64 {
        let vertices = self.delaunay.complex().vertices(simplex);
        match vertices.iter().all(|&vertex| self.segments.chains.holds(vertex)) {
            true => FACTOR_BETWEEN_SEGMENTS,
            false => edge_factor::<D>(),
        }
    }
}

/// Returns the point at `fraction` of the way; `None` if that is not before the end.
fn between<const D: usize>(from: &[f64; D], to: &[f64; D], fraction: f64) -> Option<[f64; D]> {
    (fraction < 1.0)
        .then(|| std::array::from_fn(|axis| from[axis] + fraction * (to[axis] - from[axis])))
}
