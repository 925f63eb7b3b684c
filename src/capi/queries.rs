//! Questions to a result: location, nearest vertices, interpolation.

use super::decode::decode_interpolation;
use super::enums::{nm_interpolation, nm_status};
use super::getters::result;
use super::handle::{nm_mesh, with_mesh, with_prepared};
use super::memory::{read_rows, rows_out};
use crate::error::{Error, Result, message};
use crate::mesh::Mesh;
use crate::prepared::extend_values;
use crate::query::{Among, Values};
use std::mem::MaybeUninit;

/// Makes the index that queries need, unless it is there, and tells its size. Queries make it
/// themselves; with this call the first of them takes no longer than the others. nm_run drops it.
///
/// bytes: receives the size of the index, about 8 dim + 11 bytes a vertex, and as much again but
/// for 4 bytes an input if there are other vertices; may be NULL.
///
/// Errors: NM_NULL_ARGUMENT (mesh), NM_OUT_OF_MEMORY, NM_STATE (no result yet, nm_run at work,
/// poisoned).
///
/// O(simplices + vertices log vertices).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_index(mesh: *const nm_mesh, bytes: *mut u64) -> nm_status {
    // SAFETY: the caller gave NULL or a live handle.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            result(mesh)?;
            let size = prepared.index(mesh)?.bytes() as u64;
            if !bytes.is_null() {
                bytes.write_unaligned(size);
            }
            Ok(())
        })
    }
}

/// Finds the simplex that holds each of count points, by exact signs.
///
/// points: count x dim coordinates, which must be finite. They may come in any order: they are
/// sorted inside. threads: threads to use, 0 = all cores; no answer depends on it. simplices:
/// receives count ids, NM_NONE for a point outside the hull; on a face that several simplices
/// share, the least of them. points and simplices may be NULL if count is 0, and must not overlap.
///
/// The first query of a result makes an index (nm_mesh_index).
///
/// Errors: NM_NULL_ARGUMENT (mesh, points, simplices), NM_NON_FINITE (the message names the point
/// and the coordinate), NM_INVALID_ARGUMENT (count beyond the address space, an array not aligned),
/// NM_OUT_OF_MEMORY (what simplices holds then is unspecified), NM_STATE (no result yet, nm_run at
/// work, poisoned).
///
/// O(log vertices) expected time for a point in meshes of bounded degree. Any number of threads may
/// ask one mesh at the same time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_locate(
    mesh: *const nm_mesh,
    count: u64,
    points: *const f64,
    threads: u32,
    simplices: *mut u32,
) -> nm_status {
    // SAFETY: the caller's arrays have the lengths that the manual asks for.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            let result = result(mesh)?;
            let points = read_rows("points", points, count, result.dim)?;
            let simplices = rows_out("simplices", simplices, count, 1)?;
            prepared.index(mesh)?.locate(result, points, threads, simplices)
        })
    }
}

/// Finds the vertex nearest to each of count points; of several at the same exact distance the
/// least.
///
/// points, threads: as for nm_mesh_locate. vertices: receives count ids. distances: receives count
/// distances, each within dim + 4 units of 2^-53, infinite only beyond the doubles. No array may be
/// NULL unless count is 0; they must not overlap.
///
/// Errors: as nm_mesh_locate, with vertices and distances in place of simplices. O(log vertices)
/// expected time for a point that is not far from all vertices.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_nearest(
    mesh: *const nm_mesh,
    count: u64,
    points: *const f64,
    threads: u32,
    vertices: *mut u32,
    distances: *mut f64,
) -> nm_status {
    // SAFETY: the caller's arrays have the lengths that the manual asks for.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            let result = result(mesh)?;
            let points = read_rows("points", points, count, result.dim)?;
            let vertices = rows_out("vertices", vertices, count, 1)?;
            let (distances, among) = (rows_out("distances", distances, count, 1)?, Among::Vertices);
            prepared.index(mesh)?.nearest(result, among, points, threads, vertices, distances)
        })
    }
}

/// Finds the input nearest to each of count points: its number among the caller's points, of equal
/// ones the first (nm_mesh_get_input_vertices has the vertex); of several at the same exact
/// distance the least.
///
/// points, threads: as for nm_mesh_locate. inputs: receives count numbers. distances: receives
/// count distances, each within dim + 4 units of 2^-53, infinite only beyond the doubles. No array
/// may be NULL unless count is 0; they must not overlap.
///
/// Errors: as nm_mesh_nearest, with inputs in place of vertices.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_nearest_input(
    mesh: *const nm_mesh,
    count: u64,
    points: *const f64,
    threads: u32,
    inputs: *mut u32,
    distances: *mut f64,
) -> nm_status {
    // SAFETY: the caller's arrays have the lengths that the manual asks for.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            let points = read_rows("points", points, count, result(mesh)?.dim)?;
            let inputs = rows_out("inputs", inputs, count, 1)?;
            let distances = rows_out("distances", distances, count, 1)?;
            prepared.nearest_inputs(mesh, points, threads, inputs, distances)
        })
    }
}

/// Interpolates values that are given at the vertices.
///
/// components: numbers a vertex, at least 1. values: vertices x components numbers
/// (nm_mesh_counts); they need not be finite, and one counts only where its vertex has a weight.
/// points, threads: as for nm_mesh_locate. out: receives count x components numbers. The arrays
/// must not overlap.
///
/// Errors: NM_NULL_ARGUMENT (mesh, values, points, out), NM_INVALID_ARGUMENT (interpolation,
/// components, a size beyond the address space, an array not aligned), and as nm_mesh_locate with
/// out in place of simplices.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_interpolate(
    mesh: *const nm_mesh,
    interpolation: MaybeUninit<nm_interpolation>,
    components: u32,
    values: *const f64,
    count: u64,
    points: *const f64,
    threads: u32,
    out: *mut f64,
) -> nm_status {
    // SAFETY: the caller's arrays have the lengths that the manual asks for.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            let result = result(mesh)?;
            let method = decode_interpolation(interpolation)?;
            let components = some_components(components)?;
            let values = read_rows("values", values, result.vertex_count() as u64, components)?;
            let points = read_rows("points", points, count, result.dim)?;
            let out = rows_out("out", out, count, components)?;
            let values = Values { components, values };
            prepared.index(mesh)?.interpolate(result, method, values, points, threads, out)
        })
    }
}

/// Extends values at the inputs to all vertices: linear in the Delaunay triangulation of the
/// inputs, those of the nearest input beyond its hull, and everywhere if the inputs lie in a
/// hyperplane.
///
/// components: numbers an input, at least 1. input_values: inputs x components numbers, duplicates
/// included; of equal inputs the first counts. vertex_values: receives vertices x components
/// numbers, those of an input's vertex unchanged. The arrays must not overlap.
///
/// Errors: NM_NULL_ARGUMENT (mesh, input_values, vertex_values), NM_INVALID_ARGUMENT (components,
/// an array not aligned), NM_OUT_OF_MEMORY (what vertex_values holds then is unspecified), NM_STATE
/// (no result yet, nm_run at work, poisoned).
///
/// Each call triangulates the inputs, which may take time and memory of order n^ceil(dim/2): pass
/// all components at once. As many threads as nm_options.threads of the run allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_extend_values(
    mesh: *const nm_mesh,
    components: u32,
    input_values: *const f64,
    vertex_values: *mut f64,
) -> nm_status {
    let body = |mesh: &Mesh| {
        let vertices = result(mesh)?.vertex_count() as u64;
        let components = some_components(components)?;
        let inputs = mesh.inputs().count() as u64;
        // SAFETY: the caller's arrays have the lengths that the manual asks for.
        let (values, out) = unsafe {
            let values = read_rows("input_values", input_values, inputs, components)?;
            (values, rows_out("vertex_values", vertex_values, vertices, components)?)
        };
        extend_values(mesh, Values { components, values }, out)
    };
    // SAFETY: the caller gave NULL or a live handle.
    unsafe { with_mesh(mesh, body) }
}

fn some_components(components: u32) -> Result<usize> {
    if components > 0 {
        return Ok(components as usize);
    }
    let message = message!("components is {components}; it must be at least 1");
    Err(Error::invalid(message))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capi::handle::with_mesh_mut;
    use crate::capi::test_support::{from_c, last_message, square};
    use crate::mesh::NONE;
    use crate::options::{Algorithm, Options};
    use std::ptr::{null, null_mut};

    /// Returns the unit square as two triangles.
    fn meshed() -> nm_mesh {
        let points = [0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0];
        let mut mesh = Mesh::new(2, 4, &points, 0).expect("four good points");
        let options = Options { algorithm: Algorithm::Delaunay, ..Options::default() };
        mesh.run(&options, None).expect("a mesh");
        nm_mesh::new(mesh)
    }

    const POINTS: [f64; 6] = [0.9, 0.4, 0.5, 0.5, 2.0, 1.5];

    #[test]
    fn each_query_answers() {
        let mesh = meshed();
        let (mut simplices, mut vertices, mut distances) = ([7; 3], [7; 3], [7.0; 3]);
        let mut bytes = 0;
        // SAFETY: a live handle and arrays of three points.
        let statuses = unsafe {
            [
                nm_mesh_index(&mesh, &mut bytes),
                nm_mesh_index(&mesh, null_mut()),
                nm_mesh_locate(&mesh, 3, POINTS.as_ptr(), 1, simplices.as_mut_ptr()),
                nm_mesh_nearest(
                    &mesh,
                    3,
                    POINTS.as_ptr(),
                    2,
                    vertices.as_mut_ptr(),
                    distances.as_mut_ptr(),
                ),
            ]
        };
        assert_eq!(statuses, [nm_status::NM_OK; 4]);
        assert!(bytes > 0 && simplices[0] < 2 && simplices[1] == 0 && simplices[2] == NONE);
        assert_eq!((vertices[1], vertices[2], distances[1]), (0, 2, 0.5f64.sqrt()));
        let mut inputs = [7; 3];
        // SAFETY: as above.
        let status = unsafe {
            nm_mesh_nearest_input(
                &mesh,
                3,
                POINTS.as_ptr(),
                0,
                inputs.as_mut_ptr(),
                distances.as_mut_ptr(),
            )
        };
        assert_eq!((status, inputs), (nm_status::NM_OK, vertices));
        // Each corner but the last one is given twice.
        let twice = [0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0];
        let mut repeated = Mesh::new(2, 7, &twice, 0).expect("four good points");
        repeated.run(&Options::default(), None).expect("a mesh");
        let (repeated, at) = (nm_mesh::new(repeated), [0.9, 0.1, 0.9, 0.8, 0.1, 0.9]);
        // SAFETY: as above.
        let status = unsafe {
            nm_mesh_nearest_input(
                &repeated,
                3,
                at.as_ptr(),
                0,
                inputs.as_mut_ptr(),
                distances.as_mut_ptr(),
            )
        };
        assert_eq!((status, inputs), (nm_status::NM_OK, [2, 4, 5]));
        // SAFETY: NULL is allowed where there are no points.
        let none = unsafe { nm_mesh_locate(&mesh, 0, null(), 1, null_mut()) };
        assert_eq!(none, nm_status::NM_OK);
    }

    #[test]
    fn values_are_interpolated_and_extended() {
        let mesh = meshed();
        let values = [0.0, 10.0, 1.0, 20.0, 2.0, 30.0, 1.0, 0.0];
        let (mut out, mut all) = ([7.0; 6], [0.0; 8]);
        for (method, outside) in [(0, f64::NAN), (1, f64::NAN), (2, f64::NAN), (16, 2.0), (18, 2.0)]
        {
            // SAFETY: a live handle; four vertices and three points of two components.
            let status = unsafe {
                nm_mesh_interpolate(
                    &mesh,
                    from_c(method),
                    2,
                    values.as_ptr(),
                    3,
                    POINTS.as_ptr(),
                    1,
                    out.as_mut_ptr(),
                )
            };
            assert_eq!(status, nm_status::NM_OK);
            assert!((out[0] - 1.3).abs() < 1e-12 && (out[2] - 1.0).abs() < 1e-12, "{out:?}");
            assert!(out[4] == outside || out[4].is_nan() && outside.is_nan(), "{method}");
        }
        // SAFETY: as above.
        let status = unsafe { nm_mesh_extend_values(&mesh, 2, values.as_ptr(), all.as_mut_ptr()) };
        assert_eq!((status, all), (nm_status::NM_OK, values));
    }

    #[test]
    fn bad_arguments_are_named_and_change_nothing() {
        let mesh = meshed();
        let (mut ids, mut out) = ([7; 3], [7.0; 6]);
        let values = [0.0; 8];
        let wrong = [0.0, 0.0, 1.0, f64::NAN, f64::INFINITY, 0.0];
        let odd = POINTS.as_ptr().cast::<u8>().wrapping_add(1).cast();
        // SAFETY: NULL, or arrays that are long enough, or sizes that are refused unread.
        unsafe {
            let locate = |count, points, ids: *mut u32, status, message: &str| {
                assert_eq!(nm_mesh_locate(&mesh, count, points, 1, ids), status, "{message}");
                assert!(last_message().starts_with(message), "{} {message}", last_message());
            };
            let points = POINTS.as_ptr();
            locate(3, null(), ids.as_mut_ptr(), nm_status::NM_NULL_ARGUMENT, "points is NULL");
            locate(3, points, null_mut(), nm_status::NM_NULL_ARGUMENT, "simplices is NULL");
            locate(
                3,
                wrong.as_ptr(),
                ids.as_mut_ptr(),
                nm_status::NM_NON_FINITE,
                "points[1] has a non-finite coordinate 1",
            );
            locate(
                u64::MAX,
                points,
                ids.as_mut_ptr(),
                nm_status::NM_INVALID_ARGUMENT,
                "points would hold",
            );
            locate(3, odd, ids.as_mut_ptr(), nm_status::NM_INVALID_ARGUMENT, "points is not");
            let mut interpolate = |method, components, status, message: &str| {
                let (out, values) = (out.as_mut_ptr(), values.as_ptr());
                let found = nm_mesh_interpolate(
                    &mesh,
                    from_c(method),
                    components,
                    values,
                    3,
                    points,
                    1,
                    out,
                );
                assert_eq!(found, status, "{message}");
                assert!(last_message().starts_with(message), "{} {message}", last_message());
            };
            let invalid = nm_status::NM_INVALID_ARGUMENT;
            interpolate(3, 1, invalid, "interpolation is 3");
            interpolate(-1, 1, invalid, "interpolation is -1");
            interpolate(32, 1, invalid, "interpolation is 32");
            interpolate(0, 0, invalid, "components is 0");
            let status = nm_mesh_extend_values(&mesh, 1, null(), out.as_mut_ptr());
            assert_eq!(status, nm_status::NM_NULL_ARGUMENT);
            assert_eq!(last_message(), "input_values is NULL");
            assert_eq!(nm_mesh_index(null(), null_mut()), nm_status::NM_NULL_ARGUMENT);
        }
        assert_eq!((ids, out), ([7; 3], [7.0; 6]));
    }

    #[test]
    fn queries_need_a_result_and_no_run() {
        let before = square();
        let mut ids = [7; 3];
        // SAFETY: live handles and arrays of three points.
        unsafe {
            let status = nm_mesh_locate(&before, 3, POINTS.as_ptr(), 1, ids.as_mut_ptr());
            assert_eq!(status, nm_status::NM_STATE);
            assert!(last_message().contains("nm_run must succeed first"));
            let mesh = meshed();
            let status = with_mesh_mut(&mesh, |_| {
                let status = nm_mesh_locate(&mesh, 3, POINTS.as_ptr(), 1, ids.as_mut_ptr());
                assert_eq!(status, nm_status::NM_STATE);
                Ok(())
            });
            assert_eq!(status, nm_status::NM_OK);
        }
        assert_eq!(ids, [7; 3]);
    }

    #[test]
    fn a_run_drops_the_index() {
        let mesh = meshed();
        let size = || {
            let mut bytes = 0;
            // SAFETY: a live handle.
            assert_eq!(unsafe { nm_mesh_index(&mesh, &mut bytes) }, nm_status::NM_OK);
            bytes
        };
        let before = size();
        // SAFETY: a live handle.
        let status = unsafe { with_mesh_mut(&mesh, |mesh| mesh.run(&Options::default(), None)) };
        assert_eq!(status, nm_status::NM_OK);
        assert!(size() > before);
    }
}
