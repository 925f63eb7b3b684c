//! Tilings of facets beside another judge of them, with the integers of another library: over each
//! of many points that are on no edge, as many triangles of a facet lie as its loops say.

use super::shapes::{boxes, sheet};
use super::solids::Solid;
use crate::random::Random;
use dashu_int::IBig;
use netmesh::validate::ViolationKind as Kind;

/// Numbers of sixteenths, of 2^-52 each: sums of points are exact.
type Place = [IBig; 2];

const UNIT: i32 = -56;

/// Returns a coordinate of magnitude below 2^8 in units.
fn whole(x: f64) -> IBig {
    let (high, low) = (x.trunc(), x - x.trunc());
    let low = low * 2f64.powi(-UNIT);
    assert_eq!(low, low.trunc(), "{x} is no number of units");
    (IBig::from(high as i64) << -UNIT as usize) + IBig::from(low as i64)
}

fn place(solid: &Solid, axes: [usize; 2], vertex: u32) -> Place {
    axes.map(|axis| whole(solid.case.mesh.point(vertex)[axis]))
}

fn turn(a: &Place, b: &Place, c: &Place) -> IBig {
    (&b[0] - &a[0]) * (&c[1] - &a[1]) - (&b[1] - &a[1]) * (&c[0] - &a[0])
}

/// Returns true if a point is left of an edge that passes it on the way up, or of one on the way
/// down: crossings of a ray. The point is level with no vertex.
fn crosses(a: &Place, b: &Place, p: &Place) -> bool {
    let is_up = a[1] < p[1] && p[1] < b[1];
    let is_down = b[1] < p[1] && p[1] < a[1];
    let is_left = turn(a, b, p) > IBig::ZERO;
    is_up && is_left || is_down && !is_left
}

/// Returns the triangles of a facet, without the axis of its normal.
fn triangles(solid: &Solid, number: u32, axes: [usize; 2]) -> Vec<[Place; 3]> {
    let boundary = match &solid.case.mesh.boundary.whole {
        Some(whole) => &whole.boundary,
        None => &solid.case.mesh.boundary,
    };
    let own = boundary.subfacets.iter().zip(&boundary.subfacet_parents);
    let own = own.filter(|(_, parent)| **parent == number).map(|(vertices, _)| vertices);
    own.map(|vertices| vertices.map(|vertex| place(solid, axes, vertex))).collect()
}

/// Returns points that are level with no vertex, which are all multiples of 16 units: one in each
/// of some triangles, and others.
fn probes(triangles: &[[Place; 3]], random: &mut Random) -> Vec<Place> {
    let off = |x: IBig| x + IBig::from(3);
    let within = |[a, b, c]: &[Place; 3]| -> Place {
        [0, 1].map(|k| off((&a[k] + &a[k] + &b[k] + &c[k]) / IBig::from(4)))
    };
    let one = IBig::ONE << -UNIT as usize;
    let mut anywhere = || -> Place {
        [0, 1].map(|_| {
            // From -1 to 6.
            let steps = IBig::from((random.unit() * 7.0 * 2f64.powi(20)) as i64);
            off((steps << (-UNIT - 20) as usize) - &one)
        })
    };
    triangles.iter().map(within).chain((0..60).map(|_| anywhere())).collect()
}

/// Returns true if over each of some points are as many triangles as the loops of a facet say.
fn is_tiled(solid: &Solid, number: u32, axes: [usize; 2], probes: &[Place]) -> bool {
    let triangles = triangles(solid, number, axes);
    let corners = solid.facets.loops(number as usize).filter(|corners| corners.len() > 2);
    let loops: Vec<Vec<Place>> = corners
        .map(|corners| corners.iter().map(|&corner| place(solid, axes, corner)).collect())
        .collect();
    probes.iter().all(|p| {
        let over = triangles.iter().filter(|[a, b, c]| {
            [[a, b], [b, c], [c, a]].iter().all(|[from, to]| turn(from, to, p) > IBig::ZERO)
        });
        let edges =
            loops.iter().flat_map(|corners| corners.iter().zip(corners.iter().cycle().skip(1)));
        let crossings = edges.filter(|(a, b)| crosses(a, b, p)).count();
        over.count() == crossings % 2
    })
}

/// Returns what the certificate says of the tilings of a solid, whose faces hold.
fn is_certified(solid: &Solid) -> bool {
    match solid.report(2).first.map(|first| first.kind) {
        None => true,
        Some(Kind::FacetTiling | Kind::FacetTriangle | Kind::FacetArea) => false,
        Some(kind) => panic!("{kind:?}"),
    }
}

#[test]
fn tilings_are_those_of_another_judge() {
    let mut random = Random::new(8);
    let (mut held, mut broken) = (0, 0);
    for (solid, facet, axes) in [(boxes(), 8, [1, 2]), (sheet(), 0, [0, 1])] {
        let probes = probes(&triangles(&solid, facet, axes), &mut random);
        for trial in 0..24 {
            let mut solid = solid.clone();
            // Some triangles fewer, and some turned round.
            for _ in 0..trial % 3 {
                let pick = random.unit();
                let is_turned = random.unit() < 0.5;
                solid.corrupt(|mesh| {
                    let boundary = &mut mesh.boundary;
                    let own = |parent: &u32| *parent == facet;
                    let first = boundary.subfacet_parents.iter().position(own).unwrap();
                    let count =
                        boundary.subfacet_parents.iter().filter(|parent| own(parent)).count();
                    let at = first + (pick * count as f64) as usize;
                    if is_turned {
                        boundary.subfacets[at].swap(0, 1);
                        boundary.subfacet_simplices[at].reverse();
                    } else {
                        boundary.subfacets.remove(at);
                        boundary.subfacet_parents.remove(at);
                        boundary.subfacet_simplices.remove(at);
                    }
                });
            }
            let is_certified = is_certified(&solid);
            let is_tiled = is_tiled(&solid, facet, axes, &probes);
            assert_eq!(is_certified, is_tiled, "{facet} {trial}");
            if is_tiled { held += 1 } else { broken += 1 }
        }
    }
    assert!(held >= 16 && broken >= 24, "{held} {broken}");
}
