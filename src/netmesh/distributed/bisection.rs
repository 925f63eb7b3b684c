//! Space in parts of about equal weight: recursive bisection along coordinates (Berger and Bokhari,
//! "A partitioning strategy for nonuniform problems on multiprocessors", 1987), in axes that are
//! turned from phase to phase, so that the planes of one phase cross those of another.

use crate::error::Result;
use crate::memory::TryGrow;
use std::ops::Range;

/// Halves of space until there are as many parts as asked for.
pub struct Bisection<const D: usize> {
    nodes: Vec<Node<D>>,
}

/// Plane that halves space: points whose product with `direction` is below `limit` are in the first
/// half.
struct Node<const D: usize> {
    direction: [f64; D],
    limit: f64,
    halves: [Half; 2],
}

#[derive(Clone, Copy)]
enum Half {
    Node(u32),
    Part(u32),
}

impl<const D: usize> Bisection<D> {
    /// Divides space into `count` parts that have about as many of `points`, whose order does not
    /// matter. A part may have none if many of them are equal. Planes of four phases that follow
    /// each other are not parallel. O(n log n log `count`).
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn new(mut points: Vec<[f64; D]>, count: usize, phase: usize) -> Result<Self> {
        let mut cut = Self { nodes: Vec::new() };
        let mut values = Vec::new();
        let directions = directions::<D>(phase);
        cut.halve(&mut points, &mut values, &directions, 0..count as u32)?;
        Ok(cut)
    }

    /// Returns the part that `x` is in.
    pub fn part_of(&self, x: &[f64; D]) -> u32 {
        let mut half = if self.nodes.is_empty() { Half::Part(0) } else { Half::Node(0) };
        loop {
            match half {
                Half::Part(part) => return part,
                Half::Node(node) => {
                    let Node { direction, limit, halves } = &self.nodes[node as usize];
                    half = halves[usize::from(product(direction, x) >= *limit)];
                }
            }
        }
    }

    fn halve(
        &mut self,
        points: &mut [[f64; D]],
        values: &mut Vec<(f64, [f64; D])>,
        directions: &[[f64; D]; D],
        parts: Range<u32>,
    ) -> Result<Half> {
        let count = parts.end - parts.start;
        if count == 1 {
            return Ok(Half::Part(parts.start));
        }
        let direction = widest(points, directions);
        values.clear();
        for point in points.iter() {
            values.try_push((product(&direction, point), *point))?;
        }
        values.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let middle = parts.start + count / 2;
        let at = (points.len() as u64 * u64::from(count / 2) / u64::from(count)) as usize;
        let limit = values.get(at).map_or(0.0, |value| value.0);
        let at = values.partition_point(|value| value.0 < limit);
        for (point, value) in points.iter_mut().zip(values.iter()) {
            *point = value.1;
        }
        let node = self.nodes.len();
        self.nodes.try_push(Node { direction, limit, halves: [Half::Part(0); 2] })?;
        let (below, above) = points.split_at_mut(at);
        let halves = [
            self.halve(below, values, directions, parts.start..middle)?,
            self.halve(above, values, directions, middle..parts.end)?,
        ];
        self.nodes[node].halves = halves;
        Ok(Half::Node(node as u32))
    }
}

/// Returns the product of a direction and a point. It is below the largest coordinate of `x`, for
/// the numbers of a direction add up to 1 at most.
fn product<const D: usize>(direction: &[f64; D], x: &[f64; D]) -> f64 {
    direction.iter().zip(x).map(|(a, x)| a * x).sum()
}

/// Returns the direction along which the points reach farthest.
fn widest<const D: usize>(points: &[[f64; D]], directions: &[[f64; D]; D]) -> [f64; D] {
    let extent = |direction: &[f64; D]| {
        let ends = points.iter().map(|point| product(direction, point));
        let (least, most) = ends
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), value| {
                (least.min(value), most.max(value))
            });
        // Half of each, for their difference may be too large.
        0.5 * most - 0.5 * least
    };
    let mut best = directions[0];
    let mut most = extent(&best);
    for direction in &directions[1..] {
        let own = extent(direction);
        if own > most {
            (best, most) = (*direction, own);
        }
    }
    best
}

/// Numbers that say how the axes of each phase are turned. In 2D any two axes of different phases
/// are 22 degrees apart or more, in 3D 17, and three are linearly independent.
const TURNS: [f64; 4] = [0.0, 0.445, -0.632, 0.78];

/// Returns axes at right angles, divided so that their numbers add up to 1 at most: the mirror
/// images of the usual ones by a plane that changes with the phase.
fn directions<const D: usize>(phase: usize) -> [[f64; D]; D] {
    let turn = TURNS[phase % TURNS.len()];
    let normal: [f64; D] = std::array::from_fn(|axis| turn.powi(axis as i32));
    let square: f64 = normal.iter().map(|x| x * x).sum();
    std::array::from_fn(|axis| {
        std::array::from_fn(|other| {
            let unit = if axis == other { 1.0 } else { 0.0 };
            (unit - 2.0 * normal[axis] * normal[other] / square) / D as f64
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::Random;

    fn counts<const D: usize>(cut: &Bisection<D>, points: &[[f64; D]], parts: usize) -> Vec<usize> {
        let mut counts = vec![0; parts];
        points.iter().for_each(|point| counts[cut.part_of(point) as usize] += 1);
        counts
    }

    #[test]
    fn parts_have_equal_shares_of_the_points_in_any_phase() {
        let mut random = Random(3);
        let points: Vec<[f64; 3]> =
            (0..6000).map(|at| [(); 3].map(|()| random.unit() * 2f64.powi(-(at % 900)))).collect();
        for (phase, parts) in [(0, 1), (0, 8), (1, 5), (2, 13), (3, 60), (4, 3)] {
            let cut = Bisection::new(points.clone(), parts, phase).unwrap();
            for count in counts(&cut, &points, parts) {
                assert!(count.abs_diff(points.len() / parts) <= 8, "{parts} parts, one of {count}");
            }
        }
    }

    #[test]
    fn neither_equal_points_nor_their_order_nor_large_coordinates_matter() {
        let far = [f64::MAX, -f64::MAX];
        let mut points: Vec<[f64; 2]> = vec![[0.5; 2]; 100];
        points.extend([far, [-f64::MAX; 2], [5e-324, 0.0], [0.0; 2]]);
        let cut = Bisection::new(points.clone(), 4, 1).unwrap();
        points.reverse();
        let again = Bisection::new(points.clone(), 4, 1).unwrap();
        for point in &points {
            assert!(cut.part_of(point) < 4);
            assert_eq!(cut.part_of(point), again.part_of(point));
        }
        assert!(Bisection::<2>::new(Vec::new(), 3, 0).unwrap().part_of(&far) < 3);
    }

    #[test]
    fn planes_of_different_phases_meet_in_points() {
        for (a, b, c) in [(0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3)] {
            let [a, b, c] = [a, b, c].map(directions::<3>);
            for at in 0..27 {
                let (a, b, c) = (a[at % 3], b[at / 3 % 3], c[at / 9]);
                let minor = |i: usize, j: usize| b[i] * c[j] - b[j] * c[i];
                let volume = a[0] * minor(1, 2) - a[1] * minor(0, 2) + a[2] * minor(0, 1);
                assert!(volume.abs() * 27.0 > 0.03);
            }
        }
    }
}
