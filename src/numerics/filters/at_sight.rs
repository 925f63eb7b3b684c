//! Degenerate positions that comparisons of coordinates tell, without arithmetic that rounds: those
//! of grids, of prisms, and of parts whose sides run along the axes. Filters cannot tell these, and
//! integers take thousands of operations.

use crate::numerics::{DoubleDouble, MAX_SIZE};

/// Returns true only if points lie in one hyperplane: where two are equal, all have a coordinate in
/// common, or two pairs of them lie along one axis and so in one plane.
pub fn are_flat_at_sight<const D: usize>(simplex: &[&[f64; D]]) -> bool {
    let have_one_coordinate = || (0..D).any(|k| simplex[1..].iter().all(|p| p[k] == simplex[0][k]));
    let are_equal = |at: usize| simplex[..at].contains(&simplex[at]);
    have_one_coordinate()
        || (1..simplex.len()).any(are_equal)
        || have_pairs_along_one_axis(simplex, |_, _| true)
}

/// Returns true only if the sphere through points holds another point too, or the points lie in one
/// hyperplane: where two pairs of all these lie along one axis and have the same middle there. Such
/// four are on one circle, as corners of a rectangle or of a trapezium with equal legs, or on one
/// line; with any other points they have no sphere or one through all.
pub fn are_cospherical_at_sight<const D: usize>(simplex: &[&[f64; D]], q: &[f64; D]) -> bool {
    let mut points = [q; MAX_SIZE + 1];
    points[..=D].copy_from_slice(simplex);
    have_pairs_along_one_axis(&points[..D + 2], have_one_middle)
}

/// Returns true only if two numbers have the same sum as two others, and always unless a sum, or a
/// step on the way to it, is out of range: what is told of its parts is no number then.
fn have_one_middle([a, b]: [f64; 2], [c, d]: [f64; 2]) -> bool {
    let sum = |a: f64, b: f64| DoubleDouble::difference(a, -b);
    let (one, other) = (sum(a, b), sum(c, d));
    let are_equal = |one: [f64; 2]| one == [c, d];
    are_equal([a, b]) || are_equal([b, a]) || one.high == other.high && one.low == other.low
}

/// Returns true if two pairs of points differ in one and the same coordinate alone, and `do_match`
/// says so of their values of it. Pairs that share a point count: three points are on a line then.
fn have_pairs_along_one_axis<const D: usize>(
    points: &[&[f64; D]],
    do_match: impl Fn([f64; 2], [f64; 2]) -> bool,
) -> bool {
    for i in 0..points.len() {
        for j in i + 1..points.len() {
            let Some(axis) = axis_between(points[i], points[j]) else { continue };
            let values = |a: usize, b: usize| [points[a][axis], points[b][axis]];
            // Pairs with an earlier point were seen with that one first.
            let later = || i + 1..points.len();
            let does_match = |a: usize, b: usize| {
                axis_between(points[a], points[b]) == Some(axis)
                    && do_match(values(i, j), values(a, b))
            };
            if later().any(|a| later().any(|b| a < b && does_match(a, b))) {
                return true;
            }
        }
    }
    false
}

/// Returns the axis of the only coordinate in which two points differ.
#[inline]
fn axis_between<const D: usize>(a: &[f64; D], b: &[f64; D]) -> Option<usize> {
    let mut axis = None;
    for k in 0..D {
        if a[k] != b[k] {
            if axis.is_some() {
                return None;
            }
            axis = Some(k);
        }
    }
    axis
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::*;

    /// Checks two pairs along an axis, with one middle if it is `is_even`, among other points, and
    /// the same with one coordinate a unit in the last place off.
    fn pairs_are_told<const D: usize>(random: &mut Random, family: Family, is_even: bool) {
        let mut points = points::<D>(family, D + 2, random);
        let axis = random.integer(0, D as i64 - 1) as usize;
        let at = random.integer(0, D as i64 + 1) as usize;
        let [a, b, c, d] = [0, 1, 2, 3].map(|k| (at + k) % (D + 2));
        let [low, high] = [points[a][axis], points[b][axis]];
        (points[b], points[d]) = (points[a], points[c]);
        (points[b][axis], points[d][axis]) = (high, if is_even { low } else { high });
        if is_even {
            points[c][axis] = high;
        }
        let (simplex, q) = (references(&points[..=D]), &points[D + 1]);
        assert!(low == high || !is_even || are_cospherical_at_sight(&simplex, q), "{points:?}");
        all_is_right(&points);
        let axis = random.integer(0, D as i64 - 1) as usize;
        points[a][axis] = points[a][axis].next_up();
        if points[a][axis].is_finite() {
            all_is_right(&points);
        }
    }

    /// Checks that what is told at sight of points is so in integers, of the first `D + 1` too.
    fn all_is_right<const D: usize>(points: &[[f64; D]]) -> [bool; 2] {
        let (simplex, q) = (references(&points[..=D]), &points[D + 1]);
        let told = [are_flat_at_sight(&simplex), are_cospherical_at_sight(&simplex, q)];
        assert!(!told[0] || orientation_oracle(&simplex).is_zero(), "{points:?}");
        assert!(!told[1] || in_ball_oracle(&simplex, q).is_zero(), "{points:?}");
        told
    }

    fn all_that_is_told_is_right<const D: usize>(trials: usize) {
        for family in FAMILIES {
            let mut random = Random(family as u64 * 100 + 70 + D as u64);
            let mut told = [0, 0];
            for trial in 0..trials {
                let own = all_is_right(&points::<D>(family, D + 2, &mut random));
                told = [0, 1].map(|k| told[k] + usize::from(own[k]));
                pairs_are_told::<D>(&mut random, family, trial % 2 == 0);
            }
            assert!(family != Family::Grid || D > 3 || told.iter().all(|&told| told > 0));
            assert!(family != Family::Uniform || told == [0, 0]);
        }
    }

    #[test]
    fn what_is_told_at_sight_is_so_in_integers() {
        all_that_is_told_is_right::<2>(200);
        all_that_is_told_is_right::<3>(200);
        all_that_is_told_is_right::<4>(60);
        all_that_is_told_is_right::<5>(20);
        all_that_is_told_is_right::<8>(2);
    }

    #[test]
    fn sides_of_prisms_are_flat_and_their_corners_on_circles() {
        let [a, b] = [[0.1, 0.7], [-0.3, 0.2]];
        let corner = |[x, y]: [f64; 2], z: f64| [x, y, z];
        let side = [corner(a, 0.1), corner(b, 0.1), corner(a, 0.9), corner(b, 0.9)];
        assert!(are_flat_at_sight(&references(&side)));
        let other = [3.3, 0.1, 7.7];
        let simplex = [&side[0], &side[1], &other, &side[3]];
        assert!(are_cospherical_at_sight(&simplex, &side[2]));
        assert!(!are_cospherical_at_sight(&simplex, &corner(a, 0.9f64.next_up())));
        // A trapezium about x = 0, and one that leans.
        let even = [[-0.1, 0.2, 0.3], [0.1, 0.2, 0.3], [-0.7, 0.9, 0.4], other];
        assert!(are_cospherical_at_sight(&references(&even), &[0.7, 0.9, 0.4]));
        assert!(!are_cospherical_at_sight(&references(&even), &[0.8, 0.9, 0.4]));
    }
}
