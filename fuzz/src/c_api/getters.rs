//! Array getters with any buffer.

use super::super::bytes::Bytes;
use super::expect;
use super::handle::Handle;
use netmesh::capi::{
    nm_domain, nm_mesh, nm_mesh_get_domains, nm_mesh_get_input_vertices, nm_mesh_get_neighbors,
    nm_mesh_get_points, nm_mesh_get_precision_limited, nm_mesh_get_simplices,
    nm_mesh_get_vertex_domains, nm_mesh_get_vertex_inputs, nm_mesh_get_vertex_kinds, nm_status,
};
use std::ptr::{null, null_mut};

type Getter<T> = unsafe extern "C" fn(*const nm_mesh, *mut T, u64, *mut u64) -> nm_status;

pub fn get(bytes: &mut Bytes<'_>, handle: Option<&Handle>) {
    let counts = handle.map(Handle::counts);
    let [vertices, simplices, domains, inputs, dim] = counts.map_or([0; 5], |counts| {
        [counts.vertices, counts.simplices, counts.domains, counts.inputs, u64::from(counts.dim)]
    });
    let entries = simplices * (dim + 1);
    let mut call = Call { bytes, handle, needs_result: false };
    match call.bytes.below(9) {
        0 => call.check(nm_mesh_get_points, vertices * dim, f64::to_bits),
        1 => call.check(nm_mesh_get_vertex_kinds, vertices, u64::from),
        2 => call.check(nm_mesh_get_vertex_domains, vertices, u64::from),
        3 => call.check(nm_mesh_get_precision_limited, vertices, u64::from),
        4 => call.check(nm_mesh_get_input_vertices, inputs, u64::from),
        5 => call.check(nm_mesh_get_vertex_inputs, vertices, u64::from),
        6 => call.check(nm_mesh_get_domains, domains, |d: nm_domain| d.radius.to_bits()),
        kind => {
            call.needs_result = true;
            let getter = if kind == 7 { nm_mesh_get_simplices } else { nm_mesh_get_neighbors };
            call.check(getter, entries, u64::from);
        }
    }
}

struct Call<'a, 'b> {
    bytes: &'a mut Bytes<'b>,
    handle: Option<&'a Handle>,
    needs_result: bool,
}

impl Call<'_, '_> {
    /// Calls with a buffer of some capacity, or none; it must be filled or untouched.
    fn check<T: Copy>(&mut self, getter: Getter<T>, count: u64, bits: fn(T) -> u64) {
        // SAFETY: a null handle is refused; the buffers have the capacity that is said, and one
        // that is not aligned is refused unwritten.
        unsafe {
            let mut needed = u64::MAX;
            let Some(handle) = self.handle else {
                let status = getter(null(), null_mut(), 0, &mut needed);
                expect(status, nm_status::NM_NULL_ARGUMENT);
                assert_eq!(needed, u64::MAX);
                return;
            };
            if self.needs_result && !handle.has_result {
                let status = getter(handle.mesh, null_mut(), 0, &mut needed);
                expect(status, nm_status::NM_STATE);
                assert_eq!(needed, u64::MAX);
                return;
            }
            expect(getter(handle.mesh, null_mut(), 0, &mut needed), nm_status::NM_OK);
            assert_eq!(needed, count);
            let capacity = (count + self.bytes.below(5) as u64).saturating_sub(2);
            let filler: T = std::mem::zeroed();
            let mut buffer = vec![filler; capacity as usize + 1];
            let enough = capacity >= count;
            let status = getter(handle.mesh, buffer.as_mut_ptr(), capacity, &mut needed);
            expect(status, if enough { nm_status::NM_OK } else { nm_status::NM_CAPACITY });
            assert_eq!(needed, count);
            let untouched = if enough { count as usize } else { 0 };
            assert!(buffer[untouched..].iter().all(|&value| bits(value) == 0));
            self.check_misaligned(getter, handle, &mut buffer, capacity);
        }
    }

    /// Calls with a misaligned buffer.
    ///
    /// # Safety
    /// The buffer must have room for `capacity` elements.
    unsafe fn check_misaligned<T>(
        &self,
        getter: Getter<T>,
        handle: &Handle,
        buffer: &mut [T],
        capacity: u64,
    ) {
        if align_of::<T>() > 1 {
            let shifted = buffer.as_mut_ptr().wrapping_byte_add(1);
            // SAFETY: refused unwritten.
            let status = unsafe { getter(handle.mesh, shifted, capacity, null_mut()) };
            expect(status, nm_status::NM_INVALID_ARGUMENT);
        }
    }
}
