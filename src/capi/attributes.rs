//! Attributes: values of the inputs, under names, which files get as columns.

use super::enums::nm_status;
use super::handle::{nm_mesh, with_prepared, with_prepared_mut};
use super::memory::{copy_out, read_rows, utf8};
use crate::error::{Error, message};
use std::ffi::c_char;

/// Gives the inputs values under a name. Exports to VTU, TetGen, Gmsh, PLY, CSV, NumPy and HTML
/// have them, at all vertices: other vertices than inputs get values as by nm_mesh_extend_values,
/// at the first export after this call or after nm_run. Values of the same name are replaced.
///
/// name: 1 to 64 ASCII letters, digits, '_', '-' and '.'; not one that files have for something
/// else: x, y, z, x0, x1 and so on, points, kind, domain, input, precision_limited, aspect,
/// cell_domain, radius_edge, below_min_dihedral, beyond_bound. components: numbers an input; 0
/// removes the values of that name, and values may be NULL then. values: inputs x components
/// numbers, duplicates included, which are copied; of equal inputs the first counts. In formats
/// whose columns are single numbers, name_0, name_1 and so on are the components. Gmsh has vectors
/// of two and three components as vectors. A .node file has no names: its attributes are in the
/// order in which their names were set first.
///
/// Errors: NM_NULL_ARGUMENT (mesh, name, values), NM_INVALID_ARGUMENT (name, values not aligned),
/// NM_OUT_OF_MEMORY, NM_STATE (another call is using the mesh, or it is poisoned).
///
/// O(inputs x components). Before nm_run and after.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_set_attributes(
    mesh: *mut nm_mesh,
    name: *const c_char,
    components: u32,
    values: *const f64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `set`.
    unsafe { set(mesh, name, components, values, true) }
}

/// Sets attributes of the inputs as nm_mesh_set_attributes does, but vertices that are no inputs
/// get NaN.
///
/// Errors: as nm_mesh_set_attributes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_set_input_attributes(
    mesh: *mut nm_mesh,
    name: *const c_char,
    components: u32,
    values: *const f64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `set`.
    unsafe { set(mesh, name, components, values, false) }
}

/// Sets attributes of the inputs; `is_extended`: vertices that are no inputs get values too.
///
/// # Safety
/// `mesh` is NULL or a live handle, `name` NULL or a C string, `values` NULL or as long as said.
unsafe fn set(
    mesh: *mut nm_mesh,
    name: *const c_char,
    components: u32,
    values: *const f64,
    is_extended: bool,
) -> nm_status {
    // SAFETY: the caller's promise.
    unsafe {
        with_prepared_mut(mesh, |mesh, prepared| {
            let (name, components) = (utf8("name", name)?, components as usize);
            let count = mesh.inputs().count() as u64;
            let values = read_rows("values", values, count, components)?;
            mesh.set_attribute(name, components, values, is_extended)?;
            prepared.forget_attributes();
            Ok(())
        })
    }
}

/// Writes the values of a name at the vertices, as exports have them: vertices x components
/// numbers.
///
/// name: as given to nm_mesh_set_attributes.
///
/// Array getter, see the top of this file. Errors: NM_NULL_ARGUMENT (mesh, name),
/// NM_INVALID_ARGUMENT (a name without values, buf not aligned), NM_CAPACITY, NM_OUT_OF_MEMORY,
/// NM_STATE (nm_run at work, poisoned). The first call after attributes are set or after nm_run
/// makes all of them, as an export does.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_attributes(
    mesh: *const nm_mesh,
    name: *const c_char,
    buf: *mut f64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller gave NULL or a live handle, NULL or a C string, and a buffer by the rules.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            let name = utf8("name", name)?;
            let mut attributes = prepared.vertex_attributes(mesh)?.iter();
            let found = attributes.find(|attribute| attribute.name == name).ok_or_else(|| {
                let message = message!("name is '{name}'; no values have that name");
                Error::invalid(message)
            })?;
            copy_out(buf, capacity, needed, found.values.len(), found.values.iter().copied())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capi::export::nm_export_write;
    use crate::capi::handle::with_mesh_mut;
    use crate::capi::test_support::{from_c, last_message, square};
    use crate::io::Format;
    use crate::options::Options;
    use std::ffi::{CStr, c_void};
    use std::ptr::{null, null_mut};

    unsafe extern "C" fn append(data: *const c_void, size: usize, text: *mut c_void) -> i32 {
        // SAFETY: the test passes its own vector, and `size` bytes are readable.
        unsafe {
            (*text.cast::<Vec<u8>>()).extend(std::slice::from_raw_parts(data.cast(), size));
        }
        0
    }

    fn export(mesh: &nm_mesh, format: Format) -> String {
        let mut text = Vec::<u8>::new();
        let to = (&raw mut text).cast();
        // SAFETY: a live handle; the callback gets its vector.
        let status = unsafe { nm_export_write(mesh, from_c(format as i32), Some(append), to) };
        assert_eq!(status, nm_status::NM_OK, "{}", last_message());
        String::from_utf8_lossy(&text).into_owned()
    }

    fn get(mesh: &nm_mesh, name: &CStr) -> Vec<f64> {
        let mut needed = 0;
        // SAFETY: a live handle; NULL asks for the size.
        let status =
            unsafe { nm_mesh_get_attributes(mesh, name.as_ptr(), null_mut(), 0, &mut needed) };
        assert_eq!(status, nm_status::NM_OK, "{}", last_message());
        let mut values = vec![7.0; needed as usize];
        // SAFETY: the buffer has room for `needed`.
        let status = unsafe {
            nm_mesh_get_attributes(mesh, name.as_ptr(), values.as_mut_ptr(), needed, null_mut())
        };
        assert_eq!(status, nm_status::NM_OK);
        values
    }

    #[test]
    fn values_reach_all_vertices_and_files() {
        // Of five inputs, the first twice: its second value does not count.
        let mut mesh = square();
        let (heat, flow) = ([1.0, 2.0, 9.0, 3.0, 2.0], [0.5f64; 10]);
        // SAFETY: a live handle and values of five inputs.
        let statuses = unsafe {
            [
                nm_mesh_set_attributes(&mut mesh, c"heat".as_ptr(), 1, heat.as_ptr()),
                nm_mesh_set_attributes(&mut mesh, c"wind".as_ptr(), 1, flow.as_ptr()),
                nm_mesh_set_input_attributes(&mut mesh, c"flow".as_ptr(), 2, flow.as_ptr()),
            ]
        };
        assert_eq!(statuses, [nm_status::NM_OK; 3]);
        assert_eq!(get(&mesh, c"heat"), [1.0, 2.0, 3.0, 2.0]);
        let csv = export(&mesh, Format::Csv);
        assert!(
            csv.starts_with("x0,x1,kind,heat,wind,flow_0,flow_1\n0,0,0,1,0.5,0.5,0.5\n"),
            "{csv}"
        );
        // SAFETY: a live handle.
        let status = unsafe { with_mesh_mut(&mesh, |mesh| mesh.run(&Options::default(), None)) };
        assert_eq!(status, nm_status::NM_OK);
        let (heat, flow) = (get(&mesh, c"heat"), get(&mesh, c"flow"));
        assert_eq!((&heat[..4], 2 * heat.len()), (&[1.0, 2.0, 3.0, 2.0][..], flow.len()));
        assert!(get(&mesh, c"wind").iter().all(|wind| (wind - 0.5).abs() < 1e-12));
        assert!(heat.len() > 4 && heat.iter().all(|value| (1.0..=3.0).contains(value)));
        assert!(flow[..8].iter().all(|&x| x == 0.5) && flow[8..].iter().all(|x| x.is_nan()));
        let vtu = export(&mesh, Format::Vtu);
        assert!(vtu.contains(r#"type="Float64" Name="flow" NumberOfComponents="2""#));
        assert!(export(&mesh, Format::Gmsh).contains("$NodeData\n1\n\"heat\"\n"));
        assert!(export(&mesh, Format::Ply).contains("property double flow_1\n"));
        let npy = export(&mesh, Format::Npy);
        assert!(npy.contains("('points', '<f8', (2,)), ('kind', '|u1'), ('heat', '<f8')"), "{npy}");
        let node = export(&mesh, Format::TetgenNode);
        assert!(node.contains(" 2 4 1\n0 0 0 1 0.5 0.5 0.5 0\n"), "{node}");
        // SAFETY: a live handle.
        let status = unsafe { nm_mesh_set_attributes(&mut mesh, c"heat".as_ptr(), 0, null()) };
        assert_eq!(status, nm_status::NM_OK);
        assert!(!export(&mesh, Format::Csv).contains("heat"));
    }

    #[test]
    fn wrong_names_are_refused() {
        let mut mesh = square();
        let values = [0.0; 5];
        let mut refused = |name: *const c_char, status, message: &str| {
            // SAFETY: a live handle, a C string or NULL, and values of five inputs.
            let found = unsafe { nm_mesh_set_attributes(&mut mesh, name, 1, values.as_ptr()) };
            assert_eq!(found, status);
            assert!(last_message().starts_with(message), "{}", last_message());
        };
        let invalid = nm_status::NM_INVALID_ARGUMENT;
        refused(null(), nm_status::NM_NULL_ARGUMENT, "name is NULL");
        refused(c"".as_ptr(), invalid, "name is ''; it must be 1 to 64");
        refused(c"a b".as_ptr(), invalid, "name is 'a b'; it must be");
        refused(c"kind".as_ptr(), invalid, "name is 'kind'; files have");
        refused(c"x17".as_ptr(), invalid, "name is 'x17'; files have");
        refused(c"ab\xff".as_ptr(), invalid, "name is not UTF-8 from byte 2");
        let mut needed = 0;
        // SAFETY: a live handle and C strings or NULL.
        unsafe {
            let status = nm_mesh_set_attributes(&mut mesh, c"a".as_ptr(), 1, null());
            assert_eq!((status, &*last_message()), (nm_status::NM_NULL_ARGUMENT, "values is NULL"));
            let status = nm_mesh_get_attributes(&mesh, c"a".as_ptr(), null_mut(), 0, &mut needed);
            assert_eq!(status, invalid);
        }
        assert_eq!(last_message(), "name is 'a'; no values have that name");
    }
}
