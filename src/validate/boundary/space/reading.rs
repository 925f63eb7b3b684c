//! Facets and segments are read as given or as split. If crossings are split, what is nearer than
//! roundings may have become one, or not: a plate of some units in the last place may stay as it
//! is, beside others that were split. So each facet and segment is first read as given: it goes
//! through none of the inputs that others have, and roundings excuse nothing. Where all holds no
//! more is to ask; the others are read as split.

use super::super::Outline;
use super::faces::Faces;
use crate::memory::{AllocResult, filled};
use crate::mesh::Inputs;
use crate::quality::view::View;

#[derive(Default)]
pub(in crate::validate) struct Reading {
    /// Vertex -> true if nothing that is read as given bends through it: a facet or segment has it,
    /// or edges of a box meet there.
    pub is_firm: Vec<bool>,
    /// Facet -> true if it is read as split.
    pub facets: Vec<bool>,
    /// Segment -> true if it is read as split.
    pub segments: Vec<bool>,
}

impl Reading {
    /// Returns the reading of all facets and segments as given.
    pub(super) fn as_given(
        inputs: &Inputs,
        outline: Option<Outline<'_>>,
        view: View<'_, 3>,
        faces: &Faces,
    ) -> AllocResult<Self> {
        let mut is_firm = filled(view.vertex_count(), false)?;
        for (vertex, is_firm) in is_firm.iter_mut().enumerate().skip(inputs.distinct()) {
            *is_firm = faces.at.of(vertex).len() > 2;
        }
        let Some(Outline { segments, facets, .. }) = outline else {
            return Ok(Self { is_firm, ..Self::default() });
        };
        for &input in segments.inputs.as_flattened().iter().chain(&facets.inputs) {
            let vertex = inputs.vertices().get(input as usize);
            if let Some(is_firm) = vertex.and_then(|&vertex| is_firm.get_mut(vertex as usize)) {
                *is_firm = true;
            }
        }
        let facets = filled(facets.count(), false)?;
        Ok(Self { is_firm, facets, segments: filled(segments.count(), false)? })
    }

    /// Returns true if any facet or segment is read as split.
    pub fn splits_any(&self) -> bool {
        self.facets.contains(&true) || self.segments.contains(&true)
    }
}
