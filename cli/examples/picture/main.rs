//! Draws the README's pictures of meshes in the plane, each on standard output:
//!
//! ```text
//! cargo run --release --package netmesh-cli --example picture > docs/pictures/scales.svg
//! cargo run --release --package netmesh-cli --example picture cage > docs/pictures/cage.svg
//! cargo run --release --package netmesh-cli --example picture FILE X Y HALF-WIDTH [X Y HALF-WIDTH] > ...
//! ```
//!
//! The last one shows the mesh of a file's points, a panel for each square window. `scan.svg` was
//! made so of easting and height, to the millimetre, of the points in PointCloudLibrary/data,
//! `terrain/samp11-utm.pcd` (BSD licence; from ISPRS' filter test), whose northing is from 5403698
//! to 5403699.5, with the windows 512768 354 68 and 512830.1 339 2. The points are not shipped
//! here.

mod points;
mod svg;
mod window;

use netmesh::{Domain, Error, ErrorKind, Mesh, Options, Result, Triangulation, VertexKind, io};
use std::collections::BTreeSet;
use svg::{Drawing, PANEL};
use window::Window;

/// Half of a panel's width relative to the radius of its domain; the cage stands at 0.8.
const MARGIN: f64 = 0.92;

/// Half of a panel's width relative to the radius of the domain in its middle: from afar, then
/// close.
const CLOSE_UPS: [f64; 2] = [25.0, 1.05];

/// A window, what its caption says, and a spot that the next panel shows.
struct Panel {
    window: Window,
    caption: String,
    mark: Option<[f64; 2]>,
}

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let picture = match arguments.as_slice() {
        [] => scales(&sample()?),
        [name] if name == "cage" => cage(&sample()?),
        [file, windows @ ..] => of_file(file, windows)?,
    };
    print!("{picture}");
    Ok(())
}

fn sample() -> Result<Triangulation> {
    let points = points::coordinates();
    meshed(Mesh::new(2, points.len() / 2, &points, 0)?)
}

fn meshed(mut mesh: Mesh) -> Result<Triangulation> {
    mesh.run(&Options::default(), None)?;
    Ok(mesh.triangulation().expect("the run succeeded").clone())
}

/// A panel for each domain around the origin.
fn scales(triangulation: &Triangulation) -> String {
    let domains = domains_round_the_origin(triangulation);
    let panels = domains.iter().enumerate().map(|(panel, domain)| {
        let center = position(triangulation, domain.center);
        let next = domains.get(panel + 1);
        Panel {
            window: Window::new(center, MARGIN * domain.radius, PANEL),
            caption: caption(domains[0].radius / domain.radius),
            mark: next.map(|next| position(triangulation, next.center)),
        }
    });
    drawing(triangulation, panels.collect())
}

/// The second domain: its cage amid the empty region around it, and the cage.
fn cage(triangulation: &Triangulation) -> String {
    let domain = domains_round_the_origin(triangulation)[1];
    let center = position(triangulation, domain.center);
    let [afar, close] = CLOSE_UPS.map(|part| Window::new(center, part * domain.radius, PANEL));
    let panels = vec![
        Panel { window: afar, caption: "a gap".to_owned(), mark: Some(center) },
        Panel {
            window: close,
            caption: "the cage in its middle, and the domain".to_owned(),
            mark: None,
        },
    ];
    drawing(triangulation, panels)
}

fn of_file(file: &str, windows: &[String]) -> Result<String> {
    let usage = || Error::new(ErrorKind::InvalidArgument, "FILE X Y HALF-WIDTH ...".to_owned());
    let numbers: Vec<f64> = windows.iter().filter_map(|word| word.parse().ok()).collect();
    if numbers.is_empty() || numbers.len() != windows.len() || numbers.len() % 3 != 0 {
        return Err(usage());
    }
    let points = io::read_points(file.as_ref(), io::Format::Auto)?;
    if points.dim != 2 {
        return Err(usage());
    }
    let coordinates = &points.coordinates;
    let triangulation = meshed(Mesh::new(2, coordinates.len() / 2, coordinates, 0)?)?;
    let all = &numbers;
    let panels = all.chunks_exact(3).enumerate().map(|(panel, numbers)| Panel {
        window: Window::new([numbers[0], numbers[1]], numbers[2], PANEL),
        caption: if panel == 0 { String::new() } else { "the marked spot".to_owned() },
        mark: all.get(3 * panel + 3..3 * panel + 5).map(|next| [next[0], next[1]]),
    });
    Ok(drawing(&triangulation, panels.collect()))
}

fn drawing(triangulation: &Triangulation, panels: Vec<Panel>) -> String {
    let mut drawing = Drawing::new(panels.len());
    for (place, Panel { window, caption, mark }) in panels.into_iter().enumerate() {
        drawing.open_panel(place, &caption);
        draw_domains(&mut drawing, triangulation, &window);
        draw_edges(&mut drawing, triangulation, &window);
        for kind in [VertexKind::Cage, VertexKind::Steiner, VertexKind::Input] {
            draw_vertices(&mut drawing, triangulation, &window, kind);
        }
        if let Some(spot) = mark {
            drawing.mark(window.place(spot));
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
