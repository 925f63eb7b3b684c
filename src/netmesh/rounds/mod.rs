//! Rounds (§6.5): how inputs come into the mesh.
//!
//! `order` numbers the inputs by locality. `start` makes the first simplices and puts every input
//! on the conflict list of one (`conflict_lists`). `round` is the main loop: a round chooses inputs
//! of every list (`net`), and `insert` inserts each (INSERTINPUT, INSERT). `update` has what an
//! insertion changes around it. `svr` is the baseline (§3), which has no rounds.
//!
//! What decides which input goes in next, and where inputs are meanwhile, belongs here.

pub(super) mod conflict_lists;
mod insert;
mod net;
pub(super) mod order;
pub(super) mod round;
pub(super) mod start;
pub(super) mod svr;
mod update;
