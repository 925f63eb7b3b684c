//! A run from points to a rank's part of their mesh.

use crate::comm::{Communicator, Operation, agreed};
use crate::distributed::{DistributedMesh, Promise};
use crate::meshing::MAX_DIM;
use crate::work::{Notes, Step};
use crate::{meshing, numbering};
use netmesh::error::{Choice, Message, Name};
use netmesh::mesh::MIN_DIM;
use netmesh::options::ProgressFn;
use netmesh::{Algorithm, Error, ErrorKind, Extent, Options, Parameters, Result};

/// Collective: the mesh of the points of all ranks, `dim` coordinates each; a rank may have none.
///
/// # Errors
/// The same on all ranks, that of the lowest rank that has one: `Dimension` (out of range, or not the
/// same on all ranks), `NonFinite` (names point and coordinate), `InvalidArgument` (an option that is
/// out of range, not for meshes of several ranks, or not the same on all), and those of a run of the
/// core.
pub fn run(
    comm: &dyn Communicator,
    dim: usize,
    points: &[f64],
    options: &Options,
    progress: Option<&mut ProgressFn<'_>>,
) -> Result<DistributedMesh> {
    agreed(comm, || {
        check_dimension(dim)?;
        check_points(dim, points)?;
        check_options(options)
    })?;
    agreed(comm, || check_equal(comm, dim, options))?;
    let mut notes = Notes::new(comm);
    let pieces = agreed(comm, || meshing::mesh(comm, dim, points, options, progress, &mut notes))?;
    let mut mesh = agreed(comm, || numbering::number(comm, dim, points, pieces))?;
    agreed(comm, || notes.end(Step::Numbers, 0, mesh.simplex_count() as u64))?;
    mesh.work = notes.into_work();
    // A partition knows its own vertices only.
    if options.max_vertices != 0 && mesh.totals.vertices > options.max_vertices {
        let (most, made) = (options.max_vertices, mesh.totals.vertices);
        let message = Message::about(Name::MaxVertices, format!(" is {most}; the mesh has {made}"));
        return Err(Error::new(ErrorKind::Limit, message));
    }
    // The options held for the run.
    mesh.promise = Promise::of(&Parameters::resolve(dim, options)?);
    Ok(mesh)
}

fn check_dimension(dim: usize) -> Result<()> {
    if (MIN_DIM..=MAX_DIM).contains(&dim) {
        return Ok(());
    }
    let message = format!("dim is {dim}; meshes of several ranks are of {MIN_DIM} or {MAX_DIM}");
    Err(Error::new(ErrorKind::Dimension, message))
}

fn check_points(dim: usize, points: &[f64]) -> Result<()> {
    let Some(at) = points.iter().position(|x| !x.is_finite()) else { return Ok(()) };
    let (point, axis, value) = (at / dim, at % dim, points[at]);
    let message = format!(
        "points[{point}] has a non-finite coordinate {axis}: {value}; every coordinate must be finite"
    );
    Err(Error::new(ErrorKind::NonFinite, message))
}

/// Refuses what only one process can do.
fn check_options(options: &Options) -> Result<()> {
    let numbers = [
        (Name::MaxEdge, options.max_edge),
        (Name::DistanceRatio, options.distance_ratio),
        (Name::MinDihedral, options.min_dihedral),
    ];
    let number = numbers.into_iter().find(|&(_, value)| value != 0.0);
    let rule = "meshes of several ranks";
    let message = match (options.algorithm, options.extent) {
        (Algorithm::Netmesh, Extent::Auto | Extent::All) => match number {
            Some((name, value)) => {
                Message::about(name, format!(" is {value}; it must be 0 for {rule}"))
            }
            None if options.instruments => {
                Message::about(Name::Instruments, format!(" is not for {rule}"))
            }
            None => return Ok(()),
        },
        (Algorithm::Netmesh, extent) => {
            Message::about(Choice::Extent(extent), format!(" is not for {rule}"))
        }
        (algorithm, _) => {
            Message::about(Choice::Algorithm(algorithm), format!(" is not for {rule}"))
        }
    };
    Err(Error::new(ErrorKind::InvalidArgument, message))
}

/// Collective: that all ranks ask for the same.
fn check_equal(comm: &dyn Communicator, dim: usize, options: &Options) -> Result<()> {
    // All fields, as they print: floats so that no two print alike. Threads may differ.
    let asked = Options { threads: 1, ..options.clone() };
    let text = format!("{dim} {asked:?}");
    let hash = text.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    let mut least = [hash, dim as u64];
    comm.all_reduce_integers(&mut least, Operation::Min)?;
    let mut most = [hash, dim as u64];
    comm.all_reduce_integers(&mut most, Operation::Max)?;
    if least[1] != most[1] {
        let message = format!("dim is {} on one rank and {} on another", least[1], most[1]);
        return Err(Error::new(ErrorKind::Dimension, message));
    }
    if least[0] != most[0] {
        let rule = "options are not the same on all ranks; only threads, progress and user_data may differ";
        return Err(Error::new(ErrorKind::InvalidArgument, rule));
    }
    Ok(())
}

/// Collective: the bytes that all ranks have sent, and the most of one.
pub fn bytes_sent(comm: &dyn Communicator, mesh: &DistributedMesh) -> Result<(u64, u64)> {
    let mut sum = [mesh.bytes_sent];
    let mut most = sum;
    comm.all_reduce_integers(&mut sum, Operation::Sum)?;
    comm.all_reduce_integers(&mut most, Operation::Max)?;
    Ok((sum[0], most[0]))
}
