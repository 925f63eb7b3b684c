//! The certificate.

use super::run::{handle, nm_mpi_mesh};
use super::structs::nm_mpi_report;
use crate::certificate::{Report, ViolationKind, validate};
use crate::comm::Communicator;
use crate::distributed::NO_ID;
use netmesh::NONE;
use netmesh::capi::nm_status;
use netmesh::capi::shared::{OutStruct, barrier};
use std::ffi::c_char;

/// Checks the mesh of all ranks from the coordinates, simplices and ghosts that they have alone,
/// independently of the code that made it and with exact signs. Collective. NM_OK means that the
/// check ran; what it found is in report, the same on all ranks.
///
/// level, the same on all ranks: 1 topology (ids; neighbours share the facets that they name,
/// across ranks too; a ghost is what its owner has, and none is missing; all ranks have the same of
/// a vertex and of a domain; stars, links, Euler characteristic, sizes of the whole); 2 also
/// geometry (orientations, Delaunay on every facet and convexity at every hull ridge, whichever
/// ranks are on the two sides); 3 also the promises (inputs kept bit for bit, duplicates with the
/// first of them, kinds, the tree of domains, cages complete, where they should be and not
/// encroached, a finished mesh of one domain, the quality bound of the run). A mesh is right if
/// report->level equals level, or equivalently report->violations is 0.
///
/// Not checked, of what nm_mesh_validate checks: windings round faces of codimension two; that
/// balls beside each other are disjoint, where encroachment is below 2 epsilon (elsewhere it
/// follows); cells at edges of at most 2^-40 of the largest coordinate there, simplices of several
/// domains, and cells where epsilon is above 0.8 cage_scale in meshes of several domains.
///
/// report: of the rank; the caller sets struct_size.
///
/// Errors, the same on all ranks: NM_NULL_ARGUMENT (mesh, report), NM_INVALID_ARGUMENT (level, also
/// where it differs between ranks; report->struct_size), NM_OUT_OF_MEMORY, NM_IO (MPI failed),
/// NM_STATE (an earlier call on the mesh has failed), NM_PANIC.
///
/// A NULL for mesh is told to this rank alone: without it there is nothing to talk through.
///
/// O(local_vertices + (local_simplices + ghosts) log) on each rank.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mpi_validate(
    mesh: *const nm_mpi_mesh,
    level: u32,
    report: *mut nm_mpi_report,
) -> nm_status {
    barrier(|| {
        // SAFETY: the caller gave NULL or a live handle.
        let handle = unsafe { handle(mesh)? };
        let comm = handle.comm.again();
        // No word to the others before the call is compared with theirs.
        // SAFETY: the caller gave NULL or as many bytes as the `struct_size` says.
        let out = unsafe { OutStruct::new("report", report) };
        let out = out.map_err(|error| comm.fail(error))?;
        out.write(&encode(&validate(&comm, &handle.mesh, level)?));
        Ok(())
    })
}

fn encode(report: &Report) -> nm_mpi_report {
    let first = report.first.as_ref();
    let mut message = [0; 160];
    // At most 159 bytes, so one is left for the NUL.
    let text = first.map_or("", |violation| &violation.message);
    for (to, from) in message[..159].iter_mut().zip(text.bytes()) {
        *to = from as c_char;
    }
    nm_mpi_report {
        struct_size: size_of::<nm_mpi_report>() as u32,
        level: report.level,
        violations: report.violations,
        checked: report.checked,
        kind: first.map_or(ViolationKind::None, |violation| violation.kind),
        rank: first.map_or(NONE, |violation| violation.rank as u32),
        simplex: first.map_or(NO_ID, |violation| violation.simplex),
        vertex: first.map_or(NO_ID, |violation| violation.vertex),
        message,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::Violation;

    #[test]
    fn reports_reach_c() {
        let clean = encode(&Report { level: 3, checked: 9, ..Report::default() });
        assert_eq!((clean.level, clean.checked, clean.violations), (3, 9, 0));
        assert_eq!((clean.kind as i32, clean.rank, clean.message[0]), (0, NONE, 0));
        let violation = Violation::new(ViolationKind::Ghost, 2, "g".repeat(300)).simplex(1 << 40);
        let broken = Report { violations: 1, first: Some(violation), ..Report::default() };
        let broken = encode(&broken);
        assert_eq!((broken.kind as i32, broken.rank), (54, 2));
        assert_eq!((broken.simplex, broken.vertex), (1 << 40, NO_ID));
        assert_eq!(broken.message[158..], [b'g' as c_char, 0]);
    }
}
