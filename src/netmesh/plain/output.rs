//! The arrays of the result.

use crate::error::Result;
use crate::memory::{TryGrow, filled, with_capacity};
use crate::mesh::{Boundary, Inputs, NONE, Stats, Triangulation, VertexKind};
use crate::netmesh::state::watch::Watch;
use crate::options::Phase;
use crate::parameters::Parameters;
use std::time::Instant;

/// Finite simplices, by the inputs at their corners, and their neighbours opposite these.
pub(super) struct Simplices {
    pub vertices: Vec<u32>,
    pub neighbors: Vec<u32>,
}

/// Returns the result of a run that began at `begun`.
pub(super) fn triangulation(
    inputs: &Inputs,
    simplices: Simplices,
    parameters: Parameters,
    mut stats: Stats,
    (begun, watch): (Instant, &mut Watch<'_, '_>),
) -> Result<Triangulation> {
    let (dim, count) = (inputs.dim(), inputs.distinct());
    let Simplices { vertices, neighbors } = simplices;
    let made = (vertices.len() / (dim + 1)) as u64;
    watch.note(Phase::Export, 1.0, [count as u64, count as u64, made]);
    watch.report()?;
    let mut points = with_capacity(dim * count)?;
    for input in 0..count {
        watch.poll_after(1)?;
        points.try_extend(inputs.distinct_point(input))?;
    }
    stats.input_vertices = count as u64;
    stats.seconds = begun.elapsed().as_secs_f64();
    Ok(Triangulation {
        dim,
        points,
        simplices: vertices,
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
