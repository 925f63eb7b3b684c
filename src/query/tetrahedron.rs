//! Contribution of a tetrahedron to the volumes of the Voronoi cells of its vertices: the sums of
//! [`Chains`](super::dual::Chains) of all four vertices at once, without a root and with four
//! divisions.
//!
//! The step from the middle of an edge e to the circumcentre of a face is half of e times the
//! cotangent of the face's angle opposite to e. With N, the normal of the face, twice its area
//! long, and edges a and b from the vertex opposite to e, the cotangent is a.b / |N|, and the last
//! step, to the circumcentre c of the tetrahedron, is (c - p).N / |N| for a vertex p of the face.
//! So a chain is |e|^2 / 4 a.b (c - p).N / |N|^2, the same for both ends of e.

use super::dual::{Center, dot};
use super::unit::{Unit, scaled};

/// The vertices of the face opposite to each vertex: of a positively oriented tetrahedron their
/// normal points to that vertex.
const FACES: [[usize; 3]; 4] = [[1, 3, 2], [0, 2, 3], [0, 3, 1], [0, 1, 2]];

/// Squares between these have lost nothing of weight to underflow or overflow.
const SMALLEST_SQUARE: f64 = 1e-200;
const LARGEST_SQUARE: f64 = 1e200;

/// Returns six times the volume that a positively oriented tetrahedron contributes to the cell of
/// each of its vertices; `None` where squares of lengths leave the doubles, or the circumcentre
/// cannot be used.
pub(super) fn cells<const D: usize>(
    points: &[&[f64; D]],
    center: &Center<D>,
    unit: Unit,
) -> Option<[f64; 4]> {
    let exponent = center.exponent - unit.exponent();
    let offset = in_space(center.offset.map(|x| scaled(x, exponent)));
    let between = |from: usize, to: usize| in_space(unit.difference(points[to], points[from]));
    let mut cells = [0.0; 4];
    for (opposite, &face) in FACES.iter().enumerate() {
        // Edge i is opposite to vertex i of the face.
        let edges: [[f64; 3]; 3] =
            std::array::from_fn(|i| between(face[(i + 1) % 3], face[(i + 2) % 3]));
        let squares = edges.map(|edge| dot(&edge, &edge));
        let normal = normal(&edges, &squares);
        let square = dot(&normal, &normal);
        if !(SMALLEST_SQUARE..=LARGEST_SQUARE).contains(&square) {
            return None;
        }
        let to_center = match center.anchor == opposite {
            false => offset,
            true => {
                let to_anchor = between(face[0], center.anchor);
                std::array::from_fn(|i| to_anchor[i] + offset[i])
            }
        };
        let last = dot(&to_center, &normal) / square;
        for (i, squared) in squares.into_iter().enumerate() {
            let (next, previous) = ((i + 1) % 3, (i + 2) % 3);
            // One of the edges runs to the vertex, the other one from it.
            let chain = -0.25 * squared * dot(&edges[next], &edges[previous]) * last;
            cells[face[next]] += chain;
            cells[face[previous]] += chain;
        }
    }
    cells.iter().all(|cell| cell.is_finite()).then_some(cells)
}

/// Returns the product of the two shorter edges of a triangle whose edges are passed in turn: of
/// the three products, which are equal, it loses the least.
fn normal(edges: &[[f64; 3]; 3], squares: &[f64; 3]) -> [f64; 3] {
    let [a, b, c] = edges;
    let (u, v) = match (squares[0] > squares[1], squares[0] > squares[2], squares[1] > squares[2]) {
        (true, true, _) => (b, c),
        (false, _, true) => (c, a),
        _ => (a, b),
    };
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

/// Returns the same vector with three coordinates as a type.
fn in_space<const D: usize>(vector: [f64; D]) -> [f64; 3] {
    std::array::from_fn(|i| if i < D { vector[i] } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use super::super::dual::Chains;
    use super::*;
    use crate::numerics::testing::{FAMILIES, Random, points};
    use crate::numerics::{Circumball, Sign, orientation};
    use crate::query::unit::largest;

    /// Holds that both ways to add chains agree up to roundings of the longest chain, for
    /// tetrahedra of every family, flat ones and needles among them.
    #[test]
    fn cells_are_the_sums_of_chains() {
        let (mut compared, mut refused) = (0, 0);
        for family in FAMILIES {
            let found = points::<3>(family, 400, &mut Random(family as u64 + 3));
            for four in found.chunks_exact(4) {
                let mut points = [&four[0], &four[1], &four[2], &four[3]];
                match orientation(&points) {
                    Sign::Zero => continue,
                    Sign::Negative => points.swap(0, 1),
                    Sign::Positive => (),
                }
                let unit = Unit::of_points(points.map(largest).into_iter().fold(0.0, f64::max));
                let length = |i: usize| largest(&unit.difference(points[i], points[0]));
                let unit = unit.scaled_to((1..4).map(length).fold(0.0, f64::max));
                let center = Center::from(Circumball::new(&points));
                let Some(cells) = cells(&points, &center, unit) else {
                    refused += 1;
                    continue;
                };
                let mut chains = Chains::default();
                let exponent = center.exponent - unit.exponent();
                let radius = largest(&center.offset.map(|x| scaled(x, exponent)));
                for (base, cell) in cells.into_iter().enumerate() {
                    chains.of(&points, base, &center, unit);
                    let error = (cell - chains.of_cell()).abs();
                    let longest = (1.0 + radius) * (1.0 + radius);
                    assert!(error <= 1e-8 * longest, "{family:?} {four:?} {error:e}");
                    compared += 1;
                }
            }
        }
        assert!(compared > 2000 && refused > 0, "{compared} {refused}");
    }

    /// Squares of such lengths are no doubles.
    #[test]
    fn small_faces_are_left_to_those_who_take_roots() {
        let tiny = 1e-60;
        let points = [&[0.0; 3], &[tiny, 0.0, 0.0], &[0.0, tiny, 0.0], &[0.0, 0.0, 1.0]];
        let center = Center::from(Circumball::new(&points));
        assert_eq!(cells(&points, &center, Unit::of_points(1.0)), None);
    }
}
