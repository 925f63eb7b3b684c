//! Barycentric coordinates of points in the simplices that hold them.

use super::Index;
use super::barycentric::coordinates_in;
use super::index::no_dimension;
use super::locate::{Locator, Place, Scratch};
use super::threads::{Work, on_threads};
use super::view::View;
use crate::error::{Error, Result, message};
use crate::memory::AllocResult;
use crate::mesh::{Triangulation, in_dimension};
use crate::numerics::coordinates;

impl Index {
    /// Writes for each of the points (`count x dim`) the simplex that [`Index::locate`] finds, and
    /// the barycentric coordinates in it (`count x (dim + 1)`), NaN outside. Vertices that the
    /// point does not lie between have weight zero, exactly.
    ///
    /// # Errors
    /// Fails as [`Index::locate`] does.
    pub fn weigh<'a>(
        &self,
        mesh: &Triangulation,
        points: &[f64],
        work: impl Into<Work<'a>>,
        simplices: &mut [u32],
        weights: &mut [f64],
    ) -> Result<()> {
        self.check(mesh, points, simplices.len(), "simplices")?;
        check_weights(self.dim, simplices.len(), weights)?;
        let work = work.into();
        let found = in_dimension!(
            self.dim,
            D => weigh_in::<D>(self, mesh, points, work, simplices, weights),
            _ => return no_dimension()
        );
        found?;
        work.check()
    }
}

/// Fails unless there is room for the weights of `count` points.
pub(super) fn check_weights(dim: usize, count: usize, weights: &[f64]) -> Result<()> {
    if weights.len() == count * (dim + 1) {
        return Ok(());
    }
    Err(Error::invalid(message!(
        "weights has length {}; it must be points x (dim + 1) = {count} x {}",
        weights.len(),
        dim + 1
    )))
}

fn weigh_in<const D: usize>(
    index: &Index,
    mesh: &Triangulation,
    points: &[f64],
    work: Work<'_>,
    simplices: &mut [u32],
    weights: &mut [f64],
) -> AllocResult<()> {
    let (threads, piece) = work.shares(simplices.len());
    let out = simplices.chunks_mut(piece).zip(weights.chunks_mut(piece * (D + 1)));
    let pieces = points.chunks(piece * D).zip(out);
    on_threads(threads, pieces, |scratch: &mut Scratch, (points, (simplices, weights))| {
        let mut locator = Locator::new(View::<D> { mesh }, index, work.stop);
        locator.each(points, scratch, |locator, _, at, place| {
            simplices[at] = place.simplex;
            let out = &mut weights[at * (D + 1)..][..D + 1];
            if place == Place::OUTSIDE {
                out.fill(f64::NAN);
                return Ok(());
            }
            let (view, q) = (locator.view, coordinates::<D>(points, at));
            let vertices = &view.points_of(view.simplex(place.simplex))[..=D];
            out.copy_from_slice(&coordinates_in(vertices, place.face, q)[..=D]);
            Ok(())
        })
    })
}
