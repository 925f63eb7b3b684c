//! Facets and segments as triangles and segments between vertices.

use super::bends::are_flat;
use super::crossed::meeting_of_edges;
use super::plane::{OffPlane, Plane};
use super::polygon::{INTERIOR, Polygon, PolygonEdge, Tiling};
use super::projection::Projection;
use crate::arrangement::poll::Poll;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow, collected, with_capacity};
use crate::mesh::{Facets, Feature, Inputs, Intersection, IntersectionKind, Segments};

/// Triangle or segment between vertices, a part of a feature.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    vertices: [u32; 3],
    count: u8,
    /// Bit f is set if face f of the piece is in the interior of the feature.
    pub inner: u8,
    pub feature: Feature,
}

/// Facets and segments, and what is wrong with single ones.
#[derive(Default)]
pub(super) struct Pieces {
    /// Pieces of facets in the order of these, then the segments. Of a facet that meets itself these
    /// are its edges.
    pub all: Vec<Piece>,
    /// Edges of polygons, in these or outside of them, that bound no facet.
    pub lines: Vec<[u32; 2]>,
    /// Facets that meet themselves, or have no area.
    pub faults: Vec<Intersection>,
    /// First facet that is not plane, with the vertex that is farthest off.
    pub off_plane: Option<(u32, OffPlane)>,
}

/// Bit for the interior of a segment.
const INTERIOR_OF_SEGMENT: u8 = 1 << 0b11;

impl Piece {
    pub fn vertices(&self) -> &[u32] {
        &self.vertices[..usize::from(self.count)]
    }

    /// Returns the vertices of a triangle; `None` for a segment.
    pub fn triangle(&self) -> Option<[u32; 3]> {
        (self.count == 3).then_some(self.vertices)
    }

    fn of_triangle(vertices: [u32; 3], inner: u8, feature: Feature) -> Self {
        Self { vertices, count: 3, inner, feature }
    }

    fn of_segment([from, to]: [u32; 2], feature: Feature) -> Self {
        Self { vertices: [from, to, to], count: 2, inner: INTERIOR_OF_SEGMENT, feature }
    }
}

impl Pieces {
    /// Splits facets into triangles, exactly, in projections of them. Polygons whose vertices are
    /// off a plane are split, too. `coplanar`: largest angle in degrees by which a polygon may
    /// bend. Expected O(n log n) for n inputs of the facets.
    pub fn new(
        points: &[[f64; 3]],
        inputs: &Inputs,
        facets: &Facets,
        segments: &Segments,
        coplanar: f64,
        poll: Poll<'_>,
    ) -> Result<Self> {
        let mut pieces = Self::default();
        match facets.are_triangles {
            true => pieces.add_triangles(points, inputs, facets)?,
            false => {
                let mut maker = Maker { points, coplanar, pieces: &mut pieces };
                maker.add_polygons(inputs, facets, segments, poll)?;
            }
        }
        for (segment, ends) in (0u32..).zip(&segments.inputs) {
            let ends = ends.map(|end| inputs.vertices()[end as usize]);
            pieces.all.try_push(Piece::of_segment(ends, Feature::Segment(segment)))?;
        }
        Ok(pieces)
    }

    fn add_triangles(
        &mut self,
        points: &[[f64; 3]],
        inputs: &Inputs,
        facets: &Facets,
    ) -> Result<()> {
        self.all = with_capacity(facets.count())?;
        for (facet, own) in (0u32..).zip(facets.inputs.chunks_exact(3)) {
            let vertices: [u32; 3] = std::array::from_fn(|k| inputs.vertices()[own[k] as usize]);
            let feature = Feature::Facet(facet);
            let corners = vertices.map(|vertex| &points[vertex as usize]);
            match Projection::of_triangle(corners) {
                Some(_) => {
                    self.all.try_push(Piece::of_triangle(vertices, INTERIOR, feature))?;
                }
                None => self.note_zero_area(feature, corners[0])?,
            }
        }
        Ok(())
    }

    fn note_zero_area(&mut self, facet: Feature, point: &[f64; 3]) -> AllocResult<()> {
        self.note(facet, IntersectionKind::ZeroArea, *point)
    }

    fn note(&mut self, facet: Feature, kind: IntersectionKind, point: [f64; 3]) -> AllocResult<()> {
        self.faults.try_push(Intersection { first: facet, second: facet, kind, point })
    }
}

/// Splits polygons into pieces.
struct Maker<'a> {
    points: &'a [[f64; 3]],
    coplanar: f64,
    pieces: &'a mut Pieces,
}

impl Maker<'_> {
    fn add_polygons(
        &mut self,
        inputs: &Inputs,
        facets: &Facets,
        segments: &Segments,
        poll: Poll<'_>,
    ) -> Result<()> {
        let vertex = |input: u32| inputs.vertices()[input as usize];
        let mut polygons = with_capacity(facets.count())?;
        for facet in 0..facets.count() {
            polygons.push(Polygon::new(facets.loops(facet), vertex)?);
        }
        let edges = Edges::new(&polygons, segments.inputs.iter().map(|ends| ends.map(vertex)))?;
        for (facet, polygon) in (0u32..).zip(&polygons) {
            poll(1)?;
            self.add_polygon(facet, polygon, &edges, poll)?;
        }
        Ok(())
    }

    fn add_polygon(
        &mut self,
        facet: u32,
        polygon: &Polygon,
        edges: &Edges,
        poll: Poll<'_>,
    ) -> Result<()> {
        let feature = Feature::Facet(facet);
        if !polygon.has_sides() {
            return Ok(self.add_edges(polygon, feature)?);
        }
        let Some(plane) = Plane::of(self.points, &polygon.vertices) else {
            let first = self.points[polygon.vertices[0] as usize];
            return Ok(self.pieces.note_zero_area(feature, &first)?);
        };
        let adopted = edges.within(polygon)?;
        let Some(tiling) = polygon.tiling(self.points, &plane, &adopted, poll)? else {
            self.note_meeting_itself(polygon, &plane, feature)?;
            return Ok(self.add_edges(polygon, feature)?);
        };
        if tiling.triangles.is_empty() {
            let first = self.points[polygon.vertices[0] as usize];
            self.pieces.note_zero_area(feature, &first)?;
        }
        if self.pieces.off_plane.is_none() {
            let off = plane.farthest(self.points, &polygon.vertices);
            if let Some(off) = off {
                let is_flat = are_flat(self.points, &tiling.triangles, self.coplanar)?;
                self.pieces.off_plane = (!is_flat).then_some((facet, off));
            }
        }
        Ok(self.add_tiling(&tiling, feature)?)
    }

    fn add_tiling(&mut self, tiling: &Tiling, feature: Feature) -> AllocResult<()> {
        for (&vertices, &inner) in tiling.triangles.iter().zip(&tiling.inner) {
            self.pieces.all.try_push(Piece::of_triangle(vertices, inner, feature))?;
        }
        for &line in &tiling.lines[tiling.lines_inside..] {
            self.pieces.all.try_push(Piece::of_segment(line, feature))?;
        }
        self.pieces.lines.try_extend(&tiling.lines)
    }

    /// Adds the edges of a polygon as lines.
    fn add_edges(&mut self, polygon: &Polygon, feature: Feature) -> AllocResult<()> {
        for edge in &polygon.edges {
            let ends = polygon.ends(edge);
            self.pieces.lines.try_push(ends)?;
            self.pieces.all.try_push(Piece::of_segment(ends, feature))?;
        }
        Ok(())
    }

    /// Notes a fault of a polygon whose edges meet in the projection of its plane.
    fn note_meeting_itself(
        &mut self,
        polygon: &Polygon,
        plane: &Plane,
        feature: Feature,
    ) -> Result<()> {
        let (kind, point) = meeting_of_edges(self.points, polygon, plane)?;
        Ok(self.pieces.note(feature, kind, point)?)
    }
}

/// Edges of all polygons and all segments, in both directions, sorted, each once.
struct Edges(Vec<[u32; 2]>);

impl Edges {
    fn new(polygons: &[Polygon], segments: impl Iterator<Item = [u32; 2]>) -> AllocResult<Self> {
        let mut all: Vec<[u32; 2]> = collected(segments)?;
        for polygon in polygons {
            for edge in &polygon.edges {
                all.try_push(polygon.ends(edge))?;
            }
        }
        let count = all.len();
        for at in 0..count {
            let [from, to] = all[at];
            all.try_push([to, from])?;
        }
        all.sort_unstable();
        all.dedup();
        Ok(Self(all))
    }

    /// Returns the edges between vertices of a polygon that are none of its own, by the positions
    /// of the vertices in it, sorted.
    fn within(&self, polygon: &Polygon) -> AllocResult<Vec<[u32; 2]>> {
        let mut found = Vec::new();
        let own = &polygon.vertices;
        let is_new = |ends: [u32; 2]| {
            let same = |edge: &PolygonEdge| edge.ends.cmp(&ends);
            polygon.edges.binary_search_by(same).is_err()
        };
        let begin = |from: u32| self.0.partition_point(|edge| edge[0] < from);
        let pairs = own.len() * own.len() / 2;
        let others = own.iter().map(|&from| begin(from + 1) - begin(from)).sum::<usize>();
        if pairs <= others {
            for second in 0..own.len() {
                for first in 0..second {
                    let ends = [first as u32, second as u32];
                    let edge = [own[first], own[second]];
                    if is_new(ends) && self.0.binary_search(&edge).is_ok() {
                        found.try_push(ends)?;
                    }
                }
            }
        } else {
            for (first, &from) in own.iter().enumerate() {
                for &[_, to] in &self.0[begin(from)..begin(from + 1)] {
                    let second = own.partition_point(|&vertex| vertex < to);
                    let ends = [first as u32, second as u32];
                    if first < second && own.get(second) == Some(&to) && is_new(ends) {
                        found.try_push(ends)?;
                    }
                }
            }
        }
        found.sort_unstable();
        Ok(found)
    }
}
