//! Holes of surfaces: loops of edges at which one triangle ends and no other begins, and the
//! triangles that close them.

use super::filling;
use super::isolated::Isolated;
use super::pieces::{Piece, Pieces};
use super::sides::{Side, Sides};
use super::{TaskInSpace, points_of};
use crate::arrangement::poll::Poll;
use crate::error::Result;
use crate::memory::{AllocResult, Lists, TryGrow, collected, copied, filled};
use crate::mesh::{Facets, HoleFilling, Inputs, NONE, Segments};
use crate::options::{Crossings, Extent};

/// Returns the triangles that close the holes of facets that have at most `max_edges` edges. Each
/// has the corners of its hole alone, and runs through the edges of the hole against the facets
/// there; its marker is that of these if they have one, otherwise 0. Holes whose triangles would be
/// there already stay open, as the rims of open sheets of few triangles. O(n log n + sum of k^3)
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
    let task = TaskInSpace {
        inputs,
        facets,
        segments: &Segments::default(),
        regions: &[],
        coplanar: 0.0,
        extent: Extent::All,
        crossings: Crossings::Refuse,
    };
    let pieces = Pieces::new(&points, &task, &Isolated::default(), poll)?;
    let rim = Rim::of(&pieces, facets)?;
    let (mut found, mut closed) = (HoleFilling::default(), 0);
    for hole in rim.holes(points.len())? {
        poll(hole.len() as u32)?;
        let filling = match hole.len() <= max_edges {
            true => filling::triangles(&points, &hole, poll)?,
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
}

/// Edge at which one triangle ends: its ends in the direction of the triangle that is missing.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct OpenEdge {
    ends: [u32; 2],
    marker: i32,
}

impl Rim {
    fn of(pieces: &Pieces, facets: &Facets) -> AllocResult<Self> {
        let own = || pieces.all.iter().filter(|piece| piece.triangle().is_some());
        let mut triangles = collected(own().filter_map(Piece::triangle))?;
        let owners = collected(own().map(|piece| piece.facet().unwrap_or(NONE)))?;
        let mut edges = Vec::new();
        for group in Sides::of_triangles(&triangles)?.groups() {
            let [side] = group else { continue };
            edges.try_push(open_edge(side, &triangles, &owners, facets))?;
        }
        edges.sort_unstable();
        triangles.iter_mut().for_each(|own| own.sort_unstable());
        triangles.sort_unstable();
        Ok(Self { edges, triangles })
    }

    /// Returns the loops of open edges, none of which has a vertex twice. Edges that lead nowhere
    /// are in none.
    fn holes(&self, vertices: usize) -> AllocResult<Vec<Vec<u32>>> {
        let at = Lists::of_pairs(vertices, || {
            let ends = self.edges.iter().zip(0u32..);
            ends.flat_map(|(edge, number)| edge.ends.map(|end| (end, number)))
        })?;
        let mut is_used = filled(self.edges.len(), false)?;
        let mut place = filled(vertices, NONE)?;
        let (mut holes, mut path) = (Vec::new(), Vec::new());
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
        Ok(holes)
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
    let ([from, to], _) = side.within(triangles);
    let marker = facets.markers.get(owners[side.triangle as usize] as usize);
    OpenEdge { ends: [to, from], marker: marker.copied().unwrap_or(0) }
}
