//! Level 1: the star and the link of every vertex, and the Euler characteristic.

use super::report::{Findings, Violation, ViolationKind};
use crate::error::message;
use crate::memory::{AllocResult, TryGrow, filled};
use crate::mesh::NONE;
use crate::quality::view::View;

/// Above this dimension faces are counted at their lowest vertex only, which is cheaper but does
/// not give the Euler characteristic of the links.
const LINK_COUNT_DIM: usize = 5;

/// Checks the star and link of each vertex, and that the complex of `facets` facets is a ball by
/// its Euler characteristic. Facets and neighbours must hold. O(simplices 4^D).
pub(super) fn check<const D: usize>(
    view: View<'_, D>,
    facets: usize,
    findings: &mut Findings,
) -> AllocResult<()> {
    let stars = view.stars()?;
    let mut seen = filled(view.simplex_count(), NONE)?;
    let mut seen_vertices = filled(view.vertex_count(), NONE)?;
    let mut totals = [0u64; D];
    let (mut keys, mut stack) = (Vec::new(), Vec::new());
    for v in 0..view.vertex_count() {
        let star = stars.of(v);
        check_star(view, v, star, &mut seen, &mut stack, findings)?;
        // counts[j]: link faces of j vertices, j = 1..=D - 2.
        let mut counts = [0u64; D];
        for (j, count) in counts.iter_mut().enumerate().take(D - 1).skip(1) {
            *count = match j {
                1 => count_vertices(view, v as u32, star, &mut seen_vertices),
                _ => count_faces(view, v as u32, star, j, &mut keys)?,
            };
        }
        if D <= LINK_COUNT_DIM {
            check_link(view, v, star, &counts, findings);
        }
        for (total, count) in totals.iter_mut().zip(counts) {
            *total += count;
        }
    }
    check_euler(view, facets, &totals, findings);
    Ok(())
}

/// Checks that the star is connected through facets that contain `v`.
fn check_star<const D: usize>(
    view: View<'_, D>,
    v: usize,
    star: &[u32],
    seen: &mut [u32],
    stack: &mut Vec<u32>,
    findings: &mut Findings,
) -> AllocResult<()> {
    stack.clear();
    stack.try_extend(&star[..star.len().min(1)])?;
    stack.iter().for_each(|&s| seen[s as usize] = v as u32);
    let mut reached = 0;
    while let Some(s) = stack.pop() {
        reached += 1;
        let vertices = view.simplex(s as usize);
        for (&n, &opposite) in view.neighbors(s as usize).iter().zip(vertices) {
            if n != NONE && opposite as usize != v && seen[n as usize] != v as u32 {
                seen[n as usize] = v as u32;
                stack.try_push(n)?;
            }
        }
    }
    findings.check(reached == star.len(), || {
        let size = star.len();
        let message =
            message!("of the {size} simplices at vertex {v} only {reached} are connected there");
        Violation::new(ViolationKind::VertexStar, message).vertex(v)
    });
    Ok(())
}

/// Returns true if the faces of a vertex `w` in the link of `v` are counted there.
fn is_counted<const D: usize>(v: u32, w: u32) -> bool {
    w != v && (D <= LINK_COUNT_DIM || w > v)
}

/// Counts the distinct vertices in the link of `v`, as [`count_faces`] does larger faces.
fn count_vertices<const D: usize>(
    view: View<'_, D>,
    v: u32,
    star: &[u32],
    seen: &mut [u32],
) -> u64 {
    let mut count = 0;
    for &s in star {
        for &w in view.simplex(s as usize).iter().filter(|&&w| is_counted::<D>(v, w)) {
            count += u64::from(seen[w as usize] != v);
            seen[w as usize] = v;
        }
    }
    count
}

/// Counts the distinct faces of `size` vertices in the link of `v`; above [`LINK_COUNT_DIM`] only
/// those of higher vertices than `v`.
fn count_faces<const D: usize>(
    view: View<'_, D>,
    v: u32,
    star: &[u32],
    size: usize,
    keys: &mut Vec<[u32; D]>,
) -> AllocResult<u64> {
    keys.clear();
    for &s in star {
        let mut link = [NONE; D];
        let mut length = 0;
        for &w in view.simplex(s as usize).iter().filter(|&&w| is_counted::<D>(v, w)) {
            link[length] = w;
            length += 1;
        }
        link[..length].sort_unstable();
        push_subsets(&link[..length], size, keys)?;
    }
    keys.sort_unstable();
    keys.dedup();
    Ok(keys.len() as u64)
}

/// Appends all subsets of `size` of the sorted `vertices`, padded with [`NONE`].
fn push_subsets<const D: usize>(
    vertices: &[u32],
    size: usize,
    keys: &mut Vec<[u32; D]>,
) -> AllocResult<()> {
    for mask in 0u32..1 << vertices.len() {
        if mask.count_ones() as usize != size {
            continue;
        }
        let mut key = [NONE; D];
        let mut length = 0;
        for (i, &vertex) in vertices.iter().enumerate() {
            if mask >> i & 1 == 1 {
                key[length] = vertex;
                length += 1;
            }
        }
        keys.try_push(key)?;
    }
    Ok(())
}

/// Checks the Euler characteristic of the link: a (D - 1)-sphere, on the hull a (D - 1)-ball.
fn check_link<const D: usize>(
    view: View<'_, D>,
    v: usize,
    star: &[u32],
    counts: &[u64; D],
    findings: &mut Findings,
) {
    let on_hull = |&&s: &&u32| {
        let facets = view.neighbors(s as usize).iter().zip(view.simplex(s as usize));
        facets.filter(|&(&n, &opposite)| n == NONE && opposite as usize != v).count() as u64
    };
    let hull_facets: u64 = star.iter().map(|s| on_hull(&s)).sum();
    let simplices = star.len() as i64;
    let facets = (D as i64 * simplices + hull_facets as i64) / 2;
    let lower: i64 = (1..D - 1).map(|j| sign(j - 1) * counts[j] as i64).sum();
    let found = lower + sign(D - 2) * facets + sign(D - 1) * simplices;
    let needed = if hull_facets > 0 { 1 } else { 1 + sign(D - 1) };
    findings.check(found == needed, || {
        let message = message!(
            "the link of vertex {v} has Euler characteristic {found}, a {} has {needed}",
            if hull_facets > 0 { "ball" } else { "sphere" }
        );
        Violation::new(ViolationKind::VertexLink, message).vertex(v)
    });
}

/// Checks that the alternating sum of the numbers of faces is 1.
fn check_euler<const D: usize>(
    view: View<'_, D>,
    facets: usize,
    totals: &[u64; D],
    findings: &mut Findings,
) {
    let vertices = view.vertex_count() as i64;
    let mut found = vertices + sign(D - 1) * facets as i64 + sign(D) * view.simplex_count() as i64;
    for (k, &total) in totals.iter().enumerate().take(D - 1).skip(1) {
        // A face of dimension k was counted at each of its k + 1 vertices, or at one only.
        let multiplicity = if D <= LINK_COUNT_DIM { k as u64 + 1 } else { 1 };
        found += sign(k) * (total / multiplicity) as i64;
    }
    findings.check(found == 1, || {
        let message = message!("the Euler characteristic is {found}, a ball's is 1");
        Violation::new(ViolationKind::EulerCharacteristic, message)
    });
}

fn sign(power: usize) -> i64 {
    if power % 2 == 0 { 1 } else { -1 }
}
