//! A triangulation of points of the plane that contains given edges.

use crate::arrangement::poll::Poll;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow, collected, enqueue, filled, with_capacity};
use crate::mesh::NONE;
use crate::numerics::{Sign, in_ball, orientation};
use std::collections::VecDeque;

/// Number of flips for which a poll counts one unit of work.
const FLIPS_OF_A_POLL: u32 = 2;

/// Triangulation of the convex hull of points.
pub(super) struct Planar {
    points: Vec<[f64; 2]>,
    /// Vertices of the triangles, counterclockwise.
    pub triangles: Vec<[u32; 3]>,
    /// Triangle -> its neighbours, each opposite a vertex; [`NONE`] at the hull.
    pub neighbors: Vec<[u32; 3]>,
    /// Triangle -> true for each edge, opposite a vertex, that no flip may remove.
    pub is_fixed: Vec<[bool; 3]>,
    /// Vertex -> a triangle at it.
    at: Vec<u32>,
    /// Triangles at a vertex, in no order.
    fan: Vec<u32>,
}

/// Edge of a triangle, opposite one of its vertices.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Side {
    triangle: u32,
    opposite: usize,
}

impl Planar {
    /// Makes the Delaunay triangulation of points; without triangles if they are all on one line.
    /// `None` if two are equal. O(n log n), and O(1) for each flip.
    pub fn new(points: Vec<[f64; 2]>, poll: Poll<'_>) -> Result<Option<Self>> {
        let order = sorted(&points)?;
        if order.windows(2).any(|two| points[two[0] as usize] == points[two[1] as usize]) {
            return Ok(None);
        }
        let triangles = swept(&points, &order)?;
        let (neighbors, at) = linked(&triangles, points.len())?;
        let is_fixed = filled(triangles.len(), [false; 3])?;
        let mut made = Self { points, triangles, neighbors, is_fixed, at, fan: Vec::new() };
        made.flip_to_delaunay(poll)?;
        Ok(Some(made))
    }

    /// Makes an edge between two vertices a part of the triangulation, and fixes it. Returns false
    /// if it meets a vertex between its ends, or a fixed edge; then nothing is changed.
    pub fn fix(&mut self, ends: [u32; 2], poll: Poll<'_>) -> Result<bool> {
        let Some(crossed) = self.crossed_by(ends)? else { return Ok(false) };
        let mut crossed: VecDeque<[u32; 2]> = crossed.into();
        let mut work = 0;
        // An edge that cannot be flipped yet can be after others (S. W. Sloan, "A fast algorithm
        // for generating constrained Delaunay triangulations", 1993).
        while let Some(edge) = crossed.pop_front() {
            work += 1;
            if work % FLIPS_OF_A_POLL == 0 {
                poll(1)?;
            }
            let Some(side) = self.side_between(edge)? else { continue };
            let Some([p, q]) = self.apexes(side) else { continue };
            if !self.is_convex(edge, [p, q]) {
                enqueue(&mut crossed, edge)?;
                continue;
            }
            self.flip(side);
            let is_apart = |vertex: u32| !ends.contains(&vertex);
            if is_apart(p) && is_apart(q) && (self.side(ends, p) * self.side(ends, q)).is_negative()
            {
                enqueue(&mut crossed, [p, q])?;
            }
        }
        if let Some(Side { triangle, opposite }) = self.side_between(ends)? {
            self.is_fixed[triangle as usize][opposite] = true;
            let beyond = self.neighbors[triangle as usize][opposite];
            if beyond != NONE {
                let back = self.side_towards(beyond, triangle).opposite;
                self.is_fixed[beyond as usize][back] = true;
            }
        }
        Ok(true)
    }

    /// Returns the edges that a line between two vertices crosses; `None` if it meets a vertex or a
    /// fixed edge between its ends.
    fn crossed_by(&mut self, ends: [u32; 2]) -> Result<Option<Vec<[u32; 2]>>> {
        let [from, to] = ends;
        let mut crossed = Vec::new();
        self.collect_fan(from)?;
        let mut first = None;
        for &triangle in &self.fan {
            let own = &self.triangles[triangle as usize];
            let at = position(own, from);
            let [x, y] = [own[(at + 1) % 3], own[(at + 2) % 3]];
            if x == to || y == to {
                return Ok(Some(crossed));
            }
            let [right, left] = [x, y].map(|vertex| self.side(ends, vertex));
            if right.is_zero() && self.is_between(ends, x)
                || left.is_zero() && self.is_between(ends, y)
            {
                return Ok(None);
            }
            if right.is_negative() && left.is_positive() {
                first = Some((Side { triangle, opposite: at }, [x, y]));
            }
        }
        // Some triangle at an end of a line within the hull has the line's begin in it.
        let Some((mut side, mut edge)) = first else { return Ok(None) };
        loop {
            if self.is_fixed[side.triangle as usize][side.opposite] {
                return Ok(None);
            }
            crossed.try_push(edge)?;
            let beyond = self.neighbors[side.triangle as usize][side.opposite];
            let back = self.side_towards(beyond, side.triangle).opposite;
            let own = &self.triangles[beyond as usize];
            let apex = own[back];
            if apex == to {
                return Ok(Some(crossed));
            }
            let replaced = match self.side(ends, apex) {
                Sign::Zero => return Ok(None),
                Sign::Negative => 0,
                Sign::Positive => 1,
            };
            // The line goes out between the apex and the vertex on the other side of it.
            side = Side { triangle: beyond, opposite: position(own, edge[replaced]) };
            edge[replaced] = apex;
        }
    }

    /// Flips edges until all triangles are Delaunay.
    fn flip_to_delaunay(&mut self, poll: Poll<'_>) -> Result<()> {
        let mut waiting = with_capacity(3 * self.triangles.len())?;
        for triangle in 0..self.triangles.len() as u32 {
            waiting.extend((0..3).map(|opposite| Side { triangle, opposite }));
        }
        let mut work = 0;
        while let Some(side) = waiting.pop() {
            work += 1;
            if work % FLIPS_OF_A_POLL == 0 {
                poll(1)?;
            }
            let Some([_, q]) = self.apexes(side) else { continue };
            let triangle = self.triangles[side.triangle as usize].map(|v| &self.points[v as usize]);
            if !in_ball(&triangle, &self.points[q as usize]).is_positive() {
                continue;
            }
            let beyond = self.flip(side);
            for (triangle, opposite) in
                [(side.triangle, 0), (side.triangle, 2), (beyond, 0), (beyond, 1)]
            {
                waiting.try_push(Side { triangle, opposite })?;
            }
        }
        Ok(())
    }

    /// Returns the vertices opposite an edge in its two triangles; `None` at the hull.
    fn apexes(&self, Side { triangle, opposite }: Side) -> Option<[u32; 2]> {
        let beyond = self.neighbors[triangle as usize][opposite];
        (beyond != NONE).then(|| {
            let back = self.side_towards(beyond, triangle).opposite;
            [self.triangles[triangle as usize][opposite], self.triangles[beyond as usize][back]]
        })
    }

    /// Returns true if the two triangles at an edge, with these apexes, make a strictly convex
    /// quadrilateral.
    fn is_convex(&self, [x, y]: [u32; 2], apexes: [u32; 2]) -> bool {
        (self.side(apexes, x) * self.side(apexes, y)).is_negative()
    }

    /// Replaces an edge by the other diagonal of its two triangles. Its triangle `a b c` and the
    /// other, `d c b`, become `a b d` and `a d c`; returns the number of the second.
    fn flip(&mut self, Side { triangle: t, opposite: k }: Side) -> u32 {
        let [b_at, c_at] = [(k + 1) % 3, (k + 2) % 3];
        let u = self.neighbors[t as usize][k];
        let j = self.side_towards(u, t).opposite;
        let [of_t, of_u] = [t, u].map(|triangle| self.triangles[triangle as usize]);
        let [near_t, near_u] = [t, u].map(|triangle| self.neighbors[triangle as usize]);
        let [fixed_t, fixed_u] = [t, u].map(|triangle| self.is_fixed[triangle as usize]);
        let [a, b, c, d] = [of_t[k], of_t[b_at], of_t[c_at], of_u[j]];
        let [over_db, over_dc] = [(j + 1) % 3, (j + 2) % 3];
        self.triangles[t as usize] = [a, b, d];
        self.triangles[u as usize] = [a, d, c];
        self.neighbors[t as usize] = [near_u[over_db], u, near_t[c_at]];
        self.neighbors[u as usize] = [near_u[over_dc], near_t[b_at], t];
        self.is_fixed[t as usize] = [fixed_u[over_db], false, fixed_t[c_at]];
        self.is_fixed[u as usize] = [fixed_u[over_dc], fixed_t[b_at], false];
        for (beyond, from, to) in [(near_u[over_db], u, t), (near_t[b_at], t, u)] {
            if beyond != NONE {
                let side = self.side_towards(beyond, from);
                self.neighbors[beyond as usize][side.opposite] = to;
            }
        }
        for (vertex, triangle) in [(a, t), (b, t), (d, t), (c, u)] {
            self.at[vertex as usize] = triangle;
        }
        u
    }

    /// Returns the edge that a triangle shares with a neighbour.
    fn side_towards(&self, triangle: u32, neighbor: u32) -> Side {
        Side { triangle, opposite: position(&self.neighbors[triangle as usize], neighbor) }
    }

    /// Returns an edge by its ends; `None` if the triangulation has none between them.
    fn side_between(&mut self, [x, y]: [u32; 2]) -> AllocResult<Option<Side>> {
        self.collect_fan(x)?;
        let with_y = |&&triangle: &&u32| self.triangles[triangle as usize].contains(&y);
        Ok(self.fan.iter().find(with_y).map(|&triangle| {
            let own = &self.triangles[triangle as usize];
            Side { triangle, opposite: 3 - position(own, x) - position(own, y) }
        }))
    }

    /// Writes the triangles at a vertex to `fan`.
    fn collect_fan(&mut self, vertex: u32) -> AllocResult<()> {
        self.fan.clear();
        let first = self.at[vertex as usize];
        // Counterclockwise until the hull or the first triangle, then clockwise until the hull.
        for step in [1, 2] {
            let mut triangle = first;
            loop {
                if step == 1 || triangle != first {
                    self.fan.try_push(triangle)?;
                }
                let at = position(&self.triangles[triangle as usize], vertex);
                triangle = self.neighbors[triangle as usize][(at + step) % 3];
                if triangle == NONE {
                    break;
                }
                if triangle == first {
                    return Ok(());
                }
            }
        }
        Ok(())
    }

    /// Returns the side of a line through two vertices on which a vertex is: positive on the left.
    fn side(&self, [from, to]: [u32; 2], vertex: u32) -> Sign {
        let [a, b, c] = [from, to, vertex].map(|vertex| &self.points[vertex as usize]);
        orientation(&[a, b, c])
    }

    /// Returns true if a vertex of the line through two vertices is strictly between them.
    fn is_between(&self, ends: [u32; 2], vertex: u32) -> bool {
        let ([p, q], x) =
            (ends.map(|end| &self.points[end as usize]), &self.points[vertex as usize]);
        p < x && x < q || q < x && x < p
    }
}

/// Returns the position of a value that is among three.
fn position(three: &[u32; 3], value: u32) -> usize {
    if three[0] == value { 0 } else { 1 + usize::from(three[1] != value) }
}

/// Returns points from left to right, of those above each other the lowest first.
fn sorted(points: &[[f64; 2]]) -> AllocResult<Vec<u32>> {
    let mut order = collected(0..points.len() as u32)?;
    order.sort_unstable_by(|&a, &b| {
        let [[a, b], [c, d]] = [points[a as usize], points[b as usize]];
        // Zeros of either sign are equal.
        (a + 0.0).total_cmp(&(c + 0.0)).then((b + 0.0).total_cmp(&(d + 0.0)))
    });
    Ok(order)
}

/// Returns triangles of the convex hull of distinct points, by a sweep in their order: each point
/// makes triangles with the edges of the hull that it sees. O(n).
fn swept(points: &[[f64; 2]], order: &[u32]) -> AllocResult<Vec<[u32; 3]>> {
    let point = |vertex: u32| &points[vertex as usize];
    let mut triangles = with_capacity(2 * points.len())?;
    let mut chains: [Vec<u32>; 2] = [with_capacity(points.len())?, with_capacity(points.len())?];
    for &next in order {
        for (is_upper, chain) in [false, true].into_iter().zip(&mut chains) {
            while let [.., a, b] = chain[..] {
                let turn = orientation(&[point(a), point(b), point(next)]);
                let is_seen = if is_upper { turn.is_positive() } else { turn.is_negative() };
                if !is_seen {
                    break;
                }
                triangles.try_push(if is_upper { [a, b, next] } else { [a, next, b] })?;
                chain.pop();
            }
            chain.try_push(next)?;
        }
    }
    Ok(triangles)
}

/// Returns the neighbours of the triangles, and for each vertex a triangle at it.
fn linked(triangles: &[[u32; 3]], vertices: usize) -> AllocResult<(Vec<[u32; 3]>, Vec<u32>)> {
    let mut sides = with_capacity(3 * triangles.len())?;
    let mut at = filled(vertices, NONE)?;
    for (own, triangle) in triangles.iter().zip(0u32..) {
        for k in 0..3 {
            let [x, y] = [own[(k + 1) % 3], own[(k + 2) % 3]];
            sides.push(([x.min(y), x.max(y)], triangle, k));
            at[own[k] as usize] = triangle;
        }
    }
    sides.sort_unstable();
    let mut neighbors = filled(triangles.len(), [NONE; 3])?;
    for pair in sides.windows(2) {
        let [(first, t, k), (second, u, j)] = [pair[0], pair[1]];
        if first == second {
            neighbors[t as usize][k] = u;
            neighbors[u as usize][j] = t;
        }
    }
    Ok((neighbors, at))
}
