//! Sizes under changes: no simplex that comes is larger than was asked for.

use super::View;
use super::cone::Cone;
use super::vacancy::Vacancy;

impl Cone {
    /// Whether a vertex at `x` would make simplices that are small enough. It asks the caller, so it
    /// comes after all other tests.
    pub fn keeps_sizes<const D: usize>(&self, view: View<'_, D>, x: &[f64; D]) -> bool {
        let Some(sizes) = view.sizes else { return true };
        self.sides.iter().all(|side| sizes.allow(view.delaunay, &side.vertices, side.apex, x))
    }
}

impl<const D: usize> Vacancy<D> {
    /// Whether the simplices of the filling that would stay are small enough.
    pub fn keeps_filling_sizes(&self, view: View<'_, D>) -> bool {
        let Some(sizes) = view.sizes else { return true };
        self.staying().all(|number| {
            let vertices = self.hole.filling.vertices(number);
            let x = view.delaunay.point(vertices[0]);
            sizes.allow(view.delaunay, vertices, 0, x)
        })
    }
}
