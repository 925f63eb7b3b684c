//! Slivers: tetrahedra with a small dihedral angle, which no bound of radii excludes. The last step
//! of a run moves Steiner points and inserts some, until no dihedral angle is smaller than asked
//! for.
//!
//! - `shape`: the penalty of a tetrahedron; the objective is the sum over all.
//! - `queue` and `candidates`: slivers that wait, the worst first, and points for slivers that no
//!   move mends, the best first; `log`: changes that may be undone.
//! - `stars`: when stars changed, and when nothing helped their vertices.
//! - `view`: the parts of a mesh by which a change is judged before it is made. `cone` has the
//!   tetrahedra that a point would make over its cavity, `vacancy` the mesh without a vertex that
//!   may move, `cells` the bound of the Voronoi aspect, `boundary` what conforms to facets and
//!   segments.
//! - `work`: all that the work needs beside the mesh; `weigh`: new tetrahedra are measured and
//!   queued.
//! - `changes`: a point goes in, a vertex moves, or a vertex goes; `undo` takes changes back;
//!   `sizes` asks for the sizes at vertices that come or move.
//! - `moves` tries other places for the vertices of a sliver, then for those of its neighbours;
//!   `insertions` finds a further point; `relaxation` inserts points that are worth it only after
//!   their neighbours have moved; `removals` takes out points that others have made needless.
//! - `next_sliver` and `mend`: all of it, with more and more effort.
//!
//! Every change lets the objective fall by `work::LEAST_GAIN` or more, but that every point may be
//! removed once without; so the work ends. No input moves, nor a vertex of a living cage or of the
//! hull. No simplex goes beyond the bound of the criterion, unless the caller lets the bound give
//! way where all else fails. Simplices with vertices of several domains are let alone. A sliver
//! that no effort mends stays.

pub(super) mod boundary;
pub(super) mod candidates;
pub(super) mod cells;
pub(super) mod changes;
pub(super) mod cone;
pub(super) mod insertions;
pub(super) mod log;
pub(super) mod mend;
pub(super) mod moves;
pub(super) mod next_sliver;
pub(super) mod queue;
pub(super) mod random;
pub(super) mod relaxation;
pub(super) mod removals;
pub(super) mod shape;
pub(super) mod sizes;
pub(super) mod stars;
pub(super) mod undo;
pub(super) mod vacancy;
pub(super) mod view;
pub(super) mod weigh;
pub(super) mod work;
