//! The certificate of a surface through points ([`crate::surface`]): curves in the plane, surfaces
//! in space.
//!
//! Its facets are faces of a triangulation whose levels 1 and 2 hold, so they are Delaunay, and two
//! of them meet in a common face or not at all: the surface has no intersections. That it is
//! a manifold, and watertight and oriented where it is to be, is counted from the facets alone.

use super::report::{Findings, Report, Violation, ViolationKind};
use super::{Case, check, report};
use crate::error::{Error, Result, message};
use crate::memory::{AllocResult, Sets, TryGrow, collected, filled, with_capacity};
use crate::mesh::{Inputs, NONE, Triangulation};
use crate::quality::view::View;

/// A ridge of a facet.
struct Ridge {
    /// Its vertices, ascending; an edge in space, a vertex and [`NONE`] in the plane.
    vertices: [u32; 2],
    /// True if the facet has it the other way round than its vertices ascend.
    is_reversed: bool,
    facet: u32,
}

/// Promises of a surface that are checked beside those that all have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Promises {
    /// Each ridge has two facets; otherwise one or two.
    pub is_closed: bool,
    /// Facets have their ridges in opposite directions.
    pub is_oriented: bool,
}

/// Checks all levels of a triangulation in the plane or in space, and a surface in it:
/// `facets` has `dim` vertices each, and `left_out` the vertices that it does not have.
/// O(simplices log simplices).
///
/// # Errors
/// `InvalidArgument` (another dimension), `OutOfMemory`.
pub fn validate_surface(
    inputs: &Inputs,
    triangulation: &Triangulation,
    facets: &[u32],
    left_out: &[u32],
    promises: Promises,
) -> Result<Report> {
    match triangulation.dim {
        2 => Ok(report(levels::<2>(inputs, triangulation, facets, left_out, promises)?)),
        3 => Ok(report(levels::<3>(inputs, triangulation, facets, left_out, promises)?)),
        dim => {
            let message = message!("the mesh has {dim} dimensions; a surface is in 2D or 3D");
            Err(Error::invalid(message))
        }
    }
}

fn levels<const D: usize>(
    inputs: &Inputs,
    triangulation: &Triangulation,
    facets: &[u32],
    left_out: &[u32],
    promises: Promises,
) -> AllocResult<Vec<Findings>> {
    let case = Case { inputs, outline: None, result: triangulation };
    let view = View::<D> { mesh: triangulation };
    let mut levels = check(case, view, 3)?;
    if levels.len() == 3 && check_ids::<D>(view, facets, &mut levels[0]) {
        check_vertices(view, facets, left_out, &mut levels[0])?;
        check_ridges::<D>(facets, promises, &mut levels[0])?;
        check_faces(view, facets, &mut levels[1])?;
    }
    Ok(levels)
}

/// Checks that the facets name different vertices that exist.
fn check_ids<const D: usize>(view: View<'_, D>, facets: &[u32], findings: &mut Findings) -> bool {
    let count = view.vertex_count();
    findings.check(facets.len() % D == 0, || {
        let message = message!("facets has length {}, no multiple of {D}", facets.len());
        Violation::new(ViolationKind::ArrayLength, message)
    });
    for facet in facets.chunks_exact(D) {
        let exist = facet.iter().all(|&vertex| (vertex as usize) < count);
        findings.check(exist, || {
            let message = message!("the facet {facet:?} names a vertex; there are {count}");
            Violation::new(ViolationKind::VertexOutOfRange, message)
        });
        let differ = (1..D).all(|k| !facet[..k].contains(&facet[k]));
        findings.check(differ, || {
            let message = message!("the facet {facet:?} names a vertex twice");
            Violation::new(ViolationKind::RepeatedVertex, message)
        });
    }
    findings.clean()
}

/// Checks that a vertex is left out if, and only if, no facet has it.
fn check_vertices<const D: usize>(
    view: View<'_, D>,
    facets: &[u32],
    left_out: &[u32],
    findings: &mut Findings,
) -> AllocResult<()> {
    let mut is_used = filled(view.vertex_count(), false)?;
    facets.iter().for_each(|&vertex| is_used[vertex as usize] = true);
    let mut named = left_out.iter().copied().peekable();
    for (vertex, is_used) in is_used.into_iter().enumerate() {
        let is_named = named.next_if_eq(&(vertex as u32)).is_some();
        findings.check(is_named != is_used, || {
            let message = match is_used {
                true => message!("vertex {vertex} is on the surface, and said to be left out"),
                false => message!("vertex {vertex} is not on the surface, and not left out"),
            };
            Violation::new(ViolationKind::SurfaceVertices, message).vertex(vertex)
        });
    }
    findings.check(named.peek().is_none(), || {
        let message = "the vertices that are left out do not ascend, or do not exist";
        Violation::new(ViolationKind::SurfaceVertices, message)
    });
    Ok(())
}

/// Checks that each ridge is of as many facets as is promised, and in opposite directions, and that
/// the facets round each vertex are connected across ridges that have it.
fn check_ridges<const D: usize>(
    facets: &[u32],
    promises: Promises,
    findings: &mut Findings,
) -> AllocResult<()> {
    let ridges = ridges::<D>(facets)?;
    // Corner k of facet f is k + D f.
    let mut corners = Sets::new(facets.len())?;
    for same in ridges.chunk_by(|a, b| a.vertices == b.vertices) {
        let ends = same[0].vertices;
        let is_promised = match same {
            [_] => !promises.is_closed,
            [a, b] => !promises.is_oriented || a.is_reversed != b.is_reversed,
            _ => false,
        };
        findings.check(is_promised, || {
            let place = if D == 2 { message!("{}", ends[0]) } else { message!("{ends:?}") };
            let one = if promises.is_closed { "" } else { "one or " };
            let message = message!(
                "{} facets of the surface meet at {place}; it must be {one}two that go on",
                same.len()
            );
            Violation::new(ViolationKind::SurfaceRidge, message).vertex(ends[0] as usize)
        });
        for pair in same.windows(2) {
            for vertex in ends.into_iter().filter(|&vertex| vertex != NONE) {
                let corner = |facet: u32| {
                    let start = facet as usize * D;
                    let at = facets[start..start + D].iter().position(|&v| v == vertex);
                    start + at.expect("a vertex of the facet")
                };
                corners.join(corner(pair[0].facet), corner(pair[1].facet));
            }
        }
    }
    let vertices = facets.iter().max().map_or(0, |&vertex| vertex as usize + 1);
    let mut fans = filled(vertices, usize::MAX)?;
    for (corner, &vertex) in facets.iter().enumerate() {
        let fan = &mut fans[vertex as usize];
        let set = corners.find(corner);
        if *fan == usize::MAX {
            *fan = set;
        }
        findings.check(*fan == set, || {
            let message = message!("the surface touches itself at vertex {vertex}");
            Violation::new(ViolationKind::SurfaceFan, message).vertex(vertex as usize)
        });
    }
    Ok(())
}

/// Returns the ridges of all facets, sorted.
fn ridges<const D: usize>(facets: &[u32]) -> AllocResult<Vec<Ridge>> {
    let mut ridges = with_capacity(facets.len())?;
    for (facet, vertices) in (0..).zip(facets.chunks_exact(D)) {
        for k in 0..D {
            let ridge = match D {
                2 => Ridge { vertices: [vertices[k], NONE], is_reversed: k == 0, facet },
                _ => {
                    let (a, b) = (vertices[k], vertices[(k + 1) % D]);
                    Ridge { vertices: [a.min(b), a.max(b)], is_reversed: b < a, facet }
                }
            };
            ridges.try_push(ridge)?;
        }
    }
    ridges.sort_unstable_by_key(|ridge| (ridge.vertices, ridge.facet));
    Ok(ridges)
}

/// Checks that each facet is a face of the triangulation, and none is there twice.
fn check_faces<const D: usize>(
    view: View<'_, D>,
    facets: &[u32],
    findings: &mut Findings,
) -> AllocResult<()> {
    let stars = view.stars()?;
    let mut keys = with_capacity(facets.len() / D)?;
    for facet in facets.chunks_exact(D) {
        let has = |&simplex: &u32| {
            let vertices = view.simplex(simplex as usize);
            facet.iter().all(|vertex| vertices.contains(vertex))
        };
        findings.check(stars.of(facet[0] as usize).iter().any(has), || {
            let message = message!("the facet {facet:?} of the surface is no face of the mesh");
            Violation::new(ViolationKind::SurfaceFace, message).vertex(facet[0] as usize)
        });
        let mut key: [u32; D] = std::array::from_fn(|k| facet[k]);
        key.sort_unstable();
        keys.try_push(key)?;
    }
    keys.sort_unstable();
    for pair in collected(keys.windows(2))? {
        findings.check(pair[0] != pair[1], || {
            let message = message!("the facet {:?} is there twice", pair[0]);
            Violation::new(ViolationKind::SurfaceFace, message).vertex(pair[0][0] as usize)
        });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use crate::options::{Algorithm, Options};
    use crate::surface::Surface;

    /// Makes a cube with a point above it that is not on the surface, and the surface of the cube.
    fn cube() -> (Mesh, Surface) {
        let corners = (0..8).flat_map(|i| [i & 1, i >> 1 & 1, i >> 2].map(f64::from));
        let points: Vec<f64> = corners.chain([0.5, 0.5, 9.0]).collect();
        let mut mesh = Mesh::new(3, 9, &points, 3).unwrap();
        let options = Options { algorithm: Algorithm::Delaunay, ..Options::default() };
        mesh.run(&options, None).unwrap();
        let triangulation = mesh.result().unwrap();
        let is_cube = |s: usize| triangulation.simplex(s).iter().all(|&vertex| vertex < 8);
        let is_inside = (0..triangulation.simplex_count()).map(is_cube).collect();
        let surface = Surface::of_solid(triangulation, is_inside).unwrap();
        (mesh, surface)
    }

    fn first(mesh: &Mesh, facets: &[u32], left_out: &[u32]) -> Option<ViolationKind> {
        let promises = Promises { is_closed: true, is_oriented: true };
        first_of(mesh, facets, left_out, promises)
    }

    fn first_of(
        mesh: &Mesh,
        facets: &[u32],
        left_out: &[u32],
        promises: Promises,
    ) -> Option<ViolationKind> {
        let triangulation = mesh.result().unwrap();
        let report =
            validate_surface(mesh.inputs(), triangulation, facets, left_out, promises).unwrap();
        assert_eq!(report.violations == 0, report.first.is_none());
        report.first.map(|first| first.kind)
    }

    #[test]
    fn every_rule_is_checked() {
        let (mesh, surface) = cube();
        let facets = surface.facets;
        assert_eq!(facets.len(), 12 * 3);
        assert_eq!(first(&mesh, &facets, &[8]), None);
        assert_eq!(first(&mesh, &facets, &[]), Some(ViolationKind::SurfaceVertices));
        assert_eq!(first(&mesh, &facets, &[7, 8]), Some(ViolationKind::SurfaceVertices));
        assert_eq!(first(&mesh, &facets, &[8, 8]), Some(ViolationKind::SurfaceVertices));
        let with = |change: &dyn Fn(&mut Vec<u32>)| {
            let mut facets = facets.clone();
            change(&mut facets);
            first(&mesh, &facets, &[8])
        };
        assert_eq!(with(&|f| f.truncate(33)), Some(ViolationKind::SurfaceRidge));
        assert_eq!(with(&|f| f.truncate(35)), Some(ViolationKind::ArrayLength));
        assert_eq!(with(&|f| f.swap(0, 1)), Some(ViolationKind::SurfaceRidge));
        assert_eq!(with(&|f| f[0] = 9), Some(ViolationKind::VertexOutOfRange));
        assert_eq!(with(&|f| f[0] = f[1]), Some(ViolationKind::RepeatedVertex));
        let again = with(&|f| {
            let more = f[..3].to_vec();
            f.extend([more[0], more[1], more[2], more[1], more[0], more[2]]);
        });
        assert_eq!(again, Some(ViolationKind::SurfaceRidge));
    }

    #[test]
    fn open_surfaces_may_end_and_have_one_side() {
        let (mesh, surface) = cube();
        let open = Promises { is_closed: false, is_oriented: true };
        let one_sided = Promises { is_oriented: false, ..open };
        let mut facets = surface.facets;
        facets.truncate(33);
        assert_eq!(first_of(&mesh, &facets, &[8], open), None);
        facets.swap(0, 1);
        let turned = first_of(&mesh, &facets, &[8], open);
        assert_eq!(turned, Some(ViolationKind::SurfaceRidge));
        assert_eq!(first_of(&mesh, &facets, &[8], one_sided), None);
        // A third facet at a ridge: the diagonal of a side from both sides of the cube.
        let more = [facets[0], facets[1], 8];
        facets.extend(more);
        let third = first_of(&mesh, &facets, &[], one_sided);
        assert_eq!(third, Some(ViolationKind::SurfaceRidge));
    }

    #[test]
    fn surfaces_of_other_faces_are_refused() {
        // A closed surface through the corners of the cube that crosses it.
        let (mesh, _) = cube();
        let facets = [0, 7, 1, 0, 1, 6, 0, 6, 7, 1, 7, 6];
        let left_out = [2, 3, 4, 5, 8];
        assert_eq!(first(&mesh, &facets, &left_out), Some(ViolationKind::SurfaceFace));
    }

    #[test]
    fn surfaces_that_touch_themselves_are_refused() {
        // Two tetrahedra at a common vertex.
        let (mesh, _) = cube();
        let facets = [0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2, 0, 4, 5, 0, 6, 4, 0, 5, 6, 4, 6, 5];
        assert_eq!(first(&mesh, &facets, &[7, 8]), Some(ViolationKind::SurfaceFan));
    }
}
