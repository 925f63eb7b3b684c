//! Level 2: which triangles of the caller's are one facet. Two that share an edge are joined unless
//! subsegments lead along it; and where subsegments do, if the subfacets beside them are of one
//! facet. Triangles that are joined run through their edge in opposite directions, have one marker
//! and lie in one plane up to what the caller allowed or rounding. The facet has the number of the
//! first of its triangles.

use super::super::sum::Sum;
use super::directions::{across, cosine, direction};
use super::given::{Facet, Projection, point};
use super::left_out::{is_left_out, kept_of, leave_out_narrow, leave_out_needles};
use super::plane::{self, AreaVector};
use super::tiling;
use super::ways::Ways;
use crate::error::message;
use crate::memory::{AllocResult, Sets, TryGrow, collected, filled, with_capacity};
use crate::mesh::{Facets, Inputs, NONE};
use crate::quality::length::Length;
use crate::validate::report::{Findings, Violation, ViolationKind};

/// Largest distance of the opposite vertex from a triangle's plane, relative to its distance from
/// the triangle's vertices, which counts as rounding: twice what the builder allows.
const ROUNDED: f64 = 2e-12;

/// Edge of a triangle: its ends, the lower first, the triangle, and true if that runs from there.
pub(super) type Side = ([u32; 2], u32, bool);

/// Checks which triangles of a surface are one facet, and calls `visit` with each facet and by how
/// much the winding number grows behind it.
pub(super) fn each_facet(
    facets: &Facets,
    ways: &mut Ways<'_>,
    findings: &mut Findings,
    mut visit: impl FnMut(Facet, i64, &mut Ways<'_>, &mut Findings) -> AllocResult<()>,
) -> AllocResult<()> {
    let Some(triangles) = triangles(ways.inputs, facets)? else {
        findings.check(false, || describe("triangles have inputs that are no vertices"));
        return Ok(());
    };
    let mut balances = balances_of(&triangles, ways)?;
    leave_out_needles(&triangles, &mut balances, ways, findings)?;
    let mut kept = kept_of(&balances)?;
    if leave_out_narrow(&triangles, &kept, &mut balances, ways)? {
        kept = kept_of(&balances)?;
    }
    let mut sets = Sets::new(triangles.len())?;
    let sides = sides(&triangles, &kept)?;
    for same in sides.chunk_by(|a, b| a.0 == b.0) {
        for splits in [false, true] {
            join(facets, &triangles, &balances, (same, splits), &mut sets, ways, findings)?;
        }
    }
    check_parents(ways, &mut sets, findings);
    let mut members = with_capacity(triangles.len())?;
    for &triangle in &kept {
        members.push((sets.find(triangle as usize) as u32, triangle));
    }
    members.sort_unstable();
    for group in members.chunk_by(|a, b| a.0 == b.0) {
        let before = findings.violations;
        match facet(ways.inputs, &triangles, group)? {
            Some(facet) if is_left_out(&facet, &triangles, group, ways)? => {}
            Some(facet) => {
                let balance = balances[facet.parent as usize].unwrap_or(1);
                visit(facet, balance, ways, findings)?;
            }
            None => drop(findings.check(false, || describe("a facet's triangles have no area"))),
        }
        let own = || group.iter().map(|member| member.1 as usize);
        own().for_each(|triangle| ways.group_of[triangle] = group[0].1);
        if findings.violations > before || own().any(|triangle| ways.failing.facets[triangle]) {
            own().for_each(|triangle| ways.failing.facets[triangle] = true);
        }
    }
    Ok(())
}

/// Joins those triangles beside an edge that are read as split, or as given, and are one facet.
fn join(
    facets: &Facets,
    triangles: &[[u32; 3]],
    balances: &[Option<i64>],
    (same, splits): (&[Side], bool),
    sets: &mut Sets,
    ways: &mut Ways<'_>,
    findings: &mut Findings,
) -> AllocResult<()> {
    let own = collected(same.iter().copied().filter(|side| ways.splits(side.1) == splits))?;
    if own.len() < 2 {
        return Ok(());
    }
    let is_line = ways.find(same[0].0, splits)?;
    for (at, &one) in own.iter().enumerate() {
        for &other in &own[at + 1..] {
            let [first, second] = [one.1, other.1].map(|triangle| triangle as usize);
            let are_alike = facets.markers[first] == facets.markers[second]
                && balances[first] == balances[second];
            let is_joined = match (is_line, splits) {
                (true, false) => is_one_facet(triangles, [one, other], ways),
                (true, true) => {
                    same.len() == 2 && are_alike && is_one_facet(triangles, [one, other], ways)
                }
                (false, _) => same.len() == 2,
            };
            if is_joined {
                sets.join(first, second);
                if !check_pair(facets, triangles, [one, other], ways, findings) {
                    ways.failing.facets[first] = true;
                }
            }
        }
    }
    Ok(())
}

fn describe(message: &'static str) -> Violation {
    Violation::new(ViolationKind::FacetGroup, message)
}

/// Returns the vertices of the caller's triangles; `None` if some have none.
fn triangles(inputs: &Inputs, facets: &Facets) -> AllocResult<Option<Vec<[u32; 3]>>> {
    let vertex = |input: u32| inputs.vertices().get(input as usize).copied().unwrap_or(NONE);
    let mut triangles = with_capacity(facets.count())?;
    for corners in facets.inputs.chunks_exact(3) {
        let triangle = [0, 1, 2].map(|at: usize| vertex(corners[at]));
        if triangle.iter().any(|&vertex| vertex as usize >= inputs.distinct()) {
            return Ok(None);
        }
        triangles.push(triangle);
    }
    Ok((triangles.len() == facets.count()).then_some(triangles))
}

/// Returns for each triangle by how much the winding number grows behind it. Where crossings are
/// split the first of several with the same vertices stands for all, and the others and those
/// without an area have none.
fn balances_of(triangles: &[[u32; 3]], ways: &Ways<'_>) -> AllocResult<Vec<Option<i64>>> {
    let mut balances = filled(triangles.len(), Some(1))?;
    // The vertices from the lowest on, in their order and then the other way round.
    let turned = |(number, &own): (u32, &[u32; 3])| {
        let least = own.into_iter().min().unwrap_or(NONE);
        let [a, b, c] = from_vertex(own, least);
        ([a, b.min(c), b.max(c)], number, b < c)
    };
    let split = (0u32..).zip(triangles).filter(|own| ways.splits(own.0));
    let mut all = collected(split.map(turned))?;
    all.sort_unstable();
    for same in all.chunk_by(|a, b| a.0 == b.0) {
        let area = AreaVector::of_triangle(same[0].0.map(|corner| point(ways.inputs, corner)));
        let has_area = area.rounded().is_some();
        let sum = same.iter().map(|one| if one.2 == same[0].2 { 1 } else { -1 }).sum();
        for (at, one) in same.iter().enumerate() {
            balances[one.1 as usize] = (at == 0 && has_area).then_some(sum);
        }
    }
    Ok(balances)
}

/// Returns a triangle from one of its vertices on.
fn from_vertex([a, b, c]: [u32; 3], first: u32) -> [u32; 3] {
    match first {
        _ if first == a => [a, b, c],
        _ if first == b => [b, c, a],
        _ => [c, a, b],
    }
}

/// Returns the sides of those of some triangles that have the given numbers.
pub(super) fn sides(triangles: &[[u32; 3]], numbers: &[u32]) -> AllocResult<Vec<Side>> {
    let of_triangle = |&triangle: &u32| {
        let [a, b, c] = triangles[triangle as usize];
        [[a, b], [b, c], [c, a]].map(|[a, b]| ([a.min(b), a.max(b)], triangle, a < b))
    };
    let mut sides = collected(numbers.iter().flat_map(of_triangle))?;
    sides.sort_unstable();
    Ok(sides)
}

/// Returns true if two triangles that run through an edge in opposite directions are one facet in
/// the mesh, which has subsegments there: the chain that was found last. A triangle with subfacets
/// of its own is of no other facet.
fn is_one_facet(triangles: &[[u32; 3]], pair: [Side; 2], ways: &Ways<'_>) -> bool {
    let may_be_of =
        |side: Side, facet: u32| side.1 == facet || tiling::range(ways.view, side.1).is_empty();
    let is_within = |ends: &[u32]| {
        let [one, other] =
            pair.map(|side| parent_beside(triangles, side, [ends[0], ends[1]], ways));
        one == other && one != NONE && pair.iter().all(|&side| may_be_of(side, one))
    };
    pair[0].2 != pair[1].2 && ways.vertices_on_way().windows(2).any(is_within)
}

/// Returns the parent of the subfacet that is beside a subsegment on a triangle's edge as the
/// triangle is: with its direction, and the least turned from it; or [`NONE`].
fn parent_beside(
    triangles: &[[u32; 3]],
    (ends, triangle, is_along): Side,
    [a, b]: [u32; 2],
    ways: &Ways<'_>,
) -> u32 {
    let edge = if is_along { [a, b] } else { [b, a] };
    let boundary = &ways.view.mesh.boundary;
    let along = direction(ways.view.point(a), ways.view.point(b));
    let page = |apex: &[f64; 3]| across(direction(ways.view.point(a), apex), along);
    // Of a needle: the direction of a short subsegment has roundings as wide as that is.
    let [apex, from, to] = from_edge(triangles[triangle as usize], ends).map(|v| ways.input(v));
    let own = across(direction(from, apex), direction(from, to));
    let (mut best, mut parent) = (0.0, NONE);
    for subfacet in ways.faces.beside(ways.view, [a, b]) {
        let [apex, from, to] = from_edge(boundary.subfacets[subfacet as usize], [a, b]);
        let cosine = cosine(&own, &page(ways.view.point(apex)));
        if [from, to] == edge && cosine > best {
            (best, parent) = (cosine, boundary.subfacet_parents[subfacet as usize]);
        }
    }
    parent
}

/// Returns a triangle from its vertex opposite an edge on.
fn from_edge([a, b, c]: [u32; 3], ends: [u32; 2]) -> [u32; 3] {
    match ends {
        _ if !ends.contains(&a) => [a, b, c],
        _ if !ends.contains(&b) => [b, c, a],
        _ => [c, a, b],
    }
}

/// Checks that two triangles may be one facet. Returns true if they may.
fn check_pair(
    facets: &Facets,
    triangles: &[[u32; 3]],
    [one, other]: [Side; 2],
    ways: &Ways<'_>,
    findings: &mut Findings,
) -> bool {
    let marker = |side: Side| facets.markers[side.1 as usize];
    let is_one = one.2 != other.2 && marker(one) == marker(other);
    let [[first, first_apex], [second, second_apex]] = [one, other].map(|(ends, triangle, _)| {
        let vertices = from_edge(triangles[triangle as usize], ends);
        [vertices, [vertices[0]; 3]]
    });
    let allowed = allowed_sine(ways);
    let is_flat = |triangle, apex: [u32; 3]| offset(ways.inputs, triangle, apex[0]) <= allowed;
    let is_fold = is_fold(ways.inputs, first, second);
    // What was split may be bent into the plane of others.
    let splits = ways.splits(one.1) && ways.splits(other.1);
    let is_near = |triangle: [u32; 3], apex: [u32; 3]| {
        let corners = triangle.map(|corner| ways.input(corner));
        let units = ways.roundings(true).units_of(corners);
        splits && plane::is_beside(corners, &units, ways.input(apex[0]))
    };
    let fits = is_flat(first, second_apex)
        || is_flat(second, first_apex)
        || is_near(first, second_apex)
        || is_near(second, first_apex);
    findings.check(is_one && fits && !is_fold, || {
        let (a, b) = (one.1, other.1);
        let message = message!(
            "triangles {a} and {b} are one facet, and have no one marker, direction and plane"
        );
        Violation::new(ViolationKind::FacetGroup, message).vertex(one.0[0] as usize)
    })
}

/// Returns the largest sine of the angle from flat between triangles that are one facet: each of
/// them may be turned from its plane as far as the caller allowed.
fn allowed_sine(ways: &Ways<'_>) -> f64 {
    (2.0 * ways.view.mesh.parameters.coplanar).min(90.0).to_radians().sin() + ROUNDED
}

/// Returns the distance of a vertex from a triangle's plane over its largest distance from the
/// triangle's vertices.
fn offset(inputs: &Inputs, triangle: [u32; 3], vertex: u32) -> f64 {
    let [a, b, c] = triangle.map(|corner| point(inputs, corner));
    let d = point(inputs, vertex);
    let mut volume = Sum::zero();
    for face in [[b, c, d], [a, d, c], [a, b, d], [a, c, b]] {
        volume.add_facet(face);
    }
    let area = AreaVector::of_triangle([a, b, c]);
    let Some((normal, exponent)) = area.rounded() else { return f64::INFINITY };
    let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
    let (mantissa, own) = volume.rounded();
    let height = Length::scaled(mantissa.abs() / length, own - exponent);
    let far = [a, b, c].map(|corner| Length::between(corner, d));
    height.ratio(far[0].max(far[1]).max(far[2]))
}

/// Returns true if the normals of two triangles do not point to one side.
fn is_fold(inputs: &Inputs, first: [u32; 3], second: [u32; 3]) -> bool {
    let [a, b] = [first, second].map(|triangle| {
        let area = AreaVector::of_triangle(triangle.map(|corner| point(inputs, corner)));
        area.rounded().map_or([0.0; 3], |(vector, _)| vector)
    });
    a.iter().zip(&b).map(|(x, y)| x * y).sum::<f64>() <= 0.0
}

/// Makes the facet of a group of triangles.
fn facet(
    inputs: &Inputs,
    triangles: &[[u32; 3]],
    group: &[(u32, u32)],
) -> AllocResult<Option<Facet>> {
    let own = collected(group.iter().map(|&(_, triangle)| triangles[triangle as usize]))?;
    let mut area = AreaVector::zero();
    for triangle in &own {
        area.add_triangle(triangle.map(|corner| point(inputs, corner)));
    }
    let Some((normal, _)) = area.rounded() else { return Ok(None) };
    let mut rim: Vec<[u32; 2]> = Vec::new();
    let numbers = collected(0..own.len() as u32)?;
    for same in sides(&own, &numbers)?.chunk_by(|a, b| a.0 == b.0) {
        let forward = same.iter().filter(|side| side.2).count();
        let backward = same.len() - forward;
        let [a, b] = same[0].0;
        for _ in 0..forward.abs_diff(backward) {
            rim.try_push(if forward > backward { [a, b] } else { [b, a] })?;
        }
    }
    let mut corners = collected(own.iter().flatten().copied())?;
    corners.sort_unstable();
    corners.dedup();
    let (parent, projection) = (group[0].0, Projection::along(&normal));
    let (within, beside, points) = Default::default();
    Ok(Some(Facet { parent, rim, within, beside, points, corners, projection, normal }))
}

/// Checks that subfacets are of facets, which have the number of their first triangle.
fn check_parents(ways: &mut Ways<'_>, sets: &mut Sets, findings: &mut Findings) {
    let boundary = &ways.view.mesh.boundary;
    for same in boundary.subfacet_parents.chunk_by(|a, b| a == b).filter(|same| same[0] != NONE) {
        let parent = same[0] as usize;
        let is_first = findings.check(sets.find(parent) == parent, || {
            let message = message!(
                "subfacets are of facet {parent}, which is not the first triangle of its facet"
            );
            Violation::new(ViolationKind::FacetGroup, message)
        });
        if !is_first {
            ways.failing.facets[parent] = true;
        }
    }
}
