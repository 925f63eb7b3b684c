//! SELECTROUND (§6.5): which inputs go in next. Either a sample of every conflict list's inputs
//! (`sampled`), or their net (`deterministic`): Theorem 3's NET is `greedy`, its two ingredients
//! are `cover` (which balls still hold too many) and `center` (which inputs to take of those).
//!
//! A round must achieve this: the largest number of inputs in one conflict list at least halves. In
//! the paper an input is listed in every D-ball that holds it. A new D-ball is empty of the old
//! mesh M, so at most d old ones cover it (Theorem 10), each with fewer than a 1/(2d) of its inputs
//! in the new one. Here an input is listed in one conflict list only. That leaves the net's
//! property as it is: a ball without a vertex of M and without a point of the net has fewer than
//! 1/(2d) of every conflict list's inputs. But the inputs of a new D-ball may come from more
//! conflict lists than d: from at most C, the number of D-balls that meet an empty ball, a constant
//! while the mesh has quality (Theorem 19). So the round verifies the halving, and where it fails
//! takes nets with 1/(4d), 1/(8d), ... of what is left. A pass with eps leaves at most C eps times
//! the most inputs in a conflict list, so after some 2 log2(C / 2d) passes they have halved: a
//! constant number of constant-size nets of each conflict list, which is what Lemma 31 needs of a
//! round. In no run that we made was a second pass needed.

mod center;
mod cover;
mod deterministic;
mod greedy;
mod sampled;
mod select;

use crate::memory::Id;

/// One of the points that a net is chosen from, by its place among them.
pub(super) type PointId = Id<Point>;

/// Kind of thing that a [`PointId`] names.
pub(super) enum Point {}

#[cfg(test)]
mod tests;
