//! Subfacets: whether they and subsegments are in the mesh, their circles, and the way through a
//! sheet. All measures are taken in space, from the vertices themselves: relative to the size of a
//! triangle, its vertices are on the plane of the facet.

use crate::complex::{SimplexId, VertexId};
use crate::error::Error;
use crate::memory::AllocResult;
use crate::mesh::NONE;
use crate::netmesh::state::State;
use crate::netmesh::state::facets::Subfacet;
use crate::netmesh::state::facets::faces::FACES;
use crate::netmesh::state::facets::plane::Plane;
use crate::numerics::{Sign, cross, distance, dot};

/// Point of a sheet.
pub(in crate::netmesh) enum OnSheet {
    /// In a subfacet, or on an inner edge of it.
    At { subfacet: u32, edge: Option<usize> },
    /// Beyond a subsegment, or on it.
    Beyond(u32),
}

/// Returns the ways from one point to others, in a unit of their size: lengths of one up to the
/// square root of 3.
fn scaled_ways<const N: usize>(from: &[f64; 3], to: [&[f64; 3]; N]) -> ([[f64; 3]; N], f64) {
    let ways = to.map(|x| -> [f64; 3] { std::array::from_fn(|k| x[k] - from[k]) });
    let largest = ways.iter().flatten().fold(0.0f64, |most, way| most.max(way.abs()));
    let unit = if largest > 0.0 { largest } else { 1.0 };
    (ways.map(|way| way.map(|k| k / unit)), unit)
}

/// Returns the centre of the circle through three points, and its radius; infinite where they are
/// on a line.
pub(in crate::netmesh) fn circle([a, b, c]: [&[f64; 3]; 3]) -> ([f64; 3], f64) {
    let ([u, v], unit) = scaled_ways(a, [b, c]);
    let normal = cross(&u, &v);
    let square = dot(&normal, &normal);
    let (uu, vv) = (dot(&u, &u), dot(&v, &v));
    // (|u|^2 v - |v|^2 u) x n / (2 n^2), by the rule for the circumcentre.
    let mixed: [f64; 3] = std::array::from_fn(|k| uu * v[k] - vv * u[k]);
    let way = cross(&mixed, &normal).map(|k| k / (2.0 * square));
    let radius = unit * dot(&way, &way).sqrt();
    (std::array::from_fn(|k| a[k] + unit * way[k]), radius)
}

/// Returns the sine of the sum of the angles under which two points see the edge between `a` and
/// `b` from its two sides: positive where neither is in the circle through the other three.
pub(in crate::netmesh) fn sine_of_sum(a: &[f64; 3], b: &[f64; 3], apexes: [&[f64; 3]; 2]) -> f64 {
    let [(sine, cosine), (other_sine, other_cosine)] = apexes.map(|apex| {
        let ([u, v], _) = scaled_ways(apex, [a, b]);
        let normal = cross(&u, &v);
        let size = (dot(&u, &u) * dot(&v, &v)).sqrt();
        (dot(&normal, &normal).sqrt() / size, dot(&u, &v) / size)
    });
    sine * other_cosine + cosine * other_sine
}

impl State<3> {
    /// Returns true if an edge of the mesh goes from `a` to `b`.
    pub(in crate::netmesh) fn has_edge(&mut self, a: VertexId, b: VertexId) -> AllocResult<bool> {
        self.has_all(a.max(b), &[a.min(b)])
    }

    /// Returns true if a subfacet is a face of the mesh.
    pub(in crate::netmesh) fn has_face(&mut self, vertices: &[VertexId; 3]) -> AllocResult<bool> {
        let mut by_age = *vertices;
        by_age.sort_unstable();
        self.has_all(by_age[2], &by_age[..2])
    }

    /// Returns true if a simplex at `vertex` has all of `others`. The youngest of all should be
    /// `vertex`: it has the smallest star.
    fn has_all(&mut self, vertex: VertexId, others: &[VertexId]) -> AllocResult<bool> {
        let Self { delaunay, facets, .. } = self;
        match delaunay.complex().contains_vertex(vertex) {
            true => delaunay.star_has(vertex, others, &mut facets.star),
            false => Ok(false),
        }
    }

    pub(in crate::netmesh) fn points_of(&self, vertices: [VertexId; 3]) -> [&[f64; 3]; 3] {
        vertices.map(|vertex| self.delaunay.point(vertex))
    }

    /// Returns the error of a subfacet that doubles keep out of the mesh.
    pub(in crate::netmesh) fn error_of_lost(&self, subfacet: u32) -> Error {
        let Subfacet { facet, vertices: [corner, ..], .. } = *self.facets.get(subfacet);
        if self.facets.facets[facet as usize].parent == NONE {
            return Error::without_room(self.parameters.extent);
        }
        Error::without_room_for_facets(self.delaunay.point(corner))
    }

    /// Returns the centre of a subfacet's circle, and its radius.
    pub(in crate::netmesh) fn circle_of(&self, subfacet: u32) -> ([f64; 3], f64) {
        circle(self.points_of(self.facets.get(subfacet).vertices))
    }

    /// Returns the vertex opposite an inner edge of a subfacet.
    pub(in crate::netmesh) fn opposite(&self, subfacet: u32, edge: usize) -> VertexId {
        let own = self.facets.get(subfacet);
        let [a, b] = own.ends(edge);
        let beyond = self.facets.get(own.neighbors[edge]);
        let mirror = beyond.edge_between(a, b).unwrap_or(0);
        beyond.vertices[mirror]
    }

    /// Returns the sine of [`sine_of_sum`] at an inner edge of a subfacet, and true if the other
    /// diagonal of the two triangles there is inside both.
    pub(in crate::netmesh) fn diagonal(&self, subfacet: u32, edge: usize) -> (f64, bool) {
        let own = self.facets.get(subfacet);
        let plane = self.facets.plane_of(subfacet);
        let [a, b] = own.ends(edge).map(|end| self.delaunay.point(end));
        let [apex, beyond] = [own.vertices[edge], self.opposite(subfacet, edge)]
            .map(|vertex| self.delaunay.point(vertex));
        let sine = sine_of_sum(a, b, [apex, beyond]);
        let is_convex = plane.turn([apex, a, beyond]).is_positive()
            && plane.turn([apex, beyond, b]).is_positive();
        (sine, is_convex)
    }

    /// Returns true if a flip of an inner edge of a subfacet would make a subfacet that is there
    /// already. That is so where roundings have turned a triangle of the sheet over.
    pub(in crate::netmesh) fn would_repeat(&self, subfacet: u32, edge: usize) -> bool {
        let own = self.facets.get(subfacet);
        let (apex, beyond) = (own.vertices[edge], self.opposite(subfacet, edge));
        own.ends(edge).into_iter().any(|end| self.facets.face(&[apex, beyond, end]).is_some())
    }

    /// Returns the place of `x`, which is in the plane of a subfacet's facet, by a straight way
    /// from there through the sheet. Where subfacets are flat but for roundings the way may lead in
    /// a circle: then it ends there.
    pub(in crate::netmesh) fn walk_in_sheet(&self, from: u32, x: &[f64; 3]) -> OnSheet {
        let plane = *self.facets.plane_of(from);
        let [a, b, c] = self.points_of(self.facets.get(from).vertices);
        let start = plane.at(&std::array::from_fn(|k| (a[k] + b[k] + c[k]) / 3.0));
        let mut subfacet = from;
        let mut entry = None;
        // A circle comes back to where the way was after some power of two of steps (Brent).
        let (mut seen, mut next_look) = (from, 1usize);
        for step in 1.. {
            let own = *self.facets.get(subfacet);
            let Some(edge) = self.exit(&own, entry, &plane, [&start, x]) else {
                return self.place_in(subfacet, &plane, x);
            };
            if own.subsegments[edge] != NONE {
                return OnSheet::Beyond(own.subsegments[edge]);
            }
            let [a, b] = own.ends(edge);
            subfacet = own.neighbors[edge];
            entry = self.facets.get(subfacet).edge_between(a, b);
            if subfacet == seen {
                break;
            }
            if step == next_look {
                (seen, next_look) = (subfacet, 2 * next_look);
            }
        }
        self.place_in(subfacet, &plane, x)
    }

    /// Returns the edge by which a straight way leaves a subfacet; `None` if it ends there.
    fn exit(
        &self,
        own: &Subfacet,
        entry: Option<usize>,
        plane: &Plane,
        [start, x]: [&[f64; 3]; 2],
    ) -> Option<usize> {
        let beyond = (0..3).filter(|&edge| Some(edge) != entry).filter(|&edge| {
            let [a, b] = own.ends(edge).map(|end| self.delaunay.point(end));
            plane.turn([a, b, x]) == Sign::Negative
        });
        // Of two edges that it is beyond, the way leaves by the one whose ends it passes between.
        let passes = |&edge: &usize| {
            let [a, b] = own.ends(edge).map(|end| self.delaunay.point(end));
            plane.turn([start, x, a]) != Sign::Positive
                && plane.turn([start, x, b]) != Sign::Negative
        };
        let mut all = beyond.clone();
        match (all.next(), all.next()) {
            (Some(edge), None) => Some(edge),
            (first, _) => beyond.clone().find(passes).or(first),
        }
    }

    fn place_in(&self, subfacet: u32, plane: &Plane, x: &[f64; 3]) -> OnSheet {
        let own = self.facets.get(subfacet);
        let edge = (0..3).find(|&edge| {
            let [a, b] = own.ends(edge).map(|end| self.delaunay.point(end));
            plane.turn([a, b, x]) != Sign::Positive
        });
        match edge.map(|edge| own.subsegments[edge]) {
            Some(subsegment) if subsegment != NONE => OnSheet::Beyond(subsegment),
            _ => OnSheet::At { subfacet, edge },
        }
    }

    /// Returns true if a live simplex stays as it is: one that is flat, or whose neighbours on the
    /// boundary are too small to be split for it.
    pub(in crate::netmesh) fn is_kept(&self, simplex: SimplexId) -> bool {
        self.facets.is_kept(simplex) || self.is_flat(simplex) || self.is_at_small_angle(simplex)
    }

    /// Returns true if a live simplex is flat within a facet: it has a face that is a subfacet, and
    /// the vertex opposite is on the facet, and on its plane within roundings. One on the plane
    /// alone may be of a facet beside one that bends. On a facet that is bent itself, all four are
    /// on the plane of one triangle.
    pub(in crate::netmesh) fn is_flat(&self, simplex: SimplexId) -> bool {
        let vertices = self.delaunay.complex().vertices(simplex);
        if !vertices.iter().all(|&vertex| self.facets.holds(vertex)) {
            return false;
        }
        FACES.iter().enumerate().any(|(opposite, face)| {
            let subfacet = self.facets.face(&face.map(|at| vertices[at]));
            subfacet.is_some_and(|subfacet| {
                let (vertex, own) = (vertices[opposite], self.facets.get(subfacet).facet);
                let x = self.delaunay.point(vertex);
                let plane = self.facets.plane_at(own, x);
                let is_near = |vertex: &VertexId| plane.is_near(self.delaunay.point(*vertex));
                let is_flat = match self.facets.is_bent(own) {
                    true => vertices.iter().all(is_near),
                    false => is_near(&vertex),
                };
                let part = self.facets.first_part(own);
                is_flat && self.facets_of(vertex).any(|other| self.facets.first_part(other) == part)
            })
        })
    }

    /// Returns true if `x` is in the smallest ball through the vertices of a subfacet, but for
    /// roundings: in its plane that is its circle.
    pub(in crate::netmesh) fn is_in_circle(&self, subfacet: u32, x: &[f64; 3]) -> bool {
        let (center, radius) = self.circle_of(subfacet);
        distance(&center, x) < radius
    }
}
