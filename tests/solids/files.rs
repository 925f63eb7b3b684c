//! The surfaces and complexes of the data directory.

use super::{assert_holds, bounded};
use netmesh::io::{Choice, Format, Merged, Table, read_table_file};
use netmesh::options::Options;
use std::path::PathBuf;

fn directory(name: &str) -> Option<PathBuf> {
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data");
    let data = std::env::var_os("NETMESH_DATA").unwrap_or_else(|| beside.into());
    let directory = std::path::Path::new(&data).join("surfaces").join(name);
    if !directory.is_dir() {
        println!("skipped: surfaces/{name} is not in the data directory (set NETMESH_DATA to it)");
        return None;
    }
    Some(directory)
}

/// Meshes a file without a bound, and with a radius-edge ratio of 2 where `is_refined`. Returns the
/// number of vertices that conformity alone needed beside the inputs.
fn check(path: &std::path::Path, is_refined: bool) -> usize {
    let table = read_table_file(path, Format::Auto, &Choice::default()).unwrap();
    let mut mesh = table.mesh(true).unwrap();
    let mut added = 0;
    for bound in [f64::INFINITY, 2.0].into_iter().take(1 + usize::from(is_refined)) {
        mesh.run(&bounded(bound), None).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        assert_holds(&mesh);
        if bound == f64::INFINITY {
            added = mesh.result().unwrap().vertex_count() - mesh.inputs().distinct();
        }
    }
    added
}

#[test]
fn complexes_conform() {
    let Some(directory) = directory("made") else { return };
    // Name, and the vertices that conformity may add.
    let all = [
        ("cube.poly", 0),
        ("two_cubes.poly", 0),
        ("lshape.poly", 0),
        ("fichera.poly", 0),
        ("crack.poly", 0),
        ("comb.poly", 40),
        ("cone_16.poly", 0),
        ("dangling.poly", 3),
        ("nested_1e-6.poly", 0),
        ("spindle_8.poly", 0),
        ("schoenhardt.poly", 3),
        ("schoenhardt_tight.poly", 3),
        ("tilted_grid_cube_quads.poly", 0),
        ("tilted_grid_cube.off", 0),
        ("star_cone.off", 60),
        ("bowtie_edge.off", 0),
        ("bowtie_vertex.off", 0),
    ];
    for (name, most) in all {
        let added = check(&directory.join(name), name != "schoenhardt_tight.poly");
        assert!(added <= most, "{name}: {added} vertices");
    }
}

#[test]
fn surfaces_conform() {
    for (folder, name, most) in [("tetgenjl", "geoSphere_3.ply", 0), ("tetgenjl", "bar.ply", 0)] {
        let Some(directory) = directory(folder) else { return };
        let added = check(&directory.join(name), true);
        assert!(added <= most, "{name}: {added} vertices");
    }
}

/// Holds that a part whose corners roundings have driven apart is closed when they are merged, and
/// that its certificate holds with the defaults of parts: changes for dihedral angles may put
/// simplices beyond the bound in the place of those that small angles force.
#[test]
fn merged_corners_close_a_part() {
    let Some(directory) = directory("trimesh") else { return };
    let path = directory.join("idler_riser.STL");
    let mut table = read_table_file(&path, Format::Auto, &Choice::default()).unwrap();
    let odd = |table: &Table| table.mesh(true).unwrap().diagnosis().unwrap();
    assert!(!odd(&table).edges.is_empty());
    assert_eq!(table.merge_corners(1e-9).unwrap(), Merged { points: 21, ..Merged::default() });
    assert!(odd(&table).edges.is_empty() && odd(&table).intersections.is_empty());
    let mut mesh = table.mesh(true).unwrap();
    let options = Options { coplanar: 0.1, min_dihedral: 10.0, ..bounded(2.0) };
    mesh.run(&options, None).unwrap_or_else(|error| panic!("{error}"));
    assert_holds(&mesh);
}
