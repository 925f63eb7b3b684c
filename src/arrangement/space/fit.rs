//! The boundary of an extent, with the inputs on it as vertices and with the caller's facets and
//! segments on it as parts.
//!
//! The sides of a box or hull go through the inputs that are near them, as facets do. On each side
//! the caller's edges are edges of its triangles, and where a triangle of the caller's is, the side
//! has none of its own.

use super::frame::{Frame, add_corners};
use super::hull::{Role, within_edges};
use super::intersections;
use super::isolated::{Isolated, is_outside_of};
use super::pieces::{Piece, Pieces};
use super::plane::Plane;
use super::polygon::{INTERIOR, Polygon};
use super::sides::Sides as Edges;
use crate::arrangement::poll::Poll;
use crate::error::{Choice, Error, ErrorKind, Result, say};
use crate::memory::{AllocResult, Lists, Sets, TryGrow, collected, copied, filled, with_capacity};
use crate::mesh::{FacetTriangle, Feature};
use crate::options::Extent;

/// Largest number of times that a hull is made up to rounding, with further points that it must
/// have.
const MOST_TRIES: usize = 16;

/// Boundary of an extent as triangles between vertices.
#[derive(Default)]
pub(super) struct Fitted {
    /// Triangles of its sides, but for those of the caller's facets there. The parts of a side
    /// between the caller's edges are facets of their own, by which the triangles are sorted.
    pub triangles: Vec<FacetTriangle>,
    /// Number of these facets.
    count: u32,
    /// Distances of the inputs that it goes through and that are not exactly on it.
    pub offsets: Vec<f64>,
}

/// Points, facets and segments that the boundary must go through.
struct Given<'a> {
    points: &'a [[f64; 3]],
    pieces: &'a Pieces,
    /// Edges of facets and segments, the smaller vertex first.
    edges: Vec<[u32; 2]>,
}

/// Vertices of each side, and its rim.
struct OnSides {
    /// Vertex -> the sides that it is on.
    at: Lists,
    /// Side -> its vertices.
    vertices: Lists,
    /// Edges at which sides end, through all vertices on them, with the side; by sides.
    rims: Vec<(u32, [u32; 2])>,
}

/// Returns the boundary of a box or hull of the points, to which the corners of a box are appended;
/// `None` with another extent. `pieces` are those of the caller.
///
/// # Errors
/// `DegenerateInput` (an extent without volume), `Limit`, `OutOfMemory`, and those of `poll`.
pub(super) fn fitted(
    points: &mut Vec<[f64; 3]>,
    extent: Extent,
    pieces: &Pieces,
    poll: Poll<'_>,
) -> Result<Option<Fitted>> {
    let corners = match extent {
        Extent::Auto | Extent::All | Extent::Boundary => return Ok(None),
        Extent::Box => Some(add_corners(points)?),
        Extent::Hull => None,
    };
    let points = &*points;
    let given = Given { points, pieces, edges: pieces.edges()? };
    let fitted = match corners {
        Some(corners) => {
            let frame = Frame::of_box(points, corners)?;
            match given.fit_near(&frame, poll)? {
                Near::Fitted(fitted) => Some(fitted),
                _ => given.fit_exactly(&frame, poll)?,
            }
        }
        None => match given.fit_hull(poll)? {
            Some(fitted) => Some(fitted),
            None => given.fit_exactly(&Frame::of_hull(points, None, poll)?, poll)?,
        },
    };
    fitted.map(Some).ok_or_else(|| {
        let message = say!(
            "doubles have no room between facets and the boundary of ",
            Choice::Extent(extent)
        );
        Error::new(ErrorKind::Limit, message)
    })
}

/// Outcome of leading a boundary through the inputs near it.
enum Near {
    Fitted(Fitted),
    /// Points that are outside, and on no side or edge.
    Lost(Vec<u32>),
    /// Roundings are in the way.
    Unfit,
}

impl Given<'_> {
    /// Returns the boundary of the hull up to rounding, through the inputs near it; `None` where
    /// roundings are in the way.
    fn fit_hull(&self, poll: Poll<'_>) -> Result<Option<Fitted>> {
        let mut roles = filled(self.points.len(), Role::Free)?;
        for _ in 0..MOST_TRIES {
            let mut frame = Frame::of_hull(self.points, Some(&roles), poll)?;
            let mut is_new = false;
            for vertex in within_edges(self.points, &frame.triangles)? {
                let role = &mut roles[vertex as usize];
                if *role == Role::Free {
                    (*role, is_new) = (Role::Never, true);
                }
            }
            if is_new {
                continue;
            }
            let never =
                (0..self.points.len() as u32).filter(|&at| roles[at as usize] == Role::Never);
            frame.outside.try_extend(&collected(never)?)?;
            match self.fit_near(&frame, poll)? {
                Near::Fitted(fitted) => return Ok(Some(fitted)),
                Near::Lost(lost) => lost.iter().for_each(|&at| roles[at as usize] = Role::Must),
                Near::Unfit => return Ok(None),
            }
        }
        Ok(None)
    }

    /// Returns the boundary through the inputs near it.
    fn fit_near(&self, frame: &Frame, poll: Poll<'_>) -> Result<Near> {
        let rims = frame.rims()?;
        let mut on = Isolated::find(self.points, &frame.pieces(&rims)?, false, poll)?;
        let homeless = on.settle()?;
        let placed = on.vertices()?;
        let lost = frame.outside.iter().filter(|point| placed.binary_search(point).is_err());
        let lost = collected(lost.copied())?;
        if !lost.is_empty() {
            return Ok(Near::Lost(lost));
        }
        match self.fit(frame, &rims, &on, poll)? {
            Some(fitted) if self.is_sound(&fitted, &homeless, poll)? => Ok(Near::Fitted(fitted)),
            _ => Ok(Near::Unfit),
        }
    }

    /// Returns the boundary through the inputs exactly on it.
    fn fit_exactly(&self, frame: &Frame, poll: Poll<'_>) -> Result<Option<Fitted>> {
        let rims = frame.rims()?;
        let on = Isolated::find(self.points, &frame.pieces(&rims)?, true, poll)?;
        self.fit(frame, &rims, &on, poll)
    }

    /// Returns the frame between the vertices on it; `None` where roundings are in the way.
    fn fit(
        &self,
        frame: &Frame,
        rims: &[([u32; 2], u32)],
        on: &Isolated,
        poll: Poll<'_>,
    ) -> Result<Option<Fitted>> {
        let sides = OnSides::new(self.points.len(), frame, rims, on)?;
        let (edges, covers) = (self.edges_on(&sides)?, self.triangles_on(&sides)?);
        let mut is_found = filled(self.pieces.all.len(), false)?;
        let mut fitted = Fitted { offsets: collected(on.offsets())?, ..Fitted::default() };
        for side in 0..frame.count {
            poll(1)?;
            let own = |pairs: &Lists| copied(pairs.of(side as usize));
            let (edges, covers) = (own(&edges)?, own(&covers)?);
            let mut lines = collected(edges.iter().map(|&edge| self.edges[edge as usize]))?;
            let cover = |&piece: &u32| self.pieces.all[piece as usize].triangle();
            for [a, b, c] in covers.iter().filter_map(cover) {
                lines.try_extend(&[[a, b], [b, c], [c, a]])?;
            }
            let Some(mut triangles) = self.tiles(&sides, side, &lines, poll)? else {
                return Ok(None);
            };
            if !covers.is_empty() {
                let key = |mut vertices: [u32; 3]| {
                    vertices.sort_unstable();
                    vertices
                };
                let mut keys = with_capacity(covers.len())?;
                for &piece in &covers {
                    keys.extend(cover(&piece).map(|vertices| (key(vertices), piece)));
                }
                keys.sort_unstable();
                triangles.retain(|&vertices| {
                    let found = keys.binary_search_by_key(&key(vertices), |&(key, _)| key);
                    found.map(|at| is_found[keys[at].1 as usize] = true).is_err()
                });
            }
            self.add_parts(&triangles, &mut fitted, poll)?;
        }
        let mut all = covers.iter().flatten();
        let is_whole = all.all(|&piece| is_found[piece as usize]);
        Ok(is_whole.then_some(fitted))
    }

    /// Adds the triangles of a side, in parts between the caller's edges.
    fn add_parts(&self, triangles: &[[u32; 3]], fitted: &mut Fitted, poll: Poll<'_>) -> Result<()> {
        let mut parts = Sets::new(triangles.len())?;
        for group in Edges::of_triangles(triangles, poll)?.groups().filter(|group| group.len() == 2)
        {
            if self.edges.binary_search(&group[0].ends).is_err() {
                parts.join(group[0].triangle as usize, group[1].triangle as usize);
            }
        }
        let mut order = with_capacity(triangles.len())?;
        for at in 0..triangles.len() {
            order.push((parts.find(at), at));
        }
        order.sort_unstable();
        for part in order.chunk_by(|a, b| a.0 == b.0) {
            for &(_, at) in part {
                let (vertices, facet) = (triangles[at], fitted.count);
                fitted.triangles.try_push(FacetTriangle { vertices, facet })?;
            }
            fitted.count += 1;
        }
        Ok(())
    }

    /// Returns the triangles of a side that have these edges; `None` if its edges meet in its
    /// projection, or some edges would be outside of it.
    fn tiles(
        &self,
        sides: &OnSides,
        side: u32,
        lines: &[[u32; 2]],
        poll: Poll<'_>,
    ) -> Result<Option<Vec<[u32; 3]>>> {
        let begin = sides.rims.partition_point(|rim| rim.0 < side);
        let end = sides.rims.partition_point(|rim| rim.0 <= side);
        let rim = collected(sides.rims[begin..end].iter().map(|rim| rim.1))?;
        let vertices = copied(sides.vertices.of(side as usize))?;
        let polygon = Polygon::of_rim(vertices, &rim, lines)?;
        if !polygon.has_sides() {
            return Ok(Some(Vec::new()));
        }
        let Some(plane) = Plane::of(self.points, &polygon.vertices) else { return Ok(None) };
        let tiling = polygon.tiling(self.points, plane.projection, &[], poll)?;
        Ok(tiling
            .filter(|tiling| tiling.lines.len() == tiling.lines_inside)
            .map(|all| all.triangles))
    }

    /// Returns for each side the edges on it, by their numbers.
    fn edges_on(&self, sides: &OnSides) -> AllocResult<Lists> {
        let of_edge = |(at, &[from, to]): (usize, &[u32; 2])| {
            let on_both = sides.at.of(from as usize).iter();
            let on_both = on_both.filter(move |side| sides.at.of(to as usize).contains(side));
            on_both.map(move |&side| (side, at as u32))
        };
        let edges = || self.edges.iter().enumerate().flat_map(of_edge);
        Lists::of_pairs(sides.vertices.count(), edges)
    }

    /// Returns for each side the caller's triangles on it, by the numbers of their pieces.
    fn triangles_on(&self, sides: &OnSides) -> AllocResult<Lists> {
        let of_piece = |(at, piece): (usize, &Piece)| {
            let own = piece.triangle().into_iter();
            own.flat_map(move |[a, b, c]| {
                let on_all = sides.at.of(a as usize).iter();
                let has = |vertex: u32, side: &u32| sides.at.of(vertex as usize).contains(side);
                let on_all = on_all.filter(move |side| has(b, side) && has(c, side));
                on_all.map(move |&side| (side, at as u32))
            })
        };
        let triangles = || self.pieces.all.iter().enumerate().flat_map(of_piece);
        Lists::of_pairs(sides.vertices.count(), triangles)
    }

    /// Returns true if a boundary that may be bent meets the caller's facets and itself only in
    /// what they share, and leaves no point outside that is near a corner.
    fn is_sound(&self, fitted: &Fitted, homeless: &[u32], poll: Poll<'_>) -> Result<bool> {
        for triangle in &fitted.triangles {
            let corners = triangle.vertices.map(|vertex| &self.points[vertex as usize]);
            let is_outside = |&at: &u32| is_outside_of(corners, &self.points[at as usize]);
            if homeless.iter().any(is_outside) {
                return Ok(false);
            }
        }
        let mut all = Pieces { all: copied(&self.pieces.all)?, ..Pieces::default() };
        let first = 1 + all.all.iter().filter_map(Piece::facet).max().unwrap_or(0);
        for triangle in &fitted.triangles {
            let part = Feature::Facet(first + triangle.facet);
            all.all.try_push(Piece::of_triangle(triangle.vertices, INTERIOR, part))?;
        }
        Ok(intersections::all(self.points, &all, poll)?.is_empty())
    }
}

impl OnSides {
    fn new(
        points: usize,
        frame: &Frame,
        rims: &[([u32; 2], u32)],
        on: &Isolated,
    ) -> AllocResult<Self> {
        let mut parts = with_capacity(rims.len())?;
        for &(ends, side) in rims {
            for part in on.chain(ends) {
                parts.try_push((side, part))?;
            }
        }
        parts.sort_unstable();
        let mut pairs = Vec::new();
        for (vertices, &side) in frame.triangles.iter().zip(&frame.sides) {
            pairs.try_extend(&vertices.map(|vertex| (side, vertex)))?;
        }
        for &(side, ends) in &parts {
            pairs.try_extend(&ends.map(|end| (side, end)))?;
        }
        for side in 0..frame.count {
            for vertex in on.within(side) {
                pairs.try_push((side, vertex))?;
            }
        }
        pairs.sort_unstable();
        pairs.dedup();
        let at = Lists::of_pairs(points, || pairs.iter().map(|&(side, vertex)| (vertex, side)))?;
        let vertices = Lists::of_pairs(frame.count as usize, || pairs.iter().copied())?;
        Ok(Self { at, vertices, rims: parts })
    }
}
