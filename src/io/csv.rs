//! CSV: one point per line, fields between commas, at most one header line, whose names say which
//! columns are the coordinates.

use super::attributes::Scalar;
use super::choice::others;
use super::columns::named_coordinates;
use super::layout::Layout;
use super::text::{Line, Lines, quoted, write_number, write_point};
use super::xyz::for_each_vertex;
use super::{Choice, Table};
use crate::error::{ErrorKind, Result};
use crate::memory::collected;
use crate::mesh::{Attribute, Mesh};
use std::io::{self, Write};

/// The header of the column that [`write`] adds to the coordinates.
const KIND: &str = "kind";

pub(super) fn read(mut lines: Lines<'_>, choice: &Choice) -> Result<Table> {
    let mut layout: Option<Layout> = None;
    while let Some(line) = lines.next()? {
        check_quotes(&line)?;
        if let Some(layout) = layout.as_mut() {
            layout.add(&line, texts(&line))?;
            continue;
        }
        let header = match choice.coordinates.are_numbers_in(&collected(texts(&line))?) {
            true => None,
            false => header_of(&line)?,
        };
        let layout = layout.insert(layout_of(&line, header.as_deref(), choice)?);
        if header.is_none() {
            layout.add(&line, texts(&line))?;
        }
    }
    Layout::finish(layout)
}

/// Returns the names in the first line; none if it is a point, between quotes or not. A header
/// holds no number, but for one between quotes beside the names `x` and `y`: any other line with
/// some is a damaged point or a header that does not fit, and neither may be skipped in silence.
fn header_of<'a>(line: &Line<'a>) -> Result<Option<Vec<&'a str>>> {
    let is_number = |field: &Field<'_>| field.text.parse::<f64>().is_ok();
    let Some((column, word)) = fields(line).enumerate().find(|(_, field)| !is_number(field)) else {
        return Ok(None);
    };
    refuse_other_separators(line)?;
    // Programs that pass a table on like to put its names in quotes.
    let names = collected(texts(line))?;
    let mut numbers = fields(line).filter(is_number).peekable();
    let has_coordinates = || matches!(named_coordinates(&names), Ok(Some(_)) | Err(_));
    if numbers.peek().is_some() && !(numbers.all(|field| field.is_quoted) && has_coordinates()) {
        return Err(line.not_a_number(column, word.text));
    }
    Ok(Some(names))
}

/// Refuses a first line without a comma in which something else stands between fields: one column
/// is no point.
fn refuse_other_separators(line: &Line<'_>) -> Result<()> {
    if fields(line).nth(1).is_some() {
        return Ok(());
    }
    let separators = [(';', "semicolons"), ('\t', "tabs"), ('|', "bars"), (' ', "blanks")];
    match separators.into_iter().find(|(separator, _)| line.text.contains(*separator)) {
        None => Ok(()),
        Some((_, name)) => {
            let more = if name == "blanks" { "; such files are .xyz, not .csv" } else { "" };
            let message = format!(
                "{name} separate the fields of {}; in CSV files commas do, and the decimal sign is \
                 a point{more}",
                quoted(line.text)
            );
            Err(line.error(message))
        }
    }
}

fn layout_of(line: &Line<'_>, names: Option<&[&str]>, choice: &Choice) -> Result<Layout> {
    let all = texts(line).count();
    // All, without a last one called `kind`.
    let otherwise = |listed: &[u64]| {
        let with_kind = names.is_some_and(|names| names.last() == Some(&KIND));
        Ok(others((all - usize::from(with_kind)) as u64, listed))
    };
    let found = choice.of_table(all as u64, names, otherwise);
    let (coordinates, values) = found.map_err(|error| match error.kind() {
        ErrorKind::Format => line.error(error.message()),
        _ => error,
    })?;
    Layout::new(line, all, coordinates, values)
}

/// A field, without the quotes around it.
struct Field<'a> {
    text: &'a str,
    is_quoted: bool,
}

/// The fields of a line whose quotes are right.
struct Fields<'a> {
    rest: Option<&'a str>,
}

fn fields<'a>(line: &Line<'a>) -> Fields<'a> {
    Fields { rest: Some(line.text) }
}

fn texts<'a>(line: &Line<'a>) -> impl Iterator<Item = &'a str> + use<'a> {
    fields(line).map(|field| field.text)
}

impl<'a> Iterator for Fields<'a> {
    type Item = Field<'a>;

    fn next(&mut self) -> Option<Field<'a>> {
        let rest = self.rest.take()?;
        let opened = rest.trim_ascii_start().strip_prefix('"');
        let quoted = opened.and_then(|after| Some((after, closing_quote(after)?)));
        let (text, after) = match quoted {
            Some((after, end)) => (&after[..end], &after[end + 1..]),
            None => (rest, rest),
        };
        let is_quoted = quoted.is_some();
        let (head, tail) = after.split_once(',').map_or((after, None), |(h, t)| (h, Some(t)));
        self.rest = tail;
        let text = if is_quoted { text } else { head };
        Some(Field { text: text.trim_ascii(), is_quoted })
    }
}

/// Returns the position of the quote that ends a field; two of them stand for one in it.
fn closing_quote(text: &str) -> Option<usize> {
    let mut from = 0;
    loop {
        let at = from + text[from..].find('"')?;
        if !text[at + 1..].starts_with('"') {
            return Some(at);
        }
        from = at + 2;
    }
}

/// Refuses a quote without an end in its line, and text between a quote's end and the next comma.
fn check_quotes(line: &Line<'_>) -> Result<()> {
    let mut rest = if line.text.contains('"') { Some(line.text) } else { None };
    let mut column = 0;
    while let Some(text) = rest {
        let refuse = |message: String| Err(line.field_error(ErrorKind::Format, column, message));
        rest = match text.trim_ascii_start().strip_prefix('"') {
            None => text.split_once(',').map(|(_, rest)| rest),
            Some(after) => {
                let Some(end) = closing_quote(after) else {
                    return refuse(format!(
                        "{} has no quote at its end; a field may not go on in the next line",
                        quoted(text.trim_ascii_start())
                    ));
                };
                let after = after[end + 1..].trim_ascii_start();
                if !after.is_empty() && !after.starts_with(',') {
                    let shown = quoted(after);
                    return refuse(format!("{shown} between a quote's end and the next comma"));
                }
                after.strip_prefix(',')
            }
        };
        column += 1;
    }
    Ok(())
}

pub(super) fn write(mesh: &Mesh, attributes: &[Attribute], out: &mut dyn Write) -> io::Result<()> {
    for axis in 0..mesh.inputs().dim() {
        write!(out, "x{axis},")?;
    }
    write!(out, "{KIND}")?;
    for attribute in attributes {
        (0..attribute.components).try_for_each(|k| write!(out, ",{}", Scalar(attribute, k)))?;
    }
    out.write_all(b"\n")?;
    let mut vertex = 0;
    for_each_vertex(mesh, |kind, point| {
        write_point(out, point, ",")?;
        write!(out, ",{kind}")?;
        for attribute in attributes {
            for &value in attribute.of(vertex) {
                out.write_all(b",")?;
                write_number(out, value)?;
            }
        }
        vertex += 1;
        out.write_all(b"\n")
    })
}

#[cfg(test)]
mod tests {
    use super::super::{Format, PointCloud, read, samples, write};
    use super::*;

    #[test]
    fn reads_with_and_without_a_header() {
        let expected = PointCloud { dim: 2, coordinates: vec![1.0, 2.0, -3.0, 4e9] };
        for text in [
            "1,2\n-3,4e9\n",
            "# exported\nx,y\r\n 1 , 2\r\n\r\n-3,4e9",
            "\"x\",\"y\"\n1,2\n-3,4e9",
            "x,y,kind\n1,2,0\n-3,4e9,anything\n",
            "\"x\",\"y\",\"kind\"\n1,2,0\n-3,4e9,1\n",
        ] {
            assert_eq!(read(&mut text.as_bytes(), Format::Csv).unwrap(), expected, "{text:?}");
        }
    }

    #[test]
    fn a_header_names_the_coordinates() {
        let expected = PointCloud { dim: 2, coordinates: vec![1.0, 2.0, -3.0, 4e9] };
        for text in [
            "x,y,intensity\n1,2,9\n-3,4e9,9\n",
            "id,Y,X,label\n7,2,1,a\n8,4e9,-3,\n",
            "\"x0\",\"x1\",\"r\",\"g\"\n1,2,0,0\n-3,4e9,0,0\n",
            // No names of coordinates: all columns but the kind.
            "lon,lat,kind\n1,2,0\n-3,4e9,1\n",
        ] {
            assert_eq!(read(&mut text.as_bytes(), Format::Csv).unwrap(), expected, "{text:?}");
        }
        let cloud = read(&mut "r,g,b,z,y,x\n9,9,9,3,2,1\n".as_bytes(), Format::Csv).unwrap();
        assert_eq!(cloud, PointCloud { dim: 3, coordinates: vec![1.0, 2.0, 3.0] });
        let error = read(&mut "x,y,x\n1,2,3\n".as_bytes(), Format::Csv).unwrap_err();
        assert_eq!(error.message(), "line 1: two columns are called \"x\"");
    }

    #[test]
    fn vertices_read_back_bit_by_bit() {
        for dim in 2..=8 {
            let mesh = samples::mesh(dim);
            let mut text = Vec::new();
            write(&mesh, Format::Csv, &mut text).unwrap();
            let read = read(&mut text.as_slice(), Format::Csv).unwrap();
            assert_eq!(read.dim, dim);
            samples::assert_same_bits(&read.coordinates, &mesh.triangulation().unwrap().points);
        }
    }

    #[test]
    fn the_kind_stands_in_the_last_column() {
        let mut text = Vec::new();
        write(&samples::square(), Format::Csv, &mut text).unwrap();
        let expected = "x0,x1,kind\n0,0,0\n1,0,0\n1,1,1\n0,1,2\n";
        assert_eq!(String::from_utf8(text).unwrap(), expected);
    }

    #[test]
    fn before_a_run_the_distinct_inputs_are_written() {
        let mesh = Mesh::new(2, 3, &[0.0, 0.5, -0.0, 0.5, 1e300, -0.0], 0).unwrap();
        let mut text = Vec::new();
        write(&mesh, Format::Csv, &mut text).unwrap();
        assert_eq!(String::from_utf8(text).unwrap(), "x0,x1,kind\n0,0.5,0\n1e300,-0,0\n");
    }
}
