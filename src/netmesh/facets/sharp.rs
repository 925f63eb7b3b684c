//! The lines at which facets or segments meet at small angles, and the facets that have one. Away
//! from them refinement ends as it does in space without small angles.

use super::corner_angles::{Corner, cosine_between};
use super::fins;
use crate::complex::VertexId;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow, collected, filled, sorted_in_buckets};
use crate::netmesh::questions::small_angles::{SMALL, SMALL_DIHEDRAL, TINY, cosine};
use crate::netmesh::state::facets::meetings::{Meeting, Meetings, TinyAngles};
use crate::netmesh::state::watch::Watch;
use crate::netmesh::state::{Mesher, State};
use crate::numerics::foot_on_line;

/// Pairs of facets at a vertex with more corners than this are not told.
const MOST_CORNERS: usize = 1000;

/// Roundings of a cosine.
const ROUNDING: f64 = 1e-9;

/// Pairs of facets, each either way round, and where they meet.
type Met = Vec<(u32, u32, Meeting)>;

/// End of a line, and a pair of facets that meet at the line, the lower first.
type Joined = (u32, u32, u32);

/// Largest cosine of the angle at a line between two facets of a fan: 120 degrees.
const FLAT: f64 = -0.5;

/// Pairs of facets that meet at lines, sorted.
struct AtLines {
    /// Pairs at a small angle.
    met: Met,
    /// All pairs, and those that are flat but for 60 degrees.
    joined: Vec<Joined>,
    flat: Vec<Joined>,
}

/// Adds a pair of facets that meet at a place.
fn add_either_way(met: &mut Met, [f, g]: [u32; 2], at: Meeting) -> AllocResult<()> {
    met.try_push((f, g, at))?;
    met.try_push((g, f, at))
}

impl Mesher<'_, '_, 3> {
    /// Marks lines and facets at small angles. No line is split.
    pub(super) fn find_sharp_lines(&mut self) -> Result<()> {
        let Self { state, watch, .. } = self;
        let mut is_sharp = filled(state.segments.chains.lines.len(), false)?;
        let AtLines { mut met, joined, flat } = state.meetings_at_lines(&mut is_sharp, watch)?;
        let tiny_angles = state.add_meetings_at_vertices([&joined, &flat], &mut met, watch)?;
        state.mark_sharp_fans(&mut is_sharp, watch)?;
        let lines = state.segments.chains.lines.iter().zip(&is_sharp);
        let ends = lines.filter(|&(_, &is_sharp)| is_sharp).flat_map(|(line, _)| line.ends);
        let mut ends = collected(ends)?;
        ends.sort_unstable();
        ends.dedup();
        let met = sorted_in_buckets(&met, |pair| pair.0, |work| watch.poll_after(work))?;
        state.facets.meetings = Meetings::new(state.facets.facets.len(), met, tiny_angles)?;
        Ok(state.facets.set_sharp(is_sharp, &ends)?)
    }
}

impl State<3> {
    /// Marks the lines at which facets meet at small angles. Returns the pairs of facets that meet
    /// at lines.
    fn meetings_at_lines(
        &self,
        is_sharp: &mut [bool],
        watch: &mut Watch<'_, '_>,
    ) -> Result<AtLines> {
        let (mut pages, mut ways) = (Vec::new(), Vec::new());
        let (mut met, mut joined, mut flat) = (Vec::new(), Vec::new(), Vec::new());
        for (line, is_sharp) in (0u32..).zip(is_sharp) {
            pages.clear();
            ways.clear();
            for page in self.facets.pages(line) {
                pages.try_push(page)?;
                ways.try_push(self.way_into(page, line))?;
            }
            watch.poll_after(2 + (pages.len() * pages.len()) as u32)?;
            for at in 0..pages.len() {
                for other in 0..at {
                    let [f, g] = [at, other].map(|at| self.facets.get(pages[at]).facet);
                    let cosine = cosine(&ways[at], &ways[other]);
                    for end in self.segments.chains.lines[line as usize].ends {
                        let own = (end.number(), f.min(g), f.max(g));
                        joined.try_push(own)?;
                        if cosine < FLAT {
                            flat.try_push(own)?;
                        }
                    }
                    if cosine > SMALL_DIHEDRAL {
                        *is_sharp = true;
                        add_either_way(&mut met, [f, g], Meeting::Line(line))?;
                    }
                }
            }
        }
        let joined = sorted_in_buckets(&joined, |pair| pair.0, |work| watch.poll_after(work))?;
        let flat = sorted_in_buckets(&flat, |pair| pair.0, |work| watch.poll_after(work))?;
        Ok(AtLines { met, joined, flat })
    }

    /// Adds the pairs of facets that meet at a vertex at a small angle, and at no line there.
    /// `joined` has those that meet at one, `flat` those of them that may be in a fan. Returns the
    /// tiny angles at each vertex.
    fn add_meetings_at_vertices(
        &self,
        [joined, flat]: [&[Joined]; 2],
        met: &mut Met,
        watch: &mut Watch<'_, '_>,
    ) -> Result<Vec<TinyAngles>> {
        let count = self.delaunay.point_count();
        let mut tiny_angles = filled(count, TinyAngles::None)?;
        let subfacets_at = self.facets.subfacets_at_vertices(count)?;
        let (mut corners, mut tiny, mut rest) = (Vec::new(), Vec::new(), [joined, flat]);
        for vertex in VertexId::below(count) {
            let number = vertex.number();
            let [joined_here, flat_here] = rest.each_mut().map(|rest| {
                let (here, others) = rest.split_at(rest.partition_point(|own| own.0 <= number));
                *rest = others;
                here
            });
            let subfacets = subfacets_at.of(vertex.index());
            if subfacets.len() > MOST_CORNERS {
                continue;
            }
            watch.poll_after(4 * (1 + subfacets.len() * subfacets.len()) as u32)?;
            corners.clear();
            tiny.clear();
            for &subfacet in subfacets {
                let facet = self.facets.get(subfacet).facet;
                corners.try_push((facet, self.corner_at(vertex, subfacet)))?;
            }
            corners.sort_unstable_by_key(|(facet, _)| *facet);
            let mut meet = |first: &[(u32, Corner)], second: &[(u32, Corner)]| {
                let pair = (number, first[0].0, second[0].0);
                if joined_here.binary_search(&pair).is_ok() {
                    return AllocResult::Ok(());
                }
                let pairs = first.iter().flat_map(|(_, a)| second.iter().map(move |(_, b)| (a, b)));
                let cosine = pairs.map(|(a, b)| cosine_between(a, b)).fold(-1.0, f64::max);
                if cosine > TINY {
                    tiny.try_push([pair.1, pair.2])?;
                }
                match cosine > SMALL - ROUNDING {
                    true => add_either_way(met, [pair.1, pair.2], Meeting::Vertex(vertex)),
                    false => Ok(()),
                }
            };
            let mut facets = corners.chunk_by(|a, b| a.0 == b.0);
            while let Some(first) = facets.next() {
                facets.clone().try_for_each(|second| meet(first, second))?;
            }
            let flat = flat_here.iter().map(|own| [own.1, own.2]);
            tiny_angles[vertex] = match (tiny.is_empty(), fins::are_any(flat, &tiny)?) {
                (true, _) => TinyAngles::None,
                (false, false) => TinyAngles::InFans,
                (false, true) => TinyAngles::OfFins,
            };
        }
        Ok(tiny_angles)
    }

    /// Marks the lines that make a small angle with another one at a common end.
    fn mark_sharp_fans(&self, is_sharp: &mut [bool], watch: &mut Watch<'_, '_>) -> Result<()> {
        for fan in self.segments.chains.fans() {
            watch.poll_after((fan.len() * fan.len()) as u32)?;
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
