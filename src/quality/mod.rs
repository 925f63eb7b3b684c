//! Measures of a mesh, from coordinates and simplices alone: Voronoi aspect, radius-edge ratio,
//! angles, degrees. The aspect of a vertex v is R_v / r_v: r_v is half the distance to the nearest
//! neighbour, and R_v the distance to the farthest Voronoi corner.

pub(crate) mod angles;
pub(crate) mod cells;
pub(crate) mod corner;
mod degrees;
pub(crate) mod exact;
mod histogram;
pub(crate) mod length;
pub(crate) mod rational;
pub(crate) mod simplex;
mod simplices;
pub(crate) mod slivers;
pub(crate) mod tree;
pub(crate) mod view;

use crate::error::Result;
use crate::memory::{AllocResult, collected, filled, with_capacity};
use crate::mesh::{NONE, Triangulation, in_dimension};
use cells::{Cells, pieces};
use degrees::max_degree;
use simplices::{Measured, SimplexMeasures};
use tree::DomainTree;
use view::View;

pub use histogram::{Histogram, Measure, histogram};

/// The quality of a mesh.
///
/// The aspect of a Voronoi cell is its out-radius (distance to the farthest corner) over its
/// in-radius (half the distance to the nearest vertex); it is at least 1. The cells of a
/// hierarchical mesh are those of Definition 4: of the vertices that are in no living cage, and the
/// union cells of the cages. While the mesh grows, corners count in a domain of radius r only
/// within `min(0.85, 1 - delta^2 / 2) * cage_scale * r` of its centre; `worst_aspect` and its like
/// say what that leaves, the figures "anywhere" are over all corners. Without domains (plain
/// Delaunay) every corner counts. A figure over no cells at all is 0. Infinity stands for ratios
/// beyond the doubles and for flat simplices.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Quality {
    /// Largest number of Delaunay neighbours of a vertex.
    pub max_degree: u32,
    /// Worst Voronoi aspect of the vertices that are neither in a living cage, on the hull, nor
    /// precision-limited, over the corners that count in the vertex's domain.
    pub worst_aspect: f64,
    /// Worst aspect of all cells off the hull, vertices' and cages', precision-limited ones too,
    /// over all corners. What tau bounds, but for precision-limited cells.
    pub worst_aspect_anywhere: f64,
    /// Mean of the aspects of which `worst_aspect` is the largest.
    pub mean_aspect: f64,
    /// Worst aspect of the union cell of a cage (§4) other than the root's, over the corners that
    /// count in the parent: largest distance of a corner to the centre, over half the sum of the
    /// domain's radius and the distance from its centre to the nearest vertex outside the ball.
    /// Cages with a precision-limited vertex or centre are left out.
    pub worst_cage_aspect: f64,
    /// Largest circumradius / shortest edge of the simplices off the hull: those without a vertex
    /// on the hull, which is the root's cage. Their corners are not restricted. Of a domain that is
    /// cropped, those at its boundary count too. Forced simplices and flat ones never do.
    pub worst_radius_edge: f64,
    /// Smallest angle (2D) or dihedral angle (3D and up) of the same simplices, in degrees; 0 below
    /// about 1e-14, where the directions of two facets are no longer told apart.
    pub min_angle_degrees: f64,
    /// Number of vertices marked as precision-limited.
    pub precision_limited: u64,
    /// Number of simplices with a dihedral angle below the one that was asked for and all vertices
    /// in one domain.
    pub below_min_dihedral: u64,
    /// Number of simplices with a dihedral angle below the one that was asked for and vertices in
    /// several domains.
    pub below_min_dihedral_between_domains: u64,
    /// Number of cells or simplices marked as beyond the bound, which gave way to the angle.
    pub beyond_bound: u64,
    /// Number of simplices that a small angle between segments or facets forces: the figures above
    /// leave them out.
    pub forced: u64,
    /// Smallest angle of these, in degrees.
    pub least_forced_angle_degrees: f64,
    /// Number of triangles with an angle below [`crate::Parameters::min_angle`] that nothing
    /// forces, wherever they are. Cages break the angle: between a cage and what is around it are
    /// triangles with vertices of several domains.
    pub below_min_angle: u64,
    /// Number of simplices with all vertices on one facet, which only roundings keep from being
    /// flat: the figures of simplices leave them out.
    pub flat: u64,
}

/// The builder compares rounded radii; so do measures and the certificate, with other roundings.
pub(crate) const SLACK: f64 = 1e-7;

/// The quality of a mesh, and the measures of simplices and vertices that it tells the worst of.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measures {
    pub quality: Quality,
    /// Simplex -> circumradius over shortest edge; infinite where no double is large enough.
    pub radius_edge: Vec<f64>,
    /// Vertex -> aspect of its Voronoi cell over all corners; NaN on the hull and for the vertices
    /// of a cage. Cells of a cage span the empty region around it, so their aspects would take up
    /// the whole range of a colour map.
    pub aspect: Vec<f64>,
}

impl Measures {
    /// Measures `triangulation` as [`measure`] does, at the same cost; all is empty and zero for a
    /// triangulation whose arrays do not fit together.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn of(triangulation: &Triangulation) -> Result<Self> {
        measured(triangulation, true)
    }
}

/// Measures `triangulation`. A triangulation whose arrays do not fit together, or whose ids are
/// out of range, answers all zeros: [`crate::validate::validate`] says what is wrong with it.
///
/// O(simplices) for a fixed dimension, on the threads that the run was allowed.
///
/// # Errors
/// `OutOfMemory`.
pub fn measure(triangulation: &Triangulation) -> Result<Quality> {
    Ok(measured(triangulation, false)?.quality)
}

/// Measures a mesh; with arrays of measures if they are wanted.
fn measured(triangulation: &Triangulation, with_arrays: bool) -> Result<Measures> {
    if !is_consistent(triangulation) {
        return Ok(Measures::default());
    }
    let measures = in_dimension!(
        triangulation.dim,
        D => measure_in::<D>(triangulation, with_arrays),
        _ => Ok(Measures::default())
    );
    Ok(measures?)
}

/// Measures of a piece of the simplices.
struct Piece<'a> {
    figures: SimplexMeasures,
    /// The first of its simplices.
    first: usize,
    /// Place for the ratios of its simplices; empty if nobody wants them.
    radius_edge: &'a mut [f64],
}

fn measure_in<const D: usize>(mesh: &Triangulation, with_arrays: bool) -> AllocResult<Measures> {
    let view = View::<D> { mesh };
    let hull_facets = view.hull_facets()?;
    let on_hull = collected(hull_facets.iter().map(|&facets| facets > 0))?;
    let tree = DomainTree::new(&mesh.domains)?;
    let mut radius_edge = filled(if with_arrays { mesh.simplex_count() } else { 0 }, 0.0)?;
    let mut left = &mut *radius_edge;
    let parts = pieces(view.simplex_count()).map(|piece| {
        let own = if with_arrays { piece.len() } else { 0 };
        let (radius_edge, others) = std::mem::take(&mut left).split_at_mut(own);
        left = others;
        Piece { figures: SimplexMeasures::default(), first: piece.start, radius_edge }
    });
    let mut parts = collected(parts)?;
    let measured = Measured::new(view, &on_hull)?;
    let cells = Cells::survey(view, tree.as_ref(), 1.0, &mut parts, |piece, cell| {
        if let Some(place) = piece.radius_edge.get_mut(cell.simplex - piece.first) {
            *place = cell.radius_edge;
        }
        piece.figures.add(&measured, cell)
    })?;
    let mut simplices = SimplexMeasures::default();
    parts.iter().for_each(|part| simplices.merge(&part.figures));
    let limited = (0..mesh.precision_limited.len())
        .filter(|&v| mesh.precision_limited[v] && cells.has_cell(v))
        .count();
    let mut quality = Quality {
        max_degree: max_degree(view, &cells, &hull_facets)?,
        worst_cage_aspect: worst_cage_aspect(mesh, &cells)?,
        worst_radius_edge: simplices.radius_edge,
        min_angle_degrees: simplices.angle.degrees(),
        precision_limited: limited as u64,
        beyond_bound: mesh.beyond_bound.len() as u64,
        forced: simplices.forced,
        least_forced_angle_degrees: simplices.forced_angle.degrees(),
        below_min_angle: simplices.below_min_angle,
        below_min_dihedral: simplices.below_min_dihedral[1],
        below_min_dihedral_between_domains: simplices.below_min_dihedral[0],
        flat: simplices.flat,
        ..Quality::default()
    };
    let mut aspect = with_capacity(if with_arrays { mesh.vertex_count() } else { 0 })?;
    add_aspects(&mut quality, mesh, &cells, &on_hull, |anywhere| {
        if with_arrays {
            aspect.push(anywhere);
        }
    });
    Ok(Measures { quality, radius_edge, aspect })
}

/// Adds the aspects of cells to the quality, and calls `visit` with that of each vertex over all
/// corners; NaN for what has none, or none that tells anything.
fn add_aspects(
    quality: &mut Quality,
    mesh: &Triangulation,
    cells: &Cells,
    on_hull: &[bool],
    mut visit: impl FnMut(f64),
) {
    let (mut sum, mut count) = (0.0, 0u64);
    for (i, domain) in mesh.domains.iter().enumerate().skip(1) {
        let anywhere = cells.cage_aspect_anywhere(i, domain.radius);
        quality.worst_aspect_anywhere = quality.worst_aspect_anywhere.max(anywhere);
    }
    for (v, &on_hull) in on_hull.iter().enumerate() {
        if on_hull || mesh.cage_of[v] != NONE {
            visit(f64::NAN);
            continue;
        }
        let anywhere = cells.aspect_anywhere(v);
        visit(anywhere);
        if !cells.has_cell(v) {
            continue;
        }
        quality.worst_aspect_anywhere = quality.worst_aspect_anywhere.max(anywhere);
        if !mesh.precision_limited[v] {
            let aspect = cells.aspect(v);
            quality.worst_aspect = quality.worst_aspect.max(aspect);
            sum += aspect;
            count += 1;
        }
    }
    if count > 0 {
        quality.mean_aspect = sum / count as f64;
    }
}

fn worst_cage_aspect(mesh: &Triangulation, cells: &Cells) -> AllocResult<f64> {
    let limited = precision_limited_cages(mesh)?;
    let cages = mesh.domains.iter().enumerate().skip(1).filter(|&(i, _)| !limited[i]);
    let aspects = cages.map(|(i, domain)| cells.cage_aspect(i, domain.radius));
    Ok(aspects.fold(0.0, f64::max))
}

/// Returns for each domain whether its centre or a vertex of its cage is precision-limited, which
/// exempts the cage from its bounds. Ids must be in range.
pub(crate) fn precision_limited_cages(mesh: &Triangulation) -> AllocResult<Vec<bool>> {
    let centers = mesh.domains.iter().map(|domain| mesh.precision_limited[domain.center as usize]);
    let mut limited = collected(centers)?;
    for (&cage, _) in mesh.cage_of.iter().zip(&mesh.precision_limited).filter(|(_, l)| **l) {
        if cage != NONE {
            limited[cage as usize] = true;
        }
    }
    Ok(limited)
}

/// Returns true if array lengths fit and ids are in range, so that reading cannot go astray.
fn is_consistent(mesh: &Triangulation) -> bool {
    let vertices = mesh.kinds.len();
    let size = mesh.dim + 1;
    let below = |ids: &[u32], end: usize| are_below(ids, end, 0);
    // The number after that of nothing is 0.
    let below_or_none = |ids: &[u32], end: usize| are_below(ids, end + 1, 1);
    let per_vertex = [mesh.vertex_domains.len(), mesh.cage_of.len(), mesh.precision_limited.len()];
    let labelled = mesh.domains.is_empty() || below(&mesh.vertex_domains, mesh.domains.len());
    mesh.points.len() == vertices * mesh.dim
        && per_vertex == [vertices; 3]
        && mesh.simplices.len() % size == 0
        && mesh.neighbors.len() == mesh.simplices.len()
        && below(&mesh.simplices, vertices)
        && below_or_none(&mesh.neighbors, mesh.simplices.len() / size)
        && labelled
        && below_or_none(&mesh.cage_of, mesh.domains.len())
        && mesh.domains.iter().all(|domain| (domain.center as usize) < vertices)
}

/// Returns true if all ids are below `end` when `added` is added to them (32 bits, round to 0).
/// Asks for the largest of many at a time, since a comparison of each takes several times as long.
fn are_below(ids: &[u32], end: usize, added: u32) -> bool {
    let largest = |ids: &[u32]| ids.iter().fold(0, |most, id| id.wrapping_add(added).max(most));
    ids.chunks(4096).all(|ids| (largest(ids) as usize) < end)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Mesh;
    use crate::io::samples;
    use crate::numerics::SplitMix;
    use crate::options::Options;

    pub fn meshed(dim: usize, count: usize, options: &Options) -> Triangulation {
        let mut random = SplitMix(dim as u64);
        let points: Vec<f64> = (0..dim * count).map(|_| random.unit()).collect();
        let mut mesh = Mesh::new(dim, count, &points, 0).unwrap();
        mesh.run(options, None).unwrap();
        mesh.triangulation().unwrap().clone()
    }

    #[test]
    fn a_mesh_has_the_same_quality_on_any_number_of_threads() {
        let options = Options { min_dihedral: 5.0, ..Options::default() };
        let mut mesh = meshed(3, 3000, &options);
        assert!(pieces(mesh.simplex_count()).len() > 2);
        let mut on_threads = |threads| {
            mesh.parameters.threads = threads;
            // Aspects may be NaN, which is not the same as itself.
            let Measures { quality, radius_edge, aspect } = Measures::of(&mesh).unwrap();
            (quality, radius_edge, aspect.iter().map(|aspect| aspect.to_bits()).collect())
        };
        let one: (Quality, Vec<f64>, Vec<u64>) = on_threads(1);
        assert!(one.0.worst_cage_aspect >= 0.0 && one.0.min_angle_degrees > 0.0);
        for threads in [2, 3, 8, 0] {
            assert_eq!(on_threads(threads), one);
        }
        assert_eq!(measure(&mesh).unwrap(), one.0);
        let view = View::<3> { mesh: &mesh };
        for (simplex, ratio) in one.1.iter().enumerate() {
            let points = view.points_of(view.simplex(simplex));
            let corner = corner::Corner::new(&points[..4]).unwrap().unwrap();
            assert_eq!(*ratio, corner.radius.ratio(corner.shortest_edge), "{simplex}");
        }
    }

    #[test]
    fn arrays_hold_what_the_quality_is_the_worst_of() {
        for mesh in [samples::finished(2), samples::finished(3)] {
            let triangulation = mesh.triangulation().unwrap();
            let Measures { quality, radius_edge, aspect } = Measures::of(triangulation).unwrap();
            assert_eq!(quality, measure(triangulation).unwrap());
            assert_eq!(radius_edge.len(), triangulation.simplex_count());
            assert_eq!(aspect.len(), triangulation.vertex_count());
            let on_hull = hull_vertices(triangulation);
            let off_hull =
                |vertices: &[u32]| vertices.iter().all(|&vertex| !on_hull[vertex as usize]);
            let simplices = triangulation.simplices.chunks_exact(triangulation.dim + 1);
            let inside = simplices.zip(&radius_edge).filter(|(v, _)| off_hull(v));
            let worst = inside.map(|(_, ratio)| *ratio).fold(0.0, f64::max);
            assert_eq!(worst, quality.worst_radius_edge);
            // The mesh has one domain and nothing is precision-limited: all other cells count.
            let cells = aspect.iter().filter(|aspect| !aspect.is_nan());
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
        let measures = Measures::of(triangulation).unwrap();
        let on_hull = hull_vertices(triangulation);
        let mut inner_cages = 0;
        for (vertex, aspect) in measures.aspect.iter().enumerate() {
            let of_cage = triangulation.cage_of[vertex] != NONE;
            assert_eq!(aspect.is_nan(), of_cage || on_hull[vertex], "{vertex}");
            inner_cages += usize::from(of_cage && !on_hull[vertex]);
        }
        assert!(inner_cages > 0);
    }

    #[test]
    fn ids_are_below_an_end_or_nothing() {
        for place in [0, 4095, 4096, 9999] {
            let mut ids = vec![3; 10_000];
            assert!(are_below(&ids, 4, 0) && !are_below(&ids, 3, 0));
            ids[place] = NONE;
            assert!(!are_below(&ids, 4, 0) && are_below(&ids, 5, 1));
            ids[place] = 4;
            assert!(!are_below(&ids, 4, 0) && !are_below(&ids, 5, 1));
        }
        assert!(are_below(&[], 0, 0) && are_below(&[NONE], 1, 1) && !are_below(&[0], 1, 1));
    }
}
