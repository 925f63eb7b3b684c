//! Small angles of the input in space. Facets and segments that meet at one have vertices as near
//! to each other as the angle makes them. A simplex whose shortest edge is between two of these is
//! forced: to refine it would make the next one, nearer to where they meet (G. L. Miller, S. E. Pav
//! and N. J. Walkington, "When and why Delaunay refinement algorithms work", 2005).

use crate::complex::{SimplexId, VertexId};
use crate::netmesh::state::State;
use crate::netmesh::state::facets::faces::EDGES;
use crate::netmesh::state::facets::meetings::{Meeting, TinyAngles};
use crate::numerics::{distance, norm, shortest_distance};

/// Largest cosine of angles between segments, or a segment and a facet, that are not small.
pub(in crate::netmesh) const SMALL: f64 = 0.5;

/// Cosine of angles so small that all simplices between what meets at them are forced.
pub(in crate::netmesh) const TINY: f64 = 0.9659;

/// Largest cosines of the angles at which two vertices may be seen that no angle of the input
/// excuses.
#[derive(Clone, Copy)]
struct Largest {
    /// From a vertex where their facets or segments meet.
    at_vertex: f64,
    /// From such a vertex where any facets meet at a tiny angle.
    at_tiny: f64,
    /// From a line where their facets meet.
    at_line: f64,
}

const ALL: Largest = Largest { at_vertex: SMALL, at_tiny: SMALL, at_line: SMALL_DIHEDRAL };

/// Refinement goes on down to 30 and 60 degrees, less than the theory asks for, but at vertices
/// where it would not end soon.
const REFINED: Largest = Largest { at_vertex: 0.866, at_tiny: SMALL, at_line: 0.5 };

const ALL_TINY: Largest = Largest { at_vertex: TINY, at_tiny: TINY, at_line: TINY };

/// Largest cosine of dihedral angles that are not small.
pub(in crate::netmesh) const SMALL_DIHEDRAL: f64 = 0.1736;

impl State<3> {
    /// Returns true if the shortest edge of a live simplex goes from a facet or segment to another
    /// one that meets it at a small angle.
    pub(in crate::netmesh) fn is_at_small_angle(&self, simplex: SimplexId) -> bool {
        let vertices = self.delaunay.complex().vertices(simplex);
        let on_boundary = vertices.iter().filter(|&&vertex| self.facets.holds(vertex));
        if on_boundary.count() < 2 || vertices.contains(&VertexId::INFINITE) {
            return false;
        }
        let points: [&[f64; 3]; 4] = std::array::from_fn(|at| self.delaunay.point(vertices[at]));
        let (a, b, _) = shortest_distance(&points);
        if self.spans_small_angle([vertices[a], vertices[b]], REFINED) {
            return true;
        }
        let is_near = |&&vertex: &&VertexId| {
            self.facets.facets_at(vertex).iter().any(|&facet| self.facets.is_sharp_facet(facet))
                || self.segments.chains.line_through(vertex).is_some()
        };
        if vertices.iter().filter(is_near).count() < 2 {
            return false;
        }
        EDGES.iter().any(|&[i, j]| {
            let edge = [vertices[i], vertices[j]];
            self.spans_small_angle(edge, ALL_TINY)
        })
    }

    /// Returns true if any two vertices of a live simplex are on facets or segments that meet at a
    /// small angle.
    pub(in crate::netmesh) fn has_small_angle(&self, simplex: SimplexId) -> bool {
        let vertices = self.delaunay.complex().vertices(simplex);
        EDGES.iter().any(|&[i, j]| {
            let edge = [vertices[i], vertices[j]];
            self.spans_small_angle(edge, ALL)
        })
    }

    /// Returns true if two vertices are on facets or segments that meet at a small angle, and on
    /// none that has both.
    fn spans_small_angle(&self, [u, v]: [VertexId; 2], largest: Largest) -> bool {
        let chains = &self.segments.chains;
        if let (Some(first), Some(second)) = (chains.line_through(u), chains.line_through(v)) {
            let [first, second] = [first, second].map(|line| chains.lines[line as usize]);
            if let Some((center, _)) = first.corner_with(&second) {
                return self.see_small_angle(center, [u, v], largest);
            }
        }
        let is_on = |vertex, facet| self.facets_of(vertex).any(|other| other == facet);
        self.facets_of(u).any(|f| {
            let met = self.facets.meetings.of(f);
            !met.is_empty()
                && self.facets_of(v).any(|g| {
                    let mut at = met.with(g).peekable();
                    // Rarer than meetings, and longer to find out.
                    let are_apart = || !is_on(v, f) && !is_on(u, g);
                    at.peek().is_some()
                        && are_apart()
                        && at.any(|at| self.is_at_meeting(at, [u, v], largest))
                })
        })
    }

    /// Returns the facets that a vertex is on, an end of lines, on a line or between lines.
    pub(in crate::netmesh) fn facets_of(&self, vertex: VertexId) -> impl Iterator<Item = u32> {
        let subsegment = self.segments.chains.subsegments_at(vertex).map(|[before, _]| before);
        let pages = subsegment.into_iter().flat_map(|before| self.facets.pages(before));
        let own = pages.map(|page| self.facets.get(page).facet);
        let others = match subsegment {
            Some(_) => &[],
            None => self.facets.facets_at(vertex),
        };
        own.chain(others.iter().copied())
    }

    /// Returns true if two vertices are seen at a small angle from where facets of theirs meet.
    fn is_at_meeting(&self, at: Meeting, [u, v]: [VertexId; 2], largest: Largest) -> bool {
        match at {
            Meeting::Line(line) => {
                let ends = self.segments.chains.lines[line as usize].ends;
                self.cosine_at(&self.foot(ends, u, v), u, v) > largest.at_line
            }
            Meeting::Vertex(vertex) => self.see_small_angle(vertex, [u, v], largest),
        }
    }

    /// Returns true if two vertices are seen at a small angle from one where their facets or
    /// segments meet.
    fn see_small_angle(&self, from: VertexId, [u, v]: [VertexId; 2], largest: Largest) -> bool {
        let most = match self.facets.meetings.tiny_angles_at(from) {
            TinyAngles::None => largest.at_vertex,
            TinyAngles::InFans | TinyAngles::OfFins => largest.at_tiny,
        };
        self.cosine_at(self.delaunay.point(from), u, v) > most
    }

    /// Returns the point of a line that is nearest to the middle of two vertices.
    pub(in crate::netmesh) fn foot(
        &self,
        ends: [VertexId; 2],
        u: VertexId,
        v: VertexId,
    ) -> [f64; 3] {
        let [a, b, u, v] = [ends[0], ends[1], u, v].map(|vertex| self.delaunay.point(vertex));
        let unit = distance(a, b);
        let way: [f64; 3] = std::array::from_fn(|k| (b[k] - a[k]) / unit);
        let middle: [f64; 3] = std::array::from_fn(|k| 0.5 * (u[k] - a[k]) + 0.5 * (v[k] - a[k]));
        let along: f64 = (0..3).map(|k| way[k] * (middle[k] / unit)).sum();
        let along = along.clamp(0.0, 1.0) * unit;
        std::array::from_fn(|k| a[k] + along * way[k])
    }

    /// Returns the cosine of the angle at which two vertices are seen from `x`.
    pub(in crate::netmesh) fn cosine_at(&self, x: &[f64; 3], u: VertexId, v: VertexId) -> f64 {
        let [u, v] = [u, v].map(|vertex| {
            let to = self.delaunay.point(vertex);
            std::array::from_fn::<f64, 3, _>(|k| to[k] - x[k])
        });
        cosine(&u, &v)
    }
}

/// Returns the cosine of the angle between two directions.
pub(in crate::netmesh) fn cosine(u: &[f64; 3], v: &[f64; 3]) -> f64 {
    let lengths = [norm(u), norm(v)];
    (0..3).map(|k| (u[k] / lengths[0]) * (v[k] / lengths[1])).sum()
}
