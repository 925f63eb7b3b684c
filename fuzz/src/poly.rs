//! The reader of Triangle's `.poly`.

use super::outlines;
use netmesh::io::Format;

/// Checks the bytes as a file.
pub fn check(data: &[u8]) {
    check_text(data);
}

/// Checks a file; returns true if it was accepted.
pub fn check_text(text: &[u8]) -> bool {
    outlines::check_text(Format::Poly, text)
}
