//! Sizes below which nothing of a sharp facet or line is split for a simplex at no small angle.
//! While refinement goes on a simplex may ask for a split only of what is about as large as itself:
//! without that guard small pieces ask for smaller ones for ever beside small angles. What it
//! leaves bad at no small angle may ask once more at the end, for all but what is much smaller than
//! everything there was. So it ends, since no vertex comes nearer to others than that.

use crate::memory::{AllocResult, filled};

/// Size of the smallest part that is split, relative to the smallest one of its facet or line.
const FLOOR: f64 = 0.25;

/// A guard: the sizes of parts of the boundary that may be split.
#[derive(Clone, Copy)]
pub(in crate::netmesh) enum Guard {
    /// All of them, as recovery does.
    Open,
    /// None smaller than this.
    Usual { least: f64 },
    /// None smaller than both this and the floor of its facet or line.
    Low { least: f64 },
    /// None smaller than this, whatever angles are near.
    Sized { least: f64 },
}

/// Promise for which a simplex asks for a Steiner point.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(in crate::netmesh) enum Purpose {
    Bound,
    Size,
}

/// Facet or line -> the size below which its parts are not split; infinite while there is none.
#[derive(Default)]
pub(in crate::netmesh) struct Floors {
    facets: Vec<f64>,
    lines: Vec<f64>,
}

impl Guard {
    /// Returns true if a part of the boundary of a size, with its floor, may be split.
    pub fn admits(self, size: f64, floor: f64) -> bool {
        match self {
            Self::Open => true,
            Self::Usual { least } | Self::Sized { least } => size >= least,
            Self::Low { least } => size >= least.min(floor),
        }
    }
}

impl Floors {
    /// Makes floors for numbers of facets and lines, with no parts yet.
    pub fn new(facets: usize, lines: usize) -> AllocResult<Self> {
        let [facets, lines] = [filled(facets, f64::INFINITY)?, filled(lines, f64::INFINITY)?];
        Ok(Self { facets, lines })
    }

    pub fn are_set(&self) -> bool {
        !self.facets.is_empty()
    }

    /// Returns the radius below which no subfacet of a facet is split for a simplex.
    pub fn of_facet(&self, facet: u32) -> f64 {
        self.facets.get(facet as usize).copied().unwrap_or(f64::INFINITY)
    }

    /// Returns the length below which no half of a subsegment of a line is made for a simplex.
    pub fn of_line(&self, line: u32) -> f64 {
        self.lines.get(line as usize).copied().unwrap_or(f64::INFINITY)
    }

    pub fn note_subfacet(&mut self, facet: u32, radius: f64) {
        let floor = &mut self.facets[facet as usize];
        *floor = floor.min(FLOOR * radius);
    }

    pub fn note_subsegment(&mut self, line: u32, half: f64) {
        let floor = &mut self.lines[line as usize];
        *floor = floor.min(FLOOR * half);
    }
}
