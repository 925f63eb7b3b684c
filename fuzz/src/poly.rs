//! The readers of `.poly` and of `.smesh`.

use super::outlines;
use netmesh::io::Format;

/// Checks the bytes as a file.
pub fn check(data: &[u8]) {
    check_text(data);
}

/// Checks a file in both formats; returns true if one was accepted.
pub fn check_text(text: &[u8]) -> bool {
    let accepted = [Format::Poly, Format::Smesh].map(|format| outlines::check_text(format, text));
    accepted.contains(&true)
}
