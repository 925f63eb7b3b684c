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
use crate::plot::Plot;
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
    /// How many runs at a time, where none is timed.
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
    pub again: Again,
}

/// What can be made again from the experiment's table, without a run.
pub enum Again {
    Report(fn(&Rows) -> Report),
    Plots(fn(&Rows) -> Vec<Plot>),
    Nothing,
}

/// In the order of the document.
pub const ALL: [Experiment; 8] = [
    Experiment { name: spread::NAME, run: spread::run, again: Again::Plots(spread::plots_again) },
    Experiment { name: growth::NAME, run: growth::run, again: Again::Report(growth::again) },
    Experiment {
        name: finishing::NAME,
        run: finishing::run,
        again: Again::Report(finishing::again),
    },
    Experiment {
        name: skew_lines::NAME,
        run: skew_lines::run,
        again: Again::Plots(skew_lines::plots_again),
    },
    Experiment { name: sizes::NAME, run: sizes::run, again: Again::Plots(sizes::plots_again) },
    Experiment { name: dimensions::NAME, run: dimensions::run, again: Again::Nothing },
    Experiment { name: cage_cells::NAME, run: cage_cells::run, again: Again::Nothing },
    Experiment { name: slivers::NAME, run: slivers::run, again: Again::Nothing },
];
