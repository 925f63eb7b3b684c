//! Vertices that segments share where doubles have no room for one of each: between two lines from
//! a common vertex, as long as they are not some units in the last place apart.
//!
//! A vertex that two lines share is where they part anew, at the same angle, and the edge to the
//! last such vertex is a short feature beside it. So the next one is twice as far on: a line needs
//! no more of them than its length has bits.

use crate::memory::{AllocResult, TryGrow};
use crate::mesh::Crowded;
use crate::numerics::distance;

/// Distance of places on an axis, relative to their coordinates.
const APART: f64 = 1.0 / (1u64 << 30) as f64;

/// Vertices that segments must share; some are inputs or crossings of theirs.
#[derive(Default)]
pub struct SharedVertices {
    pub points: Vec<[f64; 2]>,
    /// Vertex -> how far it is from where its lines parted.
    steps: Vec<f64>,
}

impl SharedVertices {
    /// Adds vertices for the crowded points of a run, one for each place: it may make room for all
    /// others there, and many at once would be in each other's lines.
    pub fn add_all(&mut self, crowded: &[Crowded]) -> AllocResult<()> {
        let known = self.points.len();
        for crowded in crowded {
            if self.points[known..].iter().all(|point| are_apart(point, &crowded.x)) {
                self.add(crowded)?;
            }
        }
        Ok(())
    }

    /// Adds a vertex for a crowded point: the one twice as far on, or the crowded point itself where
    /// the first is there, which is too far on for the lines to share. Adds none if both are there.
    fn add(&mut self, crowded: &Crowded) -> AllocResult<()> {
        let own = (crowded.x, distance(&crowded.ends[0], &crowded.x));
        let is_new = |(x, _): &([f64; 2], f64)| !self.points.contains(x);
        if let Some((x, step)) = [self.place_of(crowded), own].into_iter().find(is_new) {
            self.points.try_push(x)?;
            self.steps.try_push(step)?;
        }
        Ok(())
    }

    /// Returns the point of a crowded line that is twice as far on as the vertex where it begins
    /// was, and how far that is; the crowded point itself where that is farther, or where the line
    /// does not begin at a shared vertex or is too short.
    fn place_of(&self, &Crowded { x, ends: [from, to] }: &Crowded) -> ([f64; 2], f64) {
        let own = distance(&from, &x);
        let last = self.points.iter().position(|point| *point == from);
        let step = last.map_or(0.0, |last| 2.0 * self.steps[last]);
        let fraction = step / distance(&from, &to);
        if !(step > own && 0.0 < fraction && fraction < 0.5) {
            return (x, own);
        }
        ([0, 1].map(|k| from[k] + fraction * (to[k] - from[k])), step)
    }
}

/// Returns true if two points are so far apart that vertices at one are not crowded by the other's.
fn are_apart(x: &[f64; 2], y: &[f64; 2]) -> bool {
    (0..2).any(|k| (x[k] - y[k]).abs() > APART * x[k].abs().max(y[k].abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_next_vertex_is_twice_as_far_on() {
        let mut shared = SharedVertices::default();
        let crowded =
            |from: f64, x: f64| Crowded { x: [x, 0.0], ends: [[from, 0.0], [100.0, 0.0]] };
        let add = |shared: &mut SharedVertices, from, x| {
            shared.add(&crowded(from, x)).unwrap();
            shared.points.iter().map(|x| x[0]).collect::<Vec<_>>()
        };
        assert_eq!(add(&mut shared, 0.0, 1.0), [1.0]);
        assert_eq!(add(&mut shared, 1.0, 1.5), [1.0, 3.0]);
        assert_eq!(add(&mut shared, 3.0, 4.0), [1.0, 3.0, 7.0]);
        // There already, and farther than what is asked for.
        assert_eq!(add(&mut shared, 0.0, 3.0), [1.0, 3.0, 7.0]);
        assert_eq!(add(&mut shared, 3.0, 40.0), [1.0, 3.0, 7.0, 40.0]);
        // The double is there, and too far on.
        assert_eq!(add(&mut shared, 1.0, 1.25), [1.0, 3.0, 7.0, 40.0, 1.25]);
        assert_eq!(add(&mut shared, 1.0, 1.25), [1.0, 3.0, 7.0, 40.0, 1.25]);
        shared.points.pop();
        shared.steps.pop();
        // The line is too short for its double.
        assert_eq!(add(&mut shared, 40.0, 42.0), [1.0, 3.0, 7.0, 40.0, 42.0]);
    }

    #[test]
    fn each_place_gets_one_vertex_at_a_time() {
        let mut shared = SharedVertices::default();
        let crowded = [1.0, 1.0 + 1e-12, 2.0, 1.0 - 1e-12, 2.0 + 1e-12]
            .map(|x| Crowded { x: [x, 5.0], ends: [[0.0, 5.0], [100.0, 5.0]] });
        shared.add_all(&crowded).unwrap();
        assert_eq!(shared.points, [[1.0, 5.0], [2.0, 5.0]]);
        shared.add_all(&crowded).unwrap();
        assert_eq!(shared.points[2..], [[1.0 + 1e-12, 5.0], [2.0 + 1e-12, 5.0]]);
    }
}
