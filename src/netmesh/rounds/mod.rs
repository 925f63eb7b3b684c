//! Rounds (§6.5): how inputs come into the mesh.
//!
//! `start` makes the first simplices and puts every input on the conflict list of one. `round` is
//! the main loop: a round chooses inputs of every list (`net`), and inserts each. `svr` is the
//! baseline (§3), which has no rounds.
//!
//! Code that decides which input goes in next belongs here.

pub(super) mod net;
pub(super) mod round;
pub(super) mod start;
pub(super) mod svr;
