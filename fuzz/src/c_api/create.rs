//! Calls that make handles, or are refused.

use super::super::bytes::Bytes;
use super::super::families;
use super::arguments::from_c;
use super::expect;
use super::handle::Handle;
use netmesh::capi::{nm_mesh, nm_mesh_create, nm_mesh_create_from_file, nm_mesh_free, nm_status};
use std::ffi::CStr;
use std::ptr::{null, null_mut};

/// Makes a handle of good points, and replaces the one in the slot.
pub fn create(bytes: &mut Bytes<'_>, slot: &mut Option<Handle>) {
    let dim = [2, 2, 3, 3, 3, 4, 2, 5][bytes.below(8)];
    let count = 2 + bytes.below(9);
    let gap = bytes.below(3);
    let mut points = families::points(bytes, dim, count);
    // Two points are distinct in any case: one has what none of the others can.
    let apart = if points[..dim].iter().all(|x| *x == 1.5) { -1.5 } else { 1.5 };
    points[(count - 1) * dim..].fill(apart);
    let stride = if gap == 0 { 0 } else { dim + gap };
    let spaced = spread(&points, dim, stride.max(dim));
    let mut mesh = null_mut();
    // SAFETY: the points are as many as is said.
    let status = unsafe { nm_mesh_create(dim as u32, count, spaced.as_ptr(), stride, &mut mesh) };
    expect(status, nm_status::NM_OK);
    assert!(!mesh.is_null());
    *slot = Some(Handle { mesh, dim, has_result: false });
}

/// Returns the points `stride` apart, with NaN between them.
fn spread(points: &[f64], dim: usize, stride: usize) -> Vec<f64> {
    let mut spaced = Vec::new();
    for point in points.chunks_exact(dim) {
        spaced.extend_from_slice(point);
        spaced.resize(spaced.len() + stride - dim, f64::NAN);
    }
    spaced
}

/// Calls with arguments that are wrong in one way.
pub fn create_refused(bytes: &mut Bytes<'_>) {
    let mut points = [0.0, 0.0, 1.0, 0.0, 0.0, 1.0];
    let good = points.as_ptr();
    let big = bytes.word() as usize;
    let (dim, n, pointer, stride, expected) = match bytes.below(9) {
        0 => (2, 3, null(), 0, nm_status::NM_NULL_ARGUMENT),
        1 => ((bytes.byte() as u32).wrapping_sub(200).max(9), 1, good, 0, nm_status::NM_DIMENSION),
        2 => (bytes.below(2) as u32, 3, good, 0, nm_status::NM_DIMENSION),
        3 => (3, 2, good, 1 + bytes.below(2), nm_status::NM_INVALID_ARGUMENT),
        4 => (2, big.max(1 << 32), good, 2, nm_status::NM_CAPACITY),
        5 => (2, 3, good, big.max(1 << 61), nm_status::NM_INVALID_ARGUMENT),
        6 => {
            let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY][bytes.below(3)];
            points[bytes.below(6)] = bad;
            (2, 3, points.as_ptr(), 0, nm_status::NM_NON_FINITE)
        }
        7 => (2, bytes.below(2), good, 0, nm_status::NM_DEGENERATE_INPUT),
        _ => {
            points = [-0.0, 0.0, 0.0, -0.0, 0.0, 0.0];
            (2, 3, points.as_ptr(), 0, nm_status::NM_DEGENERATE_INPUT)
        }
    };
    let mut mesh: *mut nm_mesh = std::ptr::dangling_mut();
    // SAFETY: the points are as many as is said, or the sizes are refused unread.
    let status = unsafe { nm_mesh_create(dim, n, pointer, stride, &mut mesh) };
    expect(status, expected);
    assert!(mesh.is_null(), "a refused handle");
    // SAFETY: NULL is refused.
    let status = unsafe { nm_mesh_create(dim, n, pointer, stride, null_mut()) };
    expect(status, nm_status::NM_NULL_ARGUMENT);
}

/// Calls with paths of no readable file.
pub fn create_from_file(bytes: &mut Bytes<'_>) {
    let invalid = nm_status::NM_INVALID_ARGUMENT;
    let format = i32::from(bytes.byte() as i8);
    let readable = matches!(format, 2..=9 | 12..=17);
    let (path, expected): (&CStr, _) = match bytes.below(5) {
        0 => (c"", invalid),
        1 => (c"\xff.xyz", invalid),
        2 => (c"no extension", if readable { nm_status::NM_IO } else { invalid }),
        3 => {
            let known = readable || format == 0;
            (c"/no such directory/points.xyz", if known { nm_status::NM_IO } else { invalid })
        }
        _ if cfg!(unix) => {
            (c"/dev/null", if readable { nm_status::NM_FORMAT_ERROR } else { invalid })
        }
        _ => return,
    };
    let mut mesh: *mut nm_mesh = std::ptr::dangling_mut();
    // SAFETY: a C string.
    let status = unsafe { nm_mesh_create_from_file(path.as_ptr(), from_c(format), &mut mesh) };
    expect(status, expected);
    assert!(mesh.is_null());
    // SAFETY: NULL is refused, or allowed.
    unsafe {
        let status = nm_mesh_create_from_file(null(), from_c(7), &mut mesh);
        expect(status, nm_status::NM_NULL_ARGUMENT);
        nm_mesh_free(mesh);
    }
}
