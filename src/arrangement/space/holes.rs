//! Holes of surfaces: loops of edges at which one triangle ends and no other begins, and the
//! triangles that close them.

use super::filling;
use super::pieces::{Piece, Pieces};
use super::projection::normal;
use super::sides::{Side, Sides};
use super::{pieces_as_given, points_of};
use crate::arrangement::poll::Poll;
use crate::error::Result;
use crate::memory::{AllocResult, Lists, TryGrow, collected, copied, filled, with_capacity};
use crate::mesh::{Facets, HoleFilling, Inputs, NONE, Segments};
use crate::numerics::{cross, scale_of_differences};

/// Returns the triangles that close the holes of facets that have at most `max_edges` edges. Each
/// has the corners of its hole alone, and runs through the edges of the hole against the facets
/// there; its marker is that of these if they have one, otherwise 0. Holes stay open of which all
/// triangulations have an edge or a triangle that is there already, as the rim of a triangle
/// alone. O(n log n + sum of k^3)
/// for n triangles and holes of k edges.
///
/// # Errors
/// `OutOfMemory`, and those of `poll`.
pub fn fill_holes(
    inputs: &Inputs,
    facets: &Facets,
    max_edges: usize,
    poll: Poll<'_>,
) -> Result<HoleFilling> {
    let points = points_of(inputs)?;
    let pieces = pieces_as_given(&points, inputs, facets, &Segments::default(), poll)?;
    let rim = Rim::of(&pieces, facets, poll)?;
    let (mut found, mut closed) = (HoleFilling::default(), 0);
    for hole in rim.holes(&points)? {
        poll(hole.len() as u32)?;
        let filling = match hole.len() <= max_edges {
            true => {
                let is_taken = |ends: [u32; 2]| rim.has_edge(ends);
                filling::triangles(&points, &hole, &is_taken, poll)?
            }
            false => None,
        };
        let Some(filling) = filling.filter(|filling| !rim.has_any(filling)) else { continue };
        let marker = rim.marker(&hole);
        found.holes += 1;
        closed += hole.len();
        for own in filling {
            let input = |vertex: u32| inputs.first_input(vertex as usize).unwrap_or(vertex);
            found.triangles.try_push(own.map(input))?;
            found.markers.try_push(marker)?;
        }
    }
    found.open_edges = rim.edges.len() - closed;
    Ok(found)
}

/// Edges at which one triangle ends.
struct Rim {
    edges: Vec<OpenEdge>,
    /// All triangles, each with its vertices sorted; sorted.
    triangles: Vec<[u32; 3]>,
    /// All edges of triangles, the smaller vertex first; sorted.
    all: Vec<[u32; 2]>,
}

/// Directions from a vertex, seen where the normal of the surface points to.
struct Frame<'a> {
    center: &'a [f64; 3],
    axes: [[f64; 3]; 2],
}

impl<'a> Frame<'a> {
    /// Makes the frame at the vertex `center`, to which open edges come.
    fn at<'b>(
        points: &'a [[f64; 3]],
        center: u32,
        edges: impl Iterator<Item = &'b OpenEdge>,
    ) -> Self {
        let mut up = [0.0; 3];
        for edge in edges {
            // The triangle beside runs the other way.
            let own = [edge.ends[1], edge.ends[0], edge.opposite];
            let own = normal(own.map(|vertex| &points[vertex as usize]));
            (0..3).for_each(|k| up[k] += own[k]);
        }
        // The first axis is across the one that the normal is the farthest from.
        let least = (0..3).min_by(|&a, &b| up[a].abs().total_cmp(&up[b].abs())).unwrap_or(0);
        let mut away = [0.0; 3];
        away[least] = 1.0;
        let first = cross(&away, &up);
        Self { center: &points[center as usize], axes: [first, cross(&up, &first)] }
    }

    /// Returns the direction to a point as a number from 0 to 4, which grows counterclockwise.
    fn turn(&self, x: &[f64; 3]) -> f64 {
        let scale = scale_of_differences([x, self.center]);
        let way: [f64; 3] = std::array::from_fn(|k| scale * x[k] - scale * self.center[k]);
        let longest = way.iter().fold(0.0f64, |longest, step| longest.max(step.abs()));
        let [first, second] = self.axes.each_ref();
        let size = |axis: &[f64; 3]| axis.iter().map(|x| x * x).sum::<f64>().sqrt();
        let along = |axis: &[f64; 3]| {
            (0..3).map(|k| axis[k] * (way[k] / longest)).sum::<f64>() / size(axis)
        };
        let (u, v) = (along(first), along(second));
        match (u >= 0.0, v >= 0.0) {
            (true, true) => v / (u + v),
            (false, true) => 1.0 - u / (v - u),
            (false, false) => 2.0 + v / (u + v),
            (true, false) => 3.0 + u / (u - v),
        }
    }
}

/// Edge at which one triangle ends: its ends in the direction of the triangle that is missing.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct OpenEdge {
    ends: [u32; 2],
    /// The third vertex of the triangle that is there.
    opposite: u32,
    marker: i32,
}

impl Rim {
    fn of(pieces: &Pieces, facets: &Facets, poll: Poll<'_>) -> Result<Self> {
        let own = || pieces.all.iter().filter(|piece| piece.triangle().is_some());
        let mut triangles = collected(own().filter_map(Piece::triangle))?;
        let owners = collected(own().map(|piece| piece.facet().unwrap_or(NONE)))?;
        let (mut edges, mut all) = (Vec::new(), Vec::new());
        for group in Sides::of_triangles(&triangles, poll)?.groups() {
            all.try_push(group[0].ends)?;
            let [side] = group else { continue };
            edges.try_push(open_edge(side, &triangles, &owners, facets))?;
        }
        edges.sort_unstable();
        triangles.iter_mut().for_each(|own| own.sort_unstable());
        triangles.sort_unstable();
        Ok(Self { edges, triangles, all })
    }

    /// Returns the loops of open edges. Edges that lead nowhere are in none.
    fn holes(&self, points: &[[f64; 3]]) -> AllocResult<Vec<Vec<u32>>> {
        let next = self.next_edges(points)?;
        let mut is_seen = filled(self.edges.len(), false)?;
        let mut is_used = filled(self.edges.len(), false)?;
        let (mut holes, mut way) = (Vec::new(), Vec::new());
        for first in 0..self.edges.len() {
            way.clear();
            let mut edge = first;
            while edge != NONE as usize && !is_seen[edge] {
                is_seen[edge] = true;
                way.try_push(edge)?;
                edge = next[edge] as usize;
            }
            // No two edges have the same next one, so that a way comes back to its start or ends.
            if edge == first && !way.is_empty() {
                way.iter().for_each(|&edge| is_used[edge] = true);
                holes.try_push(collected(way.iter().map(|&edge| self.edges[edge].ends[0]))?)?;
            }
        }
        self.walk(points.len(), is_used, &mut holes)?;
        Ok(holes)
    }

    /// Returns for each open edge the next one round its hole; [`NONE`] where as many edges do not
    /// begin as end, since triangles there are turned. Where holes touch it is the first one beyond
    /// the gap, clockwise where the normal of the surface points to the eye.
    fn next_edges(&self, points: &[[f64; 3]]) -> AllocResult<Vec<u32>> {
        let end = |which: usize| {
            let ends = self.edges.iter().zip(0u32..);
            move || ends.clone().map(move |(edge, number)| (edge.ends[which], number))
        };
        let leaving = Lists::of_pairs(points.len(), end(0))?;
        let coming = Lists::of_pairs(points.len(), end(1))?;
        let mut next = filled(self.edges.len(), NONE)?;
        for vertex in 0..points.len() {
            let (from, to) = (coming.of(vertex), leaving.of(vertex));
            match (from, to) {
                ([one], [other]) => next[*one as usize] = *other,
                _ if from.len() == to.len() && !from.is_empty() => {
                    self.pair_across_gaps(points, [from, to], &mut next)?;
                }
                _ => {}
            }
        }
        Ok(next)
    }

    /// Joins the edges that come to a vertex with those that leave it, each with the first one
    /// clockwise. Leaves them alone if two have the same one.
    fn pair_across_gaps(
        &self,
        points: &[[f64; 3]],
        [from, to]: [&[u32]; 2],
        next: &mut [u32],
    ) -> AllocResult<()> {
        let center = self.edges[to[0] as usize].ends[0];
        let frame = Frame::at(points, center, from.iter().map(|&edge| &self.edges[edge as usize]));
        let turn = |edge: u32, which: usize| {
            frame.turn(&points[self.edges[edge as usize].ends[which] as usize])
        };
        let mut pairs = with_capacity(from.len())?;
        for &one in from {
            let start = turn(one, 0);
            let clockwise = |other: f64| (start - other).rem_euclid(4.0);
            let nearest = to.iter().copied().min_by(|&a, &b| {
                let [a, b] = [a, b].map(|edge| clockwise(turn(edge, 1)));
                // An edge does not lead back to where it came from.
                let [a, b] = [a, b].map(|way| if way == 0.0 { 4.0 } else { way });
                a.total_cmp(&b)
            });
            pairs.push((nearest.unwrap_or(NONE), one));
        }
        pairs.sort_unstable();
        if pairs.windows(2).all(|two| two[0].0 != two[1].0) {
            pairs.iter().for_each(|&(other, one)| next[one as usize] = other);
        }
        Ok(())
    }

    /// Adds loops of the edges that are not used, none of which has a vertex twice, whatever the
    /// directions of edges are.
    fn walk(
        &self,
        vertices: usize,
        mut is_used: Vec<bool>,
        holes: &mut Vec<Vec<u32>>,
    ) -> AllocResult<()> {
        let at = Lists::of_pairs(vertices, || {
            let ends = self.edges.iter().zip(0u32..);
            ends.flat_map(|(edge, number)| edge.ends.map(|end| (end, number)))
        })?;
        let mut place = filled(vertices, NONE)?;
        let mut path = Vec::new();
        for edge in &self.edges {
            path.try_push(edge.ends[0])?;
            place[edge.ends[0] as usize] = 0;
            while let Some(&vertex) = path.last() {
                let own = at.of(vertex as usize);
                let Some(&next) = own.iter().find(|&&edge| !is_used[edge as usize]) else {
                    // The edge that led here leads nowhere, or the way is at its start again.
                    place[vertex as usize] = NONE;
                    path.pop();
                    continue;
                };
                is_used[next as usize] = true;
                let [from, to] = self.edges[next as usize].ends;
                let beyond = if from == vertex { to } else { from };
                if place[beyond as usize] == NONE {
                    place[beyond as usize] = path.len() as u32;
                    path.try_push(beyond)?;
                    continue;
                }
                // The way has come back: what is behind this vertex is a loop.
                let start = place[beyond as usize] as usize;
                let mut hole = copied(&path[start..])?;
                path.truncate(start + 1);
                hole[1..].iter().for_each(|&inner| place[inner as usize] = NONE);
                if self.runs_back(&hole) {
                    hole.reverse();
                }
                holes.try_push(hole)?;
            }
        }
        Ok(())
    }

    /// Returns true if more edges of a loop run against it than along it.
    fn runs_back(&self, hole: &[u32]) -> bool {
        let back = steps(hole).filter(|&ends| self.edge(ends).is_none()).count();
        2 * back > hole.len()
    }

    fn edge(&self, ends: [u32; 2]) -> Option<&OpenEdge> {
        self.edges.binary_search_by_key(&ends, |edge| edge.ends).ok().map(|at| &self.edges[at])
    }

    /// Returns the marker of all facets at a hole, 0 if they have several.
    fn marker(&self, hole: &[u32]) -> i32 {
        let edge = |[from, to]: [u32; 2]| self.edge([from, to]).or_else(|| self.edge([to, from]));
        let mut markers = steps(hole).filter_map(edge).map(|edge| edge.marker);
        let first = markers.next().unwrap_or(0);
        if markers.all(|marker| marker == first) { first } else { 0 }
    }

    /// Returns true if an edge is there already.
    fn has_edge(&self, [from, to]: [u32; 2]) -> bool {
        self.all.binary_search(&[from.min(to), from.max(to)]).is_ok()
    }

    /// Returns true if one of `filling` is there already.
    fn has_any(&self, filling: &[[u32; 3]]) -> bool {
        filling.iter().any(|own| {
            let mut own = *own;
            own.sort_unstable();
            self.triangles.binary_search(&own).is_ok()
        })
    }
}

/// Returns the steps round a loop.
fn steps(hole: &[u32]) -> impl Iterator<Item = [u32; 2]> {
    hole.iter().zip(hole.iter().cycle().skip(1)).map(|(&from, &to)| [from, to])
}

fn open_edge(side: &Side, triangles: &[[u32; 3]], owners: &[u32], facets: &Facets) -> OpenEdge {
    let ([from, to], opposite) = side.within(triangles);
    let marker = facets.markers.get(owners[side.triangle as usize] as usize);
    OpenEdge { ends: [to, from], opposite, marker: marker.copied().unwrap_or(0) }
}
