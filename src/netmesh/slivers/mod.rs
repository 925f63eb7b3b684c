//! Slivers: tetrahedra with a small dihedral angle, which no bound of radii excludes. The last
//! phase moves Steiner points and inserts some, until no dihedral angle is smaller than asked for.
//!
//! `shape` says how bad a tetrahedron is; the objective is the sum over all. `queue` has those that
//! are bad, the worst first. For each, `moves` tries its vertices at other places, then those of
//! its neighbours; where nothing helps `insertions` finds a further point, which waits among the
//! `offers`. `relaxation` has points that are worth it only after their neighbours have moved, and
//! `removals` takes points out that others have made needless. What a place is worth is judged
//! without a change: the tetrahedra that a point would make are the `cone` over its cavity;
//! `vacancy` is the mesh without a vertex that may move. Changes that may not be worth it are in
//! the `journal` till that is known. `cells` has what the Voronoi aspect needs beside, `sizes` what
//! is asked for.
//!
//! Every change lets the objective fall by [`LEAST_GAIN`] or more, but that every point may be
//! removed once without; so the phase ends. No input moves, nor a vertex of a living cage or of the
//! hull. No simplex goes beyond the bound of the criterion, unless the caller lets the bound give
//! way where all else fails (`beyond`). Simplices with vertices of several domains are let alone.
//! What is left when all efforts fail stays a sliver.

pub(super) mod candidates;
pub(super) mod cells;
pub(super) mod changes;
pub(super) mod cone;
pub(super) mod insertions;
pub(super) mod journal;
pub(super) mod moves;
pub(super) mod offers;
pub(super) mod phase;
pub(super) mod queue;
pub(super) mod random;
pub(super) mod relaxation;
pub(super) mod removals;
pub(super) mod shape;
pub(super) mod sizes;
pub(super) mod undo;
pub(super) mod vacancy;
pub(super) mod view;
pub(super) mod weigh;
pub(super) mod work;
