//! The lines at which facets or segments meet at small angles, and the facets that have one. Away
//! from them refinement ends as it does in space without small angles.

use crate::complex::VertexId;
use crate::memory::{AllocResult, TryGrow, collected, filled};
use crate::netmesh::questions::small_angles::{SMALL, SMALL_DIHEDRAL, cosine};
use crate::netmesh::state::State;
use crate::netmesh::state::facets::Meeting;
use crate::numerics::foot_on_line;

/// Pairs of facets at a vertex with more of them are not told.
const MOST_FACETS: usize = 1000;

impl State<3> {
    /// Marks lines and facets at small angles. No line is split.
    pub(super) fn find_sharp_lines(&mut self) -> AllocResult<()> {
        let count = self.segments.chains.lines.len();
        let mut is_sharp = filled(count, false)?;
        let (mut pages, mut ways) = (Vec::new(), Vec::new());
        let (mut meetings, mut joined) = (Vec::new(), Vec::new());
        for line in 0..count as u32 {
            pages.clear();
            ways.clear();
            for page in self.facets.pages(line) {
                pages.try_push(page)?;
            }
            for &page in &pages {
                ways.try_push(self.way_into(page, line))?;
            }
            for at in 0..pages.len() {
                for other in 0..at {
                    let [f, g] = [at, other].map(|at| self.facets.get(pages[at]).facet);
                    for end in self.segments.chains.lines[line as usize].ends {
                        joined.try_push((f.min(g), f.max(g), Meeting::Vertex(end)))?;
                    }
                    if cosine(&ways[at], &ways[other]) > SMALL_DIHEDRAL {
                        is_sharp[line as usize] = true;
                        meetings.try_push((f.min(g), f.max(g), Meeting::Line(line)))?;
                    }
                }
            }
        }
        for fan in self.segments.chains.fans() {
            for (at, one) in fan.iter().enumerate() {
                for other in &fan[..at] {
                    let lines = [one.line, other.line].map(|line| line as usize);
                    let [first, second] = lines.map(|line| self.segments.chains.lines[line]);
                    let Some((center, [u, v])) = first.corner_with(&second) else { continue };
                    if self.cosine_at(self.delaunay.point(center), u, v) > SMALL {
                        lines.into_iter().for_each(|line| is_sharp[line] = true);
                    }
                }
            }
        }
        joined.sort_unstable();
        self.find_meetings_at_vertices(&joined, &mut meetings)?;
        let lines = self.segments.chains.lines.iter().zip(&is_sharp);
        let ends = lines.filter(|&(_, &is_sharp)| is_sharp).flat_map(|(line, _)| line.ends);
        let mut ends = collected(ends)?;
        ends.sort_unstable();
        ends.dedup();
        self.facets.set_sharp(is_sharp, &ends, meetings)
    }

    /// Adds the pairs of facets that meet at an end of lines, and at no line there. `joined` has
    /// those that meet at one.
    fn find_meetings_at_vertices(
        &self,
        joined: &[(u32, u32, Meeting)],
        meetings: &mut Vec<(u32, u32, Meeting)>,
    ) -> AllocResult<()> {
        let mut own = Vec::new();
        for vertex in VertexId::below(self.delaunay.point_count()) {
            own.clear();
            own.try_extend(self.facets.facets_at(vertex))?;
            own.sort_unstable();
            own.dedup();
            if own.len() > MOST_FACETS {
                continue;
            }
            for at in 0..own.len() {
                for other in 0..at {
                    let pair = (own[other], own[at], Meeting::Vertex(vertex));
                    if joined.binary_search(&pair).is_err() {
                        meetings.try_push(pair)?;
                    }
                }
            }
        }
        Ok(())
    }

    /// Returns the direction from a line into a page of it, at a right angle to the line. The
    /// vertex opposite may be beyond an end of the line.
    fn way_into(&self, page: u32, line: u32) -> [f64; 3] {
        let ends = self.segments.chains.lines[line as usize].ends;
        let own = self.facets.get(page);
        let is_end = |vertex: &VertexId| ends.contains(vertex);
        let apex = own.vertices.into_iter().find(|vertex| !is_end(vertex)).unwrap_or(ends[0]);
        let apex = self.delaunay.point(apex);
        let foot = foot_on_line(apex, ends.map(|end| self.delaunay.point(end)));
        std::array::from_fn(|k| apex[k] - foot[k])
    }
}
