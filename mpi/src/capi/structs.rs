//! The structs of the boundary.

use netmesh::capi::shared::Versioned;
use netmesh::validate::ViolationKind;
use std::ffi::c_char;

/// Sizes of a mesh: of the whole, and of the part that this rank has.
#[allow(non_camel_case_types)]
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct nm_mpi_counts {
    /// Set by the caller to sizeof(nm_mpi_counts).
    pub struct_size: u32,
    /// The dimension.
    pub dim: u32,
    /// This rank in the communicator of the run.
    pub rank: u32,
    /// Number of ranks in the communicator of the run.
    pub ranks: u32,
    /// Points that all ranks have given, duplicates included.
    pub inputs: u64,
    /// Points that equal an earlier one, of this rank or of a lower one.
    pub duplicates: u64,
    /// Vertices of the whole mesh.
    pub vertices: u64,
    /// Ids of vertices are below this: inputs + vertices that are none.
    pub vertex_ids: u64,
    /// Simplices of the whole mesh.
    pub simplices: u64,
    /// Domains of the hierarchy, the root included.
    pub domains: u64,
    /// Parts that the mesh was made in.
    pub pieces: u64,
    /// Points that this rank has given.
    pub local_inputs: u64,
    /// The id of the first of them, if it is a vertex: its index among the inputs of all ranks.
    pub first_input: u64,
    /// Vertices that this rank knows: those of its simplices and those of its ghosts.
    pub local_vertices: u64,
    /// Number of vertices of this rank's own simplices; they come first.
    pub own_vertices: u64,
    /// Simplices of this rank.
    pub local_simplices: u64,
    /// The id of the first of them; the others follow.
    pub first_simplex: u64,
    /// Simplices of other ranks that share a vertex with one of this rank.
    pub ghosts: u64,
    /// Facets between a simplex of this rank and one of another.
    pub interface_facets: u64,
    /// Bytes that this rank has sent to others during the run, without what MPI adds.
    pub bytes_sent: u64,
    /// Domains that this rank knows: those that hold a vertex that it knows.
    pub local_domains: u64,
}

// SAFETY: repr(C), begins with a u32, no padding (checked below), numbers only.
unsafe impl Versioned for nm_mpi_counts {
    const TYPE: &'static str = "nm_mpi_counts";
}

const _: () = assert!(size_of::<nm_mpi_counts>() == 4 * 4 + 17 * 8);

/// A facet between a simplex of this rank and one of another; an element of the array that
/// nm_mpi_get_interface fills (fixed in size for this ABI version).
#[allow(non_camel_case_types)]
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct nm_mpi_facet {
    /// Index of the own simplex, from 0.
    pub simplex: u64,
    /// Index of the other among the ghosts, from 0.
    pub ghost: u64,
    /// The facet is opposite this vertex of the own simplex, 0..dim.
    pub facet: u32,
    /// The rank of the other simplex.
    pub owner: u32,
}

const _: () = assert!(size_of::<nm_mpi_facet>() == 24);

/// A ball of the domain hierarchy; an element of the array that nm_mpi_get_domains fills (fixed in
/// size for this ABI version).
#[allow(non_camel_case_types)]
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct nm_mpi_domain {
    /// The domain's id, below nm_mpi_counts.domains.
    pub id: u64,
    /// The id of the enclosing domain; NM_MPI_NONE for the root, which has id 0.
    pub parent: u64,
    /// The id of the vertex at the ball's centre, which another rank may have.
    pub center: u64,
    /// Radius, in the unit of the coordinates.
    pub radius: f64,
    /// The coordinates of the centre; in 2D the last is 0.
    pub position: [f64; 3],
}

const _: () = assert!(size_of::<nm_mpi_domain>() == 56);

/// Findings of nm_mpi_validate, the same on all ranks.
#[allow(non_camel_case_types)]
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct nm_mpi_report {
    /// Set by the caller to sizeof(nm_mpi_report).
    pub struct_size: u32,
    /// The highest level of which no rule is broken, nor any below it; 0 if one of level 1 is.
    pub level: u32,
    /// Violations that all ranks have found.
    pub violations: u64,
    /// Checks that all ranks have made.
    pub checked: u64,
    /// The first violation's kind; NM_VIOLATION_NONE if there is none.
    pub kind: ViolationKind,
    /// The rank whose part of the mesh the first violation is in; NM_NONE if there is none.
    pub rank: u32,
    /// The id of the first violation's simplex; NM_MPI_NONE if it concerns none.
    pub simplex: u64,
    /// The id of the first violation's vertex; NM_MPI_NONE if it concerns none.
    pub vertex: u64,
    /// The first violation in words: UTF-8 with its NUL, cut between characters; "" if there is
    /// none.
    pub message: [c_char; 160],
}

// SAFETY: repr(C), begins with a u32, no padding (checked below), numbers and an enum of four bytes
// that the library only writes.
unsafe impl Versioned for nm_mpi_report {
    const TYPE: &'static str = "nm_mpi_report";
}

const _: () = assert!(size_of::<nm_mpi_report>() == 4 * 4 + 4 * 8 + 160);
