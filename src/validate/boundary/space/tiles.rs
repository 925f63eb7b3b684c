//! The subfacets that a facet consists of. If crossings are split, facets that share an area have
//! its subfacets in common: those of the first, which the others borrow. They are found by leading
//! on from the rim of the facet and from its own subfacets; [`super::tiling`] checks that all of
//! them tile the facet, so that nothing is taken on trust.
//!
//! Triangles that are folded over each other in one plane are one facet too, which has a subfacet
//! there as many times as its rim winds about it.

use super::directions::sine_of_half;
use super::given::Facet;
use super::plane::{AreaVector, Slab};
use super::tiling::{Edge, range};
use super::ways::Ways;
use crate::memory::{AllocResult, TryGrow, collected};
use crate::validate::signs::{Robust, Signs};
use std::cmp::Ordering;

/// Largest number of times that a facet may have a subfacet.
const MOST_TIMES: i64 = 64;

/// Subfacet of a facet.
#[derive(Clone, Copy)]
pub(super) struct Tile {
    pub subfacet: u32,
    /// Vertices, which turn as the facet does.
    pub vertices: [u32; 3],
    /// True if it turns the other way round in the mesh.
    pub is_turned: bool,
    /// Number of times that the facet has it.
    pub times: i64,
}

/// Returns the tiles of a facet that ends at `rim`, its own subfacets first.
pub(super) fn tiles(facet: &Facet, rim: &[Edge], ways: &mut Ways<'_>) -> AllocResult<Vec<Tile>> {
    let boundary = &ways.view.mesh.boundary;
    let own = range(ways.view, facet.parent).map(|subfacet| Tile {
        subfacet: subfacet as u32,
        vertices: boundary.subfacets[subfacet],
        is_turned: false,
        times: 1,
    });
    let mut tiles: Vec<Tile> = collected(own)?;
    if ways.splits(facet.parent) {
        Search { facet, rim, slab: Slab::wide(facet, ways), waiting: Vec::new() }
            .lead_on(&mut tiles, ways)?;
    }
    Ok(tiles)
}

/// Search for the tiles that a facet borrows.
struct Search<'a> {
    facet: &'a Facet,
    /// Edges at which the facet ends; sorted.
    rim: &'a [Edge],
    slab: Slab,
    /// Edges at which the tiles on both sides may not fit the rim.
    waiting: Vec<[u32; 2]>,
}

/// Tiles beside an edge.
struct Beside {
    /// Number of times that the facet has tiles on the left, and on the right.
    times: [i64; 2],
    /// Tile on the left that the facet has, or the subfacet there that is least turned from its
    /// plane.
    left: Option<Tile>,
}

impl Search<'_> {
    /// Adds the tiles that the facet borrows.
    fn lead_on(&mut self, tiles: &mut Vec<Tile>, ways: &mut Ways<'_>) -> AllocResult<()> {
        for &(ends, _) in self.rim {
            self.waiting.try_push(ends)?;
        }
        for tile in tiles.iter() {
            ways.tile_of[tile.subfacet as usize] = (self.facet.parent, 1);
            self.wait_at(tile)?;
        }
        while let Some(edge) = self.waiting.pop() {
            if let Some(tile) = self.missing_tile(edge, ways)? {
                let (owner, times) = &mut ways.tile_of[tile.subfacet as usize];
                if *owner != self.facet.parent {
                    (*owner, *times) = (self.facet.parent, 0);
                    tiles.try_push(tile)?;
                }
                *times += tile.times;
                self.wait_at(&tile)?;
            }
        }
        tiles.iter_mut().for_each(|tile| tile.times = ways.tile_of[tile.subfacet as usize].1);
        Ok(())
    }

    fn wait_at(&mut self, tile: &Tile) -> AllocResult<()> {
        let [a, b, c] = tile.vertices;
        self.waiting.try_extend(&[[a, b], [b, c], [c, a]])
    }

    /// Returns the tile that is missing beside an edge, as many times as it is missing; `None` if
    /// the tiles there fit the rim, or if there is no subfacet for one.
    fn missing_tile(&self, [a, b]: [u32; 2], ways: &Ways<'_>) -> AllocResult<Option<Tile>> {
        let key = [a.min(b), a.max(b)];
        let own = self.rim.binary_search_by_key(&key, |edge| edge.0);
        let upwards = own.map_or(0, |at| self.rim[at].1);
        let beside = self.beside(key, ways)?;
        let missing = upwards + beside.times[1] - beside.times[0];
        let left = match missing.signum() {
            0 => return Ok(None),
            1 => beside.left,
            _ => self.beside([key[1], key[0]], ways)?.left,
        };
        let times = missing.abs();
        Ok(left.filter(|tile| tile.times + times <= MOST_TIMES).map(|tile| Tile { times, ..tile }))
    }

    /// Finds the tiles beside an edge.
    fn beside(&self, edge: [u32; 2], ways: &Ways<'_>) -> AllocResult<Beside> {
        let Facet { projection, normal, parent, .. } = self.facet;
        let view = ways.view;
        let mut signs = Signs::<Robust>::default();
        let mut found = Beside { times: [0; 2], left: None };
        let mut flattest = f64::INFINITY;
        for subfacet in ways.faces.beside(view, edge) {
            let vertices = view.mesh.boundary.subfacets[subfacet as usize];
            let Some(apex) = vertices.into_iter().find(|vertex| !edge.contains(vertex)) else {
                continue;
            };
            let corners = [edge[0], edge[1], apex];
            let [a, b, c] = corners.map(|vertex| projection.of(view.point(vertex)));
            let side = signs.orientation(&[&a, &b, &c])?;
            let (owner, times) = ways.tile_of[subfacet as usize];
            let is_own = owner == *parent;
            if is_own {
                found.times[usize::from(side == Ordering::Less)] += times;
            }
            if side != Ordering::Greater {
                continue;
            }
            let is_turned = !super::faces::is_rotated(corners, vertices);
            let times = if is_own { times } else { 0 };
            let tile = Tile { subfacet, vertices: corners, is_turned, times };
            let has_own = found.left.is_some_and(|left| left.times > 0);
            if is_own {
                found.left = Some(tile);
            } else if !has_own && self.slab.holds(normal, view.point(apex)) {
                // Small triangles that stand on the facet are within the slab, too.
                let own = AreaVector::of_triangle(corners.map(|vertex| view.point(vertex)));
                let sine = own.rounded().map_or(1.0, |(own, _)| sine_of_half(&own, normal));
                if sine < flattest {
                    (found.left, flattest) = (Some(tile), sine);
                }
            }
        }
        Ok(found)
    }
}
