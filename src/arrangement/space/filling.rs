//! Triangles between the vertices of a loop in space: of all triangulations of the loop the one
//! whose sharpest fold is least, and of those the one with the shortest edges. So the loop of a
//! flat facet is filled within its plane. By dynamic programming, as P. Liepa, "Filling holes in
//! meshes" (2003), has it, with other weights.

use super::projection::{Projection, normal, tangent_of_half};
use crate::arrangement::poll::Poll;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow, filled};
use crate::numerics::distance;

/// Folds that differ by less are alike, as tangents of half of the angle: roundings bend what is
/// flat.
const FOLD_STEP: f64 = 1e-3;

/// Cost of triangles: the sharpest fold between two of them, in steps, and the sum of the lengths
/// of their edges.
type Cost = (u32, f64);

const IMPOSSIBLE: Cost = (u32::MAX, f64::INFINITY);

/// Best triangles between the vertices of a part of the loop, from its first to its last.
#[derive(Clone, Copy)]
struct Best {
    cost: Cost,
    /// Vertex of the triangle at the edge from the first to the last, as a place in the loop.
    apex: u32,
}

/// Returns triangles between the vertices of `hole` that run through its edges in its direction;
/// `None` if every triangulation has one without an area, or an edge inside that `is_taken`. A
/// vertex may be there several times. O(k^3) for k vertices.
///
/// # Errors
/// `OutOfMemory`, and those of `poll`.
pub(super) fn triangles(
    points: &[[f64; 3]],
    hole: &[u32],
    is_taken: &dyn Fn([u32; 2]) -> bool,
    poll: Poll<'_>,
) -> Result<Option<Vec<[u32; 3]>>> {
    let count = hole.len();
    let mut table = Table { count, best: filled(count * count, EDGE)? };
    for length in 2..count {
        for first in 0..count - length {
            poll(length as u32)?;
            let last = first + length;
            let mut best = Best { cost: IMPOSSIBLE, apex: 0 };
            let is_inner = length + 1 < count;
            if is_inner && (hole[first] == hole[last] || is_taken([hole[first], hole[last]])) {
                table.best[first * count + last] = best;
                continue;
            }
            for apex in first + 1..last {
                let cost = table.cost(points, hole, [first, apex, last]);
                if cost < best.cost {
                    best = Best { cost, apex: apex as u32 };
                }
            }
            table.best[first * count + last] = best;
        }
    }
    if count < 3 || table.of(0, count - 1).cost == IMPOSSIBLE {
        return Ok(None);
    }
    Ok(Some(table.triangles(hole)?))
}

/// Part of a loop of one edge, which no triangle fills.
const EDGE: Best = Best { cost: (0, 0.0), apex: u32::MAX };

struct Table {
    count: usize,
    /// First and last -> the best triangles between.
    best: Vec<Best>,
}

impl Table {
    fn of(&self, first: usize, last: usize) -> Best {
        self.best[first * self.count + last]
    }

    /// Returns the cost of the best triangles of a part of which a triangle is one.
    fn cost(&self, points: &[[f64; 3]], hole: &[u32], own: [usize; 3]) -> Cost {
        let [first, apex, last] = own;
        let parts = [[first, apex], [apex, last]];
        let (mut fold, mut length) = (0, 0.0);
        let point = |at: usize| &points[hole[at] as usize];
        if parts.iter().any(|&[from, to]| self.of(from, to).cost == IMPOSSIBLE)
            || Projection::of_triangle(own.map(point)).is_none()
        {
            return IMPOSSIBLE;
        }
        for [from, to] in parts {
            let Best { cost, apex } = self.of(from, to);
            fold = fold.max(cost.0);
            length += cost.1;
            if apex != u32::MAX {
                let beyond = [from, apex as usize, to];
                fold = fold.max(fold_between([own, beyond].map(|corners| corners.map(point))));
                length += distance(point(from), point(to));
            }
        }
        (fold, length)
    }

    fn triangles(&self, hole: &[u32]) -> AllocResult<Vec<[u32; 3]>> {
        let mut found = Vec::new();
        let mut parts = Vec::new();
        parts.try_push([0, self.count - 1])?;
        while let Some([first, last]) = parts.pop() {
            let apex = self.of(first, last).apex;
            if apex != u32::MAX {
                let apex = apex as usize;
                found.try_push([first, apex, last].map(|at| hole[at]))?;
                parts.try_extend(&[[first, apex], [apex, last]])?;
            }
        }
        Ok(found)
    }
}

/// Returns the fold between two triangles that run through their common edge in opposite
/// directions, in steps; 0 if they are in one plane.
fn fold_between([one, other]: [[&[f64; 3]; 3]; 2]) -> u32 {
    let normals = [normal(one), normal(other)];
    (tangent_of_half(normals.each_ref()) / FOLD_STEP).round() as u32
}
