//! The readers of GeoJSON and well-known text.

use super::outlines;
use netmesh::io::Format;

/// Checks the bytes as a file: of GeoJSON if they begin with a brace, else of well-known text.
pub fn check(data: &[u8]) {
    check_text(data);
}

/// Checks a file; returns true if it was accepted.
pub fn check_text(text: &[u8]) -> bool {
    let begins_object = text.trim_ascii_start().starts_with(b"{");
    outlines::check_text(if begins_object { Format::Geojson } else { Format::Wkt }, text)
}
