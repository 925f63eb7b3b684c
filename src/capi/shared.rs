//! Parts of this boundary that others of netmesh's, the C ABI on MPI and the Python package, use as
//! well. Not for C, and no promise.

pub use super::environment::Environment;
pub use super::error::null_argument;
pub use super::handle::barrier;
pub use super::memory::{OutStruct, Versioned, copy_out, read_rows, utf8_path};
pub use super::options::encode;
pub use super::run::{read_options, report};
pub use super::words::in_words_of_c;
