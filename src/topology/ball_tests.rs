//! Balls in doubles against those in integers, where doubles are at their limits.

use super::circumscribed::ball;
use super::exact;
use super::radius::Radius;
use crate::numerics::testing::{Random, references};

fn agrees<const K: usize, const D: usize>(points: &[[f64; D]]) {
    let points = references(points);
    let found = ball::<K, D>(&points, Radius::Square).unwrap();
    let expected = exact::negative_coordinates(&points).unwrap();
    assert_eq!(found.as_ref().map(|ball| ball.negative), expected, "{points:?}");
    let radius = exact::radius(&points, Radius::Square).unwrap();
    assert_eq!(found.map(|ball| ball.radius), radius, "{points:?}");
}

fn random_point<const D: usize>(random: &mut Random) -> [f64; D] {
    std::array::from_fn(|_| random.unit())
}

/// Returns a combination of points with weights that sum to 1, moved by `offset` in each
/// coordinate.
fn combined<const D: usize>(points: &[[f64; D]], offset: f64, random: &mut Random) -> [f64; D] {
    let weights: Vec<f64> = points.iter().map(|_| random.unit()).collect();
    let rest = 1.0 - weights[1..].iter().sum::<f64>();
    std::array::from_fn(|i| {
        let sum: f64 = (1..points.len()).map(|k| weights[k] * points[k][i]).sum();
        rest * points[0][i] + sum + offset * random.unit()
    })
}

/// Tries faces whose last point is almost in the hyperplane of the others, by all distances from
/// it.
fn slivers_agree<const K: usize, const D: usize>(trials: usize) {
    let mut random = Random(100 * K as u64 + D as u64);
    for trial in 0..trials {
        let mut points: Vec<[f64; D]> = (0..K).map(|_| random_point(&mut random)).collect();
        let offset = 2f64.powi(-((trial % 56) as i32));
        points.push(combined(&points, offset, &mut random));
        agrees::<K, D>(&points);
    }
}

/// Tries faces as flat as doubles may be: the error of the centre counts.
#[test]
fn the_flattest_that_doubles_take() {
    let mut random = Random(77);
    for _ in 0..20_000 {
        let mut points: Vec<[f64; 3]> = (0..3).map(|_| random_point(&mut random)).collect();
        points.push(combined(&points, 2f64.powf(-10.5), &mut random));
        let points = references(&points);
        let found = ball::<3, 3>(&points, Radius::Square).unwrap().unwrap();
        let expected = exact::radius(&points, Radius::Square).unwrap();
        assert_eq!(Some(found.radius), expected, "{points:?}");
    }
}

#[test]
fn slivers() {
    slivers_agree::<2, 2>(600);
    slivers_agree::<2, 3>(600);
    slivers_agree::<3, 3>(600);
    slivers_agree::<3, 5>(200);
    slivers_agree::<4, 4>(200);
    slivers_agree::<5, 5>(100);
}

/// Tries faces whose centre is almost in the facet opposite the last point.
fn right_angles_agree<const K: usize, const D: usize>(trials: usize) {
    let mut random = Random(300 * K as u64 + D as u64);
    for _ in 0..trials {
        // Ends of a diameter, and others of its sphere.
        let (center, mut points) = (random_point::<D>(&mut random), Vec::new());
        for _ in 0..K {
            let direction = random_point::<D>(&mut random);
            let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
            let at = |sign: f64| std::array::from_fn(|i| center[i] + sign * direction[i] / length);
            if points.is_empty() {
                points.push(at(-1.0));
            }
            points.push(at(1.0));
        }
        agrees::<K, D>(&points);
        points.reverse();
        agrees::<K, D>(&points);
    }
}

#[test]
fn right_angles() {
    right_angles_agree::<2, 2>(600);
    right_angles_agree::<3, 3>(600);
    right_angles_agree::<2, 4>(300);
    right_angles_agree::<4, 4>(200);
}

/// Squares that are subnormal are rounded once.
#[test]
fn tiny_squares() {
    let mut random = Random(8);
    for trial in 0..400 {
        let scale = 2f64.powi(-505 - trial % 30);
        let scaled = |p: [f64; 3]| p.map(|x| x * scale);
        let points: Vec<[f64; 3]> = (0..3).map(|_| scaled(random_point(&mut random))).collect();
        agrees::<2, 3>(&points);
    }
}

/// Holds that where the square of a radius lies between two doubles, the even one is the nearest.
#[test]
fn ties() {
    for whole in 100_000_001u64..100_000_101 {
        // The squares have 54 bits; those of odd numbers end with a 1.
        let length = whole as f64;
        agrees::<1, 2>(&[[0.0, 0.0], [length, 0.0]]);
        let expected = u128::from(whole).pow(2) as f64 / 4.0;
        let points = [[0.0, 0.0], [0.0, length]];
        let found = ball::<1, 2>(&references(&points), Radius::Square).unwrap().unwrap();
        assert_eq!(found.radius, expected, "{whole}");
        let by_integers = exact::radius(&references(&points), Radius::Square).unwrap();
        assert_eq!(by_integers, Some(expected), "{whole}");
    }
}
