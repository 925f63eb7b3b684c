//! Facets that share an area, in one plane but for roundings. These would meet in slivers and at
//! random, so that they are looked at in a projection, where they are in one plane exactly.

use super::super::bends::{normal, normalized};
use super::super::intersections::each_pair;
use super::super::meet::meet;
use super::super::off_plane::is_clearly_off;
use super::super::pieces::{Piece, Pieces};
use super::super::plane::{Gauge, units_of};
use super::super::projection::Projection;
use crate::arrangement::poll::Poll;
use crate::arrangement::reach::Reach;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow, collected};
use crate::nearest::{Bounds, bounds_of};
use crate::numerics::{norm, orientation};
use std::array::from_fn;

/// Number of units in the last place by which boxes are larger than pieces, so that those meet that
/// are in one plane but for roundings.
const MARGIN: f64 = 16.0;

/// Pairs of facets that share an area, with the projection in which they are seen.
#[derive(Default)]
pub(super) struct Coplanar {
    /// Facets, the smaller number first, and an axis; sorted.
    pairs: Vec<([u32; 2], u8)>,
}

/// Edges of triangles, by their ends with the smaller one first, each with its facet; sorted.
pub(super) struct Edges(Vec<([u32; 2], u32)>);

/// Points in the projections along the axes, in the plane z = 0.
pub(super) struct Images([Vec<[f64; 3]>; 3]);

impl Images {
    /// Projects points along the axes that some pair of facets is seen along.
    fn of(points: &[[f64; 3]], is_used: [bool; 3]) -> AllocResult<Self> {
        let mut images: [Vec<[f64; 3]>; 3] = Default::default();
        for axis in (0..3).filter(|&axis| is_used[axis]) {
            let image = |x: &[f64; 3]| {
                let [u, v] = Projection::ALL[axis].image(x);
                [u, v, 0.0]
            };
            images[axis] = collected(points.iter().map(image))?;
        }
        Ok(Self(images))
    }
}

/// Returns the bounds of pieces, with a margin for roundings.
pub(super) fn wide_bounds(points: &[[f64; 3]], pieces: &Pieces) -> AllocResult<Vec<Bounds>> {
    let bounds = |piece: &Piece| -> Bounds {
        let corners = || piece.vertices().iter().map(|&vertex| &points[vertex as usize]);
        let ([low, high], units) = (bounds_of(corners()), units_of(corners()));
        [from_fn(|k| low[k] - MARGIN * units[k]), from_fn(|k| high[k] + MARGIN * units[k])]
    };
    collected(pieces.all.iter().map(bounds))
}

impl Coplanar {
    /// Finds the facets of which triangles share an area. O((n + k) log n) for n pieces and k pairs
    /// whose bounding boxes meet.
    pub fn find(points: &[[f64; 3]], pieces: &Pieces, poll: Poll<'_>) -> Result<Self> {
        let images = Images::of(points, [true; 3])?;
        let mut found = Self::default();
        each_pair(&wide_bounds(points, pieces)?, pieces, poll, |pair| {
            let own = pair.map(|piece| &pieces.all[piece as usize]);
            let [Some(one), Some(other)] = own.map(Piece::triangle) else { return Ok(()) };
            let [Some(first), Some(second)] = own.map(Piece::facet) else { return Ok(()) };
            match axis_of_common_area(points, &images, [one, other]) {
                Some(axis) => found.pairs.try_push(([first, second], axis as u8)),
                None => Ok(()),
            }
        })?;
        found.pairs.sort_unstable();
        found.pairs.dedup_by_key(|pair| pair.0);
        Ok(found)
    }

    pub fn is_empty(&self) -> bool {
        self.pairs.is_empty()
    }

    /// Returns the images of points that [`Self::seen_in`] needs.
    pub fn images(&self, points: &[[f64; 3]]) -> AllocResult<Images> {
        Images::of(points, [0, 1, 2].map(|axis| self.pairs.iter().any(|pair| pair.1 == axis)))
    }

    /// Returns the images of points in which two pieces are seen if their facets share an
    /// area; `None` for others.
    pub fn seen_in<'a>(&self, images: &'a Images, own: [&Piece; 2]) -> Option<&'a [[f64; 3]]> {
        let axis = self.axis_of([own[0].facet()?, own[1].facet()?])?;
        Some(&images.0[usize::from(axis)])
    }

    fn axis_of(&self, [a, b]: [u32; 2]) -> Option<u8> {
        let pair = [a.min(b), a.max(b)];
        let at = self.pairs.binary_search_by_key(&pair, |own| own.0).ok()?;
        Some(self.pairs[at].1)
    }

    /// Returns the edges of the triangles that share areas, each with its facet.
    pub fn edges(&self, pieces: &Pieces) -> AllocResult<Edges> {
        let mut facets = collected(self.pairs.iter().flat_map(|pair| pair.0))?;
        facets.sort_unstable();
        facets.dedup();
        let mut edges = Vec::new();
        for piece in &pieces.all {
            let (Some([a, b, c]), Some(facet)) = (piece.triangle(), piece.facet()) else {
                continue;
            };
            if facets.binary_search(&facet).is_ok() {
                for [from, to] in [[a, b], [b, c], [c, a]] {
                    edges.try_push(([from.min(to), from.max(to)], facet))?;
                }
            }
        }
        edges.sort_unstable();
        Ok(Edges(edges))
    }

    /// Returns true if an edge is in the plane of a facet: one that shares an area with this has
    /// it. Where the edge crosses the facet is up to roundings then.
    pub fn has_in_plane(&self, edges: &Edges, [from, to]: [u32; 2], facet: u32) -> bool {
        let edge = [from.min(to), from.max(to)];
        let begin = edges.0.partition_point(|own| own.0 < edge);
        let mut own = edges.0[begin..].iter().take_while(|own| own.0 == edge);
        own.any(|own| self.axis_of([own.1, facet]).is_some())
    }
}

/// Returns the axis along which two triangles are projected that share an area, in one plane but
/// for roundings: the vertices of the smaller are near the plane of the larger. `None` for others.
/// Triangles so small that rounding explains no gap beside their edges are in one plane exactly.
fn axis_of_common_area(points: &[[f64; 3]], images: &Images, both: [[u32; 3]; 2]) -> Option<usize> {
    let corners = both.map(|own| own.map(|vertex| &points[vertex as usize]));
    let units = units_of(corners.into_iter().flatten());
    let is_off = |[base, others]: [[&[f64; 3]; 3]; 2]| {
        others.iter().any(|x| is_clearly_off(base, &units, x))
    };
    // Most pairs of boxes end here. Which triangle is the smaller takes longer to tell.
    if is_off(corners) && is_off([corners[1], corners[0]]) {
        return None;
    }
    let size = |corners: [&[f64; 3]; 3]| {
        let (normal, exponent) = normalized(normal(corners));
        (exponent, norm(&normal))
    };
    let [large, small] = match size(corners[0]) < size(corners[1]) {
        true => [corners[1], corners[0]],
        false => corners,
    };
    let projection = Projection::of_triangle(large)?;
    let axis = Projection::ALL.iter().position(|own| *own == projection)?;
    // Triangles of one plane are many, and few of them share an area.
    let meeting = meet(&images.0[axis], &both[0], &both[1])?;
    let gauge = meeting.is_area().then(|| Gauge::new(large, units))?;
    let [low, high] = bounds_of(corners.into_iter().flatten());
    let is_long = Reach::of([&low, &high]).is_long();
    let is_on = |x: &[f64; 3]| {
        let [a, b, c] = large;
        orientation(&[a, b, c, x]).is_zero() || is_long && gauge.measure(x).0 <= 1.0
    };
    small.iter().all(|x| is_on(x)).then_some(axis)
}
