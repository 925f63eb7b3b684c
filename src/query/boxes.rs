//! A tree of the boxes of simplices, for points that no simplex holds but some nearly do.

use super::barycentric::coordinates_in;
use super::index::{check_arrays, no_dimension};
use super::threads::{Work, on_threads, piece, threads};
use super::view::View;
use super::weigh::check_weights;
use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::{AllocResult, collected, filled};
use crate::mesh::{MAX_DIM, NONE, Triangulation, in_dimension};
use crate::nearest::Stop;
use crate::numerics::coordinates;

/// The most simplices of a leaf.
const LEAF: usize = 8;

/// Box that holds the boxes of some simplices, and the largest of their extents along each axis.
#[derive(Clone, Copy)]
struct Bounds {
    low: [f64; MAX_DIM],
    high: [f64; MAX_DIM],
    /// Half of the largest extent, which is a double even where the extent is not.
    half: [f64; MAX_DIM],
}

impl Bounds {
    const EMPTY: Self = Self {
        low: [f64::INFINITY; MAX_DIM],
        high: [f64::NEG_INFINITY; MAX_DIM],
        half: [0.0; MAX_DIM],
    };

    fn of_simplex<const D: usize>(view: View<'_, D>, simplex: u32) -> Self {
        let mut bounds = Self::EMPTY;
        for &vertex in view.simplex(simplex) {
            for (axis, &x) in view.point(vertex).iter().enumerate() {
                bounds.low[axis] = bounds.low[axis].min(x);
                bounds.high[axis] = bounds.high[axis].max(x);
            }
        }
        for axis in 0..D {
            bounds.half[axis] = 0.5 * bounds.high[axis] - 0.5 * bounds.low[axis];
        }
        bounds
    }

    fn join(&mut self, other: &Self) {
        for axis in 0..MAX_DIM {
            self.low[axis] = self.low[axis].min(other.low[axis]);
            self.high[axis] = self.high[axis].max(other.high[axis]);
            self.half[axis] = self.half[axis].max(other.half[axis]);
        }
    }

    /// Returns false if no simplex of these can have `q` at coordinates of at least -`tolerance`: it
    /// is then farther from the box than the tolerance lets simplices grow, `dim` times the
    /// tolerance of their extent.
    fn may_hold<const D: usize>(&self, q: &[f64; D], tolerance: f64) -> bool {
        // The coordinates are rounded, too.
        let growth = 2.0 * D as f64 * (tolerance + 1e-12);
        (0..D).all(|axis| {
            let margin = growth * self.half[axis];
            q[axis] >= self.low[axis] - margin && q[axis] <= self.high[axis] + margin
        })
    }
}

/// A tree of the simplices of a mesh by their boxes. It takes 4 bytes a simplex and about 50 more.
pub struct SimplexBoxes {
    dim: usize,
    /// All simplices; the leaves are equal parts of them.
    order: Vec<u32>,
    /// Nodes, the children of node k at 2k + 1 and 2k + 2.
    nodes: Vec<Bounds>,
}

impl SimplexBoxes {
    /// Builds the tree. O(simplices log simplices).
    ///
    /// # Errors
    /// `InvalidArgument` (arrays that do not fit together, or ids out of range), `OutOfMemory`.
    pub fn new(mesh: &Triangulation) -> Result<Self> {
        check_arrays(mesh)?;
        Ok(in_dimension!(mesh.dim, D => build::<D>(mesh), _ => return no_dimension())?)
    }

    /// Finds simplices for those of the points (`count x dim`) that have none: the one in which the
    /// least barycentric coordinate is largest, and at least -`tolerance`; the least id of equal
    /// ones. Sets `simplices` and `weights`, which have what [`Index::weigh`](super::Index::weigh)
    /// has written, where there is one.
    ///
    /// # Errors
    /// `InvalidArgument` (a length, a mesh other than that of the tree, a tolerance that is negative
    /// or not finite), `NonFinite` (names the point), `Cancelled` (by what stops the work),
    /// `OutOfMemory`.
    pub fn weigh_within<'a>(
        &self,
        mesh: &Triangulation,
        tolerance: f64,
        points: &[f64],
        work: impl Into<Work<'a>>,
        simplices: &mut [u32],
        weights: &mut [f64],
    ) -> Result<()> {
        let work = work.into();
        if self.order.len() != mesh.simplex_count() || self.dim != mesh.dim {
            return Err(Error::invalid("the boxes were made for another mesh"));
        }
        if !(0.0..f64::INFINITY).contains(&tolerance) {
            let message = message!("tol is {tolerance}; it must be at least 0 and finite");
            return Err(Error::invalid(message));
        }
        if points.len() != simplices.len() * self.dim {
            return Err(Error::invalid(message!(
                "points has length {}; it must be points x dim = {} x {}",
                points.len(),
                simplices.len(),
                self.dim
            )));
        }
        check_weights(self.dim, simplices.len(), weights)?;
        if let Some(at) = points.iter().position(|x| !x.is_finite()) {
            let message = message!("points[{}] is not finite", at / self.dim);
            return Err(Error::new(ErrorKind::NonFinite, message));
        }
        let found = in_dimension!(
            self.dim,
            D => weigh_in::<D>(self, mesh, tolerance, points, work, simplices, weights),
            _ => return no_dimension()
        );
        found?;
        work.check()
    }
}

fn build<const D: usize>(mesh: &Triangulation) -> AllocResult<SimplexBoxes> {
    let (view, count) = (View::<D> { mesh }, mesh.simplex_count());
    let mut order = collected(0..count as u32)?;
    let leaves = count.div_ceil(LEAF).next_power_of_two();
    let mut nodes = filled(2 * leaves - 1, Bounds::EMPTY)?;
    sort_node(view, 0, leaves, &mut order, &mut nodes);
    Ok(SimplexBoxes { dim: D, order, nodes })
}

/// Divides the simplices of a node with so many leaves below it among these, near ones together, and
/// sets its bounds and those below.
fn sort_node<const D: usize>(
    view: View<'_, D>,
    node: usize,
    leaves: usize,
    simplices: &mut [u32],
    nodes: &mut [Bounds],
) {
    let mut bounds = Bounds::EMPTY;
    simplices.iter().for_each(|&simplex| bounds.join(&Bounds::of_simplex(view, simplex)));
    nodes[node] = bounds;
    if leaves == 1 || simplices.is_empty() {
        return;
    }
    let extent = |axis: &usize| 0.5 * bounds.high[*axis] - 0.5 * bounds.low[*axis];
    let longest = (0..D).max_by(|a, b| extent(a).total_cmp(&extent(b))).unwrap_or(0);
    let middle = middle(simplices.len(), leaves);
    let center = |simplex: &u32| {
        let of_simplex = Bounds::of_simplex(view, *simplex);
        0.5 * of_simplex.low[longest] + 0.5 * of_simplex.high[longest]
    };
    if middle < simplices.len() {
        simplices.select_nth_unstable_by(middle, |a, b| center(a).total_cmp(&center(b)));
    }
    let (first, second) = simplices.split_at_mut(middle);
    sort_node(view, 2 * node + 1, leaves / 2, first, nodes);
    sort_node(view, 2 * node + 2, leaves / 2, second, nodes);
}

/// Returns how many of the simplices of a node belong to its first child.
fn middle(count: usize, leaves: usize) -> usize {
    count.min(count.div_ceil(leaves) * (leaves / 2))
}

fn weigh_in<const D: usize>(
    boxes: &SimplexBoxes,
    mesh: &Triangulation,
    tolerance: f64,
    points: &[f64],
    work: Work<'_>,
    simplices: &mut [u32],
    weights: &mut [f64],
) -> AllocResult<()> {
    let threads = threads(work.threads);
    let piece = piece(simplices.len(), threads);
    let out = simplices.chunks_mut(piece).zip(weights.chunks_mut(piece * (D + 1)));
    let pieces = points.chunks(piece * D).zip(out);
    on_threads(threads, pieces, |_: &mut (), (points, (simplices, weights))| {
        for (at, simplex) in simplices.iter_mut().enumerate() {
            if *simplex != NONE || work.stop.is_set() {
                continue;
            }
            let (view, q) = (View::<D> { mesh }, coordinates::<D>(points, at));
            let mut search = Search {
                view,
                boxes,
                q,
                tolerance,
                stop: work.stop,
                best: None,
                weights: [0.0; 9],
            };
            search.visit(0, boxes.nodes.len().div_ceil(2), &boxes.order);
            if let Some((_, found)) = search.best {
                *simplex = found;
                let out = &mut weights[at * (D + 1)..][..D + 1];
                out.copy_from_slice(&search.weights[..=D]);
            }
        }
        Ok(())
    })
}

/// Search for the simplex that nearly holds a point.
struct Search<'a, const D: usize> {
    view: View<'a, D>,
    boxes: &'a SimplexBoxes,
    q: &'a [f64; D],
    tolerance: f64,
    stop: Stop<'a>,
    /// The least coordinate in the best simplex, and that simplex.
    best: Option<(f64, u32)>,
    weights: [f64; MAX_DIM + 1],
}

impl<const D: usize> Search<'_, D> {
    fn visit(&mut self, node: usize, leaves: usize, simplices: &[u32]) {
        let may_hold = self.boxes.nodes[node].may_hold(self.q, self.tolerance);
        if !may_hold || self.stop.is_set() {
            return;
        }
        if leaves == 1 {
            return simplices.iter().for_each(|&simplex| self.try_simplex(simplex));
        }
        let (first, second) = simplices.split_at(middle(simplices.len(), leaves));
        self.visit(2 * node + 1, leaves / 2, first);
        self.visit(2 * node + 2, leaves / 2, second);
    }

    fn try_simplex(&mut self, simplex: u32) {
        if !Bounds::of_simplex(self.view, simplex).may_hold(self.q, self.tolerance) {
            return;
        }
        let vertices = &self.view.points_of(self.view.simplex(simplex))[..=D];
        let weights = coordinates_in(vertices, (1 << (D + 1)) - 1, self.q);
        let least = weights[..=D].iter().copied().fold(f64::INFINITY, f64::min);
        // A simplex that is flat for doubles may have weights that are no numbers.
        let holds = least >= -self.tolerance && weights[..=D].iter().all(|w| w.is_finite());
        let is_better =
            self.best.is_none_or(|(most, id)| least > most || (least == most && simplex < id));
        if holds && is_better {
            (self.best, self.weights) = (Some((least, simplex)), weights);
        }
    }
}
