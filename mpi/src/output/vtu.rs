//! VTK's parallel unstructured grid: a file that names the pieces, and a piece of each rank with
//! its simplices and its ghosts.

use super::of_path;
use super::unfinished::Unfinished;
use crate::comm::{Communicator, agreed};
use crate::distributed::DistributedMesh;
use netmesh::Result;
use netmesh::io::vtk::{DataArray, Grid, Numbers, Scalar, Section, write_points, write_types};
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Value of VTK's DUPLICATECELL and DUPLICATEPOINT.
const DUPLICATE: u8 = 1;

/// Returns the pieces, and the file that names them.
pub fn files(path: &Path, ranks: usize) -> Vec<PathBuf> {
    let pieces = (0..ranks).map(|rank| piece_path(path, rank));
    pieces.chain([path.to_owned()]).collect()
}

/// Collective. Writes the pieces and their index to `unfinished`, which are [`files`].
pub fn write(
    comm: &dyn Communicator,
    mesh: &DistributedMesh,
    path: &Path,
    unfinished: Unfinished,
) -> Result<()> {
    agreed(comm, || {
        create(unfinished.temporary(comm.rank()), &|out| write_piece(mesh, out))?;
        match comm.rank() {
            0 => create(unfinished.temporary(comm.size()), &|out| write_index(mesh, path, out)),
            _ => Ok(()),
        }
    })?;
    unfinished.take_place(comm)
}

fn piece_path(path: &Path, rank: usize) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}_{rank}.vtu"))
}

/// Creates a file whose data is on the disk afterwards.
fn create(path: &Path, body: &dyn Fn(&mut dyn Write) -> io::Result<()>) -> Result<()> {
    let file = File::create_new(path).map_err(|error| of_path(path, "cannot create", &error))?;
    let mut out = BufWriter::with_capacity(1 << 16, file);
    let written = body(&mut out).and_then(|()| out.flush()).and_then(|()| out.get_ref().sync_all());
    if written.is_err() {
        // What is left in the buffer would be tried again.
        let _ = out.into_parts();
    }
    written.map_err(|error| of_path(path, "cannot write", &error))
}

type Array = DataArray<'static, DistributedMesh>;

/// Returns the attributes of the tag of a section.
fn attributes(section: Section) -> &'static str {
    match section {
        Section::Point => r#" Scalars="kind" GlobalIds="GlobalNodeId""#,
        Section::Cell => r#" GlobalIds="GlobalCellId""#,
        _ => "",
    }
}

/// Returns the arrays of the part of a rank, those of a section in the order of the XML. Ghosts and
/// what only they have come last.
fn arrays(mesh: &DistributedMesh) -> [Array; 11] {
    let (vertices, cells) = (mesh.vertex_ids.len(), mesh.simplex_count() + mesh.ghosts.len());
    let entries = mesh.simplices.len() + mesh.ghost_simplices.len();
    let point = |name, scalar, write| array(Section::Point, name, scalar, vertices, write);
    let cell = |name, scalar, write| array(Section::Cell, name, scalar, cells, write);
    [
        point("kind", Scalar::UInt8, |mesh, out| out.write_all(&mesh.kinds)),
        point("domain", Scalar::UInt64, |mesh, out| {
            write_words(mesh.vertex_domains.iter().copied(), out)
        }),
        Array {
            is_global_id: true,
            ..point("GlobalNodeId", Scalar::Int64, |mesh, out| {
                write_words(mesh.vertex_ids.iter().copied(), out)
            })
        },
        point("vtkGhostType", Scalar::UInt8, |mesh, out| {
            let mut owners = mesh.vertex_owners.iter();
            owners.try_for_each(|owner| out.write_all(&[ghost_type(*owner != mesh.rank as u32)]))
        }),
        Array {
            is_global_id: true,
            ..cell("GlobalCellId", Scalar::Int64, |mesh, out| {
                let own = 0..mesh.simplex_count() as u64;
                let own = own.map(|simplex| mesh.first_simplex + simplex);
                write_words(own.chain(mesh.ghosts.iter().map(|ghost| ghost.id)), out)
            })
        },
        cell("vtkGhostType", Scalar::UInt8, |mesh, out| {
            let own = (0..mesh.simplex_count()).map(|_| false);
            let mut all = own.chain(mesh.ghosts.iter().map(|_| true));
            all.try_for_each(|is_ghost| out.write_all(&[ghost_type(is_ghost)]))
        }),
        cell("rank", Scalar::UInt32, |mesh, out| {
            let own = (0..mesh.simplex_count()).map(|_| mesh.rank as u32);
            let mut all = own.chain(mesh.ghosts.iter().map(|ghost| ghost.owner));
            all.try_for_each(|rank| out.write_all(&rank.to_le_bytes()))
        }),
        Array {
            components: 3,
            ..array(Section::Points, "Points", Scalar::Float64, vertices, |mesh, out| {
                write_points(&mesh.points, mesh.dim, out)
            })
        },
        array(Section::Cells, "connectivity", Scalar::Int64, entries, |mesh, out| {
            let vertices = mesh.simplices.iter().chain(&mesh.ghost_simplices);
            write_words(vertices.map(|v| u64::from(*v)), out)
        }),
        array(Section::Cells, "offsets", Scalar::Int64, cells, |mesh, out| {
            let count = (mesh.simplex_count() + mesh.ghosts.len()) as u64;
            write_words((1..=count).map(|cell| cell * (mesh.dim as u64 + 1)), out)
        }),
        array(Section::Cells, "types", Scalar::UInt8, cells, |mesh, out| {
            write_types(mesh.dim, mesh.simplex_count() + mesh.ghosts.len(), out)
        }),
    ]
}

fn array(
    section: Section,
    name: &'static str,
    scalar: Scalar,
    tuples: usize,
    write: fn(&DistributedMesh, &mut dyn Write) -> io::Result<()>,
) -> Array {
    let numbers = Numbers::Written(write);
    Array { section, name, scalar, components: 1, tuples, is_global_id: false, numbers }
}

fn ghost_type(is_duplicate: bool) -> u8 {
    if is_duplicate { DUPLICATE } else { 0 }
}

fn write_words(mut words: impl Iterator<Item = u64>, out: &mut dyn Write) -> io::Result<()> {
    words.try_for_each(|word| out.write_all(&word.to_le_bytes()))
}

fn write_piece(mesh: &DistributedMesh, out: &mut dyn Write) -> io::Result<()> {
    let (points, cells) = (mesh.vertex_ids.len(), mesh.simplex_count() + mesh.ghosts.len());
    Grid { points, cells, attributes, arrays: [&arrays(mesh), &[]] }.write(mesh, out)
}

/// Writes the file that names the pieces.
fn write_index(mesh: &DistributedMesh, path: &Path, out: &mut dyn Write) -> io::Result<()> {
    writeln!(
        out,
        r#"<?xml version="1.0"?>
<VTKFile type="PUnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<PUnstructuredGrid GhostLevel="1">"#
    )?;
    for section in [Section::Point, Section::Cell, Section::Points] {
        writeln!(out, "<P{}{}>", section.tag(), attributes(section))?;
        for array in arrays(mesh).iter().filter(|array| array.section == section) {
            writeln!(out, "{}", array.declaration(None))?;
        }
        writeln!(out, "</P{}>", section.tag())?;
    }
    for rank in 0..mesh.ranks {
        let piece = piece_path(path, rank);
        let name = piece.file_name().unwrap_or_default().to_string_lossy();
        writeln!(out, r#"<Piece Source="{}"/>"#, escaped(&name))?;
    }
    out.write_all(b"</PUnstructuredGrid>\n</VTKFile>\n")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}
