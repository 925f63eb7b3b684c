//! The meshing parameters (§4, end): defaults per dimension, and the ranges that are accepted.
//! Plain data that a result keeps; what the algorithm derives from them is its own affair.

use crate::error::{Error, ErrorKind, Result, message};
use crate::options::{Algorithm, Criterion, NetOrdering, Options, Output};

/// The more, the less is deferred at interfaces; the fewer, the more threads have work.
const INPUTS_PER_PARTITION: usize = 1 << 18;

/// Options with every default filled in and every range checked.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameters {
    pub output: Output,
    pub algorithm: Algorithm,
    pub ordering: NetOrdering,
    pub criterion: Criterion,
    pub threads: u32,
    /// tau for [`Criterion::VoronoiAspect`], circumradius / shortest edge otherwise.
    pub quality_bound: f64,
    pub epsilon: f64,
    pub delta: f64,
    pub gamma: f64,
    pub yield_radius: f64,
    pub encroachment: f64,
    pub cage_scale: f64,
    pub root_scale: f64,
    pub seed: u64,
    pub max_vertices: u64,
    pub instruments: bool,
    /// 0: none.
    pub distance_ratio: f64,
    /// A mesh of at least twice this number of inputs is made in partitions of about this number
    /// or fewer.
    pub(crate) inputs_per_partition: usize,
}

impl Parameters {
    /// Fills the defaults for `dim` into `options`.
    ///
    /// # Errors
    /// `InvalidArgument`, naming the option, its value and the range.
    pub fn resolve(dim: usize, options: &Options) -> Result<Self> {
        let (bound, lowest, highest) = match options.criterion {
            Criterion::VoronoiAspect => {
                (pick(dim, [3.0, 4.0, 5.0, 6.0]), pick(dim, [2.2, 2.5, 3.5, 4.5]), 100.0)
            }
            Criterion::RadiusEdge => {
                (pick(dim, [1.5, 2.0, 2.5, 3.0]), pick(dim, [1.1, 1.25, 1.75, 2.25]), 50.0)
            }
        };
        // At 1.0 the corner of a D-ball that has inputs always yields, to inputs that are not
        // medial.
        let yield_radius = match options.algorithm {
            Algorithm::Svr => pick(dim, [0.6, 0.9, 0.9, 0.9]),
            _ => 1.0,
        };
        let max_vertices = match options.max_vertices {
            0 => u64::from(u32::MAX - 1),
            given => given.min(u64::from(u32::MAX - 1)),
        };
        let distance_ratio = distance_ratio(options)?;
        // So the hull and its cells are far enough from the cells that are refined.
        let least_root_scale = if distance_ratio > 0.0 { 12.0 } else { 0.0 };
        let root_scale = pick(dim, [2.5, 2.5, 3.0, 4.0]).max(least_root_scale);
        Ok(Self {
            output: options.output,
            algorithm: options.algorithm,
            ordering: options.ordering,
            criterion: options.criterion,
            threads: options.threads,
            quality_bound: number("quality_bound", options.quality_bound, bound, lowest, highest)?,
            epsilon: number("epsilon", options.epsilon, 0.5, 0.05, 0.6)?,
            delta: number("delta", options.delta, pick(dim, [0.8, 1.0, 1.0, 1.0]), 0.1, 1.0)?,
            gamma: number("gamma", options.gamma, 0.1, 0.01, 0.25)?,
            yield_radius: number("yield_radius", options.yield_radius, yield_radius, 0.05, 1.0)?,
            encroachment: number("encroachment", options.encroachment, 1.0, 1.0, 4.0)?,
            cage_scale: number("cage_scale", options.cage_scale, 0.8, 0.3, 0.9)?,
            root_scale: number("root_scale", options.root_scale, root_scale, 2.0, 16.0)?,
            seed: options.seed,
            max_vertices,
            instruments: options.instruments,
            distance_ratio,
            inputs_per_partition: INPUTS_PER_PARTITION,
        })
    }
}

/// The default for 2D, 3D, 4D and everything above.
fn pick(dim: usize, defaults: [f64; 4]) -> f64 {
    defaults[(dim - 2).min(3)]
}

fn distance_ratio(options: &Options) -> Result<f64> {
    let ratio = number("distance_ratio", options.distance_ratio, 0.0, 0.05, 1.0)?;
    if ratio > 0.0
        && (options.output, options.algorithm) != (Output::WellSpaced, Algorithm::Netmesh)
    {
        let message = message!(
            "options.distance_ratio is {ratio}; it is for well-spaced output (options.output) of \
             the algorithm netmesh"
        );
        return Err(Error::new(ErrorKind::InvalidArgument, message));
    }
    Ok(ratio)
}

fn number(name: &str, given: f64, default: f64, lowest: f64, highest: f64) -> Result<f64> {
    if given == 0.0 {
        return Ok(default);
    }
    if !(lowest..=highest).contains(&given) {
        let message = message!(
            "options.{name} is {given}; it must be 0 (default {default}) or in [{lowest}, {highest}]"
        );
        return Err(Error::new(ErrorKind::InvalidArgument, message));
    }
    Ok(given)
}
