//! The paper's algorithm (§6), one file per operation.

pub mod parameters;

use crate::error::{Error, ErrorKind, Result};
use crate::mesh::{Inputs, Triangulation};
use crate::options::{Options, ProgressFn};

/// Meshes `inputs`; picks the monomorphisation for the dimension.
pub fn run(
    inputs: &Inputs,
    options: &Options,
    _progress: Option<&mut ProgressFn<'_>>,
) -> Result<Triangulation> {
    parameters::Parameters::resolve(inputs.dim(), options)?;
    Err(Error::new(ErrorKind::State, "the core is being built"))
}
