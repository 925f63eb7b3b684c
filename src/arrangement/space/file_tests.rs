//! Surfaces in files, valid and invalid ones; tests without their files say so and pass.

use super::tests::Case;
use super::*;
use crate::mesh::IntersectionKind::{self, Cross, Overlap, Touch, ZeroArea};
use std::path::PathBuf;

/// Returns the path of a surface; `None` if the data directory does not have it.
fn path(name: &str) -> Option<PathBuf> {
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data");
    let data = std::env::var_os("NETMESH_DATA").unwrap_or_else(|| beside.into());
    let path = PathBuf::from(data).join("surfaces").join(name);
    let is_there = path.is_file();
    if !is_there {
        println!("skipped: surfaces/{name} is not in the data directory (set NETMESH_DATA to it)");
    }
    is_there.then_some(path)
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    let lines = text.lines().map(|line| line.split('#').next().unwrap_or(""));
    lines.flat_map(str::split_whitespace)
}

/// Reads a surface in OFF.
fn off(name: &str) -> Option<Case> {
    let text = std::fs::read_to_string(path(name)?).unwrap();
    let mut words = words(&text).skip(1);
    let mut number = || words.next().unwrap().parse::<f64>().unwrap();
    let [vertices, triangles, _] = [number(), number(), number()];
    let points: Vec<[f64; 3]> =
        (0..vertices as usize).map(|_| [(); 3].map(|()| number())).collect();
    let mut triangle = || {
        assert_eq!(number(), 3.0);
        [(); 3].map(|()| number() as u32)
    };
    let triangles: Vec<[u32; 3]> = (0..triangles as usize).map(|_| triangle()).collect();
    Some(Case::surface(&points, &triangles))
}

/// Reads the facets of a complex in TetGen's format, without their holes: inputs numbered from 0.
fn poly(name: &str) -> Option<Case> {
    let text = std::fs::read_to_string(path(name)?).unwrap();
    let mut words = words(&text);
    let mut number = || words.next().unwrap().parse::<f64>().unwrap();
    let [count, _, attributes, has_markers] = [number(), number(), number(), number()];
    let mut points = Vec::new();
    for _ in 0..count as usize {
        number();
        points.push([(); 3].map(|()| number()));
        (0..(attributes + has_markers) as usize).for_each(|_| {
            number();
        });
    }
    let [facets, has_markers] = [number(), number()];
    let mut polygons = Vec::new();
    for _ in 0..facets as usize {
        let [loops, holes] = [number(), number()];
        if has_markers > 0.0 {
            number();
        }
        let mut polygon = Vec::new();
        for _ in 0..loops as usize {
            let corners = number() as usize;
            polygon.push((0..corners).map(|_| number() as u32).collect::<Vec<_>>());
        }
        (0..4 * holes as usize).for_each(|_| {
            number();
        });
        polygons.push(polygon);
    }
    Some(Case::polygons(&points, &polygons))
}

/// Reads the vertices and triangles of a binary PLY file whose properties are floats and bytes.
fn ply(name: &str) -> Option<Case> {
    let bytes = std::fs::read(path(name)?).unwrap();
    let end = bytes.windows(11).position(|window| window == b"end_header\n").unwrap() + 11;
    let header = String::from_utf8_lossy(&bytes[..end]).into_owned();
    let count = |what: &str| -> usize {
        let line = header.lines().find(|line| line.starts_with(what)).unwrap();
        line.split_whitespace().last().unwrap().parse().unwrap()
    };
    let (vertices, faces) = (count("element vertex"), count("element face"));
    let beyond = |line: &&str| line.starts_with("property") && !line.contains("list");
    let size = |line: &str| if line.contains("uint8") { 1 } else { 4 };
    let properties: usize = header.lines().filter(beyond).map(size).sum();
    let mut at = end;
    let mut take = |size: usize| {
        at += size;
        &bytes[at - size..at]
    };
    let mut points = Vec::new();
    for _ in 0..vertices {
        let own = take(properties);
        points.push(
            [0, 4, 8].map(|at| f64::from(f32::from_be_bytes(own[at..at + 4].try_into().unwrap()))),
        );
    }
    let mut triangles = Vec::new();
    for _ in 0..faces {
        assert_eq!(take(1), [3]);
        triangles.push([(); 3].map(|()| u32::from_be_bytes(take(4).try_into().unwrap())));
    }
    Some(Case::surface(&points, &triangles))
}

fn count(found: &[Intersection], kind: IntersectionKind) -> usize {
    found.iter().filter(|one| one.kind == kind).count()
}

/// The numbers of pairs are those of another program with exact predicates, except that it counts
/// no pairs of a triangle without an area.
#[test]
fn invalid_files_are_refused_with_all_pairs() {
    let counts = |name: &str| {
        let found = off(name)?.intersections();
        println!("{name}: {found:?}");
        Some([Cross, Touch, Overlap, ZeroArea].map(|kind| count(&found, kind)))
    };
    let crossing = counts("made/invalid_crossing_boxes.off");
    assert!(crossing.is_none_or(|counts| counts.iter().sum::<usize>() == 18), "{crossing:?}");
    let touching = counts("made/invalid_touching_boxes.off");
    assert!(touching.is_none_or(|counts| counts.iter().sum::<usize>() == 19), "{touching:?}");
    let duplicate = counts("made/invalid_duplicate_facet.off");
    assert!(duplicate.is_none_or(|counts| counts == [0, 0, 1, 0]), "{duplicate:?}");
    let zero = counts("made/invalid_zero_area.off");
    assert!(zero.is_none_or(|counts| counts == [0, 0, 0, 1]), "{zero:?}");
    // An open box is no fault of pairs, but does not close.
    let Some(open) = off("made/invalid_open_box.off") else { return };
    let made = open.arrangement();
    for interior in [crate::options::Interior::Parity, crate::options::Interior::Winding] {
        check_closed_in_space(&open.inputs, &made, interior, &mut |_| Ok(())).unwrap_err();
        assert!(!encloses_in_space(&open.inputs, &made, interior, &mut |_| Ok(())).unwrap());
    }
    assert!(
        !encloses_in_space(&open.inputs, &made, crate::options::Interior::Seeds, &mut |_| Ok(()))
            .unwrap()
    );
}

#[test]
fn valid_files_are_arranged() {
    let surfaces = [
        ("bowtie_edge", 8),
        ("bowtie_vertex", 8),
        ("cube", 6),
        ("schoenhardt", 8),
        ("schoenhardt_tight", 8),
        ("star_cone", 48),
        ("tilted_grid_cube", 6),
    ];
    for (name, facets) in surfaces {
        let Some(case) = off(&format!("made/{name}.off")) else { return };
        let made = case.arrangement();
        assert_eq!(made.facets.len(), facets, "{name}");
        assert!(
            encloses_in_space(
                &case.inputs,
                &made,
                crate::options::Interior::Seeds,
                &mut |_| Ok(())
            )
            .unwrap()
        );
    }
    for name in [
        "chazelle_4",
        "comb",
        "cone_16",
        "cone_200",
        "crack",
        "cube",
        "dangling",
        "fichera",
        "gap_0p001",
        "gap_1e-06",
        "lshape",
        "nested_1e-3",
        "nested_1e-6",
        "schoenhardt",
        "schoenhardt_tight",
        "slab_0p001",
        "slab_1e-06",
        "slab_1e-09",
        "slab_1e-12",
        "spindle_8",
        "spindle_64",
        "tilted_grid_cube_quads",
        "two_cubes",
        "utm_block",
        "wedge_0p001",
        "wedge_0p1",
        "wedge_1",
        "wedge_30",
        "wedge_5",
    ] {
        let Some(case) = poly(&format!("made/{name}.poly")) else { return };
        let made = case.arranged(0.0).unwrap_or_else(|error| panic!("{name}: {error}"));
        println!("{name}: {} triangles, {} lines", made.triangles.len(), made.subsegments.len());
    }
}

/// The horse hides four pairs of triangles that cross among 96,966.
#[test]
fn crossings_in_a_scan_are_found() {
    let Some(case) = ply("vtkdata/horse.ply") else { return };
    let start = std::time::Instant::now();
    let found = case.intersections();
    let seconds = start.elapsed().as_secs_f64();
    println!("{} triangles a second", case.facets.count() as f64 / seconds);
    println!("{found:?}");
    assert_eq!(found.len(), 4);
}
