//! Meetings of pairs, compared with clipping in exact fractions.

use super::meet::meet;
use super::oracle;
use crate::numerics::testing::Random;

/// Returns the bits for the interiors of triangles and of segments, without inner faces of
/// features.
fn inner(piece: &[u32]) -> u8 {
    if piece.len() == 3 { 1 << 0b111 } else { 1 << 0b11 }
}

/// Returns distinct points of a small lattice.
fn lattice(random: &mut Random, count: usize, width: i64) -> Vec<[f64; 3]> {
    let mut points: Vec<[f64; 3]> = Vec::new();
    while points.len() < count {
        let x = std::array::from_fn(|_| random.integer(0, width) as f64);
        if !points.contains(&x) {
            points.push(x);
        }
    }
    points
}

/// Returns a random triangle with an area, or a segment.
fn piece(random: &mut Random, points: &[[f64; 3]]) -> Vec<u32> {
    loop {
        let size = if random.integer(0, 3) == 0 { 2 } else { 3 };
        let mut own = Vec::new();
        while own.len() < size {
            let vertex = random.integer(0, points.len() as i64 - 1) as u32;
            if !own.contains(&vertex) {
                own.push(vertex);
            }
        }
        if size == 2 || !oracle::is_flat(points, &own) {
            return own;
        }
    }
}

fn compare(scale: f64, trials: usize) {
    let mut random = Random(7);
    let mut seen = [0usize; 4];
    for trial in 0..trials {
        let width = 1 + trial as i64 % 4;
        let whole = lattice(&mut random, 7, width);
        let (one, other) = (piece(&mut random, &whole), piece(&mut random, &whole));
        let expected = oracle::kind(&whole, &one, &other);
        let points: Vec<_> = whole.iter().map(|x| x.map(|x| x * scale)).collect();
        let found = meet(&points, &one, &other);
        let kind = found.map(|met| met.kind([inner(&one), inner(&other)]));
        assert_eq!(kind, expected, "{one:?} {other:?} {points:?}");
        seen[kind.map_or(3, |kind| usize::from(kind.rank()))] += 1;
        let back = meet(&points, &other, &one);
        assert_eq!(back.map(|met| met.kind([inner(&other), inner(&one)])), expected);
        if let Some(met) = found {
            let place = met.point(&points, &one, &other);
            for own in [&one, &other] {
                let away = distance(&points, own, &place) / scale;
                assert!(away < 1e-9, "{away} {place:?} {one:?} {other:?} {points:?}");
            }
        }
    }
    assert!(seen.iter().all(|&count| count > trials / 50), "{seen:?}");
}

/// Returns about the distance of a point from a triangle or segment, by the nearest of many points
/// of it.
fn distance(points: &[[f64; 3]], own: &[u32], x: &[f64; 3]) -> f64 {
    let corners: Vec<_> = own.iter().map(|v| points[*v as usize]).collect();
    let unit = corners.iter().flatten().fold(0.0f64, |unit, x| unit.max(x.abs()));
    let scaled = |x: &[f64; 3]| x.map(|x| x / unit);
    let corners: Vec<_> = corners.iter().map(scaled).collect();
    unit * to_hull(&corners, &scaled(x))
}

fn minus(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3])
}

/// Returns the distance of a point from a segment, or from a triangle.
fn to_hull(corners: &[[f64; 3]], x: &[f64; 3]) -> f64 {
    if let [a, b, c] = corners {
        let normal = cross(&minus(b, a), &minus(c, a));
        let is_left = |p, q| dot(&cross(&minus(q, p), &minus(x, p)), &normal) >= 0.0;
        if is_left(a, b) && is_left(b, c) && is_left(c, a) {
            return dot(&minus(x, a), &normal).abs() / dot(&normal, &normal).sqrt();
        }
        let sides = [[*a, *b], [*b, *c], [*c, *a]];
        return sides.iter().map(|side| to_hull(side, x)).fold(f64::INFINITY, f64::min);
    }
    let [a, b] = [&corners[0], &corners[1]];
    let way = minus(b, a);
    let share = (dot(&minus(x, a), &way) / dot(&way, &way)).clamp(0.0, 1.0);
    let rest = [0, 1, 2].map(|k| x[k] - a[k] - share * way[k]);
    dot(&rest, &rest).sqrt()
}

#[test]
fn meetings_are_those_of_exact_fractions() {
    compare(1.0, 20_000);
}

#[test]
fn meetings_are_exact_at_all_scales() {
    for scale in [f64::from_bits(1 << 34), 2f64.powi(-530), 2f64.powi(900), 2f64.powi(1021)] {
        compare(scale, 3_000);
    }
}
