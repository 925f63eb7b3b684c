//! Corruptions of regions between facets, of the domain that these enclose, and of what is said of
//! simplices at facets.

use super::facets::{corrupted, remove_subfacet};
use super::shapes::{boxes, cube, shell, turned_cube, wedge};
use netmesh::Region;
use netmesh::options::{Extent, Interior};
use netmesh::validate::ViolationKind as Kind;

#[test]
fn labels_that_are_not_their_regions() {
    let solid = boxes();
    for simplex in (0..solid.clone().whole().simplex_count()).step_by(97) {
        corrupted(&solid, Kind::RegionLabel, |mesh| mesh.boundary.simplex_regions[simplex] += 1);
    }
    corrupted(&solid, Kind::RegionLabel, |mesh| {
        let labels = mesh.boundary.simplex_regions.iter_mut();
        labels.filter(|label| **label == 7).for_each(|label| *label = 8);
    });
    let mut twice = solid.clone();
    twice.regions.push(Region { seed: [1.2, 2.4, 1.3], label: 7, ..Region::default() });
    twice.assert_violates(Kind::RegionLabel);
    let mut outside = solid.clone();
    outside.regions.push(Region { seed: [0.5, 0.5, 0.5], ..Region::default() });
    outside.assert_violates(Kind::RegionLabel);
}

#[test]
fn domains_that_are_not_what_facets_enclose() {
    let solid = boxes();
    let count = solid.case.mesh.simplex_count();
    for count in [count - 1, count + 1] {
        let mut other = solid.clone();
        other.crop(count);
        other.assert_violates(Kind::DomainEnd);
    }
    let mut all = solid.clone();
    let whole = all.whole().simplex_count();
    all.crop(whole);
    all.assert_violates(Kind::DomainPlace);
    let mut hole = solid.clone();
    hole.regions[0].is_hole = true;
    hole.assert_violates(Kind::DomainPlace);
    let mut extent = solid.clone();
    extent.corrupt(|mesh| mesh.parameters.extent = Extent::All);
    extent.assert_violates(Kind::DomainPlace);
}

#[test]
fn surfaces_tell_what_is_inside() {
    for interior in [Interior::Winding, Interior::Parity] {
        let mut solid = shell(true);
        solid.corrupt(|mesh| mesh.parameters.interior = interior);
        solid.assert_sound(3);
        let mut filled = shell(false);
        filled.corrupt(|mesh| mesh.parameters.interior = interior);
        match interior {
            Interior::Winding => filled.assert_sound(3),
            _ => filled.assert_violates(Kind::DomainPlace),
        }
        // A side is missing.
        let mut open = shell(true);
        open.corrupt(|mesh| {
            mesh.parameters.interior = interior;
            while mesh.boundary.subfacet_parents.last() == Some(&11) {
                let last = mesh.boundary.subfacets.len() - 1;
                remove_subfacet(mesh, last);
            }
        });
        let first = open.report(3).first.unwrap();
        assert_eq!(first.kind, Kind::FacetTiling);
        open.facets.markers.pop();
        open.facets.loop_starts.pop();
        open.assert_violates(Kind::DomainEnd);
    }
    // A side that points the other way.
    let mut turned = shell(true);
    turned.facets.inputs[0..4].reverse();
    turned.corrupt(|mesh| {
        mesh.parameters.interior = Interior::Winding;
        let own = mesh.boundary.subfacet_parents.iter().take_while(|&&parent| parent == 0).count();
        mesh.boundary.subfacets[..own].iter_mut().for_each(|vertices| vertices.swap(0, 1));
    });
    turned.find_sides();
    turned.assert_violates(Kind::DomainPlace);
}

#[test]
fn flat_simplices_that_are_not() {
    corrupted(&cube(), Kind::FlatSimplex, |mesh| mesh.boundary.flat = vec![1]);
    corrupted(&boxes(), Kind::FlatSimplex, |mesh| mesh.boundary.flat = vec![0, 3]);
    let solid = turned_cube(4);
    for at in (0..solid.clone().whole().boundary.flat.len()).step_by(5) {
        corrupted(&solid, Kind::FlatSimplex, |mesh| _ = mesh.boundary.flat.remove(at));
    }
}

#[test]
fn forced_simplices_lie_at_small_angles() {
    wedge(20.0, &[]).assert_sound(3);
    for simplex in 0..3 {
        wedge(20.0, &[simplex]).assert_sound(3);
        let mut within_bound = wedge(20.0, &[simplex]);
        within_bound.corrupt(|mesh| mesh.parameters.quality_bound = 1e9);
        within_bound.assert_violates(Kind::ForcedSimplex);
    }
    let mut solid = cube();
    solid.corrupt(|mesh| {
        mesh.parameters.quality_bound = 0.62;
        mesh.boundary.forced = vec![0];
    });
    solid.assert_violates(Kind::ForcedSimplex);
}
