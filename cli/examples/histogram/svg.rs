//! The drawing: panels side by side, bars on a logarithmic scale.

use std::fmt::Write;

/// Number of bins, of three degrees each.
pub const BINS: usize = 60;

const WIDTH: f64 = 270.0;
const HEIGHT: f64 = 200.0;
const LEFT: f64 = 62.0;
const TOP: f64 = 48.0;
const BOTTOM: f64 = 46.0;
const GAP: f64 = 18.0;
const INK: &str = "#333333";

/// The axis of counts goes from 1 to ten to this power.
const DECADES: u32 = 5;

pub struct Drawing {
    text: String,
}

impl Drawing {
    pub fn new(panels: usize) -> Self {
        let width = LEFT + panels as f64 * (WIDTH + GAP);
        let height = TOP + HEIGHT + BOTTOM;
        let mut text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
             font-family=\"sans-serif\" font-size=\"13\" fill=\"{INK}\">\n"
        );
        let _ = writeln!(text, "<rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>");
        for decade in 0..=DECADES {
            let y = TOP + level(10f64.powi(decade as i32));
            let count = 10u64.pow(decade);
            let _ = writeln!(
                text,
                "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{count}</text>",
                LEFT - 8.0,
                y + 4.5
            );
        }
        Self { text }
    }

    /// `counts`: one for each bin.
    pub fn panel(&mut self, place: usize, captions: [&str; 2], counts: &[u64]) {
        let left = LEFT + place as f64 * (WIDTH + GAP);
        for (line, caption) in captions.iter().enumerate() {
            let (x, y) = (left + WIDTH / 2.0, 18.0 + 18.0 * line as f64);
            let _ = writeln!(
                self.text,
                "<text x=\"{x}\" y=\"{y}\" text-anchor=\"middle\">{caption}</text>"
            );
        }
        self.grid(left);
        self.bars(left, counts);
        let _ = writeln!(
            self.text,
            "<rect x=\"{left}\" y=\"{TOP}\" width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"none\" \
             stroke=\"#999999\"/>"
        );
    }

    fn grid(&mut self, left: f64) {
        for decade in 1..DECADES {
            let y = TOP + level(10f64.powi(decade as i32));
            let _ = writeln!(self.text, "<path d=\"M{left} {y}h{WIDTH}\" stroke=\"#e4e4e4\"/>");
        }
        for degrees in (0..=180).step_by(30) {
            let x = left + WIDTH * f64::from(degrees) / 180.0;
            let y = TOP + HEIGHT + 18.0;
            let _ = writeln!(
                self.text,
                "<text x=\"{x}\" y=\"{y}\" text-anchor=\"middle\">{degrees}</text>"
            );
        }
        let (x, y) = (left + WIDTH / 2.0, TOP + HEIGHT + 38.0);
        let _ = writeln!(
            self.text,
            "<text x=\"{x}\" y=\"{y}\" text-anchor=\"middle\">dihedral angle, degrees</text>"
        );
    }

    fn bars(&mut self, left: f64, counts: &[u64]) {
        let width = WIDTH / counts.len() as f64;
        self.text += "<path fill=\"#1a4f8b\" d=\"";
        for (bin, &count) in counts.iter().enumerate().filter(|(_, count)| **count > 0) {
            // A single angle is seen as well.
            let top = level(count as f64).min(HEIGHT - 1.5);
            let (x, height) = (left + bin as f64 * width, HEIGHT - top);
            let right = width - 1.0;
            let _ = write!(
                self.text,
                "M{x:.1} {:.1}v-{height:.1}h{right:.1}v{height:.1}z",
                TOP + HEIGHT
            );
        }
        self.text += "\"/>\n";
    }

    pub fn finish(self) -> String {
        self.text + "</svg>\n"
    }
}

/// Returns the distance of a count from the top of a panel.
fn level(count: f64) -> f64 {
    HEIGHT * (1.0 - count.log10() / f64::from(DECADES)).max(0.0)
}
