//! A polygon facet as triangles between its vertices.

use super::isolated::Isolated;
use super::meet::Face;
use super::planar::Planar;
use super::projection::Projection;
use crate::arrangement::poll::Poll;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow, collected, enqueue, filled, with_capacity};
use crate::mesh::NONE;
use std::collections::VecDeque;

/// Vertices and edges of a polygon facet.
#[derive(Default)]
pub(super) struct Polygon {
    /// Distinct vertices, ascending.
    pub vertices: Vec<u32>,
    /// Edges between these, by their positions; sorted, each once.
    pub edges: Vec<PolygonEdge>,
}

/// Edge of a polygon, from the smaller of two vertices to the larger.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct PolygonEdge {
    pub ends: [u32; 2],
    /// Number of times that loops run along the edge, in either direction.
    sides: u32,
    /// Number of times that the first loop runs along the edge, less that against it.
    winding: i32,
}

/// Triangles and lines of a polygon facet.
#[derive(Default)]
pub(super) struct Tiling {
    /// Vertices of the triangles, counterclockwise where the first loop is.
    pub triangles: Vec<[u32; 3]>,
    /// Triangle -> bit f is set if its face f is in the interior of the facet.
    pub inner: Vec<u8>,
    /// Edges of the polygon that do not bound the facet.
    pub lines: Vec<[u32; 2]>,
    /// Number of `lines` that are in the facet; the others are outside of it, and come last.
    pub lines_inside: usize,
}

/// Bit for the interior of a triangle.
pub(super) const INTERIOR: u8 = 1 << 0b111;

/// Position of a triangle relative to the loops.
#[derive(Clone, Copy, Default)]
struct Depth {
    is_inside: bool,
    /// Number of times that the first loop goes round the triangle counterclockwise.
    winding: i32,
}

impl Polygon {
    /// Makes the polygon of loops of vertices: three or more are a loop of sides, two a segment and
    /// one a vertex. Vertices that repeat the one before them count once. Sides and segments go
    /// through the vertices on them, and those in the `facet` are vertices; lines in it are edges.
    pub fn new<'a>(
        loops: impl Iterator<Item = &'a [u32]>,
        vertex: impl Fn(u32) -> u32,
        isolated: &Isolated,
        facet: u32,
    ) -> AllocResult<Self> {
        let mut vertices = collected(isolated.within(facet))?;
        let mut all = Vec::new();
        let mut is_first = true;
        for own in loops {
            let is_line = own.len() == 2;
            for (k, &from) in own.iter().enumerate() {
                let [from, to] = [from, own[(k + 1) % own.len()]].map(&vertex);
                vertices.try_push(from)?;
                if from == to || is_line && k == 1 {
                    continue;
                }
                for ends in isolated.chain([from, to]) {
                    let [from, to] = ends;
                    vertices.try_push(to)?;
                    let winding = match (is_first && !is_line, from < to) {
                        (false, _) => 0,
                        (true, true) => 1,
                        (true, false) => -1,
                    };
                    let ends = [from.min(to), from.max(to)];
                    all.try_push(PolygonEdge { ends, sides: u32::from(!is_line), winding })?;
                }
            }
            is_first &= own.len() < 3;
        }
        for ends in isolated.lines_in(facet).flat_map(|line| isolated.chain(line)) {
            vertices.try_extend(&ends)?;
            let ends = [ends[0].min(ends[1]), ends[0].max(ends[1])];
            all.try_push(PolygonEdge { ends, sides: 0, winding: 0 })?;
        }
        Self::of_parts(vertices, all)
    }

    /// Makes a polygon of its rim, which has it on the left and counts where it runs through an
    /// edge an odd number of times, and of lines and vertices in it.
    pub fn of_rim(vertices: Vec<u32>, rim: &[[u32; 2]], lines: &[[u32; 2]]) -> AllocResult<Self> {
        let (mut vertices, mut all) = (vertices, with_capacity(rim.len() + lines.len())?);
        for (own, sides) in [(rim, 1), (lines, 0)] {
            for &[from, to] in own {
                vertices.try_extend(&[from, to])?;
                let winding = if from < to { sides } else { -sides };
                let (ends, sides) = ([from.min(to), from.max(to)], sides as u32);
                all.push(PolygonEdge { ends, sides, winding });
            }
        }
        let mut polygon = Self::of_parts(vertices, all)?;
        polygon.edges.retain(|edge| edge.sides % 2 == 1 || edge.sides == 0);
        Ok(polygon)
    }

    /// Makes a polygon of edges between vertices, which may be there several times.
    fn of_parts(mut vertices: Vec<u32>, mut all: Vec<PolygonEdge>) -> AllocResult<Self> {
        vertices.sort_unstable();
        vertices.dedup();
        let at = |vertex: u32| vertices.partition_point(|&own| own < vertex) as u32;
        all.iter_mut().for_each(|edge| edge.ends = edge.ends.map(at));
        all.sort_unstable();
        let mut edges: Vec<PolygonEdge> = Vec::new();
        for edge in all {
            match edges.last_mut().filter(|last| last.ends == edge.ends) {
                Some(last) => {
                    last.sides += edge.sides;
                    last.winding += edge.winding;
                }
                None => edges.try_push(edge)?,
            }
        }
        Ok(Self { vertices, edges })
    }

    /// Returns true if the polygon has a loop of sides.
    pub fn has_sides(&self) -> bool {
        self.edges.iter().any(|edge| edge.sides > 0)
    }

    /// Returns the vertices at the ends of an edge.
    pub fn ends(&self, edge: &PolygonEdge) -> [u32; 2] {
        edge.ends.map(|end| self.vertices[end as usize])
    }

    /// Returns the triangles of the polygon in a projection; `None` if vertices have one image or
    /// all of them one line, or if edges meet each other or a vertex between their ends.
    /// Edges that are `adopted` are edges of triangles, too, where they meet no edge of the
    /// polygon. The polygon is without triangles if it has no area.
    pub fn tiling(
        &self,
        points: &[[f64; 3]],
        projection: Projection,
        adopted: &[[u32; 2]],
        poll: Poll<'_>,
    ) -> Result<Option<Tiling>> {
        let image = |&vertex: &u32| projection.image(&points[vertex as usize]);
        let images = collected(self.vertices.iter().map(image))?;
        let planar = Planar::new(images, poll)?.filter(|planar| !planar.triangles.is_empty());
        let Some(mut planar) = planar else { return Ok(None) };
        for edge in &self.edges {
            if !planar.fix(edge.ends, poll)? {
                return Ok(None);
            }
        }
        for &ends in adopted {
            planar.fix(ends, poll)?;
        }
        let depths = self.depths(&planar)?;
        Ok(Some(self.tiled(&planar, &depths)?))
    }

    fn edge(&self, [x, y]: [u32; 2]) -> Option<&PolygonEdge> {
        let ends = [x.min(y), x.max(y)];
        let at = self.edges.partition_point(|edge| edge.ends < ends);
        self.edges.get(at).filter(|edge| edge.ends == ends)
    }

    /// Returns the depth of each triangle, from outside.
    fn depths(&self, planar: &Planar) -> AllocResult<Vec<Depth>> {
        let mut depths = filled(planar.triangles.len(), Depth::default())?;
        let mut is_known = filled(planar.triangles.len(), false)?;
        let mut waiting = VecDeque::new();
        // Crosses the edge of a triangle from its other side.
        let entered = |from: Depth, triangle: usize, k: usize| {
            let own = &planar.triangles[triangle];
            let ends = [own[(k + 1) % 3], own[(k + 2) % 3]];
            let edge = self.edge(ends).filter(|_| planar.is_fixed[triangle][k]);
            edge.map_or(from, |edge| Depth {
                is_inside: from.is_inside ^ (edge.sides % 2 == 1),
                winding: from.winding
                    + if ends[0] < ends[1] { edge.winding } else { -edge.winding },
            })
        };
        for (triangle, neighbors) in planar.neighbors.iter().enumerate() {
            if let Some(k) = neighbors.iter().position(|&neighbor| neighbor == NONE) {
                depths[triangle] = entered(Depth::default(), triangle, k);
                is_known[triangle] = true;
                enqueue(&mut waiting, triangle)?;
            }
        }
        while let Some(triangle) = waiting.pop_front() {
            for &neighbor in planar.neighbors[triangle].iter().filter(|&&other| other != NONE) {
                let neighbor = neighbor as usize;
                if !is_known[neighbor] {
                    let back = planar.neighbors[neighbor].iter();
                    let back = back.copied().position(|other| other as usize == triangle);
                    depths[neighbor] = entered(depths[triangle], neighbor, back.unwrap_or(0));
                    is_known[neighbor] = true;
                    enqueue(&mut waiting, neighbor)?;
                }
            }
        }
        Ok(depths)
    }

    /// Returns the triangles that are inside, as the first loop turns.
    fn tiled(&self, planar: &Planar, depths: &[Depth]) -> AllocResult<Tiling> {
        let is_inside = |triangle: u32| triangle != NONE && depths[triangle as usize].is_inside;
        let winding = depths.iter().map(|depth| depth.winding).find(|&winding| winding != 0);
        let is_reversed = winding.is_some_and(|winding| winding < 0);
        let mut is_rim = filled(self.vertices.len(), false)?;
        let sides = || {
            let triangles = 0..planar.triangles.len() as u32;
            triangles.flat_map(|triangle| (0..3).map(move |k| (triangle, k)))
        };
        let side = |(triangle, k): (u32, usize)| {
            let own = &planar.triangles[triangle as usize];
            let ends = [own[(k + 1) % 3], own[(k + 2) % 3]];
            let beyond = planar.neighbors[triangle as usize][k];
            (ends, [is_inside(triangle), is_inside(beyond)], beyond)
        };
        let mut tiling = Tiling::default();
        let mut outside = Vec::new();
        for (triangle, k) in sides() {
            let (ends, are_inside, beyond) = side((triangle, k));
            if are_inside == [true, false] || are_inside == [false, true] {
                ends.iter().for_each(|&end| is_rim[end as usize] = true);
            } else if planar.is_fixed[triangle as usize][k]
                && (beyond == NONE || triangle < beyond)
                && self.edge(ends).is_some()
            {
                let ends = ends.map(|end| self.vertices[end as usize]);
                let ends = [ends[0].min(ends[1]), ends[0].max(ends[1])];
                let lines = if are_inside[0] { &mut tiling.lines } else { &mut outside };
                lines.try_push(ends)?;
            }
        }
        tiling.lines_inside = tiling.lines.len();
        tiling.lines.try_extend(&outside)?;
        for (triangle, own) in (0u32..).zip(&planar.triangles) {
            if !is_inside(triangle) {
                continue;
            }
            let beyond = &planar.neighbors[triangle as usize];
            let mut inner = INTERIOR;
            let mut corners = *own;
            let mut order = [0, 1, 2];
            if is_reversed {
                order.swap(1, 2);
            }
            for (at, &k) in order.iter().enumerate() {
                corners[at] = self.vertices[own[k] as usize];
                let edge: Face = 0b111 ^ 1 << at;
                inner |= u8::from(is_inside(beyond[k])) << edge;
                inner |= u8::from(!is_rim[own[k] as usize]) << (1 << at);
            }
            tiling.triangles.try_push(corners)?;
            tiling.inner.try_push(inner)?;
        }
        Ok(tiling)
    }
}
