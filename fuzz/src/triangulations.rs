//! Equal results, bit for bit.

use netmesh::Triangulation;

/// Asserts that two results differ in nothing but the time they took.
pub fn assert_same(left: &Triangulation, right: &Triangulation) {
    assert!(bits(&left.points) == bits(&right.points), "points differ");
    assert!(left.simplices == right.simplices, "simplices differ");
    assert!(left.neighbors == right.neighbors, "neighbours differ");
    assert!(left.kinds == right.kinds, "kinds differ");
    assert!(left.vertex_domains == right.vertex_domains, "labels differ");
    assert!(left.cage_of == right.cage_of, "cages differ");
    assert!(left.domains == right.domains, "domains differ");
    assert!(left.precision_limited == right.precision_limited, "marks differ");
    assert!(left.below_min_dihedral == right.below_min_dihedral, "slivers differ");
    assert!(left.beyond_bound == right.beyond_bound, "what is beyond the bound differs");
    assert!(left.sizes == right.sizes, "sizes differ");
}

pub fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|x| x.to_bits()).collect()
}
