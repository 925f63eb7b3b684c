//! Diagnosis of facets: where they are no closed surface, and where they meet though they must not.

use crate::arguments::Arguments;
use crate::exit_code::{ExitCode, Failure};
use crate::input;
use crate::merging;
use crate::numbers::{counted, grouped};
use crate::origins::Origins;
use crate::repairs::Repairs;
use crate::standard;
use crate::words::argument;
use netmesh::io::write_diagnosis_file;
use netmesh::mesh::Diagnosis;
use netmesh::{EdgeFault, Feature, Intersection, IntersectionKind, Mesh};
use std::ffi::OsStr;
use std::fmt::Write;
use std::path::Path;

/// Number of pairs that the text names.
const MOST: usize = 10;

/// Refuses a path whose extension is not that of the format, and standard output; and options of a
/// run, which is not made, apart from the angle up to which a polygon counts as plane.
pub fn require(path: &Path, arguments: &Arguments) -> Result<(), Failure> {
    if let Some(option) = arguments.given.iter().find(|option| **option != "coplanar") {
        let option = argument(option);
        let message = format!("{option} is for a mesh; --diagnose makes none");
        return Err(Failure::new(ExitCode::Usage, message));
    }
    let is_vtu = |extension: &OsStr| extension.eq_ignore_ascii_case("vtu");
    let rule = match path.extension().is_some_and(is_vtu) {
        _ if standard::is_meant(path) => "--diagnose needs the name of a file that ends with .vtu",
        true => return Ok(()),
        false => "--diagnose writes VTU; the name of its file must end with .vtu",
    };
    Err(Failure::new(ExitCode::Usage, format!("{}: {rule}", path.display())))
}

/// Returns the text of what was found in a mesh, and writes it into a file.
pub fn text(
    mesh: &Mesh,
    origins: &Origins,
    repairs: &Repairs,
    path: &Path,
    arguments: &Arguments,
) -> Result<String, Failure> {
    let name = input::names(arguments);
    let facets = mesh.given_facets();
    if facets.count() == 0 {
        let message = format!("{name}: has no facets; --diagnose is for surfaces");
        return Err(Failure::new(ExitCode::Usage, message));
    }
    let found = mesh.diagnosis()?;
    write_diagnosis_file(mesh, &found, path)
        .map_err(|error| Failure::writing(&path.display().to_string(), &error))?;
    let words = if facets.are_triangles { ["triangle", "triangles"] } else { ["facet", "facets"] };
    let mut text = format!(
        "input       {}, {} in {name}\n",
        counted(mesh.inputs().count() as u64, "point", "points"),
        counted(facets.count() as u64, words[0], words[1]),
    );
    let suspicion = merging::suspicion(mesh, arguments).map(|line| ("points", line));
    for (label, line) in repairs.lines(arguments).chain(suspicion) {
        let _ = writeln!(text, "{label:<12}{line}");
    }
    add_counts(&mut text, &found, words);
    for pair in found.intersections.iter().take(MOST) {
        let _ = writeln!(text, "            {}", sentence(pair, words, origins));
    }
    if let Some(more) = found.intersections.len().checked_sub(MOST + 1) {
        let _ = writeln!(text, "            and {} more", grouped(more as u64 + 1));
    }
    let _ = writeln!(text, "output      {}", path.display());
    Ok(text)
}

fn add_counts(text: &mut String, found: &Diagnosis, [one, many]: [&str; 2]) {
    let edges = [
        (EdgeFault::Open, format!("where one {one} ends and no other begins")),
        (EdgeFault::Crowded, format!("of three or more {many}")),
        (EdgeFault::Turned, format!("of two {many} that are turned round")),
    ];
    let mut label = "edges";
    for (fault, words) in edges {
        let count = counted(found.edges_with(fault) as u64, "edge", "edges");
        let _ = writeln!(text, "{label:<12}{count} {words}");
        label = "";
    }
    label = "faults";
    let without_area = [one, many].map(|name| format!("{name} without an area"));
    for (kind, [one, many]) in [
        (IntersectionKind::ZeroArea, without_area.each_ref().map(String::as_str)),
        (IntersectionKind::Cross, ["pair that crosses", "pairs that cross"]),
        (IntersectionKind::Touch, ["pair that touches", "pairs that touch"]),
        (IntersectionKind::Overlap, ["pair that overlaps", "pairs that overlap"]),
    ] {
        let count = counted(found.intersections_of(kind) as u64, one, many);
        let _ = writeln!(text, "{label:<12}{count}");
        label = "";
    }
    let duplicates = counted(found.duplicates as u64, one, many);
    let _ = writeln!(text, "            {duplicates} with the vertices of an earlier one");
}

/// Returns a line about a pair, or about a facet without an area.
fn sentence(found: &Intersection, [one, _]: [&str; 2], origins: &Origins) -> String {
    let name = |feature: Feature| {
        let name = match feature {
            Feature::Facet(facet) => format!("{one} {facet}"),
            Feature::Segment(segment) => format!("segment {segment}"),
        };
        match origins.tell_more(feature) {
            true => format!("{name} ({})", origins.name(feature)),
            false => name,
        }
    };
    let verb = match found.kind {
        IntersectionKind::Cross => "crosses",
        IntersectionKind::Touch => "touches",
        IntersectionKind::Overlap => "overlaps",
        IntersectionKind::ZeroArea => "has no area",
    };
    let [x, y, z] = found.point;
    let (first, second) = (name(found.first), name(found.second));
    match found.kind {
        IntersectionKind::ZeroArea => format!("{first} {verb}, at ({x:?}, {y:?}, {z:?})"),
        _ => format!("{first} {verb} {second}, at ({x:?}, {y:?}, {z:?})"),
    }
}
