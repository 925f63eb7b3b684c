//! Moves: a vertex of a sliver goes elsewhere or away, or one of a simplex beside it does.

use crate::complex::VertexId;
use crate::error::Result;
use crate::netmesh::slivers::queue::Sliver;
use crate::netmesh::slivers::random::Random;
use crate::netmesh::slivers::vacancy::Target;
use crate::netmesh::slivers::view::View;
use crate::netmesh::slivers::work::Slivers;
use crate::netmesh::state::{Mesher, State};
use crate::numerics::distance;

/// Places that are tried for a vertex.
const PLACES: usize = 16;

/// Largest distance that a vertex moves, relative to that of its nearest neighbour.
const REACH: f64 = 0.6;

/// Depth that a neighbour may go into the D-ball of a sliver, relative to the radius, and distance
/// from the way there, relative to its nearest neighbour.
const DEPTH: f64 = 0.35;

const ASIDE: f64 = 0.3;

impl Mesher<'_, '_, 3> {
    /// Moves one vertex such that the objective falls. Returns what that was worth. `times`: how
    /// many times as many places as usual are tried. Many of the slivers that a small angle of the
    /// input forces stay whatever is tried: for them a vertex is not tried again until its star
    /// is another.
    pub(super) fn mend_by_move(
        &mut self,
        sliver: &Sliver,
        times: usize,
        random: &mut Random,
        slivers: &mut Slivers,
    ) -> Result<Option<f64>> {
        let is_forced = self.state.is_left_alone(sliver.simplex)?;
        let own = sliver.vertices.map(|vertex| (vertex, None));
        let beside = self.state.vertices_beside(sliver).map(|apex| (apex, Some(sliver)));
        for (vertex, into) in own.into_iter().chain(beside) {
            if !vertex.is_valid() || is_forced && slivers.stars.is_settled(vertex) {
                continue;
            }
            let gain = self.mend_by_vertex(vertex, into, times, random, slivers)?;
            if gain.is_some() {
                return Ok(gain);
            }
            slivers.stars.settle(vertex, self.state.now());
        }
        Ok(None)
    }

    /// Removes or moves `vertex` such that the objective falls. Returns what that was worth.
    /// `into`: a sliver in whose D-ball the vertex would destroy it.
    fn mend_by_vertex(
        &mut self,
        vertex: VertexId,
        into: Option<&Sliver>,
        times: usize,
        random: &mut Random,
        slivers: &mut Slivers,
    ) -> Result<Option<f64>> {
        if !self.find_vacancy(vertex, slivers)? {
            return Ok(None);
        }
        let Slivers { measure, penalties, vacancy, .. } = slivers;
        let view = View::new(&self.state, self.sizes.as_ref(), penalties, measure);
        // What a log has is often one point too many: that is not to go at once.
        if slivers.log.is_none() {
            if let Some(gain) = vacancy.judge_removal(view, slivers.least_gain)? {
                self.remove_vertex(vertex, slivers)?;
                return Ok(Some(gain));
            }
        }
        let place = self.best_place(vertex, into, times, random, slivers)?;
        if let Some(place) = &place {
            self.move_vertex(vertex, place, slivers)?;
        }
        Ok(place.map(|place| place.gain))
    }

    /// Returns the place for the vertex that `slivers.vacancy` is without that is worth most.
    fn best_place(
        &mut self,
        vertex: VertexId,
        into: Option<&Sliver>,
        times: usize,
        random: &mut Random,
        slivers: &mut Slivers,
    ) -> Result<Option<Target>> {
        let least_gain = slivers.least_gain;
        let Slivers { measure, penalties, vacancy, .. } = slivers;
        let domain = self.state.hierarchy.domain_of(vertex);
        let view = View::new(&self.state, self.sizes.as_ref(), penalties, measure);
        let ball = into.and_then(|sliver| {
            let radius = view.delaunay.radius(sliver.simplex)?;
            view.delaunay.corner(sliver.simplex).map(|center| (center, radius))
        });
        let from = *view.delaunay.point(vertex);
        let mut best: Option<Target> = None;
        for number in 0..PLACES * times {
            self.watch.poll_after(20)?;
            let x = match (number, &ball) {
                (0 | 1, _) => {
                    let way = 1.0 - 0.5 * number as f64;
                    std::array::from_fn(|k| from[k] + way * (vacancy.middle[k] - from[k]))
                }
                (_, Some((center, radius))) if number % 2 == 0 => {
                    let depth = 1.0 - DEPTH * random.fraction();
                    let way = depth * radius / distance(&from, center);
                    let aside: [f64; 3] = random.in_ball();
                    std::array::from_fn(|k| {
                        center[k] + way * (from[k] - center[k]) + ASIDE * vacancy.nearest * aside[k]
                    })
                }
                _ => {
                    let way: [f64; 3] = random.in_ball();
                    std::array::from_fn(|k| from[k] + REACH * vacancy.nearest * way[k])
                }
            };
            let least = best.map_or(least_gain, |best| best.gain);
            if !x.iter().all(|x| x.is_finite()) || !view.hierarchy.contains(domain, &x) {
                continue;
            }
            if let Some(place) = vacancy.judge(view, &x, least)? {
                best = Some(place);
                if place.is_clean {
                    break;
                }
            }
        }
        Ok(best)
    }
}

impl State<3> {
    /// Returns the vertices of the simplices beside `sliver` that it has not itself, the infinite
    /// one at the hull.
    fn vertices_beside(&self, sliver: &Sliver) -> [VertexId; 4] {
        let complex = self.delaunay.complex();
        let neighbors = complex.neighbors(sliver.simplex);
        std::array::from_fn(|index| {
            let vertices = complex.vertices(neighbors[index]);
            let apex = vertices.iter().find(|vertex| !sliver.vertices.contains(vertex));
            apex.copied().unwrap_or(VertexId::INFINITE)
        })
    }
}
