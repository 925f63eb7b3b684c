//! The lines at which facets or segments meet at small angles, and the facets that have one. Away
//! from them refinement ends as it does in space without small angles.

use crate::complex::VertexId;
use crate::memory::{AllocResult, TryGrow, filled};
use crate::netmesh::questions::small_angles::{SMALL, SMALL_DIHEDRAL, cosine};
use crate::netmesh::state::State;

impl State<3> {
    /// Marks lines and facets at small angles. No line is split.
    pub(super) fn find_sharp_lines(&mut self) -> AllocResult<()> {
        let count = self.segments.chains.lines.len();
        let mut is_sharp = filled(count, false)?;
        let (mut pages, mut ways) = (Vec::new(), Vec::new());
        for line in 0..count as u32 {
            pages.clear();
            ways.clear();
            self.facets.collect_subfacets(line, &mut pages)?;
            for &page in &pages {
                ways.try_push(self.way_into(page, line))?;
            }
            let is_small = |(at, way): (usize, &[f64; 3])| {
                ways[..at].iter().any(|other| cosine(way, other) > SMALL_DIHEDRAL)
            };
            is_sharp[line as usize] = ways.iter().enumerate().any(is_small);
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
        self.facets.set_sharp(is_sharp)
    }

    /// Returns the direction from a line into a page of it, at a right angle to the line.
    fn way_into(&self, page: u32, line: u32) -> [f64; 3] {
        let ends = self.segments.chains.lines[line as usize].ends;
        let own = self.facets.get(page);
        let is_end = |vertex: &VertexId| ends.contains(vertex);
        let apex = own.vertices.into_iter().find(|vertex| !is_end(vertex)).unwrap_or(ends[0]);
        let foot = self.foot(ends, apex, apex);
        let apex = self.delaunay.point(apex);
        std::array::from_fn(|k| apex[k] - foot[k])
    }
}
