//! The meshing parameters (§4, end): defaults per dimension, and the ranges that are accepted.

use crate::error::{Error, ErrorKind, Result, message};
use crate::options::{Algorithm, Criterion, NetOrdering, Options, Output};

/// Largest value of [`Parameters::corner_restriction`].
const CORNER_RESTRICTION: f64 = 0.85;

/// A cage closes if its domain's inputs are within this fraction of its sphere's radius.
const SURROUNDED: f64 = 0.8;

/// How much larger than the bound the quality of the mesh may be while inputs go in; and where the
/// criterion is radius-edge (docs/decisions.md).
const LOOSE: f64 = 3.0;
const LOOSE_EDGES: f64 = 4.5;

/// The more, the less is left at rims; the fewer, the more threads have work.
const INPUTS_OF_PART: usize = 1 << 18;

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
    /// From twice so many inputs on a mesh is made in parts (`parts`) of about so many or fewer.
    pub(super) inputs_of_part: usize,
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
        // At 1.0 the corner of a D-ball that has inputs always yields, to inputs that are not medial.
        let yield_radius = match options.algorithm {
            Algorithm::Svr => pick(dim, [0.6, 0.9, 0.9, 0.9]),
            _ => 1.0,
        };
        let max_vertices = match options.max_vertices {
            0 => u64::from(u32::MAX - 1),
            given => given.min(u64::from(u32::MAX - 1)),
        };
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
            root_scale: number(
                "root_scale",
                options.root_scale,
                pick(dim, [2.5, 2.5, 3.0, 4.0]),
                2.0,
                16.0,
            )?,
            seed: options.seed,
            max_vertices,
            instruments: options.instruments,
            inputs_of_part: INPUTS_OF_PART,
        })
    }
}

impl Parameters {
    /// A Voronoi corner counts for a cell of a domain only within this fraction of the radius of the
    /// domain's cage sphere; corners beyond the hull of the cage are the cage's business.
    pub fn corner_restriction(&self) -> f64 {
        CORNER_RESTRICTION.min(self.hull_radius())
    }

    /// The hull of a delta-net of the unit sphere holds the ball of this radius.
    pub(super) fn hull_radius(&self) -> f64 {
        1.0 - 0.5 * self.delta * self.delta
    }

    /// The bound that CLEAN keeps while inputs go in. The refinement to `quality_bound` comes at the end:
    /// with all inputs in their places it needs fewer points, and moves no input to a new home.
    pub(super) fn loose_bound(&self) -> f64 {
        let factor = match self.criterion {
            Criterion::VoronoiAspect => LOOSE,
            Criterion::RadiusEdge => LOOSE_EDGES,
        };
        factor * self.quality_bound
    }

    /// Whether the cells of a domain (index 0: the root) get their quality over all corners at the
    /// end, not only over those within the corner restriction: its cage must surround its inputs.
    /// The root's always does.
    pub fn closes(&self, domain: u32) -> bool {
        domain == 0 || self.closes_all()
    }

    pub(super) fn closes_all(&self) -> bool {
        self.epsilon <= SURROUNDED * self.cage_scale
    }
}

/// The default for 2D, 3D, 4D and everything above.
fn pick(dim: usize, defaults: [f64; 4]) -> f64 {
    defaults[(dim - 2).min(3)]
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
