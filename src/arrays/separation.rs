//! Whether the interior of a simplex meets the hull of some points, by exact signs.
//!
//! The simplex has the vertices v. Its interior meets the hull of the points a just if for each
//! vertex v_i there are factors, none negative, with v_i + sum of s_j v_j (j other than i) = sum of
//! t a, where v and a stand for vectors with a one beside the coordinates: all these equations
//! together have positive factors at all v. Each is a linear program. The dual simplex method
//! solves it with nothing but signs of determinants, which are orientations, and by the rule of the
//! least index (R. G. Bland, "New finite pivoting rules for the simplex method", 1977) it ends.

use crate::memory::{AllocResult, TryGrow};
use crate::mesh::MAX_DIM;
use crate::numerics::{Sign, orientation};

/// A hyperplane through `dim` points with no point of the hull strictly on its positive side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Plane<const D: usize> {
    points: [[f64; D]; D],
    /// The orientation of those points and one on the positive side.
    side: Sign,
}

impl<const D: usize> Plane<D> {
    /// Whether no vertex of a simplex is strictly on the side of the hull.
    pub fn separates(&self, simplex: &[&[f64; D]]) -> bool {
        let mut points = [&self.points[0]; MAX_DIM + 1];
        points.iter_mut().zip(&self.points).for_each(|(to, point)| *to = point);
        simplex.iter().all(|vertex| {
            points[D] = vertex;
            orientation(&points[..=D]) * self.side != Sign::Negative
        })
    }
}

/// A simplex that is positively oriented, and points.
pub(super) struct Pair<'a, const D: usize> {
    pub simplex: &'a [&'a [f64; D]],
    pub points: &'a [[f64; D]],
}

/// A vector of the basis: a vertex of the simplex, negated, or one of the points.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Column {
    Vertex(usize),
    Point(usize),
}

/// `D + 1` independent vectors.
struct Basis<'a, const D: usize> {
    columns: [Column; MAX_DIM + 1],
    points: [&'a [f64; D]; MAX_DIM + 1],
    /// Of all these points.
    orientation: Sign,
}

impl<'a, const D: usize> Pair<'a, D> {
    /// A plane that separates the interior of the simplex from the hull of the points; `None` if
    /// they have a point in common. Adds the points that came into a basis to `used`.
    pub fn separation(&self, used: &mut Vec<usize>) -> AllocResult<Option<Plane<D>>> {
        for i in 0..=D {
            if let Some(plane) = self.separation_at(i, used)? {
                return Ok(Some(plane));
            }
        }
        Ok(None)
    }

    /// The same as far as it is decided by whether v_i is such a sum.
    fn separation_at(&self, i: usize, used: &mut Vec<usize>) -> AllocResult<Option<Plane<D>>> {
        let Some(first) = self.beyond_facet(i) else {
            return Ok(Some(self.facet(i)));
        };
        used.try_push(first)?;
        let mut basis = self.first_basis(i, first);
        while let Some(row) = self.negative_row(&mut basis, i) {
            let Some(column) = self.entering(&mut basis, row, i) else {
                return Ok(Some(basis.plane(row)));
            };
            if let Column::Point(at) = column {
                used.try_push(at)?;
            }
            basis.exchange(row, column, self.point(column));
        }
        Ok(None)
    }

    /// The first of the points on the side of vertex `i` of the opposite facet.
    fn beyond_facet(&self, i: usize) -> Option<usize> {
        let mut points = [self.simplex[0]; MAX_DIM + 1];
        points[..=D].copy_from_slice(self.simplex);
        self.points.iter().position(|point| {
            points[i] = point;
            orientation(&points[..=D]) == Sign::Positive
        })
    }

    /// The plane of the facet opposite vertex `i`, with the simplex on its positive side.
    fn facet(&self, i: usize) -> Plane<D> {
        let points = std::array::from_fn(|k| *self.simplex[k + usize::from(k >= i)]);
        // The vertex passes D - i others on its way to the end.
        let side = if (D - i) % 2 == 0 { Sign::Positive } else { Sign::Negative };
        Plane { points, side }
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
        basis.points[i] = &self.points[point];
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

    /// The least vector outside the basis with a negative coordinate in `row`.
    fn entering(&self, basis: &mut Basis<'a, D>, row: usize, i: usize) -> Option<Column> {
        let vertices = (0..=D).filter(|&at| at != i).map(Column::Vertex);
        let points = (0..self.points.len()).map(Column::Point);
        vertices.chain(points).find(|&column| {
            let sign = basis.coordinate(row, self.point(column));
            let sign = if column.is_negated() { -sign } else { sign };
            sign == Sign::Negative && !basis.columns[..=D].contains(&column)
        })
    }

    fn point(&self, column: Column) -> &'a [f64; D] {
        match column {
            Column::Vertex(at) => self.simplex[at],
            Column::Point(at) => &self.points[at],
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
        Plane { points, side }
    }
}
