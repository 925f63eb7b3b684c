//! Ply (Definition 1) at Voronoi corners, and how many D-balls meet one D-ball (Theorem 4).

use crate::delaunay::Cavity;
use crate::error::Result;
use crate::netmesh::state::Mesher;

/// The most points at which the ply is counted.
const PLY_PROBES: usize = 20_000;

/// The most D-balls whose intersections are counted.
const MEETING_PROBES: usize = 2_000;

/// The most simplices visited for the intersections of one D-ball.
const MEETING_LIMIT: usize = 100_000;

/// Probes end when all of them together visited this number of simplices: from 5D on each visits
/// thousands.
const WORK: u64 = 1 << 25;

/// The largest of some counts, and their mean.
#[derive(Default)]
struct Counts {
    counts: u64,
    sum: u64,
    max: u64,
}

impl Counts {
    pub fn add(&mut self, count: u64) {
        self.counts += 1;
        self.sum += count;
        self.max = self.max.max(count);
    }

    /// Returns the mean of the counts, 0 if there are none.
    fn mean(&self) -> f64 {
        self.sum as f64 / self.counts.max(1) as f64
    }
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// Counts the D-balls that hold probes of the mesh: those that hold a point are the finite
    /// simplices of its cavity.
    pub(super) fn measure_ply(&mut self) -> Result<()> {
        let mut ply = Counts::default();
        let mut cavity = Cavity::default();
        let mut work = 0;
        for simplex in self.probes(PLY_PROBES)? {
            if work > WORK {
                break;
            }
            let Some(corner) = self.state.delaunay.corner(simplex) else { continue };
            // Rounding may have moved it out of its own D-ball.
            let is_finite = corner.iter().all(|x| x.is_finite());
            if !is_finite || !self.state.delaunay.in_conflict(simplex, &corner) {
                continue;
            }
            self.state.delaunay.find_cavity(simplex, &corner, &mut cavity)?;
            let holders = &cavity.simplices;
            ply.add(holders.iter().filter(|&&s| self.state.delaunay.has_ball(s)).count() as u64);
            work += holders.len() as u64;
            self.watch.poll_after(holders.len() as u32)?;
        }
        self.state.stats.ply_probes = ply.counts;
        self.state.stats.max_ply = ply.max;
        self.state.stats.mean_ply = ply.mean();
        Ok(())
    }

    pub(super) fn measure_intersections(&mut self) -> Result<()> {
        let mut met = Counts::default();
        let mut work = 0;
        for simplex in self.probes(MEETING_PROBES)? {
            if work > WORK {
                break;
            }
            let found = &mut self.scratch.star;
            met.add(self.state.delaunay.count_meeting(simplex, MEETING_LIMIT, found)?);
            work += found.len() as u64;
            self.watch.poll_after(found.len() as u32)?;
        }
        self.state.stats.max_ball_intersections = met.max;
        self.state.stats.mean_ball_intersections = met.mean();
        Ok(())
    }
}
