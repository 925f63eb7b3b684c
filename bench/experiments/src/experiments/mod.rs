//! The experiments, a file each.

mod closing;
mod dimensions;
mod finishing;
mod growth;
mod sizes;
mod skew_lines;
mod spread;

pub use dimensions::added_memory;

use crate::peers::Peers;
use crate::report::Report;

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
}

/// In the order of the document.
pub const ALL: [Experiment; 7] = [
    Experiment { name: spread::NAME, run: spread::run },
    Experiment { name: growth::NAME, run: growth::run },
    Experiment { name: finishing::NAME, run: finishing::run },
    Experiment { name: skew_lines::NAME, run: skew_lines::run },
    Experiment { name: sizes::NAME, run: sizes::run },
    Experiment { name: dimensions::NAME, run: dimensions::run },
    Experiment { name: closing::NAME, run: closing::run },
];
