//! The tetrahedra of a triangulation in an order that depends on nothing but their corners.

use super::super::output::Simplices;
use super::tetrahedra::{INFINITE, Record, Tetrahedra};
use crate::error::Result;
use crate::memory::{TryGrow, filled, prefetch_at, with_capacity};
use crate::mesh::NONE;
use crate::netmesh::state::watch::Watch;

/// Tetrahedra that are fetched while others are sorted.
const AHEAD: usize = 16;

impl Tetrahedra {
    /// Returns the finite tetrahedra, sorted by their corners, of which the least comes first and
    /// the least of the others second.
    pub fn sorted(&self, vertices: usize, watch: &mut Watch<'_, '_>) -> Result<Simplices> {
        let of_least = self.by_least_corner(vertices, watch)?;
        let count = of_least.tetrahedra.len();
        let mut numbers = filled(self.count(), NONE)?;
        let (mut simplices, mut neighbors) = (with_capacity(4 * count)?, with_capacity(4 * count)?);
        let mut own = Vec::new();
        for ends in of_least.starts.windows(2) {
            watch.poll_after(1)?;
            own.clear();
            for at in ends[0] as usize..ends[1] as usize {
                if let Some(&later) = of_least.tetrahedra.get(at + AHEAD) {
                    prefetch_at(self.all(), later as usize, 1);
                }
                let tetrahedron = of_least.tetrahedra[at];
                let record = self.at(tetrahedron);
                let (corners, twins) = (record.corners(), record.twins());
                let order = order(&corners);
                let row = |of: [u32; 4]| order.map(|place| of[place]);
                own.try_push((row(corners), row(twins), tetrahedron))?;
            }
            own.sort_unstable();
            for ((corners, twins, tetrahedron), number) in own.iter().zip(ends[0]..) {
                numbers[*tetrahedron as usize] = number;
                simplices.extend(corners);
                neighbors.extend(twins);
            }
        }
        for neighbor in &mut neighbors {
            watch.poll_after(1)?;
            *neighbor = numbers[(*neighbor / 4) as usize];
        }
        Ok(Simplices { vertices: simplices, neighbors })
    }

    /// Returns the finite tetrahedra by their least corners.
    fn by_least_corner(&self, vertices: usize, watch: &mut Watch<'_, '_>) -> Result<Lists> {
        let mut starts = filled(vertices + 1, 0u32)?;
        for record in self.all() {
            watch.poll_after(1)?;
            if let Some(least) = least_corner(record) {
                starts[least as usize + 1] += 1;
            }
        }
        for vertex in 0..vertices {
            starts[vertex + 1] += starts[vertex];
        }
        let mut tetrahedra = filled(starts[vertices] as usize, 0)?;
        for (record, tetrahedron) in self.all().iter().zip(0..) {
            watch.poll_after(1)?;
            if let Some(least) = least_corner(record) {
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
}

/// Returns the least corner of a finite tetrahedron.
#[inline]
fn least_corner(record: &Record) -> Option<u32> {
    let [a, b, c, d] = record.corners();
    (d != INFINITE && !record.is_dead()).then(|| a.min(b).min(c.min(d)))
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
