//! The diagram and the hierarchy, read by Python's own JSON reader and checked with numpy.

use super::super::samples;
use super::{as_read_by, bits, python_has};
use crate::mesh::{Domain, NONE};

#[test]
fn the_voronoi_diagram_is_that_of_its_sites() {
    if !python_has("numpy") {
        return;
    }
    for dim in 2..=4 {
        let mesh = if dim < 4 { samples::nested(dim) } else { samples::finished(dim) };
        let triangulation = mesh.triangulation().unwrap();
        let name = format!("diagram-{dim}.voronoi.json");
        let read = as_read_by(include_str!("voronoi_diagram.py"), &mesh, &name, &[]);
        let inputs = mesh.inputs().distinct() as u32;
        let vertices = 0..triangulation.vertex_count() as u32;
        let inputs: Vec<u32> = vertices.map(|v| if v < inputs { v } else { NONE }).collect();
        assert_eq!(read, format!("{:?}\n{inputs:?}\n", bits(&triangulation.points)));
    }
}

#[test]
fn the_hierarchy_is_that_of_the_mesh() {
    if !python_has("numpy") {
        return;
    }
    for dim in 2..=4 {
        let mesh = samples::nested(dim);
        let triangulation = mesh.triangulation().unwrap();
        let domains = &triangulation.domains;
        let vertices = triangulation.vertex_count().to_string();
        let name = format!("hierarchy-{dim}.domains.json");
        let read = as_read_by(include_str!("domain_hierarchy.py"), &mesh, &name, &[&vertices]);
        let each = |number: fn(&Domain) -> u32| domains.iter().map(number).collect::<Vec<u32>>();
        let points = domains.iter().flat_map(|domain| triangulation.point(domain.center));
        let expected = format!(
            "{:?}\n{:?}\n{:?}\n{:?}\n{:?}\n",
            each(|domain| domain.parent),
            each(|domain| domain.center),
            bits(domains.iter().map(|domain| &domain.radius)),
            bits(points),
            triangulation.cage_of,
        );
        assert!(domains.len() > 1, "{dim}");
        assert_eq!(read, expected);
    }
}
