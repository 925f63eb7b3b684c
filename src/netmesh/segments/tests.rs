//! Domains of all sorts, and what must hold of them: checked with integers, from the arrays alone.

use crate::error::ErrorKind;
use crate::mesh::{Mesh, NONE, Region, Triangulation};
use crate::options::{Extent, Options, Output};
use crate::validate::validate;
use dashu_int::IBig;
use std::collections::{HashMap, HashSet};

/// Points, and segments between them.
#[derive(Clone, Default)]
struct Domain {
    points: Vec<[f64; 2]>,
    segments: Vec<[u32; 2]>,
    regions: Vec<Region>,
}

impl Domain {
    /// Adds the closed curve through `points`.
    fn curve(mut self, points: &[[f64; 2]]) -> Self {
        let (first, count) = (self.points.len() as u32, points.len() as u32);
        self.points.extend(points);
        self.segments.extend((0..count).map(|i| [first + i, first + (i + 1) % count]));
        self
    }

    fn hole(mut self, seed: [f64; 2]) -> Self {
        self.regions.push(Region { is_hole: true, ..Region::in_plane(seed) });
        self
    }

    /// Adds a segment between new points.
    fn segment(mut self, a: [f64; 2], b: [f64; 2]) -> Self {
        let first = self.points.len() as u32;
        self.points.extend([a, b]);
        self.segments.push([first, first + 1]);
        self
    }

    fn region(mut self, seed: [f64; 2], label: i32) -> Self {
        self.regions.push(Region { label, ..Region::in_plane(seed) });
        self
    }

    fn mesh(&self, options: &Options) -> Mesh {
        let mut mesh = Mesh::new(2, self.points.len(), self.points.as_flattened(), 0).unwrap();
        mesh.set_segments(self.segments.as_flattened(), None).unwrap();
        mesh.set_regions(&self.regions).unwrap();
        mesh.run(options, None).unwrap();
        mesh
    }
}

fn inside(min_angle: f64) -> Options {
    let output = Output::WellSpaced;
    Options { extent: Extent::Boundary, min_angle, output, ..Options::default() }
}

fn circle(count: usize, center: [f64; 2], radius: f64) -> Vec<[f64; 2]> {
    let angle = |i: usize| std::f64::consts::TAU * i as f64 / count as f64;
    let point = |i| [center[0] + radius * angle(i).cos(), center[1] + radius * angle(i).sin()];
    (0..count).map(point).collect()
}

fn square(half: f64) -> [[f64; 2]; 4] {
    [[-half, -half], [half, -half], [half, half], [-half, half]]
}

/// Returns `value` in units of 2^-1100.
fn whole(value: f64) -> IBig {
    let (mantissa, exponent) = crate::numerics::testing::decomposed(value);
    IBig::from(mantissa) << (exponent + 1100) as usize
}

fn point(mesh: &Triangulation, vertex: u32) -> [IBig; 2] {
    [0, 1].map(|axis| whole(mesh.point(vertex)[axis]))
}

fn cross(a: &[IBig; 2], b: &[IBig; 2], c: &[IBig; 2]) -> IBig {
    (&b[0] - &a[0]) * (&c[1] - &a[1]) - (&b[1] - &a[1]) * (&c[0] - &a[0])
}

fn dot(a: &[IBig; 2], b: &[IBig; 2], c: &[IBig; 2]) -> IBig {
    (&b[0] - &a[0]) * (&c[0] - &a[0]) + (&b[1] - &a[1]) * (&c[1] - &a[1])
}

/// Returns twice the area of the simplices that are selected, in units of 2^-2200.
fn area(mesh: &Triangulation, selects: impl Fn(usize) -> bool) -> IBig {
    let area = |simplex: usize| {
        let [a, b, c] = [0, 1, 2].map(|i| point(mesh, mesh.simplex(simplex)[i]));
        cross(&a, &b, &c)
    };
    (0..mesh.simplex_count()).filter(|&simplex| selects(simplex)).map(area).sum()
}

/// Returns the smallest angle in degrees of the simplices that no corner forces.
fn least_angle(mesh: &Triangulation) -> f64 {
    let is_free = |simplex: &usize| !mesh.boundary.forced.contains(&(*simplex as u32));
    let angle = |simplex: usize| {
        let [a, b, c] = [0, 1, 2].map(|i| mesh.point(mesh.simplex(simplex)[i]));
        let side = |p: &[f64], q: &[f64]| crate::numerics::norm(&[p[0] - q[0], p[1] - q[1]]);
        let mut sides = [side(a, b), side(b, c), side(c, a)];
        sides.sort_by(f64::total_cmp);
        let [least, x, y] = sides.map(|side| side / sides[2]);
        ((x * x + y * y - least * least) / (2.0 * x * y)).clamp(-1.0, 1.0).acos().to_degrees()
    };
    (0..mesh.simplex_count()).filter(is_free).map(angle).fold(180.0, f64::min)
}

/// Checks that every segment is a chain of Gabriel edges from end to end, and that the vertices on
/// it are as near to it as doubles can be.
fn assert_conforming(domain: &Domain, mesh: &Triangulation) {
    let all = mesh.boundary.whole.as_deref().unwrap_or(mesh);
    let mut apexes: HashMap<[u32; 2], Vec<u32>> = HashMap::new();
    for simplex in 0..all.simplex_count() {
        let v = all.simplex(simplex);
        for [a, b, c] in [[0, 1, 2], [1, 2, 0], [2, 0, 1]].map(|i| i.map(|i: usize| v[i])) {
            apexes.entry([a.min(b), a.max(b)]).or_default().push(c);
        }
    }
    let mut chains: HashMap<u32, Vec<[u32; 2]>> = HashMap::new();
    for (&[a, b], &parent) in all.boundary.subsegments.iter().zip(&all.boundary.parents) {
        chains.entry(parent).or_default().push([a, b]);
        let apexes = &apexes[&[a.min(b), a.max(b)]];
        assert_eq!(apexes.len(), 2, "an edge between {a} and {b}");
        for &apex in apexes {
            let [a, b, c] = [a, b, apex].map(|vertex| point(all, vertex));
            assert!(dot(&c, &a, &b) >= IBig::ZERO, "{apex} encroaches");
        }
    }
    for (segment, ends) in domain.segments.iter().enumerate() {
        let chain = &chains[&(segment as u32)];
        assert_eq!([chain[0][0], chain[chain.len() - 1][1]], *ends, "segment {segment}");
        assert!(chain.windows(2).all(|pair| pair[0][1] == pair[1][0]), "segment {segment}");
        let [from, to] = ends.map(|end| point(all, end));
        for vertex in chain[1..].iter().map(|part| part[0]) {
            // Corners of the box of half a unit round the vertex are on both sides of the line.
            let x = all.point(vertex);
            let half = |x: f64| whole(x.abs().next_up()) - whole(x.abs());
            let corner = |signs: [i32; 2]| {
                std::array::from_fn(|axis| {
                    whole(x[axis]) * 2 + half(x[axis]) * IBig::from(signs[axis])
                })
            };
            let [from, to] = [&from, &to].map(|p| [0, 1].map(|axis| &p[axis] * IBig::from(2)));
            let sides = [[1, 1], [1, -1], [-1, 1], [-1, -1]].map(|s| cross(&from, &to, &corner(s)));
            let is_met =
                sides.iter().any(|s| *s <= IBig::ZERO) && sides.iter().any(|s| *s >= IBig::ZERO);
            assert!(is_met, "vertex {vertex} on segment {segment}");
        }
    }
}

/// Checks the certificate of the triangulation that the domain is cut from, and that ids agree.
fn assert_cut(mesh: &Mesh) {
    let result = mesh.result().unwrap();
    let whole = result.boundary.whole.as_deref().expect("the domain is cut out");
    let report = validate(mesh.inputs(), whole, 2).unwrap();
    assert_eq!((report.level, report.violations), (2, 0), "{report:?}");
    assert_eq!(whole.points[..result.points.len()], result.points);
    assert_eq!(whole.simplices[..result.simplices.len()], result.simplices);
    let count = result.simplex_count() as u32;
    let subsegments: HashSet<[u32; 2]> =
        whole.boundary.subsegments.iter().map(|&[a, b]| [a.min(b), a.max(b)]).collect();
    for (at, (&own, &beyond)) in result.neighbors.iter().zip(&whole.neighbors).enumerate() {
        assert_eq!(own, if beyond < count { beyond } else { NONE });
        if own == NONE {
            let facet: Vec<u32> =
                (0..3).filter(|&i| i != at % 3).map(|i| result.simplices[at / 3 * 3 + i]).collect();
            let edge = [facet[0].min(facet[1]), facet[0].max(facet[1])];
            assert!(subsegments.contains(&edge), "the domain ends at segments");
        }
    }
}

fn assert_good(domain: &Domain, mesh: &Mesh, min_angle: f64) {
    let result = mesh.result().unwrap();
    assert_conforming(domain, result);
    assert_cut(mesh);
    let least = least_angle(result);
    assert!(least > min_angle - 1e-6, "{least}");
    assert_eq!(result.stats.precision_limited, 0);
}

fn polygon_area(points: &[[f64; 2]]) -> IBig {
    let points: Vec<[IBig; 2]> = points.iter().map(|p| p.map(whole)).collect();
    let origin = [IBig::ZERO, IBig::ZERO];
    (0..points.len()).map(|i| cross(&origin, &points[i], &points[(i + 1) % points.len()])).sum()
}

#[test]
fn a_lake_with_an_island_is_cut_to_its_water() {
    let (outer, inner) = (circle(24, [0.0, 0.0], 1.0), circle(9, [0.25, 0.125], 0.25));
    let domain = Domain::default().curve(&outer).curve(&inner).hole([0.25, 0.125]);
    for angle in [20.0, 30.0] {
        let mesh = domain.mesh(&inside(angle));
        assert_good(&domain, &mesh, angle);
        let result = mesh.result().unwrap();
        // No subsegment was split: the area is that of the polygons.
        assert_eq!(result.boundary.subsegments.len(), 33);
        assert_eq!(area(result, |_| true), polygon_area(&outer) - polygon_area(&inner));
    }
}

#[test]
fn regions_have_the_labels_of_their_seeds() {
    let (outer, inner) = (square(1.0), square(0.5));
    let domain =
        Domain::default().curve(&outer).curve(&inner).region([0.75, 0.0], 7).region([0.0, 0.0], -3);
    let mesh = domain.mesh(&inside(25.0));
    assert_good(&domain, &mesh, 25.0);
    let result = mesh.result().unwrap();
    let labelled =
        |label| area(result, |simplex| result.boundary.simplex_regions[simplex] == label);
    // Vertices on these segments are exact.
    assert_eq!(labelled(-3), polygon_area(&inner));
    assert_eq!(labelled(7), polygon_area(&outer) - polygon_area(&inner));
}

#[test]
fn small_angles_force_some_simplices_and_no_others() {
    let rays: Vec<[f64; 2]> = (0..40)
        .map(|i| (0.1 * 1.15f64.powi(i)).to_radians())
        .map(|angle| [angle.cos(), angle.sin()])
        .collect();
    let mut domain = Domain::default().curve(&square(2.0));
    domain.points.push([0.0, 0.0]);
    for ray in &rays {
        domain.segments.push([4, domain.points.len() as u32]);
        domain.points.push(*ray);
    }
    let mesh = domain.mesh(&inside(20.0));
    assert_good(&domain, &mesh, 20.0);
    let forced = &mesh.result().unwrap().boundary.forced;
    assert!(!forced.is_empty());
    assert!(mesh.result().unwrap().vertex_count() < 600);
}

#[test]
fn a_component_in_a_cage_costs_the_same_at_every_scale() {
    let vertices = |scale: f64| {
        let small: Vec<[f64; 2]> =
            circle(12, [0.0; 2], 1.0).iter().map(|p| p.map(|x| x * scale)).collect();
        let domain = Domain::default().curve(&circle(12, [0.0; 2], 1.0)).curve(&small);
        let options = Options { output: Output::Hierarchical, ..inside(20.0) };
        let mesh = domain.mesh(&options);
        assert_conforming(&domain, mesh.result().unwrap());
        assert_cut(&mesh);
        let result = mesh.result().unwrap();
        assert_eq!(result.domains.len(), 2);
        result.vertex_count()
    };
    let near = vertices(2f64.powi(-20));
    for exponent in [-100, -500, -900] {
        let far = vertices(2f64.powi(exponent));
        assert!(far * 20 <= near * 23, "2^{exponent}: {far} vertices, {near} at 2^-20");
    }
}

#[test]
fn clusters_in_clusters_have_cages_in_cages() {
    let parents = |exponents: &[i32]| {
        let circles = exponents.iter().map(|&exponent| circle(12, [0.0; 2], 2f64.powi(exponent)));
        let domain = circles.fold(Domain::default(), |domain, curve| domain.curve(&curve));
        let options = Options { output: Output::Hierarchical, ..inside(20.0) };
        let mesh = domain.mesh(&options);
        assert_conforming(&domain, mesh.result().unwrap());
        assert_cut(&mesh);
        mesh.result().unwrap().domains.iter().map(|domain| domain.parent).collect::<Vec<_>>()
    };
    assert_eq!(parents(&[-20, 0, -60, -40]), [NONE, 0, 1, 2]);
    // There is too little room for a cage.
    assert_eq!(parents(&[0, -3]), [NONE]);
}

/// A cage stands where no segment crosses it, and only there.
#[test]
fn a_segment_into_a_cage_releases_it() {
    let small: Vec<[f64; 2]> = circle(12, [0.0; 2], 2f64.powi(-40)).to_vec();
    let mut domain = Domain::default().curve(&square(1.0)).curve(&small);
    domain.segments.push([2, 4]);
    let options = Options { output: Output::Hierarchical, ..inside(20.0) };
    let mesh = domain.mesh(&options);
    let result = mesh.result().unwrap();
    assert_eq!(result.domains.len(), 1);
    assert_good(&domain, &mesh, 20.0);
}

#[test]
fn nested_squares_conform_to_the_last() {
    let curves: Vec<[[f64; 2]; 4]> = (1..=300).map(|k| square(2f64.powi(-3 * k))).collect();
    let domain = curves.iter().fold(Domain::default(), |domain, curve| domain.curve(curve));
    assert_good(&domain, &domain.mesh(&inside(20.0)), 20.0);
}

#[test]
fn segments_that_end_in_the_domain_are_edges_too() {
    let mut domain = Domain::default().curve(&square(1.0));
    for i in 0..20 {
        let y = -0.9 + 0.09 * f64::from(i);
        domain.segments.push([4 + 2 * i as u32, 5 + 2 * i as u32]);
        domain.points.extend([[-0.7, y], [0.3 + 0.02 * f64::from(i), y + 0.05]]);
    }
    assert_good(&domain, &domain.mesh(&inside(28.0)), 28.0);
}

/// All of the mesh, to the outer cage, is refined and kept.
#[test]
fn without_a_cut_the_mesh_reaches_to_its_cage() {
    let domain = Domain::default().curve(&circle(30, [3.0, 4.0], 1.0));
    let options = Options { extent: Extent::All, ..inside(20.0) };
    let mesh = domain.mesh(&options);
    let result = mesh.result().unwrap();
    assert!(result.boundary.whole.is_none());
    assert_eq!(result.boundary.simplex_regions.len(), result.simplex_count());
    assert_conforming(&domain, result);
    let report = validate(mesh.inputs(), result, 3).unwrap();
    assert_eq!((report.level, report.violations), (3, 0), "{report:?}");
}

#[test]
fn a_seed_on_a_segment_is_refused() {
    let domain = Domain::default().curve(&square(1.0)).hole([1.0, 0.25]);
    assert_seed_refused(&domain, "regions[0].seed is on segments[1];");
}

fn assert_seed_refused(domain: &Domain, message: &str) {
    let points = domain.points.as_flattened();
    let mut mesh = Mesh::new(2, domain.points.len(), points, 0).unwrap();
    mesh.set_segments(domain.segments.as_flattened(), None).unwrap();
    mesh.set_regions(&domain.regions).unwrap();
    let error = mesh.run(&inside(20.0), None).expect_err(message);
    assert_eq!(error.kind(), ErrorKind::InvalidArgument);
    assert!(error.message().starts_with(message), "{}", error.message());
    assert!(mesh.triangulation().is_none());
}

/// A triangle at an end of segments need have none of them for a side. Inputs all round the end let
/// the seed be found in such triangles, on either side.
#[test]
fn a_seed_at_an_end_of_segments_is_refused() {
    for center in [[0.0, 0.0], [0.25, -0.125], [-0.5, 0.375]] {
        for spokes in [vec![0], vec![3, 8], vec![1, 4, 6, 9]] {
            for is_hole in [false, true] {
                let mut domain = Domain::default().curve(&square(1.0));
                domain.points.push(center);
                domain.points.extend(circle(11, center, 0.25));
                domain.segments.extend(spokes.iter().map(|spoke| [4, 5 + spoke]));
                domain.regions.push(Region {
                    seed: [center[0], center[1], 0.0],
                    label: 7,
                    is_hole,
                    ..Region::default()
                });
                assert_seed_refused(&domain, "regions[0].seed is on segments[4];");
            }
        }
    }
}

/// The middle of a segment becomes a vertex of its chain.
#[test]
fn a_seed_at_a_vertex_on_a_segment_is_refused() {
    let seed = [-0.125, 0.125];
    for [x, y] in [[0.5, 0.5], [0.5, -0.25], [0.5, 0.125], [-0.25, -0.5], [0.0, -0.625]] {
        let ends = [1.0, -1.0].map(|side| [seed[0] + side * x, seed[1] + side * y]);
        let mut domain = Domain::default().curve(&square(1.0)).segment(ends[0], ends[1]);
        domain.points.extend(circle(11, seed, 0.25));
        assert_seed_refused(&domain.region(seed, 7), "regions[0].seed is on segments[4];");
    }
}

/// Two segments an ulp apart are one between the ends that they have in common.
#[test]
fn segments_an_ulp_apart_are_one() {
    let up = 0.5f64.next_up();
    let mut domain = Domain::default().curve(&square(1.0));
    domain.points.extend([[0.25, 0.5], [0.75, 0.5], [0.25, up], [0.75, up]]);
    domain.segments.extend([[4, 5], [6, 7]]);
    let mut mesh = Mesh::new(2, 8, domain.points.as_flattened(), 0).unwrap();
    mesh.set_segments(domain.segments.as_flattened(), None).unwrap();
    mesh.run(&Options { max_vertices: 5000, ..inside(20.0) }, None).unwrap();
    let report = crate::validate::validate_mesh(&mesh, 3).unwrap();
    assert_eq!(report.first.map(|violation| violation.message), None);
    assert!(mesh.result().unwrap().vertex_count() < 2000);
}

#[test]
fn the_same_options_give_the_same_mesh() {
    let domain =
        Domain::default().curve(&circle(200, [0.0; 2], 1.0)).curve(&circle(50, [0.5, 0.0], 0.1));
    let [a, b] = [1, 16].map(|threads| domain.mesh(&Options { threads, ..inside(30.0) }));
    let (a, b) = (a.result().unwrap(), b.result().unwrap());
    assert_eq!((&a.points, &a.simplices), (&b.points, &b.simplices));
    assert_eq!(a.boundary.subsegments, b.boundary.subsegments);
}

/// Random points, cut to their hull and to their box.
#[test]
fn points_alone_are_cut_to_hull_and_box() {
    let mut random = crate::numerics::testing::Random(5);
    let mut draw = || random.unit();
    let domain =
        Domain { points: (0..300).map(|_| [draw(), draw()]).collect(), ..Domain::default() };
    let low = |axis: usize| domain.points.iter().map(|p| p[axis]).fold(f64::MAX, f64::min);
    let high = |axis: usize| domain.points.iter().map(|p| p[axis]).fold(f64::MIN, f64::max);
    for (extent, corners) in [(Extent::Hull, 0), (Extent::Box, 4)] {
        let mesh = domain.mesh(&Options { extent, ..inside(25.0) });
        assert_cut(&mesh);
        let result = mesh.result().unwrap();
        assert!(least_angle(result) > 25.0 - 1e-6);
        assert!(result.boundary.parents.iter().all(|&parent| parent == NONE));
        if corners == 4 {
            let sides =
                [[low(0), low(1)], [high(0), low(1)], [high(0), high(1)], [low(0), high(1)]];
            assert_eq!(area(result, |_| true), polygon_area(&sides));
        } else {
            let count = result.vertex_count();
            let ends = result.boundary.subsegments.iter().flatten();
            assert!(ends.clone().any(|&v| (v as usize) < 300) && count > 300);
        }
    }
}

#[test]
fn extents_that_cannot_be_are_refused() {
    let refusal = |dim: usize, extent| {
        let mut mesh =
            Mesh::new(dim, 2, &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0][..2 * dim], 0).unwrap();
        mesh.run(&Options { extent, ..Options::default() }, None).unwrap_err().message().to_owned()
    };
    assert!(
        refusal(4, Extent::Box)
            == "options.extent = Extent::Box is for 2D and 3D; the mesh has dimension 4"
    );
    assert!(refusal(2, Extent::Boundary).contains("needs segments; the mesh has none"));
}

/// A location query finds no simplex at a point in a hole.
#[test]
fn points_in_holes_are_outside() {
    let (outer, inner) = (circle(40, [0.0; 2], 1.0), circle(10, [0.0; 2], 0.5));
    let domain = Domain::default().curve(&outer).curve(&inner).hole([0.0; 2]);
    let mesh = domain.mesh(&inside(30.0));
    let result = mesh.result().unwrap();
    let index = crate::query::Index::new(result).unwrap();
    let points: Vec<f64> = (0..400)
        .flat_map(|i| [f64::from(i % 20) / 9.5 - 1.0, f64::from(i / 20) / 9.5 - 1.0])
        .collect();
    let mut found = vec![0; 400];
    index.locate(result, &points, 1, &mut found).unwrap();
    for (x, &simplex) in points.chunks(2).zip(&found) {
        let [x, y] = [whole(x[0]), whole(x[1])];
        let holds = |simplex: usize| {
            let [a, b, c] = [0, 1, 2].map(|i| point(result, result.simplex(simplex)[i]));
            let q = [x.clone(), y.clone()];
            [cross(&a, &b, &q), cross(&b, &c, &q), cross(&c, &a, &q)]
                .iter()
                .all(|s| *s >= IBig::ZERO)
        };
        let expected = (0..result.simplex_count()).find(|&simplex| holds(simplex));
        assert_eq!(simplex, expected.map_or(NONE, |simplex| simplex as u32));
    }
    assert!(found.contains(&NONE) && found.iter().filter(|&&s| s != NONE).count() > 100);
}

/// A region with a largest edge keeps it, and the other one stays coarse.
#[test]
fn regions_have_sizes_of_their_own() {
    let mut domain =
        Domain::default().curve(&square(1.0)).curve(&square(0.25)).region([0.75, 0.0], 1);
    let fine = Region { seed: [0.0; 3], label: 2, is_hole: false, max_edge: 0.03 };
    domain.regions.push(fine);
    let mesh = domain.mesh(&inside(20.0));
    assert_good(&domain, &mesh, 20.0);
    let result = mesh.result().unwrap();
    let edge = |simplex: usize, i: usize| {
        let [p, q] = [i, (i + 1) % 3].map(|i| result.point(result.simplex(simplex)[i]));
        crate::numerics::norm(&[p[0] - q[0], p[1] - q[1]])
    };
    let longest = |label: i32| {
        let of_label = |&simplex: &usize| result.boundary.simplex_regions[simplex] == label;
        let edges = |simplex| (0..3).map(|i| edge(simplex, i)).fold(0.0, f64::max);
        (0..result.simplex_count()).filter(of_label).map(edges).fold(0.0, f64::max)
    };
    assert!(longest(2) <= 0.03 && longest(1) > 0.2, "{} {}", longest(2), longest(1));
    let mut mesh = Mesh::new(2, domain.points.len(), domain.points.as_flattened(), 0).unwrap();
    mesh.set_segments(domain.segments.as_flattened(), None).unwrap();
    mesh.set_regions(&domain.regions).unwrap();
    let hierarchical = Options { output: Output::Hierarchical, ..inside(20.0) };
    let error = mesh.run(&hierarchical, None).unwrap_err();
    assert!(
        error.message().ends_with("does not go with the largest edges of regions"),
        "{}",
        error.message()
    );
}
