//! Poles (N. Amenta and M. Bern, "Surface reconstruction by Voronoi filtering", 1999; T. K. Dey,
//! "Curve and Surface Reconstruction", 2007, section 4.1).

use super::balls::{Balls, unit_vector};
use crate::memory::{AllocResult, filled};
use crate::mesh::NONE;
use crate::query::dual::dot;

/// The poles of a vertex: the circumcentres of its simplices that are farthest from it, one on each
/// side of the surface if the vertex is on one. The cell of such a vertex is long and thin, at
/// right angles to the surface.
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

/// Returns the poles of each vertex. Of balls of one size the first counts. O(simplices).
pub fn poles<const D: usize>(balls: &Balls<'_, D>) -> AllocResult<Vec<Poles>> {
    let none = Poles { first: NONE, second: NONE, opposition: 0.0 };
    let mut poles = filled(balls.view.mesh.vertex_count(), none)?;
    let mut directions = hull_normals(balls)?;
    directions.iter_mut().for_each(|direction| *direction = unit_vector(*direction));
    let is_farther =
        |simplex: u32, pole: u32| pole == NONE || balls.radius(simplex) > balls.radius(pole);
    for_each_corner(balls, |simplex, vertex| {
        let first = &mut poles[vertex as usize].first;
        if directions[vertex as usize] == [0.0; D] && is_farther(simplex, *first) {
            *first = simplex;
        }
    });
    for (vertex, (poles, direction)) in (0..).zip(poles.iter().zip(&mut directions)) {
        if poles.first != NONE {
            *direction = balls.direction(poles.first, vertex);
        }
    }
    for_each_corner(balls, |simplex, vertex| {
        let Poles { second, opposition, .. } = &mut poles[vertex as usize];
        if is_farther(simplex, *second) {
            let cosine = dot(&directions[vertex as usize], &balls.direction(simplex, vertex));
            if cosine < 0.0 {
                (*second, *opposition) = (simplex, -cosine);
            }
        }
    });
    Ok(poles)
}

/// Calls a function for each vertex of each simplex.
fn for_each_corner<const D: usize>(balls: &Balls<'_, D>, mut call: impl FnMut(u32, u32)) {
    for simplex in 0..balls.view.mesh.simplex_count() as u32 {
        balls.view.simplex(simplex).iter().for_each(|&vertex| call(simplex, vertex));
    }
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
