//! Meshes that no process has all of. A coarse mesh of a sample of the inputs, which all processes
//! make alike, is cut into partitions. Each is a [`Piece`], plain data, and goes through rounds and
//! refinement as the partitions of one process do (`partitions`). What it could not do, for others
//! have a share in it, is at its interface: the simplices there, the seam, are put together with
//! those of the other side and go through the same. Seams are cut anew for that, along other planes
//! ([`Bisection`]): what is left then lies where planes of two phases cross, after the next phase
//! where those of three do, and in the end nowhere. Everything else is settled and stays where it
//! is.
//!
//! ```text
//!     .     |     .         |  planes of the first phase, with seams along them
//!     .     |     .         .  planes of the second: a partition has a stretch of seam
//!   ..x.....|.....x..       x  what is left for the third
//!     .     |     .
//! ```
//!
//! The result of a partition depends on the pieces that it is made of, and on nothing else: not on
//! where it is made, nor on how many processes there are.
//!
//! The paper allows any order of insertions (§6.3, §6.4), as for partitions of one process. The
//! sample is a part of the inputs, chosen by their coordinates.

mod assembly;
mod bisection;
mod bytes;
mod coarse;
mod hierarchy;
mod maker;
mod names;
mod piece;
mod plain;
mod seam;

mod thinning;

pub use bisection::Bisection;
pub use coarse::{Coarse, Located};
pub use maker::Maker;
pub use names::MADE;
pub use piece::Piece;
pub use plain::{HULL, INTERFACE, NO_DOMAIN, PlainDomain, PlainPiece};
pub use seam::RINGS;

#[cfg(test)]
mod tests;
