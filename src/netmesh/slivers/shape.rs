//! Measures of how bad the shape of a tetrahedron is, by its dihedral angles and its radius-edge
//! ratio.

use crate::complex::VertexId;
use crate::delaunay::Delaunay;
use crate::numerics::{F64x2, Real};
use crate::options::Criterion;
use std::ops::RangeInclusive;

/// The vertices of a tetrahedron.
pub(super) type Tetrahedron = [[f64; 3]; 4];

/// Penalty of a tetrahedron beyond the bound of the criterion. No change that makes one is worth
/// it.
const VIOLATION: f64 = 1000.0;

/// The angle that is aimed at is so many radians larger than that asked for, about 1e-6 degrees:
/// whoever measures with other roundings finds no smaller one.
const MARGIN: f64 = 2e-8;

/// The bound that is aimed at is smaller by this fraction, for the same reason.
const MARGIN_OF_BOUND: f64 = 1e-9;

/// Magnitudes of edges whose eighth powers neither over- nor underflow.
const SAFE: RangeInclusive<f64> = 1e-30..=1e30;

/// A face is small beside another if its squared area is so many times smaller.
const LOPSIDED: f64 = 1e-8;

/// Angle and bound that tetrahedra are measured against.
#[derive(Clone, Copy)]
pub(in crate::netmesh) struct Measure {
    /// The least dihedral angle, in radians, and the square of its cosine.
    angle: f64,
    square_cosine: f64,
    /// The square of twice the largest radius-edge ratio.
    square_bound: f64,
    /// Half the largest Voronoi aspect, if that is bounded.
    pub half_aspect: Option<f64>,
}

impl Measure {
    /// Returns the measure of dihedral angles of at least `degrees`, and of the criterion of at
    /// most `bound`.
    pub fn new(degrees: f64, criterion: Criterion, bound: f64) -> Self {
        let angle = degrees.to_radians() + MARGIN;
        let bound = bound * (1.0 - MARGIN_OF_BOUND);
        let (square_bound, half_aspect) = match criterion {
            Criterion::RadiusEdge => (4.0 * bound * bound, None),
            Criterion::VoronoiAspect => (f64::INFINITY, Some(0.5 * bound)),
        };
        Self { angle, square_cosine: angle.cos().powi(2), square_bound, half_aspect }
    }

    /// Returns a measure of angles alone, without a bound.
    pub fn of_angles(degrees: f64) -> Self {
        Self::new(degrees, Criterion::RadiusEdge, f64::INFINITY)
    }

    /// Returns the penalty of a tetrahedron in the objective: 0 if its shape is good, 1 to 2 for a
    /// sliver, more beyond the bound.
    #[inline]
    pub fn penalty(&self, tetrahedron: &Tetrahedron) -> f64 {
        let signs = self.signs(*tetrahedron);
        if is_good(signs) { 0.0 } else { self.penalty_with_care(tetrahedron) }
    }

    /// Returns the penalties of two tetrahedra, in less than twice the time of one.
    #[inline]
    pub fn penalties(&self, [first, second]: [&Tetrahedron; 2]) -> [f64; 2] {
        let both = |i: usize, k: usize| F64x2::new(first[i][k], second[i][k]);
        let tetrahedron = std::array::from_fn(|i| std::array::from_fn(|k| both(i, k)));
        let signs = self.signs(tetrahedron).map(F64x2::get);
        let of = |lane: usize, tetrahedron| match is_good(signs.map(|sign| sign[lane])) {
            true => 0.0,
            false => self.penalty_with_care(tetrahedron),
        };
        [of(0, first), of(1, second)]
    }

    /// Returns the numbers that [`is_good`] tests: the largest difference of coordinates; the
    /// volume; a number that is positive where an angle is too small, one where the radius is
    /// beyond the bound, one where a face is too small beside others for these to tell; the least
    /// squared normal.
    #[inline(always)]
    fn signs<R: Real>(&self, [origin, a, b, c]: [[R; 3]; 4]) -> [R; 6] {
        let [a, b, c] = [a, b, c].map(|vertex| minus(vertex, origin));
        let magnitudes = [a, b, c].map(|[x, y, z]| x.abs().max(y.abs()).max(z.abs()));
        let largest = magnitudes[0].max(magnitudes[1]).max(magnitudes[2]);
        let (ab, bc, ca) = (cross(a, b), cross(b, c), cross(c, a));
        let volume = dot(a, bc);
        let (aa, bb, cc) = (square(a), square(b), square(c));
        let others = square(minus(b, a)).min(square(minus(c, b))).min(square(minus(c, a)));
        let shortest = aa.min(bb).min(cc).min(others);
        let center = std::array::from_fn(|k| aa * bc[k] + bb * ca[k] + cc * ab[k]);
        let bound = R::of(self.square_bound) * volume * volume * shortest;
        // The normal of the face that is not at the origin is the sum of the others.
        let (along_c, along_a, along_b) = (dot(bc, ca), dot(ca, ab), dot(ab, bc));
        let squares = [square(bc), square(ca), square(ab)];
        let far = [
            squares[0] + along_c + along_b,
            squares[1] + along_a + along_c,
            squares[2] + along_b + along_a,
        ];
        let square_far = far[0] + far[1] + far[2];
        // A dihedral angle is the supplement of that between two normals that point inwards.
        let zero = R::of(0.0);
        let smallness = |cosine: R, scale: R| {
            let cosine = cosine.max(zero);
            cosine * cosine - R::of(self.square_cosine) * scale
        };
        let near = smallness(zero - along_c, squares[0] * squares[1])
            .max(smallness(zero - along_a, squares[1] * squares[2]))
            .max(smallness(zero - along_b, squares[2] * squares[0]));
        let beside_far = smallness(far[0], square_far * squares[0])
            .max(smallness(far[1], square_far * squares[1]))
            .max(smallness(far[2], square_far * squares[2]));
        let most = squares[0].max(squares[1]).max(squares[2]);
        let lopsided = R::of(LOPSIDED) * most - square_far;
        let least = squares[0].min(squares[1]).min(squares[2]).min(square_far);
        [largest, volume, near.max(beside_far), square(center) - bound, lopsided, least]
    }

    /// Returns the penalty of a tetrahedron that the fast test does not know to be good.
    #[cold]
    #[inline(never)]
    fn penalty_with_care(&self, tetrahedron: &Tetrahedron) -> f64 {
        let origin = tetrahedron[0];
        let edges: [[f64; 3]; 3] = std::array::from_fn(|i| minus(tetrahedron[i + 1], origin));
        let magnitudes = edges.as_flattened().iter().map(|x| x.abs());
        let largest = magnitudes.fold(0.0, |largest, x| if x > largest { x } else { largest });
        match SAFE.contains(&largest) {
            true => self.of_edges(edges),
            false => {
                let unit = power_below(largest);
                self.of_edges(edges.map(|edge| edge.map(|x| x / unit)))
            }
        }
    }

    #[inline(always)]
    fn of_edges(&self, [a, b, c]: [[f64; 3]; 3]) -> f64 {
        let (ab, bc, ca) = (cross(a, b), cross(b, c), cross(c, a));
        let (from_a_to_b, from_b_to_c) = (minus(b, a), minus(c, b));
        let abc = cross(from_a_to_b, from_b_to_c);
        let volume = dot(a, bc);
        let (aa, bb, cc) = (square(a), square(b), square(c));
        let others = square(from_a_to_b).min(square(from_b_to_c)).min(square(minus(c, a)));
        let shortest = aa.min(bb).min(cc).min(others);
        // The radius is the length of this over twice the volume, which is six times as large here.
        let center: [f64; 3] = std::array::from_fn(|k| aa * bc[k] + bb * ca[k] + cc * ab[k]);
        let is_beyond = square(center) > self.square_bound * volume * volume * shortest;
        let violation = if is_beyond { VIOLATION } else { 0.0 };
        // All but `abc` point inwards. A dihedral angle is the supplement of that between two such
        // normals, whose cosine is the first number over the root of the second.
        let squares = [square(bc), square(ca), square(ab), square(abc)];
        let cosines = [
            (-dot(bc, ca), squares[0] * squares[1]),
            (-dot(ca, ab), squares[1] * squares[2]),
            (-dot(ab, bc), squares[2] * squares[0]),
            (dot(abc, bc), squares[3] * squares[0]),
            (dot(abc, ca), squares[3] * squares[1]),
            (dot(abc, ab), squares[3] * squares[2]),
        ];
        // Without a branch, as `Array::push_if`.
        let is_small = cosines.iter().fold(false, |any, &(cosine, scale)| {
            any | ((cosine > 0.0) & (cosine * cosine > self.square_cosine * scale))
        });
        // Where edges differ by more than a hundred magnitudes the products are 0.
        let least_square = squares[0].min(squares[1]).min(squares[2].min(squares[3]));
        let is_told = least_square * least_square >= f64::MIN_POSITIVE;
        if volume > 0.0 && is_told && !is_small {
            return violation;
        }
        let angle = match is_told {
            true => least_angle(volume, &cosines),
            false => least_angle_at_any_scale([a, b, c]),
        };
        match is_told || angle < self.angle {
            true => violation + 2.0 - angle.min(self.angle) / self.angle,
            false => violation,
        }
    }
}

/// Returns true if a tetrahedron with these [`Measure::signs`] surely has no penalty; false where
/// one of them is NaN.
#[inline(always)]
fn is_good([largest, volume, small, beyond, lopsided, least_square]: [f64; 6]) -> bool {
    SAFE.contains(&largest)
        & (volume > 0.0)
        & (small <= 0.0)
        & (beyond <= 0.0)
        & (lopsided <= 0.0)
        & (least_square * least_square >= f64::MIN_POSITIVE)
}

/// Returns the largest power of two that is not above `x`, which is not negative; or the least
/// normal number.
fn power_below(x: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff << 52;
    f64::from_bits(x.to_bits() & EXPONENT).max(f64::MIN_POSITIVE)
}

#[cold]
#[inline(never)]
fn least_angle(volume: f64, cosines: &[(f64, f64); 6]) -> f64 {
    if volume.is_nan() || volume <= 0.0 {
        return 0.0;
    }
    let cosines = cosines.iter().map(|(cosine, scale)| cosine / scale.sqrt());
    cosines.fold(0.0, f64::max).min(1.0).acos()
}

/// Returns the least dihedral angle of a positively oriented tetrahedron, given its edges from one
/// vertex, by normals that are each of length 1. 0 where a face has none.
#[cold]
#[inline(never)]
fn least_angle_at_any_scale([a, b, c]: [[f64; 3]; 3]) -> f64 {
    let scaled = |x: [f64; 3]| {
        let unit = power_below(x.iter().fold(0.0, |largest, x| f64::max(largest, x.abs())));
        x.map(|x| x / unit)
    };
    let normal = |a, b| {
        let normal = scaled(cross(scaled(a), scaled(b)));
        let length = square(normal).sqrt();
        normal.map(|x| x / length)
    };
    let (ab, bc, ca) = (normal(a, b), normal(b, c), normal(c, a));
    let abc = normal(minus(b, a), minus(c, b));
    let cosines =
        [-dot(bc, ca), -dot(ca, ab), -dot(ab, bc), dot(abc, bc), dot(abc, ca), dot(abc, ab)];
    match cosines.iter().any(|cosine| cosine.is_nan()) {
        true => 0.0,
        false => cosines.into_iter().fold(-1.0, f64::max).clamp(-1.0, 1.0).acos(),
    }
}

/// Returns the points of `vertices`, which are in space.
#[inline(always)]
pub(super) fn tetrahedron(delaunay: &Delaunay<3>, vertices: &[VertexId]) -> Tetrahedron {
    std::array::from_fn(|index| in_space(delaunay.point(vertices[index])))
}

#[inline(always)]
pub(in crate::netmesh) fn in_space<const D: usize>(point: &[f64; D]) -> [f64; 3] {
    std::array::from_fn(|axis| point[axis])
}

#[inline(always)]
fn cross<R: Real>(a: [R; 3], b: [R; 3]) -> [R; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn dot<R: Real>(a: [R; 3], b: [R; 3]) -> R {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn square<R: Real>(a: [R; 3]) -> R {
    dot(a, a)
}

#[inline(always)]
fn minus<R: Real>(a: [R; 3], b: [R; 3]) -> [R; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::Random;

    /// Returns the least dihedral angle, in degrees, by the heights over an edge.
    fn least_dihedral(tetrahedron: &Tetrahedron) -> f64 {
        let mut least = f64::INFINITY;
        for i in 0..4 {
            for j in 0..i {
                let others: Vec<_> = (0..4).filter(|&k| k != i && k != j).collect();
                let edge = minus(tetrahedron[j], tetrahedron[i]);
                let height = |k: usize| {
                    let to = minus(tetrahedron[k], tetrahedron[i]);
                    let along = dot(to, edge) / square(edge);
                    std::array::from_fn(|axis| to[axis] - along * edge[axis])
                };
                let (a, b) = (height(others[0]), height(others[1]));
                least = least.min(square(cross(a, b)).sqrt().atan2(dot(a, b)));
            }
        }
        least.to_degrees()
    }

    fn radius_edge(tetrahedron: &Tetrahedron) -> f64 {
        let ball = crate::numerics::Circumball::new(&tetrahedron.each_ref());
        ball.radius() / crate::numerics::shortest_distance(&tetrahedron.each_ref()).2
    }

    fn scaled(tetrahedron: &Tetrahedron, scale: f64) -> Tetrahedron {
        tetrahedron.map(|vertex| vertex.map(|x| x * scale))
    }

    #[test]
    fn penalties_are_those_of_angles_and_radii_at_every_scale() {
        let mut random = Random(5);
        let measure = Measure::new(15.0, Criterion::RadiusEdge, 2.0);
        let (mut slivers, mut beyond) = (0, 0);
        for _ in 0..2000 {
            let flatness = random.unit();
            let mut tetrahedron: Tetrahedron = std::array::from_fn(|_| {
                let x = [random.unit(), random.unit(), flatness * random.unit()];
                x.map(|x| 2.0 + x)
            });
            if crate::numerics::orientation(&tetrahedron.each_ref()).is_negative() {
                tetrahedron.swap(0, 1);
            }
            let (angle, ratio) = (least_dihedral(&tetrahedron), radius_edge(&tetrahedron));
            let mut expected = if angle < 15.0 { 2.0 - angle / 15.0 } else { 0.0 };
            expected += if ratio > 2.0 { VIOLATION } else { 0.0 };
            slivers += u32::from(angle < 15.0);
            beyond += u32::from(ratio > 2.0);
            for scale in [1.0, 2f64.powi(-900), 2f64.powi(1000)] {
                let penalty = measure.penalty(&scaled(&tetrahedron, scale));
                assert!((penalty - expected).abs() < 1e-5, "{penalty} {expected} {tetrahedron:?}");
            }
            let turned = [tetrahedron[2], tetrahedron[3], tetrahedron[0], tetrahedron[1]];
            assert!((measure.penalty(&turned) - expected).abs() < 1e-5);
            let pair = measure.penalties([&tetrahedron, &turned]);
            assert_eq!(
                pair,
                [&tetrahedron, &turned].map(|tetrahedron| measure.penalty(tetrahedron))
            );
            tetrahedron.swap(1, 2);
            assert!(measure.penalty(&tetrahedron) >= 2.0, "it is turned inside out");
            assert_eq!(measure.penalties([&turned, &tetrahedron])[0], pair[1]);
        }
        assert!(slivers > 300 && beyond > 100, "{slivers} {beyond}");
        assert!(measure.penalty(&[[1.0; 3]; 4]) >= 2.0);
    }

    /// One that a fuzz target found, whose normals' lengths differ by 90 magnitudes, and one with
    /// right angles of such edges.
    #[test]
    fn penalties_are_right_where_edges_differ_by_many_magnitudes() {
        let measure = Measure::new(22.0, Criterion::RadiusEdge, f64::INFINITY);
        let found: Tetrahedron = [
            [-1.0, 4.916776677396771e-107, -5.446961927974371e-106],
            [-1.0, 3.0648550058978346e-106, -3.395344069343827e-105],
            [-1.0, -5.366831325673711e-106, 1.3934003177632725e-106],
            [-1.0000000000000002, 1.8093035546805378e-267, -1.0561379816539002e-266],
        ];
        let penalty = measure.penalty(&found);
        assert!((penalty - (2.0 - 8.258783835087407 / 22.0)).abs() < 1e-6, "{penalty}");
        let (long, short) = (1e-16, 1e-106);
        let needle: Tetrahedron =
            [[0.0; 3], [long, 0.0, 0.0], [0.0, short, 0.0], [0.0, 0.0, short]];
        assert_eq!(measure.penalty(&needle), 0.0);
    }
}
