//! XYZ: one point per line, nothing else.

use super::choice::others;
use super::layout::Layout;
use super::text::{Line, Lines, Points, write_point};
use super::{Choice, Table};
use crate::error::{ErrorKind, Result};
use crate::mesh::Mesh;
use std::io::{self, Write};

pub(super) fn read(mut lines: Lines<'_>, choice: &Choice) -> Result<Table> {
    if *choice != Choice::default() {
        return read_chosen(lines, choice);
    }
    let mut points = Points::default();
    while let Some(line) = lines.next()? {
        refuse_decimal_commas(&line)?;
        points.add(&line, fields(&line).enumerate())?;
    }
    Ok(Table::new(points.finish()?, Vec::new()))
}

fn read_chosen(mut lines: Lines<'_>, choice: &Choice) -> Result<Table> {
    let mut layout: Option<Layout> = None;
    while let Some(line) = lines.next()? {
        refuse_decimal_commas(&line)?;
        let layout = match layout.as_mut() {
            Some(layout) => layout,
            None => layout.insert(layout_of(&line, choice)?),
        };
        layout.add(&line, fields(&line))?;
    }
    Layout::finish(layout)
}

fn layout_of(line: &Line<'_>, choice: &Choice) -> Result<Layout> {
    let all = fields(line).count();
    let otherwise = |listed: &[u64]| Ok(others(all as u64, listed));
    let (coordinates, values) = choice.of_table(all as u64, None, otherwise)?;
    Layout::new(line, all, coordinates, values)
}

/// The fields of a line: between commas (and blanks around them), or between blanks where there is
/// no comma. Two commas have an empty field between them, which is refused later: a number may be
/// missing there.
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
            let message = "commas and blanks both separate numbers in this line; where a comma is a \
                           decimal one, write a point";
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
