//! Writing a plot.

use super::{Missing, Panel, Plot, Series};
use std::fmt::Write;

const WIDTH: f64 = 340.0;
const HEIGHT: f64 = 250.0;
const LEFT: f64 = 62.0;
const RIGHT: f64 = 18.0;
const TOP: f64 = 58.0;
const BOTTOM: f64 = 50.0;
const LEGEND_LINE: f64 = 20.0;
const CHARACTER: f64 = 6.7;
const KEY: f64 = 34.0;

/// The height of a row of marks for missing figures: one for each curve that misses some.
const MISSING_ROW: f64 = 9.0;

pub fn write(plot: &Plot) -> String {
    let curves = legend_curves(plot);
    let reasons = reasons(plot);
    let width = plot.panels.len() as f64 * (LEFT + WIDTH + RIGHT);
    let keys = legend_places(curves.iter().map(|series| series.name.as_str()), width);
    let curve_lines = keys.last().map_or(0.0, |key| key.1 + 1.0);
    let reason_keys = legend_places(reasons.iter().map(|reason| reason.words()), width);
    let lines = curve_lines + reason_keys.last().map_or(0.0, |key| key.1 + 1.0);
    let height = TOP + HEIGHT + BOTTOM + lines * LEGEND_LINE + 8.0;
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
         height=\"{height}\" font-family=\"sans-serif\" font-size=\"12\" fill=\"#222222\">\n\
         <rect width=\"{width}\" height=\"{height}\" rx=\"6\" fill=\"#ffffff\"/>\n\
         <text x=\"{}\" y=\"22\" text-anchor=\"middle\" font-size=\"14\" font-weight=\"bold\">{}</text>\n",
        width / 2.0,
        escaped(&plot.title),
    );
    for (i, panel) in plot.panels.iter().enumerate() {
        write_panel(&mut out, panel, i as f64 * (LEFT + WIDTH + RIGHT) + LEFT);
    }
    for (series, (x, line)) in curves.iter().zip(&keys) {
        let y = legend_line(*line);
        write_line(&mut out, &[(*x, y), (x + 24.0, y)], series);
        write_markers(&mut out, &[(x + 12.0, y)], series);
        text(&mut out, x + KEY, y + 4.0, "start", &series.name);
    }
    for (reason, (x, line)) in reasons.iter().zip(&reason_keys) {
        let y = legend_line(curve_lines + line);
        write_missing(&mut out, "#333333", &reason.mark(x + 12.0, y));
        text(&mut out, x + KEY, y + 4.0, "start", reason.words());
    }
    out + "</svg>\n"
}

fn legend_line(line: f64) -> f64 {
    TOP + HEIGHT + BOTTOM + line * LEGEND_LINE + 6.0
}

/// One curve of each name, in the order of their first appearance.
fn legend_curves(plot: &Plot) -> Vec<&Series> {
    let mut curves: Vec<&Series> = Vec::new();
    for series in plot.panels.iter().flat_map(|panel| &panel.series) {
        if curves.iter().all(|other| other.name != series.name) {
            curves.push(series);
        }
    }
    curves
}

/// Those for which a figure is missing in some panel.
fn reasons(plot: &Plot) -> Vec<Missing> {
    let all = || plot.panels.iter().flat_map(|panel| &panel.series).flat_map(|s| &s.missing);
    Missing::ALL.into_iter().filter(|reason| all().any(|(_, other)| other == reason)).collect()
}

/// Left end and line of each entry.
fn legend_places<'a>(names: impl Iterator<Item = &'a str>, width: f64) -> Vec<(f64, f64)> {
    let (mut x, mut line) = (LEFT, 0.0);
    let mut places = Vec::new();
    for name in names {
        let needed = KEY + CHARACTER * name.chars().count() as f64 + 20.0;
        if x + needed > width && x > LEFT {
            (x, line) = (LEFT, line + 1.0);
        }
        places.push((x, line));
        x += needed;
    }
    places
}

fn write_panel(out: &mut String, panel: &Panel, left: f64) {
    let all = || panel.series.iter().flat_map(|series| &series.points);
    let missing = panel.series.iter().flat_map(|series| &series.missing);
    let x = panel.x.range(all().map(|p| p.0).chain(missing.map(|(x, _)| *x)));
    let y = panel.y.range(all().map(|p| p.1));
    let place = |p: &(f64, f64)| (left + WIDTH * x.place(p.0), TOP + HEIGHT * (1.0 - y.place(p.1)));
    let middle = left + WIDTH / 2.0;
    text(out, middle, TOP - 12.0, "middle", &panel.caption);
    text(out, middle, TOP + HEIGHT + 36.0, "middle", &panel.x.label);
    let (label_x, label_y) = (left - 46.0, TOP + HEIGHT / 2.0);
    let _ = writeln!(
        out,
        "<text x=\"{label_x:.1}\" y=\"{label_y:.1}\" text-anchor=\"middle\" \
         transform=\"rotate(-90 {label_x:.1} {label_y:.1})\">{}</text>",
        escaped(&panel.y.label)
    );
    for tick in panel.x.ticks(&x) {
        let at = left + WIDTH * x.place(tick.value);
        grid_line(out, &format!("M{at:.1} {TOP:.1}v{HEIGHT:.1}"), tick.label.is_some());
        if let Some(label) = tick.label {
            text(out, at, TOP + HEIGHT + 16.0, "middle", &label);
        }
    }
    for tick in panel.y.ticks(&y) {
        let at = TOP + HEIGHT * (1.0 - y.place(tick.value));
        grid_line(out, &format!("M{left:.1} {at:.1}h{WIDTH:.1}"), tick.label.is_some());
        if let Some(label) = tick.label {
            text(out, left - 6.0, at + 4.0, "end", &label);
        }
    }
    let _ = writeln!(
        out,
        "<rect x=\"{left:.1}\" y=\"{TOP:.1}\" width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"none\" stroke=\"#888888\"/>"
    );
    for series in &panel.series {
        let places: Vec<(f64, f64)> = series.points.iter().map(place).collect();
        if panel.x.names.is_empty() {
            write_line(out, &places, series);
        }
        write_markers(out, &places, series);
    }
    let with_gaps = panel.series.iter().filter(|series| !series.missing.is_empty());
    for (row, series) in with_gaps.enumerate() {
        let y = TOP + HEIGHT - 6.0 - MISSING_ROW * row as f64;
        let mark = |(at, reason): &(f64, Missing)| reason.mark(left + WIDTH * x.place(*at), y);
        write_missing(out, color(series), &series.missing.iter().map(mark).collect::<String>());
    }
}

fn text(out: &mut String, x: f64, y: f64, anchor: &str, words: &str) {
    let words = escaped(words);
    let _ =
        writeln!(out, "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{words}</text>");
}

fn grid_line(out: &mut String, path: &str, numbered: bool) {
    let color = if numbered { "#cccccc" } else { "#eeeeee" };
    let _ = writeln!(out, "<path stroke=\"{color}\" stroke-width=\"0.8\" d=\"{path}\"/>");
}

fn color(series: &Series) -> &'static str {
    series.tool.color(series.variant)
}

fn write_line(out: &mut String, places: &[(f64, f64)], series: &Series) {
    let color = color(series);
    let is_dashed = (series.tool.marker() + series.variant) % 2 == 1;
    let dashes = if is_dashed { " stroke-dasharray=\"6 3\"" } else { "" };
    let _ = write!(out, "<path fill=\"none\" stroke=\"{color}\" stroke-width=\"1.8\"{dashes} d=\"");
    for (i, (x, y)) in places.iter().enumerate() {
        let _ = write!(out, "{}{x:.1} {y:.1}", if i == 0 { "M" } else { "L" });
    }
    *out += "\"/>\n";
}

fn write_markers(out: &mut String, places: &[(f64, f64)], series: &Series) {
    let _ = write!(out, "<path fill=\"{}\" d=\"", color(series));
    for (x, y) in places {
        *out += &marker(series.tool.marker() + series.variant, *x, *y);
    }
    *out += "\"/>\n";
}

fn write_missing(out: &mut String, color: &str, marks: &str) {
    let _ = writeln!(
        out,
        "<path class=\"missing\" fill=\"none\" stroke=\"{color}\" stroke-width=\"1.4\" d=\"{marks}\"/>"
    );
}

/// A disc, square, triangle, diamond or a triangle on its head about (x, y).
fn marker(number: usize, x: f64, y: f64) -> String {
    match number % 5 {
        0 => format!("M{:.1} {y:.1}a3.4 3.4 0 1 0 6.8 0a3.4 3.4 0 1 0 -6.8 0z", x - 3.4),
        1 => format!("M{:.1} {:.1}h6v6h-6z", x - 3.0, y - 3.0),
        2 => format!("M{x:.1} {:.1}l4 7h-8z", y - 4.4),
        3 => format!("M{x:.1} {:.1}l4.4 4.4l-4.4 4.4l-4.4 -4.4z", y - 4.4),
        _ => format!("M{x:.1} {:.1}l4 -7h-8z", y + 4.4),
    }
}

fn escaped(words: &str) -> String {
    words.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::super::{Axis, Missing, Panel, Plot, Series, Tool};

    fn plot() -> Plot {
        let series = |name: &str, tool: Tool, factor: f64| {
            let points = (1..6).map(|i| (10f64.powi(i), factor * f64::from(i)));
            Series::new(name, tool, points.collect())
        };
        let panel = |caption: &str| Panel {
            caption: caption.to_string(),
            x: Axis::log("n"),
            y: Axis::linear("m/n"),
            series: vec![series("a & b", Tool::Netmesh, 1.0), series("c < d", Tool::Svr, 2.0)],
        };
        let panels = vec![panel("left"), panel("right")];
        Plot { name: "test".to_string(), title: "Title".to_string(), panels }
    }

    #[test]
    fn the_same_data_give_the_same_bytes() {
        assert_eq!(plot().svg(), plot().svg());
    }

    #[test]
    fn tags_are_balanced_and_text_is_escaped() {
        let svg = plot().svg();
        for tag in ["svg", "text"] {
            let opened = svg.matches(&format!("<{tag} ")).count();
            assert_eq!(opened, svg.matches(&format!("</{tag}>")).count(), "{tag}");
        }
        assert!(svg.contains(">a &amp; b<") && svg.contains(">c &lt; d<"));
        assert!(svg.contains(">10k<") && svg.contains(">m/n<") && svg.contains(">right<"));
    }

    #[test]
    fn names_have_no_lines_between_them() {
        let mut plot = plot();
        let lines = |svg: String| svg.matches("fill=\"none\" stroke=\"#0072b2\"").count();
        assert_eq!(lines(plot.svg()), 3);
        plot.panels[1].x = Axis::named(&["one", "two"]);
        assert!(plot.svg().contains(">two<"));
        assert_eq!(lines(plot.svg()), 2);
    }

    /// A row of marks in the panel that misses something, and one in the legend.
    #[test]
    fn what_is_missing_is_marked_and_explained() {
        let mut plot = plot();
        let marks = |svg: &str| svg.matches("class=\"missing\"").count();
        assert_eq!(marks(&plot.svg()), 0);
        plot.panels[1].series[1].missing = vec![(1e6, Missing::Crashed), (1e7, Missing::Crashed)];
        let svg = plot.svg();
        assert_eq!(marks(&svg), 2);
        assert!(svg.contains("class=\"missing\" fill=\"none\" stroke=\"#d55e00\""));
        assert!(svg.contains(Missing::Crashed.words()) && !svg.contains(Missing::Wrong.words()));
    }

    /// A legend entry once, and a curve in each panel: five points, at equal steps.
    #[test]
    fn curves_are_where_their_values_are() {
        let svg = plot().svg();
        assert_eq!(svg.matches(">a &amp; b<").count(), 1);
        let curves: Vec<Vec<f64>> = svg
            .lines()
            .filter(|line| line.contains("stroke=\"#0072b2\""))
            .map(|line| {
                let path = line.split(" d=\"M").nth(1).unwrap().trim_end_matches("\"/>");
                path.split('L').map(|p| p.split(' ').next().unwrap().parse().unwrap()).collect()
            })
            .collect();
        assert_eq!(curves.iter().map(Vec::len).collect::<Vec<_>>(), [5, 5, 2]);
        let step = curves[0][1] - curves[0][0];
        assert!(curves[0].windows(2).all(|w| (w[1] - w[0] - step).abs() < 0.21), "{curves:?}");
    }
}
