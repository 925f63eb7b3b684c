//! Determinants by Laplace expansion over all subsets: O(2^n n) products for n lines, no division.

use std::ops::Neg;

/// Matrix over a ring, as an expansion reads it. Its lines are rows, crossed by columns, or the
/// other way round.
pub(super) trait Matrix {
    /// Element of the ring, with other sums that are computed beside it.
    type Minor: Copy;
    /// Partial sum of the products of a minor.
    type Sum;
    /// Plus one or minus one.
    type Sign: Copy + Neg<Output = Self::Sign>;

    /// Minor of no lines.
    const ONE: Self::Minor;
    const PLUS: Self::Sign;
    const ZERO: Self::Sum;

    /// Adds `sign` * entry * `minor`, for the entry at `place` in `line`.
    fn add(
        &self,
        sum: &mut Self::Sum,
        line: usize,
        place: usize,
        sign: Self::Sign,
        minor: Self::Minor,
    );

    fn minor(&self, sum: Self::Sum) -> Self::Minor;
}

/// Sets `minors[s]`, for each set s of places from the empty one to the one before `end`, to the
/// minor of the first |s| lines and the places in s. The bits of a number are the set's members.
///
/// ```text
/// places   0 1 2 3        s = {0, 2, 3} = 0b1101
/// line 0   a . b c        minors[s] =   i * minors[{0, 2}]
/// line 1   d . e f                    - h * minors[{0, 3}]
/// line 2   g . h i                    + g * minors[{2, 3}]
/// ```
#[inline(always)]
pub(super) fn expand<M: Matrix, const SETS: usize>(
    matrix: &M,
    end: usize,
    minors: &mut [M::Minor; SETS],
) {
    minors[0] = M::ONE;
    for set in 1..end {
        let line = set.count_ones() as usize - 1;
        // Places from the highest: along the last line, signs alternate from plus.
        let (mut rest, mut sign, mut sum) = (set, M::PLUS, M::ZERO);
        while let Some(place) = rest.checked_ilog2() {
            rest ^= 1 << place;
            matrix.add(&mut sum, line, place as usize, sign, minors[set ^ (1 << place)]);
            sign = -sign;
        }
        minors[set] = matrix.minor(sum);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows of integers.
    struct Rows([[i64; 4]; 3]);

    impl Matrix for Rows {
        type Minor = i64;
        type Sum = i64;
        type Sign = i64;
        const ONE: i64 = 1;
        const PLUS: i64 = 1;
        const ZERO: i64 = 0;

        fn add(&self, sum: &mut i64, line: usize, place: usize, sign: i64, minor: i64) {
            *sum += sign * self.0[line][place] * minor;
        }

        fn minor(&self, sum: i64) -> i64 {
            sum
        }
    }

    #[test]
    fn minors_are_those_of_the_first_lines() {
        let rows = Rows([[1, 2, 3, -1], [4, 5, 7, 2], [-2, 0, 1, 3]]);
        let mut minors = [i64::MAX; 16];
        expand(&rows, 15, &mut minors);
        assert_eq!(minors[..4], [1, 1, 2, 5 - 8]);
        assert_eq!(minors[0b101], 7 - 12);
        // Along the third line.
        assert_eq!(minors[0b111], -2 * minors[0b110] + minors[0b011]);
        assert_eq!(minors[0b110], 2 * 7 - 3 * 5);
        assert_eq!(minors[0b1101], -2 * minors[0b1100] - minors[0b1001] + 3 * minors[0b101]);
        assert_eq!((minors[0b1001], minors[0b1100]), (2 + 4, 3 * 2 + 7));
        assert_eq!(minors[15], i64::MAX, "sets from the end on are left alone");
    }
}
