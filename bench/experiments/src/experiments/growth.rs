use super::Context;
use crate::report::Report;
pub const NAME: &str = "growth";
pub fn run(_: &Context) -> Report { Report { name: NAME, ..Report::default() } }
