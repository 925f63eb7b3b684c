//! Segments between any points, with regions, extents, insides and sizes: a mesh whose certificate
//! holds, or a documented refusal that changes nothing.

use super::bytes::Bytes;
use super::families;
use super::mesh::{check_limit, check_repetition, refusal_of_points};
use super::near_incidence;
use netmesh::io::{Format, write};
use netmesh::options::SizeFn;
use netmesh::query::Index;
use netmesh::validate::validate_mesh;
use netmesh::{Crossings, Error, ErrorKind, Extent, Interior, Mesh, Options, Output, Region};

/// Largest number of points.
const MAX_POINTS: u8 = 24;
const MAX_SEGMENTS: u8 = 28;
const MAX_SEEDS: u8 = 4;
const MAX_VERTICES: u64 = 1200;

/// Number of the choice that puts points as near to segments as rounding does.
const NEAR_INCIDENCES: usize = 6;

/// Points, pairs of them, and seeds.
#[derive(Debug)]
struct Plane {
    points: Vec<f64>,
    segments: Vec<u32>,
    regions: Vec<Region>,
}

impl Plane {
    /// Returns true if the rule can tell the inside: as many segments end at each place as it asks
    /// for. Places are compared by coordinates.
    fn is_closed(&self, interior: Interior) -> bool {
        let place = |at: u32| [0, 1].map(|axis| self.points[2 * at as usize + axis] + 0.0);
        let all = || self.segments.iter().map(|&at| place(at));
        let starts =
            |here| self.segments.iter().step_by(2).filter(|&&at| place(at) == here).count();
        let ends = |here| all().filter(|&there| there == here).count();
        all().all(|here| match interior {
            Interior::Auto | Interior::Seeds => true,
            Interior::Parity => ends(here) % 2 == 0,
            Interior::Winding => ends(here) == 2 * starts(here),
        })
    }
}

/// Checks a plane. The bytes pick the options, a family of points, the points, segments and seeds.
pub fn check(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let mut options = options(&mut bytes);
    // One byte chooses a size, curves or near incidences: files of before these could be drawn mean
    // what they did.
    let more = bytes.below(8);
    if more == NEAR_INCIDENCES {
        return check_drawing(&mut bytes, options);
    }
    let size = (more == 0).then(|| bytes.power_of_two());
    let interior = [Interior::Seeds, Interior::Parity, Interior::Winding].get(more);
    options.interior = interior.copied().unwrap_or_default();
    let asks_for_curves = matches!(options.interior, Interior::Parity | Interior::Winding);
    if asks_for_curves && !bytes.once_in(16) {
        options.extent = Extent::Boundary;
    }
    let plane = plane(&mut bytes, asks_for_curves);
    check_plane(&plane, &options, size);
}

/// Checks near incidences of any bytes; the first ones pick the options.
pub fn check_near_incidences(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let options = options(&mut bytes);
    check_drawing(&mut bytes, options);
}

/// Checks a drawing of near incidences: without sizes, and mostly with crossings split.
fn check_drawing(bytes: &mut Bytes<'_>, options: Options) {
    let crossings = if bytes.once_in(4) { Crossings::Refuse } else { Crossings::Split };
    let near_incidence::Drawing { points, segments } = near_incidence::drawing(bytes);
    let plane = Plane { points, segments, regions: Vec::new() };
    check_plane(&plane, &Options { crossings, max_edge: 0.0, ..options }, None);
}

fn options(bytes: &mut Bytes<'_>) -> Options {
    let choice = bytes.byte();
    let extents = [Extent::Boundary, Extent::All, Extent::Hull, Extent::Box];
    let angles = [0.0, 20.7, 30.0, 33.0, 5.0, 27.5, 0.0, 20.7];
    Options {
        extent: extents[usize::from(choice & 3)],
        crossings: if choice >> 2 & 1 == 0 { Crossings::Split } else { Crossings::Refuse },
        output: if choice >> 3 & 1 == 0 { Output::WellSpaced } else { Output::Hierarchical },
        min_angle: angles[usize::from(choice >> 4 & 7)],
        max_edge: if choice >> 7 == 1 && bytes.once_in(3) { bytes.power_of_two() } else { 0.0 },
        threads: bytes.below(3) as u32,
        seed: u64::from(bytes.byte()),
        max_vertices: MAX_VERTICES,
        ..Options::default()
    }
}

/// Draws points, segments and seeds; with `of_curves` nearly all curves are closed.
fn plane(bytes: &mut Bytes<'_>, of_curves: bool) -> Plane {
    let count = 2 + bytes.below(MAX_POINTS - 1);
    let points = families::points(bytes, 2, count);
    let point = |at: usize| [points[2 * at] + 0.0, points[2 * at + 1] + 0.0];
    let closes = of_curves && !bytes.once_in(16);
    let mut segments = Vec::new();
    let mut join = |from: usize, to: usize| {
        if point(from) != point(to) {
            segments.extend([from as u32, to as u32]);
        }
    };
    let (mut start, mut first) = (0, 0);
    for _ in 0..bytes.below(MAX_SEGMENTS + 1) {
        // Curves and fans are as likely as pairs of any points.
        let step = bytes.byte();
        let to = if step < 128 { (first + 1) % count } else { usize::from(step) % count };
        join(first, to);
        first = to;
        if step % 8 == 7 {
            if closes {
                join(first, start);
            }
            first = bytes.below(count as u8);
            start = first;
        }
    }
    if closes {
        join(first, start);
    }
    let mut region = || Region {
        seed: match bytes.below(3) {
            0 => [bytes.finite(), bytes.finite(), 0.0],
            _ => {
                let [x, y] = middle([(); 3].map(|()| point(bytes.below(count as u8))));
                [x, y, 0.0]
            }
        },
        label: bytes.small() as i32,
        is_hole: bytes.once_in(3),
        max_edge: if bytes.once_in(6) { bytes.power_of_two() } else { 0.0 },
    };
    let regions = (0..usize::from(count as u8 % (MAX_SEEDS + 1))).map(|_| region()).collect();
    Plane { points, segments, regions }
}

fn middle(points: [[f64; 2]; 3]) -> [f64; 2] {
    [0, 1].map(|axis| points.iter().map(|point| point[axis] / 3.0).sum())
}

fn check_plane(plane: &Plane, options: &Options, size: Option<f64>) {
    let Plane { points, segments, regions } = plane;
    let made = Mesh::new(2, points.len() / 2, points, 0);
    assert_eq!(made.as_ref().err().map(Error::kind), refusal_of_points(2, points));
    let Ok(mut mesh) = made else { return };
    mesh.set_segments(segments, None).expect("the segments are right");
    mesh.set_regions(regions).expect("the seeds are right");
    let answer = |_: &[f64]| size.unwrap_or(f64::INFINITY);
    let function: Option<&SizeFn<'_>> = size.is_some().then_some(&answer);
    if let Err(error) = mesh.run_sized(options, function, None) {
        assert!(is_documented(&error, plane, options, size), "{error}");
        assert!(mesh.triangulation().is_none(), "a failed run left a result");
        return;
    }
    assert!(plane.is_closed(options.interior), "{:?} of open curves", options.interior);
    let report = validate_mesh(&mesh, 3).expect("the level is right");
    assert_eq!((report.level, report.violations), (3, 0), "{:?}", report.first);
    check_uses(&mesh, regions);
    if size.is_none() {
        check_repetition(&mesh, options);
        check_limit(&mut mesh, options);
    }
}

/// Returns true if a run may end with this error.
fn is_documented(error: &Error, plane: &Plane, options: &Options, size: Option<f64>) -> bool {
    let message = error.message();
    let has_sizes = options.max_edge > 0.0 || size.is_some();
    let has_sizes = has_sizes || plane.regions.iter().any(|region| region.max_edge > 0.0);
    match error.kind() {
        ErrorKind::InvalidArgument => {
            let crosses = message.starts_with("segments[") && message.contains(" cross near ");
            let is_open = message.ends_with("so that all curves are closed");
            (is_open && !plane.is_closed(options.interior))
                || (matches!(options.interior, Interior::Parity | Interior::Winding)
                    && options.extent != Extent::Boundary)
                || (options.crossings == Crossings::Refuse && crosses)
                || message.contains(".seed is on ")
                || message.contains(".seed is within a rounding of a segment")
                || message.ends_with("; it must be in a region of the domain")
                || message.ends_with("a region must have one seed at most")
                || message.starts_with("regions[0].seed is in no region: ")
                || (options.output == Output::Hierarchical && has_sizes)
                || (options.extent == Extent::Boundary && plane.segments.is_empty())
                || message.ends_with("; the domain must not be empty")
        }
        ErrorKind::DegenerateInput => matches!(options.extent, Extent::Hull | Extent::Box),
        // Room there always is.
        kind => kind == ErrorKind::Limit && !message.contains("doubles have"),
    }
}

/// Writers and queries take what the domain is, be it nothing.
fn check_uses(mesh: &Mesh, regions: &[Region]) {
    for format in [Format::TetgenNode, Format::Gmsh, Format::Medit, Format::Vtu, Format::Off] {
        let mut text = Vec::new();
        assert_eq!(write(mesh, format, &mut text), Ok(()), "{format:?}");
    }
    let result = mesh.triangulation().expect("it was meshed");
    let seeds: Vec<f64> =
        regions.iter().flat_map(|region| [region.seed[0], region.seed[1]]).collect();
    let mut found = vec![0; regions.len()];
    let index = Index::new(result).expect("there is memory");
    index.locate(result, &seeds, 1, &mut found).expect("seeds are finite");
    for (region, &simplex) in regions.iter().zip(&found) {
        let is_in_hole = region.is_hole && (simplex as usize) < result.simplex_count();
        assert!(!is_in_hole, "a hole's seed is in the domain");
    }
}
