//! Costs of a run on a rank, step by step: for [`crate::DistributedMesh::work`], and for the model
//! of docs/scaling.md.

use crate::comm::Communicator;
use crate::comm::mpi::processor_seconds;
use netmesh::Result;
use netmesh::distributed::memory::TryGrow;

/// A part of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// The sample, and the coarse mesh of it, which all ranks make.
    Coarse,
    /// Inputs are located in the coarse mesh and go to the ranks of their partitions.
    Inputs,
    /// A partition of a phase; phase 0 is that of the coarse mesh's partitions.
    Partition { phase: u32, number: u32 },
    /// The seams that a phase has left are divided and go to the ranks of their partitions.
    Seams { phase: u32 },
    /// Step that does what all phases have left.
    Rest,
    /// Step that makes ids, ghosts and interfaces.
    Numbers,
}

/// Cost of a step on this rank.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Work {
    pub step: Step,
    /// Inputs that waited for their insertion when it began.
    pub inputs: u64,
    /// Simplices that there were when it began.
    pub simplices: u64,
    /// Processor time of the thread that made it. Where ranks wait for each other, MPI may use
    /// some.
    pub seconds: f64,
    /// Number of bytes that this rank has sent to others.
    pub sent: u64,
}

impl Step {
    /// Returns the step's name, its phase and its number among the partitions of that, where it has
    /// any.
    pub fn parts(self) -> (&'static str, Option<u32>, Option<u32>) {
        match self {
            Self::Coarse => ("coarse", None, None),
            Self::Inputs => ("inputs", None, None),
            Self::Partition { phase, number } => ("partition", Some(phase), Some(number)),
            Self::Seams { phase } => ("seams", Some(phase), None),
            Self::Rest => ("rest", None, None),
            Self::Numbers => ("numbers", None, None),
        }
    }

    /// Returns true if ranks go through the step without a word to each other.
    pub fn is_alone(self) -> bool {
        matches!(self, Self::Partition { .. })
    }
}

/// Notes what every step takes; a step begins when the one before it ends.
pub struct Notes<'a> {
    comm: &'a dyn Communicator,
    seconds: f64,
    sent: u64,
    work: Vec<Work>,
}

impl<'a> Notes<'a> {
    pub fn new(comm: &'a dyn Communicator) -> Self {
        Self { comm, seconds: processor_seconds(), sent: comm.bytes_sent(), work: Vec::new() }
    }

    /// Notes that a step has ended.
    pub fn end(&mut self, step: Step, inputs: u64, simplices: u64) -> Result<()> {
        let (seconds, sent) = (processor_seconds(), self.comm.bytes_sent());
        let (took, own) = (seconds - self.seconds, sent - self.sent);
        self.work.try_push(Work { step, inputs, simplices, seconds: took, sent: own })?;
        (self.seconds, self.sent) = (seconds, sent);
        Ok(())
    }

    pub fn into_work(self) -> Vec<Work> {
        self.work
    }
}
