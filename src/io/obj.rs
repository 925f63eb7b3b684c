//! Wavefront's OBJ: points, and the polygons and lines between them. The marker of a polygon or
//! line is the number of its group, in the order of their first names; 0 before any. Normals,
//! textures and materials say nothing that counts.

use super::polygons::Polygons;
use super::text::{Line, Lines, Points, quoted};
use super::values::{Outline, Table};
use crate::error::{ErrorKind, Result};
use crate::memory::{AllocError, TryGrow};
use std::collections::HashMap;

/// Keywords of lines that say nothing of points, polygons and lines.
const OTHERS: [&str; 14] = [
    "vt",
    "vn",
    "s",
    "p",
    "usemtl",
    "mtllib",
    "usemap",
    "maplib",
    "lod",
    "bevel",
    "c_interp",
    "d_interp",
    "shadow_obj",
    "trace_obj",
];

/// Keywords of curves and curved surfaces.
const CURVED: [&str; 14] = [
    "vp", "cstype", "deg", "bmat", "step", "curv", "curv2", "surf", "parm", "trim", "hole", "scrv",
    "sp", "end",
];

pub(super) fn read(mut lines: Lines<'_>) -> Result<Table> {
    let mut content = Content::new();
    // Words of an element that goes on in the next line.
    let mut ids = Vec::new();
    let mut goes_on = None;
    while let Some(line) = lines.next()? {
        let mut words = line.words().peekable();
        let kind = match goes_on.take() {
            Some(kind) => kind,
            None => match words.next().map_or("", |(_, word)| word) {
                "v" => {
                    content.add_point(&line)?;
                    continue;
                }
                "f" | "fo" => Kind::Polygon,
                "l" => Kind::Line,
                "g" | "o" => {
                    content.begin_group(&line)?;
                    continue;
                }
                word if OTHERS.contains(&word) => continue,
                word => return Err(refused(&line, word)),
            },
        };
        for (column, word) in words {
            if word == "\\" {
                goes_on = Some(kind);
                break;
            }
            ids.try_push(content.id(&line, column, word)?)?;
        }
        if goes_on.is_none() {
            content.add(kind, &ids)?;
            ids.clear();
        }
    }
    if goes_on.is_some() {
        lines.require(|| "the last element goes on in a line that is missing".into())?;
    }
    content.finish()
}

fn refused(line: &Line<'_>, word: &str) -> crate::error::Error {
    let message = match CURVED.contains(&word) {
        true => {
            format!("{} is of a curved surface; only polygons and lines are read", quoted(word))
        }
        false => format!("{} begins no line of an OBJ file", quoted(word)),
    };
    line.field_error(ErrorKind::Format, 0, message)
}

#[derive(Clone, Copy)]
enum Kind {
    Polygon,
    Line,
}

/// All that has been read so far.
struct Content {
    points: Points,
    polygons: Polygons,
    outline: Outline,
    /// Name of a group -> its number.
    groups: HashMap<String, i32>,
    group: i32,
}

impl Content {
    fn new() -> Self {
        Self {
            points: Points::of_dimension(3),
            polygons: Polygons::default(),
            outline: Outline::default(),
            groups: HashMap::new(),
            group: 0,
        }
    }

    /// Adds a point: three coordinates, a weight that must be 1, and a colour.
    fn add_point(&mut self, line: &Line<'_>) -> Result<()> {
        let words = || line.words().skip(1);
        let count = words().count();
        if !matches!(count, 3 | 4 | 6 | 7) {
            let message = format!("{count} numbers of a point where 3, 4, 6 or 7 are expected");
            return Err(line.error(message));
        }
        if matches!(count, 4 | 7) {
            let (column, word) = words().nth(3).unwrap_or((4, ""));
            if line.coordinate(column, word)? != 1.0 {
                let message = format!("the weight {} is not 1", quoted(word));
                return Err(line.field_error(ErrorKind::Format, column, message));
            }
        }
        for (column, word) in words().skip(3) {
            line.skip_number(column, word)?;
        }
        self.points.add(line, words().take(3))
    }

    fn begin_group(&mut self, line: &Line<'_>) -> Result<()> {
        let mut name = String::new();
        for (_, word) in line.words().skip(1) {
            name.try_reserve(word.len() + 1).map_err(AllocError::from)?;
            name.push_str(word);
            name.push(' ');
        }
        let next = i32::try_from(self.groups.len() + 1).unwrap_or(i32::MAX);
        self.groups.try_reserve(1).map_err(AllocError::from)?;
        self.group = *self.groups.entry(name).or_insert(next);
        Ok(())
    }

    /// Returns the point that a word of an element names: a number from 1, or one back from the
    /// last point, -1; numbers after a slash are of textures and normals.
    fn id(&self, line: &Line<'_>, column: usize, word: &str) -> Result<u32> {
        let own = word.split('/').next().unwrap_or("");
        let count = self.points.count() as i64;
        let error = |message: String| line.field_error(ErrorKind::Format, column, message);
        let Ok(given) = own.parse::<i64>() else {
            return Err(error(format!("{} is no vertex id", quoted(word))));
        };
        let id = if given < 0 { count.saturating_add(given) } else { given.saturating_sub(1) };
        match (0..count).contains(&id) {
            // There are fewer points than ids of 32 bits, or the mesh will refuse them.
            true => Ok(u32::try_from(id).unwrap_or(u32::MAX)),
            false => {
                Err(error(format!("vertex id {given} of {count} vertices so far")).of_content())
            }
        }
    }

    fn add(&mut self, kind: Kind, ids: &[u32]) -> Result<()> {
        match kind {
            Kind::Polygon => self.polygons.add_face(ids, self.group, &mut self.outline),
            Kind::Line => {
                for ends in ids.windows(2) {
                    self.outline.segments.try_push([ends[0], ends[1]])?;
                    self.outline.markers.try_push(self.group)?;
                }
                Ok(())
            }
        }
    }

    fn finish(self) -> Result<Table> {
        let Self { points, polygons, mut outline, .. } = self;
        outline.facets = polygons.surface();
        Ok(Table { outline, ..Table::new(points.finish()?, Vec::new()) })
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Choice, Format, Table, read_table};
    use crate::error::{ErrorKind, Result};

    fn table(text: &str) -> Result<Table> {
        read_table(&mut text.as_bytes(), Format::Obj, &Choice::default())
    }

    const POINTS: &str = "v 0 0 0\nv 1 0 0 1\nv 1 1 0 .5 .5 .5\nv 0 1 0\nv 0 0 1\n";

    #[test]
    fn polygons_and_lines_have_their_groups_as_markers() {
        let rest = "mtllib a.mtl\nvn 0 0 1\nf 1/2/3 2//1 3 4\ng side one\ns off\nf -5 -4 \\\n -1\n\
                    o other # said\nl 1 2 3\ng side one\nf 2 3 5\nf 4 5\n";
        let read = table(&format!("# a file\n{POINTS}{rest}")).unwrap();
        assert_eq!(read.points.coordinates.len(), 15);
        let facets = &read.outline.facets;
        assert!(!facets.are_triangles);
        assert_eq!(facets.inputs, [0, 1, 2, 3, 0, 1, 4, 1, 2, 4]);
        assert_eq!(facets.markers, [0, 1, 1]);
        assert_eq!(read.outline.segments, [[0, 1], [1, 2], [3, 4]]);
        assert_eq!(read.outline.markers, [2, 2, 1]);
        assert!(table(&format!("{POINTS}f 1 2 3\n")).unwrap().outline.facets.are_triangles);
    }

    #[test]
    fn what_is_wrong_is_named() {
        for (line, message) in [
            ("f 1 2 6", "line 6, column 4: vertex id 6 of 5 vertices so far"),
            ("f 1 2 0", "line 6, column 4: vertex id 0 of 5 vertices so far"),
            ("f 1 2 -6", "line 6, column 4: vertex id -6 of 5 vertices so far"),
            ("f 1 x/2 3", "line 6, column 3: \"x/2\" is no vertex id"),
            (
                "f 1 2 \\",
                "the file ends after line 6: the last element goes on in a line that is missing",
            ),
            ("v 1 2", "line 6: 2 numbers of a point where 3, 4, 6 or 7 are expected"),
            ("v 1 2 3 2", "line 6, column 5: the weight \"2\" is not 1"),
            ("v 1 2 3 red 0 0", "line 6, column 5: \"red\" is not a number"),
            (
                "surf 0 1 0 1 1",
                "line 6, column 1: \"surf\" is of a curved surface; only polygons and lines are \
                 read",
            ),
            ("face 1 2 3", "line 6, column 1: \"face\" begins no line of an OBJ file"),
        ] {
            let error = table(&format!("{POINTS}{line}\n")).unwrap_err();
            assert_eq!((error.kind(), error.message()), (ErrorKind::Format, message));
        }
    }
}
