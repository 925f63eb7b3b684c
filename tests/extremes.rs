//! Inputs that kill other meshers: every one gets a mesh whose certificate holds, or a status.

use crate::random::Random;
use netmesh::validate::validate;
use netmesh::{ErrorKind, Mesh, Options, Output};

/// Runs and certifies; returns the vertices per input and the number of precision-limited cells.
fn certify(name: &str, dim: usize, points: &[f64], output: Output) -> (f64, u64) {
    let mut mesh = Mesh::new(dim, points.len() / dim, points, 0).unwrap();
    let options = Options { output, max_vertices: 2_000_000, ..Options::default() };
    mesh.run(&options, None).unwrap_or_else(|error| panic!("{name} in {dim}D: {error}"));
    let triangulation = mesh.triangulation().unwrap();
    let report = validate(mesh.inputs(), triangulation, 3).unwrap();
    assert_eq!(report.level, 3, "{name} in {dim}D, {output:?}: {:?}", report.first);
    let ratio = triangulation.vertex_count() as f64 / mesh.inputs().distinct() as f64;
    (ratio, triangulation.stats.precision_limited)
}

fn certify_everywhere(name: &str, input: impl Fn(usize, &mut Random) -> Vec<f64>) {
    for output in [Output::Hierarchical, Output::WellSpaced] {
        certify_output(name, output, &input);
    }
}

fn certify_output(name: &str, output: Output, input: impl Fn(usize, &mut Random) -> Vec<f64>) {
    for dim in 2..=4 {
        let points = input(dim, &mut Random::new(2 * dim as u64 + 1));
        let (ratio, limited) = certify(name, dim, &points, output);
        println!("{name} {dim}D {output:?}: m/n {ratio:.2}, precision-limited {limited}");
        let is_subnormal = points.iter().all(|x| x.abs() < f64::MIN_POSITIVE);
        assert!(limited == 0 || is_subnormal, "{name} in {dim}D: {limited} limited cells");
    }
}

#[test]
fn scaled_coordinates() {
    for scale in [1e200, 1e-200, 1e300, 1e-300] {
        certify_everywhere("scaled", |dim, random| {
            random.uniform(dim, 60).iter().map(|x| x * scale).collect()
        });
    }
}

#[test]
fn subnormal_coordinates() {
    certify_everywhere("subnormal", |dim, random| {
        random.uniform(dim, 60).iter().map(|x| x * 1e-310).collect()
    });
    certify_everywhere("a few units of the smallest double", |dim, random| {
        random.uniform(dim, 40).iter().map(|x| f64::from_bits((x * 9.0) as u64)).collect()
    });
}

/// An input 10.2 units from a centre, which rounds to 10, was taken for one inside the 10 units
/// that its cage allows (found by the breakers).
#[test]
fn distances_that_round_to_the_limit() {
    let units = [[1, 4, 0, 3], [1, 5, 4, 3], [9, 1, 6, 8]];
    let points: Vec<f64> = units.as_flattened().iter().map(|&unit| f64::from_bits(unit)).collect();
    certify("three smallest subnormals", 4, &points, Output::Hierarchical);
}

fn one_ulp_pairs(dim: usize, random: &mut Random) -> Vec<f64> {
    let mut points: Vec<f64> = random.uniform(dim, 8).iter().map(|x| x + 1.0).collect();
    let mut twins = points.clone();
    for twin in twins.chunks_exact_mut(dim) {
        twin[0] = twin[0].next_up();
    }
    points.append(&mut twins);
    points
}

fn close_pairs(dim: usize, random: &mut Random, exponent: i32) -> Vec<f64> {
    let mut points: Vec<f64> = random.uniform(dim, 5).iter().map(|x| x + 1.0).collect();
    let shift = |x: &f64| x + (2.0 * random.unit() - 1.0) * 2f64.powi(exponent);
    let twins: Vec<f64> = points.clone().iter().map(shift).collect();
    points.extend(twins);
    points
}

/// Doubles are barely fine enough for a cage there: it is as large as they need, not larger.
#[test]
fn close_pairs_away_from_the_origin() {
    certify_output("1-ulp pairs", Output::Hierarchical, one_ulp_pairs);
    for exponent in [-10, -20, -30, -40, -45, -48, -50] {
        certify_output("pairs in [1, 2]", Output::Hierarchical, |dim, random| {
            close_pairs(dim, random, exponent)
        });
    }
}

/// Without cages the refinement goes down to the units of roundoff.
#[test]
fn close_pairs_finished() {
    certify_output("1-ulp pair", Output::WellSpaced, |dim, random| {
        let pair = one_ulp_pairs(dim, random);
        [&pair[..dim], &pair[8 * dim..9 * dim]].concat()
    });
    certify_output("pairs in [1, 2]", Output::WellSpaced, |dim, random| {
        close_pairs(dim, random, -12)
    });
}

#[test]
fn flat_lattices_in_higher_dimensions() {
    for rank in 1..=3 {
        certify_everywhere("tilted lattice", |dim, _| {
            let rank = rank.min(dim);
            let side = [20usize, 6, 4][rank - 1];
            let mut points = Vec::new();
            for i in 0..side.pow(rank as u32) {
                let step = |k: usize| (i / side.pow(k as u32) % side) as f64;
                for axis in 0..dim {
                    let along: f64 = (0..rank)
                        .map(|k| {
                            step(k)
                                * (((axis * 7 + k * 3) % 5) as f64
                                    - if axis == k { 9.0 } else { 1.0 })
                        })
                        .sum();
                    points.push(along);
                }
            }
            points
        });
    }
}

#[test]
fn two_points() {
    certify_everywhere("two points", |dim, _| {
        let mut points = vec![0.0; 2 * dim];
        points[dim] = 1.0;
        points
    });
    certify_everywhere("two subnormal points", |dim, _| {
        let mut points = vec![0.0; 2 * dim];
        points[dim] = f64::from_bits(1);
        points
    });
}

/// Any finite doubles: a certified mesh, or `Limit` where the outer cage leaves the doubles or the
/// mesh would be too large; nothing else, and no panic.
#[test]
fn raw_bit_patterns() {
    let mut meshed = 0;
    for seed in 0..16 {
        let mut random = Random::new(2 * seed + 1);
        for dim in 2..=4 {
            let n = 3 + (seed as usize * 7) % 20;
            let points: Vec<f64> = (0..n * dim).map(|_| random.finite()).collect();
            let mut mesh = Mesh::new(dim, n, &points, 0).unwrap();
            let options = Options { max_vertices: 3_000, ..Options::default() };
            match mesh.run(&options, None) {
                Ok(()) => {
                    let report = validate(mesh.inputs(), mesh.triangulation().unwrap(), 3).unwrap();
                    assert_eq!(report.level, 3, "seed {seed}, {dim}D: {:?}", report.first);
                    meshed += 1;
                }
                Err(error) => assert_eq!(error.kind(), ErrorKind::Limit, "{error}"),
            }
        }
    }
    assert!(meshed > 10, "only {meshed} of 48 sets were meshed");
}
