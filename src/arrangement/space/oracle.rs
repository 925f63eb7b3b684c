//! The set that two triangles or segments with whole coordinates share, by clipping in fractions of
//! integers of any size.

use crate::mesh::IntersectionKind;
use dashu_int::IBig;

/// Point in homogeneous coordinates, of which the last is positive.
type Exact = [IBig; 4];

/// Half-space of points with `f . x >= 0`.
type HalfSpace = [IBig; 4];

/// Triangle or segment as half-spaces.
struct Hull {
    /// Half-spaces that make its plane or line.
    flat: Vec<HalfSpace>,
    /// Vertex -> the half-space that it is inside of, and the other vertices at the border.
    sides: Vec<HalfSpace>,
}

/// Returns how two triangles or segments meet in more than what they share by number, as the kind
/// that it is for features without inner faces, or nothing.
pub(super) fn kind(points: &[[f64; 3]], one: &[u32], other: &[u32]) -> Option<IntersectionKind> {
    let corners =
        [one, other].map(|own| own.iter().map(|v| exact(&points[*v as usize])).collect::<Vec<_>>());
    let hulls = [&corners[0], &corners[1]].map(|corners| hull(corners));
    let mut common = corners[0].clone();
    for half in hulls[1].flat.iter().chain(&hulls[1].sides) {
        common = clipped(&common, half);
    }
    let mut distinct: Vec<Exact> = Vec::new();
    for x in common {
        if !distinct.iter().any(|y| are_equal(&x, y)) {
            distinct.push(x);
        }
    }
    let shared: Vec<&Exact> = one
        .iter()
        .zip(&corners[0])
        .filter(|(vertex, _)| other.contains(vertex))
        .map(|(_, x)| x)
        .collect();
    let is_shared = |x: &Exact| shared.iter().any(|y| are_equal(x, y));
    let are_same_triangle = shared.len() == 3;
    if distinct.iter().all(is_shared) && !are_same_triangle {
        assert_eq!(distinct.len(), shared.len());
        return None;
    }
    let middle: Exact = std::array::from_fn(|k| distinct.iter().map(|x| x[k].clone()).sum());
    let is_inside = |hull: &Hull| hull.sides.iter().all(|half| value(half, &middle) > IBig::ZERO);
    let are_triangles = one.len() == 3 && other.len() == 3;
    let inside = [is_inside(&hulls[0]), is_inside(&hulls[1])];
    Some(match (distinct.len(), inside) {
        (3.., _) => IntersectionKind::Overlap,
        (2, [true, true]) if are_triangles => IntersectionKind::Cross,
        (2, [true, false] | [false, true]) if are_triangles => IntersectionKind::Touch,
        (2, _) => IntersectionKind::Overlap,
        (_, [true, true]) => IntersectionKind::Cross,
        _ => IntersectionKind::Touch,
    })
}

/// Returns true if a triangle has no area.
pub(super) fn is_flat(points: &[[f64; 3]], triangle: &[u32]) -> bool {
    let corners: Vec<_> = triangle.iter().map(|v| exact(&points[*v as usize])).collect();
    cross(&minus(&corners[1], &corners[0]), &minus(&corners[2], &corners[0]))
        .iter()
        .all(|x| *x == IBig::ZERO)
}

fn exact(x: &[f64; 3]) -> Exact {
    let [x, y, z] = x.map(|x| {
        assert_eq!(x, x.trunc());
        IBig::from(x as i64)
    });
    [x, y, z, IBig::ONE]
}

fn minus(a: &Exact, b: &Exact) -> [IBig; 3] {
    std::array::from_fn(|k| &a[k] - &b[k])
}

fn cross(a: &[IBig; 3], b: &[IBig; 3]) -> [IBig; 3] {
    std::array::from_fn(|k| &a[(k + 1) % 3] * &b[(k + 2) % 3] - &a[(k + 2) % 3] * &b[(k + 1) % 3])
}

fn dot(a: &[IBig], b: &[IBig]) -> IBig {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn value(half: &HalfSpace, x: &Exact) -> IBig {
    dot(half, x)
}

/// Returns the half-space with a normal whose border goes through a point.
fn through(normal: &[IBig; 3], x: &Exact) -> HalfSpace {
    let [a, b, c] = normal.clone();
    [a, b, c, -dot(normal, &x[..3])]
}

fn hull(corners: &[Exact]) -> Hull {
    let negated = |normal: &[IBig; 3]| normal.clone().map(|x| -x);
    if let [a, b] = corners {
        let way = minus(b, a);
        let axes = (0..3).map(|axis| {
            let unit: [IBig; 3] = std::array::from_fn(|k| IBig::from(u8::from(k == axis)));
            cross(&way, &unit)
        });
        let flat = axes.flat_map(|normal| [through(&normal, a), through(&negated(&normal), a)]);
        let sides = vec![through(&negated(&way), b), through(&way, a)];
        return Hull { flat: flat.collect(), sides };
    }
    let [a, b, c] = corners else { unreachable!("a triangle") };
    let normal = cross(&minus(b, a), &minus(c, a));
    let flat = vec![through(&normal, a), through(&negated(&normal), a)];
    let side = |from: &Exact, to: &Exact| through(&cross(&normal, &minus(to, from)), from);
    Hull { flat, sides: vec![side(b, c), side(c, a), side(a, b)] }
}

/// Returns the part of a convex polygon in a half-space.
fn clipped(polygon: &[Exact], half: &HalfSpace) -> Vec<Exact> {
    let mut kept = Vec::new();
    for (at, x) in polygon.iter().enumerate() {
        let y = &polygon[(at + 1) % polygon.len()];
        let (u, v) = (value(half, x), value(half, y));
        if u >= IBig::ZERO {
            kept.push(x.clone());
        }
        if u > IBig::ZERO && v < IBig::ZERO || u < IBig::ZERO && v > IBig::ZERO {
            // Weighted so that the value is zero, with a positive last coordinate.
            let [p, q] = if u > IBig::ZERO { [u, -v] } else { [-u, v] };
            kept.push(std::array::from_fn(|k| &x[k] * &q + &y[k] * &p));
        }
    }
    kept
}

fn are_equal(a: &Exact, b: &Exact) -> bool {
    (0..3).all(|k| &a[k] * &b[3] == &b[k] * &a[3])
}
