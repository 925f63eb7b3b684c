//! A tree of the boxes of simplices, for points that no simplex holds but some nearly do.

use super::barycentric::coordinates_in;
use super::index::{check_arrays, no_dimension};
use super::threads::{Work, on_threads};
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

    /// Returns false if in no simplex of these all coordinates of `q` can be at least -`tolerance`:
    /// it is then farther from the box than the tolerance lets simplices grow, `dim` times the
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
    /// barycentric coordinates leave the range from 0 to 1 the least, by at most `tolerance`; the
    /// least id of equal ones. Sets `simplices` and `weights`, which have what
    /// [`Index::weigh`](super::Index::weigh) has written, where there is one.
    ///
    /// # Errors
    /// `InvalidArgument` (a length, a mesh other than that of the tree, a tolerance that is
    /// negative or not finite), `NonFinite` (names the point), `Cancelled` (by what stops the
    /// work), `OutOfMemory`.
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

/// Divides the simplices of a node with so many leaves below it among these, near ones together,
/// and sets its bounds and those below.
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
    let (threads, piece) = work.shares(simplices.len());
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
    /// Excess of the coordinates in the best simplex, and that simplex.
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
        let excess = excess(&weights[..=D]);
        let is_better =
            self.best.is_none_or(|(least, id)| excess < least || (excess == least && simplex < id));
        if excess <= self.tolerance && is_better {
            (self.best, self.weights) = (Some((excess, simplex)), weights);
        }
    }
}

/// Returns by how much the farthest of the weights is outside the range from 0 to 1; infinity where
/// one is no number, as in a simplex that is flat for doubles.
fn excess(weights: &[f64]) -> f64 {
    let beyond = |weight: &f64| match weight.is_nan() {
        true => f64::INFINITY,
        false => (-weight).max(weight - 1.0),
    };
    weights.iter().map(beyond).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::query::Index;
    use crate::query::tests::{delaunay, each_mesh, hard_points, meshed};

    /// Returns the simplex that `q` is the least outside of, by a look at all.
    fn best<const D: usize>(mesh: &Triangulation, q: &[f64; D], tolerance: f64) -> u32 {
        let view = View::<D> { mesh };
        let mut best = (tolerance, NONE);
        for simplex in 0..mesh.simplex_count() as u32 {
            let vertices = &view.points_of(view.simplex(simplex))[..=D];
            let weights = coordinates_in(vertices, (1 << (D + 1)) - 1, q);
            let (low, high) = weights[..=D]
                .iter()
                .fold((0.0f64, 1.0f64), |(low, high), &weight| (low.min(weight), high.max(weight)));
            let excess = (-low).max(high - 1.0);
            // The weights in a simplex that is flat for doubles need not combine its vertices to
            // the point.
            let is_sound = weights[..=D].iter().all(|weight| weight.is_finite())
                && Bounds::of_simplex(view, simplex).may_hold(q, tolerance);
            if is_sound && (excess < best.0 || (excess == best.0 && best.1 == NONE)) {
                best = (excess, simplex);
            }
        }
        best.1
    }

    fn answers_are_right<const D: usize>(count: usize, queries: usize) {
        each_mesh::<D>(count, |mesh, _| {
            let mesh = mesh.triangulation().unwrap();
            let (index, boxes) = (Index::new(mesh).unwrap(), SimplexBoxes::new(mesh).unwrap());
            let points = hard_points::<D>(mesh, queries);
            let flat = points.as_flattened();
            for tolerance in [1e-13, 0.01, 0.4] {
                let mut simplices = vec![0; points.len()];
                let mut weights = vec![0.0; points.len() * (D + 1)];
                index.weigh(mesh, flat, 1, &mut simplices, &mut weights).unwrap();
                let held = simplices.clone();
                boxes.weigh_within(mesh, tolerance, flat, 2, &mut simplices, &mut weights).unwrap();
                for (at, q) in points.iter().enumerate() {
                    let own = &weights[at * (D + 1)..][..D + 1];
                    let least = own.iter().copied().fold(f64::INFINITY, f64::min);
                    if held[at] != NONE {
                        assert_eq!(simplices[at], held[at]);
                        continue;
                    }
                    assert_eq!(simplices[at], best(mesh, q, tolerance), "{q:?} {tolerance}");
                    let is_nan = own.iter().all(|weight| weight.is_nan());
                    let largest = own.iter().copied().fold(0.0, f64::max);
                    let is_near = least >= -tolerance && largest <= 1.0 + tolerance;
                    assert!(if simplices[at] == NONE { is_nan } else { is_near });
                }
            }
        });
    }

    #[test]
    fn a_point_outside_has_the_simplex_that_it_is_least_outside_of() {
        answers_are_right::<2>(30, 20);
        answers_are_right::<3>(10, 6);
        answers_are_right::<4>(7, 2);
    }

    #[test]
    fn weights_combine_vertices_to_the_point() {
        let points = [[0.0, 0.0], [4.0, 0.0], [0.0, 4.0], [4.0, 4.0]];
        let mesh = meshed(&points, &delaunay()).unwrap();
        let mesh = mesh.triangulation().unwrap();
        let index = Index::new(mesh).unwrap();
        let (mut simplices, mut weights) = ([9; 3], [9.0; 9]);
        let queries = [1.0, 0.0, 4.0, 4.0, 5.0, 5.0];
        index.weigh(mesh, &queries, 1, &mut simplices, &mut weights).unwrap();
        for (at, q) in queries.chunks(2).enumerate().take(2) {
            let own = &weights[3 * at..][..3];
            let mut sum = [0.0; 2];
            for (&vertex, weight) in mesh.simplex(simplices[at] as usize).iter().zip(own) {
                let point = mesh.point(vertex);
                (0..2).for_each(|axis| sum[axis] += weight * point[axis]);
            }
            assert_eq!(sum, q);
            // One is on an edge, the other one a vertex.
            assert_eq!(own.iter().filter(|&&weight| weight == 0.0).count(), at + 1);
        }
        assert!(simplices[2] == NONE && weights[6..].iter().all(|weight| weight.is_nan()));
    }

    #[test]
    fn what_is_wrong_is_refused() {
        let points = [[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]];
        let mesh = meshed(&points, &delaunay()).unwrap();
        let mesh = mesh.triangulation().unwrap();
        let boxes = SimplexBoxes::new(mesh).unwrap();
        let refusal = |tolerance: f64, points: &[f64], weights: &mut [f64]| {
            let found = boxes.weigh_within(mesh, tolerance, points, 1, &mut [NONE], weights);
            found.unwrap_err().message().to_owned()
        };
        let (x, weights) = ([1.0, 1.0], &mut [0.0; 3]);
        for tolerance in [-1.0, f64::INFINITY, f64::NAN] {
            let rule = format!("tol is {tolerance}; it must be at least 0 and finite");
            assert_eq!(refusal(tolerance, &x, weights), rule);
        }
        assert!(refusal(0.0, &x[1..], weights).starts_with("points has length 1; it must be"));
        assert!(refusal(0.0, &x, &mut weights[1..]).starts_with("weights has length 2; it must"));
        assert_eq!(refusal(0.0, &[0.0, f64::NAN], weights), "points[0] is not finite");
        let other = meshed(&[[0.0, 0.0], [4.0, 0.0], [0.0, 4.0], [1.0, 1.0]], &delaunay()).unwrap();
        let other = other.triangulation().unwrap();
        let found = boxes.weigh_within(other, 0.0, &x, 1, &mut [NONE], weights);
        assert_eq!(found.unwrap_err().message(), "the boxes were made for another mesh");
    }
}
