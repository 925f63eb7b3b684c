//! The certificate: a checker that recomputes what must hold of a mesh from its coordinates and
//! simplices alone. It shares neither code nor arithmetic with the builder.
//!
//! - Level 1, topology: ids in range, every facet in one or two simplices as the neighbours say,
//!   the simplices are a ball by their Euler characteristic, links of vertices and the hull are
//!   closed.
//! - Level 2, geometry: all orientations are positive, the simplices cover their convex hull once,
//!   every facet is locally Delaunay, hence all are Delaunay. Exact for all finite coordinates.
//! - Level 3, the paper: inputs are vertices with their bits, the domains are a tree of disjoint
//!   balls, cages are not encroached (Definition 2), and cells have the promised quality
//!   (Definition 4), precision-limited ones apart.
//! - Segments, facets and regions have rules in each level: see [`boundary`].
//!
//! Quality conventions at level 3: Definition 4 holds over all corners in a domain whose cage
//! surrounds its inputs: the root, and every domain if `epsilon <= 0.8 cage_scale`. In others a
//! cell counts the corners within `min(0.85, 1 - delta^2 / 2) * cage_scale * r` of the domain's
//! centre. The union cell of a cage counts as cells of its parent do; [`crate::quality`] has the
//! measures. A vertex marked as precision-limited is exempt, and so is a cage whose centre or one
//! of whose vertices is. What is marked as beyond the bound is exempt, where the bound may give
//! way to the dihedral angle. With the criterion `RadiusEdge` the bound holds for each simplex
//! without an exempt vertex whose vertices are all of one such domain; otherwise for each whose
//! vertices are in no cage and whose corner counts in the domain of each; union cells are not
//! bounded then. With segments, this is asked only of simplices in the domain that no small angle
//! between segments forces.

mod angles;
mod arrays;
mod aspect;
mod boundary;
mod boxes;
mod cages;
mod facets;
mod geometry;
mod hierarchy;
mod hull;
mod inputs;
mod links;
pub mod parts;
mod report;
mod signs;
mod sizes;
mod surface;
#[cfg(test)]
mod tests;
mod winding;

pub use boundary::Outline;
pub use report::{Report, Violation, ViolationKind};
pub use surface::{Promises, validate_surface};

use crate::error::{Error, Result, message};
use crate::memory::{AllocResult, TryGrow, collected};
use crate::mesh::{Inputs, MAX_DIM, MIN_DIM, Mesh, Triangulation, in_dimension};
use crate::options::{Algorithm, Output};
use crate::quality::cells::pieces;
use crate::quality::view::View;
use crate::threads::usable;
use boundary::Promised;
use report::Findings;
use signs::{Adaptive, Robust, Signs};

/// Checks levels `1..=level` (1 topology, 2 geometry, 3 the paper).
///
/// Accepts any contents of `triangulation`, however broken. Level 2 and 3 are checked only where
/// level 1 holds; level 3 also where level 2 does not. O(m log m) for m simplices in a fixed
/// dimension; level 1 counts faces, which costs a factor of up to 2^D.
///
/// The triangulation that a domain is cropped from is checked, and that the domain is the part of
/// it that it must be. Without the caller's segments ([`validate_outlined`]) nothing is asked of
/// where subsegments lead, or of what is a hole.
///
/// # Errors
/// `InvalidArgument` if `level` is not 1, 2 or 3.
pub fn validate(inputs: &Inputs, triangulation: &Triangulation, level: u32) -> Result<Report> {
    check_levels(inputs, None, triangulation, level)
}

/// Checks a triangulation as [`validate`] does, and the segments, facets and regions that the
/// caller of the run gave beside the points.
///
/// # Errors
/// Fails as [`validate`] does.
pub fn validate_outlined(
    inputs: &Inputs,
    outline: Outline<'_>,
    triangulation: &Triangulation,
    level: u32,
) -> Result<Report> {
    check_levels(inputs, Some(outline), triangulation, level)
}

/// Checks the result of the last run of `mesh` as [`validate_outlined`] does.
///
/// # Errors
/// Fails as [`validate`] does, and with `State` before a run.
pub fn validate_mesh(mesh: &Mesh, level: u32) -> Result<Report> {
    let (segments, regions) = mesh.outline_of_result();
    let facets = mesh.facets_of_result();
    validate_outlined(mesh.inputs(), Outline { segments, facets, regions }, mesh.result()?, level)
}

fn check_levels(
    inputs: &Inputs,
    outline: Option<Outline<'_>>,
    triangulation: &Triangulation,
    level: u32,
) -> Result<Report> {
    if !(1..=3).contains(&level) {
        let message = message!("level is {level}; it must be 1, 2 or 3");
        return Err(Error::invalid(message));
    }
    let whole = triangulation.boundary.whole.as_deref().unwrap_or(triangulation);
    let case = Case { inputs, outline, result: triangulation };
    let findings = in_dimension!(
        whole.dim,
        D => check::<D>(case, View { mesh: whole }, level),
        _ => wrong_dimension(whole.dim)
    );
    Ok(report(findings?))
}

/// Result and inputs, which are checked beside the triangulation of all of the hull.
#[derive(Clone, Copy)]
struct Case<'a> {
    inputs: &'a Inputs,
    outline: Option<Outline<'a>>,
    /// Triangulation of all of the hull, or what is cropped from it.
    result: &'a Triangulation,
}

/// Returns the findings of each level that was asked for and could be checked.
fn check<const D: usize>(
    case: Case<'_>,
    view: View<'_, D>,
    level: u32,
) -> AllocResult<Vec<Findings>> {
    let Case { inputs, outline, result } = case;
    let mut topology = Findings::default();
    check_topology(inputs, view, &mut topology)?;
    boundary::check_arrays(outline, result, view, &mut topology)?;
    let holds = topology.clean();
    let mut levels = collected([topology])?;
    let mut reading = None;
    if holds && level >= 2 {
        let mut findings = Findings::default();
        let threads = usable(view.mesh.parameters.threads).min(pieces(view.simplex_count()).len());
        let mut signs = collected((0..threads.max(1)).map(|_| Signs::<Robust>::default()))?;
        check_geometry(view, &mut signs, &mut findings)?;
        reading = boundary::check_geometry(inputs, outline, view, &mut findings)?;
        levels.try_push(findings)?;
    }
    if holds && level >= 3 {
        let mut findings = Findings::default();
        let promised = Promised::of(result);
        boundary::check_regions(
            inputs,
            outline,
            view,
            (reading.as_ref(), promised),
            &mut findings,
        )?;
        check_paper(case, view, promised, &mut findings)?;
        levels.try_push(findings)?;
    }
    Ok(levels)
}

/// Checks level 2, with signs of any source, on as many threads as there are `signs`.
fn check_geometry<const D: usize, A: Adaptive + Send>(
    view: View<'_, D>,
    signs: &mut [Signs<A>],
    findings: &mut Findings,
) -> AllocResult<()> {
    if geometry::check(view, signs, findings)? {
        winding::check(view, &mut signs[0], findings)?;
    }
    Ok(())
}

fn check_topology<const D: usize>(
    inputs: &Inputs,
    view: View<'_, D>,
    findings: &mut Findings,
) -> AllocResult<()> {
    if !arrays::check(inputs, view.mesh, findings)? {
        return Ok(());
    }
    let facets = facets::check(view, findings)?;
    if findings.clean() {
        links::check(view, facets, findings)?;
        hull::check(view, findings)?;
    }
    Ok(())
}

fn check_paper<const D: usize>(
    case: Case<'_>,
    view: View<'_, D>,
    promised: Promised<'_>,
    findings: &mut Findings,
) -> AllocResult<()> {
    let (inputs, mesh) = (case.inputs, view.mesh);
    inputs::check(inputs, mesh, findings);
    if mesh.parameters.algorithm == Algorithm::Delaunay {
        inputs::check_plain(inputs, mesh, findings);
        return Ok(());
    }
    if let Some(tree) = hierarchy::check(view, findings)? {
        let cells = aspect::survey(view, &tree, promised, findings)?;
        cages::check(view, &tree, &cells, findings)?;
        aspect::check(view, &cells, findings)?;
    }
    angles::check(view, promised, findings)?;
    let of_regions = boundary::largest_edges(case.outline, view)?;
    sizes::check(inputs, view, promised, &of_regions, findings)?;
    let finished = mesh.parameters.output == Output::WellSpaced;
    findings.check(!finished || mesh.domains.len() == 1, || {
        let message =
            message!("a finished mesh has {} domains, not the root alone", mesh.domains.len());
        Violation::new(ViolationKind::NotFinished, message).domain(1)
    });
    Ok(())
}

fn wrong_dimension(dim: usize) -> AllocResult<Vec<Findings>> {
    let mut findings = Findings::default();
    findings.check(false, || {
        let message = message!("dim is {dim}; it must be {MIN_DIM} to {MAX_DIM}");
        Violation::new(ViolationKind::ArrayLength, message)
    });
    collected([findings])
}

fn report(levels: Vec<Findings>) -> Report {
    Report {
        level: levels.iter().take_while(|findings| findings.clean()).count() as u32,
        violations: levels.iter().map(|findings| findings.violations).sum(),
        checked: levels.iter().map(|findings| findings.checked).sum(),
        first: levels.into_iter().find_map(|findings| findings.first),
    }
}
