//! Points that are as good as one, made equal.

use super::enums::nm_status;
use super::handle::barrier;
use super::memory::rows_out;
use crate::nearest::merge_points;

/// Gives points that are nearly others the coordinates of these: for surfaces whose corners a
/// program has written several times, with other roundings. Such a surface is open there and
/// touches itself; netmesh never takes points for one that differ. Call it before nm_mesh_create,
/// which makes one vertex of equal points. A triangle of which two corners become one has no area:
/// leave it out.
///
/// dim: 2 or 3. n: the number of points. coordinates: dim of each point, without gaps; points that
/// are at most ratio times the diagonal of the box of all from an earlier one get its coordinates,
/// and so do chains of such points. ratio: from 0 to 0.001; roundings are explained by 1e-9.
/// moved: receives the number of points that were moved, unless it is NULL.
///
/// Errors: NM_NULL_ARGUMENT (coordinates while n > 0), NM_INVALID_ARGUMENT (dim, ratio, a size
/// beyond the address space, coordinates not aligned to a double), NM_NON_FINITE, NM_OUT_OF_MEMORY.
/// After an error the coordinates are as they were.
///
/// O(n log n) where few points are near each other. Any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_merge_points(
    dim: u32,
    n: u64,
    coordinates: *mut f64,
    ratio: f64,
    moved: *mut u64,
) -> nm_status {
    barrier(|| {
        let dim = dim as usize;
        // SAFETY: the caller gave NULL or `n` points that nothing else uses during the call.
        let own = unsafe { rows_out("coordinates", coordinates, n, dim)? };
        let found = merge_points(dim, own, ratio)? as u64;
        if !moved.is_null() {
            // SAFETY: the caller's number, which need not be aligned.
            unsafe { moved.write_unaligned(found) };
        }
        Ok(())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capi::test_support::last_message;
    use std::ptr::null_mut;

    #[test]
    fn points_are_moved_and_counted() {
        let mut points = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1e-17, 0.0, 3e-33, 0.0, 1.0, 0.0];
        let mut moved = 9;
        // SAFETY: four points and a number.
        let status = unsafe { nm_merge_points(3, 4, points.as_mut_ptr(), 1e-9, &mut moved) };
        assert_eq!((status, moved), (nm_status::NM_OK, 1));
        assert_eq!(points, [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
        // SAFETY: six points.
        let status = unsafe { nm_merge_points(2, 6, points.as_mut_ptr(), 1e-9, null_mut()) };
        assert_eq!(status, nm_status::NM_OK);
        // SAFETY: no point.
        let status = unsafe { nm_merge_points(2, 0, null_mut(), 0.0, &mut moved) };
        assert_eq!((status, moved), (nm_status::NM_OK, 0));
    }

    #[test]
    fn what_cannot_be_merged_is_refused_by_name() {
        let mut points = [0.0, 1e-17, 1.0, f64::NAN];
        let before = points.map(f64::to_bits);
        let mut refused = |dim, n, ratio| {
            let mut moved = 9;
            // SAFETY: at most two points in the plane, of which less is read where it is refused.
            let status = unsafe { nm_merge_points(dim, n, points.as_mut_ptr(), ratio, &mut moved) };
            assert_eq!(moved, 9);
            assert_eq!(points.map(f64::to_bits), before);
            (status, last_message())
        };
        let (invalid, non_finite) = (nm_status::NM_INVALID_ARGUMENT, nm_status::NM_NON_FINITE);
        let rule = "ratio is 0.5; it must be from 0 to 0.001".to_owned();
        assert_eq!(refused(2, 1, 0.5), (invalid, rule));
        for dim in [0, 1, 4] {
            let rule = format!("dim is {dim}; points are merged in 2D and 3D");
            assert_eq!(refused(dim, 1, 0.0), (invalid, rule));
        }
        let rule = "coordinates[3] is NaN; it must be finite".to_owned();
        assert_eq!(refused(2, 2, 0.0), (non_finite, rule));
        let rule = "coordinates would hold 18446744073709551615 numbers, more than there is memory";
        assert_eq!(refused(2, u64::MAX, 0.0), (invalid, rule.to_owned()));
        // SAFETY: NULL is refused.
        let status = unsafe { nm_merge_points(2, 1, null_mut(), 0.0, null_mut()) };
        let rule = "coordinates is NULL".to_owned();
        assert_eq!((status, last_message()), (nm_status::NM_NULL_ARGUMENT, rule));
    }
}
