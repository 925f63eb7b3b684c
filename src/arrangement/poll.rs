//! Polls, by which long work can be watched and ended.

use crate::error::Result;

/// Function that is told of work done, in units of some 100 ns, and may end the operation by an
/// error.
pub type Poll<'a> = &'a mut dyn FnMut(u32) -> Result<()>;

/// Work after which the clock is read in any case.
pub const LONG: u32 = 1 << 12;
