//! Edges of a polygon that meet each other though they must not.

use super::boxes::{BoxTree, bounds_of};
use super::meet::{Meeting, is_between, meet};
use super::plane::Plane;
use super::polygon::Polygon;
use super::projection::Projection;
use crate::arrangement::poll::Poll;
use crate::error::Result;
use crate::memory::collected;
use crate::mesh::IntersectionKind;
use crate::numerics::point_between;

/// Returns how, and about where, edges of a polygon meet in the projection of its plane: the worst
/// case, and of these the one of the first edges. A vertex without an edge that is on an edge
/// touches it.
pub(super) fn meeting_of_edges(
    points: &[[f64; 3]],
    polygon: &Polygon,
    plane: &Plane,
) -> Result<(IntersectionKind, [f64; 3])> {
    let image = |&vertex: &u32| {
        let [x, y] = plane.projection.image(&points[vertex as usize]);
        [x, y, 0.0]
    };
    let images = collected(polygon.vertices.iter().map(image))?;
    let bounds = polygon
        .edges
        .iter()
        .map(|edge| bounds_of(edge.ends.iter().map(|&end| &images[end as usize])));
    let bounds = collected(bounds)?;
    let mut worst: Option<(IntersectionKind, [u32; 2], Meeting)> = None;
    let visit = |pair: [u32; 2], _: Poll<'_>| {
        let [one, other] = pair.map(|edge| &polygon.edges[edge as usize].ends[..]);
        if let Some(meeting) = meet(&images, one, other) {
            let kind = meeting.kind([1 << 0b11; 2]);
            let rank = |kind: IntersectionKind, pair| (std::cmp::Reverse(kind.rank()), pair);
            let is_worse =
                worst.as_ref().is_none_or(|(last, of, _)| rank(kind, pair) < rank(*last, *of));
            if is_worse {
                worst = Some((kind, pair, meeting));
            }
        }
        Ok(())
    };
    BoxTree::new(&bounds)?.each_pair(&mut |_| Ok(()), visit)?;
    let vertex = |end: u32| &points[polygon.vertices[end as usize] as usize];
    if let Some((kind, pair, meeting)) = worst {
        let [one, other] = pair.map(|edge| polygon.edges[edge as usize].ends);
        let place = meeting.point(&images, &one, &other);
        let [from, to] = one.map(|end| &images[end as usize]);
        let axis = usize::from((to[1] - from[1]).abs() > (to[0] - from[0]).abs());
        let share = (0.5 * place[axis] - 0.5 * from[axis]) / (0.5 * to[axis] - 0.5 * from[axis]);
        let [from, to] = one.map(vertex);
        let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 };
        return Ok((kind, point_between(from, to, share)));
    }
    // No two edges meet, so that some edge meets a vertex that has none, or vertices have one
    // image.
    let mut alone = (0..polygon.vertices.len() as u32)
        .filter(|end| !polygon.edges.iter().any(|edge| edge.ends.contains(end)));
    let is_met = |&end: &u32| {
        polygon.edges.iter().any(|edge| {
            let ([a, b], x) = (edge.ends.map(|end| &images[end as usize]), &images[end as usize]);
            Projection::ALL[2].turn([a, b, x]).is_zero() && is_between([a, b], x)
        })
    };
    let place = alone.find(is_met).unwrap_or(0);
    Ok((IntersectionKind::Touch, *vertex(place)))
}
