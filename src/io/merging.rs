//! Corners of facets that are as good as one, made one.

use super::values::Table;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow, collected, filled};
use crate::mesh::Facets;
use crate::nearest::merge_points;

/// Numbers of what [`Table::merge_corners`] has changed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Merged {
    /// Number of corners that were moved to an earlier one.
    pub points: usize,
    /// Number of triangles of which two corners became one. They are left out.
    pub triangles: usize,
    /// Number of polygons of which no loop has three corners any more. They are left out.
    pub polygons: usize,
    /// Number of loops of other polygons that were left out, too, since fewer than three of their
    /// corners are distinct from the next one.
    pub loops: usize,
    /// Triangles or polygons that were left out, by the numbers that they had, ascending.
    pub left_out: Vec<u32>,
}

impl Table {
    /// Moves corners of facets that are at most `ratio` times the diagonal of the box of all from
    /// an earlier one there, by [`merge_points`]. Of corners of a polygon in a row that are one
    /// point, one stays. Triangles of which two corners become one are left out, and so are loops
    /// of polygons with fewer than three corners that stay, and polygons without other loops. Other
    /// points stay where they are.
    ///
    /// # Errors
    /// Fails as [`merge_points`] does.
    pub fn merge_corners(&mut self, ratio: f64) -> Result<Merged> {
        let dim = self.points.dim;
        let mut corners = collected(self.outline.facets.inputs.iter().copied())?;
        corners.sort_unstable();
        corners.dedup();
        let place = |corner: &u32| *corner as usize * dim..(*corner as usize + 1) * dim;
        let mut coordinates = Vec::new();
        for corner in &corners {
            coordinates.try_extend(&self.points.coordinates[place(corner)])?;
        }
        let were_equal = self.triangles_with_equal_corners()?;
        let points = merge_points(dim, &mut coordinates, ratio)?;
        for (corner, x) in corners.iter().zip(coordinates.chunks_exact(dim)) {
            self.points.coordinates[place(corner)].copy_from_slice(x);
        }
        let mut merged = Merged { points, ..Merged::default() };
        match self.outline.facets.are_triangles {
            true => {
                let collapsed = self.triangles_with_equal_corners()?;
                let is_new = |triangle: &u32| were_equal.binary_search(triangle).is_err();
                merged.left_out = collected(collapsed.into_iter().filter(is_new))?;
                if !merged.left_out.is_empty() {
                    self.outline.facets = without(&self.outline.facets, &merged.left_out)?;
                }
                merged.triangles = merged.left_out.len();
            }
            false => {
                self.leave_out_equal_corners(&mut merged)?;
                merged.polygons = merged.left_out.len();
            }
        }
        self.left_out.add(2, merged.left_out.len() as u64);
        Ok(merged)
    }

    /// Returns the triangles of a surface that have a point twice, ascending.
    fn triangles_with_equal_corners(&self) -> AllocResult<Vec<u32>> {
        let Facets { inputs, are_triangles, .. } = &self.outline.facets;
        let mut found = Vec::new();
        let triangles = if *are_triangles { &inputs[..] } else { &[] };
        for (triangle, number) in triangles.chunks_exact(3).zip(0u32..) {
            let [a, b, c] = [0, 1, 2].map(|at| triangle[at]);
            if self.are_equal(a, b) || self.are_equal(b, c) || self.are_equal(c, a) {
                found.try_push(number)?;
            }
        }
        Ok(found)
    }

    /// Takes the triangles of a surface for polygons, of which every edge is kept. Those with a
    /// point twice are no polygons, and left out; returns their numbers.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn take_triangles_as_polygons(&mut self) -> Result<Vec<u32>> {
        let left_out = self.triangles_with_equal_corners()?;
        if self.outline.facets.are_triangles {
            self.outline.facets = without(&self.outline.facets, &left_out)?;
            self.outline.facets.are_triangles = false;
        }
        Ok(left_out)
    }

    /// Leaves out corners of polygons that are equal to the next one in their loop, and what has no
    /// area without them.
    fn leave_out_equal_corners(&mut self, merged: &mut Merged) -> AllocResult<()> {
        let given = &self.outline.facets;
        let mut kept =
            Facets { loop_starts: filled(1, 0)?, input_starts: filled(1, 0)?, ..Facets::default() };
        for facet in 0..given.count() {
            let (loops, corners) = (kept.input_starts.len(), kept.inputs.len());
            let (mut has_loop, mut gone) = (false, 0);
            for own in given.loops(facet) {
                let first = kept.inputs.len();
                for (at, &corner) in own.iter().enumerate() {
                    if own.len() == 1 || !self.are_equal(corner, own[(at + 1) % own.len()]) {
                        kept.inputs.try_push(corner)?;
                    }
                }
                let stay = kept.inputs.len() - first;
                has_loop |= stay >= 3;
                match own.len() {
                    3.. if stay < 3 => {
                        kept.inputs.truncate(first);
                        gone += 1;
                    }
                    // Of a segment without a length its end stays.
                    2 if stay == 0 => {
                        kept.inputs.try_push(own[0])?;
                        kept.input_starts.try_push(kept.inputs.len() as u32)?;
                    }
                    _ => kept.input_starts.try_push(kept.inputs.len() as u32)?,
                }
            }
            if has_loop || gone == 0 {
                merged.loops += gone;
                kept.loop_starts.try_push(kept.input_starts.len() as u32 - 1)?;
                kept.markers.try_push(given.markers[facet])?;
            } else {
                kept.input_starts.truncate(loops);
                kept.inputs.truncate(corners);
                merged.left_out.try_push(facet as u32)?;
            }
        }
        self.outline.facets = if kept.count() > 0 { kept } else { Facets::default() };
        Ok(())
    }

    /// Returns true if two points have the same coordinates.
    fn are_equal(&self, one: u32, other: u32) -> bool {
        let dim = self.points.dim;
        let place = |point: u32| &self.points.coordinates[point as usize * dim..][..dim];
        place(one) == place(other)
    }
}

/// Returns triangles without some of them, which are sorted.
fn without(facets: &Facets, left_out: &[u32]) -> AllocResult<Facets> {
    let stays = |triangle: &usize| left_out.binary_search(&(*triangle as u32)).is_err();
    let kept = collected((0..facets.count()).filter(stays))?;
    if kept.is_empty() {
        return Ok(Facets::default());
    }
    let count = kept.len() as u32;
    let corners = |&triangle: &usize| facets.inputs[3 * triangle..][..3].iter().copied();
    Ok(Facets {
        loop_starts: collected(0..=count)?,
        input_starts: collected((0..=count).map(|triangle| 3 * triangle))?,
        inputs: collected(kept.iter().flat_map(corners))?,
        markers: collected(kept.iter().map(|&triangle| facets.markers[triangle]))?,
        are_triangles: true,
    })
}

#[cfg(test)]
mod tests {
    use super::super::{Choice, Format, read_table};
    use super::*;

    fn read(text: &str, format: Format) -> Table {
        read_table(&mut text.as_bytes(), format, &Choice::default()).unwrap()
    }

    #[test]
    fn triangles_that_collapse_are_left_out() {
        let text = "OFF\n7 4 0\n0 0 0\n1 0 0\n0 1 0\n1e-13 0 0\n1 1 1\n9e-14 0 0\n0 0 0\n\
                    3 0 1 2\n3 3 2 4\n3 0 3 4\n3 4 4 2\n";
        let mut table = read(text, Format::Off);
        assert_eq!(table.merge_corners(1e-14).unwrap(), Merged::default());
        assert_eq!(
            table.merge_corners(1e-12).unwrap(),
            Merged { points: 1, triangles: 1, left_out: vec![2], ..Merged::default() }
        );
        // That which had a point twice before is for the run to judge.
        assert_eq!(table.outline.facets.inputs, [0, 1, 2, 3, 2, 4, 4, 4, 2]);
        assert_eq!((table.outline.facets.count(), table.left_out.faces), (3, 1));
        // A point that is no corner stays.
        assert_eq!(table.points.coordinates[9..12], [0.0; 3]);
        assert_eq!(table.points.coordinates[15], 9e-14);
        let mesh = table.mesh(true).unwrap();
        assert!(mesh.given_facets().are_triangles && mesh.inputs().duplicates() == 2);
    }

    /// A square with two holes that collapse, a segment that does and a vertex; a sliver of which
    /// three corners become two; a square with a corner twice; and a triangle.
    #[test]
    fn polygons_lose_corners_that_are_one_with_the_next() {
        let points = "0 0 0\n4 0 0\n4 4 0\n0 4 0\n1 1 0\n1 1.0000000000001 0\n2 2 0\n0 0 1e-13\n\
                      1 1 1e-13\n";
        let mut table = read(points, Format::Xyz);
        table.outline.facets = Facets {
            loop_starts: vec![0, 5, 6, 7, 8],
            input_starts: vec![0, 4, 7, 10, 12, 13, 16, 21, 24],
            inputs: [
                &[0, 1, 2, 3, 4, 5, 6, 4, 5, 8, 4, 5, 6][..],
                &[0, 7, 1, 0, 1, 2, 3, 7, 0, 1, 2],
            ]
            .concat(),
            markers: vec![3, 4, 5, 6],
            are_triangles: false,
        };
        let merged = table.merge_corners(1e-10).unwrap();
        let [triangles, polygons, loops] = [0, 1, 2];
        assert_eq!(merged, Merged { points: 3, triangles, polygons, loops, left_out: vec![1] });
        let facets = &table.outline.facets;
        let loops = |facet| facets.loops(facet).map(<[u32]>::to_vec).collect::<Vec<_>>();
        assert_eq!(loops(0), [vec![0, 1, 2, 3], vec![4], vec![6]]);
        assert_eq!(loops(1), [vec![0, 1, 2, 3]]);
        assert_eq!((loops(2), &facets.markers[..]), (vec![vec![0, 1, 2]], &[3, 5, 6][..]));
        assert_eq!(table.left_out.faces, 1);
        table.mesh(true).unwrap();
        // Nothing is left of a polygon that is a point.
        let mut table = read("OFF\n4 1 0\n0 0 0\n0 0 0\n0 0 0\n0 0 0\n4 0 1 2 3\n", Format::Off);
        assert_eq!(table.merge_corners(0.0).unwrap().left_out, [0]);
        assert_eq!(table.outline.facets, Facets::default());
    }

    #[test]
    fn triangles_are_polygons_but_for_those_with_a_corner_twice() {
        let text = "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 0\n3 0 1 2\n3 0 3 1\n3 0 1 3\n";
        let mut table = read(text, Format::Off);
        assert_eq!(table.take_triangles_as_polygons().unwrap(), [1, 2]);
        let facets = &table.outline.facets;
        assert_eq!((facets.count(), facets.are_triangles), (1, false));
        assert_eq!(table.take_triangles_as_polygons().unwrap(), []);
        table.mesh(true).unwrap();
    }

    #[test]
    fn polygons_and_points_keep_their_numbers() {
        let mut table =
            read("OFF\n5 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 1e-13 0\n5 0 1 2 3 4\n", Format::Off);
        assert_eq!(table.merge_corners(1e-12).unwrap(), Merged { points: 1, ..Merged::default() });
        assert_eq!(table.outline.facets.inputs, [0, 1, 2, 3]);
        let mut table = read("0 0 0\n1e-14 0 0\n1 1 1\n", Format::Xyz);
        assert_eq!(table.merge_corners(1e-3).unwrap(), Merged::default());
        assert!(table.merge_corners(0.5).unwrap_err().message().starts_with("ratio is 0.5;"));
    }
}
