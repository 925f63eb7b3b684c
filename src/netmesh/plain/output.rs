//! The arrays of the result: finite triangles, with the vertices in the caller's order.

use super::triangles::{INFINITE, Triangle, Triangles, next};
use crate::error::Result;
use crate::memory::{TryGrow, filled, with_capacity};
use crate::mesh::{Boundary, Inputs, NONE, Stats, Triangulation, VertexKind};
use crate::netmesh::state::order::InputId;
use crate::netmesh::state::watch::Watch;
use crate::options::Phase;
use crate::parameters::Parameters;
use std::time::Instant;

/// Returns the result of a run that began at `begun`. `order`: the input that each vertex is.
pub(super) fn triangulation(
    inputs: &Inputs,
    order: &[InputId],
    triangles: &Triangles,
    parameters: Parameters,
    mut stats: Stats,
    (begun, watch): (Instant, &mut Watch<'_, '_>),
) -> Result<Triangulation> {
    let count = inputs.distinct();
    let mut numbers = filled(triangles.count(), NONE)?;
    let mut finite = 0;
    for (number, triangle) in numbers.iter_mut().zip(triangles.all()) {
        if !triangle.corners.contains(&INFINITE) {
            *number = finite;
            finite += 1;
        }
    }
    watch.note(Phase::Export, 1.0, [count as u64, count as u64, u64::from(finite)]);
    watch.report()?;
    let rows = 3 * finite as usize;
    let (mut simplices, mut neighbors) = (with_capacity(rows)?, with_capacity(rows)?);
    for (&number, Triangle { corners, twins }) in numbers.iter().zip(triangles.all()) {
        watch.poll_after(1)?;
        if number != NONE {
            simplices.extend(corners.map(|corner| order[corner as usize].index() as u32));
            // The neighbour opposite a corner is beyond the edge after it.
            let opposite = |corner: u32| numbers[(twins[next(corner) as usize] / 3) as usize];
            neighbors.extend([0, 1, 2].map(opposite));
        }
    }
    let mut points = with_capacity(2 * count)?;
    for input in 0..count {
        watch.poll_after(1)?;
        points.try_extend(inputs.distinct_point(input))?;
    }
    stats.input_vertices = count as u64;
    stats.seconds = begun.elapsed().as_secs_f64();
    Ok(Triangulation {
        dim: 2,
        points,
        simplices,
        neighbors,
        kinds: filled(count, VertexKind::Input)?,
        vertex_domains: filled(count, NONE)?,
        cage_of: filled(count, NONE)?,
        domains: Vec::new(),
        precision_limited: filled(count, false)?,
        below_min_dihedral: Vec::new(),
        boundary: Boundary::default(),
        sizes: Vec::new(),
        beyond_bound: Vec::new(),
        parameters,
        stats,
    })
}
