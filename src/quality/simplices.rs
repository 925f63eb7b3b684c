//! Figures over the simplices of a mesh: ratios, angles, and how many miss what was asked for.

use super::SLACK;
use super::angles::{self, Screen};
use super::cells::SimplexCell;
use super::slivers;
use super::view::View;
use crate::memory::{AllocResult, copied};
use crate::mesh::{NONE, Triangulation};
use crate::options::Extent;

/// The mesh whose simplices are measured, and what figures need to know of it.
pub(super) struct Measured<'a, const D: usize> {
    view: View<'a, D>,
    /// Vertex -> true if it is on the outer cage; empty if no vertex is.
    at_cage: Vec<bool>,
    /// Screen for the angle that was asked for.
    asked: Screen,
}

impl<'a, const D: usize> Measured<'a, D> {
    pub fn new(view: View<'a, D>, on_hull: &[bool]) -> AllocResult<Self> {
        let asked = match view.mesh.parameters.min_dihedral {
            degrees if degrees > 0.0 => {
                Screen::of(angles::squared_tangent(degrees.to_radians() * (1.0 + SLACK)))
            }
            _ => Screen::CLOSED,
        };
        Ok(Self { view, at_cage: vertices_at_cage::<D>(view.mesh, on_hull)?, asked })
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

/// Figures over the simplices off the hull or of a cropped domain, less forced and flat ones; and
/// over those.
#[derive(Clone, Default)]
pub(super) struct SimplexMeasures {
    pub radius_edge: f64,
    pub angle: LeastAngle,
    pub forced: u64,
    pub forced_angle: LeastAngle,
    pub below_min_angle: u64,
    /// Simplices with a smaller dihedral angle than was asked for: those of several domains, those
    /// of one.
    pub below_min_dihedral: [u64; 2],
    pub flat: u64,
}

/// The smallest of angles, by the squared tangent of half of it.
#[derive(Clone, Copy)]
pub(super) struct LeastAngle {
    squared_tangent: f64,
    /// Screen for what is smaller.
    screen: Screen,
}

impl Default for LeastAngle {
    fn default() -> Self {
        Self { squared_tangent: f64::INFINITY, screen: Screen::OPEN }
    }
}

impl LeastAngle {
    fn add(&mut self, squared_tangent: f64) {
        if squared_tangent < self.squared_tangent {
            *self = Self { squared_tangent, screen: Screen::of(squared_tangent) };
        }
    }

    /// Returns the smallest angle in degrees, or 0 if there was none.
    pub fn degrees(&self) -> f64 {
        match self.squared_tangent {
            f64::INFINITY => 0.0,
            squared => angles::angle(squared).to_degrees(),
        }
    }
}

impl SimplexMeasures {
    #[inline]
    pub fn add<const D: usize>(
        &mut self,
        of: &Measured<'_, D>,
        cell: &SimplexCell<'_, D>,
    ) -> AllocResult<()> {
        let Measured { view, at_cage, asked } = of;
        let boundary = &view.mesh.boundary;
        let is_in =
            |list: &[u32]| !list.is_empty() && list.binary_search(&(cell.simplex as u32)).is_ok();
        if is_in(&boundary.flat) {
            self.flat += 1;
            return Ok(());
        }
        let parameters = &view.mesh.parameters;
        let is_forced = is_in(&boundary.forced);
        let is_at_cage = |&v: &u32| at_cage.get(v as usize).is_some_and(|&at_cage| at_cage);
        let counts = !is_forced && !view.simplex(cell.simplex).iter().any(is_at_cage);
        let mut screen = *asked;
        if is_forced {
            screen = screen.wider(self.forced_angle.screen);
        } else if counts {
            screen = screen.wider(self.angle.screen);
        }
        if cell.shape.may_pass(screen) {
            self.add_angle(cell, counts, is_forced, view.mesh)?;
        }
        self.forced += u64::from(is_forced);
        // A triangle's smallest angle is below the one that is asked for if its ratio is above.
        let is_above = cell.radius_edge > parameters.quality_bound * (1.0 + SLACK);
        self.below_min_angle += u64::from(parameters.min_angle > 0.0 && is_above && !is_forced);
        if counts && cell.radius_edge > self.radius_edge {
            self.radius_edge = cell.radius_edge;
        }
        Ok(())
    }

    /// Adds the smallest angle of a simplex that may be the smallest of all, or below the one that
    /// was asked for.
    fn add_angle<const D: usize>(
        &mut self,
        cell: &SimplexCell<'_, D>,
        counts: bool,
        is_forced: bool,
        mesh: &Triangulation,
    ) -> AllocResult<()> {
        let tangent = cell.shape.smallest_squared_tangent()?;
        if is_forced {
            self.forced_angle.add(tangent);
        }
        if counts {
            self.angle.add(tangent);
        }
        if slivers::is_below(tangent, mesh.parameters.min_dihedral) {
            let is_of_one = cell.domain != NONE || mesh.domains.is_empty();
            self.below_min_dihedral[usize::from(is_of_one)] += 1;
        }
        Ok(())
    }

    /// Takes the figures of other simplices into account.
    pub fn merge(&mut self, other: &Self) {
        self.radius_edge = self.radius_edge.max(other.radius_edge);
        self.angle.add(other.angle.squared_tangent);
        self.forced += other.forced;
        self.forced_angle.add(other.forced_angle.squared_tangent);
        self.below_min_angle += other.below_min_angle;
        for (count, more) in self.below_min_dihedral.iter_mut().zip(other.below_min_dihedral) {
            *count += more;
        }
        self.flat += other.flat;
    }
}
