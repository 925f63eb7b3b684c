//! Parts that SVG and HTML share: colours, coordinates in the box of the mesh, which cells are
//! drawn where there are too many, and sentences that tell what is shown.

use crate::memory::{AllocResult, copied, filled, with_capacity};
use crate::mesh::{NONE, Triangulation, VertexKind};
use crate::options::{Algorithm, Criterion};
use crate::quality::Quality;
use crate::quality::angles::{angle, smallest_squared_tangent};
use crate::quality::view::View;
use std::fmt::{self, Display};
use std::io;

/// Colours of labels, by their order; a label beyond them gets the first ones again.
pub(super) const COLOURS: [&str; 12] = [
    "#7fb3d5", "#f5b971", "#8fcf9b", "#e59a9a", "#b9a3e3", "#e6d96b", "#6fc7c1", "#e3a3cf",
    "#b0b7c3", "#c6a27e", "#a8d86e", "#8c9eff",
];

/// Colour of the cells of a mesh without labels.
pub(super) const PLAIN: &str = "#cfdcec";

/// The box of a mesh, in which its coordinates are written: doubles from 5e-324 to 1e308 are too
/// small or too large for what draws them.
pub(super) struct Frame {
    /// Power of two that all coordinates are multiplied by first, so that halves of the least are
    /// not zero. Halves of the largest keep sums and differences from overflowing.
    scale: f64,
    /// Centre of the box, scaled.
    center: [f64; 3],
    /// Half of the sides of the box, over half of the longest one.
    pub sides: [f64; 3],
    /// Half of the longest side, scaled.
    half: f64,
}

impl Frame {
    pub fn new(mesh: &Triangulation) -> Self {
        let largest = mesh.points.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
        let scale = if largest < 1e-200 { 2f64.powi(600) } else { 1.0 };
        let mut bounds = [[f64::INFINITY, f64::NEG_INFINITY]; 3];
        for point in mesh.points.chunks_exact(mesh.dim) {
            for ([least, most], x) in bounds.iter_mut().zip(point) {
                (*least, *most) = (least.min(x * scale), most.max(x * scale));
            }
        }
        // A part may have no vertex.
        let axes = if mesh.points.is_empty() { 0 } else { mesh.dim.min(3) };
        bounds[axes..].fill([0.0; 2]);
        let halves = bounds.map(|[least, most]| 0.5 * most - 0.5 * least);
        let half = halves.into_iter().fold(f64::MIN_POSITIVE, f64::max);
        let center = bounds.map(|[least, most]| 0.5 * most + 0.5 * least);
        Self { scale, center, sides: halves.map(|side| side / half), half }
    }

    /// Returns a point in the box: each coordinate is in [-1, 1], and 0 where the point has none.
    pub fn place(&self, point: &[f64]) -> [f64; 3] {
        let mut placed = [0.0; 3];
        for (axis, x) in point.iter().take(3).enumerate() {
            placed[axis] = ((x * self.scale - self.center[axis]) / self.half).clamp(-1.0, 1.0);
        }
        placed
    }

    /// Returns the centre of the box and half of its longest side, in the mesh's coordinates.
    pub fn in_mesh(&self) -> ([f64; 3], f64) {
        (self.center.map(|x| x / self.scale), self.half / self.scale)
    }
}

/// Numbers that are drawn of `count`: all, or `limit` evenly in their order.
#[derive(Clone, Copy)]
pub(super) struct Kept {
    pub count: usize,
    limit: usize,
}

impl Kept {
    pub fn new(count: usize, limit: usize) -> Self {
        Self { count, limit }
    }

    /// Returns how many are drawn.
    pub fn len(self) -> usize {
        self.count.min(self.limit)
    }

    pub fn is_thinned(self) -> bool {
        self.count > self.limit
    }

    /// Returns the numbers that are drawn, ascending.
    pub fn iter(self) -> impl Iterator<Item = usize> {
        let (count, len) = (self.count as u128, self.len() as u128);
        (0..len).map(move |at| (at * count / len) as usize)
    }
}

/// Returns the smallest angle, or dihedral angle, of a simplex in degrees.
pub(super) fn smallest_angle(mesh: &Triangulation, simplex: usize) -> AllocResult<f64> {
    let tangent = match mesh.dim {
        2 => tangent_of(View::<2> { mesh }, simplex),
        _ => tangent_of(View::<3> { mesh }, simplex),
    };
    Ok(angle(tangent?).to_degrees())
}

fn tangent_of<const D: usize>(view: View<'_, D>, simplex: usize) -> AllocResult<f64> {
    let points = view.points_of(view.simplex(simplex));
    smallest_squared_tangent(&points[..View::<D>::VERTICES])
}

/// Returns the labels of a list, each once, ascending.
pub(super) fn distinct(labels: &[i32]) -> AllocResult<Vec<i32>> {
    let mut distinct = copied(labels)?;
    distinct.sort_unstable();
    distinct.dedup();
    Ok(distinct)
}

/// Figures of a mesh, and the sentences that tell them.
pub(super) struct Facts<'a> {
    mesh: &'a Triangulation,
    pub quality: &'a Quality,
    /// Smallest angle of all simplices, in degrees.
    pub least_angle: f64,
    /// Labels of regions, ascending.
    pub regions: Vec<i32>,
}

impl<'a> Facts<'a> {
    /// Measures the angles of a mesh of dimension 2 or 3, which has this quality.
    pub fn new(mesh: &'a Triangulation, quality: &'a Quality) -> AllocResult<Self> {
        let mut least_angle = 180f64;
        for simplex in 0..mesh.simplex_count() {
            least_angle = least_angle.min(smallest_angle(mesh, simplex)?);
        }
        Ok(Self { mesh, quality, least_angle, regions: distinct(&mesh.boundary.simplex_regions)? })
    }

    /// Visits sentences about the mesh, each without its full stop.
    pub fn visit(
        &self,
        mut visit: impl FnMut(fmt::Arguments<'_>) -> io::Result<()>,
    ) -> io::Result<()> {
        let mesh = self.mesh;
        let of_kind = |kind| mesh.kinds.iter().filter(|own| **own == kind).count();
        let [inputs, steiner, cage] =
            [VertexKind::Input, VertexKind::Steiner, VertexKind::Cage].map(of_kind).map(grouped);
        let vertices = grouped(mesh.vertex_count());
        let of_cages = mesh.kinds.contains(&VertexKind::Cage);
        match of_cages {
            true => visit(format_args!(
                "{vertices} vertices: {inputs} inputs, {steiner} Steiner, {cage} of cages"
            ))?,
            false => {
                visit(format_args!("{vertices} vertices: {inputs} inputs, {steiner} Steiner"))?;
            }
        }
        let (cells, angle) = match mesh.dim {
            2 => ("triangles", "angle"),
            _ => ("tetrahedra", "dihedral angle"),
        };
        let count = grouped(mesh.simplex_count());
        match self.regions.len() {
            0 | 1 => visit(format_args!("{count} {cells}"))?,
            regions => visit(format_args!("{count} {cells} in {} regions", grouped(regions)))?,
        }
        self.visit_bound(&mut visit)?;
        if mesh.simplex_count() > 0 {
            visit(format_args!("Smallest {angle} {} degrees", figure(self.least_angle)))?;
        }
        let Quality { min_angle_degrees, worst_radius_edge, worst_aspect, .. } = *self.quality;
        if min_angle_degrees > 0.0 && worst_radius_edge > 0.0 {
            let [degrees, ratio] = [min_angle_degrees, worst_radius_edge].map(figure);
            visit(format_args!("Off the hull {degrees} degrees, radius-edge ratio {ratio}"))?;
        }
        if worst_aspect > 0.0 {
            visit(format_args!("Worst aspect of Voronoi cells {}", figure(worst_aspect)))?;
        }
        Ok(())
    }

    fn visit_bound(
        &self,
        visit: &mut impl FnMut(fmt::Arguments<'_>) -> io::Result<()>,
    ) -> io::Result<()> {
        let parameters = &self.mesh.parameters;
        if parameters.algorithm == Algorithm::Delaunay {
            return visit(format_args!("Delaunay triangulation of the inputs, without a bound"));
        }
        let criterion = match parameters.criterion {
            Criterion::VoronoiAspect => "Voronoi aspect",
            Criterion::RadiusEdge => "radius-edge ratio",
        };
        let bound = figure(parameters.quality_bound);
        match parameters.min_angle {
            0.0 => visit(format_args!("Bound: {criterion} {bound}")),
            least => visit(format_args!(
                "Bound: {criterion} {bound}, angles of {} degrees",
                figure(least)
            )),
        }
    }
}

/// A number with blanks between groups of three digits.
#[derive(Clone, Copy)]
struct Grouped(usize);

pub(super) fn grouped(number: usize) -> impl Display + Copy {
    Grouped(number)
}

impl Display for Grouped {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            0..1000 => write!(formatter, "{}", self.0),
            _ => write!(formatter, "{}\u{a0}{:03}", Self(self.0 / 1000), self.0 % 1000),
        }
    }
}

/// A measure with four digits.
struct Figure(f64);

pub(super) fn figure(value: f64) -> impl Display {
    Figure(value)
}

impl Display for Figure {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0.abs() {
            size if size == 0.0 || !size.is_finite() => write!(formatter, "{}", self.0),
            1e-3..1e6 => {
                let digits = (3.0 - self.0.abs().log10().floor()).clamp(0.0, 6.0);
                let ten = 10f64.powf(digits);
                write!(formatter, "{}", (self.0 * ten).round() / ten)
            }
            _ => write!(formatter, "{:.3e}", self.0),
        }
    }
}

/// Edges at which a planar mesh ends, as closed curves.
pub(super) struct Outline {
    /// Starts and ends of the edges, ascending, with the mesh on the left.
    edges: Vec<[u32; 2]>,
    is_drawn: Vec<bool>,
}

impl Outline {
    pub fn new(mesh: &Triangulation) -> AllocResult<Self> {
        let count = mesh.neighbors.iter().filter(|neighbor| **neighbor == NONE).count();
        let mut edges = with_capacity(count)?;
        let all = mesh.simplices.chunks_exact(3).zip(mesh.neighbors.chunks_exact(3));
        for (vertices, neighbors) in all {
            let ends = (0..3).filter(|&at| neighbors[at] == NONE);
            edges.extend(ends.map(|at| [vertices[(at + 1) % 3], vertices[(at + 2) % 3]]));
        }
        edges.sort_unstable();
        let is_drawn = filled(edges.len(), false)?;
        Ok(Self { edges, is_drawn })
    }

    /// Visits the vertices of all curves in order; the first of a curve with `true`.
    pub fn visit(mut self, mut visit: impl FnMut(u32, bool) -> io::Result<()>) -> io::Result<()> {
        for first in 0..self.edges.len() {
            let mut next = (!self.is_drawn[first]).then_some(first);
            let mut is_first = true;
            while let Some(at) = next {
                let [start, end] = self.edges[at];
                visit(start, is_first)?;
                (self.is_drawn[at], is_first) = (true, false);
                let from = self.edges.partition_point(|edge| edge[0] < end);
                let leaving = (from..self.edges.len()).take_while(|&at| self.edges[at][0] == end);
                next = leaving.into_iter().find(|&at| !self.is_drawn[at]);
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::super::samples;
    use super::*;

    #[test]
    fn coordinates_are_in_the_box_whatever_their_size() {
        for size in [1.0, 1e-320, 5e-324, 1e-200, 1e150, 1e300, f64::MAX] {
            let mut mesh = samples::square().triangulation().unwrap().clone();
            for x in &mut mesh.points {
                *x = size * (2.0 * *x - 1.0);
            }
            let frame = Frame::new(&mesh);
            let placed: Vec<[f64; 3]> =
                mesh.points.chunks_exact(2).map(|point| frame.place(point)).collect();
            let expected = [[-1., -1., 0.], [1., -1., 0.], [1., 1., 0.], [-1., 1., 0.]];
            assert_eq!(placed, expected, "{size}");
            assert_eq!(frame.sides, [1.0, 1.0, 0.0], "{size}");
            let (center, half) = frame.in_mesh();
            assert_eq!((center, half), ([0.0; 3], size), "{size}");
        }
        // A narrow box, far from the origin.
        let mut mesh = samples::square().triangulation().unwrap().clone();
        mesh.points = vec![1e6, 5.0, 1e6 + 8.0, 5.0, 1e6 + 8.0, 7.0, 1e6, 7.0];
        let frame = Frame::new(&mesh);
        assert_eq!((frame.sides, frame.in_mesh()), ([1., 0.25, 0.], ([1e6 + 4., 6., 0.], 4.)));
        assert_eq!(frame.place(&[1e6 + 2.0, 6.5]), [-0.5, 0.125, 0.0]);
    }

    #[test]
    fn numbers_are_kept_evenly() {
        let kept = |count, limit| Kept::new(count, limit).iter().collect::<Vec<_>>();
        assert_eq!(kept(3, 5), [0, 1, 2]);
        assert_eq!(kept(5, 5), [0, 1, 2, 3, 4]);
        assert_eq!(kept(10, 4), [0, 2, 5, 7]);
        assert!(kept(0, 4).is_empty());
        assert!(!Kept::new(4, 4).is_thinned() && Kept::new(5, 4).is_thinned());
        assert_eq!(Kept::new(5, 4).len(), 4);
    }

    #[test]
    fn numbers_are_short() {
        for (number, text) in [(7, "7"), (1000, "1\u{a0}000"), (1_020_003, "1\u{a0}020\u{a0}003")] {
            assert_eq!(grouped(number).to_string(), text);
        }
        for (number, text) in [
            (0.0, "0"),
            (30.0, "30"),
            (20.70481105, "20.7"),
            (0.012345678, "0.01235"),
            (123456.0, "123456"),
            (1e-9, "1.000e-9"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(figure(number).to_string(), text);
        }
    }

    #[test]
    fn the_outline_goes_round_what_is_meshed() {
        let mesh = samples::square();
        let mut visited = Vec::new();
        let outline = Outline::new(mesh.triangulation().unwrap()).unwrap();
        let visit = |vertex, is_first| {
            visited.push((vertex, is_first));
            Ok(())
        };
        outline.visit(visit).unwrap();
        assert_eq!(visited, [(0, true), (1, false), (2, false), (3, false)]);
    }

    /// Returns the sentences, each on a line of its own.
    fn quality_of(mesh: &crate::Mesh) -> Quality {
        crate::quality::measure(mesh.triangulation().unwrap()).unwrap()
    }

    fn text_of(facts: &Facts<'_>) -> String {
        let mut text = String::new();
        let visit = |line: fmt::Arguments<'_>| {
            text += &format!("{line}\n");
            Ok(())
        };
        facts.visit(visit).unwrap();
        text
    }

    #[test]
    fn the_facts_are_those_of_the_mesh() {
        let mesh = samples::finished(2);
        let quality = quality_of(&mesh);
        let facts = Facts::new(mesh.triangulation().unwrap(), &quality).unwrap();
        let text = text_of(&facts);
        let cells = mesh.triangulation().unwrap().simplex_count();
        assert!(text.contains(&format!("{} triangles\n", grouped(cells))), "{text}");
        assert!(text.contains("Bound: Voronoi aspect "), "{text}");
        let least = format!("Smallest angle {} degrees\n", figure(facts.least_angle));
        assert!(text.contains(&least) && facts.least_angle > 0.0, "{text}");
        assert!(facts.least_angle <= facts.quality.min_angle_degrees);
        let square = samples::square_with_segments();
        let quality = quality_of(&square);
        let facts = Facts::new(square.triangulation().unwrap(), &quality).unwrap();
        assert!((facts.least_angle - 45.0).abs() < 1e-12);
        assert_eq!(facts.regions, [-8, 7]);
        let text = text_of(&facts);
        let expected = "4 vertices: 2 inputs, 1 Steiner, 1 of cages\n2 triangles in 2 regions\n";
        assert!(text.starts_with(expected), "{text}");
        let mut plain = crate::Mesh::new(2, 3, &[0., 0., 1., 0., 0., 1.], 0).unwrap();
        plain.run(&samples::delaunay(), None).unwrap();
        let quality = quality_of(&plain);
        let text = text_of(&Facts::new(plain.triangulation().unwrap(), &quality).unwrap());
        let expected = "3 vertices: 3 inputs, 0 Steiner\n1 triangles\n\
                        Delaunay triangulation of the inputs, without a bound\n";
        assert!(text.starts_with(expected), "{text}");
    }
}
