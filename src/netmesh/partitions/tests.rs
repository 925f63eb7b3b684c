use crate::complex::VertexId;
use crate::delaunay::Cavity;
use crate::error::ErrorKind;
use crate::mesh::{Inputs, Triangulation};
use crate::netmesh::state::Mesher;
use crate::netmesh::state::watch::Watch;
use crate::netmesh::{Dimension, mesh};
use crate::numerics::testing::Random;
use crate::options::{Criterion, NetOrdering, Options, Output, Phase, Progress};
use crate::parameters::Parameters;
use crate::validate::validate;

/// Inputs of a partition in these tests, where a mesh of some thousands has several.
const INPUTS_PER_PARTITION: usize = 800;

fn inputs<const D: usize>(points: &[[f64; D]]) -> Inputs {
    Inputs::new(D, points.len(), points.as_flattened(), 0).unwrap()
}

fn parameters(dim: usize, options: &Options, threads: u32) -> Parameters {
    let resolved = Parameters::resolve(dim, options).unwrap();
    Parameters { threads, inputs_per_partition: Some(INPUTS_PER_PARTITION), ..resolved }
}

fn run<const D: usize>(inputs: &Inputs, options: &Options, threads: u32) -> Triangulation
where
    for<'a, 'b> Mesher<'a, 'b, D>: Dimension,
{
    mesh::<D>(inputs, None, parameters(D, options, threads), None, None).unwrap()
}

/// Runs a mesher until partitions have joined.
fn insert_in_partitions<const D: usize>(mesher: &mut Mesher<'_, '_, D>) {
    let mut cavity = Cavity::default();
    mesher.start_netmesh(&mut cavity).unwrap();
    mesher.insert_coarse_rounds(&mut cavity).unwrap();
    mesher.insert_in_partitions(&mut cavity).unwrap();
}

fn assert_same(a: &Triangulation, b: &Triangulation) {
    assert_eq!(a.simplices, b.simplices);
    assert_eq!(a.neighbors, b.neighbors);
    assert_eq!(bits(&a.points), bits(&b.points));
    assert_eq!(a.kinds, b.kinds);
    assert_eq!(a.vertex_domains, b.vertex_domains);
    assert_eq!(a.cage_of, b.cage_of);
    assert_eq!(a.domains, b.domains);
    assert_eq!(a.precision_limited, b.precision_limited);
    assert_eq!(a.below_min_dihedral, b.below_min_dihedral);
    assert_eq!(a.beyond_bound, b.beyond_bound);
    assert_eq!(a.sizes, b.sizes);
    let stats = |mesh: &Triangulation| crate::mesh::Stats { seconds: 0.0, ..mesh.stats };
    assert_eq!(stats(a), stats(b));
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

/// Checks that the mesh is the same on one thread and on three, has a certificate, and is about as
/// large as that made as one, but another: so it was made in partitions.
fn check<const D: usize>(points: &[[f64; D]], options: &Options)
where
    for<'a, 'b> Mesher<'a, 'b, D>: Dimension,
{
    let inputs = inputs(points);
    let one = run::<D>(&inputs, options, 1);
    assert_same(&one, &run::<D>(&inputs, options, 3));
    let report = validate(&inputs, &one, 3).unwrap();
    assert_eq!(report.level, 3, "{report:?}");
    assert_eq!(one.stats.input_vertices as usize, points.len());
    let undivided = Parameters::resolve(D, options).unwrap();
    assert!(points.len() < 2 * undivided.inputs_per_partition.unwrap());
    let undivided = mesh::<D>(&inputs, None, undivided, None, None).unwrap();
    assert_ne!(bits(&one.points), bits(&undivided.points));
    let ratio = one.vertex_count() as f64 / undivided.vertex_count() as f64;
    assert!((0.9..1.1).contains(&ratio), "{ratio} times the vertices");
}

fn scattered<const D: usize>(count: usize, seed: u64) -> Vec<[f64; D]> {
    let mut random = Random(seed);
    (0..count).map(|_| std::array::from_fn(|_| random.unit())).collect()
}

/// Returns pairs of points that are 2^-30 apart: a cage to every pair, many of them at interfaces.
fn pairs<const D: usize>(count: usize) -> Vec<[f64; D]> {
    let near = |point: &[f64; D], shift: f64| point.map(|x| x + shift);
    let points = scattered::<D>(count / 2, 5);
    points.iter().flat_map(|point| [*point, near(point, 2f64.powi(-30))]).collect()
}

/// Returns pairs of neighbouring doubles, which leave no room for a cage's vertices.
fn neighbors<const D: usize>(count: usize) -> Vec<[f64; D]> {
    let points = scattered::<D>(count / 2, 8);
    points.iter().flat_map(|point| [*point, point.map(f64::next_up)]).collect()
}

/// Returns clusters within clusters: the domains that hold them are cut.
fn nested<const D: usize>(levels: i32, count: usize) -> Vec<[f64; D]> {
    let shells = (0..levels).flat_map(|level| {
        let size = 2f64.powi(-8 * level);
        scattered::<D>(count, 10 + level as u64)
            .into_iter()
            .map(move |point| point.map(|x| size * x))
    });
    shells.collect()
}

/// Returns dense clusters, each large enough to be cut, with points at all distances around them:
/// those encroach domains of more partitions than one, from inside and from outside.
fn halos<const D: usize>(clusters: usize, count: usize) -> Vec<[f64; D]> {
    let mut random = Random(9);
    let mut points = Vec::new();
    for _ in 0..clusters {
        let center: [f64; D] = std::array::from_fn(|_| random.unit());
        for i in 0..count {
            let size = if i % 3 == 0 { 2f64.powf(-30.0 * random.unit()) } else { 2f64.powi(-30) };
            let offset: [f64; D] = std::array::from_fn(|_| random.unit() - 0.5);
            points.push(std::array::from_fn(|axis| center[axis] + size * offset[axis]));
        }
    }
    points
}

fn grid<const D: usize>(side: usize) -> Vec<[f64; D]> {
    let point = |at: usize| std::array::from_fn(|axis| (at / side.pow(axis as u32) % side) as f64);
    (0..side.pow(D as u32)).map(point).collect()
}

#[test]
fn uniform_points() {
    check::<2>(&scattered(8000, 1), &Options::default());
    check::<3>(&scattered(6000, 2), &Options::default());
}

/// The slivers that are mended depend neither on the number of threads nor on the order in which
/// they end.
#[test]
fn slivers_of_partitions_are_mended_alike_on_any_number_of_threads() {
    let points = [scattered::<3>(3000, 3), grid(12)].concat();
    for output in [Output::WellSpaced, Output::Hierarchical] {
        let criterion = Criterion::RadiusEdge;
        let options = Options { output, criterion, min_dihedral: 15.0, ..Options::default() };
        check(&points, &options);
        let inputs = inputs(&points);
        let two = run::<3>(&inputs, &options, 2);
        // Some beside cages stay.
        assert!(two.below_min_dihedral.is_empty() || output == Output::Hierarchical);
        assert_same(&two, &run::<3>(&inputs, &options, 16));
    }
}

#[test]
fn sizes_do_not_depend_on_threads() {
    let sized = |max_edge| Options { output: Output::WellSpaced, max_edge, ..Options::default() };
    check::<2>(&scattered(4000, 3), &sized(0.04));
    check::<3>(&scattered(3000, 4), &sized(0.2));
}

#[test]
fn a_cage_to_every_pair() {
    check::<2>(&pairs(2400), &Options::default());
    check::<3>(&pairs(2000), &Options::default());
}

#[test]
fn where_doubles_run_out() {
    check::<2>(&neighbors(2000), &Options::default());
    check::<3>(&neighbors(1600), &Options::default());
}

#[test]
fn clusters_that_are_cut() {
    check::<2>(&nested(8, 700), &Options::default());
    check::<3>(&nested(6, 700), &Options::default());
}

#[test]
fn domains_of_several_partitions() {
    let options = Options { epsilon: 0.6, ..Options::default() };
    check::<2>(&halos(3, 2000), &options);
    check::<3>(&halos(2, 2000), &Options::default());
}

/// Several partitions narrow the gaps of one cage.
#[test]
fn a_cage_has_the_vertices_that_partitions_add() {
    let inputs = inputs(&[nested::<3>(3, 1500), halos(3, 1500)].concat());
    let parameters = parameters(3, &Options::default(), 1);
    let mut mesher = Mesher::<3>::new(&inputs, parameters, Watch::new(None)).unwrap();
    insert_in_partitions(&mut mesher);
    let hierarchy = &mesher.state.hierarchy;
    for vertex in VertexId::below(mesher.state.delaunay.point_count()) {
        let cage = hierarchy.cage_of(vertex);
        assert!(!cage.is_valid() || hierarchy.node(cage).cage.contains(&vertex), "{vertex:?}");
    }
}

#[test]
fn cospherical_points() {
    check::<2>(&grid(70), &Options::default());
    check::<3>(&grid(16), &Options::default());
}

/// FINISHMESH where cages, or what they grow into, belong to several partitions.
#[test]
fn cages_are_dissolved() {
    let well_spaced = Options { output: Output::WellSpaced, ..Options::default() };
    check(&nested::<2>(4, 1000), &well_spaced);
    check(&nested::<3>(3, 700), &well_spaced);
    check(&pairs::<2>(1600), &well_spaced);
    check(&halos::<2>(2, 1500), &well_spaced);
}

/// The global mesh has few cages to dissolve, and few simplices to refine.
#[test]
fn partitions_dissolve_most_cages() {
    let points = [scattered::<2>(20_000, 3), pairs(400)].concat();
    let options = Options { output: Output::WellSpaced, ..Options::default() };
    let parameters = Parameters {
        inputs_per_partition: Some(5_000),
        ..Parameters::resolve(2, &options).unwrap()
    };
    let inputs = inputs(&points);
    let mut mesher = Mesher::<2>::new(&inputs, parameters, Watch::new(None)).unwrap();
    insert_in_partitions(&mut mesher);
    let stats = &mesher.state.stats;
    assert!(stats.cages_created > 200 && stats.cages_grown > 200, "{stats:?}");
    let left = stats.cages_created - stats.cages_released;
    assert!(left < stats.cages_created / 10, "{left} of {}", stats.cages_created);
    let refined = mesher.state.delaunay.point_count();
    let mut cavity = Cavity::default();
    mesher.insert_rounds(&mut cavity).unwrap();
    mesher.finish_mesh(&mut cavity).unwrap();
    mesher.refine_finally(&mut cavity).unwrap();
    let all = mesher.state.delaunay.point_count();
    assert!(10 * (all - refined) < all, "{refined} vertices of {all} after partitions");
}

#[test]
fn other_options() {
    let points = scattered::<2>(5000, 3);
    let well_spaced = Options { output: Output::WellSpaced, ..Options::default() };
    check(&points, &well_spaced);
    check(&points, &Options { ordering: NetOrdering::DeterministicNet, ..Options::default() });
    check(&points, &Options { criterion: Criterion::RadiusEdge, ..Options::default() });
    check(&points, &Options { instruments: true, ..Options::default() });
}

/// Meshes in 4D are not divided: most of one would be at interfaces.
#[test]
fn higher_dimensions_go_as_one() {
    let inputs = inputs(&scattered::<4>(800, 4));
    let parameters = |inputs_per_partition| Parameters {
        inputs_per_partition: Some(inputs_per_partition),
        ..Parameters::resolve(4, &Options::default()).unwrap()
    };
    let [a, b] = [100, 1 << 20]
        .map(|partition| mesh::<4>(&inputs, None, parameters(partition), None, None).unwrap());
    assert_eq!(a.simplices, b.simplices);
}

#[test]
fn the_limit_is_that_of_the_global_mesh() {
    let inputs = inputs(&scattered::<2>(8000, 6));
    let size = run::<2>(&inputs, &Options::default(), 1).vertex_count() as u64;
    for threads in [1, 2] {
        let limited = |max_vertices| {
            let options = Options { max_vertices, ..Options::default() };
            mesh::<2>(&inputs, None, parameters(2, &options, threads), None, None)
                .map(|mesh| mesh.vertex_count())
        };
        assert_eq!(limited(size).unwrap() as u64, size);
        for most in [size - 1, size / 2 + 4000] {
            assert_eq!(limited(most).unwrap_err().kind(), ErrorKind::Limit);
        }
    }
}

/// The fraction that the caller is told rises, and the caller can end the run at any time.
#[test]
fn runs_in_partitions_are_watched() {
    let inputs = inputs(&scattered::<3>(15_000, 7));
    for threads in [1, 2] {
        let mut calls: Vec<Progress> = Vec::new();
        let mut watch = |progress: &Progress| {
            calls.push(*progress);
            true
        };
        let options = parameters(3, &Options::default(), threads);
        let mesh_of = mesh::<3>(&inputs, None, options.clone(), None, Some(&mut watch)).unwrap();
        for pair in calls.windows(2) {
            assert!(pair[0].fraction <= pair[1].fraction);
            assert!(pair[0].inputs_inserted <= pair[1].inputs_inserted);
        }
        let last = calls.last().unwrap();
        assert_eq!(last.inputs_inserted, 15_000);
        assert_eq!(last.vertices as usize, mesh_of.vertex_count());
        // Some of them are in the coarse mesh and at interfaces, which are made before partitions.
        for most in [2_500, 6_000, 12_500] {
            let mut stop = |progress: &Progress| progress.inputs_inserted < most;
            let error =
                mesh::<3>(&inputs, None, options.clone(), None, Some(&mut stop)).unwrap_err();
            assert_eq!(error.kind(), ErrorKind::Cancelled);
        }
    }
}

/// The fraction that the caller is told goes on to rise after the partitions, and slivers have the
/// part of it from 0.4 on.
#[test]
fn progress_goes_on_after_partitions() {
    let inputs = inputs(&scattered::<3>(5000, 7));
    for output in [Output::Hierarchical, Output::WellSpaced] {
        let options = Options { output, min_dihedral: 15.0, ..Options::default() };
        let mut reports = Vec::new();
        let mut watch = |progress: &Progress| {
            reports.push((progress.phase, progress.fraction));
            true
        };
        let parameters = parameters(3, &options, 2);
        mesh::<3>(&inputs, None, parameters, None, Some(&mut watch)).unwrap();
        assert!(reports.is_sorted_by_key(|&(_, fraction)| fraction), "{reports:?}");
        assert_eq!(reports.last(), Some(&(Phase::Export, 1.0)));
        let inserting = reports.iter().filter(|&&(phase, _)| phase == Phase::Insert);
        let highest = inserting.fold(0.0, |highest, &(_, fraction)| fraction.max(highest));
        assert!((0.24..0.4).contains(&highest), "{highest} {output:?}");
        let of_slivers = reports.iter().filter(|&&(_, fraction)| 0.4001 < fraction);
        let growing = of_slivers.filter(|&&(_, fraction)| fraction < 0.9999);
        assert!(growing.count() > 0, "{output:?} {reports:?}");
    }
}

/// Only inputs at interfaces are left for the global mesh; those were inserted before, as long as
/// simplices there were large.
#[test]
fn few_inputs_wait_for_the_global_mesh() {
    fn check<const D: usize>(count: usize, most: f64) {
        let inputs = inputs(&scattered::<D>(count, 12));
        let resolved = Parameters::resolve(D, &Options::default()).unwrap();
        let parameters = Parameters { inputs_per_partition: Some(count / 4), ..resolved };
        let mut mesher = Mesher::<D>::new(&inputs, parameters, Watch::new(None)).unwrap();
        let mut cavity = Cavity::default();
        mesher.start_netmesh(&mut cavity).unwrap();
        mesher.insert_coarse_rounds(&mut cavity).unwrap();
        let coarse = count - mesher.state.conflict_lists.remaining();
        assert!(coarse < count / 20, "{coarse} of {count} in the coarse mesh");
        mesher.insert_in_partitions(&mut cavity).unwrap();
        let waiting = mesher.state.conflict_lists.remaining() as f64 / count as f64;
        assert!(waiting < most, "{waiting} of the inputs wait");
    }
    check::<2>(40_000, 0.01);
    check::<3>(40_000, 0.08);
}
