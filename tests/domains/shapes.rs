//! Domains of the plane: points, segments between them, and what is known of their areas.

use super::exact::Point;
use crate::random::Random;
use netmesh::Region;
use std::f64::consts::TAU;

/// Points, segments and seeds, and the curves that enclose the area.
#[derive(Clone, Default)]
pub struct Domain {
    pub points: Vec<Point>,
    pub segments: Vec<[u32; 2]>,
    pub regions: Vec<Region>,
    /// Closed curves by their vertices, and how often what they enclose counts: 1 or -1.
    pub curves: Vec<(Vec<u32>, i32)>,
}

impl Domain {
    pub fn new(points: &[Point], segments: &[[u32; 2]]) -> Self {
        Self { points: points.to_vec(), segments: segments.to_vec(), ..Self::default() }
    }

    /// Adds a closed curve, counterclockwise, that encloses a part of the domain.
    pub fn around(self, points: &[Point]) -> Self {
        self.curve(points, 1)
    }

    /// Adds a closed curve within the domain, which changes no area.
    pub fn within(self, points: &[Point]) -> Self {
        self.curve(points, 0)
    }

    /// Adds a closed curve, counterclockwise, about a hole with a seed.
    pub fn hole(mut self, points: &[Point], seed: Point) -> Self {
        self.regions.push(Region { is_hole: true, ..Region::in_plane(seed) });
        self.curve(points, -1)
    }

    fn curve(mut self, points: &[Point], times: i32) -> Self {
        let (first, count) = (self.points.len() as u32, points.len() as u32);
        self.points.extend(points);
        self.segments.extend((0..count).map(|i| [first + i, first + (i + 1) % count]));
        self.curves.push(((first..first + count).collect(), times));
        self
    }

    /// Adds a segment between new points.
    pub fn segment(mut self, a: Point, b: Point) -> Self {
        let first = self.points.len() as u32;
        self.points.extend([a, b]);
        self.segments.push([first, first + 1]);
        self
    }

    /// All of it somewhere else.
    pub fn moved(mut self, place: impl Fn(Point) -> Point) -> Self {
        self.points.iter_mut().for_each(|point| *point = place(*point));
        self.regions.iter_mut().for_each(|region| {
            let [x, y, _] = region.seed;
            let [x, y] = place([x, y]);
            region.seed = [x, y, 0.0];
        });
        self
    }
}

pub fn circle(count: usize, center: Point, radius: f64) -> Vec<Point> {
    let angle = |i: usize| TAU * i as f64 / count as f64;
    let point = |i| [center[0] + radius * angle(i).cos(), center[1] + radius * angle(i).sin()];
    (0..count).map(point).collect()
}

pub fn square(half: f64) -> [Point; 4] {
    [[-half, -half], [half, -half], [half, half], [-half, half]]
}

/// A capital A, in the digits of a person.
pub fn letter_a() -> Domain {
    let outline = [
        [0.0, 0.0],
        [0.2, 0.0],
        [0.32, 0.28],
        [0.66, 0.28],
        [0.78, 0.0],
        [1.0, 0.0],
        [0.6, 1.0],
        [0.4, 1.0],
    ];
    let counter = [[0.39, 0.42], [0.59, 0.42], [0.495, 0.71]];
    Domain::default().around(&outline).hole(&counter, [0.49, 0.5])
}

/// A lake with islands, one of which has a lake with an island.
pub fn lakes() -> Domain {
    let (pond, islet) = (circle(11, [0.25, 0.125], 0.18), circle(6, [0.25, 0.125], 0.07));
    Domain::default()
        .around(&circle(40, [0.0, 0.0], 1.0))
        .hole(&circle(17, [0.25, 0.125], 0.375), [0.25, 0.125 + 0.25])
        .hole(&circle(7, [-0.5, -0.25], 0.2), [-0.5, -0.25])
        .hole(&circle(5, [-0.375, 0.5], 0.125), [-0.375, 0.5])
        .around(&pond)
        .hole(&islet, [0.25, 0.125])
}

/// A band that turns inwards.
pub fn spiral(count: usize) -> Domain {
    let arm = |inner: f64| {
        (0..count).map(move |i| {
            let angle = 0.02 + 5.0 * TAU * i as f64 / count as f64;
            let radius = 1.0 - 0.028 * angle - inner;
            [radius * angle.cos(), radius * angle.sin()]
        })
    };
    let mut points: Vec<Point> = arm(0.0).collect();
    points.extend(arm(0.05).rev());
    Domain::default().around(&points)
}

/// A wheel with teeth, an axle and spokes' holes.
pub fn gear(teeth: usize) -> Domain {
    let corner = |tooth: usize, part: f64, radius: f64| {
        let angle = TAU * (tooth as f64 + part) / teeth as f64;
        [radius * angle.cos(), radius * angle.sin()]
    };
    let tooth = |tooth: usize| {
        [(0.0, 0.85), (0.15, 1.0), (0.45, 1.0), (0.6, 0.85)]
            .map(|(part, radius)| corner(tooth, part, radius))
    };
    let outline: Vec<Point> = (0..teeth).flat_map(tooth).collect();
    let mut domain = Domain::default().around(&outline).hole(&circle(24, [0.0; 2], 0.2), [0.0; 2]);
    for center in circle(5, [0.0; 2], 0.5) {
        domain = domain.hole(&circle(16, center, 0.15), center);
    }
    domain
}

/// A closed coast of `3 * 4^depth` segments (H. von Koch, 1904), not quite symmetric.
pub fn coast(depth: u32) -> Domain {
    let mut points = circle(3, [0.0; 2], 1.0);
    for _ in 0..depth {
        let count = points.len();
        let part = |i: usize| {
            let ([ax, ay], [bx, by]) = (points[i], points[(i + 1) % count]);
            let (dx, dy) = (bx - ax, by - ay);
            let at =
                |along: f64, out: f64| [ax + along * dx + out * dy, ay + along * dy - out * dx];
            [at(0.0, 0.0), at(0.34, 0.0), at(0.51, 0.27), at(0.67, 0.0)]
        };
        points = (0..count).flat_map(part).collect();
    }
    Domain::default().around(&points)
}

/// Points of quadratic Bezier curves through corners and controls, as fonts have them.
fn outline(curves: &[[Point; 3]], steps: usize) -> Vec<Point> {
    let point = |[a, b, c]: &[Point; 3], i: usize| {
        let t = i as f64 / steps as f64;
        let weights = [(1.0 - t) * (1.0 - t), 2.0 * t * (1.0 - t), t * t];
        [0, 1].map(|axis| weights[0] * a[axis] + weights[1] * b[axis] + weights[2] * c[axis])
    };
    curves.iter().flat_map(|curve| (0..steps).map(move |i| point(curve, i))).collect()
}

/// "eB8": bowls, counters and a slit.
pub fn text() -> Domain {
    let bowl = |[x, y]: Point, [width, height]: Point| {
        let corner = |dx: f64, dy: f64| [x + dx * width, y + dy * height];
        outline(
            &[
                [corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)],
                [corner(0.0, 1.0), corner(-1.0, 1.0), corner(-1.0, 0.0)],
                [corner(-1.0, 0.0), corner(-1.0, -1.0), corner(0.0, -1.0)],
                [corner(0.0, -1.0), corner(1.0, -1.0), corner(1.0, 0.0)],
            ],
            6,
        )
    };
    let b = outline(
        &[
            [[0.0, 0.0], [0.0, 0.75], [0.0, 1.5]],
            [[0.0, 1.5], [0.2, 1.46], [0.4, 1.4]],
            [[0.4, 1.4], [0.85, 1.35], [0.8, 1.0]],
            [[0.8, 1.0], [0.8, 0.8], [0.6, 0.75]],
            [[0.6, 0.75], [0.95, 0.7], [0.95, 0.4]],
            [[0.95, 0.4], [0.9, 0.0], [0.4, 0.0]],
            [[0.4, 0.0], [0.2, 0.0], [0.0, 0.0]],
        ],
        5,
    );
    let b: Vec<Point> = b.into_iter().rev().collect();
    let upper = bowl([0.4, 1.05], [0.22, 0.18]);
    let lower = bowl([0.45, 0.4], [0.28, 0.2]);
    let mut domain =
        Domain::default().around(&b).hole(&upper, [0.4, 1.05]).hole(&lower, [0.45, 0.4]);
    // An 8, and an e whose mouth is a thin triangle.
    domain = domain
        .around(&bowl([2.0, 0.7], [0.5, 0.7]))
        .hole(&bowl([2.0, 1.0], [0.25, 0.2]), [2.0, 1.0])
        .hole(&bowl([2.0, 0.4], [0.3, 0.22]), [2.0, 0.4]);
    domain
        .around(&bowl([-1.0, 0.5], [0.5, 0.5]))
        .hole(&[[-1.3, 0.52], [-0.7, 0.52], [-0.8, 0.75], [-1.2, 0.75]], [-1.0, 0.6])
        .segment([-1.2, 0.42], [-0.55, 0.4])
}

/// Segments from the middle of a square, of angles from a tenth of a degree on.
pub fn star() -> Domain {
    let mut domain = Domain::default().around(&square(2.0));
    let center = domain.points.len() as u32;
    domain.points.push([0.0, 0.0]);
    let mut angle: f64 = 0.3;
    for ray in 0..64 {
        let (sine, cosine) = angle.to_radians().sin_cos();
        let length = if ray % 3 == 0 { 1.0 } else { 0.7 + 0.004 * f64::from(ray) };
        domain.segments.push([center, domain.points.len() as u32]);
        domain.points.push([length * cosine, length * sine]);
        angle += 0.1 * 1.09f64.powi(ray);
    }
    assert!(angle < 360.0);
    domain
}

/// A polygon in a square, smaller by a power of two.
pub fn scales(exponent: i32) -> Domain {
    let small = circle(12, [0.0; 2], 1.0).into_iter().map(|p| p.map(|x| x * 2f64.powi(exponent)));
    Domain::default().around(&circle(12, [0.0; 2], 1.0)).within(&small.collect::<Vec<_>>())
}

pub fn nested_squares(count: i32) -> Domain {
    (1..=count).fold(Domain::default(), |domain, k| {
        let square = square(2f64.powi(-k));
        if k == 1 { domain.around(&square) } else { domain.within(&square) }
    })
}

/// Teeth of a comb, thin and near each other.
pub fn comb(teeth: u32, width: f64) -> Domain {
    let mut points = vec![[0.0, -0.2], [f64::from(teeth), -0.2]];
    for tooth in (0..teeth).rev() {
        let x = f64::from(tooth);
        points.extend([[x + 0.5 + width, 0.0], [x + 0.5 + width, 3.0], [x + 0.5 - width, 3.0]]);
        points.push([x + 0.5 - width, 0.0]);
    }
    Domain::default().around(&points)
}

/// Squares side by side: every circle through a square's corners has four vertices on it.
pub fn lattice(side: u32) -> Domain {
    let n = side + 1;
    let points: Vec<Point> = (0..n * n).map(|i| [f64::from(i % n), f64::from(i / n)]).collect();
    let mut segments = Vec::new();
    for i in 0..n * n {
        segments.extend((i % n < side).then_some([i, i + 1]));
        segments.extend((i / n < side).then_some([i, i + n]));
    }
    let border = (0..side).chain((0..side).map(|i| side + i * n));
    let border = border.chain((0..side).map(|i| n * n - 1 - i));
    let border = border.chain((0..side).map(|i| (side - i) * n));
    let curve = border.collect();
    Domain { curves: vec![(curve, 1)], ..Domain::new(&points, &segments) }
}

/// Regular polygons about one centre, which is an input: all vertices of each on a circle.
pub fn polygons() -> Domain {
    let mut domain = Domain::default().around(&circle(64, [0.0; 2], 1.0));
    for (count, radius) in [(48, 0.8), (32, 0.6), (12, 0.25)] {
        domain = domain.within(&circle(count, [0.0; 2], radius));
    }
    domain.points.push([0.0, 0.0]);
    domain
}

/// Segments on one line that overlap in all ways, from end to end of a square.
pub fn overlapping() -> Domain {
    let mut domain = Domain::default().around(&square(4.0));
    let first = domain.points.len() as u32;
    domain.points.extend((0..7).map(|i| [-3.0 + f64::from(i), -1.5 + 0.5 * f64::from(i)]));
    let pairs = [[0, 4], [2, 6], [5, 1], [3, 3 + 1], [6, 0], [0, 4], [2, 3]];
    domain.segments.extend(pairs.map(|pair| pair.map(|end| first + end)));
    domain.segments.extend([[0, 1], [1, 0]]);
    domain
}

/// Chords of a circle that all cross.
pub fn chords(count: usize) -> Domain {
    let mut domain = Domain::default().around(&circle(2 * count, [0.0; 2], 1.0));
    let count = count as u32;
    domain.segments.extend((0..count).step_by(3).map(|i| [i, i + count - i % 2]));
    domain
}

/// A curve whose ends are one unit in the last place apart: it encloses nothing.
pub fn open_by_an_ulp() -> Domain {
    let mut points = square(1.0).to_vec();
    points.push([-1.0, -1.0f64.next_down()]);
    Domain::new(&points, &[[0, 1], [1, 2], [2, 3], [3, 4]])
}

/// Two chains across a square with one unit in the last place between their vertices.
pub fn chains_an_ulp_apart() -> Domain {
    let mut domain = Domain::default().around(&square(1.0));
    for i in 0..6 {
        let [x, next] = [i, i + 1].map(|i| -0.75 + 0.25 * f64::from(i));
        domain = domain.segment([x, 0.5], [next, 0.5]);
        domain = domain.segment([x, 0.5f64.next_up()], [next, 0.5f64.next_up()]);
    }
    domain
}

/// Every point several times, and segments between any of them.
pub fn duplicates() -> Domain {
    let corners = square(1.0);
    let points: Vec<Point> = (0..12).map(|i| corners[i % 4]).collect();
    let segments: Vec<[u32; 2]> = (0..12)
        .map(|i| [i, (i + 4 * (i / 4) + 1) % 12])
        .filter(|[a, b]| (b + 12 - a) % 4 != 0)
        .collect();
    let mut domain = Domain::new(&points, &segments);
    domain.curves.push((vec![0, 1, 2, 3], 1));
    domain
}

/// Segments that end within the domain, one of them at the middle of another.
pub fn slits() -> Domain {
    let mut domain = Domain::default().around(&square(1.0));
    for i in 0..12 {
        let y = -0.85 + 0.15 * f64::from(i);
        domain = domain.segment([-0.7, y], [0.3 + 0.02 * f64::from(i), y + 0.05]);
    }
    domain.segment([0.5, -0.5], [0.5, 0.5]).segment([0.5, 0.0], [0.9, 0.0])
}

/// A star of random radii about its centre.
pub fn random_polygon(count: usize, random: &mut Random) -> Domain {
    let points: Vec<Point> = circle(count, [0.0; 2], 1.0)
        .into_iter()
        .map(|p| {
            let radius = 0.2 + 0.8 * random.unit();
            p.map(|x| x * radius)
        })
        .collect();
    Domain::default().around(&points)
}

/// Random segments in a square, most of which cross others.
pub fn random_segments(count: usize, random: &mut Random) -> Domain {
    let mut domain = Domain::default().around(&square(1.0));
    for _ in 0..count {
        let mut draw = || 1.8 * random.unit() - 0.9;
        domain = domain.segment([draw(), draw()], [draw(), draw()]);
    }
    domain
}

/// Random points in a square.
pub fn random_points(count: usize, random: &mut Random) -> Domain {
    let mut domain = Domain::default().around(&square(1.0));
    domain
        .points
        .extend((0..count).map(|_| [2.0 * random.unit() - 1.0, 2.0 * random.unit() - 1.0]));
    domain
}

/// Two long segments that meet at a ten-millionth of a degree.
pub fn needle() -> Domain {
    let mut domain = Domain::default().around(&square(2.0));
    let first = domain.points.len() as u32;
    domain.points.extend([[-1.5, 0.0], [1.5, 0.0], [1.5, 3.0 * 1e-7f64.to_radians()]]);
    domain.segments.extend([[first, first + 1], [first, first + 2]]);
    domain
}
