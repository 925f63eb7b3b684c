//! Voronoi cells of vertices and of cages (§3, §4): in-radii, and out-radii restricted to the
//! corners that count for a cell. One pass over the simplices, which threads share; shared by the
//! measures and the certificate.

use super::corner::Corner;
use super::length::Length;
use super::simplex::Simplex;
use super::tree::DomainTree;
use super::view::View;
use crate::memory::{AllocResult, collected, filled, prefetch, prefetch_at, with_capacity};
use crate::mesh::{MAX_DIM, NONE};
use crate::parameters::Parameters;
use crate::threads::{share, usable};
use std::ops::Range;

/// Largest number of domains that the walks up the hierarchy may visit per simplex on average.
/// Cages that are not encroached let no D-ball span more than a few.
const CLIMBS_PER_SIMPLEX: usize = 64;

/// Number of simplices that a thread takes at once.
pub(crate) const PIECE: usize = 1 << 14;

/// Largest number of threads of a survey: each has radii of all cells.
const MOST_THREADS: usize = 8;

/// Number of simplices after which one is surveyed whose vertices are asked for.
const AHEAD: usize = 8;

/// Radii of the cell of a vertex, in one cache line.
#[derive(Clone, Copy)]
#[repr(align(32))]
struct Cell {
    /// Distance to the nearest Delaunay neighbour: twice the in-radius.
    nearest: Length,
    /// Out-radius over the corners that count in the vertex's domain.
    farthest: Length,
    /// Out-radius over all corners.
    farthest_anywhere: Length,
    /// Number of simplices at the vertex.
    simplices: u32,
}

impl Cell {
    const EMPTY: Self = Self {
        nearest: Length::INFINITE,
        farthest: Length::ZERO,
        farthest_anywhere: Length::ZERO,
        simplices: 0,
    };

    fn merge(&mut self, other: &Self) {
        self.nearest = self.nearest.min(other.nearest);
        self.farthest = self.farthest.max(other.farthest);
        self.farthest_anywhere = self.farthest_anywhere.max(other.farthest_anywhere);
        self.simplices += other.simplices;
    }
}

/// Radii of the union cell of a cage.
#[derive(Clone, Copy)]
struct Cage {
    /// Distance of the domain's centre to the nearest vertex outside its ball.
    nearest: Length,
    /// Out-radius over the corners that count in the parent.
    farthest: Length,
    /// Out-radius over all corners.
    farthest_anywhere: Length,
}

impl Cage {
    const EMPTY: Self =
        Self { nearest: Length::INFINITE, farthest: Length::ZERO, farthest_anywhere: Length::ZERO };

    fn merge(&mut self, other: &Self) {
        self.nearest = self.nearest.min(other.nearest);
        self.farthest = self.farthest.max(other.farthest);
        self.farthest_anywhere = self.farthest_anywhere.max(other.farthest_anywhere);
    }
}

/// Radii of the cells of all vertices and cages.
pub(crate) struct Cells {
    cells: Vec<Cell>,
    cages: Vec<Cage>,
    /// Number of domains that walks up the hierarchy have visited.
    climbs: usize,
    /// False if simplices span absurdly many domains, and the cage radii were given up.
    pub cages_complete: bool,
}

/// Measures of one simplex, which [`Cells::survey`] passes to its caller.
pub(crate) struct SimplexCell<'a, const D: usize> {
    pub simplex: usize,
    pub shape: &'a Simplex<'a, D>,
    /// Circumradius over shortest edge; infinite for a flat simplex.
    pub radius_edge: f64,
    /// True if the circumcentre counts in the domain of each of the vertices.
    pub counts: bool,
    /// The domain of all vertices, [`NONE`] if they are of several.
    pub domain: u32,
}

/// Returns the pieces that a survey of so many simplices is divided into.
pub(crate) fn pieces(simplices: usize) -> impl ExactSizeIterator<Item = Range<usize>> {
    (0..simplices.div_ceil(PIECE))
        .map(move |piece| piece * PIECE..simplices.min((piece + 1) * PIECE))
}

impl Cells {
    /// Surveys a mesh whose ids are in range, on the threads that its run was allowed. Without a
    /// `tree` every corner counts. `slack` (about 1) multiplies the radius within which corners
    /// count. `visit` sees every simplex, with the state of its piece: there is one for each of
    /// the [`pieces`]. O(simplices) for a hierarchical mesh.
    pub fn survey<const D: usize, S: Send>(
        view: View<'_, D>,
        tree: Option<&DomainTree>,
        slack: f64,
        states: &mut [S],
        visit: impl Fn(&mut S, &SimplexCell<'_, D>) -> AllocResult<()> + Sync,
    ) -> AllocResult<Self> {
        let reaches = reaches(view, slack)?;
        let most_climbs = view.simplex_count().saturating_mul(CLIMBS_PER_SIMPLEX);
        let ground = Ground { view, tree, reaches: &reaches, most_climbs };
        let threads = usable(view.mesh.parameters.threads).min(states.len()).min(MOST_THREADS);
        let empty = || Self::empty(view.vertex_count(), view.mesh.domains.len());
        let mut parts = with_capacity(threads.max(1))?;
        parts.push(empty()?);
        for _ in 1..threads {
            parts.push(empty()?);
        }
        let work = pieces(view.simplex_count()).zip(states);
        share(work, &mut parts, |cells, (piece, state)| {
            for simplex in piece {
                cells.ask_for(view, simplex + AHEAD);
                cells.enter(&ground, simplex, |cell| visit(state, cell))?;
            }
            Ok(())
        })?;
        let mut whole = parts.swap_remove(0);
        parts.iter().for_each(|part| whole.merge(part));
        if whole.climbs > most_climbs {
            whole.cages.fill(Cage::EMPTY);
            whole.cages_complete = false;
        }
        Ok(whole)
    }

    /// Surveys a mesh as [`Self::survey`] does, without a look at its simplices.
    pub fn of<const D: usize>(view: View<'_, D>, tree: Option<&DomainTree>) -> AllocResult<Self> {
        let mut states = filled(pieces(view.simplex_count()).len(), ())?;
        Self::survey(view, tree, 1.0, &mut states, |_, _| Ok(()))
    }

    /// Asks for what [`Self::enter`] needs of a simplex: its vertices may be anywhere in memory.
    #[inline]
    fn ask_for<const D: usize>(&self, view: View<'_, D>, simplex: usize) {
        let first = simplex * View::<D>::VERTICES;
        let vertices = view.mesh.simplices.get(first..first + View::<D>::VERTICES);
        for &vertex in vertices.unwrap_or_default() {
            let vertex = vertex as usize;
            prefetch_at(&view.mesh.points, vertex * D, D);
            prefetch(&self.cells, vertex);
            prefetch(&view.mesh.vertex_domains, vertex);
        }
    }

    #[inline]
    fn enter<const D: usize>(
        &mut self,
        ground: &Ground<'_, D>,
        simplex: usize,
        visit: impl FnOnce(&SimplexCell<'_, D>) -> AllocResult<()>,
    ) -> AllocResult<()> {
        let view = ground.view;
        let vertices = view.simplex(simplex);
        let points = &view.points_of(vertices)[..View::<D>::VERTICES];
        let shape = Simplex::new(points);
        let mut labels = [NONE; MAX_DIM + 1];
        for (label, &vertex) in labels.iter_mut().zip(vertices) {
            *label = view.mesh.vertex_domains[vertex as usize];
        }
        let labels = &labels[..View::<D>::VERTICES];
        let corner = shape.corner()?;
        let star = Labelled { ground, vertices, labels, points, corner: corner.as_ref() };
        let counts = self.add_vertices(&star, shape.nearest());
        let is_of_one = labels.iter().all(|label| *label == labels[0]);
        if let Some(tree) = ground.tree.filter(|_| !is_of_one) {
            self.add_cages(&star, tree);
        }
        let ratio = |corner: &Corner<D>| corner.radius.ratio(corner.shortest_edge);
        let radius_edge = corner.as_ref().map_or(f64::INFINITY, ratio);
        let domain = if is_of_one { labels[0] } else { NONE };
        visit(&SimplexCell { simplex, shape: &shape, radius_edge, counts, domain })
    }

    /// Takes the radii of other simplices into account.
    fn merge(&mut self, other: &Self) {
        self.cells.iter_mut().zip(&other.cells).for_each(|(cell, other)| cell.merge(other));
        self.cages.iter_mut().zip(&other.cages).for_each(|(cage, other)| cage.merge(other));
        self.climbs = self.climbs.saturating_add(other.climbs);
    }

    /// Returns the number of simplices at a vertex.
    pub fn simplices_at(&self, vertex: usize) -> usize {
        self.cells[vertex].simplices as usize
    }

    /// Returns true if a simplex has `vertex`: in a part of a mesh some vertices have none.
    pub fn has_cell(&self, vertex: usize) -> bool {
        self.cells[vertex].nearest != Length::INFINITE
    }

    /// Returns the distance of a domain's centre to the nearest vertex outside its ball.
    pub fn cage_nearest(&self, domain: usize) -> Length {
        self.cages[domain].nearest
    }

    /// Returns true if a simplex has vertices inside and outside of the ball of `domain`.
    pub fn has_cage(&self, domain: usize) -> bool {
        self.cages[domain].nearest != Length::INFINITE
    }

    /// Returns the out-radius over the in-radius of the cell of `vertex`, over the corners that
    /// count.
    pub fn aspect(&self, vertex: usize) -> f64 {
        2.0 * self.cells[vertex].farthest.ratio(self.cells[vertex].nearest)
    }

    /// Returns the out-radius over the in-radius of the cell of `vertex`, over all of its corners.
    pub fn aspect_anywhere(&self, vertex: usize) -> f64 {
        2.0 * self.cells[vertex].farthest_anywhere.ratio(self.cells[vertex].nearest)
    }

    /// Returns the aspect of the union cell of the cage of a `domain` of this `radius`, over the
    /// corners that count. Its in-radius is (d + r) / 2 (§5, approximation by cages).
    pub fn cage_aspect(&self, domain: usize, radius: f64) -> f64 {
        let twice_inner = self.cages[domain].nearest.plus(Length::new(radius));
        2.0 * self.cages[domain].farthest.ratio(twice_inner)
    }

    /// Returns the aspect of the union cell of the cage of a `domain` of this `radius`, over all of
    /// its corners.
    pub fn cage_aspect_anywhere(&self, domain: usize, radius: f64) -> f64 {
        let twice_inner = self.cages[domain].nearest.plus(Length::new(radius));
        2.0 * self.cages[domain].farthest_anywhere.ratio(twice_inner)
    }

    fn empty(vertices: usize, domains: usize) -> AllocResult<Self> {
        Ok(Self {
            cells: filled(vertices, Cell::EMPTY)?,
            cages: filled(domains, Cage::EMPTY)?,
            climbs: 0,
            cages_complete: true,
        })
    }

    /// Enters one simplex into the cells of its vertices, given the distance of each to the nearest
    /// other one; returns whether its corner counts in all.
    #[inline]
    fn add_vertices<const D: usize>(&mut self, star: &Labelled<'_, D>, nearest: &[Length]) -> bool {
        let restricted = star.ground.tree.is_some();
        let radius = star.corner.map_or(Length::INFINITE, |corner| corner.radius);
        let (mut last, mut last_counts, mut all_count) = (NONE, true, true);
        for (i, (&v, &label)) in star.vertices.iter().zip(star.labels).enumerate() {
            if restricted && label != last {
                (last, last_counts) = (label, star.counts_in(label));
            }
            all_count &= last_counts;
            let farthest = if last_counts { radius } else { Length::ZERO };
            let entry =
                Cell { nearest: nearest[i], farthest, farthest_anywhere: radius, simplices: 1 };
            self.cells[v as usize].merge(&entry);
        }
        all_count
    }

    /// Enters one simplex into the union cells of all domains that hold some of its vertices only.
    ///
    /// The nearest vertex outside a ball is seen so: the Delaunay graph is connected within every
    /// ball, so that vertex has a neighbour among the vertices inside.
    fn add_cages<const D: usize>(&mut self, star: &Labelled<'_, D>, tree: &DomainTree) {
        for (i, &label) in star.labels.iter().enumerate() {
            let mut domain = label;
            if star.labels[..i].contains(&domain) {
                continue;
            }
            while star.labels.iter().any(|&label| !tree.holds(domain, label)) {
                if self.climbs > star.ground.most_climbs {
                    return;
                }
                self.climbs += 1;
                self.add_cage(star, tree, domain);
                domain = tree.parent(domain);
            }
        }
    }

    fn add_cage<const D: usize>(&mut self, star: &Labelled<'_, D>, tree: &DomainTree, domain: u32) {
        let cage = &mut self.cages[domain as usize];
        let center = &star.ground.reaches[domain as usize].center;
        for (point, &label) in star.points.iter().zip(star.labels) {
            if !tree.holds(domain, label) {
                cage.nearest = cage.nearest.min(Length::between(point, center));
            }
        }
        let reach = star.corner.map_or(Length::INFINITE, |c| c.distance(star.points, center));
        cage.farthest_anywhere = cage.farthest_anywhere.max(reach);
        if star.counts_in(tree.parent(domain)) {
            cage.farthest = cage.farthest.max(reach);
        }
    }
}

/// Mesh of a survey, and what it needs to know beside the simplices.
struct Ground<'a, const D: usize> {
    view: View<'a, D>,
    tree: Option<&'a DomainTree>,
    reaches: &'a [Reach<D>],
    most_climbs: usize,
}

/// Ball round the centre of a domain in which corners count.
struct Reach<const D: usize> {
    center: [f64; D],
    radius: Length,
    /// Squared distances between which only [`Length`] tells whether they are below the radius.
    unsure: [f64; 2],
}

impl<const D: usize> Reach<D> {
    fn new(center: [f64; D], radius: Length) -> Self {
        /// Far more than the roundings of a square, a root and a length.
        const MARGIN: f64 = 1e-14;
        let squared = radius.to_f64() * radius.to_f64();
        let unsure = match Length::SQUARES.contains(&squared) {
            true => [squared * (1.0 - MARGIN), squared * (1.0 + MARGIN)],
            false => [0.0, f64::INFINITY],
        };
        Self { center, radius, unsure }
    }
}

/// One simplex with the domains of its vertices and its corner.
struct Labelled<'a, const D: usize> {
    ground: &'a Ground<'a, D>,
    vertices: &'a [u32],
    labels: &'a [u32],
    points: &'a [&'a [f64; D]],
    corner: Option<&'a Corner<D>>,
}

impl<const D: usize> Labelled<'_, D> {
    /// Returns true if the Voronoi corner counts for cells of `domain`. The corner of a flat
    /// simplex always counts.
    #[inline]
    fn counts_in(&self, domain: u32) -> bool {
        let Some(corner) = self.corner else {
            return true;
        };
        let Reach { center, radius, unsure: [least, most] } = &self.ground.reaches[domain as usize];
        let squared = corner.squared_distance(self.points, center);
        match Length::SQUARES.contains(&squared) && !(*least..=*most).contains(&squared) {
            true => squared < *least,
            false => corner.distance(self.points, center) < *radius,
        }
    }
}

/// Returns for each domain the ball in which corners count.
fn reaches<const D: usize>(view: View<'_, D>, slack: f64) -> AllocResult<Vec<Reach<D>>> {
    let parameters = &view.mesh.parameters;
    let factor = corner_restriction(parameters) * parameters.cage_scale * slack;
    collected(view.mesh.domains.iter().map(|domain| {
        Reach::new(*view.point(domain.center), Length::new(domain.radius).times(factor))
    }))
}

/// Returns the fraction of the radius of a domain's cage sphere within which corners count. The
/// cage is a delta-net of its sphere, whose hull holds the ball of 1 - delta^2 / 2; what is beyond
/// belongs to the union cell of the cage.
fn corner_restriction(parameters: &Parameters) -> f64 {
    const LARGEST: f64 = 0.85;
    LARGEST.min(1.0 - 0.5 * parameters.delta * parameters.delta)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Domain;
    use crate::options::Options;
    use crate::quality::tests::meshed;

    /// Holds that squares tell what lengths do, at distances that roundings cannot tell from the
    /// limit too, at any scale.
    #[test]
    fn corners_count_by_squares_as_by_lengths() {
        let mut mesh = meshed(3, 20, &Options::default());
        let tree = DomainTree::new(&mesh.domains).unwrap().unwrap();
        let mut answers = [0; 2];
        for scale in [1e-170, 1e-30, 1.0, 1e140] {
            let points = [[0.0; 3], [1.0, 0.1, 0.0], [0.2, 1.0, 0.0], [0.3, 0.1, 1.0]];
            let points = points.map(|point| point.map(|x| x * scale));
            let points: Vec<&[f64; 3]> = points.iter().collect();
            let corner = Corner::new(&points).unwrap().unwrap();
            let center = [5.0, 4.0, 3.0].map(|x| x * scale);
            mesh.points[..3].copy_from_slice(&center);
            let distance = corner.distance(&points, &center);
            for steps in -40..=40 {
                let factor = 1.0 + f64::from(steps) * f64::EPSILON;
                let limit = distance.times(factor);
                mesh.domains = vec![Domain { center: 0, parent: NONE, radius: 1.0 }];
                let reaches = [Reach::new(center, limit)];
                let view = View::<3> { mesh: &mesh };
                let ground = Ground { view, tree: Some(&tree), reaches: &reaches, most_climbs: 0 };
                let star = Labelled {
                    ground: &ground,
                    vertices: &[0, 1, 2, 3],
                    labels: &[0; 4],
                    points: &points,
                    corner: Some(&corner),
                };
                assert_eq!(star.counts_in(0), distance < limit, "{scale} {steps}");
                answers[usize::from(distance < limit)] += 1;
            }
        }
        assert!(answers.iter().all(|&count| count > 100), "{answers:?}");
    }
}
