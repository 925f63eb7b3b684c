//! Alpha values (H. Edelsbrunner, E. P. Mücke, "Three-dimensional alpha shapes", 1994): of a face
//! of a Delaunay triangulation the squared radius of its smallest circumscribing ball if no vertex
//! is strictly in that (the face is Gabriel), else the least value of the faces that have it as a
//! facet.
//!
//! No vertex is in the ball of a face if none is of those that make a face of one more dimension
//! with it, also where vertices are cospherical (docs/topology.md). The vertex of such a face is in
//! the ball just if the centre of that face's own ball has a negative barycentric coordinate
//! there: so the balls of the faces tell which of their facets are Gabriel.

use super::circumscribed::{Ball, ball};
use super::radius::Radius;
use super::{Faces, Level};
use crate::error::{Error, Result};
use crate::memory::{AllocResult, TryGrow, filled};
use crate::mesh::{Inputs, Triangulation, VertexKind, in_dimension};
use crate::query::threads::{on_threads, threads as threads_of};
use crate::query::view::View;
use std::sync::atomic::{AtomicBool, Ordering};

/// Numbering of the vertices of a filtration's faces for those who read it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Numbers {
    /// Numbers of the caller's points, of equal ones the first: all vertices are inputs.
    Inputs,
    /// Numbers of the vertices of the mesh, of which some are no inputs.
    Vertices,
}

/// Values of faces, and what they say of the inputs.
#[derive(Clone, Debug, PartialEq)]
pub struct Filtration {
    /// Values of the faces, by dimension from the lowest of the faces on. A face has no less than
    /// its facets.
    pub values: Vec<Vec<f64>>,
    /// The persistence module of the values, as lengths, is interleaved by this factor, at least 1,
    /// with that of the balls round the inputs: a feature `[birth, death)` of either with
    /// `death / birth > factor^2` has its own in the other, birth and death within the factor.
    /// Infinite where nothing can be said.
    pub factor: f64,
    /// Numbering of the vertices. [`Faces`] have the numbers of the mesh in any case.
    pub numbers: Numbers,
}

impl Filtration {
    /// Returns the number of each vertex; `None` where it is that of the vertex itself.
    pub fn vertex_numbers<'a>(&self, inputs: &'a Inputs) -> Option<&'a [u32]> {
        let differs = self.numbers == Numbers::Inputs && inputs.duplicates() > 0;
        differs.then(|| inputs.first_inputs())
    }
}

/// Computes the alpha values of the faces: squared radii, each the double nearest to the exact one.
/// Vertices have 0. Infinite beyond the doubles.
///
/// O(faces x dim^3); nearly flat faces take longer. `threads` is the number of threads, 0 for all
/// cores; no value depends on them.
///
/// # Errors
/// `InvalidArgument` (a vertex that is no input; faces of another mesh; a flat simplex),
/// `OutOfMemory`.
pub fn alpha(mesh: &Triangulation, faces: &Faces, threads: u32) -> Result<Filtration> {
    refuse_cropped(mesh)?;
    if !has_inputs_alone(mesh) {
        let rule = "alpha values are those of a Delaunay triangulation of the inputs alone, and \
            the mesh has other vertices";
        return Err(Error::invalid(rule));
    }
    let none = || Ok(None);
    let found = in_dimension!(
        mesh.dim,
        D => radii::<D>(mesh, faces, threads, Radius::Square, |_| true),
        _ => none()
    )?;
    Ok(Filtration { values: found.ok_or_else(flat)?, factor: 1.0, numbers: Numbers::Inputs })
}

/// Refuses a mesh that is cropped to its domain: what is outside counts for the values.
pub(super) fn refuse_cropped(mesh: &Triangulation) -> Result<()> {
    match mesh.boundary.whole {
        None => Ok(()),
        Some(_) => {
            let rule = "a filtration needs all of the Delaunay triangulation, and the mesh is cut \
                to its domain; run it with extent all, without holes";
            Err(Error::invalid(rule))
        }
    }
}

/// Returns true if the mesh has alpha values: those are of a Delaunay triangulation of the inputs.
pub fn has_inputs_alone(mesh: &Triangulation) -> bool {
    mesh.kinds.iter().all(|&kind| kind == VertexKind::Input)
}

/// Returns the error of a mesh with a flat simplex, which no valid mesh has.
pub(super) fn flat() -> Error {
    Error::invalid("the mesh has a flat simplex")
}

/// Computes radii, squared or not, for the faces that `needs_radius` picks by their vertices; the
/// values of others are unspecified. A face that has a wanted one as a facet must be wanted. `None`
/// if one is flat.
pub(super) fn radii<const D: usize>(
    mesh: &Triangulation,
    faces: &Faces,
    threads: u32,
    wanted: Radius,
    needs_radius: impl Fn(&[u32]) -> bool + Sync,
) -> AllocResult<Option<Vec<Vec<f64>>>> {
    let mut values = Vec::new();
    for k in faces.lowest()..=D {
        values.push(filled(faces.of_dimension(k).count(), if k == 0 { 0.0 } else { f64::NAN })?);
    }
    let (view, mut negative) = (View::<D> { mesh }, Vec::new());
    for k in (faces.lowest().max(1)..=D).rev() {
        let level = faces.of_dimension(k);
        let (below, here) = values.split_at_mut(k - faces.lowest());
        negative.clear();
        negative.cover(level.count(), 0)?;
        let balls = Balls { view, level, k, wanted, needs_radius: &needs_radius };
        if !balls.find(threads, &mut here[0], &mut negative)? {
            return Ok(None);
        }
        if let Some(below) = below.last_mut().filter(|_| k > 1) {
            lower_facets(level, &here[0], &negative, below);
        }
    }
    Ok(Some(values))
}

/// The balls of the faces of dimension `k`.
struct Balls<'a, W, const D: usize> {
    view: View<'a, D>,
    level: &'a Level,
    k: usize,
    wanted: Radius,
    needs_radius: W,
}

/// Number of faces that make a piece of work.
const PIECE: usize = 1 << 12;

impl<W: Fn(&[u32]) -> bool + Sync, const D: usize> Balls<'_, W, D> {
    /// Writes the values that are not there yet, and which coordinates of the centres are negative.
    /// False if a face is flat.
    fn find(&self, threads: u32, values: &mut [f64], negative: &mut [u16]) -> AllocResult<bool> {
        let is_flat = AtomicBool::new(false);
        let pieces = values.chunks_mut(PIECE).zip(negative.chunks_mut(PIECE)).enumerate();
        on_threads(threads_of(threads), pieces, |(), (piece, (values, negative))| {
            for (at, (value, negative)) in values.iter_mut().zip(negative).enumerate() {
                let face = self.level.face(piece * PIECE + at);
                if !(self.needs_radius)(face) {
                    continue;
                }
                let radius = if value.is_nan() { self.wanted } else { Radius::Nothing };
                let Some(ball) = ball_of(self.k, &self.view.points_of(face), radius)? else {
                    is_flat.store(true, Ordering::Relaxed);
                    return Ok(());
                };
                *negative = ball.negative;
                if value.is_nan() {
                    *value = ball.radius;
                }
            }
            Ok(())
        })?;
        Ok(!is_flat.load(Ordering::Relaxed))
    }
}

/// Gives the facets that are not Gabriel the least value of the faces that tell so: the least of
/// all that have them as facets is among these.
fn lower_facets(level: &Level, values: &[f64], negative: &[u16], below: &mut [f64]) {
    for (at, (&value, &negative)) in values.iter().zip(negative).enumerate() {
        for (i, &facet) in level.facets(at).iter().enumerate() {
            if negative >> i & 1 == 1 {
                let facet = &mut below[facet as usize];
                // NaN gives way.
                *facet = value.min(*facet);
            }
        }
    }
}

/// Returns the result of `ball` with the dimension of the face as a constant.
fn ball_of<const D: usize>(
    k: usize,
    points: &[&[f64; D]],
    wanted: Radius,
) -> AllocResult<Option<Ball>> {
    match k {
        1 => ball::<1, D>(points, wanted),
        2 => ball::<2, D>(points, wanted),
        3 => ball::<3, D>(points, wanted),
        4 => ball::<4, D>(points, wanted),
        5 => ball::<5, D>(points, wanted),
        6 => ball::<6, D>(points, wanted),
        7 => ball::<7, D>(points, wanted),
        _ => ball::<8, D>(points, wanted),
    }
}
