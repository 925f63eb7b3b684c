//! What queries need beside a mesh, made once and kept as long as its result: the one place between
//! the queries, which know a result's arrays alone, and the algorithm, which triangulates the
//! inputs for them.

mod hull;
mod kept;
#[cfg(test)]
mod tests;

use crate::arrays::{
    Arrays, ConvexHull, Extent, Group, Part, Placement, Selection, placements_in_box,
};
use crate::error::{ErrorKind, Result};
use crate::memory::{filled, with_capacity};
use crate::mesh::{Attribute, Mesh, Triangulation};
use crate::netmesh;
use crate::options::{self, Algorithm, Options};
use crate::query::{self, Among, Index, Values, Work};
use crate::topology::{self, Faces, Filtration};
use kept::Kept;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, OnceLock, PoisonError};

/// What is made at the first query of a result that needs it. It belongs to one mesh; after a run
/// of that, a new one is needed. Threads may share it.
#[derive(Default)]
pub struct Prepared {
    index: Once<Index>,
    in_hull: Once<Vec<Placement>>,
    in_box: Once<Vec<Placement>>,
    attributes: Once<Vec<Attribute>>,
    faces: Once<Faces>,
    alpha: Once<Filtration>,
    distances: Once<Filtration>,
    kept: Kept,
}

/// A value that the first one who needs it makes, while others wait.
struct Once<T> {
    value: OnceLock<T>,
    /// Whether there is a value. `value` knows, but the thread sanitizer does not see how: that is
    /// in the compiled part of the standard library.
    is_made: AtomicBool,
    making: Mutex<()>,
}

impl<T> Default for Once<T> {
    fn default() -> Self {
        Self { value: OnceLock::new(), is_made: AtomicBool::new(false), making: Mutex::new(()) }
    }
}

impl<T> Once<T> {
    fn get_or_make(&self, make: impl FnOnce() -> Result<T>) -> Result<&T> {
        if let Some(value) = self.get() {
            return Ok(value);
        }
        let _guard = self.making.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(value) = self.get() {
            return Ok(value);
        }
        let made = make()?;
        let value = self.value.get_or_init(|| made);
        self.is_made.store(true, Ordering::Release);
        Ok(value)
    }

    fn get(&self) -> Option<&T> {
        self.is_made.load(Ordering::Acquire).then(|| self.value.get()).flatten()
    }
}

impl Prepared {
    /// The index of the mesh. O(simplices + vertices log vertices) the first time.
    ///
    /// # Errors
    /// `State` before a run, `OutOfMemory`.
    pub fn index(&self, mesh: &Mesh) -> Result<&Index> {
        let result = mesh.result()?;
        self.index.get_or_make(|| Index::new(result))
    }

    /// Writes for each of the points (`count x dim`) the number of the nearest input, of equal ones
    /// the first and of those at the same exact distance the least, and its distance.
    ///
    /// # Errors
    /// `State` before a run, and those of [`Index::nearest`].
    pub fn nearest_inputs<'a>(
        &self,
        mesh: &Mesh,
        points: &[f64],
        work: impl Into<Work<'a>>,
        inputs: &mut [u32],
        distances: &mut [f64],
    ) -> Result<()> {
        let result = mesh.result()?;
        self.index(mesh)?.nearest(result, Among::Inputs, points, work, inputs, distances)?;
        // First inputs ascend with their vertices: the least vertex is the least input.
        for number in inputs {
            *number = mesh.inputs().first_input(*number as usize).expect("an input's vertex");
        }
        Ok(())
    }

    /// Where each simplex lies with respect to the hull or the box of the inputs, exactly; empty
    /// for [`Extent::All`]. The first time the hull takes a Delaunay triangulation of the inputs
    /// that may be on it, and tests of the simplices along it.
    ///
    /// # Errors
    /// `State` before a run, `OutOfMemory`.
    pub fn placements(&self, mesh: &Mesh, extent: Extent) -> Result<&[Placement]> {
        let (result, inputs) = (mesh.result()?, mesh.inputs());
        let points = || &result.points[..inputs.distinct() * inputs.dim()];
        // Places are found by walks through all of a hull, whose first simplices the result has.
        let all = result.boundary.whole.as_deref().unwrap_or(result);
        let first = |mut placements: Vec<Placement>| {
            placements.truncate(result.simplex_count());
            placements
        };
        let is_within = match result.parameters.extent {
            options::Extent::Hull | options::Extent::Boundary => true,
            options::Extent::Box => extent == Extent::Box,
            _ => false,
        };
        let all_inside = || Ok(filled(result.simplex_count(), Placement::Inside)?);
        match extent {
            Extent::All => Ok(&[]),
            Extent::Box => Ok(self.in_box.get_or_make(|| match is_within {
                true => all_inside(),
                false => placements_in_box(all, points()).map(first),
            })?),
            Extent::Hull => Ok(self.in_hull.get_or_make(|| {
                if is_within || all.vertex_count() == inputs.distinct() {
                    return all_inside();
                }
                let hull: ConvexHull = hull::of_points(inputs.dim(), points())?;
                hull.placements(all, result.parameters.threads).map(first)
            })?),
        }
    }

    /// All faces of the mesh, from the vertices on. `threads` as in the options.
    ///
    /// # Errors
    /// `State` before a run, and those of [`Faces::new`].
    pub fn faces(&self, mesh: &Mesh, threads: u32) -> Result<&Faces> {
        let result = mesh.result()?;
        self.faces.get_or_make(|| Faces::new(result, 0, threads))
    }

    /// The alpha values of all faces.
    ///
    /// # Errors
    /// `State` before a run, and those of [`topology::alpha`].
    pub fn alpha(&self, mesh: &Mesh, threads: u32) -> Result<&Filtration> {
        let (result, faces) = (mesh.result()?, self.faces(mesh, threads)?);
        self.alpha.get_or_make(|| topology::alpha(result, faces, threads))
    }

    /// The filtration of the mesh by the distance to its inputs.
    ///
    /// # Errors
    /// `State` before a run, and those of [`topology::distances`].
    pub fn distances(&self, mesh: &Mesh, threads: u32) -> Result<&Filtration> {
        let (result, faces) = (mesh.result()?, self.faces(mesh, threads)?);
        let index = self.index(mesh)?;
        self.distances.get_or_make(|| topology::distances(result, faces, index, threads))
    }

    /// The attributes of the mesh at its vertices (before a run at the distinct inputs): those of
    /// the inputs, and at other vertices as each attribute says. The first time after a run or
    /// after [`Prepared::forget_attributes`] it triangulates the inputs.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn vertex_attributes(&self, mesh: &Mesh) -> Result<&[Attribute]> {
        Ok(self.attributes.get_or_make(|| at_vertices(mesh))?)
    }

    /// Attributes of the mesh have been set.
    pub fn forget_attributes(&mut self) {
        self.attributes = Once::default();
    }

    /// The simplices of a selection.
    ///
    /// # Errors
    /// `State` before a run, `InvalidArgument` (a domain that is not there), `OutOfMemory`.
    pub fn part<'a>(&self, mesh: &'a Mesh, selection: &Selection) -> Result<Part<'a>> {
        let placements = self.placements(mesh, selection.extent)?;
        Part::of(mesh.result()?, selection, placements)
    }

    /// Calls `act` with an array of a selection, the one that `array` picks from a group. The
    /// arrays of a group are made at the first call for one of them. Each is kept until `act`
    /// answers true for it, until another group or selection is asked for, or as long as this
    /// value. At most one group is kept; threads that ask at the same time each make their own.
    ///
    /// # Errors
    /// Those of [`Prepared::part`], and of `act`.
    pub fn with_array<T>(
        &self,
        mesh: &Mesh,
        (selection, group): (&Selection, Group),
        array: impl Fn(&mut Arrays) -> &mut Option<Vec<T>>,
        act: impl FnOnce(&[T]) -> Result<bool>,
    ) -> Result<()> {
        self.kept.with((selection, group), || self.part(mesh, selection), array, act)
    }
}

/// Values at all vertices of a mesh (`vertices x components`) that agree with `values` at the
/// inputs (`inputs x components`, in the caller's order; of equal inputs the first counts): linear
/// in the Delaunay triangulation of the inputs, which is made for it, and those of the nearest
/// input beyond its hull; those of the nearest input everywhere if the inputs lie in a hyperplane.
///
/// # Errors
/// `State` before a run, `InvalidArgument` (a length), `OutOfMemory`.
pub fn extend_values(mesh: &Mesh, values: Values<'_>, out: &mut [f64]) -> Result<()> {
    let (result, inputs) = (mesh.result()?, mesh.inputs());
    let threads = result.parameters.threads;
    let extend = |delaunay: Option<&Triangulation>, out: &mut [f64]| {
        query::extend_values(inputs, delaunay, result, values, threads, out)
    };
    if result.vertex_count() == inputs.distinct() {
        return extend(Some(result), out);
    }
    query::check_extension(inputs, result, values, out)?;
    match netmesh::run(inputs, None, &plain(), None) {
        Ok(delaunay) => extend(Some(&delaunay), out),
        Err(error) if error.kind() == ErrorKind::DegenerateInput => extend(None, out),
        Err(error) => Err(error),
    }
}

/// The attributes of the mesh at its vertices.
fn at_vertices(mesh: &Mesh) -> Result<Vec<Attribute>> {
    let inputs = mesh.inputs();
    let vertices = mesh.triangulation().map_or(inputs.distinct(), Triangulation::vertex_count);
    let mut found = with_capacity(mesh.attributes().len())?;
    for attribute in mesh.attributes() {
        let mut values = filled(vertices * attribute.components, f64::NAN)?;
        for (vertex, values) in values.chunks_exact_mut(attribute.components).enumerate() {
            if let Some(input) = inputs.first_input(vertex) {
                values.copy_from_slice(attribute.of(input as usize));
            }
        }
        let name = attribute.name.clone();
        found.push(Attribute { name, values, ..*attribute });
    }
    let extended = || mesh.attributes().iter().filter(|attribute| attribute.is_extended);
    let components: usize = extended().map(|attribute| attribute.components).sum();
    if vertices == inputs.distinct() || components == 0 {
        return Ok(found);
    }
    // All at once: the inputs are triangulated for it.
    let mut of_inputs = with_capacity(inputs.count() * components)?;
    for input in 0..inputs.count() {
        extended().for_each(|attribute| of_inputs.extend_from_slice(attribute.of(input)));
    }
    let mut of_vertices = filled(vertices * components, 0.0)?;
    extend_values(mesh, Values { components, values: &of_inputs }, &mut of_vertices)?;
    let mut first = 0;
    for attribute in found.iter_mut().filter(|attribute| attribute.is_extended) {
        let own = attribute.components;
        let rows = of_vertices.chunks_exact(components);
        for (values, row) in attribute.values.chunks_exact_mut(own).zip(rows) {
            values.copy_from_slice(&row[first..first + own]);
        }
        first += own;
    }
    Ok(found)
}

/// Options for the Delaunay triangulation of the inputs alone.
fn plain() -> Options {
    Options { algorithm: Algorithm::Delaunay, ..Options::default() }
}
