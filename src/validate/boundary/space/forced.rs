//! Level 3: a tetrahedron that is excused because a small angle of the caller's forces it has
//! vertices on both sides of such an angle: on two facets that meet at an edge below 90 degrees, or
//! on segments, edges of facets or facets that meet at an input, or where crossings are split,
//! below 60 degrees.

use super::directions::{Vector, across, cosine, cross, direction, dot};
use super::faces::Faces;
use super::flat::facets_at;
use crate::error::message;
use crate::memory::{AllocResult, Lists, Sets, TryGrow, collected};
use crate::mesh::Inputs;
use crate::options::Crossings;
use crate::quality::view::View;
use crate::validate::boundary::forced::check_bound;
use crate::validate::report::{Findings, Violation, ViolationKind};

/// The cosine of 60 degrees, at inputs; with roundings, which come down to it.
const SMALL_ANGLE: f64 = 0.5 - 1e-9;
/// The cosine of 90 degrees, at edges: nothing forces a simplex at a right angle, which is the
/// commonest, so that roundings do not count.
const SMALL_DIHEDRAL: f64 = 1e-9;

/// Facet by its number, or a line by its first subsegment.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Feature {
    Facet(u32),
    Line(u32),
}

struct Features<'a> {
    view: View<'a, 3>,
    faces: &'a Faces,
    /// Vertex -> the facets that it is on.
    facets_at: Lists,
    /// Subsegment -> the line that it is on.
    lines: Sets,
    /// Pairs of features that meet at a small angle, the lower first; sorted.
    small: Vec<[Feature; 2]>,
}

pub(super) fn check(
    inputs: &Inputs,
    view: View<'_, 3>,
    faces: &Faces,
    findings: &mut Findings,
) -> AllocResult<()> {
    if view.mesh.boundary.forced.is_empty() {
        return Ok(());
    }
    let mut features = Features::new(inputs.distinct(), view, faces)?;
    for &simplex in &view.mesh.boundary.forced {
        let vertices = view.simplex(simplex as usize);
        check_bound(view, simplex, findings)?;
        let is_forced = features.spans_small_angle(vertices)?;
        findings.check(is_forced, || {
            let message = message!(
                "simplex {simplex} is no forced one: its vertices are on no two facets or segments \
                 that meet at a small angle"
            );
            Violation::new(ViolationKind::ForcedSimplex, message).simplex(simplex as usize)
        });
    }
    Ok(())
}

impl<'a> Features<'a> {
    fn new(inputs: usize, view: View<'a, 3>, faces: &'a Faces) -> AllocResult<Self> {
        let mut lines = Sets::new(view.mesh.boundary.subsegments.len())?;
        let splits = view.mesh.parameters.crossings == Crossings::Split;
        let is_anchor =
            |vertex: u32| (vertex as usize) < inputs || splits && faces.is_crossing(view, vertex);
        let vertices = 0..view.vertex_count() as u32;
        for vertex in vertices.clone().filter(|&vertex| !is_anchor(vertex)) {
            if let [one, other] = *faces.at.of(vertex as usize) {
                lines.join(one as usize, other as usize);
            }
        }
        let (facets_at, small) = (facets_at(view, faces)?, Vec::new());
        let mut features = Self { view, faces, facets_at, lines, small };
        features.add_dihedral_angles()?;
        for vertex in vertices.filter(|&vertex| is_anchor(vertex)) {
            features.add_angles_at(vertex)?;
        }
        features.small.sort_unstable();
        features.small.dedup();
        Ok(features)
    }

    fn add(&mut self, a: Feature, b: Feature) -> AllocResult<()> {
        if a != b { self.small.try_push([a.min(b), a.max(b)]) } else { Ok(()) }
    }

    /// Returns the direction from a vertex to another.
    fn direction(&self, from: u32, to: u32) -> Vector {
        direction(self.view.point(from), self.view.point(to))
    }

    fn facet(&self, subfacet: u32) -> u32 {
        self.faces.facets[subfacet as usize]
    }

    /// Adds the pairs of facets that meet at a subsegment below 90 degrees.
    fn add_dihedral_angles(&mut self) -> AllocResult<()> {
        let view = self.view;
        for &[a, b] in &view.mesh.boundary.subsegments {
            let along = self.direction(a, b);
            let page = |subfacet: u32| {
                let vertices = view.mesh.boundary.subfacets[subfacet as usize];
                let apex = vertices.into_iter().find(|&vertex| vertex != a && vertex != b);
                (subfacet, across(self.direction(a, apex.unwrap_or(a)), along))
            };
            let pages: Vec<(u32, Vector)> = collected(self.faces.beside(view, [a, b]).map(page))?;
            for (at, (one, first)) in pages.iter().enumerate() {
                for (other, second) in &pages[at + 1..] {
                    if cosine(first, second) > SMALL_DIHEDRAL {
                        let [one, other] = [*one, *other].map(|page| self.facet(page));
                        self.add(Feature::Facet(one), Feature::Facet(other))?;
                    }
                }
            }
        }
        Ok(())
    }

    /// Adds the pairs of lines, and of lines and facets, that meet at a vertex below 60 degrees,
    /// and with a line the facets that end at it. Where no line is, facets that bend may meet.
    fn add_angles_at(&mut self, vertex: u32) -> AllocResult<()> {
        let view = self.view;
        let subsegments = self.faces.at.of(vertex as usize);
        if subsegments.is_empty() {
            return self.add_tips_at(vertex);
        }
        for (at, &one) in subsegments.iter().enumerate() {
            let end = self.far_end(one, vertex);
            let own = self.direction(vertex, end);
            for &other in &subsegments[at + 1..] {
                let second = self.direction(vertex, self.far_end(other, vertex));
                if cosine(&own, &second) > SMALL_ANGLE {
                    self.add_all(one, other)?;
                }
            }
            for &subfacet in self.faces.subfacets_at.of(vertex as usize) {
                let facet = self.facet(subfacet);
                let of = |page: u32| self.facet(page) == facet;
                if self.faces.beside(view, [vertex, end]).any(of) {
                    continue;
                }
                let [_, a, b] =
                    from_vertex(view.mesh.boundary.subfacets[subfacet as usize], vertex);
                let sector = [self.direction(vertex, a), self.direction(vertex, b)];
                if largest_cosine(&own, &sector) > SMALL_ANGLE {
                    let line = Feature::Line(self.lines.find(one as usize) as u32);
                    self.add(line, Feature::Facet(facet))?;
                    for page in self.faces.beside(view, [vertex, end]) {
                        self.add(Feature::Facet(self.facet(page)), Feature::Facet(facet))?;
                    }
                }
            }
        }
        Ok(())
    }

    /// Adds the pairs of facets that have a vertex between their lines and meet there below 60
    /// degrees: the tip of one that is bent is on the other.
    fn add_tips_at(&mut self, vertex: u32) -> AllocResult<()> {
        let sector = |&subfacet: &u32| {
            let own = self.view.mesh.boundary.subfacets[subfacet as usize];
            let [_, a, b] = from_vertex(own, vertex);
            (self.facet(subfacet), [self.direction(vertex, a), self.direction(vertex, b)])
        };
        let at = self.faces.subfacets_at.of(vertex as usize);
        let sectors: Vec<(u32, [Vector; 2])> = collected(at.iter().map(sector))?;
        for (at, (one, first)) in sectors.iter().enumerate() {
            for (other, second) in sectors[at + 1..].iter().filter(|(other, _)| other != one) {
                if first.iter().any(|way| largest_cosine(way, second) > SMALL_ANGLE) {
                    self.add(Feature::Facet(*one), Feature::Facet(*other))?;
                }
            }
        }
        Ok(())
    }

    /// Adds the pairs of two lines and the facets that end at them.
    fn add_all(&mut self, one: u32, other: u32) -> AllocResult<()> {
        let [first, second] = [self.features_of(one)?, self.features_of(other)?];
        for &a in &first {
            for &b in &second {
                self.add(a, b)?;
            }
        }
        Ok(())
    }

    /// Returns the line of a subsegment, and the facets beside it.
    fn features_of(&mut self, subsegment: u32) -> AllocResult<Vec<Feature>> {
        let line = Feature::Line(self.lines.find(subsegment as usize) as u32);
        let ends = self.view.mesh.boundary.subsegments[subsegment as usize];
        let beside = self.faces.beside(self.view, ends);
        collected(beside.map(|page| Feature::Facet(self.facet(page))).chain([line]))
    }

    fn far_end(&self, subsegment: u32, vertex: u32) -> u32 {
        let [a, b] = self.view.mesh.boundary.subsegments[subsegment as usize];
        if a == vertex { b } else { a }
    }

    /// Returns the features that a vertex is on.
    fn features_at(&mut self, vertex: u32) -> AllocResult<Vec<Feature>> {
        let facets = self.facets_at.of(vertex as usize).iter().map(|&facet| Feature::Facet(facet));
        let mut features = collected(facets)?;
        for &subsegment in self.faces.at.of(vertex as usize) {
            features.try_push(Feature::Line(self.lines.find(subsegment as usize) as u32))?;
        }
        Ok(features)
    }

    /// Returns true if two of some vertices are on features that meet at a small angle.
    fn spans_small_angle(&mut self, vertices: &[u32]) -> AllocResult<bool> {
        for (at, &one) in vertices.iter().enumerate() {
            let first = self.features_at(one)?;
            for &other in &vertices[at + 1..] {
                let second = self.features_at(other)?;
                for &a in &first {
                    for &b in &second {
                        if self.small.binary_search(&[a.min(b), a.max(b)]).is_ok() {
                            return Ok(true);
                        }
                    }
                }
            }
        }
        Ok(false)
    }
}

/// Returns a triangle from one of its vertices on.
fn from_vertex([a, b, c]: [u32; 3], vertex: u32) -> [u32; 3] {
    match vertex {
        _ if vertex == b => [b, c, a],
        _ if vertex == c => [c, a, b],
        _ => [a, b, c],
    }
}

/// Returns the cosine of the smallest angle between a direction and those between two others.
fn largest_cosine(direction: &Vector, [a, b]: &[Vector; 2]) -> f64 {
    let normal = cross(a, b);
    let shadow = across(*direction, normal);
    // The shadow is between both if it is to the left of one and to the right of the other.
    let is_between =
        dot(&cross(a, &shadow), &normal) >= 0.0 && dot(&cross(&shadow, b), &normal) >= 0.0;
    let at_ends = cosine(direction, a).max(cosine(direction, b));
    if is_between { at_ends.max(cosine(direction, &shadow)) } else { at_ends }
}
