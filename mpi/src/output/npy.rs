//! NumPy arrays of the whole mesh: points by id, simplices by id.

use super::unfinished::Unfinished;
use super::{rows, shared};
use crate::comm::{Communicator, agreed};
use crate::distributed::DistributedMesh;
use netmesh::Result;
use netmesh::distributed::memory::with_capacity;
use std::path::{Path, PathBuf};

/// Numbers begin here.
const HEADER: usize = 128;

/// Returns the files of the array of points and of that of simplices.
pub fn files(path: &Path) -> [PathBuf; 2] {
    ["points", "simplices"].map(|what| path.with_extension(format!("{what}.npy")))
}

/// Collective. Writes the arrays to `unfinished`, which are [`files`]. Row v of the points is
/// vertex v, and that of an input which is equal to one before it is its point: row i is input i.
/// The simplices are unsigned 64-bit ids of vertices.
pub fn write(
    comm: &dyn Communicator,
    mesh: &DistributedMesh,
    unfinished: Unfinished,
) -> Result<()> {
    write_points(comm, mesh, unfinished.temporary(0))?;
    write_simplices(comm, mesh, unfinished.temporary(1))?;
    unfinished.take_place(comm)
}

fn write_points(comm: &dyn Communicator, mesh: &DistributedMesh, path: &Path) -> Result<()> {
    let (totals, row) = (mesh.totals, 8 * mesh.dim as u64);
    let added = (0..mesh.own_vertices as u32).filter_map(|vertex| {
        let (id, owner) = (mesh.vertex_ids[vertex as usize], mesh.vertex_owners[vertex as usize]);
        let is_written_here = id >= totals.inputs && owner == mesh.rank as u32;
        is_written_here.then(|| (id - totals.inputs, mesh.point(vertex)))
    });
    let block =
        agreed(comm, || rows::gather(comm, totals.vertex_ids - totals.inputs, mesh.dim, added))?;
    let inputs = agreed(comm, || {
        let mut bytes = with_capacity(8 * mesh.inputs.len())?;
        mesh.inputs.iter().for_each(|x| bytes.extend_from_slice(&x.to_le_bytes()));
        Ok(bytes)
    })?;
    let header = header("<f8", totals.vertex_ids, mesh.dim);
    let head: &[u8] = if mesh.rank == 0 { &header } else { &[] };
    let place = |id: u64| HEADER as u64 + id * row;
    let parts = [
        (0, head),
        (place(mesh.first_input), &inputs[..]),
        (place(totals.inputs + block.start), &block.bytes[..]),
    ];
    shared::write(comm, path, &parts)
}

fn write_simplices(comm: &dyn Communicator, mesh: &DistributedMesh, path: &Path) -> Result<()> {
    let size = mesh.dim + 1;
    let ids = agreed(comm, || {
        let mut bytes = with_capacity(8 * mesh.simplices.len())?;
        let ids = mesh.simplices.iter().map(|vertex| mesh.vertex_ids[*vertex as usize]);
        ids.for_each(|id| bytes.extend_from_slice(&id.to_le_bytes()));
        Ok(bytes)
    })?;
    let header = header("<u8", mesh.totals.simplices, size);
    let head: &[u8] = if mesh.rank == 0 { &header } else { &[] };
    let start = HEADER as u64 + 8 * size as u64 * mesh.first_simplex;
    shared::write(comm, path, &[(0, head), (start, &ids[..])])
}

fn header(kind: &str, rows: u64, columns: usize) -> Vec<u8> {
    let text =
        format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({rows}, {columns}), }}");
    let length = HEADER - 10;
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend_from_slice(&(length as u16).to_le_bytes());
    bytes.extend_from_slice(format!("{text:<width$}\n", width = length - 1).as_bytes());
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_header_is_as_long_as_the_others() {
        for (rows, columns) in [(0, 2), (u64::MAX, 9)] {
            let header = header("<u8", rows, columns);
            assert_eq!((header.len(), header.last()), (HEADER, Some(&b'\n')));
        }
    }
}
