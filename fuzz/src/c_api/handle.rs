//! A handle, with the facts that the test knows of it.

use super::expect;
use netmesh::capi::{
    nm_counts, nm_domain, nm_mesh, nm_mesh_counts, nm_mesh_free, nm_mesh_get_domains,
    nm_mesh_get_input_vertices, nm_mesh_get_neighbors, nm_mesh_get_points,
    nm_mesh_get_precision_limited, nm_mesh_get_simplices, nm_mesh_get_vertex_domains,
    nm_mesh_get_vertex_inputs, nm_mesh_get_vertex_kinds, nm_status,
};
use std::ptr::null_mut;

pub struct Handle {
    pub mesh: *mut nm_mesh,
    pub dim: usize,
    pub has_result: bool,
}

impl Drop for Handle {
    fn drop(&mut self) {
        // SAFETY: made by `nm_mesh_create`, freed here alone.
        unsafe { nm_mesh_free(self.mesh) };
    }
}

/// Results of all getters.
#[derive(Debug, PartialEq)]
pub struct Snapshot {
    pub counts: nm_counts,
    points: Vec<u64>,
    ids: Vec<Vec<u32>>,
    flags: Vec<Vec<u8>>,
    domains: Vec<(u32, u32, u64)>,
}

type Getter<T> = unsafe extern "C" fn(*const nm_mesh, *mut T, u64, *mut u64) -> nm_status;

impl Handle {
    pub fn counts(&self) -> nm_counts {
        let mut counts = nm_counts {
            struct_size: size_of::<nm_counts>() as u32,
            dim: 0,
            inputs: 0,
            duplicates: 0,
            vertices: 0,
            simplices: 0,
            domains: 0,
            segment_edges: 0,
            facet_triangles: 0,
        };
        // SAFETY: a live handle and a whole struct.
        expect(unsafe { nm_mesh_counts(self.mesh, &mut counts) }, nm_status::NM_OK);
        counts
    }

    pub fn snapshot(&self) -> Snapshot {
        let mut ids = vec![
            self.all(nm_mesh_get_vertex_domains, 0),
            self.all(nm_mesh_get_input_vertices, 0),
            self.all(nm_mesh_get_vertex_inputs, 0),
        ];
        if self.has_result {
            ids.push(self.all(nm_mesh_get_simplices, 0));
            ids.push(self.all(nm_mesh_get_neighbors, 0));
        }
        let domains =
            self.all(nm_mesh_get_domains, nm_domain { center: 0, parent: 0, radius: 0.0 });
        Snapshot {
            counts: self.counts(),
            points: self.all(nm_mesh_get_points, 0.0).into_iter().map(f64::to_bits).collect(),
            ids,
            flags: vec![
                self.all(nm_mesh_get_vertex_kinds, 0),
                self.all(nm_mesh_get_precision_limited, 0),
            ],
            domains: domains.iter().map(|d| (d.center, d.parent, d.radius.to_bits())).collect(),
        }
    }

    /// Returns the whole array of a getter that must succeed.
    pub fn all<T: Clone>(&self, getter: Getter<T>, filler: T) -> Vec<T> {
        let mut needed = 0;
        // SAFETY: a live handle; NULL asks for the size, and the buffer has it.
        unsafe {
            expect(getter(self.mesh, null_mut(), 0, &mut needed), nm_status::NM_OK);
            let mut buffer = vec![filler; needed as usize];
            let status = getter(self.mesh, buffer.as_mut_ptr(), needed, null_mut());
            expect(status, nm_status::NM_OK);
            buffer
        }
    }
}
