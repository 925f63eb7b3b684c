//! Options of a run, inside and outside their documented ranges.

use super::bytes::Bytes;
use netmesh::{Algorithm, Criterion, GivesWay, NetOrdering, Options, Output};

/// Largest number of vertices of a run, by dimension from 2: enough for cages, few enough for many
/// runs.
const MAX_VERTICES: [u64; 3] = [2000, 1000, 500];

#[derive(Clone, Debug)]
pub struct Settings {
    pub options: Options,
    /// True if every number is in its documented range.
    pub valid: bool,
}

impl Settings {
    pub fn new(bytes: &mut Bytes<'_>, dim: usize) -> Self {
        let choice = bytes.byte();
        let mut options = Options {
            output: if choice & 1 == 0 { Output::Hierarchical } else { Output::WellSpaced },
            criterion: match choice >> 1 & 3 {
                0 => Criterion::RadiusEdge,
                _ => Criterion::VoronoiAspect,
            },
            algorithm: match choice >> 3 & 15 {
                0 => Algorithm::Svr,
                1..4 => Algorithm::Delaunay,
                _ => Algorithm::Netmesh,
            },
            instruments: choice >> 7 == 1,
            ..Options::default()
        };
        if bytes.once_in(16) {
            options.ordering = NetOrdering::DeterministicNet;
        }
        options.threads = bytes.below(4) as u32;
        options.seed = u64::from(bytes.byte());
        let most = MAX_VERTICES[(dim - 2).min(2)];
        options.max_vertices = match bytes.byte() {
            few @ 1..64 => u64::from(few),
            _ => most,
        };
        let valid = choose_numbers(&mut options, bytes, dim);
        if dim == 3 && options.distance_ratio == 0.0 && bytes.once_in(4) {
            options.min_dihedral = f64::from(bytes.below(23) as u32);
            if bytes.once_in(3) {
                options.gives_way = GivesWay::Bound;
            }
        }
        Self { options, valid }
    }
}

/// Sets the numbers; false if one of them is outside its range.
fn choose_numbers(options: &mut Options, bytes: &mut Bytes<'_>, dim: usize) -> bool {
    let by_dim = |values: [f64; 4]| values[(dim - 2).min(3)];
    let bound = match options.criterion {
        Criterion::VoronoiAspect => (by_dim([2.2, 2.5, 3.5, 4.5]), 100.0),
        Criterion::RadiusEdge => (by_dim([0.9, 1.1, 1.75, 2.25]), 50.0),
    };
    let numbers = [
        (&mut options.quality_bound, bound),
        (&mut options.epsilon, (0.05, 0.6)),
        (&mut options.delta, (0.1, 1.0)),
        (&mut options.gamma, (0.01, 0.25)),
        (&mut options.yield_radius, (0.05, 1.0)),
        (&mut options.encroachment, (1.0, 4.0)),
        (&mut options.cage_scale, (0.3, 0.9)),
        (&mut options.root_scale, (2.0, 16.0)),
    ];
    let mut valid = true;
    if (options.output, options.algorithm) == (Output::WellSpaced, Algorithm::Netmesh) {
        let (lowest, highest) = (0.05, 1.0);
        options.distance_ratio = choose(bytes, lowest, highest);
        let ratio = options.distance_ratio;
        valid = ratio == 0.0 || (lowest..=highest).contains(&ratio);
        options.max_edge = match bytes.byte() {
            0..192 => 0.0,
            192..250 => 2f64.powi(8 * (i32::from(bytes.byte()) - 128)),
            _ => bytes.double(),
        };
        valid &= options.max_edge >= 0.0;
    }
    for (number, (lowest, highest)) in numbers {
        *number = choose(bytes, lowest, highest);
        valid &= *number == 0.0 || (lowest..=highest).contains(number);
    }
    if bytes.once_in(32) {
        let angle = choose(bytes, 0.6, 33.7);
        options.min_angle = angle;
        let alone = dim == 2 && options.quality_bound == 0.0;
        valid &= angle == 0.0 || (alone && (0.6..=33.7).contains(&angle));
    }
    valid
}

/// Returns mostly the default, else a number in the range or, seldom, outside.
fn choose(bytes: &mut Bytes<'_>, lowest: f64, highest: f64) -> f64 {
    match bytes.byte() {
        0..200 => 0.0,
        200..240 => {
            let part = f64::from(bytes.byte()) / 255.0;
            (lowest * (1.0 - part) + highest * part).clamp(lowest, highest)
        }
        240..245 => lowest,
        245..250 => highest,
        250 => lowest.next_down(),
        251 => highest.next_up(),
        252 => -lowest,
        253 => f64::NAN,
        254 => f64::INFINITY,
        _ => bytes.double(),
    }
}
