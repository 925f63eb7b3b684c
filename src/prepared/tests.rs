//! Placements compared with brute force, and structures that are made only once.

use super::*;
use crate::arrays::tests::{delaunay, each_mesh, meshed};
use crate::mesh::{NONE, Region};
use crate::numerics::testing::{Family, Random, points};
use crate::numerics::{Sign, orientation_exact};
use crate::query::{Interpolation, Method, Outside};
use std::ops::Range;
use std::sync::atomic::AtomicUsize;
use std::time::Duration;

/// Calls `act` with each set of `size` numbers below `count`, until it answers true. Returns true
/// if it did.
fn any_set(count: usize, size: usize, mut act: impl FnMut(&[usize]) -> bool) -> bool {
    let mut set: Vec<usize> = (0..size).collect();
    if size > count {
        return false;
    }
    loop {
        if act(&set) {
            return true;
        }
        let Some(at) = (0..size).rev().find(|&at| set[at] != at + count - size) else {
            return false;
        };
        set[at] += 1;
        (at + 1..size).for_each(|next| set[next] = set[next - 1] + 1);
    }
}

/// Returns true if `q` is in a simplex of some of the points.
fn is_in_hull<const D: usize>(points: &[[f64; D]], q: &[f64; D]) -> bool {
    any_set(points.len(), D + 1, |set| {
        let mut simplex: Vec<&[f64; D]> = set.iter().map(|&i| &points[i]).collect();
        let whole = orientation_exact(&simplex);
        whole != Sign::Zero
            && (0..=D).all(|i| {
                let kept = std::mem::replace(&mut simplex[i], q);
                let sign = orientation_exact(&simplex);
                simplex[i] = kept;
                sign == whole || sign == Sign::Zero
            })
    })
}

/// Returns true if a plane through some of all points has the simplex on one side and the points on
/// the other. If any plane separates them, such a plane does.
fn is_separated<const D: usize>(simplex: &[[f64; D]], points: &[[f64; D]]) -> bool {
    let all: Vec<&[f64; D]> = simplex.iter().chain(points).collect();
    any_set(all.len(), D, |set| {
        let mut plane: Vec<&[f64; D]> = set.iter().map(|&i| all[i]).collect();
        let mut side = |q| {
            plane.push(q);
            let sign = orientation_exact(&plane);
            plane.pop();
            sign
        };
        // Points of the plane are on no side; most planes have the simplex on both.
        let beside = |range: Range<usize>| range.filter(|i| !set.contains(i));
        let mut own = Sign::Zero;
        for i in beside(0..simplex.len()) {
            match side(all[i]) {
                Sign::Zero => {}
                sign if own == sign.flip() => return false,
                sign => own = sign,
            }
        }
        own != Sign::Zero && beside(simplex.len()..all.len()).all(|i| side(all[i]) != own)
    })
}

fn brute_placement<const D: usize>(simplex: &[[f64; D]], points: &[[f64; D]]) -> Placement {
    match () {
        () if simplex.iter().all(|vertex| is_in_hull(points, vertex)) => Placement::Inside,
        () if is_separated(simplex, points) => Placement::Outside,
        () => Placement::Across,
    }
}

fn placements_are_right<const D: usize>(count: usize, step: usize) {
    let seen = std::cell::Cell::new([0; 3]);
    each_mesh::<D>(count, |mesh, family| {
        let (prepared, result) = (Prepared::default(), mesh.triangulation().unwrap());
        let inputs: Vec<[f64; D]> = (0..mesh.inputs().distinct())
            .map(|v| mesh.inputs().distinct_point(v).try_into().unwrap())
            .collect();
        let bound = |axis: usize, least: bool| {
            let of = inputs.iter().map(|p| p[axis]);
            if least { of.fold(f64::MAX, f64::min) } else { of.fold(f64::MIN, f64::max) }
        };
        let mut corners: Vec<[f64; D]> = (0..1 << D)
            .map(|set: usize| std::array::from_fn(|axis| bound(axis, set >> axis & 1 == 0)))
            .collect();
        corners.dedup();
        let hull = prepared.placements(mesh, SelectionExtent::Hull).unwrap();
        let within = prepared.placements(mesh, SelectionExtent::Box).unwrap();
        // Those next to the inputs are where it is hard.
        let is_near = |s: &usize| result.simplex(*s).iter().any(|&v| (v as usize) < inputs.len());
        let near = (0..result.simplex_count()).filter(is_near);
        let far = (0..result.simplex_count()).filter(|s| !is_near(s)).step_by(7);
        for simplex in near.chain(far).step_by(step) {
            let vertices = result.simplex(simplex).iter();
            let vertices: Vec<[f64; D]> =
                vertices.map(|&v| result.point(v).try_into().unwrap()).collect();
            // Brute force over the 16 corners of a box in 4D takes too long.
            let bodies = [(hull, &inputs), (within, &corners)];
            for (found, body) in bodies.into_iter().take(if D < 4 { 2 } else { 1 }) {
                let expected = brute_placement(&vertices, body);
                assert_eq!(found[simplex], expected, "{family:?} {vertices:?} {body:?}");
                let mut counts = seen.get();
                counts[expected as usize] += 1;
                seen.set(counts);
            }
        }
    });
    assert!(seen.get().iter().all(|&count| count > 10), "{:?}", seen.get());
}

#[test]
fn placements_in_the_plane_are_those_of_brute_force() {
    placements_are_right::<2>(9, 3);
}

#[test]
fn placements_in_space_are_those_of_brute_force() {
    placements_are_right::<3>(7, 61);
}

#[test]
fn placements_in_4d_are_those_of_brute_force() {
    placements_are_right::<4>(6, 97);
}

#[test]
fn what_is_inside_fills_the_hull() {
    let points = points::<3>(Family::Uniform, 400, &mut Random(5));
    let (mesh, plain) = (meshed(&points, &Options::default()), meshed(&points, &delaunay()));
    let (mesh, plain) = (mesh.unwrap(), plain.unwrap());
    let prepared = Prepared::default();
    let volume = |extent, across| -> f64 {
        let selection = Selection { extent, across, domain: NONE };
        prepared.part(&mesh, &selection).unwrap().volumes().unwrap().iter().sum()
    };
    let hull: f64 = plain.volumes().unwrap().iter().sum();
    let (inside, touched) =
        (volume(SelectionExtent::Hull, false), volume(SelectionExtent::Hull, true));
    assert!(0.5 * hull < inside && inside < hull && hull < touched, "{inside} {hull} {touched}");
    let in_box = volume(SelectionExtent::Box, false);
    assert!(inside < in_box && in_box < 8.0, "{inside} {in_box}");
    assert!(volume(SelectionExtent::All, false) > volume(SelectionExtent::Box, true));
    let all = Prepared::default().placements(&plain, SelectionExtent::Hull).unwrap().to_vec();
    assert!(all.iter().all(|&placement| placement == Placement::Inside));
}

/// Placements in a cropped mesh are those of brute force: the cropped simplices count for walks
/// only. A box reaches beyond the hull.
#[test]
fn placements_in_what_is_cut_out_are_those_of_brute_force() {
    let inputs: [[f64; 2]; 7] =
        [[0.0, 0.0], [4.0, 0.5], [4.5, 4.0], [0.5, 3.5], [1.0, 1.0], [3.0, 1.0], [2.0, 3.0]];
    for extent in [options::Extent::All, options::Extent::Box] {
        for is_hole in [false, true] {
            let mut mesh = Mesh::new(2, 7, inputs.as_flattened(), 0).unwrap();
            mesh.set_segments(&[4, 5, 5, 6, 6, 4], None).unwrap();
            mesh.set_regions(&[Region { seed: [2.0, 1.5, 0.0], is_hole, ..Region::default() }])
                .unwrap();
            mesh.run(&Options { extent, ..Options::default() }, None).unwrap();
            let result = mesh.triangulation().unwrap();
            let is_cut = is_hole || extent == options::Extent::Box;
            assert_eq!(result.boundary.whole.is_some(), is_cut);
            let prepared = Prepared::default();
            let corners = [[0.0, 0.0], [4.5, 0.0], [4.5, 4.0], [0.0, 4.0]];
            let hull = prepared.placements(&mesh, SelectionExtent::Hull).unwrap();
            let within = prepared.placements(&mesh, SelectionExtent::Box).unwrap();
            for simplex in 0..result.simplex_count() {
                let vertices: Vec<[f64; 2]> = result
                    .simplex(simplex)
                    .iter()
                    .map(|&v| result.point(v).try_into().unwrap())
                    .collect();
                assert_eq!(hull[simplex], brute_placement(&vertices, &inputs));
                assert_eq!(within[simplex], brute_placement(&vertices, &corners));
            }
            assert!(hull.len() == result.simplex_count() && hull.contains(&Placement::Across));
        }
    }
}

/// Segments between two vertices of a part are in it only if the part has them as edges.
#[test]
fn parts_have_the_segments_that_are_their_edges() {
    let inputs = [[0.0, 0.0], [4.0, 0.5], [4.5, 4.0], [0.5, 3.5]];
    let mut mesh = Mesh::new(2, 4, inputs.as_flattened(), 0).unwrap();
    mesh.set_segments(&[0, 1, 1, 2, 2, 3, 3, 0], None).unwrap();
    mesh.run(&Options { extent: options::Extent::All, ..Options::default() }, None).unwrap();
    let result = mesh.triangulation().unwrap();
    let [a, b] = result.boundary.subsegments[0];
    let has_edge = |simplex: usize| [a, b].iter().all(|end| result.simplex(simplex).contains(end));
    for is_kept in [false, true] {
        let chosen = (0..result.simplex_count()).map(|simplex| is_kept || !has_edge(simplex));
        let part = Part::of_chosen(result, chosen.collect()).unwrap();
        let (part, _) = part.to_mesh(mesh.inputs(), &[]).unwrap();
        let (part, all) = (&part.triangulation().unwrap().boundary, &result.boundary);
        assert_eq!(part.subsegments.len() + usize::from(!is_kept), all.subsegments.len());
        assert_eq!(part.parents, all.parents[usize::from(!is_kept)..]);
    }
}

/// Flat hulls, of points of a plane in space and of points of a line, have nothing inside.
#[test]
fn a_flat_hull_has_nothing_inside() {
    let flat = points::<2>(Family::Uniform, 12, &mut Random(5));
    let tilted: Vec<[f64; 3]> = flat.iter().map(|p| [p[0], p[1], p[0]]).collect();
    let line: Vec<[f64; 3]> = (0..9).map(|i| [f64::from(i * i); 3]).collect();
    let mut across = 0;
    for inputs in [tilted, line] {
        let mesh = meshed(&inputs, &Options::default()).unwrap();
        let (prepared, result) = (Prepared::default(), mesh.triangulation().unwrap());
        let found = prepared.placements(&mesh, SelectionExtent::Hull).unwrap();
        for (simplex, &placement) in found.iter().enumerate() {
            let vertices = result.simplex(simplex).iter();
            let vertices: Vec<[f64; 3]> =
                vertices.map(|&v| result.point(v).try_into().unwrap()).collect();
            assert_eq!(placement, brute_placement(&vertices, &inputs));
            across += usize::from(placement == Placement::Across);
        }
        assert!(!found.contains(&Placement::Inside));
    }
    assert!(across > 0);
}

/// Flat hulls of many points have few corners, as that of a grid in a plane.
#[test]
fn a_flat_hull_of_many_points_has_few_corners() {
    let flat: Vec<[f64; 3]> = (0..900)
        .map(|i| [f64::from(i % 30), f64::from(i / 30), f64::from(i % 30 - 2 * (i / 30))])
        .collect();
    let hull = hull::of_points(3, flat.as_flattened()).unwrap();
    assert!(hull.corners().len() < 450, "{}", hull.corners().len());
    for corner in [[0.0, 0.0, 0.0], [29.0, 0.0, 29.0], [0.0, 29.0, -58.0], [29.0, 29.0, -29.0]] {
        assert!(hull.corners().any(|point| point == corner));
    }
}

#[test]
fn the_hull_of_many_points_is_that_of_few() {
    fn check<const D: usize>(count: usize) {
        let points = points::<D>(Family::Uniform, count, &mut Random(5));
        let plain = meshed(&points, &delaunay()).unwrap();
        let expected = plain.hull().unwrap();
        let mut on_hull = vec![false; count];
        expected.vertices.iter().for_each(|&v| on_hull[v as usize] = true);
        let found = hull::of_points(D, points.as_flattened()).unwrap();
        let mut corners: Vec<[f64; D]> = found.corners().map(|p| p.try_into().unwrap()).collect();
        let mut wanted: Vec<[f64; D]> =
            (0..count).filter(|&v| on_hull[v]).map(|v| points[v]).collect();
        corners.sort_by(|a, b| a.partial_cmp(b).unwrap());
        wanted.sort_by(|a, b| a.partial_cmp(b).unwrap());
        assert_eq!(corners, wanted);
    }
    check::<2>(3000);
    check::<3>(2000);
    check::<4>(600);
}

#[test]
fn selections_are_meshes_of_their_own() {
    let mut points = points::<2>(Family::Uniform, 40, &mut Random(5));
    points.extend((0..10).map(|i| [0.3 + 1e-7 * f64::from(i * i % 7), 0.3 + 1e-7 * f64::from(i)]));
    let mesh = meshed(&points, &Options::default()).unwrap();
    let result = mesh.triangulation().unwrap();
    assert!(result.domains.len() > 1);
    let prepared = Prepared::default();
    for domain in 0..result.domains.len() as u32 {
        let selection = Selection { domain, ..Selection::default() };
        let part = prepared.part(&mesh, &selection).unwrap();
        let (facets, hull) = (part.facets().unwrap(), part.hull().unwrap());
        let single = facets.simplices.chunks_exact(2).filter(|pair| pair[1] == NONE).count();
        assert_eq!(hull.simplices.len(), single);
        let twice = 2 * facets.simplices.len() / 2 - single;
        assert_eq!(twice, 3 * part.simplex_count());
        for simplex in part.simplices() {
            for &v in result.simplex(simplex as usize) {
                let mut own = result.vertex_domains[v as usize];
                while own != domain && own != NONE {
                    own = result.domains[own as usize].parent;
                }
                assert_eq!(own, domain);
            }
        }
        let edges = part.edges().unwrap();
        let ends = hull.vertices.iter().filter(|v| edges.contains(v)).count();
        assert_eq!(ends, hull.vertices.len());
        let cells = part.voronoi().unwrap();
        hull.vertices.iter().for_each(|&v| assert!(!cells.is_bounded[v as usize]));
    }
    let all = prepared.part(&mesh, &Selection { domain: 0, ..Selection::default() }).unwrap();
    assert_eq!(all.simplex_count(), result.simplex_count());
    let wrong = Selection { domain: 1000, ..Selection::default() };
    let error = prepared.part(&mesh, &wrong).unwrap_err();
    assert!(error.message().starts_with("selection.domain is 1000; the mesh has"), "{error}");
}

#[test]
fn values_of_inputs_are_extended_over_hull_and_cage() {
    let points = points::<3>(Family::Uniform, 100, &mut Random(5));
    let data: Vec<f64> = points.iter().map(|p| p[0] - 3.0 * p[2]).collect();
    let values = Values { components: 1, values: &data };
    for options in [Options::default(), delaunay()] {
        let mesh = meshed(&points, &options).unwrap();
        let result = mesh.triangulation().unwrap();
        let mut out = vec![f64::NAN; result.vertex_count()];
        extend_values(&mesh, values, &mut out).unwrap();
        assert_eq!(out[..100], data);
        assert!(out.iter().all(|x| x.is_finite()));
        let mut back = vec![0.0; 100];
        let method = Method { interpolation: Interpolation::Linear, outside: Outside::Nan };
        let extended = Values { components: 1, values: &out };
        let flat = points.as_flattened();
        let index = Index::new(result).unwrap();
        index.interpolate(result, method, extended, flat, 1, &mut back).unwrap();
        assert_eq!(back, data);
        let error = extend_values(&mesh, values, &mut out[1..]).unwrap_err();
        assert!(error.message().starts_with("vertex_values has length"), "{error}");
    }
    let line: Vec<[f64; 2]> = (0..5).map(|i| [f64::from(i); 2]).collect();
    let mesh = meshed(&line, &Options::default()).unwrap();
    let mut out = vec![f64::NAN; mesh.triangulation().unwrap().vertex_count()];
    let data = [0.0, 1.0, 2.0, 3.0, 4.0];
    extend_values(&mesh, Values { components: 1, values: &data }, &mut out).unwrap();
    assert!(out.iter().all(|x| data.contains(x)));
}

#[test]
fn threads_make_a_value_once() {
    let (once, made) = (Once::default(), AtomicUsize::new(0));
    let make = || {
        std::thread::sleep(Duration::from_millis(20));
        Ok(made.fetch_add(1, Ordering::Relaxed))
    };
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| assert_eq!(*once.get_or_make(make).unwrap(), 0));
        }
    });
    assert_eq!(made.into_inner(), 1);
}

#[test]
fn an_index_needs_a_result() {
    let before = Mesh::new(2, 3, &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0], 0).unwrap();
    let error = Prepared::default().index(&before).err().unwrap();
    assert_eq!(error.kind(), ErrorKind::State);
}
