//! Version of the library, and the names of its statuses.

use super::decode::bits;
use super::enums::nm_status;
use std::ffi::{CStr, c_char};
use std::mem::MaybeUninit;

/// The ABI's number: NM_ABI_VERSION of the header that belongs to this code.
const ABI_VERSION: u32 = 1;

const VERSION: &CStr =
    match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
        Ok(version) => version,
        Err(_) => panic!("the version holds a NUL"),
    };

/// Names of the statuses, by their values.
const STATUS_NAMES: [&CStr; 14] = [
    c"NM_OK",
    c"NM_NULL_ARGUMENT",
    c"NM_INVALID_ARGUMENT",
    c"NM_NON_FINITE",
    c"NM_DIMENSION",
    c"NM_CAPACITY",
    c"NM_DEGENERATE_INPUT",
    c"NM_LIMIT",
    c"NM_CANCELLED",
    c"NM_IO",
    c"NM_FORMAT_ERROR",
    c"NM_STATE",
    c"NM_OUT_OF_MEMORY",
    c"NM_PANIC",
];

/// Returns the version of the library that is running, as "major.minor.patch". Static; never NULL;
/// do not free. NM_VERSION_MAJOR, _MINOR and _PATCH are the version of the header. O(1); any
/// thread.
/// cbindgen:prefix=NM_API
#[unsafe(no_mangle)]
pub extern "C" fn nm_version() -> *const c_char {
    VERSION.as_ptr()
}

/// Returns the ABI that the running library speaks. A program built with this header works with it
/// if the result equals NM_ABI_VERSION: within one ABI version only functions, enum values and
/// trailing struct fields are added. O(1); any thread.
/// cbindgen:prefix=NM_API
#[unsafe(no_mangle)]
pub extern "C" fn nm_abi_version() -> u32 {
    ABI_VERSION
}

/// Returns the name of a status, as "NM_CAPACITY"; "NM_UNKNOWN" for a value that this version does
/// not know. Static; never NULL; do not free. O(1); any thread.
/// cbindgen:prefix=NM_API
#[unsafe(no_mangle)]
pub extern "C" fn nm_status_name(status: MaybeUninit<nm_status>) -> *const c_char {
    let index = usize::try_from(bits(status)).unwrap_or(usize::MAX);
    STATUS_NAMES.get(index).copied().unwrap_or(c"NM_UNKNOWN").as_ptr()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn name(value: i32) -> String {
        // SAFETY: the sizes agree and any bits are a valid MaybeUninit.
        let status = unsafe { std::mem::transmute::<i32, MaybeUninit<nm_status>>(value) };
        // SAFETY: the names are static C strings.
        unsafe { CStr::from_ptr(nm_status_name(status)) }.to_str().unwrap().to_owned()
    }

    #[test]
    fn every_status_has_its_name() {
        for value in 0..=13 {
            // SAFETY: 0..=13 are the values of nm_status.
            let status = unsafe { std::mem::transmute::<i32, nm_status>(value) };
            assert_eq!(name(value), format!("{status:?}"));
        }
        for value in [-1, 14, i32::MIN, i32::MAX] {
            assert_eq!(name(value), "NM_UNKNOWN");
        }
    }

    #[test]
    fn the_version_is_the_packages() {
        // SAFETY: the version is a static C string.
        let version = unsafe { CStr::from_ptr(nm_version()) };
        assert_eq!(version.to_str().unwrap(), env!("CARGO_PKG_VERSION"));
    }
}
