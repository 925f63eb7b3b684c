//! Meshes on several machines, of which no process has all: the parts of the algorithm that a
//! program needs to make one, and the plain data that it sends. Communication is up to the program.
//! [`Coarse`] shows the order of the steps.

pub use crate::netmesh::distributed::{
    Bisection, Coarse, HULL, INTERFACE, Located, MADE, Maker, NO_DOMAIN, Piece, PlainDomain,
    PlainPiece, RINGS,
};

/// Growth of arrays that may be refused, since `Vec` ends the process where the system has no more.
pub mod memory {
    pub use crate::memory::{
        AllocError, AllocResult, TryGrow, collected, copied, filled, with_capacity,
    };
}
