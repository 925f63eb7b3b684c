//! Meshes of facets in space, made by hand: Delaunay triangulations of points that happen to have
//! the facets, with the arrays that a run would give them.

use super::meshes::{Case, run};
use netmesh::mesh::{Boundary, Boxed, Facets};
use netmesh::numerics::{Sign, orientation};
use netmesh::options::{Algorithm, Extent, Options};
use netmesh::validate::{Outline, Report, ViolationKind as Kind, validate_outlined};
use netmesh::{Inputs, NONE, Region, Segments, Triangulation};

type Point = [f64; 3];

/// Point in a projection.
type Flat = [f64; 2];

/// Points, facets and segments that a solid is made of.
#[derive(Clone, Default)]
pub struct Plan {
    pub points: Vec<Point>,
    /// Number of the points that are inputs.
    pub inputs: usize,
    pub facets: Vec<Vec<Vec<u32>>>,
    pub are_triangles: bool,
    /// Facet of the caller's -> the facet that it is of, for triangles.
    pub parents: Vec<u32>,
    pub segments: Vec<[u32; 2]>,
    pub regions: Vec<Region>,
    /// Vertex -> the facets that it is on, where roundings do not show that; then facets are where
    /// the domain ends.
    pub facets_at: Vec<Vec<u32>>,
}

/// Result and what it was made of.
#[derive(Clone)]
pub struct Solid {
    pub case: Case,
    pub facets: Facets,
    pub segments: Segments,
    pub regions: Vec<Region>,
}

/// Returns facets in one or more loops each.
pub fn facets_of(loops: &[Vec<Vec<u32>>], are_triangles: bool) -> Facets {
    let mut facets = Facets { are_triangles, ..Facets::default() };
    (facets.loop_starts, facets.input_starts) = (vec![0], vec![0]);
    for facet in loops {
        for corners in facet {
            facets.inputs.extend(corners);
            facets.input_starts.push(facets.inputs.len() as u32);
        }
        facets.loop_starts.push(facets.input_starts.len() as u32 - 1);
        facets.markers.push(0);
    }
    facets
}

/// Returns the coordinates without that of the axis along which a polygon has the largest area.
fn projected(loops: &[Vec<Point>], points: &[Point]) -> (Vec<Vec<Flat>>, Vec<Flat>, f64) {
    let flat = |axis: usize, p: &Point| [p[(axis + 1) % 3], p[(axis + 2) % 3]];
    let area = |axis: usize| -> f64 {
        let corners: Vec<[f64; 2]> = loops[0].iter().map(|p| flat(axis, p)).collect();
        let edges = corners.iter().zip(corners.iter().cycle().skip(1));
        edges.map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum()
    };
    let axis = (0..3).max_by(|&i, &j| area(i).abs().total_cmp(&area(j).abs())).unwrap();
    let outlines = loops.iter().map(|corners| corners.iter().map(|p| flat(axis, p)).collect());
    (outlines.collect(), points.iter().map(|p| flat(axis, p)).collect(), area(axis))
}

fn is_inside(loops: &[Vec<[f64; 2]>], p: [f64; 2]) -> bool {
    let mut crossings = 0;
    for corners in loops.iter().filter(|corners| corners.len() > 2) {
        for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            let (low, high) = if a[1] < b[1] { (a, b) } else { (b, a) };
            let turn = (high[0] - low[0]) * (p[1] - low[1]) - (high[1] - low[1]) * (p[0] - low[0]);
            crossings += usize::from(low[1] <= p[1] && p[1] < high[1] && turn > 0.0);
        }
    }
    crossings % 2 == 1
}

/// Returns the points on an edge, in order from end to end.
fn on_edge(points: &[Point], [a, b]: [u32; 2]) -> Vec<u32> {
    let [from, to] = [a, b].map(|end| points[end as usize]);
    let along: Point = std::array::from_fn(|k| to[k] - from[k]);
    let length: f64 = along.iter().map(|x| x * x).sum();
    let mut found: Vec<(f64, u32)> = Vec::new();
    for (vertex, point) in points.iter().enumerate() {
        let off: Point = std::array::from_fn(|k| point[k] - from[k]);
        let share = off.iter().zip(&along).map(|(x, y)| x * y).sum::<f64>() / length;
        let gap = (0..3).map(|k| (off[k] - share * along[k]).abs()).fold(0.0, f64::max);
        if (0.0..=1.0).contains(&share) && gap < 1e-12 {
            found.push((share, vertex as u32));
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found.into_iter().map(|(_, vertex)| vertex).collect()
}

impl Plan {
    /// Makes the mesh; its domain is where `label` gives one for the middle of a simplex.
    pub fn build(&self, label: impl Fn(Point) -> Option<i32>) -> Solid {
        let options = Options { algorithm: Algorithm::Delaunay, ..Options::default() };
        let mut case = run(&self.points, &options);
        let given = &self.points[..self.inputs];
        case.inputs = Inputs::new(3, given.len(), given.as_flattened(), 0).unwrap();
        let labels = arrange(&mut case.mesh, label);
        let count = labels.iter().take_while(|label| label.is_some()).count();
        case.mesh.parameters.extent = Extent::Boundary;
        let mut boundary = Boundary {
            simplex_regions: labels.into_iter().map(|label| label.unwrap_or(0)).collect(),
            ..Boundary::default()
        };
        let faces = Faces::of(&case.mesh);
        self.add_subfacets(&faces, count as u32, &mut boundary);
        self.add_subsegments(&mut boundary);
        case.mesh.boundary = boundary;
        let segments = Segments {
            inputs: self.segments.clone(),
            markers: vec![0; self.segments.len()],
            sides: Vec::new(),
        };
        let facets = facets_of(&self.facets, self.are_triangles);
        let mut solid = Solid { case, facets, segments, regions: self.regions.clone() };
        if count < solid.case.mesh.simplex_count() {
            solid.crop(count);
        }
        solid
    }

    fn corners(&self, loops: &[Vec<u32>]) -> Vec<Vec<Point>> {
        let point = |corner: &u32| self.points[*corner as usize];
        loops.iter().map(|corners| corners.iter().map(point).collect()).collect()
    }

    fn add_subfacets(&self, faces: &Faces, count: u32, boundary: &mut Boundary) {
        let mut rows = Vec::new();
        for (number, loops) in self.facets.iter().enumerate() {
            let corners = self.corners(loops);
            for (face, sides) in &faces.all {
                let points = face.map(|vertex| self.points[vertex as usize]);
                let is_end = sides.iter().filter(|&&side| side < count).count() == 1;
                let is_on = |vertex: &u32| match self.facets_at.get(*vertex as usize) {
                    Some(facets) => is_end && facets.contains(&(number as u32)),
                    None => {
                        let [a, b, c] = [0, 1, 2].map(|at| &corners[0][at]);
                        orientation(&[a, b, c, &self.points[*vertex as usize]]) == Sign::Zero
                    }
                };
                if !face.iter().all(is_on) {
                    continue;
                }
                let middle: Point =
                    std::array::from_fn(|k| points.map(|p| p[k]).iter().sum::<f64>() / 3.0);
                let all: Vec<Point> = points.into_iter().chain([middle]).collect();
                let (outline, flat, area) = projected(&corners, &all);
                if !is_inside(&outline, flat[3]) {
                    continue;
                }
                let [a, b, c] = [0, 1, 2].map(|at| flat[at]);
                let turn = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
                let parent = self.parents.get(number).copied().unwrap_or(number as u32);
                let (mut vertices, [behind, before]) = (*face, *sides);
                let mut both = [before, behind];
                if turn * area < 0.0 {
                    vertices.swap(1, 2);
                    both.reverse();
                }
                rows.push((parent, vertices, both));
            }
        }
        rows.sort_unstable();
        for (parent, vertices, sides) in rows {
            boundary.subfacets.push(vertices);
            boundary.subfacet_parents.push(parent);
            boundary.subfacet_simplices.push(sides);
        }
    }

    fn add_subsegments(&self, boundary: &mut Boundary) {
        let mut seen: Vec<[u32; 2]> = Vec::new();
        let mut add = |ends: [u32; 2], segment: u32| {
            for pair in on_edge(&self.points, ends).windows(2) {
                let key = [pair[0].min(pair[1]), pair[0].max(pair[1])];
                if !seen.contains(&key) {
                    seen.push(key);
                    boundary.subsegments.push([pair[0], pair[1]]);
                    boundary.parents.push(segment);
                }
            }
        };
        for (number, &ends) in self.segments.iter().enumerate() {
            add(ends, number as u32);
        }
        let parent = |number: usize| self.parents.get(number).copied().unwrap_or(number as u32);
        let mut edges: Vec<([u32; 2], u32)> = Vec::new();
        for (number, facet) in self.facets.iter().enumerate() {
            for corners in facet.iter().filter(|corners| corners.len() > 1) {
                let next = corners.iter().cycle().skip(1);
                let pairs = corners.iter().zip(next).map(|(&a, &b)| [a.min(b), a.max(b)]);
                edges.extend(pairs.map(|pair| (pair, parent(number))));
            }
        }
        edges.sort_unstable();
        for same in edges.chunk_by(|a, b| a.0 == b.0) {
            let is_inner =
                self.are_triangles && matches!(same, [(_, one), (_, other)] if one == other);
            if !is_inner {
                add(same[0].0, NONE);
            }
        }
    }
}

/// Faces of a mesh with the simplices behind and before them.
struct Faces {
    all: Vec<([u32; 3], [u32; 2])>,
}

impl Faces {
    fn of(mesh: &Triangulation) -> Self {
        let mut all = Vec::new();
        for simplex in 0..mesh.simplex_count() {
            let [a, b, c, d]: [u32; 4] = mesh.simplex(simplex).try_into().unwrap();
            // Their normals point out of the simplex.
            let faces = [[b, c, d], [a, d, c], [a, b, d], [a, c, b]];
            for (face, &neighbor) in faces.into_iter().zip(mesh.neighbors_of(simplex)) {
                if neighbor == NONE || neighbor as usize > simplex {
                    all.push((face, [simplex as u32, neighbor]));
                }
            }
        }
        Self { all }
    }
}

/// Puts the simplices with a label first, and returns the labels in the new order.
fn arrange(mesh: &mut Triangulation, label: impl Fn(Point) -> Option<i32>) -> Vec<Option<i32>> {
    let middle = |simplex: usize| -> Point {
        let vertices = mesh.simplex(simplex);
        std::array::from_fn(|k| vertices.iter().map(|&v| mesh.point(v)[k]).sum::<f64>() / 4.0)
    };
    let labels: Vec<Option<i32>> = (0..mesh.simplex_count()).map(|s| label(middle(s))).collect();
    let mut order: Vec<usize> = (0..labels.len()).collect();
    order.sort_by_key(|&simplex| labels[simplex].is_none());
    let mut new = vec![0; order.len()];
    order.iter().enumerate().for_each(|(at, &simplex)| new[simplex] = at as u32);
    let renumbered = |id: u32| if id == NONE { NONE } else { new[id as usize] };
    let (simplices, neighbors) = (mesh.simplices.clone(), mesh.neighbors.clone());
    mesh.simplices = order.iter().flat_map(|&s| simplices[4 * s..][..4].to_vec()).collect();
    mesh.neighbors =
        order.iter().flat_map(|&s| neighbors[4 * s..][..4].to_vec()).map(renumbered).collect();
    order.iter().map(|&simplex| labels[simplex]).collect()
}

impl Solid {
    pub fn report(&self, level: u32) -> Report {
        let Self { facets, segments, regions, .. } = self;
        let outline = Outline { segments, facets, regions };
        validate_outlined(&self.case.inputs, outline, &self.case.mesh, level).unwrap()
    }

    pub fn assert_sound(&self, level: u32) {
        let report = self.report(level);
        assert_eq!((report.level, report.violations, report.first), (level, 0, None));
    }

    pub fn assert_violates(&self, kind: Kind) {
        let report = self.report(kind.level());
        let first = report.first.unwrap_or_else(|| panic!("{kind:?} went unseen"));
        assert_eq!(first.kind, kind, "{}", first.message);
        assert_eq!(report.level, kind.level() - 1);
    }

    /// Returns the triangulation of all of the hull.
    pub fn whole(&mut self) -> &mut Triangulation {
        let mesh = &mut self.case.mesh;
        if mesh.boundary.whole.is_none() {
            return mesh;
        }
        mesh.boundary.whole.as_mut().unwrap()
    }

    /// Makes the first simplices of the whole the domain.
    pub fn crop(&mut self, count: usize) {
        let whole = self.whole().clone();
        let last = whole.simplices[..4 * count].iter().max().unwrap();
        let vertices = (*last as usize + 1).max(self.case.inputs.distinct());
        let mut cut = whole.clone();
        cut.points.truncate(3 * vertices);
        cut.kinds.truncate(vertices);
        cut.vertex_domains.truncate(vertices);
        cut.cage_of.truncate(vertices);
        cut.precision_limited.truncate(vertices);
        cut.sizes.truncate(vertices);
        cut.simplices.truncate(4 * count);
        cut.neighbors.truncate(4 * count);
        let inside = |id: u32| if (id as usize) < count { id } else { NONE };
        cut.neighbors.iter_mut().for_each(|id| *id = inside(*id));
        cut.boundary = cut_boundary(&whole, count);
        cut.boundary.whole = Some(Boxed::new(whole).unwrap());
        self.case.mesh = cut;
    }

    /// Corrupts the whole, and crops as before.
    pub fn corrupt(&mut self, corrupt: impl FnOnce(&mut Triangulation)) {
        let count = self.case.mesh.simplex_count();
        let is_cropped = self.case.mesh.boundary.whole.is_some();
        corrupt(self.whole());
        if is_cropped {
            self.crop(count);
        }
    }

    /// Finds the simplices of the subfacets again.
    pub fn find_sides(&mut self) {
        self.corrupt(|mesh| {
            let faces = Faces::of(mesh);
            let sorted = |mut face: [u32; 3]| {
                face.sort_unstable();
                face
            };
            let boundary = &mut mesh.boundary;
            boundary.subfacet_simplices.clear();
            for &[a, b, c] in &boundary.subfacets {
                let same = |(face, _): &&([u32; 3], _)| sorted(*face) == sorted([a, b, c]);
                let found = faces.all.iter().find(same);
                let sides = found.map_or([NONE; 2], |&(face, [behind, before])| {
                    let is_along = [[a, b, c], [b, c, a], [c, a, b]].contains(&face);
                    if is_along { [before, behind] } else { [behind, before] }
                });
                boundary.subfacet_simplices.push(sides);
            }
        });
    }
}

fn cut_boundary(whole: &Triangulation, count: usize) -> Boundary {
    let all = &whole.boundary;
    let mut own = Boundary { forced: all.forced.clone(), ..Boundary::default() };
    let inside = |id: u32| if (id as usize) < count { id } else { NONE };
    own.simplex_regions = all.simplex_regions.iter().copied().take(count).collect();
    own.flat = all.flat.iter().copied().filter(|&id| inside(id) != NONE).collect();
    let simplices = || whole.simplices[..4 * count].chunks(4);
    for (ends, &parent) in all.subsegments.iter().zip(&all.parents) {
        if simplices().any(|simplex| ends.iter().all(|end| simplex.contains(end))) {
            own.subsegments.push(*ends);
            own.parents.push(parent);
        }
    }
    for (at, sides) in all.subfacet_simplices.iter().enumerate() {
        let sides = sides.map(inside);
        if sides != [NONE; 2] {
            own.subfacets.push(all.subfacets[at]);
            own.subfacet_parents.push(all.subfacet_parents[at]);
            own.subfacet_simplices.push(sides);
        }
    }
    own
}
