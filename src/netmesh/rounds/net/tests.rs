//! The net's property against every ball there is, its size, its work.

use crate::netmesh::rounds::net::PointId;
use crate::netmesh::rounds::net::center::Center;
use crate::netmesh::rounds::net::greedy::Net;
use crate::netmesh::state::watch::Watch;
use crate::numerics::{Sign, affine_basis, in_ball, orientation};
use std::ops::Range;

/// Doubles in \[0, 1), always the same.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Kinds of point sets. The last four are degenerate.
const KINDS: [&str; 7] =
    ["uniform", "nested", "moment curve", "lattice", "sphere", "line", "hyperplane"];

/// Returns `count` distinct points of a kind, or a few less.
fn points<const D: usize>(kind: &str, count: usize) -> Vec<[f64; D]> {
    let mut random = Random(count as u64 + D as u64);
    let mut cube = |side: f64| -> [f64; D] { [0.0; D].map(|_| side * (random.unit() - 0.5)) };
    let mut points: Vec<[f64; D]> = Vec::new();
    for i in 0..count {
        let x = cube(1.0);
        let point = match kind {
            "uniform" => x,
            "nested" => x.map(|x| x * 0.5f64.powi(20 * (i % 4) as i32)),
            "moment curve" => std::array::from_fn(|k| ((i + 1) as f64).powi(k as i32 + 1)),
            "lattice" => x.map(|x| (x * (count as f64).powf(1.0 / D as f64) * 1.5).round()),
            // Signed permutations of a few vectors of the same integer length: exactly cospherical.
            "sphere" => {
                let mut vector = [0.0f64; D];
                (vector[i % D], vector[(i + 1) % D]) = [(7.0, 4.0), (8.0, 1.0)][i / D % 2];
                std::array::from_fn(|k| vector[k].copysign(x[k]))
            }
            "line" => std::array::from_fn(|k| (i * (k + 1)) as f64),
            _ => std::array::from_fn(|k| if k == 0 { 0.25 } else { x[k] }),
        };
        let point = point.map(|x| x + 0.0);
        if !points.contains(&point) {
            points.push(point);
        }
    }
    points
}

/// Returns a simplex whose circumball holds all of the points by far, with no corner among them.
fn surrounding<const D: usize>(points: &[[f64; D]]) -> Vec<[f64; D]> {
    let largest = points.iter().flatten().fold(1.0, |most: f64, x| most.max(x.abs()));
    let corner = |i: usize| -> [f64; D] {
        std::array::from_fn(|k| {
            largest
                * if i == D {
                    -7.3
                } else if k == i {
                    23.1
                } else {
                    -7.1
                }
        })
    };
    (0..=D).map(corner).collect()
}

fn net<const D: usize>(anchors: &[[f64; D]], points: &[[f64; D]], threshold: u32) -> Vec<usize> {
    let mut net = Net::new().unwrap();
    let chosen = net.choose(anchors, points, threshold, &mut Watch::new(None)).unwrap();
    chosen.iter().map(|i| i.index()).collect()
}

/// Calls `visit` with every set of `size` of the numbers below `count`, which is no smaller.
fn subsets(count: usize, size: usize, mut visit: impl FnMut(&[usize])) {
    let mut set: Vec<usize> = (0..size).collect();
    loop {
        visit(&set);
        let Some(at) = (0..size).rfind(|&at| set[at] < count - size + at) else { return };
        set[at] += 1;
        for next in at + 1..size {
            set[next] = set[next - 1] + 1;
        }
    }
}

/// Returns the largest number of points in an open ball or half-space with none of `empty`, over
/// all those that have D + 1 (half-spaces: D) of all the points on their boundary. Points on the
/// boundary that a small motion takes inside, while those of `empty` stay outside, count as inside.
fn fullest<const D: usize>(empty: &[[f64; D]], others: &[[f64; D]]) -> usize {
    let all: Vec<[f64; D]> = empty.iter().chain(others).copied().collect();
    let mut most = 0;
    let mut scan = |set: &[usize], side: &dyn Fn(&[f64; D]) -> Sign| {
        // Those of the set are on the boundary; only integers could tell that.
        let beside = |range: Range<usize>| range.filter(|i| !set.contains(i));
        let is_inside = |i: &usize| side(&all[*i]) == Sign::Positive;
        if beside(0..empty.len()).any(|i| is_inside(&i)) {
            return;
        }
        let inside = beside(empty.len()..all.len()).filter(is_inside).count();
        let more = set.iter().filter(|&&i| i >= empty.len()).count();
        let is_generic = || beside(0..all.len()).all(|i| side(&all[i]) != Sign::Zero);
        if inside + more > most && is_generic() {
            most = inside + more;
        }
        most = most.max(inside);
    };
    subsets(all.len(), D + 1, |set| {
        let mut corners: Vec<&[f64; D]> = set.iter().map(|&i| &all[i]).collect();
        match orientation(&corners) {
            Sign::Zero => return,
            Sign::Negative => corners.swap(0, 1),
            Sign::Positive => {}
        }
        scan(set, &|x| in_ball(&corners, x));
    });
    subsets(all.len(), D, |set| {
        let side = |x: &[f64; D]| {
            let corners: Vec<&[f64; D]> = set.iter().map(|&i| &all[i]).chain([x]).collect();
            orientation(&corners)
        };
        // A flat set has all points on its hyperplane and none inside.
        scan(set, &side);
        scan(set, &|x| side(x).flip());
    });
    most
}

/// Returns the threshold of `count` points for eps = 1/(2D), and others, down to 1.
fn thresholds<const D: usize>(count: usize) -> [u32; 5] {
    [count.div_ceil(2 * D), count.div_ceil(2), count.div_ceil(3), 2, 1].map(|t| t as u32)
}

fn check_property<const D: usize>(count: usize) {
    for kind in KINDS {
        let points = points::<D>(kind, count);
        let basis = affine_basis::<D>(points.len(), |i| points[i]);
        let (anchors, rest): (Vec<_>, Vec<_>) = match basis.len() == D + 1 {
            true => (
                basis.iter().map(|&i| points[i]).collect(),
                (0..points.len()).filter(|i| !basis.contains(i)).map(|i| points[i]).collect(),
            ),
            false => (surrounding(&points), points.clone()),
        };
        for (anchors, points) in [(surrounding(&points), &points), (anchors, &rest)] {
            for threshold in thresholds::<D>(points.len()) {
                let net = net(&anchors, points, threshold);
                let empty: Vec<_> =
                    anchors.iter().copied().chain(net.iter().map(|&i| points[i])).collect();
                let others: Vec<_> =
                    points.iter().copied().filter(|point| !empty.contains(point)).collect();
                assert_eq!(empty.len() + others.len(), anchors.len() + points.len(), "{kind}");
                let most = fullest(&empty, &others);
                assert!(
                    most < threshold as usize,
                    "{D}D {kind}: a ball with {most} of {} points, threshold {threshold}, net \
                     {net:?}",
                    points.len()
                );
            }
        }
    }
}

#[test]
fn every_full_ball_holds_a_point_of_the_net() {
    check_property::<2>(34);
    check_property::<3>(19);
    check_property::<4>(13);
}

/// Checks the list of the points in each D-ball, which its two parents tell.
fn check_lists<const D: usize>() {
    for kind in KINDS {
        let points = points::<D>(kind, 60);
        let mut net = Net::<D>::new().unwrap();
        net.choose(&surrounding(&points), &points, 5, &mut Watch::new(None)).unwrap();
        let mut listed = 0;
        for simplex in net.delaunay.complex().simplices() {
            if net.delaunay.complex().is_live(simplex) {
                let holds = |&i: &PointId| net.delaunay.in_conflict(simplex, &points[i]);
                let inside: Vec<_> = PointId::below(points.len()).filter(holds).collect();
                assert_eq!(net.inside[simplex], inside, "{D}D {kind}");
                listed += inside.len();
            }
        }
        assert!(listed > 0, "{D}D {kind}: no D-ball holds a point");
    }
}

#[test]
fn the_points_in_each_d_ball_are_known() {
    check_lists::<2>();
    check_lists::<3>();
    check_lists::<4>();
}

/// Checks the sizes of nets for eps = 1/(2D), which do not grow with the number of points.
fn check_size<const D: usize>(counts: [usize; 2], most: usize) {
    for kind in ["uniform", "nested", "moment curve", "line", "hyperplane"] {
        for count in counts {
            let points = points::<D>(kind, count);
            let size =
                net(&surrounding(&points), &points, points.len().div_ceil(2 * D) as u32).len();
            assert!(size >= 2 * D - 1 && size <= most, "{D}D {kind} {count}: {size} points");
        }
    }
}

#[test]
fn nets_are_small_whatever_the_number_of_points() {
    check_size::<2>([300, 3000], 20);
    check_size::<3>([300, 3000], 70);
    check_size::<4>([300, 2000], 180);
}

#[test]
fn the_work_is_linear() {
    let tests = |count: usize| {
        let points = points::<3>("uniform", count);
        let mut net = Net::new().unwrap();
        let threshold = count.div_ceil(6) as u32;
        net.choose(&surrounding(&points), &points, threshold, &mut Watch::new(None)).unwrap();
        net.tests() as f64 / count as f64
    };
    let tests = [500, 1000, 2000, 4000].map(tests);
    for pair in tests.windows(2) {
        assert!(pair[1] < 1.3 * pair[0], "tests per point for doubled numbers: {tests:?}");
    }
    assert!(tests[3] < 1500.0, "tests per point: {tests:?}");
}

#[test]
fn a_net_does_not_depend_on_those_before() {
    let (a, b) = (points::<3>("uniform", 200), points::<3>("nested", 90));
    let mut one = Net::new().unwrap();
    let mut choose = |points: &[[f64; 3]]| {
        let chosen = one.choose(&surrounding(points), points, 15, &mut Watch::new(None)).unwrap();
        chosen.iter().map(|i| i.index()).collect::<Vec<_>>()
    };
    for points in [&a, &b, &a] {
        assert_eq!(choose(points), net(&surrounding(points), points, 15));
    }
}

/// Checks that every ball with more than 1 - 2^-(D+1) of the points has one of X: a ball that is
/// empty of X misses at least 2^-(D+1) of the points.
fn check_center<const D: usize>(count: usize) {
    for kind in KINDS {
        let points = points::<D>(kind, count);
        let members: Vec<_> = PointId::below(points.len()).collect();
        let mut center = Center::<D>::default();
        let support = center.support(&points, &members).unwrap().to_vec();
        assert!(!support.is_empty() && support.len() <= 2 << D, "{D}D {kind}: {support:?}");
        let (empty, others): (Vec<_>, Vec<_>) = members.iter().partition(|i| support.contains(i));
        assert_eq!(empty.len(), support.len(), "{D}D {kind}: {support:?}");
        let of = |ids: &[PointId]| ids.iter().map(|&i| points[i]).collect::<Vec<_>>();
        let most = fullest(&of(&empty), &of(&others));
        let missed = points.len() - most;
        assert!(
            missed << (D + 1) >= points.len(),
            "{D}D {kind}: a ball has all but {missed} of {} points and none of {support:?}",
            points.len()
        );
    }
}

#[test]
fn a_ball_with_nearly_all_points_holds_a_central_one() {
    check_center::<2>(40);
    check_center::<3>(22);
}
