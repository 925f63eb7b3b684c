//! Tests of the certificate's signs: where they come from, and that they are right.

use super::signs::{Adaptive, Robust, Signs};
use super::*;
use crate::numerics::testing::{
    FAMILIES, Family, Random, in_ball_oracle, orientation_oracle, points, references,
};
use crate::options::Options;
use crate::{Mesh, NONE};
use std::cmp::Ordering;

fn meshed<const D: usize>(count: usize, family: Family) -> Mesh {
    let points = points::<D>(family, count, &mut Random(D as u64));
    let mut mesh = Mesh::new(D, count, points.as_flattened(), 0).unwrap();
    let options = Options { algorithm: Algorithm::Delaunay, ..Options::default() };
    mesh.run(&options, None).unwrap();
    mesh
}

/// Calls of the package, and how many of them it answered.
#[derive(Default)]
struct Counted {
    orientations: u64,
    in_balls: u64,
    answered: u64,
}

impl Adaptive for Counted {
    fn orientation<const D: usize>(&mut self, simplex: &[&[f64; D]]) -> Option<Ordering> {
        self.orientations += 1;
        Robust.orientation(simplex).inspect(|_| self.answered += 1)
    }

    fn in_ball<const D: usize>(&mut self, simplex: &[&[f64; D]], q: &[f64; D]) -> Option<Ordering> {
        self.in_balls += 1;
        Robust.in_ball(simplex, q).inspect(|_| self.answered += 1)
    }
}

/// Holds that the package gives one orientation a simplex and more for the winding, and one in-ball
/// sign an interior facet. In three dimensions some of the latter come from intervals and integers.
fn signs_come_from_the_package<const D: usize>(family: Family) {
    let mesh = meshed::<D>(120, family);
    let view = View::<D> { mesh: mesh.triangulation().unwrap() };
    let (mut signs, mut findings) = (Signs::<Counted>::default(), Findings::default());
    check_geometry(view, std::slice::from_mut(&mut signs), &mut findings).unwrap();
    assert!(findings.clean());
    let interior = view.mesh.neighbors.iter().filter(|&&n| n != NONE).count() / 2;
    let asked = &signs.adaptive;
    assert_eq!(asked.in_balls, interior as u64);
    assert!(asked.orientations > view.simplex_count() as u64);
    let others = signs.by_intervals + signs.by_integers;
    assert_eq!(asked.answered, asked.in_balls + asked.orientations - others);
    assert_eq!(signs.by_expansions, asked.answered);
    assert!(if D == 2 { others == 0 } else { others < asked.in_balls }, "{others}");
}

#[test]
fn signs_in_two_and_three_dimensions_come_from_the_package() {
    for family in [Family::Uniform, Family::FarCluster, Family::OneUlp] {
        signs_come_from_the_package::<2>(family);
        signs_come_from_the_package::<3>(family);
    }
}

/// Whose every sign is wrong.
#[derive(Default)]
struct Reversed;

impl Adaptive for Reversed {
    fn orientation<const D: usize>(&mut self, simplex: &[&[f64; D]]) -> Option<Ordering> {
        Robust.orientation(simplex)
    }

    fn in_ball<const D: usize>(&mut self, simplex: &[&[f64; D]], q: &[f64; D]) -> Option<Ordering> {
        Robust.in_ball(simplex, q).map(Ordering::reverse)
    }
}

/// Holds that the certificate believes the package and nothing else: if that is wrong, so is the
/// certificate.
#[test]
fn a_wrong_package_makes_a_wrong_certificate() {
    let mesh = meshed::<2>(60, Family::Uniform);
    let view = View::<2> { mesh: mesh.triangulation().unwrap() };
    let (mut signs, mut findings) = (Signs::<Reversed>::default(), Findings::default());
    check_geometry(view, std::slice::from_mut(&mut signs), &mut findings).unwrap();
    let interior = view.mesh.neighbors.iter().filter(|&&n| n != NONE).count() / 2;
    assert_eq!(findings.violations, interior as u64);
    assert_eq!(findings.first.unwrap().kind, ViolationKind::Delaunay);
}

/// Source of signs that has none, so that intervals and integers are tested in all dimensions.
#[derive(Debug, Default)]
struct Absent;

impl Adaptive for Absent {
    fn orientation<const D: usize>(&mut self, _: &[&[f64; D]]) -> Option<Ordering> {
        None
    }

    fn in_ball<const D: usize>(&mut self, _: &[&[f64; D]], _: &[f64; D]) -> Option<Ordering> {
        None
    }
}

fn signs_agree<const D: usize>(trials: usize) {
    let (mut usual, mut other) = (Signs::<Robust>::default(), Signs::<Absent>::default());
    for family in FAMILIES {
        let mut random = Random(family as u64 * 100 + 60 + D as u64);
        for _ in 0..trials {
            let points = points::<D>(family, D + 2, &mut random);
            let (simplex, q) = (references(&points[..=D]), &points[D + 1]);
            let orientation = (orientation_oracle(&simplex) as i8).cmp(&0);
            let side = (in_ball_oracle(&simplex, q) as i8).cmp(&0);
            assert_eq!(usual.orientation(&simplex), Ok(orientation), "{family:?} {points:?}");
            assert_eq!(other.orientation(&simplex), Ok(orientation), "{family:?} {points:?}");
            assert_eq!(usual.in_ball(&simplex, q), Ok(side), "{family:?} {points:?}");
            assert_eq!(other.in_ball(&simplex, q), Ok(side), "{family:?} {points:?}");
        }
    }
    assert_eq!(usual.by_expansions > 0, D <= 3);
    let all = 2 * (trials * FAMILIES.len()) as u64;
    assert!(other.by_integers > all / 10 && other.by_intervals > all / 10, "{other:?}");
}

#[test]
fn signs_agree_with_another_library() {
    signs_agree::<2>(600);
    signs_agree::<3>(300);
    signs_agree::<4>(60);
    signs_agree::<5>(20);
    signs_agree::<6>(8);
    signs_agree::<7>(3);
    signs_agree::<8>(2);
}

/// Lattices at both ends of the window, and a little beyond: the package answers within only.
fn signs_agree_at_the_window<const D: usize>() {
    for (exponent, answers) in [(-142, true), (-143, false), (198, true), (199, false)] {
        let unit = 2f64.powi(exponent);
        let mut random = Random(500 + D as u64);
        let mut signs = Signs::<Robust>::default();
        for trial in 0..400 {
            // Magnitudes from 1 to 8 units, some of them next to a lattice point.
            let mut coordinate = || {
                let x = random.integer(1, 8) as f64 * unit;
                let x = match random.integer(0, 5) {
                    0 if x > unit => x.next_down(),
                    1 if x < 8.0 * unit => x.next_up(),
                    _ => x,
                };
                if random.bits() % 2 == 0 { x } else { -x }
            };
            let mut points: Vec<[f64; D]> =
                (0..D + 2).map(|_| std::array::from_fn(|_| coordinate())).collect();
            (points[0], points[1]) = ([8.0 * unit; D], [unit; D]);
            let (simplex, q) = (references(&points[..=D]), &points[D + 1]);
            let orientation = (orientation_oracle(&simplex) as i8).cmp(&0);
            assert_eq!(signs.orientation(&simplex), Ok(orientation), "{trial} {points:?}");
            let side = (in_ball_oracle(&simplex, q) as i8).cmp(&0);
            assert_eq!(signs.in_ball(&simplex, q), Ok(side), "{trial} {points:?}");
        }
        // All that are asked for, but for points on spheres in space.
        let most = if answers { 800 } else { 0 };
        let least = if D == 2 { most } else { most * 3 / 4 };
        assert!((least..=most).contains(&signs.by_expansions), "2^{exponent}: {signs:?}");
    }
}

#[test]
fn signs_agree_at_both_ends_of_the_window() {
    signs_agree_at_the_window::<2>();
    signs_agree_at_the_window::<3>();
}
