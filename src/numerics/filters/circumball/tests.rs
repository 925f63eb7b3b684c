//! Decisions compared with exact signs, centres with exact rationals, and the limits of both.

use super::*;
use crate::numerics::testing::*;
use crate::numerics::{RoundedBall, Sign, in_ball, orientation};

/// Returns a positively oriented simplex of the family; `None` if this draw is flat.
fn simplex<const D: usize>(family: Family, random: &mut Random) -> Option<Vec<[f64; D]>> {
    let mut vertices = points::<D>(family, D + 1, random);
    match orientation(&references(&vertices)) {
        Sign::Positive => Some(vertices),
        Sign::Negative => {
            vertices.swap(0, 1);
            Some(vertices)
        }
        Sign::Zero => None,
    }
}

/// Returns query points: some of the family, a vertex moved by a few ulps, and a point almost on
/// the sphere.
fn queries<const D: usize>(
    family: Family,
    vertices: &[[f64; D]],
    center: &[f64; D],
    random: &mut Random,
) -> Vec<[f64; D]> {
    let mut queries = points::<D>(family, 3, random);
    let vertex = vertices[random.integer(0, D as i64) as usize];
    queries.push(vertex.map(|x| f64::from_bits(x.to_bits() ^ random.bits() & 3)));
    queries.push(vertex.map(|x| x * (1.0 + random.unit() * 1e-9)));
    let turn = random.integer(0, D as i64 - 1) as usize;
    queries.push(std::array::from_fn(|i| {
        if i == turn { center[i] - (vertex[i] - center[i]) } else { vertex[i] }
    }));
    queries.retain(|q| q.iter().all(|x| x.is_finite()));
    queries
}

/// Compares decisions with exact signs, in doubles and in single precision; returns how many tests
/// there were of a family, and how many of them the filter in doubles decided.
fn decisions<const D: usize>(family: Family, trials: usize) -> (usize, usize) {
    let mut random = Random(family as u64 * 1000 + D as u64);
    let (mut tested, mut decided) = (0, 0);
    for _ in 0..trials {
        let Some(vertices) = simplex::<D>(family, &mut random) else { continue };
        let simplex = references(&vertices);
        let ball = Circumball::new(&simplex);
        let anchor = &vertices[ball.anchor];
        for q in queries(family, &vertices, &ball.center_point(anchor), &mut random) {
            let [side, rounded] =
                [ball.side(anchor, &q), RoundedBall::new(&ball).side(|index| simplex[index], &q)];
            tested += 1;
            decided += usize::from(side.is_some());
            for inside in side.into_iter().chain(rounded) {
                let expected = if inside { Sign::Positive } else { Sign::Negative };
                let context = || format!("{family:?} {vertices:?} {q:?} {ball:?}");
                assert_eq!(in_ball(&simplex, &q), expected, "{}", context());
            }
        }
    }
    (tested, decided)
}

/// Checks decisions on `trials` simplices of each family, except flat ones, against exact signs.
fn side_agrees_with_exact_signs<const D: usize>(trials: usize) {
    let mut total = 0;
    for family in FAMILIES {
        let (tested, decided) = decisions::<D>(family, trials);
        total += tested;
        // The three queries of the family itself; those near the sphere may stay open.
        if matches!(family, Family::Uniform | Family::FarCluster | Family::MixedScales) {
            assert!(decided * 2 > tested, "{family:?} {decided} of {tested}");
        }
    }
    assert!(total >= 55 * trials, "{total}");
}

#[test]
fn side_agrees_with_exact_signs_in_2d() {
    side_agrees_with_exact_signs::<2>(3600);
}

#[test]
fn side_agrees_with_exact_signs_in_3d() {
    side_agrees_with_exact_signs::<3>(3600);
}

#[test]
fn side_agrees_with_exact_signs_in_4d() {
    side_agrees_with_exact_signs::<4>(1200);
}

#[test]
fn side_agrees_with_exact_signs_in_5d() {
    side_agrees_with_exact_signs::<5>(400);
}

#[test]
fn side_agrees_with_exact_signs_in_6d() {
    side_agrees_with_exact_signs::<6>(150);
}

#[test]
fn side_agrees_with_exact_signs_in_7d_and_8d() {
    side_agrees_with_exact_signs::<7>(30);
    side_agrees_with_exact_signs::<8>(10);
}

fn error_bounds_hold<const D: usize>(trials: usize) {
    for family in FAMILIES {
        let mut random = Random(family as u64 * 1000 + 500 + D as u64);
        for _ in 0..trials {
            let Some(vertices) = simplex::<D>(family, &mut random) else { continue };
            let simplex = references(&vertices);
            let ball = Circumball::new(&simplex);
            if ball.error == f64::INFINITY {
                assert_eq!(ball.radius(), f64::INFINITY);
                continue;
            }
            let size = largest_magnitude(&ball.center);
            let for_side = side_units(D) * norm(&ball.center);
            assert!((for_side..=1e-9 * size).contains(&ball.error), "{ball:?}");
            let (numerators, denominator) = circumcenter_oracle(&simplex, ball.anchor);
            let exponent = i64::from(ball.exponent);
            for (value, numerator) in ball.center.iter().zip(&numerators) {
                let quotient = (numerator, &denominator);
                let close = is_close(*value, ball.error - for_side, exponent, quotient);
                assert!(close, "{family:?} {vertices:?} {ball:?}");
            }
            let length = scale_by_power(norm(&ball.center), exponent);
            let difference = (ball.radius() - length).abs();
            assert!(ball.radius() == length || difference <= 1e-15 * length, "{ball:?}");
        }
    }
}

#[test]
fn centres_are_within_their_error_bounds() {
    error_bounds_hold::<2>(400);
    error_bounds_hold::<3>(300);
    error_bounds_hold::<4>(100);
    error_bounds_hold::<6>(10);
}

#[test]
fn far_points_are_outside_and_limits_are_undecided() {
    let ball = Circumball::new(&[&[0.0, 0.0], &[1.0, 0.0], &[0.0, 1.0]]);
    let anchor = [0.0, 0.0];
    assert_eq!((ball.anchor, ball.radius()), (0, 0.5f64.sqrt()));
    assert_eq!(ball.center_point(&anchor), [0.5, 0.5]);
    assert_eq!(ball.side(&anchor, &[1e200, 0.0]), Some(false));
    assert_eq!(ball.side(&anchor, &[-1e200, 0.0]), Some(false));
    assert_eq!(ball.side(&anchor, &[-f64::MAX, f64::MAX]), Some(false));
    assert_eq!(ball.side(&anchor, &[1.0, 1.0]), None);
    assert_eq!(ball.side(&anchor, &[1e-200, 1e-200]), Some(true));
    assert_eq!(ball.side(&anchor, &[1e-300, 1e-300]), None);
    let flat = Circumball::new(&[&[0.0, 0.0], &[1.0, 1.0], &[2.0, 2.0]]);
    assert!(flat.error == f64::INFINITY && flat.radius() == f64::INFINITY);
    assert!(!flat.center_point(&anchor)[0].is_finite());
    assert_eq!(flat.side(&anchor, &[5.0, 1.0]), None);
}

#[test]
fn generic_simplices_need_no_integers() {
    fn check<const D: usize>() {
        let mut random = Random(D as u64);
        for _ in 0..100 {
            let vertices = points::<D>(Family::Uniform, D + 1, &mut random);
            for scale in [1.0, 2f64.powi(-600), 2f64.powi(600)] {
                let scaled: Vec<_> = vertices.iter().map(|p| p.map(|x| x * scale)).collect();
                let simplex = references(&scaled);
                assert!((0..=D).all(|anchor| Circumball::in_floats(&simplex, anchor).is_some()));
            }
        }
    }
    check::<2>();
    check::<3>();
    check::<5>();
    // An edge 2^850 times longer than another.
    let points = [[0.0, 0.0], [1.0, 0.0], [0.0, 2f64.powi(850)]];
    assert!(Circumball::in_floats(&references(&points), 0).is_some());
}

/// Centres that are wrong by all that `error` admits decide no point wrongly.
#[test]
fn what_the_error_leaves_open_is_undecided() {
    for (sign, axis, exponent) in [(1.0, 0, 0), (-1.0, 0, 500), (1.0, 1, -500), (-1.0, 1, 0)] {
        let along = |x: f64| -> [f64; 2] {
            std::array::from_fn(|k| if k == axis { sign * x } else { 0.0 })
        };
        let side = |error: f64, distance: f64| {
            let unit = exponent - 1;
            let ball = Circumball { center: along(2.0), anchor: 0, error, exponent: unit };
            ball.side(&[0.0; 2], &along(distance).map(|x| x * 2.0 * ball.unit()))
        };
        // The true sphere ends up to `error` before or behind 2.
        let error = 2f64.powi(-20);
        for slip in [-0.99, 0.99] {
            assert_eq!(side(error, 2.0 + slip * error), None);
        }
        assert_eq!(side(error, 2.0 - 1.01 * error), Some(true));
        assert_eq!(side(error, 2.0 + 1.01 * error), Some(false));
        // With the least error, what is allowed for roundings: 7 units of the centre's length.
        let least = side_units(2) * 2.0;
        for slip in [-12.0, 12.0] {
            assert_eq!(side(least, 2.0 + slip * UNIT), None);
            assert!(side(least, 2.0 + 1.4 * slip * UNIT).is_some());
        }
    }
    assert_eq!([side_units(2), side_units(8)], [7.0 * UNIT, 13.0 * UNIT]);
}

/// Everyday simplices are solved at their first vertex, with an error as good as at any other.
#[test]
fn well_shaped_simplices_are_solved_at_once() {
    fn check<const D: usize>() {
        let mut random = Random(40 + D as u64);
        for trial in 0..100 {
            let scale = 2f64.powi(random.integer(-60, 60) as i32);
            let vertices: Vec<[f64; D]> = (0..=D)
                .map(|i| {
                    std::array::from_fn(|k| {
                        scale * (f64::from(u8::from(i == k)) + 0.1 * random.unit())
                    })
                })
                .collect();
            let ball = Circumball::new(&references(&vertices));
            assert_eq!((ball.anchor, ball.exponent), (0, PLAIN), "{trial}");
            assert!(ball.error < 3000.0 * UNIT * ball.radius());
            assert!(Circumball::by_cramer(&|i| &vertices[i], 0, 0.5).is_none());
        }
    }
    check::<2>();
    check::<3>();
    check::<4>();
}

/// Points about a short edge far from the first vertex need no exact arithmetic, however short the
/// edge is.
#[test]
fn huge_balls_tell_the_points_of_a_tiny_cluster_apart() {
    fn check<const D: usize>() {
        let mut random = Random(60 + D as u64);
        for depth in [4, 10, 20, 40, 80, 300] {
            let (mut tested, mut decided) = (0, 0);
            for _ in 0..50 {
                let tiny = 2f64.powi(-depth);
                let mut near = || -> [f64; D] { std::array::from_fn(|_| tiny * random.unit()) };
                let (a, b, queries) = (near(), near(), [near(), near(), near()]);
                let mut vertices = points::<D>(Family::Uniform, D + 1, &mut random);
                (vertices[D - 1], vertices[D]) = (a, b);
                match orientation(&references(&vertices)) {
                    Sign::Negative => vertices.swap(D - 1, D),
                    Sign::Zero => continue,
                    Sign::Positive => {}
                }
                let simplex = references(&vertices);
                let ball = Circumball::new(&simplex);
                let anchor = ball.anchor;
                assert!(depth < 20 || anchor >= D - 1, "{ball:?}");
                for q in queries {
                    tested += 1;
                    let Some(inside) = ball.side(&vertices[anchor], &q) else { continue };
                    decided += 1;
                    assert_eq!(inside, in_ball(&simplex, &q) == Sign::Positive);
                }
            }
            assert!(tested > 100 && decided * 100 >= tested * 99, "{depth} {decided} {tested}");
        }
    }
    check::<2>();
    check::<3>();
    check::<4>();
    check::<5>();
}

/// Balls of the same shape on both sides of the limits where scaling begins decide alike.
#[test]
fn scaled_balls_decide_like_plain_ones() {
    let vertices = [[0.0, 0.0, 0.0], [1.0, 0.25, 0.0], [0.0, 1.0, 0.5], [0.25, 0.0, 1.0]];
    for exponent in [-700, -92, -88, -74, -66, 0, 88, 92, 96, 104, 400] {
        let scale = 2f64.powi(exponent);
        let scaled = vertices.map(|p| p.map(|x| x * scale));
        let ball = Circumball::new(&references(&scaled));
        assert_eq!(ball.exponent == PLAIN, (-70..100).contains(&exponent), "{exponent}");
        let anchor = &scaled[ball.anchor];
        let side = |q: [f64; 3]| ball.side(anchor, &q.map(|x| x * scale));
        assert_eq!(side([0.5, 0.5, 0.5]), Some(true));
        assert_eq!(side([1.5, 1.5, -1.0]), Some(false));
        assert_eq!(side([-1e9, 0.0, 0.0]), Some(false));
        assert_eq!(vertices.map(side), [None; 4]);
    }
}

#[test]
fn the_anchor_is_on_the_shortest_edge() {
    fn check<const D: usize>() {
        let mut random = Random(D as u64);
        for _ in 0..200 {
            let vertices = points::<D>(Family::Uniform, D + 1, &mut random);
            let length = |i: usize, j: usize| -> f64 {
                (0..D).map(|k| (vertices[i][k] - vertices[j][k]).abs()).sum()
            };
            let edges = (0..D).flat_map(|i| (i + 1..=D).map(move |j| (i, j)));
            let shortest = edges.min_by(|a, b| length(a.0, a.1).total_cmp(&length(b.0, b.1)));
            let tiny: Vec<_> = vertices.iter().map(|p| p.map(|x| x * 2f64.powi(-600))).collect();
            for vertices in [&vertices, &tiny] {
                assert_eq!(shortest_edge(&references(vertices)), shortest.expect("edges").0);
            }
        }
    }
    check::<2>();
    check::<3>();
    check::<8>();
}

#[test]
fn scales_are_clamped_and_radii_limited() {
    let mut random = Random(3);
    for exponent in [-1015, -1005, -995, 995, 1005, 1015] {
        let scale = 2f64.powi(exponent);
        let vertices = points::<2>(Family::Uniform, 3, &mut random);
        let unscaled = Circumball::new(&references(&vertices));
        let scaled: Vec<_> = vertices.iter().map(|p| p.map(|x| x * scale)).collect();
        let ball = Circumball::new(&references(&scaled));
        assert!((-1000..=1000).contains(&ball.exponent));
        let expected = unscaled.radius() * scale;
        assert!((ball.radius() / expected - 1.0).abs() < 1e-8, "{exponent}");
    }
    // A radius of about 2^1500.
    let arc = [[0.0, 0.0], [2f64.powi(500), 0.0], [2f64.powi(501), 2f64.powi(-500)]];
    assert_eq!(Circumball::new(&references(&arc)).error, f64::INFINITY);
    // Of about 2^989, where the solution overflows in units of the longest edge, 2^-40.
    // `powi` of less than -1022 is 0 or not by the optimisation.
    let (w, h) = (2f64.powi(-40), scale_by_power(1.0, -1070));
    let ball = Circumball::new(&references(&[[0.0, 0.0], [w, h], [-w, h]]));
    assert!(ball.error < 1e-9 && (ball.radius() / 2f64.powi(989) - 1.0).abs() < 1e-8);
}

#[test]
fn huge_balls_at_the_end_of_the_range_are_sound() {
    let (a, b, c) = ([-f64::MAX, 0.0], [f64::MAX, 0.0], [0.0, f64::MAX]);
    let ball = Circumball::new(&[&a, &b, &c]);
    assert!((ball.radius() / f64::MAX - 1.0).abs() < 1e-15);
    let anchor = [a, b, c][ball.anchor];
    assert_eq!(ball.side(&anchor, &[0.0, -0.9 * f64::MAX]), Some(true));
    assert_ne!(ball.side(&anchor, &[f64::MAX, -f64::MAX]), Some(true));
}

/// Balls of points with small integer coordinates, times a power of two, are the same in each unit.
#[test]
fn powers_are_those_of_the_real_ball() {
    for exponent in [0, -400, 400] {
        let scale = power_of_two(exponent);
        let mut random = Random(8);
        let mut tested = 0;
        for _ in 0..200 {
            let mut point =
                || -> [f64; 3] { std::array::from_fn(|_| random.integer(-50, 50) as f64 * scale) };
            let vertices = [point(), point(), point(), point()];
            let (q, ball) = (point(), Circumball::new(&references(&vertices)));
            if ball.radius() >= 200.0 * scale {
                continue;
            }
            let anchor = &vertices[ball.anchor];
            let center = ball.center_point(anchor);
            let squares = |x: &[f64; 3]| -> f64 {
                x.iter().zip(&center).map(|(x, c)| (x - c) / scale * ((x - c) / scale)).sum()
            };
            let expected = squares(&q) - squares(anchor);
            let difference = ball.power(anchor, &q) / scale / scale - expected;
            assert!(difference.abs() < 1e-8, "{vertices:?} {q:?}: off by {difference}");
            tested += 1;
        }
        assert!(tested > 100, "{tested}");
    }
}

/// Checks that two balls computed at a time are those that come one at a time, or none. Their
/// errors come of lengths that are rounded in other ways.
fn pairs_are_single_balls<const D: usize>() {
    let mut random = Random(90 + D as u64);
    let mut found = 0;
    for family in FAMILIES {
        for _ in 0..300 {
            let mut draw = || points::<D>(family, D + 1, &mut random);
            let (first, second) = (draw(), draw());
            let one = |vertices: &[[f64; D]]| Circumball::by_cramer(&|i| &vertices[i], 0, FLAT);
            let expected = one(&first).zip(one(&second)).map(|(first, second)| [first, second]);
            let pair = RoundedBall::ordinary_pair(|i| &first[i], |i| &second[i]);
            assert_eq!(pair.is_some(), expected.is_some(), "{family:?} {first:?} {second:?}");
            for (rounded, ball) in pair.iter().flatten().zip(expected.iter().flatten()) {
                let [rounded, ball] =
                    [*rounded, RoundedBall::new(ball)].map(|ball| ball.ball().expect("it is one"));
                let error = ball.error;
                assert_eq!(Circumball { error, ..rounded }, ball, "{family:?}");
                assert!((0.99..1.01).contains(&(rounded.error / error)), "{family:?}");
            }
            found += usize::from(pair.is_some());
        }
    }
    assert_eq!(found > 300, D <= MAX_CRAMER, "{found}");
}

#[test]
fn two_balls_at_a_time_are_those_that_come_one_at_a_time() {
    pairs_are_single_balls::<2>();
    pairs_are_single_balls::<3>();
    pairs_are_single_balls::<4>();
    pairs_are_single_balls::<5>();
}

#[test]
fn one_flat_simplex_is_enough_to_look_at_each_alone() {
    let round = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let flat = [[0.0, 0.0], [1.0, 0.0], [2.0, 1e-9]];
    let huge = round.map(|point| point.map(|x| x * 1e200));
    let is_some = |first: &[[f64; 2]; 3], second: &[[f64; 2]; 3]| {
        RoundedBall::ordinary_pair(|i| &first[i], |i| &second[i]).is_some()
    };
    assert!(is_some(&round, &round));
    for other in [flat, huge] {
        assert!(!is_some(&round, &other) && !is_some(&other, &round));
    }
}
