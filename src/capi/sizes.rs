//! Sizes by values, for the runs that follow, and those that a run asked for.

use super::enums::nm_status;
use super::getters::{get_array, result};
use super::handle::{nm_mesh, with_background, with_prepared_mut};
use super::memory::read_rows;

/// Gives the inputs sizes, for the calls of nm_run that follow: beside nm_options.max_edge and
/// nm_options.size, the least counts. Between the inputs sizes are linear in their Delaunay
/// triangulation, which every run makes; beyond its hull, and everywhere if the inputs lie in a
/// hyperplane, they are those of the nearest input. From 6D on that triangulation may be large, and
/// a function is better.
///
/// count: the number of inputs, duplicates included; 0 removes the sizes. values: count numbers
/// above 0, infinite for no bound, which are copied; of equal inputs the first counts.
///
/// Errors: NM_NULL_ARGUMENT (mesh, values), NM_INVALID_ARGUMENT (count, a value, values not
/// aligned), NM_OUT_OF_MEMORY, NM_STATE (another call is using the mesh, or it is poisoned).
///
/// O(inputs). Before nm_run and after.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_set_sizes(
    mesh: *mut nm_mesh,
    count: u64,
    values: *const f64,
) -> nm_status {
    // SAFETY: the caller gave NULL or a live handle, and NULL or `count` numbers.
    unsafe {
        with_prepared_mut(mesh, |mesh, _| mesh.set_sizes(read_rows("values", values, count, 1)?))
    }
}

/// Gives sizes by those at the vertices of another mesh, for the calls of nm_run that follow, in
/// place of those of an earlier call: beside nm_options.max_edge, nm_options.size and
/// nm_mesh_set_sizes, the least counts. Between the vertices sizes are linear, and beyond the
/// background they are those of its nearest vertex.
///
/// background: a mesh with a result, or NULL, which removes the sizes; what is needed of it is
/// copied. It may be mesh itself: then the next run adapts the result of the last. count: the
/// number of its vertices. values: count numbers above 0, infinite for no bound, which are copied.
///
/// Errors: NM_NULL_ARGUMENT (mesh, values), NM_INVALID_ARGUMENT (count, a value, values not
/// aligned), NM_DIMENSION (the background has another one), NM_OUT_OF_MEMORY, NM_STATE (background
/// has no result; another call is using one of the meshes, or it is poisoned).
///
/// O(simplices of the background). Before nm_run and after.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_set_background(
    mesh: *mut nm_mesh,
    background: *const nm_mesh,
    count: u64,
    values: *const f64,
) -> nm_status {
    // SAFETY: the caller gave NULL or live handles, and NULL or `count` numbers.
    unsafe {
        with_background(mesh, background, |mesh, other| {
            if background.is_null() {
                return mesh.set_background(None);
            }
            let values = read_rows("values", values, count, 1)?;
            match other {
                Some(other) => mesh.set_background(Some((other.result()?, values))),
                None => mesh.set_own_background(values),
            }
        })
    }
}

/// Writes for each vertex the size that the last run asked for there: the least of what
/// nm_options.size, nm_mesh_set_sizes and nm_mesh_set_background say, infinite where there is no
/// bound and where none was needed (at vertices of no simplex that meets the box of the inputs).
/// nm_options.max_edge and the largest edges of regions are not among them. None where nothing told
/// sizes.
///
/// Array getter, see the top of this file. Errors: NM_NULL_ARGUMENT (mesh), NM_CAPACITY,
/// NM_INVALID_ARGUMENT (buf not aligned), NM_STATE (before nm_run, nm_run at work, poisoned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_sizes(
    mesh: *const nm_mesh,
    buf: *mut f64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's rules are those of `get_array`.
    unsafe { get_array(mesh, buf, capacity, needed, |mesh| Ok(&result(mesh)?.sizes)) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capi::options::encode;
    use crate::capi::run::nm_run;
    use crate::capi::structs::nm_options;
    use crate::capi::test_support::{last_message, square};
    use crate::options::{Options, Output};
    use std::ffi::c_void;
    use std::ptr::{null, null_mut};

    fn well_spaced() -> nm_options {
        encode(&Options { output: Output::WellSpaced, ..Options::default() })
    }

    fn vertices(mesh: *mut nm_mesh) -> usize {
        let mut count = 0;
        // SAFETY: a live handle.
        let status = unsafe {
            with_prepared_mut(mesh, |mesh, _| {
                count = mesh.result()?.vertex_count();
                Ok(())
            })
        };
        assert_eq!(status, nm_status::NM_OK);
        count
    }

    #[test]
    fn sizes_by_values_make_a_finer_mesh() {
        let mut mesh = square();
        let handle = &raw mut mesh;
        // SAFETY: live handles, arrays as long as said.
        unsafe {
            assert_eq!(nm_run(handle, &well_spaced()), nm_status::NM_OK);
            let plain = vertices(handle);
            assert_eq!(nm_mesh_set_sizes(handle, 5, [0.1; 5].as_ptr()), nm_status::NM_OK);
            assert_eq!(nm_run(handle, &well_spaced()), nm_status::NM_OK);
            let sized = vertices(handle);
            assert!(sized > plain + 50, "{plain}, {sized}");
            // The least of both counts: a background of larger sizes changes nothing.
            let coarse = vec![0.2; sized];
            let set = nm_mesh_set_background(handle, handle, sized as u64, coarse.as_ptr());
            assert_eq!(set, nm_status::NM_OK);
            assert_eq!(nm_run(handle, &well_spaced()), nm_status::NM_OK);
            assert_eq!(vertices(handle), sized);
            assert_eq!(nm_mesh_set_sizes(handle, 0, null()), nm_status::NM_OK);
            assert_eq!(nm_run(handle, &well_spaced()), nm_status::NM_OK);
            let middle = vertices(handle);
            assert!(plain < middle && middle < sized, "{plain}, {middle}, {sized}");
            assert_eq!(nm_mesh_set_background(handle, null(), 0, null()), nm_status::NM_OK);
            let mut other = square();
            let set = nm_mesh_set_background(
                &mut other,
                handle,
                middle as u64,
                vec![0.1; middle].as_ptr(),
            );
            assert_eq!(set, nm_status::NM_OK);
            assert_eq!(nm_run(&mut other, &well_spaced()), nm_status::NM_OK);
            assert_eq!(vertices(&mut other), sized);
            assert_eq!(nm_run(handle, &well_spaced()), nm_status::NM_OK);
            assert_eq!(vertices(handle), plain);
        }
    }

    #[test]
    fn a_run_tells_what_it_asked_for() {
        let mut mesh = square();
        let sizes = |mesh: &nm_mesh| {
            let mut needed = 0;
            // SAFETY: a live handle; NULL asks for the size, then the buffer has room for it.
            unsafe {
                let status = nm_mesh_get_sizes(mesh, null_mut(), 0, &mut needed);
                assert_eq!(status, nm_status::NM_OK);
                let mut sizes = vec![0.0; needed as usize];
                let status = nm_mesh_get_sizes(mesh, sizes.as_mut_ptr(), needed, null_mut());
                assert_eq!(status, nm_status::NM_OK);
                sizes
            }
        };
        // SAFETY: a live handle, arrays as long as said.
        unsafe {
            assert_eq!(nm_mesh_get_sizes(&mesh, null_mut(), 0, &mut 0), nm_status::NM_STATE);
            assert_eq!(nm_run(&mut mesh, &well_spaced()), nm_status::NM_OK);
            assert!(sizes(&mesh).is_empty());
            assert_eq!(nm_mesh_set_sizes(&mut mesh, 5, [0.25; 5].as_ptr()), nm_status::NM_OK);
            assert_eq!(nm_run(&mut mesh, &well_spaced()), nm_status::NM_OK);
        }
        let asked = sizes(&mesh);
        assert_eq!(asked.len(), vertices(&mut mesh));
        assert!(asked[..4].iter().all(|&size| size == 0.25), "{asked:?}");
        assert!(asked.iter().all(|&size| size == 0.25 || size == f64::INFINITY), "{asked:?}");
    }

    #[test]
    fn values_that_are_no_sizes_are_refused() {
        let mut mesh = square();
        let mut other = square();
        let (null_argument, invalid) =
            (nm_status::NM_NULL_ARGUMENT, nm_status::NM_INVALID_ARGUMENT);
        // SAFETY: NULL is allowed; live handles, arrays as long as said.
        unsafe {
            let refuse = |status: nm_status, wanted: nm_status, words: &str| {
                assert_eq!(status, wanted);
                assert!(last_message().starts_with(words), "{}", last_message());
            };
            let good = [1.0; 5];
            let mesh = &raw mut mesh;
            let other = &raw mut other;
            refuse(nm_mesh_set_sizes(null_mut(), 5, good.as_ptr()), null_argument, "mesh is NULL");
            refuse(nm_mesh_set_sizes(mesh, 5, null()), null_argument, "values is NULL");
            let three = nm_mesh_set_sizes(mesh, 3, good.as_ptr());
            refuse(three, invalid, "count is 3; it must be 0 or the 5 inputs");
            for (bad, text) in [(0.0, "0"), (-1.0, "-1"), (f64::NAN, "NaN")] {
                let values = [1.0, bad, 1.0, 1.0, 1.0];
                let status = nm_mesh_set_sizes(mesh, 5, values.as_ptr());
                refuse(status, invalid, &format!("values[1] is {text};"));
            }
            let early = nm_mesh_set_background(mesh, other, 4, good.as_ptr());
            refuse(early, nm_status::NM_STATE, "the mesh has no result yet");
            assert_eq!(nm_run(other, &well_spaced()), nm_status::NM_OK);
            let few = nm_mesh_set_background(mesh, other, 4, good.as_ptr());
            refuse(few, invalid, "count is 4; it must be the");
            let none = nm_mesh_set_background(mesh, other, 4, null());
            refuse(none, null_argument, "values is NULL");
            // Values for what has no sizes.
            assert_eq!(nm_mesh_set_sizes(mesh, 5, good.as_ptr()), nm_status::NM_OK);
            let hierarchical = Options { output: Output::Hierarchical, ..Options::default() };
            let run = nm_run(mesh, &encode(&hierarchical));
            refuse(
                run,
                invalid,
                "nm_mesh_set_sizes is given; it does not go with options.output = NM_OUTPUT_HIER",
            );
        }
    }

    /// A function of C: its point, its user_data, and its answer.
    #[test]
    fn a_function_is_asked_at_points_of_the_box() {
        unsafe extern "C" fn answer(x: *const f64, user_data: *mut c_void) -> f64 {
            // SAFETY: two coordinates, and what the options have.
            let (x, questions) = unsafe { (*x.cast::<[f64; 2]>(), &mut *user_data.cast::<u64>()) };
            *questions += 1;
            if x.iter().all(|x| (0.0..=1.0).contains(x)) { 0.1 } else { f64::NAN }
        }
        let mut mesh = square();
        let mut questions = 0u64;
        let asked = nm_options {
            size: Some(answer),
            size_user_data: (&raw mut questions).cast(),
            ..well_spaced()
        };
        // SAFETY: a live handle and a whole struct.
        assert_eq!(unsafe { nm_run(&mut mesh, &asked) }, nm_status::NM_OK);
        let count = vertices(&mut mesh);
        assert!(
            count > 100 && questions > 100 && questions <= count as u64,
            "{questions}, {count}"
        );
    }
}
