//! A mesh is a function of its points and options: the same bytes every time, in this process and in
//! any other. The bytes themselves are nobody's promise; a better algorithm may give others.

use netmesh::{Mesh, Options, Output, Triangulation};

/// Points in general position, some of them close together so that there are cages.
fn points(dim: usize, n: usize) -> Vec<f64> {
    let mut state = dim as u64;
    let mut next = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    (0..n)
        .flat_map(|i| {
            let scale = if i % 3 == 0 { 1e-9 } else { 1.0 };
            (0..dim).map(|_| scale * next()).collect::<Vec<_>>()
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
