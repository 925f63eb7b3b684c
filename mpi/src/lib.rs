//! netmesh on any number of processes: the same mesh as on one, of points that are distributed over the
//! ranks of an MPI program.
//!
//! | module | what it is | uses |
//! |---|---|---|
//! | `memory` | growth that may be refused | |
//! | `words` | messages as 64-bit words | `memory` |
//! | `comm` | how ranks talk, and how they fail together; MPI, and threads in its place | `memory` |
//! | `agreement` | arguments that must be the same on all ranks | `comm` |
//! | `piece` | what the algorithm leaves on a rank | |
//! | `work` | what the steps of a run take on a rank | `memory`, `comm` |
//! | `meshing` | the algorithm | `memory`, `words`, `comm`, `piece`, `work` |
//! | `distributed` | a rank's part of the mesh, as plain arrays | `work` |
//! | `numbering` | from pieces to that: ids, ghosts, interfaces | `memory`, `words`, `comm`, `piece`, `distributed` |
//! | `run` | a run: the checks, the algorithm, the numbers | `comm`, `agreement`, `meshing`, `distributed`, `numbering`, `work` |
//! | `certificate` | the checker of a mesh of several ranks, a file per rule, apart from what makes it | `memory`, `words`, `comm`, `agreement`, `distributed` |
//! | `input` | each rank's share of a file of points | `memory`, `comm`, `agreement` |
//! | `output` | files that all ranks write, complete or not at all | `memory`, `words`, `comm`, `agreement`, `distributed` |
//! | `capi` | the C ABI, and with `comm::mpi` the only `unsafe` | all but `input` |

#![deny(unsafe_code)]

pub mod agreement;
#[allow(unsafe_code)]
pub mod capi;
pub mod certificate;
pub mod comm;
pub mod distributed;
pub mod input;
mod memory;
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
