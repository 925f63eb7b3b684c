//! What the algorithm derives from its parameters (§4, end).

use crate::options::Criterion;
use crate::parameters::Parameters;

/// Largest value of [`Parameters::corner_restriction`].
const CORNER_RESTRICTION: f64 = 0.85;

/// A cage closes if its domain's inputs are within this fraction of its sphere's radius.
const SURROUNDED: f64 = 0.8;

/// How much larger than the bound the quality of the mesh may be while inputs go in; and where the
/// criterion is radius-edge (docs/decisions.md).
const LOOSE: f64 = 3.0;
const LOOSE_EDGES: f64 = 4.5;

impl Parameters {
    /// A Voronoi corner counts for a cell of a domain only within this fraction of the radius of
    /// the domain's cage sphere; corners beyond the hull of the cage are the cage's business.
    pub fn corner_restriction(&self) -> f64 {
        CORNER_RESTRICTION.min(self.hull_radius())
    }

    /// The hull of a delta-net of the unit sphere holds the ball of this radius.
    pub(super) fn hull_radius(&self) -> f64 {
        1.0 - 0.5 * self.delta * self.delta
    }

    /// The bound that CLEAN keeps while inputs go in. The refinement to `quality_bound` comes at
    /// the end: with all inputs in their places it needs fewer points, and moves no input to a new
    /// home.
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
