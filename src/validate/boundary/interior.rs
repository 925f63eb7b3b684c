//! Level 3: where closed curves tell what is inside, each component has a winding number. It is
//! found by the chains of the caller's segments, each followed from end to end: it differs on both
//! sides of a subsegment by how many segments run along that, less those that run against it, and
//! is 0 where the mesh ends. For parity it counts whether the number is odd.

use super::chains::{Chains, Way};
use super::edges::Edges;
use super::regions::Components;
use super::walls::{self, Walls};
use crate::error::message;
use crate::memory::{AllocResult, Lists, TryGrow, filled};
use crate::mesh::{Inputs, NONE, Segments};
use crate::options::Interior;
use crate::quality::view::View;
use crate::validate::report::{Findings, Violation, ViolationKind};

/// Returns true if closed curves or surfaces tell what is inside.
pub(super) fn is_asked<const D: usize>(view: View<'_, D>) -> bool {
    !matches!(view.mesh.parameters.interior, Interior::Auto | Interior::Seeds)
}

/// Fills in the winding numbers of `components`. `steps`: wall -> by how much the winding number on
/// its first side exceeds that on its second.
pub(super) fn judge<const D: usize>(
    view: View<'_, D>,
    walls: &Walls,
    mut steps: Vec<i64>,
    components: &mut Components,
    findings: &mut Findings,
) -> AllocResult<()> {
    let interior = view.mesh.parameters.interior;
    if interior == Interior::Parity {
        steps.iter_mut().for_each(|step| *step = step.rem_euclid(2));
    }
    spread(walls, &steps, interior, components)?;
    check_steps(view, walls, &steps, interior, components, findings);
    Ok(())
}

/// Returns for each subsegment by how much the winding number on its left exceeds that on its
/// right.
pub(super) fn steps(
    inputs: &Inputs,
    segments: &Segments,
    view: View<'_, 2>,
    edges: &Edges,
) -> AllocResult<Vec<i64>> {
    let mut steps = filled(edges.walls.sides.len(), 0i64)?;
    let mut chains = Chains::new(view, &edges.at)?;
    for segment in (0..segments.count()).filter(|&segment| segments.encloses(segment)) {
        if chains.follow(Way::of(inputs, segments, segment))?.is_err() {
            continue;
        }
        for pair in chains.found().windows(2) {
            if let Some((subsegment, is_along)) = edges.between(view, [pair[0], pair[1]]) {
                steps[subsegment as usize] += if is_along { 1 } else { -1 };
            }
        }
    }
    Ok(steps)
}

fn reduced(number: i64, interior: Interior) -> i64 {
    if interior == Interior::Parity { number.rem_euclid(2) } else { number }
}

/// Gives all components their numbers, from those at the hull on.
fn spread(
    walls: &Walls,
    steps: &[i64],
    interior: Interior,
    components: &mut Components,
) -> AllocResult<()> {
    let component_of =
        |triangle: u32| components.of.get(triangle as usize).copied().unwrap_or(NONE);
    let beside = Lists::of_pairs(components.all.len(), || {
        let sides = walls.sides.iter().zip(0u32..);
        sides.flat_map(|(sides, wall)| sides.map(|side| (component_of(side), wall)))
    })?;
    let mut waiting = Vec::new();
    // A wall on the hull has nothing beyond it.
    for (sides, &step) in walls.sides.iter().zip(steps) {
        let [left, right] = sides.map(component_of);
        let (within, number) = match (left, right) {
            (NONE, right) => (right, -step),
            (left, NONE) => (left, step),
            _ => continue,
        };
        if let Some(component) = components.all.get_mut(within as usize) {
            if component.winding.is_none() {
                component.winding = Some(reduced(number, interior));
                waiting.try_push(within)?;
            }
        }
    }
    for (component, number) in components.all.iter_mut().zip(0u32..) {
        if component.is_outside && component.winding.is_none() {
            component.winding = Some(0);
            waiting.try_push(number)?;
        }
    }
    while let Some(component) = waiting.pop() {
        let own = components.all[component as usize].winding.unwrap_or(0);
        for &wall in beside.of(component as usize) {
            let [left, right] = walls.sides[wall as usize].map(component_of);
            let step = steps[wall as usize];
            let (beyond, number) =
                if left == component { (right, own - step) } else { (left, own + step) };
            let Some(other) = components.all.get_mut(beyond as usize) else { continue };
            if other.winding.is_none() {
                other.winding = Some(reduced(number, interior));
                waiting.try_push(beyond)?;
            }
        }
    }
    Ok(())
}

/// Checks that the numbers on both sides of each wall differ by its step: curves or surfaces close.
fn check_steps<const D: usize>(
    view: View<'_, D>,
    walls: &Walls,
    steps: &[i64],
    interior: Interior,
    components: &Components,
    findings: &mut Findings,
) {
    let number = |triangle: u32| {
        let component = components
            .of
            .get(triangle as usize)
            .map(|&component| &components.all[component as usize]);
        component.map_or(0, |component| component.winding.unwrap_or(0))
    };
    for (at, (&sides, &step)) in walls.sides.iter().zip(steps).enumerate() {
        let [left, right] = sides.map(number);
        findings.check(left == reduced(right + step, interior), || {
            let vertex = walls::vertices::<D>(view.mesh, at)[0];
            let (noun, curves) = match D {
                2 => (walls::noun::<D>(), "curves"),
                _ => (walls::noun::<D>(), "surfaces"),
            };
            let message = message!(
                "{noun} {at} at vertex {vertex} has the winding numbers {left} and {right} on its \
                 sides, and {step} {curves} run along it: they do not close"
            );
            Violation::new(ViolationKind::DomainPlace, message).vertex(vertex as usize)
        });
    }
}
