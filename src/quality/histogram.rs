//! Histograms: how the measures of a mesh are spread over its simplices and cells.

use super::angles::{angle, for_each_squared_tangent, smallest_squared_tangent};
use super::cells::Cells;
use super::corner::Corner;
use super::is_consistent;
use super::tree::DomainTree;
use super::view::View;
use crate::error::{Error, Result, message};
use crate::memory::{AllocResult, filled};
use crate::mesh::{NONE, Triangulation, in_dimension};

/// Measure of the simplices or cells of a mesh that a histogram counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(i32)]
pub enum Measure {
    /// The angles between any two facets of a simplex, in degrees: 3 angles of a triangle, 6
    /// dihedral angles of a tetrahedron, D (D + 1) / 2 in dimension D. A flat simplex, which no
    /// mesh has, counts as so many angles of 0.
    DihedralAngle = 0,
    /// Circumradius over shortest edge, one for each simplex.
    RadiusEdge = 1,
    /// Out-radius over in-radius, one for each Voronoi cell off the hull: of the vertices in no
    /// cage, and of the cages other than the root's. All corners count, and precision-limited
    /// cells do, as for [`super::Quality::worst_aspect_anywhere`].
    Aspect = 2,
    /// The smallest of the angles of [`Measure::DihedralAngle`], one for each simplex.
    SmallestAngle = 3,
}

/// Number of values of a measure in each of some intervals.
#[derive(Clone, Debug, PartialEq)]
pub struct Histogram {
    /// Number of values in each interval, one more than there were edges: below the first edge, in
    /// each bin, above the last edge. A bin has the values from its lower edge to below its upper
    /// one; the last bin has its upper edge, too.
    pub counts: Vec<u64>,
    /// The least value, infinity if there is none.
    pub least: f64,
    /// The largest value, minus infinity if there is none.
    pub largest: f64,
}

/// Counts the values of `measure`. `edges` bound the bins and ascend; a single edge tells how many
/// values are below it and how many are not. Without `at_hull` simplices with a vertex on the hull
/// are left out, as from the figures of [`super::Quality`]. An aspect is of a cell off the hull in
/// any case: others are not bounded. A triangulation whose arrays do not fit together has no value.
///
/// O(simplices log(edges)) for a fixed dimension.
///
/// # Errors
/// `InvalidArgument` if there is no edge, or one is NaN or not above the one before; `OutOfMemory`.
pub fn histogram(
    triangulation: &Triangulation,
    measure: Measure,
    at_hull: bool,
    edges: &[f64],
) -> Result<Histogram> {
    check(edges)?;
    let mut counter = Counter::new(edges)?;
    if is_consistent(triangulation) {
        in_dimension!(
            triangulation.dim,
            D => count_in::<D>(View { mesh: triangulation }, measure, at_hull, &mut counter)?,
            _ => {}
        );
    }
    Ok(counter.histogram)
}

fn check(edges: &[f64]) -> Result<()> {
    let refuse = |message| Err(Error::invalid(message));
    if edges.is_empty() {
        return refuse(message!("edges is empty; it must hold at least one"));
    }
    for (i, edge) in edges.iter().enumerate() {
        if edge.is_nan() {
            return refuse(message!("edges[{i}] is NaN; edges must be numbers"));
        }
        if i > 0 && edge <= &edges[i - 1] {
            let before = edges[i - 1];
            return refuse(message!(
                "edges[{i}] is {edge}; it must be above the edge before, {before}"
            ));
        }
    }
    Ok(())
}

fn count_in<const D: usize>(
    view: View<'_, D>,
    measure: Measure,
    at_hull: bool,
    counter: &mut Counter<'_>,
) -> AllocResult<()> {
    let on_hull = view.hull_vertices()?;
    if measure == Measure::Aspect {
        return count_aspects(view, &on_hull, counter);
    }
    for simplex in 0..view.simplex_count() {
        let vertices = view.simplex(simplex);
        if at_hull || !vertices.iter().any(|&v| on_hull[v as usize]) {
            let points = view.points_of(vertices);
            count_simplex(&points[..View::<D>::VERTICES], measure, counter)?;
        }
    }
    Ok(())
}

fn count_simplex<const D: usize>(
    points: &[&[f64; D]],
    measure: Measure,
    counter: &mut Counter<'_>,
) -> AllocResult<()> {
    let degrees = |tangent| angle(tangent).to_degrees();
    match measure {
        Measure::DihedralAngle => {
            for_each_squared_tangent(points, |tangent| counter.add(degrees(tangent)))?;
        }
        Measure::SmallestAngle => counter.add(degrees(smallest_squared_tangent(points)?)),
        Measure::RadiusEdge | Measure::Aspect => {
            let corner = Corner::new(points)?;
            let ratio = |corner: Corner<D>| corner.radius.ratio(corner.shortest_edge);
            counter.add(corner.map_or(f64::INFINITY, ratio));
        }
    }
    Ok(())
}

fn count_aspects<const D: usize>(
    view: View<'_, D>,
    on_hull: &[bool],
    counter: &mut Counter<'_>,
) -> AllocResult<()> {
    let mesh = view.mesh;
    let tree = DomainTree::new(&mesh.domains)?;
    let cells = Cells::of(view, tree.as_ref())?;
    let cages = mesh.domains.iter().enumerate().skip(1).filter(|&(i, _)| cells.has_cage(i));
    for (i, domain) in cages {
        counter.add(cells.cage_aspect_anywhere(i, domain.radius));
    }
    let is_measured = |&v: &usize| !on_hull[v] && mesh.cage_of[v] == NONE && cells.has_cell(v);
    for v in (0..on_hull.len()).filter(is_measured) {
        counter.add(cells.aspect_anywhere(v));
    }
    Ok(())
}

/// A histogram in the making.
struct Counter<'a> {
    edges: &'a [f64],
    histogram: Histogram,
}

impl<'a> Counter<'a> {
    fn new(edges: &'a [f64]) -> AllocResult<Self> {
        let counts = filled(edges.len() + 1, 0)?;
        let histogram = Histogram { counts, least: f64::INFINITY, largest: f64::NEG_INFINITY };
        Ok(Self { edges, histogram })
    }

    fn add(&mut self, value: f64) {
        let last = self.edges.len() - 1;
        let not_above = self.edges.partition_point(|&edge| edge <= value);
        // The last bin, if there is one, is closed.
        let closes_last = last > 0 && value == self.edges[last];
        self.histogram.counts[if closes_last { last } else { not_above }] += 1;
        self.histogram.least = self.histogram.least.min(value);
        self.histogram.largest = self.histogram.largest.max(value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counted(edges: &[f64], values: &[f64]) -> Vec<u64> {
        let mut counter = Counter::new(edges).unwrap();
        values.iter().for_each(|&value| counter.add(value));
        counter.histogram.counts
    }

    #[test]
    fn bins_hold_their_lower_edge_and_the_last_one_both() {
        let values = [-1.0, 0.0, 0.5, 1.0, 1.5, 2.0, 2.5, f64::INFINITY];
        assert_eq!(counted(&[0.0, 1.0, 2.0], &values), [1, 2, 3, 2]);
        assert_eq!(counted(&[1.0, f64::INFINITY], &values), [3, 5, 0]);
        assert_eq!(counted(&[0.0], &values), [1, 7]);
    }

    #[test]
    fn edges_ascend() {
        let message = |edges: &[f64]| check(edges).unwrap_err().message().to_owned();
        assert_eq!(message(&[]), "edges is empty; it must hold at least one");
        assert_eq!(message(&[1.0, f64::NAN]), "edges[1] is NaN; edges must be numbers");
        let equal = message(&[0.0, 2.0, 2.0]);
        assert_eq!(equal, "edges[2] is 2; it must be above the edge before, 2");
        assert!(check(&[f64::NEG_INFINITY, 0.0, f64::INFINITY]).is_ok());
    }

    #[test]
    fn extremes_are_kept() {
        let mut counter = Counter::new(&[0.0]).unwrap();
        assert!(counter.histogram.least > counter.histogram.largest);
        [3.0, 1.0, 2.0].into_iter().for_each(|value| counter.add(value));
        assert_eq!((counter.histogram.least, counter.histogram.largest), (1.0, 3.0));
    }
}
