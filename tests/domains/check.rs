//! Properties of the mesh of a domain, found with integers from the arrays of the result.

use super::exact::{Point, doubled_area, half_gap, in_circle, in_units, meets, turn, unit, way};
use super::shapes::Domain;
use dashu_int::IBig;
use netmesh::options::Extent;
use netmesh::validate::validate_mesh;
use netmesh::{Mesh, NONE, Triangulation};
use std::collections::{HashMap, HashSet};

/// A result, and what is looked up in it.
struct Checked<'a> {
    domain: &'a Domain,
    mesh: &'a Mesh,
    result: &'a Triangulation,
    /// The whole that the result is extracted from.
    whole: &'a Triangulation,
    /// Vertex -> the vertices at the other ends of subsegments.
    next: HashMap<u32, Vec<u32>>,
    has_crossings: bool,
}

/// Amounts of what a run's result has.
#[derive(Debug)]
pub struct Found {
    pub triangles: usize,
    pub forced: usize,
    pub limited: u64,
    /// Vertices where segments cross.
    pub crossings: usize,
}

pub fn check(domain: &Domain, mesh: &Mesh, min_angle: f64) -> Found {
    let report = validate_mesh(mesh, 3).unwrap();
    assert_eq!((report.level, report.violations), (3, 0), "{:?}", report.first);
    let result = mesh.result().unwrap();
    let whole = result.boundary.whole.as_deref().unwrap_or(result);
    let mut next: HashMap<u32, Vec<u32>> = HashMap::new();
    for &[a, b] in &whole.boundary.subsegments {
        next.entry(a).or_default().push(b);
        next.entry(b).or_default().push(a);
    }
    let distinct = mesh.inputs().distinct();
    let is_crossing =
        |(vertex, others): &(&u32, &Vec<u32>)| **vertex as usize >= distinct && others.len() > 2;
    let crossings = next.iter().filter(is_crossing).count();
    let has_crossings = crossings > 0;
    let checked = Checked { domain, mesh, result, whole, next, has_crossings };
    checked.assert_delaunay();
    let ways: Vec<Vec<u32>> = (0..domain.segments.len()).map(|at| checked.walk(at)).collect();
    checked.assert_area(&ways);
    let least_angle = checked.least_angle();
    assert!(least_angle > min_angle - 1e-6, "{least_angle}");
    let (forced, limited) = (result.boundary.forced.len(), result.stats.precision_limited);
    Found { triangles: result.simplex_count(), forced, limited, crossings }
}

impl Checked<'_> {
    fn point(&self, vertex: u32) -> &Point {
        self.whole.point(vertex).try_into().unwrap()
    }

    /// Triangles turn to the left, no vertex beyond an edge is in their circles, and subsegments
    /// are edges with no apex in their diametral circles.
    fn assert_delaunay(&self) {
        let mut edges = HashSet::new();
        let is_limited = |v: u32| self.whole.precision_limited[v as usize];
        let subsegments: HashSet<[u32; 2]> =
            self.whole.boundary.subsegments.iter().map(|&[a, b]| [a.min(b), a.max(b)]).collect();
        for simplex in 0..self.whole.simplex_count() {
            let vertices = self.whole.simplex(simplex);
            let [a, b, c] = [0, 1, 2].map(|at| self.point(vertices[at]));
            assert_eq!(turn(a, b, c), 1);
            for slot in 0..3 {
                let [from, to] = [1, 2].map(|step| vertices[(slot + step) % 3]);
                let edge = [from.min(to), from.max(to)];
                if subsegments.contains(&edge) && !(is_limited(from) && is_limited(to)) {
                    let apex = self.point(vertices[slot]);
                    assert!(way(apex, self.point(from), self.point(to)) >= 0, "{edge:?}");
                }
                edges.insert(edge);
                let beyond = self.whole.neighbors[3 * simplex + slot];
                if beyond != NONE && beyond as usize > simplex {
                    let own = |vertex: &&u32| !vertices.contains(vertex);
                    let apex = self.whole.simplex(beyond as usize).iter().find(own).unwrap();
                    assert!(in_circle(a, b, c, self.point(*apex)) <= 0, "{simplex} {beyond}");
                }
            }
        }
        assert!(subsegments.is_subset(&edges));
    }

    /// The vertices of a segment from end to end: those nearest to it that subsegments join.
    fn walk(&self, segment: usize) -> Vec<u32> {
        let ends = self.domain.segments[segment];
        let [start, end] = ends.map(|input| self.mesh.inputs().vertices()[input as usize]);
        let mut reached = HashMap::from([(start, start)]);
        let mut waiting = vec![start];
        while let Some(vertex) = waiting.pop().filter(|_| !reached.contains_key(&end)) {
            for &next in &self.next[&vertex] {
                if !reached.contains_key(&next) && self.goes_on([start, end], vertex, next) {
                    reached.insert(next, vertex);
                    waiting.push(next);
                }
            }
        }
        assert!(reached.contains_key(&end), "segment {segment} has a gap");
        let mut way = vec![end];
        while way[way.len() - 1] != start {
            way.push(reached[&way[way.len() - 1]]);
        }
        way.reverse();
        self.assert_inputs_on(segment, [start, end], &way);
        way
    }

    /// Returns true if a chain between `ends` may lead from one vertex to another.
    fn goes_on(&self, ends: [u32; 2], vertex: u32, next: u32) -> bool {
        let [from, to] = ends.map(|end| self.point(end));
        let (at, x) = (self.point(vertex), self.point(next));
        // On the axis on which the segment is most units long; level there, any way that is left.
        let half = [0, 1].map(|axis| half_gap(from[axis].abs().max(to[axis].abs())));
        let steps = [0, 1].map(|axis| (to[axis] - from[axis]).abs() / half[axis]);
        let axis = usize::from(steps[1] > steps[0]);
        let advances = match from[axis] <= to[axis] {
            true => at[axis] <= x[axis] && x[axis] <= to[axis],
            false => at[axis] >= x[axis] && x[axis] >= to[axis],
        };
        let is_input = (next as usize) < self.mesh.inputs().distinct();
        let is_near = match is_input || self.has_crossings {
            // Sixteen units.
            true => meets(from, to, x, half.map(|half| 32.0 * half)),
            false => meets(from, to, x, x.map(half_gap)),
        };
        advances && is_near
    }

    /// All inputs on a segment are on its way. For few inputs.
    fn assert_inputs_on(&self, segment: usize, ends: [u32; 2], way: &[u32]) {
        let count = self.mesh.inputs().distinct();
        if self.has_crossings || count > 2000 {
            return;
        }
        let [from, to] = ends.map(|end| self.point(end));
        for vertex in 0..count as u32 {
            let x = self.point(vertex);
            let is_within = |k: usize| from[k].min(to[k]) <= x[k] && x[k] <= from[k].max(to[k]);
            if is_within(0) && is_within(1) && turn(from, to, x) == 0 {
                assert!(way.contains(&vertex), "input {vertex} on segment {segment}");
            }
        }
    }

    /// The triangles have the area of the polygons through the vertices of the curves, and nearly
    /// that of the caller's.
    fn assert_area(&self, ways: &[Vec<u32>]) {
        if self.result.parameters.extent != Extent::Boundary || self.domain.curves.is_empty() {
            return;
        }
        let all: Vec<Point> =
            (0..self.whole.vertex_count() as u32).map(|vertex| *self.point(vertex)).collect();
        let unit = unit(&all);
        let of_triangle = |simplex: usize| {
            let vertices = self.result.simplex(simplex);
            doubled_area(&[0, 1, 2].map(|at: usize| *self.point(vertices[at])), unit)
        };
        let area: IBig = (0..self.result.simplex_count()).map(of_triangle).sum();
        let (mut of_ways, mut of_curves, mut slack) = (IBig::ZERO, IBig::ZERO, IBig::ZERO);
        let vertex = |input: u32| self.mesh.inputs().vertices()[input as usize];
        let pairs = self.domain.segments.iter().map(|ends| ends.map(vertex));
        let numbers: HashMap<[u32; 2], usize> = pairs.zip(0..).collect();
        for (curve, times) in &self.domain.curves {
            let mut points: Vec<Point> = Vec::new();
            for at in 0..curve.len() {
                let [a, b] = [at, (at + 1) % curve.len()].map(|at| vertex(curve[at]));
                let mut way = match numbers.get(&[a, b]) {
                    Some(&segment) => ways[segment].clone(),
                    None => ways[numbers[&[b, a]]].iter().rev().copied().collect(),
                };
                way.remove(0);
                points.extend(way.iter().map(|&vertex| *self.point(vertex)));
            }
            of_ways += doubled_area(&points, unit) * *times;
            let corners: Vec<Point> =
                curve.iter().map(|&input| self.domain.points[input as usize]).collect();
            of_curves += doubled_area(&corners, unit) * *times;
            for pair in points.windows(2) {
                let size = pair.as_flattened().iter().fold(0.0, |size: f64, x| size.max(x.abs()));
                let gap = in_units(half_gap(size) * 16.0, unit - 64);
                for (from, to) in pair[0].iter().zip(&pair[1]) {
                    let way = in_units(*to, unit) - in_units(*from, unit);
                    slack += if way < IBig::ZERO { -way } else { way } * &gap;
                }
            }
        }
        assert_eq!(area, of_ways);
        let difference = (area - of_curves) << 64;
        assert!(difference <= slack && -difference <= slack);
    }

    /// The smallest angle of the simplices that neither a corner forces nor doubles limit.
    fn least_angle(&self) -> f64 {
        let result = self.result;
        let forced: HashSet<u32> = result.boundary.forced.iter().copied().collect();
        let counts = |&simplex: &usize| {
            let vertices = result.simplex(simplex);
            let is_limited = vertices.iter().any(|&v| result.precision_limited[v as usize]);
            let is_in_cage = vertices.iter().any(|&v| result.cage_of[v as usize] != NONE);
            !is_limited && !is_in_cage && !forced.contains(&(simplex as u32))
        };
        let angle = |simplex: usize| {
            let vertices = result.simplex(simplex);
            smallest_angle([0, 1, 2].map(|at| self.point(vertices[at])))
        };
        let of_one_domain = |simplex: &usize| {
            let domains =
                result.simplex(*simplex).iter().map(|&v| result.vertex_domains[v as usize]);
            domains.collect::<HashSet<u32>>().len() == 1
        };
        (0..result.simplex_count())
            .filter(counts)
            .filter(of_one_domain)
            .map(angle)
            .fold(60.0, f64::min)
    }
}

fn smallest_angle(corners: [&Point; 3]) -> f64 {
    let most = corners.iter().flat_map(|p| p.iter()).fold(0.0, |most: f64, x| most.max(x.abs()));
    let scale = if most > 1e200 { 2f64.powi(-500) } else { 1.0 };
    let side = |a: usize, b: usize| {
        let way = [0, 1].map(|axis| corners[a][axis] * scale - corners[b][axis] * scale);
        let largest = way[0].abs().max(way[1].abs());
        largest * (way[0] / largest).hypot(way[1] / largest)
    };
    let mut sides = [side(0, 1), side(1, 2), side(2, 0)];
    sides.sort_by(f64::total_cmp);
    let [least, x, y] = sides.map(|side| side / sides[2]);
    ((x * x + y * y - least * least) / (2.0 * x * y)).clamp(-1.0, 1.0).acos().to_degrees()
}
