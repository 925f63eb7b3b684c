//! A part of a Delaunay complex, to be refined apart from the rest. What is inserted in it must leave the
//! simplices at its rim as they are. Those are Delaunay on both sides then, and so is every facet of all
//! parts together when they have joined; a complex that is Delaunay at every facet is so as a whole.

use super::Delaunay;
use crate::complex::{GlobalToLocal, LocalToGlobal};
use crate::error::Result;
use crate::memory::{AllocResult, Array, TryGrow, collected, filled};
use crate::mesh::NONE;
use crate::numerics::Circumball;

/// Room that a part's simplices grow in.
pub(crate) struct Room<const D: usize> {
    records: Array<u32>,
    balls: Array<Circumball<D>>,
}

impl<const D: usize> Delaunay<D> {
    /// See [`crate::complex::Complex::part`].
    pub fn partition(
        &self,
        local_to_global: &mut LocalToGlobal,
        ids: &mut GlobalToLocal,
        mut tick: impl FnMut() -> Result<()>,
    ) -> Result<Self> {
        let complex = self.complex.partition(local_to_global, ids, &mut tick)?;
        let mut points = Array::with_room(local_to_global.vertices.len())?;
        for &vertex in &local_to_global.vertices {
            tick()?;
            points.try_push(*self.point(vertex))?;
        }
        let mut balls = Array::with_room(local_to_global.simplices.len())?;
        for &simplex in &local_to_global.simplices {
            tick()?;
            balls.try_push(renamed(&self.balls[simplex as usize], &ids.vertices))?;
        }
        Ok(Self { complex, points, balls, exact_fallbacks: 0.into() })
    }

    /// Simplices that there is room for.
    pub fn spare_simplices(&self) -> usize {
        self.balls.spare().min(self.complex.spare_simplices())
    }

    /// Goes on in `room`.
    pub fn move_to(&mut self, room: Room<D>) -> AllocResult<()> {
        self.complex.move_to(room.records)?;
        self.balls.move_into(room.balls)
    }

    /// Divides the spare room for simplices, so many for each; nothing if it is not enough.
    pub fn split_reserve(&mut self, reserves: &[usize]) -> Option<Vec<Room<D>>> {
        let records = self.complex.split_reserve(reserves)?;
        let balls = self.balls.split_reserve(reserves)?;
        let room = |(records, balls)| Room { records, balls };
        collected(records.into_iter().zip(balls).map(room)).ok()
    }

    /// Vertex of a part -> whether the whole has simplices at it that the part has not: then it is on a
    /// facet at the rim.
    pub fn interface_vertices(&self) -> Result<Vec<bool>> {
        let mut is_at_rim = filled(self.points.len(), false)?;
        for simplex in 0..self.complex.simplex_bound() as u32 {
            for interface in (0..=D).filter(|&index| self.complex.is_interface(simplex, index)) {
                for (index, &vertex) in self.complex.vertices(simplex).iter().enumerate() {
                    if index != interface && vertex != NONE {
                        is_at_rim[vertex as usize] = true;
                    }
                }
            }
        }
        Ok(is_at_rim)
    }

    /// Adds the new points of `part`, and gives them names.
    fn add_points(&mut self, partition: &Self, local_to_global: &mut LocalToGlobal) -> Result<()> {
        for point in &partition.points[local_to_global.vertices.len()..] {
            let name = self.add_point(*point)?;
            local_to_global.vertices.try_push(name)?;
        }
        Ok(())
    }

    /// See [`crate::complex::Complex::join`]; new vertices get their names here.
    pub fn join(
        &mut self,
        partition: Self,
        local_to_global: &mut LocalToGlobal,
        mut tick: impl FnMut() -> Result<()>,
    ) -> Result<()> {
        self.add_points(&partition, local_to_global)?;
        let base = self.balls.len();
        *self.exact_fallbacks.get_mut() += partition.exact_fallbacks();
        self.complex.join(partition.complex, local_to_global, &mut tick)?;
        self.balls.absorb(partition.balls)?;
        for at in base..self.balls.len() {
            tick()?;
            if self.complex.is_live(at as u32) {
                self.balls[at] = renamed(&self.balls[at], &local_to_global.vertices);
            }
        }
        Ok(())
    }

    /// See [`crate::complex::Complex::replace_joined`].
    pub fn replace_joined(
        &mut self,
        moved: &[u32],
        tick: impl FnMut() -> Result<()>,
    ) -> Result<()> {
        self.complex.replace_joined(moved, tick)
    }
}

/// `ball` with the name of its anchor in place of its id.
fn renamed<const D: usize>(ball: &Circumball<D>, local_to_global: &[u32]) -> Circumball<D> {
    match ball.anchor {
        NONE => *ball,
        anchor => ball.anchored(local_to_global[anchor as usize]),
    }
}
