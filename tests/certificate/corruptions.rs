//! Corruptions of arrays and topology, on meshes made by brute force and on real runs.

use super::meshes::{Case, brute_force, neighbors, pairs, plain, random_points, run};
use super::{assert_sound, assert_violates, report};
use netmesh::NONE;
use netmesh::Triangulation;
use netmesh::options::Options;
use netmesh::validate::ViolationKind as Kind;

/// Sound meshes of several dimensions and origins.
fn cases() -> Vec<Case> {
    vec![
        brute_force(&random_points::<2>(14, 1)),
        brute_force(&random_points::<3>(12, 2)),
        brute_force(&random_points::<4>(10, 3)),
        run(&random_points::<2>(60, 1), &Options::default()),
        run(&pairs::<3>(3, 1e-9, 2), &Options::default()),
    ]
}

/// Corrupts each of the sound meshes and asserts what the checker says.
fn assert_all(kind: Kind, corrupt: impl Fn(&mut Triangulation)) {
    for mut case in cases() {
        corrupt(&mut case.mesh);
        assert_violates(&case, kind);
    }
}

/// A simplex and a slot across which it has a neighbour, with at least one more neighbour.
fn interior_facet(mesh: &Triangulation) -> (usize, usize) {
    let inner = |s: &usize| mesh.neighbors_of(*s).iter().filter(|&&n| n != NONE).count() > 1;
    let s = (mesh.simplex_count() / 2..mesh.simplex_count()).find(inner).unwrap();
    (s, mesh.neighbors_of(s).iter().position(|&n| n != NONE).unwrap())
}

fn is_on_hull(mesh: &Triangulation, vertex: u32) -> bool {
    (0..mesh.simplex_count()).any(|s| {
        let facets = mesh.simplex(s).iter().zip(mesh.neighbors_of(s));
        mesh.simplex(s).contains(&vertex)
            && facets.into_iter().any(|(&v, &n)| n == NONE && v != vertex)
    })
}

/// Removes simplices and relinks the rest; vertices stay.
fn remove_simplices(mesh: &mut Triangulation, remove: impl Fn(&[u32]) -> bool) {
    let per_simplex = mesh.dim + 1;
    let kept: Vec<Vec<u32>> =
        mesh.simplices.chunks(per_simplex).filter(|s| !remove(s)).map(<[u32]>::to_vec).collect();
    mesh.neighbors = neighbors(&kept);
    mesh.simplices = kept.concat();
}

#[test]
fn the_cases_are_sound() {
    cases().iter().for_each(assert_sound);
}

#[test]
fn arrays_of_wrong_length() {
    assert_all(Kind::ArrayLength, |mesh| mesh.points.truncate(mesh.points.len() - 1));
    assert_all(Kind::ArrayLength, |mesh| mesh.cage_of.push(NONE));
    assert_all(Kind::ArrayLength, |mesh| mesh.neighbors.clear());
    assert_all(Kind::ArrayLength, |mesh| {
        mesh.simplices.pop();
        mesh.neighbors.pop();
    });
    assert_all(Kind::ArrayLength, |mesh| {
        mesh.simplices.clear();
        mesh.neighbors.clear();
    });
    assert_all(Kind::ArrayLength, |mesh| mesh.dim = 9);
    assert_all(Kind::ArrayLength, |mesh| mesh.dim = 0);
}

#[test]
fn coordinates_that_are_no_numbers() {
    assert_all(Kind::NonFinite, |mesh| mesh.points[3] = f64::NAN);
    assert_all(Kind::NonFinite, |mesh| mesh.points[0] = f64::INFINITY);
}

#[test]
fn ids_out_of_range() {
    assert_all(Kind::VertexOutOfRange, |mesh| mesh.simplices[4] = mesh.kinds.len() as u32);
    assert_all(Kind::VertexOutOfRange, |mesh| mesh.simplices[0] = NONE);
    assert_all(Kind::NeighborOutOfRange, |mesh| mesh.neighbors[1] = mesh.simplex_count() as u32);
    assert_all(Kind::NeighborOutOfRange, |mesh| mesh.neighbors[0] = 0);
}

#[test]
fn a_vertex_twice_in_a_simplex() {
    assert_all(Kind::RepeatedVertex, |mesh| mesh.simplices[0] = mesh.simplices[1]);
}

#[test]
fn a_vertex_without_its_star() {
    assert_all(Kind::UnusedVertex, |mesh| {
        let inner = (0..mesh.kinds.len() as u32).find(|&v| !is_on_hull(mesh, v));
        let vertex = inner.unwrap_or(0);
        remove_simplices(mesh, |simplex| simplex.contains(&vertex));
    });
}

#[test]
fn a_simplex_twice() {
    assert_all(Kind::DuplicateSimplex, |mesh| {
        let (s, _) = interior_facet(mesh);
        let mut copy = mesh.simplex(s).to_vec();
        copy.swap(0, 1);
        mesh.simplices.extend(copy);
        mesh.neighbors.extend(mesh.neighbors_of(s).to_vec());
    });
}

#[test]
fn a_facet_with_three_simplices() {
    let points: [[f64; 2]; 5] = [[0.0, 0.0], [1.0, 0.0], [0.5, 1.0], [0.5, 2.0], [0.5, -1.0]];
    let fan = [vec![0, 1, 2], vec![0, 1, 3], vec![1, 0, 4]];
    assert_violates(&plain(&points, &fan), Kind::OverfullFacet);
}

#[test]
fn a_dropped_neighbor() {
    assert_all(Kind::MissingNeighbor, |mesh| {
        let (s, slot) = interior_facet(mesh);
        mesh.neighbors[s * (mesh.dim + 1) + slot] = NONE;
    });
}

#[test]
fn a_neighbor_that_does_not_answer() {
    assert_all(Kind::AsymmetricNeighbor, |mesh| {
        let (s, slot) = interior_facet(mesh);
        let stranger = |&t: &usize| t != s && !mesh.neighbors_of(t).contains(&(s as u32));
        let stranger = (0..mesh.simplex_count()).find(stranger).unwrap();
        mesh.neighbors[s * (mesh.dim + 1) + slot] = stranger as u32;
    });
}

#[test]
fn neighbors_across_the_wrong_facets() {
    assert_all(Kind::NeighborFacet, |mesh| {
        let (s, slot) = interior_facet(mesh);
        let row = s * (mesh.dim + 1);
        let other = (slot + 1..=mesh.dim).find(|&i| mesh.neighbors[row + i] != NONE).unwrap();
        mesh.neighbors.swap(row + slot, row + other);
    });
}

#[test]
fn two_pieces() {
    let points = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [5.0, 5.0], [6.0, 5.0], [5.0, 6.0]];
    assert_violates(&plain(&points, &[vec![0, 1, 2], vec![3, 4, 5]]), Kind::Disconnected);
}

#[test]
fn a_hole() {
    let mut holes = 0;
    for mut case in cases() {
        let mesh = &mut case.mesh;
        let inner = |s: &usize| mesh.simplex(*s).iter().all(|&v| !is_on_hull(mesh, v));
        if let Some(hole) = (0..mesh.simplex_count()).find(inner) {
            let hole = mesh.simplex(hole).to_vec();
            remove_simplices(mesh, |simplex| simplex == hole);
            assert_violates(&case, Kind::EulerCharacteristic);
            holes += 1;
        }
    }
    assert!(holes >= 2);
}

#[test]
fn a_strip_that_touches_itself_at_a_vertex() {
    let points = random_points::<2>(6, 1);
    let strip = [vec![0, 1, 2], vec![1, 3, 2], vec![2, 3, 4], vec![3, 5, 4], vec![4, 5, 0]];
    assert_violates(&plain(&points, &strip), Kind::VertexStar);
}

#[test]
fn a_vertex_whose_link_is_a_torus() {
    // The cone over the torus of seven vertices.
    let mut cone = Vec::new();
    for i in 0..7u32 {
        cone.push(vec![i, (i + 1) % 7, (i + 3) % 7, 7]);
        cone.push(vec![i, (i + 3) % 7, (i + 2) % 7, 7]);
    }
    assert_violates(&plain(&random_points::<3>(8, 1), &cone), Kind::VertexLink);
}

#[test]
fn garbage_is_reported_and_not_a_panic() {
    let mut random = crate::random::Random::new(7);
    for case in cases() {
        for _ in 0..200 {
            let mut broken = case.clone();
            let mesh = &mut broken.mesh;
            let mut id = |end: usize| (random.unit() * (end as f64 + 1.0)) as u32;
            for _ in 0..3 {
                let (vertices, simplices) = (mesh.kinds.len(), mesh.simplex_count());
                let entry = id(mesh.simplices.len() - 1) as usize;
                match id(6) {
                    0 => mesh.simplices[entry] = id(vertices),
                    1 => mesh.neighbors[entry] = id(simplices),
                    2 => mesh.vertex_domains[id(vertices - 1) as usize] = id(mesh.domains.len()),
                    3 => mesh.cage_of[id(vertices - 1) as usize] = id(mesh.domains.len()),
                    4 => mesh.points[id(vertices * mesh.dim - 1) as usize] = f64::from(id(9)),
                    _ if mesh.domains.is_empty() => {}
                    _ => {
                        let domain = id(mesh.domains.len() - 1) as usize;
                        mesh.domains[domain].radius *= f64::from(id(4));
                        mesh.domains[domain].parent = id(mesh.domains.len());
                    }
                }
            }
            report(&broken);
            netmesh::quality::measure(&broken.mesh).unwrap();
        }
    }
}
