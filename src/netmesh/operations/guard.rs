//! The guard of the boundary in space: what a simplex may ask to be split. Beside small angles of
//! the input, pieces of the boundary that are small beside the simplex would be split for ever:
//! each would ask for the next.

use crate::complex::{SimplexId, VertexId};
use crate::memory::AllocResult;
use crate::netmesh::state::State;
use crate::netmesh::state::facets::floors::{Floors, Guard, Purpose};
use crate::numerics::{distance, shortest_distance};

/// A simplex may ask for a split only where the radius of what is split, relative to its shortest
/// edge, is as large as this.
const GUARD: f64 = 0.7;

/// Part of the radius of a simplex that is no more than that of what its centre encroaches, less
/// what roundings take.
const HALF: f64 = 0.499;

/// Radius about an end of sharp lines in which nothing is split for a simplex, relative to the
/// local feature size there.
const OF_FEATURE: f64 = 0.25;

/// Subsegment of a sharp line, or subfacet of a facet that has one, as the guard judges it.
struct SharpPart {
    /// Centre of its smallest ball, or of its circle.
    center: [f64; 3],
    radius: f64,
    /// Radius from which on a simplex may ask for a split once more at the end.
    floor: f64,
}

impl<const D: usize> State<D> {
    /// Returns true unless a subsegment is of a sharp line, and `guard` keeps it.
    pub(super) fn may_split(&mut self, subsegment: u32, guard: Guard) -> AllocResult<bool> {
        self.in_space().map_or(Ok(true), |state| state.guard_admits(subsegment, guard))
    }
}

impl State<3> {
    /// Returns true if a guard lets a subsegment be split.
    fn guard_admits(&mut self, subsegment: u32, guard: Guard) -> AllocResult<bool> {
        let own = *self.segments.chains.get(subsegment);
        if !self.facets.is_sharp_line(own.line) {
            return Ok(true);
        }
        let [a, b] = own.ends.map(|end| self.delaunay.point(end));
        let center = std::array::from_fn(|k| 0.5 * a[k] + 0.5 * b[k]);
        let floor = self.facets.floors.of_line(own.line);
        let part = SharpPart { center, radius: 0.5 * distance(a, b), floor };
        let ends = self.segments.chains.lines[own.line as usize].ends;
        self.admits(guard, &part, |_, at| ends.get(at).copied())
    }

    /// Returns true if a guard lets a subfacet be split.
    fn guard_admits_subfacet(&mut self, subfacet: u32, guard: Guard) -> AllocResult<bool> {
        let facet = self.facets.get(subfacet).facet;
        if !self.facets.is_sharp_facet(facet) {
            return Ok(true);
        }
        let (center, radius) = self.circle_of(subfacet);
        let part = SharpPart { center, radius, floor: self.facets.floors.of_facet(facet) };
        self.admits(guard, &part, |state, at| {
            let end = state.facets.sharp_ends(facet).get(at)?;
            Some(VertexId::new(*end as usize))
        })
    }

    /// Returns true if a guard lets a part be split of a facet or line that has these ends of sharp
    /// lines: it is large enough, and not so near to one of them that nothing is split there for a
    /// simplex. The simplices around two facets that meet at a small angle just there would be
    /// split again for the next, ever nearer to the end.
    fn admits(
        &mut self,
        guard: Guard,
        part: &SharpPart,
        end: impl Fn(&Self, usize) -> Option<VertexId>,
    ) -> AllocResult<bool> {
        let is_admitted = guard.admits(part.radius, part.floor);
        if !is_admitted || !matches!(guard, Guard::Usual { .. }) {
            return Ok(is_admitted);
        }
        let mut at = 0;
        while let Some(end) = end(self, at) {
            let protected = OF_FEATURE * self.feature_size(end)?;
            if distance(self.delaunay.point(end), &part.center) < protected {
                return Ok(false);
            }
            at += 1;
        }
        Ok(true)
    }

    /// Returns true if a vertex in a subfacet crosses what the guard keeps of other facets, among
    /// the subfacets near it: those would have to be split for it.
    pub(super) fn crosses_protected(&mut self, subfacet: u32, guard: Guard) -> AllocResult<bool> {
        if matches!(guard, Guard::Open) {
            return Ok(false);
        }
        let own = self.facets.get(subfacet).facet;
        for at in 0..self.facets.near.subfacets.len() {
            let (other, is_crossed) = self.facets.near.subfacets[at];
            let is_other = self.facets.get(other).facet != own;
            if is_crossed && is_other && !self.guard_admits_subfacet(other, guard)? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Keeps those of the encroached subsegments and subfacets that the guard lets a simplex split,
    /// and returns the guard. A part whose smallest ball holds the centre of the simplex has half
    /// its radius or more: for a size all of these may be split, beside small angles as well, until
    /// simplices are as small as is asked for.
    pub(super) fn keep_large(
        &mut self,
        simplex: SimplexId,
        purpose: Purpose,
    ) -> AllocResult<Guard> {
        let vertices = self.delaunay.complex().vertices(simplex);
        let points: [&[f64; 3]; 4] = std::array::from_fn(|at| self.delaunay.point(vertices[at]));
        let least = GUARD * shortest_distance(&points).2;
        let radius = self.delaunay.radius(simplex).unwrap_or(0.0);
        let is_low = self.facets.floors.are_set() && !self.has_small_angle(simplex);
        let guard = match (purpose, is_low) {
            (Purpose::Size, _) => Guard::Sized { least: least.min(HALF * radius) },
            (Purpose::Bound, true) => Guard::Low { least },
            (Purpose::Bound, false) => Guard::Usual { least },
        };
        let mut near = std::mem::take(&mut self.facets.near);
        keep(&mut near.subsegments, |own| self.guard_admits(own, guard))?;
        keep(&mut near.subfacets, |own| self.guard_admits_subfacet(own, guard))?;
        self.facets.near = near;
        Ok(guard)
    }

    /// Lets simplices that were kept at no small angle ask once more for splits, of parts down to
    /// the floors that are set now. False if there are none, or it was done before.
    pub(in crate::netmesh) fn lower_guard(&mut self) -> AllocResult<bool> {
        if self.facets.is_empty() || self.facets.floors.are_set() {
            return Ok(false);
        }
        let mut is_any = false;
        for simplex in self.delaunay.complex().simplices() {
            let is_live = self.delaunay.complex().is_live(simplex);
            if is_live && self.facets.is_kept(simplex) && !self.has_small_angle(simplex) {
                self.facets.release(simplex);
                is_any = true;
            }
        }
        if is_any {
            self.facets.floors = self.floors()?;
        }
        Ok(is_any)
    }

    /// Returns the floors of all facets and lines, by the parts that they have.
    fn floors(&self) -> AllocResult<Floors> {
        let chains = &self.segments.chains;
        let mut floors = Floors::new(self.facets.facets.len(), chains.lines.len())?;
        for subfacet in 0..self.facets.len() as u32 {
            floors.note_subfacet(self.facets.get(subfacet).facet, self.circle_of(subfacet).1);
        }
        for subsegment in 0..chains.len() as u32 {
            let own = chains.get(subsegment);
            let [a, b] = own.ends.map(|end| self.delaunay.point(end));
            floors.note_subsegment(own.line, 0.5 * distance(a, b));
        }
        Ok(floors)
    }
}

/// Keeps those of some parts of the boundary that are admitted.
fn keep(
    parts: &mut Vec<(u32, bool)>,
    mut admits: impl FnMut(u32) -> AllocResult<bool>,
) -> AllocResult<()> {
    let mut kept = 0;
    for at in 0..parts.len() {
        if admits(parts[at].0)? {
            parts[kept] = parts[at];
            kept += 1;
        }
    }
    parts.truncate(kept);
    Ok(())
}
