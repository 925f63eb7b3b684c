//! NET(eps, P) of Theorem 3 (§9): a subset of P, of constant size for constant eps, that every open
//! ball or half-space with at least eps |P| points of P meets. Deterministic, linear time.
//!
//! Precisely: given D + 1 affinely independent *anchors* and a threshold t, the net N meets every
//! ball that holds t points of P or more and no anchor. A mesh takes the vertices of P's conflict
//! list for anchors: its D-balls never hold them. Without a mesh take points of P for anchors, as
//! part of the net.
//!
//! **Construction.** Keep the Delaunay complex of the anchors and N, and the points of P in each of
//! its D-balls. While some D-balls around an edge might cover a ball with t points (see `cover`),
//! choose a point in the fullest of them: one of a set X that any ball with nearly all of its
//! points must meet (see `center`). A point of X that is not chosen waits, and is preferred when a
//! D-ball that holds it is full.
//!
//! **The property** holds because the loop ends only when no ball can break it. It takes no
//! rounding into account since there is none: the in-ball tests are exact.
//!
//! **Size.** Say that a *member* is the set R of points in a full D-ball when an X is computed for
//! it. Every R has at least s = t/d points. When R' becomes a member after R, its D-ball holds no
//! point of R's X: a chosen one is a vertex, and a waiting one would have been preferred. So R'
//! misses at least |R| / 2^(d+1) points of R, and any two members differ in s / 2^(d+1) points or
//! more. Balls have VC-dimension d + 1, so there are O((2^(d+1) |P| / s)^(d+1)) members (Haussler,
//! "Sphere packing numbers for subsets of the Boolean n-cube", 1995), a constant for t = eps |P|;
//! each X has at most 2^(d+1) points. That is a safe constant, not a small one: observed are 14
//! points in 2D for eps = 1/4 and 40 in 3D for eps = 1/6, since the loop stops as soon as the
//! property holds.
//!
//! **Time.** As the size is constant, so is the number of D-balls ever made, and each point of P is
//! tested against each at most once: linear in |P|.

use crate::complex::{SimplexId, VertexId};
use crate::delaunay::{Cavity, Delaunay};
use crate::error::Result;
use crate::memory::{AllocResult, Array, TryGrow, reserve};
use crate::mesh::MAX_DIM;
use crate::netmesh::rounds::net::PointId;
use crate::netmesh::rounds::net::center::Center;
use crate::netmesh::rounds::net::cover::Rings;
use crate::netmesh::state::watch::Watch;

/// Makes nets; keeps its buffers from one to the next.
pub(in crate::netmesh) struct Net<const D: usize> {
    pub(in crate::netmesh) delaunay: Delaunay<D>,
    /// Simplex -> the points in its D-ball, in rising order; stale for a dead one.
    pub(in crate::netmesh) inside: Vec<Vec<PointId>>,
    chosen: Vec<PointId>,
    /// Point -> true if it is of an X, and not chosen yet.
    waiting: Vec<bool>,
    center: Center<D>,
    rings: Rings<D>,
    cavity: Cavity,
    created: Vec<SimplexId>,
    /// Number of in-ball tests of points, those that a D-ball's two parents answer included.
    tests: u64,
}

impl<const D: usize> Net<D> {
    pub fn new() -> AllocResult<Self> {
        Ok(Self {
            delaunay: Delaunay::new(Array::new())?,
            inside: Vec::new(),
            chosen: Vec::new(),
            waiting: Vec::new(),
            center: Center::default(),
            rings: Rings::default(),
            cavity: Cavity::default(),
            created: Vec::new(),
            tests: 0,
        })
    }

    /// Returns the net of `points`, as indices: every ball that holds `threshold` of them, at least
    /// one, and no anchor holds one of the net. Points and anchors are distinct.
    ///
    /// # Errors
    /// `Cancelled`, `OutOfMemory`.
    pub fn choose(
        &mut self,
        anchors: &[[f64; D]],
        points: &[[f64; D]],
        threshold: u32,
        watch: &mut Watch<'_, '_>,
    ) -> Result<&[PointId]> {
        self.begin(anchors, points, watch)?;
        loop {
            let before = self.chosen.len();
            let mut next = 0;
            while next < self.delaunay.point_count() {
                let vertex = VertexId::new(next);
                while let Some(simplex) =
                    self.rings.fullest(&mut self.delaunay, &self.inside, vertex, threshold)?
                {
                    let point = self.pick(simplex, points)?;
                    self.insert(point, simplex, points, watch)?;
                }
                next += 1;
            }
            // A later choice may have made new D-balls at an earlier vertex.
            if self.chosen.len() == before {
                return Ok(&self.chosen);
            }
        }
    }

    /// Returns the number of in-ball tests that all nets have made so far.
    #[cfg(test)]
    pub fn tests(&self) -> u64 {
        self.tests
    }

    /// Makes the complex of the anchors alone.
    pub(in crate::netmesh) fn begin(
        &mut self,
        anchors: &[[f64; D]],
        points: &[[f64; D]],
        watch: &mut Watch<'_, '_>,
    ) -> Result<()> {
        self.delaunay.clear();
        self.chosen.clear();
        self.waiting.clear();
        self.waiting.cover(points.len(), false)?;
        self.rings.restart(points.len())?;
        let mut vertices = [VertexId::NONE; MAX_DIM + 1];
        for (corner, anchor) in vertices.iter_mut().zip(anchors) {
            *corner = self.delaunay.add_point(*anchor)?;
        }
        self.delaunay.begin(&vertices[..=D])?;
        self.cover_simplices()?;
        for simplex in self.delaunay.complex().simplices() {
            let inside = &mut self.inside[simplex];
            inside.clear();
            for (i, point) in PointId::below(points.len()).zip(points) {
                watch.poll_after(1)?;
                if self.delaunay.in_conflict(simplex, point) {
                    inside.try_push(i)?;
                }
            }
            self.tests += points.len() as u64;
        }
        Ok(())
    }

    fn cover_simplices(&mut self) -> AllocResult<()> {
        while self.inside.len() < self.delaunay.complex().simplex_bound() {
            self.inside.try_push(Vec::new())?;
        }
        Ok(())
    }

    /// Returns the point to choose in the D-ball of `simplex`, which holds one.
    fn pick(&mut self, simplex: SimplexId, points: &[[f64; D]]) -> AllocResult<PointId> {
        let members = &self.inside[simplex];
        if let Some(&point) = members.iter().find(|&&i| self.waiting[i]) {
            return Ok(point);
        }
        let support = self.center.support(points, members)?;
        support.iter().for_each(|&i| self.waiting[i] = true);
        Ok(support[0])
    }

    /// Makes `point`, in the D-ball of `simplex`, part of the net.
    pub(in crate::netmesh) fn insert(
        &mut self,
        point: PointId,
        simplex: SimplexId,
        points: &[[f64; D]],
        watch: &mut Watch<'_, '_>,
    ) -> Result<()> {
        self.waiting[point] = false;
        self.chosen.try_push(point)?;
        let x = points[point];
        let vertex = self.delaunay.add_point(x)?;
        self.delaunay.find_cavity(simplex, &x, &mut self.cavity)?;
        self.delaunay.insert(vertex, &self.cavity, &mut self.created)?;
        self.cover_simplices()?;
        for at in 0..self.created.len() {
            let (facet, created) = (self.cavity.boundary[at], self.created[at]);
            let mut list = std::mem::take(&mut self.inside[created]);
            let within = &self.inside[facet.simplex];
            let beyond = &self.inside[facet.beyond];
            let work = within.len() + beyond.len();
            // The point itself is on the sphere: it leaves, and no exact arithmetic has to tell so.
            merge(within, beyond, &mut list, |i| {
                i != point && self.delaunay.in_conflict(created, &points[i])
            })?;
            self.inside[created] = list;
            self.tests += work as u64;
            watch.poll_after(work as u32)?;
        }
        Ok(())
    }
}

/// Collects the points of a new D-ball, from those of the two on its facet: it lies in their union,
/// and holds those that they share.
fn merge(
    within: &[PointId],
    beyond: &[PointId],
    list: &mut Vec<PointId>,
    holds: impl Fn(PointId) -> bool,
) -> AllocResult<()> {
    list.clear();
    reserve(list, within.len() + beyond.len())?;
    let (mut a, mut b) = (0, 0);
    while a < within.len() && b < beyond.len() {
        let (i, j) = (within[a], beyond[b]);
        if i == j || holds(i.min(j)) {
            list.push(i.min(j));
        }
        a += usize::from(i <= j);
        b += usize::from(j <= i);
    }
    list.extend(within[a..].iter().chain(&beyond[b..]).filter(|&&i| holds(i)));
    Ok(())
}
