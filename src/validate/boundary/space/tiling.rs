//! Level 2: the subfacets of a facet tile it. In the exact projection along an axis all of them
//! turn to the left; each edge is in two of them, which run through it in opposite directions, or
//! on the rim of the facet; and there the facet is on the left, as its loops say. So the number of
//! subfacets over a point, which is the winding number of the rim about it, is 1 inside and 0
//! outside; or more, where triangles of the facet are folded over each other. The sum of their
//! areas is that of the polygon, but for roundings of vertices on its edges.

use super::super::chains::BENT;
use super::super::rims::Keep;
use super::super::sum::Sum;
use super::faces::Faces;
use super::given::{Facet, Projection};
use super::plane::{self, largest_axis};
use super::tiles::{self, Tile};
use super::ways::Ways;
use crate::error::message;
use crate::memory::{AllocResult, TryGrow, collected};
use crate::mesh::NONE;
use crate::quality::view::View;
use crate::validate::report::{Findings, Violation, ViolationKind};
use crate::validate::signs::{Robust, Signs};
use std::borrow::Cow;
use std::cmp::Ordering;
use std::ops::Range;

/// Edge by its ends, the lower first, and true if it runs from there.
pub(super) type Directed = ([u32; 2], bool);

/// Edge at which a facet ends, by its ends, the lower first, and how many times more the facet is
/// on its left, seen from there, than on its right.
pub(super) type Edge = ([u32; 2], i64);

/// Rim and tiles of a facet.
pub(super) struct Tiled {
    /// Subsegments along its edges, sorted.
    rim: Vec<Edge>,
    /// True if chains lead along all edges.
    is_whole: bool,
    pub tiles: Vec<Tile>,
    /// True if chains may go round an edge that others have.
    goes_round: bool,
}

/// Returns the words for a facet, or for the boundary of an extent.
pub(super) fn name_of(facet: u32) -> Cow<'static, str> {
    match facet {
        NONE => "the boundary of the extent".into(),
        facet => message!("facet {facet}").into(),
    }
}

pub(super) fn directed([a, b]: [u32; 2]) -> Directed {
    ([a.min(b), a.max(b)], a < b)
}

/// Returns the subfacets of a facet.
pub(super) fn range(view: View<'_, 3>, parent: u32) -> Range<usize> {
    let parents = &view.mesh.boundary.subfacet_parents;
    parents.partition_point(|&other| other < parent)
        ..parents.partition_point(|&other| other <= parent)
}

/// Returns a projection of a facet in which all its own subfacets turn to the left: along the axis
/// of the largest component of its normal, or of another one that is half as large, which serves as
/// well. Of components that are about equal roundings make either the largest; and a subfacet of
/// some units may be flat along one of them. That of the largest if there is none.
pub(super) fn projection_of(facet: &Facet, view: View<'_, 3>) -> AllocResult<Projection> {
    let (normal, mut signs) = (&facet.normal, Signs::<Robust>::default());
    let largest = largest_axis(normal);
    let others = (0..3).filter(|&axis| axis != largest);
    let others = others.filter(|&axis| 2.0 * normal[axis].abs() >= normal[largest].abs());
    if others.clone().next().is_none() {
        return Ok(facet.projection);
    }
    let own = &view.mesh.boundary.subfacets[range(view, facet.parent)];
    for axis in [largest].into_iter().chain(others) {
        let projection = Projection::along_axis(normal, axis);
        let mut left = 0;
        for vertices in own {
            if turn(projection, view, vertices, &mut signs)? != Ordering::Greater {
                break;
            }
            left += 1;
        }
        if left == own.len() {
            return Ok(projection);
        }
    }
    Ok(facet.projection)
}

/// Checks that the subfacets of a facet, with those that it borrows, tile it, and that they are
/// near its plane.
pub(super) fn check(
    facet: &Facet,
    ways: &mut Ways<'_>,
    findings: &mut Findings,
) -> AllocResult<()> {
    let Tiled { rim: expected, is_whole, tiles, goes_round } = tiled(facet, ways, findings)?;
    let subfacets = &collected(tiles.iter().map(|tile| tile.vertices))?[..];
    check_orientations(facet, ways.view, subfacets, findings)?;
    let edges = sorted_edges(subfacets)?;
    rim(facet.parent, &edges, findings)?;
    if is_whole {
        check_rim(facet.parent, &rim_of(&tiles)?, &expected, findings);
    }
    check_within(facet, ways, &edges, subfacets, findings)?;
    let all = tiles.iter().flat_map(|tile| (0..tile.times).map(|_| tile.vertices));
    check_area(facet, ways, &collected(all)?, goes_round, findings);
    let mut vertices = collected(subfacets.as_flattened().iter().copied())?;
    vertices.sort_unstable();
    vertices.dedup();
    plane::check(facet, &vertices, ways, findings);
    Ok(())
}

/// Finds the rim and the tiles of a facet. Where there are several chains along an edge within
/// roundings, those count of which the tiles end there: the facet's own subfacets tell, if it is
/// split or bent.
pub(super) fn tiled(
    facet: &Facet,
    ways: &mut Ways<'_>,
    findings: &mut Findings,
) -> AllocResult<Tiled> {
    const SPLIT: &[&[Keep]] =
        &[&[Keep::Directed, Keep::Along], &[Keep::Directed, Keep::AsFar], &[], &[Keep::Bent]];
    const GIVEN: &[&[Keep]] = &[&[], &[Keep::Directed, Keep::AsFar]];
    let all = if ways.splits(facet.parent) { SPLIT } else { GIVEN };
    for keeps in all {
        let mut own = Findings::counting();
        let tiled = Tiled::find(facet, keeps, ways, &mut own)?;
        if own.clean() && tiled.fits()? {
            findings.merge(own);
            return Ok(tiled);
        }
        tiled.forget(ways);
    }
    Tiled::find(facet, all[0], ways, findings)
}

/// Returns true if chains lead along all edges of a facet, and its tiles end there.
pub(super) fn is_tiled(facet: &Facet, ways: &mut Ways<'_>) -> AllocResult<bool> {
    let tiled = tiled(facet, ways, &mut Findings::counting())?;
    tiled.forget(ways);
    tiled.fits()
}

impl Tiled {
    fn find(
        facet: &Facet,
        keeps: &'static [Keep],
        ways: &mut Ways<'_>,
        findings: &mut Findings,
    ) -> AllocResult<Self> {
        if !keeps.is_empty() {
            let own = &ways.view.mesh.boundary.subfacets[range(ways.view, facet.parent)];
            // Which edges are in several subfacets is asked of all tiles.
            let rim = rim(facet.parent, &sorted_edges(own)?, &mut Findings::counting())?;
            ways.note_rim(facet.parent, &rim)?;
        }
        ways.keep(keeps);
        let found = expected_rim(facet, ways, findings);
        ways.keep(&[]);
        let (rim, is_whole) = found?;
        let tiles = tiles::tiles(facet, &rim, ways)?;
        Ok(Self { rim, is_whole, tiles, goes_round: keeps.iter().any(|keep| keep.leaves_rim()) })
    }

    /// Returns true if the tiles end at the rim.
    fn fits(&self) -> AllocResult<bool> {
        Ok(self.is_whole && rim_of(&self.tiles)? == self.rim)
    }

    /// Lets the tiles be found anew.
    fn forget(&self, ways: &mut Ways<'_>) {
        self.tiles.iter().for_each(|tile| ways.tile_of[tile.subfacet as usize] = (NONE, 0));
    }
}

/// Returns the edges at which tiles end, sorted.
fn rim_of(tiles: &[Tile]) -> AllocResult<Vec<Edge>> {
    let sides = tiles.iter().flat_map(|tile| {
        let [a, b, c] = tile.vertices;
        [[a, b], [b, c], [c, a]].map(|edge| turned_upwards(edge, tile.times))
    });
    summed(collected(sides)?)
}

/// Checks that the edges of facets of which nothing else is known are subsegments where they end.
pub(super) fn check_rims(
    view: View<'_, 3>,
    faces: &Faces,
    findings: &mut Findings,
) -> AllocResult<()> {
    let boundary = &view.mesh.boundary;
    let pairs = boundary.subfacet_parents.chunk_by(|a, b| a == b);
    let mut start = 0;
    for same in pairs {
        let subfacets = &boundary.subfacets[start..start + same.len()];
        start += same.len();
        if same[0] == NONE {
            continue;
        }
        for ([a, b], _) in rim(same[0], &sorted_edges(subfacets)?, findings)? {
            findings.check(faces.subsegment(view, [a, b]).is_some(), || {
                let message = message!(
                    "facet {} ends at the edge from vertex {a} to {b}, which is no subsegment",
                    same[0]
                );
                Violation::new(ViolationKind::FacetTiling, message).vertex(a as usize)
            });
        }
    }
    Ok(())
}

pub(super) fn check_orientations(
    facet: &Facet,
    view: View<'_, 3>,
    subfacets: &[[u32; 3]],
    findings: &mut Findings,
) -> AllocResult<()> {
    let mut signs = Signs::<Robust>::default();
    for vertices in subfacets {
        let sign = turn(facet.projection, view, vertices, &mut signs)?;
        findings.check(sign == Ordering::Greater, || {
            let word = if sign == Ordering::Equal { "flat" } else { "turned round" };
            let message = message!(
                "the subfacet {vertices:?} of {} is {word} in its projection",
                name_of(facet.parent)
            );
            Violation::new(ViolationKind::FacetTriangle, message).vertex(vertices[0] as usize)
        });
    }
    Ok(())
}

/// Returns the side to which a triangle turns in a projection.
fn turn(
    projection: Projection,
    view: View<'_, 3>,
    vertices: &[u32; 3],
    signs: &mut Signs<Robust>,
) -> AllocResult<Ordering> {
    let [a, b, c] = vertices.map(|vertex| projection.of(view.point(vertex)));
    signs.orientation(&[&a, &b, &c])
}

/// Returns the edges of triangles, sorted.
pub(super) fn sorted_edges(triangles: &[[u32; 3]]) -> AllocResult<Vec<Directed>> {
    let of_triangle = |&[a, b, c]: &[u32; 3]| [[a, b], [b, c], [c, a]].map(directed);
    let mut edges = collected(triangles.iter().flat_map(of_triangle))?;
    edges.sort_unstable();
    Ok(edges)
}

/// Returns the edges that one triangle has, and checks that every other is in two triangles, which
/// run through it in opposite directions.
pub(super) fn rim(
    facet: u32,
    edges: &[Directed],
    findings: &mut Findings,
) -> AllocResult<Vec<Directed>> {
    let mut rim = Vec::new();
    for same in edges.chunk_by(|a, b| a.0 == b.0) {
        if let [single] = same {
            rim.try_push(*single)?;
            continue;
        }
        findings.check(same.len() == 2 && same[0].1 != same[1].1, || {
            let ([a, b], count) = (same[0].0, same.len());
            let message = message!(
                "the edge from vertex {a} to {b} is in {count} subfacets of {}, which are not one \
                 on each side",
                name_of(facet)
            );
            Violation::new(ViolationKind::FacetTiling, message).vertex(a as usize)
        });
    }
    Ok(rim)
}

/// Returns an edge as one from its lower end, which a facet has on its left so many times.
fn turned_upwards([a, b]: [u32; 2], times: i64) -> Edge {
    if a < b { ([a, b], times) } else { ([b, a], -times) }
}

/// Returns each of some edges with the sum of its times, but for those that have none; sorted.
fn summed(mut edges: Vec<Edge>) -> AllocResult<Vec<Edge>> {
    edges.sort_unstable();
    let sums = edges.chunk_by(|a, b| a.0 == b.0);
    let sums = sums.map(|same| (same[0].0, same.iter().map(|edge| edge.1).sum()));
    collected(sums.filter(|sum: &Edge| sum.1 != 0))
}

/// Returns the subsegments along the rim of a facet, sorted; and true if none are missing.
fn expected_rim(
    facet: &Facet,
    ways: &mut Ways<'_>,
    findings: &mut Findings,
) -> AllocResult<(Vec<Edge>, bool)> {
    let (mut pieces, mut is_whole) = (Vec::new(), true);
    for &ends in &facet.rim {
        if !ways.check_edge(facet.parent, ends, findings)? {
            is_whole = false;
            continue;
        }
        for pair in ways.vertices_on_way().windows(2) {
            pieces.try_push(turned_upwards([pair[0], pair[1]], 1))?;
        }
    }
    // Two edges that rounding leads along one chain have nothing between them.
    Ok((summed(pieces)?, is_whole))
}

fn check_rim(facet: u32, found: &[Edge], expected: &[Edge], findings: &mut Findings) {
    let differs = found.iter().zip(expected).position(|(a, b)| a != b);
    let shorter = found.len().min(expected.len());
    findings.check(differs.is_none() && found.len() == expected.len(), || {
        let at = differs.unwrap_or(shorter);
        let edges = found.get(at).into_iter().chain(expected.get(at));
        let [a, b] = edges.map(|edge| edge.0).min().unwrap_or([NONE; 2]);
        let message = message!(
            "the subfacets of facet {facet} do not end where it does, at the edge from vertex {a} \
             to {b}"
        );
        Violation::new(ViolationKind::FacetTiling, message).vertex(a as usize)
    });
}

/// Checks that the segments and vertices within a facet are edges and vertices of its subfacets.
fn check_within(
    facet: &Facet,
    ways: &mut Ways<'_>,
    edges: &[Directed],
    subfacets: &[[u32; 3]],
    findings: &mut Findings,
) -> AllocResult<()> {
    let number = facet.parent;
    for &ends in &facet.within {
        if !ways.check_edge(number, ends, findings)? {
            continue;
        }
        for pair in ways.vertices_on_way().windows(2) {
            let (key, _) = directed([pair[0], pair[1]]);
            let is_there = edges.binary_search_by_key(&key, |edge| edge.0).is_ok();
            findings.check(is_there, || {
                let [a, b] = key;
                let message = message!(
                    "the edge from vertex {a} to {b} is within facet {number}, and in none of its \
                     subfacets"
                );
                Violation::new(ViolationKind::FacetTiling, message).vertex(a as usize)
            });
        }
    }
    for &ends in &facet.beside {
        ways.check_edge(number, ends, findings)?;
    }
    for &vertex in &facet.points {
        findings.check(subfacets.as_flattened().contains(&vertex), || {
            let message =
                message!("vertex {vertex} is within facet {number}, and in none of its subfacets");
            Violation::new(ViolationKind::FacetTiling, message).vertex(vertex as usize)
        });
    }
    Ok(())
}

/// Checks that the areas of the subfacets in the projection add up to the facet's, up to what
/// vertices on its edges are off them. What is split may go round an edge that others have, and
/// what is bent if `goes_round` is set.
pub(super) fn check_area(
    facet: &Facet,
    ways: &Ways<'_>,
    subfacets: &[[u32; 3]],
    goes_round: bool,
    findings: &mut Findings,
) {
    let (mut difference, mut bound) = (Sum::zero(), Sum::zero());
    for vertices in subfacets {
        let [a, b, c] = vertices.map(|vertex| facet.projection.of(ways.view.point(vertex)));
        for [from, to] in [[&a, &b], [&b, &c], [&c, &a]] {
            difference.add_facet([from, to]);
        }
    }
    for &ends in &facet.rim {
        let [from, to] = ends.map(|end| facet.projection.of(ways.input(end)));
        difference.add_facet([&to, &from]);
        let splits = ways.splits(facet.parent);
        if splits || goes_round || ways.faces.subsegment(ways.view, ends).is_none() {
            let roundings = ways.roundings(splits);
            let units = roundings.units_of(ends.map(|end| ways.input(end)));
            add_deviation(&from, &to, facet.projection.of(&units), &mut bound);
        }
    }
    if difference.sign() == Ordering::Less {
        let mut magnitude = Sum::zero();
        magnitude.add(&difference, true);
        difference = magnitude;
    }
    bound.add(&difference, true);
    findings.check(bound.sign() != Ordering::Less, || {
        let message = message!(
            "the subfacets of facet {} have another area than it in its projection",
            facet.parent
        );
        Violation::new(ViolationKind::FacetArea, message)
    });
}

/// Adds twice the area that is between an edge and a chain which is as near to it as one may be.
fn add_deviation(from: &[f64; 2], to: &[f64; 2], units: [f64; 2], bound: &mut Sum) {
    for (axis, other) in [(0, 1), (1, 0)] {
        let half = (0.5 * to[axis] - 0.5 * from[axis]).abs().next_up();
        bound.add_product(&[4.0 * BENT, half, units[other]]);
    }
}
