//! The filtration of a mesh by the distance to its inputs, after B. Hudson, G. L. Miller, S. Y.
//! Oudot and D. R. Sheehy, "Topological Inference via Meshing", 2010: what the balls of radius `r`
//! round the inputs cover is followed by Voronoi cells of the mesh, whose nerve its faces are.
//!
//! The cell of an input comes as far as it is in the input's own ball. That of another vertex comes
//! as a whole, when `r` is the geometric mean of bounds of the least and of the largest distance in
//! it. docs/topology.md proves that the factor between those bounds, of which the root is returned,
//! is that of the interleaving.

use super::alpha::{flat, radii};
use super::circumscribed::Radius;
use super::{Faces, Filtration, Level};
use crate::arrays::Part;
use crate::error::Result;
use crate::memory::filled;
use crate::mesh::{NONE, Triangulation, VertexKind, in_dimension};
use crate::numerics::distance as length;
use crate::query::{Among, Index};

/// The filtration of a mesh by the distance to its inputs. `index` is that of the mesh; `faces`
/// from dimension 0 or 1 on. `threads` as in the options.
///
/// # Errors
/// `InvalidArgument` (faces of another mesh; a flat simplex), `OutOfMemory`.
pub fn distances(
    mesh: &Triangulation,
    faces: &Faces,
    index: &Index,
    threads: u32,
) -> Result<Filtration> {
    let cells = Cells::new(mesh, index, threads)?;
    let is_input = |&vertex: &u32| mesh.kinds[vertex as usize] == VertexKind::Input;
    let has_input = |face: &[u32]| face.iter().any(is_input);
    let none = || Ok(None);
    let found = in_dimension!(
        mesh.dim,
        D => radii::<D>(mesh, faces, threads, Radius::Length, has_input),
        _ => none()
    )?;
    let mut values = found.ok_or_else(flat)?;
    for (k, values) in (faces.lowest()..).zip(&mut values) {
        cells.raise(faces.of_dimension(k), values, has_input);
    }
    Ok(Filtration { values, factor: cells.factor })
}

/// When the cells of the vertices come.
struct Cells {
    /// 0 for inputs.
    times: Vec<f64>,
    /// When all cells are there: the balls of this radius have a point in common.
    end: f64,
    factor: f64,
}

/// Circumradii are exact up to 1e-12.
const SLACK: f64 = 1e-11;

impl Cells {
    fn new(mesh: &Triangulation, index: &Index, threads: u32) -> Result<Self> {
        let count = mesh.vertex_count();
        let (mut nearest, mut distances) = (filled(count, NONE)?, filled(count, 0.0)?);
        let among = Among::Inputs;
        index.nearest(mesh, among, &mesh.points, threads, &mut nearest, &mut distances)?;
        let outer = outer_radii(mesh)?;
        let is_steiner = |vertex: usize| mesh.kinds[vertex] != VertexKind::Input;
        let has_end = (0..count).any(|vertex| is_steiner(vertex) && outer[vertex] == f64::INFINITY);
        let end = if has_end { radius_of_all(mesh) } else { f64::INFINITY };
        let mut cells = Self { times: distances, end, factor: 1.0 };
        for (vertex, &outer) in outer.iter().enumerate().filter(|&(vertex, _)| is_steiner(vertex)) {
            let distance = cells.times[vertex];
            // The vertex itself is no farther from a point of the cell than an input is.
            let least = (distance / 2.0).max(distance - outer) * (1.0 - SLACK);
            let most = (distance + outer) * (1.0 + SLACK);
            // Beyond the end the time of a cell does not matter, but it must not be missed before.
            let time = (least.sqrt() * most.sqrt()).min(end);
            let most = if time < end { most } else { 0.0 };
            cells.times[vertex] = time;
            cells.factor = cells.factor.max(time / least).max(most / time);
        }
        Ok(cells)
    }

    /// Raises the values of the faces of one dimension, the radii of those that have an input, to
    /// the times of their vertices.
    fn raise(&self, level: &Level, values: &mut [f64], has_input: impl Fn(&[u32]) -> bool) {
        for (at, value) in values.iter_mut().enumerate() {
            let face = level.face(at);
            let times = face.iter().map(|&vertex| self.times[vertex as usize]);
            let radius = if has_input(face) { *value } else { 0.0 };
            *value = times.fold(radius, f64::max).min(self.end);
        }
    }
}

/// For each vertex how far its Voronoi cell reaches: infinitely on the hull.
fn outer_radii(mesh: &Triangulation) -> Result<Vec<f64>> {
    let radii = Part::whole(mesh)?.circumcenters()?.radii;
    let mut outer = filled(mesh.vertex_count(), 0.0f64)?;
    for (simplex, &radius) in radii.iter().enumerate() {
        let (vertices, neighbors) = (mesh.simplex(simplex), mesh.neighbors_of(simplex));
        for (i, &vertex) in vertices.iter().enumerate() {
            let is_on_hull = (0..=mesh.dim).any(|j| j != i && neighbors[j] == NONE);
            let reach = if is_on_hull { f64::INFINITY } else { radius };
            outer[vertex as usize] = outer[vertex as usize].max(reach);
        }
    }
    Ok(outer)
}

/// A radius at which balls round the inputs have a point in common: the centre of their box.
fn radius_of_all(mesh: &Triangulation) -> f64 {
    in_dimension!(mesh.dim, D => half_diagonal::<D>(mesh), _ => f64::INFINITY)
}

fn half_diagonal<const D: usize>(mesh: &Triangulation) -> f64 {
    let (mut low, mut high) = ([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
    let inputs = mesh.kinds.iter().zip(mesh.points.chunks_exact(D));
    for (_, point) in inputs.filter(|(kind, _)| **kind == VertexKind::Input) {
        for axis in 0..D {
            low[axis] = low[axis].min(point[axis]);
            high[axis] = high[axis].max(point[axis]);
        }
    }
    let center = std::array::from_fn(|axis| 0.5 * low[axis] + 0.5 * high[axis]);
    // The centre is rounded: both ends, and a little more.
    length::<D>(&center, &low).max(length::<D>(&center, &high)) * (1.0 + SLACK)
}
