//! Triangles that were led through vertices near their edges, and are turned round since. What is
//! no wider than its edges are bent may be turned anyhow; as a facet of its own it cannot be told
//! from the other side.

use super::TaskInSpace;
use super::merge::Surface;
use super::pieces::Pieces;
use super::projection::{Projection, normal};
use crate::error::{Error, Result};
use crate::memory::{AllocResult, collected, filled};
use crate::mesh::NONE;

/// Part of the largest component of a normal from which on a projection along another axis serves
/// as well.
const PART: f64 = 0.5;

/// Bits of all axes.
const ALL: u8 = 0b111;

/// Refuses a surface if parts of a triangle of the caller's are a facet of their own, and if there
/// is no projection in which all of them turn as the triangle does. `firsts`: triangle -> the first
/// one of its facet. O(n) for n triangles.
pub(super) fn refuse_turned(
    points: &[[f64; 3]],
    surface: &Surface<'_>,
    firsts: &[u32],
) -> Result<()> {
    let corners = |own: [u32; 3]| own.map(|vertex| &points[vertex as usize]);
    // Facet -> the axes along which it may be seen; and the triangle that it is a part of.
    let mut axes = filled(firsts.len(), ALL)?;
    let mut origins = filled(firsts.len(), NONE)?;
    let all = || firsts.iter().zip(surface.origins).zip(surface.triangles);
    let members = || all().filter(|((first, _), _)| **first != NONE);
    for ((&first, &origin), &own) in members() {
        let known = &mut origins[first as usize];
        let is_same = *known == NONE || *known == origin;
        *known = if is_same { origin } else { surface.given.len() as u32 };
        let given = surface.given[origin as usize];
        if own != given {
            axes[first as usize] &= axes_alike(corners(given), corners(own));
        }
    }
    for ((&first, &origin), &own) in members() {
        if axes[first as usize] == 0 && origins[first as usize] == origin {
            return Err(Error::without_room_for_facets(corners(own)[0]));
        }
    }
    Ok(())
}

/// Returns true if all pieces of each of the caller's triangles turn as this does, in a projection.
/// O(n) for n pieces.
pub(super) fn turn_as_given(
    points: &[[f64; 3]],
    task: &TaskInSpace<'_>,
    pieces: &Pieces,
) -> AllocResult<bool> {
    let corners = |own: [u32; 3]| own.map(|vertex| &points[vertex as usize]);
    let given = collected(task.triangles())?;
    let mut axes = filled(given.len(), ALL)?;
    for piece in &pieces.all {
        let (Some(own), Some(facet)) = (piece.triangle(), piece.facet()) else { continue };
        if let Some(&given) = given.get(facet as usize).filter(|&&given| given != own) {
            axes[facet as usize] &= axes_alike(corners(given), corners(own));
        }
    }
    Ok(!axes.contains(&0))
}

/// Returns the axes, as bits, along which a triangle may be seen and another turns as it does.
fn axes_alike(given: [&[f64; 3]; 3], own: [&[f64; 3]; 3]) -> u8 {
    let normal = normal(given).map(f64::abs);
    let largest = normal.into_iter().fold(0.0, f64::max);
    let is_alike = |&axis: &usize| {
        let projection = Projection::ALL[axis];
        normal[axis] >= PART * largest && projection.turn(own) == projection.turn(given)
    };
    (0..3).filter(is_alike).fold(0, |bits, axis| bits | 1 << axis)
}
