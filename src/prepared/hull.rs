//! The convex hull of points, from the Delaunay triangulation of those that may be on it. This
//! keeps the triangulation small where that of all points is large, as it is for points on two
//! lines.

use super::plain;
use crate::arrays::ConvexHull;
use crate::error::{ErrorKind, Result};
use crate::memory::{AllocResult, TryGrow, collected, filled, with_capacity};
use crate::mesh::{Inputs, NONE, Triangulation, in_dimension};
use crate::netmesh;
use crate::numerics::{SplitMix, affine_basis};
use crate::query::Index;

/// Number of points for each dimension up to which no points are left out.
const FEW: usize = 100;

/// Number of directions, in one pass, in which outermost points are sought.
const DIRECTIONS: usize = 200;

/// Largest number of passes, each of which leaves out points inside the hull of outermost ones.
const PASSES: usize = 3;

/// Returns the hull of distinct points, `points x dim`; there must be at least two.
pub(super) fn of_points(dim: usize, points: &[f64]) -> Result<ConvexHull> {
    let candidates = candidates(dim, points)?;
    match candidates.solid {
        Some(solid) => ConvexHull::of_triangulation(solid),
        None => Ok(ConvexHull::of_flat_points(dim, select(dim, points, &candidates.ids)?)),
    }
}

/// Some of the points, among them all extreme ones.
struct Candidates {
    ids: Vec<u32>,
    /// Delaunay triangulation of these points; `None` if all points lie in a hyperplane.
    solid: Option<Triangulation>,
}

fn candidates(dim: usize, points: &[f64]) -> Result<Candidates> {
    let basis = basis(dim, points)?;
    match basis.len() - 1 {
        rank if rank == dim => of_full_rank(dim, points),
        0 | 1 => Ok(Candidates { ids: ends(dim, points, &basis), solid: None }),
        rank => {
            // A projection along axes that keeps the rank keeps what is extreme.
            let axes = independent_axes(dim, points, &basis, rank)?;
            let projected = project(dim, points, &axes)?;
            Ok(Candidates { ids: candidates(rank, &projected)?.ids, solid: None })
        }
    }
}

/// Returns a largest set of affinely independent points.
fn basis(dim: usize, points: &[f64]) -> AllocResult<Vec<usize>> {
    let count = points.len() / dim;
    in_dimension!(
        dim,
        D => {
            let point = |i: usize| std::array::from_fn(|axis| points[i * D + axis]);
            collected(affine_basis::<D>(count, point).iter().copied())
        },
        _ => Ok(Vec::new())
    )
}

/// Returns the two ends of points on a line.
fn ends(dim: usize, points: &[f64], basis: &[usize]) -> Vec<u32> {
    let (first, last) = (basis[0] * dim, basis[basis.len() - 1] * dim);
    let axis = (0..dim).find(|axis| points[first + axis] != points[last + axis]).unwrap_or(0);
    let coordinate = |id: &u32| points[*id as usize * dim + axis];
    let ids = 0..(points.len() / dim) as u32;
    let least = ids.clone().min_by(|a, b| coordinate(a).total_cmp(&coordinate(b)));
    let most = ids.max_by(|a, b| coordinate(a).total_cmp(&coordinate(b)));
    least.into_iter().chain(most).collect()
}

/// Returns axes onto which the basis projects to affinely independent points.
fn independent_axes(
    dim: usize,
    points: &[f64],
    basis: &[usize],
    rank: usize,
) -> AllocResult<Vec<usize>> {
    let ids = collected(basis.iter().map(|&id| id as u32))?;
    let of_basis = select(dim, points, &ids)?;
    for set in (0u32..1 << dim).filter(|set| set.count_ones() as usize == rank) {
        let axes = collected((0..dim).filter(|axis| set >> axis & 1 == 1))?;
        if self::basis(rank, &project(dim, &of_basis, &axes)?)?.len() == rank + 1 {
            return Ok(axes);
        }
    }
    collected(0..rank)
}

fn project(dim: usize, points: &[f64], axes: &[usize]) -> AllocResult<Vec<f64>> {
    let mut projected = with_capacity(points.len() / dim * axes.len())?;
    for point in points.chunks_exact(dim) {
        projected.extend(axes.iter().map(|&axis| point[axis]));
    }
    Ok(projected)
}

fn select(dim: usize, points: &[f64], ids: &[u32]) -> AllocResult<Vec<f64>> {
    let mut selected = with_capacity(ids.len() * dim)?;
    ids.iter().for_each(|&id| selected.extend_from_slice(&points[id as usize * dim..][..dim]));
    Ok(selected)
}

/// Returns candidates of points that do not lie in a hyperplane.
fn of_full_rank(dim: usize, points: &[f64]) -> Result<Candidates> {
    let mut ids = collected(0..(points.len() / dim) as u32)?;
    let mut directions = Directions(SplitMix(1));
    for _ in 0..PASSES {
        if ids.len() <= FEW * dim {
            break;
        }
        let Some(left) = without_inner(dim, points, &ids, &mut directions)? else { break };
        let is_worth_more = 2 * left.len() < ids.len();
        ids = left;
        if !is_worth_more {
            break;
        }
    }
    let solid = Some(triangulate(dim, &select(dim, points, &ids)?)?);
    Ok(Candidates { ids, solid })
}

fn triangulate(dim: usize, points: &[f64]) -> Result<Triangulation> {
    netmesh::run(&Inputs::new(dim, points.len() / dim, points, 0)?, None, &plain(), None)
}

/// Returns the points that are not inside the hull of some outermost points; `None` if these lie in
/// a hyperplane.
fn without_inner(
    dim: usize,
    points: &[f64],
    ids: &[u32],
    directions: &mut Directions,
) -> Result<Option<Vec<u32>>> {
    let mut outer = with_capacity(DIRECTIONS)?;
    for pass in 0..DIRECTIONS {
        let direction = directions.next(dim, pass);
        let height = |id: &u32| -> f64 {
            let point = &points[*id as usize * dim..][..dim];
            point.iter().zip(&direction).map(|(x, along)| x * along).sum()
        };
        outer.extend(ids.iter().copied().max_by(|a, b| height(a).total_cmp(&height(b))));
    }
    outer.sort_unstable();
    outer.dedup();
    let of_outer = select(dim, points, &outer)?;
    let solid = match triangulate(dim, &of_outer) {
        Err(error) if error.kind() == ErrorKind::DegenerateInput => return Ok(None),
        solid => solid?,
    };
    let mut simplices = filled(ids.len(), NONE)?;
    let index = Index::new(&solid)?;
    index.locate(&solid, &select(dim, points, ids)?, 1, &mut simplices)?;
    let mut left = Vec::new();
    for (&id, &simplex) in ids.iter().zip(&simplices) {
        if simplex == NONE || outer.binary_search(&id).is_ok() {
            left.try_push(id)?;
        }
    }
    Ok(Some(left))
}

/// Source of directions: the axes, then pseudo-random ones.
struct Directions(SplitMix);

impl Directions {
    fn next(&mut self, dim: usize, at: usize) -> [f64; 8] {
        let mut direction = [0.0; 8];
        match at / 2 {
            axis if axis < dim => direction[axis] = if at % 2 == 0 { 1.0 } else { -1.0 },
            _ => direction[..dim].iter_mut().for_each(|x| *x = self.number()),
        }
        direction
    }

    /// Returns a pseudo-random number with nearly normal distribution.
    fn number(&mut self) -> f64 {
        self.0.unit() + self.0.unit() + self.0.unit()
    }
}
