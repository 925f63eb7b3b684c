//! Whether the interior of a simplex meets the hull of some points, by exact signs.
//!
//! The simplex has the vertices v. Its interior meets the hull of the points a just if for each
//! vertex v_i there are factors, none negative, with v_i + sum of s_j v_j (j other than i) = sum of
//! t a, where v and a stand for vectors with a one beside the coordinates: all these equations
//! together have positive factors at all v. Each is a linear program. The dual simplex method
//! solves it with nothing but signs of determinants, which are orientations. By the rule of the least
//! index it ends (R. G. Bland, "New finite pivoting rules for the simplex method", 1977).

use super::cloud::Cloud;
use crate::mesh::MAX_DIM;
use crate::numerics::{Hyperplane, Sign, orientation};

/// A hyperplane through `dim` points with no point of the hull strictly on its positive side.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane<const D: usize> {
    points: [[f64; D]; D],
    /// The orientation of those points and one on the positive side.
    side: Sign,
    /// The same for a filter; `None` where that cannot have it.
    filter: Option<Hyperplane<D>>,
}

impl<const D: usize> Plane<D> {
    fn new(points: [[f64; D]; D], side: Sign) -> Self {
        let filter = Hyperplane::new(&points);
        let filter = if side == Sign::Positive { filter } else { filter.map(Hyperplane::turned) };
        Self { points, side, filter }
    }

    /// The plane of the facet opposite vertex `i` of a positively oriented simplex, which is on its
    /// positive side.
    pub fn of_facet(simplex: &[&[f64; D]], i: usize) -> Self {
        let points = std::array::from_fn(|k| *simplex[k + usize::from(k >= i)]);
        // The vertex passes D - i others on its way to the end.
        let side = if (D - i) % 2 == 0 { Sign::Positive } else { Sign::Negative };
        Self::new(points, side)
    }

    /// With the sides exchanged.
    pub fn turned(self) -> Self {
        Self { side: -self.side, filter: self.filter.map(Hyperplane::turned), ..self }
    }

    /// Whether no vertex of a simplex is strictly on the side of the hull.
    pub fn separates(&self, simplex: &[&[f64; D]]) -> bool {
        simplex.iter().all(|vertex| self.side_of(vertex) != Sign::Negative)
    }

    /// Whether a point is strictly on the positive side.
    pub fn has_beyond(&self, point: &[f64; D]) -> bool {
        self.side_of(point) == Sign::Positive
    }

    /// As [`Hyperplane::least_at`].
    pub fn least_at(&self, point: &[f64; D]) -> f64 {
        self.filter.as_ref().map_or(f64::NEG_INFINITY, |filter| filter.least_at(point))
    }

    /// As [`Hyperplane::most_in`].
    pub fn most_in(&self, low: &[f64; D], high: &[f64; D]) -> f64 {
        self.filter.as_ref().map_or(f64::INFINITY, |filter| filter.most_in(low, high))
    }

    fn side_of(&self, point: &[f64; D]) -> Sign {
        if self.least_at(point) > 0.0 {
            return Sign::Positive;
        }
        if self.most_in(point, point) < 0.0 {
            return Sign::Negative;
        }
        let mut points = [point; MAX_DIM + 1];
        points.iter_mut().zip(&self.points).for_each(|(to, point)| *to = point);
        orientation(&points[..=D]) * self.side
    }
}

/// A simplex that is positively oriented, and points.
pub(super) struct Pair<'a, const D: usize> {
    pub simplex: &'a [&'a [f64; D]],
    pub points: &'a Cloud<D>,
}

/// A vector of the basis: a vertex of the simplex, negated, or one of the points.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Column {
    Vertex(usize),
    Point(usize),
}

/// After so many exchanges the rule of the least index counts. Before, far points come into the
/// basis, which takes a few exchanges where that rule may take hundreds.
const FREE: usize = 50;

/// `D + 1` independent vectors.
struct Basis<'a, const D: usize> {
    columns: [Column; MAX_DIM + 1],
    points: [&'a [f64; D]; MAX_DIM + 1],
    /// Of all these points.
    orientation: Sign,
}

impl<'a, const D: usize> Pair<'a, D> {
    /// A plane that separates the interior of the simplex from the hull of the points; `None` if
    /// they have a point in common.
    pub fn separation(&self) -> Option<Plane<D>> {
        (0..=D).find_map(|i| self.separation_at(i))
    }

    /// The same as far as it is decided by whether v_i is such a sum.
    fn separation_at(&self, i: usize) -> Option<Plane<D>> {
        let facet = Plane::of_facet(self.simplex, i);
        let Some(first) = self.points.far_beyond(&facet) else {
            return Some(facet);
        };
        let mut basis = self.first_basis(i, first);
        let mut pivots = 0;
        while let Some(row) = self.negative_row(&mut basis, i) {
            let plane = basis.plane(row);
            let Some(column) = self.entering(&plane, i, pivots < FREE) else { return Some(plane) };
            pivots += 1;
            basis.exchange(row, column, self.point(column));
        }
        None
    }

    /// The vertices other than `i`, and a point beyond their facet.
    fn first_basis(&self, i: usize, point: usize) -> Basis<'a, D> {
        let mut basis = Basis {
            columns: std::array::from_fn(Column::Vertex),
            points: [self.simplex[0]; MAX_DIM + 1],
            orientation: Sign::Positive,
        };
        basis.points[..=D].copy_from_slice(self.simplex);
        basis.columns[i] = Column::Point(point);
        basis.points[i] = self.points.point(point);
        basis
    }

    /// The least vector at which v_i has a negative coordinate.
    fn negative_row(&self, basis: &mut Basis<'a, D>, i: usize) -> Option<usize> {
        let mut negative: Option<usize> = None;
        for row in 0..=D {
            let is_less = negative.is_none_or(|least| basis.columns[row] < basis.columns[least]);
            if is_less && basis.coordinate(row, self.simplex[i]) == Sign::Negative {
                negative = Some(row);
            }
        }
        negative
    }

    /// The least vector with a negative coordinate in a row, or any, as long as the choice is free; whose plane has them on its positive
    /// side, and vertices, which are negated, on the other one. No vector of the basis is among
    /// them.
    fn entering(&self, plane: &Plane<D>, i: usize, is_free: bool) -> Option<Column> {
        let mut vertices = (0..=D).filter(|&at| at != i);
        let vertex = vertices.find(|&at| plane.side_of(self.simplex[at]) == Sign::Negative);
        let point = || match is_free {
            true => self.points.far_beyond(plane).map(Column::Point),
            false => self.points.first_beyond(plane).map(Column::Point),
        };
        vertex.map(Column::Vertex).or_else(point)
    }

    fn point(&self, column: Column) -> &'a [f64; D] {
        match column {
            Column::Vertex(at) => self.simplex[at],
            Column::Point(at) => self.points.point(at),
        }
    }
}

impl Column {
    fn is_negated(self) -> bool {
        matches!(self, Self::Vertex(_))
    }
}

impl<'a, const D: usize> Basis<'a, D> {
    /// The sign of a point's coordinate at the vector in `row`.
    fn coordinate(&mut self, row: usize, point: &'a [f64; D]) -> Sign {
        let kept = std::mem::replace(&mut self.points[row], point);
        let sign = orientation(&self.points[..=D]) * self.orientation;
        self.points[row] = kept;
        if self.columns[row].is_negated() { -sign } else { sign }
    }

    /// Puts another vector, whose coordinate in `row` is not zero, in that row's place.
    fn exchange(&mut self, row: usize, column: Column, point: &'a [f64; D]) {
        self.columns[row] = column;
        self.points[row] = point;
        self.orientation = orientation(&self.points[..=D]);
    }

    /// The plane through all but the vector in `row`, with the points of the hull, whose
    /// coordinates there are not negative, on its negative side or in it.
    fn plane(&self, row: usize) -> Plane<D> {
        let points = std::array::from_fn(|k| *self.points[k + usize::from(k >= row)]);
        // The point in `row` passes D - row others on its way to the end.
        let passed = if (D - row) % 2 == 0 { self.orientation } else { -self.orientation };
        let side = if self.columns[row].is_negated() { passed } else { -passed };
        Plane::new(points, side)
    }
}
