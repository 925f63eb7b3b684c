//! Quality per simplex and per vertex, for the formats that viewers colour.

use crate::memory::{AllocResult, TryGrow, with_room};
use crate::mesh::Triangulation;
use crate::quality::cells::Cells;
use crate::quality::view::View;

pub(super) struct Measures {
    /// Simplex -> circumradius over shortest edge; infinite where no double is large enough.
    pub radius_edge: Vec<f64>,
    /// Vertex -> aspect of its Voronoi cell over all corners; NaN on the hull.
    pub aspect: Vec<f64>,
}

impl Measures {
    /// Of a mesh in dimension `D`.
    pub fn new<const D: usize>(mesh: &Triangulation) -> AllocResult<Self> {
        let view = View::<D> { mesh };
        let mut radius_edge = with_room(mesh.simplex_count())?;
        let cells =
            Cells::survey(view, None, 1.0, |simplex| radius_edge.push(simplex.radius_edge))?;
        let on_hull = view.hull_vertices()?;
        let mut aspect = with_room(mesh.vertex_count())?;
        for (vertex, &on_hull) in on_hull.iter().enumerate() {
            aspect.try_push(if on_hull { f64::NAN } else { cells.aspect_anywhere(vertex) })?;
        }
        Ok(Self { radius_edge, aspect })
    }
}

#[cfg(test)]
mod tests {
    use super::super::samples;
    use super::*;
    use crate::quality;

    #[test]
    fn the_worst_are_those_of_the_quality() {
        for (mesh, measures) in [
            (
                samples::finished(2),
                Measures::new::<2> as fn(&Triangulation) -> AllocResult<Measures>,
            ),
            (samples::finished(3), Measures::new::<3>),
        ] {
            let triangulation = mesh.triangulation().unwrap();
            let measures = measures(triangulation).unwrap();
            let quality = quality::measure(triangulation).unwrap();
            assert_eq!(measures.radius_edge.len(), triangulation.simplex_count());
            assert_eq!(measures.aspect.len(), triangulation.vertex_count());
            let off_hull = |vertices: &[u32]| {
                vertices.iter().all(|&vertex| !measures.aspect[vertex as usize].is_nan())
            };
            let simplices = triangulation.simplices.chunks_exact(triangulation.dim + 1);
            let inside = simplices.zip(&measures.radius_edge).filter(|(v, _)| off_hull(v));
            let worst = inside.map(|(_, ratio)| *ratio).fold(0.0, f64::max);
            assert_eq!(worst, quality.worst_radius_edge);
            // The mesh has one domain and nothing is precision-limited: all other cells count.
            let cells = measures.aspect.iter().zip(&triangulation.cage_of);
            let cells = cells.filter(|(aspect, cage)| !aspect.is_nan() && **cage == crate::NONE);
            let worst = cells.map(|(aspect, _)| *aspect).fold(0.0, f64::max);
            assert!(worst > 1.0 && quality.worst_aspect_anywhere == worst, "{worst}");
        }
    }
}
