//! The readers of GeoJSON and well-known text.

use super::outlines;
use netmesh::io::Format;

/// The bytes are the file: of GeoJSON where they begin with a brace.
pub fn check(data: &[u8]) {
    check_text(data);
}

/// Whether the file was accepted.
pub fn check_text(text: &[u8]) -> bool {
    let begins_object = text.trim_ascii_start().starts_with(b"{");
    outlines::check_text(if begins_object { Format::GeoJson } else { Format::Wkt }, text)
}
