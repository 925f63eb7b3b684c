//! Numbers of regions without a seed, in the order of the facets that bound them, in the plane of
//! segments. A region is known by the first facet that it is behind, so that of shells that share
//! walls each numbers what it encloses; those that are behind none come last, by the first that
//! they are before.

use crate::memory::{AllocResult, TryGrow, filled};
use crate::mesh::NONE;
use crate::netmesh::state::State;
use crate::netmesh::state::segments::regions::OUTSIDE;
use crate::netmesh::state::segments::walls::Walls;

impl<const D: usize> State<D> {
    /// Gives numbers from 1 on, but for `taken`, which is sorted, to the regions of the domain for
    /// which `has_label` is false. O(walls + n log n) for n regions and seeds.
    pub(super) fn number_regions(
        &self,
        has_label: &[bool],
        is_inside: &[bool],
        taken: &[i32],
        labels: &mut [i32],
    ) -> AllocResult<()> {
        let known = self.first_walls()?;
        let mut order = Vec::new();
        for (region, &first) in known.iter().enumerate().skip(OUTSIDE as usize + 1) {
            if is_inside[region] && !has_label[region] {
                order.try_push((first, region))?;
            }
        }
        order.sort_unstable();
        let mut free = (1..).filter(|number| taken.binary_search(number).is_err());
        for (_, region) in order {
            labels[region] = free.next().unwrap_or(0);
        }
        Ok(())
    }

    /// Returns for each region the first of the caller's facets that it is behind, or else, after
    /// true, the first that it is before.
    fn first_walls(&self) -> AllocResult<Vec<(bool, u32)>> {
        let walls = Walls { chains: &self.segments.chains, facets: &self.facets };
        let regions = &self.segments.regions;
        let mut behind = filled(regions.len(), NONE)?;
        let mut before = filled(regions.len(), NONE)?;
        for (wall, &sides) in regions.sides.iter().enumerate() {
            let parent = walls.parent(D, wall);
            // The left of a line is its inside.
            let [first, second] = sides.map(|region| region as usize);
            let (back, front) = if D == 2 { (first, second) } else { (second, first) };
            behind[back] = parent.min(behind[back]);
            before[front] = parent.min(before[front]);
        }
        let mut known = filled(regions.len(), (true, NONE))?;
        for (region, known) in known.iter_mut().enumerate() {
            *known = match behind[region] {
                NONE => (true, before[region]),
                facet => (false, facet),
            };
        }
        Ok(known)
    }
}
