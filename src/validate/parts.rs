//! What a certificate of a mesh in parts needs, which no process has all of: the signs of this one,
//! and radii of cells. Like it they share nothing with what builds meshes.

use super::signs::{Robust, Signs};
use crate::error::Result;
use crate::quality::corner::Corner;
use crate::quality::length::Length;
use std::cmp::Ordering;

/// The exact sign of det[p1 - p0, ..., pD - p0] for `D + 1` finite points.
///
/// # Errors
/// `OutOfMemory`.
pub fn orientation<const D: usize>(simplex: &[&[f64; D]]) -> Result<Ordering> {
    Ok(Signs::<Robust>::default().orientation(simplex)?)
}

/// Whether `q` is strictly inside (greater), on (equal) or strictly outside (less) the sphere through
/// the `D + 1` finite points of a positively oriented simplex. Exact.
///
/// # Errors
/// `OutOfMemory`.
pub fn in_ball<const D: usize>(simplex: &[&[f64; D]], q: &[f64; D]) -> Result<Ordering> {
    Ok(Signs::<Robust>::default().in_ball(simplex, q)?)
}

/// The Voronoi cell of a vertex, of as many of its simplices as were entered.
#[derive(Clone, Copy, Debug)]
pub struct Cell {
    nearest: Length,
    farthest: Length,
}

impl Default for Cell {
    fn default() -> Self {
        Self { nearest: Length::INFINITE, farthest: Length::ZERO }
    }
}

impl Cell {
    /// Out-radius over in-radius.
    pub fn aspect(&self) -> f64 {
        2.0 * self.farthest.ratio(self.nearest)
    }

    /// The distance to the nearest neighbour; 0 or infinity where that is no double.
    pub fn nearest(&self) -> f64 {
        self.nearest.to_f64()
    }
}

/// Enters a simplex into the cells of its `vertices`; answers its circumradius over its shortest edge,
/// infinite if it is flat.
///
/// # Errors
/// `OutOfMemory`.
///
/// # Panics
/// If a vertex has no cell.
pub fn enter<const D: usize>(
    cells: &mut [Cell],
    vertices: &[u32],
    points: &[&[f64; D]],
) -> Result<f64> {
    let corner = Corner::new(points)?;
    let radius = corner.as_ref().map_or(Length::INFINITE, |corner| corner.radius);
    for (i, &v) in vertices.iter().enumerate() {
        for (j, &w) in vertices.iter().enumerate().skip(i + 1) {
            let length = Length::between(points[i], points[j]);
            for vertex in [v, w] {
                let cell = &mut cells[vertex as usize];
                cell.nearest = cell.nearest.min(length);
            }
        }
        let cell = &mut cells[v as usize];
        cell.farthest = cell.farthest.max(radius);
    }
    Ok(corner.map_or(f64::INFINITY, |corner| corner.radius.ratio(corner.shortest_edge)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_has_the_cells_that_it_has() {
        let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let simplices = [[0, 1, 2], [0, 2, 3]];
        let mut cells = [Cell::default(); 4];
        for simplex in simplices {
            let corners = simplex.map(|v: u32| &points[v as usize]);
            assert_eq!(orientation(&corners).unwrap(), Ordering::Greater);
            let ratio = enter(&mut cells, &simplex, &corners).unwrap();
            assert!((ratio - 0.5f64.sqrt()).abs() < 1e-9, "{ratio}");
        }
        let corners = simplices[0].map(|v| &points[v as usize]);
        assert_eq!(in_ball(&corners, &points[3]).unwrap(), Ordering::Equal);
        assert_eq!(in_ball(&corners, &[0.5, 0.5]).unwrap(), Ordering::Greater);
        for cell in cells {
            assert!((cell.aspect() - 2f64.sqrt()).abs() < 1e-9);
            assert_eq!(cell.nearest(), 1.0);
        }
    }
}
