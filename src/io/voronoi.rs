//! The Voronoi diagram of the vertices as JSON: a corner for each simplex, a cell for each vertex.

use super::{allocation_failed, json};
use crate::memory::{AllocResult, TryGrow, filled};
use crate::mesh::{Inputs, NONE, Triangulation, in_dimension};
use crate::quality::corner::Corner;
use crate::quality::length::scale;
use crate::quality::view::View;
use std::io::{self, Write};

pub(super) fn write(inputs: &Inputs, mesh: &Triangulation, out: &mut dyn Write) -> io::Result<()> {
    in_dimension!(
        mesh.dim,
        D => write_in(View::<D> { mesh }, inputs, out),
        _ => unreachable!("inputs of another dimension are refused when they are made")
    )
}

fn write_in<const D: usize>(
    view: View<'_, D>,
    inputs: &Inputs,
    out: &mut dyn Write,
) -> io::Result<()> {
    write!(out, r#"{{"format":"netmesh voronoi","version":1,"dim":{D},"sites":"#)?;
    json::lines(out, view.mesh.points.chunks_exact(D), json::point)?;
    out.write_all(b",\n\"corners\":")?;
    json::lines(out, 0..view.simplex_count(), |out, simplex| {
        match corner(view, simplex).map_err(allocation_failed)? {
            Some(corner) => json::point(out, &corner),
            None => out.write_all(b"null"),
        }
    })?;
    out.write_all(b",\n\"cells\":")?;
    write_cells(view, inputs, out)?;
    out.write_all(b"}\n")
}

/// Returns the circumcentre; `None` where it is beyond the doubles.
fn corner<const D: usize>(view: View<'_, D>, simplex: usize) -> AllocResult<Option<[f64; D]>> {
    let points = view.points_of(view.simplex(simplex));
    let Some(corner) = Corner::new(&points[..View::<D>::VERTICES])? else {
        return Ok(None);
    };
    let base = points[corner.base];
    // Halves: an offset may be longer than any double where the sum is not.
    let half = |axis: usize| scale(corner.center.vector[axis], corner.center.exponent - 1);
    let sum = std::array::from_fn(|axis| {
        let offset = 2.0 * half(axis);
        if offset.is_finite() { base[axis] + offset } else { 2.0 * (base[axis] / 2.0 + half(axis)) }
    });
    Ok(sum.iter().all(|x| x.is_finite()).then_some(sum))
}

fn write_cells<const D: usize>(
    view: View<'_, D>,
    inputs: &Inputs,
    out: &mut dyn Write,
) -> io::Result<()> {
    let stars = view.stars().map_err(allocation_failed)?;
    let on_hull = view.hull_vertices().map_err(allocation_failed)?;
    let mut seen = filled(view.vertex_count(), NONE).map_err(allocation_failed)?;
    let (mut corners, mut neighbors) = (Vec::new(), Vec::new());
    json::lines(out, 0..view.vertex_count(), |out, site| {
        corners.clear();
        corners.try_extend(stars.of(site)).map_err(allocation_failed)?;
        if D == 2 {
            go_round(view, site as u32, &mut corners);
        }
        neighbors.clear();
        for &vertex in stars.of(site).iter().flat_map(|&simplex| view.simplex(simplex as usize)) {
            if vertex != site as u32 && seen[vertex as usize] != site as u32 {
                seen[vertex as usize] = site as u32;
                neighbors.try_push(vertex).map_err(allocation_failed)?;
            }
        }
        neighbors.sort_unstable();
        write!(out, r#"{{"site":{site},"input":"#)?;
        json::id(out, inputs.first_input(site).unwrap_or(NONE))?;
        write!(out, r#","unbounded":{},"corners":"#, on_hull[site])?;
        json::list(out, &corners, |out, corner| write!(out, "{corner}"))?;
        out.write_all(br#","neighbors":"#)?;
        json::list(out, &neighbors, |out, vertex| write!(out, "{vertex}"))?;
        out.write_all(b"}")
    })
}

/// Puts the triangles around `site` in counterclockwise order; on the hull from one end of the
/// unbounded cell to the other, elsewhere from the triangle that came first.
fn go_round<const D: usize>(view: View<'_, D>, site: u32, star: &mut [u32]) {
    // Across the edge from the site to the vertex after it lies the triangle before, and the other
    // way round: `step` is the vertex, counted from the site, that the triangle in question is
    // opposite of.
    let across = |simplex: u32, step: usize| {
        let vertices = view.simplex(simplex as usize);
        let at = vertices.iter().position(|&vertex| vertex == site).unwrap_or(0);
        view.neighbors(simplex as usize)[(at + step) % View::<D>::VERTICES]
    };
    let Some(&first) = star.first() else { return };
    let mut start = first;
    for _ in 0..star.len() {
        match across(start, 2) {
            NONE => break,
            before => start = before,
        }
    }
    for place in star.iter_mut() {
        *place = start;
        start = across(start, 1);
        if start == NONE {
            break;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Format, samples, write};
    use super::*;
    use crate::mesh::Mesh;

    fn meshed(points: &[f64], dim: usize) -> Mesh {
        let mut mesh = Mesh::new(dim, points.len() / dim, points, 0).unwrap();
        mesh.run(&samples::delaunay(), None).unwrap();
        mesh
    }

    fn text(mesh: &Mesh) -> String {
        let mut text = Vec::new();
        write(mesh, Format::VoronoiJson, &mut text).unwrap();
        String::from_utf8(text).unwrap()
    }

    /// Returns the numbers of the first list called `name` in a line.
    fn list(line: &str, name: &str) -> Vec<u32> {
        let (_, rest) = line.split_once(&format!("\"{name}\":[")).unwrap();
        let (list, _) = rest.split_once(']').unwrap();
        list.split(',').filter(|word| !word.is_empty()).map(|word| word.parse().unwrap()).collect()
    }

    #[test]
    fn the_diagram_of_a_triangle_with_a_double_input() {
        let mesh = meshed(&[0.0, 0.0, 0.0, 0.0, 4.0, 0.0, 0.0, 2.0], 2);
        let expected = "{\"format\":\"netmesh voronoi\",\"version\":1,\"dim\":2,\"sites\":[\n\
            [0,0],\n[4,0],\n[0,2]],\n\
            \"corners\":[\n[2,1]],\n\"cells\":[\n\
            {\"site\":0,\"input\":0,\"unbounded\":true,\"corners\":[0],\"neighbors\":[1,2]},\n\
            {\"site\":1,\"input\":2,\"unbounded\":true,\"corners\":[0],\"neighbors\":[0,2]},\n\
            {\"site\":2,\"input\":3,\"unbounded\":true,\"corners\":[0],\"neighbors\":[0,1]}]}\n";
        assert_eq!(text(&mesh), expected);
    }

    #[test]
    fn cells_in_the_plane_are_polygons_in_counterclockwise_order() {
        let mesh = samples::finished(2);
        let view = View::<2> { mesh: mesh.triangulation().unwrap() };
        let text = text(&mesh);
        let (_, cells) = text.split_once("\"cells\":[\n").unwrap();
        for (site, line) in cells.lines().enumerate() {
            let corners = list(line, "corners");
            let [x, y] = *view.point(site as u32);
            let at: Vec<[f64; 2]> =
                corners.iter().map(|&c| corner(view, c as usize).unwrap().unwrap()).collect();
            let next = at.iter().cycle().skip(1);
            let turns =
                at.iter().zip(next).map(|(p, q)| (p[0] - x) * (q[1] - y) - (p[1] - y) * (q[0] - x));
            // Between its last and its first corner an unbounded cell has no edge.
            let edges = corners.len() - usize::from(line.contains("\"unbounded\":true"));
            assert!(turns.take(edges).all(|turn| turn >= -1e-12), "{line}");
            let mut once = corners.clone();
            once.sort_unstable();
            once.dedup();
            assert_eq!(once.len(), corners.len());
            assert_eq!(corners.len() + corners.len() - edges, list(line, "neighbors").len());
        }
    }

    #[test]
    fn corners_far_beyond_their_triangle_are_rounded_once_or_null() {
        let m = f64::MAX;
        let near = meshed(&[-m, 0.0, m, 0.0, 0.0, m], 2);
        assert!(text(&near).contains("\"corners\":[\n[0,0]],"), "{}", text(&near));
        let far = meshed(&[-m, 0.0, m, 0.0, 0.0, m / 1024.0], 2);
        assert!(text(&far).contains("\"corners\":[\nnull],"), "{}", text(&far));
    }
}
