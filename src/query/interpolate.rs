//! Values given at the vertices, elsewhere.

use super::Index;
use super::barycentric::coordinates_in;
use super::locate::{Locator, Place, Scratch};
use super::natural::Natural;
use super::threads::{Work, on_threads};
use super::view::View;
use crate::error::{Error, Result, message};
use crate::memory::AllocResult;
use crate::mesh::Triangulation;
use crate::nearest::nearest_until;
use crate::numerics::coordinates;

/// Method by which values are interpolated between vertices. All three reproduce linear functions
/// and are continuous.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// Linear in each simplex.
    Linear = 0,
    /// Natural neighbours: the weights are the volumes that a vertex at the point would take from
    /// the cells of its neighbours (R. Sibson, "A vector identity for the Dirichlet tessellation",
    /// 1980). Linear on the hull, and next to it where rounding errors exceed 1e-6 of the weights.
    /// The work for a point grows with 2^dim.
    Sibson = 1,
    /// Natural neighbours: the weights are the areas of the facets that a vertex at the point would
    /// share with its neighbours, over the distances (N. H. Christ, R. Friedberg, T. D. Lee,
    /// "Weights of links and plaquettes in a random lattice", 1982). Linear where Sibson's is.
    Laplace = 2,
}

/// Values of points outside the hull.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outside {
    Nan,
    /// The values of the nearest vertex.
    Nearest,
}

/// Method of interpolation, inside the hull and outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Method {
    pub interpolation: Interpolation,
    pub outside: Outside,
}

/// Values of points: `points x components`.
#[derive(Clone, Copy, Debug)]
pub struct Values<'a> {
    pub components: usize,
    pub values: &'a [f64],
}

impl<'a> Values<'a> {
    /// Fails unless there are values for `count` things.
    pub(super) fn check(&self, name: &str, count: usize, things: &str) -> Result<()> {
        if count.checked_mul(self.components) == Some(self.values.len()) {
            return Ok(());
        }
        let message = message!(
            "{name} has length {}; it must be {things} x components = {count} x {}",
            self.values.len(),
            self.components
        );
        Err(Error::invalid(message))
    }

    pub(super) fn of(&self, at: u32) -> &'a [f64] {
        &self.values[at as usize * self.components..][..self.components]
    }

    /// Writes the sum of weighted values to `out`. A vertex without weight counts for nothing,
    /// whatever its value.
    fn combine(&self, weights: impl Iterator<Item = (u32, f64)> + Clone, out: &mut [f64]) {
        out.fill(0.0);
        for (vertex, weight) in weights.filter(|&(_, weight)| weight != 0.0) {
            for (sum, value) in out.iter_mut().zip(self.of(vertex)) {
                *sum += weight * value;
            }
        }
    }
}

/// Memory that a thread uses again.
#[derive(Default)]
struct Buffers {
    scratch: Scratch,
    natural: Natural,
}

pub(super) fn interpolate_in<const D: usize>(
    index: &Index,
    mesh: &Triangulation,
    method: Method,
    values: Values<'_>,
    points: &[f64],
    work: Work<'_>,
    out: &mut [f64],
) -> AllocResult<()> {
    let (threads, piece) = work.shares(points.len() / D);
    let pieces = points.chunks(piece * D).zip(out.chunks_mut(piece * values.components));
    on_threads(threads, pieces, |buffers: &mut Buffers, (points, out)| {
        let Buffers { scratch, natural } = buffers;
        let mut locator = Locator::new(View::<D> { mesh }, index, work.stop);
        locator.each(points, scratch, |locator, scratch, at, place| {
            let q = coordinates::<D>(points, at);
            let out = &mut out[at * values.components..][..values.components];
            if place == Place::OUTSIDE {
                match method.outside {
                    Outside::Nan => out.fill(f64::NAN),
                    Outside::Nearest => {
                        let (vertex, _) = nearest_until(work.stop, &index.all, q);
                        out.copy_from_slice(values.of(vertex));
                    }
                }
                return Ok(());
            }
            let view = locator.view;
            if method.interpolation != Interpolation::Linear
                && natural.weigh(
                    view,
                    method.interpolation,
                    place,
                    q,
                    &mut scratch.set,
                    work.stop,
                )?
            {
                values.combine(natural.weights(), out);
                return Ok(());
            }
            let vertices = view.simplex(place.simplex);
            let weights = coordinates_in(&view.points_of(vertices)[..=D], place.face, q);
            values.combine(vertices.iter().copied().zip(weights), out);
            Ok(())
        })
    })
}
