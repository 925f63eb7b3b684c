//! Facets and segments as triangles and segments between vertices.

use super::TaskInSpace;
use super::bends::are_flat;
use super::crossed::meeting_of_edges;
use super::duplicates::balances;
use super::isolated::Isolated;
use super::meet::Face;
use super::plane::{OffPlane, Plane};
use super::polygon::{INTERIOR, Polygon, PolygonEdge, Tiling};
use super::projection::Projection;
use crate::arrangement::poll::Poll;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow, collected, with_capacity};
use crate::mesh::{Feature, Intersection, IntersectionKind};

/// Triangle or segment between vertices, a part of a feature.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    vertices: [u32; 3],
    count: u8,
    /// Bit f is set if face f of the piece is in the interior of the feature.
    pub inner: u8,
    pub feature: Feature,
    /// Step of the winding number from the front of a triangle to its back.
    pub balance: i64,
}

/// Facets and segments, and what is wrong with single ones.
#[derive(Default)]
pub(super) struct Pieces {
    /// Pieces of facets in the order of these, then the segments. Of a facet that meets itself
    /// these are its edges.
    pub all: Vec<Piece>,
    /// Triangles on those of earlier facets, which have their balances. They are not among the
    /// others.
    pub borrowed: Vec<Piece>,
    /// Borrowed triangle -> the piece in `all` that has its area.
    pub lenders: Vec<u32>,
    /// Triangle of a surface -> by how much the winding number grows behind it; `None` for those of
    /// which an earlier one has the vertices.
    pub balances: Vec<Option<i64>>,
    /// Edges of polygons, in these or outside of them, that bound no facet.
    pub lines: Vec<[u32; 2]>,
    /// First facet with an area that has some of these.
    pub first_lined: Option<u32>,
    /// Facets that meet themselves, or have no area.
    pub faults: Vec<Intersection>,
    /// Facets that meet themselves, for their crossings to be found.
    pub untiled: Vec<Untiled>,
    /// First facet that is not plane, with its vertex that is farthest off.
    pub off_plane: Option<(u32, OffPlane)>,
}

/// Facet that meets itself in a projection.
pub(super) struct Untiled {
    pub polygon: Polygon,
    pub projection: Projection,
    pub facet: u32,
    /// True if it is not plane, and meets itself in the projections along all axes.
    pub is_bent: bool,
    /// Number of the piece of the polygon's first edge, which those of the others follow.
    pub first_piece: u32,
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

    /// Returns the facet that the piece is a part of; `None` for a segment.
    pub fn facet(&self) -> Option<u32> {
        match self.feature {
            Feature::Facet(facet) => Some(facet),
            Feature::Segment(_) => None,
        }
    }

    pub fn of_triangle(vertices: [u32; 3], inner: u8, feature: Feature) -> Self {
        Self { vertices, count: 3, inner, feature, balance: 1 }
    }

    fn of_segment([from, to]: [u32; 2], feature: Feature) -> Self {
        let (vertices, inner) = ([from, to, to], INTERIOR_OF_SEGMENT);
        Self { vertices, count: 2, inner, feature, balance: 1 }
    }
}

impl Pieces {
    /// Splits facets into triangles, exactly, in projections of them. Polygons whose vertices are
    /// off a plane are split, too. Edges and facets go through the `isolated` vertices on them.
    /// Expected O(n log n) for n inputs of the facets.
    pub fn new(
        points: &[[f64; 3]],
        task: &TaskInSpace<'_>,
        isolated: &Isolated,
        poll: Poll<'_>,
    ) -> Result<Self> {
        let TaskInSpace { inputs, facets, segments, .. } = *task;
        let mut pieces = Self::default();
        let mut maker = Maker { points, task, isolated, pieces: &mut pieces };
        match facets.are_triangles {
            true => maker.add_triangles(poll)?,
            false => maker.add_polygons(poll)?,
        }
        for (segment, ends) in (0u32..).zip(&segments.inputs) {
            let ends = ends.map(|end| inputs.vertices()[end as usize]);
            for part in isolated.chain(ends) {
                pieces.all.try_push(Piece::of_segment(part, Feature::Segment(segment)))?;
            }
        }
        Ok(pieces)
    }

    /// Returns the first polygon that is not plane, and bent by more than the task allows. Those
    /// that are plane are not split into triangles. O(n log n) for n inputs of the facets.
    pub fn first_bent(
        points: &[[f64; 3]],
        task: &TaskInSpace<'_>,
        poll: Poll<'_>,
    ) -> Result<Option<u32>> {
        let (isolated, pieces) = (&Isolated::default(), &mut Self::default());
        let maker = Maker { points, task, isolated, pieces };
        let polygons = maker.polygons()?;
        let is_off = |polygon: &&Polygon| {
            let plane = Plane::of(points, &polygon.vertices);
            plane.is_some_and(|plane| plane.farthest(points, &polygon.vertices).is_some())
        };
        let mut bent = (0u32..).zip(&polygons).filter(|(_, polygon)| is_off(polygon)).peekable();
        if bent.peek().is_none() {
            return Ok(None);
        }
        let edges = maker.edges(&polygons)?;
        for (facet, polygon) in bent {
            poll(1)?;
            let (adopted, all) = (edges.within(polygon)?, maker.projections(facet));
            match maker.tiling(polygon, &all, &adopted, poll)? {
                Some((tiling, at)) if maker.is_flat(&tiling, at, poll)? => {}
                _ => return Ok(Some(facet)),
            }
        }
        Ok(None)
    }

    /// Returns the edges of facets and segments, the smaller vertex first, each once; sorted.
    pub fn edges(&self) -> AllocResult<Vec<[u32; 2]>> {
        let mut edges = Vec::new();
        for piece in &self.all {
            let own = piece.vertices();
            let sides: &[[usize; 2]] = match own.len() {
                3 => &[[0, 1], [1, 2], [2, 0]],
                _ => &[[0, 1]],
            };
            for &[from, to] in sides {
                let face: Face = 1 << from | 1 << to;
                let is_inner = own.len() == 3 && piece.inner >> face & 1 == 1;
                if !is_inner {
                    edges.try_push([own[from].min(own[to]), own[from].max(own[to])])?;
                }
            }
        }
        edges.try_extend(&self.lines)?;
        edges.sort_unstable();
        edges.dedup();
        Ok(edges)
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
    task: &'a TaskInSpace<'a>,
    isolated: &'a Isolated,
    pieces: &'a mut Pieces,
}

impl Maker<'_> {
    fn add_triangles(&mut self, poll: Poll<'_>) -> Result<()> {
        let TaskInSpace { inputs, facets, .. } = *self.task;
        let balances = balances(self.task)?;
        let is_kept = |facet: &u32| balances[*facet as usize].is_some();
        let vertex = |input: u32| inputs.vertices()[input as usize];
        self.pieces.all = with_capacity(facets.count())?;
        let triangles = (0u32..).zip(facets.inputs.chunks_exact(3));
        for (facet, own) in triangles.filter(|(facet, _)| is_kept(facet)) {
            let vertices = [own[0], own[1], own[2]].map(vertex);
            let feature = Feature::Facet(facet);
            let corners = vertices.map(|vertex| &self.points[vertex as usize]);
            if Projection::of_triangle(corners).is_none() {
                self.pieces.note_zero_area(feature, corners[0])?;
            } else if self.isolated.splits(vertices) || self.isolated.count_within(facet) > 0 {
                let polygon = Polygon::new([own].into_iter(), vertex, self.isolated, facet)?;
                let (first, untiled) = (self.pieces.all.len(), self.pieces.untiled.len());
                self.add_polygon(facet, polygon, &[], poll)?;
                let has_area =
                    self.pieces.all[first..].iter().any(|piece| piece.triangle().is_some());
                // Led through its third corner it has no area any more: others have its edges.
                if !has_area && self.pieces.untiled.len() == untiled {
                    self.pieces.all.truncate(first);
                }
            } else {
                self.pieces.all.try_push(Piece::of_triangle(vertices, INTERIOR, feature))?;
            }
        }
        for piece in &mut self.pieces.all {
            piece.balance = piece.facet().and_then(|own| balances[own as usize]).unwrap_or(1);
        }
        self.pieces.balances = balances;
        Ok(())
    }

    fn add_polygons(&mut self, poll: Poll<'_>) -> Result<()> {
        let polygons = self.polygons()?;
        let edges = self.edges(&polygons)?;
        for (facet, polygon) in (0u32..).zip(polygons) {
            poll(1)?;
            let adopted = edges.within(&polygon)?;
            self.add_polygon(facet, polygon, &adopted, poll)?;
        }
        Ok(())
    }

    /// Returns the polygons of all facets.
    fn polygons(&self) -> AllocResult<Vec<Polygon>> {
        let TaskInSpace { inputs, facets, .. } = *self.task;
        let vertex = |input: u32| inputs.vertices()[input as usize];
        let mut polygons = with_capacity(facets.count())?;
        for facet in 0..facets.count() {
            let loops = facets.loops(facet);
            polygons.push(Polygon::new(loops, vertex, self.isolated, facet as u32)?);
        }
        Ok(polygons)
    }

    /// Returns the edges of polygons, and of all segments.
    fn edges(&self, polygons: &[Polygon]) -> AllocResult<Edges> {
        let TaskInSpace { inputs, segments, .. } = *self.task;
        let vertex = |input: u32| inputs.vertices()[input as usize];
        let parts = segments.inputs.iter().flat_map(|ends| self.isolated.chain(ends.map(vertex)));
        Edges::new(polygons, parts)
    }

    fn add_polygon(
        &mut self,
        facet: u32,
        polygon: Polygon,
        adopted: &[[u32; 2]],
        poll: Poll<'_>,
    ) -> Result<()> {
        let feature = Feature::Facet(facet);
        if !polygon.has_sides() {
            return Ok(self.add_edges(&polygon, feature)?);
        }
        let Some(plane) = Plane::of(self.points, &polygon.vertices) else {
            let first = self.points[polygon.vertices[0] as usize];
            return Ok(self.pieces.note_zero_area(feature, &first)?);
        };
        let off = plane.farthest(self.points, &polygon.vertices);
        let is_bent = off.is_some() && !self.task.facets.are_triangles;
        let off = off.filter(|_| self.pieces.off_plane.is_none()).map(|off| (facet, off));
        let all = if is_bent { self.projections(facet) } else { [plane.projection; 3] };
        // Facets that were led through vertices are split where they meet themselves.
        let is_given = is_bent && self.isolated.is_empty();
        let projections = if is_given { &all[..] } else { &all[..1] };
        let Some((tiling, at)) = self.tiling(&polygon, projections, adopted, poll)? else {
            self.pieces.off_plane = self.pieces.off_plane.or(off);
            let projection = projections[0];
            let (kind, point) = meeting_of_edges(self.points, &polygon, projection)?;
            self.pieces.note(feature, kind, point)?;
            let first_piece = self.pieces.all.len() as u32;
            self.add_edges(&polygon, feature)?;
            let untiled = Untiled { polygon, projection, facet, is_bent, first_piece };
            return Ok(self.pieces.untiled.try_push(untiled)?);
        };
        if tiling.triangles.is_empty() {
            let first = self.points[polygon.vertices[0] as usize];
            self.pieces.note_zero_area(feature, &first)?;
        } else if !tiling.lines.is_empty() {
            self.pieces.first_lined = self.pieces.first_lined.or(Some(facet));
        }
        if off.is_some() && !self.is_flat(&tiling, at, poll)? {
            self.pieces.off_plane = off;
        }
        Ok(self.add_tiling(&tiling, feature)?)
    }

    /// Returns the projections of a facet along all axes, that in which it is largest first.
    fn projections(&self, facet: u32) -> [Projection; 3] {
        let TaskInSpace { inputs, facets, .. } = *self.task;
        let vertex = |input: u32| inputs.vertices()[input as usize];
        Projection::by_area(self.points, facets.loops(facet as usize), vertex)
    }

    /// Returns the triangles of a polygon in the first of some projections in which it does not
    /// meet itself, and the position of that.
    fn tiling(
        &self,
        polygon: &Polygon,
        projections: &[Projection],
        adopted: &[[u32; 2]],
        poll: Poll<'_>,
    ) -> Result<Option<(Tiling, usize)>> {
        for (at, &projection) in projections.iter().enumerate() {
            if let Some(tiling) = polygon.tiling(self.points, projection, adopted, poll)? {
                return Ok(Some((tiling, at)));
            }
        }
        Ok(None)
    }

    /// Returns true if the triangles of a polygon that is not plane, in its projection with that
    /// number, are bent by no more than the task allows. A polygon that meets itself in its first
    /// projection is bent too far to be a facet.
    fn is_flat(&self, tiling: &Tiling, at: usize, poll: Poll<'_>) -> Result<bool> {
        Ok(at == 0 && are_flat(self.points, &tiling.triangles, self.task.coplanar, poll)?)
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
