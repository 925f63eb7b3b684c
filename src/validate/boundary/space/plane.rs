//! Level 2: the planes of facets. Vertices on a facet are as near to its plane as doubles let them
//! be.
//!
//! The normal of a facet is the sum of the cross products along its rim, exact and then rounded to
//! doubles. By their heights along it, which are exact, the inputs of a facet lie between two
//! parallel planes: what is between them is the thickness that the caller gave the facet, or that
//! merging of triangles gave it. Any other vertex on the facet is between these planes or beyond
//! them by at most one unit in the last place of the facet's largest coordinate on each axis; half
//! a unit is from rounding it, and the other half from how the builder comes to its place. Inputs
//! that are near the facet without being among its own may be as far as those near a segment, and
//! so may vertices of a chain, which may bend through such an input: [`super::ways`] holds them to
//! the line between the inputs next to them, so that only those of a chain that bends are farther
//! than one unit. If crossings are split a facet goes through vertices at these, which are off it
//! by roundings, and all vertices on it may be as far. So may those of a facet that is bent by more
//! than that itself, or goes through an input that is farther beside it than one unit: they are on
//! its triangles, which go through that input.

use super::super::chains::BENT;
use super::super::exact::unit_in_last_place;
use super::super::sum::Sum;
use super::given::{Facet, is_longer};
use super::tiling::name_of;
use super::ways::Ways;
use crate::error::message;
use crate::quality::length::{Length, exponent_of, scale};
use crate::validate::report::{Findings, Violation, ViolationKind};
use std::cmp::Ordering;

/// Largest distance on each axis of a vertex from what the inputs of its facet span, in units in
/// the last place of the facet's largest coordinate on the axis.
const ROUNDED: f64 = 1.0;

/// Exact sum of the cross products of edges: twice the area of what they enclose, as a vector.
pub(super) struct AreaVector {
    sums: [Sum; 3],
}

impl AreaVector {
    pub fn zero() -> Self {
        Self { sums: std::array::from_fn(|_| Sum::zero()) }
    }

    pub fn of_triangle(corners: [&[f64; 3]; 3]) -> Self {
        let mut area = Self::zero();
        area.add_triangle(corners);
        area
    }

    /// Adds the edge from `a` to `b`.
    pub fn add_edge(&mut self, a: &[f64; 3], b: &[f64; 3]) {
        for (axis, sum) in self.sums.iter_mut().enumerate() {
            let [i, j] = [(axis + 1) % 3, (axis + 2) % 3];
            sum.add_product(&[a[i], b[j]]);
            sum.add_product(&[-a[j], b[i]]);
        }
    }

    /// Adds the edges of a triangle.
    pub fn add_triangle(&mut self, [a, b, c]: [&[f64; 3]; 3]) {
        [[a, b], [b, c], [c, a]].into_iter().for_each(|[from, to]| self.add_edge(from, to));
    }

    /// Returns the exact sign of the component along an axis.
    pub fn sign(&self, axis: usize) -> Ordering {
        self.sums[axis].sign()
    }

    /// Returns the vector as `vector * 2^exponent` with its largest component in [1, 2), rounded to
    /// doubles; `None` if it is zero.
    pub fn rounded(&self) -> Option<([f64; 3], i32)> {
        let parts = [0, 1, 2].map(|axis| self.sums[axis].rounded());
        let magnitude = |&(mantissa, own): &(f64, i32)| exponent_of(mantissa).map(|e| e + own);
        let largest = parts.iter().filter_map(magnitude).max()?;
        Some((parts.map(|(mantissa, own)| scale(mantissa, own - largest)), largest))
    }
}

/// Returns the axis of the component with the largest magnitude.
pub(super) fn largest_axis(vector: &[f64; 3]) -> usize {
    (0..3).rev().max_by(|&i, &j| vector[i].abs().total_cmp(&vector[j].abs())).unwrap_or(0)
}

/// Adds the height of a point along a normal, times a factor that is 1 or -1.
fn add_height(sum: &mut Sum, normal: &[f64; 3], point: &[f64; 3], factor: f64) {
    for (component, x) in normal.iter().zip(point) {
        sum.add_product(&[factor * component, *x]);
    }
}

/// The planes between which vertices of a facet are: the height of either, and what rounding adds.
pub(super) struct Slab {
    low: Sum,
    high: Sum,
}

impl Slab {
    /// Returns the planes between which all vertices of a facet are.
    pub fn wide(facet: &Facet, ways: &Ways<'_>) -> Self {
        let points = facet.corners.iter().map(|&corner| ways.input(corner));
        let units = ways.roundings(ways.splits(facet.parent)).units_of(points.clone());
        let mut slab = Self::of(&facet.normal, points);
        slab.widen(&facet.normal, &units.map(|unit| BENT * unit));
        slab
    }

    fn of<'a>(normal: &[f64; 3], points: impl Iterator<Item = &'a [f64; 3]> + Clone) -> Self {
        let mut slab = None;
        for point in points {
            let mut height = Sum::zero();
            add_height(&mut height, normal, point, 1.0);
            let Self { low, high } =
                slab.get_or_insert_with(|| Self { low: height.clone(), high: height.clone() });
            if exceeds(low, normal, point) {
                *low = height.clone();
            }
            if falls_below(high, normal, point) {
                *high = height;
            }
        }
        slab.unwrap_or_else(|| Self { low: Sum::zero(), high: Sum::zero() })
    }

    /// Makes the slab thicker by some units on each axis, on both sides.
    fn widen(&mut self, normal: &[f64; 3], units: &[f64; 3]) {
        for (component, unit) in normal.iter().zip(units) {
            self.low.add_product(&[-component.abs(), *unit]);
            self.high.add_product(&[component.abs(), *unit]);
        }
    }

    pub fn holds(&self, normal: &[f64; 3], point: &[f64; 3]) -> bool {
        !exceeds(&self.low, normal, point) && !falls_below(&self.high, normal, point)
    }
}

/// Returns true if a point is no farther from the plane of a triangle than one through which a
/// facet may be bent, in some units.
pub(super) fn is_beside(corners: [&[f64; 3]; 3], units: &[f64; 3], x: &[f64; 3]) -> bool {
    let Some((normal, _)) = AreaVector::of_triangle(corners).rounded() else { return false };
    let mut slab = Slab::of(&normal, corners.into_iter());
    slab.widen(&normal, &units.map(|unit| BENT * unit));
    slab.holds(&normal, x)
}

/// Returns the normal of a side of a hull: the mean over its triangles, which is its area vector,
/// or where its corners are in no plane with that, that of a large triangle between them. A narrow
/// strip that roundings bend turns the mean by more than they are of the side's extent.
pub(super) fn side_normal<'a>(
    area: &AreaVector,
    corners: impl Iterator<Item = &'a [f64; 3]> + Clone,
) -> Option<[f64; 3]> {
    let (mean, _) = area.rounded()?;
    if are_in_plane(&mean, corners.clone()) {
        return Some(mean);
    }
    let farthest = |from: &[f64; 3]| corners.clone().max_by_key(|x| Length::between(from, x));
    let Some(a) = corners.clone().next().and_then(farthest) else { return Some(mean) };
    let Some(b) = farthest(a) else { return Some(mean) };
    let triangles = corners.filter_map(|c| AreaVector::of_triangle([a, b, c]).rounded());
    let largest = triangles.reduce(|best, own| if is_longer(&own, &best) { own } else { best });
    let Some((normal, _)) = largest else { return Some(mean) };
    let is_along = (0..3).map(|k| normal[k] * mean[k]).sum::<f64>() > 0.0;
    Some(if is_along { normal } else { normal.map(|x| -x) })
}

/// Returns a number that is not less than the difference of the largest and the least height of
/// points along a normal.
pub(super) fn thickness<'a>(
    normal: &[f64; 3],
    points: impl Iterator<Item = &'a [f64; 3]> + Clone,
) -> f64 {
    let Slab { low, mut high } = Slab::of(normal, points);
    high.add(&low, true);
    let (mantissa, exponent) = high.rounded();
    scale(mantissa, exponent).next_up().min(f64::MAX)
}

/// Checks that the inputs of a side of a hull are in a plane: up to rounding, and up to the bends
/// between triangles that count as none.
pub(super) fn check_side(facet: &Facet, ways: &Ways<'_>, findings: &mut Findings) {
    let points = facet.corners.iter().map(|&corner| ways.input(corner));
    findings.check(are_in_plane(&facet.normal, points), || {
        let corner = facet.corners.first().copied().unwrap_or(0);
        let message = message!(
            "a part of the hull between subsegments, at vertex {corner}, is not in one plane"
        );
        Violation::new(ViolationKind::FacetPlane, message).vertex(corner as usize)
    });
}

/// Returns true if points are in a plane with this normal, up to what counts as none for a side.
fn are_in_plane<'a>(normal: &[f64; 3], points: impl Iterator<Item = &'a [f64; 3]> + Clone) -> bool {
    const BENDS: f64 = 1e-9;
    let Slab { low, high } = Slab::of(normal, points.clone());
    let mut excess = high;
    excess.add(&low, true);
    let ranges = [0, 1, 2].map(|axis| {
        let over =
            |of: fn(f64, f64) -> f64, first: f64| points.clone().map(|x| x[axis]).fold(first, of);
        [over(f64::min, f64::INFINITY), over(f64::max, f64::NEG_INFINITY)]
    });
    // Bends are angles: a side that is long on one axis is bent by more on the others.
    let half = |[least, most]: &[f64; 2]| 0.5 * most - 0.5 * least;
    let longest = ranges.iter().max_by(|a, b| half(a).total_cmp(&half(b)));
    let [first, last] = longest.copied().unwrap_or_default();
    for (component, [least, most]) in normal.iter().zip(ranges) {
        let unit = unit_in_last_place(least.abs().max(most.abs()));
        excess.add_product(&[-component.abs(), 4.0 * BENT, unit]);
        excess.add_product(&[-component.abs(), BENDS, last]);
        excess.add_product(&[component.abs(), BENDS, first]);
    }
    excess.sign() != Ordering::Greater
}

/// Returns true if a height is larger than that of a point.
fn exceeds(height: &Sum, normal: &[f64; 3], point: &[f64; 3]) -> bool {
    let mut difference = height.clone();
    add_height(&mut difference, normal, point, -1.0);
    difference.sign() == Ordering::Greater
}

/// Returns true if a height is less than that of a point.
fn falls_below(height: &Sum, normal: &[f64; 3], point: &[f64; 3]) -> bool {
    let mut difference = height.clone();
    add_height(&mut difference, normal, point, -1.0);
    difference.sign() == Ordering::Less
}

/// Returns true if the inputs of a facet are farther from one plane than those beside it may be.
fn is_bent(facet: &Facet, units: &[f64; 3], ways: &Ways<'_>) -> bool {
    let mut points = facet.corners.iter().map(|&corner| ways.input(corner));
    let mut slab = Slab::of(&facet.normal, points.clone().take(1));
    slab.widen(&facet.normal, &units.map(|unit| BENT * unit));
    points.any(|point| !slab.holds(&facet.normal, point))
}

/// Checks the distance of the vertices of a facet from its plane.
pub(super) fn check(facet: &Facet, vertices: &[u32], ways: &Ways<'_>, findings: &mut Findings) {
    let points = facet.corners.iter().map(|&corner| ways.input(corner));
    let units = ways.roundings(ways.splits(facet.parent)).units_of(points.clone());
    let normal = &facet.normal;
    let mut slab = Slab::of(normal, points);
    slab.widen(normal, &units.map(|unit| ROUNDED * unit));
    let mut wide = Slab { low: slab.low.clone(), high: slab.high.clone() };
    wide.widen(normal, &units.map(|unit| (BENT - ROUNDED) * unit));
    let is_beside = |at: u32| ways.is_input(at) && !slab.holds(normal, ways.view.point(at));
    let goes_beside = ways.splits(facet.parent)
        || is_bent(facet, &units, ways)
        || vertices.iter().any(|&at| is_beside(at));
    for &vertex in vertices {
        let is_bent = goes_beside || ways.is_input(vertex) || ways.is_on_chain(vertex);
        let limit = if is_bent { &wide } else { &slab };
        findings.check(limit.holds(normal, ways.view.point(vertex)), || {
            let message = message!(
                "vertex {vertex} on {} is farther from its plane than rounding makes it",
                name_of(facet.parent)
            );
            Violation::new(ViolationKind::FacetPlane, message).vertex(vertex as usize)
        });
    }
}
