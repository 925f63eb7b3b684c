//! The subfacets that a facet consists of. If crossings are split, facets that share an area have
//! its subfacets in common: those of the first, which the others borrow. They are found by leading
//! on from the rim of the facet and from its own subfacets; [`super::tiling`] checks that all of
//! them tile the facet, so that nothing is taken on trust.

use super::given::Facet;
use super::plane::Slab;
use super::tiling::{Directed, directed, range};
use super::ways::Ways;
use crate::memory::{AllocResult, TryGrow, collected};
use crate::validate::signs::{Robust, Signs};
use std::cmp::Ordering;

/// Subfacet of a facet.
#[derive(Clone, Copy)]
pub(super) struct Tile {
    pub subfacet: u32,
    /// Vertices, which turn as the facet does.
    pub vertices: [u32; 3],
    /// True if it turns the other way round in the mesh.
    pub is_turned: bool,
}

/// Returns the tiles of a facet that ends at `rim`, its own subfacets first.
pub(super) fn tiles(
    facet: &Facet,
    rim: &[Directed],
    ways: &mut Ways<'_>,
) -> AllocResult<Vec<Tile>> {
    let boundary = &ways.view.mesh.boundary;
    let own = range(ways.view, facet.parent).map(|subfacet| Tile {
        subfacet: subfacet as u32,
        vertices: boundary.subfacets[subfacet],
        is_turned: false,
    });
    let mut tiles: Vec<Tile> = collected(own)?;
    if ways.splits_crossings() {
        Search { facet, rim, slab: Slab::wide(facet, ways), waiting: Vec::new() }
            .lead_on(&mut tiles, ways)?;
    }
    Ok(tiles)
}

/// Search for the tiles that a facet borrows.
struct Search<'a> {
    facet: &'a Facet,
    /// Edges at which the facet ends, which is on their left; sorted.
    rim: &'a [Directed],
    slab: Slab,
    /// Edges on the left of which the facet has a tile.
    waiting: Vec<[u32; 2]>,
}

impl Search<'_> {
    /// Adds the tiles that the facet borrows.
    fn lead_on(&mut self, tiles: &mut Vec<Tile>, ways: &mut Ways<'_>) -> AllocResult<()> {
        for &(ends, is_upwards) in self.rim {
            let [a, b] = ends;
            self.waiting.try_push(if is_upwards { [a, b] } else { [b, a] })?;
        }
        for tile in tiles.iter() {
            ways.tile_of[tile.subfacet as usize] = self.facet.parent;
            self.wait_beyond(tile)?;
        }
        while let Some(edge) = self.waiting.pop() {
            if let Some(tile) = self.tile_beside(edge, ways)? {
                ways.tile_of[tile.subfacet as usize] = self.facet.parent;
                self.wait_beyond(&tile)?;
                tiles.try_push(tile)?;
            }
        }
        Ok(())
    }

    /// Waits for the tiles beyond the edges of one.
    fn wait_beyond(&mut self, tile: &Tile) -> AllocResult<()> {
        let [a, b, c] = tile.vertices;
        for edge in [[a, b], [b, c], [c, a]] {
            if self.rim.binary_search(&directed(edge)).is_err() {
                self.waiting.try_push([edge[1], edge[0]])?;
            }
        }
        Ok(())
    }

    /// Returns the subfacet on the left of an edge that is nearest to the plane of the facet, if
    /// the facet has no tile there yet.
    fn tile_beside(&self, edge: [u32; 2], ways: &Ways<'_>) -> AllocResult<Option<Tile>> {
        let Facet { projection, normal, parent, .. } = self.facet;
        let view = ways.view;
        let mut signs = Signs::<Robust>::default();
        let mut best: Option<(Tile, u32)> = None;
        for subfacet in ways.faces.beside(view, edge) {
            let vertices = view.mesh.boundary.subfacets[subfacet as usize];
            let Some(apex) = vertices.into_iter().find(|vertex| !edge.contains(vertex)) else {
                continue;
            };
            let corners = [edge[0], edge[1], apex];
            let [a, b, c] = corners.map(|vertex| projection.of(view.point(vertex)));
            if signs.orientation(&[&a, &b, &c])? != Ordering::Greater {
                continue;
            }
            if ways.tile_of[subfacet as usize] == *parent {
                return Ok(None);
            }
            let is_turned = super::faces::is_rotated(corners, vertices);
            let tile = Tile { subfacet, vertices: corners, is_turned: !is_turned };
            let is_nearer =
                |other: u32| self.slab.is_nearer(normal, [apex, other].map(|v| view.point(v)));
            if self.slab.holds(normal, view.point(apex))
                && best.is_none_or(|(_, other)| is_nearer(other))
            {
                best = Some((tile, apex));
            }
        }
        Ok(best.map(|(tile, _)| tile))
    }
}
