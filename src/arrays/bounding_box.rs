//! Placement of simplices with respect to the bounding box of the inputs.

use super::cloud::bounds;
use super::placement::{Placement, Spot};
use super::walk::Walk;
use crate::error::Result;
use crate::memory::{AllocResult, collected, with_capacity};
use crate::mesh::{Triangulation, in_dimension};
use crate::query::check_arrays;
use crate::query::view::View;

/// Returns how each simplex of a mesh lies with respect to the bounding box of `points` (`points x
/// dim` coordinates, at least one point). The union of the mesh must be convex, as that of a result
/// is.
///
/// # Errors
/// `InvalidArgument` (arrays that do not fit together), `OutOfMemory`.
pub fn placements_in_box(mesh: &Triangulation, points: &[f64]) -> Result<Vec<Placement>> {
    check_arrays(mesh)?;
    let none = || Ok(Vec::new());
    Ok(in_dimension!(mesh.dim, D => in_box::<D>(mesh, points), _ => none())?)
}

fn in_box<const D: usize>(mesh: &Triangulation, points: &[f64]) -> AllocResult<Vec<Placement>> {
    let (low, high) = bounds::<D>(points);
    let corner = |set: usize| -> [f64; D] {
        std::array::from_fn(|axis| if set >> axis & 1 == 1 { high[axis] } else { low[axis] })
    };
    let mut corners = with_capacity(D << D)?;
    (0..1 << D).for_each(|set| corners.extend(corner(set)));
    let spot = |vertex: u32| {
        let point = View::<D> { mesh }.point(vertex);
        let all = |test: &dyn Fn(f64, usize) -> bool| (0..D).all(|axis| test(point[axis], axis));
        if all(&|x, axis| low[axis] < x && x < high[axis]) {
            Spot::Interior
        } else if all(&|x, axis| low[axis] <= x && x <= high[axis]) {
            Spot::Contained
        } else {
            Spot::Outside
        }
    };
    let spots = collected((0..mesh.vertex_count() as u32).map(spot))?;
    let is_solid = (0..D).all(|axis| low[axis] < high[axis]);
    Walk::<D>::new(mesh, &spots, &corners, is_solid)?.placements()
}
