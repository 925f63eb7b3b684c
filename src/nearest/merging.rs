//! Points that are nearer to each other than a program that wrote them can have meant, made equal:
//! the corners of a surface, for instance, each of which a file has several times.

use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::{AllocResult, Sets, collected, filled, with_capacity};
use crate::mesh::NONE;
use crate::numerics::distance;

/// Largest distance of points that may be merged, relative to the diagonal of the box of all.
const LARGEST_RATIO: f64 = 1e-3;

/// Size of the cells of a grid, relative to the distance of points that are merged.
const CELL: f64 = 4.0;

/// Gives points that are at most `ratio` times the diagonal of the box of all from each other the
/// coordinates of the first of them, and returns the number of points that it moves. Points that a
/// chain of such steps joins are one. `coordinates` has `dim` numbers for each point. O(n log n)
/// where few points are near each other.
///
/// # Errors
/// `InvalidArgument` (a `dim` other than 2 and 3, a length that is no multiple of it, a `ratio`
/// that is not from 0 to 0.001), `NonFinite`, `OutOfMemory`; the coordinates are then as they were.
pub fn merge_points(dim: usize, coordinates: &mut [f64], ratio: f64) -> Result<usize> {
    if !(0.0..=LARGEST_RATIO).contains(&ratio) {
        let message = message!("ratio is {ratio}; it must be from 0 to {LARGEST_RATIO}");
        return Err(Error::invalid(message));
    }
    if !matches!(dim, 2 | 3) {
        return Err(Error::invalid(message!("dim is {dim}; points are merged in 2D and 3D")));
    }
    if let Some(at) = coordinates.iter().position(|x| !x.is_finite()) {
        let message = message!("coordinates[{at}] is {}; it must be finite", coordinates[at]);
        return Err(Error::new(ErrorKind::NonFinite, message));
    }
    if coordinates.len() % dim != 0 {
        return Err(Error::invalid(message!(
            "coordinates has length {}; it must be a multiple of the dimension, {dim}",
            coordinates.len()
        )));
    }
    match dim {
        2 => merge::<2>(coordinates, ratio),
        _ => merge::<3>(coordinates, ratio),
    }
}

fn merge<const D: usize>(coordinates: &mut [f64], ratio: f64) -> Result<usize> {
    let point = |x: &[f64]| -> [f64; D] { std::array::from_fn(|k| x[k]) };
    let points = collected(coordinates.chunks_exact(D).map(point))?;
    let Some(first) = points.first() else { return Ok(0) };
    let (mut low, mut high) = (*first, *first);
    for x in &points {
        for k in 0..D {
            (low[k], high[k]) = (low[k].min(x[k]), high[k].max(x[k]));
        }
    }
    // Halves of what may be too large for doubles.
    let half = |x: &[f64; D]| x.map(|x| 0.5 * x);
    let least = 2.0 * ratio * distance(&half(&low), &half(&high));
    if !(least > 0.0 && (CELL * least).is_finite()) {
        return Ok(0);
    }
    let firsts = Grid::new(&points, low, least)?.firsts(&points)?;
    let mut moved = 0;
    for (own, first) in coordinates.chunks_exact_mut(D).zip(firsts) {
        let first = &points[first as usize];
        moved += usize::from(own != first);
        own.copy_from_slice(first);
    }
    Ok(moved)
}

/// Points by the cells of a grid.
struct Grid<const D: usize> {
    low: [f64; D],
    /// Largest distance of points that are merged.
    least: f64,
    /// Cell and point, sorted.
    points: Vec<([i64; D], u32)>,
}

impl<const D: usize> Grid<D> {
    fn new(points: &[[f64; D]], low: [f64; D], least: f64) -> AllocResult<Self> {
        let mut grid = Self { low, least, points: with_capacity(points.len())? };
        for (x, number) in points.iter().zip(0u32..) {
            grid.points.push((grid.cell(x), number));
        }
        grid.points.sort_unstable();
        Ok(grid)
    }

    fn cell(&self, x: &[f64; D]) -> [i64; D] {
        let size = 0.5 * CELL * self.least;
        std::array::from_fn(|k| ((0.5 * x[k] - 0.5 * self.low[k]) / size).floor() as i64)
    }

    /// Returns for each point the first one of those that it is one with.
    fn firsts(&self, points: &[[f64; D]]) -> AllocResult<Vec<u32>> {
        let mut sets = Sets::new(points.len())?;
        for (x, number) in points.iter().zip(0u32..) {
            let [from, to] = [-1.0, 1.0].map(|side| self.cell(&x.map(|x| x + side * self.least)));
            let mut cell = from;
            loop {
                let begin = self.points.partition_point(|own| *own < (cell, 0));
                let own = self.points[begin..].iter().take_while(|own| own.0 == cell);
                for &(_, other) in own.take_while(|own| own.1 < number) {
                    if distance(x, &points[other as usize]) <= self.least {
                        sets.join(number as usize, other as usize);
                    }
                }
                // The next cell of the box, as a number is counted up.
                let Some(axis) = (0..D).find(|&k| cell[k] < to[k]) else { break };
                cell[axis] += 1;
                cell[..axis].copy_from_slice(&from[..axis]);
            }
        }
        let mut first_of = filled(points.len(), NONE)?;
        collected((0..points.len() as u32).map(|number| {
            let first = &mut first_of[sets.find(number as usize)];
            *first = number.min(*first);
            *first
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_take_the_place_of_the_first_that_is_near() {
        let mut points =
            [[0.0, 0.0, 0.0], [1e3, 0.0, 0.0], [3e-33, -0.0, 1e-10], [1e3, 1e-10, 0.0]];
        assert_eq!(merge_points(3, points.as_flattened_mut(), 1e-12).unwrap(), 2);
        assert_eq!(points, [[0.0; 3], [1e3, 0.0, 0.0], [0.0; 3], [1e3, 0.0, 0.0]]);
        // Chains are one, and what is farther stays.
        let mut chain: Vec<f64> =
            (0..40).map(|at| if at % 2 == 0 { f64::from(at) } else { 0.0 }).collect();
        chain.extend([1e6, 0.0]);
        let before = chain.clone();
        assert_eq!(merge_points(2, &mut chain, 1.9e-6).unwrap(), 0);
        assert_eq!(chain, before);
        assert_eq!(merge_points(2, &mut chain, 2.1e-6).unwrap(), 19);
        assert!(chain[..40].iter().all(|&x| x == 0.0) && chain[40..] == [1e6, 0.0]);
        assert_eq!(merge_points(2, &mut [], 1e-3).unwrap(), 0);
        assert_eq!(merge_points(2, &mut [5.0; 8], 1e-3).unwrap(), 0);
    }

    /// Holds of random points that what is merged is what all pairs make one, at all exponents.
    #[test]
    fn all_pairs_agree() {
        let mut state = 1u64;
        let mut unit = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        for scale in [1.0, 1e-300, 1e300] {
            let points: Vec<[f64; 3]> =
                (0..400).map(|_| [0, 1, 2].map(|_| scale * (unit() - 0.5))).collect();
            let mut merged = points.clone();
            let ratio = 0.001;
            // Clusters: half of the points are near others.
            for at in 0..200 {
                merged[2 * at + 1] = merged[2 * at].map(|x| x + 1e-3 * scale * (unit() - 0.5));
            }
            let given = merged.clone();
            let moved = merge_points(3, merged.as_flattened_mut(), ratio).unwrap();
            let bound = |k: usize, pick: fn(f64, f64) -> f64| {
                given.iter().map(|x| 0.5 * x[k]).reduce(pick).unwrap()
            };
            let [low, high] = [f64::min, f64::max].map(|pick| [0, 1, 2].map(|k| bound(k, pick)));
            let least = 2.0 * ratio * distance(&low, &high);
            let mut sets = Sets::new(400).unwrap();
            for a in 0..400 {
                for b in 0..a {
                    if distance(&given[a], &given[b]) <= least {
                        sets.join(a, b);
                    }
                }
            }
            let first = |at: usize, sets: &mut Sets| {
                let own = sets.find(at);
                (0..400).find(|&other| sets.find(other) == own).unwrap()
            };
            for at in 0..400 {
                assert_eq!(merged[at], given[first(at, &mut sets)]);
            }
            assert!(moved > 100 && moved == (0..400).filter(|&at| merged[at] != given[at]).count());
        }
    }

    #[test]
    fn what_cannot_be_merged_is_refused() {
        let refusal = |dim, points: &mut [f64], ratio| {
            merge_points(dim, points, ratio).unwrap_err().message().to_owned()
        };
        for ratio in [-1e-9, 0.002, f64::NAN] {
            let rule = format!("ratio is {ratio}; it must be from 0 to 0.001");
            assert_eq!(refusal(3, &mut [0.0; 3], ratio), rule);
        }
        assert_eq!(refusal(4, &mut [0.0; 4], 0.0), "dim is 4; points are merged in 2D and 3D");
        let rule = "coordinates has length 4; it must be a multiple of the dimension, 3";
        assert_eq!(refusal(3, &mut [0.0; 4], 0.0), rule);
        assert_eq!(
            refusal(2, &mut [0.0, f64::INFINITY], 0.0),
            "coordinates[1] is inf; it must be finite"
        );
    }
}
