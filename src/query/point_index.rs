//! The nearest of some points, without a mesh of them.

use super::index::no_dimension;
use super::questions::nearest_in;
use super::threads::Work;
use crate::error::{Error, ErrorKind, Result, message};
use crate::mesh::{MAX_DIM, MIN_DIM, NONE, check_finite, in_dimension};
use crate::nearest::Tree;

/// Search structure of points, for the nearest of them. It takes 8 `dim` + 7 bytes a point.
pub struct PointIndex {
    dim: usize,
    tree: Tree,
}

impl PointIndex {
    /// Builds the index of points (`count x dim`), of which several may be equal. O(count log
    /// count).
    ///
    /// # Errors
    /// `Dimension` (below 2 or above 8), `InvalidArgument` (a length, or no points), `NonFinite`
    /// (names point and coordinate), `Capacity` (more points than ids), `OutOfMemory`.
    pub fn new(dim: usize, points: &[f64]) -> Result<Self> {
        if !(MIN_DIM..=MAX_DIM).contains(&dim) {
            let message = message!("points have {dim} coordinates; they must have 2 to 8");
            return Err(Error::new(ErrorKind::Dimension, message));
        }
        if points.is_empty() || points.len() % dim != 0 {
            let length = points.len();
            let message = message!("points has length {length}; it must be points x {dim}, not 0");
            return Err(Error::invalid(message));
        }
        if points.len() / dim >= NONE as usize {
            let message = message!("there are {} points, more than ids", points.len() / dim);
            return Err(Error::new(ErrorKind::Capacity, message));
        }
        check_finite(dim, points)?;
        let tree = in_dimension!(dim, D => Tree::of_all::<D>(points)?, _ => return no_dimension());
        Ok(Self { dim, tree })
    }

    /// Writes for each of the points (`count x dim`) the nearest one of the index and its distance,
    /// as [`Index::nearest`](super::Index::nearest) does for vertices. Of equal points it is the
    /// first.
    ///
    /// # Errors
    /// `InvalidArgument` (a length), `NonFinite` (names point and coordinate), `Cancelled` (by what
    /// stops the work), `OutOfMemory`.
    pub fn nearest<'a>(
        &self,
        points: &[f64],
        work: impl Into<Work<'a>>,
        ids: &mut [u32],
        distances: &mut [f64],
    ) -> Result<()> {
        let (work, count, dim) = (work.into(), ids.len(), self.dim);
        if points.len() != count * dim || distances.len() != count {
            let (length, others) = (points.len(), distances.len());
            return Err(Error::invalid(message!(
                "points and distances have lengths {length} and {others}; they must be {count} x \
                 {dim} and {count}"
            )));
        }
        check_finite(dim, points)?;
        let found = in_dimension!(
            dim,
            D => nearest_in::<D>(&self.tree, points, work, ids, distances),
            _ => return no_dimension()
        );
        found?;
        work.check()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::distance;
    use crate::numerics::testing::{FAMILIES, Random, points};

    #[test]
    fn the_nearest_is_the_first_of_the_nearest_by_a_look_at_all() {
        for family in FAMILIES {
            let mut given = points::<3>(family, 90, &mut Random(family as u64 + 1));
            // Some are there twice.
            given.extend_from_within(10..20);
            let index = PointIndex::new(3, given.as_flattened()).unwrap();
            let queries = &given[..40];
            let (mut ids, mut distances) = (vec![0; 40], vec![0.0; 40]);
            let middle: Vec<_> = queries.iter().map(|q| q.map(|x| 0.75 * x)).collect();
            index.nearest(middle.as_flattened(), 1, &mut ids, &mut distances).unwrap();
            for (q, (id, length)) in middle.iter().zip(ids.iter().zip(&distances)) {
                let least = given.iter().map(|x| distance(x, q)).fold(f64::INFINITY, f64::min);
                assert_eq!(*length, distance(&given[*id as usize], q));
                assert!(*length <= least * (1.0 + 1e-15), "{family:?} {length} {least}");
                assert!(given.iter().position(|x| *x == given[*id as usize]) == Some(*id as usize));
            }
        }
    }

    #[test]
    fn what_is_wrong_is_refused() {
        let refusal = |dim, points: &[f64]| {
            let made = PointIndex::new(dim, points);
            made.map(|_| ()).unwrap_err().message().to_owned()
        };
        assert_eq!(refusal(1, &[0.0]), "points have 1 coordinates; they must have 2 to 8");
        assert_eq!(refusal(2, &[]), "points has length 0; it must be points x 2, not 0");
        assert_eq!(refusal(2, &[1.0; 3]), "points has length 3; it must be points x 2, not 0");
        let rule = "points[1] has a non-finite coordinate 1: inf; every coordinate must be finite";
        assert_eq!(refusal(2, &[0.0, 0.0, 1.0, f64::INFINITY]), rule);
        let index = PointIndex::new(2, &[0.0, 0.0]).unwrap();
        let asked = index.nearest(&[0.0; 4], 1, &mut [0], &mut [0.0]);
        assert!(asked.unwrap_err().message().starts_with("points and distances have lengths 4"));
        let asked = index.nearest(&[f64::NAN, 0.0], 1, &mut [0], &mut [0.0]);
        assert_eq!(asked.unwrap_err().kind(), ErrorKind::NonFinite);
    }
}
