//! Pieces: simplices of one side that are connected across facets, and the interfaces between two
//! of them. What no vertices support is no part of the surface: what outliers enclose, and slivers.

use super::forest::SignedForest;
use super::poles::Poles;
use crate::memory::{AllocResult, Lists, TryGrow, collected, filled};
use crate::mesh::{NONE, Triangulation};

/// The pieces of a solid and of the space around it.
struct Pieces {
    /// Simplex -> its piece.
    of: Vec<u32>,
    count: usize,
}

/// The facets between two pieces.
#[derive(Clone, Copy, Default)]
struct Interface {
    pieces: [u32; 2],
    /// Number of vertices of its facets.
    vertices: u32,
    /// Sum of the agreements of those vertices whose poles are in the two pieces.
    support: f64,
}

/// The piece of all that is beyond the hull.
const OUTERMOST: u32 = 0;

/// Least support of an interface a vertex. Below 0.4 layers between outliers stay, above 0.5 noisy
/// surfaces go.
pub const LEAST_SUPPORT: f64 = 0.45;

/// Makes the pieces on both sides of an interface one where its vertices do not support it, until
/// all that are left are supported. Of interfaces that contradict each other those of more vertices
/// count. A vertex supports that between its poles, by its agreement.
/// O(simplices) a sweep; a sweep makes one piece of several.
pub fn settle(
    mesh: &Triangulation,
    stars: &Lists,
    poles: &[Poles],
    agreements: &[f64],
    is_inside: &mut [bool],
) -> AllocResult<()> {
    let mut last = usize::MAX;
    loop {
        let pieces = Pieces::new(mesh, is_inside)?;
        let interfaces = pieces.interfaces(mesh, stars, poles, agreements)?;
        // Interfaces that contradict others could turn the same pieces for ever.
        if pieces.count >= last || interfaces.iter().all(Interface::is_supported) {
            return Ok(());
        }
        last = pieces.count;
        let mut forest = SignedForest::new(pieces.count)?;
        for interface in &interfaces {
            let [here, there] = interface.pieces;
            forest.join(here, there, interface.is_supported());
        }
        let (_, outside) = forest.side(OUTERMOST);
        for (is_inside, &piece) in is_inside.iter_mut().zip(&pieces.of) {
            *is_inside = forest.side(piece).1 != outside;
        }
    }
}

impl Interface {
    fn is_supported(&self) -> bool {
        self.support >= LEAST_SUPPORT * f64::from(self.vertices)
    }
}

impl Pieces {
    fn new(mesh: &Triangulation, is_inside: &[bool]) -> AllocResult<Self> {
        let mut pieces = Self { of: filled(is_inside.len(), NONE)?, count: 1 };
        let mut stack = Vec::new();
        let corners = mesh.dim + 1;
        for (at, _) in mesh.neighbors.iter().enumerate().filter(|(_, other)| **other == NONE) {
            pieces.begin((at / corners) as u32, OUTERMOST, !is_inside[at / corners], &mut stack)?;
        }
        pieces.grow(mesh, is_inside, &mut stack)?;
        for simplex in 0..is_inside.len() as u32 {
            let piece = pieces.count as u32;
            if pieces.begin(simplex, piece, true, &mut stack)? {
                pieces.count += 1;
                pieces.grow(mesh, is_inside, &mut stack)?;
            }
        }
        Ok(pieces)
    }

    /// Puts a simplex into a piece if it is in none and `may` be in it; true if it is new there.
    fn begin(
        &mut self,
        simplex: u32,
        piece: u32,
        may: bool,
        stack: &mut Vec<u32>,
    ) -> AllocResult<bool> {
        let is_new = may && self.of[simplex as usize] == NONE;
        if is_new {
            self.of[simplex as usize] = piece;
            stack.try_push(simplex)?;
        }
        Ok(is_new)
    }

    /// Adds to the pieces of the simplices on the stack all that are connected with them.
    fn grow(
        &mut self,
        mesh: &Triangulation,
        is_inside: &[bool],
        stack: &mut Vec<u32>,
    ) -> AllocResult<()> {
        while let Some(simplex) = stack.pop() {
            let (simplex, piece) = (simplex as usize, self.of[simplex as usize]);
            for &other in mesh.neighbors_of(simplex).iter().filter(|other| **other != NONE) {
                let may = is_inside[other as usize] == is_inside[simplex];
                self.begin(other, piece, may, stack)?;
            }
        }
        Ok(())
    }

    fn of(&self, simplex: u32) -> u32 {
        if simplex == NONE { OUTERMOST } else { self.of[simplex as usize] }
    }

    /// Returns the interfaces, those with the most vertices first.
    fn interfaces(
        &self,
        mesh: &Triangulation,
        stars: &Lists,
        poles: &[Poles],
        agreements: &[f64],
    ) -> AllocResult<Vec<Interface>> {
        // An entry for each vertex of each interface.
        let (mut entries, mut met) = (Vec::new(), Vec::new());
        for vertex in 0..poles.len() {
            met.clear();
            self.meet(mesh, stars.of(vertex), vertex as u32, &mut met)?;
            met.sort_unstable();
            met.dedup();
            let supported = self.ordered(poles[vertex].first, poles[vertex].second);
            for &pieces in &met {
                let is_supported = poles[vertex].second != NONE && pieces == supported;
                let support = if is_supported { agreements[vertex] } else { 0.0 };
                entries.try_push((pieces, vertex, support))?;
            }
        }
        entries.sort_unstable_by_key(|&(pieces, vertex, _)| (pieces, vertex));
        let sum = |entries: &[([u32; 2], usize, f64)]| Interface {
            pieces: entries[0].0,
            vertices: entries.len() as u32,
            support: entries.iter().map(|entry| entry.2).sum(),
        };
        let same = entries.chunk_by(|a, b| a.0 == b.0);
        let mut interfaces = collected(same.map(sum))?;
        interfaces.sort_unstable_by_key(|interface| {
            (std::cmp::Reverse(interface.vertices), interface.pieces)
        });
        Ok(interfaces)
    }

    /// Adds the pieces on both sides of each facet that a vertex has, where they differ.
    fn meet(
        &self,
        mesh: &Triangulation,
        star: &[u32],
        vertex: u32,
        met: &mut Vec<[u32; 2]>,
    ) -> AllocResult<()> {
        for &simplex in star {
            let vertices = mesh.simplex(simplex as usize);
            for (corner, &other) in vertices.iter().zip(mesh.neighbors_of(simplex as usize)) {
                let pieces = self.ordered(simplex, other);
                if *corner != vertex && pieces[0] != pieces[1] {
                    met.try_push(pieces)?;
                }
            }
        }
        Ok(())
    }

    /// Returns the pieces of two simplices, ascending.
    fn ordered(&self, a: u32, b: u32) -> [u32; 2] {
        let (a, b) = (self.of(a), self.of(b));
        [a.min(b), a.max(b)]
    }
}
