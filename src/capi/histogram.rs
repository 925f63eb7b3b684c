//! Histograms of the quality.

use super::decode::decode_measure;
use super::enums::nm_status;
use super::getters::result;
use super::handle::{nm_mesh, with_mesh};
use super::memory::{read_rows, rows_out};
use crate::error::{Error, message};
use crate::mesh::Mesh;
use crate::quality::{Measure, histogram};
use std::mem::MaybeUninit;

/// Counts how many values of a measure lie between edges, as numpy.histogram does.
///
/// at_hull: 0 leaves out the simplices with a vertex on the hull, as nm_quality does; 1 counts them
/// too. Without effect on NM_MEASURE_ASPECT. Simplices beyond the hull are never counted.
///
/// edges: edge_count numbers, at least 1, each above the one before; infinities are allowed. In
/// degrees for angles, otherwise without unit.
///
/// counts: room for edge_count + 1 numbers. counts[0] receives how many values are below edges[0],
/// counts[i] how many are in [edges[i - 1], edges[i]) for 0 < i < edge_count, counts[edge_count]
/// how many are above the last edge. Of two edges and more the last bin includes the last edge.
/// One edge makes no bin: counts[0] is what is below it, counts[1] the rest.
///
/// extremes: room for 2 numbers, the least and the largest value; infinity and minus infinity if
/// there is none. May be NULL.
///
/// Errors: NM_NULL_ARGUMENT (mesh, edges, counts), NM_INVALID_ARGUMENT (measure, at_hull,
/// edge_count, edges, a pointer not aligned), NM_OUT_OF_MEMORY, NM_STATE (no result yet, nm_run at
/// work, poisoned).
///
/// O((vertices + simplices) log(edge_count)). The arrays of the mesh alone count, so the same mesh
/// gives the same answer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_quality_histogram(
    mesh: *const nm_mesh,
    measure: MaybeUninit<Measure>,
    at_hull: u32,
    edge_count: u64,
    edges: *const f64,
    counts: *mut u64,
    extremes: *mut f64,
) -> nm_status {
    let body = |mesh: &Mesh| {
        let measure = decode_measure(measure)?;
        if at_hull > 1 {
            let message = message!("at_hull is {at_hull}; it must be 0 or 1");
            return Err(Error::invalid(message));
        }
        // SAFETY: the caller gave NULL or as many numbers as the manual says.
        let edges = unsafe { read_rows("edges", edges, edge_count, 1)? };
        // SAFETY: as above.
        let counts = unsafe { rows_out("counts", counts, edge_count.saturating_add(1), 1)? };
        let extremes = match extremes.is_null() {
            true => None,
            // SAFETY: as above.
            false => Some(unsafe { rows_out("extremes", extremes, 2, 1)? }),
        };
        let found = histogram(result(mesh)?, measure, at_hull == 1, edges)?;
        counts.copy_from_slice(&found.counts);
        if let Some(extremes) = extremes {
            extremes.copy_from_slice(&[found.least, found.largest]);
        }
        Ok(())
    };
    // SAFETY: the caller gave NULL or a live handle.
    unsafe { with_mesh(mesh, body) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capi::run::nm_run;
    use crate::capi::test_support::{from_c, last_message, square};
    use std::ptr::{null, null_mut};

    const ANGLE: Measure = Measure::DihedralAngle;

    fn meshed() -> nm_mesh {
        let mut mesh = square();
        // SAFETY: a live handle; NULL is allowed.
        let status = unsafe { nm_run(&mut mesh, null()) };
        assert_eq!(status, nm_status::NM_OK);
        mesh
    }

    fn call(mesh: &nm_mesh, measure: i32, at_hull: u32, edges: &[f64]) -> (nm_status, Vec<u64>) {
        let mut counts = vec![77; edges.len() + 1];
        let (count, measure) = (edges.len() as u64, from_c(measure));
        let (edges, out) = (edges.as_ptr(), counts.as_mut_ptr());
        // SAFETY: arrays of the right lengths.
        let status = unsafe {
            nm_mesh_quality_histogram(mesh, measure, at_hull, count, edges, out, null_mut())
        };
        (status, counts)
    }

    #[test]
    fn the_values_are_counted_and_the_extremes_told() {
        let mesh = meshed();
        let (edges, mut counts, mut extremes) = ([0.0, 60.0, 180.0], [0; 4], [0.0; 2]);
        // SAFETY: arrays of the right lengths.
        let status = unsafe {
            let measure = MaybeUninit::new(ANGLE);
            let (edges, extremes) = (edges.as_ptr(), extremes.as_mut_ptr());
            nm_mesh_quality_histogram(&mesh, measure, 1, 3, edges, counts.as_mut_ptr(), extremes)
        };
        assert_eq!(status, nm_status::NM_OK);
        let simplices = count_of_simplices(&mesh);
        assert_eq!(counts.iter().sum::<u64>(), 3 * simplices);
        assert_eq!((counts[0], counts[3]), (0, 0));
        assert!(extremes[0] > 0.0 && extremes[0] < 60.0 && extremes[1] > 60.0, "{extremes:?}");
        let off_hull: u64 = call(&mesh, 0, 0, &edges).1.iter().sum();
        assert!(off_hull > 0 && off_hull < 3 * simplices);
    }

    fn count_of_simplices(mesh: &nm_mesh) -> u64 {
        let all = call(mesh, Measure::RadiusEdge as i32, 1, &[0.0]).1;
        assert_eq!(all[0], 0);
        all[1]
    }

    #[test]
    fn what_is_wrong_is_named_and_nothing_written() {
        let mesh = meshed();
        let refuse = |(status, counts): (nm_status, Vec<u64>)| {
            assert_eq!(status, nm_status::NM_INVALID_ARGUMENT);
            assert!(counts.iter().all(|&count| count == 77));
            last_message()
        };
        assert_eq!(
            refuse(call(&mesh, 4, 0, &[0.0])),
            "measure is 4; it must be one of nm_measure, 0 to 3"
        );
        assert_eq!(refuse(call(&mesh, 0, 2, &[0.0])), "at_hull is 2; it must be 0 or 1");
        assert_eq!(refuse(call(&mesh, 0, 0, &[])), "edges is empty; it must hold at least one");
        let falling = refuse(call(&mesh, 0, 0, &[1.0, 0.0]));
        assert_eq!(falling, "edges[1] is 0; it must be above the edge before, 1");
    }

    #[test]
    fn pointers_and_states_are_checked() {
        let mesh = meshed();
        let measure = || MaybeUninit::new(ANGLE);
        let mut counts = [0u64; 2];
        let edge = 0.0;
        // SAFETY: a live handle or NULL; NULL is refused.
        let statuses = unsafe {
            let out = counts.as_mut_ptr();
            [
                nm_mesh_quality_histogram(null(), measure(), 0, 1, &edge, out, null_mut()),
                nm_mesh_quality_histogram(&mesh, measure(), 0, 1, null(), out, null_mut()),
                nm_mesh_quality_histogram(&mesh, measure(), 0, 1, &edge, null_mut(), null_mut()),
            ]
        };
        assert_eq!(statuses, [nm_status::NM_NULL_ARGUMENT; 3]);
        assert_eq!(last_message(), "counts is NULL");
        assert_eq!(call(&square(), 0, 0, &[0.0]).0, nm_status::NM_STATE);
        let most = u64::MAX;
        // SAFETY: so many numbers are refused before any is read.
        let status = unsafe {
            let out = counts.as_mut_ptr();
            nm_mesh_quality_histogram(&mesh, measure(), 0, most, &edge, out, null_mut())
        };
        assert_eq!(status, nm_status::NM_INVALID_ARGUMENT);
    }
}
