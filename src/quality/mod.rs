//! Measures of a mesh, from coordinates and simplices alone: Voronoi aspect, radius-edge ratio,
//! angles, degrees. The aspect of a vertex v is R_v / r_v: r_v is half the distance to the nearest
//! neighbour, and R_v the distance to the farthest Voronoi corner.

pub(crate) mod angles;
pub(crate) mod cells;
pub(crate) mod corner;
pub(crate) mod exact;
mod histogram;
pub(crate) mod length;
pub(crate) mod rational;
pub(crate) mod simplex;
pub(crate) mod slivers;
pub(crate) mod tree;
pub(crate) mod view;

use crate::error::Result;
use crate::memory::{AllocResult, collected, copied, filled};
use crate::mesh::{NONE, Triangulation, in_dimension};
use crate::options::Extent;
use cells::{Cells, SimplexCell, pieces};
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

/// Measures `triangulation`. A triangulation whose arrays do not fit together, or whose ids are
/// out of range, answers all zeros: [`crate::validate::validate`] says what is wrong with it.
///
/// O(simplices) for a fixed dimension, on the threads that the run was allowed.
///
/// # Errors
/// `OutOfMemory`.
pub fn measure(triangulation: &Triangulation) -> Result<Quality> {
    if !is_consistent(triangulation) {
        return Ok(Quality::default());
    }
    let quality = in_dimension!(
        triangulation.dim,
        D => measure_in::<D>(triangulation),
        _ => Ok(Quality::default())
    );
    Ok(quality?)
}

fn measure_in<const D: usize>(mesh: &Triangulation) -> AllocResult<Quality> {
    let view = View::<D> { mesh };
    let on_hull = view.hull_vertices()?;
    let at_cage = vertices_at_cage::<D>(mesh, &on_hull)?;
    let tree = DomainTree::new(&mesh.domains)?;
    let mut parts = filled(pieces(view.simplex_count()).len(), SimplexMeasures::default())?;
    let cells = Cells::survey(view, tree.as_ref(), 1.0, &mut parts, |measures, cell| {
        measures.add(view, cell, &at_cage)
    })?;
    let mut simplices = SimplexMeasures::default();
    parts.iter().for_each(|part| simplices.merge(part));
    let limited = (0..mesh.precision_limited.len())
        .filter(|&v| mesh.precision_limited[v] && cells.has_cell(v))
        .count();
    let mut quality = Quality {
        max_degree: max_degree(view, &cells, &on_hull)?,
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
    add_aspects(&mut quality, mesh, &cells, &on_hull);
    Ok(quality)
}

/// Figures over the simplices off the hull or of a cropped domain, less forced and flat ones; and
/// over those.
#[derive(Clone, Default)]
struct SimplexMeasures {
    radius_edge: f64,
    angle: LeastAngle,
    forced: u64,
    forced_angle: LeastAngle,
    below_min_angle: u64,
    /// Simplices with a smaller dihedral angle than was asked for: those of several domains, those
    /// of one.
    below_min_dihedral: [u64; 2],
    flat: u64,
}

/// The smallest of angles, by the squared tangent of half of it.
#[derive(Clone, Copy)]
struct LeastAngle(f64);

impl Default for LeastAngle {
    fn default() -> Self {
        Self(f64::INFINITY)
    }
}

impl LeastAngle {
    fn add(&mut self, squared_tangent: f64) {
        self.0 = self.0.min(squared_tangent);
    }

    /// Returns the smallest angle in degrees, or 0 if there was none.
    fn degrees(&self) -> f64 {
        if self.0.is_infinite() { 0.0 } else { angles::angle(self.0).to_degrees() }
    }
}

impl SimplexMeasures {
    fn add<const D: usize>(
        &mut self,
        view: View<'_, D>,
        cell: &SimplexCell<'_, D>,
        at_cage: &[bool],
    ) -> AllocResult<()> {
        let vertices = view.simplex(cell.simplex);
        let boundary = &view.mesh.boundary;
        if boundary.flat.binary_search(&(cell.simplex as u32)).is_ok() {
            self.flat += 1;
            return Ok(());
        }
        let parameters = &view.mesh.parameters;
        let is_forced = boundary.forced.binary_search(&(cell.simplex as u32)).is_ok();
        let is_at_cage = |&v: &u32| at_cage.get(v as usize).is_some_and(|&at_cage| at_cage);
        let counts = !is_forced && !vertices.iter().any(is_at_cage);
        if is_forced || counts || parameters.min_dihedral > 0.0 {
            let tangent = cell.shape.smallest_squared_tangent()?;
            if is_forced {
                self.forced_angle.add(tangent);
            }
            if counts {
                self.angle.add(tangent);
            }
            if slivers::is_below(tangent, parameters.min_dihedral) {
                let is_of_one = cell.domain != NONE || view.mesh.domains.is_empty();
                self.below_min_dihedral[usize::from(is_of_one)] += 1;
            }
        }
        self.forced += u64::from(is_forced);
        // A triangle's smallest angle is below the one that is asked for if its ratio is above.
        let is_above = cell.radius_edge > parameters.quality_bound * (1.0 + SLACK);
        self.below_min_angle += u64::from(parameters.min_angle > 0.0 && is_above && !is_forced);
        if counts {
            self.radius_edge = self.radius_edge.max(cell.radius_edge);
        }
        Ok(())
    }

    /// Takes the figures of other simplices into account.
    fn merge(&mut self, other: &Self) {
        self.radius_edge = self.radius_edge.max(other.radius_edge);
        self.angle.add(other.angle.0);
        self.forced += other.forced;
        self.forced_angle.add(other.forced_angle.0);
        self.below_min_angle += other.below_min_angle;
        for (count, more) in self.below_min_dihedral.iter_mut().zip(other.below_min_dihedral) {
            *count += more;
        }
        self.flat += other.flat;
    }
}

/// Returns which vertices are on the outer cage, whose simplices are not measured: those on the
/// hull of a mesh that reaches to the cage, holes or not. None if the mesh is cropped to a domain.
fn vertices_at_cage<const D: usize>(
    mesh: &Triangulation,
    on_hull: &[bool],
) -> AllocResult<Vec<bool>> {
    match &mesh.boundary.whole {
        None => copied(on_hull),
        Some(whole) if mesh.parameters.extent == Extent::All => {
            View::<D> { mesh: whole }.hull_vertices()
        }
        Some(_) => Ok(Vec::new()),
    }
}

fn add_aspects(quality: &mut Quality, mesh: &Triangulation, cells: &Cells, on_hull: &[bool]) {
    let (mut sum, mut count) = (0.0, 0u64);
    for (i, domain) in mesh.domains.iter().enumerate().skip(1) {
        let anywhere = cells.cage_aspect_anywhere(i, domain.radius);
        quality.worst_aspect_anywhere = quality.worst_aspect_anywhere.max(anywhere);
    }
    let is_measured = |&v: &usize| !on_hull[v] && mesh.cage_of[v] == NONE && cells.has_cell(v);
    for v in (0..on_hull.len()).filter(is_measured) {
        let anywhere = cells.aspect_anywhere(v);
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

/// Returns the largest number of distinct vertices that share a simplex with one vertex.
/// O(simplices).
///
/// Triangles and tetrahedra round a vertex off the hull tell by their number how many neighbours it
/// has, as the faces of a closed curve or sphere do. At others neighbours are counted, unless they
/// must be fewer.
fn max_degree<const D: usize>(
    view: View<'_, D>,
    cells: &Cells,
    on_hull: &[bool],
) -> AllocResult<u32> {
    let told = |v: usize| degree_inside::<D>(cells, on_hull, v);
    let inside = (0..view.vertex_count()).filter_map(told).max().unwrap_or(0);
    let may_have_more = |v: usize| told(v).is_none() && cells.simplices_at(v) * D > inside;
    let counted = collected((0..view.vertex_count()).map(may_have_more))?;
    let inside = inside as u32;
    match counted.contains(&true) {
        true => Ok(inside.max(max_counted_degree(view, &counted)?)),
        false => Ok(inside),
    }
}

/// Returns the number of neighbours of a vertex off the hull; `None` where it must be counted.
fn degree_inside<const D: usize>(cells: &Cells, on_hull: &[bool], v: usize) -> Option<usize> {
    match (D, cells.simplices_at(v)) {
        _ if on_hull[v] => None,
        (2, simplices) => Some(simplices),
        // Triangles of a sphere are even in number, twice its vertices less four.
        (3, simplices) if simplices > 0 && simplices % 2 == 0 => Some(simplices / 2 + 2),
        _ => None,
    }
}

/// Returns the same of the vertices that are `counted`, by their stars.
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

/// Returns true if array lengths fit and ids are in range, so that reading cannot go astray.
fn is_consistent(mesh: &Triangulation) -> bool {
    let vertices = mesh.kinds.len();
    let size = mesh.dim + 1;
    let below = |ids: &[u32], end: usize| ids.iter().all(|&id| (id as usize) < end);
    let below_or_none =
        |ids: &[u32], end: usize| ids.iter().all(|&id| id == NONE || (id as usize) < end);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::SplitMix;
    use crate::options::{Algorithm, Options};
    use crate::{Mesh, Output};

    fn meshed(dim: usize, count: usize, options: &Options) -> Triangulation {
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
            measure(&mesh).unwrap()
        };
        let one = on_threads(1);
        assert!(one.worst_cage_aspect >= 0.0 && one.min_angle_degrees > 0.0);
        for threads in [2, 3, 8, 0] {
            assert_eq!(on_threads(threads), one);
        }
    }

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

    fn degrees_are_counted<const D: usize>(mesh: &Triangulation) {
        let view = View::<D> { mesh };
        let (cells, on_hull) = (Cells::of(view, None).unwrap(), view.hull_vertices().unwrap());
        let all = vec![true; mesh.vertex_count()];
        let counted = max_counted_degree(view, &all).unwrap();
        assert_eq!(max_degree(view, &cells, &on_hull).unwrap(), counted);
        for v in 0..mesh.vertex_count() {
            let mut one = vec![false; mesh.vertex_count()];
            one[v] = true;
            let degree = max_counted_degree(view, &one).unwrap();
            if let Some(told) = degree_inside::<D>(&cells, &on_hull, v) {
                assert_eq!(told, degree as usize, "{v}");
            }
        }
    }
}
