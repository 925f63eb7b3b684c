//! The boundary of a hull or box that the mesh is cropped to.
//!
//! - Level 2: subfacets of no facet of the caller's are where the domain ends. Those of a box, with
//!   all others there, are in its sides up to rounding, and chains lead along its edges; those of a
//!   hull are plane between edges that are subsegments, as facets are.
//! - Level 3: all inputs are within, and the volume is that of the box, or of the exact hull of the
//!   inputs on the boundary, up to rounding: the vertices of the boundary are inputs or in plane
//!   parts between these, so that nothing is beyond the hull; and so nothing of it is missing.
//!   Parts of a hull that count as plane though they are bent, sides by no more than rounding or
//!   facets as the caller allows, may leave the volume between two planes about their inputs.

use super::super::chains::BENT;
use super::super::exact::unit_in_last_place;
use super::super::sum::Sum;
use super::faces::Faces;
use super::given::{Facet, Projection};
use super::hull::hull;
use super::plane::{self, AreaVector};
use super::ways::Ways;
use super::{given, tiling};
use crate::error::message;
use crate::memory::{AllocResult, TryGrow, collected, filled};
use crate::mesh::{Inputs, NONE};
use crate::options::Extent;
use crate::quality::view::View;
use crate::validate::report::{Findings, Violation, ViolationKind};
use std::cmp::Ordering;

/// Bounding box of the inputs.
struct Bounds {
    low: [f64; 3],
    high: [f64; 3],
    /// Distance on each axis that roundings explain.
    near: [f64; 3],
}

/// The boundary of the extent in the mesh.
struct Shell {
    /// Simplex -> true if it can be reached from outside without crossing a subfacet.
    is_outside: Vec<bool>,
    /// Subfacets between what is outside and what is not.
    subfacets: Vec<u32>,
}

/// Checks level 2.
pub(super) fn check(ways: &mut Ways<'_>, findings: &mut Findings) -> AllocResult<()> {
    let view = ways.view;
    if !has_frame(view) {
        return Ok(());
    }
    let shell = Shell::of(view, ways.faces)?;
    shell.check_place(view, findings);
    if view.mesh.parameters.extent == Extent::Box {
        let bounds = Bounds::of(ways.inputs);
        shell.check_sides(view, &bounds, findings);
        return check_edges(ways, &shell, &bounds, findings);
    }
    shell.check_parts(ways, findings)
}

/// Checks level 3.
pub(super) fn check_volume(
    inputs: &Inputs,
    view: View<'_, 3>,
    faces: &Faces,
    findings: &mut Findings,
) -> AllocResult<()> {
    if !has_frame(view) {
        return Ok(());
    }
    let shell = Shell::of(view, faces)?;
    shell.check_inputs(inputs, view, findings)?;
    let bounds = Bounds::of(inputs);
    let mut sum = Sum::zero();
    for &subfacet in &shell.subfacets {
        // What the mesh has is taken away.
        let [a, b, c] = shell.outwards(view, faces, subfacet).map(|vertex| view.point(vertex));
        sum.add_facet([b, a, c]);
    }
    match view.mesh.parameters.extent {
        Extent::Box => bounds.add_box(&mut sum),
        _ => shell.add_hull(inputs, view, &mut sum)?,
    }
    if sum.sign() == Ordering::Less {
        let mut magnitude = Sum::zero();
        magnitude.add(&sum, true);
        sum = magnitude;
    }
    let mut bound = bounds.rounding();
    if view.mesh.parameters.extent == Extent::Hull {
        shell.add_bends(inputs, view, faces, &mut bound)?;
    }
    bound.add(&sum, true);
    findings.check(bound.sign() != Ordering::Less, || {
        let message =
            "the domain and its holes have another volume than the hull or box of the inputs";
        Violation::new(ViolationKind::RegionVolume, message)
    });
    Ok(())
}

/// Returns true if the mesh is cropped to a hull or box.
pub(super) fn has_frame(view: View<'_, 3>) -> bool {
    matches!(view.mesh.parameters.extent, Extent::Hull | Extent::Box)
}

impl Bounds {
    fn of(inputs: &Inputs) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for vertex in 0..inputs.distinct() as u32 {
            for (axis, &x) in given::point(inputs, vertex).iter().enumerate() {
                (low[axis], high[axis]) = (low[axis].min(x), high[axis].max(x));
            }
        }
        let largest = |axis: usize| low[axis].abs().max(high[axis].abs());
        let near = [0, 1, 2].map(|axis| BENT * unit_in_last_place(largest(axis)));
        Self { low, high, near }
    }

    fn corner(&self, at: usize) -> [f64; 3] {
        [0, 1, 2].map(|axis| if at >> axis & 1 == 1 { self.high[axis] } else { self.low[axis] })
    }

    /// Adds six times the volume of the box.
    fn add_box(&self, sum: &mut Sum) {
        for side in 0..6 {
            let (axis, end) = (side / 2, side % 2);
            let [i, j] = [1, 2].map(|step| 1 << ((axis + step) % 3));
            let first = end << axis;
            let [a, b, c, d] =
                [first, first | i, first | i | j, first | j].map(|at| self.corner(at));
            for [p, q, r] in [[&a, &b, &c], [&a, &c, &d]] {
                sum.add_facet(if end == 1 { [p, q, r] } else { [q, p, r] });
            }
        }
    }

    /// Returns six times the volume that roundings explain of a convex body with this box.
    fn rounding(&self) -> Sum {
        let mut sum = Sum::zero();
        for axis in 0..3 {
            let width = |step: usize| {
                let k = (axis + step) % 3;
                (0.5 * self.high[k] - 0.5 * self.low[k]).next_up()
            };
            // Twice the area of a side, of which half the widths are factors here, and six times.
            for _ in 0..48 {
                sum.add_product(&[self.near[axis], width(1), width(2)]);
            }
        }
        sum
    }

    /// Returns true if three points are near one side of the box.
    fn has_side(&self, points: [&[f64; 3]; 3]) -> bool {
        (0..3).any(|axis| {
            [self.low[axis], self.high[axis]].iter().any(|&end| {
                let is_near = |x: &&[f64; 3]| (x[axis] - end).abs() <= self.near[axis];
                points.iter().all(is_near)
            })
        })
    }
}

impl Shell {
    fn of(view: View<'_, 3>, faces: &Faces) -> AllocResult<Self> {
        let mut is_outside = filled(view.simplex_count(), false)?;
        let mut waiting = Vec::new();
        for (simplex, is_outside) in is_outside.iter_mut().enumerate() {
            let is_free = |slot: usize| {
                view.neighbors(simplex)[slot] == NONE && faces.walls.across(simplex, slot) == NONE
            };
            if (0..4).any(is_free) {
                *is_outside = true;
                waiting.try_push(simplex)?;
            }
        }
        while let Some(simplex) = waiting.pop() {
            for (slot, &neighbor) in view.neighbors(simplex).iter().enumerate() {
                let is_open = neighbor != NONE && faces.walls.across(simplex, slot) == NONE;
                if is_open && !is_outside[neighbor as usize] {
                    is_outside[neighbor as usize] = true;
                    waiting.try_push(neighbor as usize)?;
                }
            }
        }
        let is_out = |&side: &u32| side == NONE || is_outside[side as usize];
        let is_between = |sides: &[u32; 2]| is_out(&sides[0]) != is_out(&sides[1]);
        let sides = (0..).zip(&faces.walls.sides).filter(|(_, sides)| is_between(sides));
        let subfacets = collected(sides.map(|(subfacet, _)| subfacet))?;
        Ok(Self { is_outside, subfacets })
    }

    /// Returns the vertices of a subfacet of the boundary, counterclockwise from outside.
    fn outwards(&self, view: View<'_, 3>, faces: &Faces, subfacet: u32) -> [u32; 3] {
        let [a, b, c] = view.mesh.boundary.subfacets[subfacet as usize];
        let [behind, _] = faces.walls.sides[subfacet as usize];
        let is_reversed = behind == NONE || self.is_outside[behind as usize];
        if is_reversed { [b, a, c] } else { [a, b, c] }
    }

    /// Checks that subfacets of no facet are on the boundary.
    fn check_place(&self, view: View<'_, 3>, findings: &mut Findings) {
        for (subfacet, &parent) in (0u32..).zip(&view.mesh.boundary.subfacet_parents) {
            let is_there = parent != NONE || self.subfacets.binary_search(&subfacet).is_ok();
            findings.check(is_there, || {
                let message = message!(
                    "subfacet {subfacet} is of no facet, and not on the boundary of the extent"
                );
                let vertex = view.mesh.boundary.subfacets[subfacet as usize][0];
                Violation::new(ViolationKind::FacetGroup, message).vertex(vertex as usize)
            });
        }
    }

    fn check_sides(&self, view: View<'_, 3>, bounds: &Bounds, findings: &mut Findings) {
        for &subfacet in &self.subfacets {
            let vertices = view.mesh.boundary.subfacets[subfacet as usize];
            let points = vertices.map(|vertex| view.point(vertex));
            findings.check(bounds.has_side(points), || {
                let message = message!(
                    "subfacet {subfacet} with the vertices {vertices:?}, where the domain ends, is \
                     on no side of the box"
                );
                Violation::new(ViolationKind::FacetPlane, message).vertex(vertices[0] as usize)
            });
        }
    }

    /// Checks that the parts of a hull between subsegments are plane, but for roundings.
    fn check_parts(&self, ways: &Ways<'_>, findings: &mut Findings) -> AllocResult<()> {
        let (view, faces) = (ways.view, ways.faces);
        let is_own =
            |&subfacet: &u32| view.mesh.boundary.subfacet_parents[subfacet as usize] == NONE;
        for part in self.by_facets(faces, is_own)?.chunk_by(|a, b| a.0 == b.0) {
            let triangles = part.iter().map(|&(_, at)| self.outwards(view, faces, at));
            let triangles: Vec<[u32; 3]> = collected(triangles)?;
            let mut area = AreaVector::zero();
            for triangle in &triangles {
                area.add_triangle(triangle.map(|vertex| view.point(vertex)));
            }
            let edges = tiling::sorted_edges(&triangles)?;
            tiling::rim(NONE, &edges, findings)?;
            let mut vertices: Vec<u32> = collected(triangles.iter().flatten().copied())?;
            vertices.sort_unstable();
            vertices.dedup();
            let corners = collected(vertices.iter().copied().filter(|&at| ways.is_input(at)))?;
            let own = corners.iter().map(|&corner| ways.input(corner));
            let normal = plane::side_normal(&area, own);
            findings.check(normal.is_some() && !corners.is_empty(), || {
                let message = "a part of the hull between subsegments is no side: it has no \
                               plane, or no input";
                Violation::new(ViolationKind::FacetPlane, message).vertex(vertices[0] as usize)
            });
            let Some(normal) = normal else { continue };
            let projection = Projection::along(&normal);
            let (rim, within, beside, points) = Default::default();
            let parent = NONE;
            let facet = Facet { parent, rim, within, beside, points, corners, projection, normal };
            plane::check_side(&facet, ways, findings);
            tiling::check_orientations(&facet, view, &triangles, findings)?;
            plane::check(&facet, &vertices, ways, findings);
        }
        Ok(())
    }

    /// Returns some subfacets of the boundary with their facets, by these.
    fn by_facets(
        &self,
        faces: &Faces,
        is_asked: impl Fn(&u32) -> bool,
    ) -> AllocResult<Vec<(u32, u32)>> {
        let asked = self.subfacets.iter().copied().filter(is_asked);
        let mut order = collected(asked.map(|at| (faces.facets[at as usize], at)))?;
        order.sort_unstable();
        Ok(order)
    }

    /// Adds six times a volume that is at least that between each facet or part of the boundary and
    /// any other surface between its inputs: they are between two parallel planes.
    fn add_bends(
        &self,
        inputs: &Inputs,
        view: View<'_, 3>,
        faces: &Faces,
        bound: &mut Sum,
    ) -> AllocResult<()> {
        for part in self.by_facets(faces, |_| true)?.chunk_by(|a, b| a.0 == b.0) {
            let mut area = AreaVector::zero();
            let mut corners = Vec::new();
            for &(_, at) in part {
                let vertices = self.outwards(view, faces, at);
                area.add_triangle(vertices.map(|vertex| view.point(vertex)));
                let own = vertices.into_iter().filter(|&at| (at as usize) < inputs.distinct());
                own.map(|vertex| view.point(vertex)).try_for_each(|x| corners.try_push(x))?;
            }
            let Some(normal) = plane::side_normal(&area, corners.iter().copied()) else { continue };
            let thickness = plane::thickness(&normal, corners.iter().copied());
            let axis = plane::largest_axis(&normal);
            let half_width = |step: usize| {
                let along = || {
                    part.iter().flat_map(|&(_, at)| {
                        let vertices = view.mesh.boundary.subfacets[at as usize];
                        vertices.map(|vertex| 0.5 * view.point(vertex)[(axis + step) % 3])
                    })
                };
                (along().fold(f64::MIN, f64::max) - along().fold(f64::MAX, f64::min)).next_up()
            };
            // Six times, with half the widths. The largest component of the normal is at least 1:
            // along its axis, too, the planes are no farther from each other.
            for _ in 0..24 {
                bound.add_product(&[thickness, half_width(1), half_width(2)]);
            }
        }
        Ok(())
    }

    /// Checks that every input is in a simplex that is not outside.
    fn check_inputs(
        &self,
        inputs: &Inputs,
        view: View<'_, 3>,
        findings: &mut Findings,
    ) -> AllocResult<()> {
        let mut is_inside = filled(view.vertex_count(), false)?;
        for simplex in (0..view.simplex_count()).filter(|&simplex| !self.is_outside[simplex]) {
            view.simplex(simplex).iter().for_each(|&vertex| is_inside[vertex as usize] = true);
        }
        for vertex in 0..inputs.distinct() {
            findings.check(is_inside.get(vertex).copied().unwrap_or(false), || {
                let message =
                    message!("vertex {vertex}, an input, is outside of the hull or box of all");
                Violation::new(ViolationKind::DomainPlace, message).vertex(vertex)
            });
        }
        Ok(())
    }

    /// Adds six times the volume of the hull of the inputs on the boundary.
    fn add_hull(&self, inputs: &Inputs, view: View<'_, 3>, sum: &mut Sum) -> AllocResult<()> {
        let corners = |&at: &u32| view.mesh.boundary.subfacets[at as usize];
        let mut vertices = collected(self.subfacets.iter().flat_map(corners))?;
        vertices.sort_unstable();
        vertices.dedup();
        vertices.retain(|&vertex| (vertex as usize) < inputs.distinct());
        let points = collected(vertices.iter().map(|&vertex| given::point(inputs, vertex)))?;
        for triangle in hull(&points)? {
            sum.add_facet(triangle.map(|at| points[at]));
        }
        Ok(())
    }
}

/// Checks that chains lead along the edges of a box.
fn check_edges(
    ways: &mut Ways<'_>,
    shell: &Shell,
    bounds: &Bounds,
    findings: &mut Findings,
) -> AllocResult<()> {
    let view = ways.view;
    let mut corners = [NONE; 8];
    for &subfacet in &shell.subfacets {
        for vertex in view.mesh.boundary.subfacets[subfacet as usize] {
            let is_at = |at: &usize| bounds.corner(*at) == *view.point(vertex);
            if let Some(at) = (0..8).find(is_at) {
                corners[at] = vertex;
            }
        }
    }
    for from in 0..8 {
        for axis in (0..3).filter(|axis| from >> axis & 1 == 0) {
            ways.check_edge(NONE, [corners[from], corners[from | 1 << axis]], findings)?;
        }
    }
    Ok(())
}
