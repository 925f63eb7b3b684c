//! Alpha shapes (H. Edelsbrunner, D. G. Kirkpatrick, R. Seidel, "On the shape of a set of points in
//! the plane", 1983; Edelsbrunner and Mücke, 1994): the faces of a Delaunay triangulation up to an
//! alpha value.
//!
//! Betti numbers are counted where that needs no elimination (docs/topology.md): components by the
//! edges; voids, by Alexander duality, as the bounded components of what the shape leaves of space;
//! the tunnels of space by the Euler characteristic.

use super::components::Components;
use super::{Faces, Filtration};
use crate::arrays::{Lists, Part};
use crate::error::{Error, Result, message};
use crate::memory::{AllocResult, collected, filled};
use crate::mesh::{Inputs, Triangulation};

/// The faces whose alpha value is at most some number.
#[derive(Clone, Copy, Debug)]
pub struct AlphaShape<'a> {
    faces: &'a Faces,
    values: &'a [Vec<f64>],
    alpha: f64,
}

/// Class of a face in an alpha shape, as CGAL classifies it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FaceClass {
    /// Faces that are not in the shape.
    Exterior,
    /// Faces in the shape that are in no larger face of it.
    Singular,
    /// Faces on the boundary of the shape, in a larger face of it.
    Regular,
    /// Faces in the interior of the shape: all simplices round them are in the shape.
    Interior,
}

/// Numbers that belong to an alpha shape.
#[derive(Clone, Debug, PartialEq)]
pub struct Topology {
    /// The number of its faces of each dimension.
    pub face_counts: Vec<u64>,
    /// Faces of even dimension less those of odd dimension.
    pub euler_characteristic: i64,
    /// Number of connected components.
    pub components: u64,
    /// Number of bounded pieces that the shape leaves of space: holes in 2D, cavities in 3D.
    pub voids: u64,
    /// Betti numbers of the shape, from dimension 0 to `dim - 1`: components and holes in 2D,
    /// components, tunnels and cavities in 3D. `None` in other dimensions.
    pub betti: Option<Vec<u64>>,
}

impl<'a> AlphaShape<'a> {
    /// Makes the shape for `alpha`, a squared radius. `faces` are from dimension 0 on, and `values`
    /// their alpha values, as [`super::alpha`] makes them.
    ///
    /// # Errors
    /// `InvalidArgument`: `alpha` is negative or NaN.
    pub fn new(faces: &'a Faces, values: &'a Filtration, alpha: f64) -> Result<Self> {
        if alpha.is_nan() || alpha < 0.0 {
            let message = message!("alpha is {alpha}; it must be at least 0, a squared radius");
            return Err(Error::invalid(message));
        }
        Ok(Self { faces, values: &values.values, alpha })
    }

    /// Returns the largest alpha value that a face of the shape may have.
    pub fn alpha(&self) -> f64 {
        self.alpha
    }

    /// Returns true if a face of dimension `k` is in the shape.
    pub fn contains(&self, k: usize, face: usize) -> bool {
        self.values[k][face] <= self.alpha
    }

    /// Counts faces, pieces, holes and cavities. O(faces log faces).
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn topology(&self) -> Result<Topology> {
        let is_within = |value: &&f64| **value <= self.alpha;
        let count = |values: &Vec<f64>| values.iter().filter(is_within).count() as u64;
        let face_counts = collected(self.values.iter().map(count))?;
        let signs = [1, -1].into_iter().cycle();
        let euler: i64 =
            face_counts.iter().zip(signs).map(|(&count, sign)| sign * count as i64).sum();
        let (components, voids) = (self.components()? as u64, self.voids()? as u64);
        let betti = match self.faces.dim() {
            2 => Some(vec![components, voids]),
            // The Euler characteristic is that of the Betti numbers.
            3 => Some(vec![components, ((components + voids) as i64 - euler) as u64, voids]),
            _ => None,
        };
        Ok(Topology { face_counts, euler_characteristic: euler, components, voids, betti })
    }

    /// Counts the components. Vertices have the value 0, so each is in some component.
    fn components(&self) -> AllocResult<usize> {
        let mut components = Components::new(self.faces.of_dimension(0).count())?;
        for (edge, ends) in self.faces.of_dimension(1).vertices.chunks_exact(2).enumerate() {
            if self.contains(1, edge) {
                components.join(ends[0], ends[1]);
            }
        }
        Ok(components.count())
    }

    /// Counts the voids. Simplices outside the shape are connected across facets outside it; one
    /// more item is all that is beyond the hull.
    fn voids(&self) -> Result<usize> {
        let dim = self.faces.dim();
        let sides = sides(self.faces)?;
        let beyond = self.faces.of_dimension(dim).count();
        let mut components = Components::new(beyond + 1)?;
        for (facet, sides) in sides.iter().enumerate() {
            if !self.contains(dim - 1, facet) {
                components.join(sides[0], sides.get(1).copied().unwrap_or(beyond as u32));
            }
        }
        let in_shape = (0..beyond).filter(|&simplex| self.contains(dim, simplex)).count();
        Ok(components.count() - in_shape - 1)
    }

    /// Returns the class of each face of dimension `k`. O(faces of dimension `k` and more).
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn classes(&self, k: usize) -> Result<Vec<FaceClass>> {
        let mut is_interior = self.contained(self.faces.dim())?;
        let mut is_in_larger = filled(self.faces.of_dimension(k).count(), false)?;
        for below in (k..self.faces.dim()).rev() {
            is_interior = self.interior(below, &is_interior)?;
        }
        if k < self.faces.dim() {
            let above = self.faces.of_dimension(k + 1);
            for face in (0..above.count()).filter(|&face| self.contains(k + 1, face)) {
                above.facets(face).iter().for_each(|&facet| is_in_larger[facet as usize] = true);
            }
        }
        let class = |face: usize| match (is_interior[face], is_in_larger[face]) {
            (true, _) => FaceClass::Interior,
            (false, true) => FaceClass::Regular,
            (false, false) if self.contains(k, face) => FaceClass::Singular,
            (false, false) => FaceClass::Exterior,
        };
        Ok(collected((0..is_interior.len()).map(class))?)
    }

    /// Returns for each face of dimension `k` whether it is in the shape.
    fn contained(&self, k: usize) -> AllocResult<Vec<bool>> {
        collected(self.values[k].iter().map(|&value| value <= self.alpha))
    }

    /// Returns for each face of dimension `k` whether it is in the interior, by those of one more
    /// dimension that are.
    fn interior(&self, k: usize, above: &[bool]) -> AllocResult<Vec<bool>> {
        let level = self.faces.of_dimension(k + 1);
        let mut is_interior = self.contained(k)?;
        for face in (0..level.count()).filter(|&face| !above[face]) {
            level.facets(face).iter().for_each(|&facet| is_interior[facet as usize] = false);
        }
        if k + 1 == self.faces.dim() {
            // Facets of one simplex are on the hull.
            let mut is_on_hull = filled(is_interior.len(), false)?;
            level.boundary.iter().for_each(|&facet| is_on_hull[facet as usize] ^= true);
            let on_hull = is_on_hull.iter().zip(&mut is_interior).filter(|(on_hull, _)| **on_hull);
            on_hull.for_each(|(_, is_interior)| *is_interior = false);
        }
        Ok(is_interior)
    }

    /// Returns the simplices of the shape, as a part of the mesh: its hull is the boundary of the
    /// regular shape, its volumes add up to that of the shape.
    ///
    /// # Errors
    /// `InvalidArgument` (faces of another mesh), `OutOfMemory`.
    pub fn solid<'b>(&self, mesh: &'b Triangulation) -> Result<Part<'b>> {
        let dim = self.faces.dim();
        let of_simplices = self.faces.of_simplices().iter();
        let contained = collected(of_simplices.map(|&face| self.contains(dim, face as usize)))?;
        Part::of_chosen(mesh, contained)
    }

    /// Returns the boundary of the simplices of the shape: facets of `dim` inputs each, of equal
    /// ones the first, oriented outwards.
    ///
    /// # Errors
    /// Fails as [`AlphaShape::solid`] does.
    pub fn boundary(&self, inputs: &Inputs, mesh: &Triangulation) -> Result<Vec<u32>> {
        let mut facets = self.solid(mesh)?.hull()?.vertices;
        for vertex in &mut facets {
            *vertex = inputs.first_input(*vertex as usize).expect("a vertex that is an input");
        }
        Ok(facets)
    }

    /// Computes the volume of the shape (an area in 2D), up to a relative error of 1e-12.
    /// O(simplices).
    ///
    /// # Errors
    /// Fails as [`AlphaShape::solid`] does.
    pub fn volume(&self, mesh: &Triangulation) -> Result<f64> {
        Ok(compensated_sum(&self.solid(mesh)?.volumes()?))
    }
}

/// Returns the simplices on either side of each facet, or the one.
fn sides(faces: &Faces) -> Result<Lists> {
    let facets = faces.of_dimension(faces.dim() - 1).count();
    faces.of_dimension(faces.dim()).coboundary(facets)
}

/// Returns the sum of numbers that are not negative, with the errors of its roundings summed as
/// well (A. Neumaier, "Rundungsfehleranalyse einiger Verfahren zur Summation endlicher Summen",
/// 1974).
fn compensated_sum(terms: &[f64]) -> f64 {
    let (mut sum, mut error) = (0.0f64, 0.0);
    for &term in terms {
        let next = sum + term;
        error += if sum >= term { (sum - next) + term } else { (term - next) + sum };
        sum = next;
    }
    if sum.is_finite() { sum + error } else { sum }
}

/// Returns faces of one dimension sorted by value, and those of equal value by id.
fn by_value(values: &[f64]) -> AllocResult<Vec<u32>> {
    let mut order = collected(0..values.len() as u32)?;
    let value = |&face: &u32| values[face as usize];
    order.sort_unstable_by(|a, b| value(a).total_cmp(&value(b)).then(a.cmp(b)));
    Ok(order)
}

/// Returns the least alpha for which the shape is connected, and with it all vertices: a quarter of
/// the square of the longest edge of their least spanning tree. Arguments are those of
/// [`AlphaShape::new`]. O(edges log edges).
///
/// # Errors
/// `OutOfMemory`.
pub fn connecting_alpha(faces: &Faces, values: &Filtration) -> Result<f64> {
    let (edges, values) = (faces.of_dimension(1), &values.values[1]);
    let mut components = Components::new(faces.of_dimension(0).count())?;
    let mut alpha = 0.0;
    for edge in by_value(values)? {
        let ends = edges.face(edge as usize);
        if components.join(ends[0], ends[1]) {
            alpha = values[edge as usize];
        }
    }
    Ok(alpha)
}

/// Returns the least alpha for which each vertex is in a simplex of the shape, and its simplices,
/// connected across facets, are at most `components` pieces: what CGAL calls the optimal alpha.
/// (CGAL finds it by bisection, as if fewer pieces stayed fewer.) Arguments are those of
/// [`AlphaShape::new`]. O(simplices log simplices).
///
/// # Errors
/// `InvalidArgument` (no components), `OutOfMemory`.
pub fn optimal_alpha(faces: &Faces, values: &Filtration, components: u64) -> Result<f64> {
    if components == 0 {
        let rule = "components is 0; it must be at least 1";
        return Err(Error::invalid(rule));
    }
    let dim = faces.dim();
    let (simplices, values) = (faces.of_dimension(dim), &values.values[dim]);
    let solid = solid_alpha(faces, values)?;
    let sides = sides(faces)?;
    let mut contained = filled(simplices.count(), false)?;
    let mut pieces = Components::new(simplices.count())?;
    let order = by_value(values)?;
    let value = |simplex: u32| values[simplex as usize];
    let mut missing = order.len();
    for same in order.chunk_by(|&a, &b| value(a) == value(b)) {
        for &simplex in same {
            contained[simplex as usize] = true;
            for &facet in simplices.facets(simplex as usize) {
                for &side in
                    sides.of(facet as usize).iter().filter(|&&side| contained[side as usize])
                {
                    pieces.join(simplex, side);
                }
            }
        }
        missing -= same.len();
        // Each simplex that is missing is a set of its own.
        if value(same[0]) >= solid && (pieces.count() - missing) as u64 <= components {
            return Ok(value(same[0]));
        }
    }
    Ok(solid)
}

/// Returns the least alpha for which each vertex is in a simplex of the shape.
fn solid_alpha(faces: &Faces, values: &[f64]) -> AllocResult<f64> {
    let mut least = filled(faces.of_dimension(0).count(), f64::INFINITY)?;
    for (simplex, &value) in values.iter().enumerate() {
        for &vertex in faces.of_dimension(faces.dim()).face(simplex) {
            let least = &mut least[vertex as usize];
            *least = least.min(value);
        }
    }
    Ok(least.into_iter().fold(0.0, f64::max))
}
