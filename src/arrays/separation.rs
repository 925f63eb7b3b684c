//! An exact test: does the interior of a simplex meet the hull of some points.
//!
//! The simplex has the vertices v. Its interior meets the hull of the points a just if for each
//! vertex v_i there are factors, none negative, with v_i + sum of s_j v_j (j other than i) = sum of
//! t a, where v and a stand for vectors with a one beside the coordinates: all these equations
//! together have positive factors at all v. Each is a linear program. The dual simplex method
//! solves it with nothing but signs of determinants, which are orientations. The rule of the least
//! index makes it end (R. G. Bland, "New finite pivoting rules for the simplex method", 1977).

use super::cloud::Cloud;
use super::plane::Plane;
use crate::mesh::MAX_DIM;
use crate::numerics::{Sign, orientation};

/// Positively oriented simplex, and the points whose hull it may meet.
pub(super) struct Pair<'a, const D: usize> {
    pub simplex: &'a [&'a [f64; D]],
    pub points: &'a Cloud<D>,
}

/// Vector of the basis: a vertex of the simplex, negated, or one of the points.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Column {
    Vertex(usize),
    Point(usize),
}

/// Number of exchanges after which the rule of the least index applies. Before, far points enter
/// the basis, which takes a few exchanges where that rule may take hundreds.
const FREE: usize = 50;

/// Basis of the linear program: `D + 1` independent vectors.
struct Basis<'a, const D: usize> {
    columns: [Column; MAX_DIM + 1],
    points: [&'a [f64; D]; MAX_DIM + 1],
    /// Orientation of the `D + 1` points of the basis.
    orientation: Sign,
}

impl<'a, const D: usize> Pair<'a, D> {
    /// Returns a plane that separates the interior of the simplex from the hull of the points;
    /// `None` if they have a point in common.
    pub fn separation(&self) -> Option<Plane<D>> {
        (0..=D).find_map(|i| self.separation_at(i))
    }

    /// Returns a separating plane if the equation of vertex `i` has no solution, and `None` if it
    /// has one.
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

    /// Returns the basis of the vertices other than `i`, and a point beyond their facet.
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

    /// Returns the row of the least vector of the basis at which vertex `i` has a negative
    /// coordinate.
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

    /// Returns a vector with a negative coordinate in the row of `plane`: the least one, or, while
    /// the choice is free, a far point. Points have one if they are on the plane's positive side;
    /// vertices, which are negated, if they are on its negative side. No vector of the basis is
    /// returned.
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
    /// Returns the sign of a point's coordinate at the basis vector in `row`.
    fn coordinate(&mut self, row: usize, point: &'a [f64; D]) -> Sign {
        let kept = std::mem::replace(&mut self.points[row], point);
        let sign = orientation(&self.points[..=D]) * self.orientation;
        self.points[row] = kept;
        if self.columns[row].is_negated() { -sign } else { sign }
    }

    /// Replaces the basis vector in `row` by another one, whose coordinate in that row must not be
    /// zero.
    fn exchange(&mut self, row: usize, column: Column, point: &'a [f64; D]) {
        self.columns[row] = column;
        self.points[row] = point;
        self.orientation = orientation(&self.points[..=D]);
    }

    /// Returns the plane through all basis vectors but the one in `row`. The points of the hull, if
    /// their coordinates in that row are not negative, are on its negative side or in it.
    fn plane(&self, row: usize) -> Plane<D> {
        let points = std::array::from_fn(|k| *self.points[k + usize::from(k >= row)]);
        // The point in `row` passes D - row others on its way to the end.
        let passed = if (D - row) % 2 == 0 { self.orientation } else { -self.orientation };
        let side = if self.columns[row].is_negated() { passed } else { -passed };
        Plane::new(points, side)
    }
}
