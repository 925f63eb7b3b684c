//! CSV: one point per line, fields between commas, at most one header line.

use super::PointCloud;
use super::text::{Line, Lines, Points, write_point};
use super::xyz::for_each_vertex;
use crate::error::Result;
use crate::mesh::Mesh;
use std::io::{self, Write};

/// The header of the column that [`write`] adds to the coordinates.
const KIND: &str = "kind";

pub(super) fn read(mut lines: Lines<'_>) -> Result<PointCloud> {
    let mut points = Points::default();
    let mut columns = None;
    while let Some(line) = lines.next()? {
        let columns = match columns {
            Some(columns) => columns,
            None => {
                let (first, is_header) = Columns::of_first_line(&line)?;
                columns = Some(first);
                if is_header {
                    continue;
                }
                first
            }
        };
        columns.check(&line)?;
        points.add(&line, fields(&line).enumerate().take(columns.coordinates))?;
    }
    points.finish()
}

/// What the first line says about all others.
#[derive(Clone, Copy)]
struct Columns {
    all: usize,
    /// The leading columns, which hold the point.
    coordinates: usize,
}

impl Columns {
    /// Also tells whether the line is a header, that is, holds no number at all. A line with some
    /// is a damaged point or a header that does not fit: neither may be skipped in silence.
    fn of_first_line(line: &Line<'_>) -> Result<(Self, bool)> {
        let is_number = |field: &str| field.parse::<f64>().is_ok();
        let all = fields(line).count();
        let Some((column, word)) = fields(line).enumerate().find(|(_, field)| !is_number(field))
        else {
            return Ok((Self { all, coordinates: all }, false));
        };
        if fields(line).any(is_number) {
            return Err(line.not_a_number(column, word));
        }
        // Programs that pass a table on like to put its names in quotes.
        let with_kind = fields(line).last().map(|name| name.trim_matches('"')) == Some(KIND);
        Ok((Self { all, coordinates: all - usize::from(with_kind) }, true))
    }

    fn check(self, line: &Line<'_>) -> Result<()> {
        let count = fields(line).count();
        if count != self.all {
            return Err(line.error(format!("{count} columns; the first line has {}", self.all)));
        }
        Ok(())
    }
}

fn fields<'a>(line: &Line<'a>) -> impl Iterator<Item = &'a str> + use<'a> {
    line.text.split(',').map(str::trim_ascii)
}

pub(super) fn write(mesh: &Mesh, out: &mut dyn Write) -> io::Result<()> {
    for axis in 0..mesh.inputs().dim() {
        write!(out, "x{axis},")?;
    }
    writeln!(out, "{KIND}")?;
    for_each_vertex(mesh, |kind, point| {
        write_point(out, point, ",")?;
        writeln!(out, ",{kind}")
    })
}

#[cfg(test)]
mod tests {
    use super::super::{Format, read, samples, write};
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
