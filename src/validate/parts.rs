//! Tools for the certificate of a mesh in parts, which no process has all of: the signs of this
//! one, radii of cells, and the tree of domains. They share nothing with what builds meshes, as the
//! certificate does not.

use super::signs::{Robust, Signs};
use crate::error::Result;
use crate::memory::collected;
use crate::mesh::{Domain, NONE};
use crate::quality::corner::Corner;
pub use crate::quality::length::Length;
use crate::quality::tree::DomainTree;
use std::cmp::Ordering;

/// Returns the exact sign of det[p1 - p0, ..., pD - p0] for `D + 1` finite points.
///
/// # Errors
/// `OutOfMemory`.
pub fn orientation<const D: usize>(simplex: &[&[f64; D]]) -> Result<Ordering> {
    Ok(Signs::<Robust>::default().orientation(simplex)?)
}

/// Tells whether `q` is strictly inside (greater), on (equal) or strictly outside (less) the sphere
/// through the `D + 1` finite points of a positively oriented simplex. Exact.
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
    /// Returns the out-radius over the in-radius.
    pub fn aspect(&self) -> f64 {
        2.0 * self.farthest.ratio(self.nearest)
    }

    /// Returns the distance to the nearest neighbour; 0 or infinity where that is no double.
    pub fn nearest(&self) -> f64 {
        self.nearest.to_f64()
    }
}

/// A simplex with its corner, which is its circumcentre.
pub struct Simplex<'a, const D: usize> {
    points: &'a [&'a [f64; D]],
    /// Circumcentre; none of a flat simplex.
    corner: Option<Corner<D>>,
}

impl<'a, const D: usize> Simplex<'a, D> {
    /// Computes the corner of a simplex of `D + 1` points.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn new(points: &'a [&'a [f64; D]]) -> Result<Self> {
        Ok(Self { points, corner: Corner::new(points)? })
    }

    /// Returns the circumradius over the shortest edge, infinite if the simplex is flat.
    pub fn radius_edge(&self) -> f64 {
        let ratio = |corner: &Corner<D>| corner.radius.ratio(corner.shortest_edge);
        self.corner.as_ref().map_or(f64::INFINITY, ratio)
    }

    /// Returns the distance of the corner to a point, infinite if the simplex is flat.
    pub fn reach(&self, point: &[f64; D]) -> Length {
        let distance = |corner: &Corner<D>| corner.distance(self.points, point);
        self.corner.as_ref().map_or(Length::INFINITE, distance)
    }

    /// Enters the simplex into the cells of its `vertices`.
    ///
    /// # Panics
    /// If a vertex has no cell.
    pub fn enter(&self, cells: &mut [Cell], vertices: &[u32]) {
        let radius = self.corner.as_ref().map_or(Length::INFINITE, |corner| corner.radius);
        for (i, &v) in vertices.iter().enumerate() {
            for (j, &w) in vertices.iter().enumerate().skip(i + 1) {
                let length = Length::between(self.points[i], self.points[j]);
                for vertex in [v, w] {
                    let cell = &mut cells[vertex as usize];
                    cell.nearest = cell.nearest.min(length);
                }
            }
            let cell = &mut cells[v as usize];
            cell.farthest = cell.farthest.max(radius);
        }
    }
}

/// Domains of which each but the first has one before it for parent.
pub struct Tree(DomainTree);

impl Tree {
    /// Builds the tree of the domains with these parents; `None` if they make no tree. `parents[0]`
    /// does not count.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn new(parents: &[u32]) -> Result<Option<Self>> {
        let domain = |(at, &parent): (usize, &u32)| {
            let parent = if at == 0 { NONE } else { parent };
            Domain { center: NONE, parent, radius: 0.0 }
        };
        let domains = collected(parents.iter().enumerate().map(domain))?;
        Ok(DomainTree::new(&domains)?.map(Self))
    }

    /// Returns true if `domain` is `ancestor` or below it.
    pub fn holds(&self, ancestor: u32, domain: u32) -> bool {
        self.0.holds(ancestor, domain)
    }

    /// Returns the parent of a domain, or [`NONE`] for the first.
    pub fn parent(&self, domain: u32) -> u32 {
        self.0.parent(domain)
    }
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
            let vertices = simplex.map(|v: u32| &points[v as usize]);
            assert_eq!(orientation(&vertices).unwrap(), Ordering::Greater);
            let entered = Simplex::new(&vertices).unwrap();
            entered.enter(&mut cells, &simplex);
            assert!((entered.radius_edge() - 0.5f64.sqrt()).abs() < 1e-9);
            assert!((entered.reach(&[0.5, 1.5]).to_f64() - 1.0).abs() < 1e-9);
        }
        let vertices = simplices[0].map(|v| &points[v as usize]);
        assert_eq!(in_ball(&vertices, &points[3]).unwrap(), Ordering::Equal);
        assert_eq!(in_ball(&vertices, &[0.5, 0.5]).unwrap(), Ordering::Greater);
        for cell in cells {
            assert!((cell.aspect() - 2f64.sqrt()).abs() < 1e-9);
            assert_eq!(cell.nearest(), 1.0);
        }
    }

    #[test]
    fn a_flat_simplex_reaches_beyond_all() {
        let points = [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]];
        let vertices = [&points[0], &points[1], &points[2]];
        let flat = Simplex::new(&vertices).unwrap();
        assert_eq!((flat.radius_edge(), flat.reach(&points[0])), (f64::INFINITY, Length::INFINITE));
    }

    #[test]
    fn a_tree_holds_what_is_below() {
        assert!(Tree::new(&[NONE, 2, 1]).unwrap().is_none());
        let tree = Tree::new(&[7, 0, 1, 0]).unwrap().unwrap();
        assert_eq!((tree.parent(0), tree.parent(2)), (NONE, 1));
        assert!(tree.holds(1, 2) && tree.holds(0, 3) && !tree.holds(3, 2));
    }

    #[test]
    fn lengths_come_back_from_a_word() {
        for length in [0.0, 1.5, 1e-310, f64::MAX, f64::INFINITY].map(Length::new) {
            assert_eq!(Length::from_word(length.times(3.0).to_word()), length.times(3.0));
        }
    }
}
