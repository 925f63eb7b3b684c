//! Facets while a file is read.

use super::values::Outline;
use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::TryGrow;
use crate::mesh::Facets;

/// Facets that have been read of a file so far.
#[derive(Default)]
pub(super) struct Polygons {
    facets: Facets,
    /// Number of facets that are one loop of three points.
    triangles: usize,
}

impl Polygons {
    /// Adds a facet: its loops, each a list of points, and its marker.
    pub fn add<'l>(
        &mut self,
        loops: impl IntoIterator<Item = &'l [u32]>,
        marker: i32,
    ) -> Result<()> {
        let Facets { loop_starts, input_starts, inputs, markers, .. } = &mut self.facets;
        if markers.is_empty() {
            loop_starts.try_push(0)?;
            input_starts.try_push(0)?;
        }
        let first = inputs.len();
        for corners in loops {
            for corner in corners {
                inputs.try_push(*corner)?;
            }
            input_starts.try_push(number(inputs.len())?)?;
        }
        loop_starts.try_push(number(input_starts.len() - 1)?)?;
        markers.try_push(marker)?;
        let loops = loop_starts.windows(2).last().map_or(0, |range| range[1] - range[0]);
        self.triangles += usize::from(loops == 1 && inputs.len() - first == 3);
        Ok(())
    }

    /// Adds a face of a surface, whose points may be any number: three or more are a facet, two a
    /// segment, and one says nothing that the list of points does not.
    pub fn add_face(&mut self, corners: &[u32], marker: i32, outline: &mut Outline) -> Result<()> {
        match *corners {
            [] | [_] => Ok(()),
            [from, to] => {
                outline.segments.try_push([from, to])?;
                Ok(outline.markers.try_push(marker)?)
            }
            _ => self.add([corners], marker),
        }
    }

    /// Returns the facets of a file that has no surface of its own.
    pub fn finish(self) -> Facets {
        self.facets
    }

    /// Returns the faces of a surface: its triangles, if it has no other polygons.
    pub fn surface(self) -> Facets {
        let Self { facets, triangles } = self;
        let are_triangles = triangles > 0 && triangles == facets.count();
        Facets { are_triangles, ..facets }
    }
}

/// Returns a number of loops or of points in loops, as 32-bit ids count them.
fn number(count: usize) -> Result<u32> {
    u32::try_from(count).map_err(|_| {
        let message = message!("{count} points in the polygons; at most {} are read", u32::MAX);
        Error::new(ErrorKind::Capacity, message)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_are_triangles_only_if_all_have_three_points() {
        let read = |faces: &[&[u32]]| {
            let (mut polygons, mut outline) = (Polygons::default(), Outline::default());
            faces.iter().for_each(|face| polygons.add_face(face, 0, &mut outline).unwrap());
            (polygons.surface(), outline)
        };
        let (facets, outline) = read(&[&[0, 1, 2], &[3], &[], &[4, 5], &[2, 1, 3]]);
        assert!(facets.are_triangles);
        assert_eq!(facets.inputs, [0, 1, 2, 2, 1, 3]);
        assert_eq!((facets.loop_starts, facets.input_starts), (vec![0, 1, 2], vec![0, 3, 6]));
        assert_eq!((outline.segments, outline.markers), (vec![[4, 5]], vec![0]));
        let (facets, _) = read(&[&[0, 1, 2], &[0, 1, 2, 3]]);
        assert!(!facets.are_triangles && facets.count() == 2);
        assert_eq!(read(&[&[0, 1]]).0, Facets::default());
    }
}
