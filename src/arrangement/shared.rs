//! Vertices that segments share where doubles have no room for one of each: between two lines from
//! a common vertex, as long as they are not some units in the last place apart.
//!
//! A vertex that two lines share is where they part anew, at the same angle, and the edge to the
//! last such vertex is a short feature beside it. So the next one is twice as far on: a line needs
//! no more of them than its length has bits.

use crate::memory::{AllocResult, TryGrow};
use crate::mesh::Crowded;
use crate::numerics::{distance, point_between};
use std::cmp::Ordering;

/// Distance of places on an axis, relative to their coordinates.
const APART: f64 = 1.0 / (1u64 << 30) as f64;

/// Powers of two between a crowded point and the end with the smaller coordinates, from which on
/// the place of a vertex is searched for by its power of two.
const POWERS: i32 = 16;

/// Vertices that segments must share, and those that they avoid.
#[derive(Default)]
pub struct SharedVertices {
    vertices: Vec<SharedVertex>,
    /// Numbers of the vertices, sorted by their points.
    sorted: Vec<u32>,
    /// Segments with vertices near them that they do not bend through, sorted.
    avoided: Vec<(u32, [f64; 2])>,
}

/// A vertex that segments must share; it may be an input or a crossing of theirs.
struct SharedVertex {
    x: [f64; 2],
    /// Distance from where its lines parted.
    step: f64,
    /// End of its line with the smaller coordinates, if its place was found from that.
    small_end: Option<[f64; 2]>,
}

impl SharedVertices {
    /// Returns the points of the vertices, in the order in which they were added.
    pub fn points(&self) -> impl ExactSizeIterator<Item = &[f64; 2]> {
        self.vertices.iter().map(|vertex| &vertex.x)
    }

    /// Returns the number of the vertex at a point. O(log n) for n vertices.
    pub fn find(&self, x: &[f64; 2]) -> Option<usize> {
        self.place(x).ok().map(|place| self.sorted[place] as usize)
    }

    /// Returns true if a segment does not bend through a vertex at a point. O(log n) for n pairs of
    /// a segment and a vertex that it avoids.
    pub fn avoids(&self, segment: u32, x: &[f64; 2]) -> bool {
        self.place_of_avoided(segment, x).is_ok()
    }

    /// Returns the place of a point among the sorted vertices, or where it would be inserted.
    fn place(&self, x: &[f64; 2]) -> Result<usize, usize> {
        self.sorted.binary_search_by(|&vertex| compare(&self.vertices[vertex as usize].x, x))
    }

    /// Returns the place of a segment and a point among those that are avoided, or where they would
    /// be inserted.
    fn place_of_avoided(&self, segment: u32, x: &[f64; 2]) -> Result<usize, usize> {
        self.avoided.binary_search_by(|(other, y)| other.cmp(&segment).then_with(|| compare(y, x)))
    }

    /// Adds vertices for the crowded points of a run, one for each place: it may make room for all
    /// others there, and many at once would be in each other's lines. Where there is none to be
    /// added the segments avoid the vertices that they bent through there. Returns true if anything
    /// is new.
    pub fn add_all(&mut self, crowded: &[Crowded]) -> AllocResult<bool> {
        let known = self.vertices.len();
        for crowded in crowded {
            if self.vertices[known..].iter().all(|vertex| are_apart(&vertex.x, &crowded.x)) {
                self.add(crowded)?;
            }
        }
        if self.vertices.len() > known {
            return Ok(true);
        }
        let known = self.avoided.len();
        for &Crowded { segment, ends, .. } in crowded {
            for end in ends {
                if let Err(place) = self.place_of_avoided(segment, &end) {
                    self.avoided.try_push((segment, end))?;
                    self.avoided[place..].rotate_right(1);
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
        for (x, small_end) in places.into_iter().flatten() {
            if let Err(place) = self.place(&x) {
                let number = self.vertices.len() as u32;
                self.sorted.try_push(number)?;
                self.sorted[place..].rotate_right(1);
                let step = distance(&from, &x);
                return self.vertices.try_push(SharedVertex { x, step, small_end });
            }
        }
        Ok(())
    }

    /// Returns the point of a crowded line that is twice as far on as the vertex where it begins
    /// was; the crowded point itself where that is farther, or where the line does not begin at a
    /// shared vertex or is too short.
    fn place_of(&self, &Crowded { x, ends: [from, to], .. }: &Crowded) -> [f64; 2] {
        let step = self.find(&from).map_or(0.0, |last| 2.0 * self.vertices[last].step);
        let fraction = step / distance(&from, &to);
        if !(step > distance(&from, &x) && 0.0 < fraction && fraction < 0.5) {
            return x;
        }
        [0, 1].map(|k| from[k] + fraction * (to[k] - from[k]))
    }

    /// Returns a point of a crowded line that runs to an end with far smaller coordinates: beside
    /// another line up to where doubles are fine enough to tell them apart. That place is bisected
    /// by its power of two: between the crowded point and the end, or a point nearer to the end
    /// that the lines turned out not to share, since this one has no vertex there. `None` if it is
    /// found.
    fn place_toward(&self, small: [f64; 2], crowded: &Crowded) -> Option<[f64; 2]> {
        let [from, to] = crowded.ends;
        let far = if small == from { to } else { from };
        // Beside the small end itself they part there, and come together nowhere.
        if distance(&small, &crowded.x) < 0.25 * distance(&far, &crowded.x) {
            return None;
        }
        let power_at = |x: &[f64; 2]| power(distance(&small, x));
        let (own, bottom) = (power_at(&crowded.x), power(size(&small)));
        let known = self.vertices.iter().filter(|vertex| vertex.small_end == Some(small));
        let known = known.map(|vertex| power_at(&vertex.x));
        let above = known.filter(|&power| power < own).max();
        let is_far = own - above.unwrap_or(bottom) > if above.is_some() { 1 } else { POWERS };
        let power = (own + above.unwrap_or(bottom)) / 2 - power_at(&far);
        let fraction = f64::from_bits((1023 + power).max(1) as u64 * (1 << 52));
        is_far.then(|| point_between(&small, &far, fraction))
    }
}

/// Compares finite points by their coordinates, the first one first; zeros of either sign are
/// equal.
fn compare(x: &[f64; 2], y: &[f64; 2]) -> Ordering {
    x.partial_cmp(y).unwrap_or(Ordering::Equal)
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
            shared.points().map(|x| x[0]).collect::<Vec<_>>()
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
        // The line is too short for its double.
        assert_eq!(add(&mut shared, 40.0, 42.0), [1.0, 3.0, 7.0, 40.0, 1.25, 42.0]);
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
        assert!(shared.points().eq(&[[1.0, 5.0], [2.0, 5.0]]));
        shared.add_all(&crowded).unwrap();
        assert!(shared.points().skip(2).eq(&[[1.0 + 1e-12, 5.0], [2.0 + 1e-12, 5.0]]));
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
            shared.points().last().unwrap()[0].log2().round()
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
        assert_eq!((shared.points().len(), shared.avoided.len()), (1, 0));
        assert!(shared.add_all(&[crowded]).unwrap());
        assert_eq!(shared.avoided, [(7, [0.5, 0.0]), (7, [2.0, 0.0])]);
        assert!(!shared.add_all(&[crowded]).unwrap());
    }

    #[test]
    fn vertices_and_avoided_ones_are_found_in_any_order() {
        let mut shared = SharedVertices::default();
        let crowded = [5.0, -3.0, 0.0, 5.5, -4.0].map(|x| Crowded {
            segment: (x + 9.0) as u32,
            x: [x, 2.0 * x],
            ends: [[x + 0.25, 1.0], [x + 64.0, -0.0]],
        });
        assert!(shared.add_all(&crowded).unwrap());
        assert!(shared.add_all(&crowded).unwrap());
        assert!(!shared.add_all(&crowded).unwrap());
        for (number, x) in shared.points().enumerate() {
            assert_eq!(shared.find(x), Some(number));
            assert_eq!(shared.find(&x.map(|value| value.next_up().next_up())), None);
        }
        assert_eq!((shared.points().len(), shared.avoided.len()), (5, 10));
        // Zeros of either sign are one.
        assert_eq!((shared.find(&[-0.0, 0.0]), shared.find(&[-0.0, -0.0])), (Some(2), Some(2)));
        for Crowded { segment, ends: [from, to], .. } in crowded {
            assert!(shared.avoids(segment, &from) && shared.avoids(segment, &to.map(|x| x + 0.0)));
            assert!(!shared.avoids(segment + 1, &from) && !shared.avoids(segment, &[from[0], 2.0]));
        }
    }
}
