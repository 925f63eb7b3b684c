//! The algorithm (the core's `distributed` has its parts): all ranks make the same coarse mesh of a
//! sample of the inputs ([`sample`]), which is divided into partitions ([`partitions`]). Each rank
//! makes some of them; what they leave at their interfaces is divided anew and joined, in phases,
//! and what is left then is taken out of all of them once more ([`phases`]). The pieces stay on the
//! ranks where they were made.
//!
//! The partitions follow from the inputs alone, each is made of the same pieces on any rank, and no
//! number of a rank enters any: so the mesh is the same on any number of ranks. A rank has its
//! partitions, the coarse mesh, and at times a seam: no rank has the whole.

mod finish;
mod partitions;
mod phases;
mod sample;

use crate::comm::{Communicator, agreed};
use crate::piece::Piece;
use crate::work::{Notes, Step};
use netmesh::distributed::Coarse;
use netmesh::distributed::memory::collected;
use netmesh::options::ProgressFn;
use netmesh::{Options, Progress, Result};

/// Dimensions in which meshes are made in partitions: above, most of a mesh is at interfaces.
pub const MAX_DIM: usize = 3;

/// Collective. Meshes the points of all ranks; each rank returns its pieces. `points` of all ranks
/// are finite and of one dimension, the options equal.
pub fn mesh(
    comm: &dyn Communicator,
    dim: usize,
    points: &[f64],
    options: &Options,
    progress: Option<&mut ProgressFn<'_>>,
    notes: &mut Notes<'_>,
) -> Result<Vec<Piece>> {
    let mut watch = Watch { progress, done: 0.0, share: 0.0, notes };
    match dim {
        2 => mesh_in::<2>(comm, points, options, &mut watch),
        3 => mesh_in::<3>(comm, points, options, &mut watch),
        _ => unreachable!("other dimensions are refused before"),
    }
}

fn mesh_in<const D: usize>(
    comm: &dyn Communicator,
    points: &[f64],
    options: &Options,
    watch: &mut Watch<'_, '_, '_>,
) -> Result<Vec<Piece>> {
    let points: Vec<[f64; D]> =
        collected(points.chunks_exact(D).map(|point| std::array::from_fn(|axis| point[axis])))?;
    let (first, total) = comm.exclusive_sum(points.len() as u64)?;
    let sample = sample::sample(comm, &points, first, total)?;
    let mut coarse = agreed(comm, || {
        let (own, names) = (
            collected(sample.iter().map(|input| input.point))?,
            collected(sample.iter().map(|input| input.name))?,
        );
        let small = partitions::small_cluster(sample.len(), total);
        watch.next(0.05, |progress| Coarse::new(&own, &names, small, options, Some(progress)))
    })?;
    watch.notes.end(Step::Coarse, sample.len() as u64, 0)?;
    let own = partitions::share(comm, &mut coarse, &sample, &points, [first, total], watch)?;
    watch.notes.end(Step::Inputs, points.len() as u64, 0)?;
    drop((sample, points));
    let pieces = phases::make(comm, &coarse, own, watch)?;
    finish::finish(comm, pieces)
}

/// Progress that the caller is told of all the parts that a run has on this rank, and their costs.
pub struct Watch<'a, 'b, 'c> {
    progress: Option<&'a mut ProgressFn<'b>>,
    notes: &'a mut Notes<'c>,
    /// The part of the run that is done, and that which goes on.
    done: f64,
    share: f64,
}

impl Watch<'_, '_, '_> {
    /// Does a part of the run that is `share` of it.
    fn next<T>(
        &mut self,
        share: f64,
        act: impl FnOnce(&mut ProgressFn<'_>) -> Result<T>,
    ) -> Result<T> {
        self.done += self.share;
        self.share = share;
        let Self { progress, done, share, .. } = self;
        act(&mut |own: &Progress| {
            let fraction = (*done + *share * own.fraction.clamp(0.0, 1.0)).min(1.0);
            progress.as_mut().is_none_or(|tell| tell(&Progress { fraction, ..*own }))
        })
    }
}
