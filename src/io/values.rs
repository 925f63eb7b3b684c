//! The values of attributes while a file is read.

use super::PointCloud;
use super::text::Line;
use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::{TryGrow, collected};
use crate::mesh::{Attribute, Facets, LeftOut, Mesh, Region};

/// Content of a file that was read: points, and values of attributes at them.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    pub points: PointCloud,
    /// Attributes of one component each, in the order of the choice.
    pub attributes: Vec<Attribute>,
    pub outline: Outline,
    /// Number of things in the file that were not read.
    pub left_out: LeftOut,
}

/// Segments and facets between the points, and regions: none in most formats.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outline {
    /// Facets in space, or the triangles of a surface.
    pub facets: Facets,
    /// Segments, two points each.
    pub segments: Vec<[u32; 2]>,
    /// Markers, one for each segment.
    pub markers: Vec<i32>,
    /// Tells for each segment whether it is a side of a polygon; empty in formats without polygons.
    pub sides: Vec<bool>,
    pub regions: Vec<Region>,
}

impl Table {
    pub(super) fn new(points: PointCloud, attributes: Vec<Attribute>) -> Self {
        Self { points, attributes, outline: Outline::default(), left_out: LeftOut::default() }
    }

    /// Leaves the points and their attributes alone; segments and facets count as left out.
    pub(super) fn leave_outline(&mut self) {
        let Outline { facets, segments, .. } = std::mem::take(&mut self.outline);
        self.left_out.add(1, segments.len() as u64);
        self.left_out.add(2, facets.count() as u64);
    }

    /// Makes a mesh of the points with their attributes, segments, facets and regions.
    /// `is_extended` says how the attributes go on at other vertices, as in
    /// [`Mesh::set_attribute`].
    ///
    /// # Errors
    /// The errors of [`Mesh::new`], [`Mesh::set_attribute`], [`Mesh::set_segments`],
    /// [`Mesh::set_facets`], [`Mesh::set_triangles`] and [`Mesh::set_regions`]; those of the last
    /// four are [of the content](Error::of_content).
    pub fn mesh(&self, is_extended: bool) -> Result<Mesh> {
        let PointCloud { dim, coordinates } = &self.points;
        let mut mesh = Mesh::new(*dim, self.points.count(), coordinates, 0)?;
        for Attribute { name, components, values, .. } in &self.attributes {
            mesh.set_attribute(name, *components, values, is_extended)?;
        }
        let Outline { facets, segments, markers, sides, regions } = &self.outline;
        set_facets(&mut mesh, facets).map_err(Error::of_content)?;
        if !segments.is_empty() {
            let set = mesh.set_segments(segments.as_flattened(), Some(markers));
            set.map_err(Error::of_content)?;
            if !sides.is_empty() {
                mesh.set_sides(sides)?;
            }
        }
        if !regions.is_empty() {
            mesh.set_regions(regions).map_err(Error::of_content)?;
        }
        mesh.set_left_out(self.left_out);
        Ok(mesh)
    }
}

/// Sets the facets of a file.
fn set_facets(mesh: &mut Mesh, facets: &Facets) -> Result<()> {
    let Facets { loop_starts, input_starts, inputs, markers, are_triangles } = facets;
    match (facets.count(), are_triangles) {
        (0, _) => Ok(()),
        (_, true) => mesh.set_triangles(inputs, Some(markers)),
        (_, false) => {
            let [loop_starts, input_starts] =
                [loop_starts, input_starts].map(|starts| starts.iter().map(|&at| u64::from(at)));
            mesh.set_facets(
                &collected(loop_starts)?,
                &collected(input_starts)?,
                inputs,
                Some(markers),
            )
        }
    }
}

/// The values of the attributes read so far, for all of them from the same points.
#[derive(Default)]
pub(super) struct Values {
    attributes: Vec<Attribute>,
    /// Columns, counted from 0, and their attributes; ascending.
    of_columns: Vec<(u64, usize)>,
}

impl Values {
    /// Makes attributes of columns with names, without values.
    pub fn new(columns: impl Iterator<Item = (u64, String)>) -> Result<Self> {
        let mut values = Self::default();
        for (column, name) in columns {
            values.of_columns.try_push((column, values.attributes.len()))?;
            let attribute =
                Attribute { name, components: 1, values: Vec::new(), is_extended: true };
            values.attributes.push(attribute);
        }
        values.of_columns.sort_unstable();
        Ok(values)
    }

    /// Returns the attribute that a column is.
    pub fn of_column(&self, column: u64) -> Option<usize> {
        let at = self.of_columns.binary_search_by_key(&column, |(column, _)| *column).ok()?;
        Some(self.of_columns[at].1)
    }

    /// Returns the columns that are attributes, ascending.
    pub fn columns(&self) -> impl Iterator<Item = u64> + '_ {
        self.of_columns.iter().map(|(column, _)| *column)
    }

    /// Adds the value of an attribute at the next point.
    pub fn push(&mut self, attribute: usize, value: f64) -> Result<()> {
        let values = &mut self.attributes[attribute].values;
        values.try_push(value).map_err(|_| {
            let message =
                message!("no memory for more than {} values of an attribute", values.len());
            Error::new(ErrorKind::OutOfMemory, message)
        })
    }

    /// Adds the field at `place` (counted from 0) of a line, if `column` is an attribute.
    pub fn add(&mut self, line: &Line<'_>, place: usize, column: u64, field: &str) -> Result<()> {
        let Some(attribute) = self.of_column(column) else { return Ok(()) };
        let value = line.value(place, field, &self.attributes[attribute].name)?;
        self.push(attribute, value)
            .map_err(|error| line.error_of_kind(error.kind(), error.message()))
    }

    pub fn finish(self) -> Vec<Attribute> {
        self.attributes
    }
}
