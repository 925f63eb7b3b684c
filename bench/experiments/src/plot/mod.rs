//! Plots as SVG: panels side by side with one legend below. They bring their own background, so that
//! they can be read on a light and on a dark page; text is text; the same data give the same bytes.

mod axis;
mod svg;

pub use axis::Axis;

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

/// A curve. Those of one name have one look in all panels.
#[derive(Clone, Debug)]
pub struct Series {
    pub name: String,
    pub points: Vec<(f64, f64)>,
}

impl Plot {
    pub fn svg(&self) -> String {
        svg::write(self)
    }
}

impl Series {
    pub fn new(name: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self { name: name.into(), points }
    }
}
