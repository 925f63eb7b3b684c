//! Affinely independent points among many.

use super::orientation::orientation;

/// Indices of affinely independent points among `count`, greedily: index 0, then each index whose
/// point is not in the affine hull of those taken before, until `D + 1` are found. Empty if `count`
/// is zero; otherwise the length less one is the affine rank of all the points.
///
/// `point(i)` gives the finite coordinates of point i. Exact. O(`count` * D) orientation tests in
/// the worst case, D + 1 calls of `point` on generic input.
pub fn affine_basis<const D: usize>(count: usize, point: impl Fn(usize) -> [f64; D]) -> Vec<usize> {
    const { assert!(D >= 2 && D <= 8) };
    let mut basis = Basis::<D> { points: Vec::new(), columns: (0..D).collect() };
    let mut taken = Vec::with_capacity(D + 1);
    for i in 0..count {
        if basis.extend_by(point(i)) {
            taken.push(i);
            if taken.len() == D + 1 {
                break;
            }
        }
    }
    taken
}

/// Independent points. With r + 1 of them, the first r of `columns` are coordinates on which their
/// projections are independent already.
struct Basis<const D: usize> {
    points: Vec<[f64; D]>,
    columns: Vec<usize>,
}

impl<const D: usize> Basis<D> {
    /// Takes `point` if it is outside the affine hull. With r independent rows on r columns, a
    /// further row is independent iff one of the minors of r + 1 rows on those columns and one more
    /// is not zero.
    fn extend_by(&mut self, point: [f64; D]) -> bool {
        let size = self.points.len();
        self.points.push(point);
        if size == 0 {
            return true;
        }
        for other in size - 1..D {
            self.columns.swap(size - 1, other);
            if self.minor_is_nonzero() {
                return true;
            }
            self.columns.swap(size - 1, other);
        }
        self.points.pop();
        false
    }

    /// Whether the points, one more than the columns looked at, are independent on those.
    fn minor_is_nonzero(&self) -> bool {
        match self.points.len() - 1 {
            1 => self.points[0][self.columns[0]] != self.points[1][self.columns[0]],
            2 => self.projection_is_full::<2>(),
            3 => self.projection_is_full::<3>(),
            4 => self.projection_is_full::<4>(),
            5 => self.projection_is_full::<5>(),
            6 => self.projection_is_full::<6>(),
            7 => self.projection_is_full::<7>(),
            _ => self.projection_is_full::<8>(),
        }
    }

    fn projection_is_full<const R: usize>(&self) -> bool {
        let projected: Vec<[f64; R]> =
            self.points.iter().map(|p| std::array::from_fn(|j| p[self.columns[j]])).collect();
        let simplex: Vec<&[f64; R]> = projected.iter().collect();
        !orientation(&simplex).is_zero()
    }
}
