//! The tetrahedra that a point would make: the cone over the boundary of its cavity.

use crate::complex::VertexId;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow};
use crate::netmesh::slivers::shape::{Measure, Tetrahedron, in_space, tetrahedron};
use crate::netmesh::slivers::view::View;

/// A tetrahedron whose vertex number `apex` is the point.
#[derive(Clone, Copy)]
pub(super) struct ConeSimplex {
    pub vertices: [VertexId; 4],
    pub apex: usize,
}

impl ConeSimplex {
    /// Returns the vertices of the facet.
    pub fn base(&self) -> impl Iterator<Item = VertexId> {
        let apex = self.apex;
        self.vertices.into_iter().enumerate().filter(move |&(at, _)| at != apex).map(|(_, v)| v)
    }
}

#[derive(Default)]
pub(super) struct Cone {
    pub sides: Vec<ConeSimplex>,
}

impl Cone {
    /// Adds the tetrahedron over the facet opposite the vertex number `apex` of `vertices`.
    #[inline]
    pub fn push(&mut self, vertices: &[VertexId], apex: usize) -> AllocResult<()> {
        let vertices = std::array::from_fn(|index| vertices[index]);
        self.sides.try_push(ConeSimplex { vertices, apex })
    }

    /// Returns `gain` less the penalties of the cone of `x`, if that is more than `least`.
    #[inline]
    pub fn judge(&self, view: View<'_>, x: &[f64; 3], gain: f64, least: f64) -> Option<f64> {
        let x = in_space(x);
        let mut account = Account::new(view.measure, gain, least);
        let is_worth = self.sides.iter().all(|side| {
            let mut tetrahedron = tetrahedron(view.delaunay, &side.vertices);
            tetrahedron[side.apex] = x;
            account.charge(tetrahedron)
        });
        if is_worth { account.rest() } else { None }
    }

    /// Returns true if one of the facets has all of `vertices`.
    pub fn has(&self, vertices: &[VertexId]) -> bool {
        // Without a branch, as `Array::push_if`.
        let has = |side: &ConeSimplex, vertex| {
            let own = side.vertices.iter().enumerate();
            own.fold(false, |any, (at, &own)| any | ((own == vertex) & (at != side.apex)))
        };
        let holds = |side| vertices.iter().fold(true, |all, &vertex| all & has(side, vertex));
        self.sides.iter().any(holds)
    }

    /// Returns true if the simplices that a vertex at `x` would make are as small as the caller
    /// asks for, and their edges no longer than `max_edge`. This asks the caller, so it comes
    /// after all other tests.
    pub fn keeps_sizes(&self, view: View<'_>, x: &[f64; 3], max_edge: f64) -> Result<bool> {
        let Some(sizes) = view.sizes else { return Ok(true) };
        for side in &self.sides {
            if !sizes.allow(view.delaunay, &side.vertices, side.apex, x, max_edge)? {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

/// Account of a gain, less the penalties of tetrahedra as they come. They are measured two at a
/// time, which is faster.
pub(super) struct Account<'a> {
    measure: &'a Measure,
    gain: f64,
    least: f64,
    waiting: Option<Tetrahedron>,
}

impl<'a> Account<'a> {
    pub fn new(measure: &'a Measure, gain: f64, least: f64) -> Self {
        Self { measure, gain, least, waiting: None }
    }

    /// Takes what a tetrahedron adds to the objective. Returns whether more than the least is left,
    /// as far as that is known.
    #[inline(always)]
    pub fn charge(&mut self, tetrahedron: Tetrahedron) -> bool {
        match self.waiting.take() {
            None => self.waiting = Some(tetrahedron),
            Some(first) => {
                let [a, b] = self.measure.penalties([&first, &tetrahedron]);
                self.gain -= a + b;
            }
        }
        self.gain > self.least
    }

    /// Returns the gain less all penalties, if that is more than the least.
    pub fn rest(self) -> Option<f64> {
        let last = self.waiting.map_or(0.0, |tetrahedron| self.measure.penalty(&tetrahedron));
        let gain = self.gain - last;
        (gain > self.least).then_some(gain)
    }
}
