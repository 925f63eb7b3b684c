//! Where each simplex lies with respect to the inputs' hull or their box.

use super::separation::{Pair, Plane};
use crate::error::{Error, ErrorKind, Result};
use crate::memory::{AllocResult, TryGrow, collected, enqueue, filled, with_capacity};
use crate::mesh::{NONE, Triangulation, in_dimension};
use crate::query::view::{View, coordinates};
use crate::query::{Index, Place, check_arrays};
use std::collections::VecDeque;

/// Where a simplex lies with respect to a convex body, exactly. A body in a hyperplane has no
/// simplex inside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Placement {
    /// All of it is in the body, whose boundary is part of it.
    Inside = 0,
    /// Its interior meets the body, and some of it is outside.
    Across = 1,
    /// Its interior does not meet the body.
    Outside = 2,
}

/// Where a vertex is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Spot {
    Outside,
    /// In the body; perhaps on its boundary.
    In,
    Interior,
}

/// The convex hull of points, for exact questions.
pub struct ConvexHull {
    dim: usize,
    /// `corners x dim`: all extreme points, and perhaps others of the hull.
    corners: Vec<f64>,
    /// The Delaunay triangulation of the corners and perhaps of other points of the hull, and its
    /// index, unless the points lie in a hyperplane.
    solid: Option<(Triangulation, Index)>,
}

impl ConvexHull {
    /// The union of a Delaunay triangulation.
    ///
    /// # Errors
    /// `InvalidArgument` (arrays that do not fit together), `OutOfMemory`.
    pub fn of_triangulation(mesh: Triangulation) -> Result<Self> {
        let index = Index::new(&mesh)?;
        let mut corners = Vec::new();
        for (vertex, &on_hull) in hull_vertices(&mesh)?.iter().enumerate() {
            if on_hull {
                corners.try_extend(mesh.point(vertex as u32))?;
            }
        }
        Ok(Self { dim: mesh.dim, corners, solid: Some((mesh, index)) })
    }

    /// The hull of points in a hyperplane, `points x dim`; the fewer that are not extreme, the
    /// faster.
    pub fn of_flat_points(dim: usize, points: Vec<f64>) -> Self {
        Self { dim, corners: points, solid: None }
    }

    /// Points of the hull, all extreme ones among them.
    pub fn corners(&self) -> impl ExactSizeIterator<Item = &[f64]> {
        self.corners.chunks_exact(self.dim)
    }

    /// Where each simplex lies.
    ///
    /// # Errors
    /// `InvalidArgument` (a mesh of another dimension; arrays that do not fit together),
    /// `OutOfMemory`.
    pub fn placements(&self, mesh: &Triangulation, threads: u32) -> Result<Vec<Placement>> {
        check_arrays(mesh)?;
        if mesh.dim != self.dim {
            let rule = "the mesh and the hull are of different dimensions";
            return Err(Error::new(ErrorKind::InvalidArgument, rule));
        }
        let mut places = filled(mesh.vertex_count(), Place::OUTSIDE)?;
        let mut spots = with_capacity(places.len())?;
        if let Some((solid, index)) = &self.solid {
            index.places(solid, &mesh.points, threads, &mut places)?;
            let on_hull = hull_vertices(solid)?;
            spots.extend(places.iter().map(|&place| spot(solid, &on_hull, place)));
        } else {
            spots.resize(places.len(), Spot::Outside);
        }
        let none = || Ok(Vec::new());
        Ok(
            in_dimension!(mesh.dim, D => Body::<D>::new(&self.corners)?.place(mesh, &spots), _ => none())?,
        )
    }
}

/// Where each simplex of a mesh lies with respect to the least box with sides along the axes that
/// holds the `points` (`points x dim`, at least one).
///
/// # Errors
/// `InvalidArgument` (arrays that do not fit together), `OutOfMemory`.
pub fn placements_in_box(mesh: &Triangulation, points: &[f64]) -> Result<Vec<Placement>> {
    check_arrays(mesh)?;
    let none = || Ok(Vec::new());
    Ok(in_dimension!(mesh.dim, D => in_box::<D>(mesh, points), _ => none())?)
}

fn in_box<const D: usize>(mesh: &Triangulation, points: &[f64]) -> AllocResult<Vec<Placement>> {
    let (low, high) = bounds::<D>(points);
    let corner = |set: usize| -> [f64; D] {
        std::array::from_fn(|axis| if set >> axis & 1 == 1 { high[axis] } else { low[axis] })
    };
    let mut corners = with_capacity(D << D)?;
    (0..1 << D).for_each(|set| corners.extend(corner(set)));
    let spot = |vertex: u32| {
        let point = View::<D> { mesh }.point(vertex);
        let all = |test: &dyn Fn(f64, usize) -> bool| (0..D).all(|axis| test(point[axis], axis));
        if all(&|x, axis| low[axis] < x && x < high[axis]) {
            Spot::Interior
        } else if all(&|x, axis| low[axis] <= x && x <= high[axis]) {
            Spot::In
        } else {
            Spot::Outside
        }
    };
    let spots = collected((0..mesh.vertex_count() as u32).map(spot))?;
    Body::<D>::new(&corners)?.place(mesh, &spots)
}

fn bounds<const D: usize>(points: &[f64]) -> ([f64; D], [f64; D]) {
    let (mut low, mut high) = ([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
    for at in 0..points.len() / D {
        for (axis, &x) in coordinates::<D>(points, at).iter().enumerate() {
            low[axis] = low[axis].min(x);
            high[axis] = high[axis].max(x);
        }
    }
    (low, high)
}

/// Vertex -> whether it is on the hull.
fn hull_vertices(mesh: &Triangulation) -> AllocResult<Vec<bool>> {
    let mut on_hull = filled(mesh.vertex_count(), false)?;
    for simplex in 0..mesh.simplex_count() {
        let (vertices, neighbors) = (mesh.simplex(simplex), mesh.neighbors_of(simplex));
        for i in (0..=mesh.dim).filter(|&i| neighbors[i] == NONE) {
            let others = vertices.iter().enumerate().filter(|&(k, _)| k != i);
            others.for_each(|(_, &vertex)| on_hull[vertex as usize] = true);
        }
    }
    Ok(on_hull)
}

/// Where a point is of which its place in the hull's triangulation is known.
fn spot(solid: &Triangulation, on_hull: &[bool], place: Place) -> Spot {
    let Some(dimension) = place.dimension() else { return Spot::Outside };
    let (vertices, dim) = (solid.simplex(place.simplex as usize), solid.dim);
    let is_inner = match dimension as usize {
        whole if whole == dim => true,
        // A facet is on the hull just if it has one simplex.
        facet if facet + 1 == dim => {
            solid.neighbors_of(place.simplex as usize)[place.face.trailing_ones() as usize] != NONE
        }
        _ => (0..=dim).any(|i| place.face >> i & 1 == 1 && !on_hull[vertices[i] as usize]),
    };
    if is_inner { Spot::Interior } else { Spot::In }
}

/// The hull of some points, and the box round it.
struct Body<const D: usize> {
    corners: Vec<[f64; D]>,
    low: [f64; D],
    high: [f64; D],
}

impl<const D: usize> Body<D> {
    fn new(corners: &[f64]) -> AllocResult<Self> {
        let (low, high) = bounds(corners);
        let count = corners.len() / D;
        let corners = collected((0..count).map(|at| *coordinates(corners, at)))?;
        Ok(Self { corners, low, high })
    }

    fn place(self, mesh: &Triangulation, spots: &[Spot]) -> AllocResult<Vec<Placement>> {
        let view = View::<D> { mesh };
        let known = (0..mesh.simplex_count() as u32).map(|s| self.at_once(view, s, spots));
        let mut placements = collected(known)?;
        let (points, planes, queue) = (self.corners, Vec::new(), VecDeque::new());
        let mut walk = Walk { points, view, planes, queue, used: Vec::new() };
        walk.settle(&mut placements)?;
        Ok(placements.into_iter().map(|placement| placement.unwrap_or(Placement::Across)).collect())
    }

    /// The placement of a simplex, if its vertices tell it.
    fn at_once(&self, view: View<'_, D>, simplex: u32, spots: &[Spot]) -> Option<Placement> {
        let vertices = view.simplex(simplex);
        let spot = |vertex: &u32| spots[*vertex as usize];
        if vertices.iter().all(|vertex| spot(vertex) != Spot::Outside) {
            return Some(Placement::Inside);
        }
        if vertices.iter().any(|vertex| spot(vertex) == Spot::Interior) {
            return Some(Placement::Across);
        }
        let points = || vertices.iter().map(|&vertex| view.point(vertex));
        let is_beyond = (0..D).any(|axis| {
            points().all(|p| p[axis] >= self.high[axis])
                || points().all(|p| p[axis] <= self.low[axis])
        });
        is_beyond.then_some(Placement::Outside)
    }
}

/// Goes from simplex to neighbour: what separates one often separates the next.
struct Walk<'a, const D: usize> {
    /// Those of the hull: first those that decided last, which are near.
    points: Vec<[f64; D]>,
    view: View<'a, D>,
    planes: Vec<Plane<D>>,
    queue: VecDeque<u32>,
    /// Places of points that decide.
    used: Vec<usize>,
}

/// As many of the planes that were found last are tried at a simplex.
const RECENT: usize = 16;

impl<const D: usize> Walk<'_, D> {
    /// Finds the placements that are not known.
    fn settle(&mut self, placements: &mut [Option<Placement>]) -> AllocResult<()> {
        let mut plane_of = filled(placements.len(), NONE)?;
        for seed in 0..placements.len() as u32 {
            enqueue(&mut self.queue, seed)?;
            while let Some(simplex) = self.queue.pop_front() {
                if placements[simplex as usize].is_some() {
                    continue;
                }
                let plane = self.plane(simplex, &plane_of)?;
                plane_of[simplex as usize] = plane;
                let is_apart = plane != NONE;
                placements[simplex as usize] =
                    Some(if is_apart { Placement::Outside } else { Placement::Across });
                for &neighbor in self.view.neighbors(simplex) {
                    if neighbor != NONE && placements[neighbor as usize].is_none() {
                        enqueue(&mut self.queue, neighbor)?;
                    }
                }
            }
        }
        Ok(())
    }

    /// The number of a plane that separates a simplex from the body; [`NONE`] if none does.
    fn plane(&mut self, simplex: u32, plane_of: &[u32]) -> AllocResult<u32> {
        let points = self.view.points_of(self.view.simplex(simplex));
        let points = &points[..=D];
        for &neighbor in self.view.neighbors(simplex) {
            let plane = if neighbor == NONE { NONE } else { plane_of[neighbor as usize] };
            if plane != NONE && self.planes[plane as usize].separates(points) {
                return Ok(plane);
            }
        }
        let recent = self.planes.len().saturating_sub(RECENT)..self.planes.len();
        if let Some(plane) = recent.rev().find(|&plane| self.planes[plane].separates(points)) {
            return Ok(plane as u32);
        }
        self.used.clear();
        let pair = Pair { simplex: points, points: &self.points };
        let plane = pair.separation(&mut self.used)?;
        self.bring_to_front();
        let Some(plane) = plane else { return Ok(NONE) };
        self.planes.try_push(plane)?;
        Ok(self.planes.len() as u32 - 1)
    }

    /// Brings the points that were used before the others: the next simplex is near this one.
    fn bring_to_front(&mut self) {
        self.used.sort_unstable();
        self.used.dedup();
        self.used.iter().enumerate().for_each(|(front, &at)| self.points.swap(front, at));
    }
}
