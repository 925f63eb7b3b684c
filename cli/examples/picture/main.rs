//! Draws the README's picture, a hierarchical mesh in the plane seen at three magnifications:
//! `cargo run --release --package netmesh-cli --example picture > docs/pictures/scales.svg`

mod points;
mod svg;
mod window;

use netmesh::{Mesh, Options, Result, Triangulation, VertexKind};
use std::collections::BTreeSet;
use svg::{Drawing, PANEL};
use window::Window;

/// How much of the plane a panel shows, relative to the figure at its scale.
const MARGIN: f64 = 2.9;

fn main() -> Result<()> {
    let points = points::coordinates();
    let mut mesh = Mesh::new(2, points.len() / 2, &points, 0)?;
    mesh.run(&Options::default(), None)?;
    if let Some(triangulation) = mesh.triangulation() {
        print!("{}", picture(triangulation));
    }
    Ok(())
}

fn picture(triangulation: &Triangulation) -> String {
    let mut drawing = Drawing::new(points::SCALES.len());
    for (panel, &scale) in points::SCALES.iter().enumerate() {
        let window = Window::new(MARGIN * scale, PANEL);
        drawing.open_panel(panel, &caption(scale));
        draw_domains(&mut drawing, triangulation, &window);
        draw_edges(&mut drawing, triangulation, &window);
        for kind in [VertexKind::Cage, VertexKind::Steiner, VertexKind::Input] {
            draw_vertices(&mut drawing, triangulation, &window, kind);
        }
        drawing.close_panel();
    }
    drawing.finish()
}

fn caption(scale: f64) -> String {
    match (1.0 / scale).log10().round() as i32 {
        0 => "the whole mesh".to_owned(),
        exponent => format!(
            "its centre, 10<tspan dy=\"-5\" font-size=\"9\">{exponent}</tspan><tspan dy=\"5\"> times enlarged</tspan>"
        ),
    }
}

fn draw_domains(drawing: &mut Drawing, triangulation: &Triangulation, window: &Window) {
    for domain in &triangulation.domains {
        let radius = window.length(domain.radius);
        if radius > 2.0 && radius < 2.0 * PANEL {
            drawing.circle(window.place(position(triangulation, domain.center)), radius);
        }
    }
}

fn draw_edges(drawing: &mut Drawing, triangulation: &Triangulation, window: &Window) {
    let mut edges = BTreeSet::new();
    for triangle in triangulation.simplices.chunks_exact(3) {
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            edges.insert((triangle[a].min(triangle[b]), triangle[a].max(triangle[b])));
        }
    }
    let segments = edges
        .iter()
        .filter_map(|&(a, b)| window.clip(position(triangulation, a), position(triangulation, b)));
    drawing.segments(segments.filter(|&[a, b]| distance(a, b) > 0.7));
}

fn draw_vertices(
    drawing: &mut Drawing,
    triangulation: &Triangulation,
    window: &Window,
    kind: VertexKind,
) {
    let mut drawn = BTreeSet::new();
    let places = (0..triangulation.vertex_count() as u32)
        .filter(|&vertex| triangulation.kinds[vertex as usize] == kind)
        .filter(|&vertex| window.contains(position(triangulation, vertex)))
        .map(|vertex| window.place(position(triangulation, vertex)))
        // Of many vertices on one spot, one is enough.
        .filter(|place| drawn.insert(place.map(|x| (2.0 * x).round() as i64)));
    drawing.dots(kind, places);
}

fn position(triangulation: &Triangulation, vertex: u32) -> [f64; 2] {
    let point = triangulation.point(vertex);
    [point[0], point[1]]
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}
