//! Reaches: how near a face of the Voronoi diagram comes to an input, where all of it has the same
//! nearest input.
//!
//! Let N be the points at equal distance from the vertices of a face of the mesh, and c the one of
//! them nearest to the input. If no vertex is nearer to c than those of the face, c is in the
//! Voronoi face, and its distance is the reach. Else the reach is the least of those of the faces
//! that have a nearer vertex in addition: the argument for alpha values (docs/topology.md), which
//! are the reaches where the input is a vertex of the face.

use super::{Faces, Level};
use crate::memory::{AllocResult, filled};
use crate::mesh::{MAX_DIM, NONE, Triangulation};
use crate::query::view::View;

/// The least height of a simplex over its longest edge, of those that are computed with: then
/// reaches have relative errors of at most 1e-6.
const LEAST_HEIGHT: f64 = 1e-8;

/// Fills in the values of the faces without an input that have a vertex with one in `group`, the
/// input nearest to all of the vertex's cell. The simplices there must be sound ([`is_sound`]), and
/// the values of faces with an input there.
pub(super) fn fill_reaches<const D: usize>(
    mesh: &Triangulation,
    faces: &Faces,
    group: &[u32],
    values: &mut [Vec<f64>],
) -> AllocResult<()> {
    let view = View::<D> { mesh };
    for k in (faces.lowest()..=D).rev() {
        let level = faces.of_dimension(k);
        let mut nearest = filled(level.count(), [f64::NAN; D])?;
        let (here, above) = values[k - faces.lowest()..].split_at_mut(1);
        for (face, nearest) in nearest.iter_mut().enumerate() {
            let Some(input) = group_of(level.face(face), group) else { continue };
            let (offset, reach) = nearest_on_flat(view, level.face(face), view.point(input));
            (*nearest, here[0][face]) = (offset, reach);
        }
        if let Some(above) = above.first() {
            let cofaces = faces.of_dimension(k + 1);
            raise_those_beyond(view, (level, &nearest), (cofaces, above), &mut here[0])?;
        }
    }
    Ok(())
}

/// Returns the input nearest to the Voronoi face, if no vertex is one and a group tells.
fn group_of(face: &[u32], group: &[u32]) -> Option<u32> {
    let is_input = |&vertex: &u32| group[vertex as usize] == vertex;
    if face.iter().any(is_input) {
        return None;
    }
    face.iter().map(|&vertex| group[vertex as usize]).find(|&input| input != NONE)
}

/// Gives the faces whose nearest point is outside their Voronoi face the least value of the
/// cofaces that tell so.
fn raise_those_beyond<const D: usize>(
    view: View<'_, D>,
    (level, nearest): (&Level, &[[f64; D]]),
    (cofaces, above): (&Level, &[f64]),
    values: &mut [f64],
) -> AllocResult<()> {
    let mut is_beyond = filled(values.len(), false)?;
    for (coface, &value) in above.iter().enumerate() {
        for (i, &face) in cofaces.facets(coface).iter().enumerate() {
            let (face, offset) = (face as usize, &nearest[face as usize]);
            // NaN is no face of these.
            if offset[0].is_nan() {
                continue;
            }
            let first = view.point(level.face(face)[0]);
            let other = view.point(cofaces.face(coface)[i]);
            // |c - other| < |c - first|, from first.
            let to = std::array::from_fn::<f64, D, _>(|axis| other[axis] - first[axis]);
            let (to, offset) = scaled_alike(&to, offset);
            if product(&to, &to) < 2.0 * product(&to, &offset) {
                let before = if is_beyond[face] { values[face] } else { f64::INFINITY };
                (values[face], is_beyond[face]) = (before.min(value), true);
            }
        }
    }
    Ok(())
}

fn product<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    (0..D).map(|axis| a[axis] * b[axis]).sum()
}

/// Divides both points by the larger of their largest coordinates, so that squares neither overflow
/// nor vanish.
fn scaled_alike<const D: usize>(a: &[f64; D], b: &[f64; D]) -> ([f64; D], [f64; D]) {
    let scale = a.iter().chain(b).fold(f64::MIN_POSITIVE, |largest, x| largest.max(x.abs()));
    (a.map(|x| x / scale), b.map(|x| x / scale))
}

/// Returns the point nearest to `input` of those at equal distance from the vertices of a face,
/// less the first vertex, and its distance from the input.
fn nearest_on_flat<const D: usize>(
    view: View<'_, D>,
    face: &[u32],
    input: &[f64; D],
) -> ([f64; D], f64) {
    let first = view.point(face[0]);
    let from_first =
        |point: &[f64; D]| -> [f64; D] { std::array::from_fn(|axis| point[axis] - first[axis]) };
    let k = face.len() - 1;
    let mut edges = [[0.0; D]; MAX_DIM];
    for (edge, &vertex) in edges.iter_mut().zip(&face[1..]) {
        *edge = from_first(view.point(vertex));
    }
    let mut to_input = from_first(input);
    let all = edges[..k].iter().chain([&to_input]).flatten();
    let scale = all.fold(f64::MIN_POSITIVE, |largest: f64, x| largest.max(x.abs()));
    for x in edges[..k].iter_mut().chain([&mut to_input]).flatten() {
        *x /= scale;
    }
    let basis = Basis::new(&edges[..k]);
    // In the face's flat c is the circumcentre; beside it, where the input is.
    let wanted = |edge: &[f64; D]| 0.5 * product(edge, edge) - product(edge, &to_input);
    let shift = basis.solve(edges[..k].iter().map(wanted));
    let nearest = std::array::from_fn(|axis| (to_input[axis] + shift[axis]) * scale);
    (nearest, product(&shift, &shift).sqrt() * scale)
}

/// An orthonormal basis of the span of vectors (modified Gram-Schmidt, each vector twice): errors
/// grow with the condition of the vectors, where those of normal equations grow with its square.
struct Basis<const D: usize> {
    vectors: [[f64; D]; MAX_DIM],
    /// Row i has the products of vector i with those before it in the basis, and with its own.
    rows: [[f64; MAX_DIM]; MAX_DIM],
    size: usize,
}

impl<const D: usize> Basis<D> {
    fn new(of: &[[f64; D]]) -> Self {
        let mut basis =
            Self { vectors: [[0.0; D]; MAX_DIM], rows: [[0.0; MAX_DIM]; MAX_DIM], size: of.len() };
        for (i, vector) in of.iter().enumerate() {
            let mut rest = *vector;
            for j in (0..i).chain(0..i) {
                let part = product(&rest, &basis.vectors[j]);
                basis.rows[i][j] += part;
                (0..D).for_each(|axis| rest[axis] -= part * basis.vectors[j][axis]);
            }
            let height = product(&rest, &rest).sqrt();
            basis.rows[i][i] = height;
            basis.vectors[i] = rest.map(|x| x / height);
        }
        basis
    }

    /// Returns the vector in the span that has those products with the vectors.
    fn solve(&self, products: impl Iterator<Item = f64>) -> [f64; D] {
        let (mut parts, mut found) = ([0.0; MAX_DIM], [0.0; D]);
        for (i, product) in products.enumerate() {
            let before: f64 = (0..i).map(|j| self.rows[i][j] * parts[j]).sum();
            parts[i] = (product - before) / self.rows[i][i];
            (0..D).for_each(|axis| found[axis] += parts[i] * self.vectors[i][axis]);
        }
        found
    }

    /// Returns the least of the heights of the vectors over those before them.
    fn least_height(&self) -> f64 {
        (0..self.size).map(|i| self.rows[i][i]).fold(f64::INFINITY, f64::min)
    }
}

/// Returns true if a simplex is far enough from flat for its faces' reaches to be computed in
/// doubles.
pub(super) fn is_sound<const D: usize>(view: View<'_, D>, simplex: u32) -> bool {
    let vertices = view.simplex(simplex);
    let first = view.point(vertices[0]);
    let mut edges = [[0.0; D]; D];
    for (edge, &vertex) in edges.iter_mut().zip(&vertices[1..]) {
        *edge = std::array::from_fn(|axis| view.point(vertex)[axis] - first[axis]);
    }
    let scale = edges.iter().flatten().fold(f64::MIN_POSITIVE, |most: f64, x| most.max(x.abs()));
    edges.iter_mut().flatten().for_each(|x| *x /= scale);
    let longest = edges.iter().map(|edge| product(edge, edge)).fold(0.0, f64::max).sqrt();
    Basis::new(&edges).least_height() >= LEAST_HEIGHT * longest
}
