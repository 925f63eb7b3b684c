//! Options, and runs with them: good, refused and cancelled.

use super::super::bytes::Bytes;
use super::super::settings::Settings;
use super::arguments::{ROOM, Room, from_c, struct_size};
use super::handle::Handle;
use super::{expect, last_error};
use netmesh::capi::shared::encode;
use netmesh::capi::{
    nm_mesh, nm_mesh_get_points, nm_mesh_validate, nm_options, nm_options_init, nm_progress,
    nm_report, nm_run, nm_status,
};
use netmesh::{Algorithm, Options};
use std::ffi::c_void;
use std::mem::{offset_of, zeroed};
use std::ptr::{null, null_mut};

const SIZE: usize = size_of::<nm_options>();

/// Largest number of vertices of a run, small since sequences have many runs.
const MAX_VERTICES: u64 = 400;

/// Returns true if a struct of `size` bytes, the size of no version, counts as one of an older
/// version.
fn is_legal(size: usize) -> bool {
    (4..=ROOM).contains(&size) && (size >= SIZE || size % 8 == 0)
}

pub fn options_init(bytes: &mut Bytes<'_>) {
    let size = struct_size::<nm_options>(bytes);
    let mut room = Room::filled(0xee, 0xeeee_eeee);
    // SAFETY: the room has all sizes that are accepted.
    let status = unsafe { nm_options_init(room.pointer(), size) };
    let legal = is_legal(size as usize);
    expect(status, if legal { nm_status::NM_OK } else { nm_status::NM_INVALID_ARGUMENT });
    let end = if legal { size as usize } else { 0 };
    assert!(room.0[end..].iter().all(|&byte| byte == 0xee), "wrote beyond the struct");
    assert!(room.0[SIZE.min(end)..end].iter().all(|&byte| byte == 0), "the tail is not cleared");
    // SAFETY: NULL is refused.
    expect(unsafe { nm_options_init(null_mut(), size) }, nm_status::NM_NULL_ARGUMENT);
}

pub fn run(bytes: &mut Bytes<'_>, handle: Option<&mut Handle>) {
    let Some(handle) = handle else {
        // SAFETY: NULL is refused.
        expect(unsafe { nm_run(null_mut(), null()) }, nm_status::NM_NULL_ARGUMENT);
        return;
    };
    let before = handle.snapshot();
    let attempt = Attempt::new(bytes, handle.dim);
    let mut watch = Watch { mesh: handle.mesh, cancels: attempt.cancels, calls: 0 };
    let status = attempt.run(&mut watch);
    assert!(attempt.allows(status), "{status:?} {}: {:?}", last_error(), attempt.settings);
    assert!(!attempt.cancels || watch.calls <= 1, "called after it cancelled");
    if status == nm_status::NM_OK {
        handle.has_result = true;
        assert!(handle.counts().simplices > 0);
        check_certificate(handle);
    } else {
        assert_eq!(handle.snapshot(), before, "a failed run changed the mesh");
    }
}

/// Returns a size of the options with a limit. A struct that is accepted but lacks `max_vertices`
/// would run without one: it is made longer. One that has `progress` without `user_data` loses it.
fn with_limit(struct_size: u32) -> u32 {
    let shortest = offset_of!(nm_options, progress);
    match struct_size as usize {
        size if size <= offset_of!(nm_options, user_data) && is_legal(size) => shortest as u32,
        _ => struct_size,
    }
}

/// Arguments of a run.
struct Attempt {
    settings: Settings,
    /// Field and value of an enum that is to be wrong, if any.
    wrong: Option<(usize, i32)>,
    struct_size: u32,
    /// Byte beyond this version's struct.
    tail: u8,
    cancels: bool,
}

impl Attempt {
    fn new(bytes: &mut Bytes<'_>, dim: usize) -> Self {
        let mut settings = Settings::new(bytes, dim);
        let most = settings.options.max_vertices.min(MAX_VERTICES);
        settings.options.max_vertices = most;
        let wrong = bytes.once_in(8).then(|| (bytes.below(4), i32::from(bytes.byte() as i8)));
        Self {
            settings,
            wrong,
            struct_size: with_limit(struct_size::<nm_options>(bytes)),
            tail: if bytes.once_in(4) { bytes.byte() } else { 0 },
            cancels: bytes.once_in(6),
        }
    }

    fn run(&self, watch: &mut Watch) -> nm_status {
        let mut room = Room::filled(0, self.struct_size);
        room.0[ROOM - 1] = self.tail;
        // A struct that lacks the last fields runs without a callback.
        let options = self.options(watch);
        // SAFETY: the room is larger than the struct, and what `struct_size` says is in it.
        unsafe {
            room.pointer::<nm_options>().write(options);
            nm_run(watch.mesh, room.pointer())
        }
    }

    fn options(&self, watch: &mut Watch) -> nm_options {
        let Options { output, algorithm, ordering, criterion, .. } = self.settings.options;
        let mut enums = [output as i32, algorithm as i32, ordering as i32, criterion as i32];
        if let Some((field, value)) = self.wrong {
            enums[field] = value;
        }
        nm_options {
            struct_size: self.struct_size,
            output: from_c(enums[0]),
            algorithm: from_c(enums[1]),
            ordering: from_c(enums[2]),
            criterion: from_c(enums[3]),
            progress: Some(look),
            user_data: (&raw mut *watch).cast(),
            ..encode(&self.settings.options)
        }
    }

    /// Returns true if the run may answer `status`: invalid arguments are refused, and no others.
    fn allows(&self, status: nm_status) -> bool {
        let size = self.struct_size as usize;
        let tail = size == ROOM && self.tail != 0;
        if !is_legal(size) || tail {
            return status == nm_status::NM_INVALID_ARGUMENT;
        }
        match status {
            nm_status::NM_OK => self.may_succeed(),
            nm_status::NM_INVALID_ARGUMENT => !self.settings.valid || self.wrong.is_some(),
            nm_status::NM_CANCELLED => self.cancels,
            nm_status::NM_DEGENERATE_INPUT => {
                self.settings.options.algorithm == Algorithm::Delaunay || self.wrong.is_some()
            }
            nm_status::NM_LIMIT => true,
            _ => false,
        }
    }

    fn may_succeed(&self) -> bool {
        let known = [2, 3, 2, 2];
        let enums = self.wrong.is_none_or(|(field, value)| (0..known[field]).contains(&value));
        // A criterion that is not the settings' has other ranges, and a small struct lacks fields.
        let size = self.struct_size as usize;
        let calls = size >= offset_of!(nm_options, ordering);
        let checked = self.settings.valid || self.wrong.is_some() || size < SIZE;
        enums && checked && !(self.cancels && calls)
    }
}

/// State of the progress callback.
struct Watch {
    mesh: *mut nm_mesh,
    cancels: bool,
    calls: u32,
}

unsafe extern "C" fn look(progress: *const nm_progress, user_data: *mut c_void) -> i32 {
    // SAFETY: both are live during the call; the run does not use the watch.
    let (progress, watch) = unsafe { (&*progress, &mut *user_data.cast::<Watch>()) };
    watch.calls += 1;
    assert_eq!(progress.struct_size as usize, size_of::<nm_progress>());
    assert!(progress.fraction <= 1.0);
    let mut needed = 0;
    // SAFETY: a live handle that is being run, which is refused.
    let status = unsafe { nm_mesh_get_points(watch.mesh, null_mut(), 0, &mut needed) };
    assert_eq!((status, needed), (nm_status::NM_STATE, 0));
    i32::from(watch.cancels)
}

fn check_certificate(handle: &Handle) {
    // SAFETY: numbers only.
    let mut report: nm_report = unsafe { zeroed() };
    report.struct_size = size_of::<nm_report>() as u32;
    // SAFETY: a live handle and a whole struct.
    expect(unsafe { nm_mesh_validate(handle.mesh, 3, &mut report) }, nm_status::NM_OK);
    let message: String = report.message.iter().map(|&c| c as u8 as char).collect();
    assert_eq!((report.level, report.violations), (3, 0), "{message}");
}
