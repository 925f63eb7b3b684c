//! Whether the interior of a simplex meets the hull of some points, by exact signs.
//!
//! The simplex has the vertices v. Its interior meets the hull of the points a just if for each vertex
//! v_i there are factors, none negative, with v_i + sum of s_j v_j (j other than i) = sum of t a, where
//! v and a stand for vectors with a one beside the coordinates: all these equations together have
//! positive factors at all v. Each is a linear program. The dual simplex method solves it with nothing
//! but signs of determinants, which are orientations, and by the rule of the least index (R. G. Bland,
//! "New finite pivoting rules for the simplex method", 1977) it ends.

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
    /// A plane that separates the interior of the simplex from the hull of the points; `None` if they
    /// have a point in common.
    pub fn separation(&self) -> Option<Plane<D>> {
        (0..=D).find_map(|i| self.separation_at(i))
    }

    /// The same as far as it is decided by whether v_i is such a sum.
    fn separation_at(&self, i: usize) -> Option<Plane<D>> {
        let Some(first) = self.beyond_facet(i) else {
            return Some(self.facet(i));
        };
        let mut basis = self.start(i, first);
        while let Some(row) = self.negative_row(&basis, i) {
            let Some(column) = self.entering(&basis, row, i) else {
                return Some(self.plane(&basis, row));
            };
            self.exchange(&mut basis, row, column);
        }
        None
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
    fn start(&self, i: usize, point: usize) -> Basis<'a, D> {
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

    /// The sign of a point's coordinate at the vector in `row` of the basis.
    fn coordinate(&self, basis: &mut Basis<'a, D>, row: usize, point: &'a [f64; D]) -> Sign {
        let kept = std::mem::replace(&mut basis.points[row], point);
        let sign = orientation(&basis.points[..=D]) * basis.orientation;
        basis.points[row] = kept;
        if let Column::Vertex(_) = basis.columns[row] { -sign } else { sign }
    }

    /// Where v_i has a negative coordinate, at the least of the vectors.
    fn negative_row(&self, basis: &Basis<'a, D>, i: usize) -> Option<usize> {
        let mut basis = Basis { ..*basis };
        let rows = (0..=D).filter(|&row| {
            self.coordinate(&mut basis, row, self.simplex[i]) == Sign::Negative
        });
        let columns = basis_columns(rows, basis.columns);
        columns.min_by_key(|&(_, column)| column).map(|(row, _)| row)
    }

    /// The least vector outside the basis with a negative coordinate in `row`.
    fn entering(&self, basis: &Basis<'a, D>, row: usize, i: usize) -> Option<Column> {
        let mut basis = Basis { ..*basis };
        let in_basis = basis.columns;
        let mut is_wanted = |column: &Column| {
            let (point, negated) = match *column {
                Column::Vertex(at) => (self.simplex[at], true),
                Column::Point(at) => (&self.points[at], false),
            };
            if in_basis[..=D].contains(column) {
                return false;
            }
            let sign = self.coordinate(&mut basis, row, point);
            (if negated { -sign } else { sign }) == Sign::Negative
        };
        let mut vertices = (0..=D).filter(|&at| at != i).map(Column::Vertex);
        let mut points = (0..self.points.len()).map(Column::Point);
        vertices.find(&mut is_wanted).or_else(|| points.find(&mut is_wanted))
    }
}
