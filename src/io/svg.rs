//! SVG: a planar mesh as a picture, with coordinates in thousandths of a pixel. Triangles are paths
//! with hairlines, filled by region; segments are bold, and inputs are dots if there are few.

use super::picture::{COLOURS, Facts, Frame, Kept, Outline, PLAIN, figure, grouped};
use super::{Data, allocation_failed};
use crate::memory::collected;
use crate::mesh::{Triangulation, VertexKind};
use std::io::{self, Write};

/// Longest side of the mesh in the picture, in pixels.
const SIDE: f64 = 1000.0;

/// Room around the mesh, in pixels.
const MARGIN: f64 = 10.0;

/// Number of triangles, or of pieces of segments, that are drawn; of more some are left out.
const LIMIT: usize = 100_000;

/// Number of inputs up to which they are dots.
const DOTS: usize = 2_000;

/// Number of triangles or pieces of a path: programs are slow with long ones.
const PATH: usize = 1_000;

pub(super) fn write(mesh: &Triangulation, data: &Data<'_>, out: &mut dyn Write) -> io::Result<()> {
    let measures = data.measures_of(mesh)?;
    let facts = Facts::new(mesh, &measures.quality).map_err(allocation_failed)?;
    Picture { mesh, facts, frame: Frame::new(mesh), limit: LIMIT }.write(out)
}

struct Picture<'a> {
    mesh: &'a Triangulation,
    facts: Facts<'a>,
    frame: Frame,
    /// Number of triangles, or of pieces of segments, that are drawn.
    limit: usize,
}

impl Picture<'_> {
    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let triangles = Kept::new(self.mesh.simplex_count(), self.limit);
        let segments = Kept::new(self.mesh.boundary.subsegments.len(), self.limit);
        let [width, height] = [0, 1].map(|axis| self.extent(axis) + 2.0 * MARGIN);
        writeln!(out, r#"<?xml version="1.0" encoding="UTF-8"?>"#)?;
        write!(out, r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}""#)?;
        writeln!(out, r#" width="{width}" height="{height}">"#)?;
        self.write_words(triangles, segments, out)?;
        out.write_all(b"<g fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\">\n")?;
        if triangles.is_thinned() {
            self.write_outline(out)?;
        }
        self.write_triangles(triangles, out)?;
        self.write_segments(segments, out)?;
        self.write_inputs(out)?;
        out.write_all(b"</g>\n</svg>\n")
    }

    /// Returns a side of the mesh in whole pixels.
    fn extent(&self, axis: usize) -> f64 {
        (SIDE * self.frame.sides[axis]).ceil()
    }

    /// Writes sentences for people who point at the picture, and for programs that read it aloud.
    fn write_words(&self, triangles: Kept, segments: Kept, out: &mut dyn Write) -> io::Result<()> {
        let (count, vertices) = (grouped(triangles.count), grouped(self.mesh.vertex_count()));
        writeln!(out, "<title>netmesh: {count} triangles, {vertices} vertices</title>")?;
        out.write_all(b"<desc>")?;
        self.facts.visit(|sentence| writeln!(out, "{sentence}."))?;
        for (kept, name) in [(triangles, "triangles"), (segments, "pieces of segments")] {
            if kept.is_thinned() {
                let (drawn, all) = (grouped(kept.len()), grouped(kept.count));
                writeln!(out, "{drawn} of {all} {name} are drawn, evenly in their order.")?;
            }
        }
        let ([x, y, _], half) = self.frame.in_mesh();
        let [x, y, half] = [x, y, half].map(figure);
        writeln!(out, "The middle is ({x}, {y}); from it to a side it is {half}.</desc>")
    }

    /// Fills the meshed domain, under triangles that are too few to do so.
    fn write_outline(&self, out: &mut dyn Write) -> io::Result<()> {
        out.write_all(b"<path fill=\"#eeeeee\" fill-rule=\"evenodd\" d=\"")?;
        let outline = Outline::new(self.mesh).map_err(allocation_failed)?;
        outline.visit(|vertex, is_first| {
            out.write_all(if is_first { b"M" } else { b"L" })?;
            write_pair(self.place(vertex), out)
        })?;
        out.write_all(b"\"/>\n")
    }

    /// Writes the triangles, region after region.
    fn write_triangles(&self, kept: Kept, out: &mut dyn Write) -> io::Result<()> {
        let labels = &self.mesh.boundary.simplex_regions;
        if labels.is_empty() {
            return self.write_filled(PLAIN, kept.iter(), out);
        }
        let labelled = kept.iter().map(|triangle| (labels[triangle], triangle));
        let mut order = collected(labelled).map_err(allocation_failed)?;
        order.sort_unstable();
        for region in order.chunk_by(|a, b| a.0 == b.0) {
            let label = region[0].0;
            let at = self.facts.regions.partition_point(|known| *known < label);
            writeln!(out, "<g><title>region {label}</title>")?;
            let triangles = region.iter().map(|(_, triangle)| *triangle);
            self.write_filled(COLOURS[at % COLOURS.len()], triangles, out)?;
            out.write_all(b"</g>\n")?;
        }
        Ok(())
    }

    fn write_filled(
        &self,
        colour: &str,
        triangles: impl Iterator<Item = usize>,
        out: &mut dyn Write,
    ) -> io::Result<()> {
        let style = format_args!("fill=\"{colour}\" stroke=\"#333333\" stroke-width=\".5\"");
        write_paths(style, triangles, out, |triangle, out| {
            let [a, b, c] = [0, 1, 2].map(|at| self.place(self.mesh.simplex(triangle)[at]));
            out.write_all(b"M")?;
            write_pair(a, out)?;
            out.write_all(b"l")?;
            let [first, second] = [[a, b], [b, c]].map(|[p, q]| [q[0] - p[0], q[1] - p[1]]);
            write_pair(first, out)?;
            if second[0] >= 0 {
                out.write_all(b" ")?;
            }
            write_pair(second, out)?;
            out.write_all(b"z")
        })
    }

    fn write_segments(&self, kept: Kept, out: &mut dyn Write) -> io::Result<()> {
        let style = format_args!("stroke=\"#000000\" stroke-width=\"1.6\"");
        write_paths(style, kept.iter(), out, |segment, out| {
            let [from, to] = self.mesh.boundary.subsegments[segment].map(|end| self.place(end));
            out.write_all(b"M")?;
            write_pair(from, out)?;
            out.write_all(b"L")?;
            write_pair(to, out)
        })
    }

    /// Writes inputs as lines without a length, of which the round ends are to be seen.
    fn write_inputs(&self, out: &mut dyn Write) -> io::Result<()> {
        let is_input = |vertex: &usize| self.mesh.kinds[*vertex] == VertexKind::Input;
        let inputs = || (0..self.mesh.vertex_count()).filter(is_input);
        if inputs().count() > DOTS {
            return Ok(());
        }
        let style = format_args!("stroke=\"#a4262c\" stroke-width=\"5\"");
        write_paths(style, inputs(), out, |vertex, out| {
            out.write_all(b"M")?;
            write_pair(self.place(vertex as u32), out)?;
            out.write_all(b"h0")
        })
    }

    /// Returns a vertex in the picture, where y points down, in thousandths of a pixel.
    fn place(&self, vertex: u32) -> [i32; 2] {
        let [x, y, _] = self.frame.place(self.mesh.point(vertex));
        let thousandths = |x: f64, axis| {
            (1000.0 * (MARGIN + 0.5 * (self.extent(axis) + SIDE * x))).round() as i32
        };
        [thousandths(x, 0), thousandths(-y, 1)]
    }
}

/// Writes elements, each as `write` does, as paths of a style.
fn write_paths(
    style: std::fmt::Arguments<'_>,
    mut elements: impl Iterator<Item = usize>,
    out: &mut dyn Write,
    mut write: impl FnMut(usize, &mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    while let Some(first) = elements.next() {
        write!(out, "<path {style} vector-effect=\"non-scaling-stroke\" d=\"")?;
        write(first, out)?;
        for element in elements.by_ref().take(PATH - 1) {
            write(element, out)?;
        }
        out.write_all(b"\"/>\n")?;
    }
    Ok(())
}

/// Writes two numbers, given in thousandths, as short as they may be: `.5-1.25`.
fn write_pair([x, y]: [i32; 2], out: &mut dyn Write) -> io::Result<()> {
    write_thousandths(x, out)?;
    if y >= 0 {
        out.write_all(b" ")?;
    }
    write_thousandths(y, out)
}

fn write_thousandths(value: i32, out: &mut dyn Write) -> io::Result<()> {
    let (whole, mut rest) = (value.unsigned_abs() / 1000, value.unsigned_abs() % 1000);
    if value < 0 {
        out.write_all(b"-")?;
    }
    if whole > 0 || rest == 0 {
        write!(out, "{whole}")?;
    }
    if rest > 0 {
        let mut digits = 3;
        while rest % 10 == 0 {
            (rest, digits) = (rest / 10, digits - 1);
        }
        write!(out, ".{rest:0digits$}")?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::{Format, samples, write};
    use super::*;
    use crate::error::ErrorKind;
    use crate::mesh::Mesh;
    use crate::quality::measure;

    fn text(mesh: &Mesh) -> String {
        let mut text = Vec::new();
        write(mesh, Format::Svg, &mut text).unwrap();
        String::from_utf8(text).unwrap()
    }

    fn thinned(mesh: &Mesh, limit: usize) -> String {
        let mesh = mesh.triangulation().unwrap();
        let quality = measure(mesh).unwrap();
        let facts = Facts::new(mesh, &quality).unwrap();
        let mut text = Vec::new();
        Picture { mesh, facts, frame: Frame::new(mesh), limit }.write(&mut text).unwrap();
        String::from_utf8(text).unwrap()
    }

    #[test]
    fn regions_segments_and_inputs_of_a_square() {
        let expected = "\
<?xml version=\"1.0\" encoding=\"UTF-8\"?>
<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1020 1020\" width=\"1020\" height=\"1020\">
<title>netmesh: 2 triangles, 4 vertices</title>
<desc>4 vertices: 2 inputs, 1 Steiner, 1 of cages.
2 triangles in 2 regions.
Bound: Voronoi aspect 3.
Smallest angle 45 degrees.
The middle is (0.5, 0.5); from it to a side it is 0.5.</desc>
<g fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\">
<g><title>region -8</title>
<path fill=\"#7fb3d5\" stroke=\"#333333\" stroke-width=\".5\" \
vector-effect=\"non-scaling-stroke\" d=\"M10 1010l1000-1000-1000 0z\"/>
</g>
<g><title>region 7</title>
<path fill=\"#f5b971\" stroke=\"#333333\" stroke-width=\".5\" \
vector-effect=\"non-scaling-stroke\" d=\"M10 1010l1000 0 0-1000z\"/>
</g>
<path stroke=\"#000000\" stroke-width=\"1.6\" vector-effect=\"non-scaling-stroke\" \
d=\"M10 1010L1010 10M1010 1010L10 1010\"/>
<path stroke=\"#a4262c\" stroke-width=\"5\" vector-effect=\"non-scaling-stroke\" \
d=\"M10 1010h0M1010 1010h0\"/>
</g>
</svg>
";
        assert_eq!(text(&samples::square_with_segments()), expected);
    }

    #[test]
    fn a_triangulation_is_drawn_whole() {
        let mesh = samples::finished(2);
        let triangulation = mesh.triangulation().unwrap();
        let text = text(&mesh);
        assert_eq!(text.matches('z').count(), triangulation.simplex_count());
        assert_eq!(text.matches("h0").count(), mesh.inputs().distinct());
        assert!(text.contains(PLAIN) && !text.contains("are drawn"));
        // No number has more than three decimals, or a zero at the end of them.
        let paths = text.split("d=\"").skip(1).filter_map(|path| path.split_once('"'));
        let drawn: String = paths.map(|(path, _)| path).collect();
        let numbers = drawn.split(['"', 'M', 'l', 'z', 'h', ' ', '-', '\n']);
        let decimals = numbers.filter(|number| number.parse::<f64>().is_ok());
        let decimals = decimals.filter_map(|number| number.split_once('.'));
        assert!(decimals.into_iter().all(|(_, rest)| rest.len() <= 3 && !rest.ends_with('0')));
    }

    #[test]
    fn what_is_left_out_is_told() {
        let mesh = samples::finished(2);
        let triangles = mesh.triangulation().unwrap().simplex_count();
        let text = thinned(&mesh, 7);
        let told = format!("7 of {} triangles are drawn, evenly in their order.", triangles);
        assert!(text.contains(&told), "{text}");
        // The triangles, and below them what is meshed.
        assert_eq!(text.matches('z').count(), 7);
        assert_eq!(text.matches("fill-rule=\"evenodd\" d=\"M").count(), 1);
        let text = thinned(&samples::square_with_segments(), 1);
        assert!(text.contains("1 of 2 triangles are drawn"), "{text}");
        assert!(text.contains("1 of 2 pieces of segments are drawn"), "{text}");
        assert!(text.contains("d=\"M10 1010L1010 1010L1010 10L10 10\"/>"), "{text}");
    }

    #[test]
    fn long_paths_are_parted() {
        let mut path = Vec::new();
        let count = 2 * PATH + 1;
        write_paths(format_args!("a"), 0..count, &mut path, |_, out| out.write_all(b"z")).unwrap();
        let text = String::from_utf8(path).unwrap();
        let lengths: Vec<usize> = text.lines().map(|line| line.matches('z').count()).collect();
        assert_eq!(lengths, [PATH, PATH, 1]);
    }

    #[test]
    fn coordinates_that_no_picture_has_are_drawn() {
        let mesh = samples::mesh(2);
        let text = text(&mesh);
        assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
        assert!(text.contains("viewBox=\"0 0 21 1020\""), "{text}");
    }

    #[test]
    fn numbers_are_as_short_as_they_may_be() {
        for (value, expected) in [
            (0, "0"),
            (-1, "-.001"),
            (500, ".5"),
            (1000, "1"),
            (-12_340, "-12.34"),
            (7_005, "7.005"),
        ] {
            let mut text = Vec::new();
            write_thousandths(value, &mut text).unwrap();
            assert_eq!(text, expected.as_bytes());
        }
    }

    #[test]
    fn other_dimensions_are_refused() {
        for (dim, others) in [(3, "use HTML"), (4, "use OFF (nOFF) or TetGen")] {
            let error = write(&samples::mesh(dim), Format::Svg, &mut Vec::new()).unwrap_err();
            assert_eq!(error.kind(), ErrorKind::InvalidArgument);
            let rule = format!("SVG holds meshes of the plane, dimension 2, not {dim}; {others}");
            assert_eq!(error.message(), rule);
        }
    }
}
