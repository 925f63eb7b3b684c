use crate::mesh::{ArrangedFacet, Arrangement, FacetTriangle, Inputs, NONE, Subsegment};
use crate::options::{Extent, Options, Output};
use std::collections::BTreeSet;

fn read_off(path: &str) -> (Vec<f64>, Vec<[u32; 3]>) {
    let text = std::fs::read_to_string(path).unwrap();
    let lines = text.lines().filter(|line| !line.starts_with('#')).flat_map(str::split_whitespace);
    let mut words = lines.skip_while(|word| *word == "OFF");
    let mut next = || words.next().unwrap();
    let (n, m): (usize, usize) = (next().parse().unwrap(), next().parse().unwrap());
    next();
    let points = (0..3 * n).map(|_| next().parse().unwrap()).collect();
    let faces = (0..m)
        .map(|_| {
            assert_eq!(next(), "3");
            [(); 3].map(|()| next().parse().unwrap())
        })
        .collect();
    (points, faces)
}

#[test]
fn try_file() {
    let Ok(path) = std::env::var("FACETS_FILE") else { return };
    let (points, faces) = read_off(&path);
    let inputs = Inputs::new(3, points.len() / 3, &points, 0).unwrap();
    let vertex = |input: u32| inputs.vertices()[input as usize];
    let mut edges = BTreeSet::new();
    let mut arrangement = Arrangement::default();
    for (facet, face) in (0..).zip(&faces) {
        let vertices = face.map(vertex);
        arrangement.triangles.push(FacetTriangle { vertices, facet });
        arrangement.facets.push(ArrangedFacet { parent: facet, balance: 1 });
        for i in 0..3 {
            let (a, b) = (vertices[i], vertices[(i + 1) % 3]);
            edges.insert([a.min(b), a.max(b)]);
        }
    }
    arrangement.subsegments =
        edges.into_iter().map(|ends| Subsegment { ends, segment: NONE, balance: 0 }).collect();
    let bound: f64 = std::env::var("BOUND").map_or(2.0, |bound| bound.parse().unwrap());
    let options = Options {
        extent: Extent::Boundary,
        output: Output::WellSpaced,
        quality_bound: bound,
        criterion: crate::options::Criterion::RadiusEdge,
        max_vertices: 1_000_000,
        ..Options::default()
    };
    let made = crate::netmesh::run(&inputs, Some(&mut arrangement), &options, None).unwrap();
    println!(
        "vertices {} of {} simplices {} boundary points {} subfacets {} seconds {}",
        made.vertex_count(),
        inputs.distinct(),
        made.simplex_count(),
        made.stats.segment_points,
        made.boundary.subfacets.len(),
        made.stats.seconds
    );
    let whole = made.boundary.whole.as_deref().unwrap_or(&made);
    let report = crate::validate::validate(&inputs, &made, 3).unwrap();
    println!("{} {:?} forced {}", report.level, report.first, whole.boundary.forced.len());
}
