//! Signs of orientation and in-ball determinants are those of exact integers, change as a
//! determinant does under permutation and negation, and no circumball contradicts them.

use super::bytes::Bytes;
use super::{families, oracle};
use netmesh::numerics::{
    Circumball, Sign, in_ball, in_ball_exact, orientation, orientation_exact, orientation_filtered,
};

/// Checks signs. The bytes pick the dimension, a family of points, and the points.
pub fn check(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    match 2 + bytes.below(5) {
        2 => check_bytes::<2>(&mut bytes),
        3 => check_bytes::<3>(&mut bytes),
        4 => check_bytes::<4>(&mut bytes),
        5 => check_bytes::<5>(&mut bytes),
        _ => check_bytes::<6>(&mut bytes),
    }
}

fn check_bytes<const D: usize>(bytes: &mut Bytes<'_>) {
    let swapped = (bytes.below(D as u8 + 1), bytes.below(D as u8 + 1));
    let coordinates = families::points(bytes, D, D + 2);
    let points: Vec<[f64; D]> =
        coordinates.chunks_exact(D).map(|p| std::array::from_fn(|i| p[i])).collect();
    check_points(&points, swapped);
}

/// Checks signs of `D + 1` vertices and a query point; two vertices are exchanged.
pub fn check_points<const D: usize>(points: &[[f64; D]], swapped: (usize, usize)) {
    let signs = Signs::of(points);
    assert_eq!(signs, Signs::exact(points), "{points:?}");
    assert_eq!(signs, Signs::oracle(points), "{points:?}");
    let filtered = orientation_filtered(&references(points)[..=D]);
    assert!(filtered.is_none_or(|sign| sign == signs.orientation), "{points:?}");
    check_symmetry(points, signs, swapped);
    check_circumball(points, signs);
}

/// Orientation of the first `D + 1` points, and the side of the last.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Signs {
    orientation: Sign,
    side: Sign,
}

impl Signs {
    fn of<const D: usize>(points: &[[f64; D]]) -> Self {
        let references = references(points);
        let simplex = &references[..=D];
        Self { orientation: orientation(simplex), side: in_ball(simplex, &points[D + 1]) }
    }

    fn exact<const D: usize>(points: &[[f64; D]]) -> Self {
        let references = references(points);
        let simplex = &references[..=D];
        Self {
            orientation: orientation_exact(simplex),
            side: in_ball_exact(simplex, &points[D + 1]),
        }
    }

    fn oracle<const D: usize>(points: &[[f64; D]]) -> Self {
        let simplex = &points[..=D];
        Self {
            orientation: sign(oracle::orientation(simplex)),
            side: sign(oracle::in_ball(simplex, &points[D + 1])),
        }
    }

    fn flip(self) -> Self {
        Self { orientation: self.orientation.flip(), side: self.side.flip() }
    }
}

pub fn references<const D: usize>(points: &[[f64; D]]) -> Vec<&[f64; D]> {
    points.iter().collect()
}

pub fn sign(value: i8) -> Sign {
    match value {
        1 => Sign::Positive,
        0 => Sign::Zero,
        _ => Sign::Negative,
    }
}

fn check_symmetry<const D: usize>(points: &[[f64; D]], signs: Signs, swapped: (usize, usize)) {
    let mut exchanged = points.to_vec();
    exchanged.swap(swapped.0, swapped.1);
    let expected = if swapped.0 == swapped.1 { signs } else { signs.flip() };
    assert_eq!(Signs::of(&exchanged), expected, "{swapped:?} of {points:?}");

    let mut inside_out = points.to_vec();
    inside_out.swap(swapped.0, D + 1);
    assert_eq!(Signs::of(&inside_out).side, signs.side.flip(), "{swapped:?} of {points:?}");

    let negated: Vec<[f64; D]> = points.iter().map(|p| p.map(|x| -x)).collect();
    let expected = if D % 2 == 0 { signs } else { signs.flip() };
    assert_eq!(Signs::of(&negated), expected, "the negative of {points:?}");

    let mut mirrored = points.to_vec();
    mirrored.iter_mut().for_each(|p| p[swapped.0 % D] = -p[swapped.0 % D]);
    assert_eq!(Signs::of(&mirrored), signs.flip(), "axis {} of {points:?}", swapped.0 % D);
}

/// Checks the decisions of a ball, for the query point and for the vertices, which are on the
/// sphere.
fn check_circumball<const D: usize>(points: &[[f64; D]], signs: Signs) {
    if signs.orientation == Sign::Zero {
        return;
    }
    let simplex = &references(points)[..=D];
    let ball = Circumball::new(simplex);
    let anchor = simplex[ball.anchor];
    for vertex in simplex {
        assert_eq!(ball.side(anchor, vertex), None, "{vertex:?} of {points:?}");
    }
    if let Some(inside) = ball.side(anchor, &points[D + 1]) {
        let expected = if inside { signs.orientation } else { signs.orientation.flip() };
        assert_eq!(signs.side, expected, "{ball:?} of {points:?}");
    }
}
