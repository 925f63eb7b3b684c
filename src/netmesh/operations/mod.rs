//! The operations of the paper (§6.3, §6.4), and those of segments.
//!
//! ```text
//!        . - ~ - .            o  a vertex of the cage, near the sphere of radius
//!     o             o            cage_scale * r round the centre
//!   '     domain      '       c  the centre: a vertex, and Omega's representative in
//!  o         c         o         the parent domain
//!   .     ball of     .       r  the radius of the domain's ball; its inputs are within
//!     o   radius r  o            epsilon * r of c, and no vertex of the parent is nearer
//!        ' - o - '               to c than r / epsilon
//! ```
//!
//! - `template`: the vertices of a cage, relative to its centre and radius.
//! - `release`: RELEASECAGE, and OUTENCROACH.
//! - `cage`: NEWCAGE and GROWCAGE.
//! - `insert_input`: INSERTINPUT.
//! - `recover`: subsegments are split until they are edges; `recover_facets`: subfacets, until they
//!   are faces; `recover_boundary`: both, and what a Steiner point would encroach, as far as the
//!   `guard` lets it be split.
//! - `split`: a vertex goes on a line, or into a facet.
//! - `shield`: ends of lines get balls that no vertex of the boundary goes into.
//! - `crowding`: vertices of the boundary that are on top of others.
//! - `yielding_insert`: YIELDINGINSERT of a Steiner point.
//! - `cage_gap`: a gap between the vertices of a cage is narrowed.
//! - `clean`: CLEAN.

pub(super) mod cage;
pub(super) mod cage_gap;
pub(super) mod clean;
pub(super) mod crowding;
pub(super) mod guard;
pub(super) mod insert_input;
pub(super) mod recover;
pub(super) mod recover_boundary;
pub(super) mod recover_facets;
pub(super) mod release;
pub(super) mod shield;
pub(super) mod split;
pub(super) mod template;
pub(super) mod yielding_insert;
