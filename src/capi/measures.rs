//! Quality, statistics and the certificate.

use super::enums::nm_status;
use super::error::prefix;
use super::getters::result;
use super::handle::{nm_mesh, with_mesh};
use super::memory::OutStruct;
use super::structs::{nm_quality, nm_report, nm_stats};
use crate::mesh::{Mesh, NONE, Stats};
use crate::quality::{Quality, measure};
use crate::validate::{Report, ViolationKind, validate_mesh};
use std::ffi::c_char;

/// Measures the quality of the mesh. O(vertices + simplices).
///
/// quality: the caller sets struct_size.
///
/// Errors: NM_NULL_ARGUMENT (mesh, quality), NM_INVALID_ARGUMENT (quality->struct_size), NM_STATE
/// (no result yet, nm_run at work, poisoned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_quality(
    mesh: *const nm_mesh,
    quality: *mut nm_quality,
) -> nm_status {
    let body = |mesh: &Mesh| {
        // SAFETY: the caller gave NULL or as many bytes as the `struct_size` says.
        let out = unsafe { OutStruct::new("quality", quality)? };
        out.write(&encode_quality(&measure(result(mesh)?)?));
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

/// Checks the mesh from its coordinates and simplices alone, independently of the code that built
/// it and with exact arithmetic. NM_OK means that the check ran; what it found is in report.
///
/// level: 1 topology (ids, adjacency, facets, Euler characteristic, links); 2 also geometry
/// (orientations, convex hull, Delaunay on every facet); 3 also the promises (inputs kept bit for
/// bit, tree of disjoint domains, cages not encroached, quality). A mesh is right if report->level
/// equals level, or equivalently report->violations is 0.
///
/// With segments: 1 also that the arrays of segments, regions and a domain that is cut out fit; 2
/// also that subsegments are Gabriel edges, lead from end to end of every segment, and have no
/// vertex farther from it than rounding makes it; 3 also that regions are what segments separate,
/// with the labels and holes of nm_mesh_set_regions and exact areas, and that small angles between
/// segments force the simplices that the quality is not promised for. The segments and regions are
/// those of the last run.
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
        result(mesh)?; // Says what is missing in C's words.
        out.write(&encode_report(&validate_mesh(mesh, level)?));
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
        below_min_dihedral: quality.below_min_dihedral,
        below_min_dihedral_between_domains: quality.below_min_dihedral_between_domains,
        beyond_bound: quality.beyond_bound,
        forced: quality.forced,
        least_forced_angle_degrees: quality.least_forced_angle_degrees,
        below_min_angle: quality.below_min_angle,
        flat: quality.flat,
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
        passes: stats.passes,
        worst_halving: stats.worst_halving,
        cage_points: stats.cage_points,
        far_corners: stats.far_corners,
        off_centers: stats.off_centers,
        yields: stats.yields,
        closing_points: stats.closing_points,
        near_inputs: stats.near_inputs,
        farthest_near_input: stats.farthest_near_input,
        ply_probes: stats.ply_probes,
        max_ply: stats.max_ply,
        mean_ply: stats.mean_ply,
        max_ball_intersections: stats.max_ball_intersections,
        mean_ball_intersections: stats.mean_ball_intersections,
        feature_size_constant: stats.feature_size_constant,
        insertion_constant_input: stats.insertion_constant_input,
        insertion_constant_corner: stats.insertion_constant_corner,
        insertion_constant_cage: stats.insertion_constant_cage,
    }
}

pub(super) fn encode_report(report: &Report) -> nm_report {
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
        kind: first.map_or(ViolationKind::None, |violation| violation.kind),
        simplex: first.map_or(NONE, |violation| violation.simplex),
        vertex: first.map_or(NONE, |violation| violation.vertex),
        domain: first.map_or(NONE, |violation| violation.domain),
        message,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capi::test_support::{last_message, square};
    use crate::validate::Violation;
    use std::ffi::CStr;
    use std::ptr::null_mut;

    fn report(message: &str) -> Report {
        let first = Violation {
            kind: ViolationKind::Delaunay,
            simplex: 3,
            vertex: 4,
            domain: NONE,
            message: message.to_owned().into(),
        };
        Report { level: 1, violations: 2, checked: 30, first: Some(first) }
    }

    fn message(report: &nm_report) -> String {
        // SAFETY: the message ends with a NUL; the test would read past it only if it did not.
        let message = unsafe { CStr::from_ptr(report.message.as_ptr()) };
        message.to_str().expect("messages are UTF-8").to_owned()
    }

    #[test]
    fn a_report_carries_the_first_violation() {
        let encoded = encode_report(&report("facet 1 of simplex 3"));
        let ids = (encoded.kind, encoded.simplex, encoded.vertex, encoded.domain);
        assert_eq!(ids, (ViolationKind::Delaunay, 3, 4, NONE));
        assert_eq!((encoded.level, encoded.violations, encoded.checked), (1, 2, 30));
        assert_eq!(message(&encoded), "facet 1 of simplex 3");
        let clean = encode_report(&Report { level: 3, violations: 0, checked: 9, first: None });
        let ids = (clean.kind, clean.simplex, clean.vertex, clean.domain);
        assert_eq!(ids, (ViolationKind::None, NONE, NONE, NONE));
        assert_eq!(clean.message, [0; 160]);
    }

    #[test]
    fn a_long_message_is_cut_between_characters() {
        let long = "é".repeat(100);
        assert_eq!(message(&encode_report(&report(&long))), "é".repeat(79));
        let longest = "x".repeat(159);
        assert_eq!(message(&encode_report(&report(&longest))), longest);
    }

    #[test]
    fn statistics_stand_in_their_fields() {
        let stats = Stats {
            rounds: 1,
            touches: 2,
            max_touches: 3,
            input_vertices: 4,
            steiner_vertices: 5,
            cage_vertices: 6,
            cages_created: 7,
            cages_grown: 8,
            cages_released: 9,
            exact_fallbacks: 10,
            precision_limited: 11,
            seconds: 12.0,
            passes: 13,
            worst_halving: 14.0,
            cage_points: 15,
            far_corners: 16,
            off_centers: 17,
            yields: 18,
            closing_points: 19,
            near_inputs: 20,
            farthest_near_input: 21.0,
            ply_probes: 22,
            max_ply: 23,
            mean_ply: 24.0,
            max_ball_intersections: 25,
            mean_ball_intersections: 26.0,
            feature_size_constant: 27.0,
            insertion_constant_input: 28.0,
            insertion_constant_corner: 29.0,
            insertion_constant_cage: 30.0,
            simplices_created: 31,
            segment_points: 32,
        };
        // SAFETY: numbers without padding.
        let words: [u64; 31] = unsafe { std::mem::transmute(encode_stats(&stats)) };
        for (at, &word) in words.iter().enumerate().skip(1) {
            let is_double = [12, 14, 21, 24].contains(&at) || (26..31).contains(&at);
            let expected = if is_double { (at as f64).to_bits() } else { at as u64 };
            assert_eq!(word, expected, "word {at}");
        }
    }

    #[test]
    fn qualities_stand_in_their_fields() {
        let quality = Quality {
            max_degree: 1,
            worst_aspect: 2.0,
            worst_aspect_anywhere: 3.0,
            mean_aspect: 4.0,
            worst_cage_aspect: 5.0,
            worst_radius_edge: 6.0,
            min_angle_degrees: 7.0,
            precision_limited: 8,
            below_min_dihedral: 9,
            below_min_dihedral_between_domains: 10,
            beyond_bound: 11,
            forced: 12,
            least_forced_angle_degrees: 13.0,
            below_min_angle: 14,
            flat: 15,
        };
        let encoded = encode_quality(&quality);
        // SAFETY: numbers without padding.
        let words: [u64; 15] = unsafe { std::mem::transmute(encoded) };
        let doubles = [2.0, 3.0, 4.0, 5.0, 6.0, 7.0].map(f64::to_bits);
        assert_eq!((encoded.max_degree, &words[1..7]), (1, &doubles[..]));
        assert_eq!(words[7..], [8, 9, 10, 11, 12, 13f64.to_bits(), 14, 15]);
    }

    #[test]
    fn measures_need_a_run_and_a_struct() {
        let mesh = square();
        // SAFETY: a live handle; NULL is allowed.
        let statuses = unsafe {
            [
                nm_mesh_quality(&mesh, null_mut()),
                nm_mesh_stats(&mesh, null_mut()),
                nm_mesh_validate(&mesh, 1, null_mut()),
            ]
        };
        assert_eq!(statuses, [nm_status::NM_NULL_ARGUMENT; 3]);
        assert_eq!(last_message(), "report is NULL");
        let mut quality = encode_quality(&Quality::default());
        let mut stats = encode_stats(&Stats::default());
        let mut found = encode_report(&report(""));
        let before = (quality, stats, found);
        // SAFETY: a live handle and whole structs.
        let statuses = unsafe {
            [
                nm_mesh_quality(&mesh, &mut quality),
                nm_mesh_stats(&mesh, &mut stats),
                nm_mesh_validate(&mesh, 1, &mut found),
            ]
        };
        assert_eq!(statuses, [nm_status::NM_STATE; 3]);
        assert_eq!((quality, stats, found), before);
    }
}
