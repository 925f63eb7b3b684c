//! Insertions: a further point in the D-ball of a sliver.

use crate::complex::{SimplexId, VertexId};
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow};
use crate::netmesh::slivers::cone::Cone;
use crate::netmesh::slivers::queue::Sliver;
use crate::netmesh::slivers::random::Random;
use crate::netmesh::slivers::view::View;
use crate::netmesh::slivers::work::Slivers;
use crate::netmesh::state::{Mesher, State};

/// The vertices of a sliver whose middles are tried. The middle of an edge is in the D-balls of all
/// simplices round it, and most of those round an edge of slivers may be such: in a lattice a point
/// so mends four of its cells.
const EDGES: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];

/// Largest distances of a point from the circumcentre, relative to the radius, in turns.
const SPREADS: [f64; 3] = [0.25, 0.5, 0.85];

/// A point to insert.
#[derive(Clone, Copy)]
pub(super) struct Insertion {
    pub x: [f64; 3],
    pub gain: f64,
}

impl Mesher<'_, '_, 3> {
    /// Returns the `most` best of `count` points for `sliver` that are worth more than `least`, the
    /// best first.
    pub(super) fn best_insertions(
        &mut self,
        sliver: &Sliver,
        [most, count]: [usize; 2],
        least: f64,
        random: &mut Random,
        slivers: &mut Slivers,
    ) -> Result<Vec<Insertion>> {
        let mut best: Vec<Insertion> = Vec::new();
        let radius = self.state.delaunay.radius(sliver.simplex);
        let Some((center, radius)) = self.state.delaunay.corner(sliver.simplex).zip(radius) else {
            return Ok(best);
        };
        for number in 0..count {
            self.watch.poll_after(20)?;
            let x: [f64; 3] = match number.checked_sub(1).map(|at| EDGES.get(at)) {
                None => center,
                Some(Some(&ends)) => self.state.middle(ends.map(|at| sliver.vertices[at])),
                Some(None) => {
                    let spread = radius * SPREADS[number % SPREADS.len()];
                    let way: [f64; 3] = random.in_ball();
                    std::array::from_fn(|k| center[k] + spread * way[k])
                }
            };
            let is_sound = x.iter().all(|x| x.is_finite())
                && self.state.delaunay.in_conflict(sliver.simplex, &x);
            if !is_sound {
                continue;
            }
            let least = match best.get(most - 1) {
                Some(last) => last.gain,
                None => least,
            };
            // Where conflicts reach another region, the wall between would go.
            self.state.find_cavity_in_region(sliver.simplex, &x, 0, &mut slivers.cavity)?;
            if !slivers.cavity.is_whole {
                continue;
            }
            if let Some((gain, is_clean)) = self.judge_insertion(&x, least, slivers)? {
                let at = best.iter().position(|other| other.gain < gain).unwrap_or(best.len());
                best.truncate(most - 1);
                best.try_push(Insertion { x, gain })?;
                let last = best.len() - 1;
                best[at.min(last)..].rotate_right(1);
                if is_clean && number >= EDGES.len() {
                    break;
                }
            }
        }
        Ok(best)
    }

    /// Returns the gain of inserting `x`, whose conflicts are `slivers.cavity`, if that is more
    /// than `least`, and whether it would leave no sliver.
    pub(super) fn judge_insertion(
        &mut self,
        x: &[f64; 3],
        least: f64,
        slivers: &mut Slivers,
    ) -> Result<Option<(f64, bool)>> {
        let Some(domain) = self.state.common_domain(&slivers.cavity) else { return Ok(None) };
        let Slivers { measure, penalties, cone, cavity, .. } = slivers;
        let view = View::new(&self.state, self.sizes.as_ref(), penalties, measure);
        let is_infinite = |&simplex: &SimplexId| !view.delaunay.has_ball(simplex);
        if cavity.simplices.iter().any(is_infinite) || !view.hierarchy.contains(domain, x) {
            return Ok(None);
        }
        let before = view.sum(&cavity.simplices);
        if before <= least {
            return Ok(None);
        }
        cone_over(view, cavity, cone)?;
        let Some(gain) = cone.judge(view, x, before, least) else { return Ok(None) };
        let is_kept = view.keeps_boundary(&cavity.simplices, cone)
            && cone.keeps_cells(view, x)
            && cone.keeps_sizes(view, x, view.max_edge_at(cavity.simplices[0]))?;
        Ok(is_kept.then_some((gain, gain >= before)))
    }
}

impl State<3> {
    pub(in crate::netmesh) fn middle(&self, ends: [VertexId; 2]) -> [f64; 3] {
        let [a, b] = ends.map(|end| self.delaunay.point(end));
        std::array::from_fn(|k| 0.5 * a[k] + 0.5 * b[k])
    }
}

fn cone_over(view: View<'_>, cavity: &Cavity, cone: &mut Cone) -> AllocResult<()> {
    cone.sides.clear();
    for facet in &cavity.boundary {
        cone.push(view.delaunay.complex().vertices(facet.simplex), facet.index as usize)?;
    }
    Ok(())
}
