//! Level 1: the star and the link of every vertex, at its owner, and the Euler characteristic of
//! all.

use super::complex::Complex;
use super::report::{Findings, Violation};
use crate::comm::{Communicator, Operation};
use crate::distributed::NO_ID;
use netmesh::Result;
use netmesh::distributed::memory::{TryGrow, collected, filled};
use netmesh::validate::ViolationKind;

/// Collective. Checks stars and links of vertices, and Euler's characteristic. Facets, ghosts and
/// vertices must hold on all ranks.
pub fn check(
    comm: &dyn Communicator,
    complex: &Complex<'_>,
    findings: &mut Findings,
) -> Result<()> {
    let mesh = complex.mesh;
    let (starts, stars) = stars(complex)?;
    let hull = complex.hull_facets()?;
    let mut around = join_stars(complex)?;
    let mut edges = 0;
    let mut link = Vec::new();
    for vertex in (0..mesh.own_vertices).filter(|&vertex| complex.is_owned(vertex)) {
        let star = &stars[starts[vertex] as usize..starts[vertex + 1] as usize];
        check_star(complex, vertex, star, &mut around, findings);
        link.clear();
        for &node in star {
            let vertices = complex.simplex(node as usize / (mesh.dim + 1));
            let others = vertices.iter().filter(|&&other| other as usize != vertex);
            others.copied().try_for_each(|other| link.try_push(other))?;
        }
        link.sort_unstable();
        link.dedup();
        check_link(complex, vertex, star.len(), link.len(), hull[vertex], findings);
        // An edge counts at its vertex of lower id.
        let id = mesh.vertex_ids[vertex];
        edges += link.iter().filter(|&&other| mesh.vertex_ids[other as usize] > id).count() as u64;
    }
    let open = mesh.neighbors.iter().filter(|&&neighbor| neighbor == NO_ID).count() as u64;
    check_euler(comm, complex, edges, open, findings)
}

/// Returns the stars of all vertices: for each its positions in simplices, which are simplex x (dim
/// + 1) + slot.
fn stars(complex: &Complex<'_>) -> Result<(Vec<u32>, Vec<u32>)> {
    let mesh = complex.mesh;
    let places = || mesh.simplices.iter().chain(&mesh.ghost_simplices).zip(0u32..);
    let mut ends = filled(mesh.vertex_ids.len() + 1, 0u32)?;
    places().for_each(|(&vertex, _)| ends[vertex as usize] += 1);
    let mut sum = 0;
    for end in &mut ends {
        sum += *end;
        *end = sum;
    }
    let mut stars = filled(sum as usize, 0u32)?;
    for (&vertex, place) in places() {
        ends[vertex as usize] -= 1;
        stars[ends[vertex as usize] as usize] = place;
    }
    // Now each is where its places begin.
    Ok((ends, stars))
}

/// Returns disjoint sets of positions: those of a vertex in neighbours that share a facet with it
/// are joined.
fn join_stars(complex: &Complex<'_>) -> Result<Vec<u32>> {
    let size = complex.mesh.dim + 1;
    let mut parents = collected(0..(complex.count() * size) as u32)?;
    for group in complex.groups() {
        let [a, b] = group else { continue };
        for vertex in &a.vertices[..complex.mesh.dim] {
            let [a, b] = [a, b].map(|facet| {
                let vertices = complex.simplex(facet.simplex as usize);
                let slot = vertices.iter().position(|other| other == vertex).unwrap_or(0);
                facet.simplex as usize * size + slot
            });
            let (a, b) = (find(&mut parents, a), find(&mut parents, b));
            parents[a.max(b)] = a.min(b) as u32;
        }
    }
    Ok(parents)
}

fn find(parents: &mut [u32], mut item: usize) -> usize {
    while parents[item] as usize != item {
        let above = parents[item] as usize;
        parents[item] = parents[above];
        item = above;
    }
    item
}

fn check_star(
    complex: &Complex<'_>,
    vertex: usize,
    star: &[u32],
    around: &mut [u32],
    findings: &mut Findings,
) {
    let root = find(around, star[0] as usize);
    let reached = star.iter().filter(|&&place| find(around, place as usize) == root).count();
    findings.check(reached == star.len(), || {
        let (id, size) = (complex.mesh.vertex_ids[vertex], star.len());
        let message =
            format!("of the {size} simplices at vertex {id} only {reached} are connected there");
        Violation::new(ViolationKind::VertexStar, complex.mesh.rank, message).vertex(id)
    });
}

/// Checks that a link has the Euler characteristic of a sphere, or on the hull of a ball.
fn check_link(
    complex: &Complex<'_>,
    vertex: usize,
    star: usize,
    vertices: usize,
    hull_facets: u32,
    findings: &mut Findings,
) {
    let (star, vertices) = (star as i64, vertices as i64);
    let found = match complex.mesh.dim {
        2 => vertices - star,
        _ => vertices - (3 * star + i64::from(hull_facets)) / 2 + star,
    };
    let sphere = if complex.mesh.dim == 2 { 0 } else { 2 };
    let needed = if hull_facets > 0 { 1 } else { sphere };
    findings.check(found == needed, || {
        let id = complex.mesh.vertex_ids[vertex];
        let kind = if hull_facets > 0 { "ball" } else { "sphere" };
        let message =
            format!("the link of vertex {id} has Euler characteristic {found}, a {kind} {needed}");
        Violation::new(ViolationKind::VertexLink, complex.mesh.rank, message).vertex(id)
    });
}

/// Collective. Checks that the alternating sum of the numbers of faces is 1.
fn check_euler(
    comm: &dyn Communicator,
    complex: &Complex<'_>,
    edges: u64,
    open: u64,
    findings: &mut Findings,
) -> Result<()> {
    let mesh = complex.mesh;
    let mut counts = [edges, open];
    comm.all_reduce_integers(&mut counts, Operation::Sum)?;
    let [edges, open] = counts.map(|count| count as i64);
    let (vertices, simplices) = (mesh.totals.vertices as i64, mesh.totals.simplices as i64);
    let facets = ((mesh.dim as i64 + 1) * simplices + open) / 2;
    let found = match mesh.dim {
        2 => vertices - edges + simplices,
        _ => vertices - edges + facets - simplices,
    };
    if mesh.rank == 0 {
        findings.check(found == 1, || {
            let message = format!("the Euler characteristic is {found}, a ball's is 1");
            Violation::new(ViolationKind::EulerCharacteristic, mesh.rank, message)
        });
    }
    Ok(())
}
