//! Rounds of insertions, on one thread or on several.

use super::insertion::{Inserter, Outcome};
use super::region::{Part, parts};
use super::tetrahedra::Tetrahedra;
use crate::error::Result;
use crate::memory::{TryGrow, with_capacity};
use crate::mesh::Stats;
use crate::netmesh::state::watch::Watch;
use crate::netmesh::state::workers::{Tick, on_threads_with_ticks, provide_spare};
use crate::options::Phase;

/// Least number of points for each thread: those that reach out of its part are more in small ones.
const FEW: usize = 1 << 11;

/// Places that are set aside for each point of a part: as many as there is memory for from the
/// beginning ([`Tetrahedra::new`]), since moving all to more memory is one thread's.
const PLACES: usize = 7;

/// Points of a part at which threads try to begin. They are from all of it: the first ones on the
/// curve may all be near a side.
const TRIES: usize = 64;

/// Units of work of the watch that an insertion is.
const WORK: u32 = 30;

/// A triangulation in the making.
pub(super) struct Passes<'a> {
    points: &'a [[f64; 3]],
    threads: usize,
    pub tetrahedra: Tetrahedra,
    /// The one that inserts in all of space.
    inserter: Inserter<'a>,
    inserted: usize,
    passes: u64,
}

/// Things that a thread leaves behind.
struct Left<'a> {
    inserter: Inserter<'a>,
    /// Points that are not in.
    pending: Vec<u32>,
}

impl<'a> Passes<'a> {
    /// Begins with a tetrahedron of positive orientation.
    pub fn new(
        points: &'a [[f64; 3]],
        first: [u32; 4],
        threads: usize,
        watch: &mut Watch<'_, '_>,
    ) -> Result<Self> {
        let inserter = Inserter::new(points, 0);
        let mut tetrahedra = Tetrahedra::new(first, points.len())?;
        provide_spare(threads, watch, tetrahedra.records())?;
        Ok(Self { points, threads, tetrahedra, inserter, inserted: 4, passes: 0 })
    }

    /// Inserts points, which are in the order of locality.
    pub fn insert(&mut self, round: Vec<u32>, watch: &mut Watch<'_, '_>) -> Result<()> {
        let mut pending = round;
        for axis in 0..3 {
            let before = pending.len();
            if self.threads == 1 || before < FEW * self.threads {
                break;
            }
            pending = self.insert_in_parts(pending, axis, watch)?;
            if 2 * pending.len() > before {
                break;
            }
        }
        pending.sort_unstable();
        self.insert_alone(&pending, watch)
    }

    /// Inserts points on this thread.
    fn insert_alone(&mut self, pending: &[u32], watch: &mut Watch<'_, '_>) -> Result<()> {
        self.passes += 1;
        for &vertex in pending {
            if watch.is_due(WORK) {
                self.report(watch)?;
            }
            while self.inserter.insert(&self.tetrahedra, vertex)? == Outcome::LacksRoom {
                self.make_room(1)?;
            }
            self.inserted += 1;
        }
        Ok(())
    }

    /// Inserts points on all threads, each in a part of space, the first cut across an axis.
    /// Returns those that reach out of their parts.
    fn insert_in_parts(
        &mut self,
        pending: Vec<u32>,
        axis: usize,
        watch: &mut Watch<'_, '_>,
    ) -> Result<Vec<u32>> {
        self.passes += 1;
        let count = pending.len();
        let levels = self.threads.next_power_of_two().trailing_zeros();
        let parts = parts(self.points, pending, axis, levels as usize)?;
        let mut left = Vec::new();
        let mut starts = with_capacity(parts.len())?;
        for part in parts {
            match self.begun_in(&part)? {
                Some(inserter) => starts.push((inserter, part.pending)),
                None => left.try_extend(&part.pending)?,
            }
        }
        let tetrahedra = &self.tetrahedra;
        let act = |(mut inserter, pending): (Inserter<'a>, Vec<u32>), tick: &mut Tick<'_>| {
            let mut left = Vec::new();
            for vertex in pending {
                tick(WORK)?;
                if inserter.insert(tetrahedra, vertex)? != Outcome::Inserted {
                    left.try_push(vertex)?;
                }
            }
            Ok(Left { inserter, pending: left })
        };
        let done = on_threads_with_ticks(self.threads, watch, starts.into_iter(), act)?;
        for Left { inserter, pending } in done {
            self.inserter.absorb(inserter)?;
            left.try_extend(&pending)?;
        }
        self.inserted += count - left.len();
        self.report(watch)?;
        Ok(left)
    }

    /// Returns one that inserts in the region of a part, if a tetrahedron is found to begin at.
    fn begun_in(&mut self, part: &Part) -> Result<Option<Inserter<'a>>> {
        for &vertex in part.pending.iter().step_by(part.pending.len() / TRIES + 1) {
            let found = self.inserter.locate(&self.tetrahedra, vertex);
            let start = found.filter(|&found| self.tetrahedra.has_finite_corners(found));
            let Some(start) = start else { continue };
            let mut inserter = self.inserter.in_region(part.region, start);
            if inserter.is_own(&self.tetrahedra.corners(start)) {
                let places = PLACES * part.pending.len();
                self.make_room(places.saturating_sub(self.inserter.room.in_ranges()))?;
                inserter.room = self.inserter.room.split(places)?;
                return Ok(Some(inserter));
            }
        }
        Ok(None)
    }

    /// Makes room for so many tetrahedra more.
    fn make_room(&mut self, places: usize) -> Result<()> {
        if places == 0 {
            return Ok(());
        }
        let range = self.tetrahedra.grow(places)?;
        Ok(self.inserter.room.add_range(range)?)
    }

    fn report(&self, watch: &mut Watch<'_, '_>) -> Result<()> {
        let done = self.inserted as f64 / self.points.len() as f64;
        let simplices = self.tetrahedra.all().len() - self.inserter.room.size();
        let counts = [self.inserted, self.inserted, simplices].map(|count| count as u64);
        watch.note(Phase::Insert, done, counts);
        watch.report()
    }

    /// Adds what the insertions have taken.
    pub fn count_into(&self, stats: &mut Stats) {
        stats.passes = self.passes;
        stats.touches = self.inserter.steps;
        stats.max_touches = self.inserter.most_steps;
        stats.exact_fallbacks = self.inserter.fallbacks();
        stats.simplices_created = self.inserter.created;
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::rounds::rounds;
    use super::super::super::testing::{inputs, uniform};
    use super::*;
    use crate::netmesh::state::order::by_locality;

    /// Returns uniform points in the order of locality, and corners of a tetrahedron.
    fn ordered(count: usize) -> (Vec<[f64; 3]>, [u32; 4]) {
        let points: Vec<[f64; 3]> = uniform(count, 6);
        let order = by_locality::<3>(&inputs(&points), 1, &mut Watch::new(None)).unwrap();
        let points: Vec<[f64; 3]> = order.iter().map(|input| points[input.index()]).collect();
        let first = super::super::positive([0, 1, 2, 3], &points);
        (points, first)
    }

    #[test]
    fn tetrahedra_of_uniform_points_stay_where_they_are() {
        const COUNT: u32 = 40_000;
        let (points, first) = ordered(COUNT as usize);
        let watch = &mut Watch::new(None);
        let mut passes = Passes::new(&points, first, 2, watch).unwrap();
        let before = passes.tetrahedra.all().as_ptr();
        for round in rounds(COUNT as usize, 0, &first).unwrap() {
            passes.insert(round, watch).unwrap();
        }
        assert_eq!(passes.inserted, COUNT as usize);
        assert_eq!(passes.tetrahedra.all().as_ptr(), before);
    }

    /// Half of the points are in. Those of a part come by their distance from its side, where
    /// nothing can begin.
    #[test]
    fn threads_begin_in_every_part() {
        const COUNT: u32 = 20_000;
        let (points, first) = ordered(COUNT as usize);
        let watch = &mut Watch::new(None);
        let mut passes = Passes::new(&points, first, 1, watch).unwrap();
        let (half, others) = (4..COUNT).partition(|vertex| vertex % 2 == 0);
        passes.insert(half, watch).unwrap();
        for mut part in parts(&points, others, 0, 1).unwrap() {
            let from_middle = |&vertex: &u32| points[vertex as usize][0].abs();
            part.pending.sort_by(|a, b| from_middle(a).total_cmp(&from_middle(b)));
            assert!(passes.begun_in(&part).unwrap().is_some(), "{:?}", part.region);
        }
    }
}
