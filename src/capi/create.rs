//! Making and freeing handles.

use super::decode::decode_format;
use super::enums::nm_status;
use super::error::null_argument;
use super::handle::{barrier, nm_mesh};
use super::memory::{doubles, utf8, utf8_path};
use crate::error::{Error, Result, message};
use crate::io::{self, Choice, Format};
use crate::memory::with_capacity;
use crate::mesh::{MAX_DIM, MIN_DIM, Mesh, NONE};
use std::ffi::c_char;
use std::mem::MaybeUninit;
use std::str::FromStr;

/// Makes a mesh of n points; they are copied, and may be freed when the call returns. nm_run meshes
/// them.
///
/// dim: NM_MIN_DIM..NM_MAX_DIM. n: at least 2, at most 2^32 - 2. points: coordinate k of point i is
/// points[i * stride + k]; (n - 1) * stride + dim doubles are read. stride: in doubles, at least
/// dim; 0 means dim. Every finite double is accepted, subnormals and 1e308 included. The root's
/// cage reaches several times as far as the inputs, so coordinates above 3e306 may make nm_run
/// answer NM_LIMIT. Points that are equal as numbers (-0.0 equals 0.0) are duplicates and share one
/// vertex; two must be distinct.
///
/// out: receives the handle, which the caller frees with nm_mesh_free; NULL after a failure.
///
/// Errors: NM_NULL_ARGUMENT (out, or points while n > 0), NM_DIMENSION, NM_INVALID_ARGUMENT
/// (stride, or a size beyond the address space, or points not aligned to a double), NM_CAPACITY
/// (n), NM_NON_FINITE, NM_DEGENERATE_INPUT (fewer than two distinct points), NM_OUT_OF_MEMORY.
///
/// O(n dim) expected time and memory. Any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_create(
    dim: u32,
    n: usize,
    points: *const f64,
    stride: usize,
    out: *mut *mut nm_mesh,
) -> nm_status {
    // SAFETY: the caller's promises are those of `hand_out` and `read_points`.
    unsafe {
        hand_out(out, || {
            let dim = dim as usize;
            Mesh::new(dim, n, read_points(dim, n, points, stride)?, stride)
        })
    }
}

/// Makes a mesh of the points of a file, as nm_mesh_create does; of NM_FORMAT_POLY,
/// NM_FORMAT_SMESH, NM_FORMAT_GEOJSON and NM_FORMAT_WKT with its segments, facets and regions, as
/// by nm_mesh_set_segments, nm_mesh_set_facets and nm_mesh_set_regions; of NM_FORMAT_STL,
/// NM_FORMAT_OBJ, NM_FORMAT_OFF and NM_FORMAT_PLY in 3D with its faces, as by nm_mesh_set_triangles
/// or, if some are no triangles, nm_mesh_set_facets.
///
/// path_utf8: UTF-8 on every system. format: NM_FORMAT_AUTO goes by the extension. The dimension is
/// the file's.
///
/// out: receives the handle, which the caller frees with nm_mesh_free; NULL after a failure.
///
/// Errors: NM_NULL_ARGUMENT (path_utf8, out), NM_INVALID_ARGUMENT (path_utf8 empty or not UTF-8, an
/// unknown format or extension, a format that cannot be read), NM_IO, NM_FORMAT_ERROR (the message
/// names the place), and those of nm_mesh_create for what the file holds.
///
/// O(size of the file) expected time and memory. Any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_create_from_file(
    path_utf8: *const c_char,
    format: MaybeUninit<Format>,
    out: *mut *mut nm_mesh,
) -> nm_status {
    // SAFETY: the caller's promises are those of `hand_out` and `utf8_path`.
    unsafe {
        hand_out(out, || {
            let path = utf8_path(path_utf8)?;
            let format = decode_format(format)?;
            io::read_table_file(path, format, &Choice::default())?.mesh(true)
        })
    }
}

/// Reads points from a file as nm_mesh_create_from_file does, from the columns that are named as
/// coordinates; other columns become attributes of the points as by nm_mesh_set_attributes.
///
/// columns: of XYZ, CSV and NumPy files, in the order of the coordinates: numbers from 1 ("1,2,5"),
/// a range ("1-3"), or the file's names for its columns, in either case ("x,y,z"). NULL for the
/// format's own rule, by which columns that are attributes are no coordinates. attributes: of
/// TetGen, PLY, XYZ, CSV and NumPy files: names, numbers and ranges ("intensity,5-7"), NAME=COLUMN
/// for another name than the file's ("height=z"), or "all" but the coordinates and what exports
/// have for themselves (kind, domain). NULL for none. Without names in the file they are column_5
/// and so on, in a .node file attribute_1 and so on, with marker after them.
///
/// Errors: those of nm_mesh_create_from_file, and NM_INVALID_ARGUMENT (columns, attributes: not
/// UTF-8, a column that is not there, a name that no attribute can have, a format without them).
///
/// O(size of the file) expected time and memory. Any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_create_from_columns(
    path_utf8: *const c_char,
    format: MaybeUninit<Format>,
    columns: *const c_char,
    attributes: *const c_char,
    out: *mut *mut nm_mesh,
) -> nm_status {
    // SAFETY: the caller's promises are those of `hand_out`, `utf8_path` and `parsed`.
    unsafe {
        hand_out(out, || {
            let path = utf8_path(path_utf8)?;
            let choice = Choice {
                coordinates: parsed("columns", columns)?,
                attributes: parsed("attributes", attributes)?,
                ..Choice::default()
            };
            io::read_table_file(path, decode_format(format)?, &choice)?.mesh(true)
        })
    }
}

/// Frees a mesh; NULL is fine. The handle is gone afterwards, and no other call may be using it: to
/// free a mesh during nm_run, a getter or from one of its callbacks is undefined behaviour.
///
/// O(size of the mesh). Any thread, not only the one that made the mesh.
/// cbindgen:prefix=NM_API
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_free(mesh: *mut nm_mesh) {
    if !mesh.is_null() {
        // SAFETY: a handle comes from `Box::into_raw`, and this is its last use by the rules.
        let handle = unsafe { Box::from_raw(mesh) };
        // Dropping plain data does not panic; if it ever did, C could do nothing about it.
        let _ = barrier(|| {
            drop(handle);
            Ok(())
        });
    }
}

/// Returns the choice of columns in a C string of the caller's, which names itself in its errors;
/// NULL chooses none.
///
/// # Safety
/// `text` is NULL or a C string.
unsafe fn parsed<T>(argument: &'static str, text: *const c_char) -> Result<T>
where
    T: Default + FromStr<Err = Error>,
{
    match text.is_null() {
        true => Ok(T::default()),
        // SAFETY: the caller's promise.
        false => unsafe { utf8(argument, text)? }.parse(),
    }
}

/// Stores the handle of the mesh that `make` makes, or NULL.
///
/// # Safety
/// `out` is NULL or writable.
unsafe fn hand_out(out: *mut *mut nm_mesh, make: impl FnOnce() -> Result<Mesh>) -> nm_status {
    barrier(|| {
        if out.is_null() {
            return Err(null_argument("out"));
        }
        // SAFETY: not NULL, so writable.
        unsafe { out.write(std::ptr::null_mut()) };
        let handle = boxed(nm_mesh::new(make()?))?;
        // SAFETY: as above.
        unsafe { out.write(Box::into_raw(handle)) };
        Ok(())
    })
}

/// Returns the value in a box; unlike `Box::new` it refuses where there is no memory.
fn boxed<T>(value: T) -> Result<Box<T>> {
    let mut alone = with_capacity(1)?;
    alone.push(value);
    let slice: *mut [T] = Box::into_raw(alone.into_boxed_slice());
    // SAFETY: a boxed slice of one element has the layout of a box of it.
    Ok(unsafe { Box::from_raw(slice.cast::<T>()) })
}

/// Returns the caller's points as a slice; an empty one where `Inputs::new` refuses the sizes by
/// themselves.
///
/// # Safety
/// `points` is NULL or has `(n - 1) * stride + dim` readable doubles that stay while the slice
/// lives.
unsafe fn read_points<'a>(
    dim: usize,
    n: usize,
    points: *const f64,
    stride: usize,
) -> Result<&'a [f64]> {
    if n > 0 && points.is_null() {
        return Err(null_argument("points"));
    }
    let stride = if stride == 0 { dim } else { stride };
    let refused = !(MIN_DIM..=MAX_DIM).contains(&dim) || stride < dim || n as u64 >= NONE as u64;
    if refused || n == 0 {
        return Ok(&[]);
    }
    let count = (n - 1).checked_mul(stride).and_then(|start| start.checked_add(dim));
    let count = count.ok_or_else(|| {
        let message = message!("stride is {stride}; n = {n} points so far apart fit no memory");
        Error::invalid(message)
    })?;
    // SAFETY: `n > 0`, so not NULL; the rest is the caller's promise.
    unsafe { doubles("points", points, count) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capi::attributes::nm_mesh_get_attributes;
    use crate::capi::test_support::{from_c, last_message};
    use std::ffi::{CStr, CString};
    use std::ptr::{null, null_mut};

    /// Creates and frees; answers the status and whether there was a handle.
    fn create(dim: u32, n: usize, points: *const f64, stride: usize) -> (nm_status, bool) {
        let mut out = std::ptr::dangling_mut();
        // SAFETY: the tests pass pointers that fit their sizes, or sizes that are refused unread.
        let status = unsafe { nm_mesh_create(dim, n, points, stride, &mut out) };
        let made = !out.is_null();
        // SAFETY: NULL or fresh.
        unsafe { nm_mesh_free(out) };
        (status, made)
    }

    #[test]
    fn points_may_stand_apart() {
        let points = [0.0, 0.0, f64::NAN, 1.0, 0.0];
        assert_eq!(create(2, 2, points.as_ptr(), 3), (nm_status::NM_OK, true));
        assert_eq!(create(2, 2, points.as_ptr(), 2), (nm_status::NM_NON_FINITE, false));
        assert_eq!(create(2, 1, points.as_ptr(), 0), (nm_status::NM_DEGENERATE_INPUT, false));
        assert_eq!(create(2, 0, null(), 0), (nm_status::NM_DEGENERATE_INPUT, false));
    }

    #[test]
    fn null_arguments_are_named() {
        assert_eq!(create(2, 3, null(), 0), (nm_status::NM_NULL_ARGUMENT, false));
        assert_eq!(last_message(), "points is NULL");
        // SAFETY: NULL is allowed.
        let status = unsafe { nm_mesh_create(2, 0, null(), 0, null_mut()) };
        assert_eq!((status, &*last_message()), (nm_status::NM_NULL_ARGUMENT, "out is NULL"));
        // SAFETY: NULL is allowed.
        unsafe { nm_mesh_free(null_mut()) };
    }

    #[test]
    fn sizes_are_refused_before_a_point_is_read() {
        let one = [0.0];
        let refused = |dim, n, stride| {
            let (status, made) = create(dim, n, one.as_ptr(), stride);
            assert!(!made);
            status
        };
        assert_eq!(refused(1, usize::MAX, 0), nm_status::NM_DIMENSION);
        assert_eq!(refused(9, 2, 0), nm_status::NM_DIMENSION);
        assert_eq!(refused(u32::MAX, 2, 0), nm_status::NM_DIMENSION);
        assert_eq!(refused(3, 2, 2), nm_status::NM_INVALID_ARGUMENT);
        assert!(last_message().contains("stride is 2"));
        assert_eq!(refused(2, usize::MAX, 0), nm_status::NM_CAPACITY);
        assert_eq!(refused(2, 3, usize::MAX), nm_status::NM_INVALID_ARGUMENT);
        assert!(last_message().contains("stride"), "{}", last_message());
        assert_eq!(refused(2, 2, usize::MAX - 1), nm_status::NM_INVALID_ARGUMENT);
        assert_eq!(refused(2, 2, isize::MAX as usize / 8), nm_status::NM_INVALID_ARGUMENT);
    }

    #[test]
    fn misaligned_points_are_refused() {
        let points = [0.0; 9];
        let shifted = points.as_ptr().cast::<u8>().wrapping_add(1).cast();
        assert_eq!(create(2, 4, shifted, 0), (nm_status::NM_INVALID_ARGUMENT, false));
        assert!(last_message().contains("points is not a multiple of 8"));
    }

    #[test]
    fn a_path_must_be_utf8_and_a_format_known() {
        let create = |path: *const c_char, format: i32| {
            let mut out = std::ptr::dangling_mut();
            // SAFETY: the paths are NULL or C strings.
            let status = unsafe { nm_mesh_create_from_file(path, from_c(format), &mut out) };
            assert!(out.is_null());
            (status, last_message())
        };
        let (status, message) = create(null(), 0);
        assert_eq!((status, &*message), (nm_status::NM_NULL_ARGUMENT, "path_utf8 is NULL"));
        let (status, message) = create(c"ab\xff".as_ptr(), 0);
        assert_eq!(status, nm_status::NM_INVALID_ARGUMENT);
        assert!(message.contains("byte 2"), "{message}");
        assert_eq!(create(c"".as_ptr(), 0).0, nm_status::NM_INVALID_ARGUMENT);
        let (status, message) = create(c"points.xyz".as_ptr(), 77);
        assert_eq!(status, nm_status::NM_INVALID_ARGUMENT);
        assert!(message.contains("format is 77"), "{message}");
    }

    /// The area of the recipe's map: a square of 200 with a lake of 4.
    #[test]
    fn holes_of_polygons_in_files_are_outside() {
        use crate::capi::getters::{nm_mesh_get_points, nm_mesh_get_simplices};
        use crate::options::Extent;
        let name = format!("netmesh-{}-lake.wkt", std::process::id());
        let path = std::env::temp_dir().join(name);
        let lake = "POLYGON((0 0,20 0,20 10,0 10,0 0),(5 5,7 5,7 7,5 7,5 5))";
        std::fs::write(&path, lake).unwrap();
        let text = CString::new(path.to_str().unwrap()).unwrap();
        let mut mesh = null_mut();
        let format = from_c(Format::Auto as i32);
        // SAFETY: a C string, and room for a handle.
        let status = unsafe { nm_mesh_create_from_file(text.as_ptr(), format, &mut mesh) };
        std::fs::remove_file(&path).unwrap();
        assert_eq!(status, nm_status::NM_OK, "{}", last_message());
        let mut options = crate::capi::options::encode(&crate::Options::default());
        options.extent = MaybeUninit::new(Extent::Boundary);
        // SAFETY: a live handle and whole structs.
        let status = unsafe { crate::capi::run::nm_run(mesh, &options) };
        assert_eq!(status, nm_status::NM_OK, "{}", last_message());
        let (mut points, mut simplices) = ([0.0; 1024], [0; 2048]);
        let mut needed = 0;
        // SAFETY: a live handle, and buffers as long as said.
        let both = unsafe {
            let points = nm_mesh_get_points(mesh, points.as_mut_ptr(), 1024, null_mut());
            (points, nm_mesh_get_simplices(mesh, simplices.as_mut_ptr(), 2048, &mut needed))
        };
        assert_eq!(both, (nm_status::NM_OK, nm_status::NM_OK));
        let area = |simplex: &[u32]| {
            let [[a, b], [c, d], [e, f]] =
                [0, 1, 2].map(|at| [0, 1].map(|axis| points[2 * simplex[at] as usize + axis]));
            ((c - a) * (f - b) - (d - b) * (e - a)) / 2.0
        };
        let area: f64 = simplices[..needed as usize].chunks_exact(3).map(area).sum();
        assert!((area - 196.0).abs() < 1e-9, "{area}");
        // SAFETY: fresh.
        unsafe { nm_mesh_free(mesh) };
    }

    #[test]
    fn columns_of_a_file_are_coordinates_and_attributes() {
        let name = format!("netmesh-{}-columns.csv", std::process::id());
        let path = std::env::temp_dir().join(name);
        std::fs::write(&path, "id,y,x,heat\n7,2,1,5\n8,4,3,6\n9,0,5,7\n8,4,3,9\n").unwrap();
        let text = CString::new(path.to_str().unwrap()).unwrap();
        let create = |columns: *const c_char, attributes: *const c_char| {
            let mut out = std::ptr::dangling_mut();
            let format = from_c(Format::Auto as i32);
            // SAFETY: C strings or NULL.
            let status = unsafe {
                nm_mesh_create_from_columns(text.as_ptr(), format, columns, attributes, &mut out)
            };
            (status, out)
        };
        let (status, mesh) = create(c"y,x".as_ptr(), c"warmth=heat,1".as_ptr());
        assert_eq!(status, nm_status::NM_OK, "{}", last_message());
        let mut values = [0.0; 3];
        let mut get = |name: &CStr| {
            let (buf, needed) = (values.as_mut_ptr(), null_mut());
            // SAFETY: a live handle, a C string and a buffer for three.
            let status = unsafe { nm_mesh_get_attributes(mesh, name.as_ptr(), buf, 3, needed) };
            (status, values)
        };
        // Before a run the vertices are the distinct inputs.
        assert_eq!(get(c"warmth"), (nm_status::NM_OK, [5.0, 6.0, 7.0]));
        assert_eq!(get(c"id"), (nm_status::NM_OK, [7.0, 8.0, 9.0]));
        // SAFETY: fresh.
        unsafe { nm_mesh_free(mesh) };
        for (columns, attributes, message) in [
            (c"x,z".as_ptr(), null(), "columns: no column is called \"z\""),
            (c"1-9".as_ptr(), null(), "columns: \"1-9\" chooses 9 columns or more"),
            (null(), c"h".as_ptr(), "attributes: no column is called \"h\""),
            (null(), c"x\xff".as_ptr(), "attributes is not UTF-8 from byte 1"),
            (null(), c"".as_ptr(), "attributes: an entry is empty"),
        ] {
            let (status, mesh) = create(columns, attributes);
            assert!(mesh.is_null());
            assert_eq!(status, nm_status::NM_INVALID_ARGUMENT);
            assert!(last_message().contains(message), "{}", last_message());
        }
        let (status, mesh) = create(null(), null());
        // SAFETY: fresh.
        unsafe { nm_mesh_free(mesh) };
        std::fs::remove_file(&path).unwrap();
        assert_eq!(status, nm_status::NM_OK, "{}", last_message());
    }
}
