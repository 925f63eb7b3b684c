//! Boundaries: segments and regions, and what a run has made of them.

use super::enums::nm_status;
use super::facets::read_markers;
use super::getters::{get_array, result};
use super::handle::{nm_mesh, with_mesh_mut};
use super::memory::{Versioned, check_rows, read_rows, read_struct};
use crate::error::{Error, Result, message};
use crate::memory::with_capacity;
use crate::mesh::Region;
use std::fmt::{self, Display, Formatter};
use std::mem::offset_of;

/// Label, size or hole of a region that segments (2D) or facets (3D) bound, told by a point in it.
#[allow(non_camel_case_types)]
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct nm_region {
    /// Set by the caller to sizeof(nm_region); the same in all of an array, whose elements stand as
    /// many bytes apart.
    pub struct_size: u32,
    /// A number of the caller's for the region's simplices (nm_mesh_get_simplex_regions).
    pub label: i32,
    /// A point of the region, not on a segment or facet. No other seed is in the region. In 2D the
    /// third coordinate is 0.
    pub seed: [f64; 3],
    /// The longest edge that the region may have, for NM_OUTPUT_WELL_SPACED; 0: any.
    pub max_edge: f64,
    /// 1: the region is no part of the result, whatever nm_options.extent. Otherwise 0.
    pub is_hole: u32,
    /// Zero.
    pub reserved: u32,
}

// SAFETY: repr(C), begins with a u32, no padding (checked below), numbers only.
unsafe impl Versioned for nm_region {
    const TYPE: &'static str = "nm_region";

    fn ends_inside_field(size: usize) -> bool {
        let is_word = (offset_of!(nm_region, seed)..offset_of!(nm_region, is_hole)).contains(&size);
        size % if is_word { 8 } else { 4 } != 0
    }
}

const _: () = assert!(size_of::<nm_region>() == 2 * 4 + 4 * 8 + 2 * 4);

/// Gives the mesh segments, which nm_run keeps as chains of edges; 2D and 3D. They replace those of
/// an earlier call; count 0 removes them. The result of a run stays as it is until the next.
///
/// inputs: the ends, two numbers of inputs a segment, which must be different points. markers: a
/// number of the caller's for each segment, or NULL for 0; by nm_mesh_get_segment_parents it is
/// known of each piece. Both are copied.
///
/// In 3D segments go with facets (nm_mesh_set_facets, nm_mesh_set_triangles), of which they may be
/// edges, or without; they may meet others, and facets, only at common vertices and along edges of
/// facets. The rest is for 2D.
///
/// Segments may share ends and overlap, and inputs may lie on them: nm_run cuts them at the inputs
/// on them, and at those within 3 units in the last place of the segment's larger coordinates,
/// by axis, which rounding explains (nm_stats.near_inputs). Where segments overlap the first
/// counts. What becomes of those that cross elsewhere, nm_options.crossings says. Those that are
/// closed curves can tell what is inside of them (nm_options.interior); there segments that
/// overlap count each, in their directions.
///
/// Errors: NM_NULL_ARGUMENT (mesh, inputs), NM_INVALID_ARGUMENT (a mesh of more than three
/// dimensions, an end that is no input, a segment of length 0, an array that is not aligned),
/// NM_CAPACITY (count), NM_OUT_OF_MEMORY, NM_STATE (another call is using the mesh, or it is
/// poisoned).
///
/// O(count). Before nm_run and after.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_set_segments(
    mesh: *mut nm_mesh,
    count: u64,
    inputs: *const u32,
    markers: *const i32,
) -> nm_status {
    // SAFETY: the caller gave NULL or a live handle, and arrays as long as said.
    unsafe {
        with_mesh_mut(mesh, |mesh| {
            let inputs = read_rows("inputs", inputs, count, 2)?;
            mesh.set_segments(inputs, read_markers(markers, count)?)
        })
    }
}

/// Tells what the regions are that segments bound in 2D and facets in 3D: their labels, which of
/// them are holes, and how large their simplices may be. They replace those of an earlier call;
/// count 0 removes them. The result of a run stays as it is until the next.
///
/// regions: copied. nm_run refuses seeds that name no region, and two in one region, by their
/// numbers. With NM_EXTENT_ALL what surrounds all segments or facets is a region, too; with other
/// extents a seed must be in the hull, in the box, or in what segments or facets enclose. Where a
/// rule of nm_options.interior leaves a region out, it may have the seed of a hole.
///
/// Errors: NM_NULL_ARGUMENT (mesh, regions), NM_INVALID_ARGUMENT (a mesh of more than three
/// dimensions, a field; the message names region, field and rule), NM_NON_FINITE (a seed),
/// NM_OUT_OF_MEMORY, NM_STATE (another call is using the mesh, or it is poisoned).
///
/// O(count). Before nm_run and after.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_set_regions(
    mesh: *mut nm_mesh,
    count: u64,
    regions: *const nm_region,
) -> nm_status {
    // SAFETY: the caller gave NULL or a live handle, and regions as long and as many as said.
    unsafe { with_mesh_mut(mesh, |mesh| mesh.set_regions(&read_regions(count, regions)?)) }
}

/// Reads `count` regions, whose structs must be of one size.
///
/// # Safety
/// `regions` is NULL or has `count` structs as long as the first says.
unsafe fn read_regions(count: u64, regions: *const nm_region) -> Result<Vec<Region>> {
    let defaults = nm_region {
        struct_size: size_of::<nm_region>() as u32,
        label: 0,
        seed: [0.0; 3],
        max_edge: 0.0,
        is_hole: 0,
        reserved: 0,
    };
    if count == 0 {
        return Ok(Vec::new());
    }
    // SAFETY: the caller's promise for the first.
    let size = unsafe { read_struct("regions[0]", regions, defaults)? }.struct_size;
    let count = check_rows("regions", count, size as usize)?;
    let mut read = with_capacity(count)?;
    for at in 0..count {
        let name = RegionName(at);
        let region = regions.wrapping_byte_add(at * size as usize);
        // SAFETY: the caller's promise; a size of its own is refused before more is read.
        let own = unsafe { region.cast::<u32>().read_unaligned() };
        if own != size {
            let message =
                message!("{name}.struct_size is {own}; it must be that of the first, {size}");
            return Err(Error::invalid(message));
        }
        // SAFETY: as above.
        read.push(decode(name, &unsafe { read_struct(name, region, defaults)? })?);
    }
    Ok(read)
}

/// Name of a region in messages. As a string it would cost an allocation for each that is right.
#[derive(Clone, Copy)]
struct RegionName(usize);

impl Display for RegionName {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "regions[{}]", self.0)
    }
}

fn decode(name: RegionName, region: &nm_region) -> Result<Region> {
    let nm_region { label, seed, max_edge, is_hole, reserved, .. } = *region;
    let refuse = |message| Err(Error::invalid(message));
    if is_hole > 1 {
        return refuse(message!("{name}.is_hole is {is_hole}; it must be 0 or 1"));
    }
    if reserved != 0 {
        return refuse(message!("{name}.reserved is {reserved}; it must be 0"));
    }
    Ok(Region { seed, label, is_hole: is_hole == 1, max_edge })
}

/// Writes the edges that segments have become: two vertex ids an edge, in the direction of the
/// segment; by segments, and along each. Each is an edge of a simplex of the mesh: there are none
/// of what is outside of the domain. In 3D the edges of facets come last. None without segments
/// and facets.
///
/// Array getter, see the top of this file. Errors: NM_NULL_ARGUMENT (mesh), NM_CAPACITY,
/// NM_INVALID_ARGUMENT (buf not aligned), NM_STATE (before nm_run, nm_run at work, poisoned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_segments(
    mesh: *const nm_mesh,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's rules are those of `get_array`.
    unsafe {
        get_array(mesh, buf, capacity, needed, |mesh| {
            Ok(result(mesh)?.boundary.subsegments.as_flattened())
        })
    }
}

/// Writes for each edge of nm_mesh_get_segments the segment that it is a part of: its number in
/// nm_mesh_set_segments. Of segments that overlap it is the first. NM_NONE for an edge of a hull or
/// box, and in 3D for an edge of facets that is no segment.
///
/// Array getter, see the top of this file. Errors: NM_NULL_ARGUMENT (mesh), NM_CAPACITY,
/// NM_INVALID_ARGUMENT (buf not aligned), NM_STATE (before nm_run, nm_run at work, poisoned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_segment_parents(
    mesh: *const nm_mesh,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's rules are those of `get_array`.
    unsafe { get_array(mesh, buf, capacity, needed, |mesh| Ok(&result(mesh)?.boundary.parents)) }
}

/// Writes for each simplex the label of its region: that of the seed of nm_mesh_set_regions there,
/// or else the number that nm_options.labels gives it, or 0. None without segments or facets.
///
/// Array getter, see the top of this file. Errors: NM_NULL_ARGUMENT (mesh), NM_CAPACITY,
/// NM_INVALID_ARGUMENT (buf not aligned), NM_STATE (before nm_run, nm_run at work, poisoned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_simplex_regions(
    mesh: *const nm_mesh,
    buf: *mut i32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's rules are those of `get_array`.
    unsafe {
        get_array(mesh, buf, capacity, needed, |mesh| Ok(&result(mesh)?.boundary.simplex_regions))
    }
}

/// Writes the simplices with all vertices on one facet, ascending: nm_quality.flat of them. Nothing
/// but roundings of their vertices gives them a volume, so that finite elements on them are
/// worthless.
///
/// Array getter, see the top of this file. Errors: NM_NULL_ARGUMENT (mesh), NM_CAPACITY,
/// NM_INVALID_ARGUMENT (buf not aligned), NM_STATE (before nm_run, nm_run at work, poisoned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_flat_simplices(
    mesh: *const nm_mesh,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's rules are those of `get_array`.
    unsafe { get_array(mesh, buf, capacity, needed, |mesh| Ok(&result(mesh)?.boundary.flat)) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capi::run::nm_run;
    use crate::capi::test_support::{last_message, square};
    use std::ptr::{null, null_mut};

    /// Sets segments between inputs 0 to 4, which are corners of the unit square, 2 the same as 0.
    fn set(mesh: &mut nm_mesh, inputs: &[u32], markers: Option<&[i32]>) -> nm_status {
        let markers = markers.map_or(null(), <[i32]>::as_ptr);
        // SAFETY: a live handle; the arrays fit the count.
        unsafe { nm_mesh_set_segments(mesh, inputs.len() as u64 / 2, inputs.as_ptr(), markers) }
    }

    fn regions(mesh: &mut nm_mesh, regions: &[nm_region]) -> (nm_status, String) {
        // SAFETY: a live handle; the array fits the count.
        let status = unsafe { nm_mesh_set_regions(mesh, regions.len() as u64, regions.as_ptr()) };
        (status, if status == nm_status::NM_OK { String::new() } else { last_message() })
    }

    const GOOD: nm_region = nm_region {
        struct_size: size_of::<nm_region>() as u32,
        label: -4,
        seed: [0.25, 0.5, 0.0],
        max_edge: 0.5,
        is_hole: 0,
        reserved: 0,
    };

    type Getter<T> = unsafe extern "C" fn(*const nm_mesh, *mut T, u64, *mut u64) -> nm_status;

    fn get<T: Copy + Default>(mesh: &nm_mesh, getter: Getter<T>) -> Vec<T> {
        let mut needed = 0;
        // SAFETY: a live handle; NULL asks for the size.
        assert_eq!(unsafe { getter(mesh, null_mut(), 0, &mut needed) }, nm_status::NM_OK);
        let mut values = vec![T::default(); needed as usize];
        // SAFETY: the buffer has room for `needed`.
        let status = unsafe { getter(mesh, values.as_mut_ptr(), needed, null_mut()) };
        assert_eq!(status, nm_status::NM_OK);
        values
    }

    #[test]
    fn segments_and_regions_reach_the_result() {
        let mut mesh = square();
        let inputs = [0, 1, 1, 3, 3, 4, 4, 2, 0, 3, 3, 0];
        assert_eq!(set(&mut mesh, &inputs, Some(&[7, 8, 9, 10, 11, 12])), nm_status::NM_OK);
        let above = nm_region { max_edge: 0.0, ..GOOD };
        let below = nm_region { label: 9, seed: [0.5, 0.25, 0.0], ..above };
        assert_eq!(regions(&mut mesh, &[above, below]), (nm_status::NM_OK, String::new()));
        let mut needed = 0;
        // SAFETY: a live handle; NULL asks for the size.
        let status = unsafe { nm_mesh_get_segments(&mesh, null_mut(), 0, &mut needed) };
        assert_eq!(status, nm_status::NM_STATE);
        // SAFETY: a live handle; NULL stands for the defaults.
        assert_eq!(unsafe { nm_run(&mut mesh, null()) }, nm_status::NM_OK, "{}", last_message());
        let (edges, parents) =
            (get(&mesh, nm_mesh_get_segments), get(&mesh, nm_mesh_get_segment_parents));
        assert_eq!(edges.len(), 2 * parents.len());
        // The last is a duplicate of the one before.
        for (parent, ends) in [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]].into_iter().enumerate() {
            let of_parent = |&at: &usize| parents[at] == parent as u32;
            let chain: Vec<_> = (0..parents.len()).filter(of_parent).collect();
            let starts = edges[2 * chain[0]];
            assert_eq!([starts, edges[2 * chain[chain.len() - 1] + 1]], ends, "{parent}");
            assert!(chain.windows(2).all(|pair| edges[2 * pair[0] + 1] == edges[2 * pair[1]]));
        }
        assert_eq!(parents.iter().max(), Some(&4));
        let labels = get(&mesh, nm_mesh_get_simplex_regions);
        let points = get(&mesh, crate::capi::getters::nm_mesh_get_points);
        let simplices = get(&mesh, crate::capi::getters::nm_mesh_get_simplices);
        assert_eq!(labels.len(), simplices.len() / 3);
        for (simplex, label) in simplices.chunks_exact(3).zip(labels) {
            let sum = |axis: usize| -> f64 {
                simplex.iter().map(|&vertex| points[2 * vertex as usize + axis]).sum()
            };
            let [x, y] = [sum(0) / 3.0, sum(1) / 3.0];
            let is_inside = [x, y].iter().all(|z| (0.0..1.0).contains(z));
            assert_eq!(
                label,
                if !is_inside {
                    0
                } else if x < y {
                    -4
                } else {
                    9
                },
                "{x} {y}"
            );
        }
    }

    #[test]
    fn bad_segments_and_regions_are_refused_by_name() {
        let mut mesh = square();
        assert_eq!(set(&mut mesh, &[0, 1, 1, 5], None), nm_status::NM_INVALID_ARGUMENT);
        assert!(last_message().starts_with("segments[1] has the end 5"), "{}", last_message());
        // SAFETY: a live handle; NULL is refused.
        let status = unsafe { nm_mesh_set_segments(&mut mesh, 1, null(), null()) };
        assert_eq!((status, &*last_message()), (nm_status::NM_NULL_ARGUMENT, "inputs is NULL"));
        // SAFETY: a live handle; no segments are read.
        let status = unsafe { nm_mesh_set_segments(&mut mesh, 0, null(), null()) };
        assert_eq!(status, nm_status::NM_OK);
        // SAFETY: a live handle; NULL is refused.
        let status = unsafe { nm_mesh_set_regions(&mut mesh, 1, null()) };
        assert_eq!((status, &*last_message()), (nm_status::NM_NULL_ARGUMENT, "regions[0] is NULL"));
        let refusals = [
            (nm_region { is_hole: 2, ..GOOD }, "regions[1].is_hole is 2; it must be 0 or 1"),
            (nm_region { reserved: 3, ..GOOD }, "regions[1].reserved is 3; it must be 0"),
            (nm_region { max_edge: -1.0, ..GOOD }, "regions[1].max_edge is -1;"),
            (
                nm_region { struct_size: 36, ..GOOD },
                "regions[1].struct_size is 36; it must be that",
            ),
        ];
        for (bad, message) in refusals {
            let (status, found) = regions(&mut mesh, &[GOOD, bad]);
            assert_eq!(status, nm_status::NM_INVALID_ARGUMENT);
            assert!(found.starts_with(message), "{found}");
        }
        let (status, message) = regions(&mut mesh, &[nm_region { struct_size: 12, ..GOOD }]);
        assert_eq!(status, nm_status::NM_INVALID_ARGUMENT);
        assert!(message.starts_with("regions[0].struct_size is 12; it ends inside a field"));
    }
}
