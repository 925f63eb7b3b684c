//! Feature sizes (Definition 5): f_S^Omega(x) is the distance from x to the second nearest point of
//! S_Omega, x itself being the nearest if it is one of them.
//!
//! For a vertex v of M_Omega the vertices come in the order of their distance from v by a
//! best-first search along Delaunay edges, since those within any distance of v are connected: the
//! next nearest is a neighbour of a nearer one. A child of Omega counts as its centre alone
//! (Definition 3). It is passed through at once, from its nearest vertex to all that have an edge
//! to its cage: what is inside may be any number. (A vertex that is deep in a child and has a
//! neighbour outside is followed only when the search comes to it from there.) Vertices outside
//! Omega are followed, and do not count; none is wanted beyond the diameter of Omega's ball.

use crate::complex::{IdSet, VertexId};
use crate::error::Result;
use crate::memory::{AllocResult, Id};
use crate::netmesh::state::Mesher;
use crate::netmesh::state::hierarchy::{DomainId, ROOT};
use crate::netmesh::state::observations::Search;
use crate::numerics::distance;

/// A search that visits this number of vertices ends without an answer.
const MOST_VISITED: usize = 4096;

/// The feature sizes of the mesh and of the inputs in it; `None` of fewer than two points.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct FeatureSizes {
    pub mesh: Option<f64>,
    pub inputs: Option<f64>,
}

/// Adds `id` to `set`. Returns true if it was not there.
fn is_new<Of>(set: &mut IdSet<Of>, id: Id<Of>) -> AllocResult<bool> {
    let before = set.ids.len();
    set.insert(id)?;
    Ok(set.ids.len() > before)
}

/// The points of M_Omega met so far, nearest first.
#[derive(Default)]
struct Met {
    points: u32,
    inputs: u32,
    sizes: FeatureSizes,
}

impl Met {
    fn add(&mut self, distance: f64, is_input: bool) {
        self.points += 1;
        if self.points == 2 {
            self.sizes.mesh = Some(distance);
        }
        if is_input {
            self.inputs += 1;
            if self.inputs == 2 {
                self.sizes.inputs = Some(distance);
            }
        }
    }
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// Returns f_M^Omega and f_P^Omega at `vertex`, which is one of M_Omega; P are the inputs
    /// inserted so far. `None` if the search became too long.
    pub(super) fn feature_sizes(
        &mut self,
        vertex: VertexId,
        omega: DomainId,
    ) -> Result<Option<FeatureSizes>> {
        let mut search = std::mem::take(&mut self.instruments.search);
        let sizes = self.search_features(&mut search, vertex, omega);
        self.instruments.search = search;
        sizes
    }

    fn search_features(
        &mut self,
        search: &mut Search,
        vertex: VertexId,
        omega: DomainId,
    ) -> Result<Option<FeatureSizes>> {
        let x = *self.state.delaunay.point(vertex);
        let diameter = match omega == ROOT {
            true => f64::INFINITY,
            false => 2.0 * self.state.hierarchy.node(omega).radius,
        };
        search.restart(self.state.delaunay.point_count(), self.state.hierarchy.len())?;
        search.seen.insert(vertex)?;
        search.push(0.0, vertex, false)?;
        let mut met = Met::default();
        for _ in 0..MOST_VISITED {
            self.watch.poll_after(16)?;
            let Some((distance, at, is_center)) = search.pop() else { return Ok(Some(met.sizes)) };
            if distance > diameter {
                return Ok(Some(met.sizes));
            }
            if is_center || self.state.hierarchy.domain_of(at) == omega {
                met.add(distance, self.state.is_input(at));
                if met.sizes.inputs.is_some() {
                    return Ok(Some(met.sizes));
                }
            }
            if !is_center {
                self.go_on_from(search, at, &x, omega)?;
            }
        }
        Ok(None)
    }

    fn go_on_from(
        &mut self,
        search: &mut Search,
        vertex: VertexId,
        x: &[f64; D],
        omega: DomainId,
    ) -> AllocResult<()> {
        let child = self.state.hierarchy.child_towards(omega, vertex);
        if let Some(child) = child {
            if is_new(&mut search.children, child)? {
                let node = self.state.hierarchy.node(child);
                search.push(distance(x, &node.point), node.center, true)?;
                for at in 0..self.state.hierarchy.node(child).cage.len() {
                    let vertex = self.state.hierarchy.node(child).cage[at];
                    search.seen.insert(vertex)?;
                    self.push_neighbors(search, vertex, x, omega, Some(child))?;
                }
            }
        }
        self.push_neighbors(search, vertex, x, omega, child)
    }

    /// Queues the neighbours of `vertex`, except those in the `child` of `omega` that it is in.
    fn push_neighbors(
        &mut self,
        search: &mut Search,
        vertex: VertexId,
        x: &[f64; D],
        omega: DomainId,
        child: Option<DomainId>,
    ) -> AllocResult<()> {
        self.state.delaunay.star(vertex, &mut search.star)?;
        search.work += search.star.len() as u64;
        for at in 0..search.star.len() {
            for index in 0..=D {
                let neighbor = self.state.delaunay.complex().vertices(search.star[at])[index];
                let skipped = !neighbor.is_valid()
                    || child.is_some()
                        && self.state.hierarchy.child_towards(omega, neighbor) == child;
                if !skipped && is_new(&mut search.seen, neighbor)? {
                    search.push(
                        distance(x, self.state.delaunay.point(neighbor)),
                        neighbor,
                        false,
                    )?;
                }
            }
        }
        Ok(())
    }
}
