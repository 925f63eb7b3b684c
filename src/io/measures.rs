//! Quality per simplex and per vertex, for the formats that viewers colour.

use crate::memory::{AllocResult, TryGrow, collected, filled, with_capacity};
use crate::mesh::{NONE, Triangulation};
use crate::quality::cells::{Cells, pieces};
use crate::quality::view::View;

pub(super) struct Measures {
    /// Simplex -> circumradius over shortest edge; infinite where no double is large enough.
    pub radius_edge: Vec<f64>,
    /// Vertex -> aspect of its Voronoi cell over all corners; NaN on the hull and for the vertices
    /// of a cage. Cells of a cage span the empty region around it, so their aspects would take up
    /// the whole range of a colour map.
    pub aspect: Vec<f64>,
}

impl Measures {
    /// Measures a mesh of dimension `D`.
    pub fn new<const D: usize>(mesh: &Triangulation) -> AllocResult<Self> {
        let view = View::<D> { mesh };
        let mut radius_edge = filled(mesh.simplex_count(), 0.0)?;
        let mut left = &mut *radius_edge;
        let shares = pieces(mesh.simplex_count()).map(|piece| {
            let (first, others) = std::mem::take(&mut left).split_at_mut(piece.len());
            left = others;
            (piece.start, first)
        });
        let cells = Cells::survey(view, None, 1.0, &mut collected(shares)?, |share, cell| {
            share.1[cell.simplex - share.0] = cell.radius_edge;
            Ok(())
        })?;
        let on_hull = view.hull_vertices()?;
        let mut aspect = with_capacity(mesh.vertex_count())?;
        for (vertex, &on_hull) in on_hull.iter().enumerate() {
            let is_measured = !on_hull && mesh.cage_of[vertex] == NONE;
            let value = if is_measured { cells.aspect_anywhere(vertex) } else { f64::NAN };
            aspect.try_push(value)?;
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
            let on_hull = hull_vertices(triangulation);
            let off_hull =
                |vertices: &[u32]| vertices.iter().all(|&vertex| !on_hull[vertex as usize]);
            let simplices = triangulation.simplices.chunks_exact(triangulation.dim + 1);
            let inside = simplices.zip(&measures.radius_edge).filter(|(v, _)| off_hull(v));
            let worst = inside.map(|(_, ratio)| *ratio).fold(0.0, f64::max);
            assert_eq!(worst, quality.worst_radius_edge);
            // The mesh has one domain and nothing is precision-limited: all other cells count.
            let cells = measures.aspect.iter().filter(|aspect| !aspect.is_nan());
            let worst = cells.fold(0.0, |worst: f64, aspect| worst.max(*aspect));
            assert!(worst > 1.0 && quality.worst_aspect_anywhere == worst, "{worst}");
        }
    }

    fn hull_vertices(mesh: &Triangulation) -> Vec<bool> {
        match mesh.dim {
            2 => View::<2> { mesh }.hull_vertices().unwrap(),
            _ => View::<3> { mesh }.hull_vertices().unwrap(),
        }
    }

    #[test]
    fn cages_and_the_hull_have_no_aspect() {
        let mesh = samples::nested(3);
        let triangulation = mesh.triangulation().unwrap();
        let measures = Measures::new::<3>(triangulation).unwrap();
        let on_hull = hull_vertices(triangulation);
        let mut inner_cages = 0;
        for (vertex, aspect) in measures.aspect.iter().enumerate() {
            let of_cage = triangulation.cage_of[vertex] != NONE;
            assert_eq!(aspect.is_nan(), of_cage || on_hull[vertex], "{vertex}");
            inner_cages += usize::from(of_cage && !on_hull[vertex]);
        }
        assert!(inner_cages > 0);
    }
}
