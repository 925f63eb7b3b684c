//! Points and segments as other programs compute them: on slanted segments but for rounding, at
//! crossings that are rounded, on lines that nearly are one.

use super::bytes::Bytes;

/// Largest number of points, and of segments.
const MOST: usize = 28;

/// Points of the plane, and segments between two of them each.
#[derive(Debug, Default)]
pub struct Drawing {
    pub points: Vec<f64>,
    pub segments: Vec<u32>,
}

impl Drawing {
    fn count(&self) -> usize {
        self.points.len() / 2
    }

    fn point(&self, at: u32) -> [f64; 2] {
        [0, 1].map(|axis| self.points[2 * at as usize + axis])
    }

    /// Adds a point and returns its number.
    fn add(&mut self, point: [f64; 2]) -> u32 {
        self.points.extend(point.map(|x| x.clamp(-f64::MAX, f64::MAX)));
        self.count() as u32 - 1
    }

    /// Adds a segment, unless its ends are equal.
    fn join(&mut self, from: u32, to: u32) {
        if self.point(from) != self.point(to) {
            self.segments.extend([from, to]);
        }
    }

    /// Returns the ends of one of the segments.
    fn any_segment(&self, bytes: &mut Bytes<'_>) -> [[f64; 2]; 2] {
        let at = 2 * bytes.below((self.segments.len() / 2) as u8);
        [0, 1].map(|end| self.point(self.segments[at + end]))
    }

    fn any_point(&self, bytes: &mut Bytes<'_>) -> u32 {
        bytes.below(self.count() as u8) as u32
    }
}

/// Draws some slanted segments, and then points, ends and crossings beside them.
pub fn drawing(bytes: &mut Bytes<'_>) -> Drawing {
    let mut drawing = Drawing::default();
    let unit = if bytes.once_in(8) { bytes.power_of_two() } else { 1.0 };
    for _ in 0..1 + bytes.below(4) {
        let ends = [(); 2].map(|()| short(bytes, unit));
        let [from, to] = ends.map(|end| drawing.add(end));
        drawing.join(from, to);
    }
    if drawing.segments.is_empty() {
        let [from, to] = [[0.0, 0.0], [5.0 * unit, 7.0 * unit]].map(|end| drawing.add(end));
        drawing.join(from, to);
    }
    let most = |drawing: &Drawing| drawing.count().max(drawing.segments.len() / 2);
    for _ in 0..1 + bytes.below(12) {
        // Each step adds two at most.
        if most(&drawing) + 2 > MOST {
            break;
        }
        add_near_incidence(&mut drawing, unit, bytes);
    }
    drawing
}

/// Adds a point on a segment, a segment that ends there, one along another, the place where two
/// cross, or a segment through nearly a point.
fn add_near_incidence(drawing: &mut Drawing, unit: f64, bytes: &mut Bytes<'_>) {
    let [a, b] = drawing.any_segment(bytes);
    match bytes.below(6) {
        0 => {
            let place = on_segment(bytes, a, b);
            drawing.add(place);
        }
        1 => {
            let place = on_segment(bytes, a, b);
            let place = drawing.add(place);
            let other = drawing.any_point(bytes);
            drawing.join(place, other);
        }
        2 => {
            let place = on_segment(bytes, a, b);
            let ends = [place, short(bytes, unit)].map(|end| drawing.add(end));
            drawing.join(ends[0], ends[1]);
        }
        3 => {
            let ends = [(); 2].map(|()| on_segment(bytes, a, b)).map(|end| drawing.add(end));
            drawing.join(ends[0], ends[1]);
        }
        4 => {
            let other = drawing.any_segment(bytes);
            let place = rounded_crossing([a, b], other);
            let place = drawing.add(nudged(bytes, place));
            if bytes.once_in(2) {
                let other = drawing.any_point(bytes);
                drawing.join(place, other);
            }
        }
        _ => {
            let center = drawing.any_point(bytes);
            let center = drawing.point(center);
            let step = short(bytes, unit);
            let ends = [-0.7, 1.3].map(|share| [0, 1].map(|k| center[k] + share * step[k]));
            let [from, to] = ends.map(|end| drawing.add(end));
            drawing.join(from, to);
        }
    }
}

/// Returns a point of one decimal, in units.
fn short(bytes: &mut Bytes<'_>, unit: f64) -> [f64; 2] {
    [(); 2].map(|()| bytes.small() as f64 / 10.0 * unit)
}

/// Returns a point on the line of a segment, in one of the ways in which programs compute it.
fn on_segment(bytes: &mut Bytes<'_>, a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    let share = match bytes.below(3) {
        0 => f64::from(bytes.byte()) / 255.0,
        1 => bytes.below(11) as f64 / 10.0,
        // Beyond the ends as well.
        _ => bytes.small() as f64 / 40.0,
    };
    let way = bytes.below(3);
    let place = [0, 1].map(|k| match way {
        0 => a[k] + (b[k] - a[k]) * share,
        1 => a[k] * (1.0 - share) + b[k] * share,
        _ => b[k] - (b[k] - a[k]) * (1.0 - share),
    });
    nudged(bytes, place)
}

/// Moves each coordinate by up to three units in the last place, half of the time by none.
fn nudged(bytes: &mut Bytes<'_>, point: [f64; 2]) -> [f64; 2] {
    let choice = bytes.byte();
    let mut halves = [choice & 15, choice >> 4].into_iter();
    point.map(|x| {
        let half = i32::from(halves.next().unwrap_or(0));
        let steps = if half < 8 { 0 } else { (half - 11).min(3) };
        (0..steps.abs()).fold(x, |x, _| if steps < 0 { x.next_down() } else { x.next_up() })
    })
}

/// Returns the place where the lines of two segments cross, in doubles; an end where they do not.
fn rounded_crossing([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> [f64; 2] {
    let [ab, cd, ac] = [(a, b), (c, d), (a, c)].map(|(p, q)| [q[0] - p[0], q[1] - p[1]]);
    let area = |p: [f64; 2], q: [f64; 2]| p[0] * q[1] - p[1] * q[0];
    let share = area(ac, cd) / area(ab, cd);
    let place = [0, 1].map(|k| a[k] + share * ab[k]);
    if place.iter().all(|x| x.is_finite()) { place } else { b }
}
