//! Layout of the lines of a text: the columns of coordinates and attributes.

use super::Table;
use super::text::{Line, Points};
use super::values::Values;
use crate::error::Result;
use crate::mesh::MAX_DIM;

/// The columns of a text, and what was read of them.
pub(super) struct Layout {
    /// Columns of every line.
    all: usize,
    /// Columns counted from 0, in the order of the coordinates.
    coordinates: Vec<u64>,
    points: Points,
    values: Values,
}

impl Layout {
    /// Makes the layout that the first line shows.
    pub fn new(line: &Line<'_>, all: usize, coordinates: Vec<u64>, values: Values) -> Result<Self> {
        // Too few are refused with the first point, after its numbers.
        if coordinates.len() > MAX_DIM {
            line.check_dimension(coordinates.len() as u64)?;
        }
        Ok(Self { all, coordinates, points: Points::default(), values })
    }

    /// Adds the point of a line with these fields.
    pub fn add<'f>(
        &mut self,
        line: &Line<'_>,
        fields: impl Iterator<Item = &'f str>,
    ) -> Result<()> {
        let mut coordinates = [""; MAX_DIM];
        let mut added = Ok(());
        let mut count = 0;
        for field in fields {
            let column = count as u64;
            if let Some(axis) = self.coordinates.iter().position(|other| *other == column) {
                coordinates[axis] = field;
            }
            if added.is_ok() {
                added = self.values.add(line, count, column, field);
            }
            count += 1;
        }
        if count != self.all {
            return Err(line.error(format!("{count} columns; the first line has {}", self.all)));
        }
        let columns = self.coordinates.iter().map(|column| *column as usize);
        self.points.add(line, columns.zip(coordinates))?;
        added
    }

    /// Returns the table that `layout` has read; `None` stands for a file without lines.
    pub fn finish(layout: Option<Self>) -> Result<Table> {
        let (points, values) =
            layout.map_or_else(Default::default, |layout| (layout.points, layout.values));
        Ok(Table::new(points.finish()?, values.finish()))
    }
}
