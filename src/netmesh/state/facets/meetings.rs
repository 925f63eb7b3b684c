//! The places where facets meet at small angles, by facet.

use crate::complex::VertexId;
use crate::memory::{AllocResult, filled};
use crate::netmesh::state::bits::bit_of;

/// Pairs of facets that meet at small angles, and the places where they do.
#[derive(Default)]
pub(in crate::netmesh) struct Meetings {
    /// A facet, one that it meets, and where: every pair either way round, sorted.
    all: Vec<(u32, u32, Meeting)>,
    /// Facet -> the first of its meetings, and one more.
    starts: Vec<usize>,
    /// Facet -> the bits of the facets that it meets.
    bits: Vec<u64>,
    /// First vertices -> the tiny angles there.
    tiny_angles: Vec<TinyAngles>,
}

/// Place where two facets meet.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::netmesh) enum Meeting {
    Line(u32),
    Vertex(VertexId),
}

/// Angles of some degrees between facets that meet at a vertex, and at no line there.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(in crate::netmesh) enum TinyAngles {
    None,
    /// Facets are between those that have one.
    InFans,
    /// Nothing of the surface is between some.
    OfFins,
}

impl Meetings {
    /// Takes the places where so many facets meet: every pair either way round, sorted, some of
    /// them several times.
    pub fn new(
        facets: usize,
        mut all: Vec<(u32, u32, Meeting)>,
        tiny_angles: Vec<TinyAngles>,
    ) -> AllocResult<Self> {
        all.dedup();
        let mut starts = filled(facets + 1, 0)?;
        let mut count = 0;
        for (facet, start) in (0u32..).zip(&mut starts) {
            let before = all[count..].iter().take_while(|&&(own, ..)| own < facet);
            count += before.count();
            *start = count;
        }
        let mut bits = filled(facets, 0)?;
        for &(own, met, _) in &all {
            bits[own as usize] |= bit_of(met);
        }
        Ok(Self { all, starts, bits, tiny_angles })
    }

    /// Returns the places where a facet meets others.
    #[inline]
    pub fn of(&self, facet: u32) -> MeetingsOf<'_> {
        let at = facet as usize;
        match self.starts.get(at..at + 2) {
            Some(range) => MeetingsOf { all: &self.all[range[0]..range[1]], bits: self.bits[at] },
            None => MeetingsOf { all: &[], bits: 0 },
        }
    }

    /// Returns the tiny angles between facets that meet at a vertex, and at no line there.
    pub fn tiny_angles_at(&self, vertex: VertexId) -> TinyAngles {
        self.tiny_angles.get(vertex.index()).copied().unwrap_or(TinyAngles::None)
    }
}

/// The meetings of one facet.
#[derive(Clone, Copy)]
pub(in crate::netmesh) struct MeetingsOf<'a> {
    all: &'a [(u32, u32, Meeting)],
    /// Bits of the facets that it meets.
    bits: u64,
}

impl<'a> MeetingsOf<'a> {
    #[inline]
    pub fn is_empty(self) -> bool {
        self.all.is_empty()
    }

    /// Returns the places where the facet meets another one.
    #[inline]
    pub fn with(self, other: u32) -> impl Iterator<Item = Meeting> + 'a {
        // Most facets do not meet.
        let all = if self.bits & bit_of(other) == 0 { &[] } else { self.all };
        let first = all.partition_point(|&(_, met, _)| met < other);
        let own = all[first..].iter().take_while(move |&&(_, met, _)| met == other);
        own.map(|&(.., at)| at)
    }
}
