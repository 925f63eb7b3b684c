//! The Voronoi diagram as SciPy's users know it: corners that coincide are one, and ridges that
//! shrink to less than a facet because of that are none.

use crate::core::Core;
use crate::derived::{Lists, ids, lists};
use crate::errors::abandonable;
use netmesh::arrays;
use netmesh::numerics::{Sign, in_ball, orientation};
use netmesh::{NONE, Triangulation};
use numpy::prelude::*;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use std::sync::Arc;

struct Diagram {
    /// A simplex of each corner.
    simplices: Vec<u32>,
    /// `ridges x 2` vertices of the mesh.
    ridges: Vec<u32>,
    /// Corners of each ridge; [`NONE`] first if the ridge is unbounded. So for regions below.
    ridge_corners: arrays::Lists,
    region_corners: arrays::Lists,
}

type Arrays<'py> = (Bound<'py, PyArray1<i32>>, Bound<'py, PyArray2<i32>>, Lists<'py>, Lists<'py>);

#[pymethods]
impl Core {
    /// Returns a simplex of each corner, the ridges, the corners of ridges and those of regions.
    fn merged_voronoi<'py>(&self, py: Python<'py>) -> PyResult<Arrays<'py>> {
        let made = Arc::clone(&self.made);
        let Diagram { simplices, ridges, ridge_corners, region_corners } =
            abandonable(py, move || {
                let mesh = made.triangulation();
                let part = made.mesh.whole()?;
                let (regions, ridges) = (part.regions()?, part.ridges()?);
                let mut is_bounded = vec![true; mesh.vertex_count()];
                part.hull()?
                    .vertices
                    .iter()
                    .for_each(|&vertex| is_bounded[vertex as usize] = false);
                Ok(match mesh.dim {
                    2 => diagram::<2>(mesh, &ridges, &regions, &is_bounded),
                    3 => diagram::<3>(mesh, &ridges, &regions, &is_bounded),
                    4 => diagram::<4>(mesh, &ridges, &regions, &is_bounded),
                    5 => diagram::<5>(mesh, &ridges, &regions, &is_bounded),
                    6 => diagram::<6>(mesh, &ridges, &regions, &is_bounded),
                    7 => diagram::<7>(mesh, &ridges, &regions, &is_bounded),
                    _ => diagram::<8>(mesh, &ridges, &regions, &is_bounded),
                })
            })?;
        let ridges = ids(py, ridges, self.count_of_vertices())?;
        Ok((
            ids(py, simplices, self.count_of_simplices())?,
            ridges.reshape([ridges.len() / 2, 2])?,
            lists(py, ridge_corners, self.count_of_simplices())?,
            lists(py, region_corners, self.count_of_simplices())?,
        ))
    }
}

fn diagram<const D: usize>(
    mesh: &Triangulation,
    all: &arrays::Ridges,
    regions: &arrays::Lists,
    is_bounded: &[bool],
) -> Diagram {
    let corners = Corners::<D>::new(mesh);
    let mut ridges = Vec::new();
    let mut ridge_corners = arrays::Lists { starts: vec![0], ids: Vec::new() };
    let of_ridges = all.corners.iter().zip(&all.is_bounded);
    for (ends, (star, &is_bounded)) in all.vertices.chunks_exact(2).zip(of_ridges) {
        if corners.are_apart(star) || corners.is_ridge(ends, star) {
            ridges.extend_from_slice(ends);
            corners.add(star, is_bounded, &mut ridge_corners);
        }
    }
    let mut region_corners = arrays::Lists { starts: vec![0], ids: Vec::new() };
    for (star, &is_bounded) in regions.iter().zip(is_bounded) {
        corners.add(star, is_bounded, &mut region_corners);
    }
    Diagram { simplices: corners.simplices, ridges, ridge_corners, region_corners }
}

/// The corners of simplices: neighbours whose vertices lie on one sphere share one.
struct Corners<'a, const D: usize> {
    mesh: &'a Triangulation,
    /// Simplex -> corner.
    of: Vec<u32>,
    /// Corner -> the least simplex that has it.
    simplices: Vec<u32>,
}

impl<'a, const D: usize> Corners<'a, D> {
    fn new(mesh: &'a Triangulation) -> Self {
        let count = mesh.simplex_count() as u32;
        let mut corners = Self { mesh, of: vec![NONE; count as usize], simplices: Vec::new() };
        let mut waiting = Vec::new();
        for simplex in 0..count {
            if corners.of[simplex as usize] != NONE {
                continue;
            }
            let corner = corners.simplices.len() as u32;
            corners.simplices.push(simplex);
            corners.of[simplex as usize] = corner;
            waiting.push(simplex);
            while let Some(simplex) = waiting.pop() {
                for &neighbor in mesh.neighbors_of(simplex as usize) {
                    let is_new = neighbor != NONE && corners.of[neighbor as usize] == NONE;
                    if is_new && corners.are_cospherical(simplex, neighbor) {
                        corners.of[neighbor as usize] = corner;
                        waiting.push(neighbor);
                    }
                }
            }
        }
        corners
    }

    fn are_cospherical(&self, simplex: u32, neighbor: u32) -> bool {
        let own = self.mesh.simplex(simplex as usize);
        let others = self.mesh.simplex(neighbor as usize);
        let opposite = others.iter().find(|vertex| !own.contains(vertex));
        let points: [&[f64; D]; 9] = self.points(own);
        opposite.is_some_and(|&vertex| in_ball(&points[..=D], self.point(vertex)) == Sign::Zero)
    }

    fn point(&self, vertex: u32) -> &'a [f64; D] {
        self.mesh.point(vertex).try_into().expect("D coordinates")
    }

    /// Returns the points of at most D + 1 vertices; the rest of the array repeats the first.
    fn points(&self, vertices: &[u32]) -> [&'a [f64; D]; 9] {
        std::array::from_fn(|i| self.point(*vertices.get(i).unwrap_or(&vertices[0])))
    }

    /// Returns true if no two of the simplices share a corner.
    fn are_apart(&self, star: &[u32]) -> bool {
        let of = |simplex: &u32| self.of[*simplex as usize];
        (1..star.len()).all(|i| star[..i].iter().all(|other| of(other) != of(&star[i])))
    }

    /// Returns true if the edge between the two vertices, in the simplices of `star`, is one of the
    /// Delaunay complex, whose cells are the unions of the simplices that share a corner, and not a
    /// diagonal of one of its faces. An edge is what all cells round it have in common, and the
    /// facets of the hull.
    fn is_ridge(&self, ends: &[u32], star: &[u32]) -> bool {
        let mut common: Option<Vec<u32>> = None;
        for (at, simplex) in star.iter().enumerate() {
            let corner = self.of[*simplex as usize];
            if star[..at].iter().any(|other| self.of[*other as usize] == corner) {
                continue;
            }
            let of_cell = star.iter().filter(|other| self.of[**other as usize] == corner);
            let vertices = of_cell.flat_map(|other| self.mesh.simplex(*other as usize).to_vec());
            keep_common(&mut common, vertices.collect());
        }
        for face in self.hull_faces(ends, star) {
            keep_common(&mut common, face);
        }
        common.is_some_and(|common| common.len() == 2)
    }

    /// Returns the vertices of the hull's facets at an edge, of those in one hyperplane and of one
    /// cell together.
    fn hull_faces(&self, ends: &[u32], star: &[u32]) -> Vec<Vec<u32>> {
        let mut faces: Vec<(u32, [u32; 8], Vec<u32>)> = Vec::new();
        for &simplex in star {
            let vertices = self.mesh.simplex(simplex as usize);
            let neighbors = self.mesh.neighbors_of(simplex as usize);
            for (opposite, _) in vertices.iter().zip(neighbors).filter(|(_, n)| **n == NONE) {
                if ends.contains(opposite) {
                    continue;
                }
                let mut facet = [NONE; 8];
                let others = vertices.iter().filter(|vertex| *vertex != opposite);
                facet.iter_mut().zip(others).for_each(|(to, from)| *to = *from);
                let corner = self.of[simplex as usize];
                let same = faces.iter_mut().find(|(other, first, _)| {
                    *other == corner && facet[..D].iter().all(|v| self.is_on(&first[..D], *v))
                });
                match same {
                    Some((.., face)) => face.extend_from_slice(&facet[..D]),
                    None => faces.push((corner, facet, facet[..D].to_vec())),
                }
            }
        }
        faces.into_iter().map(|(.., face)| face).collect()
    }

    /// Returns true if a vertex is in the hyperplane of a facet.
    fn is_on(&self, facet: &[u32], vertex: u32) -> bool {
        let mut points = self.points(facet);
        points[D] = self.point(vertex);
        facet.contains(&vertex) || orientation(&points[..=D]) == Sign::Zero
    }

    /// Returns adds the list of the corners of simplices, each once, in their order.
    fn add(&self, star: &[u32], is_bounded: bool, lists: &mut arrays::Lists) {
        let start = lists.ids.len();
        lists.ids.extend((!is_bounded).then_some(NONE));
        for simplex in star {
            let corner = self.of[*simplex as usize];
            if !lists.ids[start..].contains(&corner) {
                lists.ids.push(corner);
            }
        }
        lists.starts.push(lists.ids.len());
    }
}

/// Leaves in `common` what `vertices` have too.
fn keep_common(common: &mut Option<Vec<u32>>, mut vertices: Vec<u32>) {
    match common {
        Some(common) => common.retain(|vertex| vertices.contains(vertex)),
        None => {
            vertices.sort_unstable();
            vertices.dedup();
            *common = Some(vertices);
        }
    }
}
