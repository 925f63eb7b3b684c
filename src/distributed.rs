//! Meshes that no process has all of: what a program that makes one on several machines needs, and
//! what it sends. Communication is its own. [`Coarse`] tells the way.

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
