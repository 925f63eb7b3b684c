//! Ranks that are processes of an MPI program.

mod files;
mod ranks;

pub use files::SharedFile;
pub use ranks::{Ranks, begin, end, processor_seconds};
