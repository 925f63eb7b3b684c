//! The caller's memory: the `struct_size` protocol, buffers, strings.

use super::error::null_argument;
use crate::error::{Error, ErrorKind, Result};
use std::ffi::{CStr, c_char};
use std::path::Path;

/// No struct of any version is larger: more is an uninitialised `struct_size`.
const MAX_STRUCT_SIZE: usize = 4096;

/// A struct of the boundary that begins with `u32 struct_size`.
///
/// # Safety
/// `repr(C)`, begins with a `u32`, has no padding, and every bit pattern is a valid value.
pub(super) unsafe trait Versioned: Copy {
    const TYPE: &'static str;

    /// Whether a struct of `size` bytes, fewer than this version's, ends inside a field.
    fn ends_inside_field(_size: usize) -> bool {
        false
    }
}

/// Checks a `struct_size` given for `argument`.
pub(super) fn check_struct_size<T: Versioned>(argument: &str, struct_size: u32) -> Result<usize> {
    let size = struct_size as usize;
    let refuse = |rule: &str| {
        let message = format!(
            "{argument}.struct_size is {size}; {rule}; set it to sizeof({}), {} in this version",
            T::TYPE,
            size_of::<T>()
        );
        Err(Error::new(ErrorKind::InvalidArgument, message))
    };
    if size < size_of::<u32>() {
        return refuse("it must cover at least itself");
    }
    if size > MAX_STRUCT_SIZE {
        return refuse("no version is that large");
    }
    if size < size_of::<T>() && T::ends_inside_field(size) {
        return refuse("it ends inside a field");
    }
    Ok(size)
}

/// Reads the `struct_size` that `pointer` begins with.
///
/// # Safety
/// `pointer` is NULL or has four readable bytes.
unsafe fn read_struct_size<T: Versioned>(argument: &str, pointer: *const T) -> Result<usize> {
    if pointer.is_null() {
        return Err(null_argument(argument));
    }
    // SAFETY: not NULL, so four bytes are readable; no alignment is asked.
    let struct_size = unsafe { pointer.cast::<u32>().read_unaligned() };
    check_struct_size::<T>(argument, struct_size)
}

/// Copies the caller's struct over `defaults`; fields that a smaller one lacks keep their default.
///
/// # Safety
/// `pointer` is NULL or has as many readable bytes as its `struct_size` says.
pub(super) unsafe fn read_struct<T: Versioned>(
    argument: &str,
    pointer: *const T,
    defaults: T,
) -> Result<T> {
    // SAFETY: the caller's promise.
    let size = unsafe { read_struct_size(argument, pointer)? };
    let known = size_of::<T>();
    for offset in known..size {
        // SAFETY: `offset < size`, the number of readable bytes.
        if unsafe { pointer.cast::<u8>().add(offset).read() } != 0 {
            let message = format!(
                "{argument}.struct_size is {size}, this version knows {known} bytes, and byte {offset} \
                 is not zero: a newer field is in use"
            );
            return Err(Error::new(ErrorKind::InvalidArgument, message));
        }
    }
    let mut value = defaults;
    // SAFETY: both sides have `min(size, known)` bytes, and every bit pattern is a valid `T`.
    unsafe {
        let destination = (&raw mut value).cast::<u8>();
        destination.copy_from_nonoverlapping(pointer.cast(), size.min(known));
    }
    Ok(value)
}

/// The caller's struct that a call fills: `pointer`, of which the first `size` bytes are theirs.
#[derive(Debug)]
pub(super) struct OutStruct<T> {
    pointer: *mut T,
    size: usize,
}

impl<T: Versioned> OutStruct<T> {
    /// Checks the struct before any work is done for it.
    ///
    /// # Safety
    /// `pointer` is NULL or has as many readable and writable bytes as its `struct_size` says, and
    /// keeps them while the result lives.
    pub(super) unsafe fn new(argument: &str, pointer: *mut T) -> Result<Self> {
        // SAFETY: the caller's promise.
        let size = unsafe { read_struct_size(argument, pointer.cast_const())? };
        Ok(Self { pointer, size })
    }

    /// A struct of `size` bytes whose `struct_size` is not yet set.
    ///
    /// # Safety
    /// As [`Self::new`], with `size` in place of the field.
    pub(super) unsafe fn with_size(argument: &str, pointer: *mut T, size: u32) -> Result<Self> {
        if pointer.is_null() {
            return Err(null_argument(argument));
        }
        Ok(Self { pointer, size: check_struct_size::<T>(argument, size)? })
    }

    /// Writes `value`, as much as fits; `struct_size` stays the caller's.
    pub(super) fn write(&self, value: &T) {
        let start = size_of::<u32>();
        let end = self.size.min(size_of::<T>());
        // SAFETY: `start <= end`, and both sides have `end` bytes (promised at construction).
        unsafe {
            let source = (&raw const *value).cast::<u8>().add(start);
            let destination = self.pointer.cast::<u8>().add(start);
            destination.copy_from_nonoverlapping(source, end - start);
        }
    }

    /// Sets `struct_size`, and to zero what lies beyond this version's struct.
    pub(super) fn write_size_and_clear_tail(&self) {
        let known = size_of::<T>();
        // SAFETY: `size` bytes are writable, at least four (both checked at construction).
        unsafe {
            self.pointer.cast::<u32>().write_unaligned(self.size as u32);
            if self.size > known {
                self.pointer.cast::<u8>().add(known).write_bytes(0, self.size - known);
            }
        }
    }
}

/// Copies `count` values to the caller's buffer, or only says how many there are.
///
/// # Errors
/// `Capacity` if `buf` is given and too small; `InvalidArgument` if it is not aligned. The buffer is
/// then untouched.
///
/// # Safety
/// `buf` is NULL or has room for `capacity` values; `needed` is NULL or writable.
pub(super) unsafe fn copy_out<T>(
    buf: *mut T,
    capacity: u64,
    needed: *mut u64,
    count: usize,
    values: impl IntoIterator<Item = T>,
) -> Result<()> {
    if !buf.is_aligned() {
        return Err(misaligned::<T>("buf"));
    }
    if !needed.is_null() {
        // SAFETY: not NULL, so writable; no alignment is asked.
        unsafe { needed.write_unaligned(count as u64) };
    }
    if buf.is_null() {
        return Ok(());
    }
    if capacity < count as u64 {
        let message = format!("capacity is {capacity}; the result has {count} elements");
        return Err(Error::new(ErrorKind::Capacity, message));
    }
    for (i, value) in values.into_iter().take(count).enumerate() {
        // SAFETY: `i < count <= capacity`, and `buf` is aligned.
        unsafe { buf.add(i).write(value) };
    }
    Ok(())
}

/// `count` doubles of the caller's.
///
/// # Safety
/// `pointer` is NULL or has `count` readable doubles that stay while the slice lives.
pub(super) unsafe fn doubles<'a>(
    argument: &str,
    pointer: *const f64,
    count: usize,
) -> Result<&'a [f64]> {
    if count == 0 {
        return Ok(&[]);
    }
    if pointer.is_null() {
        return Err(null_argument(argument));
    }
    if !pointer.is_aligned() {
        return Err(misaligned::<f64>(argument));
    }
    if count > isize::MAX as usize / size_of::<f64>() {
        let message = format!("{argument} would hold {count} doubles, more than there is memory");
        return Err(Error::new(ErrorKind::InvalidArgument, message));
    }
    // SAFETY: not NULL, aligned, not too long, and readable by the caller's promise.
    Ok(unsafe { std::slice::from_raw_parts(pointer, count) })
}

/// The path in a C string of the caller's.
///
/// # Safety
/// `path` is NULL or a C string that stays while the result lives.
pub(super) unsafe fn utf8_path<'a>(path: *const c_char) -> Result<&'a Path> {
    if path.is_null() {
        return Err(null_argument("path_utf8"));
    }
    // SAFETY: not NULL, so a C string.
    let path = unsafe { CStr::from_ptr(path) }.to_str().map_err(|error| {
        let message = format!("path_utf8 is not UTF-8 from byte {}", error.valid_up_to());
        Error::new(ErrorKind::InvalidArgument, message)
    })?;
    if path.is_empty() {
        return Err(Error::new(ErrorKind::InvalidArgument, "path_utf8 is empty"));
    }
    Ok(Path::new(path))
}

fn misaligned<T>(argument: &str) -> Error {
    let message = format!("{argument} is not a multiple of {}", align_of::<T>());
    Error::new(ErrorKind::InvalidArgument, message)
}
