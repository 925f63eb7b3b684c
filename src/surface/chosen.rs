//! Facets chosen one by one, so that they are a manifold with a boundary all the time.

use super::balls::unit_vector;
use crate::memory::{AllocResult, TryGrow, filled, reserve};
use crate::mesh::NONE;
use crate::query::dual::dot;
use crate::query::unit::Unit;
use crate::query::view::View;

/// Least cosine of the angle between two facets that is a fold: of a flat simplex both sides.
const FOLD: f64 = 0.5;

/// The facets chosen so far. A facet is known by its place in `neighbors`, the first of its two.
pub struct Chosen<'a, const D: usize> {
    pub view: View<'a, D>,
    unit: Unit,
    is_chosen: Vec<bool>,
    /// Vertex -> the places of its chosen facets, ascending.
    of_vertices: Vec<Vec<usize>>,
}

/// The other vertices of a facet of a vertex: two in space, one and [`NONE`] in the plane.
type Rest = [u32; 2];

/// The chosen facets of a vertex.
#[derive(Default)]
pub struct Link {
    /// Each with its place.
    pub facets: Vec<(Rest, usize)>,
}

impl Link {
    /// Returns the number of facets that have another vertex, too.
    fn degree(&self, other: u32) -> usize {
        self.facets.iter().filter(|(rest, _)| rest.contains(&other)).count()
    }

    /// Returns true if a ridge of the link's vertex has one facet alone.
    pub fn has_end(&self) -> bool {
        let mut others = self.facets.iter().flat_map(|(rest, _)| rest);
        others.any(|&other| self.degree(other) == 1)
    }

    /// Returns the number of facets on the way from one vertex to another across ridges of the
    /// link's vertex; none if there is no way.
    fn steps_between(&self, from: u32, to: u32) -> Option<usize> {
        let (mut at, mut last) = (from, usize::MAX);
        for length in 0.. {
            if at == to && length > 0 {
                return Some(length);
            }
            let next =
                self.facets.iter().find(|(rest, place)| *place != last && rest.contains(&at));
            let (rest, place) = next.filter(|_| length <= self.facets.len())?;
            at = if rest[0] == at { rest[1] } else { rest[0] };
            last = *place;
        }
        None
    }

    /// Finds the fans of facets that are connected across ridges of the link's vertex: writes for
    /// each facet its fan, and returns how many fans there are.
    pub fn fans(&self, is_plane: bool, fans: &mut Vec<u32>) -> AllocResult<u32> {
        fans.clear();
        let mut count = 0;
        for _ in &self.facets {
            fans.try_push(u32::MAX)?;
        }
        while let Some(start) = fans.iter().position(|&fan| fan == u32::MAX) {
            fans[start] = count;
            // A fan is small, so it grows by looking at all again.
            let mut has_grown = true;
            while has_grown {
                has_grown = false;
                for i in 0..fans.len() {
                    let meets = |j: usize| {
                        let (a, b) = (self.facets[i].0, self.facets[j].0);
                        fans[j] == count && (is_plane || a.iter().any(|v| b.contains(v)))
                    };
                    if fans[i] == u32::MAX && (0..fans.len()).any(meets) {
                        fans[i] = count;
                        has_grown = true;
                    }
                }
            }
            count += 1;
        }
        Ok(count)
    }
}

impl<'a, const D: usize> Chosen<'a, D> {
    /// Begins with no facets.
    pub fn new(view: View<'a, D>, unit: Unit) -> AllocResult<Self> {
        let is_chosen = filled(view.mesh.neighbors.len(), false)?;
        let of_vertices = filled(view.mesh.vertex_count(), Vec::new())?;
        Ok(Self { view, unit, is_chosen, of_vertices })
    }

    /// Returns true if a facet is chosen.
    pub fn has(&self, at: usize) -> bool {
        self.is_chosen[at]
    }

    /// Returns the places of the chosen facets, ascending.
    pub fn places(&self) -> impl Iterator<Item = usize> {
        (0..self.is_chosen.len()).filter(|&at| self.is_chosen[at])
    }

    /// Chooses a facet that is not chosen yet.
    pub fn choose(&mut self, at: usize) -> AllocResult<()> {
        self.is_chosen[at] = true;
        for vertex in vertices_of(self.view, at) {
            let own = &mut self.of_vertices[vertex as usize];
            reserve(own, 1)?;
            own.insert(own.partition_point(|&other| other < at), at);
        }
        Ok(())
    }

    /// Gives up a facet that is chosen.
    pub fn give_up(&mut self, at: usize) {
        self.is_chosen[at] = false;
        for vertex in vertices_of(self.view, at) {
            self.of_vertices[vertex as usize].retain(|&other| other != at);
        }
    }

    /// Reads the chosen facets of a vertex into its link.
    pub fn read_link(&self, vertex: u32, link: &mut Link) -> AllocResult<()> {
        link.facets.clear();
        for &at in &self.of_vertices[vertex as usize] {
            link.facets.try_push((rest(vertices_of(self.view, at), vertex), at))?;
        }
        Ok(())
    }

    /// Returns with how many of its ridges a facet would go on from those that are chosen, if they
    /// stayed a manifold with it and it is no fold.
    pub fn fits(&self, at: usize, link: &mut Link) -> AllocResult<Option<usize>> {
        let vertices = vertices_of(self.view, at);
        let mut open = 0;
        for vertex in vertices {
            self.read_link(vertex, link)?;
            let [a, b] = rest(vertices, vertex);
            let is_free = match b {
                NONE => link.facets.len() < 2,
                _ => link.degree(a) < 2 && link.degree(b) < 2,
            };
            let closes_all =
                b == NONE || link.steps_between(a, b).is_none_or(|n| n == link.facets.len());
            if !is_free || !closes_all || self.is_fold(vertex, [a, b], link) {
                return Ok(None);
            }
            // In space each ridge is met at both of its ends.
            open += if b == NONE { 2 * link.facets.len() } else { link.degree(a) + link.degree(b) };
        }
        Ok(Some(open / 2))
    }

    /// Returns true if a facet of a vertex turns back at a ridge onto one that is chosen.
    fn is_fold(&self, vertex: u32, [a, b]: Rest, link: &Link) -> bool {
        let origin = self.view.point(vertex);
        let way = |to: u32| self.unit.difference(self.view.point(to), origin);
        // The direction to the apex at right angles to the ridge.
        let across = |ridge: u32, apex: u32| {
            let to = unit_vector(way(apex));
            if ridge == NONE {
                return to;
            }
            let along = unit_vector(way(ridge));
            let part = dot(&along, &to);
            unit_vector(std::array::from_fn(|i| to[i] - part * along[i]))
        };
        let folds = |ridge: u32, apex: u32, other: u32| {
            dot(&across(ridge, apex), &across(ridge, other)) > FOLD
        };
        link.facets.iter().any(|&([c, d], _)| match b {
            NONE => folds(NONE, a, c),
            _ if c == a || d == a => folds(a, b, if c == a { d } else { c }),
            _ if c == b || d == b => folds(b, a, if c == b { d } else { c }),
            _ => false,
        })
    }
}

/// Returns the vertices of the facet at a place.
pub fn vertices_of<const D: usize>(view: View<'_, D>, at: usize) -> [u32; D] {
    let simplex = view.simplex((at / (D + 1)) as u32);
    std::array::from_fn(|k| simplex[k + usize::from(k >= at % (D + 1))])
}

/// Returns the vertices of a facet but one.
fn rest<const D: usize>(vertices: [u32; D], vertex: u32) -> Rest {
    let mut others = vertices.into_iter().filter(|&other| other != vertex);
    std::array::from_fn(|_| others.next().unwrap_or(NONE))
}
