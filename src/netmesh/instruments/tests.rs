//! The constants of Definition 8, and which kind a Steiner point has, at every single insertion.

use crate::complex::VertexId;
use crate::delaunay::Cavity;
use crate::mesh::Inputs;
use crate::netmesh::instruments::features::FeatureSizes;
use crate::netmesh::state::Mesher;
use crate::netmesh::state::facets::floors::Purpose;
use crate::netmesh::state::hierarchy::DomainId;
use crate::netmesh::state::watch::Watch;
use crate::numerics::distance;
use crate::options::Options;
use crate::parameters::Parameters;

/// Returns points of three scales, in pairs 2^-30 apart at the largest one.
fn points(dim: usize, n: usize) -> Vec<f64> {
    let mut state = dim as u64;
    let mut next = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let mut points: Vec<f64> = Vec::new();
    for i in 0..n {
        let scale = 0.5f64.powi([0, 0, 15, 30][i % 4]);
        let twin = (i % 4 == 1).then(|| points.len() - dim);
        for axis in 0..dim {
            let x = scale * (next() - 0.5);
            points.push(twin.map_or(x, |first| points[first + axis] + x * 0.5f64.powi(30)));
        }
    }
    points
}

/// Collects M_Omega, with P_Omega in it, from the labels of all vertices.
fn members<const D: usize>(mesher: &mut Mesher<'_, '_, D>, omega: DomainId) -> Vec<VertexId> {
    let vertices = VertexId::below(mesher.state.delaunay.point_count());
    let inserted: Vec<_> = vertices.filter(|&v| mesher.state.is_inserted(v)).collect();
    let mut members = inserted;
    members.retain(|&v| mesher.state.hierarchy.domain_of(v) == omega);
    for domain in (1..mesher.state.hierarchy.len()).map(DomainId::new) {
        if mesher.state.hierarchy.node(domain).alive
            && mesher.state.hierarchy.parent(domain) == omega
        {
            members.push(mesher.state.hierarchy.node(domain).center);
        }
    }
    members
}

/// Computes the feature sizes by the words of Definition 5.
fn feature_sizes<const D: usize>(
    mesher: &mut Mesher<'_, '_, D>,
    vertex: VertexId,
    omega: DomainId,
) -> FeatureSizes {
    let members = members(mesher, omega);
    let x = *mesher.state.delaunay.point(vertex);
    let second = |of: &dyn Fn(VertexId) -> bool| {
        let set = members.iter().copied().filter(|&v| of(v));
        let mut distances: Vec<f64> =
            set.map(|v| distance(&x, mesher.state.delaunay.point(v))).collect();
        distances.sort_by(f64::total_cmp);
        distances.get(1).copied()
    };
    FeatureSizes { mesh: second(&|_| true), inputs: second(&|v| mesher.state.is_input(v)) }
}

/// Returns f_P / f_M at the vertex that has just gone in; 0 if there are too few inputs.
fn ratio<const D: usize>(mesher: &mut Mesher<'_, '_, D>, vertex: VertexId) -> f64 {
    let omega = mesher.state.hierarchy.domain_of(vertex);
    let sizes = feature_sizes(mesher, vertex, omega);
    assert_eq!(mesher.feature_sizes(vertex, omega).unwrap(), Some(sizes));
    sizes.inputs.map_or(0.0, |inputs| inputs / sizes.mesh.expect("no fewer points than inputs"))
}

/// Numbers of inputs, Steiner points of either kind and cages that the checks have seen.
#[derive(Debug, Default)]
struct Seen {
    inputs: u32,
    corners: u32,
    off_centers: u32,
    cages: u32,
}

/// Runs INSERTINPUT for an input, and checks the constants that it leaves behind.
fn insert<const D: usize>(mesher: &mut Mesher<'_, '_, D>, input: VertexId, seen: &mut Seen) {
    let domains = mesher.state.hierarchy.len();
    mesher.state.stats.insertion_constant_input = 0.0;
    mesher.state.stats.insertion_constant_cage = 0.0;
    mesher.insert_input(input, &mut Cavity::default()).unwrap();
    if mesher.state.hierarchy.cage_of(input).is_valid() {
        return;
    }
    let expected = ratio(mesher, input);
    assert_eq!(mesher.state.stats.insertion_constant_input, expected);
    seen.inputs += u32::from(expected > 0.0);
    if mesher.state.hierarchy.len() == domains + 1
        && mesher.state.hierarchy.node(DomainId::new(domains)).alive
    {
        check_cage(mesher, DomainId::new(domains));
        seen.cages += 1;
    }
}

/// Checks that the constant of a cage is in the range that is possible: a vertex of the cage went
/// in between its centre, which was there, and the vertices that are there now.
fn check_cage<const D: usize>(mesher: &mut Mesher<'_, '_, D>, cage: DomainId) {
    let sphere = mesher.state.parameters.cage_scale * mesher.state.hierarchy.node(cage).radius;
    let (mut least, mut most) = (0.0f64, 0.0f64);
    for vertex in mesher.state.hierarchy.node(cage).cage.clone() {
        let sizes = feature_sizes(mesher, vertex, cage);
        let inputs = sizes.inputs.expect("the centre and the input, or the cage was not needed");
        least = least.max(inputs / (1.1 * sphere));
        most = most.max(inputs / sizes.mesh.expect("the centre is one"));
    }
    let constant = mesher.state.stats.insertion_constant_cage;
    assert!((least..=most).contains(&constant), "{least} {constant} {most}");
}

/// Runs CLEAN, a step at a time, and checks the constant of each.
fn clean<const D: usize>(mesher: &mut Mesher<'_, '_, D>, seen: &mut Seen) {
    while let Some(entry) = mesher.state.refine_list.pop() {
        let simplex = entry.simplex;
        if !mesher.state.delaunay.complex().is_live(simplex) || !mesher.state.is_bad(simplex) {
            continue;
        }
        let corner = mesher.state.delaunay.corner(simplex).expect("a finite simplex");
        let before = (
            mesher.state.stats.far_corners,
            mesher.state.stats.off_centers,
            mesher.state.stats.yields,
        );
        let vertex = VertexId::new(mesher.state.delaunay.point_count());
        mesher.state.stats.insertion_constant_corner = 0.0;
        mesher.refine_corner(simplex, Purpose::Bound, &mut Cavity::default()).unwrap();
        let after = (
            mesher.state.stats.far_corners,
            mesher.state.stats.off_centers,
            mesher.state.stats.yields,
        );
        if after.2 > before.2 || vertex.index() == mesher.state.delaunay.point_count() {
            continue;
        }
        let is_corner = *mesher.state.delaunay.point(vertex) == corner;
        let [far, off] = if is_corner { [1, 0] } else { [0, 1] };
        assert_eq!(after, (before.0 + far, before.1 + off, before.2));
        let expected = ratio(mesher, vertex);
        assert_eq!(mesher.state.stats.insertion_constant_corner, expected);
        seen.corners += far as u32;
        seen.off_centers += off as u32;
    }
}

/// Checks the feature sizes at every vertex in every domain, the centres of children as well.
fn check_feature_sizes<const D: usize>(mesher: &mut Mesher<'_, '_, D>) {
    for omega in (0..mesher.state.hierarchy.len()).map(DomainId::new) {
        if !mesher.state.hierarchy.node(omega).alive {
            continue;
        }
        for vertex in members(mesher, omega) {
            let expected = feature_sizes(mesher, vertex, omega);
            let found = mesher.feature_sizes(vertex, omega).unwrap();
            assert_eq!(found, Some(expected), "{vertex:?} in {omega:?}");
        }
    }
}

fn check<const D: usize>(n: usize) {
    let inputs = Inputs::new(D, n, &points(D, n), 0).unwrap();
    let options = Options { instruments: true, ..Options::default() };
    let parameters = Parameters::resolve(D, &options).unwrap();
    let mut mesher = Mesher::<D>::new(&inputs, parameters, Watch::new(None)).unwrap();
    // The bound of the end, so that there is something to refine.
    mesher.state.stage.bound = mesher.state.parameters.quality_bound;
    mesher.start_netmesh(&mut Cavity::default()).unwrap();
    let mut seen = Seen::default();
    while mesher.state.conflict_lists.remaining() > 0 {
        let lists = mesher.lists_of(&(0..n)).unwrap();
        for input in mesher.select_round(0, 0, &lists).unwrap() {
            if !mesher.state.is_inserted(input) {
                insert(&mut mesher, input, &mut seen);
                clean(&mut mesher, &mut seen);
            }
        }
    }
    check_feature_sizes(&mut mesher);
    let Seen { inputs, corners, off_centers, cages } = seen;
    assert!(inputs > 20 && corners.min(off_centers).min(cages) > 3, "{D}D: {seen:?}");
}

#[test]
fn every_insertion_has_the_ratio_of_definition_8() {
    check::<2>(160);
    check::<3>(120);
    check::<4>(80);
}
