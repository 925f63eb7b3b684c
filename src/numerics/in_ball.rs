//! Which side of a circumsphere a point is on, exactly.

use super::exact::in_ball_exact;
use super::sign::Sign;
use super::window::{in_window, planar, spatial};

/// Whether `q` is strictly inside (positive), on (zero) or strictly outside (negative) the sphere
/// through the `D + 1` points of a positively oriented simplex. The sign is reversed for a
/// negatively oriented simplex; for a flat one it says nothing of a ball.
///
/// Exact for all finite coordinates. There is no filter here: ask the simplex's
/// [`Circumball`](super::Circumball) first, and this only where that is undecided.
pub fn in_ball<const D: usize>(simplex: &[&[f64; D]], q: &[f64; D]) -> Sign {
    const { assert!(D >= 2 && D <= 8) };
    debug_assert_eq!(simplex.len(), D + 1);
    if D > 3 || !in_window(simplex.iter().copied().chain([q])) {
        return in_ball_exact(simplex, q);
    }
    if D == 2 {
        let [a, b, c] = [0, 1, 2].map(|i| planar(simplex[i]));
        Sign::of(robust::incircle(a, b, c, planar(q)))
    } else {
        // Positive orientation there is det[a - d, b - d, c - d] > 0, the negative of ours.
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| spatial(simplex[i]));
        Sign::of(robust::insphere(a, b, c, d, spatial(q))).flip()
    }
}
