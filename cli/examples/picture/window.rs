//! A square window on the plane, and where things stand in it.

type Point = [f64; 2];

pub struct Window {
    center: Point,
    half_width: f64,
    pixels: f64,
}

impl Window {
    pub fn new(center: Point, half_width: f64, pixels: f64) -> Self {
        Self { center, half_width, pixels }
    }

    pub fn contains(&self, point: Point) -> bool {
        self.relative(point).iter().all(|x| x.abs() <= 1.0)
    }

    /// In pixels, y downwards.
    pub fn place(&self, point: Point) -> Point {
        self.pixel(self.relative(point))
    }

    pub fn length(&self, length: f64) -> f64 {
        length / self.half_width * self.pixels / 2.0
    }

    /// The part of segment `ab` inside the window (Liang and Barsky), placed.
    pub fn clip(&self, a: Point, b: Point) -> Option<[Point; 2]> {
        let (a, b) = (self.relative(a), self.relative(b));
        let (mut start, mut end) = (0.0_f64, 1.0_f64);
        for axis in 0..2 {
            let step = b[axis] - a[axis];
            if step == 0.0 && a[axis].abs() > 1.0 {
                return None;
            }
            if step != 0.0 {
                let first = (-1.0 - a[axis]) / step;
                let second = (1.0 - a[axis]) / step;
                start = start.max(first.min(second));
                end = end.min(first.max(second));
            }
        }
        let at = |t: f64| [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
        (start < end).then(|| [self.pixel(at(start)), self.pixel(at(end))])
    }

    /// The window is \[-1, 1\] squared.
    fn relative(&self, point: Point) -> Point {
        std::array::from_fn(|axis| (point[axis] - self.center[axis]) / self.half_width)
    }

    fn pixel(&self, [x, y]: Point) -> Point {
        [x, -y].map(|x| (x + 1.0) * self.pixels / 2.0)
    }
}
