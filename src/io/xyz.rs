//! XYZ: one point per line. A first line may be the number of points, as `.pts` files have it,
//! which scanners write: x y z, perhaps intensity, perhaps colour.

use super::choice::others;
use super::layout::Layout;
use super::text::{Line, Lines, Points, quoted, write_point};
use super::{Choice, Table};
use crate::error::{ErrorKind, Result};
use crate::mesh::Mesh;
use std::io::{self, Write};
use std::path::Path;

/// Names of the columns of a `.pts` file, by their number.
const COLUMNS: [&[&str]; 5] = [
    &["x", "y"],
    &["x", "y", "z"],
    &["x", "y", "z", "intensity"],
    &["x", "y", "z", "r", "g", "b"],
    &["x", "y", "z", "intensity", "r", "g", "b"],
];

/// Reads points a line. `path` is that of the file, if it has one.
pub(super) fn read(mut lines: Lines<'_>, choice: &Choice, path: Option<&Path>) -> Result<Table> {
    let mut rows = Rows { choice, points: Points::default(), layout: None, is_scan: false };
    let (mut index, mut count) = (0, None);
    loop {
        let line = match count {
            None => lines.next()?,
            Some(count) if index < count => {
                Some(lines.require(|| format!("{index} of {count} points"))?)
            }
            Some(count) => {
                lines.require_end(&format!("the {count} points of the first line"))?;
                None
            }
        };
        let Some(line) = line else { return rows.finish() };
        if index == 0 && count.is_none() {
            refuse_annotations(&line)?;
            count = count_in(&line);
            if count.is_some() {
                rows.is_scan = path.and_then(Path::extension).is_some_and(is_pts);
                continue;
            }
        }
        if line.text.contains(',') {
            refuse_decimal_commas(&line)?;
        }
        rows.add(&line, index == 0, count.is_some())?;
        index += 1;
    }
}

fn is_pts(extension: &std::ffi::OsStr) -> bool {
    extension.eq_ignore_ascii_case("pts")
}

/// Returns the number in a line that holds nothing else: no point has one coordinate.
fn count_in(line: &Line<'_>) -> Option<u64> {
    let is_count = line.text.bytes().all(|byte| byte.is_ascii_digit());
    if is_count { line.text.parse().ok() } else { None }
}

/// Refuses by name what else has the extension `.pts`.
fn refuse_annotations(line: &Line<'_>) -> Result<()> {
    let kind = match line.text.split([':', ' ', '\t']).next() {
        Some("version") => "landmarks of an image (version, n_points, points between braces)",
        Some("point" | "index") if line.word_count() == 1 => "points of elastix",
        _ => return Ok(()),
    };
    let shown = quoted(line.text);
    Err(line.error(format!("{shown} begins a file of {kind}; leave the points alone, one a line")))
}

/// Points that have been read.
struct Rows<'c> {
    choice: &'c Choice,
    /// The points where all columns are coordinates.
    points: Points,
    /// The points where not all are.
    layout: Option<Layout>,
    /// The columns are those of [`COLUMNS`].
    is_scan: bool,
}

impl Rows<'_> {
    fn add(&mut self, line: &Line<'_>, is_first: bool, is_counted: bool) -> Result<()> {
        if is_first {
            self.layout = self.layout_of(line, is_counted)?;
        }
        match &mut self.layout {
            Some(layout) => layout.add(line, fields(line)),
            // Most files have no comma.
            None if !line.text.contains(',') => self.points.add(line, line.words()),
            None => self.points.add(line, fields(line).enumerate()),
        }
    }

    /// Returns the layout that the first line shows; none where all columns are coordinates.
    fn layout_of(&self, line: &Line<'_>, is_counted: bool) -> Result<Option<Layout>> {
        let is_chosen = *self.choice != Choice::default();
        let all = fields(line).count();
        if !is_chosen && (!is_counted || all <= 3) {
            return Ok(None);
        }
        let names = COLUMNS.into_iter().find(|names| self.is_scan && names.len() == all);
        if !is_chosen && names.is_none() {
            let message = format!(
                "{all} columns below a number of points; .pts files have x y z, and perhaps \
                 intensity and r g b"
            );
            return Err(line.error_of_kind(ErrorKind::Dimension, message));
        }
        let otherwise = |listed: &[u64]| Ok(others(all as u64, listed));
        let (coordinates, values) = self.choice.of_table(all as u64, names, otherwise)?;
        Layout::new(line, all, coordinates, values).map(Some)
    }

    fn finish(self) -> Result<Table> {
        match self.layout {
            Some(layout) => Layout::finish(Some(layout)),
            None => Ok(Table::new(self.points.finish()?, Vec::new())),
        }
    }
}

/// Returns the fields of a line: between commas (and blanks around them), or between blanks where
/// there is no comma. Two commas have an empty field between them, which is refused later: a number
/// may be missing there.
fn fields<'a>(line: &Line<'a>) -> impl Iterator<Item = &'a str> + use<'a> {
    line.text.split(',').flat_map(|part| {
        let missing = part.trim_ascii().is_empty().then_some("");
        missing.into_iter().chain(part.split_ascii_whitespace())
    })
}

/// Refuses numbers that are separated by blanks in one place and by a comma in another: `0,5 1,5`
/// is how half of the world writes one point in the plane, and must not become one in four
/// dimensions.
fn refuse_decimal_commas(line: &Line<'_>) -> Result<()> {
    let mut column = 0;
    let mut parts = line.text.split(',').peekable();
    while let Some(part) = parts.next() {
        let words = part.split_ascii_whitespace().count();
        let alone = column == 0 && parts.peek().is_none();
        if words > 1 && !alone {
            let message = "commas and blanks both separate numbers in this line; where a comma is \
                a decimal one, write a point";
            return Err(line.field_error(ErrorKind::Format, column + 1, message));
        }
        column += words.max(1);
    }
    Ok(())
}

pub(super) fn write(mesh: &Mesh, out: &mut dyn Write) -> io::Result<()> {
    for_each_vertex(mesh, |_, point| {
        write_point(out, point, " ")?;
        out.write_all(b"\n")
    })
}

/// Calls `visit` with the kind (as in files) and the point of each vertex, before a run of each
/// distinct input.
pub(super) fn for_each_vertex(
    mesh: &Mesh,
    mut visit: impl FnMut(u8, &[f64]) -> io::Result<()>,
) -> io::Result<()> {
    match mesh.triangulation() {
        Some(triangulation) => triangulation
            .kinds
            .iter()
            .zip(triangulation.points.chunks_exact(triangulation.dim))
            .try_for_each(|(kind, point)| visit(*kind as u8, point)),
        None => {
            let inputs = mesh.inputs();
            (0..inputs.distinct()).try_for_each(|v| visit(0, inputs.distinct_point(v)))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Format, PointCloud, read, samples, write};
    use super::*;

    fn points(text: &str) -> PointCloud {
        read(&mut text.as_bytes(), Format::Xyz).unwrap()
    }

    #[test]
    fn blanks_and_commas_separate() {
        let expected = PointCloud { dim: 3, coordinates: vec![1.0, -2.5, 3e-7, 4.0, 5.0, 6.0] };
        for text in [
            "1 -2.5 3e-7\n4 5 6",
            "1,-2.5,3e-7\r\n\r\n4,5,6\r\n",
            "# x y z\n\t1 ,\t-2.5 , 3E-7 # the first\n\n+4.0  5. .6e1\n",
        ] {
            assert_eq!(points(text), expected, "{text:?}");
        }
    }

    #[test]
    fn too_small_a_number_becomes_a_zero_of_its_sign() {
        let read = points("1e-999 -1e-999");
        samples::assert_same_bits(&read.coordinates, &[0.0, -0.0]);
    }

    #[test]
    fn vertices_read_back_bit_by_bit() {
        for dim in 2..=8 {
            let mesh = samples::mesh(dim);
            let mut text = Vec::new();
            write(&mesh, Format::Xyz, &mut text).unwrap();
            let read = read(&mut text.as_slice(), Format::Xyz).unwrap();
            assert_eq!(read.dim, dim);
            samples::assert_same_bits(&read.coordinates, &mesh.triangulation().unwrap().points);
        }
    }

    #[test]
    fn before_a_run_the_distinct_inputs_are_written() {
        let mesh = Mesh::new(2, 3, &[0.0, 0.5, -0.0, 0.5, 1e300, -0.0], 0).unwrap();
        let mut text = Vec::new();
        write(&mesh, Format::Xyz, &mut text).unwrap();
        assert_eq!(String::from_utf8(text).unwrap(), "0 0.5\n1e300 -0\n");
    }
}
