//! Where each simplex lies with respect to a convex body, such as the inputs' box.

use super::walk::Walk;
use crate::error::Result;
use crate::memory::{AllocResult, collected, with_capacity};
use crate::mesh::{Triangulation, in_dimension};
use crate::numerics::coordinates;
use crate::query::check_arrays;
use crate::query::view::View;

/// Where a simplex lies with respect to a convex body, exactly. A body in a hyperplane has no
/// simplex inside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Placement {
    /// All of it is in the body, whose boundary is part of it.
    Inside = 0,
    /// Its interior meets the body, and some of it is outside.
    Across = 1,
    /// Its interior does not meet the body.
    Outside = 2,
}

/// Where a vertex is.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Spot {
    Outside,
    /// In the body; perhaps on its boundary.
    In,
    /// On the boundary of a hull, where its triangulation has this vertex.
    Corner(u32),
    Interior,
}

/// Where each simplex of a mesh lies with respect to the least box with sides along the axes that
/// holds the `points` (`points x dim`, at least one). The union of the mesh must be convex, as that
/// of a result is.
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
            Spot::In
        } else {
            Spot::Outside
        }
    };
    let spots = collected((0..mesh.vertex_count() as u32).map(spot))?;
    let is_solid = (0..D).all(|axis| low[axis] < high[axis]);
    Walk::<D>::new(mesh, &spots, &corners, is_solid)?.placements()
}

/// The least box that holds points.
pub(super) fn bounds<const D: usize>(points: &[f64]) -> ([f64; D], [f64; D]) {
    let (mut low, mut high) = ([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
    for at in 0..points.len() / D {
        for (axis, &x) in coordinates::<D>(points, at).iter().enumerate() {
            low[axis] = low[axis].min(x);
            high[axis] = high[axis].max(x);
        }
    }
    (low, high)
}
