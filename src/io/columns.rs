//! Choice of the columns of a table that are the coordinates.

use super::text::quoted;
use crate::error::{Error, Name, Result, message, say};
use crate::mesh::{MAX_DIM, MIN_DIM};
use std::str::FromStr;

/// A value, or the rule that is broken.
pub(super) type OrRule<T> = std::result::Result<T, String>;

/// The columns that a caller chooses as coordinates, in the order of the coordinates. The default
/// chooses none: the format's own rule applies.
///
/// Parsed from a list such as `1-3`, `1,2,5` or `x,y,z`: numbers count from 1, names are those that
/// the file has for its columns, in either case.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Columns {
    chosen: Vec<Column>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Column {
    /// Number of a column, counted from 1.
    Number(u64),
    Name(String),
}

impl FromStr for Columns {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        let mut chosen = Vec::new();
        for entry in text.split(',') {
            let (first, last) = parse_entry(entry.trim()).map_err(refused)?;
            chosen.push(first.clone());
            if let (Column::Number(first), Some(last)) = (first, last) {
                // More than MAX_DIM are refused below; a range of 2^60 must not be built for that.
                let last = last.min(first.saturating_add(MAX_DIM as u64));
                chosen.extend((first + 1..=last).map(Column::Number));
            }
        }
        if !(MIN_DIM..=MAX_DIM).contains(&chosen.len()) {
            return Err(refused(message!(
                "{} chooses {} columns{}; points have {MIN_DIM} to {MAX_DIM} coordinates",
                quoted(text),
                chosen.len().min(MAX_DIM + 1),
                if chosen.len() > MAX_DIM { " or more" } else { "" },
            )));
        }
        for (index, column) in chosen.iter().enumerate() {
            if chosen[..index].contains(column) {
                return Err(refused(message!("{} has a column twice", quoted(text))));
            }
        }
        Ok(Self { chosen })
    }
}

/// Parses a column, and the last number of a range; or returns the rule that the entry breaks.
pub(super) fn parse_entry(entry: &str) -> OrRule<(Column, Option<u64>)> {
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let number = |text: &str| match text.parse::<u64>() {
        Ok(number) if number > 0 => Ok(number),
        _ => Err(message!("{} is no column; they count from 1", quoted(text))),
    };
    match entry.split_once('-') {
        _ if entry.is_empty() => {
            Err("an entry is empty; give numbers (1,2,5), a range (1-3) or names (x,y,z)".into())
        }
        Some((first, last)) if is_number(first) && is_number(last) => {
            let (first, last) = (number(first)?, number(last)?);
            match first <= last {
                true => Ok((Column::Number(first), Some(last))),
                false => Err(message!("the range {} runs backwards", quoted(entry))),
            }
        }
        _ if is_number(entry) => Ok((Column::Number(number(entry)?), None)),
        // `1-` and `-3` are ranges without an end, not names.
        Some((first, last)) if is_number(first) && last.is_empty() || first.is_empty() => {
            Err(message!("the range {} has no two ends", quoted(entry)))
        }
        _ => Ok((Column::Name(entry.to_string()), None)),
    }
}

fn refused(why: String) -> Error {
    Error::invalid(say!(Name::Columns, ": {why}"))
}

impl Columns {
    /// Returns true if columns are chosen, false if the format's own rule applies.
    pub fn are_chosen(&self) -> bool {
        !self.chosen.is_empty()
    }

    /// Returns true if columns are chosen, all by numbers, and these fields of a first line are
    /// numbers: then it is a point, whatever stands in the other fields.
    pub(super) fn are_numbers_in(&self, fields: &[&str]) -> bool {
        let is_number = |column: u64| fields[column as usize].parse::<f64>().is_ok();
        let indices = self.indices(fields.len() as u64, None);
        self.are_chosen() && indices.is_ok_and(|columns| columns.into_iter().all(is_number))
    }

    /// Refuses columns of a format that says itself which numbers are coordinates.
    pub(super) fn require_none(&self, format: &str) -> Result<()> {
        match self.are_chosen() {
            false => Ok(()),
            true => Err(refused(message!(
                "{format} files say themselves which numbers are coordinates; columns are chosen \
                 in XYZ, CSV and NumPy files"
            ))),
        }
    }

    /// Returns the chosen columns, counted from 0, of a table with `count` columns.
    pub(super) fn indices(&self, count: u64, names: Option<&[&str]>) -> Result<Vec<u64>> {
        let index = |column: &Column| column.index(count, names).map_err(refused);
        let indices = self.chosen.iter().map(index).collect::<Result<Vec<u64>>>()?;
        for (position, index) in indices.iter().enumerate() {
            if indices[..position].contains(index) {
                return Err(refused(message!("column {} is chosen twice", index + 1)));
            }
        }
        Ok(indices)
    }
}

impl Column {
    /// Returns the column, counted from 0, of a table with `count` columns; or the rule that it
    /// breaks.
    pub fn index(&self, count: u64, names: Option<&[&str]>) -> OrRule<u64> {
        match (self, names) {
            (Self::Number(number), _) if *number <= count => Ok(number - 1),
            (Self::Number(number), _) => {
                Err(message!("there is no column {number}; the file has {count} columns"))
            }
            (Self::Name(name), Some(names)) => index_of(name, names),
            (Self::Name(name), None) => Err(message!(
                "{} is a name, and the file has none for its columns; choose by number",
                quoted(name)
            )),
        }
    }
}

fn index_of(name: &str, names: &[&str]) -> OrRule<u64> {
    let mut found = names.iter().enumerate().filter(|(_, other)| other.eq_ignore_ascii_case(name));
    match (found.next(), found.next()) {
        (Some((index, _)), None) => Ok(index as u64),
        (Some(_), Some(_)) => {
            Err(message!("two columns are called {}; choose by number", quoted(name)))
        }
        (None, _) => {
            Err(message!("no column is called {}; there are {}", quoted(name), listed(names)))
        }
    }
}

/// Names as a message shows them.
fn listed(names: &[&str]) -> String {
    const SHOWN: usize = 200;
    let mut text = String::new();
    for (index, name) in names.iter().enumerate() {
        if text.len() > SHOWN {
            return message!("{text} and {} more", names.len() - index);
        }
        text += if index == 0 { "" } else { ", " };
        text += &quoted(name);
    }
    text
}

/// Returns the columns that are coordinates by their names: `x`, `y` and, where it is there, `z`;
/// otherwise `x0`, `x1` and so on, or `points_0`, `points_1` and so on. None if the names say
/// nothing; an error with the name if two columns have it.
pub(super) fn named_coordinates(names: &[&str]) -> OrRule<Option<Vec<u64>>> {
    let letters = ["x", "y", "z"].map(str::to_string);
    let numbered = |prefix| (0..=names.len()).map(move |axis| format!("{prefix}{axis}"));
    for sought in [
        leading(letters.into_iter(), names),
        leading(numbered("x"), names),
        leading(numbered("points_"), names),
    ] {
        if sought.len() < MIN_DIM {
            continue;
        }
        for &column in &sought {
            let name = names[column as usize];
            if names.iter().filter(|other| other.eq_ignore_ascii_case(name)).count() > 1 {
                return Err(message!("two columns are called {}", quoted(name)));
            }
        }
        return Ok(Some(sought));
    }
    Ok(None)
}

/// Returns the columns of `sought` up to the first name that is not there.
fn leading(sought: impl Iterator<Item = String>, names: &[&str]) -> Vec<u64> {
    let column = |name: String| names.iter().position(|other| other.eq_ignore_ascii_case(&name));
    // One more than there may be, so that the dimension is refused.
    sought.map_while(column).take(MAX_DIM + 1).map(|column| column as u64).collect()
}

/// Returns coordinates that stood column by column, in the order of the file's columns, point by
/// point in the order of `columns`.
pub(super) fn transposed(coordinates: &[f64], columns: &[u64]) -> Result<Vec<f64>> {
    let points = coordinates.len() / columns.len();
    let rank = |column: &u64| columns.iter().filter(|other| *other < column).count();
    let ranks: Vec<usize> = columns.iter().map(rank).collect();
    let mut by_point = crate::memory::with_capacity(coordinates.len())?;
    for point in 0..points {
        by_point.extend(ranks.iter().map(|rank| coordinates[rank * points + point]));
    }
    Ok(by_point)
}

#[cfg(test)]
mod tests {
    use super::super::{Choice, Format, PointCloud, read_table};
    use super::*;
    use crate::error::ErrorKind;

    fn numbers(text: &str) -> Vec<u64> {
        text.parse::<Columns>().unwrap().indices(100, None).unwrap()
    }

    #[test]
    fn lists_and_ranges_are_columns_from_one() {
        assert_eq!(numbers("1-3"), [0, 1, 2]);
        assert_eq!(numbers("1, 2 ,5"), [0, 1, 4]);
        assert_eq!(numbers("7,2-3,1"), [6, 1, 2, 0]);
    }

    #[test]
    fn bad_lists_are_refused_with_their_rule() {
        for (text, rule) in [
            ("", "an entry is empty"),
            ("1,,2", "an entry is empty"),
            ("1", "chooses 1 columns; points have 2 to 8"),
            ("1-9", "chooses 9 columns or more; points have 2 to 8"),
            ("1-18446744073709551615", "or more; points have 2 to 8"),
            ("18446744073709551615,1-2,18446744073709551615", "has a column twice"),
            ("0-2", "\"0\" is no column; they count from 1"),
            ("1,99999999999999999999", "they count from 1"),
            ("3-1", "runs backwards"),
            ("1-", "has no two ends"),
            ("-3", "has no two ends"),
            ("2,1-3", "has a column twice"),
        ] {
            let error = text.parse::<Columns>().unwrap_err();
            assert_eq!(error.kind(), ErrorKind::InvalidArgument, "{text:?}");
            assert!(error.message().starts_with("columns: "), "{error}");
            assert!(error.message().contains(rule), "{text:?}: {error}");
        }
    }

    fn read(text: &str, format: Format, columns: &str) -> Result<PointCloud> {
        let choice = Choice { coordinates: columns.parse()?, ..Choice::default() };
        Ok(read_table(&mut text.as_bytes(), format, &choice)?.points)
    }

    #[test]
    fn chosen_columns_are_read_in_the_order_of_the_choice() {
        let expected = PointCloud { dim: 2, coordinates: vec![3.0, 1.0, 7.0, 5.0] };
        for (text, format, columns) in [
            ("1 a 3\n5 b 7\n", Format::Xyz, "3,1"),
            ("1,a,3\n5,,7\n", Format::Xyz, "3,1"),
            ("1,2,3\n5,,7\n", Format::Csv, "3,1"),
            ("u,label,v\n1,a,3\n5,,7\n", Format::Csv, "3,1"),
            ("1,a,3\n5,,7\n", Format::Csv, "3,1"),
            ("\"1\",\"a, 2\",3\n5,,7\n", Format::Csv, "3,1"),
            ("u,label,\"v\"\n1,a,3\n5,,7\n", Format::Csv, "V,u"),
        ] {
            assert_eq!(read(text, format, columns).unwrap(), expected, "{text:?} {columns}");
        }
    }

    #[test]
    fn columns_that_are_not_there_are_named() {
        for (text, format, columns, rule) in [
            ("1 2\n3 4\n", Format::Xyz, "1-3", "there is no column 3; the file has 2 columns"),
            ("1 2\n3 4\n", Format::Xyz, "x,y", "the file has none for its columns"),
            ("1,2\n3,4\n", Format::Csv, "x,y", "the file has none for its columns"),
            ("x,h\n3,4\n", Format::Csv, "x,y", "no column is called \"y\"; there are \"x\", \"h\""),
            ("x,y,Y\n3,4,5\n", Format::Csv, "x,y", "two columns are called \"y\""),
            ("x,y\n3,4\n", Format::Csv, "x,1", "column 1 is chosen twice"),
            ("OFF\n", Format::Off, "1-2", "OFF files say themselves"),
        ] {
            let error = read(text, format, columns).unwrap_err();
            assert_eq!(error.kind(), ErrorKind::InvalidArgument, "{text:?}: {error}");
            assert!(error.message().contains(rule), "{text:?}: {error}");
        }
    }

    #[test]
    fn lines_of_another_length_are_refused() {
        for (text, format) in [("1 2 3\n4 5\n", Format::Xyz), ("1,2,3\n4,5\n", Format::Csv)] {
            let error = read(text, format, "1-2").unwrap_err();
            assert_eq!(error.message(), "line 2: 2 columns; the first line has 3");
        }
    }
}
