//! The shipped sample is what its generator makes.

#[path = "../examples/sample/knot.rs"]
mod knot;

use std::collections::HashSet;

#[test]
fn the_sample_can_be_made_again() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../samples/knot_3d.xyz");
    let shipped = std::fs::read_to_string(path).expect("the sample is shipped");
    assert!(shipped == knot::text(), "samples/knot_3d.xyz is not what the generator prints");
}

#[test]
fn the_sample_has_ten_thousand_distinct_points() {
    let text = knot::text();
    assert_eq!(text.lines().count(), 10_000);
    assert_eq!(text.lines().collect::<HashSet<_>>().len(), 10_000);
    assert!(text.lines().all(|line| line.split(' ').count() == 3));
}
