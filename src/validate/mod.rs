//! validate

use crate::error::Result;
use crate::mesh::{Inputs, Triangulation};

/// The rule that a [`Violation`] breaks (values are part of the C ABI: append only).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum ViolationKind {
    None = 0,
}

/// One broken rule, with the ids it concerns ([`crate::NONE`] where none).
#[derive(Clone, Debug, PartialEq)]
pub struct Violation {
    pub kind: ViolationKind,
    pub simplex: u32,
    pub vertex: u32,
    pub domain: u32,
    pub message: String,
}

/// What the certificate checker found.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The highest level that holds in full; 0 if level 1 does not.
    pub level: u32,
    pub violations: u64,
    /// Number of single checks made.
    pub checked: u64,
    pub first: Option<Violation>,
}

/// Checks levels `1..=level` (1 topology, 2 geometry, 3 the paper).
///
/// # Errors
/// `InvalidArgument` if `level` is not 1, 2 or 3.
pub fn validate(_inputs: &Inputs, _triangulation: &Triangulation, _level: u32) -> Result<Report> {
    Ok(Report { level: 0, violations: 0, checked: 0, first: None })
}
