//! Corners of facets that are as good as one, made one.

use super::values::Table;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow, collected};
use crate::mesh::Facets;
use crate::nearest::merge_points;

/// Numbers of what [`Table::merge_corners`] has changed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Merged {
    /// Number of corners that were moved to an earlier one.
    pub points: usize,
    /// Number of triangles of which two corners became one. They are left out.
    pub triangles: usize,
}

impl Table {
    /// Moves corners of facets that are at most `ratio` times the diagonal of the box of all from
    /// an earlier one there, by [`merge_points`]. Triangles of which two corners become one are
    /// left out, and counted so. Other points stay where they are.
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
        let mut collapsed = self.triangles_with_equal_corners()?;
        collapsed.retain(|triangle| were_equal.binary_search(triangle).is_err());
        if !collapsed.is_empty() {
            self.outline.facets = without(&self.outline.facets, &collapsed)?;
            self.left_out.add(2, collapsed.len() as u64);
        }
        Ok(Merged { points, triangles: collapsed.len() })
    }

    /// Returns the triangles of a surface that have a point twice, ascending.
    fn triangles_with_equal_corners(&self) -> AllocResult<Vec<u32>> {
        let Facets { inputs, are_triangles, .. } = &self.outline.facets;
        let dim = self.points.dim;
        let mut found = Vec::new();
        let triangles = if *are_triangles { &inputs[..] } else { &[] };
        for (triangle, number) in triangles.chunks_exact(3).zip(0u32..) {
            let [a, b, c] = [0, 1, 2].map(|at| {
                let first = triangle[at] as usize * dim;
                &self.points.coordinates[first..first + dim]
            });
            if a == b || b == c || c == a {
                found.try_push(number)?;
            }
        }
        Ok(found)
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
        assert_eq!(table.merge_corners(1e-12).unwrap(), Merged { points: 1, triangles: 1 });
        // That which had a point twice before is for the run to judge.
        assert_eq!(table.outline.facets.inputs, [0, 1, 2, 3, 2, 4, 4, 4, 2]);
        assert_eq!((table.outline.facets.count(), table.left_out.faces), (3, 1));
        // A point that is no corner stays.
        assert_eq!(table.points.coordinates[9..12], [0.0; 3]);
        assert_eq!(table.points.coordinates[15], 9e-14);
        let mesh = table.mesh(true).unwrap();
        assert!(mesh.given_facets().are_triangles && mesh.inputs().duplicates() == 2);
    }

    #[test]
    fn polygons_and_points_keep_their_numbers() {
        let mut table =
            read("OFF\n5 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 1e-13 0\n5 0 1 2 3 4\n", Format::Off);
        assert_eq!(table.merge_corners(1e-12).unwrap(), Merged { points: 1, triangles: 0 });
        assert_eq!(table.outline.facets.inputs, [0, 1, 2, 3, 4]);
        let mut table = read("0 0 0\n1e-14 0 0\n1 1 1\n", Format::Xyz);
        assert_eq!(table.merge_corners(1e-3).unwrap(), Merged::default());
        assert!(table.merge_corners(0.5).unwrap_err().message().starts_with("ratio is 0.5;"));
    }
}
