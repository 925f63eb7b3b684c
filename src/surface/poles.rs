//! Poles (N. Amenta and M. Bern, "Surface reconstruction by Voronoi filtering", 1999; T. K. Dey,
//! "Curve and Surface Reconstruction", 2007, section 4.1).

use super::balls::{Balls, unit_vector};
use crate::memory::{AllocResult, Lists, collected, filled};
use crate::mesh::NONE;
use crate::query::dual::dot;

/// The poles of a vertex: the circumcentres of its simplices that are farthest from it, one on each
/// side of the surface if the vertex is on one. The cell of such a vertex is long and thin, at right
/// angles to the surface.
#[derive(Clone, Copy, Debug)]
pub struct Poles {
    /// The simplex of the farthest circumcentre; [`NONE`] for a vertex of the hull, whose cell
    /// reaches to infinity.
    pub first: u32,
    /// The simplex of the farthest circumcentre in the halfspace away from the first; [`NONE`] if
    /// there is none.
    pub second: u32,
    /// Minus the cosine of the angle between the directions to the two: 1 where they are opposite.
    pub opposition: f64,
}

/// Returns the poles of each vertex. O(simplices).
pub fn poles<const D: usize>(balls: &Balls<'_, D>, stars: &Lists) -> AllocResult<Vec<Poles>> {
    let normals = hull_normals(balls)?;
    let count = balls.view.mesh.vertex_count();
    collected((0..count).map(|vertex| poles_of(balls, stars.of(vertex), vertex as u32, &normals)))
}

/// Returns for each vertex the sum of the outward normals of the facets of the hull that it has.
fn hull_normals<const D: usize>(balls: &Balls<'_, D>) -> AllocResult<Vec<[f64; D]>> {
    let mesh = balls.view.mesh;
    let mut normals = filled(mesh.vertex_count(), [0.0; D])?;
    for (at, _) in mesh.neighbors.iter().enumerate().filter(|(_, neighbor)| **neighbor == NONE) {
        let (simplex, corner) = ((at / (D + 1)) as u32, at % (D + 1));
        let outward = balls.outward(simplex, corner);
        for (k, &vertex) in balls.view.simplex(simplex).iter().enumerate() {
            if k != corner {
                let sum = &mut normals[vertex as usize];
                *sum = std::array::from_fn(|i| sum[i] + outward[i]);
            }
        }
    }
    Ok(normals)
}

fn poles_of<const D: usize>(
    balls: &Balls<'_, D>,
    star: &[u32],
    vertex: u32,
    normals: &[[f64; D]],
) -> Poles {
    let outward = unit_vector(normals[vertex as usize]);
    let (first, direction) = match outward == [0.0; D] {
        true => match farthest(balls, star.iter().copied()) {
            NONE => (NONE, outward),
            first => (first, balls.direction(first, vertex)),
        },
        false => (NONE, outward),
    };
    let cosine = |simplex: u32| dot(&direction, &balls.direction(simplex, vertex));
    let second = farthest(balls, star.iter().copied().filter(|&simplex| cosine(simplex) < 0.0));
    let opposition = if second == NONE { 0.0 } else { -cosine(second) };
    Poles { first, second, opposition }
}

/// Returns the simplex with the largest ball, of equal ones the first.
fn farthest<const D: usize>(balls: &Balls<'_, D>, star: impl Iterator<Item = u32>) -> u32 {
    let larger = |a: u32, b: u32| if balls.radius(b) > balls.radius(a) { b } else { a };
    star.reduce(larger).unwrap_or(NONE)
}
