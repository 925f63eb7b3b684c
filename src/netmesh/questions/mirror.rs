//! Mirror images: places in a facet beside vertices on facets or segments that meet it at a small
//! angle or face it at a small distance. The image of a vertex is its copy, turned about the line
//! where two facets meet, or its foot otherwise.
//!
//! A subfacet that such a vertex takes from the mesh is split at the image of that, not at the
//! centre of its circle. Where two sheets have images of each other's vertices, no vertex of one is
//! in the ball of a subfacet of the other, whatever their angle or distance: let c be the centre of
//! a subfacet's circle, at distance a from the line, and q a vertex of its facet, at distance b;
//! the copy q' of q, turned by the angle t, has |c q'|^2 = |c q|^2 + 2ab (1 - cos t). Split at
//! centres, each sheet would be split for the other, down to where doubles end or their distance.

use crate::complex::VertexId;
use crate::memory::AllocResult;
use crate::netmesh::questions::subfacets::OnSheet;
use crate::netmesh::state::State;
use crate::netmesh::state::facets::meetings::Meeting;
use crate::netmesh::state::facets::plane::Plane;
use crate::numerics::{distance, foot_on_line, norm, orientation};

/// Largest distance of a vertex from its image, relative to that of the image from the nearest
/// vertex in the sheet, where the image is a copy. With 0.3 fans of 14 facets and more about a
/// line, whose edges leave its ends at different angles, are split without end: each at centres of
/// its own, ever nearer to the line.
const BESIDE_COPY: f64 = 10.0;

/// Largest such part in a mesh that has had all of the boundary. With 10 some surfaces have half as
/// many vertices again.
const BESIDE_LATER_COPY: f64 = 0.3;

/// Largest such part where the image is a foot, for a subfacet of ordinary size. With 0.3 a wall
/// has a third more vertices, and most surfaces have as many as without images.
const BESIDE_FOOT: f64 = 0.03;

/// Largest such part for a subfacet that is deep.
const BESIDE_DEEP_FOOT: f64 = 0.3;

/// Radius of a subfacet that is deep, relative to that of the smallest of its facet before any was
/// split: facets without a common line split each other there.
const DEEP: f64 = 0.0625;

/// Subfacet that is to be split, with its circle.
struct Target {
    subfacet: u32,
    facet: u32,
    vertices: [VertexId; 3],
    center: [f64; 3],
    radius: f64,
    /// Largest distances of a vertex from its copy and from its foot, relative to that of these
    /// from the nearest vertex.
    beside_copy: f64,
    beside_foot: f64,
}

/// Image of a vertex in a sheet.
struct Image {
    vertex: VertexId,
    /// Subfacet that it is in.
    subfacet: u32,
    place: [f64; 3],
    /// Distance from the nearest vertex of the subfacet that is to be split.
    depth: f64,
}

impl Image {
    fn is_better_than(&self, other: &Self) -> bool {
        self.depth > other.depth || self.depth == other.depth && self.vertex < other.vertex
    }
}

impl State<3> {
    /// Returns the image of a vertex near a subfacet at which that is to be split, with the
    /// subfacet of the sheet that the image is in; of several images the one that is farthest from
    /// the vertices of the subfacet. Takes time linear in the simplices at these.
    pub(in crate::netmesh) fn image_to_split_at(
        &mut self,
        subfacet: u32,
    ) -> AllocResult<Option<(u32, [f64; 3])>> {
        let own = *self.facets.get(subfacet);
        let (center, radius) = self.circle_of(subfacet);
        let (facet, vertices) = (own.facet, own.vertices);
        let is_deep = radius < DEEP * self.facets.facets[facet as usize].first_radius;
        let is_recovered = self.segments.regions.is_known();
        let beside_copy = if is_recovered { BESIDE_LATER_COPY } else { BESIDE_COPY };
        let beside_foot = if is_deep { BESIDE_DEEP_FOOT } else { BESIDE_FOOT };
        let target = Target { subfacet, facet, vertices, center, radius, beside_copy, beside_foot };
        let mut star = std::mem::take(&mut self.facets.star);
        let mut around = std::mem::take(&mut self.facets.around);
        around.restart(self.delaunay.point_count())?;
        for vertex in vertices {
            self.delaunay.star(vertex, &mut star)?;
            for &simplex in &star {
                for &other in self.delaunay.complex().vertices(simplex) {
                    around.insert_finite(other)?;
                }
            }
        }
        let mut best: Option<Image> = None;
        for &vertex in &around.ids {
            if !self.may_have_image(vertex, &target) {
                continue;
            }
            let Some(image) = self.image_of(vertex, &target) else { continue };
            if best.as_ref().is_none_or(|best| image.is_better_than(best)) {
                best = Some(image);
            }
        }
        (self.facets.star, self.facets.around) = (star, around);
        Ok(best.map(|image| (image.subfacet, image.place)))
    }

    /// Returns true if a vertex is on the boundary, not on the facet of `target`, and in the
    /// smallest ball of that.
    fn may_have_image(&self, vertex: VertexId, target: &Target) -> bool {
        let is_on_boundary = self.facets.holds(vertex) || self.segments.chains.holds(vertex);
        if !is_on_boundary || target.vertices.contains(&vertex) {
            return false;
        }
        let x = self.delaunay.point(vertex);
        distance(x, &target.center) < target.radius
            && !self.facets_of(vertex).any(|facet| facet == target.facet)
    }

    /// Returns the image of a vertex in the sheet of `target`, if that is not much nearer to a
    /// vertex there than to its own.
    fn image_of(&self, vertex: VertexId, target: &Target) -> Option<Image> {
        let x = self.delaunay.point(vertex);
        let (place, beside) = match self.meeting_with(vertex, target.facet) {
            Some(Meeting::Line(line)) => (self.turned(x, line, target.facet), target.beside_copy),
            Some(Meeting::Vertex(_)) | None => {
                (self.facets.foot(target.facet, x), target.beside_foot)
            }
        };
        let gap = distance(x, &place);
        let nearest = |vertices: [VertexId; 3]| {
            let ways = vertices.map(|vertex| distance(self.delaunay.point(vertex), &place));
            ways.into_iter().fold(f64::INFINITY, f64::min)
        };
        let depth = nearest(target.vertices);
        let is_finite = place.iter().all(|x| x.is_finite());
        if !is_finite || gap > beside * depth {
            return None;
        }
        let OnSheet::At { subfacet, .. } = self.walk_in_sheet(target.subfacet, &place) else {
            return None;
        };
        let around = self.facets.get(subfacet).vertices;
        let plane = self.facets.plane_at(target.facet, x);
        let is_beside = gap <= beside * nearest(around)
            && [target.vertices, around].iter().all(|own| self.is_off(x, *own, plane));
        is_beside.then_some(Image { vertex, subfacet, place, depth })
    }

    /// Returns true if `x` is off a subfacet, on the same side as it is off the plane. An image
    /// would be on the wrong side of the vertex otherwise: where roundings, or triangles that were
    /// merged, have subfacets off their plane by more than the vertex is.
    fn is_off(&self, x: &[f64; 3], subfacet: [VertexId; 3], plane: &Plane) -> bool {
        let [a, b, c] = self.points_of(subfacet);
        let [u, v, w] = [a, b, c].map(|corner| plane.at(corner));
        let side = orientation(&[a, b, c, x]);
        !side.is_zero() && side == orientation(&[&u, &v, &w, x])
    }

    /// Returns the copy of `x`, turned about a line into a facet that has that.
    fn turned(&self, x: &[f64; 3], line: u32, facet: u32) -> [f64; 3] {
        let ends = self.segments.chains.lines[line as usize].ends;
        let foot = foot_on_line(x, ends.map(|end| self.delaunay.point(end)));
        let flat = self.facets.foot(facet, x);
        let way: [f64; 3] = std::array::from_fn(|k| flat[k] - foot[k]);
        let stretch = distance(x, &foot) / norm(&way);
        self.facets.point_at(facet, &std::array::from_fn(|k| foot[k] + stretch * way[k]))
    }

    /// Returns where a facet of `vertex` meets another facet at a small angle, a line if there is
    /// one.
    fn meeting_with(&self, vertex: VertexId, facet: u32) -> Option<Meeting> {
        let own = self.facets_of(vertex);
        let all = own.flat_map(|other| self.facets.meetings.of(other).with(facet));
        all.min_by_key(|at| matches!(at, Meeting::Vertex(_)))
    }
}
