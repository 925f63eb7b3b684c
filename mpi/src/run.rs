//! A run from points to a rank's part of their mesh.

use crate::agreement::{Arguments, require_same};
use crate::comm::{Communicator, Operation, agreed};
use crate::distributed::{DistributedMesh, Promise};
use crate::meshing::MAX_DIM;
use crate::work::{Notes, Step};
use crate::{meshing, numbering};
use netmesh::error::{Message, Name};
use netmesh::mesh::MIN_DIM;
use netmesh::options::{ProgressFn, Row, TABLE, Value};
use netmesh::{Error, ErrorKind, Extent, Options, Parameters, Result};

/// Collective. Meshes the points of all ranks, `dim` coordinates each; a rank may have none.
///
/// # Errors
/// All ranks answer the error of the lowest rank that has one: `Dimension` (out of range, or not
/// the same on all ranks), `NonFinite` (names point and coordinate), `InvalidArgument` (an option
/// that is out of range, not for meshes of several ranks, or not the same on all), and those of a
/// run of the core.
pub fn run(
    comm: &dyn Communicator,
    dim: usize,
    points: &[f64],
    options: &Options,
    progress: Option<&mut ProgressFn<'_>>,
) -> Result<DistributedMesh> {
    require_same(comm, "", || {
        check_dimension(dim)?;
        check_points(dim, points)?;
        check_options(options)?;
        // Threads may differ.
        let asked = Options { threads: 1, ..options.clone() };
        let arguments = Arguments::of_call("nm_mpi_run").and("dim", dim);
        Ok(arguments.and_fields(&asked, |field| format!("options.{field}")))
    })?;
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
        "points[{point}] has a non-finite coordinate {axis}: {value}; every coordinate must be \
         finite"
    );
    Err(Error::new(ErrorKind::NonFinite, message))
}

/// Refuses the first option that only one process has, where another value than its default is
/// asked for. The header and `netmesh-mpi --help` list these options.
fn check_options(options: &Options) -> Result<()> {
    let defaults = Options::default();
    // No segments are there to enclose anything: an automatic extent is all.
    let extent = match options.extent {
        Extent::All => defaults.extent,
        other => other,
    };
    let asked = Options { extent, ..options.clone() };
    let mut refused = TABLE.iter().filter(|row| !row.on_ranks);
    match refused.find(|row| row.get(&asked) != row.get(&defaults)) {
        None => Ok(()),
        Some(row) => Err(Error::invalid(refusal(row, &asked))),
    }
}

/// Returns the sentence about an option that meshes of several ranks do not have.
fn refusal(row: &Row, asked: &Options) -> Message {
    let rest = match row.get(asked) {
        Value::Number(value) => format!(" is {value}; it must be 0 for meshes of several ranks"),
        _ => " is not for meshes of several ranks".to_owned(),
    };
    Message::about(Name::of(row, asked), rest)
}

/// Collective. Returns the bytes that all ranks have sent, and the most of one.
pub fn bytes_sent(comm: &dyn Communicator, mesh: &DistributedMesh) -> Result<(u64, u64)> {
    let mut sum = [mesh.bytes_sent];
    let mut most = sum;
    comm.all_reduce_integers(&mut sum, Operation::Sum)?;
    comm.all_reduce_integers(&mut most, Operation::Max)?;
    Ok((sum[0], most[0]))
}

#[cfg(test)]
mod tests {
    use netmesh::options::TABLE;

    /// Returns the names of options in a list that is between two phrases of a text.
    fn listed(text: &str, from: &str, to: &str) -> Vec<String> {
        let rest = text.split_once(from).map(|(_, rest)| rest).expect("the list begins");
        let list = rest.split_once(to).map(|(list, _)| list).expect("the list ends");
        let mut names: Vec<_> = list
            .split(|c: char| !(c.is_ascii_lowercase() || c == '_'))
            .filter(|word| *word == "size" || TABLE.iter().any(|row| row.name == *word))
            .map(str::to_owned)
            .collect();
        names.sort();
        names
    }

    /// Compares the header's list with the table; that of the function of sizes is in `capi`,
    /// which alone knows it.
    #[test]
    fn the_header_lists_every_refusal() {
        let header = include_str!("../include/netmesh_mpi.h");
        let refused = TABLE.iter().filter(|row| !row.on_ranks);
        let mut expected: Vec<_> = refused.map(|row| row.name.to_owned()).collect();
        expected.push("size".to_owned());
        expected.sort();
        assert_eq!(listed(header, "Always refused: ", "Errors"), expected);
    }
}
