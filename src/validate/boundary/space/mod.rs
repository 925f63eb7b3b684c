//! The rules of facets in space, and of segments there.
//!
//! - Level 1, `arrays`: a subfacet names the simplices that have it, and a domain that is cropped
//!   has the subsegments and subfacets of its simplices.
//! - Level 2, `faces`: subsegments are edges and subfacets faces of the mesh, which is exactly
//!   Delaunay; `ways`: chains of subsegments lead along segments and along the edges of facets, and
//!   there are no others, each as given or split by its `reading`; `groups`: which triangles of a
//!   surface are one facet; `left_out`: which have nothing to keep; `tiling`: the subfacets of a
//!   facet, which `tiles` finds, tile it in the projection along an axis; `plane`: their vertices
//!   are as near to its plane as rounding lets them be; `frame`: the boundary of a hull or box.
//! - Level 3: what regions have in common with the plane's, with the volumes of labels; `frame`:
//!   the volume of a hull, by [`hull`], or box; `flat`: the simplices within facets; `forced`:
//!   those that small angles excuse.

mod arrays;
mod directions;
mod faces;
mod flat;
mod forced;
mod frame;
mod given;
mod groups;
mod hull;
mod inside;
mod left_out;
mod plane;
mod reading;
#[cfg(test)]
mod tests;
mod tiles;
mod tiling;
mod ways;

pub(super) use arrays::check as check_arrays;
pub(super) use faces::walls;
pub(in crate::validate) use reading::Reading;

use super::{Outline, Promised, areas, interior, regions};
use crate::memory::{AllocResult, collected, filled};
use crate::mesh::{Facets, Inputs, NONE};
use crate::options::Crossings;
use crate::quality::view::View;
use crate::validate::report::Findings;
use faces::Faces;
use given::Facet;
use ways::{Failing, Ways};

/// Checks level 2 of a mesh in space for which level 1 holds, and returns how it is read.
pub(super) fn check_geometry(
    inputs: &Inputs,
    outline: Option<Outline<'_>>,
    view: View<'_, 3>,
    findings: &mut Findings,
) -> AllocResult<Reading> {
    if !has_boundary(outline, view) {
        return Ok(Reading::default());
    }
    let faces = Faces::new(view)?;
    faces::check(view, &faces, findings)?;
    let mut reading = Reading::as_given(inputs, outline, view, &faces)?;
    if view.mesh.parameters.crossings == Crossings::Split {
        let mut as_given = Findings::counting();
        let failing = check_reading(inputs, outline, view, &faces, &reading, &mut as_given)?;
        if as_given.clean() {
            findings.merge(as_given);
            return Ok(reading);
        }
        (reading.facets, reading.segments) = (failing.facets, failing.segments);
    }
    check_reading(inputs, outline, view, &faces, &reading, findings)?;
    Ok(reading)
}

/// Checks the rules of level 2 by a reading, and returns for which facets and segments something
/// does not hold.
fn check_reading(
    inputs: &Inputs,
    outline: Option<Outline<'_>>,
    view: View<'_, 3>,
    faces: &Faces,
    reading: &Reading,
    findings: &mut Findings,
) -> AllocResult<Failing> {
    let mut ways = Ways::new(inputs, view, faces, reading)?;
    match outline {
        Some(Outline { segments, facets, .. }) => {
            ways.check_segments(segments, findings)?;
            each_facet(facets, &mut ways, findings, |facet, _, ways, findings| {
                tiling::check(facet, ways, findings)
            })?;
            frame::check(&mut ways, findings)?;
            ways.check_owners(findings)?;
        }
        None => {
            tiling::check_rims(view, faces, findings)?;
            frame::check(&mut ways, findings)?;
        }
    }
    Ok(ways.failing)
}

/// Calls `visit` with each facet between inputs, and by how much the winding number grows behind
/// it; checks which triangles are one facet.
fn each_facet(
    facets: &Facets,
    ways: &mut Ways<'_>,
    findings: &mut Findings,
    mut visit: impl FnMut(&Facet, i64, &mut Ways<'_>, &mut Findings) -> AllocResult<()>,
) -> AllocResult<()> {
    let mut visit = |mut facet: Facet, balance, ways: &mut Ways<'_>, findings: &mut Findings| {
        facet.projection = tiling::projection_of(&facet, ways.view)?;
        visit(&facet, balance, ways, findings)
    };
    if facets.are_triangles {
        return groups::each_facet(facets, ways, findings, visit);
    }
    for number in 0..facets.count() {
        let before = findings.violations;
        match given::polygon(ways.inputs, facets, number)? {
            Some(facet) => visit(facet, 1, ways, findings)?,
            // It has nothing to keep, if crossings are split.
            None if ways.splits(number as u32) => {}
            None => drop(findings.check(false, || given::describe_no_area(number))),
        }
        ways.failing.facets[number] = findings.violations > before;
    }
    Ok(())
}

/// Returns by how much the winding number grows behind each subfacet, which is of all facets that
/// share it.
fn steps(
    inputs: &Inputs,
    facets: &Facets,
    view: View<'_, 3>,
    faces: &Faces,
    reading: &Reading,
) -> AllocResult<Vec<i64>> {
    let boundary = &view.mesh.boundary;
    if !reading.splits_any() {
        return collected(
            boundary.subfacet_parents.iter().map(|&parent| i64::from(parent != NONE)),
        );
    }
    let mut steps = filled(boundary.subfacets.len(), 0)?;
    let mut ways = Ways::new(inputs, view, faces, reading)?;
    // Level 2 has said what is to say.
    let mut known = Findings::counting();
    each_facet(facets, &mut ways, &mut known, |facet, balance, ways, known| {
        for tile in tiling::tiled(facet, ways, known)?.tiles {
            let step = tile.times * balance;
            steps[tile.subfacet as usize] += if tile.is_turned { -step } else { step };
        }
        Ok(())
    })?;
    Ok(steps)
}

/// Checks level 3 of a mesh in space for which level 1 holds, which has a reading.
pub(super) fn check_regions(
    inputs: &Inputs,
    outline: Option<Outline<'_>>,
    view: View<'_, 3>,
    (reading, promised): (&Reading, Promised<'_>),
    findings: &mut Findings,
) -> AllocResult<()> {
    if !has_boundary(outline, view) {
        return Ok(());
    }
    let boundary = &view.mesh.boundary;
    let faces = Faces::new(view)?;
    if !boundary.simplex_regions.is_empty() {
        let steps = match outline {
            Some(Outline { facets, .. }) if interior::is_asked(view) => {
                Some(steps(inputs, facets, view, &faces, reading)?)
            }
            _ => None,
        };
        regions::check(outline, view, &faces.walls, steps, promised, findings)?;
        areas::check(view, &faces.walls, promised.count, findings)?;
    }
    frame::check_volume(inputs, view, &faces, findings)?;
    flat::check(view, &faces, findings)?;
    forced::check(inputs, view, &faces, findings)
}

fn has_boundary(outline: Option<Outline<'_>>, view: View<'_, 3>) -> bool {
    view.mesh.boundary.has_any()
        || frame::has_frame(view)
        || !view.mesh.boundary.subfacets.is_empty()
        || outline.is_some_and(|outline| outline.segments.count() + outline.facets.count() > 0)
}
