//! Helpers that the tests of this module share.

use super::error::nm_last_error;
use super::handle::nm_mesh;
use crate::mesh::Mesh;
use std::ffi::CStr;
use std::mem::MaybeUninit;

/// Returns a handle with the corners of the unit square, the first one twice.
pub(super) fn square() -> nm_mesh {
    let points = [0.0, 0.0, 1.0, 0.0, 0.0, -0.0, 1.0, 1.0, 0.0, 1.0];
    nm_mesh::new(Mesh::new(2, 5, &points, 0).expect("five good points"))
}

/// Returns the last message of this thread.
pub(super) fn last_message() -> String {
    let mut buf = [0x7f; 1024];
    // SAFETY: the buffer has the size that is said, and is a C string afterwards.
    let message = unsafe {
        nm_last_error(buf.as_mut_ptr(), buf.len());
        CStr::from_ptr(buf.as_ptr())
    };
    message.to_str().expect("messages are UTF-8").to_owned()
}

/// Returns `value` as C passes it for an enum, whether the enum knows it or not.
pub(super) fn from_c<E>(value: i32) -> MaybeUninit<E> {
    const { assert!(size_of::<E>() == size_of::<i32>()) };
    // SAFETY: the sizes agree and any bits are a valid MaybeUninit.
    unsafe { std::mem::transmute_copy(&value) }
}
