//! Arrays of points, in both directions.

use super::super::{Choice, Format, Outline, Table, read_points, read_table_file, samples};
use super::{Directory, as_read_by, bits, python_has, run};
use crate::mesh::Mesh;

#[test]
fn numpy_reads_npy() {
    const SCRIPT: &str = include_str!("numpy_points.py");
    if !python_has("numpy") {
        return;
    }
    for dim in [2, 3, 8] {
        let mesh = samples::mesh(dim);
        let points = &mesh.triangulation().unwrap().points;
        let read = as_read_by(SCRIPT, &mesh, &format!("numpy-{dim}.npy"), &[]);
        assert_eq!(read, format!("{:?}\n{:?}\n", [dim + 2, dim], bits(points)));
    }
    let inputs = Mesh::new(2, 3, &[0.1, -0.0, 5e-324, f64::MAX, 0.1, 0.0], 0).unwrap();
    let read = as_read_by(SCRIPT, &inputs, "numpy-inputs.npy", &[]);
    assert_eq!(read, format!("[2, 2]\n{:?}\n", bits(&inputs.inputs().distinct_points())));
}

#[test]
fn what_numpy_writes_is_read() {
    if !python_has("numpy") {
        return;
    }
    let directory = Directory::new("numpy-write");
    let points = [[0.1, -0.0, 3.5], [1e30, -5e-40, 1.0 / 3.0], [7.0, 8.0, 9.0], [0.0, 1.0, 2.0]];
    run(include_str!("numpy_write.py"), &directory.0, &[&format!("{points:?}")]);
    let mut files = 0;
    for entry in directory.0.read_dir().unwrap() {
        let path = entry.unwrap().path();
        let read = read_points(&path, Format::Auto).unwrap();
        let floats = path.to_str().unwrap().contains("f4");
        let rounded = |x: &f64| if floats { f64::from(*x as f32) } else { *x };
        let expected: Vec<f64> = points.as_flattened().iter().map(rounded).collect();
        assert_eq!(read.dim, 3);
        samples::assert_same_bits(&read.coordinates, &expected);
        files += 1;
    }
    assert_eq!(files, 24);
}

#[test]
fn features_that_python_writes_are_read() {
    if !python_has("json") {
        return;
    }
    let directory = Directory::new("features-write");
    let printed = run(include_str!("features_write.py"), &directory.0, &[]);
    for line in printed.lines() {
        let (name, expected) = line.split_once(';').unwrap();
        let path = directory.0.join(name);
        let Table { points, outline, .. } =
            read_table_file(&path, Format::Auto, &Choice::default()).unwrap();
        let Outline { segments, markers, .. } = outline;
        let read = format!("{:?};{segments:?};{markers:?}", bits(&points.coordinates));
        assert!(read == expected, "{name}: {read}\n{expected}");
    }
    assert_eq!(printed.lines().count(), 400);
}
