//! The handle: a mesh, a lock that never waits, and the barrier round every entry, which no panic
//! and no floating-point environment passes.

use super::enums::nm_status;
use super::environment::Environment;
use super::error::{fail, null_argument, panicked};
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::Mesh;
use crate::prepared::Prepared;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{RwLock, RwLockReadGuard, RwLockWriteGuard, TryLockError};

/// Points, and after nm_run their mesh. Made by nm_mesh_create and its like, freed by nm_mesh_free.
/// Functions that take a `const nm_mesh *` may run on one handle at the same time from any threads;
/// nm_run needs the handle for itself, which is checked: the call that comes too early (a getter
/// during nm_run, nm_run during a getter) answers NM_STATE and does nothing.
#[allow(non_camel_case_types)]
pub struct nm_mesh {
    held: RwLock<Held>,
    poisoned: AtomicBool,
}

/// A mesh, and what queries of its result have made.
struct Held {
    mesh: Mesh,
    prepared: Prepared,
}

impl nm_mesh {
    pub(super) fn new(mesh: Mesh) -> Self {
        let held = Held { mesh, prepared: Prepared::default() };
        Self { held: RwLock::new(held), poisoned: AtomicBool::new(false) }
    }

    /// Returns the mesh for reading, beside other readers.
    fn read(&self) -> Result<RwLockReadGuard<'_, Held>> {
        self.check_poison()?;
        self.held.try_read().map_err(|error| match error {
            TryLockError::Poisoned(_) => poisoned(),
            TryLockError::WouldBlock => {
                let message =
                    "mesh: nm_run is at work on it; nothing else may use it until it returns";
                Error::new(ErrorKind::State, message)
            }
        })
    }

    /// Returns the mesh for this call alone.
    fn write(&self) -> Result<RwLockWriteGuard<'_, Held>> {
        self.check_poison()?;
        self.held.try_write().map_err(|error| match error {
            TryLockError::Poisoned(_) => poisoned(),
            TryLockError::WouldBlock => {
                let message = "mesh: another call is using it; nm_run needs it alone";
                Error::new(ErrorKind::State, message)
            }
        })
    }

    fn check_poison(&self) -> Result<()> {
        if self.poisoned.load(Ordering::Acquire) { Err(poisoned()) } else { Ok(()) }
    }
}

fn poisoned() -> Error {
    let message = "mesh: an earlier call answered NM_PANIC; only nm_mesh_free may follow";
    Error::new(ErrorKind::State, message)
}

/// Runs `body` in the default floating-point environment, so that no panic leaves it, and answers
/// its status. The caller's environment is restored.
pub fn barrier(body: impl FnOnce() -> Result<()>) -> nm_status {
    match Environment::DEFAULT.run(|| catch_unwind(AssertUnwindSafe(body))) {
        Ok(Ok(())) => nm_status::NM_OK,
        Ok(Err(error)) => fail(&error),
        Err(payload) => fail(&panicked(&*payload)),
    }
}

/// Runs `body` within a [`barrier`] on the mesh, for reading; a panic poisons the handle.
///
/// # Safety
/// `mesh` is NULL or a live handle that no thread frees during the call.
pub(super) unsafe fn with_mesh(
    mesh: *const nm_mesh,
    body: impl FnOnce(&Mesh) -> Result<()>,
) -> nm_status {
    // SAFETY: the caller's promise.
    unsafe { with_handle(mesh, |handle| body(&handle.read()?.mesh)) }
}

/// Runs `body` as [`with_mesh`] does, with what queries have made as well.
///
/// # Safety
/// The handle is as [`with_mesh`] demands.
pub(super) unsafe fn with_prepared(
    mesh: *const nm_mesh,
    body: impl FnOnce(&Mesh, &Prepared) -> Result<()>,
) -> nm_status {
    // SAFETY: the caller's promise.
    unsafe {
        with_handle(mesh, |handle| {
            let held = handle.read()?;
            body(&held.mesh, &held.prepared)
        })
    }
}

/// Runs `body` as [`with_prepared`] does, for writing.
///
/// # Safety
/// The handle is as [`with_mesh`] demands.
pub(super) unsafe fn with_prepared_mut(
    mesh: *const nm_mesh,
    body: impl FnOnce(&mut Mesh, &mut Prepared) -> Result<()>,
) -> nm_status {
    // SAFETY: the caller's promise.
    unsafe {
        with_handle(mesh, |handle| {
            let held = &mut *handle.write()?;
            body(&mut held.mesh, &mut held.prepared)
        })
    }
}

/// Runs `body` as [`with_mesh`] does, for writing. What queries have made is dropped unless the
/// body fails.
///
/// # Safety
/// The handle is as [`with_mesh`] demands.
pub(super) unsafe fn with_mesh_mut(
    mesh: *const nm_mesh,
    body: impl FnOnce(&mut Mesh) -> Result<()>,
) -> nm_status {
    let body = |mesh: &mut Mesh, prepared: &mut Prepared| {
        body(mesh)?;
        *prepared = Prepared::default();
        Ok(())
    };
    // SAFETY: the caller's promise.
    unsafe { with_prepared_mut(mesh, body) }
}

/// Runs `body` as [`with_prepared_mut`] does, with another mesh for reading; `None` if that is NULL
/// or the same.
///
/// # Safety
/// Both handles are as [`with_mesh`] demands.
pub(super) unsafe fn with_background(
    mesh: *mut nm_mesh,
    background: *const nm_mesh,
    body: impl FnOnce(&mut Mesh, Option<&Mesh>) -> Result<()>,
) -> nm_status {
    let is_other = !std::ptr::eq(mesh, background);
    // SAFETY: NULL or live; only shared references are ever made to a handle.
    let other = unsafe { background.as_ref() }.filter(|_| is_other);
    let body = |handle: &nm_mesh| {
        let held = &mut *handle.write()?;
        match other {
            None => body(&mut held.mesh, None),
            Some(other) => body(&mut held.mesh, Some(&other.read()?.mesh)),
        }
    };
    // SAFETY: the caller's promise.
    unsafe { with_handle(mesh, body) }
}

/// Runs `body` within a [`barrier`] on the handle; a panic poisons it.
///
/// # Safety
/// The handle is as [`with_mesh`] demands.
unsafe fn with_handle(
    mesh: *const nm_mesh,
    body: impl FnOnce(&nm_mesh) -> Result<()>,
) -> nm_status {
    // SAFETY: NULL or live; only shared references are ever made to a handle.
    let Some(handle) = (unsafe { mesh.as_ref() }) else {
        return fail(&null_argument("mesh"));
    };
    let status = barrier(|| body(handle));
    if status == nm_status::NM_PANIC {
        handle.poisoned.store(true, Ordering::Release);
    }
    status
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capi::test_support::{last_message, square};

    fn assert_thread_safe<T: Send + Sync>() {}

    #[test]
    fn the_handle_may_be_shared() {
        assert_thread_safe::<nm_mesh>();
    }

    #[test]
    fn null_names_the_mesh() {
        // SAFETY: NULL is allowed.
        let status = unsafe { with_mesh(std::ptr::null(), |_| Ok(())) };
        assert_eq!((status, &*last_message()), (nm_status::NM_NULL_ARGUMENT, "mesh is NULL"));
    }

    #[test]
    fn readers_share_and_a_writer_is_alone() {
        let handle = square();
        // SAFETY: the handle lives through the test.
        let read = || unsafe { with_mesh(&raw const handle, |_| Ok(())) };
        // SAFETY: as above.
        let write = || unsafe { with_mesh_mut(&raw const handle, |_| Ok(())) };
        let mut seen = Vec::new();
        // SAFETY: as above.
        let status = unsafe {
            with_mesh(&raw const handle, |_| {
                seen.extend([read(), write()]);
                Ok(())
            })
        };
        assert_eq!((status, last_message().contains("another call")), (nm_status::NM_OK, true));
        // SAFETY: as above.
        let status = unsafe {
            with_mesh_mut(&raw const handle, |_| {
                seen.extend([read(), write()]);
                Ok(())
            })
        };
        assert_eq!(status, nm_status::NM_OK);
        let (ok, busy) = (nm_status::NM_OK, nm_status::NM_STATE);
        assert_eq!(seen, [ok, busy, busy, busy]);
        assert_eq!([read(), write()], [ok, ok], "every lock was given back");
    }

    #[test]
    fn an_error_gives_the_lock_back() {
        let handle = square();
        let refuse = || Err(Error::new(ErrorKind::Cancelled, "no"));
        // SAFETY: the handle lives through the test.
        let statuses = unsafe {
            [
                with_mesh_mut(&raw const handle, |_| refuse()),
                with_mesh(&raw const handle, |_| refuse()),
                with_mesh_mut(&raw const handle, |_| Ok(())),
            ]
        };
        let cancelled = nm_status::NM_CANCELLED;
        assert_eq!(statuses, [cancelled, cancelled, nm_status::NM_OK]);
    }

    #[test]
    fn a_panic_is_caught_and_poisons_the_handle() {
        for mutator in [false, true] {
            let handle = square();
            // SAFETY: the handle lives through the test.
            let status = unsafe {
                if mutator {
                    with_mesh_mut(&raw const handle, |_| panic!("on purpose"))
                } else {
                    with_mesh(&raw const handle, |_| panic!("on purpose"))
                }
            };
            assert_eq!(status, nm_status::NM_PANIC);
            assert!(last_message().contains("on purpose"), "{}", last_message());
            // SAFETY: as above.
            let after = unsafe {
                [
                    with_mesh(&raw const handle, |_| Ok(())),
                    with_mesh_mut(&raw const handle, |_| Ok(())),
                ]
            };
            assert_eq!(after, [nm_status::NM_STATE; 2]);
            assert!(last_message().contains("NM_PANIC"));
        }
    }
}
