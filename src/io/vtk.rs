//! VTK's XML of unstructured grids: arrays with their declarations, as appended raw binary. VTU
//! files are written so, and the pieces of a mesh on several ranks.

use std::fmt;
use std::io::{self, Write};

/// Section of the XML that declares an array, in the order of the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Section {
    /// Data of neither points nor cells.
    Field,
    Point,
    Cell,
    Points,
    Cells,
}

impl Section {
    /// Every section, in the order of the file.
    pub const ALL: [Self; 5] = [Self::Field, Self::Point, Self::Cell, Self::Points, Self::Cells];

    /// Returns the tag of the section.
    pub fn tag(self) -> &'static str {
        match self {
            Self::Field => "FieldData",
            Self::Point => "PointData",
            Self::Cell => "CellData",
            Self::Points => "Points",
            Self::Cells => "Cells",
        }
    }
}

/// Type of the numbers of an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scalar {
    UInt8,
    Int32,
    UInt32,
    Int64,
    UInt64,
    Float64,
}

impl Scalar {
    /// Returns the number of bytes of a number.
    fn size(self) -> u64 {
        match self {
            Self::UInt8 => 1,
            Self::Int32 | Self::UInt32 => 4,
            Self::Int64 | Self::UInt64 | Self::Float64 => 8,
        }
    }
}

/// Numbers of an array.
pub enum Numbers<'a, S> {
    Values(&'a [f64]),
    /// Function that writes the numbers of a source, little-endian.
    Written(fn(&S, &mut dyn Write) -> io::Result<()>),
}

/// Array of a grid, which is made of a source.
pub struct DataArray<'a, S> {
    pub section: Section,
    pub name: &'a str,
    pub scalar: Scalar,
    pub components: u64,
    pub tuples: usize,
    /// True for ids in the whole mesh of which the grid is a piece: only so do readers take them
    /// for such.
    pub is_global_id: bool,
    pub numbers: Numbers<'a, S>,
}

impl<S> DataArray<'_, S> {
    /// Returns the number of bytes of the numbers.
    fn bytes(&self) -> u64 {
        self.scalar.size() * self.components * self.tuples as u64
    }

    /// Returns the number of bytes with the length before them, which is of the file's
    /// `header_type`.
    fn size_with_length(&self) -> u64 {
        8 + self.bytes()
    }

    /// Returns the declaration of the array: of a piece with its offset, of an index without.
    pub fn declaration(&self, offset: Option<u64>) -> impl fmt::Display + '_ {
        Declaration { array: self, offset }
    }

    fn write_numbers(&self, source: &S, out: &mut dyn Write) -> io::Result<()> {
        out.write_all(&self.bytes().to_le_bytes())?;
        match self.numbers {
            Numbers::Values(values) => write_numbers(values.iter().map(|x| x.to_le_bytes()), out),
            Numbers::Written(write) => write(source, out),
        }
    }
}

/// Declaration of an array; written in place, without a string between.
struct Declaration<'a, S> {
    array: &'a DataArray<'a, S>,
    offset: Option<u64>,
}

impl<S> fmt::Display for Declaration<'_, S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let DataArray { section, name, scalar, components, tuples, .. } = self.array;
        let tag = if self.offset.is_some() { "DataArray" } else { "PDataArray" };
        let id_type = if self.array.is_global_id { r#" IdType="1""# } else { "" };
        write!(f, r#"<{tag} type="{scalar:?}"{id_type} Name="{name}""#)?;
        write!(f, r#" NumberOfComponents="{components}""#)?;
        if *section == Section::Field {
            write!(f, r#" NumberOfTuples="{tuples}""#)?;
        }
        match self.offset {
            Some(offset) => write!(f, r#" format="appended" offset="{offset}"/>"#),
            None => f.write_str("/>"),
        }
    }
}

/// Unstructured grid as a file has it.
pub struct Grid<'a, S> {
    pub points: usize,
    pub cells: usize,
    /// Attributes of the tags of sections, each with a blank before it.
    pub attributes: fn(Section) -> &'static str,
    /// Arrays in lists, one after another: those of a section in the order of the file.
    pub arrays: [&'a [DataArray<'a, S>]; 2],
}

impl<'a, S> Grid<'a, S> {
    /// Writes the XML that says where the arrays are, then the arrays.
    ///
    /// The arrays follow in the reverse of the order in which the XML declares them. meshio (5.3)
    /// takes them one after the other, looks each up by its offset and overwrites that with one of
    /// its own, which may be the offset of another: it then finds the first of the two in the XML.
    /// In this order that is always the right one.
    ///
    /// # Errors
    /// Fails as `out` does, which is not called again.
    pub fn write(&self, source: &S, out: &mut dyn Write) -> io::Result<()> {
        writeln!(
            out,
            r#"<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<UnstructuredGrid>"#
        )?;
        let sizes = Section::ALL.into_iter().flat_map(|section| self.in_section(section));
        let mut offset: u64 = sizes.map(DataArray::size_with_length).sum();
        for section in Section::ALL {
            if section == Section::Field && self.in_section(section).next().is_none() {
                continue;
            }
            if section == Section::Point {
                let (points, cells) = (self.points, self.cells);
                writeln!(out, r#"<Piece NumberOfPoints="{points}" NumberOfCells="{cells}">"#)?;
            }
            writeln!(out, "<{}{}>", section.tag(), (self.attributes)(section))?;
            for array in self.in_section(section) {
                offset -= array.size_with_length();
                writeln!(out, "{}", array.declaration(Some(offset)))?;
            }
            writeln!(out, "</{}>", section.tag())?;
        }
        out.write_all(b"</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_")?;
        for section in Section::ALL.into_iter().rev() {
            self.in_section(section)
                .rev()
                .try_for_each(|array| array.write_numbers(source, out))?;
        }
        out.write_all(b"\n</AppendedData>\n</VTKFile>\n")
    }

    /// Returns the arrays of a section, in the order of the file.
    fn in_section(
        &self,
        section: Section,
    ) -> impl DoubleEndedIterator<Item = &'a DataArray<'a, S>> {
        let all = self.arrays.into_iter().flatten();
        all.filter(move |array| array.section == section)
    }
}

/// Number of bytes that go to a writer at once.
const CHUNK: usize = 4096;

/// Writes numbers of `N` bytes each. They go to the writer many at a time: a call for each takes
/// longer than all else.
///
/// # Errors
/// Fails as `out` does.
pub fn write_numbers<const N: usize>(
    mut numbers: impl Iterator<Item = [u8; N]>,
    out: &mut dyn Write,
) -> io::Result<()> {
    let mut chunk = [0; CHUNK];
    let mut used = 0;
    numbers.try_for_each(|number| {
        if used + N > CHUNK {
            out.write_all(&chunk[..used])?;
            used = 0;
        }
        chunk[used..used + N].copy_from_slice(&number);
        used += N;
        io::Result::Ok(())
    })?;
    out.write_all(&chunk[..used])
}

/// Writes points with three coordinates, which those of VTK have always: the third is 0 in the
/// plane.
///
/// # Errors
/// Fails as `out` does.
pub fn write_points(points: &[f64], dim: usize, out: &mut dyn Write) -> io::Result<()> {
    let coordinate = |point: &[f64], axis| point.get(axis).copied().unwrap_or(0.0);
    let in_space = |point| [0, 1, 2].map(|axis| f64::to_le_bytes(coordinate(point, axis)));
    write_numbers(points.chunks_exact(dim).flat_map(in_space), out)
}

/// Writes the type of `cells` simplices: triangles or tetrahedra.
///
/// # Errors
/// Fails as `out` does.
pub fn write_types(dim: usize, cells: usize, out: &mut dyn Write) -> io::Result<()> {
    const TRIANGLE: u8 = 5;
    const TETRA: u8 = 10;
    let cell_type = if dim == 2 { TRIANGLE } else { TETRA };
    write_numbers((0..cells).map(|_| [cell_type]), out)
}
