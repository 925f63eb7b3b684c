//! Plots as SVG: panels side by side with one legend below. They bring their own background, so
//! that they can be read on a light and on a dark page; text is text; the same data give the same
//! bytes.

mod axis;
mod look;
mod svg;

pub use axis::Axis;
pub use look::{Missing, Tool};

#[derive(Clone, Debug)]
pub struct Plot {
    /// The file's name without its extension.
    pub name: String,
    pub title: String,
    pub panels: Vec<Panel>,
}

#[derive(Clone, Debug)]
pub struct Panel {
    pub caption: String,
    pub x: Axis,
    pub y: Axis,
    pub series: Vec<Series>,
}

/// A curve. Its tool gives it its colour, in all plots; the curves of one tool in one plot differ
/// in shade, marker and dashes by their variant.
#[derive(Clone, Debug)]
pub struct Series {
    pub name: String,
    pub tool: Tool,
    pub variant: usize,
    pub points: Vec<(f64, f64)>,
    /// Where there is no point, and why: a mark above the axis.
    pub missing: Vec<(f64, Missing)>,
}

impl Plot {
    pub fn svg(&self) -> String {
        svg::write(self)
    }
}

impl Series {
    pub fn new(name: impl Into<String>, tool: Tool, points: Vec<(f64, f64)>) -> Self {
        Self { name: name.into(), tool, variant: 0, points, missing: Vec::new() }
    }

    pub fn variant(mut self, variant: usize) -> Self {
        self.variant = variant;
        self
    }

    pub fn missing(mut self, missing: Vec<(f64, Missing)>) -> Self {
        self.missing = missing;
        self
    }
}
