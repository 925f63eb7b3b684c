//! The corners of what pairs of pieces share.

use super::super::crossed::{each_meeting_of_edges, images, point_of_edge, vertices_on_edges};
use super::super::intersections::each_pair;
use super::super::meet::{Face, corner, meet};
use super::super::pieces::{Piece, Pieces, Untiled};
use super::areas::Areas;
use super::candidates::Candidate;
use super::coplanar::{Coplanar, Edges, wide_bounds};
use super::finest::{corner_of, finest, on_planes};
use super::owners::Owners;
use super::roundings::units_of_roundings;
use crate::arrangement::poll::Poll;
use crate::arrangement::reach::Reach;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow};
use crate::mesh::NONE;
use crate::nearest::bounds_of;

/// Corners of what pieces share, by pairs of pieces, and the points where there is no vertex yet.
#[derive(Default)]
pub(super) struct Corners {
    pub all: Vec<Corner>,
    pub candidates: Vec<Candidate>,
    pub areas: Areas,
}

/// Corner of what two pieces share.
#[derive(Clone, Copy)]
pub(super) struct Corner {
    /// Number of the pair, in the order in which pairs are found.
    pub pair: u32,
    pub pieces: [u32; 2],
    /// Face of each piece that has the corner in its interior.
    pub faces: [Face; 2],
    pub vertex: Vertex,
}

/// Vertex at a corner.
#[derive(Clone, Copy)]
pub(super) enum Vertex {
    Known(u32),
    /// Candidate to become a vertex.
    Candidate(u32),
}

/// Face of an edge alone.
const EDGE: Face = 0b11;

impl Corners {
    /// Finds the corners of all pairs of pieces that meet though they must not, and of all edges of
    /// polygons that meet in the projections of these.
    pub fn find(
        points: &[[f64; 3]],
        pieces: &Pieces,
        owners: &Owners,
        coplanar: &Coplanar,
        poll: Poll<'_>,
    ) -> Result<Self> {
        let mut found = Self::default();
        let mut pairs = 0;
        let (images, edges) = (coplanar.images(points)?, coplanar.edges(pieces)?);
        each_pair(&wide_bounds(points, pieces)?, pieces, poll, |both| {
            let own = both.map(|piece| &pieces.all[piece as usize]);
            if let Some(images) = coplanar.seen_in(&images, own) {
                return found.add_area([points, images], pieces, owners, both);
            }
            let vertices = own.map(Piece::vertices);
            if are_one_triangle(vertices) {
                found.areas.pairs.try_push(both)?;
                return Ok(());
            }
            let Some(meeting) = meet(points, vertices[0], vertices[1]) else { return Ok(()) };
            let is_crossing = |faces: &&[Face; 2]| {
                !is_in_plane(&edges, coplanar, owners, own, **faces)
                    && !is_in_plane(
                        &edges,
                        coplanar,
                        owners,
                        [own[1], own[0]],
                        [faces[1], faces[0]],
                    )
            };
            for &faces in meeting.corners().iter().filter(is_crossing) {
                let place = || corner_of(points, vertices, faces);
                let vertex = found.vertex_at(points, owners, vertices, faces, place)?;
                found.all.try_push(Corner { pair: pairs, pieces: both, faces, vertex })?;
            }
            pairs += 1;
            Ok(())
        })?;
        for untiled in &pieces.untiled {
            found.add_of_polygon(points, untiled, owners, &mut pairs)?;
        }
        Ok(found)
    }

    /// Returns the vertex at a corner of what two pieces share. A new one is at the `place`.
    pub(super) fn vertex_at(
        &mut self,
        points: &[[f64; 3]],
        owners: &Owners,
        vertices: [&[u32]; 2],
        faces: [Face; 2],
        place: impl FnOnce() -> [f64; 3],
    ) -> AllocResult<Vertex> {
        let single = (0..2).find(|&which| faces[which].count_ones() == 1);
        match single {
            Some(which) => {
                Ok(Vertex::Known(vertices[which][faces[which].trailing_zeros() as usize]))
            }
            None => {
                let x = place();
                let units = units(points, vertices.into_iter().flatten().copied());
                let edges = [0, 1].map(|which: usize| match faces[which].count_ones() {
                    2 => owners.straight(edge_of(vertices[which], faces[which])),
                    _ => [NONE; 2],
                });
                self.candidate(Candidate { x, units, edges, facets: None })
            }
        }
    }

    fn candidate(&mut self, candidate: Candidate) -> AllocResult<Vertex> {
        self.candidates.try_push(candidate)?;
        Ok(Vertex::Candidate(self.candidates.len() as u32 - 1))
    }

    fn add_of_polygon(
        &mut self,
        points: &[[f64; 3]],
        untiled: &Untiled,
        owners: &Owners,
        pairs: &mut u32,
    ) -> Result<()> {
        let Untiled { polygon, projection, facet, first_piece, .. } = untiled;
        let images = images(points, polygon, *projection)?;
        each_meeting_of_edges(&images, polygon, |edges, meeting| {
            let ends = edges.map(|edge| polygon.edges[edge as usize].ends);
            for &faces in meeting.corners() {
                let single = (0..2).find(|&which| faces[which].count_ones() == 1);
                let vertex = match single {
                    Some(which) => {
                        let at = ends[which][faces[which].trailing_zeros() as usize];
                        Vertex::Known(polygon.vertices[at as usize])
                    }
                    None => {
                        let place = corner(&images, [&ends[0], &ends[1]], faces);
                        let on = |which: usize| {
                            point_of_edge(points, polygon, &images, ends[which], &place)
                        };
                        let parts = ends.map(|ends| ends.map(|end| polygon.vertices[end as usize]));
                        let x = finest(points, parts, on(0), || on(1));
                        let units = units(points, parts.iter().flatten().copied());
                        let facets = crossing_facets(owners, *facet, parts);
                        let triangles = facets.map(|own| own.map(|facet| owners.triangle(facet)));
                        let x = match triangles {
                            Some([Some(a), Some(b), Some(c)]) => {
                                on_planes(points, [a, b, c], x, &units)
                            }
                            _ => x,
                        };
                        let edges = parts.map(|part| owners.straight(part));
                        self.candidate(Candidate { x, units, edges, facets })?
                    }
                };
                let pieces = edges.map(|edge| first_piece + edge);
                self.all.try_push(Corner { pair: *pairs, pieces, faces, vertex })?;
            }
            *pairs += 1;
            Ok(())
        })?;
        for (vertex, edge) in vertices_on_edges(&images, polygon) {
            let vertex = Vertex::Known(polygon.vertices[vertex as usize]);
            let (pieces, faces) = ([first_piece + edge; 2], [EDGE; 2]);
            self.all.try_push(Corner { pair: *pairs, pieces, faces, vertex })?;
            *pairs += 1;
        }
        Ok(())
    }
}

/// Returns true if a corner is where an edge of the first piece, in the plane of the second one's
/// facet, meets that apart from its edges: it does so as the facet beside the edge does, and where
/// it crosses is up to roundings.
fn is_in_plane(
    edges: &Edges,
    coplanar: &Coplanar,
    owners: &Owners,
    own: [&Piece; 2],
    faces: [Face; 2],
) -> bool {
    let [edge, face] = [0, 1].map(|which: usize| edge_of(own[which].vertices(), faces[which]));
    let is_on_edge = faces[1].count_ones() == 1 || faces[1].count_ones() == 2 && owners.has(face);
    let facet = own[1].facet().filter(|_| faces[0].count_ones() == 2 && !is_on_edge);
    facet.is_some_and(|facet| coplanar.has_in_plane(edges, edge, facet))
}

/// Returns the units in the last place of the largest coordinates of vertices; zeros if these are
/// too close to each other for rounding to explain a gap.
fn units(points: &[[f64; 3]], vertices: impl Iterator<Item = u32> + Clone) -> [f64; 3] {
    let corners = vertices.map(|vertex| &points[vertex as usize]);
    let [low, high] = bounds_of(corners.clone());
    match Reach::of([&low, &high]).is_long() {
        true => units_of_roundings(corners),
        false => [0.0; 3],
    }
}

/// Returns the three facets of which two lines in a facet are crossings, if each is one with a
/// single other facet.
fn crossing_facets(owners: &Owners, facet: u32, parts: [[u32; 2]; 2]) -> Option<[u32; 3]> {
    let other = |part: [u32; 2]| {
        let mut all = owners.of(part).flat_map(|line| owners.facets_with(line));
        let first = all.find(|&other| other != facet)?;
        all.all(|other| other == facet || other == first).then_some(first)
    };
    let mut facets = [facet, other(parts[0])?, other(parts[1])?];
    facets.sort_unstable();
    (facets[0] < facets[1] && facets[1] < facets[2]).then_some(facets)
}

/// Returns true if two pieces are triangles with the same vertices. Where their facets are not in
/// one plane such are no wider than roundings, and have no crossing.
fn are_one_triangle([one, other]: [&[u32]; 2]) -> bool {
    one.len() == 3 && other.len() == 3 && one.iter().all(|vertex| other.contains(vertex))
}

/// Returns the ends of an edge of a piece.
pub(super) fn edge_of(vertices: &[u32], face: Face) -> [u32; 2] {
    let has = |at: &usize| face >> at & 1 == 1;
    let first = (0..vertices.len()).find(has).unwrap_or(0);
    let last = (0..vertices.len()).rev().find(has).unwrap_or(0);
    [vertices[first], vertices[last]]
}
