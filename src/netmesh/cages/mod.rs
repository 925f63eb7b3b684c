//! Cages (§4, §6.3): meshes of different scales, one inside the other.
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
//! `domains` is the tree of balls, `encroach` tells which cages a point is too close to (Definition
//! 2), `site` where a cage goes and how large it is, `template` how its vertices lie, and `cage`
//! has the three operations NEWCAGE, GROWCAGE and RELEASECAGE.
//!
//! What makes, moves or removes a cage belongs here.

mod cage;
pub(super) mod domains;
pub(super) mod encroach;
mod release;
pub(super) mod site;
pub(super) mod template;
