//! Points that other programs compute on slanted segments, some units in the last place beside
//! them: each input ends in a mesh that keeps its certificate, and no gap of roundings is refined.

use netmesh::options::{Crossings, Extent, Options};
use netmesh::validate::validate_mesh;
use netmesh::{Error, ErrorKind, Mesh, Stats};

type Point = [f64; 2];

/// Meshes with every rule of `extents`, three angles and both rules of crossings, and certifies.
fn check(points: &[Point], segments: &[[u32; 2]], extents: &[Extent]) -> Vec<Stats> {
    let mut all = Vec::new();
    for &extent in extents {
        for min_angle in [0.0, 20.7, 30.0] {
            for crossings in [Crossings::Refuse, Crossings::Split] {
                let options = Options {
                    extent,
                    min_angle,
                    crossings,
                    max_vertices: 5000,
                    ..Options::default()
                };
                let case = format!("{points:?} {extent:?} {min_angle} {crossings:?}");
                let mesh = run(points, segments, &options)
                    .unwrap_or_else(|error| panic!("{case}: {error}"));
                certify(&mesh, &case);
                all.push(mesh.result().unwrap().stats.clone());
            }
        }
    }
    all
}

/// Checks that the certificate finds no violation at level 3.
fn certify(mesh: &Mesh, case: &str) {
    let report = validate_mesh(mesh, 3).unwrap();
    assert_eq!(report.first.map(|violation| violation.message), None, "{case}");
}

fn run(points: &[Point], segments: &[[u32; 2]], options: &Options) -> Result<Mesh, Error> {
    let mut mesh = Mesh::new(2, points.len(), points.as_flattened(), 0)?;
    mesh.set_segments(segments.as_flattened(), None)?;
    mesh.run(options, None)?;
    Ok(mesh)
}

const ALL: [Extent; 3] = [Extent::All, Extent::Hull, Extent::Box];

#[test]
fn a_point_beside_a_segment_is_on_it() {
    let cases: [(&[Point], &[[u32; 2]]); 4] = [
        (&[[3.9, 2.2], [8.7, 8.2], [5.34, 4.0]], &[[0, 1]]),
        (&[[1.2, 1.8], [0.2, 0.0], [0.0, 0.6], [0.5, 0.54]], &[[0, 1], [3, 2]]),
        (&[[0.0, 0.0], [5.0, 7.0], [4.5, 6.3]], &[[0, 1]]),
        (&[[1.0, 1.0], [2.0, 3.0], [1.1, 1.2]], &[[0, 1]]),
    ];
    for (points, segments) in cases {
        let all = check(points, segments, &[Extent::All, Extent::Box]);
        assert!(all.iter().all(|stats| stats.near_inputs > 0), "{points:?}");
        assert!(all.iter().all(|stats| stats.farthest_near_input <= 3.0), "{points:?}");
        assert!(all.iter().all(|stats| stats.precision_limited == 0), "{points:?}");
    }
}

/// Hulls and boxes, and the boundary of a box beside a segment of the caller's.
#[test]
fn extents_go_through_what_is_beside_them() {
    let down = 1000.9999999999999;
    let boxed = [[1002.0, 1001.0], [1001.0, 1005.0], [1002.0, down], [1005.0, 1005.0]];
    check(&boxed, &[[2, 3]], &[Extent::Box, Extent::Hull]);
    let low = 1004.9999999999999;
    let hull = [[1000.0, 1005.0], [1003.0, low], [1004.0, 1001.0], [1003.0, 1005.0], [1004.0, low]];
    check(&hull, &[[4, 3]], &[Extent::Hull, Extent::Box]);
    let tiny = [[0.0, 2.0], [-5e-324, 0.0], [-5e-324, 4.0], [2.0, 3.0]];
    check(&tiny, &[[1, 2]], &[Extent::Box]);
}

/// Corners of two parcels that are one up to rounding, with sides along each other.
#[test]
fn parcels_share_a_side() {
    let slanted = [
        [[0.7, 0.6], [1.8, 8.8], [-1.6, 8.4], [-1.7, 1.8]],
        [[0.7, 0.5999999999999996], [1.58, 7.160000000000001], [5.7, 6.6], [4.2, 1.8]],
    ];
    let other = [
        [[2.9, 4.4], [8.8, 2.2], [9.1, 4.8], [4.2, 6.0]],
        [[2.9000000000000004, 4.4], [7.620000000000001, 2.64], [6.5, -0.3], [3.2, 1.6]],
    ];
    let rings = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]];
    for parcels in [slanted, other] {
        let extents = [Extent::All, Extent::Hull, Extent::Box, Extent::Boundary];
        check(parcels.as_flattened(), &rings, &extents);
    }
}

/// Inputs on one slanted line, but for roundings, have a hull without area.
#[test]
fn a_hull_of_roundings_has_no_area() {
    let points = [[7.2, 7.0], [6.5, 3.3], [6.78, 4.78], [6.36, 2.5599999999999996]];
    let options = Options { extent: Extent::Hull, ..Options::default() };
    let error = run(&points, &[[0, 1], [2, 3]], &options).unwrap_err();
    assert!(error.message().contains("has no area"), "{error}");
}

/// Four lines through nearly one point, at small angles with each other.
#[test]
fn lines_through_nearly_one_point_meet_there() {
    let points = [
        [8.129602347798013, 1.374360814383511],
        [11.603412013261593, -1.095538348983938],
        [10.715592481824983, -0.7308830283414701],
        [8.324295526649948, 1.4937746449867797],
        [11.99960679390895, -2.8481508280242114],
        [8.643525965107315, 1.5129577869595292],
        [10.27527642739888, 2.2470088076456887],
        [8.777939646024274, -1.3202275037813909],
    ];
    let segments = [[0, 1], [2, 3], [4, 5], [6, 7]];
    for extent in ALL {
        let crossings = Crossings::Split;
        let options = Options { extent, crossings, max_vertices: 20_000, ..Options::default() };
        let mesh = run(&points, &segments, &options).unwrap();
        certify(&mesh, &format!("{extent:?}"));
    }
    // They do cross.
    let refused = run(&points, &segments, &Options::default()).unwrap_err();
    assert!(refused.message().contains("cross near"), "{refused}");
}

/// Vertices that lines must share, each farther on than the last, come to where the lines are too
/// far apart to share the next. The first of these stars needs one between, in the second a line
/// goes on through vertices that it passes where it returns to its end. In the third many lines are
/// crowded within some units, where one vertex at a time makes room.
#[test]
fn lines_share_vertices_up_to_where_they_part() {
    let stars: [[Point; 16]; 3] = [
        [
            [8.107716614671837, 0.40238155079723903],
            [9.613462996975437, 6.208758987813949],
            [9.628542772918717, 3.736377410958892],
            [8.234168616767187, 9.099340247229005],
            [8.655550685515125, 8.024044294287965],
            [9.77934357488338, 2.750705648917709],
            [7.708183981082854, 1.851677531283865],
            [10.148651607656689, 6.678478475367504],
            [7.6090839126933165, 2.712079081230307],
            [10.17139036025516, 6.179048593013027],
            [7.997968349774522, 6.242530543411668],
            [11.62148032491679, 2.784608224278702],
            [6.93811095895569, 7.7347176564275415],
            [11.25259854876859, 2.7391801077703226],
            [9.02236405502597, 6.1828615566221625],
            [10.090695613113226, 1.6312595300694661],
        ],
        [
            [5.0984023841868495, 4.8988988057438165],
            [3.8034576269446716, 8.796487803377904],
            [1.9283465492159602, 10.538937259949432],
            [6.380072568824016, 3.8934474166155995],
            [7.636984908834623, 8.58751750133024],
            [3.0216915130719535, 5.810504760930358],
            [5.174945523828649, 4.234705791722568],
            [3.3508552778713914, 10.897345901141879],
            [1.8518537965452033, 10.60018481249147],
            [6.05445125331674, 4.4106070797621015],
            [6.437883641297179, 3.8057735850719876],
            [3.2658178643005815, 8.543249234294843],
            [7.1954211167630335, 8.359540599994325],
            [3.1808364002834, 5.887805742802295],
            [-0.06309541266384855, 5.952514238155847],
            [8.445801359068481, 7.346366132687806],
        ],
        [
            [2.0355047094452194, 11.455090430641098],
            [4.206731467376292, 3.6771521995850422],
            [3.0154078769504284, 10.594485620275803],
            [2.977423219507573, 4.198364477586498],
            [3.079002259564903, 9.77090444620364],
            [2.847223392771356, 4.575379305514119],
            [1.7794922098094563, 10.14480271648852],
            [4.661805671640902, 5.079702933928025],
            [1.3825651070595488, 8.524743905546062],
            [5.368225830673857, 7.231677221119146],
            [5.083148474760987, 4.671674054178567],
            [2.1714243307186534, 9.32384701885538],
            [6.056772405474801, 7.9750526125565395],
            [-0.22177867182501387, 8.026294061225867],
            [-0.3502544467769404, 7.234409024994348],
            [6.387836347654639, 8.77417908811545],
        ],
    ];
    let segments = [[0, 1], [2, 3], [4, 5], [6, 7], [8, 9], [10, 11], [12, 13], [14, 15]];
    for points in stars {
        let options = Options {
            extent: Extent::Box,
            crossings: Crossings::Split,
            max_vertices: 50_000,
            ..Options::default()
        };
        certify(&run(&points, &segments, &options).unwrap(), &format!("{:?}", points[0]));
    }
}

/// Vertices as far from a sharp angle on both of its lines encroach each other by their roundings.
/// The lines are not split there down to where doubles cannot tell them apart.
#[test]
fn lines_at_a_sharp_angle_are_told_apart() {
    let points: [Point; 14] = [
        [3.762071048728739, 5.977546240397836],
        [7.608891581644507, 6.816123834059883],
        [1.7778066920956421, 4.5000539882832875],
        [8.749460427101127, 7.877186288774325],
        [7.46127245636627, 7.122655846435862],
        [1.445464216270488, 4.6543500598845835],
        [8.154212421166672, 8.674930033502827],
        [4.194894281964561, 5.004843585655081],
        [7.974701858324946, 4.480750964327132],
        [2.333562998196184, 9.240385849125406],
        [9.194254845126105, 7.859830457392531],
        [3.2072395583669033, 5.3585740660115135],
        [8.679164280772977, 7.539756502343554],
        [2.414344149732036, 5.142987204843095],
    ];
    let segments: Vec<[u32; 2]> = (0..7).map(|at| [2 * at, 2 * at + 1]).collect();
    for extent in ALL {
        let options = Options { extent, crossings: Crossings::Split, ..Options::default() };
        for options in
            [options.clone(), Options { min_angle: 30.0, max_vertices: 50000, ..options }]
        {
            let mesh = run(&points, &segments, &options).unwrap();
            certify(&mesh, &format!("{options:?}"));
        }
    }
}

/// Two lines at a sharp angle end a unit apart, as shapely cuts arcs where they cross. Edges there
/// are short in units of x, which y is finer than.
#[test]
fn lines_that_end_a_unit_apart_are_told_apart() {
    let points: [Point; 4] = [
        [-122.53963295875424, 39.731156018167844],
        [-122.55442568658988, 39.78636323003301],
        [-122.56396340307903, 39.75076798750735],
        [-122.5544256865899, 39.78636323003301],
    ];
    check(&points, &[[0, 1], [2, 3]], &[Extent::All, Extent::Hull, Extent::Box]);
}

/// Two lines between which a run finds no room share vertices, each twice as far on as the
/// last: vertices at equal distances would not get to where there is room.
#[test]
fn lines_that_have_no_room_share_vertices() {
    let points: [Point; 12] = [
        [2.2526641206813203, 0.07852692323127353],
        [7.028202362146722, 4.330188384069681],
        [0.8326822007128554, 2.265433305385238],
        [5.009458678681938, 0.3693866149730004],
        [4.775868947946355, 2.3159187008424387],
        [0.2839305455102319, -1.6538139649807198],
        [7.654672388373763, 3.6640390938274487],
        [0.4382931262582712, -0.6848453454330121],
        [0.7345282178786738, -1.4096005425942395],
        [6.748221510128947, 4.252424488192476],
        [4.661059340873113, 2.052920492242757],
        [0.9446134813990414, -0.7554147724178224],
    ];
    let segments: Vec<[u32; 2]> = (0..6).map(|at| [2 * at, 2 * at + 1]).collect();
    for extent in ALL {
        let options = Options { extent, crossings: Crossings::Split, ..Options::default() };
        let mesh = run(&points, &segments, &options).unwrap();
        certify(&mesh, &format!("{extent:?}"));
    }
}

/// Each of two sides from one vertex ends beyond the other's end, by less than rounding explains.
#[test]
fn sides_that_end_beyond_each_other_have_a_mesh() {
    let points: [Point; 8] = [
        [7.4, 4.5],
        [0.3, 0.7],
        [2.5, -1.8],
        [7.8, 2.0],
        [5.27, 3.3599999999999994],
        [0.2999999999999998, 0.7000000000000002],
        [-0.2, 5.0],
        [4.5, 6.6],
    ];
    let segments: Vec<[u32; 2]> = [0, 4]
        .into_iter()
        .flat_map(|first| (0..4).map(move |at| [first + at, first + (at + 1) % 4]))
        .collect();
    check(&points, &segments, &[Extent::All, Extent::Hull, Extent::Boundary]);
}

/// A mesh between two lines a few units apart would have as many vertices as the gap fits into
/// them.
#[test]
fn lines_that_run_along_each_other_share_vertices() {
    for units in 1..16 {
        let unit = 7.0f64.next_up() - 7.0;
        let beside = |x: f64| [x, 0.2 + (x - 0.1) * 6.9 / 10.2 + f64::from(units) * unit];
        let points = [[0.1, 0.2], [10.3, 7.1], beside(1.1), beside(9.2), [2.0, 9.0], [8.0, -3.0]];
        for stats in check(&points, &[[0, 1], [2, 3]], &[Extent::All, Extent::Box]) {
            assert!(stats.near_inputs == 2 && stats.farthest_near_input <= 12.0, "{stats:?}");
        }
    }
}

#[test]
fn a_hull_that_is_a_line_within_roundings_has_no_area() {
    let points = [[7.69, 5.57], [5.43, 5.64], [5.882, 5.625999999999997]];
    for segments in [&[[0, 1]][..], &[]] {
        let options = Options { extent: Extent::Hull, ..Options::default() };
        let error = run(&points, segments, &options).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::DegenerateInput, "{error}");
        assert!(
            error.message().starts_with("options.extent = Extent::Hull has no area"),
            "{error}"
        );
    }
}

/// Holds that two segments which leave an input at a hundred units over their length do not cross:
/// the input is on both. Their gap asks for more vertices than are allowed.
#[test]
fn an_end_that_counts_as_on_a_segment_is_no_crossing() {
    let points = [[8.6, 6.6], [1.0, 7.7], [4.8, 7.15], [1.980306536035, 7.558113527679]];
    for extent in ALL {
        for crossings in [Crossings::Refuse, Crossings::Split] {
            let options = Options { extent, crossings, max_vertices: 2000, ..Options::default() };
            match run(&points, &[[0, 1], [2, 3]], &options) {
                Ok(mesh) => certify(&mesh, &format!("{options:?}")),
                Err(error) => {
                    assert_eq!(error.kind(), ErrorKind::Limit, "{extent:?}: {}", error.message());
                }
            }
        }
    }
}
