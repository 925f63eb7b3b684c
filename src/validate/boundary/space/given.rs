//! Facets as the certificate sees them: the rim with the facet on its left, what lies within, and
//! the projection along an axis.

use super::inside;
use super::plane::{AreaVector, largest_axis};
use crate::error::message;
use crate::memory::{AllocResult, TryGrow, collected};
use crate::mesh::{Facets, Inputs, NONE};
use crate::quality::length::scale;
use crate::validate::report::{Violation, ViolationKind};
use std::cmp::Ordering;

/// Facet between inputs: a polygon, or triangles of the caller's that are one facet.
pub(super) struct Facet {
    /// Number of the polygon, or of the first triangle.
    pub parent: u32,
    /// Edges where it ends, with the facet on the left where its normal points to the eye.
    pub rim: Vec<[u32; 2]>,
    /// Segments within it.
    pub within: Vec<[u32; 2]>,
    /// Segments that its loops have outside of it.
    pub beside: Vec<[u32; 2]>,
    /// Vertices within it.
    pub points: Vec<u32>,
    /// Inputs of its own.
    pub corners: Vec<u32>,
    pub projection: Projection,
    /// Normal with its largest component in \[1, 2).
    pub normal: [f64; 3],
}

/// Projection along the axis of the largest component of a normal, seen from where that points to:
/// what turns to the left round the normal does so in the projection.
#[derive(Clone, Copy)]
pub(super) struct Projection {
    axes: [usize; 2],
}

impl Projection {
    pub fn along(normal: &[f64; 3]) -> Self {
        Self::along_axis(normal, largest_axis(normal))
    }

    /// Returns the projection along an axis along which a normal has a component.
    pub fn along_axis(normal: &[f64; 3], axis: usize) -> Self {
        let [i, j] = [(axis + 1) % 3, (axis + 2) % 3];
        Self { axes: if normal[axis] > 0.0 { [i, j] } else { [j, i] } }
    }

    pub fn of(self, point: &[f64; 3]) -> [f64; 2] {
        self.axes.map(|axis| point[axis])
    }
}

pub(super) fn describe_no_area(number: usize) -> Violation {
    let message = message!("facet {number} has no area, or an input that is no vertex");
    Violation::new(ViolationKind::FacetGroup, message)
}

/// Returns the vertex of a distinct input as a point.
pub(super) fn point(inputs: &Inputs, vertex: u32) -> &[f64; 3] {
    inputs.distinct_point(vertex as usize).try_into().expect("three coordinates")
}

/// Makes the facet of a polygon of the caller's; `None` if it has no area. Its normal is that of
/// its largest loop, and points to where its first loop turns to the left.
pub(super) fn polygon(
    inputs: &Inputs,
    facets: &Facets,
    number: usize,
) -> AllocResult<Option<Facet>> {
    let vertex = |&input: &u32| inputs.vertices().get(input as usize).copied().unwrap_or(NONE);
    let (mut edges, mut corners): (Vec<[u32; 2]>, Vec<u32>) = Default::default();
    // Segments, and vertices as their own ends.
    let mut others: Vec<[u32; 2]> = Vec::new();
    let mut first = None;
    let mut largest: Option<([f64; 3], i32)> = None;
    for inputs_of_loop in facets.loops(number) {
        let own: Vec<u32> = collected(inputs_of_loop.iter().map(vertex))?;
        if own.iter().any(|&vertex| vertex as usize >= inputs.distinct()) {
            return Ok(None);
        }
        corners.try_extend(&own)?;
        match own[..] {
            [] => {}
            [single] => others.try_push([single; 2])?,
            [from, to] => others.try_push([from, to])?,
            _ => {
                let mut area = AreaVector::zero();
                for (&from, &to) in own.iter().zip(own.iter().cycle().skip(1)) {
                    edges.try_push([from, to])?;
                    area.add_edge(point(inputs, from), point(inputs, to));
                }
                let Some(vector) = area.rounded() else { continue };
                if largest.as_ref().is_none_or(|other| is_longer(&vector, other)) {
                    largest = Some(vector);
                }
                first.get_or_insert(area);
            }
        }
    }
    let (Some(first), Some((normal, _))) = (first, largest) else { return Ok(None) };
    let axis = largest_axis(&normal);
    let sign = first.sign(axis);
    let agrees = (sign == Ordering::Less) == (normal[axis] < 0.0);
    let normal = if agrees { normal } else { normal.map(|x| -x) };
    let projection = Projection::along(&normal);
    corners.sort_unstable();
    corners.dedup();
    let rim = odd_ones(edges, &mut others)?;
    let (within, beside, points) = Default::default();
    let parent = number as u32;
    let mut facet = Facet { parent, rim, within, beside, points, corners, projection, normal };
    facet.place(inputs, &others)?;
    Ok(Some(facet))
}

impl Facet {
    /// Turns the rim so that the facet is on its left, and sorts `others` by where they are.
    fn place(&mut self, inputs: &Inputs, others: &[[u32; 2]]) -> AllocResult<()> {
        let projection = self.projection;
        let project = |&ends: &[u32; 2]| ends.map(|end| projection.of(point(inputs, end)));
        let [rim, projected] =
            [&self.rim, others].map(|edges| collected(edges.iter().map(project)));
        let sides = inside::sides(&rim?, &projected?)?;
        for (edge, _) in self.rim.iter_mut().zip(sides.lefts).filter(|(_, is_left)| !is_left) {
            edge.reverse();
        }
        for (&[a, b], is_inside) in others.iter().zip(sides.insides) {
            match (a == b, is_inside) {
                (true, true) => self.points.try_push(a)?,
                (true, false) => {}
                (false, true) => self.within.try_push([a, b])?,
                (false, false) => self.beside.try_push([a, b])?,
            }
        }
        Ok(())
    }
}

/// Returns true if a vector with an exponent of its own is longer than another.
pub(super) fn is_longer(
    &(vector, exponent): &([f64; 3], i32),
    &(other, own): &([f64; 3], i32),
) -> bool {
    let square = |vector: [f64; 3]| vector.iter().map(|x| x * x).sum::<f64>();
    square(vector) > scale(square(other), 2 * (own - exponent))
}

/// Returns the edges that loops have an odd number of times, and adds the others to `others`.
fn odd_ones(mut edges: Vec<[u32; 2]>, others: &mut Vec<[u32; 2]>) -> AllocResult<Vec<[u32; 2]>> {
    edges.iter_mut().for_each(|edge| edge.sort_unstable());
    edges.sort_unstable();
    let mut rim = Vec::new();
    for same in edges.chunk_by(|a, b| a == b).filter(|same| same[0][0] != same[0][1]) {
        if same.len() % 2 == 1 { &mut rim } else { &mut *others }.try_push(same[0])?;
    }
    Ok(rim)
}
