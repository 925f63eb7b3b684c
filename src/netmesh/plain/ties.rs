//! Points on one sphere. Delaunay triangulations of them are many; one is picked by raising each
//! vertex, lifted to the paraboloid, by an infinitely small height of its own, which grows with the
//! number of the vertex ("simulation of simplicity", Edelsbrunner and Mücke 1990; Devillers and
//! Teillaud 2003). The triangulation then does not depend on the order of insertions.

use crate::numerics::Sign;

/// Returns true if a vertex on the sphere of a simplex counts as inside. `replaced`: the
/// orientation of the simplex with the vertex in a corner's place, positive for the simplex itself.
#[cold]
#[inline(never)]
pub(super) fn counts_as_inside<const N: usize>(
    corners: &[u32; N],
    vertex: u32,
    mut replaced: impl FnMut(usize) -> Sign,
) -> bool {
    let mut places: [usize; N] = std::array::from_fn(|place| place);
    places.sort_unstable_by_key(|&place| std::cmp::Reverse(corners[place]));
    // A raised corner lifts the hyperplane above the vertex where its barycentric coordinate is
    // positive. The vertex itself leaves the ball when it is raised.
    let higher = places.into_iter().take_while(|&place| corners[place] > vertex);
    let decided = higher.map(&mut replaced).find(|&sign| sign != Sign::Zero);
    decided == Some(Sign::Positive)
}
