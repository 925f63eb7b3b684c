//! Attributes of points, in every format that holds them.

use super::super::{Format, samples};
use super::meshes::{GMSH, MESHIO, VTK};
use super::{bits, python_has, read_with_attributes};
use crate::mesh::{Attribute, Mesh};

const NUMPY: &str = include_str!("numpy_table.py");

/// Returns a number and a vector at each vertex: whole numbers, as the scripts print nothing else.
fn attributes(mesh: &Mesh) -> [Attribute; 2] {
    let vertices = mesh.triangulation().unwrap().vertex_count();
    let attribute = |name: &str, components: usize| Attribute {
        name: name.into(),
        components,
        values: (0..vertices * components).map(|i| (i * i) as f64 - 50.0).collect(),
        is_extended: true,
    };
    [attribute("heat", 1), attribute("flow", 3)]
}

/// Returns the last lines that a script prints of a file: those of arrays, in the order of `names`.
fn arrays(script: &str, mesh: &Mesh, name: &str, cell_type: &str, names: &[&str]) -> Vec<String> {
    let arguments = [&[cell_type], names].concat();
    let read = read_with_attributes(script, mesh, &attributes(mesh), name, &arguments);
    let lines: Vec<String> = read.lines().map(str::to_string).collect();
    lines[lines.len() - names.len()..].to_vec()
}

fn whole(values: impl Iterator<Item = f64>) -> String {
    format!("{:?}", values.map(|value| value as i64).collect::<Vec<i64>>())
}

#[test]
fn vtu_has_attributes_of_points() {
    for (script, module, types) in
        [(MESHIO, "meshio", ["triangle", "tetra"]), (VTK, "vtkmodules.vtkIOXML", ["5", "10"])]
    {
        if !python_has(module) {
            continue;
        }
        for (dim, cell_type) in [(2, types[0]), (3, types[1])] {
            let mesh = samples::nested(dim);
            let name = format!("attributes-{module}-{dim}.vtu");
            let read = arrays(script, &mesh, &name, cell_type, &["kind", "heat", "flow"]);
            let [heat, flow] = attributes(&mesh);
            assert_eq!(read[1..], [whole(heat.values.into_iter()), whole(flow.values.into_iter())]);
        }
    }
}

#[test]
fn tetgen_ply_and_gmsh_have_attributes_of_points() {
    let mesh = samples::nested(3);
    let [heat, flow] = attributes(&mesh);
    let component = |k: usize| whole(flow.values.iter().skip(k).step_by(3).copied());
    let heat = whole(heat.values.into_iter());
    if python_has("meshio") {
        // Columns counted from 1: that of heat, then those of flow.
        let names = ["tetgen:attr1", "tetgen:attr3"];
        let read = arrays(MESHIO, &mesh, "attributes.ele", "tetra", &names);
        assert_eq!(read, [heat.clone(), component(1)]);
        let mesh = samples::nested(2);
        let read = arrays(MESHIO, &mesh, "attributes-2.ply", "triangle", &["heat", "flow_2"]);
        let [heat, flow] = attributes(&mesh);
        let third = flow.values.iter().skip(2).step_by(3).copied();
        assert_eq!(read, [whole(heat.values.into_iter()), whole(third)]);
        let read = arrays(MESHIO, &mesh, "attributes-2.msh", "triangle", &["flow"]);
        assert_eq!(read, [whole(flow.values.into_iter())]);
    }
    if python_has("gmsh") {
        let read = arrays(GMSH, &mesh, "attributes-3.msh", "4", &["heat"]);
        assert_eq!(read, [heat]);
    }
}

#[test]
fn numpy_reads_attributes_bit_by_bit() {
    if !python_has("numpy") {
        return;
    }
    let mesh = samples::mesh(3);
    let triangulation = mesh.triangulation().unwrap();
    let mut values = samples::AWKWARD.to_vec();
    values.resize(triangulation.vertex_count(), f64::INFINITY);
    let heat = Attribute { name: "heat".into(), components: 1, values, is_extended: true };
    let flow = &attributes(&mesh)[1];
    for format in [Format::Npy, Format::Csv] {
        let extension = if format == Format::Npy { "npy" } else { "csv" };
        let name = format!("attributes.{extension}");
        let read = |names: &[&str]| {
            let attributes = [heat.clone(), flow.clone()];
            let read = read_with_attributes(NUMPY, &mesh, &attributes, &name, names);
            read.lines().map(str::to_string).collect::<Vec<_>>()
        };
        let heat = format!("{:?}", bits(&heat.values));
        match format {
            Format::Npy => {
                let points = format!("{:?}", bits(&triangulation.points));
                let flow = format!("{:?}", bits(&flow.values));
                assert_eq!(read(&["points", "heat", "flow"]), [points, heat, flow]);
            }
            _ => {
                let second = flow.values.iter().skip(1).step_by(3);
                assert_eq!(read(&["heat", "flow_1"]), [heat, format!("{:?}", bits(second))]);
            }
        }
    }
}
