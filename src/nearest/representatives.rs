//! Points that stand for others near them, for meshes that need not resolve what is nearer.

use super::search::Stop;
use super::tree::{Node, Tree};
use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::{AllocResult, filled};
use crate::mesh::{MAX_DIM, MIN_DIM, NONE, check_finite, in_dimension};
use crate::numerics::{coordinates, distance};

/// Writes for each of the points (`count x dim`) the one that stands for it. Points are taken in
/// their order: each that is not nearer than `cutoff` to a chosen one is chosen and stands for
/// itself; for the others stands the nearest chosen one, of equally near ones the first. Distances
/// are rounded to doubles. O(n log n) for a `cutoff` within which there are few points.
///
/// # Errors
/// `Dimension` (below 2 or above 8), `InvalidArgument` (a length, a `cutoff` that is negative or
/// not finite), `NonFinite` (names point and coordinate), `Capacity` (more points than ids),
/// `Cancelled` (by `stop`), `OutOfMemory`.
pub fn representatives(
    dim: usize,
    points: &[f64],
    cutoff: f64,
    stop: Stop<'_>,
    found: &mut [u32],
) -> Result<()> {
    if !(MIN_DIM..=MAX_DIM).contains(&dim) {
        let message = message!("points have {dim} coordinates; they must have 2 to 8");
        return Err(Error::new(ErrorKind::Dimension, message));
    }
    if points.len() != found.len() * dim {
        let (length, count) = (points.len(), found.len());
        let message = message!("points has length {length}; it must be {count} x {dim}");
        return Err(Error::invalid(message));
    }
    if found.len() >= NONE as usize {
        let message = message!("there are {} points, more than ids", found.len());
        return Err(Error::new(ErrorKind::Capacity, message));
    }
    if !(0.0..f64::INFINITY).contains(&cutoff) {
        let message = message!("cutoff is {cutoff}; it must be at least 0 and finite");
        return Err(Error::invalid(message));
    }
    check_finite(dim, points)?;
    let made = in_dimension!(
        dim,
        D => choose::<D>(points, cutoff, stop, found),
        _ => return Err(Error::invalid("dim is out of range"))
    );
    made?;
    match stop.is_set() {
        true => Err(Error::new(ErrorKind::Cancelled, "the choice of points was stopped")),
        false => Ok(()),
    }
}

fn choose<const D: usize>(
    points: &[f64],
    cutoff: f64,
    stop: Stop<'_>,
    found: &mut [u32],
) -> AllocResult<()> {
    let tree = Tree::of_all::<D>(points)?;
    let mut least = filled(found.len(), cutoff)?;
    found.fill(NONE);
    for at in 0..found.len() {
        if stop.is_set() {
            break;
        }
        if found[at] != NONE {
            continue;
        }
        let (number, q) = (at as u32, coordinates::<D>(points, at));
        found[at] = number;
        each_within(&tree, 1, q, cutoff, &mut |id: u32, length| {
            let other = id as usize;
            // Earlier points that are no chosen ones may be nearer to this one, too.
            if length < least[other] && found[other] != id {
                (found[other], least[other]) = (number, length);
            }
        });
    }
    Ok(())
}

/// Calls `act` with each point that is nearer to `q` than `radius`, below a node, and its distance.
fn each_within<const D: usize>(
    tree: &Tree,
    node: usize,
    q: &[f64; D],
    radius: f64,
    act: &mut impl FnMut(u32, f64),
) {
    let Some(Node { value, axis }) = tree.node(node) else {
        for (id, point) in tree.members::<D>(tree.leaf_at(node)) {
            let length = distance(q, point);
            if length < radius {
                act(id, length);
            }
        }
        return;
    };
    let beyond = q[axis as usize] - value;
    let near = 2 * node + usize::from(beyond >= 0.0);
    each_within(tree, near, q, radius, act);
    // Distances are rounded.
    if beyond.abs() <= radius * (1.0 + 1e-14) {
        each_within(tree, near ^ 1, q, radius, act);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::{FAMILIES, Random, points};
    use std::sync::atomic::AtomicBool;

    /// Chooses points by the distances of all pairs.
    fn by_pairs<const D: usize>(points: &[[f64; D]], cutoff: f64) -> Vec<u32> {
        let mut chosen: Vec<usize> = Vec::new();
        let mut found = Vec::new();
        for (at, x) in points.iter().enumerate() {
            let length = |other: &usize| distance(x, &points[*other]);
            let near = chosen.iter().copied().filter(|other| length(other) < cutoff);
            let standing = near.min_by(|a, b| length(a).total_cmp(&length(b)));
            if standing.is_none() {
                chosen.push(at);
            }
            found.push(standing.unwrap_or(at) as u32);
        }
        // A point may be nearer to one that is chosen after it.
        for (at, x) in points.iter().enumerate() {
            let length = |other: &usize| distance(x, &points[*other]);
            if found[at] != at as u32 {
                let best = chosen.iter().copied().min_by(|a, b| length(a).total_cmp(&length(b)));
                found[at] = best.unwrap() as u32;
            }
        }
        found
    }

    fn agree<const D: usize>() {
        let mut merged = 0;
        for family in FAMILIES {
            let given = points::<D>(family, 200, &mut Random(family as u64 + 7));
            let length = distance(&given[0], &given[1]);
            for factor in [0.0, 0.01, 0.3, 2.0] {
                let cutoff = factor * length;
                if !cutoff.is_finite() {
                    continue;
                }
                let mut found = vec![0; given.len()];
                let stop = Stop::default();
                representatives(D, given.as_flattened(), cutoff, stop, &mut found).unwrap();
                assert_eq!(found, by_pairs(&given, cutoff), "{family:?} {factor}");
                merged += found.iter().zip(0..).filter(|&(id, at)| *id != at).count();
            }
        }
        assert!(merged > 1000, "{merged}");
    }

    #[test]
    fn the_nearest_chosen_point_stands_for_others() {
        agree::<2>();
        agree::<3>();
        agree::<5>();
    }

    #[test]
    fn what_is_wrong_is_refused() {
        let refusal = |dim, points: &[f64], cutoff, count| {
            let made = representatives(dim, points, cutoff, Stop::default(), &mut vec![0; count]);
            made.unwrap_err().message().to_owned()
        };
        let points = [0.0, 1.0, f64::NAN, 3.0];
        assert_eq!(refusal(9, &points, 1.0, 1), "points have 9 coordinates; they must have 2 to 8");
        assert_eq!(refusal(2, &points, 1.0, 1), "points has length 4; it must be 1 x 2");
        let rule = "cutoff is -1; it must be at least 0 and finite";
        assert_eq!(refusal(2, &points, -1.0, 2), rule);
        let rule = "points[1] has a non-finite coordinate 0: NaN; every coordinate must be finite";
        assert_eq!(refusal(2, &points, 1.0, 2), rule);
        let switch = AtomicBool::new(true);
        let made = representatives(2, &[0.0; 4], 1.0, Stop::new(&switch), &mut [0; 2]);
        assert_eq!(made.unwrap_err().kind(), ErrorKind::Cancelled);
    }
}
