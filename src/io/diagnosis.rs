//! Files of what a diagnosis found: VTK's XML unstructured grid, with the facets, segments and
//! edges at fault as cells.

use super::vtk::{DataArray, Grid, Numbers, Scalar, Section, write_points};
use super::{Buffered, allocation_failed, io_error, replace};
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow, with_capacity};
use crate::mesh::{Diagnosis, EdgeFault, Feature, IntersectionKind, Mesh};
use std::io::{self, Write};
use std::path::Path;

/// Numbers of the faults in the array `fault`; of several faults of a facet the largest.
mod fault {
    pub const OPEN: u8 = 1;
    pub const CROWDED: u8 = 2;
    pub const TURNED: u8 = 3;
    pub const TOUCH: u8 = 4;
    pub const CROSS: u8 = 5;
    pub const OVERLAP: u8 = 6;
    pub const ZERO_AREA: u8 = 7;
}

/// Cell of the file.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Cell {
    shape: Shape,
    fault: u8,
}

/// Inputs that a cell is of.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Shape {
    Facet(u32),
    Segment(u32),
    Edge([u32; 2]),
}

/// Cells and the mesh that they are of.
struct Source<'a> {
    mesh: &'a Mesh,
    cells: Vec<Cell>,
}

/// Writes the facets and segments that meet though they must not or have no area, and the edges
/// that are not between two facets, with all inputs as points. A cell has its `facet`, or else its
/// `segment`, or -1 for both; `fault` is 1 for an open edge, 2 for one of three or more facets, 3
/// for one at which facets are turned round, 4 for what touches, 5 crosses, 6 overlaps, and 7 for a
/// facet without an area; of several faults of one facet the largest. Of polygons with holes the
/// first loop is the cell. The file appears complete or not at all; a device or a pipe is written
/// into.
///
/// # Errors
/// `Io`: the file cannot be written; `OutOfMemory`.
pub fn write_diagnosis_file(mesh: &Mesh, diagnosis: &Diagnosis, path: &Path) -> Result<()> {
    let source = Source { mesh, cells: cells(diagnosis)? };
    match replace::open_stream(path)? {
        Some(mut stream) => {
            let mut buffered = Buffered::new(1 << 16, &mut stream)?;
            let written = source.write(&mut buffered).and_then(|()| buffered.flush());
            written.map_err(|error| io_error("cannot write", &error))
        }
        None => replace::replace(&[(path, &|out| source.write(out))]),
    }
}

/// Returns the cells, facets first, each once.
fn cells(diagnosis: &Diagnosis) -> AllocResult<Vec<Cell>> {
    let mut cells = with_capacity(2 * diagnosis.intersections.len() + diagnosis.edges.len())?;
    for found in &diagnosis.intersections {
        let fault = match found.kind {
            IntersectionKind::Touch => fault::TOUCH,
            IntersectionKind::Cross => fault::CROSS,
            IntersectionKind::Overlap => fault::OVERLAP,
            IntersectionKind::ZeroArea => fault::ZERO_AREA,
        };
        for feature in [found.first, found.second] {
            let shape = match feature {
                Feature::Facet(facet) => Shape::Facet(facet),
                Feature::Segment(segment) => Shape::Segment(segment),
            };
            cells.try_push(Cell { shape, fault })?;
        }
    }
    for edge in &diagnosis.edges {
        let fault = match edge.fault {
            EdgeFault::Open => fault::OPEN,
            EdgeFault::Crowded => fault::CROWDED,
            EdgeFault::Turned => fault::TURNED,
        };
        cells.try_push(Cell { shape: Shape::Edge(edge.inputs), fault })?;
    }
    cells.sort_unstable_by(|a, b| a.shape.cmp(&b.shape).then(b.fault.cmp(&a.fault)));
    cells.dedup_by_key(|cell| cell.shape);
    Ok(cells)
}

type Array<'a> = DataArray<'static, Source<'a>>;

impl<'a> Source<'a> {
    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let arrays = self.arrays().map_err(allocation_failed)?;
        let grid = Grid {
            points: self.mesh.inputs().count(),
            cells: self.cells.len(),
            attributes: |section| if section == Section::Cell { r#" Scalars="fault""# } else { "" },
            arrays: [&arrays, &[]],
        };
        grid.write(self, out)
    }

    /// Returns the inputs of a cell, in order.
    fn ids(&self, cell: &Cell) -> impl Iterator<Item = u32> + '_ {
        let (own, ends): (&[u32], _) = match cell.shape {
            Shape::Facet(facet) => {
                let mut loops = self.mesh.given_facets().loops(facet as usize);
                (loops.find(|own| own.len() > 2).unwrap_or(&[]), None)
            }
            Shape::Segment(segment) => (&self.mesh.segments().inputs[segment as usize], None),
            Shape::Edge(ends) => (&[], Some(ends)),
        };
        own.iter().copied().chain(ends.into_iter().flatten())
    }

    fn arrays(&self) -> AllocResult<Vec<Array<'a>>> {
        let cells = self.cells.len();
        let ids = self.cells.iter().map(|cell| self.ids(cell).count()).sum();
        let array = |section, name, scalar, components, tuples, write: WriteNumbers<'a>| {
            let numbers = Numbers::Written(write);
            DataArray { section, name, scalar, components, tuples, is_global_id: false, numbers }
        };
        let points = self.mesh.inputs().count();
        let (cell, point) = (Section::Cell, Section::Points);
        let mut arrays = with_capacity(7)?;
        arrays.push(array(cell, "fault", Scalar::UInt8, 1, cells, write_faults));
        arrays.push(array(cell, "facet", Scalar::Int32, 1, cells, write_facets));
        arrays.push(array(cell, "segment", Scalar::Int32, 1, cells, write_segments));
        arrays.push(array(point, "points", Scalar::Float64, 3, points, write_all_points));
        let of = Section::Cells;
        arrays.push(array(of, "connectivity", Scalar::UInt32, 1, ids, write_ids));
        arrays.push(array(of, "offsets", Scalar::UInt64, 1, cells, write_offsets));
        arrays.push(array(of, "types", Scalar::UInt8, 1, cells, write_shapes));
        Ok(arrays)
    }
}

type WriteNumbers<'a> = fn(&Source<'a>, &mut dyn Write) -> io::Result<()>;

fn write_faults(source: &Source<'_>, out: &mut dyn Write) -> io::Result<()> {
    source.cells.iter().try_for_each(|cell| out.write_all(&[cell.fault]))
}

fn write_facets(source: &Source<'_>, out: &mut dyn Write) -> io::Result<()> {
    let facet = |cell: &Cell| match cell.shape {
        Shape::Facet(facet) => facet as i32,
        _ => -1,
    };
    source.cells.iter().try_for_each(|cell| out.write_all(&facet(cell).to_le_bytes()))
}

fn write_segments(source: &Source<'_>, out: &mut dyn Write) -> io::Result<()> {
    let segment = |cell: &Cell| match cell.shape {
        Shape::Segment(segment) => segment as i32,
        _ => -1,
    };
    source.cells.iter().try_for_each(|cell| out.write_all(&segment(cell).to_le_bytes()))
}

fn write_all_points(source: &Source<'_>, out: &mut dyn Write) -> io::Result<()> {
    let inputs = source.mesh.inputs();
    (0..inputs.count()).try_for_each(|input| write_points(inputs.point(input), 3, out))
}

fn write_ids(source: &Source<'_>, out: &mut dyn Write) -> io::Result<()> {
    let mut ids = source.cells.iter().flat_map(|cell| source.ids(cell));
    ids.try_for_each(|id| out.write_all(&id.to_le_bytes()))
}

fn write_offsets(source: &Source<'_>, out: &mut dyn Write) -> io::Result<()> {
    let mut end = 0u64;
    source.cells.iter().try_for_each(|cell| {
        end += source.ids(cell).count() as u64;
        out.write_all(&end.to_le_bytes())
    })
}

/// Writes VTK's types of cells.
fn write_shapes(source: &Source<'_>, out: &mut dyn Write) -> io::Result<()> {
    const LINE: u8 = 3;
    const TRIANGLE: u8 = 5;
    const POLYGON: u8 = 7;
    source.cells.iter().try_for_each(|cell| {
        let shape = match source.ids(cell).count() {
            0..=2 => LINE,
            3 => TRIANGLE,
            _ => POLYGON,
        };
        out.write_all(&[shape])
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::OddEdge;

    #[test]
    fn a_facet_has_its_worst_fault_and_edges_come_last() {
        let crossing = |first, second, kind| crate::mesh::Intersection {
            first,
            second,
            kind,
            point: [0.0; 3],
        };
        let [a, b, s] = [Feature::Facet(4), Feature::Facet(9), Feature::Segment(1)];
        let open = OddEdge { inputs: [2, 5], facets: 1, fault: EdgeFault::Open };
        let diagnosis = Diagnosis {
            edges: vec![open],
            intersections: vec![
                crossing(a, b, IntersectionKind::Touch),
                crossing(b, b, IntersectionKind::ZeroArea),
                crossing(b, s, IntersectionKind::Cross),
            ],
            duplicates: 0,
        };
        let found: Vec<(Shape, u8)> =
            cells(&diagnosis).unwrap().iter().map(|cell| (cell.shape, cell.fault)).collect();
        let expected = [
            (Shape::Facet(4), fault::TOUCH),
            (Shape::Facet(9), fault::ZERO_AREA),
            (Shape::Segment(1), fault::CROSS),
            (Shape::Edge([2, 5]), fault::OPEN),
        ];
        assert!(found == expected);
    }
}
