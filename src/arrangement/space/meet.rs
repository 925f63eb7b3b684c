//! The exact meeting of two triangles or segments in space.
//!
//! The set that two of them share is convex, and its corners are of few kinds: a vertex of one in a
//! face of the other, an edge of one that crosses an edge or the interior of the other. Each corner
//! is told by the least face of either that holds it, a set of vertices, which signs determine
//! exactly; two corners are one point just if their faces are the same. Vertices are known by
//! number, so that equal numbers are all that is needed to see what is shared by right.

use super::projection::Projection;
use crate::mesh::IntersectionKind;
use crate::numerics::{
    Sign, orientation, point_between, scale_by_power, scale_of_products, scaled_determinant,
};
use std::array::from_fn;

/// Face of a triangle or segment, as the set of its vertices: bit i stands for vertex i.
pub(super) type Face = u8;

/// Largest number of corners that what two triangles share has.
const MOST_CORNERS: usize = 6;

/// Corners of what two triangles or segments share, of which at least one is not shared by number
/// unless the two are one triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Meeting {
    /// Corner -> the least face of each that holds it.
    corners: [[Face; 2]; MOST_CORNERS],
    count: usize,
    /// True if both are triangles.
    are_triangles: bool,
}

/// Returns the meeting of two triangles or segments, given by their vertices; `None` if they share
/// nothing but faces that both have. Triangles must have an area. Exact.
pub(super) fn meet(points: &[[f64; 3]], one: &[u32], other: &[u32]) -> Option<Meeting> {
    let mut meeting = match (one.len(), other.len()) {
        (3, 3) => triangles(points, [one, other].map(as_triangle))?,
        (2, 3) => across(points, one, as_triangle(other), false)?,
        (3, 2) => across(points, other, as_triangle(one), true)?,
        _ => segments(points, [one, other])?,
    };
    let is_shared = |faces: &[Face; 2]| {
        let [a, b] = faces.map(|face| (face.count_ones() == 1).then(|| face.trailing_zeros()));
        a.zip(b).is_some_and(|(a, b)| one[a as usize] == other[b as usize])
    };
    meeting.are_triangles = one.len() == 3 && other.len() == 3;
    let corners = &mut meeting.corners[..meeting.count];
    // A corner that is not shared comes first.
    corners.sort_unstable_by_key(is_shared);
    let is_fault = meeting.count == 3 && corners.iter().all(is_shared)
        || corners.first().is_some_and(|first| !is_shared(first));
    is_fault.then_some(meeting)
}

impl Meeting {
    /// Returns the kind of the meeting of two features that the triangles or segments are parts of.
    /// Bit f of `inner` is set if face f is in the interior of the feature.
    pub fn kind(&self, inner: [u8; 2]) -> IntersectionKind {
        let corners = &self.corners[..self.count];
        let faces = [0, 1].map(|which| corners.iter().fold(0, |face, own| face | own[which]));
        let is_inside = [0, 1].map(|which| inner[which] >> faces[which] & 1 == 1);
        match (self.count, is_inside) {
            (3.., _) => IntersectionKind::Overlap,
            (2, _) if !self.are_triangles => IntersectionKind::Overlap,
            (2, [false, false]) => IntersectionKind::Overlap,
            (_, [true, true]) => IntersectionKind::Cross,
            _ => IntersectionKind::Touch,
        }
    }

    /// Returns true if two triangles share an area, so that they are in one plane.
    pub fn is_area(&self) -> bool {
        self.are_triangles && self.count > 2
    }

    /// Returns a point that both share, but for roundings: the middle of two corners.
    pub fn point(&self, points: &[[f64; 3]], one: &[u32], other: &[u32]) -> [f64; 3] {
        let corner = |at: usize| corner(points, [one, other], self.corners[at]);
        let (first, last) = (corner(0), corner(self.count - 1));
        point_between(&first, &last, 0.5)
    }

    /// Returns the corners of what both share, each as the least face of either that holds it.
    pub fn corners(&self) -> &[[Face; 2]] {
        &self.corners[..self.count]
    }

    fn new() -> Self {
        Self { corners: [[0; 2]; MOST_CORNERS], count: 0, are_triangles: false }
    }

    /// Adds a corner, unless it is known.
    fn add(&mut self, faces: [Face; 2]) {
        let is_known = self.corners[..self.count].contains(&faces);
        if !is_known && self.count < MOST_CORNERS {
            self.corners[self.count] = faces;
            self.count += 1;
        }
    }
}

fn as_triangle(vertices: &[u32]) -> [u32; 3] {
    [vertices[0], vertices[1], vertices[2]]
}

/// Returns the sides of the plane of a triangle on which vertices are. Its own vertices are on it,
/// by number.
fn sides(points: &[[f64; 3]], triangle: [u32; 3], vertices: &[u32]) -> [Sign; 3] {
    let [a, b, c] = triangle.map(|vertex| &points[vertex as usize]);
    from_fn(|at| match vertices.get(at) {
        Some(vertex) if !triangle.contains(vertex) => {
            orientation(&[a, b, c, &points[*vertex as usize]])
        }
        _ => Sign::Zero,
    })
}

/// Returns true if vertices on these sides of a plane meet it in no more than what they share with
/// a triangle there.
fn are_apart(sides: &[Sign; 3], vertices: &[u32], triangle: [u32; 3]) -> bool {
    let own = vertices.iter().zip(sides).filter(|(vertex, _)| !triangle.contains(vertex));
    let mut own = own.map(|(_, &side)| side);
    own.next().is_none_or(|first| first != Sign::Zero && own.all(|side| side == first))
}

fn triangles(points: &[[f64; 3]], [one, other]: [[u32; 3]; 2]) -> Option<Meeting> {
    let is_same = one.iter().all(|vertex| other.contains(vertex));
    let of_other = sides(points, one, &other);
    if !is_same && are_apart(&of_other, &other, one) {
        return None;
    }
    let are_in_one_plane = of_other == [Sign::Zero; 3];
    if are_in_one_plane && !is_same && are_apart_in_plane(points, [one, other])? {
        return None;
    }
    let of_one = if are_in_one_plane { of_other } else { sides(points, other, &one) };
    if !are_in_one_plane && are_apart(&of_one, &one, other) {
        return None;
    }
    let mut meeting = Meeting::new();
    add_rim(points, (&one, of_one), other, &mut |faces| meeting.add(faces))?;
    add_rim(points, (&other, of_other), one, &mut |[b, a]| meeting.add([a, b]))?;
    Some(meeting)
}

/// Returns true if two triangles in one plane meet in no more than what they share, as an edge of
/// one tells: all vertices of the other that it does not share are beyond. Of triangles that meet
/// in no area one has such an edge, unless they touch. `None` if one has no area.
fn are_apart_in_plane(points: &[[f64; 3]], both: [[u32; 3]; 2]) -> Option<bool> {
    let corners = |triangle: [u32; 3]| triangle.map(|vertex| &points[vertex as usize]);
    let projection = Projection::of_triangle(corners(both[0]))?;
    let is_beyond = |one: [u32; 3], turn: Sign, other: [u32; 3], k: usize| {
        let [a, b] = [(k + 1) % 3, (k + 2) % 3].map(|end| &points[one[end] as usize]);
        let side = |vertex: u32| projection.turn([a, b, &points[vertex as usize]]) * turn;
        let mut others = other.iter().filter(|vertex| !one.contains(vertex));
        !other.contains(&one[k]) && others.all(|&vertex| side(vertex).is_negative())
    };
    let [first, second] = both;
    let turns = both.map(|triangle| projection.turn(corners(triangle)));
    let is_apart =
        |k: usize| is_beyond(first, turns[0], second, k) || is_beyond(second, turns[1], first, k);
    Some((0..3).any(is_apart))
}

/// Returns the meeting of a segment and a triangle, of which the triangle comes first if
/// `is_second` is set.
fn across(
    points: &[[f64; 3]],
    segment: &[u32],
    triangle: [u32; 3],
    is_second: bool,
) -> Option<Meeting> {
    let own = sides(points, triangle, segment);
    if are_apart(&own, segment, triangle) {
        return None;
    }
    let mut meeting = Meeting::new();
    let mut add = |[a, b]: [Face; 2]| meeting.add(if is_second { [b, a] } else { [a, b] });
    add_rim(points, (segment, own), triangle, &mut add)?;
    Some(meeting)
}

/// Calls `add` with the corners in which the vertices and edges of a triangle or segment meet a
/// triangle, given the sides of the triangle's plane on which the vertices are. `None` if the
/// triangle has no area.
fn add_rim(
    points: &[[f64; 3]],
    (rim, sides): (&[u32], [Sign; 3]),
    triangle: [u32; 3],
    add: &mut impl FnMut([Face; 2]),
) -> Option<()> {
    let point = |vertex: u32| &points[vertex as usize];
    let corners = triangle.map(point);
    let mut known = None;
    let mut in_plane = || *known.get_or_insert_with(|| Projection::of_triangle(corners));
    for (at, &vertex) in rim.iter().enumerate().filter(|&(at, _)| sides[at].is_zero()) {
        let face = match triangle.iter().position(|&own| own == vertex) {
            Some(own) => Some(1 << own),
            None => face_in_plane(in_plane()?, corners, point(vertex)),
        };
        face.into_iter().for_each(|face| add([1 << at, face]));
    }
    let edges: &[[usize; 2]] = if rim.len() == 3 { &[[0, 1], [1, 2], [2, 0]] } else { &[[0, 1]] };
    for &[from, to] in edges {
        let edge: Face = 1 << from | 1 << to;
        let [p, q] = [rim[from], rim[to]];
        if (sides[from] * sides[to]).is_negative() {
            let face = face_pierced([point(p), point(q)], sides[from], corners);
            face.into_iter().for_each(|face| add([edge, face]));
        } else if sides[from].is_zero() && sides[to].is_zero() {
            let projection = in_plane()?;
            let mut add = |face: Face| add([edge, face]);
            add_in_plane(projection, [point(p), point(q)], corners, &mut add);
        }
    }
    Some(())
}

/// Returns the least face of a triangle that holds a point of its plane.
fn face_in_plane(projection: Projection, corners: [&[f64; 3]; 3], x: &[f64; 3]) -> Option<Face> {
    let turn = projection.turn(corners);
    face_of(from_fn(|k| projection.turn([corners[(k + 1) % 3], corners[(k + 2) % 3], x]) * turn))
}

/// Returns the least face of a triangle through which a segment goes whose ends are on different
/// sides of its plane, the first end on `side`.
fn face_pierced([p, q]: [&[f64; 3]; 2], side: Sign, corners: [&[f64; 3]; 3]) -> Option<Face> {
    let turn = |k: usize| orientation(&[p, q, corners[(k + 1) % 3], corners[(k + 2) % 3]]);
    face_of(from_fn(|k| -(turn(k) * side)))
}

/// Returns the face on which barycentric coordinates are positive; `None` if one is negative.
fn face_of(coordinates: [Sign; 3]) -> Option<Face> {
    let is_in = coordinates.iter().all(|sign| !sign.is_negative());
    let bit = |k: usize| Face::from(coordinates[k].is_positive()) << k;
    is_in.then(|| bit(0) | bit(1) | bit(2))
}

/// Calls `add` with the vertices of a triangle in the interior of a segment in its plane, and with
/// the edges that the segment crosses.
fn add_in_plane(
    projection: Projection,
    segment: [&[f64; 3]; 2],
    corners: [&[f64; 3]; 3],
    add: &mut impl FnMut(Face),
) {
    let [p, q] = segment;
    let own = corners.map(|corner| projection.turn([p, q, corner]));
    for k in 0..3 {
        if own[k].is_zero() && is_between(segment, corners[k]) {
            add(1 << k);
        }
        let ends = [(k + 1) % 3, (k + 2) % 3];
        if (own[ends[0]] * own[ends[1]]).is_negative() {
            let [r, s] = ends.map(|end| corners[end]);
            if (projection.turn([r, s, p]) * projection.turn([r, s, q])).is_negative() {
                add(0b111 ^ 1 << k);
            }
        }
    }
}

/// Returns true if a point of the line through two points is strictly between them.
pub(super) fn is_between([p, q]: [&[f64; 3]; 2], x: &[f64; 3]) -> bool {
    p < x && x < q || q < x && x < p
}

fn segments(points: &[[f64; 3]], both: [&[u32]; 2]) -> Option<Meeting> {
    let [one, other] = both;
    let shared = one.iter().filter(|vertex| other.contains(vertex)).count();
    let point = |vertex: u32| &points[vertex as usize];
    let [[p, q], [r, s]] = both.map(|ends| [point(ends[0]), point(ends[1])]);
    if shared == 2 || shared == 0 && !orientation(&[p, q, r, s]).is_zero() {
        return None;
    }
    let mut meeting = Meeting::new();
    for (i, a) in one.iter().enumerate() {
        for (j, b) in other.iter().enumerate().filter(|&(_, b)| a == b) {
            debug_assert_eq!(a, b);
            meeting.add([1 << i, 1 << j]);
        }
    }
    let spans = |projection: &Projection| {
        !projection.turn([p, q, r]).is_zero() || !projection.turn([p, q, s]).is_zero()
    };
    let projection = Projection::ALL.into_iter().find(spans);
    // Without such a projection all four are on one line.
    let turn = |a, b, c| projection.map_or(Sign::Zero, |projection| projection.turn([a, b, c]));
    let sides = [[turn(r, s, p), turn(r, s, q)], [turn(p, q, r), turn(p, q, s)]];
    for k in 0..2 {
        if sides[0][k].is_zero() && is_between([r, s], [p, q][k]) {
            meeting.add([1 << k, 0b11]);
        }
        if sides[1][k].is_zero() && is_between([p, q], [r, s][k]) {
            meeting.add([0b11, 1 << k]);
        }
    }
    if sides.iter().all(|&[a, b]| (a * b).is_negative()) {
        meeting.add([0b11, 0b11]);
    }
    Some(meeting)
}

/// Returns the corner of a meeting that is in these faces, but for roundings.
pub(super) fn corner(points: &[[f64; 3]], both: [&[u32]; 2], faces: [Face; 2]) -> [f64; 3] {
    let vertices = |which: usize| vertices_of_face(both[which], faces[which]);
    if let Some(which) = faces.iter().position(|face| face.count_ones() == 1) {
        return vertices(which).next().map_or([0.0; 3], |vertex| points[vertex as usize]);
    }
    let edge = if faces[0].count_ones() == 2 { 0 } else { 1 };
    let mut ends = vertices(edge).map(|vertex| &points[vertex as usize]);
    let (Some(p), Some(q)) = (ends.next(), ends.next()) else { return [0.0; 3] };
    let other = both[1 - edge].iter().map(|&vertex| &points[vertex as usize]);
    let through: [Option<&[f64; 3]>; 3] = {
        let mut other = other;
        from_fn(|_| other.next())
    };
    if let [Some(a), Some(b), Some(c)] = through {
        let volume = |x: &[f64; 3]| scaled_determinant(&[a, b, c, x]);
        if let Some(distances) = distances(volume(p), volume(q)) {
            return divided(p, q, distances);
        }
    }
    // Two edges in one plane.
    let mut ends = vertices(1 - edge).map(|vertex| &points[vertex as usize]);
    let (Some(r), Some(s)) = (ends.next(), ends.next()) else { return *p };
    let crossing = |projection: Projection| {
        let [r, s] = [r, s].map(|end| projection.image(end));
        let area = |x: &[f64; 3]| {
            let x = projection.image(x);
            scaled_determinant(&[&r, &s, &x])
        };
        distances(area(p), area(q))
    };
    let distances = Projection::ALL.into_iter().find_map(crossing);
    distances.map_or(*p, |distances| divided(p, q, distances))
}

/// Returns the vertices of a face of a piece.
pub(super) fn vertices_of_face(vertices: &[u32], face: Face) -> impl Iterator<Item = u32> + Clone {
    let own = vertices.iter().enumerate().filter(move |(at, _)| face >> at & 1 == 1);
    own.map(|(_, &vertex)| vertex)
}

/// Returns the point that divides the way from a point to another by these distances, each
/// coordinate with an error of a rounding or two of the larger one. What is exact in doubles has
/// none.
fn divided(p: &[f64; 3], q: &[f64; 3], [near, far]: [f64; 2]) -> [f64; 3] {
    // No sum of products overflows then.
    let [near, far] = [0.125 * near, 0.125 * far];
    from_fn(|k| {
        let scale = scale_of_products([p[k], q[k]]);
        let [p, q] = [scale * p[k], scale * q[k]];
        let (a, b) = (p * far, q * near);
        let sum = a + b;
        let rest = (a - (sum - b)) + (b - (sum - (sum - b)));
        let rounded = p.mul_add(far, -a) + q.mul_add(near, -b) + rest;
        ((sum + rounded) / (near + far)).clamp(p.min(q), p.max(q)) / scale
    })
}

/// Returns the distances of two points from a plane or line between them, given numbers `m 2^e` as
/// `(m, e)` in proportion to these, in units in which the larger is about 1; `None` if both are
/// zero.
fn distances((p, p_exponent): (f64, i64), (q, q_exponent): (f64, i64)) -> Option<[f64; 2]> {
    if p == 0.0 && q == 0.0 {
        return None;
    }
    let top = match (p == 0.0, q == 0.0) {
        (true, _) => q_exponent,
        (_, true) => p_exponent,
        _ => p_exponent.max(q_exponent),
    };
    let near = scale_by_power(p.abs(), p_exponent - top);
    let far = scale_by_power(q.abs(), q_exponent - top);
    Some([near, far])
}
