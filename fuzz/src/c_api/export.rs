//! Exports to callbacks that may stop them, and to paths that take none.

use super::super::bytes::Bytes;
use super::arguments::from_c;
use super::expect;
use super::handle::Handle;
use netmesh::capi::{nm_export, nm_export_write, nm_status};
use std::ffi::{CStr, c_void};
use std::ptr::{null, null_mut};

/// Returns the status of an export in a format if nothing else is wrong.
fn expected(handle: Option<&Handle>, format: i32) -> nm_status {
    let Some(handle) = handle else { return nm_status::NM_NULL_ARGUMENT };
    let (ok, invalid) = (nm_status::NM_OK, nm_status::NM_INVALID_ARGUMENT);
    let after_run = if handle.has_result { ok } else { nm_status::NM_STATE };
    match format {
        1 | 3 | 4 | 6 if handle.dim > 3 => invalid,
        1..=6 | 10 | 11 => after_run,
        7..=9 => ok,
        _ => invalid,
    }
}

/// Returns the number of a format, known or not.
fn format(bytes: &mut Bytes<'_>) -> i32 {
    match bytes.once_in(4) {
        true => i32::from(bytes.byte() as i8),
        false => [1, 2, 5, 7, 8, 3, 4, 6, 9, 10, 11][bytes.below(11)],
    }
}

/// Callback that counts its calls and stops at one of them.
struct Sink {
    calls: u32,
    stops_at: u32,
}

unsafe extern "C" fn receive(data: *const c_void, size: usize, user_data: *mut c_void) -> i32 {
    // SAFETY: the sink lives through the export.
    let sink = unsafe { &mut *user_data.cast::<Sink>() };
    assert!(!data.is_null() && size > 0);
    assert!(sink.stops_at == 0 || sink.calls < sink.stops_at, "called after it stopped");
    sink.calls += 1;
    i32::from(sink.calls == sink.stops_at)
}

pub fn export_write(bytes: &mut Bytes<'_>, handle: Option<&Handle>) {
    let format = format(bytes);
    let mesh = handle.map_or(null(), |handle| handle.mesh.cast_const());
    let expected = expected(handle, format);
    let mut sink = Sink { calls: 0, stops_at: bytes.below(3) as u32 };
    let user_data = (&raw mut sink).cast();
    // SAFETY: NULL or a live handle; the callback keeps to the rules.
    let status = unsafe { nm_export_write(mesh, from_c(format), Some(receive), user_data) };
    let stopped = sink.stops_at > 0 && sink.calls == sink.stops_at;
    expect(status, if stopped { nm_status::NM_IO } else { expected });
    assert!(expected == nm_status::NM_OK || sink.calls == 0, "wrote what it refused");
    // SAFETY: no callback is refused.
    let status = unsafe { nm_export_write(mesh, from_c(7), None, null_mut()) };
    expect(status, nm_status::NM_NULL_ARGUMENT);
}

pub fn export(bytes: &mut Bytes<'_>, handle: Option<&Handle>) {
    let format = format(bytes);
    let mesh = handle.map_or(null(), |handle| handle.mesh.cast_const());
    let expected = expected(handle, format);
    let invalid = nm_status::NM_INVALID_ARGUMENT;
    let (path, on_success): (Option<&CStr>, _) = match bytes.below(5) {
        0 => (None, nm_status::NM_NULL_ARGUMENT),
        1 => (Some(c""), invalid),
        2 => (Some(c"\xff.xyz"), invalid),
        3 => (Some(c"/no such directory/mesh"), nm_status::NM_IO),
        // A device is written as it is.
        _ if cfg!(unix) => (Some(c"/dev/null"), nm_status::NM_OK),
        _ => return,
    };
    let pointer = path.map_or(null(), CStr::as_ptr);
    // SAFETY: NULL or a live handle, NULL or a C string.
    let status = unsafe { nm_export(mesh, pointer, from_c(format)) };
    let bad_path =
        matches!(on_success, nm_status::NM_NULL_ARGUMENT | nm_status::NM_INVALID_ARGUMENT);
    let expected = match expected {
        nm_status::NM_NULL_ARGUMENT => expected,
        _ if bad_path => on_success,
        nm_status::NM_OK => on_success,
        refused => refused,
    };
    expect(status, expected);
}
