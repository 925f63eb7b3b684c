//! Facets, segments and points by the files that they come from: what is meshed has other numbers
//! once polygons are split, facets left out or files put together.

use crate::words::CommandLine;
use netmesh::Feature;
use netmesh::error::{Name, Words};
use netmesh::io::Table;
use std::fmt::{Formatter, Result};

/// Facets, segments and points of the input and of the files of `--with`.
pub struct Origins {
    files: Vec<Contents>,
    /// Facet -> its number among those of all files as they were read, in their order.
    facets: Vec<u32>,
    /// Number of facets of all files as they were read.
    read: usize,
}

/// Words of the command line for what files have, by the numbers that it has there.
#[derive(Clone, Copy)]
pub struct InFiles<'a> {
    pub words: CommandLine<'a>,
    pub origins: &'a Origins,
}

impl Words for InFiles<'_> {
    fn write(&self, name: Name, f: &mut Formatter<'_>) -> Result {
        let feature = match name {
            Name::Facet(at) | Name::Triangle(at) => Feature::Facet(at as u32),
            Name::Segment(at) => Feature::Segment(at as u32),
            Name::Input(at) => return write!(f, "{}", self.origins.point(at)),
            other => return self.words.write(other, f),
        };
        f.write_str(&self.origins.name(feature))
    }
}

/// File, with the numbers of all that the files before it have.
struct Contents {
    name: String,
    facets: usize,
    segments: usize,
    points: usize,
    has_triangles: bool,
}

impl Origins {
    /// Makes the origins of what a file has.
    pub fn of(name: String, table: &Table) -> Self {
        let facets = &table.outline.facets;
        let (read, has_triangles) = (facets.count(), facets.are_triangles);
        let file = Contents { name, facets: 0, segments: 0, points: 0, has_triangles };
        Self { files: vec![file], facets: (0..read as u32).collect(), read }
    }

    /// Appends those of another file, given the table of the files before it.
    pub fn append(&mut self, other: Self, before: &Table) {
        let (segments, points) =
            (before.outline.segments.len(), before.points.coordinates.len() / before.points.dim);
        self.facets.extend(other.facets.iter().map(|number| number + self.read as u32));
        let placed = |file| Contents { facets: self.read, segments, points, ..file };
        self.files.extend(other.files.into_iter().map(placed));
        self.read += other.read;
    }

    /// Puts parts of facets in the place of these, given the facet of each.
    pub fn split(&mut self, parents: &[u32]) {
        self.facets = parents.iter().map(|&parent| self.facets[parent as usize]).collect();
    }

    /// Leaves out facets with some numbers, which are sorted.
    pub fn leave_out(&mut self, left_out: &[u32]) {
        let mut number = 0;
        self.facets.retain(|_| {
            number += 1;
            left_out.binary_search(&(number - 1)).is_err()
        });
    }

    /// Returns the number of facets.
    pub fn count(&self) -> usize {
        self.facets.len()
    }

    /// Returns the names of the files.
    pub fn files(&self) -> String {
        let names: Vec<&str> = self.files.iter().map(|file| &*file.name).collect();
        names.join(", ")
    }

    /// Returns true if a name in a file tells more of a facet or segment than its number: there are
    /// several files, facets have other numbers than there, or it is in none.
    pub fn tell_more(&self, feature: Feature) -> bool {
        let closes_hole = matches!(feature, Feature::Facet(at) if at as usize >= self.count());
        let is_moved = || self.facets.iter().zip(0..).any(|(&number, at)| number != at);
        self.files.len() > 1 || closes_hole || is_moved()
    }

    /// Returns the name of a facet or segment in its file, and the file if there are several.
    pub fn name(&self, feature: Feature) -> String {
        match feature {
            Feature::Facet(at) => match self.facets.get(at as usize) {
                Some(&number) => self.facet_as_read(number as usize),
                None => "a triangle that closes a hole".to_owned(),
            },
            Feature::Segment(at) => {
                let (file, number) = self.place(at as usize, |file| file.segments);
                format!("segments[{number}]{}", self.of_file(file))
            }
        }
    }

    /// Returns the number of a point in its file.
    pub fn point(&self, at: usize) -> usize {
        self.place(at, |file| file.points).1
    }

    fn facet_as_read(&self, number: usize) -> String {
        let (file, number) = self.place(number, |file| file.facets);
        let word = if file.has_triangles { "triangles" } else { "facets" };
        format!("{word}[{number}]{}", self.of_file(file))
    }

    /// Returns the file of something by its number among that of all files, and its number there.
    fn place(&self, number: usize, first: impl Fn(&Contents) -> usize) -> (&Contents, usize) {
        let after = self.files.partition_point(|file| first(file) <= number);
        let file = &self.files[after.saturating_sub(1)];
        (file, number - first(file))
    }

    fn of_file(&self, file: &Contents) -> String {
        match self.files.len() {
            1 => String::new(),
            _ => format!(" of {}", file.name),
        }
    }
}
