//! Dihedral angles: none is smaller than asked for, the mesh is Delaunay and within its bound, and
//! every input is where it was.

use crate::random::Random;
use netmesh::numerics::SplitMix;
use netmesh::quality::measure;
use netmesh::validate::validate;
use netmesh::{Criterion, ErrorKind, GivesWay, Mesh, NONE, Options, Output, Phase, Triangulation};

fn options(min_dihedral: f64) -> Options {
    Options {
        criterion: Criterion::RadiusEdge,
        output: Output::WellSpaced,
        min_dihedral,
        ..Options::default()
    }
}

fn run(points: &[f64], options: &Options) -> Mesh {
    let mut mesh = Mesh::new(3, points.len() / 3, points, 0).unwrap();
    mesh.run(options, None).unwrap();
    let result = mesh.triangulation().unwrap();
    let report = validate(mesh.inputs(), result, 3).unwrap();
    assert_eq!(report.violations, 0, "{report:?}");
    mesh
}

/// Returns the least dihedral angle of a simplex, in degrees: that between the heights over an
/// edge.
pub fn least_dihedral(mesh: &Triangulation, simplex: usize) -> f64 {
    let point = |i: usize| <[f64; 3]>::try_from(mesh.point(mesh.simplex(simplex)[i])).unwrap();
    let minus = |a: [f64; 3], b: [f64; 3]| -> [f64; 3] { std::array::from_fn(|k| a[k] - b[k]) };
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let mut least = f64::INFINITY;
    for (i, j, k, l) in
        [(0, 1, 2, 3), (0, 2, 1, 3), (0, 3, 1, 2), (1, 2, 0, 3), (1, 3, 0, 2), (2, 3, 0, 1)]
    {
        let edge = minus(point(j), point(i));
        let height = |at: usize| -> [f64; 3] {
            let to = minus(point(at), point(i));
            let along = dot(to, edge) / dot(edge, edge);
            std::array::from_fn(|axis| to[axis] - along * edge[axis])
        };
        let (a, b) = (height(k), height(l));
        let cross =
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        least = least.min(dot(cross, cross).sqrt().atan2(dot(a, b)).to_degrees());
    }
    least
}

/// The number of simplices with a smaller angle: of one domain, and of several.
fn below(mesh: &Triangulation, degrees: f64) -> [u64; 2] {
    let mut counts = [0; 2];
    for simplex in 0..mesh.simplex_count() {
        if least_dihedral(mesh, simplex) < degrees {
            let vertices = mesh.simplex(simplex);
            let domain = |vertex: &u32| mesh.vertex_domains[*vertex as usize];
            let of_one = vertices.iter().all(|vertex| domain(vertex) == domain(&vertices[0]));
            counts[usize::from(!of_one)] += 1;
        }
    }
    counts
}

fn gaussian(n: usize) -> Vec<f64> {
    let mut random = Random::new(3);
    (0..3 * n).map(|_| (0..12).map(|_| random.unit()).sum::<f64>() - 6.0).collect()
}

fn sphere(n: usize) -> Vec<f64> {
    let point = |x: &[f64]| {
        let length = x.iter().map(|x| x * x).sum::<f64>().sqrt();
        x.iter().map(|x| x / length).collect::<Vec<_>>()
    };
    gaussian(n).chunks(3).flat_map(point).collect()
}

fn grid(side: usize, spread: f64) -> Vec<f64> {
    let mut random = Random::new(4);
    let coordinate = |i: usize| (i + 1) as f64 + spread * (random.unit() - 0.5);
    let all = (0..side.pow(3)).flat_map(|i| [i % side, i / side % side, i / side / side]);
    all.map(coordinate).collect()
}

fn lines(n: usize) -> Vec<f64> {
    let at = |i: usize| i as f64 / n as f64;
    (0..n).flat_map(|i| [at(i), 0.0, 0.0, 0.5, at(i) - 0.5, 1.0]).collect()
}

#[test]
fn no_angle_is_smaller_than_asked_for() {
    let uniform = Random::new(1).uniform(3, 2000);
    let clusters = Random::new(2).uniform(3, 500);
    let clusters: Vec<f64> =
        (0..3000).map(|i| clusters[i % 30] + 0.02 * clusters[i % 1500]).collect();
    // Factors that the angle costs in vertices, at most.
    let sets = [
        (uniform, 1.027),
        (gaussian(1500), 1.035),
        (clusters, 0.995),
        (sphere(800), 0.988),
        (grid(8, 0.0), 0.998),
        (grid(8, 1e-3), 1.19),
        (grid(8, 4.0 * f64::EPSILON), 1.16),
        (lines(200), 0.985),
    ];
    for (at, (points, most)) in sets.iter().enumerate() {
        let before = run(points, &options(0.0));
        let before = before.triangulation().unwrap();
        assert!(below(before, 15.0)[0] > 50, "set {at}");
        for (degrees, most) in [(15.0, *most), (18.0, most + 0.02)] {
            let mesh = run(points, &options(degrees));
            let mesh = mesh.triangulation().unwrap();
            assert_eq!(below(mesh, degrees), [0, 0], "set {at} at {degrees}");
            assert!(mesh.below_min_dihedral.is_empty());
            assert_eq!(measure(mesh).unwrap().below_min_dihedral, 0);
            let cost = mesh.vertex_count() as f64 / before.vertex_count() as f64;
            assert!(cost < most, "set {at} at {degrees}: {cost}");
        }
    }
}

/// The last sliver of these points, by SplitMix64, goes when a point comes and its neighbours move.
#[test]
fn the_last_sliver_takes_a_relaxation() {
    let mut words = SplitMix(1);
    let mut unit = || (words.next_word() >> 11) as f64 / (1u64 << 53) as f64;
    let points: Vec<f64> = (0..3 * 2000).map(|_| unit()).collect();
    let mesh = run(&points, &options(22.0));
    assert_eq!(below(mesh.triangulation().unwrap(), 22.0), [0, 0]);
}

/// The simplices beside cages stay, and are counted apart.
#[test]
fn in_domains_no_angle_is_smaller_but_those_counted() {
    let uniform = Random::new(5).uniform(3, 1500);
    let near = uniform.chunks(3).take(100).flat_map(|x| [x[0] + 1e-6, x[1], x[2]]);
    let pairs: Vec<f64> = uniform.iter().copied().chain(near).collect();
    for criterion in [Criterion::RadiusEdge, Criterion::VoronoiAspect] {
        let hierarchical = |min_dihedral| Options {
            output: Output::Hierarchical,
            criterion,
            ..options(min_dihedral)
        };
        let before = run(&pairs, &hierarchical(0.0));
        let [slivers, gaps] = below(before.triangulation().unwrap(), 12.0);
        let mesh = run(&pairs, &hierarchical(12.0));
        let mesh = mesh.triangulation().unwrap();
        let [left, gaps_left] = below(mesh, 12.0);
        assert!(gaps > 100 && 10 * left < slivers, "{left} of {slivers}");
        assert_eq!(gaps, gaps_left);
        let quality = measure(mesh).unwrap();
        let counts = [quality.below_min_dihedral, quality.below_min_dihedral_between_domains];
        assert_eq!(counts, [left, gaps_left]);
        assert_eq!(mesh.below_min_dihedral.len() as u64, left);
        let is_sliver = |&simplex: &u32| least_dihedral(mesh, simplex as usize) < 12.00001;
        assert!(mesh.below_min_dihedral.iter().all(is_sliver));
    }
}

/// The bound goes before the angle: here both cannot be had everywhere.
#[test]
fn voronoi_aspects_stay_within_their_bound() {
    let uniform = Random::new(6).uniform(3, 2000);
    let aspect = |min_dihedral| Options {
        criterion: Criterion::VoronoiAspect,
        quality_bound: 4.0,
        ..options(min_dihedral)
    };
    let before = below(run(&uniform, &aspect(0.0)).triangulation().unwrap(), 15.0)[0];
    let mesh = run(&uniform, &aspect(15.0));
    let mesh = mesh.triangulation().unwrap();
    let left = below(mesh, 15.0)[0];
    assert!(before > 1000 && left < before / 100, "{left} of {before}");
    assert_eq!(mesh.below_min_dihedral.len() as u64, left);
    assert!(measure(mesh).unwrap().worst_aspect_anywhere <= 4.0 * (1.0 + 1e-9));
}

/// The largest Voronoi aspect of the cell of a vertex off the hull.
fn aspect(mesh: &Triangulation, vertex: u32) -> f64 {
    let point = |v: u32| <[f64; 3]>::try_from(mesh.point(v)).unwrap();
    let distance =
        |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt();
    let (mut nearest, mut farthest) = (f64::INFINITY, 0.0f64);
    for simplex in 0..mesh.simplex_count() {
        let vertices = mesh.simplex(simplex);
        if vertices.contains(&vertex) {
            let others = vertices.iter().filter(|&&other| other != vertex);
            let distances = others.map(|&other| distance(point(vertex), point(other)));
            nearest = distances.fold(nearest, f64::min);
            farthest = farthest.max(radius(mesh, simplex));
        }
    }
    2.0 * farthest / nearest
}

/// The circumradius, by the products of opposite edges.
fn radius(mesh: &Triangulation, simplex: usize) -> f64 {
    let point = |i: usize| <[f64; 3]>::try_from(mesh.point(mesh.simplex(simplex)[i])).unwrap();
    let edge = |i, j| -> [f64; 3] { std::array::from_fn(|k| point(j)[k] - point(i)[k]) };
    let length = |i, j| edge(i, j).iter().map(|x| x * x).sum::<f64>().sqrt();
    let [a, b, c] =
        [length(0, 1) * length(2, 3), length(0, 2) * length(1, 3), length(0, 3) * length(1, 2)];
    let [x, y, z] = [edge(0, 1), edge(0, 2), edge(0, 3)];
    let volume = x[0] * (y[1] * z[2] - y[2] * z[1]) - x[1] * (y[0] * z[2] - y[2] * z[0])
        + x[2] * (y[0] * z[1] - y[1] * z[0]);
    let product = (a + b + c) * (a + b - c) * (a - b + c) * (b + c - a);
    product.sqrt() / (4.0 * volume.abs())
}

/// No simplex stays below the angle if the bound gives way. What is marked is beyond the bound,
/// and nothing else is.
#[test]
fn the_bound_gives_way_where_the_caller_says_so() {
    let points = grid(5, 1e-3);
    let of = |gives_way| Options {
        criterion: Criterion::VoronoiAspect,
        quality_bound: 4.0,
        gives_way,
        ..options(15.0)
    };
    let angle = run(&points, &of(GivesWay::Angle));
    let inputs = angle.inputs();
    let angle = angle.triangulation().unwrap();
    assert!(below(angle, 15.0)[0] > 0 && angle.beyond_bound.is_empty());
    assert_eq!(measure(angle).unwrap().beyond_bound, 0);
    let mesh = run(&points, &of(GivesWay::Bound));
    let made = mesh.triangulation().unwrap();
    assert_eq!(below(made, 15.0), [0, 0]);
    let is_beyond = |&id: &u32| made.cage_of[id as usize] == NONE && aspect(made, id) > 4.0;
    let beyond: Vec<u32> = (0..made.vertex_count() as u32).filter(is_beyond).collect();
    assert!(!beyond.is_empty());
    assert_eq!(made.beyond_bound, beyond);
    assert_eq!(measure(made).unwrap().beyond_bound as usize, beyond.len());
    // The certificate knows them by their marks alone, and only where they may be.
    let violations = |mesh: &Triangulation| validate(inputs, mesh, 3).unwrap().violations;
    let mut unmarked = made.clone();
    unmarked.beyond_bound.remove(0);
    assert_eq!(violations(&unmarked), 1);
    let mut unasked = made.clone();
    unasked.parameters.gives_way = GivesWay::Angle;
    assert_eq!(violations(&unasked), beyond.len() as u64);
}

/// Simplices beyond the bound need their marks for the certificate, too.
#[test]
fn simplices_beyond_the_bound_need_their_marks() {
    let uniform = Random::new(9).uniform(3, 300);
    let bound = Options { gives_way: GivesWay::Bound, ..options(15.0) };
    let mesh = run(&uniform, &bound);
    let mut tight = mesh.triangulation().unwrap().clone();
    tight.parameters.quality_bound = 1.6;
    let length = |a: u32, b: u32| {
        let pairs = tight.point(a).iter().zip(tight.point(b));
        pairs.map(|(x, y)| (x - y).powi(2)).sum::<f64>().sqrt()
    };
    let is_beyond = |&simplex: &u32| {
        let vertices = tight.simplex(simplex as usize);
        let edges = (0..4).flat_map(|i| (0..i).map(move |j| (vertices[i], vertices[j])));
        let shortest = edges.map(|(a, b)| length(a, b)).fold(f64::INFINITY, f64::min);
        radius(&tight, simplex as usize) > 1.6 * shortest
    };
    let beyond: Vec<u32> = (0..tight.simplex_count() as u32).filter(is_beyond).collect();
    assert!(beyond.len() > 50);
    tight.beyond_bound = beyond[1..].to_vec();
    assert_eq!(validate(mesh.inputs(), &tight, 3).unwrap().violations, 1);
    tight.beyond_bound = beyond.clone();
    assert_eq!(validate(mesh.inputs(), &tight, 3).unwrap().violations, 0);
    tight.parameters.min_dihedral = 0.0;
    assert_eq!(validate(mesh.inputs(), &tight, 3).unwrap().violations, beyond.len() as u64);
}

#[test]
fn angles_are_had_at_every_scale() {
    let uniform = Random::new(7).uniform(3, 300);
    let vertices = |exponent: i32| {
        let points: Vec<f64> = uniform.iter().map(|x| x * 2f64.powi(exponent)).collect();
        let mesh = run(&points, &options(15.0));
        let mesh = mesh.triangulation().unwrap();
        assert_eq!(measure(mesh).unwrap().below_min_dihedral, 0, "2^{exponent}");
        assert!(mesh.below_min_dihedral.is_empty());
        mesh.vertex_count() as f64
    };
    let ordinary = vertices(0);
    for exponent in [-900, -300, 300, 900] {
        let ratio = vertices(exponent) / ordinary;
        assert!((0.95..1.05).contains(&ratio), "2^{exponent}: {ratio}");
    }
}

#[test]
fn other_dimensions_and_larger_angles_are_refused() {
    for (dim, angle, words) in [
        (2, 5.0, "options.min_dihedral is 5; it must be 0 in 2D"),
        (4, 5.0, "options.min_dihedral is 5; it must be 0 in 4D"),
        (3, 22.5, "options.min_dihedral is 22.5; it must be 0 (default 0) or in [0, 22]"),
        (3, -1.0, "options.min_dihedral is -1;"),
        (3, f64::NAN, "options.min_dihedral is NaN;"),
    ] {
        let mut mesh = Mesh::new(dim, 6, &Random::new(1).uniform(dim, 6), 0).unwrap();
        let error = mesh.run(&options(angle), None).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::InvalidArgument);
        assert!(error.to_string().contains(words), "{error}");
    }
    let mut mesh = Mesh::new(3, 6, &Random::new(1).uniform(3, 6), 0).unwrap();
    let both = Options { distance_ratio: 0.5, ..options(5.0) };
    let error = mesh.run(&both, None).unwrap_err();
    assert!(error.to_string().contains("min_dihedral is 5; it must be 0 with"), "{error}");
}

#[test]
fn the_phase_is_cancelled_and_limited_as_others_are() {
    let uniform = Random::new(8).uniform(3, 3000);
    let mut mesh = Mesh::new(3, 3000, &uniform, 0).unwrap();
    let mut fractions = Vec::new();
    mesh.run(
        &options(18.0),
        Some(&mut |progress| {
            fractions.push((progress.phase, progress.fraction));
            true
        }),
    )
    .unwrap();
    assert!(fractions.is_sorted_by_key(|&(_, fraction)| fraction));
    // The phase begins at 0.4.
    let during = |&&(phase, fraction): &&(Phase, f64)| {
        phase == Phase::Finish && (0.4001..0.9999).contains(&fraction)
    };
    assert!(fractions.iter().filter(during).count() > 0, "{fractions:?}");
    let count = mesh.triangulation().unwrap().vertex_count() as u64;
    let without = run(&uniform, &options(0.0)).triangulation().unwrap().vertex_count() as u64;
    let mut other = Mesh::new(3, 3000, &uniform, 0).unwrap();
    for most in [0.4001, 0.6, 0.9] {
        let error = other.run(&options(18.0), Some(&mut |progress| progress.fraction < most));
        assert_eq!(error.unwrap_err().kind(), ErrorKind::Cancelled);
        assert!(other.triangulation().is_none());
    }
    let few = Options { max_vertices: (without + count) / 2, ..options(18.0) };
    assert_eq!(other.run(&few, None).unwrap_err().kind(), ErrorKind::Limit);
    assert!(other.triangulation().is_none());
}
