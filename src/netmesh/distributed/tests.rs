//! All of it in one process, with the certificate of the whole mesh.

use super::*;
use crate::mesh::{Inputs, Triangulation};
use crate::numerics::distance;
use crate::numerics::testing::Random;
use crate::options::{Criterion, Options, Output};
use crate::validate::validate;

/// One point in this many is of the sample, beside those at the ends of the axes.
const SAMPLED: usize = 16;

/// Counts of the events of a run.
#[derive(Default)]
struct Seen {
    seams: usize,
    /// Number of times that something was left in the end.
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
    let mut coarse = Coarse::new(&own, &names, own.len() / (8 * count), options, None).unwrap();
    let Located { simplices, at_steiner_points } = coarse.locate(points, None).unwrap();
    let located: Vec<(usize, u32)> =
        simplices.into_iter().enumerate().filter(|&(_, simplex)| simplex != u32::MAX).collect();
    assert_eq!(located.len() + at_steiner_points.len(), points.len() - coarse.sample);
    let at_steiner_points: Vec<_> =
        at_steiner_points.iter().map(|&(at, vertex)| (vertex, at as u64)).collect();
    coarse.yield_to(&at_steiner_points).unwrap();
    let mut settled = Vec::new();
    let mut number = 0;
    let mut make = |pieces: Vec<Piece<D>>| {
        number += 1;
        let known = known_domains(&pieces);
        let made = coarse.maker().refine(pieces, number, None).unwrap();
        assert_non_owned_are_left(&known, &made);
        made
    };
    let leave = |settled: &mut Vec<Piece<D>>, made: Vec<Piece<D>>| {
        let wanted = made.iter().flat_map(|piece| piece.wanted_names().unwrap());
        let wanted = Vec::from_iter(std::collections::BTreeSet::from_iter(wanted));
        let given =
            std::mem::take(settled).into_iter().map(|piece| piece.give(rings, &wanted).unwrap());
        let (mut left, mut seams): (Vec<_>, Vec<_>) = given.unzip();
        for piece in made {
            let (rest, seam) = piece.divide(rings, &wanted, || Ok(())).unwrap();
            left.push(rest);
            seams.push(seam);
        }
        *settled = left;
        seams.into_iter().flatten().collect::<Vec<_>>()
    };
    let mut made = Vec::new();
    let partition_of = coarse.partitions(&Bisection::new(own, count, 0).unwrap()).unwrap();
    for partition in 0..count as u32 {
        let (mut piece, ids) = coarse.extract(&partition_of, partition).unwrap();
        let inputs: Vec<_> = located
            .iter()
            .filter(|&&(_, simplex)| partition_of[simplex as usize] == partition)
            .map(|&(at, simplex)| {
                (at as u64, points[at], ids.binary_search(&simplex).unwrap() as u32)
            })
            .collect();
        piece.add_inputs(&inputs).unwrap();
        made.push(make(vec![piece]));
    }
    let mut seams = leave(&mut settled, made);
    let mut seen = Seen::default();
    for phase in 1..=4 {
        let vertices = seams.iter().flat_map(|seam| seam.vertices().map(|(_, point)| point));
        let count = if phase < 4 { count } else { 1 };
        let cut = Bisection::new(vertices.collect(), count, phase).unwrap();
        let mut next: Vec<Vec<Piece<D>>> = (0..count).map(|_| Vec::new()).collect();
        for (part, seam) in seams.drain(..).flat_map(|seam| seam.partition(&cut).unwrap()) {
            next[part as usize].push(seam);
        }
        let mut made = Vec::new();
        for pieces in next.into_iter().filter(|pieces| !pieces.is_empty()) {
            seen.seams += 1;
            made.push(make(pieces));
        }
        seams = match phase {
            4 => made,
            _ => leave(&mut settled, made),
        };
    }
    settled.extend(seams);
    for piece in &settled {
        // Otherwise nobody would know that the facet is on the hull, once infinite simplices are
        // gone.
        assert!(piece.beyond_hull().all(|(infinite, finite)| infinite != finite));
    }
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
            settled.into_iter().map(|piece| piece.give(0, &names).unwrap()).unzip();
        settled = left;
        number += 1;
        let taken = taken.into_iter().flatten().collect();
        settled.push(coarse.maker().refine(taken, number, None).unwrap());
    }
    (coarse.maker().whole(settled).unwrap(), seen)
}

/// Name of a domain -> its version, its parent and its clearance, as pieces know them together.
type Known = std::collections::BTreeMap<u64, (u64, u64, f64)>;

fn known_domains<const D: usize>(pieces: &[Piece<D>]) -> Known {
    let mut known = Known::new();
    for domain in pieces.iter().flat_map(|piece| &piece.domains) {
        let own = (domain.version, domain.parent, domain.outside);
        let all = known.entry(domain.name).or_insert(own);
        *all = (all.0.max(own.0), if own.0 > all.0 { own.1 } else { all.1 }, all.2.min(own.2));
    }
    known
}

/// Checks that a domain that a partition does not own has no new version, that it stays where it
/// is, and that others are told if its clearance fell.
fn assert_non_owned_are_left<const D: usize>(known: &Known, made: &Piece<D>) {
    for domain in &made.domains {
        let Some(&(version, parent, outside)) = known.get(&domain.name) else { continue };
        if version == domain.version {
            let is_released = made.released.iter().any(|&[name, _]| name == parent);
            assert!(domain.parent == parent || is_released);
            assert!(domain.outside == outside || made.wanted.contains(&domain.name));
        }
    }
}

fn check<const D: usize>(name: &str, points: &[[f64; D]], options: &Options, count: usize) {
    let (made, seen) = run(points, options, count, RINGS);
    let inputs = Inputs::new(D, points.len(), points.as_flattened(), 0).unwrap();
    let report = validate(&inputs, &made, 3).unwrap();
    assert_eq!(report.level, 3, "{name}: {report:?}");
    let usual = crate::netmesh::run(&inputs, None, options, None).unwrap();
    let ratio = made.vertex_count() as f64 / usual.vertex_count() as f64;
    assert!((0.96..1.06).contains(&ratio), "{name}: {ratio}");
    assert!(seen.seams > 0);
}

fn scattered<const D: usize>(count: usize, seed: u64) -> Vec<[f64; D]> {
    let mut random = Random(seed);
    (0..count).map(|_| std::array::from_fn(|_| random.unit())).collect()
}

/// Returns points round one point at ten scales, in no order.
fn nested<const D: usize>(count: usize) -> Vec<[f64; D]> {
    let mut random = Random(3);
    let mut point = |at: usize| {
        let size = 2f64.powi(-40 * (at * 7 / SAMPLED % 10) as i32);
        std::array::from_fn(|_| size * (random.unit() - 0.5))
    };
    (0..count).map(&mut point).collect()
}

/// Returns `count` clusters of `size` points, each far smaller than its distance to the next.
fn clusters<const D: usize>(count: usize, size: usize) -> Vec<[f64; D]> {
    let mut random = Random(6);
    let centers = scattered::<D>(count, 7);
    let mut point = |at: usize| {
        let center = centers[at % count];
        std::array::from_fn(|axis| center[axis] + 1e-6 * (random.unit() - 0.5))
    };
    (0..count * size).map(&mut point).collect()
}

/// Returns a lattice with `side` values on every axis, so that all small simplices are cospherical,
/// and sample and interfaces go through points on facets.
fn lattice<const D: usize>(side: usize) -> Vec<[f64; D]> {
    let point = |at: usize| std::array::from_fn(|axis| (at / side.pow(axis as u32) % side) as f64);
    (0..side.pow(D as u32)).map(point).collect()
}

fn well_spaced() -> Options {
    Options {
        output: Output::WellSpaced,
        criterion: Criterion::RadiusEdge,
        quality_bound: 2.0,
        ..Options::default()
    }
}

#[test]
fn uniform_points() {
    check::<2>("uniform", &scattered(4000, 1), &Options::default(), 4);
    check::<3>("uniform", &scattered(2500, 2), &Options::default(), 3);
}

#[test]
fn finished_points() {
    check::<2>("finished", &scattered(3000, 1), &well_spaced(), 5);
    check::<3>("finished", &scattered(2000, 2), &well_spaced(), 4);
}

/// Domains that partitions know of and cannot change, released and grown at seams.
#[test]
fn nested_clusters() {
    check::<2>("nested", &nested(3000), &Options::default(), 4);
    check::<3>("nested", &nested(1500), &Options::default(), 4);
    check::<2>("nested, finished", &nested(1000), &well_spaced(), 3);
}

/// More clusters than partitions: most interfaces go through domains, which no partition owns.
#[test]
fn many_clusters() {
    check::<2>("clusters", &clusters(150, 20), &Options::default(), 4);
    check::<3>("clusters", &clusters(40, 40), &Options::default(), 3);
    check::<2>("clusters, finished", &clusters(40, 20), &well_spaced(), 3);
}

/// Steiner points of the coarse mesh are where inputs are that it does not have.
#[test]
fn steiner_points_yield_to_inputs_that_are_not_of_the_sample() {
    let mut points = lattice::<2>(40);
    let mut random = Random(0);
    for at in 0..points.len() {
        points.swap(at, (random.unit() * 1600.0) as usize);
    }
    let sample = sample_of(&points);
    let own: Vec<[f64; 2]> = sample.iter().map(|&at| points[at]).collect();
    let names: Vec<u64> = sample.iter().map(|&at| at as u64).collect();
    let coarse = Coarse::new(&own, &names, 0, &Options::default(), None).unwrap();
    assert!(!coarse.locate(&points, None).unwrap().at_steiner_points.is_empty());
    for options in [Options::default(), well_spaced()] {
        let (made, _) = run(&points, &options, 3, RINGS);
        let inputs = Inputs::new(2, points.len(), points.as_flattened(), 0).unwrap();
        assert_eq!(validate(&inputs, &made, 3).unwrap().level, 3);
    }
}

#[test]
fn lattices() {
    check::<2>("lattice", &lattice(50), &Options::default(), 4);
    check::<3>("lattice", &lattice(12), &Options::default(), 4);
}

/// If the seam is too narrow, much is left in the end, and is taken out of settled pieces.
#[test]
fn what_seams_leave_is_done_in_the_end() {
    let points = scattered::<2>(3000, 4);
    let (made, seen) = run(&points, &Options::default(), 4, 0);
    assert!(seen.rests > 0);
    let inputs = Inputs::new(2, points.len(), points.as_flattened(), 0).unwrap();
    assert_eq!(validate(&inputs, &made, 3).unwrap().level, 3);
}

/// Returns one of two partitions of a coarse mesh.
fn half_of_coarse() -> Piece<3> {
    let points = scattered::<3>(600, 5);
    let names: Vec<u64> = (0..600).collect();
    let coarse = Coarse::new(&points, &names, 0, &Options::default(), None).unwrap();
    let partition_of = coarse.partitions(&Bisection::new(points, 2, 0).unwrap()).unwrap();
    coarse.extract(&partition_of, 1).unwrap().0
}

#[test]
fn a_piece_is_what_its_bytes_say() {
    let piece = half_of_coarse();
    let bytes = piece.to_bytes().unwrap();
    assert_eq!(Piece::from_bytes(&bytes).unwrap(), piece);
    // Whatever is cut off, or too much.
    for length in (0..bytes.len()).step_by(97) {
        assert!(Piece::<3>::from_bytes(&bytes[..length]).is_err());
    }
    assert!(Piece::<3>::from_bytes(&[bytes.as_slice(), &[0]].concat()).is_err());
    assert!(Piece::<2>::from_bytes(&bytes).is_err());
}

/// All simplices at vertices that are wanted go with the seam, or are given.
#[test]
fn what_is_wanted_goes_along() {
    let piece = half_of_coarse();
    let has = |piece: &Piece<3>, name| piece.vertices().any(|(other, _)| other == name);
    let (left, seam) = piece.clone().divide(0, &[], || Ok(())).unwrap();
    let seam = seam.unwrap();
    let (inner, _) = left.vertices().find(|&(name, _)| !has(&seam, name)).unwrap();
    let (left, seam) = piece.clone().divide(0, &[inner], || Ok(())).unwrap();
    assert!(!has(&left, inner) && has(&seam.unwrap(), inner));
    assert!(piece.clone().give(0, &[]).unwrap().1.is_none());
    let (left, given) = piece.give(0, &[inner]).unwrap();
    assert!(!has(&left, inner) && has(&given.unwrap(), inner));
}

/// Points on facets of the coarse mesh are in several simplices.
#[test]
fn where_a_point_is_does_not_depend_on_the_others() {
    let points = lattice::<2>(20);
    let sample: Vec<usize> = sample_of(&points);
    let own: Vec<[f64; 2]> = sample.iter().map(|&at| points[at]).collect();
    let names: Vec<u64> = sample.iter().map(|&at| at as u64).collect();
    let coarse = Coarse::new(&own, &names, 0, &Options::default(), None).unwrap();
    let all = coarse.locate(&points, None).unwrap();
    for (at, point) in points.iter().enumerate() {
        let alone = coarse.locate(&[*point], None).unwrap();
        assert_eq!(alone.simplices, [all.simplices[at]]);
        let yields = all.at_steiner_points.iter().find(|(other, _)| *other == at);
        let alone = alone.at_steiner_points.first();
        assert_eq!(yields.map(|&(_, vertex)| vertex), alone.map(|&(_, vertex)| vertex));
        let is_at_vertex = sample.binary_search(&at).is_ok() || yields.is_some();
        assert_eq!(all.simplices[at] == u32::MAX, is_at_vertex);
    }
}
