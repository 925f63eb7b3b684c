//! Corruptions of segments, regions and the domain that they enclose.

use super::meshes::Case;
use netmesh::mesh::{Boxed, Facets};
use netmesh::options::{Algorithm, Crossings, Extent, Interior, Options, Output};
use netmesh::quality::measure;
use netmesh::validate::{Outline, Report, ViolationKind as Kind, validate_mesh, validate_outlined};
use netmesh::{Mesh, NONE, Region, Segments, Triangulation, VertexKind};

/// A result and what it was made of.
#[derive(Clone)]
pub struct Domain {
    pub case: Case,
    pub segments: Segments,
    pub regions: Vec<Region>,
}

impl Domain {
    fn of(points: &[[f64; 2]], segments: &[[u32; 2]], regions: &[Region]) -> (Mesh, Self) {
        Self::with(points, segments, regions, Interior::Seeds)
    }

    pub fn with(
        points: &[[f64; 2]],
        segments: &[[u32; 2]],
        regions: &[Region],
        interior: Interior,
    ) -> (Mesh, Self) {
        let mut mesh = Mesh::new(2, points.len(), points.as_flattened(), 0).unwrap();
        mesh.set_segments(segments.as_flattened(), None).unwrap();
        mesh.set_regions(regions).unwrap();
        let (extent, output) = (Extent::Boundary, Output::WellSpaced);
        let options = Options { extent, output, interior, min_angle: 25.0, ..Options::default() };
        mesh.run(&options, None).unwrap();
        let case = Case { inputs: mesh.inputs().clone(), mesh: mesh.result().unwrap().clone() };
        let segments = mesh.segments().clone();
        (mesh, Self { case, segments, regions: regions.to_vec() })
    }

    pub fn report(&self, level: u32) -> Report {
        let facets = Facets::default();
        let outline = Outline { segments: &self.segments, facets: &facets, regions: &self.regions };
        validate_outlined(&self.case.inputs, outline, &self.case.mesh, level).unwrap()
    }

    pub fn assert_sound(&self) {
        let report = self.report(3);
        assert_eq!((report.level, report.violations, report.first), (3, 0, None));
    }

    pub fn assert_violates(&self, kind: Kind) {
        let report = self.report(3);
        let first = report.first.unwrap_or_else(|| panic!("{kind:?} went unseen"));
        assert_eq!(first.kind, kind, "{}", first.message);
        assert_eq!(report.level, kind.level() - 1);
    }

    pub fn whole(&self) -> &Triangulation {
        self.case.mesh.boundary.whole.as_ref().unwrap()
    }

    fn whole_mut(&mut self) -> &mut Triangulation {
        self.case.mesh.boundary.whole.as_mut().unwrap()
    }

    /// The domain cut from the whole again, as its first `count` simplices.
    fn recut(&mut self, count: usize) {
        let whole = self.whole().clone();
        let last = whole.simplices[..3 * count].iter().max().unwrap();
        let vertices = (*last as usize + 1).max(self.case.inputs.distinct());
        let all = &whole.boundary;
        let kept = |ends: &[u32; 2]| {
            whole.simplices[..3 * count].chunks(3).any(|s| ends.iter().all(|end| s.contains(end)))
        };
        let of_kept = all.subsegments.iter().zip(&all.parents).filter(|(ends, _)| kept(ends));
        let mut cut = whole.clone();
        cut.points.truncate(2 * vertices);
        cut.kinds.truncate(vertices);
        cut.vertex_domains.truncate(vertices);
        cut.cage_of.truncate(vertices);
        cut.precision_limited.truncate(vertices);
        cut.sizes.truncate(vertices);
        cut.simplices.truncate(3 * count);
        cut.neighbors.truncate(3 * count);
        for id in cut.neighbors.iter_mut().filter(|id| **id as usize >= count) {
            *id = NONE;
        }
        cut.boundary.simplex_regions.truncate(count);
        (cut.boundary.subsegments, cut.boundary.parents) = of_kept.unzip();
        cut.boundary.whole = Some(Boxed::new(whole).unwrap());
        self.case.mesh = cut;
    }

    /// Corrupts the whole, and cuts as before.
    pub fn corrupt(&mut self, corrupt: impl Fn(&mut Triangulation)) {
        let count = self.case.mesh.simplex_count();
        corrupt(self.whole_mut());
        self.recut(count);
    }
}

pub fn circle(count: usize, center: [f64; 2], radius: f64) -> Vec<[f64; 2]> {
    let angle = |i: usize| 0.3 + std::f64::consts::TAU * i as f64 / count as f64;
    let point = |i| [center[0] + radius * angle(i).cos(), center[1] + radius * angle(i).sin()];
    (0..count).map(point).collect()
}

pub fn closed(first: u32, count: u32) -> Vec<[u32; 2]> {
    (0..count).map(|i| [first + i, first + (i + 1) % count]).collect()
}

/// A quadrilateral with an island near a side and a region of its own label.
pub fn lake() -> Domain {
    let mut points = vec![[-1.0, -1.0], [1.01, -1.02], [1.1, 0.9], [-0.97, 1.05]];
    points.extend(circle(9, [0.1, -0.7], 0.2));
    points.extend(circle(7, [-0.3, 0.4], 0.25));
    let segments = [closed(0, 4), closed(4, 9), closed(13, 7)].concat();
    let hole = Region { seed: [0.1, -0.7, 0.0], is_hole: true, ..Region::default() };
    let label = Region { seed: [-0.3, 0.4, 0.0], label: 7, ..Region::default() };
    Domain::of(&points, &segments, &[hole, label]).1
}

/// Segments from one point at small angles to each other, in a box.
pub fn star() -> Domain {
    let mut points = vec![[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0], [0.0, 0.0]];
    let angles = (0..12).map(|i| 0.3 + 0.004 * 1.5f64.powi(i));
    points.extend(angles.map(|angle| [angle.cos(), angle.sin()]));
    let mut segments = closed(0, 4);
    segments.extend((5..17).map(|end| [4, end]));
    Domain::of(&points, &segments, &[]).1
}

/// A subsegment that ends where the next of its segment begins, at a vertex that is no input.
pub fn before_split(domain: &Domain) -> usize {
    let boundary = &domain.whole().boundary;
    let pairs = boundary.subsegments.windows(2);
    let is_split = |pair: &[[u32; 2]]| {
        pair[0][1] == pair[1][0] && pair[0][1] as usize >= domain.case.inputs.distinct()
    };
    pairs.into_iter().position(is_split).expect("a segment in parts")
}

#[test]
fn domains_hold() {
    for domain in [lake(), star()] {
        domain.assert_sound();
        let mut same = domain.clone();
        same.recut(domain.case.mesh.simplex_count());
        same.assert_sound();
    }
    assert!(!star().case.mesh.boundary.forced.is_empty());
}

/// The centre of a small cross is where its segments cross, which is no input. It keeps its place
/// when vertices get new numbers, those of the outer cage before it among them.
#[test]
fn domains_in_a_cut_hierarchy_have_their_centres() {
    const SMALL: f64 = 1e-9;
    let mut points = vec![[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    points.extend([[-SMALL, -SMALL], [SMALL, SMALL], [-SMALL, SMALL], [SMALL, -SMALL]]);
    let mut segments = closed(0, 4);
    segments.extend([[4, 5], [6, 7]]);
    let mut mesh = Mesh::new(2, points.len(), points.as_flattened(), 0).unwrap();
    mesh.set_segments(segments.as_flattened(), None).unwrap();
    let options = Options {
        output: Output::Hierarchical,
        extent: Extent::Boundary,
        crossings: Crossings::Split,
        min_angle: 30.0,
        ..Options::default()
    };
    mesh.run(&options, None).unwrap();
    let report = validate_mesh(&mesh, 3).unwrap();
    assert_eq!((report.level, report.violations, report.first), (3, 0, None));
    let result = mesh.result().unwrap();
    assert_eq!(result.domains.len(), 2);
    let center = result.domains[1].center;
    assert!(center as usize >= points.len());
    assert_eq!(result.point(center), [0.0, 0.0]);
}

/// A result is checked with the segments that it was made of.
#[test]
fn later_segments_are_not_those_of_the_result() {
    let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let (mut mesh, _) = Domain::of(&points, &closed(0, 4), &[]);
    assert_eq!(validate_mesh(&mesh, 3).unwrap().level, 3);
    mesh.set_segments(&[0, 2], None).unwrap();
    mesh.set_segments(&[1, 3], None).unwrap();
    mesh.set_regions(&[Region { seed: [0.5, 0.25, 0.0], is_hole: true, ..Region::default() }])
        .unwrap();
    assert_eq!(validate_mesh(&mesh, 3).unwrap().violations, 0);
    mesh.set_regions(&[]).unwrap();
    mesh.set_segments(&closed(0, 4)[..3].concat(), None).unwrap();
    let options = Options { algorithm: Algorithm::Netmesh, ..Options::default() };
    mesh.run(&options, None).unwrap();
    assert_eq!(mesh.result().unwrap().boundary.parents.last(), Some(&2));
    assert_eq!(validate_mesh(&mesh, 3).unwrap().violations, 0);
}

/// Triangles at the boundary of the domain are measured, and forced ones are not.
#[test]
fn measures_are_those_of_the_domain() {
    let points = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [0.0, 1.0]];
    let quality = |domain: &Domain| measure(&domain.case.mesh).unwrap();
    let (_, strip) = Domain::of(&points, &closed(0, 4), &[]);
    assert!(quality(&strip).min_angle_degrees > 25.0 - 1e-6);
    assert_eq!((quality(&strip).forced, quality(&strip).least_forced_angle_degrees), (0, 0.0));
    let mut star = star();
    let bounded = quality(&star);
    assert!(bounded.min_angle_degrees > 25.0 - 1e-6, "{bounded:?}");
    assert!(bounded.worst_radius_edge <= star.case.mesh.parameters.quality_bound);
    assert_eq!(bounded.forced, star.case.mesh.boundary.forced.len() as u64);
    let forced = bounded.least_forced_angle_degrees;
    // The smallest angle between segments is 0.004 of a radian times 1.5 - 1.
    assert!((0.05..0.5).contains(&forced), "{forced}");
    star.corrupt(|whole| whole.boundary.forced.clear());
    let unmarked = quality(&star);
    assert_eq!((unmarked.min_angle_degrees, unmarked.forced), (forced, 0));
}

#[test]
fn arrays_that_do_not_fit() {
    let corruptions: [fn(&mut Triangulation); 8] = [
        |mesh| {
            mesh.boundary.parents.pop();
        },
        |mesh| {
            mesh.boundary.simplex_regions.pop();
        },
        |mesh| mesh.boundary.parents[3] = 99,
        |mesh| mesh.boundary.parents[0] = 1,
        |mesh| *mesh.boundary.parents.last_mut().unwrap() = NONE,
        |mesh| mesh.boundary.subsegments[5][1] = mesh.vertex_count() as u32,
        |mesh| mesh.boundary.subsegments[5][1] = mesh.boundary.subsegments[5][0],
        |mesh| mesh.boundary.whole = Some(Boxed::new(mesh.clone()).unwrap()),
    ];
    for corrupt in corruptions {
        let mut domain = lake();
        corrupt(domain.whole_mut());
        domain.assert_violates(Kind::BoundaryArrays);
    }
    let forced: [fn(usize) -> Vec<u32>; 3] =
        [|_| vec![2, 1], |_| vec![3, 3], |count| vec![count as u32]];
    for forced in forced {
        let mut domain = lake();
        let forced = forced(domain.case.mesh.simplex_count());
        domain.corrupt(|whole| whole.boundary.forced = forced.clone());
        domain.assert_violates(Kind::BoundaryArrays);
    }
}

#[test]
fn domains_that_are_no_part_of_the_whole() {
    let corruptions: [fn(&mut Triangulation); 12] = [
        |mesh| mesh.points[2] = -mesh.points[2],
        |mesh| mesh.points.truncate(mesh.points.len() - 2),
        |mesh| mesh.kinds[0] = VertexKind::Steiner,
        |mesh| mesh.vertex_domains[1] = 5,
        |mesh| mesh.cage_of[1] = 0,
        |mesh| mesh.precision_limited[2] = true,
        |mesh| mesh.simplices.swap(0, 1),
        |mesh| mesh.neighbors[4] = NONE - 1,
        |mesh| mesh.boundary.simplex_regions[3] += 1,
        |mesh| {
            mesh.boundary.subsegments.pop();
        },
        |mesh| mesh.boundary.forced.push(0),
        |mesh| mesh.domains[0].radius *= 2.0,
    ];
    for (number, corrupt) in corruptions.into_iter().enumerate() {
        let mut domain = lake();
        corrupt(&mut domain.case.mesh);
        let report = domain.report(3);
        assert_eq!(report.first.unwrap().kind, Kind::DomainArrays, "{number}");
        assert_eq!(report.level, 0);
    }
}

/// A segment outside, between inputs, which the result has.
#[test]
fn a_subsegment_that_the_domain_does_not_have() {
    let mut points = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
    points.extend([[6.0, 0.0], [6.0, 4.0]]);
    let segments = [&closed(0, 4)[..], &[[4, 5]]].concat();
    let domain = Domain::of(&points, &segments, &[]).1;
    domain.assert_sound();
    let (own, all) = (&domain.case.mesh.boundary, &domain.whole().boundary);
    assert!(all.parents.contains(&4) && !own.parents.contains(&4));
    let mut more = domain.clone();
    more.case.mesh.boundary.subsegments.push([4, 5]);
    more.case.mesh.boundary.parents.push(4);
    more.assert_violates(Kind::DomainArrays);
    let mut fewer = domain.clone();
    fewer.case.mesh.boundary.subsegments.pop();
    fewer.case.mesh.boundary.parents.pop();
    fewer.assert_violates(Kind::DomainArrays);
}

/// No run makes a mesh with such seeds.
#[test]
fn seeds_without_a_region_of_their_own() {
    let outside = Region { seed: [5.0, 5.0, 0.0], is_hole: true, ..Region::default() };
    let beyond = Region { seed: [1e9, 5.0, 0.0], ..Region::default() };
    let second = Region { seed: [-0.3, 0.45, 0.0], label: 7, ..Region::default() };
    let again = Region { seed: [0.1, -0.75, 0.0], is_hole: true, ..Region::default() };
    for seed in [outside, beyond, second, again] {
        let mut domain = lake();
        domain.regions.push(seed);
        domain.assert_violates(Kind::RegionLabel);
    }
}

#[test]
fn a_label_that_is_not_its_regions() {
    let domain = lake();
    for simplex in 0..domain.whole().simplex_count() {
        let mut domain = domain.clone();
        domain.corrupt(|whole| whole.boundary.simplex_regions[simplex] += 1);
        domain.assert_violates(Kind::RegionLabel);
    }
    let mut domain = domain;
    domain.corrupt(|whole| {
        let labels = whole.boundary.simplex_regions.iter_mut();
        labels.filter(|label| **label == 7).for_each(|label| *label = 8);
    });
    domain.assert_violates(Kind::RegionLabel);
}

#[test]
fn a_domain_with_a_simplex_too_few_or_too_many() {
    let domain = lake();
    let count = domain.case.mesh.simplex_count();
    for count in [count - 1, count + 1] {
        let mut domain = domain.clone();
        domain.recut(count);
        domain.assert_violates(Kind::DomainEnd);
    }
}

#[test]
fn a_domain_with_a_region_too_few_or_too_many() {
    let mut domain = lake();
    domain.recut(domain.whole().simplex_count());
    domain.assert_violates(Kind::DomainPlace);
    // Without a hole only what is outside is too much.
    let mut domain = star();
    domain.recut(domain.whole().simplex_count());
    domain.assert_violates(Kind::DomainPlace);
    let mut domain = lake();
    domain.regions[1].is_hole = true;
    domain.assert_violates(Kind::DomainPlace);
    let mut domain = lake();
    domain.regions.remove(0);
    domain.assert_violates(Kind::DomainPlace);
}

#[test]
fn a_simplex_that_nothing_forces() {
    let mut domain = lake();
    domain.corrupt(|whole| whole.boundary.forced = vec![5]);
    domain.assert_violates(Kind::ForcedSimplex);
    // Subsegments that would be forced if they were beyond the bound.
    let mut domain = star();
    domain.corrupt(|whole| whole.parameters.quality_bound = 1e9);
    domain.assert_violates(Kind::ForcedSimplex);
    // One beyond the bound that is not between two segments.
    let mut domain = star();
    domain.corrupt(|whole| whole.parameters.quality_bound = 0.9);
    let report = domain.report(3);
    let first = report.first.expect("the bound is broken");
    assert_eq!(first.kind, Kind::RadiusEdge);
    domain.corrupt(|whole| {
        let forced = &mut whole.boundary.forced;
        forced.push(first.simplex);
        forced.sort_unstable();
    });
    assert_eq!(domain.report(3).violations, report.violations);
}

#[test]
fn a_forced_simplex_that_is_not_owned_up_to() {
    let domain = star();
    for at in 0..domain.case.mesh.boundary.forced.len() {
        let mut domain = domain.clone();
        domain.corrupt(|whole| {
            whole.boundary.forced.remove(at);
        });
        domain.assert_violates(Kind::RadiusEdge);
    }
}
