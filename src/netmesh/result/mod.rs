//! The result of a run as plain data: `output` writes its arrays by the numbers of `numbering`,
//! `boundary` those of segments and regions, and crops it to the domain. `left` and `beyond` list
//! the simplices and cells that do not keep the angle or the bound.

pub(super) mod beyond;
pub(super) mod boundary;
pub(super) mod left;
pub(super) mod numbering;
pub(super) mod output;
