//! The rules of facets in space, and of segments there.
//!
//! - Level 1, `arrays`: a subfacet names the simplices that have it, and a domain that is cropped
//!   has the subsegments and subfacets of its simplices.
//! - Level 2, `faces`: subsegments are edges and subfacets faces of the mesh, which is exactly
//!   Delaunay; `ways`: chains of subsegments lead along segments and along the edges of facets, and
//!   there are no others; `groups`: which triangles of a surface are one facet; `tiling`: the
//!   subfacets of a facet tile it in the projection along an axis; `plane`: their vertices are as
//!   near to its plane as rounding lets them be; `frame`: the boundary of a hull or box.
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
mod plane;
#[cfg(test)]
mod tests;
mod tiling;
mod ways;

pub(super) use arrays::check as check_arrays;
pub(super) use faces::walls;

use super::{Outline, Promised, areas, interior, regions};
use crate::memory::AllocResult;
use crate::mesh::{Facets, Inputs};
use crate::quality::view::View;
use crate::validate::report::Findings;
use faces::Faces;
use ways::Ways;

/// Checks level 2 of a mesh in space for which level 1 holds.
pub(super) fn check_geometry(
    inputs: &Inputs,
    outline: Option<Outline<'_>>,
    view: View<'_, 3>,
    findings: &mut Findings,
) -> AllocResult<()> {
    if !has_boundary(outline, view) {
        return Ok(());
    }
    let faces = Faces::new(view)?;
    faces::check(view, &faces, findings)?;
    let mut ways = Ways::new(inputs, view, &faces)?;
    let Some(Outline { segments, facets, .. }) = outline else {
        tiling::check_rims(view, &faces, findings)?;
        return frame::check(&mut ways, findings);
    };
    ways.check_segments(segments, findings)?;
    if facets.are_triangles {
        groups::check(facets, &mut ways, findings)?;
    } else {
        check_polygons(inputs, facets, &mut ways, findings)?;
    }
    frame::check(&mut ways, findings)?;
    ways.check_owners(findings);
    Ok(())
}

fn check_polygons(
    inputs: &Inputs,
    facets: &Facets,
    ways: &mut Ways<'_>,
    findings: &mut Findings,
) -> AllocResult<()> {
    for number in 0..facets.count() {
        match given::polygon(inputs, facets, number)? {
            Some(facet) => tiling::check(&facet, ways, findings)?,
            // It has nothing to keep, if crossings are split.
            None if ways.splits_crossings() => {}
            None => drop(findings.check(false, || given::describe_no_area(number))),
        }
    }
    Ok(())
}

/// Checks level 3 of a mesh in space for which level 1 holds.
pub(super) fn check_regions(
    inputs: &Inputs,
    outline: Option<Outline<'_>>,
    view: View<'_, 3>,
    promised: Promised<'_>,
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
                Some(groups::steps(inputs, facets, view)?)
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
