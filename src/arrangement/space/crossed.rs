//! Edges of a polygon that meet each other though they must not.

use super::meet::{Meeting, is_between, meet};
use super::polygon::{Polygon, PolygonEdge};
use super::projection::Projection;
use crate::arrangement::poll::Poll;
use crate::error::Result;
use crate::memory::{AllocResult, collected};
use crate::mesh::IntersectionKind;
use crate::nearest::{BoxTree, bounds_of};
use crate::numerics::{point_between, scale_of_differences};

/// Returns how, and about where, edges of a polygon meet in a projection: the worst case, and of
/// these the one of the first edges. A vertex without an edge that is on an edge touches it.
pub(super) fn meeting_of_edges(
    points: &[[f64; 3]],
    polygon: &Polygon,
    projection: Projection,
) -> Result<(IntersectionKind, [f64; 3])> {
    let images = images(points, polygon, projection)?;
    let mut worst: Option<(IntersectionKind, [u32; 2], Meeting)> = None;
    each_meeting_of_edges(&images, polygon, |pair, meeting| {
        let kind = meeting.kind([1 << 0b11; 2]);
        let rank = |kind: IntersectionKind, pair| (std::cmp::Reverse(kind.rank()), pair);
        let is_worse =
            worst.as_ref().is_none_or(|(last, of, _)| rank(kind, pair) < rank(*last, *of));
        if is_worse {
            worst = Some((kind, pair, *meeting));
        }
        Ok(())
    })?;
    if let Some((kind, pair, meeting)) = worst {
        let [one, other] = pair.map(|edge| polygon.edges[edge as usize].ends);
        let place = meeting.point(&images, &one, &other);
        return Ok((kind, point_of_edge(points, polygon, &images, one, &place)));
    }
    // No two edges meet, so that some edge meets a vertex that has none, or vertices have one
    // image.
    let place = vertices_on_edges(&images, polygon).next().map_or(0, |(vertex, _)| vertex);
    Ok((IntersectionKind::Touch, points[polygon.vertices[place as usize] as usize]))
}

/// Returns the vertices of a polygon in a projection, in the plane z = 0.
pub(super) fn images(
    points: &[[f64; 3]],
    polygon: &Polygon,
    projection: Projection,
) -> AllocResult<Vec<[f64; 3]>> {
    collected(polygon.vertices.iter().map(|&vertex| {
        let [x, y] = projection.image(&points[vertex as usize]);
        [x, y, 0.0]
    }))
}

/// Calls `visit` with all pairs of edges of a polygon that meet in a projection.
pub(super) fn each_meeting_of_edges(
    images: &[[f64; 3]],
    polygon: &Polygon,
    mut visit: impl FnMut([u32; 2], &Meeting) -> AllocResult<()>,
) -> Result<()> {
    let bounds = polygon
        .edges
        .iter()
        .map(|edge| bounds_of(edge.ends.iter().map(|&end| &images[end as usize])));
    let bounds = collected(bounds)?;
    let visit = |pair: [u32; 2], _: Poll<'_>| {
        let [one, other] = pair.map(|edge| &polygon.edges[edge as usize].ends[..]);
        match meet(images, one, other) {
            Some(meeting) => Ok(visit(pair, &meeting)?),
            None => Ok(()),
        }
    };
    BoxTree::new(&bounds)?.each_pair(&mut |_| Ok(()), visit)
}

/// Returns the vertices of a polygon that have no edge and are on edges in a projection, each with
/// the first of these edges.
pub(super) fn vertices_on_edges<'a>(
    images: &'a [[f64; 3]],
    polygon: &'a Polygon,
) -> impl Iterator<Item = (u32, u32)> + 'a {
    let has_edge = |&end: &u32| polygon.edges.iter().any(|edge| edge.ends.contains(&end));
    let alone = (0..polygon.vertices.len() as u32).filter(move |end| !has_edge(end));
    alone.filter_map(|end| {
        let is_on = |edge: &PolygonEdge| {
            let ([a, b], x) = (edge.ends.map(|end| &images[end as usize]), &images[end as usize]);
            Projection::ALL[2].turn([a, b, x]).is_zero() && is_between([a, b], x)
        };
        polygon.edges.iter().position(is_on).map(|edge| (end, edge as u32))
    })
}

/// Returns the point of an edge of a polygon, given by its ends, whose image is a place on it.
pub(super) fn point_of_edge(
    points: &[[f64; 3]],
    polygon: &Polygon,
    images: &[[f64; 3]],
    edge: [u32; 2],
    place: &[f64; 3],
) -> [f64; 3] {
    let ends = edge.map(|end| &points[polygon.vertices[end as usize] as usize]);
    point_over(ends, edge.map(|end| &images[end as usize]), place)
}

/// Returns the point of an edge whose image is a place on it.
pub(super) fn point_over(
    ends: [&[f64; 3]; 2],
    [from, to]: [&[f64; 3]; 2],
    place: &[f64; 3],
) -> [f64; 3] {
    let axis = usize::from((to[1] - from[1]).abs() > (to[0] - from[0]).abs());
    let scale = scale_of_differences([from, to]);
    let step = |x: &[f64; 3]| scale * x[axis] - scale * from[axis];
    let share = step(place) / step(to);
    let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 };
    point_between(ends[0], ends[1], share)
}
