//! Holes of the facets that a mesh was given.

use super::enums::nm_status;
use super::handle::{nm_mesh, with_mesh_mut};
use super::memory::{OutStruct, Versioned};

/// Holes that nm_mesh_close_holes has closed.
#[allow(non_camel_case_types)]
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct nm_closed_holes {
    /// Set by the caller to sizeof(nm_closed_holes).
    pub struct_size: u32,
    /// Zero.
    pub reserved: u32,
    /// Number of holes that were closed.
    pub holes: u64,
    /// Number of triangles that close them, the last of the facets now.
    pub triangles: u64,
    /// Number of edges at which one facet still ends and no other begins.
    pub open_edges: u64,
}

// SAFETY: repr(C), begins with a u32, no padding (checked below), numbers only.
unsafe impl Versioned for nm_closed_holes {
    const TYPE: &'static str = "nm_closed_holes";
}

const _: () = assert!(size_of::<nm_closed_holes>() == 2 * 4 + 3 * 8);

/// Closes holes of the facets that the mesh was given last (nm_mesh_set_facets,
/// nm_mesh_set_triangles, a file): loops of at most max_edges edges at which one facet ends and no
/// other begins. 3D only. The result of a run stays as it is until the next.
///
/// A hole of k edges is closed by k - 2 triangles between its inputs, which become the last facets:
/// nm_mesh_get_facet_parents knows them by numbers from the number of the caller's facets on. Their
/// normals point to where those of the facets round the hole do, and their marker is that of these
/// facets if they have one, otherwise 0. Of all triangles that could close a hole these are bent
/// least, so that a flat facet that is missing is closed within its plane. A hole stays open if
/// only a triangle that is there already, or one without an area, could close it. That triangles do
/// not cross others is not known before nm_run or nm_mesh_get_intersections.
///
/// max_edges: from 3 to 1000. closed: NULL, or the caller sets struct_size.
///
/// Errors: NM_NULL_ARGUMENT (mesh), NM_INVALID_ARGUMENT (a mesh that is not 3D, max_edges,
/// closed->struct_size), NM_CAPACITY (more facets than nm_mesh_set_facets takes), NM_OUT_OF_MEMORY,
/// NM_STATE (another call is using the mesh, or it is poisoned). After an error the facets are as
/// they were.
///
/// O(n log n + sum of k^3) for n triangles and holes of k edges. Before nm_run and after.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_close_holes(
    mesh: *mut nm_mesh,
    max_edges: u32,
    closed: *mut nm_closed_holes,
) -> nm_status {
    // SAFETY: the caller gave NULL or a live handle, and NULL or as many bytes as `struct_size`
    // says.
    unsafe {
        with_mesh_mut(mesh, |mesh| {
            let out = match closed.is_null() {
                true => None,
                false => Some(OutStruct::new("closed", closed)?),
            };
            let found = mesh.close_holes(max_edges as usize)?;
            if let Some(out) = out {
                out.write(&nm_closed_holes {
                    struct_size: size_of::<nm_closed_holes>() as u32,
                    reserved: 0,
                    holes: found.holes as u64,
                    triangles: found.triangles.len() as u64,
                    open_edges: found.open_edges as u64,
                });
            }
            Ok(())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capi::test_support::{last_message, square};
    use crate::mesh::Mesh;
    use std::ptr::null_mut;

    const ROOM: nm_closed_holes = nm_closed_holes {
        struct_size: size_of::<nm_closed_holes>() as u32,
        reserved: 9,
        holes: 9,
        triangles: 9,
        open_edges: 9,
    };

    /// Returns a tetrahedron without its last side.
    fn open() -> nm_mesh {
        let points = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
        let mut mesh = Mesh::new(3, 4, &points, 0).unwrap();
        mesh.set_triangles(&[0, 2, 1, 0, 1, 3, 0, 3, 2], Some(&[5, 5, 5])).unwrap();
        nm_mesh::new(mesh)
    }

    #[test]
    fn closed_holes_are_counted() {
        let mut mesh = open();
        let mut close = |closed: *mut nm_closed_holes| {
            // SAFETY: a live handle, and NULL or a struct.
            let status = unsafe { nm_mesh_close_holes(&mut mesh, 3, closed) };
            assert_eq!(status, nm_status::NM_OK, "{}", last_message());
        };
        let mut closed = ROOM;
        close(&mut closed);
        let expected =
            nm_closed_holes { reserved: 0, holes: 1, triangles: 1, open_edges: 0, ..ROOM };
        assert_eq!(closed, expected);
        close(&mut closed);
        assert_eq!(closed, nm_closed_holes { holes: 0, triangles: 0, ..expected });
        close(null_mut());
    }

    #[test]
    fn bad_arguments_are_refused_by_name() {
        let refused = |mesh: &mut nm_mesh, edges, closed: *mut nm_closed_holes| {
            // SAFETY: a live handle, and NULL or a struct.
            let status = unsafe { nm_mesh_close_holes(mesh, edges, closed) };
            assert_eq!(status, nm_status::NM_INVALID_ARGUMENT);
            last_message()
        };
        for edges in [0, 2, 1001, u32::MAX] {
            let rule = format!("max_edges is {edges}; it must be from 3 to 1000");
            assert_eq!(refused(&mut open(), edges, null_mut()), rule);
        }
        let message = refused(&mut open(), 3, &mut nm_closed_holes { struct_size: 3, ..ROOM });
        assert!(message.starts_with("closed.struct_size is 3;"), "{message}");
        let rule = "the mesh has dimension 2; holes of facets are for 3D";
        assert_eq!(refused(&mut square(), 3, null_mut()), rule);
        // SAFETY: NULL is refused.
        let status = unsafe { nm_mesh_close_holes(null_mut(), 3, null_mut()) };
        assert_eq!((status, &*last_message()), (nm_status::NM_NULL_ARGUMENT, "mesh is NULL"));
    }
}
