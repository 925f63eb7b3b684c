//! The boundary of the box or of the convex hull of the inputs, as triangles of plane sides.

use super::hull::{Hull, Role, convex_hull, corners_of_simplex};
use super::merge::{Surface, merged};
use super::pieces::{Piece, Pieces};
use super::polygon::INTERIOR;
use super::sides::Sides;
use crate::arrangement::poll::Poll;
use crate::error::{Choice, Error, ErrorKind, Result, say};
use crate::memory::{AllocResult, Sets, TryGrow, collected, filled};
use crate::mesh::{Feature, NONE};
use crate::numerics::orientation;
use crate::options::Extent;

/// Sides of a box between its corners, of which bit k of a number tells whether it is high on axis
/// k; counterclockwise from outside.
const SIDES_OF_A_BOX: [[usize; 4]; 6] =
    [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];

/// Boundary of an extent: a convex surface.
#[derive(Default)]
pub(super) struct Frame {
    /// Vertices of its triangles, counterclockwise from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Triangle -> the side that it is of. Triangles of one side lie in one plane.
    pub sides: Vec<u32>,
    /// Number of sides.
    pub count: u32,
    /// Points outside, by no more than rounding explains.
    pub outside: Vec<u32>,
}

/// Appends the corners of the bounding box of some points to these, unless they are among them, and
/// returns them all.
pub(super) fn add_corners(points: &mut Vec<[f64; 3]>) -> AllocResult<[u32; 8]> {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for x in points.iter() {
        for k in 0..3 {
            (low[k], high[k]) = (low[k].min(x[k]), high[k].max(x[k]));
        }
    }
    let corner = |at: usize| -> [f64; 3] {
        std::array::from_fn(|k| if at >> k & 1 == 1 { high[k] } else { low[k] })
    };
    let mut corners = [NONE; 8];
    for (number, x) in (0u32..).zip(points.iter()) {
        if (0..3).all(|k| x[k] == low[k] || x[k] == high[k]) {
            for (_, own) in corners.iter_mut().enumerate().filter(|&(at, _)| corner(at) == *x) {
                *own = number;
            }
        }
    }
    for (at, own) in corners.iter_mut().enumerate().filter(|(_, own)| **own == NONE) {
        *own = points.len() as u32;
        points.try_push(corner(at))?;
    }
    Ok(corners)
}

impl Frame {
    /// Makes the frame of a box between its corners.
    pub fn of_box(points: &[[f64; 3]], corners: [u32; 8]) -> Result<Self> {
        let own = collected(corners.iter().map(|&corner| points[corner as usize]))?;
        if corners_of_simplex(&own)?.is_none() {
            return Err(no_volume(Extent::Box));
        }
        let mut frame = Self { count: 6, ..Self::default() };
        for (side, quad) in (0u32..).zip(SIDES_OF_A_BOX) {
            let [a, b, c, d] = quad.map(|at| corners[at]);
            frame.triangles.try_extend(&[[a, b, c], [a, c, d]])?;
            frame.sides.try_extend(&[side; 2])?;
        }
        Ok(frame)
    }

    /// Makes the frame of the convex hull of all points: the exact hull, whose sides are exactly
    /// plane, or with `roles`, [`convex_hull`] up to rounding, with sides that are plane up to
    /// rounding.
    pub fn of_hull(points: &[[f64; 3]], roles: Option<&[Role]>, poll: Poll<'_>) -> Result<Self> {
        let Some(hull) = convex_hull(points, roles, poll)? else {
            return Err(no_volume(Extent::Hull));
        };
        let Hull { triangles, outside } = hull;
        let firsts = match roles {
            Some(_) => {
                let kinds = filled(triangles.len(), 0)?;
                let origins = collected(0..triangles.len() as u32)?;
                let (kinds, origins) = (&kinds, &origins);
                let given = &triangles;
                let surface = Surface { triangles: &triangles, kinds, origins, given, pairs: None };
                merged(points, &surface, 0.0, poll)?
            }
            None => exactly_plane(points, &triangles, poll)?,
        };
        let (mut count, mut numbers) = (0, filled(triangles.len(), NONE)?);
        for (at, &first) in firsts.iter().enumerate() {
            if first as usize == at {
                numbers[at] = count;
                count += 1;
            }
        }
        let sides = collected(firsts.iter().map(|&first| numbers[first as usize]))?;
        Ok(Self { triangles, sides, count, outside })
    }

    /// Returns the edges at which sides end, each in the direction of its triangle, with the side.
    pub fn rims(&self) -> AllocResult<Vec<([u32; 2], u32)>> {
        let edges = |(&[a, b, c], &side): (&[u32; 3], &u32)| {
            [([a, b], side), ([b, c], side), ([c, a], side)]
        };
        let mut all = collected(self.triangles.iter().zip(&self.sides).flat_map(edges))?;
        all.sort_unstable();
        let is_inner =
            |&([a, b], side): &([u32; 2], u32)| all.binary_search(&([b, a], side)).is_ok();
        collected(all.iter().filter(|edge| !is_inner(edge)).copied())
    }

    /// Returns the triangles as pieces of their sides.
    pub fn pieces(&self, rims: &[([u32; 2], u32)]) -> AllocResult<Pieces> {
        let piece = |(&vertices, &side): (&[u32; 3], &u32)| {
            let mut inner = INTERIOR;
            for (from, to) in [(0, 1), (1, 2), (2, 0)] {
                let edge = ([vertices[from], vertices[to]], side);
                let is_inner = rims.binary_search(&edge).is_err();
                inner |= u8::from(is_inner) << (1 << from | 1 << to);
            }
            Piece::of_triangle(vertices, inner, Feature::Facet(side))
        };
        let all = collected(self.triangles.iter().zip(&self.sides).map(piece))?;
        Ok(Pieces { all, ..Pieces::default() })
    }
}

fn no_volume(extent: Extent) -> Error {
    let message = say!(
        Choice::Extent(extent),
        " has no volume: all inputs are in a plane, but for roundings"
    );
    Error::new(ErrorKind::DegenerateInput, message)
}

/// Returns for each triangle of a convex surface the first one in exactly its plane.
fn exactly_plane(points: &[[f64; 3]], triangles: &[[u32; 3]], poll: Poll<'_>) -> Result<Vec<u32>> {
    let mut planes = Sets::new(triangles.len())?;
    for group in Sides::of_triangles(triangles, poll)?.groups() {
        let &[one, other] = group else { continue };
        let [a, b, c] = triangles[one.triangle as usize].map(|at| &points[at as usize]);
        let apex = other.within(triangles).1;
        if orientation(&[a, b, c, &points[apex as usize]]).is_zero() {
            planes.join(one.triangle as usize, other.triangle as usize);
        }
    }
    Ok(collected((0..triangles.len()).map(|at| planes.find(at) as u32))?)
}
