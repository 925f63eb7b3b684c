//! netmesh on any number of processes: the mesh that one makes, of points that are distributed over
//! the ranks of an MPI program.
//!
//! A module uses those that its row names, and no others:
//!
//! | module | uses |
//! |---|---|
//! | `words` | |
//! | `comm` | |
//! | `agreement` | `comm` |
//! | `piece` | |
//! | `work` | `comm` |
//! | `meshing` | `words`, `comm`, `piece`, `work` |
//! | `distributed` | `work` |
//! | `numbering` | `words`, `comm`, `piece`, `distributed` |
//! | `run` | `comm`, `agreement`, `meshing`, `distributed`, `numbering`, `work` |
//! | `certificate` | `words`, `comm`, `agreement`, `distributed` |
//! | `input` | `comm`, `agreement` |
//! | `output` | `words`, `comm`, `agreement`, `distributed` |
//! | `capi` | all but `input` |
//!
//! - `words`: messages as 64-bit words;
//! - `comm`: communication of ranks and their common failures; MPI, and threads in its place;
//! - `agreement`: arguments that must be equal on all ranks;
//! - `piece`: pieces of the mesh that the algorithm leaves on a rank;
//! - `work`: costs of the steps of a run on a rank;
//! - `meshing`: the algorithm;
//! - `distributed`: a rank's part of the mesh, as plain arrays;
//! - `numbering`: makes that of pieces: ids, ghosts, interfaces;
//! - `run`: a run: the checks, the algorithm, the numbers;
//! - `certificate`: the checker of a mesh of several ranks, a file per rule, apart from what makes
//!   it;
//! - `input`: each rank's share of a file of points;
//! - `output`: files that all ranks write, complete or not at all;
//! - `capi`: the C ABI, and with `comm::mpi` the only `unsafe`.

#![deny(unsafe_code)]

pub mod agreement;
#[allow(unsafe_code)]
pub mod capi;
pub mod certificate;
pub mod comm;
pub mod distributed;
pub mod input;
pub mod meshing;
pub mod numbering;
pub mod output;
pub mod piece;
mod run;
mod words;
pub mod work;

pub use certificate::validate;
pub use distributed::DistributedMesh;
pub use run::{bytes_sent, run};
