//! A square window on the plane about the origin, and where things stand in it.

type Point = [f64; 2];

pub struct Window {
    half_width: f64,
    pixels: f64,
}

impl Window {
    pub fn new(half_width: f64, pixels: f64) -> Self {
        Self { half_width, pixels }
    }

    pub fn contains(&self, point: Point) -> bool {
        point.iter().all(|x| x.abs() <= self.half_width)
    }

    /// In pixels, y downwards.
    pub fn place(&self, [x, y]: Point) -> Point {
        [x, -y].map(|x| (x / self.half_width + 1.0) * self.pixels / 2.0)
    }

    pub fn length(&self, length: f64) -> f64 {
        length / self.half_width * self.pixels / 2.0
    }

    /// The part of segment `ab` inside the window (Liang and Barsky), placed.
    pub fn clip(&self, a: Point, b: Point) -> Option<[Point; 2]> {
        let (mut start, mut end) = (0.0_f64, 1.0_f64);
        for axis in 0..2 {
            let step = b[axis] - a[axis];
            if step == 0.0 && a[axis].abs() > self.half_width {
                return None;
            }
            if step != 0.0 {
                let first = (-self.half_width - a[axis]) / step;
                let second = (self.half_width - a[axis]) / step;
                start = start.max(first.min(second));
                end = end.min(first.max(second));
            }
        }
        let at = |t: f64| [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
        (start < end).then(|| [self.place(at(start)), self.place(at(end))])
    }
}
