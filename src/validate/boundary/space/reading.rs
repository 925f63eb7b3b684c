//! Facets and segments are read as given or as split. If crossings are split, what is nearer than
//! roundings may have become one, or not: a plate of some units in the last place may stay as it
//! is, beside others that were split. So each facet and segment is first read as given: it goes
//! through none of the inputs that others have, and roundings excuse nothing. Where all holds no
//! more is to ask; the others are read as split.

use super::super::Outline;
use crate::memory::{AllocResult, filled};
use crate::mesh::Inputs;

pub(in crate::validate) struct Reading {
    /// Distinct input -> true if a facet or segment has it: nothing that is read as given bends
    /// through it.
    pub is_held: Vec<bool>,
    /// Facet -> true if it is read as split.
    pub facets: Vec<bool>,
    /// Segment -> true if it is read as split.
    pub segments: Vec<bool>,
}

impl Reading {
    /// Returns the reading of all facets and segments as given.
    pub fn as_given(inputs: &Inputs, outline: Option<Outline<'_>>) -> AllocResult<Self> {
        let mut is_held = filled(inputs.distinct(), false)?;
        let Some(Outline { segments, facets, .. }) = outline else {
            return Ok(Self { is_held, facets: Vec::new(), segments: Vec::new() });
        };
        for &input in segments.inputs.as_flattened().iter().chain(&facets.inputs) {
            let vertex = inputs.vertices().get(input as usize);
            if let Some(is_held) = vertex.and_then(|&vertex| is_held.get_mut(vertex as usize)) {
                *is_held = true;
            }
        }
        let facets = filled(facets.count(), false)?;
        Ok(Self { is_held, facets, segments: filled(segments.count(), false)? })
    }

    /// Returns true if any facet or segment is read as split.
    pub fn splits_any(&self) -> bool {
        self.facets.contains(&true) || self.segments.contains(&true)
    }
}
