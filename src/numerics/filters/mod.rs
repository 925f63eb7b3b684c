//! Signs and circumballs in f64, each with a bound of its error: a sign that is larger than the
//! bound is certain. Undecided signs are left to [`exact`](super::exact).
//!
//! `orientation` and `in_ball` answer for one simplex. `circumball` computes a centre and a radius
//! once, and then decides for every point in a few operations: it is the filter of all conflict
//! tests. `rounded_ball` is what a complex keeps of it. The centre comes from `cramer` for ordinary
//! simplices, from `solve` for others, and from integers where both are too inaccurate. `at_sight`
//! knows degenerate positions by comparisons. `hyperplane` computes a normal once, and then places
//! points and boxes. `determinant` serves these, and `f64x2` others too.
//!
//! A formula may enter if its comment proves the bound of its error for all finite coordinates.

mod at_sight;
mod circumball;
mod cramer;
mod determinant;
mod f64x2;
mod hyperplane;
mod in_ball;
mod orientation;
mod precise;
mod rounded_ball;
mod solve;

pub use at_sight::are_flat_at_sight;
pub use circumball::Circumball;
pub(crate) use f64x2::{F64x2, Real};
pub(crate) use hyperplane::Hyperplane;
pub use in_ball::{in_ball, in_ball_with_care};
pub use orientation::{determinant_filtered, orientation, orientation_filtered};
pub use precise::precise_determinant;
pub use rounded_ball::RoundedBall;
