//! Level 3: where regions without a seed are numbered, they have the numbers from 1 on, but for the
//! labels of seeds, by the first of the caller's facets, in the plane of segments, that they are
//! behind (on the left of); those that are behind none come last, by the first that they are
//! before. Regions with one such facet are in any order.

use super::regions::Components;
use super::walls::Walls;
use crate::memory::{AllocResult, TryGrow, filled};
use crate::mesh::NONE;
use crate::options::Labels;
use crate::quality::view::View;

/// Sets which labels the components without a seed must have.
pub(super) fn expect<const D: usize>(
    view: View<'_, D>,
    walls: &Walls,
    components: &mut Components,
) -> AllocResult<()> {
    if view.mesh.parameters.labels == Labels::Seeds {
        return Ok(());
    }
    let first = first_walls(view, walls, components)?;
    let mut taken = Vec::new();
    let mut order = Vec::new();
    for (at, component) in components.all.iter().enumerate() {
        if component.is_unlabelled() {
            let label = view.mesh.boundary.simplex_regions[component.first];
            order.try_push((first[at], label, at))?;
        } else if let Some(label) = component.label_of_seed() {
            taken.try_push(label)?;
        }
    }
    order.sort_unstable();
    taken.sort_unstable();
    let free = (1..).filter(|number| taken.binary_search(number).is_err());
    for ((_, _, at), number) in order.into_iter().zip(free) {
        components.all[at].label = number;
    }
    Ok(())
}

/// Returns for each component the first of the caller's facets that it is behind, or else, after
/// true, the first that it is before.
fn first_walls<const D: usize>(
    view: View<'_, D>,
    walls: &Walls,
    components: &Components,
) -> AllocResult<Vec<(bool, u32)>> {
    let boundary = &view.mesh.boundary;
    let parents = if D == 2 { &boundary.parents } else { &boundary.subfacet_parents };
    let mut first = filled(components.all.len(), [NONE; 2])?;
    for (sides, &parent) in walls.sides.iter().zip(parents) {
        for (side, &simplex) in sides.iter().enumerate() {
            if let Some(&component) = components.of.get(simplex as usize) {
                let known = &mut first[component as usize][side];
                *known = parent.min(*known);
            }
        }
    }
    let mut found = filled(first.len(), (true, NONE))?;
    for (found, [behind, before]) in found.iter_mut().zip(first) {
        *found = if behind == NONE { (true, before) } else { (false, behind) };
    }
    Ok(found)
}
