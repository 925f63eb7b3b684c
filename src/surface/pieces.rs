//! Pieces: simplices of one side that are connected across facets. A piece that its vertices do not
//! support is no part of the solid, nor a void in it: what outliers enclose, and slivers.

use super::poles::Poles;
use crate::memory::{AllocResult, Lists, TryGrow, collected, filled};
use crate::mesh::{NONE, Triangulation};

/// The pieces of a solid and of the space around it.
struct Pieces {
    /// Simplex -> its piece.
    of: Vec<u32>,
    count: usize,
}

/// The piece of all that is beyond the hull.
const OUTERMOST: u32 = 0;

/// Gives pieces that less than half of their vertices support to the side around them, until all
/// are supported. A vertex supports the pieces of its poles, if these are on different sides.
/// O(simplices) a sweep; a sweep makes one piece of several.
pub fn settle(
    mesh: &Triangulation,
    stars: &Lists,
    poles: &[Poles],
    is_inside: &mut [bool],
) -> AllocResult<()> {
    loop {
        let pieces = Pieces::new(mesh, is_inside)?;
        let doubtful = pieces.doubtful(mesh, stars, poles, is_inside)?;
        if doubtful.iter().all(|doubtful| !doubtful) {
            return Ok(());
        }
        for (is_inside, &piece) in is_inside.iter_mut().zip(&pieces.of) {
            *is_inside ^= doubtful[piece as usize];
        }
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

    /// Returns for each piece whether it goes to the other side in this sweep: it is not supported,
    /// and none of its neighbours goes, which count before it if they have fewer vertices on their
    /// boundary.
    fn doubtful(
        &self,
        mesh: &Triangulation,
        stars: &Lists,
        poles: &[Poles],
        is_inside: &[bool],
    ) -> AllocResult<Vec<bool>> {
        let (mut vertices, mut supporters) = (filled(self.count, 0u32)?, filled(self.count, 0u32)?);
        let mut met = Vec::new();
        for (vertex, poles) in poles.iter().enumerate() {
            let star = stars.of(vertex);
            met.clear();
            met.try_extend(&[self.of(poles.first)])?;
            star.iter().try_for_each(|&simplex| met.try_push(self.of(simplex)))?;
            met.sort_unstable();
            met.dedup();
            if met.len() > 1 {
                met.iter().for_each(|&piece| vertices[piece as usize] += 1);
            }
            let is_in = |simplex: u32| simplex != NONE && is_inside[simplex as usize];
            if poles.second != NONE && is_in(poles.first) != is_in(poles.second) {
                supporters[self.of(poles.first) as usize] += 1;
                supporters[self.of(poles.second) as usize] += 1;
            }
        }
        let mut doubtful = filled(self.count, false)?;
        let mut stays = filled(self.count, false)?;
        stays[OUTERMOST as usize] = true;
        let neighbors = self.neighbors(mesh)?;
        let mut order = collected(0..self.count as u32)?;
        order.sort_unstable_by_key(|&piece| (vertices[piece as usize], piece));
        for piece in order.into_iter().map(|piece| piece as usize) {
            if !stays[piece] && 2 * supporters[piece] < vertices[piece] {
                doubtful[piece] = true;
                neighbors.of(piece).iter().for_each(|&other| stays[other as usize] = true);
            }
        }
        Ok(doubtful)
    }

    /// Returns for each piece the pieces on the other side of its facets.
    fn neighbors(&self, mesh: &Triangulation) -> AllocResult<Lists> {
        let corners = mesh.dim + 1;
        Lists::of_pairs(self.count, || {
            let sides = mesh.neighbors.iter().enumerate();
            let pieces = sides.map(|(at, &other)| (self.of[at / corners], self.of(other)));
            // The piece beyond the hull has no simplices there that could name it.
            pieces.filter(|(here, there)| here != there)
        })
    }
}
