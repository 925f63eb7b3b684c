//! Points and polylines of the plane, as GeoJSON and WKT have them.

use super::scanner::TextPosition;
use super::text::Points;
use super::values::{Outline, Table};
use crate::error::{Error, ErrorKind, Result};
use crate::memory::TryGrow;
use std::fmt;

/// Points and segments that have been read of a file.
pub(super) struct Features {
    /// Word of the file's format for a feature: "feature", "geometry".
    noun: &'static str,
    /// The number of the feature that is read, counted from 1: the marker of its segments.
    number: i32,
    points: Points,
    outline: Outline,
}

/// A ring of a polygon, as messages name it.
#[derive(Clone, Copy)]
pub(super) struct Ring {
    /// Number of the ring in its polygon, counted from 1.
    pub number: usize,
    /// Position of its first byte.
    pub place: TextPosition,
}

impl Features {
    pub fn new(noun: &'static str) -> Self {
        let points = Points::of_dimension(2);
        Self { noun, number: 1, points, outline: Outline::default() }
    }

    /// Begins the feature of this number, counted from 1.
    pub fn begin(&mut self, number: u64, place: TextPosition) -> Result<()> {
        self.number = i32::try_from(number).map_err(|_| {
            let message = format_args!("more than {} of these; markers have 32 bits", i32::MAX);
            place.error_of_kind(ErrorKind::Capacity, message)
        })?;
        Ok(())
    }

    pub fn add_points(&mut self, positions: &[[f64; 2]]) -> Result<()> {
        positions.as_flattened().iter().try_for_each(|coordinate| self.points.push(*coordinate))
    }

    /// Adds an open or a closed line.
    pub fn add_line(&mut self, positions: &[[f64; 2]], place: TextPosition) -> Result<()> {
        if positions.len() < 2 {
            let rule = "a line with fewer than 2 positions";
            return Err(self.refused(place, &rule));
        }
        let first = self.points.count();
        self.add_points(positions)?;
        self.connect(positions, first, false)
    }

    /// Adds a line that ends where it begins; that point becomes one input. Maps that were made
    /// coarser have rings of one or two distinct points: inputs and segments like others.
    pub fn add_ring(&mut self, positions: &[[f64; 2]], ring: Ring) -> Result<()> {
        let Ring { number, place } = ring;
        if positions.len() < 4 {
            let rule = format_args!("ring {number} has fewer than 4 positions");
            return Err(self.refused(place, &rule));
        }
        let ([x, y], [u, v]) = (positions[0], positions[positions.len() - 1]);
        if [x, y] != [u, v] {
            let rule = format_args!(
                "ring {number} begins at {x:?} {y:?} and ends at {u:?} {v:?}; its last position \
                 must be its first"
            );
            return Err(self.refused(place, &rule));
        }
        let begin = self.points.count();
        self.add_points(&positions[..positions.len() - 1])?;
        self.connect(positions, begin, true)
    }

    /// Adds segments between each position and the next, the first of which is the input `first`;
    /// none where the two are equal. A last position that is no input is the first again. With
    /// `is_side` the segments are sides of a polygon.
    fn connect(&mut self, positions: &[[f64; 2]], first: usize, is_side: bool) -> Result<()> {
        let added = self.points.count() - first;
        for (at, ends) in positions.windows(2).enumerate() {
            if ends[0] != ends[1] {
                // There are fewer points than ids of 32 bits, or the mesh will refuse them.
                let id = |at: usize| u32::try_from(first + at % added).unwrap_or(u32::MAX);
                self.outline.segments.try_push([id(at), id(at + 1)])?;
                self.outline.markers.try_push(self.number)?;
                self.outline.sides.try_push(is_side)?;
            }
        }
        Ok(())
    }

    fn refused(&self, place: TextPosition, rule: &dyn fmt::Display) -> Error {
        place.error(format_args!("{} {}: {rule}", self.noun, self.number)).of_content()
    }

    pub fn finish(self) -> Result<Table> {
        let mut table = Table::new(self.points.finish()?, Vec::new());
        table.outline = self.outline;
        Ok(table)
    }
}
