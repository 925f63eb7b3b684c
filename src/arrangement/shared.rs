//! Vertices that segments share where doubles have no room for one of each: between two lines from
//! a common vertex, as long as they are not some units in the last place apart.
//!
//! A vertex that two lines share is where they part anew, at the same angle, and the edge to the
//! last such vertex is a short feature beside it. So the next one is twice as far on: a line needs
//! no more of them than its length has bits.

use crate::memory::{AllocResult, TryGrow};
use crate::mesh::Crowded;
use crate::numerics::{distance, point_between};

/// Distance of places on an axis, relative to their coordinates.
const APART: f64 = 1.0 / (1u64 << 30) as f64;

/// Powers of two between a crowded point and the end with the smaller coordinates, from which on the
/// place of a vertex is searched for by its power of two.
const POWERS: i32 = 16;

/// Vertices that segments must share; some are inputs or crossings of theirs.
#[derive(Default)]
pub struct SharedVertices {
    pub points: Vec<[f64; 2]>,
    /// Vertex -> how far it is from where its lines parted.
    steps: Vec<f64>,
    /// Vertex -> the end of its line with the smaller coordinates, if its place was found from that.
    small_ends: Vec<Option<[f64; 2]>>,
    /// Segments with vertices near them that they do not bend through.
    pub avoided: Vec<(u32, [f64; 2])>,
}

impl SharedVertices {
    /// Adds vertices for the crowded points of a run, one for each place: it may make room for all
    /// others there, and many at once would be in each other's lines. Where there is none to be added
    /// the segments avoid the vertices that they bent through there. Returns true if anything is new.
    pub fn add_all(&mut self, crowded: &[Crowded]) -> AllocResult<bool> {
        let known = self.points.len();
        for crowded in crowded {
            if self.points[known..].iter().all(|point| are_apart(point, &crowded.x)) {
                self.add(crowded)?;
            }
        }
        if self.points.len() > known {
            return Ok(true);
        }
        let known = self.avoided.len();
        for &Crowded { segment, ends, .. } in crowded {
            for end in ends {
                if !self.avoided.contains(&(segment, end)) {
                    self.avoided.try_push((segment, end))?;
                }
            }
        }
        Ok(self.avoided.len() > known)
    }

    /// Adds a vertex for a crowded point: the one twice as far on, or the crowded point itself
    /// where the first is there, which is too far on for the lines to share. Adds none if both are
    /// there.
    fn add(&mut self, crowded: &Crowded) -> AllocResult<()> {
        let Crowded { x: own, ends: [from, to], .. } = *crowded;
        let small = if size(&from) < size(&to) { from } else { to };
        let toward = self.place_toward(small, crowded).map(|x| (x, Some(small)));
        let places = [toward, Some((self.place_of(crowded), None)), Some((own, None))];
        let is_new = |(x, _): &([f64; 2], Option<[f64; 2]>)| !self.points.contains(x);
        if let Some((x, small_end)) = places.into_iter().flatten().find(is_new) {
            self.points.try_push(x)?;
            self.steps.try_push(distance(&from, &x))?;
            self.small_ends.try_push(small_end)?;
        }
        Ok(())
    }

    /// Returns the point of a crowded line that is twice as far on as the vertex where it begins
    /// was; the crowded point itself where that is farther, or where the line does not begin at a
    /// shared vertex or is too short.
    fn place_of(&self, &Crowded { x, ends: [from, to], .. }: &Crowded) -> [f64; 2] {
        let last = self.points.iter().position(|point| *point == from);
        let step = last.map_or(0.0, |last| 2.0 * self.steps[last]);
        let fraction = step / distance(&from, &to);
        if !(step > distance(&from, &x) && 0.0 < fraction && fraction < 0.5) {
            return x;
        }
        [0, 1].map(|k| from[k] + fraction * (to[k] - from[k]))
    }

    /// Returns a point of a crowded line that runs to an end with far smaller coordinates: beside
    /// another line up to where doubles are fine enough to tell them apart. That place is bisected by
    /// its power of two: between the crowded point and the end, or a point nearer to the end that the
    /// lines turned out not to share, since this one has no vertex there. `None` if it is found.
    fn place_toward(&self, small: [f64; 2], crowded: &Crowded) -> Option<[f64; 2]> {
        let [from, to] = crowded.ends;
        let far = if small == from { to } else { from };
        // Beside the small end itself they part there, and come together nowhere.
        if distance(&small, &crowded.x) < 0.25 * distance(&far, &crowded.x) {
            return None;
        }
        let power_at = |x: &[f64; 2]| power(distance(&small, x));
        let (own, bottom) = (power_at(&crowded.x), power(size(&small)));
        let known = self.points.iter().zip(&self.small_ends);
        let known = known.filter(|&(_, end)| *end == Some(small)).map(|(x, _)| power_at(x));
        let above = known.filter(|&power| power < own).max();
        let is_far = own - above.unwrap_or(bottom) > if above.is_some() { 1 } else { POWERS };
        let power = (own + above.unwrap_or(bottom)) / 2 - power_at(&far);
        let fraction = f64::from_bits((1023 + power).max(1) as u64 * (1 << 52));
        is_far.then(|| point_between(&small, &far, fraction))
    }
}

/// Returns the larger magnitude of a point's coordinates.
fn size(x: &[f64; 2]) -> f64 {
    x[0].abs().max(x[1].abs())
}

/// Returns the biased exponent of a length.
fn power(length: f64) -> i32 {
    (length.to_bits() >> 52) as i32
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
        let ends = |from: f64| [[from, 0.0], [100.0, 0.0]];
        let crowded = |from, x| Crowded { segment: 0, x: [x, 0.0], ends: ends(from) };
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
        let crowded = [1.0, 1.0 + 1e-12, 2.0, 1.0 - 1e-12, 2.0 + 1e-12].map(|x| Crowded {
            segment: 0,
            x: [x, 5.0],
            ends: [[0.0, 5.0], [100.0, 5.0]],
        });
        shared.add_all(&crowded).unwrap();
        assert_eq!(shared.points, [[1.0, 5.0], [2.0, 5.0]]);
        shared.add_all(&crowded).unwrap();
        assert_eq!(shared.points[2..], [[1.0 + 1e-12, 5.0], [2.0 + 1e-12, 5.0]]);
    }

    #[test]
    fn the_place_of_a_vertex_toward_a_small_end_is_bisected_by_its_power_of_two() {
        let small = [3.0, 4.0];
        let crowded = |from: f64| Crowded {
            segment: 0,
            x: [0.5 * from, 0.5 * from],
            ends: [[from, from], small],
        };
        let mut shared = SharedVertices::default();
        let mut add = |from: f64| -> f64 {
            assert!(shared.add_all(&[crowded(from)]).unwrap());
            shared.points.last().unwrap()[0].log2().round()
        };
        // Between 2^2 and the crowded point, which is at 2^200.
        let first = add(2f64.powi(201));
        assert!((100.0..=102.0).contains(&first), "{first}");
        // The lines share it: between it and 2^2.
        assert!((50.0..=52.0).contains(&add(2f64.powf(first))));
        // They do not share this one: above it.
        let third = add(2f64.powf(first));
        assert!((74.0..=77.0).contains(&third), "{third}");
    }

    #[test]
    fn segments_avoid_vertices_where_there_is_none_to_be_shared() {
        let crowded = Crowded { segment: 7, x: [1.0, 0.0], ends: [[0.5, 0.0], [2.0, 0.0]] };
        let mut shared = SharedVertices::default();
        assert!(shared.add_all(&[crowded]).unwrap());
        assert_eq!((shared.points.len(), shared.avoided.len()), (1, 0));
        assert!(shared.add_all(&[crowded]).unwrap());
        assert_eq!(shared.avoided, [(7, [0.5, 0.0]), (7, [2.0, 0.0])]);
        assert!(!shared.add_all(&[crowded]).unwrap());
    }
}
