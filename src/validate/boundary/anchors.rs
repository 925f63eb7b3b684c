//! Anchors: the vertices at which lines end, since segments meet or cross there, or sides of a box.

use super::edges::Edges;
use super::exact::Point;
use crate::options::Extent;
use crate::quality::view::View;

/// Vertices that may be anchors, and what tells which of them are.
pub(super) struct Anchors<'a> {
    view: View<'a, 2>,
    edges: &'a Edges,
    /// Number of vertices that are inputs, which come first.
    inputs: usize,
    /// Corners of the box that the mesh is cropped to, if it is.
    corners: Option<[Point; 4]>,
}

impl<'a> Anchors<'a> {
    /// Takes the corners of a box from the inputs. O(inputs). Ids must be in range.
    pub fn new(view: View<'a, 2>, inputs: usize, edges: &'a Edges) -> Self {
        let is_box = view.mesh.parameters.extent == Extent::Box;
        // The first vertices are the inputs.
        let corners = || corners_of_box((0..inputs as u32).map(|vertex| *view.point(vertex)));
        Self { view, edges, inputs, corners: is_box.then(corners) }
    }

    /// Returns true if `vertex` is an anchor: an input, a vertex of several segments or at the end
    /// of one, or a corner of the box, also where one segment runs along both of its sides. Sides
    /// of a hull meet at inputs only.
    pub fn holds(&self, vertex: u32) -> bool {
        let parent = |subsegment: u32| self.view.mesh.boundary.parents[subsegment as usize];
        match *self.edges.at.of(vertex as usize) {
            [first, second] => {
                (vertex as usize) < self.inputs
                    || parent(first) != parent(second)
                    || self.corners.is_some_and(|all| all.contains(self.view.point(vertex)))
            }
            _ => true,
        }
    }
}

/// Returns the corners of the box of some points, counterclockwise.
pub(super) fn corners_of_box(points: impl Iterator<Item = Point>) -> [Point; 4] {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for point in points {
        for (axis, x) in point.into_iter().enumerate() {
            (low[axis], high[axis]) = (low[axis].min(x), high[axis].max(x));
        }
    }
    [low, [high[0], low[1]], high, [low[0], high[1]]]
}
