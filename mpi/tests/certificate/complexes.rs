//! Small meshes without inputs that are no triangulations, on any number of ranks: each simplex may
//! be another's, so what is broken is often broken between them.

use super::made::certify;
use super::whole::Whole;
use netmesh_mpi::certificate::ViolationKind;

/// Returns the rule that is broken first, on one rank and on as many as there are simplices.
fn broken<const D: usize, const N: usize>(
    points: &[[f64; D]],
    simplices: &[[u64; N]],
) -> Option<ViolationKind> {
    let whole = Whole::new(points, simplices);
    let on = |ranks| certify(&whole.shared_out(ranks), 3).first.map(|first| first.kind);
    let rule = on(1);
    (2..=simplices.len()).for_each(|ranks| assert_eq!(on(ranks), rule, "on {ranks} ranks"));
    rule
}

const RING: [[f64; 2]; 8] = [
    [-3.0, -3.0],
    [3.0, -3.0],
    [3.0, 3.0],
    [-3.0, 3.0],
    [-1.0, -1.0],
    [1.0, -1.0],
    [1.0, 1.0],
    [-1.0, 1.0],
];

fn annulus() -> Vec<[u64; 3]> {
    let side = |i: u64| {
        let j = (i + 1) % 4;
        [[i, j, 4 + i], [j, 4 + j, 4 + i]]
    };
    (0..4).flat_map(side).collect()
}

#[test]
fn complexes_that_are_no_ball() {
    let bow = [[0.0, 0.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]];
    assert_eq!(broken(&bow, &[[0, 1, 2], [0, 3, 4]]), Some(ViolationKind::VertexStar));
    assert_eq!(broken(&RING, &annulus()), Some(ViolationKind::EulerCharacteristic));
    let filled = [annulus().as_slice(), &[[4, 5, 6], [4, 6, 7]]].concat();
    assert_eq!(broken(&RING, &filled), None);
    let fan = [[0.0, 0.0], [1.0, 0.0], [0.5, 1.0], [0.5, 2.0], [0.5, -1.0]];
    assert_eq!(
        broken(&fan, &[[0, 1, 2], [0, 1, 3], [1, 0, 4]]),
        Some(ViolationKind::OverfullFacet)
    );
    assert_eq!(broken(&fan[..3], &[[0, 1, 2], [0, 1, 2]]), Some(ViolationKind::DuplicateSimplex));
    // A cone over the annulus: the link of its apex is that.
    let mut points = RING.map(|[x, y]| [x, y, 0.0]).to_vec();
    points.push([0.0, 0.0, 5.0]);
    let cone: Vec<[u64; 4]> = annulus().iter().map(|&[a, b, c]| [a, b, c, 8]).collect();
    assert_eq!(broken(&points, &cone), Some(ViolationKind::VertexLink));
    let unit = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    assert_eq!(broken(&unit, &[[0, 1, 2, 3], [0, 1, 2, 3]]), Some(ViolationKind::DuplicateSimplex));
}

#[test]
fn complexes_that_are_not_delaunay() {
    let dart = [[0.0, 0.0], [1.0, 0.0], [0.1, 0.1], [0.0, 1.0]];
    assert_eq!(broken(&dart, &[[0, 1, 2], [0, 2, 3]]), Some(ViolationKind::NonConvexHull));
    let fold = [[0.0, 0.0], [1.0, 0.0], [0.5, 1.0], [0.5, 2.0]];
    assert_eq!(broken(&fold, &[[0, 1, 2], [0, 1, 3]]), Some(ViolationKind::FoldedFacet));
    let flat = [[0.0, 0.0], [4.0, -1.0], [8.0, 0.0], [4.0, 1.0]];
    assert_eq!(broken(&flat, &[[0, 1, 2], [0, 2, 3]]), Some(ViolationKind::Delaunay));
    assert_eq!(broken(&flat, &[[0, 1, 3], [1, 2, 3]]), None);
    assert_eq!(broken(&flat, &[[1, 0, 3], [1, 2, 3]]), Some(ViolationKind::Orientation));
    // Two tetrahedra with a base in common, whose apices are over one of its edges; and upright.
    let bases = |lean: f64| {
        let apex = |z: f64| [2.0 - 3.0 * lean, 0.5 - lean, z];
        [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [2.0, 3.0, 0.0], apex(3.0), apex(-3.0)]
    };
    let pair = [[0, 1, 2, 3], [0, 2, 1, 4]];
    assert_eq!(broken(&bases(0.0), &pair), None);
    assert_eq!(broken(&bases(1.0), &pair), Some(ViolationKind::NonConvexHull));
}
