//! All of it in one process, with the certificate of the whole mesh.

use super::*;
use crate::mesh::{Inputs, Triangulation};
use crate::numerics::distance;
use crate::numerics::testing::Random;
use crate::options::{Criterion, Options, Output};
use crate::validate::validate;

/// One point in this many is of the sample, beside those at the ends of the axes.
const SAMPLED: usize = 16;

/// What has been seen of a run.
#[derive(Default)]
struct Seen {
    seams: usize,
    /// How often something was left in the end.
    rests: usize,
}

fn sample_of<const D: usize>(points: &[[f64; D]]) -> Vec<usize> {
    let mut sample: Vec<usize> = (0..points.len()).step_by(SAMPLED).collect();
    let by = |measure: &dyn Fn(&[f64; D]) -> f64| {
        (0..points.len()).min_by(|&a, &b| measure(&points[a]).total_cmp(&measure(&points[b])))
    };
    let mut middle = [0.0; D];
    for axis in 0..D {
        let low = by(&|point| point[axis]).unwrap();
        let high = by(&|point| -point[axis]).unwrap();
        sample.extend([low, high]);
        middle[axis] = 0.5 * points[low][axis] + 0.5 * points[high][axis];
    }
    let center = by(&|point| distance(point, &middle)).unwrap();
    sample.push(center);
    sample.push(by(&|point| -distance(point, &points[center])).unwrap());
    sample.sort_unstable();
    sample.dedup();
    sample
}

fn run<const D: usize>(
    points: &[[f64; D]],
    options: &Options,
    count: usize,
    rings: usize,
) -> (Triangulation, Seen) {
    let sample = sample_of(points);
    let own: Vec<[f64; D]> = sample.iter().map(|&at| points[at]).collect();
    let names: Vec<u64> = sample.iter().map(|&at| at as u64).collect();
    let coarse = Coarse::new(&own, &names, options, None).unwrap();
    let simplices = coarse.locate(points, None).unwrap();
    let located: Vec<(usize, u32)> =
        simplices.into_iter().enumerate().filter(|&(_, simplex)| simplex != u32::MAX).collect();
    assert_eq!(located.len(), points.len() - sample.len());
    let mut weights = vec![0; coarse.anchor_count()];
    for &(_, simplex) in &located {
        weights[coarse.anchors()[simplex as usize] as usize] += 1;
    }
    let partition_of = coarse.partitions(&weights, count).unwrap();
    let mut seen = Seen::default();
    let mut settled = Vec::new();
    let mut seams: Vec<Option<Piece<D>>> = Vec::new();
    for partition in 0..count as u32 {
        let (mut piece, ids) = coarse.cut(&partition_of, partition).unwrap();
        let inputs: Vec<_> = located
            .iter()
            .filter(|&&(_, simplex)| partition_of[simplex as usize] == partition)
            .map(|&(at, simplex)| {
                (at as u64, points[at], ids.binary_search(&simplex).unwrap() as u32)
            })
            .collect();
        piece.add_inputs(&inputs).unwrap();
        let made = coarse.maker().refine(vec![piece], 1 + partition, None).unwrap();
        let (rest, seam) = made.divide(rings, || Ok(())).unwrap();
        settled.push(rest);
        seams.push(seam);
    }
    let mut number = count as u32;
    while seams.len() > 1 {
        let mut next = Vec::new();
        for pair in seams.chunks_mut(2) {
            let pieces: Vec<_> = pair.iter_mut().filter_map(Option::take).collect();
            number += 1;
            seen.seams += 1;
            let made = coarse.maker().refine(pieces, number, None).unwrap();
            let (rest, seam) = made.divide(rings, || Ok(())).unwrap();
            settled.push(rest);
            next.push(seam);
        }
        seams = next;
    }
    settled.extend(seams.into_iter().flatten());
    let mut rings = 2;
    loop {
        let mut names = settled.last().unwrap().unsettled_names().unwrap();
        if coarse.maker().is_done(settled.last().unwrap()).unwrap() {
            break;
        }
        seen.rests += 1;
        rings *= 2;
        for _ in 0..rings {
            let all = settled.iter().flat_map(|piece| piece.names_beside(&names).unwrap());
            names = std::collections::BTreeSet::from_iter(all).into_iter().collect();
        }
        let (left, taken): (Vec<_>, Vec<_>) =
            settled.into_iter().map(|piece| piece.take_out(&names).unwrap()).unzip();
        settled = left;
        number += 1;
        settled.push(coarse.maker().refine(taken, number, None).unwrap());
    }
    (coarse.maker().whole(settled).unwrap(), seen)
}

fn check<const D: usize>(name: &str, points: &[[f64; D]], options: &Options, count: usize) {
    let (made, seen) = run(points, options, count, RINGS);
    let inputs = Inputs::new(D, points.len(), points.as_flattened(), 0).unwrap();
    let report = validate(&inputs, &made, 3).unwrap();
    assert_eq!(report.level, 3, "{name}: {report:?}");
    let usual = crate::netmesh::run(&inputs, None, options, None).unwrap();
    let ratio = made.vertex_count() as f64 / usual.vertex_count() as f64;
    eprintln!(
        "{name} {D}D: {ratio:.4} rests {} limited {} {}",
        seen.rests, made.stats.precision_limited, usual.stats.precision_limited
    );
    assert!((0.9..1.1).contains(&ratio), "{name}: {ratio}");
    assert!(seen.seams > 0);
}

fn scattered<const D: usize>(count: usize, seed: u64) -> Vec<[f64; D]> {
    let mut random = Random(seed);
    (0..count).map(|_| std::array::from_fn(|_| random.unit())).collect()
}

#[test]
fn uniform_points() {
    check::<2>("uniform", &scattered(4000, 1), &Options::default(), 4);
    check::<3>("uniform", &scattered(4000, 2), &Options::default(), 4);
}

#[test]
fn finished_points() {
    let options = Options {
        output: Output::WellSpaced,
        criterion: Criterion::RadiusEdge,
        quality_bound: 2.0,
        ..Options::default()
    };
    check::<2>("finished", &scattered(4000, 1), &options, 4);
    check::<3>("finished", &scattered(4000, 2), &options, 4);
}
