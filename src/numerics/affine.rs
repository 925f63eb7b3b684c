//! Affinely independent points among many.

use super::MAX_DIM;
use super::orientation;
use std::ops::Deref;

/// Returns indices of affinely independent points among `count`, greedily: index 0, then each index
/// whose point is not in the affine hull of those taken before, until `D + 1` are found. Empty if
/// `count` is zero; otherwise the length less one is the affine rank of all the points.
///
/// `point(i)` gives the finite coordinates of point i. Exact. O(`count` * D) orientation tests in
/// the worst case, D + 1 calls of `point` on generic input.
pub fn affine_basis<const D: usize>(
    count: usize,
    point: impl Fn(usize) -> [f64; D],
) -> AffineBasis {
    const { assert!(D >= 2 && D <= MAX_DIM) };
    let mut basis = Basis::<D> {
        points: [[0.0; D]; MAX_DIM + 1],
        size: 0,
        columns: std::array::from_fn(|axis| axis),
    };
    let mut taken = AffineBasis { indices: [0; MAX_DIM + 1], size: 0 };
    for i in 0..count {
        if basis.extend_by(point(i)) {
            taken.indices[taken.size] = i;
            taken.size += 1;
            if taken.size == D + 1 {
                break;
            }
        }
    }
    taken
}

/// Indices that [`affine_basis`] found, ascending. Derefs to a slice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AffineBasis {
    indices: [usize; MAX_DIM + 1],
    size: usize,
}

impl Deref for AffineBasis {
    type Target = [usize];

    fn deref(&self) -> &[usize] {
        &self.indices[..self.size]
    }
}

/// Affinely independent points. With r + 1 of them, the first r of `columns` are coordinates on
/// which their projections are independent already.
struct Basis<const D: usize> {
    points: [[f64; D]; MAX_DIM + 1],
    size: usize,
    columns: [usize; D],
}

impl<const D: usize> Basis<D> {
    /// Adds `point` if it is outside the affine hull. With r independent rows on r columns, a
    /// further row is independent iff one of the minors of r + 1 rows on those columns and one more
    /// is not zero.
    fn extend_by(&mut self, point: [f64; D]) -> bool {
        let size = self.size;
        self.points[size] = point;
        self.size += 1;
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
        self.size = size;
        false
    }

    /// Returns true if the points are affinely independent on the first columns, of which there is
    /// one fewer.
    fn minor_is_nonzero(&self) -> bool {
        match self.size - 1 {
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
        let projected: [[f64; R]; MAX_DIM + 1] =
            self.points.map(|p| std::array::from_fn(|j| p[self.columns[j]]));
        let simplex: [&[f64; R]; MAX_DIM + 1] = projected.each_ref();
        !orientation(&simplex[..=R]).is_zero()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::*;
    use dashu_int::IBig;

    /// Returns the affine rank by integer elimination of all difference rows.
    fn rank_oracle<const D: usize>(points: &[[f64; D]]) -> usize {
        let edge = |p: &[f64; D]| -> Vec<IBig> {
            p.iter().zip(&points[0]).map(|(x, o)| integer(*x) - integer(*o)).collect()
        };
        let mut rows: Vec<Vec<IBig>> = points[1..].iter().map(edge).collect();
        let mut rank = 0;
        for column in 0..D {
            let Some(at) = (rank..rows.len()).find(|i| rows[*i][column] != IBig::ZERO) else {
                continue;
            };
            rows.swap(rank, at);
            let pivot = rows[rank].clone();
            for row in &mut rows[rank + 1..] {
                let factor = row[column].clone();
                for j in 0..D {
                    row[j] = &row[j] * &pivot[column] - &factor * &pivot[j];
                }
            }
            rank += 1;
        }
        rank
    }

    fn ranks_agree<const D: usize>(trials: usize) {
        for family in FAMILIES {
            let mut random = Random(family as u64 * 10 + D as u64);
            for trial in 0..trials {
                let mut points = points::<D>(family, 1 + trial % (D + 4), &mut random);
                flatten(&mut points, &mut random);
                let basis = affine_basis(points.len(), |i| points[i]);
                assert_eq!(basis[0], 0);
                assert!(basis.is_sorted());
                let taken: Vec<[f64; D]> = basis.iter().map(|i| points[*i]).collect();
                assert_eq!(rank_oracle(&taken) + 1, taken.len(), "{family:?} {points:?}");
                assert_eq!(rank_oracle(&points) + 1, taken.len(), "{family:?} {points:?}");
                // Greedy: what was passed over depends on what was taken before it.
                for i in (0..points.len()).filter(|i| !basis.contains(i)) {
                    let mut before: Vec<[f64; D]> =
                        basis.iter().filter(|j| **j < i).map(|j| points[*j]).collect();
                    before.push(points[i]);
                    assert!(rank_oracle(&before) + 1 < before.len(), "{family:?} {points:?}");
                }
            }
        }
    }

    /// Lowers the rank of the points now and then: some coordinates become copies of others, some
    /// points copies of others.
    fn flatten<const D: usize>(points: &mut [[f64; D]], random: &mut Random) {
        let (from, to) = (random.integer(0, D as i64 - 1), random.integer(0, D as i64 - 1));
        for i in 0..points.len() {
            points[i][to as usize] = points[i][from as usize];
            if random.bits() % 4 == 0 {
                points[i] = points[0];
            }
        }
    }

    #[test]
    fn bases_span_and_are_independent() {
        ranks_agree::<2>(60);
        ranks_agree::<3>(60);
        ranks_agree::<4>(40);
        ranks_agree::<6>(20);
        ranks_agree::<8>(12);
    }

    #[test]
    fn no_points_have_no_basis() {
        assert!(affine_basis::<3>(0, |_| unreachable!()).is_empty());
    }

    #[test]
    fn generic_input_is_left_after_the_first_simplex() {
        let calls = std::cell::Cell::new(0);
        let mut random = Random(7);
        let points = points::<5>(Family::Uniform, 100, &mut random);
        let basis = affine_basis(points.len(), |i| {
            calls.set(calls.get() + 1);
            points[i]
        });
        assert_eq!((&*basis, calls.get()), (&[0, 1, 2, 3, 4, 5][..], 6));
    }
}
