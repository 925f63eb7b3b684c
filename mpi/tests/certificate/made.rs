//! Meshes of several ranks, and what the certificate says of them.

use netmesh::{Mesh, NONE, Options, Triangulation};
use netmesh_mpi::DistributedMesh;
use netmesh_mpi::certificate::{Report, ViolationKind, validate};
use netmesh_mpi::comm::{Communicator, threads};
use netmesh_mpi::distributed::Promise;
use netmesh_mpi::numbering::number;
use netmesh_mpi::piece::{ADDED, HULL, INTERFACE, NO_DOMAIN, Piece, PieceDomain};
use std::collections::BTreeSet;

/// Returns pseudorandom numbers in [0, 1).
pub fn numbers(count: usize) -> Vec<f64> {
    let mut state = 11u64;
    let mut number = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    (0..count).map(|_| number()).collect()
}

pub fn uniform(dim: usize, count: usize) -> Vec<f64> {
    numbers(dim * count)
}

pub fn clusters(dim: usize, count: usize) -> Vec<f64> {
    let place = |(at, x): (usize, f64)| {
        let (cluster, axis) = (at / dim % 4, at % dim);
        (cluster * (axis + 3) % 5) as f64 + 0.01 * x * x
    };
    numbers(dim * count).into_iter().enumerate().map(place).collect()
}

/// Returns each point several times, on several ranks, and zeros of either sign.
pub fn duplicates(dim: usize, count: usize) -> Vec<f64> {
    let once = numbers(dim * count / 3);
    let mut all = [once.as_slice(), &once, &vec![0.0; dim], &once].concat();
    all.extend(vec![-0.0; dim]);
    all
}

pub fn share(all: &[f64], dim: usize, comm: &dyn Communicator) -> Vec<f64> {
    let start = |rank| all.len() / dim * rank / comm.size() * dim;
    all[start(comm.rank())..start(comm.rank() + 1)].to_vec()
}

/// Returns the mesh of one process, of which each rank has patches here and there.
pub fn parts(dim: usize, all: &[f64], ranks: usize, options: &Options) -> Vec<DistributedMesh> {
    let mut mesh = Mesh::new(dim, all.len() / dim, all, 0).unwrap();
    mesh.run(options, None).unwrap();
    let whole = mesh.triangulation().unwrap();
    let mut names: Vec<u64> = (0..whole.vertex_count() as u64).map(|v| ADDED | v).collect();
    for (input, &vertex) in mesh.inputs().vertices().iter().enumerate().rev() {
        names[vertex as usize] = input as u64;
    }
    let patches = patches(whole, ranks);
    let promise = Promise::of(&whole.parameters);
    threads::run(ranks, |comm| {
        let pieces = vec![piece(whole, &names, &patches, comm.rank())];
        let own = share(all, dim, comm);
        DistributedMesh { promise, ..number(comm, dim, &own, pieces).unwrap() }
    })
}

/// Returns the rank of each simplex: stretches along the first axis, those above the middle moved
/// on by one.
pub fn patches(whole: &Triangulation, ranks: usize) -> Vec<usize> {
    let place = |axis: usize| {
        let middle = |s: &usize| -> f64 {
            whole.simplex(*s).iter().map(|v| whole.points[*v as usize * whole.dim + axis]).sum()
        };
        let mut order: Vec<usize> = (0..whole.simplex_count()).collect();
        order.sort_by(|a, b| middle(a).total_cmp(&middle(b)));
        let mut place = vec![0; order.len()];
        order.iter().enumerate().for_each(|(at, s)| place[*s] = at);
        place
    };
    let (along, across) = (place(0), place(1));
    let count = along.len();
    let stretch = |s: usize| along[s] * ranks / count + usize::from(across[s] > count / 2);
    (0..count).map(|s| stretch(s) % ranks).collect()
}

pub fn piece(whole: &Triangulation, names: &[u64], patches: &[usize], rank: usize) -> Piece {
    let own: Vec<usize> = (0..patches.len()).filter(|s| patches[*s] == rank).collect();
    let own_vertices = || own.iter().flat_map(|s| whole.simplex(*s));
    let vertices: Vec<u32> = own_vertices().copied().collect::<BTreeSet<_>>().into_iter().collect();
    let pick = |v: &u32| *v as usize;
    let neighbor = |n: &u32| match own.binary_search(&(*n as usize)) {
        _ if *n == NONE => HULL,
        Ok(at) => at as u32,
        Err(_) => INTERFACE,
    };
    let domains = whole.domains.iter().zip(0..);
    Piece {
        dim: whole.dim,
        names: vertices.iter().map(|v| names[pick(v)]).collect(),
        points: vertices
            .iter()
            .flat_map(|v| whole.points[pick(v) * whole.dim..][..whole.dim].to_vec())
            .collect(),
        kinds: vertices.iter().map(|v| whole.kinds[pick(v)] as u8).collect(),
        simplices: own_vertices().map(|v| vertices.binary_search(v).unwrap() as u32).collect(),
        neighbors: own.iter().flat_map(|s| whole.neighbors_of(*s)).map(neighbor).collect(),
        domains: domains
            .map(|(domain, name)| PieceDomain {
                center: names[domain.center as usize],
                parent: (domain.parent != NONE).then_some(domain.parent.into()),
                name,
                version: 0,
                radius: domain.radius,
                position: position(
                    &whole.points[domain.center as usize * whole.dim..][..whole.dim],
                ),
            })
            .collect(),
        vertex_cages: vertices.iter().map(|v| cage(whole.cage_of[pick(v)])).collect(),
        vertex_domains: vertices.iter().map(|v| whole.vertex_domains[pick(v)].into()).collect(),
    }
}

fn cage(domain: u32) -> u64 {
    if domain == NONE { NO_DOMAIN } else { domain.into() }
}

fn position(point: &[f64]) -> [f64; 3] {
    std::array::from_fn(|axis| point.get(axis).copied().unwrap_or(0.0))
}

/// Checks parts of a mesh, of which all ranks must answer the same report.
pub fn certify(parts: &[DistributedMesh], level: u32) -> Report {
    let mut reports =
        threads::run(parts.len(), |comm| validate(comm, &parts[comm.rank()], level).unwrap());
    assert!(reports.iter().all(|report| *report == reports[0]), "{reports:?}");
    reports.remove(0)
}

/// Asserts that a mesh on three ranks breaks this rule first after `damage` to its parts; `level`
/// holds.
pub fn assert_broken(
    dim: usize,
    rule: ViolationKind,
    level: u32,
    damage: impl FnOnce(&mut [DistributedMesh]),
) -> Report {
    let parts = parts(dim, &duplicates(dim, 150), 3, &Options::default());
    assert_parts_broken(parts, rule, level, damage)
}

/// Asserts that these parts of three ranks break this rule first after `damage`; `level` holds.
pub fn assert_parts_broken(
    mut parts: Vec<DistributedMesh>,
    rule: ViolationKind,
    level: u32,
    damage: impl FnOnce(&mut [DistributedMesh]),
) -> Report {
    let dim = parts[0].dim;
    damage(&mut parts);
    let report = certify(&parts, 3);
    let first = report.first.clone().unwrap_or_else(|| panic!("{rule:?} is not found in {dim}D"));
    assert_eq!((first.kind, report.level), (rule, level), "{dim}D: {first:?}");
    assert!(report.violations > 0 && !first.message.is_empty() && first.rank < 3);
    report
}

/// Changes what all ranks that know a vertex have of it, at its index.
pub fn change_vertex(
    parts: &mut [DistributedMesh],
    id: u64,
    act: impl Fn(&mut DistributedMesh, usize),
) {
    for part in parts {
        if let Some(at) = part.vertex_ids.iter().position(|known| *known == id) {
            act(part, at);
        }
    }
}

/// Sets a vertex to other coordinates on all ranks that know it.
pub fn move_vertex(parts: &mut [DistributedMesh], id: u64, point: &[f64]) {
    change_vertex(parts, id, |part, at| {
        part.points[at * part.dim..][..part.dim].copy_from_slice(point);
    });
}

pub fn ulp_up(x: &mut f64) {
    *x = x.next_up();
}
