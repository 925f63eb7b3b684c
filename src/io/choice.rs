//! Choice of the columns of a file that are read: the coordinates, and attributes of the points.

use super::columns::{Column, Columns, OrRule, named_coordinates, parse_entry};
use super::text::quoted;
use super::values::Values;
use crate::error::{Error, Name, Result, message, say};
use crate::memory::collected;
use crate::mesh::MAX_DIM;
use crate::mesh::attribute::rule_against;
use std::str::FromStr;

/// Parts of a file that are read. The default: the coordinates by the format's own rule, no
/// attributes, and the segments, facets and regions that the file has.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Choice {
    pub coordinates: Columns,
    pub attributes: AttributeColumns,
    /// True if segments, facets and regions are left out.
    pub has_points_alone: bool,
}

impl Choice {
    /// Returns the columns of the coordinates, counted from 0, of a table with `count` columns, and
    /// its attributes, still without values. Unless the coordinates are chosen they are among the
    /// columns that are no attributes one by one: those whose names say so, those of `otherwise` if
    /// no name does, and all of them in a table without names.
    ///
    /// # Errors
    /// `InvalidArgument`; `Format`: two columns have the name of a coordinate.
    pub(super) fn of_table(
        &self,
        count: u64,
        names: Option<&[&str]>,
        otherwise: impl FnOnce(&[u64]) -> Result<Vec<u64>>,
    ) -> Result<(Vec<u64>, Values)> {
        let listed = self.attributes.listed(count, names)?;
        let coordinates = match names {
            _ if self.coordinates.are_chosen() => self.coordinates.indices(count, names)?,
            Some(names) => {
                let columns = names.iter().zip(0u64..);
                let free = columns.map(|(name, i)| if listed.contains(&i) { "" } else { *name });
                let named = named_coordinates(&collected(free)?);
                let named = named.map_err(Error::format)?;
                named.map_or_else(|| otherwise(&listed), Ok)?
            }
            None => others(count, &listed),
        };
        let values = self.attributes.of(count, names, &coordinates)?;
        Ok((coordinates, values))
    }
}

/// Returns the first `count` columns but for those listed; one more than there may be, so that the
/// dimension is refused.
pub(super) fn others(count: u64, listed: &[u64]) -> Vec<u64> {
    (0..count).filter(|column| !listed.contains(column)).take(MAX_DIM + 1).collect()
}

/// The columns that a caller takes as attributes of the points, in the order of the attributes. The
/// default takes none.
///
/// Parsed from a list such as `intensity,5-7,height=z`, or from `all`. Names are those that the
/// file has for its columns, in either case; numbers count its columns from 1, in a `.node` file
/// the attributes. `NAME=COLUMN` gives an attribute another name than the file. Without a name in
/// the file it is `column_5` and so on. `all` takes every column but the coordinates and those that
/// this crate writes itself, `kind` and `domain`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct AttributeColumns {
    takes_all: bool,
    entries: Vec<Entry>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct Entry {
    /// Name of the attribute in place of the file's.
    name: Option<String>,
    column: Column,
    /// Last column, where the entry is a range.
    last: Option<u64>,
}

/// The most attributes that are read of one file.
pub(super) const MAX_ATTRIBUTES: usize = 1000;

/// Columns that this crate writes beside the coordinates: a mesh that is read again gets its own.
const OWN: [&str; 2] = ["kind", "domain"];

impl FromStr for AttributeColumns {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        if text.trim() == "all" {
            return Ok(Self { takes_all: true, entries: Vec::new() });
        }
        let entries = text.split(',').map(|entry| Entry::parsed(entry.trim()));
        let entries = entries.collect::<OrRule<Vec<Entry>>>().map_err(refused)?;
        Ok(Self { takes_all: false, entries })
    }
}

impl Entry {
    fn parsed(text: &str) -> OrRule<Self> {
        let (name, column) = match text.split_once('=') {
            Some((name, column)) => (Some(name.trim().to_string()), column.trim()),
            None => (None, text),
        };
        if let Some(rule) = name.as_deref().and_then(rule_against) {
            let name = quoted(name.as_deref().unwrap_or_default());
            return Err(message!("{name} is no name for an attribute; {rule}"));
        }
        let (column, last) = parse_entry(column)?;
        if name.is_some() && last.is_some() {
            return Err(message!("{} gives one name to several columns", quoted(text)));
        }
        Ok(Self { name, column, last })
    }
}

fn refused(why: String) -> Error {
    Error::invalid(say!(Name::Attributes, ": {why}"))
}

/// A column that becomes an attribute.
struct Taken {
    /// Column of the file, counted from 0.
    column: u64,
    name: String,
}

impl AttributeColumns {
    /// Returns true if any attributes are chosen.
    pub fn are_chosen(&self) -> bool {
        self.takes_all || !self.entries.is_empty()
    }

    /// Refuses attributes of a format that they are not read from.
    pub(super) fn require_none(&self, format: &str) -> Result<()> {
        match self.are_chosen() {
            false => Ok(()),
            true => Err(refused(message!(
                "of {format} files no attributes are read, as they are from TetGen, PLY, XYZ, CSV \
                 and NumPy files"
            ))),
        }
    }

    /// Returns the columns, counted from 0, that are named one by one: without a choice of
    /// coordinates these are no coordinates.
    fn listed(&self, count: u64, names: Option<&[&str]>) -> Result<Vec<u64>> {
        Ok(self.entries_of(count, names)?.into_iter().map(|taken| taken.column).collect())
    }

    /// Returns the attributes of a table with `count` columns, still without values. `all` takes
    /// none of the columns `left_out`.
    pub(super) fn of(
        &self,
        count: u64,
        names: Option<&[&str]>,
        left_out: &[u64],
    ) -> Result<Values> {
        let taken = match self.takes_all {
            true => self.others(count, names, left_out)?,
            false => self.entries_of(count, names)?,
        };
        for (at, Taken { column, name }) in taken.iter().enumerate() {
            let number = column + 1;
            if let Some(rule) = rule_against(name) {
                let name = quoted(name);
                return Err(refused(message!(
                    "column {number} is called {name}, which is no name for an attribute: {rule}; \
                     give it another with NAME={number}"
                )));
            }
            if taken[..at].iter().any(|other| other.column == *column) {
                return Err(refused(message!("column {number} is taken twice")));
            }
            if taken[..at].iter().any(|other| other.name == *name) {
                return Err(refused(message!(
                    "two attributes are called {}; give one another name with NAME=COLUMN",
                    quoted(name)
                )));
            }
        }
        Values::new(taken.into_iter().map(|taken| (taken.column, taken.name)))
    }

    fn entries_of(&self, count: u64, names: Option<&[&str]>) -> Result<Vec<Taken>> {
        let mut taken = Vec::new();
        for Entry { name, column, last } in &self.entries {
            let first = column.index(count, names).map_err(refused)?;
            let last = match last {
                Some(last) => Column::Number(*last).index(count, names).map_err(refused)?,
                None => first,
            };
            for column in first..=last {
                require_few(taken.len())?;
                let name = name.clone().unwrap_or_else(|| name_of(column, names));
                taken.push(Taken { column, name });
            }
        }
        Ok(taken)
    }

    fn others(&self, count: u64, names: Option<&[&str]>, left_out: &[u64]) -> Result<Vec<Taken>> {
        let mut taken = Vec::new();
        for column in (0..count).filter(|column| !left_out.contains(column)) {
            let name = name_of(column, names);
            if !OWN.contains(&name.as_str()) {
                require_few(taken.len())?;
                taken.push(Taken { column, name });
            }
        }
        if taken.is_empty() {
            return Err(refused("every column of the file is a coordinate".into()));
        }
        Ok(taken)
    }
}

fn require_few(count: usize) -> Result<()> {
    match count < MAX_ATTRIBUTES {
        true => Ok(()),
        false => Err(refused(message!("more than {MAX_ATTRIBUTES} columns; take fewer"))),
    }
}

fn name_of(column: u64, names: Option<&[&str]>) -> String {
    match names {
        Some(names) => names[column as usize].to_string(),
        None => message!("column_{}", column + 1),
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Format, Table, read_table};
    use super::*;
    use crate::error::ErrorKind;

    fn read(text: &str, format: Format, columns: &str, attributes: &str) -> Result<Table> {
        let coordinates = match columns {
            "" => Columns::default(),
            _ => columns.parse()?,
        };
        let attributes = attributes.parse()?;
        let choice = Choice { coordinates, attributes, has_points_alone: false };
        read_table(&mut text.as_bytes(), format, &choice)
    }

    /// Returns the first point, and names and values of the attributes there.
    fn first(table: &Table) -> (Vec<f64>, Vec<(&str, f64)>) {
        let of_first = table.attributes.iter().map(|a| (a.name.as_str(), a.values[0])).collect();
        (table.points.coordinates[..table.points.dim].to_vec(), of_first)
    }

    #[test]
    fn columns_that_are_no_attributes_are_coordinates() {
        let named = "x,y,z,h,w,kind\n1,2,3,4,5,6\n";
        let unnamed = "1,2,3,4\n";
        let ply = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float w\nproperty float x\n\
                   property double y\nproperty uchar kind\nproperty int h\nend_header\n5 1 2 6 4\n";
        for (text, format, columns, attributes, point, expected) in [
            (named, Format::Csv, "", "h,W", &[1.0, 2.0, 3.0][..], &[("h", 4.0), ("w", 5.0)][..]),
            (named, Format::Csv, "", "5,a=4", &[1.0, 2.0, 3.0], &[("w", 5.0), ("a", 4.0)]),
            (named, Format::Csv, "", "all", &[1.0, 2.0, 3.0], &[("h", 4.0), ("w", 5.0)]),
            (named, Format::Csv, "", "height=z", &[1.0, 2.0], &[("height", 3.0)]),
            (named, Format::Csv, "x,y,z", "height=z", &[1.0, 2.0, 3.0], &[("height", 3.0)]),
            (named, Format::Csv, "y,x", "k=kind", &[2.0, 1.0], &[("k", 6.0)]),
            ("a,b,c\n1,2,3\n", Format::Csv, "", "b", &[1.0, 3.0], &[("b", 2.0)]),
            (unnamed, Format::Csv, "", "3-4", &[1.0, 2.0], &[("column_3", 3.0), ("column_4", 4.0)]),
            (unnamed, Format::Xyz, "", "2", &[1.0, 3.0, 4.0], &[("column_2", 2.0)]),
            (
                unnamed,
                Format::Xyz,
                "2,4",
                "all",
                &[2.0, 4.0],
                &[("column_1", 1.0), ("column_3", 3.0)],
            ),
            (ply, Format::Ply, "", "all", &[1.0, 2.0], &[("w", 5.0), ("h", 4.0)]),
            (ply, Format::Ply, "", "H,x0y=y", &[1.0, 2.0], &[("h", 4.0), ("x0y", 2.0)]),
        ] {
            let table = read(text, format, columns, attributes).unwrap();
            assert_eq!(
                first(&table),
                (point.to_vec(), expected.to_vec()),
                "{format:?} {attributes}"
            );
        }
    }

    #[test]
    fn values_may_be_any_doubles_and_missing() {
        let text = "x,y,h\n1,2,inf\n1,2,-nan\n1,2,\n1,2,-1e-999\n";
        let table = read(text, Format::Csv, "", "h").unwrap();
        let values = &table.attributes[0].values;
        assert!(values[0] == f64::INFINITY && values[1].is_nan() && values[2].is_nan());
        assert_eq!(values[3].to_bits(), (-0.0f64).to_bits());
        let error = read("x,y,h\n1,2\n", Format::Csv, "", "h").unwrap_err();
        assert_eq!(error.message(), "line 2: 2 columns; the first line has 3");
        let error = read("x,y,h\n1,2,a,3\n", Format::Csv, "", "h").unwrap_err();
        assert_eq!(error.message(), "line 2: 4 columns; the first line has 3");
    }

    #[test]
    fn bad_lists_are_refused_with_their_rule() {
        for (text, rule) in [
            ("", "an entry is empty"),
            ("h,", "an entry is empty"),
            ("a=", "an entry is empty"),
            ("=3", "\"\" is no name for an attribute; it must be 1 to 64"),
            ("a b=3", "\"a b\" is no name for an attribute; it must be 1 to 64"),
            ("x7=3", "files have that name for something else"),
            ("a=3-4", "\"a=3-4\" gives one name to several columns"),
            ("4-3", "runs backwards"),
            ("0", "they count from 1"),
        ] {
            let error = text.parse::<AttributeColumns>().unwrap_err();
            assert_eq!(error.kind(), ErrorKind::InvalidArgument, "{text:?}");
            assert!(error.message().starts_with("attributes: "), "{error}");
            assert!(error.message().contains(rule), "{text:?}: {error}");
        }
    }

    /// Holds that of the columns that a header promises at most a thousand are taken.
    #[test]
    fn no_more_columns_are_taken_than_a_thousand() {
        let wide = |columns: usize| (0..columns).map(|_| "1").collect::<Vec<_>>().join(" ");
        let table = read(&wide(1002), Format::Xyz, "1,2", "all").unwrap();
        assert_eq!(table.attributes.len(), 1000);
        for (text, format, columns, attributes) in [
            (wide(1003).as_str(), Format::Xyz, "1,2", "all"),
            (&wide(1003), Format::Xyz, "1,2", "3-1003"),
            ("2 2 1001 0\n", Format::TetgenNode, "", "all"),
            ("2 2 18446744073709551615 0\n", Format::TetgenNode, "", "1"),
        ] {
            let error = read(text, format, columns, attributes).unwrap_err();
            assert!(error.message().contains("1000"), "{error}");
        }
    }
}
