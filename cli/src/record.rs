//! Record of a run, for a program to read: the fields of `nm_counts`, `nm_options`, `nm_quality`,
//! `nm_stats` and `nm_report` under their names, and histograms, as one JSON object. JSON has no
//! infinity: it becomes the text "inf" (-inf, nan). Figures that were not measured are null.

use crate::alpha_shape::Measured;
use crate::histograms::{Histograms, Table};
use crate::input::{Further, Marked};
use crate::repairs::{Reason, Repairs};
use crate::scan::Found;
use crate::summary::Summary;
use netmesh::options::{TABLE, Value as Given};
use netmesh::surface::Shell;
use netmesh::validate::Report;
use netmesh::{Parameters, Stats};
use serde_json::ser::{Formatter, PrettyFormatter, Serializer};
use serde_json::{Map, Value, json};
use std::io::{Result, Write};

/// Returns the text of the record.
pub fn json(summary: &Summary<'_>) -> String {
    let parameters = &summary.triangulation.parameters;
    let left_out = summary.left_out;
    text(&json!({
        "version": env!("CARGO_PKG_VERSION"),
        "input": summary.arguments.input.to_string_lossy(),
        "counts": {
            "dim": summary.inputs.dim(),
            "inputs": summary.inputs.count(),
            "duplicates": summary.inputs.duplicates(),
            "vertices": summary.triangulation.vertex_count(),
            "simplices": summary.triangulation.simplex_count(),
            "domains": summary.triangulation.domains.len(),
            "segment_edges": summary.triangulation.boundary.subsegments.len(),
            "facet_triangles": summary.triangulation.boundary.subfacets.len(),
        },
        "left_out": {
            "edges": left_out.edges,
            "faces": left_out.faces,
            "cells": left_out.cells,
        },
        "outside": {
            "points": summary.outside.points,
            "segment_edges": summary.outside.subsegments,
            "facet_triangles": summary.outside.subfacets,
        },
        "with": summary.further.iter().map(further).collect::<Vec<_>>(),
        "repairs": repairs(summary.repairs),
        "options": options(parameters),
        "quality": quality(summary),
        "histograms": summary.histograms.map(histograms),
        "stats": stats(&summary.triangulation.stats, parameters.instruments),
        "alpha_shape": summary.alpha_shape.map(alpha_shape),
        "surface": summary.scan.map(|found| surface(found, summary.triangulation.dim)),
        "report": summary.report.map(report),
    }))
}

/// Returns what a file has that the input was meshed together with.
fn further(file: &Further) -> Value {
    let marked = |marked: &Marked| {
        let range = marked.markers.map(|(least, largest)| [least, largest]);
        json!({ "count": marked.count, "markers": range })
    };
    json!({
        "input": file.name,
        "points": file.points,
        "facets": marked(&file.facets),
        "segments": marked(&file.segments),
    })
}

/// Returns what was repaired; null for what was not asked for.
fn repairs(Repairs { merged, triangulated, closed }: &Repairs) -> Value {
    json!({
        "merged": merged.as_ref().map(|merged| json!({
            "points": merged.points,
            "triangles": merged.triangles,
            "polygons": merged.polygons,
            "loops": merged.loops,
        })),
        "triangulated": triangulated.as_ref().map(|split| split.polygons),
        "triangulated_without_area": triangulated.as_ref().map(|split| split.without_area),
        "triangulated_since": triangulated.as_ref().map(|split| split.reason.word()),
        "not_plane": triangulated.as_ref().and_then(|split| match &split.reason {
            Reason::Bent(facet) => Some(facet),
            _ => None,
        }),
        "holes": closed.as_ref().map(|closed| json!({
            "closed": closed.holes,
            "triangles": closed.triangles.len(),
            "open_edges": closed.open_edges,
        })),
    })
}

fn alpha_shape(shape: &Measured) -> Value {
    let tunnels = shape.topology.betti.as_deref().filter(|betti| betti.len() == 3);
    json!({
        "alpha": number(shape.alpha),
        "volume": number(shape.volume),
        "euler_characteristic": number(shape.topology.euler_characteristic as f64),
        "components": shape.topology.components,
        "voids": shape.topology.voids,
        "tunnels": tunnels.map(|betti| betti[1]),
    })
}

fn shell(shell: &Shell) -> Value {
    json!({
        "facets": shell.facets,
        "vertices": shell.vertices,
        "genus": shell.genus,
        "ends": shell.ends,
        "is_one_sided": shell.is_one_sided,
    })
}

fn surface(found: &Found, dim: usize) -> Value {
    let Found { surface, points, volume } = found;
    json!({
        "facets": surface.facets.len() / dim,
        "points": points,
        "left_out": surface.left_out.len(),
        "sparse": surface.sparse(),
        "volume": number(*volume),
        "shells": surface.shells.iter().map(shell).collect::<Vec<_>>(),
    })
}

/// Returns the options as the run had them, the defaults filled in.
fn options(parameters: &Parameters) -> Map<String, Value> {
    let options = parameters.options();
    let member = |row: &netmesh::options::Row| {
        let value = match row.get(&options) {
            Given::Number(given) => number(given),
            Given::Whole(given) => json!(given),
            Given::Switch(given) => json!(given),
            given @ Given::Word(_) => json!(row.word(given).map(|word| word.argument)),
        };
        (row.name.to_owned(), value)
    };
    TABLE.iter().map(member).collect()
}

fn quality(summary: &Summary<'_>) -> Value {
    let quality = summary.quality;
    json!({
        "max_degree": quality.max_degree,
        "worst_aspect": number(quality.worst_aspect),
        "worst_aspect_anywhere": number(quality.worst_aspect_anywhere),
        "mean_aspect": number(quality.mean_aspect),
        "worst_cage_aspect": number(quality.worst_cage_aspect),
        "worst_radius_edge": number(quality.worst_radius_edge),
        "min_angle_degrees": number(quality.min_angle_degrees),
        "precision_limited": quality.precision_limited,
        "below_min_dihedral": quality.below_min_dihedral,
        "below_min_dihedral_between_domains": quality.below_min_dihedral_between_domains,
        "beyond_bound": quality.beyond_bound,
        "forced": quality.forced,
        "least_forced_angle_degrees": number(quality.least_forced_angle_degrees),
        "below_min_angle": quality.below_min_angle,
        "flat": quality.flat,
    })
}

fn histograms(histograms: &Histograms) -> Map<String, Value> {
    histograms.tables.iter().map(|table| (table.name.to_owned(), histogram(table))).collect()
}

/// Returns a histogram: `counts[i]` and `counts_at_hull[i]` are of the values between `edges[i]`
/// and `edges[i + 1]`.
fn histogram(table: &Table) -> Value {
    json!({
        "edges": table.edges.iter().map(|edge| number(*edge)).collect::<Vec<_>>(),
        "counts": table.counts,
        "counts_at_hull": table.counts_at_hull,
        "least": number(table.least),
        "largest": number(table.largest),
    })
}

fn stats(stats: &Stats, is_measured: bool) -> Value {
    let count = |count: u64| is_measured.then_some(count);
    let measured = |value: f64| is_measured.then(|| number(value));
    json!({
        "rounds": stats.rounds,
        "touches": stats.touches,
        "max_touches": stats.max_touches,
        "input_vertices": stats.input_vertices,
        "steiner_vertices": stats.steiner_vertices,
        "cage_vertices": stats.cage_vertices,
        "cages_created": stats.cages_created,
        "cages_grown": stats.cages_grown,
        "cages_released": stats.cages_released,
        "exact_fallbacks": stats.exact_fallbacks,
        "precision_limited": stats.precision_limited,
        "seconds": number(stats.seconds),
        "passes": stats.passes,
        "worst_halving": number(stats.worst_halving),
        "cage_points": stats.cage_points,
        "far_corners": stats.far_corners,
        "off_centers": stats.off_centers,
        "yields": stats.yields,
        "closing_points": stats.closing_points,
        "near_inputs": stats.near_inputs,
        "farthest_near_input": number(stats.farthest_near_input),
        "ply_probes": count(stats.ply_probes),
        "max_ply": count(stats.max_ply),
        "mean_ply": measured(stats.mean_ply),
        "max_ball_intersections": count(stats.max_ball_intersections),
        "mean_ball_intersections": measured(stats.mean_ball_intersections),
        "feature_size_constant": measured(stats.feature_size_constant),
        "insertion_constant_input": measured(stats.insertion_constant_input),
        "insertion_constant_corner": measured(stats.insertion_constant_corner),
        "insertion_constant_cage": measured(stats.insertion_constant_cage),
    })
}

fn report(report: &Report) -> Value {
    json!({ "level": report.level, "violations": report.violations, "checked": report.checked })
}

/// Returns the shortest decimal that reads back as the same double.
fn number(value: f64) -> Value {
    match value.is_finite() {
        true => json!(value),
        false => json!(value.to_string().to_lowercase()),
    }
}

/// Returns the text of an object, with a line for each member and each list in one line.
fn text(object: &Value) -> String {
    let mut text = Vec::new();
    let lines = Lines(PrettyFormatter::new());
    let written =
        serde::Serialize::serialize(object, &mut Serializer::with_formatter(&mut text, lines));
    written.expect("names are texts, and a vector takes everything");
    String::from_utf8(text).expect("JSON is UTF-8") + "\n"
}

struct Lines<'a>(PrettyFormatter<'a>);

impl Formatter for Lines<'_> {
    fn begin_array_value<W: Write + ?Sized>(&mut self, writer: &mut W, first: bool) -> Result<()> {
        writer.write_all(if first { b"" } else { b", " })
    }

    fn begin_object<W: Write + ?Sized>(&mut self, writer: &mut W) -> Result<()> {
        self.0.begin_object(writer)
    }

    fn end_object<W: Write + ?Sized>(&mut self, writer: &mut W) -> Result<()> {
        self.0.end_object(writer)
    }

    fn begin_object_key<W: Write + ?Sized>(&mut self, writer: &mut W, first: bool) -> Result<()> {
        self.0.begin_object_key(writer, first)
    }

    fn begin_object_value<W: Write + ?Sized>(&mut self, writer: &mut W) -> Result<()> {
        self.0.begin_object_value(writer)
    }

    fn end_object_value<W: Write + ?Sized>(&mut self, writer: &mut W) -> Result<()> {
        self.0.end_object_value(writer)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn members_have_lines_and_numbers_read_back() {
        let numbers = [0.0, -0.0, 1.5, 1e300, -2.5e-308, f64::MAX, f64::from_bits(1), 1.0 / 3.0];
        let named = |value: &f64| (value.to_string(), number(*value));
        let object: Map<_, _> = numbers.iter().map(named).collect();
        let read: Value = serde_json::from_str(&text(&json!({ "inside": object }))).unwrap();
        for value in numbers {
            let back = read["inside"][value.to_string()].as_f64().unwrap();
            assert_eq!(back.to_bits(), value.to_bits(), "{value:e}");
        }
        let odd = [f64::INFINITY, f64::NEG_INFINITY, f64::NAN].map(number);
        let written = text(&json!({ "odd": odd, "most": u64::MAX, "in": { "none": null } }));
        let expected = "{\n  \"odd\": [\"inf\", \"-inf\", \"nan\"],\n  \"most\": \
                        18446744073709551615,\n  \"in\": {\n    \"none\": null\n  }\n}\n";
        assert_eq!(written, expected);
    }
}
