//! Structs that the library fills, of any size, and histograms.

use super::super::bytes::Bytes;
use super::arguments::{ROOM, Room, from_c, struct_size};
use super::expect;
use super::handle::Handle;
use netmesh::capi::{
    nm_counts, nm_left_out, nm_mesh, nm_mesh_counts, nm_mesh_left_out, nm_mesh_quality,
    nm_mesh_quality_histogram, nm_mesh_stats, nm_mesh_validate, nm_quality, nm_report, nm_stats,
    nm_status,
};
use std::ptr::{null, null_mut};

pub fn measure(bytes: &mut Bytes<'_>, handle: Option<&Handle>) {
    if bytes.once_in(4) {
        return count(bytes, handle);
    }
    let mut call = Call { bytes, handle, needs_result: true };
    match call.bytes.below(4) {
        0 => {
            call.needs_result = false;
            // SAFETY: as below.
            call.check(true, |mesh, out: *mut nm_left_out| unsafe { nm_mesh_left_out(mesh, out) });
            // SAFETY: `check` passes what the function asks for.
            call.check(true, |mesh, out: *mut nm_counts| unsafe { nm_mesh_counts(mesh, out) });
        }
        // SAFETY: as above.
        1 => call.check(true, |mesh, out: *mut nm_quality| unsafe { nm_mesh_quality(mesh, out) }),
        // SAFETY: as above.
        2 => call.check(true, |mesh, out: *mut nm_stats| unsafe { nm_mesh_stats(mesh, out) }),
        _ => {
            let level = call.bytes.below(6) as u32;
            call.check((1..=3).contains(&level), |mesh, out: *mut nm_report| {
                // SAFETY: as above.
                unsafe { nm_mesh_validate(mesh, level, out) }
            });
        }
    }
}

/// Counts values of any measure between edges that may ascend or not.
fn count(bytes: &mut Bytes<'_>, handle: Option<&Handle>) {
    let mesh = handle.map_or(null(), |handle| handle.mesh.cast_const());
    let (measure, at_hull) = (bytes.small() as i32 % 6, bytes.below(3) as u32);
    let edges: Vec<f64> = (0..bytes.below(5)).map(|_| bytes.double()).collect();
    let mut counts = vec![u64::MAX; edges.len() + 1];
    let mut extremes = [0.0; 2];
    // SAFETY: arrays as long as is said.
    let status = unsafe {
        let (out, extremes) = (counts.as_mut_ptr(), extremes.as_mut_ptr());
        let (count, edges) = (edges.len() as u64, edges.as_ptr());
        nm_mesh_quality_histogram(mesh, from_c(measure), at_hull, count, edges, out, extremes)
    };
    let ascend =
        edges.windows(2).all(|pair| pair[0] < pair[1]) && !edges.iter().any(|x| x.is_nan());
    let good = (0..4).contains(&measure) && at_hull < 2;
    match handle {
        None => expect(status, nm_status::NM_NULL_ARGUMENT),
        Some(_) if !good => expect(status, nm_status::NM_INVALID_ARGUMENT),
        Some(handle) if !handle.has_result => expect(status, nm_status::NM_STATE),
        Some(_) if edges.is_empty() || !ascend => expect(status, nm_status::NM_INVALID_ARGUMENT),
        Some(_) => expect(status, nm_status::NM_OK),
    }
    let is_written = counts.iter().all(|&count| count != u64::MAX);
    assert_eq!(is_written, status == nm_status::NM_OK, "counts are written on success only");
}

struct Call<'a, 'b> {
    bytes: &'a mut Bytes<'b>,
    handle: Option<&'a Handle>,
    needs_result: bool,
}

impl Call<'_, '_> {
    /// Calls with a struct of some size; `good` is true if the other arguments are valid.
    fn check<T>(&mut self, good: bool, call: impl Fn(*const nm_mesh, *mut T) -> nm_status) {
        let mesh = self.handle.map_or(null(), |handle| handle.mesh.cast_const());
        expect(call(mesh, null_mut()), nm_status::NM_NULL_ARGUMENT);
        let struct_size = struct_size::<T>(self.bytes);
        let mut room = Room::filled(0xee, struct_size);
        let size = struct_size as usize;
        let legal = (4..=ROOM).contains(&size);
        let status = call(mesh, room.pointer());
        match self.handle {
            None => expect(status, nm_status::NM_NULL_ARGUMENT),
            Some(_) if !legal => expect(status, nm_status::NM_INVALID_ARGUMENT),
            Some(handle) if self.needs_result && !handle.has_result => {
                expect(status, nm_status::NM_STATE);
            }
            Some(_) if !good => expect(status, nm_status::NM_INVALID_ARGUMENT),
            Some(_) => expect(status, nm_status::NM_OK),
        }
        assert_eq!(room.0[..4], struct_size.to_ne_bytes(), "struct_size changed");
        let written = status == nm_status::NM_OK;
        let end = if written { size.min(size_of::<T>()) } else { 4 };
        assert!(room.0[end..].iter().all(|&byte| byte == 0xee), "wrote beyond the struct");
    }
}
