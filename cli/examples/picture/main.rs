//! Draws the README's picture, a hierarchical mesh in the plane, domain within domain:
//! `cargo run --release --package netmesh-cli --example picture > docs/pictures/scales.svg`

mod points;
mod svg;
mod window;

use netmesh::{Domain, Mesh, Options, Result, Triangulation, VertexKind};
use std::collections::BTreeSet;
use svg::{Drawing, PANEL};
use window::Window;

/// Half of a panel's width relative to the radius of its domain; the cage stands at 0.8.
const MARGIN: f64 = 0.92;

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
    let domains = domains_round_the_origin(triangulation);
    let mut drawing = Drawing::new(domains.len());
    for (panel, domain) in domains.iter().enumerate() {
        let center = position(triangulation, domain.center);
        let window = Window::new(center, MARGIN * domain.radius, PANEL);
        drawing.open_panel(panel, &caption(domains[0].radius / domain.radius));
        draw_domains(&mut drawing, triangulation, &window);
        draw_edges(&mut drawing, triangulation, &window);
        for kind in [VertexKind::Cage, VertexKind::Steiner, VertexKind::Input] {
            draw_vertices(&mut drawing, triangulation, &window, kind);
        }
        if let Some(next) = domains.get(panel + 1) {
            drawing.mark(window.place(position(triangulation, next.center)));
        }
        drawing.close_panel();
    }
    drawing.finish()
}

/// From the root inwards; a parent stands before its children.
fn domains_round_the_origin(triangulation: &Triangulation) -> Vec<Domain> {
    let holds_origin = |domain: &&Domain| {
        distance(position(triangulation, domain.center), [0.0, 0.0]) < domain.radius
    };
    triangulation.domains.iter().filter(holds_origin).copied().collect()
}

fn caption(enlarged: f64) -> String {
    match enlarged {
        1.0 => "the root domain".to_owned(),
        _ => format!("the marked spot, {} times enlarged", thousands(enlarged)),
    }
}

/// Two digits count here: 5712 -> "5 700".
fn thousands(number: f64) -> String {
    let unit = 10.0_f64.powf((number.log10() - 1.0).floor().max(0.0));
    let digits = ((number / unit).round() * unit).to_string();
    let groups: Vec<&[u8]> = digits.as_bytes().rchunks(3).rev().collect();
    String::from_utf8_lossy(&groups.join(&b' ')).into_owned()
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
