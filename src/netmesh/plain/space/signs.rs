//! The sides of planes and spheres that points are on: a filter in doubles first, and exact signs
//! where it cannot tell.

use super::super::bits::{LARGE, SMALL, bits};
use super::super::ties::counts_as_inside;
use super::tetrahedra::FACES;
use crate::numerics::{F64x2, Real, Sign, in_ball_with_care, orientation_exact};

type Point = [f64; 3];

/// Signs of the points of a triangulation, and how many the filters did not tell.
pub(super) struct Signs<'a> {
    points: &'a [Point],
    /// True where doubles are exact: coordinates have so few bits, as those of voxels do.
    are_planes_exact: bool,
    are_spheres_exact: bool,
    pub fallbacks: u64,
}

impl<'a> Signs<'a> {
    pub fn new(points: &'a [Point]) -> Self {
        let bits = bits(points.as_flattened());
        Self {
            points,
            // Differences have one bit more, and sums of 6 and of 72 products three and seven.
            are_planes_exact: 3 * (bits + 1) + 3 <= f64::MANTISSA_DIGITS,
            are_spheres_exact: 5 * (bits + 1) + 7 <= f64::MANTISSA_DIGITS,
            fallbacks: 0,
        }
    }

    /// Returns signs of the same points, for another thread.
    pub fn again(&self) -> Self {
        Self { fallbacks: 0, ..*self }
    }

    #[inline]
    fn at(&self, vertex: u32) -> &'a Point {
        &self.points[vertex as usize]
    }

    /// Returns the orientation of three corners and a vertex: positive where the vertex sees the
    /// corners counterclockwise.
    #[inline]
    pub fn orientation(&mut self, face: [u32; 3], vertex: u32) -> Sign {
        let [a, b, c] = [self.at(face[0]), self.at(face[1]), self.at(face[2])];
        let q = self.at(vertex);
        let (determinant, bound) = orientation(a, b, c, q);
        match (determinant > bound, determinant < -bound) {
            (true, _) => Sign::Positive,
            (_, true) => Sign::Negative,
            _ if self.are_planes_exact => Sign::of(determinant),
            _ => self.orientation_with_care([a, b, c], q),
        }
    }

    #[cold]
    #[inline(never)]
    fn orientation_with_care(&mut self, [a, b, c]: [&Point; 3], q: &Point) -> Sign {
        self.fallbacks += 1;
        orientation_exact(&[a, b, c, q])
    }

    /// Returns true if a vertex, at `point`, is inside the sphere through the corners of a positive
    /// tetrahedron. On the sphere it counts as inside or not by [`counts_as_inside`].
    #[inline(always)]
    pub fn is_in_sphere(&mut self, corners: &[u32; 4], vertex: u32, point: &Point) -> bool {
        let [a, b] = [self.at(corners[0]), self.at(corners[1])];
        let [c, d] = [self.at(corners[2]), self.at(corners[3])];
        let sphere = Sphere::new(a, b, c, d, point);
        let (determinant, bound) = (sphere.determinant(), sphere.bound());
        match (determinant > bound, determinant < -bound) {
            (true, _) => true,
            (_, true) => false,
            _ => self.is_in_sphere_with_care(corners, vertex),
        }
    }

    /// Returns the result of [`Self::is_in_sphere`] for a vertex that is near the sphere.
    #[cold]
    #[inline(never)]
    pub fn is_in_sphere_with_care(&mut self, corners: &[u32; 4], vertex: u32) -> bool {
        let simplex = corners.map(|corner| self.at(corner));
        let [a, b, c, d] = simplex;
        let (determinant, bound) = in_sphere(a, b, c, d, self.at(vertex));
        if determinant.abs() > bound {
            return determinant > 0.0;
        }
        self.fallbacks += 1;
        let side = match self.are_spheres_exact {
            true => Sign::of(determinant),
            false => in_ball_with_care(&simplex, self.at(vertex)),
        };
        match side {
            Sign::Positive => true,
            Sign::Negative => false,
            Sign::Zero => counts_as_inside(corners, vertex, |place| {
                self.orientation(FACES[place].map(|at| corners[at]), vertex)
            }),
        }
    }
}

#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// Returns a bound in units of its product, or infinity if something may underflow or overflow.
#[inline(always)]
fn checked([x, y, z]: [f64; 3], bound: f64) -> f64 {
    let least = if x < y { x } else { y };
    let least = if least < z { least } else { z };
    let largest = larger(larger(x, y), z);
    if least > SMALL && largest < LARGE { bound } else { f64::INFINITY }
}

/// Returns the determinant of an orientation, and a bound of its error: the sum of six products, of
/// one difference along each axis, with at most eight roundings each.
#[inline(always)]
fn orientation(a: &Point, b: &Point, c: &Point, q: &Point) -> (f64, f64) {
    const BOUND: f64 = 6.0 * 4.5 * f64::EPSILON;
    let (ax, ay, az) = (a[0] - q[0], a[1] - q[1], a[2] - q[2]);
    let (bx, by, bz) = (b[0] - q[0], b[1] - q[1], b[2] - q[2]);
    let (cx, cy, cz) = (c[0] - q[0], c[1] - q[1], c[2] - q[2]);
    let x = larger(larger(ax.abs(), bx.abs()), cx.abs());
    let y = larger(larger(ay.abs(), by.abs()), cy.abs());
    let z = larger(larger(az.abs(), bz.abs()), cz.abs());
    let (ab, ac, bc) = (bx * ay - ax * by, cx * ay - ax * cy, cx * by - bx * cy);
    let determinant = az * bc - bz * ac + cz * ab;
    (determinant, checked([x, y, z], BOUND * (x * y * z)))
}

/// Returns the determinant whose sign is the side of a sphere, and a bound of its error: the sum of
/// 24 products of a difference along each axis and a squared length, with at most 17 roundings
/// each.
#[inline(never)]
fn in_sphere(a: &Point, b: &Point, c: &Point, d: &Point, q: &Point) -> (f64, f64) {
    const BOUND: f64 = 24.0 * 9.0 * f64::EPSILON;
    let sphere = Sphere::new(a, b, c, d, q);
    let widths = [0, 1, 2].map(|axis| {
        let [one, other] = sphere.first[axis].abs().max(sphere.second[axis].abs()).get();
        larger(one, other)
    });
    let [x, y, z] = widths;
    let bound = BOUND * (x * y * z) * (x * x + y * y + z * z);
    (sphere.determinant(), checked(widths, bound))
}

/// Differences of the corners of a tetrahedron from a point: two corners side by side, by axis.
struct Sphere {
    first: [F64x2; 3],
    second: [F64x2; 3],
    first_squares: F64x2,
    second_squares: F64x2,
}

impl Sphere {
    #[inline(always)]
    fn new(a: &Point, b: &Point, c: &Point, d: &Point, q: &Point) -> Self {
        let pair = |a: &Point, b: &Point, k: usize| F64x2::new(a[k], b[k]) - F64x2::of(q[k]);
        let square = |[x, y, z]: [F64x2; 3]| x * x + y * y + z * z;
        let first = [pair(a, b, 0), pair(a, b, 1), pair(a, b, 2)];
        let second = [pair(c, d, 0), pair(c, d, 1), pair(c, d, 2)];
        Self { first, second, first_squares: square(first), second_squares: square(second) }
    }

    /// Returns the determinant whose sign is the side of the sphere that the point is on.
    #[inline(always)]
    fn determinant(&self) -> f64 {
        let ([xab, yab, zab], [xcd, ycd, zcd]) = (self.first, self.second);
        // Minors of two rows, named by them.
        let ac_bd = xab * ycd - xcd * yab;
        let ad_bc = xab * ycd.swapped() - xcd.swapped() * yab;
        let ab_cd = xab.firsts(xcd) * yab.seconds(ycd) - xab.seconds(xcd) * yab.firsts(ycd);
        let (ab, cd) = (ab_cd.firsts(ab_cd), ab_cd.seconds(ab_cd));
        let ([za, zb], [zc, zd]) = (each(zab), each(zcd));
        let acd_bcd =
            zab * cd - zc * ad_bc.first_and_second(ac_bd) + zd * ac_bd.first_and_second(ad_bc);
        let abc_abd = za * ad_bc.seconds(ac_bd) - zb * ac_bd.firsts(ad_bc) + zcd * ab;
        let products =
            self.first_squares * acd_bcd.swapped() + self.second_squares * abc_abd.swapped();
        let [plus, minus] = products.get();
        plus - minus
    }

    /// Returns a bound of the error of the determinant in terms of the largest distance alone. No
    /// permanent of three rows of a length r exceeds 1.16 r^3 (Carlen, Lieb and Loss 2006), and the
    /// determinant is four of them times a square, with at most 17 roundings each.
    #[inline(always)]
    fn bound(&self) -> f64 {
        const BOUND: f64 = 4.0 * 1.16 * 9.0 * f64::EPSILON;
        let [one, other] = self.first_squares.max(self.second_squares).get();
        let square = larger(one, other);
        if square > SMALL * SMALL && square < LARGE * LARGE {
            BOUND * (square * square) * square.sqrt()
        } else {
            f64::INFINITY
        }
    }
}

/// Returns each of a pair twice.
#[inline(always)]
fn each(pair: F64x2) -> [F64x2; 2] {
    [pair.firsts(pair), pair.seconds(pair)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::{FAMILIES, Random, in_ball_oracle, orientation_oracle, points};

    #[test]
    fn signs_are_those_of_integers_at_every_scale() {
        for family in FAMILIES {
            for trial in 0..2000 {
                let mut random = Random(70_000 * family as u64 + trial);
                let scale = 2f64.powi(random.integer(-300, 250) as i32);
                let given = points::<3>(family, 5, &mut random).map_all(scale);
                check(&given, &format!("{family:?} {trial}"));
            }
        }
    }

    /// Integers of as many bits as doubles are trusted with, and of one more.
    #[test]
    fn signs_of_integers_are_exact_up_to_their_bits() {
        for (most, are_exact) in [(255, [true, true]), (511, [true, false]), (1 << 16, [false; 2])]
        {
            let mut random = Random(most as u64);
            for trial in 0..4000 {
                let far = |x: i64| [(-most, -most / 2), (most / 2, most)][(x > 0) as usize];
                let given: Vec<Point> = (0..5)
                    .map(|_| {
                        [0, 1, 2].map(|_| {
                            let (low, high) = far(random.integer(0, 1));
                            let step = if trial % 2 == 0 { most / 2 } else { 1 };
                            (random.integer(low, high) / step * step) as f64
                        })
                    })
                    .chain([[most as f64, 1.0, 0.0]])
                    .collect();
                let signs = Signs::new(&given);
                assert_eq!([signs.are_planes_exact, signs.are_spheres_exact], are_exact);
                check(&given, &format!("{most} {trial}"));
            }
        }
    }

    trait MapAll {
        fn map_all(self, scale: f64) -> Vec<Point>;
    }

    impl MapAll for Vec<Point> {
        fn map_all(self, scale: f64) -> Vec<Point> {
            self.into_iter().map(|point| point.map(|x| x * scale)).collect()
        }
    }

    fn check(points: &[Point], label: &str) {
        if !points.as_flattened().iter().all(|x| x.is_finite()) {
            return;
        }
        let mut signs = Signs::new(points);
        let [a, b, c, d, q] = [0, 1, 2, 3, 4].map(|at| &points[at]);
        let turn = orientation_oracle(&[a, b, c, d]);
        assert_eq!(signs.orientation([0, 1, 2], 3), turn, "{label} {points:?}");
        let corners = match turn {
            Sign::Positive => [0, 1, 2, 3],
            Sign::Negative => [1, 0, 2, 3],
            Sign::Zero => return,
        };
        let simplex = corners.map(|at| &points[at as usize]);
        let side = in_ball_oracle(&simplex, q);
        if side != Sign::Zero {
            let inside = signs.is_in_sphere(&corners, 4, q);
            assert_eq!(inside, side == Sign::Positive, "{label} {points:?}");
        }
    }
}
