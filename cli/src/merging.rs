//! Corners of surfaces that are as good as one: `--merge` makes them one, and without it a failure
//! or a diagnosis tells that there are some.

use crate::arguments::Arguments;
use crate::exit_code::{ExitCode, Failure};
use crate::numbers::{counted, counted_all};
use crate::standard;
use netmesh::io::{Merged, Table};
use netmesh::{Mesh, merge_points};

/// Ratio within which corners are told that may be meant to be one.
const SUSPICIOUS: f64 = 1e-9;

/// Parses a ratio that corners may be merged within.
pub fn parse_ratio(text: &str) -> Result<f64, String> {
    let rule = "it must be a number from 0 to 0.001";
    match text.parse::<f64>() {
        Ok(ratio) if (0.0..=1e-3).contains(&ratio) => Ok(ratio),
        _ => Err(rule.to_owned()),
    }
}

/// Merges corners where that is asked for.
pub fn merge(table: &mut Table, arguments: &Arguments) -> Result<Option<Merged>, Failure> {
    let Some(ratio) = arguments.merge else { return Ok(None) };
    let name = standard::input_name(&arguments.input);
    if table.outline.facets.count() == 0 {
        let message = format!("{name}: has no facets; --merge is for surfaces");
        return Err(Failure::new(ExitCode::Usage, message));
    }
    let merged = table.merge_corners(ratio);
    merged.map(Some).map_err(|error| Failure::reading(&name, &error))
}

/// Returns the line that tells what was merged.
pub fn told(merged: &Merged, ratio: f64) -> String {
    let Merged { points, triangles, polygons, loops, .. } = merged;
    let corners = counted(*points as u64, "corner", "corners");
    let gone = counted_all([
        (*triangles as u64, "triangle", "triangles"),
        (*polygons as u64, "polygon", "polygons"),
        (*loops as u64, "loop", "loops"),
    ]);
    let gone = match gone.is_empty() {
        true => String::new(),
        false => format!(", {} left out", gone.join(" and ")),
    };
    format!("{corners} merged with others within {ratio:?} of the diagonal{gone}")
}

/// Returns words about corners of facets that are nearly others, if there are any and nothing was
/// merged.
pub fn suspicion(mesh: &Mesh, arguments: &Arguments) -> Option<String> {
    let facets = mesh.given_facets();
    if facets.count() == 0 || arguments.merge.is_some() {
        return None;
    }
    let mut corners = facets.inputs.clone();
    corners.sort_unstable();
    corners.dedup();
    let inputs = mesh.inputs();
    let points = corners.iter().map(|&corner| inputs.vertices()[corner as usize] as usize);
    let mut coordinates: Vec<f64> =
        points.flat_map(|vertex| inputs.distinct_point(vertex).iter().copied()).collect();
    match merge_points(inputs.dim(), &mut coordinates, SUSPICIOUS) {
        Ok(0) | Err(_) => None,
        Ok(moved) => {
            let verb = if moved == 1 { "is" } else { "are" };
            let corners = counted(moved as u64, "corner", "corners");
            Some(format!(
                "{corners} {verb} within {SUSPICIOUS:?} of the diagonal from others; --merge \
                 {SUSPICIOUS:?} makes them one"
            ))
        }
    }
}
