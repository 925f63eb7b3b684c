//! Two questions about facets: do they form closed surfaces, so that they alone determine what they
//! enclose, and do they enclose anything.

use super::sides::{Side, Sides};
use crate::arrangement::poll::Poll;
use crate::error::{Choice, Error, ErrorKind, Result, say};
use crate::memory::{Sets, TryGrow, collected};
use crate::mesh::{Arrangement, Inputs};
use crate::numerics::{coordinates, orientation};
use crate::options::Interior;
use std::cmp::Ordering;
use std::fmt::{self, Display, Formatter};

/// Number of polls' units of work for one edge.
const WORK: u32 = 1;

/// Fails unless the facets of an arrangement form closed surfaces. For parity, every edge must be
/// one of an even number of triangles; for winding, as many triangles must run through it in one
/// direction as in the other. O(n log n).
///
/// # Errors
/// `InvalidArgument` (an edge where surfaces do not close), `OutOfMemory`, and those of `poll`.
pub fn check_closed_in_space(
    inputs: &Inputs,
    arrangement: &Arrangement,
    interior: Interior,
    poll: Poll<'_>,
) -> Result<()> {
    match first_open(arrangement, interior, poll)? {
        Some((ends, counts)) => Err(open_at(inputs, arrangement, ends, counts, interior)),
        None => Ok(()),
    }
}

/// Returns true if the rule `interior` puts a region that the facets of an arrangement bound
/// inside. Open surfaces enclose nothing under a rule that asks for closed ones. O(n log n).
///
/// # Errors
/// `OutOfMemory`, and those of `poll`.
pub fn encloses_in_space(
    inputs: &Inputs,
    arrangement: &Arrangement,
    interior: Interior,
    poll: Poll<'_>,
) -> Result<bool> {
    if first_open(arrangement, interior, poll)?.is_some() {
        return Ok(false);
    }
    // The regions before and behind a triangle differ by its balance, so that one of them is inside
    // where the balance counts.
    let mut balances =
        arrangement.triangles.iter().map(|one| arrangement.facets[one.facet as usize].balance);
    match interior {
        Interior::Auto | Interior::Seeds => separates(inputs, arrangement, poll),
        Interior::Parity => Ok(balances.any(|balance| balance % 2 != 0)),
        Interior::Winding => Ok(balances.any(|balance| balance != 0)),
    }
}

/// Returns the first edge at which a surface is open, with the numbers of triangles that run
/// through it upwards and downwards, those that are there several times counted so.
/// [`Interior::Seeds`] does not need closed surfaces.
fn first_open(
    arrangement: &Arrangement,
    interior: Interior,
    poll: Poll<'_>,
) -> Result<Option<([u32; 2], [u64; 2])>> {
    if matches!(interior, Interior::Auto | Interior::Seeds) {
        return Ok(None);
    }
    let triangles = collected(arrangement.triangles.iter().map(|triangle| triangle.vertices))?;
    let balance = |side: &Side| {
        let facet = arrangement.triangles[side.triangle as usize].facet;
        arrangement.facets[facet as usize].balance
    };
    for group in Sides::of_triangles(&triangles, poll)?.groups() {
        poll(WORK)?;
        let (mut up, mut down) = (0, 0);
        for side in group {
            let runs_up = side.runs_up(&triangles) == (balance(side) > 0);
            *if runs_up { &mut up } else { &mut down } += balance(side).unsigned_abs();
        }
        let is_open = match interior {
            Interior::Parity => (up + down) % 2 != 0,
            _ => up != down,
        };
        if is_open {
            return Ok(Some((group[0].ends, [up, down])));
        }
    }
    Ok(None)
}

fn open_at(
    inputs: &Inputs,
    arrangement: &Arrangement,
    ends: [u32; 2],
    [up, down]: [u64; 2],
    interior: Interior,
) -> Error {
    let [from, to] = ends.map(|end| End { inputs, arrangement, vertex: end as usize });
    let all = up + down;
    let rule = Choice::Interior(interior);
    let message = match interior {
        Interior::Parity => say!(
            "the edge between {from} and {to} is one of {all} triangles; with ",
            rule,
            " that number must be even at every edge, so that all surfaces are closed"
        ),
        _ => say!(
            "{up} triangles run from {from} to {to} and {down} back; with ",
            rule,
            " these must be equally many at every edge, so that all surfaces are closed"
        ),
    };
    Error::new(ErrorKind::InvalidArgument, message)
}

/// End of an edge, as the caller knows it.
struct End<'a> {
    inputs: &'a Inputs,
    arrangement: &'a Arrangement,
    vertex: usize,
}

impl<'a> End<'a> {
    fn point(&self) -> &'a [f64; 3] {
        match self.vertex.checked_sub(self.inputs.distinct()) {
            None => coordinates(self.inputs.distinct_point(self.vertex), 0),
            Some(crossing) => &self.arrangement.corners[crossing],
        }
    }
}

impl Display for End<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self.inputs.first_input(self.vertex) {
            Some(input) => write!(f, "input {input}"),
            None => {
                let [x, y, z] = self.point();
                write!(f, "the crossing at ({x}, {y}, {z})")
            }
        }
    }
}

/// Returns true if the facets divide space.
///
/// A triangle divides it if no way leads from its front to its back over the fronts and backs of
/// triangles around edges: pieces of the surface that share no more than a vertex can be drawn
/// apart there, which divides or joins nothing, and then the ways along a connected surface reach
/// all that bounds one region.
fn separates(inputs: &Inputs, arrangement: &Arrangement, poll: Poll<'_>) -> Result<bool> {
    let triangles = collected(arrangement.triangles.iter().map(|triangle| triangle.vertices))?;
    // Connected fronts (2 i) and backs (2 i + 1).
    let mut connected = Sets::new(2 * triangles.len())?;
    let mut around: Vec<Side> = Vec::new();
    for group in Sides::of_triangles(&triangles, poll)?.groups() {
        poll(WORK)?;
        around.clear();
        around.try_extend(group)?;
        if around.len() > 2 {
            sort_around(inputs, arrangement, &triangles, &mut around);
        }
        for (at, one) in around.iter().enumerate() {
            let next = &around[(at + 1) % around.len()];
            // Turning counterclockwise about the edge, a triangle that runs up is met at its back.
            let front = usize::from(!one.runs_up(&triangles));
            let back = usize::from(next.runs_up(&triangles));
            let (from, to) = (2 * one.triangle as usize + front, 2 * next.triangle as usize + back);
            connected.join(from, to);
        }
    }
    let mut sides = 0..triangles.len();
    Ok(sides.any(|at| connected.find(2 * at) != connected.find(2 * at + 1)))
}

/// Sorts the triangles at an edge counterclockwise, as the edge points to the eye.
fn sort_around(
    inputs: &Inputs,
    arrangement: &Arrangement,
    triangles: &[[u32; 3]],
    around: &mut [Side],
) {
    let point = |vertex: u32| End { inputs, arrangement, vertex: vertex as usize }.point();
    let [from, to] = around[0].ends.map(point);
    let first = point(around[0].within(triangles).1);
    let turn = |a: &[f64; 3], b: &[f64; 3]| orientation(&[from, to, a, b]);
    let half = |x: &[f64; 3]| match turn(first, x) {
        _ if x == first => 0,
        sign if sign.is_positive() => 1,
        sign if sign.is_zero() => 2,
        _ => 3,
    };
    around.sort_unstable_by(|a, b| {
        let [a, b] = [a, b].map(|side| point(side.within(triangles).1));
        half(a).cmp(&half(b)).then_with(|| match turn(a, b) {
            sign if sign.is_positive() => Ordering::Less,
            sign if sign.is_negative() => Ordering::Greater,
            _ => Ordering::Equal,
        })
    });
}
