//! The reader of Triangle's `.poly`.

use super::outlines;
use netmesh::io::Format;

/// The bytes are the file.
pub fn check(data: &[u8]) {
    check_text(data);
}

/// Whether the file was accepted.
pub fn check_text(text: &[u8]) -> bool {
    outlines::check_text(Format::Poly, text)
}
