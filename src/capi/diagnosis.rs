//! Diagnosis of facets in space: where they meet in more than they may, and the edges that are not
//! between two of them.

use super::enums::{nm_edge_fault, nm_feature, nm_intersection_kind, nm_status};
use super::handle::{nm_mesh, with_prepared};
use super::memory::{Versioned, copy_structs};
use crate::mesh::{EdgeFault, Feature, Intersection, IntersectionKind, OddEdge};

/// Pair of facets and segments that meet in more than they share; an element of the array that
/// nm_mesh_get_intersections fills.
#[allow(non_camel_case_types)]
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct nm_intersection {
    /// Set by the caller to sizeof(nm_intersection) in the first element of an array, whose
    /// elements stand as many bytes apart; the function sets it in the others.
    pub struct_size: u32,
    /// The kind of the intersection.
    pub kind: nm_intersection_kind,
    /// The kind of the first of the two, a facet or a segment.
    pub first_feature: nm_feature,
    /// The number of the first in nm_mesh_set_facets, nm_mesh_set_triangles or
    /// nm_mesh_set_segments.
    pub first: u32,
    /// The kind of the second.
    pub second_feature: nm_feature,
    /// The number of the second; a facet that meets itself, or has no area, is both.
    pub second: u32,
    /// A point of the intersection, rounded to doubles.
    pub point: [f64; 3],
}

// SAFETY: repr(C), begins with a u32, no padding (checked below), numbers and enums of four bytes
// that the library only writes.
unsafe impl Versioned for nm_intersection {
    const TYPE: &'static str = "nm_intersection";
}

const _: () = assert!(size_of::<nm_intersection>() == 6 * 4 + 3 * 8);

/// Edge of facets that is not one of two that run through it in opposite directions; an element of
/// the array that nm_mesh_get_odd_edges fills.
#[allow(non_camel_case_types)]
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct nm_odd_edge {
    /// Set by the caller to sizeof(nm_odd_edge) in the first element of an array, whose elements
    /// stand as many bytes apart; the function sets it in the others.
    pub struct_size: u32,
    /// The fault of the edge.
    pub fault: nm_edge_fault,
    /// The inputs at its ends, the smaller number first; of equal inputs the first.
    pub inputs: [u32; 2],
    /// The number of facets that have the edge; a facet that runs through it several times counts
    /// as often.
    pub facets: u32,
}

// SAFETY: repr(C), begins with a u32, no padding (checked below), numbers and an enum of four bytes
// that the library only writes.
unsafe impl Versioned for nm_odd_edge {
    const TYPE: &'static str = "nm_odd_edge";
}

const _: () = assert!(size_of::<nm_odd_edge>() == 5 * 4);

/// Writes all pairs of the facets and segments that the mesh was given last (nm_mesh_set_facets,
/// nm_mesh_set_triangles, nm_mesh_set_segments) that meet in more than vertices and edges that they
/// share, each with the kind of the intersection and a point of it; a facet that meets itself or
/// has no area is such a pair, too. By first, then by second; facets come before segments. The test
/// is exact. None: nm_run can keep them, if doubles have room; otherwise it refuses with the first.
/// 3D only. Before nm_run, after it, and after it has failed.
///
/// buf[0].struct_size: set by the caller, to sizeof(nm_intersection) or what it was in an earlier
/// version; the elements stand as many bytes apart. It is read only if the array has elements.
/// capacity and *needed count elements.
///
/// Array getter, see the top of this file. The first call takes the time: O(n log n) for n
/// triangles and segments whose boxes meet few others, O(n + pairs of boxes that meet) otherwise.
/// The handle keeps the array until something is set or nm_run succeeds.
///
/// Errors: NM_NULL_ARGUMENT (mesh), NM_CAPACITY, NM_INVALID_ARGUMENT (a mesh that is not 3D, buf
/// not aligned, buf[0].struct_size), NM_OUT_OF_MEMORY, NM_STATE (nm_run at work, poisoned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_intersections(
    mesh: *const nm_mesh,
    buf: *mut nm_intersection,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller gave NULL or a live handle, and a buffer by the getter's rules.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            copy_structs(prepared.intersections(mesh)?, encode, buf, capacity, needed)
        })
    }
}

/// Writes all edges of the facets that the mesh was given last (nm_mesh_set_facets,
/// nm_mesh_set_triangles) that are not one of two facets which run through them in opposite
/// directions: where one facet ends, where three or more meet, and where two are turned round. By
/// their inputs. None: the facets are closed surfaces, oriented alike; with an empty
/// nm_mesh_get_intersections as well they enclose what nm_options.interior asks for. Triangles
/// without an area have no edges, and equal points are one. 3D only. Before nm_run, after it, and
/// after it has failed.
///
/// buf[0].struct_size: set by the caller, to sizeof(nm_odd_edge) or what it was in an earlier
/// version; the elements stand as many bytes apart. It is read only if the array has elements.
/// capacity and *needed count elements.
///
/// Array getter, see the top of this file. The first call takes the time: O(n log n) for n inputs
/// of facets. The handle keeps the array until something is set or nm_run succeeds.
///
/// Errors: NM_NULL_ARGUMENT (mesh), NM_CAPACITY, NM_INVALID_ARGUMENT (a mesh that is not 3D, buf
/// not aligned, buf[0].struct_size), NM_OUT_OF_MEMORY, NM_STATE (nm_run at work, poisoned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_odd_edges(
    mesh: *const nm_mesh,
    buf: *mut nm_odd_edge,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller gave NULL or a live handle, and a buffer by the getter's rules.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            copy_structs(prepared.odd_edges(mesh)?, encode_edge, buf, capacity, needed)
        })
    }
}

fn encode(intersection: &Intersection) -> nm_intersection {
    let Intersection { first, second, kind, point } = *intersection;
    let (first_feature, first) = encode_feature(first);
    let (second_feature, second) = encode_feature(second);
    let kind = match kind {
        IntersectionKind::Cross => nm_intersection_kind::NM_INTERSECTION_CROSS,
        IntersectionKind::Touch => nm_intersection_kind::NM_INTERSECTION_TOUCH,
        IntersectionKind::Overlap => nm_intersection_kind::NM_INTERSECTION_OVERLAP,
        IntersectionKind::ZeroArea => nm_intersection_kind::NM_INTERSECTION_ZERO_AREA,
    };
    let struct_size = size_of::<nm_intersection>() as u32;
    nm_intersection { struct_size, kind, first_feature, first, second_feature, second, point }
}

fn encode_feature(feature: Feature) -> (nm_feature, u32) {
    match feature {
        Feature::Facet(number) => (nm_feature::NM_FEATURE_FACET, number),
        Feature::Segment(number) => (nm_feature::NM_FEATURE_SEGMENT, number),
    }
}

fn encode_edge(edge: &OddEdge) -> nm_odd_edge {
    let OddEdge { inputs, facets, fault } = *edge;
    let fault = match fault {
        EdgeFault::Open => nm_edge_fault::NM_EDGE_OPEN,
        EdgeFault::Crowded => nm_edge_fault::NM_EDGE_CROWDED,
        EdgeFault::Turned => nm_edge_fault::NM_EDGE_TURNED,
    };
    nm_odd_edge { struct_size: size_of::<nm_odd_edge>() as u32, fault, inputs, facets }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capi::test_support::{last_message, square};
    use crate::error::Result;
    use crate::mesh::Mesh;
    use std::ptr::{null, null_mut};

    const ROOM: nm_intersection = nm_intersection {
        struct_size: size_of::<nm_intersection>() as u32,
        kind: nm_intersection_kind::NM_INTERSECTION_CROSS,
        first_feature: nm_feature::NM_FEATURE_FACET,
        first: 9,
        second_feature: nm_feature::NM_FEATURE_FACET,
        second: 9,
        point: [9.0; 3],
    };

    /// Writes intersections as the getter does.
    ///
    /// # Safety
    /// The pointers are as [`copy_structs`] demands.
    unsafe fn write(
        found: &[Intersection],
        buf: *mut nm_intersection,
        capacity: u64,
        needed: *mut u64,
    ) -> Result<()> {
        // SAFETY: the caller's promise.
        unsafe { copy_structs(found, encode, buf, capacity, needed) }
    }

    const FOUND: [Intersection; 2] = [
        Intersection {
            first: Feature::Facet(3),
            second: Feature::Segment(5),
            kind: IntersectionKind::Touch,
            point: [0.25, 0.5, -1.0],
        },
        Intersection {
            first: Feature::Facet(4),
            second: Feature::Facet(4),
            kind: IntersectionKind::ZeroArea,
            point: [1.0, 2.0, 3.0],
        },
    ];

    #[test]
    fn intersections_are_written_as_the_callers_structs() {
        let mut needed = 0;
        // SAFETY: NULL asks for the size.
        unsafe { write(&FOUND, null_mut(), 0, &mut needed) }.unwrap();
        assert_eq!(needed, 2);
        let mut buf = [ROOM; 3];
        buf[1].struct_size = 0;
        // SAFETY: room for one, which is refused.
        let error = unsafe { write(&FOUND, buf.as_mut_ptr(), 1, &mut needed) };
        assert_eq!(error.unwrap_err().message(), "capacity is 1; the result has 2 elements");
        assert_eq!(buf[0], ROOM);
        // SAFETY: room for three.
        unsafe { write(&FOUND, buf.as_mut_ptr(), 3, null_mut()) }.unwrap();
        let touch = nm_intersection {
            kind: nm_intersection_kind::NM_INTERSECTION_TOUCH,
            first: 3,
            second_feature: nm_feature::NM_FEATURE_SEGMENT,
            second: 5,
            point: [0.25, 0.5, -1.0],
            ..ROOM
        };
        let flat = nm_intersection {
            kind: nm_intersection_kind::NM_INTERSECTION_ZERO_AREA,
            first: 4,
            second: 4,
            point: [1.0, 2.0, 3.0],
            ..ROOM
        };
        assert_eq!(buf, [touch, flat, ROOM]);
        buf[0].struct_size = 3;
        // SAFETY: the size is refused.
        let error = unsafe { write(&FOUND, buf.as_mut_ptr(), 3, null_mut()) };
        assert!(error.unwrap_err().message().starts_with("buf[0].struct_size is 3;"));
        // SAFETY: no struct is read or written.
        unsafe { write(&[], buf.as_mut_ptr(), 0, &mut needed) }.unwrap();
        assert_eq!(needed, 0);
    }

    #[test]
    fn structs_of_other_versions_stand_as_far_apart_as_they_are_long() {
        let known = size_of::<nm_intersection>();
        for size in [24, known, known + 8] {
            let mut words = [0xeeee_eeee_u32; 32];
            words[0] = size as u32;
            let buf = words.as_mut_ptr().cast::<nm_intersection>();
            if !buf.is_aligned() {
                continue;
            }
            // SAFETY: room for two structs of this size.
            unsafe { write(&FOUND, buf, 2, null_mut()) }.unwrap();
            for (at, found) in FOUND.iter().enumerate() {
                let element = &words[at * size / 4..(at + 1) * size / 4];
                assert_eq!(element[0], size as u32);
                assert_eq!([element[3], element[5]], [encode(found).first, encode(found).second]);
                assert!(element[12.min(size / 4)..].iter().all(|&word| word == 0));
            }
            assert!(words[2 * size / 4..].iter().all(|&word| word == 0xeeee_eeee));
        }
    }

    #[test]
    fn intersections_are_for_space() {
        let mut needed = 7;
        // SAFETY: a live handle; NULL asks for the size.
        let status = unsafe { nm_mesh_get_intersections(&square(), null_mut(), 0, &mut needed) };
        let rule = "the mesh has dimension 2; intersections are for 3D";
        assert_eq!((status, &*last_message()), (nm_status::NM_INVALID_ARGUMENT, rule));
        assert_eq!(needed, 7);
        // SAFETY: NULL is refused.
        let status = unsafe { nm_mesh_get_intersections(null(), null_mut(), 0, &mut needed) };
        assert_eq!((status, &*last_message()), (nm_status::NM_NULL_ARGUMENT, "mesh is NULL"));
    }

    /// Returns a tetrahedron whose second triangle is turned round, of inputs of which the last is
    /// equal to the first, and a triangle that stands on its first edge.
    fn damaged() -> nm_mesh {
        let points = [0., 0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1., 0.5, -1., -1., 0., 0., 0.];
        let mut mesh = Mesh::new(3, 6, &points, 0).unwrap();
        let triangles = [0, 2, 1, 5, 3, 1, 1, 2, 3, 2, 0, 3, 5, 1, 4];
        mesh.set_triangles(&triangles, None).unwrap();
        nm_mesh::new(mesh)
    }

    #[test]
    fn edges_that_are_not_between_two_facets_are_told() {
        const ROOM: nm_odd_edge = nm_odd_edge {
            struct_size: size_of::<nm_odd_edge>() as u32,
            fault: nm_edge_fault::NM_EDGE_OPEN,
            inputs: [9; 2],
            facets: 9,
        };
        let (mesh, mut needed, mut buf) = (damaged(), 0, [ROOM; 6]);
        // SAFETY: a live handle; NULL asks for the size.
        let status = unsafe { nm_mesh_get_odd_edges(&mesh, null_mut(), 0, &mut needed) };
        assert_eq!((status, needed), (nm_status::NM_OK, 5));
        // SAFETY: room for four, which is refused.
        let status = unsafe { nm_mesh_get_odd_edges(&mesh, buf.as_mut_ptr(), 4, null_mut()) };
        assert_eq!((status, buf), (nm_status::NM_CAPACITY, [ROOM; 6]));
        buf[1].struct_size = 0;
        // SAFETY: room for six.
        let status = unsafe { nm_mesh_get_odd_edges(&mesh, buf.as_mut_ptr(), 6, null_mut()) };
        assert_eq!(status, nm_status::NM_OK, "{}", last_message());
        let edge = |fault, inputs, facets| nm_odd_edge { fault, inputs, facets, ..ROOM };
        let [open, crowded, turned] = [
            nm_edge_fault::NM_EDGE_OPEN,
            nm_edge_fault::NM_EDGE_CROWDED,
            nm_edge_fault::NM_EDGE_TURNED,
        ];
        let expected = [
            edge(crowded, [0, 1], 3),
            edge(turned, [0, 3], 2),
            edge(open, [0, 4], 1),
            edge(turned, [1, 3], 2),
            edge(open, [1, 4], 1),
            ROOM,
        ];
        assert_eq!(buf, expected);
        buf[0].struct_size = 3;
        // SAFETY: the size is refused.
        let status = unsafe { nm_mesh_get_odd_edges(&mesh, buf.as_mut_ptr(), 6, null_mut()) };
        assert_eq!(status, nm_status::NM_INVALID_ARGUMENT);
        assert!(last_message().starts_with("buf[0].struct_size is 3;"), "{}", last_message());
    }

    #[test]
    fn edges_of_facets_are_for_space() {
        let mut needed = 7;
        // SAFETY: a live handle; NULL asks for the size.
        let status = unsafe { nm_mesh_get_odd_edges(&square(), null_mut(), 0, &mut needed) };
        let rule = "the mesh has dimension 2; edges of facets are for 3D";
        assert_eq!((status, &*last_message()), (nm_status::NM_INVALID_ARGUMENT, rule));
        assert_eq!(needed, 7);
        // SAFETY: NULL is refused.
        let status = unsafe { nm_mesh_get_odd_edges(null(), null_mut(), 0, &mut needed) };
        assert_eq!((status, &*last_message()), (nm_status::NM_NULL_ARGUMENT, "mesh is NULL"));
    }
}
