//! Domains of the plane of all sorts: each ends in a mesh, or in a status where there can be none.
//! Properties of the mesh are checked with integers of the tests' own, beside the certificate.

mod check;
mod corners;
mod exact;
mod interior;
mod near;
mod seeds;
mod shapes;

use crate::random::Random;
use check::check;
use netmesh::options::{Crossings, Extent, Options, Output};
use netmesh::{ErrorKind, Mesh, Result};
use shapes::Domain;

fn run(domain: &Domain, options: &Options) -> Result<Mesh> {
    let mut mesh = Mesh::new(2, domain.points.len(), domain.points.as_flattened(), 0)?;
    mesh.set_segments(domain.segments.as_flattened(), None)?;
    mesh.set_regions(&domain.regions)?;
    mesh.run(options, None)?;
    Ok(mesh)
}

fn inside(min_angle: f64, output: Output) -> Options {
    let max_vertices = 40_000;
    Options { extent: Extent::Boundary, min_angle, output, max_vertices, ..Options::default() }
}

/// Angles, outputs and extents that all domains are meshed with.
const SETTINGS: [(f64, Output, Extent); 6] = [
    (20.7, Output::WellSpaced, Extent::Boundary),
    (30.0, Output::WellSpaced, Extent::Boundary),
    (25.0, Output::Hierarchical, Extent::Boundary),
    (20.7, Output::WellSpaced, Extent::All),
    (28.0, Output::WellSpaced, Extent::Box),
    (20.7, Output::Hierarchical, Extent::Hull),
];

fn check_domain(domain: &Domain, is_wanted: impl Fn(Extent) -> bool) {
    check_with_limited(domain, is_wanted, 0);
}

/// At most `limited` vertices are out of reach of the bound.
fn check_with_limited(domain: &Domain, is_wanted: impl Fn(Extent) -> bool, limited: u64) {
    for (angle, output, extent) in SETTINGS.into_iter().filter(|&(_, _, extent)| is_wanted(extent))
    {
        let options = Options { extent, ..inside(angle, output) };
        let mesh = run(domain, &options).unwrap_or_else(|error| panic!("{extent:?}: {error}"));
        let found = check(domain, &mesh, angle);
        assert!(found.limited <= limited, "{extent:?}: {found:?}");
        assert!(found.triangles > 0, "{extent:?}: {found:?}");
    }
}

fn refusal(domain: &Domain, options: &Options) -> (ErrorKind, String) {
    let error = run(domain, options).map(drop).unwrap_err();
    (error.kind(), error.message().to_owned())
}

macro_rules! domains {
    ($($name:ident: $domain:expr;)*) => {
        $(
            #[test]
            fn $name() {
                check_domain(&$domain, |_| true);
            }
        )*
    };
}

domains! {
    a_letter: shapes::letter_a();
    lakes_with_islands: shapes::lakes();
    a_spiral: shapes::spiral(80);
    a_gear: shapes::gear(24);
    a_text: shapes::text();
    a_star_of_small_angles: shapes::star();
    scales_apart: shapes::scales(-500);
    squares_within_squares: shapes::nested_squares(900);
    a_comb: shapes::comb(12, 0.3);
    a_comb_of_thin_teeth: shapes::comb(4, 1e-2);
    a_lattice: shapes::lattice(9);
    cospherical_polygons: shapes::polygons();
    segments_that_overlap: shapes::overlapping();
    duplicate_points: shapes::duplicates();
    slits_in_a_square: shapes::slits();
    a_polygon_of_random_radii: shapes::random_polygon(60, &mut Random::new(5));
    random_points_in_a_square: shapes::random_points(400, &mut Random::new(6));
    a_needle: shapes::needle();
    far_from_the_origin: shapes::gear(12).moved(|[x, y]| [x + 1e6, y - 3e7]);
    large_numbers: shapes::lakes().moved(|p| p.map(|x| x * 2f64.powi(1000)));
    small_numbers: shapes::lakes().moved(|p| p.map(|x| x * 2f64.powi(-1000)));
}

/// Edges of its hull pass points of the coast within a rounding.
#[test]
fn a_coast() {
    check_domain(&shapes::coast(4), |_| true);
}

/// Points on the sides of their hull and box, and at the next doubles inside.
#[test]
fn points_next_to_their_extent() {
    for (turns, size) in [(false, 1.0), (true, 1.0), (false, 2f64.powi(-500)), (true, 1e6)] {
        let mut points: Vec<[f64; 2]> = shapes::square(1.0).to_vec();
        for i in 1..40 {
            let at = -1.0 + f64::from(i) / 20.0;
            let off = f64::from(i % 3) * f64::EPSILON / 2.0;
            points.extend([[at, off - 1.0], [1.0 - off, at], [at, 1.0 - off], [off - 1.0, at]]);
        }
        let place = |p: [f64; 2]| if turns { turned(p) } else { p }.map(|x| x * size);
        let domain = Domain::new(&points, &[]).moved(place);
        check_domain(&domain, |extent| matches!(extent, Extent::Hull | Extent::Box));
    }
}

/// Some units in the last place inside: the boundary goes through them or past them.
#[test]
fn points_that_nearly_miss_their_extent() {
    for most in 2..9 {
        let mut points: Vec<[f64; 2]> = shapes::square(1.0).to_vec();
        for i in 1..20 {
            let at = -1.0 + f64::from(i) / 10.0;
            let off = f64::from(i % most) * f64::EPSILON;
            points.extend([[at, off - 1.0], [1.0 - off, at], [at, 1.0 - off], [off - 1.0, at]]);
        }
        let domain = Domain::new(&points, &[]).moved(turned);
        let options = Options { extent: Extent::Hull, ..inside(20.7, Output::WellSpaced) };
        let mesh = run(&domain, &options).unwrap_or_else(|error| panic!("{most}: {error}"));
        assert!(check(&domain, &mesh, 20.7).triangles > 0);
    }
}

/// Vertices on slanted sides are rounded to either side of them. Of the triangles there, flatter
/// than the mesh is fine, some have no conflict with the next vertex.
#[test]
fn points_near_slanted_sides() {
    for exponent in [4, 6, 14, 20, 28] {
        let y = 1.0 - 2f64.powi(exponent) * f64::EPSILON;
        let mut domain = Domain::default().around(&shapes::square(1.0));
        domain.points.extend([[-0.625, y], [0.3, y]]);
        // There is no room in a gap of fewer than 64 units.
        check_with_limited(&domain.moved(turned), |_| true, if exponent < 7 { 16 } else { 0 });
    }
}

fn turned([x, y]: [f64; 2]) -> [f64; 2] {
    [0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y]
}

/// On the boundary or not, there is room for a mesh.
#[test]
fn a_point_next_to_its_extent() {
    for steps in 0..40 {
        let y = (0..steps).fold(1.0, |y: f64, _| y.next_down());
        let points = [&shapes::square(1.0)[..], &[[0.25, y]]].concat();
        let is_box = |extent| extent == Extent::Box;
        check_with_limited(&Domain::new(&points, &[]), is_box, if steps > 6 { 8 } else { 0 });
    }
}

/// A fractal of 196,608 segments if NETMESH_SLOW is set, else of 12,288.
#[test]
fn a_long_coast() {
    let depth = if std::env::var_os("NETMESH_SLOW").is_some() { 8 } else { 6 };
    let coast = shapes::coast(depth);
    let options = Options { max_vertices: 0, ..inside(20.7, Output::WellSpaced) };
    let found = check(&coast, &run(&coast, &options).unwrap(), 20.7);
    assert_eq!((found.forced, found.limited), (0, 0));
    if depth == 6 {
        println!("skipped: a coast of 196,608 segments, which takes long; NETMESH_SLOW=1 runs it");
    }
}

/// The outer cage has to have room.
#[test]
fn largest_numbers() {
    let letter =
        |part: f64| shapes::letter_a().moved(|p| p.map(|x| (2.0 * x - 1.0) * f64::MAX * part));
    check_domain(&letter(1.0 / 64.0), |_| true);
    let (kind, message) = refusal(&letter(1.0), &inside(20.7, Output::WellSpaced));
    assert_eq!(kind, ErrorKind::Limit);
    assert!(message.starts_with("the coordinates are too large"), "{message}");
}

/// Coordinates of a few units: there is no room for what the bound asks for.
#[test]
fn subnormal_numbers() {
    for scale in [2f64.powi(20), 300.0, 16.0] {
        let domain =
            shapes::letter_a().moved(|p| p.map(|x| (x * scale).round() * f64::from_bits(1)));
        for (angle, output, extent) in SETTINGS {
            let options = Options { extent, ..inside(angle, output) };
            let found = check(&domain, &run(&domain, &options).unwrap(), angle);
            assert!(found.limited > 0 && found.triangles > 10, "{found:?}");
        }
    }
}

/// A gap that rounding explains is none.
#[test]
fn curves_open_by_an_ulp() {
    let domain = shapes::open_by_an_ulp();
    let found = check(&domain, &run(&domain, &inside(20.0, Output::WellSpaced)).unwrap(), 20.0);
    assert!(found.triangles > 0, "{found:?}");
}

/// They are one chain between their common ends.
#[test]
fn chains_an_ulp_apart() {
    for (angle, output, extent) in SETTINGS {
        let options = Options { extent, ..inside(angle, output) };
        let mesh = run(&shapes::chains_an_ulp_apart(), &options).unwrap();
        let report = netmesh::validate::validate_mesh(&mesh, 3).unwrap();
        assert_eq!(report.first.map(|violation| violation.message), None, "{extent:?}");
        assert!(mesh.result().unwrap().vertex_count() < 2000, "{extent:?}");
    }
}

/// Segments that cross are split at the nearest double, or refused by name.
#[test]
fn crossing_segments() {
    for domain in [shapes::chords(30), shapes::random_segments(20, &mut Random::new(8))] {
        let options = inside(20.7, Output::WellSpaced);
        let (kind, message) = refusal(&domain, &options);
        assert_eq!(kind, ErrorKind::InvalidArgument);
        let [first, second] = named(&message);
        let [a, b] = domain.segments[first].map(|end| domain.points[end as usize]);
        let [c, d] = domain.segments[second].map(|end| domain.points[end as usize]);
        assert_eq!(exact::turn(&a, &b, &c) * exact::turn(&a, &b, &d), -1);
        assert_eq!(exact::turn(&c, &d, &a) * exact::turn(&c, &d, &b), -1);
        for extent in [Extent::Boundary, Extent::Hull, Extent::Box] {
            let options = Options { crossings: Crossings::Split, extent, ..options.clone() };
            let found = check(&domain, &run(&domain, &options).unwrap(), 20.7);
            assert!(found.crossings > 10 && found.limited == 0, "{found:?}");
        }
    }
}

/// The two segments that a message names.
fn named(message: &str) -> [usize; 2] {
    let mut numbers = message.split("segments[").skip(1);
    [(); 2].map(|()| numbers.next().unwrap().split(']').next().unwrap().parse().unwrap())
}
