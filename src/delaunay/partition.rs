//! A partition of a Delaunay complex, which is refined apart from the rest. Insertions leave the
//! simplices at its interface unchanged. Those are then Delaunay on both sides, and so is every
//! facet when all partitions have joined. A complex that is Delaunay at every facet is Delaunay.

use super::Delaunay;
use crate::complex::{LocalToGlobal, PartitionIds, SimplexId, VertexId};
use crate::error::Result;
use crate::memory::{AllocResult, Array, TryGrow, collected, filled};
use crate::numerics::RoundedBall;

/// Memory in which the simplices of a partition grow.
pub(crate) struct Reserve<const D: usize> {
    records: Array<u32>,
    balls: Array<RoundedBall<D>>,
}

impl<const D: usize> Delaunay<D> {
    /// Extracts a partition with its points and D-balls: see
    /// [`crate::complex::Complex::partition`].
    pub fn partition(
        &self,
        ids: &mut PartitionIds<'_>,
        mut tick: impl FnMut() -> Result<()>,
    ) -> Result<Self> {
        let complex = self.complex.partition(ids, &mut tick)?;
        let local_to_global = &ids.local_to_global;
        let mut points = Array::with_capacity(local_to_global.vertices.len())?;
        for &vertex in &local_to_global.vertices {
            tick()?;
            points.try_push(*self.point(vertex))?;
        }
        let mut turns = Array::with_capacity(points.len())?;
        for &vertex in &local_to_global.vertices {
            tick()?;
            turns.try_push(self.turns[vertex])?;
        }
        let mut balls = Array::with_capacity(local_to_global.simplices.len())?;
        for &simplex in &local_to_global.simplices {
            tick()?;
            balls.try_push(self.balls[simplex])?;
        }
        Ok(Self {
            complex,
            points,
            balls,
            turns,
            last_turn: self.last_turn,
            exact_fallbacks: 0.into(),
            simplices_created: 0,
        })
    }

    /// Returns the number of simplices that fit in the spare memory.
    pub fn spare_simplices(&self) -> usize {
        self.balls.spare().min(self.complex.spare_simplices())
    }

    /// Moves the simplices and their D-balls to `reserve`, which must be empty.
    pub fn move_to(&mut self, reserve: Reserve<D>) -> AllocResult<()> {
        self.complex.move_to(reserve.records)?;
        self.balls.move_into(reserve.balls)
    }

    /// Splits the spare memory: `reserves` has the number of simplices of each share. Returns
    /// `None` if there is not enough.
    pub fn split_reserve(&mut self, reserves: &[usize]) -> Option<Vec<Reserve<D>>> {
        let records = self.complex.split_reserve(reserves)?;
        let balls = self.balls.split_reserve(reserves)?;
        let reserve = |(records, balls)| Reserve { records, balls };
        collected(records.into_iter().zip(balls).map(reserve)).ok()
    }

    /// Returns for each vertex of a partition true if the global mesh has simplices at it that the
    /// partition lacks. Then the vertex is on a facet of the interface.
    pub fn interface_vertices(&self) -> Result<Vec<bool>> {
        let mut is_at_interface = filled(self.points.len(), false)?;
        for simplex in self.complex.simplices() {
            for interface in (0..=D).filter(|&index| self.complex.is_interface(simplex, index)) {
                for (index, &vertex) in self.complex.vertices(simplex).iter().enumerate() {
                    if index != interface && vertex != VertexId::INFINITE {
                        is_at_interface[vertex] = true;
                    }
                }
            }
        }
        Ok(is_at_interface)
    }

    /// Adds the new points of `partition`, and gives them global ids.
    fn add_points(&mut self, partition: &Self, local_to_global: &mut LocalToGlobal) -> Result<()> {
        for point in &partition.points[local_to_global.vertices.len()..] {
            let vertex = self.add_point(*point)?;
            local_to_global.vertices.try_push(vertex)?;
        }
        // A vertex that is in several partitions was inserted before they were extracted.
        for (&vertex, &turn) in local_to_global.vertices.iter().zip(&partition.turns) {
            self.turns[vertex] = self.turns[vertex].max(turn);
        }
        self.last_turn = self.last_turn.max(partition.last_turn);
        Ok(())
    }

    /// Joins a partition with its D-balls, and gives its new vertices global ids: see
    /// [`crate::complex::Complex::join`].
    pub fn join(
        &mut self,
        partition: Self,
        local_to_global: &mut LocalToGlobal,
        mut tick: impl FnMut() -> Result<()>,
    ) -> Result<()> {
        self.add_points(&partition, local_to_global)?;
        *self.exact_fallbacks.get_mut() += partition.exact_fallbacks();
        self.simplices_created += partition.simplices_created;
        self.complex.join(partition.complex, local_to_global, &mut tick)?;
        self.balls.absorb(partition.balls)?;
        Ok(())
    }

    /// Links joined partitions at their interfaces: see
    /// [`crate::complex::Complex::replace_joined`].
    pub fn replace_joined(
        &mut self,
        moved: &[SimplexId],
        tick: impl FnMut() -> Result<()>,
    ) -> Result<()> {
        self.complex.replace_joined(moved, tick)
    }
}
