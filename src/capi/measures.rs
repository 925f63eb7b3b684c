//! Quality, statistics and the certificate.

use super::enums::nm_status;
use super::error::prefix;
use super::getters::result;
use super::handle::{nm_mesh, with_mesh};
use super::memory::OutStruct;
use super::structs::{nm_quality, nm_report, nm_stats};
use crate::mesh::{Mesh, NONE, Stats};
use crate::quality::{Quality, measure};
use crate::validate::{Report, validate};
use std::ffi::c_char;

/// Measures the quality of the mesh. O(vertices + simplices).
///
/// quality: the caller sets struct_size.
///
/// Errors: NM_NULL_ARGUMENT (mesh, quality), NM_INVALID_ARGUMENT (quality->struct_size), NM_STATE (no
/// result yet, nm_run at work, poisoned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_quality(
    mesh: *const nm_mesh,
    quality: *mut nm_quality,
) -> nm_status {
    let body = |mesh: &Mesh| {
        // SAFETY: the caller gave NULL or as many bytes as the `struct_size` says.
        let out = unsafe { OutStruct::new("quality", quality)? };
        out.write(&encode_quality(&measure(result(mesh)?)));
        Ok(())
    };
    // SAFETY: the caller gave NULL or a live handle.
    unsafe { with_mesh(mesh, body) }
}

/// Writes what the last nm_run did. O(1).
///
/// stats: the caller sets struct_size.
///
/// Errors: NM_NULL_ARGUMENT (mesh, stats), NM_INVALID_ARGUMENT (stats->struct_size), NM_STATE (no
/// result yet, nm_run at work, poisoned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_stats(mesh: *const nm_mesh, stats: *mut nm_stats) -> nm_status {
    let body = |mesh: &Mesh| {
        // SAFETY: the caller gave NULL or as many bytes as the `struct_size` says.
        let out = unsafe { OutStruct::new("stats", stats)? };
        out.write(&encode_stats(&result(mesh)?.stats));
        Ok(())
    };
    // SAFETY: the caller gave NULL or a live handle.
    unsafe { with_mesh(mesh, body) }
}

/// Checks the mesh from its coordinates and simplices alone, independently of the code that built it
/// and with exact arithmetic. NM_OK means that the check ran; what it found is in report.
///
/// level: 1 topology (ids, adjacency, facets, Euler characteristic, links); 2 also geometry
/// (orientations, convex hull, Delaunay on every facet); 3 also the promises (inputs kept bit for
/// bit, tree of disjoint domains, cages not encroached, quality). A mesh is right if report->level
/// equals level, or equivalently report->violations is 0.
///
/// report: the caller sets struct_size.
///
/// Errors: NM_NULL_ARGUMENT (mesh, report), NM_INVALID_ARGUMENT (level, report->struct_size),
/// NM_OUT_OF_MEMORY, NM_STATE (no result yet, nm_run at work, poisoned).
///
/// O(vertices + simplices) for a mesh of bounded degree.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_validate(
    mesh: *const nm_mesh,
    level: u32,
    report: *mut nm_report,
) -> nm_status {
    let body = |mesh: &Mesh| {
        // SAFETY: the caller gave NULL or as many bytes as the `struct_size` says.
        let out = unsafe { OutStruct::new("report", report)? };
        out.write(&encode_report(&validate(mesh.inputs(), result(mesh)?, level)?));
        Ok(())
    };
    // SAFETY: the caller gave NULL or a live handle.
    unsafe { with_mesh(mesh, body) }
}

fn encode_quality(quality: &Quality) -> nm_quality {
    nm_quality {
        struct_size: size_of::<nm_quality>() as u32,
        max_degree: quality.max_degree,
        worst_aspect: quality.worst_aspect,
        worst_aspect_anywhere: quality.worst_aspect_anywhere,
        mean_aspect: quality.mean_aspect,
        worst_cage_aspect: quality.worst_cage_aspect,
        worst_radius_edge: quality.worst_radius_edge,
        min_angle_degrees: quality.min_angle_degrees,
        precision_limited: quality.precision_limited,
    }
}

fn encode_stats(stats: &Stats) -> nm_stats {
    nm_stats {
        struct_size: size_of::<nm_stats>() as u32,
        reserved: 0,
        rounds: stats.rounds,
        touches: stats.touches,
        max_touches: stats.max_touches,
        input_vertices: stats.input_vertices,
        steiner_vertices: stats.steiner_vertices,
        cage_vertices: stats.cage_vertices,
        cages_created: stats.cages_created,
        cages_grown: stats.cages_grown,
        cages_released: stats.cages_released,
        exact_fallbacks: stats.exact_fallbacks,
        precision_limited: stats.precision_limited,
        seconds: stats.seconds,
    }
}

fn encode_report(report: &Report) -> nm_report {
    let first = report.first.as_ref();
    let mut message = [0; 160];
    let text = prefix(first.map_or("", |violation| &violation.message), message.len() - 1);
    for (to, from) in message.iter_mut().zip(text.bytes()) {
        *to = from as c_char;
    }
    nm_report {
        struct_size: size_of::<nm_report>() as u32,
        level: report.level,
        violations: report.violations,
        checked: report.checked,
        kind: first.map_or(0, |violation| violation.kind as u32),
        simplex: first.map_or(NONE, |violation| violation.simplex),
        vertex: first.map_or(NONE, |violation| violation.vertex),
        domain: first.map_or(NONE, |violation| violation.domain),
        message,
    }
}
