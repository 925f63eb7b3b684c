//! A last look at facets and edges that were led through vertices: they are near the given ones,
//! and whole.

use super::super::TaskInSpace;
use super::super::isolated::Isolated;
use super::super::pieces::{Piece, Pieces};
use super::super::plane::{Gauge, from_line};
use super::super::sides::Sides;
use super::owners::Owners;
use super::roundings::Roundings;
use crate::arrangement::poll::Poll;
use crate::error::Result;
use crate::memory::{TryGrow, collected};
use crate::mesh::Feature;
use crate::numerics::{distance, orientation};

/// Largest distance of a vertex from its facet, in what rounding explains of a point in it: six
/// units in the last place.
const MOST_OFF: f64 = 2.5;

/// Largest distance of a vertex from the edge that goes through it, in units in the last place.
const MOST_BENT: f64 = 15.0;

/// Distance of a corner from another edge of its facet, in units in the last place, up to which the
/// edge could be taken for one that is bent through it. It is larger than any bend.
const MISTAKEN: f64 = 17.0;

/// Returns true if no edge and no facet goes through vertices farther from it than segments may
/// be bent, no edge beside which rounding explains no gap through inputs that are not on it, and if
/// the triangles of each facet end at its edges. Where nothing meets exactly all facets are to be
/// wider than bends, too: otherwise they had better stay as they are. O(n log n) for facets of few
/// corners.
pub(super) fn is_sound(
    points: &[[f64; 3]],
    task: &TaskInSpace<'_>,
    pieces: &Pieces,
    owners: &Owners,
    on: &Isolated,
    meets_exactly: bool,
    poll: Poll<'_>,
) -> Result<bool> {
    let roundings = &owners.roundings.of_bends();
    let is_straight = |(edge, vertex): ([u32; 2], u32)| {
        let bends = (vertex as usize) >= task.inputs.distinct()
            || owners.roundings.reach(points, edge).is_long();
        owners.edges().binary_search(&edge).is_err()
            || roundings.reach(points, edge).offset_from_segment(&points[vertex as usize])
                <= if bends { MOST_BENT } else { 0.0 }
    };
    if !on.on_edges().all(is_straight) {
        return Ok(false);
    }
    for own in pieces.all.chunk_by(|a, b| a.feature == b.feature) {
        if let Feature::Facet(facet) = own[0].feature {
            let is_whole =
                is_wider_than_bends(points, task, on, facet, (roundings, !meets_exactly))
                    && goes_beside_one_corner_at_most(points, task, facet, own, &owners.roundings)
                    && own.iter().any(|piece| piece.triangle().is_some())
                    && is_flat(points, task, facet, own, roundings)
                    && ends_at_its_edges(task, on, facet, own, poll)?;
            if !is_whole {
                return Ok(false);
            }
        }
    }
    Ok(true)
}

/// Returns the vertices of the inputs of a facet.
fn corners_of(task: &TaskInSpace<'_>, facet: u32) -> impl Iterator<Item = u32> + Clone {
    let vertices = task.inputs.vertices();
    task.facets.loops(facet as usize).flatten().map(|&input| vertices[input as usize])
}

/// Returns true if no corner of a facet is as near to another of its edges as that may be bent: led
/// through vertices, such an edge is not to be told from one that begins at the corner. Asks for
/// `all` edges, or for those that are led through vertices.
fn is_wider_than_bends(
    points: &[[f64; 3]],
    task: &TaskInSpace<'_>,
    on: &Isolated,
    facet: u32,
    (roundings, all): (&Roundings, bool),
) -> bool {
    let vertex = |&input: &u32| task.inputs.vertices()[input as usize];
    let corners = corners_of(task, facet);
    task.facets.loops(facet as usize).all(|own| {
        (0..own.len()).all(|at| {
            let edge = [at, (at + 1) % own.len()].map(|at| vertex(&own[at]));
            let mut chain = on.chain(edge);
            if edge[0] == edge[1] || !all && chain.nth(1).is_none() {
                return true;
            }
            let ends = edge.map(|end| &points[end as usize]);
            let (reach, units) =
                (roundings.reach(points, edge), roundings.units_of(ends.into_iter()));
            let is_beside = |x: &[f64; 3]| {
                let is_at =
                    |end: &&[f64; 3]| (0..3).all(|k| (x[k] - end[k]).abs() <= MISTAKEN * units[k]);
                (reach.is_between(x) || ends.iter().any(is_at))
                    && reach.offset_from_segment(x) <= MISTAKEN
            };
            corners.clone().all(|corner| {
                let is_on = || on.chain(edge).any(|part| part.contains(&corner));
                !is_beside(&points[corner as usize]) || is_on()
            })
        })
    })
}

/// Returns true if a facet goes through no inputs of others that are as near to two of its corners
/// as an edge may be bent: which of both ends the edge between these is not to be told. They are
/// one vertex if the caller merges points.
fn goes_beside_one_corner_at_most(
    points: &[[f64; 3]],
    task: &TaskInSpace<'_>,
    facet: u32,
    own: &[Piece],
    roundings: &Roundings,
) -> bool {
    let corners = corners_of(task, facet);
    let is_at = |corner: u32, vertex: u32| {
        let [x, y] = [corner, vertex].map(|at| &points[at as usize]);
        let units = roundings.units_of([x, y].into_iter());
        corner != vertex && (0..3).all(|k| (x[k] - y[k]).abs() <= MISTAKEN * units[k])
    };
    let own = || own.iter().flat_map(Piece::vertices).copied();
    // Corners of one facet may be as near to each other as they like.
    let is_other = |vertex: &u32| {
        (*vertex as usize) < task.inputs.distinct() && corners.clone().all(|own| own != *vertex)
    };
    let is_beside = |corner: &u32| own().filter(is_other).any(|other| is_at(*corner, other));
    corners.clone().filter(is_beside).count() < 2
}

/// Returns true if the vertices of a facet's triangles are near its plane, or as far from it as its
/// corners are: a polygon may be bent.
fn is_flat(
    points: &[[f64; 3]],
    task: &TaskInSpace<'_>,
    facet: u32,
    own: &[Piece],
    roundings: &Roundings,
) -> bool {
    let corners = corners_of(task, facet);
    let corners = corners.map(|vertex| &points[vertex as usize]);
    let most = |size: &dyn Fn(&[f64; 3]) -> f64| {
        corners.clone().max_by(|x, y| size(x).total_cmp(&size(y)))
    };
    let Some(first) = corners.clone().next() else { return true };
    let Some(a) = most(&|x| distance(first, x)) else { return true };
    let Some(b) = most(&|x| distance(a, x)) else { return true };
    let Some(c) = most(&|x| from_line([a, b], x)) else { return true };
    let gauge = Gauge::new([a, b, c], roundings.units_of(corners.clone()));
    let is_below = |x: &[f64; 3]| orientation(&[a, b, c, x]).is_negative();
    // The largest distance of a corner above the plane, and below it.
    let mut bends = [0.0f64; 2];
    for x in corners {
        let bend = &mut bends[usize::from(is_below(x))];
        *bend = bend.max(gauge.measure(x).1);
    }
    let is_near = |x: &[f64; 3]| {
        let (excess, distance) = gauge.measure(x);
        let beyond = distance - bends[usize::from(is_below(x))];
        excess <= MOST_OFF || beyond <= 0.0 || excess * (beyond / distance) <= MOST_OFF
    };
    let mut vertices = own.iter().flat_map(Piece::vertices);
    vertices.all(|&vertex| is_near(&points[vertex as usize]))
}

/// Returns true if the edges that one triangle of a facet has are those into which its own edges
/// are divided.
fn ends_at_its_edges(
    task: &TaskInSpace<'_>,
    on: &Isolated,
    facet: u32,
    own: &[Piece],
    poll: Poll<'_>,
) -> Result<bool> {
    let triangles = collected(own.iter().filter_map(Piece::triangle))?;
    let sides = Sides::of_triangles(&triangles, poll)?;
    let mut expected: Vec<[u32; 2]> = Vec::new();
    let vertex = |input: u32| task.inputs.vertices()[input as usize];
    for own in task.facets.loops(facet as usize).filter(|own| own.len() > 2) {
        for (at, &from) in own.iter().enumerate() {
            let edge = [from, own[(at + 1) % own.len()]].map(vertex);
            for [from, to] in on.chain(edge).filter(|[from, to]| from != to) {
                expected.try_push([from.min(to), from.max(to)])?;
            }
        }
    }
    expected.sort_unstable();
    // Edges along which loops run an even number of times bound nothing.
    let odd = expected.chunk_by(|a, b| a == b).filter(|same| same.len() % 2 == 1);
    Ok(odd.map(|same| same[0]).eq(sides.rim()))
}
