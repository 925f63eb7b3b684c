//! A mesh is a function of its points and options: the same bytes every time, in this process and
//! in any other. The bytes themselves are nobody's promise; a better algorithm may give others.

use crate::random::Random;
use netmesh::validate::validate;
use netmesh::{Algorithm, Inputs, Mesh, NetOrdering, Options, Output, Triangulation};

/// Points in general position, some of them close together so that there are cages.
fn points(dim: usize, n: usize) -> Vec<f64> {
    let mut random = Random::new(dim as u64);
    (0..n)
        .flat_map(|i| {
            let scale = if i % 3 == 0 { 1e-9 } else { 1.0 };
            (0..dim).map(|_| scale * random.unit()).collect::<Vec<_>>()
        })
        .collect()
}

fn run(dim: usize, points: &[f64], options: &Options) -> Triangulation {
    let mut mesh = Mesh::new(dim, points.len() / dim, points, 0).unwrap();
    mesh.run(options, None).unwrap();
    mesh.triangulation().unwrap().clone()
}

/// Every array, doubles as bits.
fn assert_same_bytes(a: &Triangulation, b: &Triangulation, condition: &str) {
    let bits = |values: &[f64]| values.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
    assert!(bits(&a.points) == bits(&b.points), "points, {condition}");
    assert!(a.simplices == b.simplices, "simplices, {condition}");
    assert!(a.neighbors == b.neighbors, "neighbors, {condition}");
    assert!(a.kinds == b.kinds, "kinds, {condition}");
    assert!(a.vertex_domains == b.vertex_domains, "labels, {condition}");
    assert!(a.precision_limited == b.precision_limited, "precision-limited cells, {condition}");
    let domains = |mesh: &Triangulation| {
        let all = mesh.domains.iter();
        all.map(|d| (d.center, d.parent, d.radius.to_bits())).collect::<Vec<_>>()
    };
    assert!(domains(a) == domains(b), "domains, {condition}");
}

/// So many inputs are meshed in parts, each on a thread of its own.
#[test]
fn a_large_mesh_does_not_depend_on_the_threads_that_made_it() {
    let points = points(2, 530_000);
    let one = run(2, &points, &Options::default());
    let many = run(2, &points, &Options { threads: 5, ..Options::default() });
    assert_same_bytes(&one, &many, "5 threads");
    let inputs = Inputs::new(2, 530_000, &points, 0).unwrap();
    assert_eq!(validate(&inputs, &one, 3).unwrap().level, 3);
}

#[test]
fn the_same_input_and_options_give_the_same_bytes() {
    for (dim, n) in [(2, 400), (3, 100), (4, 30)] {
        let points = points(dim, n);
        for output in [Output::Hierarchical, Output::WellSpaced] {
            let options = Options { output, ..Options::default() };
            let first = run(dim, &points, &options);
            assert!(first.simplex_count() > 0);
            let again = run(dim, &points, &options);
            assert_same_bytes(&first, &again, &format!("{dim}D {output:?}, again"));
            for threads in [0, 3] {
                let threaded = run(dim, &points, &Options { threads, ..options.clone() });
                let condition = format!("{dim}D {output:?}, {threads} threads");
                assert_same_bytes(&first, &threaded, &condition);
            }
        }
    }
}

/// Nothing of the first run is left in a mesh that is run again.
#[test]
fn a_second_run_gives_the_bytes_of_a_first_one() {
    let points = points(3, 80);
    let finished = Options { output: Output::WellSpaced, ..Options::default() };
    let expected = run(3, &points, &Options::default());
    let mut mesh = Mesh::new(3, 80, &points, 0).unwrap();
    for options in [&Options::default(), &finished, &Options::default()] {
        mesh.run(options, None).unwrap();
    }
    assert_same_bytes(mesh.triangulation().unwrap(), &expected, "after other runs");
}

/// Neighbouring seeds too: half of them would be no use to who draws several meshes.
#[test]
fn every_seed_has_a_mesh_of_its_own() {
    let points = points(3, 600);
    let simplices = |seed| run(3, &points, &Options { seed, ..Options::default() }).simplices;
    let meshes: Vec<_> = [0, 1, 2, 3, 1 << 63].map(simplices).into();
    for (first, mesh) in meshes.iter().enumerate() {
        let equal = meshes.iter().rposition(|other| other == mesh);
        assert_eq!(equal, Some(first), "seeds of meshes {first} and {equal:?}");
    }
}

/// The deterministic ordering uses no random number: the seed changes nothing, and each round
/// halves the longest list.
#[test]
fn the_deterministic_ordering_has_no_seed() {
    let kinds = [
        (Algorithm::Netmesh, Output::Hierarchical),
        (Algorithm::Netmesh, Output::WellSpaced),
        (Algorithm::Delaunay, Output::Hierarchical),
    ];
    for (dim, n) in [(2, 3000), (3, 600), (4, 100)] {
        let points = points(dim, n);
        for (algorithm, output) in kinds {
            let ordering = NetOrdering::DeterministicNet;
            let options = Options { algorithm, output, ordering, ..Options::default() };
            let condition = format!("{dim}D {algorithm:?} {output:?}");
            let first = run(dim, &points, &options);
            let cages = first.domains.len() > 1 || output == Output::WellSpaced;
            assert!(cages || algorithm == Algorithm::Delaunay, "{condition}: no cage to be turned");
            let other = run(dim, &points, &Options { seed: 12345, ..options.clone() });
            assert_same_bytes(&first, &other, &condition);
            let most = (n as f64).log2() as u64 + 2;
            let rounds = first.stats.rounds;
            // More than one, or every list was exhausted at once and there was no net.
            assert!((rounds > 1 || dim == 4) && rounds <= most, "{condition}: {rounds} rounds");
            let inputs = Inputs::new(dim, n, &points, 0).unwrap();
            let report = validate(&inputs, &first, 3).unwrap();
            assert_eq!(report.level, 3, "{condition}: {:?}", report.first);
        }
    }
}
