//! The drawing: panels side by side, a caption under each, a legend below.

use netmesh::VertexKind;
use std::fmt::Write;

/// Width and height of a panel.
pub const PANEL: f64 = 300.0;
const GAP: f64 = 16.0;
const FOOTER: f64 = 58.0;
const INK: &str = "#333333";

pub struct Drawing {
    text: String,
    width: f64,
}

impl Drawing {
    pub fn new(panels: usize) -> Self {
        let width = GAP + panels as f64 * (PANEL + GAP);
        let height = GAP + PANEL + FOOTER;
        let mut text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
             font-family=\"sans-serif\" font-size=\"13\" fill=\"{INK}\">\n"
        );
        let _ = writeln!(text, "<rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>");
        Self { text, width }
    }

    pub fn open_panel(&mut self, panel: usize, caption: &str) {
        let left = GAP + panel as f64 * (PANEL + GAP);
        let _ = writeln!(
            self.text,
            "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{caption}</text>\n\
             <svg x=\"{left}\" y=\"{GAP}\" width=\"{PANEL}\" height=\"{PANEL}\">",
            left + PANEL / 2.0,
            GAP + PANEL + 20.0,
        );
    }

    pub fn close_panel(&mut self) {
        let _ = writeln!(
            self.text,
            "<rect width=\"{PANEL}\" height=\"{PANEL}\" fill=\"none\" stroke=\"#999999\"/>\n</svg>"
        );
    }

    /// A domain's ball.
    pub fn circle(&mut self, [x, y]: [f64; 2], radius: f64) {
        let _ = writeln!(
            self.text,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius:.1}\" fill=\"#eef6f4\" \
             stroke=\"#7fb8ad\" stroke-dasharray=\"4 3\"/>"
        );
    }

    /// The spot that the next panel enlarges.
    pub fn mark(&mut self, [x, y]: [f64; 2]) {
        let _ = writeln!(
            self.text,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"8\" fill=\"none\" stroke=\"#c2185b\" stroke-width=\"1.6\"/>"
        );
    }

    pub fn segments(&mut self, segments: impl Iterator<Item = [[f64; 2]; 2]>) {
        self.text += "<path stroke=\"#a8a8a8\" stroke-width=\"0.6\" d=\"";
        for [a, b] in segments {
            let _ = write!(self.text, "M{:.1} {:.1}L{:.1} {:.1}", a[0], a[1], b[0], b[1]);
        }
        self.text += "\"/>\n";
    }

    /// Dots are round caps of lines without length: a few bytes each.
    pub fn dots(&mut self, kind: VertexKind, places: impl Iterator<Item = [f64; 2]>) {
        let (colour, diameter) = appearance(kind);
        let _ = write!(
            self.text,
            "<path stroke=\"{colour}\" stroke-width=\"{diameter}\" stroke-linecap=\"round\" d=\""
        );
        for [x, y] in places {
            let _ = write!(self.text, "M{x:.1} {y:.1}h0");
        }
        self.text += "\"/>\n";
    }

    pub fn finish(mut self) -> String {
        let entries = [
            (VertexKind::Input, "input"),
            (VertexKind::Steiner, "Steiner vertex"),
            (VertexKind::Cage, "cage vertex"),
        ];
        let (left, y) = (self.width / 2.0 - 230.0, GAP + PANEL + 44.0);
        for (i, (kind, name)) in entries.into_iter().enumerate() {
            let x = left + 130.0 * i as f64;
            let (colour, diameter) = appearance(kind);
            let _ = writeln!(
                self.text,
                "<circle cx=\"{x}\" cy=\"{}\" r=\"{}\" fill=\"{colour}\"/><text x=\"{}\" y=\"{y}\">{name}</text>",
                y - 4.5,
                diameter / 2.0 + 1.0,
                x + 10.0,
            );
        }
        let x = left + 400.0;
        let _ = writeln!(
            self.text,
            "<path d=\"M{} {}h22\" stroke=\"#7fb8ad\" stroke-dasharray=\"4 3\"/><text x=\"{}\" y=\"{y}\">domain</text>",
            x - 12.0,
            y - 4.5,
            x + 16.0,
        );
        self.text + "</svg>\n"
    }
}

/// Colour (told apart by the colour-blind as well) and diameter.
fn appearance(kind: VertexKind) -> (&'static str, f64) {
    match kind {
        VertexKind::Input => ("#1a4f8b", 3.4),
        VertexKind::Steiner => ("#e08214", 2.4),
        VertexKind::Cage => ("#00846b", 3.0),
    }
}
