//! Files that are one input together: points, facets and segments of one file after those of
//! another.

use super::values::{Outline, Table};
use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::{TryGrow, filled};
use crate::mesh::{Facets, LeftOut, NONE};

impl Table {
    /// Appends what another file has: its points, which get the next numbers, and segments, facets
    /// and regions between them. Markers of the other's facets are raised by one number so that
    /// they are larger than those before, unless they are already; so are those of segments. Thus
    /// files that number their parts from 1 on, or not at all, are told apart.
    ///
    /// # Errors
    /// `InvalidArgument` (points of another dimension; polygons after the triangles of a surface,
    /// or the other way; attributes, which the points of the other file would lack; markers that
    /// cannot be raised), `Capacity`, `OutOfMemory`.
    pub fn append(&mut self, other: &Self) -> Result<()> {
        let [own, given] = [self.points.dim, other.points.dim];
        if own != given {
            return Err(Error::invalid(message!(
                "the points have {given} coordinates; they must have {own}, as those of the first \
                 file"
            )));
        }
        if !self.attributes.is_empty() || !other.attributes.is_empty() {
            let message = "points of several files have no attributes; give those of one file";
            return Err(Error::invalid(message));
        }
        require_one_kind(&self.outline.facets, &other.outline.facets)?;
        let first = self.points.count();
        let all = first + other.points.count();
        if all >= NONE as usize {
            let message = message!("{all} points; at most {} fit 32-bit ids", NONE - 1);
            return Err(Error::new(ErrorKind::Capacity, message));
        }
        self.points.coordinates.try_extend(&other.points.coordinates)?;
        self.outline.append(&other.outline, first as u32)?;
        let LeftOut { edges, faces, cells } = other.left_out;
        [edges, faces, cells].into_iter().zip(1..).for_each(|(count, dimension)| {
            self.left_out.add(dimension, count);
        });
        Ok(())
    }
}

/// Refuses triangles of a surface together with polygons, of which every edge is kept.
fn require_one_kind(own: &Facets, given: &Facets) -> Result<()> {
    if own.count() == 0 || given.count() == 0 || own.are_triangles == given.are_triangles {
        return Ok(());
    }
    let [earlier, later] = match own.are_triangles {
        true => ["triangles of a surface", "polygons"],
        false => ["polygons", "triangles of a surface"],
    };
    Err(Error::invalid(message!(
        "the file has {later}, the files before have {earlier}; all must be one or the other \
         (those of .poly and .smesh are polygons)"
    )))
}

impl Outline {
    /// Appends another outline, whose points have numbers from `first` on.
    fn append(&mut self, other: &Self, first: u32) -> Result<()> {
        append_facets(&mut self.facets, &other.facets, first)?;
        if !self.sides.is_empty() || !other.sides.is_empty() {
            // Segments of a file without polygons may all enclose something.
            if self.sides.is_empty() {
                self.sides = filled(self.segments.len(), true)?;
            }
            match other.sides.is_empty() {
                true => self.sides.try_extend(&filled(other.segments.len(), true)?)?,
                false => self.sides.try_extend(&other.sides)?,
            }
        }
        for ends in &other.segments {
            self.segments.try_push(ends.map(|end| end + first))?;
        }
        append_markers(&mut self.markers, &other.markers)?;
        Ok(self.regions.try_extend(&other.regions)?)
    }
}

fn append_facets(own: &mut Facets, given: &Facets, first: u32) -> Result<()> {
    if given.count() == 0 {
        return Ok(());
    }
    if own.count() == 0 {
        (own.loop_starts, own.input_starts) = (filled(1, 0)?, filled(1, 0)?);
    }
    let [loops, inputs] = [own.input_starts.len() as u32 - 1, own.inputs.len() as u32];
    for start in &given.loop_starts[1..] {
        own.loop_starts.try_push(start + loops)?;
    }
    for start in &given.input_starts[1..] {
        own.input_starts.try_push(start + inputs)?;
    }
    for input in &given.inputs {
        own.inputs.try_push(input + first)?;
    }
    own.are_triangles = given.are_triangles;
    append_markers(&mut own.markers, &given.markers)
}

/// Appends markers, raised until the least is larger than all before.
fn append_markers(own: &mut Vec<i32>, given: &[i32]) -> Result<()> {
    let raise = match (own.iter().max(), given.iter().min()) {
        (Some(&largest), Some(&least)) if least <= largest => {
            i64::from(largest) + 1 - i64::from(least)
        }
        _ => 0,
    };
    for &marker in given {
        let raised = i32::try_from(i64::from(marker) + raise).map_err(|_| {
            Error::invalid(message!(
                "the marker {marker} cannot be raised by {raise}, to differ from those of the \
                 files before: markers have 32 bits"
            ))
        })?;
        own.try_push(raised)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::{Choice, Format, read_table};
    use super::*;

    fn read(text: &str, format: Format) -> Table {
        read_table(&mut text.as_bytes(), format, &Choice::default()).unwrap()
    }

    const TRIANGLES: &str = "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 2 3\n";
    const SQUARE: &str = "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
    const POLY: &str = "4 3\n1 0 0 0\n2 4 0 0\n3 4 4 0\n4 0 4 1\n2 1\n1 0 -3\n3 1 2 3\n1 0 9\n\
                        2 1 4\n0\n1\n1 1 1 1 5\n";

    #[test]
    fn points_facets_segments_and_regions_follow_those_before() {
        let mut all = read(TRIANGLES, Format::Off);
        all.append(&read("7 7 7\n", Format::Xyz)).unwrap();
        all.append(&read(TRIANGLES, Format::Off)).unwrap();
        assert_eq!(all.points.count(), 9);
        assert_eq!(all.points.coordinates[12..18], [7.0, 7.0, 7.0, 0.0, 0.0, 0.0]);
        let Facets { loop_starts, input_starts, inputs, markers, .. } = &all.outline.facets;
        assert_eq!(
            (&loop_starts[..], &input_starts[..]),
            (&[0, 1, 2, 3, 4][..], &[0, 3, 6, 9, 12][..])
        );
        assert_eq!(inputs[..], [0, 1, 2, 0, 2, 3, 5, 6, 7, 5, 7, 8]);
        assert_eq!(markers[..], [0, 0, 1, 1]);
        assert!(all.mesh(true).unwrap().given_facets().are_triangles);
        // Points, then polygons with segments and a region.
        let mut all = read("7 7 7\n", Format::Xyz);
        all.append(&read(POLY, Format::Poly)).unwrap();
        assert_eq!(
            (&all.outline.segments[..], &all.outline.markers[..]),
            (&[[1, 4]][..], &[9][..])
        );
        all.append(&read(POLY, Format::Poly)).unwrap();
        assert_eq!(all.outline.facets.markers[..], [-3, -2]);
        assert_eq!(all.outline.facets.inputs[..], [1, 2, 3, 5, 6, 7]);
        assert_eq!((&all.outline.segments[1], &all.outline.markers[..]), (&[5, 8], &[9, 10][..]));
        assert_eq!(all.outline.regions.len(), 2);
        assert!(all.outline.sides.is_empty());
    }

    #[test]
    fn lines_may_enclose_what_sides_of_polygons_do() {
        let polygon = read("POLYGON((0 0, 1 0, 0 1, 0 0))\nLINESTRING(3 3, 4 4)\n", Format::Wkt);
        let lines = read("2 2 0 0\n1 5 5\n2 6 6\n1 0\n1 1 2\n0\n", Format::Poly);
        let sides = |first: &Table, second: &Table| {
            let mut all = first.clone();
            all.append(second).unwrap();
            all.outline.sides
        };
        assert_eq!(sides(&polygon, &lines), [true, true, true, false, true]);
        assert_eq!(sides(&lines, &polygon), [true, true, true, true, false]);
        assert!(sides(&lines, &lines).is_empty());
    }

    #[test]
    fn files_that_are_no_one_input_are_refused() {
        let refusal = |first: &Table, second: &Table| {
            first.clone().append(second).unwrap_err().message().to_owned()
        };
        let (triangles, square) = (read(TRIANGLES, Format::Off), read(SQUARE, Format::Off));
        let rule = "the points have 2 coordinates; they must have 3, as those of the first file";
        assert_eq!(refusal(&triangles, &read("1 2\n", Format::Xyz)), rule);
        let rule = "the file has polygons, the files before have triangles of a surface; all must \
                    be one or the other (those of .poly and .smesh are polygons)";
        assert_eq!(refusal(&triangles, &square), rule);
        assert!(
            refusal(&square, &triangles).starts_with("the file has triangles of a surface, the")
        );
        let mut last = triangles.clone();
        last.outline.facets.markers = vec![i32::MAX, 0];
        let rule = "the marker 0 cannot be raised by 2147483648, to differ from those of the files \
                    before: markers have 32 bits";
        assert_eq!(refusal(&last, &triangles), rule);
    }
}
