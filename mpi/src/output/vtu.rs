//! VTK's parallel unstructured grid: a file that names the pieces, and a piece of each rank with
//! its simplices and its ghosts. Arrays are appended raw, as in the core's VTU.

use super::of_path;
use super::unfinished::Unfinished;
use crate::comm::{Communicator, agreed};
use crate::distributed::DistributedMesh;
use netmesh::Result;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

const TRIANGLE: u8 = 5;
const TETRA: u8 = 10;

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

#[derive(Clone, Copy, PartialEq, Eq)]
enum Section {
    Point,
    Cell,
    Points,
    Cells,
}

/// Sections in the order of the XML, with their tags.
const SECTIONS: [(Section, &str, &str); 4] = [
    (Section::Point, "PointData", r#" Scalars="kind" GlobalIds="GlobalNodeId""#),
    (Section::Cell, "CellData", r#" GlobalIds="GlobalCellId""#),
    (Section::Points, "Points", ""),
    (Section::Cells, "Cells", ""),
];

struct Array {
    section: Section,
    name: &'static str,
    scalar: &'static str,
    scalar_size: u64,
    components: u64,
    write: fn(&DistributedMesh, &mut dyn Write) -> io::Result<()>,
}

impl Array {
    fn bytes(&self, mesh: &DistributedMesh) -> u64 {
        let tuples = match (self.section, self.name) {
            (Section::Point | Section::Points, _) => mesh.vertex_ids.len(),
            (_, "connectivity") => mesh.simplices.len() + mesh.ghost_simplices.len(),
            _ => mesh.simplex_count() + mesh.ghosts.len(),
        };
        self.scalar_size * self.components * tuples as u64
    }

    /// Writes the declaration of the array in the XML, with its offset, if it has one.
    fn write_declaration(
        &self,
        tag: &str,
        place: Option<u64>,
        out: &mut dyn Write,
    ) -> io::Result<()> {
        let Self { name, scalar, components, .. } = self;
        // Only so do readers take global ids for such.
        let id_type = if name.starts_with("Global") { r#" IdType="1""# } else { "" };
        write!(
            out,
            r#"<{tag} type="{scalar}"{id_type} Name="{name}" NumberOfComponents="{components}""#
        )?;
        match place {
            Some(offset) => writeln!(out, r#" format="appended" offset="{offset}"/>"#),
            None => writeln!(out, "/>"),
        }
    }
}

/// Arrays in the order of the XML. Ghosts and what only they have come last.
const ARRAYS: [Array; 11] = [
    point("kind", "UInt8", 1, |mesh, out| out.write_all(&mesh.kinds)),
    point("domain", "UInt64", 8, |mesh, out| write_words(mesh.vertex_domains.iter().copied(), out)),
    point("GlobalNodeId", "Int64", 8, |mesh, out| {
        write_words(mesh.vertex_ids.iter().copied(), out)
    }),
    point("vtkGhostType", "UInt8", 1, |mesh, out| {
        let mut owners = mesh.vertex_owners.iter();
        owners.try_for_each(|owner| out.write_all(&[ghost_type(*owner != mesh.rank as u32)]))
    }),
    cell("GlobalCellId", "Int64", 8, |mesh, out| {
        let own = (0..mesh.simplex_count() as u64).map(|simplex| mesh.first_simplex + simplex);
        write_words(own.chain(mesh.ghosts.iter().map(|ghost| ghost.id)), out)
    }),
    cell("vtkGhostType", "UInt8", 1, |mesh, out| {
        let own = (0..mesh.simplex_count()).map(|_| false);
        let mut all = own.chain(mesh.ghosts.iter().map(|_| true));
        all.try_for_each(|is_ghost| out.write_all(&[ghost_type(is_ghost)]))
    }),
    cell("rank", "UInt32", 4, |mesh, out| {
        let own = (0..mesh.simplex_count()).map(|_| mesh.rank as u32);
        let mut all = own.chain(mesh.ghosts.iter().map(|ghost| ghost.owner));
        all.try_for_each(|rank| out.write_all(&rank.to_le_bytes()))
    }),
    Array {
        section: Section::Points,
        components: 3,
        // VTK's points have three coordinates always.
        ..point("Points", "Float64", 8, |mesh, out| {
            for point in mesh.points.chunks_exact(mesh.dim) {
                for axis in 0..3 {
                    out.write_all(&point.get(axis).unwrap_or(&0.0).to_le_bytes())?;
                }
            }
            Ok(())
        })
    },
    of_cells("connectivity", "Int64", 8, |mesh, out| {
        write_words(mesh.simplices.iter().chain(&mesh.ghost_simplices).map(|v| u64::from(*v)), out)
    }),
    of_cells("offsets", "Int64", 8, |mesh, out| {
        let count = (mesh.simplex_count() + mesh.ghosts.len()) as u64;
        write_words((1..=count).map(|cell| cell * (mesh.dim as u64 + 1)), out)
    }),
    of_cells("types", "UInt8", 1, |mesh, out| {
        let kind = if mesh.dim == 2 { TRIANGLE } else { TETRA };
        (0..mesh.simplex_count() + mesh.ghosts.len()).try_for_each(|_| out.write_all(&[kind]))
    }),
];

type WriteArray = fn(&DistributedMesh, &mut dyn Write) -> io::Result<()>;

const fn array(
    section: Section,
    name: &'static str,
    scalar: &'static str,
    scalar_size: u64,
    write: WriteArray,
) -> Array {
    Array { section, name, scalar, scalar_size, components: 1, write }
}

const fn point(name: &'static str, scalar: &'static str, size: u64, write: WriteArray) -> Array {
    array(Section::Point, name, scalar, size, write)
}

const fn cell(name: &'static str, scalar: &'static str, size: u64, write: WriteArray) -> Array {
    array(Section::Cell, name, scalar, size, write)
}

const fn of_cells(name: &'static str, scalar: &'static str, size: u64, write: WriteArray) -> Array {
    array(Section::Cells, name, scalar, size, write)
}

fn ghost_type(is_duplicate: bool) -> u8 {
    if is_duplicate { DUPLICATE } else { 0 }
}

fn write_words(mut words: impl Iterator<Item = u64>, out: &mut dyn Write) -> io::Result<()> {
    words.try_for_each(|word| out.write_all(&word.to_le_bytes()))
}

/// Writes the piece of this rank. Arrays follow in the reverse of the order in which they are
/// declared, as the core's do.
fn write_piece(mesh: &DistributedMesh, out: &mut dyn Write) -> io::Result<()> {
    let (vertices, cells) = (mesh.vertex_ids.len(), mesh.simplex_count() + mesh.ghosts.len());
    let mut offset: u64 = ARRAYS.iter().map(|array| 8 + array.bytes(mesh)).sum();
    writeln!(
        out,
        r#"<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<UnstructuredGrid>
<Piece NumberOfPoints="{vertices}" NumberOfCells="{cells}">"#
    )?;
    for (section, tag, attributes) in SECTIONS {
        writeln!(out, "<{tag}{attributes}>")?;
        for array in ARRAYS.iter().filter(|array| array.section == section) {
            offset -= 8 + array.bytes(mesh);
            array.write_declaration("DataArray", Some(offset), out)?;
        }
        writeln!(out, "</{tag}>")?;
    }
    out.write_all(b"</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_")?;
    for array in ARRAYS.iter().rev() {
        out.write_all(&array.bytes(mesh).to_le_bytes())?;
        (array.write)(mesh, out)?;
    }
    out.write_all(b"\n</AppendedData>\n</VTKFile>\n")
}

/// Writes the file that names the pieces.
fn write_index(mesh: &DistributedMesh, path: &Path, out: &mut dyn Write) -> io::Result<()> {
    writeln!(
        out,
        r#"<?xml version="1.0"?>
<VTKFile type="PUnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<PUnstructuredGrid GhostLevel="1">"#
    )?;
    for (section, tag, attributes) in SECTIONS.iter().filter(|section| section.0 != Section::Cells)
    {
        writeln!(out, "<P{tag}{attributes}>")?;
        for array in ARRAYS.iter().filter(|array| array.section == *section) {
            array.write_declaration("PDataArray", None, out)?;
        }
        writeln!(out, "</P{tag}>")?;
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
