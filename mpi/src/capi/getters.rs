//! Counts and arrays of a rank's part. None of them is collective.

use super::run::{handle, nm_mpi_mesh};
use super::structs::{nm_mpi_counts, nm_mpi_domain, nm_mpi_facet};
use crate::distributed::{DistributedMesh, Domain, InterfaceFacet};
use netmesh::capi::nm_status;
use netmesh::capi::shared::{OutStruct, barrier, copy_out};

/// Writes how large the mesh is. Not collective. O(1).
///
/// counts: the caller sets struct_size.
///
/// Errors: NM_NULL_ARGUMENT (mesh, counts), NM_INVALID_ARGUMENT (counts->struct_size).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mpi_get_counts(
    mesh: *const nm_mpi_mesh,
    counts: *mut nm_mpi_counts,
) -> nm_status {
    barrier(|| {
        // SAFETY: the caller gave NULL or a live handle.
        let mesh = &unsafe { handle(mesh)? }.mesh;
        // SAFETY: the caller gave NULL or as many bytes as the `struct_size` says.
        let out = unsafe { OutStruct::new("counts", counts)? };
        out.write(&count(mesh));
        Ok(())
    })
}

fn count(mesh: &DistributedMesh) -> nm_mpi_counts {
    nm_mpi_counts {
        struct_size: size_of::<nm_mpi_counts>() as u32,
        dim: mesh.dim as u32,
        rank: mesh.rank as u32,
        ranks: mesh.ranks as u32,
        inputs: mesh.totals.inputs,
        duplicates: mesh.totals.duplicates,
        vertices: mesh.totals.vertices,
        vertex_ids: mesh.totals.vertex_ids,
        simplices: mesh.totals.simplices,
        domains: mesh.totals.domains,
        pieces: mesh.totals.pieces,
        local_inputs: (mesh.inputs.len() / mesh.dim) as u64,
        first_input: mesh.first_input,
        local_vertices: mesh.vertex_ids.len() as u64,
        own_vertices: mesh.own_vertices as u64,
        local_simplices: mesh.simplex_count() as u64,
        first_simplex: mesh.first_simplex,
        ghosts: mesh.ghosts.len() as u64,
        interface_facets: mesh.interface.len() as u64,
        bytes_sent: mesh.bytes_sent,
        local_domains: mesh.domains.len() as u64,
    }
}

/// Copies `value` of each element of an array of the mesh to the caller's buffer.
///
/// # Safety
/// `mesh` is NULL or a live handle; `buf` and `needed` are as `copy_out` wants them.
unsafe fn get<S, T>(
    mesh: *const nm_mpi_mesh,
    buf: *mut T,
    capacity: u64,
    needed: *mut u64,
    array: impl Fn(&DistributedMesh) -> &[S],
    value: impl Fn(&DistributedMesh, &S) -> T,
) -> nm_status {
    barrier(|| {
        // SAFETY: the caller's promise.
        let mesh = &unsafe { handle(mesh)? }.mesh;
        let values = array(mesh).iter().map(|element| value(mesh, element));
        // SAFETY: the caller's promise.
        unsafe { copy_out(buf, capacity, needed, values.len(), values) }
    })
}

/// Writes the ids of the vertices that this rank knows: local_vertices of them, first those of its
/// own simplices (own_vertices), then those that only ghosts have, rising in both. The other arrays
/// of vertices are in the same order.
///
/// The id of an input is its index among the inputs of all ranks, in the order of the ranks; of
/// equal inputs that of the first. Vertices that are no inputs follow, from the number of inputs
/// on: their ids do not depend on the ranks.
///
/// Array getter, not collective. Errors: NM_NULL_ARGUMENT (mesh), NM_CAPACITY, NM_INVALID_ARGUMENT
/// (buf not aligned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mpi_get_vertex_ids(
    mesh: *const nm_mpi_mesh,
    buf: *mut u64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's rules are those of `get`.
    unsafe { get(mesh, buf, capacity, needed, |mesh| &mesh.vertex_ids, |_, value| *value) }
}

/// Writes the coordinates of the vertices that this rank knows: local_vertices x dim doubles,
/// inputs with the bits that a rank has given.
///
/// Array getter, not collective. Errors: NM_NULL_ARGUMENT (mesh), NM_CAPACITY, NM_INVALID_ARGUMENT
/// (buf not aligned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mpi_get_points(
    mesh: *const nm_mpi_mesh,
    buf: *mut f64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's rules are those of `get`.
    unsafe { get(mesh, buf, capacity, needed, |mesh| &mesh.points, |_, value| *value) }
}

/// Writes the kinds of the vertices that this rank knows, a byte each: values of nm_vertex_kind.
///
/// Array getter, not collective. Errors: NM_NULL_ARGUMENT (mesh), NM_CAPACITY, NM_INVALID_ARGUMENT
/// (buf not aligned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mpi_get_vertex_kinds(
    mesh: *const nm_mpi_mesh,
    buf: *mut u8,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's rules are those of `get`.
    unsafe { get(mesh, buf, capacity, needed, |mesh| &mesh.kinds, |_, value| *value) }
}

/// Writes for each vertex that this rank knows its owner: the lowest of the ranks that have a
/// simplex with it. So every vertex of the mesh has one owner.
///
/// Array getter, not collective. Errors: NM_NULL_ARGUMENT (mesh), NM_CAPACITY, NM_INVALID_ARGUMENT
/// (buf not aligned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mpi_get_vertex_owners(
    mesh: *const nm_mpi_mesh,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's rules are those of `get`.
    unsafe { get(mesh, buf, capacity, needed, |mesh| &mesh.vertex_owners, |_, value| *value) }
}

/// Writes for each vertex that this rank knows the id of the innermost domain that holds it, below
/// domains; NM_MPI_NONE where there are none.
///
/// Array getter, not collective. Errors: NM_NULL_ARGUMENT (mesh), NM_CAPACITY, NM_INVALID_ARGUMENT
/// (buf not aligned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mpi_get_vertex_domains(
    mesh: *const nm_mpi_mesh,
    buf: *mut u64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's rules are those of `get`.
    unsafe { get(mesh, buf, capacity, needed, |mesh| &mesh.vertex_domains, |_, value| *value) }
}

/// Writes the domains that hold a vertex that this rank knows, a tree of balls with every domain
/// around them up to the root: local_domains elements, by rising id. The ids are those of
/// nm_mpi_get_vertex_domains and do not depend on the ranks; all ranks have the same of a domain.
///
/// Array getter, not collective. Errors: NM_NULL_ARGUMENT (mesh), NM_CAPACITY, NM_INVALID_ARGUMENT
/// (buf not aligned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mpi_get_domains(
    mesh: *const nm_mpi_mesh,
    buf: *mut nm_mpi_domain,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's rules are those of `get`.
    unsafe {
        get(mesh, buf, capacity, needed, |mesh| &mesh.domains, |_, domain| encode_domain(domain))
    }
}

/// Writes this rank's simplices: local_simplices x (dim + 1) ids of vertices, positively oriented.
/// No other rank has them; all ranks' together are the mesh. The id of the i-th is first_simplex +
/// i.
///
/// Array getter, not collective. Errors: NM_NULL_ARGUMENT (mesh), NM_CAPACITY, NM_INVALID_ARGUMENT
/// (buf not aligned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mpi_get_simplices(
    mesh: *const nm_mpi_mesh,
    buf: *mut u64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's rules are those of `get`.
    unsafe { get(mesh, buf, capacity, needed, |mesh| &mesh.simplices, id_of) }
}

/// Writes the neighbours of this rank's simplices: local_simplices x (dim + 1) ids of simplices,
/// the i-th opposite vertex i. An id that is not this rank's is that of a ghost. NM_MPI_NONE on the
/// hull.
///
/// Array getter, not collective. Errors: NM_NULL_ARGUMENT (mesh), NM_CAPACITY, NM_INVALID_ARGUMENT
/// (buf not aligned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mpi_get_neighbors(
    mesh: *const nm_mpi_mesh,
    buf: *mut u64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's rules are those of `get`.
    unsafe { get(mesh, buf, capacity, needed, |mesh| &mesh.neighbors, |_, value| *value) }
}

/// Writes the ghosts: ghosts x (dim + 1) ids of vertices. They are the simplices of other ranks
/// that share a vertex with one of this rank: with its own simplices they are the whole star of
/// each of its vertices.
///
/// Array getter, not collective. Errors: NM_NULL_ARGUMENT (mesh), NM_CAPACITY, NM_INVALID_ARGUMENT
/// (buf not aligned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mpi_get_ghosts(
    mesh: *const nm_mpi_mesh,
    buf: *mut u64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's rules are those of `get`.
    unsafe { get(mesh, buf, capacity, needed, |mesh| &mesh.ghost_simplices, id_of) }
}

/// Writes the ids of the ghosts, which rise.
///
/// Array getter, not collective. Errors: NM_NULL_ARGUMENT (mesh), NM_CAPACITY, NM_INVALID_ARGUMENT
/// (buf not aligned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mpi_get_ghost_ids(
    mesh: *const nm_mpi_mesh,
    buf: *mut u64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's rules are those of `get`.
    unsafe { get(mesh, buf, capacity, needed, |mesh| &mesh.ghosts, |_, ghost| ghost.id) }
}

/// Writes the ranks whose simplices the ghosts are.
///
/// Array getter, not collective. Errors: NM_NULL_ARGUMENT (mesh), NM_CAPACITY, NM_INVALID_ARGUMENT
/// (buf not aligned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mpi_get_ghost_owners(
    mesh: *const nm_mpi_mesh,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's rules are those of `get`.
    unsafe { get(mesh, buf, capacity, needed, |mesh| &mesh.ghosts, |_, ghost| ghost.owner) }
}

/// Writes the interface: interface_facets elements, by rising simplex and facet. The rank on the
/// other side has each of them, too.
///
/// Array getter, not collective. Errors: NM_NULL_ARGUMENT (mesh), NM_CAPACITY, NM_INVALID_ARGUMENT
/// (buf not aligned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mpi_get_interface(
    mesh: *const nm_mpi_mesh,
    buf: *mut nm_mpi_facet,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's rules are those of `get`.
    unsafe { get(mesh, buf, capacity, needed, |mesh| &mesh.interface, encode_facet) }
}

fn encode_domain(domain: &Domain) -> nm_mpi_domain {
    let Domain { id, parent, center, radius, position } = *domain;
    nm_mpi_domain { id, parent, center, radius, position }
}

fn encode_facet(mesh: &DistributedMesh, facet: &InterfaceFacet) -> nm_mpi_facet {
    nm_mpi_facet {
        simplex: facet.simplex as u64,
        ghost: facet.ghost as u64,
        facet: facet.facet,
        owner: mesh.ghosts[facet.ghost].owner,
    }
}

/// Returns the id of a vertex that the rank has under this number.
fn id_of(mesh: &DistributedMesh, vertex: &u32) -> u64 {
    mesh.vertex_ids[*vertex as usize]
}
