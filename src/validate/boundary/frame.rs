//! Level 2: the boundary of a hull or box that the mesh is cropped to goes round the inputs, from
//! corner to corner, and no other subsegment belongs to no segment.

use super::anchors::corners_of_box;
use super::chains::{Chains, Way};
use super::edges::Edges;
use crate::error::message;
use crate::memory::{AllocResult, TryGrow, collected};
use crate::mesh::{Inputs, NONE};
use crate::options::Extent;
use crate::quality::view::View;
use crate::validate::report::{Findings, Violation, ViolationKind};
use crate::validate::signs::{Robust, Signs};
use std::cmp::Ordering;

pub(super) fn check(
    inputs: &Inputs,
    view: View<'_, 2>,
    edges: &Edges,
    findings: &mut Findings,
) -> AllocResult<()> {
    let corners = match view.mesh.parameters.extent {
        Extent::Auto | Extent::All | Extent::Boundary => return Ok(()),
        Extent::Hull => hull(inputs)?,
        Extent::Box => collected(vertices_of_box(inputs, view))?,
    };
    let mut chains = Chains::new(view, &edges.at)?;
    let mut pieces: Vec<[u32; 2]> = Vec::new();
    let sides = corners.iter().zip(corners.iter().cycle().skip(1));
    let sides = collected(sides.map(|(&from, &to)| Way { segment: NONE, ends: [from, to] }))?;
    for (at, &way) in sides.iter().enumerate() {
        let [from, to] = way.ends;
        let exist = from != to && (from.max(to) as usize) < view.vertex_count();
        let is_closed = exist && chains.lead(way)?;
        findings.check(is_closed, || {
            let message = message!(
                "no subsegments lead along the boundary of the extent from corner {at} to the \
                 next, vertex {from} to vertex {to}"
            );
            Violation::new(ViolationKind::SegmentChain, message)
        });
        if is_closed {
            for pair in chains.found().windows(2) {
                pieces.try_push([pair[0].min(pair[1]), pair[0].max(pair[1])])?;
            }
        }
    }
    pieces.sort_unstable();
    check_pieces(view, &chains, &sides, &pieces, findings)
}

/// Checks that each subsegment that belongs to no segment is one of `pieces`, or leads along a side
/// as they do: beside segments of the caller's there may be two ways within roundings.
fn check_pieces(
    view: View<'_, 2>,
    chains: &Chains<'_, 2>,
    sides: &[Way],
    pieces: &[[u32; 2]],
    findings: &mut Findings,
) -> AllocResult<()> {
    let boundary = &view.mesh.boundary;
    for (at, (&[a, b], &parent)) in boundary.subsegments.iter().zip(&boundary.parents).enumerate() {
        let mut is_there = parent != NONE || pieces.binary_search(&[a.min(b), a.max(b)]).is_ok();
        for &side in sides {
            is_there = is_there || chains.leads_along(side, [a, b])?;
        }
        findings.check(is_there, || {
            let message = message!(
                "subsegment {at} from vertex {a} to {b} is of no segment, and not on the boundary \
                 of the extent"
            );
            Violation::new(ViolationKind::SegmentLine, message).vertex(a as usize)
        });
    }
    Ok(())
}

/// Returns the vertices at the corners of the box of the inputs, counterclockwise; [`NONE`] where
/// none is.
fn vertices_of_box(inputs: &Inputs, view: View<'_, 2>) -> [u32; 4] {
    let point = |vertex| [0, 1].map(|axis| inputs.distinct_point(vertex)[axis]);
    corners_of_box((0..inputs.distinct()).map(point)).map(|corner| {
        let ends = view.mesh.boundary.subsegments.as_flattened();
        ends.iter().copied().find(|&end| *view.point(end) == corner).unwrap_or(NONE)
    })
}

/// Returns the vertices of the convex hull of the inputs, counterclockwise, without those within
/// its edges: those above the lines from point to point in their order, and those below them on the
/// way back.
fn hull(inputs: &Inputs) -> AllocResult<Vec<u32>> {
    let point = |vertex: u32| -> &[f64; 2] {
        inputs.distinct_point(vertex as usize).try_into().expect("two coordinates")
    };
    let mut order = collected(0..inputs.distinct() as u32)?;
    order.sort_unstable_by(|&a, &b| {
        // Both zeros are equal.
        let [[ax, ay], [bx, by]] = [a, b].map(|vertex| point(vertex).map(|x| x + 0.0));
        ax.total_cmp(&bx).then(ay.total_cmp(&by))
    });
    let mut signs = Signs::<Robust>::default();
    let mut corners: Vec<u32> = Vec::new();
    for is_back in [false, true] {
        let first = corners.len();
        for step in 0..order.len() {
            let vertex = order[if is_back { order.len() - 1 - step } else { step }];
            while let [.., a, b] = corners[first..] {
                let points = [a, b, vertex].map(point);
                if signs.orientation(&points)? == Ordering::Greater {
                    break;
                }
                corners.pop();
            }
            corners.try_push(vertex)?;
        }
        // It is the first of the way back, or of all.
        corners.pop();
    }
    Ok(corners)
}
