//! The largest degree: how many neighbours a vertex has at most.

use super::cells::Cells;
use super::view::View;
use crate::memory::{AllocResult, collected, filled};
use crate::mesh::NONE;

/// Returns the largest number of distinct vertices that share a simplex with one vertex, given for
/// each vertex the number of facets of the hull at it. O(simplices).
///
/// Triangles and tetrahedra round a vertex off the hull tell by their number how many neighbours it
/// has, as the faces of a closed curve or sphere do. At others neighbours are counted, unless they
/// must be fewer.
pub(super) fn max_degree<const D: usize>(
    view: View<'_, D>,
    cells: &Cells,
    hull_facets: &[u32],
) -> AllocResult<u32> {
    let told = |v: usize| degree_inside::<D>(cells.simplices_at(v), hull_facets[v]);
    let inside = (0..view.vertex_count()).filter_map(told).max().unwrap_or(0);
    let most = |v: usize| most_neighbors::<D>(cells.simplices_at(v), hull_facets[v] as usize);
    let may_have_more = |v: usize| told(v).is_none() && most(v) > inside;
    let counted = collected((0..view.vertex_count()).map(may_have_more))?;
    let inside = inside as u32;
    match counted.contains(&true) {
        true => Ok(inside.max(max_counted_degree(view, &counted)?)),
        false => Ok(inside),
    }
}

/// Returns the number of neighbours of a vertex off the hull; `None` where it must be counted.
fn degree_inside<const D: usize>(simplices: usize, hull_facets: u32) -> Option<usize> {
    match D {
        _ if hull_facets > 0 => None,
        2 => Some(simplices),
        // Triangles of a sphere are even in number, twice its vertices less four.
        3 if simplices > 0 && simplices % 2 == 0 => Some(simplices / 2 + 2),
        _ => None,
    }
}

/// Returns a bound on the neighbours of a vertex.
///
/// At the hull of a plane mesh the edges opposite to the vertex are chains, each with one vertex
/// more than it has edges and with two ends. In space the triangles opposite to it are surfaces
/// with f triangles, b edges at their ends and so (3 f + b) / 2 in all: by Euler, they have no more
/// vertices than (f + b) / 2 and one for each surface, which has three of the b edges or more.
fn most_neighbors<const D: usize>(simplices: usize, hull_facets: usize) -> usize {
    match D {
        2 if hull_facets > 0 => simplices + hull_facets / 2,
        3 if hull_facets > 0 => (simplices + hull_facets) / 2 + hull_facets / 3,
        _ => simplices * D,
    }
}

/// Returns the largest degree of the vertices that are `counted`, by their stars.
fn max_counted_degree<const D: usize>(view: View<'_, D>, counted: &[bool]) -> AllocResult<u32> {
    let stars = view.stars_of(|v| counted[v as usize])?;
    let mut seen_from = filled(view.vertex_count(), NONE)?;
    let mut largest = 0;
    for v in (0..view.vertex_count()).filter(|&v| counted[v]) {
        // So that it does not count itself.
        seen_from[v] = v as u32;
        let mut degree = 0;
        for &s in stars.of(v) {
            for &w in view.simplex(s as usize) {
                degree += u32::from(seen_from[w as usize] != v as u32);
                seen_from[w as usize] = v as u32;
            }
        }
        largest = largest.max(degree);
    }
    Ok(largest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Triangulation;
    use crate::options::{Algorithm, Options, Output};
    use crate::quality::tests::meshed;

    #[test]
    fn degrees_told_by_numbers_of_simplices_are_those_that_are_counted() {
        let finished = Options { output: Output::WellSpaced, ..Options::default() };
        let plain = Options { algorithm: Algorithm::Delaunay, ..Options::default() };
        for options in [Options::default(), finished, plain] {
            degrees_are_counted::<2>(&meshed(2, 300, &options));
            degrees_are_counted::<3>(&meshed(3, 300, &options));
            degrees_are_counted::<4>(&meshed(4, 40, &options));
        }
    }

    /// Holds it for a cropped domain, at whose boundary parts of a star may touch in a vertex
    /// alone: two triangles in the plane, two tetrahedra in space.
    #[test]
    fn degrees_where_parts_of_a_star_touch_are_counted() {
        let mut mesh = meshed(2, 5, &Options::default());
        let (from, to) = (mesh.simplices[..3].to_vec(), mesh.vertex_count() as u32);
        assert!(to > 6);
        mesh.simplices = vec![from[0], from[1], from[2]];
        let others: Vec<u32> = (0..to).filter(|v| !from.contains(v)).take(2).collect();
        mesh.simplices.extend([from[0], others[0], others[1]]);
        mesh.neighbors = vec![NONE; 6];
        degrees_are_counted::<2>(&mesh);
        let mut mesh = meshed(3, 5, &Options::default());
        mesh.simplices = vec![0, 1, 2, 3, 0, 4, 5, 6];
        mesh.neighbors = vec![NONE; 8];
        degrees_are_counted::<3>(&mesh);
    }

    fn degrees_are_counted<const D: usize>(mesh: &Triangulation) {
        let view = View::<D> { mesh };
        let (cells, facets) = (Cells::of(view, None).unwrap(), view.hull_facets().unwrap());
        let all = vec![true; mesh.vertex_count()];
        let counted = max_counted_degree(view, &all).unwrap();
        assert_eq!(max_degree(view, &cells, &facets).unwrap(), counted);
        for v in 0..mesh.vertex_count() {
            let mut one = vec![false; mesh.vertex_count()];
            one[v] = true;
            let degree = max_counted_degree(view, &one).unwrap();
            let (simplices, facets) = (cells.simplices_at(v), facets[v]);
            if let Some(told) = degree_inside::<D>(simplices, facets) {
                assert_eq!(told, degree as usize, "{v}");
            }
            let most = most_neighbors::<D>(simplices, facets as usize);
            assert!(degree as usize <= most, "{v}: {degree} of {most}");
        }
    }
}
