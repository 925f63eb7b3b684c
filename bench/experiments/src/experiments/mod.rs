//! The experiments, a file each.

mod cage_cells;
mod dimensions;
mod finishing;
mod growth;
mod sizes;
mod skew_lines;
mod slivers;
mod spread;

pub use dimensions::added_memory;

use crate::peers::Peers;
use crate::report::Report;
use crate::table::Rows;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Seconds for all, for the tests: the figures mean nothing.
    Tiny,
    Quick,
    Full,
}

pub struct Context {
    pub scale: Scale,
    /// Number of runs at a time, where none is timed.
    pub jobs: usize,
    pub peers: Peers,
}

impl Context {
    pub fn pick<T>(&self, tiny: T, quick: T, full: T) -> T {
        match self.scale {
            Scale::Tiny => tiny,
            Scale::Quick => quick,
            Scale::Full => full,
        }
    }
}

pub struct Experiment {
    pub name: &'static str,
    pub run: fn(&Context) -> Report,
    /// Function that makes the verdicts again from the experiment's table, without a run.
    pub again: Option<fn(&Rows) -> Report>,
}

/// In the order of the document.
pub const ALL: [Experiment; 8] = [
    Experiment { name: spread::NAME, run: spread::run, again: None },
    Experiment { name: growth::NAME, run: growth::run, again: Some(growth::again) },
    Experiment { name: finishing::NAME, run: finishing::run, again: Some(finishing::again) },
    Experiment { name: skew_lines::NAME, run: skew_lines::run, again: None },
    Experiment { name: sizes::NAME, run: sizes::run, again: None },
    Experiment { name: dimensions::NAME, run: dimensions::run, again: None },
    Experiment { name: cage_cells::NAME, run: cage_cells::run, again: None },
    Experiment { name: slivers::NAME, run: slivers::run, again: None },
];
