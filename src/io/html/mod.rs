//! HTML: a mesh in one file that any browser opens, without a network. The page has the mesh as
//! JSON, whose arrays are base64, the viewer, and the part of three.js that this one draws with.

mod base64;

use super::picture::{COLOURS, Facts, Frame, Kept, PLAIN, distinct, grouped, smallest_angle};
use super::{Data, allocation_failed, json};
use crate::arrays::domains::domain_of;
use crate::io::outer::outer_triangles;
use crate::memory::{AllocResult, TryGrow, collected, filled};
use crate::mesh::{Attribute, NONE, Triangulation};
use crate::quality::Measures;
use std::io::{self, Write};

/// Page with names between double braces where its parts belong.
const PAGE: &str = include_str!("viewer.html");
const STYLE: &str = include_str!("viewer.css");
/// Made by scripts/viewer.sh.
const LIBRARY: &str = include_str!("three.min.js");
const SCRIPTS: [&str; 4] = [
    include_str!("cells.js"),
    include_str!("colours.js"),
    include_str!("scene.js"),
    include_str!("viewer.js"),
];

/// Numbers of cells, of outer triangles and of pieces of segments that are drawn; of more some are
/// left out. Triangles take a quarter of the work of tetrahedra.
const LIMIT_IN_PLANE: usize = 1_000_000;
const LIMIT_IN_SPACE: usize = 400_000;

pub(super) fn write(
    mesh: &Triangulation,
    facet_markers: &[i32],
    data: &Data<'_>,
    out: &mut dyn Write,
) -> io::Result<()> {
    let limit = if mesh.dim == 2 { LIMIT_IN_PLANE } else { LIMIT_IN_SPACE };
    let measures = data.measures_of(mesh)?;
    let page = Page::new(mesh, facet_markers, data.attributes, &measures, limit);
    let page = page.map_err(allocation_failed)?;
    page.write(out)
}

struct Page<'a> {
    mesh: &'a Triangulation,
    /// Facet -> its marker; empty if no facet has another one than 0.
    facet_markers: &'a [i32],
    attributes: &'a [Attribute],
    facts: Facts<'a>,
    frame: Frame,
    measures: &'a Measures,
    cells: Kept,
    /// Outer triangles of tetrahedra that are left out, of which so many are drawn.
    skin: Kept,
    segments: Kept,
    /// Vertex -> its number in the page; [`NONE`] for one that nothing drawn has.
    numbers: Vec<u32>,
    /// Vertices of the page, ascending.
    vertices: Vec<u32>,
}

impl<'a> Page<'a> {
    fn new(
        mesh: &'a Triangulation,
        facet_markers: &'a [i32],
        attributes: &'a [Attribute],
        measures: &'a Measures,
        limit: usize,
    ) -> AllocResult<Self> {
        let cells = Kept::new(mesh.simplex_count(), limit);
        let has_markers = facet_markers.iter().any(|&marker| marker != 0);
        let mut page = Self {
            mesh,
            facet_markers: if has_markers { facet_markers } else { &[] },
            attributes,
            facts: Facts::new(mesh, &measures.quality)?,
            frame: Frame::new(mesh),
            measures,
            cells,
            skin: Kept::new(bare_triangles(mesh, cells).count(), limit),
            segments: Kept::new(mesh.boundary.subsegments.len(), limit),
            numbers: filled(mesh.vertex_count(), NONE)?,
            vertices: Vec::new(),
        };
        page.number_vertices()?;
        Ok(page)
    }

    fn number_vertices(&mut self) -> AllocResult<()> {
        let mut numbers = std::mem::take(&mut self.numbers);
        let mut mark = |vertices: &[u32]| {
            vertices.iter().for_each(|&vertex| numbers[vertex as usize] = 0);
        };
        self.cells.iter().for_each(|cell| mark(self.mesh.simplex(cell)));
        self.skin().for_each(|(_, triangle)| mark(&triangle));
        self.subsegments().for_each(|ends| mark(&ends));
        for (vertex, number) in (0u32..).zip(&mut numbers).filter(|(_, number)| **number == 0) {
            *number = self.vertices.len() as u32;
            self.vertices.try_push(vertex)?;
        }
        self.numbers = numbers;
        Ok(())
    }

    /// Returns the outer triangles that are drawn without their tetrahedra, with the numbers of
    /// these.
    fn skin(&self) -> impl Iterator<Item = (usize, [u32; 3])> {
        let mut all = bare_triangles(self.mesh, self.cells);
        let mut next = 0;
        self.skin.iter().filter_map(move |at| {
            let found = all.nth(at - next);
            next = at + 1;
            found
        })
    }

    /// Returns the pieces of segments that are drawn.
    fn subsegments(&self) -> impl Iterator<Item = [u32; 2]> {
        self.segments.iter().map(|segment| self.mesh.boundary.subsegments[segment])
    }

    /// Returns the triangles of facets with markers whose vertices are in the page, as those of its
    /// cells are, and their markers.
    fn facets(&self) -> impl Iterator<Item = ([u32; 3], i32)> {
        let has_markers = !self.facet_markers.is_empty();
        let marked = has_markers.then(|| self.mesh.boundary.marked_facets(self.facet_markers));
        let is_there = |vertex: &u32| self.numbers[*vertex as usize] != NONE;
        marked.into_iter().flatten().filter(move |(corners, _)| corners.iter().all(is_there))
    }

    /// Returns the cells that triangles and tetrahedra of the page are of, in its order.
    fn drawn(&self) -> impl Iterator<Item = usize> {
        self.cells.iter().chain(self.skin().map(|(cell, _)| cell))
    }

    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut pieces = PAGE.split("{{");
        out.write_all(pieces.next().unwrap_or_default().as_bytes())?;
        for piece in pieces {
            let (name, rest) = piece.split_once("}}").unwrap_or((piece, ""));
            self.write_part(name, out)?;
            out.write_all(rest.as_bytes())?;
        }
        Ok(())
    }

    fn write_part(&self, name: &str, out: &mut dyn Write) -> io::Result<()> {
        match name {
            "title" => {
                let cells = if self.mesh.dim == 2 { "triangles" } else { "tetrahedra" };
                write!(out, "{} {cells}", grouped(self.cells.count))
            }
            "style" => out.write_all(STYLE.as_bytes()),
            "facts" => self.write_facts(out),
            "mesh" => self.write_mesh(out),
            "library" => out.write_all(LIBRARY.as_bytes()),
            _ => SCRIPTS.iter().try_for_each(|script| out.write_all(script.as_bytes())),
        }
    }

    fn write_facts(&self, out: &mut dyn Write) -> io::Result<()> {
        self.facts.visit(|sentence| writeln!(out, "<li>{sentence}</li>"))?;
        let cells = if self.mesh.dim == 2 { "triangles" } else { "tetrahedra" };
        for (kept, name) in [
            (self.cells, cells),
            (self.skin, "outer triangles of the others"),
            (self.segments, "pieces of segments"),
        ] {
            let (drawn, all) = (grouped(kept.len()), grouped(kept.count));
            if kept.is_thinned() {
                let how = "are in this file, evenly in their order";
                writeln!(out, "<li class=\"thinned\">{drawn} of {all} {name} {how}</li>")?;
            } else if name == "outer triangles of the others" && kept.count > 0 {
                writeln!(out, "<li class=\"thinned\">All {all} {name} are drawn, too</li>")?;
            }
        }
        Ok(())
    }

    /// Writes the mesh as JSON, whose fields cells.js reads.
    fn write_mesh(&self, out: &mut dyn Write) -> io::Result<()> {
        let (mesh, dim) = (self.mesh, self.mesh.dim);
        let (center, half) = self.frame.in_mesh();
        write!(out, r#"{{"format":"netmesh viewer","version":1,"dim":{dim},"center":"#)?;
        json::point(out, &center)?;
        out.write_all(br#","half":"#)?;
        json::number(out, half)?;
        let (vertices, cells) = (self.vertices.len(), self.cells);
        write!(out, r#","vertices":{vertices},"cells":{},"all":{}"#, cells.len(), cells.count)?;
        write!(out, r#","triangles":{},"segments":{}"#, self.skin.len(), self.segments.len())?;
        out.write_all(br#","colours":"#)?;
        json::list(out, COLOURS, |out, colour| write!(out, "\"{colour}\""))?;
        write!(out, r#","plain":"{PLAIN}""#)?;
        let sides = self.vertices.iter().map(|&vertex| self.frame.place(mesh.point(vertex)));
        let numbers = sides.flat_map(|place| place.map(|x| (x as f32).to_le_bytes()));
        write_array("points", numbers, out)?;
        let kinds = self.vertices.iter().map(|&vertex| [mesh.kinds[vertex as usize] as u8]);
        write_array("kinds", kinds, out)?;
        let number = |vertex: u32| self.numbers[vertex as usize].to_le_bytes();
        let simplices = cells.iter().flat_map(|cell| mesh.simplex(cell));
        write_array("simplices", simplices.map(|&vertex| number(vertex)), out)?;
        write_array("skin", self.skin().flat_map(|(_, triangle)| triangle).map(number), out)?;
        write_array("ends", self.subsegments().flatten().map(number), out)?;
        let corners = self.facets().flat_map(|(corners, _)| corners);
        write_array("facets", corners.map(number), out)?;
        self.write_measures(out)?;
        self.write_labels(out)?;
        self.write_attributes(out)?;
        out.write_all(b"}")
    }

    /// Writes measures of cells, and of Voronoi cells.
    fn write_measures(&self, out: &mut dyn Write) -> io::Result<()> {
        let (mesh, is_plane) = (self.mesh, self.mesh.dim == 2);
        let (angle, most) =
            if is_plane { ("smallest angle", 60.0) } else { ("smallest dihedral angle", 70.53) };
        write!(out, r#","measures":[{{"name":"{angle}","key":"angle","unit":"°","of":"cells""#)?;
        write!(out, r#","good":{most},"bad":0"#)?;
        // Nothing else can fail than memory.
        let angles = self.drawn().map(|cell| smallest_angle(mesh, cell).unwrap_or(f64::NAN));
        write_array("values", angles.map(single), out)?;
        let least = if is_plane { 0.57735 } else { 0.61237 };
        out.write_all(br#"},{"name":"radius-edge ratio","key":"ratio","unit":"","of":"cells""#)?;
        write!(out, r#","good":{least},"bad":2"#)?;
        let ratios = self.drawn().map(|cell| self.measures.radius_edge[cell]);
        write_array("values", ratios.map(single), out)?;
        out.write_all(br#"},{"name":"aspect of Voronoi cells","key":"aspect","unit":"""#)?;
        out.write_all(br#","of":"vertices","good":1,"bad":4"#)?;
        let aspects = self.vertices.iter().map(|&vertex| self.measures.aspect[vertex as usize]);
        write_array("values", aspects.map(single), out)?;
        out.write_all(b"}]")
    }

    /// Writes labels: regions of cells, their domains if there are several, and markers of facets.
    fn write_labels(&self, out: &mut dyn Write) -> io::Result<()> {
        let mesh = self.mesh;
        let mut separator = "";
        out.write_all(br#","labels":["#)?;
        let regions = &mesh.boundary.simplex_regions;
        if !regions.is_empty() {
            let labels = self.drawn().map(|cell| regions[cell]);
            write_label(("region", "regions", "cells"), &self.facts.regions, labels, out)?;
            separator = ",";
        }
        if mesh.domains.len() > 1 {
            let domain = |cell| domain_of(mesh, mesh.simplex(cell)) as i32;
            let found = collected(self.drawn().map(domain)).map_err(allocation_failed)?;
            let known = distinct(&found).map_err(allocation_failed)?;
            out.write_all(separator.as_bytes())?;
            write_label(("domain", "domains", "cells"), &known, found.into_iter(), out)?;
            separator = ",";
        }
        if !self.facet_markers.is_empty() {
            let markers = self.facets().map(|(_, marker)| marker);
            let found = collected(markers).map_err(allocation_failed)?;
            let known = distinct(&found).map_err(allocation_failed)?;
            out.write_all(separator.as_bytes())?;
            let names = ("facet marker", "markers", "facets");
            write_label(names, &known, found.into_iter(), out)?;
        }
        out.write_all(b"]")
    }

    /// Writes attributes of the vertices, a component at a time, as parts of their range.
    fn write_attributes(&self, out: &mut dyn Write) -> io::Result<()> {
        out.write_all(br#","attributes":["#)?;
        let columns = self.attributes.iter().flat_map(|attribute| {
            (0..attribute.components).map(move |component| (attribute, component))
        });
        for (index, (attribute, component)) in columns.enumerate() {
            if index > 0 {
                out.write_all(b",")?;
            }
            let value = |vertex: &u32| attribute.of(*vertex as usize)[component];
            let finite = || self.vertices.iter().map(value).filter(|value| value.is_finite());
            let (least, most) =
                (finite().fold(f64::NAN, f64::min), finite().fold(f64::NAN, f64::max));
            out.write_all(br#"{"name":"#)?;
            write_name(attribute, component, out)?;
            out.write_all(br#","least":"#)?;
            json::number(out, least)?;
            out.write_all(br#","most":"#)?;
            json::number(out, most)?;
            let parts = self.vertices.iter().map(value).map(|value| part(value, least, most));
            write_array("values", parts.map(single), out)?;
            out.write_all(b"}")?;
        }
        out.write_all(b"]")
    }
}

/// Returns the outer triangles of tetrahedra that are not `kept`, with the numbers of these.
fn bare_triangles(mesh: &Triangulation, kept: Kept) -> impl Iterator<Item = (usize, [u32; 3])> {
    let is_wanted = mesh.dim == 3 && kept.is_thinned();
    let all = is_wanted.then(|| outer_triangles(mesh)).into_iter().flatten();
    let mut cells = kept.iter().peekable();
    all.filter_map(move |((cell, _), triangle)| {
        let cell = cell as usize;
        while cells.next_if(|&other| other < cell).is_some() {}
        (cells.peek() != Some(&cell)).then_some((cell, triangle))
    })
}

/// Returns where a value is between two others: 0 at the least, 1 at the most, 0 where these are
/// the same. Halves do not overflow.
fn part(value: f64, least: f64, most: f64) -> f64 {
    match 0.5 * most - 0.5 * least {
        0.0 if value.is_finite() => 0.0,
        _ if !value.is_finite() => value,
        half => (0.5 * value - 0.5 * least) / half,
    }
}

fn single(value: f64) -> [u8; 4] {
    (value as f32).to_le_bytes()
}

/// Writes labels as JSON: their name, their key in the page's address, what has them, the different
/// ones and all.
fn write_label(
    (name, key, of): (&str, &str, &str),
    distinct: &[i32],
    labels: impl Iterator<Item = i32>,
    out: &mut dyn Write,
) -> io::Result<()> {
    write!(out, r#"{{"name":"{name}","key":"{key}","distinct":"#)?;
    json::list(out, distinct, |out, label| write!(out, "{label}"))?;
    write!(out, r#","of":"{of}""#)?;
    write_array("values", labels.map(i32::to_le_bytes), out)?;
    out.write_all(b"}")
}

/// Writes the name of a component of an attribute as other formats have it: `name`, or `name_0`.
fn write_name(attribute: &Attribute, component: usize, out: &mut dyn Write) -> io::Result<()> {
    out.write_all(b"\"")?;
    for byte in attribute.name.bytes() {
        match byte {
            b'"' | b'\\' | b'<' | b'>' | b'&' | ..32 => write!(out, "\\u{byte:04x}")?,
            _ => out.write_all(&[byte])?,
        }
    }
    if attribute.components > 1 {
        write!(out, "_{component}")?;
    }
    out.write_all(b"\"")
}

/// Writes a field with the bytes of numbers as base64.
fn write_array<const N: usize>(
    name: &str,
    numbers: impl Iterator<Item = [u8; N]>,
    out: &mut dyn Write,
) -> io::Result<()> {
    write!(out, r#","{name}":""#)?;
    base64::write(numbers, out)?;
    out.write_all(b"\"")
}

#[cfg(test)]
mod tests;
