//! The caller's memory: the `struct_size` protocol, buffers, strings.

use super::error::null_argument;
use crate::error::{Error, ErrorKind, Result, message};
use std::ffi::{CStr, c_char};
use std::fmt::Display;
use std::path::Path;

/// No struct of any version is larger: more is an uninitialised `struct_size`.
const MAX_STRUCT_SIZE: usize = 4096;

/// A struct of the boundary that begins with `u32 struct_size`.
///
/// # Safety
/// `repr(C)`, begins with a `u32`, has no padding, and every bit pattern is a valid value.
pub unsafe trait Versioned: Copy {
    const TYPE: &'static str;

    /// Returns true if a struct of `size` bytes, fewer than this version's, ends inside a field.
    fn ends_inside_field(_size: usize) -> bool {
        false
    }
}

/// Checks a `struct_size` given for `argument`, whose name is written only where it is refused.
pub(super) fn check_struct_size<T: Versioned>(
    argument: impl Display,
    struct_size: u32,
) -> Result<usize> {
    let size = struct_size as usize;
    let refuse = |rule: &str| {
        let message = message!(
            "{argument}.struct_size is {size}; {rule}; set it to sizeof({}), {} in this version",
            T::TYPE,
            size_of::<T>()
        );
        Err(Error::invalid(message))
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
unsafe fn read_struct_size<T: Versioned>(
    argument: impl Display,
    pointer: *const T,
) -> Result<usize> {
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
    argument: impl Display,
    pointer: *const T,
    defaults: T,
) -> Result<T> {
    // SAFETY: the caller's promise.
    let size = unsafe { read_struct_size(&argument, pointer)? };
    let known = size_of::<T>();
    for offset in known..size {
        // SAFETY: `offset < size`, the number of readable bytes.
        if unsafe { pointer.cast::<u8>().add(offset).read() } != 0 {
            let message = message!(
                "{argument}.struct_size is {size}, this version knows {known} bytes, and byte \
                 {offset} is not zero: a newer field is in use"
            );
            return Err(Error::invalid(message));
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
pub struct OutStruct<T> {
    pointer: *mut T,
    size: usize,
}

impl<T: Versioned> OutStruct<T> {
    /// Checks the struct before any work is done for it.
    ///
    /// # Safety
    /// `pointer` is NULL or has as many readable and writable bytes as its `struct_size` says, and
    /// keeps them while the result lives.
    pub unsafe fn new(argument: &str, pointer: *mut T) -> Result<Self> {
        // SAFETY: the caller's promise.
        let size = unsafe { read_struct_size(argument, pointer.cast_const())? };
        Ok(Self { pointer, size })
    }

    /// Returns a struct of `size` bytes whose `struct_size` is not yet set.
    ///
    /// # Safety
    /// The pointer is as [`Self::new`] demands, with `size` in place of the field.
    pub(super) unsafe fn with_size(argument: &str, pointer: *mut T, size: u32) -> Result<Self> {
        if pointer.is_null() {
            return Err(null_argument(argument));
        }
        Ok(Self { pointer, size: check_struct_size::<T>(argument, size)? })
    }

    /// Returns the number of the caller's bytes.
    pub(super) fn size(&self) -> usize {
        self.size
    }

    /// Writes `value`, as much as fits; `struct_size` stays the caller's.
    pub fn write(&self, value: &T) {
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
/// `Capacity` if `buf` is given and too small; `InvalidArgument` if it is not aligned. The buffer
/// is then untouched.
///
/// # Safety
/// `buf` is NULL or has room for `capacity` values; `needed` is NULL or writable.
pub unsafe fn copy_out<T>(
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
        let message = message!("capacity is {capacity}; the result has {count} elements");
        return Err(Error::new(ErrorKind::Capacity, message));
    }
    for (i, value) in values.into_iter().take(count).enumerate() {
        // SAFETY: `i < count <= capacity`, and `buf` is aligned.
        unsafe { buf.add(i).write(value) };
    }
    Ok(())
}

/// Writes a struct for each value into the caller's array, whose structs have the size that the
/// first one tells, or only says how many there are.
///
/// # Errors
/// Errors of [`copy_out`]; `InvalidArgument` (a size).
///
/// # Safety
/// `buf` is NULL or has room for `capacity` structs of that size; `needed` is NULL or writable.
pub(super) unsafe fn copy_structs<T: Versioned, V>(
    values: &[V],
    encode: impl Fn(&V) -> T,
    buf: *mut T,
    capacity: u64,
    needed: *mut u64,
) -> Result<()> {
    // SAFETY: nothing is written to `buf`, whose rules are those of `copy_out`.
    unsafe { copy_out(buf, capacity, needed, values.len(), std::iter::empty())? };
    if buf.is_null() || values.is_empty() {
        return Ok(());
    }
    // SAFETY: not NULL, and the first struct is as long as it says.
    let size = unsafe { OutStruct::new("buf[0]", buf)? }.size();
    for (at, value) in values.iter().enumerate() {
        let element = buf.wrapping_byte_add(at * size);
        // SAFETY: there is room for `values.len()` structs of this size.
        let element = unsafe { OutStruct::with_size("buf", element, size as u32)? };
        element.write_size_and_clear_tail();
        element.write(&encode(value));
    }
    Ok(())
}

/// Returns `count` doubles of the caller's.
///
/// # Safety
/// `pointer` is not NULL and has `count` readable doubles that stay while the slice lives.
pub(super) unsafe fn doubles<'a>(
    argument: &str,
    pointer: *const f64,
    count: usize,
) -> Result<&'a [f64]> {
    check_room(argument, pointer, count)?;
    // SAFETY: not NULL, aligned, not too long, and readable by the caller's promise.
    Ok(unsafe { std::slice::from_raw_parts(pointer, count) })
}

/// Returns `rows x columns` values of the caller's; none may be NULL.
///
/// # Safety
/// `pointer` is NULL or has so many readable values that stay while the slice lives.
pub unsafe fn read_rows<'a, T>(
    argument: &str,
    pointer: *const T,
    rows: u64,
    columns: usize,
) -> Result<&'a [T]> {
    let Some(count) = rows_to_fill(argument, pointer, rows, columns)? else { return Ok(&[]) };
    // SAFETY: not NULL, aligned, not too long, and readable by the caller's promise.
    Ok(unsafe { std::slice::from_raw_parts(pointer, count) })
}

/// Returns `rows x columns` values of the caller's that a call fills; none may be NULL.
///
/// # Safety
/// `pointer` is NULL or has so many writable values, which nothing else uses while the slice lives.
pub(super) unsafe fn rows_out<'a, T>(
    argument: &str,
    pointer: *mut T,
    rows: u64,
    columns: usize,
) -> Result<&'a mut [T]> {
    let count = rows_to_fill(argument, pointer.cast_const(), rows, columns)?;
    let Some(count) = count else { return Ok(&mut []) };
    // SAFETY: not NULL, aligned, not too long, and writable by the caller's promise. Numbers that C
    // has not set yet are numbers.
    Ok(unsafe { std::slice::from_raw_parts_mut(pointer, count) })
}

/// Returns the number of values in so many rows at a pointer that is checked; none if there are no
/// rows.
fn rows_to_fill<T>(
    argument: &str,
    pointer: *const T,
    rows: u64,
    columns: usize,
) -> Result<Option<usize>> {
    if rows == 0 || columns == 0 {
        return Ok(None);
    }
    if pointer.is_null() {
        return Err(null_argument(argument));
    }
    let count = usize::try_from(rows).ok().and_then(|rows| rows.checked_mul(columns));
    let count = count.unwrap_or(usize::MAX);
    check_room(argument, pointer, count)?;
    Ok(Some(count))
}

/// Returns the number of rows of so many bytes, if an array of them fits in memory.
pub(super) fn check_rows(argument: &str, rows: u64, bytes: usize) -> Result<usize> {
    let count = usize::try_from(rows).unwrap_or(usize::MAX);
    if count > isize::MAX as usize / bytes {
        let message = message!("{argument} would have {rows} elements, more than there is memory");
        return Err(Error::invalid(message));
    }
    Ok(count)
}

fn check_room<T>(argument: &str, pointer: *const T, count: usize) -> Result<()> {
    if !pointer.is_aligned() {
        return Err(misaligned::<T>(argument));
    }
    if count > isize::MAX as usize / size_of::<T>() {
        let message = message!("{argument} would hold {count} numbers, more than there is memory");
        return Err(Error::invalid(message));
    }
    Ok(())
}

/// Returns the path in a C string of the caller's.
///
/// # Safety
/// `path` is NULL or a C string that stays while the result lives.
pub unsafe fn utf8_path<'a>(path: *const c_char) -> Result<&'a Path> {
    // SAFETY: the caller's promise.
    let path = unsafe { utf8("path_utf8", path)? };
    if path.is_empty() {
        return Err(Error::invalid("path_utf8 is empty"));
    }
    Ok(Path::new(path))
}

/// Returns the text of a C string of the caller's.
///
/// # Safety
/// `text` is NULL or a C string that stays while the result lives.
pub(super) unsafe fn utf8<'a>(argument: &'static str, text: *const c_char) -> Result<&'a str> {
    if text.is_null() {
        return Err(null_argument(argument));
    }
    // SAFETY: not NULL, so a C string.
    unsafe { CStr::from_ptr(text) }.to_str().map_err(|error| {
        let message = message!("{argument} is not UTF-8 from byte {}", error.valid_up_to());
        Error::invalid(message)
    })
}

fn misaligned<T>(argument: &str) -> Error {
    let message = message!("{argument} is not a multiple of {}", align_of::<T>());
    Error::invalid(message)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capi::structs::nm_counts;
    use std::ptr::{null, null_mut};

    const COUNTS: nm_counts = nm_counts {
        struct_size: 64,
        dim: 3,
        inputs: 5,
        duplicates: 1,
        vertices: 9,
        simplices: 20,
        domains: 2,
        segment_edges: 7,
        facet_triangles: 6,
    };

    /// A struct of another version: `T` and what follows it.
    #[repr(C)]
    #[derive(Clone, Copy)]
    struct Larger<T> {
        known: T,
        tail: [u8; 8],
    }

    fn larger(struct_size: u32, tail: [u8; 8]) -> Larger<nm_counts> {
        Larger { known: nm_counts { struct_size, ..COUNTS }, tail }
    }

    fn read(from: &Larger<nm_counts>) -> Result<nm_counts> {
        let defaults = nm_counts { struct_size: 0, dim: 2, inputs: 7, duplicates: 7, ..COUNTS };
        // SAFETY: the tests' sizes are at most the struct's, or refused.
        unsafe { read_struct("counts", (&raw const *from).cast(), defaults) }
    }

    #[test]
    fn a_smaller_struct_keeps_the_defaults() {
        assert_eq!(read(&larger(64, [9; 8])).unwrap(), COUNTS, "what follows is not looked at");
        let short = read(&larger(16, [9; 8])).unwrap();
        assert_eq!((short.struct_size, short.dim, short.inputs), (16, 3, 5));
        assert_eq!(short.duplicates, 7);
        let least = read(&larger(4, [9; 8])).unwrap();
        assert_eq!((least.struct_size, least.dim), (4, 2));
    }

    #[test]
    fn a_larger_struct_must_end_in_zeros() {
        assert_eq!(read(&larger(72, [0; 8])).unwrap().domains, 2);
        assert_eq!(read(&larger(68, [0, 0, 0, 0, 1, 0, 0, 0])).unwrap().domains, 2);
        for byte in 0..8 {
            let mut tail = [0; 8];
            tail[byte] = 1;
            let error = read(&larger(72, tail)).unwrap_err();
            assert_eq!(error.kind(), ErrorKind::InvalidArgument);
            let place = format!("byte {}", 64 + byte);
            assert!(error.message().contains(&place), "{}", error.message());
        }
    }

    #[test]
    fn sizes_out_of_range_are_refused() {
        for size in [0, 1, 3, 4097, u32::MAX] {
            let from = larger(size, [0; 8]);
            let error = read(&from).unwrap_err();
            assert_eq!(error.kind(), ErrorKind::InvalidArgument);
            let start = format!("counts.struct_size is {size};");
            assert!(error.message().starts_with(&start), "{}", error.message());
            assert!(error.message().ends_with("sizeof(nm_counts), 64 in this version"));
        }
        // SAFETY: NULL is allowed.
        let null = unsafe { read_struct("counts", null(), COUNTS) };
        assert_eq!(null.unwrap_err(), null_argument("counts"));
    }

    #[test]
    fn only_the_callers_bytes_are_written() {
        for size in 4..=72_u8 {
            let mut bytes = [0xee; 80];
            bytes[..4].copy_from_slice(&u32::from(size).to_ne_bytes());
            // SAFETY: `bytes` is longer than every size.
            let out = unsafe { OutStruct::new("counts", bytes.as_mut_ptr().cast()) };
            out.unwrap().write(&COUNTS);
            // SAFETY: numbers without padding.
            let source: [u8; 64] = unsafe { std::mem::transmute(COUNTS) };
            let end = usize::from(size).min(64);
            assert_eq!(bytes[..4], u32::from(size).to_ne_bytes());
            assert_eq!(bytes[4..end], source[4..end]);
            assert!(bytes[end..].iter().all(|&byte| byte == 0xee), "{size}");
        }
        // SAFETY: NULL is allowed.
        let error = unsafe { OutStruct::<nm_counts>::new("counts", null_mut()) }.unwrap_err();
        assert_eq!(error, null_argument("counts"));
    }

    #[test]
    fn a_buffer_is_filled_whole_or_not_at_all() {
        let copy = |buf: *mut u32, capacity, needed| {
            // SAFETY: every buffer below has room for its capacity.
            unsafe { copy_out(buf, capacity, needed, 3, [5, 6, 7]) }
        };
        let mut needed = 0;
        let mut buf = [0; 4];
        copy(null_mut(), 0, &mut needed).unwrap();
        assert_eq!(needed, 3);
        copy(null_mut(), 99, null_mut()).unwrap();
        needed = 0;
        let error = copy(buf.as_mut_ptr(), 2, &mut needed).unwrap_err();
        assert_eq!((error.kind(), needed, buf), (ErrorKind::Capacity, 3, [0; 4]));
        assert_eq!(error.message(), "capacity is 2; the result has 3 elements");
        let error = copy(buf.as_mut_ptr(), 0, null_mut()).unwrap_err();
        assert_eq!((error.kind(), buf), (ErrorKind::Capacity, [0; 4]));
        copy(buf.as_mut_ptr(), 3, null_mut()).unwrap();
        assert_eq!(buf, [5, 6, 7, 0]);
        buf = [0; 4];
        copy(buf.as_mut_ptr(), 4, &mut needed).unwrap();
        assert_eq!(buf, [5, 6, 7, 0]);
        let odd = buf.as_mut_ptr().cast::<u8>().wrapping_add(1).cast();
        let error = copy(odd, 3, null_mut()).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::InvalidArgument);
        assert_eq!(error.message(), "buf is not a multiple of 4");
    }

    #[test]
    fn more_values_than_counted_are_not_written() {
        let mut buf = [0_u8; 4];
        // SAFETY: the buffer has room for four.
        unsafe { copy_out(buf.as_mut_ptr(), 4, null_mut(), 2, [1, 2, 3]) }.unwrap();
        assert_eq!(buf, [1, 2, 0, 0]);
    }
}
