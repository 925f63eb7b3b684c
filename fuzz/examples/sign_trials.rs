//! Compares signs with exact integers, many times: `sign_trials [scale] [threads] [seed]`.
//!
//! A trial is one sign, of an orientation or of an in-ball determinant, of points whose coordinates
//! are raw finite bit patterns (all finite doubles equally likely) or of a structured family. With
//! scale 1 there are more than 1e8 of the former. Prints the counts; fails if any sign was wrong.

use netmesh::numerics::{Circumball, Sign, SplitMix, in_ball, orientation, orientation_filtered};
use netmesh_fuzz::bytes::Bytes;
use netmesh_fuzz::signs::{references, sign};
use netmesh_fuzz::{families, oracle};
use std::ops::AddAssign;
use std::time::Instant;

/// Trials at scale 1, per dimension: orientations and in-ball signs of raw bit patterns, and how
/// many times both of structured points.
const PLAN: [(usize, [u64; 3]); 5] = [
    (2, [62_000_000, 12_000_000, 2_000_000]),
    (3, [20_000_000, 2_000_000, 300_000]),
    (4, [8_000_000, 400_000, 60_000]),
    (5, [1_500_000, 60_000, 10_000]),
    (6, [300_000, 6_000, 1_000]),
];

/// The circumball is asked once in 16 in-ball trials: it costs more than the sign.
const BALL_EVERY: u64 = 16;

fn main() {
    let mut arguments = std::env::args().skip(1);
    let scale: f64 = arguments.next().map_or(1.0, |x| x.parse().expect("scale is a number"));
    let threads: u64 = arguments.next().map_or(2, |x| x.parse().expect("threads is a number"));
    let seed: u64 = arguments.next().map_or(1, |x| x.parse().expect("seed is a number"));
    println!(
        "dim  kind         orientations  in-ball signs  by the filter  by a ball      \
         zero  wrong  thread s"
    );
    let mut all = Counts::default();
    for (dim, plan) in PLAN {
        let plan = plan.map(|count| (count as f64 * scale / threads as f64).ceil() as u64);
        let [raw, structured] =
            in_threads(threads, |thread| trials(dim, plan, seed + 1000 * thread));
        print_row(dim, "raw bits", raw);
        print_row(dim, "structured", structured);
        all += raw;
        all += structured;
    }
    let signs = all.orientations + all.in_balls;
    println!("{signs} signs in {:.0} s of threads, {} wrong", all.seconds, all.wrong);
    assert_eq!(all.wrong, 0, "a sign is wrong");
}

fn print_row(dim: usize, kind: &str, counts: Counts) {
    let Counts { orientations, in_balls, filtered, decided, zeros, wrong, seconds } = counts;
    println!(
        "{dim:>3}  {kind:<11}  {orientations:>12}  {in_balls:>13}  {filtered:>13}  {decided:>9}  \
         {zeros:>8}  {wrong:>5}  {seconds:>8.0}"
    );
}

#[derive(Clone, Copy, Default)]
struct Counts {
    orientations: u64,
    in_balls: u64,
    /// Orientations that the floating-point filter decided.
    filtered: u64,
    /// In-ball signs that a circumball decided.
    decided: u64,
    zeros: u64,
    wrong: u64,
    seconds: f64,
}

impl AddAssign for Counts {
    fn add_assign(&mut self, other: Self) {
        self.orientations += other.orientations;
        self.in_balls += other.in_balls;
        self.filtered += other.filtered;
        self.decided += other.decided;
        self.zeros += other.zeros;
        self.wrong += other.wrong;
        self.seconds += other.seconds;
    }
}

fn in_threads(threads: u64, work: impl Fn(u64) -> [Counts; 2] + Sync) -> [Counts; 2] {
    let mut sums = [Counts::default(); 2];
    std::thread::scope(|scope| {
        let work = &work;
        let running: Vec<_> = (0..threads).map(|t| scope.spawn(move || work(t))).collect();
        for thread in running {
            let counts = thread.join().expect("a thread of trials ends");
            sums[0] += counts[0];
            sums[1] += counts[1];
        }
    });
    sums
}

fn trials(dim: usize, plan: [u64; 3], seed: u64) -> [Counts; 2] {
    match dim {
        2 => trials_of::<2>(plan, seed),
        3 => trials_of::<3>(plan, seed),
        4 => trials_of::<4>(plan, seed),
        5 => trials_of::<5>(plan, seed),
        _ => trials_of::<6>(plan, seed),
    }
}

fn trials_of<const D: usize>([turns, sides, both]: [u64; 3], seed: u64) -> [Counts; 2] {
    let mut random = Random(SplitMix(seed));
    let (mut raw, mut structured) = (Counts::default(), Counts::default());
    let begun = Instant::now();
    for _ in 0..turns {
        compare_orientation::<D>(&random.raw_points(D + 1), &mut raw);
    }
    for _ in 0..sides {
        compare_in_ball::<D>(&random.raw_points(D + 2), &mut raw);
    }
    raw.seconds = begun.elapsed().as_secs_f64();
    let begun = Instant::now();
    for _ in 0..both {
        let points = random.structured_points(D + 2);
        compare_orientation::<D>(&points[..=D], &mut structured);
        compare_in_ball::<D>(&points, &mut structured);
    }
    structured.seconds = begun.elapsed().as_secs_f64();
    [raw, structured]
}

fn compare_orientation<const D: usize>(points: &[[f64; D]], counts: &mut Counts) {
    let simplex = references(points);
    let found = orientation(&simplex);
    let filtered = orientation_filtered(&simplex);
    let expected = sign(oracle::orientation(points));
    counts.orientations += 1;
    counts.filtered += u64::from(filtered.is_some());
    counts.zeros += u64::from(expected == Sign::Zero);
    if found != expected || filtered.is_some_and(|sign| sign != expected) {
        counts.wrong += 1;
        eprintln!("orientation {found:?}, {filtered:?}, not {expected:?}: {points:?}");
    }
}

fn compare_in_ball<const D: usize>(points: &[[f64; D]], counts: &mut Counts) {
    let (simplex, q) = (&references(points)[..=D], &points[D + 1]);
    let found = in_ball(simplex, q);
    let expected = sign(oracle::in_ball(&points[..=D], q));
    let decided = match counts.in_balls % BALL_EVERY {
        0 => decided(simplex, q),
        _ => None,
    };
    counts.in_balls += 1;
    counts.decided += u64::from(decided.is_some());
    counts.zeros += u64::from(expected == Sign::Zero);
    if found != expected || decided.is_some_and(|sign| sign != expected) {
        counts.wrong += 1;
        eprintln!("in_ball {found:?}, {decided:?}, not {expected:?}: {points:?}");
    }
}

/// The sign that the simplex's circumball says, where it has one and decides.
fn decided<const D: usize>(simplex: &[&[f64; D]], q: &[f64; D]) -> Option<Sign> {
    let turn = orientation(simplex);
    if turn == Sign::Zero {
        return None;
    }
    let ball = Circumball::new(simplex);
    let inside = ball.side(simplex[ball.anchor as usize], q)?;
    Some(if inside { turn } else { turn.flip() })
}

/// Pseudo-random bits (SplitMix64): equal seeds, equal trials.
struct Random(SplitMix);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0.next_word()
    }

    fn finite(&mut self) -> f64 {
        loop {
            let value = f64::from_bits(self.bits());
            if value.is_finite() {
                return value;
            }
        }
    }

    fn raw_points<const D: usize>(&mut self, count: usize) -> Vec<[f64; D]> {
        (0..count).map(|_| std::array::from_fn(|_| self.finite())).collect()
    }

    fn structured_points<const D: usize>(&mut self, count: usize) -> Vec<[f64; D]> {
        let mut choices = [0; 256];
        choices.chunks_exact_mut(8).for_each(|c| c.copy_from_slice(&self.bits().to_le_bytes()));
        let coordinates = families::points(&mut Bytes::new(&choices), D, count);
        coordinates.chunks_exact(D).map(|p| std::array::from_fn(|i| p[i])).collect()
    }
}
