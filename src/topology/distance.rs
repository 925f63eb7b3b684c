//! The filtration of a mesh by the distance to its inputs, after B. Hudson, G. L. Miller, S. Y.
//! Oudot and D. R. Sheehy, "Topological Inference via Meshing", 2010: what the balls of radius `r`
//! round the inputs cover is followed by Voronoi cells of the mesh, whose nerve its faces are.
//!
//! A cell in which the same input is the nearest everywhere comes as far as it is in that input's
//! ball: the cells of inputs, and others in their group. Any other cell comes as a whole, when `r`
//! is the geometric mean of bounds of the least and of the largest distance in it. docs/topology.md
//! proves that the factor between those bounds, of which the root is returned, is that of the
//! interleaving.

use super::alpha::{flat, radii, refuse_cropped};
use super::radius::Radius;
use super::reach::{fill_reaches, is_sound};
use super::{Faces, Filtration, Level, Numbers};
use crate::arrays::{Circumcenters, Part};
use crate::error::Result;
use crate::memory::{collected, filled};
use crate::mesh::{NONE, Triangulation, VertexKind, in_dimension};
use crate::numerics::{coordinates, distance as length};
use crate::query::view::View;
use crate::query::{Among, Index};

/// Computes the filtration of a mesh by the distance to its inputs. `index` is that of the mesh;
/// `faces` are from dimension 0 or 1 on. `threads` is the number of threads, 0 for all cores.
///
/// # Errors
/// `InvalidArgument` (faces of another mesh; a flat simplex), `OutOfMemory`.
pub fn distances(
    mesh: &Triangulation,
    faces: &Faces,
    index: &Index,
    threads: u32,
) -> Result<Filtration> {
    refuse_cropped(mesh)?;
    let cells = CellRadii::new(mesh, index, threads)?;
    let none = || Ok(None);
    let found = in_dimension!(
        mesh.dim,
        D => reaches::<D>(mesh, faces, &cells, threads),
        _ => none()
    )?;
    let mut values = found.ok_or_else(flat)?;
    for (k, values) in (faces.lowest()..).zip(&mut values) {
        cells.raise(faces.of_dimension(k), values);
    }
    Ok(Filtration { values, factor: cells.factor, numbers: Numbers::Vertices })
}

/// Computes how near the Voronoi faces come to the inputs, for the faces that have a vertex in a
/// group.
fn reaches<const D: usize>(
    mesh: &Triangulation,
    faces: &Faces,
    cells: &CellRadii,
    threads: u32,
) -> Result<Option<Vec<Vec<f64>>>> {
    let has_input = |face: &[u32]| face.iter().any(|&vertex| cells.is_input(vertex));
    let mut values = radii::<D>(mesh, faces, threads, Radius::Length, has_input)?;
    if let Some(values) = &mut values {
        fill_reaches::<D>(mesh, faces, &cells.group, values)?;
    }
    Ok(values)
}

/// Radii at which the cells of the vertices come into the filtration.
pub(super) struct CellRadii {
    /// The nearest input of those cells that have the same one everywhere, inputs their own; these
    /// come as far as they are in its ball. [`NONE`] for the others, which come as a whole.
    pub group: Vec<u32>,
    /// Radii at which cells outside of groups come. 0 for those in a group.
    times: Vec<f64>,
    /// Radius at which all cells are there: the balls of this radius have a point in common.
    end: f64,
    factor: f64,
}

/// Circumradii are exact up to 1e-12.
const SLACK: f64 = 1e-11;

/// The relative error that reaches may have ([`is_sound`]).
const REACH_ERROR: f64 = 1e-6;

impl CellRadii {
    pub fn new(mesh: &Triangulation, index: &Index, threads: u32) -> Result<Self> {
        let count = mesh.vertex_count();
        let (mut nearest, mut distances) = (filled(count, NONE)?, filled(count, 0.0)?);
        let among = Among::Inputs;
        index.nearest(mesh, among, &mesh.points, threads, &mut nearest, &mut distances)?;
        let corners = Part::whole(mesh)?.circumcenters()?;
        let outer = outer_radii(mesh, &corners.radii)?;
        let mut group = filled(count, NONE)?;
        let is_input = |vertex: usize| mesh.kinds[vertex] == VertexKind::Input;
        (0..count).filter(|&v| is_input(v) || outer[v] < f64::INFINITY).for_each(|v| {
            group[v] = nearest[v];
        });
        let others = (0..count).any(|v| !is_input(v) && group[v] != NONE);
        if others {
            in_dimension!(
                mesh.dim,
                D => leave_groups::<D>(mesh, index, &corners, threads, &mut group)?,
                _ => ()
            );
        }
        let has_end = (0..count).any(|vertex| !is_input(vertex) && outer[vertex] == f64::INFINITY);
        let end = if has_end { radius_of_all(mesh) } else { f64::INFINITY };
        let in_groups = (0..count).any(|v| !is_input(v) && group[v] != NONE);
        let factor = if in_groups { 1.0 + REACH_ERROR } else { 1.0 };
        let mut cells = Self { group, times: filled(count, 0.0)?, end, factor };
        for vertex in (0..count).filter(|&vertex| cells.group[vertex] == NONE).collect::<Vec<_>>() {
            cells.set_time(vertex, distances[vertex], outer[vertex]);
        }
        Ok(cells)
    }

    /// Sets when a cell comes as a whole, by its vertex's distance from the nearest input and by
    /// how far the cell reaches.
    fn set_time(&mut self, vertex: usize, distance: f64, outer: f64) {
        // The vertex itself is no farther from a point of the cell than an input is.
        let least = (distance / 2.0).max(distance - outer) * (1.0 - SLACK);
        let most = (distance + outer) * (1.0 + SLACK);
        // Beyond the end the time of a cell does not matter, but it must not be missed before.
        let time = (least.sqrt() * most.sqrt()).min(self.end);
        let most = if time < self.end { most } else { 0.0 };
        self.times[vertex] = time;
        self.factor = self.factor.max(time / least).max(most / time);
    }

    fn is_input(&self, vertex: u32) -> bool {
        self.group[vertex as usize] == vertex
    }

    /// Raises the values of the faces of one dimension, the reaches of those with a vertex in a
    /// group, to the times of their vertices.
    fn raise(&self, level: &Level, values: &mut [f64]) {
        for (at, value) in values.iter_mut().enumerate() {
            let face = level.face(at);
            let times = face.iter().map(|&vertex| self.times[vertex as usize]);
            let in_group = face.iter().any(|&vertex| self.group[vertex as usize] != NONE);
            let reach = if in_group { *value } else { 0.0 };
            *value = times.fold(reach, f64::max).min(self.end);
        }
    }
}

/// Removes from the groups the vertices that are no inputs and have a corner nearer to another
/// input, or a simplex that is not sound.
fn leave_groups<const D: usize>(
    mesh: &Triangulation,
    index: &Index,
    corners: &Circumcenters,
    threads: u32,
    group: &mut [u32],
) -> Result<()> {
    let view = View::<D> { mesh };
    let is_input = |&vertex: &u32| mesh.kinds[vertex as usize] == VertexKind::Input;
    let has_group = |&vertex: &u32| group[vertex as usize] != NONE && !is_input(&vertex);
    let simplices = 0..mesh.simplex_count() as u32;
    let asked = collected(simplices.filter(|&s| view.simplex(s).iter().any(has_group)))?;
    let corner = |simplex: u32| coordinates::<D>(&corners.centers, simplex as usize);
    let is_finite = |simplex: u32| corner(simplex).iter().all(|x| x.is_finite());
    let points = collected(asked.iter().flat_map(|&s| match is_finite(s) {
        true => *corner(s),
        false => [0.0; D],
    }))?;
    let (mut nearest, mut distances) = (filled(asked.len(), NONE)?, filled(asked.len(), 0.0)?);
    index.nearest(mesh, Among::Inputs, &points, threads, &mut nearest, &mut distances)?;
    for (&simplex, &distance) in asked.iter().zip(&distances) {
        let is_usable = is_finite(simplex) && is_sound(view, simplex);
        for vertex in view.simplex(simplex).iter().filter(|vertex| !is_input(vertex)) {
            let own = group[*vertex as usize];
            if own != NONE
                && !(is_usable
                    && length(corner(simplex), view.point(own)) <= distance * (1.0 + SLACK))
            {
                group[*vertex as usize] = NONE;
            }
        }
    }
    Ok(())
}

/// Returns for each vertex how far its Voronoi cell reaches: infinitely on the hull.
fn outer_radii(mesh: &Triangulation, radii: &[f64]) -> Result<Vec<f64>> {
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

/// Returns a radius at which balls round the inputs have a point in common: the centre of their
/// box, or the input nearest to it, about which the root of a mesh is.
fn radius_of_all(mesh: &Triangulation) -> f64 {
    in_dimension!(mesh.dim, D => least_radius::<D>(mesh), _ => f64::INFINITY)
}

fn least_radius<const D: usize>(mesh: &Triangulation) -> f64 {
    let view = View::<D> { mesh };
    let is_input = |&vertex: &u32| mesh.kinds[vertex as usize] == VertexKind::Input;
    let inputs = || (0..mesh.vertex_count() as u32).filter(is_input).map(|v| view.point(v));
    let (mut low, mut high) = ([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
    for point in inputs() {
        for axis in 0..D {
            low[axis] = low[axis].min(point[axis]);
            high[axis] = high[axis].max(point[axis]);
        }
    }
    let middle = std::array::from_fn(|axis| 0.5 * low[axis] + 0.5 * high[axis]);
    let radius = |center| inputs().map(|point| length::<D>(center, point)).fold(0.0, f64::max);
    let from_middle = |point: &&[f64; D]| length::<D>(&middle, point);
    let nearest = inputs().min_by(|a, b| from_middle(a).total_cmp(&from_middle(b)));
    radius(&middle).min(nearest.map_or(f64::INFINITY, radius)) * (1.0 + SLACK)
}
