//! Places and sizes of cages: MEDIALITY (§6.2) as INSERTINPUT needs it, and the radii that NEWCAGE
//! and GROWCAGE take.

use crate::complex::VertexId;
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::TryGrow;
use crate::netmesh::state::hierarchy::DomainId;
use crate::netmesh::state::{Mesher, State};
use crate::numerics::distance;
use crate::options::Output;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::ops::Range;

/// Site of a cage: its centre, its radius, and the domains around and inside it.
#[derive(Clone, Copy, Debug)]
pub(in crate::netmesh) struct CageSite {
    pub center: VertexId,
    pub radius: f64,
    pub parent: DomainId,
    /// The domain that the centre is that of already.
    pub inner: Option<DomainId>,
}

/// A vertex of M_Omega (Definition 3): one that lies in Omega, or the centre of a child of Omega.
#[derive(Clone, Copy)]
struct Member<const D: usize> {
    /// None if another partition has the centre.
    vertex: VertexId,
    point: [f64; D],
    child: Option<DomainId>,
}

impl<const D: usize> Member<D> {
    fn site(&self, radius: f64, parent: DomainId) -> CageSite {
        CageSite { center: self.vertex, radius, parent, inner: self.child }
    }
}

/// A cage for an input at distance g from its centre has at least this times g / epsilon for its
/// radius, so that the input is strictly inside epsilon r.
const SLACK: f64 = 1.001;

/// Room that the cages in the mesh of a sample have, relative to that which its inputs need, for
/// the inputs to come.
const SAMPLE_ROOM: f64 = 1.5;

/// Subnormal distances are rounded to whole units of the smallest double.
const ROUNDING: f64 = 4.0 * f64::from_bits(1);

/// Room that a cage must have, relative to that which it needs, in a mesh that FINISHMESH
/// completes: that fills the gap which the cage bridges, and the cage's vertices are then too many
/// (docs/decisions.md).
const ROOM_IF_FINISHED: f64 = 128.0;

/// A cage's vertices are representable where they are this many times the spacing of doubles apart.
pub(in crate::netmesh) const REPRESENTABLE: f64 = 16.0;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Returns the cage that INSERTINPUT makes before `input` goes in, around its nearest neighbour
    /// u in M_Omega. The paper asks for mediality |u-v| / |v-s| <= epsilon, s being the second
    /// nearest. That may leave the new cage encroached, and s need not be in U(v) when it is behind
    /// u. We ask for what the cage needs: no vertex within encroachment r / epsilon of u.
    pub(in crate::netmesh) fn wanted_cage(
        &mut self,
        input: VertexId,
        cavity: &Cavity,
    ) -> Result<Option<CageSite>> {
        let x = *self.state.delaunay.point(input);
        let parent = self.state.containing_domain(&x, cavity);
        let Some((center, distance)) = self.state.nearest_in_domain(&x, parent, cavity) else {
            return Ok(None);
        };
        let clearance = match center.child {
            Some(child) => self.state.hierarchy.node(child).outside,
            None => self.state.cells[center.vertex].nearest,
        };
        let most = self.state.radius_within(clearance) / self.state.spare_room();
        let most = most.min(self.state.room_inside(parent, &center.point));
        let least = self.state.radius_for(distance).max(self.state.smallest_radius(&center.point));
        let radius = self.lasting_radius(&center, least, most, cavity)?;
        Ok(radius.map(|radius| center.site(radius, parent)))
    }

    /// Returns the larger cage that GROWCAGE makes in place of `cage`, if there is room for it.
    /// (The paper compares Vor(C)'s in-radius (d + r)/2 with r / epsilon^2, but only the nearest
    /// outside vertex's distance d tells whether the new cage is un-encroached.)
    pub(in crate::netmesh) fn grown_site(
        &mut self,
        cage: DomainId,
        least: f64,
        cavity: &Cavity,
    ) -> Result<Option<CageSite>> {
        let parent = self.state.hierarchy.parent(cage);
        let node = self.state.hierarchy.node(cage);
        let center = Member { vertex: node.center, point: node.point, child: Some(cage) };
        let most = node.outside / self.state.outer_encroachment();
        let most = most.min(self.state.room_inside(parent, &center.point));
        let radius = self.lasting_radius(&center, least, most, cavity)?;
        Ok(radius.map(|radius| center.site(radius, parent)))
    }

    /// Returns the smallest radius in `least..=most` that no uninserted input nearby would encroach
    /// when its turn comes. Any radius in the range is a correct one; this one spares cages that
    /// would soon be released and leave their vertices behind. In the mesh of a sample, whose other
    /// inputs nobody knows, it is a larger one.
    fn lasting_radius(
        &mut self,
        center: &Member<D>,
        least: f64,
        most: f64,
        cavity: &Cavity,
    ) -> Result<Option<f64>> {
        if least > most {
            return Ok(None);
        }
        if self.state.parameters.is_sample {
            return Ok(Some(
                (SAMPLE_ROOM * least).min(least.sqrt() * most.sqrt()).clamp(least, most),
            ));
        }
        let max_distance = self.state.outer_encroachment();
        let mut radius = least;
        let range = self.state.parameters.epsilon * least..max_distance * most;
        // A heap, since often a few of very many are looked at.
        let mut distances = BinaryHeap::from(self.distances_nearby(center, range, cavity)?);
        while let Some(Reverse(bits)) = distances.pop() {
            self.watch.poll_after(1)?;
            let distance = f64::from_bits(bits);
            if distance >= max_distance * radius || radius > most {
                break;
            }
            if distance > self.state.parameters.epsilon * radius {
                radius = self.state.radius_for(distance);
            }
        }
        self.scratch.distances = distances.into_vec();
        Ok((radius <= most).then_some(radius))
    }

    /// Returns the distances in `range` from `center` to the uninserted inputs whose conflict lists
    /// are in `cavity` or next to the centre (or the cage of the child round it), as bits, which
    /// are ordered as distances are.
    fn distances_nearby(
        &mut self,
        center: &Member<D>,
        range: Range<f64>,
        cavity: &Cavity,
    ) -> Result<Vec<Reverse<u64>>> {
        let mut distances = std::mem::take(&mut self.scratch.distances);
        distances.clear();
        if self.state.conflict_lists.remaining() == 0 {
            return Ok(distances);
        }
        let near = &mut self.scratch.near;
        near.clear();
        near.try_extend(&cavity.simplices)?;
        let around: &[VertexId] = match center.child {
            Some(child) => &self.state.hierarchy.node(child).cage,
            None => &[center.vertex],
        };
        for &vertex in around {
            self.state.delaunay.star(vertex, &mut self.scratch.star)?;
            near.try_extend(&self.scratch.star)?;
        }
        near.sort_unstable();
        near.dedup();
        for &simplex in near.iter() {
            for input in self.state.conflict_lists.entries(simplex) {
                self.watch.poll_after(1)?;
                let distance = distance(self.state.delaunay.point(input), &center.point);
                if range.contains(&distance) {
                    distances.try_push(Reverse(distance.to_bits()))?;
                }
            }
        }
        Ok(distances)
    }
}

impl<const D: usize> State<D> {
    /// Returns the radius of a cage for a cluster that reaches no farther than `reach` from the
    /// vertex `center`, if there is `room` times as much as it needs within the `gap` around the
    /// cluster.
    pub(in crate::netmesh) fn concentrated_radius(
        &self,
        center: VertexId,
        reach: f64,
        gap: f64,
        room: f64,
    ) -> Option<f64> {
        let center = self.delaunay.point(center);
        let radius = self.radius_for(reach).max(self.smallest_radius(center));
        (room * radius <= self.radius_within(gap)).then_some(radius)
    }

    fn spare_room(&self) -> f64 {
        match self.parameters.output {
            Output::WellSpaced => ROOM_IF_FINISHED,
            Output::Auto | Output::Hierarchical => 1.0,
        }
    }

    /// Returns the radius of a cage that has an input at `distance` from its centre well inside.
    pub(in crate::netmesh) fn radius_for(&self, distance: f64) -> f64 {
        SLACK * distance / self.parameters.epsilon + ROUNDING
    }

    /// Returns the largest radius of a cage with the nearest vertex outside at distance
    /// `clearance`.
    fn radius_within(&self, clearance: f64) -> f64 {
        (clearance - ROUNDING) / self.outer_encroachment()
    }

    /// Returns the largest radius of a cage round a point of `parent` that stays inside its ball.
    /// With epsilon at most 0.5 the clearance asks for less.
    pub(in crate::netmesh) fn room_inside(&self, parent: DomainId, center: &[f64; D]) -> f64 {
        let radius = self.hierarchy.node(parent).radius;
        radius * (1.0 - 1e-9) - self.hierarchy.distance_to_center(parent, center)
    }

    /// Returns the smallest radius about a point that doubles can express: a cage around inputs
    /// that are a few units of roundoff apart is as large as that takes.
    fn smallest_radius(&self, center: &[f64; D]) -> f64 {
        let spacing = spacing_near(center);
        REPRESENTABLE * spacing / (self.parameters.delta * self.parameters.cage_scale)
    }

    /// Returns the vertex of M_Omega nearest to `x`, and its distance.
    fn nearest_in_domain(
        &mut self,
        x: &[f64; D],
        omega: DomainId,
        cavity: &Cavity,
    ) -> Option<(Member<D>, f64)> {
        let mut nearest = None;
        let mut least = f64::INFINITY;
        for at in 0..cavity.vertices.ids.len() {
            let Some(member) = self.representative(cavity.vertices.ids[at], omega) else {
                continue;
            };
            let distance = distance(x, &member.point);
            if distance < least {
                least = distance;
                nearest = Some((member, distance));
            }
        }
        nearest
    }

    /// Returns the member of M_Omega that stands for an inserted vertex: the vertex itself if it
    /// lies in Omega, or the centre of the child of Omega that holds it, or none.
    fn representative(&mut self, vertex: VertexId, omega: DomainId) -> Option<Member<D>> {
        if self.hierarchy.domain_of(vertex) == omega {
            return Some(Member { vertex, point: *self.delaunay.point(vertex), child: None });
        }
        let child = self.hierarchy.child_towards(omega, vertex)?;
        let node = self.hierarchy.node(child);
        Some(Member { vertex: node.center, point: node.point, child: Some(child) })
    }
}

/// Returns the largest distance between neighbouring doubles among the coordinates of `point`.
pub(in crate::netmesh) fn spacing_near<const D: usize>(point: &[f64; D]) -> f64 {
    let largest = point.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    largest.next_up() - largest
}
