//! Draws the dihedral angles of meshes of the same points, a panel for each, on standard output:
//!
//! ```text
//! cargo run --release --package netmesh-cli --example histogram > docs/pictures/dihedral_angles.svg
//! ```

mod svg;

use netmesh::quality::{Measure, histogram};
use netmesh::{Algorithm, Criterion, Mesh, Options, Output, Result};
use svg::{BINS, Drawing};

/// Uniform in the unit cube.
const POINTS: usize = 10_000;

fn main() -> Result<()> {
    let points = points();
    let panels = panels();
    let mut drawing = Drawing::new(panels.len());
    for (place, (caption, options)) in panels.iter().enumerate() {
        let mut mesh = Mesh::new(3, POINTS, &points, 0)?;
        mesh.run(options, None)?;
        let triangulation = mesh.triangulation().expect("the run succeeded");
        let width = 180.0 / BINS as f64;
        let edges: Vec<f64> = (0..=BINS).map(|bin| bin as f64 * width).collect();
        let found = histogram(triangulation, Measure::DihedralAngle, true, &edges)?;
        let extent = format!("{:.2} to {:.2} degrees", found.least, found.largest);
        drawing.panel(place, [caption, &extent], &found.counts[1..=BINS]);
    }
    print!("{}", drawing.finish());
    Ok(())
}

/// Returns the title of each panel, and the options of its mesh. All simplices count, at the hull too.
fn panels() -> Vec<(&'static str, Options)> {
    let delaunay = Options { algorithm: Algorithm::Delaunay, ..Options::default() };
    let refined = Options {
        output: Output::WellSpaced,
        criterion: Criterion::RadiusEdge,
        quality_bound: 2.0,
        ..Options::default()
    };
    let mended = Options { min_dihedral: 15.0, ..refined.clone() };
    vec![
        ("Delaunay triangulation", delaunay),
        ("radius-edge ratio at most 2", refined),
        ("the same, at least 15 degrees", mended),
    ]
}

/// Returns points of the splitmix64 generator.
fn points() -> Vec<f64> {
    let mut state = 1u64;
    let mut unit = || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut word = state;
        word = (word ^ (word >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        word = (word ^ (word >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((word ^ (word >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    };
    (0..3 * POINTS).map(|_| unit()).collect()
}
