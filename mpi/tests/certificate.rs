//! The certificate of meshes of several ranks: meshes that hold, and for each rule one that is damaged.

use netmesh::{Criterion, Mesh, NONE, Options, Output, Triangulation};
use netmesh_mpi::certificate::{Report, Rule, validate};
use netmesh_mpi::comm::{Communicator, threads};
use netmesh_mpi::distributed::{Ghost, InterfaceFacet, NO_ID, Promise};
use netmesh_mpi::numbering::number;
use netmesh_mpi::piece::{ADDED, HULL, INTERFACE, Piece, PieceDomain};
use netmesh_mpi::{DistributedMesh, run};
use std::collections::BTreeSet;

/// Pseudorandom numbers in [0, 1).
fn numbers(count: usize) -> Vec<f64> {
    let mut state = 11u64;
    let mut number = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    (0..count).map(|_| number()).collect()
}

fn uniform(dim: usize, count: usize) -> Vec<f64> {
    numbers(dim * count)
}

fn clusters(dim: usize, count: usize) -> Vec<f64> {
    let place = |(at, x): (usize, f64)| {
        let (cluster, axis) = (at / dim % 4, at % dim);
        (cluster * (axis + 3) % 5) as f64 + 0.01 * x * x
    };
    numbers(dim * count).into_iter().enumerate().map(place).collect()
}

/// Each point several times, on several ranks, and zeros of either sign.
fn duplicates(dim: usize, count: usize) -> Vec<f64> {
    let once = numbers(dim * count / 3);
    let mut all = [once.as_slice(), &once, &vec![0.0; dim], &once].concat();
    all.extend(vec![-0.0; dim]);
    all
}

fn share(all: &[f64], dim: usize, comm: &dyn Communicator) -> Vec<f64> {
    let start = |rank| all.len() / dim * rank / comm.size() * dim;
    all[start(comm.rank())..start(comm.rank() + 1)].to_vec()
}

/// The mesh of one process, of which each rank has patches here and there.
fn parts(dim: usize, all: &[f64], ranks: usize, options: &Options) -> Vec<DistributedMesh> {
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

/// Simplex -> its rank: stretches along the first axis, those above the middle moved on by one.
fn patches(whole: &Triangulation, ranks: usize) -> Vec<usize> {
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

fn piece(whole: &Triangulation, names: &[u64], patches: &[usize], rank: usize) -> Piece {
    let own: Vec<usize> = (0..patches.len()).filter(|s| patches[*s] == rank).collect();
    let corners = || own.iter().flat_map(|s| whole.simplex(*s));
    let vertices: Vec<u32> = corners().copied().collect::<BTreeSet<_>>().into_iter().collect();
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
        simplices: corners().map(|v| vertices.binary_search(v).unwrap() as u32).collect(),
        neighbors: own.iter().flat_map(|s| whole.neighbors_of(*s)).map(neighbor).collect(),
        domains: domains
            .map(|(domain, name)| PieceDomain {
                center: names[domain.center as usize],
                parent: (domain.parent != NONE).then_some(domain.parent.into()),
                name,
                radius: domain.radius,
            })
            .collect(),
        vertex_domains: vertices.iter().map(|v| whole.vertex_domains[pick(v)].into()).collect(),
    }
}

/// All ranks answer the same.
fn certify(parts: &[DistributedMesh], level: u32) -> Report {
    let mut reports =
        threads::run(parts.len(), |comm| validate(comm, &parts[comm.rank()], level).unwrap());
    assert!(reports.iter().all(|report| *report == reports[0]), "{reports:?}");
    reports.remove(0)
}

#[test]
fn meshes_of_any_number_of_ranks_hold() {
    let finished = Options { output: Output::WellSpaced, ..Options::default() };
    let edges = Options { criterion: Criterion::RadiusEdge, ..finished.clone() };
    type Shape = fn(usize, usize) -> Vec<f64>;
    let shapes: [(&str, Shape); 3] =
        [("uniform", uniform), ("clusters", clusters), ("duplicates", duplicates)];
    for (dim, count) in [(2, 300), (3, 120)] {
        for (shape, make) in shapes {
            let all = make(dim, count);
            for options in [&Options::default(), &finished, &edges] {
                for ranks in 1..=5 {
                    let report = certify(&parts(dim, &all, ranks, options), 3);
                    let case = format!("{shape} in {dim}D on {ranks} ranks, {options:?}");
                    assert_eq!((report.level, &report.first), (3, &None), "{case}");
                    assert!(report.violations == 0 && report.checked > 1000, "{case}");
                }
            }
        }
    }
}

/// Meshes of several partitions, made by the ranks themselves.
#[test]
fn meshes_that_ranks_make_hold() {
    for (dim, count, ranks) in [(2, 18_000, 1), (2, 18_000, 4), (3, 8_500, 2)] {
        let all = uniform(dim, count);
        let made = threads::run(ranks, |comm| {
            run(comm, dim, &share(&all, dim, comm), &Options::default(), None).unwrap()
        });
        let report = certify(&made, 3);
        assert_eq!((report.level, report.first), (3, None), "{dim}D on {ranks} ranks");
        assert!(ranks == 1 || made.iter().filter(|part| part.simplex_count() > 0).count() > 1);
    }
}

#[test]
fn lower_levels_check_less() {
    let parts = parts(2, &uniform(2, 100), 3, &Options::default());
    let [one, two, three] = [1, 2, 3].map(|level| certify(&parts, level));
    assert_eq!([one.level, two.level, three.level], [1, 2, 3]);
    assert!(one.checked < two.checked && two.checked < three.checked);
    for level in [0, 4] {
        let errors = threads::run(3, |comm| {
            validate(comm, &parts[comm.rank()], level).unwrap_err().message().to_owned()
        });
        assert_eq!(errors, vec![format!("level is {level}; it must be 1, 2 or 3 (rank 0)"); 3]);
    }
    threads::run(3, |comm| {
        let error = validate(comm, &parts[comm.rank()], 1 + comm.rank() as u32 % 2).unwrap_err();
        assert!(error.message().starts_with("level and dim are [1, 2] on one rank"), "{error}");
    });
    threads::run(2, |comm| {
        let error = validate(comm, &parts[comm.rank()], 1).unwrap_err();
        assert!(error.message().starts_with("the mesh is that of rank 0 of 3"), "{error}");
    });
}

/// A mesh on three ranks, whatever is done to the parts, breaks this rule first.
fn assert_broken(
    dim: usize,
    rule: Rule,
    level: u32,
    damage: impl FnOnce(&mut [DistributedMesh]),
) -> Report {
    assert_broken_with(dim, rule, level, &Options::default(), damage)
}

fn assert_broken_with(
    dim: usize,
    rule: Rule,
    level: u32,
    options: &Options,
    damage: impl FnOnce(&mut [DistributedMesh]),
) -> Report {
    let all = duplicates(dim, 150);
    let mut parts = parts(dim, &all, 3, options);
    damage(&mut parts);
    let report = certify(&parts, 3);
    let first = report.first.clone().unwrap_or_else(|| panic!("{rule:?} is not found in {dim}D"));
    assert_eq!((first.rule, report.level), (rule, level), "{dim}D: {first:?}");
    assert!(report.violations > 0 && !first.message.is_empty() && first.rank < 3);
    report
}

/// A vertex that is own on one rank, and on another only known from ghosts: the index there.
fn distant_vertex(part: &DistributedMesh) -> usize {
    assert!(part.own_vertices < part.vertex_ids.len());
    part.own_vertices
}

fn ulp_up(x: &mut f64) {
    *x = x.next_up();
}

#[test]
fn what_ranks_have_of_each_other_is_compared() {
    for dim in [2, 3] {
        let report = assert_broken(dim, Rule::SharedVertex, 0, |parts| {
            let at = distant_vertex(&parts[1]) * dim + dim - 1;
            ulp_up(&mut parts[1].points[at]);
        });
        let first = report.first.unwrap();
        assert_eq!((first.rank, report.violations), (1, 1), "a ghost's coordinate by one ulp");
        assert!(first.message.starts_with(&format!("coordinate {} of vertex", dim - 1)));
        assert_ne!(first.vertex, NO_ID);
        // One that is own on both sides, moved on one.
        assert_broken(dim, Rule::SharedVertex, 0, |parts| {
            let vertex = parts[2].vertex_owners.iter().position(|&owner| owner == 0).unwrap();
            ulp_up(&mut parts[2].points[vertex * dim]);
        });
        assert_broken(dim, Rule::SharedVertex, 0, |parts| {
            let vertex = distant_vertex(&parts[0]);
            parts[0].kinds[vertex] ^= 1;
        });
        assert_broken(dim, Rule::SharedVertex, 0, |parts| {
            let vertex = distant_vertex(&parts[0]);
            parts[0].vertex_domains[vertex] = NO_ID;
        });
        assert_broken(dim, Rule::VertexOwner, 0, |parts| {
            let vertex = distant_vertex(&parts[2]);
            parts[2].vertex_owners[vertex] = 2;
        });
        // Vertices of a ghost swapped: its owner has them in another order.
        let report = assert_broken(dim, Rule::Ghost, 0, |parts| {
            parts[1].ghost_simplices.swap(0, 1);
        });
        assert_eq!((report.first.unwrap().rank, report.violations), (1, 1));
        // A ghost whose vertex is another one that the rank knows.
        assert_broken(dim, Rule::Ghost, 0, |parts| {
            let part = &mut parts[0];
            let size = dim + 1;
            let other = (0..part.vertex_ids.len() as u32)
                .find(|vertex| !part.ghost_simplices[..size].contains(vertex))
                .unwrap();
            part.ghost_simplices[size - 1] = other;
        });
        assert_broken(dim, Rule::Ghost, 0, |parts| {
            let ranks = parts.len() as u32;
            let ghost = &mut parts[0].ghosts[0];
            ghost.owner = if ghost.owner + 1 == ranks { 1 } else { ghost.owner + 1 };
        });
    }
}

/// A ghost that is not at the interface is left out, with its vertices if no other has them.
fn drop_ghost(part: &mut DistributedMesh) {
    let size = part.dim + 1;
    let at_interface: BTreeSet<usize> = part.interface.iter().map(|facet| facet.ghost).collect();
    let is_needed = |ghost: usize| {
        let others = (0..part.ghosts.len()).filter(|other| *other != ghost);
        let known: BTreeSet<u32> = others.flat_map(|other| part.ghost(other).to_vec()).collect();
        let own = part.own_vertices as u32;
        at_interface.contains(&ghost)
            || part.ghost(ghost).iter().any(|vertex| *vertex >= own && !known.contains(vertex))
    };
    let ghost = (0..part.ghosts.len()).find(|ghost| !is_needed(*ghost)).unwrap();
    part.ghosts.remove(ghost);
    part.ghost_simplices.drain(ghost * size..(ghost + 1) * size);
    part.interface.iter_mut().for_each(|facet| facet.ghost -= usize::from(facet.ghost > ghost));
}

#[test]
fn neighbors_are_those_that_share_facets() {
    for dim in [2, 3] {
        let size = dim + 1;
        assert_broken(dim, Rule::MissingGhost, 0, |parts| drop_ghost(&mut parts[1]));
        // The neighbour across an interface is another ghost.
        let report = assert_broken(dim, Rule::NeighborFacet, 0, |parts| {
            let part = &mut parts[1];
            let facet = &mut part.interface[0];
            facet.ghost = (facet.ghost + 1) % part.ghosts.len();
            part.neighbors[facet.simplex * size + facet.facet as usize] =
                part.ghosts[facet.ghost].id;
        });
        assert_eq!((report.first.unwrap().rank, report.violations), (1, 1));
        assert_broken(dim, Rule::MissingNeighbor, 0, |parts| {
            let facet = parts[2].interface.remove(0);
            parts[2].neighbors[facet.simplex * size + facet.facet as usize] = NO_ID;
        });
        assert_broken(dim, Rule::Interface, 0, |parts| {
            parts[2].interface.pop();
        });
        assert_broken(dim, Rule::NeighborOutOfRange, 0, |parts| {
            let slot = parts[0].neighbors.iter().position(|neighbor| *neighbor != NO_ID).unwrap();
            parts[0].neighbors[slot] = parts[0].totals.simplices + 7;
        });
        assert_broken(dim, Rule::NeighborFacet, 0, |parts| {
            let slot = parts[0].neighbors.iter().position(|neighbor| *neighbor == NO_ID).unwrap();
            parts[0].neighbors[slot] = parts[0].first_simplex + u64::from(slot < size) * 2;
        });
    }
}

#[test]
fn arrays_fit_each_other() {
    for dim in [2, 3] {
        assert_broken(dim, Rule::ArrayLength, 0, |parts| {
            parts[1].points.pop();
        });
        assert_broken(dim, Rule::NonFinite, 0, |parts| parts[1].points[1] = f64::NAN);
        assert_broken(dim, Rule::VertexOutOfRange, 0, |parts| {
            parts[2].simplices[0] = parts[2].own_vertices as u32;
        });
        assert_broken(dim, Rule::RepeatedVertex, 0, |parts| {
            parts[2].simplices[0] = parts[2].simplices[1];
        });
        assert_broken(dim, Rule::Ids, 0, |parts| parts[0].vertex_ids.swap(0, 1));
        assert_broken(dim, Rule::Ids, 0, |parts| parts[1].first_simplex = u64::MAX);
        assert_broken(dim, Rule::Ids, 0, |parts| parts[2].first_input += 1);
        assert_broken(dim, Rule::Ids, 0, |parts| parts[2].ghosts.swap(0, 1));
        assert_broken(dim, Rule::VertexOwner, 0, |parts| parts[0].vertex_owners[0] = 3);
        assert_broken(dim, Rule::Ghost, 0, |parts| {
            let Ghost { owner, .. } = &mut parts[1].ghosts[0];
            *owner = 1;
        });
        assert_broken(dim, Rule::UnusedVertex, 0, |parts| {
            let part = &mut parts[1];
            let id = part.totals.vertex_ids - 1;
            part.vertex_ids.push(if part.vertex_ids.contains(&id) { id + 1 } else { id });
            part.totals.vertex_ids += 1;
            part.points.extend(vec![0.5; dim]);
            part.kinds.push(1);
            part.vertex_owners.push(1);
            part.vertex_domains.push(0);
        });
        assert_broken(dim, Rule::Totals, 0, |parts| {
            parts.iter_mut().for_each(|part| part.totals.vertices += 1);
        });
        assert_broken(dim, Rule::Totals, 0, |parts| parts[1].totals.domains += 1);
    }
}

/// The whole mesh of a process, on one rank: facets changed where no one else has them.
fn assert_broken_alone(dim: usize, rule: Rule, level: u32, damage: fn(&mut DistributedMesh)) {
    let mut parts = parts(dim, &uniform(dim, 60), 1, &Options::default());
    damage(&mut parts[0]);
    let report = certify(&parts, 3);
    let first = report.first.expect("found");
    assert_eq!((first.rule, report.level, first.rank), (rule, level, 0), "{first:?}");
}

#[test]
fn complexes_that_are_no_ball_are_found() {
    // A triangle, or a tetrahedron, twice.
    let twice = |part: &mut DistributedMesh| {
        let size = part.dim + 1;
        part.simplices.truncate(size);
        part.simplices.extend_from_within(..);
        part.simplices = part
            .simplices
            .iter()
            .map(|v| part.simplices[..size].iter().position(|w| w == v).unwrap() as u32)
            .collect();
        let (vertices, dim) = (size, part.dim);
        part.vertex_ids = (part.totals.inputs..).take(vertices).collect();
        part.own_vertices = vertices;
        part.points.truncate(vertices * dim);
        part.kinds.truncate(vertices);
        part.vertex_owners.truncate(vertices);
        part.vertex_domains.truncate(vertices);
        part.neighbors = [vec![1; size], vec![0; size]].concat();
        part.totals.simplices = 2;
        part.totals.vertices = vertices as u64;
        part.totals.duplicates = part.totals.inputs;
        part.totals.vertex_ids = part.totals.inputs + vertices as u64;
    };
    for dim in [2, 3] {
        assert_broken_alone(dim, Rule::DuplicateSimplex, 0, twice);
    }
    // Triangles without inputs: a bow tie, and a ring.
    let plane = |points: &[[f64; 2]], simplices: &[[u32; 3]]| {
        let count = points.len();
        let across = |s: usize, slot: usize| {
            let facet = |t: &[u32; 3], skipped: usize| {
                let mut ids = vec![t[(skipped + 1) % 3], t[(skipped + 2) % 3]];
                ids.sort_unstable();
                ids
            };
            let own = facet(&simplices[s], slot);
            let is_other = |t: &usize| *t != s && (0..3).any(|at| facet(&simplices[*t], at) == own);
            (0..simplices.len()).find(is_other).map_or(NO_ID, |t| t as u64)
        };
        let mut mesh = DistributedMesh {
            dim: 2,
            rank: 0,
            ranks: 1,
            vertex_ids: (0..count as u64).collect(),
            own_vertices: count,
            vertex_owners: vec![0; count],
            points: points.concat(),
            kinds: vec![2; count],
            vertex_domains: vec![NO_ID; count],
            simplices: simplices.concat(),
            neighbors: (0..simplices.len())
                .flat_map(|s| (0..3).map(move |slot| (s, slot)))
                .map(|(s, slot)| across(s, slot))
                .collect(),
            ..DistributedMesh::default()
        };
        mesh.totals.vertices = count as u64;
        mesh.totals.vertex_ids = count as u64;
        mesh.totals.simplices = simplices.len() as u64;
        certify(&[mesh], 3).first.map(|first| first.rule)
    };
    let bow = [[0.0, 0.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]];
    assert_eq!(plane(&bow, &[[0, 1, 2], [0, 3, 4]]), Some(Rule::VertexStar));
    let ring = [
        [-3.0, -3.0],
        [3.0, -3.0],
        [3.0, 3.0],
        [-3.0, 3.0],
        [-1.0, -1.0],
        [1.0, -1.0],
        [1.0, 1.0],
        [-1.0, 1.0],
    ];
    let annulus: Vec<[u32; 3]> = (0..4)
        .flat_map(|i| {
            let j = (i + 1) % 4;
            [[i, j, 4 + i], [j, 4 + j, 4 + i]]
        })
        .collect();
    assert_eq!(plane(&ring, &annulus), Some(Rule::EulerCharacteristic));
    assert_eq!(plane(&ring, &[annulus.as_slice(), &[[4, 5, 6], [4, 6, 7]]].concat()), None);
    // Three triangles at an edge, a hull that is not convex, a fold, a facet that is not Delaunay.
    let fan = [[0.0, 0.0], [1.0, 0.0], [0.5, 1.0], [0.5, 2.0], [0.5, -1.0]];
    assert_eq!(plane(&fan, &[[0, 1, 2], [0, 1, 3], [1, 0, 4]]), Some(Rule::OverfullFacet));
    let dart = [[0.0, 0.0], [1.0, 0.0], [0.1, 0.1], [0.0, 1.0]];
    assert_eq!(plane(&dart, &[[0, 1, 2], [0, 2, 3]]), Some(Rule::NonConvexHull));
    let fold = [[0.0, 0.0], [1.0, 0.0], [0.5, 1.0], [0.5, 2.0]];
    assert_eq!(plane(&fold, &[[0, 1, 2], [0, 1, 3]]), Some(Rule::FoldedFacet));
    let flat = [[0.0, 0.0], [4.0, -1.0], [8.0, 0.0], [4.0, 1.0]];
    assert_eq!(plane(&flat, &[[0, 1, 2], [0, 2, 3]]), Some(Rule::Delaunay));
    assert_eq!(plane(&flat, &[[0, 1, 3], [1, 2, 3]]), None);
    assert_eq!(plane(&flat, &[[1, 0, 3], [1, 2, 3]]), Some(Rule::Orientation));
}

/// Sets a vertex to other coordinates on all ranks that know it.
fn move_vertex(parts: &mut [DistributedMesh], id: u64, point: &[f64]) {
    for part in parts {
        let dim = part.dim;
        for at in (0..part.vertex_ids.len()).filter(|at| part.vertex_ids[*at] == id) {
            part.points[at * dim..][..dim].copy_from_slice(point);
        }
    }
}

/// The facet between ranks whose opposite vertices are both no inputs and off the hull.
fn inner_interface(part: &DistributedMesh) -> (usize, usize) {
    let is_inner = |vertex: u32| part.kinds[vertex as usize] == 1;
    let own = |facet: &InterfaceFacet| part.simplex(facet.simplex)[facet.facet as usize];
    let other = |facet: &InterfaceFacet| {
        let corners = part.ghost(facet.ghost);
        *corners.iter().find(|v| !part.simplex(facet.simplex).contains(v)).unwrap()
    };
    let fits = |facet: &&InterfaceFacet| is_inner(own(facet));
    let facet = part.interface.iter().find(fits).expect("an inner facet");
    (own(facet) as usize, other(facet) as usize)
}

#[test]
fn geometry_is_checked_across_ranks() {
    for dim in [2, 3] {
        // A simplex and all ghosts of it turned inside out.
        assert_broken(dim, Rule::Orientation, 1, |parts| {
            let id = parts[0].first_simplex + parts[0].interface[0].simplex as u64;
            turn(parts, id);
        });
        // A vertex next to an interface is moved just towards the vertex on the other side, on all
        // ranks alike, until a facet is not Delaunay: the topology holds, and what is found is found
        // where the ranks meet.
        let report = assert_broken(dim, Rule::Delaunay, 1, |parts| {
            let (own, other) = inner_interface(&parts[0]);
            let (id, steps) = (parts[0].vertex_ids[own], 200);
            let (from, to) =
                (parts[0].point(own as u32).to_vec(), parts[0].point(other as u32).to_vec());
            for step in 1..steps {
                let share = step as f64 / steps as f64;
                let point: Vec<f64> =
                    from.iter().zip(&to).map(|(a, b)| a + share * (b - a)).collect();
                move_vertex(parts, id, &point);
                let report = certify(parts, 2);
                if report.level < 2 {
                    break;
                }
            }
        });
        assert_eq!(report.first.unwrap().message.split(' ').next(), Some("vertex"));
    }
}

/// Swaps two vertices of a simplex, and what is across from them, on all ranks that have it.
fn turn(parts: &mut [DistributedMesh], id: u64) {
    for part in parts {
        let size = part.dim + 1;
        let own = id.wrapping_sub(part.first_simplex) as usize;
        if own < part.simplex_count() {
            part.simplices.swap(own * size, own * size + 1);
            part.neighbors.swap(own * size, own * size + 1);
            for facet in part.interface.iter_mut().filter(|facet| facet.simplex == own) {
                facet.facet = [1, 0].get(facet.facet as usize).copied().unwrap_or(facet.facet);
            }
            part.interface.sort_by_key(|facet| (facet.simplex, facet.facet));
        }
        if let Ok(ghost) = part.ghosts.binary_search_by_key(&id, |ghost| ghost.id) {
            part.ghost_simplices.swap(ghost * size, ghost * size + 1);
        }
    }
}

/// The two triangles at a facet between ranks become those at the other diagonal: the quadrilateral is
/// strictly convex, so all holds but that they are not Delaunay.
#[test]
fn a_facet_flipped_across_ranks_is_found_by_both() {
    let mut parts = parts(2, &uniform(2, 200), 2, &Options::default());
    let facet = parts[0].interface.iter().copied().find(|facet| is_convex(&parts[0], facet));
    let facet = facet.expect("a facet to flip");
    flip(&mut parts, facet.simplex, facet.facet as usize, facet.ghost);
    let report = certify(&parts, 3);
    let first = report.first.clone().unwrap();
    assert_eq!((first.rule, report.level), (Rule::Delaunay, 1), "{first:?}");
    // The new facet, from each of its sides.
    assert!(report.violations >= 2, "{report:?}");
}

fn turns_left(a: &[f64], b: &[f64], c: &[f64]) -> bool {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 1e-9
}

/// Own a, b, c with the facet b, c and the ghost's d beyond it.
fn corners(part: &DistributedMesh, simplex: usize, slot: usize, ghost: usize) -> [u32; 4] {
    let own = part.simplex(simplex);
    let d = *part.ghost(ghost).iter().find(|v| !own.contains(v)).unwrap();
    [own[slot], own[(slot + 1) % 3], own[(slot + 2) % 3], d]
}

fn is_convex(part: &DistributedMesh, facet: &InterfaceFacet) -> bool {
    let [a, b, c, d] = corners(part, facet.simplex, facet.facet as usize, facet.ghost)
        .map(|vertex| part.point(vertex).to_vec());
    turns_left(&a, &b, &d) && turns_left(&a, &d, &c)
}

/// Both ranks together: the own simplex becomes a, b, d and the other a, d, c. The vertices stay where
/// they are known, but each triangle may leave stars: so both parts are made anew of all simplices.
fn flip(parts: &mut [DistributedMesh], simplex: usize, slot: usize, ghost: usize) {
    let ids = corners(&parts[0], simplex, slot, ghost).map(|v| parts[0].vertex_ids[v as usize]);
    let [a, b, c, d] = ids;
    let (first, second) = (parts[0].first_simplex + simplex as u64, parts[0].ghosts[ghost].id);
    let mut all: Vec<Vec<u64>> = Vec::new();
    let mut points = std::collections::BTreeMap::new();
    for part in parts.iter() {
        let id = |v: &u32| part.vertex_ids[*v as usize];
        all.extend(part.simplices.chunks_exact(3).map(|s| s.iter().map(id).collect::<Vec<_>>()));
        for v in 0..part.vertex_ids.len() {
            let known = (part.point(v as u32).to_vec(), part.kinds[v], part.vertex_domains[v]);
            points.insert(part.vertex_ids[v], known);
        }
    }
    all[first as usize] = vec![a, b, d];
    all[second as usize] = vec![a, d, c];
    let begins = [0, parts[1].first_simplex as usize, all.len()];
    let rank_of = |simplex: usize| u32::from(simplex >= begins[1]);
    let across = |s: usize, slot: usize| {
        let facet = [all[s][(slot + 1) % 3], all[s][(slot + 2) % 3]];
        (0..all.len()).find(|t| *t != s && facet.iter().all(|v| all[*t].contains(v)))
    };
    for rank in 0..2 {
        let part = &mut parts[rank];
        let range = begins[rank]..begins[rank + 1];
        let own: BTreeSet<u64> = all[range.clone()].iter().flatten().copied().collect();
        let is_ghost = |s: &usize| !range.contains(s) && all[*s].iter().any(|v| own.contains(v));
        let ghosts: Vec<usize> = (0..all.len()).filter(is_ghost).collect();
        let others: BTreeSet<u64> = ghosts
            .iter()
            .flat_map(|s| all[*s].iter().copied())
            .filter(|v| !own.contains(v))
            .collect();
        part.vertex_ids = own.iter().chain(&others).copied().collect();
        part.own_vertices = own.len();
        let index: std::collections::BTreeMap<u64, u32> =
            part.vertex_ids.iter().copied().zip(0..).collect();
        part.points = part.vertex_ids.iter().flat_map(|v| points[v].0.clone()).collect();
        part.kinds = part.vertex_ids.iter().map(|v| points[v].1).collect();
        part.vertex_domains = part.vertex_ids.iter().map(|v| points[v].2).collect();
        let in_first = |v: &u64| all[..begins[1]].iter().any(|s| s.contains(v));
        part.vertex_owners = part.vertex_ids.iter().map(|v| u32::from(!in_first(v))).collect();
        part.simplices = range.clone().flat_map(|s| all[s].iter().map(|v| index[v])).collect();
        part.ghosts = ghosts.iter().map(|s| Ghost { id: *s as u64, owner: rank_of(*s) }).collect();
        part.ghost_simplices =
            ghosts.iter().flat_map(|s| all[*s].iter().map(|v| index[v])).collect();
        part.neighbors.clear();
        part.interface.clear();
        for s in range.clone() {
            for slot in 0..3 {
                let other = across(s, slot);
                part.neighbors.push(other.map_or(NO_ID, |other| other as u64));
                if let Some(Ok(ghost)) = other.map(|other| ghosts.binary_search(&other)) {
                    part.interface.push(InterfaceFacet {
                        simplex: s - begins[rank],
                        facet: slot as u32,
                        ghost,
                    });
                }
            }
        }
    }
}

#[test]
fn promises_are_checked() {
    for dim in [2, 3] {
        assert_broken(dim, Rule::InputVertex, 2, |parts| parts[0].inputs[0] += 0.25);
        // An input that moves by one bit is another point.
        assert_broken(dim, Rule::InputVertex, 2, |parts| ulp_up(&mut parts[1].inputs[0]));
        // Zeros compare equal, and have the bits of the first.
        assert_broken(dim, Rule::InputBits, 2, |parts| {
            let zero = |part: &DistributedMesh| {
                let is_zero = |v: &usize| part.point(*v as u32).iter().all(|x| *x == 0.0);
                (0..part.vertex_ids.len()).find(is_zero).map(|v| part.vertex_ids[v])
            };
            let id = parts.iter().find_map(zero).unwrap();
            move_vertex(parts, id, &vec![-0.0; dim]);
        });
        assert_broken(dim, Rule::VertexKind, 2, |parts| set_kind(parts, 0, 1));
        assert_broken(dim, Rule::VertexDomain, 2, |parts| {
            parts.iter_mut().for_each(|part| part.vertex_domains.fill(1 << 40));
        });
        assert_broken(dim, Rule::HullVertex, 2, |parts| {
            let part = &parts[0];
            let slot = part.neighbors.iter().position(|neighbor| *neighbor == NO_ID).unwrap();
            let (simplex, slot) = (slot / (dim + 1), slot % (dim + 1));
            let vertex = part.simplex(simplex)[(slot + 1) % (dim + 1)] as usize;
            let id = part.vertex_ids[vertex];
            set_kind(parts, id, 1);
        });
        assert_broken(dim, Rule::VertexAspect, 2, |parts| {
            parts.iter_mut().for_each(|part| part.promise.quality_bound = 1.1);
        });
        assert_broken(dim, Rule::RadiusEdge, 2, |parts| {
            for part in parts {
                part.promise.quality_bound = 0.6;
                part.promise.criterion = Criterion::RadiusEdge;
            }
        });
        assert_broken(dim, Rule::NotFinished, 2, |parts| {
            for part in parts {
                part.promise.is_finished = true;
                part.totals.domains += 1;
            }
        });
    }
}

fn set_kind(parts: &mut [DistributedMesh], id: u64, kind: u8) {
    for part in parts {
        for at in (0..part.vertex_ids.len()).filter(|at| part.vertex_ids[*at] == id) {
            part.kinds[at] = kind;
        }
    }
}
