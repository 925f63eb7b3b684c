//! Polygons that a mesh was given as triangles.

use super::enums::nm_status;
use super::handle::{nm_mesh, with_mesh_mut};

/// Replaces the polygons that the mesh was given last (nm_mesh_set_facets, a file) by triangles
/// between their inputs, as nm_mesh_set_triangles sets them: for polygons that are not plane, which
/// nm_run refuses. 3D only. The result of a run stays as it is until the next.
///
/// A triangle has the marker of its polygon, and is turned as that is. The view of a polygon along
/// an axis decides which triangles it becomes: that of its plane or, if it has none, the first in
/// which it does not meet itself, beginning with that in which it is largest. A polygon without an
/// area becomes one triangle without one, which nm_run refuses or leaves out. Triangles in one
/// plane are one facet of a mesh, as those of any surface are (coplanar in nm_options). Triangles
/// that were given as such stay.
///
/// polygons: NULL, or gets the number of polygons that have become triangles; 0 if triangles were
/// given, or no facets.
///
/// Errors: NM_NULL_ARGUMENT (mesh), NM_INVALID_ARGUMENT (a mesh that is not 3D; a polygon that has
/// segments within, or meets itself: if it is not plane, seen along each axis), NM_CAPACITY (more
/// triangles than nm_mesh_set_triangles takes), NM_OUT_OF_MEMORY, NM_STATE (another call is using
/// the mesh, or it is poisoned). After an error the facets are as they were.
///
/// O(n log n) for n inputs of polygons. Before nm_run and after.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_triangulate_facets(
    mesh: *mut nm_mesh,
    polygons: *mut u64,
) -> nm_status {
    // SAFETY: the caller gave NULL or a live handle, and NULL or a number.
    unsafe {
        with_mesh_mut(mesh, |mesh| {
            let count = mesh.triangulate_facets()?;
            if !polygons.is_null() {
                polygons.write_unaligned(count as u64);
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

    /// Returns a square whose last corner is off its plane.
    fn bent() -> nm_mesh {
        let points = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.5];
        let mut mesh = Mesh::new(3, 4, &points, 0).unwrap();
        mesh.set_facets(&[0, 1], &[0, 4], &[0, 1, 2, 3], Some(&[7])).unwrap();
        nm_mesh::new(mesh)
    }

    fn triangulate(mesh: &mut nm_mesh, polygons: *mut u64) -> nm_status {
        // SAFETY: a live handle, and NULL or a number.
        unsafe { nm_mesh_triangulate_facets(mesh, polygons) }
    }

    #[test]
    fn polygons_are_counted_once() {
        let (mut mesh, mut count) = (bent(), 9);
        assert_eq!((triangulate(&mut mesh, &mut count), count), (nm_status::NM_OK, 1));
        assert_eq!((triangulate(&mut mesh, &mut count), count), (nm_status::NM_OK, 0));
        assert_eq!(triangulate(&mut bent(), null_mut()), nm_status::NM_OK);
    }

    #[test]
    fn bad_arguments_are_refused_by_name() {
        let mut count = 9;
        assert_eq!(triangulate(&mut square(), &mut count), nm_status::NM_INVALID_ARGUMENT);
        assert_eq!(last_message(), "the mesh has dimension 2; polygons of facets are for 3D");
        // SAFETY: NULL is refused.
        let status = unsafe { nm_mesh_triangulate_facets(null_mut(), &mut count) };
        assert_eq!((status, &*last_message()), (nm_status::NM_NULL_ARGUMENT, "mesh is NULL"));
        assert_eq!(count, 9);
    }
}
