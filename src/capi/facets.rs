//! Facets in space: polygons and triangles, and what a run has made of them.

use super::enums::nm_status;
use super::getters::{get_array, result};
use super::handle::{nm_mesh, with_mesh_mut};
use super::memory::read_rows;
use crate::error::Result;
use crate::mesh::check_starts;

/// Gives the mesh facets, flat polygons that nm_run keeps as triangles of its simplices; 3D only.
/// They replace those of an earlier call, and those of nm_mesh_set_triangles; facets 0 removes
/// them. The result of a run stays as it is until the next.
///
/// facets: their number. Facet i has the loops loop_starts[i] to loop_starts[i + 1] - 1, and loop j
/// the inputs inputs[input_starts[j]] to inputs[input_starts[j + 1] - 1], which are numbers of
/// inputs. loop_starts: facets + 1 numbers, from 0 to the number of loops. input_starts: loops + 1
/// numbers, from 0 to the length of inputs. Both rise: no facet is without a loop, and no loop
/// without an input. markers: a number of the caller's for each facet, or NULL for 0; by
/// nm_mesh_get_facet_parents it is known of each triangle. All are copied.
///
/// A loop of three inputs or more is a polygon, the last input of which is joined to the first. A
/// point is in the facet if an odd number of its polygons surround it: so a polygon in another one
/// is a hole. A loop of two inputs is a segment in the facet, one of one input a vertex in it, as
/// in TetGen's .poly files. A facet has at least one polygon, and its first one tells its normal:
/// that points to where it is seen counterclockwise (nm_options.interior,
/// nm_mesh_get_facet_triangles).
///
/// Facets may stand in the domain, bound it or end in it, and any number of them may meet at a
/// segment. They may meet only in vertices and edges that they share, by numbers of equal points:
/// nm_run refuses others and names the first pair, nm_mesh_get_intersections tells all. Inputs may
/// lie on facets. The vertices of a facet are on a plane up to rounding, or nm_options.coplanar:
/// nm_run refuses others by their numbers.
///
/// Errors: NM_NULL_ARGUMENT (mesh, loop_starts, input_starts, inputs), NM_INVALID_ARGUMENT (a mesh
/// that is not 3D, starts that do not begin with 0 and rise, a number that is no input, a loop with
/// one point twice in a row, a facet without a polygon, an array that is not aligned), NM_CAPACITY
/// (more than 2^32 - 2 facets, loops or inputs of loops), NM_OUT_OF_MEMORY, NM_STATE (another call
/// is using the mesh, or it is poisoned).
///
/// O(length of inputs). Before nm_run and after.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_set_facets(
    mesh: *mut nm_mesh,
    facets: u64,
    loop_starts: *const u64,
    input_starts: *const u64,
    inputs: *const u32,
    markers: *const i32,
) -> nm_status {
    // SAFETY: the caller gave NULL or a live handle, and arrays as long as said.
    unsafe {
        with_mesh_mut(mesh, |mesh| {
            let loop_starts = read_starts("loop_starts", loop_starts, facets)?;
            let loops = loop_starts.last().copied().unwrap_or(0);
            let input_starts = read_starts("input_starts", input_starts, loops)?;
            let count = input_starts.last().copied().unwrap_or(0);
            let inputs = read_rows("inputs", inputs, count, 1)?;
            mesh.set_facets(loop_starts, input_starts, inputs, read_markers(markers, facets)?)
        })
    }
}

/// Gives the mesh the triangles of a surface, which nm_run keeps as triangles of its simplices; 3D
/// only. They replace those of an earlier call, and the facets of nm_mesh_set_facets; count 0
/// removes them. The result of a run stays as it is until the next.
///
/// inputs: three numbers of inputs a triangle; without an area is a triangle of which two are one
/// point. A triangle's normal points to where they are seen counterclockwise. markers: a number of
/// the caller's for each triangle, or NULL for 0; by nm_mesh_get_facet_parents it is known of each
/// triangle of the mesh. Both are copied.
///
/// Triangles that share an edge, have one marker and lie in one plane, up to nm_options.coplanar,
/// are one facet, whose number is that of the first of them: the edges between them need not be
/// edges of the mesh. What holds of the facets of nm_mesh_set_facets holds of triangles.
///
/// Errors: NM_NULL_ARGUMENT (mesh, inputs), NM_INVALID_ARGUMENT (a mesh that is not 3D, a number
/// that is no input, a triangle with one point twice, an array that is not aligned), NM_CAPACITY
/// (count), NM_OUT_OF_MEMORY, NM_STATE (another call is using the mesh, or it is poisoned).
///
/// O(count). Before nm_run and after.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_set_triangles(
    mesh: *mut nm_mesh,
    count: u64,
    inputs: *const u32,
    markers: *const i32,
) -> nm_status {
    // SAFETY: the caller gave NULL or a live handle, and arrays as long as said.
    unsafe {
        with_mesh_mut(mesh, |mesh| {
            let inputs = read_rows("inputs", inputs, count, 3)?;
            mesh.set_triangles(inputs, read_markers(markers, count)?)
        })
    }
}

/// Reads the starts of so many lists, one more than there are lists; none if there are no lists.
/// They are checked before what they lead to is read.
///
/// # Safety
/// `starts` is NULL or has so many numbers and one more, which stay while the slice lives.
unsafe fn read_starts<'a>(name: &str, starts: *const u64, lists: u64) -> Result<&'a [u64]> {
    if lists == 0 {
        return Ok(&[]);
    }
    // SAFETY: the caller's promise.
    let starts = unsafe { read_rows(name, starts, lists.saturating_add(1), 1)? };
    check_starts(name, starts)?;
    Ok(starts)
}

/// Reads `count` markers, if there are any.
///
/// # Safety
/// `markers` is NULL or has `count` numbers that stay while the slice lives.
pub(super) unsafe fn read_markers<'a>(
    markers: *const i32,
    count: u64,
) -> Result<Option<&'a [i32]>> {
    if markers.is_null() {
        return Ok(None);
    }
    // SAFETY: the caller's promise.
    unsafe { read_rows("markers", markers, count, 1).map(Some) }
}

/// Writes the triangles that facets have become: three vertex ids a triangle, counterclockwise
/// where the normal of the facet points to; by facets, those of hulls and boxes last. Each is a
/// facet of a simplex of the mesh: there are none of what is outside of the domain. None without
/// facets.
///
/// Array getter, see the top of this file. Errors: NM_NULL_ARGUMENT (mesh), NM_CAPACITY,
/// NM_INVALID_ARGUMENT (buf not aligned), NM_STATE (before nm_run, nm_run at work, poisoned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_facet_triangles(
    mesh: *const nm_mesh,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's rules are those of `get_array`.
    unsafe {
        get_array(mesh, buf, capacity, needed, |mesh| {
            Ok(result(mesh)?.boundary.subfacets.as_flattened())
        })
    }
}

/// Writes for each triangle of nm_mesh_get_facet_triangles the facet that it is a part of: its
/// number in nm_mesh_set_facets or nm_mesh_set_triangles, of triangles that are one facet the
/// first; NM_NONE for the boundary of a hull or box.
///
/// Array getter, see the top of this file. Errors: NM_NULL_ARGUMENT (mesh), NM_CAPACITY,
/// NM_INVALID_ARGUMENT (buf not aligned), NM_STATE (before nm_run, nm_run at work, poisoned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_facet_parents(
    mesh: *const nm_mesh,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's rules are those of `get_array`.
    unsafe {
        get_array(mesh, buf, capacity, needed, |mesh| Ok(&result(mesh)?.boundary.subfacet_parents))
    }
}

/// Writes for each triangle of nm_mesh_get_facet_triangles the two simplices that have it: first
/// the one where the normal of the facet points to, then the one behind; NM_NONE where the domain
/// ends. (nm_mesh_get_facet_simplices tells those of all facets of simplices.)
///
/// Array getter, see the top of this file. Errors: NM_NULL_ARGUMENT (mesh), NM_CAPACITY,
/// NM_INVALID_ARGUMENT (buf not aligned), NM_STATE (before nm_run, nm_run at work, poisoned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_facet_triangle_simplices(
    mesh: *const nm_mesh,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's rules are those of `get_array`.
    unsafe {
        get_array(mesh, buf, capacity, needed, |mesh| {
            Ok(result(mesh)?.boundary.subfacet_simplices.as_flattened())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capi::handle::with_prepared;
    use crate::capi::test_support::{last_message, square};
    use crate::mesh::{Mesh, NONE};
    use std::ptr::{null, null_mut};

    /// Returns a mesh of the corners of the unit cube, of which the last coordinate changes first.
    fn cube() -> Mesh {
        let points: Vec<f64> =
            (0..24).map(|at| f64::from(((at / 3) >> (2 - at % 3)) & 1)).collect();
        Mesh::new(3, 8, &points, 0).unwrap()
    }

    /// Sides of the cube.
    const SIDES: [[u32; 4]; 6] =
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];

    #[test]
    fn facets_and_triangles_reach_the_mesh() {
        let (loops, starts): (Vec<u64>, Vec<u64>) =
            ((0..=6).collect(), (0..=6).map(|side| 4 * side).collect());
        let (sides, markers) = (SIDES.as_flattened(), [1, 2, 3, 4, 5, -6]);
        let own = nm_mesh::new(cube());
        let given = || {
            let mut given = None;
            // SAFETY: a live handle.
            let status = unsafe {
                with_prepared(&raw const own, |mesh, _| {
                    given = Some(mesh.given_facets().clone());
                    Ok(())
                })
            };
            assert_eq!(status, nm_status::NM_OK);
            given.unwrap()
        };
        let mesh = (&raw const own).cast_mut();
        // SAFETY: a live handle; the arrays fit the counts.
        let status = unsafe {
            nm_mesh_set_facets(
                mesh,
                6,
                loops.as_ptr(),
                starts.as_ptr(),
                sides.as_ptr(),
                markers.as_ptr(),
            )
        };
        assert_eq!(status, nm_status::NM_OK, "{}", last_message());
        let facets = given();
        let is_side = |at: usize| facets.loops(at).eq([&SIDES[at][..]]);
        assert!(facets.count() == 6 && (0..6).all(is_side) && facets.markers == markers);
        // SAFETY: a live handle; the array fits the count.
        let status =
            unsafe { nm_mesh_set_triangles(mesh, 2, [0, 1, 3, 6, 2, 99].as_ptr(), null()) };
        assert_eq!(status, nm_status::NM_INVALID_ARGUMENT);
        assert!(last_message().starts_with("triangles[1] has the input 99; it must be less than"));
        assert_eq!(given(), facets, "after a refusal");
        // SAFETY: as above.
        let status = unsafe { nm_mesh_set_triangles(mesh, 1, sides.as_ptr(), markers.as_ptr()) };
        assert_eq!(status, nm_status::NM_OK, "{}", last_message());
        let triangle = given();
        assert!(triangle.are_triangles && triangle.loops(0).eq([&[0, 1, 3][..]]));
        assert_eq!((triangle.count(), &*triangle.markers), (1, &[1][..]));
        // SAFETY: a live handle; nothing is read of no facets.
        let status = unsafe { nm_mesh_set_facets(mesh, 0, null(), null(), null(), null()) };
        assert_eq!((status, given().count()), (nm_status::NM_OK, 0));
        // SAFETY: a live handle; nothing is read of no triangles.
        let status = unsafe { nm_mesh_set_triangles(mesh, 0, null(), null()) };
        assert_eq!((status, given().count()), (nm_status::NM_OK, 0));
    }

    #[test]
    fn bad_facets_are_refused_by_name() {
        let mut mesh = nm_mesh::new(cube());
        let (loops, starts, inputs) = ([0, 1_u64], [0, 4_u64], [0, 1, 3, 2_u32]);
        let mut set = |facets, loops: *const u64, starts: *const u64, inputs: *const u32| {
            // SAFETY: a live handle; the arrays fit the counts, or are NULL, or are refused before
            // they are read.
            let status =
                unsafe { nm_mesh_set_facets(&mut mesh, facets, loops, starts, inputs, null()) };
            (status, if status == nm_status::NM_OK { String::new() } else { last_message() })
        };
        let (loops, starts, inputs) = (loops.as_ptr(), starts.as_ptr(), inputs.as_ptr());
        assert_eq!(set(1, loops, starts, inputs), (nm_status::NM_OK, String::new()));
        let missing = |name: &str| (nm_status::NM_NULL_ARGUMENT, format!("{name} is NULL"));
        assert_eq!(set(1, null(), starts, inputs), missing("loop_starts"));
        assert_eq!(set(1, loops, null(), inputs), missing("input_starts"));
        assert_eq!(set(1, loops, starts, null()), missing("inputs"));
        // Starts that do not rise are refused before more is read of where they lead to.
        let refused = |message: &str| (nm_status::NM_INVALID_ARGUMENT, message.to_owned());
        let (one, falls) = ([1, u64::MAX], [0, u64::MAX, 5]);
        let first = refused("loop_starts[0] is 1; it must be 0");
        assert_eq!(set(1, one.as_ptr(), null(), null()), first);
        let rise = "input_starts[2] is 5 and input_starts[1] is 18446744073709551615; starts must \
                    rise, since no list is empty";
        assert_eq!(set(1, [0, 2].as_ptr(), falls.as_ptr(), null()), refused(rise));
        let (status, message) = set(u64::MAX, loops, starts, inputs);
        assert_eq!(status, nm_status::NM_INVALID_ARGUMENT);
        assert!(message.starts_with("loop_starts would hold"), "{message}");
        // SAFETY: a live handle; nothing is read.
        let status = unsafe { nm_mesh_set_triangles(&mut mesh, 1, null(), null()) };
        assert_eq!((status, last_message()), missing("inputs"));
        // SAFETY: a live handle; nothing is read of no triangles.
        let status = unsafe { nm_mesh_set_triangles(&mut square(), 0, null(), null()) };
        let rule = "the mesh has dimension 2; triangles are for 3D";
        assert_eq!((status, &*last_message()), (nm_status::NM_INVALID_ARGUMENT, rule));
    }

    #[test]
    fn facets_of_a_result_are_told() {
        let mut mesh = cube();
        mesh.run(&Default::default(), None).unwrap();
        let mut made = mesh.triangulation().unwrap().clone();
        made.boundary.subfacets = vec![[0, 1, 3], [0, 3, 2], [4, 6, 7]];
        made.boundary.subfacet_parents = vec![0, 0, NONE];
        made.boundary.subfacet_simplices = vec![[1, 0], [NONE, 2], [3, NONE]];
        let mesh = nm_mesh::new(Mesh::from_parts(mesh.inputs().clone(), made));
        type Getter = unsafe extern "C" fn(*const nm_mesh, *mut u32, u64, *mut u64) -> nm_status;
        let getters: [(Getter, &[u32]); 3] = [
            (nm_mesh_get_facet_triangles, &[0, 1, 3, 0, 3, 2, 4, 6, 7]),
            (nm_mesh_get_facet_parents, &[0, 0, NONE]),
            (nm_mesh_get_facet_triangle_simplices, &[1, 0, NONE, 2, 3, NONE]),
        ];
        for (getter, expected) in getters {
            let (mut needed, mut values) = (0, [7; 9]);
            // SAFETY: a live handle; NULL asks for the size.
            let status = unsafe { getter(&mesh, null_mut(), 0, &mut needed) };
            assert_eq!((status, needed), (nm_status::NM_OK, expected.len() as u64));
            // SAFETY: the buffer has room for 9.
            let status = unsafe { getter(&mesh, values.as_mut_ptr(), needed, null_mut()) };
            assert_eq!((status, &values[..expected.len()]), (nm_status::NM_OK, expected));
            // SAFETY: a live handle; NULL asks for the size.
            let status = unsafe { getter(&square(), null_mut(), 0, &mut needed) };
            assert_eq!(status, nm_status::NM_STATE);
        }
    }
}
