//! A simplex as it is measured: the lengths of its edges, its corner and its normals.
//!
//! Triangles and tetrahedra whose edges are neither very long, very short nor nearly dependent are
//! solved by Cramer's rule in doubles, all others as [`corner`](super::corner) does.

use super::angles::{Screen, smallest_squared_tangent_of};
use super::corner::{self, Corner};
use super::length::{Length, Offset};
use crate::memory::AllocResult;
use crate::mesh::MAX_DIM;
use std::ops::RangeInclusive;

/// Squared lengths of edges for which no product below over- or underflows.
const PLAIN: RangeInclusive<f64> = 1e-90..=1e90;

/// Squared lengths of edges for which not even products of four normals over- or underflow.
const MODERATE: RangeInclusive<f64> = 1e-35..=1e35;

/// A determinant of edges over the product of their lengths from which on Cramer's rule is good to
/// 1e-10: the roundings of numerators and of the determinant are some 10 EPSILON of that product.
const INDEPENDENT: f64 = 1e-4;

/// The normals of the facets of a simplex, the i-th opposite vertex i; what follows is zero.
pub(crate) type Normals<const D: usize> = [[f64; D]; MAX_DIM + 1];

/// A simplex of `D + 1` points.
pub(crate) struct Simplex<'a, const D: usize> {
    points: &'a [&'a [f64; D]],
    /// The first vertex of the shortest edge, from which the edges are best conditioned.
    base: usize,
    shortest: Length,
    /// Vertex -> distance to the nearest other one; what follows is zero.
    nearest: [Length; MAX_DIM + 1],
    /// True if all edges are [`MODERATE`].
    is_moderate: bool,
    solution: Option<Solution<D>>,
}

/// The equations of a simplex, solved by Cramer's rule.
struct Solution<const D: usize> {
    /// The circumcentre, relative to the base.
    center: [f64; D],
    /// Inward normals of the facets opposite to the vertices other than the base, in their order.
    normals: [[f64; D]; D],
}

impl<const D: usize> Solution<D> {
    /// Returns the inward normal of the facet opposite to the base.
    #[inline]
    fn opposite_base(&self) -> [f64; D] {
        let mut normal = [0.0; D];
        for other in &self.normals {
            for axis in 0..D {
                normal[axis] -= other[axis];
            }
        }
        normal
    }

    /// Returns the inward normals of all facets of a simplex with this `base`.
    fn all_normals(&self, base: usize) -> Normals<D> {
        let mut normals = [[0.0; D]; MAX_DIM + 1];
        for (k, normal) in self.normals.iter().enumerate() {
            normals[k + usize::from(k >= base)] = *normal;
        }
        normals[base] = self.opposite_base();
        normals
    }
}

impl<'a, const D: usize> Simplex<'a, D> {
    #[inline]
    pub fn new(points: &'a [&'a [f64; D]]) -> Self {
        let points = &points[..D + 1];
        let mut nearest = [f64::INFINITY; MAX_DIM + 1];
        let (mut base, mut shortest, mut longest) = (0, f64::INFINITY, 0.0);
        for i in 0..D + 1 {
            for j in i + 1..D + 1 {
                let squared = squared_distance(points[i], points[j]);
                nearest[i] = lesser(squared, nearest[i]);
                nearest[j] = lesser(squared, nearest[j]);
                longest = if squared > longest { squared } else { longest };
                base = if squared < shortest { i } else { base };
                shortest = lesser(squared, shortest);
            }
        }
        if !(*PLAIN.start() <= shortest && longest <= *PLAIN.end()) {
            return Self::of_any_scale(points);
        }
        let mut lengths = [Length::ZERO; MAX_DIM + 1];
        for vertex in 0..D + 1 {
            lengths[vertex] = Length::new(nearest[vertex].sqrt());
        }
        let is_moderate = *MODERATE.start() <= shortest && longest <= *MODERATE.end();
        let solution = solve(points, base);
        let shortest = Length::new(shortest.sqrt());
        Self { points, base, shortest, nearest: lengths, is_moderate, solution }
    }

    /// Makes a simplex with edges too long or too short for their squares, or close to it.
    #[cold]
    fn of_any_scale(points: &'a [&'a [f64; D]]) -> Self {
        let mut nearest = [Length::ZERO; MAX_DIM + 1];
        nearest[..=D].fill(Length::INFINITE);
        let (mut base, mut shortest) = (0, Length::INFINITE);
        for i in 0..=D {
            for j in i + 1..=D {
                let length = Length::between(points[i], points[j]);
                nearest[i] = nearest[i].min(length);
                nearest[j] = nearest[j].min(length);
                if length < shortest {
                    (base, shortest) = (i, length);
                }
            }
        }
        Self { points, base, shortest, nearest, is_moderate: false, solution: None }
    }

    /// Returns for each vertex the distance to the nearest other one.
    pub fn nearest(&self) -> &[Length] {
        &self.nearest[..=D]
    }

    /// Returns the corner; `None` if the simplex is flat.
    #[inline]
    pub fn corner(&self) -> AllocResult<Option<Corner<D>>> {
        let (base, shortest_edge) = (self.base, self.shortest);
        if let Some(Solution { center: vector, .. }) = self.solution {
            let center = Offset { vector, exponent: 0 };
            let radius = Length::new(center.squared_mantissa().sqrt());
            return Ok(Some(Corner { base, center, radius, shortest_edge }));
        }
        let center = corner::circumcenter(self.points, base)?;
        Ok(center.map(|center| Corner { base, center, radius: center.length(), shortest_edge }))
    }

    /// Returns the inward normals of the facets; `None` if the simplex is flat.
    #[inline]
    pub fn normals(&self) -> AllocResult<Option<Normals<D>>> {
        match &self.solution {
            Some(solution) => Ok(Some(solution.all_normals(self.base))),
            None => corner::normals(self.points, self.base),
        }
    }

    /// Returns false if a `screen` holds the simplex back: its angles are surely larger.
    #[inline]
    pub(super) fn may_pass(&self, screen: Screen) -> bool {
        match &self.solution {
            _ if screen.is_closed() => false,
            Some(solution) if self.is_moderate => {
                screen.passes(&solution.normals, &solution.opposite_base())
            }
            _ => true,
        }
    }

    /// Returns the squared tangent of half the smallest dihedral angle, 0 for a flat simplex.
    pub fn smallest_squared_tangent(&self) -> AllocResult<f64> {
        Ok(smallest_squared_tangent_of(self.normals()?))
    }
}

/// Returns the lesser of two numbers, in one instruction: there is no NaN.
#[inline]
fn lesser(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

#[inline]
fn squared_distance<const D: usize>(p: &[f64; D], q: &[f64; D]) -> f64 {
    let mut sum = 0.0;
    for axis in 0..D {
        let difference = p[axis] - q[axis];
        sum += difference * difference;
    }
    sum
}

/// Solves the equations of a triangle or tetrahedron from the vertex `base` on; `None` in other
/// dimensions, and if the edges are nearly dependent. All squared lengths must be [`PLAIN`].
#[inline]
fn solve<const D: usize>(points: &[&[f64; D]], base: usize) -> Option<Solution<D>> {
    if D > 3 {
        return None;
    }
    let mut edges = [[0.0; D]; D];
    let mut squares = [0.0; D];
    for k in 0..D {
        let end = points[k + usize::from(k >= base)];
        for axis in 0..D {
            edges[k][axis] = end[axis] - points[base][axis];
            squares[k] += edges[k][axis] * edges[k][axis];
        }
    }
    let cofactors = cofactors(&edges);
    let determinant: f64 = edges[0].iter().zip(&cofactors[0]).map(|(x, y)| x * y).sum();
    let product: f64 = squares.iter().product();
    let is_independent = determinant * determinant > INDEPENDENT * INDEPENDENT * product;
    if !is_independent {
        return None;
    }
    let (factor, sign) = (0.5 / determinant, determinant.signum());
    let mut center = [0.0; D];
    let mut normals = cofactors;
    for k in 0..D {
        for axis in 0..D {
            center[axis] += squares[k] * cofactors[k][axis];
            normals[k][axis] = cofactors[k][axis] * sign;
        }
    }
    (0..D).for_each(|axis| center[axis] *= factor);
    Some(Solution { center, normals })
}

/// Returns the cofactors of the rows of a matrix: the gradients of the coordinates along the edges,
/// times the determinant.
#[inline]
fn cofactors<const D: usize>(edges: &[[f64; D]; D]) -> [[f64; D]; D] {
    let mut cofactors = [[0.0; D]; D];
    if D == 2 {
        let [a, b] = [&edges[0], &edges[1]];
        cofactors[0][0] = b[1];
        cofactors[0][1] = -b[0];
        cofactors[1][0] = -a[1];
        cofactors[1][1] = a[0];
    } else {
        for (k, row) in cofactors.iter_mut().enumerate() {
            let (a, b) = (&edges[(k + 1) % 3], &edges[(k + 2) % 3]);
            for (axis, cofactor) in row.iter_mut().enumerate() {
                let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
                *cofactor = a[next] * b[last] - a[last] * b[next];
            }
        }
    }
    cofactors
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quality::rational;

    /// Holds that Cramer's rule is within 1e-9 of integers where it answers, which it does for most
    /// simplices, and not for those that are nearly flat.
    fn cramers_rule_is_right<const D: usize>() {
        let mut random = crate::numerics::SplitMix(D as u64);
        let mut answered = 0;
        for trial in 0..400 {
            // Ever flatter simplices.
            let height = 0.5f64.powi(trial / 16);
            let points: Vec<[f64; D]> = (0..=D)
                .map(|_| {
                    let mut point: [f64; D] = std::array::from_fn(|_| random.unit());
                    point[D - 1] *= height;
                    point
                })
                .collect();
            let points: Vec<&[f64; D]> = points.iter().collect();
            let simplex = Simplex::new(&points);
            let Some(solution) = &simplex.solution else {
                continue;
            };
            answered += 1;
            let exact = rational::circumcenter(&points, simplex.base).unwrap().unwrap();
            let miss = exact.plus(&Offset::normalized(solution.center.map(|x| -x), 0));
            assert!(miss.length().ratio(exact.length()) < 1e-9, "{points:?}");
            let gradients = rational::gradients(&points, simplex.base).unwrap().unwrap();
            for (k, gradient) in gradients.iter().enumerate().take(D) {
                let normal = solution.normals[k];
                let along = normal.iter().zip(&gradient.vector).map(|(a, b)| a * b);
                let norms = [normal, gradient.vector].map(|v| v.map(|x| x * x).iter().sum());
                let cosine = along.sum::<f64>() / norms.iter().product::<f64>().sqrt();
                assert!((cosine - 1.0).abs() < 1e-9, "{points:?}: {cosine}");
            }
        }
        assert!((150..350).contains(&answered), "{answered}");
    }

    #[test]
    fn cramers_rule_is_right_where_it_answers() {
        cramers_rule_is_right::<2>();
        cramers_rule_is_right::<3>();
    }

    #[test]
    fn each_vertex_knows_its_nearest_at_any_scale() {
        for scale in [1e-300, 1.0, 1e300] {
            let points = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0]].map(|p| p.map(|x| x * scale));
            let points: Vec<&[f64; 2]> = points.iter().collect();
            let simplex = Simplex::new(&points);
            let nearest = simplex.nearest().iter().map(|length| length.to_f64() / scale);
            assert!(nearest.zip([3.0, 1.0, 1.0]).all(|(a, b): (f64, f64)| (a - b).abs() < 1e-15));
            assert_eq!(simplex.solution.is_some(), scale == 1.0);
            let corner = simplex.corner().unwrap().unwrap();
            let ratio = corner.radius.ratio(corner.shortest_edge);
            assert!((ratio - 2.5f64.sqrt()).abs() < 1e-14, "{ratio}");
        }
    }

    /// Holds that a screen lets every simplex pass whose smallest angle is below its limit, and
    /// holds back all whose angles are larger by more than a little.
    fn screens_hold_back_larger_angles<const D: usize>() {
        let mut random = crate::numerics::SplitMix(D as u64 + 9);
        let [mut passed, mut held_back] = [0; 2];
        for trial in 0..20_000 {
            let height = 0.5f64.powi(trial % 16);
            let points: [[f64; D]; MAX_DIM + 1] = std::array::from_fn(|_| {
                let mut point: [f64; D] = std::array::from_fn(|_| random.unit());
                point[D - 1] *= height;
                point
            });
            let points: Vec<&[f64; D]> = points[..D + 1].iter().collect();
            let simplex = Simplex::new(&points);
            let tangent = simplex.smallest_squared_tangent().unwrap();
            for factor in [0.01, 0.999, 1.0 - 1e-12, 1.0, 1.0 + 1e-15, 1.001, 100.0] {
                let passes = simplex.may_pass(Screen::of(tangent * factor));
                assert!(passes || tangent * factor <= tangent, "{points:?} at {factor}");
                passed += u32::from(passes);
                // Where angles are large enough for their cosines to tell.
                if factor < 0.9995 && tangent > 1e-4 && simplex.solution.is_some() {
                    assert!(!passes || tangent * factor >= 1.0, "{points:?} at {factor}");
                    held_back += 1;
                }
            }
            assert!(simplex.may_pass(Screen::OPEN) && !simplex.may_pass(Screen::CLOSED));
            assert!(simplex.may_pass(Screen::CLOSED.wider(Screen::OPEN)));
        }
        assert!(passed > 50_000 && held_back > 10_000, "{passed} {held_back}");
    }

    #[test]
    fn screens_hold_back_larger_angles_and_none_that_are_smaller() {
        screens_hold_back_larger_angles::<2>();
        screens_hold_back_larger_angles::<3>();
    }

    #[test]
    fn simplices_whose_normals_may_overflow_pass_every_screen_but_the_closed_one() {
        for scale in [1e-44, 1e44] {
            let points = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
            let points = points.map(|point| point.map(|x| x * scale));
            let points: Vec<&[f64; 3]> = points.iter().collect();
            let simplex = Simplex::new(&points);
            assert!(simplex.solution.is_some());
            assert!(simplex.may_pass(Screen::of(1e-8)) && !simplex.may_pass(Screen::CLOSED));
        }
    }
}
