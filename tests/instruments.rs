//! Figures of `nm_stats` against those that brute force finds in a mesh's arrays.

use crate::random::Random;
use netmesh::numerics::{Sign, distance, in_ball};
use netmesh::{
    Algorithm, Criterion, Mesh, NONE, NetOrdering, Options, Output, Stats, Triangulation,
    VertexKind,
};

fn uniform(dim: usize, n: usize) -> Vec<f64> {
    Random::new(dim as u64).uniform(dim, n)
}

/// Clusters inside each other, each 2^-20 of the one around it.
fn nested(dim: usize, n: usize) -> Vec<f64> {
    let mut random = Random::new(10 + dim as u64);
    (0..n)
        .flat_map(|i| {
            let scale = 0.5f64.powi(20 * (i % 3) as i32);
            (0..dim).map(|_| scale * (random.unit() - 0.5)).collect::<Vec<_>>()
        })
        .collect()
}

/// Pairs of points 2^-30 apart.
fn pairs(dim: usize, n: usize) -> Vec<f64> {
    let firsts = uniform(dim, n / 2);
    let mut random = Random::new(77);
    let second = |x: &f64| x + 0.5f64.powi(30) * (random.unit() - 0.5);
    let seconds: Vec<f64> = firsts.iter().map(second).collect();
    [firsts, seconds].concat()
}

/// A cubic lattice of `side`^`dim` points.
fn lattice(dim: usize, side: usize) -> Vec<f64> {
    (0..side.pow(dim as u32))
        .flat_map(|i| (0..dim).map(move |axis| (i / side.pow(axis as u32) % side) as f64))
        .collect()
}

fn run(dim: usize, points: &[f64], options: &Options) -> Triangulation {
    let mut mesh = Mesh::new(dim, points.len() / dim, points, 0).unwrap();
    mesh.run(options, None).unwrap();
    mesh.triangulation().unwrap().clone()
}

fn with_instruments() -> Options {
    Options { instruments: true, ..Options::default() }
}

fn point<const D: usize>(mesh: &Triangulation, vertex: u32) -> &[f64; D] {
    mesh.point(vertex).try_into().unwrap()
}

fn points_of<const D: usize>(mesh: &Triangulation, simplex: usize) -> Vec<&[f64; D]> {
    mesh.simplex(simplex).iter().map(|&v| point(mesh, v)).collect()
}

/// The circumcentre relative to the first vertex, by elimination with pivots.
fn center<const D: usize>(vertices: &[&[f64; D]]) -> [f64; D] {
    let mut rows: Vec<Vec<f64>> = (1..=D)
        .map(|i| {
            let edge: Vec<f64> = (0..D).map(|axis| vertices[i][axis] - vertices[0][axis]).collect();
            let half = 0.5 * edge.iter().map(|x| x * x).sum::<f64>();
            [edge, vec![half]].concat()
        })
        .collect();
    for column in 0..D {
        let pivot = (column..D)
            .max_by(|&a, &b| rows[a][column].abs().total_cmp(&rows[b][column].abs()))
            .unwrap();
        rows.swap(column, pivot);
        for other in (0..D).filter(|&other| other != column) {
            let factor = rows[other][column] / rows[column][column];
            let own = rows[column].clone();
            for (x, subtracted) in rows[other].iter_mut().zip(&own) {
                *x -= factor * subtracted;
            }
        }
    }
    std::array::from_fn(|axis| rows[axis][D] / rows[axis][axis])
}

/// The largest number of D-balls with one Voronoi corner strictly inside, and their sum and number.
/// Corners are computed here, so those of nearly flat simplices differ from the library's in their
/// last bits: nothing but a point that is nearly on a sphere may tell them apart.
fn plies<const D: usize>(mesh: &Triangulation) -> (u64, u64, u64) {
    let count = mesh.simplex_count();
    let all: Vec<_> = (0..count).map(|simplex| points_of::<D>(mesh, simplex)).collect();
    let (mut max, mut sum, mut probes) = (0, 0, 0);
    for own in &all {
        let offset = center(own);
        let probe: [f64; D] = std::array::from_fn(|axis| own[0][axis] + offset[axis]);
        if in_ball(own, &probe) == Sign::Positive {
            let ply = all.iter().filter(|ball| in_ball(ball, &probe) == Sign::Positive).count();
            max = max.max(ply as u64);
            sum += ply as u64;
            probes += 1;
        }
    }
    (max, sum, probes)
}

fn check_ply<const D: usize>(name: &str, points: &[f64], options: &Options) {
    let mesh = run(D, points, options);
    let (max, sum, probes) = plies::<D>(&mesh);
    let stats = &mesh.stats;
    let found = (stats.max_ply, (stats.mean_ply * stats.ply_probes as f64).round() as u64);
    assert!(probes > 10, "{name}");
    assert_eq!((stats.ply_probes, found), (probes, (max, sum)), "{name} {D}D");
}

#[test]
fn the_ply_is_that_of_all_balls() {
    check_ply::<2>("uniform", &uniform(2, 120), &with_instruments());
    check_ply::<3>("uniform", &uniform(3, 40), &with_instruments());
    check_ply::<4>("uniform", &uniform(4, 10), &with_instruments());
    check_ply::<2>("nested", &nested(2, 44), &with_instruments());
    check_ply::<3>("nested", &nested(3, 15), &with_instruments());
    // Corners beyond the hull, and corners on spheres.
    let plain = Options { algorithm: Algorithm::Delaunay, ..with_instruments() };
    check_ply::<2>("plain", &uniform(2, 300), &plain);
    check_ply::<3>("plain", &uniform(3, 80), &plain);
    check_ply::<4>("plain", &uniform(4, 30), &plain);
    check_ply::<2>("lattice", &lattice(2, 9), &plain);
    check_ply::<3>("lattice", &lattice(3, 4), &plain);
}

/// For each D-ball the number of others that meet it; `slack` widens or narrows what meets.
fn meetings<const D: usize>(mesh: &Triangulation, slack: f64) -> Vec<u64> {
    let balls: Vec<(&[f64; D], [f64; D], f64)> = (0..mesh.simplex_count())
        .map(|simplex| {
            let vertices = points_of::<D>(mesh, simplex);
            let offset = center(&vertices);
            (vertices[0], offset, distance(&offset, &[0.0; D]))
        })
        .collect();
    let meet = |a: usize, b: usize| {
        let ((p, from, r), (q, to, s)) = (balls[a], balls[b]);
        let gap: [f64; D] = std::array::from_fn(|i| (p[i] - q[i]) + (from[i] - to[i]));
        distance(&gap, &[0.0; D]) < (r + s) * (1.0 + slack)
    };
    (0..balls.len())
        .map(|a| (0..balls.len()).filter(|&b| b != a && meet(a, b)).count() as u64)
        .collect()
}

fn check_meetings<const D: usize>(name: &str, points: &[f64], options: &Options) {
    let mesh = run(D, points, options);
    assert!((20..=2000).contains(&mesh.simplex_count()), "{name}: {}", mesh.simplex_count());
    // Balls that touch may be counted or not; there are hardly any.
    let [low, high] = [-1e-9, 1e-9].map(|slack| meetings::<D>(&mesh, slack));
    let [least, most] = [&low, &high].map(|counts| counts.iter().sum::<u64>() as f64);
    assert!(most - least <= 1e-3 * most, "{name} {D}D");
    let sum = mesh.stats.mean_ball_intersections * low.len() as f64;
    assert!((least - 0.5..=most + 0.5).contains(&sum), "{name} {D}D: {least} {sum} {most}");
    let max = mesh.stats.max_ball_intersections;
    assert!(low.iter().max() <= Some(&max) && Some(&max) <= high.iter().max(), "{name} {D}D");
}

#[test]
fn intersections_are_those_of_all_pairs_of_balls() {
    check_meetings::<2>("uniform", &uniform(2, 120), &with_instruments());
    check_meetings::<3>("uniform", &uniform(3, 20), &with_instruments());
    check_meetings::<4>("uniform", &uniform(4, 6), &with_instruments());
    check_meetings::<2>("nested", &nested(2, 44), &with_instruments());
    // Many balls meet beyond the hull only.
    let plain = Options { algorithm: Algorithm::Delaunay, ..with_instruments() };
    check_meetings::<2>("plain", &uniform(2, 100), &plain);
    check_meetings::<3>("plain", &uniform(3, 50), &plain);
    check_meetings::<4>("plain", &uniform(4, 20), &plain);
}

/// M_Omega (Definition 3): the vertices whose innermost domain is `omega`, and its children's
/// centres.
fn members(mesh: &Triangulation, omega: u32) -> Vec<u32> {
    let own = (0..mesh.vertex_count() as u32).filter(|&v| mesh.vertex_domains[v as usize] == omega);
    let children = mesh.domains.iter().filter(|domain| domain.parent == omega);
    own.chain(children.map(|child| child.center)).collect()
}

/// The distance to the second nearest of `set` from `vertex` (Definition 5).
fn feature_size<const D: usize>(mesh: &Triangulation, set: &[u32], vertex: u32) -> Option<f64> {
    let gap = |&other: &u32| distance(point::<D>(mesh, vertex), point(mesh, other));
    let mut gaps: Vec<f64> = set.iter().map(gap).collect();
    gaps.sort_by(f64::total_cmp);
    gaps.get(1).copied()
}

/// The largest f_P / f_M, and the number of domains where there is one.
fn feature_size_constant<const D: usize>(mesh: &Triangulation) -> (f64, usize) {
    let (mut largest, mut domains) = (0.0f64, 0);
    for omega in 0..mesh.domains.len() as u32 {
        let all = members(mesh, omega);
        let is_input = |v: &u32| mesh.kinds[*v as usize] == VertexKind::Input;
        let inputs: Vec<u32> = all.iter().copied().filter(is_input).collect();
        domains += usize::from(inputs.len() > 1);
        for &v in &all {
            let of_mesh = feature_size::<D>(mesh, &all, v);
            let of_inputs = feature_size::<D>(mesh, &inputs, v);
            if let (Some(of_inputs), Some(of_mesh)) = (of_inputs, of_mesh) {
                largest = largest.max(of_inputs / of_mesh);
            }
        }
    }
    (largest, domains)
}

fn check_features<const D: usize>(name: &str, points: &[f64], options: &Options, domains: usize) {
    let mesh = run(D, points, options);
    let (largest, measured) = feature_size_constant::<D>(&mesh);
    assert!(measured >= domains, "{name} {D}D: {measured} domains");
    assert_eq!(mesh.stats.feature_size_constant, largest, "{name} {D}D");
}

#[test]
fn the_feature_size_constant_is_that_of_all_vertices() {
    check_features::<2>("uniform", &uniform(2, 700), &with_instruments(), 5);
    check_features::<3>("uniform", &uniform(3, 500), &with_instruments(), 1);
    check_features::<4>("uniform", &uniform(4, 200), &with_instruments(), 1);
    check_features::<2>("nested", &nested(2, 300), &with_instruments(), 5);
    check_features::<3>("nested", &nested(3, 150), &with_instruments(), 3);
    check_features::<4>("nested", &nested(4, 60), &with_instruments(), 3);
    check_features::<2>("pairs", &pairs(2, 600), &with_instruments(), 200);
    check_features::<3>("pairs", &pairs(3, 200), &with_instruments(), 50);
    check_features::<4>("pairs", &pairs(4, 60), &with_instruments(), 10);
    let finished = Options { output: Output::WellSpaced, ..with_instruments() };
    check_features::<2>("finished", &nested(2, 100), &finished, 1);
    let sparse = Options { algorithm: Algorithm::Svr, ..with_instruments() };
    check_features::<3>("sparse", &uniform(3, 200), &sparse, 1);
}

/// Runs of all kinds.
fn kinds_of_runs() -> Vec<Options> {
    let default = Options::default;
    vec![
        default(),
        Options { output: Output::WellSpaced, ..default() },
        Options { criterion: Criterion::RadiusEdge, ..default() },
        Options { ordering: NetOrdering::DeterministicNet, ..default() },
        Options { algorithm: Algorithm::Svr, ..default() },
        Options { algorithm: Algorithm::Delaunay, ..default() },
    ]
}

#[test]
fn every_vertex_is_counted_by_its_kind() {
    let inputs = [
        (2, uniform(2, 600)),
        (2, nested(2, 300)),
        (2, pairs(2, 100)),
        (3, uniform(3, 200)),
        (3, nested(3, 60)),
        (3, pairs(3, 16)),
        (4, uniform(4, 100)),
    ];
    for options in kinds_of_runs() {
        let mut yields = 0;
        for (dim, points) in &inputs {
            let mesh = run(*dim, points, &options);
            let stats = &mesh.stats;
            let condition = format!("{dim}D {options:?} {stats:?}");
            let points = stats.cage_points + stats.far_corners + stats.off_centers;
            let vertices = mesh.vertex_count() as u64;
            assert_eq!(stats.input_vertices + points, vertices, "{condition}");
            let in_cages = mesh.cage_of.iter().filter(|&&cage| cage != NONE).count() as u64;
            assert!(stats.cage_points + stats.yields >= in_cages, "{condition}");
            // Without inputs in their way all cages ever made would have this many vertices.
            // The root's stand first; those in cage gaps are the last.
            let after_inputs = mesh.cage_of.iter().skip(stats.input_vertices as usize);
            let template = after_inputs.take_while(|&&cage| cage == 0).count() as u64;
            let made = stats.cages_created * template + stats.closing_points;
            assert!((made.saturating_sub(stats.yields)..=made).contains(&stats.cage_points));
            let refines = options.algorithm != Algorithm::Delaunay;
            assert_eq!(points > 0, refines, "{condition}");
            yields += stats.yields;
        }
        assert_eq!(yields > 0, options.algorithm != Algorithm::Delaunay, "{options:?}");
    }
}

#[test]
fn rounds_halve_the_longest_list() {
    for options in kinds_of_runs() {
        let stats = run(2, &uniform(2, 3000), &options).stats;
        if options.algorithm == Algorithm::Svr {
            assert_eq!((stats.rounds, stats.passes, stats.worst_halving), (0, 0, 0.0));
            continue;
        }
        assert!(stats.rounds > 1 && stats.passes >= stats.rounds, "{stats:?}");
        // The plain triangulation of the plane has no lists.
        let has_lists = options.algorithm != Algorithm::Delaunay;
        assert_eq!(has_lists, (0.01..=0.5).contains(&stats.worst_halving), "{stats:?}");
        assert!(has_lists || stats.worst_halving == 0.0, "{stats:?}");
    }
}

/// Without the clock.
fn timeless(stats: &Stats) -> Stats {
    Stats { seconds: 0.0, ..stats.clone() }
}

/// The counters, without what the instruments measure.
fn counters(stats: &Stats) -> Stats {
    Stats {
        ply_probes: 0,
        max_ply: 0,
        mean_ply: 0.0,
        max_ball_intersections: 0,
        mean_ball_intersections: 0.0,
        feature_size_constant: 0.0,
        insertion_constant_input: 0.0,
        insertion_constant_corner: 0.0,
        insertion_constant_cage: 0.0,
        ..timeless(stats)
    }
}

#[test]
fn instruments_change_nothing_and_stay_off_unless_asked_for() {
    for options in kinds_of_runs() {
        for (dim, points) in [(2, nested(2, 60)), (2, pairs(2, 60)), (3, uniform(3, 120))] {
            let off = run(dim, &points, &options);
            let on = run(dim, &points, &Options { instruments: true, ..options.clone() });
            let again = run(dim, &points, &Options { instruments: true, ..options.clone() });
            assert_eq!(timeless(&on.stats), timeless(&again.stats));
            assert_eq!(counters(&off.stats), timeless(&off.stats), "measured without a wish");
            assert_eq!(counters(&off.stats), counters(&on.stats));
            assert!(off.points == on.points && off.simplices == on.simplices);
            assert!(off.cage_of == on.cage_of && off.domains == on.domains);
            let stats = &on.stats;
            assert!(stats.max_ply > 0 && stats.max_ball_intersections > 0);
            let constants = [
                stats.feature_size_constant,
                stats.insertion_constant_input,
                stats.insertion_constant_corner,
                stats.insertion_constant_cage,
            ];
            let plain = options.algorithm == Algorithm::Delaunay;
            assert!(constants.iter().all(|&k| (k == 0.0) == plain && k.is_finite()), "{stats:?}");
        }
    }
}

/// One of two inputs is at the centre of the outer cage; the other is located once, and goes in.
#[test]
fn the_first_location_of_an_input_is_a_touch() {
    let stats = run(2, &[0.0, 0.0, 1.0, 0.5], &Options::default()).stats;
    assert!(stats.touches >= 1 && stats.max_touches == stats.touches, "{stats:?}");
}
