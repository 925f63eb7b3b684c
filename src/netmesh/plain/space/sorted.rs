//! The tetrahedra of a triangulation in an order that depends on nothing but their corners.

use super::super::output::Simplices;
use super::tetrahedra::{INFINITE, Tetrahedra};
use crate::error::Result;
use crate::memory::{TryGrow, filled, with_capacity};
use crate::mesh::NONE;
use crate::netmesh::state::watch::Watch;

impl Tetrahedra {
    /// Returns the finite tetrahedra, sorted by their corners, of which the least comes first and
    /// the least of the others second.
    pub fn sorted(&self, vertices: usize, watch: &mut Watch<'_, '_>) -> Result<Simplices> {
        let mut of_least = self.by_least_corner(vertices, watch)?;
        let count = of_least.tetrahedra.len();
        let mut numbers = filled(self.count(), NONE)?;
        let (mut simplices, mut neighbors) = (with_capacity(4 * count)?, with_capacity(4 * count)?);
        let mut sorted = Vec::new();
        for ends in of_least.starts.windows(2) {
            watch.poll_after(1)?;
            let own = &mut of_least.tetrahedra[ends[0] as usize..ends[1] as usize];
            sorted.clear();
            for &tetrahedron in own.iter() {
                let corners = self.corners(tetrahedron);
                sorted.try_push((order(&corners).map(|place| corners[place]), tetrahedron))?;
            }
            sorted.sort_unstable();
            for ((place, (corners, tetrahedron)), number) in own.iter_mut().zip(&sorted).zip(ends[0]..) {
                *place = *tetrahedron;
                numbers[*tetrahedron as usize] = number;
                simplices.extend(corners);
            }
        }
        for &tetrahedron in &of_least.tetrahedra {
            watch.poll_after(1)?;
            neighbors.extend(order(&self.corners(tetrahedron)).map(|place| {
                let other = self.twin(4 * tetrahedron + place as u32) / 4;
                numbers[other as usize]
            }));
        }
        Ok(Simplices { vertices: simplices, neighbors })
    }

    /// Returns the finite tetrahedra by their least corners.
    fn by_least_corner(&self, vertices: usize, watch: &mut Watch<'_, '_>) -> Result<Lists> {
        let all = 0..self.count() as u32;
        let mut starts = filled(vertices + 1, 0u32)?;
        for tetrahedron in all.clone() {
            watch.poll_after(1)?;
            if let Some(least) = self.least_corner(tetrahedron) {
                starts[least as usize + 1] += 1;
            }
        }
        for vertex in 0..vertices {
            starts[vertex + 1] += starts[vertex];
        }
        let mut tetrahedra = filled(starts[vertices] as usize, 0)?;
        for tetrahedron in all.rev() {
            watch.poll_after(1)?;
            if let Some(least) = self.least_corner(tetrahedron) {
                // Beginnings are ends until their list is full.
                let end = &mut starts[least as usize + 1];
                *end -= 1;
                tetrahedra[*end as usize] = tetrahedron;
            }
        }
        starts.rotate_left(1);
        starts[vertices] = tetrahedra.len() as u32;
        Ok(Lists { starts, tetrahedra })
    }

    /// Returns the least corner of a finite tetrahedron.
    #[inline]
    fn least_corner(&self, tetrahedron: u32) -> Option<u32> {
        let [a, b, c, d] = self.corners(tetrahedron);
        (d != INFINITE && !self.is_dead(tetrahedron)).then(|| a.min(b).min(c.min(d)))
    }
}

/// Tetrahedra of each vertex, one list after the other.
struct Lists {
    starts: Vec<u32>,
    tetrahedra: Vec<u32>,
}

/// Returns an even permutation of the places: that of the least corner, that of the least of the
/// others, and the other two.
#[inline]
fn order(corners: &[u32; 4]) -> [usize; 4] {
    const FIRST: [[usize; 4]; 4] = [[0, 1, 2, 3], [1, 0, 3, 2], [2, 3, 0, 1], [3, 2, 1, 0]];
    let lesser = |a: usize, b: usize| if corners[a] < corners[b] { a } else { b };
    let [first, a, b, c] = FIRST[lesser(lesser(0, 1), lesser(2, 3))];
    match lesser(a, lesser(b, c)) {
        second if second == a => [first, a, b, c],
        second if second == b => [first, b, c, a],
        _ => [first, c, a, b],
    }
}
