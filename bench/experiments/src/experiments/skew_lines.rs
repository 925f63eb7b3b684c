use super::Context;
use crate::report::Report;
pub const NAME: &str = "skew_lines";
pub fn run(_: &Context) -> Report { Report { name: NAME, ..Report::default() } }
