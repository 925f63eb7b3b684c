//! Structures that queries need beside a mesh, made once and kept as long as its result. This is
//! the one place between the queries, which know a result's arrays alone, and the algorithm, which
//! triangulates the inputs for them.

mod hull;
mod kept;
#[cfg(test)]
mod tests;

use crate::arrays::{
    Arrays, ConvexHull, Group, Part, Placement, Selection, SelectionExtent, placements_in_box,
};
use crate::error::{ErrorKind, Result};
use crate::memory::{filled, with_capacity};
use crate::mesh::{Attribute, Intersection, Mesh, OddEdge, Triangulation};
use crate::netmesh;
use crate::options::{self, Algorithm, Options};
use crate::query::{self, Among, Index, SimplexBoxes, Values, Work};
use crate::surface::{Surface, SurfaceKind};
use crate::topology::{self, Faces, Filtration};
use kept::Kept;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, OnceLock, PoisonError};

/// Structures that the first query that needs them makes for a result. They belong to one mesh and
/// one result of it: after another run a new value is needed. Threads may share it.
#[derive(Default)]
pub struct Prepared {
    index: Once<Index>,
    boxes: Once<SimplexBoxes>,
    in_hull: Once<Vec<Placement>>,
    in_box: Once<Vec<Placement>>,
    attributes: Once<Vec<Attribute>>,
    faces: Once<Faces>,
    alpha: Once<Filtration>,
    distances: Once<Filtration>,
    closed_surface: Once<Surface>,
    open_surface: Once<Surface>,
    intersections: Once<Vec<Intersection>>,
    odd_edges: Once<Vec<OddEdge>>,
    kept: Kept,
}

/// Value that the first thread which needs it makes, while others wait.
struct Once<T> {
    value: OnceLock<T>,
    /// True if there is a value. `value` knows it too, but the thread sanitizer cannot see its
    /// synchronisation, which is in the compiled part of the standard library.
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
    /// Returns the index of the mesh. The first call takes O(simplices + vertices log vertices).
    ///
    /// # Errors
    /// `State` before a run, `OutOfMemory`.
    pub fn index(&self, mesh: &Mesh) -> Result<&Index> {
        let result = mesh.result()?;
        self.index.get_or_make(|| Index::new(result))
    }

    /// Returns the tree of the simplices, for points that only nearly are in one.
    ///
    /// # Errors
    /// `State` before a run, `OutOfMemory`.
    pub fn boxes(&self, mesh: &Mesh) -> Result<&SimplexBoxes> {
        let result = mesh.result()?;
        self.boxes.get_or_make(|| SimplexBoxes::new(result))
    }

    /// Writes for each of the points (`count x dim`) the number of the nearest input and its
    /// distance. Of equal inputs it is the first, and of several at the same exact distance the one
    /// with the smallest number.
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

    /// Returns exactly how each simplex lies with respect to the hull or the bounding box of the
    /// inputs; empty for [`SelectionExtent::All`]. For the hull, the first call makes a Delaunay
    /// triangulation of the inputs that may be on it, and tests the simplices along it.
    ///
    /// # Errors
    /// `State` before a run, `OutOfMemory`.
    pub fn placements(&self, mesh: &Mesh, extent: SelectionExtent) -> Result<&[Placement]> {
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
            options::Extent::Box => extent == SelectionExtent::Box,
            _ => false,
        };
        let all_inside = || Ok(filled(result.simplex_count(), Placement::Inside)?);
        match extent {
            SelectionExtent::All => Ok(&[]),
            SelectionExtent::Box => Ok(self.in_box.get_or_make(|| match is_within {
                true => all_inside(),
                false => placements_in_box(all, points()).map(first),
            })?),
            SelectionExtent::Hull => Ok(self.in_hull.get_or_make(|| {
                if is_within || all.vertex_count() == inputs.distinct() {
                    return all_inside();
                }
                let hull: ConvexHull = hull::of_points(inputs.dim(), points())?;
                hull.placements(all, result.parameters.threads).map(first)
            })?),
        }
    }

    /// Returns all faces of the mesh, from the vertices on. `threads` has the meaning of the
    /// option.
    ///
    /// # Errors
    /// `State` before a run, and those of [`Faces::new`].
    pub fn faces(&self, mesh: &Mesh, threads: u32) -> Result<&Faces> {
        let result = mesh.result()?;
        self.faces.get_or_make(|| Faces::new(result, 0, threads))
    }

    /// Returns the alpha values of all faces.
    ///
    /// # Errors
    /// `State` before a run, and those of [`topology::alpha`].
    pub fn alpha(&self, mesh: &Mesh, threads: u32) -> Result<&Filtration> {
        let (result, faces) = (mesh.result()?, self.faces(mesh, threads)?);
        self.alpha.get_or_make(|| topology::alpha(result, faces, threads))
    }

    /// Returns the filtration of the mesh by the distance to its inputs.
    ///
    /// # Errors
    /// `State` before a run, and those of [`topology::distances`].
    pub fn distances(&self, mesh: &Mesh, threads: u32) -> Result<&Filtration> {
        let (result, faces) = (mesh.result()?, self.faces(mesh, threads)?);
        let index = self.index(mesh)?;
        self.distances.get_or_make(|| topology::distances(result, faces, index, threads))
    }

    /// Returns the surface through the inputs.
    ///
    /// # Errors
    /// `State` before a run, and those of [`Surface::through`].
    pub fn surface(&self, mesh: &Mesh, kind: SurfaceKind) -> Result<&Surface> {
        let result = mesh.result()?;
        let surface = match kind {
            SurfaceKind::Closed => &self.closed_surface,
            SurfaceKind::Open => &self.open_surface,
        };
        surface.get_or_make(|| Surface::through(result, kind))
    }

    /// Returns the intersections of the facets and segments that the mesh was given last, in space.
    ///
    /// # Errors
    /// Errors of [`Mesh::intersections`].
    pub fn intersections(&self, mesh: &Mesh) -> Result<&[Intersection]> {
        Ok(self.intersections.get_or_make(|| mesh.intersections())?)
    }

    /// Returns the edges of the facets that the mesh was given last which are not between two, in
    /// space.
    ///
    /// # Errors
    /// Errors of [`Mesh::odd_edges`].
    pub fn odd_edges(&self, mesh: &Mesh) -> Result<&[OddEdge]> {
        Ok(self.odd_edges.get_or_make(|| mesh.odd_edges())?)
    }

    /// Returns the attributes at the vertices of the mesh (before a run at the distinct inputs):
    /// the caller's values at inputs, and at other vertices extended values or NaN, as each
    /// attribute asks. The first call after a run or after [`Prepared::forget_attributes`]
    /// triangulates the inputs.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn vertex_attributes(&self, mesh: &Mesh) -> Result<&[Attribute]> {
        Ok(self.attributes.get_or_make(|| at_vertices(mesh))?)
    }

    /// Forgets the attributes at vertices, since attributes of the mesh have been set.
    pub fn forget_attributes(&mut self) {
        self.attributes = Once::default();
    }

    /// Returns the simplices of a selection, of which arrays are made.
    ///
    /// # Errors
    /// `State` before a run, `InvalidArgument` (a domain that does not exist), `OutOfMemory`.
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
    /// Errors of [`Prepared::part`] and of `act`.
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

/// Writes values at all vertices of a mesh (`vertices x components`) that agree with `values` at
/// the inputs (`inputs x components`, in the caller's order; of equal inputs the first counts).
/// They are linear in the Delaunay triangulation of the inputs, which is made for it, and beyond
/// its hull those of the nearest input. If the inputs lie in a hyperplane, they are those of the
/// nearest input everywhere.
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

/// Returns the attributes of the mesh at its vertices.
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

/// Returns options for the Delaunay triangulation of the inputs alone.
fn plain() -> Options {
    Options { algorithm: Algorithm::Delaunay, ..Options::default() }
}
