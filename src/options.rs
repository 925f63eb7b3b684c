//! Options of a run, and its reports of progress. [`table`] has the options; [`crate::parameters`]
//! fills in the defaults and refuses what is out of range.

mod choices;
mod table;
pub mod text;

pub use choices::{
    Algorithm, Choice, Choices, Chosen, Criterion, Crossings, Extent, GivesWay, Interior, Labels,
    NetOrdering, Output,
};
pub use table::{Bounds, Group, Kind, Row, TABLE, Value, Word};
pub(crate) use table::{each_option, pick};

macro_rules! declare_options {
    ($($name:ident $field:ident: $type:ty {
        default: $default:expr, group: $group:ident, on_ranks: $on_ranks:expr,
        kind: $kind:expr, help: $help:literal,
    })*) => {
        /// Options of a run. For all doubles and `max_vertices` 0 is the default for the dimension.
        #[derive(Clone, Debug, PartialEq)]
        pub struct Options {
            $(#[doc = $help] pub $field: $type,)*
        }

        impl Default for Options {
            fn default() -> Self {
                Self { $($field: $default,)* }
            }
        }
    };
}
each_option!(declare_options);

/// Stages of a run, as progress reports name them. Later versions may append stages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(i32)]
pub enum Phase {
    /// Checks, scaling, the first simplices.
    Prepare = 0,
    /// Insertion of the inputs, with the refinement that their order asks for.
    Insert = 1,
    /// Work that turns the hierarchy into a well-spaced mesh, if that is asked for, and refinement
    /// to the bound.
    Finish = 2,
    /// Making of the arrays that hold the result.
    Export = 3,
}

/// A progress report.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    pub phase: Phase,
    /// Monotone in \[0, 1\]; -1 if unknown.
    pub fraction: f64,
    pub inputs_inserted: u64,
    pub vertices: u64,
    pub simplices: u64,
}

/// Called about every 30 ms, and where a round or a stage ends, on the thread that runs;
/// `false` cancels the run.
pub type ProgressFn<'a> = dyn FnMut(&Progress) -> bool + 'a;

/// The size that is asked for at a point, in the box of the inputs: a number above 0, infinite
/// where there is no bound. Any other answer ends the run. Called on the thread that runs.
pub type SizeFn<'a> = dyn Fn(&[f64]) -> f64 + 'a;
