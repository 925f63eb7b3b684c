//! The questions that an index answers.

use super::index::no_dimension;
use super::interpolate::{Interpolation, Method, Values, interpolate_in};
use super::locate::{Locator, Place, Scratch};
use super::threads::{Work, on_threads};
use super::view::View;
use super::{Among, Index};
use crate::error::{Error, Name, Result, message, say};
use crate::memory::AllocResult;
use crate::mesh::{Triangulation, check_finite, in_dimension};
use crate::nearest::{Tree, nearest_until, sort_by_leaf};
use crate::numerics::coordinates;

impl Index {
    /// Writes for each of the points (`count x dim`) the simplex that holds it, [`NONE`] outside.
    /// On a face that several share it is the least of them. `work`: a number of threads as in the
    /// options, 0 for all cores, or a [`Work`].
    ///
    /// # Errors
    /// `InvalidArgument` (a length; a mesh other than that of the index), `NonFinite` (names point
    /// and coordinate), `Cancelled` (by what stops the work), `OutOfMemory`. What `simplices`
    /// holds then is unspecified.
    pub fn locate<'a>(
        &self,
        mesh: &Triangulation,
        points: &[f64],
        work: impl Into<Work<'a>>,
        simplices: &mut [u32],
    ) -> Result<()> {
        self.locate_each(mesh, points, work.into(), simplices, "simplices")
    }

    /// Locates points as [`Index::locate`] does, and tells the face of the simplex that was hit.
    ///
    /// # Errors
    /// Fails as [`Index::locate`] does.
    pub fn places<'a>(
        &self,
        mesh: &Triangulation,
        points: &[f64],
        work: impl Into<Work<'a>>,
        places: &mut [Place],
    ) -> Result<()> {
        self.locate_each(mesh, points, work.into(), places, "places")
    }

    /// Writes what is wanted of the place of each of the points to the array `name`.
    fn locate_each(
        &self,
        mesh: &Triangulation,
        points: &[f64],
        work: Work<'_>,
        out: &mut [impl From<Place> + Send],
        name: &str,
    ) -> Result<()> {
        self.check(mesh, points, out.len(), name)?;
        let found = in_dimension!(
            self.dim,
            D => locate_in::<D>(self, mesh, points, work, out),
            _ => return no_dimension()
        );
        found?;
        work.check()
    }

    /// Writes for each of the points the nearest vertex and its distance: the least of those at the
    /// same exact distance. Distances are rounded, with a relative error of at most dim + 4 units
    /// of 2^-53, and infinite only beyond the doubles.
    ///
    /// # Errors
    /// Fails as [`Index::locate`] does.
    pub fn nearest<'a>(
        &self,
        mesh: &Triangulation,
        among: Among,
        points: &[f64],
        work: impl Into<Work<'a>>,
        vertices: &mut [u32],
        distances: &mut [f64],
    ) -> Result<()> {
        self.check(mesh, points, vertices.len(), "vertices")?;
        self.check(mesh, points, distances.len(), "distances")?;
        let (tree, work) = (self.tree(among), work.into());
        let found = in_dimension!(
            self.dim,
            D => nearest_in::<D>(tree, points, work, vertices, distances),
            _ => return no_dimension()
        );
        found?;
        work.check()
    }

    /// Writes for each of the points (`count x dim`) the values there (`count x components`).
    ///
    /// # Errors
    /// Fails as [`Index::locate`] does; `InvalidArgument` if `values` is not `vertices x
    /// components`.
    pub fn interpolate<'a>(
        &self,
        mesh: &Triangulation,
        method: Method,
        values: Values<'_>,
        points: &[f64],
        work: impl Into<Work<'a>>,
        out: &mut [f64],
    ) -> Result<()> {
        if mesh.boundary.whole.is_some() && method.interpolation != Interpolation::Linear {
            let message = say!(
                Name::Interpolation,
                " is by natural neighbours, which a mesh that is cut to its domain lacks; it must \
                 be linear"
            );
            return Err(Error::invalid(message));
        }
        values.check("values", self.vertices, "vertices")?;
        let rule = "components is 0; it must be at least 1";
        let count = out.len().checked_div(values.components);
        let count = count.ok_or_else(|| Error::invalid(rule))?;
        if count * values.components != out.len() {
            let message = message!(
                "out has length {}; it must be points x components, components = {}",
                out.len(),
                values.components
            );
            return Err(Error::invalid(message));
        }
        self.check(mesh, points, count, "out")?;
        let work = work.into();
        let made = in_dimension!(
            self.dim,
            D => interpolate_in::<D>(self, mesh, method, values, points, work, out),
            _ => return no_dimension()
        );
        made?;
        work.check()
    }

    /// Checks the mesh and the points, for which there are `count` results in the array `name`.
    pub(super) fn check(
        &self,
        mesh: &Triangulation,
        points: &[f64],
        count: usize,
        name: &str,
    ) -> Result<()> {
        let is_same = mesh.dim == self.dim
            && mesh.simplices.len() == self.simplices * (self.dim + 1)
            && mesh.neighbors.len() == mesh.simplices.len()
            && mesh.vertex_count() == self.vertices
            && mesh.points.len() == self.vertices * self.dim;
        if !is_same {
            let rule = "the index was made for another mesh";
            return Err(Error::invalid(rule));
        }
        let dim = self.dim;
        if points.len() != count.saturating_mul(dim) {
            let message = message!(
                "points has length {}; it must be points x dim = {count} x {dim}, as {name} has \
                 {count} results",
                points.len()
            );
            return Err(Error::invalid(message));
        }
        check_finite(dim, points)
    }
}

fn locate_in<const D: usize>(
    index: &Index,
    mesh: &Triangulation,
    points: &[f64],
    work: Work<'_>,
    out: &mut [impl From<Place> + Send],
) -> AllocResult<()> {
    let (threads, piece) = work.shares(out.len());
    let pieces = points.chunks(piece * D).zip(out.chunks_mut(piece));
    on_threads(threads, pieces, |scratch: &mut Scratch, (points, out)| {
        let mut locator = Locator::new(View::<D> { mesh }, index, work.stop);
        locator.each(points, scratch, |_, _, at, place| {
            out[at] = place.into();
            Ok(())
        })
    })
}

pub(super) fn nearest_in<const D: usize>(
    tree: &Tree,
    points: &[f64],
    work: Work<'_>,
    vertices: &mut [u32],
    distances: &mut [f64],
) -> AllocResult<()> {
    let (threads, piece) = work.shares(vertices.len());
    let out = vertices.chunks_mut(piece).zip(distances.chunks_mut(piece));
    let pieces = points.chunks(piece * D).zip(out);
    on_threads(threads, pieces, |keys: &mut Vec<u64>, (points, (vertices, distances))| {
        // As in `Locator::each`.
        if work.stop.is_set() {
            return Ok(());
        }
        sort_by_leaf::<D>(tree, points, keys)?;
        for key in keys.iter().take_while(|_| !work.stop.is_set()) {
            let (at, stop) = (*key as u32 as usize, work.stop);
            let q = coordinates::<D>(points, at);
            (vertices[at], distances[at]) = nearest_until(stop, tree, q);
        }
        Ok(())
    })
}
