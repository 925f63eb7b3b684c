//! Facets and segments in space, with seeds, extents, insides and angles: a mesh whose certificate
//! holds, or a documented refusal that changes nothing.

use super::bytes::Bytes;
use super::families;
use super::mesh::{check_limit, check_repetition, refusal_of_points};
use netmesh::io::{Format, write};
use netmesh::validate::validate_mesh;
use netmesh::{Criterion, Crossings, Error, ErrorKind, Extent, Interior, Mesh, Options, Region};

const MAX_POINTS: u8 = 16;
const MAX_TRIANGLES: u8 = 14;
const MAX_SEGMENTS: u8 = 4;
const MAX_SEEDS: u8 = 3;
const MAX_VERTICES: u64 = 600;

/// Points, triangles and segments between them, and seeds.
#[derive(Debug, Default)]
struct Space {
    points: Vec<f64>,
    triangles: Vec<u32>,
    segments: Vec<u32>,
    regions: Vec<Region>,
}

impl Space {
    fn add(&mut self, x: [f64; 3]) -> u32 {
        self.points.extend(x.map(|x| x.clamp(-f64::MAX, f64::MAX)));
        self.points.len() as u32 / 3 - 1
    }

    fn point(&self, at: u32) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.points[3 * at as usize + axis] + 0.0)
    }

    /// Adds a triangle unless two of its vertices are equal: such is refused when it is set.
    fn triangle(&mut self, vertices: [u32; 3]) {
        let [a, b, c] = vertices.map(|vertex| self.point(vertex));
        if a != b && b != c && c != a {
            self.triangles.extend(vertices);
        }
    }

    fn segment(&mut self, ends: [u32; 2]) {
        if self.point(ends[0]) != self.point(ends[1]) {
            self.segments.extend(ends);
        }
    }
}

/// Checks facets. The bytes pick the options, a kind of surface, its points, segments and seeds.
pub fn check(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let options = options(&mut bytes);
    let mut space = match bytes.below(4) {
        0 => soup(&mut bytes),
        1 => pages(&mut bytes),
        2 => cuboids(&mut bytes, options.seed),
        _ => cone(&mut bytes),
    };
    let count = (space.points.len() / 3) as u8;
    for _ in 0..bytes.below(MAX_SEGMENTS + 1) {
        let ends = [(); 2].map(|()| bytes.below(count) as u32);
        space.segment(ends);
    }
    for _ in 0..bytes.below(MAX_SEEDS + 1) {
        let seed = match bytes.below(3) {
            0 => [(); 3].map(|()| bytes.finite()),
            _ => {
                let four = [(); 4].map(|()| space.point(bytes.below(count) as u32));
                [0, 1, 2].map(|axis| four.iter().map(|x| x[axis] / 4.0).sum())
            }
        };
        let (label, is_hole) = (bytes.small() as i32, bytes.once_in(3));
        space.regions.push(Region { seed, label, is_hole, max_edge: 0.0 });
    }
    check_space(&space, &options);
}

fn options(bytes: &mut Bytes<'_>) -> Options {
    let choice = bytes.byte();
    let extents = [Extent::Auto, Extent::All, Extent::Hull, Extent::Box];
    let interiors = [Interior::Auto, Interior::Seeds, Interior::Parity, Interior::Winding];
    let bounds = [f64::INFINITY, 2.0, f64::INFINITY, 3.0];
    let coplanar = [0.0, 0.0, 0.5, 5.0][bytes.below(4)];
    let threads = bytes.below(3) as u32;
    let seed = u64::from(bytes.byte());
    Options {
        criterion: Criterion::RadiusEdge,
        extent: extents[usize::from(choice & 3)],
        interior: interiors[usize::from(choice >> 2 & 3)],
        quality_bound: bounds[usize::from(choice >> 4 & 3)],
        min_dihedral: if choice >> 6 == 3 { 10.0 } else { 0.0 },
        // By the seed: another byte would shift what the corpus has.
        size_from_curvature: if seed % 8 == 5 { 0.05 } else { 0.0 },
        crossings: if seed % 4 == 3 { Crossings::Split } else { Crossings::Refuse },
        coplanar,
        threads,
        seed,
        max_vertices: MAX_VERTICES,
        ..Options::default()
    }
}

/// Draws triangles between any points: strips, and any three.
fn soup(bytes: &mut Bytes<'_>) -> Space {
    let count = 4 + bytes.below(MAX_POINTS - 3);
    let mut space = Space { points: families::points(bytes, 3, count), ..Space::default() };
    let mut last = [0, 1, 2];
    for _ in 0..bytes.below(MAX_TRIANGLES + 1) {
        let choice = bytes.byte();
        let next = u32::from(choice) % count as u32;
        last = match choice >> 6 {
            0 => [(); 3].map(|()| bytes.below(count as u8) as u32),
            _ => [last[1], last[2], next],
        };
        space.triangle(last);
    }
    space
}

/// Draws triangles about one edge, at any angles, from nearly none on.
fn pages(bytes: &mut Bytes<'_>) -> Space {
    let mut space = Space::default();
    let unit = if bytes.once_in(4) { bytes.power_of_two() } else { 1.0 };
    let [low, high] = [0.0, 1.0].map(|z| space.add([0.0, 0.0, z * unit]));
    let mut angle = 0.0;
    for _ in 0..1 + bytes.below(6) {
        angle += 2f64.powi(-i32::from(bytes.byte() % 40));
        let height = f64::from(bytes.byte()) / 255.0;
        let x = space.add([angle.cos(), angle.sin(), height].map(|x| x * unit));
        space.triangle([low, high, x]);
    }
    space
}

/// Draws boxes on a lattice that share sides, nest, touch, or cross; for some seeds plates and rods
/// that are some units in the last place thick.
fn cuboids(bytes: &mut Bytes<'_>, seed: u64) -> Space {
    let mut space = Space::default();
    let unit = if bytes.once_in(4) { bytes.power_of_two() } else { 1.0 };
    let is_turned = bytes.once_in(2);
    let (sine, cosine) = 0.7f64.sin_cos();
    for _ in 0..1 + bytes.below(2) {
        let low = [(); 3].map(|()| (bytes.small() % 4) as f64);
        let size = [(); 3].map(|()| (1 + bytes.below(4)) as f64);
        // Both rules for crossings have such seeds.
        let lengths = match seed % 16 {
            6 | 7 => Some([(); 3].map(|()| [1.0, 4.0, 4096.0, 2f64.powi(50)][bytes.below(4)])),
            _ => None,
        };
        let corners: [u32; 8] = std::array::from_fn(|at| {
            let [x, y, z]: [f64; 3] = std::array::from_fn(|axis| {
                let side = if at >> axis & 1 == 1 { size[axis] } else { 0.0 };
                match lengths {
                    Some(lengths) => 1.0 + (low[axis] + side * lengths[axis]) * f64::EPSILON,
                    None => low[axis] + side,
                }
            });
            let turned = [cosine * x - sine * y, sine * x + cosine * y, z];
            let place = if is_turned { turned } else { [x, y, z] };
            space.add(place.map(|x| x * unit))
        });
        let sides =
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let is_open = bytes.once_in(6);
        for [a, b, c, d] in sides.into_iter().skip(usize::from(is_open)) {
            let [a, b, c, d] = [a, b, c, d].map(|at: usize| corners[at]);
            space.triangle([a, b, c]);
            space.triangle([a, c, d]);
        }
    }
    space
}

/// Draws a cone of many sides over a base, with an apex that may be as low as ulps.
fn cone(bytes: &mut Bytes<'_>) -> Space {
    let mut space = Space::default();
    let sides = 3 + bytes.below(6) as u32;
    for side in 0..sides {
        let angle = std::f64::consts::TAU * f64::from(side) / f64::from(sides);
        let radius = 1.0 + f64::from(bytes.byte()) / 64.0;
        space.add([radius * angle.cos(), radius * angle.sin(), 0.0]);
    }
    let height = 2f64.powi(-i32::from(bytes.byte() % 54));
    let aside = bytes.small() as f64 / 128.0;
    let [base, apex] = [[0.0, 0.0, 0.0], [aside, 0.0, height]].map(|x| space.add(x));
    for side in 0..sides {
        let next = (side + 1) % sides;
        space.triangle([side, next, apex]);
        space.triangle([next, side, base]);
    }
    space
}

fn check_space(space: &Space, options: &Options) {
    let Space { points, triangles, segments, regions } = space;
    let made = Mesh::new(3, points.len() / 3, points, 0);
    assert_eq!(made.as_ref().err().map(Error::kind), refusal_of_points(3, points));
    let Ok(mut mesh) = made else { return };
    mesh.set_triangles(triangles, None).expect("the triangles are right");
    mesh.set_segments(segments, None).expect("the segments are right");
    mesh.set_regions(regions).expect("the seeds are right");
    let met = mesh.intersections().expect("there is memory");
    if let Err(error) = mesh.run(options, None) {
        assert!(is_documented(&error, options, !met.is_empty()), "{error}");
        assert!(mesh.triangulation().is_none(), "a failed run left a result");
        return;
    }
    let may_meet = options.crossings == Crossings::Split;
    assert!(met.is_empty() || may_meet, "accepted though {:?}", met[0]);
    let report = validate_mesh(&mesh, 3).expect("the level is right");
    assert_eq!((report.level, report.violations), (3, 0), "{:?}", report.first);
    for format in [Format::TetgenNode, Format::Gmsh, Format::Medit, Format::Vtu, Format::Off] {
        let mut text = Vec::new();
        assert_eq!(write(&mesh, format, &mut text), Ok(()), "{format:?}");
    }
    check_repetition(&mesh, options);
    check_limit(&mut mesh, options);
}

/// Returns true if a run may end with this error. `meet`: facets and segments meet where they may
/// not.
fn is_documented(error: &Error, options: &Options, meet: bool) -> bool {
    let message = error.message();
    match error.kind() {
        ErrorKind::InvalidArgument => {
            let is_meeting =
                [" cross near ", " touch near ", " overlap near ", " has no area near "]
                    .iter()
                    .any(|kind| message.contains(kind));
            let asks_for_closed = matches!(options.interior, Interior::Parity | Interior::Winding);
            (meet && is_meeting)
                || (asks_for_closed && message.ends_with("so that all surfaces are closed"))
                || (asks_for_closed && options.extent != Extent::Boundary)
                || message.contains(" does not go with facets that are split at their crossings")
                || message.contains(" is not plane: ")
                || message.contains(".seed is on ")
                || message.contains(".seed is within a rounding of ")
                || message.ends_with("; it must be in a region of the domain")
                || message.ends_with("a region must have one seed at most")
                || message.starts_with("regions[0].seed is in no region: ")
                || message.ends_with("; the domain must not be empty")
                || message.contains("quality_bound is inf")
                || message.ends_with("; it needs facets; the mesh has none")
        }
        ErrorKind::DegenerateInput => matches!(options.extent, Extent::Hull | Extent::Box),
        kind => kind == ErrorKind::Limit,
    }
}
