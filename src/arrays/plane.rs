//! Planes with a positive and a negative side, and exact tests of points against them.

use crate::mesh::MAX_DIM;
use crate::numerics::{Hyperplane, Sign, orientation};

/// Hyperplane through `D` points with a positive side. Where it separates a hull, no point of the
/// hull is strictly on that side.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane<const D: usize> {
    points: [[f64; D]; D],
    /// Orientation of the points followed by a point on the positive side.
    side: Sign,
    /// Hyperplane in doubles that filters exact tests; `None` if doubles cannot represent it.
    filter: Option<Hyperplane<D>>,
}

impl<const D: usize> Plane<D> {
    /// Returns the plane through `points`, of which `side` is the orientation with a point on the
    /// positive side.
    pub fn new(points: [[f64; D]; D], side: Sign) -> Self {
        let filter = Hyperplane::new(&points);
        let filter = if side == Sign::Positive { filter } else { filter.map(Hyperplane::turned) };
        Self { points, side, filter }
    }

    /// Returns the plane of the facet opposite vertex `i` of a positively oriented simplex, with
    /// the simplex on its positive side.
    pub fn of_facet(simplex: &[&[f64; D]], i: usize) -> Self {
        let points = std::array::from_fn(|k| *simplex[k + usize::from(k >= i)]);
        // The vertex passes D - i others on its way to the end.
        let side = if (D - i) % 2 == 0 { Sign::Positive } else { Sign::Negative };
        Self::new(points, side)
    }

    /// Returns the plane with its sides exchanged.
    pub fn turned(self) -> Self {
        Self { side: -self.side, filter: self.filter.map(Hyperplane::turned), ..self }
    }

    /// Returns true if no vertex of a simplex is strictly on the negative side.
    pub fn separates(&self, simplex: &[&[f64; D]]) -> bool {
        simplex.iter().all(|vertex| self.side_of(vertex) != Sign::Negative)
    }

    /// Returns true if a point is strictly on the positive side.
    pub fn has_beyond(&self, point: &[f64; D]) -> bool {
        self.side_of(point) == Sign::Positive
    }

    /// Returns a lower bound of a point's height over the plane, as [`Hyperplane::least_at`] does;
    /// minus infinity without a filter.
    pub fn least_at(&self, point: &[f64; D]) -> f64 {
        self.filter.as_ref().map_or(f64::NEG_INFINITY, |filter| filter.least_at(point))
    }

    /// Returns an upper bound of the height over the plane of all points in a box, as
    /// [`Hyperplane::most_in`] does; infinity without a filter.
    pub fn most_in(&self, low: &[f64; D], high: &[f64; D]) -> f64 {
        self.filter.as_ref().map_or(f64::INFINITY, |filter| filter.most_in(low, high))
    }

    /// Returns the side that a point is on: zero for a point in the plane.
    pub fn side_of(&self, point: &[f64; D]) -> Sign {
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
