//! Polygons of one facet: which of them are in each other, and which bound the facet.
//!
//! TetGen's facet is what its polygons enclose, without the parts that a hole's point is in. A
//! polygon in another one is therefore the boundary of a hole only if such a point says so; without
//! one its sides are segments in the facet. Facets of this library go by the even-odd rule instead.

use crate::memory::{AllocResult, TryGrow, collected, filled};

/// Polygons of a facet, in the projection along an axis.
pub(super) struct Loops {
    polygons: Vec<Polygon>,
    /// Polygons of three points or more, by their least coordinate.
    order: Vec<u32>,
    /// Coordinates that the projection keeps.
    axes: [usize; 2],
    /// Power of two that brings every coordinate below 2.
    scale: f64,
}

struct Polygon {
    corners: Vec<[f64; 2]>,
    low: [f64; 2],
    high: [f64; 2],
    /// Smallest polygon that it is in.
    parent: Option<usize>,
    /// Number of polygons that it is in.
    depth: u32,
    /// True if what it bounds, less the polygons in it, has a hole's point.
    has_hole: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Inside,
    /// On the polygon, or so near that rounding hides the side.
    On,
    Outside,
}

impl Loops {
    /// Makes the loops of a facet; `points` are the coordinates of all points, three each.
    pub fn new<'p>(
        polygons: impl Iterator<Item = &'p [u32]> + Clone,
        points: &[f64],
    ) -> AllocResult<Self> {
        let point = |&corner: &u32| -> [f64; 3] {
            std::array::from_fn(|axis| points[3 * corner as usize + axis])
        };
        let all = polygons.clone().flatten().flat_map(&point);
        let scale = scale_of(all.fold(0.0, |largest: f64, x| largest.max(x.abs())));
        let scaled = |corner: &u32| point(corner).map(|x| x * scale);
        let normals = polygons.clone().map(|polygon| normal(polygon.iter().map(scaled)));
        let axes = kept_axes(normals.fold([0.0; 3], |a, b| if size(b) > size(a) { b } else { a }));
        let mut loops = Self { polygons: Vec::new(), order: Vec::new(), axes, scale };
        for polygon in polygons {
            let corners = collected(polygon.iter().map(|corner| loops.projected(point(corner))))?;
            loops.polygons.try_push(Polygon::new(corners))?;
        }
        let is_loop = |at: &u32| loops.polygons[*at as usize].corners.len() > 2;
        loops.order = collected((0..loops.polygons.len() as u32).filter(is_loop))?;
        let Self { polygons, order, .. } = &mut loops;
        order.sort_unstable_by(|&a, &b| {
            let [low_a, low_b] = [a, b].map(|at| polygons[at as usize].low[0]);
            low_a.total_cmp(&low_b).then(a.cmp(&b))
        });
        loops.nest()?;
        Ok(loops)
    }

    fn projected(&self, point: [f64; 3]) -> [f64; 2] {
        self.axes.map(|axis| point[axis] * self.scale)
    }

    /// Finds which polygons are in which.
    fn nest(&mut self) -> AllocResult<()> {
        let mut found: Vec<(usize, usize)> = Vec::new();
        for &outer in &self.order {
            let outer = outer as usize;
            let [low, high] = [self.polygons[outer].low[0], self.polygons[outer].high[0]];
            let low_of = |at: &u32| self.polygons[*at as usize].low[0];
            let first = self.order.partition_point(|at| low_of(at) < low);
            let inner = self.order[first..].iter().take_while(|at| low_of(at) <= high);
            for inner in inner.map(|at| *at as usize) {
                if inner != outer && self.is_in(inner, outer) {
                    found.try_push((inner, outer))?;
                }
            }
        }
        found.iter().for_each(|(inner, _)| self.polygons[*inner].depth += 1);
        for (inner, outer) in found {
            let depth = |at: usize| self.polygons[at].depth;
            let is_nearer = self.polygons[inner].parent.is_none_or(|at| depth(at) < depth(outer));
            if is_nearer {
                self.polygons[inner].parent = Some(outer);
            }
        }
        Ok(())
    }

    /// Returns true if polygon `inner` is in polygon `outer`, whose boundary it may touch.
    fn is_in(&self, inner: usize, outer: usize) -> bool {
        let [inner, outer] = [&self.polygons[inner], &self.polygons[outer]];
        let has_room = |axis: usize| {
            outer.low[axis] <= inner.low[axis] && inner.high[axis] <= outer.high[axis]
        };
        if !(has_room(0) && has_room(1)) {
            return false;
        }
        let mut is_strict = false;
        for corner in &inner.corners {
            match outer.side(*corner) {
                Side::Outside => return false,
                side => is_strict |= side == Side::Inside,
            }
        }
        // A chord of the outer polygon has both ends on it.
        let middle = |[a, b]: [[f64; 2]; 2]| [0, 1].map(|axis| 0.5 * (a[axis] + b[axis]));
        is_strict || inner.sides().any(|ends| outer.side(middle(ends)) == Side::Inside)
    }

    /// Adds a point in a hole.
    ///
    /// # Errors
    /// The rule that the point breaks.
    pub fn add_hole(&mut self, point: [f64; 3]) -> Result<(), &'static str> {
        let point = self.projected(point);
        let mut innermost: Option<usize> = None;
        for &at in &self.order {
            let at = at as usize;
            match self.polygons[at].side(point) {
                Side::Outside => {}
                Side::On => return Err("the point of the hole is on a polygon of the facet"),
                Side::Inside => {
                    let depth = self.polygons[at].depth;
                    if innermost.is_none_or(|other| self.polygons[other].depth < depth) {
                        innermost = Some(at);
                    }
                }
            }
        }
        match innermost {
            Some(at) if self.polygons[at].depth == 0 => Err(
                "the point of the hole is in the facet; a polygon of the facet goes round a hole",
            ),
            Some(at) => {
                self.polygons[at].has_hole = true;
                Ok(())
            }
            // What is outside of all polygons is no part of the facet anyway.
            None => Ok(()),
        }
    }

    /// Returns for each polygon true if it bounds the facet by the even-odd rule, and false if its
    /// sides are in the facet or in a hole. Polygons of fewer than three points bound nothing, and
    /// are what they are.
    pub fn bounds(&self) -> AllocResult<Vec<bool>> {
        let mut bounds = filled(self.polygons.len(), true)?;
        for &at in &self.order {
            let Polygon { parent, has_hole, .. } = self.polygons[at as usize];
            let is_in = |at: usize| !self.polygons[at].has_hole;
            bounds[at as usize] = parent.is_none_or(|parent| is_in(parent) == has_hole);
        }
        Ok(bounds)
    }
}

impl Polygon {
    fn new(corners: Vec<[f64; 2]>) -> Self {
        let along = |axis: usize| corners.iter().map(move |corner| corner[axis]);
        let low = [0, 1].map(|axis| along(axis).fold(f64::INFINITY, f64::min));
        let high = [0, 1].map(|axis| along(axis).fold(f64::NEG_INFINITY, f64::max));
        Self { corners, low, high, parent: None, depth: 0, has_hole: false }
    }

    /// Returns the ends of each side.
    fn sides(&self) -> impl Iterator<Item = [[f64; 2]; 2]> {
        let nexts = self.corners.iter().cycle().skip(1);
        self.corners.iter().zip(nexts).map(|(a, b)| [*a, *b])
    }

    /// Returns the side of a point by the even-odd rule. Exact, but for points that are on.
    fn side(&self, point: [f64; 2]) -> Side {
        let is_beside = |axis: usize| point[axis] < self.low[axis] || self.high[axis] < point[axis];
        if is_beside(0) || is_beside(1) {
            return Side::Outside;
        }
        let [x, y] = point;
        let mut is_inside = false;
        for [a, b] in self.sides() {
            let is_between = (a[0] <= x || b[0] <= x) && (x <= a[0] || x <= b[0]);
            if a == point || (a[1] == y && b[1] == y && is_between) {
                return Side::On;
            }
            if (a[1] > y) != (b[1] > y) {
                match turn(a, b, point) {
                    0.0 => return Side::On,
                    turn => is_inside ^= (turn > 0.0) == (b[1] > a[1]),
                }
            }
        }
        if is_inside { Side::Inside } else { Side::Outside }
    }
}

/// Returns a number whose sign is that of the turn a, b, c; 0 where rounding may hide it. The
/// coordinates are below 2.
fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    let [left, right] = [(a[0] - c[0]) * (b[1] - c[1]), (a[1] - c[1]) * (b[0] - c[0])];
    let error = 4.0 * f64::EPSILON * (left.abs() + right.abs()) + f64::MIN_POSITIVE;
    let turn = left - right;
    if turn.abs() > error { turn } else { 0.0 }
}

/// Returns the power of two that brings numbers up to `largest` below 2.
fn scale_of(largest: f64) -> f64 {
    let exponent = (largest.to_bits() >> 52) as i32 - 1023;
    2f64.powi(-exponent.max(-1022))
}

/// Returns twice the area of a polygon as a vector along its normal.
fn normal(mut corners: impl Iterator<Item = [f64; 3]>) -> [f64; 3] {
    let mut sum = [0.0; 3];
    let Some(origin) = corners.next() else { return sum };
    let mut before = [0.0; 3];
    for corner in corners {
        let here: [f64; 3] = std::array::from_fn(|axis| corner[axis] - origin[axis]);
        for (axis, sum) in sum.iter_mut().enumerate() {
            let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
            *sum += before[next] * here[last] - before[last] * here[next];
        }
        before = here;
    }
    sum
}

fn size(normal: [f64; 3]) -> f64 {
    normal.iter().fold(0.0, |largest, x| largest.max(x.abs()))
}

/// Returns the axes that are left without that along which the normal is longest.
fn kept_axes(normal: [f64; 3]) -> [usize; 2] {
    let dropped = (0..3).max_by(|&a, &b| normal[a].abs().total_cmp(&normal[b].abs()));
    match dropped {
        Some(0) => [1, 2],
        Some(1) => [2, 0],
        _ => [0, 1],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the points of squares about one centre, four each, whose sides are 2, 4, 6 and so
    /// on, in a plane that `place` leads to.
    fn squares(count: usize, place: impl Fn([f64; 2]) -> [f64; 3]) -> Vec<f64> {
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        let square = |size: usize| corners.map(|corner| place(corner.map(|x| x * size as f64)));
        (1..=count).flat_map(square).flatten().collect()
    }

    fn bounds(points: &[f64], polygons: &[&[u32]], holes: &[[f64; 3]]) -> Vec<bool> {
        let mut loops = Loops::new(polygons.iter().copied(), points).unwrap();
        holes.iter().for_each(|hole| loops.add_hole(*hole).unwrap());
        loops.bounds().unwrap()
    }

    #[test]
    fn polygons_in_each_other_bound_what_is_no_hole() {
        // In planes of every direction, far from the origin, huge and tiny.
        let planes: [fn([f64; 2]) -> [f64; 3]; 6] = [
            |[x, y]| [x, y, 0.0],
            |[x, y]| [5.0, x, y],
            |[x, y]| [y, -3.0, x],
            |[x, y]| [1e6 + x, y - 1e6, 0.25 * x - 0.5 * y],
            |[x, y]| [1e300 * x, 1e300 * y, 1e299 * y],
            |[x, y]| [1e-310 * x, 1e-308 * (x + y), 1e-308 * y],
        ];
        let polygons: [&[u32]; 4] =
            [&[8, 9, 10, 11], &[0, 1, 2, 3], &[12, 13, 14, 15], &[7, 6, 5, 4]];
        for place in planes {
            let points = squares(4, place);
            let of = |holes: &[[f64; 3]]| bounds(&points, &polygons, holes);
            let holes = [[0.0, 0.0], [1.5, 0.1], [2.5, 0.1], [9.0, 9.0]].map(place);
            assert_eq!(of(&[]), [false, false, true, false]);
            assert_eq!(of(&holes[3..]), [false, false, true, false]);
            // The outermost ring is in the facet, and then the next ones are in turn or not.
            assert_eq!(of(&holes[..1]), [false, true, true, false]);
            assert_eq!(of(&holes[1..2]), [false, true, true, true]);
            assert_eq!(of(&holes[..2]), [false, false, true, true]);
            assert_eq!(of(&holes[2..3]), [true, false, true, true]);
            assert_eq!(of(&[holes[0], holes[2]]), [true, true, true, true]);
            assert_eq!(of(&holes[..3]), [true, false, true, false]);
        }
    }

    #[test]
    fn polygons_may_touch_each_other() {
        // An octagon, a square on every other of its points, one on two of them, one beside.
        let angle = |at: f64| at * std::f64::consts::FRAC_PI_4;
        let mut points: Vec<f64> =
            (0..8).flat_map(|at| [angle(at.into()).cos(), angle(at.into()).sin(), 0.5]).collect();
        points.extend([0.25, 0.25, 0.5, 3.0, 0.0, 0.5, 3.0, 1.0, 0.5]);
        let octagon = [0, 1, 2, 3, 4, 5, 6, 7];
        let polygons: [&[u32]; 5] = [&octagon, &[0, 2, 4, 6], &[0, 1, 8], &[0, 9, 10], &[0, 9]];
        let loops = Loops::new(polygons.into_iter(), &points).unwrap();
        let depths: Vec<u32> = loops.polygons.iter().map(|polygon| polygon.depth).collect();
        assert_eq!(depths, [0, 1, 1, 0, 0]);
        assert_eq!(bounds(&points, &polygons, &[]), [true, false, false, true, true]);
        // The same polygon twice is in none.
        let twice: [&[u32]; 2] = [&octagon, &octagon];
        assert_eq!(bounds(&points, &twice, &[]), [true, true]);
    }

    #[test]
    fn a_hole_is_that_of_the_smallest_polygon_round_it() {
        // Also where another one begins as far to the left and comes after it.
        let corners = [[0, 0], [4, -4], [4, 4], [1, 0], [2, -1], [2, 1]].map(|p| p.map(f64::from));
        let points: Vec<f64> = corners.iter().flat_map(|[x, y]| [*x, *y, 0.0]).collect();
        let polygons: [&[u32]; 3] = [&[3, 4, 5], &[0, 4, 5], &[0, 1, 2]];
        assert_eq!(bounds(&points, &polygons, &[[1.5, 0.1, 0.0]]), [true, false, true]);
        let within: [&[u32]; 2] = [&[0, 4, 5], &[0, 1, 2]];
        assert_eq!(bounds(&points, &within, &[[1.5, 0.1, 0.0]]), [true, true]);
    }

    #[test]
    fn a_hole_must_have_a_polygon_of_its_own() {
        let points = squares(2, |[x, y]| [x, y, 1.0]);
        let polygons: [&[u32]; 2] = [&[4, 5, 6, 7], &[0, 1, 2, 3]];
        let rule = |hole: [f64; 2]| {
            let mut loops = Loops::new(polygons.into_iter(), &points).unwrap();
            loops.add_hole([hole[0], hole[1], 1.0]).err().map(|rule| rule.contains("goes round"))
        };
        for (hole, expected) in [
            ([0.5, 0.5], None),
            ([1.5, 0.5], Some(true)),
            ([2.5, 0.5], None),
            ([1.0, 0.5], Some(false)),
            ([0.25, -1.0], Some(false)),
            ([2.0, 2.0], Some(false)),
            ([-1.0, 1.0], Some(false)),
            ([-1.5, -1.0], Some(true)),
        ] {
            assert_eq!(rule(hole), expected, "{hole:?}");
        }
    }

    #[test]
    fn ten_thousand_holes_take_no_time() {
        let mut points = squares(1, |[x, y]| [1e3 * x, 1e3 * y, 0.0]);
        for at in 0..10_000 {
            let [x, y] = [(at % 100) as f64, (at / 100) as f64];
            points.extend([x, y, 0.0, x + 0.5, y, 0.0, x, y + 0.5, 0.0]);
        }
        let holes: Vec<[u32; 3]> =
            (0..10_000).map(|at| [0, 1, 2].map(|k| 4 + 3 * at + k)).collect();
        let outer: [&[u32]; 1] = [&[0, 1, 2, 3]];
        let polygons = outer.into_iter().chain(holes.iter().map(<[u32; 3]>::as_slice));
        let mut loops = Loops::new(polygons, &points).unwrap();
        for hole in &holes {
            let at = 3 * hole[0] as usize;
            loops.add_hole([points[at] + 0.1, points[at + 1] + 0.1, 0.0]).unwrap();
        }
        assert!(loops.bounds().unwrap().into_iter().all(|bounds| bounds));
    }
}
